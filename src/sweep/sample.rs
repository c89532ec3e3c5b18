//! The real modes at one input.

use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::assembly::{Assembly, Roots, Workspace, wrapped};
use crate::catalogue::entry::{Case, Input, InputValue};
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{FullMode, InputCurve, Mechanism};
use crate::solve::curve::{INPUT, Point};
use crate::verdict::Status;
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::PI;

/// Closure residuals up to this are rounding.
const CLOSED: f64 = 1e-13;
/// Condition numbers up to this are those of simple modes, also where no proof says so.
const REGULAR: f64 = 1e8;
/// Two modes closer than this are at a limit position for all that f64 can tell: Newton's method finds a double root to the square root of
/// its precision, 1e-8, and a step from one mode must not end on the other.
const APART: f64 = 1e-6;

/// The result at one input.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The input: radians, not reduced modulo 2 pi, or a length.
    pub input: f64,
    /// Is the list of modes complete.
    pub status: Status,
    /// Why, or why not.
    pub reason: String,
    /// The real modes: joint variables in joint order.
    pub modes: Vec<Vec<f64>>,
    /// Whether every real mode is simple and the list contains only isolated modes: branches can be followed from here.
    pub(super) is_regular: bool,
    /// The modes as points of the curve.
    pub(super) points: Vec<Point>,
    /// The complex modes, one of each conjugate pair.
    pub(super) pairs: Vec<Pair>,
}

/// Two conjugate complex modes as the curve sees them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Their real part.
    pub centre: Point,
    /// The sum of the squares of their imaginary parts.
    pub spread: f64,
}

impl Sample {
    /// Whether the list of modes is proved complete.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        matches!(self.status, Status::Complete | Status::Unreachable)
    }
}

/// The case of a loop with this joint at this value.
#[must_use]
pub fn case(joint: usize, variable: Variable, input: f64) -> Case {
    let value = match variable {
        Variable::Rotation => InputValue::Angle(angle(input)),
        Variable::Translation => InputValue::Distance(Number::from_f64(input)),
    };
    Case::given(Input { joint, value }, 0)
}

/// The angle that a float stands for: that of its half tangent in f64, so that a loop of rational numbers is one at every input, and
/// the equations over the rationals decide where f64 does not (far out, two branches that leave for infinity seem to be one
/// curve). A whole number of half turns is exact, for an overconstrained loop may close there in another way than at all neighbours.
fn angle(radians: f64) -> Angle {
    let half_turns = (radians / PI).round();
    let is_exact = half_turns * PI == radians;
    let is_odd = half_turns.rem_euclid(2.0) == 1.0;
    Angle::from_half_tangent(match Rational::from_f64((radians / 2.0).tan()) {
        _ if is_exact && is_odd => HalfTangent::Infinite,
        _ if is_exact => HalfTangent::Finite(Rational::new()),
        Some(half_tangent) => HalfTangent::Finite(half_tangent),
        None => return Angle::from_radians(radians),
    })
}

/// A loop being swept: prepared once.
pub(super) struct Swept<'a> {
    pub mechanism: &'a Mechanism,
    pub curve: &'a InputCurve,
    pub joint: usize,
    pub variable: Variable,
    /// Whether it has fewer than seven variables.
    pub is_overconstrained: bool,
}

impl Swept<'_> {
    /// Solves the loop at one input.
    pub(super) fn sample(&self, input: f64, memory: &mut (Workspace, Assembly)) -> Result<Sample> {
        let case = case(self.joint, self.variable, input);
        let solution = self.mechanism.sample(&case, Roots::All, &mut memory.0, &mut memory.1)?;
        let real = || solution.modes.iter().filter(|mode| mode.real);
        // An empty list without a proof says nothing.
        let is_known = solution.verdict.status != Status::Incomplete || !solution.modes.is_empty();
        // An overconstrained loop of rounded numbers closes to rounding, and has no certified modes.
        let closes = |mode: &FullMode| self.is_overconstrained && mode.residual <= CLOSED && mode.condition <= REGULAR;
        let is_simple = is_known
            && solution.verdict.status != Status::SelfMotion
            && real().all(|mode| mode.multiplicity == 1 && (mode.certified || closes(mode)));
        let mut modes: Vec<Vec<f64>> = real().map(|mode| mode.q.iter().map(|z| z.re).collect()).collect();
        for mode in &mut modes {
            // The input as requested, not modulo a full turn.
            mode[self.curve.input()] = input;
        }
        let unit = self.curve.unit(INPUT);
        let here = |mut point: Point| {
            point[INPUT] = input / unit;
            point
        };
        let points: Vec<Point> = modes.iter().map(|q| here(self.curve.point(q))).collect();
        let is_regular = is_simple && are_apart(self.curve.kinds(), &points);
        let pair = |q: &Vec<Complex<f64>>| {
            let upper = q.iter().map(|z| z.im).find(|im| *im != 0.0).is_some_and(|im| im > 0.0);
            let part = |of: fn(&Complex<f64>) -> f64| q.iter().map(of).collect::<Vec<f64>>();
            let [re, im] = [part(|z| z.re), part(|z| z.im)].map(|q| self.curve.without_spherical_joints(&q));
            let spread = im[..INPUT].iter().map(|im| im * im).sum();
            upper.then(|| Pair { centre: here(re), spread })
        };
        let pairs = solution.modes.iter().filter(|mode| !mode.real).filter_map(|mode| pair(&mode.q)).collect();
        let (status, reason) = (solution.verdict.status, solution.verdict.reason);
        Ok(Sample { input, status, reason, modes, is_regular, points, pairs })
    }
}

/// Whether no two points are one for f64.
fn are_apart(kinds: &[Variable; 7], points: &[Point]) -> bool {
    let difference = |k: usize, x: f64| if kinds[k] == Variable::Rotation { wrapped(x) } else { x };
    let is_apart = |p: &Point, q: &Point| (0..kinds.len()).any(|k| difference(k, p[k] - q[k]).abs() > APART);
    points.iter().enumerate().all(|(k, p)| points[..k].iter().all(|q| is_apart(p, q)))
}
