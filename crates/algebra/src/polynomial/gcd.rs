//! Greatest common divisors over the integers, from images modulo primes, proved by division.
//!
//! # Source
//! Brown 1971, On Euclid's algorithm and the computation of polynomial greatest common divisors, Journal of the ACM 18(4).

use super::Polynomial;
use super::image::{Image, Layout};
use crate::int::Int;
use crate::modp::primes;
use crate::ring::{Domain, Ring};
use rug::Integer;
use std::cmp::Ordering;

impl Polynomial<Int> {
    /// Returns the greatest common divisor, its leading coefficient positive; zero only of two zeros.
    ///
    /// Images modulo primes only propose it: division proves that it divides both, and its leading monomial that nothing
    /// larger does.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            let sum = self.add(other);
            return sum.primitive_part().scale(&sum.content());
        }
        if let Some(gcd) = self.divisor_on_line(other, false) {
            return gcd;
        }
        let content = self.content().gcd(&other.content());
        // In one variable the first image modulo a prime tells as much.
        let bounds = if self.shares_line(other) { None } else { self.divisor_degrees(other) };
        if bounds.as_ref().is_some_and(|bounds| bounds.iter().all(|bound| *bound == 0)) {
            return Self::constant(content);
        }
        let (a, b) = (self.monomial_content(), other.monomial_content());
        // The bounds hold for what is left of both as well, if they have no monomials.
        let bounds = bounds.filter(|_| a == Self::one() && b == Self::one());
        let rest = |polynomial: &Self, monomial: &Self| {
            if *monomial == Self::one() {
                polynomial.primitive_part()
            } else {
                polynomial.div_exact(monomial).primitive_part()
            }
        };
        let (own, others) = (rest(self, &a), rest(other, &b));
        let by_value = bounds.and_then(|bounds| own.divisor_by_value(&others, &bounds));
        let gcd = by_value.unwrap_or_else(|| own.gcd_of_primitives(&others));
        let terms = a
            .terms()
            .zip(b.terms())
            .map(|((a, _), (b, _))| (a.iter().zip(b).map(|(&a, b)| a.min(b)).collect(), content.clone()));
        gcd.mul(&Self::from_terms(terms))
    }

    /// Returns the variables that occur.
    fn support(&self) -> Vec<usize> {
        self.degrees().into_iter().enumerate().filter(|(_, degree)| *degree > 0).map(|(variable, _)| variable).collect()
    }

    /// Returns the gcd of two primitive polynomials with positive leading coefficients, not divisible by variables.
    fn gcd_of_primitives(&self, other: &Self) -> Self {
        if self.len() == 1 || other.len() == 1 {
            return Self::one();
        }
        if self == other {
            return self.clone();
        }
        let (own, others) = (self.support(), other.support());
        if let Some(&variable) = own.iter().find(|variable| !others.contains(variable)) {
            return self.gcd_with_content(variable, other);
        }
        if let Some(&variable) = others.iter().find(|variable| !own.contains(variable)) {
            return other.gcd_with_content(variable, self);
        }
        if let Some(gcd) = self.sparse_gcd(other, &own) {
            return gcd;
        }
        Layout::new(self, other)
            .map_or_else(|| self.euclidean_gcd(other, own[0]), |layout| self.modular_gcd(other, &layout))
    }

    /// Returns the gcd with a polynomial free of the variable: a common divisor divides all coefficients of its powers.
    fn gcd_with_content(&self, variable: usize, other: &Self) -> Self {
        let mut parts = self.coefficients_in(variable);
        parts.retain(|part| !part.is_zero());
        parts.sort_unstable_by_key(Self::len);
        parts.iter().fold(other.clone(), |gcd, part| if gcd.len() == 1 { gcd } else { gcd.gcd(part) })
    }

    /// From images modulo primes; both occur in the same variables.
    pub(super) fn modular_gcd(&self, other: &Self, layout: &Layout) -> Self {
        // The true leading coefficient of the divisor divides this one, by which all images are scaled. The leading
        // coefficients are those in the order of the layout.
        let (a, b) = (layout.leading_coefficient(self), layout.leading_coefficient(other));
        let leading = a.gcd(b).to_integer();
        let (a, b) = (a.to_integer(), b.to_integer());
        let mut lifted: Option<Lifted> = None;
        for modulus in primes() {
            let p = modulus.prime();
            if a.is_divisible(&Integer::from(p)) || b.is_divisible(&Integer::from(p)) {
                continue;
            }
            let image = Image::new(self, layout, modulus).gcd(&Image::new(other, layout, modulus), layout);
            if image.is_constant() {
                return Self::one();
            }
            let image = image.scaled(modulus.reduce(&leading));
            let known = lifted.as_ref().map_or(u128::MAX, Lifted::leading_monomial);
            let stable = match (image.leading_monomial().cmp(&known), &mut lifted) {
                // A larger leading monomial than that of another image comes from an unlucky prime.
                (Ordering::Greater, _) => continue,
                (Ordering::Equal, Some(lifted)) => lifted.extend(&image),
                _ => {
                    lifted = Some(Lifted::new(&image));
                    // One prime suffices for most divisors.
                    true
                }
            };
            let Some(lifted) = lifted.as_ref().filter(|_| stable) else { continue };
            let candidate = lifted.polynomial(layout).primitive_part();
            if [self, other].iter().all(|polynomial| polynomial.checked_div_exact(&candidate).is_some()) {
                return candidate;
            }
        }
        unreachable!("only finitely many primes are unlucky")
    }

    /// By Euclid's algorithm in one variable on primitive parts: without limits, and slow.
    pub(super) fn euclidean_gcd(&self, other: &Self, variable: usize) -> Self {
        let (a, b) = (self.content_in(variable), other.content_in(variable));
        let content = a.gcd(&b);
        let (mut a, mut b) = (self.div_exact(&a), other.div_exact(&b));
        if a.degree(variable) < b.degree(variable) {
            (a, b) = (b, a);
        }
        while !b.is_zero() {
            let remainder = a.pseudo_remainder(&b, variable);
            let primitive =
                if remainder.is_zero() { remainder } else { remainder.div_exact(&remainder.content_in(variable)) };
            (a, b) = (b, primitive);
        }
        let gcd = if a.degree(variable) == 0 { content } else { content.mul(&a) };
        gcd.primitive_part()
    }

    /// Returns a remainder of a multiple of this polynomial by a coefficient in the other variables.
    fn pseudo_remainder(&self, divisor: &Self, variable: usize) -> Self {
        let divisor = divisor.coefficients_in(variable);
        let mut rest = self.coefficients_in(variable);
        let Some((leading, lower)) = divisor.split_last() else { return self.clone() };
        while rest.len() >= divisor.len() {
            let Some(top) = rest.pop() else { break };
            let shift = rest.len() - lower.len();
            for (k, c) in rest.iter_mut().enumerate() {
                *c = c.mul(leading);
                if k >= shift {
                    *c = c.sub(&top.mul(&lower[k - shift]));
                }
            }
            while rest.last().is_some_and(Ring::is_zero) {
                rest.pop();
            }
        }
        Self::from_coefficients_in(variable, &rest)
    }
}

/// A polynomial known modulo a product of primes.
struct Lifted {
    /// Monomials of the layout, decreasing, and residues of least absolute value.
    terms: Vec<(u128, Integer)>,
    modulus: Integer,
}

impl Lifted {
    fn new(image: &Image) -> Self {
        let mut lifted = Self { terms: Vec::new(), modulus: Integer::from(1) };
        lifted.extend(image);
        lifted
    }

    /// Adds an image modulo a new prime (Chinese remainders), and returns whether it changed nothing.
    fn extend(&mut self, image: &Image) -> bool {
        let modulus = &image.modulus();
        let p = modulus.prime();
        let inverse = modulus.inverse(modulus.reduce(&self.modulus));
        let (mut stable, mut merged) = (true, Vec::with_capacity(self.terms.len()));
        let mut known = std::mem::take(&mut self.terms).into_iter().peekable();
        let mut new = image.terms().iter().copied().peekable();
        loop {
            let top = match (known.peek(), new.peek()) {
                (None, None) => break,
                (Some(a), Some(b)) => a.0.max(b.0),
                (Some(a), None) => a.0,
                (None, Some(b)) => b.0,
            };
            let mut c = known.next_if(|(monomial, _)| *monomial == top).map_or_else(Integer::new, |(_, c)| c);
            let residue = new.next_if(|(monomial, _)| *monomial == top).map_or(0, |(_, residue)| residue);
            let step = modulus.leave(modulus.mul(modulus.sub(residue, modulus.reduce(&c)), inverse));
            if step != 0 {
                stable = false;
                let step = if step > p / 2 { i128::from(step) - i128::from(p) } else { i128::from(step) };
                c += &self.modulus * Integer::from(step);
            }
            merged.push((top, c));
        }
        self.terms = merged;
        self.modulus *= p;
        stable
    }

    fn leading_monomial(&self) -> u128 {
        self.terms[0].0
    }

    fn polynomial(&self, layout: &Layout) -> Polynomial<Int> {
        layout.polynomial(self.terms.iter().map(|(monomial, c)| (*monomial, Int::from(c.clone()))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two algorithms that share nothing but the ring.
    #[test]
    fn modular_and_euclidean_divisors_agree() {
        let [x, y, z] = [0, 1, 2].map(Polynomial::<Int>::variable);
        let number = |n: i32| Polynomial::from_integer(n);
        let h = x.mul(&y).add(&z.pow(2)).sub(&number(3));
        let f = x.pow(2).add(&y.mul(&z)).add(&number(1));
        let g = x.sub(&z.pow(3)).mul(&number(7)).add(&y);
        for (a, b) in
            [(f.mul(&h), g.mul(&h)), (f.mul(&h).mul(&h), h.mul(&g)), (f.clone(), g.clone()), (h.pow(3), h.pow(2))]
        {
            let modular = a.gcd(&b);
            for variable in 0..3 {
                assert_eq!(a.euclidean_gcd(&b, variable), modular);
            }
        }
        assert_eq!(f.mul(&h).gcd(&g.mul(&h)), h);
    }

    /// Modulo the first prime p, the coprime polynomials x + p y and x have a common divisor, and p x + 1 loses its degree.
    #[test]
    fn unlucky_primes_are_found_out() {
        let p = primes().next().map(|modulus| Int::from(modulus.prime())).unwrap();
        let [x, y] = [0, 1].map(Polynomial::<Int>::variable);
        let one = Polynomial::one();
        let (f, g) = (x.add(&y.scale(&p)).add(&one), x.add(&one));
        assert_eq!(f.gcd(&g), one);
        let h = x.mul(&y).sub(&one);
        assert_eq!(f.mul(&h).gcd(&g.mul(&h)), h);
        let (f, g) = (x.scale(&p).add(&y), x.scale(&p).sub(&y));
        assert_eq!(f.mul(&h).gcd(&g.mul(&h)), h);
        assert_eq!(h.mul(&f).gcd(&h.pow(2).mul(&f)), h.mul(&f));
    }

    #[test]
    fn too_many_variables_for_the_layout() {
        let x = |variable| Polynomial::<Int>::variable(variable);
        let h = (0..50).fold(Polynomial::one(), |sum, variable| sum.add(&x(variable).pow(4)));
        let (f, g) = (h.mul(&x(0).add(&x(49))), h.mul(&x(1).sub(&x(48))));
        assert!(Layout::new(&f, &g).is_none());
        assert_eq!(f.gcd(&g), h);
    }
}
