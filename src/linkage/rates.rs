//! Velocities, accelerations and third derivatives of all bodies of an assembly in the plane, as series in time.
//!
//! Coefficient k of every closure equation is affine in coefficient k of the unknowns, with one matrix for all orders: the
//! Jacobian. The orders follow one another by one linear system each.

use super::answer::LinkageMode;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use looproot_calculus::finite::finite;
use looproot_calculus::unit::Analytic;
use nalgebra::{DMatrix, DVector};

/// A number that moves: value, and derivatives over 1!, 2!, 3!.
pub type Moving = Series<f64, 4>;

/// A singular value below this share of the largest one stands for 0.
const SINGULAR: f64 = 1e-10;

/// Rates below this stand for 0, where those of all bodies together have the size 1.
const STILL: f64 = 1e-7;

/// The place of a body relative to the ground.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its angle.
    pub angle: Moving,
    /// The place of its origin.
    pub origin: [Moving; 2],
}

impl Body {
    /// A body that rests at a place.
    #[must_use]
    pub fn at(angle: f64, [x, y]: [f64; 2]) -> Self {
        Self { angle: Moving::constant(angle), origin: [Moving::constant(x), Moving::constant(y)] }
    }

    /// The place of a point of the body.
    #[must_use]
    pub fn place(&self, [x, y]: [f64; 2]) -> [Moving; 2] {
        let [dx, dy] = self.turned([x, y]);
        [self.origin[0].add(&dx), self.origin[1].add(&dy)]
    }

    /// A vector of the body in axes of the ground.
    #[must_use]
    pub fn turned(&self, [x, y]: [f64; 2]) -> [Moving; 2] {
        let (cos, sin) = self.angle.cos_sin_of();
        let (x, y) = (Moving::constant(x), Moving::constant(y));
        [cos.mul(&x).sub(&sin.mul(&y)), sin.mul(&x).add(&cos.mul(&y))]
    }

    fn parts(&mut self) -> [&mut Moving; 3] {
        let [x, y] = &mut self.origin;
        [&mut self.angle, x, y]
    }
}

/// The bodies of a real assembly at rest.
#[must_use]
pub fn resting(mode: &LinkageMode) -> Vec<Body> {
    mode.bodies.iter().map(|(angle, [x, y])| Body::at(angle.re, [x.re, y.re])).collect()
}

/// A point as two numbers.
#[must_use]
pub fn pair(z: &Gaussian) -> [f64; 2] {
    [nearest_f64(&z.re), nearest_f64(&z.im)]
}

/// The closure equations of a linkage, two for every joint and one for every pair of gears.
#[must_use]
pub fn open(linkage: &Linkage, bodies: &[Body]) -> Vec<Moving> {
    let mut list = Vec::new();
    for joint in &linkage.joints {
        let [a, b] = joint.of.map(|body| &bodies[body]);
        let (p, q) = (a.place(pair(&joint.at[0])), b.place(pair(&joint.at[1])));
        let apart = [q[0].sub(&p[0]), q[1].sub(&p[1])];
        match &joint.pair {
            Pair::Revolute => list.extend(apart),
            Pair::Prismatic { along, turn, length } => {
                let ([x, y], length) = (pair(along), nearest_f64(length));
                let [x, y] = a.turned([x / length, y / length]);
                let [re, im] = pair(turn);
                let angle = Moving::constant(im.atan2(re));
                list.push(wrapped(&b.angle.sub(&a.angle).sub(&angle)));
                list.push(x.mul(&apart[1]).sub(&y.mul(&apart[0])));
            }
            Pair::Gear { carrier, ratio, phase } => {
                let against = |body: &Body| body.angle.sub(&bodies[*carrier].angle);
                let [p, q] = [ratio.numer(), ratio.denom()].map(|n| Moving::constant(n.to_f64()));
                let [re, im] = pair(phase);
                let phase = Moving::constant(im.atan2(re));
                list.push(wrapped(&q.mul(&against(b).sub(&phase)).sub(&p.mul(&against(a)))));
            }
        }
    }
    list
}

/// An angle with a value in [-pi, pi].
fn wrapped(angle: &Moving) -> Moving {
    let turns = (angle.coefficients[0] / std::f64::consts::TAU).round();
    angle.sub(&Moving::constant(turns * std::f64::consts::TAU))
}

/// The value of a joint: the turn of the second body against the first, or its way along the line; `None` of gears.
#[must_use]
pub fn joint_value(linkage: &Linkage, bodies: &[Body], joint: usize) -> Option<Moving> {
    let joint = &linkage.joints[joint];
    let [a, b] = joint.of.map(|body| &bodies[body]);
    match &joint.pair {
        Pair::Revolute => Some(wrapped(&b.angle.sub(&a.angle))),
        Pair::Prismatic { along, length, .. } => {
            let ([x, y], length) = (pair(along), nearest_f64(length));
            let [x, y] = a.turned([x / length, y / length]);
            let (p, q) = (a.place(pair(&joint.at[0])), b.place(pair(&joint.at[1])));
            Some(x.mul(&q[0].sub(&p[0])).add(&y.mul(&q[1].sub(&p[1]))))
        }
        Pair::Gear { .. } => None,
    }
}

/// Returns the values that inputs prescribe: one joint value each, or three numbers for a body that is placed.
#[must_use]
pub fn prescribed(linkage: &Linkage, given: &[Given], bodies: &[Body]) -> Vec<Moving> {
    let one = |given: &Given| match given {
        Given::Turn { joint, .. } | Given::Shift { joint, .. } => {
            joint_value(linkage, bodies, *joint).into_iter().collect::<Vec<_>>()
        }
        Given::Place { body, .. } => {
            let Body { angle, origin: [x, y] } = &bodies[*body];
            vec![*angle, *x, *y]
        }
    };
    given.iter().flat_map(one).collect()
}

/// Returns the number of values that the inputs prescribe.
#[must_use]
pub fn freedoms(given: &[Given]) -> usize {
    given.iter().map(|one| if matches!(one, Given::Place { .. }) { 3 } else { 1 }).sum()
}

/// The bodies that move.
#[must_use]
pub fn moved(linkage: &Linkage) -> Vec<usize> {
    (0..linkage.bodies.len()).filter(|body| *body != linkage.ground).collect()
}

/// The Jacobian of equations by angle and origin of every moving body, in this order.
#[must_use]
pub fn jacobian(linkage: &Linkage, bodies: &[Body], of: &dyn Fn(&[Body]) -> Vec<Moving>) -> DMatrix<f64> {
    let still: Vec<Body> = bodies
        .iter()
        .map(|body| Body::at(body.angle.coefficients[0], [0, 1].map(|k| body.origin[k].coefficients[0])))
        .collect();
    let moved = moved(linkage);
    let rows = of(&still).len();
    let mut matrix = DMatrix::zeros(rows, 3 * moved.len());
    for (k, body) in moved.iter().enumerate() {
        for part in 0..3 {
            let mut pushed = still.clone();
            pushed[*body].parts()[part].coefficients[1] = 1.0;
            for (row, equation) in of(&pushed).iter().enumerate() {
                matrix[(row, 3 * k + part)] = equation.coefficients[1];
            }
        }
    }
    matrix
}

/// The joints that move, to first order, while the inputs rest.
#[must_use]
pub fn movable(linkage: &Linkage, given: &[Given], rest: &[Body]) -> Vec<usize> {
    let equations = |bodies: &[Body]| [open(linkage, bodies), prescribed(linkage, given, bodies)].concat();
    let matrix = jacobian(linkage, rest, &equations);
    // With fewer rows than columns a decomposition would not hold the whole null space.
    let rows = matrix.nrows().max(matrix.ncols());
    let svd = finite(matrix.resize_vertically(rows, 0.0)).svd(false, true);
    let Some(ways) = svd.v_t else { return Vec::new() };
    let largest = svd.singular_values.max();
    let free = (0..svd.singular_values.len()).filter(|k| svd.singular_values[*k] <= SINGULAR * largest);
    let moved = moved(linkage);
    let motions: Vec<Vec<Body>> = free
        .map(|k| {
            let mut bodies = rest.to_vec();
            for (place, body) in moved.iter().enumerate() {
                for (part, series) in bodies[*body].parts().into_iter().enumerate() {
                    series.coefficients[1] = ways[(k, 3 * place + part)];
                }
            }
            bodies
        })
        .collect();
    let rate = |bodies: &Vec<Body>, joint: usize| {
        joint_value(linkage, bodies, joint).map_or(0.0, |value| value.coefficients[1].abs())
    };
    (0..linkage.joints.len()).filter(|joint| motions.iter().any(|bodies| rate(bodies, *joint) > STILL)).collect()
}

/// The motion of all bodies where the inputs run as these series, whose values themselves are not looked at. `None` at a
/// position where the inputs do not determine the rates: a limit position of theirs.
#[must_use]
pub fn moving(linkage: &Linkage, given: &[Given], rest: &[Body], runs: &[Moving]) -> Option<Vec<Body>> {
    let equations = |bodies: &[Body]| [open(linkage, bodies), prescribed(linkage, given, bodies)].concat();
    let matrix = jacobian(linkage, rest, &equations);
    let svd = finite(matrix).svd(true, true);
    let largest = svd.singular_values.max();
    let unknowns = 3 * moved(linkage).len();
    if svd.singular_values.len() < unknowns || !(svd.singular_values.min() > SINGULAR * largest) {
        return None;
    }
    let mut bodies = rest.to_vec();
    for order in 1..4 {
        let found = equations(&bodies);
        let inputs = found.len().checked_sub(runs.len())?;
        let wanted = |row: usize| row.checked_sub(inputs).map_or(0.0, |k| runs[k].coefficients[order]);
        let right: Vec<f64> =
            found.iter().enumerate().map(|(row, now)| wanted(row) - now.coefficients[order]).collect();
        let step = svd.solve(&DVector::from_vec(right), 0.0).ok()?;
        for (k, body) in moved(linkage).iter().enumerate() {
            for (part, series) in bodies[*body].parts().into_iter().enumerate() {
                series.coefficients[order] += step[3 * k + part];
            }
        }
    }
    Some(bodies)
}
