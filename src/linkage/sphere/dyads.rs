//! Linkages on the sphere that are solved dyad by dyad, with the angle of their input as an unknown.
//!
//! A dyad joins two axes p and q of what is there already by two links that share an axis m. Its unknown is the angle about p, and its
//! closure equation says which angle m has with q: `u cos + v sin + w = 0`. Its two assemblies have opposite signs of the
//! determinant of p, m and q, whose square is `u^2 + v^2 - w^2` times that of the length of p.

use super::answer::SphereMode;
use super::equations::combination;
use crate::algebra::number::Angle;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::catalogue::sphere::turned;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::sphere::{Direction, SphereGiven, SphereLinkage, is_parallel};
use crate::linkage::groups::{Group, Merged, groups};
use looproot_calculus::rotation::matrix::{Matrix, apply, determinant, product, transpose};
use num_complex::Complex;
use rug::Rational;

/// A polynomial in the cosines of all angles, variables 2k, and their sines over the lengths of the axes, variables 2k + 1: 0 is the input.
pub type Function = Polynomial<Rational>;

/// The least determinant of three directions whose sign is asked: entries of rotations are correct to a thousandth of that.
const CLEAR: f64 = 1e-11;
/// The largest radius of a mode whose signs are asked.
const NARROW: f64 = 1e-14;

/// A dyad.
#[derive(Clone, Debug)]
pub struct SphereDyad {
    /// What vanishes where the dyad closes.
    pub equation: Function,
    /// `w^2 - u^2 - v^2`: negative where two real assemblies exist.
    pub discriminant: Function,
    /// The axes p, m and q, each in a body that has it.
    axes: [(usize, Direction); 3],
}

/// A linkage of dyads whose input turns.
#[derive(Clone, Debug)]
pub struct SphereDyads {
    /// The squares of the lengths of the axes about which input and unknowns turn.
    pub squares: Vec<Rational>,
    /// The dyads in the order in which they are solved.
    pub list: Vec<SphereDyad>,
}

/// A rotation that takes the axis of a joint in its second body exactly to that in the first.
#[must_use]
pub fn aligned([u, w]: &[Direction; 2]) -> Matrix<Rational> {
    let sum: Direction = std::array::from_fn(|k| Rational::from(&u[k] + &w[k]));
    if sum.iter().any(|c| *c != 0) {
        return half_turn(&sum);
    }
    // Opposite axes: half a turn about any direction across.
    let unit = |k: usize| -> Direction { std::array::from_fn(|i| Rational::from(u8::from(i == k))) };
    let across = (0..3).map(|k| cross(u, &unit(k))).find(|v| v.iter().any(|c| *c != 0));
    half_turn(&across.unwrap_or_else(|| unit(0)))
}

/// Half a turn about a direction.
#[must_use]
pub fn half_turn(axis: &Direction) -> Matrix<Rational> {
    spun(axis, (&Rational::from(-1), &Rational::new()))
}

/// The rotation about an axis, from the cosine and the sine over the length of the axis.
#[must_use]
pub fn spun<R: Ring>(axis: &Direction, (cosine, sine): (&R, &R)) -> Matrix<R> {
    let square = dot(axis, axis);
    let number = |q: &Rational| R::from_rational(q).unwrap_or_else(R::zero);
    let [a, b, c] = axis.each_ref().map(|x| number(x).mul(sine));
    let skew = [[R::zero(), c.neg(), b.clone()], [c.clone(), R::zero(), a.neg()], [b.neg(), a.clone(), R::zero()]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let along = Rational::from(&axis[i] * &axis[j]) / &square;
            let beside = Rational::from(u8::from(i == j)) - &along;
            number(&along).add(&number(&beside).mul(cosine)).add(&skew[i][j])
        })
    })
}

fn functions(m: &Matrix<Rational>) -> Matrix<Function> {
    m.each_ref().map(|row| row.each_ref().map(|c| Function::constant(c.clone())))
}

fn constants(v: &Direction) -> Vector<Function> {
    v.each_ref().map(|c| Function::constant(c.clone()))
}

/// The cosine and the sine of an angle.
fn unknown(k: usize) -> [Function; 2] {
    [Function::variable(2 * k), Function::variable(2 * k + 1)]
}

/// The function with no square of a sine: the squares of the lengths of the axes say what it is.
fn reduced(function: &Function, squares: &[Rational]) -> Function {
    squares.iter().enumerate().fold(function.clone(), |function, (k, square)| {
        let [cosine, sine] = unknown(k);
        if function.degree(2 * k + 1) < 2 {
            return function;
        }
        let of_sine = Function::one().sub(&cosine.mul(&cosine)).scale(&square.clone().recip());
        let powers = function.coefficients_in(2 * k + 1).into_iter().enumerate();
        powers.fold(Function::zero(), |sum, (n, c)| {
            let even = (0..n / 2).fold(c, |c, _| c.mul(&of_sine));
            sum.add(&if n % 2 == 1 { even.mul(&sine) } else { even })
        })
    })
}

/// Bodies by clusters.
struct State(Vec<(usize, Matrix<Function>)>);

impl State {
    /// The rotation of a body against another one of its cluster.
    fn against(&self, body: usize, base: usize, squares: &[Rational]) -> Matrix<Function> {
        let own = product(&transpose(&self.0[base].1), &self.0[body].1);
        own.each_ref().map(|row| row.each_ref().map(|c| reduced(c, squares)))
    }

    /// Makes one cluster of two: the rotation is that of the body `second` against the body `first`.
    fn glue(&mut self, [first, second]: [usize; 2], rotation: &Matrix<Function>) {
        let (cluster, own) = self.0[first].clone();
        let (other, back) = self.0[second].clone();
        let across = product(&product(&own, rotation), &transpose(&back));
        for body in self.0.iter_mut().filter(|body| body.0 == other) {
            *body = (cluster, product(&across, &body.1));
        }
    }

    /// The direction of an axis of a body in another body of its cluster; `None` where it changes.
    fn fixed(&self, axis: &(usize, Direction), base: usize, squares: &[Rational]) -> Option<Direction> {
        let place = self.seen(axis, base, squares);
        let all: Vec<Rational> = place.iter().map(Function::to_constant).collect::<Option<_>>()?;
        all.try_into().ok()
    }

    /// The direction of an axis of a body in another body of its cluster.
    fn seen(&self, (body, axis): &(usize, Direction), base: usize, squares: &[Rational]) -> Vector<Function> {
        if *body == base { constants(axis) } else { apply(&self.against(*body, base, squares), &constants(axis)) }
    }
}

impl SphereDyads {
    /// Returns the dyads of a linkage whose joint turns while other rotations are held; `None` where a group is none.
    #[must_use]
    pub fn of(linkage: &SphereLinkage, held: &[SphereGiven], joint: usize) -> Option<Self> {
        let bodies = linkage.bodies.len();
        let mut merged = Merged::new(bodies);
        let identity = functions(&spun(&linkage.joints[joint].at[0], (&Rational::from(1), &Rational::new())));
        let mut state = State((0..bodies).map(|body| (body, identity.clone())).collect());
        for one in held {
            if !merged.merge(one.of[0], one.of[1]) {
                return None;
            }
            state.glue(one.of, &functions(&one.rotation));
        }
        let own = &linkage.joints[joint];
        if !merged.merge(own.of[0], own.of[1]) {
            return None;
        }
        let [cosine, sine] = unknown(0);
        state.glue(own.of, &product(&spun(&own.at[0], (&cosine, &sine)), &functions(&start(linkage, joint))));
        let is_given = |k: usize| k == joint || held.iter().any(|one| one.joint == Some(k));
        let open: Vec<(usize, [usize; 2])> =
            (0..linkage.joints.len()).filter(|k| !is_given(*k)).map(|k| (k, linkage.joints[k].of)).collect();
        let found = groups(bodies, &open, merged);
        // A joint in no group is one between bodies that are held together: whether it closes is not asked here.
        let is_whole = found.freedoms == 0 && 3 * found.list.len() == open.len();
        if !is_whole || found.list.iter().any(|group| group.clusters.len() != 3 || group.joints.len() != 3) {
            return None;
        }
        let mut dyads = Self { squares: vec![dot(&own.at[0], &own.at[0])], list: Vec::new() };
        for group in &found.list {
            dyads.add(linkage, group, &mut state)?;
        }
        Some(dyads)
    }

    /// Adds a dyad, with any of its clusters at rest.
    fn add(&mut self, linkage: &SphereLinkage, group: &Group, state: &mut State) -> Option<()> {
        group.clusters.iter().find_map(|body| self.standing_on(linkage, group, state, state.0[*body].0))
    }

    fn standing_on(&mut self, linkage: &SphereLinkage, group: &Group, state: &mut State, rest: usize) -> Option<()> {
        let joints: Vec<usize> = group.joints.clone();
        let cluster = |body: usize| state.0[body].0;
        let touches = |joint: &&usize| linkage.joints[**joint].of.iter().any(|body| cluster(*body) == rest);
        let outer: Vec<usize> = joints.iter().filter(touches).copied().collect();
        let [first, last] = outer.as_slice() else { return None };
        let middle = *joints.iter().find(|joint| !touches(joint))?;
        // The sides of a joint: body and axis of the cluster asked for, then of the other one.
        let sides = |joint: usize, of: usize| {
            let own = &linkage.joints[joint];
            let k = usize::from(cluster(own.of[0]) != of);
            [k, 1 - k].map(|side| (own.of[side], own.at[side].clone()))
        };
        let [p, p_beyond] = sides(*first, rest);
        let [q, q_beyond] = sides(*last, rest);
        let [m, m_beyond] = sides(middle, cluster(p_beyond.0));
        // Each link in the axes of the body that turns about p, or about q.
        let arm = state.fixed(&m, p_beyond.0, &self.squares)?;
        let hand = state.fixed(&m_beyond, q_beyond.0, &self.squares)?;
        if is_parallel(&arm, &p_beyond.1) || is_parallel(&hand, &q_beyond.1) {
            return None;
        }
        let number = self.squares.len();
        let [cosine, sine] = unknown(number);
        let reference = aligned(&[p.1.clone(), p_beyond.1.clone()]);
        let turn = product(&spun(&p.1, (&cosine, &sine)), &functions(&reference));
        let start = apply(&reference, &arm);
        let (square, part) = (dot(&p.1, &p.1), dot(&p.1, &start));
        let along: Direction = p.1.each_ref().map(|c| Rational::from(c * &part) / &square);
        let beside: Direction = std::array::from_fn(|k| Rational::from(&start[k] - &along[k]));
        let target = state.seen(&q, p.0, &self.squares);
        let against = |v: &Direction| dot(&constants(v), &target);
        let [u, v] = [against(&beside), against(&cross(&p.1, &start))];
        let w = against(&along).sub(&Function::constant(dot(&hand, &q_beyond.1)));
        let equation = u.mul(&cosine).add(&v.mul(&sine)).add(&w);
        let discriminant = w.mul(&w).sub(&u.mul(&u)).sub(&v.mul(&v).scale(&square.clone().recip()));
        // The other link from its two axes.
        let ends = [target.clone(), apply(&turn, &constants(&arm))];
        let normal = cross(&ends[0], &ends[1]);
        let unit = |k: usize| -> Direction { std::array::from_fn(|i| Rational::from(u8::from(i == k))) };
        let columns: [[Rational; 3]; 3] = std::array::from_fn(|k| combination(&unit(k), &q_beyond.1, &hand));
        let other: Matrix<Function> = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let parts = [&ends[0][i], &ends[1][i], &normal[i]].into_iter().zip(&columns[k]);
                parts.fold(Function::zero(), |sum, (part, c)| sum.add(&part.scale(c)))
            })
        });
        state.glue([p.0, p_beyond.0], &turn);
        state.glue([p.0, q_beyond.0], &other);
        self.squares.push(square);
        self.list.push(SphereDyad { equation, discriminant, axes: [p, m, q] });
        Some(())
    }

    /// Returns the sign of the determinant of every dyad in a real assembly; `None` where one is too close to 0.
    #[must_use]
    pub fn signs(&self, mode: &SphereMode) -> Option<Vec<bool>> {
        if !(mode.radius < NARROW) {
            return None;
        }
        let sign = |dyad: &SphereDyad| {
            let seen = |(body, axis): &(usize, Direction)| {
                let rotation = mode.bodies[*body].each_ref().map(|row| row.each_ref().map(|c: &Complex<f64>| c.re));
                let axis = axis.each_ref().map(Rational::to_f64);
                let length = dot(&axis, &axis).sqrt();
                apply(&rotation, &axis.map(|c| c / length))
            };
            let value = determinant(&dyad.axes.each_ref().map(seen));
            (value.abs() > CLEAR).then_some(value > 0.0)
        };
        self.list.iter().map(sign).collect()
    }
}

/// The rotation of the second body of a joint against the first from which its angle is counted here: exactly about the axis.
#[must_use]
pub fn start(linkage: &SphereLinkage, joint: usize) -> Matrix<Rational> {
    let own = &linkage.joints[joint];
    let zero = turned(own, &Angle::from_radians(0.0)).0;
    let is_about = apply(&zero, &own.at[1]) == own.at[0];
    let aligned = aligned(&own.at);
    if is_about {
        return zero;
    }
    // The rounded rotation turns the axis a little: the nearest one about the axis stands for it.
    let [u, _] = &own.at;
    let between = product(&zero, &transpose(&aligned));
    let twice: Rational = (0..3).map(|k| between[k][k].clone()).sum::<Rational>() - 1;
    let skew = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| Rational::from(&between[i][j] - &between[j][i]));
    let sine = dot(&skew, u) / dot(u, u);
    let below = Rational::from(&twice + 2);
    if below == 0 {
        return product(&half_turn(u), &aligned);
    }
    product(&about(u, &Rational::from(&sine / &below)), &aligned)
}

/// The rotation about an axis by twice the angle whose tangent, over the length of the axis, is given.
#[must_use]
pub fn about(axis: &Direction, x: &Rational) -> Matrix<Rational> {
    let across = Rational::from(x * x) * dot(axis, axis);
    let below = Rational::from(&across + 1);
    spun(axis, (&(Rational::from(1 - &across) / &below), &(Rational::from(x * 2) / &below)))
}
