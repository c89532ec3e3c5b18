//! The choice of the route to a resultant of polynomials in several variables, and the factors removed first.

use super::bezout::{self, Expansion};
use super::subresultant;
use crate::int::Int;
use crate::minors::{Price, cells, parameters};
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};
use crate::univariate::Univariate;

/// Returns the resultant and the polynomial that leads back to the eliminated variable.
///
/// Polynomials in `x^k` have the k-th power of the resultant of those in x.
pub(super) fn expansion<D: Domain>(
    f: &Univariate<Polynomial<D>>,
    g: &Univariate<Polynomial<D>>,
) -> Expansion<Polynomial<D>> {
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
        let powers = exponents.into_iter().map(|e| e.saturating_mul(power)).collect();
        Polynomial::from_terms([(powers, D::one())])
    };
    // If one of these vanishes, so does a whole polynomial, and the lift must not claim more than it shows.
    let once = |exponents: &[u32]| monomial(exponents.iter().map(|&e| e.min(1)).collect(), 1);
    let linear = expansion.linear.scale(&once(&exponents_f).mul(&once(&exponents_g)));
    let factor = monomial(exponents_f, degree(g)).mul(&monomial(exponents_g, degree(f)));
    Expansion { resultant: expansion.resultant.mul(&factor), linear }
}

/// Returns the exponents of the monomial that divides all coefficients.
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

/// Returns the polynomial with a monomial divided out of its coefficients.
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

/// Degrees from which the expansion by minors is no measure of what other routes cost without values.
const HIGH: u32 = 8;
/// A resultant with fewer terms than this part of the possible ones is no matter for values at all points.
const SPARSE: f64 = 1.0 / 20.0;

/// Returns whether the resultant is sooner computed from its values modulo primes than from the polynomials as they are:
/// that takes `cost` nanoseconds and as many values as the resultant may have terms.
pub(super) fn values_pay(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize, cost: f64, values: f64) -> bool {
    let (m, n) = (f.degree(variable), g.degree(variable));
    let parameters = (0..f.variables().max(g.variables()))
        .filter(|&v| v != variable && (f.degree(v) > 0 || g.degree(v) > 0))
        .collect::<Vec<usize>>();
    match parameters.as_slice() {
        [] => true,
        &[y] => {
            let points = u64::from(n) * u64::from(f.degree(y)) + u64::from(m) * u64::from(g.degree(y));
            let work = points.saturating_mul(u64::from(m.max(n)).pow(3));
            work < 1 << 24 || (is_dense(f, 2) && is_dense(g, 2))
        }
        several => {
            // As many products of n terms of f and m terms of g there are at most.
            let products = multisets(f.len(), n) * multisets(g.len(), m);
            let dense = m.max(n) <= HIGH || products > SPARSE * values;
            dense && cost < cost_by_minors(f, g, variable, several)
        }
    }
}

/// Returns in how many ways so many of these things can be chosen, with repetition.
fn multisets(things: usize, chosen: u32) -> f64 {
    (1..=chosen).map(f64::from).fold(1.0, |ways, k| ways * (things as f64 + k - 1.0) / k)
}

/// Returns about how many nanoseconds the expansion of the Bezout matrix by minors takes.
fn cost_by_minors(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize, parameters: &[usize]) -> f64 {
    let (f, g) = if f.degree(variable) < g.degree(variable) { (g, f) } else { (f, g) };
    let (m, n) = (f64::from(f.degree(variable)), f64::from(g.degree(variable)));
    let degrees = |p: &Polynomial<Int>| -> (Vec<f64>, f64) {
        let total = |term| parameters.iter().map(|&v| f64::from(p.exponent(term, v))).sum::<f64>();
        let total = (0..p.len()).map(total).fold(0.0, f64::max);
        (parameters.iter().map(|&v| f64::from(p.degree(v))).collect(), total)
    };
    let ((of_f, total_f), (of_g, total_g)) = (degrees(f), degrees(g));
    let possible = |rows_g: f64, rows_both: f64| {
        let degrees = of_f.iter().zip(&of_g).map(|(f, g)| rows_g * g + rows_both * (f + g));
        cells(degrees, rows_g * total_g + rows_both * (total_f + total_g))
    };
    let (of_f, of_g) = (f.len() as f64 / (m + 1.0), g.len() as f64 / (n + 1.0));
    // An entry of the first n rows is a sum of n/3 differences of two products of coefficients.
    let mut bracket = Price::default();
    bracket.add(2.0 * of_f * of_g * f64::max(1.0, n / 3.0), 1.0);
    let (entry_cost, entry) = bracket.total(possible(0.0, 1.0));
    let (mut cost, mut size, mut minors, mut k) = (m * n * entry_cost, 1.0, 1.0, 0.0);
    while k < m {
        k += 1.0;
        // The rows of g alone come first.
        let (rows_g, rows_both) = (f64::min(k, m - n), f64::max(0.0, k - (m - n)));
        minors *= (m - k + 1.0) / k;
        let mut price = Price::default();
        let own = if rows_both > 0.0 { entry } else { of_g };
        price.add(k * own, size);
        let (own, next) = price.total(possible(rows_g, rows_both));
        cost += minors * (own + (k - 1.0) * Price::PRODUCT);
        size = next;
    }
    cost
}

/// Returns whether a polynomial has a quarter of the terms that its total degree allows in that many variables.
fn is_dense(f: &Polynomial<Int>, variables: usize) -> bool {
    let degree = f.total_degree().unwrap_or(0);
    let all = (1..=variables as u64).fold(1_u64, |all, k| all.saturating_mul(degree + k) / k);
    4 * f.len() as u64 >= all
}

/// The route to a resultant.
enum Route {
    /// Two quadratics whose first and last coefficients have more terms than their sums and differences.
    HalfAngles,
    /// Minors of the Bezout matrix.
    Minors,
    /// The chain of subresultants.
    Chain,
}

/// Chooses the route, here alone, by degrees, numbers of parameters and numbers of terms.
///
/// Minors never divide, and with many symbols their terms hardly cancel, so that they are faster by orders of magnitude.
/// With one or two parameters all polynomials are dense, and pseudo-division wins if it is cheap: for degrees far
/// apart, and for high ones.
fn route<D: Domain>(f: &Univariate<Polynomial<D>>, g: &Univariate<Polynomial<D>>) -> Route {
    let (Some(m), Some(n)) = (f.degree(), g.degree()) else { return Route::Minors };
    if (m, n) == (2, 2) {
        let saves = |f: &Univariate<Polynomial<D>>| {
            let (a0, a2) = (&f.coefficients()[0], &f.coefficients()[2]);
            (a0.add(a2).len() + a0.sub(a2).len(), a0.len() + a2.len())
        };
        let ((few_f, many_f), (few_g, many_g)) = (saves(f), saves(g));
        let four_divides = !D::from_integer(4).is_zero();
        return if few_f + few_g < many_f + many_g && four_divides { Route::HalfAngles } else { Route::Minors };
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

/// Returns the resultant of two quadratics that come from half-angle tangents, `(C - A) t^2 + 2 B t + (C + A)` from
/// `A cos + B sin + C`, as a sum of three squares of polynomials with few terms:
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
    let four = D::from_integer(4);
    let resultant = four_times.map(|c| c.checked_div_exact(&four)).expect("four divides four times the resultant");
    Expansion { resultant, linear: Univariate::new(vec![z.neg(), x.sub(&y)]) }
}
