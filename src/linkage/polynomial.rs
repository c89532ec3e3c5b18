//! The exact closure polynomial of a group, in the tangent of half the angle of its hidden class.
//!
//! With `x = (1 + i t)/(1 - i t)` the rows of a set and of its complement are conjugate. Written with the real and
//! imaginary parts p and q of `v_S` up to a common factor, `v_S = p + i q` and `v_(complement) = p - i q`, half of the rows
//! are a real matrix of polynomials in t, rational for rational data. Its determinant vanishes where that of the pencil
//! does, apart from t = i and t = -i, which stand for x infinite and zero and are divided out.

use super::isotropic::Isotropic;
use super::pencil::Pencil;
use crate::algebra::modular::{Terms, determinant};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::linkage::Gaussian;
use rug::{Integer, Rational, ops::Pow};

/// The closure polynomial and how it was found.
#[derive(Clone, Debug)]
pub struct ClosurePolynomial {
    /// Primitive, without the factors `1 + t^2`.
    pub polynomial: Univariate<Integer>,
    /// Whether the half turn t = infinity is no root.
    pub is_finite: bool,
    /// Rows of the matrix.
    pub size: usize,
}

/// A polynomial in t with complex coefficients.
type Entry = Vec<Gaussian>;

fn gaussian(re: i32, im: i32) -> Gaussian {
    Gaussian { re: Rational::from(re), im: Rational::from(im) }
}

/// `a p`, coefficient by coefficient, added to `sum`.
fn add_multiple(sum: &mut Entry, a: &Gaussian, p: &[Gaussian]) {
    if sum.len() < p.len() {
        sum.resize(p.len(), gaussian(0, 0));
    }
    for (x, y) in sum.iter_mut().zip(p) {
        *x = x.add(&a.mul(y));
    }
}

/// The closure polynomial of a pencil with rational data; `None` where its determinant vanishes or takes too much memory.
#[must_use]
pub fn closure_polynomial(pencil: &Pencil<Gaussian>) -> Option<ClosurePolynomial> {
    let all = (1_u32 << pencil.classes.len()) - 1;
    // One of every two complementary sets: the one without the last class.
    let last = 1_u32 << (pencil.classes.len() - 1);
    let kept: Vec<usize> = (0..pencil.sets.len()).filter(|k| pencil.sets[*k] & last == 0).collect();
    if 2 * kept.len() != pencil.sets.len() {
        return None;
    }
    let column = |k: usize| {
        let set = pencil.sets[k];
        let (own, sign) = if set & last == 0 { (set, 1) } else { (all ^ set, -1) };
        let place = pencil.sets.binary_search(&own).ok().and_then(|at| kept.binary_search(&at).ok())?;
        Some((place, sign))
    };
    let (plus, minus) = ([gaussian(1, 0), gaussian(0, 1)], [gaussian(1, 0), gaussian(0, -1)]);
    let size = pencil.sets.len();
    let mut rows: Vec<Vec<Vec<Rational>>> = Vec::with_capacity(size);
    let mut degree = 0;
    for k in &kept {
        let row = &pencil.rows[*k];
        let [_, with_x, with_inverse] = &row.own;
        // What makes polynomials of the row: 1 - i t for x, 1 + i t for its inverse.
        let mut factor: Entry = vec![gaussian(1, 0)];
        for (part, linear) in [(with_x, &minus), (with_inverse, &plus)] {
            if !part.is_zero() {
                factor = product(&factor, linear);
            }
        }
        let mut own = Entry::new();
        add_multiple(&mut own, &row.own[0], &factor);
        let over = |numerator: &[Gaussian], denominator: &[Gaussian]| {
            // factor * numerator / denominator, where the denominator is a factor of it.
            if factor.len() == 2 {
                numerator.to_vec()
            } else {
                product(numerator, &other_of(denominator, &plus, &minus))
            }
        };
        if !with_x.is_zero() {
            add_multiple(&mut own, with_x, &over(&plus, &minus));
        }
        if !with_inverse.is_zero() {
            add_multiple(&mut own, with_inverse, &over(&minus, &plus));
        }
        let mut entries: Vec<(usize, Entry)> = vec![(*k, own)];
        for (other, coefficient) in &row.others {
            let mut entry = Entry::new();
            add_multiple(&mut entry, coefficient, &factor);
            entries.push((*other, entry));
        }
        degree += 2 * (factor.len() - 1);
        let mut pair = [vec![Vec::new(); size], vec![Vec::new(); size]];
        for (other, entry) in entries {
            let (place, sign) = column(other)?;
            let half = kept.len();
            // c (p + s i q) = (re p - s im q) + i (im p + s re q)
            let parts = |f: &dyn Fn(&Gaussian) -> Rational| entry.iter().map(f).collect::<Vec<Rational>>();
            let sign = Rational::from(sign);
            add_real(&mut pair[0][place], &parts(&|c| c.re.clone()));
            add_real(&mut pair[0][half + place], &parts(&|c| Rational::from(-&c.im) * &sign));
            add_real(&mut pair[1][place], &parts(&|c| c.im.clone()));
            add_real(&mut pair[1][half + place], &parts(&|c| Rational::from(&c.re * &sign)));
        }
        rows.extend(pair);
    }
    let matrix: Vec<Vec<Terms>> = rows.iter().map(|row| integers(row)).collect();
    let terms = determinant(&matrix, 1)?;
    let mut coefficients = Vec::new();
    for (exponents, c) in terms.iter(1) {
        let power = exponents[0] as usize;
        if coefficients.len() <= power {
            coefficients.resize(power + 1, Integer::new());
        }
        coefficients[power] = c.clone();
    }
    let mut polynomial = Univariate::new(coefficients).primitive_part();
    let is_finite = polynomial.degree()? == degree;
    let circle = Univariate::new(vec![Integer::from(1), Integer::new(), Integer::from(1)]);
    while let Some(quotient) = polynomial.quotient(&circle).filter(|quotient| quotient.degree().is_some()) {
        polynomial = quotient;
    }
    Some(ClosurePolynomial { polynomial, is_finite, size })
}

fn product(a: &[Gaussian], b: &[Gaussian]) -> Entry {
    let mut all = vec![gaussian(0, 0); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            all[i + j] = all[i + j].add(&x.mul(y));
        }
    }
    all
}

/// The other one of the two linear factors.
fn other_of(one: &[Gaussian], plus: &[Gaussian], minus: &[Gaussian]) -> Entry {
    if one == plus { minus.to_vec() } else { plus.to_vec() }
}

fn add_real(sum: &mut Vec<Rational>, by: &[Rational]) {
    if sum.len() < by.len() {
        sum.resize(by.len(), Rational::new());
    }
    for (x, y) in sum.iter_mut().zip(by) {
        *x += y;
    }
}

/// A row times the least common denominator of its numbers.
fn integers(row: &[Vec<Rational>]) -> Vec<Terms> {
    let common = row.iter().flatten().fold(Integer::from(1), |common, q| common.lcm(q.denom()));
    let terms = |entry: &Vec<Rational>| {
        let mut terms = Terms::default();
        for (power, q) in (0_u32..).zip(entry) {
            if *q != 0 {
                terms.exponents.push(power);
                terms.coefficients.push(Rational::from(q * &common).numer().clone());
            }
        }
        terms
    };
    row.iter().map(terms).collect()
}

/// The rotations by which the hidden class may be turned so that the half turn is no root: that of the half-angle tangent k.
#[must_use]
pub fn turned(k: u32) -> Isotropic<Gaussian> {
    let t = Rational::from(k);
    let square = Rational::from((&t).pow(2));
    let length = Rational::from(&square + 1);
    Isotropic::of(&Gaussian { re: (1 - square) / &length, im: t * 2 / length })
}
