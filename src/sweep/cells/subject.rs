//! The mechanisms that have cells: each with parameters that other numbers can replace.

use super::source::Source;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::{Coordinate, Setting, Watch};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Accuracy, Given, Linkage, Pair};
use crate::linkage::answer::solve_asked;
use crate::linkage::assembly::Asked;
use crate::mechanism::Mechanism;
use crate::verdict::Status;
use rug::Rational;
use std::sync::atomic::AtomicBool;

/// A parameter of a mechanism.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name in a request: `a1`, `theta4`, `leg1`, `crank.B.x`.
    pub name: String,
    /// The name of its variable: a length, or the half tangent of an angle.
    pub variable: String,
    /// Whether it is an angle.
    pub kind: Variable,
    /// The variable in the file; `None` for the angle pi and for a square root that is irrational.
    pub value: Option<Rational>,
}

/// A mechanism at one case.
pub trait Subject: Clone + Sync {
    /// Returns a parameter.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an unknown name.
    fn parameter(&self, name: &str) -> Result<Parameter>;

    /// Returns the mechanism with another value of the variable of a parameter.
    #[must_use]
    fn with(&self, parameter: &Parameter, value: &Rational) -> Self;

    /// Returns the closure polynomial in a parameter and an unknown.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where there is none.
    fn source(&self, parameter: &Parameter, watch: &Watch<'_>) -> Result<Source>;

    /// Returns the number of real modes that the solver lists, if it knows that none is missing.
    fn real_modes(&self) -> Option<usize>;

    /// Returns whether numbers were rounded that the cells of a parameter depend on.
    fn is_rounded(&self, parameter: &Parameter) -> bool;
}

/// An arm, a loop or a platform.
#[derive(Clone)]
pub struct EntryCase {
    entry: Entry,
    case: Case,
}

impl EntryCase {
    /// Takes a case of a file.
    #[must_use]
    pub fn new(entry: &Entry, case: &Case) -> Self {
        Self { entry: entry.clone(), case: case.clone() }
    }

    fn setting(&self, name: &str) -> Result<Setting> {
        Ok(Setting::named(&Setting::all(&self.entry, &self.case), &[name.to_owned()])?.remove(0))
    }
}

impl Subject for EntryCase {
    fn parameter(&self, name: &str) -> Result<Parameter> {
        let Setting { name, variable, kind, value, .. } = self.setting(name)?;
        Ok(Parameter { name, variable, kind, value })
    }

    fn with(&self, parameter: &Parameter, value: &Rational) -> Self {
        let mut other = self.clone();
        if let Ok(setting) = self.setting(&parameter.name) {
            setting.put(&mut other.entry, &mut other.case, value);
        }
        other
    }

    fn source(&self, parameter: &Parameter, watch: &Watch<'_>) -> Result<Source> {
        Source::of(&self.entry, &self.case, &self.setting(&parameter.name)?, watch)
    }

    fn real_modes(&self) -> Option<usize> {
        let mut entry = self.entry.clone();
        entry.limits.clear();
        entry.cases = vec![self.case.clone()];
        let mechanism = Mechanism::prepare(&entry).ok()?;
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let solution = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).ok()?;
        let is_complete = matches!(solution.verdict.status, Status::Complete | Status::Unreachable);
        is_complete.then(|| solution.modes.iter().filter(|mode| mode.real && !mode.near).count())
    }

    fn is_rounded(&self, _: &Parameter) -> bool {
        self.entry.rounded
    }
}

/// A linkage in the plane with its given values.
#[derive(Clone)]
pub struct LinkageCase {
    linkage: Linkage,
    given: Vec<Given>,
    /// Whether the numbers of bodies and joints, and those of the given values, are exact.
    exact: [bool; 2],
}

impl LinkageCase {
    /// Takes a linkage whose numbers are exact or not, with given values and what is known of them.
    #[must_use]
    pub fn new(linkage: &Linkage, is_exact: bool, given: &[Given], accuracy: Accuracy) -> Self {
        Self { linkage: linkage.clone(), given: given.to_vec(), exact: [is_exact, accuracy == Accuracy::Exact] }
    }

    /// Returns the place among the given values of the joint with this name.
    fn place_of(&self, name: &str) -> Option<usize> {
        let is_named = |one: &Given| one.joint().is_some_and(|joint| self.linkage.joints[joint].name == name);
        self.given.iter().position(is_named)
    }

    fn coordinates(&self) -> Vec<Coordinate> {
        Coordinate::all(&self.linkage, &(0..self.linkage.joints.len()).collect::<Vec<_>>())
    }
}

/// Returns the length of the direction of a slide.
fn length(linkage: &Linkage, joint: usize) -> Rational {
    match &linkage.joints[joint].pair {
        Pair::Prismatic { length, .. } => length.clone(),
        _ => Rational::from(1),
    }
}

impl Subject for LinkageCase {
    fn parameter(&self, name: &str) -> Result<Parameter> {
        if let Some(place) = self.place_of(name) {
            let (kind, variable, value) = match &self.given[place] {
                Given::Turn { turn, .. } => {
                    let below = Rational::from(1 + &turn.re);
                    let value = (below != 0).then(|| Rational::from(&turn.im / &below));
                    (Variable::Rotation, format!("t_{name}"), value)
                }
                Given::Shift { joint, shift, .. } => {
                    let value = Rational::from(shift * &length(&self.linkage, *joint));
                    (Variable::Translation, name.to_owned(), Some(value))
                }
                Given::Place { .. } => unreachable!("a place has no joint"),
            };
            return Ok(Parameter { name: name.to_owned(), variable, kind, value });
        }
        let all = self.coordinates();
        let found = all.iter().find(|one| one.name(&self.linkage) == name).ok_or_else(|| {
            let joints =
                self.given.iter().filter_map(Given::joint).map(|joint| self.linkage.joints[joint].name.clone());
            let known: Vec<String> = joints.chain(all.iter().map(|one| one.name(&self.linkage))).take(24).collect();
            Error::Invalid(format!("found the parameter {name}, expected one of {}", known.join(", ")))
        })?;
        let variable = found.variable(&self.linkage);
        Ok(Parameter { name: name.to_owned(), variable, kind: Variable::Translation, value: Some(found.value.clone()) })
    }

    fn with(&self, parameter: &Parameter, value: &Rational) -> Self {
        let mut other = self.clone();
        if let Some(place) = self.place_of(&parameter.name) {
            if let Some(own) = self.given[place].at(&self.linkage, value) {
                other.given[place] = own;
            }
        } else if let Some(own) = self.coordinates().iter().find(|one| one.name(&self.linkage) == parameter.name) {
            own.put(&mut other.linkage, value);
        }
        other
    }

    fn source(&self, parameter: &Parameter, watch: &Watch<'_>) -> Result<Source> {
        let mut given = self.given.clone();
        let Some(place) = self.place_of(&parameter.name) else {
            return Source::of_linkage(&self.linkage, &given, Some(&parameter.name), watch);
        };
        // The relation is that of the first given joint.
        given.swap(0, place);
        Source::of_linkage(&self.linkage, &given, None, watch)
    }

    fn real_modes(&self) -> Option<usize> {
        let asked = Asked { complex: true, stop: &AtomicBool::new(false), near: None };
        let answer = solve_asked(&self.linkage, &self.given, Accuracy::Exact, asked).ok()?;
        let is_complete = matches!(answer.verdict.status, Status::Complete | Status::Unreachable);
        is_complete.then(|| answer.modes.iter().filter(|mode| mode.real).count())
    }

    fn is_rounded(&self, parameter: &Parameter) -> bool {
        let [linkage, given] = self.exact;
        // Of one given value, which is the parameter itself, the number in the file does not matter.
        !linkage || (!given && (self.given.len() > 1 || self.place_of(&parameter.name).is_none()))
    }
}
