//! Loops whose numbers lie in one real number field, and their positions.

use crate::algebra::determinant;
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::real_field::RealField;
use crate::algebra::residue_field::{Reduction, Residue};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::exact::cut::Cut;
use crate::exact::linkage::{Axis, JointValue, Linkage, Study, joint, one, times};
use crate::exact::positions::{Conjugates, Ground, Here, position};
use crate::kinematics::chain::{Chain, Geometry};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::data_field::{DataField, numbers};
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
    /// Indices at which the three variables of spherical joints begin.
    pub(super) spherical_joints: Vec<usize>,
}

impl Grounded {
    /// The loop of a chain over the field of its numbers; `None` if they lie in no field of a moderate degree, or the chain has a
    /// constant motion that was rounded.
    pub(super) fn of(chain: &Chain, spherical_joints: Vec<usize>) -> Option<Self> {
        let numbers = numbers(chain)?;
        let field = DataField(RealField::containing(&numbers)?);
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
                Linkage::about_axes(joints, &home, |number| field.0.element(&number.closed()?))?
            }
            Geometry::Dh(_) | Geometry::ModifiedDh(_) => {
                let (variables, motions) = chain.unknowns_and_constants_over(&field)?;
                Linkage::of_motions(variables, motions)?
            }
        };
        Some(Self { field: field.0, linkage, spherical_joints })
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

    /// Returns the positions that one cut finds, as [`crate::exact::positions::positions`] does over the rationals.
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
            let x = Rational::from(k) - Rational::from(degree / 2);
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

impl Grounded {
    /// Joint values, as polynomials in the half-angle tangent x of the first joint, at which a loop of four joints without offsets
    /// closes for every x: those of Bennett's loop. The identity is expanded in the field.
    pub(super) fn bennett(&self, chain: &Chain) -> Option<Vec<JointValue<Univariate<Algebraic>>>> {
        let Geometry::Dh(joints) = &chain.geometry else { return None };
        if joints.len() != 4 || self.linkage.variables != [Variable::Rotation; 4] {
            return None;
        }
        let tangent = |k: usize| -> Option<Algebraic> {
            let (cos, sin) = joints[k].alpha.phase()?;
            let whole = Algebraic::one().add(&self.field.element(&cos)?);
            Some(self.field.element(&sin)?.mul(&whole.inverse()?))
        };
        let (s, t) = (tangent(0)?, tangent(1)?);
        let ratio = t.add(&s).mul(&t.sub(&s).inverse()?);
        let reduction = Reduction::of(&self.field)?;
        let image = |x: &Algebraic| reduction.residue(x);
        let residue = self.linkage.over(image)?;
        let residues = |pair: &JointValue<Univariate<Algebraic>>| Some([pair[0].map(image)?, pair[1].map(image)?]);
        candidates(&ratio)?.into_iter().find(|values| {
            // Most are refused modulo a prime.
            let images: Option<Vec<_>> = values.iter().map(residues).collect();
            images.is_some_and(|images| closes_throughout(&residue, &images))
                && closes_throughout(&self.linkage, values)
        })
    }
}

/// The ways in which the half-angle tangents of Bennett's loop can depend on that of joint 1.
fn candidates(ratio: &Algebraic) -> Option<Vec<Vec<JointValue<Univariate<Algebraic>>>>> {
    let one = Univariate::constant(Algebraic::one());
    let line = |c: &Algebraic| Univariate::new(vec![Algebraic::zero(), c.clone()]);
    let mut found = Vec::new();
    for c in [ratio.clone(), ratio.neg(), ratio.inverse()?, ratio.inverse()?.neg()] {
        for (third, fourth) in
            [(1, 1), (1, -1), (-1, 1), (-1, -1)].map(|(a, b)| (Algebraic::from_integer(a), Algebraic::from_integer(b)))
        {
            let first = [one.clone(), line(&Algebraic::one())];
            let third = [one.clone(), line(&third)];
            let straight = |c: &Algebraic| [one.clone(), line(c)];
            let inverse = |c: &Algebraic| [line(&Algebraic::one()), Univariate::constant(c.clone())];
            found.push(vec![first.clone(), straight(&c), third.clone(), straight(&c.mul(&fourth))]);
            found.push(vec![first, inverse(&c), third, inverse(&c.mul(&fourth))]);
        }
    }
    Some(found)
}

/// Whether a loop closes for every value of the variable of these joint values: an identity of polynomials.
fn closes_throughout<F: Field>(linkage: &Linkage<F>, values: &[JointValue<Univariate<F>>]) -> bool {
    let constant = |x: &F| Univariate::constant(x.clone());
    let factors = linkage.links.iter().zip(values).zip(&linkage.variables).map(|((link, value), variable)| {
        let (x, y) = link.study();
        let mut coordinates = x.iter().chain(&y).map(constant);
        let study: Study<Univariate<F>> = std::array::from_fn(|_| coordinates.next().unwrap_or_else(Univariate::zero));
        times(&joint(*variable, &Axis::Z, value), &study)
    });
    let product = factors.fold(one(), |product, factor| times(&product, &factor));
    !product[0].is_zero() && product[1..].iter().all(Ring::is_zero)
}

/// A number of a field as that of a larger one in which the generating element is this.
pub(super) fn in_terms_of(x: &Algebraic, element: &Algebraic) -> Algebraic {
    x.polynomial().map(Algebraic::from_rational).map_or_else(Algebraic::zero, |p| p.eval(element))
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
