//! Replaces the symbols that relations determine in an ansatz, and adds relations to one.

use super::{Ansatz, Meaning, Relation, SymbolicJoint, Symbols, Twist};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::trigonometric::{Pair, reduce};
use rug::Rational;

/// An ansatz without relations that has the same members.
#[derive(Clone, Debug)]
pub struct Replaced {
    /// The ansatz in the symbols that were free.
    pub ansatz: Ansatz,
    /// Every variable of the old symbols in the new ones, as far as it can occur.
    substitution: Vec<(usize, Polynomial<Rational>)>,
}

impl Replaced {
    /// Converts a polynomial of the old symbols to the new ones.
    #[must_use]
    pub fn polynomial(&self, polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
        let symbols = &self.ansatz.symbols;
        let pair = |k| Pair { cos: Symbols::cos(k), sin: Symbols::sin(k) };
        let pairs: Vec<Pair> = (0..symbols.angles.len()).map(pair).collect();
        reduce(&polynomial.substitute_all(&self.substitution), &pairs)
    }
}

impl Ansatz {
    /// Returns the same loop with further relations, and with other symbols for which conditions are sought; `None` if the
    /// relations contradict one another.
    #[must_use]
    pub fn satisfying(&self, relations: Vec<Meaning>, unknown: Vec<usize>, unknown_angles: Vec<usize>) -> Option<Self> {
        let mut ansatz = Self { unknown, unknown_angles, ..self.clone() };
        let further = relations.into_iter().map(|meaning| Relation { text: String::new(), line: 0, meaning });
        ansatz.relations.extend(further);
        ansatz.resolve().ok()?;
        Some(ansatz)
    }

    /// Returns the loop without one of its relations, given by number; `None` if that is no relation between lengths.
    #[must_use]
    pub fn without_relation(&self, number: usize) -> Option<(Self, Polynomial<Rational>)> {
        let Meaning::Polynomial(relation) = self.relations.get(number)?.meaning.clone() else { return None };
        let mut ansatz = self.clone();
        ansatz.relations.remove(number);
        ansatz.resolve().ok()?;
        Some((ansatz, relation))
    }

    /// Returns the symbols determined by relations, cosine and sine of angles and lengths, as polynomials in the others. A
    /// length is included only if its coefficient in the relation is a number.
    pub(super) fn replacements(&self) -> Vec<(usize, Polynomial<Rational>)> {
        let free: Vec<_> = (0..self.symbols.angles.len())
            .map(|k| (Polynomial::variable(Symbols::cos(k)), Polynomial::variable(Symbols::sin(k))))
            .collect();
        let mut list = Vec::new();
        for (k, angle) in self.angles.iter().enumerate().filter(|(k, _)| !self.free_angles.contains(k)) {
            if let Some((cos, sin)) = angle.cos_sin(&free) {
                list.extend([(Symbols::cos(k), cos), (Symbols::sin(k), sin)]);
            }
        }
        for relation in self.polynomials().filter(|relation| self.is_linear(relation)) {
            let rest = relation.substitute_all(&list);
            let solved = self.given_lengths.iter().find_map(|&k| {
                let variable = self.symbols.length(k);
                let slope = rest.derivative(variable).to_constant()?.inverse()?;
                Some((variable, rest.substitute(variable, &Polynomial::zero()).scale(&slope.neg())))
            });
            if let Some(solved) = solved {
                for (_, value) in &mut list {
                    *value = value.substitute(solved.0, &solved.1);
                }
                list.push(solved);
            }
        }
        list
    }

    /// Returns the ansatz in its free symbols alone; `None` if some relation is no replacement of a symbol, or if the
    /// half-angle tangent of a replaced angle occurs.
    #[must_use]
    pub fn without_relations(&self) -> Option<Replaced> {
        if self.has_solved_symbols() {
            return None;
        }
        let list = self.replacements();
        let is_replaced = |variable: usize| list.iter().any(|(other, _)| *other == variable);
        if self.given_lengths.iter().any(|&k| !is_replaced(self.symbols.length(k))) {
            return None;
        }
        let lengths = self.free_lengths();
        let names = |list: &[String], kept: &[usize]| kept.iter().map(|&k| list[k].clone()).collect::<Vec<_>>();
        let symbols =
            Symbols::new(names(&self.symbols.angles, &self.free_angles), names(&self.symbols.lengths, &lengths));
        let symbols = symbols.ok()?;
        // The new index of each variable that is kept.
        let mut kept: Vec<(usize, usize)> = Vec::new();
        for (new, &old) in self.free_angles.iter().enumerate() {
            let functions = [Symbols::cos, Symbols::sin, Symbols::tan_half];
            kept.extend(functions.map(|function| (function(old), function(new))));
        }
        kept.extend(lengths.iter().enumerate().map(|(new, &old)| (self.symbols.length(old), symbols.length(new))));
        let moved: Vec<(usize, Polynomial<Rational>)> =
            kept.iter().map(|&(old, new)| (old, Polynomial::variable(new))).collect();
        let mut substitution = moved.clone();
        substitution.extend(list.iter().map(|(variable, value)| (*variable, value.substitute_all(&moved))));
        let known = |variable: usize| substitution.iter().any(|(other, _)| *other == variable);
        let used = self.joints.iter().flat_map(|joint| [&joint.a, &joint.d]).chain(self.polynomials());
        for polynomial in used {
            if (0..polynomial.variables()).any(|k| polynomial.degree(k) > 0 && !known(k)) {
                return None;
            }
        }
        let twist = |angle: &Twist| {
            let angle = angle.in_terms_of(&self.angles);
            let multiples = self.free_angles.iter().map(|&k| angle.multiples[k]).collect();
            Twist { multiples, constant: angle.constant }
        };
        let places = |unknown: &[usize], kept: &[usize]| -> Option<Vec<usize>> {
            unknown.iter().map(|k| kept.iter().position(|other| other == k)).collect()
        };
        let general = Self::general(0);
        let mut replaced = Replaced {
            ansatz: Self {
                name: self.name.clone(),
                title: self.title.clone(),
                angles: (0..symbols.angles.len()).map(|k| Twist::symbol(k, symbols.angles.len())).collect(),
                free_angles: (0..symbols.angles.len()).collect(),
                unknown: places(&self.unknown, &lengths)?,
                unknown_angles: places(&self.unknown_angles, &self.free_angles)?,
                rounded: self.rounded,
                symbols,
                ..general
            },
            substitution,
        };
        let joints = self.joints.iter().map(|joint| SymbolicJoint {
            a: replaced.polynomial(&joint.a),
            alpha: twist(&joint.alpha),
            d: replaced.polynomial(&joint.d),
        });
        let joints = joints.collect();
        let all_hold = self.polynomials().all(|relation| replaced.polynomial(relation).is_zero());
        replaced.ansatz.joints = joints;
        all_hold.then_some(replaced)
    }
}
