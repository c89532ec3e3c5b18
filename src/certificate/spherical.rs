//! The four-bars of linkages on the sphere as the data of certificates write them.

use super::four_bars::{IRRATIONAL, OTHER_LINKAGE, round_loop};
use super::linkage::{mirrored, scaled, square};
use super::sweep::{FourBar, Output};
use crate::algebra::ring::Ring;
use crate::catalogue::{SphereFile, root};
use crate::kinematics::linkage::Gaussian;
use crate::kinematics::motion::dot;
use crate::kinematics::sphere::{Direction, is_parallel};
use rug::Rational;
use serde_json::Value;

/// The frame whose z axis is a direction, turned by the half-turn about the line between both: its axes are the rows. `None` if the
/// length of the direction is irrational.
fn frame(direction: &Direction) -> Option<[Direction; 3]> {
    let (length, is_rational) = root(&dot(direction, direction));
    let [x, y, z] = direction.each_ref().map(|part| Rational::from(part / &length));
    // The half-turn about x takes z to its opposite.
    let about = if z == -1 { [1, 0, 0].map(Rational::from) } else { [x, y, z + 1] };
    let norm = dot(&about, &about);
    let entry = |i: usize, j: usize| Rational::from(&about[i] * &about[j]) * 2 / &norm - i32::from(i == j);
    is_rational.then(|| std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
}

/// Returns the coordinates of a direction in a frame: those across the z axis, and that along it.
fn coordinates(frame: &[Direction; 3], direction: &Direction) -> (Gaussian, Rational) {
    let [re, im, height] = frame.each_ref().map(|row| dot(row, direction));
    (Gaussian { re, im }, height)
}

/// Returns the data of a linkage on the sphere of which a joint turns, by its index.
///
/// # Errors
/// A clause that says why there is no certificate.
pub fn data_of_turning_sphere(file: &SphereFile, joint: usize) -> Result<Value, String> {
    let (linkage, case) = (&file.linkage, file.cases.first().ok_or("there is no case")?);
    // The value of the input itself may be any angle.
    if !file.exact {
        return Err(IRRATIONAL.to_owned());
    }
    if case.given.iter().any(|given| given.joint != Some(joint)) {
        return Err("linkages with further given values are not covered".to_owned());
    }
    let of: Vec<[usize; 2]> = linkage.joints.iter().map(|joint| joint.of).collect();
    let found = if linkage.bodies.len() == 4 { round_loop(&of, joint, false) } else { None };
    let (order, bodies) = found.ok_or(OTHER_LINKAGE)?;
    let place = |joint: usize, body: usize| {
        let joint = &linkage.joints[joint];
        &joint.at[usize::from(joint.of[1] == body)]
    };
    if (0..4).any(|k| is_parallel(place(order[k], bodies[k]), place(order[(k + 1) % 4], bodies[k]))) {
        return Err("linkages on the sphere with a body whose two axes coincide are not covered".to_owned());
    }
    four_bar(linkage.joints[joint].zero.each_ref(), order, bodies, &place)
        .and_then(|bar| bar.written())
        .ok_or_else(|| "an axis of irrational length, or `zero` of others, is not covered".to_owned())
}

/// Returns the four-bar; `None` if one of its numbers is irrational. `zeros` are the directions from which and to which the input is measured.
fn four_bar<'l>(
    zeros: [&Direction; 2],
    [input, second, third, output]: [usize; 4],
    [b, c, d, a]: [usize; 4],
    place: &dyn Fn(usize, usize) -> &'l Direction,
) -> Option<FourBar> {
    let (fixed, moved) = (frame(place(input, a))?, frame(place(input, b))?);
    // The rotation about the axis that takes the second zero to the first, where the input is 0.
    let turn = coordinates(&fixed, zeros[0]).0.mul(&mirrored(&coordinates(&moved, zeros[1]).0));
    let (length, is_rational) = root(&square(&turn));
    let turn = Some(scaled(&turn, &length.recip())).filter(|_| is_rational)?;
    let (crank, height) = coordinates(&moved, place(second, b));
    let crank = crank.mul(&turn);
    let side: Direction = std::array::from_fn(|k| Rational::from(&place(third, c)[k] - &place(second, c)[k]));
    let (last, axis) = (place(third, d), place(output, d));
    let norm = dot(axis, axis);
    let along = dot(last, axis);
    let radius = dot(last, last) - Rational::from(along.square_ref()) / &norm;
    let (across, up) = coordinates(&fixed, place(output, a));
    let axis = [across.re, across.im, up];
    let mut centre = axis.each_ref().map(|part| Rational::from(part * &along) / &norm);
    centre[2] -= height;
    let output = Output::Circle { coupler: dot(&side, &side), radius };
    Some(FourBar { crank: [crank.re, crank.im], axis, place: centre, output })
}
