//! A sweep as a picture: every joint variable against the input, one panel each.

use super::sweep::{Swept, input_name, verdict};
use super::text::variables;
use crate::catalogue::entry::Entry;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{Branch, End, Row, Sweep};
use std::fmt::Write;

/// Width and height of the plane of a panel, in pixels.
const PANEL: [f64; 2] = [360.0, 220.0];
/// Room left of a panel, above, right and below it.
const MARGIN: [f64; 4] = [62.0, 34.0, 22.0, 44.0];
/// Room for the title.
const HEAD: f64 = 58.0;
/// One colour for each circuit, in turn; told apart by the colour-blind, dark enough on white (after P. Tol, bright).
pub const COLOURS: [&str; 7] = ["#4477aa", "#cc3311", "#228833", "#aa3377", "#997700", "#33a0c0", "#555555"];
/// Translations outside this many times the middle half of all are cut off: they run to infinity.
const WHISKER: f64 = 4.0;

/// The picture, an SVG document: angles in degrees, lengths in metres, limit positions as dots.
#[must_use]
pub fn svg(entry: &Entry, swept: Swept, sweep: &Sweep) -> String {
    let names = entry.chain().map(variables).unwrap_or_default();
    let (input, unit) = input_name(entry, swept);
    let panels: Vec<Panel> = (0..names.len())
        .filter(|index| names[*index].0 != input)
        .map(|index| Panel::of(sweep, swept, index, names[index].1))
        .collect();
    let columns = panels.len().clamp(1, 3);
    let rows = panels.len().div_ceil(columns);
    let [cell_width, cell_height] = [MARGIN[0] + PANEL[0] + MARGIN[2], MARGIN[1] + PANEL[1] + MARGIN[3]];
    let (width, height) = (cell_width * columns as f64, HEAD + cell_height * rows as f64);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{}</text>\n\
         <text x=\"16\" y=\"46\" fill=\"#444\">{}; one colour for each circuit, dots are limit positions</text>\n",
        escaped(&entry.title),
        escaped(&verdict(sweep)),
    );
    let labelled: Vec<String> = names.iter().filter(|(name, _)| *name != input).map(labelled).collect();
    for (index, (panel, label)) in panels.iter().zip(&labelled).enumerate() {
        let (column, row) = (index % columns, index / columns);
        let at = [cell_width * column as f64 + MARGIN[0], HEAD + cell_height * row as f64 + MARGIN[1]];
        let _ = writeln!(text, "<g transform=\"translate({:.0} {:.0})\">", at[0], at[1]);
        panel.draw(&mut text, label, &format!("{input} [{unit}]"));
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
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
    fn of(sweep: &Sweep, swept: Swept, index: usize, variable: Variable) -> Self {
        let input = |x: f64| shown(x, swept.variable);
        let mut x = [input(sweep.range.from), input(sweep.range.to)];
        x.sort_by(f64::total_cmp);
        let colour = |branch: &Branch| COLOURS[(branch.circuit.max(1) - 1) % COLOURS.len()];
        let mut lines = Vec::new();
        for branch in &sweep.branches {
            let limit = |end: &End| match end {
                End::Limit(limit) => {
                    let limit = &sweep.limits[*limit];
                    Some([input(limit.input), shown(limit.q[index], variable)])
                }
                _ => None,
            };
            // The turns of a branch that runs on over a full turn lie over each other.
            let turns = branch.rows.iter().map(|row| row.turn).max().unwrap_or(0);
            let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
            for turn in 0..=turns {
                let rows = branch.rows.iter().filter(|row| row.turn == turn);
                let point = |row: &Row| {
                    let sample = &sweep.samples[row.step];
                    [input(sample.input), shown(sample.modes[row.mode][index], variable)]
                };
                let first = if turn == 0 { limit(&branch.begin) } else { None };
                let last = if turn == turns { limit(&branch.end) } else { None };
                let points = first.into_iter().chain(rows.map(point)).chain(last);
                pieces.extend(unbroken(points, variable));
            }
            lines.push(Line { colour: colour(branch), pieces });
        }
        let dots = sweep.limits.iter().map(|limit| {
            let own = limit.branches.first().map_or(COLOURS[0], |branch| colour(&sweep.branches[*branch]));
            ([input(limit.input), shown(limit.q[index], variable)], own)
        });
        let is_turn = [swept.variable == Variable::Rotation, variable == Variable::Rotation];
        let dots: Vec<([f64; 2], &'static str)> = dots.collect();
        let y = if is_turn[1] { [-180.0, 180.0] } else { extent(&lines, &dots) };
        Self { x, y, is_turn, lines, dots }
    }

    /// Where a point lies on the plane of the panel.
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        // Far beyond the frame nothing is seen, and browsers dislike huge numbers.
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
fn unbroken(points: impl Iterator<Item = [f64; 2]>, variable: Variable) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    for point in points {
        let last = pieces.last().and_then(|piece| piece.last()).copied();
        match (last, pieces.last_mut()) {
            (Some(last), Some(piece)) if variable == Variable::Rotation && (point[1] - last[1]).abs() > 180.0 => {
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
