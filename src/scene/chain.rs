//! Arms and loops: links along the axes and the common normals between them, one rule for all conventions.
//!
//! Every joint has a marker on its axis, in the body before it: the foot of the common normal with the axis before. The
//! link behind it runs from there along its own axis, along the common normal, and along the next axis.

use super::lines::{Seat, axis, distance, feet};
use super::pose::{Pose, pose_of};
use super::{Body, Connection, ConnectionKind, Part, Point, Poser, Scene};
use crate::kinematics::chain::{Chain, JointKind};
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;

/// Corners nearer to each other than this part of the size of the mechanism are one.
const SAME: f64 = 1e-9;

/// Poses the bodies of a chain. The frame of a body is that of the joint before it, moved.
#[derive(Clone, Debug)]
pub(super) struct ChainPoser {
    kinds: Vec<JointKind>,
    /// Constant k stands before variable k, the last one behind them all.
    constants: Vec<Motion<f64>>,
    is_loop: bool,
}

impl ChainPoser {
    fn of(chain: &Chain, is_loop: bool) -> Option<Self> {
        let kinds = chain.joint_kinds();
        if kinds.is_empty() || kinds.iter().any(|kind| kind.row().has_pitch) {
            return None;
        }
        let (_, constants) = chain.unknowns_and_constants::<f64>()?;
        Some(Self { kinds, constants, is_loop })
    }

    /// The constant before joint j, from 0, and behind the last one.
    fn before(&self, joint: usize) -> &Motion<f64> {
        let variables: usize = self.kinds[..joint].iter().map(|kind| kind.freedoms()).sum();
        &self.constants[variables]
    }

    /// The poses of the bodies; the link behind the last joint of a loop is the ground.
    pub(super) fn poses(&self, q: &[f64]) -> Option<Vec<Pose>> {
        if q.len() + 1 != self.constants.len() {
            return None;
        }
        let mut frame = self.constants[0].clone();
        let mut poses = vec![super::pose::IDENTITY];
        let mut variable = 0;
        for kind in &self.kinds {
            for (turn, what) in kind.variables().iter().enumerate() {
                if turn > 0 {
                    frame = frame.then_after(&self.constants[variable]);
                }
                let moved = match what {
                    Variable::Rotation => Motion::rotation_z(q[variable].cos(), q[variable].sin()),
                    Variable::Translation => Motion::translation_z(q[variable]),
                };
                frame = frame.then_after(&moved);
                variable += 1;
            }
            poses.push(pose_of(&frame));
            frame = frame.then_after(&self.constants[variable]);
        }
        if self.is_loop {
            poses.pop();
        }
        Some(poses)
    }
}

/// The part of a chain drawn so far.
struct Drawing<'a> {
    poser: &'a ChainPoser,
    bodies: Vec<Body>,
    connections: Vec<Connection>,
    /// The sum of the lengths of the constants between the joints.
    size: f64,
}

impl Drawing<'_> {
    fn seat(&self, joint: usize, frame: &Motion<f64>) -> Seat {
        Seat::of(frame, self.poser.kinds[joint].has_one_axis())
    }

    fn translates(&self, joint: usize) -> bool {
        self.poser.kinds[joint].variables().contains(&Variable::Translation)
    }

    /// The marker of a joint in the body before it.
    fn mark(&mut self, body: usize, joint: usize, at: Point) {
        let kind = self.poser.kinds[joint];
        let part = Part::Joint { joint: joint + 1, kind, at, axis: axis(self.poser.before(joint)), label: None };
        self.bodies[body].parts.push(part);
    }

    /// Draws the link behind a joint up to the seat of what comes next, given in the frame of the joint, and returns the
    /// foot there. `into` is the frame of the body in which it is drawn.
    fn link(&mut self, joint: usize, marker: &Point, next: &Seat, into: (usize, &Motion<f64>)) -> Point {
        let height = self.poser.before(joint).inverse().apply(marker);
        let keep = if self.translates(joint) { [0.0; 3] } else { height };
        let own = self.seat(joint, &Motion::identity());
        let [mut first, mut foot] = feet(&own, next, &keep, self.size);
        // A loop comes back to a marker that is there already.
        if joint + 1 == self.poser.kinds.len() && self.poser.is_loop {
            foot = into.1.inverse().apply(&self.marker_of_first());
            first = own.nearest(&foot);
        }
        let (body, frame) = into;
        let corners = if self.translates(joint) {
            let rod =
                Connection { kind: ConnectionKind::Travel, from: (joint, *marker), to: (body, frame.apply(&first)) };
            self.connections.push(rod);
            vec![first, foot]
        } else {
            vec![height, first, foot]
        };
        let points = corners.iter().map(|p| frame.apply(p)).collect();
        self.rod(body, points);
        foot
    }

    fn marker_of_first(&self) -> Point {
        let at = self.bodies[0].parts.iter().find_map(|part| match part {
            Part::Joint { joint: 1, at, .. } => Some(*at),
            _ => None,
        });
        at.unwrap_or_default()
    }

    /// A link without corners that coincide.
    fn rod(&mut self, body: usize, mut points: Vec<Point>) {
        let same = SAME * self.size;
        points.dedup_by(|a, b| distance(a, b) <= same);
        if points.len() > 1 {
            self.bodies[body].parts.push(Part::Link { points });
        }
    }
}

fn drawing(poser: &ChainPoser, names: impl Iterator<Item = String>) -> Drawing<'_> {
    let lengths = poser.constants[1..].iter().map(|constant| distance(&constant.translation, &[0.0; 3]));
    let sum: f64 = lengths.sum();
    let bodies = names.map(|name| Body { name, parts: Vec::new() }).collect();
    Drawing { poser, bodies, connections: Vec::new(), size: if sum > 0.0 { sum } else { 1.0 } }
}

/// An arm from its base to its tool.
pub(super) fn open(chain: &Chain, links: Option<&[String; 2]>) -> Option<(Scene, Poser)> {
    let poser = ChainPoser::of(chain, false)?;
    let count = poser.kinds.len();
    let name = |body: usize| match (body, links) {
        (0, Some([base, _])) => base.clone(),
        (0, None) => "ground".to_owned(),
        (body, Some([_, tip])) if body == count => tip.clone(),
        _ => format!("link {body}"),
    };
    let mut drawing = drawing(&poser, (0..=count).map(name));
    let base = chain.base.float.translation;
    drawing.bodies[0].parts.push(Part::Frame { pose: pose_of(&chain.base.float) });
    let mut marker = drawing.seat(0, poser.before(0)).nearest(&base);
    drawing.rod(0, vec![base, marker]);
    drawing.mark(0, 0, marker);
    let here = Motion::identity();
    for joint in 0..count {
        let body = joint + 1;
        let frame = poser.before(body);
        if body < count {
            let next = drawing.seat(body, frame);
            marker = drawing.link(joint, &marker, &next, (body, &here));
            drawing.mark(body, body, marker);
        } else {
            drawing.link(joint, &marker, &Seat::Centre(frame.translation), (body, &here));
            drawing.bodies[body].parts.push(Part::Frame { pose: pose_of(frame) });
        }
    }
    let Drawing { bodies, connections, size, .. } = drawing;
    let scene = Scene { bodies, connections, centre: base, size, ..Scene::default() };
    Some((scene, Poser::Chain(poser)))
}

/// A loop; its last link is the ground.
pub(super) fn closed(chain: &Chain) -> Option<(Scene, Poser)> {
    let poser = ChainPoser::of(chain, true)?;
    let count = poser.kinds.len();
    let name = |body: usize| if body == 0 { "ground".to_owned() } else { format!("link {body}") };
    let mut drawing = drawing(&poser, (0..count).map(name));
    // The frame of the last joint, moved, in the ground, which is the link behind it.
    let last = poser.before(count).inverse();
    let first = poser.before(0);
    let start = drawing.seat(0, first);
    let keep = start.nearest(&[0.0; 3]);
    let [mut marker, _] = feet(&start, &drawing.seat(count - 1, &last), &keep, drawing.size);
    let centre = marker;
    drawing.mark(0, 0, marker);
    let here = Motion::identity();
    for joint in 0..count - 1 {
        let body = joint + 1;
        let next = drawing.seat(body, poser.before(body));
        marker = drawing.link(joint, &marker, &next, (body, &here));
        drawing.mark(body, body, marker);
    }
    let seat = drawing.seat(0, &poser.before(count).then_after(first));
    drawing.link(count - 1, &marker, &seat, (0, &last));
    let Drawing { bodies, connections, size, .. } = drawing;
    let scene = Scene { bodies, connections, centre, size: size / 2.0, ..Scene::default() };
    Some((scene, Poser::Chain(poser)))
}
