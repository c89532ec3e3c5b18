//! The algorithms behind the verbs, each called from one place.

use looproot::algebra::determinant::{bareiss, modular};
use looproot::algebra::int::Int;
use looproot::algebra::number::nearest_f64;
use looproot::algebra::polynomial::Polynomial;
use looproot::algebra::ring::{Domain, Ring};
use looproot::algebra::sturm::{Place, SturmChain};
use looproot::algebra::text::Fraction;
use looproot::algebra::univariate::Univariate;
use rug::Rational;
use std::cmp::Ordering;

type Poly = Polynomial<Int>;

/// The power of a number.
pub fn power(base: &Int, exponent: u32) -> Int {
    Int::from(rug::ops::Pow::pow(base.to_integer(), exponent))
}

/// The polynomial over a product of positive numbers, in lowest terms.
pub fn over(numerator: Poly, denominators: &[Int]) -> Fraction {
    let denominator = denominators.iter().fold(Int::one(), |product, d| product.mul(d));
    Fraction { numerator, denominator }.reduced()
}

/// The resultant, with the sign of the Sylvester determinant.
pub fn resultant(f: &Poly, g: &Poly, variable: usize) -> Poly {
    let (f, g) = (f.coefficients_in(variable), g.coefficients_in(variable));
    if f.is_empty() || g.is_empty() {
        return Poly::zero();
    }
    let (m, n) = (f.len() - 1, g.len() - 1);
    let row = |coefficients: &[Poly], shift: usize| {
        let mut row = vec![Poly::zero(); m + n];
        for (place, c) in row[shift..].iter_mut().zip(coefficients.iter().rev()) {
            *place = c.clone();
        }
        row
    };
    let rows: Vec<Vec<Poly>> = (0..n).map(|shift| row(&f, shift)).chain((0..m).map(|shift| row(&g, shift))).collect();
    bareiss(&rows)
}

/// The determinant of a square matrix: by its images modulo primes where there is one variable, else without fractions.
pub fn determinant(rows: &[Vec<Poly>]) -> Poly {
    let entries = || rows.iter().flatten();
    let variables = entries().map(Poly::variables).max().unwrap_or(0);
    let mut used = (0..variables).filter(|&variable| entries().any(|entry| entry.degree(variable) > 0));
    let (variable, None) = (used.next().unwrap_or(0), used.next()) else { return bareiss(rows) };
    let degree = entries().map(|entry| entry.degree(variable)).max().unwrap_or(0) as usize;
    let mut matrices = vec![vec![vec![Rational::new(); rows.len()]; rows.len()]; degree + 1];
    for (i, row) in rows.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            for (term, c) in entry.coefficients().iter().enumerate() {
                matrices[entry.exponent(term, variable) as usize][i][j] = Rational::from(c.to_integer());
            }
        }
    }
    let determinant = modular(&matrices).map(|c| Some(Int::from(c.numer().clone())));
    determinant.map_or_else(Poly::zero, |determinant| Poly::from_univariate(variable, &determinant))
}

/// The polynomial without the common factor of its coefficients, the first of them positive.
pub fn primitive(p: &Poly) -> Poly {
    let content = p.coefficients().iter().fold(Int::zero(), |gcd, c| gcd.gcd(c));
    let Some(leading) = p.coefficients().first() else { return Poly::zero() };
    let content = if leading.sign() == Ordering::Less { content.neg() } else { content };
    p.map(|c| c.checked_div_exact(&content)).unwrap_or_else(Poly::zero)
}

/// The greatest common divisor over the integers, by primitive remainders.
pub fn gcd(f: &Poly, g: &Poly) -> Poly {
    if f.is_zero() || g.is_zero() {
        return positive(&f.add(g));
    }
    let degrees = |p: &Poly| p.degrees().iter().rposition(|&d| d > 0);
    let Some(variable) = degrees(f).max(degrees(g)) else {
        let number = |p: &Poly| p.to_constant().unwrap_or_else(Int::zero);
        return Poly::constant(number(f).gcd(&number(g)));
    };
    let content = |p: &Poly| p.coefficients_in(variable).iter().fold(Poly::zero(), |all, c| gcd(&all, c));
    let (f_content, g_content) = (content(f), content(g));
    let (mut a, mut b) = (f.div_exact(&f_content), g.div_exact(&g_content));
    if a.degree(variable) < b.degree(variable) {
        (a, b) = (b, a);
    }
    while !b.is_zero() {
        let remainder = pseudo_remainder(&a, &b, variable);
        a = b;
        b = if remainder.is_zero() { remainder } else { remainder.div_exact(&content(&remainder)) };
    }
    positive(&a.mul(&gcd(&f_content, &g_content)))
}

fn positive(p: &Poly) -> Poly {
    if p.coefficients().first().is_some_and(|c| c.sign() == Ordering::Less) { p.neg() } else { p.clone() }
}

fn pseudo_remainder(f: &Poly, g: &Poly, variable: usize) -> Poly {
    let degree = g.degree(variable);
    let leading = |p: &Poly| p.coefficients_in(variable).pop().unwrap_or_else(Poly::zero);
    let top = leading(g);
    let mut rest = f.clone();
    while !rest.is_zero() && rest.degree(variable) >= degree {
        let shift = Poly::variable(variable).pow(rest.degree(variable) - degree);
        rest = rest.mul(&top).sub(&g.mul(&leading(&rest)).mul(&shift));
        if degree == 0 {
            return Poly::zero();
        }
    }
    rest
}

/// The square-free primitive factors that are not numbers, coprime in pairs, by increasing multiplicity.
pub fn square_free(f: &Poly) -> Vec<(Poly, u32)> {
    let mut found: Vec<(Poly, u32)> = Vec::new();
    let mut rest = primitive(f);
    while let Some(variable) = rest.degrees().iter().rposition(|&d| d > 0) {
        let content = rest.coefficients_in(variable).iter().fold(Poly::zero(), |all, c| gcd(&all, c));
        let part = rest.div_exact(&content);
        rest = content;
        // Yun's algorithm on the part that is primitive in this variable.
        let slope = part.derivative(variable);
        let repeated = gcd(&part, &slope);
        let mut simple = part.div_exact(&repeated);
        let mut slope = slope.div_exact(&repeated).sub(&simple.derivative(variable));
        let mut multiplicity = 1;
        while simple.degree(variable) > 0 {
            let factor = gcd(&simple, &slope);
            simple = simple.div_exact(&factor);
            slope = slope.div_exact(&factor).sub(&simple.derivative(variable));
            if factor.degree(variable) > 0 {
                match found.iter_mut().find(|(_, k)| *k == multiplicity) {
                    Some((known, _)) => *known = known.mul(&factor),
                    None => found.push((primitive(&factor), multiplicity)),
                }
            }
            multiplicity += 1;
        }
    }
    found.sort_by_key(|(_, k)| *k);
    found.into_iter().map(|(p, k)| (primitive(&p), k)).collect()
}

/// A real root of a polynomial, in an interval that holds no other.
#[derive(Clone, Debug)]
pub struct RealRoot {
    lower: Rational,
    upper: Rational,
    multiplicity: usize,
}

impl RealRoot {
    /// How often it is a root.
    pub const fn multiplicity(&self) -> usize {
        self.multiplicity
    }

    /// The root, where it was met exactly.
    pub fn exact(&self) -> Option<Rational> {
        (self.lower == self.upper).then(|| self.lower.clone())
    }

    /// The interval.
    pub fn bounds(&self) -> (Rational, Rational) {
        (self.lower.clone(), self.upper.clone())
    }

    /// The nearest f64, but for ties.
    pub fn to_f64(&self) -> f64 {
        nearest_f64(&((self.lower.clone() + &self.upper) / 2))
    }

    /// An interval of f64 around the root.
    pub fn enclosure(&self) -> (f64, f64) {
        let (lower, upper) = (nearest_f64(&self.lower), nearest_f64(&self.upper));
        let below = if Rational::from_f64(lower).is_some_and(|x| x > self.lower) { lower.next_down() } else { lower };
        let above = if Rational::from_f64(upper).is_some_and(|x| x < self.upper) { upper.next_up() } else { upper };
        (below, above)
    }
}

/// All real roots, increasing, in disjoint intervals narrower than f64 resolves.
pub fn real_roots(f: &Univariate<Rational>) -> Vec<RealRoot> {
    let mut roots = Vec::new();
    for (factor, multiplicity) in f.square_free_decomposition() {
        let chain = SturmChain::new(&factor);
        let leading = factor.coefficients().last().cloned().unwrap_or_default();
        // Cauchy's bound.
        let largest =
            factor.coefficients().iter().map(|c| Rational::from(c / &leading).abs()).max().unwrap_or_default();
        let bound = Rational::from(largest.ceil_ref()) + 1;
        let mut open = vec![(Rational::from(-&bound), bound)];
        while let Some((lower, upper)) = open.pop() {
            let middle: Rational = Rational::from(&lower + &upper) / 2;
            match chain.count_between(Place::At(&lower), Place::At(&upper)) {
                0 => {}
                1 => {
                    let (lower, upper) = narrowed(&factor, lower, upper);
                    roots.push(RealRoot { lower, upper, multiplicity });
                }
                _ => open.extend([(lower, middle.clone()), (middle, upper)]),
            }
        }
    }
    roots.sort_by(|a, b| a.lower.cmp(&b.lower));
    roots
}

/// Bisects the half-open interval of a simple root until it is narrow.
fn narrowed(f: &Univariate<Rational>, mut lower: Rational, mut upper: Rational) -> (Rational, Rational) {
    let sign = f.eval(&upper).cmp0();
    if sign == Ordering::Equal {
        return (upper.clone(), upper);
    }
    for _ in 0..2200 {
        let width = Rational::from(&upper - &lower);
        let size = lower.clone().abs().max(upper.clone().abs()) >> 70;
        if width <= size && lower.cmp0() == upper.cmp0() {
            break;
        }
        let middle = Rational::from(&lower + &upper) / 2;
        match f.eval(&middle).cmp0() {
            Ordering::Equal => return (middle.clone(), middle),
            s if s == sign => upper = middle,
            _ => lower = middle,
        }
    }
    (lower, upper)
}
