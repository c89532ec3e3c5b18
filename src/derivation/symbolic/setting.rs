//! The quantities of a file that other numbers can replace.

use super::table::{self, Value, shown};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::catalogue::entry::{Case, Design, Entry, InputValue};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Placement};
use crate::kinematics::closed_loop::{Parameter, Variable};
use rug::Rational;

/// Coordinates of the position of a pose.
pub(super) const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// The position of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// A constant of a DH joint, counted from 0.
    Link(usize, Parameter),
    /// The input of a loop.
    Input,
    /// A coordinate of the position of a pose.
    Coordinate(usize),
    /// A leg of a platform, counted from 0.
    Leg(usize),
}

/// A quantity of a mechanism or of a case, by one variable: a length, a coordinate, the half-angle tangent of an angle.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    /// Its name in a request: `a1`, `alpha1`, `theta4`, `x`, `leg1`.
    pub name: String,
    /// The name of its variable: `a1`, `ta1`, `t4`, `x`, `leg1`.
    pub variable: String,
    /// The variable in the file; `None` for an angle of pi and for the square root of a number that is no square.
    pub value: Option<Rational>,
    /// The quantity in the file, for a reader.
    pub text: String,
    pub place: Place,
    /// The kind: an angle, whose variable is the half-angle tangent, or a length.
    pub kind: Variable,
}

impl Setting {
    /// Returns all quantities of a case.
    pub fn all(entry: &Entry, case: &Case) -> Vec<Self> {
        match &entry.design {
            Design::Arm(chain) | Design::Loop(chain) => {
                let links = of_links(chain, case);
                links.into_iter().chain(case.pose.iter().flat_map(of_pose)).collect()
            }
            Design::Platform(_) => case.legs_squared.iter().flat_map(of_legs).collect(),
        }
    }

    /// Returns those requested, in the order of the request.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a name that no quantity has, or that is requested twice.
    pub fn named(all: &[Self], wanted: &[String]) -> Result<Vec<Self>> {
        if let Some(twice) = wanted.iter().enumerate().find(|(k, name)| wanted[..*k].contains(name)) {
            return Err(Error::Invalid(format!("found the symbol {} twice, expected each name once", twice.1)));
        }
        let one = |name: &String| {
            all.iter().find(|one| one.name == *name).cloned().ok_or_else(|| {
                let known: Vec<&str> = all.iter().map(|one| one.name.as_str()).collect();
                if known.is_empty() {
                    return Error::Unsupported(format!("the symbol {name}, as axes given by screws are no parameters"));
                }
                Error::Invalid(format!("found the symbol {name}, expected some of {}", known.join(", ")))
            })
        };
        wanted.iter().map(one).collect()
    }

    /// Replaces the value of the variable by a number.
    pub fn put(&self, entry: &mut Entry, case: &mut Case, value: &Rational) {
        let angle = || Angle::from_half_tangent(HalfTangent::Finite(value.clone()));
        let number = || Number::exact(value.clone());
        match self.place {
            Place::Link(joint, parameter) => {
                let (Design::Arm(chain) | Design::Loop(chain)) = &mut entry.design else { return };
                let (Geometry::Dh(joints) | Geometry::ModifiedDh(joints)) = &mut chain.geometry else { return };
                let joint = &mut joints[joint];
                match parameter {
                    Parameter::Length => joint.a = number(),
                    Parameter::Twist => joint.alpha = angle(),
                    Parameter::Offset => joint.d = number(),
                    Parameter::Angle => joint.theta0 = angle(),
                }
            }
            Place::Input => {
                if let Some(input) = case.input.first_mut() {
                    match &mut input.value {
                        InputValue::Angle(old) => *old = angle(),
                        InputValue::Distance(old) => *old = number(),
                    }
                }
            }
            Place::Coordinate(k) => {
                if let Some(pose) = &mut case.pose {
                    let mut motion = pose.exact.motion();
                    motion.translation[k] = value.clone();
                    *pose = Placement::from_motion_exact(motion);
                }
            }
            Place::Leg(k) => {
                if let Some(squares) = &mut case.legs_squared {
                    squares[k] = Number::exact(Rational::from(value.square_ref()));
                }
            }
        }
    }
}

fn of_links(chain: &Chain, case: &Case) -> Vec<Setting> {
    let joints = match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => joints.as_slice(),
        // The coordinates of an axis are not independent.
        Geometry::Screws { .. } => &[],
    };
    let one = |(place, name, letters, value): table::Entry| {
        let (variable, number) = match &value {
            Value::Length(length) => (name.clone(), Some(length.rational().clone())),
            Value::Angle(angle) => {
                let number = match angle.half_tangent() {
                    HalfTangent::Finite(t) => Some(t.clone()),
                    HalfTangent::Infinite => None,
                };
                // The sine of `alpha1` is `sa1`, the half-angle tangent `ta1`.
                (format!("t{}", letters.last().map_or("", |sine| &sine[1..])), number)
            }
        };
        let place = place.map_or(Place::Input, |(joint, parameter)| Place::Link(joint, parameter));
        let kind = if matches!(value, Value::Angle(_)) { Variable::Rotation } else { Variable::Translation };
        Setting { name, variable, value: number, text: shown(&value), place, kind }
    };
    table::all(joints, case.input.first()).into_iter().map(one).collect()
}

fn of_pose(pose: &Placement) -> Vec<Setting> {
    let one = |k: usize| {
        let (name, value) = (COORDINATES[k].to_owned(), pose.exact.translation[k].clone());
        let text = value.to_string();
        let (variable, kind) = (name.clone(), Variable::Translation);
        Setting { variable, name, value: Some(value), text, place: Place::Coordinate(k), kind }
    };
    (0..3).map(one).collect()
}

fn of_legs(squares: &[Number; 6]) -> Vec<Setting> {
    let one = |(k, square): (usize, &Number)| {
        let name = format!("leg{}", k + 1);
        let square = square.rational();
        let (root, text) = match square_root(square) {
            Some(root) => (Some(root.clone()), root.to_string()),
            None => (None, format!("sqrt({square})")),
        };
        let (variable, kind) = (name.clone(), Variable::Translation);
        Setting { variable, name, value: root, text, place: Place::Leg(k), kind }
    };
    squares.iter().enumerate().map(one).collect()
}

fn square_root(square: &Rational) -> Option<Rational> {
    let is_square = square.numer().is_perfect_square() && square.denom().is_perfect_square();
    is_square.then(|| Rational::from((square.numer().clone().sqrt(), square.denom().clone().sqrt())))
}
