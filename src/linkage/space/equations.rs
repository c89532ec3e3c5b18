//! The equations of a linkage in space.
//!
//! Clusters of bodies are placed one after the other, each by polynomials in a few unknowns: through a revolute joint by the cosine
//! and the sine of its angle, through a prismatic one by its displacement, and a body that others hold at points by these points.
//! Three points that are not on a line give a rotation matrix: with `a, b` the differences of the points in the body and `v, w` those in
//! space it takes a, b, a x b to v, w, v x w, and the dot products of v and w are those of a and b. Where fewer
//! points are known, further vectors are unknowns. Every joint by which no cluster was placed is an equation.
//!
//! The solutions of the system are the assemblies, one for one: real assemblies have real unknowns.

use super::clusters::{Cluster, clusters, freedoms, home, open_joints};
use super::conditions::conditions;
use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::space::{Axis, Known, SpaceGiven, SpaceLinkage, SpacePair};
use crate::kinematics::sphere::is_parallel;
use crate::linkage::sphere::combination;
use rug::Rational;

/// What an unknown stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// The cosine of the angle of a joint.
    Cosine(usize),
    /// Its sine over the length of the axis.
    Sine(usize),
    /// The displacement of a joint over the length of its axis.
    Shift(usize),
    /// A coordinate (the last number) of a direction, the first or second, that is fixed in a body.
    Direction(usize, usize, usize),
    /// A coordinate of the origin of a body.
    Position(usize, usize),
    /// A coordinate of the axis of a joint.
    Axis(usize, usize),
}

/// The equations, and what leads back from their solutions to the bodies.
#[derive(Clone, Debug)]
pub struct System {
    /// The clusters, that of the ground first; its coordinates are those of the ground.
    pub clusters: Vec<Cluster>,
    /// The place of every cluster; none for rods.
    pub places: Vec<Option<Motion<Equation>>>,
    /// The polynomials that vanish.
    pub equations: Vec<Equation>,
    /// The number of unknowns.
    pub unknowns: usize,
    /// What every unknown stands for.
    pub symbols: Vec<Symbol>,
    /// An upper bound for the degree of every place.
    degrees: Vec<u32>,
}

/// Highest degree of a place: a plate on plates on plates on circles. Polynomials of a higher one have too many terms.
const HIGHEST: u32 = 8;

fn number(q: &Rational) -> Equation {
    Equation::from_rational(q).unwrap_or_else(Equation::zero)
}

fn constant(v: &Vector<Rational>) -> Vector<Equation> {
    v.each_ref().map(number)
}

fn difference<R: Ring>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|k| a[k].sub(&b[k]))
}

fn sum<R: Ring>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|k| a[k].add(&b[k]))
}

fn scaled<R: Ring>(v: &Vector<R>, factor: &R) -> Vector<R> {
    v.each_ref().map(|c| c.mul(factor))
}

/// A motion of known numbers as one of polynomials.
fn over(motion: &Motion<Rational>) -> Motion<Equation> {
    Motion { rotation: motion.rotation.each_ref().map(constant), translation: constant(&motion.translation) }
}

/// What is known of a cluster that is not yet placed: its points and directions, each with the polynomials in space.
#[derive(Default)]
struct Held {
    points: Vec<(Vector<Rational>, Vector<Equation>)>,
    directions: Vec<(Vector<Rational>, Vector<Equation>)>,
}

impl Held {
    /// Two vectors of the cluster that are not parallel, or as many as there are, with those in space.
    fn frame(&self) -> Vec<(Vector<Rational>, Vector<Equation>)> {
        let mut candidates = self.directions.clone();
        if let Some(((first, at), rest)) = self.points.split_first() {
            candidates.extend(rest.iter().map(|(own, place)| (difference(own, first), difference(place, at))));
        }
        let mut chosen: Vec<(Vector<Rational>, Vector<Equation>)> = Vec::new();
        for (own, place) in candidates {
            let is_new = own.iter().any(|c| *c != 0) && chosen.iter().all(|(other, _)| !is_parallel(other, &own));
            if is_new && chosen.len() < 2 {
                chosen.push((own, place));
            }
        }
        chosen
    }

    /// The number of unknowns that placing the cluster takes.
    fn cost(&self) -> usize {
        3 * (2 - self.frame().len()) + if self.points.is_empty() { 3 } else { 0 }
    }
}

/// A direction across another one.
fn across(direction: &Vector<Rational>) -> Vector<Rational> {
    let least = (0..3).min_by_key(|k| Rational::from(direction[*k].abs_ref())).unwrap_or(0);
    let unit = std::array::from_fn(|k| Rational::from(u8::from(k == least)));
    cross(direction, &unit)
}

impl System {
    /// Writes down the equations for the bodies of a list, the first of which stands still.
    ///
    /// # Errors
    /// For inputs that leave freedoms by count or hold what others hold, and for more unknowns than a basis is made of.
    pub fn of(linkage: &SpaceLinkage, given: &[SpaceGiven], within: &[usize]) -> Result<Self> {
        Self::with_freedoms(linkage, given, within, 0)
    }

    /// Writes down the equations where by count the inputs leave at most so many freedoms.
    ///
    /// # Errors
    /// As [`Self::of`], for inputs that leave more.
    pub fn with_freedoms(linkage: &SpaceLinkage, given: &[SpaceGiven], within: &[usize], left: i64) -> Result<Self> {
        let clusters = clusters(linkage, given, within)?;
        let free = freedoms(linkage, given, &clusters);
        if free > left {
            let message = format!(
                "found {} given, which leaves {free} by count; expected as many inputs as the linkage has freedoms{}",
                if given.len() == 1 { "1 input".to_owned() } else { format!("{} inputs", given.len()) },
                if left > 0 { ", the first of which moves" } else { "" }
            );
            return Err(Error::Invalid(message));
        }
        let places = (0..clusters.len()).map(|k| (k == 0).then(Motion::identity)).collect();
        let degrees = vec![0; clusters.len()];
        let mut system = Self { clusters, places, equations: Vec::new(), unknowns: 0, symbols: Vec::new(), degrees };
        let mut open = open_joints(linkage, given, &system.clusters);
        loop {
            let serial = open.iter().position(|(joint, of)| system.reaches(linkage, *joint, *of));
            if let Some(at) = serial {
                let (joint, of) = open.remove(at);
                system.step(linkage, joint, of)?;
                continue;
            }
            let Some((k, held)) = system.held(linkage, &open) else { break };
            system.hold(k, &held)?;
        }
        for (joint, of) in &open {
            system.close(linkage, given, *joint, *of)?;
        }
        system.equations.retain(|equation| !equation.is_zero());
        Ok(system)
    }

    fn unknown(&mut self, symbol: Symbol) -> Result<Equation> {
        if self.unknowns == MOST_VARIABLES {
            return Err(Error::Unsupported(format!("a linkage in space with more than {MOST_VARIABLES} unknowns")));
        }
        self.unknowns += 1;
        self.symbols.push(symbol);
        Ok(Equation::variable(self.unknowns - 1))
    }

    fn is_constant(&self, equation: &Equation) -> bool {
        let origin = vec![Rational::new(); self.unknowns];
        *equation == number(&equation.evaluate(&origin))
    }

    fn vector(&mut self, symbol: impl Fn(usize) -> Symbol) -> Result<Vector<Equation>> {
        Ok([self.unknown(symbol(0))?, self.unknown(symbol(1))?, self.unknown(symbol(2))?])
    }

    /// Whether a joint leads from a cluster that is placed to one that is not, by one variable.
    fn reaches(&self, linkage: &SpaceLinkage, joint: usize, of: [usize; 2]) -> bool {
        let is_serial = matches!(linkage.joints[joint].pair, SpacePair::Revolute(_) | SpacePair::Prismatic(_));
        is_serial && self.places[of[0]].is_some() != self.places[of[1]].is_some()
    }

    /// The place of a body in its cluster.
    fn own(&self, body: usize) -> Motion<Rational> {
        let mut all = self.clusters.iter().flat_map(|cluster| &cluster.bodies);
        all.find(|(own, _)| *own == body).map_or_else(Motion::identity, |(_, motion)| motion.clone())
    }

    /// Places a cluster through a joint of one variable.
    fn step(&mut self, linkage: &SpaceLinkage, index: usize, of: [usize; 2]) -> Result<()> {
        let joint = &linkage.joints[index];
        let to = |v: &Vector<Rational>| Motion::translation(constant(v));
        let back = joint.at[1].each_ref().map(|c| Rational::from(-c));
        let middle = match &joint.pair {
            SpacePair::Prismatic(axis) => {
                let way = self.unknown(Symbol::Shift(index))?;
                Motion::translation(scaled(&constant(&axis.sphere.at[0]), &way)).then_after(&over(&axis.home))
            }
            SpacePair::Revolute(axis) => {
                let (cos, sin) = (self.unknown(Symbol::Cosine(index))?, self.unknown(Symbol::Sine(index))?);
                let square = dot(&axis.sphere.at[0], &axis.sphere.at[0]);
                // The sine is that of the angle over the length of the axis.
                let circle = cos.mul(&cos).add(&sin.mul(&sin).mul(&number(&square))).sub(&Equation::one());
                self.equations.push(circle);
                turn(axis, &square, &cos, &sin).then_after(&over(&axis.home))
            }
            _ => return Err(Error::Unsupported("a joint of more than one variable in a chain".to_owned())),
        };
        // The second body against the first.
        let across = to(&joint.at[0]).then_after(&middle).then_after(&to(&back));
        let ends = joint.of.map(|body| over(&self.own(body)));
        let [a, b] = of;
        let degree = self.degrees[a].max(self.degrees[b]) + 1;
        for end in of {
            if self.places[end].is_none() {
                self.degrees[end] = limited(degree)?;
            }
        }
        if let Some(place) = self.places[a].clone() {
            self.places[b] = Some(place.then_after(&ends[0]).then_after(&across).then_after(&ends[1].inverse()));
        } else if let Some(place) = self.places[b].clone() {
            self.places[a] =
                Some(place.then_after(&ends[1]).then_after(&across.inverse()).then_after(&ends[0].inverse()));
        }
        Ok(())
    }

    /// The place of a body, in polynomials; `None` of a rod.
    #[must_use]
    pub fn place(&self, body: usize) -> Option<Motion<Equation>> {
        let cluster = home(&self.clusters, body)?;
        Some(self.places[cluster].as_ref()?.then_after(&over(&self.own(body))))
    }

    /// The point of a joint in a cluster.
    fn local(&self, linkage: &SpaceLinkage, joint: usize, side: usize) -> Vector<Rational> {
        let joint = &linkage.joints[joint];
        self.own(joint.of[side]).apply(&joint.at[side])
    }

    /// A direction of a joint in a cluster.
    fn local_direction(&self, linkage: &SpaceLinkage, joint: usize, side: usize) -> Option<Vector<Rational>> {
        let joint = &linkage.joints[joint];
        let SpacePair::Parallelogram(axes, _) = &joint.pair else { return None };
        Some(self.own(joint.of[side]).rotate(&axes[side]))
    }

    /// The cluster that takes the fewest unknowns to place, with what holds it.
    fn held(&self, linkage: &SpaceLinkage, open: &[(usize, [usize; 2])]) -> Option<(usize, Held)> {
        let is_open = |k: &usize| self.places[*k].is_none() && !self.clusters[*k].is_rod;
        let all = (0..self.clusters.len()).filter(is_open).map(|k| {
            let mut held = Held::default();
            for (joint, of) in open {
                for side in 0..2 {
                    let (own, other) = (of[side], of[1 - side]);
                    let Some(place) = self.places[other].as_ref().filter(|_| own == k) else { continue };
                    match &linkage.joints[*joint].pair {
                        SpacePair::Spherical | SpacePair::Universal(_) | SpacePair::Revolute(_) => {
                            let at = place.apply(&constant(&self.local(linkage, *joint, 1 - side)));
                            held.points.push((self.local(linkage, *joint, side), at));
                        }
                        SpacePair::Parallelogram(..) => {
                            let directions = [side, 1 - side].map(|side| self.local_direction(linkage, *joint, side));
                            let [Some(own), Some(other)] = directions else { continue };
                            held.directions.push((own, place.rotate(&constant(&other))));
                        }
                        _ => {}
                    }
                }
            }
            (k, held)
        });
        all.min_by_key(|(_, held)| held.cost())
    }

    /// Places a cluster by what holds it, with further unknowns where that is not enough.
    fn hold(&mut self, k: usize, held: &Held) -> Result<()> {
        let mut frame = held.frame();
        let known = frame.iter().map(|(_, place)| place).chain(held.points.first().map(|(_, at)| at));
        let is_constant = frame.len() == 2 && known.flatten().all(|c| self.is_constant(c));
        // The rotation is of twice the degree of the vectors that it is made of.
        let highest = self.degrees.iter().copied().max().unwrap_or(0).max(1);
        self.degrees[k] = if is_constant { 0 } else { limited(2 * highest)? };
        let body = self.clusters[k].bodies[0].0;
        while frame.len() < 2 {
            let order = frame.len();
            let own = match frame.first() {
                Some((own, _)) => across(own),
                None => std::array::from_fn(|k| Rational::from(u8::from(k == 0))),
            };
            frame.push((own, self.vector(|axis| Symbol::Direction(body, order, axis))?));
        }
        let [(a, v), (b, w)] = [&frame[0], &frame[1]];
        for ((p, x), (q, y)) in [((a, v), (a, v)), ((b, w), (b, w)), ((a, v), (b, w))] {
            self.equations.push(dot(x, y).sub(&number(&dot(p, q))));
        }
        let normal = cross(v, w);
        let column = |k: usize| -> Vector<Equation> {
            let unit = std::array::from_fn(|i| Rational::from(u8::from(i == k)));
            let [p, q, r] = combination(&unit, a, b).each_ref().map(number);
            sum(&sum(&scaled(v, &p), &scaled(w, &q)), &scaled(&normal, &r))
        };
        let columns: [Vector<Equation>; 3] = std::array::from_fn(column);
        let rotation: [Vector<Equation>; 3] = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()));
        let turned = Motion { rotation, translation: std::array::from_fn(|_| Equation::zero()) };
        let translation = match held.points.first() {
            Some((own, at)) => difference(at, &turned.rotate(&constant(own))),
            None => self.vector(|axis| Symbol::Position(body, axis))?,
        };
        self.places[k] = Some(Motion { translation, ..turned });
        Ok(())
    }

    /// The place of an end of a joint: for the ends of rods, the point at their other end.
    fn end(&self, linkage: &SpaceLinkage, joint: usize, side: usize, cluster: usize) -> Result<Vector<Equation>> {
        let place = self.places[cluster].as_ref().ok_or_else(unplaced)?;
        Ok(place.apply(&constant(&self.local(linkage, joint, side))))
    }

    /// Adds the equations of a joint between clusters that are placed.
    fn close(&mut self, linkage: &SpaceLinkage, given: &[SpaceGiven], joint: usize, of: [usize; 2]) -> Result<()> {
        if let Some(rod) = of.iter().copied().find(|k| self.clusters[*k].is_rod) {
            return self.close_rod(linkage, given, joint, of, rod);
        }
        let own = &linkage.joints[joint];
        let place = |side: usize| -> Result<Motion<Equation>> {
            let place = self.places[of[side]].as_ref().ok_or_else(unplaced)?;
            Ok(place.then_after(&over(&self.own(own.of[side]))))
        };
        let mut list = conditions(own, [&place(0)?, &place(1)?], number);
        if let (SpacePair::Leg | SpacePair::UniversalLeg(_), Some(one)) =
            (&own.pair, given.iter().find(|one| one.joint == Some(joint)))
            && let Known::Square(square) = &one.known
        {
            let apart = difference(&self.end(linkage, joint, 0, of[0])?, &self.end(linkage, joint, 1, of[1])?);
            list.push(dot(&apart, &apart).sub(&number(square)));
        }
        self.equations.extend(list);
        Ok(())
    }

    /// Adds the equation of a rod, once for its two joints.
    fn close_rod(
        &mut self,
        linkage: &SpaceLinkage,
        given: &[SpaceGiven],
        joint: usize,
        of: [usize; 2],
        rod: usize,
    ) -> Result<()> {
        let ends = open_joints(linkage, given, &self.clusters).into_iter().filter(|(_, of)| of.contains(&rod));
        let ends: Vec<(usize, [usize; 2])> = ends.collect();
        let [first, second] = ends.as_slice() else { return Ok(()) };
        if *first != (joint, of) {
            return Ok(());
        }
        let side = |end: &(usize, [usize; 2])| usize::from(end.1[1] == rod);
        let own = difference(&self.local(linkage, first.0, side(first)), &self.local(linkage, second.0, side(second)));
        let other = |end: &(usize, [usize; 2])| self.end(linkage, end.0, 1 - side(end), end.1[1 - side(end)]);
        let apart = difference(&other(first)?, &other(second)?);
        let square = dot(&own, &own);
        if square == 0 {
            // A rod without length is one spherical joint.
            self.equations.extend(apart);
        } else {
            self.equations.push(dot(&apart, &apart).sub(&number(&square)));
        }
        Ok(())
    }

    /// The joints of a rod with the sides that are its own.
    #[must_use]
    pub fn ends(&self, linkage: &SpaceLinkage, given: &[SpaceGiven], rod: usize) -> Vec<(usize, usize)> {
        let joints = open_joints(linkage, given, &self.clusters);
        let own = joints.into_iter().filter(|(_, of)| of.contains(&rod));
        own.map(|(joint, of)| (joint, usize::from(of[1] == rod))).collect()
    }
}

fn limited(degree: u32) -> Result<u32> {
    if degree <= HIGHEST {
        return Ok(degree);
    }
    let message = format!("a linkage in space whose places have a degree above {HIGHEST} in its unknowns");
    Err(Error::Unsupported(message))
}

fn unplaced() -> Error {
    Error::Unsupported("a rod between rods, whose ends nothing holds".to_owned())
}

/// The rotation about an axis, by the cosine and the sine over the length of the axis.
fn turn(axis: &Axis, square: &Rational, cos: &Equation, sin: &Equation) -> Motion<Equation> {
    let u = &axis.sphere.at[0];
    let [a, b, c] = constant(u);
    let zero = Equation::zero;
    let skew = [[zero(), c.neg(), b.clone()], [c, zero(), a.neg()], [b.neg(), a, zero()]];
    let rotation = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let along = number(&(Rational::from(&u[i] * &u[j]) / square));
            let unit = if i == j { Equation::one() } else { zero() };
            unit.sub(&along).mul(cos).add(&along).add(&skew[i][j].mul(sin))
        })
    });
    Motion { rotation, translation: std::array::from_fn(|_| zero()) }
}
