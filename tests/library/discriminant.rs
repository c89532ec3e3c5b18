//! Cells of a parameter: the number of real modes of every cell is that of the sweep, of the solver, and of derivations.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Options, load};
use looproot::internal::derivation::derive;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::sweep::{Cells, Label, MapWanted, Range, cell_map, cells, sweep};
use looproot::internal::verdict::{Code, Proof};
use std::f64::consts::PI;

fn entry(name: &str) -> Entry {
    load(name, &Options::default()).unwrap()
}

fn found(entry: &Entry, parameter: &str) -> Cells {
    cells(entry, &entry.cases[0], parameter).unwrap()
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
    let map = cell_map(&entry, &entry.cases[0], wanted, || true, || {}).unwrap();
    assert_eq!(map.columns.len(), 3);
    for column in &map.columns {
        let cells = column.cells.as_ref().unwrap();
        holds(cells);
        assert!(column.value > 5.0 && column.value < 7.0);
    }
    // A map that stops at once has no columns, which is no error.
    let stopped = cell_map(&entry, &entry.cases[0], wanted, || false, || {}).unwrap();
    assert!(stopped.columns.is_empty());
    let empty = MapWanted { range: Some([5.0, 5.0]), ..wanted };
    assert!(cell_map(&entry, &entry.cases[0], empty, || true, || {}).is_err());
}
