//! Buchberger's algorithm with the criteria of Gebauer and Möller.

use super::coefficient::Coefficient;
use super::monomial::{MOST_VARIABLES, Monomial};
use super::polynomial::{Equation, Polynomial, Work, remainder, subtract};
use crate::drawn::Drawn;
use crate::sort;
use rug::Integer;

/// The reduced Gröbner basis of an ideal: over the rationals, with integer coefficients, or modulo a prime.
#[derive(Clone, Debug)]
pub struct Basis<C = Integer> {
    pub(super) variables: usize,
    pub(super) elements: Vec<Polynomial<C>>,
}

/// Two elements whose leading terms are made to cancel.
#[derive(Clone, Copy)]
struct Pair {
    first: usize,
    second: usize,
    multiple: Monomial,
}

/// A basis under construction.
struct Making<C> {
    elements: Vec<Polynomial<C>>,
    /// Whether the leading monomial of an element is a multiple of that of a later one; such an element serves in pairs only.
    is_old: Vec<bool>,
    pairs: Vec<Pair>,
    /// Number of products of words that may still be made.
    effort: u64,
    /// The leading monomial of every polynomial that was reduced, in their order; `None` for those that vanished.
    course: Course,
}

/// What became of the polynomials of a calculation, one after the other.
type Course = Vec<Option<Monomial>>;

impl<C: Coefficient> Basis<C> {
    /// Returns the basis of the ideal of these equations in `variables` variables; `None` if that takes more products of words
    /// than `effort`, or monomials of a degree above 127, or if a denominator is 0 modulo the prime.
    ///
    /// # Panics
    /// If there are too many variables.
    ///
    /// # Source
    /// Gebauer and Möller 1988, On an installation of Buchberger's algorithm, J. Symbolic Computation 6.
    #[must_use]
    pub fn of(variables: usize, equations: &[Equation], effort: u64) -> Option<Self> {
        Making::of(variables, equations, effort, None)?.finished(variables)
    }

    /// Returns the dimension of the set of solutions, complex ones included; `None` for the empty set.
    ///
    /// It is the largest number of variables in which no leading monomial is a product.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        let supports: Vec<u32> = self.elements.iter().map(|p| support(p.leading())).collect();
        let is_free = |set: &u32| supports.iter().all(|support| support & !set != 0);
        (0..1_u32 << self.variables).filter(is_free).map(|set| set.count_ones() as usize).max()
    }

    /// Returns the monomials that are no multiples of leading ones, in their order: as many as there are solutions, with multiplicity.
    /// `None` for infinitely many, and for more than `most`.
    pub(super) fn standard(&self, most: usize) -> Option<Vec<Monomial>> {
        let leading: Vec<Monomial> = self.elements.iter().map(Polynomial::leading).collect();
        let is_standard = |m: &Monomial| !leading.iter().any(|l| l.divides(*m));
        let mut standard: Vec<Monomial> = vec![Monomial::one()].into_iter().filter(is_standard).collect();
        let mut at = 0;
        while at < standard.len() {
            for k in 0..self.variables {
                let product = standard[at].times(Monomial::variable(k))?;
                if is_standard(&product) && !standard.contains(&product) {
                    standard.push(product);
                }
            }
            at += 1;
            if standard.len() > most {
                return None;
            }
        }
        standard.sort_unstable();
        Some(standard)
    }

    /// Returns the number of solutions, complex ones included, with multiplicity; `None` if there are infinitely many, or more
    /// than `most`.
    #[must_use]
    pub fn count(&self, most: usize) -> Option<usize> {
        self.standard(most).map(|standard| standard.len())
    }

    /// Returns the elements in the order of their leading monomials.
    pub(super) fn by_size(&self) -> Vec<&Polynomial<C>> {
        self.elements.iter().collect()
    }
}

impl Basis {
    /// Returns elements of the ideal over the rationals that are its basis if the prime of this run is an ordinary one, with the
    /// basis modulo that prime. `None` as for [`Self::of`], for either of them; `modular_effort` is for the second one. Nothing is done
    /// over the rationals where there are infinitely many solutions modulo the prime.
    ///
    /// Most of the work over the rationals goes into pairs that reduce to 0, and here those that do so modulo the prime are left out.
    /// All elements lie in the ideal, whatever the prime is. So the monomials that are no multiples of leading ones span the quotient:
    /// there are at most that many solutions, with multiplicity, and none if an element is a constant.
    ///
    /// # Panics
    /// If there are too many variables.
    ///
    /// # Source
    /// Traverso 1989, Gröbner trace algorithms, ISSAC 1988.
    #[must_use]
    pub fn spanning(
        variables: usize,
        equations: &[Equation],
        modular_effort: u64,
        effort: u64,
    ) -> Option<(Option<Self>, Basis<Drawn>)> {
        let modular = Making::<Drawn>::of(variables, equations, modular_effort, None)?;
        let course = modular.course.clone();
        let modular = modular.finished(variables)?;
        if modular.dimension() > Some(0) {
            return Some((None, modular));
        }
        let making = Making::<Integer>::of(variables, equations, effort, Some(&course));
        Some((making.and_then(|making| making.finished(variables)), modular))
    }
}

/// Returns the variables of a monomial, a bit for each.
fn support(monomial: Monomial) -> u32 {
    (0..MOST_VARIABLES).filter(|k| monomial.exponent(*k) > 0).map(|k| 1 << k).sum()
}

impl<C: Coefficient> Making<C> {
    /// Returns the elements that the equations lead to, until a constant is among them. With the course of the same calculation modulo a
    /// prime, polynomials that vanished there are left out; `None` also where the two go apart.
    fn of(variables: usize, equations: &[Equation], effort: u64, known: Option<&Course>) -> Option<Self> {
        assert!(variables <= MOST_VARIABLES, "at most {MOST_VARIABLES} variables");
        let (elements, is_old, pairs, course) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut making = Self { elements, is_old, pairs, effort, course };
        let mut given: Vec<Polynomial<C>> = Vec::new();
        for equation in equations {
            given.extend(Polynomial::normalised(C::terms(equation.terms())?));
        }
        sort::by_key(&mut given, |p| (p.leading(), p.terms.len()));
        for polynomial in given {
            making.go_on(known, |_| Some(polynomial.terms.into_iter().collect()))?;
        }
        while let Some(pair) = making.next() {
            making.go_on(known, |making| making.difference(pair))?;
        }
        Some(making)
    }

    /// Takes the next polynomial in, unless it vanished in a known course.
    fn go_on(&mut self, known: Option<&Course>, work: impl FnOnce(&Self) -> Option<Work<C>>) -> Option<()> {
        // With a constant among its elements the ideal is everything.
        if self.course.last() == Some(&Some(Monomial::one())) {
            return Some(());
        }
        let known = known.map(|course| course.get(self.course.len()).copied());
        if let Some(known) = known
            && known?.is_none()
        {
            self.course.push(None);
            return Some(());
        }
        let work = work(self)?;
        let leading = self.admit(work)?;
        self.course.push(leading);
        known.is_none_or(|known| known == Some(leading)).then_some(())
    }

    /// Returns the elements by which everything is reduced.
    fn reducers(&self) -> Vec<&Polynomial<C>> {
        self.elements.iter().zip(&self.is_old).filter(|(_, old)| !**old).map(|(p, _)| p).collect()
    }

    /// Returns the pair whose cancelled monomial is least.
    fn next(&mut self) -> Option<Pair> {
        let least = (0..self.pairs.len()).min_by_key(|k| self.pairs[*k].multiple)?;
        Some(self.pairs.swap_remove(least))
    }

    /// Returns the combination of two elements in which their leading terms cancel.
    fn difference(&self, pair: Pair) -> Option<Work<C>> {
        let (p, q) = (&self.elements[pair.first], &self.elements[pair.second]);
        let (a, b) = p.coefficient().ratio(q.coefficient());
        let mut minus = C::nothing();
        minus.subtract_product(&b, &C::unit());
        let mut work = Work::new();
        subtract(&mut work, &minus, pair.multiple.over(p.leading()), p)?;
        subtract(&mut work, &a, pair.multiple.over(q.leading()), q)?;
        Some(work)
    }

    /// Reduces a polynomial, adds the remainder as an element and returns its leading monomial, if it is not 0; the outer `None` if a
    /// degree is too large.
    #[expect(clippy::option_option, reason = "whether it went well, and what remains")]
    fn admit(&mut self, work: Work<C>) -> Option<Option<Monomial>> {
        let mut effort = self.effort;
        let rest = remainder(work, &self.reducers(), &mut C::unit(), &mut effort)?;
        self.effort = effort;
        let Some(element) = Polynomial::normalised(rest) else { return Some(None) };
        let leading = element.leading();
        self.update_pairs(leading)?;
        for (other, old) in self.elements.iter().zip(&mut self.is_old) {
            *old |= leading.divides(other.leading());
        }
        self.elements.push(element);
        self.is_old.push(false);
        Some(Some(leading))
    }

    /// Adds the pairs of a new element that others do not make redundant, and drops old pairs that it makes redundant.
    fn update_pairs(&mut self, leading: Monomial) -> Option<()> {
        let second = self.elements.len();
        let multiple = |k: usize| self.elements[k].leading().common_multiple(leading);
        let multiples: Option<Vec<Monomial>> = (0..second).map(multiple).collect();
        let multiples = multiples?;
        self.pairs.retain(|pair| {
            !leading.divides(pair.multiple)
                || multiples[pair.first] == pair.multiple
                || multiples[pair.second] == pair.multiple
        });
        let is_coprime = |k: usize| self.elements[k].leading().is_coprime_to(leading);
        let mut fresh: Vec<Pair> = Vec::new();
        for first in (0..second).filter(|k| !self.is_old[*k]) {
            let own = multiples[first];
            let is_covered = (0..second).filter(|k| *k != first && !self.is_old[*k]).any(|k| {
                let other = multiples[k];
                other.divides(own) && (other != own || is_coprime(k) || (k < first && !is_coprime(first)))
            });
            if !is_covered && !is_coprime(first) {
                fresh.push(Pair { first, second, multiple: own });
            }
        }
        self.pairs.extend(fresh);
        Some(())
    }

    /// Returns the reduced basis.
    fn finished(self, variables: usize) -> Option<Basis<C>> {
        let mut effort = self.effort;
        let mut minimal: Vec<Polynomial<C>> =
            self.elements.into_iter().zip(self.is_old).filter(|(_, old)| !old).map(|(p, _)| p).collect();
        sort::by_key(&mut minimal, Polynomial::leading);
        let mut elements: Vec<Polynomial<C>> = Vec::new();
        for polynomial in minimal {
            let below: Vec<&Polynomial<C>> = elements.iter().collect();
            let mut scale = C::unit();
            let mut tail: Work<C> = polynomial.terms.iter().skip(1).cloned().collect();
            tail = remainder(tail, &below, &mut scale, &mut effort)?;
            let mut leading = polynomial.coefficient().clone();
            leading.scale(&scale);
            tail.insert(polynomial.leading(), leading);
            elements.extend(Polynomial::normalised(tail));
        }
        Some(Basis { variables, elements })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawn::Drawn;
    use crate::ring::Ring;

    fn x(k: usize) -> Equation {
        Equation::variable(k)
    }

    fn number(n: i32) -> Equation {
        Equation::from_integer(n)
    }

    fn basis(variables: usize, equations: &[Equation]) -> Basis {
        Basis::of(variables, equations, 100_000).unwrap()
    }

    /// Two quadrics in general position: four points over the rationals and modulo a prime.
    #[test]
    fn counts_over_the_rationals_and_modulo_a_prime_agree() {
        let square = |k: usize| x(k).mul(&x(k));
        let conics = [
            square(0).add(&square(1).mul(&number(3))).sub(&x(0).mul(&x(1))).sub(&number(7)),
            square(0).mul(&number(2)).sub(&square(1)).add(&x(0)).sub(&number(1)),
        ];
        assert_eq!(basis(2, &conics).count(8), Some(4));
        assert_eq!(basis(2, &conics).count(3), None);
        let modular = Basis::<Drawn>::of(2, &conics, 100_000).unwrap();
        assert_eq!((modular.dimension(), modular.count(8)), (Some(0), Some(4)));
    }

    /// What the zeros modulo a prime leave out of the work over the rationals changes nothing here.
    #[test]
    fn elements_that_span_are_the_basis() {
        let (a, b, c) = (x(0), x(1), x(2));
        let system = |last: &Equation| {
            let sphere = a.mul(&a).add(&b.mul(&b)).add(&c.mul(&c)).sub(&number(9));
            let saddle = a.mul(&b).sub(&c.mul(&number(2)));
            [sphere, saddle, last.clone()]
        };
        for (last, dimension, count) in [
            (a.add(&b).add(&c).sub(&number(5)), Some(0), Some(4)),
            (number(7), None, Some(0)),
            (a.mul(&b).sub(&c.mul(&number(2))), Some(1), None),
        ] {
            let (found, modular) = Basis::spanning(3, &system(&last), 100_000, 100_000).unwrap();
            assert_eq!((modular.dimension(), modular.count(8)), (dimension, count));
            let Some(count) = count else {
                assert!(found.is_none());
                continue;
            };
            let found = found.unwrap();
            assert_eq!(found.elements, basis(3, &system(&last)).elements);
            assert_eq!((found.dimension(), found.count(8)), (dimension, Some(count)));
        }
        assert!(Basis::spanning(3, &system(&number(7)), 0, 0).is_some());
        assert!(Basis::spanning(3, &system(&a), 100_000, 0).unwrap().0.is_none());
    }

    /// The cyclic 4-roots form curves.
    #[test]
    fn dimensions_are_those_of_the_sets() {
        let (a, b, c, d) = (x(0), x(1), x(2), x(3));
        let pairs = a.mul(&b).add(&b.mul(&c)).add(&c.mul(&d)).add(&d.mul(&a));
        let triples = a.mul(&b).mul(&c).add(&b.mul(&c).mul(&d)).add(&c.mul(&d).mul(&a)).add(&d.mul(&a).mul(&b));
        let cyclic = [a.add(&b).add(&c).add(&d), pairs, triples, a.mul(&b).mul(&c).mul(&d).sub(&number(1))];
        assert_eq!(basis(4, &cyclic).dimension(), Some(1));
        assert_eq!(basis(2, &[x(0).mul(&x(1)).sub(&number(1)), x(0)]).dimension(), None);
        assert_eq!(basis(3, &[x(0).mul(&x(1)), x(0).mul(&x(2))]).dimension(), Some(2));
        assert_eq!(basis(2, &[x(0).mul(&x(0)).sub(&x(1)), x(1).sub(&number(2))]).dimension(), Some(0));
    }
}
