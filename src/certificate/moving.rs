//! Decides whether a closed loop moves: theorems 5 to 7 of docs/certificate.md.

use super::algebraic::{Far, Points};
use super::bound::{choices, of_chains};
use super::chain::ChainClosure;
use super::check::closed;
use super::curve::follows;
use super::data::{data_of_loop, entry_of};
use super::eliminant::{Choice, is_long, solutions_by_eliminant};
use super::fault::{Fault, refused, shortened, unreadable};
use super::isolation::{Closed, proved_modes};
use super::mode::{Ball, Unproved};
use super::reconstructed;
use super::record::{Claim, count, fields};
use super::refine::{Near, balls};
use crate::algebra::conjugates::fewest_conjugates;
use crate::algebra::number::{Angle, HalfTangent};
use crate::algebra::ring::exact_cos_sin;
use crate::catalogue::Chains;
use crate::catalogue::entry::{Design, Entry};
use crate::kinematics::joint::{JointVariable, Variable};
use crate::kinematics::motion::Motion;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Map, Value, json};

/// The `kind` of the item of theorem 6.
pub(super) const CURVE: &str = "curve";
/// Upper bound on the multiplicity of an isolated configuration and its conjugates together.
const MOST: usize = 16;

/// An unknown nearer to a simple number than this is tried there; the proof does not rest on it.
const NEAR: f64 = 1e-11;
/// Solutions nearer than this are the same but for rounding.
const SAME: f64 = 1e-6;
/// The largest numerator and denominator of a simple number; its square is far from the digits of f64.
const LONGEST_PLACE: f64 = 1e5;
/// Denominator of a simple value beside a configuration: with few digits the other coordinates have few, too.
const ROUND_PARTS: f64 = 8.0;
/// Denominator of the half-angle tangent of a held joint.
const HELD_PARTS: f64 = 1e4;

/// Returns the dimension of the motion that a certificate proves.
pub(super) fn mobility(
    entry: &Entry,
    data: &Map<String, Value>,
    claim: &Claim,
    modes: Vec<Unproved>,
    proof: &[Value],
) -> Result<usize, Fault> {
    let [item] = proof else {
        return refused(format!("proof: found {} items, expected one", proof.len()));
    };
    let kind = item.get("kind").and_then(Value::as_str).unwrap_or_default();
    if kind == CURVE && !modes.is_empty() {
        return refused("modes: none are asked for here");
    }
    let found = match kind {
        "eliminant" | "general-bound" => {
            if modes.iter().any(|mode| mode.multiplicity != 1) {
                return refused("modes: simple solutions of the longer loop are asked for");
            }
            let balls: Vec<Ball> = modes.into_iter().map(|mode| mode.ball).collect();
            does_not_move(entry, item, &balls)?;
            0
        }
        CURVE => {
            follows_a_curve(&longer_loop(entry)?, item)?;
            1
        }
        "regular" => {
            let [_, held] = fields(item, ["kind", "held"], &[])?;
            fields(held, ["joint"], &["angle", "distance"])?;
            is_regular(data, held, modes)?;
            1
        }
        _ => return unreadable(format!("proof: found the kind `{}`", shortened(&kind))),
    };
    if claim.mobility != Some(found) || claim.status != if found == 0 { "immobile" } else { "mobile" } {
        let status = shortened(&claim.status);
        return refused(format!("claim: found `{status}`, where a motion of dimension {found} is proved"));
    }
    Ok(found)
}

/// Returns the loop of a file without any input, up to six unknowns.
fn longer_loop(entry: &Entry) -> Result<ChainClosure, Fault> {
    let Design::Loop(chain) = &entry.design else { return refused("data: whether it moves is proved of a loop") };
    ChainClosure::of(chain, None, !entry.rounded)
}

/// Checks theorem 5: the solutions of the longer loop are finitely many.
fn does_not_move(entry: &Entry, item: &Value, balls: &[Ball]) -> Result<(), Fault> {
    let longer = longer_loop(entry)?;
    let least = if item.get("kind").and_then(Value::as_str) == Some("general-bound") {
        let [_, stated] = fields(item, ["kind", "value"], &[])?;
        let known = of_chains(&longer);
        if known != Some(count(stated)?) {
            return refused("proof: general-bound: the value is not that of loops of this kind");
        }
        known
    } else {
        let [_, aid] = fields(item, ["kind", "aid"], &[])?;
        solutions_by_eliminant(&longer, &Choice::read(aid)?, &[])?;
        None
    };
    proved_modes(&Closed::Chain(Box::new(longer)), balls)?;
    if balls.is_empty() || least.is_some_and(|least| balls.len() != least) {
        return refused(format!(
            "modes: {} solutions of the longer loop are proved, more or others are asked for",
            balls.len()
        ));
    }
    Ok(())
}

/// Checks theorem 6: the closure equations hold to the order that decides along the only first-order motion.
pub(super) fn follows_a_curve(closure: &ChainClosure, item: &Value) -> Result<(), Fault> {
    let Some(links) =
        closure.own_links.as_ref().filter(|links| closure.spherical.is_empty() && !links.iter().any(is_long))
    else {
        return refused("proof: curve: only loops with rational constants and without spherical joints are covered");
    };
    let variables = &closure.variables[..closure.own];
    let points = Points::read(item, variables)?;
    if points.polynomial.real_roots().is_empty() {
        return refused("proof: curve: none of the points is real");
    }
    let Some(links) = points.standing(links) else { return refused("proof: curve: the loop is not closed there") };
    // An isolated configuration and its conjugates have the multiplicity 16 together at most.
    follows((MOST / fewest_conjugates(&points.polynomial)).max(1), variables, &links)
}

/// Checks theorem 7: with one unknown of seven held, a real solution is simple.
fn is_regular(data: &Map<String, Value>, held: &Value, modes: Vec<Unproved>) -> Result<(), Fault> {
    let mut longer = data.clone();
    longer.insert("input".to_owned(), Value::Array(vec![held.clone()]));
    let entry = entry_of(&longer, Chains::Solved)?;
    let [case] = entry.cases.as_slice() else { return unreadable("proof: regular: found no value that is held") };
    let closed = closed(&entry, case)?;
    let [mode] = <[Unproved; 1]>::try_from(modes).or_else(|_| unreadable("proof: regular: expected one mode"))?;
    if mode.multiplicity != 1 || !mode.ball.real {
        return refused("mode 1: a simple real configuration is asked for");
    }
    if !matches!(&closed, Closed::Chain(closure) if closure.own == 6) {
        return refused("proof: regular: only loops of seven unknowns are covered");
    }
    proved_modes(&closed, &[mode.ball])
}

/// Returns a proof that a loop moves in one dimension, from real configurations of it, with the balls that the proof needs; `None` if
/// theorems 6 and 7 give none. `solve` finds solutions of a loop of six unknowns.
#[must_use]
pub fn proof_of_motion(
    entry: &Entry,
    configurations: &[Vec<f64>],
    solve: &dyn Fn(&ChainClosure) -> Vec<Near>,
) -> Option<(Value, Vec<Ball>)> {
    let Design::Loop(chain) = &entry.design else { return None };
    if JointVariable::of(&chain.joint_kinds()).len() == 7 {
        return configurations.iter().find_map(|q| held_regular(entry, q));
    }
    let Ok(Value::Object(data)) = data_of_loop(entry) else { return None };
    let closure = longer_loop(&entry_of(&data, Chains::Any).ok()?).ok()?;
    proof_of_self_motion(&closure, configurations, solve).map(|item| (item, Vec::new()))
}

/// Returns the item of theorem 6 for a loop of at most six unknowns, from real configurations of it; `None` if the theorem gives none.
/// `solve` finds solutions of a loop of six unknowns.
#[must_use]
pub fn proof_of_self_motion(
    closure: &ChainClosure,
    configurations: &[Vec<f64>],
    solve: &dyn Fn(&ChainClosure) -> Vec<Near>,
) -> Option<Value> {
    let one = |q: &Vec<f64>| {
        let is_whole = q.len() == closure.own;
        let places = (0..closure.own).filter(|_| is_whole).flat_map(|k| {
            let (variable, x) = (closure.variables[k], q[k]);
            [near_place(variable, x), round_place(variable, x)].into_iter().flatten().map(move |place| (k, place))
        });
        let mut places: Vec<(usize, Place)> = places.collect();
        places.dedup();
        places.into_iter().find_map(|(k, place)| curve_through(closure, q, k, &place, solve))
    };
    configurations.iter().find_map(one)
}

/// Returns the item of theorem 6 for the configuration nearest to this one at which the unknown k has a simple value.
fn curve_through(
    closure: &ChainClosure,
    q: &[f64],
    k: usize,
    place: &Place,
    solve: &dyn Fn(&ChainClosure) -> Vec<Near>,
) -> Option<Value> {
    let (motion, coordinates) = held_at(closure.variables[k], place)?;
    let held = closure.holding(k, &motion)?;
    let others: Vec<f64> = q.iter().enumerate().filter(|(at, _)| *at != k).map(|(_, x)| *x).collect();
    let off = |x: &[Complex<f64>]| -> f64 {
        let one = |(at, (x, y)): (usize, (&Complex<f64>, &f64))| {
            let off = x - y;
            if held.variables[at] == Variable::Rotation { (0.5 * off).sin().norm() } else { off.norm() }
        };
        x.iter().zip(&others).enumerate().map(one).fold(0.0, f64::max)
    };
    let is_own = |x: &[Complex<f64>]| x[held.own..].iter().all(|x| (0.5 * x).sin().norm() < SAME);
    let near: Vec<Near> = solve(&held).into_iter().filter(|(x, _)| is_own(x)).collect();
    let real = near.iter().enumerate().filter(|(_, (_, real))| *real);
    let (at, _) = real.min_by(|(_, (x, _)), (_, (y, _))| off(x).total_cmp(&off(y)))?;
    let points = near.iter().map(|(x, _)| reconstructed::coordinates(&held, x)).collect::<Option<Vec<_>>>()?;
    let mut points = reconstructed::conjugate(&points, at)?;
    for point in &mut points {
        point.insert(k, coordinates.clone());
    }
    let mut item = reconstructed::item(&points)?;
    item["kind"] = json!(CURVE);
    follows_a_curve(closure, &item).ok()?;
    Some(item)
}

/// Returns the motion of an unknown that is held at a simple value, and its cosine and sine or its distance.
fn held_at(variable: Variable, place: &Place) -> Option<(Motion<Rational>, Vec<Far>)> {
    if variable == Variable::Translation {
        let distance = place.clone()?;
        let coordinates = reconstructed::held(variable, [&distance, &distance])?;
        return Some((Motion::translation_z(distance), coordinates));
    }
    let angle = Angle::from_half_tangent(place.clone().map_or(HalfTangent::Infinite, HalfTangent::Finite));
    let (cos, sin) = exact_cos_sin(&angle);
    let coordinates = reconstructed::held(variable, [&cos, &sin])?;
    Some((Motion::rotation_z(cos, sin), coordinates))
}

/// Returns a proof that a loop does not move, with balls around solutions of the longer loop; `None` if theorem 5 gives none.
/// `solve` finds solutions of that loop.
#[must_use]
pub fn proof_of_rest(entry: &Entry, solve: &dyn Fn(&ChainClosure) -> Vec<Near>) -> Option<(Value, Vec<Ball>)> {
    // The frames of axes are those of the data as a certificate has them.
    let Ok(Value::Object(data)) = data_of_loop(entry) else { return None };
    let longer = longer_loop(&entry_of(&data, Chains::Any).ok()?).ok()?;
    let choice = choices().find(|choice| solutions_by_eliminant(&longer, choice, &[]).is_ok());
    let (near, known) = (solve(&longer), of_chains(&longer));
    let longer = Closed::Chain(Box::new(longer));
    if let Some(choice) = choice {
        let ball = near.into_iter().find_map(|one| balls(&longer, &[one]))?;
        return Some((json!({ "kind": "eliminant", "aid": choice.json() }), ball));
    }
    // Of a spherical joint every rotation is found with two triples of angles.
    let different = near.into_iter().fold(Vec::new(), |found: Vec<Ball>, one| {
        let more = found.iter().cloned().chain(balls(&longer, &[one]).into_iter().flatten()).collect::<Vec<_>>();
        if proved_modes(&longer, &more).is_ok() { more } else { found }
    });
    let value = known.filter(|known| different.len() == *known)?;
    Some((json!({ "kind": "general-bound", "value": value }), different))
}

/// The value of an unknown at a configuration: a half-angle tangent (none for pi), or a distance.
type Place = Option<Rational>;

/// Returns a simple value near that of an unknown.
fn round_place(variable: Variable, x: f64) -> Option<Place> {
    let value = if variable == Variable::Rotation { (0.5 * x).tan() } else { x };
    if variable == Variable::Rotation && value.abs() > ROUND_PARTS {
        return Some(None);
    }
    Some(Some(Rational::from_f64((value * ROUND_PARTS).round())? / Rational::from_f64(ROUND_PARTS)?))
}

/// Returns the simple value that an unknown equals to rounding; `None` if there is none.
fn near_place(variable: Variable, x: f64) -> Option<Place> {
    if variable == Variable::Rotation && (0.5 * x).cos().abs() < NEAR {
        return Some(None);
    }
    let value = if variable == Variable::Rotation { (0.5 * x).tan() } else { x };
    // The convergents of the continued fraction.
    let (mut rest, mut before, mut last) = (value, (0.0, 1.0), (1.0, 0.0));
    loop {
        let whole = rest.floor();
        (before, last) = (last, (whole * last.0 + before.0, whole * last.1 + before.1));
        if !(f64::max(last.0.abs(), last.1) < LONGEST_PLACE) {
            return None;
        }
        if (last.0 / last.1 - value).abs() <= NEAR * value.abs().max(1.0) {
            return Some(Some(Rational::from_f64(last.0)? / Rational::from_f64(last.1)?));
        }
        rest = 1.0 / (rest - whole);
    }
}

/// Returns a joint of seven held near a configuration, and the ball around it.
fn held_regular(entry: &Entry, q: &[f64]) -> Option<(Value, Vec<Ball>)> {
    let Design::Loop(chain) = &entry.design else { return None };
    let named = JointVariable::of(&chain.joint_kinds());
    let Ok(Value::Object(data)) = data_of_loop(entry) else { return None };
    let one = |k: usize| {
        let parts = Rational::from_f64(((0.5 * q[k]).tan() * HELD_PARTS).round())?;
        let tangent = parts / Rational::from_f64(HELD_PARTS)?;
        let held = match named[k].variable {
            _ if named[k].turn != 0 => return None,
            Variable::Rotation => {
                let angle = Angle::from_half_tangent(HalfTangent::Finite(tangent)).text()?;
                json!({ "joint": named[k].joint, "angle": angle })
            }
            Variable::Translation => return None,
        };
        let mut longer = data.clone();
        longer.insert("input".to_owned(), json!([held]));
        let entry = entry_of(&longer, Chains::Solved).ok()?;
        let closed = closed(&entry, entry.cases.first()?).ok()?;
        let others = q.iter().enumerate().filter(|(at, _)| *at != k).map(|(_, x)| Complex::from(*x)).collect();
        let ball = balls(&closed, &[(others, true)])?.pop()?;
        let mode = Unproved { ball: ball.clone(), multiplicity: 1 };
        is_regular(&data, &held, vec![mode]).ok()?;
        Some((json!({ "kind": "regular", "held": held }), vec![ball]))
    };
    if named.len() != 7 || q.len() != 7 {
        return None;
    }
    (0..7).find_map(one)
}
