//! Roots of two equations whose sides have one variable each, and of one equation in the monomials of one variable.

use super::francis;
use super::kernel::double_angle;
use super::scalar::Scalar;
use crate::elimination::separated::{Plan, Separated, powers, quartic};
use crate::kinematics::closed_loop::Variable;
use num_complex::Complex;
use std::f64::consts::PI;

/// Cosine and sine of an angle from its half tangent less an offset.
#[must_use]
pub fn unshifted<S: Scalar>(x: S, (cos, sin): (f64, f64)) -> Option<(S, S)> {
    let (c, s) = double_angle(S::one(), x)?;
    Some((c.times(cos).sub(&s.times(sin)), s.times(cos).add(&c.times(sin))))
}

/// Both roots of `row . (1, cos, sin) = 0`.
#[must_use]
pub fn both_roots<S: Scalar>([constant, cos, sin]: &[S; 3]) -> Option<[(S, S); 2]> {
    let square = cos.mul(cos).add(&sin.mul(sin));
    let inverse = square.inverse()?;
    let root = square.sub(&constant.mul(constant)).root();
    let at = |w: &S| {
        let c = constant.mul(cos).add(&sin.mul(w)).neg().mul(&inverse);
        let s = cos.mul(w).sub(&constant.mul(sin)).mul(&inverse);
        (c, s)
    };
    Some([at(&root), at(&root.neg())])
}

/// Some roots of a polynomial, without allocation.
struct RootList {
    list: [Complex<f64>; 4],
    count: usize,
}

/// The roots of a conic form in the monomials of a variable, and the offset from which its angle is counted; `None`
/// where the form vanishes.
fn roots_of(kind: Variable, conic: &[[f64; 3]; 3]) -> Option<(RootList, (f64, f64))> {
    let mut best: Option<(f64, [f64; 5], (f64, f64))> = None;
    for k in 0..8 {
        let (sin, cos) = (0.1 + 0.25 * PI * f64::from(k)).sin_cos();
        let coefficients = quartic(conic, &powers(kind, &[1.0, cos, sin]));
        let largest = coefficients.iter().map(|c| c.abs()).fold(0.0, f64::max);
        if !(largest > 0.0) || !largest.is_finite() {
            return None;
        }
        let quality = coefficients[4].abs() / largest;
        if best.as_ref().is_none_or(|b| quality > b.0) {
            best = Some((quality, coefficients.map(|c| c / largest), (cos, sin)));
        }
        if quality > 0.1 || kind == Variable::Translation {
            break;
        }
    }
    let (_, coefficients, offset) = best?;
    Some((polynomial_roots(&coefficients)?, offset))
}

/// Cosine and sine of an angle.
#[derive(Clone, Copy, Debug)]
pub enum Angle {
    /// A real one.
    Real((f64, f64)),
    /// A complex one.
    Complex((Complex<f64>, Complex<f64>)),
}

/// Returns the angles at which a quadratic form in (1, cos, sin) vanishes, one of each pair of conjugates, without those at
/// infinity.
#[must_use]
pub fn angles_of(conic: &[[f64; 3]; 3]) -> [Option<Angle>; 4] {
    let Some((roots, offset)) = roots_of(Variable::Rotation, conic) else { return [None; 4] };
    let angle = |x: Complex<f64>| {
        if x.im == 0.0 {
            return unshifted(x.re, offset).map(Angle::Real);
        }
        (x.im > 0.0).then(|| unshifted(x, offset)).flatten().map(Angle::Complex)
    };
    std::array::from_fn(|k| if k < roots.count { angle(roots.list[k]) } else { None })
}

/// Leading coefficients below this part of the largest one are none.
const LEADING: f64 = 1e-13;

fn polynomial_roots(coefficients: &[f64; 5]) -> Option<RootList> {
    let degree = (0..5).rev().find(|&k| coefficients[k].abs() > LEADING)?;
    let monic: [f64; 4] =
        std::array::from_fn(|k| if k < degree { coefficients[k] / coefficients[degree] } else { 0.0 });
    let mut list = [Complex::new(0.0, 0.0); 4];
    match degree {
        0 => {}
        1 => list[0] = Complex::from(-monic[0]),
        2 => {
            let (half, constant) = (-0.5 * monic[1], monic[0]);
            let discriminant = half * half - constant;
            if discriminant >= 0.0 {
                let larger = half + discriminant.sqrt().copysign(half);
                list[0] = Complex::from(larger);
                list[1] = Complex::from(if larger == 0.0 { 0.0 } else { constant / larger });
            } else {
                list[0] = Complex::new(half, (-discriminant).sqrt());
                list[1] = list[0].conj();
            }
        }
        3 => list[..3].copy_from_slice(&companion_roots([monic[0], monic[1], monic[2]])?),
        _ => list = companion_roots(monic)?,
    }
    Some(RootList { list, count: degree })
}

fn companion_roots<const N: usize>(monic: [f64; N]) -> Option<[Complex<f64>; N]> {
    let mut matrix = [[0.0; N]; N];
    for k in 0..N {
        matrix[k][N - 1] = -monic[k];
        if k > 0 {
            matrix[k][k - 1] = 1.0;
        }
    }
    francis::eigenvalues(&mut matrix)
}

/// `row . m`
fn at<S: Scalar>(row: &[f64; 3], m: &[S; 3]) -> S {
    (0..3).fold(S::zero(), |sum, k| sum.add(&m[k].times(row[k])))
}

/// The monomials of a variable at which `row . m = 0`.
pub fn zeros<S: Scalar>(kind: Variable, row: &[S; 3]) -> [Option<[S; 3]>; 2] {
    let distance = |d: S| [S::one(), d, d.mul(&d)];
    match kind {
        Variable::Rotation => both_roots(row).map_or([None; 2], |pairs| pairs.map(|(c, s)| Some([S::one(), c, s]))),
        Variable::Translation => {
            let size = row[0].size().max(row[1].size());
            if !(row[2].size() > LEADING * size) {
                return [row[1].inverse().map(|inverse| distance(row[0].mul(&inverse).neg())), None];
            }
            let half = row[1].over(row[2]).halved().neg();
            let root = half.mul(&half).sub(&row[0].over(row[2])).root();
            [Some(distance(half.add(&root))), Some(distance(half.sub(&root)))]
        }
    }
}

/// The pair with which a variable enters a motion, from its monomials.
pub fn pair<S: Scalar>(kind: Variable, m: &[S; 3]) -> (S, S) {
    match kind {
        Variable::Rotation => (m[1], m[2]),
        Variable::Translation => (m[1], S::zero()),
    }
}

/// Two such equations, their roots found.
pub struct SeparatedRoots {
    kinds: [Variable; 2],
    plan: Plan<f64>,
    side: usize,
    offset: (f64, f64),
    roots: RootList,
}

impl SeparatedRoots {
    /// Solves the equations for one side; determinants no larger than `tolerance` are zero. `None` where the equation
    /// for that side vanishes.
    #[must_use]
    pub fn of(equations: &Separated<f64>, tolerance: f64) -> Option<Self> {
        let plan = equations.plan(tolerance);
        let (side, conic) = match &plan {
            Plan::Together { hidden, other } => (*hidden, equations.conic(*hidden, other)),
            // The constant monomial is 1: a linear equation is a form with that factor.
            Plan::Apart { first, equation, .. } => (*first, [*equation, [0.0; 3], [0.0; 3]]),
        };
        let (roots, offset) = roots_of(equations.kinds[side], &conic)?;
        Some(Self { kinds: equations.kinds, plan, side, offset, roots })
    }

    /// Half tangents of the angle of one side less the offset, or distances.
    #[must_use]
    pub fn roots(&self) -> &[Complex<f64>] {
        &self.roots.list[..self.roots.count]
    }

    /// Whether several solutions share a root.
    #[must_use]
    pub fn are_shared(&self) -> bool {
        matches!(self.plan, Plan::Apart { .. })
    }

    /// The monomials of both sides that a root leads to.
    #[must_use]
    pub fn monomials<S: Scalar>(&self, x: S) -> [Option<[[S; 3]; 2]>; 2] {
        let known = match self.kinds[self.side] {
            Variable::Rotation => match unshifted(x, self.offset) {
                Some((cos, sin)) => [S::one(), cos, sin],
                None => return [None; 2],
            },
            Variable::Translation => [S::one(), x, x.mul(&x)],
        };
        let others = match &self.plan {
            Plan::Together { other, .. } => [Some(other.each_ref().map(|row| at(row, &known))), None],
            Plan::Apart { then, .. } => {
                let mut row = then[1].map(S::from_f64);
                row[0] = row[0].sub(&at(&then[0], &known));
                zeros(self.kinds[1 - self.side], &row)
            }
        };
        others.map(|other| other.map(|other| if self.side == 0 { [known, other] } else { [other, known] }))
    }
}
