//! Curves of points of linkages that move with one freedom, in the coordinate rings of their sections with lines or planes.
//!
//! The equations of the linkage and a linear form of the place, `x + k y = c` or `x + k y + l z = c`, have finitely many solutions: the
//! assemblies with the point on a line or a plane. In the ring of these the powers of y, on the sphere also their products with z, have a
//! relation of least degree, whose coefficients are interpolated in c. With the form for c that is the curve. It is compared with sections in
//! directions drawn at random, so that lines of the first direction, which its sections miss, are noticed.

use super::coordinate_ring::{Columns, CoordinateRing, Solutions, dependence, rank};
use super::equation::primitive;
use super::interpolation::{COMPARED, Family, PASSED_OVER, Source, Values, Watch};
use crate::algebra::drawn;
use crate::algebra::groebner::Equation;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::{Integer, Rational};

/// The factors of y and z in the form: neither along an axis nor halfway between two, as lines of points often are. Another one is taken
/// where a line of the curve has the direction of one.
const FORMS: [[i32; 2]; 3] = [[2, 3], [3, -2], [-5, 7]];
/// Products of words that the basis of a section may take, about a second: some dozens of them are needed.
const EFFORT: u64 = 300_000_000;
/// Factors and values of sections drawn for comparison are at most so large: a wrong polynomial of degree 96, the highest, equals all 20 by
/// chance with a probability below `(96/1024 + 96/2^20)^20 < 2^-60`.
const DRAWN: [u32; 2] = [1 << 10, 1 << 20];

/// The places of a point while its linkage moves with one freedom.
pub(super) struct Track {
    /// The number of unknowns.
    pub unknowns: usize,
    /// The polynomials that vanish at the assemblies.
    pub equations: Vec<Equation>,
    /// The coordinates of the point: two, or three on a sphere.
    pub at: Vec<Equation>,
    /// The square of the radius, where the point is on a sphere about the origin.
    pub square: Option<Rational>,
}

/// What the point has in common with the lines or planes of one direction.
struct Sections<'t> {
    track: &'t Track,
    form: Vec<Rational>,
    degree: usize,
}

fn number(q: &Rational) -> Equation {
    Equation::from_rational(q).unwrap_or_else(Equation::zero)
}

fn constant(q: &Rational) -> Polynomial<Rational> {
    Polynomial::constant(q.clone())
}

/// Returns the remainder of a polynomial modulo one that has the degree 2 in a variable, with a number for the coefficient of the square.
fn modulo(polynomial: &Polynomial<Rational>, quadric: &Polynomial<Rational>, variable: usize) -> Polynomial<Rational> {
    let lead = quadric.coefficients_in(variable).get(2).and_then(Polynomial::to_constant);
    let Some(lead) = lead.filter(|lead| !lead.is_zero()) else { return polynomial.clone() };
    let monic = quadric.scale(&lead.recip());
    let mut rest = polynomial.clone();
    while rest.degree(variable) > 1 {
        let power = rest.degree(variable);
        let Some(highest) = rest.coefficients_in(variable).pop() else { break };
        rest = rest.sub(&highest.mul(&Polynomial::variable(variable).pow(power - 2)).mul(&monic));
    }
    rest
}

impl Track {
    /// Returns the polynomial of the sphere, in variables 0, 1 and 2.
    fn sphere(&self) -> Option<Polynomial<Rational>> {
        let squares = (0..3).map(|k| Polynomial::<Rational>::variable(k).pow(2));
        Some(squares.fold(constant(self.square.as_ref()?).neg(), |sum, square| sum.add(&square)))
    }

    /// Returns the ring of a section.
    fn section(&self, form: &[Rational], level: &Rational) -> Option<Solutions> {
        let terms = form.iter().zip(&self.at[1..]).map(|(k, c)| c.mul(&number(k)));
        let sum = terms.fold(self.at[0].sub(&number(level)), |sum, term| sum.add(&term));
        let equations: Vec<Equation> = self.equations.iter().cloned().chain([sum]).collect();
        CoordinateRing::of(self.unknowns, &equations, EFFORT)
    }

    /// Returns the products of coordinates of which a curve of this degree is a sum: powers of y, and of z below 2.
    fn products(&self, ring: &CoordinateRing, degree: usize) -> Option<Columns> {
        let mut starts = vec![(Equation::one(), degree + 1)];
        if self.square.is_some() {
            starts.push((self.at[2].clone(), degree));
        }
        ring.products(&self.at[1], &starts)
    }

    /// Returns their exponents of y and z.
    fn powers(&self, degree: usize) -> Vec<[u32; 2]> {
        let power = |k: usize| u32::try_from(k).unwrap_or(u32::MAX);
        let plain = (0..=degree).map(|k| [power(k), 0]);
        let others = (0..if self.square.is_some() { degree } else { 0 }).map(|k| [power(k), 1]);
        plain.chain(others).collect()
    }

    /// Returns the degree of the curve, on the sphere that of a surface through it, and the number of assemblies of a section; `None` where the form
    /// rests.
    fn degree(&self, form: &[Rational]) -> Result<Option<(usize, usize)>> {
        let unsupported = |what: String| Error::Unsupported(format!("the curve of this point is not derived: {what}"));
        let too_much = || {
            unsupported(
                "the Gröbner basis of a section takes more work than is allowed, or has too many solutions".to_owned(),
            )
        };
        match self.section(form, &Values::Small.first(0)).ok_or_else(too_much)? {
            Solutions::None => Ok(None),
            Solutions::Set(dimension) => Err(unsupported(format!(
                "the assemblies with the point on a line form a set of dimension {dimension}, complex ones counted"
            ))),
            Solutions::Finite(ring) => {
                let found = self.products(&ring, ring.dimension()).and_then(|columns| rank(&columns));
                let places = found.ok_or_else(too_much)?;
                // A surface of degree m meets the sphere and a plane in 2 m points.
                let degree = if self.square.is_some() { places.div_ceil(2) } else { places };
                Ok(Some((degree, ring.dimension())))
            }
        }
    }

    /// Returns the polynomial that vanishes at every place of the point, in its coordinates: primitive, and on the sphere of degree 1 at most
    /// in z; and the number of assemblies of a section, with multiplicity. It equals sections drawn at random, as many as [`COMPARED`], and
    /// has no proof. `None` for a point that rests.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where a section takes too much work or does not consist of points, and where the
    /// derivation is ended.
    pub fn curve(&self, watch: &Watch<'_>) -> Result<Option<(Polynomial<Int>, usize)>> {
        for form in FORMS {
            let form: Vec<Rational> = form.into_iter().take(self.at.len() - 1).map(Rational::from).collect();
            let Some((degree, assemblies)) = self.degree(&form)? else { return Ok(None) };
            let sections = Sections { track: self, form, degree };
            let found = sections.interpolated(watch)?;
            if self.compare(&found, degree, watch)? {
                return Ok(Some((found.primitive().0, assemblies)));
            }
        }
        Err(Error::Unsupported("the curve of this point is not derived: it has lines in many directions".to_owned()))
    }

    /// Returns whether a polynomial has the sections in directions drawn at random.
    fn compare(&self, found: &Polynomial<Rational>, degree: usize, watch: &Watch<'_>) -> Result<bool> {
        let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
        let mut compared = 0;
        for _ in 0..COMPARED + PASSED_OVER {
            let form = self.at[1..].iter().map(|_| Rational::from(random.random_range(1..=DRAWN[0]))).collect();
            let level = Rational::from(random.random_range(1..=DRAWN[1]));
            if watch.is_ended() {
                break;
            }
            let sections = Sections { track: self, form, degree };
            let expected = sections.coefficients(std::slice::from_ref(&level));
            (watch.step)();
            let Some(expected) = expected else { continue };
            if sections.restricted(found, &level) != sections.polynomial(&expected) {
                return Ok(false);
            }
            compared += 1;
            if compared == COMPARED {
                return Ok(true);
            }
        }
        let message = if watch.is_ended() {
            "the derivation was stopped before its end"
        } else {
            "the curve of this point is not derived: sections drawn at random have no relation of one degree"
        };
        Err(Error::Unsupported(message.to_owned()))
    }
}

impl Sections<'_> {
    /// Returns the form of the coordinates with another sign for y and z, and this instead of x.
    fn first(&self, level: &Polynomial<Rational>, sign: i32) -> Polynomial<Rational> {
        let terms = self.form.iter().enumerate();
        let terms = terms.map(|(k, factor)| Polynomial::variable(1 + k).scale(&Rational::from(factor * sign)));
        terms.fold(level.clone(), |sum, term| sum.add(&term))
    }

    /// Returns the curve, with the form in the place of the level.
    fn interpolated(&self, watch: &Watch<'_>) -> Result<Polynomial<Rational>> {
        let powers = self.track.powers(self.degree);
        let family = Family::new(self, watch, Values::Small, vec!["a coordinate".to_owned()], powers.len());
        let interpolated = family.interpolated()?;
        let terms = interpolated.terms().map(|(place, level, c)| {
            let exponents: Vec<u32> = level.into_iter().chain(powers[place]).collect();
            (exponents, c.clone())
        });
        let at_level = Polynomial::from_terms(terms);
        let found = at_level.substitute(0, &self.first(&Polynomial::variable(0), 1));
        let found = self.track.sphere().map_or_else(|| found.clone(), |sphere| modulo(&found, &sphere, 2));
        Ok(primitive(&found))
    }

    /// Returns the relation of a section as a polynomial in y and z.
    fn polynomial(&self, coefficients: &[Integer]) -> Polynomial<Rational> {
        let powers = self.track.powers(self.degree);
        let terms = powers.iter().zip(coefficients).map(|([y, z], c)| (vec![0, *y, *z], Rational::from(c)));
        primitive(&Polynomial::from_terms(terms))
    }

    /// Returns what a polynomial is on a section.
    fn restricted(&self, found: &Polynomial<Rational>, level: &Rational) -> Polynomial<Rational> {
        let first = self.first(&constant(level), -1);
        let own = found.substitute(0, &first);
        let own =
            self.track.sphere().map_or_else(|| own.clone(), |sphere| modulo(&own, &sphere.substitute(0, &first), 2));
        primitive(&own)
    }
}

impl Source for Sections<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let Solutions::Finite(ring) = self.track.section(&self.form, values.first()?)? else { return None };
        dependence(&self.track.products(&ring, self.degree)?)
    }
}
