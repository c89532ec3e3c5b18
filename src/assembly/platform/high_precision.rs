//! Solves for poses again from exact data, in 384 bits and more, for complex poses almost at infinity that f64 cannot reach.

use super::prepared::Frame;
use crate::algebra::long_float::LongNumber;
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::{Four, left, scalar};
use crate::elimination::platform_basis::PoseTable;
use crate::elimination::platform_long::{LongAlgebra, long_algebra};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use crate::solve::hessenberg::Hessenberg;
use crate::solve::polynomial_roots::polynomial_roots;
use crate::solve::pose::Eight;
use crate::solve::scalar::{Number, extended};
use num_complex::Complex;
use rug::Rational;

type Long<const LIMBS: usize> = Complex<LongNumber<LIMBS>>;

/// Weights of the combination of `z_1, z_2, z_3` whose eigenvalues are computed; as a rule no two poses share its value.
const WEIGHTS: [i32; 3] = [1, -2, 3];

/// Eigenvalues with an imaginary part below this, relative to themselves, may be real.
const NEARLY_REAL: f64 = 1e-3;

/// Displacements of the points if the border basis of the platform itself does not exist, in units of its size: these
/// powers of 1/2 in turn. Poses move by about as much. Every degree of the border basis costs about that many of the 384 bits; longer
/// numbers have room for as many times longer ones.
const DISTURBANCES: [u32; 2] = [24, 14];
/// Words of the numbers that these are for.
const WORDS: u32 = 6;

/// Returns points near the poses of a platform, one of each conjugate pair: Study's parameters in the frame of polishing.
/// Multiple solutions without a pose (`N = 0`) are left out.
pub fn starts<const LIMBS: usize>(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    frame: &Frame,
) -> Vec<Eight<Long<LIMBS>>> {
    let of = |platform: &Platform<Rational>| (0..2).find_map(|choice| long_algebra::<LIMBS>(platform, squares, choice));
    // Solutions with N = 0 may lie on curves, which a neighbouring platform does not have.
    let longer = |bits: u32| bits * u32::try_from(LIMBS).unwrap_or(WORDS) / WORDS;
    let beside = || DISTURBANCES.into_iter().find_map(|bits| of(&disturbed(platform, frame.scale, longer(bits))));
    let algebra = of(platform).or_else(beside);
    algebra.map_or_else(Vec::new, |algebra| {
        let hessenberg = Hessenberg::of(combined(&algebra.products));
        let upper = upper_roots(&hessenberg).into_iter();
        upper.filter_map(|root| study(&algebra, &hessenberg.vector(&root)?, frame)).collect()
    })
}

/// Returns points near the poses that a table of exact numbers describes, one of each conjugate pair and both quaternions of every
/// rotation; empty where a number is too long.
pub fn starts_of_table<const LIMBS: usize>(table: &PoseTable, frame: &Frame) -> Vec<Eight<Long<LIMBS>>> {
    let row = |row: &Vec<Rational>| row.iter().map(LongNumber::<LIMBS>::from_rational).collect::<Option<Vec<_>>>();
    let rows = |rows: &[Vec<Rational>]| rows.iter().map(row).collect::<Option<Vec<_>>>();
    let (form, coordinates) = (rows(&table.form), rows(&[&table.rotation[..], &table.position[..]].concat()));
    let (Some(form), Some(coordinates)) = (form, coordinates) else { return Vec::new() };
    let hessenberg = Hessenberg::of(form);
    let still = || Quaternion { scalar: LongNumber::one(), vector: std::array::from_fn(|_| LongNumber::zero()) };
    let at = |root: Long<LIMBS>| {
        let values = hessenberg.vector(&root)?;
        let one = values.first()?.inverse()?;
        let value = |row: &Vec<LongNumber<LIMBS>>| {
            let terms = row.iter().zip(&values);
            terms.fold(Long::<LIMBS>::zero(), |sum, (c, v)| sum.add(&v.times(*c))).mul(&one)
        };
        let z: Four<Long<LIMBS>> = std::array::from_fn(|k| value(&coordinates[k]));
        let moved = left(&std::array::from_fn(|k| value(&coordinates[4 + k])));
        let y: Four<Long<LIMBS>> = std::array::from_fn(|i| scalar(&moved[i], &z));
        framed(&z, &y, &[still(), still()], frame)
    };
    upper_roots(&hessenberg).into_iter().filter_map(at).collect()
}

/// Returns the simple eigenvalues of a real matrix that are real, nearly so, or above the real axis.
pub fn upper_roots<const LIMBS: usize>(hessenberg: &Hessenberg<LongNumber<LIMBS>>) -> Vec<Long<LIMBS>> {
    let mut roots = polynomial_roots(&hessenberg.characteristic()).unwrap_or_default();
    roots.retain(|root| root.im.to_f64() > -NEARLY_REAL * root.re.to_f64().abs());
    roots
}

/// Returns a general platform very near to this one.
fn disturbed(platform: &Platform<Rational>, scale: f64, bits: u32) -> Platform<Rational> {
    let unit = Rational::from_f64(scale).unwrap_or_else(|| Rational::from(1)) >> bits;
    let mut platform = platform.clone();
    for (i, point) in platform.base.iter_mut().chain(&mut platform.plate).enumerate() {
        for (k, x) in point.iter_mut().enumerate() {
            *x += &unit * spread(i, k);
        }
    }
    platform
}

/// Returns numbers between -1 and 1 that are far from regular and the same in every run.
fn spread(point: usize, coordinate: usize) -> Rational {
    let root = [2.0_f64, 3.0, 5.0][coordinate % 3].sqrt();
    Rational::from_f64(2.0 * ((point + 1) as f64 * root).fract() - 1.0).unwrap_or_default()
}

/// Returns `sum_i w_i z_i` as a matrix: row k is its product with basis element k.
pub fn combined<const LIMBS: usize, Row: AsRef<[LongNumber<LIMBS>]>>(
    products: &[Vec<Row>; 3],
) -> Vec<Vec<LongNumber<LIMBS>>> {
    let weights = WEIGHTS.map(LongNumber::from_integer);
    let size = products[0].len();
    (0..size)
        .map(|k| {
            let entry = |j: usize| {
                products.iter().zip(&weights).fold(LongNumber::zero(), |sum, (m, w)| sum.add(&m[k].as_ref()[j].mul(w)))
            };
            (0..size).map(entry).collect()
        })
        .collect()
}

/// Study's parameters from the values of the basis elements at a solution.
fn study<const LIMBS: usize>(
    algebra: &LongAlgebra<LIMBS>,
    values: &[Long<LIMBS>],
    frame: &Frame,
) -> Option<Eight<Long<LIMBS>>> {
    let one = values[0].inverse()?;
    let at = |k: usize| values[k].mul(&one);
    let z: Four<Long<LIMBS>> = [Long::<LIMBS>::one(), at(1), at(2), at(3)];
    let setting = &algebra.setting;
    let u = |k: usize| -> Long<LIMBS> {
        let form = &setting.forms[k];
        let square =
            (0..16).fold(Long::<LIMBS>::zero(), |sum, e| sum.add(&z[e / 4].mul(&z[e % 4]).times(form[e / 4][e % 4])));
        (0..setting.count).fold(square, |sum, a| sum.add(&at(4 + a).times(setting.null[a][k])))
    };
    // `p z / N` from `N p`, then both are turned back: x = before^* z behind.
    let inverse = scalar(&z, &z).inverse()?;
    let moved = left(&[u(1), u(2), u(3)]);
    let y: Four<Long<LIMBS>> = std::array::from_fn(|i| scalar(&moved[i], &z).mul(&inverse));
    framed(&z, &y, &algebra.turns, frame)
}

/// Converts Study's parameters of the platform turned by [`turned`](crate::elimination::platform_degree::turned) to the
/// frame.
pub fn framed<const LIMBS: usize>(
    z: &Four<Long<LIMBS>>,
    y: &Four<Long<LIMBS>>,
    turns: &[Quaternion<LongNumber<LIMBS>>; 2],
    frame: &Frame,
) -> Option<Eight<Long<LIMBS>>> {
    let lift = |q: &Quaternion<LongNumber<LIMBS>>| Quaternion {
        scalar: Long::<LIMBS>::from_real(q.scalar),
        vector: q.vector.map(Long::<LIMBS>::from_real),
    };
    let quaternion = |[scalar, x, y, z]: Four<Long<LIMBS>>| Quaternion { scalar, vector: [x, y, z] };
    let [before, behind] = turns.each_ref().map(lift);
    let back = |q: Four<Long<LIMBS>>| before.conjugate().mul(&quaternion(q)).mul(&behind);
    let (x, y) = (back(*z), back(*y));
    // Into the frame: y - o x + x o'.
    let pure =
        |v: &[f64; 3]| Quaternion { scalar: Long::<LIMBS>::zero(), vector: v.map(|c| extended(Complex::from(c))) };
    let (base, plate) = (pure(&frame.origins[0]).mul(&x), x.mul(&pure(&frame.origins[1])));
    let unit = LongNumber::<LIMBS>::from(1.0 / frame.scale);
    let four = |q: &Quaternion<Long<LIMBS>>| [q.scalar, q.vector[0], q.vector[1], q.vector[2]];
    let (x, y, base, plate) = (four(&x), four(&y), four(&base), four(&plate));
    let study: Eight<Long<LIMBS>> =
        std::array::from_fn(|k| if k < 4 { x[k] } else { y[k - 4].sub(&base[k - 4]).add(&plate[k - 4]).times(unit) });
    study.iter().all(|z| z.size().is_finite()).then_some(study)
}
