//! Sums of powers modulo a prime, `v_j = sum_k c_k r_k^j`: from a few values to the roots, their logarithms and the coefficients.
//!
//! # Source
//! Ben-Or, Tiwari 1988, A deterministic algorithm for sparse multivariate polynomial interpolation, STOC; logarithms in a
//! group of order `2^m` as in Pohlig, Hellman 1978, IEEE Transactions on Information Theory 24.

use crate::modp::{Modulus, is_prime};
use crate::residue_polynomial::{Residues, common_divisor, divide, make_monic, product, remainder_by_monic, trim};

/// Primes `c 2^m + 1` below this power of two are used.
const PRIME_BITS: u32 = 61;
/// Minimum number of bits left to c: among that many odd numbers there are several primes.
const ODD_BITS: u32 = 7;
/// A logarithm is found in windows of so many bits.
const WINDOW: u32 = 4;
/// The number of failed attempts after which a polynomial is held to have no further factors.
const ATTEMPTS: usize = 40;

/// Numbers that look random, the same in each run.
pub(super) struct Random(pub(super) u64);

impl Random {
    /// Returns a residue other than 0.
    pub(super) fn residue(&mut self, modulus: &Modulus) -> u64 {
        loop {
            let residue = modulus.enter(self.next());
            if residue != 0 {
                return residue;
            }
        }
    }

    /// Xorshift of Marsaglia.
    pub(super) fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}

/// A prime field with an element of order `2^bits`.
pub(super) struct SmoothField {
    pub(super) modulus: Modulus,
    bits: u32,
    pub(super) generator: u64,
}

impl SmoothField {
    /// Returns the field of the largest prime with such an element; `None` for more bits than there is room for.
    pub(super) fn new(bits: u32, random: &mut Random) -> Option<Self> {
        let bits = bits.max(WINDOW).next_multiple_of(WINDOW);
        let room = PRIME_BITS.checked_sub(bits).filter(|&room| room >= ODD_BITS)?;
        let prime = (1..1_u64 << room).rev().map(|c| c << bits | 1).find(|&p| is_prime(p))?;
        let modulus = Modulus::new(prime);
        loop {
            // Of the elements of the group half generate it.
            let generator = modulus.pow(random.residue(&modulus), (prime - 1) >> bits);
            if modulus.pow(generator, 1 << (bits - 1)) != modulus.enter(1) {
                return Some(Self { modulus, bits, generator });
            }
        }
    }

    /// Returns the order of the generator.
    pub(super) const fn order(&self) -> u64 {
        1 << self.bits
    }

    /// Returns the exponents below `2^bits` of the generator that give these elements; `None` if one is not in its group.
    pub(super) fn logarithms(&self, elements: &[u64]) -> Option<Vec<u64>> {
        let m = &self.modulus;
        let windows = self.bits / WINDOW;
        // The powers of an element of order 2^WINDOW, and for each window the inverse of what it stands for.
        let step = m.pow(self.generator, 1 << (self.bits - WINDOW));
        let mut small = vec![m.enter(1)];
        for k in 1..1 << WINDOW {
            small.push(m.mul(small[k - 1], step));
        }
        let mut inverse = m.inverse(self.generator);
        let mut inverses = Vec::new();
        for _ in 0..windows {
            inverses.push(inverse);
            for _ in 0..WINDOW {
                inverse = m.mul(inverse, inverse);
            }
        }
        let logarithm = |&element: &u64| {
            let (mut rest, mut exponent) = (element, 0);
            for (k, &inverse) in (0..windows).zip(&inverses) {
                let mut top = rest;
                for _ in 0..self.bits - WINDOW * (k + 1) {
                    top = m.mul(top, top);
                }
                let digit = small.iter().position(|&power| power == top)? as u64;
                rest = m.mul(rest, m.pow(inverse, digit));
                exponent |= digit << (WINDOW * k);
            }
            (rest == m.enter(1)).then_some(exponent)
        };
        elements.iter().map(logarithm).collect()
    }
}

/// The shortest linear recurrence of the values so far.
///
/// # Source
/// Massey 1969, Shift-register synthesis and BCH decoding, IEEE Transactions on Information Theory 15.
pub(super) struct Recurrence {
    values: Vec<u64>,
    /// `c_0 = 1, c_1, ...` with `sum_i c_i v_(n-i) = 0`
    connection: Residues,
    length: usize,
    /// The connection before the length last changed, the discrepancy it had, and how many values ago that was.
    before: Residues,
    discrepancy: u64,
    distance: usize,
}

impl Recurrence {
    pub(super) fn new(modulus: &Modulus) -> Self {
        let one = modulus.enter(1);
        Self { values: Vec::new(), connection: vec![one], length: 0, before: vec![one], discrepancy: one, distance: 1 }
    }

    /// Adds a value.
    pub(super) fn push(&mut self, value: u64, modulus: &Modulus) {
        self.values.push(value);
        let terms = self.connection.iter().zip(self.values.iter().rev());
        let discrepancy = terms.fold(0, |sum, (&c, &v)| modulus.add(sum, modulus.mul(c, v)));
        if discrepancy == 0 {
            self.distance += 1;
            return;
        }
        let factor = modulus.mul(discrepancy, modulus.inverse(self.discrepancy));
        let old = self.connection.clone();
        self.connection.resize(old.len().max(self.before.len() + self.distance), 0);
        for (c, &b) in self.connection[self.distance..].iter_mut().zip(&self.before) {
            *c = modulus.sub(*c, modulus.mul(factor, b));
        }
        if 2 * self.length < self.values.len() {
            self.length = self.values.len() - self.length;
            (self.before, self.discrepancy, self.distance) = (old, discrepancy, 1);
        } else {
            self.distance += 1;
        }
    }

    /// Returns whether a value came out as foreseen after as many as the recurrence needs.
    pub(super) fn is_confirmed(&self) -> bool {
        self.values.len() > 2 * self.length
    }

    /// Returns the number of terms of the sum.
    pub(super) fn terms(&self) -> usize {
        self.length
    }

    pub(super) fn values(&self) -> &[u64] {
        &self.values
    }

    /// Returns the polynomial, monic, whose roots are those of the sum; `None` if 0 is one.
    pub(super) fn characteristic(&self) -> Option<Residues> {
        let mut characteristic = self.connection.clone();
        characteristic.resize(self.length + 1, 0);
        characteristic.reverse();
        (characteristic[0] != 0).then_some(characteristic)
    }
}

/// Returns all roots of a monic polynomial of positive degree; `None` if some are no residues. A multiple root may come
/// out several times: [`coefficients`] refuses that.
///
/// # Source
/// Cantor, Zassenhaus 1981, A new algorithm for factoring polynomials over finite fields, Mathematics of Computation 36.
pub(super) fn roots(polynomial: Residues, modulus: &Modulus, random: &mut Random) -> Option<Vec<u64>> {
    let (mut found, mut left) = (Vec::new(), vec![polynomial]);
    while let Some(factor) = left.pop() {
        if factor.len() == 2 {
            found.push(modulus.sub(0, factor[0]));
            continue;
        }
        let mut split = None;
        for _ in 0..ATTEMPTS {
            let mut power = half_power(&factor, random.residue(modulus), modulus);
            match power.first_mut() {
                Some(c) => *c = modulus.sub(*c, modulus.enter(1)),
                None => continue,
            }
            trim(&mut power);
            let mut part = common_divisor(factor.clone(), power, modulus);
            if part.len() > 1 && part.len() < factor.len() {
                make_monic(&mut part, modulus);
                split = Some(part);
                break;
            }
        }
        let part = split?;
        left.push(divide(&factor, &part, modulus).0);
        left.push(part);
    }
    Some(found)
}

/// `(z + shift)^((p - 1)/2)` modulo a monic polynomial of degree 2 or more.
fn half_power(polynomial: &[u64], shift: u64, modulus: &Modulus) -> Residues {
    let one = modulus.enter(1);
    let exponent = (modulus.prime() - 1) / 2;
    let mut power = vec![shift, one];
    for bit in (0..exponent.ilog2()).rev() {
        power = product(&power, &power, modulus);
        if exponent >> bit & 1 == 1 {
            power = product(&power, &[shift, one], modulus);
        }
        remainder_by_monic(&mut power, polynomial, modulus);
        if power.is_empty() {
            break;
        }
    }
    power
}

/// Returns the coefficients c of `v_j = sum_k c_k r_k^j`, from the first values; `None` if two roots are equal.
pub(super) fn coefficients(roots: &[u64], values: &[u64], modulus: &Modulus) -> Option<Vec<u64>> {
    let one = modulus.enter(1);
    let mut vanishing = vec![one];
    for &root in roots {
        vanishing.push(one);
        // Times z - root, from the second highest coefficient down.
        for i in (0..vanishing.len() - 1).rev() {
            let below = if i > 0 { vanishing[i - 1] } else { 0 };
            vanishing[i] = modulus.sub(below, modulus.mul(root, vanishing[i]));
        }
    }
    let (mut numerators, mut denominators) = (Vec::new(), Vec::new());
    for &root in roots {
        // The coefficients of the quotient by z - root, from the highest one down.
        let (mut quotient, mut at_root, mut sum) = (0, 0, 0);
        for (&c, &v) in vanishing[1..].iter().rev().zip(values[..roots.len()].iter().rev()) {
            quotient = modulus.add(modulus.mul(quotient, root), c);
            sum = modulus.add(sum, modulus.mul(quotient, v));
            at_root = modulus.add(modulus.mul(at_root, root), quotient);
        }
        if at_root == 0 {
            return None;
        }
        numerators.push(sum);
        denominators.push(at_root);
    }
    invert_all(&mut denominators, modulus);
    Some(numerators.iter().zip(&denominators).map(|(&n, &d)| modulus.mul(n, d)).collect())
}

/// Inverts residues, none zero, by one inversion (Montgomery's trick).
pub(super) fn invert_all(residues: &mut [u64], modulus: &Modulus) {
    let mut product = modulus.enter(1);
    let mut before = Vec::with_capacity(residues.len());
    for &r in residues.iter() {
        before.push(product);
        product = modulus.mul(product, r);
    }
    let mut inverse = modulus.inverse(product);
    for (r, before) in residues.iter_mut().zip(before).rev() {
        let own = *r;
        *r = modulus.mul(inverse, before);
        inverse = modulus.mul(inverse, own);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_powers_are_taken_apart() {
        let mut random = Random(12345);
        let field = SmoothField::new(33, &mut random).unwrap();
        let m = &field.modulus;
        for count in 1..12_u64 {
            let exponents: Vec<u64> =
                (0..count).map(|k| (k * k * 7_919 + 31 * k) << (2 * k) & ((1 << 33) - 1)).collect();
            let powers: Vec<u64> = exponents.iter().map(|&e| m.pow(field.generator, e)).collect();
            let weights: Vec<u64> = (0..count).map(|k| m.enter(3 + k)).collect();
            let mut recurrence = Recurrence::new(m);
            let mut j = 0;
            while !recurrence.is_confirmed() {
                let term = |(&r, &c): (&u64, &u64)| m.mul(c, m.pow(r, j));
                let value = powers.iter().zip(&weights).map(term).fold(0, |a, b| m.add(a, b));
                recurrence.push(value, m);
                j += 1;
            }
            assert_eq!((recurrence.terms() as u64, j), (count, 2 * count + 1));
            let found = roots(recurrence.characteristic().unwrap(), m, &mut random).unwrap();
            let logarithms = field.logarithms(&found).unwrap();
            let weights_found = coefficients(&found, recurrence.values(), m).unwrap();
            let mut pairs: Vec<(u64, u64)> = logarithms.into_iter().zip(weights_found).collect();
            let mut expected: Vec<(u64, u64)> = exponents.into_iter().zip(weights).collect();
            pairs.sort_unstable();
            expected.sort_unstable();
            assert_eq!(pairs, expected);
        }
    }

    #[test]
    fn what_is_no_sum_of_powers_is_refused() {
        let mut random = Random(99);
        let field = SmoothField::new(8, &mut random).unwrap();
        let m = &field.modulus;
        // z^2 - n has no root for half of the n.
        let squares = (2..40).filter(|&n| roots(vec![m.sub(0, m.enter(n)), 0, m.enter(1)], m, &mut random).is_some());
        let euler = |n: u64| m.pow(m.enter(n), (m.prime() - 1) / 2) == m.enter(1);
        assert!(squares.eq((2..40).filter(|&n| euler(n))));
        assert_eq!(field.logarithms(&[random.residue(m)]), None);
        assert_eq!(coefficients(&[5, 5], &[1, 2], m), None);
        assert!(SmoothField::new(60, &mut random).is_none());
    }
}
