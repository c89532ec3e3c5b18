//! Solutions that f64 does not reach are found from the exact data, and those that it does reach come out the same.

use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::assembly::{Assembly, MOST_TRIES, Mode, Roots, Solver, Workspace, distance};
use looproot::internal::benchmark::platform::sample::{PlatformSet, sample as platform};
use looproot::internal::benchmark::sample::{CHAINS, Sample, Set, sample};
use looproot::internal::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot_algebra::long_float::LongFloat;
use looproot_algebra::number::Number;
use looproot_algebra::ring::Ring;
use rug::Rational;

fn chain(name: &str) -> Set {
    Set::Chain(CHAINS.iter().position(|(known, _)| *known == name).unwrap())
}

fn solve(drawn: &Sample) -> (Solution, Assembly) {
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mechanism = Mechanism::prepare(&drawn.entry).unwrap();
    let solution = mechanism.solve(&drawn.entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
    (solution, assembly)
}

/// The loop at its pose over a ring.
fn closed<R: Ring>(drawn: &Sample, layout: &Layout) -> (OpenLoop<R>, Motion<R>, ClosedLoop<R>) {
    let open: OpenLoop<R> = drawn.chain.open_loop(layout).unwrap();
    let pose = drawn.entry.cases[0].pose.as_ref().unwrap();
    let closing = pose.exact.inverse().map(R::from_rational).unwrap();
    let closed = open.close(&closing);
    (open, closing, closed)
}

#[test]
fn solutions_almost_at_infinity_are_found_and_proved() {
    // For every elimination, some cases whose solutions f64 loses or cannot prove: right angles, wrists and parallel axes that
    // are slightly off.
    let cases = [
        (chain("CCC"), 684, 2),
        (chain("CCPR"), 240, 2),
        (chain("CCRR"), 691, 8),
        (chain("CRPRR"), 851, 8),
        (chain("PPRRRR"), 980, 8),
        (chain("CRRRR"), 684, 16),
        (chain("PRRRRR"), 445, 16),
        (chain("SCR"), 60, 4),
        (chain("SRC"), 60, 4),
        (Set::Calibrated, 0, 16),
        (Set::Calibrated, 3, 16),
    ];
    for (set, index, count) in cases {
        let drawn = sample(set, 1, index).unwrap();
        let (solution, assembly) = solve(&drawn);
        let verdict = &solution.verdict;
        assert!(["complete", "unreachable"].contains(&verdict.status.word()), "{set:?} {index}: {}", verdict.reason);
        assert_eq!((verdict.complex, verdict.certified), (count, count), "{set:?} {index}: {}", verdict.reason);
        assert!(assembly.by_high_precision > 0, "{set:?} {index}: f64 was enough");
        assert!(verdict.reason.contains("384-bit"), "{}", verdict.reason);
        // The conjugate of every solution is one.
        for mode in assembly.modes.iter().filter(|mode| !mode.real) {
            let conjugate = mode.unknowns.map(|z| z.conj());
            let longest = mode.unknowns.iter().map(|z| z.norm()).fold(1.0, f64::max);
            let apart = |other: &Mode| distance(&drawn.variables, &other.unknowns, &conjugate) / longest;
            assert!(assembly.modes.iter().any(|other| apart(other) < 1e-6), "{set:?} {index}");
        }
    }
}

#[test]
fn long_translations_are_no_self_motion() {
    // Nearly dependent translations of exactly two solutions: f64 takes them for a curve.
    let drawn = sample(chain("CCPR"), 1, 381).unwrap();
    let (solution, _) = solve(&drawn);
    assert_eq!(solution.verdict.self_motion, 0, "{}", solution.verdict.reason);
    assert_eq!(solution.verdict.complex, 2, "{}", solution.verdict.reason);
}

#[test]
fn both_precisions_find_the_same_solutions() {
    // Three translations behind a spherical joint are three linear equations: nothing of them is ever far away.
    for (k, (name, count)) in CHAINS.iter().enumerate().filter(|(_, (name, _))| *name != "SPPP") {
        let drawn = sample(Set::Chain(k), 7, 3).unwrap();
        let layout = Layout::of(&drawn.chain, None).unwrap();
        let (open, closing, _) = closed::<f64>(&drawn, &layout);
        let solver = match layout.spherical_unknown() {
            Some(spherical) => Solver::with_spherical_joint(&open, spherical),
            None => Solver::prepare(&open),
        };
        let (mut fast, mut exact) = (Assembly::default(), Assembly::default());
        solver.solve(&closing, Roots::All, &mut Workspace::default(), &mut fast);
        solver.solve_in_high_precision(&closed::<LongFloat>(&drawn, &layout).2, None, *count, MOST_TRIES, &mut exact);
        assert_eq!((fast.total(), exact.total(), exact.by_high_precision), (*count, *count, *count), "{name}");
        assert_eq!(fast.real(), exact.real(), "{name}");
        for mode in &fast.modes {
            let near = exact.modes.iter().filter(|other| other.real == mode.real).map(|other| {
                let longest = mode.unknowns.iter().map(|z| z.norm()).fold(1.0, f64::max);
                distance(&drawn.variables, &other.unknowns, &mode.unknowns) / longest
            });
            let near = near.fold(f64::INFINITY, f64::min);
            assert!(near < 1e-8, "{name}: {near:e}");
        }
        // Solutions that are there already are not counted as new.
        solver.solve_in_high_precision(&closed::<LongFloat>(&drawn, &layout).2, None, *count, MOST_TRIES, &mut fast);
        assert_eq!((fast.total(), fast.by_high_precision), (*count, 0), "{name}");
    }
}

#[test]
fn both_precisions_find_the_same_complex_poses() {
    let sets = [(PlatformSet::General, 40), (PlatformSet::PlanarBoth, 40), (PlatformSet::Shared(&[], &[(0, 1)]), 40)];
    for (set, count) in sets {
        let drawn = platform(set, 7, 1).unwrap();
        let squares = drawn.entry.cases[0].legs_squared.as_ref().unwrap();
        let solver = PlatformSolver::prepare(&drawn.platform);
        let (mut workspace, mut fast, mut exact) =
            (PlatformWorkspace::default(), PlatformAssembly::default(), PlatformAssembly::default());
        let rationals = squares.each_ref().map(|square| square.rational().clone());
        let geometry = drawn.platform.map(|x| Rational::from_f64(*x)).unwrap();
        solver.solve_in_high_precision::<6>(&geometry, &rationals, count, &mut workspace, &mut exact);
        solver.solve(&squares.each_ref().map(Number::to_f64), Roots::All, &mut workspace, &mut fast);
        assert_eq!((fast.total(), exact.total()), (count, count), "{set:?}");
        assert!(exact.modes.iter().all(|mode| mode.certificate.is_some()), "{set:?}");
    }
}

#[test]
fn poses_almost_at_infinity_are_found_and_proved() {
    let samples =
        [(PlatformSet::Hexapod, 1, 22, 28), (PlatformSet::Hexapod, 1, 32, 28), (PlatformSet::Hexapod, 1, 111, 28)];
    for (set, seed, index, count) in samples.into_iter().chain([(PlatformSet::Affine, 3, 401, 32)]) {
        let drawn = platform(set, seed, index).unwrap();
        let mechanism = Mechanism::prepare(&drawn.entry).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let solution = mechanism.solve(&drawn.entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
        let verdict = &solution.verdict;
        assert_eq!((verdict.complex, verdict.certified), (count, count), "{index}: {}", verdict.reason);
    }
}
