//! The poses of a platform by a Gröbner basis over the rationals, where its geometry or its legs are so special that the rings made for
//! platforms do not decide: no pose at all, poses that nearly form a curve, multiple ones.
//!
//! Unknowns are the quaternion x of the rotation with `N = x.x = 1`, so that every pose has two points x and -x, and one tau for each
//! dimension of the kernel of K. The theorem is in `docs/platforms.md`.

use crate::algebra::echelon::Echelon;
use crate::algebra::groebner::{Basis, Equation, Quotient};
use crate::algebra::ring::Ring;
use crate::closure::study::{Form, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::dot;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// Products of words that the basis over the rationals may take: a second.
const EFFORT: u64 = 40_000_000;
/// Products that the basis modulo a prime may take: a fifth of a second. Those of finite sets of poses take up to 600 000.
const MODULAR_EFFORT: u64 = 3_000_000;
/// Points of as many poses as six legs can have.
const MOST_POINTS: usize = 80;

/// What the basis says of the poses.
#[derive(Clone, Debug)]
pub enum PoseBasis {
    /// There are at most so many poses, complex ones included, counted with multiplicity. This is proved.
    AtMost(Box<PosePoints>),
    /// Modulo a prime drawn at run time there are infinitely many.
    InfiniteModuloPrime,
}

/// A finite set of poses.
#[derive(Clone, Debug)]
pub struct PosePoints {
    /// The bound on their number.
    pub count: usize,
    basis: Basis,
    equations: Equations,
}

/// The equations of the poses, and what they are about.
#[derive(Clone, Debug)]
struct Equations {
    unknowns: usize,
    all: Vec<Equation>,
    rotation: [Equation; 4],
    position: [Equation; 3],
}

/// The matrices of multiplication with which poses are computed.
#[derive(Clone, Debug)]
pub struct PoseTable {
    /// Multiplication with a linear form of all unknowns: column k is the product with standard monomial k, of which 1 is the first.
    pub form: Vec<Vec<Rational>>,
    /// The quaternion of the rotation over the standard monomials.
    pub rotation: [Vec<Rational>; 4],
    /// The position over the standard monomials.
    pub position: [Vec<Rational>; 3],
}

/// Returns what a basis says of the poses of a platform with legs of these squared lengths; `None` where it takes too much work.
#[must_use]
pub fn pose_basis(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Option<PoseBasis> {
    let equations = Equations::of(platform, squares)?;
    let (basis, modular) = Basis::spanning(equations.unknowns, &equations.all, MODULAR_EFFORT, EFFORT)?;
    if modular.dimension() > Some(0) {
        return Some(PoseBasis::InfiniteModuloPrime);
    }
    let basis = basis?;
    let count = basis.count(MOST_POINTS)? / 2;
    Some(PoseBasis::AtMost(Box::new(PosePoints { count, basis, equations })))
}

impl Equations {
    fn of(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Option<Self> {
        let legs = linear_legs(platform);
        // Right sides of K u = c(x), to which the identity stands for now.
        let unit = |i: usize| (0..6).map(move |k| Rational::from(u8::from(i == k)));
        let rows = (0..6).map(|i| legs.matrix[i].iter().cloned().chain(unit(i)).collect());
        let echelon = Echelon::among(rows.collect(), 13, 7);
        let free: Vec<usize> = echelon.free_columns().into_iter().filter(|column| *column < 7).collect();
        let unknowns = free.len() + 4;
        let rotation: [Equation; 4] = std::array::from_fn(|k| Equation::variable(free.len() + k));
        let number = Equation::from_rational;
        let norm = rotation.iter().fold(Equation::zero(), |sum, x| sum.add(&x.mul(x)));
        let right: Option<Vec<Equation>> =
            (0..6).map(|i| Some(quadratic(&legs.forms[i], &rotation)?.add(&number(&squares[i])?.mul(&norm)))).collect();
        let right = right?;
        let combined = |factors: &[Rational]| -> Option<Equation> {
            let mut terms = factors.iter().zip(&right);
            terms.try_fold(Equation::zero(), |sum, (c, right)| Some(sum.add(&number(c)?.mul(right))))
        };
        let mut u: [Equation; 7] = std::array::from_fn(|_| Equation::zero());
        for (tau, &column) in free.iter().enumerate() {
            u[column] = Equation::variable(tau);
        }
        for (row, &column) in echelon.rows().iter().zip(echelon.pivots()) {
            let known = combined(&row[7..])?;
            u[column] = free.iter().enumerate().try_fold(known, |sum, (tau, &column)| {
                Some(sum.sub(&number(&row[column])?.mul(&Equation::variable(tau))))
            })?;
        }
        let mut all = vec![norm.sub(&Equation::one())];
        // What annihilates K from the left.
        let columns = (0..7).map(|k| legs.matrix.iter().map(|row| row[k].clone()).collect());
        for factors in Echelon::of(columns.collect(), 6).null_space() {
            all.push(combined(&factors)?);
        }
        let [s, p1, p2, p3, q1, q2, q3] = u;
        let (p, q) = ([p1, p2, p3], [q1, q2, q3]);
        let [w, x, y, z] = rotation.clone();
        let turn = Quaternion { scalar: w, vector: [x, y, z] };
        let pure = |vector: &[Equation; 3]| Quaternion { scalar: Equation::zero(), vector: vector.clone() };
        let (before, behind) = (pure(&p).mul(&turn), turn.mul(&pure(&q)));
        all.push(behind.scalar.sub(&before.scalar));
        all.extend(behind.vector.iter().zip(&before.vector).map(|(x, y)| x.sub(y)));
        all.extend([&p, &q].map(|v| dot(v, v).sub(&s)));
        Some(Self { unknowns, all, rotation, position: p })
    }
}

/// The value of a quadratic form.
fn quadratic(form: &Form<Rational>, x: &[Equation; 4]) -> Option<Equation> {
    let mut sum = Equation::zero();
    for (row, x_i) in form.iter().zip(x) {
        for (c, x_j) in row.iter().zip(x) {
            sum = sum.add(&Equation::from_rational(c)?.mul(x_i).mul(x_j));
        }
    }
    Some(sum)
}

impl PosePoints {
    /// Returns the matrices that lead to the poses; nothing of them is proved.
    #[must_use]
    pub fn table(&self) -> Option<PoseTable> {
        let quotient = Quotient::of(&self.basis, MOST_POINTS)?;
        // Small numbers without common factors: as a rule no two points share the value.
        let weighted =
            |k: usize| Equation::variable(k).mul(&Equation::from_integer([3, -7, 11, -2, 5, 13, -17, 19][k % 8]));
        let form = (0..self.equations.unknowns).fold(Equation::zero(), |sum, k| sum.add(&weighted(k)));
        let [w, x, y, z] = self.equations.rotation.each_ref().map(|x| quotient.element(x));
        let [a, b, c] = self.equations.position.each_ref().map(|p| quotient.element(p));
        let (rotation, position) = ([w?, x?, y?, z?], [a?, b?, c?]);
        Some(PoseTable { form: quotient.multiplication(&form)?, rotation, position })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(numbers: [[i32; 3]; 6]) -> [[Rational; 3]; 6] {
        numbers.map(|point| point.map(Rational::from))
    }

    /// Legs of a pose that is known, and the same legs but one, which no pose has: five points lie on two lines.
    #[test]
    fn poses_are_counted() {
        let base = points([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 1], [2, 5, 0], [-1, 2, 2]]);
        let platform = Platform { base: base.clone(), plate: base };
        // A congruent plate moved by (1, 2, 2) without a turn.
        let squares: [Rational; 6] = std::array::from_fn(|_| Rational::from(9));
        assert!(matches!(pose_basis(&platform, &squares), Some(PoseBasis::InfiniteModuloPrime)));
        let mut lengths = squares;
        lengths[5] += Rational::from((1, 7));
        let Some(PoseBasis::AtMost(found)) = pose_basis(&platform, &lengths) else { panic!("finitely many poses") };
        assert!(found.count <= 24);
    }
}
