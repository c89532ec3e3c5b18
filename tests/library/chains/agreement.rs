//! Closure polynomials beside the solutions in floating point: the same numbers for loops of every chain, and a comparison that
//! notices what is missing or too much.

use crate::arms;
use looproot::internal::assembly::Roots;
use looproot::internal::benchmark::accuracy::{Job, run};
use looproot::internal::benchmark::agreement::{Agreement, compare};
use looproot::internal::benchmark::sample::{CHAINS, Sample, Set, rational_sample};
use looproot::internal::catalogue::entry::Design;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::derivation::{Derivation, derive};
use looproot::internal::mechanism::Solution;

fn chain(name: &str) -> usize {
    CHAINS.iter().position(|(known, _)| *known == name).unwrap()
}

fn both(drawn: &Sample) -> (Derivation, Solution) {
    (derive(&drawn.entry, &drawn.entry.cases[0]).unwrap(), arms::solve(&drawn.entry))
}

#[test]
fn every_chain_has_as_many_solutions_as_its_polynomial_has_roots() {
    for (index, (name, _)) in CHAINS.into_iter().enumerate() {
        for set in [Set::Chain(index), Set::SpecialChain(index)] {
            let job = Job { set, count: 4, seed: 7, roots: Roots::All, exact: true };
            let counts = run(job, || true, || ()).unwrap();
            assert!(counts.is_faultless(), "{name}:\n{counts}");
            let exact = counts.exact.unwrap();
            assert_eq!(exact.solutions + exact.values, 4, "{name}: {exact:?}");
        }
    }
}

#[test]
fn a_solution_lost_or_a_root_too_many_is_noticed() {
    let drawn = rational_sample(Set::Chain(chain("CCRR")), 3, 0).unwrap();
    let (derivation, solution) = both(&drawn);
    let compared = |solution: &Solution| compare(&derivation, &drawn.chain, solution);
    assert_eq!(compared(&solution), Agreement::Solutions);
    let mut lost = solution.clone();
    lost.verdict.complex -= 1;
    assert_eq!(compared(&lost), Agreement::Differs("degree 8, 7 solutions".to_owned()));
    let mut unreal = solution.clone();
    unreal.verdict.real -= 2;
    assert!(matches!(compared(&unreal), Agreement::Differs(_)));
    let none = Derivation { polynomial: None, ..derivation.clone() };
    assert!(matches!(compare(&none, &drawn.chain, &solution), Agreement::Differs(_)));
}

#[test]
fn with_shared_roots_distinct_values_are_compared() {
    // Two of its roots belong to four solutions each.
    let drawn = rational_sample(Set::SpecialChain(chain("CRRRR")), 1, 126).unwrap();
    let (derivation, mut solution) = both(&drawn);
    assert_eq!(compare(&derivation, &drawn.chain, &solution), Agreement::Values);
    let polynomial = derivation.polynomial.as_ref().unwrap();
    assert_eq!((polynomial.degree(), polynomial.factors.as_slice()), (16, [(8, 1), (2, 4)].as_slice()));
    let (unknown, _) = derivation.unknown(&drawn.chain).unwrap();
    let simple = polynomial.roots.iter().find(|root| root.multiplicity == 1).unwrap();
    let mode = solution.modes.iter().position(|mode| (0.5 * mode.q[unknown]).tan().re == simple.value);
    let mode = mode.or_else(|| {
        let off = |k: &usize| ((0.5 * solution.modes[*k].q[unknown]).tan() - simple.value).norm();
        (0..solution.modes.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    });
    solution.modes.remove(mode.unwrap());
    assert!(matches!(compare(&derivation, &drawn.chain, &solution), Agreement::Differs(_)));
}

/// A loop of joints, each `type a tan(alpha/2) d`, and its input.
fn from_text(joints: &[[&str; 4]], input: &str) -> Sample {
    let drawn = rational_sample(Set::Chain(0), 1, 0).unwrap();
    let row = |[kind, a, twist, d]: &[&str; 4]| {
        let offset = if *kind == "C" { "d0" } else { "d" };
        format!("{{ type = \"{kind}\", a = \"{a}\", tan_half_alpha = \"{twist}\", {offset} = \"{d}\" }},\n")
    };
    let joints: String = joints.iter().map(row).collect();
    let head = "title = \"any\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n";
    let text = format!("{head}{joints}]\n[[input]]\n{input}\n");
    let entry = load_text(&text, "any.toml", Format::Toml, &Options::default()).unwrap();
    let Design::Loop(chain) = entry.design.clone() else { unreachable!() };
    Sample { entry, chain, ..drawn }
}

#[test]
fn roots_that_belong_to_no_solution_are_divided_out_with_proof() {
    let rows = [
        ["R", "0", "1/2", "0"],
        ["R", "7/5", "1/2", "1"],
        ["R", "2", "inf", "7/5"],
        ["R", "1", "-1", "-3/2"],
        ["R", "2", "inf", "-3/2"],
        ["C", "0", "1/2", "0"],
    ];
    let drawn = from_text(&rows, "joint = 3\ntan_half = \"inf\"");
    let (derivation, solution) = both(&drawn);
    let polynomial = derivation.polynomial.as_ref().unwrap();
    assert_eq!((polynomial.degree(), polynomial.at_pi), (8, 0));
    let removed: Vec<_> = polynomial.removed.iter().map(|one| (one.multiplicity, one.factor.clone())).collect();
    let degree = |k: usize| removed[k].1.as_ref().unwrap().total_degree().unwrap() * removed[k].0 as u64;
    assert_eq!(degree(0) + degree(1), 8);
    assert!(derivation.proved);
    assert_eq!(compare(&derivation, &drawn.chain, &solution), Agreement::Values);
}

#[test]
fn a_ball_in_a_deficient_loop_has_no_false_positions() {
    // Every position of the centre at which its height and distance fit lies on the axis of a joint that would have to turn it.
    let rows = [["R", "0", "5/7", "2"], ["C", "0", "-1", "0"], ["S", "-3/2", "1", "1"], ["R", "-3/2", "1", "0"]];
    let drawn = from_text(&rows, "joint = 4\ntan_half = \"1/2\"");
    let derivation = derive(&drawn.entry, &drawn.entry.cases[0]).unwrap();
    let polynomial = derivation.polynomial.as_ref().unwrap();
    assert_eq!((polynomial.degree(), polynomial.at_pi), (0, 0));
}

#[test]
fn where_every_elimination_vanishes_the_ring_has_the_polynomial() {
    let drawn = rational_sample(Set::SpecialChain(chain("PRRRRR")), 1, 33).unwrap();
    let (derivation, solution) = both(&drawn);
    assert_eq!(compare(&derivation, &drawn.chain, &solution), Agreement::Solutions);
    assert_eq!(derivation.polynomial.as_ref().unwrap().degree(), 8);
    assert!(!derivation.proved);
    let found = derivation.substituted(&drawn.entry, &drawn.entry.cases[0]).unwrap();
    assert_eq!(found.solutions, 8);
}

#[test]
fn a_translation_along_parallel_axes_is_read_elsewhere() {
    let drawn = rational_sample(Set::SpecialChain(chain("CRRRR")), 1, 6).unwrap();
    let (derivation, solution) = both(&drawn);
    assert_eq!(compare(&derivation, &drawn.chain, &solution), Agreement::Solutions);
    let polynomial = derivation.polynomial.as_ref().unwrap();
    assert_eq!(polynomial.degree() + polynomial.at_pi, 12);
    assert_eq!(derivation.substituted(&drawn.entry, &drawn.entry.cases[0]).unwrap().solutions, 12);
}
