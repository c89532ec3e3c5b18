//! The instantaneous motion of a body in space or about a point: JSON and text.

use super::calculus::write_values;
use super::json::number;
use super::{json, sphere};
use crate::catalogue::entry::{Case, Entry};
use crate::catalogue::{SphereCase, SphereFile};
use crate::displacement::answer::list;
use crate::kinematics::motion::{Vector, dot};
use crate::linkage::sphere::{SphereAnswer, rates};
use crate::mechanism::{Derivatives, Moving, MovingChain, Solution, relative};
use crate::report::text::View;
use looproot_calculus::displacement::velocity::State;
use serde_json::{Map, Value, json};

/// A number below this share of those that it is made of stands for 0.
const ROUNDED: f64 = 1e-12;

/// The body that is requested and its reference body.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The body.
    pub body: usize,
    /// The body that is held to stand still.
    pub against: usize,
}

/// Returns the motion of a body: angular velocity and acceleration, velocity and acceleration of its point at the origin, velocity
/// screw, acceleration pole and axodes, in axes of the ground.
///
/// `all` are the motions of all bodies: numbers that are rounding beside theirs are 0.
#[must_use]
pub fn values([body, against]: [&str; 2], state: &State<f64>, all: &[Moving]) -> Map<String, Value> {
    let state = rounded(state, all);
    let mut object = Map::new();
    let mut put = |key: &str, value: Value| object.insert(key.to_owned(), value);
    put("body", json!(body));
    put("against", json!(against));
    put("angular_velocity", list(&state.omega));
    put("velocity", list(&state.velocity));
    put("angular_acceleration", list(&state.alpha));
    put("acceleration", list(&state.acceleration));
    let screw = state.screw().and_then(|screw| Some((screw.axis.point()?, screw)));
    let rate = dot(&state.omega, &state.omega).sqrt();
    put(
        "screw",
        screw.map_or(Value::Null, |(point, screw)| {
            let direction = screw.axis.direction.map(|c| c / rate);
            json!({ "direction": list(&direction), "point": list(&point), "pitch": number(screw.pitch), "rate": number(rate) })
        }),
    );
    let pole = state.acceleration_pole();
    put("acceleration_pole", pole.map_or(Value::Null, |pole| list(&pole)));
    let axodes = state.axodes();
    put(
        "axodes",
        axodes.map_or(Value::Null, |found| {
            json!({ "striction": list(&found.striction), "distribution": number(found.distribution) })
        }),
    );
    object
}

/// Returns the motion with 0 for components that are rounding beside those of the bodies.
pub(super) fn rounded(state: &State<f64>, all: &[Moving]) -> State<f64> {
    let states: Vec<State<f64>> = all.iter().map(State::of).collect();
    let largest = |of: fn(&State<f64>) -> &Vector<f64>| {
        states.iter().map(|state| dot(of(state), of(state)).sqrt()).fold(0.0, f64::max)
    };
    let (rate, speed) = (largest(|s| &s.omega), largest(|s| &s.velocity));
    let clean = |v: &Vector<f64>, by: f64| v.map(|c| if c.abs() <= ROUNDED * by { 0.0 } else { c });
    State {
        omega: clean(&state.omega, rate),
        velocity: clean(&state.velocity, speed),
        alpha: clean(&state.alpha, largest(|s| &s.alpha).max(rate * rate)),
        acceleration: clean(&state.acceleration, largest(|s| &s.acceleration).max(rate * speed)),
    }
}

/// Returns the name of a body of a chain: the base is 0, and every other body has the number of the joint before it.
pub(super) fn chain_name(body: usize) -> String {
    if body == 0 { "base".to_owned() } else { format!("link {body}") }
}

/// Returns the answer to a case of a loop or an arm: all real modes with `instant`. `motions` has the velocities of every mode.
#[must_use]
pub fn of_chain(
    entry: &Entry,
    (number, case): (usize, &Case),
    solution: &Solution,
    motions: &[Option<Derivatives>],
    pair: Pair,
) -> Value {
    let view = View { complex: false, drop_outside_limits: false, quiet: false, colour: false };
    let mut result = json::result(number, case, solution, &super::document::labels(entry), &view);
    let real = solution.modes.iter().zip(motions).filter(|(mode, _)| view.shows(mode));
    if let (Some(modes), Some(chain)) = (result["modes"].as_array_mut(), entry.chain()) {
        for (shown, (mode, motion)) in modes.iter_mut().zip(real) {
            let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
            let bodies = motion.as_ref().and_then(|m| MovingChain::of(chain, &q, &m.velocity, &m.acceleration));
            let names = [chain_name(pair.body), chain_name(pair.against)];
            let names = [names[0].as_str(), names[1].as_str()];
            let found = bodies.and_then(|all| Some(values(names, &all.state(pair.body, pair.against)?, all.bodies())));
            shown["instant"] = found.map_or(Value::Null, Value::Object);
        }
    }
    result
}

/// Returns the answer to a case of a linkage on the sphere: all real assemblies with `instant`.
#[must_use]
pub fn of_sphere(file: &SphereFile, case: &SphereCase, number: usize, answer: &SphereAnswer, pair: Pair) -> Value {
    let mut result = sphere::result(file, case, number, answer, false);
    let linkage = &file.linkage;
    let real = answer.modes.iter().filter(|mode| mode.real);
    if let Some(modes) = result["modes"].as_array_mut() {
        for (shown, mode) in modes.iter_mut().zip(real) {
            let found = rates(linkage, &case.given, mode);
            shown["instant"] = found.map_or(Value::Null, |found| {
                let state = relative(&found.bodies[pair.body], &found.bodies[pair.against]);
                let names = [pair.body, pair.against].map(|body| linkage.bodies[body].name.as_str());
                let mut object = values(names, &state, &found.bodies);
                let joints = linkage.joints.iter().zip(&found.joints);
                let joints = joints.map(|(joint, rates)| (joint.name.clone(), list(rates)));
                object.insert("joint_rates".into(), Value::Object(joints.collect()));
                Value::Object(object)
            });
        }
    }
    result
}

/// A result for a reader, behind its verdict.
#[must_use]
pub fn text(title: &str, verdict: &str, result: &Value) -> String {
    let mut text = format!("{title}, case {}\n{verdict}\n", result["case"]);
    for mode in result["modes"].as_array().into_iter().flatten() {
        text += &format!("\nmode {}\n", mode["id"]);
        match mode["instant"].as_object() {
            Some(fields) => write_values(&mut text, fields),
            None => text += "  singular: the input does not determine rates\n",
        }
    }
    text
}
