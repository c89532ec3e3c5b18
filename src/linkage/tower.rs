//! Numbers that square roots lead to: towers of quadratic extensions of the rational numbers.
//!
//! Every number of a dyad is one of the field of its data, or of that field with one square root more. The first
//! generator is i. Whether a number of the tower is zero, or a square there, is decided.

use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::isotropic::BITS;
use rug::{Float, Integer, Rational};
use std::sync::Arc;

/// The generators of a tower: their squares, each by its coefficients in the tower below it, and their values.
#[derive(Debug, Default)]
struct Tower {
    squares: Vec<Vec<Rational>>,
    values: Vec<Disc>,
}

/// A number of a tower. Its coefficients belong to the products of generators: bit k of an index is generator k.
#[derive(Clone, Debug)]
pub struct Surd {
    tower: Arc<Tower>,
    coefficients: Vec<Rational>,
}

impl PartialEq for Surd {
    fn eq(&self, other: &Self) -> bool {
        let length = self.coefficients.len().max(other.coefficients.len());
        let zero = Rational::new();
        (0..length).all(|k| self.coefficients.get(k).unwrap_or(&zero) == other.coefficients.get(k).unwrap_or(&zero))
    }
}

/// The least power of two coefficients that hold the number.
fn trimmed(mut coefficients: Vec<Rational>) -> Vec<Rational> {
    while coefficients.len() > 1 && coefficients[coefficients.len() / 2..].iter().all(|c| *c == 0) {
        coefficients.truncate(coefficients.len() / 2);
    }
    coefficients
}

fn sum(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let mut total = long.to_vec();
    for (x, y) in total.iter_mut().zip(short) {
        *x += y;
    }
    total
}

fn negative(a: &[Rational]) -> Vec<Rational> {
    a.iter().map(|x| Rational::from(-x)).collect()
}

impl Tower {
    /// The number of generators that coefficients speak of.
    fn height(a: &[Rational]) -> usize {
        a.len().ilog2() as usize
    }

    fn product(&self, a: &[Rational], b: &[Rational]) -> Vec<Rational> {
        let (a, b) = if a.len() < b.len() { (b, a) } else { (a, b) };
        if a.len() == 1 {
            return vec![Rational::from(&a[0] * &b[0])];
        }
        let (low, high) = a.split_at(a.len() / 2);
        if b.len() < a.len() {
            return self.joined(&self.product(low, b), &self.product(high, b), a.len() / 2);
        }
        let (other_low, other_high) = b.split_at(b.len() / 2);
        let square = &self.squares[Self::height(a) - 1];
        let first = sum(&self.product(low, other_low), &self.product(&self.product(high, other_high), square));
        let second = sum(&self.product(low, other_high), &self.product(high, other_low));
        self.joined(&first, &second, a.len() / 2)
    }

    /// Returns `low + high s`, where s is the generator above `half` coefficients.
    #[expect(clippy::unused_self, reason = "it reads as the other operations of the tower")]
    fn joined(&self, low: &[Rational], high: &[Rational], half: usize) -> Vec<Rational> {
        let mut all = low.to_vec();
        all.resize(half, Rational::new());
        all.extend(high.iter().cloned());
        all.resize(2 * half, Rational::new());
        trimmed(all)
    }

    fn inverse(&self, a: &[Rational]) -> Option<Vec<Rational>> {
        if a.len() == 1 {
            return (a[0] != 0).then(|| vec![Rational::from(a[0].recip_ref())]);
        }
        let (low, high) = a.split_at(a.len() / 2);
        let square = &self.squares[Self::height(a) - 1];
        let norm = sum(&self.product(low, low), &negative(&self.product(&self.product(high, high), square)));
        let norm = self.inverse(&trimmed(norm))?;
        let conjugate = self.joined(low, &negative(high), a.len() / 2);
        Some(self.product(&conjugate, &norm))
    }

    /// A square root within the first `height` generators.
    fn square_root(&self, a: &[Rational], height: usize) -> Option<Vec<Rational>> {
        let a = trimmed(a.to_vec());
        if height == 0 {
            return (a.len() == 1).then(|| rational_root(&a[0]).map(|root| vec![root]))?;
        }
        let half = 1 << (height - 1);
        let square = &self.squares[height - 1];
        if a.len() <= half {
            if let Some(root) = self.square_root(&a, height - 1) {
                return Some(root);
            }
            let over = trimmed(self.product(&a, &self.inverse(square)?));
            return self.square_root(&over, height - 1).map(|root| self.joined(&[Rational::new()], &root, half));
        }
        // (u + v s)^2 = a0 + a1 s: u^2 = (a0 +- n)/2 with n^2 = a0^2 - a1^2 s^2, v = a1/(2 u).
        let (low, high) = a.split_at(half);
        let (low, high) = (trimmed(low.to_vec()), trimmed(high.to_vec()));
        let norm = sum(&self.product(&low, &low), &negative(&self.product(&self.product(&high, &high), square)));
        let norm = self.square_root(&norm, height - 1)?;
        let two = [Rational::from((1, 2))];
        for norm in [norm.clone(), negative(&norm)] {
            let candidate = trimmed(self.product(&sum(&low, &norm), &two));
            if candidate.iter().all(|c| *c == 0) {
                continue;
            }
            if let Some(u) = self.square_root(&candidate, height - 1) {
                let v = self.product(&self.product(&high, &two), &self.inverse(&trimmed(u.clone()))?);
                return Some(self.joined(&u, &v, half));
            }
        }
        None
    }
}

/// The square root of a rational number, if it is rational.
fn rational_root(q: &Rational) -> Option<Rational> {
    let root = |n: &Integer| n.is_perfect_square().then(|| Integer::from(n.sqrt_ref()));
    Some(Rational::from((root(q.numer())?, root(q.denom())?)))
}

impl Surd {
    /// A rational number.
    #[must_use]
    pub fn rational(q: &Rational) -> Self {
        Self { tower: Arc::default(), coefficients: vec![q.clone()] }
    }

    /// An exact complex number.
    #[must_use]
    pub fn gaussian(z: &Gaussian) -> Self {
        if z.im == 0 {
            return Self::rational(&z.re);
        }
        let i = Disc::point(Float::new(BITS), Float::with_val(BITS, 1));
        let tower = Tower { squares: vec![vec![Rational::from(-1)]], values: vec![i] };
        Self { tower: Arc::new(tower), coefficients: vec![z.re.clone(), z.im.clone()] }
    }

    /// The number as a complex one with rational parts, if it is one.
    #[must_use]
    pub fn to_gaussian(&self) -> Option<Gaussian> {
        match self.coefficients.as_slice() {
            [re] => Some(Gaussian { re: re.clone(), im: Rational::new() }),
            [re, im] => Some(Gaussian { re: re.clone(), im: im.clone() }),
            _ => None,
        }
    }

    /// The number of generators of its tower.
    #[must_use]
    pub fn height(&self) -> usize {
        self.tower.squares.len()
    }

    /// Returns the same number in the tower of another one, which contains its own tower.
    #[must_use]
    pub fn lifted(&self, other: &Self) -> Self {
        Self { tower: self.tower_with(other), coefficients: self.coefficients.clone() }
    }

    /// The tower of two numbers, of which one holds the other.
    fn tower_with(&self, other: &Self) -> Arc<Tower> {
        Arc::clone(if self.height() < other.height() { &other.tower } else { &self.tower })
    }

    fn combined(&self, other: &Self, operation: impl Fn(&Tower, &[Rational], &[Rational]) -> Vec<Rational>) -> Self {
        let tower = self.tower_with(other);
        let coefficients = trimmed(operation(&tower, &self.coefficients, &other.coefficients));
        Self { tower, coefficients }
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        self.combined(other, |_, a, b| sum(a, b))
    }

    /// The difference.
    #[must_use]
    pub fn sub(&self, other: &Self) -> Self {
        self.combined(other, |_, a, b| sum(a, &negative(b)))
    }

    /// The product.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        self.combined(other, Tower::product)
    }

    /// The negative.
    #[must_use]
    pub fn neg(&self) -> Self {
        Self { tower: Arc::clone(&self.tower), coefficients: negative(&self.coefficients) }
    }

    /// Whether it is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.coefficients.iter().all(|c| *c == 0)
    }

    /// The inverse; `None` for zero.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let coefficients = self.tower.inverse(&trimmed(self.coefficients.clone()))?;
        Some(Self { tower: Arc::clone(&self.tower), coefficients: trimmed(coefficients) })
    }

    /// The disc of its value.
    #[must_use]
    pub fn disc(&self) -> Disc {
        let term = |(index, c): (usize, &Rational)| {
            let generators = self.tower.values.iter().enumerate().filter(|(k, _)| index >> k & 1 == 1);
            generators.fold(Disc::of(c, BITS), |product, (_, value)| product.mul(value))
        };
        let terms = self.coefficients.iter().enumerate().filter(|(_, c)| **c != 0).map(term);
        terms.fold(Disc::zero(), |total, term| total.add(&term))
    }

    /// A square root: in the tower where there is one, else in the tower with one generator more, whose value is `root`.
    #[must_use]
    pub fn square_root(&self, root: &Disc) -> Self {
        // The tower without i has room for no complex numbers.
        let here = if self.height() == 0 {
            Self::gaussian(&Gaussian { re: Rational::new(), im: Rational::from(1) })
        } else {
            self.clone()
        };
        let tower = here.tower;
        if let Some(coefficients) = tower.square_root(&self.coefficients, tower.squares.len()) {
            return Self { tower, coefficients: trimmed(coefficients) };
        }
        let mut squares = tower.squares.clone();
        let mut values = tower.values.clone();
        squares.push(trimmed(self.coefficients.clone()));
        values.push(root.clone());
        let half = 1 << (squares.len() - 1);
        let mut coefficients = vec![Rational::new(); 2 * half];
        coefficients[half] = Rational::from(1);
        Self { tower: Arc::new(Tower { squares, values }), coefficients }
    }
}
