//! All poses in f64.

use super::cases::{Draw, case, cases, nearest, solved};
use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace, Route};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

#[test]
fn every_pose_of_every_case_is_found_and_proved() {
    for case in cases() {
        let assembly = solved(&case.platform, &case.legs, Roots::All);
        let Some((complex, real)) = case.counts else {
            assert!(assembly.modes.is_empty() && assembly.self_motion == 1, "{}", case.name);
            continue;
        };
        assert_eq!((assembly.total(), assembly.real()), (complex, real), "{}", case.name);
        for mode in &assembly.modes {
            assert!(mode.certificate.is_some(), "{}", case.name);
            assert!(mode.residual <= 1e-14, "{}: {:e}", case.name, mode.residual);
        }
        // Dietmaier's poses are given for lengths of 15 digits, and close together.
        let tolerance = if case.name == "dietmaier40" { 1e-11 } else { 1e-12 };
        for pose in &case.poses {
            let distance = nearest(&assembly, pose);
            assert!(distance < tolerance, "{}: {distance:e}", case.name);
        }
        let real_only = solved(&case.platform, &case.legs, Roots::Real);
        assert_eq!((real_only.total(), real_only.real()), (real, real), "{}", case.name);
        let plane = ["planar_both_0", "3-3_0"].contains(&case.name.as_str());
        for (k, mode) in assembly.modes.iter().enumerate() {
            assert_eq!(mode.mirror.is_some(), plane, "{}", case.name);
            assert!(mode.mirror.is_none_or(|j| assembly.modes[j].mirror == Some(k)), "{}", case.name);
        }
    }
}

#[test]
fn the_answers_say_which_way_they_were_found() {
    let route = |name: &str| {
        let case = case(name);
        solved(&case.platform, &case.legs, Roots::All).route
    };
    assert_eq!(route("dietmaier40"), Route::BorderBasis { directions: 1 });
    assert_eq!(route("planar_both_0"), Route::BorderBasis { directions: 2 });
    assert!(matches!(route("affine_0"), Route::Homotopy { .. }));
}

#[test]
fn paths_that_run_together_count_a_singular_pose() {
    // The plate similar to the base and not turned against it: all legs meet in one point.
    let mut platform = Draw::new(31).platform();
    platform.plate = platform.base.clone().map(|a| a.map(|x| x * Rational::from((3, 2))));
    let mut pose = Motion::<Rational>::identity();
    pose.translation = [3, 4, 20].map(Rational::from);
    let assembly = solved(&platform, &platform.legs_squared(&pose), Roots::All);
    assert!(matches!(assembly.route, Route::Homotopy { .. }));
    let singular: Vec<_> = assembly.modes.iter().filter(|mode| mode.certificate.is_none()).collect();
    assert_eq!((assembly.total(), singular.len(), singular[0].multiplicity), (24, 1, 8));
    for (found, planted) in singular[0].position.iter().zip([3.0, 4.0, 20.0]) {
        assert!(singular[0].real && (found - planted).norm() < 1e-6, "{found}");
    }
}

#[test]
fn units_and_origins_change_nothing() {
    let case = case("gen66_3");
    let counts = |platform: &Platform<Rational>, legs: &[Rational; 6]| {
        let assembly = solved(platform, legs, Roots::All);
        (assembly.total(), assembly.real(), assembly.modes.iter().all(|m| m.certificate.is_some()))
    };
    for factor in [Rational::from((1, 1000)), Rational::from(1000)] {
        let scaled = case.platform.map(|x| Some(Rational::from(x * &factor))).unwrap();
        let square = Rational::from(&factor * &factor);
        assert_eq!(counts(&scaled, &case.legs.each_ref().map(|l| Rational::from(l * &square))), (40, 4, true));
    }
    let mut moved = case.platform.clone();
    moved.base.iter_mut().for_each(|a| a[1] += 100_000);
    moved.plate.iter_mut().for_each(|b| b[2] -= 50_000);
    assert_eq!(counts(&moved, &case.legs), (40, 4, true));
}

fn uniform(random: &mut ChaCha8Rng) -> f64 {
    random.random_range(-1.0..1.0)
}

/// A random platform with plates out of their planes by `height`, and a pose: parallel plates where `home`.
fn nearly_plane(random: &mut ChaCha8Rng, height: f64, home: bool) -> (Platform<f64>, Motion<f64>) {
    let mut points =
        || -> [[f64; 3]; 6] { std::array::from_fn(|_| [uniform(random), uniform(random), height * uniform(random)]) };
    let platform = Platform { base: points(), plate: points() };
    let mut turn = Motion::rotation_z(0.96, 0.28);
    if !home {
        let (sin, cos) = (3.0 * uniform(random)).sin_cos();
        let (sin2, cos2) = (3.0 * uniform(random)).sin_cos();
        turn = turn.then_after(&Motion::rotation_x(cos, sin)).then_after(&Motion::rotation_z(cos2, sin2));
    }
    turn.translation = [0.3 * uniform(random), 0.3 * uniform(random), 1.2];
    (platform, turn)
}

#[test]
fn plates_in_and_near_a_plane_lose_nothing() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    for height in [1.0, 1e-2, 1e-4, 1e-6, 1e-9, 0.0] {
        for home in [false, true] {
            for trial in 0..4 {
                let (platform, pose) = nearly_plane(&mut random, height, home);
                let solver = PlatformSolver::prepare(&platform);
                solver.solve(&platform.legs_squared(&pose), Roots::All, &mut workspace, &mut assembly);
                let label = format!("{height:e} {home} {trial}");
                assert_eq!(assembly.total(), 40, "{label}");
                assert!(assembly.modes.iter().all(|m| m.residual <= 1e-14), "{label}");
                let near = |k: usize, x: f64| (x - pose.translation[k]).abs() < 1e-6;
                let planted = |m: &&_| {
                    let m: &&looproot::internal::assembly::platform::PlatformMode = m;
                    m.real && (0..3).all(|k| near(k, m.position[k].re))
                };
                assert!(assembly.modes.iter().find(planted).is_some(), "{label}");
            }
        }
    }
}

#[test]
fn bad_numbers_are_answered_and_not_feared() {
    let mut draw = Draw::new(1);
    let platform = draw.platform().map(|x| Some(x.to_f64())).unwrap();
    let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    let mut solve = |platform: &Platform<f64>, legs: [f64; 6]| {
        PlatformSolver::prepare(platform).solve(&legs, Roots::All, &mut workspace, &mut assembly);
        assembly.modes.clone()
    };
    assert!(solve(&platform, [f64::NAN; 6]).is_empty());
    // All legs of length zero: no pose is real, though complex ones exist.
    assert!(solve(&platform, [0.0; 6]).iter().all(|mode| !mode.real));
    let mut one_point = platform.clone();
    one_point.plate = [[1.0, 2.0, 3.0]; 6];
    solve(&one_point, [10.0; 6]);
    let nothing = Platform { base: [[0.0; 3]; 6], plate: [[0.0; 3]; 6] };
    solve(&nothing, [1.0; 6]);
    let infinite = Platform { base: [[f64::INFINITY; 3]; 6], ..platform };
    assert!(solve(&infinite, [1.0; 6]).is_empty());
}
