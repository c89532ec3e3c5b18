//! The determinant of [`closure_zeros`](super::closure_zeros) at all samples side by side, with one bound of its error for all of them.
//!
//! The entries of the columns have bounds made once per pose, from norms of the blocks of a marked line and of a row (its direction, its
//! point, ...), by Cauchy's inequality: norms are those of the exact quantities, beside each stands a bound of the distance of what is
//! computed. From the entries on an error is carried beside every number. Formulas are the same with and without fused multiply-add:
//! bounds hold for both.

use super::circle_lanes::directions;
use super::circle_zeros::{SAMPLE_ERROR, SAMPLES};
use super::closure_zeros::CONSTANT;
use super::{MARGIN, ROUNDOFF};
use crate::algebra::bounded::{Bounded, Floating};
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::Hidden;
use crate::kinematics::motion::Motion;
use crate::solve::lane_brackets::{BRACKETS, Brackets, LaneEntries, LaneForms, Minors, forms, minors, pair};
use crate::solve::lane_closure::ROOT_3;
use crate::solve::lanes::{Lanes, Row, WIDTH};
use pulp::Simd;

/// The blocks of a marked line: 1, direction, point, two products, moment, reflected direction.
const BLOCKS: [std::ops::Range<usize>; 7] = [0..1, 1..4, 4..7, 7..8, 8..9, 9..12, 12..15];
/// Motions less exact than this prove nothing: products of two errors would count.
const INEXACT: f64 = 1e-3;

/// The coefficients of the equations of a cut as linear forms on the marked line of the closing transformation, side by side.
#[derive(Clone, Debug)]
pub struct LaneRows {
    forms: LaneForms,
    /// The largest lengths of the blocks of the nine forms of an equation, and the largest bounds of their errors.
    sizes: [Row; 7],
    errors: [Row; 7],
}

/// The columns of the equations of a cut over `(1, cos, sin)` of the hidden angle, and what bounds the determinant.
pub struct LaneColumns {
    /// The columns.
    pub entries: LaneEntries,
    /// Bounds of the errors of the minors of rows 0, 1 and of rows 2, 3 as factors of a sum of products, at all hidden angles.
    errors: [[f64; 15]; 2],
}

impl LaneRows {
    /// Returns the forms of exact rows, enclosed, and the inverse of constant 1 of the cut.
    #[must_use]
    pub fn new<T: Floating>(rows: &[MarkedLine<Bounded<T>>; 8], back: &Motion<Bounded<T>>) -> Self {
        let forms = forms(rows, back).map(|all| all.map(|forms| forms.map(|form| form.map(Bounded::in_f64))));
        let length = |x: &[Bounded<f64>], of: fn(Bounded<f64>) -> f64| {
            1.01 * x.iter().map(|x| of(*x).powi(2)).sum::<f64>().sqrt()
        };
        let block = |b: usize, of: fn(Bounded<f64>) -> f64| {
            std::array::from_fn(|e| largest(forms[e].iter().flatten().map(|form| length(&form[BLOCKS[b].clone()], of))))
        };
        let values = forms.each_ref().map(|all| all.map(|forms| forms.map(|form| form.map(|x| x.value))));
        Self {
            forms: LaneForms::new(&values),
            sizes: std::array::from_fn(|b| block(b, Bounded::size)),
            errors: std::array::from_fn(|b| block(b, Bounded::error)),
        }
    }

    /// Returns the columns of the equations at a pose, given the inverse of constant 6 of the cut, which is the closing transformation or its
    /// inverse as computed in f64. The longest translation of the loop, and a bound of the row-sum norm of what the closing transformation is
    /// off beyond the roundings of a constant, are for the errors.
    #[inline(always)]
    pub fn columns<S: Simd>(
        &self,
        simd: S,
        start: &Motion<f64>,
        [longest, off]: [f64; 2],
        hidden: Hidden,
    ) -> LaneColumns {
        let coefficients = self.forms.at_pose(simd, start);
        let (bounds, is_exact) = wrong_blocks(start, longest, off);
        let mut errors = [0.0; WIDTH];
        for chunk in 0..Lanes::<S>::CHUNKS {
            let zero = Lanes::splat(simd, 0.0);
            let mut error = zero;
            for (b, [size, wrong]) in bounds.into_iter().enumerate() {
                // A sum of eight products, of two numbers that are rounded once.
                error = Lanes::load(simd, &self.sizes[b], chunk).fma(zero.like(wrong + 10.0 * ROUNDOFF * size), error);
                error = Lanes::load(simd, &self.errors[b], chunk).fma(zero.like(size), error);
            }
            error = error * zero.like(if is_exact { MARGIN } else { f64::NAN });
            error.store(&mut errors, chunk);
        }
        LaneColumns::of(simd, LaneEntries::of(simd, &coefficients, hidden), &errors)
    }
}

/// Returns bounds of the lengths of the blocks of the marked line of a motion, and of their errors, and whether these are small.
#[inline(always)]
fn wrong_blocks(start: &Motion<f64>, longest: f64, off: f64) -> ([[f64; 2]; 7], bool) {
    let t = &start.translation;
    let computed = 1.01 * (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]).sqrt();
    // Nine entries of a rotation, of which the direction is a column, and three of a translation. If the translation of the closing
    // transformation is turned back, its errors are turned with it, and each entry is a sum of three products.
    let entry = CONSTANT * ROUNDOFF + off;
    let direction = ROOT_3 * entry;
    let point = ROOT_3 * (CONSTANT * ROUNDOFF * (1.0 + longest) + off) + (3.0 * entry + 6.0 * ROUNDOFF) * computed;
    let size = computed + point;
    let both = point + size * direction + 4.0 * ROUNDOFF * size;
    let bounds = [
        [1.0, 0.0],
        [1.0, direction],
        [size, point],
        [size, both],
        [size * size, size * (2.0 * point + 4.0 * ROUNDOFF * size)],
        [size, both],
        // The direction times the square of the point, less twice the point times their product.
        [size * size, size * (6.0 * point + 3.0 * size * direction + 16.0 * ROUNDOFF * size)],
    ];
    (bounds, entry < INEXACT && point <= INEXACT * (1.0 + size))
}

impl LaneColumns {
    /// Returns columns of equations whose coefficients are off by these errors.
    #[inline(always)]
    fn of<S: Simd>(simd: S, entries: LaneEntries, errors: &Row) -> Self {
        // The largest sizes of the entries on the circle, and bounds of their errors.
        let (mut sizes, mut wrongs) = ([[0.0; WIDTH]; 3], [[0.0; WIDTH]; 3]);
        for chunk in 0..Lanes::<S>::CHUNKS {
            let zero = Lanes::splat(simd, 0.0);
            let own = Lanes::load(simd, errors, chunk);
            for (l, rows) in entries.0.iter().enumerate() {
                let [constant, cos, sin] = [
                    Lanes::load(simd, &rows[0], chunk),
                    Lanes::load(simd, &rows[1], chunk),
                    Lanes::load(simd, &rows[2], chunk),
                ];
                // Two coefficients make an entry, and |1| + |cos| + |sin| is at most 1 + sqrt(2). The terms of an entry are rounded five times,
                // and cosine and sine are off by two units.
                let sum = constant.abs() + cos.abs() + sin.abs();
                let wrong = own.fma(zero.like(2.0 * 2.415), sum * zero.like(10.0 * ROUNDOFF + SAMPLE_ERROR));
                wrong.store(&mut wrongs[l], chunk);
                // With the error, and a margin for the root.
                (constant.abs() + cos.fma(cos, sin * sin).sqrt() * zero.like(MARGIN) + wrong)
                    .store(&mut sizes[l], chunk);
            }
        }
        Self { errors: [wrong_minors(&sizes, &wrongs, 0), wrong_minors(&sizes, &wrongs, 2)], entries }
    }
}

/// Half roundings that are added to the error of each factor in a sum of products, in parts of the factor: with those of the other factor they
/// are the rounding of the product and those of six sums.
const FACTOR: f64 = 4.0;
/// More than a product loses by underflow.
const TINY: f64 = 1e-280;

impl LaneColumns {
    /// Returns the determinant at the samples, a bound of its error, NaN where there is none, and the size of the largest value.
    #[inline(always)]
    pub fn values<S: Simd>(&self, simd: S) -> ([f64; SAMPLES], [f64; 2]) {
        let (cos, sin) = directions();
        let (mut values, mut errors) = ([0.0; SAMPLES], [0.0; SAMPLES]);
        for chunk in 0..SAMPLES / S::F64_LANES {
            let at = self.entries.at([Lanes::load(simd, cos, chunk), Lanes::load(simd, sin, chunk)]);
            let (u, v) = (minors::<S, _>(&at, 0), minors::<S, _>(&at, 2));
            let brackets = Brackets::of_minors([&u, &v]);
            brackets.determinant().store(&mut values, chunk);
            self.error([&u, &v], &brackets).store(&mut errors, chunk);
        }
        // NaN stays.
        let larger = |most: f64, x: &f64| if x.abs() <= most || most.is_nan() { most } else { x.abs() };
        let most = |of: &[f64; SAMPLES]| of.iter().fold(0.0, larger);
        let bounds = [most(&errors), most(&values)];
        (values, bounds)
    }
}

/// Returns bounds of the errors of the minors of two rows, with half the roundings of a sum of products of them, from the sizes of the entries
/// and their errors.
#[inline(always)]
fn wrong_minors(sizes: &[Row; 3], wrongs: &[Row; 3], row: usize) -> [f64; 15] {
    let mut minors = [0.0; 15];
    for i in 0..5 {
        for j in i + 1..6 {
            let (k, l) = (4 * (i / 3) + row, 4 * (j / 3) + row);
            let (a, b) = ([sizes[i % 3][k], sizes[i % 3][k + 1]], [sizes[j % 3][l], sizes[j % 3][l + 1]]);
            let (da, db) = ([wrongs[i % 3][k], wrongs[i % 3][k + 1]], [wrongs[j % 3][l], wrongs[j % 3][l + 1]]);
            let moved = a[0] * db[1] + da[0] * b[1] + a[1] * db[0] + da[1] * b[0];
            // Each product and their difference are rounded: two units of the sizes.
            minors[pair(i, j)] = MARGIN * (moved + (2.0 + FACTOR) * ROUNDOFF * (a[0] * b[1] + a[1] * b[0])) + TINY;
        }
    }
    minors
}

/// Returns a bound of the error of a bracket, with half the roundings of a sum of products, from the sizes of the minors and their errors.
#[inline(always)]
fn wrong<S: Simd>(
    size: Lanes<S>,
    [u, v]: [&Minors<Lanes<S>>; 2],
    [du, dv]: &[[f64; 15]; 2],
    [a, b, c, d]: [usize; 4],
) -> Lanes<S> {
    let mut both = TINY;
    let mut sums = [size.abs() * size.like(FACTOR * ROUNDOFF), size.like(0.0)];
    for (i, j) in [
        (pair(a, b), pair(c, d)),
        (pair(a, c), pair(b, d)),
        (pair(a, d), pair(b, c)),
        (pair(b, c), pair(a, d)),
        (pair(b, d), pair(a, c)),
        (pair(c, d), pair(a, b)),
    ] {
        sums = [u[i].fma(size.like(dv[j]), sums[0]), v[j].fma(size.like(du[i]), sums[1])];
        both += du[i] * dv[j];
    }
    sums[0] + sums[1] + size.like(both)
}

impl LaneColumns {
    /// Returns a bound of the error of the determinant at hidden angles.
    #[inline(always)]
    fn error<S: Simd>(&self, [u, v]: [&Minors<Lanes<S>>; 2], brackets: &Brackets<Lanes<S>>) -> Lanes<S> {
        let (mut size_u, mut size_v) = (*u, *v);
        for k in 0..15 {
            (size_u[k], size_v[k]) = (u[k].abs(), v[k].abs());
        }
        let sizes = [&size_u, &size_v];
        let (b, e) = (&brackets.0, &self.errors);
        let mut sum = b[0].like(0.0);
        sum = wrong_product([b[0], b[5]], [BRACKETS[0], BRACKETS[5]], sizes, e, sum);
        sum = wrong_product([b[1], b[6]], [BRACKETS[1], BRACKETS[6]], sizes, e, sum);
        sum = wrong_product([b[2], b[7]], [BRACKETS[2], BRACKETS[7]], sizes, e, sum);
        sum = wrong_product([b[3], b[8]], [BRACKETS[3], BRACKETS[8]], sizes, e, sum);
        sum = wrong_product([b[4], b[9]], [BRACKETS[4], BRACKETS[9]], sizes, e, sum);
        sum = wrong_product([b[10], b[10]], [BRACKETS[10], BRACKETS[10]], sizes, e, sum);
        sum.fma(sum.like(MARGIN), sum.like(TINY))
    }
}

/// Returns `sum` and the error of a product of two brackets.
#[inline(always)]
fn wrong_product<S: Simd>(
    brackets: [Lanes<S>; 2],
    columns: [[usize; 4]; 2],
    sizes: [&Minors<Lanes<S>>; 2],
    errors: &[[f64; 15]; 2],
    sum: Lanes<S>,
) -> Lanes<S> {
    let one = wrong(brackets[0], sizes, errors, columns[0]);
    let other = wrong(brackets[1], sizes, errors, columns[1]);
    (brackets[0].abs() + one).fma(other, brackets[1].abs().fma(one, sum))
}

/// Returns the largest of some numbers that are not negative, NaN where one is: nothing is bounded then.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |largest, x| if x.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(x) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::double_double::DoubleDouble;
    use crate::algebra::ring::Ring;
    use crate::certify::closure_zeros::EnclosedRows;
    use crate::closure::half_angle::half_angle_form;
    use crate::elimination::brackets;
    use crate::elimination::cut::Cut;
    use crate::elimination::pencil::{before_second_link, bilinear};
    use crate::kinematics::closed_loop::{ClosedLoop, Variable};
    use pulp::{Arch, Scalar, WithSimd};
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    type Values = ([f64; SAMPLES], [f64; 2]);

    struct OfPose<'a>(&'a LaneRows, Motion<f64>, f64, Hidden);

    impl WithSimd for OfPose<'_> {
        type Output = Values;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Values {
            self.0.columns(simd, &self.1, [self.2, 0.0], self.3).values(simd)
        }
    }

    #[test]
    fn determinants_are_within_their_bounds() {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let (mut nearest, mut widest) = (0.0_f64, 0.0_f64);
        for _ in 0..40 {
            let mut motion = || {
                let mut angle = || random.random_range(-3.0..3.0_f64);
                let turned = Motion::rotation_x(angle().cos(), angle().sin());
                let (c, s) = (turned.rotation[1][1], turned.rotation[2][1]);
                let norm = (c * c + s * s).sqrt();
                let (one, other) = (angle(), angle());
                let both = Motion::rotation_x(c / norm, s / norm).then_after(&Motion::rotation_z(one.cos(), one.sin()));
                let mut motion = both.then_after(&Motion::rotation_x(other.cos(), other.sin()));
                motion.translation = [angle(), angle(), angle()];
                motion
            };
            let constants: [Motion<f64>; 6] = std::array::from_fn(|_| motion());
            let closed = ClosedLoop { variables: [Variable::Rotation; 6], constants };
            let longest = closed.constants.iter().flat_map(|m| m.translation).fold(0.0, |a: f64, x| a.max(x.abs()));
            let long = |motion: &Motion<f64>| Motion {
                rotation: motion.rotation.map(|row| row.map(DoubleDouble::from)),
                translation: motion.translation.map(DoubleDouble::from),
            };
            let exact = ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(long) };
            for cut in [Cut { rotation: 0, reversed: false }, Cut { rotation: 0, reversed: true }] {
                let (Some(rows), Some(form)) = (EnclosedRows::of(cut, &exact), half_angle_form(&cut.of(&exact))) else {
                    continue;
                };
                let lanes = rows.lanes.as_ref().unwrap();
                let view = cut.of(&exact);
                let own = before_second_link(&form, &view.constants[1]);
                for hidden in [Hidden::First, Hidden::Second] {
                    let gap = &closed.constants[5];
                    let start = if cut.reversed { gap.clone() } else { gap.inverse() };
                    let (values, [error, largest]) =
                        Arch::new().dispatch(OfPose(lanes, start.clone(), longest, hidden));
                    assert!(error < 1e-3 * largest, "{error} of {largest}");
                    let (one_by_one, [bound, _]) = Scalar.vectorize(OfPose(lanes, start, longest, hidden));
                    let apart = |(x, y): (&f64, &f64)| (x - y).abs() <= error + bound;
                    assert!(values.iter().zip(&one_by_one).all(apart) && bound < 1.01 * error);
                    // Every loop whose closing transformation is within the roundings of a constant is meant.
                    let mut near = exact.clone();
                    for x in near.constants[5].rotation.iter_mut().flatten() {
                        *x = x.add(&DoubleDouble::from(random.random_range(-1.0..1.0) * CONSTANT * ROUNDOFF));
                    }
                    for x in &mut near.constants[5].translation {
                        *x = x.add(&DoubleDouble::from(
                            random.random_range(-1.0..1.0) * CONSTANT * ROUNDOFF * (1.0 + longest),
                        ));
                    }
                    let columns = brackets::columns(&bilinear(&own, &cut.of(&near)), hidden);
                    let (cos, sin) = directions();
                    for k in 0..SAMPLES {
                        let at = brackets::at(&columns, &DoubleDouble::from(cos[k]), &DoubleDouble::from(sin[k]));
                        let off = brackets::determinant(&at).sub(&DoubleDouble::from(values[k])).to_f64().abs();
                        assert!(off <= error, "sample {k} of {cut:?}: {off} is more than {error}");
                        nearest = nearest.max(off / error);
                    }
                    widest = widest.max(error / largest);
                }
            }
        }
        // The bound is used: errors come within a thousandth of it.
        assert!(nearest > 1e-3 && widest > 0.0, "{nearest}, {widest}");
    }
}
