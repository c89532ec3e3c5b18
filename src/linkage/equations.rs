//! The closure equations of a group: one for every fundamental cycle of its clusters.
//!
//! Clusters joined by prismatic joints keep their relative rotation: they form a class with one rotation. A cycle says
//! `sum_j c_j theta_j + sum_q u_q theta_(class of q) s_q = 0`, and the same with every number replaced by what stands for
//! its conjugate. \[Wampler2001\]

use super::groups::Group;
use super::isotropic::{Isotropic, Value, middle};
use super::state::{Half, Number, Place, State, number};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use num_complex::Complex;
use rug::Rational;

/// A displacement along a prismatic joint, unknown.
#[derive(Clone, Debug)]
pub struct Slide<N> {
    /// The joint.
    pub joint: usize,
    /// The class in which its line is fixed.
    pub class: usize,
    /// Its coefficient in every cycle.
    pub coefficients: Vec<N>,
}

/// The equations of a group over any numbers.
#[derive(Clone, Debug)]
pub struct Equations<N> {
    /// For every cycle the coefficient of every class.
    pub cycles: Vec<Vec<N>>,
    /// The unknown displacements.
    pub slides: Vec<Slide<N>>,
    /// Number of classes.
    pub classes: usize,
    /// The differences of angles round cycles of slides alone, which vanish where their directions agree: nothing turns in such a cycle, and
    /// nothing can make up for a difference.
    pub angles: Vec<N>,
    /// The squares of the lengths of classes that are bars, and 1 for all others: where n is that, a rotation (z, w) is
    /// real if z is the conjugate of w over n.
    pub squares: Vec<Rational>,
}

/// The equations of a group of one branch, and what leads back from their solutions to the clusters.
#[derive(Clone, Debug)]
pub struct Closure<R = Value> {
    /// The equations.
    pub equations: Equations<Isotropic<R>>,
    /// The clusters, in the order of a tree.
    clusters: Vec<Node<R>>,
}

/// A cluster in the tree.
#[derive(Clone, Debug)]
struct Node<R> {
    name: usize,
    class: usize,
    /// Its rotation is this times that of its class.
    turn: Isotropic<R>,
    /// The place of its origin against that of the first cluster: coefficients of the classes and of the slides.
    origin: Linear<R>,
}

/// A linear form in the rotations of the classes and the products of slides with those of their classes.
#[derive(Clone, Debug)]
struct Linear<R> {
    classes: Vec<Isotropic<R>>,
    slides: Vec<Isotropic<R>>,
}

impl<R: Ring> Linear<R> {
    fn zero(classes: usize, slides: usize) -> Self {
        Self { classes: vec![Isotropic::zero(); classes], slides: vec![Isotropic::zero(); slides] }
    }

    fn add_class(&mut self, class: usize, factor: &Isotropic<R>) {
        self.classes[class] = self.classes[class].add(factor);
    }

    fn add_slide(&mut self, slide: usize, factor: &Isotropic<R>) {
        self.slides[slide] = self.slides[slide].add(factor);
    }

    fn sub(&self, other: &Self) -> Self {
        let difference = |a: &[Isotropic<R>], b: &[Isotropic<R>]| a.iter().zip(b).map(|(x, y)| x.sub(y)).collect();
        Self { classes: difference(&self.classes, &other.classes), slides: difference(&self.slides, &other.slides) }
    }
}

/// The class of every cluster, with the rotation of the cluster against it.
type Classes<R> = Vec<(usize, Isotropic<R>)>;

/// Returns the class of every cluster, the number of classes, and what vanishes where cycles of slides alone close in their angles;
/// `None` for a joint of a cluster that is not there.
fn classes<R: Half>(
    linkage: &Linkage,
    group: &Group,
    state: &State<R>,
    names: &[usize],
) -> Option<(Classes<R>, usize, Vec<Isotropic<R>>)> {
    let cluster_of = |body: usize| names.iter().position(|name| *name == state.bodies[body].0);
    // theta_b own_b = theta_a own_a turn
    let mut steps: Vec<(usize, usize, Isotropic<R>)> = Vec::new();
    for index in &group.joints {
        let joint = &linkage.joints[*index];
        let Pair::Prismatic { turn, .. } = &joint.pair else { continue };
        let [a, b] = joint.of;
        let step = state.bodies[a].1.turn.mul(&number(turn)).mul(&state.bodies[b].1.turn.mirrored());
        steps.push((cluster_of(a)?, cluster_of(b)?, step));
    }
    let mut class: Vec<Option<(usize, Isotropic<R>)>> = vec![None; names.len()];
    let mut is_open = vec![true; steps.len()];
    let mut classes = 0;
    for start in 0..names.len() {
        if class[start].is_some() {
            continue;
        }
        class[start] = Some((classes, Isotropic::one()));
        let mut open = vec![start];
        while let Some(here) = open.pop() {
            let turn = class[here].as_ref()?.1.clone();
            for (place, (a, b, step)) in steps.iter().enumerate() {
                let (next, turn) = if *a == here {
                    (*b, turn.mul(step))
                } else if *b == here {
                    (*a, turn.mul(&step.mirrored()))
                } else {
                    continue;
                };
                if class[next].is_none() {
                    class[next] = Some((classes, turn));
                    is_open[place] = false;
                    open.push(next);
                }
            }
        }
        classes += 1;
    }
    let class: Classes<R> = class.into_iter().collect::<Option<_>>()?;
    let gap = |((a, b, step), _): (&(usize, usize, Isotropic<R>), &bool)| class[*a].1.mul(step).sub(&class[*b].1);
    let angles = steps.iter().zip(&is_open).filter(|(_, is_open)| **is_open).map(gap).collect();
    Some((class, classes, angles))
}

impl<R: Half> Closure<R> {
    /// The equations of a group; `None` for gears, which have others.
    #[must_use]
    pub fn new(linkage: &Linkage, group: &Group, state: &State<R>) -> Option<Self> {
        let mut names: Vec<usize> = group.clusters.iter().map(|body| state.bodies[*body].0).collect();
        // Bars that stand by the squares of their lengths are never at rest.
        names.sort_unstable_by_key(|name| (state.square_of(*name) != 1, *name));
        names.dedup();
        let cluster_of = |body: usize| names.iter().position(|name| *name == state.bodies[body].0);
        let (class, classes, angles) = classes(linkage, group, state, &names)?;
        let sliding: Vec<usize> =
            group.joints.iter().copied().filter(|index| linkage.joints[*index].is_prismatic()).collect();
        let mut slides: Vec<Slide<Isotropic<R>>> = Vec::new();
        for index in &sliding {
            let a = cluster_of(linkage.joints[*index].of[0])?;
            slides.push(Slide { joint: *index, class: class[a].0, coefficients: Vec::new() });
        }
        // The step from the origin of the cluster of the first body of a joint to that of the second.
        let step = |index: usize| -> Option<(usize, usize, Linear<R>)> {
            let joint = &linkage.joints[index];
            let [a, b] = [cluster_of(joint.of[0])?, cluster_of(joint.of[1])?];
            let point = |k: usize| state.bodies[joint.of[k]].1.apply(&number(&joint.at[k]));
            let mut linear = Linear::zero(classes, sliding.len());
            linear.add_class(class[a].0, &class[a].1.mul(&point(0)));
            linear.add_class(class[b].0, &class[b].1.mul(&point(1)).neg());
            match &joint.pair {
                Pair::Revolute => {}
                Pair::Prismatic { along, .. } => {
                    let slide = sliding.iter().position(|own| *own == index)?;
                    let direction = state.bodies[joint.of[0]].1.turn.mul(&number(along));
                    linear.add_slide(slide, &class[a].1.mul(&direction));
                }
                Pair::Gear { .. } => return None,
            }
            Some((a, b, linear))
        };
        let mut origins: Vec<Option<Linear<R>>> = vec![None; names.len()];
        origins[0] = Some(Linear::zero(classes, sliding.len()));
        let mut tree: Vec<usize> = Vec::new();
        loop {
            let mut grown = false;
            for index in &group.joints {
                let (a, b, linear) = step(*index)?;
                match (&origins[a], &origins[b]) {
                    (Some(from), None) => {
                        origins[b] = Some(from.sub(&Linear::zero(classes, sliding.len()).sub(&linear)));
                    }
                    (None, Some(from)) => origins[a] = Some(from.sub(&linear)),
                    _ => continue,
                }
                tree.push(*index);
                grown = true;
            }
            if !grown {
                break;
            }
        }
        let origins: Vec<Linear<R>> = origins.into_iter().collect::<Option<_>>()?;
        let mut cycles = Vec::new();
        for index in group.joints.iter().filter(|index| !tree.contains(index)) {
            let (a, b, linear) = step(*index)?;
            // Round the cycle: out along the joint, back along the tree.
            let round = origins[a].sub(&origins[b]).sub(&Linear::zero(classes, sliding.len()).sub(&linear));
            cycles.push(round.classes);
            for (slide, coefficient) in slides.iter_mut().zip(round.slides) {
                slide.coefficients.push(coefficient);
            }
        }
        let mut squares = vec![Rational::from(1); classes];
        for (name, (class, _)) in names.iter().zip(&class) {
            squares[*class] *= state.square_of(*name);
        }
        let nodes = names.iter().zip(class).zip(origins);
        let clusters = nodes.map(|((name, (class, turn)), origin)| Node { name: *name, class, turn, origin }).collect();
        Some(Self { equations: Equations { cycles, slides, classes, angles, squares }, clusters })
    }

    /// The class of the cluster in which a body is, and the rotation of the body against its class.
    #[must_use]
    pub fn class_of(&self, state: &State<R>, body: usize) -> Option<(usize, Isotropic<R>)> {
        let (name, place) = &state.bodies[body];
        let node = self.clusters.iter().find(|node| node.name == *name)?;
        Some((node.class, node.turn.mul(&place.turn)))
    }

    /// The joints of a group that move where classes and slides have these rates, in any of several motions. What is below a
    /// millionth stands for rest.
    #[must_use]
    pub fn moving_joints(&self, linkage: &Linkage, group: &Group, state: &State<R>, rates: &[Vec<f64>]) -> Vec<usize> {
        let classes = self.equations.classes;
        let moves = |joint: &usize| {
            let of = linkage.joints[*joint].of.map(|body| self.class_of(state, body).map(|(class, _)| class));
            let slide = self.equations.slides.iter().position(|slide| slide.joint == *joint);
            rates.iter().any(|rate| match (slide, of) {
                (Some(slide), _) => rate[classes + slide].abs() > 1e-6,
                (None, [Some(a), Some(b)]) => (rate[a] - rate[b]).abs() > 1e-6,
                _ => false,
            })
        };
        group.joints.iter().copied().filter(moves).collect()
    }

    /// The equations with one cycle more: the place of a point of a body in coordinates of the body `base`, whose class
    /// rests so that `base` has the rotation 1. Less a point of the plane, it is zero where the point of the body is there.
    #[must_use]
    pub fn traced(
        &self,
        state: &State<R>,
        base: usize,
        body: usize,
        point: &Isotropic<R>,
    ) -> Option<Equations<Isotropic<R>>> {
        let node_of = |body: usize| self.clusters.iter().find(|node| node.name == state.bodies[body].0);
        let (ground, carrier) = (node_of(base)?, node_of(body)?);
        let place = |body: usize| &state.bodies[body].1;
        let mut from = ground.origin.clone();
        from.add_class(ground.class, &ground.turn.mul(&place(base).origin));
        let mut to = carrier.origin.clone();
        to.add_class(carrier.class, &carrier.turn.mul(&place(body).apply(point)));
        let step = to.sub(&from);
        let back = ground.turn.mul(&place(base).turn).mirrored();
        let turned = |list: &[Isotropic<R>]| list.iter().map(|n| n.mul(&back)).collect::<Vec<Isotropic<R>>>();
        let mut equations = self.equations.clone();
        equations.cycles.push(turned(&step.classes));
        for (slide, coefficient) in equations.slides.iter_mut().zip(turned(&step.slides)) {
            slide.coefficients.push(coefficient);
        }
        Some(equations)
    }

    /// Moves the clusters of a branch to where a solution puts them: one rotation for every class, one displacement for
    /// every slide, in parts of the length of its direction.
    #[must_use]
    pub fn assembled(&self, state: &State<R>, turns: &[Isotropic<R>], shifts: &[Isotropic<R>]) -> State<R> {
        let mut next = state.clone();
        let Some(first) = self.clusters.first() else { return next };
        let place = |node: &Node<R>| {
            let mut origin = Isotropic::zero();
            for (factor, turn) in node.origin.classes.iter().zip(turns) {
                origin = origin.add(&factor.mul(turn));
            }
            for ((factor, shift), slide) in node.origin.slides.iter().zip(shifts).zip(&self.equations.slides) {
                origin = origin.add(&factor.mul(shift).mul(&turns[slide.class]));
            }
            Place { turn: turns[node.class].mul(&node.turn), origin }
        };
        let base = place(first).inverse();
        for node in self.clusters.iter().skip(1) {
            next.move_cluster(node.name, first.name, &base.after(&place(node)));
        }
        next
    }
}

impl<N> Equations<N> {
    /// Number of cycles.
    #[must_use]
    pub fn loops(&self) -> usize {
        self.cycles.len()
    }

    /// Whether bars stand by the squares of their lengths.
    #[must_use]
    pub fn has_squares(&self) -> bool {
        self.squares.iter().any(|square| *square != 1)
    }

    /// Maps the equations to other numbers; `None` as soon as one has no image.
    pub fn map<M>(&self, image: impl Fn(&N) -> Option<M>) -> Option<Equations<M>> {
        let all = |list: &Vec<N>| list.iter().map(&image).collect::<Option<Vec<M>>>();
        let slide = |slide: &Slide<N>| {
            Some(Slide { joint: slide.joint, class: slide.class, coefficients: all(&slide.coefficients)? })
        };
        Some(Equations {
            cycles: self.cycles.iter().map(all).collect::<Option<_>>()?,
            slides: self.slides.iter().map(slide).collect::<Option<_>>()?,
            classes: self.classes,
            angles: all(&self.angles)?,
            squares: self.squares.clone(),
        })
    }
}

fn divided(z: &Gaussian, by: &Rational) -> Gaussian {
    Gaussian { re: Rational::from(&z.re / by), im: Rational::from(&z.im / by) }
}

impl Equations<Isotropic<Gaussian>> {
    /// The equations with rotations times the lengths of bars, where these stand by their squares: they are real for real data then.
    #[must_use]
    pub fn with_lengths(mut self) -> Self {
        for cycle in &mut self.cycles {
            for (number, square) in cycle.iter_mut().zip(&self.squares).filter(|(_, square)| **square != 1) {
                *number = Isotropic { z: divided(&number.z, square), w: number.w.clone() };
            }
        }
        self
    }
}

impl Equations<Number> {
    /// The equations over complex numbers with rational parts, where the data are such.
    #[must_use]
    pub fn exact(&self) -> Option<Equations<Isotropic<Gaussian>>> {
        self.map(|number| {
            let half = |value: &Value| value.exact.as_ref()?.to_gaussian();
            Some(Isotropic { z: half(&number.z)?, w: half(&number.w)? })
        })
    }

    /// The equations with rational numbers near all others, of which they tell nothing for certain; `None` beyond the range of f64.
    #[must_use]
    pub fn rounded(&self) -> Option<Equations<Isotropic<Gaussian>>> {
        let rational = |z: Complex<f64>| Some(Complex { re: Rational::from_f64(z.re)?, im: Rational::from_f64(z.im)? });
        self.map(|number| {
            let (z, w) = (middle(&number.z.disc), middle(&number.w.disc));
            // Of a real assembly the halves are conjugates, which rounding may have moved.
            let is_real = (w - z.conj()).norm() <= f64::EPSILON * z.norm();
            Some(Isotropic { z: rational(z)?, w: rational(if is_real { z.conj() } else { w })? })
        })
    }
}
