//! The convex hull of a few points, as triangles.

use super::Point;
use super::lines::{distance, minus};
use crate::kinematics::motion::{cross, dot};

/// Points nearer to a plane than this part of the extent lie on it.
const FLAT: f64 = 1e-9;

/// The triangles of the convex hull, seen from outside against the clock; of points in a plane those of their polygon, and
/// none of points in a line. Every plane of three points is tried, which is quick for a few dozen of them.
#[must_use]
pub fn hull(points: &[Point]) -> Vec<[usize; 3]> {
    let size = points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b))).fold(0.0, f64::max);
    let mut seen: Vec<Vec<usize>> = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..points.len() {
        for j in 0..i {
            for k in 0..j {
                let normal = cross(&minus(&points[j], &points[i]), &minus(&points[k], &points[i]));
                let length = dot(&normal, &normal).sqrt();
                if length <= FLAT * size * size {
                    continue;
                }
                let height = |p: &Point| dot(&minus(p, &points[i]), &normal) / length;
                let heights: Vec<f64> = points.iter().map(height).collect();
                let flat = FLAT.sqrt() * size;
                let (above, below) = (heights.iter().any(|h| *h > flat), heights.iter().any(|h| *h < -flat));
                if above && below {
                    continue;
                }
                let face: Vec<usize> = (0..points.len()).filter(|p| heights[*p].abs() <= flat).collect();
                if seen.contains(&face) {
                    continue;
                }
                let outward = if above { normal.map(|x| -x) } else { normal };
                triangles.extend(fan(points, &face, &outward));
                seen.push(face);
            }
        }
    }
    triangles
}

/// The polygon of points in a plane, as a fan.
fn fan(points: &[Point], face: &[usize], normal: &Point) -> Vec<[usize; 3]> {
    let Some(start) =
        face.iter().copied().min_by(|a, b| points[*a].partial_cmp(&points[*b]).unwrap_or(std::cmp::Ordering::Equal))
    else {
        return Vec::new();
    };
    // Gift wrapping: the next corner has all others on its left.
    let mut corners = vec![start];
    while corners.len() <= face.len() {
        let here = corners[corners.len() - 1];
        let mut next: Option<usize> = None;
        for &p in face.iter().filter(|p| **p != here && distance(&points[**p], &points[here]) > 0.0) {
            let Some(best) = next else {
                next = Some(p);
                continue;
            };
            let (u, v) = (minus(&points[best], &points[here]), minus(&points[p], &points[here]));
            let side = dot(&cross(&u, &v), normal);
            let scale = (dot(&u, &u) * dot(&v, &v) * dot(normal, normal)).sqrt();
            let is_farther = side.abs() <= FLAT * scale && dot(&v, &v) > dot(&u, &u);
            if side < -FLAT * scale || is_farther {
                next = Some(p);
            }
        }
        match next {
            Some(p) if p != start && !corners.contains(&p) => corners.push(p),
            _ => break,
        }
    }
    (1..corners.len().saturating_sub(1)).map(|k| [corners[0], corners[k], corners[k + 1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume that triangles enclose.
    fn volume(points: &[Point], triangles: &[[usize; 3]]) -> f64 {
        triangles.iter().map(|[a, b, c]| dot(&points[*a], &cross(&points[*b], &points[*c]))).sum()
    }

    #[test]
    fn a_cube_has_twelve_triangles_that_face_outward() {
        let corner = |k: u32| [0, 1, 2].map(|bit| f64::from(k >> bit & 1));
        let mut points: Vec<Point> = (0..8).map(corner).collect();
        points.push([0.5, 0.5, 0.5]);
        let triangles = hull(&points);
        assert_eq!(triangles.len(), 12);
        assert!((volume(&points, &triangles) - 6.0).abs() < 1e-12);
        assert!(triangles.iter().flatten().all(|k| *k < 8));
    }

    #[test]
    fn plane_points_make_a_polygon_and_points_in_line_nothing() {
        let hexagon: Vec<Point> = (0..6).map(|k| f64::from(k).sin_cos()).map(|(x, y)| [x, y, 0.0]).collect();
        assert_eq!(hull(&hexagon).len(), 4);
        assert!(hull(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]).is_empty());
        assert!(hull(&[[1.0; 3]; 6]).is_empty());
    }
}
