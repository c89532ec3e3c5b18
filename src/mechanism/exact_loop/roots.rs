//! The roots of a square-free polynomial, real or complex, each in a disc of its own as small as one likes.

use crate::algebra::disc::Disc;
use crate::algebra::long_float::{LongFloat, LongerFloat};
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::solve::polynomial_roots::polynomial_roots;
use crate::solve::scalar::Extended;
use rug::{Float, Rational};

/// Bits in which roots are separated first.
const FIRST_BITS: u32 = 320;
/// Steps of Newton's method: enough to get from 384 bits to any precision in use.
const STEPS: u32 = 8;

/// One root of a polynomial.
#[derive(Clone, Debug)]
pub(crate) enum Root {
    /// A rational number.
    Rational(Rational),
    /// `middle + sign sqrt(square)`, with a sign of 1 or -1; real where the square is positive.
    Quadratic {
        /// Half the sum of both roots.
        middle: Rational,
        /// The square of half their difference.
        square: Rational,
        /// The sign of the square root.
        sign: i32,
    },
    /// A real root.
    Real(RealRoot),
    /// The only root in a disc, and not a real one.
    Complex(Univariate<Rational>, Disc),
}

impl Root {
    /// Whether it is a real number.
    pub fn is_real(&self) -> bool {
        match self {
            Self::Rational(_) | Self::Real(_) => true,
            Self::Quadratic { square, .. } => *square > 0,
            Self::Complex(..) => false,
        }
    }

    /// Returns the root to about `bits` bits; `None` where that is not possible.
    pub fn ball(&self, bits: u32) -> Option<Disc> {
        match self {
            Self::Rational(q) => Some(Disc::of(q, bits)),
            Self::Quadratic { middle, square, sign } => {
                let half = Disc::of(square, bits).sqrt()?;
                let half = if *sign < 0 { half.neg() } else { half };
                Some(Disc::of(middle, bits).add(&half))
            }
            Self::Real(root) => {
                let mut root = root.clone();
                let (low, high) = root.bounds();
                let size = low.abs().max(high.abs()).max(Rational::from(1));
                root.refine(&(size >> bits));
                let (low, high) = root.bounds();
                Some(Disc::between(&low, &high, bits + 8))
            }
            Self::Complex(polynomial, known) => {
                if bits <= FIRST_BITS {
                    return Some(known.clone());
                }
                let better = improved(polynomial, known, bits)?;
                let centre = Disc::point(known.re.clone(), known.im.clone());
                let away = better.sub(&centre).at_most();
                (away <= *known.radius()).then_some(better)
            }
        }
    }
}

/// Returns all roots of a square-free polynomial; `None` where complex ones could not be separated.
pub(crate) fn roots(polynomial: &Univariate<Rational>) -> Option<Vec<Root>> {
    match polynomial.coefficients() {
        [] | [_] => Some(Vec::new()),
        [constant, factor] => Some(vec![Root::Rational(-Rational::from(constant / factor))]),
        [constant, linear, factor] => Some(quadratic(constant, linear, factor).into()),
        _ => many(polynomial),
    }
}

/// `middle + factor sqrt(square)`.
pub(crate) fn surd(middle: &Rational, factor: &Rational, square: &Rational) -> Root {
    let whole = Rational::from(factor * factor) * square;
    let sign = if *factor < 0 { -1 } else { 1 };
    if whole >= 0 && whole.numer().is_perfect_square() && whole.denom().is_perfect_square() {
        let half = Rational::from((whole.numer().clone().sqrt(), whole.denom().clone().sqrt()));
        return Root::Rational(half * sign + middle);
    }
    Root::Quadratic { middle: middle.clone(), square: whole, sign }
}

/// The roots of a polynomial of degree 2 at most, and how many coincide.
pub(crate) fn roots_with_multiplicity(polynomial: &Univariate<Rational>) -> Vec<(Root, usize)> {
    match polynomial.coefficients() {
        [constant, linear, factor] => {
            let [one, other] = quadratic(constant, linear, factor);
            match (&one, &other) {
                (Root::Rational(x), Root::Rational(y)) if x == y => vec![(one, 2)],
                _ => vec![(one, 1), (other, 1)],
            }
        }
        [constant, factor] => vec![(Root::Rational(-Rational::from(constant / factor)), 1)],
        _ => Vec::new(),
    }
}

fn quadratic(constant: &Rational, linear: &Rational, factor: &Rational) -> [Root; 2] {
    let middle: Rational = -Rational::from(linear / factor) / 2;
    let square = Rational::from(&middle * &middle) - Rational::from(constant / factor);
    [-1, 1].map(|sign| surd(&middle, &Rational::from(sign), &square))
}

/// The roots of a polynomial of degree 3 or more.
fn many(polynomial: &Univariate<Rational>) -> Option<Vec<Root>> {
    let degree = polynomial.degree()?;
    let mut found: Vec<Root> = Vec::new();
    for mut root in polynomial.real_roots() {
        found.push(root.rational().map_or(Root::Real(root), Root::Rational));
    }
    let pairs = (degree - found.len()) / 2;
    if pairs > 0 {
        let upper = upper::<LongFloat>(polynomial, pairs).or_else(|| upper::<LongerFloat>(polynomial, pairs))?;
        for disc in upper {
            let (re, im) = (disc.re.clone(), -disc.im.clone());
            let lower = Disc::new(re, im, disc.radius());
            found.extend([disc, lower].map(|disc| Root::Complex(polynomial.clone(), disc)));
        }
    }
    Some(found)
}

/// Returns the discs of the roots above the real line, of which there are `pairs`.
fn upper<R: Extended>(polynomial: &Univariate<Rational>, pairs: usize) -> Option<Vec<Disc>> {
    // Coefficients of some hundred digits would be infinite as f64.
    let largest = polynomial.coefficients().iter().max_by(|a, b| a.cmp_abs(b))?;
    let rounded: Univariate<R> = polynomial.map(|c| R::from_rational(&Rational::from(c / largest)))?;
    let mut discs = Vec::new();
    for root in polynomial_roots(&rounded)? {
        if root.im.to_f64() > 0.0 {
            let start = Disc::point(long(root.re), long(root.im));
            let disc = improved(polynomial, &start, FIRST_BITS)?;
            if Float::with_val(64, &disc.im) > *disc.radius() {
                discs.push(disc);
            }
        }
    }
    let is_apart = |a: &Disc, b: &Disc| a.sub(b).at_least() > Float::with_val(64, a.radius() + b.radius());
    let all_apart = (1..discs.len()).all(|k| discs[..k].iter().all(|other| is_apart(&discs[k], other)));
    (all_apart && discs.len() == pairs).then_some(discs)
}

/// All digits of a number.
pub(crate) fn long<R: Extended>(mut x: R) -> Float {
    let mut sum = Float::new(R::BITS + 64);
    for _ in 0..R::BITS / 48 {
        let part = x.to_f64();
        sum += part;
        x = x.sub(&R::from(part));
    }
    sum
}

/// A disc with a root in it near a centre, by Newton's method: there is a root within `n |f/f'|` of every number.
fn improved(polynomial: &Univariate<Rational>, start: &Disc, bits: u32) -> Option<Disc> {
    let bits = bits + 64;
    let slope = polynomial.derivative();
    let mut at = Disc::point(Float::with_val(bits, &start.re), Float::with_val(bits, &start.im));
    let correction = |at: &Disc| -> Option<Disc> {
        Some(at.evaluate(polynomial.coefficients()).mul(&at.evaluate(slope.coefficients()).inverse()?))
    };
    for _ in 0..STEPS {
        let step = correction(&at)?;
        let next = at.sub(&step);
        at = Disc::point(Float::with_val(bits, &next.re), Float::with_val(bits, &next.im));
        if step.at_most() < Float::with_val(64, 1) >> (bits - 40) {
            break;
        }
    }
    let step = correction(&at)?;
    let degree = u32::try_from(polynomial.degree()?).ok()?;
    Some(Disc::new(at.re, at.im, &Float::with_val(64, step.at_most() * (degree + 1))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_root_has_a_disc_of_its_own() {
        // (x^2 + 1)(x^2 - 2)(x - 3)(x^2 + x + 5), and close pairs: ((10^9 x - 1)^2 + 1)(x^2 + 7)
        let product = |factors: &[&[i64]]| {
            let factor = |c: &&[i64]| Univariate::new(c.iter().map(|c| Rational::from(*c)).collect());
            factors.iter().map(factor).fold(Univariate::one(), |p: Univariate<Rational>, f| p.mul(&f))
        };
        let billion = 1_000_000_000;
        for (polynomial, real) in [
            (product(&[&[1, 0, 1], &[-2, 0, 1], &[-3, 1], &[5, 1, 1]]), 3),
            (product(&[&[2, -2 * billion, billion * billion], &[7, 0, 1]]), 0),
            (product(&[&[-5, 1, 3]]), 2),
            // Coefficients beyond those of f64.
            (product(&[&[1, 0, 1], &[5, 1, 1]]).scale(&(Rational::from(1) << 3000_u32)), 0),
        ] {
            let found = roots(&polynomial).unwrap();
            assert_eq!(Some(found.len()), polynomial.degree());
            assert_eq!(found.iter().filter(|root| root.is_real()).count(), real);
            for root in &found {
                for bits in [100, 600] {
                    let ball = root.ball(bits).unwrap();
                    assert!(ball.radius().to_f64() < 1e-25, "{root:?} {ball:?}");
                    let value = ball.evaluate(polynomial.coefficients());
                    assert!(!value.is_not_zero());
                }
            }
        }
    }
}
