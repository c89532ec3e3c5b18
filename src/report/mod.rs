//! What a reader sees: the verdict in one line, tables, normalised models, JSON.

pub mod atlas;
pub mod calculus;
pub mod certificate;
pub mod conditions;
pub mod conditions_search;
pub mod convert;
pub mod derivation;
pub mod derivatives;
pub mod document;
pub mod framework;
pub mod json;
pub mod linkage;
pub mod mobility;
pub mod model;
pub mod motion;
pub mod number;
pub mod paper;
pub mod picture;
pub mod rotation;
pub mod scene;
pub mod sweep;
pub mod symbolic;
pub mod synthesis;
pub mod table;
pub mod text;
pub mod transference;
