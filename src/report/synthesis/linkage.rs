//! Dyads of a synthesis put together: a linkage file.

use crate::catalogue::{AnglePair, DyadKind, Space, SynthesisFile, Task};
use crate::error::{Error, Result};
use crate::kinematics::motion::Motion;
use crate::synthesis::path::{NAMES, moving, pivots};
use crate::synthesis::{Answer, Dyad};
use rug::Rational;
use std::fmt::Write;

/// Names of the ground points and of the body points of the dyads, in their order: those of a four-bar for the first two.
const JOINTS: [[&str; 2]; 6] = [["A", "B"], ["D", "C"], ["G", "E"], ["K", "H"], ["M", "L"], ["P", "N"]];

/// The joints and bodies of a file in the making.
struct Making {
    joints: Vec<String>,
    frame: Vec<String>,
    coupler: Vec<String>,
    links: Vec<String>,
    /// The joint of the ground in the first dyad, the key of its value, and the value in each position.
    input: Option<(String, &'static str, Vec<f64>)>,
}

/// The linkage of these dyads, counted from 0, or the four-bar of this number, as a mechanism file of kind `linkage`. Its inputs
/// are the positions in their order. Numbers have 17 digits: the linkage takes the positions to their rounding.
///
/// # Errors
/// For numbers that are those of no real dyad, for dyads in space, and for more dyads than six.
pub fn toml(file: &SynthesisFile, answer: &Answer, numbers: &[usize]) -> Result<String> {
    let mut dyads = Vec::new();
    for (k, number) in numbers.iter().enumerate() {
        let real = answer.modes.get(*number).filter(|mode| mode.is_real && mode.is_certified());
        let Some(mode) = real else {
            let count = answer.modes.iter().filter(|mode| mode.is_real).count();
            let message = format!(
                "found {} in --linkage, expected numbers of real solutions, of which there are {count}",
                number + 1
            );
            return Err(Error::Invalid(message));
        };
        if numbers[..k].contains(number) {
            return Err(Error::Invalid(format!("found {} in --linkage twice, expected different numbers", number + 1)));
        }
        dyads.push(&mode.dyad);
    }
    let mut making =
        Making { joints: Vec::new(), frame: Vec::new(), coupler: Vec::new(), links: Vec::new(), input: None };
    match (&file.task, file.space) {
        (Task::Function(pairs), _) => {
            let [dyad] = dyads.as_slice() else {
                return Err(Error::Invalid(format!(
                    "found {} numbers in --linkage, expected one four-bar",
                    dyads.len()
                )));
            };
            making.four_bar(dyad, pairs);
        }
        (Task::Path(points), _) => {
            let [dyad] = dyads.as_slice() else {
                return Err(Error::Invalid(format!(
                    "found {} numbers in --linkage, expected one four-bar",
                    dyads.len()
                )));
            };
            making.coupler_curve(dyad, points);
        }
        (Task::Motion(..), Space::Space) => {
            return Err(Error::Unsupported("linkages of dyads in space are not written as files".to_owned()));
        }
        (Task::Motion(kind, positions), space) => {
            if !(2..=JOINTS.len()).contains(&dyads.len()) {
                let message = format!("found {} dyads in --linkage, expected 2 to {}", dyads.len(), JOINTS.len());
                return Err(Error::Invalid(message));
            }
            for (dyad, names) in dyads.iter().zip(JOINTS) {
                making.dyad(*kind, space, dyad, names, positions);
            }
        }
    }
    Ok(making.written(file, numbers))
}

/// A number with all its digits.
fn digits(x: f64) -> String {
    format!("{x:?}")
}

fn list(numbers: &[f64]) -> String {
    format!("[{}]", numbers.iter().map(|x| digits(*x)).collect::<Vec<_>>().join(", "))
}

fn float(motion: &Motion<Rational>) -> Motion<f64> {
    let row = |row: &[Rational; 3]| row.each_ref().map(Rational::to_f64);
    Motion { rotation: motion.rotation.each_ref().map(row), translation: row(&motion.translation) }
}

fn three(numbers: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
}

impl Making {
    fn joint(&mut self, name: &str, kind: &str, of: [&str; 2], more: &str) {
        self.joints.push(format!(
            "    {{ name = \"{name}\", type = \"{kind}\", of = [\"{}\", \"{}\"]{more} }},",
            of[0], of[1]
        ));
    }

    fn dyad(
        &mut self,
        kind: DyadKind,
        space: Space,
        dyad: &Dyad,
        [ground, body]: [&str; 2],
        positions: &[Motion<Rational>],
    ) {
        let link = format!("link_{ground}");
        let (fixed, moving) = (dyad.real("fixed"), dyad.real("moving"));
        let motions: Vec<Motion<f64>> = positions.iter().map(float).collect();
        let values: (&'static str, Vec<f64>) = match (kind, space) {
            (_, Space::Sphere) => {
                let angle = dyad.real("angle").first().copied().unwrap_or(0.0);
                let zero = perpendicular(&three(&fixed));
                let other = [zero, [0.0, 0.0, 1.0]].map(|v| list(&v));
                self.joint(
                    ground,
                    "R",
                    ["frame", &link],
                    &format!(", zero = [{}, {}]", other[0], list(&[1.0, 0.0, 0.0])),
                );
                self.joint(body, "R", [&link, "coupler"], "");
                self.frame.push(format!("{ground} = {}", list(&fixed)));
                self.links.push(format!(
                    "{link} = {{ {ground} = {}, {body} = {} }}",
                    other[1],
                    list(&[angle.sin(), 0.0, angle.cos()])
                ));
                self.coupler.push(format!("{body} = {}", list(&moving)));
                (
                    "angle",
                    motions.iter().map(|motion| about(&three(&fixed), &zero, &motion.apply(&three(&moving)))).collect(),
                )
            }
            (DyadKind::PR, _) => {
                let (normal, distance) = (dyad.real("fixed.normal"), dyad.real("fixed.distance"));
                let (normal, distance) = (three(&normal), distance.first().copied().unwrap_or(0.0));
                let along = [-normal[1], normal[0]];
                self.joint(ground, "P", ["frame", &link], &format!(", along = {}", list(&along)));
                self.joint(body, "R", [&link, "coupler"], "");
                self.frame.push(format!("{ground} = {}", list(&[normal[0] * distance, normal[1] * distance])));
                self.links.push(format!("{link} = {{ {ground} = [0, 0], {body} = [0, 0] }}"));
                self.coupler.push(format!("{body} = {}", list(&moving)));
                let slide = |motion: &Motion<f64>| {
                    let at = motion.apply(&three(&moving));
                    along[0] * at[0] + along[1] * at[1]
                };
                ("distance", motions.iter().map(slide).collect())
            }
            (DyadKind::RP, _) => {
                let (normal, distance) = (dyad.real("moving.normal"), dyad.real("moving.distance"));
                let (normal, distance) = (three(&normal), distance.first().copied().unwrap_or(0.0));
                self.joint(ground, "R", ["frame", &link], "");
                self.joint(body, "P", [&link, "coupler"], &format!(", along = {}", list(&[-normal[1], normal[0]])));
                self.frame.push(format!("{ground} = {}", list(&fixed)));
                self.links.push(format!("{link} = {{ {ground} = [0, 0], {body} = [0, 0] }}"));
                self.coupler.push(format!("{body} = {}", list(&[normal[0] * distance, normal[1] * distance])));
                ("angle", motions.iter().map(|motion| motion.rotation[1][0].atan2(motion.rotation[0][0])).collect())
            }
            _ => {
                let length = dyad.real("length").first().copied().unwrap_or(0.0);
                self.joint(ground, "R", ["frame", &link], "");
                self.joint(body, "R", [&link, "coupler"], "");
                self.frame.push(format!("{ground} = {}", list(&fixed)));
                self.links.push(format!("{link} = {{ {ground} = 0, {body} = {} }}", digits(length)));
                self.coupler.push(format!("{body} = {}", list(&moving)));
                let angle = |motion: &Motion<f64>| {
                    let at = motion.apply(&three(&moving));
                    (at[1] - three(&fixed)[1]).atan2(at[0] - three(&fixed)[0])
                };
                ("angle", motions.iter().map(angle).collect())
            }
        };
        if self.input.is_none() {
            self.input = Some((ground.to_owned(), values.0, values.1));
        }
    }

    /// The coupler's origin P is the point that runs through those of the file.
    fn coupler_curve(&mut self, dyad: &Dyad, points: &[[Rational; 2]]) {
        for (joint, of) in [
            ("A", ["frame", "crank"]),
            ("B", ["crank", "coupler"]),
            ("C", ["coupler", "rocker"]),
            ("D", ["frame", "rocker"]),
        ] {
            self.joint(joint, "R", of, "");
        }
        let points: Vec<[f64; 2]> = points.iter().map(|point| point.each_ref().map(Rational::to_f64)).collect();
        let Some(pivots) = pivots(dyad, NAMES[0]) else { return };
        let [a, b, c, d] = &pivots;
        let length = |p: &[f64; 2], q: &[f64; 2]| digits((p[0] - q[0]).hypot(p[1] - q[1]));
        let own = |p: &[f64; 2]| list(&[p[0] - points[0][0], p[1] - points[0][1]]);
        self.frame = vec![format!("A = {}", list(a)), format!("D = {}", list(d))];
        self.coupler = vec![format!("B = {}", own(b)), format!("C = {}", own(c)), "P = [0, 0]".to_owned()];
        self.links = vec![
            format!("crank = {{ A = 0, B = {} }}", length(a, b)),
            format!("rocker = {{ D = 0, C = {} }}", length(d, c)),
        ];
        let angles = moving(&pivots, &points).iter().flatten().map(|[b, _]| (b[1] - a[1]).atan2(b[0] - a[0])).collect();
        self.input = Some(("A".to_owned(), "angle", angles));
    }

    /// Crank and rocker have their zero angles along their x axes, as the pairs of the file have.
    fn four_bar(&mut self, dyad: &Dyad, pairs: &[AnglePair]) {
        for (joint, of) in [("A", ["frame", "crank"]), ("B", ["crank", "coupler"]), ("C", ["coupler", "rocker"])] {
            self.joint(joint, "R", of, "");
        }
        self.joint("D", "R", ["frame", "rocker"], "");
        self.frame = vec!["A = [0, 0]".to_owned(), "D = [1, 0]".to_owned()];
        let coupler = dyad.real("coupler").first().copied().unwrap_or(0.0);
        self.coupler = vec!["B = 0".to_owned(), format!("C = {}", digits(coupler))];
        self.links = vec![
            format!("crank = {{ A = [0, 0], B = {} }}", list(&dyad.real("crank_point"))),
            format!("rocker = {{ D = [0, 0], C = {} }}", list(&dyad.real("rocker_point"))),
        ];
        let angles =
            pairs.iter().map(|AnglePair { angles: [(cos, sin), _], .. }| sin.to_f64().atan2(cos.to_f64())).collect();
        self.input = Some(("A".to_owned(), "angle", angles));
    }

    fn written(self, file: &SynthesisFile, numbers: &[usize]) -> String {
        let title = file.heading.title.replace('\\', "\\\\").replace('"', "\\\"");
        let numbers = numbers.iter().map(|number| (number + 1).to_string()).collect::<Vec<_>>().join(" and ");
        let mut text = format!("title = \"Linkage of: {title}\"\n");
        let _ = writeln!(
            text,
            "notes = \"Solutions {numbers} of a synthesis. The inputs are its positions in their order.\""
        );
        let _ =
            write!(text, "\n[mechanism]\nkind = \"linkage\"\nspace = \"{}\"\nground = \"frame\"\n", file.space.word());
        let _ = write!(text, "joints = [\n{}\n]\n\n[mechanism.bodies]\n", self.joints.join("\n"));
        let _ = writeln!(text, "frame = {{ {} }}", self.frame.join(", "));
        for link in &self.links {
            let _ = writeln!(text, "{link}");
        }
        let _ = writeln!(text, "coupler = {{ {} }}", self.coupler.join(", "));
        if let Some((joint, key, values)) = &self.input {
            for value in values {
                // A bare number is one of radians or metres: the file has no units of its own.
                let _ = write!(text, "\n[[input]]\njoint = \"{joint}\"\n{key} = {}\n", digits(*value));
            }
        }
        text
    }
}

/// A vector of length 1 perpendicular to an axis: along the coordinate axis that is farthest from it.
fn perpendicular(axis: &[f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|j, k| axis[*j].abs().total_cmp(&axis[*k].abs())).unwrap_or(0);
    let mut v: [f64; 3] = std::array::from_fn(|k| -axis[least] * axis[k]);
    v[least] += 1.0;
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// The angle about an axis from one direction to the projection of another.
fn about(axis: &[f64; 3], zero: &[f64; 3], direction: &[f64; 3]) -> f64 {
    let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    let side = crate::kinematics::motion::cross(axis, zero);
    dot(&side, direction).atan2(dot(zero, direction))
}
