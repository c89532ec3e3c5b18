//! Interpolation on the lattice of exponents that a polynomial may have: as many points as coefficients.

use super::lanes::Lanes;

/// The exponents `(e_1, ..., e_m)` with `e_i <= d_i` and `e_1 + ... + e_m <= d`, the first one running fastest.
///
/// With a point it holds all points below, so a polynomial with these exponents is determined by its values at them.
pub(super) struct Lattice {
    parameters: usize,
    /// The points one after the other, as many coordinates each as there are parameters.
    points: Vec<u32>,
    count: usize,
    /// By parameter, the lines parallel to its axis.
    lines: Vec<Lines>,
    /// The number of points on the longest line.
    longest: usize,
}

/// Parallel lines that hold each point once.
struct Lines {
    /// The indices of the points, line after line, on each from coordinate 0 on.
    points: Vec<u32>,
    /// Where each line ends.
    ends: Vec<usize>,
}

impl Lines {
    /// Returns the lines, given the number of the line of each point; points on a line come by increasing coordinates.
    fn new(line_of: &[u32]) -> Self {
        let count = line_of.iter().max().map_or(0, |&last| last as usize + 1);
        let mut ends = vec![0; count];
        for &line in line_of {
            ends[line as usize] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            (*end, sum) = (sum, sum + *end);
        }
        let mut points = vec![0; line_of.len()];
        for (point, &line) in (0..).zip(line_of) {
            let next = &mut ends[line as usize];
            points[*next] = point;
            *next += 1;
        }
        Self { points, ends }
    }

    fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.points[start..end])
    }
}

impl Lattice {
    /// Returns the lattice within these degrees, one per parameter, and a total degree; `None` if it has more than `most` points.
    pub(super) fn new(degrees: &[usize], total: usize, most: usize) -> Option<Self> {
        let parameters = degrees.len();
        count_points(degrees, total, most)?;
        let (mut points, mut count, mut lines) = (Vec::new(), 0, vec![0_u32; parameters]);
        let (mut point, mut sum) = (vec![0_u32; parameters], 0);
        // By parameter a: the start of the points with the current coordinates from a on, the index of the point one step
        // back along the axis, and the lines through earlier points.
        let (mut start, mut back) = (vec![0; parameters], vec![0; parameters]);
        let mut line_of: Vec<Vec<u32>> = vec![Vec::new(); parameters];
        let mut changed = parameters;
        loop {
            for a in 0..parameters {
                if a < changed || a + 1 == changed {
                    back[a] = std::mem::replace(&mut start[a], count);
                } else {
                    back[a] += 1;
                }
                let line = if point[a] == 0 {
                    lines[a] += 1;
                    lines[a] - 1
                } else {
                    while points[back[a] * parameters..][..a] != point[..a] {
                        back[a] += 1;
                    }
                    line_of[a][back[a]]
                };
                line_of[a].push(line);
            }
            points.extend(&point);
            count += 1;
            let mut axis = 0;
            while axis < parameters && (point[axis] as usize >= degrees[axis] || sum >= total) {
                sum -= point[axis] as usize;
                point[axis] = 0;
                axis += 1;
            }
            if axis == parameters {
                break;
            }
            point[axis] += 1;
            sum += 1;
            changed = axis + 1;
        }
        let lines: Vec<Lines> = line_of.iter().map(|line_of| Lines::new(line_of)).collect();
        let longest = lines.iter().flat_map(Lines::iter).map(<[u32]>::len).max().unwrap_or(0);
        Some(Self { parameters, points, count, lines, longest })
    }

    /// Returns the number of points, and of coefficients.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Returns a point, or the exponents of a coefficient.
    pub(super) fn point(&self, index: usize) -> &[u32] {
        &self.points[index * self.parameters..][..self.parameters]
    }

    /// Turns the values at the points into the coefficients, in place.
    ///
    /// # Source
    /// Newton's forward differences along all axes, then Horner's rule from falling factorials to powers along all axes.
    #[inline(always)]
    pub(super) fn interpolate<L: Lanes>(&self, lanes: L, values: &mut [L::Element]) {
        let inverses = inverse_factorials(lanes, self.longest);
        let mut on_line = vec![lanes.zero(); self.longest];
        for line in self.lines.iter().flat_map(Lines::iter) {
            let on_line = &mut on_line[..line.len()];
            gather(values, line, on_line);
            for order in 1..on_line.len() {
                for i in (order..on_line.len()).rev() {
                    on_line[i] = lanes.sub(on_line[i], on_line[i - 1]);
                }
            }
            for i in 0..line.len() {
                values[line[i] as usize] = lanes.mul(on_line[i], inverses[i]);
            }
        }
        // Only now: with a term of the lattice go all lower ones, in powers as in falling factorials, but not the values
        // at its points.
        for line in self.lines.iter().flat_map(Lines::iter) {
            let on_line = &mut on_line[..line.len()];
            gather(values, line, on_line);
            let mut node = lanes.zero();
            for _ in 2..on_line.len() {
                node = lanes.sub(node, lanes.one());
            }
            for k in (1..on_line.len().saturating_sub(1)).rev() {
                for i in k..on_line.len() - 1 {
                    on_line[i] = lanes.mul_add(node, on_line[i + 1], on_line[i]);
                }
                node = lanes.add(node, lanes.one());
            }
            for i in 0..line.len() {
                values[line[i] as usize] = on_line[i];
            }
        }
    }
}

/// Returns the number of points, if it is not beyond `most`.
pub(super) fn count_points(degrees: &[usize], total: usize, most: usize) -> Option<usize> {
    let highest = degrees.iter().fold(0, |sum: usize, &degree| sum.saturating_add(degree)).min(total);
    // There are as many points on the way to one with the highest sum.
    if highest >= most {
        return None;
    }
    // The number of points of each sum.
    let mut counts = vec![0_usize; highest + 1];
    counts[0] = 1;
    for &degree in degrees {
        let (before, mut window) = (counts.clone(), 0_usize);
        for sum in 0..=highest {
            window = window.saturating_add(before[sum]);
            if window == usize::MAX {
                return None;
            }
            if sum > degree {
                window -= before[sum - degree - 1];
            }
            counts[sum] = window;
        }
    }
    let count = counts.iter().fold(0, |sum: usize, &count| sum.saturating_add(count));
    (count <= most).then_some(count)
}

/// Copies the values on a line.
#[inline(always)]
fn gather<E: Copy>(values: &[E], line: &[u32], on_line: &mut [E]) {
    for i in 0..line.len() {
        on_line[i] = values[line[i] as usize];
    }
}

/// Returns `1/k!` for k below the count.
#[inline(always)]
fn inverse_factorials<L: Lanes>(lanes: L, count: usize) -> Vec<L::Element> {
    let (mut factorial, mut k) = (lanes.one(), lanes.zero());
    for _ in 1..count {
        k = lanes.add(k, lanes.one());
        factorial = lanes.mul(factorial, k);
    }
    let mut inverse = lanes.inverse(factorial);
    let mut inverses = vec![inverse; count];
    for i in (1..count).rev() {
        inverse = lanes.mul(inverse, k);
        k = lanes.sub(k, lanes.one());
        inverses[i - 1] = inverse;
    }
    inverses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modp::{Modulus, PRIME_61};

    #[test]
    fn a_lattice_holds_the_exponents_within_the_degrees_and_no_more_points_than_allowed() {
        let lattice = Lattice::new(&[2, 3], 3, 9).unwrap();
        let points: Vec<&[u32]> = (0..lattice.count()).map(|k| lattice.point(k)).collect();
        assert_eq!(points, [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [0, 3]]);
        assert!(Lattice::new(&[2, 3], 3, 8).is_none());
        assert_eq!(Lattice::new(&[], 0, 1).unwrap().count(), 1);
    }

    #[test]
    fn values_at_the_points_give_back_the_coefficients() {
        let modulus = Modulus::new(PRIME_61);
        for (degrees, total) in [(vec![], 5), (vec![6], 6), (vec![4, 7], 8), (vec![3, 1, 4], 5), (vec![2, 2, 2], 6)] {
            let lattice = Lattice::new(&degrees, total, 1000).unwrap();
            let coefficients: Vec<u64> = (0..lattice.count()).map(|k| modulus.enter(1 + 37 * k as u64)).collect();
            let value = |point: &[u32]| {
                let term = |(k, &c): (usize, &u64)| {
                    let power = |(&x, &e): (&u32, &u32)| modulus.pow(modulus.enter(x.into()), e.into());
                    point.iter().zip(lattice.point(k)).map(power).fold(c, |a, b| Modulus::mul(&modulus, a, b))
                };
                coefficients.iter().enumerate().map(term).fold(0, |a, b| Modulus::add(&modulus, a, b))
            };
            let mut values: Vec<u64> = (0..lattice.count()).map(|k| value(lattice.point(k))).collect();
            lattice.interpolate(modulus, &mut values);
            assert_eq!(values, coefficients);
        }
    }
}
