//! A side of a body on the sphere as a number that may change: the end moves on the great circle through both points.

use crate::error::{Error, Result};
use crate::kinematics::motion::{cross, dot};
use crate::kinematics::sphere::{Direction, SphereGiven, SphereLinkage};
use looproot_calculus::rotation::matrix::{Matrix, apply, product, transpose};
use looproot_calculus::unit::Root;
use rug::Rational;

/// A side of a body.
pub(crate) struct Side {
    body: usize,
    /// The directions of both points, and the normal of the great circle.
    start: Direction,
    end: Direction,
    normal: Direction,
    /// The product of the lengths of both directions, and their dot product.
    length: Rational,
    cosine: Rational,
    /// The sine of the side, where it is rational.
    sine: Option<Rational>,
}

impl Side {
    /// Returns the side of a body from one of its points to another; `None` where it has no such points.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a side of length 0 or a half turn, for directions whose product of lengths is irrational, and for an end
    /// that is no joint or shares its place with another point.
    pub fn of(linkage: &SphereLinkage, body: usize, [from, to]: [&str; 2]) -> Option<Result<Self>> {
        let own = &linkage.bodies[body];
        let (start, end) = (own.point(from)?, own.point(to)?);
        Some(Self::between(linkage, body, start, end).map_err(|what| {
            Error::Unsupported(format!("the side of {} from {from} to {to} as a symbol: {what}", own.name))
        }))
    }

    fn between(
        linkage: &SphereLinkage,
        body: usize,
        start: &Direction,
        end: &Direction,
    ) -> std::result::Result<Self, &'static str> {
        if linkage.bodies[body].points.iter().filter(|(_, at)| at == end).count() > 1 {
            return Err("another point of the body is at its end");
        }
        let is_here = |side: usize, joint: &crate::kinematics::sphere::SphereJoint| {
            joint.of[side] == body && joint.at[side] == *end
        };
        if !linkage.joints.iter().any(|joint| is_here(0, joint) || is_here(1, joint)) {
            return Err("there is no joint at its end, or its direction was rounded");
        }
        let normal = cross(start, end);
        let square = dot(&normal, &normal);
        if square == 0 {
            return Err("its points are one or opposite");
        }
        let length = Rational::sqrt(&(dot(start, start) * dot(end, end)));
        let length = length.ok_or("the product of the lengths of its directions is irrational")?;
        let sine = Rational::sqrt(&square).map(|size| size / &length);
        Ok(Self { body, start: start.clone(), end: end.clone(), normal, cosine: dot(start, end), length, sine })
    }

    /// Returns whether both are sides of one body, and this one moves a point of the other.
    pub fn moves(&self, other: &Self) -> bool {
        self.body == other.body && (self.end == other.end || self.end == other.start)
    }

    /// Returns the square of the number over which the half-angle tangent of the side is the symbol.
    pub fn over(&self) -> Rational {
        if self.sine.is_some() {
            return Rational::from(1);
        }
        dot(&self.normal, &self.normal) / Rational::from(&self.length * &self.length)
    }

    /// Gives the side the length whose half-angle tangent is this, over the sine that it had where that is irrational. The references of
    /// joints at the end turn along, and what is given of them, too. `None` where a joint is no longer there.
    pub fn put(&self, linkage: &mut SphereLinkage, given: &mut [SphereGiven], value: &Rational) -> Option<()> {
        let turn = self.turn(value);
        let place = apply(&turn, &self.end);
        let points = &mut linkage.bodies[self.body].points;
        points.iter_mut().find(|(_, at)| *at == self.end)?.1.clone_from(&place);
        for (number, joint) in linkage.joints.iter_mut().enumerate() {
            for side in 0..2 {
                if joint.of[side] != self.body || joint.at[side] != self.end {
                    continue;
                }
                joint.at[side].clone_from(&place);
                joint.zero[side] = apply(&turn, &joint.zero[side]);
                for one in given.iter_mut().filter(|one| one.joint == Some(number)) {
                    // It takes the second body to the first.
                    one.rotation = if side == 0 {
                        product(&turn, &one.rotation)
                    } else {
                        product(&one.rotation, &transpose(&turn))
                    };
                }
            }
        }
        Some(())
    }

    /// Returns the rotation about the normal that the end makes. With n the normal and t, u the half-angle tangents of new and old side over
    /// |n| the one of the rotation is `(t - u)/(1 + n^2 t u)`.
    fn turn(&self, value: &Rational) -> Matrix<Rational> {
        let square = dot(&self.normal, &self.normal);
        let before = Rational::from(&self.length + &self.cosine).recip();
        let after = match &self.sine {
            // The tangent itself, and |n| is the sine times the lengths.
            Some(sine) => Rational::from(value / &self.length) / sine,
            None => Rational::from(value / &self.length),
        };
        let half = Rational::from(&after - &before) / (Rational::from(&square * &after) * &before + 1);
        let own = Rational::from(&half * &half) * &square;
        let below = Rational::from(&own + 1);
        let (cosine, sine) = ((1 - own) / &below, half * 2 / below);
        let n = &self.normal;
        let zero = Rational::new;
        let negative = |x: &Rational| Rational::from(-x);
        let across = [
            [zero(), negative(&n[2]), n[1].clone()],
            [n[2].clone(), zero(), negative(&n[0])],
            [negative(&n[1]), n[0].clone(), zero()],
        ];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let along = Rational::from(&n[i] * &n[j]) / &square * Rational::from(1 - &cosine);
                let turned = Rational::from(&across[i][j] * &sine) + along;
                if i == j { turned + &cosine } else { turned }
            })
        })
    }
}
