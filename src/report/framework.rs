//! The mobility of a framework as text and JSON.

use super::document;
use super::json::number;
use super::mobility::of_document;
use super::model;
use super::number::{at_most, counted, short};
use super::table::{Columns, paragraph};
use crate::catalogue::FrameworkFile;
use crate::kinematics::framework::flex::Flex;
use crate::kinematics::framework::{Mobility, Proof, SliceKind, Verdict};
use serde_json::{Value, json};
use std::fmt::Write;

/// `mobile: 1 degree of freedom (Maxwell's count 0), infinitesimally 1; proof: proved`
#[must_use]
pub fn verdict(answer: &Mobility) -> String {
    let what = match (&answer.verdict, answer.freedom()) {
        (Verdict::Rigid, _) => "rigid".to_owned(),
        (Verdict::Shaky(order), _) => format!("shaky: infinitesimally mobile only, rigid in order {order}"),
        (Verdict::Mobile, (least, most)) if least == most => format!("mobile: mobility {least}"),
        (Verdict::Mobile, (least, most)) => format!("mobile: mobility {least} to {most}"),
    };
    let (maxwell, infinitesimal) = (answer.count.2, answer.infinitesimal);
    let proof = proof_word(answer);
    format!("{what} (Maxwell's count {maxwell}), {} to first order; proof: {proof}", counted(infinitesimal, "motion"))
}

fn proof_word(answer: &Mobility) -> &'static str {
    if answer.is_proved() { "proved" } else { "none" }
}

/// Why the verdict is right, or what it rests on.
fn reason(file: &FrameworkFile, answer: &Mobility) -> String {
    let name = |vertex: &usize| file.names.get(*vertex).cloned().unwrap_or_default();
    match &answer.proof {
        Proof::Rank => "the rigidity matrix has full rank over the rationals".to_owned(),
        Proof::Slice(slice) => {
            let of = match slice.kind {
                SliceKind::All => "all realisations".to_owned(),
                SliceKind::HalfTurn => "the realisations with the same half-turn".to_owned(),
                SliceKind::Reflection => "the realisations with the same plane of symmetry".to_owned(),
                SliceKind::Inversion => "the realisations with the same centre of symmetry".to_owned(),
                SliceKind::Isometry => "the realisations with the same symmetry of finite order".to_owned(),
                SliceKind::Group(order) => format!("the realisations with the same group of {order} symmetries"),
                SliceKind::Affine => {
                    "the affine images of the realisation (the directions of all bars are on one conic at infinity)".to_owned()
                }
            };
            let (dimension, conditions, rigid) = (slice.dimension, slice.conditions, slice.rigid);
            format!(
                "{of} are a linear space of dimension {dimension}, on which the lengths are {}, independent to first order; \
                 {rigid} dimensions are motions of the whole: {dimension} - {conditions} - {rigid} = {}",
                counted(conditions, "condition"),
                slice.mobility()
            )
        }
        Proof::Planes(least) => format!(
            "the vertices lie in two perpendicular planes, every bar joining one with the other: the places along the line in which the \
             planes meet are stretched, x to a x + b in one plane and to x/a + c in the other, and the heights over the line take up \
             the change; {least} dimensions of this are no motions of the whole"
        ),
        Proof::Octahedron([a, b]) => format!(
            "an octahedron: the dihedral angles about its diagonal {} {} close for every length of it, an identity of polynomials \
             over the rationals",
            name(a),
            name(b)
        ),
        Proof::NoDiagonal => {
            "an octahedron: the closure of the dihedral angles about each of its three diagonals is no identity, so that none can \
             change"
                .to_owned()
        }
        Proof::Parts(parts) => {
            let list = parts.iter().map(|part| part.iter().map(name).collect::<Vec<_>>().join(" ")).collect::<Vec<_>>();
            format!(
                "with the distance {} held as it is, the framework is made of parts that share it: octahedra whose dihedral angle \
                 there changes (an identity of polynomials over the rationals), and bodies; {}",
                list.first().cloned().unwrap_or_default(),
                list[1..].join("; ")
            )
        }
        Proof::Cycle => "two octahedra and a bar about a pair of vertices: neither its distance nor that of any other two vertices can \
                         change, by the closures of both octahedra"
            .to_owned(),
        Proof::Order(order) => format!("the lengths cannot be kept in order {order} of the only first-order motion"),
        Proof::Series(order, most) => format!(
            "all lengths are kept through order {order} over the rationals, and no isolated realisation is more than {most}-fold"
        ),
        Proof::None(Some(order)) => {
            format!("lengths are kept through order {order} over the rationals and in f64 along the motion: evidence, no proof")
        }
        Proof::None(None) => "seen in f64: evidence, no proof".to_owned(),
    }
}

/// Verdict, reason, counts and what was seen of the motion.
#[must_use]
pub fn text(file: &FrameworkFile, answer: &Mobility) -> String {
    let mut text = verdict(answer) + "\n";
    paragraph(&mut text, &reason(file, answer));
    let (vertices, bars, maxwell) = answer.count;
    let _ = writeln!(
        text,
        "{}, {}: 3 x {vertices} - 6 - {bars} = {maxwell}; rank of the rigidity matrix {}",
        counted(vertices, "free vertex").replace("vertexs", "vertices"),
        counted(bars, "bar"),
        answer.rank
    );
    if let Some(flex) = &answer.flex {
        text.push('\n');
        text += &seen(flex);
    }
    text
}

/// Describes the motion found in f64.
fn seen(flex: &Flex) -> String {
    let steps = flex.positions.len() - 1;
    if steps == 0 {
        return "no motion found in f64\n".to_owned();
    }
    let (least, most) = flex.freedom;
    let freedom = if least == most { least.to_string() } else { format!("{least} to {most}") };
    let mut table = Columns::new(&["motion in f64", ""], &["motion in f64"]);
    table.row(["steps".to_owned(), steps.to_string()]);
    table.row(["largest relative error of a length".to_owned(), at_most(flex.residual)]);
    table.row(["motions to first order".to_owned(), freedom]);
    table.row(["largest change of a distance / extent".to_owned(), short(flex.change, 3)]);
    table.text()
}

/// The answer as JSON, with the realisations along the motion.
#[must_use]
pub fn json(file: &FrameworkFile, answer: &Mobility) -> Value {
    let (least, most) = answer.freedom();
    let (vertices, bars, maxwell) = answer.count;
    let flex = answer.flex.as_ref().map(|flex| {
        let position = |framework: &crate::kinematics::framework::Framework<f64>| -> Value {
            framework.vertices.iter().map(|v| v.iter().map(|x| number(*x)).collect::<Value>()).collect()
        };
        json!({
            "steps": flex.positions.len() - 1,
            "residual": number(flex.residual),
            "infinitesimal": [flex.freedom.0, flex.freedom.1],
            "change": number(flex.change),
            "positions": flex.positions.iter().map(position).collect::<Vec<_>>(),
        })
    });
    let shaky = if let Verdict::Shaky(order) = answer.verdict { Some(order) } else { None };
    json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": document::units(),
        "joint_variables": [],
        "mechanism": model::framework_json(file),
        "title": file.heading.title,
        "kind": "framework",
        "verdict": of_document(&verdict(answer), most == 0),
        "mobility": if least == most { json!(least) } else { json!([least, most]) },
        "maxwell": maxwell,
        "free_vertices": vertices,
        "bars": bars,
        "rank": answer.rank,
        "infinitesimal": answer.infinitesimal,
        "proof": proof_word(answer),
        "shaky": shaky.is_some(),
        "stops_in_order": shaky,
        "reason": reason(file, answer),
        "vertices": file.names,
        "flex": flex,
    })
}
