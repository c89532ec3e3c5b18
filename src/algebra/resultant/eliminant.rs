//! A variable out of two polynomials in several: the choice of the route, and the way back.

use super::bezout::{self, Expansion};
use super::linear::{reduce, reduce_up_to};
use super::minors::parameters;
use super::subresultant;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;

/// The resultant of two polynomials with respect to a variable, with the sign of the Sylvester determinant.
///
/// `Res(f, c) = c^m` for c free of the variable, and 0 if either polynomial is zero.
///
/// # Example
/// ```
/// use looproot::algebra::{int::Int, polynomial::Polynomial, resultant::resultant, ring::Ring};
///
/// // The circle x^2 + y^2 = 25 and the line x + y = 7 meet where y = 3 or 4.
/// let (x, y) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
/// let circle = x.pow(2).add(&y.pow(2)).sub(&Ring::from_integer(25));
/// let line = x.add(&y).sub(&Ring::from_integer(7));
/// let (three, four) = (Ring::from_integer(3), Ring::from_integer(4));
/// assert_eq!(resultant(&circle, &line, 0), y.sub(&three).mul(&y.sub(&four)).scale(&Int::from(2)));
/// ```
#[must_use]
pub fn resultant(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize) -> Polynomial<Int> {
    let (m, n) = (f.degree(variable) as usize, g.degree(variable) as usize);
    let ((content_f, f), (content_g, g)) = (without_content(f), without_content(g));
    let factor = subresultant::power(&content_f, n).mul(&subresultant::power(&content_g, m));
    let resultant = eliminate(&f, &g, variable).resultant;
    if factor == Int::one() { resultant } else { resultant.scale(&factor) }
}

/// The greatest common divisor of the coefficients, and the polynomial without it.
fn without_content(f: &Polynomial<Int>) -> (Int, Polynomial<Int>) {
    let mut content = Int::zero();
    for c in f.coefficients() {
        content = content.gcd(c);
        if content == Int::one() {
            return (content, f.clone());
        }
    }
    let divided = f.map(|c| c.checked_div_exact(&content));
    divided.map_or_else(|| (Int::one(), f.clone()), |divided| (content, divided))
}

/// The result of eliminating a variable from two polynomials.
#[derive(Clone, Debug)]
pub struct Eliminant<R> {
    /// The resultant, with the sign of the Sylvester determinant: it vanishes where the two have a common root, or both
    /// lose their leading coefficients.
    pub resultant: Polynomial<R>,
    /// A polynomial in the eliminated variable that vanishes at the common root, mostly `s1 x + s0`, the first
    /// subresultant up to factors free of x: then `x = -s0/s1` wherever s1 does not vanish. Two polynomials in `x^k` have
    /// `s1 x^k + s0` here. Zero, where there is no such polynomial.
    pub lift: Univariate<Polynomial<R>>,
    f: Univariate<Polynomial<R>>,
    g: Univariate<Polynomial<R>>,
}

/// Eliminates a variable from two polynomials over any ring with exact division.
///
/// # Example
/// ```
/// use looproot::algebra::{polynomial::Polynomial, resultant::eliminate, ring::{Field, Ring}};
/// use rug::Rational;
///
/// // x^2 = y and x y = 8 meet at x = 2, y = 4.
/// let (x, y) = (Polynomial::<Rational>::variable(0), Polynomial::variable(1));
/// let eliminant = eliminate(&x.pow(2).sub(&y), &x.mul(&y).sub(&Ring::from_integer(8)), 0);
/// assert_eq!(eliminant.resultant, Polynomial::<Rational>::from_integer(64).sub(&y.pow(3)));
/// assert_eq!(eliminant.lift.coefficients(), [Ring::from_integer(-8), y]);
/// let exact = eliminant.common_divisor_at(|c| Some(c.clone()), &[Rational::new(), Rational::from(4)], 0.0);
/// assert_eq!(exact, Some(vec![Rational::from(-2), Rational::from(1)]));
/// let close = eliminant.common_divisor_at(f64::from_rational, &[0.0, 4.000_000_000_1], 1e-9).unwrap();
/// assert!((close[0] / close[1] + 2.0).abs() < 1e-9);
/// ```
#[must_use]
pub fn eliminate<D: Domain>(f: &Polynomial<D>, g: &Polynomial<D>, variable: usize) -> Eliminant<D> {
    let parts = |f: &Polynomial<D>| Univariate::new(f.coefficients_in(variable));
    let (f, g) = (parts(f), parts(g));
    let Expansion { resultant, linear } = without_gaps(&f, &g);
    Eliminant { resultant, lift: linear, f, g }
}

/// Polynomials in `x^k` have the k-th power of the resultant of those in x.
fn without_gaps<D: Domain>(f: &Univariate<Polynomial<D>>, g: &Univariate<Polynomial<D>>) -> Expansion<Polynomial<D>> {
    let present = |f: &Univariate<Polynomial<D>>| {
        let powers = f.coefficients().iter().enumerate().filter(|(_, c)| !c.is_zero());
        powers.fold(0, |gap, (k, _)| gcd(gap, k))
    };
    let gap = gcd(present(f), present(g));
    if gap <= 1 {
        return without_monomials(f, g);
    }
    let contracted =
        |f: &Univariate<Polynomial<D>>| Univariate::new(f.coefficients().iter().step_by(gap).cloned().collect());
    let Expansion { resultant, linear } = without_monomials(&contracted(f), &contracted(g));
    let mut spread = vec![Polynomial::zero(); gap * linear.coefficients().len()];
    for (k, c) in linear.coefficients().iter().enumerate() {
        spread[gap * k] = c.clone();
    }
    Expansion { resultant: subresultant::power(&resultant, gap), linear: Univariate::new(spread) }
}

/// Products of parameters that divide all coefficients would be carried along in high powers: they are multiplied to
/// the resultant at last.
fn without_monomials<D: Domain>(
    f: &Univariate<Polynomial<D>>,
    g: &Univariate<Polynomial<D>>,
) -> Expansion<Polynomial<D>> {
    let (exponents_f, exponents_g) = (common_exponents(f), common_exponents(g));
    if exponents_f.iter().chain(&exponents_g).all(|&e| e == 0) {
        return by_route(f, g);
    }
    let degree = |f: &Univariate<Polynomial<D>>| u32::try_from(f.degree().unwrap_or(0)).unwrap_or(u32::MAX);
    let expansion = by_route(&divided(f, &exponents_f), &divided(g, &exponents_g));
    let monomial = |exponents: Vec<u32>, power: u32| {
        let powers = exponents.into_iter().map(|e| e * power).collect();
        Polynomial::from_terms([(powers, D::one())])
    };
    // Where one of these vanishes so does a whole polynomial, and the lift must not say more than it knows.
    let once = |exponents: &[u32]| monomial(exponents.iter().map(|&e| e.min(1)).collect(), 1);
    let linear = expansion.linear.scale(&once(&exponents_f).mul(&once(&exponents_g)));
    let factor = monomial(exponents_f, degree(g)).mul(&monomial(exponents_g, degree(f)));
    Expansion { resultant: expansion.resultant.mul(&factor), linear }
}

/// The exponents of the monomial that divides all coefficients.
fn common_exponents<D: Domain>(f: &Univariate<Polynomial<D>>) -> Vec<u32> {
    let mut common: Option<Vec<u32>> = None;
    for (exponents, _) in f.coefficients().iter().flat_map(Polynomial::terms) {
        let common = common.get_or_insert_with(|| exponents.clone());
        common.truncate(exponents.len());
        for (e, &other) in common.iter_mut().zip(&exponents) {
            *e = other.min(*e);
        }
        if common.iter().all(|&e| e == 0) {
            break;
        }
    }
    common.unwrap_or_default()
}

/// The polynomial with a monomial divided out of its coefficients.
fn divided<D: Domain>(f: &Univariate<Polynomial<D>>, common: &[u32]) -> Univariate<Polynomial<D>> {
    let term = |(mut exponents, c): (Vec<u32>, &D)| {
        for (e, &by) in exponents.iter_mut().zip(common) {
            *e -= by;
        }
        (exponents, c.clone())
    };
    let coefficient = |c: &Polynomial<D>| Polynomial::from_terms(c.terms().map(term));
    Univariate::new(f.coefficients().iter().map(coefficient).collect())
}

const fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// How a resultant is found.
enum Route {
    /// Two quadratics whose first and last coefficients have more terms than their sums and differences.
    HalfAngles,
    /// Minors of the Bezout matrix.
    Minors,
    /// The chain of subresultants.
    Chain,
}

/// The one place where the route is chosen, by degrees, numbers of parameters and numbers of terms.
///
/// Minors never divide, and with many symbols their terms hardly cancel: there they are faster by orders of magnitude.
/// With one or two parameters all polynomials are dense, and pseudo-division wins where it is cheap: for degrees far
/// apart, and for high ones.
fn route<D: Domain>(f: &Univariate<Polynomial<D>>, g: &Univariate<Polynomial<D>>) -> Route {
    let (Some(m), Some(n)) = (f.degree(), g.degree()) else { return Route::Minors };
    if (m, n) == (2, 2) {
        let saves = |f: &Univariate<Polynomial<D>>| {
            let (a0, a2) = (&f.coefficients()[0], &f.coefficients()[2]);
            (a0.add(a2).len() + a0.sub(a2).len(), a0.len() + a2.len())
        };
        let ((few_f, many_f), (few_g, many_g)) = (saves(f), saves(g));
        let four_is_invertible = !D::from_integer(4).is_zero();
        return if few_f + few_g < many_f + many_g && four_is_invertible { Route::HalfAngles } else { Route::Minors };
    }
    let (high, low) = (m.max(n), m.min(n));
    if low <= 1 || high <= 3 {
        return Route::Minors;
    }
    let by_minors = match parameters(f.coefficients().iter().chain(g.coefficients())) {
        0 | 1 => high <= 5 && high - low <= 1,
        2 => high <= 6 && high - low <= 1,
        _ => high <= 8,
    };
    if by_minors { Route::Minors } else { Route::Chain }
}

fn by_route<D: Domain>(f: &Univariate<Polynomial<D>>, g: &Univariate<Polynomial<D>>) -> Expansion<Polynomial<D>> {
    match route(f, g) {
        Route::HalfAngles => of_half_angles(f, g),
        Route::Minors => bezout::expansion(f, g),
        Route::Chain => {
            // Neither degree is below 2 here, so the chain has S_0 and S_1.
            let mut chain = subresultant::chain(f, g);
            let linear = chain.swap_remove(1);
            let resultant = chain[0].coefficients().first().cloned().unwrap_or_else(Ring::zero);
            Expansion { resultant, linear }
        }
    }
}

/// The resultant of two quadratics that come from half-angle tangents, `(C - A) t^2 + 2 B t + (C + A)` from
/// `A cos + B sin + C`, as a sum of three squares of what has few terms:
///
/// `4 Res = (q p' - p q')^2 + (p b' - b p')^2 - (q b' - b q')^2`, p and q the sum and the difference of the outer
/// coefficients, b the middle one.
fn of_half_angles<D: Domain>(f: &Univariate<Polynomial<D>>, g: &Univariate<Polynomial<D>>) -> Expansion<Polynomial<D>> {
    let parts = |f: &Univariate<Polynomial<D>>| {
        let a = f.coefficients();
        (a[0].add(&a[2]), a[0].sub(&a[2]), a[1].clone())
    };
    let ((p, q, b), (p_other, q_other, b_other)) = (parts(f), parts(g));
    let z = q.mul(&p_other).sub(&p.mul(&q_other));
    let x = p.mul(&b_other).sub(&b.mul(&p_other));
    let y = q.mul(&b_other).sub(&b.mul(&q_other));
    let four_times = z.mul(&z).add(&x.mul(&x)).sub(&y.mul(&y));
    let halves = |f: &Polynomial<D>, n: i32| f.map(|c| c.checked_div_exact(&D::from_integer(n)));
    let linear = Univariate::new(vec![z.neg(), x.sub(&y)]);
    let resultant = halves(&four_times, 4).expect("four times the resultant is divisible by four");
    Expansion { resultant, linear }
}

impl<R: Ring> Eliminant<R> {
    /// The greatest common divisor of the two polynomials where the variables have the given values (that of the
    /// eliminated one is not looked at), see [`common_divisor`]; `None` if a coefficient has no image.
    pub fn common_divisor_at<F: Field>(
        &self,
        image: impl Fn(&R) -> Option<F>,
        values: &[F],
        tolerance: f64,
    ) -> Option<Vec<F>> {
        let at = |f: &Univariate<Polynomial<R>>| -> Option<Vec<F>> {
            f.coefficients().iter().map(|c| c.map(&image).map(|c| c.evaluate(values))).collect()
        };
        Some(common_divisor(&at(&self.f)?, &at(&self.g)?, tolerance))
    }
}

/// The greatest common divisor of two polynomials of given degrees over any field, f64 and complex ones among them.
///
/// Its coefficients, constant term first; k zeros at the end, which are only there if both polynomials have them, stand
/// for a common root at infinity of multiplicity k. `[d0, d1]` is the common root `-d0/d1`; `[1]` says that there is
/// none. Empty where both polynomials are zero.
///
/// It is found from the null space of the Bezout matrix of the two scaled to a largest coefficient of 1: pivots not above
/// `tolerance` count as zero. In exact fields that is 0; in inexact ones about the relative error of the coefficients.
#[must_use]
pub fn common_divisor<F: Field>(f: &[F], g: &[F], tolerance: f64) -> Vec<F> {
    let (f, g) = if f.len() < g.len() { (g, f) } else { (f, g) };
    let mut divisor = match (to_unit_size(f), to_unit_size(g)) {
        (None, None) => Vec::new(),
        (Some(only), None) | (None, Some(only)) => only,
        (Some(f), Some(g)) => from_null_space(f, &g, tolerance),
    };
    F::normalise(&mut divisor);
    divisor
}

/// The common divisor of two polynomials other than zero, the one of higher degree first.
fn from_null_space<F: Field>(f: Vec<F>, g: &[F], tolerance: f64) -> Vec<F> {
    let m = f.len() - 1;
    let null_space = reduce(&bezout::matrix(&f, g), m, tolerance).null_space();
    let k = null_space.len();
    if k == m {
        // The two are multiples of one another: for m = 0 both are numbers, and else of the same degree.
        return if m == 0 { vec![F::one()] } else { f };
    }
    // The divisor times any power of x is orthogonal to the null vectors, and only its multiples are so for all powers.
    let windows = |v: &Vec<F>| -> Vec<Vec<F>> { v.windows(k + 1).map(<[F]>::to_vec).collect() };
    let windows: Vec<Vec<F>> = null_space.iter().flat_map(windows).collect();
    let mut divisor = reduce_up_to(&windows, k + 1, k, 0.0).null_space().pop().unwrap_or_else(|| vec![F::one()]);
    divisor.reverse();
    divisor
}

/// The coefficients divided by the largest one; `None` if all are zero.
fn to_unit_size<F: Field>(f: &[F]) -> Option<Vec<F>> {
    let larger = |best: &F, c: &F| c.pivot_size() > best.pivot_size();
    let largest = f.iter().fold(F::zero(), |best, c| if larger(&best, c) { c.clone() } else { best });
    let inverse = largest.inverse()?;
    Some(f.iter().map(|c| c.mul(&inverse)).collect())
}
