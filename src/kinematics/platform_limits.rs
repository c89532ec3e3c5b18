//! The limits of a platform as built: how far its legs reach, and how far the joints at their ends tilt.

use super::motion::{Motion, Vector, cross, dot};
use super::platform::Platform;
use rug::Rational;
use std::fmt;

/// An angle that exceeds its limit by less than this meets it: the angle of a leg is computed with a few roundings.
const ROUNDING: f64 = 1e-12;

/// The cone within which a joint holds its leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The axis, in the frame of the body that the joint belongs to, towards the other end of the leg; of any length but 0.
    pub axis: Vector<f64>,
    /// The largest angle between the leg and the axis, radians.
    pub angle: f64,
}

impl Cone {
    /// Returns whether the cone contains a direction. A leg without length has none and is within every cone.
    fn contains(&self, direction: &Vector<f64>) -> bool {
        let across = cross(&self.axis, direction);
        let angle = dot(&across, &across).sqrt().atan2(dot(&self.axis, direction));
        angle <= self.angle + ROUNDING
    }
}

/// The limits of a platform; those that are not given do not bound it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlatformLimits {
    /// The squares of the shortest and the longest length of every leg.
    pub legs_squared: Option<[[Rational; 2]; 6]>,
    /// The cones of the joints at the base.
    pub base: Option<[Cone; 6]>,
    /// The cones of the joints at the plate.
    pub plate: Option<[Cone; 6]>,
}

/// A part of a platform that a limit concerns, its leg counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The length of a leg.
    Leg(usize),
    /// The joint at the base.
    Base(usize),
    /// The joint at the plate.
    Plate(usize),
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Leg(leg) => write!(f, "leg {}", leg + 1),
            Self::Base(leg) => write!(f, "base joint {}", leg + 1),
            Self::Plate(leg) => write!(f, "plate joint {}", leg + 1),
        }
    }
}

/// Returns the parts in words: `leg 2, base joints 1, 5, all plate joints`.
#[must_use]
pub fn listed(parts: &[Part]) -> String {
    let of = |noun: &str, number: fn(&Part) -> Option<usize>| {
        let numbers: Vec<String> = parts.iter().filter_map(number).map(|leg| (leg + 1).to_string()).collect();
        match numbers.len() {
            0 => None,
            1 => Some(format!("{noun} {}", numbers[0])),
            6 => Some(format!("all {noun}s")),
            _ => Some(format!("{noun}s {}", numbers.join(", "))),
        }
    };
    let legs = of("leg", |part| if let Part::Leg(leg) = part { Some(*leg) } else { None });
    let base = of("base joint", |part| if let Part::Base(leg) = part { Some(*leg) } else { None });
    let plate = of("plate joint", |part| if let Part::Plate(leg) = part { Some(*leg) } else { None });
    legs.into_iter().chain(base).chain(plate).collect::<Vec<_>>().join(", ")
}

impl PlatformLimits {
    /// Returns whether nothing is limited.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.legs_squared.is_none() && self.base.is_none() && self.plate.is_none()
    }

    /// Returns the legs that are too short or too long; exact.
    #[must_use]
    pub fn legs_outside(&self, squares: &[Rational; 6]) -> Vec<Part> {
        let Some(limits) = &self.legs_squared else { return Vec::new() };
        let is_outside = |leg: &usize| squares[*leg] < limits[*leg][0] || squares[*leg] > limits[*leg][1];
        (0..6).filter(is_outside).map(Part::Leg).collect()
    }

    /// Returns the joints whose legs leave their cones at a pose of the plate.
    #[must_use]
    pub fn joints_outside(&self, platform: &Platform<f64>, pose: &Motion<f64>) -> Vec<Part> {
        let legs = platform.legs(pose);
        let back = Motion { rotation: pose.rotation, translation: [0.0; 3] }.inverse();
        let is_left = |cones: &Option<[Cone; 6]>, leg: usize, direction: Vector<f64>| {
            cones.as_ref().is_some_and(|cones| !cones[leg].contains(&direction))
        };
        let base = (0..6).filter(|leg| is_left(&self.base, *leg, legs[*leg])).map(Part::Base);
        let down = |leg: usize| back.rotate(&legs[leg].map(|x| -x));
        let plate = (0..6).filter(|leg| is_left(&self.plate, *leg, down(*leg))).map(Part::Plate);
        base.chain(plate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_cone_holds_what_is_near_its_axis() {
        let cone = Cone { axis: [0.0, 0.0, 2.0], angle: PI / 4.0 };
        assert!(cone.contains(&[0.0, 0.0, 5.0]) && cone.contains(&[1.0, 0.0, 1.0]) && cone.contains(&[0.0; 3]));
        assert!(!cone.contains(&[1.001, 0.0, 1.0]) && !cone.contains(&[0.0, 0.0, -1.0]));
        // More than a right angle.
        let wide = Cone { axis: [0.0, 0.0, 1.0], angle: 0.75 * PI };
        assert!(wide.contains(&[1.0, 0.0, -0.9]) && !wide.contains(&[1.0, 0.0, -1.1]));
    }

    #[test]
    fn legs_and_joints_outside_are_named() {
        let hexagon: [Vector<f64>; 6] = std::array::from_fn(|k| {
            let (sin, cos) = (k as f64 * PI / 3.0).sin_cos();
            [cos, sin, 0.0]
        });
        let platform = Platform { base: hexagon, plate: hexagon };
        let up = |x: f64| Motion { rotation: Motion::identity().rotation, translation: [x, 0.0, 2.0] };
        let cones = Some([Cone { axis: [0.0, 0.0, 1.0], angle: 0.3 }; 6]);
        let down = Some([Cone { axis: [0.0, 0.0, -1.0], angle: 0.5 }; 6]);
        let limits = PlatformLimits { base: cones, plate: down, legs_squared: None };
        assert!(limits.joints_outside(&platform, &up(0.0)).is_empty());
        // The legs are tilted by atan(0.4) = 0.38, then by atan(0.6) = 0.54.
        assert_eq!(limits.joints_outside(&platform, &up(0.8)), (0..6).map(Part::Base).collect::<Vec<_>>());
        assert_eq!(limits.joints_outside(&platform, &up(1.2)).len(), 12);
        let range = || [Rational::from(4), Rational::from((441, 100))];
        let limits = PlatformLimits { legs_squared: Some(std::array::from_fn(|_| range())), ..limits };
        let mut squares: [Rational; 6] = std::array::from_fn(|_| Rational::from(4));
        assert!(limits.legs_outside(&squares).is_empty(), "a limit that is met is respected");
        squares[1] = Rational::from((4411, 1000));
        squares[4] = Rational::from((3999, 1000));
        assert_eq!(limits.legs_outside(&squares), [Part::Leg(1), Part::Leg(4)]);
        let all: Vec<Part> = (0..6).map(Part::Plate).collect();
        let parts = [&[Part::Leg(1), Part::Base(0), Part::Base(4)][..], &all].concat();
        assert_eq!(listed(&parts), "leg 2, base joints 1, 5, all plate joints");
        assert_eq!(
            [Part::Leg(1), Part::Base(0), Part::Plate(5)].map(|part| part.to_string()),
            ["leg 2", "base joint 1", "plate joint 6"]
        );
    }
}
