//! Velocity and acceleration of every body of a chain at an instant.

use crate::algebra::series::Series;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use looproot_calculus::displacement::velocity::State;

/// A motion in time: place, velocity and half the acceleration.
pub type Moving = Motion<Series<f64, 3>>;

/// The bodies of a chain that moves: the base, and the body behind each joint.
#[derive(Clone, Debug)]
pub struct MovingChain {
    bodies: Vec<Moving>,
}

impl MovingChain {
    /// Returns the bodies of a chain whose joint variables have these values, rates and accelerations. `None` where a constant of
    /// the chain is not known in f64, and where a rate is not a number: that of an angle at a critical place of a spherical joint.
    #[must_use]
    pub fn of(chain: &Chain, q: &[f64], velocity: &[f64], acceleration: &[f64]) -> Option<Self> {
        let (variables, constants) = chain.unknowns_and_constants::<f64>()?;
        let constants: Vec<Moving> =
            constants.iter().map(|constant| constant.map(|x| Some(Series::constant(*x)))).collect::<Option<_>>()?;
        let run: Vec<[f64; 3]> =
            q.iter().zip(velocity).zip(acceleration).map(|((q, v), a)| [*q, *v, a / 2.0]).collect();
        if run.len() != variables.len() || run.iter().flatten().any(|x| !x.is_finite()) {
            return None;
        }
        let mut behind = Vec::new();
        let mut now = constants[0].clone();
        for ((variable, coefficients), constant) in variables.iter().zip(run).zip(&constants[1..]) {
            let value = Series { coefficients };
            let motion = match variable {
                Variable::Rotation => {
                    let (cos, sin) = value.cos_sin_beyond(coefficients[0].cos(), coefficients[0].sin())?;
                    Motion::rotation_z(cos, sin)
                }
                Variable::Translation => Motion::translation_z(value),
            };
            now = now.then_after(&motion);
            behind.push(now.clone());
            now = now.then_after(constant);
        }
        // A joint of several variables has one body behind the last of them.
        let mut bodies = vec![Motion::identity()];
        let mut last = 0;
        for kind in chain.joint_kinds() {
            last += kind.freedoms();
            bodies.push(behind.get(last.checked_sub(1)?)?.clone());
        }
        Some(Self { bodies })
    }

    /// Returns the number of bodies, the base counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Returns whether there is no body.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Returns the motion of every body.
    #[must_use]
    pub fn bodies(&self) -> &[Moving] {
        &self.bodies
    }

    /// Returns velocity and acceleration of a body against another one, in axes of the base at this instant.
    #[must_use]
    pub fn state(&self, body: usize, against: usize) -> Option<State<f64>> {
        let [body, against] = [self.bodies.get(body)?, self.bodies.get(against)?];
        Some(relative(body, against))
    }
}

/// Returns velocity and acceleration of a body against another one, in axes of the ground at this instant.
///
/// The motion against the other body, seen in a frame of the ground at which that body rests.
#[must_use]
pub fn relative(body: &Moving, against: &Moving) -> State<f64> {
    let here = against.map(|entry| Some(Series::constant(entry.coefficients[0])));
    let seen = against.inverse().then_after(body);
    State::of(&here.map_or_else(|| seen.clone(), |here| here.then_after(&seen)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::{Assembly, Roots, Workspace};
    use crate::catalogue::entry::Design;
    use crate::catalogue::{Any, Options, load_any};
    use crate::mechanism::{InputCurve, Mechanism};

    #[test]
    fn the_body_behind_the_last_joint_of_a_loop_rests() {
        for name in ["cccr_1_angle", "general_7r", "ccrrr_4_angle", "rrsrr", "bennett_a"] {
            let Any::Entry(entry) = load_any(name, &Options::default()).unwrap() else { panic!("a loop") };
            let Design::Loop(chain) = &entry.design else { panic!("a loop") };
            let case = &entry.cases[0];
            let curve = InputCurve::of(&entry, case).unwrap();
            let mechanism = Mechanism::prepare(&entry).unwrap();
            let found = mechanism.solve(case, Roots::All, &mut Workspace::default(), &mut Assembly::default()).unwrap();
            let mut count = 0;
            for mode in &found.modes {
                let Some(rates) = curve.derivatives(mode) else { continue };
                let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
                let Some(bodies) = MovingChain::of(chain, &q, &rates.velocity, &rates.acceleration) else { continue };
                let last = bodies.len() - 1;
                let rest = bodies.state(last, 0).unwrap();
                for v in [rest.omega, rest.velocity, rest.alpha, rest.acceleration] {
                    assert!(v.iter().all(|x| x.abs() < 1e-6), "{name}: {v:?}");
                }
                count += 1;
            }
            assert!(count > 0, "{name}");
        }
    }
}
