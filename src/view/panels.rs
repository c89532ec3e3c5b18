//! The panels of a sweep: every joint variable against the input, a path for every branch, a circle for every limit position. The
//! panels of a path of poses: every joint variable against the number of the pose, a circle where a joint jumps.

use super::tracks::{Kind, Track, is_path, list, shown, turns};
use crate::report::picture::{COLOURS, escaped, range, tick_text, ticks};
use serde_json::Value;
use std::fmt::Write;

/// Width and height of the plane of a panel, and the room left of it and below, in pixels.
const PANEL: [f64; 2] = [300.0, 128.0];
const LEFT: f64 = 44.0;
const BELOW: f64 = 22.0;

/// All panels; the input has none.
pub(super) fn panels(document: &Value, tracks: &[Track<'_>]) -> String {
    let swept = document["variable"].as_str().unwrap_or_default();
    let mut text = String::from("<div class=\"panels\">\n");
    for (place, variable) in list(document, "joint_variables").iter().enumerate() {
        if variable["name"] != swept {
            Panel::of(document, tracks, place, variable).write(&mut text);
        }
    }
    text + "</div>\n"
}

/// One joint variable against the input.
struct Panel {
    name: String,
    input: String,
    x: [f64; 2],
    y: [f64; 2],
    is_turn: [bool; 2],
    /// The points of every branch, and its colour.
    lines: Vec<(usize, &'static str, Vec<[f64; 2]>)>,
    dots: Vec<([f64; 2], &'static str)>,
}

/// Lines are left straight where they are nearer than this to the points between, in pixels.
const STRAIGHT: f64 = 0.12;

/// The colour of the circuit of a branch; each branch of a path has its own.
fn colour(branch: &Value) -> &'static str {
    let circuit = branch["circuit"].as_u64().or(branch["branch"].as_u64());
    let circuit = circuit.and_then(|n| usize::try_from(n).ok()).unwrap_or(1);
    COLOURS[circuit.saturating_sub(1) % COLOURS.len()]
}

impl Panel {
    fn of(document: &Value, tracks: &[Track<'_>], place: usize, variable: &Value) -> Self {
        let is_angle = variable["kind"] != "distance";
        let is_turn = [turns(document), is_angle];
        let value = |object: &Value| {
            let x = object["q"][place].as_f64().unwrap_or(f64::NAN);
            if is_angle { x.to_degrees() } else { x }
        };
        let limit = |end: &Value| {
            let index = end["limit"].as_u64().and_then(|n| usize::try_from(n).ok())?.checked_sub(1)?;
            let limit = list(document, "limits").get(index)?;
            Some([shown(document, &limit["input"]), value(limit)])
        };
        let lines: Vec<(usize, &'static str, Vec<[f64; 2]>)> = tracks
            .iter()
            .enumerate()
            .filter(|(_, track)| track.kind == Kind::Branch)
            .map(|(index, track)| {
                let inputs = track.inputs.iter().flatten();
                let rows = inputs.zip(&track.frames).map(|(input, row)| [*input, value(row)]);
                let points = limit(&track.source["begins"]).into_iter().chain(rows).chain(limit(&track.source["ends"]));
                (index, colour(track.source), points.filter(|p| p.iter().all(|x| x.is_finite())).collect())
            })
            .collect();
        let branches = list(document, "branches");
        let dots: Vec<([f64; 2], &'static str)> = if is_path(document) {
            jumps(document, &variable["label"], value)
        } else {
            list(document, "limits")
                .iter()
                .map(|limit| {
                    let own = limit["branches"][0].as_u64().and_then(|n| usize::try_from(n).ok()).unwrap_or(1);
                    let own = branches.get(own.saturating_sub(1)).map_or(COLOURS[0], colour);
                    ([shown(document, &limit["input"]), value(limit)], own)
                })
                .collect()
        };
        let mut x = if is_path(document) {
            range(list(document, "results").iter().filter_map(|result| result["case"].as_f64()).collect())
        } else {
            [shown(document, &document["from"]), shown(document, &document["to"])]
        };
        x.sort_by(f64::total_cmp);
        let y = if is_angle {
            [-180.0, 180.0]
        } else {
            {
                let values = lines.iter().flat_map(|(_, _, points)| points).map(|p| p[1]);
                range(values.chain(dots.iter().map(|(dot, _)| dot[1])).collect())
            }
        };
        let unit = if is_angle { "\u{b0}" } else { "m" };
        Self {
            name: format!("{} [{unit}]", variable["label"].as_str().unwrap_or_default()),
            input: if is_path(document) {
                "the number of the pose".to_owned()
            } else {
                let unit = if is_turn[0] { "\u{b0}" } else { "m" };
                format!("{} [{unit}]", document["variable"].as_str().unwrap_or_default())
            },
            x,
            y,
            is_turn,
            lines,
            dots,
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        // Points far beyond the frame are invisible, and browsers cannot handle huge numbers.
        [PANEL[0] * part(x, self.x), (PANEL[1] * (1.0 - part(y, self.y))).clamp(-9e3, 9e3)]
    }

    fn write(&self, text: &mut String) {
        let [width, height] = PANEL;
        let (whole, tall) = (LEFT + width + 8.0, height + BELOW + 18.0);
        let _ = writeln!(
            text,
            "<figure><svg viewBox=\"0 0 {whole} {tall}\" role=\"img\" aria-label=\"{0}\"><g transform=\"translate({LEFT} 16)\">\
             <text class=\"name\" x=\"0\" y=\"-5\">{0}</text><text class=\"tick\" x=\"{width}\" y=\"-5\" text-anchor=\"end\">against {1}</text>",
            escaped(&self.name),
            escaped(&self.input),
        );
        for x in ticks(self.x, self.is_turn[0]) {
            let [at, _] = self.place([x, self.y[0]]);
            let _ = write!(
                text,
                "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y2=\"{height}\"/><text class=\"tick\" x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                height + 15.0,
                tick_text(x)
            );
        }
        for y in ticks(self.y, self.is_turn[1]) {
            let [_, at] = self.place([self.x[0], y]);
            let _ = write!(
                text,
                "<line class=\"grid\" y1=\"{at:.1}\" y2=\"{at:.1}\" x2=\"{width}\"/><text class=\"tick\" x=\"-6\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                at + 4.0,
                tick_text(y)
            );
        }
        let _ = writeln!(text, "<svg width=\"{width}\" height=\"{height}\" overflow=\"hidden\">");
        for (index, colour, points) in &self.lines {
            let _ = writeln!(
                text,
                "<path class=\"branch\" data-mark=\"{index}\" d=\"{}\" stroke=\"{colour}\"/>",
                self.path(points)
            );
        }
        let _ = writeln!(
            text,
            "<line class=\"cursor\" x1=\"-9\" x2=\"-9\" y2=\"{height}\" data-scale=\"{} {} {width}\"/></svg>",
            self.x[0], self.x[1]
        );
        for (dot, colour) in &self.dots {
            let [x, y] = self.place(*dot);
            let _ = write!(
                text,
                "<circle class=\"limit\" cx=\"{x:.1}\" cy=\"{:.1}\" r=\"3.2\" fill=\"{colour}\"/>",
                y.clamp(0.0, height)
            );
        }
        let _ = writeln!(text, "<rect class=\"frame\" width=\"{width}\" height=\"{height}\"/></g></svg></figure>");
    }

    /// One path, lifted where an angle passes 180 degrees and where the input begins another turn.
    fn path(&self, points: &[[f64; 2]]) -> String {
        let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut last: Option<[f64; 2]> = None;
        let half = (self.x[1] - self.x[0]) / 2.0;
        for &[x, y] in points {
            let wraps = last.filter(|[_, before]| self.is_turn[1] && (y - before).abs() > 180.0);
            let is_back = self.is_turn[0] && last.is_some_and(|[before, _]| (x - before).abs() > half);
            if let Some([before, height]) = wraps.filter(|_| !is_back) {
                // Both pieces run on to the edge.
                let turn = if y > height { 360.0 } else { -360.0 };
                if let Some(line) = lines.last_mut() {
                    line.push(self.place([x, y - turn]));
                }
                lines.push(vec![self.place([before, height + turn])]);
            }
            let point = self.place([x, y]);
            match lines.last_mut().filter(|_| !is_back) {
                Some(line) => line.push(point),
                None => lines.push(vec![point]),
            }
            last = Some([x, y]);
        }
        let mut path = String::new();
        for line in &lines {
            for (index, [x, y]) in simplified(line).into_iter().enumerate() {
                let _ = write!(path, "{}{x:.1} {y:.1}", if index == 0 { "M" } else { "L" });
            }
        }
        path
    }
}

/// Returns the jumps of a joint along a path: the pose behind each jump, and its value there.
fn jumps(document: &Value, label: &Value, value: impl Fn(&Value) -> f64) -> Vec<([f64; 2], &'static str)> {
    let mut dots = Vec::new();
    for result in list(document, "results") {
        for event in list(result, "events").iter().filter(|event| event["event"] == "jump" && event["joint"] == *label)
        {
            let own = list(result, "modes").iter().find(|mode| mode["branch"] == event["branch"]);
            if let (Some(mode), Some(case)) = (own, result["case"].as_f64()) {
                dots.push(([case, value(mode)], colour(event)));
            }
        }
    }
    dots
}

/// The points of a line without those that lie on it to within [`STRAIGHT`].
fn simplified(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some(&first) = line.first() else { return Vec::new() };
    let mut kept = vec![first];
    let mut start = 0;
    for end in 2..line.len() {
        let (from, to) = (line[start], line[end]);
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        let is_off = |p: &[f64; 2]| {
            let own = [p[0] - from[0], p[1] - from[1]];
            let (part, side) = (own[0] * along[0] + own[1] * along[1], own[0] * along[1] - own[1] * along[0]);
            // Beyond an end of the chord a point turns back, and a chord of length 0 is all ends.
            let is_back = part < 0.0 || part > length * length || length == 0.0 && own[0].hypot(own[1]) > STRAIGHT;
            side.abs() > STRAIGHT * length || is_back
        };
        if line[start + 1..end].iter().any(is_off) {
            start = end - 1;
            kept.push(line[start]);
        }
    }
    kept.extend(line.last().filter(|_| line.len() > 1));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_the_points_that_are_seen() {
        let straight: Vec<[f64; 2]> = (0..100).map(|k| [f64::from(k), 0.01 * f64::from(k % 2)]).collect();
        assert_eq!(simplified(&straight).len(), 2);
        let corner = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [2.0, 0.0]];
        assert_eq!(simplified(&corner), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [2.0, 0.0]]);
        assert_eq!(simplified(&[[3.0, 4.0]]), [[3.0, 4.0]]);
        assert!(simplified(&[]).is_empty());
    }
}
