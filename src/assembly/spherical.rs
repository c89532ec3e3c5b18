//! Loops with a spherical joint: first its centre, as the point that both sides reach, then the remaining rotation.
//!
//! A spherical joint is three rotations about z, x and z again, the second one from 0 to pi, so that every rotation is listed once.

use super::limits;
use super::mode::{Assembly, Mode, wrapped};
use super::search::{AS_IT_IS, Effort, Family, RootOutcome, Search};
use crate::certify::{certificate, certificate_in_any_frame};
use crate::elimination::point_reach::Reach;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::link_form::{product as matrix_product, transposed};
use crate::kinematics::motion::Motion;
use crate::solve::dense;
use crate::solve::newton::{Six, closure, coordinates, turn};
use crate::solve::scalar::Scalar;
use crate::solve::separated::{SeparatedRoots, pair};
use num_complex::Complex;
use std::f64::consts::PI;

type Rotation<S> = [[S; 3]; 3];

impl Search<'_> {
    /// Admits the loop at every position of the centre of the spherical joint that begins at this unknown.
    pub fn centre(&mut self, spherical: usize) {
        let reach = Reach::of(self.closed, spherical);
        let Some(found) = SeparatedRoots::of(&reach.equations, limits::REACH_DEPENDENT) else { return };
        self.assembly.tries += 1;
        let mut family = OfCentre { spherical, found: &found, reach: &reach, complex: None };
        self.assembly.all_resolved = self.all_roots(&mut family, found.roots());
    }

    /// Admits a loop with a spherical joint, in angles of that joint that are far from dependent.
    fn admit_spherical<S: Scalar>(&mut self, spherical: usize, others: &[(Variable, (S, S)); 3]) -> bool {
        let mut rest: Motion<S> = Motion::identity();
        for (k, (variable, pair)) in others.iter().enumerate() {
            turn(&mut rest, *variable, *pair);
            rest = rest.then_after(&lifted(&self.closed.constants[(spherical + 3 + k) % 6]));
        }
        let behind = lifted::<S>(&self.closed.constants[(spherical + 2) % 6]);
        let inverse = matrix_product(&behind.rotation, &rest.rotation);
        let rotation = transposed(&inverse);
        let mut start: Six<S> = [S::zero(); 6];
        for (k, (variable, (first, second))) in others.iter().enumerate() {
            start[(spherical + 3 + k) % 6] = match variable {
                Variable::Rotation => S::angle_of(*first, *second),
                Variable::Translation => *first,
            };
        }
        let (angles, lock) = spherical_angles(&rotation);
        if lock > limits::LOCKED {
            place(&mut start, spherical, angles);
            return self.admit(&start);
        }
        // Near the lock the spherical joint is described with its third angle about another axis.
        let turned = matrix_product(&rotation, &quarter().map(|row| row.map(S::from_f64)));
        place(&mut start, spherical, spherical_angles(&turned).0);
        let mut closed = self.closed.clone();
        let constant = &mut closed.constants[(spherical + 2) % 6];
        *constant = Motion { rotation: quarter(), translation: [0.0; 3] }.inverse().then_after(constant);
        let mut found = Assembly { tries: self.assembly.tries, ..Assembly::default() };
        let settled = Search {
            prepared: &[],
            closed: &closed,
            spherical: None,
            decoupled: None,
            all_list: None,
            arrangement: AS_IT_IS,
            is_deficient: false,
            gap_rounding: self.gap_rounding,
            roots: self.roots,
            effort: Effort::OnePencil,
            eigen: &mut *self.eigen,
            assembly: &mut found,
        }
        .admit(&start);
        for mut mode in found.modes {
            back(&mut mode, spherical);
            self.merge(mode);
        }
        settled
    }
}

/// The certificate of a mode of a loop with a spherical joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Error bound of the unknowns.
    pub radius: f64,
    /// Row-sum condition number of the Jacobian.
    pub condition: f64,
}

/// Proves that exactly one closure of a loop lies near these unknowns, in angles of the spherical joint (`spherical` is
/// its first unknown) that are far from dependent. Returns `None` if that cannot be shown.
#[must_use]
pub fn proof(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>, spherical: usize, real: bool) -> Option<Proof> {
    if real {
        return proof_in::<f64>(closed, &unknowns.map(|z| z.re), spherical);
    }
    proof_in(closed, unknowns, spherical)
}

fn proof_in<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>, spherical: usize) -> Option<Proof> {
    let rotation = spherical_rotation([0, 1, 2].map(|k| unknowns[(spherical + k) % 6]));
    let own = spherical_angles(&rotation).1;
    let (mut closed, mut start, mut enlarged) = (closed.clone(), *unknowns, 1.0);
    if !(own > limits::LOCKED) {
        // X = X' Q for a rotation Q by a right angle.
        let turned = product_with_inverse(&rotation, &quarter());
        place(&mut start, spherical, spherical_angles(&turned).0);
        let constant = &mut closed.constants[(spherical + 2) % 6];
        *constant = Motion { rotation: quarter(), translation: [0.0; 3] }.then_after(constant);
        // Near the lock the first and third angle are less accurate than the rotation; at the lock the third one is 0.
        enlarged = if own > limits::ONE_AXIS { 4.0 / own } else { 4.0 };
    }
    let here = closure(&closed, &start);
    let inverse = dense::inverse(&here.jacobian)?;
    let certificate = certificate(&here, &inverse).or_else(|| certificate_in_any_frame(&closed, &start, 0.0))?;
    let condition = dense::norm(&here.jacobian) * dense::norm(&inverse);
    Some(Proof { radius: certificate.radius * enlarged, condition })
}

/// Returns `a b^-1` for rotations.
fn product_with_inverse<S: Scalar>(a: &Rotation<S>, b: &Rotation<f64>) -> Rotation<S> {
    matrix_product(a, &transposed(&b.map(|row| row.map(S::from_f64))))
}

pub(super) fn lifted<S: Scalar>(motion: &Motion<f64>) -> Motion<S> {
    Motion {
        rotation: motion.rotation.map(|row| row.map(S::from_f64)),
        translation: motion.translation.map(S::from_f64),
    }
}

fn place<S: Copy>(unknowns: &mut Six<S>, spherical: usize, angles: [S; 3]) {
    for (k, angle) in angles.into_iter().enumerate() {
        unknowns[(spherical + k) % 6] = angle;
    }
}

/// Returns a rotation by a right angle about y.
pub(super) fn quarter() -> Rotation<f64> {
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]
}

/// Returns the rotation of a spherical joint.
pub(super) fn spherical_rotation<S: Scalar>(angles: [S; 3]) -> Rotation<S> {
    let about_z = |q: S| {
        let mut m: Motion<S> = Motion::identity();
        turn(&mut m, Variable::Rotation, coordinates(Variable::Rotation, q));
        m.rotation
    };
    let (cos, sin) = coordinates(Variable::Rotation, angles[1]);
    let about_x = Motion::rotation_x(cos, sin).rotation;
    matrix_product(&matrix_product(&about_z(angles[0]), &about_x), &about_z(angles[2]))
}

/// Returns the three angles of a spherical joint, and the sine of the second one. Where that is near 0 the other two are
/// dependent, and where it is 0 the third one is set to 0.
#[must_use]
pub fn spherical_angles<S: Scalar>(r: &Rotation<S>) -> ([S; 3], f64) {
    let cos = r[2][2];
    // The larger of two expressions for the square of the sine keeps its digits.
    let square = r[0][2].mul(&r[0][2]).add(&r[1][2].mul(&r[1][2]));
    let sin = square.root();
    let lock = sin.size();
    if !(lock > 1e-9) {
        return ([S::angle_of(r[0][0], r[1][0]), S::angle_of(cos, S::zero()), S::zero()], lock);
    }
    // Of a complex sine only this square root belongs to the other two angles.
    let over = |x: S| if S::REAL { x } else { x.over(sin) };
    let first = S::angle_of(over(r[1][2].neg()), over(r[0][2]));
    ([first, S::angle_of(cos, sin), S::angle_of(over(r[2][1]), over(r[2][0]))], lock)
}

/// Converts a mode of the rotated spherical joint to the angles of the joint as it is.
fn back(mode: &mut Mode, spherical: usize) {
    let angles = [0, 1, 2].map(|k| mode.unknowns[(spherical + k) % 6]);
    let quarter = quarter();
    let inverse: Rotation<Complex<f64>> = std::array::from_fn(|i| std::array::from_fn(|j| quarter[j][i].into()));
    let rotation = matrix_product(&spherical_rotation(angles), &inverse);
    let angles = if mode.real {
        spherical_angles(&rotation.map(|row| row.map(|z| z.re))).0.map(Complex::from)
    } else {
        spherical_angles(&rotation).0
    };
    place(&mut mode.unknowns, spherical, angles);
}

/// A real part nearer than this to 0 or pi does not distinguish an angle from its negative.
const EDGE: f64 = 1e-9;

/// Replaces the angles of a spherical joint by those of the same rotation with the second one from 0 to pi; if its real
/// part is 0 or pi, its imaginary part is positive.
pub(super) fn canonical(unknowns: &mut Six<Complex<f64>>, spherical: usize) {
    let index = |k: usize| (spherical + k) % 6;
    let (second, real) = (unknowns[index(1)], wrapped(unknowns[index(1)].re));
    let on_edge = real.abs().min(PI - real.abs()) < EDGE && second.im.abs() > EDGE;
    if if on_edge { second.im < 0.0 } else { real < 0.0 } {
        unknowns[index(1)] = -unknowns[index(1)];
        for k in [0, 2] {
            let angle = &mut unknowns[index(k)];
            angle.re = wrapped(angle.re + PI);
        }
    }
}

/// The positions of the centre of a spherical joint.
struct OfCentre<'a> {
    spherical: usize,
    found: &'a SeparatedRoots,
    reach: &'a Reach<f64>,
    complex: Option<Reach<Complex<f64>>>,
}

impl OfCentre<'_> {
    fn one<S: Scalar>(&self, reach: &Reach<S>, search: &mut Search<'_>, x: S) -> RootOutcome {
        let mut outcome = RootOutcome { shared: self.found.are_shared(), ..RootOutcome::nothing() };
        for monomials in self.found.monomials(x).into_iter().flatten() {
            let Some(middle) = reach.middle(monomials.each_ref()) else {
                outcome.unresolved = true;
                continue;
            };
            let [first, second, third] = reach.variables;
            let (near, far) = (pair(third, &monomials[0]), pair(first, &monomials[1]));
            let values = [(first, far), (second, middle), (third, near)];
            outcome.settled |= search.admit_spherical(self.spherical, &values);
        }
        outcome
    }
}

impl Family for OfCentre<'_> {
    fn real(&mut self, search: &mut Search<'_>, x: f64) -> RootOutcome {
        self.one(self.reach, search, x)
    }

    fn complex(&mut self, search: &mut Search<'_>, x: Complex<f64>) -> RootOutcome {
        let closed = search.closed;
        let reach = self.complex.take().unwrap_or_else(|| {
            let constants = closed.constants.each_ref().map(lifted::<Complex<f64>>);
            Reach::of(&ClosedLoop { variables: closed.variables, constants }, self.spherical)
        });
        let outcome = self.one(&reach, search, x);
        self.complex = Some(reach);
        outcome
    }
}
