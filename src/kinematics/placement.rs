//! Rigid motions as files give them: as a matrix, or as a quaternion and a position.

use super::chain::{Chain, Given, Placement};
use super::data_field::{ClosedForm, DataField};
use super::known_motion::KnownMotion;
use super::motion::Motion;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number, nearest_f64};
use crate::algebra::number_field::Algebraic;
use crate::algebra::real_field::RealField;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::surd::{Closed, Phase};
use crate::error::{Error, Result};
use rug::{Float, Rational};
use std::ops::Range;

/// Working precision of projections, bits.
const BITS: u32 = 192;
/// A rotation further than this from every rotation is a mistake.
pub(super) const REFUSED: f64 = 3e-3;
/// A rotation further than this from every rotation deserves a warning: it is more than f64 rounding.
const NOTED: f64 = 1e-12;
/// Bits of the quaternion of a rotation that is rounded to a rational one, and of the coordinates of its translation in parts
/// of the longest.
const DATUM_BITS: u32 = 60;

/// Steps to the polar factor: from 3e-3 off, each doubles the digits until all are there.
const POLAR_STEPS: usize = 9;

type Matrix3<T> = [[T; 3]; 3];

impl Placement {
    /// The placement that leaves everything where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self {
            exact: Motion::identity().into(),
            given: None,
            closed: None,
            rows: None,
            precise: None,
            float: Motion::identity(),
            defect: 0.0,
        }
    }

    /// The placement by a motion known exactly; its rotation must be one.
    #[must_use]
    pub fn from_motion_exact(exact: Motion<Rational>) -> Self {
        let row = |v: &[Rational; 3]| std::array::from_fn(|k| nearest_f64(&v[k]));
        let float =
            Motion { rotation: std::array::from_fn(|k| row(&exact.rotation[k])), translation: row(&exact.translation) };
        Self { exact: exact.into(), given: None, closed: None, rows: None, precise: None, float, defect: 0.0 }
    }

    /// The placement by a rational motion that stands for this one.
    #[must_use]
    pub fn standing_for(exact: Motion<Rational>, motion: Motion<Enclosure>, is_rotation: bool) -> Self {
        Self { given: Some(Box::new(Given { motion, is_rotation })), ..Self::from_motion_exact(exact) }
    }

    /// The placement by a position and the angles of roll, pitch and yaw, about fixed axes in this order.
    ///
    /// # Errors
    /// For an angle that is not known well enough.
    pub fn from_angles(angles: &[Angle; 3], position: &[Number; 3]) -> Result<Self> {
        let unknown = || Error::Invalid("found an angle that is not known well enough".to_owned());
        let mut exact = Motion::<Rational>::roll_pitch_yaw(angles).ok_or_else(unknown)?;
        exact.translation = position.each_ref().map(|x| x.rational().clone());
        if angles.iter().all(Angle::is_exact) && position.iter().all(Number::is_exact) {
            return Ok(Self::from_motion_exact(exact));
        }
        let mut enclosed = Motion::<Enclosure>::roll_pitch_yaw(angles).ok_or_else(unknown)?;
        enclosed.translation = position.each_ref().map(enclosure);
        let phases = || Some([angles[0].phase()?, angles[1].phase()?, angles[2].phase()?]);
        let closed = phases().and_then(|phases| {
            let lengths = position.iter().map(Number::closed).collect::<Option<Vec<_>>>()?;
            let all = phases.iter().flat_map(|(cos, sin)| [cos, sin]).chain(&lengths);
            let field = RealField::containing(all)?;
            let pair = |(cos, sin): &Phase| Some((field.element(cos)?, field.element(sin)?));
            let [roll, pitch, yaw] = phases.each_ref().map(pair);
            let mut motion = Motion::turned([roll?, pitch?, yaw?]);
            for (image, length) in motion.translation.iter_mut().zip(&lengths) {
                *image = field.element(length)?;
            }
            Some((field, motion))
        });
        Ok(Self::in_field_or_near(exact, enclosed, closed))
    }

    /// A motion of a number field, or else the rational one nearest to it, which is then the datum.
    fn in_field_or_near(
        exact: Motion<Rational>,
        enclosed: Motion<Enclosure>,
        closed: Option<(RealField, Motion<Algebraic>)>,
    ) -> Self {
        let Some((field, motion)) = closed else { return Self::near(&enclosed) };
        KnownMotion { exact, enclosed, algebraic: Some(motion) }.placement(Some(&field))
    }

    /// Returns the rational motion nearest to an enclosed one: its quaternion is four integers over 2^60, and its translation is
    /// rounded to the same number of bits of the longest coordinate.
    #[must_use]
    pub fn near(motion: &Motion<Enclosure>) -> Self {
        let rotation = motion.rotation.each_ref().map(|row| row.each_ref().map(|x| x.middle().clone()));
        let longest = motion.translation.iter().map(Enclosure::size).fold(i32::MIN, i32::max);
        let bits = DATUM_BITS.cast_signed().saturating_sub(longest.max(-1000));
        let translation = motion.translation.each_ref().map(|x| multiple(x.middle(), bits));
        Self::from_motion_exact(Motion { rotation: rational_rotation(&rotation), translation })
    }

    /// The motion with its entries in closed form, where it is given by joint values of a chain.
    #[must_use]
    pub fn in_entries(&self, chain: &Chain) -> Self {
        if !matches!(self.closed, Some(ClosedForm::Joints(_))) {
            return self.clone();
        }
        let closed = DataField::of(chain, Some(self), None).and_then(|field| Some((field.pose(chain, self)?, field)));
        let (exact, enclosed) = (self.exact.motion(), self.given.as_ref().map(|given| given.nearest()));
        match (closed, enclosed) {
            (closed, Some(enclosed)) => {
                Self::in_field_or_near(exact, enclosed, closed.map(|(motion, field)| (field.0, motion)))
            }
            (_, None) => Self::from_motion_exact(exact),
        }
    }

    /// The inverse motion.
    #[must_use]
    pub fn undone(&self) -> Self {
        self.part(Motion::inverse, Motion::inverse, Motion::inverse)
    }

    /// The rotation undone, without any translation.
    #[must_use]
    pub fn turned_back(&self) -> Self {
        fn part<R: Ring>(motion: &Motion<R>) -> Motion<R> {
            Motion { translation: Motion::identity().translation, ..motion.clone() }.inverse()
        }
        self.part(part, part, part)
    }

    /// The translation without the rotation.
    #[must_use]
    pub fn without_rotation(&self) -> Self {
        fn part<R: Ring>(motion: &Motion<R>) -> Motion<R> {
            Motion::translation(motion.translation.clone())
        }
        self.part(part, part, part)
    }

    /// Returns whether the z axis is proved to be parallel to that of the base, in the same or in the opposite direction.
    #[must_use]
    pub fn keeps_z(&self) -> bool {
        fn is_kept<R: Ring>(motion: &Motion<R>) -> bool {
            motion.rotation[2][..2].iter().all(Ring::is_zero)
        }
        match (&self.given, &self.closed) {
            (None, _) => is_kept(&self.exact.motion()),
            (Some(_), Some(ClosedForm::Entries(motion))) => RealField::containing(motion.rotation[2][..2].iter())
                .is_some_and(|field| {
                    motion.rotation[2][..2].iter().all(|x| field.element(x).is_some_and(|x| x.is_zero()))
                }),
            (Some(given), _) => is_kept(&given.nearest()),
        }
    }

    /// A part of the motion, taken of its rational entries and of what they stand for.
    fn part(
        &self,
        exact: impl Fn(&Motion<Rational>) -> Motion<Rational>,
        known: impl Fn(&Motion<Enclosure>) -> Motion<Enclosure>,
        closed: impl Fn(&Motion<Algebraic>) -> Motion<Algebraic>,
    ) -> Self {
        let Some(given) = &self.given else { return Self::from_motion_exact(exact(&self.exact)) };
        let field = match &self.closed {
            Some(ClosedForm::Entries(motion)) => {
                RealField::containing(motion.rotation.iter().flatten().chain(&motion.translation))
                    .and_then(|field| Some((motion.map(|x| field.element(x))?, field)))
            }
            Some(ClosedForm::Joints(_)) | None => None,
        };
        let (algebraic, field) = field.map_or((None, None), |(motion, field)| (Some(closed(&motion)), Some(field)));
        KnownMotion { exact: exact(&self.exact), enclosed: known(&given.nearest()), algebraic }
            .placement(field.as_ref())
    }

    /// The rows of the matrix that was given, where the exact motion only stands for it.
    #[must_use]
    pub fn rows(&self) -> Option<Box<[[Number; 4]; 3]>> {
        self.rows.clone().or_else(|| self.exact.rows())
    }

    /// The motion over any ring; `None` for an unlucky prime.
    #[must_use]
    pub fn image<R: Ring>(&self) -> Option<Motion<R>> {
        image(&self.exact, || Some(self.given.as_deref()?.nearest()))
    }

    /// The inverse motion over any ring; `None` for an unlucky prime.
    #[must_use]
    pub fn inverse_image<R: Ring>(&self) -> Option<Motion<R>> {
        image(&self.exact.inverse(), || Some(self.given.as_deref()?.nearest().inverse()))
    }

    /// The placement nearest to a homogeneous 4x4 matrix, and a warning where that is not the matrix to rounding.
    ///
    /// An exactly orthonormal rotation is kept. Any other is replaced by the nearest rotation (the polar factor),
    /// rounded to a rational one by its quaternion; the translation stays as given.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a last row other than 0 0 0 1, a reflection, or an entry more than 3e-3 off.
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
        let enclosed = |i: usize, j: usize| Enclosure::from_number(&rows[i][j]).unwrap_or_else(Enclosure::zero);
        let is_exact = |columns: Range<usize>| (0..3).all(|i| columns.clone().all(|j| rows[i][j].is_exact()));
        if is_exact(0..3) && is_orthonormal(&given) {
            let motion = Motion { rotation: given, translation };
            if is_exact(3..4) {
                return Ok((Self::from_motion_exact(motion), None));
            }
            let rotation = motion.rotation.each_ref().map(|row| row.each_ref().map(Enclosure::of));
            let translation = std::array::from_fn(|i| enclosed(i, 3));
            let placed = Self::standing_for(motion, Motion { rotation, translation }, true);
            return Ok((Self { closed: in_closed_form(rows), rows: upper(rows), ..placed }, None));
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
        let motion = Motion { rotation, translation };
        let placement = if is_exact(0..4) {
            // The nearest rotation is the datum.
            Self { defect, rows: upper(rows), ..Self::from_motion_exact(motion) }
        } else {
            let given = Motion {
                rotation: std::array::from_fn(|i| std::array::from_fn(|j| enclosed(i, j))),
                translation: std::array::from_fn(|i| enclosed(i, 3)),
            };
            Self { defect, closed: in_closed_form(rows), rows: upper(rows), ..Self::standing_for(motion, given, false) }
        };
        Ok((placement, noted(defect, "the rotation matrix is off by")))
    }

    /// The placement by a position and a quaternion `[w, x, y, z]`, which is normalised exactly.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the quaternion's norm is more than 3e-3 from 1.
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
        let is_exact = quaternion.iter().chain(position).all(Number::is_exact);
        let enclosed = if is_exact { None } else { enclosed_rotation(quaternion) };
        let placed = match enclosed {
            None => Self::from_motion_exact(motion),
            Some(rotation) => {
                let enclosed = Motion { rotation, translation: position.each_ref().map(enclosure) };
                Self::in_field_or_near(motion, enclosed, in_field(quaternion, position))
            }
        };
        let placement = Self { defect, ..placed };
        Ok((placement, noted_norm(defect)))
    }
}

/// Returns the warning about a quaternion whose norm is this far from 1, where it deserves one.
pub(super) fn noted_norm(defect: f64) -> Option<String> {
    noted(defect, "the norm of the quaternion is off by")
}

/// The rows of a motion without the last one.
#[expect(clippy::unnecessary_wraps, reason = "the form in which a placement keeps them")]
fn upper([first, second, third, _]: &[[Number; 4]; 4]) -> Option<Box<[[Number; 4]; 3]>> {
    Some(Box::new([first.clone(), second.clone(), third.clone()]))
}

/// A number, enclosed.
fn enclosure(x: &Number) -> Enclosure {
    Enclosure::from_number(x).unwrap_or_else(Enclosure::zero)
}

/// The integer multiple of `2^-bits` nearest to a number.
fn multiple(x: &Float, bits: i32) -> Rational {
    let scaled = Float::with_val(BITS, x << bits).round();
    scaled.to_rational().map_or_else(Rational::new, |q| q >> bits)
}

/// The motion of a quaternion and a position in the field of their numbers, where there is one.
fn in_field(quaternion: &[Number; 4], position: &[Number; 3]) -> Option<(RealField, Motion<Algebraic>)> {
    let closed: Vec<Closed> = quaternion.iter().chain(position).map(Number::closed).collect::<Option<_>>()?;
    let field = RealField::containing(&closed)?;
    let all: Vec<Algebraic> = closed.iter().map(|x| field.element(x)).collect::<Option<_>>()?;
    let [w, x, y, z, translation @ ..] = all.as_slice() else { return None };
    let rotation = rotation_over([w, x, y, z])?;
    let translation = translation.to_vec().try_into().ok()?;
    Some((field, Motion { rotation, translation }))
}

/// The motion of a matrix of which some entries are irrational, where closed forms of all are known.
fn in_closed_form(rows: &[[Number; 4]; 4]) -> Option<ClosedForm> {
    if rows.iter().flatten().all(Number::is_exact) {
        return None;
    }
    let row =
        |i: usize| -> Option<[Closed; 3]> { Some([rows[i][0].closed()?, rows[i][1].closed()?, rows[i][2].closed()?]) };
    let translation = [rows[0][3].closed()?, rows[1][3].closed()?, rows[2][3].closed()?];
    Some(ClosedForm::Entries(Box::new(Motion { rotation: [row(0)?, row(1)?, row(2)?], translation })))
}

impl Given {
    /// The motion given, or the nearest one.
    fn nearest(&self) -> Motion<Enclosure> {
        if self.is_rotation {
            return self.motion.clone();
        }
        Motion { rotation: polar_factor(self.motion.rotation.clone()), translation: self.motion.translation.clone() }
    }
}

/// A motion over any ring, by its rational entries or by what they stand for.
pub(super) fn image<R: Ring>(
    exact: &Motion<Rational>,
    enclosed: impl FnOnce() -> Option<Motion<Enclosure>>,
) -> Option<Motion<R>> {
    let Some(enclosed) = R::ENCLOSES.then(enclosed).flatten() else { return exact.map(R::from_rational) };
    let vector = |q: &[Rational; 3], known: &[Enclosure; 3]| -> Option<[R; 3]> {
        let entry = |k: usize| R::from_known(&q[k], Some(&known[k]));
        Some([entry(0)?, entry(1)?, entry(2)?])
    };
    let row = |i: usize| vector(&exact.rotation[i], &enclosed.rotation[i]);
    Some(Motion {
        rotation: [row(0)?, row(1)?, row(2)?],
        translation: vector(&exact.translation, &enclosed.translation)?,
    })
}

/// The rotation of a quaternion of any length; `None` where that may be zero.
fn enclosed_rotation(quaternion: &[Number; 4]) -> Option<Matrix3<Enclosure>> {
    let known: Vec<Enclosure> = quaternion.iter().filter_map(Enclosure::from_number).collect();
    let [w, x, y, z] = known.as_slice() else { return None };
    let square = |a: &Enclosure| a.mul(a);
    let (ww, xx, yy, zz) = (square(w), square(x), square(y), square(z));
    let norm = ww.add(&xx).add(&yy).add(&zz);
    let diagonal = |a: &Enclosure, b: &Enclosure, c: &Enclosure| ww.add(a).sub(b).sub(c).over(&norm);
    let beside = |a: Enclosure, b: Enclosure| a.add(&b).mul(&Enclosure::from_integer(2)).over(&norm);
    let (wx, wy, wz) = (w.mul(x), w.mul(y), w.mul(z));
    let (xy, xz, yz) = (x.mul(y), x.mul(z), y.mul(z));
    Some([
        [diagonal(&xx, &yy, &zz)?, beside(xy.clone(), wz.neg())?, beside(xz.clone(), wy.clone())?],
        [beside(xy, wz)?, diagonal(&yy, &xx, &zz)?, beside(yz.clone(), wx.neg())?],
        [beside(xz, wy.neg())?, beside(yz, wx)?, diagonal(&zz, &xx, &yy)?],
    ])
}

/// The polar factor of a matrix that is nearly a rotation.
///
/// A step `M (3 - M^T M) / 2` keeps the polar factor and takes every singular value s to `s (3 - s^2) / 2`. Where
/// `|M^T M - 1| <= e` no singular value is farther than e from 1, and M no farther than e from its polar factor.
fn polar_factor(mut m: Matrix3<Enclosure>) -> Matrix3<Enclosure> {
    let dot =
        |a: [&Enclosure; 3], b: [&Enclosure; 3]| (0..3).fold(Enclosure::zero(), |sum, k| sum.add(&a[k].mul(b[k])));
    let half = Enclosure::of(&Rational::from((1, 2)));
    for _ in 0..POLAR_STEPS {
        let column = |j: usize| [&m[0][j], &m[1][j], &m[2][j]];
        let factor: Matrix3<Enclosure> = std::array::from_fn(|i| {
            std::array::from_fn(|j| Enclosure::from_integer(if i == j { 3 } else { 0 }).sub(&dot(column(i), column(j))))
        });
        let column = |j: usize| [&factor[0][j], &factor[1][j], &factor[2][j]];
        m = std::array::from_fn(|i| std::array::from_fn(|j| dot(m[i].each_ref(), column(j)).mul(&half)));
    }
    let column = |j: usize| [&m[0][j], &m[1][j], &m[2][j]];
    let gram = |i: usize, j: usize| dot(column(i), column(j)).sub(&Enclosure::from_integer(i32::from(i == j)));
    // Rows have three entries, each below a power of two.
    let off = (0..9).map(|k| gram(k / 3, k % 3)).map(|x| x.off().max(x.size())).fold(i32::MIN, i32::max);
    m.map(|row| row.map(|x| x.widened(off.saturating_add(2))))
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
#[must_use]
pub fn rotation_of(quaternion: [&Rational; 4]) -> Matrix3<Rational> {
    let norm: Rational = quaternion.iter().map(|q| Rational::from(q.square_ref())).sum();
    scaled_rotation(quaternion, &norm.recip())
}

/// The rotation of a quaternion of any length over a field; `None` for zero.
pub(super) fn rotation_over<R: Field>(quaternion: [&R; 4]) -> Option<Matrix3<R>> {
    let norm = quaternion.iter().fold(R::zero(), |sum, q| sum.add(&q.mul(q)));
    Some(scaled_rotation(quaternion, &norm.inverse()?))
}

/// The rotation of a quaternion of which the inverse of the squared norm is given.
fn scaled_rotation<R: Ring>([w, x, y, z]: [&R; 4], scale: &R) -> Matrix3<R> {
    let (ww, xx, yy, zz) = (w.mul(w), x.mul(x), y.mul(y), z.mul(z));
    let diagonal = |a: &R, b: &R, c: &R| ww.add(a).sub(b).sub(c).mul(scale);
    let beside = |a: R, b: R| a.add(&b).mul(&R::from_integer(2)).mul(scale);
    [
        [diagonal(&xx, &yy, &zz), beside(x.mul(y), w.mul(z).neg()), beside(x.mul(z), w.mul(y))],
        [beside(x.mul(y), w.mul(z)), diagonal(&yy, &xx, &zz), beside(y.mul(z), w.mul(x).neg())],
        [beside(x.mul(z), w.mul(y).neg()), beside(y.mul(z), w.mul(x)), diagonal(&zz, &xx, &yy)],
    ]
}

/// The rotation of four integers over 2^60 nearest to the polar factor of a matrix that is nearly a rotation.
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

/// The rotation of the quaternion of `m`, rounded to four integers over 2^60.
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
    let square = table[best].iter().fold(Float::new(BITS), |sum, x| sum + Float::with_val(BITS, x.square_ref()));
    let norm = square.sqrt();
    let [w, x, y, z]: [Rational; 4] =
        std::array::from_fn(|k| multiple(&Float::with_val(BITS, &table[best][k] / &norm), DATUM_BITS.cast_signed()));
    rotation_of([&w, &x, &y, &z])
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
        assert!(rotated(0.955, 0.2955).unwrap().1.unwrap().contains("off by"));
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
