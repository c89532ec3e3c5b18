//! Invariants of platforms: frames, the order of the legs and the roles of base and plate change no count, and carry the poses
//! along.

use crate::arms::{motion, random, small};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::benchmark::platform::sample::{PlatformSet, sample};
use looproot::internal::catalogue::entry::{Case, Design};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::mechanism::{FullMode, Mechanism, Solution};
use looproot_algebra::number::Number;
use rug::Rational;

type Exact = Platform<Rational>;

fn exact(set: PlatformSet, index: u64) -> (Exact, [Rational; 6]) {
    let drawn = sample(set, 77, index).unwrap();
    let squares = drawn.entry.cases[0].legs_squared.as_ref().unwrap().each_ref().map(|s| s.rational().clone());
    (drawn.platform.map(|x| Rational::from_f64(*x)).unwrap(), squares)
}

fn solve(platform: &Exact, squares: &[Rational; 6]) -> Solution {
    let numbers =
        |points: &[[Rational; 3]; 6]| points.each_ref().map(|p| p.each_ref().map(|x| Number::exact(x.clone())));
    let numbers = Platform { base: numbers(&platform.base), plate: numbers(&platform.plate) };
    let case = Case::legs(squares.each_ref().map(|s| Number::exact(s.clone())), 0);
    let entry = crate::arms::entry(Design::Platform(Box::new(numbers)), vec![case]);
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

fn pose(mode: &FullMode) -> Motion<f64> {
    let q: [f64; 7] = std::array::from_fn(|k| mode.q[k].re);
    let quaternion = Quaternion { scalar: q[0], vector: [q[1], q[2], q[3]] };
    let norm = quaternion.norm();
    Motion { rotation: quaternion.scaled_rotation().map(|row| row.map(|x| x / norm)), translation: [q[4], q[5], q[6]] }
}

fn apart(one: &Motion<f64>, two: &Motion<f64>) -> f64 {
    let rotation = (0..9).map(|k| (one.rotation[k / 3][k % 3] - two.rotation[k / 3][k % 3]).abs());
    rotation.chain((0..3).map(|k| (one.translation[k] - two.translation[k]).abs())).fold(0.0, f64::max)
}

/// Asserts the same verdict, and that the real poses of one are carried to those of the other.
fn same(what: &str, wanted: &Solution, found: &Solution, carry: impl Fn(&Motion<f64>) -> Motion<f64>) {
    let verdict = |s: &Solution| (s.verdict.status, s.verdict.complex, s.verdict.real, s.verdict.certified);
    assert_eq!(verdict(wanted), verdict(found), "{what}: {} / {}", wanted.verdict.reason, found.verdict.reason);
    for mode in wanted.modes.iter().filter(|mode| mode.real) {
        let carried = carry(&pose(mode));
        let others = found.modes.iter().filter(|mode| mode.real);
        let nearest = others.map(|other| apart(&pose(other), &carried)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{what}: a pose is {nearest:e} away");
    }
}

fn rounded(motion: &Motion<Rational>) -> Motion<f64> {
    crate::arms::rounded(motion)
}

const SETS: [(PlatformSet, usize); 6] = [
    (PlatformSet::General, 40),
    (PlatformSet::PlanarBoth, 40),
    (PlatformSet::Hexapod, 28),
    (PlatformSet::Shared(&[], &[(0, 1), (2, 3)]), 32),
    (PlatformSet::Shared(&[(0, 1), (2, 3), (4, 5)], &[(1, 2), (3, 4), (5, 0)]), 16),
    (PlatformSet::Similar, 24),
];

#[test]
fn frames_are_a_matter_of_taste() {
    let mut random = random(91);
    for (index, (set, count)) in SETS.into_iter().enumerate() {
        let (platform, squares) = exact(set, index as u64);
        let wanted = solve(&platform, &squares);
        assert_eq!(wanted.verdict.complex, count, "{set:?}: {}", wanted.verdict.reason);
        let (base, plate) = (motion(&mut random), motion(&mut random));
        let moved = Platform {
            base: platform.base.each_ref().map(|p| base.apply(p)),
            plate: platform.plate.each_ref().map(|p| plate.apply(p)),
        };
        // p + R b = g (p' + R' h b) with new points g a, h b.
        let (base, back) = (rounded(&base), rounded(&plate.inverse()));
        same(&format!("{set:?} moved"), &wanted, &solve(&moved, &squares), |pose| {
            base.then_after(pose).then_after(&back)
        });
    }
}

#[test]
fn legs_have_no_order() {
    for (index, (set, _)) in SETS.into_iter().enumerate() {
        let (platform, squares) = exact(set, 10 + index as u64);
        let order = [3, 0, 5, 1, 4, 2];
        let permuted = Platform {
            base: order.map(|k: usize| platform.base[k].clone()),
            plate: order.map(|k| platform.plate[k].clone()),
        };
        let wanted = solve(&platform, &squares);
        let found = solve(&permuted, &order.map(|k| squares[k].clone()));
        same(&format!("{set:?} permuted"), &wanted, &found, Clone::clone);
    }
}

#[test]
fn base_and_plate_may_change_places() {
    for (index, (set, _)) in SETS.into_iter().enumerate() {
        let (platform, squares) = exact(set, 20 + index as u64);
        let exchanged = Platform { base: platform.plate.clone(), plate: platform.base.clone() };
        let wanted = solve(&platform, &squares);
        same(&format!("{set:?} exchanged"), &wanted, &solve(&exchanged, &squares), Motion::inverse);
    }
}

#[test]
fn lengths_have_no_unit() {
    let (platform, squares) = exact(PlatformSet::General, 30);
    let wanted = solve(&platform, &squares);
    for unit in [Rational::from((1, 1000)), Rational::from((254, 10)), small(&mut random(3)).abs() + 1] {
        let scaled = platform.map(|x| Some(Rational::from(x * &unit))).unwrap();
        let square = Rational::from(unit.square_ref());
        let found = solve(&scaled, &squares.each_ref().map(|s| Rational::from(s * &square)));
        let factor = unit.to_f64();
        let verdict = |s: &Solution| (s.verdict.status, s.verdict.complex, s.verdict.real);
        assert_eq!(verdict(&wanted), verdict(&found));
        for mode in wanted.modes.iter().filter(|mode| mode.real) {
            let here = pose(mode);
            let others = found.modes.iter().filter(|mode| mode.real).map(pose).map(|mut other| {
                other.translation = other.translation.map(|x| x / factor);
                apart(&other, &here)
            });
            assert!(others.fold(f64::INFINITY, f64::min) < 1e-9);
        }
    }
}

#[test]
fn every_real_pose_of_plane_plates_has_a_mirror_image() {
    let (platform, squares) = exact(PlatformSet::PlanarBoth, 40);
    let solution = solve(&platform, &squares);
    let real: Vec<Motion<f64>> = solution.modes.iter().filter(|mode| mode.real).map(pose).collect();
    assert!(!real.is_empty());
    for here in &real {
        // Reflected in both planes: diag(1, 1, -1) before and behind.
        let sign = [1.0, 1.0, -1.0];
        let mirror = Motion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| sign[i] * sign[j] * here.rotation[i][j])),
            translation: std::array::from_fn(|i| sign[i] * here.translation[i]),
        };
        assert!(real.iter().any(|other| apart(other, &mirror) < 1e-9));
    }
}
