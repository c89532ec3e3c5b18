//! A synthesis in the plane as a picture: the positions, the dyads in the first of them, the curves of their points.

use crate::catalogue::{Space, SynthesisFile, Task};
use crate::error::{Error, Result};
use crate::kinematics::motion::Motion;
use crate::report::picture::{COLOURS, escaped};
use crate::synthesis::{Answer, Curve};
use rug::Rational;
use std::fmt::Write;

/// Side of the drawing, in pixels.
const SIDE: f64 = 640.0;
/// Room above it for title and legend.
const HEAD: f64 = 84.0;
/// Cells of the grid on which a curve is followed, along each side: a cell is four pixels.
const CELLS: usize = 160;
/// A dyad farther away than this many times the extent of the positions does not widen the drawing.
const FAR: f64 = 4.0;

/// The picture, an SVG document.
///
/// # Errors
/// [`Error::Unsupported`] for a synthesis that is not one of motion in the plane.
pub fn svg(file: &SynthesisFile, answer: &Answer) -> Result<String> {
    let (Space::Plane, Task::Motion(_, positions)) = (file.space, &file.task) else {
        return Err(Error::Unsupported("only syntheses of motion in the plane are drawn".to_owned()));
    };
    let window = Window::of(positions, answer);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIDE} {0}\" width=\"{SIDE}\" height=\"{0}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{1}</text>\n\
         <text x=\"16\" y=\"46\" fill=\"#444\">axes: the positions of the body; lines: dyads in position 1, the fixed point hollow</text>\n",
        SIDE + HEAD,
        escaped(&file.heading.title),
    );
    for (k, curve) in answer.curves.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        let _ = writeln!(
            text,
            "<text x=\"{}\" y=\"66\" fill=\"{colour}\">{} (degree {})</text>",
            16 + 220 * k,
            escaped(curve.name),
            curve.degree
        );
        // Points of the body are drawn where they stand in the first position.
        let first = (curve.of == "moving").then(|| float(&positions[0]));
        let _ = writeln!(
            text,
            "<path d=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>",
            window.curve(curve, first.as_ref())
        );
    }
    for (k, motion) in positions.iter().enumerate() {
        window.axes(&mut text, &float(motion), k + 1);
    }
    for (k, mode) in (1..).zip(&answer.modes).filter(|(_, mode)| mode.is_real) {
        let [fixed, moving] = ["fixed", "moving"].map(|name| mode.dyad.real(name));
        if let (&[x, y], &[u, v]) = (fixed.as_slice(), moving.as_slice()) {
            let at = float(&positions[0]).apply(&[u, v, 0.0]);
            window.dyad(&mut text, [x, y], [at[0], at[1]], k);
        }
    }
    Ok(text + "</svg>\n")
}

fn float(motion: &Motion<Rational>) -> Motion<f64> {
    let row = |row: &[Rational; 3]| row.each_ref().map(Rational::to_f64);
    Motion { rotation: motion.rotation.each_ref().map(row), translation: row(&motion.translation) }
}

/// The part of the plane that is drawn: a square.
struct Window {
    middle: [f64; 2],
    half: f64,
}

impl Window {
    fn of(positions: &[Motion<Rational>], answer: &Answer) -> Self {
        let mut points: Vec<[f64; 2]> =
            positions.iter().map(float).map(|m| [m.translation[0], m.translation[1]]).collect();
        let (middle, half) = extent(&points);
        let limit = FAR * half.max(f64::MIN_POSITIVE);
        let first = float(&positions[0]);
        for mode in answer.modes.iter().filter(|mode| mode.is_real) {
            let (fixed, moving) = (mode.dyad.real("fixed"), mode.dyad.real("moving"));
            let start = match moving.as_slice() {
                &[u, v] => first.apply(&[u, v, 0.0])[..2].to_vec(),
                _ => Vec::new(),
            };
            for point in [fixed, start] {
                if let &[x, y] = point.as_slice()
                    && (x - middle[0]).abs().max((y - middle[1]).abs()) < limit
                {
                    points.push([x, y]);
                }
            }
        }
        let (middle, half) = extent(&points);
        // Some room around; one unit where all points coincide.
        Self { middle, half: if half > 0.0 { 1.25 * half } else { 1.0 } }
    }

    fn shown(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let scale = SIDE / (2.0 * self.half);
        [SIDE / 2.0 + (x - self.middle[0]) * scale, HEAD + SIDE / 2.0 - (y - self.middle[1]) * scale]
    }

    /// The point of the plane at a corner of the grid.
    fn corner(&self, i: usize, j: usize) -> [f64; 2] {
        let step = 2.0 * self.half / CELLS as f64;
        [self.middle[0] - self.half + i as f64 * step, self.middle[1] - self.half + j as f64 * step]
    }

    /// The zeros of a polynomial as a path: in every cell the zeros on its sides, joined two by two.
    fn curve(&self, curve: &Curve, first: Option<&Motion<f64>>) -> String {
        let back = first.map(Motion::inverse);
        let value = |i: usize, j: usize| {
            let [x, y] = self.corner(i, j);
            let [x, y, _] = back.as_ref().map_or([x, y, 0.0], |back| back.apply(&[x, y, 0.0]));
            curve.value(x, y)
        };
        let values: Vec<Vec<f64>> = (0..=CELLS).map(|i| (0..=CELLS).map(|j| value(i, j)).collect()).collect();
        let mut path = String::new();
        for i in 0..CELLS {
            for j in 0..CELLS {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let mut zeros = Vec::new();
                for k in 0..4 {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    let (f, g) = (values[a.0][a.1], values[b.0][b.1]);
                    if (f < 0.0) != (g < 0.0) {
                        let (p, q, part) = (self.corner(a.0, a.1), self.corner(b.0, b.1), f / (f - g));
                        zeros.push(self.shown([p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])]));
                    }
                }
                for pair in zeros.chunks_exact(2) {
                    let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", pair[0][0], pair[0][1], pair[1][0], pair[1][1]);
                }
            }
        }
        path
    }

    fn axes(&self, text: &mut String, motion: &Motion<f64>, number: usize) {
        let length = self.half / 10.0;
        let [o, x, y] = [[0.0, 0.0], [length, 0.0], [0.0, length]].map(|[x, y]| {
            let at = motion.apply(&[x, y, 0.0]);
            self.shown([at[0], at[1]])
        });
        for (end, colour) in [(x, "#cc3311"), (y, "#228833")] {
            let _ = writeln!(
                text,
                "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"2\"/>",
                o[0], o[1], end[0], end[1]
            );
        }
        let _ = writeln!(text, "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#444\">{number}</text>", o[0] + 4.0, o[1] + 14.0);
    }

    fn dyad(&self, text: &mut String, fixed: [f64; 2], moving: [f64; 2], number: usize) {
        let (a, b) = (self.shown(fixed), self.shown(moving));
        let _ = writeln!(
            text,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#333\" stroke-width=\"1.5\"/>\n\
             <circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4\" fill=\"#fff\" stroke=\"#333\"/>\n\
             <circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4\" fill=\"#333\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\">{number}</text>",
            a[0],
            a[1],
            b[0],
            b[1],
            a[0],
            a[1],
            b[0],
            b[1],
            b[0] + 6.0,
            b[1] - 6.0
        );
    }
}

/// The middle of the smallest upright square around points, and half its side.
fn extent(points: &[[f64; 2]]) -> ([f64; 2], f64) {
    let range = |k: usize| {
        let values = points.iter().map(|p| p[k]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let [(a, b), (c, d)] = [range(0), range(1)];
    ([f64::midpoint(a, b), f64::midpoint(c, d)], ((b - a).max(d - c)) / 2.0)
}
