//! Cycles between products of powers of rotations as a system over the rationals, without the rotations that occur linearly.
//!
//! A rotation u that stands in the cycles as such only, times numbers, is a sum of other terms there, as the cycles are linear in it. What
//! remains of it is that its length is 1: `u u' = 1`, where products of terms and conjugate ones have differences of exponents. So the
//! powers of the rotations that remain are no higher than before, and fewer unknowns have a far smaller Gröbner basis.

use super::equations::Equations;
use super::gears::{Power, Torus};
use super::isotropic::Isotropic;
use super::real_system::{Form, RealSystem, circles, constant, turned, way};
use crate::algebra::echelon::Echelon;
use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use rug::Rational;

/// What a number of a cycle is multiplied by: powers of the unknown rotations, and the displacement along a slide.
type Kind = (Vec<i32>, Option<usize>);
/// A sum of kinds times numbers.
type Sum = Vec<(Gaussian, Kind)>;

/// Cycles and what remains of meshes, in the rotations that remain.
pub(super) struct TurnSystem {
    /// The rotations that remain, by their numbers in the torus, and those that are sums of others.
    kept: Vec<usize>,
    held: Vec<(usize, Sum)>,
    /// Sums that vanish.
    sums: Vec<Sum>,
    /// The rotation of every class: a number and exponents of all rotations.
    turns: Vec<(Gaussian, Vec<i32>)>,
    /// What remains of the meshes, each of which is 1.
    rest: Vec<(Gaussian, Vec<i32>)>,
    slides: usize,
}

impl TurnSystem {
    /// Solves cycles for rotations that occur linearly; `None` for numbers that are not rational.
    pub fn of(torus: &Torus, cycles: &Equations<Isotropic<Gaussian>>) -> Option<Self> {
        let exact = |list: &[Power]| -> Option<Vec<(Gaussian, Vec<i32>)>> {
            list.iter().map(|power| Some((power.number()?, power.exponents.clone()))).collect()
        };
        let (turns, rest) = (exact(&torus.turns)?, exact(&torus.rest)?);
        let sliding = |class: usize| cycles.slides.iter().any(|slide| slide.class == class);
        let unit = |place: usize| -> Vec<i32> { (0..torus.unknowns).map(|k| i32::from(k == place)).collect() };
        let is_linear = |place: &usize| {
            let own = unit(*place);
            let is_own = |(class, (_, exponents)): (usize, &(Gaussian, Vec<i32>))| {
                exponents[*place] == 0 || (*exponents == own && !sliding(class))
            };
            turns.iter().enumerate().all(is_own) && rest.iter().all(|(_, exponents)| exponents[*place] == 0)
        };
        let linear: Vec<usize> = (0..torus.unknowns).filter(is_linear).collect();
        let mut kinds: Vec<Kind> = linear.iter().map(|place| (unit(*place), None)).collect();
        let mut rows: Vec<Vec<Gaussian>> = Vec::new();
        for (k, cycle) in cycles.cycles.iter().enumerate() {
            let links = cycle.iter().enumerate().map(|(class, c)| (&c.z, class, None));
            let slides = cycles.slides.iter().enumerate();
            let slides = slides.map(|(slide, one)| (&one.coefficients[k].z, one.class, Some(slide)));
            let mut row = vec![Gaussian::zero(); kinds.len()];
            for (c, class, slide) in links.chain(slides).filter(|(c, ..)| !Ring::is_zero(*c)) {
                let (factor, exponents) = &turns[class];
                let kind = (exponents.clone(), slide);
                let place = kinds.iter().position(|own| *own == kind).unwrap_or_else(|| {
                    kinds.push(kind);
                    kinds.len() - 1
                });
                row.resize(kinds.len(), Gaussian::zero());
                row[place] = row[place].add(&c.mul(factor));
            }
            rows.push(row);
        }
        for row in &mut rows {
            row.resize(kinds.len(), Gaussian::zero());
        }
        let solved = Echelon::of(rows, kinds.len());
        let (mut held, mut sums) = (Vec::new(), Vec::new());
        for (row, pivot) in solved.rows().iter().zip(solved.pivots()) {
            let terms = row.iter().zip(&kinds).filter(|(c, _)| !Ring::is_zero(*c));
            match linear.get(*pivot) {
                Some(place) => {
                    let others = terms.filter(|(_, kind)| *kind != &kinds[*pivot]);
                    held.push((*place, others.map(|(c, kind)| (c.neg(), kind.clone())).collect()));
                }
                None => sums.push(terms.map(|(c, kind)| (c.clone(), kind.clone())).collect()),
            }
        }
        let kept = (0..torus.unknowns).filter(|place| held.iter().all(|(own, _)| own != place)).collect();
        Some(Self { kept, held, sums, turns, rest, slides: cycles.slides.len() })
    }

    /// A number times powers of rotations that remain and a displacement.
    fn form(&self, factor: &Gaussian, (exponents, slide): &Kind) -> Form {
        let powers = self.kept.iter().enumerate().map(|(k, place)| turned(k + 1, exponents[*place]));
        let product = powers.fold(constant(factor), |product, power| product.mul(&power));
        slide.map_or(product.clone(), |slide| product.mul(&way(self.kept.len() + 1, slide)))
    }

    fn sum(&self, sum: &Sum) -> Form {
        sum.iter().fold(Form::zero(), |all, (c, kind)| all.add(&self.form(c, kind)))
    }

    /// The square of the length of a sum, less 1.
    fn circle(&self, sum: &Sum) -> Equation {
        let mut square = Equation::one().neg();
        for (c, (exponents, slide)) in sum {
            for (d, (others, other)) in sum {
                // The second conjugate: with the terms exchanged the product is the conjugate one.
                let factor = c.mul(&Gaussian { re: d.re.clone(), im: Rational::from(-&d.im) });
                let difference = exponents.iter().zip(others).map(|(x, y)| x - y).collect();
                let mut product = self.form(&factor, &(difference, *slide)).re;
                if let Some(other) = other {
                    product = product.mul(&way(self.kept.len() + 1, *other).re);
                }
                square = square.add(&product);
            }
        }
        square
    }

    /// The polynomials that vanish: both parts of every cycle and of what remains of the meshes, and the circles of all rotations; `None`
    /// for more unknowns than a basis may have.
    pub fn real(&self) -> Option<RealSystem> {
        let unknowns = 2 * self.kept.len() + self.slides;
        if unknowns > MOST_VARIABLES {
            return None;
        }
        let mut list = Vec::new();
        for sum in self.sums.iter().map(|sum| self.sum(sum)) {
            list.extend([sum.re, sum.im]);
        }
        for (factor, exponents) in &self.rest {
            let side = |sign: i32| -> Kind { (exponents.iter().map(|x| (x * sign).max(0)).collect(), None) };
            let difference = self.form(factor, &side(1)).sub(&self.form(&Gaussian::one(), &side(-1)));
            list.extend([difference.re, difference.im]);
        }
        list.extend(self.held.iter().map(|(_, sum)| self.circle(sum)));
        list.extend(circles(self.kept.len() + 1));
        list.retain(|equation| !equation.is_zero());
        let turn = |(factor, exponents): &(Gaussian, Vec<i32>)| {
            let held = self.held.iter().find(|(place, _)| exponents[*place] != 0);
            held.map_or_else(
                || self.form(factor, &(exponents.clone(), None)),
                |(_, sum)| constant(factor).mul(&self.sum(sum)),
            )
        };
        let shifts = (0..self.slides).map(|slide| way(self.kept.len() + 1, slide).re);
        Some(RealSystem {
            unknowns,
            turns: self.turns.iter().map(turn).collect(),
            shifts: shifts.collect(),
            equations: list,
            squares: vec![Rational::from(1); self.turns.len()],
            spinning: Vec::new(),
        })
    }
}
