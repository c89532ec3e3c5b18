//! Candidates of one pose, real and complex, polished and proved side by side in vector registers.

use super::lane_finish::Finish;
use super::mode::Mode;
use crate::solve::lane_closure::{Angular, normalised};
use crate::solve::lanes::{ComplexLanes, Lanes, WIDTH};
use num_complex::Complex;
use pulp::{Simd, WithSimd};

/// Most candidates of one kind.
pub(super) const MOST: usize = 16;
/// Cosines and sines of six angles in the order of the loop.
pub(super) type Pairs<S> = [(S, S); 6];
/// Which candidates are proved.
pub(super) type Done = [bool; MOST];

/// Candidates that are polished and proved side by side, complex ones with their conjugates; which of them are is the result, real ones
/// first.
pub(super) struct SideBySide<'a> {
    /// The loop at a pose.
    pub finish: Finish<'a>,
    /// At most [`MOST`] real candidates.
    pub real: &'a [Pairs<f64>],
    /// At most [`MOST`] complex ones.
    pub complex: &'a [Pairs<Complex<f64>>],
    /// The list that is added to.
    pub modes: &'a mut Vec<Mode>,
}

/// The numbers of a pair: real and imaginary part of the cosine, then of the sine.
trait Parts {
    fn parts(&self) -> [f64; 4];
}

impl Parts for (f64, f64) {
    fn parts(&self) -> [f64; 4] {
        [self.0, 0.0, self.1, 0.0]
    }
}

impl Parts for (Complex<f64>, Complex<f64>) {
    fn parts(&self) -> [f64; 4] {
        [self.0.re, self.0.im, self.1.re, self.1.im]
    }
}

impl SideBySide<'_> {
    /// Polishes and proves candidates, register by register.
    #[inline(always)]
    fn list<S: Simd, N: Angular<S>, P: Parts>(
        &mut self,
        one: Lanes<S>,
        starts: &[[P; 6]],
    ) -> Done {
        let mut done = [false; MOST];
        for (chunk, starts) in starts[..starts.len().min(MOST)].chunks(S::F64_LANES).enumerate() {
            // Lanes that are not used do what the first one does.
            let mut rows = [[[0.0; WIDTH]; 4]; 6];
            for lane in 0..S::F64_LANES {
                for (row, pair) in rows.iter_mut().zip(&starts[if lane < starts.len() { lane } else { 0 }]) {
                    for (row, x) in row.iter_mut().zip(pair.parts()) {
                        row[lane] = x;
                    }
                }
            }
            let mut pairs = [[N::of(one); 2]; 6];
            for (pair, row) in pairs.iter_mut().zip(&rows) {
                let [a, b, c, d] = row;
                let cos = N::from_parts(one.loaded(a), one.loaded(b));
                *pair = normalised([cos, N::from_parts(one.loaded(c), one.loaded(d))]);
            }
            let found = self.finish.proved(pairs, one);
            for lane in 0..starts.len() {
                let Some(mode) = found.mode(lane) else { continue };
                done[chunk * S::F64_LANES + lane] = true;
                if !mode.real {
                    self.modes.push(mode.conjugate());
                }
                self.modes.push(mode);
            }
        }
        done
    }
}

impl WithSimd for SideBySide<'_> {
    type Output = [Done; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> [Done; 2] {
        let one = Lanes::splat(simd, 1.0);
        [self.list::<S, Lanes<S>, _>(one, self.real), self.list::<S, ComplexLanes<S>, _>(one, self.complex)]
    }
}
