//! Sums of plain terms as they are read: flat lists, so that a long polynomial costs no tree.

use super::fraction::Fraction;
use crate::int::Int;
use crate::monomial::LARGEST_EXPONENT;
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};
use rug::{Integer, Rational};

/// Sums that would take more memory than this, in bytes, are refused.
pub(super) const LARGEST_SIZE: u64 = 2 << 30;

/// Texts and results with more terms than this are refused, too.
pub(super) const MOST_TERMS: usize = 20_000_000;

/// Returns the least common multiple of two positive numbers.
pub(super) fn common_multiple(a: &Int, b: &Int) -> Int {
    if a == b { a.clone() } else { a.mul(&b.div_exact(&a.gcd(b))) }
}

/// Returns the number of bits of a number, at least 1.
pub(super) fn bits(n: &Int) -> u64 {
    match n.to_i64() {
        Some(n) => u64::from((64 - n.unsigned_abs().leading_zeros()).max(1)),
        None => u64::from(n.to_integer().significant_bits()),
    }
}

/// Variables and exponents, no variable twice.
type Powers = [(u32, u32)];

/// A sum of products of a number and powers of variables, like terms not yet collected.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    numerators: Vec<Int>,
    /// The end of each term's powers.
    ends: Vec<usize>,
    /// Variable and exponent; no variable twice in a term.
    powers: Vec<(u32, u32)>,
    /// The denominators that are not 1, by the numbers of their terms.
    denominators: Vec<(usize, Int)>,
}

impl Terms {
    pub(super) fn with_capacity(terms: usize) -> Self {
        Self {
            numerators: Vec::with_capacity(terms),
            ends: Vec::with_capacity(terms),
            powers: Vec::with_capacity(2 * terms),
            denominators: Vec::new(),
        }
    }

    pub(super) fn constant(numerator: Int, denominator: Int) -> Self {
        let mut terms = Self::default();
        terms.finish_term(numerator, denominator);
        terms
    }

    pub(super) const fn len(&self) -> usize {
        self.numerators.len()
    }

    /// Returns the start of the powers of the term being read.
    fn start(&self) -> usize {
        self.ends.last().copied().unwrap_or(0)
    }

    /// Multiplies the term being read; `None` if the exponent becomes too large.
    #[inline]
    pub(super) fn multiply(&mut self, variable: u32, exponent: u32) -> Option<()> {
        let start = self.start();
        if exponent == 0 {
            return Some(());
        }
        if let Some((_, known)) = self.powers[start..].iter_mut().find(|(known, _)| *known == variable) {
            *known = known.checked_add(exponent).filter(|sum| *sum <= LARGEST_EXPONENT)?;
        } else {
            self.powers.push((variable, exponent));
        }
        Some(())
    }

    /// Forgets the term that is being read.
    pub(super) fn drop_term(&mut self) {
        self.powers.truncate(self.start());
    }

    /// Ends the term that is being read.
    #[inline]
    pub(super) fn finish_term(&mut self, numerator: Int, denominator: Int) {
        if denominator != Int::one() && !numerator.is_zero() {
            self.denominators.push((self.numerators.len(), denominator));
        }
        self.finish_whole_term(numerator);
    }

    /// Ends the term that is being read, its coefficient being an integer or having its denominator noted already.
    #[inline]
    pub(super) fn finish_whole_term(&mut self, numerator: Int) {
        if numerator.is_zero() {
            return self.drop_term();
        }
        self.numerators.push(numerator);
        self.ends.push(self.powers.len());
    }

    /// Takes out the term that is being read.
    pub(super) fn split_term(&mut self, numerator: Int, denominator: Int) -> Self {
        let mut term = Self { powers: self.powers.split_off(self.start()), ..Self::default() };
        term.finish_term(numerator, denominator);
        term
    }

    /// Numerator and denominator of the term with this number.
    fn coefficient(&self, term: usize) -> (&Int, Option<&Int>) {
        let at = self.denominators.binary_search_by_key(&term, |(term, _)| *term);
        (&self.numerators[term], at.ok().map(|at| &self.denominators[at].1))
    }

    fn rational(&self, term: usize) -> Rational {
        let (numerator, denominator) = self.coefficient(term);
        Rational::from((numerator.to_integer(), denominator.map_or_else(|| Integer::from(1), Int::to_integer)))
    }

    fn powers(&self, term: usize) -> &Powers {
        let start = if term == 0 { 0 } else { self.ends[term - 1] };
        &self.powers[start..self.ends[term]]
    }

    /// Returns the only term, or none for zero: numerator, denominator and powers.
    pub(super) fn single(&self) -> Option<(Int, Int, &Powers)> {
        match self.len() {
            0 => Some((Int::zero(), Int::one(), &[])),
            1 => {
                let (numerator, denominator) = self.coefficient(0);
                Some((numerator.clone(), denominator.cloned().unwrap_or_else(Int::one), self.powers(0)))
            }
            _ => None,
        }
    }

    /// Returns the same sum, as one term if it is a sum of numbers.
    pub(super) fn folded(self) -> Self {
        if self.len() < 2 || !self.powers.is_empty() {
            return self;
        }
        let sum: Rational = (0..self.len()).map(|term| self.rational(term)).sum();
        let (numerator, denominator) = sum.into_numer_denom();
        Self::constant(Int::from(numerator), Int::from(denominator))
    }

    /// Returns one more than the highest variable.
    fn variables(&self) -> usize {
        self.powers.iter().map(|(variable, _)| *variable as usize + 1).max().unwrap_or(0)
    }

    pub(super) fn largest_exponent(&self) -> u64 {
        self.powers.iter().map(|(_, exponent)| u64::from(*exponent)).max().unwrap_or(0)
    }

    /// Returns the sum of terms, collected and sorted once.
    ///
    /// # Errors
    /// A message about a result that would not fit the memory.
    pub(super) fn expand(&self) -> Result<Fraction, String> {
        let variables = self.variables();
        let mut denominator = Int::one();
        self.check_size(variables, &denominator)?;
        for (_, one) in &self.denominators {
            // Watched while it grows: multiples of very many denominators would take for ever.
            denominator = common_multiple(&denominator, one);
            self.check_size(variables, &denominator)?;
        }
        let mut numerators = self.numerators.clone();
        if denominator != Int::one() {
            let mut fractions = self.denominators.iter().peekable();
            for (index, numerator) in numerators.iter_mut().enumerate() {
                *numerator = match fractions.next_if(|(term, _)| *term == index) {
                    Some((_, own)) => numerator.mul(&denominator.div_exact(own)),
                    None => numerator.mul(&denominator),
                };
            }
        }
        Ok(Fraction {
            numerator: Polynomial::from_powers(variables, &self.powers, &self.ends, numerators),
            denominator,
        })
    }

    /// Refuses results that would not fit the memory.
    fn check_size(&self, variables: usize, denominator: &Int) -> Result<(), String> {
        let size = (self.len() as u64).saturating_mul(4 * variables as u64 + 16 + bits(denominator) / 8);
        if size <= LARGEST_SIZE {
            return Ok(());
        }
        let (terms, digits) = (self.len(), bits(denominator) * 3 / 10);
        Err(format!(
            "found {terms} terms in {variables} variables with a common denominator of more than {digits} digits, \
             expected at most {LARGEST_SIZE} bytes"
        ))
    }

    /// Returns the value of the sum for the given values of the variables; `None` if a number has no image in the ring.
    ///
    /// # Panics
    /// If a variable has no value.
    pub(super) fn evaluate<R: Ring>(&self, values: &[R]) -> Option<R> {
        let mut sum = R::zero();
        for term in 0..self.len() {
            let mut product = R::from_rational(&self.rational(term))?;
            for &(variable, exponent) in self.powers(term) {
                product = product.mul(&power(&values[variable as usize], exponent));
            }
            sum = sum.add(&product);
        }
        Some(sum)
    }

    /// Returns a bound of the bits of the value, each variable having the given number of them.
    pub(super) fn growth(&self, sizes: &[u64]) -> u64 {
        let mut degrees = vec![0; self.variables()];
        for &(variable, exponent) in &self.powers {
            let degree: &mut u32 = &mut degrees[variable as usize];
            *degree = exponent.max(*degree);
        }
        let number =
            self.numerators.iter().map(bits).max().unwrap_or(1) + u64::from(usize::BITS - self.len().leading_zeros());
        let numbers = self.denominators.iter().map(|(_, d)| bits(d)).fold(number, u64::saturating_add);
        let powers = degrees.iter().zip(sizes).map(|(&degree, size)| size.saturating_mul(u64::from(degree)));
        powers.fold(numbers, u64::saturating_add)
    }
}

/// Returns the power, by repeated squaring.
pub(super) fn power<R: Ring>(base: &R, exponent: u32) -> R {
    let (mut result, mut square, mut rest) = (None, base.clone(), exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result = Some(result.map_or_else(|| square.clone(), |result: R| result.mul(&square)));
        }
        rest >>= 1;
        if rest > 0 {
            square = square.mul(&square);
        }
    }
    result.unwrap_or_else(R::one)
}
