//! Exact division: a heap orders the products of the divisor and the quotient found so far by the leading variables, a
//! dense box collects those that agree there, and long division in the box finds the next block of the quotient.
//!
//! # Source
//! Monagan and Pearce 2011, Sparse polynomial division using a heap, Journal of Symbolic Computation 46(7).

use super::Polynomial;
use super::blocks::{Blocks, Grid};
use super::heap::{Heap, Key};
use super::kronecker::{Kronecker, Numbers, Undecided};
use super::product::{CELLS, to_large, to_words};
use super::slots::LIMB;
use crate::monomial::Packing;
use crate::ring::{Domain, Ring};

/// Number of terms in an average block from which on boxes pay.
const FEW: usize = 4;
/// The least number of pairs of terms for which a quotient of long integers is thought of; the bits of its slots beyond those of all coefficients,
/// for longer ones of the quotient, the number of terms and the sign; and the nanoseconds that a product of two terms takes otherwise, in words, in
/// long integers, and for each pair of their limbs: measured on a processor of 3 GHz.
const FEW_PAIRS: usize = 256;
const MARGIN: usize = 12;
const WORD_PAIR: f64 = 2.0;
const PAIR: f64 = 60.0;
const LIMB_PAIR: f64 = 0.5;

/// A coefficient or a sum left the machine words.
struct Overflow;

/// The terms of a quotient, if there is one.
type Terms<C> = Option<(Vec<u64>, Vec<C>)>;

/// The operations of division on coefficients.
trait Coefficient: Clone {
    /// Sums of products.
    type Sum: Clone;
    /// Returns the empty sum.
    fn empty() -> Self::Sum;
    /// Returns `sum - a b`.
    fn subtract(sum: &mut Self::Sum, a: &Self, b: &Self) -> Result<(), Overflow>;
    /// Returns whether the sum is zero.
    fn vanishes(sum: &Self::Sum) -> bool;
    /// Returns the exact quotient by a coefficient, `None` if there is a remainder.
    fn divide(sum: &Self::Sum, divisor: &Self) -> Result<Option<Self>, Overflow>;
}

impl Coefficient for i64 {
    type Sum = i128;

    #[inline(always)]
    fn empty() -> i128 {
        0
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

    fn empty() -> D {
        D::zero()
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

/// Divides a monomial; false, and the monomial spoilt, if it is not divisible.
#[inline(always)]
fn divide_monomial(guards: u64, monomial: &mut [u64], divisor: &[u64]) -> bool {
    monomial.iter_mut().zip(divisor).all(|(word, divisor)| {
        // A field of the divisor that is larger borrows the guard bit.
        let difference = (*word | guards) - divisor;
        *word = difference ^ guards;
        difference & guards == guards
    })
}

impl<D: Domain> Polynomial<D> {
    /// Returns the exact quotient; `None` if there is a remainder or the divisor is zero.
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
        let mut last = own[own.len() - words..].to_vec();
        if !divide_monomial(packing.guards(), &mut last, &other[other.len() - words..]) {
            return None;
        }
        self.coefficients.last()?.checked_div_exact(divisor.coefficients.last()?)?;
        if divisor.len() == 1 {
            return self.quotient_by_term(packing, &own, &other, &divisor.coefficients[0]);
        }
        let (mut highest, mut degrees, lower) = (vec![0; words], self.degrees(), divisor.degrees());
        degrees.resize(packing.variables(), 0);
        for (variable, degree) in degrees.iter().enumerate() {
            let degree = degree.checked_sub(lower.get(variable).copied().unwrap_or(0))?;
            let (word, shift) = packing.place(variable);
            highest[word] |= u64::from(degree) << shift;
        }
        if let Ok(quotient) = self.quotient_by_value(divisor, packing, &degrees, (&own, &other)) {
            return quotient;
        }
        let terms = || {
            // In machine words as long as they suffice.
            let wide: Option<Vec<i128>> = self.coefficients.iter().map(D::to_wide).collect();
            if let Some((a, b)) = wide.zip(to_words(&divisor.coefficients)) {
                let (dividend, divisor) = ((&*own, &a[..]), (&*other, &b[..]));
                if let Ok(result) =
                    (Division { packing, dividend, divisor, degrees: &degrees, highest: &highest }).run()
                {
                    return result.map(|(m, c)| (m, c.into_iter().map(|n| D::from_wide(n.into())).collect()));
                }
            }
            let (dividend, divisor) = ((&*own, &self.coefficients[..]), (&*other, &divisor.coefficients[..]));
            Division { packing, dividend, divisor, degrees: &degrees, highest: &highest }.run().ok().flatten()
        };
        let (monomials, coefficients) = terms()?;
        Some(Self { packing, monomials, coefficients })
    }

    /// Returns the exact quotient, `None` if there is a remainder, as one quotient of long integers; `Err` where other ways are faster or have
    /// to decide. All exponents are at most these degrees.
    fn quotient_by_value(
        &self,
        divisor: &Self,
        packing: Packing,
        degrees: &[u32],
        (own, other): (&[u64], &[u64]),
    ) -> Result<Option<Self>, Undecided> {
        // A look at all coefficients costs as much as a short division.
        if self.len() * divisor.len() < FEW_PAIRS {
            return Err(Undecided);
        }
        let a = to_words(&self.coefficients);
        let b = to_words(&divisor.coefficients);
        let (c, d);
        let (a, b, price) = if let Some((a, b)) = a.as_ref().zip(b.as_ref()) {
            (Numbers::Words(a), Numbers::Words(b), WORD_PAIR)
        } else {
            c = to_large(&self.coefficients).ok_or(Undecided)?;
            d = to_large(&divisor.coefficients).ok_or(Undecided)?;
            let (a, b) = (Numbers::Large(&c), Numbers::Large(&d));
            let limbs = |bits: usize| (bits / LIMB + 1) as f64;
            (a, b, PAIR + LIMB_PAIR * limbs(a.bits().saturating_sub(b.bits())) * limbs(b.bits()))
        };
        let width = a.bits().max(b.bits()) + MARGIN;
        let substitution = Kronecker::with_width(packing, degrees, width, own, other).ok_or(Undecided)?;
        let lower = divisor.degrees();
        let cells = degrees.iter().enumerate().map(|(v, d)| (d - lower.get(v).unwrap_or(&0)) as usize + 1);
        // The quotient has as many terms as its degrees allow, or as the dividend, if that has fewer.
        let terms = cells.fold(1, usize::saturating_mul).min(self.len());
        if substitution.quotient_cost() > price * terms as f64 * divisor.len() as f64 {
            return Err(Undecided);
        }
        let quotient = substitution.quotient((own, &a), (other, &b), &lower)?;
        Ok(quotient.map(|(monomials, coefficients)| Self { packing, monomials, coefficients }))
    }

    /// Returns the exact quotient by one term, which keeps the order of the terms.
    fn quotient_by_term(&self, packing: Packing, own: &[u64], monomial: &[u64], c: &D) -> Option<Self> {
        let (guards, mut monomials) = (packing.guards(), own.to_vec());
        let divides = |own: &mut [u64]| divide_monomial(guards, own, monomial);
        if !monomials.chunks_exact_mut(packing.words()).all(divides) {
            return None;
        }
        let coefficients = self.coefficients.iter().map(|own| own.checked_div_exact(c)).collect::<Option<_>>()?;
        Some(Self { packing, monomials, coefficients })
    }
}

/// Dividend and divisor, each monomials and coefficients, both not zero.
struct Division<'a, C: Coefficient> {
    packing: Packing,
    dividend: (&'a [u64], &'a [C::Sum]),
    divisor: (&'a [u64], &'a [C]),
    /// The degrees of the dividend.
    degrees: &'a [u32],
    /// The degrees that the quotient must have, as a monomial.
    highest: &'a [u64],
}

impl<C: Coefficient> Division<'_, C> {
    /// Returns the terms of the quotient, `None` if there is a remainder.
    fn run(&self) -> Result<Terms<C>, Overflow> {
        let (dividend, divisor) = (self.dividend, self.divisor);
        let mut grid = Grid::new(self.packing, self.degrees, CELLS.min(dividend.1.len()));
        let mut blocks = Blocks::new(&grid, dividend.0);
        if blocks.len() * FEW > dividend.1.len() {
            grid = Grid::new(self.packing, self.degrees, 1);
            blocks = Blocks::new(&grid, dividend.0);
        }
        let divisor = Blocks::new(&grid, divisor.0);
        let mut bench = Bench {
            division: self,
            grid: &grid,
            dividend: &blocks,
            divisor: &divisor,
            rest: Rest { sums: vec![C::empty(); grid.cells()], marks: vec![0; grid.cells().div_ceil(64)], top: 0 },
            starts: vec![0],
            cells: Vec::new(),
            monomials: Vec::new(),
            coefficients: Vec::new(),
        };
        let (dividend, divisor) = ((&blocks, self.dividend.0), (&divisor, self.divisor.0));
        let divides = match self.packing.words() {
            1 => divide_blocks::<u64>(&grid, dividend, divisor, &mut bench),
            2 => divide_blocks::<[u64; 2]>(&grid, dividend, divisor, &mut bench),
            _ => divide_blocks::<Box<[u64]>>(&grid, dividend, divisor, &mut bench),
        }?;
        Ok(divides.then_some((bench.monomials, bench.coefficients)))
    }
}

/// What a block of the quotient was found to be.
enum Found {
    /// Zero.
    Nothing,
    /// Terms, which are a new block.
    Block,
    /// No polynomial.
    Remainder,
}

/// What happens to the coefficients while a heap orders the monomials. The heap sees no coefficients, so that it exists once for all
/// rings.
trait Work {
    /// Puts the terms of a block of the dividend on the bench.
    fn start(&mut self, block: usize);
    /// Subtracts a block of the divisor times one of the quotient.
    fn subtract_product(&mut self, divisor: usize, quotient: usize) -> Result<(), Overflow>;
    /// Divides the terms on the bench by the first block of the divisor; their leading variables are those of the key.
    fn divide(&mut self, key: &[u64]) -> Result<Found, Overflow>;
}

/// Divides block by block; false if there is a remainder.
fn divide_blocks<K: Key>(
    grid: &Grid,
    (dividend, dividend_monomials): (&Blocks, &[u64]),
    (divisor, divisor_monomials): (&Blocks, &[u64]),
    bench: &mut dyn Work,
) -> Result<bool, Overflow> {
    let dividend_keys = dividend.keys::<K>(grid, dividend_monomials);
    let divisor_keys = divisor.keys::<K>(grid, divisor_monomials);
    let mut quotient_keys: Vec<K> = Vec::new();
    // Row i is the i-th block of the divisor times the quotient; rows that have used up the quotient wait.
    let mut heap = Heap::<K>::new(divisor.len());
    let mut columns = vec![0; divisor.len()];
    let mut waiting = if divisor.len() > 1 { vec![1] } else { Vec::new() };
    let (mut rows, mut next) = (Vec::new(), 0);
    loop {
        let key = match (dividend_keys.get(next), heap.peek()) {
            (None, None) => return Ok(true),
            (Some(a), Some(b)) => a.max(b).clone(),
            (Some(key), None) | (None, Some(key)) => key.clone(),
        };
        if dividend_keys.get(next) == Some(&key) {
            bench.start(next);
            next += 1;
        }
        if heap.peek() == Some(&key) {
            heap.pop(&mut rows);
        }
        for &row in &rows {
            bench.subtract_product(row, columns[row])?;
        }
        for row in rows.drain(..) {
            columns[row] += 1;
            if columns[row] == 1 && row + 1 < divisor.len() {
                heap.insert(divisor_keys[row + 1].times(&quotient_keys[0]), row + 1);
            }
            match quotient_keys.get(columns[row]) {
                Some(key) => heap.insert(divisor_keys[row].times(key), row),
                None => waiting.push(row),
            }
        }
        match bench.divide(key.words())? {
            Found::Nothing => {}
            Found::Remainder => return Ok(false),
            Found::Block => {
                let outer = key.over(&divisor_keys[0]);
                for row in waiting.drain(..) {
                    heap.insert(divisor_keys[row].times(&outer), row);
                }
                quotient_keys.push(outer);
            }
        }
    }
}

/// The box in which a block of the dividend loses its multiples of the divisor.
struct Rest<C: Coefficient> {
    sums: Vec<C::Sum>,
    /// A bit for each cell that may not be zero.
    marks: Vec<u64>,
    /// No word above this one has marks.
    top: usize,
}

/// A block of the dividend on its way to zero, and the quotient found so far.
struct Bench<'a, C: Coefficient> {
    division: &'a Division<'a, C>,
    grid: &'a Grid,
    dividend: &'a Blocks,
    divisor: &'a Blocks,
    rest: Rest<C>,
    /// The start of each block of the quotient, and its number of terms.
    starts: Vec<usize>,
    /// The cell of each term of the quotient.
    cells: Vec<usize>,
    monomials: Vec<u64>,
    coefficients: Vec<C>,
}

impl<C: Coefficient> Rest<C> {
    fn mark(&mut self, cell: usize) {
        self.marks[cell / 64] |= 1 << (cell % 64);
        self.top = self.top.max(cell / 64);
    }

    /// Subtracts terms times one of the quotient.
    #[inline(always)]
    fn subtract(&mut self, cells: &[usize], terms: &[C], start: usize, c: &C) -> Result<(), Overflow> {
        let mut highest = 0;
        for (cell, d) in cells.iter().zip(terms) {
            let cell = start + cell;
            C::subtract(&mut self.sums[cell], d, c)?;
            self.marks[cell / 64] |= 1 << (cell % 64);
            highest = highest.max(cell);
        }
        self.top = self.top.max(highest / 64);
        Ok(())
    }

    /// Takes the highest mark.
    fn highest(&mut self) -> Option<usize> {
        while self.marks[self.top] == 0 {
            self.top = self.top.checked_sub(1)?;
        }
        let bit = 63 - self.marks[self.top].leading_zeros() as usize;
        self.marks[self.top] ^= 1 << bit;
        Some(self.top * 64 + bit)
    }
}

impl<C: Coefficient> Work for Bench<'_, C> {
    fn start(&mut self, block: usize) {
        for i in self.dividend.block(block) {
            let cell = self.dividend.cells[i];
            self.rest.sums[cell] = self.division.dividend.1[i].clone();
            self.rest.mark(cell);
        }
    }

    fn subtract_product(&mut self, divisor: usize, quotient: usize) -> Result<(), Overflow> {
        let block = self.divisor.block(divisor);
        let (cells, terms) = (&self.divisor.cells[block.clone()], &self.division.divisor.1[block]);
        for i in self.starts[quotient]..self.starts[quotient + 1] {
            self.rest.subtract(cells, terms, self.cells[i], &self.coefficients[i])?;
        }
        Ok(())
    }

    fn divide(&mut self, key: &[u64]) -> Result<Found, Overflow> {
        let (packing, divisor) = (self.division.packing, self.division.divisor);
        let leading = &divisor.0[..packing.words()];
        let guards = packing.guards();
        let behind = 1..self.divisor.block(0).end;
        let (cells, terms) = (&self.divisor.cells[behind.clone()], &divisor.1[behind]);
        while let Some(cell) = self.rest.highest() {
            let sum = std::mem::replace(&mut self.rest.sums[cell], C::empty());
            if C::vanishes(&sum) {
                continue;
            }
            let end = self.monomials.len();
            self.monomials.extend(key.iter().zip(self.grid.monomial(cell)).map(|(outer, inner)| outer | inner));
            let monomial = &mut self.monomials[end..];
            // No term of the quotient has a higher degree than the quotient.
            let highest = self.division.highest;
            let divides = divide_monomial(guards, monomial, leading)
                && highest.iter().zip(monomial).all(|(high, word)| ((high | guards) - *word) & guards == guards);
            let Some(c) = C::divide(&sum, &divisor.1[0])?.filter(|_| divides) else { return Ok(Found::Remainder) };
            let start = cell - self.divisor.cells[0];
            self.rest.subtract(cells, terms, start, &c)?;
            self.cells.push(start);
            self.coefficients.push(c);
        }
        if self.starts.last() == Some(&self.cells.len()) {
            return Ok(Found::Nothing);
        }
        self.starts.push(self.cells.len());
        Ok(Found::Block)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use proptest::prelude::*;
    use rug::Integer;

    type Poly = Polynomial<Int>;

    fn polynomial(variables: usize, terms: usize) -> impl Strategy<Value = Poly> {
        let number = (any::<i64>(), 0..64_u32, prop::sample::select(vec![0_u32, 0, 70, 400]))
            .prop_map(|(n, less, more)| Int::from(Integer::from(n >> less) << more));
        let term = (prop::collection::vec(0..7_u32, variables), number);
        prop::collection::vec(term, 1..terms).prop_map(Poly::from_terms)
    }

    /// Returns the quotient by values, whatever it costs.
    fn by_value(f: &Poly, g: &Poly, margin: usize) -> Result<Option<Poly>, Undecided> {
        let packing = f.joint_packing(g);
        let (own, other) = (f.packed_as(packing), g.packed_as(packing));
        let mut degrees = f.degrees();
        degrees.resize(packing.variables(), 0);
        let (a, b) = (to_large(&f.coefficients).unwrap(), to_large(&g.coefficients).unwrap());
        let (a, b) = (Numbers::Large(&a), Numbers::Large(&b));
        let width = a.bits().max(b.bits()) + margin;
        let substitution = Kronecker::with_width(packing, &degrees, width, &own, &other).unwrap();
        let found = substitution.quotient((&own, &a), (&other, &b), &g.degrees())?;
        Ok(found.map(|(monomials, coefficients)| Polynomial { packing, monomials, coefficients }))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]
        #[test]
        fn quotients_by_values_are_quotients(
            (f, g, r) in (1..4_usize).prop_flat_map(|n| (polynomial(n, 20), polynomial(n, 20), polynomial(n, 3))),
            margin in 2..20_usize,
        ) {
            prop_assume!(!f.is_zero() && !g.is_zero());
            let product = f.mul(&g);
            if let Ok(found) = by_value(&product, &g, margin) {
                prop_assert_eq!(found.as_ref(), Some(&f));
            }
            prop_assert_eq!(product.checked_div_exact(&g), Some(f));
            // What is no multiple is never taken for one. Slots are for divisors of no larger degrees.
            let sum = product.add(&r);
            if (0..3).all(|v| sum.degree(v) >= g.degree(v))
                && let Ok(Some(found)) = by_value(&sum, &g, margin)
            {
                prop_assert_eq!(found.mul(&g), sum);
            }
        }
    }

    /// Their values divide each other at every power of two.
    #[test]
    fn values_that_mislead() {
        let x = Poly::variable(0);
        let number = |n: i64| Poly::constant(Int::from(n));
        let h = (1..40).fold(Poly::one(), |h, n| h.mul(&x.scale(&Int::from(n)).add(&number(1 - 2 * n))));
        let f = x.mul(&x.add(&number(2))).mul(&h);
        let g = x.add(&number(2)).scale(&Int::from(2)).mul(&h);
        assert!(f.len() * g.len() >= FEW_PAIRS);
        assert_eq!(f.checked_div_exact(&g), None);
        assert!(by_value(&f, &g, MARGIN).is_err());
        assert_eq!(f.scale(&Int::from(2)).checked_div_exact(&g), Some(x));
    }
}
