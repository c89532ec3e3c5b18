//! Special geometries: counts of another program, poses f64 does not reach, self-motions, legs of length zero.

use super::cases::{Draw, answer, solved, translation};
use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::benchmark::platform::sample::{PlatformSet, sample};
use looproot::internal::elimination::platform_degree::{PlatformDegree, platform_degree};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::mechanism::Solution;
use looproot::internal::verdict::Status;
use looproot_algebra::number::nearest_f64;
use rug::Rational;

type Exact = Platform<Rational>;

const BASE: [[i32; 3]; 6] = [[-12, 16, -16], [-4, -13, 11], [8, 10, 4], [-7, -14, 11], [-19, 4, 7], [18, -20, 8]];
const SQUARES: [i32; 6] = [2564, 1254, 1715, 1245, 1196, 2182];

fn points(points: [[i32; 3]; 6]) -> [[Rational; 3]; 6] {
    points.map(|p| p.map(Rational::from))
}

fn count(platform: &Exact, squares: &[Rational; 6]) -> PlatformDegree {
    platform_degree(platform, squares).unwrap()
}

fn certified(assembly: &PlatformAssembly) -> usize {
    assembly.modes.iter().filter(|mode| mode.certificate.is_some()).count()
}

#[test]
fn related_plates_have_as_many_poses_as_a_groebner_basis_says() {
    // Singular 4.3.1 modulo 32003, with a generic patch and u N = 1: the dimension is 0, and the number of solutions with
    // multiplicity is the number without. All of them are simple, though poses of a congruent plate share |x_i| in pairs (g and
    // its inverse), and those of plane plates share rotations in pairs (mirrored in the plane).
    let flat = |p: [[i32; 3]; 6]| p.map(|[x, y, _]| [x, y, 0]);
    let large = |p: [[i32; 3]; 6]| p.map(|p| p.map(|x| 3 * x));
    let mirrored = BASE.map(|[x, y, z]| [x, y, -z]);
    for (name, base, plate, poses) in [
        ("congruent", BASE, BASE, 24),
        ("mirrored", BASE, mirrored, 24),
        ("similar", BASE, large(BASE), 24),
        ("similar and plane", flat(BASE), large(flat(BASE)), 16),
        ("congruent and plane", flat(BASE), flat(BASE), 16),
    ] {
        let (platform, squares) = (Platform { base: points(base), plate: points(plate) }, SQUARES.map(Rational::from));
        assert!(matches!(count(&platform, &squares), PlatformDegree::Finite { poses: p, .. } if p == poses), "{name}");
        let assembly = solved(&platform, &squares, Roots::All);
        assert_eq!((assembly.total(), certified(&assembly)), (poses, poses), "{name}");
    }
}

fn drawn(set: PlatformSet, seed: u64, index: u64) -> (Exact, [Rational; 6], usize) {
    let drawn = sample(set, seed, index).unwrap();
    let squares = drawn.entry.cases[0].legs_squared.as_ref().unwrap().each_ref().map(|s| s.rational().clone());
    let platform = drawn.platform.map(|x| Rational::from_f64(*x)).unwrap();
    let PlatformDegree::Finite { poses, .. } = count(&platform, &squares) else { panic!("{set:?} {index}") };
    (platform, squares, poses)
}

#[test]
fn poses_a_million_sizes_away_are_found_at_the_end_of_a_homotopy() {
    // |N| of two complex poses is below 1e-5, and f64 does not tell them from families with N = 0.
    let pairs: &[(usize, usize)] = &[(2, 3), (4, 5)];
    for (set, seed, index) in [
        (PlatformSet::Affine, 3, 401),
        (PlatformSet::Similar, 3, 27),
        (PlatformSet::Similar, 11, 444),
        (PlatformSet::Shared(&[(0, 1)], pairs), 11, 84),
    ] {
        let (platform, squares, poses) = drawn(set, seed, index);
        let assembly = solved(&platform, &squares, Roots::All);
        assert_eq!((assembly.total(), certified(&assembly)), (poses, poses), "{set:?} {index}");
        assert!(assembly.modes.iter().any(|mode| mode.norm < 1e-4), "{set:?} {index}");
        assert!(assembly.modes.iter().all(|mode| mode.residual < 1e-14), "{set:?} {index}");
    }
}

#[test]
fn numbers_of_384_bits_alone_find_every_pose_of_special_geometries() {
    let triple: &[(usize, usize)] = &[(0, 1), (0, 2), (3, 4)];
    for set in
        [PlatformSet::Affine, PlatformSet::Congruent, PlatformSet::SimilarPlanar, PlatformSet::Shared(&[], triple)]
    {
        let (platform, squares, poses) = drawn(set, 3, 1);
        let real = solved(&platform, &squares, Roots::All).real();
        let solver = PlatformSolver::prepare(&platform.map(|x| Some(nearest_f64(x))).unwrap());
        let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
        solver.solve_in_high_precision::<6>(&platform, &squares, poses, &mut workspace, &mut assembly);
        assert_eq!((assembly.total(), certified(&assembly), assembly.real()), (poses, poses, real), "{set:?}");
    }
}

/// A rotation about z by the angle with cosine -7/25, and a translation.
fn turned_about_z(translation: [i32; 3]) -> Motion<Rational> {
    let [c, s] = [-7, 24].map(|x| Rational::from((x, 25)));
    let (zero, one) = (Rational::new(), Rational::from(1));
    let rotation = [[c.clone(), -s.clone(), zero.clone()], [s, c, zero.clone()], [zero.clone(), zero, one]];
    Motion { rotation, translation: translation.map(Rational::from) }
}

/// One family, whose poses have legs of these lengths; of a curve more than one pose.
fn check_family(platform: &Exact, squares: &[Rational; 6], solution: &Solution, dimension: usize) {
    let [family] = solution.families.as_slice() else { panic!("{} families", solution.families.len()) };
    assert_eq!((family.dimension, family.samples.len() > 10), (dimension, dimension == 1));
    for pose in family.samples.iter().chain([&family.sample]) {
        let pose: Vec<Rational> = pose.iter().map(|x| Rational::from_f64(*x).unwrap()).collect();
        let [w, x, y, z, position @ ..] = &pose[..] else { panic!("a pose of {} numbers", pose.len()) };
        let q = Quaternion { scalar: w.clone(), vector: [x.clone(), y.clone(), z.clone()] };
        let motion = Motion { rotation: q.scaled_rotation(), translation: position.to_vec().try_into().unwrap() };
        for (found, wanted) in platform.legs_squared(&motion).iter().zip(squares) {
            assert!(Rational::from(found - wanted).abs() < wanted.clone() / 1_000_000_u32, "{found} {wanted}");
        }
    }
}

#[test]
fn the_dimension_of_a_self_motion_is_not_its_corank() {
    // Similar hexagons in circles, turned about z: the equations x1^2 - x2^2 = x1 x2 = 0 are among those of the legs, so that
    // these give way in three directions, where there is motion in one.
    let circle: [[Rational; 3]; 6] = [(0, 1), (1, 2), (2, 1), (-1, 3), (-3, 1), (-1, 1)].map(|(p, q)| {
        let t = Rational::from((p, q));
        let square = Rational::from(&t * &t);
        let whole = Rational::from(&square + 1);
        [(1 - square) * 100 / &whole, t * 200 / whole, Rational::new()]
    });
    let half = circle.clone().map(|p| p.map(|x| x / 2));
    let platform = Platform { base: circle, plate: half };
    let squares = platform.legs_squared(&turned_about_z([10, 20, 130]));
    assert_eq!(count(&platform, &squares), PlatformDegree::Infinite { dimension: 1 });
    let solution = answer(&platform, &squares);
    assert_eq!((solution.verdict.status, solution.verdict.self_motion), (Status::SelfMotion, 1));
    check_family(&platform, &squares, &solution, 1);
    assert!(solution.modes.iter().all(|mode| mode.certified), "points of a curve are listed as isolated poses");

    // A congruent plate on six equal legs: translations on a sphere, all with one rotation.
    let platform = Platform { base: points(BASE), plate: points(BASE) };
    let squares = [1; 6].map(|_| Rational::from(10_000));
    assert_eq!(count(&platform, &squares), PlatformDegree::Infinite { dimension: 2 });
    let solution = answer(&platform, &squares);
    assert_eq!((solution.verdict.status, solution.verdict.self_motion), (Status::SelfMotion, 2));
    check_family(&platform, &squares, &solution, 2);

    // Four legs to one point: the plate turns about it, two legs left to hold it.
    let mut base = points(BASE);
    for k in 1..4 {
        base[k] = base[0].clone();
    }
    let mut draw = Draw::new(41);
    let platform = Platform { base, plate: draw.platform().plate };
    let squares = platform.legs_squared(&draw.pose().1);
    assert_eq!(answer(&platform, &squares).verdict.self_motion, 1);
}

#[test]
fn coordinates_rounded_to_15_digits_have_no_self_motion_and_none_is_claimed() {
    let rounded = |x: f64| Rational::from_f64((x * 1e13).round() / 1e13).unwrap();
    let hexagon = |radius: f64| -> [[Rational; 3]; 6] {
        std::array::from_fn(|k| {
            let (sin, cos) = (std::f64::consts::FRAC_PI_3 * k as f64).sin_cos();
            [rounded(radius * cos), rounded(radius * sin), Rational::new()]
        })
    };
    let platform = Platform { base: hexagon(100.0), plate: hexagon(50.0) };
    let squares = platform.legs_squared(&turned_about_z([0, 0, 100]));
    let solution = answer(&platform, &squares);
    // For exactly these data all poses are isolated, though f64 cannot distinguish them from a curve.
    assert!(solution.verdict.status != Status::SelfMotion && solution.verdict.self_motion == 0);
    assert!(solution.verdict.complex <= 40 && solution.modes.iter().all(|mode| mode.certified));
}

#[test]
fn poses_where_the_ends_of_legs_coincide_are_found_with_their_multiplicity() {
    let mut draw = Draw::new(43);
    for (zero, multiplicity) in [(0, 1), (1, 2), (2, 4), (3, 8)] {
        let mut platform = draw.platform();
        let pose = translation([3, -5, 8].map(Rational::from));
        for k in 0..zero {
            platform.plate[k] = std::array::from_fn(|c| Rational::from(&platform.base[k][c] - &pose.translation[c]));
        }
        let squares = platform.legs_squared(&pose);
        let solution = answer(&platform, &squares);
        assert_eq!(solution.verdict.complex, 40, "{zero}: {}", solution.verdict.reason);
        let planted = solution.modes.iter().find(|mode| {
            let apart = [1.0, 0.0, 0.0, 0.0, 3.0, -5.0, 8.0].iter().zip(&mode.q).map(|(a, b)| (b - a).norm());
            mode.real && apart.fold(0.0, f64::max) < 1e-9
        });
        let planted = planted.unwrap();
        assert_eq!((planted.multiplicity, planted.certified), (multiplicity, true), "{zero}");
        assert!(solution.verdict.proof.is_proved(), "{zero}: {}", solution.verdict.reason);
    }
}

#[test]
fn six_legs_that_meet_one_line_make_a_double_pose() {
    // At the identity every leg goes through the z axis: the six lines are dependent, and the pose is a double one.
    let mut draw = Draw::new(47);
    for _ in 0..3 {
        let base: [[Rational; 3]; 6] = std::array::from_fn(|_| draw.point());
        let plate = std::array::from_fn(|k: usize| {
            let height = draw.number();
            let part = Rational::from((2 * i32::try_from(k).unwrap() + 5, 3));
            std::array::from_fn(|c| {
                let onto = if c == 2 { height.clone() } else { Rational::new() };
                &base[k][c] + (onto - &base[k][c]) * &part
            })
        });
        let platform = Platform { base, plate };
        let pose = translation([0; 3].map(Rational::from));
        let solution = answer(&platform, &platform.legs_squared(&pose));
        assert_eq!((solution.verdict.complex, solution.verdict.certified), (40, 39), "{}", solution.verdict.reason);
        assert!(solution.verdict.proof.is_proved(), "{}", solution.verdict.reason);
        let double: Vec<_> = solution.modes.iter().filter(|mode| mode.multiplicity == 2).collect();
        assert!(double.len() == 1 && double[0].real && double[0].q[4..].iter().all(|p| p.norm() == 0.0));
    }
}
