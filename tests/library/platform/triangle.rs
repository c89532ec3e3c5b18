//! Legs that meet in pairs: two resultants and the border basis find the same poses, in the number that an exact count gives.

use super::cases::{Draw, case, solved};
use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformMode, Route};
use looproot::internal::elimination::platform_degree::{PlatformDegree, platform_degree};
use looproot::internal::elimination::triangle_platform::{pairs, triangle_polynomial};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::platform::Platform;
use looproot_algebra::real_roots::RealRoot;
use looproot_algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Integer, Rational};

type Exact = Platform<Rational>;

/// Legs meet in pairs at the plate.
fn six_three(draw: &mut Draw, plane: bool) -> Exact {
    let mut platform = draw.platform();
    for k in 0..3 {
        platform.plate[2 * k + 1] = platform.plate[2 * k].clone();
    }
    if plane {
        platform.base.iter_mut().for_each(|a| a[2] = Rational::new());
    }
    platform
}

/// Two triangles.
fn three_three(draw: &mut Draw) -> Exact {
    let (base, plate) = ([draw.point(), draw.point(), draw.point()], [draw.point(), draw.point(), draw.point()]);
    Platform {
        base: [0, 0, 1, 1, 2, 2].map(|k: usize| base[k].clone()),
        plate: [0, 1, 1, 2, 2, 0].map(|k: usize| plate[k].clone()),
    }
}

fn exchanged(platform: Exact) -> Exact {
    Platform { base: platform.plate, plate: platform.base }
}

/// Returns the same platform with an invisible digit added: no points coincide.
fn parted(platform: &Exact) -> Exact {
    let mut parted = platform.clone();
    let tiny = Rational::from((1, Integer::from(1_u64 << 46)));
    for points in [&mut parted.base, &mut parted.plate] {
        for (k, point) in points.iter_mut().enumerate() {
            point[0] += &tiny * Rational::from(k + 1);
        }
    }
    parted
}

fn apart(one: &PlatformMode, two: &PlatformMode) -> f64 {
    let product: Complex<f64> = one.quaternion.iter().zip(&two.quaternion).map(|(a, b)| a * b.conj()).sum();
    let reach = one.position.iter().map(|z| z.norm()).fold(1.0, f64::max);
    let moved = one.position.iter().zip(&two.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    (1.0 - product.norm_sqr()).abs().max(moved / reach)
}

fn platforms() -> Vec<(String, bool, Exact, [Rational; 6])> {
    let mut all = Vec::new();
    for seed in 0..40 {
        let mut draw = Draw::new(500 + seed);
        let (at_base, platform) = match seed % 5 {
            0 => (false, six_three(&mut draw, false)),
            1 => (false, six_three(&mut draw, true)),
            2 => (true, exchanged(six_three(&mut draw, false))),
            3 => (true, exchanged(six_three(&mut draw, true))),
            _ => (false, three_three(&mut draw)),
        };
        // Legs that reach a pose, and others that need not.
        let mut legs = platform.legs_squared(&draw.pose().1);
        if seed % 2 == 1 {
            legs = legs.map(|l| l * Rational::from((2, 3)) + 7);
        }
        all.push((format!("{seed}"), at_base, platform, legs));
    }
    all
}

#[test]
fn two_resultants_find_what_the_border_basis_finds() {
    for (label, at_base, platform, legs) in platforms() {
        let assembly = solved(&platform, &legs, Roots::All);
        assert_eq!(assembly.route, Route::Triangle { at_base }, "{label}");
        assert_eq!(assembly.modes.len(), 16, "{label}");
        let other = solved(&parted(&platform), &legs, Roots::All);
        assert!(matches!(other.route, Route::BorderBasis { .. } | Route::Homotopy { .. }), "{label}");
        let distances = assembly
            .modes
            .iter()
            .map(|mode| other.modes.iter().map(|found| apart(mode, found)).fold(f64::INFINITY, f64::min));
        let worst = distances.fold(0.0, f64::max);
        assert!(worst < 1e-6, "{label}: {worst:e}");
        assert_eq!((assembly.real(), assembly.total()), (other.real(), other.total()), "{label}");
        for mode in &assembly.modes {
            assert!(mode.certificate.is_some() && mode.residual <= 1e-14, "{label}: {:e}", mode.residual);
        }
        let real = solved(&platform, &legs, Roots::Real);
        assert_eq!((real.route, real.modes.len()), (assembly.route, assembly.real()), "{label}");
    }
}

#[test]
fn the_two_resultants_are_a_polynomial_whose_roots_are_the_poses() {
    for (label, at_base, platform, legs) in platforms() {
        let Some(PlatformDegree::Finite { poses, .. }) = platform_degree(&platform, &legs) else { panic!("{label}") };
        assert_eq!(poses, 16, "{label}");
        let polynomial = triangle_polynomial(&platform, &legs, poses).unwrap();
        let plane = |points: &[[Rational; 3]; 6]| points.iter().all(|p| p[2] == 0);
        let mirrored = plane(if at_base { &platform.plate } else { &platform.base });
        let three = label.parse::<u64>().unwrap() % 5 == 4;
        let per_root = if mirrored || three { 2 } else { 1 };
        assert_eq!((polynomial.pairs.at_base, polynomial.per_root), (at_base, per_root), "{label}");
        assert_eq!(polynomial.coefficients.len(), 16 / per_root + 1, "{label}");
        let assembly = solved(&platform, &legs, Roots::All);
        let exact = Univariate::new(polynomial.coefficients.clone());
        let real: Vec<f64> = exact.real_roots().iter_mut().map(RealRoot::to_f64).collect();
        let leg = polynomial.pairs.legs[0][0];
        let point = if at_base { &platform.base[leg] } else { &platform.plate[leg] };
        let point = point.each_ref().map(|x| Complex::from(x.to_f64()));
        for mode in assembly.modes.iter().filter(|mode| mode.real) {
            let pure = |v: [Complex<f64>; 3]| Quaternion { scalar: Complex::from(0.0), vector: v };
            let [w, i, j, k] = mode.quaternion;
            let x = Quaternion { scalar: w, vector: [i, j, k] };
            let y = pure(mode.position).mul(&x);
            let value = polynomial.scaled_coordinate(&x, &y, &point).re;
            let nearest = real.iter().map(|root| (root - value).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-8 * (1.0 + value.abs()), "{label}: {value} {nearest:e}");
        }
        assert!(assembly.real() <= real.len() * per_root);
        if per_root == 1 {
            assert_eq!(assembly.real(), real.len(), "{label}");
        }
    }
}

#[test]
fn other_platforms_have_no_triangle() {
    let general = case("gen66_3");
    assert!(pairs(&general.platform).is_none());
    assert!(triangle_polynomial(&general.platform, &general.legs, 40).is_none());
    // Twice the same leg, and four legs at one point.
    let mut draw = Draw::new(9);
    let mut twice = six_three(&mut draw, false);
    twice.base[1] = twice.base[0].clone();
    assert!(pairs(&twice).is_none());
    let mut four = six_three(&mut draw, false);
    four.plate[2] = four.plate[0].clone();
    four.plate[3] = four.plate[0].clone();
    assert!(pairs(&four).is_none());
}

#[test]
fn circles_without_radius_are_circles() {
    // Leg 2 is as long as leg 1 and the distance of their feet: the corner can only be the foot of leg 1 where that has
    // length zero; the other legs as at a pose.
    let mut draw = Draw::new(77);
    let platform = six_three(&mut draw, false);
    let (_, mut pose) = draw.pose();
    let corner = pose.apply(&platform.plate[0]);
    for k in 0..3 {
        pose.translation[k] += Rational::from(&platform.base[0][k] - &corner[k]);
    }
    let legs = platform.legs_squared(&pose);
    assert!(legs[0] == 0);
    let Some(PlatformDegree::Finite { poses, .. }) = platform_degree(&platform, &legs) else { panic!() };
    let assembly = solved(&platform, &legs, Roots::All);
    assert_eq!(assembly.total(), poses);
}
