//! The closure equations of a linkage in space or on the sphere about a configuration: products of dual quaternions round its loops,
//! and power series that satisfy them.

use super::freedoms::{Freedom, opposite};
use crate::algebra::dual::Dual;
use crate::algebra::ring::Ring;
use crate::mobility::planar::Reduced;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::quaternion::DualQuaternion;
use rug::Rational;

/// A factor `1 + u l` of a product.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// Which variable u is.
    pub(super) variable: usize,
    /// The vector part of l.
    line: DualQuaternion<Rational>,
}

/// A variable.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// Its joint.
    pub(super) joint: usize,
    /// Whether the joint has no other one.
    pub(super) is_single: bool,
    /// The square of the length of its line's direction: the variable is the tangent of half an angle over that length.
    pub(super) square: Rational,
}

/// The loops of a linkage.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub(super) loops: Vec<Vec<Step>>,
    pub(super) variables: Vec<Variable>,
    /// Conditions of every loop: three on the sphere, six in space.
    pub(super) conditions: usize,
}

fn quaternion(line: &Line<Rational>) -> DualQuaternion<Rational> {
    let part = |k: usize| Dual { value: line.direction[k].clone(), epsilon: line.moment[k].clone() };
    DualQuaternion { scalar: Dual::zero(), vector: [part(0), part(1), part(2)] }
}

fn none() -> DualQuaternion<Rational> {
    DualQuaternion { scalar: Dual::zero(), vector: std::array::from_fn(|_| Dual::zero()) }
}

/// Adds `u q` to a sum.
fn add_times(sum: &mut DualQuaternion<Rational>, u: &Rational, q: &DualQuaternion<Rational>) {
    if *u == 0 {
        return;
    }
    let add = |sum: &mut Dual<Rational>, part: &Dual<Rational>| {
        sum.value += Rational::from(u * &part.value);
        sum.epsilon += Rational::from(u * &part.epsilon);
    };
    add(&mut sum.scalar, &q.scalar);
    for (sum, part) in sum.vector.iter_mut().zip(&q.vector) {
        add(sum, part);
    }
}

impl System {
    /// Writes down the loops of bodies and joints: of every joint its two bodies and its freedoms.
    pub(super) fn of(bodies: usize, ground: usize, joints: &[([usize; 2], Vec<Freedom>)], conditions: usize) -> Self {
        let mut variables = Vec::new();
        let mut first = Vec::new();
        for (joint, (_, freedoms)) in joints.iter().enumerate() {
            first.push(variables.len());
            variables.extend(freedoms.iter().map(|freedom| {
                let square =
                    freedom.iter().take(1).flat_map(|line| &line.direction).map(|c| Rational::from(c * c)).sum();
                Variable { joint, is_single: freedoms.len() == 1, square }
            }));
        }
        // A tree of the shortest ways to the ground: of every body the joint that leads there.
        let mut way: Vec<Option<Vec<(usize, bool)>>> = vec![None; bodies];
        way[ground] = Some(Vec::new());
        let mut reached = vec![ground];
        let mut is_tree = vec![false; joints.len()];
        let mut next = 0;
        while next < reached.len() {
            let body = reached[next];
            next += 1;
            for (joint, (of, _)) in joints.iter().enumerate() {
                let Some(side) = of.iter().position(|own| *own == body) else { continue };
                if way[of[1 - side]].is_some() {
                    continue;
                }
                is_tree[joint] = true;
                let path = way[body].iter().flatten().copied().chain([(joint, side == 0)]).collect();
                way[of[1 - side]] = Some(path);
                reached.push(of[1 - side]);
            }
        }
        let steps = |(joint, is_forward): (usize, bool)| -> Vec<Step> {
            let mut list = Vec::new();
            for (k, freedom) in joints[joint].1.iter().enumerate() {
                for line in freedom {
                    let line = if is_forward { quaternion(line) } else { quaternion(&opposite(line)) };
                    list.push(Step { variable: first[joint] + k, line });
                }
            }
            if !is_forward {
                list.reverse();
            }
            list
        };
        let mut loops = Vec::new();
        for (joint, (of, _)) in joints.iter().enumerate().filter(|(joint, _)| !is_tree[*joint]) {
            let [there, back] = of.map(|body| way[body].clone().unwrap_or_default());
            let common = there.iter().zip(&back).take_while(|(a, b)| a == b).count();
            let round = there[common..].iter().copied().chain([(joint, true)]);
            let round = round.chain(back[common..].iter().rev().map(|(joint, is_forward)| (*joint, !is_forward)));
            loops.push(round.flat_map(steps).collect());
        }
        Self { loops, variables, conditions }
    }

    /// The system of one of its loops alone, in the same variables.
    pub(super) fn only(&self, one: usize) -> Self {
        Self { loops: vec![self.loops[one].clone()], ..self.clone() }
    }

    /// The variables that occur.
    pub(super) fn used(&self) -> Vec<usize> {
        let is_used = |k: &usize| self.loops.iter().flatten().any(|step| step.variable == *k);
        (0..self.variables.len()).filter(is_used).collect()
    }

    /// The conditions of a product: its vector part.
    fn conditions_of(&self, product: &DualQuaternion<Rational>) -> Vec<Rational> {
        let values = product.vector.iter().map(|part| part.value.clone());
        let moments = product.vector.iter().map(|part| part.epsilon.clone());
        values.chain(moments).take(self.conditions).collect()
    }

    /// The derivatives of the conditions by these variables.
    fn jacobian(&self, columns: &[usize]) -> Vec<Vec<Rational>> {
        let mut rows = vec![vec![Rational::new(); columns.len()]; self.conditions * self.loops.len()];
        for (k, steps) in self.loops.iter().enumerate() {
            for step in steps {
                let Some(column) = columns.iter().position(|own| *own == step.variable) else { continue };
                for (i, part) in self.conditions_of(&step.line).into_iter().enumerate() {
                    rows[self.conditions * k + i][column] += part;
                }
            }
        }
        rows
    }
}

/// The conditions, solved for as many variables as they determine to first order.
pub(super) struct Solver<'a> {
    system: &'a System,
    /// Combinations of the conditions: the first ones give the pivots, the others are left.
    combinations: Vec<Vec<Rational>>,
    pivots: Vec<usize>,
    /// The variables that are no pivots, each with its first-order motion.
    pub(super) free: Vec<(usize, Vec<Rational>)>,
}

impl<'a> Solver<'a> {
    /// Solves for the first variables of a list where that can be.
    pub(super) fn of(system: &'a System, columns: &[usize]) -> Self {
        let jacobian = system.jacobian(columns);
        let size = jacobian.len();
        let unit = |k: usize| (0..size).map(move |j| Rational::from(u8::from(j == k)));
        let beside: Vec<Vec<Rational>> =
            jacobian.iter().enumerate().map(|(k, row)| row.iter().cloned().chain(unit(k)).collect()).collect();
        let reduced = Reduced::of(&beside, columns.len());
        let motion = |place: usize| {
            let mut motion = vec![Rational::new(); system.variables.len()];
            motion[columns[place]] = Rational::from(1);
            for (row, pivot) in reduced.rows.iter().zip(&reduced.pivots) {
                motion[columns[*pivot]] = Rational::from(-&row[place]);
            }
            (columns[place], motion)
        };
        let free = (0..columns.len()).filter(|place| !reduced.pivots.contains(place)).map(motion).collect();
        let combinations = reduced.rows.iter().map(|row| row[columns.len()..].to_vec()).collect();
        let pivots = reduced.pivots.iter().map(|place| columns[*place]).collect();
        Self { system, combinations, pivots, free }
    }

    /// The rank of the conditions.
    pub(super) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Follows a first-order motion, whose free variables stay linear: the coefficients of all variables up to the last order.
    ///
    /// # Errors
    /// The order in which a condition fails.
    pub(super) fn follow(&self, motion: &[Rational], last: usize) -> Result<Vec<Vec<Rational>>, usize> {
        let system = self.system;
        let mut values: Vec<Vec<Rational>> = motion.iter().map(|v| vec![Rational::new(), v.clone()]).collect();
        // Of every step of every loop, the coefficients of the product before it times its line.
        let mut before: Vec<Vec<Vec<DualQuaternion<Rational>>>> =
            system.loops.iter().map(|steps| steps.iter().map(|step| vec![step.line.clone()]).collect()).collect();
        for order in 1..=last {
            if order > 1 {
                for series in &mut values {
                    series.push(Rational::new());
                }
            }
            let mut rest = Vec::new();
            // Of every step the coefficient of the product behind it, where the unknown coefficients are 0.
            let mut behind: Vec<Vec<DualQuaternion<Rational>>> = Vec::new();
            for (steps, before) in system.loops.iter().zip(&before) {
                let mut product = none();
                let mut list = Vec::new();
                for (step, before) in steps.iter().zip(before) {
                    for j in 1..=order {
                        add_times(&mut product, &values[step.variable][j], &before[order - j]);
                    }
                    list.push(product.clone());
                }
                rest.extend(system.conditions_of(&product));
                behind.push(list);
            }
            let dot = |row: &Vec<Rational>| {
                row.iter().zip(&rest).fold(Rational::new(), |sum, (a, b)| {
                    if *a == 0 || *b == 0 { sum } else { sum + Rational::from(a * b) }
                })
            };
            let combined: Vec<Rational> = self.combinations.iter().map(dot).collect();
            if combined[self.rank()..].iter().any(|c| *c != 0) {
                return Err(order);
            }
            if order > 1 {
                for (pivot, value) in self.pivots.iter().zip(combined) {
                    values[*pivot][order] = -value;
                }
            }
            for ((steps, before), behind) in system.loops.iter().zip(&mut before).zip(behind) {
                let mut change = none();
                for k in 0..steps.len() {
                    if k > 0 {
                        // The product before step k is the one behind step k - 1.
                        let mut product = behind[k - 1].clone();
                        add_times(&mut product, &Rational::from(1), &change);
                        before[k].push(product.mul(&steps[k].line));
                    } else {
                        before[k].push(none());
                    }
                    if order > 1 && self.pivots.contains(&steps[k].variable) {
                        add_times(&mut change, &values[steps[k].variable][order], &steps[k].line);
                    }
                }
            }
        }
        Ok(values)
    }
}
