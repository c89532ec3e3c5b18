//! A closed chain of any number of joint variables over a field, and its positions.

use crate::algebra::echelon::Echelon;
use crate::algebra::number::Number;
use crate::algebra::ring::{Field, Ring};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, ScrewJoint};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::{Motion, cross, dot, unit_near};
use rug::{Float, Integer, Rational};

/// Study's parameters `x0..x3, y0..y3` of a motion up to a factor.
pub(crate) type Study<R> = [R; 8];

/// The value of a joint variable as a ratio `c : s`. A rotation is `c + s e` with the quaternion e of its axis, its angle twice
/// that of tangent s/c times the length of e, so that the angle pi is no exception; a translation is `c + s eps e`, by the
/// distance `2 s/c` times that length.
pub type JointValue<F> = [F; 2];

/// The axis of a joint variable in its own frame: through the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Axis<F> {
    /// The z axis, of length 1.
    Z,
    /// Along a vector, whose length need not be in the field.
    Along([F; 3]),
}

impl<F: Field> Axis<F> {
    /// The square of its length.
    pub(crate) fn square(&self) -> F {
        match self {
            Self::Z => F::one(),
            Self::Along(e) => dot(e, e),
        }
    }

    fn map<G: Field>(&self, image: impl Fn(&F) -> Option<G>) -> Option<Axis<G>> {
        Some(match self {
            Self::Z => Axis::Z,
            Self::Along([x, y, z]) => Axis::Along([image(x)?, image(y)?, image(z)?]),
        })
    }
}

impl Axis<Rational> {
    /// Its length.
    pub(crate) fn length(&self, bits: u32) -> Float {
        Float::with_val(bits, self.square()).sqrt()
    }
}

/// A closed chain `V_1 L_1 V_2 L_2 ... V_n L_n = 1` of joint variables V and constant links L, as dual quaternions up to
/// factors.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage<F> {
    /// The kind of each joint variable, in loop order.
    pub variables: Vec<Variable>,
    /// The axes of the joint variables, in loop order.
    pub axes: Vec<Axis<F>>,
    /// The link behind each joint variable.
    pub links: Vec<DualQuaternion<F>>,
}

/// A chain in one of its positions: the joint values have become part of the links, so that every joint stands at 0.
#[derive(Clone, Debug)]
pub struct Position<F> {
    pub(crate) variables: Vec<Variable>,
    pub(crate) axes: Vec<Axis<F>>,
    pub(crate) links: Vec<Study<F>>,
}

impl Linkage<Rational> {
    /// The loop of a mechanism file, exactly, with all its joint variables: a C joint has two and an S joint three.
    ///
    /// # Errors
    /// For H joints.
    pub fn of(chain: &Chain) -> Result<Self> {
        if let Some(linkage) = Self::about_given_axes(chain) {
            return Ok(linkage);
        }
        if let Some(k) = chain.joint_kinds().iter().position(|kind| kind.row().has_pitch) {
            return Err(Error::UnsupportedMobility(format!(
                "joint {}: H joints are read, but whether a loop of them moves is not decided: they turn by angles and shift by \
                 these angles times a pitch, which no algebra holds together; the loop has {}",
                k + 1,
                Freedom::of(chain)
            )));
        }
        let without = || Error::Unsupported("a constant of the loop without a rational value".to_owned());
        let (variables, motions) = chain.unknowns_and_constants::<Rational>().ok_or_else(without)?;
        let mut linkage = Self::of_motions(variables, motions).ok_or_else(without)?;
        linkage.links = linkage.links.iter().map(primitive).collect();
        Ok(linkage)
    }

    /// The loop of a list of screw axes of R, P and C joints some of which are along vectors of irrational length: there is
    /// no rational frame with its z axis along such a vector, but none is needed.
    fn about_given_axes(chain: &Chain) -> Option<Self> {
        let Geometry::Screws { joints, home } = &chain.geometry else { return None };
        let has_frame = |joint: &ScrewJoint| {
            let [x, y, z] = joint.axis.each_ref().map(Number::rational);
            is_square(&(Rational::from(x * x) + Rational::from(y * y) + Rational::from(z * z)))
        };
        if joints.iter().all(has_frame) {
            return None;
        }
        let image = |x: &Number| Some(x.rational().clone());
        let mut linkage = Self::about_axes(joints, &home.exact, image)?;
        linkage.links = linkage.links.iter().map(primitive).collect();
        Some(linkage)
    }

    /// A length of the size of the links: the power of two nearest to their mean, 1 without lengths.
    #[must_use]
    pub fn unit(&self) -> Rational {
        let length = |link: &DualQuaternion<Rational>| {
            let motion = link.to_motion()?;
            Some(motion.translation.iter().map(|x| x.to_f64().powi(2)).sum::<f64>())
        };
        let squares: f64 = self.links.iter().filter_map(length).sum();
        let mean = (squares / self.links.len().max(1) as f64).sqrt();
        Rational::from_f64(unit_near(mean)).unwrap_or_else(|| Rational::from(1))
    }

    /// Returns the same loop with a rotation in front of every spherical joint and its inverse behind. Other angles then describe
    /// the same motions, and other positions are those at which two of the three axes coincide. Every rotation has such angles,
    /// so that a curve of configurations of the one loop is one of the other.
    pub(crate) fn with_turned_spherical_joints(&self, spherical_joints: &[usize]) -> Self {
        let n = self.variables.len();
        let mut linkage = self.clone();
        for (number, k) in (0..).zip(spherical_joints.iter().copied()) {
            // Any rotation without a special axis or angle will do.
            let turn = [7, 2 + number, -3, 5].map(Rational::from);
            let zero = || [0; 4].map(Rational::from);
            let rotation = DualQuaternion::from_study(&turn, &zero());
            let back = [7, -2 - number, 3, -5].map(Rational::from);
            let inverse = DualQuaternion::from_study(&back, &zero());
            let before = (k + n - 1) % n;
            linkage.links[before] = linkage.links[before].mul(&rotation);
            linkage.links[k + 2] = inverse.mul(&linkage.links[k + 2]);
        }
        linkage
    }

    /// The same chain over another field; `None` for an unlucky prime.
    #[must_use]
    pub fn map<F: Field>(&self) -> Option<Linkage<F>> {
        self.over(F::from_rational)
    }
}

impl<F: Field> Linkage<F> {
    /// The loop of these joint variables about z axes, and the motions before, between and behind them; `None` without
    /// variables.
    pub(crate) fn of_motions(variables: Vec<Variable>, mut motions: Vec<Motion<F>>) -> Option<Self> {
        // The motion before the first variable moves behind the last one: conjugation.
        let first = motions.remove(0);
        let last = motions.last_mut()?;
        *last = last.then_after(&first);
        let links = motions.iter().map(dual_quaternion).collect();
        Some(Self::about_z(variables, links))
    }

    /// Returns the loop of a list of screw axes of R, P and C joints, each along its own vector, with these numbers; `None` for
    /// other joints.
    pub(crate) fn about_axes(
        joints: &[ScrewJoint],
        home: &Motion<F>,
        image: impl Fn(&Number) -> Option<F>,
    ) -> Option<Self> {
        let mut linkage = Self { variables: Vec::new(), axes: Vec::new(), links: Vec::new() };
        let mut motions: Vec<Motion<F>> = vec![Motion::identity()];
        let mut here: [F; 3] = std::array::from_fn(|_| F::zero());
        let vector = |v: &[Number; 3]| Some([image(&v[0])?, image(&v[1])?, image(&v[2])?]);
        for joint in joints {
            if !joint.kind.is_plain() {
                return None;
            }
            let (axis, point) = (vector(&joint.axis)?, vector(&joint.point)?);
            let step = std::array::from_fn(|i| point[i].sub(&here[i]));
            let last = motions.last_mut()?;
            *last = last.then_after(&Motion::translation(step));
            here = point;
            for variable in joint.kind.variables() {
                linkage.variables.push(*variable);
                linkage.axes.push(Axis::Along(axis.clone()));
                motions.push(Motion::identity());
            }
        }
        // The motion before the first variable moves behind the last one: conjugation.
        let first = motions.remove(0);
        let back = Motion::translation(here.map(|x| x.neg()));
        let last = motions.last_mut()?;
        *last = last.then_after(&back).then_after(home).then_after(&first);
        linkage.links = motions.iter().map(dual_quaternion).collect();
        Some(linkage)
    }

    /// Returns the same chain with the images of its numbers in another field; `None` where a number has no image.
    #[must_use]
    pub fn over<G: Field>(&self, image: impl Fn(&F) -> Option<G>) -> Option<Linkage<G>> {
        let link = |link: &DualQuaternion<F>| -> Option<DualQuaternion<G>> {
            let (x, y) = link.study();
            let four = |v: &[F; 4]| -> Option<[G; 4]> {
                let images: Option<Vec<G>> = v.iter().map(&image).collect();
                images?.try_into().ok()
            };
            Some(DualQuaternion::from_study(&four(&x)?, &four(&y)?))
        };
        let links: Option<Vec<_>> = self.links.iter().map(link).collect();
        let axes: Option<Vec<_>> = self.axes.iter().map(|axis| axis.map(&image)).collect();
        Some(Linkage { variables: self.variables.clone(), axes: axes?, links: links? })
    }

    /// The chain of these joint variables, all about or along the z axis of their frame, with a link behind each.
    #[must_use]
    pub fn about_z(variables: Vec<Variable>, links: Vec<DualQuaternion<F>>) -> Self {
        Self { axes: vec![Axis::Z; variables.len()], variables, links }
    }

    /// The chain in which some joint variables are rigid, at these values: their place in the list of variables, and the
    /// value.
    ///
    /// # Panics
    /// When no joint variable is left.
    #[must_use]
    pub fn locked(&self, at: &[(usize, JointValue<F>)]) -> Self {
        let mut whole: Vec<JointValue<F>> = vec![[F::one(), F::zero()]; self.variables.len()];
        for (k, value) in at {
            whole[*k] = value.clone();
        }
        let mut position = self.at(&whole);
        let mut rigid: Vec<usize> = at.iter().map(|(k, _)| *k).collect();
        rigid.sort_unstable();
        for k in rigid.into_iter().rev() {
            position = position.without(k);
        }
        let link = |[a, b, c, d, e, f, g, h]: Study<F>| DualQuaternion::from_study(&[a, b, c, d], &[e, f, g, h]);
        let links = position.links.into_iter().map(link).collect();
        Self { variables: position.variables, axes: position.axes, links }
    }

    /// The chain with its joints at these values, which need not close.
    ///
    /// # Panics
    /// Unless there is one value for every joint variable.
    #[must_use]
    pub fn at(&self, values: &[JointValue<F>]) -> Position<F> {
        assert_eq!(values.len(), self.variables.len(), "one value for every joint variable");
        let links = (0..values.len()).map(|k| {
            let (x, y) = self.links[k].study();
            let [a, b, c, d] = x;
            let [e, f, g, h] = y;
            times(&joint(self.variables[k], &self.axes[k], &values[k]), &[a, b, c, d, e, f, g, h])
        });
        Position { links: links.collect(), variables: self.variables.clone(), axes: self.axes.clone() }
    }
}

impl<F: Field> Position<F> {
    /// Whether the chain closes here: all but the scalar of the product vanish, and the scalar does not.
    #[must_use]
    pub fn closes(&self) -> bool {
        let product = self.links.iter().fold(one(), |product, link| times(&product, link));
        is_unit(&product[0]) && !product[1..].iter().any(is_unit)
    }

    /// The number of joint variables.
    pub(crate) fn joints(&self) -> usize {
        self.variables.len()
    }

    /// The same position with other coordinates of the spherical joints, whose three variables begin at these places: rotations
    /// about x, y and z. They are coordinates of all rotations near every position, also where two of the three axes of the
    /// joint variables coincide.
    pub(crate) fn with_regular_spherical_joints(mut self, spherical_joints: &[usize]) -> Self {
        for k in spherical_joints.iter().copied() {
            for axis in 0..3 {
                let unit = std::array::from_fn(|i| if i == axis { F::one() } else { F::zero() });
                self.axes[k + axis] = Axis::Along(unit);
            }
            let whole = times(&times(&self.links[k], &self.links[k + 1]), &self.links[k + 2]);
            (self.links[k], self.links[k + 1], self.links[k + 2]) = (one(), one(), whole);
        }
        self
    }

    /// The product round the chain in which the joints of `mask` stand for their units along the axis, the others for 1.
    pub(crate) fn with_units(&self, mask: usize) -> Study<F> {
        self.links.iter().enumerate().fold(one(), |product, (k, link)| {
            let turned =
                if mask >> k & 1 == 1 { times_axis(&product, self.variables[k], &self.axes[k]) } else { product };
            times(&turned, link)
        })
    }

    /// Whether no joints of a chain that closes here move to first order: their screws are independent.
    pub(crate) fn is_regular(&self) -> bool {
        let rows: Vec<Vec<F>> = (0..self.joints()).map(|k| equations(&self.with_units(1 << k)).into()).collect();
        Echelon::of(rows, 6).rank() == self.joints()
    }

    /// The chain in which joint variable `k` is rigid.
    ///
    /// # Panics
    /// When there is no joint variable `k`, or no other one.
    #[must_use]
    pub fn without(&self, k: usize) -> Self {
        let (mut variables, mut axes, mut links) = (self.variables.clone(), self.axes.clone(), self.links.clone());
        variables.remove(k);
        axes.remove(k);
        let link = links.remove(k);
        if k == 0 {
            // In front of the first variable: to the end, by conjugation.
            let last = links.last_mut().expect("another joint variable");
            *last = times(last, &link);
        } else {
            links[k - 1] = times(&links[k - 1], &link);
        }
        Self { variables, axes, links }
    }
}

/// Returns the six closure equations of a product: the coordinates that must vanish beside the scalars.
pub(crate) fn equations<F: Field>(product: &Study<F>) -> [F; 6] {
    [1, 2, 3, 5, 6, 7].map(|i| product[i].clone())
}

/// Returns whether a number is invertible. Over algebraic numbers a number that is zero at some roots only is detected by the
/// attempt to invert it.
pub(crate) fn is_unit<F: Field>(x: &F) -> bool {
    !x.is_zero() && x.inverse().is_some()
}

/// The dual quaternion 1.
pub(crate) fn one<R: Ring>() -> Study<R> {
    std::array::from_fn(|i| if i == 0 { R::one() } else { R::zero() })
}

/// `V(c : s)`.
pub(crate) fn joint<R: Ring>(variable: Variable, axis: &Axis<R>, value: &JointValue<R>) -> Study<R> {
    let mut study: Study<R> = std::array::from_fn(|_| R::zero());
    study[0] = value[0].clone();
    // The index of the unit k, or eps k.
    let k = match variable {
        Variable::Rotation => 3,
        Variable::Translation => 7,
    };
    match axis {
        Axis::Z => study[k] = value[1].clone(),
        Axis::Along(e) => (0..3).for_each(|i| study[k - 2 + i] = e[i].mul(&value[1])),
    }
    study
}

/// `a b`.
pub(crate) fn times<R: Ring>(a: &Study<R>, b: &Study<R>) -> Study<R> {
    // i j = k and so on: the product of units u and v is `sign` times unit `u ^ v`.
    const SIGN: [[bool; 4]; 4] =
        [[true, true, true, true], [true, false, true, false], [true, false, false, true], [true, true, false, false]];
    let mut product: Study<R> = std::array::from_fn(|_| R::zero());
    for (u, x) in a.iter().enumerate() {
        if x.is_zero() {
            continue;
        }
        let minus = x.neg();
        // The square of eps is 0.
        for (v, y) in b.iter().enumerate().take(if u < 4 { 8 } else { 4 }) {
            let to = ((u | v) & 4) | ((u ^ v) & 3);
            product[to].add_product(if SIGN[u & 3][v & 3] { x } else { &minus }, y);
        }
    }
    product
}

/// `a e` with the quaternion e of the axis of a joint, for a translation `a eps e`.
pub(crate) fn times_axis<R: Ring>(a: &Study<R>, variable: Variable, axis: &Axis<R>) -> Study<R> {
    let turned = |b: usize| match axis {
        Axis::Z => [a[b + 3].neg(), a[b + 2].clone(), a[b + 1].neg(), a[b].clone()],
        Axis::Along(e) => {
            let vector = [&a[b + 1], &a[b + 2], &a[b + 3]].map(R::clone);
            let mut along = cross(&vector, e);
            for (c, e) in along.iter_mut().zip(e) {
                c.add_product(&a[b], e);
            }
            let [x, y, z] = along;
            [dot(&vector, e).neg(), x, y, z]
        }
    };
    let [w, x, y, z] = turned(0);
    match variable {
        Variable::Rotation => {
            let [s, t, u, v] = turned(4);
            [w, x, y, z, s, t, u, v]
        }
        Variable::Translation => [R::zero(), R::zero(), R::zero(), R::zero(), w, x, y, z],
    }
}

/// Whether a rational number is the square of one.
pub(crate) fn is_square(q: &Rational) -> bool {
    q.numer().is_perfect_square() && q.denom().is_perfect_square()
}

/// The dual quaternion of a motion, up to a factor; rational for rational motions.
pub(crate) fn dual_quaternion<F: Field>(motion: &Motion<F>) -> DualQuaternion<F> {
    let r = &motion.rotation;
    let two = F::from_integer(2);
    let sum = |i: usize, j: usize| r[i][j].add(&r[j][i]);
    let difference = |i: usize, j: usize| r[i][j].sub(&r[j][i]);
    let diagonal = |signs: [i32; 3]| (0..3).fold(F::one(), |sum, i| sum.add(&r[i][i].mul(&F::from_integer(signs[i]))));
    // The rows of 4 q q^T: each is a multiple of the quaternion, and one of them at least is not 0.
    let table = [
        [diagonal([1, 1, 1]), difference(2, 1), difference(0, 2), difference(1, 0)],
        [difference(2, 1), diagonal([1, -1, -1]), sum(0, 1), sum(0, 2)],
        [difference(0, 2), sum(0, 1), diagonal([-1, 1, -1]), sum(1, 2)],
        [difference(1, 0), sum(0, 2), sum(1, 2), diagonal([-1, -1, 1])],
    ];
    let mut best = 0;
    for k in 1..4 {
        if table[k][k].pivot_size() > table[best][best].pivot_size() {
            best = k;
        }
    }
    let [w, i, j, k] = table[best].each_ref().map(|c| c.mul(&two));
    let zero = [F::zero(), F::zero(), F::zero(), F::zero()];
    let rotation = DualQuaternion::from_study(&[w, i, j, k], &zero);
    DualQuaternion::translation(&motion.translation).mul(&rotation)
}

/// The multiple with integers without common factor for coordinates.
fn primitive(q: &DualQuaternion<Rational>) -> DualQuaternion<Rational> {
    let (x, y) = q.study();
    let (mut content, mut denominator) = (Integer::new(), Integer::from(1));
    for c in x.iter().chain(&y) {
        content.gcd_mut(c.numer());
        denominator.lcm_mut(c.denom());
    }
    let scale = Rational::from((denominator, content));
    let scaled = |v: &[Rational; 4]| v.each_ref().map(|c| Rational::from(c * &scale));
    DualQuaternion::from_study(&scaled(&x), &scaled(&y))
}
