//! Balls for a certificate, from solutions that are known to a few digits.

use super::chain::ChainClosure;
use super::enclosing::{Centre, Enclosing, near_inverse};
use super::isolation::{Closed, Closure, Digits, Longer, Middle, Ready, all as proved};
use super::linkage::{LinkageClosure, UNKNOWNS};
use super::mode::Ball;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use num_complex::Complex;
use rug::{Float, Integer, Rational, float::Constant, ops::Pow};

/// Number of Newton steps: from eight digits six of them give more than enough.
const STEPS: usize = 8;
/// The step after one that is as small changes no decimal of a centre: it is about the square of this.
const ENOUGH: f64 = 1e-25;
/// Number of decimals of a centre.
const DECIMALS: u32 = 30;
/// Radii that are tried, as exponents of ten: the largest one is the easiest to check in f64.
const RADII: [u32; 8] = [8, 9, 10, 12, 14, 16, 20, 25];
/// Radii of linkages: their vectors have to be independent in whole balls, however long those of theorem 13 are.
const SMALL_RADII: [u32; 2] = [20, 25];
/// Factor by which the ball of the proof may be enlarged: another checker may bound the second derivatives less tightly. `verify.py` multiplies
/// out what is factored here, which costs a factor between 10 and 100 where a complex quaternion has parts of a hundred.
const ROOM: u32 = 1000;

/// Solutions nearer than this are the same but for rounding.
const ROUNDED: f64 = 1e-6;

/// The unknowns of a solution, and whether it is real.
pub type Near = (Vec<Complex<f64>>, bool);

/// Returns balls that hold one solution each, all different; `None` if that is not proved. A solution consists of the
/// unknowns, real or not.
#[must_use]
pub fn balls(closed: &Closed, near: &[Near]) -> Option<Vec<Ball>> {
    match closed {
        Closed::Chain(closure) => all(&**closure, near, &RADII),
        Closed::Platform(closure) => all(&**closure, near, &RADII),
    }
}

/// As [`balls`], of a linkage.
#[must_use]
pub fn balls_of_linkage(closure: &LinkageClosure, near: &[Near]) -> Option<Vec<Ball>> {
    let padded: Vec<Near> = near
        .iter()
        .map(|(x, real)| {
            let mut x = x.clone();
            x.resize(UNKNOWNS, Complex::default());
            (x, *real)
        })
        .collect();
    let mut balls = all(closure, &padded, &SMALL_RADII)?;
    for ball in &mut balls {
        ball.centre.truncate(closure.size());
    }
    Some(balls)
}

fn all<const N: usize>(closure: &impl Closure<N>, near: &[Near], radii: &[u32]) -> Option<Vec<Ball>> {
    let (ready, angles) = (Ready::of(closure), closure.angles());
    let balls: Vec<(Ball, Middle)> = near
        .iter()
        .map(|(x, real)| {
            let ball = Ball { centre: refined(closure, x, *real)?, radius: Rational::new(), real: *real };
            let middle = Middle::of(&ball, &angles);
            Some((ball, middle))
        })
        .collect::<Option<_>>()?;
    (0..radii.len()).find_map(|start| {
        let one = |(about, middle): &(Ball, Middle)| {
            let ball = |exponent: &u32| {
                let radius = Rational::from((Integer::from(1), Integer::from(10).pow(*exponent)));
                Ball { radius, ..about.clone() }
            };
            let has_room =
                |ball: &Ball, digits| [ball, &wider(ball)].iter().all(|ball| ready.holds_one(ball, middle, digits));
            let by = |digits| radii[start..].iter().map(ball).find(|ball| has_room(ball, digits));
            Digits::ALL.into_iter().find_map(by)
        };
        let balls: Vec<Ball> = balls.iter().map(one).collect::<Option<_>>()?;
        proved(closure, &balls).is_ok().then_some(balls)
    })
}

fn wider(ball: &Ball) -> Ball {
    Ball { radius: Rational::from(&ball.radius * ROOM), ..ball.clone() }
}

/// Computes a solution to thirty decimals.
fn refined<const N: usize>(
    closure: &impl Closure<N>,
    near: &[Complex<f64>],
    real: bool,
) -> Option<Vec<(Rational, Rational)>> {
    let exact = |x: f64| Rational::from_f64(x);
    let mut x: Vec<(Rational, Rational)> = near
        .iter()
        .map(|z| Some((exact(z.re)?, if real { Rational::new() } else { exact(z.im)? })))
        .collect::<Option<_>>()?;
    if x.len() != N {
        return None;
    }
    let (angles, constants) = (closure.angles(), closure.constants());
    for _ in 0..STEPS {
        let point = Centre::of(&x, &angles, Longer::BITS).within::<Longer>(0.0);
        let inverse = near_inverse(&closure.slope(&constants, &point).0)?;
        let values = closure.values(&constants, &point);
        let mut largest: f64 = 0.0;
        for (row, (re, im)) in inverse.iter().zip(&mut x) {
            let step = row.iter().zip(&values).fold(Longer::zero(), |sum, (c, f)| sum.add(&c.mul(f)));
            largest = largest.max(step.at_most());
            *re -= step.re().to_rational()?;
            *im -= step.im().to_rational()?;
            if real {
                *im = Rational::new();
            }
            // Digits beyond the accuracy of the step are dropped.
            (*re, *im) = (rounded(re, 3 * DECIMALS), rounded(im, 3 * DECIMALS));
        }
        if largest < ENOUGH {
            break;
        }
    }
    short_centre(closure, x, real)
}

/// Returns a point with thirty decimals, angles between -pi and pi.
pub(super) fn short_centre<const N: usize>(
    closure: &impl Closure<N>,
    mut x: Vec<(Rational, Rational)>,
    real: bool,
) -> Option<Vec<(Rational, Rational)>> {
    for ((re, im), is_angle) in x.iter_mut().zip(closure.angles()) {
        if is_angle {
            *re = within_a_turn(re)?;
        }
        (*re, *im) = (rounded(re, DECIMALS), if real { Rational::new() } else { rounded(im, DECIMALS) });
    }
    Some(x)
}

/// Reduces an angle modulo 2 pi to -pi to pi.
fn within_a_turn(angle: &Rational) -> Option<Rational> {
    let turn = (Float::with_val(512, Constant::Pi) * 2_u32).to_rational()?;
    let turns = Rational::from(angle / &turn).round();
    Some(angle - &turn * turns)
}

fn rounded(x: &Rational, decimals: u32) -> Rational {
    let scale = Integer::from(10).pow(decimals);
    Rational::from((Rational::from(x * &scale).round().numer().clone(), scale))
}

impl ChainClosure {
    /// Whether the loop has fewer than six unknowns, and rotations were added.
    #[must_use]
    pub fn is_short(&self) -> bool {
        self.own < 6
    }

    /// Whether the centre of a ball is these unknowns of the loop itself but for rounding, angles modulo 2 pi.
    #[must_use]
    pub fn is_around(&self, ball: &Ball, unknowns: &[Complex<f64>]) -> bool {
        unknowns.len() == self.own
            && unknowns.iter().zip(&ball.centre).enumerate().all(|(k, (x, (re, im)))| {
                let off = x - Complex::new(re.to_f64(), im.to_f64());
                let off = if self.variables[k] == Variable::Rotation { (0.5 * off).sin() } else { off };
                off.norm() < ROUNDED
            })
    }

    /// Returns the unknowns among all joint variables.
    #[must_use]
    pub fn unknowns<T: Copy>(&self, q: &[T]) -> Vec<T> {
        q.iter().enumerate().filter(|(at, _)| Some(*at) != self.given).map(|(_, x)| *x).collect()
    }
}
