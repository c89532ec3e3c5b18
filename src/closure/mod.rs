//! From mechanism to closure equations, over any ring.

pub mod half_angle;
pub mod study;
pub mod universal_leg;
pub mod woernle_lee;
