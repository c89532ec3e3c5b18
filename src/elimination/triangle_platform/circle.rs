//! Legs that meet in pairs, and the circles on which the points where they meet can move.

use crate::algebra::ring::{Field, Ring};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;

/// The pairs of legs that meet in a point of one body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pairs {
    /// Whether they meet at the base, not at the plate.
    pub at_base: bool,
    /// The legs, two for every corner of the triangle.
    pub legs: [[usize; 2]; 3],
}

/// Returns the pairs in which six legs meet at the plate, or else at the base; `None` where they do not, or where both ends of a
/// pair coincide.
#[must_use]
pub fn pairs<R: PartialEq>(platform: &Platform<R>) -> Option<Pairs> {
    let grouped = |meet: &[Vector<R>; 6], foot: &[Vector<R>; 6]| {
        let mut legs = [[0; 2]; 3];
        let mut count = 0;
        for i in 0..6 {
            let mut same = (0..6).filter(|&j| j != i && meet[j] == meet[i]);
            let (Some(j), None) = (same.next(), same.next()) else { return None };
            if foot[i] == foot[j] {
                return None;
            }
            if i < j {
                legs[count] = [i, j];
                count += 1;
            }
        }
        Some(legs)
    };
    if let Some(legs) = grouped(&platform.plate, &platform.base) {
        return Some(Pairs { at_base: false, legs });
    }
    grouped(&platform.base, &platform.plate).map(|legs| Pairs { at_base: true, legs })
}

/// The circle of a corner, in the frame of the body that carries its axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Circle<R> {
    /// Its centre c.
    pub centre: Vector<R>,
    /// u and v, at right angles to the axis and to each other.
    pub arms: [Vector<R>; 2],
    /// `u.u` and `v.v`.
    pub squares: [R; 2],
    /// The square of its radius, negative where the legs are too short for any real point.
    pub radius_square: R,
}

/// Squared sine of the angle between two directions above which their cross product may serve as a direction.
const ACROSS: f64 = 1e-4;

impl<F: Field> Circle<F> {
    /// The circle of points at given distances, squared, from two points. v is across the axis and the first of some
    /// directions that is not along the axis.
    fn new(feet: [&Vector<F>; 2], squares: [&F; 2], directions: &[Vector<F>]) -> Option<Self> {
        let axis: Vector<F> = std::array::from_fn(|k| feet[1][k].sub(&feet[0][k]));
        let length = dot(&axis, &axis);
        let half = length.add(&length).inverse()?;
        let along = squares[0].sub(squares[1]).add(&length).mul(&half);
        let centre = std::array::from_fn(|k| feet[0][k].add(&along.mul(&axis[k])));
        let radius_square = squares[0].sub(&along.mul(&along).mul(&length));
        let least = if F::PIVOT_ZERO > 0.0 { ACROSS } else { 0.0 };
        let v = directions.iter().find_map(|direction| {
            let v = cross(&axis, direction);
            let most = length.pivot_size() * dot(direction, direction).pivot_size();
            (dot(&v, &v).pivot_size() > least * most).then_some(v)
        })?;
        let u = cross(&axis, &v);
        let squares = [dot(&u, &u), dot(&v, &v)];
        Some(Self { centre, arms: [u, v], squares, radius_square })
    }

    /// The point at `alpha`, `beta`, over a larger ring.
    pub fn point<S: Ring>(&self, [alpha, beta]: [&S; 2], image: impl Fn(&F) -> S) -> Vector<S> {
        std::array::from_fn(|k| {
            let turned = alpha.mul(&image(&self.arms[0][k])).add(&beta.mul(&image(&self.arms[1][k])));
            turned.add(&image(&self.centre[k]))
        })
    }
}

/// A triangle whose corners lie on circles.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle<F> {
    /// The circles of its corners.
    pub circles: [Circle<F>; 3],
    /// The corners in the frame of the triangle.
    pub corners: [Vector<F>; 3],
}

impl<F: Field> Triangle<F> {
    /// The triangle of a platform whose legs meet in pairs, with legs of these squared lengths; `None` for a prime that
    /// divides a denominator.
    #[must_use]
    pub fn new(platform: &Platform<F>, squares: &[F; 6], pairs: &Pairs) -> Option<Self> {
        let (meet, feet) =
            if pairs.at_base { (&platform.base, &platform.plate) } else { (&platform.plate, &platform.base) };
        let axes = pairs.legs.map(|[i, j]| std::array::from_fn(|k| feet[j][k].sub(&feet[i][k])));
        let unit = |n: usize| std::array::from_fn(|k| if k == n { F::one() } else { F::zero() });
        let circle = |n: usize| {
            let [i, j] = pairs.legs[n];
            // Across another axis: the normal of the plane of all axes where there is one.
            let other = |shift: usize| -> Vector<F> { axes[(n + shift) % 3].clone() };
            let directions = [other(1), other(2), unit(0), unit(1), unit(2)];
            Circle::new([&feet[i], &feet[j]], [&squares[i], &squares[j]], &directions)
        };
        Some(Self { circles: [circle(0)?, circle(1)?, circle(2)?], corners: pairs.legs.map(|[i, _]| meet[i].clone()) })
    }

    /// The side between two corners as a bilinear form M in `h = (1, alpha, beta)` of both: `|P_i - P_j|^2 - l^2` less the
    /// equations of the circles is `h_i^T M h_j`.
    #[must_use]
    pub fn side(&self, i: usize, j: usize) -> [[F; 3]; 3] {
        let (one, two) = (&self.circles[i], &self.circles[j]);
        let difference = |a: &Vector<F>, b: &Vector<F>| -> Vector<F> { std::array::from_fn(|k| a[k].sub(&b[k])) };
        let (between, side) = (difference(&one.centre, &two.centre), difference(&self.corners[i], &self.corners[j]));
        let twice = |x: F| x.add(&x);
        let constant = dot(&between, &between).add(&one.radius_square).add(&two.radius_square).sub(&dot(&side, &side));
        std::array::from_fn(|a| {
            std::array::from_fn(|b| match (a, b) {
                (0, 0) => constant.clone(),
                (a, 0) => twice(dot(&between, &one.arms[a - 1])),
                (0, b) => twice(dot(&between, &two.arms[b - 1])).neg(),
                (a, b) => twice(dot(&one.arms[a - 1], &two.arms[b - 1])).neg(),
            })
        })
    }
}
