//! Stick figures: a mechanism as a flat drawing, for papers and for pages without WebGL.

use super::tracks::{Kind, Track, begun, list, tracks};
use crate::algebra::sort;
use crate::kinematics::joint::{JointKind, Variable};
use crate::report::picture::escaped;
use crate::scene::{Point, Pose, apply};
use serde_json::Value;
use std::fmt::Write;

/// From where the mechanism is looked at: from the front, right and above, as the page begins.
const EYE: Point = [0.62, -0.92, 0.46];
/// The most figures of one picture: more are a blot on paper.
const MOST: usize = 40;
/// Width and height of one figure, and the room for its number.
const CELL: [f64; 2] = [236.0, 210.0];
const CAPTION: f64 = 24.0;
/// Room about a drawing, both sides together.
const EDGE: f64 = 36.0;
/// Links of more points are arcs.
const ARC: usize = 8;
/// The paths of points.
const TRACE: &str = "#b0253a";
/// Colours of the bodies in turn, the ground first; distinguishable by the colour-blind.
const COLOURS: [&str; 10] =
    ["#3f4652", "#2f6fb0", "#1f9e89", "#d0782a", "#8a5fb0", "#c14f63", "#6b8e23", "#3b8ea5", "#b58b1a", "#7a6a5a"];

fn colour(body: usize) -> &'static str {
    if body == 0 { COLOURS[0] } else { COLOURS[1 + (body - 1) % (COLOURS.len() - 1)] }
}

fn point(value: &Value) -> Option<Point> {
    let list: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    list?.try_into().ok()
}

fn poses(frame: &Value) -> Option<Vec<Pose>> {
    let pose = |pose: &Value| -> Option<Pose> {
        pose.as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>()?.try_into().ok()
    };
    frame["poses"].as_array()?.iter().map(pose).collect()
}

/// A straight or bent line of the drawing, or a face.
struct Stroke {
    points: Vec<[f64; 2]>,
    depth: f64,
    colour: &'static str,
    width: f64,
    is_face: bool,
    /// Lines that pass before others have a white edge.
    has_edge: bool,
    dash: bool,
}

/// The flat drawing of a scene at one configuration, before it is scaled.
struct Drawing {
    strokes: Vec<Stroke>,
    /// The points that must lie within the picture.
    corners: Vec<[f64; 2]>,
    size: f64,
    is_flat: bool,
}

/// A point as the eye sees it: right, down, and how near. What is flat is seen from above.
fn seen(p: &Point, is_flat: bool) -> ([f64; 2], f64) {
    if is_flat {
        return ([p[0], -p[1]], p[2]);
    }
    let norm = EYE.iter().map(|x| x * x).sum::<f64>().sqrt();
    let eye = EYE.map(|x| x / norm);
    let across = (eye[0] * eye[0] + eye[1] * eye[1]).sqrt();
    let right = [-eye[1] / across, eye[0] / across];
    // The upward direction of the picture is perpendicular to both.
    let up = [-eye[2] * right[1], eye[2] * right[0], across];
    let depth = (0..3).map(|k| p[k] * eye[k]).sum();
    ([right[0] * p[0] + right[1] * p[1], -(up[0] * p[0] + up[1] * p[1] + up[2] * p[2])], depth)
}

impl Drawing {
    fn of(scene: &Value, poses: &[Pose], paths: &[Vec<Pose>]) -> Self {
        let is_flat = scene["flat"] == true;
        let mut drawing = Self { strokes: Vec::new(), corners: Vec::new(), size: 0.0, is_flat };
        let bodies = || list(scene, "bodies").iter().zip(poses).enumerate();
        let mut all: Vec<Point> = Vec::new();
        for (_, (body, pose)) in bodies() {
            for part in list(body, "parts") {
                all.extend(list(part, "points").iter().chain([&part["at"]]).filter_map(point).map(|p| apply(pose, &p)));
            }
            if list(body, "parts").is_empty() {
                all.push(apply(pose, &[0.0; 3]));
            }
        }
        let traces: Vec<Vec<Point>> = list(scene, "traces").iter().filter_map(|trace| path(trace, paths)).collect();
        all.extend(traces.iter().flatten());
        drawing.corners = all.iter().map(|p| seen(p, is_flat).0).collect();
        let extent = |k: usize| {
            let values = || drawing.corners.iter().map(|p| p[k]);
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
        };
        drawing.size = extent(0).max(extent(1)).max(1e-9);
        for trace in &traces {
            drawing.line(trace, TRACE, 1.6, false);
            if let Some(last) = drawing.strokes.last_mut() {
                last.depth = f64::INFINITY;
            }
        }
        for (index, (body, pose)) in bodies() {
            for part in list(body, "parts") {
                drawing.part(index, part, pose);
            }
            if list(body, "parts").is_empty() {
                drawing.line(&[apply(pose, &[0.0; 3])], COLOURS[0], 8.0, false);
            }
        }
        for connection in list(scene, "connections") {
            let end = |key: &str| {
                let body = usize::try_from(connection[key][0].as_u64()?).ok()?;
                Some(apply(poses.get(body)?, &point(&connection[key][1])?))
            };
            if let (Some(from), Some(to)) = (end("from"), end("to")) {
                let (colour, width) = if connection["kind"] == "bar" { (COLOURS[1], 3.0) } else { ("#8a93a0", 2.6) };
                drawing.line(&[from, to], colour, width, true);
                if let (true, Some(last)) = (connection["kind"] == "travel", drawing.strokes.last_mut()) {
                    last.dash = true;
                }
            }
        }
        sort::by(&mut drawing.strokes, |a, b| a.depth.total_cmp(&b.depth));
        drawing
    }

    fn line(&mut self, points: &[Point], colour: &'static str, width: f64, has_edge: bool) {
        let flat: Vec<([f64; 2], f64)> = points.iter().map(|p| seen(p, self.is_flat)).collect();
        let depth = flat.iter().map(|(_, depth)| depth).sum::<f64>() / flat.len().max(1) as f64;
        let points = flat.into_iter().map(|(p, _)| p).collect();
        self.strokes.push(Stroke { points, depth, colour, width, is_face: false, has_edge, dash: false });
    }

    fn part(&mut self, body: usize, part: &Value, pose: &Pose) {
        let points: Vec<Point> = list(part, "points").iter().filter_map(point).map(|p| apply(pose, &p)).collect();
        match part["kind"].as_str() {
            // The pieces of an arc are one line, so that their edges do not cut it.
            Some("link") if points.len() > ARC => self.line(&points, colour(body), 4.4, true),
            Some("link") => points.windows(2).for_each(|piece| self.line(piece, colour(body), 4.4, true)),
            Some("hull") => {
                for triangle in list(part, "triangles") {
                    let corner =
                        |k: usize| usize::try_from(triangle[k].as_u64()?).ok().and_then(|k| points.get(k)).copied();
                    let corners: Vec<Point> = (0..3).filter_map(corner).collect();
                    let tint = if self.is_flat { colour(body) } else { COLOURS[1] };
                    self.line(&corners, if body == 0 { "#6b7685" } else { tint }, 0.7, false);
                    if let Some(last) = self.strokes.last_mut() {
                        last.is_face = true;
                        // The links of other bodies pass before it.
                        last.depth -= if self.is_flat { 1.0 } else { 0.0 };
                    }
                }
            }
            Some("joint") => self.joint(part, pose),
            Some("support") => self.support(part, pose),
            Some("frame") => self.frame(part, pose),
            _ => {}
        }
    }

    /// A bearing of the ground: a triangle below its pin.
    fn support(&mut self, part: &Value, pose: &Pose) {
        let Some(at) = point(&part["at"]) else { return };
        let corner = |x: f64, y: f64| apply(pose, &[at[0] + x * self.size, at[1] + y * self.size, at[2]]);
        let foot = [corner(0.0, 0.0), corner(-0.05, -0.085), corner(0.05, -0.085)];
        let line = [corner(-0.08, -0.085), corner(0.08, -0.085)];
        self.line(&foot, COLOURS[0], 0.7, false);
        if let Some(last) = self.strokes.last_mut() {
            last.is_face = true;
        }
        self.line(&line, COLOURS[0], 2.2, false);
    }

    /// A joint as a drum along its axis, or as a spherical joint.
    fn joint(&mut self, part: &Value, pose: &Pose) {
        let (Some(at), Some(axis)) = (point(&part["at"]), point(&part["axis"])) else { return };
        let half = match part["type"].as_str().and_then(JointKind::from_letter) {
            Some(JointKind::Spherical) => 0.0,
            Some(kind) if kind.variables().contains(&Variable::Translation) => 0.036,
            _ => 0.022,
        } * self.size;
        let end = |sign: f64| apply(pose, &std::array::from_fn(|k| at[k] + sign * half * axis[k]));
        let (one, two) = (end(-1.0), end(1.0));
        // A dark line, and a lighter one on it.
        self.line(&[one, two], "#20262f", 11.0, false);
        self.line(&[one, two], "#f3f5f8", 7.0, false);
        // Before the links that meet there, whose white edges would cut it.
        let (below, above) = (self.size * 0.2, self.size * 1e-3);
        let count = self.strokes.len();
        self.strokes[count - 2..].iter_mut().for_each(|stroke| stroke.depth += below);
        if let Some(last) = self.strokes.last_mut() {
            last.depth += above;
        }
    }

    fn frame(&mut self, part: &Value, pose: &Pose) {
        let Some(own) = part["pose"].as_array().and_then(|p| p.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>())
        else {
            return;
        };
        let Ok(own) = Pose::try_from(own) else { return };
        let origin = apply(pose, &apply(&own, &[0.0; 3]));
        for (k, colour) in ["#d1495b", "#3a9d5d", "#2f6fb0"].into_iter().enumerate() {
            let mut tip = [0.0; 3];
            tip[k] = 0.1 * self.size;
            self.line(&[origin, apply(pose, &apply(&own, &tip))], colour, 2.0, false);
        }
    }
}

/// The path of a point along the configurations of a track.
fn path(trace: &Value, frames: &[Vec<Pose>]) -> Option<Vec<Point>> {
    let (body, at) = (usize::try_from(trace["body"].as_u64()?).ok()?, point(&trace["at"])?);
    (frames.len() > 1).then(|| frames.iter().filter_map(|poses| Some(apply(poses.get(body)?, &at))).collect())
}

/// The configurations of a track, where the paths of points are drawn.
fn frames(scene: &Value, track: &Track<'_>) -> Vec<Vec<Pose>> {
    if list(scene, "traces").is_empty() {
        return Vec::new();
    }
    let mut frames: Vec<Vec<Pose>> = track.frames.iter().filter_map(|frame| poses(frame)).collect();
    if track.source["ends"]["kind"] == "closed" {
        frames.extend(frames.first().cloned());
    }
    frames
}

/// The map from points of drawings to points of a picture.
struct Fit {
    scale: f64,
    middle: [f64; 2],
    centre: [f64; 2],
}

impl Fit {
    /// The range of one coordinate.
    fn span(corners: &[[f64; 2]], k: usize) -> [f64; 2] {
        let low = corners.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        if low <= high { [low, high] } else { [-1.0, 1.0] }
    }

    /// Returns the height that a drawing needs when it fills the width.
    fn height(corners: &[[f64; 2]], [width, height]: [f64; 2]) -> f64 {
        let (x, y) = (Self::span(corners, 0), Self::span(corners, 1));
        let needed = (width - EDGE) * (y[1] - y[0]) / (x[1] - x[0]).max(1e-9) + EDGE;
        needed.clamp(height / 3.0, height).round()
    }

    fn of(corners: &[[f64; 2]], [width, height]: [f64; 2]) -> Self {
        let (x, y) = (Self::span(corners, 0), Self::span(corners, 1));
        let fit = |[low, high]: [f64; 2], room: f64| (room - EDGE) / (high - low).max(1e-9);
        let scale = fit(x, width).min(fit(y, height));
        Self {
            scale,
            middle: [f64::midpoint(x[0], x[1]), f64::midpoint(y[0], y[1])],
            centre: [width / 2.0, height / 2.0],
        }
    }

    fn points(&self, list: &[[f64; 2]]) -> String {
        let place = |p: &[f64; 2], k: usize| self.centre[k] + self.scale * (p[k] - self.middle[k]);
        list.iter().map(|p| format!("{:.1},{:.1}", place(p, 0), place(p, 1))).collect::<Vec<_>>().join(" ")
    }
}

fn write(text: &mut String, drawing: &Drawing, fit: &Fit, weight: f64) {
    for stroke in &drawing.strokes {
        let (points, colour, width) = (fit.points(&stroke.points), stroke.colour, stroke.width * weight);
        if stroke.is_face {
            let _ = writeln!(
                text,
                "<polygon points=\"{points}\" fill=\"{colour}\" fill-opacity=\"0.16\" stroke=\"{colour}\" stroke-width=\"{width:.1}\"/>"
            );
            continue;
        }
        // A line of one point is a dot with round ends.
        let points = if stroke.points.len() == 1 { format!("{points} {points}") } else { points };
        let line = |colour: &str, width: f64, more: &str| {
            format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.1}\" \
                 stroke-linecap=\"round\" stroke-linejoin=\"round\"{more}/>\n"
            )
        };
        if stroke.has_edge {
            text.push_str(&line("#fff", width + 2.4 * weight, ""));
        }
        text.push_str(&line(colour, width, if stroke.dash { " stroke-dasharray=\"6 5\"" } else { "" }));
    }
}

/// A quarter along a track: where an overconstrained loop is not flat.
fn drawn<'a>(track: &Track<'a>) -> Option<&'a Value> {
    track.frames.get(track.frames.len() / 4).copied()
}

/// The drawing of the first track, without a frame around it.
pub(super) fn first(document: &Value, tracks: &[Track<'_>], size: [f64; 2]) -> String {
    let posed = |track: &Track<'_>| Some((poses(drawn(track)?)?, frames(&document["scene"], track)));
    let found = tracks.get(begun(document, tracks)).and_then(posed).or_else(|| tracks.iter().find_map(posed));
    let mut text = String::new();
    if let Some((poses, frames)) = found {
        let drawing = Drawing::of(&document["scene"], &poses, &frames);
        write(&mut text, &drawing, &Fit::of(&drawing.corners, size), 1.0);
    }
    text
}

/// A picture of every mode, of every branch at a quarter of its length, and of every self-motion, as one SVG document.
#[must_use]
pub fn figures(document: &Value) -> String {
    let tracks = tracks(document);
    let posed: Vec<(&Track<'_>, Vec<Pose>)> =
        tracks.iter().filter_map(|track| Some((track, poses(drawn(track)?)?))).collect();
    let shown = &posed[..posed.len().min(MOST)];
    let scene = &document["scene"];
    let drawings: Vec<Drawing> =
        shown.iter().map(|(track, poses)| Drawing::of(scene, poses, &frames(scene, track))).collect();
    // Few in a row fill the width of a page.
    let columns = (1..=8).find(|c| c * c >= drawings.len()).unwrap_or(8);
    let rows = drawings.len().div_ceil(columns).max(1);
    let corners: Vec<[f64; 2]> = drawings.iter().flat_map(|drawing| drawing.corners.iter().copied()).collect();
    let cell = [CELL[0], Fit::height(&corners, CELL)];
    let fit = Fit::of(&corners, cell);
    let (width, height) = (cell[0] * columns as f64, (cell[1] + CAPTION) * rows as f64);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
         font-family=\"sans-serif\" font-size=\"14\" role=\"img\">\n<title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(document["title"].as_str().unwrap_or_default())
    );
    for (index, ((track, _), drawing)) in shown.iter().zip(&drawings).enumerate() {
        let at = [cell[0] * (index % columns) as f64, (cell[1] + CAPTION) * (index / columns) as f64];
        let _ = writeln!(text, "<g transform=\"translate({:.0} {:.0})\">", at[0], at[1]);
        write(&mut text, drawing, &fit, 0.9);
        let name = if track.kind == Kind::Branch { format!("branch {}", track.name) } else { track.name.clone() };
        let _ = writeln!(
            text,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#3f4652\">{}</text>\n</g>",
            cell[0] / 2.0,
            cell[1] + 8.0,
            escaped(&name)
        );
    }
    text + "</svg>\n"
}
