//! Motions known three times: by rational numbers near to them, enclosed, and in a number field where one holds them.

use super::chain::Placement;
use super::data_field::ClosedForm;
use super::motion::Motion;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::Number;
use crate::algebra::number_field::Algebraic;
use crate::algebra::real_field::RealField;
use crate::algebra::ring::Ring;
use crate::algebra::surd::Closed;
use rug::Rational;

/// A motion, or what is found of it.
#[derive(Clone, Debug)]
pub struct KnownMotion {
    /// By rational numbers: the motion itself where the field is that of the rationals.
    pub exact: Motion<Rational>,
    /// Enclosed.
    pub enclosed: Motion<Enclosure>,
    /// In a number field, where one holds it.
    pub algebraic: Option<Motion<Algebraic>>,
}

impl KnownMotion {
    /// The motion that leaves everything where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self { exact: Motion::identity(), enclosed: Motion::identity(), algebraic: Some(Motion::identity()) }
    }

    /// This motion after another one.
    #[must_use]
    pub fn then_after(&self, other: &Self) -> Self {
        let both = self.algebraic.as_ref().zip(other.algebraic.as_ref());
        Self {
            exact: self.exact.then_after(&other.exact),
            enclosed: self.enclosed.then_after(&other.enclosed),
            algebraic: both.map(|(own, other)| own.then_after(other)),
        }
    }

    /// The inverse motion.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let Self { exact, enclosed, algebraic } = self;
        let algebraic = algebraic.as_ref().map(Motion::inverse);
        Self { exact: exact.inverse(), enclosed: enclosed.inverse(), algebraic }
    }

    /// The image of a direction.
    #[must_use]
    pub fn direction(&self, field: Option<&RealField>, along: &[Number; 3]) -> [Number; 3] {
        let exact = self.exact.rotate(&along.each_ref().map(|x| x.rational().clone()));
        let known = |x: &Number| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero);
        let enclosed = self.enclosed.rotate(&along.each_ref().map(known));
        let algebraic = self.algebraic.as_ref().zip(field).and_then(|(motion, field)| {
            let [x, y, z] = along.each_ref().map(|x| field.element(&x.closed()?));
            Some(motion.rotate(&[x?, y?, z?]))
        });
        numbers(field, &exact, &enclosed, algebraic.as_ref())
    }

    /// The image of the origin.
    #[must_use]
    pub fn point(&self, field: Option<&RealField>) -> [Number; 3] {
        let algebraic = self.algebraic.as_ref().map(|motion| &motion.translation);
        numbers(field, &self.exact.translation, &self.enclosed.translation, algebraic)
    }

    /// The motion as a constant of a mechanism.
    #[must_use]
    pub fn placement(self, field: Option<&RealField>) -> Placement {
        let rational = self.algebraic.as_ref().and_then(|motion| motion.map(Algebraic::rational));
        if let Some(motion) = rational {
            return Placement::from_motion_exact(motion);
        }
        let closed: Option<Motion<Closed>> =
            self.algebraic.as_ref().zip(field).and_then(|(motion, field)| motion.map(|x| field.closed(x)));
        let closed = closed.map(|motion| ClosedForm::Entries(Box::new(motion)));
        Placement { closed, ..Placement::standing_for(self.exact, self.enclosed, true) }
    }
}

/// Three numbers, each as exactly as it is known.
fn numbers(
    field: Option<&RealField>,
    exact: &[Rational; 3],
    enclosed: &[Enclosure; 3],
    algebraic: Option<&[Algebraic; 3]>,
) -> [Number; 3] {
    std::array::from_fn(|k| {
        let own = algebraic.map(|vector| &vector[k]);
        if let Some(own) = own.and_then(Algebraic::rational) {
            return Number::exact(own);
        }
        let closed = own.zip(field).and_then(|(own, field)| field.closed(own));
        match closed {
            Some(closed) => Number::in_closed_form(exact[k].clone(), enclosed[k].clone(), closed),
            None => Number::standing_for(exact[k].clone(), enclosed[k].clone()),
        }
    })
}
