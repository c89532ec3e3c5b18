//! Reads a tile of the plane: its corners and the sides at which its copies meet.

use super::calculus::none;
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::Quantity;
use crate::error::Result;
use crate::kinematics::linkage::Gaussian;

/// Maximum number of corners.
const MOST: usize = 60;

/// A polygon whose sides are paired: a copy of it at one side of a pair has its other side there.
#[derive(Clone, Debug)]
pub struct Tile {
    /// The corners, counter-clockwise. Side k goes from corner k to the next one, both from 0.
    pub corners: Vec<Gaussian>,
    /// The two sides of every pair, the same one twice for a half turn about its midpoint.
    pub pairs: Vec<[usize; 2]>,
    /// The pairs whose copies are mirrored.
    pub glides: Vec<[usize; 2]>,
}

/// The keys of `[mechanism]`.
pub(super) const KEYS: [&str; 3] = ["corners", "pairs", "glides"];

/// Reads a tile, every side of which belongs to one pair.
pub(super) fn tile(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>) -> Result<Tile> {
    none(scope, table, "tile")?;
    let node = scope.need(mechanism, "corners")?;
    let one = |node: &Node| -> Result<Gaussian> {
        let [x, y] = scope.exactly::<2>(node, "corners")?;
        let [x, y] = [scope.number(x, Quantity::Length, "corners")?, scope.number(y, Quantity::Length, "corners")?];
        Ok(Gaussian { re: x.rational().clone(), im: y.rational().clone() })
    };
    let corners = scope.list(node, "corners")?.iter().map(one).collect::<Result<Vec<_>>>()?;
    if !(3..=MOST).contains(&corners.len()) {
        return Err(scope.fail(node.line, format!("found {} corners, expected 3 to {MOST}", corners.len())));
    }
    let mut used = vec![false; corners.len()];
    let mut read = |key: &str, may_be_same: bool| -> Result<Vec<[usize; 2]>> {
        let Some(node) = mechanism.get(key) else { return Ok(Vec::new()) };
        let mut list = Vec::new();
        for item in scope.list(node, key)? {
            let mut pair = [0; 2];
            for (side, node) in pair.iter_mut().zip(scope.exactly::<2>(item, key)?) {
                let found = scope.count(node, key)?;
                if !(1..=corners.len()).contains(&found) {
                    return Err(
                        scope.fail(node.line, format!("found the side {found}, expected 1 to {}", corners.len()))
                    );
                }
                *side = found - 1;
            }
            let [a, b] = pair;
            if used[a] || used[b] || (a == b && !may_be_same) {
                let message =
                    format!("found the sides {} and {} in `{key}`, expected every side in one pair", a + 1, b + 1);
                return Err(scope.fail(item.line, message));
            }
            (used[a], used[b]) = (true, true);
            list.push(pair);
        }
        Ok(list)
    };
    let (pairs, glides) = (read("pairs", true)?, read("glides", false)?);
    if let Some(side) = used.iter().position(|used| !used) {
        return Err(
            scope.fail(node.line, format!("found no pair with the side {}, expected every side in one", side + 1))
        );
    }
    Ok(Tile { corners, pairs, glides })
}
