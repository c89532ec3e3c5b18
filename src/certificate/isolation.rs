//! Checks modes: each ball holds exactly one solution, balls hold different solutions, real ones are real.

use super::chain::ChainClosure;
use super::doubled::Doubled;
use super::enclosing::{Centre, Enclosing, near_inverse};
use super::fault::{Fault, refused};
use super::mode::Ball;
use super::nearby::Nearby;
use super::platform::PlatformClosure;
use crate::algebra::ball::Ball as Long;
use rug::{Float, Rational, float::Round};
use std::cell::OnceCell;

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
    /// The numbers of the equations, enclosed.
    type Constants<S: Enclosing>;
    /// Returns the numbers of the equations.
    fn constants<S: Enclosing>(&self) -> Self::Constants<S>;
    /// Returns which unknowns are angles.
    fn angles(&self) -> [bool; N];
    /// Returns the values of the equations.
    fn values<S: Enclosing>(&self, constants: &Self::Constants<S>, point: &Point<S>) -> [S; N];
    /// Returns the derivatives, row by row, and whether every zero in the box is a solution.
    fn slope<S: Enclosing>(&self, constants: &Self::Constants<S>, point: &Point<S>) -> ([[S; N]; N], bool);
    /// Returns whether two balls with these radii hold no common solution.
    fn are_apart(&self, one: &Ball, other: &Ball) -> bool;
}

/// The numbers of closure equations in the three kinds of numbers; the longer ones are converted at their first use.
pub(super) struct Ready<'a, const N: usize, C: Closure<N>> {
    closure: &'a C,
    short: C::Constants<Nearby>,
    middle: OnceCell<C::Constants<Doubled>>,
    long: OnceCell<C::Constants<Longer>>,
}

/// The numbers by which a ball is proved.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Digits {
    /// Derivatives are bounded in f64; the values of the equations take twice as many digits where that is needed.
    Short,
    /// Derivatives take twice the digits of f64; the values of the equations take 384 bits where that is needed.
    Middle,
    /// All numbers have 384 bits.
    Long,
}

impl Digits {
    /// Lists all kinds, those first that take the least time.
    pub const ALL: [Self; 3] = [Self::Short, Self::Middle, Self::Long];
}

/// A point that balls of several radii are about.
pub(super) struct Middle {
    short: Centre,
    long: OnceCell<Centre>,
}

impl Middle {
    /// Prepares the centre of a ball.
    pub fn of(ball: &Ball, angles: &[bool]) -> Self {
        Self { short: Centre::of(&ball.centre, angles, Doubled::BITS), long: OnceCell::new() }
    }
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
    proved_among(closure, balls, &|_| false)
}

/// As [`proved_modes`], where some of the balls are known to hold a solution.
pub(super) fn proved_among<const N: usize>(
    closure: &impl Closure<N>,
    balls: &[Ball],
    is_known: &dyn Fn(usize) -> bool,
) -> Result<(), Fault> {
    let (ready, angles) = (Ready::of(closure), closure.angles());
    for (index, ball) in balls.iter().enumerate() {
        let at = index + 1;
        if ball.centre.len() != N {
            return super::fault::unreadable(format!("mode {at}: found {} unknowns, expected {N}", ball.centre.len()));
        }
        if ball.radius <= 0 || ball.radius > Rational::from((1, 1000)) {
            return refused(format!("mode {at}: the radius is not above 0 and at most 1/1000"));
        }
        let middle = Middle::of(ball, &angles);
        let by = |digits| ready.holds_one(ball, &middle, digits);
        let is_proved = is_known(index) || Digits::ALL.into_iter().any(by);
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

impl<'a, const N: usize, C: Closure<N>> Ready<'a, N, C> {
    /// Prepares the numbers of closure equations.
    pub fn of(closure: &'a C) -> Self {
        Self { closure, short: closure.constants(), middle: OnceCell::new(), long: OnceCell::new() }
    }

    /// Returns whether a ball is proved to hold exactly one solution by numbers of this length.
    pub fn holds_one(&self, ball: &Ball, centre: &Middle, digits: Digits) -> bool {
        let closure = self.closure;
        let radius = |round| Float::with_val_round(53, &ball.radius, round).0.to_f64();
        let radii = [radius(Round::Down), radius(Round::Up)];
        let angles = closure.angles();
        let doubled = || self.middle.get_or_init(|| closure.constants());
        let longer = || self.long.get_or_init(|| closure.constants());
        let far = || centre.long.get_or_init(|| Centre::of(&ball.centre, &angles, Longer::BITS));
        match digits {
            Digits::Short => Contraction::of(closure, &self.short, &centre.short.within(radii[1])).is_some_and(|map| {
                map.keeps(&closure.values(&self.short, &centre.short.within(0.0)), Clone::clone, radii)
                    || map.keeps(&closure.values(doubled(), &centre.short.within(0.0)), Nearby::centre, radii)
            }),
            Digits::Middle => Contraction::of(closure, doubled(), &centre.short.within(radii[1])).is_some_and(|map| {
                map.keeps(&closure.values(doubled(), &centre.short.within(0.0)), Clone::clone, radii)
                    || map.keeps(&closure.values(longer(), &far().within(0.0)), Doubled::centre, radii)
            }),
            Digits::Long => Contraction::of(closure, longer(), &far().within(radii[1]))
                .is_some_and(|map| map.keeps(&closure.values(longer(), &far().within(0.0)), Clone::clone, radii)),
        }
    }
}

/// The map `x - C F(x)` on a ball, for an approximate inverse C of the derivative.
struct Contraction<S, const N: usize> {
    inverse: [[S; N]; N],
    /// Upper bounds of the sums of the rows of `|1 - C F'(ball)|`, below 1.
    bends: [f64; N],
}

/// Returns a sum rounded up: the upper neighbours of sums of upper bounds are upper bounds.
fn added(sum: f64, term: f64) -> f64 {
    (sum + term).next_up()
}

impl<S: Enclosing, const N: usize> Contraction<S, N> {
    /// Returns the map; `None` where it does not contract, and where a zero in the ball may be no solution.
    fn of<C: Closure<N>>(closure: &C, constants: &C::Constants<S>, around: &Point<S>) -> Option<Self> {
        let (slope, is_solution) = closure.slope(constants, around);
        let inverse = if is_solution { near_inverse(&slope)? } else { return None };
        let mut bends = [0.0; N];
        for ((index, row), bend) in inverse.iter().enumerate().zip(&mut bends) {
            for j in 0..N {
                let product = row.iter().zip(&slope).fold(S::zero(), |sum, (c, line)| sum.add(&c.mul(&line[j])));
                let rest = if j == index { S::one().sub(&product) } else { product };
                *bend = added(*bend, rest.at_most());
            }
            if !(*bend < 1.0) {
                return None;
            }
        }
        Some(Self { inverse, bends })
    }

    /// Returns whether the map takes the ball into itself, so that it holds exactly one solution, where the equations have these
    /// values at the centre: `|C F(centre)| + |1 - C F'(ball)| r < r` in the largest norm. \[Krawczyk1969\]
    fn keeps<V: Enclosing>(&self, values: &[V; N], lifted: impl Fn(&S) -> V, [low, high]: [f64; 2]) -> bool {
        self.inverse.iter().zip(self.bends).all(|(row, bend)| {
            let step = row.iter().zip(values).fold(V::zero(), |sum, (c, f)| sum.add(&lifted(c).mul(f))).at_most();
            added(step, (bend * high).next_up()) < low
        })
    }
}
