//! All zeros of a trigonometric polynomial on the circle, as in [`circle_zeros`](super::circle_zeros), eight arcs side by side.

use super::ROUNDOFF;
use super::circle_zeros::{ARCS, DEGREE, DEPTH, MOST, SAMPLES, SIZE, samples, weights};
use crate::solve::lanes::{Lanes, Row, WIDTH};
use pulp::Simd;
use std::sync::LazyLock;

/// Most pieces that wait: with sixteen zeros at most, each halving leaves some twenty undecided.
const WAITING: usize = 64;
/// Steps towards a zero: the first ones halve the piece at worst, the others are Newton's.
const STEPS: usize = 20;
/// A step of the half-tangent below this is the last: Newton's next one is below rounding.
const SETTLED: f64 = 1e-9;
/// Larger values are not looked at.
const LARGEST: f64 = 1e250;
/// Samples on one side of the middle of an arc, and those beside it on the circle.
const HALF: usize = SAMPLES / 2;
/// Samples from the middle of an arc to that of the next.
const STRIDE: usize = SAMPLES / ARCS;

/// Fixed weights of the samples.
struct Tables {
    /// Cosines and sines of the samples.
    cos: [f64; SAMPLES],
    sin: [f64; SAMPLES],
    /// Weights of the sums of the two samples at the same distance from the middle, by Bernstein coefficient.
    even: [[f64; HALF + 1]; DEGREE + 1],
    /// Weights of their differences.
    odd: [[f64; HALF]; DEGREE],
    /// The largest sum of the absolute values of the weights of one coefficient.
    sum: f64,
    /// Weights of the samples in the Fourier coefficients: the constant, those of the cosines, those of the sines.
    fourier: [[f64; SAMPLES]; SAMPLES],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let weights = weights();
    let opposite = |j: usize| (SAMPLES - j) % SAMPLES;
    // The weights of the mirrored coefficient are those of the mirrored samples.
    let even = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if j == opposite(j) { weights[i][j] } else { 0.5 * (weights[i][j] + weights[i][opposite(j)]) }
        })
    });
    let odd = std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (weights[i][j] - weights[i][opposite(j)])));
    let sum = weights.iter().map(|row| row.iter().map(|w| w.abs()).sum::<f64>()).fold(0.0, f64::max);
    let (cos, sin) = (samples().map(|(cos, _)| cos), samples().map(|(_, sin)| sin));
    let fourier = std::array::from_fn(|j| {
        let angle = sin[j].atan2(cos[j]);
        std::array::from_fn(|k| match k {
            0 => 1.0 / SAMPLES as f64,
            1..=DEGREE => 2.0 / SAMPLES as f64 * (k as f64 * angle).cos(),
            k if k <= 2 * DEGREE => 2.0 / SAMPLES as f64 * ((k - DEGREE) as f64 * angle).sin(),
            _ => 0.0,
        })
    });
    Tables { cos, sin, even, odd, sum, fourier }
});

/// Returns the cosines and the sines of the samples.
#[must_use]
#[inline(always)]
pub fn directions() -> (&'static [f64; SAMPLES], &'static [f64; SAMPLES]) {
    (&TABLES.cos, &TABLES.sin)
}

/// Bernstein coefficients on eight intervals of the half-tangent.
#[derive(Default)]
struct Pieces {
    coefficients: [Row; SIZE],
    low: Row,
    high: Row,
    error: Row,
    arc: [u8; WIDTH],
    depth: [u8; WIDTH],
}

/// What is known of the zeros in a piece.
const NONE: f64 = 0.0;
const ONE: f64 = 1.0;
const UNKNOWN: f64 = 2.0;
const HOPELESS: f64 = 3.0;

/// One piece.
#[derive(Clone, Copy)]
struct Piece {
    coefficients: [f64; SIZE],
    low: f64,
    high: f64,
    error: f64,
    arc: u8,
    depth: u8,
}

/// The intervals that hold one zero each.
pub struct Isolated {
    /// Ends of the interval of the half-tangent, and the values there.
    ends: [[f64; 2 * WIDTH]; 4],
    arc: [u8; 2 * WIDTH],
    /// The number of intervals, which is that of zeros.
    pub count: usize,
}

/// Memory for pieces.
pub struct Waiting {
    pieces: Box<[Piece; WAITING]>,
    /// The pieces that are looked at, and their halves.
    whole: Box<Pieces>,
    halves: Box<[Pieces; 2]>,
}

impl Default for Waiting {
    fn default() -> Self {
        let piece = Piece { coefficients: [0.0; SIZE], low: 0.0, high: 0.0, error: 0.0, arc: 0, depth: 0 };
        Self { pieces: Box::new([piece; WAITING]), whole: Box::default(), halves: Box::default() }
    }
}

impl Pieces {
    /// Makes these the eight arcs of values whose errors are at most `error`; the largest value is `largest`.
    #[inline(always)]
    fn be_arcs<S: Simd>(&mut self, simd: S, values: &[f64; SAMPLES], error: f64, largest: f64) {
        let tables = &*TABLES;
        // Sample j of all arcs: every third of the values, from a place on.
        let mut turned = [[0.0; 2 * ARCS]; STRIDE];
        for (j, value) in values.iter().enumerate() {
            turned[j % STRIDE][j / STRIDE] = *value;
            turned[j % STRIDE][j / STRIDE + ARCS] = *value;
        }
        let end = (std::f64::consts::TAU / (4 * ARCS) as f64).tan();
        // Sums and differences of samples are at most twice the largest value, and so many of them and of their weights there are. A weight is
        // rounded twice, a sum of two samples once, a product and a sum of so many terms by one of each, and two sums are added.
        let bound = 1.01 * tables.sum * (error + 2.0 * (HALF as f64 + 10.0) * ROUNDOFF * largest);
        (self.low, self.high, self.error) = ([-end; WIDTH], [end; WIDTH], [bound; WIDTH]);
        (self.arc, self.depth) = ([0, 1, 2, 3, 4, 5, 6, 7], [0; WIDTH]);
        for chunk in 0..Lanes::<S>::CHUNKS {
            let zero = Lanes::splat(simd, 0.0);
            let (mut even, mut odd) = ([zero; HALF + 1], [zero; HALF]);
            even[0] = Lanes::load(simd, &turned[0], chunk);
            even[HALF] = Lanes::load(simd, &turned[HALF % STRIDE][HALF / STRIDE..][..ARCS], chunk);
            for j in 1..HALF {
                let k = SAMPLES - j;
                let one = Lanes::load(simd, &turned[j % STRIDE][j / STRIDE..][..ARCS], chunk);
                let other = Lanes::load(simd, &turned[k % STRIDE][k / STRIDE..][..ARCS], chunk);
                (even[j], odd[j]) = (one + other, one - other);
            }
            for i in 0..=DEGREE {
                let mut sum = even[0] * zero.like(tables.even[i][0]);
                for j in 1..=HALF {
                    sum = even[j].fma(zero.like(tables.even[i][j]), sum);
                }
                if i == DEGREE {
                    sum.store(&mut self.coefficients[i], chunk);
                    continue;
                }
                let mut difference = odd[1] * zero.like(tables.odd[i][1]);
                for j in 2..HALF {
                    difference = odd[j].fma(zero.like(tables.odd[i][j]), difference);
                }
                (sum + difference).store(&mut self.coefficients[i], chunk);
                (sum - difference).store(&mut self.coefficients[SIZE - 1 - i], chunk);
            }
        }
    }

    /// Returns what is known of the zeros in each of the first pieces, by Descartes' rule.
    #[inline(always)]
    fn states<S: Simd>(&self, simd: S, count: usize) -> Row {
        let mut states = [UNKNOWN; WIDTH];
        for chunk in 0..count.div_ceil(S::F64_LANES) {
            let error = Lanes::load(simd, &self.error, chunk);
            let (zero, one) = (error.like(0.0), error.like(1.0));
            let first = Lanes::load(simd, &self.coefficients[0], chunk);
            // The sign of the first coefficient; 0 where it is not sure, and then nothing is.
            let sign = error.below(first).select(one, first.below(-error).select(-one, zero));
            // From here on signs are those beside the first: a run of +, at most one that is not sure, a run of -.
            let mut all_plus = error.below(first * sign);
            let (mut was_other, mut was_minus) = (!all_plus, zero.below(zero));
            let mut size = first.abs();
            let mut is_broken = was_other;
            let mut unsure = zero;
            for coefficients in &self.coefficients[1..] {
                let x = Lanes::load(simd, coefficients, chunk);
                size = size.max(x.abs());
                let x = x * sign;
                let (plus, minus) = (error.below(x), x.below(-error));
                all_plus = all_plus.and(plus);
                is_broken = is_broken.or(plus.and(was_other)).or(was_minus.and(!minus));
                was_other = was_other.or(!plus);
                was_minus = was_minus.or(minus);
                unsure = unsure + plus.or(minus).select(zero, one);
            }
            let last = (Lanes::load(simd, &self.coefficients[SIZE - 1], chunk) * sign).below(-error);
            let single = (!is_broken).and(last).and(unsure.at_most(one));
            // Where no coefficient is sure, no half will be.
            let unknown = error.below(size).select(error.like(UNKNOWN), error.like(HOPELESS));
            all_plus.select(error.like(NONE), single.select(error.like(ONE), unknown)).store(&mut states, chunk);
        }
        states
    }

    /// Makes the first so many of `sides` the left and the right halves of these.
    #[inline(always)]
    fn halve<S: Simd>(&self, simd: S, count: usize, sides: &mut [Self; 2]) {
        let [left, right] = sides;
        for chunk in 0..count.div_ceil(S::F64_LANES) {
            let mut sums = [Lanes::splat(simd, 0.0); SIZE];
            let mut size = sums[0];
            for (sum, coefficients) in sums.iter_mut().zip(&self.coefficients) {
                *sum = Lanes::load(simd, coefficients, chunk);
                size = size.max(sum.abs());
            }
            // Sixteen averages, each rounded once; the bound itself is a rounded sum.
            let own = Lanes::load(simd, &self.error, chunk);
            let grown = size.fma(size.like(SIZE as f64 * ROUNDOFF), own) * size.like(1.0 + 4.0 * f64::EPSILON);
            grown.store(&mut left.error, chunk);
            grown.store(&mut right.error, chunk);
            let (low, high) = (Lanes::load(simd, &self.low, chunk), Lanes::load(simd, &self.high, chunk));
            let middle = (low + high) * size.like(0.5);
            low.store(&mut left.low, chunk);
            middle.store(&mut left.high, chunk);
            middle.store(&mut right.low, chunk);
            high.store(&mut right.high, chunk);
            // Sums of two in place of averages, times a power of two in the end, which is exact.
            let mut scale = 1.0;
            for step in 0..SIZE {
                (sums[0] * size.like(scale)).store(&mut left.coefficients[step], chunk);
                for k in 0..SIZE - 1 - step {
                    sums[k] = sums[k] + sums[k + 1];
                }
                scale *= 0.5;
            }
            scale = 1.0;
            for k in (0..SIZE).rev() {
                (sums[k] * size.like(scale)).store(&mut right.coefficients[k], chunk);
                scale *= 0.5;
            }
        }
        for k in 0..WIDTH {
            (left.arc[k], right.arc[k]) = (self.arc[k], self.arc[k]);
            (left.depth[k], right.depth[k]) = (self.depth[k] + 1, self.depth[k] + 1);
        }
    }

    /// Puts a piece in a lane.
    #[inline(always)]
    fn set(&mut self, lane: usize, piece: &Piece) {
        for (row, x) in self.coefficients.iter_mut().zip(&piece.coefficients) {
            row[lane] = *x;
        }
        (self.low[lane], self.high[lane], self.error[lane]) = (piece.low, piece.high, piece.error);
        (self.arc[lane], self.depth[lane]) = (piece.arc, piece.depth);
    }

    /// Writes the piece in a lane.
    #[inline(always)]
    fn get(&self, lane: usize, piece: &mut Piece) {
        for (row, x) in self.coefficients.iter().zip(&mut piece.coefficients) {
            *x = row[lane];
        }
        (piece.low, piece.high, piece.error) = (self.low[lane], self.high[lane], self.error[lane]);
        (piece.arc, piece.depth) = (self.arc[lane], self.depth[lane]);
    }

    /// Lists the zeros of the first pieces, and lets those wait whose zeros are not known. Returns whether there was room.
    #[inline(always)]
    fn sort<S: Simd>(
        &self,
        simd: S,
        count: usize,
        waiting: &mut [Piece; WAITING],
        left: &mut usize,
        zeros: &mut Isolated,
    ) -> bool {
        let states = self.states(simd, count);
        for (lane, state) in states.iter().enumerate().take(count) {
            if *state == NONE {
                continue;
            }
            if *state == ONE {
                if zeros.count == 2 * WIDTH {
                    return false;
                }
                let ends =
                    [self.low[lane], self.high[lane], self.coefficients[0][lane], self.coefficients[SIZE - 1][lane]];
                for (slot, end) in zeros.ends.iter_mut().zip(ends) {
                    slot[zeros.count] = end;
                }
                zeros.arc[zeros.count] = self.arc[lane];
                zeros.count += 1;
                continue;
            }
            if *state == HOPELESS || *left == WAITING || usize::from(self.depth[lane]) >= DEPTH {
                return false;
            }
            self.get(lane, &mut waiting[*left]);
            *left += 1;
        }
        true
    }
}

/// Isolates all zeros of a trigonometric polynomial of degree 8 that has these values at the samples, each off by at most `error`; `None`
/// where zeros crowd or may be multiple.
#[inline(always)]
pub fn isolated<S: Simd>(
    simd: S,
    values: &[f64; SAMPLES],
    [error, largest]: [f64; 2],
    waiting: &mut Waiting,
) -> Option<Isolated> {
    // Nothing overflows.
    if !(error < LARGEST && largest < LARGEST) {
        return None;
    }
    let Waiting { pieces, whole, halves } = waiting;
    let mut zeros = Isolated { ends: [[0.0; 2 * WIDTH]; 4], arc: [0; 2 * WIDTH], count: 0 };
    let (mut left, mut visited) = (0, 0);
    whole.be_arcs(simd, values, error, largest);
    if !whole.sort(simd, WIDTH, pieces, &mut left, &mut zeros) {
        return None;
    }
    while left > 0 {
        let count = left.min(WIDTH);
        visited += count;
        if visited > MOST {
            return None;
        }
        left -= count;
        for lane in 0..count {
            whole.set(lane, &pieces[left + lane]);
        }
        whole.halve(simd, count, halves);
        for half in halves.iter() {
            if !half.sort(simd, count, pieces, &mut left, &mut zeros) {
                return None;
            }
        }
    }
    // Lanes that are not used do what the first one does.
    for k in zeros.count..2 * WIDTH {
        for slot in &mut zeros.ends {
            slot[k] = slot[0];
        }
        zeros.arc[k] = zeros.arc[0];
    }
    Some(zeros)
}

/// Returns the Fourier coefficients of the values: the constant, eight of cosines, eight of sines.
#[inline(always)]
pub fn fourier<S: Simd>(simd: S, values: &[f64; SAMPLES]) -> [f64; SAMPLES] {
    let tables = &*TABLES;
    let mut coefficients = [0.0; SAMPLES];
    for chunk in 0..SAMPLES / S::F64_LANES {
        let mut sum = Lanes::splat(simd, 0.0);
        for (value, row) in values.iter().zip(&tables.fourier) {
            sum = sum.like(*value).fma(Lanes::load(simd, row, chunk), sum);
        }
        sum.store(&mut coefficients, chunk);
    }
    coefficients
}

impl Isolated {
    /// Returns cosines and sines near the zeros of a register, by Newton's method kept inside the intervals.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, fourier: &[f64; SAMPLES], chunk: usize) -> [Lanes<S>; 2] {
        let tables = &*TABLES;
        let (mut middle_cos, mut middle_sin) = ([0.0; 2 * WIDTH], [0.0; 2 * WIDTH]);
        for (k, arc) in self.arc.iter().enumerate() {
            let sample = STRIDE * usize::from(*arc);
            (middle_cos[k], middle_sin[k]) = (tables.cos[sample], tables.sin[sample]);
        }
        let middle_cos = Lanes::load(simd, &middle_cos, chunk);
        let middle_sin = Lanes::load(simd, &middle_sin, chunk);
        let [mut low, mut high] = [Lanes::load(simd, &self.ends[0], chunk), Lanes::load(simd, &self.ends[1], chunk)];
        let [at_low, at_high] = [Lanes::load(simd, &self.ends[2], chunk), Lanes::load(simd, &self.ends[3], chunk)];
        let one = low.like(1.0);
        // The first place is that of the secant.
        let mut t = low - at_low * (high - low) / (at_high - at_low);
        let mut step = 0;
        loop {
            let square = t * t;
            let over = one / (one + square);
            let (near_cos, near_sin) = ((one - square) * over, (t + t) * over);
            let cos = near_cos * middle_cos - near_sin * middle_sin;
            let sin = near_sin * middle_cos + near_cos * middle_sin;
            if step == STEPS {
                return [cos, sin];
            }
            let (mut re, mut im) = (one.like(fourier[DEGREE]), one.like(-fourier[2 * DEGREE]));
            let (mut slope_re, mut slope_im) = (one.like(0.0), one.like(0.0));
            for k in (0..DEGREE).rev() {
                let imaginary = if k == 0 { 0.0 } else { -fourier[DEGREE + k] };
                let turned = slope_re * cos - slope_im * sin + re;
                slope_im = slope_re * sin + slope_im * cos + im;
                slope_re = turned;
                let turned = re * cos - im * sin + one.like(fourier[k]);
                im = re * sin + im * cos + one.like(imaginary);
                re = turned;
            }
            let slope = -(cos * slope_im + sin * slope_re);
            // The sign at the lower end stays at that end.
            let is_low = one.like(0.0).below(re * at_low);
            (low, high) = (is_low.select(t, low), is_low.select(high, t));
            let next = t - re / (slope * (over + over));
            let is_inside = low.at_most(next).and(next.at_most(high));
            let next = is_inside.select(next, one.like(0.5) * (low + high));
            let moved = (next - t).abs();
            let is_settled = moved.below(one.like(SETTLED));
            t = next;
            step += 1;
            if step < STEPS && is_settled.all() {
                step = STEPS;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::circle_zeros::zeros;
    use pulp::{Arch, Scalar, WithSimd};
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::TAU;

    struct Search<'a>(&'a [f64; SAMPLES], f64, &'a mut Waiting);

    impl WithSimd for Search<'_> {
        type Output = Option<Vec<f64>>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Option<Vec<f64>> {
            let largest = self.0.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
            let found = isolated(simd, self.0, [self.1, largest], self.2)?;
            let fourier = fourier(simd, self.0);
            let (mut cos, mut sin) = ([0.0; 2 * WIDTH], [0.0; 2 * WIDTH]);
            for chunk in 0..found.count.div_ceil(S::F64_LANES) {
                let [c, s] = found.near(simd, &fourier, chunk);
                c.store(&mut cos, chunk);
                s.store(&mut sin, chunk);
            }
            Some((0..found.count).map(|k| sin[k].atan2(cos[k])).collect())
        }
    }

    /// Products of sines of half the distances to sixteen angles, some of them complex or nearly double.
    #[test]
    fn zeros_are_those_found_one_by_one() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut waiting = Waiting::default();
        let (mut found_ones, mut told, mut all) = (0, 0, 0);
        for number in 0..3000 {
            let pairs: [(f64, f64, f64); DEGREE] = std::array::from_fn(|_| {
                let near = 10_f64.powf(random.random_range(-4.0..0.5));
                (random.random_range(0.0..TAU), near, if random.random_bool(0.5) { 1.0 } else { -1.0 })
            });
            // cos b - cos (q - a) has the zeros a + b and a - b, cosh b - cos (q - a) has none.
            let f = |q: f64| {
                let factor = |(a, b, sign): &(f64, f64, f64)| {
                    let (near, far) = (
                        (0.5 * (q - a)).sin().powi(2),
                        if *sign > 0.0 { (0.5 * b).sin().powi(2) } else { -(0.5 * b).sinh().powi(2) },
                    );
                    near - far
                };
                pairs.iter().map(factor).product::<f64>()
            };
            let values = samples().map(|(cos, sin)| f(sin.atan2(cos)));
            let largest = values.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
            let error = largest * [1e-15, 1e-12, 1e-9][number % 3];
            let one_by_one = zeros(&values, &[error; SAMPLES]);
            // Registers of one number take the same way as wide ones.
            let side_by_side = if number % 2 == 0 {
                Arch::new().dispatch(Search(&values, error, &mut waiting))
            } else {
                Scalar.vectorize(Search(&values, error, &mut waiting))
            };
            all += 1;
            let (Some(one_by_one), Some(side_by_side)) = (one_by_one, side_by_side) else { continue };
            told += 1;
            assert_eq!(one_by_one.angles().len(), side_by_side.len(), "{pairs:?}");
            assert_eq!(side_by_side.len(), 2 * pairs.iter().filter(|pair| pair.2 > 0.0).count(), "{pairs:?}");
            for angle in side_by_side {
                let apart = |b: &f64| (0.5 * (angle - b)).sin().abs();
                assert!(one_by_one.angles().iter().any(|b| apart(b) < 1e-4), "{angle} of {:?}", one_by_one.angles());
                found_ones += 1;
            }
        }
        assert!(4 * told > all && found_ones > 1000, "{told} of {all} with {found_ones}");
    }
}
