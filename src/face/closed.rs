//! Loops at an input, and platforms on six legs.

use super::model::Model;
use super::pose::{Matrix, placement};
use crate::algebra::number::Number;
use crate::catalogue::entry::{Case, Design, Input, InputValue, Kind};
use crate::error::{Error, Result};
use crate::kinematics::joint::Variable;
use crate::mechanism::Solution;
use crate::sweep::Range;
use serde_json::Value;

/// A closed loop.
pub struct Loop {
    /// The mechanism.
    #[doc(hidden)]
    pub model: Model,
}

/// A Stewart platform.
pub struct Platform {
    /// The mechanism.
    #[doc(hidden)]
    pub model: Model,
}

fn finite(what: &str, values: &[f64]) -> Result<()> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(Error::Invalid(format!("found {} at [{at}] of {what}, expected finite numbers", values[at]))),
        None => Ok(()),
    }
}

impl Loop {
    /// A loop of a file or of the library.
    ///
    /// # Errors
    /// For a file or name that cannot be read, and for a mechanism that is no loop.
    #[doc(hidden)]
    pub fn new(model: Model) -> Result<Self> {
        if model.entry.kind() != Kind::Loop {
            return Err(Error::Invalid(format!("found {:?}, expected a loop", model.entry.kind())));
        }
        let mut own = Self { model };
        // A loop is prepared for its input: the input of the file, else the first joint.
        if own.model.entry.cases.is_empty() {
            let case = own.case(0.0)?;
            own.model.entry.cases.push(case);
        }
        Ok(own)
    }

    /// A loop of a file or of the library.
    ///
    /// # Errors
    /// For a file or name that cannot be read, and for a mechanism that is no loop.
    pub fn from_file(name: &str) -> Result<Self> {
        Self::new(Model::load(name, None, None)?)
    }

    /// The number of joint variables, the given one among them.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.model.entry.chain().map_or(0, |chain| chain.variables().len())
    }

    /// Returns the input of the file, else the first joint: its number from 1, and its variable.
    #[must_use]
    pub fn input(&self) -> (usize, Variable) {
        let given = self.model.entry.cases.first().and_then(|case| case.input.first());
        let own = given.map(|input| (input.joint, input.value.variable()));
        let first = || self.model.entry.chain().and_then(|chain| chain.variables().first().copied());
        own.or_else(|| first().map(|v| (v.joint, v.variable))).unwrap_or((1, Variable::Rotation))
    }

    /// The case in which the input has this value.
    ///
    /// # Errors
    /// For a value that is not finite.
    #[doc(hidden)]
    pub fn case(&self, value: f64) -> Result<Case> {
        finite("the input", &[value])?;
        let (joint, variable) = self.input();
        let value = match variable {
            Variable::Rotation => InputValue::Angle(super::arm::angle(value)),
            Variable::Translation => InputValue::Distance(Number::from_f64(value)),
        };
        Ok(Case::given(Input { joint, value }, 1))
    }

    /// All assembly modes at this value of the input.
    ///
    /// # Errors
    /// For a value that is not finite, and for loops that are not solved.
    pub fn solve(&self, input: f64) -> Result<Solution> {
        self.model.solve(&self.case(input)?, false)
    }

    /// Returns the document of `looproot sweep --json --scene`: all branches, circuits and limit positions while the input runs
    /// through a range. The sweep stops when `running` returns false; it is called now and then.
    ///
    /// # Errors
    /// For loops that are not solved.
    pub fn sweep(&self, range: Range, running: impl Fn() -> bool + Sync) -> Result<Value> {
        let (joint, variable) = self.input();
        self.model.sweep(joint, variable, range, running)
    }

    /// Returns the document of `looproot derive --json` at this value of the input.
    ///
    /// # Errors
    /// For a value that is not finite, and for loops whose closure polynomial is beyond `derive`.
    pub fn derive(&self, input: f64) -> Result<Value> {
        self.model.derive(&self.case(input)?)
    }

    /// Returns the document of `looproot mobility --json`.
    ///
    /// # Errors
    /// For loops whose mobility is not known.
    pub fn mobility(&self) -> Result<Value> {
        self.model.mobility()
    }

    /// Returns the certificate of the answer at this value of the input, which [`crate::verify`] checks.
    ///
    /// # Errors
    /// [`Error::Unsupported`] with the reason for an answer of which there is no certificate.
    pub fn certificate(&self, input: f64) -> Result<Value> {
        self.model.certificate(&self.case(input)?)
    }
}

impl Platform {
    /// A platform of a file or of the library.
    ///
    /// # Errors
    /// For a file or name that cannot be read, and for a mechanism that is no platform.
    pub fn from_file(name: &str) -> Result<Self> {
        Self::new(Model::load(name, None, None)?)
    }

    /// A platform of a file or of the library.
    ///
    /// # Errors
    /// For a file or name that cannot be read, and for a mechanism that is no platform.
    #[doc(hidden)]
    pub fn new(model: Model) -> Result<Self> {
        match model.entry.kind() {
            Kind::Platform => Ok(Self { model }),
            other => Err(Error::Invalid(format!("found {other:?}, expected a platform"))),
        }
    }

    /// A platform by the points of its base and of its plate.
    ///
    /// # Errors
    /// For numbers that are not finite.
    pub fn from_points(base: &[[f64; 3]; 6], plate: &[[f64; 3]; 6]) -> Result<Self> {
        finite("base", base.as_flattened())?;
        finite("plate", plate.as_flattened())?;
        let number = |points: &[[f64; 3]; 6]| points.map(|p| p.map(Number::from_f64));
        let geometry = crate::kinematics::platform::Platform { base: number(base), plate: number(plate) };
        Self::new(Model::bare("platform", Design::Platform(Box::new(geometry)), Vec::new(), false))
    }

    /// The case of legs of these lengths.
    ///
    /// # Errors
    /// For lengths that are negative or not finite.
    #[doc(hidden)]
    pub fn case(&self, legs: &[f64; 6]) -> Result<Case> {
        finite("legs", legs)?;
        if let Some(at) = legs.iter().position(|leg| *leg < 0.0) {
            return Err(Error::Invalid(format!("found {} at [{at}] of legs, expected 0 or more", legs[at])));
        }
        Ok(Case::legs(legs.map(|leg| Number::from_f64(leg).squared()), 1))
    }

    /// All poses with legs of these lengths.
    ///
    /// # Errors
    /// For lengths that are negative or not finite.
    pub fn solve(&self, legs: &[f64; 6]) -> Result<Solution> {
        self.model.solve(&self.case(legs)?, false)
    }

    /// Returns the document of `looproot derive --json` for legs of these lengths.
    ///
    /// # Errors
    /// For lengths that are negative or not finite.
    pub fn derive(&self, legs: &[f64; 6]) -> Result<Value> {
        self.model.derive(&self.case(legs)?)
    }

    /// Returns the certificate of the answer to legs of these lengths, which [`crate::verify`] checks.
    ///
    /// # Errors
    /// [`Error::Unsupported`] with the reason for an answer of which there is no certificate.
    pub fn certificate(&self, legs: &[f64; 6]) -> Result<Value> {
        self.model.certificate(&self.case(legs)?)
    }

    /// The lengths of the legs at a pose of the plate.
    ///
    /// # Errors
    /// For a matrix that is no pose.
    pub fn legs(&self, pose: &Matrix) -> Result<[f64; 6]> {
        let (placement, _) = placement(pose)?;
        let Design::Platform(geometry) = &self.model.entry.design else {
            return Err(Error::Invalid("found no platform, expected one".to_owned()));
        };
        let points = crate::mechanism::platform_over::<f64>(geometry);
        let points = points.ok_or_else(|| Error::Invalid("found points without numbers, expected some".to_owned()))?;
        Ok(points.legs_squared(&placement.float).map(f64::sqrt))
    }
}
