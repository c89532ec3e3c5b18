//! Frameworks: every vertex is a body, so that one list of positions poses them all.

use super::lines::distance;
use super::{Body, Connection, ConnectionKind, Point, Scene};

/// Vertices and the bars between them.
pub(super) fn scene(names: &[String], vertices: &[Point], bars: &[[usize; 2]]) -> Scene {
    let count = vertices.len().max(1) as f64;
    let centre: Point = std::array::from_fn(|k| vertices.iter().map(|v| v[k]).sum::<f64>() / count);
    let size = vertices.iter().map(|v| distance(v, &centre)).fold(0.0, f64::max);
    let bar = |ends: &[usize; 2]| Connection {
        kind: ConnectionKind::Bar,
        from: (ends[0], [0.0; 3]),
        to: (ends[1], [0.0; 3]),
    };
    Scene {
        bodies: names.iter().map(|name| Body { name: name.clone(), parts: Vec::new() }).collect(),
        connections: bars.iter().filter(|[a, b]| a.max(b) < &names.len()).map(bar).collect(),
        centre,
        size: if size > 0.0 { size } else { 1.0 },
        ..Scene::default()
    }
}
