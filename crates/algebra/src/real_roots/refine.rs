//! Shrinking the interval of a root, and its f64 values.

use super::RealRoot;
use super::bernstein::ROUGH_BITS;
use super::cell::{Cell, compare, dyadic};
use super::evaluate::{Value, length, reach, shifted, sign, value_at};
use super::isolate::{GUESS_BITS, Guess, Place};
use super::rough::{self, leading};
use super::short::HIGHEST;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// The bits of the significand of an f64, and the power of two of its finest place.
const SIGNIFICAND: i64 = 53;
const FINEST: i64 = -1074;

/// The initial precision of values, and the bits required beyond those of two secant steps.
const VALUE_PRECISION: i64 = 64;
const VALUE_GUARD: i64 = 8;

/// Returns the f64 nearest to `numerator 2^exponent`, ties to even; infinite beyond the range.
fn nearest(numerator: &Integer, exponent: i64) -> f64 {
    let place = (exponent + length(numerator) - SIGNIFICAND).max(FINEST);
    let dropped = place - exponent;
    let size = Integer::from(numerator.abs_ref());
    let rounded = if dropped <= 0 {
        size << u32::try_from(-dropped).unwrap_or(u32::MAX)
    } else if dropped > length(&size) + 1 {
        Integer::new()
    } else {
        let bits = u32::try_from(dropped).expect("not above the length of the number");
        let mut quotient = Integer::from(&size >> bits);
        let rest = size - Integer::from(&quotient << bits);
        let half = Integer::from(1) << (bits - 1);
        let up = match rest.cmp(&half) {
            Ordering::Less => false,
            Ordering::Equal => quotient.is_odd(),
            Ordering::Greater => true,
        };
        quotient += u32::from(up);
        quotient
    };
    // Exact: at most 53 bits, and the place is one that an f64 has.
    let value = if length(&rounded) + place > 1024 { f64::INFINITY } else { power_of_two(rounded.to_f64(), place) };
    if numerator.is_negative() { -value } else { value }
}

/// Returns `2^exponent x` if that is an f64.
fn power_of_two(x: f64, exponent: i64) -> f64 {
    let exponent = i32::try_from(exponent).expect("within the range of an f64");
    let half = exponent / 2;
    x * 2.0_f64.powi(half) * 2.0_f64.powi(exponent - half)
}

/// Returns an f64 as a rational, the infinite ones as the next power of two.
fn exactly(x: f64) -> Rational {
    Rational::from_f64(x).unwrap_or_else(|| {
        let end = Rational::from(1) << 1024_u32;
        if x > 0.0 { end } else { -end }
    })
}

impl RealRoot {
    /// Compares the root with a number: `Less` if the root is less.
    #[must_use]
    pub fn compare(&self, x: &Rational) -> Ordering {
        match &self.place {
            Place::At(numerator, exponent) => dyadic(numerator, *exponent).cmp(x),
            // The root is inside, never at an end.
            Place::Within(cell, ..) if cell.hi() <= *x => Ordering::Less,
            Place::Within(cell, ..) if cell.lo() >= *x => Ordering::Greater,
            Place::Within(_, left, _) => match self.polynomial.sign_at(x) {
                Ordering::Equal => Ordering::Equal,
                sign if sign == 0.cmp(&-*left) => Ordering::Greater,
                _ => Ordering::Less,
            },
        }
    }

    /// Compares the left ends of the intervals of two roots.
    pub(super) fn compare_start(&self, other: &Self) -> Ordering {
        compare(self.place.start(), other.place.start())
    }

    /// Returns whether the closed intervals of two roots have a point in common.
    pub(super) fn touches(&self, other: &Self) -> bool {
        let begins_by_the_end = |one: &Self, other: &Self| match &other.place {
            Place::At(..) => compare(one.place.start(), other.place.start()).is_le(),
            Place::Within(cell, ..) => compare(one.place.start(), (&cell.end(), cell.exponent)).is_le(),
        };
        begins_by_the_end(self, other) && begins_by_the_end(other, self)
    }

    /// Divides the width of the interval by `2^bits`.
    pub(super) fn shrink(&mut self, bits: i64) {
        if let Place::Within(cell, ..) = &self.place {
            let target = cell.exponent - bits;
            self.refine_to(target, u32::try_from(bits).unwrap_or(1));
        }
    }

    /// Shrinks the interval to at most the given width.
    ///
    /// # Panics
    /// When the width is not positive.
    pub fn refine(&mut self, width: &Rational) {
        assert!(width.cmp0() == Ordering::Greater, "the width is positive, got {width}");
        self.refine_to(length(width.numer()) - length(width.denom()) - 1, 1);
    }

    /// Shrinks the cell to one of at most the given exponent, the first step trying that many bits.
    ///
    /// # Source
    /// Abbott 2014, "Quadratic interval refinement for real roots", ACM Communications in Computer Algebra 48: of
    /// `2^k` parts, k doubling with every success, the secant names two; signs decide whether the root is in one.
    fn refine_to(&mut self, target: i64, mut bits: u32) {
        let Place::Within(cell, left, known) = &self.place else { return };
        let (mut cell, left, mut known, mut precision) = (cell.clone(), *left, *known, VALUE_PRECISION);
        if known.is_none() && cell.exponent > target {
            known = self.guess(&cell, left);
        }
        if let Some(guess) = known {
            bits = guess.bits;
        }
        let mut value = |numerator: &Integer, exponent: i64, bits: u32| {
            let wanted = 2 * i64::from(bits) + VALUE_GUARD;
            value_at(self.polynomial.coefficients(), numerator, exponent, wanted, &mut precision)
        };
        let mut ends = None;
        while cell.exponent > target {
            bits = bits.min(u32::try_from(cell.exponent - target).unwrap_or(u32::MAX));
            if bits == 1 {
                // The sign in the middle is enough.
                let (middle, exponent) = (Integer::from(&cell.numerator << 1_u32) + 1_u32, cell.exponent - 1);
                let index = match sign(&value(&middle, exponent, 0).mantissa) {
                    0 => {
                        self.place = Place::At(middle, exponent);
                        return;
                    }
                    sign => Integer::from(i32::from(sign == left)),
                };
                (ends, known) = (None, known.and_then(|guess| guess.within(&index, 1)));
                bits = known.map_or(2, |guess| guess.bits);
                cell = Cell::new(middle - 1_u32 + index, exponent);
                continue;
            }
            let parts = Integer::from(1) << bits;
            let guess = if let Some(guess) = known {
                guess.corner(bits)
            } else {
                let (from, to) = ends.get_or_insert_with(|| {
                    (value(&cell.numerator, cell.exponent, bits), value(&cell.end(), cell.exponent, bits))
                });
                secant(from, to, bits)
            };
            let exponent = cell.exponent - i64::from(bits);
            let start = Integer::from(&cell.numerator << bits);
            let mut inspect = |index: &Integer| {
                // The ends of the cell may be other roots; the signs inside matter, and values are known.
                let known = ends.as_ref().filter(|_| *index == 0 || *index == parts);
                let value = match known {
                    Some((from, to)) => {
                        if *index == 0 {
                            from.clone()
                        } else {
                            to.clone()
                        }
                    }
                    None => value(&Integer::from(&start + index), exponent, bits),
                };
                let sign = match (*index == 0, *index == parts) {
                    (true, _) => left,
                    (_, true) => -left,
                    _ => sign(&value.mantissa),
                };
                (value, sign)
            };
            let (middle, middle_sign) = inspect(&guess);
            let right = middle_sign == left;
            let neighbour = if right { Integer::from(&guess + 1) } else { Integer::from(&guess - 1) };
            let (other, other_sign) = inspect(&neighbour);
            for (index, sign) in [(&guess, middle_sign), (&neighbour, other_sign)] {
                if sign == 0 {
                    self.place = Place::At(start + index, exponent);
                    return;
                }
            }
            if other_sign == middle_sign {
                known = None;
                bits = (bits / 2).max(1);
                continue;
            }
            let index = if right { guess } else { neighbour };
            ends = Some(if right { (middle, other) } else { (other, middle) });
            known = known.and_then(|guess| guess.within(&index, bits));
            bits = known.map_or(bits.saturating_mul(2), |guess| guess.bits);
            cell = Cell::new(start + index, exponent);
        }
        self.place = Place::Within(cell, left, known);
    }

    /// Returns where the root probably is in its cell, if the degree is low and f64 tells; the search that found such roots asks for no guess.
    fn guess(&self, cell: &Cell, left: i8) -> Option<Guess> {
        let coefficients = self.polynomial.coefficients();
        if coefficients.len() > HIGHEST + 1 {
            return None;
        }
        // On the right of 0.
        let mirrored = cell.numerator < 0;
        let lead = |(i, c): (usize, &Integer)| {
            let (mantissa, exponent) = leading(c);
            (if mirrored && i % 2 == 1 { -mantissa } else { mantissa }, exponent)
        };
        let leads: Vec<(f64, i64)> = coefficients.iter().enumerate().map(lead).collect();
        let cell = if mirrored { cell.mirrored() } else { cell.clone() };
        let expansion = rough::expand(&leads, reach(coefficients, cell.exponent + length(&cell.numerator)), &cell);
        if !expansion.stands_out(ROUGH_BITS) {
            return None;
        }
        let y = expansion.guess_root(if mirrored { -left } else { left })?;
        Some(Guess { y: if mirrored { 1.0 - y } else { y }, bits: GUESS_BITS })
    }

    /// Returns the root rounded to the nearest f64, ties to even; infinite beyond the range. Shrinks the interval for that.
    pub fn to_f64(&mut self) -> f64 {
        loop {
            let cell = match &self.place {
                Place::At(numerator, exponent) => return nearest(numerator, *exponent),
                Place::Within(cell, ..) => cell,
            };
            let lo = nearest(&cell.numerator, cell.exponent);
            let hi = nearest(&cell.end(), cell.exponent);
            if lo == hi {
                return lo;
            }
            if hi == lo.next_up() {
                let middle = (exactly(lo) + exactly(hi)) / 2_u32;
                return match self.compare(&middle) {
                    Ordering::Less => lo,
                    Ordering::Greater => hi,
                    Ordering::Equal => nearest(middle.numer(), 1 - length(middle.denom())),
                };
            }
            let target = cell.exponent + length(&cell.numerator) - SIGNIFICAND - 2;
            self.refine_to(target, 1);
        }
    }

    /// Returns the tightest pair of f64 that encloses the root: neighbours, or twice the root if it is an f64; an infinite
    /// end beyond the range.
    pub fn enclosure(&mut self) -> (f64, f64) {
        let value = self.to_f64();
        if value.is_infinite() {
            return if value > 0.0 { (f64::MAX, value) } else { (value, f64::MIN) };
        }
        match self.compare(&exactly(value)) {
            Ordering::Less => (value.next_down(), value),
            Ordering::Equal => (value, value),
            Ordering::Greater => (value, value.next_up()),
        }
    }
}

impl Guess {
    /// Returns the nearest corner among those of `2^bits` parts, at most as many bits as are relied upon.
    fn corner(self, bits: u32) -> Integer {
        let parts = Integer::from(1) << bits;
        let nearest = Integer::from_f64((self.y * parts.to_f64()).round()).unwrap_or_default();
        nearest.max(Integer::new()).min(parts)
    }

    /// Returns the guess within the part at `index` of `2^bits`, if any bits are left.
    fn within(self, index: &Integer, bits: u32) -> Option<Self> {
        let y = self.y * (Integer::from(1) << bits).to_f64() - index.to_f64();
        (bits < self.bits).then(|| Self { y: y.clamp(0.0, 1.0), bits: self.bits - bits })
    }
}

/// Returns which of `2^bits` parts the secant through the values at the ends meets, rounded to the nearest corner.
fn secant(from: &Value, to: &Value, bits: u32) -> Integer {
    let unit = from.unit.min(to.unit);
    let (from, to) = (shifted(&from.mantissa, from.unit - unit), shifted(&to.mantissa, to.unit - unit));
    let slope = &from - to;
    let parts = Integer::from(1) << bits;
    if slope == 0 {
        return parts >> 1_u32;
    }
    let doubled: Integer = (from << (bits + 1)) / slope;
    let corner: Integer = (doubled + 1_u32) >> 1_u32;
    corner.max(Integer::new()).min(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_to_nearest_even() {
        let (one, big) = (Integer::from(1), (Integer::from(1) << 54_u32) + 1_u32);
        assert_eq!(nearest(&big, -54), 1.0);
        assert_eq!(nearest(&Integer::from(&big + 1_u32), -54), 1.0);
        assert_eq!(nearest(&Integer::from(&big + 2_u32), -54), 1.0_f64.next_up());
        assert_eq!(nearest(&Integer::from(&big + 5_u32), -54), 1.0_f64.next_up().next_up());
        assert_eq!(nearest(&one, -1074), f64::from_bits(1));
        assert_eq!(nearest(&one, -1075), 0.0);
        assert_eq!(nearest(&Integer::from(3), -1076), f64::from_bits(1));
        assert_eq!(nearest(&Integer::from(-3), -1075), -f64::from_bits(2));
        assert_eq!(nearest(&one, -5000), 0.0);
        assert_eq!(nearest(&one, 1023), 2.0_f64.powi(1023));
        assert_eq!(nearest(&one, 1024), f64::INFINITY);
        let tie = (Integer::from(1) << 54_u32) - 1_u32;
        assert_eq!(nearest(&tie, 970), f64::INFINITY);
        assert_eq!(nearest(&(tie * 2_u32 - 1_u32), 969), f64::MAX);
        assert_eq!(nearest(&Integer::new(), 3), 0.0);
    }
}
