//! The robots of equations/robots.json: sources and limits, and their forward kinematics against figures published elsewhere.

use looproot::Arm;
use looproot::internal::catalogue::{Options, builtin, citation, robot_names};
use std::f64::consts::{FRAC_PI_2, PI};

type Matrix = [[f64; 4]; 4];

/// Robots whose joint limits are in none of the sources.
const WITHOUT_LIMITS: [&str; 15] = [
    "crx10ia",
    "iiwa14",
    "jaco_j2n6",
    "kr5",
    "kr6_r900",
    "puma560",
    "r2000ib_200r",
    "tx2_140",
    "tx2_160",
    "tx2_160l",
    "tx40",
    "ur10",
    "ur10e",
    "ur3e",
    "ur5",
];

/// Robots with a twist or a locked joint that is no exact angle.
const ROUNDED: [&str; 2] = ["iiwa14", "jaco_j2n6"];

#[test]
fn every_robot_has_a_source_and_limits() {
    let names = robot_names();
    assert!(names.len() >= 150, "{}", names.len());
    let mut joints = [0; 8];
    for name in &names {
        let robot = builtin(name, &Options::default()).unwrap();
        let freedoms = robot.chain().unwrap().freedoms();
        joints[freedoms] += 1;
        let expected = if WITHOUT_LIMITS.contains(&name.as_str()) { 0 } else { freedoms };
        assert_eq!(robot.limits.len(), expected, "{name}");
        assert!(robot.limits.iter().all(|[low, high]| low < high), "{name}: {:?}", robot.limits);
        assert_eq!(robot.rounded, ROUNDED.contains(&name.as_str()), "{name}");
        let key = robot.source.unwrap().key;
        assert!(citation(&key).is_some(), "{name}: {key}");
    }
    assert!(joints[4] >= 4 && joints[5] >= 10 && joints[6] >= 100 && joints[7] >= 10, "{joints:?}");
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

fn moved([x, y, z]: [f64; 3]) -> Matrix {
    [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]
}

fn about_y(angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

fn about_z(angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    [[c, -s, 0.0, 0.0], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

/// Joint values spread over (-pi, pi), other ones for every number.
fn configuration(joints: usize, number: u32) -> Vec<f64> {
    [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0][..joints]
        .iter()
        .map(|x| 2.0 * PI * (x.sqrt() * f64::from(number + 3)).fract() - PI)
        .collect()
}

/// A robot with a spherical wrist by seven lengths in mm (a1, a2, b, c1 to c4), offsets in degrees and senses of its joints.
type Lengths = (&'static str, [f64; 7], [i32; 6], [i32; 6]);

/// The tables `opw_parameters_*.yaml` of the support packages of ROS-Industrial (the keys `RosIndustrialFanuc`,
/// `RosIndustrialKuka`, `RosIndustrialMotoman` and `RosIndustrialStaubli`), made independently of the descriptions beside them.
#[rustfmt::skip]
const BY_LENGTHS: [Lengths; 23] = [
    ("lrmate200ib", [150.0, -75.0, 0.0, 350.0, 250.0, 290.0, 80.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("lrmate200ic", [75.0, -75.0, 0.0, 330.0, 300.0, 320.0, 80.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("lrmate200ic_5l", [75.0, -75.0, 0.0, 330.0, 400.0, 410.0, 80.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m10ia", [150.0, -200.0, 0.0, 450.0, 600.0, 640.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m10ia_7l", [150.0, -200.0, 0.0, 450.0, 600.0, 860.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m16ib20", [150.0, -100.0, 0.0, 525.0, 770.0, 740.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m20ia", [150.0, -250.0, 0.0, 525.0, 790.0, 835.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m20ia_10l", [150.0, -250.0, 0.0, 525.0, 790.0, 1040.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m20ib_25", [75.0, -120.0, 0.0, 650.0, 905.0, 865.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("m6ib", [150.0, -100.0, 0.0, 450.0, 600.0, 615.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("r2000ic_125l", [312.0, -225.0, 0.0, 670.0, 1075.0, 1730.0, 215.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("r2000ic_165f", [312.0, -225.0, 0.0, 670.0, 1075.0, 1280.0, 215.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("kr10_r1420", [150.0, -20.0, 0.0, 450.0, 610.0, 660.0, 80.0], [0, -90, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
    ("kr150_r3100_2", [330.0, -115.0, 0.0, 645.0, 1350.0, 1420.0, 215.0], [0, -90, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
    ("kr6_r900_2", [25.0, -25.0, 0.0, 400.0, 455.0, 420.0, 90.0], [0, -90, 0, 0, 0, 0], [-1, 1, 1, -1, 1, -1]),
    ("gp110", [320.0, -235.0, 0.0, 540.0, 870.0, 1020.0, 200.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("gp4", [0.0, -15.0, 0.0, 330.0, 260.0, 290.0, 72.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("mh12", [155.0, -200.0, 0.0, 450.0, 614.0, 640.0, 100.0], [0, 0, -90, 0, 0, 180], [1, 1, -1, -1, -1, -1]),
    ("tx2_60", [0.0, 0.0, 20.0, 375.0, 290.0, 310.0, 70.0], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    ("tx2_60l", [0.0, 0.0, 20.0, 375.0, 400.0, 450.0, 70.0], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    ("tx2_90", [50.0, 0.0, 50.0, 478.0, 425.0, 425.0, 100.0], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    ("tx2_90l", [50.0, 0.0, 50.0, 478.0, 500.0, 550.0, 100.0], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
    ("tx2_90xl", [50.0, 0.0, 50.0, 478.0, 650.0, 650.0, 100.0], [0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
];

#[test]
fn robots_agree_with_published_tables_of_lengths() {
    for (name, lengths, offsets, senses) in BY_LENGTHS {
        let [a1, a2, b, c1, c2, c3, c4] = lengths.map(|x| x / 1e3);
        let robot = Arm::robot(name).unwrap();
        for number in 0..4 {
            let theta = configuration(6, number);
            let q: [f64; 6] =
                std::array::from_fn(|k| f64::from(senses[k]) * theta[k] - f64::from(offsets[k]).to_radians());
            let steps = [
                moved([0.0, 0.0, c1]),
                about_z(q[0]),
                moved([a1, b, 0.0]),
                about_y(q[1]),
                moved([0.0, 0.0, c2]),
                about_y(q[2]),
                moved([a2, 0.0, c3]),
                about_z(q[3]),
                about_y(q[4]),
                about_z(q[5]),
                moved([0.0, 0.0, c4]),
            ];
            let expected = steps.iter().fold(moved([0.0; 3]), |pose, step| product(&pose, step));
            let pose = robot.fk(&theta).unwrap();
            for (own, other) in pose.iter().flatten().zip(expected.iter().flatten()) {
                assert!((own - other).abs() < 1e-12, "{name} at {theta:?}: {pose:?}");
            }
        }
    }
}

/// Robots whose maker writes the reach in millimetres, or parts of it, into the name: from the first axis to the centre of the wrist.
const REACHES: [(&str, f64, f64); 23] = [
    ("irb1200_5_90", 900.0, 10.0),
    ("irb1200_7_70", 700.0, 10.0),
    ("irb1600_6_120", 1200.0, 50.0),
    ("irb1600_8_145", 1450.0, 10.0),
    ("irb2600_12_165", 1650.0, 10.0),
    ("irb4600_60_205", 2050.0, 10.0),
    ("irb6600_225_255", 2550.0, 10.0),
    ("irb6640_185_280", 2800.0, 10.0),
    ("kr3_r540", 540.0, 10.0),
    ("kr6_r700", 700.0, 10.0),
    ("kr6_r900", 900.0, 10.0),
    ("kr6_r900_2", 900.0, 10.0),
    ("kr10_r900_2", 900.0, 10.0),
    ("kr10_r1100", 1100.0, 10.0),
    ("kr10_r1420", 1420.0, 10.0),
    ("kr120_r2500", 2500.0, 10.0),
    ("kr150_r3100_2", 3100.0, 10.0),
    ("tx2_140", 1400.0, 10.0),
    ("tx2_160", 1600.0, 10.0),
    ("rx160", 1600.0, 10.0),
    ("ar2010", 2010.0, 1.0),
    ("irb120", 580.0, 1.0),
    ("irb140", 810.0, 1.0),
];

#[test]
fn robots_reach_as_far_as_their_names_say() {
    for (name, expected, within) in REACHES {
        let robot = Arm::robot(name).unwrap();
        // The centre of the wrist is on the last axis, where it meets the fifth: it stays where it is when the fifth joint turns.
        let at = |q: [f64; 6]| robot.fk(&q).unwrap();
        let (one, other) = (at([0.1, 0.2, 0.3, 0.4, 0.0, 0.0]), at([0.1, 0.2, 0.3, 0.4, FRAC_PI_2, 0.0]));
        let moves = |column: usize| [0, 1, 2].map(|i: usize| one[i][column] - other[i][column]);
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let depth = dot(moves(3), moves(2)) / dot(moves(2), moves(2));
        let far = |q| {
            let pose = at(q);
            (pose[0][3] - depth * pose[0][2]).hypot(pose[1][3] - depth * pose[1][2])
        };
        let mut reach = 0.0_f64;
        for elbow in 0..72 {
            for shoulder in 0..24 {
                let q = [0.0, f64::from(shoulder) * PI / 12.0, f64::from(elbow) * PI / 36.0, 0.3, FRAC_PI_2, 0.1];
                reach = reach.max(far(q) * 1e3);
            }
        }
        // The grid misses at most 1 - cos(7.5 deg) of the arm's length, less than 0.9 %.
        assert!(reach < expected + within && reach > (expected - within) * 0.99, "{name}: {reach}");
    }
}

/// Nothing shows the units of a robot that is typed by its name: lengths of options are metres for all of them, as in the documents.
#[test]
fn plain_lengths_of_robots_are_metres() {
    for name in robot_names() {
        let entry = builtin(&name, &Options::default()).unwrap();
        assert_eq!(entry.reading.units()[0], "metres", "{name}");
    }
}

/// The position of the tip in metres with all joints at zero, as the makers' drawings and manuals give it.
#[test]
fn robots_stand_at_zero_as_published() {
    for (name, position) in [
        ("panda", [0.088, 0.0, 0.926]),
        ("fr3", [0.088, 0.0, 0.926]),
        ("iiwa7", [0.0, 0.0, 1.266]),
        ("iiwa14_r820", [0.0, 0.0, 1.306]),
        ("xarm5", [0.207, 0.0, 0.112]),
        ("xarm6", [0.207, 0.0, 0.112]),
        ("xarm7", [0.206, 0.0, 0.1205]),
        ("irb120", [0.374, 0.0, 0.63]),
        ("irb140", [0.515, 0.0, 0.712]),
        ("irb2400_10", [0.94, 0.0, 1.455]),
        ("meca500", [0.19, 0.0, 0.308]),
        ("cobra600", [0.6, 0.0, 0.387]),
        ("gen3", [0.0, -0.02485, 1.18738]),
    ] {
        let robot = Arm::robot(name).unwrap();
        let pose = robot.fk(&vec![0.0; robot.freedoms()]).unwrap();
        for (i, expected) in position.iter().enumerate() {
            assert!((pose[i][3] - expected).abs() < 2e-5, "{name}: {pose:?}");
        }
    }
}
