//! Checks modes: each ball holds exactly one solution, balls hold different solutions, real ones are real.

use super::chain::ChainClosure;
use super::doubled::Doubled;
use super::enclosing::{Enclosing, near_inverse};
use super::fault::{Fault, refused};
use super::mode::Ball;
use super::nearby::Nearby;
use super::platform::PlatformClosure;
use crate::algebra::ball::Ball as Long;
use rug::{Float, Rational, float::Round};

/// Numbers for the last attempt.
pub(super) type Longer = Long<384>;

/// Unknowns as balls.
pub(super) struct Point<S> {
    /// The unknowns.
    pub x: Vec<S>,
    /// Cosines and sines of those that are angles.
    pub turns: Vec<Option<(S, S)>>,
}

/// Closure equations: `N` of them in `N` unknowns.
pub(super) trait Closure<const N: usize> {
    /// Returns which unknowns are angles.
    fn angles(&self) -> [bool; N];
    /// Returns the values of the equations.
    fn values<S: Enclosing>(&self, point: &Point<S>) -> [S; N];
    /// Returns the derivatives, row by row.
    fn jacobian<S: Enclosing>(&self, point: &Point<S>) -> [[S; N]; N];
    /// Returns whether every zero in a box is a solution.
    fn is_solution<S: Enclosing>(&self, point: &Point<S>) -> bool;
    /// Returns whether two balls with these radii hold no common solution.
    fn are_apart(&self, one: &Ball, other: &Ball) -> bool;
}

/// Proves that balls hold one solution each, and that these are different.
///
/// # Errors
/// [`Fault::Refused`] names the first ball that is not proved.
pub fn proved_modes(closure: &Closed, balls: &[Ball]) -> Result<(), Fault> {
    match closure {
        Closed::Chain(closure) => all(&**closure, balls),
        Closed::Platform(closure) => all(&**closure, balls),
    }
}

/// The closure equations of a case.
pub enum Closed {
    /// The equations of an arm or a loop.
    Chain(Box<ChainClosure>),
    /// The equations of a platform.
    Platform(Box<PlatformClosure>),
}

/// As [`proved_modes`].
pub(super) fn all<const N: usize>(closure: &impl Closure<N>, balls: &[Ball]) -> Result<(), Fault> {
    for (index, ball) in balls.iter().enumerate() {
        let at = index + 1;
        if ball.centre.len() != N {
            return super::fault::unreadable(format!("mode {at}: found {} unknowns, expected {N}", ball.centre.len()));
        }
        if ball.radius <= 0 || ball.radius > Rational::from((1, 1000)) {
            return refused(format!("mode {at}: the radius is not above 0 and at most 1/1000"));
        }
        let is_proved = holds_one::<N, Nearby>(closure, ball)
            || holds_one::<N, Doubled>(closure, ball)
            || holds_one::<N, Longer>(closure, ball);
        if !is_proved {
            return refused(format!("mode {at}: no solution is proved within the radius"));
        }
        let has_imaginary = ball.centre.iter().any(|(_, im)| *im != 0);
        let is_off_the_real = ball.centre.iter().any(|(_, im)| im.clone().abs() > ball.radius);
        if ball.real && has_imaginary {
            return refused(format!("mode {at}: said to be real, but its centre is not"));
        }
        if !ball.real && !is_off_the_real {
            return refused(format!("mode {at}: said not to be real, but its ball holds real points"));
        }
    }
    for j in 0..balls.len() {
        if let Some(i) = (0..j).find(|&i| !closure.are_apart(&balls[j], &balls[i])) {
            return refused(format!("modes {} and {}: they may be the same solution", i + 1, j + 1));
        }
    }
    Ok(())
}

/// Returns whether a ball is proved to hold exactly one solution.
///
/// For an approximate inverse C of the derivative the map `x - C F(x)` takes the ball into itself, and contracts it, where
/// `|C F(centre)| + |1 - C F'(ball)| r < r` in the largest norm. \[Krawczyk1969\]
pub(super) fn holds_one<const N: usize, S: Enclosing>(closure: &impl Closure<N>, ball: &Ball) -> bool {
    let radius = |round| Float::with_val_round(53, &ball.radius, round).0.to_f64();
    let (low, high) = (radius(Round::Down), radius(Round::Up));
    let angles = closure.angles();
    let point = |radius: f64| Point {
        x: ball.centre.iter().map(|x| S::about(x, radius)).collect(),
        turns: (0..N).map(|k| angles[k].then(|| S::cos_sin_about(&ball.centre[k], radius))).collect(),
    };
    let (here, around) = (point(0.0), point(high));
    let values = closure.values(&here);
    let slope = closure.jacobian(&around);
    let Some(inverse) = near_inverse(&slope) else { return false };
    // The upper neighbours of sums of upper bounds are upper bounds.
    let add = |sum: f64, term: f64| (sum + term).next_up();
    for (index, row) in inverse.iter().enumerate() {
        let step = row.iter().zip(&values).fold(S::zero(), |sum, (c, f)| sum.add(&c.mul(f))).at_most();
        let mut bend = 0.0;
        for j in 0..N {
            let product = row.iter().zip(&slope).fold(S::zero(), |sum, (c, line)| sum.add(&c.mul(&line[j])));
            let rest = if j == index { S::one().sub(&product) } else { product };
            bend = add(bend, rest.at_most());
        }
        if !(bend < 1.0 && add(step, (bend * high).next_up()) < low) {
            return false;
        }
    }
    closure.is_solution(&around)
}
