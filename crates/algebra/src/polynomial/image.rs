//! Greatest common divisors modulo a prime: evaluation in all variables but one, and interpolation.
//!
//! # Source
//! Brown 1971, On Euclid's algorithm and the computation of polynomial greatest common divisors, Journal of the ACM 18(4).

use super::Polynomial;
use crate::int::Int;
use crate::modp::Modulus;
use crate::residue_polynomial::{Residues, common_divisor, divide, make_monic, product, trim, value};
use crate::sort;
use std::cmp::{Ordering, Reverse};

/// The packing of the exponents of the occurring variables into one integer, each field as wide as needed.
pub(super) struct Layout {
    /// The variables, that of the highest degree first: the last algorithm in line, Euclid's, is for that one.
    variables: Vec<usize>,
    /// The place of each field.
    shifts: Vec<u32>,
}

impl Layout {
    /// Returns a layout for two polynomials and their divisors; `None` if there is no room.
    pub(super) fn new(a: &Polynomial<Int>, b: &Polynomial<Int>) -> Option<Self> {
        let (a_degrees, b_degrees) = (a.degrees(), b.degrees());
        let of = |degrees: &[u32], variable: usize| degrees.get(variable).copied().unwrap_or(0);
        let degree = |variable: usize| of(&a_degrees, variable).max(of(&b_degrees, variable));
        let mut variables: Vec<usize> = (0..a.variables().max(b.variables())).filter(|&v| degree(v) > 0).collect();
        sort::by_key(&mut variables, |&variable| Reverse(degree(variable)));
        let mut used = 0;
        let mut shifts = Vec::new();
        for &variable in variables.iter().rev() {
            shifts.insert(0, used);
            used += u32::BITS - degree(variable).leading_zeros();
        }
        (used <= u128::BITS).then_some(Self { variables, shifts })
    }

    fn monomial(&self, polynomial: &Polynomial<Int>, term: usize) -> u128 {
        let field = |(&variable, &shift): (&usize, &u32)| u128::from(polynomial.exponent(term, variable)) << shift;
        self.variables.iter().zip(&self.shifts).map(field).sum()
    }

    /// Returns the coefficient of the highest monomial in this order.
    pub(super) fn leading_coefficient<'a>(&self, polynomial: &'a Polynomial<Int>) -> &'a Int {
        let leading = (0..polynomial.len()).max_by_key(|&term| self.monomial(polynomial, term));
        &polynomial.coefficients()[leading.expect("the polynomial is not zero")]
    }

    /// Returns the exponent of the variable at this place of the order.
    fn exponent(&self, monomial: u128, place: usize) -> usize {
        let above = place.checked_sub(1).map_or(u128::BITS, |before| self.shifts[before]);
        let field = (monomial >> self.shifts[place]) & (u128::MAX >> (u128::BITS - (above - self.shifts[place])));
        usize::try_from(field).expect("exponents fit")
    }

    /// Returns the sum of terms.
    pub(super) fn polynomial(&self, terms: impl Iterator<Item = (u128, Int)>) -> Polynomial<Int> {
        let unpacked = |(monomial, c): (u128, Int)| {
            let mut exponents = vec![0; self.variables.iter().max().map_or(0, |last| last + 1)];
            for (place, &variable) in self.variables.iter().enumerate() {
                exponents[variable] = u32::try_from(self.exponent(monomial, place)).expect("exponents fit a u32");
            }
            (exponents, c)
        };
        Polynomial::from_terms(terms.map(unpacked))
    }
}

/// A polynomial modulo a prime: monomials of a layout, decreasing, and residues in Montgomery form.
#[derive(Clone, Debug)]
pub(super) struct Image {
    modulus: Modulus,
    terms: Vec<(u128, u64)>,
}

impl Image {
    /// Returns the image of a polynomial.
    pub(super) fn new(polynomial: &Polynomial<Int>, layout: &Layout, modulus: Modulus) -> Self {
        let term = |(i, c): (usize, &Int)| (layout.monomial(polynomial, i), c.residue(&modulus));
        let mut terms: Vec<(u128, u64)> = polynomial.coefficients().iter().enumerate().map(term).collect();
        terms.retain(|term| term.1 != 0);
        terms.sort_unstable_by_key(|term| Reverse(term.0));
        Self { modulus, terms }
    }

    pub(super) const fn modulus(&self) -> Modulus {
        self.modulus
    }

    pub(super) fn terms(&self) -> &[(u128, u64)] {
        &self.terms
    }

    /// Returns the highest monomial.
    pub(super) fn leading_monomial(&self) -> u128 {
        self.terms[0].0
    }

    pub(super) fn is_constant(&self) -> bool {
        self.leading_monomial() == 0
    }

    /// Returns the product with a residue other than 0.
    pub(super) fn scaled(&self, factor: u64) -> Self {
        let terms = self.terms.iter().map(|&(monomial, c)| (monomial, self.modulus.mul(c, factor))).collect();
        Self { modulus: self.modulus, terms }
    }

    /// Returns a monic common divisor, with overwhelming probability the greatest; that it divides remains to be proved.
    /// Neither polynomial is zero, and their leading coefficients must be those of the polynomials they are images of.
    pub(super) fn gcd(&self, other: &Self, layout: &Layout) -> Self {
        Images { layout, modulus: self.modulus }.gcd(&self.terms, &other.terms, layout.variables.len()).into_image(self)
    }
}

/// Terms of an image.
struct Terms(Vec<(u128, u64)>);

impl Terms {
    fn into_image(self, like: &Image) -> Image {
        Image { modulus: like.modulus, terms: self.0 }
    }
}

/// The arithmetic of images.
struct Images<'a> {
    layout: &'a Layout,
    modulus: Modulus,
}

/// Terms grouped by the monomial in the variables before the last one, each with a polynomial in that one.
type Groups = Vec<(u128, Residues)>;

impl Images<'_> {
    /// Returns the monic greatest common divisor of polynomials in the first `count` variables.
    fn gcd(&self, a: &[(u128, u64)], b: &[(u128, u64)], count: usize) -> Terms {
        let m = &self.modulus;
        let last = count - 1;
        let (mut a, mut b) = (self.group(a, last), self.group(b, last));
        if last == 0 {
            let gcd = self.univariate_gcd(a.swap_remove(0).1, b.swap_remove(0).1);
            return self.terms(&[(0, gcd)], last);
        }
        let (content_a, content_b) = (self.remove_content(&mut a), self.remove_content(&mut b));
        let content = self.univariate_gcd(content_a, content_b);
        let leading = self.univariate_gcd(a[0].1.clone(), b[0].1.clone());
        let degree = |groups: &Groups| groups.iter().map(|(_, c)| c.len()).max().unwrap_or(0);
        let enough = degree(&a).min(degree(&b)) + leading.len();
        let mut interpolant = Interpolant::empty(m);
        // Random abscissae, so that a value that changes nothing is no accident of small numbers; the same in each run.
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        while interpolant.points < enough {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let x = m.enter(state);
            if value(&a[0].1, x, m) == 0 || value(&b[0].1, x, m) == 0 {
                continue;
            }
            let image = self.gcd(&self.at(&a, x), &self.at(&b, x), last).0;
            let top = image[0].0;
            if top == 0 {
                return self.terms(&[(0, content)], last);
            }
            match interpolant.groups.first().map_or(Ordering::Less, |(known, _)| top.cmp(known)) {
                Ordering::Greater => continue,
                Ordering::Less => interpolant = Interpolant::empty(m),
                Ordering::Equal => {}
            }
            if self.extend(&mut interpolant, &image, value(&leading, x, m), x) {
                break;
            }
        }
        let mut gcd = interpolant.groups;
        self.remove_content(&mut gcd);
        for (_, c) in &mut gcd {
            *c = product(c, &content, m);
        }
        self.terms(&gcd, last)
    }

    /// Applies Newton's step: adds the value `factor image` at x, and returns whether it was predicted.
    fn extend(&self, interpolant: &mut Interpolant, image: &[(u128, u64)], factor: u64, x: u64) -> bool {
        let m = &self.modulus;
        let scale = m.inverse(value(&interpolant.vanishing, x, m));
        let mut merged = Vec::with_capacity(image.len());
        let mut known = std::mem::take(&mut interpolant.groups).into_iter().peekable();
        let mut new = image.iter().copied().peekable();
        let mut foreseen = interpolant.points > 0;
        loop {
            let top = match (known.peek(), new.peek()) {
                (None, None) => break,
                (Some(a), Some(b)) => a.0.max(b.0),
                (Some(a), None) => a.0,
                (None, Some(b)) => b.0,
            };
            let mut c = known.next_if(|(monomial, _)| *monomial == top).map_or_else(Vec::new, |(_, c)| c);
            let image = new.next_if(|(monomial, _)| *monomial == top).map_or(0, |(_, image)| m.mul(image, factor));
            let step = m.mul(m.sub(image, value(&c, x, m)), scale);
            if step != 0 {
                foreseen = false;
                c.resize(interpolant.vanishing.len(), 0);
                for (c, v) in c.iter_mut().zip(&interpolant.vanishing) {
                    *c = m.add(*c, m.mul(step, *v));
                }
                trim(&mut c);
            }
            // A coefficient may vanish on the way; it is not one of the leading monomial, whose image never does.
            if !c.is_empty() {
                merged.push((top, c));
            }
        }
        interpolant.groups = merged;
        interpolant.vanishing = product(&interpolant.vanishing, &[m.sub(0, x), m.enter(1)], m);
        interpolant.points += 1;
        foreseen
    }

    fn group(&self, terms: &[(u128, u64)], last: usize) -> Groups {
        let mut groups = Groups::new();
        for &(monomial, c) in terms {
            let exponent = self.layout.exponent(monomial, last);
            let rest = monomial - ((exponent as u128) << self.layout.shifts[last]);
            // The first term of a group has the highest exponent.
            match groups.last_mut() {
                Some((known, coefficients)) if *known == rest => coefficients[exponent] = c,
                _ => {
                    let mut coefficients = vec![0; exponent + 1];
                    coefficients[exponent] = c;
                    groups.push((rest, coefficients));
                }
            }
        }
        groups
    }

    /// Returns the terms of the monic multiple.
    fn terms(&self, groups: &[(u128, Residues)], last: usize) -> Terms {
        let leading = groups.first().and_then(|(_, c)| c.last()).copied().unwrap_or(0);
        let inverse = self.modulus.inverse(leading);
        let mut terms = Vec::new();
        for (rest, coefficients) in groups {
            for (exponent, &c) in coefficients.iter().enumerate().rev().filter(|(_, c)| **c != 0) {
                let monomial = rest + ((exponent as u128) << self.layout.shifts[last]);
                terms.push((monomial, self.modulus.mul(c, inverse)));
            }
        }
        Terms(terms)
    }

    /// Divides by the common divisor of all polynomials in the last variable, and returns it.
    fn remove_content(&self, groups: &mut Groups) -> Residues {
        let mut content = Residues::new();
        for (_, c) in groups.iter() {
            content = self.univariate_gcd(content, c.clone());
            if content.len() == 1 {
                return content;
            }
        }
        for (_, c) in groups.iter_mut() {
            *c = divide(c, &content, &self.modulus).0;
        }
        content
    }

    /// Returns the terms for a value of the last variable.
    fn at(&self, groups: &Groups, x: u64) -> Vec<(u128, u64)> {
        let terms = groups.iter().map(|(monomial, c)| (*monomial, value(c, x, &self.modulus)));
        terms.filter(|term| term.1 != 0).collect()
    }

    /// Returns the monic greatest common divisor; zero, without coefficients, only of two zeros.
    fn univariate_gcd(&self, a: Residues, b: Residues) -> Residues {
        let mut gcd = common_divisor(a, b, &self.modulus);
        make_monic(&mut gcd, &self.modulus);
        gcd
    }
}

/// The polynomial in the last variable through the values so far, for each monomial in the others.
struct Interpolant {
    groups: Groups,
    /// The product of `x - x_i` over the abscissae.
    vanishing: Residues,
    points: usize,
}

impl Interpolant {
    fn empty(modulus: &Modulus) -> Self {
        Self { groups: Groups::new(), vanishing: vec![modulus.enter(1)], points: 0 }
    }
}
