//! A bound on the coefficients of a cut's determinant at the conjugates of a number field.
//!
//! The determinant of the pencil of a cut is, up to a number that is not 0 modulo the prime, the determinant of a square matrix
//! of 60 rows: the closure equations before anything is eliminated, four times, as multipliers of the requested rows. Its entries
//! are polynomials in the constants of the loop, so that Hadamard's inequality bounds its coefficients at every conjugate,
//! and powers of the denominators of the constants make them integers of the field.
//!
//! An integer of the field that is 0 at all places over a prime p is p times an integer. If it is 0 at all places over primes whose
//! product exceeds the geometric mean of the bounds at the conjugates, its norm is a multiple of more than itself: it is 0.

use crate::algebra::number_field::Algebraic;
use crate::algebra::real_field::RealField;
use crate::algebra::ring::Ring;
use crate::closure::woernle_lee::{FIXED, SIZE, TURNING_X, TURNING_Y, act, act_on_form, left_columns, right_columns};
use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::ClosedLoop;
use rug::{Float, Integer, Rational};

/// Evaluations in the 512 bits of the conjugates are off by less than this power of two times the sum of all terms.
const ROUNDING: i32 = -400;

/// A bound on the absolute value of a number at one conjugate, and the powers of the denominators of the six constants that make it
/// an integer.
#[derive(Clone, Debug, PartialEq)]
struct Majorant {
    size: f64,
    powers: [u32; 6],
}

impl Majorant {
    fn combined(&self, other: &Self, size: f64, power: impl Fn(u32, u32) -> u32) -> Self {
        Self { size, powers: std::array::from_fn(|k| power(self.powers[k], other.powers[k])) }
    }
}

impl Ring for Majorant {
    fn zero() -> Self {
        Self { size: 0.0, powers: [0; 6] }
    }
    fn one() -> Self {
        Self { size: 1.0, powers: [0; 6] }
    }
    fn add(&self, other: &Self) -> Self {
        self.combined(other, self.size + other.size, u32::max)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        self.combined(other, (self.size * other.size).max(f64::MIN_POSITIVE), |a, b| a + b)
    }
    fn neg(&self) -> Self {
        self.clone()
    }
    fn is_zero(&self) -> bool {
        self.size == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self { size: q.clone().abs().to_f64() * (1.0 + 1e-15), powers: [0; 6] })
    }
}

/// An upper bound on the absolute value of an element at a conjugate of the element that generates the field.
fn absolute(x: &Algebraic, conjugate: &Float) -> f64 {
    let (numerator, denominator) = x.parts();
    match numerator {
        [] => 0.0,
        [only] => upper(&Float::with_val(64, Rational::from((only, denominator)))),
        several => {
            let size = Float::with_val(64, &*conjugate.as_abs());
            let terms = several.iter().rev().fold(Float::new(64), |sum, c| sum * &size + Integer::from(c.abs_ref()));
            let terms = (terms / denominator) << ROUNDING;
            upper(&x.at(conjugate)) + upper(&terms)
        }
    }
}

fn upper(x: &Float) -> f64 {
    Float::with_val(64, &*x.as_abs()).to_f64() * (1.0 + 1e-15)
}

/// A loop over a number field with the sizes of its constants.
pub(super) struct Height<'a> {
    closed: &'a ClosedLoop<Algebraic>,
    field: &'a RealField,
}

impl<'a> Height<'a> {
    pub(super) fn of(closed: &'a ClosedLoop<Algebraic>, field: &'a RealField) -> Self {
        Self { closed, field }
    }

    /// Returns the mean over all conjugates of the binary logarithm of a bound on the coefficients of the determinant of a cut,
    /// multiplied by the denominators that make them integers; `None` where numbers leave the range of f64.
    pub(super) fn bits(&self, cut: Cut) -> Option<f64> {
        let denominators = self.closed.constants.each_ref().map(|motion| {
            let mut common = Integer::from(1);
            for x in motion.rotation.iter().flatten().chain(&motion.translation) {
                common.lcm_mut(x.parts().1);
            }
            bits_of(&common)
        });
        let conjugates = self.field.conjugates();
        let mut sum = 0.0;
        for conjugate in conjugates {
            let (size, powers) = of_columns(&cut.of(&self.image(conjugate)))?;
            let scale: f64 = powers.iter().zip(denominators).map(|(power, bits)| f64::from(*power) * bits).sum();
            sum += size + scale;
        }
        // Sums of a few hundred rounded logarithms.
        let mean = sum / conjugates.len() as f64 * (1.0 + 1e-9) + 1.0;
        mean.is_finite().then_some(mean)
    }

    fn image(&self, conjugate: &Float) -> ClosedLoop<Majorant> {
        let mut k = 0;
        let constants = self.closed.constants.each_ref().map(|motion| {
            let entry = |x: &Algebraic| {
                let mut powers = [0; 6];
                powers[k] = u32::from(*x.parts().1 != 1);
                Majorant { size: absolute(x, conjugate), powers }
            };
            let image = crate::kinematics::motion::Motion {
                rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(entry)),
                translation: motion.translation.each_ref().map(entry),
            };
            k += 1;
            image
        });
        ClosedLoop { variables: self.closed.variables, constants }
    }

    /// The mean over all conjugates of the binary logarithm of a bound on the sum of the absolute values of the coefficients of a
    /// polynomial over the field, and the bits of its denominator.
    pub(super) fn of_polynomial(&self, coefficients: &[Algebraic]) -> (f64, f64) {
        let mut common = Integer::from(1);
        for x in coefficients {
            common.lcm_mut(x.parts().1);
        }
        let conjugates = self.field.conjugates();
        let size = |conjugate: &Float| {
            let sum: f64 = coefficients.iter().map(|x| absolute(x, conjugate)).sum();
            sum.max(1.0).log2()
        };
        (conjugates.iter().map(size).sum::<f64>() / conjugates.len() as f64 + 1e-6, bits_of(&common))
    }
}

/// The binary logarithm of a positive integer, from above.
fn bits_of(n: &Integer) -> f64 {
    let (mantissa, exponent) = n.to_f64_exp();
    mantissa.log2() + f64::from(exponent) + 1e-9
}

/// The binary logarithm of the product of the norms of all 60 columns, and the powers of the denominators in it.
fn of_columns(cut: &ClosedLoop<Majorant>) -> Option<(f64, [u32; 6])> {
    let (mut bits, mut powers) = (0.0, [0; 6]);
    let mut note = |column: &[&Majorant], times: u32| {
        let square: f64 = column.iter().map(|x| x.size * x.size).sum();
        bits += f64::from(times) * 0.5 * square.log2();
        for (k, power) in powers.iter_mut().enumerate() {
            *power += times * column.iter().map(|x| x.powers[k]).max().unwrap_or(0);
        }
    };
    for column in left_columns(cut) {
        note(&column.iter().collect::<Vec<_>>(), 4);
    }
    let back = cut.constants[2].inverse();
    let unit = |i: usize| std::array::from_fn(|j| if i == j { Majorant::one() } else { Majorant::zero() });
    let action: [[Majorant; SIZE]; SIZE] = std::array::from_fn(|i| act_on_form(&unit(i), &back));
    for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
        let column: Vec<&Majorant> = action.iter().flat_map(|row| [&row[x], &row[y]]).collect();
        note(&column, 4);
    }
    let across = cut.constants[1].inverse();
    let mut total: [Majorant; SIZE] = std::array::from_fn(|_| Majorant::zero());
    for line in right_columns(cut).iter().flatten() {
        total = std::array::from_fn(|i| total[i].add(&act(&across, line)[i]));
    }
    let row = |own: &[Majorant; SIZE]| {
        let turning = TURNING_X.into_iter().zip(TURNING_Y).map(|(x, y)| own[x].mul(&total[x].add(&total[y])));
        let fixed = FIXED.into_iter().map(|i| own[i].mul(&total[i]));
        turning.chain(fixed).fold(Majorant::zero(), |sum, x| sum.add(&x))
    };
    // Half-angle forms of the hidden unknown and of the other one double an entry each; every row occurs four times.
    let rows: Vec<Majorant> = action.iter().map(row).map(|x| Majorant { size: 8.0 * x.size, ..x }).collect();
    note(&rows.iter().collect::<Vec<_>>(), 8);
    bits.is_finite().then_some((bits, powers))
}
