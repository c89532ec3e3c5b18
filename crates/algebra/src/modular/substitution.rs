//! Values of many polynomials at one point after another, parameter by parameter.

use super::batch::SIDE;
use super::lanes::Lanes;

/// The collapse of terms when one parameter gets a value: runs of terms that agree in all other exponents, highest
/// exponent first, each summed by Horner's rule.
struct Step {
    /// By term: how far the exponent falls to the next term of the run, or from the last term to 0.
    gaps: Vec<u32>,
    /// By run: the index after its last term.
    ends: Vec<usize>,
}

/// The order in which polynomials are evaluated, known from their exponents alone.
pub(super) struct Plan {
    /// The substitution of each parameter, that of the last one being done first.
    steps: Vec<Step>,
    /// The polynomial to which each of the remaining values belongs.
    slots: Vec<usize>,
}

impl Plan {
    /// Returns the plan for terms in descending order of their keys: the index of the polynomial, then its exponents.
    ///
    /// `exponents` holds as many numbers per term as there are parameters.
    pub(super) fn new(slots: &[usize], exponents: &[u32], parameters: usize) -> Self {
        let mut slots = slots.to_vec();
        // The exponents of the terms that are left.
        let mut left = exponents.to_vec();
        let mut steps = Vec::with_capacity(parameters);
        for width in (1..=parameters).rev() {
            let (mut gaps, mut ends) = (Vec::with_capacity(slots.len()), Vec::new());
            let (mut kept_slots, mut kept) = (Vec::new(), Vec::new());
            for t in 0..slots.len() {
                let row = &left[t * width..][..width];
                let same = t + 1 < slots.len()
                    && slots[t] == slots[t + 1]
                    && row[..width - 1] == left[(t + 1) * width..][..width - 1];
                if same {
                    gaps.push(row[width - 1] - left[(t + 2) * width - 1]);
                } else {
                    gaps.push(row[width - 1]);
                    ends.push(t + 1);
                    kept_slots.push(slots[t]);
                    kept.extend(&row[..width - 1]);
                }
            }
            steps.push(Step { gaps, ends });
            (slots, left) = (kept_slots, kept);
        }
        steps.reverse();
        Self { steps, slots }
    }
}

/// The values of the polynomials at the current points, and all that is needed to go on to the next.
pub(super) struct Values<'a, E> {
    plan: &'a Plan,
    /// At k, the terms left when the parameters from k on have their values, unused for 0; the last are the coefficients.
    left: Vec<Vec<E>>,
    /// The coordinates, from the second on, for which they are left.
    point: Vec<u32>,
}

impl<'a, E: Copy> Values<'a, E> {
    /// Nothing is evaluated yet.
    #[inline(always)]
    pub(super) fn new<L: Lanes<Element = E>>(lanes: L, plan: &'a Plan, coefficients: Vec<E>) -> Self {
        let mut left = Vec::with_capacity(plan.steps.len() + 1);
        for step in &plan.steps {
            left.push(vec![lanes.zero(); step.ends.len()]);
        }
        left.push(coefficients);
        // No point has this coordinate, so that the first one differs from it everywhere.
        let point = vec![u32::MAX; plan.steps.len().saturating_sub(1)];
        Self { plan, left, point }
    }

    /// Computes the values at four points; this is fast if they and those before differ in first coordinates only. Zero
    /// polynomials are left unchanged.
    #[inline(always)]
    pub(super) fn at<L: Lanes<Element = E>>(&mut self, lanes: L, points: [&[u32]; SIDE], values: &mut [[E; SIDE]]) {
        let Some(last) = self.plan.steps.first() else {
            for (&slot, &value) in self.plan.slots.iter().zip(&self.left[0]) {
                values[slot] = [value; SIDE];
            }
            return;
        };
        let mut first = 0;
        while first < SIDE {
            let mut end = first + 1;
            while end < SIDE && points[end][1..] == points[first][1..] {
                end += 1;
            }
            self.descend(lanes, &points[first][1..]);
            let mut x = [lanes.zero(); SIDE];
            for m in first..end {
                x[m] = lanes.digit(points[m][0]);
            }
            let (terms, mut t) = (&self.left[1], 0);
            for (&slot, &run) in self.plan.slots.iter().zip(&last.ends) {
                let mut value = [terms[t]; SIDE];
                while t + 1 < run {
                    for _ in 1..last.gaps[t] {
                        for m in 0..SIDE {
                            value[m] = lanes.mul(value[m], x[m]);
                        }
                    }
                    for m in 0..SIDE {
                        value[m] = lanes.mul_add(value[m], x[m], terms[t + 1]);
                    }
                    t += 1;
                }
                for _ in 0..last.gaps[t] {
                    for m in 0..SIDE {
                        value[m] = lanes.mul(value[m], x[m]);
                    }
                }
                t += 1;
                if end - first == SIDE {
                    values[slot] = value;
                } else {
                    values[slot][first..end].copy_from_slice(&value[first..end]);
                }
            }
            first = end;
        }
    }

    /// Gives the parameters from the second on their values.
    #[inline(always)]
    fn descend<L: Lanes<Element = E>>(&mut self, lanes: L, point: &[u32]) {
        let changed = (0..point.len()).rev().find(|&k| point[k] != self.point[k]).map_or(0, |k| k + 1);
        for k in (1..=changed).rev() {
            let x = lanes.digit(point[k - 1]);
            let step = &self.plan.steps[k];
            let (results, terms) = self.left.split_at_mut(k + 1);
            let (results, terms) = (&mut results[k], &terms[0]);
            let mut t = 0;
            for (result, &end) in results.iter_mut().zip(&step.ends) {
                let mut value = terms[t];
                while t + 1 < end {
                    for _ in 1..step.gaps[t] {
                        value = lanes.mul(value, x);
                    }
                    value = lanes.mul_add(value, x, terms[t + 1]);
                    t += 1;
                }
                for _ in 0..step.gaps[t] {
                    value = lanes.mul(value, x);
                }
                *result = value;
                t += 1;
            }
        }
        self.point.copy_from_slice(point);
    }
}
