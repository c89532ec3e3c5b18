//! Arms as robot descriptions.

use crate::catalogue::entry::Entry;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::motion::Motion;
use crate::report::document;
use std::fmt::Write;

/// The robot description: every joint turns about or slides along the z axis of its frame.
pub(super) fn urdf(entry: &Entry, chain: &Chain) -> Result<String> {
    Layout::of(chain, None)?;
    let (variables, constants) = chain
        .unknowns_and_constants::<f64>()
        .ok_or_else(|| Error::Unsupported("the numbers of this arm are not known well enough".to_owned()))?;
    let mut labels = document::labels(entry);
    for k in 1..labels.len() {
        if labels[..k].contains(&labels[k]) {
            labels[k] = format!("{}_{}", labels[k], k + 1);
        }
    }
    let [base, tip] = entry.labels.links.clone().unwrap_or_else(|| ["base_link".to_owned(), "tool0".to_owned()]);
    let link = |k: usize| if k == 0 { base.clone() } else { format!("{base}_link_{k}") };
    let mut text = format!("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", escaped(&entry.name));
    for k in 0..=variables.len() {
        let _ = writeln!(text, "  <link name=\"{}\"/>", escaped(&link(k)));
    }
    let _ = writeln!(text, "  <link name=\"{}\"/>", escaped(&tip));
    for (k, variable) in variables.iter().enumerate() {
        let limits = entry.limits.get(k).filter(|[low, high]| low.is_finite() && high.is_finite());
        let kind = match (variable, limits) {
            (Variable::Translation, _) => "prismatic",
            (Variable::Rotation, Some(_)) => "revolute",
            (Variable::Rotation, None) => "continuous",
        };
        let [low, high] = limits.copied().unwrap_or([-1e4, 1e4]);
        let _ = writeln!(text, "  <joint name=\"{}\" type=\"{kind}\">", escaped(&labels[k]));
        ends(&mut text, &link(k), &link(k + 1), &constants[k]);
        let _ = writeln!(text, "    <axis xyz=\"0 0 1\"/>");
        if kind != "continuous" {
            let _ = writeln!(text, "    <limit lower=\"{low}\" upper=\"{high}\" effort=\"0\" velocity=\"0\"/>");
        }
        text += "  </joint>\n";
    }
    let _ = writeln!(text, "  <joint name=\"{}\" type=\"fixed\">", escaped(&format!("{tip}_joint")));
    ends(&mut text, &link(variables.len()), &tip, &constants[variables.len()]);
    Ok(text + "  </joint>\n</robot>\n")
}

/// Parent, child and origin of a joint.
fn ends(text: &mut String, parent: &str, child: &str, origin: &Motion<f64>) {
    let words = |v: [f64; 3]| v.map(|x| (x + 0.0).to_string()).join(" ");
    let _ = writeln!(text, "    <parent link=\"{}\"/>\n    <child link=\"{}\"/>", escaped(parent), escaped(child));
    let (xyz, rpy) = (words(origin.translation), words(roll_pitch_yaw(&origin.rotation)));
    let _ = writeln!(text, "    <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>");
}

/// The angles of a rotation `Rz(yaw) Ry(pitch) Rx(roll)`; the yaw is 0 where only the sum or difference with the roll counts.
fn roll_pitch_yaw(r: &[[f64; 3]; 3]) -> [f64; 3] {
    let across = r[0][0].hypot(r[1][0]);
    let pitch = (-r[2][0]).atan2(across);
    if across > 1e-12 {
        [r[2][1].atan2(r[2][2]), pitch, r[1][0].atan2(r[0][0])]
    } else {
        [(-r[1][2]).atan2(r[1][1]), pitch, 0.0]
    }
}

/// A name inside an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
