//! What is proved of linkages whose inputs are irrational rotations.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::{LinkageAnswer, solve};
use looproot::internal::verdict::{Proof, Status};

fn four_bar([crank, coupler, rocker, frame]: [&str; 4], angle: &str) -> Box<LinkageFile> {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n\
         [mechanism.bodies]\nframe = {{ A = 0, D = \"{frame}\" }}\ncrank = {{ A = 0, B = \"{crank}\" }}\n\
         coupler = {{ B = 0, C = \"{coupler}\" }}\nrocker = {{ D = 0, C = \"{rocker}\" }}\n\
         [[input]]\njoint = \"A\"\nangle = \"{angle}\"\n"
    );
    match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    }
}

fn solved(lengths: [&str; 4], angle: &str) -> LinkageAnswer {
    let file = four_bar(lengths, angle);
    solve(&file.linkage, &file.cases[0].given, file.accuracy(&file.cases[0])).unwrap()
}

fn judged(answer: &LinkageAnswer) -> (Status, Proof, usize) {
    (answer.verdict.status, answer.verdict.proof, answer.verdict.real)
}

#[test]
fn an_angle_in_degrees_is_proved() {
    let answer = solved(["3/2", "4", "3", "4"], "60 deg");
    assert_eq!(judged(&answer), (Status::Complete, Proof::Proved, 2));
    for mode in &answer.modes {
        // The coupler joins the ends of the crank and of the rocker.
        let (b, d) = ([0.75, 0.75 * 3.0_f64.sqrt()], [4.0, 0.0]);
        let rocker = mode.bodies[3].0.re;
        let c = [d[0] + 3.0 * rocker.cos(), d[1] + 3.0 * rocker.sin()];
        assert!(((c[0] - b[0]).hypot(c[1] - b[1]) - 4.0).abs() < 1e-13, "{mode:?}");
    }
    assert_eq!(judged(&solved(["3/2", "1", "1", "4"], "1.25 rad")), (Status::Unreachable, Proof::Proved, 0));
}

#[test]
fn what_an_irrational_equality_decides_is_not_proved() {
    // The crank ends at the distance 1 from D, exactly: coupler and rocker are in line.
    let (status, proof, _) = judged(&solved(["1", "1/2", "1/2", "1"], "60 deg"));
    assert!(proof != Proof::Proved, "{status:?} {proof:?}");
    // A rhombus at its input: the coupler coincides with nothing, and both assemblies are apart.
    assert_eq!(judged(&solved(["1", "1", "1", "1"], "60 deg")), (Status::Complete, Proof::Proved, 2));
}

#[test]
fn rounded_lengths_stay_rounded() {
    let answer = solved(["sqrt(2)", "4", "3", "4"], "60 deg");
    assert_eq!(judged(&answer), (Status::Complete, Proof::RoundedData, 2));
}
