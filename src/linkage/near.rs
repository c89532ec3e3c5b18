//! How far assemblies are from given joint values.

use super::answer::LinkageMode;
use crate::algebra::sort;
use crate::kinematics::linkage::{Linkage, LinkageJoint};
use std::f64::consts::TAU;

/// Returns by how much a joint misses a value, radians without full turns, or metres.
#[must_use]
pub fn off(joint: &LinkageJoint, value: f64, near: f64) -> f64 {
    let off = value - near;
    if joint.is_prismatic() { off } else { off - TAU * (off / TAU).round() }
}

/// Puts the real assemblies that are nearest to these values of joints first; joints without a value do not count.
pub fn sort_near(linkage: &Linkage, modes: &mut [LinkageMode], near: &[Option<f64>]) {
    let distance = |mode: &LinkageMode| -> f64 {
        if !mode.real {
            return f64::INFINITY;
        }
        let one = |((joint, value), near): ((&LinkageJoint, &Option<super::answer::Coordinate>), &Option<f64>)| {
            Some(off(joint, (*value)?.re, (*near)?).powi(2))
        };
        linkage.joints.iter().zip(&mode.joints).zip(near).filter_map(one).sum()
    };
    sort::by(modes, |a, b| distance(a).total_cmp(&distance(b)));
}
