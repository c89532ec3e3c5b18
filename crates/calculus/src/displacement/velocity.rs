//! Velocity and acceleration of a body in space: velocity screw, poles, and the motion of three points.

use super::cylindroid::Pitched;
use crate::line::pluecker::Line;
use crate::line::ruled::{Generator, axode};
use crate::motion::{Motion, Vector, cross, dot};
use crate::unit::Unit;
use looproot_algebra::ring::Ring;
use looproot_algebra::series::Series;

/// The position of a point and its velocity.
pub type Moving<R> = (Vector<R>, Vector<R>);

/// Velocity and acceleration of a body at an instant, for the point of the body at the origin of space.
#[derive(Clone, Debug, PartialEq)]
pub struct State<R> {
    /// The angular velocity.
    pub omega: Vector<R>,
    /// The angular acceleration.
    pub alpha: Vector<R>,
    /// The velocity of the point of the body at the origin.
    pub velocity: Vector<R>,
    /// The acceleration of that point.
    pub acceleration: Vector<R>,
}

impl<R: Ring> State<R> {
    /// Returns the state of a motion over series in time.
    #[must_use]
    pub fn of(motion: &Motion<Series<R, 3>>) -> Self {
        let part = |k: usize| motion.map(|s| Some(s.coefficients[k].clone()));
        let (Some(at), Some(rate), Some(half)) = (part(0), part(1), part(2)) else {
            // A series always has these parts.
            return Self { omega: zero(), alpha: zero(), velocity: zero(), acceleration: zero() };
        };
        let twice = |r: &R| r.add(r);
        let transposed: [[R; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| at.rotation[j][i].clone()));
        let by = |m: &[[R; 3]; 3]| crate::rotation::matrix::product(m, &transposed);
        let skew = by(&rate.rotation);
        let omega = [skew[2][1].clone(), skew[0][2].clone(), skew[1][0].clone()];
        // A'' A^T = skew(alpha) + skew(omega)^2: the symmetric part drops out of half the difference.
        let second = by(&half.rotation.each_ref().map(|row| row.each_ref().map(twice)));
        let square = crate::rotation::matrix::product(&skew, &skew);
        let alpha = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| second[i][j].sub(&square[i][j]));
        // The point of the body that is at the origin is at -t relative to the body's own origin.
        let back: Vector<R> = at.translation.each_ref().map(R::neg);
        let accelerated = add(&cross(&alpha, &back), &cross(&omega, &cross(&omega, &back)));
        Self {
            velocity: add(&rate.translation, &cross(&omega, &back)),
            acceleration: add(&half.translation.each_ref().map(twice), &accelerated),
            omega,
            alpha,
        }
    }

    /// Returns the series in time of a body that is at a place and moves with this velocity and acceleration; `None` where 2
    /// has no inverse.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::displacement::velocity::State;
    /// use looproot_calculus::motion::Motion;
    /// let state = State {
    ///     omega: [0.0, 1.0, 2.0], alpha: [3.0, 0.0, 1.0], velocity: [1.0, 1.0, 0.0], acceleration: [0.0, 2.0, 5.0],
    /// };
    /// let motion = state.motion(&Motion::translation([1.0, 2.0, 3.0])).unwrap();
    /// assert_eq!(State::of(&motion), state);
    /// ```
    #[must_use]
    pub fn motion(&self, at: &Motion<R>) -> Option<Motion<Series<R, 3>>> {
        let half = R::from_rational(&rug::Rational::from((1, 2)))?;
        let turned = |v: &Vector<R>| {
            let first = cross(&self.omega, v);
            let second = add(&cross(&self.alpha, v), &cross(&self.omega, &first));
            [v.clone(), first, second.map(|c| c.mul(&half))]
        };
        let columns: [[Vector<R>; 3]; 3] =
            std::array::from_fn(|j| turned(&std::array::from_fn(|i| at.rotation[i][j].clone())));
        let [place, first, second] = turned(&at.translation);
        let first = add(&first, &self.velocity);
        let second = add(&second, &self.acceleration.each_ref().map(|c| c.mul(&half)));
        let entry = |parts: [&Vector<R>; 3], i: usize| Series { coefficients: parts.map(|part| part[i].clone()) };
        Some(Motion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| entry(columns[j].each_ref(), i))),
            translation: std::array::from_fn(|i| entry([&place, &first, &second], i)),
        })
    }

    /// Returns the velocity of the point of the body at a position.
    #[must_use]
    pub fn velocity_at(&self, point: &Vector<R>) -> Vector<R> {
        add(&self.velocity, &cross(&self.omega, point))
    }

    /// Returns the acceleration of the point of the body at a position.
    #[must_use]
    pub fn acceleration_at(&self, point: &Vector<R>) -> Vector<R> {
        let turning = add(&cross(&self.alpha, point), &cross(&self.omega, &cross(&self.omega, point)));
        add(&self.acceleration, &turning)
    }
}

impl<R: Unit> State<R> {
    /// Returns the velocity screw: axis and pitch; `None` for a translation.
    ///
    /// # Source
    /// \[Wittenburg2016, 9.3\]
    #[must_use]
    pub fn screw(&self) -> Option<Pitched<R>> {
        Pitched::of_twist(&Line { direction: self.omega.clone(), moment: self.velocity.clone() })
    }

    /// Returns striction point and distribution parameter of both raccording axodes along the axis of the velocity screw; `None` if
    /// the axis keeps its direction.
    ///
    /// # Source
    /// \[Wittenburg2016, 9.5\]
    #[must_use]
    pub fn axodes(&self) -> Option<Generator<R>> {
        // The velocity at a place fixed in space changes by the acceleration of the point there, and by the point that replaces it.
        let passing = cross(&self.omega, &self.velocity);
        let moment = std::array::from_fn(|i| self.acceleration[i].sub(&passing[i]));
        let twist = Line { direction: self.omega.clone(), moment: self.velocity.clone() };
        axode(&twist, &Line { direction: self.alpha.clone(), moment })
    }

    /// Returns the point without acceleration; `None` if angular velocity and acceleration are parallel.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::displacement::velocity::State;
    /// let state = State {
    ///     omega: [0.0, 0.0, 1.0], alpha: [1.0, 0.0, 0.0], velocity: [0.0; 3], acceleration: [2.0, 0.0, 1.0],
    /// };
    /// let pole = state.acceleration_pole().unwrap();
    /// assert!(state.acceleration_at(&pole).iter().all(|a| a.abs() < 1e-15));
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 9.8\]: a linear system with determinant `-|omega x alpha|^2`.
    #[must_use]
    pub fn acceleration_pole(&self) -> Option<Vector<R>> {
        let unit = |k: usize| std::array::from_fn(|i| if i == k { R::one() } else { R::zero() });
        let column = |k: usize| {
            let e: Vector<R> = unit(k);
            add(&cross(&self.alpha, &e), &cross(&self.omega, &cross(&self.omega, &e)))
        };
        solve(&[column(0), column(1), column(2)], &self.acceleration.each_ref().map(R::neg))
    }
}

/// Returns the angular velocity of a body from the velocities of three of its points, and the velocity of the point at the
/// origin; `None` for points in a line.
///
/// # Example
/// ```
/// use looproot_calculus::displacement::velocity::from_points;
/// use rug::Rational;
/// let v = |v: [i32; 3]| v.map(Rational::from);
/// // Turning about z at rate 2 and rising.
/// let points = [(v([1, 0, 0]), v([0, 2, 1])), (v([0, 1, 0]), v([-2, 0, 1])), (v([0, 0, 4]), v([0, 0, 1]))];
/// assert_eq!(from_points(&points).unwrap(), (v([0, 0, 2]), v([0, 0, 1])));
/// ```
///
/// # Source
/// \[Wittenburg2016, 9.4\]
#[must_use]
pub fn from_points<R: Unit>(points: &[Moving<R>; 3]) -> Option<(Vector<R>, Vector<R>)> {
    let difference = |k: usize, of: fn(&Moving<R>) -> &Vector<R>| -> Vector<R> {
        std::array::from_fn(|i| of(&points[k])[i].sub(&of(&points[0])[i]))
    };
    let (p, q) = (difference(1, |m| &m.0), difference(2, |m| &m.0));
    let (v, w) = (difference(1, |m| &m.1), difference(2, |m| &m.1));
    let normal = cross(&p, &q);
    let inverse = dot(&normal, &normal).reciprocal()?;
    let along = |a: &R, u: &Vector<R>| u.each_ref().map(|c| c.mul(a).mul(&inverse));
    // v . (p x q) = -y, w . (p x q) = x, v . q = z, each times the square of p x q, for omega = x p + y q + z p x q.
    let (x, y, z) = (dot(&w, &normal), dot(&v, &normal).neg(), dot(&v, &q));
    let omega = add(&add(&along(&x, &p), &along(&y, &q)), &along(&z, &normal));
    let turned = cross(&omega, &points[0].0);
    let velocity = std::array::from_fn(|i| points[0].1[i].sub(&turned[i]));
    Some((omega, velocity))
}

fn zero<R: Ring>() -> Vector<R> {
    std::array::from_fn(|_| R::zero())
}

fn add<R: Ring>(x: &Vector<R>, y: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|i| x[i].add(&y[i]))
}

/// Returns the solution of three linear equations with these columns.
fn solve<R: Unit>([a, b, c]: &[Vector<R>; 3], right: &Vector<R>) -> Option<Vector<R>> {
    let determinant = dot(a, &cross(b, c));
    if determinant.is_small() {
        return None;
    }
    let inverse = determinant.reciprocal()?;
    let triple = |u: &Vector<R>, v: &Vector<R>| dot(right, &cross(u, v)).mul(&inverse);
    Some([triple(b, c), triple(c, a), triple(a, b)])
}
