//! Inputs of linkages as typed on the command line: `A=60 deg, leg1=4`.

use super::entry::InputValue;
use super::linkage::{LinkageCase, LinkageClaims, LinkageFile, given_turn, root};
use super::space::{SpaceCase, SpaceFile};
use super::sphere::{SphereCase, SphereClaims, SphereFile, turned};
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Pair};
use crate::kinematics::motion::Vector;
use crate::kinematics::sphere::{Direction, SphereGiven};
use rug::Rational;

/// The option that holds the values of inputs.
const INPUT: &str = "--input";
/// The option that holds the values to which the nearest assemblies are listed.
const NEAR: &str = "--near";

/// Splits names and values: `A=60 deg, B=1/2`.
fn typed<'a>(text: &'a str, option: &str) -> Result<Vec<(&'a str, &'a str)>> {
    let pairs = text.split(',').map(|part| {
        let message = || format!("found {option} \"{}\", expected JOINT=VALUE, such as A=60 deg", part.trim());
        let (name, value) = part.split_once('=').ok_or_else(|| Error::Invalid(message()))?;
        Ok((name.trim(), value.trim()))
    });
    pairs.collect()
}

fn number_of<'a>(name: &str, mut joints: impl Iterator<Item = &'a str> + Clone, option: &str) -> Result<usize> {
    let known = joints.clone();
    joints.position(|own| own == name).ok_or_else(|| {
        let known: Vec<&str> = known.take(12).collect();
        let name: String = name.chars().take(40).collect();
        Error::Invalid(format!("found the unknown joint `{name}` in {option}, expected one of {}", known.join(", ")))
    })
}

fn in_option(name: &str, error: impl Into<Error>, option: &str) -> Error {
    match error.into() {
        Error::Invalid(message) => Error::Invalid(format!("{option} {name}: {message}")),
        other => other,
    }
}

impl LinkageFile {
    /// Returns the first case with these values in place of those of the same joints, or beside them. Values without a unit have
    /// that of the file.
    ///
    /// # Errors
    /// For unknown joints, gears, and values that are none.
    pub fn case_with(&self, text: &str) -> Result<LinkageCase> {
        let mut values = Vec::new();
        for (name, value) in typed(text, INPUT)? {
            let joint = number_of(name, self.linkage.joints.iter().map(|joint| joint.name.as_str()), INPUT)?;
            let value = if self.linkage.joints[joint].is_prismatic() {
                let distance = Number::parse(value, Quantity::Length, &self.reading);
                InputValue::Distance(distance.map_err(|error| in_option(name, error, INPUT))?)
            } else {
                InputValue::Angle(angle(name, value, &self.reading, INPUT)?)
            };
            values.push((name.to_owned(), value));
        }
        self.case_at(&values)
    }

    /// Returns the values of joints of `--near`, radians or metres: `A=10 deg, B=0.5`, or one value for every joint but gears, in the
    /// order of the file. Values without a unit have that of the file.
    ///
    /// # Errors
    /// For unknown joints, gears, too few or too many values, and values that are none.
    pub fn near(&self, text: &str) -> Result<Vec<Option<f64>>> {
        let joints = &self.linkage.joints;
        let names: Vec<&str> =
            joints.iter().filter(|joint| !joint.is_gear()).map(|joint| joint.name.as_str()).collect();
        let pairs: Vec<(&str, &str)> = if text.contains('=') {
            typed(text, NEAR)?
        } else {
            let values: Vec<&str> = text.split(',').map(str::trim).collect();
            if values.len() != names.len() {
                return Err(Error::Invalid(format!(
                    "found {} values in --near, expected {}, separated by commas, or JOINT=VALUE",
                    values.len(),
                    names.len()
                )));
            }
            names.iter().copied().zip(values).collect()
        };
        let mut near = vec![None; joints.len()];
        for (name, value) in pairs {
            let number = number_of(name, joints.iter().map(|joint| joint.name.as_str()), NEAR)?;
            near[number] = Some(match &joints[number].pair {
                Pair::Gear { .. } => {
                    return Err(Error::Invalid(format!("found the gears {name} in --near, which have no value")));
                }
                Pair::Prismatic { .. } => {
                    let distance = Number::parse(value, Quantity::Length, &self.reading);
                    distance.map_err(|error| in_option(name, error, NEAR))?.to_f64()
                }
                Pair::Revolute => angle(name, value, &self.reading, NEAR)?.radians(),
            });
        }
        Ok(near)
    }

    /// Returns the first case with these values in place of those of the same joints, or beside them.
    ///
    /// # Errors
    /// For unknown joints, gears, and values of another kind than that of their joint.
    pub fn case_at(&self, values: &[(String, InputValue)]) -> Result<LinkageCase> {
        let mut case = LinkageCase { expected: LinkageClaims::default(), ..self.cases[0].clone() };
        let line = case.line;
        for (name, value) in values {
            let joint = number_of(name, self.linkage.joints.iter().map(|joint| joint.name.as_str()), INPUT)?;
            let (given, exact) = match (&self.linkage.joints[joint].pair, value) {
                (Pair::Gear { .. }, _) => {
                    return Err(Error::Invalid(format!("found the gears {name} as an input, which have no value")));
                }
                (Pair::Prismatic { along, length, .. }, InputValue::Distance(distance)) => {
                    let square = Rational::from(along.re.square_ref()) + Rational::from(along.im.square_ref());
                    let exact = distance.is_exact() && root(&square).1;
                    (
                        Given::Shift {
                            joint,
                            shift: Rational::from(distance.rational() / length),
                            square: self.linkage.leg_square(joint, distance),
                            line,
                        },
                        exact,
                    )
                }
                (Pair::Revolute, InputValue::Angle(angle)) => given_turn(joint, angle, line),
                _ => return Err(Error::Invalid(format!("found a value of another kind for the joint {name}"))),
            };
            let is_other = |one: &Given| !matches!(one, Given::Turn { joint: old, .. } | Given::Shift { joint: old, .. } if *old == joint);
            case.given.retain(is_other);
            case.accuracy = case.accuracy.and(given.accuracy(exact));
            case.given.push(given);
        }
        Ok(case)
    }

    /// Returns a point of a body by its name `BODY.POINT`: the number of the body, the name of the point, and its place there.
    ///
    /// # Errors
    /// For names of other forms, and for bodies and points that do not exist.
    pub fn point<'a>(&self, asked: &'a str) -> Result<(usize, &'a str, Gaussian)> {
        let found = |what: String| Error::Invalid(format!("found the point {asked}, {what}"));
        let bodies = &self.linkage.bodies;
        let names = || bodies.iter().take(12).map(|body| body.name.as_str()).collect::<Vec<_>>().join(", ");
        let Some((body, point)) = asked.split_once('.') else {
            return Err(found(format!("expected a point of a body, such as {}.POINT", bodies[0].name)));
        };
        let number = bodies.iter().position(|own| own.name == body);
        let number = number.ok_or_else(|| found(format!("expected one of the bodies {}", names())))?;
        let place = bodies[number].point(point).cloned().ok_or_else(|| {
            let known: Vec<&str> = bodies[number].points.iter().take(12).map(|(name, _)| name.as_str()).collect();
            found(format!("expected one of the points {} of {body}", known.join(", ")))
        })?;
        Ok((number, point, place))
    }
}

impl SphereFile {
    /// Returns the first case with these angles in place of those of the same joints, or beside them.
    ///
    /// # Errors
    /// For unknown joints and values that are none.
    pub fn case_with(&self, text: &str) -> Result<SphereCase> {
        let mut values = Vec::new();
        for (name, value) in typed(text, INPUT)? {
            values.push((name.to_owned(), InputValue::Angle(angle(name, value, &self.reading, INPUT)?)));
        }
        self.case_at(&values)
    }

    /// Returns the first case with these angles in place of those of the same joints, or beside them.
    ///
    /// # Errors
    /// For unknown joints and distances.
    pub fn case_at(&self, values: &[(String, InputValue)]) -> Result<SphereCase> {
        let mut case = SphereCase { expected: SphereClaims::default(), ..self.cases[0].clone() };
        let line = case.line;
        for (name, value) in values {
            let joint = number_of(name, self.linkage.joints.iter().map(|joint| joint.name.as_str()), INPUT)?;
            let own = &self.linkage.joints[joint];
            let InputValue::Angle(angle) = value else {
                return Err(Error::Invalid(format!("found a distance for the joint {name}, expected an angle")));
            };
            let (rotation, exact) = turned(own, angle);
            case.given.retain(|one| one.joint != Some(joint));
            case.given.push(SphereGiven { of: own.of, rotation, joint: Some(joint), line });
            case.exact &= exact;
        }
        Ok(case)
    }

    /// Returns a point of a body by its name `BODY.POINT`: the number of the body, the name of the point, and its direction.
    ///
    /// # Errors
    /// For bodies and points that do not exist.
    pub fn point<'a>(&self, asked: &'a str) -> Result<(usize, &'a str, Direction)> {
        let bodies = self.linkage.bodies.iter().map(|body| (body.name.as_str(), body.points.as_slice()));
        point_named(asked, bodies)
    }
}

/// A named point of a body.
type NamedPoint = (String, [Rational; 3]);

/// The number of a body, the name of a point of it, and its place there.
type PointOfBody<'a> = (usize, &'a str, [Rational; 3]);

/// Finds the point `BODY.POINT` among bodies with their points.
fn point_named<'a, 'b>(
    asked: &'a str,
    bodies: impl Iterator<Item = (&'b str, &'b [NamedPoint])> + Clone,
) -> Result<PointOfBody<'a>> {
    let found = asked.split_once('.').and_then(|(body, point)| {
        let (number, (_, points)) = bodies.clone().enumerate().find(|(_, (name, _))| *name == body)?;
        Some((number, point, points.iter().find(|(name, _)| name == point)?.1.clone()))
    });
    found.ok_or_else(|| {
        let points = bodies.flat_map(|(body, points)| points.iter().map(move |(point, _)| format!("{body}.{point}")));
        let known: Vec<String> = points.take(12).collect();
        Error::Invalid(format!("found the point {asked}, expected a point of a body: {}", known.join(", ")))
    })
}

impl SpaceFile {
    /// Returns a point of a body by its name `BODY.POINT`: the number of the body, the name of the point, and its place there.
    ///
    /// # Errors
    /// For bodies and points that do not exist.
    pub fn point<'a>(&self, asked: &'a str) -> Result<(usize, &'a str, Vector<Rational>)> {
        let bodies = self.linkage.bodies.iter().map(|body| (body.name.as_str(), body.points.as_slice()));
        point_named(asked, bodies)
    }

    /// Returns the first case with these values in place of those of the same joints, or beside them.
    ///
    /// # Errors
    /// For unknown joints and values that are none.
    pub fn case_with(&self, text: &str) -> Result<SpaceCase> {
        let mut values = Vec::new();
        for (name, value) in typed(text, INPUT)? {
            let value = if self.is_distance(name) == Some(true) {
                let distance = Number::parse(value, Quantity::Length, &self.reading);
                InputValue::Distance(distance.map_err(|error| in_option(name, error, INPUT))?)
            } else {
                InputValue::Angle(angle(name, value, &self.reading, INPUT)?)
            };
            values.push((name.to_owned(), value));
        }
        self.case_at(&values)
    }
}

fn angle(name: &str, value: &str, reading: &Reading, option: &str) -> Result<Angle> {
    Angle::parse(value, reading).map_err(|error| in_option(name, error, option))
}
