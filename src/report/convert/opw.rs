//! Arms with an ortho-parallel base and a spherical wrist by their seven lengths.
//!
//! `Tz(c1) Rz(q1) T(a1, b, 0) Ry(q2) Tz(c2) Ry(q3) T(a2, 0, c3) Rz(q4) Ry(q5) Rz(q6) Tz(c4)` with `q = sign * theta - offset`
//! (Brandstötter, Angerer and Hofbaur 2014).

use crate::catalogue::entry::Entry;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::motion::{Motion, Vector, dot};

/// An arm whose axes are off by more has another geometry: more than the rounding of printed tables.
const OFF: f64 = 1e-9;

/// The seven lengths and the six offsets as YAML.
pub(super) fn opw(entry: &Entry, chain: &Chain) -> Result<String> {
    Layout::of(chain, None)?;
    let (variables, constants) = chain
        .unknowns_and_constants::<f64>()
        .ok_or_else(|| Error::Unsupported("the numbers of this arm are not known well enough".to_owned()))?;
    if variables != [Variable::Rotation; 6] {
        return Err(other("six revolute joints"));
    }
    let mut frames = vec![constants[0].clone()];
    for constant in &constants[1..] {
        frames.push(frames[frames.len() - 1].then_after(constant));
    }
    let Lengths { values, offsets, signs } = lengths(&frames)?;
    let mut text = format!("# {}\nopw_kinematics_geometric_parameters:\n", entry.title);
    for (name, value) in ["a1", "a2", "b", "c1", "c2", "c3", "c4"].iter().zip(values) {
        text += &format!("  {name}: {:?}\n", tidy(value));
    }
    let offsets = offsets.map(|offset| format!("{:?}", tidy(offset)));
    text += &format!("opw_kinematics_joint_offsets: [{}]\n", offsets.join(", "));
    let signs = signs.map(|sign| if sign < 0.0 { "-1" } else { "1" });
    text += &format!("opw_kinematics_joint_sign_corrections: [{}]\n", signs.join(", "));
    Ok(text)
}

struct Lengths {
    values: [f64; 7],
    offsets: [f64; 6],
    signs: [f64; 6],
}

/// A value without the rounding of the way there.
fn tidy(value: f64) -> f64 {
    (value * 1e13).round() / 1e13 + 0.0
}

fn other(expected: &str) -> Error {
    Error::Unsupported(format!(
        "the seven lengths of an arm that is not ortho-parallel with a spherical wrist: expected {expected}"
    ))
}

/// The lengths and offsets from the frames of the joints, each with its z axis along the joint, and that of the tool.
fn lengths(frames: &[Motion<f64>]) -> Result<Lengths> {
    let column = |k: usize, j: usize| -> Vector<f64> { std::array::from_fn(|i| frames[k].rotation[i][j]) };
    let (tip, second) = (column(6, 2), column(1, 2));
    // Joints that turn the other way about the axes of the formula.
    let mut signs = [1.0_f64; 6];
    signs[0] = signs[0].copysign(column(0, 2)[2]);
    signs[2] = signs[2].copysign(dot(&second, &column(2, 2)));
    signs[5] = signs[5].copysign(dot(&tip, &column(5, 2)));
    let axis = |k: usize| column(k, 2).map(|x| x * signs[k]);
    let point = |k: usize| frames[k].translation;
    let need = |holds: bool, expected: &str| if holds { Ok(()) } else { Err(other(expected)) };
    let turned = |v: &Vector<f64>, angle: f64| -> Vector<f64> {
        let (s, c) = angle.sin_cos();
        [c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]]
    };
    let first = axis(0);
    need(first[2] > 1.0 - OFF && point(0)[0].hypot(point(0)[1]) < OFF, "axis 1 along z of the base")?;
    let q1 = (-axis(1)[0]).atan2(axis(1)[1]);
    let plane = |v: Vector<f64>| turned(&v, q1);
    need(axis(1)[2].abs() < OFF, "axis 2 across axis 1")?;
    need(dot(&axis(1), &axis(2)) > 1.0 - OFF, "axes 2 and 3 parallel")?;
    let [a1, _, c1] = plane(point(1));
    let [x3, _, z3] = plane(point(2));
    let (c2, q2) = ((x3 - a1).hypot(z3 - c1), (x3 - a1).atan2(z3 - c1));
    let forearm = plane(axis(3));
    need(forearm[1].abs() < OFF, "axis 4 across axis 3")?;
    let q23 = forearm[0].atan2(forearm[2]);
    // The wrist: axes 4, 5 and 6 meet where axes 4 and 5 come nearest.
    let wrist = meeting(&point(3), &axis(3), &point(4), &axis(4)).ok_or_else(|| other("axes 4 and 5 that meet"))?;
    let beside = |k: usize| {
        let to: Vector<f64> = std::array::from_fn(|i| wrist[i] - point(k)[i]);
        let along = dot(&to, &axis(k));
        (0..3).map(|i| (to[i] - along * axis(k)[i]).powi(2)).sum::<f64>().sqrt()
    };
    need((3..6).all(|k| beside(k) < OFF), "axes 4, 5 and 6 through one point")?;
    let centre = plane(wrist);
    let (dx, dz) = (centre[0] - x3, centre[2] - z3);
    let (s, c) = q23.sin_cos();
    let (a2, c3, b) = (c * dx - s * dz, s * dx + c * dz, centre[1]);
    // The frame behind joint 3.
    let into_forearm = |v: Vector<f64>| -> Vector<f64> {
        let v = plane(v);
        [c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]]
    };
    let fifth = into_forearm(axis(4));
    need(fifth[2].abs() < OFF, "axis 5 across axis 4")?;
    let q4 = (-fifth[0]).atan2(fifth[1]);
    let sixth = turned(&into_forearm(axis(5)), q4);
    need(sixth[1].abs() < OFF, "axis 6 across axis 5")?;
    let q5 = sixth[0].atan2(sixth[2]);
    let tool = |j: usize| -> Vector<f64> {
        let v = turned(&into_forearm(column(6, j)), q4);
        let (s, c) = q5.sin_cos();
        [c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]]
    };
    need(tool(2)[2] > 1.0 - OFF, "the z axis of the tool along axis 6")?;
    let q6 = tool(0)[1].atan2(tool(0)[0]);
    let reach: Vector<f64> = std::array::from_fn(|i| point(6)[i] - wrist[i]);
    let c4 = dot(&reach, &axis(5));
    need((0..3).all(|i| (reach[i] - c4 * axis(5)[i]).abs() < OFF), "the origin of the tool on axis 6")?;
    let q3 = q23 - q2;
    Ok(Lengths { values: [a1, a2, b, c1, c2, c3, c4], offsets: [q1, q2, q3, q4, q5, q6].map(|q| -q), signs })
}

/// The point of the first line that is nearest to the second one; `None` for parallel lines.
fn meeting(p: &Vector<f64>, u: &Vector<f64>, q: &Vector<f64>, v: &Vector<f64>) -> Option<Vector<f64>> {
    let between: Vector<f64> = std::array::from_fn(|i| q[i] - p[i]);
    let cosine = dot(u, v);
    let below = 1.0 - cosine * cosine;
    let along = (dot(&between, u) - cosine * dot(&between, v)) / below;
    (below > OFF).then(|| std::array::from_fn(|i| p[i] + along * u[i]))
}
