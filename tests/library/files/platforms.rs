//! Platform files: read exactly, and every mistake named with its line.

use super::{complaint, read};
use looproot::internal::catalogue::entry::{Design, Entry, Kind};
use looproot::internal::catalogue::{Format, Options, builtin, builtin_names, load_text};
use looproot::internal::kinematics::platform::Platform;
use looproot_algebra::number::Number;
use rug::Rational;

pub const PLATFORM: &str = r#"title = "Test platform"
units = { length = "cm" }

[mechanism]
kind = "platform"
base = [
    [0, 0, 0],
    [100, 0, 0],
    [100, "1 m", 0],
    [0, 100, 10],
    [50, 0, 70],
    ["1/3", "sqrt(2)", 0],
]
plate = [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0], [0, 0, 30], [10, 20, 30]]
legs = [100, "3/2 m", 120, 0, 90, 110]

[expected]
complex = 40
real = 2

[[solution]]
quaternion = [0.6, 0, 0, 0.8]
position = [10, 20, 30]
digits = 8
"#;

/// Returns a platform with the same points, to test the places of lengths.
fn with(legs: &str) -> String {
    let head = &PLATFORM[..PLATFORM.find("legs =").unwrap()];
    format!("{head}{legs}\n")
}

fn squares(entry: &Entry, case: usize) -> Vec<Rational> {
    entry.cases[case].legs_squared.as_ref().unwrap().iter().map(|square| square.rational().clone()).collect()
}

/// The complaint about `PLATFORM` with a piece replaced.
fn changed(from: &str, to: &str) -> String {
    assert!(PLATFORM.contains(from), "{from}");
    complaint(&PLATFORM.replacen(from, to, 1))
}

#[test]
fn a_platform_is_read_with_its_units() {
    let entry = read(PLATFORM).unwrap();
    let Design::Platform(platform) = &entry.design else { panic!("a platform") };
    assert_eq!((entry.kind(), entry.chain().is_none(), entry.rounded), (Kind::Platform, true, true));
    assert_eq!(*platform.base[2][1].rational(), 1);
    assert_eq!(*platform.base[5][0].rational(), Rational::from((1, 300)));
    assert!((platform.base[5][1].to_f64() - 0.01 * 2.0_f64.sqrt()).abs() < 1e-17);
    assert_eq!(squares(&entry, 0)[..2], [Rational::from(1), Rational::from((9, 4))]);
    let case = &entry.cases[0];
    assert_eq!((case.line, case.expected.complex, case.expected.real), (15, Some(40), Some(2)));
    assert!(case.warnings[0].starts_with("leg 4 of length 0"), "{:?}", case.warnings);
    assert_eq!(case.expected.solutions[0].q, [0.6, 0.0, 0.0, 0.8, 0.1, 0.2, 0.3]);
}

#[test]
fn the_lengths_may_stand_in_three_places() {
    let squared = read(&with("legs_squared = [10000, 22500, 3, 4, 5, \"1/3\"]")).unwrap();
    assert_eq!(squares(&squared, 0)[1], Rational::from((9, 4)));
    assert_eq!(squares(&squared, 0)[5], Rational::from((1, 30000)));
    let blocks = "[[legs]]\nlengths = [1, 2, 3, 4, 5, 6]\nexpected = { complex = 40 }\n[[legs]]\nsquared = [1, 2, 3, 4, 5, 6]\n\
        [[legs.solution]]\nquaternion = [1, 0, 0, 0]\nposition = [0, 0, 0]\n";
    let several = read(&with(blocks)).unwrap();
    assert_eq!((several.cases.len(), several.cases[0].expected.complex), (2, Some(40)));
    assert_eq!((several.cases[1].line, several.cases[1].expected.solutions.len()), (18, 1));
    assert_eq!(squares(&several, 0)[3], Rational::from((16, 10000)));
    assert_eq!(squares(&several, 1)[3], Rational::from((4, 10000)));
    let poses = "[[pose]]\nposition = [0, 0, 50]\nquaternion = [\"3/5\", 0, 0, \"4/5\"]\n[[pose]]\n\
        matrix = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 50], [0, 0, 0, 1]]\n";
    let posed = read(&with(poses)).unwrap();
    assert_eq!(posed.cases.len(), 2);
    // Plate point 2 turned by 90 degrees and lifted by 0.5 m: from (1, 0, 0) to (0, 0.5, 0.5).
    assert_eq!(squares(&posed, 1)[1], Rational::from((3, 2)));
    assert_eq!(squares(&posed, 0)[0], Rational::from((1, 4)));
    let json = r#"{ "mechanism": { "kind": "platform", "legs": [1, 1, 1, 1, 1, 1],
        "base": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1], [3, 2, 1], [1, 2, 3]],
        "plate": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1], [3, 2, 1], [1, 2, 3]] } }"#;
    assert_eq!(load_text(json, "x.json", Format::Json, &Options::default()).unwrap().cases.len(), 1);
}

#[test]
fn mistakes_in_platforms_are_named_with_their_line() {
    for (from, to, message) in [
        ("    [0, 0, 0],\n", "", "test.toml:6: found 5 points in `base`, expected 6, one per leg"),
        ("[0, 0, 30], ", "[0, 0, 30], [1, 2, 3], ", "test.toml:14: found 7 points in `plate`, expected 6"),
        ("[100, 0, 0]", "[100, 0]", "test.toml:8: found a list of 2 as `base`, expected a list of 3"),
        ("[100, 0, 0]", "[nan, 0, 0]", "test.toml:8: found `nan`, not a finite number"),
        ("[100, 0, 0]", "[inf, 0, 0]", "test.toml:8: found `inf`, not a finite number"),
        ("[100, 0, 0]", "[1e200, 0, 0]", "test.toml:8: found `1e200`, expected a size"),
        ("[100, 0, 0]", "[\"1 deg\", 0, 0]", "test.toml:8: found `1 deg`, expected a length"),
        ("legs = [100, ", "legs = [", "test.toml:15: found 5 values in `legs`, expected 6, one per leg"),
        ("legs = [100, ", "legs = [100, 100, ", "test.toml:15: found 7 values in `legs`, expected 6, one per leg"),
        ("legs = [100, ", "legs = [-100, ", "test.toml:15: found the negative length -1 of leg 1, expected 0 or more"),
        ("legs = [100, ", "legs = [nan, ", "test.toml:15: found `nan`, not a finite number"),
        ("legs = [100, ", "legs = [\"-inf\", ", "test.toml:15: found"),
        (
            "legs =",
            "legs_squared = [1, 2, 3, 4, 5, -6]\n#",
            "test.toml:15: found the negative squared length -0.0006 of leg 6",
        ),
        (
            "legs =",
            "legs_squared = [\"1 m\", 2, 3, 4, 5, 6]\n#",
            "test.toml:15: found `1 m`, expected a number without unit",
        ),
        (
            "legs =",
            "legs_squared = [1, 1, 1, 1, 1, 1]\nlegs =",
            "test.toml:15: found both of `legs` and `legs_squared`",
        ),
        ("legs =", "# legs =", "test.toml:1: found no legs, expected `legs` or `legs_squared` in the [mechanism]"),
        (
            "[expected]",
            "[[pose]]\nposition = [0, 0, 0]\nquaternion = [1, 0, 0, 0]\n[expected]",
            "in two places, expected one",
        ),
        ("[expected]", "[[legs]]\nlengths = [1, 1, 1, 1, 1, 1]\n[expected]", "in two places, expected one"),
        (
            "[expected]",
            "[[input]]\njoint = 1\nangle = 0\n[expected]",
            "found `input` in the file of a platform, expected `legs` or `pose`",
        ),
        (
            "kind = \"platform\"",
            "kind = \"platform\"\nconvention = \"dh\"",
            "test.toml:6: found the unknown key `convention`",
        ),
        ("plate =", "plates =", "test.toml:14: found the unknown key `plates` in [mechanism]; did you mean `plate`?"),
        (
            "quaternion = [0.6,",
            "quaternion = [0.7,",
            "test.toml:22: found a quaternion of norm 1.063015, expected 1 to within 1e-3",
        ),
        (
            "quaternion = [0.6, 0, 0, 0.8]\n",
            "",
            "test.toml:21: found no `quaternion` in the [[solution]] of a platform",
        ),
        ("quaternion = [0.6, 0, 0, 0.8]", "q = [1, 2, 3, 4, 5, 6]", "test.toml:22: found the unknown key `q`"),
    ] {
        let found = changed(from, to);
        assert!(found.contains(message), "{from} -> {to}\n  found:    {found}\n  expected: {message}");
    }
    assert!(
        complaint(&with("[[legs]]\nlengths = [1, 1, 1, 1, 1, 1]\nsquared = [1, 1, 1, 1, 1, 1]")).contains("found both")
    );
    assert!(complaint(&with("[[legs]]\nexpected = { real = 2 }")).contains("found neither of `lengths` and `squared`"));
    assert!(complaint(&with("legs = []")).contains("found 0 values in `legs`"));
    assert!(complaint("legs = []\n[mechanism]\nkind = \"platform\"").contains("found no `base`"));
}

#[test]
fn bodies_without_extent_are_no_platforms() {
    let plate = |points: &str| {
        let all = "plate = [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0], [0, 0, 30], [10, 20, 30]]";
        changed(all, &format!("plate = [{points}]"))
    };
    let point = "[0.1, 0.2, \"1/3\"], ".repeat(6);
    assert!(plate(&point).contains("test.toml:14: found six equal points in `plate`, expected a body of some size"));
    let line = (0..6).map(|k| format!("[{k}, {}, 7]", 2 * k)).collect::<Vec<_>>().join(", ");
    assert!(plate(&line).contains("test.toml:14: found all points of `plate` on one line"));
    // Nearly so, as rounding would have it; and as far from it as a millionth.
    let nearly = |off: &str| line.replacen("[2, 4, 7]", &format!("[2, {off}, 7]"), 1);
    assert!(plate(&nearly("4.00000000000001")).contains("found all points of `plate` on one line"));
    let all = "plate = [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0], [0, 0, 30], [10, 20, 30]]";
    assert!(read(&PLATFORM.replacen(all, &format!("plate = [{}]", nearly("4.00001")), 1)).is_ok());
}

#[test]
fn two_legs_between_the_same_points_are_refused() {
    let twice = PLATFORM.replacen("[100, 0, 0]", "[0, 0, 0]", 1);
    assert!(read(&twice).is_ok(), "legs that share one end");
    let found = complaint(&twice.replacen("[50, 0, 0]", "[0, 0, 0]", 1));
    assert!(found.contains("test.toml:14: found legs 1 and 2 between the same two points"), "{found}");
}

#[test]
fn every_claimed_pose_of_the_library_fits_its_legs() {
    for name in builtin_names().into_iter().filter(|name| name.starts_with("platform/")) {
        let entry = builtin(&name, &Options::default()).unwrap();
        let Design::Platform(numbers) = &entry.design else { panic!("{name}") };
        let points = |p: &[[Number; 3]; 6]| p.each_ref().map(|p| p.each_ref().map(Number::to_f64));
        let Platform { base, plate } = Platform { base: points(&numbers.base), plate: points(&numbers.plate) };
        for case in &entry.cases {
            let wanted = case.legs_squared.as_ref().unwrap();
            for claim in &case.expected.solutions {
                let [w, x, y, z, a, b, c] = claim.q[..] else { panic!("{name}") };
                for leg in 0..6 {
                    // q v q* of the plate point, written out.
                    let v = plate[leg];
                    let t = [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]].map(|t| 2.0 * t);
                    let turned = [
                        v[0] + w * t[0] + y * t[2] - z * t[1],
                        v[1] + w * t[1] + z * t[0] - x * t[2],
                        v[2] + w * t[2] + x * t[1] - y * t[0],
                    ];
                    let end = [a + turned[0], b + turned[1], c + turned[2]];
                    let square: f64 = (0..3).map(|k| (end[k] - base[leg][k]).powi(2)).sum();
                    let off = (square - wanted[leg].to_f64()).abs() / (square + wanted[leg].to_f64());
                    assert!(off < 1e-11, "{name}:{}: leg {leg} off by {off:e}", claim.line);
                }
            }
        }
    }
}
