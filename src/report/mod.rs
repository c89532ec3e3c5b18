//! What a reader sees: the verdict in one line, tables, normalised models, JSON.

pub mod atlas;
pub mod conditions;
pub mod conditions_search;
pub mod derivation;
pub mod derivatives;
pub mod document;
pub mod framework;
pub mod json;
pub mod mobility;
pub mod model;
pub mod motion;
pub mod number;
pub mod paper;
pub mod picture;
pub mod sweep;
pub mod symbolic;
pub mod table;
pub mod text;
pub mod transference;
