//! One branch of an assembly: the clusters of bodies that are glued so far, and where the bodies stand in them.

use super::isotropic::{Isotropic, Value, turn_within};
use super::quadratic::Top;
use super::tower::Surd;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use rug::Rational;

/// A number of an assembly and what stands for its conjugate.
pub type Number = Isotropic<Value>;

/// Half a number of an assembly: a value, or a function of an input and of unknown rotations.
pub trait Half: Ring {
    /// An exact complex number.
    fn exactly(z: &Gaussian) -> Self;
}

impl Half for Value {
    fn exactly(z: &Gaussian) -> Self {
        Self::exactly(z)
    }
}

/// An exact complex number as one of an assembly.
#[must_use]
pub fn number<R: Half>(z: &Gaussian) -> Isotropic<R> {
    let both = Isotropic::of(z);
    both.map(R::exactly)
}

/// A rational number as one of an assembly.
#[must_use]
pub fn real<R: Half>(q: &Rational) -> Isotropic<R> {
    number(&Gaussian { re: q.clone(), im: Rational::new() })
}

/// The place of a body or a cluster: p goes to `origin + turn p`.
#[derive(Clone, Debug, PartialEq)]
pub struct Place<R = Value> {
    /// The rotation.
    pub turn: Isotropic<R>,
    /// The place of the origin.
    pub origin: Isotropic<R>,
}

impl<R: Ring> Place<R> {
    /// No displacement.
    #[must_use]
    pub fn identity() -> Self {
        Self { turn: Isotropic::one(), origin: Isotropic::zero() }
    }

    /// The image of a point.
    #[must_use]
    pub fn apply(&self, point: &Isotropic<R>) -> Isotropic<R> {
        self.origin.add(&self.turn.mul(point))
    }

    /// This displacement behind another one.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        Self { turn: self.turn.mul(&first.turn), origin: self.apply(&first.origin) }
    }

    /// The displacement back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let turn = self.turn.mirrored();
        let origin = turn.mul(&self.origin).neg();
        Self { turn, origin }
    }
}

/// Clusters and places.
#[derive(Clone, Debug)]
pub struct State<R = Value> {
    /// For every body, the body that names its cluster, and its place there.
    pub bodies: Vec<(usize, Place<R>)>,
    /// The tower of square roots that holds all numbers.
    pub top: Top,
    /// Whether every number belongs to a real assembly.
    pub real: bool,
    /// The multiplicity of the branch.
    pub multiplicity: usize,
    /// The squares of the lengths of bodies that are bars and stand here by these alone.
    pub squares: Vec<Option<Rational>>,
}

impl<R> State<R> {
    /// Returns the state in other numbers.
    #[must_use]
    pub fn map<S>(&self, image: impl Fn(&R) -> S) -> State<S> {
        let place = |place: &Place<R>| Place { turn: place.turn.map(&image), origin: place.origin.map(&image) };
        let bodies = self.bodies.iter().map(|(cluster, own)| (*cluster, place(own))).collect();
        State {
            bodies,
            top: self.top.clone(),
            real: self.real,
            multiplicity: self.multiplicity,
            squares: self.squares.clone(),
        }
    }
}

impl<R: Ring> State<R> {
    /// Returns the state with every body on its own; square roots are kept exactly in towers of at most `highest` generators.
    #[must_use]
    pub fn new(bodies: usize, highest: usize) -> Self {
        let squares = vec![None; bodies];
        let bodies = (0..bodies).map(|body| (body, Place::identity())).collect();
        let top = Top { number: Surd::rational(&Rational::from(1)), highest };
        Self { bodies, top, real: true, multiplicity: 1, squares }
    }

    /// The square of the length of a bar that is a cluster by itself; 1 of other clusters.
    #[must_use]
    pub fn square_of(&self, cluster: usize) -> Rational {
        let bodies = self.bodies.iter().zip(&self.squares).filter(|((own, _), _)| *own == cluster);
        let mut squares = bodies.map(|(_, square)| square.as_ref());
        let first = squares.next().flatten();
        let is_bar = squares.all(|square| square == first);
        first.filter(|_| is_bar).cloned().unwrap_or_else(|| Rational::from(1))
    }

    /// Moves the cluster of `second` so that the body `second` stands at `place` against the body `first`, and makes
    /// one cluster of theirs.
    pub fn glue(&mut self, first: usize, second: usize, place: &Place<R>) {
        let (cluster, own) = self.bodies[first].clone();
        let (other, back) = (self.bodies[second].0, self.bodies[second].1.inverse());
        self.move_cluster(other, cluster, &own.after(place).after(&back));
    }

    /// Puts the bodies of a cluster into another one, moved by `place`.
    pub fn move_cluster(&mut self, cluster: usize, to: usize, place: &Place<R>) {
        for body in &mut self.bodies {
            if body.0 == cluster {
                *body = (to, place.after(&body.1));
            }
        }
    }

    /// Returns the place of a body relative to another one of the same cluster.
    #[must_use]
    pub fn against(&self, body: usize, base: usize) -> Place<R> {
        self.bodies[base].1.inverse().after(&self.bodies[body].1)
    }
}

/// The place of the second body against the first that a given value means, where it stands for all values within what encloses it.
#[must_use]
pub fn place_within(linkage: &Linkage, given: &Given) -> Option<Place> {
    let Given::Turn { joint, within: Some(within), .. } = given else { return place_of(linkage, given) };
    let turn = turn_within(within);
    Some(turned(linkage, *joint, turn))
}

/// The place of the second body of a revolute joint against the first.
#[must_use]
pub fn turned<R: Half>(linkage: &Linkage, joint: usize, turn: Isotropic<R>) -> Place<R> {
    let at = &linkage.joints[joint].at;
    let origin = number(&at[0]).sub(&turn.mul(&number(&at[1])));
    Place { turn, origin }
}

/// The place of the second body against the first that a given value means.
#[must_use]
pub fn place_of<R: Half>(linkage: &Linkage, given: &Given) -> Option<Place<R>> {
    Some(match given {
        Given::Turn { joint, turn, .. } => turned(linkage, *joint, number(turn)),
        Given::Shift { joint, shift, .. } => shifted(linkage, *joint, &real(shift))?,
        Given::Place { turn, origin, .. } => Place { turn: number(turn), origin: number(origin) },
    })
}

/// The place of the second body of a prismatic joint against the first; `None` for other joints.
#[must_use]
pub fn shifted<R: Half>(linkage: &Linkage, joint: usize, shift: &Isotropic<R>) -> Option<Place<R>> {
    let joint = &linkage.joints[joint];
    let Pair::Prismatic { turn, along, .. } = &joint.pair else { return None };
    let turn: Isotropic<R> = number(turn);
    let target = number(&joint.at[0]).add(&number(along).mul(shift));
    let origin = target.sub(&turn.mul(&number(&joint.at[1])));
    Some(Place { turn, origin })
}
