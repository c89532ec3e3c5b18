//! Numbers in slots of equal width along one long integer: laid down in one pass, and read off again.
//!
//! # Why the numbers are right
//! Let all numbers `c_i` be at most `2^(B-2)` in absolute value. What lies below slot i, the sum of the `c_j 2^(Bj)` over j < i, is then
//! below `2^(Bi-1)` in absolute value, and therefore the bit below slot i, in two's complement, tells whether it is negative. If so, slot i
//! holds `c_i - 1` modulo `2^B`, else `c_i`, and both lie from `-2^(B-1)` to `2^(B-1) - 1`, which determines `c_i`. The same says what to lay
//! down: `c_i` less one where what lies below is negative, which it is where the last number below that is not zero is.

use rug::{Integer, integer::Order};

/// Bits of a limb.
pub(super) const LIMB: usize = 64;

/// Lays numbers down from the lowest slot upwards.
pub(super) struct Writer {
    limbs: Vec<u64>,
    /// The number of limbs that are full.
    at: usize,
    /// The limb that is being filled, and how many of its bits are.
    limb: u64,
    filled: usize,
    width: usize,
    /// The next slot.
    slot: usize,
    /// 1 if what lies below is negative.
    borrow: u64,
}

impl Writer {
    /// Starts with room for so many slots of so many bits.
    pub(super) fn new(width: usize, slots: usize) -> Self {
        let limbs = vec![0; slots * width / LIMB + 2];
        Self { limbs, at: 0, limb: 0, filled: 0, width, slot: 0, borrow: 0 }
    }

    /// Appends the lowest bits of a limb, at least one; the others are zero.
    #[inline(always)]
    fn put(&mut self, bits: u64, count: usize) {
        self.limb |= bits << self.filled;
        self.limbs[self.at] = self.limb;
        let filled = self.filled + count;
        if filled >= LIMB {
            self.at += 1;
            // In two steps, because a shift by 64 is none.
            self.limb = (bits >> 1) >> (LIMB - 1 - self.filled);
        }
        self.filled = filled % LIMB;
    }

    /// Appends so many bits, all alike.
    fn fill(&mut self, mut count: usize, ones: bool) {
        let pattern = if ones { u64::MAX } else { 0 };
        while count > 0 {
            let next = count.min(LIMB - self.filled);
            self.put(pattern >> (LIMB - next), next);
            count -= next;
        }
    }

    /// Goes on to a slot; those passed over hold zeros.
    #[inline(always)]
    fn skip_to(&mut self, slot: usize) {
        if slot > self.slot {
            self.fill((slot - self.slot) * self.width, self.borrow == 1);
        }
        self.slot = slot + 1;
    }

    /// Lays words down in the slots beside them, which increase and lie above all before; all change their sign if it says so.
    #[inline(always)]
    pub(super) fn words(&mut self, terms: impl Iterator<Item = (usize, i64)>, negate: bool) {
        if self.width > LIMB {
            return terms.for_each(|(slot, n)| self.long_word(slot, n, negate));
        }
        // What is kept in registers.
        let (width, mask) = (self.width, u64::MAX >> (LIMB - self.width));
        let (mut borrow, mut next, mut at, mut limb, mut filled) =
            (self.borrow.cast_signed(), self.slot, self.at, self.limb, self.filled);
        for (slot, n) in terms {
            if slot > next {
                (self.at, self.limb, self.filled) = (at, limb, filled);
                self.fill((slot - next) * width, borrow == 1);
                (at, limb, filled) = (self.at, self.limb, self.filled);
            }
            next = slot + 1;
            // Of fewer than 63 bits, so that neither step overflows.
            let n = if negate { n.wrapping_neg() } else { n }.wrapping_sub(borrow);
            borrow = i64::from(n < 0);
            let bits = n.cast_unsigned() & mask;
            limb |= bits << filled;
            self.limbs[at] = limb;
            filled += width;
            if filled >= LIMB {
                at += 1;
                filled -= LIMB;
                // In two steps, because a shift by 64 is none.
                limb = (bits >> 1) >> (width - 1 - filled);
            }
        }
        (self.borrow, self.slot, self.at, self.limb, self.filled) = (borrow.cast_unsigned(), next, at, limb, filled);
    }

    /// Lays a word down in a slot of more than a limb.
    fn long_word(&mut self, slot: usize, n: i64, negate: bool) {
        self.skip_to(slot);
        let n = if negate { -i128::from(n) } else { i128::from(n) } - i128::from(self.borrow);
        self.borrow = u64::from(n < 0);
        #[expect(clippy::cast_possible_truncation, reason = "the lowest limb is meant")]
        self.put(n.cast_unsigned() as u64, LIMB);
        self.fill(self.width - LIMB, n < 0);
    }

    /// Lays a number other than zero down in a slot above all before: its absolute value, lowest limb first, and its sign.
    pub(super) fn large(&mut self, slot: usize, magnitude: &[u64], negative: bool) {
        self.skip_to(slot);
        let mut left = self.width;
        // For a negative number `-m - borrow` is the complement of `m - 1 + borrow`.
        let mut less = if negative { 1 - self.borrow } else { self.borrow };
        for limb in magnitude {
            let (limb, below) = limb.overflowing_sub(less);
            less = u64::from(below);
            let count = left.min(LIMB);
            if count == 0 {
                break;
            }
            let limb = if negative { !limb } else { limb };
            self.put(limb & (u64::MAX >> (LIMB - count)), count);
            left -= count;
        }
        self.fill(left, negative);
        self.borrow = u64::from(negative);
    }

    /// Returns the integer, in which the number of the highest slot must be positive.
    pub(super) fn finish(mut self) -> Integer {
        self.limbs[self.at] = self.limb;
        Integer::from_digits(&self.limbs[..=self.at], Order::Lsf)
    }
}

/// Reads numbers off slots; all of them change their sign if it says so.
pub(super) struct Reader {
    digits: Vec<u64>,
    width: usize,
    negative: bool,
    buffer: Vec<u64>,
}

impl Reader {
    /// Starts with an integer that is not negative, and the number of its slots.
    pub(super) fn new(value: &Integer, width: usize, slots: usize, negative: bool) -> Self {
        // Slots that end beyond the highest digit are read too.
        let mut digits = vec![0; ((slots + 1) * width / LIMB + 3).max(value.significant_digits::<u64>())];
        value.write_digits(&mut digits, Order::Lsf);
        Self { digits, width, negative, buffer: vec![0; width.div_ceil(LIMB)] }
    }

    /// Returns the bit below a slot, which tells whether what lies below is negative.
    #[inline(always)]
    fn borrow(&self, bit: usize) -> u64 {
        if bit == 0 { 0 } else { self.digits[(bit - 1) / LIMB] >> ((bit - 1) % LIMB) & 1 }
    }

    /// Returns the 64 bits from a bit on.
    #[inline(always)]
    fn digit(&self, bit: usize) -> u64 {
        let (first, shift) = (bit / LIMB, bit % LIMB);
        // In two steps, because a shift by 64 is none.
        self.digits[first] >> shift | (self.digits[first + 1] << 1) << (LIMB - 1 - shift)
    }

    /// Returns the number in a slot of at most 64 bits.
    #[inline(always)]
    pub(super) fn word(&self, slot: usize) -> i64 {
        let bit = slot * self.width;
        let unused = LIMB - self.width;
        // Numbers as the head says never overflow; others need not be right.
        let n = ((self.digit(bit) << unused).cast_signed() >> unused).wrapping_add(self.borrow(bit).cast_signed());
        if self.negative { n.wrapping_neg() } else { n }
    }

    /// Returns the numbers in the lowest slots, of at most 64 bits, from the highest one down.
    pub(super) fn words(&self, slots: usize) -> Vec<i64> {
        let unused = LIMB - self.width;
        let raw = |slot: usize| (self.digit(slot * self.width) << unused).cast_signed() >> unused;
        let mut above = if slots == 0 { 0 } else { raw(slots - 1) };
        let mut words = Vec::with_capacity(slots);
        for slot in (0..slots).rev() {
            // The highest bit of the slot below is the borrow.
            let below = if slot == 0 { 0 } else { raw(slot - 1) };
            let n = above.wrapping_add(i64::from(below < 0));
            above = below;
            words.push(if self.negative { n.wrapping_neg() } else { n });
        }
        words
    }

    /// Returns the number in a slot of 65 to 128 bits.
    #[inline(always)]
    pub(super) fn pair(&self, slot: usize) -> i128 {
        let bit = slot * self.width;
        let unused = 2 * LIMB - self.width;
        let digits = u128::from(self.digit(bit)) | u128::from(self.digit(bit + LIMB)) << LIMB;
        let n = ((digits << unused).cast_signed() >> unused) + i128::from(self.borrow(bit));
        if self.negative { -n } else { n }
    }

    /// Returns a bound of the bits of the number in a slot.
    pub(super) fn bits(&mut self, slot: usize) -> usize {
        if self.width <= LIMB {
            return (u64::BITS - self.word(slot).unsigned_abs().leading_zeros()) as usize;
        }
        self.lift(slot);
        let highest = self.buffer.iter().rposition(|limb| *limb != 0);
        highest.map_or(0, |i| (i + 1) * LIMB - self.buffer[i].leading_zeros() as usize)
    }

    /// Returns the number in a slot of any width.
    pub(super) fn large(&mut self, slot: usize) -> Integer {
        let negative = self.lift(slot);
        let n = Integer::from_digits(&self.buffer, Order::Lsf);
        if negative == self.negative { n } else { -n }
    }

    /// Leaves the absolute value of the number in a slot in the buffer, and returns whether it is negative there.
    fn lift(&mut self, slot: usize) -> bool {
        let bit = slot * self.width;
        let count = self.width.div_ceil(LIMB);
        let used = self.width - (count - 1) * LIMB;
        let negative = self.digit(bit + (count - 1) * LIMB) << (LIMB - used) >> (LIMB - 1) == 1;
        // The complement of a negative number, n, is `-n - 1`.
        let (flip, mut carry) = if negative { (u64::MAX, 1 - self.borrow(bit)) } else { (0, self.borrow(bit)) };
        for i in 0..count {
            let mut limb = self.digit(bit + i * LIMB) ^ flip;
            if i == count - 1 {
                limb &= u64::MAX >> (LIMB - used);
            }
            let (sum, above) = limb.overflowing_add(carry);
            (self.buffer[i], carry) = (sum, u64::from(above));
        }
        negative
    }
}
