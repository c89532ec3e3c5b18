//! The positions of the solutions to each other: a dial for every angle, a rule for every distance, and maps of a plate.
//!
//! A dial shows e^{iq}. Real angles lie on the circle, complex ones in pairs inside and outside of it; the distance from
//! the circle is compressed.

use super::tracks::{Kind, Track, list};
use crate::report::picture::escaped;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write;

/// Half the width of a dial, and the radius of its circle, in pixels.
const HALF: f64 = 44.0;
const RADIUS: f64 = 29.0;
/// Largest distance of a complex angle from the circle.
const DEPTH: f64 = 12.0;

/// The plots of one case.
pub(super) fn dials(document: &Value, tracks: &[(usize, &Track<'_>)]) -> String {
    let modes: Vec<(usize, &Value)> = tracks
        .iter()
        .filter(|(_, track)| track.kind == Kind::Mode)
        .map(|(index, track)| (*index, track.source))
        .collect();
    if modes.is_empty() {
        return String::new();
    }
    if document["kind"] == "platform" {
        return plate(&modes);
    }
    // A linkage in space may have no joint with a value.
    if list(document, "joint_variables").is_empty() {
        return String::new();
    }
    let mut text = String::from("<div class=\"dials\">\n");
    for (place, variable) in list(document, "joint_variables").iter().enumerate() {
        let name = variable["label"].as_str().unwrap_or_default();
        let values: Vec<(usize, [f64; 2])> =
            modes.iter().filter_map(|(index, mode)| Some((*index, pair(&mode["q"][place])?))).collect();
        let limits = &document["mechanism"]["limits"][place];
        let limits = limits[0].as_f64().zip(limits[1].as_f64());
        if variable["kind"] == "distance" {
            rule(&mut text, name, &values);
        } else {
            dial(&mut text, name, &values, limits);
        }
    }
    text + "</div>\n"
}

/// A number as its real and imaginary part.
fn pair(value: &Value) -> Option<[f64; 2]> {
    match value.as_array().map(Vec::as_slice) {
        Some([re, im]) => Some([re.as_f64()?, im.as_f64()?]),
        _ => Some([value.as_f64()?, 0.0]),
    }
}

fn open(text: &mut String) {
    let size = 2.0 * HALF;
    let _ = write!(text, "<figure><svg viewBox=\"-{HALF} -{HALF} {size} {size}\" aria-hidden=\"true\">");
}

fn close(text: &mut String, name: &str) {
    let _ = writeln!(text, "</svg><figcaption>{}</figcaption></figure>", escaped(name));
}

fn mark(text: &mut String, index: usize, [x, y]: [f64; 2], is_real: bool) {
    let class = if is_real { "" } else { " class=\"off\"" };
    let _ = write!(text, "<circle{class} data-mark=\"{index}\" cx=\"{x:.1}\" cy=\"{y:.1}\"/>");
}

fn dial(text: &mut String, name: &str, values: &[(usize, [f64; 2])], limits: Option<(f64, f64)>) {
    open(text);
    let _ = write!(
        text,
        "<circle class=\"rim\" r=\"{RADIUS}\"/><line class=\"zero\" x1=\"{:.1}\" x2=\"{:.1}\"/>",
        RADIUS - 4.0,
        RADIUS + 4.0
    );
    if let Some((low, high)) = limits.filter(|(low, high)| high - low < TAU - 1e-3) {
        let at = |angle: f64| format!("{:.2} {:.2}", RADIUS * angle.cos(), -RADIUS * angle.sin());
        let large = i32::from(high - low > PI);
        let _ = write!(text, "<path class=\"range\" d=\"M{} A{RADIUS} {RADIUS} 0 {large} 0 {}\"/>", at(low), at(high));
    }
    for (index, [re, im]) in values {
        let radius = RADIUS - DEPTH * im.atan() / FRAC_PI_2;
        mark(text, *index, [radius * re.cos(), -radius * re.sin()], *im == 0.0);
    }
    close(text, name);
}

/// A vertical scale for a distance.
fn rule(text: &mut String, name: &str, values: &[(usize, [f64; 2])]) {
    open(text);
    let reals = || values.iter().map(|(_, [re, _])| *re);
    let (low, high) = (reals().fold(0.0, f64::min), reals().fold(0.0, f64::max));
    let span = if high > low { high - low } else { 1.0 };
    let place = |x: f64| RADIUS - 2.0 * RADIUS * (x - low) / span;
    let _ = write!(
        text,
        "<line class=\"rim\" y1=\"-{RADIUS}\" y2=\"{RADIUS}\"/><line class=\"zero\" x1=\"-5\" x2=\"5\" y1=\"{0:.1}\" y2=\"{0:.1}\"/>",
        place(0.0)
    );
    for (index, [re, im]) in values {
        mark(text, *index, [DEPTH * im.atan() / FRAC_PI_2, place(*re)], *im == 0.0);
    }
    close(text, name);
}

/// Draws the place of the origin of a plate, from above and from the front.
fn plate(modes: &[(usize, &Value)]) -> String {
    let mut text = String::from("<div class=\"dials wide\">\n");
    let points: Vec<(usize, [[f64; 2]; 3])> = modes
        .iter()
        .filter_map(|(index, mode)| {
            let at = |k: usize| pair(&mode["position"][k]);
            Some((*index, [at(0)?, at(1)?, at(2)?]))
        })
        .collect();
    let all = || points.iter().flat_map(|(_, p)| p.iter().map(|[re, _]| re.abs()));
    let reach = all().fold(0.0, f64::max).max(1e-9);
    for (name, across, up) in [("x, y of the plate", 0, 1), ("x, z of the plate", 0, 2), ("y, z of the plate", 1, 2)] {
        open(&mut text);
        let _ = write!(
            text,
            "<line class=\"zero\" x1=\"-{HALF}\" x2=\"{HALF}\"/><line class=\"zero\" y1=\"-{HALF}\" y2=\"{HALF}\"/>"
        );
        for (index, p) in &points {
            let place = |k: usize| 0.9 * HALF * p[k][0] / reach;
            mark(&mut text, *index, [place(across), -place(up)], p.iter().all(|[_, im]| *im == 0.0));
        }
        close(&mut text, name);
    }
    text + "</div>\n"
}
