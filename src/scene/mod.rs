//! The scene of a mechanism: its bodies with their drawn parts, and the place of every body at a configuration.
//!
//! A scene is written once. A configuration adds one pose for every body, so that a program that draws need not know the
//! conventions of joints and links.

mod chain;
mod framework;
mod hull;
mod lines;
pub mod linkage;
mod platform;
mod pose;
pub mod space;

pub use hull::hull;
pub use pose::{Pose, apply, pose_of};

use crate::catalogue::entry::{Design, Entry};
use crate::kinematics::joint::JointKind;
use chain::ChainPoser;

/// A point of the space.
pub type Point = [f64; 3];

/// The bodies of a mechanism and what joins them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The bodies; the first one is the ground.
    pub bodies: Vec<Body>,
    /// Straight lines between two bodies.
    pub connections: Vec<Connection>,
    /// The centre of the mechanism.
    pub centre: Point,
    /// The approximate distance from there to its farthest points.
    pub size: f64,
    /// Points whose paths are drawn.
    pub traces: Vec<Trace>,
    /// Whether all of it lies in the plane z = 0, and is looked at from above.
    pub is_flat: bool,
}

/// A point of a body whose path is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Its name, `BODY.POINT`.
    pub name: String,
    /// The body.
    pub body: usize,
    /// Where it is in the frame of the body.
    pub at: Point,
}

/// One rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// The drawn parts, in its own frame.
    pub parts: Vec<Part>,
}

/// A drawn part of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// The joint to the next body.
    Joint {
        /// Its number, from 1.
        joint: usize,
        /// Its kind.
        kind: JointKind,
        /// A point of its axis.
        at: Point,
        /// The direction of its axis.
        axis: Point,
        /// Its name, where it has one.
        label: Option<String>,
    },
    /// A bearing of the ground.
    Support {
        /// Where it stands.
        at: Point,
    },
    /// A bent rod.
    Link {
        /// Its corners.
        points: Vec<Point>,
    },
    /// A frame, such as that of the tool.
    Frame {
        /// Its pose.
        pose: Pose,
    },
    /// A convex solid.
    Hull {
        /// Its points.
        points: Vec<Point>,
        /// Its faces.
        triangles: Vec<[usize; 3]>,
    },
}

/// The kind of a connection of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConnectionKind {
    /// A leg of a platform.
    Leg,
    /// The rod along which a joint P or C travels.
    Travel,
    /// A bar of a framework.
    Bar,
}

impl ConnectionKind {
    /// The word of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Leg => "leg",
            Self::Travel => "travel",
            Self::Bar => "bar",
        }
    }
}

/// A straight line between a point of one body and a point of another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Its kind.
    pub kind: ConnectionKind,
    /// A body and a point in its frame.
    pub from: (usize, Point),
    /// A body and a point in its frame.
    pub to: (usize, Point),
}

/// A scene, and how its bodies are posed.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The scene.
    pub scene: Scene,
    poser: Poser,
}

#[derive(Clone, Debug)]
enum Poser {
    Chain(ChainPoser),
    /// A plate before a base.
    Platform,
    /// Every body is a point.
    Points(usize),
    /// Bodies joined by pins and slides.
    Tree(linkage::TreePoser),
    /// Bodies whose places are known.
    Placed(space::PlacePoser),
}

impl Stage {
    /// The stage of an arm, a loop or a platform; `None` for joints whose motion is not drawn (H).
    #[must_use]
    pub fn of(entry: &Entry) -> Option<Self> {
        Self::of_design(&entry.design, entry.labels.links.as_ref())
    }

    /// The stage of a design alone; `links` are the names of the first and the last link of an arm.
    #[must_use]
    pub fn of_design(design: &Design, links: Option<&[String; 2]>) -> Option<Self> {
        let (scene, poser) = match design {
            Design::Arm(chain) => chain::open(chain, links)?,
            Design::Loop(chain) => chain::closed(chain)?,
            Design::Platform(geometry) => (platform::scene(geometry), Poser::Platform),
        };
        Some(Self { scene, poser })
    }

    /// The stage of a framework: every vertex is a body, every bar joins two of them.
    #[must_use]
    pub fn of_framework(names: &[String], vertices: &[Point], bars: &[[usize; 2]]) -> Self {
        Self { scene: framework::scene(names, vertices, bars), poser: Poser::Points(names.len()) }
    }

    /// The stage of a linkage; `None` where a body is not joined to the ground.
    #[must_use]
    pub fn of_linkage(figure: &linkage::Figure) -> Option<Self> {
        let (scene, poser) = linkage::scene(figure)?;
        Some(Self { scene, poser })
    }

    /// The stage of a linkage in space; `None` where a joint has no bodies.
    #[must_use]
    pub fn of_space(figure: &space::SpaceFigure) -> Option<Self> {
        let (scene, poser) = space::scene(figure)?;
        Some(Self { scene, poser })
    }

    /// Whether the numbers of a configuration are the places of all bodies.
    #[must_use]
    pub fn takes_places(&self) -> bool {
        matches!(self.poser, Poser::Placed(_))
    }

    /// Returns the poses of the bodies: of a chain or a linkage at these joint variables, of a platform at the quaternion `w, x, y, z` and the
    /// position of its plate, of a framework at the concatenated coordinates of its vertices, of a linkage in space at the quaternions and
    /// positions of its bodies in the order of the file. `None` for a list of another
    /// length, and for numbers that are not finite.
    #[must_use]
    pub fn poses(&self, q: &[f64]) -> Option<Vec<Pose>> {
        if !q.iter().all(|x| x.is_finite()) {
            return None;
        }
        match &self.poser {
            Poser::Chain(poser) => poser.poses(q),
            Poser::Tree(poser) => poser.poses(q),
            Poser::Placed(poser) => poser.poses(q),
            Poser::Platform => Some(vec![pose::IDENTITY, q.try_into().ok()?]),
            Poser::Points(count) => {
                let point = |p: &[f64]| [1.0, 0.0, 0.0, 0.0, p[0], p[1], p[2]];
                (q.len() == 3 * count).then(|| q.chunks_exact(3).map(point).collect())
            }
        }
    }
}
