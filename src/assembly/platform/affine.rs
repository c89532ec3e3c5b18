//! Poses of platforms whose base and moving platform are affine images of the same points, from the algebra of their
//! rotations in 384-bit arithmetic.

use super::high_precision::{combined, framed, upper_roots};
use super::prepared::Frame;
use crate::algebra::long_float::LongNumber;
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::{Form, Four, left, scalar};
use crate::elimination::affine_platform::AffinePlatform;
use crate::elimination::border::LongReals;
use crate::elimination::platform_degree::{turned, turns};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use crate::solve::hessenberg::Hessenberg;
use crate::solve::pose::Eight;
use crate::solve::scalar::Number;
use num_complex::Complex;
use rug::Rational;

/// Number of 64-bit words. The algebra of 32 rotations loses less than half of the 384 bits.
const LIMBS: usize = 6;

type LongFloat = LongNumber<LIMBS>;
type Long = Complex<LongFloat>;

fn long(x: &Rational) -> Long {
    Long::from_real(LongFloat::from_rational(x).unwrap_or_else(LongFloat::zero))
}

/// The data that determine the positions at a rotation, in multiprecision.
struct Positions {
    square: Form<Long>,
    moments: Vec<Form<Long>>,
    /// The columns of E and M.
    columns: [Vec<Vector<Long>>; 2],
    /// The points o and c.
    origins: [Vector<Long>; 2],
    two: bool,
}

impl Positions {
    fn new(platform: &AffinePlatform) -> Self {
        let form = |form: &Form<Rational>| form.each_ref().map(|row| row.each_ref().map(long));
        let vector = |v: &Vector<Rational>| v.each_ref().map(long);
        Self {
            square: form(&platform.square),
            moments: platform.moments.iter().map(form).collect(),
            columns: platform.columns().map(|columns| columns.iter().map(vector).collect()),
            origins: platform.relation.origins.each_ref().map(vector),
            two: platform.counts().1 == 2,
        }
    }

    /// Returns the positions at a rotation: solutions p of `(R M - E)^T p = v` and `p.p = s`, moved from the points o and c.
    fn at(&self, z: &Four<Long>) -> Option<Vec<Vector<Long>>> {
        let unit = scalar(z, z).inverse()?;
        let [scalar, x, y, w] = *z;
        let rotation = Quaternion { scalar, vector: [x, y, w] }.scaled_rotation();
        let turn = |v: &Vector<Long>| -> Vector<Long> { std::array::from_fn(|i| dot(&rotation[i], v).mul(&unit)) };
        let value = |form: &Form<Long>| {
            let sum = (0..16).fold(Long::zero(), |sum, e| sum.add(&z[e / 4].mul(&z[e % 4]).mul(&form[e / 4][e % 4])));
            sum.mul(&unit)
        };
        let [e, m] = &self.columns;
        let rows: Vec<Vector<Long>> = m.iter().zip(e).map(|(m, e)| difference(&turn(m), e)).collect();
        let v: Vec<Long> = self.moments.iter().map(value).collect();
        let found = if self.two { two(&rows, &v, &value(&self.square))? } else { vec![one(&rows, &v)?] };
        let back = turn(&self.origins[1]);
        let moved = |p: Vector<Long>| std::array::from_fn(|k| p[k].add(&self.origins[0][k]).sub(&back[k]));
        Some(found.into_iter().map(moved).collect())
    }
}

fn difference(p: &Vector<Long>, q: &Vector<Long>) -> Vector<Long> {
    std::array::from_fn(|k| p[k].sub(&q[k]))
}

/// Returns the solution of three linear equations.
fn one(rows: &[Vector<Long>], v: &[Long]) -> Option<Vector<Long>> {
    let [a, b, c] = rows else { return None };
    let products = [cross(b, c), cross(c, a), cross(a, b)];
    let scale = dot(a, &products[0]).inverse()?;
    let sum = |k: usize| v.iter().zip(&products).fold(Long::zero(), |sum, (v, n)| sum.add(&v.mul(&n[k])));
    Some(std::array::from_fn(|k| sum(k).mul(&scale)))
}

/// Returns the two solutions of two linear equations, the most independent of those given, that have the square s.
fn two(rows: &[Vector<Long>], v: &[Long], s: &Long) -> Option<Vec<Vector<Long>>> {
    let pairs = (1..rows.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    let normal = |(i, j): (usize, usize)| cross(&rows[i], &rows[j]);
    let size = |pair| dot(&normal(pair), &normal(pair)).square_size();
    let (i, j) = pairs.max_by(|p, q| size(*p).total_cmp(&size(*q)))?;
    let along = normal((i, j));
    let scale = dot(&along, &along).inverse()?;
    let (first, second) = (cross(&rows[j], &along), cross(&along, &rows[i]));
    let foot: Vector<Long> = std::array::from_fn(|k| v[i].mul(&first[k]).add(&v[j].mul(&second[k])).mul(&scale));
    let reach = s.sub(&dot(&foot, &foot)).mul(&scale).root();
    let ends = [reach, reach.neg()];
    Some(ends.iter().map(|t| std::array::from_fn(|k| foot[k].add(&t.mul(&along[k])))).collect())
}

/// Returns points near the simple poses, one of each conjugate pair.
pub fn affine_starts(platform: &Platform<Rational>, squares: &[Rational; 6], frame: &Frame) -> Vec<Eight<Long>> {
    (0..2).find_map(|choice| starts(platform, squares, frame, choice)).unwrap_or_default()
}

fn starts(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    frame: &Frame,
    choice: usize,
) -> Option<Vec<Eight<Long>>> {
    let platform = AffinePlatform::new(&turned(platform, choice), squares)?;
    let products = platform.products(&LongReals::<LIMBS>, |x| x.inverse(), LongFloat::from_rational)?;
    let hessenberg = Hessenberg::of(combined(&products));
    let positions = Positions::new(&platform);
    let at = |root: Long| {
        let values = hessenberg.vector(&root)?;
        let one = values[0].inverse()?;
        let z: Four<Long> = std::array::from_fn(|k| if k == 0 { Long::one() } else { values[k].mul(&one) });
        let found = positions.at(&z)?.into_iter().filter_map(|p| {
            let moved = left(&p);
            let y: Four<Long> = std::array::from_fn(|i| scalar(&moved[i], &z));
            framed(&z, &y, &turns(choice), frame)
        });
        Some(found.collect::<Vec<_>>())
    };
    Some(upper_roots(&hessenberg).into_iter().filter_map(at).flatten().collect())
}
