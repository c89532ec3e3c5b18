//! Trees of bodies: positions and rates by recursion and by the path matrix.

use crate::motion::{Motion, Vector, cross};
use looproot_algebra::ring::Ring;

/// Bodies in a tree: body k is carried by an earlier body or by the ground.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tree {
    parents: Vec<Option<usize>>,
}

impl Tree {
    /// Creates the tree in which `parents[k]` carries body k, or the ground if that is `None`. Returns `None` if a body is carried
    /// by a later one or by itself.
    #[must_use]
    pub fn new(parents: Vec<Option<usize>>) -> Option<Self> {
        let in_order = parents.iter().enumerate().all(|(k, parent)| parent.is_none_or(|parent| parent < k));
        in_order.then_some(Self { parents })
    }

    /// Returns the path matrix: entry (i, k) is whether joint k lies between the ground and body i. Joint k is the one that carries
    /// body k.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::tree::Tree;
    /// let tree = Tree::new(vec![None, Some(0), Some(0)]).unwrap();
    /// assert_eq!(tree.path_matrix()[2], [true, false, true]);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 11.2.2\]
    #[must_use]
    pub fn path_matrix(&self) -> Vec<Vec<bool>> {
        let mut rows: Vec<Vec<bool>> = Vec::new();
        for (k, parent) in self.parents.iter().enumerate() {
            let mut row = parent.map_or_else(|| vec![false; self.parents.len()], |parent| rows[parent].clone());
            row[k] = true;
            rows.push(row);
        }
        rows
    }

    /// Returns the positions of all bodies from that of each relative to the body that carries it, one body after the other. Over
    /// series this gives velocities and accelerations. `None` if the numbers of joints and bodies differ.
    #[must_use]
    pub fn placed<R: Ring>(&self, joints: &[Motion<R>]) -> Option<Vec<Motion<R>>> {
        if joints.len() != self.parents.len() {
            return None;
        }
        let mut places: Vec<Motion<R>> = Vec::new();
        for (parent, joint) in self.parents.iter().zip(joints) {
            let place = parent.map_or_else(|| joint.clone(), |parent| places[parent].then_after(joint));
            places.push(place);
        }
        Some(places)
    }

    /// Returns angular velocity of every body and velocity of its point at the origin, from the twists of the joints in axes fixed
    /// in space, by the path matrix: one sum over the joints on the path. `None` if the numbers of joints and bodies differ.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::tree::Tree;
    /// let tree = Tree::new(vec![None, Some(0)]).unwrap();
    /// let twists = [([0.0, 0.0, 1.0], [0.0; 3]), ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0])];
    /// // Two joints that turn against one another: the second body translates.
    /// assert_eq!(tree.twists(&twists).unwrap()[1], ([0.0; 3], [0.0, 1.0, 0.0]));
    /// ```
    #[must_use]
    pub fn twists<R: Ring>(&self, joints: &[Twist<R>]) -> Option<Vec<Twist<R>>> {
        if joints.len() != self.parents.len() {
            return None;
        }
        let zero = || -> Vector<R> { std::array::from_fn(|_| R::zero()) };
        let add = |x: &Vector<R>, y: &Vector<R>| std::array::from_fn(|i| x[i].add(&y[i]));
        let sum = |row: &Vec<bool>| {
            let on_the_way = row.iter().zip(joints).filter(|(is_on, _)| **is_on);
            on_the_way.fold((zero(), zero()), |(omega, v), (_, twist)| (add(&omega, &twist.0), add(&v, &twist.1)))
        };
        Some(self.path_matrix().iter().map(sum).collect())
    }
}

/// An angular velocity, and the velocity of the point at the origin.
pub type Twist<R> = (Vector<R>, Vector<R>);

/// Returns the twist of a revolute joint: its axis through a point, at a rate.
#[must_use]
pub fn turning<R: Ring>(point: &Vector<R>, axis: &Vector<R>, rate: &R) -> Twist<R> {
    let omega: Vector<R> = axis.each_ref().map(|c| c.mul(rate));
    let velocity = cross(point, &omega);
    (omega, velocity)
}
