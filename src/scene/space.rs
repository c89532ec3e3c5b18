//! Linkages in space: every body is the solid of its points, a rod is a line between two bodies.

use super::hull;
use super::lines::distance;
use super::linkage::{Outline, different, order};
use super::pose::Pose;
use super::{Body, Connection, ConnectionKind, Part, Point, Poser, Scene, Trace};
use crate::kinematics::joint::JointKind;
use crate::kinematics::motion::dot;

/// The distance of the two rods of a parallelogram in parts of the size of the linkage: they are seen as two.
const RODS_APART: f64 = 0.06;

/// What is drawn of a joint.
#[derive(Clone, Debug)]
pub enum Bond {
    /// A joint at a point of both bodies, with the direction of its axis in each of them.
    Joint(JointKind, [Point; 2]),
    /// A rod or a leg between a point of one body and a point of the other one.
    Rod,
    /// Two parallel rods, with the direction of their axes in both bodies.
    Parallelogram([Point; 2]),
}

/// A joint of two bodies.
#[derive(Clone, Debug)]
pub struct SpaceHinge {
    /// Its name.
    pub name: String,
    /// Its number in the file, from 1.
    pub number: usize,
    /// Its bodies.
    pub of: [usize; 2],
    /// Its point in each of them.
    pub at: [Point; 2],
    /// What is drawn of it.
    pub bond: Bond,
}

/// A linkage in space as it is drawn.
#[derive(Clone, Debug)]
pub struct SpaceFigure {
    /// The bodies.
    pub bodies: Vec<Outline>,
    /// The joints.
    pub joints: Vec<SpaceHinge>,
    /// The body that stands still.
    pub ground: usize,
    /// Points whose paths are drawn: a name, a body and where it is there.
    pub traces: Vec<(String, usize, Point)>,
}

/// Poses bodies whose quaternions and positions are known.
#[derive(Clone, Debug)]
pub(super) struct PlacePoser {
    /// The body of the figure behind every body of the scene.
    order: Vec<usize>,
}

impl PlacePoser {
    /// The poses of the scene from those of all bodies, seven numbers for each.
    pub(super) fn poses(&self, q: &[f64]) -> Option<Vec<Pose>> {
        if q.len() != 7 * self.order.len() {
            return None;
        }
        self.order.iter().map(|body| q[7 * body..7 * body + 7].try_into().ok()).collect()
    }
}

/// The largest distance of two points.
fn extent(points: &[Point]) -> f64 {
    points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b))).fold(0.0, f64::max)
}

/// The solid of the points of a body, or the line through them.
fn parts(points: &[Point], size: f64) -> Vec<Part> {
    let points = different(points, size);
    let triangles = hull(&points);
    if !triangles.is_empty() {
        return vec![Part::Hull { points, triangles }];
    }
    // Points in a line: its ends are farthest from each other. They may be one.
    let pairs = points.iter().flat_map(|a| points.iter().map(move |b| [*a, *b]));
    let longest = pairs.max_by(|[a, b], [c, d]| distance(a, b).total_cmp(&distance(c, d)));
    longest.map(|ends| Part::Link { points: different(&ends, size) }).into_iter().collect()
}

/// A point moved along a direction.
fn moved(point: &Point, direction: &Point, by: f64) -> Point {
    let length = dot(direction, direction).sqrt();
    if length > 0.0 { std::array::from_fn(|k| point[k] + direction[k] * by / length) } else { *point }
}

/// Draws a joint of the bodies `of` of the scene.
fn join(joint: &SpaceHinge, of: [usize; 2], size: f64, bodies: &mut [Body], connections: &mut Vec<Connection>) {
    let mut line = |kind: ConnectionKind, at: [Point; 2]| {
        connections.push(Connection { kind, from: (of[0], at[0]), to: (of[1], at[1]) });
    };
    match &joint.bond {
        Bond::Joint(kind, axes) => {
            // A slider is a block on its second body, the others stand in their first one.
            let side = usize::from(*kind == JointKind::Prismatic);
            bodies[of[side]].parts.push(Part::Joint {
                joint: joint.number,
                kind: *kind,
                at: joint.at[side],
                axis: axes[side],
                label: Some(joint.name.clone()),
            });
            if *kind == JointKind::Prismatic {
                line(ConnectionKind::Travel, joint.at);
            }
        }
        Bond::Rod => line(ConnectionKind::Leg, joint.at),
        Bond::Parallelogram(axes) => {
            let half = 0.5 * RODS_APART * size;
            let ends = [-half, half].map(|by| [0, 1].map(|side| moved(&joint.at[side], &axes[side], by)));
            for at in ends {
                line(ConnectionKind::Leg, at);
            }
            for side in 0..2 {
                let points = ends.map(|at| at[side]).to_vec();
                bodies[of[side]].parts.push(Part::Link { points });
            }
        }
    }
}

/// The scene of a linkage in space and what poses it.
pub(super) fn scene(figure: &SpaceFigure) -> Option<(Scene, Poser)> {
    let order = order(figure.bodies.len(), figure.ground);
    let place = |body: usize| order.iter().position(|own| *own == body);
    let largest = figure.bodies.iter().map(|body| extent(&body.points)).fold(0.0, f64::max);
    let size = if largest > 0.0 { largest } else { 1.0 };
    let body = |own: &usize| {
        let outline = &figure.bodies[*own];
        Body { name: outline.name.clone(), parts: parts(&outline.points, size) }
    };
    let mut bodies: Vec<Body> = order.iter().map(body).collect();
    let mut connections = Vec::new();
    for joint in &figure.joints {
        join(joint, [place(joint.of[0])?, place(joint.of[1])?], size, &mut bodies, &mut connections);
    }
    let traces = figure
        .traces
        .iter()
        .filter_map(|(name, body, at)| Some(Trace { name: name.clone(), body: place(*body)?, at: *at }));
    let traces = traces.collect();
    let ground = &figure.bodies.get(figure.ground)?.points;
    let count = ground.len().max(1) as f64;
    let centre = std::array::from_fn(|k| ground.iter().map(|p| p[k]).sum::<f64>() / count);
    let scene = Scene { bodies, connections, centre, size, traces, is_flat: false };
    Some((scene, Poser::Placed(PlacePoser { order })))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_solids_and_rods_are_lines() {
        let outline = |name: &str, points: &[Point]| Outline { name: name.to_owned(), points: points.to_vec() };
        let hinge = |number: usize, at: [Point; 2], bond: Bond| SpaceHinge {
            name: format!("J{number}"),
            number,
            of: [0, 1],
            at,
            bond,
        };
        let z = [0.0, 0.0, 1.0];
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let figure = SpaceFigure {
            bodies: vec![outline("plate", &corners), outline("base", &[[0.0; 3], [0.0, 0.0, 2.0]])],
            joints: vec![
                hinge(1, [[0.0; 3]; 2], Bond::Joint(JointKind::Spherical, [z; 2])),
                hinge(2, [corners[1], [0.0, 0.0, 2.0]], Bond::Rod),
                hinge(3, [corners[2], [0.0; 3]], Bond::Parallelogram([[2.0, 0.0, 0.0]; 2])),
            ],
            ground: 1,
            traces: vec![("plate.P".to_owned(), 0, corners[1])],
        };
        let (scene, poser) = scene(&figure).expect("a scene");
        let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
        assert_eq!(names, ["base", "plate"]);
        assert_eq!(scene.connections.len(), 3);
        assert!(matches!(scene.bodies[0].parts[0], Part::Link { .. }));
        assert!(matches!(scene.bodies[1].parts[0], Part::Hull { .. }));
        // The rods of the parallelogram are 0.06 of the size 2 apart.
        let ends = [1, 2].map(|k| scene.connections[k].from.1);
        assert!((distance(&ends[0], &ends[1]) - 0.12).abs() < 1e-15, "{ends:?}");
        assert_eq!(scene.traces[0].body, 1);
        let Poser::Placed(poser) = poser else { panic!("bodies are placed") };
        let q: Vec<f64> = (0..14).map(f64::from).collect();
        let poses = poser.poses(&q).expect("two bodies");
        assert!(poses[0][0] == 7.0 && poses[1][0] == 0.0);
        assert!(poser.poses(&q[1..]).is_none());
    }
}
