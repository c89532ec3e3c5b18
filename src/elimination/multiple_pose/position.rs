//! The positions of a plate whose rotation is known.

use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::platform::Platform;
use rug::{Integer, Rational};

/// One position or two: six spheres whose centres lie in a plane meet in mirror images.
#[derive(Clone, Debug)]
pub enum Positions {
    /// A single one.
    One(Vector<Algebraic>),
    /// Two.
    Two(Box<Pair>),
}

/// Two positions on a line, `base + s direction` with `alpha s^2 + 2 beta s + gamma = 0`.
#[derive(Clone, Debug)]
pub struct Pair {
    base: Vector<Algebraic>,
    direction: Vector<Algebraic>,
    alpha: Algebraic,
    beta: Algebraic,
    /// `beta^2 - alpha gamma`, not zero.
    pub discriminant: Algebraic,
}

impl Pair {
    /// The root of a discriminant that is the square of a rational number.
    pub fn root(&self) -> Option<Algebraic> {
        let square = self.discriminant.rational()?;
        let is_square = square.numer().is_perfect_square() && square.denom().is_perfect_square();
        let root = |n: &Integer| Integer::from(n.sqrt_ref());
        is_square
            .then(|| Rational::from((root(square.numer()), root(square.denom()))))
            .and_then(|root| <Algebraic as Ring>::from_rational(&root))
    }

    /// The position that belongs to a root of the discriminant.
    pub fn at(&self, root: &Algebraic) -> Option<Vector<Algebraic>> {
        let s = root.sub(&self.beta).mul(&self.alpha.inverse()?);
        Some(std::array::from_fn(|k| self.base[k].add(&s.mul(&self.direction[k]))))
    }
}

/// Returns all positions at which the six legs have their lengths; `None` where there is no position, or a curve of them.
pub fn positions(
    platform: &Platform<Algebraic>,
    squares: &[Algebraic; 6],
    x: &Quaternion<Algebraic>,
) -> Option<Positions> {
    let norm = x.norm().inverse()?;
    let rotation = x.scaled_rotation();
    // The leg is p - c with c = a - R b.
    let centres: [Vector<Algebraic>; 6] = std::array::from_fn(|i| {
        std::array::from_fn(|k| platform.base[i][k].sub(&dot(&rotation[k], &platform.plate[i]).mul(&norm)))
    });
    let differences = (1..6).map(|i| {
        let slope: Vector<Algebraic> = std::array::from_fn(|k| centres[i][k].sub(&centres[0][k]));
        let twice = slope.each_ref().map(|c| c.add(c));
        let value = dot(&centres[i], &centres[i]).sub(&dot(&centres[0], &centres[0]));
        let value = value.sub(&squares[i]).add(&squares[0]);
        let [a, b, c] = twice;
        [a, b, c, value]
    });
    let rows = solved(differences.collect())?;
    let free: Vec<usize> = (0..3).filter(|&k| rows.iter().all(|(column, _)| *column != k)).collect();
    let mut base = [Algebraic::zero(), Algebraic::zero(), Algebraic::zero()];
    for (column, row) in &rows {
        base[*column] = row[3].clone();
    }
    let from_first: Vector<Algebraic> = std::array::from_fn(|k| base[k].sub(&centres[0][k]));
    let gamma = dot(&from_first, &from_first).sub(&squares[0]);
    match free.as_slice() {
        [] => gamma.is_zero().then_some(Positions::One(base)),
        [free] => {
            let mut direction = [Algebraic::zero(), Algebraic::zero(), Algebraic::zero()];
            direction[*free] = Algebraic::one();
            for (column, row) in &rows {
                direction[*column] = row[*free].neg();
            }
            let (alpha, beta) = (dot(&direction, &direction), dot(&direction, &from_first));
            let discriminant = beta.mul(&beta).sub(&alpha.mul(&gamma));
            let pair = Pair { base, direction, alpha, beta, discriminant };
            if pair.discriminant.is_zero() {
                return pair.at(&Algebraic::zero()).map(Positions::One);
            }
            Some(Positions::Two(Box::new(pair)))
        }
        _ => None,
    }
}

/// Linear equations `row[..3].p = row[3]` in reduced echelon form, with their pivots; `None` where they contradict each other.
fn solved(mut rows: Vec<[Algebraic; 4]>) -> Option<Vec<(usize, [Algebraic; 4])>> {
    let mut done: Vec<(usize, [Algebraic; 4])> = Vec::new();
    for column in 0..3 {
        let Some(at) = rows.iter().position(|row| !row[column].is_zero()) else { continue };
        let row = rows.swap_remove(at);
        let inverse = row[column].inverse()?;
        let row = row.map(|x| x.mul(&inverse));
        let clear = |other: &mut [Algebraic; 4]| {
            let factor = other[column].neg();
            for (x, y) in other.iter_mut().zip(&row) {
                *x = x.add(&factor.mul(y));
            }
        };
        rows.iter_mut().for_each(clear);
        for (_, other) in &mut done {
            clear(other);
        }
        done.push((column, row));
    }
    rows.iter().all(|row| row[3].is_zero()).then_some(done)
}
