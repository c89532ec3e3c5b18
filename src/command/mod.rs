//! One file per verb, and what they share.

pub mod arguments;
pub mod bench;
pub mod bless;
pub mod check;
pub mod completions;
pub mod conditions;
pub mod conditions_search;
pub mod derive;
pub mod exit;
pub mod factor;
pub mod list;
pub mod mobility;
pub mod output;
pub mod poly;
pub mod seed;
pub mod show;
pub mod solve;
pub mod sweep;
pub mod transference;
pub mod wanted;
