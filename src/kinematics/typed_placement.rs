//! Poses of plain numbers: in twice the digits of a double at once, over the rationals on request.

use super::chain::Placement;
use super::decimal::{Plain, whole};
use super::exact_motion::{Datum, ExactMotion, QUATERNION_BITS};
use super::motion::Motion;
use super::placement::{REFUSED, noted_norm, rotation_over};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;

/// A matrix farther than this from every rotation is more than rounded.
const ROUNDED: f64 = 1e-12;
/// One that is nearer may be a rotation exactly.
const MAY_BE_EXACT: f64 = 1e-24;

type Matrix3 = [[DoubleDouble; 3]; 3];

fn sum(terms: impl Iterator<Item = DoubleDouble>) -> DoubleDouble {
    terms.fold(DoubleDouble::zero(), |sum, term| sum.add(&term))
}

fn halved(x: &DoubleDouble) -> DoubleDouble {
    x.mul(&DoubleDouble::from(0.5))
}

impl Placement {
    /// The placement by a matrix, its three upper rows given. `None` where its rotation is off by more than rounding or may
    /// be one exactly: [`Placement::from_matrix`] tells then.
    #[must_use]
    pub fn of_rounded_matrix(rows: &[[Plain; 4]; 3]) -> Option<Self> {
        let given: Matrix3 = rows.map(|row| [row[0], row[1], row[2]].map(Plain::double_double));
        let off = off_rotation(&given);
        let plain = given.map(|row| row.map(DoubleDouble::to_f64));
        let is_rotation = off < ROUNDED && determinant(&plain) > 0.0;
        if !is_rotation || off < MAY_BE_EXACT {
            return None;
        }
        let quaternion = quaternion(&nearest(&given))?;
        let rotation = rotation_over(quaternion.map(whole).each_ref())?;
        let place = |i: usize, j: usize| given[i][j].sub(&rotation[i][j]).to_f64().abs();
        let defect = (0..9).map(|k| place(k / 3, k % 3)).fold(0.0, f64::max);
        let translation = rows.map(|row| row[3].double_double());
        let exact = ExactMotion::of(Datum::Matrix(*rows, quaternion));
        Some(Self { defect, ..Self::in_both(exact, Motion { rotation, translation }) })
    }

    /// The placement by a quaternion `[w, x, y, z]`, which is normalised, and a position, with the warning of
    /// [`Placement::from_quaternion_position`]. `None` where the length of the quaternion is off by too much: that one tells then.
    #[must_use]
    pub fn of_rounded_quaternion(quaternion: &[Plain; 4], position: &[Plain; 3]) -> Option<(Self, Option<String>)> {
        let own = quaternion.map(Plain::double_double);
        let square = sum(own.iter().map(|q| q.mul(q)));
        let above = square.sub(&DoubleDouble::one()).to_f64();
        // sqrt(1 + x) - 1 without cancellation.
        let defect = (above / (1.0 + (1.0 + above).sqrt())).abs();
        if !(defect < REFUSED) {
            return None;
        }
        let rotation = rotation_over(own.each_ref())?;
        let motion = Motion { rotation, translation: position.map(Plain::double_double) };
        let exact = ExactMotion::of(Datum::Quaternion(*quaternion, *position));
        Some((Self { defect, ..Self::in_both(exact, motion) }, noted_norm(defect)))
    }

    /// The placement by a quaternion `[w, x, y, z]` of whole numbers over 2^60, which is normalised, and a position of finite
    /// numbers; `None` for the quaternion 0.
    #[must_use]
    pub fn of_whole_quaternion(quaternion: [i64; 4], position: [f64; 3]) -> Option<Self> {
        let rotation = rotation_over(quaternion.map(whole).each_ref())?;
        let motion = Motion { rotation, translation: position.map(DoubleDouble::from) };
        let exact = ExactMotion::of(Datum::Binary(quaternion, position));
        Some(Self::in_both(exact, motion))
    }

    /// The placement by a motion over the rationals and its image in twice the digits.
    fn in_both(exact: ExactMotion, precise: Motion<DoubleDouble>) -> Self {
        let float = in_f64(&precise);
        Self { exact, given: None, closed: None, precise: Some(Box::new(precise)), float, rows: None, defect: 0.0 }
    }

    /// The inverse motion in f64, where no exact number is needed for it: every entry rounded once.
    #[must_use]
    pub fn inverse_in_f64(&self) -> Option<Motion<f64>> {
        Some(in_f64(&self.precise.as_ref()?.inverse()))
    }
}

fn in_f64(motion: &Motion<DoubleDouble>) -> Motion<f64> {
    Motion {
        rotation: motion.rotation.map(|row| row.map(DoubleDouble::to_f64)),
        translation: motion.translation.map(DoubleDouble::to_f64),
    }
}

fn determinant(m: &[[f64; 3]; 3]) -> f64 {
    let minor = |a: usize, b: usize| m[1][a] * m[2][b] - m[1][b] * m[2][a];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// `R^T R`
fn gram(m: &Matrix3) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| sum((0..3).map(|k| m[k][i].mul(&m[k][j])))))
}

/// The largest entry of `|R^T R - I|`.
fn off_rotation(m: &Matrix3) -> f64 {
    let gram = gram(m);
    let entry = |i: usize, j: usize| if i == j { gram[i][j].sub(&DoubleDouble::one()) } else { gram[i][j] };
    // NaN is no rotation.
    let larger = |most: f64, x: f64| if x > most || x.is_nan() { x } else { most };
    (0..9).map(|k| entry(k / 3, k % 3).to_f64().abs()).fold(0.0, larger)
}

/// The polar factor: a step of Newton's iteration, `R (3 I - R^T R) / 2`, squares the error.
fn nearest(m: &Matrix3) -> Matrix3 {
    let gram = gram(m);
    let factor: Matrix3 = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let three = DoubleDouble::from(if i == j { 3.0 } else { 0.0 });
            halved(&three.sub(&gram[i][j]))
        })
    });
    std::array::from_fn(|i| std::array::from_fn(|j| sum((0..3).map(|k| m[i][k].mul(&factor[k][j])))))
}

/// The quaternion of a rotation as four whole numbers over 2^60.
fn quaternion(m: &Matrix3) -> Option<[i64; 4]> {
    let one = DoubleDouble::one();
    let trace = |s: [f64; 3]| (0..3).fold(one, |sum, k| sum.add(&m[k][k].mul(&DoubleDouble::from(s[k]))));
    let plus = |i: usize, j: usize| m[i][j].add(&m[j][i]);
    let minus = |i: usize, j: usize| m[i][j].sub(&m[j][i]);
    // Four times the outer product of the quaternion with itself; the row with the largest diagonal is taken.
    let table = [
        [trace([1.0, 1.0, 1.0]), minus(2, 1), minus(0, 2), minus(1, 0)],
        [minus(2, 1), trace([1.0, -1.0, -1.0]), plus(0, 1), plus(0, 2)],
        [minus(0, 2), plus(0, 1), trace([-1.0, 1.0, -1.0]), plus(1, 2)],
        [minus(1, 0), plus(0, 2), plus(1, 2), trace([-1.0, -1.0, 1.0])],
    ];
    let best = (1..4).fold(0, |best, k| if table[k][k].to_f64() > table[best][best].to_f64() { k } else { best });
    let square = sum(table[best].iter().map(|x| x.mul(x)));
    // One over its root: one step of Newton's method from that in f64 doubles the digits.
    let rough = DoubleDouble::from(square.to_f64().sqrt().recip());
    let left = one.sub(&square.mul(&rough).mul(&rough));
    let inverse = rough.add(&halved(&rough.mul(&left)));
    let scale = inverse.mul(&DoubleDouble::from(f64::from(QUATERNION_BITS).exp2()));
    let mut whole = [0; 4];
    for (place, entry) in whole.iter_mut().zip(&table[best]) {
        *place = nearest_whole(entry.mul(&scale))?;
    }
    Some(whole)
}

/// The nearest whole number, below 2^62 in size.
#[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2^62")]
fn nearest_whole(x: DoubleDouble) -> Option<i64> {
    let high = x.to_f64().round();
    if !(high.abs() < 62_f64.exp2()) {
        return None;
    }
    let rest = x.sub(&DoubleDouble::from(high)).to_f64().round();
    Some(high as i64 + rest as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::number::Number;
    use crate::kinematics::decimal::Decimal;
    use rug::Rational;

    fn decimal(x: f64) -> Plain {
        Plain::Typed(Decimal::read(&format!("{x:?}")).unwrap())
    }

    /// Returns whether two motions are equal up to the error that an entry of 0 has in twice the digits.
    fn agree(one: &Motion<f64>, two: &Motion<f64>) -> bool {
        let entries =
            |motion: &Motion<f64>| [motion.rotation[0], motion.rotation[1], motion.rotation[2], motion.translation];
        entries(one).iter().flatten().zip(entries(two).iter().flatten()).all(|(x, y)| (x - y).abs() < 1e-30)
    }

    /// Rows of a rotation matrix, as they are printed, and a position.
    fn rows(k: u32) -> [[Plain; 4]; 3] {
        let angle = |j: u32| f64::from(7 * k + j).sin() * 3.0;
        let turn = Motion::rotation_z(angle(0).cos(), angle(0).sin())
            .then_after(&Motion::rotation_x(angle(1).cos(), angle(1).sin()))
            .then_after(&Motion::rotation_z(angle(2).cos(), angle(2).sin()));
        std::array::from_fn(|i| {
            let [x, y, z] = turn.rotation[i];
            [x, y, z, angle(3 + u32::try_from(i).unwrap())].map(decimal)
        })
    }

    #[test]
    fn a_matrix_is_placed_as_by_exact_numbers() {
        for k in 0..200 {
            let rows = rows(k);
            let fast = Placement::of_rounded_matrix(&rows).unwrap();
            let last = [0, 0, 0, 1].map(|n| Number::exact(Rational::from(n)));
            let [first, second, third] = rows.map(|row| row.map(Plain::number));
            let (slow, warning) = Placement::from_matrix(&[first, second, third, last]).unwrap();
            assert!(warning.is_none());
            assert_eq!(fast.exact, slow.exact, "{k}");
            assert_eq!(fast.rows(), slow.rows(), "{k}");
            assert!(agree(&fast.float, &slow.float), "{k}");
            assert!((fast.defect - slow.defect).abs() < 1e-30, "{k}");
            assert!(agree(&fast.inverse_in_f64().unwrap(), &slow.inverse_image().unwrap()), "{k}");
        }
    }

    #[test]
    fn a_quaternion_is_placed_as_by_exact_numbers() {
        for k in 0..200 {
            let mut quaternion: [f64; 4] = std::array::from_fn(|j| f64::from(5 * k + u32::try_from(j).unwrap()).cos());
            let length = quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
            // As typed with all digits, with nine, and hardly known.
            let scale = [1.0, 1.0 + 1e-9, 1.0 - 2e-3][k as usize % 3];
            for q in &mut quaternion {
                *q *= scale / length;
            }
            let (quaternion, position) = (quaternion.map(decimal), [0.1, -2.5, 3e-7].map(decimal));
            let (fast, noted) = Placement::of_rounded_quaternion(&quaternion, &position).unwrap();
            let numbers = (quaternion.map(Plain::number), position.map(Plain::number));
            let (slow, warning) = Placement::from_quaternion_position(&numbers.0, &numbers.1).unwrap();
            assert_eq!(warning, noted);
            assert_eq!(fast.exact, slow.exact, "{k}");
            assert!(agree(&fast.float, &slow.float), "{k}");
            assert!((fast.defect - slow.defect).abs() < 1e-20 + 1e-9 * slow.defect, "{k}");
            assert!(agree(&fast.inverse_in_f64().unwrap(), &slow.inverse_image().unwrap()), "{k}");
        }
    }

    #[test]
    fn doubles_are_placed_as_by_exact_numbers() {
        for k in 0..100 {
            let double = |x: Plain| Plain::of_double(x.number().to_f64()).unwrap();
            let rows = rows(k).map(|row| row.map(double));
            let fast = Placement::of_rounded_matrix(&rows).unwrap();
            let last = [0, 0, 0, 1].map(|n| Number::exact(Rational::from(n)));
            let [first, second, third] = rows.map(|row| row.map(Plain::number));
            let (slow, _) = Placement::from_matrix(&[first, second, third, last]).unwrap();
            assert_eq!(fast.exact, slow.exact, "{k}");
            assert!(agree(&fast.float, &slow.float), "{k}");
            assert!(agree(&fast.inverse_in_f64().unwrap(), &slow.inverse_image().unwrap()), "{k}");
        }
    }

    #[test]
    fn a_quaternion_of_another_length_is_refused() {
        let quaternion = [1.004, 0.0, 0.0, 0.0].map(decimal);
        assert!(Placement::of_rounded_quaternion(&quaternion, &[0.0; 3].map(decimal)).is_none());
    }

    #[test]
    fn a_quaternion_of_whole_numbers_is_placed_as_by_exact_numbers() {
        for k in 0..100_i64 {
            let quaternion = [1_i64 << 59, (k - 50) << 53, 1 << 57, 3 - k];
            let position = [0.1, -2.5e3, 1e-9 * f64::from(i32::try_from(k).unwrap())];
            let fast = Placement::of_whole_quaternion(quaternion, position).unwrap();
            let slow = Placement::from_motion_exact(fast.exact.motion());
            assert!(agree(&fast.float, &slow.float), "{k}");
            assert!(agree(&fast.inverse_in_f64().unwrap(), &slow.inverse_image().unwrap()), "{k}");
        }
        assert!(Placement::of_whole_quaternion([0; 4], [0.0; 3]).is_none());
    }

    #[test]
    fn what_is_exact_or_far_off_is_left_to_exact_numbers() {
        let exact = [[0.6, -0.8, 0.0, 1.0], [0.8, 0.6, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0]];
        let read = |rows: [[f64; 4]; 3]| Placement::of_rounded_matrix(&rows.map(|row| row.map(decimal)));
        assert!(read(exact).is_none());
        let mut off = exact;
        off[0][0] = 0.600_001;
        assert!(read(off).is_none());
        let mirrored = rows(1);
        assert!(Placement::of_rounded_matrix(&mirrored).is_some());
        assert!(Placement::of_rounded_matrix(&[mirrored[1], mirrored[0], mirrored[2]]).is_none());
    }
}
