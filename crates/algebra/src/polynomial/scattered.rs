//! Products of polynomials whose terms are so scattered that hardly two products of terms are alike: all are written out and sorted by their
//! digits, which costs less for each than a heap does.

#![expect(clippy::cast_possible_truncation, reason = "digits are short")]

use crate::monomial::Packing;

/// The most products of terms: both lists of them then take 64 MB.
const MOST: usize = 1 << 21;
/// The bits of a digit at most: as many counts as stay in the first-level cache.
const DIGIT: u32 = 11;

/// The bits of monomials that are used, close together.
struct Fields(Vec<(u32, u32, u64)>);

impl Fields {
    /// Returns the fields for these degrees, and their bits.
    fn new(packing: Packing, degrees: &[u32]) -> (Self, u32) {
        let (mut fields, mut bits) = (Vec::with_capacity(degrees.len()), 0);
        for (variable, &degree) in degrees.iter().enumerate().rev() {
            let width = u32::BITS - degree.leading_zeros();
            fields.push((packing.place(variable).1, bits, (1 << width) - 1));
            bits += width;
        }
        (Self(fields), bits)
    }

    #[inline(always)]
    fn compress(&self, monomial: u64) -> u64 {
        self.0.iter().map(|&(from, to, mask)| (monomial >> from & mask) << to).sum()
    }

    #[inline(always)]
    fn expand(&self, key: u64) -> u64 {
        self.0.iter().map(|&(from, to, mask)| (key >> to & mask) << from).sum()
    }
}

/// Returns the product of two polynomials with monomials of one word, all sums of whose coefficients fit a word: monomials and coefficients; `None`
/// if there are too many products.
pub(super) fn product(
    packing: Packing,
    degrees: &[u32],
    (left, a): (&[u64], &[i64]),
    (right, b): (&[u64], &[i64]),
) -> Option<(Vec<u64>, Vec<i64>)> {
    let count = left.len() * right.len();
    if count > MOST || packing.words() != 1 {
        return None;
    }
    let (fields, bits) = Fields::new(packing, degrees);
    let keyed = |monomials: &[u64], numbers: &[i64]| -> Vec<(u64, i64)> {
        monomials.iter().map(|monomial| fields.compress(*monomial)).zip(numbers.iter().copied()).collect()
    };
    let (left, right) = (keyed(left, a), keyed(right, b));
    let mut terms = Vec::with_capacity(count);
    for (key, c) in &left {
        terms.extend(right.iter().map(|(other, d)| (key + other, c * d)));
    }
    sort(&mut terms, bits);
    let (mut monomials, mut coefficients): (Vec<u64>, Vec<i64>) =
        (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut terms = terms.into_iter().rev().peekable();
    while let Some((key, mut sum)) = terms.next() {
        while let Some((_, c)) = terms.next_if(|term| term.0 == key) {
            sum += c;
        }
        if sum != 0 {
            monomials.push(fields.expand(key));
            coefficients.push(sum);
        }
    }
    monomials.shrink_to_fit();
    Some((monomials, coefficients))
}

/// Sorts terms by keys of so many bits, digit by digit from the lowest one.
fn sort(terms: &mut Vec<(u64, i64)>, bits: u32) {
    let passes = bits.div_ceil(DIGIT);
    let digit = bits.div_ceil(passes.max(1));
    let mut sorted = vec![(0, 0); terms.len()];
    for pass in 0..passes {
        let shift = pass * digit;
        let place = |key: u64| (key >> shift) as usize & ((1 << digit) - 1);
        let mut starts = vec![0_usize; 1 << digit];
        for term in &*terms {
            starts[place(term.0)] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            (*start, sum) = (sum, sum + *start);
        }
        for term in &*terms {
            let start = &mut starts[place(term.0)];
            sorted[*start] = *term;
            *start += 1;
        }
        std::mem::swap(terms, &mut sorted);
    }
}
