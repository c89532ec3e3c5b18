//! Real roots of polynomials of low degree with simple real roots, by f64 alone: no big integer is touched unless a root may lie at a
//! corner of the grid.
//!
//! # Why the answer is right
//! On a cell, Descartes' rule counts the sign changes of the Bernstein coefficients: with none there is no root inside, with one there is
//! one and it is simple, whether or not the polynomial has multiple roots elsewhere. All counts are of certain signs, and
//! where a corner is a root it is shown to be simple by the coefficient beside it, which is the slope. Anything that f64 does not settle
//! is `None`, and left to the general search.
//!
//! # The error
//! Let u be `2^-53`. A scaled coefficient `a_i` is wrong by 2 u in proportion, the weight `1/C(n,i)` and their product add 2 u. The
//! Bernstein coefficient `sum_i C(j,i)/C(n,i) a_i` is formed by n additions in a row, each within u of a sum of such terms, and
//! `C(j,i)` is at most `C(n,i)`: it is wrong by less than `1.01 (n + 4) u sum |a_i|`. Numbers below the range of f64 add less
//! than `2^-900`. See [`rough::error_of_halving`] for the rest.

use super::bernstein::Expansion;
use super::cell::Cell;
use super::evaluate::{length, sign, value_at};
use super::isolate::Place;
use super::rough::{self, error_of_halving, power_of_two};
use pulp::Arch;
use rug::Integer;

/// The highest degree: binomials of it, and of the lower ones times them, are exact in f64, and beyond it f64 settles little.
pub(super) const HIGHEST: usize = 50;
/// The most halvings of the first cell in a row, and the most cells for each degree: others need more bits, or are clusters.
const DEEPEST: u32 = 30;
const CELLS: usize = 12;
/// How many times the error the largest coefficient of a cell must be for another halving to be of use.
const LASTING: f64 = 4096.0;
/// The exponent of two below which a coefficient is left out; n times `2^n` of them are still below `2^-900`.
const LEAST: i64 = -1000;
const DUST: i64 = -900;

/// A polynomial as f64 sees it: the leading bits of each coefficient, between 1/2 and 1 or 0, and the power of two left out.
type Leads = [(f64, i64)];

/// Returns the places of the real roots, all simple, of a polynomial of a degree from 1 to [`HIGHEST`] that does not vanish at 0, from left to right; no
/// two of the closed intervals meet, nor one of them 0 if that is `taken`. `None` if f64 does not settle them. `exactly` gives
/// the coefficients.
pub(super) fn isolate(leads: &Leads, taken: bool, exactly: &dyn Fn() -> Vec<Integer>) -> Option<Vec<Place>> {
    let weights = weights(leads.len() - 1);
    let zero = taken.then_some((0, 0));
    let left = leads.len() * CELLS;
    let mut search = Search { exactly, exact: Vec::new(), places: Vec::new(), left, before: zero };
    let negated = |(i, &(m, e)): (usize, &(f64, i64))| (if i % 2 == 1 { -m } else { m }, e);
    search.side(&leads.iter().enumerate().map(negated).collect::<Vec<_>>(), &weights, true)?;
    let mut places: Vec<Place> = std::mem::take(&mut search.places).into_iter().rev().map(Place::mirrored).collect();
    // The last interval of the negatives may end at 0.
    let ends_at_zero = |place: &Place| matches!(place, Place::Within(cell, ..) if cell.numerator == -1);
    search.before = places.last().filter(|place| ends_at_zero(place)).map_or(zero, |_| Some((0, 0)));
    search.side(leads, &weights, false)?;
    places.append(&mut search.places);
    Some(places)
}

/// Returns a number as f64 sees it: wrong by less than `2^-52` in proportion.
pub(super) fn lead_of_word(n: i64) -> (f64, i64) {
    // The bits of a float behind its exponent, and what stands there for the numbers from 1/2 to 1.
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    const HALF: u64 = 1022;
    if n == 0 {
        return (0.0, 0);
    }
    let bits = (n as f64).to_bits();
    let exponent = bits >> FRACTION & 0x7ff;
    (f64::from_bits(bits & !(0x7ff << FRACTION) | HALF << FRACTION), exponent.cast_signed() - HALF.cast_signed())
}

/// Returns `1/C(n,i)` for all i.
fn weights(n: usize) -> Vec<f64> {
    let mut binomial = 1.0;
    let weight = |i: usize| {
        let weight = 1.0 / binomial;
        // A product below 2^53, divided without a remainder.
        binomial = binomial * (n - i) as f64 / (i + 1) as f64;
        weight
    };
    (0..=n).map(weight).collect()
}

/// Returns the exponent of a power of two above all positive roots (Kioustelidis 1986); `None` if there are none.
fn bound(leads: &Leads) -> Option<i64> {
    let (&(top, length), rest) = leads.split_last()?;
    let other = (1_i64..).zip(rest.iter().rev()).filter(|(_, (m, _))| m * top < 0.0);
    other.map(|(steps, (_, own))| (own - length + 1).div_euclid(steps) + 2).max()
}

/// Returns the Bernstein coefficients on `(0, 2^k)`, scaled by some power of two, and their error.
#[inline(always)]
fn expand(leads: &Leads, weights: &[f64], k: i64) -> (Vec<f64>, f64) {
    let terms = || (0_i64..).zip(leads).map(|(i, &(m, e))| (m, e + k * i));
    let reach = terms().filter(|(m, _)| *m != 0.0).map(|(_, e)| e).max().unwrap_or(0);
    let mut size = 0.0;
    let scaled = terms().zip(weights).map(|((m, e), weight)| {
        let a = if m == 0.0 || e - reach < LEAST { 0.0 } else { m * power_of_two(e - reach) };
        size += a.abs();
        a * weight
    });
    // Room for the halves of the first few cells.
    let mut b: Vec<f64> = Vec::with_capacity(8 * leads.len());
    b.extend(scaled);
    for i in 1..b.len() {
        for j in (i..b.len()).rev() {
            b[j] += b[j - 1];
        }
    }
    let unit = f64::EPSILON / 2.0;
    // The size itself is wrong by less than a hundredth.
    let error = 1.01 * 1.01 * (leads.len() + 3) as f64 * unit * size + power_of_two(DUST);
    (b, error)
}

/// Computes the coefficients on a cell from the polynomial once more, and returns their error; `None` if that is too large as well.
fn renew(leads: &Leads, cell: &Cell, b: &mut [f64]) -> Option<f64> {
    let k = cell.exponent + length(&cell.numerator);
    let terms = (0_i64..).zip(leads).filter(|(_, (m, _))| *m != 0.0);
    let reach = terms.map(|(i, (_, e))| e + k * i).max()?;
    let Expansion::Rough { coefficients, error } = rough::expand(leads, reach, cell) else { return None };
    b.copy_from_slice(&coefficients);
    b.iter().any(|b| b.abs() >= LASTING * error).then_some(error)
}

/// Puts the coefficients of the right half of a cell in the place of those that begin at `start`, and those of the left half behind them.
#[inline(always)]
fn halve(stack: &mut Vec<f64>, start: usize) {
    let count = stack.len() - start;
    stack.resize(start + 2 * count, 0.0);
    let (right, left) = stack[start..].split_at_mut(count);
    for (step, left) in left.iter_mut().enumerate() {
        *left = right[0];
        for j in 0..count - 1 - step {
            right[j] = 0.5 * (right[j] + right[j + 1]);
        }
    }
}

/// Returns the number of sign changes among the certain signs, and whether those that are not certain add none.
#[inline(always)]
fn changes(b: &[f64], node: &Node) -> (u32, bool) {
    let last = b.len() - 1;
    let (mut changes, mut before, mut open, mut certain) = (0, node.signs.0, 0, true);
    for (j, b) in b.iter().enumerate().skip(1) {
        let sign = if j == last { node.signs.1 } else { i8::from(*b > node.error) - i8::from(*b < -node.error) };
        if sign == 0 {
            open += u32::from(j < last);
            continue;
        }
        // Between a plus and a minus there is one change, whatever a single number there is.
        certain &= open == 0 || open == 1 && before == -sign;
        changes += u32::from(before == -sign);
        (before, open) = (sign, 0);
    }
    (changes, certain && open == 0)
}

/// A cell `numerator 2^-depth` to the next corner, in units of the first cell.
struct Node {
    numerator: u64,
    depth: u32,
    error: f64,
    /// The signs at both ends, certain.
    signs: (i8, i8),
    /// Whether the left end is a root that is still to be reported.
    root: bool,
}

struct Search<'a> {
    exactly: &'a dyn Fn() -> Vec<Integer>,
    /// The coefficients, once asked for.
    exact: Vec<Integer>,
    places: Vec<Place>,
    /// The number of cells that may still be looked at.
    left: usize,
    /// Where the last interval ends that was found, as a numerator and a depth.
    before: Option<(u64, u32)>,
}

impl Search<'_> {
    /// Finds the positive roots of a polynomial, which is the given one or its mirror image.
    fn side(&mut self, leads: &Leads, weights: &[f64], mirrored: bool) -> Option<()> {
        let Some(k) = bound(leads) else { return Some(()) };
        Arch::new().dispatch(
            #[inline(always)]
            || self.positive(leads, weights, k, mirrored),
        )
    }

    #[inline(always)]
    fn positive(&mut self, leads: &Leads, weights: &[f64], k: i64, mirrored: bool) -> Option<()> {
        let (mut stack, error) = expand(leads, weights, k);
        let sign = |m: f64| i8::from(m > 0.0) - i8::from(m < 0.0);
        let count = leads.len();
        // No end is a root.
        let signs = (sign(leads[0].0), sign(leads[count - 1].0));
        // The cells that wait, the leftmost one last, as their coefficients lie in the stack.
        let mut nodes = vec![Node { numerator: 0, depth: 0, error, signs, root: false }];
        while let Some(node) = nodes.pop() {
            let Node { numerator, depth, signs: (first, last), .. } = node;
            let start = stack.len() - count;
            if node.root {
                self.places.push(Place::At(Integer::from(numerator), k - i64::from(depth)));
                self.before = Some((numerator, depth));
            }
            let (changes, certain) = changes(&stack[start..], &node);
            let touches = |(end, at): (u64, u32)| end << (DEEPEST - at) == numerator << (DEEPEST - depth);
            // An interval must not meet its neighbour, nor end at a root.
            let is_alone = || first != 0 && last != 0 && !self.before.is_some_and(touches);
            if certain && (changes == 0 || changes == 1 && is_alone()) {
                if changes == 1 {
                    let cell = Cell::new(Integer::from(numerator), k - i64::from(depth));
                    self.places.push(Place::Within(cell, first, None));
                    self.before = Some((numerator + 1, depth));
                }
                stack.truncate(start);
                continue;
            }
            self.left = self.left.checked_sub(1).filter(|_| depth < DEEPEST)?;
            let largest = stack[start..].iter().map(|b| b.abs()).fold(0.0, f64::max);
            if largest < LASTING * node.error {
                let error =
                    renew(leads, &Cell::new(Integer::from(numerator), k - i64::from(depth)), &mut stack[start..])?;
                nodes.push(Node { error, root: false, ..node });
                continue;
            }
            let error = node.error + error_of_halving(count, largest);
            halve(&mut stack, start);
            // What lies below now is the right half.
            let (numerator, depth) = (2 * numerator, depth + 1);
            let middle = match stack[start] {
                b if b > error => 1,
                b if b < -error => -1,
                _ => self.sign(numerator + 1, k - i64::from(depth), mirrored),
            };
            let root = middle == 0;
            if root && stack[start + 1].abs() <= error {
                return None;
            }
            nodes.push(Node { numerator: numerator + 1, depth, error, signs: (middle, last), root });
            nodes.push(Node { numerator, depth, error, signs: (first, middle), root: false });
        }
        Some(())
    }

    /// Returns the exact sign at `numerator 2^exponent`.
    #[cold]
    fn sign(&mut self, numerator: u64, exponent: i64, mirrored: bool) -> i8 {
        if self.exact.is_empty() {
            self.exact = (self.exactly)();
        }
        let numerator = Integer::from(numerator);
        let numerator = if mirrored { -numerator } else { numerator };
        sign(&value_at(&self.exact, &numerator, exponent, 0, &mut 256).mantissa)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use crate::real_roots::roots;
    use crate::ring::Ring;
    use crate::univariate::Univariate;
    use proptest::prelude::*;

    #[test]
    fn leads_of_words_are_those_of_big_integers() {
        for n in [0, 1, -1, 2, 3, -1000, (1 << 53) + 1, i64::MAX, i64::MIN, 1 << 40] {
            let (mantissa, exponent) = lead_of_word(n);
            assert_eq!(mantissa * f64::from(i32::try_from(exponent).unwrap()).exp2(), n as f64);
            assert!(n == 0 || (0.5..1.0).contains(&mantissa.abs()));
        }
    }

    #[test]
    fn the_highest_degrees_are_settled_as_by_the_general_search() {
        // A congruential generator (Knuth).
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i64::try_from(state >> 50).unwrap() - (1 << 13)
        };
        let mut settled = 0;
        for degree in (41..=HIGHEST).chain(41..=HIGHEST) {
            let coefficients: Vec<Integer> = (0..=degree).map(|_| Integer::from(next())).collect();
            let leads: Vec<(f64, i64)> = coefficients.iter().map(rough::leading).collect();
            settled += usize::from(isolate(&leads, false, &|| coefficients.clone()).is_some());
            let mut found = Univariate::new(coefficients.clone()).real_roots();
            let mut expected = roots(&coefficients);
            assert_eq!(found.len(), expected.len());
            assert!(found.iter_mut().zip(&mut expected).all(|(a, b)| a.to_f64() == b.to_f64()));
        }
        assert!(settled > 10, "{settled}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        /// Small coefficients have roots at corners of the grid, at 0 and at each other's negatives.
        #[test]
        fn roots_are_those_of_the_general_search(
            coefficients in prop::sample::select(vec![2_i64, 20, 1_000_000_000, i64::MAX])
                .prop_flat_map(|largest| prop::collection::vec(-largest..=largest, 2..14)),
            factors in prop::collection::vec((-6..=6_i64, 1..=3_i64), 0..8),
        ) {
            let factor = |&(a, b): &(i64, i64)| Univariate::new(vec![Integer::from(-a), Integer::from(b)]);
            let start = Univariate::new(coefficients.into_iter().map(Integer::from).collect());
            let poly = factors.iter().map(factor).fold(start, |product, factor| product.mul(&factor));
            prop_assume!(!poly.is_zero());
            let words = Univariate::new(poly.coefficients().iter().cloned().map(Int::from).collect());
            let (mut found, mut expected) = (poly.real_roots(), roots(poly.coefficients()));
            prop_assert_eq!(words.real_roots().len(), expected.len());
            prop_assert_eq!(found.len(), expected.len());
            prop_assert!(found.windows(2).all(|pair| pair[0].bounds().1 < pair[1].bounds().0));
            for (found, expected) in found.iter_mut().zip(&mut expected) {
                prop_assert_eq!(found.multiplicity(), expected.multiplicity());
                prop_assert_eq!(found.to_f64(), expected.to_f64());
            }
        }
    }
}
