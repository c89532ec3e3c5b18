//! Models for `MuJoCo`: the arm that is read is the one that the same frames make, written here as a robot description or by hand.
#![allow(clippy::unwrap_used)]

use looproot::Error;
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::forward::Forward;

fn read(text: &str, options: &Options) -> Result<Entry, Error> {
    load_text(text, "arm.xml", Format::Urdf, options)
}

fn arm(text: &str) -> Entry {
    read(text, &Options::default()).unwrap()
}

/// The pose of the tip at joint values.
fn pose(arm: &Entry, q: &[f64]) -> [[f64; 4]; 3] {
    let motion = Forward::of(arm.chain().unwrap()).unwrap().pose(q);
    std::array::from_fn(|i| std::array::from_fn(|j| if j < 3 { motion.rotation[i][j] } else { motion.translation[i] }))
}

fn are_the_same(one: &Entry, other: &Entry, joints: usize) {
    for number in 0..3 {
        let q: Vec<f64> = (0..joints).map(|k| 0.7 - 0.4 * (k as f64) + 0.3 * f64::from(number)).collect();
        let (one, other) = (pose(one, &q), pose(other, &q));
        for (a, b) in one.iter().flatten().zip(other.iter().flatten()) {
            assert!((a - b).abs() < 1e-12, "{one:?}\n{other:?}");
        }
    }
}

/// A chain of hinges about z, body k in the frame before it by `frames[k]`, with a site at the end.
fn model(compiler: &str, frames: &[&str]) -> String {
    let body = |(k, frame)| format!("<body name=\"b{k}\" pos=\"0.1 -0.2 0.3\" {frame}><joint/>");
    let bodies = frames.iter().enumerate().map(body).collect::<Vec<_>>().concat();
    let ends = "</body>".repeat(frames.len());
    format!("<mujoco>{compiler}<worldbody>{bodies}<site name=\"tip\" pos=\"0 0.1 0.2\"/>{ends}</worldbody></mujoco>")
}

/// The same as a robot description with rotations by roll, pitch and yaw.
fn description(frames: &[&str]) -> String {
    let joint = |(k, rpy): (usize, &&str)| {
        format!(
            "<link name=\"b{k}\"/><joint name=\"j{k}\" type=\"continuous\"><parent link=\"{}\"/><child link=\"b{k}\"/>\
             <origin xyz=\"0.1 -0.2 0.3\" rpy=\"{rpy}\"/><axis xyz=\"0 0 1\"/></joint>",
            if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) }
        )
    };
    let joints: String = frames.iter().enumerate().map(joint).collect();
    let last = frames.len() - 1;
    format!(
        "<robot name=\"r\"><link name=\"world\"/>{joints}<link name=\"tip\"/><joint name=\"t\" type=\"fixed\">\
         <parent link=\"b{last}\"/><child link=\"tip\"/><origin xyz=\"0 0.1 0.2\"/></joint></robot>"
    )
}

#[test]
fn orientations_of_every_form_are_rotations() {
    let right = [
        ("quat=\"1 1 0 0\"", "1.5707963267948966 0 0"),
        ("quat=\"0.7071067811865475 0 0 -0.7071067811865476\"", "0 0 -1.5707963267948966"),
        ("euler=\"90 0 0\"", "1.5707963267948966 0 0"),
        ("axisangle=\"0 0 -1 90\"", "0 0 -1.5707963267948966"),
        ("xyaxes=\"1 0 0 0 0 1\"", "1.5707963267948966 0 0"),
        ("zaxis=\"0 0 -2\"", "3.141592653589793 0 0"),
    ];
    let (mjcf, urdf): (Vec<&str>, Vec<&str>) = right.into_iter().unzip();
    let arm_of_model = arm(&model("", &mjcf));
    are_the_same(&arm_of_model, &arm(&description(&urdf)), 6);
    assert!(!arm_of_model.rounded, "right angles are exact");
    let any = [
        ("euler=\"0.2 -0.3 0.4\"", "0.4 -0.3 0.2"),
        ("quat=\"2 0 0 2\"", "0 0 1.5707963267948966"),
        ("axisangle=\"0 3 0 0.7\"", "0 0.7 0"),
        ("quat=\"0.9238795325112867 0 0 -0.3826834323650898\"", "0 0 -0.7853981633974483"),
        ("", "0 0 0"),
    ];
    let (mjcf, urdf): (Vec<&str>, Vec<&str>) = any.into_iter().unzip();
    let compiler = "<compiler angle=\"radian\" eulerseq=\"zyx\"/>";
    are_the_same(&arm(&model(compiler, &mjcf)), &arm(&description(&urdf)), 5);
    // Axes in capitals stand still: the order is reversed.
    let (turning, still) = (["euler=\"10 20 30\""; 4], ["euler=\"30 20 10\""; 4]);
    let of = |sequence: &str, frames: &[&str]| arm(&model(&format!("<compiler eulerseq=\"{sequence}\"/>"), frames));
    are_the_same(&of("zyx", &turning), &of("XYZ", &still), 4);
}

/// Joints beside the origin of their body, with values other than 0 in the model, two in one body, with defaults.
const ODD: &str = r#"<mujoco model="odd"><compiler angle="degree"/>
<default><joint axis="1 0 0" range="-10 20"/><site pos="0 0 9"/>
  <default class="arm"><joint axis="0 0 1"/>
    <default class="bent"><joint pos="0 0.1 0" ref="90"/></default></default></default>
<worldbody>
 <body name="base" childclass="arm" pos="0 0 1">
  <frame pos="1 0 0" euler="0 0 90">
   <body name="one">
    <joint name="waist"/>
    <joint name="slider" class="main" type="slide" ref="0.25" range="-0.5 0.5"/>
    <body name="two" pos="0.5 0 0">
     <joint name="elbow" class="bent"/>
     <body name="three" pos="0 0 0.2">
      <joint name="last" limited="false" pos="0 0 7"/>
      <site name="tool" pos="0.1 0 0" class="main"/>
     </body>
    </body>
   </body>
  </frame>
 </body>
</worldbody></mujoco>"#;

#[test]
fn joints_are_where_their_bodies_and_classes_put_them() {
    let odd = arm(ODD);
    let degree = 1f64.to_radians();
    assert_eq!(odd.title, "odd");
    let limits: [[f64; 2]; 3] = [[-10.0 * degree, 20.0 * degree], [-0.5, 0.5], [-10.0 * degree, 20.0 * degree]];
    assert_eq!(odd.limits[..3], limits);
    assert!(odd.limits[3][0].is_infinite());
    let names: Vec<&str> = odd.labels.joints.iter().map(|name| name.as_deref().unwrap()).collect();
    assert_eq!(names, ["waist", "slider", "elbow", "last"]);
    assert_eq!(odd.labels.links, Some(["world".to_owned(), "tool".to_owned()]));
    // In the model the waist and the last joint are at 0, the slider at 0.25 and the elbow at 90 degrees.
    let at_rest = pose(&odd, &[0.0, 0.25, 90.0 * degree, 0.0]);
    let expected = [1.0, 0.6, 1.2];
    for (row, expected) in at_rest.iter().zip(expected) {
        assert!((row[3] - expected).abs() < 1e-12, "{at_rest:?}");
    }
    // The slider is along x of the body, which stands along y of the world. The elbow turns back about a point beside it.
    let moved = pose(&odd, &[0.0, 0.35, 0.0, 0.0]);
    // About (0.5, 0.1) of the first body, (0.6, 0) comes to (0.4, 0) by a quarter turn back.
    let expected = [1.0 - 0.0, 0.1 + 0.4, 1.2];
    for (row, expected) in moved.iter().zip(expected) {
        assert!((row[3] - expected).abs() < 1e-12, "{moved:?}");
    }
}

#[test]
fn the_tip_is_a_site_or_what_the_gripper_is_on() {
    let chain = |inner: &str| {
        format!(
            "<mujoco><worldbody>{}{inner}{}</worldbody><equality><joint joint1=\"left\" joint2=\"right\"/></equality></mujoco>",
            "<body pos=\"0 0 0.1\" euler=\"90 0 0\"><joint/>".repeat(4),
            "</body>".repeat(4)
        )
    };
    let ends = |arm: &Entry| arm.labels.links.clone().unwrap()[1].clone();
    let fingers = "<body name=\"hand\" pos=\"0 0 0.1\"><body name=\"f1\"><joint name=\"left\" type=\"slide\"/></body>\
                   <body name=\"f2\"><joint name=\"right\" type=\"slide\"/></body></body>";
    assert_eq!(ends(&arm(&chain(fingers))), "hand");
    assert_eq!(ends(&arm(&chain("<site name=\"grip_tcp\"/><site name=\"camera\"/>"))), "grip_tcp");
    let options = Options { tip_link: Some("camera".to_owned()), ..Options::default() };
    assert_eq!(ends(&read(&chain("<site name=\"grip_tcp\"/><site name=\"camera\"/>"), &options).unwrap()), "camera");
    // A site may have the name of a body.
    let options = Options { tip_link: Some("site:hand".to_owned()), ..Options::default() };
    let shared = chain("<body name=\"hand\"><site name=\"hand\" pos=\"0 0 0.2\"/></body>");
    assert_eq!(ends(&read(&shared, &options).unwrap()), "site:hand");
    // A robot that floats is read from a body of its own.
    let floating = chain("<site name=\"tip\"/>").replacen(
        "<body pos=\"0 0 0.1\"",
        "<body name=\"base\"><freejoint/><body pos=\"0 0 0.1\"",
        1,
    );
    let floating = floating.replacen("</worldbody>", "</body></worldbody>", 1);
    let error = read(&floating, &Options::default()).unwrap_err();
    assert!(error.unsupported().is_some() && error.to_string().contains("--base-link BODY"), "{error}");
    let options = Options { base_link: Some("base".to_owned()), ..Options::default() };
    assert_eq!(ends(&read(&floating, &options).unwrap()), "tip");
}

#[test]
fn faults_of_models_are_refused_with_their_line() {
    let body = |inside: &str| format!("<mujoco>\n<worldbody>\n{inside}\n</worldbody></mujoco>");
    let arm = |frame: &str, joint: &str| {
        body(&format!(
            "<body {frame}><joint {joint}/><body><joint/><body><joint/><body><joint/></body></body></body></body>"
        ))
    };
    for (text, line, words) in [
        ("<model/>".to_owned(), 1, "found <model>, expected <robot> or <mujoco>"),
        ("<mujoco/>".to_owned(), 1, "a model without bodies"),
        ("<mujoco>\n<include file=\"a.xml\"/></mujoco>".to_owned(), 2, "found <include>, expected a model in one file"),
        (
            "<mujoco>\n<compiler angle=\"grad\"/><worldbody><body/></worldbody></mujoco>".to_owned(),
            2,
            "\"grad\" as `angle`",
        ),
        (
            "<mujoco>\n<compiler eulerseq=\"xyw\"/><worldbody><body/></worldbody></mujoco>".to_owned(),
            2,
            "\"xyw\" as `eulerseq`",
        ),
        (
            "<mujoco><default>\n<default/></default><worldbody><body/></worldbody></mujoco>".to_owned(),
            2,
            "class without name",
        ),
        (body("<replicate count=\"2\"/><body/>"), 3, "found <replicate>"),
        (body("<body name=\"a\"/>\n<body name=\"a\"/>"), 4, "found two bodies `a`"),
        (arm("childclass=\"x\"", ""), 3, "found the default class `x`, expected one of none"),
        (arm("pos=\"1 2\"", ""), 3, "found 2 numbers in `pos`, expected 3"),
        (arm("quat=\"0 0 0 0\"", ""), 3, "found the quaternion 0 0 0 0"),
        (arm("quat=\"1 0 0 0\" euler=\"0 0 0\"", ""), 3, "found `quat` and `euler`, expected one orientation"),
        (arm("zaxis=\"0 0 0\"", ""), 3, "found the axis 0 0 0"),
        (arm("xyaxes=\"1 0 0 2 0 0\"", ""), 3, "two axes that are parallel"),
        (arm("", "axis=\"0 0 0\""), 3, "found the axis 0 0 0"),
        (arm("", "range=\"3 1\""), 3, "the lower one first"),
        (arm("", "limited=\"true\""), 3, "without `range`"),
        (arm("", "type=\"ball\""), 3, "joint type `ball`"),
        (body("<body><frame><joint/></frame></body>"), 3, "not directly in its body"),
    ] {
        let error = read(&text, &Options::default()).unwrap_err().to_string();
        let place = format!("arm.xml:{line}");
        assert!(error.trim_start_matches("unsupported: ").starts_with(&place), "{place}: {error}");
        assert!(error.contains(words), "{words}: {error}");
    }
}
