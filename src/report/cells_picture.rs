//! The cells of one or two parameters as a picture.

use super::cells::{map_verdict, verdict};
use super::picture::{escaped, tick_text, ticks};
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{CellMap, Cells, Label};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Width and height of the plane, in pixels.
const PLANE: [f64; 2] = [560.0, 420.0];
/// Room left of the plane, above, right and below it.
const MARGIN: [f64; 4] = [72.0, 76.0, 120.0, 52.0];
/// Colours for 0, 2, 4 ... real modes: from pale to dark, distinguishable by the colour-blind.
const SHADES: [&str; 9] =
    ["#f4f4f4", "#c6dbef", "#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#08519c", "#08306b", "#041c40"];
/// One zero in this many lies outside the window of a length on either side: the outermost ones run to infinity.
const OUTSIDE: usize = 20;

/// The picture of a map, an SVG document: angles in degrees, lengths in metres.
#[must_use]
pub fn map_svg(title: &str, map: &CellMap) -> String {
    let columns: Vec<(f64, &Cells)> =
        map.columns.iter().filter_map(|column| Some((slot(map, column.value), column.cells.as_ref().ok()?))).collect();
    let label = |k: usize| format!("{} [{}]", map.parameters[k], if is_angle(map.kinds[k]) { "deg" } else { "m" });
    let picture = Picture {
        title,
        verdict: map_verdict(map),
        x: map.range,
        y: window(map.kinds[1], columns.iter().map(|(_, cells)| *cells), map.given[1]),
        kinds: map.kinds,
        labels: [label(0), label(1)],
        width: map.width,
        given: map.given[0].zip(map.given[1]).map(|(x, y)| [x, y]),
    };
    picture.svg(&columns)
}

/// The middle of the column of a value, which is no farther from it than an eighth of the width.
fn slot(map: &CellMap, value: f64) -> f64 {
    map.range[0] + (((value - map.range[0]) / map.width).floor() + 0.5) * map.width
}

/// The picture of one parameter: its cells as a bar.
#[must_use]
pub fn svg(title: &str, cells: &Cells) -> String {
    let label = format!("{} [{}]", cells.parameter, if is_angle(cells.kind) { "deg" } else { "m" });
    let picture = Picture {
        title,
        verdict: verdict(cells),
        x: [0.0, 1.0],
        y: window(cells.kind, std::iter::once(cells), cells.given),
        kinds: [Variable::Translation, cells.kind],
        labels: [String::new(), label],
        width: 1.0,
        given: cells.given.map(|y| [0.5, y]),
    };
    picture.svg(&[(0.5, cells)])
}

fn is_angle(kind: Variable) -> bool {
    kind == Variable::Rotation
}

/// Returns the range of the second parameter that is shown: a turn, or the lengths between which most zeros lie.
fn window<'c>(kind: Variable, columns: impl Iterator<Item = &'c Cells>, given: Option<f64>) -> [f64; 2] {
    if is_angle(kind) {
        return [-PI, PI];
    }
    let mut values: Vec<f64> = columns.flat_map(|cells| cells.zeros.iter().map(|zero| zero.value)).collect();
    values.sort_by(f64::total_cmp);
    let cut = values.len() / OUTSIDE;
    let inner = values.get(cut..values.len() - cut).unwrap_or(&[]);
    let all = inner.iter().copied().chain(given);
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return [-1.0, 1.0];
    }
    let margin = (0.1 * (high - low)).max(1e-3 * (1.0 + low.abs()));
    [low - margin, high + margin]
}

fn shade(modes: usize) -> &'static str {
    SHADES[modes.div_ceil(2).min(SHADES.len() - 1)]
}

/// The frame around the columns.
struct Picture<'e> {
    title: &'e str,
    verdict: String,
    x: [f64; 2],
    y: [f64; 2],
    kinds: [Variable; 2],
    labels: [String; 2],
    width: f64,
    given: Option<[f64; 2]>,
}

impl Picture<'_> {
    fn across(&self, x: f64) -> f64 {
        PLANE[0] * (x - self.x[0]) / (self.x[1] - self.x[0])
    }

    fn up(&self, y: f64) -> f64 {
        PLANE[1] * (1.0 - (y - self.y[0]) / (self.y[1] - self.y[0]))
    }

    fn svg(&self, columns: &[(f64, &Cells)]) -> String {
        let (width, height) = (MARGIN[0] + PLANE[0] + MARGIN[2], MARGIN[1] + PLANE[1] + MARGIN[3]);
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
             height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
             <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{}</text>\n\
             <text x=\"16\" y=\"46\" fill=\"#444\">{}</text>\n\
             <g transform=\"translate({:.0} {:.0})\">\n\
             <svg width=\"{}\" height=\"{}\" overflow=\"hidden\">\n",
            escaped(self.title),
            escaped(&self.verdict),
            MARGIN[0],
            MARGIN[1],
            PLANE[0],
            PLANE[1],
        );
        let mut shown: Vec<usize> = Vec::new();
        for (value, cells) in columns {
            self.column(&mut text, *value, cells, &mut shown);
        }
        if let Some([x, y]) = self.given {
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {:.1}m-6 0h12m-6-6v12\" stroke=\"#cc3311\" stroke-width=\"2\"><title>the file</title></path>",
                self.across(x),
                self.up(y)
            );
        }
        let _ = writeln!(
            text,
            "</svg>\n<rect width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>",
            PLANE[0], PLANE[1]
        );
        self.axes(&mut text);
        shown.sort_unstable();
        shown.dedup();
        for (k, modes) in shown.iter().enumerate() {
            let y = 20.0 * k as f64;
            let _ = writeln!(
                text,
                "<rect x=\"{:.0}\" y=\"{y:.0}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"#888\"/>\
                 <text x=\"{:.0}\" y=\"{:.0}\">{modes} real</text>",
                PLANE[0] + 16.0,
                shade(*modes),
                PLANE[0] + 36.0,
                y + 12.0,
            );
        }
        text + "</g>\n</svg>\n"
    }

    fn column(&self, text: &mut String, value: f64, cells: &Cells, shown: &mut Vec<usize>) {
        let left = self.across(value - 0.5 * self.width);
        let width = (self.across(value + 0.5 * self.width) - left).abs() + 0.3;
        let left = left.min(self.across(value + 0.5 * self.width));
        for cell in &cells.cells {
            shown.push(cell.modes);
            for [from, to] in self.pieces(cells.kind, cell.from, cell.to) {
                let (top, bottom) = (self.up(to), self.up(from));
                let _ = writeln!(
                    text,
                    "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
                    bottom - top,
                    shade(cell.modes)
                );
            }
        }
        for zero in &cells.zeros {
            if zero.value < self.y[0] || zero.value > self.y[1] {
                continue;
            }
            let colour = match zero.label {
                Label::Limit => "#000",
                Label::Node => "#228833",
                Label::Isolated => "#aa3377",
                Label::Infinity => "#997700",
                Label::SelfMotion => "#cc3311",
                // Complex modes that meet are no event of a mechanism.
                Label::Complex | Label::Unchanged => continue,
            };
            let _ = writeln!(
                text,
                "<path d=\"M{left:.1} {:.1}h{width:.1}\" stroke=\"{colour}\" stroke-width=\"2\"><title>{}</title></path>",
                self.up(zero.value),
                zero.label.word()
            );
        }
    }

    /// The parts of a cell inside the window.
    fn pieces(&self, kind: Variable, from: Option<f64>, to: Option<f64>) -> Vec<[f64; 2]> {
        let [low, high] = self.y;
        match (kind, from, to) {
            (Variable::Rotation, Some(from), Some(to)) => {
                let width = (to - from).rem_euclid(TAU);
                let width = if width == 0.0 { TAU } else { width };
                let end = from + width;
                if end > PI { vec![[from, high], [low, end - TAU]] } else { vec![[from, end]] }
            }
            (Variable::Rotation, _, _) => vec![self.y],
            (Variable::Translation, from, to) => {
                let from = from.unwrap_or(low).clamp(low, high);
                let to = to.unwrap_or(high).clamp(low, high);
                if from < to { vec![[from, to]] } else { Vec::new() }
            }
        }
    }

    fn axes(&self, text: &mut String) {
        let natural = |k: usize, ends: [f64; 2]| if is_angle(self.kinds[k]) { ends.map(f64::to_degrees) } else { ends };
        let [x, y] = [natural(0, self.x), natural(1, self.y)];
        if !self.labels[0].is_empty() {
            for tick in ticks(x, is_angle(self.kinds[0])) {
                let at = PLANE[0] * (tick - x[0]) / (x[1] - x[0]);
                let _ = writeln!(
                    text,
                    "<text x=\"{at:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
                    PLANE[1] + 18.0,
                    tick_text(tick)
                );
            }
        }
        for tick in ticks(y, is_angle(self.kinds[1])) {
            let at = PLANE[1] * (1.0 - (tick - y[0]) / (y[1] - y[0]));
            let _ =
                writeln!(text, "<text x=\"-6\" y=\"{:.1}\" text-anchor=\"end\">{}</text>", at + 4.0, tick_text(tick));
        }
        let _ = writeln!(
            text,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#444\">{}</text>\n\
             <text x=\"0\" y=\"-6\" fill=\"#444\">{}</text>",
            PLANE[0] / 2.0,
            PLANE[1] + 38.0,
            escaped(&self.labels[0]),
            escaped(&self.labels[1]),
        );
    }
}
