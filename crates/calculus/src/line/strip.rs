//! How straight the curve of a point is: the strip between two parallel lines that holds it.

/// The narrowest strip that holds points of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// The direction of its middle line, of length 1.
    pub direction: [f64; 2],
    /// A point of its middle line.
    pub point: [f64; 2],
    /// How far points lie from the middle line at most: no line is nearer to all of them.
    pub deviation: f64,
    /// The length that the points cover along the line.
    pub length: f64,
}

/// Returns the narrowest strip; `None` for fewer than two points.
///
/// One of its sides holds a side of the convex hull. \[HouleToussaint1988\]
#[must_use]
pub fn strip(points: &[[f64; 2]]) -> Option<Strip> {
    let hull = hull(points);
    let along = |k: usize| {
        let ([ax, ay], [bx, by]) = (hull[k], hull[(k + 1) % hull.len()]);
        let length = (bx - ax).hypot(by - ay);
        let [dx, dy] = [(bx - ax) / length, (by - ay) / length];
        // The hull lies to the left of its sides.
        let height = hull.iter().map(|[x, y]| dx * (y - ay) - dy * (x - ax)).fold(0.0, f64::max);
        let ways = hull.iter().map(|[x, y]| dx * (x - ax) + dy * (y - ay));
        let (low, high) =
            ways.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), way| (low.min(way), high.max(way)));
        let half = 0.5 * height;
        Strip { direction: [dx, dy], point: [ax - half * dy, ay + half * dx], deviation: half, length: high - low }
    };
    if hull.len() < 2 {
        return None;
    }
    (0..hull.len()).map(along).min_by(|a, b| a.deviation.total_cmp(&b.deviation))
}

/// The convex hull against the clock, by the monotone chain: points sorted by x, then y, once there and once back.
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted: Vec<[f64; 2]> =
        points.iter().copied().filter(|point| point.iter().all(|x| x.is_finite())).collect();
    looproot_algebra::sort::by(&mut sorted, |a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for c in points {
            while let [.., a, b] = chain.as_slice() {
                if (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(c);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut sorted.iter().copied());
    all.extend(half(&mut sorted.iter().rev().copied()));
    all
}

#[cfg(test)]
mod tests {
    use super::strip;

    #[test]
    fn the_strip_of_a_flat_triangle_lies_along_its_longest_side() {
        let points = [[0.0, 0.0], [3.0, 4.0], [1.5 - 0.08, 2.0 + 0.06], [1.5, 2.0]];
        let found = strip(&points).unwrap();
        assert!((found.deviation - 0.05).abs() < 1e-12 && (found.length - 5.0).abs() < 1e-12, "{found:?}");
        assert!((found.direction[0] * 0.8 - found.direction[1] * 0.6).abs() < 1e-12);
        assert!(strip(&points[..1]).is_none());
        assert!(strip(&[[0.0, 1.0], [0.0, 3.0]]).unwrap().deviation < 1e-15);
    }
}
