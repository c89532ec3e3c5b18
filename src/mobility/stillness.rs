//! Proofs that a joint variable stands still: that it takes finitely many values in all configurations of a chain.

use crate::algebra::determinant;
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::ring::{Domain, Field};
use crate::algebra::univariate::Univariate;
use crate::exact::cut::Cut;
use crate::exact::linkage::{JointValue, Linkage};
use crate::kinematics::closed_loop::Variable;
use rug::Rational;

/// The field of the quick proofs: what is not 0 there is not 0 over the rationals.
type Mod = ModP<PRIME_61>;
/// Values of half the angle's tangent, or half the distance, in the prime field: any would do, few are unlucky.
const START: u64 = 0x9e37_79b9_7f4a_7c15 % PRIME_61;
/// Largest degree of a condition in the held variable: one value more shows whether it is zero.
const DEGREE: i32 = 4;

/// Returns whether it is proved that no joint variable of a chain of up to six moves: each takes finitely many values in the
/// configurations, complex ones included.
///
/// # Source
/// docs/mobility.md, theorems 5 and 6.
pub(super) fn all_stand_still(linkage: &Linkage<Rational>) -> bool {
    let n = linkage.variables.len();
    let Some(image) = linkage.map::<Mod>().filter(|_| (1..=6).contains(&n)) else { return false };
    let (mut still, mut doubtful): (Vec<usize>, Vec<usize>) = (0..n).partition(|k| stands_still(linkage, &image, *k));
    // One joint cannot move alone.
    while doubtful.len() > 1 {
        let is_proved = |k: &&usize| still.iter().any(|constant| is_without_value(linkage, **k, *constant));
        let Some(k) = doubtful.iter().find(is_proved).copied() else { return false };
        doubtful.retain(|other| *other != k);
        still.push(k);
    }
    true
}

/// Whether all joints of a chain stand still, by images of its numbers in a prime field: what is not 0 there is not 0.
///
/// # Source
/// docs/mobility.md, theorem 5 and (a) of theorem 6.
pub(super) fn all_stand_still_modulo<M: Field + Domain>(image: &Linkage<M>) -> bool {
    let n = image.variables.len();
    let stands_still = |k: usize| {
        n == 1
            || (n <= 5 && Cut::<M>::hiding(n, k).any(|cut| is_separated(image, cut, k)))
            || (1..n).any(|step| is_bound(image, k, (k + step) % n))
    };
    // One joint cannot move alone.
    (1..=6).contains(&n) && (0..n).filter(|k| !stands_still(*k)).count() <= 1
}

/// Whether it is proved that joint variable k takes finitely many values.
fn stands_still(linkage: &Linkage<Rational>, image: &Linkage<Mod>, k: usize) -> bool {
    let n = linkage.variables.len();
    if n == 1 || (n <= 5 && Cut::<Mod>::hiding(n, k).any(|cut| is_separated(image, cut, k))) {
        return true;
    }
    let others = || (1..n).map(|step| (k + step) % n);
    others().any(|hidden| is_bound(image, k, hidden)) || others().any(|hidden| is_bound_exactly(linkage, k, hidden))
}

/// Returns whether the columns of a cut are independent at some value of the hidden variable: then only finitely many values have
/// a configuration.
fn is_separated<M: Field>(image: &Linkage<M>, cut: (usize, usize), k: usize) -> bool {
    let cut = Cut::of(image, cut);
    let t = value::<M>(k);
    let entry = |i: usize, j: usize| cut.matrix[0][i][j].add(&cut.matrix[1][i][j].mul(&t));
    let rows: Vec<Vec<M>> = (0..8).map(|i| (0..cut.columns()).map(|j| entry(i, j)).collect()).collect();
    Echelon::of(rows, cut.columns()).rank() == cut.columns()
}

fn value<M: Field>(k: usize) -> M {
    M::from_rational(&Rational::from(START + k as u64)).unwrap_or_else(M::one)
}

/// Place of a variable in the chain without variable k.
fn place(k: usize, variable: usize) -> usize {
    if variable > k { variable - 1 } else { variable }
}

/// The conditions of all cuts that hide a variable of a chain, each a polynomial in t with its degree as a form and the power of
/// c that divides this form structurally.
pub(super) fn conditions<F: Field>(
    linkage: &Linkage<F>,
    hidden: usize,
    determinant: impl Fn(&[Vec<Vec<F>>; 2]) -> Univariate<F>,
) -> impl Iterator<Item = (Univariate<F>, usize)> {
    Cut::<F>::hiding(linkage.variables.len(), hidden).flat_map(move |cut| {
        let cut = Cut::of(linkage, cut);
        let degree = cut.degree().saturating_sub(cut.at_infinity);
        cut.conditions(&determinant).into_iter().map(move |condition| (condition, degree)).collect::<Vec<_>>()
    })
}

/// Greatest common divisor of forms, as a polynomial with its degree as a form; `None` if all are zero.
struct Common<F> {
    polynomial: Univariate<F>,
    /// Least degree by which a form exceeds its polynomial: its zero at infinity.
    at_infinity: usize,
}

impl<F: Field + Domain> Common<F> {
    fn of(forms: impl IntoIterator<Item = (Univariate<F>, usize)>, is_done: impl Fn(&Self) -> bool) -> Option<Self> {
        let mut common: Option<Self> = None;
        for (form, degree) in forms {
            let Some(own) = form.degree() else { continue };
            let at_infinity = degree.saturating_sub(own);
            let next = match common {
                None => Self { polynomial: form, at_infinity },
                Some(found) => {
                    Self { polynomial: found.polynomial.gcd(&form), at_infinity: found.at_infinity.min(at_infinity) }
                }
            };
            if is_done(&next) {
                return Some(next);
            }
            common = Some(next);
        }
        common
    }
}

impl Common<Rational> {
    /// Whether its only zeros belong to no motion: tangents i and -i of a rotation (over the length of its axis), infinite
    /// distances.
    fn is_improper(&self, linkage: &Linkage<Rational>, hidden: usize) -> bool {
        if linkage.variables[hidden] == Variable::Translation {
            return self.polynomial.degree() == Some(0);
        }
        let circle = Univariate::new(vec![Rational::from(1), Rational::new(), linkage.axes[hidden].square()]);
        self.at_infinity == 0 && self.polynomial.remove_factor(&circle).1.degree() == Some(0)
    }
}

/// Whether joint variable `hidden` has no value at one random value of k that all cuts allow, in a prime field.
fn is_bound<M: Field + Domain>(image: &Linkage<M>, k: usize, hidden: usize) -> bool {
    let held: [(usize, JointValue<M>); 1] = [(k, [M::one(), value(k)])];
    let rest = image.locked(&held);
    let is_trivial = |common: &Common<M>| common.polynomial.degree() == Some(0) && common.at_infinity == 0;
    let forms = conditions(&rest, place(k, hidden), |m| determinant::by_interpolation(m));
    Common::of(forms, is_trivial).is_some_and(|common| is_trivial(&common))
}

/// As [`is_bound`] over the rationals, without the factors that belong to no motion.
fn is_bound_exactly(linkage: &Linkage<Rational>, k: usize, hidden: usize) -> bool {
    let is_improper = |common: &Common<Rational>| common.is_improper(linkage, hidden);
    (0..=DEGREE).all(|shift| {
        Common::of(conditions_at(linkage, k, hidden, shift), is_improper).is_some_and(|common| is_improper(&common))
    })
}

/// Returns whether a joint variable that is known to stand still has no constant value that all cuts allow at several values of
/// k: then k does not move, either.
fn is_without_value(linkage: &Linkage<Rational>, k: usize, constant: usize) -> bool {
    let is_improper = |common: &Common<Rational>| common.is_improper(linkage, constant);
    let forms = (0..3).flat_map(|shift| conditions_at(linkage, k, constant, shift));
    Common::of(forms, is_improper).is_some_and(|common| is_improper(&common))
}

/// The conditions over the rationals that hide a variable, with k held at one of several values.
fn conditions_at(
    linkage: &Linkage<Rational>,
    k: usize,
    hidden: usize,
    shift: i32,
) -> Vec<(Univariate<Rational>, usize)> {
    let held = [(k, [Rational::from(1), Rational::from((3 * shift + 1, 7))])];
    conditions(&linkage.locked(&held), place(k, hidden), |m| determinant::modular(m)).collect()
}
