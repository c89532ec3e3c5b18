//! What a command leaves for the next one in the same process: a page in a browser asks about one mechanism again and again.
//!
//! Elsewhere a process runs one command, and nothing is kept.

use super::arguments::SolveOptions;
use looproot::internal::catalogue::Options;
use looproot::internal::catalogue::entry::{Case, Entry};
use looproot::internal::error::Error;
use looproot::internal::kinematics::task::Demand;
use looproot::internal::mechanism::Mechanism;
use std::cell::RefCell;
use std::path::Path;

thread_local! {
    static KEPT: RefCell<Option<Kept>> = const { RefCell::new(None) };
}

/// What a mechanism is read from: where this is the same, so is the mechanism.
#[derive(PartialEq)]
pub struct Source {
    name: String,
    /// The text of the file, none of an entry of the library.
    text: Option<String>,
    read: Options,
}

/// A mechanism as read, and as it was prepared.
pub struct Kept {
    source: Source,
    /// The entry with the cases of its file.
    pub entry: Entry,
    /// What it was prepared for.
    pub prepared: Prepared,
}

/// A mechanism, and that on which its preparation depends.
pub struct Prepared {
    mechanism: Mechanism,
    demand: Demand,
    given: Vec<Vec<usize>>,
}

impl Source {
    /// Returns what the mechanism of a command is read from; `None` if nothing of it is kept: outside of browsers, of other inputs than one
    /// file, and with a seed, which makes the whole of an answer the same again.
    pub fn of(options: &SolveOptions, read: &Options) -> Option<Self> {
        let is_one_file = options.mechanism != "-" && read.group.is_none();
        if !cfg!(target_family = "wasm") || !is_one_file || options.seed.is_some() {
            return None;
        }
        let path = Path::new(&options.mechanism);
        let text = if path.exists() { Some(std::fs::read_to_string(path).ok()?) } else { None };
        Some(Self { name: options.mechanism.clone(), text, read: read.clone() })
    }

    /// Takes what an earlier command has left of the same source.
    pub fn take(&self) -> Option<Kept> {
        KEPT.take().filter(|kept| kept.source == *self)
    }
}

impl Prepared {
    /// Returns a mechanism together with what it was prepared for.
    pub fn new(mechanism: Mechanism, demand: Demand, entry: &Entry) -> Self {
        Self { mechanism, demand, given: given(entry) }
    }

    /// Returns the mechanism that was prepared for these demands and these given joints, and prepares one if this is another.
    ///
    /// # Errors
    /// As [`Mechanism::prepare_for`].
    pub fn or_prepare(own: Option<Self>, entry: &Entry, demand: &Demand) -> Result<Mechanism, Error> {
        match own.filter(|own| own.demand == *demand && own.given == given(entry)) {
            Some(own) => Ok(own.mechanism),
            None => Mechanism::prepare_for(entry, demand),
        }
    }
}

/// Returns the joints that the cases give: of a loop its preparation depends on these, and not on their values.
fn given(entry: &Entry) -> Vec<Vec<usize>> {
    entry.cases.iter().map(|case| case.input.iter().map(|input| input.joint).collect()).collect()
}

/// Keeps a mechanism for the next command; `cases` are those of its file.
pub fn keep(source: Source, mut entry: Entry, cases: Vec<Case>, prepared: Prepared) {
    entry.cases = cases;
    KEPT.set(Some(Kept { source, entry, prepared }));
}
