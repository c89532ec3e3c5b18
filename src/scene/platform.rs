//! Platforms: two convex solids and six legs.

use super::lines::distance;
use super::{Body, Connection, ConnectionKind, Part, Point, Scene, hull};
use crate::algebra::number::Number;
use crate::kinematics::platform::Platform;

/// The base, the plate and the legs.
pub(super) fn scene(geometry: &Platform<Number>) -> Scene {
    let points = |points: &[[Number; 3]; 6]| points.each_ref().map(|p| p.each_ref().map(Number::to_f64));
    let (base, plate) = (points(&geometry.base), points(&geometry.plate));
    let centre: Point = std::array::from_fn(|k| base.iter().map(|p| p[k]).sum::<f64>() / 6.0);
    let reach = |points: &[Point; 6], from: &Point| points.iter().map(|p| distance(p, from)).fold(0.0, f64::max);
    let size = reach(&base, &centre).max(reach(&plate, &[0.0; 3]));
    let body = |name: &str, points: &[Point; 6]| Body {
        name: name.to_owned(),
        parts: vec![Part::Hull { points: points.to_vec(), triangles: hull(points) }],
    };
    let leg = |i: usize| Connection { kind: ConnectionKind::Leg, from: (0, base[i]), to: (1, plate[i]) };
    Scene {
        bodies: vec![body("base", &base), body("plate", &plate)],
        connections: (0..6).map(leg).collect(),
        centre,
        size: if size > 0.0 { size } else { 1.0 },
        ..Scene::default()
    }
}
