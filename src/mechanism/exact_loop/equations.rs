//! The closure equations of a loop of few unknowns as polynomials over the rationals: in cosines, sines and distances.

use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{Motion, Vector, dot};
use rug::Rational;

/// An unknown of the loop, and the constant motion behind it.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// The kind of the unknown.
    pub variable: Variable,
    /// The constant behind it.
    pub behind: Motion<Rational>,
}

/// A system of equations.
#[derive(Clone, Debug)]
pub(crate) struct System {
    /// The number of variables.
    pub variables: usize,
    /// The equations.
    pub equations: Vec<Equation>,
    /// The unknowns as polynomials: cosine and sine of an angle, a distance and 0.
    pub unknowns: Vec<[Equation; 2]>,
}

/// A constant motion among polynomials.
pub(crate) fn lifted(motion: &Motion<Rational>) -> Option<Motion<Equation>> {
    motion.map(Equation::from_rational)
}

impl System {
    /// The unknowns of these steps, with the circles on which the pairs of angles lie; `None` for too many of them.
    fn of(steps: &[Step]) -> Option<Self> {
        let (mut variables, mut equations, mut unknowns) = (0, Vec::new(), Vec::new());
        for step in steps {
            let one = Equation::variable(variables);
            variables += 1;
            unknowns.push(match step.variable {
                Variable::Translation => [one, Equation::zero()],
                Variable::Rotation => {
                    let sine = Equation::variable(variables);
                    variables += 1;
                    equations.push(one.mul(&one).add(&sine.mul(&sine)).sub(&Equation::one()));
                    [one, sine]
                }
            });
            if variables > MOST_VARIABLES {
                return None;
            }
        }
        Some(Self { variables, equations, unknowns })
    }

    /// The motion of an unknown, or its inverse.
    fn motion(&self, steps: &[Step], k: usize, inverse: bool) -> Motion<Equation> {
        let [one, other] = &self.unknowns[k];
        let signed = |x: &Equation| if inverse { x.neg() } else { x.clone() };
        match steps[k].variable {
            Variable::Rotation => Motion::rotation_z(one.clone(), signed(other)),
            Variable::Translation => Motion::translation_z(signed(one)),
        }
    }

    /// `V G ...` of a stretch of the loop, polynomials.
    pub(crate) fn stretch(&self, steps: &[Step], from: usize, to: usize) -> Option<Motion<Equation>> {
        let mut product = Motion::identity();
        for (k, step) in steps.iter().enumerate().take(to).skip(from) {
            product = product.then_after(&self.motion(steps, k, false)).then_after(&lifted(&step.behind)?);
        }
        Some(product)
    }

    /// The equations of a loop `V1 G1 ... Vn Gn = 1`: one half of it is the inverse of the other one. `None` for too many
    /// unknowns.
    pub(crate) fn of_loop(steps: &[Step]) -> Option<Self> {
        let mut system = Self::of(steps)?;
        let middle = steps.len().div_ceil(2);
        let left = system.stretch(steps, 0, middle)?;
        let right = system.stretch(steps, middle, steps.len())?.inverse();
        for (one, other) in left.rotation.iter().flatten().zip(right.rotation.iter().flatten()) {
            system.equations.push(one.sub(other));
        }
        // The translation of the inverse has one more factor: instead of it the point of the cut, seen from the other side.
        for (one, other) in left.translation.iter().zip(&right.translation) {
            system.equations.push(one.sub(other));
        }
        Some(system)
    }

    /// The equations of a spherical joint whose centre the steps carry from one of its links to the other one,
    /// `V1 G1 ... Vn Gn p = q`. `None` for too many unknowns.
    pub(crate) fn of_point(steps: &[Step], target: &Vector<Rational>) -> Option<Self> {
        let mut system = Self::of(steps)?;
        let image = |p: &Vector<Rational>| -> Option<Vector<Equation>> {
            Some([Equation::from_rational(&p[0])?, Equation::from_rational(&p[1])?, Equation::from_rational(&p[2])?])
        };
        let origin: Vector<Equation> = std::array::from_fn(|_| Equation::zero());
        // The centre as seen behind each unknown, from both sides.
        let mut near = origin;
        let mut inner = Vec::new();
        for k in (0..steps.len()).rev() {
            near = lifted(&steps[k].behind)?.apply(&near);
            inner.push(near.clone());
            near = system.motion(steps, k, false).apply(&near);
        }
        inner.reverse();
        let mut far = image(target)?;
        if steps.is_empty() {
            system.equations.extend(near.iter().zip(&far).map(|(x, y)| x.sub(y)));
        }
        // All places where the two sides can meet: they say the same, and each says something in a low degree.
        for k in 0..steps.len() {
            let moved = system.motion(steps, k, false).apply(&inner[k]);
            system.equations.extend(moved.iter().zip(&far).map(|(x, y)| x.sub(y)));
            if steps[k].variable == Variable::Rotation {
                system.equations.push(dot(&inner[k], &inner[k]).sub(&dot(&far, &far)));
            }
            far = system.motion(steps, k, true).apply(&far);
            far = lifted(&steps[k].behind.inverse())?.apply(&far);
        }
        Some(system)
    }
}
