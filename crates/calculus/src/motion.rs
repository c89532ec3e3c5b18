//! Rigid motions over any ring: a rotation matrix and a translation, acting on column points.

use looproot_algebra::number::Angle;
use looproot_algebra::ring::{Ring, formula};

/// A vector of the space.
pub type Vector<R> = [R; 3];

/// A rigid motion `p -> rotation p + translation`.
///
/// # Units
/// `translation` is in the unit of length of the mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<R> {
    /// Rows of the rotation matrix.
    pub rotation: [[R; 3]; 3],
    /// The image of the origin.
    pub translation: Vector<R>,
}

/// Returns `x . y`.
#[inline(always)]
pub fn dot<R: Ring>(x: &Vector<R>, y: &Vector<R>) -> R {
    formula::<R, _>(|| x[0].mul(&y[0]).add(&x[1].mul(&y[1])).add(&x[2].mul(&y[2])))
}

/// Returns `x x y`.
#[inline(always)]
pub fn cross<R: Ring>(x: &Vector<R>, y: &Vector<R>) -> Vector<R> {
    formula::<R, _>(|| {
        [
            x[1].mul(&y[2]).sub(&x[2].mul(&y[1])),
            x[2].mul(&y[0]).sub(&x[0].mul(&y[2])),
            x[0].mul(&y[1]).sub(&x[1].mul(&y[0])),
        ]
    })
}

impl<R: Ring> Motion<R> {
    /// Returns the identity.
    #[must_use]
    pub fn identity() -> Self {
        let row = |k: usize| std::array::from_fn(|j| if j == k { R::one() } else { R::zero() });
        Self { rotation: std::array::from_fn(row), translation: std::array::from_fn(|_| R::zero()) }
    }

    /// Returns `Rz`, the rotation about the z axis with the given cosine and sine.
    #[must_use]
    pub fn rotation_z(cos: R, sin: R) -> Self {
        let mut m = Self::identity();
        m.rotation[0] = [cos.clone(), sin.neg(), R::zero()];
        m.rotation[1] = [sin, cos, R::zero()];
        m
    }

    /// Returns the rotation about a coordinate axis (0 for x) with the given cosine and sine.
    #[must_use]
    pub fn rotation_about(axis: usize, cos: R, sin: R) -> Self {
        // A cycle of the axes leads from z to any of them.
        let place = |k: usize| (k + 5 - axis) % 3;
        let about_z = Self::rotation_z(cos, sin).rotation;
        let row = |i: usize| std::array::from_fn(|j| about_z[place(i)][place(j)].clone());
        Self { rotation: std::array::from_fn(row), ..Self::identity() }
    }

    /// Returns `Rx`, the rotation about the x axis with the given cosine and sine.
    #[must_use]
    pub fn rotation_x(cos: R, sin: R) -> Self {
        let mut m = Self::identity();
        m.rotation[1] = [R::zero(), cos.clone(), sin.neg()];
        m.rotation[2] = [R::zero(), sin, cos];
        m
    }

    /// Returns the roll about x, then pitch about y, then yaw about z, all about fixed axes: `Rz(yaw) Ry(pitch) Rx(roll)`. `None`
    /// for an unlucky prime.
    #[must_use]
    pub fn roll_pitch_yaw([roll, pitch, yaw]: &[Angle; 3]) -> Option<Self> {
        Some(Self::turned([R::cos_sin(roll)?, R::cos_sin(pitch)?, R::cos_sin(yaw)?]))
    }

    /// As [`Motion::roll_pitch_yaw`], by cosine and sine of each angle.
    #[must_use]
    pub fn turned([roll, pitch, yaw]: [(R, R); 3]) -> Self {
        let about_x = Self::rotation_x(roll.0, roll.1);
        let (cos, sin) = pitch;
        let mut about_y = Self::identity();
        about_y.rotation[0] = [cos.clone(), R::zero(), sin.clone()];
        about_y.rotation[2] = [sin.neg(), R::zero(), cos];
        Self::rotation_z(yaw.0, yaw.1).then_after(&about_y).then_after(&about_x)
    }

    /// Returns `Tx(a) Rx(alpha)` with the given length, and cosine and sine of the twist.
    #[must_use]
    pub fn link(a: R, (cos, sin): (R, R)) -> Self {
        Self { translation: [a, R::zero(), R::zero()], ..Self::rotation_x(cos, sin) }
    }

    /// Returns a pure translation.
    #[must_use]
    pub fn translation(vector: Vector<R>) -> Self {
        Self { translation: vector, ..Self::identity() }
    }

    /// Returns `Tz`, the translation along the z axis.
    #[must_use]
    pub fn translation_z(d: R) -> Self {
        Self::translation([R::zero(), R::zero(), d])
    }

    /// Returns `rotation v`, for directions.
    #[inline(always)]
    pub fn rotate(&self, v: &Vector<R>) -> Vector<R> {
        formula::<R, _>(|| std::array::from_fn(|i| dot(&self.rotation[i], v)))
    }

    /// Returns the image of a point.
    #[inline(always)]
    pub fn apply(&self, p: &Vector<R>) -> Vector<R> {
        formula::<R, _>(|| {
            let rotated = self.rotate(p);
            std::array::from_fn(|i| rotated[i].add(&self.translation[i]))
        })
    }

    /// Returns `self * other`, which applies `other` first.
    #[must_use]
    #[inline(always)]
    pub fn then_after(&self, other: &Self) -> Self {
        formula::<R, _>(|| {
            let column = |j: usize| -> Vector<R> { std::array::from_fn(|k| other.rotation[k][j].clone()) };
            let columns: [Vector<R>; 3] = std::array::from_fn(column);
            Self {
                rotation: std::array::from_fn(|i| std::array::from_fn(|j| dot(&self.rotation[i], &columns[j]))),
                translation: self.apply(&other.translation),
            }
        })
    }

    /// Returns the inverse motion, by the transpose of the rotation.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let transposed = Self {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i].clone())),
            translation: std::array::from_fn(|_| R::zero()),
        };
        let back = transposed.rotate(&self.translation);
        Self { translation: std::array::from_fn(|i| back[i].neg()), ..transposed }
    }
}

impl Motion<f64> {
    /// Returns the motion with lengths over a unit.
    #[inline]
    #[must_use]
    pub fn over(&self, unit: f64) -> Self {
        Self { translation: self.translation.map(|x| x / unit), ..self.clone() }
    }

    /// Returns the rotation from this orientation to another one, as a vector along its axis as long as its angle in radians; 0 for a
    /// half turn, whose axis the skew part of a matrix does not show.
    #[must_use]
    pub fn turn_to(&self, other: &Self) -> Vector<f64> {
        let entry = |i: usize, j: usize| (0..3).map(|k| other.rotation[i][k] * self.rotation[j][k]).sum::<f64>();
        let skew = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| (entry(i, j) - entry(j, i)) / 2.0);
        let sine = skew.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine = ((0..3).map(|k| entry(k, k)).sum::<f64>() - 1.0) / 2.0;
        let stretched = if sine > 0.0 { sine.atan2(cosine) / sine } else { 1.0 };
        skew.map(|x| x * stretched)
    }
}

/// Returns the power of two nearest to a mean length, by which dividing costs no digit; 1 where there are no lengths.
#[must_use]
pub fn unit_near(mean: f64) -> f64 {
    if mean.is_normal() { mean.log2().round().exp2() } else { 1.0 }
}

impl<R> Motion<R> {
    /// Returns the same motion over another ring; `None` if an entry has no image.
    pub fn map<S>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Motion<S>> {
        let vector = |v: &Vector<R>| -> Option<Vector<S>> { Some([image(&v[0])?, image(&v[1])?, image(&v[2])?]) };
        Some(Motion {
            rotation: [vector(&self.rotation[0])?, vector(&self.rotation[1])?, vector(&self.rotation[2])?],
            translation: vector(&self.translation)?,
        })
    }
}

/// Returns the link motion `Tx(a) Rx(alpha)` of the Denavit-Hartenberg forms; `None` for an unlucky prime.
#[must_use]
pub fn link<R: Ring>(a: &looproot_algebra::number::Number, alpha: &Angle) -> Option<Motion<R>> {
    Some(Motion::link(R::from_number(a)?, R::cos_sin(alpha)?))
}
