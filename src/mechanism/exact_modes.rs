//! Solutions in balls as assembly modes: angles and distances in f64, with radii that hold.

use crate::algebra::ball::Ball;
use crate::assembly::{Hits, Mode, wrapped};
use crate::certify::Certificate;
use crate::exact::Pair;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::solve::dense;
use crate::solve::newton::{Six, closure};
use num_complex::Complex;
use rug::Float;
use rug::ops::CompleteRound;

/// Bits in which angles are computed before they are rounded to f64: the error of that is below one unit of f64.
const BITS: u32 = 128;

/// The mode of a solution; the loop has lengths over a unit. The radius bounds the distance of every unknown from the solution, rounding to f64 included.
pub(super) fn exact_mode<const B: u32>(
    (closed, unit): (&ClosedLoop<f64>, f64),
    pairs: &[Pair<B>; 6],
    is_real: bool,
    multiplicity: usize,
) -> Mode {
    let values: [(Complex<f64>, f64); 6] = std::array::from_fn(|k| match closed.variables[k] {
        Variable::Rotation => angle(&pairs[k], is_real),
        Variable::Translation => distance(&pairs[k].0, is_real),
    });
    let unknowns: Six<Complex<f64>> = values.map(|(value, _)| value);
    let radius = values.iter().map(|(_, radius)| *radius).fold(0.0, f64::max);
    let scaled = |k: usize| if closed.variables[k] == Variable::Translation { unknowns[k] / unit } else { unknowns[k] };
    let inside: Six<Complex<f64>> = std::array::from_fn(scaled);
    let here = closure(closed, &inside);
    let inverse = dense::inverse(&here.jacobian).filter(|_| multiplicity == 1);
    Mode {
        unknowns,
        real: is_real,
        multiplicity,
        residual: here.relative_defect(closed, &inside, is_real),
        condition: inverse.map_or(f64::INFINITY, |inverse| dense::norm(&here.jacobian) * dense::norm(&inverse)),
        certificate: radius.is_finite().then_some(Certificate { radius, isolation: radius, proved: radius }),
        hits: Hits::first(0),
    }
}

/// A distance, and how far it may be off.
fn distance<const B: u32>(ball: &Ball<B>, is_real: bool) -> (Complex<f64>, f64) {
    let (re, im) = (ball.re().to_f64(), if is_real { 0.0 } else { ball.im().to_f64() });
    // Both parts are truncated to f64.
    let rounding = 2.0 * f64::EPSILON * (re.abs() + im.abs()) + f64::MIN_POSITIVE;
    (Complex::new(re, im), ball.radius().to_f64() * 1.01 + rounding)
}

/// The angle of a cosine and a sine, and how far it may be off: with `u = cos + i sin = e^(iq)`, `q = arg u - i ln |u|`.
fn angle<const B: u32>((cos, sin): &Pair<B>, is_real: bool) -> (Complex<f64>, f64) {
    let float = |x: &Float| Float::with_val(BITS, x);
    // cos + i sin, and cos - i sin = 1/u, of which the larger one has all its digits.
    let part = |sign: i32| {
        let re = Float::with_val(BITS, cos.re() - Float::with_val(B, sin.im() * sign));
        let im = Float::with_val(BITS, cos.im() + Float::with_val(B, sin.re() * sign));
        (re, im)
    };
    let size = |(re, im): &(Float, Float)| re.hypot_ref(im).complete(BITS);
    let (one, other) = (part(1), part(-1));
    let (u, sign) = if size(&one) >= size(&other) { (one, 1.0) } else { (other, -1.0) };
    let length = size(&u);
    let re = wrapped(sign * float(&u.1).atan2(&u.0).to_f64());
    let im = if is_real { 0.0 } else { -sign * length.clone().ln().to_f64() };
    // |dq| = |du| / |u|; f64 and the functions round by less than two units in the last place.
    let error = Float::with_val(64, cos.radius() + sin.radius()) / length;
    let rounding = 2.0 * f64::EPSILON * (re.abs() + im.abs()).max(f64::MIN_POSITIVE);
    (Complex::new(re, im), error.to_f64() * 1.01 + rounding)
}
