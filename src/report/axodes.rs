//! The axodes of a body in a sweep of a loop or of a linkage on the sphere or in space, and its centrodes in the plane: the instantaneous axis or
//! pole of every row, as the ground and as the body sees it.

use super::json::number;
use super::space_instant::{chain_name, rounded};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::ring::Ring;
use crate::catalogue::entry::{Case, Entry, Input, InputValue};
use crate::catalogue::{LinkageFile, SpaceFile, SphereFile};
use crate::displacement::answer::list;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Gaussian, Given};
use crate::kinematics::motion::{Motion, Vector, dot};
use crate::kinematics::space::SpaceGiven;
use crate::kinematics::sphere::SphereGiven;
use crate::linkage::answer::LinkageMode;
use crate::linkage::instant::pole;
use crate::linkage::rates::{Moving as Plane, freedoms, moving, resting};
use crate::linkage::space::{SpaceMode, rates as rates_in_space};
use crate::linkage::sphere::{SphereMode, rates};
use crate::mechanism::{InputCurve, Moving, MovingChain, relative};
use crate::sweep::{AssemblySweep, LinkageSweep, SpaceSweep, SphereSweep};
use looproot_calculus::line::pluecker::Line;
use rug::Rational;
use serde_json::{Value, json};

/// Adds `axodes` to all rows of a sweep of a loop.
///
/// # Errors
/// As [`InputCurve::of`].
pub fn of_loop(document: &mut Value, entry: &Entry, input: (usize, Variable), body: usize) -> Result<()> {
    let Some(chain) = entry.chain() else { return Ok(()) };
    let curve = InputCurve::of(entry, &input_of_loop(input))?;
    for row in rows(document) {
        let q: Vec<f64> = row["q"].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        let found = (q.len() == curve.variables().len()).then(|| {
            let rates = curve.derivatives_at(&curve.point(&q))?;
            let all = MovingChain::of(chain, &q, &rates.velocity, &rates.acceleration)?;
            axis([body, 0], all.bodies())
        });
        row["axodes"] = json!({ chain_name(body): found.flatten() });
    }
    Ok(())
}

/// Returns the case in which a joint variable is the input.
pub(super) fn input_of_loop((joint, variable): (usize, Variable)) -> Case {
    let value = match variable {
        Variable::Rotation => InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(Rational::new()))),
        Variable::Translation => InputValue::Distance(Number::exact(Rational::new())),
    };
    Case::given(Input { joint, value }, 0)
}

/// Returns the given values of a linkage on the sphere in which this joint is the first, at any angle.
pub(super) fn given_of_sphere(file: &SphereFile, joint: usize) -> Vec<SphereGiven> {
    let own = &file.linkage.joints[joint];
    let rotation = Motion::<Rational>::identity().rotation;
    let driven = SphereGiven { of: own.of, rotation, joint: Some(joint), line: own.line };
    let others = file.cases[0].given.iter().filter(|one| one.joint != Some(joint)).cloned();
    std::iter::once(driven).chain(others).collect()
}

/// Returns the given values of a linkage in the plane with this joint, at any value, and its place among the numbers that are given.
pub(super) fn given_of_plane(file: &LinkageFile, joint: usize) -> (Vec<Given>, usize) {
    let is_other = |one: &&Given| !matches!(one, Given::Turn { joint: own, .. } | Given::Shift { joint: own, .. } if *own == joint);
    let mut given: Vec<Given> = file.cases[0].given.iter().filter(is_other).cloned().collect();
    let driven = freedoms(&given);
    given.push(if file.linkage.joints[joint].is_prismatic() {
        Given::Shift { joint, shift: Rational::new(), square: None, line: 0 }
    } else {
        Given::Turn { joint, turn: Gaussian { re: Rational::from(1), im: Rational::new() }, within: None, line: 0 }
    });
    (given, driven)
}

/// Adds `axodes` to all rows of a sweep of a linkage on the sphere.
pub fn of_sphere(document: &mut Value, file: &SphereFile, sweep: &SphereSweep, body: usize) {
    let linkage = &file.linkage;
    let given = given_of_sphere(file, sweep.joint);
    let found = |mode: &SphereMode| {
        let all = rates(linkage, &given, mode)?.bodies;
        axis([body, linkage.ground], &all)
    };
    of_assemblies(document, &linkage.bodies[body].name, sweep, found);
}

/// Adds `axodes` to all rows of a sweep of a linkage in space.
pub fn of_space(document: &mut Value, file: &SpaceFile, sweep: &SpaceSweep, body: usize) {
    let linkage = &file.linkage;
    let given = given_of_space(file, sweep.joint);
    let found = |mode: &SpaceMode| {
        let all = rates_in_space(linkage, &given, mode)?.bodies;
        axis([body, linkage.ground], &all)
    };
    of_assemblies(document, &linkage.bodies[body].name, sweep, found);
}

/// Returns the given values of a linkage in space with this joint, at any value, in front.
pub(super) fn given_of_space(file: &SpaceFile, joint: usize) -> Vec<SpaceGiven> {
    let others = file.cases[0].given.iter().filter(|one| one.joint != Some(joint)).cloned();
    file.driven(joint, 1.0).into_iter().chain(others).collect()
}

/// Adds `axodes` to all rows and limit positions of a sweep.
fn of_assemblies<M>(document: &mut Value, name: &str, sweep: &AssemblySweep<M>, found: impl Fn(&M) -> Option<Value>) {
    let modes = sweep.branches.iter().flat_map(|branch| &branch.rows);
    let modes = modes.map(|row| &sweep.samples[row.step].modes[row.mode]);
    let modes: Vec<&M> = modes.chain(sweep.limits.iter().map(|limit| &limit.mode)).collect();
    for (row, mode) in rows(document).into_iter().zip(modes) {
        row["axodes"] = json!({ name: found(mode) });
    }
}

/// Adds `centrodes` to all rows and limit positions of a sweep of a linkage in the plane.
pub fn of_plane(document: &mut Value, file: &LinkageFile, sweep: &LinkageSweep, body: usize) {
    let linkage = &file.linkage;
    let (given, driven) = given_of_plane(file, sweep.joint);
    let found = |mode: &LinkageMode| {
        let mut runs = vec![Plane::zero(); freedoms(&given)];
        runs[driven].coefficients[1] = 1.0;
        let rest = resting(mode);
        let bodies = moving(linkage, &given, &rest, &runs)?;
        let fixed = pole(&bodies[body], &bodies[linkage.ground])?;
        let (sin, cos) = rest[body].angle.coefficients[0].sin_cos();
        let [x, y] = [0, 1].map(|k| fixed[k] - rest[body].origin[k].coefficients[0]);
        Some(json!({ "fixed": list(&fixed), "moving": list(&[cos * x + sin * y, cos * y - sin * x]) }))
    };
    let name = linkage.bodies[body].name.clone();
    let modes = sweep.branches.iter().flat_map(|branch| &branch.rows);
    let modes = modes.map(|row| &sweep.samples[row.step].modes[row.mode]);
    let modes: Vec<&LinkageMode> = modes.chain(sweep.limits.iter().map(|limit| &limit.mode)).collect();
    for (row, mode) in rows(document).into_iter().zip(modes) {
        row["centrodes"] = json!({ name.clone(): found(mode) });
    }
}

/// All rows of all branches, then the limit positions.
pub(super) fn rows(document: &mut Value) -> Vec<&mut Value> {
    let Some(object) = document.as_object_mut() else { return Vec::new() };
    let (mut rows, mut limits) = (Vec::new(), Vec::new());
    for (key, value) in object {
        let items = value.as_array_mut().into_iter().flatten();
        match key.as_str() {
            "branches" => rows.extend(items.filter_map(|branch| branch["rows"].as_array_mut()).flatten()),
            "limits" => limits.extend(items),
            _ => {}
        }
    }
    rows.extend(limits);
    rows
}

/// The axis of the velocity screw of a body against another one at rest, in axes of this and of the body; `None` where the body does not
/// turn.
fn axis([body, ground]: [usize; 2], all: &[Moving]) -> Option<Value> {
    let body = all.get(body)?;
    let state = rounded(&relative(body, all.get(ground)?), all);
    let screw = state.screw()?;
    let rate = dot(&state.omega, &state.omega).sqrt();
    let point = screw.axis.point()?;
    let direction = screw.axis.direction.map(|c| c / rate);
    let back = body.map(|series| Some(series.coefficients[0]))?.inverse();
    let own = Line::at(&back.apply(&point), &back.rotate(&direction)).point()?;
    let shown =
        |direction: &Vector<f64>, point: &Vector<f64>| json!({ "direction": list(direction), "point": list(point) });
    Some(json!({
        "fixed": shown(&direction, &point),
        "moving": shown(&back.rotate(&direction), &own),
        "pitch": number(screw.pitch),
    }))
}
