//! Members of the family that an ansatz describes, over any field.

use super::{Ansatz, Solved, Symbols, Twist};
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
    /// Other relations that give no symbol; a member satisfies them or not.
    others: Vec<Polynomial<F>>,
    /// Symbols given by the other relations.
    solved: Vec<Given<F>>,
    /// The square root, if there is one.
    root: fn(&F) -> Option<F>,
}

/// A symbol that a relation gives.
enum Given<F> {
    Angle(usize, Polynomial<F>),
    Length(usize, Polynomial<F>),
}

impl Ansatz {
    /// Converts the ansatz to a field; `None` for an unlucky prime. Angles that need a square root have no value.
    #[must_use]
    pub fn over<F: Field>(&self) -> Option<Members<'_, F>> {
        self.with_roots(|_| None)
    }

    /// Converts the ansatz to a field with square roots; `None` for an unlucky prime.
    #[must_use]
    pub fn with_roots<F: Field>(&self, root: fn(&F) -> Option<F>) -> Option<Members<'_, F>> {
        let image = |p: &Polynomial<rug::Rational>| p.map(F::from_rational);
        let joints =
            self.joints.iter().map(|joint| Some([image(&joint.a)?, image(&joint.d)?])).collect::<Option<_>>()?;
        let of_solved = |solved: &Solved| match solved {
            Solved::Angle(_, polynomial) | Solved::Length(_, polynomial) => polynomial.clone(),
        };
        let used: Vec<_> = self.solved.iter().map(of_solved).collect();
        let unused = self.polynomials().filter(|polynomial| !used.contains(polynomial));
        let (linear, others): (Vec<_>, Vec<_>) = unused.partition(|polynomial| self.is_linear(polynomial));
        let relations = linear.into_iter().map(image).collect::<Option<_>>()?;
        let others = others.into_iter().map(image).collect::<Option<_>>()?;
        let given = |solved: &Solved| {
            Some(match solved {
                Solved::Angle(k, polynomial) => Given::Angle(*k, image(polynomial)?),
                Solved::Length(k, polynomial) => Given::Length(*k, image(polynomial)?),
            })
        };
        let solved = self.solved.iter().map(given).collect::<Option<_>>()?;
        Some(Members { ansatz: self, joints, relations, others, solved, root })
    }
}

impl<F: Field> Members<'_, F> {
    /// Returns the member of the family with these half-angle tangents of the free angles and these free lengths, in the order
    /// of [`Ansatz::free_angles`] and [`Ansatz::free_lengths`]; `None` if the relations cannot be solved for the other
    /// lengths, or are not satisfied.
    ///
    /// # Panics
    /// If the number of values is wrong.
    #[must_use]
    pub fn member(&self, tangents: &[F], lengths: &[F]) -> Option<Vec<Link<F>>> {
        self.links(&self.values(tangents, lengths)?)
    }

    /// Returns the same member, and the values of all relations that give no length, which vanish for a true member.
    ///
    /// # Panics
    /// If the number of values is wrong.
    #[must_use]
    pub fn with_residuals(&self, tangents: &[F], lengths: &[F]) -> Option<(Vec<Link<F>>, Vec<F>)> {
        let (values, residuals) = self.solved(tangents, lengths)?;
        Some((self.links(&values)?, residuals))
    }

    /// Returns the values of all variables of [`Symbols`] for that member; `None` as for [`Self::member`].
    ///
    /// # Panics
    /// If the number of values is wrong.
    #[must_use]
    pub fn values(&self, tangents: &[F], lengths: &[F]) -> Option<Vec<F>> {
        let (values, residuals) = self.solved(tangents, lengths)?;
        residuals.iter().all(F::is_zero).then_some(values)
    }

    /// Returns the loop for given values of all variables; `None` for an unlucky prime.
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

    /// Returns the values of all variables, and the residuals of the relations that give no symbol.
    fn solved(&self, tangents: &[F], lengths: &[F]) -> Option<(Vec<F>, Vec<F>)> {
        let (symbols, free) = (&self.ansatz.symbols, self.ansatz.free_lengths());
        assert_eq!(lengths.len(), free.len(), "one value for every free length");
        let mut values = self.angles(tangents)?;
        for (&length, value) in free.iter().zip(lengths) {
            values[symbols.length(length)] = value.clone();
        }
        let residuals = self.solve(&mut values)?;
        for solved in &self.solved {
            let Given::Length(length, polynomial) = solved else { continue };
            let variable = symbols.length(*length);
            values[variable] = zero_of(polynomial, variable, &mut values)?;
        }
        let others = self.others.iter().map(|other| other.evaluate(&values));
        let all = residuals.into_iter().chain(others).collect();
        Some((values, all))
    }

    /// Returns whether the angles given by relations have values over the field.
    ///
    /// # Panics
    /// If the number of values is wrong.
    #[must_use]
    pub fn has_angles(&self, tangents: &[F]) -> bool {
        self.angles(tangents).is_some()
    }

    /// Returns the values of the functions of all angles, with lengths 0.
    fn angles(&self, tangents: &[F]) -> Option<Vec<F>> {
        let symbols = &self.ansatz.symbols;
        assert_eq!(tangents.len(), self.ansatz.free_angles.len(), "one tangent for every free angle");
        let turn = |t: &F| -> Option<(F, F)> {
            let square = t.mul(t);
            let inverse = F::one().add(&square).inverse()?;
            Some((F::one().sub(&square).mul(&inverse), t.add(t).mul(&inverse)))
        };
        let mut known = vec![(F::one(), F::zero()); symbols.angles.len()];
        for (&angle, t) in self.ansatz.free_angles.iter().zip(tangents) {
            known[angle] = turn(t)?;
        }
        let mut values = self.functions(&known)?;
        for solved in &self.solved {
            let Given::Angle(angle, polynomial) = solved else { continue };
            known[*angle] = turn(&self.tangent_of(*angle, polynomial, &mut values)?)?;
            values = self.functions(&known)?;
        }
        Some(values)
    }

    /// Returns the half-angle tangent at which a polynomial, linear in the functions of an angle, vanishes.
    fn tangent_of(&self, angle: usize, polynomial: &Polynomial<F>, values: &mut [F]) -> Option<F> {
        let tangent = Symbols::tan_half(angle);
        if polynomial.degree(tangent) > 0 {
            return zero_of(polynomial, tangent, values);
        }
        let [cos, sin] = [Symbols::cos(angle), Symbols::sin(angle)];
        let mut at = |c: F, s: F| {
            (values[cos], values[sin]) = (c, s);
            polynomial.evaluate(values)
        };
        let constant = at(F::zero(), F::zero());
        let a = at(F::one(), F::zero()).sub(&constant);
        let b = at(F::zero(), F::one()).sub(&constant);
        // a cos + b sin + c = 0 is (c - a) t^2 + 2 b t + (c + a) = 0.
        let (high, low) = (constant.sub(&a), constant.add(&a));
        match high.inverse() {
            Some(inverse) => {
                let discriminant = b.mul(&b).sub(&high.mul(&low));
                let root = if discriminant.is_zero() { F::zero() } else { (self.root)(&discriminant)? };
                Some(root.sub(&b).mul(&inverse))
            }
            None => Some(low.neg().mul(&b.add(&b).inverse()?)),
        }
    }

    /// Returns the functions of all angles from cosines and sines of the free and the solved ones.
    fn functions(&self, known: &[(F, F)]) -> Option<Vec<F>> {
        let angles: Vec<(F, F)> =
            self.ansatz.angles.iter().map(|angle: &Twist| angle.cos_sin(known)).collect::<Option<_>>()?;
        let mut values = vec![F::zero(); self.ansatz.symbols.names().list().len()];
        for (k, (cos, sin)) in angles.iter().enumerate() {
            values[Symbols::cos(k)] = cos.clone();
            values[Symbols::sin(k)] = sin.clone();
            // At pi there is no tangent, so an ansatz that uses it excludes that angle.
            values[Symbols::tan_half(k)] = match F::one().add(cos).inverse() {
                Some(inverse) => sin.mul(&inverse),
                None if self.uses(Symbols::tan_half(k)) => return None,
                None => F::zero(),
            };
        }
        Some(values)
    }

    fn uses(&self, variable: usize) -> bool {
        self.joints.iter().flatten().chain(&self.relations).chain(&self.others).any(|p| p.degree(variable) > 0)
    }

    /// Solves the linear relations for the lengths that they give. Returns the residuals of those that give none.
    fn solve(&self, values: &mut [F]) -> Option<Vec<F>> {
        let given: Vec<usize> = self.ansatz.given_lengths.iter().map(|&k| self.ansatz.symbols.length(k)).collect();
        // Each relation is linear in these lengths: it is evaluated with all of them 0 and with one of them 1.
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
        Some(rest.collect())
    }
}

/// Returns the value of a variable, in which a polynomial is linear, at which the polynomial vanishes.
fn zero_of<F: Field>(polynomial: &Polynomial<F>, variable: usize, values: &mut [F]) -> Option<F> {
    values[variable] = F::zero();
    let constant = polynomial.evaluate(values);
    values[variable] = F::one();
    let slope = polynomial.evaluate(values).sub(&constant);
    Some(constant.neg().mul(&slope.inverse()?))
}
