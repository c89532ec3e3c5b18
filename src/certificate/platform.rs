//! The closure equations of a platform: six legs, and a quaternion of norm 1, in the seven unknowns x and p.

use super::enclosing::Enclosing;
use super::fault::{Fault, refused};
use super::isolation::{Closure, Point};
use super::mode::Ball;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use crate::catalogue::entry::Case;
use crate::kinematics::motion::dot;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// The points and the legs.
pub struct PlatformClosure {
    pub(super) base: [[Enclosure; 3]; 6],
    pub(super) plate: [[Enclosure; 3]; 6],
    pub(super) squares: [Enclosure; 6],
    /// Points of base and moving platform, if all are rational.
    pub(super) exact: Option<[[[Rational; 3]; 6]; 2]>,
}

impl PlatformClosure {
    /// Returns the equations of a case.
    pub(super) fn of(platform: &Platform<Number>, case: &Case) -> Result<Self, Fault> {
        let Some(squares) = &case.legs_squared else { return refused("closure: no legs") };
        let known = |x: &Number| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero);
        let points = |points: &[[Number; 3]; 6]| points.each_ref().map(|point| point.each_ref().map(known));
        let exact = |points: &[[Number; 3]; 6]| points.each_ref().map(|p| p.each_ref().map(|x| x.rational().clone()));
        let is_exact = [&platform.base, &platform.plate].into_iter().flatten().flatten().all(Number::is_exact);
        Ok(Self {
            base: points(&platform.base),
            plate: points(&platform.plate),
            squares: squares.each_ref().map(known),
            exact: is_exact.then(|| [exact(&platform.base), exact(&platform.plate)]),
        })
    }
}

/// Returns twice a number.
fn twice<S: Ring>(x: &S) -> S {
    x.add(x)
}

/// Returns the rotation matrix of a quaternion of norm 1.
fn rotation<S: Ring>([w, i, j, k]: [&S; 4]) -> [[S; 3]; 3] {
    let (ww, ii, jj, kk) = (w.mul(w), i.mul(i), j.mul(j), k.mul(k));
    let both = |a: &S, b: &S, c: S| twice(&a.mul(b).add(&c));
    let (wi, wj, wk) = (w.mul(i), w.mul(j), w.mul(k));
    [
        [ww.add(&ii).sub(&jj).sub(&kk), both(i, j, wk.neg()), both(i, k, wj.clone())],
        [both(i, j, wk), ww.sub(&ii).add(&jj).sub(&kk), both(j, k, wi.neg())],
        [both(i, k, wj.neg()), both(j, k, wi), ww.sub(&ii).sub(&jj).add(&kk)],
    ]
}

/// Returns half the derivatives of the rotation matrix.
fn slopes<S: Ring>([w, i, j, k]: [&S; 4]) -> [[[S; 3]; 3]; 4] {
    let (p, m) = (|x: &S| x.clone(), |x: &S| x.neg());
    [
        [[p(w), m(k), p(j)], [p(k), p(w), m(i)], [m(j), p(i), p(w)]],
        [[p(i), p(j), p(k)], [p(j), m(i), m(w)], [p(k), p(w), m(i)]],
        [[m(j), p(i), p(w)], [p(i), p(j), p(k)], [m(w), p(k), m(j)]],
        [[m(k), m(w), p(i)], [p(w), m(k), p(j)], [p(i), p(j), p(k)]],
    ]
}

fn turned<S: Ring>(matrix: &[[S; 3]; 3], v: &[S; 3]) -> [S; 3] {
    std::array::from_fn(|i| dot(&matrix[i], v))
}

/// Returns the quaternion and the position.
fn parts<S: Ring>(point: &Point<S>) -> ([&S; 4], [S; 3]) {
    (std::array::from_fn(|k| &point.x[k]), std::array::from_fn(|k| point.x[4 + k].clone()))
}

/// Points of base and moving platform, and the squares of the legs.
pub(super) struct Constants<S> {
    base: [[S; 3]; 6],
    plate: [[S; 3]; 6],
    squares: [S; 6],
}

impl Closure<7> for PlatformClosure {
    type Constants<S: Enclosing> = Constants<S>;

    fn constants<S: Enclosing>(&self) -> Constants<S> {
        let points = |points: &[[Enclosure; 3]; 6]| points.each_ref().map(|point| point.each_ref().map(S::of));
        let (base, plate) = (points(&self.base), points(&self.plate));
        Constants { base, plate, squares: self.squares.each_ref().map(S::of) }
    }

    fn angles(&self) -> [bool; 7] {
        [false; 7]
    }

    /// With |x| = 1: `p.p + b.b + a.a + 2 (p - a).R b - 2 a.p - l^2`.
    fn values<S: Enclosing>(&self, constants: &Constants<S>, point: &Point<S>) -> [S; 7] {
        let Constants { base, plate, squares } = constants;
        let (x, p) = parts(point);
        let matrix = rotation(x);
        std::array::from_fn(|row| {
            let Some(leg) = row.checked_sub(1) else {
                return x.iter().fold(S::one().neg(), |sum, q| sum.add(&q.mul(q)));
            };
            let (a, b) = (&base[leg], &plate[leg]);
            let gap: [S; 3] = std::array::from_fn(|k| p[k].sub(&a[k]));
            let mixed = dot(&gap, &turned(&matrix, b)).sub(&dot(a, &p));
            dot(&p, &p).add(&dot(b, b)).add(&dot(a, a)).add(&twice(&mixed)).sub(&squares[leg])
        })
    }

    /// Every zero of the seven equations is a pose.
    fn slope<S: Enclosing>(&self, constants: &Constants<S>, point: &Point<S>) -> ([[S; 7]; 7], bool) {
        let Constants { base, plate, .. } = constants;
        let (x, p) = parts(point);
        let (matrix, slopes) = (rotation(x), slopes(x));
        let slope = std::array::from_fn(|row| {
            let Some(leg) = row.checked_sub(1) else {
                return std::array::from_fn(|k| x.get(k).map_or_else(S::zero, |q| twice(*q)));
            };
            let (a, b) = (&base[leg], &plate[leg]);
            let gap: [S; 3] = std::array::from_fn(|k| p[k].sub(&a[k]));
            let moved = turned(&matrix, b);
            std::array::from_fn(|k| match k.checked_sub(4) {
                None => twice(&twice(&dot(&gap, &turned(&slopes[k], b)))),
                Some(k) => twice(&gap[k].add(&moved[k])),
            })
        });
        (slope, true)
    }

    /// Compares up to sign: a quaternion and its negative are one pose.
    fn are_apart(&self, one: &Ball, other: &Ball) -> bool {
        let radius = Rational::from(&one.radius + &other.radius);
        let far = |a: &Rational, b: &Rational, sign: i32| (a - Rational::from(b * sign)).abs() > radius;
        [1, -1].into_iter().all(|sign| {
            let differ = |k: usize| {
                let (((x, y), (u, v)), sign) = ((&one.centre[k], &other.centre[k]), if k < 4 { sign } else { 1 });
                far(x, u, sign) || far(y, v, sign)
            };
            (0..7).any(differ)
        })
    }
}
