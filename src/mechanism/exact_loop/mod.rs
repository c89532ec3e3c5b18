//! Loops of few unknowns, decided exactly over the rationals: overconstrained loops, and loops with spherical joints.
//!
//! Their closure equations are polynomials in cosines, sines and distances. A Gröbner basis over the rationals gives the
//! dimension of the set of solutions; where they are finitely many, the quotient ring gives their number and shows which of
//! them coincide, and every unknown is a rational function of the roots of one polynomial. Five unknowns are found by a cut of
//! the loop. f64 only presents.

mod answer;
mod by_cut;
mod configuration;
mod cycle;
mod equations;
mod measure;
mod outcome;
pub(crate) mod roots;
mod ss_dyad;

pub(crate) use cycle::Cycle;
pub(crate) use equations::System;

pub(super) use answer::{Answer, Question, Standing};
pub(super) use ss_dyad::SsDyadQuestion;
