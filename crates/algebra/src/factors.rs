//! Known factors that eliminations bring in: divided out and reported.

use super::polynomial::Polynomial;
use super::ring::{Domain, Ring};

/// A polynomial and the factors it had.
#[derive(Clone, Debug)]
pub struct Removal<R> {
    /// The remaining cofactor.
    pub rest: Polynomial<R>,
    /// Each of the given factors, and how often it divided.
    pub factors: Vec<(Polynomial<R>, u32)>,
}

/// Divides out given factors, one after the other, each as often as it divides: `1 + t^2` of half-angle substitutions,
/// powers of a variable, leading coefficients, minors.
///
/// Zero and units are left in, as are all factors of the zero polynomial: they would divide without end.
///
/// # Example
/// ```
/// use looproot_algebra::{factors::remove_factors, int::Int, polynomial::Polynomial, ring::Ring};
///
/// let (t, x) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
/// let circle = t.pow(2).add(&Ring::one());
/// let removal = remove_factors(&circle.pow(3).mul(&x.add(&t)), &[circle.clone(), t.clone()]);
/// assert_eq!(removal.rest, x.add(&t));
/// assert_eq!(removal.factors, [(circle, 3), (t, 0)]);
/// ```
#[must_use]
pub fn remove_factors<D: Domain>(f: &Polynomial<D>, factors: &[Polynomial<D>]) -> Removal<D> {
    let mut rest = f.clone();
    let mut remove = |factor: &Polynomial<D>| {
        let endless = rest.is_zero() || Polynomial::one().checked_div_exact(factor).is_some();
        let mut multiplicity = 0;
        while let Some(quotient) = Some(&rest).filter(|_| !endless).and_then(|rest| rest.checked_div_exact(factor)) {
            rest = quotient;
            multiplicity += 1;
        }
        (factor.clone(), multiplicity)
    };
    let factors = factors.iter().map(&mut remove).collect();
    Removal { rest, factors }
}
