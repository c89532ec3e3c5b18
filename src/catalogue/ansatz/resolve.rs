//! Solves the relations: finds the symbols that they determine, contradictions between them, and relations without real
//! solutions.

use super::{Ansatz, Meaning, Relation, Solved, Symbols, Twist};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::scope::Scope;
use crate::error::{Error, Result};
use rug::Rational;

/// Half-angle tangents at which the linear system for the lengths is examined; any set that is not special would do.
const TANGENTS: [[i32; 2]; 12] = [
    [3, 7],
    [5, 13],
    [11, 17],
    [19, 23],
    [7, 29],
    [31, 37],
    [13, 41],
    [43, 47],
    [17, 53],
    [59, 61],
    [23, 67],
    [71, 73],
];

impl Ansatz {
    /// Returns the polynomials of the relations about lengths, or about functions of angles.
    pub(super) fn polynomials(&self) -> impl Iterator<Item = &Polynomial<Rational>> {
        self.relations.iter().filter_map(|relation| match &relation.meaning {
            Meaning::Polynomial(polynomial) => Some(polynomial),
            Meaning::Angle(_) => None,
        })
    }

    /// Returns whether a relation is linear in the lengths.
    pub(super) fn is_linear(&self, relation: &Polynomial<Rational>) -> bool {
        let lengths = 3 * self.symbols.angles.len();
        relation.terms().all(|(exponents, _)| exponents.iter().skip(lengths).sum::<u32>() <= 1)
    }

    /// Solves the relations for as many symbols as they determine.
    ///
    /// # Errors
    /// The line, and the relation it contradicts or the reason why it cannot be solved.
    pub(super) fn resolve(&mut self) -> std::result::Result<(), (usize, Error)> {
        self.resolve_angles()?;
        self.resolve_others();
        self.resolve_lengths()?;
        self.contradiction()?;
        self.empty = self.relations.iter().find_map(|relation| relation.without_real_solution(self));
        Ok(())
    }

    /// Refuses a relation of higher degree that becomes a nonzero number when the others are substituted.
    fn contradiction(&self) -> std::result::Result<(), (usize, Error)> {
        let list = self.replacements();
        for relation in &self.relations {
            let Meaning::Polynomial(polynomial) = &relation.meaning else { continue };
            if polynomial.substitute_all(&list).to_constant().is_some_and(|constant| !constant.is_zero()) {
                let message = format!("found `{}`, which contradicts the other relations", relation.text);
                return Err((relation.line, Error::Invalid(message)));
            }
        }
        Ok(())
    }

    fn resolve_angles(&mut self) -> std::result::Result<(), (usize, Error)> {
        let count = self.symbols.angles.len();
        self.given_lengths.clear();
        self.angles = (0..count).map(|k| Twist::symbol(k, count)).collect();
        let mut given = Vec::new();
        for relation in &self.relations {
            let Meaning::Angle(angle) = &relation.meaning else { continue };
            let rest = angle.in_terms_of(&self.angles);
            if rest.is_constant() {
                if rest.constant != (Rational::from(1), Rational::new()) {
                    let message = format!("found `{}`, which contradicts the relations before it", relation.text);
                    return Err((relation.line, Error::Invalid(message)));
                }
                continue;
            }
            // The first symbol in the relation; a unit before it is skipped.
            let place = |k: &usize| {
                let is_unknown = self.unknown_angles.contains(k);
                (is_unknown, relation.text.find(&self.symbols.angles[*k]).unwrap_or(usize::MAX))
            };
            let pivot = (0..count).filter(|&k| rest.multiples[k].abs() == 1).min_by_key(place);
            let Some(pivot) = pivot else {
                let message = format!(
                    "`{}` is an equation for multiples of angles with several solutions: write one of these",
                    relation.text
                );
                return Err((relation.line, Error::Unsupported(message)));
            };
            if self.unknown_angles.contains(&pivot) {
                return Err((relation.line, gives_unknown(relation, &self.symbols.angles[pivot])));
            }
            let sign = -rest.multiples[pivot];
            let mut value = Twist::sum([(sign, &rest)], count);
            value.multiples[pivot] = 0;
            let mut replacement: Vec<Twist> = (0..count).map(|k| Twist::symbol(k, count)).collect();
            replacement[pivot] = value;
            for angle in &mut self.angles {
                *angle = angle.in_terms_of(&replacement);
            }
            given.push(pivot);
        }
        self.free_angles = (0..count).filter(|k| !given.contains(k)).collect();
        Ok(())
    }

    /// Chooses a symbol for each relation that is not linear in lengths: the first named one that is in no earlier relation
    /// and occurs to the first power.
    fn resolve_others(&mut self) {
        self.solved.clear();
        // For four joints, relations are conditions beside those that are derived.
        if self.joints.len() < 5 {
            return;
        }
        let (angles, lengths) = (self.symbols.angles.len(), self.symbols.lengths.len());
        let others: Vec<(String, Polynomial<Rational>)> = self
            .relations
            .iter()
            .filter_map(|relation| match &relation.meaning {
                Meaning::Polynomial(polynomial) if !self.is_linear(polynomial) || !self.has_length(polynomial) => {
                    Some((relation.text.clone(), polynomial.clone()))
                }
                _ => None,
            })
            .collect();
        // Symbols of earlier relations need a value there.
        let mut known = vec![false; angles + lengths];
        let (mut of_angles, mut of_lengths) = (Vec::new(), Vec::new());
        for (text, polynomial) in others {
            let uses = |k: usize| match k.checked_sub(angles) {
                None => self.depends(&polynomial, k),
                Some(length) => polynomial.degree(self.symbols.length(length)) > 0,
            };
            let is_candidate = |k: &usize| match k.checked_sub(angles) {
                None => {
                    !self.has_length(&polynomial)
                        && self.free_angles.contains(k)
                        && !self.unknown_angles.contains(k)
                        && self.is_of_first_power(&polynomial, *k)
                }
                Some(length) => {
                    let is_in = |linear: &Polynomial<Rational>| linear.degree(self.symbols.length(length)) > 0;
                    let mut linear = self.polynomials().filter(|p| self.is_linear(p) && self.has_length(p));
                    polynomial.degree(self.symbols.length(length)) == 1
                        && !self.unknown.contains(&length)
                        && !linear.any(is_in)
                }
            };
            let place = |k: &usize| {
                let name = k.checked_sub(angles).map_or_else(|| &self.symbols.angles[*k], |l| &self.symbols.lengths[l]);
                text.find(name.as_str()).unwrap_or(usize::MAX)
            };
            let chosen = (0..angles + lengths).filter(|k| !known[*k]).filter(is_candidate).min_by_key(place);
            for (k, known) in known.iter_mut().enumerate() {
                *known |= uses(k);
            }
            match chosen.map(|k| (k, k.checked_sub(angles))) {
                Some((k, None)) => of_angles.push(Solved::Angle(k, polynomial)),
                Some((_, Some(length))) => of_lengths.push(Solved::Length(length, polynomial)),
                None => {}
            }
        }
        let is_solved = |k: &usize| of_angles.iter().any(|solved| matches!(solved, Solved::Angle(j, _) if j == k));
        self.free_angles.retain(|k| !is_solved(k));
        self.solved = of_angles.into_iter().chain(of_lengths).collect();
    }

    fn has_length(&self, polynomial: &Polynomial<Rational>) -> bool {
        (0..self.symbols.lengths.len()).any(|k| polynomial.degree(self.symbols.length(k)) > 0)
    }

    /// Returns whether a polynomial contains functions of an angle, or of one that is a sum with it.
    fn depends(&self, polynomial: &Polynomial<Rational>, angle: usize) -> bool {
        (0..self.angles.len()).any(|k| self.angles[k].multiples[angle] != 0 && uses_angle(polynomial, k))
    }

    /// Returns whether a polynomial is linear in cosine and sine of an angle, or in its half-angle tangent, and contains no
    /// other angle that is a sum with it.
    fn is_of_first_power(&self, polynomial: &Polynomial<Rational>, angle: usize) -> bool {
        let others = (0..self.angles.len()).filter(|&k| k != angle);
        let is_alone = others.into_iter().all(|k| self.angles[k].multiples[angle] == 0 || !uses_angle(polynomial, k));
        let degrees = |exponents: &[u32]| {
            let at = |variable: usize| exponents.get(variable).copied().unwrap_or(0);
            (at(Symbols::cos(angle)) + at(Symbols::sin(angle)), at(Symbols::tan_half(angle)))
        };
        let all: Vec<(u32, u32)> = polynomial.terms().map(|(exponents, _)| degrees(&exponents)).collect();
        let (circle, tangent) = all.iter().fold((0, 0), |(c, t), (d, e)| (c.max(*d), t.max(*e)));
        is_alone && matches!((circle, tangent), (1, 0) | (0, 1))
    }

    /// Returns cosine, sine and half-angle tangent of all angles for a choice of the free ones.
    fn sample(&self, shift: usize) -> Vec<(usize, Polynomial<Rational>)> {
        let mut known = vec![(Rational::from(1), Rational::new()); self.symbols.angles.len()];
        // Symbols determined by relations take any values here: the pivots do not depend on them.
        let solved = self.solved.iter().filter_map(|solved| match solved {
            Solved::Angle(angle, _) => Some(angle),
            Solved::Length(..) => None,
        });
        for (n, &angle) in self.free_angles.iter().chain(solved).enumerate() {
            let [p, q] = TANGENTS[(n + shift) % TANGENTS.len()];
            let t = Rational::from((p + i32::try_from(n / TANGENTS.len()).unwrap_or(0), q));
            let square = Rational::from(t.square_ref());
            let norm = Rational::from(&square + 1);
            known[angle] = ((1 - square) / &norm, Rational::from(&t * 2) / &norm);
        }
        let mut values = Vec::new();
        for (k, angle) in self.angles.iter().enumerate() {
            let Some((cos, sin)) = angle.cos_sin(&known) else { continue };
            let tangent = Rational::from(&cos + 1).inverse().map(|inverse| Ring::mul(&inverse, &sin));
            values.push((Symbols::cos(k), Polynomial::constant(cos)));
            values.push((Symbols::sin(k), Polynomial::constant(sin)));
            values.push((Symbols::tan_half(k), Polynomial::constant(tangent.unwrap_or_default())));
        }
        values
    }

    fn resolve_lengths(&mut self) -> std::result::Result<(), (usize, Error)> {
        let count = self.symbols.lengths.len();
        let variable = |k: usize| self.symbols.length(k);
        let mut given: Option<Vec<usize>> = None;
        for shift in 0..2 {
            let values = self.sample(shift);
            let mut rows: Vec<(Vec<Rational>, &Relation)> = Vec::new();
            for relation in &self.relations {
                let Meaning::Polynomial(polynomial) = &relation.meaning else { continue };
                let at = polynomial.substitute_all(&values);
                // A relation of higher degree is a condition that members satisfy or not.
                if !self.is_linear(polynomial) {
                    continue;
                }
                let coefficient = |k: usize| at.derivative(variable(k)).to_constant().unwrap_or_default();
                let mut row: Vec<Rational> = (0..count).map(coefficient).collect();
                let zeros: Vec<_> = (0..count).map(|k| (variable(k), Polynomial::zero())).collect();
                row.push(at.substitute_all(&zeros).to_constant().unwrap_or_default());
                rows.push((row, relation));
            }
            let found = self.pivots(rows)?;
            if let Some(before) = given.take().filter(|before| *before != found) {
                // At a special point only the common part of both results is safe.
                given = Some(before.into_iter().filter(|k| found.contains(k)).collect());
            } else {
                given = Some(found);
            }
        }
        self.given_lengths = given.unwrap_or_default();
        self.given_lengths.sort_unstable();
        Ok(())
    }

    /// Returns the lengths that a linear system determines: the first of each relation, never one that is sought.
    fn pivots(&self, mut rows: Vec<(Vec<Rational>, &Relation)>) -> std::result::Result<Vec<usize>, (usize, Error)> {
        let count = self.symbols.lengths.len();
        let mut given = Vec::new();
        for index in 0..rows.len() {
            let (row, relation) = rows[index].clone();
            let place = |k: &usize| {
                let name = &self.symbols.lengths[*k];
                (self.unknown.contains(k), relation.text.find(name.as_str()).unwrap_or(usize::MAX))
            };
            let Some(pivot) = (0..count).filter(|&k| !Ring::is_zero(&row[k])).min_by_key(place) else {
                if Ring::is_zero(&row[count]) {
                    continue;
                }
                let is_decided = self.free_angles.is_empty() && self.solved.is_empty();
                if !relation_has_length(relation, &self.symbols) && !is_decided {
                    // A condition on angles only, which members satisfy or not.
                    continue;
                }
                let general = if self.polynomials().any(|p| (0..3 * self.symbols.angles.len()).any(|k| p.degree(k) > 0))
                {
                    " for general values of the angles: no lengths satisfy all of them"
                } else {
                    ""
                };
                let message = format!("found `{}`, which contradicts the relations before it{general}", relation.text);
                return Err((relation.line, Error::Invalid(message)));
            };
            if self.unknown.contains(&pivot) {
                return Err((relation.line, gives_unknown(relation, &self.symbols.lengths[pivot])));
            }
            let inverse = row[pivot].inverse().expect("a pivot is not zero");
            for (other, _) in &mut rows[index + 1..] {
                let factor = Ring::mul(&other[pivot], &inverse);
                for (x, y) in other.iter_mut().zip(&row) {
                    *x = Ring::sub(x, &Ring::mul(&factor, y));
                }
            }
            given.push(pivot);
        }
        Ok(given)
    }
}

/// Returns the error for a relation that gives a value to a symbol for which conditions are sought.
fn gives_unknown(relation: &Relation, name: &str) -> Error {
    Error::Invalid(format!(
        "found `{}`, which gives a value to `{name}`: it contradicts `unknown`, expected `{name}` to be free",
        relation.text
    ))
}

/// Returns whether a polynomial contains cosine, sine or half-angle tangent of an angle.
fn uses_angle(polynomial: &Polynomial<Rational>, angle: usize) -> bool {
    [Symbols::cos(angle), Symbols::sin(angle), Symbols::tan_half(angle)].into_iter().any(|k| polynomial.degree(k) > 0)
}

/// Returns whether a length occurs in the text of a relation.
fn relation_has_length(relation: &Relation, symbols: &Symbols) -> bool {
    let Meaning::Polynomial(polynomial) = &relation.meaning else { return false };
    (0..symbols.lengths.len()).any(|k| polynomial.degree(symbols.length(k)) > 0)
}

/// Reads the relation `left = right` (or `expression`, meant to vanish) between symbols.
pub(super) fn relation(text: &str, line: usize, symbols: &Symbols, scope: &Scope<'_>) -> Result<Relation> {
    use super::expression::{bare_words, polynomial, twist};
    let (left, right) = text.split_once('=').unwrap_or((text, "0"));
    if right.contains('=') || left.trim().is_empty() || right.trim().is_empty() {
        return Err(Error::Invalid(format!("found `{text}`, expected one equation `left = right`")));
    }
    let bare = bare_words(text)?;
    let is_angle = bare.iter().any(|word| symbols.angles.contains(word));
    if let (true, Some(length)) = (is_angle, bare.iter().find(|word| symbols.lengths.contains(word))) {
        return Err(Error::Invalid(format!(
            "found the length `{length}` in a relation of angles, expected cos(...), sin(...) or tan_half(...) of these"
        )));
    }
    let meaning = if is_angle {
        let (left, exact) = twist(left, symbols, &scope.reading)?;
        let (right, also) = twist(right, symbols, &scope.reading)?;
        scope.note(exact && also);
        Meaning::Angle(Twist::sum([(1, &left), (-1, &right)], symbols.angles.len()))
    } else {
        let column = left.chars().count() + 1;
        // Positions in the right side are counted from the beginning of the relation.
        let right = format!("{}{right}", " ".repeat(column));
        let difference = polynomial(left, symbols)?.sub(&polynomial(&right, symbols)?);
        if difference.is_zero() {
            return Err(Error::Invalid(format!("found `{text}`, which says nothing, expected a relation")));
        }
        if difference.to_constant().is_some() {
            return Err(Error::Invalid(format!("found `{text}`, which contradicts itself")));
        }
        Meaning::Polynomial(difference)
    };
    Ok(Relation { text: text.trim().to_owned(), line, meaning })
}
