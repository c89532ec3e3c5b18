//! The closure polynomial of a loop with four rotations, and the number of its eight roots that are solutions.
//!
//! With `f = (C, A, B) . (1, cos b, sin b)`, `g` likewise and `N = f x g`, eliminating angle b leaves `N1^2 + N2^2 - N3^2`, of
//! degree 8 in the half-angle tangent x of the other angle. Not all of its roots need be finite solutions: x = +-i belongs to no
//! angle, nor does a root at which f and g have tan(b/2) = +-i in common; and where the two directions of translation are
//! parallel, g = 0 whether the loop closes or not. All three are found by exact division and greatest common divisors, whose
//! multiplicity never exceeds that of the root, so that the remaining degree bounds the number of isolated solutions; the least
//! such bound over all choices of angles holds.

use super::cut::Hidden;
use super::separated::{offset, powers};
use super::spherical_four_bar::{Equations, Form, FourBar};
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::LinkForm;

/// A form by the powers of the hidden half tangent, over (1, cos, sin) of the other angle; the hidden angle is counted from
/// `origin`.
fn by_hidden<F: Ring>(form: &Form<F>, hidden: Hidden, origin: &[F; 3]) -> [Univariate<F>; 3] {
    let angle = powers(Variable::Rotation, origin).map(|row| Univariate::new(row.to_vec()));
    std::array::from_fn(|k| {
        angle.iter().enumerate().fold(Univariate::zero(), |sum, (l, part)| {
            let coefficient = if hidden == Hidden::First { &form[l][k] } else { &form[k][l] };
            sum.add(&part.scale(coefficient))
        })
    })
}

/// N: cosine and sine of the other angle times a common factor, and that factor.
fn normal<F: Ring>(f: &[Univariate<F>; 3], g: &[Univariate<F>; 3]) -> [Univariate<F>; 3] {
    let minor = |i: usize, j: usize| f[i].mul(&g[j]).sub(&f[j].mul(&g[i]));
    [minor(2, 0), minor(0, 1), minor(1, 2)]
}

/// `N1^2 + N2^2 - N3^2`
fn eliminant<F: Ring>(f: &[Univariate<F>; 3], g: &[Univariate<F>; 3]) -> Univariate<F> {
    let [n1, n2, n3] = normal(f, g);
    n1.mul(&n1).add(&n2.mul(&n2)).sub(&n3.mul(&n3))
}

/// Roots of a closure polynomial of degree 8 that belong to no solution.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseRoots<F> {
    /// Roots at which the other half tangent would be i or -i, which belongs to no angle.
    pub imaginary: Univariate<F>,
    /// Roots at which the two translations are parallel and do not close the loop.
    pub parallel: Univariate<F>,
    /// The number of roots of the second sort at infinity, where the hidden angle is pi.
    pub parallel_at_pi: usize,
}

/// The false roots of a closure polynomial, a divisor of [`closure_polynomial`] without factors `1 + x^2`: divided out
/// with their whole multiplicity. A root at which the translations are parallel and the loop closes nevertheless, a
/// self-motion, is left alone; and where both values of the other angle belong to a root, it is false only with both.
#[must_use]
pub fn false_roots<F: Field + Domain>(
    bar: &FourBar<'_, F>,
    equations: &Equations<F>,
    hidden: Hidden,
    origin: &[F; 3],
    polynomial: &Univariate<F>,
) -> FalseRoots<F> {
    let view = |form: &Form<F>| by_hidden(form, hidden, origin);
    let (f, g) = (view(&equations.f), view(&equations.g));
    let normal = normal(&f, &g);
    // Where N vanishes the other angle has two values, or any.
    let several = normal[0].gcd(&normal[1]).gcd(&normal[2]);
    let without = |factor: Univariate<F>| factor.div_exact(&factor.part_with_roots_of(&several));
    // Common roots of A + i B of both rows: the other half tangent is i there, or -i.
    let pair = |x: &[Univariate<F>; 3], y: &[Univariate<F>; 3]| x[1].mul(&y[1]).add(&x[2].mul(&y[2]));
    let crossed = f[1].mul(&g[2]).sub(&f[2].mul(&g[1]));
    let condition = pair(&f, &f).gcd(&pair(&g, &g)).gcd(&pair(&f, &g)).gcd(&crossed);
    let imaginary = without(polynomial.part_with_roots_of(&condition));
    let rest = polynomial.div_exact(&imaginary);
    // Three coordinates of `u x v` and of `u x s` at the other angle that belongs to a root.
    let unit = |i: usize| -> [F; 3] { std::array::from_fn(|k| if k == i { F::one() } else { F::zero() }) };
    let at_root = |form: &Form<F>| {
        let [one, cos, sin] = view(form);
        one.mul(&normal[2]).add(&cos.mul(&normal[0])).add(&sin.mul(&normal[1]))
    };
    let forms = |form: &dyn Fn(&[F; 3]) -> Form<F>| {
        [0, 1, 2].map(|i| {
            // Only zeros matter: over the rationals as integers, which multiply faster.
            let mut form = form(&unit(i));
            F::normalise(form.as_flattened_mut());
            form
        })
    };
    let directions = forms(&|x| bar.coplanarity(bar.base, x));
    let gaps = forms(&|x| bar.gap(bar.base, x));
    let common = |list: &[Univariate<F>]| list.iter().fold(Univariate::zero(), |g: Univariate<F>, p| g.gcd(p));
    let (crossing, gap) = (directions.each_ref().map(at_root), gaps.each_ref().map(at_root));
    let single = without(rest.part_with_roots_of(&common(&crossing)));
    let single = single.div_exact(&single.part_with_roots_of(&common(&gap)));
    // Where N vanishes: rows proportional to that of f are zero at both its roots.
    let rows: Vec<Univariate<F>> = directions.iter().flat_map(|form| self::normal(&view(form), &f)).collect();
    let gap_rows = gaps.each_ref().map(|form| eliminant(&f, &view(form)));
    let double = rest.part_with_roots_of(&several).part_with_roots_of(&common(&rows));
    let double =
        [common(&f), common(&gap_rows)].iter().fold(double, |left, p| left.div_exact(&left.part_with_roots_of(p)));
    // The same test at infinity, by leading coefficients.
    let vanish = |list: &[Univariate<F>], degree: usize| list.iter().all(|p| p.degree() < Some(degree));
    let lost = 8_usize.saturating_sub(closure_polynomial(equations, hidden, origin).degree().unwrap_or(8));
    let is_false = if vanish(&normal, 4) {
        vanish(&rows, 4) && !vanish(&f, 2) && !vanish(&gap_rows, 8)
    } else {
        vanish(&crossing, 6) && !vanish(&gap, 6)
    };
    FalseRoots { imaginary, parallel: single.mul(&double), parallel_at_pi: if is_false { lost } else { 0 } }
}

/// The conditions at a root of the closure polynomial, as polynomials in the same half tangent.
#[derive(Clone, Debug)]
pub struct RootConditions<F> {
    /// Three coordinates of `u x v` times `N3`: all of them vanish where the translations are dependent.
    pub parallel: [Univariate<F>; 3],
    /// Three coordinates of `u x s` times `N3`: the loop does not close where the translations are dependent and these do not all
    /// vanish.
    pub gap: [Univariate<F>; 3],
}

/// Returns the conditions that decide whether a root of [`closure_polynomial`] belongs to a solution.
#[must_use]
pub fn root_conditions<F: Field>(
    bar: &FourBar<'_, F>,
    equations: &Equations<F>,
    hidden: Hidden,
    origin: &[F; 3],
) -> RootConditions<F> {
    let view = |form: &Form<F>| by_hidden(form, hidden, origin);
    let normal = normal(&view(&equations.f), &view(&equations.g));
    let unit = |i: usize| -> [F; 3] { std::array::from_fn(|k| if k == i { F::one() } else { F::zero() }) };
    let at_root = |form: Form<F>| {
        let [one, cos, sin] = view(&form);
        one.mul(&normal[2]).add(&cos.mul(&normal[0])).add(&sin.mul(&normal[1]))
    };
    let parallel = [0, 1, 2].map(|i| at_root(bar.coplanarity(bar.base, &unit(i))));
    let gap = [0, 1, 2].map(|i| at_root(bar.gap(bar.base, &unit(i))));
    RootConditions { parallel, gap }
}

/// The closure polynomial of degree 8 in the tangent of half the hidden angle, counted from an angle given as
/// (1, cos, sin) or a multiple of that.
#[must_use]
pub fn closure_polynomial<F: Ring>(equations: &Equations<F>, hidden: Hidden, origin: &[F; 3]) -> Univariate<F> {
    eliminant(&by_hidden(&equations.f, hidden, origin), &by_hidden(&equations.g, hidden, origin))
}

/// Returns the bound on the number of isolated solutions for one hidden angle; `None` where the polynomial vanishes.
fn bound_of<F: Field + Domain>(bar: &FourBar<'_, F>, equations: &Equations<F>, hidden: Hidden) -> Option<usize> {
    // A general origin, so that no root is likely at infinity.
    let origin = &offset();
    let (f, g) = (by_hidden(&equations.f, hidden, origin), by_hidden(&equations.g, hidden, origin));
    let polynomial = eliminant(&f, &g);
    polynomial.degree()?;
    let (spurious, mut rest) = polynomial.remove_factor(&Univariate::circle());
    // Common roots of A + i B of both rows: the other half tangent is i there, or -i.
    let pair = |x: &[Univariate<F>; 3], y: &[Univariate<F>; 3]| x[1].mul(&y[1]).add(&x[2].mul(&y[2]));
    let crossed = f[1].mul(&g[2]).sub(&f[2].mul(&g[1]));
    let mut lost = 2 * spurious;
    let infinite = rest.gcd(&pair(&f, &f)).gcd(&pair(&g, &g)).gcd(&pair(&f, &g)).gcd(&crossed);
    let (_, infinite) = if infinite.is_zero() { (0, infinite) } else { infinite.remove_factor(&Univariate::circle()) };
    if infinite.degree() > Some(0) {
        lost += infinite.degree().unwrap_or(0);
        rest = rest.div_exact(&infinite);
    }
    // A vector in general position: coplanar with both directions only where these are parallel.
    let general = [1_234_577, -7_654_321, 3_141_593].map(F::from_integer);
    let plane = by_hidden(&bar.coplanarity(bar.base, &general), hidden, origin);
    let parallel = eliminant(&f, &plane);
    parallel.degree()?;
    let parallel = rest.gcd(&parallel);
    if parallel.degree() > Some(0) {
        // Parallel translations that close the loop leave it a continuum.
        let gap = eliminant(&f, &by_hidden(&bar.gap(bar.base, &general), hidden, origin));
        if parallel.gcd(&gap).degree() > Some(0) {
            return None;
        }
        lost += parallel.degree().unwrap_or(0);
    }
    Some(8_usize.saturating_sub(lost))
}

/// Returns the least bound on the number of isolated solutions, with multiplicity; `None` where every choice of angles is
/// degenerate.
#[must_use]
pub fn bound<F: Field + Domain>(form: &LinkForm<F, 4, 2>) -> Option<usize> {
    let mut best: Option<usize> = None;
    for base in 0..4 {
        let Some(bar) = FourBar::new(form, base) else { continue };
        let equations = bar.equations();
        for hidden in [Hidden::First, Hidden::Second] {
            if let Some(bound) = bound_of(&bar, &equations, hidden) {
                best = Some(best.map_or(bound, |b| b.min(bound)));
            }
        }
    }
    best
}
