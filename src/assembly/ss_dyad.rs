//! Loops with two spherical joints: the link between them spins freely, and is shown at one angle of that spin.

use super::limits;
use super::mode::{Assembly, Roots};
use super::search::{AS_IT_IS, Effort, Search};
use super::solver::Workspace;
use super::spherical::{lifted, quarter, spherical_angles, spherical_rotation};
use crate::elimination::spherical_pair::equation;
use crate::kinematics::closed_loop::{ClosedLoop, SsDyad, Variable};
use crate::kinematics::link_form::{product, transposed};
use crate::kinematics::motion::{Motion, Vector, cross, dot, unit_near};
use crate::solve::newton::{Six, turn};
use crate::solve::scalar::Scalar;
use crate::solve::separated::{pair, zeros};
use num_complex::Complex;

type Rotation<S> = [[S; 3]; 3];
type Angles = [Complex<f64>; 3];

/// Finds the positions of both joints. Fills `assembly` with modes whose last unknown is that of the loop, and returns
/// for each of them the angles of both spherical joints, about z, x and z.
pub fn solve(
    ss_dyad: &SsDyad<f64>,
    roots: Roots,
    workspace: &mut Workspace,
    assembly: &mut Assembly,
) -> Vec<[Angles; 2]> {
    assembly.clear();
    (assembly.all_resolved, assembly.tries) = (true, 1);
    let (scale, ss_dyad) = scaled(ss_dyad);
    let row = equation(&ss_dyad);
    let [constant, first, second] = row;
    let discriminant = match ss_dyad.variable {
        Variable::Rotation => first * first + second * second - constant * constant,
        Variable::Translation => 0.25 * first * first - constant,
    };
    let mut spherical_joints = Vec::new();
    if discriminant >= 0.0 {
        for m in zeros::<f64>(ss_dyad.variable, &row).into_iter().flatten() {
            one(&ss_dyad, pair(ss_dyad.variable, &m), roots, workspace, assembly, &mut spherical_joints);
        }
    } else if roots == Roots::All
        && let Some(m) = zeros::<Complex<f64>>(ss_dyad.variable, &row.map(Complex::from))[0]
    {
        one(&ss_dyad, pair(ss_dyad.variable, &m), roots, workspace, assembly, &mut spherical_joints);
    }
    if ss_dyad.variable == Variable::Translation {
        for mode in &mut assembly.modes {
            mode.unknowns[5] *= scale;
        }
    }
    spherical_joints
}

/// Returns the mean length of the links as a power of two, 1 without lengths, and the loop with lengths over it. Limits
/// for small numbers are relative to it.
fn scaled(ss_dyad: &SsDyad<f64>) -> (f64, SsDyad<f64>) {
    let links = [&ss_dyad.link, &ss_dyad.before, &ss_dyad.behind];
    let mean = links.map(|motion| dot(&motion.translation, &motion.translation)).iter().sum::<f64>() / 3.0;
    let scale = unit_near(mean.sqrt());
    let [link, before, behind] = links.map(|motion| motion.over(scale));
    (scale, SsDyad { link, before, behind, ..ss_dyad.clone() })
}

/// Admits one position of the loop.
fn one<S: Scalar>(
    ss_dyad: &SsDyad<f64>,
    value: (S, S),
    roots: Roots,
    workspace: &mut Workspace,
    assembly: &mut Assembly,
    spherical_joints: &mut Vec<[Angles; 2]>,
) {
    // X L Y = (K V H)^-1
    let mut rest = lifted::<S>(&ss_dyad.before);
    turn(&mut rest, ss_dyad.variable, value);
    let across = rest.then_after(&lifted(&ss_dyad.behind)).inverse();
    let link = ss_dyad.link.translation;
    let Some(frame) = frame_along(&link) else { return };
    let frame_s = frame.map(|row| row.map(S::from_f64));
    let Some(toward) = rotation_between(&link.map(S::from_f64), &across.translation, &frame_s) else { return };
    // At any spin the first joint orients the link, and the second one is the remaining rotation.
    let left = product(&transposed(&product(&toward, &frame_s)), &across.rotation);
    // The second joint is a rotation about the link, the idle degree of freedom, and two more, in the better of two ways.
    let quarters = [Motion::identity().rotation, quarter()];
    let tries = quarters.map(|q| spherical_angles(&product(&left, &transposed(&q.map(|row| row.map(S::from_f64))))));
    let chosen = usize::from(tries[1].1 > tries[0].1);
    let ([spin, second, third], behind) = (tries[chosen].0, quarters[chosen]);
    let (cos, sin) = spin.cos_sin_of();
    let spun = product(&product(&frame_s, &Motion::rotation_z(cos, sin).rotation), &transposed(&frame_s));
    let first_spherical = product(&toward, &spun);
    let tries =
        quarters.map(|q| spherical_angles(&product(&first_spherical, &transposed(&q.map(|row| row.map(S::from_f64))))));
    let chosen = usize::from(tries[1].1 > tries[0].1);
    let (angles, before) = (tries[chosen].0, quarters[chosen]);
    let constant = |rotation: Rotation<f64>| Motion { rotation, translation: [0.0; 3] };
    let to_x = constant(quarter());
    let back = to_x.inverse();
    let to_link =
        constant(before).then_after(&Motion::translation(link)).then_after(&constant(frame)).then_after(&to_x);
    let closed = ClosedLoop {
        variables: [
            Variable::Rotation,
            Variable::Rotation,
            Variable::Rotation,
            Variable::Rotation,
            Variable::Rotation,
            ss_dyad.variable,
        ],
        constants: [
            to_x,
            back.clone(),
            to_link,
            back,
            constant(behind).then_after(&ss_dyad.before),
            ss_dyad.behind.clone(),
        ],
    };
    let last = match ss_dyad.variable {
        Variable::Rotation => S::angle_of(value.0, value.1),
        Variable::Translation => value.0,
    };
    let start: Six<S> = [angles[0], angles[1], angles[2], second, third, last];
    let mut found = Assembly::default();
    Search {
        prepared: &[],
        closed: &closed,
        spherical: None,
        decoupled: None,
        all_list: None,
        arrangement: AS_IT_IS,
        is_deficient: false,
        gap_rounding: 0.0,
        roots,
        effort: Effort::OnePencil,
        eigen: workspace.eigen(),
        assembly: &mut found,
    }
    .admit(&start);
    for mode in found.modes {
        let [a, b, c, beta, gamma, _] = mode.unknowns;
        let one = product(&spherical_rotation([a, b, c]), &lift(before));
        // F^-1 R_L Y = Rx(beta) Rz(gamma) Q
        let turned = product(&spherical_rotation([Complex::from(0.0), beta, gamma]), &lift(behind));
        let joints_here = held(&one, &turned, &lift(frame), &lift(ss_dyad.link.rotation));
        spherical_joints.push(joints_here.map(|r| plain_angles(&r, mode.real)));
        assembly.modes.push(mode);
    }
}

fn lift(rotation: Rotation<f64>) -> Rotation<Complex<f64>> {
    rotation.map(|row| row.map(Complex::from))
}

/// Returns the rotations X and Y of both spherical joints at the chosen position of the idle degree of freedom, from X
/// and `F^-1 R_L Y` at any. There the second joint is a universal joint. One of its axes is the x axis of the frame F of the
/// link, whose z axis is the line of the centres; the other is the z axis of the frame behind that joint, or its x axis if
/// that line is parallel to z.
fn held(
    one: &Rotation<Complex<f64>>,
    turned: &Rotation<Complex<f64>>,
    frame: &Rotation<Complex<f64>>,
    link: &Rotation<Complex<f64>>,
) -> [Rotation<Complex<f64>>; 2] {
    let (angles, lock) = spherical_angles(turned);
    let spin = if lock > limits::ONE_AXIS {
        angles[0]
    } else {
        spherical_angles(&product(turned, &transposed(&lift(quarter())))).0[0]
    };
    let (cos, sin) = spin.cos_sin_of();
    let turn = Motion::rotation_z(cos, sin).rotation;
    let first = product(&product(one, &product(frame, &turn)), &transposed(frame));
    let second = product(&product(&transposed(link), &product(frame, &transposed(&turn))), turned);
    [first, second]
}

fn plain_angles(rotation: &Rotation<Complex<f64>>, real: bool) -> Angles {
    if real {
        spherical_angles(&rotation.map(|row| row.map(|z| z.re))).0.map(Complex::from)
    } else {
        spherical_angles(rotation).0
    }
}

/// Returns the coordinate axis farthest from a direction, the first of those that are equally far but for rounding.
#[must_use]
pub fn farthest_axis(along: &Vector<f64>) -> Vector<f64> {
    let smallest = (1..3).fold(0, |best, i| if along[i].abs() + limits::SAME < along[best].abs() { i } else { best });
    std::array::from_fn(|i| if i == smallest { 1.0 } else { 0.0 })
}

/// Returns a frame whose z axis lies along a vector; `None` for the zero vector.
fn frame_along(v: &Vector<f64>) -> Option<Rotation<f64>> {
    let length = dot(v, v).sqrt();
    if !(length > limits::REACH_DEPENDENT) {
        return None;
    }
    let z = v.map(|x| x / length);
    let x = cross(&farthest_axis(&z), &z);
    let size = dot(&x, &x).sqrt();
    let x = x.map(|c| c / size);
    let y = cross(&z, &x);
    Some(std::array::from_fn(|i| [x[i], y[i], z[i]]))
}

/// Returns a rotation that carries one vector to another of the same length; `frame` has its z axis along the first.
fn rotation_between<S: Scalar>(from: &Vector<S>, to: &Vector<S>, frame: &Rotation<S>) -> Option<Rotation<S>> {
    let square = dot(from, from);
    // The shortest rotation, or a half turn before it if that is not unique.
    let opposite = square.add(&dot(from, to)).size() < 0.5 * square.size();
    let start = if opposite { from.map(|x| x.neg()) } else { *from };
    let axis = cross(&start, to);
    let inverse = square.inverse()?;
    let factor = square.add(&dot(&start, to)).inverse()?.mul(&inverse);
    let hat = |v: &Vector<S>| -> Rotation<S> {
        let nought = S::zero();
        [[nought, v[2].neg(), v[1]], [v[2], nought, v[0].neg()], [v[1].neg(), v[0], nought]]
    };
    let (linear, quadratic) = (hat(&axis), product(&hat(&axis), &hat(&axis)));
    let shortest: Rotation<S> = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let one = if i == j { S::one() } else { S::zero() };
            one.add(&linear[i][j].mul(&inverse)).add(&quadratic[i][j].mul(&factor))
        })
    });
    if !opposite {
        return Some(shortest);
    }
    // The half turn about the frame's x axis reverses the vector.
    let half = Motion::rotation_x(S::one().neg(), S::zero()).rotation;
    Some(product(&shortest, &product(&product(frame, &half), &transposed(frame))))
}
