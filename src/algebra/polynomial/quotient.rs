//! Exact division, with a heap that merges the products of the quotient found so far with the divisor.
//!
//! # Source
//! Monagan and Pearce 2011, Sparse polynomial division using a heap, Journal of Symbolic Computation 46(7).

use super::Polynomial;
use super::heap::{Heap, Key};
use super::product::to_words;
use crate::algebra::monomial::Packing;
use crate::algebra::ring::{Domain, Ring};

/// A coefficient or a sum left the machine words.
struct Overflow;

/// The terms of a quotient, if there is one.
type Terms<C> = Option<(Vec<u64>, Vec<C>)>;

/// What division does with coefficients.
trait Coefficient: Clone {
    /// Sums of products.
    type Sum;
    /// The sum that holds one coefficient, or none.
    fn sum(start: Option<&Self>) -> Self::Sum;
    /// `sum - a b`
    fn subtract(sum: &mut Self::Sum, a: &Self, b: &Self) -> Result<(), Overflow>;
    /// Whether the sum is zero.
    fn vanishes(sum: &Self::Sum) -> bool;
    /// The exact quotient by a coefficient, `None` if there is a remainder.
    fn divide(sum: &Self::Sum, divisor: &Self) -> Result<Option<Self>, Overflow>;
}

impl Coefficient for i64 {
    type Sum = i128;

    #[inline(always)]
    fn sum(start: Option<&Self>) -> i128 {
        start.map_or(0, |&c| i128::from(c))
    }
    #[inline(always)]
    fn subtract(sum: &mut i128, a: &Self, b: &Self) -> Result<(), Overflow> {
        *sum = sum.checked_sub(i128::from(*a) * i128::from(*b)).ok_or(Overflow)?;
        Ok(())
    }
    #[inline(always)]
    fn vanishes(sum: &i128) -> bool {
        *sum == 0
    }
    #[inline(always)]
    fn divide(sum: &i128, divisor: &Self) -> Result<Option<Self>, Overflow> {
        if *divisor == 1 {
            return i64::try_from(*sum).map(Some).map_err(|_| Overflow);
        }
        // Division of words is much faster than of double words; only i64::MIN / -1 leaves the word.
        if let Ok(sum) = i64::try_from(*sum) {
            let remainder = sum.checked_rem(*divisor).ok_or(Overflow)?;
            return Ok((remainder == 0).then(|| sum / divisor));
        }
        let divisor = i128::from(*divisor);
        let remainder = sum.checked_rem(divisor).ok_or(Overflow)?;
        if remainder != 0 {
            return Ok(None);
        }
        i64::try_from(sum / divisor).map(Some).map_err(|_| Overflow)
    }
}

impl<D: Domain> Coefficient for D {
    type Sum = D;

    fn sum(start: Option<&Self>) -> D {
        start.cloned().unwrap_or_else(D::zero)
    }
    fn subtract(sum: &mut D, a: &Self, b: &Self) -> Result<(), Overflow> {
        *sum = sum.sub(&a.mul(b));
        Ok(())
    }
    fn vanishes(sum: &D) -> bool {
        sum.is_zero()
    }
    fn divide(sum: &D, divisor: &Self) -> Result<Option<Self>, Overflow> {
        Ok(sum.checked_div_exact(divisor))
    }
}

/// `a / b` for monomials; `None` unless b divides a.
#[inline(always)]
fn divide_monomials(packing: Packing, a: &[u64], b: &[u64], quotient: &mut [u64]) -> Option<()> {
    let guards = packing.guards();
    for ((a, b), quotient) in a.iter().zip(b).zip(quotient) {
        // A field of b that is larger than that of a borrows the guard bit.
        let difference = (a | guards) - b;
        if difference & guards != guards {
            return None;
        }
        *quotient = difference ^ guards;
    }
    Some(())
}

impl<D: Domain> Polynomial<D> {
    /// The exact quotient; `None` if there is a remainder or the divisor is zero.
    pub(super) fn quotient(&self, divisor: &Self) -> Option<Self> {
        if divisor.is_zero() {
            return None;
        }
        if self.is_zero() {
            return Some(Self::zero());
        }
        let packing = self.joint_packing(divisor);
        let (own, other) = (self.packed_as(packing), divisor.packed_as(packing));
        let words = packing.words();
        // Degrees add, and the products of first and of last terms cannot cancel.
        let mut highest = vec![0; words];
        for variable in 0..packing.variables() {
            let degree = self.degree(variable).checked_sub(divisor.degree(variable))?;
            let (word, shift) = packing.place(variable);
            highest[word] |= u64::from(degree) << shift;
        }
        let mut last = vec![0; words];
        divide_monomials(packing, &own[own.len() - words..], &other[other.len() - words..], &mut last)?;
        self.coefficients.last()?.checked_div_exact(divisor.coefficients.last()?)?;
        let (monomials, coefficients) = self.divide(divisor, packing, &own, &other, &highest)?;
        Some(Self { packing, monomials, coefficients })
    }

    /// In machine words as long as they suffice.
    fn divide(
        &self,
        divisor: &Self,
        packing: Packing,
        own: &[u64],
        other: &[u64],
        highest: &[u64],
    ) -> Option<(Vec<u64>, Vec<D>)> {
        if let Some((a, b)) = to_words(&self.coefficients).zip(to_words(&divisor.coefficients)) {
            let division = Division { packing, dividend: (own, &a), divisor: (other, &b), highest };
            if let Ok(result) = division.run() {
                return result.map(|(m, c)| (m, c.into_iter().map(|n| D::from_wide(n.into())).collect()));
            }
        }
        let (a, b) = (&self.coefficients[..], &divisor.coefficients[..]);
        Division { packing, dividend: (own, a), divisor: (other, b), highest }.run().ok().flatten()
    }
}

/// Dividend and divisor, each monomials and coefficients, both not zero.
struct Division<'a, C> {
    packing: Packing,
    dividend: (&'a [u64], &'a [C]),
    divisor: (&'a [u64], &'a [C]),
    /// The degrees that the quotient must have, as a monomial.
    highest: &'a [u64],
}

impl<C: Coefficient> Division<'_, C> {
    /// The terms of the quotient, `None` if there is a remainder.
    fn run(&self) -> Result<Terms<C>, Overflow> {
        match self.packing.words() {
            1 => self.run_by::<u64>(),
            2 => self.run_by::<[u64; 2]>(),
            _ => self.run_by::<Box<[u64]>>(),
        }
    }

    fn run_by<K: Key>(&self) -> Result<Terms<C>, Overflow> {
        let words = self.packing.words();
        let (monomials, coefficients) = self.dividend;
        let mut dividend = monomials.chunks_exact(words).zip(coefficients).peekable();
        let divisor: Vec<K> = self.divisor.0.chunks_exact(words).map(K::read).collect();
        let factors = self.divisor.1;
        let (mut keys, mut monomials, mut quotient): (Vec<K>, Vec<u64>, Vec<C>) = (Vec::new(), Vec::new(), Vec::new());
        // Row i is the i-th term of the divisor times the quotient; rows that have used up the quotient wait.
        let mut heap = Heap::<K>::new(divisor.len());
        let mut columns = vec![0; divisor.len()];
        let (mut waiting, mut rows) = (Vec::new(), Vec::new());
        let (mut difference, mut room) = (vec![0; words], vec![0; words]);
        if divisor.len() > 1 {
            waiting.push(1);
        }
        loop {
            let next = dividend.peek().map(|(monomial, _)| K::read(monomial));
            let key = match (next, heap.peek()) {
                (None, None) => return Ok(Some((monomials, quotient))),
                (Some(a), Some(b)) => a.max(b.clone()),
                (Some(a), None) => a,
                (None, Some(b)) => b.clone(),
            };
            let start = dividend.next_if(|(monomial, _)| *monomial == key.words()).map(|(_, c)| c);
            let mut sum = C::sum(start);
            if heap.peek() == Some(&key) {
                heap.pop(&mut rows);
            }
            for &row in &rows {
                C::subtract(&mut sum, &factors[row], &quotient[columns[row]])?;
            }
            for row in rows.drain(..) {
                columns[row] += 1;
                if columns[row] == 1 && row + 1 < divisor.len() {
                    heap.insert(divisor[row + 1].times(&keys[0]), row + 1);
                }
                match keys.get(columns[row]) {
                    Some(key) => heap.insert(divisor[row].times(key), row),
                    None => waiting.push(row),
                }
            }
            if C::vanishes(&sum) {
                continue;
            }
            let monomial = divide_monomials(self.packing, key.words(), divisor[0].words(), &mut difference);
            let within = monomial.and_then(|()| divide_monomials(self.packing, self.highest, &difference, &mut room));
            if within.is_none() {
                return Ok(None);
            }
            let Some(c) = C::divide(&sum, &factors[0])? else { return Ok(None) };
            let key = K::read(&difference);
            for row in waiting.drain(..) {
                heap.insert(divisor[row].times(&key), row);
            }
            monomials.extend_from_slice(&difference);
            keys.push(key);
            quotient.push(c);
        }
    }
}
