//! The judge: closures and solutions in floats of 400 bits.

use looproot::internal::kinematics::closed_loop::{ClosedLoop, Variable};
use looproot::internal::kinematics::motion::{Motion, cross};
use looproot::internal::solve::newton::Six;
use looproot_algebra::ring::Ring;
use num_complex::Complex;
use rug::{Float, Rational};

const BITS: u32 = 400;

/// A float of 400 bits as a ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Big(pub Float);

/// A complex one.
pub type BigComplex = Complex<Big>;

impl Ring for Big {
    fn zero() -> Self {
        Self::from(0.0)
    }
    fn one() -> Self {
        Self::from(1.0)
    }
    fn add(&self, other: &Self) -> Self {
        Self(Float::with_val(BITS, &self.0 + &other.0))
    }
    fn sub(&self, other: &Self) -> Self {
        Self(Float::with_val(BITS, &self.0 - &other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Self(Float::with_val(BITS, &self.0 * &other.0))
    }
    fn neg(&self) -> Self {
        Self(Float::with_val(BITS, -&self.0))
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self(Float::with_val(BITS, q)))
    }
}

impl From<f64> for Big {
    fn from(x: f64) -> Self {
        Self(Float::with_val(BITS, x))
    }
}

pub fn big(z: Complex<f64>) -> BigComplex {
    Complex { re: Big::from(z.re), im: Big::from(z.im) }
}

pub fn small(z: &BigComplex) -> Complex<f64> {
    Complex::new(z.re.0.to_f64(), z.im.0.to_f64())
}

/// Cosine and sine of a complex angle.
pub fn cos_sin(z: &BigComplex) -> (BigComplex, BigComplex) {
    let (sin, cos) = z.re.0.clone().sin_cos(Float::new(BITS));
    let (sinh, cosh) = z.im.0.clone().sinh_cosh(Float::new(BITS));
    let product = |a: &Float, b: &Float| Big(Float::with_val(BITS, a * b));
    (
        Complex { re: product(&cos, &cosh), im: product(&sin, &sinh).neg() },
        Complex { re: product(&sin, &cosh), im: product(&cos, &sinh) },
    )
}

/// The residual of a closure in the sense of `solve::newton::Closure`.
fn residual(rotation: &[[BigComplex; 3]; 3], translation: &[BigComplex; 3]) -> Six<BigComplex> {
    let half = big(Complex::from(0.5));
    let skew = |i: usize, j: usize| rotation[i][j].sub(&rotation[j][i]).mul(&half);
    let [x, y, z] = translation.clone();
    [skew(2, 1), skew(0, 2), skew(1, 0), x, y, z]
}

/// The residual F of the closure at complex unknowns, and its true derivative: column j is that of L(Z_j E).
pub fn closure(closed: &ClosedLoop<Big>, unknowns: &Six<BigComplex>) -> (Six<BigComplex>, [Six<BigComplex>; 6]) {
    let mut frame: Motion<BigComplex> = Motion::identity();
    let mut twists = Vec::new();
    for j in 0..6 {
        let z: [BigComplex; 3] = std::array::from_fn(|i| frame.rotation[i][2].clone());
        let step = match closed.variables[j] {
            Variable::Rotation => {
                twists.push((z.clone(), cross(&frame.translation, &z)));
                let (cos, sin) = cos_sin(&unknowns[j]);
                Motion::rotation_z(cos, sin)
            }
            Variable::Translation => {
                twists.push((std::array::from_fn(|_| BigComplex::zero()), z));
                Motion::translation_z(unknowns[j].clone())
            }
        };
        let lift = |x: &Big| Some(Complex { re: x.clone(), im: Big::zero() });
        frame = frame.then_after(&step).then_after(&closed.constants[j].map(lift).unwrap());
    }
    let derivative = |j: usize| -> Six<BigComplex> {
        let (turn, moment) = &twists[j];
        let column = |k: usize| -> [BigComplex; 3] { std::array::from_fn(|i| frame.rotation[i][k].clone()) };
        let columns: [[BigComplex; 3]; 3] = std::array::from_fn(|k| cross(turn, &column(k)));
        let rotation = std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i].clone()));
        let carried = cross(turn, &frame.translation);
        residual(&rotation, &std::array::from_fn(|i| carried[i].add(&moment[i])))
    };
    let columns: [Six<BigComplex>; 6] = std::array::from_fn(derivative);
    let jacobian = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()));
    (residual(&frame.rotation, &frame.translation), jacobian)
}

/// The solution to which Newton's method leads from here, right to 50 digits; `None` where it leads nowhere.
pub fn solution(closed: &ClosedLoop<Big>, start: &Six<Complex<f64>>) -> Option<Six<BigComplex>> {
    let mut unknowns = start.map(big);
    for _ in 0..40 {
        let (residual, jacobian) = closure(closed, &unknowns);
        let inverse =
            looproot::internal::solve::dense::inverse(&jacobian.each_ref().map(|row| row.each_ref().map(small)))?;
        let mut largest = 0.0_f64;
        for (unknown, row) in unknowns.iter_mut().zip(&inverse) {
            let step = row.iter().zip(&residual).fold(BigComplex::zero(), |sum, (a, f)| sum.add(&big(*a).mul(f)));
            largest = largest.max(small(&step).norm());
            *unknown = unknown.sub(&step);
        }
        if !(largest < 1.0) {
            return None;
        }
        if largest < 1e-50 {
            return Some(unknowns);
        }
    }
    None
}

/// The largest difference, angles modulo whole turns.
pub fn distance(variables: &[Variable; 6], a: &Six<BigComplex>, b: &Six<Complex<f64>>) -> f64 {
    let mut largest = 0.0_f64;
    for k in 0..6 {
        let mut difference = a[k].sub(&big(b[k]));
        if variables[k] == Variable::Rotation {
            let turn = Float::with_val(BITS, rug::float::Constant::Pi) * 2_u32;
            let turns = Float::with_val(BITS, &difference.re.0 / &turn).round();
            difference.re = Big(Float::with_val(BITS, &difference.re.0 - turns * turn));
        }
        largest = largest.max(small(&difference).norm());
    }
    largest
}

/// The rigid motions nearest to stored ones.
pub fn rigid(closed: &ClosedLoop<f64>) -> ClosedLoop<Big> {
    let constants = closed.constants.each_ref().map(|stored| {
        let mut m: Motion<Big> = stored.map(|x| Some(Big::from(*x))).unwrap();
        for _ in 0..6 {
            // (3 R - R R^T R) / 2
            let turn = Motion { translation: [Big::zero(), Big::zero(), Big::zero()], ..m.clone() };
            let cube = turn.then_after(&turn.inverse()).then_after(&turn).rotation;
            let entry = |x: &Big, y: &Big| x.mul(&Big::from(1.5)).sub(&y.mul(&Big::from(0.5)));
            m.rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(&m.rotation[i][j], &cube[i][j])));
        }
        m
    });
    ClosedLoop { variables: closed.variables, constants }
}
