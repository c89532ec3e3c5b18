//! Rigid motions as files give them: as a matrix, or as a quaternion and a position.

use super::chain::Placement;
use super::motion::Motion;
use crate::algebra::number::{Number, nearest_f64};
use crate::error::{Error, Result};
use rug::{Float, Rational};

/// Working precision of projections, bits.
const BITS: u32 = 192;
/// A rotation further than this from every rotation is a mistake.
const REFUSED: f64 = 1e-4;
/// A rotation further than this from every rotation deserves a warning: it is more than f64 rounding.
const NOTED: f64 = 1e-12;
/// Digits to which the ratios of the quaternion of a projected rotation are kept.
const DIGITS: u32 = 18;

type Matrix3<T> = [[T; 3]; 3];

impl Placement {
    /// The placement that leaves everything where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self { exact: Motion::identity(), float: Motion::identity(), defect: 0.0 }
    }

    /// The placement by a motion known exactly; its rotation must be one.
    #[must_use]
    pub fn from_motion_exact(exact: Motion<Rational>) -> Self {
        let row = |v: &[Rational; 3]| std::array::from_fn(|k| nearest_f64(&v[k]));
        let float =
            Motion { rotation: std::array::from_fn(|k| row(&exact.rotation[k])), translation: row(&exact.translation) };
        Self { exact, float, defect: 0.0 }
    }

    /// The placement nearest to a homogeneous 4x4 matrix, and a warning where that is not the matrix to rounding.
    ///
    /// An exactly orthonormal rotation is kept. Any other is replaced by the nearest rotation (the polar factor),
    /// rounded to a rational one by its quaternion; the translation stays as given.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a last row other than 0 0 0 1, a reflection, or an entry more than 1e-4 off.
    pub fn from_matrix(rows: &[[Number; 4]; 4]) -> Result<(Self, Option<String>)> {
        let last: [f64; 4] = std::array::from_fn(|k| rows[3][k].to_f64());
        let is_last = |k: usize| *rows[3][k].rational() == u32::from(k == 3);
        if !(0..4).all(is_last) {
            let [a, b, c, d] = last;
            return Err(Error::Invalid(format!("found the last row [{a}, {b}, {c}, {d}], expected [0, 0, 0, 1]")));
        }
        let given: Matrix3<Rational> = std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j].rational().clone()));
        let translation = std::array::from_fn(|i| rows[i][3].rational().clone());
        if determinant(&given) <= 0 {
            let found = nearest_f64(&determinant(&given));
            return Err(Error::Invalid(format!(
                "found a rotation with determinant {found:.6}, expected 1 (a reflection is no rotation)"
            )));
        }
        let exact = (0..3).all(|i| (0..3).all(|j| rows[i][j].is_exact()));
        if exact && is_orthonormal(&given) {
            return Ok((Self::from_motion_exact(Motion { rotation: given, translation }), None));
        }
        let rotation = nearest_rotation(&given)?;
        let mut defect = 0.0_f64;
        for i in 0..3 {
            for j in 0..3 {
                defect = defect.max(nearest_f64(&Rational::from(&given[i][j] - &rotation[i][j])).abs());
            }
        }
        if defect > REFUSED {
            return Err(not_a_rotation(defect));
        }
        let placement = Self { defect, ..Self::from_motion_exact(Motion { rotation, translation }) };
        Ok((placement, noted(defect, "the rotation matrix is off by")))
    }

    /// The placement by a position and a quaternion `[w, x, y, z]`, which is normalised exactly.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the quaternion's norm is more than 1e-4 from 1.
    pub fn from_quaternion_position(
        quaternion: &[Number; 4],
        position: &[Number; 3],
    ) -> Result<(Self, Option<String>)> {
        let [w, x, y, z]: [&Rational; 4] = std::array::from_fn(|k| quaternion[k].rational());
        let square: Rational = [w, x, y, z].iter().map(|q| Rational::from(q.square_ref())).sum();
        let norm = Float::with_val(BITS, &square).sqrt();
        let defect = Float::with_val(BITS, &norm - 1).abs().to_f64();
        if defect > REFUSED {
            return Err(Error::Invalid(format!(
                "found a quaternion of norm {:.6}, expected 1 to within {REFUSED:e}",
                norm.to_f64()
            )));
        }
        let translation = std::array::from_fn(|k| position[k].rational().clone());
        let motion = Motion { rotation: rotation_of([w, x, y, z]), translation };
        let placement = Self { defect, ..Self::from_motion_exact(motion) };
        Ok((placement, noted(defect, "the norm of the quaternion is off by")))
    }
}

fn noted(defect: f64, what: &str) -> Option<String> {
    (defect > NOTED).then(|| format!("{what} {defect:.1e}; the nearest rotation was taken"))
}

fn not_a_rotation(defect: f64) -> Error {
    Error::Invalid(format!("found a rotation matrix off by {defect:.1e}, expected a rotation to within {REFUSED:e}"))
}

fn determinant(m: &Matrix3<Rational>) -> Rational {
    super::motion::dot(&m[0], &super::motion::cross(&m[1], &m[2]))
}

fn is_orthonormal(m: &Matrix3<Rational>) -> bool {
    (0..3).all(|i| (0..3).all(|j| super::motion::dot(&m[i], &m[j]) == u32::from(i == j)))
}

/// The rotation of a nonzero quaternion of any length.
fn rotation_of([w, x, y, z]: [&Rational; 4]) -> Matrix3<Rational> {
    let product = |a: &Rational, b: &Rational| Rational::from(a * b);
    let (ww, xx, yy, zz) = (product(w, w), product(x, x), product(y, y), product(z, z));
    let norm = Rational::from(&ww + &xx) + &yy + &zz;
    let diagonal = |a: &Rational, b: &Rational, c: &Rational| (Rational::from(&ww + a) - b - c) / &norm;
    let beside = |a: Rational, b: Rational| (a + b) * 2 / &norm;
    [
        [diagonal(&xx, &yy, &zz), beside(product(x, y), -product(w, z)), beside(product(x, z), product(w, y))],
        [beside(product(x, y), product(w, z)), diagonal(&yy, &xx, &zz), beside(product(y, z), -product(w, x))],
        [beside(product(x, z), -product(w, y)), beside(product(y, z), product(w, x)), diagonal(&zz, &xx, &yy)],
    ]
}

/// A rational rotation within `10^-DIGITS` of the polar factor of a matrix that is nearly a rotation.
fn nearest_rotation(given: &Matrix3<Rational>) -> Result<Matrix3<Rational>> {
    let mut m: Matrix3<Float> = std::array::from_fn(|i| std::array::from_fn(|j| Float::with_val(BITS, &given[i][j])));
    // Newton-Schulz M (3 - M^T M) / 2 converges quadratically to the polar factor; the first error bounds the rest.
    for step in 0..8 {
        let gram: Matrix3<Float> = std::array::from_fn(|i| std::array::from_fn(|j| column_product(&m, i, j)));
        let mut error = 0.0_f64;
        for (i, row) in gram.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                error = error.max(Float::with_val(BITS, entry - u32::from(i == j)).abs().to_f64());
            }
        }
        // The diagonal of the Gram matrix bounds every entry, so that the error is a number.
        if step == 0 && error >= 8.0 * REFUSED {
            return Err(not_a_rotation(error / 2.0));
        }
        if error < 1e-40 {
            break;
        }
        m = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let image: Float =
                    (0..3).map(|k| Float::with_val(BITS, &m[i][k] * &gram[k][j])).fold(Float::new(BITS), |s, x| s + x);
                (Float::with_val(BITS, &m[i][j] * 3_u32) - image) / 2_u32
            })
        });
    }
    Ok(rational_rotation(&m))
}

fn column_product(m: &Matrix3<Float>, i: usize, j: usize) -> Float {
    (0..3).fold(Float::new(BITS), |sum, k| sum + Float::with_val(BITS, &m[k][i] * &m[k][j]))
}

/// The rotation of the quaternion of `m`, its ratios to the largest component rounded to simple rationals.
fn rational_rotation(m: &Matrix3<Float>) -> Matrix3<Rational> {
    let plus = |a: &Float, b: &Float| Float::with_val(BITS, a + b);
    let minus = |a: &Float, b: &Float| Float::with_val(BITS, a - b);
    let trace =
        |s: [i32; 3]| (0..3).fold(Float::with_val(BITS, 1), |sum, k| sum + Float::with_val(BITS, &m[k][k] * s[k]));
    // Four times the outer product of the quaternion with itself; the row with the largest diagonal is taken.
    let table: [[Float; 4]; 4] = [
        [trace([1, 1, 1]), minus(&m[2][1], &m[1][2]), minus(&m[0][2], &m[2][0]), minus(&m[1][0], &m[0][1])],
        [minus(&m[2][1], &m[1][2]), trace([1, -1, -1]), plus(&m[0][1], &m[1][0]), plus(&m[0][2], &m[2][0])],
        [minus(&m[0][2], &m[2][0]), plus(&m[0][1], &m[1][0]), trace([-1, 1, -1]), plus(&m[1][2], &m[2][1])],
        [minus(&m[1][0], &m[0][1]), plus(&m[0][2], &m[2][0]), plus(&m[1][2], &m[2][1]), trace([-1, -1, 1])],
    ];
    let mut best = 0;
    for k in 1..4 {
        if table[k][k] > table[best][best] {
            best = k;
        }
    }
    let ratio: [Rational; 4] =
        std::array::from_fn(|k| Number::near(&Float::with_val(BITS, &table[best][k] / &table[best][best]), DIGITS));
    rotation_of([&ratio[0], &ratio[1], &ratio[2], &ratio[3]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [[f64; 4]; 4]) -> [[Number; 4]; 4] {
        entries.map(|row| row.map(Number::from_f64))
    }

    #[test]
    fn an_exact_rotation_is_kept() {
        let fifth = |n: i32| Number::exact(Rational::from((n, 5)));
        let n = |n: i32| Number::exact(Rational::from(n));
        let rows = [
            [fifth(3), fifth(-4), n(0), n(1)],
            [fifth(4), fifth(3), n(0), n(2)],
            [n(0), n(0), n(1), n(3)],
            [n(0), n(0), n(0), n(1)],
        ];
        let (placement, warning) = Placement::from_matrix(&rows).unwrap();
        assert_eq!(placement.exact.rotation[0][1], Rational::from((-4, 5)));
        assert_eq!((placement.defect, warning), (0.0, None));
    }

    #[test]
    fn a_rounded_rotation_is_projected_and_its_image_orthonormal() {
        let (c, s) = (0.3_f64.cos(), 0.3_f64.sin());
        let rows = matrix([[c, -s, 0.0, 1.0], [s, c, 0.0, 2.0], [0.0, 0.0, 1.0, 0.1], [0.0, 0.0, 0.0, 1.0]]);
        let (placement, warning) = Placement::from_matrix(&rows).unwrap();
        assert!(is_orthonormal(&placement.exact.rotation));
        assert!(placement.defect < 2e-16 && warning.is_none());
        assert!((placement.float.rotation[0][0] - c).abs() < 2e-16);
    }

    #[test]
    fn printed_digits_warn_and_mistakes_are_refused() {
        let rotated = |c: f64, s: f64| {
            Placement::from_matrix(&matrix([
                [c, -s, 0.0, 1.0],
                [s, c, 0.0, 2.0],
                [0.0, 0.0, 1.0, 0.1],
                [0.0, 0.0, 0.0, 1.0],
            ]))
        };
        assert!(rotated(0.955_336, 0.295_520).unwrap().1.unwrap().contains("off by"));
        assert!(rotated(0.95, 0.29).unwrap_err().to_string().contains("off by"));
        assert!(rotated(0.955, 0.2955).unwrap_err().to_string().contains("off by"));
        assert!(rotated(1e100, 0.0).is_err());
        let reflection =
            matrix([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        assert!(Placement::from_matrix(&reflection).unwrap_err().to_string().contains("reflection"));
    }

    #[test]
    fn half_turns_have_a_quaternion_too() {
        let d = 1e-9;
        for k in 0..3 {
            let mut rows = [[0.0; 4]; 4];
            for (i, row) in rows.iter_mut().enumerate() {
                row[i] = if i == k || i == 3 { 1.0 } else { -1.0 };
            }
            rows[0][1] = d;
            let (placement, _) = Placement::from_matrix(&matrix(rows)).unwrap();
            assert!(is_orthonormal(&placement.exact.rotation));
            assert!((placement.float.rotation[k][k] - 1.0).abs() < 1e-8);
        }
    }

    #[test]
    fn quaternions_are_normalised() {
        let n = |x: f64| Number::from_f64(x);
        let half = [n(0.5), n(0.5), n(0.5), n(0.500_000_1)];
        let (placement, warning) = Placement::from_quaternion_position(&half, &[n(0.0), n(0.0), n(0.0)]).unwrap();
        assert!(is_orthonormal(&placement.exact.rotation) && warning.is_some());
        assert!(
            Placement::from_quaternion_position(
                &[n(0.0), n(0.0), n(0.0), n(0.0)],
                &half[..3].to_vec().try_into().unwrap()
            )
            .is_err()
        );
    }
}
