//! All poses of a platform whose legs meet in pairs, by the two resultants of its triangle.

use super::search::Search;
use crate::algebra::dual::Dual;
use crate::algebra::ring::Ring;
use crate::elimination::border::DIMENSION;
use crate::elimination::triangle_platform::{Eliminant, Pairs, Triangle, pairs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use crate::solve::pose::Eight;
use crate::solve::simultaneous::roots;
use num_complex::Complex;

type Point = [Complex<f64>; 3];

/// Number of poses of a triangle on six legs, in general.
pub const POSES: usize = 16;
/// Points of a circle nearer to infinity than this belong to no pose.
const INFINITE: f64 = 1e-10;
/// Corners whose distance is off by this much match as well as the nearest ones.
const TOGETHER: f64 = 1e-6;
/// Points at which a form must differ from zero, relative to its terms, to have 16 roots; otherwise the triangle moves.
const SAMPLES: [f64; 3] = [0.4, 2.1, 4.9];
const VANISHING: f64 = 1e-10;
/// A Moebius map of the complex numbers after which no solution of a real mechanism is at infinity.
const TURN: [Complex<f64>; 2] = [Complex::new(0.61, 0.27), Complex::new(-0.33, 0.67)];

/// Returns the circle in homogeneous coordinates of its points, `(2 x y, r (y^2 + x^2), -i r (y^2 - x^2))`, with x and y
/// linear in one complex number s.
fn on_circle<S: Ring>(s: &S, radius: Complex<f64>, constant: impl Fn(Complex<f64>) -> S) -> [S; 3] {
    let [p, q] = TURN;
    let x = constant(p).add(&constant(q).mul(s));
    let y = constant(-q.conj()).add(&constant(p.conj()).mul(s));
    let (xx, yy, xy) = (x.mul(&x), y.mul(&y), x.mul(&y));
    let i_radius = Complex::new(radius.im, -radius.re);
    [xy.add(&xy), constant(radius).mul(&yy.add(&xx)), constant(i_radius).mul(&yy.sub(&xx))]
}

/// Returns the two points in which a line meets a circle of this squared radius.
fn meet([d, e, f]: &Point, radius_square: f64) -> [Point; 2] {
    let norm = e * e + f * f;
    let root = (norm * radius_square - d * d).sqrt();
    [root, -root].map(|root| [norm, -d * e + f * root, -d * f - e * root])
}

/// Returns the error of the distance of two corners, relative to its terms.
fn miss(side: &[Point; 3], one: &Point, two: &Point) -> f64 {
    let size = |v: &Point| v.iter().map(|z| z.norm()).sum::<f64>();
    let image: Point = std::array::from_fn(|k| dot(&side[k], two));
    let most = side.iter().map(size).sum::<f64>() * size(one) * size(two);
    dot(one, &image).norm() / most.max(f64::MIN_POSITIVE)
}

/// The triangle of a platform, in numbers.
#[derive(Clone, Copy, Debug)]
pub struct TriangleRoute {
    pairs: Pairs,
}

impl TriangleRoute {
    /// Returns the route, if legs of the platform meet in pairs.
    pub fn of(platform: &Platform<f64>) -> Option<Self> {
        pairs(platform).map(|pairs| Self { pairs })
    }

    /// Returns whether the legs meet at the base.
    pub fn at_base(&self) -> bool {
        self.pairs.at_base
    }

    /// Passes all poses with legs of these squared lengths to a search. Returns whether there was no obstacle.
    pub fn solve(&self, platform: &Platform<f64>, squares: &[f64; 6], search: &mut Search) -> bool {
        let Some(mut triangle) = Triangle::new(platform, squares, &self.pairs) else { return false };
        for circle in &mut triangle.circles {
            for (arm, square) in circle.arms.iter_mut().zip(&mut circle.squares) {
                *arm = arm.map(|x| x / square.sqrt());
                *square = 1.0;
            }
        }
        // A circle of radius zero is a pair of lines and has no parameter, so the largest circle is used.
        let radius = |k: usize| triangle.circles[k].radius_square.abs();
        let first = (1..3).fold(0, |best, k| if radius(k) > radius(best) { k } else { best });
        if !(radius(first) > 0.0 && radius(first).is_finite()) {
            return false;
        }
        let Some(frame) = Corners::new(&triangle.corners) else { return false };
        let radius = Complex::from(triangle.circles[first].radius_square).sqrt();
        let eliminant = Eliminant::new(&triangle, first).map(|x| Complex::from(*x));
        let vanishes = SAMPLES.iter().all(|angle| {
            let s = Complex::from_polar(1.0, *angle);
            let [one, other] = eliminant.terms(&on_circle(&s, radius, |z| z));
            !((one - other).norm() > VANISHING * (one.norm() + other.norm()))
        });
        if vanishes {
            return false;
        }
        search.begin(DIMENSION - POSES);
        let dual = eliminant.map(|z| Dual::constant(*z));
        let found: [Complex<f64>; POSES] = roots(|s| {
            let value = dual.value(&on_circle(&Dual::variable(s), radius, Dual::constant));
            (value.value, value.epsilon)
        });
        for (index, s) in found.iter().enumerate() {
            let h = on_circle(s, radius, |z| z);
            let [a, d] = eliminant.lines_at(&h);
            let circle = |k: usize| triangle.circles[(first + k) % 3].radius_square;
            let (second, third) = (meet(&a, circle(1)), meet(&d, circle(2)));
            let misses: [f64; 4] = std::array::from_fn(|k| miss(&eliminant.opposite, &second[k / 2], &third[k % 2]));
            let least = misses.iter().copied().fold(f64::INFINITY, f64::min);
            for k in (0..4).filter(|&k| misses[k] <= least.max(TOGETHER)) {
                let mut points = [h; 3];
                points[first] = h;
                points[(first + 1) % 3] = second[k / 2];
                points[(first + 2) % 3] = third[k % 2];
                if let Some(start) = self.pose(&triangle, &frame, &points) {
                    search.arrive(&start, index);
                }
            }
        }
        search.end();
        true
    }

    /// Study's parameters of the pose that puts the corners at these points of their circles.
    fn pose(&self, triangle: &Triangle<f64>, frame: &Corners, points: &[Point; 3]) -> Option<Eight<Complex<f64>>> {
        let mut corners = [[Complex::from(0.0); 3]; 3];
        for ((corner, circle), [one, alpha, beta]) in corners.iter_mut().zip(&triangle.circles).zip(points) {
            let size = one.norm() + alpha.norm() + beta.norm();
            if !(one.norm() > INFINITE * size) {
                return None;
            }
            *corner = circle.point([&(alpha / one), &(beta / one)], |x| Complex::from(*x));
        }
        let [x, y] = frame.study(&corners)?;
        // If the legs meet at the base, this is the pose of the base in the frame of the moving platform.
        let (x, y) = if self.pairs.at_base { (x.conjugate(), y.conjugate()) } else { (x, y) };
        let [x1, x2, x3] = x.vector;
        let [y1, y2, y3] = y.vector;
        Some([x.scalar, x1, x2, x3, y.scalar, y1, y2, y3])
    }
}

/// Three points of a body, and the vectors dual to their differences.
struct Corners {
    origin: Vector<f64>,
    dual: [Vector<f64>; 3],
}

impl Corners {
    /// Returns the points of a triangle; `None` for three of a line.
    fn new([a, b, c]: &[Vector<f64>; 3]) -> Option<Self> {
        let difference = |p: &Vector<f64>| -> Vector<f64> { std::array::from_fn(|k| p[k] - a[k]) };
        let (b, c) = (difference(b), difference(c));
        let normal = cross(&b, &c);
        let square = dot(&normal, &normal);
        (square > 0.0 && square.is_finite()).then(|| Self {
            origin: *a,
            dual: [cross(&c, &normal), cross(&normal, &b), normal].map(|v| v.map(|x| x / square)),
        })
    }

    /// Returns the motion that takes the points to others at the same distances, with x of any length.
    fn study(&self, [p, q, r]: &[Point; 3]) -> Option<[Quaternion<Complex<f64>>; 2]> {
        let difference = |s: &Point| -> Point { std::array::from_fn(|k| s[k] - p[k]) };
        let (q, r) = (difference(q), difference(r));
        let images = [q, r, cross(&q, &r)];
        let m = |i: usize, j: usize| (0..3).map(|k| images[k][i] * self.dual[k][j]).sum::<Complex<f64>>();
        let trace = m(0, 0) + m(1, 1) + m(2, 2);
        let one = Complex::from(1.0);
        // Rows of 4 x x^T: the one with the largest diagonal.
        let diagonal: [Complex<f64>; 4] =
            std::array::from_fn(|k| if k == 0 { one + trace } else { one - trace + 2.0 * m(k - 1, k - 1) });
        let best = (1..4).fold(0, |best, k| if diagonal[k].norm() > diagonal[best].norm() { k } else { best });
        let off = |k: usize, l: usize| -> Complex<f64> {
            let (k, l) = (k.min(l), k.max(l));
            if k == 0 {
                let (i, j) = ((l + 1) % 3, l % 3);
                m(i, j) - m(j, i)
            } else {
                m(k - 1, l - 1) + m(l - 1, k - 1)
            }
        };
        let row: [Complex<f64>; 4] = std::array::from_fn(|k| if k == best { diagonal[k] } else { off(best, k) });
        let size = row.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let [w, i, j, k] = row.map(|z| z / size);
        let x = Quaternion { scalar: w, vector: [i, j, k] };
        let position: Point =
            std::array::from_fn(|i| p[i] - (0..3).map(|j| m(i, j) * self.origin[j]).sum::<Complex<f64>>());
        let y = Quaternion { scalar: Complex::from(0.0), vector: position }.mul(&x);
        Some([x, y])
    }
}
