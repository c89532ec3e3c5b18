//! The curve of a point with coordinates of points as symbols.
//!
//! The coupler of a four-bar is held at two points. Each satisfies one condition, linear in cosine and sine of its rotation: the end of a
//! crank keeps its distance from the ground, that of a slide stays on its line. With `l_k = a_k c + b_k s`, of which coefficients
//! and right sides are polynomials in the traced point (x, y) and the symbols, Cramer's rule gives c and s, and `c^2 + s^2 = 1`:
//!
//! `(l_1 b_2 - l_2 b_1)^2 + (a_1 l_2 - a_2 l_1)^2 - (a_1 b_2 - a_2 b_1)^2`
//!
//! vanishes at every place of the point, whatever the symbols are. Of other linkages the curves at numbers are interpolated.

use super::cosines::integers;
use super::places::{Places, Plane, Space, constant, cross, difference, dot};
use super::symbolic::{Coordinate, chosen};
use super::trace::{held, mover, trace};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::derivation::equation::primitive;
use crate::derivation::interpolation::{COMPARED, Family, Source, Values, Watch};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use rug::{Integer, Rational};

/// Maximum number of symbols of a four-bar: with its six lengths and two more the squares above have some thousands of terms.
const MOST_SYMBOLS: usize = 8;
/// Maximum number of symbols where curves are interpolated: each multiplies the number of curves by ten or more.
const MOST_INTERPOLATED: usize = 3;
/// The longest polynomial, as of all polynomials with symbols.
const MOST_TERMS: usize = 100_000;

/// The curve of a point with symbols.
#[derive(Clone, Debug)]
pub struct CurveSymbolic {
    /// The symbols: the variables from 2.
    pub symbols: Vec<Coordinate>,
    /// The coordinates that keep the numbers of the file, zeros apart.
    pub numbers: Vec<Coordinate>,
    /// A polynomial in x, y and the symbols that vanishes at every place of the point.
    pub polynomial: Polynomial<Int>,
    /// The number of other values, drawn at random, at which it equals the curve derived from numbers; `None` of a four-bar, of which it
    /// is derived with the symbols themselves.
    pub compared: Option<usize>,
    /// Whether at the numbers of the file the curve derived from these divides it.
    pub agrees: bool,
}

impl CurveSymbolic {
    /// Returns the degree in both coordinates.
    #[must_use]
    pub fn degree(&self) -> u64 {
        let own = |exponents: &[u32]| exponents.iter().take(2).map(|e| u64::from(*e)).sum();
        self.polynomial.terms().map(|(exponents, _)| own(&exponents)).max().unwrap_or(0)
    }
}

/// A condition on the rotation of the coupler: `right = by_cosine c + by_sine s`.
struct Condition {
    right: Space,
    by_cosine: Space,
    by_sine: Space,
}

impl Condition {
    /// Returns that of one end of the coupler; `None` where it is none of these.
    fn of(points: &Places<'_>, coupler: usize, (end, base): (usize, usize), traced: &Plane) -> Option<Self> {
        let linkage = points.linkage;
        let side = |joint: usize, body: usize| linkage.joints[joint].of.iter().position(|own| *own == body);
        let own = side(end, coupler)?;
        if linkage.joints[end].pair != Pair::Revolute {
            return None;
        }
        // From the end to the traced point, in the coupler.
        let arm = difference(traced, &points.of_joint(end, own));
        let ground = side(base, linkage.ground)?;
        let (fixed, moving) = (points.of_joint(base, ground), points.of_joint(base, 1 - ground));
        let reach = difference(&points.of_joint(end, 1 - own), &moving);
        let place: Plane = [Space::variable(0), Space::variable(1)];
        match &linkage.joints[base].pair {
            Pair::Revolute => {
                // |z - a - arm|^2 is the square of the crank.
                let from = difference(&place, &fixed);
                let right = dot(&from, &from).add(&dot(&arm, &arm)).sub(&dot(&reach, &reach));
                let twice = |p: Space| p.add(&p);
                Some(Self { right, by_cosine: twice(dot(&from, &arm)), by_sine: twice(cross(&from, &arm)) })
            }
            Pair::Prismatic { turn, along, .. } => {
                // The slide keeps its rotation; its line is fixed in the first body.
                let (turn, along) = if ground == 0 {
                    (turn.clone(), along.clone())
                } else {
                    let back = Gaussian { re: turn.re.clone(), im: Rational::from(-&turn.im) };
                    let along = back.mul(along);
                    (back, along)
                };
                let [c, s] = [constant(&turn.re), constant(&turn.im)];
                let [x, y] = &reach;
                let turned = [c.mul(x).sub(&s.mul(y)), s.mul(x).add(&c.mul(y))];
                let normal: Plane = [constant(&Rational::from(-&along.im)), constant(&along.re)];
                let from = difference(&difference(&place, &fixed), &turned);
                Some(Self { right: dot(&normal, &from), by_cosine: dot(&normal, &arm), by_sine: cross(&normal, &arm) })
            }
            Pair::Gear { .. } => None,
        }
    }

    fn is_free(&self) -> bool {
        self.by_cosine.is_zero() && self.by_sine.is_zero()
    }
}

/// Returns the polynomial of two conditions.
fn eliminated(one: &Condition, two: &Condition) -> Space {
    // The traced point is an end itself: it moves on the circle or the line of its condition.
    if let Some(own) = [one, two].into_iter().find(|condition| condition.is_free()) {
        return own.right.clone();
    }
    let minor = |a: &Space, b: &Space, c: &Space, d: &Space| a.mul(d).sub(&b.mul(c));
    let cosine = minor(&one.right, &two.right, &one.by_sine, &two.by_sine);
    let sine = minor(&one.by_cosine, &two.by_cosine, &one.right, &two.right);
    let below = minor(&one.by_cosine, &two.by_cosine, &one.by_sine, &two.by_sine);
    let square = |p: &Space| p.mul(p);
    square(&cosine).add(&square(&sine)).sub(&square(&below))
}

/// Returns the two ends of a coupler among four joints: the joint at the coupler and that of its crank or slide at the ground.
fn ends(linkage: &Linkage, joints: &[usize], coupler: usize) -> Option<[(usize, usize); 2]> {
    let other = |joint: usize, body: usize| {
        let [a, b] = linkage.joints[joint].of;
        (a == body).then_some(b).or((b == body).then_some(a))
    };
    let mut found = Vec::new();
    for end in joints {
        let Some(middle) = other(*end, coupler).filter(|body| *body != linkage.ground) else { continue };
        let base = joints.iter().copied().find(|base| base != end && other(*base, middle) == Some(linkage.ground))?;
        found.push((*end, base));
    }
    found.try_into().ok().filter(|_| joints.len() == 4)
}

/// Curves at values of the symbols.
struct Curves<'l> {
    linkage: &'l Linkage,
    given: &'l [Given],
    body: usize,
    point: usize,
    symbols: &'l [Coordinate],
    degree: u32,
}

impl Curves<'_> {
    fn at(&self, values: &[Rational]) -> Option<Polynomial<Int>> {
        let mut linkage = self.linkage.clone();
        for (symbol, value) in self.symbols.iter().zip(values) {
            symbol.put(&mut linkage, value);
        }
        let point = linkage.bodies[self.body].points[self.point].1.clone();
        Some(trace(&linkage, self.given, self.body, &point, &Watch::none()).ok()?.polynomial)
    }

    /// The exponents of x and y of all terms.
    fn powers(&self) -> impl Iterator<Item = [u32; 2]> {
        let degree = self.degree;
        (0..=degree).flat_map(move |x| (0..=degree - x).map(move |y| [x, y]))
    }
}

impl Source for Curves<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let found = self.at(values)?;
        if found.total_degree() != Some(u64::from(self.degree)) {
            return None;
        }
        let power = |exponents: &[u32], k: usize| exponents.get(k).copied().unwrap_or(0);
        let coefficient = |[x, y]: [u32; 2]| {
            let term = found.terms().find(|(exponents, _)| power(exponents, 0) == x && power(exponents, 1) == y);
            term.map_or_else(Integer::new, |(_, c)| c.to_integer())
        };
        Some(self.powers().map(coefficient).collect())
    }
}

/// Returns the curve by interpolation.
fn interpolated(mut source: Curves<'_>, watch: &Watch<'_>) -> Result<Polynomial<Int>> {
    let symbols = source.symbols;
    if symbols.len() > MOST_INTERPOLATED {
        let message = format!(
            "found {} symbols, expected one to {MOST_INTERPOLATED} in the curve of a point that is not that of the coupler of a four-bar",
            symbols.len()
        );
        return Err(Error::Unsupported(message));
    }
    let none =
        || Error::Unsupported("the point has no curve where the symbols are integers of eight digits".to_owned());
    let first = source.at(&Values::Scattered.start(symbols.len())).ok_or_else(none)?;
    source.degree = u32::try_from(first.total_degree().unwrap_or(0)).map_err(|_| none())?;
    let powers: Vec<[u32; 2]> = source.powers().collect();
    let names = symbols.iter().map(|one| one.name(source.linkage)).collect();
    let family = Family::new(&source, watch, Values::Scattered, names, powers.len());
    let terms = family.interpolated()?;
    let terms = terms
        .terms()
        .map(|(place, others, c)| (powers[place].into_iter().chain(others).collect::<Vec<u32>>(), c.clone()));
    let found = primitive(&Polynomial::from_terms(terms));
    family.compare(&found, 2, |coefficients| {
        let terms = coefficients.iter().zip(&powers).filter(|(c, _)| !c.is_zero());
        Polynomial::from_terms(terms.map(|(c, powers)| (powers.to_vec(), Rational::from(c))))
    })?;
    Ok(integers(&found))
}

/// Derives the curve of a point of a body, by its number, with coordinates of points in their bodies as symbols: those `wanted`, named as
/// `crank.B.x`, else all of the joints concerned and of the point that are not zero.
///
/// # Errors
/// As [`trace`]; [`Error::Unsupported`] for more than eight symbols, more than three where the point is not one of the coupler of a four-bar,
/// if there would be more than 100,000 terms, and where it is ended; [`Error::Invalid`] for an unknown symbol.
pub fn trace_with_symbols(
    linkage: &Linkage,
    given: &[Given],
    (body, point): (usize, usize),
    wanted: &[String],
    watch: &Watch<'_>,
) -> Result<CurveSymbolic> {
    let place: Gaussian = linkage.bodies[body].points[point].1.clone();
    let group = mover(linkage, given, body)?;
    let curve = trace(linkage, given, body, &place, watch)?;
    let all = Coordinate::with_point(linkage, &group.joints, Some((body, point)));
    let (symbols, numbers) = chosen(linkage, all, wanted, MOST_SYMBOLS)?;
    let points = Places { linkage, symbols: &symbols };
    let direct = ends(linkage, &group.joints, body).filter(|_| held(linkage, given).is_ok_and(<[Given]>::is_empty));
    let direct = direct.and_then(|[one, two]| {
        let traced = points.of_point(body, point);
        let [one, two] = [one, two].map(|end| Condition::of(&points, body, end, &traced));
        Some(eliminated(&one?, &two?)).filter(|found| !found.is_zero())
    });
    let (polynomial, compared) = if let Some(found) = direct {
        (integers(&found), None)
    } else {
        let source = Curves { linkage, given, body, point, symbols: &symbols, degree: 0 };
        (interpolated(source, watch)?, Some(COMPARED))
    };
    if polynomial.len() > MOST_TERMS {
        let message = format!("with these symbols there are {} terms, expected at most {MOST_TERMS}", polynomial.len());
        return Err(Error::Unsupported(message));
    }
    let of_file = symbols.iter().enumerate().map(|(k, one)| (2 + k, Polynomial::constant(one.value.clone())));
    let rational = polynomial.map(|c| Some(Rational::from(c.to_integer())));
    let at_file = rational.map(|rational| rational.substitute_all(&of_file.collect::<Vec<_>>()));
    // Of numbers so special that it vanishes nothing is compared.
    let agrees =
        at_file.is_some_and(|own| !own.is_zero() && integers(&own).checked_div_exact(&curve.polynomial).is_some());
    Ok(CurveSymbolic { symbols, numbers, polynomial, compared, agrees })
}
