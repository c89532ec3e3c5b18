//! The quantities of a file that other numbers can replace.

use super::table::{self, Value, shown};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::ring::exact_cos_sin;
use crate::catalogue::entry::{Case, Design, Entry, InputValue};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use crate::kinematics::closed_loop::{Parameter, Variable};
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// Coordinates of the position of a pose, and of a point.
pub(super) const COORDINATES: [&str; 3] = ["x", "y", "z"];
/// Turns of the tool at a pose about its own axes.
pub(super) const TURNS: [&str; 3] = ["turn_x", "turn_y", "turn_z"];
/// The bodies of a platform, whose points are numbered as the legs are.
const BODIES: [&str; 2] = ["base", "plate"];

/// The position of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// A constant of a DH joint, counted from 0.
    Link(usize, Parameter),
    /// The input of a loop.
    Input,
    /// A coordinate of the position of a pose.
    Coordinate(usize),
    /// A turn of the tool about one of its axes, after the pose of the file and the turns that are named before.
    Turn(usize),
    /// A coordinate of a point of the axis of a joint in screws, counted from 0.
    AxisPoint(usize, usize),
    /// A coordinate of a point of a platform: the body (0 for the base), the legs that meet there in the file, by bits, and the coordinate.
    Point(usize, usize, usize),
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
                let links = of_links(chain, case).into_iter().chain(of_axes(chain));
                links.chain(case.pose.iter().flat_map(of_pose)).collect()
            }
            Design::Platform(platform) => {
                case.legs_squared.iter().flat_map(of_legs).chain(of_points(platform)).collect()
            }
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
            Place::Turn(k) => {
                if let Some(pose) = &mut case.pose {
                    let (cos, sin) = exact_cos_sin(&angle());
                    let turned = pose.exact.motion().then_after(&Motion::rotation_about(k, cos, sin));
                    *pose = Placement::from_motion_exact(turned);
                }
            }
            Place::AxisPoint(joint, k) => {
                let (Design::Arm(chain) | Design::Loop(chain)) = &mut entry.design else { return };
                let Geometry::Screws { joints, .. } = &mut chain.geometry else { return };
                joints[joint].point[k] = number();
            }
            Place::Point(body, legs, k) => {
                let Design::Platform(platform) = &mut entry.design else { return };
                let points = if body == 0 { &mut platform.base } else { &mut platform.plate };
                for (_, point) in points.iter_mut().enumerate().filter(|(leg, _)| legs >> leg & 1 == 1) {
                    point[k] = number();
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

/// Returns a length or a coordinate.
fn length(name: String, value: &Rational, place: Place) -> Setting {
    let (variable, text, kind) = (name.replace('.', "_"), value.to_string(), Variable::Translation);
    Setting { variable, name, value: Some(value.clone()), text, place, kind }
}

fn of_pose(pose: &Placement) -> Vec<Setting> {
    let position = (0..3).map(|k| length(COORDINATES[k].to_owned(), &pose.exact.translation[k], Place::Coordinate(k)));
    let turns = (0..3).map(|k| {
        let (name, variable) = (TURNS[k].to_owned(), format!("t{}", COORDINATES[k]));
        let (value, text) = (Some(Rational::new()), "0".to_owned());
        Setting { name, variable, value, text, place: Place::Turn(k), kind: Variable::Rotation }
    });
    position.chain(turns).collect()
}

/// Returns the coordinates of the points of axes in screws. The direction of an axis is a unit vector, whose coordinates are not independent.
fn of_axes(chain: &Chain) -> Vec<Setting> {
    let Geometry::Screws { joints, .. } = &chain.geometry else { return Vec::new() };
    let has_point = |joint: &ScrewJoint| joint.kind != JointKind::Prismatic;
    let coordinates = |(number, joint): (usize, &ScrewJoint)| {
        let one = |(k, value): (usize, &Number)| {
            length(format!("point{}.{}", number + 1, COORDINATES[k]), value.rational(), Place::AxisPoint(number, k))
        };
        joint.point.iter().enumerate().map(one).collect::<Vec<_>>()
    };
    joints.iter().enumerate().filter(|(_, joint)| has_point(joint)).flat_map(coordinates).collect()
}

/// Returns the coordinates of the points of a platform, of a point in which legs meet once.
fn of_points(platform: &Platform<Number>) -> Vec<Setting> {
    let of_body = |(body, points): (usize, &[[Number; 3]; 6])| {
        let is_first = |leg: &usize| !points[..*leg].contains(&points[*leg]);
        let legs = |leg: usize| (0..6).filter(|other| points[*other] == points[leg]).map(|other| 1 << other).sum();
        let one = |leg: usize, k: usize| {
            let name = format!("{}{}.{}", BODIES[body], leg + 1, COORDINATES[k]);
            length(name, points[leg][k].rational(), Place::Point(body, legs(leg), k))
        };
        (0..6)
            .filter(is_first)
            .flat_map(|leg| (0..3).map(move |k| (leg, k)))
            .map(|(leg, k)| one(leg, k))
            .collect::<Vec<_>>()
    };
    [&platform.base, &platform.plate].into_iter().enumerate().flat_map(of_body).collect()
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
