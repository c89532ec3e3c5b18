//! Points of a platform that coincide exactly or lie in an affine relation, and the bound on the number of poses that follows for
//! legs of any length. docs/platforms.md, theorems 3 to 6, has the proofs.

use super::affine_platform::AffineRelation;
use super::border::DIMENSION;
use super::platform_far::far_solutions;
use super::platform_null::null_solutions;
use super::triangle_platform::pairs;
use crate::kinematics::motion::{Vector, cross};
use crate::kinematics::platform::Platform;
use rug::Rational;

/// Bound where three legs meet, or where all legs meet in pairs in the corners of a triangle.
const POSES: usize = 16;
/// Reason where lines through points of both bodies, or solutions at infinity, leave fewer poses than six general legs have.
const NULL: &str = "the others of the 40 solutions of six legs have N = 0, whatever the legs are";

/// Returns a bound on the number of isolated poses, with multiplicity, and its reason; `None` where no such incidence is known.
#[must_use]
pub fn most_poses(platform: &Platform<Rational>) -> Option<(usize, &'static str)> {
    let meet =
        |points: &[Vector<Rational>; 6]| (0..6).any(|i| (i + 1..6).filter(|&j| points[j] == points[i]).count() >= 2);
    if meet(&platform.plate) || meet(&platform.base) {
        return Some((POSES, "three legs meet in a point"));
    }
    let affine = AffineRelation::of(platform).map(|relation| relation.bound());
    let pairs = in_pairs(platform).then_some((POSES, "the legs meet in pairs in the corners of a triangle"));
    let affine = affine.map(|bound| (bound.poses, bound.because));
    let null = match null_solutions(platform) + far_solutions(platform) {
        0 => None,
        null => Some((DIMENSION.saturating_sub(null), NULL)),
    };
    // The theorems speak of platforms that have a pose at some lengths of the legs.
    pairs.into_iter().chain(affine).chain(null).min_by_key(|(poses, _)| *poses).filter(|(poses, _)| *poses > 0)
}

/// Whether the legs meet in pairs in the corners of a triangle.
fn in_pairs(platform: &Platform<Rational>) -> bool {
    let Some(pairs) = pairs(platform) else { return false };
    let points = if pairs.at_base { &platform.base } else { &platform.plate };
    let [a, b, c] = pairs.legs.map(|[leg, _]| &points[leg]);
    let side = |p: &Vector<Rational>| -> Vector<Rational> { std::array::from_fn(|k| Rational::from(&p[k] - &a[k])) };
    cross(&side(b), &side(c)).iter().any(|x| *x != 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(points: [[i32; 3]; 6]) -> [Vector<Rational>; 6] {
        points.map(|p| p.map(Rational::from))
    }

    const GENERAL: [[i32; 3]; 6] = [[0, 0, 0], [3, 1, 0], [4, 5, 1], [1, 4, 2], [-2, 3, 1], [-1, 1, 5]];

    #[test]
    fn three_equal_points_are_met_in_either_body() {
        let mut triple = GENERAL;
        (triple[2], triple[5]) = (triple[0], triple[0]);
        let platform = Platform { base: points(GENERAL), plate: points(triple) };
        assert_eq!(most_poses(&platform).map(|most| most.0), Some(16));
        let platform = Platform { base: points(triple), plate: points(GENERAL) };
        assert_eq!(most_poses(&platform).map(|most| most.0), Some(16));
        let mut other = GENERAL;
        other[3] = [2, 7, -4];
        let five_equal = Platform { base: points(GENERAL), plate: points(other) };
        assert_eq!(most_poses(&five_equal).map(|most| most.0), Some(36));
        let plate = points([[1, 0, 0], [2, 3, 1], [0, 4, 2], [-3, 1, 5], [1, -2, 7], [4, 4, -1]]);
        assert_eq!(most_poses(&Platform { base: points(GENERAL), plate }), None);
    }

    #[test]
    fn pairs_need_a_triangle() {
        let corners = |c: [[i32; 3]; 3]| points([c[0], c[0], c[1], c[1], c[2], c[2]]);
        let triangle = Platform { base: points(GENERAL), plate: corners([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) };
        assert_eq!(most_poses(&triangle).map(|most| most.0), Some(16));
        let line = Platform { base: points(GENERAL), plate: corners([[0, 0, 0], [1, 0, 0], [2, 0, 0]]) };
        assert_eq!(most_poses(&line), None);
    }
}
