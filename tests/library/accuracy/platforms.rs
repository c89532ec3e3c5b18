//! Random platforms of every class: planted poses are found, their number equals an exact count, and crippled lists are noticed.

use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::benchmark::accuracy::Counts;
use looproot::internal::benchmark::platform::accuracy::{PlatformJob, run};
use looproot::internal::benchmark::platform::sample::{PlatformSet, sample};
use looproot::internal::elimination::platform_degree::{PlatformDegree, platform_degree};
use looproot::internal::verdict::{Bound, Code, PlatformKnowledge, Proof, Status, platform_verdict};
use looproot_algebra::number::Number;
use rug::Rational;

fn counts(set: PlatformSet, count: u64, roots: Roots) -> Counts {
    let counts = run(PlatformJob { set, count, seed: 2024, roots }, || true, || ()).unwrap();
    assert!(counts.is_faultless(), "{set:?}, {roots:?}:\n{counts}");
    let residual = counts.residuals.iter().copied().fold(0.0, f64::max);
    assert!(residual <= 1e-14, "{set:?}, {roots:?}: {residual:e}\n{counts}");
    counts
}

#[test]
fn general_platforms_are_all_complete() {
    let counts = self::counts(PlatformSet::General, 100, Roots::All);
    assert_eq!(counts.complex.get(&40), Some(&100), "\n{counts}");
    assert_eq!(counts.modes, (4000, 4000), "\n{counts}");
    assert_eq!(counts.verdicts.get("complete"), Some(&100), "\n{counts}");
    self::counts(PlatformSet::General, 100, Roots::Real);
}

#[test]
fn plane_platforms_are_all_complete() {
    for set in [PlatformSet::PlanarBase, PlatformSet::PlanarPlate, PlatformSet::PlanarBoth] {
        let counts = counts(set, 30, Roots::All);
        assert_eq!(counts.complex.get(&40), Some(&30), "{set:?}\n{counts}");
    }
}

#[test]
fn special_platforms_have_as_many_poses_as_an_exact_count_finds() {
    // The numbers found by Gröbner bases for each class.
    let expected = [40, 32, 16, 16, 8, 40, 24, 24, 16, 16, 16, 24, 16, 16];
    let shared = PlatformSet::NAMED.into_iter().filter(|(_, set)| matches!(set, PlatformSet::Shared(..)));
    for ((name, set), expected) in shared.zip(expected) {
        let counts = counts(set, 5, Roots::All);
        assert_eq!((counts.counted, counts.complex.get(&expected)), (5, Some(&5)), "{name}\n{counts}");
    }
    let related = [
        (PlatformSet::Affine, 32),
        (PlatformSet::Similar, 24),
        (PlatformSet::Congruent, 24),
        (PlatformSet::SimilarPlanar, 16),
    ];
    for (set, expected) in related {
        let counts = counts(set, 5, Roots::All);
        assert_eq!(counts.complex.get(&expected), Some(&5), "{set:?}\n{counts}");
    }
}

#[test]
fn a_pose_where_a_chart_ends_is_no_curve_of_poses() {
    // The planted pose of this sample lies at infinity of one of the charts in which poses are counted.
    let drawn = sample(PlatformSet::Similar, 1, 225).unwrap();
    let squares = drawn.entry.cases[0].legs_squared.as_ref().unwrap().each_ref().map(|s| s.rational().clone());
    let exact = drawn.platform.map(|x| Rational::from_f64(*x)).unwrap();
    let degree = platform_degree(&exact, &squares).unwrap();
    assert!(matches!(degree, PlatformDegree::Finite { poses: 24, .. }), "{degree:?}");
}

/// A platform with all its poses.
fn list(set: PlatformSet, index: u64) -> PlatformAssembly {
    let drawn = sample(set, 5, index).unwrap();
    let solver = PlatformSolver::prepare(&drawn.platform);
    let squares = drawn.entry.cases[0].legs_squared.as_ref().unwrap().each_ref().map(Number::to_f64);
    let mut assembly = PlatformAssembly::default();
    solver.solve(&squares, Roots::All, &mut PlatformWorkspace::default(), &mut assembly);
    assembly
}

fn judge(assembly: &PlatformAssembly, poses: usize) -> Status {
    let because = format!("{poses} that there are");
    let count = Bound { count: poses, proof: Proof::Proved, code: Code::ExactRootsMatched, because };
    let knowledge = PlatformKnowledge { count: (poses < 40).then_some(count), ..PlatformKnowledge::default() };
    platform_verdict(assembly, Roots::All, &knowledge).status
}

fn is_claimed(status: Status) -> bool {
    matches!(status, Status::Complete | Status::Unreachable)
}

#[test]
fn no_crippled_list_is_called_complete() {
    let sets = [(PlatformSet::General, 40), (PlatformSet::PlanarBoth, 40), (PlatformSet::Hexapod, 28)];
    for (set, poses) in sets {
        let whole = list(set, 1);
        assert!(is_claimed(judge(&whole, poses)), "{set:?}: not complete to begin with");
        for k in 0..whole.modes.len() {
            let refused = |what: &str, cripple: &dyn Fn(&mut PlatformAssembly)| {
                let mut crippled = whole.clone();
                cripple(&mut crippled);
                let status = judge(&crippled, poses);
                assert!(!is_claimed(status), "{set:?}: {status:?} although mode {k} {what}");
            };
            refused("is missing", &|list| {
                list.modes.remove(k);
            });
            refused("has no certificate", &|list| list.modes[k].certificate = None);
            refused("has no multiplicity", &|list| list.modes[k].multiplicity = 0);
            refused("counts twice", &|list| list.modes[k].multiplicity = 2);
            refused("is replaced by its neighbour", &|list| {
                list.modes[k] = list.modes[(k + 1) % list.modes.len()].clone();
            });
            refused("is there twice", &|list| list.modes.push(list.modes[k].clone()));
            refused("moves", &|list| list.self_motion = 1);
            if !whole.modes[k].real {
                refused("may be real", &|list| {
                    let claim = list.modes[k].certificate.as_mut().unwrap();
                    claim.radius = 10.0;
                });
            }
        }
    }
}

#[test]
fn a_curve_of_poses_is_a_self_motion() {
    let whole = list(PlatformSet::General, 2);
    // A count alone proves no self-motion: it is a measurement.
    let counted = PlatformKnowledge { infinite: Some(2), ..PlatformKnowledge::default() };
    let list = PlatformAssembly { modes: whole.modes[..30].to_vec(), ..whole.clone() };
    assert_eq!(platform_verdict(&list, Roots::All, &counted).status, Status::Incomplete);
    let moving = PlatformAssembly { self_motion: 3, ..whole };
    let verdict = platform_verdict(&moving, Roots::All, &counted);
    assert_eq!((verdict.status, verdict.self_motion), (Status::SelfMotion, 2));
}
