//! The tests that run the program.

mod arrays;
mod book;
mod cli;
mod conditions;
mod conditions_search;
mod derive;
mod foreign;
mod framework;
mod gearing;
mod instant;
mod linkage_mobility;
mod mobility;
mod mobility_verb;
mod motion;
mod navigation;
mod poly;
mod real_list;
mod robots;
mod scene;
mod sweep;
mod tile;
mod view;

/// The folder of the project: the program is a crate below it.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
