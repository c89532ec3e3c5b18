//! The cells of given joints of linkages on the sphere and in space.

use super::source::Source;
use super::subject::{Parameter, Subject};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::catalogue::entry::InputValue;
use crate::catalogue::{SpaceFile, sphere::turned};
use crate::derivation::{Watch, transfer};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{cross, dot};
use crate::kinematics::sphere::{SphereGiven, SphereJoint, SphereLinkage};
use crate::linkage::space::{self, bodies};
use crate::linkage::sphere::{self, about, start};
use crate::verdict::{Status, Verdict};
use looproot_calculus::rotation::matrix::{product, transpose};
use looproot_calculus::unit::Root;
use rug::Rational;

/// The error for a name that no given joint has.
fn unknown<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Error {
    let known: Vec<&str> = known.take(24).collect();
    Error::Invalid(format!("found the parameter {name}, expected a given joint, one of {}", known.join(", ")))
}

/// Whether a list has all modes.
fn is_complete(verdict: &Verdict) -> bool {
    matches!(verdict.status, Status::Complete | Status::Unreachable)
}

/// A linkage on the sphere with its given rotations.
#[derive(Clone)]
pub struct SphereCase {
    linkage: SphereLinkage,
    given: Vec<SphereGiven>,
    /// Whether the numbers of bodies and joints, and those of the given rotations, are exact.
    exact: [bool; 2],
}

impl SphereCase {
    /// Takes a linkage whose numbers are exact or not, with given rotations that are exact or not.
    #[must_use]
    pub fn new(linkage: &SphereLinkage, given: &[SphereGiven], exact: [bool; 2]) -> Self {
        Self { linkage: linkage.clone(), given: given.to_vec(), exact }
    }

    /// Returns the place among the given rotations, and the number, of the joint with this name.
    fn place_of(&self, name: &str) -> Option<(usize, usize)> {
        let is_named = |joint: usize| self.linkage.joints[joint].name == name;
        let mut given = self.given.iter().enumerate();
        given.find_map(|(place, one)| one.joint.filter(|joint| is_named(*joint)).map(|joint| (place, joint)))
    }

    /// Returns the relation of a given joint and the other one at the ground of a four-bar that is all of the linkage. Over real angles of
    /// both, crank and rocker have their places, and with them the coupler, whose two axes are not parallel.
    fn by_transfer(&self, joint: usize) -> Option<Source> {
        if self.linkage.bodies.len() != 4 || self.linkage.joints.len() != 4 || self.given.len() != 1 {
            return None;
        }
        let found = transfer(&self.linkage, joint).ok()?;
        // Of a lower degree the other joint is half a turn open at all values.
        let is_whole = found.polynomial.degree(1) == 2 && found.bodies.len() == 1 && self.holds_coupler();
        let unknown = format!("t_{}", self.linkage.joints[found.output].name);
        Source::of_transfer(&found.polynomial, unknown).filter(|_| is_whole)
    }
}

impl SphereCase {
    /// Whether the axes of every body without a joint to the ground are not parallel: two of them hold it.
    fn holds_coupler(&self) -> bool {
        let SphereLinkage { joints, ground, bodies, .. } = &self.linkage;
        let is_joined = |body: usize| joints.iter().any(|joint| joint.of.contains(&body) && joint.of.contains(ground));
        (0..bodies.len()).filter(|body| body != ground && !is_joined(*body)).all(|body| {
            let axes = joints
                .iter()
                .flat_map(|joint| (0..2).filter(|side| joint.of[*side] == body).map(|side| &joint.at[side]));
            let axes: Vec<_> = axes.collect();
            axes.windows(2).any(|pair| cross(pair[0], pair[1]).iter().any(|x| *x != 0))
        })
    }
}

/// Returns the half tangent of a given rotation over the length of the axis; `None` for half a turn.
fn half_tangent(linkage: &SphereLinkage, given: &SphereGiven, joint: usize) -> Option<Rational> {
    let axis = &linkage.joints[joint].at[0];
    let turn = product(&given.rotation, &transpose(&start(linkage, joint)));
    // The trace is 1 + 2 cos, and the skew part 2 sin u / |u|.
    let below: Rational = (0..3).map(|k| turn[k][k].clone()).sum::<Rational>() + 1;
    let skew = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| Rational::from(&turn[i][j] - &turn[j][i]));
    (below != 0).then(|| dot(&skew, axis) / dot(axis, axis) / below)
}

/// Returns the length of the axis of a joint.
fn length(joint: &SphereJoint) -> Result<Rational> {
    Rational::sqrt(&dot(&joint.at[0], &joint.at[0])).ok_or_else(|| {
        Error::Unsupported(format!("cells of the joint {}, whose directions have irrational lengths", joint.name))
    })
}

impl Subject for SphereCase {
    fn parameter(&self, name: &str) -> Result<Parameter> {
        let joints =
            self.given.iter().filter_map(|one| one.joint).map(|joint| self.linkage.joints[joint].name.as_str());
        let (place, joint) = self.place_of(name).ok_or_else(|| unknown(name, joints))?;
        let length = length(&self.linkage.joints[joint])?;
        let value = half_tangent(&self.linkage, &self.given[place], joint).map(|x| x * length);
        Ok(Parameter { name: name.to_owned(), variable: format!("t_{name}"), kind: Variable::Rotation, value })
    }

    fn with(&self, parameter: &Parameter, value: &Rational) -> Self {
        let mut other = self.clone();
        if let Some((place, joint)) = self.place_of(&parameter.name)
            && let Ok(length) = length(&self.linkage.joints[joint])
        {
            let turn = about(&self.linkage.joints[joint].at[0], &Rational::from(value / &length));
            other.given[place].rotation = product(&turn, &start(&self.linkage, joint));
        }
        other
    }

    fn source(&self, parameter: &Parameter, watch: &Watch<'_>) -> Result<Source> {
        if let Some(source) = self.place_of(&parameter.name).and_then(|(_, joint)| self.by_transfer(joint)) {
            return Ok(source);
        }
        let at = |value: &Rational| {
            let other = self.with(parameter, value);
            let system = sphere::System::of(&other.linkage, &other.given).ok()?;
            Some((system.unknowns, system.equations))
        };
        Source::by_bases(&at, parameter, watch)
    }

    fn real_modes(&self) -> Option<usize> {
        let answer = sphere::solve(&self.linkage, &self.given, true).ok()?;
        is_complete(&answer.verdict).then(|| answer.modes.iter().filter(|mode| mode.real).count())
    }

    fn is_rounded(&self, parameter: &Parameter) -> bool {
        let [linkage, given] = self.exact;
        let is_zero_exact = self.place_of(&parameter.name).is_some_and(|(_, joint)| {
            turned(&self.linkage.joints[joint], &Angle::from_half_tangent(HalfTangent::Finite(Rational::new()))).1
        });
        !linkage || !is_zero_exact || (!given && self.given.len() > 1)
    }
}

/// A linkage in space with its given values.
#[derive(Clone)]
pub struct SpaceCase {
    /// The file with one case.
    file: SpaceFile,
}

impl SpaceCase {
    /// Takes a case of a file by its number, counted from 0.
    #[must_use]
    pub fn new(file: &SpaceFile, case: usize) -> Self {
        Self { file: SpaceFile { cases: vec![file.cases[case].clone()], ..file.clone() } }
    }
}

impl Subject for SpaceCase {
    fn parameter(&self, name: &str) -> Result<Parameter> {
        let joints = &self.file.linkage.joints;
        let mut given =
            self.file.cases[0].given.iter().filter_map(|one| Some((joints[one.joint?].name.as_str(), one.value?)));
        let found = given.clone().find(|(own, _)| *own == name);
        let (_, value) = found.ok_or_else(|| unknown(name, given.by_ref().map(|(own, _)| own)))?;
        let is_distance = self.file.is_distance(name) == Some(true);
        let (kind, variable, value) = if is_distance {
            (Variable::Translation, name.to_owned(), Rational::from_f64(value))
        } else {
            let turn = Angle::from_radians(value);
            let half = match turn.half_tangent() {
                HalfTangent::Finite(t) => Some(t.clone()),
                HalfTangent::Infinite => None,
            };
            (Variable::Rotation, format!("t_{name}"), half)
        };
        Ok(Parameter { name: name.to_owned(), variable, kind, value })
    }

    fn with(&self, parameter: &Parameter, value: &Rational) -> Self {
        let value = match parameter.kind {
            Variable::Rotation => InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(value.clone()))),
            Variable::Translation => InputValue::Distance(Number::exact(value.clone())),
        };
        let mut other = self.clone();
        if let Ok(case) = self.file.case_at(&[(parameter.name.clone(), value)]) {
            other.file.cases = vec![case];
        }
        other
    }

    fn source(&self, parameter: &Parameter, watch: &Watch<'_>) -> Result<Source> {
        // Whether the value itself is exact says the case in which nothing else was rounded.
        let mut whole = self.clone();
        whole.file.cases[0].exact = true;
        let at = |value: &Rational| {
            let other = whole.with(parameter, value);
            let (linkage, case) = (&other.file.linkage, other.file.cases.first().filter(|case| case.exact)?);
            let system = space::System::of(linkage, &case.given, &bodies(linkage)).ok()?;
            Some((system.unknowns, system.equations))
        };
        Source::by_bases(&at, parameter, watch)
    }

    fn real_modes(&self) -> Option<usize> {
        let answer = space::solve_real(&self.file.linkage, &self.file.cases[0].given, true).ok()?;
        is_complete(&answer.verdict).then(|| answer.modes.iter().filter(|mode| mode.real).count())
    }

    fn is_rounded(&self, _: &Parameter) -> bool {
        let case = &self.file.cases[0];
        !self.file.exact || (!case.exact && case.given.len() > 1)
    }
}
