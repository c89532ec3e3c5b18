//! Sine, cosine and exponential in f64 with proved error bounds; those of the standard library have none.
//!
//! Arguments are reduced by a constant split in two: multiples of its head, of 33 bits, are exact, and so is the
//! difference from the argument. The remainder is small enough for a Taylor polynomial. With the unit roundoff u = 2^-53,
//! cosine and sine are off by at most 2 u, the exponential by 4 u times itself. (The remainders of the series are below
//! 1e-19. The sum ends in one addition, off by u; its second term is below 1/2 and off by a few parts u of less than 0.35.)

/// The first 33 bits of pi/2, and the rest.
const QUARTER_TURN: (f64, f64) = (1.570_796_326_734_125_6, 6.077_100_506_506_192e-11);
/// The first 33 bits of the logarithm of 2, and the rest.
const LN_2: (f64, f64) = (0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10);
/// Multiples of a head below this are exact.
const MOST_MULTIPLES: f64 = 1_048_576.0;
/// Exponents of two of normal numbers are at most this.
const LARGEST_EXPONENT: f64 = 1022.0;

/// Returns `sum c_k x^k`, the highest coefficient last.
#[inline(always)]
fn horner<const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Returns `(-1)^k / (2 k + first)!` of consecutive k.
const fn alternating<const N: usize>(first: usize) -> [f64; N] {
    let mut terms = [0.0; N];
    let mut k = 0;
    let mut factorial = 1.0;
    let mut n = 1;
    while k < N {
        let top = first + 2 * k;
        while n <= top {
            factorial *= n as f64;
            n += 1;
        }
        terms[k] = if k % 2 == 0 { 1.0 } else { -1.0 } / factorial;
        k += 1;
    }
    terms
}

/// `-1/3!, 1/5!, ...` with the sign turned.
const SINE: [f64; 8] = alternating(3);
/// `1/4!, -1/6!, ...`
const COSINE: [f64; 8] = alternating(4);
/// `1/2!, 1/3!, ...`
const EXPONENTIAL: [f64; 13] = {
    let mut terms = [0.5; 13];
    let mut k = 1;
    while k < 13 {
        terms[k] = terms[k - 1] / (k as f64 + 2.0);
        k += 1;
    }
    terms
};

/// Sine and cosine, each off by at most 2^-52; NaN beyond a million turns.
#[must_use]
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let multiple = (x * std::f64::consts::FRAC_2_PI).round();
    if !(multiple.abs() < MOST_MULTIPLES) {
        return (f64::NAN, f64::NAN);
    }
    let (head, tail) = (x - multiple * QUARTER_TURN.0, multiple * QUARTER_TURN.1);
    let r = head - tail;
    // The rounding error of r.
    let low = (head - r) - tail;
    let z = r * r;
    let sin = r + (low * (1.0 - 0.5 * z) - z * r * horner(&SINE, z));
    let half = 0.5 * z;
    let near = 1.0 - half;
    let cos = near + (((1.0 - near) - half) + (z * z * horner(&COSINE, z) - r * low));
    #[expect(clippy::cast_possible_truncation, reason = "a quadrant")]
    match (multiple as i64).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Returns the exponential, off by at most 2^-51 of itself; infinite or 0 if it is no normal number.
#[must_use]
#[inline]
pub fn exp(x: f64) -> f64 {
    let multiple = (x * std::f64::consts::LOG2_E).round();
    if !(multiple.abs() < LARGEST_EXPONENT) {
        return if x > 0.0 { f64::INFINITY } else { 0.0 * x };
    }
    let r = (x - multiple * LN_2.0) - multiple * LN_2.1;
    let reduced = 1.0 + (r + r * r * horner(&EXPONENTIAL, r));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an exponent of a normal number")]
    let power = f64::from_bits(((multiple + 1023.0) as u64) << 52);
    reduced * power
}

/// Returns the hyperbolic sine of a number below 1/4 in size, off by at most 2^-51 of itself.
#[must_use]
#[inline]
pub fn small_sinh(x: f64) -> f64 {
    // x + x^3/3! + x^5/5! + ..., the signs of the sine turned back.
    let z = x * x;
    x + x * z * horner(&SINE, -z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    fn error(found: f64, truth: &Float) -> f64 {
        Float::with_val(200, truth - found).abs().to_f64() * 2.0_f64.powi(53)
    }

    #[test]
    fn the_error_bounds_hold() {
        let mut worst = [0.0_f64; 4];
        for k in 0..60_000 {
            let part = f64::from(k) * 0.618_033_988_749_894_9 % 1.0;
            let scale = [1.0, 3.2, 30.0, 1e5, 1e-5][usize::try_from(k).unwrap() % 5];
            let x = (2.0 * part - 1.0) * scale;
            let (sin, cos) = sin_cos(x);
            let exact = Float::with_val(200, x);
            worst[0] = worst[0].max(error(sin, &exact.clone().sin()));
            worst[1] = worst[1].max(error(cos, &exact.clone().cos()));
            if x.abs() < 700.0 {
                let truth = exact.clone().exp();
                worst[2] = worst[2].max(error(exp(x), &truth) / truth.to_f64());
            }
            let y = 0.25 * (2.0 * part - 1.0);
            let truth = Float::with_val(200, y).sinh();
            worst[3] = worst[3].max(error(small_sinh(y), &truth) / truth.to_f64().abs());
        }
        println!("worst errors in parts of 2^-53: {worst:?}");
        assert!(worst[0] < 1.5 && worst[1] < 1.5 && worst[2] < 3.0 && worst[3] < 3.0, "{worst:?}");
    }

    #[test]
    fn the_ends_are_what_they_are() {
        assert_eq!((sin_cos(0.0), exp(0.0)), ((0.0, 1.0), 1.0));
        assert!(sin_cos(1e9).0.is_nan() && sin_cos(f64::NAN).1.is_nan() && exp(f64::NAN).is_nan());
        assert_eq!((exp(1e4), exp(-1e4)), (f64::INFINITY, 0.0));
    }
}
