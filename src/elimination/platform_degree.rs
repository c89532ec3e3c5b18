//! How many poses a platform has, complex ones included: exactly, modulo a prime.
//!
//! The equations of the general platform have 40 solutions with `N = x.x != 0`. In special geometry some of them, or
//! whole curves, have `N = 0` and are no poses: they are the eigenvalue 0 of multiplication by N.

use super::border::{Arithmetic, BorderBasis, DIMENSION, Directions, Setting, exact_directions};
use super::characteristic::characteristic_polynomial;
use super::graded_quotient::GradedQuotient;
use crate::algebra::modp::{Modulus, primes};
use crate::closure::study::{Form, LinearLegs, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// The number of poses of a platform with given legs, with multiplicity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlatformDegree {
    /// Finitely many.
    Finite {
        /// Poses, with multiplicity.
        poses: usize,
        /// What of the 40 solutions of the general platform is no pose here (`N = 0`).
        null: usize,
        /// Whether solutions with `N = 0` form curves, so that the general border basis does not exist.
        curves: bool,
    },
    /// A curve of poses, or more: a self-motion, real or complex.
    Infinite,
}

/// Quaternions that turn base and plate, so that no solution lies where a chart ends.
const TURNS: [[[i32; 4]; 2]; 2] = [[[5, -3, 7, 4], [4, 6, -3, 5]], [[-3, 8, 2, 9], [7, -2, 5, -6]]];

/// The legs' equations modulo a prime: K solved, and what the border basis starts from; `None` where a denominator
/// vanishes or the rank of K is below 3.
#[must_use]
pub fn modular_setting(
    modulus: &Modulus,
    legs: &LinearLegs<Rational>,
    squares: &[Rational; 6],
) -> Option<(Directions<u64>, Setting<u64>)> {
    let image = |q: &Rational| -> Option<u64> {
        let denominator = modulus.reduce(q.denom());
        (denominator != 0).then(|| Modulus::mul(modulus, modulus.reduce(q.numer()), modulus.inverse(denominator)))
    };
    let mut matrix = [[0; 7]; 6];
    let mut forms: [Form<u64>; 6] = [[[0; 4]; 4]; 6];
    for i in 0..6 {
        for k in 0..7 {
            matrix[i][k] = image(&legs.matrix[i][k])?;
        }
        let square = image(&squares[i])?;
        for j in 0..4 {
            for k in 0..4 {
                forms[i][j][k] = image(&legs.forms[i][j][k])?;
            }
            forms[i][j][j] = Modulus::add(modulus, forms[i][j][j], square);
        }
    }
    let inverse = |x: u64| (x != 0).then(|| modulus.inverse(x));
    let directions = exact_directions(modulus, inverse, &matrix)?;
    let setting = Setting::new(modulus, &directions, &forms);
    Some((directions, setting))
}

/// A platform with its base and plate turned by rotations that are no multiples of a right angle, exactly.
fn turned(platform: &Platform<Rational>, choice: usize) -> Platform<Rational> {
    let turn = |points: &[[Rational; 3]; 6], q: [i32; 4]| {
        let [w, x, y, z] = q.map(Rational::from);
        let q = Quaternion { scalar: w, vector: [x, y, z] };
        let norm = q.norm();
        let rotation = q.scaled_rotation();
        points.each_ref().map(|p| {
            std::array::from_fn(|i| {
                let sum: Rational = (0..3).map(|k| Rational::from(&rotation[i][k] * &p[k])).sum();
                sum / &norm
            })
        })
    };
    let [before, behind] = TURNS[choice];
    Platform { base: turn(&platform.base, before), plate: turn(&platform.plate, behind) }
}

/// Counts the poses of a platform with legs of these squared lengths, modulo a prime of 62 bits. `None` where the prime
/// is unlucky or the points are too special (all on two lines, or all in one point).
#[must_use]
pub fn platform_degree(platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> Option<PlatformDegree> {
    let modulus = primes().next()?;
    let mut last = None;
    for choice in 0..TURNS.len() {
        let legs = linear_legs(&turned(platform, choice));
        let (directions, setting) = modular_setting(&modulus, &legs, legs_squared)?;
        if directions.count <= 3 {
            let mut basis = BorderBasis::new(&modulus);
            if basis.build(&modulus, &setting).is_ok() {
                let null = null_multiplicity(&modulus, &basis.products.each_ref().map(|m| rows(m)));
                return Some(PlatformDegree::Finite { poses: DIMENSION - null, null, curves: false });
            }
        }
        last = Some(setting);
    }
    count_with_curves(&modulus, &last?)
}

fn rows(matrix: &[[u64; DIMENSION]]) -> Vec<Vec<u64>> {
    matrix.iter().map(|row| row.to_vec()).collect()
}

/// The multiplicity of the eigenvalue 0 of `N = 1 + M_1^2 + M_2^2 + M_3^2`.
fn null_multiplicity(modulus: &Modulus, factors: &[Vec<Vec<u64>>; 3]) -> usize {
    let n = factors[0].len();
    let mut norm = vec![vec![0; n]; n];
    for (i, row) in norm.iter_mut().enumerate() {
        row[i] = modulus.one();
        for factor in factors {
            for (k, &c) in factor[i].iter().enumerate() {
                modulus.add_multiple(row, c, &factor[k]);
            }
        }
    }
    let polynomial = characteristic_polynomial(modulus, &mut norm);
    polynomial.iter().take_while(|&&c| c == 0).count()
}

/// Powers of N that kill what has `N = 0`, degrees at which the rest has settled, in turn.
const ATTEMPTS: [(usize, usize); 3] = [(1, 5), (2, 5), (2, 7)];

/// The count where solutions with `N = 0` form curves: the image of multiplication by a power of N has lost them.
fn count_with_curves(modulus: &Modulus, setting: &Setting<u64>) -> Option<PlatformDegree> {
    let mut ring = GradedQuotient::new(modulus, setting);
    let mut known = 0;
    for (power, degree) in ATTEMPTS {
        while known < degree + 1 + 2 * power {
            ring.advance();
            known += 1;
        }
        // N^power z_i m for every basis element m of the degree.
        let images: [Vec<Vec<u64>>; 4] = std::array::from_fn(|index| {
            (0..ring.dimension(degree))
                .map(|k| {
                    let mut v = vec![0; ring.dimension(degree)];
                    v[k] = modulus.one();
                    let mut v = ring.times(degree, index, &v);
                    for step in 0..power {
                        v = ring.times_norm(degree + 1 + 2 * step, &v);
                    }
                    v
                })
                .collect()
        });
        if let Some(factors) = quotients(modulus, &images) {
            let dimension = factors[0].len();
            let null = if dimension == 0 { 0 } else { null_multiplicity(modulus, &factors) };
            let poses = dimension - null;
            return Some(PlatformDegree::Finite { poses, null: DIMENSION.saturating_sub(poses), curves: true });
        }
    }
    Some(PlatformDegree::Infinite)
}

/// The matrices of `z_i / z_0`, i = 1..3, on the span of the images of z_0; `None` where the others reach farther.
fn quotients(modulus: &Modulus, images: &[Vec<Vec<u64>>; 4]) -> Option<[Vec<Vec<u64>>; 3]> {
    // Rows (z_0 image | z_1 image | z_2 image | z_3 image), reduced by their first parts.
    let width = images[0].first().map_or(0, Vec::len);
    let mut table: Vec<Vec<u64>> =
        (0..images[0].len()).map(|k| images.iter().flat_map(|image| image[k].iter().copied()).collect()).collect();
    let mut pivots = Vec::new();
    for column in 0..width {
        let rank = pivots.len();
        let Some(best) = (rank..table.len()).find(|&i| table[i][column] != 0) else { continue };
        table.swap(best, rank);
        let inverse = modulus.inverse(table[rank][column]);
        for x in &mut table[rank] {
            *x = Modulus::mul(modulus, *x, inverse);
        }
        let pivot_row = table[rank].clone();
        for (i, row) in table.iter_mut().enumerate() {
            if i != rank {
                let factor = modulus.neg(row[column]);
                modulus.add_multiple(row, factor, &pivot_row);
            }
        }
        pivots.push(column);
    }
    let rank = pivots.len();
    if table[rank..].iter().any(|row| row.iter().any(|&x| x != 0)) {
        return None;
    }
    let mut factors: [Vec<Vec<u64>>; 3] = std::array::from_fn(|_| vec![vec![0; rank]; rank]);
    for (i, factor) in factors.iter_mut().enumerate() {
        for k in 0..rank {
            let image = table[k][(i + 1) * width..(i + 2) * width].to_vec();
            let mut rest = image.clone();
            for (j, &column) in pivots.iter().enumerate() {
                factor[k][j] = image[column];
                modulus.add_multiple(&mut rest, modulus.neg(image[column]), &table[j][..width]);
            }
            if rest.iter().any(|&x| x != 0) {
                return None;
            }
        }
    }
    Some(factors)
}
