//! A map of the number of real solutions of an arm over a plane of its workspace, at one orientation of its tool.

use crate::report::picture::{escaped, tick_text, ticks};
use std::collections::BTreeMap;
use std::fmt::Write;

/// A plane of coordinates: which one runs to the right, and which one upward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    /// 0 is x, 1 is y, 2 is z.
    pub axes: [usize; 2],
}

impl Plane {
    /// `xz` is the plane of x and z.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let axis = |letter: char| "xyz".find(letter.to_ascii_lowercase());
        let letters: Vec<usize> = text.chars().map(axis).collect::<Option<_>>()?;
        match letters.as_slice() {
            [a, b] if a != b => Some(Self { axes: [*a, *b] }),
            _ => None,
        }
    }

    fn name(self, axis: usize) -> char {
        ['x', 'y', 'z'][self.axes[axis]]
    }
}

/// The counts on a grid.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its plane.
    pub plane: Plane,
    /// The range of both coordinates.
    pub range: [[f64; 2]; 2],
    /// The number of points of the grid to the right, and upward.
    pub side: usize,
    /// The number of real solutions at every point, row by row from the lowest; `None` where it is not known.
    pub counts: Vec<Option<usize>>,
    /// The place of the pose that gave the orientation.
    pub at: [f64; 2],
}

/// Edge of the picture in pixels, and the room around it.
const EDGE: f64 = 420.0;
const ROOM: [f64; 4] = [52.0, 44.0, 150.0, 46.0];
/// From few solutions to many: a ramp that also a printer without colours keeps in order.
const RAMP: [&str; 9] =
    ["#f4f6f8", "#dbe9f0", "#b5d5e2", "#84bcd0", "#549fbd", "#347fa6", "#245f8a", "#1c426b", "#152848"];

/// The colour of a count; most arms have an even one.
fn colour(count: Option<usize>, most: usize) -> &'static str {
    match count {
        None => "#e8c27a",
        Some(0) => RAMP[0],
        Some(count) => RAMP[(count * (RAMP.len() - 1)).div_ceil(most.max(1)).min(RAMP.len() - 1)],
    }
}

impl Map {
    /// The coordinates of a point of the grid.
    #[must_use]
    pub fn point(range: [[f64; 2]; 2], side: usize, index: usize) -> [f64; 2] {
        let part = |k: usize| (k as f64 + 0.5) / side as f64;
        let [x, y] = [part(index % side), part(index / side)];
        [range[0][0] + x * (range[0][1] - range[0][0]), range[1][0] + y * (range[1][1] - range[1][0])]
    }

    /// The picture.
    #[must_use]
    pub fn svg(&self, title: &str) -> String {
        let (width, height) = (ROOM[0] + EDGE + ROOM[2], ROOM[1] + EDGE + ROOM[3]);
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"12\" role=\"img\">\n<title>{0}</title>\n\
             <text x=\"{1}\" y=\"24\" font-size=\"15\" font-weight=\"bold\" fill=\"currentColor\">Number of real solutions at this orientation</text>\n\
             <g transform=\"translate({1} {2})\">\n",
            escaped(title),
            ROOM[0],
            ROOM[1]
        );
        self.cells(&mut text);
        self.axes(&mut text);
        self.legend(&mut text);
        text + "</g>\n</svg>\n"
    }

    /// Runs of equal counts in a row are one rectangle.
    fn cells(&self, text: &mut String) {
        let most = self.counts.iter().flatten().copied().max().unwrap_or(0);
        let cell = EDGE / self.side as f64;
        for row in 0..self.side {
            let counts = &self.counts[row * self.side..(row + 1) * self.side];
            let mut start = 0;
            while start < self.side {
                let length = counts[start..].iter().take_while(|count| **count == counts[start]).count();
                // The rectangles are slightly wider, so that no lines show between them.
                let _ = writeln!(
                    text,
                    "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{}\"/>",
                    cell * start as f64,
                    EDGE - cell * (row + 1) as f64,
                    cell * length as f64 + 0.3,
                    cell + 0.3,
                    colour(counts[start], most)
                );
                start += length;
            }
        }
    }

    fn axes(&self, text: &mut String) {
        let place = |value: f64, [low, high]: [f64; 2]| EDGE * (value - low) / (high - low);
        for x in ticks(self.range[0], false) {
            let at = place(x, self.range[0]);
            let _ = write!(
                text,
                "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{EDGE}\" y2=\"{}\" stroke=\"currentColor\"/>\
                 <text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\" fill=\"currentColor\">{}</text>",
                EDGE + 5.0,
                EDGE + 18.0,
                tick_text(x)
            );
        }
        for y in ticks(self.range[1], false) {
            let at = EDGE - place(y, self.range[1]);
            let _ = write!(
                text,
                "<line x1=\"-5\" x2=\"0\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"currentColor\"/>\
                 <text x=\"-8\" y=\"{:.1}\" text-anchor=\"end\" fill=\"currentColor\">{}</text>",
                at + 4.0,
                tick_text(y)
            );
        }
        let [x, y] = [place(self.at[0], self.range[0]), EDGE - place(self.at[1], self.range[1])];
        let _ = writeln!(
            text,
            "<rect width=\"{EDGE}\" height=\"{EDGE}\" fill=\"none\" stroke=\"#8a93a0\"/>\
             <circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"none\" stroke=\"#c8401f\" stroke-width=\"2\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"currentColor\">{} [m]</text>\
             <text transform=\"translate(-38 {}) rotate(-90)\" text-anchor=\"middle\" fill=\"currentColor\">{} [m]</text>",
            EDGE / 2.0,
            EDGE + 36.0,
            self.plane.name(0),
            EDGE / 2.0,
            self.plane.name(1)
        );
    }

    fn legend(&self, text: &mut String) {
        let most = self.counts.iter().flatten().copied().max().unwrap_or(0);
        let mut found: BTreeMap<Option<usize>, usize> = BTreeMap::new();
        for count in &self.counts {
            *found.entry(*count).or_default() += 1;
        }
        for (line, (count, cells)) in found.iter().rev().enumerate() {
            let share = 100.0 * *cells as f64 / self.counts.len().max(1) as f64;
            let name = count.map_or_else(|| "not solved".to_owned(), |count| count.to_string());
            let y = 24.0 * line as f64;
            let _ = writeln!(
                text,
                "<rect x=\"{}\" y=\"{y}\" width=\"18\" height=\"18\" fill=\"{}\" stroke=\"#8a93a0\"/>\
                 <text x=\"{}\" y=\"{}\" fill=\"currentColor\">{name}</text>\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#7a8492\">{share:.0} %</text>",
                EDGE + 16.0,
                colour(*count, most),
                EDGE + 42.0,
                y + 13.0,
                EDGE + 140.0,
                y + 13.0
            );
        }
    }
}
