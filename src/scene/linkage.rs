//! Linkages: every body is the polygon of its points, every joint stands at its point. A planar linkage lies in the plane
//! z = 0; on the sphere the links are arcs of great circles.

use super::hull;
use super::lines::{axis, distance, minus};
use super::pose::{Pose, pose_of};
use super::{Body, Connection, ConnectionKind, Part, Point, Poser, Scene, Trace};
use crate::algebra::sort;
use crate::kinematics::joint::{JointKind, Variable};
use crate::kinematics::motion::{Motion, cross, dot};

/// Points nearer to each other than this part of the size of the linkage are one.
const SAME: f64 = 1e-9;
/// Straight pieces of a quarter of a great circle.
const PIECES: f64 = 16.0;

/// A body as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its name.
    pub name: String,
    /// Its points in its own frame; on the sphere of length 1.
    pub points: Vec<Point>,
}

/// A joint of two bodies.
#[derive(Clone, Debug)]
pub struct Hinge {
    /// Its name.
    pub name: String,
    /// Its number in the file, from 1.
    pub number: usize,
    /// R or P.
    pub kind: JointKind,
    /// Its bodies.
    pub of: [usize; 2],
    /// The frame of the joint in each of them, its z axis along the joint: the value is the motion of the second one.
    pub frames: [Motion<f64>; 2],
}

/// A linkage as it is drawn.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The bodies.
    pub bodies: Vec<Outline>,
    /// The joints that have a value.
    pub joints: Vec<Hinge>,
    /// The body that stands still.
    pub ground: usize,
    /// Whether the points are directions.
    pub on_sphere: bool,
    /// Points whose paths are drawn: a name, a body and where it is there.
    pub traces: Vec<(String, usize, Point)>,
}

/// Poses the bodies of a linkage along a tree of its joints.
#[derive(Clone, Debug)]
pub(super) struct TreePoser {
    /// The body of the figure behind every body of the scene.
    order: Vec<usize>,
    /// Number of joints that have a value.
    values: usize,
    /// One joint after the other: the body that is placed, the body that it hangs on, the joint, and whether it is the
    /// first body of the joint that is placed.
    steps: Vec<(usize, usize, usize, bool)>,
    joints: Vec<Hinge>,
}

impl TreePoser {
    /// The tree; `None` where a body is not joined to the ground.
    fn of(figure: &Figure) -> Option<Self> {
        let count = figure.bodies.len();
        let mut seen = vec![false; count];
        *seen.get_mut(figure.ground)? = true;
        let mut steps = Vec::new();
        while steps.len() + 1 < count {
            let next = figure.joints.iter().position(|joint| seen[joint.of[0]] != seen[joint.of[1]])?;
            let [a, b] = figure.joints[next].of;
            let (from, to) = if seen[a] { (a, b) } else { (b, a) };
            seen[to] = true;
            steps.push((to, from, next, to == a));
        }
        Some(Self {
            order: order(figure.bodies.len(), figure.ground),
            values: figure.joints.len(),
            steps,
            joints: figure.joints.clone(),
        })
    }

    pub(super) fn poses(&self, q: &[f64]) -> Option<Vec<Pose>> {
        if q.len() != self.values {
            return None;
        }
        let mut places = vec![Motion::identity(); self.order.len()];
        for (to, from, joint, is_first) in &self.steps {
            let Hinge { kind, frames, .. } = &self.joints[*joint];
            let moved = match kind.variables() {
                [Variable::Translation] => Motion::translation_z(q[*joint]),
                _ => Motion::rotation_z(q[*joint].cos(), q[*joint].sin()),
            };
            let step = frames[0].then_after(&moved).then_after(&frames[1].inverse());
            places[*to] = places[*from].then_after(&if *is_first { step.inverse() } else { step });
        }
        Some(self.order.iter().map(|body| pose_of(&places[*body])).collect())
    }
}

/// The numbers of the bodies of a figure, the ground first, the others as in the file.
pub(super) fn order(bodies: usize, ground: usize) -> Vec<usize> {
    let others = (0..bodies).filter(|body| *body != ground);
    [ground].into_iter().chain(others).collect()
}

/// The points of a body without those that coincide.
pub(super) fn different(points: &[Point], size: f64) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for point in points {
        if kept.iter().all(|own| distance(own, point) > SAME * size) {
            kept.push(*point);
        }
    }
    kept
}

/// The corners of the polygon about points of a plane, or those of a broken line through points in a line.
fn outline(points: &[Point], size: f64) -> Vec<Point> {
    let mut sorted = different(points, size);
    sort::by(&mut sorted, |a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let side = |a: &Point, b: &Point, c: &Point| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let half = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && side(a, b, point) <= SAME * size * size
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let (lower, upper) = (half(&mut sorted.iter()), half(&mut sorted.iter().rev()));
    if lower.len() + upper.len() > 2 { [lower, upper].concat() } else { sorted }
}

/// The arc of a great circle between two directions of length 1; any one between opposite directions.
fn arc(a: &Point, b: &Point) -> Vec<Point> {
    let mut normal = cross(a, b);
    let mut sine = dot(&normal, &normal).sqrt();
    let angle = sine.atan2(dot(a, b));
    if sine < SAME {
        let side = if a[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        normal = cross(a, &side);
        sine = dot(&normal, &normal).sqrt();
    }
    let pieces = (PIECES * angle / std::f64::consts::FRAC_PI_2).ceil().max(1.0);
    // The direction in the plane of both, perpendicular to the first.
    let across = cross(&normal.map(|x| x / sine), a);
    let mut points = Vec::new();
    let mut k = 0.0;
    while k <= pieces {
        let (sin, cos) = (angle * k / pieces).sin_cos();
        points.push(std::array::from_fn(|i| cos * a[i] + sin * across[i]));
        k += 1.0;
    }
    points
}

/// Directions in the order in which they stand about their mean.
fn around(points: &[Point]) -> Vec<Point> {
    let mut sorted = different(points, 1.0);
    if sorted.len() < 3 {
        return sorted;
    }
    let mean: Point = std::array::from_fn(|k| sorted.iter().map(|p| p[k]).sum());
    let first = cross(&mean, &sorted[0]);
    let second = cross(&mean, &first);
    sort::by(&mut sorted, |a, b| {
        let angle = |p: &Point| dot(p, &second).atan2(dot(p, &first));
        angle(a).total_cmp(&angle(b))
    });
    sorted.push(sorted[0]);
    sorted
}

/// What is drawn of a body: of the ground of a plane its joints alone.
fn parts(outline_of: &Outline, is_ground: bool, on_sphere: bool, size: f64) -> Vec<Part> {
    if on_sphere {
        let corners = around(&outline_of.points);
        let arcs = corners.windows(2).map(|pair| Part::Link { points: arc(&pair[0], &pair[1]) });
        return arcs.collect();
    }
    if is_ground {
        return Vec::new();
    }
    let mut corners = outline(&outline_of.points, size);
    match corners.len() {
        0 | 1 => Vec::new(),
        2 => vec![Part::Link { points: corners }],
        _ => {
            let triangles = hull(&corners);
            // Points in a line have no area.
            let mut parts = Vec::new();
            if !triangles.is_empty() {
                parts.push(Part::Hull { points: corners.clone(), triangles });
                corners.push(corners[0]);
            }
            parts.push(Part::Link { points: corners });
            parts
        }
    }
}

/// The scene of a linkage and what poses it; `None` where a body is not joined to the ground.
pub(super) fn scene(figure: &Figure) -> Option<(Scene, Poser)> {
    let poser = TreePoser::of(figure)?;
    let place = |body: usize| poser.order.iter().position(|own| *own == body);
    let extent =
        |points: &[Point]| points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b))).fold(0.0, f64::max);
    let largest = figure.bodies.iter().map(|body| extent(&body.points)).fold(0.0, f64::max);
    let size = if figure.on_sphere || largest == 0.0 { 1.0 } else { largest };
    let mut bodies: Vec<Body> = Vec::new();
    for body in &poser.order {
        let own = &figure.bodies[*body];
        bodies.push(Body { name: own.name.clone(), parts: parts(own, *body == figure.ground, figure.on_sphere, size) });
    }
    let mut connections = Vec::new();
    for joint in &figure.joints {
        let [first, second] = [place(joint.of[0])?, place(joint.of[1])?];
        let [at, mate] = [&joint.frames[0].translation, &joint.frames[1].translation];
        let is_slide = joint.kind == JointKind::Prismatic;
        // A slider is a block on its second body, a pin stands in its first one.
        let (body, frame) = if is_slide { (second, &joint.frames[1]) } else { (first, &joint.frames[0]) };
        let on_sphere = |p: &Point| if figure.on_sphere { axis(frame) } else { *p };
        let at_body = on_sphere(if is_slide { mate } else { at });
        bodies[body].parts.push(Part::Joint {
            joint: joint.number,
            kind: joint.kind,
            at: at_body,
            axis: axis(frame),
            label: Some(joint.name.clone()),
        });
        if is_slide {
            connections.push(Connection { kind: ConnectionKind::Travel, from: (first, *at), to: (second, *mate) });
        }
        // The ground of a plane is where its joints stand.
        if !figure.on_sphere {
            for (body, point) in [(first, at), (second, mate)] {
                let is_new = |part: &Part| !matches!(part, Part::Support { at } if distance(at, point) <= SAME * size);
                if body == 0 && bodies[0].parts.iter().all(is_new) {
                    bodies[0].parts.push(Part::Support { at: *point });
                }
            }
        }
    }
    let traces = figure
        .traces
        .iter()
        .filter_map(|(name, body, at)| Some(Trace { name: name.clone(), body: place(*body)?, at: *at }));
    let ground = &figure.bodies[figure.ground].points;
    let count = ground.len().max(1) as f64;
    let centre = if figure.on_sphere {
        [0.0; 3]
    } else {
        std::array::from_fn(|k| ground.iter().map(|p| p[k]).sum::<f64>() / count)
    };
    let traces = traces.collect();
    let scene = Scene { bodies, connections, centre, size, traces, is_flat: !figure.on_sphere };
    Some((scene, Poser::Tree(poser)))
}

/// The frame at a point of a plane: its z axis across the plane, or along a direction in it.
#[must_use]
pub fn planar_frame([x, y]: [f64; 2], along: Option<[f64; 2]>) -> Motion<f64> {
    let origin = [x, y, 0.0];
    match along {
        None => Motion::translation(origin),
        Some([u, v]) => {
            let length = u.hypot(v);
            let (u, v) = (u / length, v / length);
            // The columns are the normal of the direction, the normal of the plane, and the direction.
            Motion { rotation: [[-v, 0.0, u], [u, 0.0, v], [0.0, 1.0, 0.0]], translation: origin }
        }
    }
}

/// The frame of an axis on the sphere, with its x axis at a reference direction across it; `None` for directions without
/// length.
#[must_use]
pub fn spherical_frame(direction: &Point, reference: &Point) -> Option<Motion<f64>> {
    let unit = |v: &Point| {
        let length = dot(v, v).sqrt();
        (length > 0.0).then(|| v.map(|x| x / length))
    };
    let z = unit(direction)?;
    let along = dot(reference, &z);
    let x = unit(&minus(reference, &z.map(|c| c * along)))?;
    let y = cross(&z, &x);
    let rotation = std::array::from_fn(|k| [x[k], y[k], z[k]]);
    Some(Motion { rotation, translation: [0.0; 3] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn four_bar() -> Figure {
        let bar = |name: &str, points: &[Point]| Outline { name: name.to_owned(), points: points.to_vec() };
        let pin = |number: usize, of: [usize; 2], at: [[f64; 2]; 2]| Hinge {
            name: ["A", "B", "C", "D"][number - 1].to_owned(),
            number,
            kind: JointKind::Revolute,
            of,
            frames: at.map(|point| planar_frame(point, None)),
        };
        Figure {
            bodies: vec![
                bar("crank", &[[0.0; 3], [2.0, 0.0, 0.0]]),
                bar("frame", &[[0.0; 3], [6.0, 0.0, 0.0]]),
                bar("coupler", &[[0.0; 3], [5.0, 0.0, 0.0], [1.0, 2.0, 0.0]]),
                bar("rocker", &[[0.0; 3], [4.0, 0.0, 0.0]]),
            ],
            joints: vec![
                pin(1, [1, 0], [[0.0, 0.0], [0.0, 0.0]]),
                pin(2, [0, 2], [[2.0, 0.0], [0.0, 0.0]]),
                pin(3, [2, 3], [[5.0, 0.0], [4.0, 0.0]]),
                pin(4, [3, 1], [[0.0, 0.0], [6.0, 0.0]]),
            ],
            ground: 1,
            on_sphere: false,
            traces: vec![("coupler.P".to_owned(), 2, [1.0, 2.0, 0.0])],
        }
    }

    #[test]
    fn the_ground_stands_first_and_bodies_hang_on_their_joints() {
        let (scene, poser) = scene(&four_bar()).expect("joined to the ground");
        let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
        assert_eq!(names, ["frame", "crank", "coupler", "rocker"]);
        assert_eq!(scene.traces[0].body, 2);
        assert!(scene.is_flat);
        let Poser::Tree(poser) = poser else { panic!("a linkage is posed along a tree") };
        let half = std::f64::consts::FRAC_PI_2;
        let poses = poser.poses(&[half, -half, 0.0, 0.0]).expect("four values");
        // The crank stands upright, the coupler lies level at its end.
        assert!((poses[2][4]).abs() < 1e-15 && (poses[2][5] - 2.0).abs() < 1e-15, "{poses:?}");
        assert!((poses[2][0] - 1.0).abs() < 1e-15);
        assert!(poser.poses(&[0.0; 3]).is_none());
        let supports = scene.bodies[0].parts.iter().filter(|part| matches!(part, Part::Support { .. })).count();
        assert_eq!(supports, 2);
        assert!(scene.bodies[2].parts.iter().any(|part| matches!(part, Part::Hull { .. })));
    }

    #[test]
    fn arcs_lie_on_the_sphere() {
        let points = arc(&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0]);
        assert_eq!(points.len(), 17);
        assert!(points.iter().all(|p| (dot(p, p) - 1.0).abs() < 1e-14));
    }
}
