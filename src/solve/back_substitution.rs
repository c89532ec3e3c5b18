//! From a root of the pencil to all six unknowns of the cut.

use super::eigen::eigenvalues;
use super::kernel::{Kernel, double_angle, unknowns};
use super::newton::{Six, product};
use super::scalar::{Number, Scalar};
use crate::closure::half_angle::HalfAngleForm;
use crate::closure::woernle_lee::{FIXED, MarkedLine, TURNING_X, TURNING_Y, act, z_axis};
use crate::elimination::cut::Hidden;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use num_complex::Complex;

/// Most candidates one root can lead to.
pub const MOST: usize = 16;

/// A cut with what back-substitution needs of it, its constants in the number type of the roots.
pub struct CutView<'a, S: Number> {
    /// The loop as the cut reads it.
    pub cut: &'a ClosedLoop<S::Real>,
    /// Its elimination.
    pub form: &'a HalfAngleForm<S::Real>,
    /// The unknown that is the eigenvalue.
    pub hidden: Hidden,
    inverses: [Motion<S>; 5],
    start: MarkedLine<S>,
}

/// Angles at which a family of solutions is sampled.
const SAMPLES: [f64; 2] = [0.7, -1.9];

fn sample<S: Scalar>(angle: f64) -> (S, S) {
    (S::from_f64(angle.cos()), S::from_f64(angle.sin()))
}

/// The candidates of one root, without allocation.
#[derive(Clone, Debug)]
pub struct Candidates<S> {
    list: [Six<S>; MOST],
    count: usize,
    /// Whether part of the root could not be resolved: a family of solutions, or more solutions than fit.
    pub unresolved: bool,
}

impl<S: Scalar> Candidates<S> {
    fn none() -> Self {
        Self { list: [[S::zero(); 6]; MOST], count: 0, unresolved: false }
    }

    /// The unknowns of each candidate, in cut order.
    #[must_use]
    pub fn as_slice(&self) -> &[Six<S>] {
        &self.list[..self.count]
    }

    fn extend(&mut self, candidate: Option<Six<S>>) {
        let Some(candidate) = candidate else { return };
        if self.count < MOST {
            self.list[self.count] = candidate;
            self.count += 1;
        } else {
            self.unresolved = true;
        }
    }
}

/// `T(V^-1) v` at cosine and sine of a rotation.
fn unwind<S: Number>(v: &MarkedLine<S>, (cos, sin): (S, S)) -> MarkedLine<S> {
    let mut w = *v;
    for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
        w[x] = cos.mul(&v[x]).add(&sin.mul(&v[y]));
        w[y] = cos.mul(&v[y]).sub(&sin.mul(&v[x]));
    }
    w
}

fn apply<S: Number>(row: &MarkedLine<S::Real>, v: &MarkedLine<S>) -> S {
    row.iter().zip(v).fold(S::zero(), |sum, (r, x)| sum.add(&x.times(*r)))
}

impl<'a, S: Number> CutView<'a, S> {
    /// Prepares back-substitution for one cut.
    #[must_use]
    pub fn new(cut: &'a ClosedLoop<S::Real>, form: &'a HalfAngleForm<S::Real>, hidden: Hidden) -> Self {
        let inverse = |k: usize| {
            let back = cut.constants[k].inverse();
            Motion {
                rotation: back.rotation.map(|row| row.map(S::from_real)),
                translation: back.translation.map(S::from_real),
            }
        };
        let inverses = std::array::from_fn(inverse);
        let start = act(&inverse(5), &z_axis());
        Self { cut, form, hidden, inverses, start }
    }

    /// `T(G2^-1) u(q1, q2)` and the two pairs in cut order.
    fn behind_two(&self, hidden: (S, S), other: (S, S)) -> ([(S, S); 2], MarkedLine<S>) {
        let pairs = match self.hidden {
            Hidden::First => [hidden, other],
            Hidden::Second => [other, hidden],
        };
        let one = act(&self.inverses[0], &unwind(&self.start, pairs[0]));
        (pairs, act(&self.inverses[1], &unwind(&one, pairs[1])))
    }

    /// The pairs with which the unknowns of a root enter the motions, where one solution belongs to it.
    #[must_use]
    pub fn pairs_of(&self, hidden: (S, S), vector: &[S; 8]) -> Option<[(S, S); 6]> {
        let (other, third) = unknowns(vector)?;
        let (pairs, u) = self.behind_two(hidden, other);
        self.all_pairs(pairs, third, &u)
    }

    /// Unknowns 4, 5 and 6 from the first three.
    fn all_pairs(&self, pairs: [(S, S); 2], third: (S, S), u: &MarkedLine<S>) -> Option<[(S, S); 6]> {
        let r = act(&self.inverses[2], &unwind(u, third));
        let last = &self.form.last_monomials;
        let pair = |index: usize, k: usize| match self.cut.variables[index] {
            Variable::Rotation => normalised(apply(&last[k], &r), apply(&last[k + 1], &r)),
            Variable::Translation => Some((apply(&last[k], &r), S::zero())),
        };
        let fifth = pair(4, 0)?;
        let fourth = pair(3, 2)?;
        let values = [pairs[0], pairs[1], third, fourth, fifth];
        let frame: Motion<S> = product(self.cut, &values, 5);
        // V6 = (G6 V1 G1 ... V5 G5)^-1, a rotation about z.
        let g = &self.cut.constants[5].rotation;
        let entry = |i: usize, j: usize| (0..3).fold(S::zero(), |sum, k| sum.add(&frame.rotation[k][j].times(g[i][k])));
        let (cos, sin) = (entry(0, 0).add(&entry(1, 1)), entry(0, 1).sub(&entry(1, 0)));
        let sixth = normalised(cos.halved(), sin.halved())?;
        Some([values[0], values[1], values[2], values[3], values[4], sixth])
    }
}

impl<S: Scalar> CutView<'_, S> {
    /// All candidates of a root, given as cosine and sine of the hidden unknown and the kernel of the pencil there.
    #[must_use]
    pub fn candidates(&self, hidden: (S, S), kernel: &Kernel<S>) -> Candidates<S> {
        let mut found = Candidates::none();
        if kernel.dimension == 1 {
            found.extend(self.pairs_of(hidden, &kernel.basis[0]).map(|pairs| self.angles(&pairs)));
            return found;
        }
        // Several solutions share the hidden unknown: separate the other one inside the kernel.
        let others = separate(kernel).unwrap_or_else(|| {
            // A family: any value of the other unknown may do, so sample it and let the closure judge.
            found.unresolved = true;
            let mut samples = [None; 8];
            samples[..SAMPLES.len()].copy_from_slice(&SAMPLES.map(|angle| Some(sample(angle))));
            samples
        });
        for other in others.into_iter().flatten() {
            let (pairs, u) = self.behind_two(hidden, other);
            match self.third(&u) {
                Third::Free => {
                    found.unresolved = true;
                    for third in SAMPLES.map(sample) {
                        found.extend(self.complete(pairs, third, &u));
                    }
                }
                Third::Values(values) => {
                    for third in values.into_iter().flatten() {
                        found.extend(self.complete(pairs, third, &u));
                    }
                }
            }
        }
        found
    }

    fn complete(&self, pairs: [(S, S); 2], third: (S, S), u: &MarkedLine<S>) -> Option<Six<S>> {
        Some(self.angles(&self.all_pairs(pairs, third, u)?))
    }

    fn angles(&self, pairs: &[(S, S); 6]) -> Six<S> {
        std::array::from_fn(|j| match self.cut.variables[j] {
            Variable::Rotation => S::angle_of(pairs[j].0, pairs[j].1),
            Variable::Translation => pairs[j].0,
        })
    }

    /// Unknown 3 from the six equations free of unknowns 4 to 6: `A_c c3 + A_s s3 = rhs`.
    fn third(&self, u: &MarkedLine<S>) -> Third<S> {
        let rows: [(S, S, S); 6] = std::array::from_fn(|k| {
            let m = &self.form.free_of_last[k];
            let (mut a, mut b, mut rhs) = (S::zero(), S::zero(), S::zero());
            for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
                a = a.add(&u[x].times(m[x])).add(&u[y].times(m[y]));
                b = b.add(&u[y].times(m[x])).sub(&u[x].times(m[y]));
            }
            for i in FIXED {
                rhs = rhs.sub(&u[i].times(m[i]));
            }
            (a, b, rhs)
        });
        let weight = |r: &(S, S, S)| r.0.size().max(r.1.size());
        let mut first = rows[0];
        for row in &rows[1..] {
            if weight(row) > weight(&first) {
                first = *row;
            }
        }
        let (a, b, rhs) = first;
        let largest = weight(&first);
        let scale = u.iter().map(|x| x.size()).fold(0.0, f64::max);
        if !(largest > 1e-9 * scale) {
            return Third::Free;
        }
        // A second independent row, if there is one.
        let minor = |r: &(S, S, S)| a.mul(&r.1).sub(&b.mul(&r.0));
        let mut second = rows[0];
        for row in &rows[1..] {
            if minor(row).size() > minor(&second).size() {
                second = *row;
            }
        }
        let determinant = minor(&second);
        if determinant.size() > 1e-6 * largest * largest {
            let cos = rhs.mul(&second.1).sub(&b.mul(&second.2)).over(determinant);
            let sin = a.mul(&second.2).sub(&rhs.mul(&second.0)).over(determinant);
            return Third::Values([normalised(cos, sin), None]);
        }
        // One equation only: a c + b s = rhs has two solutions.
        let square = a.mul(&a).add(&b.mul(&b));
        let discriminant = square.sub(&rhs.mul(&rhs));
        if !(square.size() > 1e-12 * largest * largest)
            || (S::REAL && discriminant.to_complex().re < -1e-6 * square.size())
        {
            return Third::Values([None, None]);
        }
        let w = discriminant.root();
        let both = [w, w.neg()].map(|w| {
            let cos = a.mul(&rhs).sub(&b.mul(&w)).over(square);
            let sin = b.mul(&rhs).add(&a.mul(&w)).over(square);
            normalised(cos, sin)
        });
        Third::Values(both)
    }
}

/// The information on unknown 3 in the equations.
enum Third<S> {
    /// Nothing: every value fits.
    Free,
    /// One or two values as (cos, sin).
    Values([Option<(S, S)>; 2]),
}

/// (cos, sin) scaled to `cos^2 + sin^2 = 1`; `None` for what is no angle at all.
fn normalised<S: Number>(cos: S, sin: S) -> Option<(S, S)> {
    let norm = cos.mul(&cos).add(&sin.mul(&sin)).root();
    let size = cos.size().max(sin.size());
    (norm.size() > 1e2 * S::UNIT_ROUNDOFF.sqrt() * size && size.is_finite()).then(|| (cos.over(norm), sin.over(norm)))
}

/// The values of the other unknown for which the kernel holds a vector of the right shape: rows 0-2, 4-6 of the basis
/// times tan(q/2) equal rows 1-3, 5-7. The pair is first turned by a constant angle, against infinite tangents.
/// `None` where the kernel leaves a family.
fn separate<S: Scalar>(kernel: &Kernel<S>) -> Option<[Option<(S, S)>; 8]> {
    const TURN: f64 = 0.37;
    let m = kernel.dimension;
    let (sin, cos) = TURN.sin_cos();
    let low = [0, 1, 2, 4, 5, 6];
    let at = |v: usize, row: usize| kernel.basis[v][row];
    let s0 = |v: usize, k: usize| at(v, low[k]).times(cos).add(&at(v, low[k] + 1).times(sin));
    let s1 = |v: usize, k: usize| at(v, low[k] + 1).times(cos).sub(&at(v, low[k]).times(sin));
    // Normal equations of S0 Z = S1; their condition is that of S0 squared, good enough for a start.
    let gram = |f: &dyn Fn(usize, usize) -> S, a: usize, b: usize| {
        (0..6).fold(S::zero(), |sum, k| sum.add(&s0(a, k).conjugate().mul(&f(b, k))))
    };
    let mut matrix = [[S::zero(); 16]; 8];
    for a in 0..m {
        for b in 0..m {
            matrix[a][b] = gram(&s0, a, b);
            matrix[a][8 + b] = gram(&s1, a, b);
        }
    }
    for k in 0..m {
        let row = (k..m).max_by(|&i, &j| matrix[i][k].size().total_cmp(&matrix[j][k].size()))?;
        if !(matrix[row][k].size() > 1e-13) {
            return None;
        }
        matrix.swap(k, row);
        let pivot_row = matrix[k];
        for (i, target) in matrix.iter_mut().enumerate().take(m) {
            if i == k {
                continue;
            }
            let factor = target[k].over(pivot_row[k]);
            for (x, p) in target.iter_mut().zip(&pivot_row) {
                *x = x.sub(&factor.mul(p));
            }
        }
    }
    let z = |a: usize, b: usize| matrix[a][8 + b].over(matrix[a][a]).to_complex();
    let mut tangents = [Complex::new(f64::NAN, 0.0); 8];
    if m == 2 {
        let (half, product) = (0.5 * (z(0, 0) - z(1, 1)), z(0, 1) * z(1, 0));
        let (mean, root) = (0.5 * (z(0, 0) + z(1, 1)), (half * half + product).sqrt());
        (tangents[0], tangents[1]) = (mean + root, mean - root);
    } else {
        let entries: Vec<_> = (0..m * m).map(|k| z(k / m, k % m)).collect();
        for (slot, value) in tangents.iter_mut().zip(eigenvalues(m, &entries)) {
            *slot = value;
        }
    }
    Some(tangents.map(|tangent| {
        let near_real = tangent.im.abs() < 1e-4 * (1.0 + tangent.norm_sqr());
        if !tangent.is_finite() || (S::REAL && !near_real) {
            return None;
        }
        let tangent = S::from_complex(tangent);
        let (one, sin, cos) = (S::one(), S::from_f64(sin), S::from_f64(cos));
        double_angle(one.mul(&cos).sub(&tangent.mul(&sin)), tangent.mul(&cos).add(&one.mul(&sin)))
    }))
}
