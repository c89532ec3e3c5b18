//! Members of the family that an ansatz describes, over any field.

use super::{Ansatz, Symbols, Twist};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Field;

/// The parameters of one joint and the link behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Link<F> {
    /// The cosine of the twist.
    pub cos: F,
    /// Its sine.
    pub sin: F,
    /// The length of the link.
    pub a: F,
    /// The offset of the joint.
    pub d: F,
}

/// An ansatz over a field, ready for values of its free symbols.
pub struct Members<'a, F> {
    ansatz: &'a Ansatz,
    /// Length and offset of every joint.
    joints: Vec<[Polynomial<F>; 2]>,
    /// The relations that are linear in the lengths.
    relations: Vec<Polynomial<F>>,
    /// Those that are not, which hold or do not.
    others: Vec<Polynomial<F>>,
}

impl Ansatz {
    /// The ansatz over a field; `None` for an unlucky prime.
    #[must_use]
    pub fn over<F: Field>(&self) -> Option<Members<'_, F>> {
        let image = |p: &Polynomial<rug::Rational>| p.map(F::from_rational);
        let joints =
            self.joints.iter().map(|joint| Some([image(&joint.a)?, image(&joint.d)?])).collect::<Option<_>>()?;
        let (linear, others): (Vec<_>, Vec<_>) = self.polynomials().partition(|polynomial| self.is_linear(polynomial));
        let relations = linear.into_iter().map(image).collect::<Option<_>>()?;
        let others = others.into_iter().map(image).collect::<Option<_>>()?;
        Some(Members { ansatz: self, joints, relations, others })
    }
}

impl<F: Field> Members<'_, F> {
    /// The member of the family with these half-angle tangents of the free angles and these free lengths, in the order of
    /// [`Ansatz::free_angles`] and [`Ansatz::free_lengths`]; `None` where the relations cannot be solved for the other
    /// lengths, or are not satisfied.
    ///
    /// # Panics
    /// When the number of values is wrong.
    #[must_use]
    pub fn member(&self, tangents: &[F], lengths: &[F]) -> Option<Vec<Link<F>>> {
        self.links(&self.values(tangents, lengths)?)
    }

    /// The same member, and the values of all relations that give no length: where they vanish, it is one.
    ///
    /// # Panics
    /// When the number of values is wrong.
    #[must_use]
    pub fn with_residuals(&self, tangents: &[F], lengths: &[F]) -> Option<(Vec<Link<F>>, Vec<F>)> {
        let (values, residuals) = self.solved(tangents, lengths)?;
        Some((self.links(&values)?, residuals))
    }

    /// The values of all variables of [`Symbols`] for that member; `None` as for [`Self::member`].
    ///
    /// # Panics
    /// When the number of values is wrong.
    #[must_use]
    pub fn values(&self, tangents: &[F], lengths: &[F]) -> Option<Vec<F>> {
        let (values, residuals) = self.solved(tangents, lengths)?;
        residuals.iter().all(F::is_zero).then_some(values)
    }

    /// The loop for given values of all variables; `None` for an unlucky prime.
    #[must_use]
    pub fn links(&self, values: &[F]) -> Option<Vec<Link<F>>> {
        let angle = |k: usize| (values[Symbols::cos(k)].clone(), values[Symbols::sin(k)].clone());
        let angles: Vec<(F, F)> = (0..self.ansatz.symbols.angles.len()).map(angle).collect();
        let links = self.joints.iter().enumerate().map(|(k, [a, d])| {
            let (cos, sin) = self.ansatz.joints[k].alpha.cos_sin(&angles)?;
            Some(Link { cos, sin, a: a.evaluate(values), d: d.evaluate(values) })
        });
        links.collect()
    }

    /// The values of all variables, and what is left of the relations that give no length.
    fn solved(&self, tangents: &[F], lengths: &[F]) -> Option<(Vec<F>, Vec<F>)> {
        let (symbols, free) = (&self.ansatz.symbols, self.ansatz.free_lengths());
        assert_eq!(tangents.len(), self.ansatz.free_angles.len(), "one tangent for every free angle");
        assert_eq!(lengths.len(), free.len(), "one value for every free length");
        let mut known = vec![(F::one(), F::zero()); symbols.angles.len()];
        for (&angle, t) in self.ansatz.free_angles.iter().zip(tangents) {
            let square = t.mul(t);
            let inverse = F::one().add(&square).inverse()?;
            known[angle] = (F::one().sub(&square).mul(&inverse), t.add(t).mul(&inverse));
        }
        let angles: Vec<(F, F)> =
            self.ansatz.angles.iter().map(|angle: &Twist| angle.cos_sin(&known)).collect::<Option<_>>()?;
        let mut values = vec![F::zero(); symbols.names().list().len()];
        for (k, (cos, sin)) in angles.iter().enumerate() {
            values[Symbols::cos(k)] = cos.clone();
            values[Symbols::sin(k)] = sin.clone();
            // At pi there is no tangent; an ansatz that uses it is not for that angle.
            values[Symbols::tan_half(k)] = match F::one().add(cos).inverse() {
                Some(inverse) => sin.mul(&inverse),
                None if self.uses(Symbols::tan_half(k)) => return None,
                None => F::zero(),
            };
        }
        for (&length, value) in free.iter().zip(lengths) {
            values[symbols.length(length)] = value.clone();
        }
        let residuals = self.solve(&mut values)?;
        Some((values, residuals))
    }

    fn uses(&self, variable: usize) -> bool {
        self.joints.iter().flatten().chain(&self.relations).chain(&self.others).any(|p| p.degree(variable) > 0)
    }

    /// Solves the relations for the lengths that they give; what is left of the others.
    fn solve(&self, values: &mut [F]) -> Option<Vec<F>> {
        let given: Vec<usize> = self.ansatz.given_lengths.iter().map(|&k| self.ansatz.symbols.length(k)).collect();
        // Each relation is linear in the lengths that relations give: its value with all of them 0 or one of them 1.
        let mut rows: Vec<Vec<F>> = Vec::new();
        for relation in &self.relations {
            let constant = relation.evaluate(values);
            let mut row = Vec::with_capacity(given.len() + 1);
            for &variable in &given {
                values[variable] = F::one();
                row.push(relation.evaluate(values).sub(&constant));
                values[variable] = F::zero();
            }
            row.push(constant.neg());
            rows.push(row);
        }
        for column in 0..given.len() {
            let pivot = (column..rows.len())
                .max_by(|&i, &j| rows[i][column].pivot_size().total_cmp(&rows[j][column].pivot_size()))?;
            rows.swap(column, pivot);
            let inverse = rows[column][column].inverse()?;
            let row: Vec<F> = rows[column].iter().map(|x| x.mul(&inverse)).collect();
            for (_, other) in rows.iter_mut().enumerate().filter(|(k, _)| *k != column) {
                let factor = other[column].clone();
                for (x, y) in other.iter_mut().zip(&row) {
                    *x = x.sub(&factor.mul(y));
                }
            }
            rows[column] = row;
        }
        for (row, &variable) in rows.iter().zip(&given) {
            values[variable] = row[given.len()].clone();
        }
        let rest = rows[given.len()..].iter().map(|row| row[given.len()].clone());
        Some(rest.chain(self.others.iter().map(|other| other.evaluate(values))).collect())
    }
}
