//! The data of a platform that are computed once for all leg lengths.

use crate::algebra::double_double::DoubleDouble;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::certify::pose::Curvature;
use crate::closure::study::{Form, Four, Leg, left, leg_matrix, linear_legs, right, scalar};
use crate::elimination::border::{Directions, Reals, Setting, weak_directions};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::platform::Platform;
use crate::solve::scalar::Scalar;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use num_complex::Complex;
use rug::Rational;

/// Rotations (w, x, y, z) of base and moving platform, so that no solution of a real mechanism lies at the edge of a chart.
const TURNS: [[[f64; 4]; 2]; 2] = [
    [[0.533, -0.271, 0.618, 0.509], [0.457, 0.662, -0.324, 0.498]],
    [[-0.391, 0.587, 0.283, 0.651], [0.702, -0.219, 0.485, -0.474]],
];

/// Displacement of the points of a general platform, in units of the size of the platform.
const MOVED: f64 = 0.5;

/// A platform scaled to size 1, with rotated points, ready for border bases.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The solution of the linear equations with K.
    pub directions: Directions<f64>,
    /// The setting with legs of length zero.
    pub setting: Setting<f64>,
    /// `x = turn z`.
    turn: Form<f64>,
    /// `y = size turn y' + shift x`.
    size: f64,
    shift: Form<f64>,
}

impl Chart {
    /// Returns the chart with one of the built-in rotations, for a platform that is already shifted and scaled.
    pub fn new(platform: &Platform<f64>, choice: usize) -> Self {
        let [before, behind] = TURNS[choice].map(|q| {
            let size = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            let [w, x, y, z] = q.map(|x| x / size);
            Quaternion { scalar: w, vector: [x, y, z] }
        });
        let [centre_base, centre_plate] = [centroid(&platform.base), centroid(&platform.plate)];
        let size = size(platform);
        let turned = |p: &Vector<f64>, centre: &Vector<f64>, q: &Quaternion<f64>| -> Vector<f64> {
            let local = std::array::from_fn(|k| (p[k] - centre[k]) / size);
            q.mul(&Quaternion { scalar: 0.0, vector: local }).mul(&q.conjugate()).vector
        };
        let local = Platform {
            base: platform.base.map(|a| turned(&a, &centre_base, &before.conjugate())),
            plate: platform.plate.map(|b| turned(&b, &centre_plate, &behind)),
        };
        let shift = leg_matrix(&centre_base, &centre_plate).map(|row| row.map(|x| -x));
        Self::of_local(&local, &before, &behind, size, shift)
    }

    fn of_local(
        local: &Platform<f64>,
        before: &Quaternion<f64>,
        behind: &Quaternion<f64>,
        size: f64,
        shift: Form<f64>,
    ) -> Self {
        let legs = linear_legs(local);
        let directions = weak_directions(&legs.matrix);
        let setting = Setting::new(&Reals, &directions, &legs.forms);
        let matrix = |q: &Quaternion<f64>, side: fn(&Vector<f64>) -> Form<f64>| {
            let mut matrix = side(&q.vector);
            for (i, row) in matrix.iter_mut().enumerate() {
                row[i] += q.scalar;
            }
            matrix
        };
        let (l, r) = (matrix(before, left), matrix(behind, right));
        let turn = std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| l[i][k] * r[k][j]).sum()));
        Self { directions, setting, turn, size, shift }
    }

    /// Returns the setting with legs of these squared lengths, in the unit of the platform given to `new`.
    pub fn with_legs(&self, squares: &[f64; 6]) -> Setting<f64> {
        let local = squares.map(|s| s / (self.size * self.size));
        self.setting.with_legs(&Reals, &self.directions, &local)
    }

    /// Converts Study's parameters of the rotated platform to those of the platform given to `new`.
    pub fn outward<S: Scalar>(&self, z: &Four<S>, y: &Four<S>) -> [S; 8] {
        let apply = |matrix: &Form<f64>, v: &Four<S>| -> Four<S> {
            std::array::from_fn(|i| (0..4).fold(S::zero(), |sum, k| sum.add(&v[k].times(matrix[i][k]))))
        };
        let (x, turned) = (apply(&self.turn, z), apply(&self.turn, y));
        let shifted = apply(&self.shift, &x);
        std::array::from_fn(|k| if k < 4 { x[k] } else { turned[k - 4].times(self.size).add(&shifted[k - 4]) })
    }
}

/// Returns the mean of six points.
pub fn centroid(points: &[Vector<f64>; 6]) -> Vector<f64> {
    std::array::from_fn(|k| points.iter().map(|p| p[k]).sum::<f64>() / 6.0)
}

/// Returns the root mean square distance of all twelve points from their centroids; 1 if that is zero or not finite.
pub fn size(platform: &Platform<f64>) -> f64 {
    let spread = |points: &[Vector<f64>; 6]| -> f64 {
        let centre = centroid(points);
        points.iter().map(|p| (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>()).sum()
    };
    let size = ((spread(&platform.base) + spread(&platform.plate)) / 12.0).sqrt();
    if size > 0.0 && size.is_finite() { size } else { 1.0 }
}

/// The platform as it is polished: about its centre, and in a unit that is a power of two. The points are moved exactly,
/// and rounded once.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The unit.
    pub scale: f64,
    /// The points subtracted from those of the base and of the moving platform.
    pub origins: [Vector<f64>; 2],
    /// The points in this frame.
    pub platform: Platform<f64>,
    /// The legs in this frame, of length zero.
    pub legs: [Leg<f64>; 6],
    /// The legs in double-double arithmetic.
    pub wide: [Leg<DoubleDouble>; 6],
    /// The legs in exact arithmetic.
    pub exact: [Leg<Rational>; 6],
    /// Bound on the relative rounding of the points of `legs`.
    pub rounding: f64,
}

/// Bound on the relative rounding error of a number converted to f64.
pub const ROUNDING: f64 = f64::EPSILON / 2.0;

/// Squared lengths of legs, in the unit of the platform as given.
pub struct Squares {
    /// The values in f64.
    narrow: [f64; 6],
    wide: [DoubleDouble; 6],
    rounding: f64,
    /// The exact values, if they were given.
    pub exact: Option<[Rational; 6]>,
}

impl Squares {
    /// Takes numbers that are exact in f64.
    pub fn of_floats(squares: &[f64; 6]) -> Self {
        Self { narrow: *squares, wide: squares.map(Into::into), rounding: 0.0, exact: None }
    }

    /// Takes exact numbers and rounds them.
    pub fn of(squares: &[Rational; 6]) -> Self {
        let narrow = squares.each_ref().map(rounded);
        let rounding = if narrow.iter().zip(squares).all(|(x, q)| *q == *x) { 0.0 } else { ROUNDING };
        let wide = squares.each_ref().map(|q| DoubleDouble::from_rational(q).unwrap_or_else(DoubleDouble::zero));
        Self { narrow, wide, rounding, exact: Some(squares.clone()) }
    }
}

/// The legs of one set of lengths, in the frame of polishing.
pub struct LegNumbers {
    /// The legs in f64.
    pub legs: [Leg<f64>; 6],
    /// The legs in double-double arithmetic.
    pub wide: [Leg<DoubleDouble>; 6],
    /// Bounds on second derivatives, for certificates.
    pub curvature: Curvature,
}

impl LegNumbers {
    /// Takes legs that are exact in f64.
    pub fn of_floats(legs: [Leg<f64>; 6]) -> Self {
        let wide = legs
            .each_ref()
            .map(|leg| Leg { matrix: leg.matrix.map(|row| row.map(Into::into)), square: leg.square.into() });
        let curvature = Curvature::new(&legs, 0.0);
        Self { legs, wide, curvature }
    }
}

/// Converts a leg to numbers of another kind.
pub fn leg_in<R: Ring>(leg: &Leg<Rational>) -> Leg<R> {
    let image = |x: &Rational| R::from_rational(x).unwrap_or_else(R::zero);
    Leg { matrix: leg.matrix.each_ref().map(|row| row.each_ref().map(image)), square: image(&leg.square) }
}

/// Returns the nearest f64, or 0 if there is none.
fn rounded(x: &Rational) -> f64 {
    let x = nearest_f64(x);
    if x.is_finite() { x } else { 0.0 }
}

impl Frame {
    /// Returns the legs of these squared lengths.
    pub fn with_legs(&self, squares: &Squares) -> LegNumbers {
        let unit = self.scale * self.scale;
        let (mut legs, mut wide) = (self.legs.clone(), self.wide.clone());
        for i in 0..6 {
            legs[i].square = squares.narrow[i] / unit;
            wide[i].square = squares.wide[i].mul(&DoubleDouble::from(1.0 / unit));
        }
        let curvature = Curvature::new(&legs, self.rounding.max(squares.rounding));
        LegNumbers { legs, wide, curvature }
    }

    /// Returns the legs of these squared lengths in multiprecision.
    pub fn long_legs<R: Ring>(&self, squares: &[Rational; 6]) -> [Leg<R>; 6] {
        let unit = Rational::from_f64(self.scale).map_or_else(|| Rational::from(1), Rational::square);
        std::array::from_fn(|i| {
            let leg = Leg { square: Rational::from(&squares[i] / &unit), ..self.exact[i].clone() };
            leg_in(&leg)
        })
    }

    /// Returns the frame of a platform. Points near the origin stay where they are.
    pub fn new(platform: &Platform<Rational>) -> Self {
        let centred = |points: &[Vector<Rational>; 6]| {
            let centre: Vector<Rational> =
                std::array::from_fn(|k| points.iter().map(|p| &p[k]).sum::<Rational>() / Rational::from(6));
            let local =
                points.each_ref().map(|p| std::array::from_fn(|k| rounded(&Rational::from(&p[k] - &centre[k]))));
            (centre.map(|c| rounded(&c)), local)
        };
        let ((base_centre, base), (plate_centre, plate)) = (centred(&platform.base), centred(&platform.plate));
        let scale = size(&Platform { base, plate }).log2().ceil().exp2();
        let grid = 8.0 * scale;
        let origins = [base_centre, plate_centre].map(|centre| centre.map(|c| (c / grid).round() * grid));
        let exact = |x: f64| Rational::from_f64(x).unwrap_or_default();
        let moved = |p: &Vector<Rational>, origin: &Vector<f64>| -> Vector<Rational> {
            std::array::from_fn(|k| Rational::from(&p[k] - &exact(origin[k])) / exact(scale))
        };
        let moved = Platform {
            base: platform.base.each_ref().map(|a| moved(a, &origins[0])),
            plate: platform.plate.each_ref().map(|b| moved(b, &origins[1])),
        };
        let points = |points: &[Vector<Rational>; 6]| points.each_ref().map(|p| p.each_ref().map(rounded));
        let platform = Platform { base: points(&moved.base), plate: points(&moved.plate) };
        let legs = std::array::from_fn(|i| Leg::new(&platform.base[i], &platform.plate[i], 0.0));
        let leg = |i: usize| Leg::new(&moved.base[i], &moved.plate[i], Rational::new());
        let exact_legs: [Leg<Rational>; 6] = std::array::from_fn(leg);
        let wide = exact_legs.each_ref().map(leg_in);
        let is_exact = legs.iter().zip(&exact_legs).all(|(leg, other)| {
            let pairs = leg.matrix.iter().flatten().zip(other.matrix.iter().flatten());
            pairs.into_iter().all(|(x, y)| *y == *x)
        });
        let rounding = if is_exact { 0.0 } else { ROUNDING };
        Self { scale, origins, platform, legs, wide, exact: exact_legs, rounding }
    }

    /// Returns a general platform not far from this one; `run` numbers the ways to move the points.
    pub fn general(&self, run: usize) -> Platform<f64> {
        let size = size(&self.platform);
        let mut platform = self.platform.clone();
        for (i, point) in platform.base.iter_mut().chain(&mut platform.plate).enumerate() {
            for (k, x) in point.iter_mut().enumerate() {
                // Multiples of square roots of primes, modulo 1, are evenly spread and the same in every run.
                let root = [2.0_f64, 3.0, 5.0][k].sqrt();
                *x += MOVED * size * (2.0 * ((i + 12 * run + 1) as f64 * root).fract() - 1.0);
            }
        }
        platform
    }

    /// Returns Study's parameters of a real pose of the platform as given.
    pub fn study(&self, pose: &Motion<f64>) -> [f64; 8] {
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|i, k| pose.rotation[i][k]));
        let [x, y, z, w] = UnitQuaternion::from_rotation_matrix(&rotation).coords.into();
        let x = Quaternion { scalar: w, vector: [x, y, z] };
        let centre = pose.apply(&self.origins[1]);
        let place = std::array::from_fn(|k| (centre[k] - self.origins[0][k]) / self.scale);
        let y = Quaternion { scalar: 0.0, vector: place }.mul(&x);
        let parts = |q: &Quaternion<f64>| [q.scalar, q.vector[0], q.vector[1], q.vector[2]];
        let (x, y) = (parts(&x), parts(&y));
        std::array::from_fn(|k| if k < 4 { x[k] } else { y[k - 4] })
    }

    /// Returns the translation of a pose in the unit and about the origin of the platform as given.
    pub fn position<S: Scalar>(&self, study: &[S; 8]) -> [S; 3] {
        let quaternion = |[w, x, y, z]: [S; 4]| Quaternion { scalar: w, vector: [x, y, z] };
        let x = quaternion([study[0], study[1], study[2], study[3]]);
        let y = quaternion([study[4], study[5], study[6], study[7]]);
        let norm = x.norm();
        let vector = y.mul(&x.conjugate()).vector;
        let centre = quaternion([
            S::zero(),
            S::from_f64(self.origins[1][0]),
            S::from_f64(self.origins[1][1]),
            S::from_f64(self.origins[1][2]),
        ]);
        let turned = x.mul(&centre).mul(&x.conjugate()).vector;
        std::array::from_fn(|k| {
            let moved = vector[k].times(self.scale).sub(&turned[k]).over(norm);
            moved.add(&S::from_f64(self.origins[0][k]))
        })
    }
}

/// Roundings of a numerator of the translation in f64, relative to the sum of the sizes of its terms: products of three numbers, complex
/// ones, and sums of sixteen terms.
const POSITION_ROUNDINGS: f64 = 64.0;

impl Frame {
    /// Returns a bound on the error of [`Frame::position`] where every one of Study's parameters is off by at most `radius`, and each
    /// operation rounds; infinite where `x.x` may be 0.
    pub fn position_error(&self, study: &[Complex<f64>; 8], radius: f64) -> f64 {
        let sum = |values: &[Complex<f64>]| values.iter().map(|z| z.re.abs() + z.im.abs()).sum::<f64>();
        let (x, y) = (sum(&study[..4]), sum(&study[4..]));
        let plate = self.origins[1].iter().map(|c| c.abs()).sum::<f64>();
        let base = self.origins[0].iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        // Every entry of `y x*` is a sum of four products of one number of each, and one of `x c x*` a sum of such with four pairs of x
        // for every entry of c; N is a sum of four squares.
        let product = radius * (x + y) + 4.0 * radius * radius;
        let square = 2.0 * radius * x + 4.0 * radius * radius;
        let rounding = POSITION_ROUNDINGS * f64::EPSILON;
        let above = self.scale * (product + rounding * x * y) + plate * (square + rounding * x * x);
        let below = square + rounding * x * x;
        let norm = norm(study).norm() - below;
        let moved = self.position(study).map(Complex::norm).into_iter().fold(0.0, f64::max);
        // NaN becomes infinite.
        if norm > 0.0 { (above + (moved + base) * below) / norm + rounding * (moved + base) } else { f64::INFINITY }
    }
}

/// Returns `x.x`.
pub fn norm<S: Ring>(study: &[S; 8]) -> S {
    let [a, b, c, d, ..] = study;
    let x = [a.clone(), b.clone(), c.clone(), d.clone()];
    scalar(&x, &x)
}
