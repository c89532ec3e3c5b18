//! The spherical image of a loop of revolute joints: directions only, and their conditions on lengths.

use super::finite_field::Turn;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::ansatz::Link;
use crate::kinematics::motion::{Motion, Vector};

/// The axes of a loop and its common normals as directions in the frame of the first link.
#[derive(Clone, Debug)]
pub struct Directions<F> {
    /// `z_k`, the axis of joint k.
    pub axes: Vec<Vector<F>>,
    /// `x_k`, the common normal of axes k and k + 1.
    pub normals: Vec<Vector<F>>,
    /// The product of all rotations and twists.
    pub product: [[F; 3]; 3],
}

impl<F: Ring> Directions<F> {
    /// Returns the directions for given rotations of the joints.
    #[must_use]
    pub fn of(links: &[Link<F>], turns: &[Turn<F>]) -> Self {
        let (mut axes, mut normals) = (Vec::new(), Vec::new());
        let mut frame = Motion::identity();
        for (link, (cos, sin)) in links.iter().zip(turns) {
            frame = frame.then_after(&Motion::rotation_z(cos.clone(), sin.clone()));
            let column = |j: usize| -> Vector<F> { std::array::from_fn(|i| frame.rotation[i][j].clone()) };
            axes.push(column(2));
            normals.push(column(0));
            frame = frame.then_after(&Motion::rotation_x(link.cos.clone(), link.sin.clone()));
        }
        Self { axes, normals, product: frame.rotation }
    }

    /// Returns whether the rotations close.
    #[must_use]
    pub fn closes(&self) -> bool {
        self.product == Motion::<F>::identity().rotation
    }

    /// Returns `sum_k a_k x_k + d_k z_k`, which vanishes if the loop closes with these lengths.
    ///
    /// # Shape
    /// All `a` first, then all `d`.
    #[must_use]
    pub fn translation(&self, lengths: &[F]) -> Vector<F> {
        let mut sum: Vector<F> = std::array::from_fn(|_| F::zero());
        for (direction, length) in self.normals.iter().chain(&self.axes).zip(lengths) {
            for (total, component) in sum.iter_mut().zip(direction) {
                total.add_product(length, component);
            }
        }
        sum
    }

    /// Returns the three equations `sum_k a_k x_k + d_k z_k = 0` as rows in the lengths, all `a` first.
    #[must_use]
    pub fn equations(&self) -> [Vec<F>; 3] {
        std::array::from_fn(|i| self.normals.iter().chain(&self.axes).map(|direction| direction[i].clone()).collect())
    }
}

/// Three joints that close a rotation: `Rz(p) A Rz(q) B Rz(r) C = 1`, with the rotations A, B and C given.
///
/// The third row of the third column gives `f + c cos q + s sin q = 0`; whether it can be solved depends on
/// `D = c^2 + s^2 - f^2`.
#[derive(Clone, Debug)]
pub struct Triad<F> {
    links: [Motion<F>; 3],
    constant: F,
    cos: F,
    sin: F,
}

impl<F: Field> Triad<F> {
    /// Creates the triad with these rotations behind its joints.
    #[must_use]
    pub fn new(links: [Motion<F>; 3]) -> Self {
        let [a, b, c] = links.each_ref().map(|link| &link.rotation);
        let cos = a[2][0].mul(&b[0][2]).add(&a[2][1].mul(&b[1][2]));
        let sin = a[2][1].mul(&b[0][2]).sub(&a[2][0].mul(&b[1][2]));
        let constant = a[2][2].mul(&b[2][2]).sub(&c[2][2]);
        Self { links, constant, cos, sin }
    }

    /// D.
    #[must_use]
    pub fn discriminant(&self) -> F {
        self.cos.mul(&self.cos).add(&self.sin.mul(&self.sin)).sub(&self.constant.mul(&self.constant))
    }

    /// Returns the three rotations for one square root of D; `None` in a position in which they are not determined.
    #[must_use]
    pub fn turns(&self, root: &F) -> Option<[Turn<F>; 3]> {
        let inverse = self.cos.mul(&self.cos).add(&self.sin.mul(&self.sin)).inverse()?;
        let (f, c, s) = (&self.constant, &self.cos, &self.sin);
        let cos = s.mul(root).sub(&c.mul(f)).mul(&inverse);
        let sin = s.mul(f).add(&c.mul(root)).neg().mul(&inverse);
        let [a, b, last] = &self.links;
        let between = a.then_after(&Motion::rotation_z(cos.clone(), sin.clone())).then_after(b).rotation;
        let target = last.inverse().rotation;
        let column = |m: &[[F; 3]; 3]| [m[0][2].clone(), m[1][2].clone()];
        let row = |m: &[[F; 3]; 3]| [m[2][0].clone(), m[2][1].clone()];
        let first = carry(&column(&between), &column(&target))?;
        // A row times Rz rotates in the opposite sense.
        let (third, minus) = carry(&row(&between), &row(&target))?;
        Some([first, (cos, sin), (third, minus.neg())])
    }
}

/// Returns the rotation that carries one plane vector to another of the same length; `None` if the square of the length is 0.
fn carry<F: Field>(from: &[F; 2], to: &[F; 2]) -> Option<Turn<F>> {
    let inverse = from[0].mul(&from[0]).add(&from[1].mul(&from[1])).inverse()?;
    let cos = from[0].mul(&to[0]).add(&from[1].mul(&to[1])).mul(&inverse);
    let sin = from[0].mul(&to[1]).sub(&from[1].mul(&to[0])).mul(&inverse);
    Some((cos, sin))
}

/// Returns the configurations of the spherical image in which the joints outside `closing` have the given rotations: at most
/// two, each with all rotations round the loop.
///
/// # Panics
/// Unless the three joints are given in increasing order.
pub fn closed_by<F: Field>(
    links: &[Link<F>],
    turns: &[Turn<F>],
    closing: [usize; 3],
    square_root: impl Fn(&F) -> Option<F>,
) -> Vec<Vec<Turn<F>>> {
    let triad = triad(links, turns, closing);
    let Some(root) = square_root(&triad.discriminant()) else { return Vec::new() };
    let roots = if root.is_zero() { vec![root] } else { vec![root.neg(), root] };
    let complete = |root: &F| {
        let mut all = turns.to_vec();
        for (joint, turn) in closing.into_iter().zip(triad.turns(root)?) {
            all[joint] = turn;
        }
        Some(all)
    };
    roots.iter().filter_map(complete).collect()
}

/// Returns the triad of three joints when the others have the given rotations.
///
/// # Panics
/// Unless the three joints are given in increasing order.
#[must_use]
pub fn triad<F: Field>(links: &[Link<F>], turns: &[Turn<F>], closing: [usize; 3]) -> Triad<F> {
    assert!(closing.is_sorted(), "the joints are in order");
    let n = links.len();
    let behind = |from: usize, to: usize| {
        let mut rotation = Motion::identity();
        for joint in from..to {
            let joint = joint % n;
            if joint != from % n {
                rotation = rotation.then_after(&Motion::rotation_z(turns[joint].0.clone(), turns[joint].1.clone()));
            }
            rotation = rotation.then_after(&Motion::rotation_x(links[joint].cos.clone(), links[joint].sin.clone()));
        }
        rotation
    };
    let [p, q, r] = closing;
    Triad::new([behind(p, q), behind(q, r), behind(r, n + p)])
}
