//! Four-bars on the sphere: transfer functions and coupler curves as polynomials.

mod curve;
mod side;
mod symbolic;
mod transfer;

pub use curve::{SpecialPoint, SphereCurve, sides as sphere_sides, sphere_trace};
pub(crate) use side::Side;
pub use symbolic::{SphereEnd, SphereSymbol, SphereSymbolic, sphere_with_symbols};
pub use transfer::{Transfer, transfer};

use crate::error::{Error, Result};
use crate::kinematics::sphere::{Direction, SphereLinkage};

/// A four-bar of a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FourBar {
    /// Its joints: ground and crank, crank and coupler, coupler and rocker, rocker and ground.
    pub joints: [usize; 4],
    /// Ground, crank, coupler and rocker.
    pub bodies: [usize; 4],
}

/// Returns the joints of a body, each with the body at its other end.
fn around(linkage: &SphereLinkage, body: usize) -> Vec<(usize, usize)> {
    let ends = linkage.joints.iter().enumerate().filter_map(|(k, joint)| match joint.of {
        [a, b] if a == body => Some((k, b)),
        [a, b] if b == body => Some((k, a)),
        _ => None,
    });
    ends.collect()
}

/// Returns the axis of a joint in one of its bodies.
fn axis(linkage: &SphereLinkage, joint: usize, body: usize) -> &Direction {
    let joint = &linkage.joints[joint];
    &joint.at[usize::from(joint.of[0] != body)]
}

impl FourBar {
    /// Returns the four-bar with this body as coupler.
    ///
    /// # Errors
    /// If it is the coupler of no four-bar.
    pub fn around(linkage: &SphereLinkage, coupler: usize) -> Result<Self> {
        let to_ground = |body: usize| {
            around(linkage, body).into_iter().find(|(_, other)| *other == linkage.ground).map(|(joint, _)| joint)
        };
        let sides: Vec<(usize, usize, usize)> = around(linkage, coupler)
            .into_iter()
            .filter(|(_, other)| *other != linkage.ground)
            .filter_map(|(joint, other)| Some((joint, other, to_ground(other)?)))
            .collect();
        let pair = sides.iter().flat_map(|a| sides.iter().map(move |b| (a, b))).find(|(a, b)| a.0 < b.0 && a.1 != b.1);
        let name = &linkage.bodies[coupler].name;
        let (a, b) = pair.ok_or_else(|| {
            Error::Unsupported(format!(
                "the curve of a point of {name}, which is no coupler of a four-bar on the sphere"
            ))
        })?;
        Ok(Self { joints: [a.2, a.0, b.0, b.2], bodies: [linkage.ground, a.1, coupler, b.1] })
    }

    /// Returns the four-bar whose crank is joined to the ground by a joint; it contains none of the bodies `before` but the crank.
    fn of_crank(linkage: &SphereLinkage, joint: usize, crank: usize, before: &[usize]) -> Option<Self> {
        let is_new = |body: &usize| *body != linkage.ground && *body != crank && !before.contains(body);
        around(linkage, crank).into_iter().filter(|(_, coupler)| is_new(coupler)).find_map(|(second, coupler)| {
            around(linkage, coupler).into_iter().filter(|(_, rocker)| is_new(rocker)).find_map(|(third, rocker)| {
                let ends = around(linkage, rocker);
                let (fourth, _) = ends.into_iter().find(|(_, other)| *other == linkage.ground)?;
                Some(Self { joints: [joint, second, third, fourth], bodies: [linkage.ground, crank, coupler, rocker] })
            })
        })
    }
}

/// Returns the four-bars in series behind a joint at the ground: the rocker of each is the crank of the next.
///
/// # Errors
/// [`Error::Unsupported`] for another joint, and if its crank drives no four-bar or more than two.
fn series(linkage: &SphereLinkage, input: usize) -> Result<Vec<FourBar>> {
    let [a, b] = linkage.joints[input].of;
    let name = &linkage.joints[input].name;
    let mut crank = match (a == linkage.ground, b == linkage.ground) {
        (true, _) => b,
        (_, true) => a,
        _ => {
            return Err(Error::Unsupported(format!(
                "a transfer function from the joint {name}, which is not at the ground"
            )));
        }
    };
    let (mut joint, mut before, mut list) = (input, Vec::new(), Vec::new());
    while let Some(four) = FourBar::of_crank(linkage, joint, crank, &before) {
        before.extend([crank, four.bodies[2]]);
        (joint, crank) = (four.joints[3], four.bodies[3]);
        list.push(four);
    }
    if list.is_empty() {
        return Err(Error::Unsupported(format!(
            "a transfer function from the joint {name}, whose crank drives no four-bar"
        )));
    }
    // What lies between two four-bars is eliminated from two quadratic equations.
    if list.len() > 2 {
        return Err(Error::Unsupported(format!(
            "a transfer function from the joint {name} through more than two four-bars"
        )));
    }
    Ok(list)
}
