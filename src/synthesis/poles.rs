//! Poles of positions in the plane: the points that stay in place from one position to another.

use crate::catalogue::{Space, SynthesisFile, Task};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// The pole of two positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// The positions, counted from 0.
    pub positions: [usize; 2],
    /// The pole in coordinates of the ground.
    pub fixed: [Rational; 2],
    /// The pole in coordinates of the body.
    pub moving: [Rational; 2],
}

/// Returns the poles of all pairs of positions in the plane that differ by a rotation; none of other tasks.
#[must_use]
pub fn poles(file: &SynthesisFile) -> Vec<Pole> {
    let Task::Motion(_, positions) = &file.task else { return Vec::new() };
    if file.space != Space::Plane {
        return Vec::new();
    }
    let mut list = Vec::new();
    for i in 0..positions.len() {
        for j in i + 1..positions.len() {
            list.extend(pole(&positions[i], &positions[j]).map(|fixed| {
                let [x, y] = fixed.clone();
                let [x, y, _] = positions[i].inverse().apply(&[x, y, Rational::new()]);
                Pole { positions: [i, j], fixed, moving: [x, y] }
            }));
        }
    }
    list
}

/// The point of the body that stands at the same place of the ground in two positions, in the ground's coordinates.
pub(super) fn pole(one: &Motion<Rational>, other: &Motion<Rational>) -> Option<[Rational; 2]> {
    // From the first position to the second: x -> R x + t, and (I - R) x = t.
    let relative = other.then_after(&one.inverse());
    let (cos, sin) = (&relative.rotation[0][0], &relative.rotation[1][0]);
    let [x, y, _] = &relative.translation;
    let off = Rational::from(1 - cos);
    let square = Rational::from(&off * &off) + Rational::from(sin * sin);
    if square == 0 {
        return None;
    }
    let first = Rational::from(&off * x) - Rational::from(sin * y);
    let second = Rational::from(sin * x) + Rational::from(&off * y);
    Some([first / &square, second / square])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{Any, Options, builtin_any};
    use crate::synthesis::synthesize;

    /// Circle points and centre points of four positions run through their poles, seen from the body and from the ground.
    #[test]
    fn curves_of_four_positions_run_through_their_poles() {
        let Ok(Any::Synthesis(file)) = builtin_any("synthesis/burmester4_a", &Options::default()) else {
            panic!("a synthesis");
        };
        let found = poles(&file);
        assert_eq!(found.len(), 6);
        for curve in synthesize(&file).curves {
            for pole in &found {
                let [x, y] = if curve.of == "fixed" { &pole.fixed } else { &pole.moving };
                assert_eq!(curve.exact(x, y), 0, "{:?} on the curve of {}", pole.positions, curve.name);
            }
        }
    }

    #[test]
    fn translations_have_no_pole() {
        let mut shifted = Motion::<Rational>::identity();
        shifted.translation[0] = Rational::from(2);
        assert_eq!(pole(&Motion::identity(), &shifted), None);
    }
}
