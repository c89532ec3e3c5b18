//! Products of polynomials in one and the same variable: one product of long integers, laid down and read off slot by slot.

use super::kronecker::balanced;
use super::product::to_words;
use super::slots::{LIMB, Reader, Writer};
use super::transform::{Placed, Transform};
use crate::monomial::Packing;
use crate::ring::Ring;
use rug::{Integer, integer::Order};

/// The most slots for each pair of terms: beyond it, the terms are far between and multiplied one by one.
const MOST_PER_PAIR: usize = 8;
/// The most pairs of terms whose products are added up one by one, and the bits of the slots that two words then hold.
const FEW: usize = 600;
const WIDE: usize = 127;
/// The nanoseconds for a slot, and for a pair of terms that are multiplied one by one: measured on a processor of 3 GHz.
const SLOT: f64 = 3.0;
const PAIR: f64 = 2.0;

/// Coefficients, none of them zero, with what is to be known of their lengths.
pub(super) struct Numbers<'a, R> {
    coefficients: &'a [R],
    /// Those that are all machine words.
    words: Option<Vec<i64>>,
    /// The bits of the longest.
    pub(super) longest: usize,
    /// The bits of the sum of all absolute values, or a bound of that.
    sum: usize,
}

impl<'a, R: Ring> Numbers<'a, R> {
    /// Looks at coefficients; `None` where they are no integers.
    pub(super) fn new(coefficients: &'a [R]) -> Option<Self> {
        let words = to_words(coefficients);
        let (longest, sum) = if let Some(words) = &words {
            let (outline, sum) = words
                .iter()
                .fold((0, 0), |(outline, sum), n| (outline | n.unsigned_abs(), sum + u128::from(n.unsigned_abs())));
            ((u64::BITS - outline.leading_zeros()) as usize, (u128::BITS - sum.leading_zeros()) as usize)
        } else {
            let mut longest = 0;
            for c in coefficients {
                longest = longest.max(c.to_large()?.significant_bits() as usize);
            }
            (longest, longest + (usize::BITS - coefficients.len().leading_zeros()) as usize)
        };
        Some(Self { coefficients, words, longest, sum })
    }
}

/// A variable's field: its lowest bit, and its lowest and highest exponents.
pub(super) struct Field {
    pub(super) shift: u32,
    pub(super) lowest: usize,
    pub(super) highest: usize,
}

impl Field {
    /// Returns the field of the only variable in these monomials, which decrease.
    pub(super) fn new(packing: Packing, variable: usize, monomials: &[u64]) -> Self {
        let shift = packing.place(variable).1;
        let exponent = |monomial: Option<&u64>| monomial.map_or(0, |word| packing.field(*word, shift) as usize);
        Self { shift, lowest: exponent(monomials.last()), highest: exponent(monomials.first()) }
    }

    pub(super) const fn slots(&self) -> usize {
        self.highest - self.lowest + 1
    }

    /// Returns the slot of a monomial.
    fn slot(&self, monomial: u64) -> usize {
        // No other field is occupied.
        usize::try_from(monomial >> self.shift).unwrap_or(0) - self.lowest
    }

    /// Returns the coefficients in their slots; `None` where they are no integers.
    fn placed<'a, R: Ring>(&self, monomials: &[u64], coefficients: &'a [R]) -> Option<Vec<Placed<'a>>> {
        monomials.iter().zip(coefficients).map(|(monomial, c)| Some((self.slot(*monomial), c.to_large()?))).collect()
    }

    /// Returns the absolute value of the polynomial at `2^width`, divided by its lowest power, and whether it is negative.
    pub(super) fn value<R: Ring>(&self, width: usize, monomials: &[u64], numbers: &Numbers<R>) -> (Integer, bool) {
        let mut writer = Writer::new(width, self.slots());
        let slots = monomials.iter().rev().map(|monomial| self.slot(*monomial));
        if let Some(words) = &numbers.words {
            let negative = words.first().is_some_and(|n| *n < 0);
            if words.len() == self.slots() {
                writer.words((0..words.len()).zip(words.iter().rev().copied()), negative);
            } else {
                writer.words(slots.zip(words.iter().rev().copied()), negative);
            }
            return (writer.finish(), negative);
        }
        let negative = numbers.coefficients.first().and_then(Ring::to_large).is_some_and(|n| n.is_negative());
        let mut buffer = Vec::new();
        for (slot, c) in slots.zip(numbers.coefficients.iter().rev()) {
            if let Some(n) = c.to_large() {
                buffer.resize(n.significant_digits::<u64>(), 0);
                n.write_digits(&mut buffer, Order::Lsf);
                writer.large(slot, &buffer, n.is_negative() != negative);
            }
        }
        (writer.finish(), negative)
    }
}

/// Returns the variable that alone occurs in monomials of one word, if there is one.
pub(super) fn only_variable(packing: Packing, left: &[u64], right: &[u64]) -> Option<usize> {
    let outline = left.iter().chain(right).fold(0, |or, monomial| or | monomial);
    let variable = (0..packing.variables()).find(|variable| packing.field(outline, packing.place(*variable).1) > 0)?;
    let (_, shift) = packing.place(variable);
    (outline == u64::from(packing.field(outline, shift)) << shift).then_some(variable)
}

/// Returns the product of two polynomials, not zero, with monomials of one word that have room for it: monomials and coefficients, some of
/// which may be zero; `None` if another variable occurs, or where other ways are faster.
pub(super) fn product<R: Ring>(
    packing: Packing,
    (left, a): (&[u64], &[R]),
    (right, b): (&[u64], &[R]),
) -> Option<(Vec<u64>, Vec<R>)> {
    let is_integer = |c: &R| c.to_wide().is_some() || c.to_large().is_some();
    let variable = a.first().filter(|c| is_integer(c)).and_then(|_| only_variable(packing, left, right))?;
    let (f, g) = (Field::new(packing, variable, left), Field::new(packing, variable, right));
    let slots = f.slots() + g.slots() - 1;
    let pairs = a.len().saturating_mul(b.len());
    let terms = a.len() + b.len();
    if slots > pairs.saturating_mul(MOST_PER_PAIR) {
        return None;
    }
    let (m, n) = (Numbers::new(a)?, Numbers::new(b)?);
    // A coefficient of the product is at most the sum of all of one factor times the largest of the other.
    let width = (m.sum + n.longest).min(n.sum + m.longest) + 2;
    let lowest = ((f.lowest + g.lowest) as u64) << f.shift;
    let monomials = || (0..slots as u64).rev().map(|slot| lowest + (slot << f.shift)).collect();
    if let (Some(m), Some(n)) = (&m.words, &n.words)
        && pairs <= FEW
        && width <= WIDE
    {
        let mut sums = vec![0_i128; slots];
        for (monomial, c) in left.iter().zip(m) {
            let sums = &mut sums[f.slot(*monomial)..];
            for (other, d) in right.iter().zip(n) {
                sums[g.slot(*other)] += i128::from(*c) * i128::from(*d);
            }
        }
        return Some((monomials(), sums.into_iter().rev().map(R::from_wide).collect()));
    }
    let limbs = |field: &Field| (field.slots() * width) as f64 / LIMB as f64 + 1.0;
    let (short, long) = (limbs(&f).min(limbs(&g)), limbs(&f).max(limbs(&g)));
    let cost = long / short * balanced(short);
    if slots > terms && cost + SLOT * slots as f64 > PAIR * pairs as f64 {
        return None;
    }
    if let Some(transform) = Transform::new(width, slots).filter(|transform| transform.cost() < cost) {
        let product = transform.product(&f.placed(left, a)?, &g.placed(right, b)?, slots);
        return Some((monomials(), product.into_iter().rev().map(R::from_large).collect()));
    }
    let ((a, s), (b, t)) = (f.value(width, left, &m), g.value(width, right, &n));
    // Squares are cheaper.
    let product = if a == b { a.square() } else { a * b };
    let mut reader = Reader::new(&product, width, slots, s != t);
    let coefficients: Vec<R> = match width {
        ..65 => reader.words(slots).into_iter().map(R::from_word).collect(),
        65..129 => (0..slots).rev().map(|slot| R::from_wide(reader.pair(slot))).collect(),
        _ => (0..slots).rev().map(|slot| R::from_large(reader.large(slot))).collect(),
    };
    Some((monomials(), coefficients))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use crate::polynomial::Polynomial;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    /// Polynomials in the second variable, with gaps and without a constant term.
    fn polynomial() -> impl Strategy<Value = Poly> {
        let number = (any::<i64>(), 0..64_u32, prop::sample::select(vec![0_u32, 0, 0, 90]))
            .prop_map(|(n, less, more)| Int::from(Integer::from(n >> less) << more));
        (prop::collection::vec((0..40_u32, number), 1..30), 0..3_u32)
            .prop_map(|(terms, low)| Poly::from_terms(terms.into_iter().map(|(e, c)| (vec![0, e + low], c))))
    }

    proptest! {
        #[test]
        fn products_are_those_of_the_terms((f, g) in (polynomial(), polynomial())) {
            prop_assume!(!f.is_zero() && !g.is_zero());
            let packing = Packing::new(2, 100);
            let (left, right) = (f.packed_as(packing), g.packed_as(packing));
            let second = |exponents: &[u32]| exponents.get(1).copied().unwrap_or(0);
            let times = |(e, c): (Vec<u32>, &Int)| {
                let term = |(d, b): (Vec<u32>, &Int)| (vec![0, second(&e) + second(&d)], b.mul(c));
                f.terms().map(term).collect::<Vec<_>>()
            };
            let expected = Poly::from_terms(g.terms().flat_map(times));
            if let Some((monomials, coefficients)) = product(packing, (&left, f.coefficients()), (&right, g.coefficients())) {
                prop_assert_eq!(Poly::from_sorted(packing, monomials, coefficients), expected);
            }
        }
    }

    #[test]
    fn other_variables_are_left_to_others() {
        let (x, y) = (Poly::variable(0), Poly::variable(1));
        let (f, g) = (x.add(&Poly::one()), y.add(&Poly::one()));
        let packing = Packing::new(2, 100);
        let packed = |f: &Poly| f.packed_as(packing).into_owned();
        assert!(product(packing, (&packed(&f), f.coefficients()), (&packed(&g), g.coefficients())).is_none());
        assert!(product(packing, (&packed(&g), g.coefficients()), (&packed(&g), g.coefficients())).is_some());
    }
}
