//! Inputs of linkages as typed on the command line: `A=60 deg, leg1=4`.

use super::linkage::{LinkageCase, LinkageClaims, LinkageFile, root, rotation};
use super::sphere::{SphereCase, SphereClaims, SphereFile, turned};
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Given, Pair};
use crate::kinematics::sphere::SphereGiven;
use rug::Rational;

/// Splits names and values: `A=60 deg, B=1/2`.
fn typed(text: &str) -> Result<Vec<(&str, &str)>> {
    let pairs = text.split(',').map(|part| {
        let message = || format!("found --input \"{}\", expected JOINT=VALUE, such as A=60 deg", part.trim());
        let (name, value) = part.split_once('=').ok_or_else(|| Error::Invalid(message()))?;
        Ok((name.trim(), value.trim()))
    });
    pairs.collect()
}

fn number_of<'a>(name: &str, mut joints: impl Iterator<Item = &'a str> + Clone) -> Result<usize> {
    let known = joints.clone();
    joints.position(|own| own == name).ok_or_else(|| {
        let known: Vec<&str> = known.take(12).collect();
        let name: String = name.chars().take(40).collect();
        Error::Invalid(format!("found the unknown joint `{name}` in --input, expected one of {}", known.join(", ")))
    })
}

fn in_option(name: &str, error: impl Into<Error>) -> Error {
    match error.into() {
        Error::Invalid(message) => Error::Invalid(format!("--input {name}: {message}")),
        other => other,
    }
}

impl LinkageFile {
    /// Returns the first case with these values, which replace those of the same joints or are added. Values without a unit have
    /// that of the file.
    ///
    /// # Errors
    /// For unknown joints, gears, and invalid values.
    pub fn case_with(&self, text: &str) -> Result<LinkageCase> {
        let mut case = LinkageCase { expected: LinkageClaims::default(), ..self.cases[0].clone() };
        let line = case.line;
        for (name, value) in typed(text)? {
            let joint = number_of(name, self.linkage.joints.iter().map(|joint| joint.name.as_str()))?;
            let own = &self.linkage.joints[joint];
            let (given, exact) = match &own.pair {
                Pair::Gear { .. } => {
                    return Err(Error::Invalid(format!("found the gears {name} in --input, which have no value")));
                }
                Pair::Prismatic { along, length, .. } => {
                    let distance =
                        Number::parse(value, Quantity::Length, &self.reading).map_err(|error| in_option(name, error))?;
                    let square = Rational::from(along.re.square_ref()) + Rational::from(along.im.square_ref());
                    let exact = distance.is_exact() && root(&square).1;
                    (Given::Shift { joint, shift: Rational::from(distance.rational() / length), line }, exact)
                }
                Pair::Revolute => {
                    let (turn, exact) = rotation(&angle(name, value, &self.reading)?);
                    (Given::Turn { joint, turn, line }, exact)
                }
            };
            let is_other = |one: &Given| {
                !matches!(one, Given::Turn { joint: old, .. } | Given::Shift { joint: old, .. } if *old == joint)
            };
            case.given.retain(is_other);
            case.given.push(given);
            case.exact &= exact;
        }
        Ok(case)
    }
}

impl SphereFile {
    /// Returns the first case with these angles, which replace those of the same joints or are added.
    ///
    /// # Errors
    /// For unknown joints and invalid values.
    pub fn case_with(&self, text: &str) -> Result<SphereCase> {
        let mut case = SphereCase { expected: SphereClaims::default(), ..self.cases[0].clone() };
        let line = case.line;
        for (name, value) in typed(text)? {
            let joint = number_of(name, self.linkage.joints.iter().map(|joint| joint.name.as_str()))?;
            let own = &self.linkage.joints[joint];
            let (rotation, exact) = turned(own, &angle(name, value, &self.reading)?);
            case.given.retain(|one| one.joint != Some(joint));
            case.given.push(SphereGiven { of: own.of, rotation, joint: Some(joint), line });
            case.exact &= exact;
        }
        Ok(case)
    }
}

fn angle(name: &str, value: &str, reading: &Reading) -> Result<Angle> {
    Angle::parse(value, reading).map_err(|error| in_option(name, error))
}
