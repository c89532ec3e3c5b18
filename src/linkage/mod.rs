//! All assemblies of a planar linkage, real and complex, with the proof that none is missing.
//!
//! Inputs merge bodies; the remaining bodies split into groups, least sets of bodies that are rigid by count ([`groups`]). Each
//! group is solved in every branch of the earlier ones: a group of one cycle by a quadratic equation ([`quadratic`]), others by
//! Cramer's pencil ([`pencil`]), whose determinant is an exact polynomial ([`polynomial`]), and groups with gears by a Gröbner
//! basis ([`gears`]). The list is called complete only if
//! that polynomial has as many roots as there are certified solutions ([`krawczyk`]), or if a Gröbner basis over the rationals says
//! which assemblies there are (`exact_group`): those of groups with multiple assemblies and of groups that move.

pub mod answer;
pub mod assembly;
mod bars;
mod bounded_half;
pub mod boxes;
pub mod cognates;
pub mod count;
pub mod defects;
pub mod dyads;
pub mod dynamics;
pub mod equations;
mod exact_group;
mod fibres;
mod followed;
pub mod geared_groups;
pub mod gears;
pub mod general;
pub mod grashof;
mod group_velocities;
pub mod groups;
pub mod instant;
pub mod isotropic;
pub mod krawczyk;
pub mod laurent;
pub mod limits;
pub mod loads;
pub mod many;
mod members;
mod near;
pub mod parts;
pub mod pencil;
mod points;
pub mod polynomial;
pub mod quadratic;
pub mod rates;
pub mod real_form;
mod real_motion;
mod real_system;
pub mod space;
pub mod sphere;
pub mod state;
pub mod straight;
pub mod tower;
pub mod tree;
mod turn_system;
