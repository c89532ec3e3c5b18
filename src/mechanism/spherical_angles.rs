//! The angles of spherical joints along a curve: over power series, so that their rates come out of the same formulas.
//!
//! A spherical joint is three rotations about z, x and z again, the second one from 0 to pi.

use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::assembly::ss_dyad::farthest_axis;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, OpenSsDyad, Variable};
use crate::kinematics::link_form::{product, transposed};
use crate::kinematics::motion::{Motion, Vector, cross, dot};

/// A number with its first and second Taylor coefficient.
pub(super) type Jet = Series<f64, 3>;
/// The rotation of a spherical joint.
pub(super) type Rotation<S> = [[S; 3]; 3];

/// Sines below this leave two axes one: the line of the centres and an axis, or the first and the third one of a spherical joint.
const ONE_AXIS: f64 = 1e-9;

/// Returns the words that say at which position of its idle degree of freedom a loop of two spherical joints is shown, of which the second one
/// begins at this variable.
pub(super) fn idle_spin(chain: &Chain, layout: &Layout, second: usize) -> String {
    let variables = chain.variables();
    let joint = |first: usize| variables.get(first).map_or(1, |own| own.joint);
    let spherical_joints = [layout.spherical, layout.second_spherical].map(|spherical| joint(spherical.unwrap_or(0)));
    format!(
        "the link between the S joints {} and {} spins freely about the line of their centres: it is shown where joint {} is a \
         universal joint, one axis of it fixed in that link across the line, the other one along the z axis of the frame \
         behind the joint",
        spherical_joints[0],
        spherical_joints[1],
        joint(second)
    )
}

/// The square root of a positive series.
fn root(x: &Jet) -> Jet {
    let [a, b, c] = x.coefficients;
    let first = a.sqrt();
    let second = b / (2.0 * first);
    Series { coefficients: [first, second, (c - second * second) / (2.0 * first)] }
}

fn inverse(x: &Jet) -> Jet {
    let [a, b, c] = x.coefficients;
    let first = 1.0 / a;
    let second = -b * first * first;
    Series { coefficients: [first, second, -(c * first + b * second) * first] }
}

/// The angle of a pair (cos, sin), normalised or not: its rate is `(x y' - y x') / (x^2 + y^2)`.
fn angle(x: &Jet, y: &Jet) -> Jet {
    let rate = |z: &Jet| Series { coefficients: [z.coefficients[1], 2.0 * z.coefficients[2], 0.0] };
    let turned = x.mul(&rate(y)).sub(&y.mul(&rate(x)));
    let [first, second, _] = turned.mul(&inverse(&x.mul(x).add(&y.mul(y)))).coefficients;
    let start = y.coefficients[0].atan2(x.coefficients[0]);
    Series { coefficients: [start, first, second / 2.0] }
}

fn cos_sin(angle: &Jet) -> (Jet, Jet) {
    let (sin, cos) = angle.coefficients[0].sin_cos();
    angle.cos_sin_beyond(cos, sin).expect("every small number has an inverse in f64")
}

/// The rotation or translation of a variable.
fn motion(variable: Variable, value: &Jet) -> Motion<Jet> {
    match variable {
        Variable::Rotation => {
            let (cos, sin) = cos_sin(value);
            Motion::rotation_z(cos, sin)
        }
        Variable::Translation => Motion::translation_z(*value),
    }
}

fn lifted(r: &Rotation<f64>) -> Rotation<Jet> {
    r.map(|row| row.map(Series::constant))
}

/// The rotation with these angles.
fn rotation(angles: &[Jet; 3]) -> Rotation<Jet> {
    let about_z = |angle: &Jet| motion(Variable::Rotation, angle).rotation;
    let (cos, sin) = cos_sin(&angles[1]);
    product(&product(&about_z(&angles[0]), &Motion::rotation_x(cos, sin).rotation), &about_z(&angles[2]))
}

/// The angles of a rotation. Where the second one is 0 or pi the third one is taken for 0, and the others have rates if
/// the second one stays where it is.
fn angles(r: &Rotation<Jet>) -> [Jet; 3] {
    let across = [&r[0][2], &r[1][2]];
    let square = across[0].mul(across[0]).add(&across[1].mul(across[1]));
    if square.coefficients[0].sqrt() > ONE_AXIS {
        return [angle(&r[1][2].neg(), &r[0][2]), angle(&r[2][2], &root(&square)), angle(&r[2][1], &r[2][0])];
    }
    let stays = across.iter().flat_map(|x| x.coefficients).all(|c| c.abs() <= ONE_AXIS);
    let rates = |start: f64| if stays { [start, 0.0, 0.0] } else { [start, f64::NAN, f64::NAN] };
    let first = angle(&r[0][0], &r[1][0]);
    let first = if stays { first.coefficients } else { rates(first.coefficients[0]) };
    let second = if r[2][2].coefficients[0] > 0.0 { 0.0 } else { std::f64::consts::PI };
    [first, rates(second), rates(0.0)].map(|coefficients| Series { coefficients })
}

/// A spherical joint of a curve, turned on both sides, so that its angles are independent where those of the mechanism are not:
/// `X = A X' B` for constant rotations A and B in general position.
#[derive(Clone, Debug)]
pub(super) struct TurnedJoint {
    /// Its index among the variables of a point.
    pub unknown: usize,
    /// Index of its first joint variable.
    pub joint: usize,
    pub before: Rotation<f64>,
    pub behind: Rotation<f64>,
}

impl TurnedJoint {
    /// From the angles of the mechanism to those of the curve.
    pub fn inside(&self, own: [f64; 3]) -> [f64; 3] {
        let [before, behind] = [&self.before, &self.behind].map(|r| lifted(&transposed(r)));
        let turned = product(&product(&before, &rotation(&own.map(Series::constant))), &behind);
        angles(&turned).map(|angle| angle.coefficients[0])
    }

    /// From the angles of the curve to those of the mechanism.
    pub fn outside(&self, inside: &[Jet; 3]) -> [Jet; 3] {
        angles(&product(&product(&lifted(&self.before), &rotation(inside)), &lifted(&self.behind)))
    }
}

/// The angles of two spherical joints that couple an unknown V to the input, `X L Y K V H = I`: the second one is a universal joint,
/// with one axis fixed in L across the line of the centres and one along the z axis of the frame behind it (along its x
/// axis where that line is parallel to z). So the idle degree of freedom is the same as at a mode of the solver.
/// Not a number where both spherical joints have the same centre.
pub(super) fn ss_dyad_angles(open: &OpenSsDyad<Jet>, input: Variable, unknown: &Jet, given: &Jet) -> [[Jet; 3]; 2] {
    let ss_dyad = open.close(&motion(input, given));
    let rest = ss_dyad.before.then_after(&motion(ss_dyad.variable, unknown)).then_after(&ss_dyad.behind);
    let across = rest.inverse();
    let unit = |v: &Vector<Jet>| {
        let over = inverse(&root(&dot(v, v)));
        v.map(|x| x.mul(&over))
    };
    let columns = |x: &Vector<Jet>, y: &Vector<Jet>, z: &Vector<Jet>| -> Rotation<Jet> {
        std::array::from_fn(|i| [x[i], y[i], z[i]])
    };
    // A frame of the link along the line of the centres, as the solver takes it.
    let along = unit(&ss_dyad.link.translation);
    let helper = farthest_axis(&along.map(|x| x.coefficients[0]));
    let x = unit(&cross(&helper.map(Series::constant), &along));
    let own = columns(&x, &cross(&along, &x), &along);
    // The same frame at the second spherical joint.
    let line = unit(&across.translation);
    let column = |k: usize| -> Vector<Jet> { std::array::from_fn(|i| across.rotation[i][k]) };
    let mut side = cross(&line, &column(2));
    if dot(&side, &side).coefficients[0].sqrt() <= ONE_AXIS {
        side = cross(&line, &column(0).map(|x| x.neg()));
    }
    let x = unit(&side);
    let there = columns(&x, &cross(&line, &x), &line);
    let first = product(&there, &transposed(&own));
    let second = product(&transposed(&product(&first, &ss_dyad.link.rotation)), &across.rotation);
    [angles(&first), angles(&second)]
}
