//! Solutions as the literature prints them, two decimals of a degree, against those found.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::{Options, builtin};
use looproot::internal::mechanism::Mechanism;

/// Asserts that the printed solutions are all that are found, each within a unit of its last printed digit.
fn agrees(name: &str, printed: &[[f64; 6]]) {
    let entry = builtin(name, &Options::default()).unwrap();
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let solution = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
    let found: Vec<_> = solution.modes.iter().filter(|mode| mode.real).collect();
    assert_eq!(found.len(), printed.len(), "{name}");
    for row in printed {
        let off = |mode: &&&looproot::internal::mechanism::FullMode| {
            let degrees = (0..6).map(|k| wrapped(mode.q[k].re - row[k].to_radians()).to_degrees().abs());
            degrees.fold(0.0, f64::max)
        };
        let nearest = found.iter().map(|mode| off(&mode)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.0102, "{name}: {row:?} is {nearest} degrees from the nearest");
    }
}

/// \[ManochaCanny1994\], table III.
#[test]
fn manocha_canny_1994() {
    agrees(
        "manocha_canny_1994",
        &[
            [-96.28, -6.27, 179.96, 38.48, 52.55, -39.4],
            [-120.78, 172.33, -179.07, 31.33, -146.71, 142.82],
            [88.67, -176.72, -176.72, -63.24, 157.19, 140.43],
            [113.84, 5.3, -177.74, -55.92, -62.98, -43.37],
            [-178.12, 108.19, -147.73, -5.69, -164.67, 179.58],
            [168.32, -103.89, 146.6, -17.24, -171.87, 98.16],
            [-12.94, -105.09, -114.97, 3.02, 7.41, -79.42],
            [2.51, 108.07, 112.04, -10.52, 0.0, -0.1],
            [2.51, 108.07, -67.95, -169.47, 179.99, 179.89],
            [-12.94, -105.09, 65.02, 176.97, 172.58, 100.57],
            [168.32, -103.89, -33.39, -162.75, -8.12, -81.83],
            [-178.12, 108.19, 32.26, -174.3, -15.32, -0.41],
            [88.67, -176.72, 3.27, -116.75, 22.8, -39.56],
            [-96.28, -6.27, -0.03, 141.51, 127.44, 140.59],
            [-120.78, 172.33, 0.92, 148.66, -33.28, -37.17],
            [113.84, 5.3, 2.25, -124.07, -117.01, 136.62],
        ],
    );
}

/// \[TsaiMorgan1985\], example a.
#[test]
fn tsai_morgan_1985_a() {
    agrees(
        "tsai_morgan_1985_a",
        &[
            [-80.62, -76.06, -28.47, 176.23, -125.23, 34.71],
            [-80.62, -76.06, -28.47, -3.77, 125.23, -145.29],
            [-80.62, 162.66, -146.15, -36.03, 5.23, -107.2],
            [-80.62, 162.66, -146.15, 143.97, -5.23, 72.8],
            [47.89, -103.94, -146.15, -162.84, 124.38, -84.24],
            [47.89, -103.94, -146.15, 17.16, -124.38, 95.76],
            [47.89, 17.34, -28.47, -107.55, 14.8, -166.02],
            [47.89, 17.34, -28.47, 72.45, -14.8, 13.98],
        ],
    );
}

/// \[TsaiMorgan1985\], example c.
#[test]
fn tsai_morgan_1985_c() {
    agrees(
        "tsai_morgan_1985_c",
        &[
            [167.68, 83.55, 168.07, 65.84, -88.67, -44.77],
            [-143.0, 100.07, 131.85, 18.46, -59.49, -71.52],
            [115.86, -168.65, -66.22, 157.17, -111.41, 156.71],
            [107.56, 2.0, -111.47, 166.77, -173.54, -105.56],
            [-106.07, -140.86, 22.07, -161.28, 35.54, 134.45],
            [-65.37, 142.24, 56.06, -70.9, -51.63, -116.13],
            [120.52, 31.27, -143.03, 114.15, -143.62, -64.39],
            [7.75, 103.87, -113.21, -21.37, -79.9, 82.26],
            [-16.69, 97.9, -25.97, -80.98, -25.72, -3.44],
            [47.26, 163.44, -119.49, 28.32, -41.13, 81.08],
            [20.93, 58.74, -125.17, -27.07, -125.66, 106.21],
            [38.93, -56.45, -149.2, 12.28, 72.23, 67.43],
        ],
    );
}

/// \[TsaiMorgan1985\], example b.
#[test]
fn tsai_morgan_1985_b() {
    agrees(
        "tsai_morgan_1985_b",
        &[
            [-146.88, 170.87, -11.22, -25.99, -108.51, 60.82],
            [-167.72, -173.52, 128.0, -179.64, -3.12, 179.99],
            [21.5, 135.15, -104.31, 64.39, -89.4, 77.38],
            [63.74, -47.27, -172.43, -114.49, -50.04, -11.94],
            [17.31, 19.31, 42.89, -164.02, 29.1, -17.23],
            [26.2, 6.88, -62.1, -45.96, -130.25, -129.34],
        ],
    );
}
