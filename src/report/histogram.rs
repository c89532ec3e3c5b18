//! A histogram over powers of ten, as SVG.

use super::picture::escaped;
use std::fmt::Write;

/// Width and height of the plane, its left and lower margin and the room for the title, in pixels.
const PLANE: [f64; 2] = [480.0, 220.0];
const MARGIN: [f64; 2] = [58.0, 52.0];
const HEAD: f64 = 40.0;
/// Bars of a decade.
const BARS: i32 = 2;
/// Values below 1e-18 count as 0 and belong to the first bar: the last digit of f64 is 1e-16 of a number.
const FIRST: i32 = -18 * BARS;
/// The last decade of f64 ends the last bar.
const LAST: i32 = 308 * BARS;

/// The histogram of positive numbers. Zeros, and what is smaller than 1e-18, stand in the first bar.
#[must_use]
pub fn svg(title: &str, axis: &str, values: &[f64]) -> String {
    let bar = |x: f64| (FIRST..=LAST).find(|bar| x < 10.0_f64.powf(f64::from(bar + 1) / f64::from(BARS)));
    let bars: Vec<i32> = values.iter().filter(|x| x.is_finite()).filter_map(|x| bar(*x)).collect();
    let (first, last) = (bars.iter().min().copied().unwrap_or(0), bars.iter().max().copied().unwrap_or(0));
    // Whole decades.
    let (first, last) = (first.div_euclid(BARS) * BARS, (last.div_euclid(BARS) + 1) * BARS);
    let mut counts = vec![0_usize; usize::try_from(last - first).unwrap_or(1)];
    for bar in &bars {
        counts[usize::try_from(bar - first).unwrap_or(0)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let (width, height) = (MARGIN[0] + PLANE[0] + 20.0, HEAD + PLANE[1] + MARGIN[1]);
    let step = PLANE[0] / counts.len() as f64;
    let foot = HEAD + PLANE[1];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{0:.0}\" y=\"24\" font-size=\"14\" font-weight=\"bold\">{1}</text>\n",
        MARGIN[0],
        escaped(title)
    );
    for (k, count) in counts.iter().enumerate() {
        let tall = PLANE[1] * *count as f64 / most as f64;
        let left = MARGIN[0] + step * k as f64;
        let _ = writeln!(
            text,
            "<rect x=\"{left:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{tall:.1}\" fill=\"#4477aa\"><title>{count}</title></rect>",
            foot - tall,
            (step - 1.0).max(0.5)
        );
    }
    let _ = writeln!(
        text,
        "<line x1=\"{0:.0}\" y1=\"{foot:.0}\" x2=\"{1:.0}\" y2=\"{foot:.0}\" stroke=\"#444\"/>",
        MARGIN[0],
        MARGIN[0] + PLANE[0]
    );
    let decades = usize::try_from((last - first) / BARS).unwrap_or(1);
    // At most a dozen labels.
    let every = decades.div_ceil(12).max(1);
    for k in (0..=decades).step_by(every) {
        let at = MARGIN[0] + PLANE[0] * k as f64 / decades as f64;
        let power = i64::from(first / BARS) + i64::try_from(k).unwrap_or(0);
        let _ = writeln!(
            text,
            "<text x=\"{at:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#444\">1e{power}</text>",
            foot + 17.0
        );
    }
    let _ = writeln!(
        text,
        "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"end\" fill=\"#444\">{most}</text>\n\
         <text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text>\n</svg>",
        MARGIN[0] - 6.0,
        HEAD + 10.0,
        MARGIN[0] + 0.5 * PLANE[0],
        foot + 40.0,
        escaped(axis)
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_stands_in_a_bar() {
        let text = svg("a < b", "error", &[0.0, 2e-16, 3e-16, 4e-12, 1.0, f64::NAN]);
        assert!(text.contains("a &lt; b") && text.ends_with("</svg>\n"), "{text}");
        let heights = text.split("<title>").skip(1).map(|rest| rest.split('<').next().unwrap_or_default());
        assert_eq!(heights.map(|count| count.parse::<usize>().unwrap_or(0)).sum::<usize>(), 5);
        assert!(svg("", "", &[]).contains("</svg>"));
    }
}
