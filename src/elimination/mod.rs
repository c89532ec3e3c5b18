//! Closure equations to one matrix pencil in the hidden unknown, over any field.

pub mod border;
pub mod cut;
pub mod degree;
pub mod pencil;
pub mod platform_degree;
