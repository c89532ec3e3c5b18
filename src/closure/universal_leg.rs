//! Legs with a universal joint at each end, in Study's parameters.
//!
//! One axis n of the joints is fixed in the base, one axis m in the plate; the two axes between them are parallel, and perpendicular to
//! the leg and to n and m. So n, the rotated m and the vector d of the leg are dependent. With `d = w x~ / N`, a vector where
//! Study's condition holds, the cross product of `x m x~` and `w x~` is `-N` times the vector part of `x m w~`, and
//!
//! `n . (x m x~ X w x~) = N w . (n x m)`:
//!
//! the condition is a quadratic form as that of the length is.

use super::study::{Form, Four, Leg, left, right, scalar};
use crate::algebra::ring::Ring;
use crate::kinematics::motion::Vector;

/// A leg; the constants may be of a smaller ring than the unknowns, and `times` multiplies an unknown by a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct UniversalLeg<C> {
    /// The points at its ends and its squared length.
    pub leg: Leg<C>,
    /// The matrices of the products with the axis in the base on the left, and with that in the plate on the right.
    pub axes: [Form<C>; 2],
}

/// A vector with its 8 derivatives.
type Eight<R> = [R; 8];

/// Returns a matrix times a vector.
fn apply<R: Ring, C>(form: &Form<C>, v: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> Four<R> {
    std::array::from_fn(|i| (0..4).fold(R::zero(), |sum, j| sum.add(&times(&v[j], &form[i][j]))))
}

impl<C: Ring> UniversalLeg<C> {
    /// Returns the leg between a point of the base and one of the plate, with the axis in each.
    #[must_use]
    pub fn new([base, plate]: [&Vector<C>; 2], square: C, [n, m]: [&Vector<C>; 2]) -> Self {
        Self { leg: Leg::new(base, plate, square), axes: [left(n), right(m)] }
    }

    /// Returns `n v m`.
    pub fn between<R: Ring>(&self, v: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> Four<R> {
        apply(&self.axes[0], &apply(&self.axes[1], v, times), times)
    }

    /// Returns the forms of the length, `w.w - L^2 N`, and of the axes, `w.(n x m)`.
    pub fn values<R: Ring>(&self, x: &Four<R>, y: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> [R; 2] {
        let w = self.leg.vector(x, y, times);
        [self.leg.quadric(x, y, times), scalar(&w, &self.between(x, times))]
    }

    /// Returns the derivatives of both forms by x and y.
    pub fn slopes<R: Ring>(&self, x: &Four<R>, y: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> [Eight<R>; 2] {
        let w = self.leg.vector(x, y, times);
        let twice = |v: Four<R>| v.map(|z| z.add(&z));
        // n x m is symmetric in x as a matrix, and M is skew.
        let (of_w, of_x) = (self.between(&w, times), self.between(x, times));
        let back = apply(&self.leg.matrix, &of_x, times);
        let by_x = std::array::from_fn(|k| of_w[k].sub(&back[k]));
        [joined(&twice(self.leg.half_slope(&w, x, times)), &twice(w)), joined(&by_x, &of_x)]
    }
}

/// Returns x and y as one vector.
#[must_use]
pub fn joined<R: Clone>(x: &Four<R>, y: &Four<R>) -> Eight<R> {
    std::array::from_fn(|k| if k < 4 { x[k].clone() } else { y[k - 4].clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::dual::Dual;
    use crate::kinematics::motion::{cross, dot};
    use looproot_calculus::quaternion::Quaternion;
    use rug::Rational;

    fn vector(v: [i32; 3]) -> Vector<Rational> {
        v.map(Rational::from)
    }

    fn leg() -> UniversalLeg<Rational> {
        let [a, b, n, m] = [[1, 4, 0], [-1, -3, 3], [-3, 3, 1], [2, -5, 7]].map(vector);
        UniversalLeg::new([&a, &b], Rational::from(11), [&n, &m])
    }

    /// A pose by its quaternion and its place, which satisfies Study's condition.
    fn pose() -> (Quaternion<Rational>, Vector<Rational>) {
        (Quaternion { scalar: Rational::from(2), vector: vector([-1, 3, 5]) }, vector([4, -7, 6]))
    }

    #[test]
    fn the_form_of_the_axes_is_their_determinant_over_the_norm() {
        let (q, p) = pose();
        let y = Quaternion { scalar: Rational::new(), vector: p.clone() }.mul(&q);
        let four = |q: &Quaternion<Rational>| [&q.scalar, &q.vector[0], &q.vector[1], &q.vector[2]].map(Clone::clone);
        let times = |z: &Rational, c: &Rational| Rational::from(z * c);
        let [length, axes] = leg().values(&four(&q), &four(&y), times);
        let rotated =
            |v: [i32; 3]| q.mul(&Quaternion { scalar: Rational::new(), vector: vector(v) }).mul(&q.conjugate()).vector;
        let norm = q.norm();
        // N times the vector of the leg, p + R b - a.
        let (b, a) = (rotated([-1, -3, 3]), vector([1, 4, 0]));
        let d: Vector<Rational> = std::array::from_fn(|k| Rational::from(&p[k] - &a[k]) * &norm + &b[k]);
        assert_eq!(dot(&d, &d), (&length + 11 * norm.clone()) * &norm);
        assert_eq!(dot(&vector([-3, 3, 1]), &cross(&rotated([2, -5, 7]), &d)), axes * norm);
    }

    #[test]
    fn slopes_are_the_derivatives() {
        let point: [Rational; 8] = [3, -1, 4, 1, -5, 9, 2, -6].map(Rational::from);
        let [x, y] = [0, 4].map(|from| std::array::from_fn(|k| point[from + k].clone()));
        let slopes = leg().slopes(&x, &y, |z, c| Rational::from(z * c));
        for k in 0..8 {
            let at = |i: usize| Dual { value: point[i].clone(), epsilon: Rational::from(u8::from(i == k)) };
            let [x, y] = [0, 4].map(|from| std::array::from_fn(|i| at(from + i)));
            let values = leg().values(&x, &y, |z, c| Dual {
                value: Rational::from(&z.value * c),
                epsilon: Rational::from(&z.epsilon * c),
            });
            assert_eq!(values.map(|value| value.epsilon), [slopes[0][k].clone(), slopes[1][k].clone()], "{k}");
        }
    }
}
