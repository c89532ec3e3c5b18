//! Loops with a ball: its centre first, by the point that both sides reach; its rotation is what is left.
//!
//! A ball is three rotations about z, x and z again, the second one from 0 to pi, so that every rotation is listed once.

use super::few_rotations::{both_roots, unshifted};
use super::limits;
use super::mode::{Assembly, Mode};
use super::search::{Family, RootOutcome, Search};
use crate::elimination::point_reach::{Plan, Reach, powers, quartic};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::link_form::product as matrix_product;
use crate::kinematics::motion::Motion;
use crate::solve::francis;
use crate::solve::newton::{Six, coordinates, turn};
use crate::solve::scalar::Scalar;
use num_complex::Complex;
use std::f64::consts::PI;

type Rotation<S> = [[S; 3]; 3];

impl Search<'_> {
    /// Every position of the centre of the ball that begins at this unknown.
    pub fn centre(&mut self, ball: usize) {
        let reach = Reach::of(self.closed, ball);
        let plan = reach.plan(limits::REACH_DEPENDENT);
        let (side, conic) = match &plan {
            Plan::Together { hidden, other } => (*hidden, reach.conic(*hidden, other)),
            Plan::Apart { first, equation, .. } => (*first, [*equation, [0.0; 3], [0.0; 3]]),
        };
        // The constant monomial is 1: a linear equation is a form with a factor 1.
        let kind = reach.kind(side);
        let Some((roots, offset)) = roots_of(kind, &conic) else { return };
        self.assembly.tries += 1;
        let mut family = OfBall { ball, plan: &plan, side, offset, reach: &reach, complex: None };
        self.assembly.clean = self.all_roots(&mut family, roots.as_slice());
    }

    /// Admits a loop with a ball: in angles of the ball that are far from where they are not independent.
    fn admit_ball<S: Scalar>(&mut self, ball: usize, others: &[(Variable, (S, S)); 3]) -> bool {
        let mut rest: Motion<S> = Motion::identity();
        for (k, (variable, pair)) in others.iter().enumerate() {
            turn(&mut rest, *variable, *pair);
            rest = rest.then_after(&lifted(&self.closed.constants[(ball + 3 + k) % 6]));
        }
        let behind = lifted::<S>(&self.closed.constants[(ball + 2) % 6]);
        let inverse = matrix_product(&behind.rotation, &rest.rotation);
        let rotation: Rotation<S> = std::array::from_fn(|i| std::array::from_fn(|j| inverse[j][i]));
        let mut start: Six<S> = [S::zero(); 6];
        for (k, (variable, (first, second))) in others.iter().enumerate() {
            start[(ball + 3 + k) % 6] = match variable {
                Variable::Rotation => S::angle_of(*first, *second),
                Variable::Translation => *first,
            };
        }
        let (angles, lock) = ball_angles(&rotation);
        if lock > limits::LOCKED {
            place(&mut start, ball, angles);
            return self.admit(&start);
        }
        // Near the lock, as a ball with its third angle about another axis.
        let turned = matrix_product(&rotation, &quarter().map(|row| row.map(S::from_f64)));
        place(&mut start, ball, ball_angles(&turned).0);
        let mut closed = self.closed.clone();
        let constant = &mut closed.constants[(ball + 2) % 6];
        *constant = Motion { rotation: quarter(), translation: [0.0; 3] }.inverse().then_after(constant);
        let mut found = Assembly { tries: self.assembly.tries, ..Assembly::default() };
        let settled = Search {
            prepared: &[],
            closed: &closed,
            ball: None,
            gap_rounding: self.gap_rounding,
            roots: self.roots,
            eigen: &mut *self.eigen,
            assembly: &mut found,
        }
        .admit(&start);
        for mut mode in found.modes {
            back(&mut mode, ball);
            self.merge(mode);
        }
        settled
    }
}

fn lifted<S: Scalar>(motion: &Motion<f64>) -> Motion<S> {
    Motion {
        rotation: motion.rotation.map(|row| row.map(S::from_f64)),
        translation: motion.translation.map(S::from_f64),
    }
}

fn place<S: Copy>(unknowns: &mut Six<S>, ball: usize, angles: [S; 3]) {
    for (k, angle) in angles.into_iter().enumerate() {
        unknowns[(ball + k) % 6] = angle;
    }
}

/// A quarter turn about y.
fn quarter() -> Rotation<f64> {
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]
}

/// The rotation of a ball.
fn ball_rotation<S: Scalar>(angles: [S; 3]) -> Rotation<S> {
    let about_z = |q: S| {
        let mut m: Motion<S> = Motion::identity();
        turn(&mut m, Variable::Rotation, coordinates(Variable::Rotation, q));
        m.rotation
    };
    let (cos, sin) = coordinates(Variable::Rotation, angles[1]);
    let about_x = Motion::rotation_x(cos, sin).rotation;
    matrix_product(&matrix_product(&about_z(angles[0]), &about_x), &about_z(angles[2]))
}

/// The three angles of a ball, and the sine of the second one: near 0 the other two are not independent, and at 0 the
/// third one is.
fn ball_angles<S: Scalar>(r: &Rotation<S>) -> ([S; 3], f64) {
    let cos = r[2][2];
    // The larger of two ways to the square of the sine keeps its digits.
    let square = r[0][2].mul(&r[0][2]).add(&r[1][2].mul(&r[1][2]));
    let sin = square.root();
    let lock = sin.size();
    if !(lock > 1e-9) {
        return ([S::angle_of(r[0][0], r[1][0]), S::angle_of(cos, S::zero()), S::zero()], lock);
    }
    ([S::angle_of(r[1][2].neg(), r[0][2]), S::angle_of(cos, sin), S::angle_of(r[2][1], r[2][0])], lock)
}

/// A mode of the turned ball in the angles of the ball as it is.
fn back(mode: &mut Mode, ball: usize) {
    let angles = [0, 1, 2].map(|k| mode.unknowns[(ball + k) % 6]);
    let quarter = quarter();
    let inverse: Rotation<Complex<f64>> = std::array::from_fn(|i| std::array::from_fn(|j| quarter[j][i].into()));
    let rotation = matrix_product(&ball_rotation(angles), &inverse);
    let angles = if mode.real {
        ball_angles(&rotation.map(|row| row.map(|z| z.re))).0.map(Complex::from)
    } else {
        ball_angles(&rotation).0
    };
    place(&mut mode.unknowns, ball, angles);
}

/// The angles of a ball with the second one from 0 to pi, the same rotation.
pub(super) fn canonical(unknowns: &mut Six<Complex<f64>>, ball: usize) {
    let index = |k: usize| (ball + k) % 6;
    if super::mode::wrapped(unknowns[index(1)].re) < 0.0 {
        unknowns[index(1)] = -unknowns[index(1)];
        for k in [0, 2] {
            let angle = &mut unknowns[index(k)];
            angle.re = super::mode::wrapped(angle.re + PI);
        }
    }
}

/// Some roots of a polynomial, without allocation.
struct RootList {
    list: [Complex<f64>; 4],
    count: usize,
}

impl RootList {
    fn as_slice(&self) -> &[Complex<f64>] {
        &self.list[..self.count]
    }
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

/// The positions of the centre of a ball.
struct OfBall<'a> {
    ball: usize,
    plan: &'a Plan<f64>,
    side: usize,
    offset: (f64, f64),
    reach: &'a Reach<f64>,
    complex: Option<Reach<Complex<f64>>>,
}

/// `row . m`
fn at<S: Scalar>(row: &[f64; 3], m: &[S; 3]) -> S {
    (0..3).fold(S::zero(), |sum, k| sum.add(&m[k].times(row[k])))
}

/// The monomials of a variable at which `row . m = 0`.
fn zeros<S: Scalar>(kind: Variable, row: &[S; 3]) -> [Option<[S; 3]>; 2] {
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
fn pair<S: Scalar>(kind: Variable, m: &[S; 3]) -> (S, S) {
    match kind {
        Variable::Rotation => (m[1], m[2]),
        Variable::Translation => (m[1], S::zero()),
    }
}

impl OfBall<'_> {
    fn one<S: Scalar>(&self, reach: &Reach<S>, search: &mut Search<'_>, x: S) -> RootOutcome {
        let mut outcome = RootOutcome { settled: false, unresolved: false, shared: false, separation: 1.0 };
        let kind = reach.kind(self.side);
        let known = match kind {
            Variable::Rotation => match unshifted(x, self.offset) {
                Some((cos, sin)) => [S::one(), cos, sin],
                None => return outcome,
            },
            Variable::Translation => [S::one(), x, x.mul(&x)],
        };
        let others = match self.plan {
            Plan::Together { other, .. } => [Some(other.each_ref().map(|row| at(row, &known))), None],
            Plan::Apart { then, .. } => {
                outcome.shared = true;
                let mut row = then[1].map(S::from_f64);
                row[0] = row[0].sub(&at(&then[0], &known));
                zeros(reach.kind(1 - self.side), &row)
            }
        };
        for other in others.into_iter().flatten() {
            let monomials = if self.side == 0 { [&known, &other] } else { [&other, &known] };
            let Some(middle) = reach.middle(monomials) else {
                outcome.unresolved = true;
                continue;
            };
            let [near, far] = [0, 1].map(|side| pair(reach.kind(side), monomials[side]));
            let [first, second, third] = reach.variables;
            let values = [(first, far), (second, middle), (third, near)];
            outcome.settled |= search.admit_ball(self.ball, &values);
        }
        outcome
    }
}

impl Family for OfBall<'_> {
    fn real(&mut self, search: &mut Search<'_>, x: f64) -> RootOutcome {
        self.one(self.reach, search, x)
    }

    fn complex(&mut self, search: &mut Search<'_>, x: Complex<f64>) -> RootOutcome {
        let closed = search.closed;
        let reach = self.complex.take().unwrap_or_else(|| {
            let constants = closed.constants.each_ref().map(lifted::<Complex<f64>>);
            Reach::of(&ClosedLoop { variables: closed.variables, constants }, self.ball)
        });
        let outcome = self.one(&reach, search, x);
        self.complex = Some(reach);
        outcome
    }
}
