//! Follows a constant K of a 5R loop from one choice of twists to all others.
//!
//! On a curve of tied joints the discriminant D times a known denominator is the square of a polynomial S in one tangent.
//! If K and S are isolated solutions of `S^2 = D`, they are power series in a parameter along every line of twists, by
//! Newton's method. If the series of K is that of a rational function, K is known all along the line, on the same branch.

use super::curve_ansatz::Tie;
use super::finite_field::square_root;
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::series::Series;
use crate::algebra::univariate::Univariate;
use crate::catalogue::ansatz::{Ansatz, Link};
use rug::Rational;

/// The field in which branches are followed.
pub(super) type Image = ModP<PRIME_61>;

/// Number of coefficients of the power series: enough for rational functions with numerator and denominator of degree 7.
const ORDER: usize = 18;

/// A power series; it has an inverse if its constant coefficient is not 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Local(Series<Image, ORDER>);

impl Local {
    /// Returns `start + slope eps`.
    fn line(start: Image, slope: Image) -> Self {
        let mut series = Series::constant(start);
        series.coefficients[1] = slope;
        Self(series)
    }
}

impl Ring for Local {
    fn zero() -> Self {
        Self(Series::zero())
    }
    fn one() -> Self {
        Self(Series::one())
    }
    fn add(&self, other: &Self) -> Self {
        Self(self.0.add(&other.0))
    }
    fn sub(&self, other: &Self) -> Self {
        Self(self.0.sub(&other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Self(self.0.mul(&other.0))
    }
    fn neg(&self) -> Self {
        Self(self.0.neg())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Series::from_rational(q).map(Self)
    }
}

impl Field for Local {
    fn inverse(&self) -> Option<Self> {
        let first = self.0.coefficients[0].inverse()?;
        let mut inverse = Series::constant(first);
        for k in 1..ORDER {
            let products = (1..=k).map(|j| self.0.coefficients[j].mul(&inverse.coefficients[k - j]));
            inverse.coefficients[k] = products.fold(Image::zero(), |sum, x| sum.sub(&x)).mul(&first);
        }
        Some(Self(inverse))
    }
    fn pivot_size(&self) -> f64 {
        self.0.coefficients[0].pivot_size()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

/// Returns the loop of an ansatz without lengths, for half-angle tangents of its free angles; `None` if the square of one is -1.
pub(super) fn spherical_loop<F: Field>(ansatz: &Ansatz, tangents: &[F]) -> Option<Vec<Link<F>>> {
    let mut angles = vec![(F::one(), F::zero()); ansatz.symbols.angles.len()];
    for (&angle, t) in ansatz.free_angles().iter().zip(tangents) {
        angles[angle] = super::finite_field::half_tangent_turn(t)?;
    }
    let link = |joint: usize| {
        let (cos, sin) = ansatz.twist(joint).cos_sin(&angles)?;
        Some(Link { cos, sin, a: F::zero(), d: F::zero() })
    };
    (0..ansatz.joints.len()).map(link).collect()
}

/// A branch at one choice of twists.
pub(super) struct Branch<'a> {
    ansatz: &'a Ansatz,
    tie: Tie,
    base: Vec<Image>,
    constant: Image,
    root: Vec<Image>,
    /// Tangents at which the equation is evaluated, and the corrections of S and K for an error of 1 at one of them.
    places: Vec<Image>,
    corrections: Vec<Vec<Image>>,
}

/// Number of coefficients of S, which has degree 4.
const ROOT: usize = 5;

impl<'a> Branch<'a> {
    /// Returns the branch of a constant K at some tangents of the free angles; `None` if K is not isolated.
    pub(super) fn new(ansatz: &'a Ansatz, tie: Tie, base: &[Image], constant: Image) -> Option<Self> {
        let links = spherical_loop(ansatz, base)?;
        let tangents: Vec<Image> = (2..14).map(Image::new).collect();
        let root = super::curve_ansatz::separated(&links, tie, &constant, &tangents, |x| square_root(*x))?;
        let mut root = root.coefficients().to_vec();
        root.resize(ROOT, Image::zero());
        let local = spherical_loop(ansatz, &base.iter().map(|t| Local::line(*t, Image::zero())).collect::<Vec<_>>())?;
        let moving = Local::line(constant, Image::one());
        let mut rows: Vec<Vec<Image>> = Vec::new();
        let polynomial = Univariate::new(root.clone());
        for x in &tangents {
            let twice = polynomial.eval(x).mul(&Image::new(2));
            let mut power = Image::one();
            let mut row = Vec::new();
            for _ in 0..ROOT {
                row.push(twice.mul(&power));
                power = power.mul(x);
            }
            row.push(square(&local, tie, &Local::line(*x, Image::zero()), &moving)?.0.coefficients[1].neg());
            rows.push(row);
        }
        let echelon = Echelon::of(rows.clone(), ROOT + 1);
        if echelon.rank() < ROOT + 1 {
            return None;
        }
        let chosen = echelon.independent_rows().to_vec();
        let unknowns = ROOT + 1;
        let augmented = (0..unknowns).map(|i| {
            let unit = (0..unknowns).map(|j| if i == j { Image::one() } else { Image::zero() });
            rows[chosen[i]].iter().copied().chain(unit).collect::<Vec<_>>()
        });
        let inverse = Echelon::among(augmented.collect(), 2 * unknowns, unknowns);
        let mut corrections = vec![Vec::new(); unknowns];
        for (row, &pivot) in inverse.rows().iter().zip(inverse.pivots()) {
            corrections[pivot] = row[unknowns..].to_vec();
        }
        let places = chosen.iter().map(|&i| tangents[i]).collect();
        Some(Self { ansatz, tie, base: base.to_vec(), constant, root, places, corrections })
    }

    /// Returns K along the line from the base in a direction, as a rational function of the parameter; `None` if it is none
    /// of low degree.
    pub(super) fn along(&self, direction: &[Image]) -> Option<(Univariate<Image>, Univariate<Image>)> {
        let tangents: Vec<Local> = self.base.iter().zip(direction).map(|(t, u)| Local::line(*t, *u)).collect();
        let links = spherical_loop(self.ansatz, &tangents)?;
        let mut unknown: Vec<Local> =
            self.root.iter().chain([&self.constant]).map(|c| Local::line(*c, Image::zero())).collect();
        for order in 1..ORDER {
            let mut residuals = Vec::new();
            for x in &self.places {
                let x = Local::line(*x, Image::zero());
                let root = unknown[..ROOT].iter().rev().fold(Local::zero(), |sum, c| sum.mul(&x).add(c));
                let off = root.mul(&root).sub(&square(&links, self.tie, &x, &unknown[ROOT])?);
                residuals.push(off.0.coefficients[order]);
            }
            for (value, row) in unknown.iter_mut().zip(&self.corrections) {
                let correction = row.iter().zip(&residuals).fold(Image::zero(), |sum, (c, r)| sum.sub(&c.mul(r)));
                value.0.coefficients[order] = value.0.coefficients[order].add(&correction);
            }
        }
        rational_function(&unknown[ROOT].0.coefficients)
    }

    /// Returns the tangents at a point of a line.
    pub(super) fn at(&self, direction: &[Image], parameter: &Image) -> Vec<Image> {
        self.base.iter().zip(direction).map(|(t, u)| t.add(&u.mul(parameter))).collect()
    }
}

/// Returns D times the square of its denominator.
fn square(links: &[Link<Local>], tie: Tie, x: &Local, constant: &Local) -> Option<Local> {
    let (_, triad) = tie.triad(links, x, constant)?;
    let denominator = tie.denominator(x, constant);
    Some(triad.discriminant().mul(&denominator).mul(&denominator))
}

/// Returns the rational function of a power series, by Euclid's algorithm; `None` unless two more coefficients than
/// determine it agree.
fn rational_function(series: &[Image]) -> Option<(Univariate<Image>, Univariate<Image>)> {
    let mut power = vec![Image::zero(); series.len()];
    power.push(Image::one());
    let (mut larger, mut smaller) = (Univariate::new(power), Univariate::new(series.to_vec()));
    let (mut before, mut factor) = (Univariate::constant(Image::zero()), Univariate::constant(Image::one()));
    let most = (series.len() - 3) / 2;
    while smaller.degree().is_some_and(|degree| degree > most) {
        let (quotient, rest) = larger.div_rem(&smaller);
        let next = before.sub(&quotient.mul(&factor));
        (larger, smaller) = (smaller, rest);
        (before, factor) = (factor, next);
    }
    (factor.degree()? <= most && !factor.eval(&Image::zero()).is_zero()).then_some((smaller, factor))
}
