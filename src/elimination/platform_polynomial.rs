//! The polynomial whose roots are the poses of a platform: exact, with integer coefficients.
//!
//! In the quotient algebra of the equations modulo a prime, multiplication by a quotient of two coordinates of the rotation
//! is a matrix; its characteristic polynomial is the image of the one over the rationals. Enough primes give that.

use super::border::{Arithmetic, BorderBasis, DIMENSION};
use super::characteristic::characteristic_polynomial;
use super::platform_degree::{general_products, modular_setting, regular_part, row_times, special_products};
use super::platform_height::PlatformHeight;
use crate::algebra::modp::{Modulus, primes};
use crate::algebra::ring::Ring;
use crate::closure::study::{LinearLegs, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use num_complex::Complex;
use rayon::prelude::*;
use rug::{Integer, Rational};

/// The closure polynomial of a platform with given legs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlatformPolynomial {
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Vec<Integer>,
    /// What its variable is.
    pub coordinate: Coordinate,
    /// How many primes agree with it in all coefficients.
    pub primes: usize,
    /// Whether it is proved that its roots are those of all isolated poses, with multiplicity: the product of the primes
    /// exceeds what [`PlatformHeight`] leaves open. If not, a wrong coefficient differs from the right one by a fraction of
    /// fewer than 2^20 bits, whose numerator fewer than 2^15 of the more than 2^55 primes of 62 bits divide; the
    /// probability of error is below 2^-40, if the last prime is as good as drawn.
    pub proved: bool,
}

/// A quotient of coordinates of a rotation x, `weights.(z_1, z_2, z_3) / z_0` with `x = turn z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// A quaternion (w, x, y, z) that turns the base by a multiple of a right angle or a third of a turn.
    pub turn: [i32; 4],
    /// The weights.
    pub weights: [i32; 3],
}

/// What is tried in turn: the coordinates themselves where no solution has `x_0 = 0` and no two share the quotient.
const COORDINATES: [Coordinate; 6] = [
    Coordinate { turn: [1, 0, 0, 0], weights: [1, 0, 0] },
    Coordinate { turn: [1, 0, 0, 0], weights: [0, 1, 0] },
    Coordinate { turn: [1, 0, 0, 0], weights: [1, -2, 3] },
    Coordinate { turn: [1, 1, 0, 0], weights: [0, 1, 0] },
    Coordinate { turn: [1, 1, 1, 1], weights: [1, -2, 3] },
    Coordinate { turn: [2, 1, -3, 1], weights: [1, -2, 3] },
];

impl Coordinate {
    /// The value of the coordinate at a rotation, a quaternion (w, x, y, z) of any length.
    #[must_use]
    pub fn at(&self, x: &[Complex<f64>; 4]) -> Complex<f64> {
        let [w, i, j, k] = *x;
        let [above, below] = self.fraction(&Quaternion { scalar: w, vector: [i, j, k] });
        above / below
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
    legs: &'a LinearLegs<Rational>,
    squares: &'a [Rational; 6],
    weights: [i32; 3],
    /// Whether the general border basis does not exist.
    special: bool,
    /// Whether no solution has `N = 0`, as is known from the first prime.
    all_regular: bool,
}

impl Modular<'_> {
    /// The monic polynomial modulo a prime, its degree the number of poses; `None` for an unlucky prime or coordinate.
    fn polynomial(&self, modulus: &Modulus, memory: &mut BorderBasis<u64>) -> Option<Vec<u64>> {
        let setting = modular_setting(modulus, self.legs, self.squares)?;
        let products = if self.special {
            special_products(modulus, &setting)?
        } else {
            general_products(modulus, &setting, memory)?
        };
        let regular = (!self.all_regular).then(|| regular_part(modulus, &products));
        let weights = self.weights.map(|w| modulus.reduce(&Integer::from(w)));
        let [mut matrix, rest @ ..] = products;
        for (k, row) in matrix.iter_mut().enumerate() {
            for x in row.iter_mut() {
                *x = Modulus::mul(modulus, *x, weights[0]);
            }
            for (other, &w) in rest.iter().zip(&weights[1..]) {
                modulus.add_multiple(row, w, &other[k]);
            }
        }
        if let Some(regular) = regular
            && regular.pivots.len() < matrix.len()
        {
            let image = |v: &Vec<u64>| {
                let product = row_times(modulus, v, &matrix);
                regular.pivots.iter().map(|&p| product[p]).collect()
            };
            matrix = regular.basis.iter().map(image).collect();
        }
        Some(characteristic_polynomial(modulus, &mut matrix))
    }
}

/// Whether a monic polynomial modulo a prime has only simple roots.
fn is_square_free(modulus: &Modulus, polynomial: &[u64]) -> bool {
    let mut a = polynomial.to_vec();
    let mut b: Vec<u64> = (1..a.len()).map(|k| Modulus::mul(modulus, a[k], modulus.enter(k as u64))).collect();
    loop {
        while b.last() == Some(&0) {
            b.pop();
        }
        if b.len() < 2 {
            return !b.is_empty();
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
/// More primes than any file of 15 digits asks for.
const MOST_PRIMES: usize = 4000;

/// The polynomial of a platform with legs of these squared lengths; its degree is the number of poses. `None` where there
/// is no pose, infinitely many of them, or several coincide or share their rotation.
#[must_use]
pub fn platform_polynomial(platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> Option<PlatformPolynomial> {
    polynomial_in(&COORDINATES, platform, legs_squared, is_square_free)
}

/// The polynomial in a general coordinate, whatever the multiplicities of its roots: those of the poses, for poses of one
/// rotation together. `None` where there is no pose, or infinitely many of them.
#[must_use]
pub fn multiple_platform_polynomial(
    platform: &Platform<Rational>,
    legs_squared: &[Rational; 6],
) -> Option<PlatformPolynomial> {
    polynomial_in(&COORDINATES[COORDINATES.len() - 1..], platform, legs_squared, |_, _| true)
}

/// The polynomial in the first coordinate whose polynomial modulo a prime is accepted.
fn polynomial_in(
    coordinates: &[Coordinate],
    platform: &Platform<Rational>,
    legs_squared: &[Rational; 6],
    accepts: impl Fn(&Modulus, &[u64]) -> bool,
) -> Option<PlatformPolynomial> {
    let modulus = primes().next()?;
    let mut memory = BorderBasis::new(&modulus);
    let mut in_general = false;
    for special in [false, true] {
        for coordinate in coordinates {
            let legs = &linear_legs(&coordinate.turned(platform));
            let weights = coordinate.weights;
            let mut modular = Modular { legs, squares: legs_squared, weights, special, all_regular: false };
            let Some(first) = modular.polynomial(&modulus, &mut memory) else { continue };
            in_general |= !special;
            modular.all_regular = !special && first.len() == DIMENSION + 1;
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

/// Residues of the monic polynomial for one prime after the other, put together.
fn lifted(modular: &Modular, coordinate: Coordinate, length: usize) -> Option<PlatformPolynomial> {
    let proof = Proof::new(modular, length);
    let mut all = primes();
    let mut combined = Combined { residues: vec![Integer::new(); length], product: Integer::from(1) };
    // Images that are not combined yet, because the guess agrees with them.
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
        // As few primes as will do: the length of the numbers goes into the time more than once.
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
            return Some(PlatformPolynomial { coefficients, coordinate, primes: used, proved: proof.bits.is_some() });
        }
    }
    guess.map(|coefficients| PlatformPolynomial { coefficients, coordinate, primes: used, proved: false })
}

/// The images of the polynomial modulo primes, in their order, without those of unlucky ones.
fn images(modular: &Modular, group: &[Modulus], length: usize) -> Vec<(Modulus, Vec<u64>)> {
    let memory = || BorderBasis::new(&group[0]);
    let image = |memory: &mut BorderBasis<u64>, modulus: &Modulus| {
        modular.polynomial(modulus, memory).filter(|p| p.len() == length).map(|p| (*modulus, p))
    };
    let found: Vec<Option<(Modulus, Vec<u64>)>> = group.par_iter().map_init(memory, image).collect();
    found.into_iter().flatten().collect()
}

/// How many primes make a proof.
struct Proof {
    /// Bits that the product of the primes must have beyond those of the polynomial; `None` where nothing is proved.
    bits: Option<f64>,
    /// Bits that it must have in any case.
    least: f64,
}

/// Less than the bits of every prime used.
const PRIME_BITS: f64 = 61.999;

impl Proof {
    fn new(modular: &Modular, length: usize) -> Self {
        if modular.special {
            return Self { bits: None, least: 0.0 };
        }
        let height = PlatformHeight::new(modular.legs, modular.squares);
        // Two products of a coefficient of the one polynomial and one of the other, which is its measure times a binomial
        // coefficient at most.
        let bits = height.measure(&modular.weights) + length as f64 + 1.0;
        // Where some of the 40 solutions have N = 0, not all primes may have one more of these.
        Self { bits: Some(bits), least: if length == DIMENSION + 1 { 0.0 } else { height.norm() } }
    }

    /// How many more primes are worth a try.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count, of thousands at most")]
    fn missing(&self, guess: Option<&[Integer]>, used: usize) -> usize {
        let longest = guess.and_then(|polynomial| polynomial.iter().map(Integer::significant_bits).max());
        match (self.bits, longest) {
            (None, None) => GROUP,
            (None, Some(_)) => 0,
            (Some(bits), longest) => {
                let wanted = f64::max(bits + f64::from(longest.unwrap_or(0)), self.least);
                let missing = (wanted / PRIME_BITS).ceil() as usize;
                let missing = missing.saturating_sub(used);
                if longest.is_none() { missing.max(GROUP) } else { missing }
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
struct Combined {
    residues: Vec<Integer>,
    product: Integer,
}

impl Combined {
    /// Takes one more prime in.
    fn add(&mut self, modulus: &Modulus, image: &[u64]) {
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
    fn primitive(&self) -> Option<Vec<Integer>> {
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
