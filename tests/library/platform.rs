//! Stewart platforms: every pose of the published and the special ones, counted exactly and found in f64.
#![allow(clippy::unwrap_used)]

mod cases;
mod equations;
mod exact;
mod null;
mod poses;
mod self_motions;
mod special;
mod template;
mod triangle;
mod verdicts;
