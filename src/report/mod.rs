//! What a reader sees: the verdict in one line, tables, normalised models, JSON.

pub mod curves;
pub mod derivation;
pub mod derivatives;
pub mod json;
pub mod model;
pub mod number;
pub mod sweep;
pub mod table;
pub mod text;
