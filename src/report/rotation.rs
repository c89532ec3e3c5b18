//! A rotation or a displacement in every parametrisation, with every branch.

use super::calculus::write_values;
use crate::algebra::dual::Dual;
use crate::displacement::answer::{homogeneous, list, number, screw};
use crate::kinematics::dual_quaternion::{DualQuaternion, Quaternion};
use crate::kinematics::motion::Motion;
use looproot_calculus::rotation::cayley_klein::CayleyKlein;
use looproot_calculus::rotation::euler::{Angles, Order};
use looproot_calculus::rotation::matrix::{from_matrix, matrix};
use looproot_calculus::rotation::rates::{corrected, quaternion_rate};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::rotation::vectors::{axis_angle, euler_vectors, rodrigues, unit, wiener};
use looproot_calculus::unit::Analytic;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The request.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The word behind `--from`.
    pub from: String,
    /// The motion; of a rotation without translation.
    pub motion: Motion<f64>,
    /// Whether it is a displacement.
    pub is_motion: bool,
    /// The order of the axes of the Euler angles.
    pub order: Order,
    /// Whether parametrisations over the dual numbers are requested.
    pub dual: bool,
    /// The Euler-Rodrigues parameters as they were typed.
    pub typed: Option<Quaternion<f64>>,
    /// The angular velocity whose rates are requested.
    pub rates: Option<[f64; 3]>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// The document.
#[must_use]
pub fn json(asked: &Asked) -> Value {
    let mut object = Map::new();
    object.insert("kind".into(), json!(if asked.is_motion { "motion" } else { "rotation" }));
    object.insert("from".into(), json!(asked.from));
    let q = unit(&from_matrix(&asked.motion.rotation)).map(|q| snapped(&q));
    if let Some(q) = &q {
        object.extend(parametrisations(q, asked.order, &|x: &f64| number(*x)));
    }
    if let Some(corrected) = asked.typed.as_ref().and_then(corrected) {
        let [x, y, z] = corrected.vector;
        object.insert("corrected".into(), list(&[corrected.scalar, x, y, z]));
    }
    if asked.is_motion {
        object.insert("position".into(), list(&asked.motion.translation));
        object.insert("transform".into(), homogeneous(&asked.motion));
        object.insert("screw".into(), screw(&asked.motion));
        if let Some(plane) = in_plane(&asked.motion) {
            object.insert("plane".into(), plane);
        }
    }
    if asked.dual {
        let show = |d: &Dual<f64>| list(&[d.value, d.epsilon]);
        let dual = unit(&dual_quaternion(&asked.motion)).map(|q| parametrisations(&q, asked.order, &show));
        object.insert("dual".into(), dual.map_or(Value::Null, Value::Object));
    }
    if let (Some(omega), Some(q)) = (&asked.rates, &q) {
        object.insert("rates".into(), rates(q, omega, asked.order));
    }
    object.insert("warnings".into(), json!(asked.warnings));
    Value::Object(object)
}

/// A motion parallel to the plane of x and y in complex numbers: `z -> factor z + shift`, with its pole, the fixed point; null in a
/// translation.
fn in_plane(motion: &Motion<f64>) -> Option<Value> {
    // A few units in the last place of 1.
    let snap = |x: f64| if x.abs() < 4.0 * f64::EPSILON { 0.0 } else { x };
    let [[c, _, a], [s, _, b], [_, _, z]] = motion.rotation;
    let [x, y, height] = motion.translation;
    if [a, b, 1.0 - z, height].iter().any(|off| snap(*off) != 0.0) {
        return None;
    }
    let (c, s) = (snap(c), snap(s));
    // shift/(1 - factor)
    let square = (1.0 - c) * (1.0 - c) + s * s;
    let pole = if square == 0.0 {
        Value::Null
    } else {
        list(&[(x * (1.0 - c) - y * s) / square, (y * (1.0 - c) + x * s) / square])
    };
    Some(json!({ "factor": list(&[c, s]), "shift": list(&[x, y]), "pole": pole }))
}

/// The rates: the parametrisations over dual numbers that carry the rate of the quaternion, of which the dual parts are shown.
fn rates(q: &Quaternion<f64>, omega: &[f64; 3], order: Order) -> Value {
    let Some(rate) = quaternion_rate(q, omega) else { return Value::Null };
    let with = |value: f64, epsilon: f64| Dual { value, epsilon };
    let moving = Quaternion {
        scalar: with(q.scalar, rate.scalar),
        vector: std::array::from_fn(|i| with(q.vector[i], rate.vector[i])),
    };
    let mut found = parametrisations(&moving, order, &|d: &Dual<f64>| number(d.epsilon));
    // Where a parametrisation is critical, its rates are infinite or free, and its list is empty.
    found.shift_remove("families");
    Value::Object(found)
}

/// The dual quaternion of a motion.
fn dual_quaternion(motion: &Motion<f64>) -> DualQuaternion<f64> {
    let q = from_matrix(&motion.rotation);
    let constant = Quaternion { scalar: Dual::constant(q.scalar), vector: q.vector.map(Dual::constant) };
    DualQuaternion::translation(&motion.translation).mul(&constant)
}

/// Rounded zeros of a unit quaternion become 0, so that half a turn is one.
fn snapped(q: &Quaternion<f64>) -> Quaternion<f64> {
    // A few units in the last place of 1.
    let snap = |x: f64| if x.abs() < 4.0 * f64::EPSILON { 0.0 } else { x };
    Quaternion { scalar: snap(q.scalar), vector: q.vector.map(snap) }
}

/// All parametrisations of a unit quaternion.
fn parametrisations<R: Analytic>(q: &Quaternion<R>, order: Order, show: &dyn Fn(&R) -> Value) -> Map<String, Value> {
    let vector = |v: &[R; 3]| -> Value { v.iter().map(show).collect() };
    let vectors = |list: &[[R; 3]]| -> Value { list.iter().map(vector).collect() };
    let mut object = Map::new();
    let mut families = Vec::new();
    let rows = matrix(q);
    let shown = rows.as_ref().map_or(Value::Null, |rows| rows.iter().map(vector).collect());
    object.insert("matrix".into(), shown);
    let [x, y, z] = &q.vector;
    object.insert("quaternion".into(), [&q.scalar, x, y, z].into_iter().map(show).collect());
    if let Some((axis, angle)) = axis_angle(q) {
        object.insert("axis".into(), vector(&axis));
        object.insert("angle".into(), show(&angle));
    } else {
        object.insert("axis".into(), Value::Null);
        object.insert("angle".into(), show(&R::zero()));
        families.push(json!({ "of": "axis", "dimension": 2, "sample": [0, 0, 1], "relation": "angle = 0" }));
    }
    for (name, order) in [("euler", order), ("bryan", Order::BRYAN)] {
        let angles = rows.as_ref().and_then(|rows| order.angles(rows));
        let list = match angles {
            Some(Angles::Two(branches)) => branches.iter().filter_map(|turns| triple(turns, show)).collect(),
            Some(Angles::Family { middle, outer, is_difference }) => {
                families.extend(family(name, &middle, &outer, is_difference, show));
                json!([])
            }
            None => json!([]),
        };
        object.insert(name.into(), list);
    }
    object.insert("euler_vector".into(), vectors(&euler_vectors(q)));
    object.insert("rodrigues".into(), vectors(&rodrigues(q).into_iter().collect::<Vec<_>>()));
    object.insert("wiener".into(), vectors(&wiener(q)));
    let CayleyKlein { alpha, beta } = CayleyKlein::of(q);
    let pair = |z: &[R; 2]| -> Value { z.iter().map(show).collect() };
    object.insert("cayley_klein".into(), json!([{ "alpha": pair(&alpha), "beta": pair(&beta) }]));
    object.insert("families".into(), json!(families));
    object
}

/// Three angles.
fn triple<R: Analytic>(turns: &[Turn<R>; 3], show: &dyn Fn(&R) -> Value) -> Option<Value> {
    let angles: Option<Vec<Value>> = turns.iter().map(|turn| Some(show(&turn.angle()?))).collect();
    Some(json!(angles?))
}

/// The angles at a critical place: the outer ones only by their sum or difference.
fn family<R: Analytic>(
    of: &str,
    middle: &Turn<R>,
    outer: &Turn<R>,
    is_difference: bool,
    show: &dyn Fn(&R) -> Value,
) -> Option<Value> {
    let (middle, outer) = (middle.angle()?, outer.angle()?);
    let sign = if is_difference { '-' } else { '+' };
    let right = show(&outer);
    let right = right.as_f64().map_or_else(|| right.to_string(), super::number::digits);
    Some(json!({
        "of": of,
        "dimension": 1,
        "sample": [show(&outer), show(&middle), show(&R::zero())],
        "relation": format!("a {sign} c = {right}"),
    }))
}

/// Returns the document as text.
#[must_use]
pub fn text(asked: &Asked) -> String {
    let document = json(asked);
    let mut text = format!("{} from {}\n", document["kind"].as_str().unwrap_or_default(), asked.from);
    let Value::Object(mut fields) = document else { return text };
    for key in ["kind", "from"] {
        fields.shift_remove(key);
    }
    let warnings = fields.shift_remove("warnings");
    let nested = ["screw", "plane", "dual", "rates"].map(|key| (key, fields.shift_remove(key)));
    write_values(&mut text, &fields);
    for (key, value) in nested {
        if let Some(Value::Object(own)) = value {
            let _ = writeln!(text, "\n{key}");
            write_values(&mut text, &own);
        }
    }
    for warning in warnings.as_ref().and_then(Value::as_array).into_iter().flatten() {
        let _ = writeln!(text, "warning: {}", warning.as_str().unwrap_or_default());
    }
    text
}
