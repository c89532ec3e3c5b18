//! The transfer function of a four-bar on the sphere, or of several in series, with sides as symbols.
//!
//! Let phi be the angle at the joint A of the ground from the great arc AD to the crank AB, and psi that at D from the arc AD, continued, to
//! the rocker DC. With the sides a, b, c and g of crank, coupler, rocker and ground the angle between B and C says
//!
//! `sin a cos phi (sin g cos c + cos g sin c cos psi) + sin a sin c sin phi sin psi + cos a (cos g cos c - sin g sin c cos psi) = cos b`.
//!
//! In a series psi and the next phi differ by a constant angle, and psi is eliminated from two equations that are quadratic in the tangent
//! of its half.

use super::transfer::{circle, eliminated, without_circles};
use super::{FourBar, axis, series};
use crate::algebra::int::Int;
use crate::algebra::number::nearest_f64;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::motion::{cross, dot};
use crate::kinematics::sphere::{Direction, SphereLinkage, across};
use crate::linkage::sphere::start;
use looproot_calculus::rotation::matrix::{apply, transpose};
use looproot_calculus::unit::Root;
use rug::Rational;

/// The longest polynomial, as of all polynomials with symbols.
const MOST_TERMS: usize = 100_000;

/// A polynomial in the half-angle tangents of input and output and in the symbols.
type Symbolic = Polynomial<Rational>;

/// An angle of which cosine and sine are symbols.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereSymbol {
    /// The name in those of its cosine and sine: `c_crank_A_B`, `s_crank_A_B`, or `c_turn_D`.
    pub name: String,
    /// What it is, in words.
    pub meaning: String,
    /// Its value in the file, radians.
    pub value: f64,
}

/// An end of the relation: an angle at the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereEnd {
    /// The joint.
    pub joint: usize,
    /// The angle from the arc of the ground is `sign` times the value of the joint plus `offset`, radians.
    pub sign: f64,
    /// See `sign`.
    pub offset: f64,
}

/// The relation with sides as symbols.
#[derive(Clone, Debug)]
pub struct SphereSymbolic {
    /// The angles of which half the tangents are the variables 0 and 1.
    pub ends: [SphereEnd; 2],
    /// The bodies of every four-bar in the series.
    pub bodies: Vec<[usize; 4]>,
    /// The symbols: cosine and sine of the first one are the variables 2 and 3, and so on. Right angles, 0 and half a turn keep their
    /// numbers.
    pub symbols: Vec<SphereSymbol>,
    /// The polynomial.
    pub polynomial: Polynomial<Int>,
}

/// The symbols so far, and the names of those that are wanted: all if there are none.
struct Symbols<'w>(Vec<SphereSymbol>, &'w [String]);

impl Symbols<'_> {
    /// Returns cosine and sine of an angle from a number proportional to the cosine and the square of one proportional to the sine, with the
    /// sign of the sine. An angle that is not wanted has its numbers, where they are rational; of the sides of couplers the cosine is needed.
    fn add(&mut self, symbol: SphereSymbol, [x, y]: [&Rational; 2], is_coupler: bool) -> [Symbolic; 2] {
        let sign = |q: &Rational| Symbolic::constant(Rational::from(q.cmp0() as i32));
        if *x == 0 || *y == 0 {
            return [sign(x), sign(y)];
        }
        let number = |q: Option<Rational>| q.map(Symbolic::constant);
        let mut own = [None, None];
        if !self.1.is_empty() && !self.1.contains(&symbol.name) {
            let size = Rational::from(y.abs_ref());
            let square = Rational::from(x * x) + &size;
            let over = |q: Rational| Rational::sqrt(&(q / &square));
            let cosine = over(Rational::from(x * x)).map(|c| if *x < 0 { -c } else { c });
            let sine = over(size).map(|s| if *y < 0 { -s } else { s });
            own = [number(cosine), number(sine)];
        }
        if own[0].is_none() || (own[1].is_none() && !is_coupler) {
            self.0.push(symbol);
        }
        let last = self.0.len();
        let [cosine, sine] = own;
        [
            cosine.unwrap_or_else(|| Symbolic::variable(2 * last)),
            sine.unwrap_or_else(|| Symbolic::variable(2 * last + 1)),
        ]
    }

    /// Returns cosine and sine of the side of a body between two joints.
    fn side(&mut self, linkage: &SphereLinkage, four: &FourBar, side: usize) -> [Symbolic; 2] {
        let [first, second, third, fourth] = four.joints;
        let [one, two] = [[first, fourth], [first, second], [second, third], [fourth, third]][side];
        let body = four.bodies[side];
        let (p, q) = (axis(linkage, one, body), axis(linkage, two, body));
        let normal = cross(p, q);
        let (cosine, square) = (dot(p, q), dot(&normal, &normal));
        let names = [one, two].map(|joint| linkage.joints[joint].name.as_str());
        let own = &linkage.bodies[body].name;
        let name = format!("{own}_{}_{}", names[0], names[1]);
        let meaning = format!("the side of {own} from {} to {}", names[0], names[1]);
        let value = nearest_f64(&square).sqrt().atan2(nearest_f64(&cosine));
        self.add(SphereSymbol { name, meaning, value }, [&cosine, &square], side == 2)
    }
}

/// Returns cosine and sine, the latter over the length of the axis, of the angle about it from one direction to another, up to a positive
/// factor.
fn between(about: &Direction, from: &Direction, to: &Direction) -> [Rational; 2] {
    let [from, to] = [from, to].map(|v| across(about, v));
    [dot(&from, &to), dot(about, &cross(&from, &to)) / dot(about, about)]
}

/// Returns an angle in radians of such numbers.
fn radians(about: &Direction, [cosine, sine]: &[Rational; 2]) -> f64 {
    (nearest_f64(sine) * nearest_f64(&dot(about, about)).sqrt()).atan2(nearest_f64(cosine))
}

/// Returns cosine and sine of the angle whose half tangent is a variable, times `1 + t^2`.
fn tangent(variable: usize) -> [Symbolic; 2] {
    let t = Symbolic::variable(variable);
    [Symbolic::one().sub(&t.mul(&t)), t.add(&t)]
}

/// Returns the sum of two angles.
fn turned([c, s]: &[Symbolic; 2], [x, y]: &[Symbolic; 2]) -> [Symbolic; 2] {
    [c.mul(x).sub(&s.mul(y)), s.mul(x).add(&c.mul(y))]
}

/// Returns the equation of a four-bar, `1 + t^2` and `1 + s^2` multiplied out.
fn equation(linkage: &SphereLinkage, four: &FourBar, phi: &[Symbolic; 2], symbols: &mut Symbols<'_>) -> Symbolic {
    let [[cos_g, sin_g], [cos_a, sin_a], [cos_b, _], [cos_c, sin_c]] =
        [0, 1, 2, 3].map(|side| symbols.side(linkage, four, side));
    let psi = tangent(1);
    let ([one, two], both) = ([circle(0), circle(1)], circle(0).mul(&circle(1)));
    let product = |factors: &[&Symbolic]| factors.iter().fold(Symbolic::one(), |product, factor| product.mul(factor));
    let terms = [
        product(&[&sin_a, &phi[0], &sin_g, &cos_c, &two]),
        product(&[&sin_a, &phi[0], &cos_g, &sin_c, &psi[0]]),
        product(&[&sin_a, &sin_c, &phi[1], &psi[1]]),
        product(&[&cos_a, &cos_g, &cos_c, &both]),
        product(&[&cos_a, &sin_g, &sin_c, &psi[0], &one]).neg(),
        cos_b.mul(&both).neg(),
    ];
    terms.iter().fold(Symbolic::zero(), |sum, term| sum.add(term))
}

/// Returns the constant angle between the psi of a four-bar and the phi of the next one at the same joint.
fn step(linkage: &SphereLinkage, [before, next]: [&FourBar; 2], symbols: &mut Symbols<'_>) -> [Symbolic; 2] {
    let joint = next.joints[0];
    let (ground, rocker) = (next.bodies[0], next.bodies[1]);
    let (at_ground, at_rocker) = (axis(linkage, joint, ground), axis(linkage, joint, rocker));
    let of_rocker = between(at_rocker, axis(linkage, before.joints[2], rocker), axis(linkage, next.joints[1], rocker));
    let back = axis(linkage, before.joints[0], ground).each_ref().map(|c| Rational::from(-c));
    let of_ground = between(at_ground, &back, axis(linkage, next.joints[3], ground));
    let square = dot(at_ground, at_ground);
    let [[p, q], [x, y]] = [&of_rocker, &of_ground];
    let cosine = Rational::from(p * x) + Rational::from(q * y) * &square;
    let sine = Rational::from(q * x) - Rational::from(p * y);
    let value = radians(at_ground, &[cosine.clone(), sine.clone()]);
    let name = &linkage.joints[joint].name;
    let meaning = format!(
        "at {name} the angle from the rocker of one four-bar to the crank of the next, less that of the arcs of the ground"
    );
    let part = Rational::from(sine.abs_ref()) * &sine * square;
    symbols.add(SphereSymbol { name: format!("turn_{name}"), meaning, value }, [&cosine, &part], false)
}

/// Returns an end of the relation: the angle at a joint of the ground from a direction there to one of the moving body.
fn end(linkage: &SphereLinkage, joint: usize, [from, to]: [&Direction; 2]) -> SphereEnd {
    let is_second = linkage.joints[joint].of[1] != linkage.ground;
    let zero = start(linkage, joint);
    let zero = if is_second { zero } else { transpose(&zero) };
    let about = axis(linkage, joint, linkage.ground);
    let offset = radians(about, &between(about, from, &apply(&zero, to)));
    SphereEnd { joint, sign: if is_second { 1.0 } else { -1.0 }, offset }
}

/// Derives the relation of the angle of a joint at the ground to that of the last rocker behind it, with the sides of all bodies as symbols, or
/// those of these names: those that are no right angles. Of a side that is not named cosine and sine are numbers where they are rational.
///
/// # Errors
/// [`Error::Unsupported`] if the crank of the joint belongs to no four-bar, and for more than 100,000 terms; [`Error::Invalid`] for a
/// name that no side has.
pub fn sphere_with_symbols(linkage: &SphereLinkage, input: usize, wanted: &[String]) -> Result<SphereSymbolic> {
    if let Some(known) = (!wanted.is_empty()).then(|| sphere_with_symbols(linkage, input, &[])).transpose()? {
        let names: Vec<&str> = known.symbols.iter().map(|one| one.name.as_str()).collect();
        if let Some(name) = wanted.iter().find(|name| !names.contains(&name.as_str())) {
            let name: String = name.chars().take(40).collect();
            let message = format!("found the symbol {name}, expected a given joint or some of {}", names.join(", "));
            return Err(Error::Invalid(message));
        }
    }
    let fours = series(linkage, input)?;
    let mut symbols = Symbols(Vec::new(), wanted);
    let mut relation: Option<Symbolic> = None;
    for (k, four) in fours.iter().enumerate() {
        let phi = match k.checked_sub(1) {
            None => tangent(0),
            Some(before) => turned(&tangent(0), &step(linkage, [&fours[before], four], &mut symbols)),
        };
        let next = equation(linkage, four, &phi, &mut symbols);
        relation = Some(relation.map_or_else(|| next.clone(), |first| eliminated(&first, &next)));
    }
    let none = || Error::Unsupported("the relation vanishes for all angles".to_owned());
    let polynomial = without_circles(relation.filter(|p| !p.is_zero()).ok_or_else(none)?.primitive().0);
    if polynomial.len() > MOST_TERMS {
        let message =
            format!("with all sides as symbols there are {} terms, expected at most {MOST_TERMS}", polynomial.len());
        return Err(Error::Unsupported(message));
    }
    let (first, last) = fours.first().zip(fours.last()).ok_or_else(none)?;
    let ground = linkage.ground;
    let back = axis(linkage, last.joints[0], ground).each_ref().map(|c| Rational::from(-c));
    let ends = [
        end(linkage, input, [axis(linkage, first.joints[3], ground), axis(linkage, first.joints[1], first.bodies[1])]),
        end(linkage, last.joints[3], [&back, axis(linkage, last.joints[2], last.bodies[3])]),
    ];
    Ok(SphereSymbolic { ends, bodies: fours.iter().map(|four| four.bodies).collect(), symbols: symbols.0, polynomial })
}
