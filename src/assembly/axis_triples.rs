//! Triples of neighbouring axes that are parallel or meet in a point; two such triples make six joints dependent.
//!
//! Rotations about three parallel axes generate planar motions, those about three axes through a point spherical ones. Two
//! planes share the translation along both. Two points share the rotation about the line through them. A plane and a point
//! share the rotation about its normal there. So the six screws of two triples are dependent in every position.

use crate::kinematics::closed_loop::{OpenLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::decoupled::{Common, Decoupled, height};

/// Axes meet if their distance, over the longest link, is below this; they are parallel if the sine of their angle is.
const NEAR: f64 = 1e-10;

/// Three neighbouring axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisTriple {
    /// The first of the three unknowns.
    pub first: usize,
    /// Whether the axes are parallel; else they meet in a point.
    pub parallel: bool,
}

impl AxisTriple {
    /// Returns all triples that do not overlap, from the first unknown on, among the links of an open loop.
    #[must_use]
    pub fn all(open: &OpenLoop<f64>) -> Vec<Self> {
        let near = near(open);
        let mut found: Vec<Self> = Vec::new();
        for first in 0..4 {
            let free = found.last().is_none_or(|triple| triple.first + 3 <= first);
            if free && (first..first + 3).all(|k| open.variables[k] == Variable::Rotation) {
                let [before, behind] = [&open.constants[first], &open.constants[first + 1]];
                let parallel = is_parallel(before) && is_parallel(behind);
                let meet = || Some((crossing(&before.inverse(), near)? - crossing(behind, near)?).abs() <= near);
                if parallel || meet() == Some(true) {
                    found.push(Self { first, parallel });
                }
            }
        }
        found
    }
}

/// Returns the three rotations that a closed form takes out of an open loop of six. It prefers concurrent axes to parallel
/// ones if their positions are of the same degree.
pub(super) fn decoupled(open: &OpenLoop<f64>) -> Option<Decoupled> {
    if open.variables != [Variable::Rotation; 6] {
        return None;
    }
    let near = near(open);
    let through_a_point = (0..4).find_map(|first| {
        let [before, behind] = [&open.constants[first], &open.constants[first + 1]];
        let back = [before, behind].map(Motion::inverse);
        let on_middle = [crossing(&back[0], near)?, crossing(behind, near)?];
        let meet = (on_middle[0] - on_middle[1]).abs() <= near;
        meet.then_some(Decoupled { first, common: Common::Point })
    });
    through_a_point.or_else(|| {
        let are_parallel = |first: &usize| open.constants[*first..*first + 2].iter().all(is_parallel);
        (0..4).find(are_parallel).map(|first| Decoupled { first, common: Common::Direction })
    })
}

/// Returns the distance below which two axes meet.
fn near(open: &OpenLoop<f64>) -> f64 {
    let size = |m: &Motion<f64>| m.translation.iter().map(|x| x.abs()).fold(0.0, f64::max);
    NEAR * open.constants.iter().map(size).fold(0.0, f64::max)
}

/// Returns whether a link keeps the direction of the z axis.
fn is_parallel(link: &Motion<f64>) -> bool {
    link.rotation[0][2].hypot(link.rotation[1][2]) <= NEAR
}

/// Returns the point on the z axis at which its image under a link crosses it, if it does.
fn crossing(link: &Motion<f64>, near: f64) -> Option<f64> {
    let ([x, y, _], [u, v]) = (link.translation, [0, 1].map(|i| link.rotation[i][2]));
    let square = u * u + v * v;
    if !(square > NEAR * NEAR) || (x * v - y * u).abs() > near * square.sqrt() {
        return None;
    }
    height(link)
}
