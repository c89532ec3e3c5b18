//! Closed forms of six rotations of which three neighbouring axes meet in a point or are parallel.
//!
//! The three of them leave two equations between the other three: a point to reach, or a direction and a height. These are of
//! degree 4, or two quadratics where the geometry is more special still; then the three are found from their product, which
//! is a turn about a point or a motion of a plane. Eight candidates, over the complex numbers, and nothing is decided here of
//! whether they close the loop.

mod parallel;
mod wrist;

use super::scalar::Scalar;
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
use num_complex::Complex;

/// Cosine and sine of an angle.
pub type Pair<S> = (S, S);
/// A complex number.
type C64 = Complex<f64>;

/// No closed form has more candidates.
pub const MOST: usize = 8;
/// Largest part, relative to the larger one, of a planar vector that counts as zero, and of the product of two that count as
/// dependent: special incidences hold up to rounding.
const DEPENDENT: f64 = 1e-9;

/// The common property of three neighbouring axes of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Common {
    /// A point, at these heights on the first and on the last of the axes.
    Point([f64; 2]),
    /// Their direction.
    Direction,
}

/// Three neighbouring rotations, from `first` on, that a closed form takes out of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
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
pub struct Candidates {
    real: [Pairs<f64>; MOST],
    complex: [Pairs<C64>; MOST],
    counts: [usize; 2],
}

impl Default for Candidates {
    fn default() -> Self {
        let zero = C64::new(0.0, 0.0);
        Self { real: [[(0.0, 0.0); 6]; MOST], complex: [[(zero, zero); 6]; MOST], counts: [0; 2] }
    }
}

impl Candidates {
    /// The real ones.
    #[must_use]
    pub fn real(&self) -> &[Pairs<f64>] {
        &self.real[..self.counts[0]]
    }

    /// The complex ones, one of each pair of conjugates.
    #[must_use]
    pub fn complex(&self) -> &[Pairs<C64>] {
        &self.complex[..self.counts[1]]
    }

    /// Returns their number, conjugates included.
    #[must_use]
    pub fn count(&self) -> usize {
        self.counts[0] + 2 * self.counts[1]
    }

    fn push<S: Scalar>(&mut self, pairs: &Pairs<S>) {
        let kind = usize::from(!S::REAL);
        let at = self.counts[kind];
        if at < MOST {
            if S::REAL {
                self.real[at] = pairs.map(|(cos, sin)| (cos.to_complex().re, sin.to_complex().re));
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
    pub fn candidates(&self, closed: &ClosedLoop<f64>) -> Candidates {
        let mut found = Candidates::default();
        let own = Rotated { closed, first: self.first };
        match self.common {
            Common::Point(heights) => wrist::Wrist::of(own, heights).candidates(&mut found),
            Common::Direction => parallel::Parallel::of(own).candidates(&mut found),
        }
        found
    }
}

/// A loop read from behind its three special rotations D, E and F on: `A a B b C c D d E e F f = I` with constants in small
/// letters.
#[derive(Clone, Copy)]
struct Rotated<'a> {
    closed: &'a ClosedLoop<f64>,
    first: usize,
}

impl Rotated<'_> {
    /// The constant behind A, B, C, D, E or F.
    fn constant(&self, k: usize) -> &Motion<f64> {
        &self.closed.constants[(self.first + 3 + k) % 6]
    }

    /// The product of the loop up to and including the constant behind C.
    fn arm<S: Scalar>(&self, arm: &[Pair<S>; 3]) -> Motion<S> {
        let mut frame = lifted::<S>(self.constant(2));
        turn(&mut frame, &arm[2]);
        for k in [1, 0] {
            frame = before(self.constant(k), &frame);
            turn(&mut frame, &arm[k]);
        }
        frame
    }

    /// Lists the angles of A to F.
    fn push<S: Scalar>(&self, arm: &[Pair<S>; 3], three: &[Pair<S>; 3], found: &mut Candidates) {
        let mut pairs = [(S::zero(), S::zero()); 6];
        for (k, pair) in arm.iter().chain(three).enumerate() {
            pairs[(self.first + 3 + k) % 6] = *pair;
        }
        found.push(&pairs);
    }
}

/// The solutions of one equation in an angle: those of the type of its numbers, or where that is real and they are not, one
/// of the two that are conjugates.
struct Phases<S> {
    own: [Pair<S>; 2],
    count: usize,
    lifted: Option<Pair<C64>>,
}

/// The angles at which `row . (1, cos, sin) = 0`.
fn phases<S: Scalar>(row: &[S; 3]) -> Phases<S> {
    let [constant, cos, sin] = row;
    phases_of(row, &cos.mul(cos).add(&sin.mul(sin)).sub(&constant.mul(constant)))
}

/// The angles q at which `from . V(q) to` is the third coordinate of `seen`, all of them unit vectors.
///
/// The angles fall together where the three vectors lie in a plane. The discriminant is written so that it is not a difference of
/// numbers near 1 there, if `from` and `to` make the same angle with the axis: then angles that are 1e-14 apart are as exact as `seen`.
fn alignments<S: Scalar>(from: &[S; 3], to: &[S; 3], seen: &[S; 3]) -> Phases<S> {
    let mut row = between(from, to);
    row[0] = row[0].sub(&seen[2]);
    // 1 - z^2
    let planar = seen[0].mul(&seen[0]).add(&seen[1].mul(&seen[1]));
    // With heights h and k over the axis: (1 - h^2) (1 - k^2) - (z - h k)^2 = 1 - z^2 - (h - k)^2 - 2 h k (1 - z), and the same with -k, -z.
    let (one, is_up) = (S::from_f64(1.0), seen[2].to_complex().re >= 0.0);
    let (height, rest) = if is_up { (to[2], one.add(&seen[2])) } else { (to[2].neg(), one.sub(&seen[2])) };
    let Some(inverse) = rest.inverse() else { return phases(&row) };
    let off = from[2].sub(&height);
    let twice = from[2].mul(&height).times(2.0).mul(&inverse);
    phases_of(&row, &planar.mul(&one.sub(&twice)).sub(&off.mul(&off)))
}

/// The angles at which `row . (1, cos, sin) = 0`, with the square of the row over (cos, sin) less that of the constant.
fn phases_of<S: Scalar>([constant, cos, sin]: &[S; 3], under: &S) -> Phases<S> {
    let square = cos.mul(cos).add(&sin.mul(sin));
    let nothing = Phases { own: [(S::zero(), S::zero()); 2], count: 0, lifted: None };
    let Some(inverse) = square.inverse() else { return nothing };
    if S::REAL && under.to_complex().re < 0.0 {
        let [constant, cos, sin] = [constant, cos, sin].map(|x| x.to_complex().re);
        let root = C64::new(0.0, (-under.to_complex().re).sqrt());
        let inverse = inverse.to_complex().re;
        let pair = ((root * sin + constant * cos) * -inverse, (root * cos - constant * sin) * inverse);
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
fn between<S: Scalar>(from: &[S; 3], to: &[S; 3]) -> [S; 3] {
    [from[2].mul(&to[2]), from[0].mul(&to[0]).add(&from[1].mul(&to[1])), from[1].mul(&to[0]).sub(&from[0].mul(&to[1]))]
}

/// The angle that turns one planar vector into another one of its length; `None` where that is 0.
fn angle_between<S: Scalar>(from: (&S, &S), to: (&S, &S)) -> Option<Pair<S>> {
    let inverse = from.0.mul(from.0).add(&from.1.mul(from.1)).inverse()?;
    let cos = from.0.mul(to.0).add(&from.1.mul(to.1)).mul(&inverse);
    let sin = from.0.mul(to.1).sub(&from.1.mul(to.0)).mul(&inverse);
    Some((cos, sin))
}

/// `V(q) v`
fn turned<S: Scalar>((cos, sin): &Pair<S>, v: &[S; 3]) -> [S; 3] {
    [v[0].mul(cos).sub(&v[1].mul(sin)), v[0].mul(sin).add(&v[1].mul(cos)), v[2]]
}

/// `V(q) M` in place of M.
fn turn<S: Scalar>(frame: &mut Motion<S>, pair: &Pair<S>) {
    for j in 0..3 {
        let column = turned(pair, &[0, 1, 2].map(|i| frame.rotation[i][j]));
        for i in 0..2 {
            frame.rotation[i][j] = column[i];
        }
    }
    frame.translation = turned(pair, &frame.translation);
}

/// `R v` for the rotation of a constant.
fn rotated<S: Scalar>(constant: &Motion<f64>, v: &[S; 3]) -> [S; 3] {
    constant.rotation.map(|row| v[0].times(row[0]).add(&v[1].times(row[1])).add(&v[2].times(row[2])))
}

/// `R^T v` for the rotation of a constant.
fn rotated_back(constant: &Motion<f64>, v: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|j| (0..3).map(|i| constant.rotation[i][j] * v[i]).sum())
}

/// `constant * frame`
fn before<S: Scalar>(constant: &Motion<f64>, frame: &Motion<S>) -> Motion<S> {
    let columns: [[S; 3]; 3] =
        std::array::from_fn(|j| rotated(constant, &std::array::from_fn(|i| frame.rotation[i][j])));
    let moved = rotated(constant, &frame.translation);
    Motion {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])),
        translation: std::array::from_fn(|i| moved[i].add(&S::from_f64(constant.translation[i]))),
    }
}

/// A constant among numbers that may be complex.
fn lifted<S: Scalar>(constant: &Motion<f64>) -> Motion<S> {
    Motion {
        rotation: constant.rotation.map(|row| row.map(S::from_f64)),
        translation: constant.translation.map(S::from_f64),
    }
}

/// A vector among numbers that may be complex.
fn vector<S: Scalar>(v: [f64; 3]) -> [S; 3] {
    v.map(S::from_f64)
}

/// An angle among complex numbers.
fn complex<S: Scalar>((cos, sin): &Pair<S>) -> Pair<C64> {
    (cos.to_complex(), sin.to_complex())
}

/// Third row of a rotation, and third column.
fn axes<S: Scalar>(rotation: &[[S; 3]; 3]) -> [[S; 3]; 2] {
    [rotation[2], std::array::from_fn(|i| rotation[i][2])]
}
