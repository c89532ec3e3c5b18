//! Proved sweeps of linkages on the sphere against counts at single inputs.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SphereFile, any_from_text, builtin_any};
use looproot::internal::linkage::sphere::solve;
use looproot::internal::sweep::{AssemblyBranch, End, Range, SphereSweep, sweep_sphere};
use looproot::internal::verdict::{Proof, Status};
use std::f64::consts::PI;

/// A direction in the plane of two axes, at an angle whose half tangent is n/d from the first.
fn arc((n, d): (i32, i32)) -> String {
    let square = n * n + d * d;
    format!("[\"{}/{square}\", \"{}/{square}\", 0]", d * d - n * n, 2 * n * d)
}

/// A four-bar whose links have these arcs, as half tangents: crank, coupler, rocker, frame.
fn four_bar([a, b, c, d]: [(i32, i32); 4]) -> Box<SphereFile> {
    let [a, b, c, d] = [a, b, c, d].map(arc);
    let x = "[1, 0, 0]";
    let z = "[0, 0, 1]";
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"frame\"\njoints = [\n\
         {{ name = \"A\", type = \"R\", of = [\"frame\", \"crank\"], zero = [{z}, {z}] }},\n\
         {{ name = \"B\", type = \"R\", of = [\"crank\", \"coupler\"], zero = [{z}, {z}] }},\n\
         {{ name = \"C\", type = \"R\", of = [\"coupler\", \"rocker\"], zero = [{z}, {z}] }},\n\
         {{ name = \"D\", type = \"R\", of = [\"frame\", \"rocker\"], zero = [{z}, {z}] }}]\n\
         [mechanism.bodies]\nframe = {{ A = {x}, D = {d} }}\ncrank = {{ A = {x}, B = {a} }}\n\
         coupler = {{ B = {x}, C = {b} }}\nrocker = {{ D = {x}, C = {c} }}\n[[input]]\njoint = \"A\"\ntan_half = \"1/2\"\n"
    );
    match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Sphere(file) => file,
        _ => panic!("a linkage on the sphere"),
    }
}

fn sweep(file: &SphereFile, steps: usize) -> SphereSweep {
    let joint = file.cases[0].given.iter().find_map(|one| one.joint).unwrap();
    let case = &file.cases[0];
    let range = Range { from: -PI, to: PI, steps };
    sweep_sphere(&file.linkage, (&case.given, file.exact && case.exact), joint, range).unwrap()
}

/// As many branches are over inputs as there are assemblies.
fn agrees(file: &SphereFile, found: &SphereSweep) {
    let name = &file.linkage.joints[found.joint].name;
    for k in -8_i32..=8 {
        let input = 2.0 * (f64::from(97 * k + 5) / 331.0).atan();
        let case = file.case_with(&format!("{name} = {input}")).unwrap();
        let answer = solve(&file.linkage, &case.given, true).unwrap();
        let is_over = |branch: &AssemblyBranch| {
            let turns = (-3..=3).map(|turn| input + 2.0 * PI * f64::from(turn));
            turns.filter(|x| *x > branch.from && *x < branch.to).count()
        };
        let count: usize = found.branches.iter().map(is_over).sum();
        assert_eq!(count, answer.modes.iter().filter(|mode| mode.real).count(), "{input}");
    }
}

#[test]
fn four_bars_on_the_sphere_are_proved_with_as_many_branches_as_assemblies() {
    let all = [
        [(1, 4), (1, 2), (1, 3), (1, 2)],
        [(1, 2), (1, 3), (1, 4), (2, 3)],
        [(1, 1), (1, 3), (1, 2), (1, 1)],
        [(2, 1), (1, 3), (3, 2), (1, 2)],
        [(1, 5), (1, 5), (1, 5), (2, 1)],
    ];
    for arcs in all {
        let file = four_bar(arcs);
        let found = sweep(&file, 6);
        assert_eq!(found.verdict.proof, Proof::Proved, "{arcs:?}: {}", found.verdict.reason);
        agrees(&file, &found);
    }
}

#[test]
fn branches_on_the_sphere_go_straight_through_change_points() {
    // Opposite arcs are equal: the four-bar folds flat at two inputs, and neither is a limit position.
    let file = four_bar([(1, 4), (1, 2), (1, 4), (1, 2)]);
    let found = sweep(&file, 12);
    assert_eq!((found.verdict.proof, found.limits.len()), (Proof::Proved, 0), "{}", found.verdict.reason);
    assert_eq!(found.branches.len(), 2);
    assert!(found.branches.iter().all(|branch| branch.begin == End::Closed(1)));
    agrees(&file, &found);
    // A kite with equal crank and frame: where the crank lies on the frame the other links turn by themselves.
    let kite = four_bar([(1, 2), (1, 4), (1, 4), (1, 2)]);
    let found = sweep(&kite, 12);
    assert!(found.verdict.proof == Proof::None || found.verdict.status == Status::Complete);
    agrees(&kite, &found);
}

#[test]
fn linkages_of_dyads_on_the_sphere_in_the_library_are_proved() {
    // At some inputs of Watt's linkage the basis is too large for `solve`: its branches are not counted.
    for name in ["spherical_four_bar", "hooke_series", "spherical_cusp", "spherical_watt"] {
        let Any::Sphere(file) = builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() else {
            panic!("a linkage on the sphere")
        };
        let found = sweep(&file, 6);
        assert_ne!(found.verdict.proof, Proof::None, "{name}: {}", found.verdict.reason);
        if name != "spherical_watt" {
            agrees(&file, &found);
        }
    }
}
