//! Residues modulo four primes side by side, in the lanes of a vector register, which makes many primes cheap.

use super::arithmetic::{Arithmetic, Relations, Split};
use super::echelon;
use crate::algebra::modp::Modulus;
use crate::algebra::modular::lanes::{Floats, Lanes};
use pulp::{Arch, Simd, WithSimd};

/// The number of primes.
pub const SIDE: usize = 4;

/// One residue for each prime, of absolute value little more than half of it. Only the element of all zeros is 0.
pub type Residues = [f64; SIDE];

/// The primes, each below `2^49` and near it, and the machine's vector unit.
#[derive(Clone, Copy, Debug)]
pub struct SideBySide {
    arch: Arch,
    moduli: [Modulus; SIDE],
    primes: Residues,
    reciprocals: Residues,
}

/// Largest number of terms of a combination.
const MOST_TERMS: usize = 48;

impl SideBySide {
    /// The arithmetic modulo these primes; `None` on a machine whose registers do not hold four f64, or which has no fused
    /// multiply-add.
    #[must_use]
    pub fn new(moduli: [Modulus; SIDE]) -> Option<Self> {
        let arch = Arch::new();
        let primes = moduli.map(|m| m.prime() as f64);
        arch.dispatch(Fits).then_some(Self { arch, moduli, primes, reciprocals: primes.map(|p| 1.0 / p) })
    }

    /// The primes.
    #[must_use]
    pub fn moduli(&self) -> &[Modulus; SIDE] {
        &self.moduli
    }

    /// Residues in Montgomery form, one for each prime, as one element.
    #[must_use]
    pub fn join(&self, residues: [u64; SIDE]) -> Residues {
        std::array::from_fn(|k| {
            let (residue, p) = (self.moduli[k].leave(residues[k]), self.moduli[k].prime());
            if residue > p / 2 { -((p - residue) as f64) } else { residue as f64 }
        })
    }

    /// The residue for one of the primes, in Montgomery form.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer below 2^49")]
    pub fn part(&self, element: &Residues, k: usize) -> u64 {
        let size = self.moduli[k].enter(element[k].abs() as u64);
        if element[k] < 0.0 { self.moduli[k].sub(0, size) } else { size }
    }

    /// Returns `1/a`; `None` where the inverse is missing for one of the primes.
    #[must_use]
    pub fn inverse(&self, a: Residues) -> Option<Residues> {
        a.iter().all(|&x| x != 0.0).then(|| self.arch.dispatch(Inverse { moduli: &self.moduli, a }))
    }

    /// The residue that is nearly the least in absolute value.
    fn reduced(&self, a: Residues) -> Residues {
        std::array::from_fn(|k| {
            let (p, x) = (self.primes[k], a[k]);
            let shift = if x > 0.5 * p { p } else { 0.0 } - if x < -0.5 * p { p } else { 0.0 };
            x - shift
        })
    }
}

/// Detects whether an element fits into a vector register.
struct Fits;

impl WithSimd for Fits {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        // On the web a fused multiply-add may round twice.
        !S::IS_SCALAR && S::F64_LANES == SIDE && !cfg!(target_family = "wasm")
    }
}

struct Inverse<'a> {
    moduli: &'a [Modulus; SIDE],
    a: Residues,
}

impl WithSimd for Inverse<'_> {
    type Output = Residues;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Residues {
        let mut bits = Vec::new();
        let lanes = Floats::new(simd, &self.moduli.map(|m| m.prime()), &mut bits);
        let mut result = [0.0; SIDE];
        simd.partial_store_f64s(&mut result, lanes.inverse(simd.partial_load_f64s(&self.a)));
        result
    }
}

/// `target += factor source`
struct Multiple<'a> {
    field: &'a SideBySide,
    target: &'a mut [Residues],
    factor: Residues,
    source: &'a [Residues],
}

impl WithSimd for Multiple<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let lanes = Floats::of(simd, &self.field.primes, &self.field.reciprocals);
        let factor = simd.partial_load_f64s(&self.factor);
        let (target, _) = S::as_mut_simd_f64s(self.target.as_flattened_mut());
        let (source, _) = S::as_simd_f64s(self.source.as_flattened());
        for (t, s) in target.iter_mut().zip(source) {
            *t = lanes.mul_add(factor, *s, *t);
        }
    }
}

/// `target -= sum of factor source`, the longest source first.
struct Combination<'a> {
    field: &'a SideBySide,
    target: &'a mut [Residues],
    terms: &'a [(Residues, &'a [Residues])],
}

impl WithSimd for Combination<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const BLOCK: usize = 4;
        let lanes = Floats::of(simd, &self.field.primes, &self.field.reciprocals);
        let (target, _) = S::as_mut_simd_f64s(self.target.as_flattened_mut());
        for terms in self.terms.chunks(Floats::<S>::CHUNK) {
            let mut first = 0;
            while first < target.len() {
                let end = usize::min(first + BLOCK, target.len());
                let whole = if end - first == BLOCK { terms.partition_point(|(_, s)| s.len() >= end) } else { 0 };
                let mut sums = [lanes.sum(lanes.zero()); BLOCK];
                for (sum, t) in sums.iter_mut().zip(&target[first..end]) {
                    *sum = lanes.sum(*t);
                }
                for (factor, source) in &terms[..whole] {
                    let factor = simd.partial_load_f64s(factor);
                    let (source, _) = S::as_simd_f64s(source[first..first + BLOCK].as_flattened());
                    for (sum, s) in sums.iter_mut().zip(source) {
                        *sum = lanes.subtract_product(*sum, factor, *s);
                    }
                }
                for (factor, source) in &terms[whole..] {
                    if source.len() <= first {
                        break;
                    }
                    let factor = simd.partial_load_f64s(factor);
                    let (source, _) = S::as_simd_f64s(source[first..].as_flattened());
                    for (sum, s) in sums[..end - first].iter_mut().zip(source) {
                        *sum = lanes.subtract_product(*sum, factor, *s);
                    }
                }
                for (t, sum) in target[first..end].iter_mut().zip(sums) {
                    *t = lanes.reduce(sum);
                }
                first = end;
            }
        }
    }
}

impl Arithmetic for SideBySide {
    type Element = Residues;

    fn zero(&self) -> Residues {
        [0.0; SIDE]
    }
    fn one(&self) -> Residues {
        [1.0; SIDE]
    }
    #[inline(always)]
    fn add(&self, a: Residues, b: Residues) -> Residues {
        self.reduced(std::array::from_fn(|k| a[k] + b[k]))
    }
    #[inline(always)]
    fn sub(&self, a: Residues, b: Residues) -> Residues {
        self.reduced(std::array::from_fn(|k| a[k] - b[k]))
    }
    #[inline(always)]
    fn neg(&self, a: Residues) -> Residues {
        a.map(|x| -x)
    }
    fn mul(&self, a: Residues, b: Residues) -> Residues {
        let mut product = [[0.0; SIDE]];
        self.add_multiple(&mut product, a, &[b]);
        product[0]
    }
    fn add_multiple(&self, target: &mut [Residues], factor: Residues, source: &[Residues]) {
        if factor != [0.0; SIDE] {
            self.arch.dispatch(Multiple { field: self, target, factor, source });
        }
    }
    fn add_combination<'a>(&self, target: &mut [Residues], terms: impl Iterator<Item = (Residues, &'a [Residues])>) {
        let mut open: [(Residues, &[Residues]); MOST_TERMS] = [([0.0; SIDE], &[]); MOST_TERMS];
        let mut count = 0;
        for (factor, source) in terms.filter(|(factor, _)| *factor != [0.0; SIDE]) {
            if count == MOST_TERMS {
                self.arch.dispatch(Combination { field: self, target, terms: &open });
                count = 0;
            }
            // In order of their lengths: most arrive in that order.
            let source = &source[..usize::min(source.len(), target.len())];
            let mut at = count;
            while at > 0 && open[at - 1].1.len() < source.len() {
                open[at] = open[at - 1];
                at -= 1;
            }
            open[at] = (factor.map(|x| -x), source);
            count += 1;
        }
        self.arch.dispatch(Combination { field: self, target, terms: &open[..count] });
    }
    fn solve(
        &self,
        relations: &mut Relations<Residues>,
        rank: usize,
        split: &mut Split<Residues>,
    ) -> Result<f64, usize> {
        echelon::solve(self, |x| self.inverse(x), relations, rank, split)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::modular::primes::largest_primes;

    /// The arithmetic of four primes and that of each alone, on numbers at the ends of their range and others.
    #[test]
    fn four_primes_side_by_side_are_four_primes() {
        let moduli: Vec<Modulus> = largest_primes().skip(3).take(SIDE).map(Modulus::new).collect();
        let moduli: [Modulus; SIDE] = moduli.try_into().unwrap();
        let Some(field) = SideBySide::new(moduli) else { return };
        let number = |k: u64| k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (k % 11);
        let drawn = |k: u64| -> [u64; SIDE] {
            moduli.map(|m| match k % 7 {
                0 => 0,
                1 => m.enter(m.prime() / 2),
                2 => m.enter(m.prime() / 2 + 1),
                _ => m.enter(number(k)),
            })
        };
        let check = |joined: Residues, expected: [u64; SIDE]| {
            for k in 0..SIDE {
                assert_eq!(field.part(&joined, k), expected[k]);
            }
        };
        let pairs = |a: [u64; SIDE], b: [u64; SIDE], f: fn(&Modulus, u64, u64) -> u64| -> [u64; SIDE] {
            std::array::from_fn(|k| f(&moduli[k], a[k], b[k]))
        };
        for i in 0..40 {
            let (a, b) = (drawn(i), drawn(3 * i + 1));
            let (x, y) = (field.join(a), field.join(b));
            check(x, a);
            check(field.add(x, y), pairs(a, b, Modulus::add));
            check(field.sub(x, y), pairs(a, b, Modulus::sub));
            check(field.mul(x, y), pairs(a, b, Modulus::mul));
            assert_eq!(x == field.zero(), a == [0; SIDE]);
            match field.inverse(x) {
                Some(inverse) => check(field.mul(inverse, x), moduli.map(|m| m.enter(1))),
                None => assert_eq!(a, [0; SIDE]),
            }
        }
        // Combinations of more terms than are kept at a time, of all lengths.
        let length = 23;
        let start: Vec<[u64; SIDE]> = (0..length).map(drawn).collect();
        let terms: Vec<([u64; SIDE], Vec<[u64; SIDE]>)> =
            (0..60).map(|t| (drawn(t + 5), (0..(t * 7) % 25).map(|j| drawn(100 * t + j)).collect())).collect();
        let joined: Vec<(Residues, Vec<Residues>)> = terms
            .iter()
            .map(|(factor, source)| (field.join(*factor), source.iter().map(|s| field.join(*s)).collect()))
            .collect();
        let mut target: Vec<Residues> = start.iter().map(|s| field.join(*s)).collect();
        field.add_combination(&mut target, joined.iter().map(|(factor, source)| (*factor, source.as_slice())));
        for (j, found) in target.iter().enumerate() {
            let mut sum = start[j];
            for (factor, source) in &terms {
                if let Some(s) = source.get(j) {
                    sum = pairs(sum, pairs(*factor, *s, Modulus::mul), Modulus::add);
                }
            }
            check(*found, sum);
        }
    }
}
