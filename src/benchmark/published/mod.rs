//! A benchmark for published comparisons: problems with their exact truth as a file, answers of any solver as a file, and
//! their score. Both formats are in docs/benchmark.md.

mod answers;
mod export;
mod problem;
mod score;

pub use answers::{ANSWERS, Answer, Answers};
pub use export::{Drawn, of_arm, of_platform, of_robot, of_singular_robot};
pub use problem::{Axis, Body, PROBLEMS, Problem, Problems, Truth, VERSION, hash, header};
pub use score::{BACKWARD, Errors, MULTIPLE, Score, Tally, score};
