//! A sweep as a picture: every joint variable against the input, in SVG.

use super::sweep::{Swept, input_name};
use super::text::variables;
use crate::catalogue::entry::Entry;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{Branch, End, Sweep};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Width of the plots, height of each, and the room left of and between them, in pixels.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 150.0;
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 64.0;
const GAP: f64 = 26.0;
const BOTTOM: f64 = 52.0;
/// Colours of the circuits, told apart by colour-blind readers too.
const COLOURS: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#8c6d31"];

/// An axis: what is shown from where to where, at which values it is marked, and its pixels.
struct Axis {
    low: f64,
    high: f64,
    ticks: Vec<f64>,
    pixels: [f64; 2],
}

impl Axis {
    /// An axis for these values, with marks at round numbers.
    fn new(low: f64, high: f64, is_angle: bool, pixels: [f64; 2]) -> Self {
        let span = (high - low).max(f64::MIN_POSITIVE);
        let step = if is_angle {
            [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0].into_iter().find(|step| span / step <= 8.0).unwrap_or(90.0)
        } else {
            let power = 10_f64.powf((span / 6.0).log10().floor());
            [1.0, 2.0, 5.0].into_iter().map(|k| k * power).find(|step| span / step <= 6.0).unwrap_or(10.0 * power)
        };
        let first = (low / step - 1e-9).ceil();
        let count = ((high / step + 1e-9).floor() - first).clamp(0.0, 64.0);
        let ticks = (0..64).map(f64::from).take_while(|k| *k <= count).map(|k| (first + k) * step).collect();
        Self { low, high, ticks, pixels }
    }

    fn pixel(&self, value: f64) -> f64 {
        let [from, to] = self.pixels;
        from + (to - from) * (value - self.low) / (self.high - self.low)
    }
}

/// Angles in degrees, lengths as they are.
fn shown(x: f64, variable: Variable) -> f64 {
    if variable == Variable::Rotation { x.to_degrees() } else { x }
}

fn unit(variable: Variable) -> &'static str {
    if variable == Variable::Rotation { "deg" } else { "m" }
}

/// A number at a mark: no more digits than it needs.
fn label(x: f64) -> String {
    let text = format!("{:.6}", if x.abs() < 1e-9 { 0.0 } else { x });
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// An input brought into the range by whole turns.
fn reduced(input: f64, swept: Swept, sweep: &Sweep) -> f64 {
    let [low, high] = [sweep.range.from.min(sweep.range.to), sweep.range.from.max(sweep.range.to)];
    if swept.variable == Variable::Translation || (low..=high).contains(&input) {
        return input;
    }
    let turned = input - TAU * ((input - low) / TAU).floor();
    if turned <= high { turned } else { input }
}

/// The points of a branch, each with the value of one joint variable; limit positions at its ends included.
fn points(sweep: &Sweep, branch: &Branch, index: usize, swept: Swept) -> Vec<(f64, f64)> {
    let limit = |end: &End| match end {
        End::Limit(limit) => {
            let limit = &sweep.limits[*limit];
            Some((reduced(limit.input, swept, sweep), limit.q[index]))
        }
        _ => None,
    };
    let rows = branch.rows.iter().map(|row| {
        let sample = &sweep.samples[row.step];
        (sample.input, sample.modes[row.mode][index])
    });
    limit(&branch.begin).into_iter().chain(rows).chain(limit(&branch.end)).collect()
}

/// A path through points in pixels, broken where the input begins anew, and led over the edge where an angle passes 180
/// degrees.
fn path(points: &[(f64, f64)], variable: Variable, jump: f64, x: &Axis, y: &Axis) -> String {
    let mut path = String::new();
    let mut to = |command: char, px: f64, py: f64| {
        let _ = write!(path, "{command}{:.2} {:.2}", x.pixel(px), y.pixel(py));
    };
    let mut last: Option<(f64, f64)> = None;
    for &(px, py) in points {
        match last {
            Some((lx, ly)) if (px - lx).abs() <= jump => {
                if variable == Variable::Rotation && (py - ly).abs() > 180.0 {
                    let edge = if ly > 0.0 { 180.0 } else { -180.0 };
                    let beyond = py + 2.0 * edge;
                    let part = if (beyond - ly).abs() > 0.0 { (edge - ly) / (beyond - ly) } else { 0.0 };
                    let middle = lx + part * (px - lx);
                    to('L', middle, edge);
                    to('M', middle, -edge);
                }
                to('L', px, py);
            }
            _ => to('M', px, py),
        }
        last = Some((px, py));
    }
    path
}

/// The picture of a sweep: one plot for every joint variable but the input, branches in the colour of their circuit, limit
/// positions as circles.
#[must_use]
pub fn svg(entry: &Entry, swept: Swept, sweep: &Sweep) -> String {
    let names = entry.chain().map(variables).unwrap_or_default();
    let (input, _) = input_name(entry, swept);
    let plots: Vec<(usize, &(String, Variable))> =
        names.iter().enumerate().filter(|(_, (name, _))| *name != input).collect();
    let width = LEFT + WIDTH + RIGHT;
    let height = TOP + plots.len() as f64 * (HEIGHT + GAP) - GAP + BOTTOM;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"24\" font-size=\"16\">{}</text>\n<text x=\"{LEFT}\" y=\"44\" fill=\"#555\">{}; \
         circles: limit positions</text>\n",
        escaped(&entry.title),
        super::sweep::verdict(sweep)
    );
    let [from, to] = [sweep.range.from, sweep.range.to].map(|end| shown(end, swept.variable));
    let is_angle = swept.variable == Variable::Rotation;
    let x = Axis::new(from.min(to), from.max(to), is_angle, [LEFT, LEFT + WIDTH]);
    // Neighbouring rows are a step apart, the last ones to a limit position no more.
    let jump = 1.5 * (x.high - x.low) / sweep.range.steps as f64;
    for (plot, (index, (name, variable))) in plots.iter().enumerate() {
        let curves: Vec<(usize, Vec<(f64, f64)>)> = sweep
            .branches
            .iter()
            .map(|branch| {
                let shown_point = |(a, b)| (shown(a, swept.variable), shown(b, *variable));
                (branch.circuit, points(sweep, branch, *index, swept).into_iter().map(shown_point).collect())
            })
            .collect();
        let top = TOP + plot as f64 * (HEIGHT + GAP);
        let y = y_axis(&curves, *variable, [top + HEIGHT, top]);
        frame(&mut out, &x, &y, &format!("{name} [{}]", unit(*variable)), plot + 1 == plots.len());
        for (circuit, points) in &curves {
            let colour = COLOURS[circuit.saturating_sub(1) % COLOURS.len()];
            let path = path(points, *variable, jump, &x, &y);
            let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>");
        }
        for limit in &sweep.limits {
            let at = shown(reduced(limit.input, swept, sweep), swept.variable);
            let (cx, cy) = (x.pixel(at), y.pixel(shown(limit.q[*index], *variable)));
            let circle = "r=\"4\" fill=\"white\" stroke=\"#333\" stroke-width=\"1.2\"";
            let _ = writeln!(out, "<circle cx=\"{cx:.2}\" cy=\"{cy:.2}\" {circle}/>");
        }
    }
    let middle = LEFT + WIDTH / 2.0;
    let (below, unit) = (height - 12.0, unit(swept.variable));
    let _ = writeln!(out, "<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{input} [{unit}]</text>\n</svg>");
    out
}

/// Angles all round, lengths as far as they go.
fn y_axis(curves: &[(usize, Vec<(f64, f64)>)], variable: Variable, pixels: [f64; 2]) -> Axis {
    if variable == Variable::Rotation {
        return Axis { low: -180.0, high: 180.0, ticks: vec![-180.0, -90.0, 0.0, 90.0, 180.0], pixels };
    }
    let values = || curves.iter().flat_map(|(_, points)| points.iter().map(|(_, y)| *y));
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    if low > high {
        return Axis::new(-1.0, 1.0, false, pixels);
    }
    let room = 0.06 * (high - low).max(1e-9 * high.abs()).max(1e-12);
    Axis::new(low - room, high + room, false, pixels)
}

/// The frame of a plot, its marks and labels; those of the input below the last one.
fn frame(out: &mut String, x: &Axis, y: &Axis, name: &str, is_last: bool) {
    let [left, right] = x.pixels;
    let [bottom, top] = y.pixels;
    for tick in &x.ticks {
        let at = x.pixel(*tick);
        let _ = writeln!(out, "<path d=\"M{at:.2} {top}V{bottom}\" stroke=\"#e4e4e4\"/>");
        if is_last {
            let below = bottom + 18.0;
            let _ = writeln!(out, "<text x=\"{at:.2}\" y=\"{below}\" text-anchor=\"middle\">{}</text>", label(*tick));
        }
    }
    for tick in &y.ticks {
        let at = y.pixel(*tick);
        let _ = writeln!(out, "<path d=\"M{left} {at:.2}H{right}\" stroke=\"#e4e4e4\"/>");
        let (beside, base) = (left - 8.0, at + 4.0);
        let _ = writeln!(out, "<text x=\"{beside}\" y=\"{base:.2}\" text-anchor=\"end\">{}</text>", label(*tick));
    }
    let _ = writeln!(out, "<path d=\"M{left} {top}H{right}V{bottom}H{left}Z\" fill=\"none\" stroke=\"#888\"/>");
    let middle = f64::midpoint(top, bottom);
    let _ =
        writeln!(out, "<text transform=\"translate(18 {middle}) rotate(-90)\" text-anchor=\"middle\">{name}</text>");
}
