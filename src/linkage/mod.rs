//! All assemblies of a planar linkage, real and complex, with the proof that none is missing.
//!
//! Inputs glue bodies; what is left falls apart into groups, least sets of bodies that are rigid by count ([`groups`]).
//! Each is solved in every branch of those before: a group of one cycle by a quadratic equation ([`quadratic`]), others by
//! Cramer's pencil ([`pencil`]), whose determinant is an exact polynomial ([`polynomial`]) with as many roots as there are
//! certified solutions ([`krawczyk`]), or the list is not called complete.

pub mod answer;
pub mod assembly;
pub mod dynamics;
pub mod equations;
pub mod general;
pub mod grashof;
pub mod groups;
pub mod instant;
pub mod isotropic;
pub mod krawczyk;
pub mod parts;
pub mod pencil;
pub mod polynomial;
pub mod quadratic;
pub mod rates;
pub mod real_form;
pub mod sphere;
pub mod state;
pub mod tower;
pub mod tree;
