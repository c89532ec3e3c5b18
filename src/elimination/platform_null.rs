//! Solutions with `N = x.x = 0` that a platform has whatever its legs are. They are no poses, and as many are missing of the 40 of
//! six general legs. docs/platforms.md, theorem 5, has the proof.
//!
//! Such a solution is a pair of isotropic vectors v and w with three numbers such that `(A_i - nu) (B_i - mu) = sigma` for all legs,
//! where `A_i = v.a_i` and `B_i = w.b_i`. Those that are found here have v normal to a line d through points of the base and w
//! normal to a line e through points of the plate; points of one line have the same A or B.

use crate::algebra::echelon::Echelon;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::ring::Ring;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use num_complex::Complex;
use rug::Rational;

/// The residues modulo a prime for which -1 is no square. No answer is wrong if it divides some number of the platform, only slower.
type Residue = ModP<PRIME_61>;

/// The field of p^2 elements, in which every residue has a square root. What is not 0 in it is not 0.
type Root = Complex<Residue>;

/// Unknowns of a solution with `N = 0`: v and w, each along its conic, nu, mu and sigma.
const UNKNOWNS: usize = 5;

/// Classes of legs with one value of A and one of B for which nu, mu and sigma exist: three points determine a map
/// `B = mu + sigma / (A - nu)`. More classes would have to have the same cross ratios on both sides.
const CLASSES: usize = 3;

/// Lines of one direction through points of a body.
struct Lines {
    /// Two points whose difference is the direction.
    ends: [usize; 2],
    direction: Vector<Residue>,
    /// For each leg the first one on the same line of this direction.
    classes: [usize; 6],
}

/// One body: its points, exact and modulo the prime.
struct Body<'a> {
    exact: &'a [Vector<Rational>; 6],
    points: [Vector<Residue>; 6],
}

fn difference<R: Ring>(p: &Vector<R>, q: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|k| p[k].sub(&q[k]))
}

fn are_parallel<R: Ring>(p: &Vector<R>, q: &Vector<R>) -> bool {
    cross(p, q).iter().all(Ring::is_zero)
}

impl<'a> Body<'a> {
    /// Takes the points of a body; `None` where the prime divides a denominator.
    fn new(exact: &'a [Vector<Rational>; 6]) -> Option<Self> {
        let mut points = [[Residue::zero(); 3]; 6];
        for (image, point) in points.iter_mut().flatten().zip(exact.iter().flatten()) {
            *image = Residue::from_rational(point)?;
        }
        Some(Self { exact, points })
    }

    /// Returns all directions of lines through two points that differ, modulo the prime.
    fn lines(&self) -> Vec<Lines> {
        let mut found: Vec<Lines> = Vec::new();
        for j in 1..6 {
            for i in 0..j {
                let direction = difference(&self.points[j], &self.points[i]);
                if direction.iter().all(Ring::is_zero)
                    || found.iter().any(|lines| are_parallel(&lines.direction, &direction))
                {
                    continue;
                }
                let is_beside =
                    |k: usize, l: usize| are_parallel(&difference(&self.points[k], &self.points[l]), &direction);
                let classes = std::array::from_fn(|k| (0..k).find(|&l| is_beside(k, l)).unwrap_or(k));
                found.push(Lines { ends: [i, j], direction, classes });
            }
        }
        found
    }

    /// Returns whether the legs of every class lie on lines of the direction exactly.
    fn is_exact(&self, lines: &Lines) -> bool {
        let [i, j] = lines.ends;
        let direction = difference(&self.exact[j], &self.exact[i]);
        (0..6).all(|k| are_parallel(&difference(&self.exact[k], &self.exact[lines.classes[k]]), &direction))
    }

    /// Returns the products of the points with an isotropic vector normal to a direction, and the derivatives of these where the vector
    /// moves along its conic; `None` where the prime is unlucky. The other such vector has its root with the other sign.
    fn seen(&self, direction: &Vector<Residue>, sign: i32) -> Option<([Root; 6], [Root; 6])> {
        let axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|axis| axis.map(Residue::from_integer));
        // d x axis and d x (d x axis) / |d| are normal to d and to each other, and of one length.
        let across = axes.iter().map(|axis| cross(direction, axis)).find(|f| !dot(f, f).is_zero())?;
        let other = cross(direction, &across);
        let length = dot(direction, direction).square_root();
        if length.is_zero() {
            return None;
        }
        let isotropic: Vector<Root> = std::array::from_fn(|k| {
            let real = length.mul(&Root { re: across[k], im: Residue::zero() });
            real.add(&Root { re: Residue::zero(), im: other[k].mul(&Residue::from_integer(sign)) })
        });
        let image = |p: &Vector<Residue>| p.map(|x| Root { re: x, im: Residue::zero() });
        let values = self.points.each_ref().map(|p| dot(&isotropic, &image(p)));
        // v.v = 0 lets v move along d, in first order.
        let slopes = self.points.each_ref().map(|p| Root { re: dot(direction, p), im: Residue::zero() });
        Some((values, slopes))
    }
}

/// Returns the number of solutions with `N = 0` that are found, a lower bound of those that the platform has at almost all legs, with
/// multiplicity.
#[must_use]
pub fn null_solutions(platform: &Platform<Rational>) -> usize {
    let (Some(base), Some(plate)) = (Body::new(&platform.base), Body::new(&platform.plate)) else { return 0 };
    let (before, behind) = (base.lines(), plate.lines());
    let mut count = 0;
    for d in &before {
        for e in &behind {
            let (is_inverse, double) = (are_inverse(d, e), double_classes(d, e));
            let is_candidate = is_inverse || !double.is_empty();
            if !is_candidate || !base.is_exact(d) || !plate.is_exact(e) {
                continue;
            }
            for (one, other) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let seen = base.seen(&d.direction, one).zip(plate.seen(&e.direction, other));
                let Some(((a, slopes), (b, others))) = seen else { continue };
                let view = View { a: &a, b: &b, slopes: [&slopes, &others] };
                if is_inverse && view.inversion(&d.classes).is_some_and(|numbers| view.is_isolated(&numbers)) {
                    count += 1;
                }
                // Such a solution is singular, and counts twice.
                let is_isolated = |&(i, j): &(usize, usize)| view.is_isolated(&[a[i], b[j], Root::zero()]);
                count += 2 * double.iter().filter(|pair| is_isolated(pair)).count();
            }
        }
    }
    count
}

/// Returns whether both bodies have the same classes, three of them.
fn are_inverse(d: &Lines, e: &Lines) -> bool {
    d.classes == e.classes && (0..6).filter(|&k| d.classes[k] == k).count() == CLASSES
}

/// Returns the pairs of a line of the base and a line of the plate, each through two points at least, to which all legs belong.
fn double_classes(d: &Lines, e: &Lines) -> Vec<(usize, usize)> {
    let large = |lines: &Lines| -> Vec<usize> {
        (0..6).filter(|&k| lines.classes.iter().filter(|&&class| class == k).count() > 1).collect()
    };
    let (of_plate, mut pairs) = (large(e), Vec::new());
    for i in large(d) {
        let rest = of_plate.iter().filter(|&&j| (0..6).all(|k| d.classes[k] == i || e.classes[k] == j));
        pairs.extend(rest.map(|&j| (i, j)));
    }
    pairs
}

/// Base and plate seen along isotropic vectors.
struct View<'a> {
    a: &'a [Root; 6],
    b: &'a [Root; 6],
    /// The derivatives of a and b.
    slopes: [&'a [Root; 6]; 2],
}

impl View<'_> {
    /// Returns nu, mu and sigma of three classes; `None` where there may be none: an affine map takes one to the other.
    fn inversion(&self, classes: &[usize; 6]) -> Option<[Root; 3]> {
        // a b = mu a + nu b + (sigma - mu nu)
        let first = (0..6).filter(|&k| classes[k] == k);
        let row = |k: usize| vec![self.a[k], self.b[k], Root::one(), self.a[k].mul(&self.b[k])];
        let solved = Echelon::among(first.map(row).collect(), CLASSES + 1, CLASSES);
        if solved.rank() < CLASSES {
            return None;
        }
        let mut values = [Root::zero(); CLASSES];
        for (row, &pivot) in solved.rows().iter().zip(solved.pivots()) {
            values[pivot] = row[CLASSES];
        }
        let [mu, nu, rest] = values;
        Some([nu, mu, rest.add(&mu.mul(&nu))])
    }

    /// Returns whether the six equations `(A - nu) (B - mu) = sigma` have independent derivatives in the five unknowns.
    fn is_isolated(&self, [nu, mu, _]: &[Root; 3]) -> bool {
        let row = |k: usize| {
            let (a, b) = (self.a[k].sub(nu), self.b[k].sub(mu));
            let along = [self.slopes[0][k].mul(&b), self.slopes[1][k].mul(&a)];
            along.into_iter().chain([b.neg(), a.neg(), Root::one().neg()]).collect()
        };
        Echelon::of((0..6).map(row).collect(), UNKNOWNS).rank() == UNKNOWNS
    }
}
