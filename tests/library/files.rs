//! Reading mechanism files: the library, every kind of mistake with its line, and arbitrary damage.
#![allow(clippy::float_cmp)] // correctly rounded values are compared as such
#![allow(clippy::unwrap_used)]

mod platforms;

use looproot::internal::catalogue::entry::{Entry, InputValue, Kind};
use looproot::internal::catalogue::{Format, Options, builtin, builtin_names, load, load_text};
use looproot::internal::error::Error;
use looproot::internal::kinematics::chain::{Geometry, JointKind};
use looproot::internal::kinematics::motion::Motion;
use looproot_algebra::number::{HalfTangent, Number};
use proptest::prelude::*;

const ARM: &str = r#"title = "Test arm"
source = { key = "Looproot" }

[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 0, alpha = "pi/2", d = 0 },
    { type = "R", a = 0.4318, alpha = 0, d = 0, theta0 = "90 deg" },
    { type = "R", a = "20 mm", tan_half_alpha = "-1", d = 0.15 },
    { type = "R", a = 0, alpha = "-acos(3/5)", d = "1/2" },
    { type = "R", a = 0, alpha = 1.25, d = 0, tan_half_theta0 = "inf" },
    { type = "R", a = 0, alpha = 0, d = 0 },
]
tool = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.1], [0, 0, 0, 1]]
limits = [[-3, 3], [-3, 3], [-3, 3], [-3, 3], [-3, 3], ["-160 deg", "160 deg"]]

[[pose]]
matrix = [
    [0.6, -0.8, 0, 0.3],
    [0.8, 0.6, 0, 0.2],
    [0, 0, 1, 0.1],
    [0, 0, 0, 1],
]

[[pose]]
position = [0.1, 0.2, 0.3]
quaternion = [1, 0, 0, 0]
expected = { complex = 8, real = 2 }

[[pose.solution]]
q = [0, 1, 2, 3, "pi", -1.5]
digits = 10

[expected]
complex = 16
"#;

const LOOP: &str = r#"{
  "title": "Test loop",
  "units": { "length": "mm", "angle": "deg" },
  "mechanism": {
    "kind": "loop",
    "convention": "modified-dh",
    "joints": [
      { "type": "R", "a": 100, "alpha": 90, "d": 0 },
      { "type": "P", "a": 1, "alpha": "30", "theta": 0, "d0": 5 },
      { "type": "C", "a": 1, "tan_half_alpha": "1/3" },
      { "type": "C", "a": 1, "alpha": 20 },
      { "type": "R", "a": 1, "alpha": 20, "d": 1.5e1 }
    ]
  },
  "input": [
    { "joint": 1, "angle": 90 },
    { "joint": 2, "distance": "3/2" },
    { "joint": 3, "tan_half": "2/3" }
  ],
  "solution": [{ "q": [90, 1, 10, 2, 20, 3, 30] }]
}
"#;

const URDF: &str = r#"<?xml version="1.0"?>
<robot name="six">
  <link name="l0"/><link name="l1"/><link name="l2"/><link name="l3"/><link name="l4"/><link name="l5"/><link name="l6"/>
  <link name="flange"/>
  <joint name="j1" type="revolute">
    <parent link="l0"/><child link="l1"/><origin xyz="0 0 0.4" rpy="0 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0 0 1" rpy="0 1.5707963267948966 0"/><axis xyz="0 1 0"/></joint>
  <joint name="j3" type="continuous"><parent link="l2"/><child link="l3"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint>
  <joint name="j4" type="revolute"><parent link="l3"/><child link="l4"/><origin xyz="0 0 1"/></joint>
  <joint name="j5" type="prismatic"><parent link="l4"/><child link="l5"/><axis xyz="0 1 0"/></joint>
  <joint name="j6" type="revolute"><parent link="l5"/><child link="l6"/><axis xyz="0 0 1"/></joint>
  <joint name="fix" type="fixed"><parent link="l6"/><child link="flange"/><origin xyz="0 0 0.1"/></joint>
</robot>
"#;

const TABLE: &str = "type,a,alpha,d,theta0
R,0,pi/2,0,0
R,0.4318,0,0,90 deg
R,20 mm,-pi/2,0.15,0
R,0,pi/2,0.4318,0
R,0,-pi/2,0,0
R,0,0,0,0
";

fn read(text: &str) -> Result<Entry, Error> {
    load_text(text, "test.toml", Format::Toml, &Options::default())
}

fn complaint(text: &str) -> String {
    read(text).expect_err("the file has a mistake").to_string()
}

/// The complaint about `ARM` with a piece replaced.
fn changed(from: &str, to: &str) -> String {
    assert!(ARM.contains(from), "{from}");
    complaint(&ARM.replacen(from, to, 1))
}

#[test]
fn an_arm_is_read() {
    let entry = read(ARM).unwrap();
    assert_eq!((entry.name.as_str(), entry.title.as_str(), entry.kind()), ("test", "Test arm", Kind::Arm));
    let Geometry::Dh(joints) = &entry.chain().unwrap().geometry else { panic!("dh") };
    assert_eq!(joints[1].theta0.cos_sin_f64(), (0.0, 1.0));
    assert_eq!(*joints[2].a.rational(), rug::Rational::from((1, 50)));
    assert_eq!(joints[2].alpha.radians(), -std::f64::consts::FRAC_PI_2);
    assert_eq!(*joints[3].alpha.half_tangent(), HalfTangent::Finite(rug::Rational::from((-1, 2))));
    assert_eq!(*joints[4].theta0.half_tangent(), HalfTangent::Infinite);
    assert!(!joints[4].alpha.is_exact() && entry.rounded);
    assert_eq!(entry.limits.len(), 6);
    assert_eq!(entry.cases.len(), 2);
    assert_eq!(entry.cases[0].line, 18);
    assert_eq!(entry.cases[0].expected.complex, Some(16));
    assert_eq!(entry.cases[0].pose.as_ref().unwrap().defect, 0.0);
    let second = &entry.cases[1].expected;
    assert_eq!((second.complex, second.real, second.solutions[0].digits), (Some(8), Some(2), 10));
    assert_eq!(second.solutions[0].q[4], std::f64::consts::PI);
}

#[test]
fn a_loop_is_read_from_json_with_its_units() {
    let entry = load_text(LOOP, "test.json", Format::Json, &Options::default()).unwrap();
    let Geometry::ModifiedDh(joints) = &entry.chain().unwrap().geometry else { panic!("modified-dh") };
    assert_eq!(*joints[0].a.rational(), rug::Rational::from((1, 10)));
    assert_eq!(*joints[0].alpha.half_tangent(), HalfTangent::Finite(1.into()));
    assert_eq!(joints[1].kind, JointKind::Prismatic);
    assert_eq!(entry.cases.len(), 3);
    let InputValue::Distance(distance) = &entry.cases[1].input[0].value else { panic!("a distance") };
    assert_eq!(*distance.rational(), rug::Rational::from((3, 2000)));
    let q = &entry.cases[0].expected.solutions[0].q;
    assert!((q[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-15 && (q[1] - 0.001).abs() < 1e-15);
}

#[test]
fn a_table_and_a_robot_description_are_read() {
    let options = Options::default();
    let table = load_text(TABLE, "arm.csv", Format::Csv, &options).unwrap();
    assert!(table.cases.is_empty() && matches!(table.chain().unwrap().geometry, Geometry::Dh(_)));
    let robot = load_text(URDF, "six.urdf", Format::Urdf, &options).unwrap();
    let Geometry::Screws { joints, home } = &robot.chain().unwrap().geometry else { panic!("screws") };
    assert_eq!((robot.title.as_str(), joints.len(), robot.limits[0]), ("six", 6, [-3.0, 3.0]));
    assert!((home.float.translation[0] - 2.1).abs() < 1e-12 && (home.float.translation[2] - 1.4).abs() < 1e-12);
    assert_eq!(joints[2].axis.each_ref().map(Number::to_f64), [0.0, 1.0, 0.0]);
    let tip = |name: &str| Options { tip_link: Some(name.to_owned()), ..Options::default() };
    let named = |name: &str| load_text(URDF, "six.urdf", Format::Urdf, &tip(name));
    assert!(named("l6").is_ok());
    assert_eq!(named("l5").unwrap().chain().unwrap().freedoms(), 5);
    assert!(named("flnge").unwrap_err().to_string().contains("did you mean `flange`"));
    let csv = |text: &str| load_text(text, "arm.csv", Format::Csv, &options).unwrap_err().to_string();
    assert!(csv("a,b\n").starts_with("arm.csv:1: found the header"));
    assert!(csv(&TABLE.replace("R,0,0,0,0", "R,0,0,0")).starts_with("arm.csv:7: found 4 values"));
    assert!(csv(&TABLE.replace("20 mm", "20 furlong")).starts_with("arm.csv:4: found unit `furlong`"));
}

#[test]
fn screws_are_read() {
    let joint = r#"{ type = "R", axis = [0, 0, 1], point = [0, 0, 0] },"#;
    let text = |joints: &str, home: &str| {
        format!(
            "[mechanism]\nkind = \"arm\"\nconvention = \"screws\"\njoints = [{joints}]\n{home}\n[[pose]]\nposition = [1, 2, 3]\nquaternion = [1, 0, 0, 0]\n"
        )
    };
    let home = "home = [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
    assert!(read(&text(&joint.repeat(6), home)).is_ok());
    assert!(complaint(&text(&joint.repeat(6), "")).contains("found no `home`"));
    assert!(read(&text(&joint.repeat(5), home)).is_ok());
    assert!(complaint(&text(&joint.repeat(25), home)).contains("found 25 joints"));
    assert!(complaint(&text(&joint.replace("0, 0, 1", "0, 0, 0").repeat(6), home)).contains("a direction"));
    assert!(complaint(&text(&joint.replace("0, 0, 1", "0, 0").repeat(6), home)).contains("a list of 3"));
}

/// A bond is an R joint about itself, twisted by the supplement of the angle at its atom.
#[test]
fn rings_of_bonds_are_read() {
    let ring = |bonds: &str| format!("[mechanism]\nkind = \"loop\"\nconvention = \"bonds\"\nbonds = [\n{bonds}]\n");
    let bond = "{ length = 2, tan_half_angle = \"3/2\" },\n";
    let entry = read(&ring(&bond.repeat(6))).unwrap();
    let Geometry::Dh(joints) = &entry.chain().unwrap().geometry else { panic!("DH joints") };
    let half_tangents = joints.iter().map(|joint| joint.alpha.half_tangent().clone());
    assert!(half_tangents.eq(std::iter::repeat_n(HalfTangent::Finite((2, 3).into()), 6)));
    assert!(joints.iter().all(|joint| joint.d.to_f64() == 2.0 && joint.a.to_f64() == 0.0));
    // Of no rational half tangent: cosine and sine of 70 degrees are those that are meant.
    let written = read(&ring(&"{ length = 1, angle = \"110 deg\" },\n".repeat(6))).unwrap();
    let Geometry::Dh(joints) = &written.chain().unwrap().geometry else { panic!("DH joints") };
    let (cosine, sine) = joints[0].alpha.cos_sin_f64();
    assert!(
        (cosine - 70_f64.to_radians().cos()).abs() < f64::EPSILON
            && (sine - 70_f64.to_radians().sin()).abs() < f64::EPSILON
    );
    let wrong = |from: &str, to: &str| complaint(&ring(&bond.repeat(6).replacen(from, to, 1)));
    assert!(wrong("length = 2", "length = 0").contains("test.toml:5: found a bond whose length is not positive"));
    assert!(
        wrong("tan_half_angle = \"3/2\"", "angle = \"200 deg\"")
            .contains("found the angle 200.0 deg between two bonds")
    );
    assert!(
        wrong("length = 2", "lenght = 2").contains("found the unknown key `lenght` in a bond; did you mean `length`?")
    );
    let named = ring(&bond.repeat(6)).replace("\nbonds =", "\njoints =");
    assert!(complaint(&named).contains("test.toml:4: found `joints` with convention \"bonds\", expected `bonds`"));
    let of_an_arm = complaint(&ring(&bond.repeat(6)).replace("\"loop\"", "\"arm\""));
    assert!(of_an_arm.contains("found the unknown key `bonds` in the [mechanism] of an arm"), "{of_an_arm}");
}

#[test]
fn mistakes_are_named_with_their_line() {
    for (from, to, message) in [
        (
            "kind = \"arm\"",
            "kind = \"hand\"",
            "test.toml:5: found \"hand\" as `kind`, expected one of arm, loop, platform",
        ),
        (
            "convention = \"dh\"\n",
            "",
            "test.toml:4: found no `convention` in the [mechanism], expected one of dh, modified-dh, screws",
        ),
        ("convention = \"dh\"", "convention = \"DH\"", "test.toml:6: found \"DH\" as `convention`"),
        (
            "convention",
            "convetion",
            "test.toml:6: found the unknown key `convetion` in [mechanism]; did you mean `convention`?",
        ),
        ("title", "titel", "test.toml:1: found the unknown key `titel` in the file; did you mean `title`?"),
        ("d = 0, theta0", "q = 0, theta0", "test.toml:9: found the unknown key `q` in a joint; expected one of type"),
        (
            "type = \"R\", a = 0, alpha = \"pi/2\"",
            "type = \"X\", a = 0, alpha = \"pi/2\"",
            "test.toml:8: found \"X\" as `type`",
        ),
        ("a = 0, alpha = \"pi/2\"", "a = nan, alpha = \"pi/2\"", "test.toml:8: found `nan`, not a finite number"),
        ("a = 0, alpha = \"pi/2\"", "a = inf, alpha = \"pi/2\"", "test.toml:8: found `inf`, not a finite number"),
        ("a = 0, alpha = \"pi/2\"", "a = 1e200, alpha = \"pi/2\"", "test.toml:8: found `1e200`, expected a size"),
        (
            "a = 0, alpha = \"pi/2\"",
            "a = true, alpha = \"pi/2\"",
            "test.toml:8: found a truth value as `a`, expected a number",
        ),
        ("a = 0, alpha = \"pi/2\"", "a = 1979-05-27, alpha = \"pi/2\"", "test.toml:8: found a date as `a`"),
        ("a = 0, alpha = \"pi/2\"", "a = \"1/0\", alpha = \"pi/2\"", "test.toml:8: found a division by zero"),
        ("a = 0, alpha = \"pi/2\"", "a = \"3 deg\", alpha = \"pi/2\"", "test.toml:8: found `3 deg`, expected a length"),
        ("alpha = \"pi/2\"", "alpha = \"pi/\"", "test.toml:8: found an expression that ends too early"),
        ("alpha = \"pi/2\"", "alpha = \"90 mm\"", "test.toml:8: found `90 mm`, expected an angle"),
        ("alpha = \"pi/2\",", "", "test.toml:8: found neither `alpha` nor `tan_half_alpha`"),
        ("alpha = \"pi/2\",", "alpha = 0, tan_half_alpha = 0,", "test.toml:8: found both `alpha` and `tan_half_alpha`"),
        ("alpha = \"pi/2\", d = 0", "alpha = \"pi/2\"", "test.toml:8: found no `d` in an R joint"),
        ("type = \"R\", a = 0, alpha = \"pi/2\"", "a = 0, alpha = \"pi/2\"", "test.toml:8: found no `type` in a joint"),
        ("    { type = \"R\", a = 0, alpha = 0, d = 0 },\n", "", "test.toml:15: found 6 pairs of limits, expected 5"),
        (
            "    { type = \"R\", a = 0, alpha = 0, d = 0 },\n",
            "{ type = \"S\", a = 0, alpha = 0 },",
            "test.toml:15: found 6 pairs of limits, expected 8",
        ),
        ("[0, 1, 0, 0], ", "", "test.toml:15: found a list of 3 as `tool`, expected a list of 4"),
        ("[0.6, -0.8, 0, 0.3]", "[0.6, -0.8, 0]", "test.toml:20: found a list of 3 as `matrix`"),
        ("[0.6, -0.8, 0, 0.3]", "[0.7, -0.8, 0, 0.3]", "test.toml:19: found a rotation matrix off by"),
        ("[0, 0, 1, 0.1],\n", "[0, 0, -1, 0.1],\n", "test.toml:19: found a rotation with determinant -1"),
        ("[0, 0, 0, 1],\n]", "[0, 0, 0.5, 1],\n]", "test.toml:19: found the last row"),
        ("quaternion = [1, 0, 0, 0]", "quaternion = [2, 0, 0, 0]", "test.toml:28: found a quaternion of norm 2"),
        ("quaternion = [1, 0, 0, 0]", "", "test.toml:26: found a [[pose]] without exactly one"),
        ("[-3, 3], [-3, 3],", "[-3, 3],", "test.toml:16: found 5 pairs of limits, expected 6"),
        ("[-3, 3]", "[3, -3]", "test.toml:16: found the limits [3, -3]"),
        ("q = [0, 1,", "q = [0,", "test.toml:32: found 5 values in `q`, expected 6"),
        ("digits = 10", "digits = 100", "test.toml:33: found `digits` out of range"),
        ("complex = 8, real = 2", "complex = 2, real = 8", "test.toml:29: found 8 real of 2 complex"),
        ("complex = 16", "complex = -16", "test.toml:36: found the number -16 as `complex`"),
        ("[[pose]]", "[[input]]", "found `input` in the file of an arm"),
        ("[mechanism]", "[mechanism", "test.toml:4: found text that is not TOML"),
        ("title =", "units = { length = \"inch\" }\ntitle =", "test.toml:1: found \"inch\" as `length`"),
    ] {
        let found = changed(from, to);
        assert!(found.contains(message), "{from} -> {to}\n  found:    {found}\n  expected: {message}");
    }
}

#[test]
fn loops_have_seven_variables_at_most() {
    let json = |from: &str, to: &str| {
        assert!(LOOP.contains(from), "{from}");
        let text = LOOP.replacen(from, to, 1);
        load_text(&text, "test.json", Format::Json, &Options::default()).unwrap_err().to_string()
    };
    assert!(json("\"type\": \"R\", \"a\": 100", "\"type\": \"C\", \"a\": 100").contains("unknown key `d`"));
    assert!(json("\"a\": 1, \"alpha\": 20, \"d\": 1.5e1", "\"a\": 1").contains("test.json:12: found neither `alpha`"));
    let loose =
        json("\"type\": \"R\", \"a\": 1, \"alpha\": 20, \"d\": 1.5e1", "\"type\": \"S\", \"a\": 1, \"alpha\": 20");
    assert!(loose.contains("mobility 3 by Gruebler's count (9 - 6), screw rank 6 in general position"), "{loose}");
    assert!(json("\"angle\": 90 }", "\"distance\": 90 }").contains("expected `angle` or `tan_half`"));
    assert!(json("\"joint\": 1", "\"joint\": 8").contains("test.json:16: found joint 8, expected one from 1 to 5"));
    assert!(json("\"joint\": 1, ", "").contains("test.json:16: found no `joint`"));
    assert!(
        json("\"angle\": 90 }", "\"distance\": 90 }").contains("test.json:16: found a distance as input of joint 1")
    );
    assert!(json("\"angle\": 90 }", "\"angle\": 90, \"tan_half\": 1 }").contains("exactly one"));
    assert!(json("\"title\"", "\"units\": {}, \"title\"").contains("found the key `units` twice"));
    assert!(json("\"title\"", "// no\n\"title\"").contains("not JSON"));
    assert!(json("\"title\": \"Test loop\"", "\"title\": null").contains("found null as `title`"));
    assert!(json("\"alpha\": 90", "\"alpha\": \"pi/2\"").contains("expected its unit"));
}

#[test]
fn what_is_no_mechanism_file_at_all_is_refused() {
    let empty = complaint(" \n");
    assert!(empty.contains("empty file"), "{empty}");
    assert!(complaint("a = \"\0\"").contains("zero byte"));
    assert!(read(&format!("\u{feff}{ARM}")).is_ok() && read(&ARM.replace('\n', "\r\n")).is_ok());
    assert!(complaint(&"[".repeat(100_000)).contains("nested deeper"));
    assert!(complaint(&format!("{} = 1", "a.".repeat(100_000))).contains("nested deeper"));
    assert!(complaint(&format!("a = {}", "[\"]\",".repeat(100_000))).starts_with("test.toml:1:"));
    let json = load_text(&"[".repeat(100_000), "x.json", Format::Json, &Options::default());
    assert!(json.unwrap_err().to_string().contains("nested deeper"));
    let json = load_text(&"[\"]\",".repeat(100_000), "x.json", Format::Json, &Options::default());
    assert!(json.unwrap_err().to_string().starts_with("x.json:1:"));
    let xml = load_text(&"<a>".repeat(100_000), "x.urdf", Format::Urdf, &Options::default());
    assert!(xml.unwrap_err().to_string().contains("nested deeper"));
    let folder = std::env::temp_dir().join(format!("looproot-files-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
    assert!(load(&path(""), &Options::default()).unwrap_err().to_string().contains("directory"));
    std::fs::write(path("binary.toml"), [b'a', b'\n', 0xff, 0xfe]).unwrap();
    assert!(
        load(&path("binary.toml"), &Options::default()).unwrap_err().to_string().contains("binary.toml:2: found bytes")
    );
    std::fs::write(path("arm"), ARM).unwrap();
    assert!(load(&path("arm"), &Options::default()).is_ok());
    std::fs::write(path("loop"), LOOP).unwrap();
    assert!(load(&path("loop"), &Options::default()).is_ok());
    std::fs::File::create(path("huge.toml")).unwrap().set_len((64 << 20) + 1).unwrap();
    assert!(load(&path("huge.toml"), &Options::default()).unwrap_err().to_string().contains("64 MiB"));
    assert!(matches!(load(&path("nothing.toml"), &Options::default()), Err(Error::UnknownEntry { .. })));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_printed_pose_is_projected_with_a_warning() {
    let entry = read(&ARM.replacen("[0.6, -0.8, 0, 0.3]", "[0.60001, -0.8, 0, 0.3]", 1)).unwrap();
    assert!(entry.cases[0].warnings[0].contains("nearest rotation"), "{:?}", entry.cases[0].warnings);
    assert!(entry.cases[1].warnings.is_empty());
}

#[test]
fn unknown_names_suggest_near_ones() {
    let fault = load("puma56", &Options::default()).unwrap_err();
    assert!(fault.to_string().contains("did you mean `puma560`"), "{fault}");
}

/// `base * prod * tool` of the claim's joint variables, written here once more in f64 as the formats define it.
fn forward(entry: &Entry, q: &[f64]) -> Motion<f64> {
    let mut values = q.iter();
    let rz = |q: f64| Motion::rotation_z(q.cos(), q.sin());
    // The motion of a joint's variables about and along z, apart from its offsets.
    let mut variables = |kind: JointKind| match kind {
        JointKind::Revolute => (*values.next().unwrap(), 0.0, None),
        JointKind::Prismatic => (0.0, *values.next().unwrap(), None),
        JointKind::Cylindrical => (*values.next().unwrap(), *values.next().unwrap(), None),
        JointKind::Spherical => {
            let [first, second, third] = [(); 3].map(|()| *values.next().unwrap());
            let tilt = Motion::rotation_x(second.cos(), second.sin());
            (0.0, 0.0, Some(rz(first).then_after(&tilt).then_after(&rz(third))))
        }
        JointKind::Universal => {
            let [first, second] = [(); 2].map(|()| *values.next().unwrap());
            (0.0, 0.0, Some(rz(first).then_after(&Motion::rotation_x(second.cos(), second.sin()))))
        }
        JointKind::Helical => panic!("no such joint in the library"),
    };
    let mut motion = entry.chain().unwrap().base.float.clone();
    match &entry.chain().unwrap().geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            let craig = matches!(entry.chain().unwrap().geometry, Geometry::ModifiedDh(_));
            for joint in joints {
                let (angle, distance, spherical) = variables(joint.kind);
                motion = motion.then_after(&spherical.unwrap_or_else(Motion::identity));
                let angle = angle + joint.theta0.radians();
                let mut turn = Motion::rotation_z(angle.cos(), angle.sin());
                turn.translation[2] = distance + joint.d.to_f64();
                let link = looproot::internal::kinematics::motion::link(&joint.a, &joint.alpha).unwrap();
                let (first, second) = if craig { (link, turn) } else { (turn, link) };
                motion = motion.then_after(&first).then_after(&second);
            }
        }
        Geometry::Screws { joints, home } => {
            for joint in joints {
                let (angle, distance, spherical) = variables(joint.kind);
                assert!(spherical.is_none(), "no spherical joint by its axis in the library");
                let axis = joint.axis.each_ref().map(Number::to_f64);
                motion = motion.then_after(&screw(axis, joint.point.each_ref().map(Number::to_f64), angle, distance));
            }
            motion = motion.then_after(&home.float);
        }
    }
    motion.then_after(&entry.chain().unwrap().tool.float)
}

/// Rotation about and translation along an axis (Rodrigues).
fn screw(axis: [f64; 3], point: [f64; 3], angle: f64, distance: f64) -> Motion<f64> {
    let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let n = axis.map(|x| x / norm);
    let (sin, cos) = angle.sin_cos();
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    let entry = |i: usize, j: usize| f64::from(u8::from(i == j)) * cos + sin * cross[i][j] + (1.0 - cos) * n[i] * n[j];
    let mut motion = Motion::identity();
    motion.rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    let turned = motion.rotate(&point);
    motion.translation = std::array::from_fn(|i| point[i] - turned[i] + distance * n[i]);
    motion
}

#[test]
fn every_claim_of_the_library_closes() {
    let names = builtin_names();
    assert!(names.len() >= 30, "{} entries", names.len());
    for name in names {
        let entry = builtin(&name, &Options::default()).unwrap_or_else(|fault| panic!("{fault}"));
        assert!(entry.source.is_some() && entry.notes.is_some(), "{name} has no source or notes");
        for case in &entry.cases {
            assert!(case.warnings.is_empty(), "{name}: {:?}", case.warnings);
            let target = case.pose.as_ref().map_or_else(Motion::identity, |pose| pose.float.clone());
            for claim in case.expected.solutions.iter().filter(|_| entry.chain().is_some()) {
                let reached = forward(&entry, &claim.q);
                let tolerance = 30.0 * 10.0_f64.powf(-f64::from(claim.digits.min(13)));
                for i in 0..3 {
                    let off = (reached.translation[i] - target.translation[i]).abs();
                    assert!(off < tolerance, "{name}:{}: off by {off}", claim.line);
                    for j in 0..3 {
                        let off = (reached.rotation[i][j] - target.rotation[i][j]).abs();
                        assert!(off < tolerance, "{name}:{}: off by {off}", claim.line);
                    }
                }
            }
            if let (Some(real), 0) = (case.expected.real, case.expected.dimension.unwrap_or(1)) {
                let listed = case.expected.solutions.len();
                assert!(listed == real, "{name}:{}: {listed} solutions listed of {real}", case.line);
            }
        }
    }
}

#[test]
fn every_source_of_the_library_is_in_the_references() {
    let references = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/equations/REFERENCES.md")).unwrap();
    for name in builtin_names() {
        let source = builtin(&name, &Options::default()).unwrap().source.unwrap();
        assert!(references.contains(&format!("`[{}]`", source.key)), "{name}: no reference `[{}]`", source.key);
    }
}

#[test]
fn entries_that_moved_are_found_by_their_old_names() {
    for name in ["loop/ik_general", "chain/ik_general", "ik_general.toml", "loop/structure_4r", "structure_4r"] {
        let entry = builtin(name, &Options::default()).unwrap();
        assert_eq!(entry.name, name.rsplit('/').next().unwrap().trim_end_matches(".toml"));
    }
}

#[test]
fn every_entry_is_in_the_table_of_the_readme() {
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/equations/README.md")).unwrap();
    let listed: Vec<&str> =
        readme.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | ")).map(|(name, _)| name).collect();
    let listed: Vec<&str> = listed
        .into_iter()
        .filter(|name| {
            ["arm/", "chain/", "loop/", "overconstrained/", "platform/"].iter().any(|folder| name.starts_with(folder))
        })
        .collect();
    assert_eq!(listed, builtin_names());
}

/// Damage to a text.
#[derive(Clone, Debug)]
enum Damage {
    Flip(usize, u8),
    Cut(usize),
    Remove(usize),
    Double(usize),
    Number(usize, &'static str),
}

fn damage() -> impl Strategy<Value = Damage> {
    let values = prop::sample::select(vec![
        "nan",
        "-inf",
        "1e999",
        "1e308",
        "-1e149",
        "1e-320",
        "0",
        "\"\"",
        "\"1/0\"",
        "\"pi\"",
        "\"((((\"",
        "[]",
        "{}",
        "9999999999999999999999999",
        "\"tan(pi/2)\"",
        "\"1 deg\"",
        "\"inf\"",
        "0x10",
        "true",
        "\"sqrt(-1)\"",
        "1_0",
        "-0.0",
        "3.0000000001",
    ]);
    prop_oneof![
        (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Damage::Flip(at, byte)),
        any::<usize>().prop_map(Damage::Cut),
        any::<usize>().prop_map(Damage::Remove),
        any::<usize>().prop_map(Damage::Double),
        (any::<usize>(), values).prop_map(|(at, value)| Damage::Number(at, value)),
    ]
}

fn damaged(text: &str, damage: &[Damage]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for one in damage {
        if bytes.is_empty() {
            break;
        }
        let lines = |bytes: &[u8]| bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect::<Vec<_>>();
        match one {
            Damage::Flip(at, byte) => {
                let at = at % bytes.len();
                bytes[at] = *byte;
            }
            Damage::Cut(at) => bytes.truncate(at % bytes.len()),
            Damage::Remove(at) | Damage::Double(at) => {
                let mut all = lines(&bytes);
                let at = at % all.len();
                if matches!(one, Damage::Remove(_)) {
                    all.remove(at);
                } else {
                    all.insert(at, all[at].clone());
                }
                bytes = all.concat();
            }
            Damage::Number(at, value) => {
                let starts: Vec<usize> = (1..bytes.len())
                    .filter(|at| {
                        bytes[*at].is_ascii_digit() && !bytes[at - 1].is_ascii_alphanumeric() && bytes[at - 1] != b'.'
                    })
                    .collect();
                if let Some(start) = starts.get(at % starts.len().max(1)).copied() {
                    let rest = &bytes[start..];
                    let end = rest.iter().position(|b| !(b.is_ascii_digit() || *b == b'.')).unwrap_or(rest.len());
                    bytes.splice(start..start + end, value.bytes());
                }
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn damage_never_panics_and_is_named(which in 0..5_usize, damage in prop::collection::vec(damage(), 1..4)) {
        let (text, path, format) = [
            (ARM, "x.toml", Format::Toml),
            (LOOP, "x.json", Format::Json),
            (TABLE, "x.csv", Format::Csv),
            (URDF, "x.urdf", Format::Urdf),
            (platforms::PLATFORM, "x.toml", Format::Toml),
        ][which];
        let text = damaged(text, &damage);
        match load_text(&text, path, format, &Options::default()) {
            Ok(_) => {}
            Err(error) if error.unsupported().is_some() => {}
            Err(Error::File { path: named, line, message }) => {
                prop_assert_eq!(named, path);
                prop_assert!(line >= 1 && line <= text.lines().count().max(1) + 1);
                prop_assert!(message.starts_with("found"), "{}", message);
            }
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn no_text_panics_a_number(text in "[-+*/(). 0-9a-z,]{0,60}") {
        let reading = looproot_algebra::number::Reading::default();
        let _ = looproot_algebra::number::Angle::parse(&text, &reading);
    }
}

#[test]
fn faults_of_robot_descriptions_are_refused_with_their_line() {
    let refused = |text: &str| load_text(text, "six.urdf", Format::Urdf, &Options::default()).unwrap_err().to_string();
    let changed = |from: &str, to: &str| {
        assert!(URDF.contains(from), "{from}");
        refused(&URDF.replacen(from, to, 1))
    };
    for (fault, words) in [
        (changed("name=\"j3\"", "name=\"j2\""), "found two joints `j2`"),
        (changed("<link name=\"l3\"/>", "<link name=\"l3\"/><link name=\"l3\"/>"), "found two links `l3`"),
        (changed("<link name=\"l3\"/>", ""), "found no link `l3`"),
        (changed("<child link=\"l3\"/>", "<child link=\"l2\"/>"), "found link `l2` as child of two joints, j2 and j3"),
        (changed("<parent link=\"l0\"/>", "<parent link=\"l6\"/>"), "close a circle"),
        (changed("lower=\"-3\" upper=\"3\"", "lower=\"1\" upper=\"-1\""), "the lower one first"),
        (refused("<robot name=\"x\"/>"), "a robot without links"),
        (
            changed(
                "<robot name=\"six\">",
                "<robot name=\"six\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:include filename=\"a\"/>",
            ),
            "a macro of xacro",
        ),
    ] {
        assert!(fault.starts_with("six.urdf:") && fault.contains(words), "{words}: {fault}");
    }
    // A link that no joint moves is no end of a chain.
    let frame = "<link name=\"base\"/><joint name=\"b\" type=\"fixed\"><parent link=\"l0\"/><child link=\"base\"/></joint></robot>";
    let robot = load_text(&URDF.replace("</robot>", frame), "six.urdf", Format::Urdf, &Options::default()).unwrap();
    assert_eq!(robot.labels.links, Some(["l0".to_owned(), "flange".to_owned()]));
    assert_eq!(robot.labels.joints[4].as_deref(), Some("j5"));
}

/// A robot of four joints and a gripper of two fingers, as its maker describes it.
const GRIPPER: &str = r#"<robot name="gripping">
<link name="world"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="camera"/>
<link name="ns/ee_link"/><link name="left"/><link name="right"/>
<joint name="fix" type="fixed"><parent link="world"/><child link="camera"/></joint>
<joint name="waist" type="revolute"><parent link="world"/><child link="a"/><origin xyz="0 0 0.1" rpy="0 0 1.5708"/>
  <axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
<joint name="shoulder" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 0.1" rpy="1.5707963267948966 0 0"/>
  <axis xyz="0 0 1"/></joint>
<joint name="elbow" type="continuous"><parent link="b"/><child link="c"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="wrist" type="continuous"><parent link="c"/><child link="d"/><origin xyz="0.2 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="tip" type="fixed"><parent link="d"/><child link="ns/ee_link"/><origin xyz="0.1 0 0"/></joint>
<joint name="finger" type="prismatic"><parent link="ns/ee_link"/><child link="left"/><axis xyz="0 1 0"/>
  <limit lower="0" upper="0.02"/></joint>
<joint name="other" type="prismatic"><parent link="ns/ee_link"/><child link="right"/><axis xyz="0 1 0"/>
  <limit lower="0" upper="0.02"/><mimic joint="finger"/></joint>
</robot>"#;

#[test]
fn the_tip_of_the_only_arm_is_found_by_its_name() {
    let read = |text: &str, options: &Options| load_text(text, "g.urdf", Format::Urdf, options);
    let robot = read(GRIPPER, &Options::default()).unwrap();
    assert_eq!(robot.labels.links, Some(["world".to_owned(), "ns/ee_link".to_owned()]));
    assert_eq!(robot.chain().unwrap().freedoms(), 4);
    assert!(robot.labels.remarks[0].contains("the tip is link `ns/ee_link`"), "{:?}", robot.labels.remarks);
    let named: Vec<_> = robot.labels.joints.iter().flatten().map(String::as_str).collect();
    assert_eq!(named, ["waist", "shoulder", "elbow", "wrist"]);
    // Without a name that shows it, it is the last link before the fingers, of which one follows the other.
    let unnamed = read(&GRIPPER.replace("ns/ee_link", "palm"), &Options::default()).unwrap();
    assert_eq!(unnamed.labels.links, Some(["world".to_owned(), "palm".to_owned()]));
    assert!(unnamed.labels.remarks[0].contains("the last link of the only arm"), "{:?}", unnamed.labels.remarks);
    // Fingers that move on their own are ends of arms, too.
    let apart = GRIPPER.replace("ns/ee_link", "palm").replace("<mimic joint=\"finger\"/>", "");
    let fault = read(&apart, &Options::default()).map(|_| ()).unwrap_err().to_string();
    assert!(
        fault.contains("found 2 end links (left, right), expected a tip link to be named: --tip-link palm"),
        "{fault}"
    );
    // A joint that a rod follows is one of the arm.
    let rod = GRIPPER.replace("<mimic joint=\"finger\"/>", "").replace(
        "</robot>",
        r#"<link name="rod"/><joint name="follower" type="revolute"><parent link="a"/><child link="rod"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1"/><mimic joint="shoulder"/></joint></robot>"#,
    );
    assert_eq!(read(&rod, &Options::default()).unwrap().chain().unwrap().freedoms(), 4);
    // Properties that nothing uses are left over in expanded files.
    let property = GRIPPER.replace(
        "<joint name=\"fix\"",
        "<xacro:property xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"width\" value=\"2\"/><joint name=\"fix\"",
    );
    assert_eq!(read(&property, &Options::default()).unwrap().chain().unwrap().freedoms(), 4);
    let call = property.replace("xacro:property", "xacro:arm");
    assert!(read(&call, &Options::default()).map(|_| ()).unwrap_err().to_string().contains("a macro of xacro"));
    let tip = Options { tip_link: Some("palm".to_owned()), ..Options::default() };
    assert_eq!(read(&GRIPPER.replace("ns/ee_link", "palm"), &tip).unwrap().chain().unwrap().freedoms(), 4);
}

#[test]
fn printed_multiples_of_pi_are_the_angles_meant() {
    let read = |options: &Options| load_text(GRIPPER, "g.urdf", Format::Urdf, options).unwrap().labels.snapped;
    let taken = |snapped: &[looproot::internal::catalogue::Snapped]| {
        snapped.iter().map(|s| (s.meant(), s.taken)).collect::<Vec<_>>()
    };
    assert_eq!(taken(&read(&Options::default())), [("90 deg".to_owned(), false), ("90 deg".to_owned(), true)]);
    let snap = Options { snap: true, ..Options::default() };
    assert_eq!(taken(&read(&snap)), [("90 deg".to_owned(), true), ("90 deg".to_owned(), true)]);
    let table = TABLE.replacen("R,0,0,", "R,0,90,", 1);
    let fault = load_text(&table, "arm.csv", Format::Csv, &Options::default()).unwrap_err().to_string();
    assert!(fault.contains("found the twist 90") && fault.contains("write `90 deg`"), "{fault}");
}

#[test]
fn a_planning_group_names_the_chain() {
    let path = std::env::temp_dir().join(format!("looproot-group-{}.srdf", std::process::id()));
    let srdf = r#"<robot name="gripping"><group name="arm"><chain base_link="a" tip_link="d"/></group>
<group name="joints"><joint name="waist"/><joint name="shoulder"/></group><group name="all"><group name="arm"/></group></robot>"#;
    std::fs::write(&path, srdf).unwrap();
    let read = |group: &str| {
        let options = Options { group: Some((path.clone(), group.to_owned())), ..Options::default() };
        load_text(GRIPPER, "g.urdf", Format::Urdf, &options).map(|robot| robot.labels.links.unwrap().join(" to "))
    };
    assert_eq!(read("arm").unwrap(), "a to d");
    assert_eq!(read("all").unwrap(), "a to d");
    assert_eq!(read("joints").unwrap(), "world to b");
    assert!(read("leg").unwrap_err().to_string().contains("found no group `leg`, expected one of arm, joints, all"));
    let _ = std::fs::remove_file(path);
}
