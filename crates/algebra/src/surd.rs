//! Sums of cosines of rational parts of a turn times square roots of rationals: numbers that files write as `cos(40 deg)` or
//! `sqrt(2)/2`, before a field is known that holds all of them.

use rug::{Complete, Integer, Rational};
use std::collections::BTreeMap;

/// Sums with more terms are given up: a file that needs them lies in no small field.
const MOST_TERMS: usize = 256;
/// Radicands with more bits are given up.
const LONGEST: u32 = 512;
/// Square factors are taken out for primes up to this; others stay, which does no harm.
const TRIAL: u32 = 200;

/// A sum of rational multiples of `cos(2 pi turn) sqrt(radicand)`, the turn from 0 to below 1/4 and the radicand positive.
/// Different sums may have the same value, which [`super::real_field::RealField`] decides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Surd {
    terms: BTreeMap<(Rational, Integer), Rational>,
}

/// A quotient of two sums.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Closed {
    /// The dividend.
    pub numerator: Surd,
    /// The divisor, whose value is not 0.
    pub denominator: Surd,
}

impl Surd {
    /// Returns a rational number.
    #[must_use]
    pub fn rational(q: Rational) -> Self {
        Self::term(Rational::new(), Integer::from(1), q)
    }

    /// Returns `factor cos(2 pi turn) sqrt(radicand)` for a turn in its range.
    fn term(turn: Rational, radicand: Integer, factor: Rational) -> Self {
        let mut terms = BTreeMap::new();
        if factor != 0 {
            terms.insert((turn, radicand), factor);
        }
        Self { terms }
    }

    /// Returns `cos(2 pi turn)`.
    #[must_use]
    pub fn cosine(turn: &Rational) -> Self {
        let (turn, sign) = reduced(turn.clone());
        if turn == Rational::from((1, 4)) {
            return Self { terms: BTreeMap::new() };
        }
        // The only other cosines that are rational.
        if turn == Rational::from((1, 6)) {
            return Self::rational(Rational::from((sign, 2)));
        }
        Self::term(turn, Integer::from(1), Rational::from(sign))
    }

    /// Returns the square root of a rational number that is not negative; `None` for a very long one.
    #[must_use]
    pub fn square_root(q: &Rational) -> Option<Self> {
        let mut radicand = Integer::from(q.numer() * q.denom());
        if radicand < 0 || radicand.significant_bits() > LONGEST {
            return None;
        }
        if radicand == 0 {
            return Some(Self { terms: BTreeMap::new() });
        }
        let mut root = Rational::from((Integer::from(1), q.denom().clone()));
        for factor in 2..TRIAL {
            let square = Integer::from(factor * factor);
            while radicand.is_divisible(&square) {
                radicand.div_exact_mut(&square);
                root *= factor;
            }
        }
        if radicand.is_perfect_square() {
            root *= radicand.sqrt();
            radicand = Integer::from(1);
        }
        Some(Self::term(Rational::new(), radicand, root))
    }

    /// Returns the terms: turn, radicand, factor.
    pub fn terms(&self) -> impl Iterator<Item = (&Rational, &Integer, &Rational)> {
        self.terms.iter().map(|((turn, radicand), factor)| (turn, radicand, factor))
    }

    /// Returns the sum as a rational, if it is written as one.
    fn as_rational(&self) -> Option<Rational> {
        let mut terms = self.terms();
        match (terms.next(), terms.next()) {
            (None, _) => Some(Rational::new()),
            (Some((turn, radicand, factor)), None) if turn.is_zero() && *radicand == 1 => Some(factor.clone()),
            _ => None,
        }
    }

    /// Returns whether the sum is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    fn note(&mut self, turn: Rational, radicand: Integer, factor: Rational) {
        let total = self.terms.entry((turn, radicand)).or_default();
        *total += factor;
    }

    fn checked(mut self) -> Option<Self> {
        self.terms.retain(|_, factor| *factor != 0);
        let is_short = self.terms.len() <= MOST_TERMS
            && self.terms.iter().all(|((_, r), q)| {
                r.significant_bits() <= LONGEST
                    && q.numer().significant_bits() + q.denom().significant_bits() < 8 * LONGEST
            });
        is_short.then_some(self)
    }

    fn add(&self, other: &Self) -> Option<Self> {
        let mut sum = self.clone();
        for (turn, radicand, factor) in other.terms() {
            sum.note(turn.clone(), radicand.clone(), factor.clone());
        }
        sum.checked()
    }

    fn mul(&self, other: &Self) -> Option<Self> {
        let mut product = Self { terms: BTreeMap::new() };
        for (a, r, x) in self.terms() {
            for (b, s, y) in other.terms() {
                let common = r.gcd_ref(s).complete();
                let radicand = Integer::from(r * s) / Integer::from(common.square_ref());
                let factor = Rational::from(x * y) * common;
                // 2 cos a cos b = cos(a + b) + cos(a - b).
                let half = factor / 2;
                for turn in [Rational::from(a + b), Rational::from(a - b)] {
                    for (turn, _, sign) in Self::cosine(&turn).terms() {
                        product.note(turn.clone(), radicand.clone(), Rational::from(&half * sign));
                    }
                }
            }
        }
        product.checked()
    }

    fn neg(&self) -> Self {
        let terms = self.terms.iter().map(|(key, factor)| (key.clone(), Rational::from(-factor))).collect();
        Self { terms }
    }
}

/// Returns the turn from 0 to 1/4 with the same cosine up to sign, and the sign.
fn reduced(turn: Rational) -> (Rational, i32) {
    let floor = Rational::from(turn.floor_ref());
    let mut turn = turn - floor;
    if turn > Rational::from((1, 2)) {
        turn = 1 - turn;
    }
    if turn > Rational::from((1, 4)) { (Rational::from((1, 2)) - turn, -1) } else { (turn, 1) }
}

impl From<Surd> for Closed {
    fn from(numerator: Surd) -> Self {
        Self { numerator, denominator: Surd::rational(Rational::from(1)) }
    }
}

impl Closed {
    /// Returns a rational number.
    #[must_use]
    pub fn rational(q: Rational) -> Self {
        Surd::rational(q).into()
    }

    /// Returns an integer.
    #[must_use]
    pub fn from_small(n: i32) -> Self {
        Self::rational(Rational::from(n))
    }

    /// Returns the number as a rational, if it is written as one.
    #[must_use]
    pub fn as_rational(&self) -> Option<Rational> {
        Some(self.numerator.as_rational()? / self.denominator.as_rational().filter(|q| !q.is_zero())?)
    }

    /// Returns the sum, unless it becomes too long.
    #[must_use]
    pub fn add(&self, other: &Self) -> Option<Self> {
        if self.denominator == other.denominator {
            return Some(Self {
                numerator: self.numerator.add(&other.numerator)?,
                denominator: self.denominator.clone(),
            });
        }
        let numerator = self.numerator.mul(&other.denominator)?.add(&other.numerator.mul(&self.denominator)?)?;
        Some(Self { numerator, denominator: self.denominator.mul(&other.denominator)? })
    }

    /// Returns the product, unless it becomes too long.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Option<Self> {
        Some(Self {
            numerator: self.numerator.mul(&other.numerator)?,
            denominator: self.denominator.mul(&other.denominator)?,
        })
    }

    /// Returns the negative number.
    #[must_use]
    pub fn neg(&self) -> Self {
        Self { numerator: self.numerator.neg(), denominator: self.denominator.clone() }
    }

    /// Returns the quotient by a number that is known not to be 0.
    #[must_use]
    pub fn div(&self, other: &Self) -> Option<Self> {
        if other.numerator.is_empty() {
            return None;
        }
        self.mul(&Self { numerator: other.denominator.clone(), denominator: other.numerator.clone() })
    }
}

/// Cosine and sine of an angle in closed form.
pub type Phase = (Closed, Closed);

/// Returns cosine and sine of `2 pi turn`.
#[must_use]
pub fn phase_of_turn(turn: &Rational) -> Phase {
    let quarter = Rational::from((1, 4)) - turn;
    (Surd::cosine(turn).into(), Surd::cosine(&quarter).into())
}

/// Returns cosine and sine of the sum of two angles.
#[must_use]
pub fn phase_of_sum((c, s): &Phase, (d, t): &Phase) -> Option<Phase> {
    Some((c.mul(d)?.add(&s.mul(t)?.neg())?, s.mul(d)?.add(&c.mul(t)?)?))
}
