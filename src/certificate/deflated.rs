//! Double solutions to many digits. No proof rests on this: what is found is checked.
//!
//! At a double solution the derivative J of the equations F has a kernel v, and Newton's method slows down. The system
//! `F(x) + l b = 0, J(x) v = 0, c.v = 1` in x, v and l is regular there, with l = 0, if b is not in the image of J.

use super::algebraic::{BITS, Far};
use super::chain::ChainClosure;
use super::enclosing::{Centre, Enclosing, near_inverse};
use super::isolation::Closure;
use crate::algebra::ring::Ring;
use num_complex::Complex;
use rug::{Float, Rational};

/// Newton steps: from 20 bits each doubles them up to those of [`STEP`], and then adds as many.
const STEPS: usize = 12;
/// Bits of the step by which the derivative of J along v is found.
const STEP: i32 = 400;
/// Bits up to which l vanishes at a double solution.
const NONE: i32 = -600;
/// Offset from a solution, in radians or metres, at which J is regular.
const BESIDE: f64 = 1e-9;

type Number = (Rational, Rational);

fn exactly(x: &Far) -> Option<Number> {
    Some((x.re().to_rational()?, x.im().to_rational()?))
}

fn moved(x: &[Number], by: &[Far; 6]) -> Option<Vec<Number>> {
    let add = |((re, im), by): (&Number, &Far)| {
        let (of_re, of_im) = exactly(by)?;
        let short = |x: Rational| Float::with_val(BITS, x).to_rational();
        Some((short(of_re + re)?, short(of_im + im)?))
    };
    x.iter().zip(by).map(add).collect()
}

fn dot(x: &[Far; 6], y: &[Far; 6]) -> Far {
    x.iter().zip(y).fold(Far::zero(), |sum, (x, y)| sum.add(&x.mul(y)))
}

/// Returns the index of the largest entry.
fn largest(x: &[Far; 6]) -> usize {
    (0..6).max_by(|i, j| x[*i].at_most().total_cmp(&x[*j].at_most())).unwrap_or(0)
}

/// Returns the unknowns of a double solution that is known to some six digits; `None` if the search does not end at one.
pub(super) fn double_solution(closure: &ChainClosure, near: &[Complex<f64>]) -> Option<Vec<Number>> {
    let (angles, links) = (closure.angles(), closure.constants::<Far>());
    let slope = |x: &[Number]| closure.slope(&links, &Centre::of(x, &angles, BITS).within(0.0)).0;
    let part = |x: f64| Rational::from_f64(x);
    let mut x: Vec<Number> = near.iter().map(|z| Some((part(z.re)?, part(z.im)?))).collect::<Option<_>>()?;
    let beside = near.iter().zip(1_u8..).map(|(z, k)| Some((part(z.re + BESIDE * f64::from(k))?, part(z.im)?)));
    let inverse = near_inverse(&slope(&beside.collect::<Option<Vec<_>>>()?))?;
    let sum = |terms: &mut dyn Iterator<Item = &Far>| terms.fold(Far::zero(), |sum, x| sum.add(x));
    let mut kernel: [Far; 6] = std::array::from_fn(|i| sum(&mut inverse[i].iter()));
    let image: [Far; 6] = std::array::from_fn(|j| sum(&mut inverse.iter().map(|row| &row[j])));
    let (at, border) = (largest(&kernel), largest(&image));
    let scale = kernel[at].clone();
    for value in &mut kernel {
        *value = value.over(&scale)?.midpoint();
    }
    let (tiny, huge) = (Float::with_val(BITS, Float::i_exp(1, -STEP)), Float::with_val(BITS, Float::i_exp(1, STEP)));
    let (tiny, huge) = (Far::point(&tiny, &Float::new(2)), Far::point(&huge, &Float::new(2)));
    let mut rest = Far::zero();
    for _ in 0..STEPS {
        let values = closure.values(&links, &Centre::of(&x, &angles, BITS).within::<Far>(0.0));
        let here = slope(&x);
        let along = slope(&moved(&x, &kernel.each_ref().map(|v| v.mul(&tiny).midpoint()))?);
        let mut matrix: [[Far; 13]; 13] = std::array::from_fn(|_| std::array::from_fn(|_| Far::zero()));
        let mut right: [Far; 13] = std::array::from_fn(|_| Far::zero());
        for i in 0..6 {
            for j in 0..6 {
                matrix[i][j] = here[i][j].midpoint();
                matrix[6 + i][6 + j] = here[i][j].midpoint();
                matrix[6 + i][j] = along[i][j].sub(&here[i][j]).mul(&huge).midpoint();
            }
            right[i] = values[i].neg();
            right[6 + i] = dot(&here[i], &kernel).neg();
        }
        matrix[border][12] = Far::one();
        right[border] = right[border].sub(&rest);
        matrix[12][6 + at] = Far::one();
        let inverse = near_inverse(&matrix)?;
        let step = inverse
            .each_ref()
            .map(|row| row.iter().zip(&right).fold(Far::zero(), |sum, (c, r)| sum.add(&c.mul(r))).midpoint());
        x = moved(&x, &std::array::from_fn(|k| step[k].clone()))?;
        kernel = std::array::from_fn(|k| kernel[k].add(&step[6 + k]).midpoint());
        rest = rest.add(&step[12]).midpoint();
    }
    (rest.upper() < Float::with_val(53, Float::i_exp(1, NONE))).then_some(x)
}
