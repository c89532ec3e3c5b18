//! Cells of a parameter: the number of real modes of every cell is that of the sweep, of the solver, and of derivations.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Any, LinkageFile, Options, load, load_any};
use looproot::internal::derivation::{Watch, derive};
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::sweep::{
    Cells, EntryCase, Label, LinkageCase, MapWanted, Range, SpaceCase, SphereCase, Subject, cell_map, cells, sweep,
};
use looproot::internal::verdict::{Code, Proof};
use rug::Rational;
use std::f64::consts::PI;

fn entry(name: &str) -> Entry {
    load(name, &Options::default()).unwrap()
}

fn found(entry: &Entry, parameter: &str) -> Cells {
    cells(&EntryCase::new(entry, &entry.cases[0]), parameter, &Watch::none()).unwrap()
}

/// The solver agrees at the sample point of every cell.
fn holds(cells: &Cells) {
    assert!(!cells.cells.is_empty());
    for cell in &cells.cells {
        assert_eq!(cell.solved, Some(cell.modes), "{}: {cell:?}", cells.parameter);
    }
}

#[test]
fn the_cells_of_an_input_are_those_of_the_sweep() {
    for (name, joint) in [
        ("rssr", 1),
        ("bennett_a", 1),
        ("bennett_c", 1),
        ("cccr_1_angle", 1),
        ("crcrr_2_angle", 2),
        ("crcrr_4_angle", 4),
        ("rrsrr", 1),
        ("planar_4r", 1),
        ("goldberg_a", 1),
    ] {
        let entry = entry(name);
        let own = found(&entry, &format!("theta{joint}"));
        holds(&own);
        assert!(matches!(own.verdict.proof, Proof::Proved | Proof::RoundedData), "{name}: {:?}", own.verdict);
        // This range avoids special angles.
        let range = Range { from: -PI + 0.01, to: PI + 0.01, steps: 24 };
        let swept = sweep(&entry, joint, Variable::Rotation, range, || true, || {}).unwrap();
        let (mut compared, mut seen) = (0, vec![false; own.cells.len()]);
        for sample in swept.samples.iter().filter(|sample| sample.is_complete()) {
            let Some(modes) = own.modes_at(sample.input) else { continue };
            assert_eq!(sample.modes.len(), modes, "{name} at {}", sample.input);
            compared += 1;
            seen.iter_mut().zip(&own.cells).for_each(|(seen, cell)| *seen |= cell.modes == modes);
        }
        assert!(compared >= 20, "{name}: {compared}");
        assert!(seen.iter().filter(|seen| **seen).count() * 2 >= own.cells.len(), "{name}: {seen:?}");
        // A sweep that is proved has its limit positions at the zeros where the number changes.
        if swept.verdict.code == Code::BranchesProved {
            let limits = own.zeros.iter().filter(|zero| zero.label == Label::Limit).count();
            assert_eq!(swept.limits.is_empty(), limits == 0, "{name}");
        }
    }
}

#[test]
fn link_parameters_cut_cells_that_derivations_confirm() {
    for (name, parameter) in
        [("crcrr_2_angle", "a3"), ("cccr_1_angle", "alpha2"), ("crcrr_4_angle", "d2"), ("rssr", "a1")]
    {
        let entry = entry(name);
        let own = found(&entry, parameter);
        holds(&own);
        // The value of the file lies in the cell whose number of modes is the number of real roots of the derivation.
        let derivation = derive(&entry, &entry.cases[0]).unwrap();
        let polynomial = derivation.polynomial.unwrap();
        if let Some(modes) = own.modes_at(own.given.unwrap()) {
            assert_eq!(modes, polynomial.roots.len() + polynomial.at_pi, "{name} {parameter}");
        }
    }
}

#[test]
fn a_parallelogram_passes_through_nodes() {
    let entry = entry("planar_4r");
    let own = found(&entry, "theta1");
    for zero in &own.zeros {
        let [before, behind] = zero.modes;
        assert_eq!(zero.label == Label::Limit, before != behind, "{zero:?}");
        if let (Label::Node | Label::Isolated, Some(at)) = (zero.label, zero.at) {
            assert_ne!(at, before, "{zero:?}");
        }
    }
}

#[test]
fn a_map_has_the_cells_of_each_column() {
    let entry = entry("rssr");
    let wanted = MapWanted { parameters: ["a1", "theta1"], range: Some([5.0, 7.0]), columns: 3 };
    let map = cell_map(&EntryCase::new(&entry, &entry.cases[0]), wanted, || true, || {}).unwrap();
    assert_eq!(map.columns.len(), 3);
    for column in &map.columns {
        let cells = column.cells.as_ref().unwrap();
        holds(cells);
        assert!(column.value > 5.0 && column.value < 7.0);
    }
    // A map that stops at once has no columns, which is no error.
    let stopped = cell_map(&EntryCase::new(&entry, &entry.cases[0]), wanted, || false, || {}).unwrap();
    assert!(stopped.columns.is_empty());
    let empty = MapWanted { range: Some([5.0, 5.0]), ..wanted };
    assert!(cell_map(&EntryCase::new(&entry, &entry.cases[0]), empty, || true, || {}).is_err());
}

fn linkage(name: &str) -> LinkageFile {
    match load_any(name, &Options::default()).unwrap() {
        Any::Linkage(file) => *file,
        _ => panic!("{name} is no linkage"),
    }
}

fn case(file: &LinkageFile) -> LinkageCase {
    LinkageCase::new(&file.linkage, file.exact, &file.cases[0].given, file.cases[0].accuracy)
}

/// The modes at simple numbers everywhere on the axis of a parameter are those of their cells.
fn agrees(subject: &impl Subject, own: &Cells) {
    let parameter = subject.parameter(&own.parameter).unwrap();
    let mut compared = 0;
    for numerator in -14..=14 {
        let value = Rational::from((numerator, 3));
        let natural = match own.kind {
            Variable::Rotation => 2.0 * value.to_f64().atan(),
            Variable::Translation => value.to_f64(),
        };
        let Some(modes) = own.modes_at(natural) else { continue };
        if let Some(solved) = subject.with(&parameter, &value).real_modes() {
            assert_eq!(solved, modes, "{} = {value}", own.parameter);
            compared += 1;
        }
    }
    assert!(compared >= 20, "{}: {compared}", own.parameter);
}

#[test]
fn inputs_of_linkages_cut_cells_that_the_solver_confirms() {
    for (name, parameter) in [
        ("linkage/level_four_bar", "A"),
        ("linkage/crank_slider", ""),
        ("linkage/inverted_slider_crank", ""),
        ("linkage/stephenson_3", ""),
        ("linkage/watt_1", ""),
    ] {
        let file = linkage(name);
        let subject = case(&file);
        let first = file.linkage.joints.iter().find(|joint| subject.parameter(&joint.name).is_ok()).unwrap();
        let own = cells(&subject, if parameter.is_empty() { &first.name } else { parameter }, &Watch::none()).unwrap();
        // Of a slide in a body that turns the relation is interpolated.
        let is_probable = name == "linkage/inverted_slider_crank";
        assert_eq!(matches!(own.verdict.proof, Proof::Probable { .. }), is_probable, "{name}: {:?}", own.verdict);
        assert_eq!(own.verdict.proof.is_proved(), !is_probable, "{name}: {:?}", own.verdict);
        holds(&own);
        agrees(&subject, &own);
    }
}

#[test]
fn one_leg_of_three_cuts_cells() {
    let file = linkage("linkage/3rpr");
    let subject = case(&file);
    let own = cells(&subject, "L2", &Watch::none()).unwrap();
    assert!(!own.verdict.proof.is_proved() && own.polynomial.degree(1) == 6, "{:?}", own.verdict);
    holds(&own);
    agrees(&subject, &own);
}

#[test]
fn coordinates_of_points_cut_cells_as_well() {
    let file = linkage("linkage/level_four_bar");
    let subject = case(&file);
    let own = cells(&subject, "crank.B.x", &Watch::none()).unwrap();
    assert!(matches!(own.verdict.proof, Proof::Probable { .. }), "{:?}", own.verdict);
    holds(&own);
    agrees(&subject, &own);
    let limits: Vec<f64> = own.zeros.iter().map(|zero| zero.value).collect();
    // The coupler and the rocker, 3 and 1, reach the joint of the crank where it is 4 away from D; or 2, which it never is.
    assert!((limits[0] + 1.4).abs() < 1e-9 && (limits[1] - 5.0).abs() < 1e-9, "{limits:?}");
    assert!(cells(&subject, "crank.B.q", &Watch::none()).is_err());
}

fn on_sphere(name: &str) -> SphereCase {
    match load_any(name, &Options::default()).unwrap() {
        Any::Sphere(file) => SphereCase::new(&file.linkage, &file.cases[0].given, [file.exact, file.cases[0].exact]),
        _ => panic!("{name} is no linkage on the sphere"),
    }
}

#[test]
fn a_four_bar_on_the_sphere_has_proved_cells() {
    let subject = on_sphere("linkage/spherical_four_bar");
    let parameter = subject.parameter("A").unwrap();
    assert_eq!(parameter.value, Some(Rational::from(2)));
    let own = cells(&subject, "A", &Watch::none()).unwrap();
    assert!(own.verdict.proof.is_proved(), "{:?}", own.verdict);
    assert_eq!(own.polynomial.degree(1), 2);
    holds(&own);
    agrees(&subject, &own);
    assert!(cells(&subject, "B", &Watch::none()).is_err());
}

#[test]
fn six_bars_on_the_sphere_have_cells_that_the_solver_confirms() {
    let subject = on_sphere("linkage/spherical_watt");
    let own = cells(&subject, "A", &Watch::none()).unwrap();
    assert!(matches!(own.verdict.proof, Proof::Probable { .. }), "{:?}", own.verdict);
    assert_eq!(own.polynomial.degree(1), 4);
    holds(&own);
    agrees(&subject, &own);
}

#[test]
fn linkages_in_space_have_cells_that_the_solver_confirms() {
    let Any::Space(file) = load_any("linkage/rssr_ssr", &Options::default()).unwrap() else {
        panic!("a linkage in space")
    };
    let subject = SpaceCase::new(&file, 0);
    let given = file.cases[0].given[0].joint.unwrap();
    let own = cells(&subject, &file.linkage.joints[given].name, &Watch::none()).unwrap();
    assert!(matches!(own.verdict.proof, Proof::Probable { .. }), "{:?}", own.verdict);
    assert_eq!(own.polynomial.degree(1), 4);
    holds(&own);
    agrees(&subject, &own);
}

#[test]
fn six_bars_whose_values_are_close_have_cells() {
    let file = linkage("linkage/stephenson_3_triad");
    let own = cells(&case(&file), "H", &Watch::none()).unwrap();
    assert!(own.verdict.proof.is_proved(), "{:?}", own.verdict);
    holds(&own);
}
