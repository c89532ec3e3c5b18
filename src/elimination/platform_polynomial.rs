//! The polynomial whose roots are the poses of a platform: exact, with integer coefficients.
//!
//! In the quotient algebra of the equations modulo a prime, multiplication by a quotient of two coordinates of the rotation is a
//! matrix; its characteristic polynomial is the image of the polynomial over the rationals. Enough primes determine that one.

use super::affine_platform::AffinePlatform;
use super::border::{Arithmetic, BorderBasis, DIMENSION, Residues, SIDE, SideBySide};
use super::characteristic::characteristic_polynomial;
use super::platform_degree::{
    Products, general_products, inverse, modular_setting, regular_part, residue, row_times, setting_side_by_side,
    special_products,
};
use super::platform_height::PlatformHeight;
use crate::algebra::drawn;
use crate::algebra::modp::{Modulus, primes};
use crate::algebra::modular::primes::{PRIME_BITS, largest_primes};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::closure::study::{LinearLegs, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use num_complex::Complex;
use rayon::prelude::*;
use rug::{Integer, Rational};
use std::cell::Cell;

/// The closure polynomial of a platform with given legs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlatformPolynomial {
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Vec<Integer>,
    /// The meaning of its variable.
    pub coordinate: Coordinate,
    /// The algebra it was computed in.
    pub quotient: Quotient,
    /// The number of primes that agree with it in all coefficients.
    pub primes: usize,
    /// Whether it is proved that its roots are those of all isolated poses, with multiplicity: the product of the primes
    /// exceeds what [`PlatformHeight`] leaves open. If not, a wrong coefficient differs from the right one by a fraction of
    /// fewer than 2^20 bits, whose numerator fewer than 2^15 of the more than 2^55 primes of 62 bits divide; the
    /// probability of error is below 2^-40, if the last prime is as good as drawn.
    pub proved: bool,
}

/// The quotient algebra of the poses of a platform, or of their rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quotient {
    /// The border basis of general platforms.
    General,
    /// The graded ring: solutions with `N = 0` form curves.
    Graded,
    /// The algebra of the rotations, where base and plate are affine images of the same points.
    Affine,
}

/// A quotient of coordinates of a rotation x, `weights.(z_1, z_2, z_3) / z_0` with `x = turn z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// A quaternion (w, x, y, z) that turns the base by a multiple of a right angle or a third of a turn.
    pub turn: [i32; 4],
    /// The weights.
    pub weights: [i32; 3],
}

/// Coordinates in the order tried; the first ones suffice where no solution has `x_0 = 0` and no two share the quotient.
const COORDINATES: [Coordinate; 7] = [
    Coordinate { turn: [1, 0, 0, 0], weights: [1, 0, 0] },
    Coordinate { turn: [1, 0, 0, 0], weights: [0, 1, 0] },
    Coordinate { turn: [1, 0, 0, 0], weights: [1, -2, 3] },
    Coordinate { turn: [1, 1, 0, 0], weights: [0, 1, 0] },
    Coordinate { turn: [1, 1, 1, 1], weights: [1, -2, 3] },
    Coordinate { turn: [2, 1, -3, 1], weights: [1, -2, 3] },
    // Poses that were chosen with small integers do not end this chart.
    Coordinate { turn: [23, 7, -11, 17], weights: [1, -2, 3] },
];

impl Coordinate {
    /// The value of the coordinate at a rotation, a quaternion (w, x, y, z) of any length.
    #[must_use]
    pub fn at(&self, x: &[Complex<f64>; 4]) -> Complex<f64> {
        let [above, below] = self.parts(x);
        above / below
    }

    /// Numerator and denominator of the coordinate at a rotation of any length.
    #[must_use]
    pub fn parts(&self, x: &[Complex<f64>; 4]) -> [Complex<f64>; 2] {
        let [w, i, j, k] = *x;
        self.fraction(&Quaternion { scalar: w, vector: [i, j, k] })
    }

    /// The sums of the absolute values of coefficients of numerator and denominator as linear forms in the rotation.
    #[must_use]
    pub fn sizes(&self) -> [f64; 2] {
        let turn: f64 = self.turn.iter().map(|&c| f64::from(c).abs()).sum();
        let weights: f64 = self.weights.iter().map(|&w| f64::from(w).abs()).sum();
        [turn * weights, turn]
    }

    /// Numerator and denominator of the coordinate at a rotation of any length, over any ring.
    #[must_use]
    pub fn fraction<R: Ring>(&self, x: &Quaternion<R>) -> [R; 2] {
        let [w, i, j, k] = self.turn.map(R::from_integer);
        let z = Quaternion { scalar: w, vector: [i, j, k] }.conjugate().mul(x);
        let weighted = z.vector.iter().zip(self.weights);
        let above = weighted.fold(R::zero(), |sum, (z, w)| sum.add(&z.mul(&R::from_integer(w))));
        [above, z.scalar]
    }

    /// The platform with its base turned, `a -> turn^-1 a`.
    fn turned(&self, platform: &Platform<Rational>) -> Platform<Rational> {
        let [w, x, y, z] = self.turn.map(Rational::from);
        let q = Quaternion { scalar: w, vector: [x, y, z] }.conjugate();
        let (norm, rotation) = (q.norm(), q.scaled_rotation());
        let base = platform.base.each_ref().map(|a| {
            std::array::from_fn(|i| {
                let sum: Rational = (0..3).map(|k| Rational::from(&rotation[i][k] * &a[k])).sum();
                sum / &norm
            })
        });
        Platform { base, plate: platform.plate.clone() }
    }
}

/// One platform and one coordinate, for one prime after the other.
struct Modular<'a> {
    /// The legs with integer coefficients, and the multiples of their squared lengths.
    legs: &'a LinearLegs<Rational>,
    squares: &'a [Rational; 6],
    height: PlatformHeight,
    weights: [i32; 3],
    quotient: Quotient,
    /// The forms of rotations, where these have an algebra of their own.
    affine: Option<AffinePlatform>,
    /// Whether no solution has `N = 0`, as is known from the first prime.
    all_regular: bool,
}

impl Modular<'_> {
    /// The monic polynomial modulo a prime, its degree the number of poses; `None` for an unlucky prime or coordinate.
    fn polynomial(&self, modulus: &Modulus, memory: &mut BorderBasis<u64>) -> Option<Vec<u64>> {
        let products = if let Some(affine) = &self.affine {
            affine.products(modulus, |x| inverse(modulus, x), |q| residue(modulus, q))?
        } else {
            let setting = modular_setting(modulus, self.legs, self.squares)?;
            match self.quotient {
                Quotient::General => general_products(modulus, &setting, memory)?,
                _ => special_products(modulus, |x| inverse(modulus, x), &setting)?,
            }
        };
        let weights = self.weights.map(|w| modulus.reduce(&Integer::from(w)));
        self.characteristic(modulus, |x| inverse(modulus, x), products, weights)
    }

    /// As [`Self::polynomial`] modulo several primes side by side; `None` where these differ in which numbers are 0.
    fn polynomials(&self, field: &SideBySide, memory: &mut BorderBasis<Residues>) -> Option<[Vec<u64>; SIDE]> {
        let moduli = field.moduli();
        let products = if let Some(affine) = &self.affine {
            let image = |q: &Rational| {
                let [a, b, c, d] = moduli.each_ref().map(|modulus| residue(modulus, q));
                Some(field.join([a?, b?, c?, d?]))
            };
            affine.products(field, |x| field.inverse(x), image)?
        } else {
            let setting = setting_side_by_side(field, self.legs, self.squares)?;
            match self.quotient {
                Quotient::General => general_products(field, &setting, memory)?,
                _ => special_products(field, |x| field.inverse(x), &setting)?,
            }
        };
        let weights = self.weights.map(|w| field.join(moduli.map(|m| m.reduce(&Integer::from(w)))));
        let joined = self.characteristic(field, |x| field.inverse(x), products, weights)?;
        Some(std::array::from_fn(|k| joined.iter().map(|c| field.part(c, k)).collect()))
    }

    /// Returns the characteristic polynomial of the coordinate on the part with N != 0.
    fn characteristic<A: Arithmetic>(
        &self,
        field: &A,
        inverse: impl Fn(A::Element) -> Option<A::Element>,
        products: Products<A::Element>,
        weights: [A::Element; 3],
    ) -> Option<Vec<A::Element>> {
        let regular = if self.all_regular { None } else { Some(regular_part(field, &inverse, &products)?) };
        let [mut matrix, rest @ ..] = products;
        for (k, row) in matrix.iter_mut().enumerate() {
            for x in row.iter_mut() {
                *x = field.mul(*x, weights[0]);
            }
            for (other, &w) in rest.iter().zip(&weights[1..]) {
                field.add_multiple(row, w, &other[k]);
            }
        }
        if let Some(regular) = regular
            && regular.pivots.len() < matrix.len()
        {
            let image = |v: &Vec<A::Element>| {
                let product = row_times(field, v, &matrix);
                regular.pivots.iter().map(|&p| product[p]).collect()
            };
            matrix = regular.basis.iter().map(image).collect();
        }
        characteristic_polynomial(field, inverse, &mut matrix)
    }
}

/// The quotient algebra in which a polynomial was found.
pub(super) struct PlatformAlgebra {
    legs: LinearLegs<Rational>,
    squares: [Rational; 6],
    quotient: Quotient,
    affine: Option<AffinePlatform>,
    weights: [i32; 3],
}

impl PlatformAlgebra {
    /// The algebra of the polynomial of a platform.
    pub(super) fn new(platform: &Platform<Rational>, squares: &[Rational; 6], polynomial: &PlatformPolynomial) -> Self {
        let turned = polynomial.coordinate.turned(platform);
        let quotient = polynomial.quotient;
        let affine = (quotient == Quotient::Affine).then(|| AffinePlatform::new(&turned, squares)).flatten();
        let (mut legs, mut squares) = (linear_legs(&turned), squares.clone());
        clear(&mut legs, &mut squares);
        Self { legs, squares, quotient, affine, weights: polynomial.coordinate.weights }
    }

    /// Returns the number of poses that belong to every element of a basis.
    pub(super) fn positions(&self) -> usize {
        self.affine.as_ref().map_or(1, |affine| affine.counts().1)
    }

    /// Returns multiplication by `z_i / z_0`, i = 1..3, on the part with N != 0; `None` for an unlucky prime.
    pub(super) fn products(&self, modulus: &Modulus) -> Option<Products<u64>> {
        if let Some(affine) = &self.affine {
            return affine.products(modulus, |x| inverse(modulus, x), |q| residue(modulus, q));
        }
        let setting = modular_setting(modulus, &self.legs, &self.squares)?;
        let products = match self.quotient {
            Quotient::General => general_products(modulus, &setting, &mut BorderBasis::new(modulus))?,
            _ => special_products(modulus, |x| inverse(modulus, x), &setting)?,
        };
        let regular = regular_part(modulus, |x| inverse(modulus, x), &products)?;
        Some(products.each_ref().map(|matrix| {
            let image = |v: &Vec<u64>| {
                let product = row_times(modulus, v, matrix);
                regular.pivots.iter().map(|&p| product[p]).collect()
            };
            regular.basis.iter().map(image).collect()
        }))
    }

    /// Multiplication by the variable of the polynomial.
    pub(super) fn variable(&self, modulus: &Modulus, products: &Products<u64>) -> Vec<Vec<u64>> {
        let n = products[0].len();
        let mut sum = vec![vec![0; n]; n];
        for (matrix, weight) in products.iter().zip(self.weights) {
            let weight = modulus.reduce(&Integer::from(weight));
            for (row, other) in sum.iter_mut().zip(matrix) {
                modulus.add_multiple(row, weight, other);
            }
        }
        sum
    }
}

/// Whether a monic polynomial modulo a prime has only simple roots.
fn is_square_free(modulus: &Modulus, polynomial: &[u64]) -> bool {
    shared_roots(modulus, polynomial) == 1
}

/// The length of the greatest common divisor of a monic polynomial modulo a prime and its derivative: 1 where all roots are simple.
fn shared_roots(modulus: &Modulus, polynomial: &[u64]) -> usize {
    let mut a = polynomial.to_vec();
    let mut b: Vec<u64> = (1..a.len()).map(|k| Modulus::mul(modulus, a[k], modulus.enter(k as u64))).collect();
    loop {
        while b.last() == Some(&0) {
            b.pop();
        }
        if b.len() < 2 {
            return if b.is_empty() { a.len() } else { 1 };
        }
        let inverse = modulus.inverse(b[b.len() - 1]);
        while a.len() >= b.len() {
            let top = a[a.len() - 1];
            let factor = modulus.neg(Modulus::mul(modulus, top, inverse));
            let from = a.len() - b.len();
            modulus.add_multiple(&mut a[from..], factor, &b);
            a.pop();
        }
        std::mem::swap(&mut a, &mut b);
    }
}

/// Primes are taken in groups, so that all cores have one.
const GROUP: usize = 8;
/// More primes than any file of 15 digits needs.
const MOST_PRIMES: usize = 4000;

/// Returns the polynomial of a platform with legs of these squared lengths; its degree is the number of poses. `None` where there
/// is no pose, where there are infinitely many, or where several coincide or share their rotation.
#[must_use]
pub fn platform_polynomial(platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> Option<PlatformPolynomial> {
    polynomial_in(&COORDINATES, platform, legs_squared, is_square_free)
}

/// General coordinates. Each is constant on the rotations about one axis, which small integers happen to be; the last ones have other
/// numbers.
const GENERAL: [Coordinate; 4] = [
    COORDINATES[COORDINATES.len() - 2],
    COORDINATES[COORDINATES.len() - 1],
    Coordinate { turn: [31, -19, 13, 7], weights: [17, -23, 29] },
    Coordinate { turn: [-11, 37, 5, 23], weights: [19, 13, -31] },
];

/// Returns the polynomial in the general coordinate that has most values modulo a prime, whatever the multiplicities of its roots; the
/// multiplicity of a root is the sum over the poses that share its value. `None` where there is no pose, or infinitely many of them.
#[must_use]
pub fn multiple_platform_polynomial(
    platform: &Platform<Rational>,
    legs_squared: &[Rational; 6],
) -> Option<PlatformPolynomial> {
    let values = |coordinate: &Coordinate| {
        let values = Cell::new(0);
        let count = |modulus: &Modulus, image: &[u64]| {
            values.set(image.len() - shared_roots(modulus, image));
            false
        };
        // Refused after one prime.
        let _ = polynomial_in(&[*coordinate], platform, legs_squared, count);
        values.get()
    };
    // Of those with as many values the first one, whose numbers are short.
    let most = GENERAL.iter().rev().max_by_key(|coordinate| values(coordinate))?;
    polynomial_in(&[*most], platform, legs_squared, |_, _| true)
}

/// Returns whether some coordinate has different values at all poses of a platform with 40 poses, which are then simple. As it is
/// computed modulo a prime, the answer `false` is only a hint.
#[must_use]
pub fn are_simple(platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> bool {
    let modulus = Modulus::new(drawn::prime());
    let mut memory = BorderBasis::new(&modulus);
    COORDINATES.iter().any(|coordinate| {
        let (mut legs, mut squares) = (linear_legs(&coordinate.turned(platform)), legs_squared.clone());
        let height = PlatformHeight::new(&legs, &squares);
        clear(&mut legs, &mut squares);
        let (legs, squares, weights, quotient) = (&legs, &squares, coordinate.weights, Quotient::General);
        let modular = Modular { legs, squares, height, weights, quotient, affine: None, all_regular: true };
        let image = modular.polynomial(&modulus, &mut memory);
        image.is_some_and(|image| image.len() == DIMENSION + 1 && is_square_free(&modulus, &image))
    })
}

/// The polynomial in the first coordinate whose polynomial modulo a prime is accepted.
fn polynomial_in(
    coordinates: &[Coordinate],
    platform: &Platform<Rational>,
    legs_squared: &[Rational; 6],
    accepts: impl Fn(&Modulus, &[u64]) -> bool,
) -> Option<PlatformPolynomial> {
    let modulus = Modulus::new(drawn::prime());
    if let Some(found) = affine_polynomial(&modulus, coordinates, platform, legs_squared, &accepts) {
        return found;
    }
    let mut memory = BorderBasis::new(&modulus);
    let mut in_general = false;
    for quotient in [Quotient::General, Quotient::Graded] {
        for coordinate in coordinates {
            let (mut legs, mut squares) = (linear_legs(&coordinate.turned(platform)), legs_squared.clone());
            let height = PlatformHeight::new(&legs, &squares);
            clear(&mut legs, &mut squares);
            let (legs, squares, weights) = (&legs, &squares, coordinate.weights);
            let mut modular = Modular { legs, squares, height, weights, quotient, affine: None, all_regular: false };
            let Some(first) = modular.polynomial(&modulus, &mut memory) else { continue };
            in_general |= quotient == Quotient::General;
            modular.all_regular = in_general && first.len() == DIMENSION + 1;
            if first.len() > 1 && accepts(&modulus, &first) {
                return lifted(&modular, *coordinate, first.len());
            }
        }
        // Where the general border basis exists, the graded ring has no better polynomial.
        if in_general {
            break;
        }
    }
    None
}

/// The polynomial where base and plate are affine images of the same points; the outer `None` where they are not, or have
/// fewer poses than such platforms in general, the inner one where no coordinate is accepted.
#[expect(clippy::option_option, reason = "whether the way is gone, and what is found on it")]
fn affine_polynomial(
    modulus: &Modulus,
    coordinates: &[Coordinate],
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    accepts: &impl Fn(&Modulus, &[u64]) -> bool,
) -> Option<Option<PlatformPolynomial>> {
    let mut is_whole = false;
    for coordinate in coordinates {
        let turned = coordinate.turned(platform);
        let affine = AffinePlatform::new(&turned, squares)?;
        let (rotations, positions) = affine.counts();
        let Some(products) = affine.products_of_poses(modulus, |x| inverse(modulus, x), |q| residue(modulus, q)) else {
            continue;
        };
        is_whole = true;
        let legs = linear_legs(&turned);
        let height = PlatformHeight::new(&legs, squares);
        let (weights, quotient) = (coordinate.weights, Quotient::Affine);
        let modular =
            Modular { legs: &legs, squares, height, weights, quotient, affine: Some(affine), all_regular: true };
        let images = weights.map(|w| modulus.reduce(&Integer::from(w)));
        let first = modular.characteristic(modulus, |x| inverse(modulus, x), products, images);
        // Two positions per rotation make every root a double one.
        let image = first.map(|first| if positions == 1 { first } else { square(modulus, &first) });
        if image.is_some_and(|image| accepts(modulus, &image)) {
            let found = lifted(&modular, *coordinate, rotations + 1);
            return Some(found.map(|found| if positions == 1 { found } else { squared(found) }));
        }
    }
    is_whole.then_some(None)
}

/// The square of a polynomial modulo a prime.
fn square(modulus: &Modulus, polynomial: &[u64]) -> Vec<u64> {
    let mut square = vec![0; 2 * polynomial.len() - 1];
    for (k, &c) in polynomial.iter().enumerate() {
        modulus.add_multiple(&mut square[k..k + polynomial.len()], c, polynomial);
    }
    square
}

/// The polynomial of poses of which two belong to every rotation.
fn squared(found: PlatformPolynomial) -> PlatformPolynomial {
    let half = Univariate::new(found.coefficients);
    PlatformPolynomial { coefficients: half.mul(&half).coefficients().to_vec(), ..found }
}

/// Multiplies every leg by the common denominator of its coefficients: quotients are costly modulo a prime.
fn clear(legs: &mut LinearLegs<Rational>, squares: &mut [Rational; 6]) {
    for ((row, form), square) in legs.matrix.iter_mut().zip(&mut legs.forms).zip(squares) {
        let all = row.iter_mut().chain(form.iter_mut().flatten()).chain([square]);
        let all: Vec<&mut Rational> = all.collect();
        let common = all.iter().fold(Integer::from(1), |lcm, x| lcm.lcm(x.denom()));
        for x in all {
            *x *= &common;
        }
    }
}

/// Combines the residues of the monic polynomial for one prime after the other.
fn lifted(modular: &Modular, coordinate: Coordinate, length: usize) -> Option<PlatformPolynomial> {
    let (mut all, prime_bits) = prime_numbers();
    let proof = Proof::new(modular, length, prime_bits);
    let mut combined = Combined::new(length);
    // Images not combined yet, because the guess agrees with them.
    let mut spare: Vec<(Modulus, Vec<u64>)> = Vec::new();
    let mut guess: Option<Vec<Integer>> = None;
    let (mut taken, mut used) = (0, 0);
    while taken < MOST_PRIMES {
        let group = proof.missing(guess.as_deref(), used).clamp(1, MOST_PRIMES - taken);
        taken += group;
        let group: Vec<Modulus> = all.by_ref().take(group).collect();
        for (modulus, image) in images(modular, &group, length) {
            used += 1;
            if guess.as_ref().is_some_and(|polynomial| !agrees(&modulus, polynomial, &image)) {
                guess = None;
            }
            spare.push((modulus, image));
        }
        // As few primes as will do: the time grows faster than the length of the numbers.
        while guess.is_none() && spare.len() > 1 {
            let part = spare.len().div_ceil(4);
            for (modulus, image) in spare.drain(..part) {
                combined.add(&modulus, &image);
            }
            guess = combined.primitive().filter(|polynomial| spare.iter().all(|(m, i)| agrees(m, polynomial, i)));
        }
        if let Some(polynomial) = &guess
            && proof.missing(Some(polynomial), used) == 0
        {
            let coefficients = guess.take()?;
            let quotient = modular.quotient;
            let proved = proof.bits.is_some();
            return Some(PlatformPolynomial { coefficients, coordinate, quotient, primes: used, proved });
        }
    }
    let quotient = modular.quotient;
    guess.map(|coefficients| PlatformPolynomial { coefficients, coordinate, quotient, primes: used, proved: false })
}

/// Returns the primes to compute with, largest first, and a lower bound on the binary logarithm of each: short primes where four
/// are computed side by side.
fn prime_numbers() -> (Box<dyn Iterator<Item = Modulus>>, f64) {
    let short = || largest_primes().map(Modulus::new);
    let first: Vec<Modulus> = short().take(SIDE).collect();
    let fits = <[Modulus; SIDE]>::try_from(first).is_ok_and(|first| SideBySide::new(first).is_some());
    if fits { (Box::new(short()), f64::from(PRIME_BITS) - 0.001) } else { (Box::new(primes()), 61.999) }
}

/// Returns the images of the polynomial modulo primes, in their order, without those of unlucky ones.
fn images(modular: &Modular, group: &[Modulus], length: usize) -> Vec<(Modulus, Vec<u64>)> {
    let parts: Vec<&[Modulus]> = group.chunks(SIDE).collect();
    let memory = || (None, BorderBasis::new(&group[0]));
    let found: Vec<Vec<Option<Vec<u64>>>> = parts
        .par_iter()
        .map_init(memory, |(joined, single), moduli| {
            let field = <[Modulus; SIDE]>::try_from(*moduli).ok().and_then(SideBySide::new);
            let together = field
                .and_then(|field| modular.polynomials(&field, joined.get_or_insert_with(|| BorderBasis::new(&field))));
            match together {
                Some(images) => images.into_iter().map(Some).collect(),
                None => moduli.iter().map(|modulus| modular.polynomial(modulus, single)).collect(),
            }
        })
        .collect();
    let images = group.iter().copied().zip(found.into_iter().flatten());
    images.filter_map(|(modulus, image)| Some((modulus, image.filter(|p| p.len() == length)?))).collect()
}

/// Bits of a product of primes beyond which the graded ring proves nothing.
const MOST_SPECIAL_BITS: f64 = 8_000.0;

/// The number of primes that a proof needs.
struct Proof {
    /// Bits that the product of the primes must have beyond those of the polynomial; `None` where nothing is proved.
    bits: Option<f64>,
    /// Bits that it must have in any case.
    least: f64,
    /// Lower bound on the bits of every prime.
    prime_bits: f64,
}

impl Proof {
    fn new(modular: &Modular, length: usize, prime_bits: f64) -> Self {
        let height = &modular.height;
        // Two products of a coefficient of the one polynomial and one of the other, which is its measure times a binomial
        // coefficient at most.
        let bits = height.measure(&modular.weights) + length as f64 + 1.0;
        // Where some of the 40 solutions have N = 0, not all primes may have one more of these.
        // Where base and plate are affine images of the same points, the number of poses is that of all such platforms.
        let is_counted = match modular.quotient {
            Quotient::General => length == DIMENSION + 1,
            Quotient::Graded => false,
            Quotient::Affine => true,
        };
        let least = if is_counted { 0.0 } else { height.norm() };
        // The graded ring is slow.
        let within_reach = modular.quotient != Quotient::Graded || f64::max(bits, least) < MOST_SPECIAL_BITS;
        Self { bits: within_reach.then_some(bits), least, prime_bits }
    }

    /// Returns the number of further primes that are worth a try.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count, of thousands at most")]
    fn missing(&self, guess: Option<&[Integer]>, used: usize) -> usize {
        let longest = guess.and_then(|polynomial| polynomial.iter().map(Integer::significant_bits).max());
        match (self.bits, longest) {
            (None, None) => GROUP,
            (None, Some(_)) => 0,
            (Some(bits), longest) => {
                let wanted = f64::max(bits + f64::from(longest.unwrap_or(0)), self.least);
                let missing = ((wanted / self.prime_bits).ceil() as usize).saturating_sub(used);
                let missing = if longest.is_none() { missing.max(GROUP) } else { missing };
                missing.next_multiple_of(SIDE)
            }
        }
    }
}

/// Whether a polynomial with integer coefficients has the given monic image.
fn agrees(modulus: &Modulus, polynomial: &[Integer], image: &[u64]) -> bool {
    let Some(leading) = polynomial.last().map(|c| modulus.reduce(c)) else { return false };
    leading != 0 && polynomial.iter().zip(image).all(|(c, r)| modulus.reduce(c) == Modulus::mul(modulus, leading, *r))
}

/// Coefficients modulo the product of the primes so far.
pub(super) struct Combined {
    residues: Vec<Integer>,
    product: Integer,
}

impl Combined {
    /// A list of this many coefficients of which nothing is known.
    pub(super) fn new(length: usize) -> Self {
        Self { residues: vec![Integer::new(); length], product: Integer::from(1) }
    }

    /// Takes one more prime in.
    pub(super) fn add(&mut self, modulus: &Modulus, image: &[u64]) {
        let inverse = modulus.inverse(modulus.reduce(&self.product));
        for (residue, &value) in self.residues.iter_mut().zip(image) {
            let gap = Modulus::sub(modulus, value, modulus.reduce(residue));
            let digit = modulus.leave(Modulus::mul(modulus, gap, inverse));
            *residue += Integer::from(&self.product * digit);
        }
        self.product *= modulus.prime();
    }

    /// The coefficients as integers without common factor, if they fit with room for chance to be ruled out: the
    /// residues, in every prime, times their last one.
    pub(super) fn primitive(&self) -> Option<Vec<Integer>> {
        let bits = self.product.significant_bits();
        let mut denominator = Integer::from(1);
        // One denominator for all coefficients, which grows as it must: a wrong one leaves numerators of all the bits.
        for residue in self.residues.iter().rev() {
            let scaled = Integer::from(residue * &denominator) % &self.product;
            if symmetric(scaled.clone(), &self.product).significant_bits() + ROOM > bits {
                denominator *= denominator_of(scaled, &self.product)?;
            }
        }
        if Integer::from(denominator.gcd_ref(&self.product)) != 1 {
            return None;
        }
        let mut coefficients: Vec<Integer> = self
            .residues
            .iter()
            .map(|r| symmetric(Integer::from(r * &denominator) % &self.product, &self.product))
            .collect();
        let common = coefficients.iter().fold(Integer::new(), Integer::gcd);
        for c in &mut coefficients {
            c.div_exact_mut(&common);
        }
        Some(coefficients)
    }
}

/// Bits of slack that make agreement by chance unlikely.
const ROOM: u32 = 60;

/// The residue between minus half and half the modulus.
fn symmetric(residue: Integer, modulus: &Integer) -> Integer {
    if Integer::from(&residue * 2_u32) > *modulus { residue - modulus } else { residue }
}

/// The denominator of the fraction with small numerator and denominator that a residue stands for.
fn denominator_of(residue: Integer, modulus: &Integer) -> Option<Integer> {
    let half = modulus.significant_bits() / 2;
    let (mut a, mut b) = (modulus.clone(), residue);
    let (mut s, mut t) = (Integer::new(), Integer::from(1));
    while b.significant_bits() > half {
        let (quotient, remainder) = a.div_rem(b.clone());
        let next = s - quotient * &t;
        (a, b) = (b, remainder);
        (s, t) = (t, next);
    }
    let t = t.abs();
    (t.significant_bits() + b.significant_bits() + ROOM < modulus.significant_bits()).then_some(t)
}
