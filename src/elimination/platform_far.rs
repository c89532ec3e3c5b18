//! Solutions of the legs with `x = 0`, at infinity, that a platform has whatever its legs are. They are no poses, and twice as many
//! are missing of the 40 of six general legs. docs/platforms.md, theorem 6, has the proof.
//!
//! Such a solution is a vector `(s, p, q)` with `K (s, p, q) = 0`, `p.p = 0` and `q.q = 0`. Those that are found here belong to a kernel of
//! K of two dimensions on which `p.p` and `q.q` are proportional: five points of the plate are similar to those of the base.

use crate::algebra::echelon::Echelon;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::{LinearLegs, left, linear_legs, right};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use num_complex::Complex;
use rug::Rational;

/// Residues modulo a prime for which -1 is no square, as for the other solutions that are no poses.
type Residue = ModP<PRIME_61>;

/// The field of p^2 elements, in which every residue has a square root. What is not 0 in it is not 0.
type Root = Complex<Residue>;

/// The unknowns s, p and q.
const UNKNOWNS: usize = 7;
/// What every solution counts for.
const EACH: usize = 2;
/// Squared lengths of legs for which a solution is looked at. What holds for them holds for almost all; nothing is special about these.
const SQUARES: [i32; 6] = [2, 5, 11, 23, 31, 47];

/// Returns the number of solutions with `x = 0` that are found, each counted twice: a lower bound of how many of the 40 they are at almost
/// all legs.
#[must_use]
pub fn far_solutions(platform: &Platform<Rational>) -> usize {
    let Some(modular) = platform.map(Residue::from_rational) else { return 0 };
    let legs = linear_legs(&modular);
    let rank = Echelon::of(rows(&legs.matrix), UNKNOWNS).rank();
    // A rank modulo the prime is at most the true one.
    if rank != UNKNOWNS - 2 {
        return 0;
    }
    let kernel = Echelon::of(rows(&linear_legs(platform).matrix), UNKNOWNS).null_space();
    let [one, other] = kernel.as_slice() else { return 0 };
    let points = of_pencil(one, other).unwrap_or_default();
    let far = Far { legs: &legs };
    let counted = points.iter().filter(|point| far.is_isolated(point)).count();
    // Points that coincide modulo the prime may be one.
    let are_apart = (0..points.len()).all(|k| (0..k).all(|l| !are_parallel(&points[k], &points[l])));
    if are_apart { EACH * counted } else { 0 }
}

fn rows<R: Ring>(matrix: &[[R; UNKNOWNS]; 6]) -> Vec<Vec<R>> {
    matrix.iter().map(|row| row.to_vec()).collect()
}

/// The positions p and q of a vector.
fn parts<R: Ring>(vector: &[R]) -> [Vector<R>; 2] {
    [1, 4].map(|from| std::array::from_fn(|k| vector[from + k].clone()))
}

fn are_parallel(one: &[Root], other: &[Root]) -> bool {
    (0..one.len()).all(|k| (0..k).all(|l| one[k].mul(&other[l]).sub(&one[l].mul(&other[k])).is_zero()))
}

fn root(re: Residue) -> Root {
    Complex { re, im: Residue::zero() }
}

fn images(vector: &[Rational]) -> Option<Vec<Root>> {
    vector.iter().map(|x| Residue::from_rational(x).map(root)).collect()
}

/// `first + factor second`
fn sum(first: &[Root], factor: &Root, second: &[Root]) -> Vec<Root> {
    first.iter().zip(second).map(|(a, b)| a.add(&factor.mul(b))).collect()
}

/// Both solutions in the kernel, where `p.p` and `q.q` are proportional; `None` where they are not.
fn of_pencil(one: &[Rational], other: &[Rational]) -> Option<Vec<Vec<Root>>> {
    let ([p, q], [next_p, next_q]) = (parts(one), parts(other));
    let form = |a: &Vector<Rational>, b: &Vector<Rational>| [dot(a, a), dot(a, b), dot(b, b)];
    let (before, behind) = (form(&p, &next_p), form(&q, &next_q));
    if cross(&before, &behind).iter().any(|minor| *minor != 0) {
        return None;
    }
    // The form of real vectors is semidefinite, and definite where both zeros are complex.
    let [square, mixed, last] = before.map(|x| Residue::from_rational(&x));
    let (square, mixed, last) = (square?, mixed?, last?);
    let discriminant = mixed.mul(&mixed).sub(&square.mul(&last)).square_root();
    let over = root(last.inverse()?);
    let (one, other) = (images(one)?, images(other)?);
    let zero = |sign: i32| {
        let above = discriminant.mul(&root(Residue::from_integer(sign))).sub(&root(mixed));
        sum(&one, &above.mul(&over), &other)
    };
    Some(vec![zero(1), zero(-1)])
}

/// A binary quadratic form `a y^2 + b y z + c z^2`.
type Binary = [Root; 3];

/// The legs about a solution with `x = 0`.
struct Far<'a> {
    legs: &'a LinearLegs<Residue>,
}

impl Far<'_> {
    /// Returns whether a solution is isolated, of multiplicity 4 where x and -x are two points: after the linear equations, two
    /// binary quadratic forms without common zero are left.
    fn is_isolated(&self, point: &[Root]) -> bool {
        let [p, q] = parts(point);
        let is_nothing = |v: &Vector<Root>| v.iter().all(Ring::is_zero);
        if is_nothing(&p) || is_nothing(&q) || !dot(&p, &p).is_zero() || !dot(&q, &q).is_zero() {
            return false;
        }
        // The columns of s, p and q in the six legs and in the differentials of p.p and q.q, and the unit matrix behind them.
        let column = |i: usize, k: usize| match (i, k) {
            (0..6, _) => root(self.legs.matrix[i][k]),
            (6, 1..4) => p[k - 1].add(&p[k - 1]),
            (7, 4..7) => q[k - 4].add(&q[k - 4]),
            _ => Root::zero(),
        };
        let transposed: Vec<Vec<Root>> = (0..UNKNOWNS).map(|k| (0..8).map(|i| column(i, k)).collect()).collect();
        let left_null = Echelon::of(transposed, 8).null_space();
        let directions = kernel_of_rotations(&p, &q);
        let ([one, other], [first, second]) = (left_null.as_slice(), directions.as_slice()) else { return false };
        let form = |weights: &Vec<Root>| self.restricted(weights, &point[0], first, second);
        are_coprime(&form(one), &form(other))
    }

    /// The combination of the forms of the legs and of `s N`, twice, on a plane of rotations.
    fn restricted(&self, weights: &[Root], s: &Root, first: &[Root], second: &[Root]) -> Binary {
        let norm = weights[6].add(&weights[7]).mul(s);
        let entry = |j: usize, k: usize| {
            let of_leg = |i: usize| {
                let square = if j == k { Residue::from_integer(SQUARES[i]) } else { Residue::zero() };
                weights[i].mul(&root(self.legs.forms[i][j][k].add(&square)))
            };
            let own = if j == k { norm } else { Root::zero() };
            (0..6).fold(own, |sum, i| sum.add(&of_leg(i)))
        };
        let product = |x: &[Root], y: &[Root]| {
            (0..16).fold(Root::zero(), |sum, e| sum.add(&x[e / 4].mul(&y[e % 4]).mul(&entry(e / 4, e % 4))))
        };
        let mixed = product(first, second);
        [product(first, first), mixed.add(&mixed), product(second, second)]
    }
}

/// The rotations x with `x q = p x`.
fn kernel_of_rotations(p: &Vector<Root>, q: &Vector<Root>) -> Vec<Vec<Root>> {
    let (before, behind) = (left(p), right(q));
    let rows = (0..4).map(|i| (0..4).map(|k| behind[i][k].sub(&before[i][k])).collect()).collect();
    Echelon::of(rows, 4).null_space()
}

/// Whether two binary quadratic forms have no zero in common: their resultant is not 0.
fn are_coprime([a, b, c]: &Binary, [d, e, f]: &Binary) -> bool {
    let minor = |x: &Root, y: &Root, z: &Root, w: &Root| x.mul(w).sub(&y.mul(z));
    let (outer, low, high) = (minor(a, c, d, f), minor(a, b, d, e), minor(b, c, e, f));
    !outer.mul(&outer).sub(&low.mul(&high)).is_zero()
}
