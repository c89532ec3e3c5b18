//! Multiplies out, with a bound computed first: results that would not fit are refused before the work begins.

use super::expression::Node;
use super::fault::{Fault, Place};
use super::fraction::Fraction;
use super::terms::{LARGEST_SIZE, MOST_TERMS, bits, common_multiple};
use crate::int::Int;
use crate::monomial::LARGEST_EXPONENT;
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};

/// Products of more products of machine words than this are refused.
const MOST_WORK: f64 = 1e12;
/// Products of fewer terms than this need no estimate.
const SMALL: f64 = 1e5;
/// So do powers of few terms with exponents up to this.
const SMALL_EXPONENT: u32 = 1000;

/// A polynomial, and a bound of its exponents which need not be sharp.
struct Expanded {
    fraction: Fraction,
    largest_exponent: u64,
}

impl Expanded {
    fn constant(fraction: Fraction) -> Self {
        Self { fraction, largest_exponent: 0 }
    }

    const fn polynomial(&self) -> &Polynomial<Int> {
        &self.fraction.numerator
    }
}

impl Node {
    /// Returns the polynomial, multiplied out.
    pub(super) fn expand(&self) -> Result<Fraction, Fault> {
        Ok(self.expanded()?.fraction)
    }

    fn expanded(&self) -> Result<Expanded, Fault> {
        match self {
            Self::Terms(place, terms) => {
                let fraction = terms.expand().map_err(|message| Fault::new(*place, message))?;
                Ok(Expanded { fraction, largest_exponent: terms.largest_exponent() })
            }
            Self::Sum(place, terms, nodes) => {
                let fraction = terms.expand().map_err(|message| Fault::new(*place, message))?;
                let mut largest_exponent = terms.largest_exponent();
                let mut sums = Sums::default();
                sums.add(fraction);
                for node in nodes {
                    let summand = node.expanded()?;
                    largest_exponent = largest_exponent.max(summand.largest_exponent);
                    sums.add(summand.fraction);
                    if sums.terms() > MOST_TERMS {
                        let message = format!("found a sum of more than the {MOST_TERMS} terms possible");
                        return Err(Fault::new(*place, message));
                    }
                }
                Ok(Expanded { fraction: sums.total(), largest_exponent })
            }
            Self::Product(place, nodes) => {
                let mut product = Expanded::constant(one());
                for node in nodes {
                    product = multiply(&product, &node.expanded()?, *place)?;
                }
                Ok(product)
            }
            Self::Power(place, base, exponent) => raise(&base.expanded()?, *exponent, *place),
        }
    }
}

fn one() -> Fraction {
    Fraction { numerator: Polynomial::one(), denominator: Int::one() }
}

/// Partial sums, each more than twice as long as the next one, so that adding many polynomials takes little more than
/// sorting their terms.
#[derive(Default)]
struct Sums(Vec<Fraction>);

impl Sums {
    fn add(&mut self, summand: Fraction) {
        let mut last = summand;
        while let Some(before) = self.0.pop_if(|before| before.numerator.len() <= 2 * last.numerator.len()) {
            last = add(&before, &last);
        }
        self.0.push(last);
    }

    fn terms(&self) -> usize {
        self.0.iter().map(|part| part.numerator.len()).sum()
    }

    fn total(self) -> Fraction {
        let zero = || Fraction { numerator: Polynomial::zero(), denominator: Int::one() };
        self.0.into_iter().rev().reduce(|sum, part| add(&sum, &part)).unwrap_or_else(zero)
    }
}

fn add(a: &Fraction, b: &Fraction) -> Fraction {
    if a.denominator == b.denominator {
        return Fraction { numerator: a.numerator.add(&b.numerator), denominator: a.denominator.clone() };
    }
    let denominator = common_multiple(&a.denominator, &b.denominator);
    let scaled = |f: &Fraction| f.numerator.scale(&denominator.div_exact(&f.denominator));
    Fraction { numerator: scaled(a).add(&scaled(b)), denominator }
}

fn multiply(a: &Expanded, b: &Expanded, place: Place) -> Result<Expanded, Fault> {
    let (p, q) = (a.polynomial(), b.polynomial());
    let denominator = a.fraction.denominator.mul(&b.fraction.denominator);
    let largest_exponent = a.largest_exponent + b.largest_exponent;
    if let Some(c) = p.to_constant() {
        let numerator = if c == Int::one() { q.clone() } else { q.scale(&c) };
        return Ok(Expanded { fraction: Fraction { numerator, denominator }, largest_exponent });
    }
    if let Some(c) = q.to_constant() {
        return Ok(Expanded { fraction: Fraction { numerator: p.scale(&c), denominator }, largest_exponent });
    }
    let products = p.len() as f64 * q.len() as f64;
    if largest_exponent > u64::from(LARGEST_EXPONENT) || products > SMALL {
        let (p, q) = (Size::of(p), Size::of(q));
        p.times(&q).check(p.words() * q.words() * products, place)?;
    }
    let numerator = p.mul(q);
    Ok(Expanded { fraction: Fraction { numerator, denominator }, largest_exponent })
}

fn raise(base: &Expanded, exponent: u32, place: Place) -> Result<Expanded, Fault> {
    let largest_exponent = base.largest_exponent.saturating_mul(u64::from(exponent));
    if largest_exponent > u64::from(LARGEST_EXPONENT)
        || exponent > SMALL_EXPONENT
        || multisets(base.polynomial().len() as f64, f64::from(exponent)) > SMALL
    {
        let size = Size::of(base.polynomial());
        let half = size.raised(exponent.div_ceil(2));
        size.raised(exponent).check((half.terms * half.words()).powi(2), place)?;
    }
    let denominator = super::terms::power(&base.fraction.denominator, exponent);
    let fraction = Fraction { numerator: base.polynomial().pow(exponent), denominator };
    Ok(Expanded { fraction, largest_exponent })
}

/// Returns the number of ways to choose `k` of `n` things with repetition, `binomial(n + k - 1, k)`: the number of terms of
/// a power, and of monomials of degree `k`.
fn multisets(n: f64, k: f64) -> f64 {
    if n < 1.0 {
        return 0.0;
    }
    let n = n - 1.0;
    let (few, many) = if n < k { (n, k) } else { (k, n) };
    let mut count = 1.0;
    let mut i = 0.0;
    // Beyond any limit the exact number does not matter.
    while i < few && count < 1e18 {
        i += 1.0;
        count *= (many + i) / i;
    }
    count
}

/// Bounds of the size of a polynomial.
struct Size {
    terms: f64,
    degrees: Vec<u64>,
    total_degree: u64,
    /// Bits of the sum of the absolute values of the coefficients.
    bits: f64,
}

impl Size {
    fn of(p: &Polynomial<Int>) -> Self {
        let longest = p.coefficients().iter().map(bits).max().unwrap_or(1);
        Self {
            terms: p.len() as f64,
            degrees: p.degrees().into_iter().map(u64::from).collect(),
            total_degree: p.total_degree().unwrap_or(0),
            bits: longest as f64 + (p.len() as f64).log2(),
        }
    }

    /// Machine words of a coefficient.
    fn words(&self) -> f64 {
        (self.bits / 64.0).max(1.0)
    }

    /// Returns the terms that fit the degrees.
    fn bounded(mut self) -> Self {
        let cells: f64 = self.degrees.iter().map(|&d| d as f64 + 1.0).product();
        let variables = self.degrees.iter().filter(|&&d| d > 0).count();
        let simplex = multisets(variables as f64 + 1.0, self.total_degree as f64);
        self.terms = self.terms.min(cells).min(simplex);
        self
    }

    fn times(&self, other: &Self) -> Self {
        let degree = |i| self.degrees.get(i).unwrap_or(&0) + other.degrees.get(i).unwrap_or(&0);
        Self {
            terms: self.terms * other.terms,
            degrees: (0..self.degrees.len().max(other.degrees.len())).map(degree).collect(),
            total_degree: self.total_degree + other.total_degree,
            bits: self.bits + other.bits,
        }
        .bounded()
    }

    fn raised(&self, exponent: u32) -> Self {
        let k = u64::from(exponent);
        Self {
            terms: multisets(self.terms, f64::from(exponent)),
            degrees: self.degrees.iter().map(|d| d.saturating_mul(k)).collect(),
            total_degree: self.total_degree.saturating_mul(k),
            bits: self.bits * f64::from(exponent),
        }
        .bounded()
    }

    /// Refuses results that are too large, `work` being the number of products of machine words.
    fn check(&self, work: f64, place: Place) -> Result<(), Fault> {
        let refuse = |message: String| Err(Fault::new(place, message));
        if self.degrees.iter().any(|&d| d > u64::from(LARGEST_EXPONENT)) {
            return refuse(format!("found a power with an exponent above {LARGEST_EXPONENT} when multiplied out"));
        }
        let bytes = self.terms * (8.0 * self.words() + 16.0);
        let (terms, digits) = (self.terms, self.bits * std::f64::consts::LOG10_2);
        if terms > MOST_TERMS as f64 {
            return refuse(format!("found a product of up to {terms:.1e} terms, more than the {MOST_TERMS} possible"));
        }
        if bytes > LARGEST_SIZE as f64 || work > MOST_WORK {
            return refuse(format!(
                "found a product of up to {terms:.1e} terms with coefficients of up to {digits:.0} digits, too much to \
                 multiply out"
            ));
        }
        Ok(())
    }
}
