//! Closed forms of six rotations of which three neighbouring axes meet in a point or are parallel.
//!
//! The three of them leave two equations between the other three: a point to reach, or a direction and a height. These are of
//! degree 4, or two quadratics where the geometry is more special still; then the three are found from their product, which
//! is a turn about a point or a motion of a plane. Eight candidates, over the complex numbers, and nothing is decided here of
//! whether they close the loop. One derivation serves f64 and numbers of more digits.

mod number;
mod parallel;
mod wrist;

pub use number::{Base, FormNumber};

use super::separated::{Angle, angles_of};
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
use number::Over;

/// Cosine and sine of an angle.
pub type Pair<S> = (S, S);

/// No closed form has more candidates.
pub const MOST: usize = 8;
/// Largest part, relative to the larger one, of a planar vector that counts as zero, and of the product of two that count as
/// dependent: special incidences hold up to rounding.
const DEPENDENT: f64 = 1e-9;

/// The common property of three neighbouring axes of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Common {
    /// A point.
    Point,
    /// Their direction.
    Direction,
}

/// Three neighbouring rotations, from `first` on, that a closed form takes out of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decoupled {
    /// The first of the three.
    pub first: usize,
    /// Their common property.
    pub common: Common,
}

/// Cosines and sines of six angles in the order of the loop, on the circle but for roundings and what the data are off.
pub type Pairs<S> = [Pair<S>; 6];

/// The candidates at one pose. Only one of two conjugates is listed.
#[derive(Clone, Debug)]
pub struct Candidates<R: Base = f64> {
    real: [Pairs<R>; MOST],
    complex: [Pairs<R::Complex>; MOST],
    counts: [usize; 2],
}

impl<R: Base> Default for Candidates<R> {
    fn default() -> Self {
        let real = [[(R::zero(), R::zero()); 6]; MOST];
        Self { real, complex: real.map(|pairs| pairs.each_ref().map(complex)), counts: [0; 2] }
    }
}

impl<R: Base> Candidates<R> {
    /// The real ones.
    #[must_use]
    pub fn real(&self) -> &[Pairs<R>] {
        &self.real[..self.counts[0]]
    }

    /// The complex ones, one of each pair of conjugates.
    #[must_use]
    pub fn complex(&self) -> &[Pairs<R::Complex>] {
        &self.complex[..self.counts[1]]
    }

    /// Returns their number, conjugates included.
    #[must_use]
    pub fn count(&self) -> usize {
        self.counts[0] + 2 * self.counts[1]
    }

    /// Returns the same candidates in f64.
    #[must_use]
    pub fn rounded(&self) -> Candidates {
        let mut rounded = Candidates { counts: self.counts, ..Candidates::default() };
        for (to, from) in rounded.real.iter_mut().zip(self.real()) {
            *to = from.map(|(cos, sin)| (cos.re(), sin.re()));
        }
        for (to, from) in rounded.complex.iter_mut().zip(self.complex()) {
            *to = from.map(|(cos, sin)| (cos.rounded(), sin.rounded()));
        }
        rounded
    }

    fn push<S: Over<R>>(&mut self, pairs: &Pairs<S>) {
        let kind = usize::from(!S::REAL);
        let at = self.counts[kind];
        if at < MOST {
            if S::REAL {
                self.real[at] = pairs.map(|(cos, sin)| (cos.real(), sin.real()));
            } else {
                self.complex[at] = pairs.each_ref().map(complex);
            }
            self.counts[kind] += 1;
        }
    }
}

impl Decoupled {
    /// All candidates of a loop of six rotations.
    #[must_use]
    pub fn candidates<R: Base>(&self, closed: &ClosedLoop<R>) -> Candidates<R> {
        let mut found = Candidates::default();
        let own = Rotated { closed, first: self.first };
        match self.common {
            Common::Point => {
                if let Some(wrist) = wrist::Wrist::of(own) {
                    wrist.candidates(&mut found);
                }
            }
            Common::Direction => parallel::Parallel::of(own).candidates(&mut found),
        }
        found
    }
}

/// Returns the height on the z axis of the place that is nearest to its image under a link; `None` where both are parallel.
#[must_use]
pub fn height<R: Base>(link: &Motion<R>) -> Option<R> {
    let ([x, y, z], [u, v, w]) = (&link.translation, [0, 1, 2].map(|i| &link.rotation[i][2]));
    let square = u.mul(u).add(&v.mul(v));
    Some(z.sub(&w.mul(&x.mul(u).add(&y.mul(v))).mul(&square.inverse()?)))
}

/// A loop read from behind its three special rotations D, E and F on: `A a B b C c D d E e F f = I` with constants in small
/// letters.
struct Rotated<'a, R> {
    closed: &'a ClosedLoop<R>,
    first: usize,
}

impl<R: Base> Rotated<'_, R> {
    /// The constant behind A, B, C, D, E or F.
    fn constant(&self, k: usize) -> &Motion<R> {
        &self.closed.constants[(self.first + 3 + k) % 6]
    }

    /// The product of the loop up to and including the constant behind C.
    fn arm<S: Over<R>>(&self, arm: &[Pair<S>; 3]) -> Motion<S> {
        let mut frame = lifted::<S>(self.constant(2));
        turn(&mut frame, &arm[2]);
        for k in [1, 0] {
            frame = before(self.constant(k), &frame);
            turn(&mut frame, &arm[k]);
        }
        frame
    }

    /// Lists the angles of A to F.
    fn push<S: Over<R>>(&self, arm: &[Pair<S>; 3], three: &[Pair<S>; 3], found: &mut Candidates<R>) {
        let mut pairs = [(S::zero(), S::zero()); 6];
        for (k, pair) in arm.iter().chain(three).enumerate() {
            pairs[(self.first + 3 + k) % 6] = *pair;
        }
        found.push(&pairs);
    }
}

/// The solutions of one equation in an angle: those of the type of its numbers, or where that is real and they are not, one
/// of the two that are conjugates.
struct Phases<S: FormNumber> {
    own: [Pair<S>; 2],
    count: usize,
    lifted: Option<Pair<S::Complex>>,
}

/// The angles at which `row . (1, cos, sin) = 0`.
fn phases<S: FormNumber>(row: &[S; 3]) -> Phases<S> {
    let [constant, cos, sin] = row;
    phases_of(row, &cos.mul(cos).add(&sin.mul(sin)).sub(&constant.mul(constant)))
}

/// The angles q at which `from . V(q) to` is the third coordinate of `seen`, all of them unit vectors.
///
/// The angles fall together where the three vectors lie in a plane. The discriminant is written so that it is not a difference of
/// numbers near 1 there, if `from` and `to` make the same angle with the axis: then angles that are 1e-14 apart are as exact as `seen`.
fn alignments<S: FormNumber>(from: &[S; 3], to: &[S; 3], seen: &[S; 3]) -> Phases<S> {
    let mut row = between(from, to);
    row[0] = row[0].sub(&seen[2]);
    // 1 - z^2
    let planar = seen[0].mul(&seen[0]).add(&seen[1].mul(&seen[1]));
    // With heights h and k over the axis: (1 - h^2) (1 - k^2) - (z - h k)^2 = 1 - z^2 - (h - k)^2 - 2 h k (1 - z), and the same with -k, -z.
    let (one, is_up) = (S::one(), seen[2].re() >= 0.0);
    let (height, rest) = if is_up { (to[2], one.add(&seen[2])) } else { (to[2].neg(), one.sub(&seen[2])) };
    let Some(inverse) = rest.inverse() else { return phases(&row) };
    let off = from[2].sub(&height);
    let product = from[2].mul(&height).mul(&inverse);
    let twice = product.add(&product);
    phases_of(&row, &planar.mul(&one.sub(&twice)).sub(&off.mul(&off)))
}

/// The angles at which `row . (1, cos, sin) = 0`, with the square of the row over (cos, sin) less that of the constant.
fn phases_of<S: FormNumber>([constant, cos, sin]: &[S; 3], under: &S) -> Phases<S> {
    let square = cos.mul(cos).add(&sin.mul(sin));
    let nothing = Phases { own: [(S::zero(), S::zero()); 2], count: 0, lifted: None };
    let Some(inverse) = square.inverse() else { return nothing };
    if S::REAL && under.re() < 0.0 {
        let [constant, cos, sin, inverse] = [*constant, *cos, *sin, inverse].map(S::real);
        let root = under.neg().root().real();
        let pair = (
            S::joined(constant.mul(&cos).neg().mul(&inverse), root.mul(&sin).neg().mul(&inverse)),
            S::joined(constant.mul(&sin).neg().mul(&inverse), root.mul(&cos).mul(&inverse)),
        );
        return Phases { lifted: Some(pair), ..nothing };
    }
    let root = under.root();
    let at = |w: &S| {
        let c = constant.mul(cos).add(&sin.mul(w)).neg().mul(&inverse);
        let s = cos.mul(w).sub(&constant.mul(sin)).mul(&inverse);
        (c, s)
    };
    Phases { own: [at(&root), at(&root.neg())], count: 2, ..nothing }
}

/// `from . V(q) to` as a row over (1, cos, sin), of vectors V turns about the third axis.
fn between<S: FormNumber>(from: &[S; 3], to: &[S; 3]) -> [S; 3] {
    [from[2].mul(&to[2]), from[0].mul(&to[0]).add(&from[1].mul(&to[1])), from[1].mul(&to[0]).sub(&from[0].mul(&to[1]))]
}

/// The angle that turns one planar vector into another one of its length; `None` where that is 0.
fn angle_between<S: FormNumber>(from: (&S, &S), to: (&S, &S)) -> Option<Pair<S>> {
    let inverse = from.0.mul(from.0).add(&from.1.mul(from.1)).inverse()?;
    let cos = from.0.mul(to.0).add(&from.1.mul(to.1)).mul(&inverse);
    let sin = from.0.mul(to.1).sub(&from.1.mul(to.0)).mul(&inverse);
    Some((cos, sin))
}

/// `V(q) v`
fn turned<S: FormNumber>((cos, sin): &Pair<S>, v: &[S; 3]) -> [S; 3] {
    [v[0].mul(cos).sub(&v[1].mul(sin)), v[0].mul(sin).add(&v[1].mul(cos)), v[2]]
}

/// `V(q) M` in place of M.
fn turn<S: FormNumber>(frame: &mut Motion<S>, pair: &Pair<S>) {
    for j in 0..3 {
        let column = turned(pair, &[0, 1, 2].map(|i| frame.rotation[i][j]));
        for i in 0..2 {
            frame.rotation[i][j] = column[i];
        }
    }
    frame.translation = turned(pair, &frame.translation);
}

/// `R v` for the rotation of a constant.
fn rotated<S: FormNumber>(constant: &Motion<S::Real>, v: &[S; 3]) -> [S; 3] {
    constant.rotation.map(|row| v[0].times(row[0]).add(&v[1].times(row[1])).add(&v[2].times(row[2])))
}

/// `R^T v` for the rotation of a constant.
fn rotated_back<S: FormNumber>(constant: &Motion<S::Real>, v: &[S; 3]) -> [S; 3] {
    let [row, next, last] = &constant.rotation;
    std::array::from_fn(|j| v[0].times(row[j]).add(&v[1].times(next[j])).add(&v[2].times(last[j])))
}

fn dot<R: FormNumber>(x: &[R; 3], y: &[R; 3]) -> R {
    x[0].mul(&y[0]).add(&x[1].mul(&y[1])).add(&x[2].mul(&y[2]))
}

/// The angles at which a quadratic form in (1, cos, sin) vanishes, handed to either function.
fn each_angle<R: Base, T>(
    conic: &[[R; 3]; 3],
    to: &mut T,
    real: impl Fn(Pair<R>, &mut T),
    complex: impl Fn(Pair<R::Complex>, &mut T),
) {
    let rounded = conic.map(|row| row.map(R::re));
    for angle in angles_of(&rounded).into_iter().flatten() {
        match angle {
            Angle::Real((cos, sin)) => real(improved(conic, (R::of(cos.into()), R::of(sin.into()))), to),
            Angle::Complex((cos, sin)) => complex(improved(conic, (FormNumber::of(cos), FormNumber::of(sin))), to),
        }
    }
}

/// A zero on the circle of a quadratic form in (1, cos, sin), from one known in f64: Newton's method in cosine and sine.
fn improved<S: FormNumber>(conic: &[[S::Real; 3]; 3], (mut cos, mut sin): Pair<S>) -> Pair<S> {
    for _ in 0..S::DOUBLINGS {
        let monomials = [S::one(), cos, sin];
        let row = |k: usize, of: usize| {
            // The form need not be symmetric.
            let entry = if of == 0 { conic[k] } else { [0, 1, 2].map(|i| conic[i][k]) };
            monomials[0].times(entry[0]).add(&monomials[1].times(entry[1])).add(&monomials[2].times(entry[2]))
        };
        let value = (0..3).fold(S::zero(), |sum, k| sum.add(&monomials[k].mul(&row(k, 0))));
        let [by_cos, by_sin] = [1, 2].map(|k| row(k, 0).add(&row(k, 1)));
        let off = cos.mul(&cos).add(&sin.mul(&sin)).sub(&S::one()).halved();
        // (by_cos, by_sin) . (x, y) = value and (cos, sin) . (x, y) = off
        let Some(inverse) = by_cos.mul(&sin).sub(&by_sin.mul(&cos)).inverse() else { break };
        let x = value.mul(&sin).sub(&by_sin.mul(&off)).mul(&inverse);
        let y = by_cos.mul(&off).sub(&value.mul(&cos)).mul(&inverse);
        (cos, sin) = (cos.sub(&x), sin.sub(&y));
    }
    (cos, sin)
}

/// `constant * frame`
fn before<S: FormNumber>(constant: &Motion<S::Real>, frame: &Motion<S>) -> Motion<S> {
    let columns: [[S; 3]; 3] =
        std::array::from_fn(|j| rotated(constant, &std::array::from_fn(|i| frame.rotation[i][j])));
    let moved = rotated(constant, &frame.translation);
    Motion {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])),
        translation: std::array::from_fn(|i| moved[i].add(&S::from_real(constant.translation[i]))),
    }
}

/// A constant among numbers that may be complex.
fn lifted<S: FormNumber>(constant: &Motion<S::Real>) -> Motion<S> {
    Motion {
        rotation: constant.rotation.map(|row| row.map(S::from_real)),
        translation: constant.translation.map(S::from_real),
    }
}

/// A vector among numbers that may be complex.
fn vector<S: FormNumber>(v: [S::Real; 3]) -> [S; 3] {
    v.map(S::from_real)
}

/// An angle among complex numbers.
fn complex<S: FormNumber>((cos, sin): &Pair<S>) -> Pair<S::Complex> {
    (cos.lifted(), sin.lifted())
}

/// Third row of a rotation, and third column.
fn axes<S: FormNumber>(rotation: &[[S; 3]; 3]) -> [[S; 3]; 2] {
    [rotation[2], std::array::from_fn(|i| rotation[i][2])]
}
