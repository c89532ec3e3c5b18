//! The closure polynomial of a linkage as a polynomial in a given value too, interpolated from those at numbers.

use super::closure::derive_linkage;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::derivation::interpolation::{Family, Source, Values, Watch};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Given, Linkage};
use rug::{Integer, Rational};

/// The closure polynomials of one body at values of one given joint.
struct Closures<'l> {
    linkage: &'l Linkage,
    given: &'l [Given],
    place: usize,
    body: usize,
    degree: usize,
}

impl Source for Closures<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let mut given = self.given.to_vec();
        given[self.place] = given[self.place].at(self.linkage, values.first()?)?;
        let found = derive_linkage(self.linkage, &given).ok()?;
        let own = found.polynomials.iter().find(|one| one.body == self.body)?;
        let mut list = own.coefficients.coefficients().to_vec();
        list.resize(self.degree + 1, Integer::new());
        (own.roots() == self.degree).then_some(list)
    }
}

/// Returns the polynomial in a given value, a half-angle tangent or metres (variable 0), and the half-angle tangent of a body (variable 1),
/// of the closure polynomials of this body, which have so many roots. It is compared at values drawn at random, and has no proof.
///
/// # Errors
/// [`Error::Unsupported`] where the values do not determine it.
pub fn relation_by_values(
    linkage: &Linkage,
    given: &[Given],
    place: usize,
    (body, degree): (usize, usize),
    watch: &Watch<'_>,
) -> Result<Polynomial<Int>> {
    let source = Closures { linkage, given, place, body, degree };
    let name = given[place].joint().map_or_else(String::new, |joint| linkage.joints[joint].name.clone());
    let family = Family::new(&source, watch, Values::Small, vec![name], degree + 1);
    let integers = family.relation()?;
    if integers.degree(1) as usize == degree { Ok(integers) } else { Err(half_turn()) }
}

fn half_turn() -> Error {
    Error::Unsupported(
        "a body makes half a turn at all values of the input: no closure polynomial in it is known".to_owned(),
    )
}
