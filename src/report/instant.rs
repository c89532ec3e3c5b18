//! The instantaneous motion of the bodies of a linkage: JSON and text.

use super::calculus::write_values;
use super::dynamics::reactions;
use super::json::number;
use super::linkage;
use crate::algebra::ring::Ring;
use crate::catalogue::{LinkageCase, LinkageFile};
use crate::displacement::answer::list;
use crate::kinematics::linkage::Linkage;
use crate::linkage::answer::{LinkageAnswer, LinkageMode};
use crate::linkage::instant::{Relative, against, derivatives, pole, relative};
use crate::linkage::loads::{PlaneLoad, balance};
use crate::linkage::rates::{Body, Moving, freedoms, joint_value, moving, pair, resting};
use looproot_calculus::instant::plane::{Instant, curvature};
use num_complex::Complex;
use serde_json::{Map, Value, json};

/// What is requested: the motion of a body, the balance of loads, or both.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The body.
    pub body: Option<AskedBody<'a>>,
    /// The loads, where balance is requested.
    pub loads: Option<&'a [PlaneLoad]>,
}

/// The body that is requested, its reference body, and its points.
#[derive(Clone, Copy, Debug)]
pub struct AskedBody<'a> {
    /// The body.
    pub body: usize,
    /// The body that is held to stand still.
    pub against: usize,
    /// One point alone.
    pub point: Option<&'a str>,
    /// Whether the frame is seen from the body instead.
    pub inverse: bool,
}

/// The answer to a case: all real assemblies with their joints, bodies and `instant`.
#[must_use]
pub fn result(
    file: &LinkageFile,
    case: &LinkageCase,
    index: usize,
    answer: &LinkageAnswer,
    asked: &Asked<'_>,
) -> Value {
    let mut result = linkage::result(file, case, index, answer, false);
    let real: Vec<&LinkageMode> = answer.modes.iter().filter(|mode| mode.real).collect();
    if let Some(modes) = result.get_mut("modes").and_then(Value::as_array_mut) {
        for (shown, mode) in modes.iter_mut().zip(real) {
            if let (Value::Object(fields), Some(body)) = (&mut *shown, &asked.body) {
                fields.insert("instant".into(), instant(&file.linkage, case, mode, body));
            }
            if let (Value::Object(fields), Some(loads)) = (shown, asked.loads) {
                fields.insert("balance".into(), balance_json(&file.linkage, case, mode, loads));
            }
        }
    }
    result
}

/// Returns the instantaneous motion of an assembly where the first input runs at unit rate and the others stand.
fn instant(linkage: &Linkage, case: &LinkageCase, mode: &LinkageMode, asked: &AskedBody<'_>) -> Value {
    let mut runs = vec![Moving::zero(); freedoms(&case.given)];
    if let Some(first) = runs.first_mut() {
        first.coefficients[1] = 1.0;
    }
    let rest = resting(mode);
    // At a limit position of the input the rates are infinite.
    let Some(bodies) = moving(linkage, &case.given, &rest, &runs) else { return Value::Null };
    let (body, base) = if asked.inverse { (asked.against, asked.body) } else { (asked.body, asked.against) };
    let mut object = Map::new();
    object.insert("body".into(), json!(linkage.bodies[body].name));
    object.insert("against".into(), json!(linkage.bodies[base].name));
    let own = against(&bodies[body], &bodies[base]);
    let [omega, alpha] = derivatives(&own.angle);
    object.insert("rate".into(), number(omega));
    object.insert("acceleration".into(), number(alpha));
    let found = relative(&own);
    if let Some(found) = &found {
        put_instant(&mut object, found);
    } else {
        for key in ["pole", "inflection_pole", "inflection_diameter", "a2", "a3", "ball", "acceleration_pole"] {
            object.insert(key.into(), Value::Null);
        }
    }
    let points = linkage.bodies[body].points.iter().filter(|(name, _)| asked.point.is_none_or(|asked| asked == name));
    let points = points.map(|(name, at)| (name.clone(), point(&own.place(pair(at)), found.as_ref())));
    object.insert("points".into(), Value::Object(points.collect()));
    object.insert("poles".into(), poles(linkage, &bodies));
    let rates = linkage.joints.iter().enumerate().filter_map(|(k, joint)| {
        let [rate, acceleration] = derivatives(&joint_value(linkage, &bodies, k)?);
        Some((joint.name.clone(), json!([number(rate), number(acceleration)])))
    });
    object.insert("joint_rates".into(), Value::Object(rates.collect()));
    Value::Object(object)
}

fn complex(z: &Complex<f64>) -> Value {
    list(&[z.re, z.im])
}

/// Pole, inflection circle, circle without tangential acceleration, centrodes, stationary curvature.
fn put_instant(object: &mut Map<String, Value>, found: &Relative) {
    let Relative { instant, omega, alpha } = found;
    let optional = |z: Option<Complex<f64>>| z.map_or(Value::Null, |z| complex(&z));
    let mut put = |key: &str, value: Value| object.insert(key.to_owned(), value);
    put("pole", complex(&instant.pole));
    put("inflection_pole", complex(&instant.inflection_pole()));
    put("inflection_diameter", instant.inflection_diameter().map_or(Value::Null, number));
    put("a2", complex(&instant.second));
    put("a3", complex(&instant.third));
    put("normal_poles", instant.normal_poles().iter().map(complex).collect());
    put("ball", optional(instant.ball_point()));
    put("acceleration_pole", optional(instant.acceleration_pole(omega, alpha)));
    put("tangential_pole", optional(instant.tangential_pole(omega, alpha)));
    let velocity = Complex::new(0.0, *omega) * instant.second;
    put("pole_velocity", complex(&velocity));
    let centrodes = instant.centrode_curvatures();
    put(
        "centrodes",
        centrodes.map_or(Value::Null, |[fixed, moving]| json!({ "fixed": number(fixed), "moving": number(moving) })),
    );
    // A length beyond this is infinite: the cubic falls apart into a circle and a line.
    let largest = 1e12 * instant.inflection_diameter().unwrap_or(0.0);
    let length = |x: f64| if x.abs() < largest { number(x) } else { Value::Null };
    let cubic = instant.cubic().map_or(Value::Null, |[m, n]| json!({ "m": length(m), "n": length(n) }));
    put("cubic", cubic);
}

/// Place, velocity and acceleration of a point by time, its centre of curvature, and what says whether its curvature is stationary.
fn point(place: &[Moving; 2], found: Option<&Relative>) -> Value {
    let part =
        |k: usize, factor: f64| Complex::new(place[0].coefficients[k] * factor, place[1].coefficients[k] * factor);
    let (at, velocity, acceleration) = (part(0, 1.0), part(1, 1.0), part(2, 2.0));
    let centre = found.and_then(|found| found.instant.centre(&at)).map_or(Value::Null, |z| complex(&z));
    let stationary = found.map_or(Value::Null, |found| number(stationary(&found.instant, &at)));
    json!({
        "position": complex(&at),
        "velocity": complex(&velocity),
        "acceleration": complex(&acceleration),
        "curvature": curvature(&velocity, &acceleration).map_or(Value::Null, number),
        "centre": centre,
        "stationary": stationary,
    })
}

/// The form of the cubic of stationary curvature; rounding beside the size of its terms is 0.
fn stationary(instant: &Instant<f64>, at: &Complex<f64>) -> f64 {
    let value = instant.stationary(at);
    let distance = (at - instant.pole).norm();
    let size = distance.powi(3) * (instant.third.norm() + instant.second.norm());
    if value.abs() <= 1e-12 * size { 0.0 } else { value }
}

/// The drives that hold the loads, and the forces in the joints.
fn balance_json(linkage: &Linkage, case: &LinkageCase, mode: &LinkageMode, loads: &[PlaneLoad]) -> Value {
    let Some(found) = balance(linkage, &case.given, &resting(mode), loads) else { return Value::Null };
    let holding = match found.holding.as_slice() {
        [one] => number(*one),
        several => list(several),
    };
    json!({
        "holding": holding,
        "joints": found.joints.map_or(Value::Null, |joints| reactions(linkage, &joints)),
    })
}

/// The poles of every two bodies, in axes of the ground.
fn poles(linkage: &Linkage, bodies: &[Body]) -> Value {
    let mut object = Map::new();
    for first in 0..bodies.len() {
        for second in first + 1..bodies.len() {
            let name = format!("{} {}", linkage.bodies[first].name, linkage.bodies[second].name);
            object.insert(name, pole(&bodies[second], &bodies[first]).map_or(Value::Null, |z| list(&z)));
        }
    }
    Value::Object(object)
}

/// A result for a reader.
#[must_use]
pub fn text(file: &LinkageFile, answer: &LinkageAnswer, result: &Value) -> String {
    let mut text = format!("{}, case {}\n{}\n", file.heading.title, result["case"], linkage::headline(&answer.verdict));
    for mode in result["modes"].as_array().into_iter().flatten() {
        text += &format!("\nmode {}\n", mode["id"]);
        for key in ["instant", "balance"] {
            match mode.get(key) {
                Some(Value::Object(fields)) => write_values(&mut text, fields),
                Some(_) => text += "  a limit position of the input: rates are not determined\n",
                None => {}
            }
        }
    }
    text
}
