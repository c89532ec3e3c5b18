//! Answers as flat numbers.

use crate::fault::{LrStatus, say};
use looproot::internal::face::Matrix;
use looproot::internal::mechanism::{FullMode, Solution};
use looproot::internal::verdict::{Proof, Status};

/// The kind of proof of an answer.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LrProof {
    /// Nothing but measurement.
    None = 0,
    /// A theorem whose assumptions were checked.
    Proved = 1,
    /// A count modulo primes that were drawn.
    Probable = 2,
    /// A theorem about the rounded numbers only.
    RoundedData = 3,
}

/// The verdict in one word.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LrAnswer {
    /// Every solution is listed.
    Complete = 0,
    /// Something may be missing.
    Incomplete = 1,
    /// No solution is real.
    Unreachable = 2,
    /// The solutions form a curve or more.
    SelfMotion = 3,
    /// Beyond what is implemented.
    Unsupported = 4,
}

/// The verdict on a list.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LrVerdict {
    /// The outcome.
    pub answer: LrAnswer,
    /// Its proof.
    pub proof: LrProof,
    /// Isolated real solutions, with multiplicity.
    pub real: usize,
    /// Isolated complex solutions that were found, with multiplicity, the real ones among them.
    pub complex: usize,
    /// The dimension of the self-motion, 0 if there is none.
    pub self_motion: usize,
}

/// One solution.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LrMode {
    /// An error bound of every joint value, radians and metres; infinite where it is not certified.
    pub radius: f64,
    /// The condition number of the Jacobian.
    pub condition: f64,
    /// 1 where it is proved that exactly one solution lies within the radius, else 0.
    pub certified: u8,
    /// 1 where it reaches the pose within the tolerance of 1e-9 only, else 0.
    pub near: u8,
    /// 1 within the joint limits, 0 beyond them, -1 where there are none.
    pub within_limits: i8,
}

/// The verdict of a solution.
pub fn verdict(solution: &Solution) -> LrVerdict {
    let verdict = &solution.verdict;
    LrVerdict {
        answer: match verdict.status {
            Status::Complete => LrAnswer::Complete,
            Status::Incomplete => LrAnswer::Incomplete,
            Status::Unreachable => LrAnswer::Unreachable,
            Status::SelfMotion => LrAnswer::SelfMotion,
            Status::Unsupported => LrAnswer::Unsupported,
        },
        proof: match verdict.proof {
            Proof::Proved => LrProof::Proved,
            Proof::Probable { .. } => LrProof::Probable,
            Proof::RoundedData => LrProof::RoundedData,
            Proof::None => LrProof::None,
        },
        real: verdict.real,
        complex: verdict.complex,
        self_motion: verdict.self_motion,
    }
}

/// The status of an answer, as the exit code of the command line.
pub fn status(solution: &Solution) -> LrStatus {
    let is_proved = solution.verdict.proof.is_proved();
    match solution.verdict.status {
        Status::Complete if is_proved => LrStatus::Ok,
        Status::Unreachable if is_proved => LrStatus::Unreachable,
        Status::Unsupported => LrStatus::Unsupported,
        Status::Complete | Status::Unreachable | Status::Incomplete | Status::SelfMotion => LrStatus::NotProved,
    }
}

fn mode(mode: &FullMode) -> LrMode {
    LrMode {
        radius: mode.radius,
        condition: mode.condition,
        certified: u8::from(mode.certified),
        near: u8::from(mode.near),
        within_limits: mode.within_limits.map_or(-1, i8::from),
    }
}

/// The place where an answer is written. Parts that are not requested are empty.
pub struct Place<'a> {
    /// Rows of joint values, or matrices.
    pub rows: &'a mut [f64],
    /// The number of rows that fit.
    pub capacity: usize,
    pub modes: Option<&'a mut [LrMode]>,
    pub count: &'a mut usize,
    pub verdict: Option<&'a mut LrVerdict>,
}

/// Writes the real solutions, each as a row.
pub fn write(solution: &Solution, place: Place<'_>, row: impl Fn(&FullMode) -> Vec<f64>) -> LrStatus {
    let real: Vec<&FullMode> = solution.modes.iter().filter(|mode| mode.real).collect();
    *place.count = real.len();
    if let Some(verdict) = place.verdict {
        *verdict = self::verdict(solution);
    }
    let fitting = real.len().min(place.capacity);
    let width = place.rows.len().checked_div(place.capacity).unwrap_or(0);
    for (k, one) in real.iter().take(fitting).enumerate() {
        let values = row(one);
        for (to, value) in place.rows[k * width..].iter_mut().take(width).zip(values) {
            *to = value;
        }
    }
    for (to, one) in place.modes.into_iter().flatten().zip(&real) {
        *to = mode(one);
    }
    say(&solution.verdict.reason);
    if fitting < real.len() { LrStatus::Truncated } else { status(solution) }
}

/// The joint values of a real solution.
pub fn joint_values(mode: &FullMode) -> Vec<f64> {
    mode.q.iter().map(|value| value.re).collect()
}

/// The pose of the plate of a platform: its solution is a unit quaternion and a position.
pub fn plate(mode: &FullMode) -> Vec<f64> {
    let value = |k: usize| mode.q.get(k).map_or(0.0, |value| value.re);
    let [w, x, y, z] = [value(0), value(1), value(2), value(3)];
    let matrix: Matrix = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y), value(4)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x), value(5)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y), value(6)],
        [0.0, 0.0, 0.0, 1.0],
    ];
    matrix.as_flattened().to_vec()
}
