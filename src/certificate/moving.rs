//! Decides whether a closed loop moves: theorems 5 to 7 of docs/certificate.md.

use super::bound::choices;
use super::chain::ChainClosure;
use super::check::closed;
use super::data::{data_of_loop, entry_of};
use super::eliminant::{Choice, is_long, solutions_by_eliminant};
use super::fault::{Fault, refused, shortened, unreadable};
use super::isolation::{Closed, proved_modes};
use super::mode::{Ball, Unproved};
use super::record::{Claim, decimal, fields, list, text};
use super::refine::{Near, balls};
use crate::algebra::echelon::Echelon;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, HalfTangent};
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::catalogue::Chains;
use crate::catalogue::entry::{Design, Entry};
use crate::kinematics::joint::{JointVariable, Variable};
use crate::kinematics::motion::Motion;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Map, Value, json};

/// Upper bound on the multiplicity of an isolated configuration.
const MOST: usize = 16;
type Along = Series<Rational, { MOST + 1 }>;

/// An unknown nearer to a simple number than this is tried there; the proof does not rest on it.
const NEAR: f64 = 1e-11;
/// The largest numerator and denominator of a simple number; its square is far from the digits of f64.
const LONGEST_PLACE: f64 = 1e5;
/// Denominator of the half-angle tangent of a held joint.
const HELD_PARTS: f64 = 1e4;

/// A loop with rational links: the kind of each unknown, the link behind it, and the part of the last link that stands in front of the
/// first unknown.
type Loop = (Vec<Variable>, Vec<Motion<Rational>>, Motion<Rational>);

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
    if kind == "curve" && !modes.is_empty() {
        return refused("modes: none are asked for here");
    }
    let found = match kind {
        "eliminant" => {
            let [_, aid] = fields(item, ["kind", "aid"], &[])?;
            let longer = longer_loop(&rational_loop(entry)?)?;
            finitely_many(&longer, &Choice::read(aid)?)?;
            if modes.iter().any(|mode| mode.multiplicity != 1) {
                return refused("modes: simple solutions of the longer loop are asked for");
            }
            let balls: Vec<Ball> = modes.into_iter().map(|mode| mode.ball).collect();
            if balls.is_empty() {
                return refused("modes: a solution of the longer loop is asked for");
            }
            proved_modes(&Closed::Chain(Box::new(longer)), &balls)?;
            0
        }
        "curve" => {
            let [_, point] = fields(item, ["kind", "point"], &[])?;
            let point: Vec<Place> = list(point)?.iter().map(place).collect::<Result<_, _>>()?;
            follows_a_curve(&rational_loop(entry)?, &point)?;
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

/// Returns the loop of a file, without any input.
fn rational_loop(entry: &Entry) -> Result<Loop, Fault> {
    let no = || refused("proof: only loops of at most 6 unknowns with rational constants and without spherical joints are covered");
    let Design::Loop(chain) = &entry.design else { return no() };
    let kinds = chain.joint_kinds();
    let is_plain = !kinds.iter().any(|kind| matches!(kind.letter(), "S" | "H"));
    let Some((variables, mut motions)) = chain.unknowns_and_constants::<Rational>() else { return no() };
    if entry.rounded || !is_plain || variables.is_empty() || variables.len() > 6 {
        return no();
    }
    let before = motions.remove(0);
    let last = motions.len() - 1;
    motions[last] = motions[last].then_after(&before);
    Ok((variables, motions, before))
}

/// Returns a loop with rotations about other axes added behind its last link, up to six unknowns.
fn longer_loop((variables, links, before): &Loop) -> Result<ChainClosure, Fault> {
    let (mut variables, mut links) = (variables.clone(), links.clone());
    for k in 0..u32::try_from(6 - links.len()).unwrap_or(0) {
        let about = |t: Rational| {
            let square = Rational::from(t.square_ref());
            let below = Rational::from(&square + 1);
            ((Rational::from(1) - square) / &below, t * 2_u32 / below)
        };
        let (cos, sin) = about(Rational::from((2 + k, 7)));
        let mut frame = Motion::rotation_x(cos, sin);
        frame.translation = [Rational::from((k + 1, 3)), Rational::from((1, k + 2)), Rational::new()];
        let (cos, sin) = about(Rational::from((3, 5 + 2 * k)));
        let mut about_y = Motion::identity();
        about_y.rotation[0] = [cos.clone(), Rational::new(), sin.clone()];
        about_y.rotation[2] = [-sin, Rational::new(), cos];
        // What is in front of the first unknown stays behind the added rotations: their axes are given in the frame of the ground.
        let frame = before.inverse().then_after(&frame).then_after(&about_y);
        let last = links.len() - 1;
        links[last] = links[last].then_after(&frame);
        links.push(frame.inverse());
        variables.push(Variable::Rotation);
    }
    let (Ok(links), Ok(variables)) = (<[_; 6]>::try_from(links), <[_; 6]>::try_from(variables)) else {
        return refused("proof: eliminant: more than six unknowns");
    };
    let known = |link: &Motion<Rational>| link.map(|x| Some(Enclosure::of(x))).unwrap_or_else(Motion::identity);
    Ok(ChainClosure { variables, links: links.each_ref().map(known), exact: Some(links), given: None, spherical: Vec::new() })
}

/// Checks theorem 5: the longer loop has finitely many solutions.
fn finitely_many(longer: &ChainClosure, choice: &Choice) -> Result<(), Fault> {
    solutions_by_eliminant(longer, choice, &[]).map(drop)
}

/// The value of an unknown at a configuration: a half-angle tangent (none for pi), or a distance.
type Place = Option<Rational>;

fn place(value: &Value) -> Result<Place, Fault> {
    let written = text(value)?;
    if written == "inf" {
        return Ok(None);
    }
    let number = |text: &str| decimal(&Value::from(text));
    let value = match written.split_once('/') {
        Some((above, below)) => {
            let below = number(below)?;
            if below == 0 {
                return unreadable("found a division by zero");
            }
            number(above)? / below
        }
        None => number(written)?,
    };
    Ok(Some(value))
}

/// Returns the motion of an unknown held at a place.
fn standing(variable: Variable, place: &Place) -> Motion<Rational> {
    match (variable, place) {
        (Variable::Translation, place) => Motion::translation_z(place.clone().unwrap_or_default()),
        (Variable::Rotation, None) => Motion::rotation_z(Rational::from(-1), Rational::new()),
        (Variable::Rotation, Some(t)) => {
            let square = Rational::from(t.square_ref());
            let below = Rational::from(&square + 1);
            Motion::rotation_z((Rational::from(1) - square) / &below, Rational::from(t * 2_u32) / below)
        }
    }
}

/// Checks theorem 6: the closure equations hold to order 16 along the only first-order motion.
fn follows_a_curve((variables, links, _): &Loop, point: &[Place]) -> Result<(), Fault> {
    let size = variables.len();
    let misplaced = |(variable, place): (&Variable, &Place)| *variable == Variable::Translation && place.is_none();
    if point.len() != size || variables.iter().zip(point).any(misplaced) {
        return unreadable("proof: curve: the point has other numbers than the loop has unknowns");
    }
    let links: Vec<Motion<Rational>> =
        (0..size).map(|k| standing(variables[k], &point[k]).then_after(&links[k])).collect();
    if links.iter().any(is_long) {
        return refused("proof: curve: the numbers are too long");
    }
    let product = links.iter().fold(Motion::identity(), |product, link| product.then_after(link));
    if product != Motion::identity() {
        return refused("proof: curve: the loop is not closed there");
    }
    let mut small = Along::zero();
    small.coefficients[1] = Rational::from(1);
    let only = |free: usize| -> Vec<Along> {
        (0..size).map(|k| if k == free { small.clone() } else { Along::zero() }).collect()
    };
    let broken = || Fault::Unreadable("proof: curve: found numbers that are not known well enough".to_owned());
    let screws: Vec<Vec<Rational>> = (0..size)
        .map(|k| Some(equations(variables, &links, &only(k))?.map(|f| f.coefficients[1].clone()).to_vec()))
        .collect::<Option<_>>()
        .ok_or_else(broken)?;
    let reduced = Echelon::of(screws.clone(), 6);
    if reduced.rank() != size - 1 {
        let rank = reduced.rank();
        return refused(format!("proof: curve: the joint screws have the rank {rank}, expected {}", size - 1));
    }
    // The equations at the pivots are independent; all unknowns but one follow from them.
    let rows = reduced.pivots();
    let independent = reduced.independent_rows();
    let free = (0..size).find(|k| !independent.contains(k)).unwrap_or(0);
    let others: Vec<usize> = (0..size).filter(|k| *k != free).collect();
    // [A | 1] to [1 | A^-1] for the derivatives A of the equations by the others.
    let augmented = rows.iter().enumerate().map(|(at, row)| {
        let unit = (0..rows.len()).map(|k| Rational::from(u32::from(k == at)));
        others.iter().map(|k| screws[*k][*row].clone()).chain(unit).collect::<Vec<_>>()
    });
    let inverted = Echelon::among(augmented.collect(), 2 * others.len(), others.len());
    let mut step = vec![Vec::new(); others.len()];
    for (pivot, row) in inverted.pivots().iter().zip(inverted.rows()) {
        step[*pivot] = row[others.len()..].to_vec();
    }
    let mut along = only(free);
    for _ in 0..MOST {
        let values = equations(variables, &links, &along).ok_or_else(broken)?;
        for (own, k) in step.iter().zip(&others) {
            for (factor, row) in own.iter().zip(rows) {
                along[*k] = along[*k].sub(&values[*row].mul(&Along::constant(factor.clone())));
            }
        }
    }
    let values = equations(variables, &links, &along).ok_or_else(broken)?;
    if values.iter().any(|value| !value.is_zero()) {
        return refused("proof: curve: the loop opens along the motion");
    }
    Ok(())
}

/// Returns the six series that vanish if the loop is closed.
fn equations(variables: &[Variable], links: &[Motion<Rational>], at: &[Along]) -> Option<[Along; 6]> {
    let mut product = Motion::<Along>::identity();
    for ((variable, link), x) in variables.iter().zip(links).zip(at) {
        let moved = match variable {
            Variable::Rotation => {
                let (cos, sin) = x.cos_sin_beyond(Rational::from(1), Rational::new())?;
                Motion::rotation_z(cos, sin)
            }
            Variable::Translation => Motion::translation_z(x.clone()),
        };
        product = product.then_after(&moved).then_after(&link.map(|x| Some(Along::constant(x.clone())))?);
    }
    let [x, y, z] = product.translation;
    let r = product.rotation;
    let skew = |i: usize, j: usize| r[i][j].sub(&r[j][i]);
    Some([skew(2, 1), skew(0, 2), skew(1, 0), x, y, z])
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
    if !closed.is_without_spherical_joints() {
        return refused("proof: regular: only loops without spherical joints are covered");
    }
    proved_modes(&closed, &[mode.ball])
}

/// Returns a proof that a loop moves in one dimension, from real configurations of it, with the balls that the proof needs; `None` if
/// theorems 6 and 7 give none.
#[must_use]
pub fn proof_of_motion(entry: &Entry, configurations: &[Vec<f64>]) -> Option<(Value, Vec<Ball>)> {
    let through = |q: &Vec<f64>| {
        let links = rational_loop(entry).ok()?;
        let point: Vec<Place> = links.0.iter().zip(q).map(|(v, x)| near_place(*v, *x)).collect::<Option<_>>()?;
        follows_a_curve(&links, &point).ok()?;
        let text = |place: &Place| place.as_ref().map_or_else(|| "inf".to_owned(), Rational::to_string);
        Some((json!({ "kind": "curve", "point": point.iter().map(text).collect::<Vec<_>>() }), Vec::new()))
    };
    configurations.iter().find_map(through).or_else(|| configurations.iter().find_map(|q| held_regular(entry, q)))
}

/// Returns a proof that a loop does not move, with a ball around a solution of the longer loop; `None` if theorem 5 gives none.
/// `solve` finds solutions of that loop.
#[must_use]
pub fn proof_of_rest(entry: &Entry, solve: &dyn Fn(&ChainClosure) -> Vec<Near>) -> Option<(Value, Vec<Ball>)> {
    // The frames of axes are those of the data as a certificate has them.
    let Ok(Value::Object(data)) = data_of_loop(entry) else { return None };
    let longer = longer_loop(&rational_loop(&entry_of(&data, Chains::Any).ok()?).ok()?).ok()?;
    let choice = choices().find(|choice| finitely_many(&longer, choice).is_ok())?;
    let near = solve(&longer);
    let longer = Closed::Chain(Box::new(longer));
    let ball = near.into_iter().find_map(|one| balls(&longer, &[one]))?;
    Some((json!({ "kind": "eliminant", "aid": choice.json() }), ball))
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
