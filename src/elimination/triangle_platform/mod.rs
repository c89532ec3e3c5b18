//! Platforms whose legs meet in pairs: a triangle hung on six legs, solved by two resultants.
//!
//! Two legs of given lengths from points `a`, `a'` of one body to one point P of the other leave P a circle about the line
//! `a a'`: `P = c + alpha u + beta v` with u and v across the line and each other, and `alpha^2 u.u + beta^2 v.v = r^2`.
//! Three such points on circles, at the distances of the sides of the triangle, are a pose. \[Wittenburg2016\], section 8.2.

mod circle;
mod eliminant;
mod polynomial;

pub use circle::{Circle, Pairs, Triangle, pairs};
pub use eliminant::Eliminant;
pub use polynomial::{TrianglePolynomial, triangle_polynomial};
