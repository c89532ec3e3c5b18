//! Elimination over any field: from the closure equations to one matrix pencil in the hidden unknown.

pub mod affine_platform;
pub mod border;
pub mod brackets;
pub mod characteristic;
pub mod common_roots;
pub mod coordinate_ring;
pub mod cut;
pub mod degree;
pub mod graded_quotient;
pub mod multiple_pose;
pub mod octic;
pub mod opposite_axes;
pub mod pencil;
pub mod platform_degree;
pub mod platform_height;
pub mod platform_incidence;
pub mod platform_long;
pub mod platform_null;
pub mod platform_polynomial;
pub mod point_reach;
pub mod rearranged;
pub mod separated;
pub mod spherical_four_bar;
pub mod spherical_pair;
pub mod spherical_triangle;
pub mod triangle_platform;
