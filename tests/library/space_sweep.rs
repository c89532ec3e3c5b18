//! Sweeps and scenes of linkages in space.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SpaceFile, any_from_text, builtin_any};
use looproot::internal::linkage::space::{platform_of, solve, solve_real};
use looproot::internal::report::space as report;
use looproot::internal::report::space_sweep as sweeps;
use looproot::internal::sweep::{Range, SpaceSweep, sweep_space};
use looproot::internal::verdict::{Code, Proof, Status};
use looproot::internal::view::drawable;
use serde_json::Value;
use std::f64::consts::TAU;

fn builtin(name: &str) -> Box<SpaceFile> {
    match builtin_any(name, &Options::default()).unwrap() {
        Any::Space(file) => file,
        _ => panic!("{name} is a linkage in space"),
    }
}

fn read(text: &str) -> Box<SpaceFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Space(file) => file,
        _ => panic!("a linkage in space"),
    }
}

fn swept(file: &SpaceFile, joint: &str, range: Range) -> SpaceSweep {
    let joint = file.linkage.joints.iter().position(|own| own.name == joint).unwrap();
    sweep_space(file, joint, range, || ()).unwrap()
}

/// The coupling turns until three chains are stretched: by hand the input reaches as far on both sides of 0.
#[test]
fn a_coupling_turns_between_limit_positions() {
    let file = builtin("linkage/clemens_coupling");
    let range = Range { from: 0.0, to: TAU, steps: 24 };
    let found = swept(&file, "S0", range);
    assert_eq!((found.branches.len(), found.limits.len(), found.unresolved()), (8, 8, 0));
    assert_eq!(found.verdict.code, Code::NoExactRoute);
    let inputs: Vec<f64> = found.limits.iter().map(|limit| limit.input).collect();
    let (low, high) = (inputs.iter().fold(TAU, |a, b| a.min(*b)), inputs.iter().fold(0.0, |a: f64, b| a.max(*b)));
    assert!((low + high - TAU).abs() < 1e-7, "{inputs:?}");
    // The output turns against the input at every assembly.
    let last = file.linkage.joints.iter().position(|joint| joint.name == "S1").unwrap();
    for sample in &found.samples {
        assert_eq!(sample.status == Status::Complete, !sample.modes.is_empty());
        for mode in &sample.modes {
            let turned = mode.joints[last].unwrap().re + sample.input;
            assert!(turned.sin().abs() < 1e-12 && turned.cos() > 0.0);
        }
    }
}

/// A ball between two tracks runs out of them where they are parallel.
#[test]
fn a_branch_ends_at_infinity() {
    let file = builtin("linkage/ball_in_track");
    let found = swept(&file, "S0", Range { from: 1.0, to: 3.0, steps: 10 });
    assert_eq!((found.limits.len(), found.unresolved()), (0, 0));
    let document = sweeps::json(&file, None, &found);
    let ends = |branch: &Value| [branch["begins"]["kind"].clone(), branch["ends"]["kind"].clone()];
    let ends: Vec<Value> = document["branches"].as_array().unwrap().iter().flat_map(ends).collect();
    assert!(ends.iter().any(|end| end == "infinity"), "{ends:?}");
    assert!(sweeps::text(&file, &found).contains("to infinity near 120.7678"));
}

/// The numbers of assemblies between the limit positions are those of the list at these inputs.
#[test]
fn a_leg_of_a_3rps_robot_runs_through_its_range() {
    let file = builtin("linkage/3rps");
    let found = swept(&file, "P1", Range { from: 10.0, to: 20.0, steps: 20 });
    assert_eq!((found.branches.len(), found.limits.len(), found.unresolved()), (4, 4, 0));
    for sample in &found.samples {
        let born = found.limits.iter().filter(|limit| !limit.is_largest && limit.input < sample.input).count();
        let gone = found.limits.iter().filter(|limit| limit.is_largest && limit.input < sample.input).count();
        assert_eq!(sample.modes.len(), 2 * (born - gone), "{}", sample.input);
    }
    let csv = sweeps::csv(&file, None, &found);
    assert!(
        csv.starts_with("branch,A1 [deg],P1 [m],A2 [deg],P2 [m],A3 [deg],P3 [m],plate x [m],plate y [m],plate z [m]\n")
    );
}

/// Every mode of a document has the place of every body, in the order of the scene, and bodies have parts.
#[test]
fn linkages_in_space_are_drawn() {
    for name in ["delta", "3rps", "3rrs", "rssr_ssr", "clemens_coupling", "rear_axle", "tripod", "6rus"] {
        let file = builtin(&format!("linkage/{name}"));
        let answer = solve(&file.linkage, &file.cases[0].given, true).unwrap();
        let result = report::result(&file, &file.cases[0], 1, &answer, false);
        let mut document = report::json(&file, &[result]);
        drawable(&mut document).unwrap();
        let bodies = document["scene"]["bodies"].as_array().unwrap();
        assert_eq!(bodies.len(), file.linkage.bodies.len(), "{name}");
        assert_eq!(bodies[0]["name"], file.linkage.bodies[file.linkage.ground].name.as_str());
        assert!(bodies.iter().all(|body| !body["parts"].as_array().unwrap().is_empty()), "{name}");
        for mode in document["results"][0]["modes"].as_array().unwrap() {
            let poses = mode["poses"].as_array().unwrap();
            assert_eq!(poses.len(), bodies.len());
            for (pose, body) in poses.iter().zip(bodies) {
                let own = &mode["bodies"][body["name"].as_str().unwrap()];
                let numbers: Vec<f64> = pose.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
                let listed = ["quaternion", "position"].iter().flat_map(|key| own[*key].as_array().unwrap());
                assert!(numbers.iter().zip(listed).all(|(a, b)| (a - b.as_f64().unwrap()).abs() < 1e-12), "{name}");
            }
        }
    }
}

/// A rod through the wall of the parallelogram is drawn twice, and `--scene` poses the rows of a sweep.
#[test]
fn a_sweep_of_a_delta_robot_is_drawn() {
    let file = builtin("linkage/delta");
    let found = swept(&file, "A1", Range { from: 0.0, to: 0.6, steps: 6 });
    let plate = file.linkage.bodies.iter().position(|body| body.name == "plate").unwrap();
    let traced = (plate, "plate.B1".to_owned(), file.linkage.bodies[plate].point("B1").unwrap().clone());
    let mut document = sweeps::json(&file, Some(&traced), &found);
    drawable(&mut document).unwrap();
    assert_eq!(document["scene"]["connections"].as_array().unwrap().len(), 6);
    assert_eq!(document["scene"]["traces"][0]["name"], "plate.B1");
    for branch in document["branches"].as_array().unwrap() {
        for row in branch["rows"].as_array().unwrap() {
            assert_eq!(row["poses"].as_array().unwrap().len(), 5);
            let place = |k: usize| row["points"]["plate.B1"][k].as_f64().unwrap();
            let of_plate = |k: usize| row["bodies"]["plate"]["position"][k].as_f64().unwrap();
            // The plate does not turn.
            assert!([2.0, 0.0, 0.0].iter().enumerate().all(|(k, off)| (place(k) - of_plate(k) - off).abs() < 1e-9));
        }
    }
}

/// A plate on six rods from the ends of arms has the assemblies of a platform, for which there is a proof that none is missing.
#[test]
fn six_legs_of_any_kind_are_a_platform() {
    let file = builtin("linkage/6rus");
    let case = &file.cases[0];
    let answer = solve(&file.linkage, &case.given, true).unwrap();
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!((answer.modes.len(), answer.verdict.complex), (36, 36));
    assert!(answer.modes.iter().all(|mode| mode.certified && mode.radius < 1e-9));
    // The length of a rod of a complex assembly is a difference of large squares.
    assert!(answer.modes.iter().all(|mode| mode.residual < if mode.real { 1e-12 } else { 1e-7 }));
    let real = solve_real(&file.linkage, &case.given, true).unwrap();
    assert_eq!(real.modes.len(), answer.verdict.real);
    let platform = platform_of(&file, case).unwrap().unwrap();
    assert_eq!(platform.cases.len(), 1);
    assert!(platform_of(&builtin("linkage/3rrs"), &builtin("linkage/3rrs").cases[0]).unwrap().is_none());
}

/// An arm whose axis is at the plate and whose spherical joint is at the ground holds a point of the ground on a circle of the plate.
#[test]
fn arms_may_turn_at_the_plate() {
    let text = r#"
        [mechanism]
        kind = "linkage"
        space = "space"
        ground = "base"
        joints = [
            { name = "M1", type = "R", of = ["plate", "arm1"], axis = [0, 0, 1] },
            { name = "S1", type = "S", of = ["arm1", "base"] },
            { name = "M2", type = "R", of = ["arm2", "plate"], axis = [1, 2, 2] },
            { name = "S2", type = "S", of = ["base", "arm2"] },
            { name = "M3", type = "R", of = ["base", "arm3"], axis = [0, 3, 4] },
            { name = "S3", type = "S", of = ["arm3", "plate"] },
        ]
        [mechanism.bodies]
        base = { S1 = [1, 2, -3], S2 = [4, -3, 1], M3 = [-5, 1, 0] }
        plate = { M1 = [2, 0, 1], M2 = [1, -1, 5], S3 = [-2, 4, 3] }
        arm1 = { M1 = [2, 0, 1], S1 = [1, 2, -3] }
        arm2 = { M2 = [1, -1, 5], S2 = [4, -3, 1] }
        arm3 = { M3 = [-5, 1, 0], S3 = [-2, 4, 3] }
    "#;
    let file = read(text);
    let answer = solve(&file.linkage, &[], true).unwrap();
    assert!(answer.groups.iter().all(|group| group.route == "platform"));
    assert_eq!((answer.verdict.complex, answer.verdict.status), (16, Status::Complete));
    // All bodies stand where they were drawn.
    let home = |mode: &&looproot::internal::linkage::space::SpaceMode| {
        mode.bodies.iter().all(|body| body.translation.iter().all(|c| c.norm() < 1e-9))
    };
    assert_eq!(answer.modes.iter().filter(home).count(), 1);
    assert!(answer.modes.iter().all(|mode| mode.residual < 1e-8 && mode.radius < 1e-9));
}
