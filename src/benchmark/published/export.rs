//! Problems from samples whose list of solutions is proved complete.

use super::problem::{Axis, Body, Problem, Truth};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::assembly::{Assembly, Roots, Workspace};
use crate::benchmark::platform::sample::{self as of_platforms, PlatformSet};
use crate::benchmark::sample::{Set, matrix, sample};
use crate::catalogue::entry::{Case, Design, Entry, InputValue};
use crate::catalogue::{Options, load};
use crate::error::Result;
use crate::kinematics::chain::{Chain, JointKind, Placement};
use crate::kinematics::closed_loop::{Variable, angle_motion, distance_motion};
use crate::kinematics::joint::JointVariable;
use crate::kinematics::motion::Motion;
use crate::mechanism::{Mechanism, Solution};
use crate::verdict::Status;
use num_complex::Complex;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rug::Rational;
use std::f64::consts::PI;

/// The conversion of a sample to a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawn {
    /// The problem with its proved truth.
    Proved(Box<Problem>),
    /// The sample is left out: neither its list nor a self-motion is proved. This is the code of the verdict.
    LeftOut(&'static str),
}

/// Sample number `index` of a set of arms; its id begins with the name.
///
/// # Errors
/// As [`sample`].
pub fn of_arm(class: &str, name: &str, set: Set, seed: u64, index: u64) -> Result<Drawn> {
    let drawn = sample(set, seed, index)?;
    answered(class, format!("{name}-{seed}-{index}"), &drawn.entry)
}

/// Sample number `index` of a set of platforms; its id begins with the name.
///
/// # Errors
/// As [`of_platforms::sample`].
pub fn of_platform(class: &str, name: &str, set: PlatformSet, seed: u64, index: u64) -> Result<Drawn> {
    let drawn = of_platforms::sample(set, seed, index)?;
    answered(class, format!("{name}-{seed}-{index}"), &drawn.entry)
}

/// Returns a robot of the library at a pose reached with random angles; `None` unless it has six joint variables.
///
/// # Errors
/// None in practice: the library is tested.
pub fn of_robot(name: &str, seed: u64, index: u64) -> Result<Option<Drawn>> {
    let mut entry = load(name, &Options::default())?;
    let Design::Arm(chain) = &entry.design else { return Ok(None) };
    let Some((variables, _)) = chain.unknowns_and_constants::<f64>().filter(|(variables, _)| variables.len() == 6)
    else {
        return Ok(None);
    };
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    let motions = variables.iter().map(|variable| moved(*variable, random.random_range(-PI..PI))).collect::<Vec<_>>();
    let Some(pose) = chain.forward(&motions) else { return Ok(None) };
    let placement = Placement::from_matrix(&matrix(&pose))?.0;
    entry.cases = vec![Case::at(placement, 1)];
    answered("robots", format!("{name}-{seed}-{index}"), &entry).map(Some)
}

/// Returns a robot of the library at a pose reached with angles that are multiples of a right one, where many are singular; `None` unless it
/// has six rotations.
///
/// # Errors
/// None in practice: the library is tested.
pub fn of_singular_robot(name: &str, seed: u64, index: u64) -> Result<Option<Drawn>> {
    let mut entry = load(name, &Options::default())?;
    let Design::Arm(chain) = &entry.design else { return Ok(None) };
    if chain.joint_kinds() != [JointKind::Revolute; 6] {
        return Ok(None);
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    // Half-angle tangents of 0, 90, 180 and 270 degrees.
    let quarters = || [Some(0), Some(1), None, Some(-1)];
    let angle = |quarter: usize| {
        let tangent = quarters()[quarter].map_or(HalfTangent::Infinite, |t| HalfTangent::Finite(Rational::from(t)));
        InputValue::Angle(Angle::from_half_tangent(tangent))
    };
    let values: Vec<InputValue> = (0..6).map(|_| angle(random.random_range(0..4))).collect();
    let Some(case) = Case::reached(chain, &values, 1) else { return Ok(None) };
    entry.cases = vec![case];
    answered("singular-robots", format!("{name}-{seed}-{index}"), &entry).map(Some)
}

/// Returns the motion of a joint variable.
fn moved(variable: Variable, value: f64) -> Motion<f64> {
    match variable {
        Variable::Rotation => Motion::rotation_z(value.cos(), value.sin()),
        Variable::Translation => Motion::translation_z(value),
    }
}

fn answered(class: &str, id: String, entry: &Entry) -> Result<Drawn> {
    let mechanism = Mechanism::prepare(entry)?;
    let case = &entry.cases[0];
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let solution = mechanism.solve(case, Roots::All, &mut workspace, &mut assembly)?;
    let verdict = &solution.verdict;
    let is_list = matches!(verdict.status, Status::Complete | Status::Unreachable);
    let is_moving = verdict.status == Status::SelfMotion;
    if !verdict.proof.is_proved()
        || !(is_list || is_moving)
        || is_list && solution.modes.iter().any(|mode| mode.real && mode.multiplicity == 0)
    {
        return Ok(Drawn::LeftOut(verdict.code.word()));
    }
    let body = match &entry.design {
        Design::Platform(_) => platform(entry, case),
        Design::Arm(chain) | Design::Loop(chain) => of_chain(chain, case),
    };
    Ok(body.map_or(Drawn::LeftOut("unsupported"), |(body, given)| {
        // Isolated solutions beside a self-motion are not proved to be all.
        let (truth, complex) = if is_moving { (Vec::new(), 0) } else { (truths(&solution, given), verdict.complex) };
        let self_motion = if is_moving { verdict.self_motion } else { 0 };
        Drawn::Proved(Box::new(Problem { id, class: class.to_owned(), body, truth, complex, self_motion }))
    }))
}

/// Returns the real solutions without the given joint variable.
fn truths(solution: &Solution, given: Option<usize>) -> Vec<Truth> {
    let real = solution.modes.iter().filter(|mode| mode.real && !mode.near);
    let unknowns =
        |q: &[Complex<f64>]| q.iter().enumerate().filter(|(k, _)| Some(*k) != given).map(|(_, x)| x.re).collect();
    let truth =
        real.map(|mode| Truth { q: unknowns(&mode.q), multiplicity: mode.multiplicity, condition: mode.condition });
    truth.collect()
}

fn platform(entry: &Entry, case: &Case) -> Option<(Body, Option<usize>)> {
    let Design::Platform(platform) = &entry.design else { return None };
    let floats = |points: &[[Number; 3]; 6]| points.each_ref().map(|point| point.each_ref().map(Number::to_f64));
    let legs = case.legs_squared.as_ref()?.each_ref().map(|square| square.to_f64().sqrt());
    Some((Body::Platform { base: floats(&platform.base), plate: floats(&platform.plate), legs }, None))
}

/// Returns the axes of a chain at joint variables 0, and the index of the given variable of a loop.
fn of_chain(chain: &Chain, case: &Case) -> Option<(Body, Option<usize>)> {
    let (mut variables, mut constants) = chain.unknowns_and_constants::<f64>()?;
    let mut named = JointVariable::of(&chain.joint_kinds());
    let mut given = None;
    if let Some(input) = case.input.first() {
        let is_given =
            |v: &JointVariable| v.joint == input.joint && v.variable == input.value.variable() && v.turn == 0;
        let at = named.iter().position(is_given)?;
        let held = match &input.value {
            InputValue::Angle(angle) => angle_motion::<f64>(angle)?,
            InputValue::Distance(distance) => distance_motion(distance)?,
        };
        let behind = constants.remove(at + 1);
        constants[at] = constants[at].then_after(&held).then_after(&behind);
        variables.remove(at);
        named.remove(at);
        given = Some(at);
    }
    let mut here = constants[0].clone();
    let mut axes = Vec::new();
    for (variable, behind) in variables.iter().zip(&constants[1..]) {
        let direction = here.rotation.map(|row| row[2]);
        axes.push(Axis { variable: *variable, direction, point: here.translation });
        here = here.then_after(behind);
    }
    let is_first = |(_, v): &(usize, &JointVariable)| v.kind == JointKind::Spherical && v.turn == 1;
    let spherical = named.iter().enumerate().filter(is_first).map(|(at, _)| at).collect();
    let pose = case.pose.as_ref().map_or_else(Motion::identity, |pose| pose.float.clone());
    Some((Body::Chain { axes, home: here, pose, spherical }, given))
}
