//! Stewart platforms: every pose of the published and the special ones, counted exactly and found in f64.
#![allow(clippy::unwrap_used)]

#[path = "platform/cases.rs"]
mod cases;
#[path = "platform/equations.rs"]
mod equations;
#[path = "platform/exact.rs"]
mod exact;
#[path = "platform/poses.rs"]
mod poses;
#[path = "platform/special.rs"]
mod special;
#[path = "platform/template.rs"]
mod template;
#[path = "platform/triangle.rs"]
mod triangle;
#[path = "platform/verdicts.rs"]
mod verdicts;
