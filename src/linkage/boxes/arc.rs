//! An arc of the unit circle, and what a linear form in cosine and sine takes on it.

use crate::algebra::elementary::sin_cos;

/// A bound of all roundings in a form of at most [`MOST_ROWS`] rows and as many angles, in parts of its size: with n rows and
/// m angles, sums of n and m terms are off by (n + m) 2^-53, data by 2^-52, cosine and sine by 2^-52 each, and eight
/// operations stand between: less than 160 * 2^-53 = 1.8e-14.
pub const ROUNDING: f64 = 1e-13;
/// Most rows and most angles for which [`ROUNDING`] is a bound.
pub const MOST_ROWS: usize = 64;
/// Arcs above this width, below half a turn by more than rounding, are treated as whole circles.
const HALF_TURN: f64 = 3.125;

/// All angles between two floating-point numbers, in radians.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    lo: f64,
    hi: f64,
    /// Cosine and sine of the ends, off by 2^-52 at most.
    at_lo: [f64; 2],
    at_hi: [f64; 2],
}

/// `u cos + v sin`, in size at most `size`, which also says how far u and v are off: [`ROUNDING`] times it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wave {
    /// The factor of the cosine.
    pub u: f64,
    /// The factor of the sine.
    pub v: f64,
    /// A bound of the terms that were added up.
    pub size: f64,
}

fn point(angle: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos(angle);
    [cos, sin]
}

impl Wave {
    fn at(&self, [cos, sin]: [f64; 2]) -> f64 {
        self.u * cos + self.v * sin
    }

    /// The derivative by the angle.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self { u: self.v, v: -self.u, size: self.size }
    }

    fn negative(&self) -> Self {
        Self { u: -self.u, v: -self.v, size: self.size }
    }

    fn amplitude(&self) -> f64 {
        (self.u * self.u + self.v * self.v).sqrt()
    }
}

impl Arc {
    /// The angles from `lo` to `hi`.
    #[must_use]
    pub fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi, at_lo: point(lo), at_hi: point(hi) }
    }

    /// The least angle.
    #[must_use]
    pub fn lo(&self) -> f64 {
        self.lo
    }

    /// The largest angle.
    #[must_use]
    pub fn hi(&self) -> f64 {
        self.hi
    }

    /// The difference of the ends.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.hi - self.lo
    }

    /// The angle in the middle.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * (self.lo + self.hi)
    }

    /// The arcs on both sides of an angle.
    #[must_use]
    pub fn split(&self, angle: f64) -> [Self; 2] {
        let at = point(angle);
        [Self { hi: angle, at_hi: at, ..*self }, Self { lo: angle, at_lo: at, ..*self }]
    }

    /// The least arc that holds this one and the angles within `off` of another angle.
    #[must_use]
    pub fn with(&self, angle: f64, off: f64) -> Self {
        Self::new(self.lo.min(angle - off), self.hi.max(angle + off))
    }

    /// Bounds of a wave on the arc; they hold up to [`ROUNDING`] times its size.
    ///
    /// On an arc below half a turn the largest value is at an end, unless the wave rises at the lower end and falls at the
    /// upper one; then the amplitude bounds it.
    #[inline]
    #[must_use]
    pub fn range(&self, wave: &Wave) -> [f64; 2] {
        let whole = wave.amplitude();
        if self.width() > HALF_TURN {
            return [-whole, whole];
        }
        let off = ROUNDING * wave.size;
        let ends = [wave.at(self.at_lo), wave.at(self.at_hi)];
        let slope = wave.derivative();
        let slopes = [slope.at(self.at_lo), slope.at(self.at_hi)];
        let lo = if slopes[0] < off && slopes[1] > -off { -whole } else { ends[0].min(ends[1]) };
        let hi = if slopes[0] > -off && slopes[1] < off { whole } else { ends[0].max(ends[1]) };
        [lo, hi]
    }

    /// Removes angles at the ends where a wave is above `top`, if they are more than the part `gain` of the arc; false where
    /// none is left.
    ///
    /// The angle at which the wave comes down to `top` is computed with the functions of the standard library; that the wave
    /// is above `top` beyond it is then proved with [`Self::range`].
    pub fn trim_above(&mut self, wave: &Wave, top: f64, gain: f64) -> bool {
        let top = top + ROUNDING * wave.size;
        let whole = wave.amplitude();
        if !(top < whole && top > -whole) {
            return true;
        }
        let (crest, half) = (wave.v.atan2(wave.u), (top / whole).acos());
        // Four roundings beside the angle where it is steep, more where it is flat.
        let margin = 4e-13 + 4.0 * ROUNDING * wave.size / (whole * half.sin());
        let nearest = |angle: f64| crest + std::f64::consts::TAU * ((angle - crest) / std::f64::consts::TAU).round();
        let least = gain * self.width();
        if wave.at(self.at_hi) > top {
            let end = nearest(self.hi) - half + margin;
            if end <= self.lo {
                if is_above(wave, top, self.lo, self.hi) {
                    return false;
                }
            } else if self.hi - end > least && is_above(wave, top, end, self.hi) {
                *self = Self { hi: end, at_hi: point(end), ..*self };
            }
        }
        if wave.at(self.at_lo) > top {
            let end = nearest(self.lo) + half - margin;
            if end >= self.hi {
                if is_above(wave, top, self.lo, self.hi) {
                    return false;
                }
            } else if end - self.lo > least && is_above(wave, top, self.lo, end) {
                *self = Self { lo: end, at_lo: point(end), ..*self };
            }
        }
        true
    }

    /// Removes angles at the ends where a wave is below `bottom`; false where none is left.
    pub fn trim_below(&mut self, wave: &Wave, bottom: f64, gain: f64) -> bool {
        self.trim_above(&wave.negative(), -bottom, gain)
    }
}

/// Whether a wave is above a number at all angles from `lo` to `hi`, a turn apart at most.
fn is_above(wave: &Wave, top: f64, lo: f64, hi: f64) -> bool {
    // Thirds of a turn are below half a turn.
    let thirds = [lo, lo + (hi - lo) / 3.0, lo + (hi - lo) / 1.5, hi];
    let parts: &[f64] = if hi - lo > HALF_TURN { &thirds } else { &[lo, hi] };
    parts.windows(2).all(|ends| Arc::new(ends[0], ends[1]).range(wave)[0] > top)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values_and_are_met() {
        let wave = Wave { u: 0.6, v: -0.8, size: 1.0 };
        for k in 0..40 {
            for width in [1e-6, 0.3, 2.0, 3.1, 5.0] {
                let lo = -3.0 + 0.17 * f64::from(k);
                let arc = Arc::new(lo, lo + width);
                let [least, largest] = arc.range(&wave);
                let values: Vec<f64> = (0..=1000).map(|i| wave.at(point(lo + width * f64::from(i) / 1000.0))).collect();
                let seen = values.iter().fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(*x), b.max(*x)]);
                assert!(least <= seen[0] + 1e-13 && seen[1] <= largest + 1e-13);
                assert!(width > HALF_TURN || (seen[0] - least < 1e-5 && largest - seen[1] < 1e-5));
            }
        }
    }

    #[test]
    fn arcs_keep_the_angles_below_a_bound() {
        let wave = Wave { u: 1.0, v: 0.0, size: 1.0 };
        let mut arc = Arc::new(-1.0, 2.0);
        assert!(arc.trim_above(&wave, 0.0, 0.0));
        assert!(arc.lo() > 1.57 && arc.lo() <= std::f64::consts::FRAC_PI_2 && arc.hi() == 2.0);
        assert!(!Arc::new(-1.0, 1.0).trim_above(&wave, 0.5, 0.0));
        let mut whole = Arc::new(-3.0, 3.3);
        assert!(whole.trim_below(&wave, 0.0, 0.0));
        assert!(whole.lo() < -1.57 && whole.lo() > -1.58 && whole.hi() > 1.57 && whole.hi() < 1.58);
    }
}
