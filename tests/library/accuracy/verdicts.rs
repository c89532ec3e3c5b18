//! Lists crippled on purpose: none of them may be called complete.

use crate::arms::{general, open, pose, puma_like, random, rounded, singular, small, three_parallel};
use looproot::internal::assembly::{Assembly, Roots, Solver, Workspace};
use looproot::internal::elimination::degree::{degree, general_closing};
use looproot::internal::kinematics::chain::Chain;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::verdict::{Bound, Code, Proof, Status, verdict};
use looproot_algebra::modp::{ModP, PRIME_61};
use rug::Rational;

type Mod = ModP<PRIME_61>;

/// A list as the solver makes it, with the bounds that are true of it.
struct List {
    name: String,
    assembly: Assembly,
    everywhere: usize,
    here: usize,
}

fn list(name: &str, chain: &Chain, values: &[Rational; 6]) -> List {
    let closing: Motion<Rational> = pose::<Rational>(chain, values).inverse();
    let mut assembly = Assembly::default();
    Solver::prepare(&open(chain)).solve(&rounded(&closing), Roots::All, &mut Workspace::default(), &mut assembly);
    let at = |closing: &Motion<Mod>| open::<Mod>(chain).close(closing);
    let general = |choice| at(&general_closing(None, choice).unwrap());
    let everywhere = degree(&general(0), Some(&general(1)), 0).unwrap().solutions;
    let here = degree(&at(&pose::<Mod>(chain, values).inverse()), None, 0).unwrap().solutions;
    List { name: name.to_owned(), assembly, everywhere, here }
}

fn lists() -> Vec<List> {
    let mut random = random(70);
    let mut values = || -> [Rational; 6] { std::array::from_fn(|_| small(&mut random)) };
    let mut lists =
        vec![list("Puma-like", &puma_like(), &values()), list("three parallel", &three_parallel(), &values())];
    for seed in 80..83 {
        lists.push(list("general", &general(&mut crate::arms::random(seed)), &values()));
    }
    let (arm, planted) = singular(&mut crate::arms::random(3));
    lists.push(list("singular pose", &arm, &planted));
    lists
}

fn judge(list: &List, assembly: &Assembly, roots: Roots, rank: usize) -> Status {
    let (proof, code) = (Proof::Proved, Code::GeometryBoundMet);
    let bound = |count| Bound { count, proof, code, because: "a test".to_owned() };
    verdict(assembly, roots, rank, 16, || bound(list.everywhere), || Some(bound(list.here)), None).status
}

fn is_claimed(status: Status) -> bool {
    matches!(status, Status::Complete | Status::Unreachable)
}

/// Every change by `cripple` of a mode spoils the verdict.
fn spoils(what: &str, cripple: impl Fn(&mut Assembly, usize)) {
    for list in lists() {
        for roots in [Roots::All, Roots::Real] {
            assert!(is_claimed(judge(&list, &list.assembly, roots, 6)), "{}: not complete to begin with", list.name);
            for k in 0..list.assembly.modes.len() {
                let mut crippled = list.assembly.clone();
                cripple(&mut crippled, k);
                let status = judge(&list, &crippled, roots, 6);
                assert!(!is_claimed(status), "{}, {roots:?}: {status:?} although mode {k} {what}", list.name);
            }
        }
    }
}

#[test]
fn a_missing_root_is_missed() {
    spoils("is missing", |assembly, k| {
        assembly.modes.remove(k);
    });
}

#[test]
fn a_root_without_certificate_is_not_counted() {
    spoils("has no certificate", |assembly, k| {
        let mode = &mut assembly.modes[k];
        mode.certificate = None;
        // A double solution has none; its multiplicity stands for it.
        mode.multiplicity = usize::from(mode.multiplicity <= 1);
    });
}

#[test]
fn a_root_of_unknown_multiplicity_is_not_counted() {
    spoils("has no multiplicity", |assembly, k| assembly.modes[k].multiplicity = 0);
}

#[test]
fn a_root_counted_twice_does_not_make_up_for_another() {
    spoils("is replaced by its neighbour", |assembly, k| {
        let other = (k + 1) % assembly.modes.len();
        let (multiplicity, twin) = (assembly.modes[k].multiplicity, assembly.modes[other].clone());
        assembly.modes[k] = twin;
        assembly.modes[k].multiplicity = multiplicity;
    });
}

#[test]
fn one_root_too_many_is_a_contradiction() {
    spoils("is there twice", |assembly, k| {
        let mut another = assembly.modes[k].clone();
        // Far enough from all others to be distinct.
        another.unknowns[0] += 0.123;
        assembly.modes.push(another);
    });
}

#[test]
fn a_self_motion_or_a_deficient_arm_is_never_complete() {
    for list in lists() {
        let mut moving = list.assembly.clone();
        moving.self_motion = 1;
        assert_eq!(judge(&list, &moving, Roots::All, 6), Status::SelfMotion, "{}", list.name);
        assert_eq!(judge(&list, &list.assembly, Roots::All, 5), Status::Incomplete, "{}", list.name);
        assert_eq!(judge(&list, &Assembly::default(), Roots::All, 6), Status::Incomplete, "{}", list.name);
    }
}

#[test]
fn a_root_that_may_be_real_is_not_called_complex() {
    for list in lists() {
        for k in (0..list.assembly.modes.len()).filter(|&k| !list.assembly.modes[k].real) {
            let mut doubtful = list.assembly.clone();
            let mode = &mut doubtful.modes[k];
            let Some(claim) = mode.certificate.as_mut() else { continue };
            claim.proved = 1.0 + mode.unknowns.iter().map(|x| x.im.abs()).fold(0.0, f64::max);
            assert!(!is_claimed(judge(&list, &doubtful, Roots::All, 6)), "{}, mode {k}", list.name);
        }
    }
}
