//! All real assemblies of a group of revolute joints, by boxes of angles.
//!
//! With cosine and sine of every rotation the cycles are linear equations. A combination of them with any factors is a sum of
//! waves `u cos + v sin`, one for every angle: where the bounds of these on the arcs of a box exclude the sum 0, the box holds no
//! assembly, and an angle whose wave cannot be minus the sum of the others is none of one ([`forms`]). Good factors come from
//! Newton's method and from linear programs ([`tableau`]), which are computed in f64 and prove nothing themselves. A box in which
//! the derivative is regular throughout holds one assembly at most; where Newton's method leads from it to an assembly that is
//! proved to exist ([`crate::linkage::krawczyk`]), that is the one. All other boxes are divided ([`search`]).
//!
//! If every box has one of these ends, the list is complete: `docs/exact.md` has this as a theorem.

pub mod arc;
pub mod forms;
pub mod search;
pub mod tableau;

use super::equations::Equations;
use super::general::differ;
use super::krawczyk::Proved;
use super::state::Number;
use rayon::prelude::*;
use search::{Fate, Search};
use std::sync::atomic::{AtomicBool, Ordering};

/// How far a search goes.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Most boxes of one group.
    pub boxes: usize,
    /// Most open boxes: a double assembly or a curve of assemblies leaves more, and further ones decide nothing.
    pub open: usize,
}

/// For lists that are of use even if they are not complete: forty times the boxes that 21 links need, two minutes.
pub const LONG: Effort = Effort { boxes: 1 << 17, open: 1 << 9 };
/// For lists that are of no use unless they are complete: twice the boxes that 13 links need.
pub const SHORT: Effort = Effort { boxes: 1 << 9, open: 0 };
/// Boxes that are decided at a time: a multiple of the processors of any machine of today, so that the order does not depend on it.
const TOGETHER: usize = 64;

/// The real assemblies that boxes lead to.
#[derive(Clone, Debug)]
pub struct RealAssemblies {
    /// Those that are proved, each once.
    pub solutions: Vec<Proved>,
    /// Number of boxes that were decided on.
    pub boxes: usize,
    /// Why there may be others; `None` where these are all.
    pub doubt: Option<String>,
}

/// All real assemblies of a group, until the flag is raised or as far as the effort goes; `None` for groups with slides.
#[must_use]
pub fn real_assemblies(equations: &Equations<Number>, effort: Effort, stop: &AtomicBool) -> Option<RealAssemblies> {
    let search = Search::new(equations)?;
    let mut found = RealAssemblies { solutions: Vec::new(), boxes: 0, doubt: None };
    let mut open = 0;
    // The last ones first: the list stays short.
    let mut waiting = vec![search.whole()];
    while !waiting.is_empty() {
        if stop.load(Ordering::Relaxed) {
            found.doubt = Some(format!("interrupted with {} boxes left", waiting.len()));
            break;
        }
        if found.boxes >= effort.boxes || open > effort.open {
            break;
        }
        let together = waiting.split_off(waiting.len().saturating_sub(TOGETHER));
        found.boxes += together.len();
        let fates: Vec<Fate> = together.into_par_iter().map(|arcs| search.decide(arcs)).collect();
        for fate in fates {
            match fate {
                Fate::Nothing => {}
                Fate::Divided(parts) => waiting.extend(parts),
                Fate::Open => open += 1,
                Fate::One(proved) => {
                    if found.solutions.iter().all(|known| differ(known, &proved, search.rest())) {
                        found.solutions.push(*proved);
                    }
                }
            }
        }
    }
    if found.doubt.is_none() && open + waiting.len() > 0 {
        found.doubt = Some(format!(
            "of {} boxes of angles, {open} are too narrow to be decided, and {} were left when the work was ended",
            found.boxes,
            waiting.len()
        ));
    }
    Some(found)
}
