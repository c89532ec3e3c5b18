//! A sweep as a picture: every joint variable against the input, one panel each.

use super::sweep::{Swept, input_name, verdict};
use super::text::variables;
use crate::catalogue::entry::Entry;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{Branch, End, Limit, Row, Sweep};
use std::fmt::Write;

/// Width and height of the plane of a panel, in pixels.
const PANEL: [f64; 2] = [360.0, 220.0];
/// Room left of a panel, above, right and below it.
const MARGIN: [f64; 4] = [62.0, 34.0, 22.0, 44.0];
/// Room for the title.
const HEAD: f64 = 58.0;
/// Colours of the circuits, in turn: distinguishable by the colour-blind, dark enough on white (after P. Tol, bright).
pub const COLOURS: [&str; 7] = ["#4477aa", "#cc3311", "#228833", "#aa3377", "#997700", "#33a0c0", "#555555"];
/// Translations outside this many times the middle half of all are cut off: they run to infinity.
const WHISKER: f64 = 4.0;

/// A variable against the input: degrees or metres.
#[derive(Clone, Debug)]
pub struct Graph {
    /// Its name with the unit.
    pub label: String,
    /// Whether it is an angle.
    pub is_turn: bool,
    /// The circuit of every branch, and the points of each of its turns.
    pub lines: Vec<(usize, Vec<Vec<[f64; 2]>>)>,
    /// The limit positions, each with its circuit.
    pub dots: Vec<([f64; 2], usize)>,
}

/// What stands around the graphs.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// The title.
    pub title: &'a str,
    /// The verdict.
    pub verdict: &'a str,
    /// The input with its unit.
    pub input: &'a str,
    /// Whether the input is an angle.
    pub is_turn: bool,
    /// The range of the input.
    pub range: [f64; 2],
}

/// The picture, an SVG document: angles in degrees, lengths in metres, limit positions as dots.
#[must_use]
pub fn svg(entry: &Entry, swept: Swept, sweep: &Sweep) -> String {
    let names = entry.chain().map(variables).unwrap_or_default();
    let (input, unit) = input_name(entry, swept);
    let others = (0..names.len()).filter(|index| names[*index].0 != input);
    let graphs: Vec<Graph> = others.map(|index| graph(sweep, swept, index, &names[index])).collect();
    let range = [sweep.range.from, sweep.range.to].map(|x| shown(x, swept.variable));
    let frame = Frame {
        title: &entry.title,
        verdict: &verdict(sweep),
        input: &format!("{input} [{unit}]"),
        is_turn: swept.variable == Variable::Rotation,
        range,
    };
    graphs_svg(&frame, &graphs)
}

/// The graphs side by side, three in a row.
#[must_use]
pub fn graphs_svg(frame: &Frame<'_>, graphs: &[Graph]) -> String {
    let columns = graphs.len().clamp(1, 3);
    let rows = graphs.len().div_ceil(columns);
    let [cell_width, cell_height] = [MARGIN[0] + PANEL[0] + MARGIN[2], MARGIN[1] + PANEL[1] + MARGIN[3]];
    let (width, height) = (cell_width * columns as f64, HEAD + cell_height * rows as f64);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{}</text>\n\
         <text x=\"16\" y=\"46\" fill=\"#444\">{}; one colour for each circuit, dots are limit positions</text>\n",
        escaped(frame.title),
        escaped(frame.verdict),
    );
    for (index, graph) in graphs.iter().enumerate() {
        let (column, row) = (index % columns, index / columns);
        let at = [cell_width * column as f64 + MARGIN[0], HEAD + cell_height * row as f64 + MARGIN[1]];
        let _ = writeln!(text, "<g transform=\"translate({:.0} {:.0})\">", at[0], at[1]);
        Panel::of(graph, frame).draw(&mut text, &graph.label, frame.input);
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}

/// One joint variable of a loop against the input.
fn graph(sweep: &Sweep, swept: Swept, index: usize, name: &(String, Variable)) -> Graph {
    let (input, variable) = (|x: f64| shown(x, swept.variable), name.1);
    let at = |limit: &Limit| [input(limit.input), shown(limit.q[index], variable)];
    let line = |branch: &Branch| {
        let limit = |end: &End| match end {
            End::Limit(limit) => Some(at(&sweep.limits[*limit])),
            _ => None,
        };
        // The turns of a branch that runs on over a full turn lie over each other.
        let turns = branch.rows.iter().map(|row| row.turn).max().unwrap_or(0);
        let points = |turn: usize| {
            let rows = branch.rows.iter().filter(|row| row.turn == turn);
            let point = |row: &Row| {
                let sample = &sweep.samples[row.step];
                [input(sample.input), shown(sample.modes[row.mode][index], variable)]
            };
            let first = if turn == 0 { limit(&branch.begin) } else { None };
            let last = if turn == turns { limit(&branch.end) } else { None };
            first.into_iter().chain(rows.map(point)).chain(last).collect()
        };
        (branch.circuit, (0..=turns).map(points).collect())
    };
    let circuit = |limit: &Limit| limit.branches.first().map_or(1, |branch| sweep.branches[*branch].circuit);
    Graph {
        label: labelled(name),
        is_turn: variable == Variable::Rotation,
        lines: sweep.branches.iter().map(line).collect(),
        dots: sweep.limits.iter().map(|limit| (at(limit), circuit(limit))).collect(),
    }
}

fn labelled((name, variable): &(String, Variable)) -> String {
    format!("{name} [{}]", if *variable == Variable::Rotation { "deg" } else { "m" })
}

/// Text as SVG and HTML write it, in elements and in attributes.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn shown(x: f64, variable: Variable) -> f64 {
    if variable == Variable::Rotation { x.to_degrees() } else { x }
}

/// A line of one branch: its colour and its points, broken where an angle passes 180 degrees.
struct Line {
    colour: &'static str,
    pieces: Vec<Vec<[f64; 2]>>,
}

/// One joint variable against the input.
struct Panel {
    x: [f64; 2],
    y: [f64; 2],
    is_turn: [bool; 2],
    lines: Vec<Line>,
    dots: Vec<([f64; 2], &'static str)>,
}

impl Panel {
    fn of(graph: &Graph, frame: &Frame<'_>) -> Self {
        let mut x = frame.range;
        x.sort_by(f64::total_cmp);
        let colour = |circuit: usize| COLOURS[(circuit.max(1) - 1) % COLOURS.len()];
        let line = |(circuit, turns): &(usize, Vec<Vec<[f64; 2]>>)| {
            let pieces = turns.iter().flat_map(|points| unbroken(points.iter().copied(), graph.is_turn)).collect();
            Line { colour: colour(*circuit), pieces }
        };
        let lines: Vec<Line> = graph.lines.iter().map(line).collect();
        let dots: Vec<([f64; 2], &'static str)> =
            graph.dots.iter().map(|(dot, circuit)| (*dot, colour(*circuit))).collect();
        let y = if graph.is_turn { [-180.0, 180.0] } else { extent(&lines, &dots) };
        Self { x, y, is_turn: [frame.is_turn, graph.is_turn], lines, dots }
    }

    /// Returns the place of a point on the plane of the panel.
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        // Points far beyond the frame are invisible, and browsers cannot handle huge numbers.
        [PANEL[0] * part(x, self.x), (PANEL[1] * (1.0 - part(y, self.y))).clamp(-9e3, 9e3)]
    }

    fn draw(&self, text: &mut String, label: &str, input: &str) {
        let [width, height] = PANEL;
        let _ = writeln!(
            text,
            "<text x=\"0\" y=\"-10\" font-weight=\"bold\">{}</text>\n\
             <text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#444\">{}</text>",
            escaped(label),
            width / 2.0,
            height + 36.0,
            escaped(input),
        );
        for x in ticks(self.x, self.is_turn[0]) {
            let [at, _] = self.place([x, self.y[0]]);
            let _ = writeln!(
                text,
                "<path d=\"M{at:.1} 0V{height}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"{at:.1}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>",
                height + 18.0,
                tick_text(x),
            );
        }
        for y in ticks(self.y, self.is_turn[1]) {
            let [_, at] = self.place([self.x[0], y]);
            let _ = writeln!(
                text,
                "<path d=\"M0 {at:.1}H{width}\" stroke=\"#e4e4e4\"/>\
                 <text x=\"-6\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                at + 4.0,
                tick_text(y),
            );
        }
        // A frame of its own that cuts off what runs to infinity.
        let _ = writeln!(text, "<svg width=\"{width}\" height=\"{height}\" overflow=\"hidden\">");
        for line in &self.lines {
            let mut path = String::new();
            for piece in line.pieces.iter().filter(|piece| piece.len() > 1) {
                for (index, point) in piece.iter().enumerate() {
                    let [x, y] = self.place(*point);
                    let _ = write!(path, "{}{x:.1} {y:.1}", if index == 0 { "M" } else { "L" });
                }
            }
            if !path.is_empty() {
                let colour = line.colour;
                let _ = writeln!(text, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>");
            }
        }
        text.push_str("</svg>\n");
        for (dot, colour) in &self.dots {
            let [x, y] = self.place(*dot);
            if (0.0..=height).contains(&y) {
                let _ =
                    writeln!(text, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.4\" fill=\"{colour}\" stroke=\"#fff\"/>");
            }
        }
        let _ = writeln!(text, "<rect width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#888\"/>");
    }
}

/// The points in pieces between which an angle passes 180 degrees; each piece runs on to the edge.
fn unbroken(points: impl Iterator<Item = [f64; 2]>, is_turn: bool) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    for point in points {
        let last = pieces.last().and_then(|piece| piece.last()).copied();
        match (last, pieces.last_mut()) {
            (Some(last), Some(piece)) if is_turn && (point[1] - last[1]).abs() > 180.0 => {
                let turn = if point[1] > last[1] { -360.0 } else { 360.0 };
                piece.push([point[0], point[1] + turn]);
                pieces.push(vec![[last[0], last[1] - turn], point]);
            }
            (_, Some(piece)) => piece.push(point),
            (_, None) => pieces.push(vec![point]),
        }
    }
    pieces
}

/// The range of a length: all limit positions, and all values but those on their way to infinity.
fn extent(lines: &[Line], dots: &[([f64; 2], &str)]) -> [f64; 2] {
    let values = lines.iter().flat_map(|line| line.pieces.iter().flatten()).map(|p| p[1]);
    range(values.chain(dots.iter().map(|(dot, _)| dot[1])).collect())
}

/// The range of lengths without those on their way to infinity, and some room.
#[must_use]
pub fn range(mut values: Vec<f64>) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return [-1.0, 1.0] };
    let quartile = |part: usize| values[(values.len() - 1) * part / 4];
    let room = WHISKER * (quartile(3) - quartile(1));
    let (low, high) = (first.max(quartile(1) - room), last.min(quartile(3) + room));
    let margin = (0.05 * (high - low)).max(1e-3 * high.abs()).max(1e-9);
    [low - margin, high + margin]
}

/// Some five round numbers within a range; of angles parts of a turn.
#[must_use]
pub fn ticks([low, high]: [f64; 2], is_angle: bool) -> Vec<f64> {
    const ANGLES: [f64; 7] = [90.0, 45.0, 30.0, 15.0, 5.0, 1.0, 0.2];
    let span = high - low;
    let decade = 10f64.powf((span / 5.0).log10().floor());
    let decimal = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * decade).find(|step| span / step <= 6.0);
    let angle = ANGLES.into_iter().find(|step| span / step >= 3.0).filter(|_| is_angle);
    let step = angle.or(decimal).unwrap_or(span);
    let first = (low / step - 1e-9).ceil();
    (0..12).map(|k| (first + f64::from(k)) * step).take_while(|x| *x <= high + 1e-9 * span).collect()
}

/// A number beside a tick.
#[must_use]
pub fn tick_text(x: f64) -> String {
    // Adding 0 turns the negative zero into the positive one.
    let rounded = format!("{:.6}", x + 0.0);
    let short = rounded.trim_end_matches('0').trim_end_matches('.');
    short.replace('-', "\u{2212}")
}
