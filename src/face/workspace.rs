//! The memory of one thread.

use crate::assembly::{self, Assembly};

/// What one thread needs to solve pose after pose. It grows to what the first poses need and is used again.
#[derive(Default)]
pub struct Workspace {
    pub(super) solver: assembly::Workspace,
    pub(super) assembly: Assembly,
}
