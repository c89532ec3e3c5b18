use super::*;
use crate::algebra::modp::{Modulus, PRIME_61};
use crate::closure::study::linear_legs;
use crate::elimination::characteristic::characteristic_polynomial;
use crate::elimination::platform_degree::{inverse, modular_setting, regular_part, row_times, special_products};

const BASE: [[i32; 3]; 6] = [[-12, 16, -16], [-4, -13, 11], [8, 10, 4], [-7, -14, 11], [-19, 4, 7], [18, -20, 8]];
const SQUARES: [i32; 6] = [2564, 1254, 1715, 1245, 1196, 2182];

/// Points of a base in general position, turned so that no rotation has z_0 = 0, and their images shifted.
fn platform(base: [[i32; 3]; 6], matrix: [[i32; 3]; 3], divisor: i32) -> Platform<Rational> {
    let image = |p: &[i32; 3]| -> Vector<Rational> {
        std::array::from_fn(|i| {
            Rational::from(((0..3).map(|k| matrix[i][k] * p[k]).sum::<i32>() + 5 * divisor, divisor))
        })
    };
    // A rotation by the quaternion (1, 2, 2, 4)/5.
    let turn = [[-15, 0, 20], [16, -15, 12], [12, 20, 9]];
    let turned = |p: &[i32; 3]| -> Vector<Rational> {
        std::array::from_fn(|i| Rational::from(((0..3).map(|k| turn[i][k] * p[k]).sum::<i32>(), 25)))
    };
    Platform { base: base.each_ref().map(turned), plate: base.each_ref().map(image) }
}

/// The polynomial of `z_3/z_0` as the graded ring of all platforms has it, modulo a prime.
fn by_graded_ring(modulus: &Modulus, platform: &Platform<Rational>, squares: &[Rational; 6]) -> Vec<u64> {
    let setting = modular_setting(modulus, &linear_legs(platform), squares).unwrap();
    let products = special_products(modulus, |x| inverse(modulus, x), &setting).unwrap();
    let regular = regular_part(modulus, |x| inverse(modulus, x), &products).unwrap();
    let image = |v: &Vec<u64>| {
        let product = row_times(modulus, v, &products[2]);
        regular.pivots.iter().map(|&p| product[p]).collect()
    };
    let mut matrix: Vec<Vec<u64>> = regular.basis.iter().map(image).collect();
    characteristic_polynomial(modulus, |x| inverse(modulus, x), &mut matrix).unwrap()
}

/// Counts the poses, and compares their polynomial with that of the graded ring.
fn check(platform: &Platform<Rational>, counts: (usize, usize)) {
    let (modulus, squares) = (Modulus::new(PRIME_61), SQUARES.map(Rational::from));
    let known = AffinePlatform::new(platform, &squares).unwrap();
    assert_eq!((known.counts(), known.relation.bound().poses), (counts, counts.0 * counts.1));
    let image = |x: &Rational| {
        let below = inverse(&modulus, modulus.reduce(x.denom()))?;
        Some(Modulus::mul(&modulus, modulus.reduce(x.numer()), below))
    };
    let products = known.products_of_poses(&modulus, |x| inverse(&modulus, x), image).unwrap();
    let mut matrix = products[2].clone();
    let half = characteristic_polynomial(&modulus, |x| inverse(&modulus, x), &mut matrix).unwrap();
    assert_eq!(half.len(), counts.0 + 1);
    let mut whole = half.clone();
    if counts.1 == 2 {
        whole = vec![0; 2 * counts.0 + 1];
        for (k, c) in half.iter().enumerate() {
            modulus.add_multiple(&mut whole[k..k + half.len()], *c, &half);
        }
    }
    assert_eq!(whole, by_graded_ring(&modulus, platform, &squares));
}

#[test]
fn affine_plates_have_32_poses() {
    check(&platform(BASE, [[2, 1, -1], [0, 3, 1], [1, -2, 5]], 3), (32, 1));
    // The image of space in a plane.
    check(&platform(BASE, [[2, 1, -1], [0, 3, 1], [2, 4, 0]], 3), (32, 1));
}

#[test]
fn similar_plates_have_24_poses() {
    check(&platform(BASE, [[2, 1, 2], [1, 2, -2], [-2, 2, 1]], 2), (24, 1));
    check(&platform(BASE, [[-1, 0, 0], [0, 1, 0], [0, 0, 1]], 1), (24, 1));
    check(&platform(BASE, [[2, 1, 2], [1, 2, -2], [-2, 2, 1]], 3), (12, 2));
}

#[test]
fn plane_plates_have_16_poses() {
    let flat = BASE.map(|[x, y, _]| [x, y, x - 2 * y]);
    check(&platform(flat, [[2, 1, -1], [0, 3, 1], [1, -2, 5]], 3), (8, 2));
    check(&platform(flat, [[3, 0, 0], [0, 3, 0], [0, 0, 3]], 2), (8, 2));
}

#[test]
fn general_plates_are_in_no_relation() {
    let mut platform = platform(BASE, [[2, 1, -1], [0, 3, 1], [1, -2, 5]], 3);
    platform.plate[5][1] += 1;
    assert!(AffineRelation::of(&platform).is_none());
}
