//! Poses as seven numbers: a unit quaternion `w, x, y, z` and a position.

use super::Point;
use crate::kinematics::motion::Motion;

/// A unit quaternion `w, x, y, z` and a position `x, y, z`.
pub type Pose = [f64; 7];

/// The pose of what has not moved.
pub(super) const IDENTITY: Pose = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];

/// Returns the pose of a rigid motion. There are four ways to read the quaternion off the matrix; the one with the largest
/// divisor is taken.
#[must_use]
pub fn pose_of(motion: &Motion<f64>) -> Pose {
    let r = &motion.rotation;
    let four_squares = [
        1.0 + r[0][0] + r[1][1] + r[2][2],
        1.0 + r[0][0] - r[1][1] - r[2][2],
        1.0 - r[0][0] + r[1][1] - r[2][2],
        1.0 - r[0][0] - r[1][1] + r[2][2],
    ];
    let largest = (1..4).fold(0, |best, k| if four_squares[k] > four_squares[best] { k } else { best });
    let (x, y, z) = (r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]);
    let (xy, xz, yz) = (r[0][1] + r[1][0], r[0][2] + r[2][0], r[1][2] + r[2][1]);
    let column = match largest {
        0 => [four_squares[0], x, y, z],
        1 => [x, four_squares[1], xy, xz],
        2 => [y, xy, four_squares[2], yz],
        _ => [z, xz, yz, four_squares[3]],
    };
    let norm = column.iter().map(|c| c * c).sum::<f64>().sqrt();
    let sign = if column[0] < 0.0 { -norm } else { norm };
    let [w, x, y, z] = column.map(|c| c / sign + 0.0);
    let [px, py, pz] = motion.translation;
    [w, x, y, z, px, py, pz]
}

/// Applies a pose to a point.
#[must_use]
pub fn apply(pose: &Pose, p: &Point) -> Point {
    let [w, x, y, z, px, py, pz] = *pose;
    let cross = |v: &Point| [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]];
    // p + 2 v x (v x p + w p) for the quaternion (w, v).
    let once = cross(p);
    let twice = cross(&[once[0] + w * p[0], once[1] + w * p[1], once[2] + w * p[2]]);
    [p[0] + 2.0 * twice[0] + px, p[1] + 2.0 * twice[1] + py, p[2] + 2.0 * twice[2] + pz]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_pose_moves_points_as_its_motion_does() {
        let turns = [(0.3, 0.2), (2.9, -3.0), (-1.5, 3.1), (PI - 1e-6, 0.0)];
        for (one, two) in turns.map(|(a, b): (f64, f64)| (a, b)) {
            let turned = Motion::rotation_z(one.cos(), one.sin()).then_after(&Motion::rotation_x(two.cos(), two.sin()));
            let motion = Motion { translation: [0.1, -2.0, 7.0], ..turned };
            let point = [0.5, -0.25, 1.5];
            let (found, expected) = (apply(&pose_of(&motion), &point), motion.apply(&point));
            assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-14), "{found:?} {expected:?}");
        }
    }
}
