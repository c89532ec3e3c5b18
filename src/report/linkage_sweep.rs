//! Sweeps of linkages as text, CSV, JSON and a picture.

pub use super::assembly_sweep::verdict;
use super::assembly_sweep::{self, Input};
use super::document::units;
use super::json::number;
use super::linkage::joint_variables;
use super::model;
use super::number::short;
use super::picture::{COLOURS, Frame, escaped, graphs_svg};
use super::table::Columns;
use crate::catalogue::LinkageFile;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::answer::LinkageMode;
use crate::sweep::{AssemblyBranch, End, LinkageSweep};
use looproot_calculus::line::strip::{Strip, strip};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// A point whose curve is requested.
#[derive(Clone, Debug)]
pub struct Traced {
    /// Its body.
    pub body: usize,
    /// Its name, `BODY.POINT`.
    pub name: String,
    /// Its place in the body.
    pub place: Gaussian,
}

impl Traced {
    /// Its place against the ground, metres.
    #[must_use]
    pub fn at(&self, mode: &LinkageMode) -> [f64; 2] {
        let (angle, origin) = &mode.bodies[self.body];
        let (sin, cos) = angle.re.sin_cos();
        let (x, y) = (self.place.re.to_f64(), self.place.im.to_f64());
        [origin[0].re + cos * x - sin * y, origin[1].re + sin * x + cos * y]
    }
}

/// The input and what is traced.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The file.
    pub file: &'a LinkageFile,
    /// The point.
    pub traced: Option<&'a Traced>,
}

/// Returns the joint that runs.
fn input<'a>(file: &'a LinkageFile, sweep: &LinkageSweep) -> Input<'a> {
    let joint = &file.linkage.joints[sweep.joint];
    Input { title: &file.heading.title, name: &joint.name, is_length: joint.is_prismatic() }
}

/// The verdict, the branches and the limit positions.
#[must_use]
pub fn text(asked: Asked<'_>, sweep: &LinkageSweep) -> String {
    let text = assembly_sweep::text(input(asked.file, sweep), sweep, None);
    text + &asked.traced.map_or(String::new(), |traced| straight(traced, sweep))
}

/// The strips that hold the curves of the point, branch by branch.
fn strips(traced: &Traced, sweep: &LinkageSweep) -> Vec<Option<Strip>> {
    let branch = |branch: &AssemblyBranch| {
        let points = branch.rows.iter().map(|row| traced.at(&sweep.samples[row.step].modes[row.mode]));
        strip(&points.collect::<Vec<_>>())
    };
    sweep.branches.iter().map(branch).collect()
}

/// How straight the curve of the point is, at the inputs of the sweep.
fn straight(traced: &Traced, sweep: &LinkageSweep) -> String {
    let mut table = Columns::new(&["branch", "length [m]", "off a line [m]", "direction [deg]"], &[]);
    for (k, found) in strips(traced, sweep).iter().enumerate() {
        let Some(found) = found else { continue };
        let [x, y] = found.direction;
        // A line has no sense: its direction is in (-90, 90] degrees.
        let (x, y) = if x < 0.0 || (x == 0.0 && y < 0.0) { (-x, -y) } else { (x, y) };
        table.row([
            (k + 1).to_string(),
            short(found.length, 9),
            short(found.deviation, 9),
            short(y.atan2(x).to_degrees(), 6),
        ]);
    }
    format!(
        "\ncurve of {}: its extent along the nearest line, and how far it is off that line at most\n{}",
        traced.name,
        table.text()
    )
}

/// The values of a mode's joints, those that have one.
fn values(file: &LinkageFile, mode: &LinkageMode) -> Vec<(String, f64)> {
    let joints = file.linkage.joints.iter().zip(&mode.joints);
    joints.filter_map(|(joint, value)| Some((joint.name.clone(), value.as_ref()?.re + 0.0))).collect()
}

/// A field of a table with commas.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// One row per branch and step: radians and metres; the columns are the joints and the coordinates of the point.
#[must_use]
pub fn csv(asked: Asked<'_>, sweep: &LinkageSweep) -> String {
    let file = asked.file;
    let mut text = String::from("branch,circuit,turn,step,input,status");
    for joint in file.linkage.joints.iter().filter(|joint| !joint.is_gear()) {
        let _ = write!(text, ",{}", field(&joint.name));
    }
    if let Some(traced) = asked.traced {
        let _ = write!(text, ",{},{}", field(&format!("{}.x", traced.name)), field(&format!("{}.y", traced.name)));
    }
    text.push('\n');
    for (index, branch) in sweep.branches.iter().enumerate() {
        for row in &branch.rows {
            let sample = &sweep.samples[row.step];
            let mode = &sample.modes[row.mode];
            let (number, circuit, status) = (index + 1, branch.circuit, sample.status.word());
            let _ = write!(text, "{number},{circuit},{},{},{},{status}", row.turn, row.step, sample.input);
            for (_, value) in values(file, mode) {
                let _ = write!(text, ",{value}");
            }
            if let Some(traced) = asked.traced {
                let [x, y] = traced.at(mode);
                let _ = write!(text, ",{x},{y}");
            }
            text.push('\n');
        }
    }
    text
}

/// Joints by name, all values in the order of the file, and the point.
fn place(asked: Asked<'_>, mode: &LinkageMode) -> Map<String, Value> {
    let values = values(asked.file, mode);
    let mut object = Map::new();
    object.insert("q".into(), values.iter().map(|(_, x)| number(*x)).collect());
    let joints: Map<String, Value> = values.into_iter().map(|(name, x)| (name, number(x))).collect();
    object.insert("joints".into(), Value::Object(joints));
    if let Some(traced) = asked.traced {
        let mut points = Map::new();
        points.insert(traced.name.clone(), json!(traced.at(mode).map(number)));
        object.insert("points".into(), Value::Object(points));
    }
    object
}

/// The document that equations/sweep.schema.json describes: radians and metres.
#[must_use]
pub fn json(asked: Asked<'_>, sweep: &LinkageSweep) -> Value {
    let file = asked.file;
    let variables = file.linkage.joints.iter().filter(|joint| !joint.is_gear()).map(|joint| joint.name.clone());
    let mut document = json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::linkage_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "variable": file.linkage.joints[sweep.joint].name,
        "variables": variables.collect::<Vec<_>>(),
    });
    assembly_sweep::insert(&mut document, sweep, |mode| place(asked, mode));
    if let Some(traced) = asked.traced {
        let shown = |found: &Strip| {
            json!({
                "direction": found.direction.map(number),
                "point": found.point.map(number),
                "deviation": number(found.deviation),
                "length": number(found.length),
            })
        };
        let branches = strips(traced, sweep);
        document["straight"] = branches.iter().map(|found| found.as_ref().map_or(Value::Null, shown)).collect();
    }
    document
}

/// Every joint against the input, one panel each.
#[must_use]
pub fn joints_svg(file: &LinkageFile, sweep: &LinkageSweep) -> String {
    let joints = &file.linkage.joints;
    let input = input(file, sweep);
    let graph = |joint: usize| {
        let own = Input { title: "", name: &joints[joint].name, is_length: joints[joint].is_prismatic() };
        let point = |x: f64, mode: &LinkageMode| {
            [input.value(x), mode.joints[joint].map_or(f64::NAN, |value| own.value(value.re))]
        };
        assembly_sweep::graph(sweep, format!("{} [{}]", own.name, own.unit()), !own.is_length, point)
    };
    let others = (0..joints.len()).filter(|joint| *joint != sweep.joint && !joints[*joint].is_gear());
    let frame = Frame {
        title: input.title,
        verdict: &verdict(sweep),
        input: &format!("{} [{}]", input.name, input.unit()),
        is_turn: !input.is_length,
        range: [sweep.range.from, sweep.range.to].map(|x| input.value(x)),
    };
    graphs_svg(&frame, &others.map(graph).collect::<Vec<_>>())
}

/// Width and height of the picture, in pixels.
const SIZE: f64 = 640.0;
/// Room on every side.
const MARGIN: f64 = 60.0;

/// The curve of the point: one colour for every circuit, limit positions as dots, both axes in one scale.
#[must_use]
pub fn svg(file: &LinkageFile, traced: &Traced, sweep: &LinkageSweep) -> String {
    let colour = |circuit: usize| COLOURS[(circuit.max(1) - 1) % COLOURS.len()];
    let paths: Vec<(usize, Vec<[f64; 2]>)> = sweep
        .branches
        .iter()
        .map(|branch| {
            let limit = |end: &End| match end {
                End::Limit(limit) => Some(traced.at(&sweep.limits[*limit].mode)),
                _ => None,
            };
            let rows = branch.rows.iter().map(|row| traced.at(&sweep.samples[row.step].modes[row.mode]));
            (branch.circuit, limit(&branch.begin).into_iter().chain(rows).chain(limit(&branch.end)).collect())
        })
        .collect();
    let points = || paths.iter().flat_map(|(_, path)| path);
    let extent = |k: usize| {
        let values = || points().map(move |point| point[k]);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let (x, y) = (extent(0), extent(1));
    let span = (x[1] - x[0]).max(y[1] - y[0]);
    let scale = if span.is_normal() { (SIZE - 2.0 * MARGIN) / span } else { 1.0 };
    let middle = [0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])].map(|m| if m.is_finite() { m } else { 0.0 });
    let at =
        |point: &[f64; 2]| [0.5 * SIZE + scale * (point[0] - middle[0]), 0.5 * SIZE - scale * (point[1] - middle[1])];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE:.0} {SIZE:.0}\" width=\"{SIZE:.0}\" height=\"{SIZE:.0}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{}</text>\n\
         <text x=\"16\" y=\"46\" fill=\"#444\">curve of {}; one colour for each circuit, dots are limit positions</text>\n",
        escaped(&file.heading.title),
        escaped(&traced.name),
    );
    for (circuit, path) in paths.iter().filter(|(_, path)| path.len() > 1) {
        let mut d = String::new();
        for (k, point) in path.iter().enumerate() {
            let [x, y] = at(point);
            let _ = write!(d, "{}{x:.2} {y:.2}", if k == 0 { "M" } else { "L" });
        }
        let _ = writeln!(text, "<path d=\"{d}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>", colour(*circuit));
    }
    for limit in &sweep.limits {
        let [x, y] = at(&traced.at(&limit.mode));
        let circuit = limit.branches.first().map_or(1, |branch| sweep.branches[*branch].circuit);
        let _ = writeln!(
            text,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.4\" fill=\"{}\" stroke=\"#fff\"/>",
            colour(circuit)
        );
    }
    let (x, y) = (x.map(|v| short(v, 6)), y.map(|v| short(v, 6)));
    let _ = writeln!(
        text,
        "<text x=\"16\" y=\"{:.0}\" fill=\"#444\">x from {} to {} m, y from {} to {} m</text>\n</svg>",
        SIZE - 16.0,
        x[0],
        x[1],
        y[0],
        y[1]
    );
    text
}
