//! The instantaneous motion of a body in space or about a point: JSON and text.

use super::calculus::write_values;
use super::json::number;
use super::{json, space, sphere};
use crate::algebra::number::nearest_f64;
use crate::algebra::series::Series;
use crate::catalogue::entry::{Case, Entry};
use crate::catalogue::{SpaceCase, SpaceFile, SphereCase, SphereFile};
use crate::displacement::answer::list;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::linkage::loads::{Load, SpaceLoad};
use crate::linkage::space::{SpaceAnswer, rates as rates_in_space};
use crate::linkage::sphere::{SphereAnswer, rates};
use crate::mechanism::{Derivatives, Moving, MovingChain, Solution, relative};
use crate::report::text::View;
use crate::sweep::sphere_place;
use looproot_calculus::displacement::velocity::State;
use serde_json::{Map, Value, json};

/// What is requested of a linkage: the motion of a body, with one point of it alone where that is asked for, the balance of loads,
/// or both.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The body.
    pub body: Option<(Pair, Option<&'a str>)>,
    /// The loads, where balance is requested.
    pub loads: Option<&'a [SpaceLoad]>,
}

impl Asked<'_> {
    /// Adds what is requested to a mode; `motion` writes the motion of the body.
    fn insert(
        &self,
        shown: &mut Value,
        bodies: Option<&[Moving]>,
        motion: impl FnOnce(Pair, Option<&str>) -> Option<Map<String, Value>>,
    ) {
        if let Some((pair, point)) = self.body {
            shown["instant"] = motion(pair, point).map_or(Value::Null, Value::Object);
        }
        if let Some(loads) = self.loads {
            shown["balance"] =
                bodies.map_or(Value::Null, |bodies| json!({ "holding": number(holding(loads, bodies)) }));
        }
    }
}

/// The drive at the first input that holds the loads: it takes the power that they have where that input runs at unit rate.
fn holding(loads: &[SpaceLoad], bodies: &[Moving]) -> f64 {
    let power = |load: &SpaceLoad| match load {
        Load::Force { body, at, force } => {
            let place = bodies[*body].apply(&at.map(Series::constant));
            dot(force, &place.each_ref().map(|c| c.coefficients[1]))
        }
        Load::Moment { body, moment } => dot(moment, &State::of(&bodies[*body]).omega),
    };
    -loads.iter().map(power).sum::<f64>() + 0.0
}

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
        axodes.map_or(
            Value::Null,
            |found| json!({ "striction": list(&found.striction), "distribution": number(found.distribution) }),
        ),
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

/// Returns the answer to a case of a linkage on the sphere: all real assemblies with what is requested. Points lie as far away as the
/// file says.
#[must_use]
pub fn of_sphere(
    file: &SphereFile,
    (number, case): (usize, &SphereCase),
    answer: &SphereAnswer,
    asked: Asked<'_>,
) -> Value {
    let mut result = sphere::result(file, case, number, answer, false);
    let linkage = &file.linkage;
    let real = answer.modes.iter().filter(|mode| mode.real);
    if let Some(modes) = result["modes"].as_array_mut() {
        for (shown, mode) in modes.iter_mut().zip(real) {
            let found = rates(linkage, &case.given, mode);
            asked.insert(shown, found.as_ref().map(|found| found.bodies.as_slice()), |pair, point| {
                let found = found.as_ref()?;
                let state = relative(&found.bodies[pair.body], &found.bodies[pair.against]);
                let names = [pair.body, pair.against].map(|body| linkage.bodies[body].name.as_str());
                let mut object = values(names, &state, &found.bodies);
                let state = rounded(&state, &found.bodies);
                let own = &linkage.bodies[pair.body].points;
                let points = own.iter().filter(|(name, _)| point.is_none_or(|asked| asked == name));
                let points = points.map(|(name, at)| (name.clone(), path(&state, &sphere_place(mode, pair.body, at))));
                object.insert("points".into(), Value::Object(points.collect()));
                let joints = linkage.joints.iter().zip(&found.joints);
                let joints = joints.map(|(joint, rates)| (joint.name.clone(), list(rates)));
                object.insert("joint_rates".into(), Value::Object(joints.collect()));
                Some(object)
            });
        }
    }
    result
}

/// Returns the answer to a case of a linkage in space: all real assemblies with what is requested.
#[must_use]
pub fn of_space(
    file: &SpaceFile,
    (number, case): (usize, &SpaceCase),
    answer: &SpaceAnswer,
    asked: Asked<'_>,
) -> Value {
    let mut result = space::result(file, case, number, answer, false);
    let linkage = &file.linkage;
    let real = answer.modes.iter().filter(|mode| mode.real);
    if let Some(modes) = result["modes"].as_array_mut() {
        for (shown, mode) in modes.iter_mut().zip(real) {
            let found = rates_in_space(linkage, &case.given, mode);
            asked.insert(shown, found.as_ref().map(|found| found.bodies.as_slice()), |pair, point| {
                let found = found.as_ref()?;
                let state = relative(&found.bodies[pair.body], &found.bodies[pair.against]);
                let state = rounded(&state, &found.bodies);
                let names = [pair.body, pair.against].map(|body| linkage.bodies[body].name.as_str());
                let mut object = values(names, &state, &found.bodies);
                let place = mode.bodies[pair.body].map(|z| Some(z.re));
                let wanted = |name: &str| point.is_none_or(|asked| asked == name);
                let points = linkage.bodies[pair.body].points.iter().filter(|(name, _)| wanted(name));
                let points = points.filter_map(|(name, at)| {
                    Some((name.clone(), path(&state, &place.as_ref()?.apply(&at.each_ref().map(nearest_f64)))))
                });
                object.insert("points".into(), Value::Object(points.collect()));
                let joints = linkage.joints.iter().zip(cleaned(&found.joints));
                let joints = joints.filter_map(|(joint, rates)| Some((joint.name.clone(), list(&rates?))));
                object.insert("joint_rates".into(), Value::Object(joints.collect()));
                Some(object)
            });
        }
    }
    result
}

/// The rates and accelerations of joints, where rounding beside the largest of each is 0.
fn cleaned(joints: &[Option<[f64; 2]>]) -> Vec<Option<[f64; 2]>> {
    let largest = |part: usize| joints.iter().flatten().map(|rates| rates[part].abs()).fold(0.0, f64::max);
    let rate = largest(0);
    let scale = [rate, largest(1).max(rate * rate)];
    let clean = |rates: [f64; 2]| [0, 1].map(|k| if rates[k].abs() <= ROUNDED * scale[k] { 0.0 } else { rates[k] });
    joints.iter().map(|rates| rates.map(clean)).collect()
}

/// Returns velocity and acceleration of a point of a body where it stands, and the curvature of its path; null where the point rests.
fn path(state: &State<f64>, position: &Vector<f64>) -> Value {
    let (velocity, acceleration) = (state.velocity_at(position), state.acceleration_at(position));
    let bend = cross(&velocity, &acceleration);
    let speed = dot(&velocity, &velocity).sqrt();
    let curvature = dot(&bend, &bend).sqrt() / speed.powi(3);
    json!({
        "position": list(position),
        "velocity": list(&velocity),
        "acceleration": list(&acceleration),
        "curvature": if speed > 0.0 { number(curvature) } else { Value::Null },
    })
}

/// A result for a reader, behind its verdict.
#[must_use]
pub fn text(title: &str, verdict: &str, result: &Value) -> String {
    let mut text = format!("{title}, case {}\n{verdict}\n", result["case"]);
    for mode in result["modes"].as_array().into_iter().flatten() {
        text += &format!("\nmode {}\n", mode["id"]);
        for key in ["instant", "balance"] {
            match mode.get(key) {
                Some(Value::Object(fields)) => write_values(&mut text, fields),
                Some(_) => text += "  singular: the input does not determine rates\n",
                None => {}
            }
        }
    }
    text
}
