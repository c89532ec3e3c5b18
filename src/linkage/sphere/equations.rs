//! The equations of a linkage on the sphere in the directions of its axes.

use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::sphere::{Direction, SphereGiven, SphereLinkage, is_parallel};
use crate::linkage::groups::{Merged, groups};
use looproot_calculus::rotation::matrix::{Matrix, apply, product, transpose};
use rug::Rational;

/// Bodies that are one by what is given.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// The bodies, each with its rotation in the cluster.
    pub bodies: Vec<(usize, Matrix<Rational>)>,
    /// The joints with other clusters, each with its axis in the cluster.
    pub joints: Vec<(usize, Direction)>,
    /// Two of these joints by their places in the list: their axes are not parallel.
    pub base: [usize; 2],
}

/// The equations.
#[derive(Clone, Debug)]
pub struct System {
    /// The clusters; the coordinates of the first are those of the body that rests.
    pub clusters: Vec<Cluster>,
    /// The axis of every joint, a polynomial in the unknowns; zero for joints within a cluster.
    pub axes: Vec<Vector<Equation>>,
    /// The polynomials that vanish.
    pub equations: Vec<Equation>,
    /// The number of unknowns.
    pub unknowns: usize,
}

/// The identity.
pub(super) fn identity() -> Matrix<Rational> {
    std::array::from_fn(|i| std::array::from_fn(|j| Rational::from(u8::from(i == j))))
}

fn constant(v: &Direction) -> Vector<Equation> {
    v.each_ref().map(|c| Equation::from_rational(c).unwrap_or_else(Equation::zero))
}

fn scaled(v: &Vector<Equation>, q: &Rational) -> Vector<Equation> {
    let factor = Equation::from_rational(q).unwrap_or_else(Equation::zero);
    v.each_ref().map(|c| c.mul(&factor))
}

/// The coefficients of a direction in two others and their cross product.
#[must_use]
pub fn combination(target: &Direction, one: &Direction, two: &Direction) -> [Rational; 3] {
    let normal = cross(one, two);
    let square = dot(&normal, &normal);
    let part = |v: &Direction| Rational::from(&dot(target, v) / &square);
    [part(&cross(two, &normal)), part(&cross(&normal, one)), part(&normal)]
}

fn combined(coefficients: &[Rational; 3], one: &Vector<Equation>, two: &Vector<Equation>) -> Vector<Equation> {
    let parts = [one.clone(), two.clone(), cross(one, two)];
    let parts: Vec<Vector<Equation>> = parts.iter().zip(coefficients).map(|(v, q)| scaled(v, q)).collect();
    std::array::from_fn(|k| parts[0][k].add(&parts[1][k]).add(&parts[2][k]))
}

/// The clusters that what is given makes, that of the body `rest` first, without bases.
fn clusters(linkage: &SphereLinkage, given: &[SphereGiven], rest: usize) -> Result<Vec<Cluster>> {
    let mut order = vec![rest];
    order.extend((0..linkage.bodies.len()).filter(|body| *body != rest));
    let single = |body: &usize| Cluster { bodies: vec![(*body, identity())], joints: Vec::new(), base: [0, 1] };
    let mut list: Vec<Cluster> = order.iter().map(single).collect();
    for one in given {
        let place = |body: usize| {
            let found = list.iter().enumerate().find_map(|(k, cluster)| {
                cluster.bodies.iter().find(|(own, _)| *own == body).map(|(_, rotation)| (k, rotation.clone()))
            });
            found.ok_or_else(|| Error::Invalid("found an input of a body that is not there".to_owned()))
        };
        let ((a, first), (b, second)) = (place(one.of[0])?, place(one.of[1])?);
        if a == b {
            let names = one.of.map(|body| linkage.bodies[body].name.as_str());
            let message = format!(
                "found an input between {} and {}, which other inputs hold together already; expected inputs that are independent",
                names[0], names[1]
            );
            return Err(Error::Invalid(message));
        }
        // From the cluster of the second body to that of the first.
        let across = product(&product(&first, &one.rotation), &transpose(&second));
        // The body that rests stays in front, and its coordinates stay its own.
        let (kept, gone, across) = if b == 0 { (b, a, transpose(&across)) } else { (a, b, across) };
        let moved = std::mem::take(&mut list[gone].bodies);
        let moved = moved.into_iter().map(|(body, rotation)| (body, product(&across, &rotation)));
        list[kept].bodies.extend(moved);
        list.remove(gone);
    }
    Ok(list)
}

impl System {
    /// Writes down the equations.
    ///
    /// # Errors
    /// For inputs that leave freedoms or hold what others hold, for bodies whose axes are all parallel, and for more unknowns
    /// than a basis is made of.
    pub fn of(linkage: &SphereLinkage, given: &[SphereGiven]) -> Result<Self> {
        Self::with_rest(linkage, given, linkage.ground, 0)
    }

    /// Writes down the equations in the axes of the body in which they have the fewest unknowns and the lowest degrees.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn least(linkage: &SphereLinkage, given: &[SphereGiven]) -> Result<Self> {
        Self::with_freedoms(linkage, given, 0)
    }

    /// Writes down the equations as [`Self::least`], where by count the inputs leave at most so many freedoms.
    ///
    /// # Errors
    /// As [`Self::of`], for inputs that leave more.
    pub fn with_freedoms(linkage: &SphereLinkage, given: &[SphereGiven], left: usize) -> Result<Self> {
        let in_ground = Self::with_rest(linkage, given, linkage.ground, left);
        let others = (0..linkage.bodies.len()).filter(|body| *body != linkage.ground);
        let others = others.filter_map(|rest| Self::with_rest(linkage, given, rest, left).ok());
        let weight = |system: &Self| (system.unknowns, system.equations.iter().map(Equation::degree).sum::<usize>());
        match (others.min_by_key(weight), in_ground) {
            (Some(other), Ok(ground)) if weight(&other) < weight(&ground) => Ok(other),
            (Some(other), Err(Error::Unsupported(_))) => Ok(other),
            (_, in_ground) => in_ground,
        }
    }

    fn with_rest(linkage: &SphereLinkage, given: &[SphereGiven], rest: usize, left: usize) -> Result<Self> {
        let mut clusters = clusters(linkage, given, rest)?;
        let mut merged = Merged::new(linkage.bodies.len());
        for cluster in &clusters {
            for (body, _) in &cluster.bodies[1..] {
                merged.merge(cluster.bodies[0].0, *body);
            }
        }
        let links: Vec<(usize, [usize; 2])> =
            linkage.joints.iter().enumerate().map(|(k, joint)| (k, joint.of)).collect();
        let freedoms = groups(linkage.bodies.len(), &links, merged).freedoms;
        if freedoms > left {
            let message = format!(
                "found {} given, which leaves {freedoms} by count; expected as many inputs as the linkage has freedoms{}",
                if given.len() == 1 { "1 input".to_owned() } else { format!("{} inputs", given.len()) },
                if left > 0 { ", the first of which moves" } else { "" }
            );
            return Err(Error::Invalid(message));
        }
        let mut equations = Vec::new();
        let home = |clusters: &[Cluster], body: usize| {
            let found = clusters.iter().enumerate().find_map(|(k, cluster)| {
                cluster.bodies.iter().find(|(own, _)| *own == body).map(|(_, rotation)| (k, rotation.clone()))
            });
            found.ok_or_else(|| Error::Invalid("found a joint of a body that is not there".to_owned()))
        };
        for (number, joint) in linkage.joints.iter().enumerate() {
            if given.iter().any(|one| one.joint == Some(number)) {
                continue;
            }
            let ((a, first), (b, second)) = (home(&clusters, joint.of[0])?, home(&clusters, joint.of[1])?);
            let ends = [apply(&first, &joint.at[0]), apply(&second, &joint.at[1])];
            if a == b {
                // The inputs close this joint, or they do not.
                let [one, two] = ends.each_ref().map(constant);
                equations.extend((0..3).map(|k| one[k].sub(&two[k])));
                continue;
            }
            let [one, two] = ends;
            clusters[a].joints.push((number, one));
            clusters[b].joints.push((number, two));
        }
        for cluster in &mut clusters[1..] {
            cluster.base = base(linkage, cluster)?;
        }
        let mut system = Self { clusters, axes: vec![constant(&zero()); linkage.joints.len()], equations, unknowns: 0 };
        system.name_axes(linkage)?;
        Ok(system)
    }

    /// Gives every axis its polynomial, and writes down what they have to satisfy.
    fn name_axes(&mut self, linkage: &SphereLinkage) -> Result<()> {
        let mut degree: Vec<Option<u8>> = vec![None; linkage.joints.len()];
        for (joint, axis) in &self.clusters[0].joints {
            self.axes[*joint] = constant(axis);
            degree[*joint] = Some(0);
        }
        // The cluster by which an axis is a combination.
        let mut source: Vec<Option<usize>> = vec![None; linkage.joints.len()];
        loop {
            let combined_one = self.clusters.iter().enumerate().skip(1).find_map(|(k, cluster)| {
                let [one, two] = base_of(cluster, &degree)?;
                let open = cluster.joints.iter().find(|(joint, _)| degree[*joint].is_none())?;
                Some((k, one, two, open.clone()))
            });
            if let Some((k, one, two, (joint, axis))) = combined_one {
                let cluster = &mut self.clusters[k];
                cluster.base = [one, two];
                let [(first, p), (second, q)] = [one, two].map(|place| cluster.joints[place].clone());
                self.axes[joint] = combined(&combination(&axis, &p, &q), &self.axes[first], &self.axes[second]);
                let highest = degree[first].unwrap_or(0) + degree[second].unwrap_or(0);
                (degree[joint], source[joint]) = (Some(highest), Some(k));
                continue;
            }
            let open = self.clusters[1..].iter().flat_map(|cluster| &cluster.joints);
            let Some((joint, axis)) = open.into_iter().find(|(joint, _)| degree[*joint].is_none()).cloned() else {
                break;
            };
            if self.unknowns + 3 > MOST_VARIABLES {
                let message = format!("a linkage on the sphere with more than {} axes to find", MOST_VARIABLES / 3);
                return Err(Error::Unsupported(message));
            }
            self.axes[joint] = std::array::from_fn(|k| Equation::variable(self.unknowns + k));
            self.unknowns += 3;
            degree[joint] = Some(1);
            let length = Equation::from_rational(&dot(&axis, &axis)).unwrap_or_else(Equation::zero);
            self.equations.push(dot(&self.axes[joint], &self.axes[joint]).sub(&length));
        }
        for (k, cluster) in self.clusters.iter().enumerate().skip(1) {
            let [(first, p), (second, q)] = cluster.base.map(|place| &cluster.joints[place]);
            let (one, two) = (&self.axes[*first], &self.axes[*second]);
            let cosine = Equation::from_rational(&dot(p, q)).unwrap_or_else(Equation::zero);
            self.equations.push(dot(one, two).sub(&cosine));
            for (joint, axis) in &cluster.joints {
                if source[*joint] == Some(k) || joint == first || joint == second {
                    continue;
                }
                let wanted = combined(&combination(axis, p, q), one, two);
                self.equations.extend((0..3).map(|i| self.axes[*joint][i].sub(&wanted[i])));
            }
        }
        self.equations.retain(|equation| !equation.is_zero());
        Ok(())
    }
}

fn zero() -> Direction {
    std::array::from_fn(|_| Rational::new())
}

/// Two axes of a cluster that are known to degree 1 at most and are not parallel.
fn base_of(cluster: &Cluster, degree: &[Option<u8>]) -> Option<[usize; 2]> {
    let known: Vec<usize> =
        (0..cluster.joints.len()).filter(|k| degree[cluster.joints[*k].0].is_some_and(|degree| degree < 2)).collect();
    let pairs = known.iter().flat_map(|a| known.iter().map(move |b| [*a, *b]));
    pairs.into_iter().find(|[a, b]| a < b && !is_parallel(&cluster.joints[*a].1, &cluster.joints[*b].1))
}

/// Two axes of a cluster that are not parallel.
fn base(linkage: &SphereLinkage, cluster: &Cluster) -> Result<[usize; 2]> {
    let count = cluster.joints.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
    let mut pairs = pairs.into_iter();
    pairs.find(|[a, b]| !is_parallel(&cluster.joints[*a].1, &cluster.joints[*b].1)).ok_or_else(|| {
        let name = &linkage.bodies[cluster.bodies[0].0].name;
        let message = format!(
            "found the body {name}, whose {} not hold it; expected two axes that are not parallel",
            if count == 1 { "one axis does".to_owned() } else { "parallel axes do".to_owned() }
        );
        Error::Invalid(message)
    })
}
