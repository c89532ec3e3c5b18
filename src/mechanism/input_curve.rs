//! A loop followed through its input: velocities, accelerations and the points of its curve.

use super::FullMode;
use super::short_loop::filled_up;
use super::single_loop::locked_variable;
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::solve::curve::{ALONG_INPUT, Curve, INPUT, Point};

/// Condition numbers beyond this leave no digit of a derivative.
const SINGULAR: f64 = 1e13;

/// How the joints of a loop move with its input at one mode, in joint order.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives {
    /// `dq/dx`: the rates of all joint variables at input rate 1.
    pub velocity: Vec<f64>,
    /// `d2q/dx2`: their accelerations at input rate 1 and input acceleration 0. In general `q'' = d2q/dx2 w^2 + dq/dx a`.
    pub acceleration: Vec<f64>,
}

/// The curve of a loop, and its place among the joints.
pub struct InputCurve {
    layout: Layout,
    curve: Curve,
}

impl InputCurve {
    /// The curve of the loop of an entry, moved by the input of a case.
    ///
    /// # Errors
    /// [`Error::Invalid`] for arms and platforms, which have no input, and for joints without such a variable;
    /// [`Error::Unsupported`] for loops that are not solved.
    pub fn of(entry: &Entry, case: &Case) -> Result<Self> {
        let Design::Loop(chain) = &entry.design else {
            let what = if matches!(entry.design, Design::Arm(_)) { "an arm" } else { "a platform" };
            let message = format!("found {what}, which has no input to move by, expected a loop");
            return Err(Error::Invalid(message));
        };
        let locked = locked_variable(chain, case)?
            .ok_or_else(|| Error::Invalid("found no input, expected an input of a loop".to_owned()))?;
        let layout = filled_up(chain, Layout::of(chain, Some(locked))?)?;
        let input = layout.variables[locked];
        let idle = layout.joint_variables().map(|joint| joint.is_none());
        let curve = Curve::new(&chain.open_loop(&layout)?, idle, input);
        Ok(Self { layout, curve })
    }

    /// What each joint variable does, in joint order.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.layout.variables
    }

    /// Index of the input among the joint variables.
    #[must_use]
    pub fn input(&self) -> usize {
        self.layout.locked.unwrap_or(0)
    }

    /// The curve, which has its own order and scale.
    #[must_use]
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Which variable of a point is the first of the three of a ball, if there is one.
    #[must_use]
    pub fn ball(&self) -> Option<usize> {
        self.layout.ball_unknown()
    }

    /// A point of the curve from the joint variables in joint order.
    ///
    /// # Panics
    /// When `q` is not as long as there are joint variables.
    #[must_use]
    pub fn point(&self, q: &[f64]) -> Point {
        let unknowns = self.layout.unknowns(q).expect("one value for every joint variable");
        std::array::from_fn(|k| if k < INPUT { unknowns[k] } else { q[self.input()] } / self.curve.unit(k))
    }

    /// The joint variables in joint order at a point of the curve, angles as they are.
    #[must_use]
    pub fn joints(&self, point: &Point) -> Vec<f64> {
        let values: Point = std::array::from_fn(|k| point[k] * self.curve.unit(k));
        self.layout.assemble(&std::array::from_fn(|k| values[k]), values[INPUT])
    }

    /// Velocities and accelerations of all joints at a mode; `None` for complex and for singular ones.
    #[must_use]
    pub fn derivatives(&self, mode: &FullMode) -> Option<Derivatives> {
        let regular = mode.real && mode.multiplicity == 1 && mode.condition < SINGULAR;
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        regular.then(|| self.derivatives_at(&self.point(&q)))?
    }

    /// Velocities and accelerations of all joints at a point of the curve; `None` where the input is no coordinate of it.
    #[must_use]
    pub fn derivatives_at(&self, at: &Point) -> Option<Derivatives> {
        let [_, first, second] = self.curve.taylor::<3>(at, &ALONG_INPUT)?;
        // From the input in the unit of the curve to the input as it is given.
        let unit = self.curve.unit(INPUT);
        Some(Derivatives {
            velocity: self.joints(&first.map(|x| x / unit)),
            acceleration: self.joints(&second.map(|x| 2.0 * x / (unit * unit))),
        })
    }
}
