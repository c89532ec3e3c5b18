//! The mean rotation of the poses at each root of a factor of a platform's polynomial.

use crate::algebra::modp::{Modulus, primes};
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::border::Arithmetic;
use crate::elimination::platform_degree::{echelon, inverse, row_times};
use crate::elimination::platform_polynomial::{Combined, Coordinate, PlatformAlgebra, PlatformPolynomial};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use rug::{Integer, Rational};
use std::sync::Arc;

/// More primes than a rotation of a thousand digits needs.
const MOST_PRIMES: usize = 120;

type Matrix = Vec<Vec<u64>>;

/// The quotients `z_i / z_0`, i = 1..3, of a rotation as polynomials in the variable of the platform's polynomial.
#[derive(Clone, Debug)]
pub struct Rotation {
    quotients: [Vec<Rational>; 3],
    coordinate: Coordinate,
}

impl Rotation {
    /// Returns the rotation x over the field of the variable; `None` where the variable disagrees with the polynomial.
    pub fn over(&self, field: &Arc<NumberField>) -> Option<Quaternion<Algebraic>> {
        let root = field.root();
        let value = |coefficients: &Vec<Rational>| {
            coefficients
                .iter()
                .rev()
                .try_fold(Algebraic::zero(), |sum, c| Some(sum.mul(&root).add(&<Algebraic as Ring>::from_rational(c)?)))
        };
        let [a, b, c] = self.quotients.each_ref().map(value);
        let z = Quaternion { scalar: Algebraic::one(), vector: [a?, b?, c?] };
        let [w, i, j, k] = self.coordinate.turn.map(Algebraic::from_integer);
        let x = Quaternion { scalar: w, vector: [i, j, k] }.mul(&z);
        let [above, below] = self.coordinate.fraction(&x);
        (above == below.mul(&root)).then_some(x)
    }
}

/// Returns the mean rotations at the roots of a factor of this multiplicity; they are certain only once they satisfy the
/// equations.
pub fn rotation(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    polynomial: &PlatformPolynomial,
    factor: &Univariate<Integer>,
    multiplicity: usize,
) -> Option<Rotation> {
    let degree = factor.degree()?;
    let algebra = PlatformAlgebra::new(platform, squares, polynomial);
    let multiplicity = multiplicity / algebra.positions();
    let mut combined = Combined::new(3 * degree + 1);
    let mut before = None;
    for modulus in primes().take(MOST_PRIMES) {
        let Some(mut image) = image(&modulus, &algebra, factor, multiplicity) else { continue };
        // The last number is the denominator of all others.
        image.push(modulus.one());
        combined.add(&modulus, &image);
        let guess = combined.primitive();
        if guess.is_some() && guess == before {
            break;
        }
        before = guess;
    }
    let numbers = before?;
    let (denominator, numerators) = numbers.split_last()?;
    let mut parts = numerators
        .chunks_exact(degree)
        .map(|part| part.iter().map(|n| Rational::from((n.clone(), denominator.clone()))).collect::<Vec<_>>());
    let quotients = [parts.next()?, parts.next()?, parts.next()?];
    Some(Rotation { quotients, coordinate: polynomial.coordinate })
}

/// Returns the coefficients of the three quotients modulo a prime, concatenated.
fn image(
    modulus: &Modulus,
    algebra: &PlatformAlgebra,
    factor: &Univariate<Integer>,
    multiplicity: usize,
) -> Option<Vec<u64>> {
    let products = algebra.products(modulus)?;
    let degree = factor.degree()?;
    let variable = algebra.variable(modulus, &products);
    let value = power(modulus, polynomial_at(modulus, factor, &variable), multiplicity);
    let mut part = left_kernel(modulus, &value)?;
    let pivots = echelon(modulus, |x| inverse(modulus, x), &mut part)?;
    if part.len() != degree * multiplicity {
        return None;
    }
    let restricted = |matrix: &Matrix| -> Matrix {
        part.iter()
            .map(|v| {
                let product = row_times(modulus, v, matrix);
                pivots.iter().map(|&p| product[p]).collect()
            })
            .collect()
    };
    let [one, two, three] = products.each_ref().map(restricted);
    let variable = restricted(&variable);
    // sum_j c_j tr(k^(j+l)) = tr(z k^l), l = 0 .. degree - 1.
    let mut powers: Vec<Matrix> = vec![identity(modulus, part.len())];
    for l in 1..2 * degree - 1 {
        powers.push(times(modulus, &powers[l - 1], &variable));
    }
    let sums: Vec<u64> = powers.iter().map(|power| trace(modulus, power)).collect();
    let mut rows: Matrix = (0..degree)
        .map(|l| {
            let traces = [&one, &two, &three].map(|z| trace(modulus, &times(modulus, z, &powers[l])));
            sums[l..l + degree].iter().copied().chain(traces).collect()
        })
        .collect();
    let found = echelon(modulus, |x| inverse(modulus, x), &mut rows)?;
    let solved = found.iter().copied().eq(0..degree);
    solved.then(|| (0..3).flat_map(|i| rows.iter().map(move |row| row[degree + i]).collect::<Vec<_>>()).collect())
}

fn identity(modulus: &Modulus, n: usize) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| if i == j { modulus.one() } else { 0 }).collect()).collect()
}

fn times(modulus: &Modulus, a: &Matrix, b: &Matrix) -> Matrix {
    a.iter().map(|row| row_times(modulus, row, b)).collect()
}

fn trace(modulus: &Modulus, matrix: &Matrix) -> u64 {
    matrix.iter().enumerate().fold(0, |sum, (i, row)| Modulus::add(modulus, sum, row[i]))
}

/// Returns a power of a matrix whose exponent is at least `exponent`.
fn power(modulus: &Modulus, mut matrix: Matrix, exponent: usize) -> Matrix {
    let mut reached = 1;
    while reached < exponent {
        matrix = times(modulus, &matrix, &matrix);
        reached *= 2;
    }
    matrix
}

/// The value of a polynomial at a matrix, by Horner's rule.
fn polynomial_at(modulus: &Modulus, polynomial: &Univariate<Integer>, matrix: &Matrix) -> Matrix {
    let n = matrix.len();
    let mut value = vec![vec![0; n]; n];
    for c in polynomial.coefficients().iter().rev() {
        value = times(modulus, &value, matrix);
        let c = modulus.reduce(c);
        for (i, row) in value.iter_mut().enumerate() {
            row[i] = Modulus::add(modulus, row[i], c);
        }
    }
    value
}

/// A basis of the row vectors v with `v matrix = 0`.
fn left_kernel(modulus: &Modulus, matrix: &Matrix) -> Option<Matrix> {
    let n = matrix.len();
    let unit = identity(modulus, n);
    let mut rows: Matrix = matrix.iter().zip(unit).map(|(row, unit)| [row.clone(), unit].concat()).collect();
    let pivots = echelon(modulus, |x| inverse(modulus, x), &mut rows)?;
    let kernel = rows.iter().zip(&pivots).filter(|(_, pivot)| **pivot >= n).map(|(row, _)| row[n..].to_vec());
    Some(kernel.collect())
}
