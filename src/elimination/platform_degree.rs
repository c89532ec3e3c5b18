//! The number of poses of a platform, complex ones included: exact, modulo a prime.
//!
//! The equations of the general platform have 40 solutions with `N = x.x != 0`. In special geometry some of them, or
//! whole curves, have `N = 0` and are no poses: they are the eigenvalue 0 of multiplication by N.

use super::affine_platform::AffinePlatform;
use super::border::{
    Arithmetic, BorderBasis, DIMENSION, MOST_DIRECTIONS, Residues, Setting, SideBySide, exact_directions,
};
use super::graded_quotient::GradedQuotient;
use crate::algebra::drawn;
use crate::algebra::modp::Modulus;
use crate::algebra::ring::Ring;
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
        /// The solutions, of the 40 of the general platform, that are no pose here (`N = 0`).
        null: usize,
        /// Whether solutions with `N = 0` form curves, so that the general border basis does not exist.
        curves: bool,
    },
    /// A curve of poses, or more: a self-motion, real or complex. It is recognised by a count that still grows with the degree at
    /// which it is taken, up to degree 10; in almost all known classes of special geometry a finite count is constant by then (not where five
    /// pairs of points are congruent).
    Infinite {
        /// The largest dimension of a family of poses, complex ones included: this many general quadrics leave finitely many of
        /// them.
        dimension: usize,
    },
}

/// The largest dimension of a family of poses: all rotations about a point.
const MOST_DIMENSION: usize = 3;

/// Quaternions that turn base and plate, so that no solution lies where a chart ends.
const TURNS: [[[i32; 4]; 2]; 2] = [[[5, -3, 7, 4], [4, 6, -3, 5]], [[-3, 8, 2, 9], [7, -2, 5, -6]]];

/// Returns the input of a platform's border basis modulo a prime; `None` where a denominator vanishes or the rank of K is below
/// 3.
#[must_use]
pub fn modular_setting(
    modulus: &Modulus,
    legs: &LinearLegs<Rational>,
    squares: &[Rational; 6],
) -> Option<Setting<u64>> {
    let (matrix, forms) = modular_legs(modulus, legs, squares)?;
    let directions = exact_directions(modulus, |x| inverse(modulus, x), &matrix)?;
    Some(Setting::new(modulus, &directions, &forms))
}

/// As [`modular_setting`] modulo several primes; `None` also where these differ in which numbers are 0.
#[must_use]
pub fn setting_side_by_side(
    field: &SideBySide,
    legs: &LinearLegs<Rational>,
    squares: &[Rational; 6],
) -> Option<Setting<Residues>> {
    let [a, b, c, d] = field.moduli().each_ref().map(|modulus| modular_legs(modulus, legs, squares));
    let parts = [a?, b?, c?, d?];
    let matrix = std::array::from_fn(|i| std::array::from_fn(|k| field.join(parts.each_ref().map(|p| p.0[i][k]))));
    let forms: [Form<Residues>; 6] = std::array::from_fn(|i| {
        std::array::from_fn(|j| std::array::from_fn(|k| field.join(parts.each_ref().map(|p| p.1[i][j][k]))))
    });
    let directions = exact_directions(field, |x| field.inverse(x), &matrix)?;
    Some(Setting::new(field, &directions, &forms))
}

/// The legs modulo a prime: K, and the quadratic forms.
type ModularLegs = ([[u64; 7]; 6], [Form<u64>; 6]);

fn modular_legs(modulus: &Modulus, legs: &LinearLegs<Rational>, squares: &[Rational; 6]) -> Option<ModularLegs> {
    let image = |q: &Rational| residue(modulus, q);
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
    Some((matrix, forms))
}

/// A rational number modulo a prime; `None` where its denominator vanishes.
#[must_use]
pub fn residue(modulus: &Modulus, q: &Rational) -> Option<u64> {
    if *q.denom() == 1 {
        return Some(modulus.reduce(q.numer()));
    }
    let denominator = modulus.reduce(q.denom());
    (denominator != 0).then(|| Modulus::mul(modulus, modulus.reduce(q.numer()), modulus.inverse(denominator)))
}

/// `1/x`, where there is one.
#[must_use]
pub fn inverse(modulus: &Modulus, x: u64) -> Option<u64> {
    (x != 0).then(|| modulus.inverse(x))
}

/// A platform with its base and plate turned by rotations that are no multiples of a right angle, exactly.
#[must_use]
pub fn turned(platform: &Platform<Rational>, choice: usize) -> Platform<Rational> {
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

/// The quaternions by which [`turned`] turns base and plate.
#[must_use]
pub fn turns<R: Ring>(choice: usize) -> [Quaternion<R>; 2] {
    TURNS[choice].map(|q| {
        let [w, x, y, z] = q.map(R::from_integer);
        Quaternion { scalar: w, vector: [x, y, z] }
    })
}

/// Counts the poses of a platform with legs of these squared lengths, modulo a prime of 62 bits that is drawn at run time. The
/// count is never too large, and is too small with a probability below [`drawn::PROBABILITY_OF_ERROR`]. `None` where the prime is
/// unlucky or the points are too special (all on two lines, or all in one point).
#[must_use]
pub fn platform_degree(platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> Option<PlatformDegree> {
    let modulus = Modulus::new(drawn::prime());
    if let Some(poses) = affine_degree(&modulus, platform, legs_squared) {
        return Some(PlatformDegree::Finite { poses, null: DIMENSION - poses, curves: true });
    }
    let mut settings = Vec::new();
    for choice in 0..TURNS.len() {
        let legs = linear_legs(&turned(platform, choice));
        let setting = modular_setting(&modulus, &legs, legs_squared)?;
        if let Some(products) = general_products(&modulus, &setting, &mut BorderBasis::new(&modulus)) {
            let null = DIMENSION - regular_part(&modulus, |x| inverse(&modulus, x), &products)?.pivots.len();
            return Some(PlatformDegree::Finite { poses: DIMENSION - null, null, curves: false });
        }
        settings.push(setting);
    }
    // A pose where one chart ends looks like a curve there: one chart without curves is enough.
    let Some(products) =
        settings.iter().find_map(|setting| special_products(&modulus, |x| inverse(&modulus, x), setting))
    else {
        let finite = |cuts: &usize| settings.iter().any(|setting| dimension_is(&modulus, setting, *cuts));
        let dimension = (1..MOST_DIMENSION).find(finite).unwrap_or(MOST_DIMENSION);
        return Some(PlatformDegree::Infinite { dimension });
    };
    let poses = regular_part(&modulus, |x| inverse(&modulus, x), &products)?.pivots.len();
    Some(PlatformDegree::Finite { poses, null: DIMENSION.saturating_sub(poses), curves: true })
}

/// Counts the poses where base and plate are affine images of the same points and have as many poses as such platforms can have.
fn affine_degree(modulus: &Modulus, platform: &Platform<Rational>, legs_squared: &[Rational; 6]) -> Option<usize> {
    let has_all = |choice: usize| {
        let platform = AffinePlatform::new(&turned(platform, choice), legs_squared)?;
        platform.products_of_poses(modulus, |x| inverse(modulus, x), |q| residue(modulus, q))?;
        let (rotations, positions) = platform.counts();
        Some(rotations * positions)
    };
    (0..TURNS.len()).find_map(has_all)
}

/// Multiplication by `z_1/z_0`, `z_2/z_0` and `z_3/z_0`: row k is the product with basis element k.
pub type Products<E> = [Vec<Vec<E>>; 3];

/// The multiplication matrices of the general border basis; `None` where that does not exist.
pub fn general_products<A: Arithmetic>(
    field: &A,
    setting: &Setting<A::Element>,
    basis: &mut BorderBasis<A::Element>,
) -> Option<Products<A::Element>> {
    if setting.count > MOST_DIRECTIONS {
        return None;
    }
    basis.build(field, setting).ok()?;
    Some(basis.products.each_ref().map(|matrix| matrix.iter().map(|row| row.to_vec()).collect()))
}

/// The part of a quotient algebra that powers of N leave.
pub struct RegularPart<E> {
    /// A basis, in reduced echelon form.
    pub basis: Vec<Vec<E>>,
    /// The columns of its pivots.
    pub pivots: Vec<usize>,
}

/// The part of an algebra on which `N = 1 + M_1^2 + M_2^2 + M_3^2` is invertible; `None` where `inverse` does not exist for a
/// number that is not 0.
#[must_use]
pub fn regular_part<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    products: &Products<A::Element>,
) -> Option<RegularPart<A::Element>> {
    let n = products[0].len();
    let norm: Vec<Vec<A::Element>> = (0..n)
        .map(|i| {
            let mut row = vec![field.zero(); n];
            row[i] = field.one();
            let terms = products.iter().flat_map(|matrix| matrix[i].iter().zip(matrix));
            field.add_combination(&mut row, terms.map(|(&c, other)| (c, other.as_slice())));
            row
        })
        .collect();
    let mut basis = norm.clone();
    let mut pivots = echelon(field, &inverse, &mut basis)?;
    let mut settled = pivots.len() == n;
    while !settled {
        let mut next: Vec<Vec<A::Element>> = basis.iter().map(|v| row_times(field, v, &norm)).collect();
        let found = echelon(field, &inverse, &mut next)?;
        settled = found.len() == pivots.len();
        (basis, pivots) = (next, found);
    }
    Some(RegularPart { basis, pivots })
}

/// `v matrix`
#[must_use]
pub fn row_times<A: Arithmetic>(field: &A, v: &[A::Element], matrix: &[Vec<A::Element>]) -> Vec<A::Element> {
    let mut product = vec![field.zero(); matrix.first().map_or(0, Vec::len)];
    field.add_combination(&mut product, v.iter().zip(matrix).map(|(&c, row)| (c, row.as_slice())));
    product
}

/// Reduces rows to echelon form, drops rows of zeros and returns the columns of the pivots.
pub(super) fn echelon<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    rows: &mut Vec<Vec<A::Element>>,
) -> Option<Vec<usize>> {
    let zero = field.zero();
    let mut pivots = Vec::new();
    for column in 0..rows.first().map_or(0, Vec::len) {
        let rank = pivots.len();
        let Some(best) = (rank..rows.len()).find(|&i| rows[i][column] != zero) else { continue };
        rows.swap(best, rank);
        let inverse = inverse(rows[rank][column])?;
        for x in &mut rows[rank][column..] {
            *x = field.mul(*x, inverse);
        }
        let (head, tail) = rows.split_at_mut(rank);
        let Some((pivot_row, tail)) = tail.split_first_mut() else { break };
        for row in head.iter_mut().chain(tail) {
            let factor = field.neg(row[column]);
            field.add_multiple(&mut row[column..], factor, &pivot_row[column..]);
        }
        pivots.push(column);
    }
    rows.truncate(pivots.len());
    Some(pivots)
}

/// Powers of N that remove the solutions with `N = 0`, with the degree from which the rest is constant, in the order tried.
const ATTEMPTS: [(usize, usize); 2] = [(1, 5), (2, 5)];

/// Returns the multiplication matrices where solutions with `N = 0` form curves, on the image of multiplication by a power of N;
/// `None` where that image grows with the degree (a curve of poses), or `inverse` does not exist for a number that is not 0.
#[must_use]
pub fn special_products<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
    setting: &Setting<A::Element>,
) -> Option<Products<A::Element>> {
    finite_products(field, inverse, GradedQuotient::new(field, setting), setting.count)
}

/// Returns whether `cuts` general quadrics leave finitely many poses.
fn dimension_is(modulus: &Modulus, setting: &Setting<u64>, cuts: usize) -> bool {
    let mut ring = GradedQuotient::new(modulus, setting);
    for number in 0..cuts {
        ring.cut(number);
    }
    finite_products(modulus, |x| inverse(modulus, x), ring, setting.count).is_some()
}

/// Returns the matrices from a ring in degree 0 with `count` unknowns beside the rotation.
fn finite_products<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
    mut ring: GradedQuotient<A>,
    count: usize,
) -> Option<Products<A::Element>> {
    let mut known = 0;
    for (power, degree) in ATTEMPTS {
        while known < degree + 1 + 2 * power {
            ring.advance(inverse)?;
            known += 1;
        }
        let norms: Vec<_> = (0..power).map(|step| ring.norm(degree + 1 + 2 * step)).collect();
        // N^power times the products of an unknown with every basis element m of a degree.
        let images = |from: usize, index: usize| -> Vec<Vec<A::Element>> {
            let image = |k: usize| {
                let mut v = vec![field.zero(); ring.dimension(from)];
                v[k] = field.one();
                let mut v = ring.times(from, index, &v);
                for norm in &norms {
                    let mut product = vec![field.zero(); norm.first().map_or(0, Vec::len)];
                    for (&c, row) in v.iter().zip(norm).filter(|(c, _)| **c != field.zero()) {
                        field.add_multiple(&mut product, c, row);
                    }
                    v = product;
                }
                v
            };
            (0..ring.dimension(from)).map(image).collect()
        };
        let rotations = std::array::from_fn(|index| images(degree, index));
        let translations: Vec<_> = (0..count).flat_map(|a| images(degree - 1, 4 + a)).collect();
        if let Some(products) = quotients(field, inverse, &rotations, &translations) {
            return Some(products);
        }
    }
    None
}

/// Returns the matrices of `z_i / z_0`, i = 1..3, on the span of the images of z_0; `None` where the images of an unknown, a tau
/// included, leave that span. Poses that share their rotation differ in tau only.
fn quotients<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    images: &[Vec<Vec<A::Element>>; 4],
    others: &[Vec<A::Element>],
) -> Option<Products<A::Element>> {
    let zero = field.zero();
    // Rows (z_0 image | z_1 image | z_2 image | z_3 image), reduced by their first parts.
    let width = images[0].first().map_or(0, Vec::len);
    let mut table: Vec<Vec<A::Element>> =
        (0..images[0].len()).map(|k| images.iter().flat_map(|image| image[k].iter().copied()).collect()).collect();
    let mut pivots = Vec::new();
    for column in 0..width {
        let rank = pivots.len();
        let Some(best) = (rank..table.len()).find(|&i| table[i][column] != zero) else { continue };
        table.swap(best, rank);
        let inverse = inverse(table[rank][column])?;
        for x in &mut table[rank] {
            *x = field.mul(*x, inverse);
        }
        let pivot_row = table[rank].clone();
        for (i, row) in table.iter_mut().enumerate() {
            if i != rank && row[column] != zero {
                let factor = field.neg(row[column]);
                field.add_multiple(row, factor, &pivot_row);
            }
        }
        pivots.push(column);
    }
    let rank = pivots.len();
    if table[rank..].iter().any(|row| row.iter().any(|&x| x != zero)) {
        return None;
    }
    let rest = |v: &[A::Element]| {
        let mut rest = v.to_vec();
        for (row, &column) in table.iter().zip(&pivots) {
            field.add_multiple(&mut rest, field.neg(v[column]), &row[..width]);
        }
        rest
    };
    if others.iter().any(|other| rest(other).iter().any(|&x| x != zero)) {
        return None;
    }
    let mut factors: Products<A::Element> = std::array::from_fn(|_| vec![vec![zero; rank]; rank]);
    for (i, factor) in factors.iter_mut().enumerate() {
        for k in 0..rank {
            let image = &table[k][(i + 1) * width..(i + 2) * width];
            for (j, &column) in pivots.iter().enumerate() {
                factor[k][j] = image[column];
            }
            if rest(image).iter().any(|&x| x != zero) {
                return None;
            }
        }
    }
    Some(factors)
}
