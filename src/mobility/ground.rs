//! Loops whose numbers lie in one real number field, and their positions.

use super::cut::Cut;
use super::linkage::{JointValue, Linkage};
use super::positions::{Conjugates, Ground, Here, position};
use crate::algebra::determinant;
use crate::algebra::number::{Angle, Number};
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::real_field::RealField;
use crate::algebra::residue_field::{Reduction, Residue};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::surd::Closed;
use crate::algebra::univariate::Univariate;
use crate::kinematics::chain::{Chain, Geometry};
use crate::kinematics::closed_loop::{Parameter, Parameters, Variable};
use rug::{Float, Rational};
use std::sync::Arc;

/// Positions are looked for in fields of up to this degree over the rationals: arithmetic in larger ones takes too long.
const MOST: usize = 16;
/// Multipliers tried for the element that generates the field of a position.
const MULTIPLIERS: i32 = 12;

/// A loop over the field of its numbers.
pub(super) struct Grounded {
    pub(super) field: RealField,
    pub(super) linkage: Linkage<Algebraic>,
}

/// The constants of a chain as elements of a field.
struct Constants<'a>(&'a RealField);

impl Parameters<Algebraic> for Constants<'_> {
    fn angle(&self, _joint: usize, _parameter: Parameter, value: &Angle) -> Option<(Algebraic, Algebraic)> {
        let (cos, sin) = value.phase()?;
        Some((self.0.element(&cos)?, self.0.element(&sin)?))
    }
    fn length(&self, _joint: usize, _parameter: Parameter, value: &Number) -> Option<Algebraic> {
        self.0.element(&value.closed()?)
    }
}

/// The numbers of a chain in closed form; `None` where one has none.
fn numbers(chain: &Chain) -> Option<Vec<Closed>> {
    let mut found = Vec::new();
    match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            for joint in joints {
                found.extend([joint.a.closed()?, joint.d.closed()?]);
                for (cos, sin) in [joint.alpha.phase()?, joint.theta0.phase()?] {
                    found.extend([cos, sin]);
                }
            }
        }
        Geometry::Screws { joints, .. } => {
            for number in joints.iter().flat_map(|joint| joint.axis.iter().chain(&joint.point)) {
                found.push(number.closed()?);
            }
        }
    }
    Some(found)
}

impl Grounded {
    /// The loop of a chain over the field of its numbers; `None` if they lie in no field of a moderate degree, or the chain has a
    /// constant motion that was rounded.
    pub(super) fn of(chain: &Chain) -> Option<Self> {
        let numbers = numbers(chain)?;
        let field = RealField::containing(&numbers)?;
        let constants = Constants(&field);
        let mut motions = vec![&chain.base, &chain.tool];
        if let Geometry::Screws { home, .. } = &chain.geometry {
            motions.push(home);
        }
        if motions.iter().any(|placement| placement.defect != 0.0) {
            return None;
        }
        let linkage = match &chain.geometry {
            Geometry::Screws { joints, home } => {
                let home = home.exact.map(Algebraic::from_rational)?;
                Linkage::about_axes(joints, &home, |number| field.element(&number.closed()?))?
            }
            Geometry::Dh(_) | Geometry::ModifiedDh(_) => {
                let (variables, motions) = chain.unknowns_and_constants_over(&constants)?;
                Linkage::of_motions(variables, motions)?
            }
        };
        Some(Self { field, linkage })
    }

    /// The loop modulo a prime at which the field has residues.
    pub(super) fn residue(&self) -> Option<Linkage<Residue>> {
        let reduction = Reduction::of(&self.field)?;
        self.linkage.over(|x| reduction.residue(x))
    }

    /// Lengths of the axes.
    pub(super) fn lengths(&self, bits: u32) -> Vec<Float> {
        let element = &self.field.conjugates()[0];
        let length = |k: usize| Float::with_val(bits, self.linkage.axes[k].square().at(element)).sqrt();
        (0..self.linkage.axes.len()).map(length).collect()
    }

    /// The configuration with all joints at 0, as screws are given, if it is one.
    pub(super) fn home(&self) -> Option<Conjugates> {
        let values = vec![[Algebraic::one(), Algebraic::zero()]; self.linkage.variables.len()];
        self.linkage.at(&values).closes().then(|| self.here(values))
    }

    /// Values in the field itself.
    fn here(&self, values: Vec<JointValue<Algebraic>>) -> Conjugates {
        let polynomial = self.field.polynomial().clone();
        let field = NumberField::new(&polynomial);
        let element = field.root();
        Conjugates::over_ground(polynomial, field, values, self.ground(element))
    }

    fn ground(&self, element: Algebraic) -> Ground {
        Ground { degree: self.field.degree(), element, conjugates: self.field.conjugates().into() }
    }

    /// All positions with joints held at rational values, if a cut separates them.
    pub(super) fn at(&self, held: &[(usize, Rational)]) -> Option<Vec<Conjugates>> {
        let pair =
            |(k, tangent): &(usize, Rational)| Some((*k, [Algebraic::one(), Algebraic::from_rational(tangent)?]));
        let pairs: Option<Vec<(usize, JointValue<Algebraic>)>> = held.iter().map(pair).collect();
        let linkage = self.linkage.locked(&pairs?);
        let n = linkage.variables.len();
        Cut::<Algebraic>::all(n).find_map(|cut| self.separated(&linkage, &Cut::of(&linkage, cut)))
    }

    /// What one cut finds, as [`super::positions::positions`] does over the rationals.
    fn separated(&self, linkage: &Linkage<Algebraic>, cut: &Cut<Algebraic>) -> Option<Vec<Conjugates>> {
        let conditions = cut.conditions(|matrix| determinant::by_interpolation(matrix));
        let determinant = conditions.into_iter().reduce(|a, b| a.gcd(&b))?;
        determinant.degree()?;
        let mut found = Vec::new();
        let mut note = |here: Here, whole: &dyn Fn(Vec<JointValue<Algebraic>>) -> Conjugates| match here {
            Here::Undecided => None,
            Here::Nothing | Here::Improper => Some(()),
            Here::Position(values) => {
                found.push(whole(values));
                Some(())
            }
        };
        let own = |t: &JointValue<Algebraic>| position(linkage, cut, |x| Some(x.clone()), t);
        note(own(&[Algebraic::zero(), Algebraic::one()]), &|values| self.here(values))?;
        let hidden = cut.order[cut.hidden];
        let circle = Univariate::new(vec![Algebraic::one(), Algebraic::zero(), linkage.axes[hidden].square()]);
        let mut polynomial = determinant.square_free_part();
        if linkage.variables[hidden] == Variable::Rotation {
            polynomial = polynomial.remove_factor(&circle).1;
        }
        match polynomial.coefficients() {
            [] => return None,
            [_] => {}
            [constant, leading] => {
                let t = constant.neg().mul(&leading.inverse()?);
                note(own(&[Algebraic::one(), t]), &|values| self.here(values))?;
            }
            _ => {
                // Over each part of the field of its roots.
                let mut open = vec![self.extended(&polynomial)?];
                while let Some(extension) = open.pop() {
                    let image = |x: &Algebraic| Some(extension.image(x));
                    let here = position(linkage, cut, image, &[Algebraic::one(), extension.t.clone()]);
                    if let Some(factor) = extension.field.split() {
                        let other = extension.polynomial.div_rem(factor).0;
                        open.extend([extension.over(factor), extension.over(&other)]);
                    } else {
                        let whole = |values| {
                            let ground = self.ground(extension.element.clone());
                            Conjugates::over_ground(
                                extension.polynomial.clone(),
                                extension.field.clone(),
                                values,
                                ground,
                            )
                        };
                        note(here, &whole)?;
                    }
                }
            }
        }
        Some(found)
    }

    /// The field of a root t of a polynomial over the field of the loop, by one element `t + m u` with the element u that generates
    /// that field.
    fn extended(&self, polynomial: &Univariate<Algebraic>) -> Option<Extension> {
        let degree = self.field.degree() * polynomial.degree()?;
        if degree > MOST {
            return None;
        }
        (0..MULTIPLIERS).find_map(|multiplier| self.extended_by(polynomial, degree, multiplier))
    }

    fn extended_by(&self, polynomial: &Univariate<Algebraic>, degree: usize, multiplier: i32) -> Option<Extension> {
        // The coefficients as polynomials in u.
        let coefficients: Vec<Univariate<Rational>> =
            polynomial.coefficients().iter().map(Algebraic::polynomial).collect();
        let shift = Univariate::new(vec![Rational::new(), Rational::from(-multiplier)]);
        // The norm of the polynomial at T - m u, a polynomial in T, from its values.
        let value = |k: usize| -> Option<(Rational, Rational)> {
            let x = Rational::from(k as i64 - (degree / 2) as i64);
            let t = shift.add(&Univariate::constant(x.clone()));
            let horner = |value: Univariate<Rational>, c: &Univariate<Rational>| value.mul(&t).add(c);
            let at = coefficients.iter().rev().fold(Univariate::zero(), horner);
            Some((x, self.norm(&at)))
        };
        let points: Option<Vec<(Rational, Rational)>> = (0..=degree).map(value).collect();
        let norm = Univariate::interpolate(&points?).normalise();
        if norm.degree() != Some(degree) || norm.gcd(&norm.derivative()).degree() != Some(0) {
            return None;
        }
        let field = NumberField::new(&norm);
        let root = field.root();
        // u is the common root of its own polynomial and that of t = T - m u.
        let constant = |c: &Rational| Algebraic::from_rational(c);
        let t = Univariate::new(vec![root.clone(), Algebraic::from_integer(-multiplier)]);
        let lifted: Option<Vec<Univariate<Algebraic>>> = coefficients.iter().map(|c| c.map(constant)).collect();
        let second = lifted?.iter().rev().fold(Univariate::zero(), |value, c| value.mul(&t).add(c));
        let common = self.field.polynomial().map(constant)?.gcd(&second);
        let [low, high] = common.coefficients() else { return None };
        let element = low.neg().mul(&high.inverse()?);
        let t = root.sub(&element.mul(&Algebraic::from_integer(multiplier)));
        // The field may fall apart: what was computed so far holds at all of its roots nevertheless, or is void.
        field.split().is_none().then_some(Extension { polynomial: norm, field, element, t })
    }

    /// The norm of an element, given as a polynomial in u.
    fn norm(&self, x: &Univariate<Rational>) -> Rational {
        let n = self.field.degree();
        let modulus = self.field.polynomial();
        let mut row = x.div_rem(modulus).1;
        let mut rows = Vec::with_capacity(n);
        for _ in 0..n {
            let mut coefficients = row.coefficients().to_vec();
            coefficients.resize(n, Rational::new());
            rows.push(coefficients);
            row = row.mul(&Univariate::x()).div_rem(modulus).1;
        }
        determinant::determinant(&rows)
    }
}

/// A number of a field as that of a larger one in which the generating element is this.
pub(super) fn in_terms_of(x: &Algebraic, element: &Algebraic) -> Algebraic {
    x.polynomial().map(|c| Algebraic::from_rational(c)).map_or_else(Algebraic::zero, |p| p.eval(element))
}

/// A field in which a polynomial over the field of a loop has a root.
struct Extension {
    /// The polynomial of the element T that generates it.
    polynomial: Univariate<Rational>,
    field: Arc<NumberField>,
    /// The element that generates the field of the loop, in terms of T.
    element: Algebraic,
    /// The root.
    t: Algebraic,
}

impl Extension {
    /// The image of an element of the field of the loop.
    fn image(&self, x: &Algebraic) -> Algebraic {
        in_terms_of(x, &self.element)
    }

    fn over(&self, factor: &Univariate<Rational>) -> Self {
        let field = NumberField::new(factor);
        let [element, t] = [&self.element, &self.t].map(|x| x.over(&field));
        Self { polynomial: factor.clone(), field, element, t }
    }
}
