//! Dynamics of planar linkages: reduced inertia, accelerations, constraint forces, motion by steps in time.
//!
//! The virtual power of masses, weights and constraint forces gives `M a + h - Q = J^T l`, with angle and origin of every moving
//! body as coordinates, the Jacobian J of the closure equations and multipliers l, which are the forces of the joints.
//! \[Wittenburg2016, 19.3 and 19.4\]

use super::rates::{Body, Moving, freedoms, jacobian, joint_value, moved, moving, open};
use crate::catalogue::masses::Masses;
use crate::kinematics::linkage::{Given, Linkage, Pair};
use differential_equations::ivp::IVP;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::ODE;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};

/// Most parts of the time between two rows, behind each of which loops are closed again.
const PARTS: usize = 256;
/// Between two rows the energy may change by this share of the largest of its parts, else the parts are halved.
const KEPT: f64 = 1e-10;
/// Error that a step of the integrator may make, as a share of every number and in radians, metres and seconds.
const TOLERANCE: f64 = 1e-12;
/// A singular value below this share of the largest one stands for 0.
const SINGULAR: f64 = 1e-10;

/// A linkage with its masses.
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'a> {
    /// Bodies and joints.
    pub linkage: &'a Linkage,
    /// Masses and gravity.
    pub masses: &'a Masses,
}

/// Equations of motion in the inputs as coordinates: `inertia q'' + bias + potential = 0`.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The inertia matrix.
    pub inertia: DMatrix<f64>,
    /// The part due to the rates: for one freedom `M' q'^2/2`.
    pub bias: DVector<f64>,
    /// The derivatives of the potential energy.
    pub potential: DVector<f64>,
    /// The accelerations of the inputs; `None` where the inertia has no inverse.
    pub acceleration: Option<DVector<f64>>,
}

/// The force and the moment that the first body of a joint exerts on the second, in axes of the ground; of a revolute joint the
/// moment is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// The force, newtons, at the point of the joint in the second body.
    pub force: [f64; 2],
    /// The moment, newton metres.
    pub moment: f64,
}

/// One row of a motion.
#[derive(Clone, Debug)]
pub struct Row {
    /// Seconds from the start.
    pub time: f64,
    /// The value of every joint and its rate; `None` of gears.
    pub joints: Vec<Option<[f64; 2]>>,
    /// Kinetic and potential energy together, joules.
    pub energy: f64,
}

impl Loaded<'_> {
    /// Mass matrix, what rates give, and weights, by angle and origin of every moving body.
    fn parts(&self, bodies: &[Body]) -> (DMatrix<f64>, DVector<f64>, DVector<f64>) {
        let moved = moved(self.linkage);
        let size = 3 * moved.len();
        let (mut matrix, mut bias) = (DMatrix::zeros(size, size), DVector::zeros(size));
        let mut weight = DVector::zeros(size);
        for (k, body) in moved.iter().enumerate() {
            let Some(own) = &self.masses.bodies[*body] else { continue };
            let [x, y] = bodies[*body].turned(own.centre).map(|part| part.coefficients[0]);
            let rate = bodies[*body].angle.coefficients[1];
            let (m, at) = (own.mass, 3 * k);
            matrix[(at, at)] = own.inertia + m * (x * x + y * y);
            for (part, arm) in [(1, -y), (2, x)] {
                matrix[(at, at + part)] = m * arm;
                matrix[(at + part, at)] = m * arm;
                matrix[(at + part, at + part)] = m;
            }
            bias[at + 1] = -m * rate * rate * x;
            bias[at + 2] = -m * rate * rate * y;
            let [gx, gy] = self.masses.gravity;
            weight[at] = m * (x * gy - y * gx);
            weight[at + 1] = m * gx;
            weight[at + 2] = m * gy;
        }
        (matrix, bias, weight)
    }

    /// The equations of motion in the inputs, which run at these rates; `None` at a limit position of theirs.
    #[must_use]
    pub fn reduced(&self, given: &[Given], rest: &[Body], rates: &[f64]) -> Option<Reduced> {
        let count = freedoms(given);
        let run = |rates: &dyn Fn(usize) -> f64| {
            let runs: Vec<Moving> = (0..count).map(|k| Moving { coefficients: [0.0, rates(k), 0.0, 0.0] }).collect();
            moving(self.linkage, given, rest, &runs)
        };
        let mut columns = Vec::new();
        for k in 0..count {
            let bodies = run(&|j| if j == k { 1.0 } else { 0.0 })?;
            columns.push(self.stacked(&bodies, 1));
        }
        let ways = DMatrix::from_columns(&columns);
        let bodies = run(&|k| rates.get(k).copied().unwrap_or(0.0))?;
        let accelerations = self.stacked(&bodies, 2) * 2.0;
        let (matrix, bias, weight) = self.parts(&bodies);
        let inertia = ways.transpose() * &matrix * &ways;
        let bias = ways.transpose() * (matrix * accelerations + bias);
        let potential = -(ways.transpose() * weight);
        let acceleration = inertia.clone().lu().solve(&-(&bias + &potential));
        Some(Reduced { inertia, bias, potential, acceleration })
    }

    /// Coefficients of one order of angle and origin of every moving body.
    fn stacked(&self, bodies: &[Body], order: usize) -> DVector<f64> {
        let part = |body: &Body| [&body.angle, &body.origin[0], &body.origin[1]].map(|s| s.coefficients[order]);
        DVector::from_vec(moved(self.linkage).iter().flat_map(|body| part(&bodies[*body])).collect())
    }

    /// Sets the coefficients of one order of angle and origin of every moving body.
    fn set(&self, bodies: &mut [Body], order: usize, values: &DVector<f64>) {
        for (k, body) in moved(self.linkage).iter().enumerate() {
            let Body { angle, origin: [x, y] } = &mut bodies[*body];
            for (part, series) in [angle, x, y].into_iter().enumerate() {
                series.coefficients[order] = values[3 * k + part];
            }
        }
    }

    /// Bodies at places with rates, and no more.
    fn state(&self, still: &[Body], places: &DVector<f64>, rates: &DVector<f64>) -> Vec<Body> {
        let mut bodies = still.to_vec();
        self.set(&mut bodies, 0, places);
        self.set(&mut bodies, 1, rates);
        for order in [2, 3] {
            self.set(&mut bodies, order, &DVector::zeros(places.len()));
        }
        bodies
    }

    /// Accelerations and multipliers; `None` where masses and joints do not determine them.
    fn accelerations(&self, bodies: &[Body]) -> Option<(DVector<f64>, DVector<f64>)> {
        let constraints = |bodies: &[Body]| open(self.linkage, bodies);
        let j = jacobian(self.linkage, bodies, &constraints);
        let (matrix, bias, weight) = self.parts(bodies);
        let (rows, size) = j.shape();
        let mut all = DMatrix::zeros(size + rows, size + rows);
        all.view_mut((0, 0), (size, size)).copy_from(&matrix);
        all.view_mut((0, size), (size, rows)).copy_from(&-j.transpose());
        all.view_mut((size, 0), (rows, size)).copy_from(&j);
        let mut right = DVector::zeros(size + rows);
        right.rows_mut(0, size).copy_from(&(weight - bias));
        // Without accelerations the closure equations open by J' v, half of which is their coefficient of order 2.
        for (row, equation) in constraints(bodies).iter().enumerate() {
            right[size + row] = -2.0 * equation.coefficients[2];
        }
        let found = all.full_piv_lu().solve(&right)?;
        let is_finite = found.iter().all(|x| x.is_finite());
        is_finite.then(|| (found.rows(0, size).into_owned(), found.rows(size, rows).into_owned()))
    }

    /// The forces in all joints at a position, with the inputs running at these rates and no drive; `None` where they are not
    /// determined.
    #[must_use]
    pub fn reactions(&self, given: &[Given], rest: &[Body], rates: &[f64]) -> Option<Vec<Option<Reaction>>> {
        let (_, multipliers, bodies) = self.start(given, rest, rates)?;
        Some(of_joints(self.linkage, &bodies, &multipliers))
    }

    /// Accelerations, multipliers and bodies where the inputs run at these rates.
    fn start(&self, given: &[Given], rest: &[Body], rates: &[f64]) -> Option<(DVector<f64>, DVector<f64>, Vec<Body>)> {
        let rate = |k: usize| rates.get(k).copied().unwrap_or(0.0);
        let runs: Vec<Moving> =
            (0..freedoms(given)).map(|k| Moving { coefficients: [0.0, rate(k), 0.0, 0.0] }).collect();
        let bodies = moving(self.linkage, given, rest, &runs)?;
        let bodies = self.state(&bodies, &self.stacked(&bodies, 0), &self.stacked(&bodies, 1));
        let (accelerations, multipliers) = self.accelerations(&bodies)?;
        Some((accelerations, multipliers, bodies))
    }

    /// Kinetic and potential energy together.
    #[must_use]
    pub fn energy(&self, bodies: &[Body]) -> f64 {
        let (matrix, _, _) = self.parts(bodies);
        let rates = self.stacked(bodies, 1);
        let kinetic = 0.5 * rates.dot(&(matrix * &rates));
        let potential = bodies.iter().zip(&self.masses.bodies).filter_map(|(body, own)| {
            let own = own.as_ref()?;
            let [x, y] = body.place(own.centre).map(|part| part.coefficients[0]);
            Some(-own.mass * (self.masses.gravity[0] * x + self.masses.gravity[1] * y))
        });
        kinetic + potential.sum::<f64>()
    }

    /// Returns the motion from a position, by the method of order 8 of Dormand and Prince with step control, projected back to closed
    /// loops. Between two rows it takes as many parts, with a projection behind each, as conserve the energy. `None` where
    /// accelerations are not determined on the way.
    #[must_use]
    pub fn motion(&self, given: &[Given], rest: &[Body], rates: &[f64], time: f64, steps: usize) -> Option<Vec<Row>> {
        let (_, _, mut bodies) = self.start(given, rest, rates)?;
        let between = time / steps as f64;
        let mut rows = vec![self.row(0.0, &bodies)];
        let mut parts = 1;
        for k in 1..=steps {
            let (next, used) = self.next(&bodies, between, parts)?;
            // The next row may need fewer again.
            parts = (used / 2).max(1);
            bodies = next;
            rows.push(self.row(time * k as f64 / steps as f64, &bodies));
        }
        Some(rows)
    }

    /// Returns the bodies after `time`, and the number of parts, at least `least`, that conserves the energy.
    fn next(&self, bodies: &[Body], time: f64, least: usize) -> Option<(Vec<Body>, usize)> {
        let before = self.energy(bodies);
        let mut parts = least;
        loop {
            let mut now = bodies.to_vec();
            for _ in 0..parts {
                now = self.advanced(&now, time / parts as f64)?;
            }
            let (matrix, _, _) = self.parts(&now);
            let rates = self.stacked(&now, 1);
            let kinetic = rates.dot(&(matrix * &rates));
            let size = kinetic.abs().max(before.abs());
            if (self.energy(&now) - before).abs() <= KEPT * size || parts >= PARTS {
                return Some((now, parts));
            }
            parts *= 2;
        }
    }

    fn row(&self, time: f64, bodies: &[Body]) -> Row {
        let joint = |k: usize| joint_value(self.linkage, bodies, k).map(|s| [s.coefficients[0], s.coefficients[1]]);
        Row { time, joints: (0..self.linkage.joints.len()).map(joint).collect(), energy: self.energy(bodies) }
    }

    /// Integrates over a time, and closes the loops again.
    fn advanced(&self, bodies: &[Body], time: f64) -> Option<Vec<Body>> {
        let free = FirstOrder { loaded: self, still: bodies };
        let size = 3 * moved(self.linkage).len();
        let start: Vec<f64> = self.stacked(bodies, 0).iter().chain(&self.stacked(bodies, 1)).copied().collect();
        let method = ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(TOLERANCE);
        let solution = IVP::ode(&free, 0.0, time, start).method(method).solve().ok()?;
        let last = solution.y.last().filter(|y| y.iter().all(|x| x.is_finite()))?;
        let mut next = DVector::from_column_slice(last.get(..size)?);
        let mut rate = DVector::from_column_slice(last.get(size..)?);
        // Back to closed loops by the shortest way, then rates along the loops.
        for _ in 0..2 {
            let now = self.state(bodies, &next, &rate);
            let open = open(self.linkage, &now);
            let gaps = DVector::from_vec(open.iter().map(|s| s.coefficients[0]).collect());
            let j = jacobian(self.linkage, &now, &|bodies| super::rates::open(self.linkage, bodies));
            let svd = finite(j.clone()).svd(true, true);
            let small = SINGULAR * svd.singular_values.max();
            next -= svd.solve(&gaps, small).ok()?;
            rate -= svd.solve(&(j * &rate), small).ok()?;
        }
        Some(self.state(bodies, &next, &rate))
    }
}

/// Returns the forces and moments in all joints by the multipliers of their equations, in the order of these.
pub(super) fn of_joints(linkage: &Linkage, bodies: &[Body], multipliers: &DVector<f64>) -> Vec<Option<Reaction>> {
    let mut at = 0;
    let one = |joint: &crate::kinematics::linkage::LinkageJoint| {
        let own = [multipliers.get(at).copied(), multipliers.get(at + 1).copied()];
        match (&joint.pair, own) {
            (Pair::Revolute, [Some(x), Some(y)]) => {
                at += 2;
                Some(Reaction { force: [x, y], moment: 0.0 })
            }
            (Pair::Prismatic { along, length, .. }, [Some(moment), Some(across)]) => {
                at += 2;
                let size = crate::algebra::number::nearest_f64(length);
                let [x, y] = super::rates::pair(along).map(|c| c / size);
                let [x, y] = bodies[joint.of[0]].turned([x, y]).map(|part| part.coefficients[0]);
                Some(Reaction { force: [-y * across, x * across], moment })
            }
            // Gears have one equation: their force is that of the mesh, which the file does not place.
            (Pair::Gear { .. }, _) => {
                at += 1;
                None
            }
            _ => None,
        }
    };
    linkage.joints.iter().map(one).collect()
}

/// The equations of motion of first order: places, then rates.
struct FirstOrder<'a, 'b> {
    loaded: &'a Loaded<'b>,
    still: &'a [Body],
}

impl ODE<f64, Vec<f64>> for FirstOrder<'_, '_> {
    fn diff(&self, _: f64, y: &Vec<f64>, slope: &mut Vec<f64>) {
        let (places, rates) = y.split_at(y.len() / 2);
        let [places, rates] = [places, rates].map(DVector::from_column_slice);
        let found = self.loaded.accelerations(&self.loaded.state(self.still, &places, &rates));
        // Where there are no accelerations, numbers that are none end the integration.
        let accelerations = found.map_or_else(|| rates.map(|_| f64::NAN), |(accelerations, _)| accelerations);
        for (slope, value) in slope.iter_mut().zip(rates.iter().chain(&accelerations)) {
            *slope = *value;
        }
    }
}
