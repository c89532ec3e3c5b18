//! The memory of one thread.

use crate::assembly::{self, Assembly};

/// Memory in which one thread solves pose after pose. It grows to the size that the first poses need and is reused.
#[derive(Default)]
pub struct Workspace {
    pub(super) solver: assembly::Workspace,
    pub(super) assembly: Assembly,
}
