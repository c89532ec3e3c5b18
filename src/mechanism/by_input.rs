//! Preparations made once for every choice of the locked variable, and looked up case by case.

use super::single_loop::locked_variable;
use crate::catalogue::entry::{Case, Entry, Kind};
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Layout;
use std::time::Instant;

/// The preparation for all cases that lock the same variable.
pub(super) struct Prepared<T> {
    locked: Option<usize>,
    /// Microseconds that the preparation took.
    pub prepare_us: f64,
    /// The prepared value.
    pub of: T,
}

/// One preparation for each variable that some case locks.
pub(super) struct ByInput<T>(Vec<Prepared<T>>);

impl<T> ByInput<T> {
    /// Prepares a chain for all cases of an entry.
    pub fn prepare(entry: &Entry, chain: &Chain, one: impl Fn(Layout) -> Result<T>) -> Result<Self> {
        let mut all: Vec<Prepared<T>> = Vec::new();
        // An arm may be prepared before its poses are known: they lock nothing.
        let of_cases = entry.cases.iter().map(|case| locked_variable(chain, case));
        let of_arm = (entry.kind() == Kind::Arm).then_some(Ok(None));
        for locked in of_cases.chain(of_arm) {
            let locked = locked?;
            if all.iter().all(|known| known.locked != locked) {
                let layout = Layout::of(chain, locked)?;
                let start = Instant::now();
                let of = one(layout)?;
                all.push(Prepared { locked, prepare_us: start.elapsed().as_secs_f64() * 1e6, of });
            }
        }
        Ok(Self(all))
    }

    /// Prepares one layout, for cases that lock its variable.
    pub fn only(layout: Layout, one: impl FnOnce(Layout) -> Result<T>) -> Result<Self> {
        let (locked, start) = (layout.locked, Instant::now());
        let of = one(layout)?;
        Ok(Self(vec![Prepared { locked, prepare_us: start.elapsed().as_secs_f64() * 1e6, of }]))
    }

    /// Returns the preparation for the locked joint of one case.
    pub fn of(&self, chain: &Chain, case: &Case) -> Result<&Prepared<T>> {
        let locked = locked_variable(chain, case)?;
        let found = self.0.iter().find(|known| known.locked == locked);
        found.ok_or_else(|| Error::Invalid("the case locks a joint that was not prepared".to_owned()))
    }
}
