//! Every program of the folder examples runs, and finds what it asserts.
#![allow(clippy::unwrap_used)]

#[path = "../../examples/arm.rs"]
mod arm;
#[path = "../../examples/batch.rs"]
mod batch;
#[path = "../../examples/closed_loop.rs"]
mod closed_loop;
#[path = "../../examples/closure_polynomial.rs"]
mod closure_polynomial;
#[path = "../../examples/platform.rs"]
mod platform;

#[test]
fn an_arm_is_solved_at_a_pose() {
    arm::main().unwrap();
}

#[test]
fn a_batch_is_solved_on_all_cores() {
    batch::main().unwrap();
}

#[test]
fn a_loop_is_solved_and_swept() {
    closed_loop::main().unwrap();
}

#[test]
fn a_closure_polynomial_is_derived() {
    closure_polynomial::main().unwrap();
}

#[test]
fn a_platform_is_solved_and_its_certificate_holds() {
    platform::main().unwrap();
}

/// A program that is not in this file would not be run.
#[test]
fn no_example_is_left_out() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let this = include_str!("examples.rs");
    for file in std::fs::read_dir(folder).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        assert!(this.contains(&format!("examples/{name}")), "{name}");
    }
}
