//! Numbers of poses and closure polynomials, exactly.

use super::cases::{Draw, case, cases, solved};
use looproot::internal::assembly::Roots;
use looproot::internal::closure::study::linear_legs;
use looproot::internal::elimination::border::{Arithmetic, BorderBasis, DIMENSION, Reals, Setting, weak_directions};
use looproot::internal::elimination::platform_degree::{PlatformDegree, modular_setting, platform_degree};
use looproot::internal::elimination::platform_height::PlatformHeight;
use looproot::internal::elimination::platform_polynomial::{multiple_platform_polynomial, platform_polynomial};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot_algebra::modp::primes;
use looproot_algebra::number::nearest_f64;
use looproot_algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Float, Rational};

/// The number of poses, `None` where they form a curve.
fn count(platform: &Platform<Rational>, legs: &[Rational; 6]) -> Option<usize> {
    match platform_degree(platform, legs).unwrap() {
        PlatformDegree::Finite { poses, null, .. } => {
            assert_eq!(poses + null, 40);
            Some(poses)
        }
        PlatformDegree::Infinite { .. } => None,
    }
}

#[test]
fn the_exact_count_is_that_of_other_programs() {
    for case in cases().iter().filter(|case| case.name != "arch_singular_conic") {
        assert_eq!(count(&case.platform, &case.legs), case.counts.map(|(complex, _)| complex), "{}", case.name);
    }
}

/// Makes some points of base or plate coincide.
fn merged(points: &mut [[Rational; 3]; 6], pairs: &[(usize, usize)]) {
    for &(from, to) in pairs {
        points[to] = points[from].clone();
    }
}

#[test]
fn special_geometries_have_fewer_poses_and_all_are_found() {
    type Make = fn(&mut Platform<Rational>);
    let classes: [(&str, usize, Make); 8] = [
        ("5-4, curves with N = 0", 16, |p| {
            merged(&mut p.base, &[(0, 1)]);
            merged(&mut p.plate, &[(2, 3), (4, 5)]);
        }),
        ("6-3 with three legs at a point", 8, |p| merged(&mut p.plate, &[(0, 1), (0, 2), (3, 4)])),
        ("3-6", 16, |p| merged(&mut p.base, &[(0, 1), (2, 3), (4, 5)])),
        ("similar", 24, |p| p.plate = p.base.clone().map(|a| a.map(|x| x * Rational::from((2, 3))))),
        ("mirrored", 24, |p| p.plate = p.base.clone().map(|[x, y, z]| [x, y, -z])),
        ("congruent", 24, |p| p.plate = p.base.clone()),
        ("affine", 32, |p| {
            p.plate = p.base.clone().map(|[x, y, z]| [y.clone() * 2 + &x, y - &z * Rational::from(3), x + z]);
        }),
        ("similar and plane", 16, |p| {
            p.base.iter_mut().for_each(|a| a[2] = Rational::new());
            p.plate = p.base.clone().map(|a| a.map(|x| x * Rational::from((2, 3))));
        }),
    ];
    for (seed, (name, poses, make)) in (20_u64..).zip(classes) {
        let mut draw = Draw::new(seed);
        let mut platform = draw.platform();
        make(&mut platform);
        let legs = platform.legs_squared(&draw.pose().1);
        assert_eq!(count(&platform, &legs), Some(poses), "{name}");
        let assembly = solved(&platform, &legs, Roots::All);
        assert_eq!(assembly.total(), poses, "{name}");
        assert!(assembly.modes.iter().all(|m| m.certificate.is_some()), "{name}");
    }
}

/// Points of a circle, and a smaller similar plate.
fn on_a_circle() -> Platform<Rational> {
    let base = std::array::from_fn(|i| {
        let t = Rational::from((3 * i32::try_from(i).unwrap() - 7, 5));
        let square = Rational::from(&t * &t);
        let whole = Rational::from(&square + 1);
        [(1 - square) * 10 / &whole, t * 20 / whole, Rational::new()]
    });
    let plate = base.clone().map(|a: [Rational; 3]| a.map(|x| x * Rational::from((3, 5))));
    Platform { base, plate }
}

#[test]
fn architecture_singular_platforms_have_no_pose_or_a_curve_of_them() {
    let platform = on_a_circle();
    let mut legs = platform.legs_squared(&Draw::new(5).pose().1);
    assert_eq!(count(&platform, &legs), None);
    assert_eq!(solved(&platform, &legs, Roots::Real).self_motion, 1);
    legs[0] += 1;
    assert_eq!(count(&platform, &legs), Some(0));
    let assembly = solved(&platform, &legs, Roots::All);
    assert!(assembly.modes.is_empty() && assembly.self_motion == 0);
}

/// A plate congruent to the base on equal legs swings without turning, in two directions.
#[test]
fn a_plate_that_swings_without_turning_is_no_finite_number_of_poses() {
    let mut draw = Draw::new(40);
    let mut platform = draw.platform();
    platform.plate = platform.base.clone();
    let legs = std::array::from_fn(|_| Rational::from(49));
    assert_eq!(count(&platform, &legs), None);
    assert_eq!(count(&platform, &platform.legs_squared(&draw.pose().1)), Some(24));
}

/// The planted rotation (1, 1, 1, 0) is a right angle away from the turn (2, 1, -3, 1) of one of the coordinates.
#[test]
fn small_integers_leave_a_coordinate() {
    let mut draw = Draw::new(41);
    let mut platform = draw.platform();
    platform.base.iter_mut().for_each(|a| a[2] = Rational::new());
    platform.plate = platform.base.clone().map(|a| a.map(|x| x * Rational::from((3, 5))));
    let [one, zero] = [1, 0].map(Rational::from);
    let rotation = Quaternion { scalar: one.clone(), vector: [one.clone(), one, zero] };
    let square = rotation.norm();
    let turned = rotation.scaled_rotation().map(|row| row.map(|x| x / &square));
    let pose = Motion { rotation: turned, translation: draw.point() };
    let legs = platform.legs_squared(&pose);
    assert_eq!(count(&platform, &legs), Some(16));
    let polynomial = multiple_platform_polynomial(&platform, &legs).unwrap();
    assert_eq!(polynomial.coefficients.len(), 17);
}

/// The largest entry of `X_i X_j - X_j X_i`, as the arithmetic has it.
fn commutators<A: Arithmetic>(arithmetic: &A, basis: &BorderBasis<A::Element>) -> Vec<A::Element> {
    let mut all = Vec::new();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        for b in 0..DIMENSION {
            let mut row = [arithmetic.zero(); DIMENSION];
            for k in 0..DIMENSION {
                arithmetic.add_multiple(&mut row, basis.products[i][b][k], &basis.products[j][k]);
                arithmetic.add_multiple(&mut row, arithmetic.neg(basis.products[j][b][k]), &basis.products[i][k]);
            }
            all.extend(row);
        }
    }
    all
}

#[test]
fn multiplication_commutes_exactly_and_in_f64() {
    for seed in 0..3 {
        let mut draw = Draw::new(seed);
        let platform = draw.platform();
        let legs = platform.legs_squared(&draw.pose().1);
        let modulus = primes().nth(5).unwrap();
        let setting = modular_setting(&modulus, &linear_legs(&platform), &legs).unwrap();
        let mut basis = BorderBasis::new(&modulus);
        basis.build(&modulus, &setting).unwrap();
        assert!(commutators(&modulus, &basis).iter().all(|&x| x == 0));

        let scaled = platform.map(|x| Some(nearest_f64(x) / 20.0)).unwrap();
        let linear = linear_legs(&scaled);
        let directions = weak_directions(&linear.matrix);
        let setting = Setting::new(&Reals, &directions, &linear.forms);
        let setting = setting.with_legs(&Reals, &directions, &legs.each_ref().map(|l| nearest_f64(l) / 400.0));
        let mut basis = BorderBasis::new(&Reals);
        basis.build(&Reals, &setting).unwrap();
        assert!(basis.quality > 1e-6);
        let largest = basis.products.iter().flatten().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let worst = commutators(&Reals, &basis).iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(worst < 1e-9 * largest * largest, "{worst:e} {largest:e}");
    }
}

/// `|p(t)|` over the size of its terms.
fn backward_error(coefficients: &[rug::Integer], t: Complex<f64>) -> f64 {
    const BITS: u32 = 400;
    let float = |x: f64| Float::with_val(BITS, x);
    let (mut re, mut im, mut size) = (float(0.0), float(0.0), float(0.0));
    let norm = float(t.re).hypot(&float(t.im));
    for c in coefficients.iter().rev() {
        let real = Float::with_val(BITS, &re * t.re) - Float::with_val(BITS, &im * t.im) + c;
        im = Float::with_val(BITS, &re * t.im) + Float::with_val(BITS, &im * t.re);
        re = real;
        size = size * &norm + Float::with_val(BITS, c).abs();
    }
    (re.hypot(&im) / size).to_f64()
}

#[test]
fn the_poses_are_the_roots_of_the_exact_polynomial() {
    for name in ["gen66_1", "planar_both_0", "6-4_0", "3-3_0", "chart_x0zero"] {
        let case = case(name);
        let (complex, real) = case.counts.unwrap();
        let polynomial = platform_polynomial(&case.platform, &case.legs).unwrap();
        assert_eq!(polynomial.coefficients.len(), complex + 1, "{name}");
        assert!(polynomial.proved, "{name}");
        for mode in &solved(&case.platform, &case.legs, Roots::All).modes {
            let error = backward_error(&polynomial.coefficients, polynomial.coordinate.at(&mode.quaternion));
            assert!(error < 1e-12, "{name}: {error:e}");
        }
        if complex < 40 {
            let exact = polynomial.coefficients.iter().map(Rational::from).collect();
            assert_eq!(Univariate::new(exact).distinct_real_roots(), real, "{name}");
        }
    }
}

/// Mahler's measure is no less than any coefficient over its binomial coefficient, and the bound no less than that; but not
/// so much larger that it were of no use.
#[test]
fn polynomials_are_no_larger_than_is_known_beforehand() {
    for seed in 30..36 {
        let mut draw = Draw::new(seed);
        let mut platform = draw.platform();
        if seed % 2 == 0 {
            let third = |points: &mut [[Rational; 3]; 6]| points.iter_mut().flatten().for_each(|x| *x /= 3);
            third(&mut platform.base);
            third(&mut platform.plate);
        }
        let legs = platform.legs_squared(&draw.pose().1);
        let height = PlatformHeight::new(&linear_legs(&platform), &legs);
        let polynomial = platform_polynomial(&platform, &legs).unwrap();
        assert!(polynomial.proved && polynomial.coordinate.weights == [1, 0, 0]);
        let longest = polynomial.coefficients.iter().map(rug::Integer::significant_bits).max().unwrap();
        let measure = height.measure(&polynomial.coordinate.weights);
        assert!(f64::from(longest) < measure + 40.0, "{longest} {measure}");
        assert!(measure < 8.0 * f64::from(longest), "{longest} {measure}");
        assert!(height.norm() > measure);
        assert!(f64::from(u32::try_from(polynomial.primes).unwrap()) * 62.0 > measure + f64::from(longest));
    }
}

#[test]
fn what_is_not_proved_is_not_said_to_be() {
    let mut draw = Draw::new(23);
    let mut platform = draw.platform();
    merged(&mut platform.plate, &[(0, 1), (0, 2), (3, 4)]);
    for (scale, proved) in [(1, true), (1_000_000_007, false)] {
        // Lengths that no unit makes short.
        platform.base[0][0] += Rational::from((1, scale)) - 1_u32;
        let legs = platform.legs_squared(&draw.pose().1);
        let polynomial = platform_polynomial(&platform, &legs).unwrap();
        assert_eq!((polynomial.coefficients.len(), polynomial.proved), (9, proved));
    }
}

#[test]
fn a_planted_pose_is_a_rational_root() {
    let mut draw = Draw::new(8);
    let platform = draw.platform();
    let (q, pose) = draw.pose();
    let polynomial = platform_polynomial(&platform, &platform.legs_squared(&pose)).unwrap();
    assert_eq!(polynomial.coordinate.weights, [1, 0, 0]);
    let root = Rational::from(&q.vector[0] / &q.scalar);
    let exact = Univariate::new(polynomial.coefficients.iter().map(Rational::from).collect());
    assert!(exact.eval(&root).is_zero());
}
