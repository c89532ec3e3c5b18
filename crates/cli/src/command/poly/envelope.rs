//! `looproot poly envelope`

use super::arguments::EnvelopeOptions;
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::internal::error::Error;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::resultant::resultant;
use looproot_algebra::ring::{Domain, Ring};
use looproot_algebra::text::Fraction;

/// Prints the discriminant of a family of curves or surfaces by its parameter, in square-free factors by rising multiplicity.
/// The envelope is among the simple ones; double points of members occur twice and their cusps three times.
///
/// A factor of the family that contains the parameter alone, such as the `1 + t^2` of half-angle tangents, is removed first,
/// and the factor of the discriminant that belongs to an infinite parameter last.
pub fn run(options: &EnvelopeOptions) -> Result<Exit, Fault> {
    let arguments = &[options.family.as_str()];
    let ([family], names) = input::exactly::<1>(arguments, &options.read)?;
    input::check_degrees(std::slice::from_ref(&family))?;
    let parameter = names.known(&options.parameter)?;
    let others = (0..names.list().len()).filter(|variable| *variable != parameter);
    let alone = others.fold(family.numerator.clone(), |content, variable| content.content_in(variable));
    let of_zero = || Error::Invalid("found a family of no curve, expected a polynomial that is not zero".to_owned());
    let own = family.numerator.checked_div_exact(&alone).ok_or_else(of_zero)?;
    if own.degree(parameter) < 2 {
        let message = format!(
            "found the degree {} in {}, expected 2 or more: a family of degree 1 has one member through every point",
            own.degree(parameter),
            options.parameter
        );
        return Err(Error::Invalid(message).into());
    }
    let eliminated = resultant(&own, &own.derivative(parameter), parameter);
    let leading = own.coefficients_in(parameter).pop().unwrap_or_else(Polynomial::one);
    let discriminant = eliminated.checked_div_exact(&leading).unwrap_or(eliminated);
    if discriminant.is_zero() {
        let message = "found a family in which every member counts twice, expected one without a square factor";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    let mut factors = discriminant.square_free_decomposition();
    factors.sort_by_key(|(_, multiplicity)| *multiplicity);
    let shown: Vec<Fraction> = factors
        .into_iter()
        .map(|(numerator, _)| Fraction { numerator: numerator.primitive_part(), denominator: Int::one() })
        .collect();
    tell::results(&shown, &names, &options.write, &input::files(arguments))?;
    Ok(Exit::Complete)
}
