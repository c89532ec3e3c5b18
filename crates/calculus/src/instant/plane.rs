//! The motion of a body in the plane near one position, by derivatives with respect to the angle of the body.
//!
//! The body's point with the complex coordinate p is at `z = A(f) + p exp(i f)`. With `u = z - pole` the derivatives of every path
//! follow from two complex numbers, `a_2 = A'' - i A'` and `a_3 = A''' + A'`: `z' = i u`, `z'' = a_2 - u`.

use crate::unit::{Root, Unit};
use looproot_algebra::ring::Ring;
use num_complex::Complex;

/// Pole and the numbers a_2, a_3 of a motion at one position.
///
/// # Units
/// All are lengths: derivatives are taken by the angle of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant<R> {
    /// The point of the body without velocity.
    pub pole: Complex<R>,
    /// `A'' - i A'`, the vector from the pole to the inflection pole.
    pub second: Complex<R>,
    /// `A''' + A'`
    pub third: Complex<R>,
}

/// Returns `i z`.
fn turned<R: Ring>(z: &Complex<R>) -> Complex<R> {
    Complex { re: z.im.neg(), im: z.re.clone() }
}

/// Returns `Re(conj(a) b)`.
fn scalar<R: Ring>(a: &Complex<R>, b: &Complex<R>) -> R {
    a.re.mul(&b.re).add(&a.im.mul(&b.im))
}

/// Returns `Im(conj(a) b)`.
fn area<R: Ring>(a: &Complex<R>, b: &Complex<R>) -> R {
    a.re.mul(&b.im).sub(&a.im.mul(&b.re))
}

fn scaled<R: Ring>(z: &Complex<R>, factor: &R) -> Complex<R> {
    Complex { re: z.re.mul(factor), im: z.im.mul(factor) }
}

impl<R: Ring> Instant<R> {
    /// Returns the instant of a body whose origin is at `A`, from A and its derivatives by the angle of the body.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::instant::plane::Instant;
    /// use num_complex::Complex;
    /// let z = |re: f64, im: f64| Complex { re, im };
    /// // A wheel of radius 1 that rolls on the x axis to the right: A = -f + i.
    /// let wheel = Instant::of(&[z(0.0, 1.0), z(-1.0, 0.0), z(0.0, 0.0), z(0.0, 0.0)]);
    /// assert_eq!(wheel.pole, z(0.0, 0.0));
    /// // The inflection circle of a wheel on a line goes through its centre.
    /// assert_eq!(wheel.second, z(0.0, 1.0));
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 15.2\]
    #[must_use]
    pub fn of([origin, first, second, third]: &[Complex<R>; 4]) -> Self {
        Self { pole: origin.add(&turned(first)), second: second.sub(&turned(first)), third: third.add(first) }
    }

    /// Returns the inflection pole: with the pole it spans the diameter of the inflection circle, whose points have no curvature.
    #[must_use]
    pub fn inflection_pole(&self) -> Complex<R> {
        self.pole.add(&self.second)
    }

    /// Returns the points of the body for which the first, second or third derivative of the position by the angle vanishes: the
    /// pole, the inflection pole, and the third normal pole.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.3.1\]: `z' = i u`, `z'' = a_2 - u`, `z''' = a_3 - i u`.
    #[must_use]
    pub fn normal_poles(&self) -> [Complex<R>; 3] {
        let third = Complex { re: self.third.im.clone(), im: self.third.re.neg() };
        [self.pole.clone(), self.inflection_pole(), self.pole.add(&third)]
    }

    /// Returns `|u|^2 - Re(conj(u) a_2)`, which is zero on the inflection circle.
    #[must_use]
    pub fn inflection(&self, point: &Complex<R>) -> R {
        let u = point.sub(&self.pole);
        scalar(&u, &u).sub(&scalar(&u, &self.second))
    }

    /// Returns the form that vanishes on the cubic of stationary curvature:
    /// `Re(conj(u) a_3) |u|^2 + 3 (|u|^2 - Re(conj(u) a_2)) Im(conj(u) a_2)`.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.3.5\]
    #[must_use]
    pub fn stationary(&self, point: &Complex<R>) -> R {
        let u = point.sub(&self.pole);
        let square = scalar(&u, &u);
        let twisted = self.inflection(point).mul(&area(&u, &self.second));
        scalar(&u, &self.third).mul(&square).add(&R::from_integer(3).mul(&twisted))
    }

    /// Returns the same instant in the frame of the body: the motion of the fixed frame relative to it.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.2.4\]: `a_2` changes its sign, `a_3` becomes `a_3 - 3 i a_2`, in axes of the frame.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let three = scaled(&turned(&self.second), &R::from_integer(3));
        Self { pole: self.pole.clone(), second: self.second.neg(), third: self.third.sub(&three) }
    }

    /// Returns velocity and acceleration of the point at a position, for the angular velocity and acceleration of the body.
    #[must_use]
    pub fn motion_at(&self, point: &Complex<R>, omega: &R, alpha: &R) -> [Complex<R>; 2] {
        let u = point.sub(&self.pole);
        let side = turned(&u);
        let square = omega.mul(omega);
        [scaled(&side, omega), scaled(&self.second.sub(&u), &square).add(&scaled(&side, alpha))]
    }
}

impl<R: Unit> Instant<R> {
    /// Returns the centre of curvature of the path of a point; `None` on the inflection circle and at the pole.
    ///
    /// # Source
    /// The formula of Euler and Savary, \[Wittenburg2016, 15.3.3\].
    #[must_use]
    pub fn centre(&self, point: &Complex<R>) -> Option<Complex<R>> {
        let u = point.sub(&self.pole);
        let (square, inflection) = (scalar(&u, &u), self.inflection(point));
        // Smallness is relative to the square of the distance: the formula is homogeneous.
        let share = inflection.over(&square)?;
        if share.is_small() {
            return None;
        }
        let factor = R::one().sub(&share.reciprocal()?);
        Some(self.pole.add(&scaled(&u, &factor)))
    }

    /// Returns Ball's point, in which the inflection circle meets the cubic of stationary curvature outside of the pole; `None` if
    /// the whole circle belongs to the cubic.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.3.6\]: `u = i a_3 Re(conj(i a_3) a_2)/|a_3|^2`.
    #[must_use]
    pub fn ball_point(&self) -> Option<Complex<R>> {
        let along = turned(&self.third);
        let share = scalar(&along, &self.second).over(&scalar(&along, &along))?;
        Some(self.pole.add(&scaled(&along, &share)))
    }

    /// Returns the point opposite to the pole on the circle of the points without tangential acceleration; `None` if the angular
    /// acceleration is 0 and the circle a line.
    ///
    /// # Source
    /// The second circle of Bresse, \[Wittenburg2016, 15.2.3\]: `u = i omega^2 a_2/alpha`.
    #[must_use]
    pub fn tangential_pole(&self, omega: &R, alpha: &R) -> Option<Complex<R>> {
        let factor = omega.mul(omega).over(alpha)?;
        Some(self.pole.add(&scaled(&turned(&self.second), &factor)))
    }

    /// Returns the point of the body without acceleration, for its angular velocity and acceleration; `None` at rest.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.2.2\]: `u = omega^2 a_2/(omega^2 - i alpha)`.
    #[must_use]
    pub fn acceleration_pole(&self, omega: &R, alpha: &R) -> Option<Complex<R>> {
        let square = omega.mul(omega);
        let inverse = square.mul(&square).add(&alpha.mul(alpha)).reciprocal()?;
        let factor = Complex { re: square.mul(&square).mul(&inverse), im: square.mul(alpha).mul(&inverse) };
        Some(self.pole.add(&factor.mul(&self.second)))
    }
}

impl<R: Root> Instant<R> {
    /// Returns the diameter of the inflection circle.
    #[must_use]
    pub fn inflection_diameter(&self) -> Option<R> {
        scalar(&self.second, &self.second).sqrt()
    }

    /// Returns the lengths m, n of the cubic of stationary curvature `1/r = 1/(m sin b) + 1/(n cos b)`, in polar coordinates r, b
    /// about the pole, with b from the pole tangent and the normal pointing to the inflection pole. `None` if one of them is infinite,
    /// so that the cubic is reducible.
    ///
    /// # Source
    /// \[Wittenburg2016, 15.3.5\]: with the diameter d of the inflection circle and the parts of a_3 along tangent and normal,
    /// `m = 3 d^2/(a_t + 3 d)` and `n = 3 d^2/a_n`.
    #[must_use]
    pub fn cubic(&self) -> Option<[R; 2]> {
        let diameter = self.inflection_diameter()?;
        let inverse = diameter.reciprocal()?;
        let normal = scaled(&self.second, &inverse);
        // The normal is the tangent rotated by a right angle: t = -i n.
        let tangent = Complex { re: normal.im.clone(), im: normal.re.neg() };
        let three = R::from_integer(3);
        let square = three.mul(&diameter).mul(&diameter);
        let along = scalar(&tangent, &self.third).add(&three.mul(&diameter));
        Some([square.over(&along)?, square.over(&scalar(&normal, &self.third))?])
    }

    /// Returns the curvatures of the fixed and of the moving centrode at the pole, positive to the left of the pole's path; `None`
    /// if the pole is at rest.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::instant::plane::Instant;
    /// use num_complex::Complex;
    /// let z = |re: f64, im: f64| Complex { re, im };
    /// let wheel = Instant::of(&[z(0.0, 1.0), z(-1.0, 0.0), z(0.0, 0.0), z(0.0, 0.0)]);
    /// let [line, circle] = wheel.centrode_curvatures().unwrap();
    /// assert_eq!((line.abs(), circle.abs()), (0.0, 1.0));
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 15.3.4\]: the pole moves by `i a_2`, then by `a_2 + i a_3`.
    #[must_use]
    pub fn centrode_curvatures(&self) -> Option<[R; 2]> {
        let first = turned(&self.second);
        let second = self.second.add(&turned(&self.third));
        let moving = second.sub(&turned(&first));
        Some([curvature(&first, &second)?, curvature(&first, &moving)?])
    }
}

/// Returns the curvature of a plane curve from its first two derivatives: `Im(conj(z') z'')/|z'|^3`, positive for a left bend.
///
/// # Example
/// ```
/// use looproot_calculus::instant::plane::curvature;
/// use num_complex::Complex;
/// // A circle of radius 2 in unit rate of its angle.
/// let at = |re: f64, im: f64| Complex { re, im };
/// assert_eq!(curvature(&at(0.0, 2.0), &at(-2.0, 0.0)), Some(0.5));
/// ```
///
/// # Source
/// \[Wittenburg2016, 14.1.1\]
#[must_use]
pub fn curvature<R: Root>(first: &Complex<R>, second: &Complex<R>) -> Option<R> {
    let square = scalar(first, first);
    area(first, second).over(&square.mul(&square.sqrt()?))
}
