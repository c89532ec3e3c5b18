//! Finds the roots of an eliminant that belong to solutions, and the number of solutions of each.
//!
//! Every solution is a root of the eliminant, but in special loops there may be more roots. The ring of the closure equations
//! has one dimension for every solution. In it the unknown is a matrix, whose characteristic polynomial has each value as
//! often as there are solutions. It is computed modulo a prime. The square-free factors of the eliminant, over the integers, are
//! split accordingly by Hensel's lemma, and exact division confirms the split.

use super::chain::{Exact, Mod};
use super::cuts;
use super::polynomial::{Eliminant, Removed, over_rationals};
use super::symbols::Symbols;
use crate::algebra::determinant::by_interpolation;
use crate::algebra::drawn;
use crate::algebra::residues::{MOST, Residues};
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::cut::Cut;
use crate::elimination::point_reach;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use rug::ops::RemRounding;
use rug::{Integer, Rational};

/// Limits on bits of the numbers and on solutions of a loop beyond which the relations over the rationals take long.
const SHORT: u32 = 64;
const FEW: usize = 8;

/// An eliminant reduced to the roots that belong to solutions.
pub(super) struct Settled {
    pub eliminant: Eliminant,
    /// Whether the factors divided out are proved to belong to no solution.
    pub proved: bool,
    /// The step taken, if any.
    pub step: Option<String>,
    /// Whether the solutions are finite in number, as far as is known.
    pub finite: bool,
}

impl Settled {
    /// Returns the eliminant unchanged.
    pub fn as_it_is(eliminant: Eliminant) -> Self {
        Self { eliminant, proved: true, step: None, finite: true }
    }
}

/// Returns the number of solutions of a loop without a spherical joint, by the ring of its closure equations; `None` for families.
pub(super) fn count(exact: &Exact) -> Option<usize> {
    Some(Plan::of(exact.modular.as_ref()?)?.count())
}

/// Divides out of the eliminant of an unknown the factors that belong to no solution. In general there are `per_root`
/// solutions at each root.
pub(super) fn settled(exact: &Exact, unknown: usize, eliminant: Eliminant, per_root: usize) -> Settled {
    let reach =
        exact.spherical.zip(exact.modular.as_ref()).map(|(spherical, modular)| point_reach::count(modular, spherical));
    let Some(ring) = SolutionRing::of(exact, unknown) else {
        // The three angles of a spherical joint may form a family while its centre does not.
        let finite = exact.modular.is_none() || reach.flatten().is_some();
        return Settled { finite, ..Settled::as_it_is(eliminant) };
    };
    // Some complex rotations of a spherical joint have no three angles; if its centre is counted, a smaller number means nothing.
    if reach.flatten().is_some() && ring.count() > 0 {
        return Settled::as_it_is(eliminant);
    }
    let (count, roots) = (ring.count(), eliminant.roots());
    if count == roots * per_root {
        return met(exact, unknown, eliminant);
    }
    let values = ring.values(&ring.view, |pencil| by_interpolation(pencil));
    let Some(kept) = values.and_then(|values| kept(unknown, &eliminant, &values, &ring)) else {
        return Settled { proved: false, ..Settled::as_it_is(eliminant) };
    };
    let step = format!(
        "The ring of the closure equations (modulo a prime drawn at run time) has dimension {count}: so many solutions there are. The \
         characteristic polynomial of multiplication by {} in it has their values as roots; what else there is of the {roots} \
         roots is divided out.",
        exact.symbols.name(unknown)
    );
    let removed = &kept.removed[eliminant.removed.len()..];
    let proved =
        exact.spherical.is_none() && (is_proved(exact, unknown, removed) || ring.holds_over_rationals(exact, unknown));
    Settled { proved, step: Some(step), ..Settled::as_it_is(kept) }
}

/// Returns an eliminant with as many roots as the ring counts solutions: nothing is divided out.
///
/// If the roots modulo the prime are simple, each root is proved to belong to solutions. Closure maps a smooth scheme of
/// dimension 6 to the group of motions, which is one too, so a simple solution modulo the prime lifts to one over the
/// algebraic numbers, by Hensel's lemma. Then there are as many solutions as the roots can have together. For multiple
/// solutions modulo the prime nothing follows, and the count is probable.
pub(super) fn met(exact: &Exact, unknown: usize, eliminant: Eliminant) -> Settled {
    let proved = exact.spherical.is_some() || are_simple(exact, unknown);
    Settled { proved, ..Settled::as_it_is(eliminant) }
}

/// Returns whether a combination of the unknowns takes distinct values at the solutions modulo the prime, as many as the
/// ring has dimensions.
fn are_simple(exact: &Exact, unknown: usize) -> bool {
    let ring = SolutionRing::of(exact, unknown).filter(|ring| ring.repeats == 1);
    let values = ring.as_ref().and_then(SolutionRing::combined_values);
    values.is_some_and(|values| values.square_free_part().degree() == ring.map(|ring| ring.count()))
}

/// Returns whether each factor has no root in common with the polynomial of the same unknown by some cut. Factors must keep
/// their degree modulo the prime: a common root may be one that goes to infinity there.
fn is_proved(exact: &Exact, unknown: usize, removed: &[Removed]) -> bool {
    let Some(modular) = &exact.modular else { return false };
    let all: Vec<Univariate<Mod>> = cuts::eliminants(modular, unknown).collect();
    removed.iter().all(|one| {
        let Some(factor) = &one.factor else { return all.iter().any(|other| other.degree() == Some(16)) };
        let image = factor.to_univariate(Symbols::variable(unknown)).and_then(|factor| factor.map(Mod::from_rational));
        let Some(image) = image else { return false };
        let degree = factor.degree(Symbols::variable(unknown)) as usize;
        image.degree().is_some_and(|found| found == degree)
            && all.iter().any(|other| other.gcd(&image).degree() == Some(0))
    })
}

/// Returns the polynomial of an unknown from the ring of the closure equations, for loops for which every elimination
/// vanishes identically; `None` if solutions form families.
pub(super) fn by_ring(exact: &Exact) -> Option<(usize, Settled)> {
    let rotations = (0..6).filter(|k| exact.closed.variables[*k] == Variable::Rotation);
    let rings = rotations.filter_map(|unknown| {
        let ring = SolutionRing::of(exact, unknown)?;
        let values = ring.values(&ring.view, |pencil| by_interpolation(pencil))?;
        let distinct = values.square_free_part().degree()?;
        Some((unknown, ring, distinct))
    });
    // The first of those with the most distinct values.
    let (unknown, ring, _) = rings
        .filter(|(_, ring, _)| ring.repeats == 1)
        .reduce(|best, other| if other.2 > best.2 { other } else { best })?;
    let count = ring.count();
    let view = SolutionRing::view(&exact.closed, unknown);
    let image = |k: usize| view.constants[k].map(Residues::from_rational);
    let constants: Vec<Motion<Residues>> = (0..6).map(image).collect::<Option<_>>()?;
    let residues = ClosedLoop { variables: view.variables, constants: constants.try_into().ok()? };
    let values = ring.values(&residues, |pencil| by_interpolation(pencil))?.normalise();
    let coefficients = Univariate::new(values.map(Residues::rational)?.primitive_integers());
    let at_pi = count - coefficients.degree()?;
    let step = format!(
        "Relations between the monomials of the unknowns, consequences of the closure equations, leave {count} monomials \
         independent: a ring of this dimension, in which multiplication by {} is a matrix. Its characteristic polynomial, \
         computed modulo {MOST} primes below 2^62, is the closure polynomial.",
        exact.symbols.name(unknown)
    );
    let eliminant = Eliminant { coefficients, at_pi, removed: Vec::new() };
    let proved = count <= 2 && ring.holds_over_rationals(exact, unknown);
    Some((unknown, Settled { proved, step: Some(step), ..Settled::as_it_is(eliminant) }))
}

/// The ring of polynomials on the solutions of a loop, with one unknown as variable.
struct SolutionRing {
    view: ClosedLoop<Mod>,
    plan: Plan,
    /// The number of times it counts each solution: two triples of angles of a spherical joint give the same rotation.
    repeats: usize,
}

impl SolutionRing {
    /// Returns the ring; `None` if solutions form families.
    fn of(exact: &Exact, unknown: usize) -> Option<Self> {
        let view = Self::view(exact.modular.as_ref()?, unknown);
        let plan = Plan::of(&view)?;
        Some(Self { view, plan, repeats: if exact.spherical.is_some() { 2 } else { 1 } })
    }

    /// Returns the number of solutions.
    fn count(&self) -> usize {
        self.plan.count() / self.repeats
    }

    /// Returns the polynomial of the values of a combination of all unknowns, one for each dimension of the ring.
    fn combined_values(&self) -> Option<Univariate<Mod>> {
        let n = self.plan.count();
        if n == 0 {
            return Some(Univariate::one());
        }
        // Weights without a simple linear relation.
        let weight = |k: usize| i32::try_from(k).map_or(1, |k| 1_299_709 + 7_919 * k * (k + 3) + k);
        let matrix = self.plan.ring(&self.view)?.multiplication(&std::array::from_fn(|k| Mod::from_integer(weight(k))));
        let one: Vec<Vec<Mod>> =
            (0..n).map(|i| (0..n).map(|j| Mod::from_integer(i32::from(i == j))).collect()).collect();
        let minus: Vec<Vec<Mod>> = matrix.iter().map(|row| row.iter().map(Ring::neg).collect()).collect();
        Some(by_interpolation(&[minus, one]))
    }

    /// Returns the loop with an unknown as the first.
    fn view<F: Field>(closed: &ClosedLoop<F>, unknown: usize) -> ClosedLoop<F> {
        Cut { rotation: unknown, reversed: false }.of(closed)
    }

    /// Returns whether the relations of the ring hold over the rationals as well as modulo the prime, so that only its values
    /// belong to solutions. It is called only if the numbers stay short.
    fn holds_over_rationals(&self, exact: &Exact, unknown: usize) -> bool {
        let bits = |x: &Rational| x.numer().significant_bits().max(x.denom().significant_bits());
        let numbers = exact.closed.constants.iter().flat_map(|g| g.rotation.iter().flatten().chain(&g.translation));
        let is_short = numbers.map(bits).max() <= Some(SHORT) && self.count() <= FEW;
        (is_short || self.count() <= 2) && self.plan.ring(&Self::view(&exact.closed, unknown)).is_some()
    }

    /// Returns the polynomial of the unknown's values at all solutions that are not at pi, a determinant linear in it.
    fn values<F: Field>(
        &self,
        view: &ClosedLoop<F>,
        determinant: impl Fn(&[Vec<Vec<F>>; 2]) -> Univariate<F>,
    ) -> Option<Univariate<F>> {
        let n = self.plan.count();
        if n == 0 {
            return Some(Univariate::one());
        }
        let ring = self.plan.ring(view)?;
        let (rotated, _) = ring.view();
        Some(determinant(&ring.tangent_pencil((6 - rotated) % 6)))
    }
}

/// Returns the factor of an eliminant with these values as roots; `None` if not all of them are roots.
fn kept(unknown: usize, eliminant: &Eliminant, values: &Univariate<Mod>, ring: &SolutionRing) -> Option<Eliminant> {
    let parts = values.square_free_decomposition();
    let finite = values.degree()? / ring.repeats;
    let at_pi = ring.count() - finite;
    let mut removed = eliminant.removed.clone();
    let mut remove = |factor: Option<&Univariate<Integer>>, multiplicity: usize, solutions: usize| {
        let factor = factor.map(|factor| over_rationals(Symbols::variable(unknown), factor));
        let fewer = if solutions == 0 { "no solution" } else { "fewer solutions" };
        let reason = format!("{fewer} there in the ring of the closure equations");
        removed.push(Removed { factor, multiplicity: multiplicity - solutions, reason });
    };
    let mut coefficients = Univariate::one();
    for (factor, multiplicity) in eliminant.coefficients.square_free_decomposition() {
        let mut rest = factor.map(modular)?.normalise();
        for (part, times) in &parts {
            let solutions = times / ring.repeats;
            let common = rest.gcd(part);
            if common.degree() == Some(0) {
                continue;
            }
            rest = rest.div_exact(&common);
            let lifted = lifted(&factor, &common)?;
            coefficients = (0..solutions).fold(coefficients, |product, _| product.mul(&lifted));
            if multiplicity > solutions {
                remove(Some(&lifted), multiplicity, solutions);
            }
        }
        if rest.degree() > Some(0) {
            remove(Some(&lifted(&factor, &rest)?), multiplicity, 0);
        }
    }
    if eliminant.at_pi > at_pi {
        remove(None, eliminant.at_pi, at_pi);
    }
    (coefficients.degree() == Some(finite)).then_some(Eliminant { coefficients, at_pi, removed })
}

fn modular(c: &Integer) -> Option<Mod> {
    Mod::from_rational(&Rational::from(c))
}

/// Returns the factor over the integers that is a multiple of `part` modulo the prime, if there is one. The polynomial has no
/// multiple root modulo the prime.
///
/// # Source
/// Hensel's lemma with quadratic convergence: von zur Gathen and Gerhard, Modern Computer Algebra, section 15.4.
fn lifted(polynomial: &Univariate<Integer>, part: &Univariate<Mod>) -> Option<Univariate<Integer>> {
    let degree = polynomial.degree()?;
    if part.degree() == Some(degree) {
        return Some(polynomial.clone());
    }
    let leading = polynomial.coefficients().last()?.clone();
    let other = polynomial.map(modular)?.normalise().checked_div_exact(part)?;
    let (s, t) = bezout(part, &other)?;
    let whole = |p: &Univariate<Mod>| p.map(|c| Some(Integer::from(c.value())));
    let (mut g, mut h, mut s, mut t) = (whole(part)?, whole(&other)?, whole(&s)?, whole(&t)?);
    let size = polynomial.coefficients().iter().map(Integer::significant_bits).max()?;
    // Twice the largest coefficient of a divisor times the leading coefficient, by Mignotte's bound.
    let enough = 2 * size + 2 * u32::try_from(degree).ok()? + 4;
    let mut modulus = Integer::from(drawn::prime());
    loop {
        let symmetric = |c: &Integer| {
            let c = Integer::from(c * &leading).rem_euc(&modulus);
            Some(if Integer::from(&c * 2) > modulus { c - &modulus } else { c })
        };
        let candidate = g.map(symmetric)?.primitive_part();
        if polynomial.quotient(&candidate).is_some() {
            return Some(candidate);
        }
        if modulus.significant_bits() > enough {
            return None;
        }
        modulus.square_mut();
        let m = &modulus;
        let inverse = leading.clone().invert(m).ok()?;
        let f = reduced(&polynomial.scale(&inverse), m);
        let error = reduced(&f.sub(&g.mul(&h)), m);
        let (q, r) = divided(&s.mul(&error), &h, m);
        g = reduced(&g.add(&t.mul(&error)).add(&q.mul(&g)), m);
        h = reduced(&h.add(&r), m);
        let error = reduced(&s.mul(&g).add(&t.mul(&h)).sub(&Univariate::one()), m);
        let (q, r) = divided(&s.mul(&error), &h, m);
        s = reduced(&s.sub(&r), m);
        t = reduced(&t.sub(&t.mul(&error)).sub(&q.mul(&g)), m);
    }
}

fn reduced(p: &Univariate<Integer>, modulus: &Integer) -> Univariate<Integer> {
    Univariate::new(p.coefficients().iter().map(|c| Integer::from(c.rem_euc(modulus))).collect())
}

/// Returns quotient and remainder by a monic polynomial.
fn divided(
    p: &Univariate<Integer>,
    divisor: &Univariate<Integer>,
    modulus: &Integer,
) -> (Univariate<Integer>, Univariate<Integer>) {
    let mut rest = reduced(p, modulus).coefficients().to_vec();
    let mut quotient = Vec::new();
    while rest.len() >= divisor.coefficients().len() {
        let shift = rest.len() - divisor.coefficients().len();
        let top = rest.last().cloned().unwrap_or_default();
        for (x, c) in rest[shift..].iter_mut().zip(divisor.coefficients()) {
            *x = (&*x - Integer::from(&top * c)).rem_euc(modulus);
        }
        rest.pop();
        quotient.push(top);
    }
    quotient.reverse();
    (Univariate::new(quotient), Univariate::new(rest))
}

/// Returns s and t of degrees below those of b and a with `s a + t b = 1`; `None` with a common factor.
fn bezout(a: &Univariate<Mod>, b: &Univariate<Mod>) -> Option<(Univariate<Mod>, Univariate<Mod>)> {
    let (mut old, mut new) = ((a.clone(), Univariate::one()), (b.clone(), Univariate::zero()));
    while !new.0.is_zero() {
        let (quotient, rest) = old.0.div_rem(&new.0);
        let s = old.1.sub(&quotient.mul(&new.1));
        (old, new) = (new, (rest, s));
    }
    if old.0.degree() != Some(0) {
        return None;
    }
    let scale = old.0.coefficients().first().and_then(Field::inverse)?;
    let s = old.1.scale(&scale);
    let (t, rest) = Univariate::<Mod>::one().sub(&s.mul(a)).div_rem(b);
    rest.is_zero().then_some((s, t))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i64]) -> Univariate<Integer> {
        Univariate::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn factors_are_lifted_from_the_prime_and_what_is_no_factor_is_refused() {
        // Coefficients longer than the prime, and leading ones other than 1.
        let one = polynomial(&[-1_234_567_890_123_456_789, 17, 0, 6_000_000_000_000_000_077]);
        let two = polynomial(&[4_611_686_018_427_387_847, -3, 10]);
        let product = one.mul(&two);
        let image = |p: &Univariate<Integer>| p.map(modular).unwrap().normalise();
        assert_eq!(lifted(&product, &image(&one)).unwrap(), one);
        assert_eq!(lifted(&product, &image(&two)).unwrap(), two);
        assert_eq!(lifted(&product, &image(&product)).unwrap(), product);
        // One of 2, 3 and 6 is a square modulo the prime, so its polynomial splits there; none is a square over the integers.
        let root = |n: i32| {
            let n = Mod::from_integer(n);
            let root = (0..(drawn::prime() + 1).ilog2()).fold((Mod::one(), n), |(power, square), bit| {
                let is_set = ((drawn::prime() + 1) / 4) >> bit & 1 == 1;
                (if is_set { power.mul(&square) } else { power }, square.mul(&square))
            });
            (root.0.mul(&root.0) == n).then_some(root.0)
        };
        let (n, root) = [2, 3, 6].into_iter().find_map(|n| Some((n, root(n)?))).unwrap();
        let linear = Univariate::new(vec![root.neg(), Mod::one()]);
        assert!(polynomial(&[-i64::from(n), 0, 1]).map(modular).unwrap().checked_div_exact(&linear).is_some());
        assert_eq!(lifted(&polynomial(&[-i64::from(n), 0, 1]), &linear), None);
        assert_eq!(lifted(&product, &image(&polynomial(&[1, 1]))), None);
    }
}
