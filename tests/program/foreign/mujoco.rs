//! Models of arms, posed by `MuJoCo` and by the reader of this library.

use super::{file, program, talk};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::forward::Forward;
use std::fmt::Write;

/// Arms of joints anyhow, each with every way to write an orientation.
fn model(number: u32) -> String {
    // Fractional parts of multiples of a square root are spread evenly.
    let mut count = f64::from(number * 1000 + 7);
    let mut next = || {
        count += 1.0;
        (count * 2f64.sqrt()).fract() * 2.0 - 1.0
    };
    let is_degrees = number.is_multiple_of(2);
    let unit = if is_degrees { 100.0 } else { 1.7 };
    let mut text = format!(
        "<mujoco><compiler angle=\"{}\" eulerseq=\"{}\"/><default><joint axis=\"1 0 0\"/><default class=\"c\">\
         <joint pos=\"0 0.1 0\" ref=\"{}\"/></default></default><worldbody>",
        if is_degrees { "degree" } else { "radian" },
        ["xyz", "ZYX", "zXy"][number as usize % 3],
        0.3 * unit
    );
    for k in 0..6 {
        let orientation = match (k + number) % 6 {
            0 => format!("quat=\"{} {} {} {}\"", next(), next(), next(), next()),
            1 => format!("euler=\"{} {} {}\"", next() * unit, next() * unit, next() * unit),
            2 => format!("axisangle=\"{} {} {} {}\"", next(), next(), next(), next() * unit),
            3 => format!("xyaxes=\"1 {} {} {} 1 {}\"", next(), next(), next(), next()),
            4 => format!("zaxis=\"{} {} {}\"", next(), next(), next()),
            _ => String::new(),
        };
        let joint = match k % 3 {
            0 => "class=\"c\"".to_owned(),
            1 => format!("axis=\"{} {} 1\"", next(), next()),
            _ => format!("type=\"slide\" ref=\"0.2\" axis=\"{} 1 0\"", next()),
        };
        let place = format!("pos=\"{} {} {}\"", next(), next(), next());
        write!(text, "<body {place} {orientation}><joint name=\"j{k}\" {joint}/><geom size=\"0.1\" mass=\"1\"/>")
            .unwrap();
    }
    text += "<site name=\"tip\" pos=\"0.1 0.2 0.3\" euler=\"0.4 0.5 0.6\"/>";
    text + &"</body>".repeat(6) + "</worldbody></mujoco>"
}

#[test]
#[ignore = "needs Python with MuJoCo"]
fn mujoco_poses_models_alike() {
    for number in 0..12 {
        let text = model(number);
        let path = file(&format!("model{number}.xml"), &text);
        let script = format!(
            "import mujoco\nmodel = mujoco.MjModel.from_xml_path({path:?})\ndata = mujoco.MjData(model)\n\
             data.qpos[:] = [0.3, -0.4, 0.1, 0.5, 1.2, -0.2]\nmujoco.mj_kinematics(model, data)\n\
             print(*map(repr, map(float, [*data.site('tip').xmat, *data.site('tip').xpos])))\n"
        );
        let answer = talk(program("python3", "LOOPROOT_PYTHON"), &script);
        let theirs: Vec<f64> = answer.split_whitespace().map(|x| x.parse().unwrap()).collect();
        assert_eq!(theirs.len(), 12, "this Python has no MuJoCo; set LOOPROOT_PYTHON to one that has: {answer}");
        let arm = load_text(&text, "model.xml", Format::Urdf, &Options::default()).unwrap();
        let ours = Forward::of(arm.chain().unwrap()).unwrap().pose(&[0.3, -0.4, 0.1, 0.5, 1.2, -0.2]);
        let ours = ours.rotation.into_iter().flatten().chain(ours.translation);
        for (own, other) in ours.zip(theirs) {
            assert!((own - other).abs() < 1e-12, "model {number}: {own} and {other}");
        }
    }
}
