//! The local structure of the assemblies about one of them: ranks, second-order forms, and series along first-order motions.
//! The theorems are in docs/mobility.md, section "Planar linkages".

use super::system::{Slid, System, times, turned, zero};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use rug::Rational;
use std::cell::Cell;

/// Series are not computed beyond this order: the work grows with its third power.
const MOST: usize = 300;
/// Steps of all series together, times the square of their order: some seconds.
const EFFORT: usize = 40_000_000;

/// Products of words of coefficients that all series together may take: some seconds. Coefficients of order n have up to n times the digits
/// of the file.
const PRODUCTS: u64 = 1_000_000_000;

/// Why a series ends before the last order.
enum Stop {
    /// A reduced equation fails in this order, with these values of all of them.
    Fails(usize, Vec<Rational>),
    /// The coefficients are too long beyond this order.
    TooLong(usize),
}

/// What the assemblies near one are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Local {
    /// The equations have full rank, by rows or by columns.
    Regular,
    /// Every first-order motion belongs to a motion: the equations hold through this order, beyond this bound of multiplicities.
    Moves { order: usize, bound: usize },
    /// The only first-order motion fails in this order.
    Isolated { order: usize },
    /// A second-order form is definite.
    Definite,
    /// One equation depends on the others, and its second-order form is regular and indefinite.
    Crossing,
    /// Not decided; the equations hold or fail in this order.
    Undecided { order: usize },
}

/// What was found at an assembly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) rank: usize,
    pub(super) what: Local,
    /// Lines of first-order motions along which series were computed.
    pub(super) lines: usize,
}

/// A matrix in reduced echelon form.
#[derive(Clone, Debug)]
pub(in crate::internal::mobility) struct Reduced {
    pub(in crate::internal::mobility) rows: Vec<Vec<Rational>>,
    /// The column of the leading one of every row that is not zero.
    pub(in crate::internal::mobility) pivots: Vec<usize>,
}

impl Reduced {
    /// Reduces by the first so many columns.
    pub(in crate::internal::mobility) fn of(matrix: &[Vec<Rational>], columns: usize) -> Self {
        let mut rows = matrix.to_vec();
        let mut pivots = Vec::new();
        for column in 0..columns {
            let row = pivots.len();
            let Some(found) = (row..rows.len()).find(|k| rows[*k][column] != 0) else { continue };
            rows.swap(row, found);
            let inverse = Rational::from(rows[row][column].recip_ref());
            for x in &mut rows[row] {
                *x *= &inverse;
            }
            let pivot = rows[row].clone();
            for (k, other) in rows.iter_mut().enumerate() {
                if k == row || other[column] == 0 {
                    continue;
                }
                let factor = other[column].clone();
                for (x, y) in other.iter_mut().zip(&pivot) {
                    *x -= Rational::from(&factor * y);
                }
            }
            pivots.push(column);
        }
        Self { rows, pivots }
    }
}

/// The equations with what solves them for the pivots.
struct Solver<'a> {
    system: &'a System,
    /// Combinations of the equations: the first ones give the pivots, the others are reduced equations.
    combinations: Vec<Vec<Rational>>,
    pivots: Vec<usize>,
    /// The variables that are no pivots, each with its first-order motion.
    motions: Vec<Vec<Rational>>,
    /// Products of words that may still be taken.
    products: Cell<u64>,
}

impl<'a> Solver<'a> {
    fn new(system: &'a System) -> Self {
        let jacobian = system.jacobian();
        let (size, columns) = (jacobian.len(), system.variables());
        let unit = |k: usize| (0..size).map(move |j| Rational::from(u8::from(j == k)));
        let beside: Vec<Vec<Rational>> =
            jacobian.iter().enumerate().map(|(k, row)| row.iter().cloned().chain(unit(k)).collect()).collect();
        let reduced = Reduced::of(&beside, columns);
        let motion = |free: usize| {
            let mut motion = vec![Rational::new(); columns];
            motion[free] = Rational::from(1);
            for (row, pivot) in reduced.rows.iter().zip(&reduced.pivots) {
                motion[*pivot] = Rational::from(-&row[free]);
            }
            motion
        };
        let free = (0..columns).filter(|column| !reduced.pivots.contains(column));
        let motions = free.map(motion).collect();
        let combinations = reduced.rows.iter().map(|row| row[columns..].to_vec()).collect();
        Self { system, combinations, pivots: reduced.pivots, motions, products: Cell::new(PRODUCTS) }
    }

    /// Returns the values of all combinations.
    fn combined(&self, values: &[Rational]) -> Vec<Rational> {
        let dot = |row: &Vec<Rational>| {
            row.iter()
                .zip(values)
                .fold(Rational::new(), |sum, (a, b)| if *a == 0 || *b == 0 { sum } else { sum + Rational::from(a * b) })
        };
        self.combinations.iter().map(dot).collect()
    }

    /// Follows a first-order motion: why it ends before the last order, if it does.
    fn follow(&self, motion: &[Rational], last: usize) -> Option<Stop> {
        self.series(motion, last).err()
    }

    /// Counts the products of words of an order: one of every coefficient of every variable, of the length of the longest new one; false
    /// where they are too many.
    fn may_take(&self, order: usize, values: &[Vec<Rational>]) -> bool {
        let bits = |q: &Rational| q.numer().significant_bits() + q.denom().significant_bits();
        let longest = values.iter().filter_map(|series| series.last()).map(bits).max().unwrap_or(0);
        let words = u64::from(longest / 64 + 1);
        let terms = (order as u64).saturating_mul(values.len() as u64);
        let left = self.products.get().checked_sub(terms.saturating_mul(words.saturating_mul(words)));
        self.products.set(left.unwrap_or(0));
        left.is_some()
    }

    /// Returns the coefficients of all variables along a first-order motion from order 0 to the last one, or why it ends before that.
    fn series(&self, motion: &[Rational], last: usize) -> Result<Vec<Vec<Rational>>, Stop> {
        let (system, turns) = (self.system, self.system.turns);
        // Of every variable its coefficients from order 1, and of every rotation those from order 0.
        let mut values: Vec<Vec<Rational>> = motion.iter().map(|v| vec![Rational::new(), v.clone()]).collect();
        let first = |v: &Rational| vec![unit(), times(&turned(&unit()), &(Rational::from(2) * v))];
        let mut rotations: Vec<Vec<Gaussian>> = motion[..turns].iter().map(first).collect();
        for order in 2..=last {
            if !self.may_take(order, &values) {
                return Err(Stop::TooLong(order));
            }
            // (1 - i y) R = 1 + i y: the coefficient of R without that of y.
            let known: Vec<Gaussian> = (0..turns)
                .map(|j| {
                    let sum = (1..order).fold(zero(), |sum, m| {
                        if values[j][m] == 0 { sum } else { sum.add(&times(&rotations[j][order - m], &values[j][m])) }
                    });
                    turned(&sum)
                })
                .collect();
            let mut rest = Vec::with_capacity(2 * system.loops());
            for cycle in &system.cycles {
                let mut sum = zero();
                for (variable, a) in &cycle.turning {
                    sum = sum.add(&a.mul(&known[*variable]));
                }
                for Slid { slide, class, coefficient } in &cycle.sliding {
                    // A slide of the class at rest is linear.
                    let Some(class) = class else { continue };
                    let shifts = &values[turns + slide];
                    let products = (1..order).fold(times(&known[*class], &system.slides[*slide]), |sum, m| {
                        if shifts[order - m] == 0 {
                            sum
                        } else {
                            sum.add(&times(&rotations[*class][m], &shifts[order - m]))
                        }
                    });
                    sum = sum.add(&coefficient.mul(&products));
                }
                rest.extend([sum.re, sum.im]);
            }
            let combined = self.combined(&rest);
            let rank = self.pivots.len();
            if combined[rank..].iter().any(|c| *c != 0) {
                return Err(Stop::Fails(order, combined[rank..].to_vec()));
            }
            for series in &mut values {
                series.push(Rational::new());
            }
            for (pivot, value) in self.pivots.iter().zip(combined) {
                values[*pivot][order] = -value;
            }
            for (j, known) in known.into_iter().enumerate() {
                let own = times(&turned(&unit()), &(Rational::from(2) * &values[j][order]));
                rotations[j].push(known.add(&own));
            }
        }
        Ok(values)
    }

    /// Returns the second-order parts of the reduced equations on all first-order motions, as symmetric matrices; `None` for numbers that
    /// are too long.
    fn second_order(&self) -> Option<Vec<Vec<Vec<Rational>>>> {
        let (count, forms) = (self.motions.len(), self.combinations.len() - self.pivots.len());
        let value = |motion: &[Rational]| match self.follow(motion, 2) {
            Some(Stop::Fails(_, values)) => Some(values),
            Some(Stop::TooLong(_)) => None,
            None => Some(vec![Rational::new(); forms]),
        };
        let singles: Vec<Vec<Rational>> = self.motions.iter().map(|motion| value(motion)).collect::<Option<_>>()?;
        let mut matrices = vec![vec![vec![Rational::new(); count]; count]; forms];
        for a in 0..count {
            for b in 0..=a {
                let sum: Vec<Rational> =
                    self.motions[a].iter().zip(&self.motions[b]).map(|(x, y)| Rational::from(x + y)).collect();
                let both = if a == b { singles[a].clone() } else { value(&sum)? };
                for (k, matrix) in matrices.iter_mut().enumerate() {
                    // q(u + v) = q(u) + 2 b(u, v) + q(v)
                    let entry = if a == b {
                        both[k].clone()
                    } else {
                        (Rational::from(&both[k] - &singles[a][k]) - &singles[b][k]) / Rational::from(2)
                    };
                    matrix[a][b] = entry.clone();
                    matrix[b][a] = entry;
                }
            }
        }
        Some(matrices)
    }
}

fn unit() -> Gaussian {
    Gaussian { re: Rational::from(1), im: Rational::new() }
}

/// Counts the squares with positive and with negative sign of a quadratic form.
fn signature(mut matrix: Vec<Vec<Rational>>) -> [usize; 2] {
    let size = matrix.len();
    let mut signs = [0, 0];
    let mut open: Vec<usize> = (0..size).collect();
    while !open.is_empty() {
        let pivot = if let Some(pivot) = open.iter().copied().find(|k| matrix[*k][*k] != 0) {
            pivot
        } else {
            let pair = open.iter().flat_map(|a| open.iter().map(move |b| (*a, *b))).find(|(a, b)| matrix[*a][*b] != 0);
            let Some((a, b)) = pair else { return signs };
            // With a replaced by a + b the diagonal is 2 q_ab.
            for k in 0..size {
                let own = matrix[b][k].clone();
                matrix[a][k] += own;
            }
            for row in &mut matrix {
                let own = row[b].clone();
                row[a] += own;
            }
            a
        };
        signs[usize::from(matrix[pivot][pivot] < 0)] += 1;
        open.retain(|k| *k != pivot);
        let (row, diagonal) = (matrix[pivot].clone(), matrix[pivot][pivot].clone());
        for a in &open {
            for b in &open {
                let part = Rational::from(&row[*a] * &row[*b]) / &diagonal;
                matrix[*a][*b] -= part;
            }
        }
    }
    signs
}

/// Returns `C(n, k)`, or the largest number.
fn binomial(n: usize, k: usize) -> usize {
    (0..k).try_fold(1_usize, |product, i| Some(product.checked_mul(n - i)? / (i + 1))).unwrap_or(usize::MAX)
}

impl System {
    /// Returns the largest multiplicity that an isolated solution can have, of as many of the equations as there are variables, so many
    /// of them sections.
    fn bound(&self, sections: usize) -> usize {
        let doubled =
            |bound: usize| (0..sections).try_fold(bound, |bound, _| bound.checked_mul(2)).unwrap_or(usize::MAX);
        if self.slides.is_empty() {
            return doubled(binomial(self.turns, self.turns / 2));
        }
        let moving = self.cycles.iter().filter(|cycle| cycle.sliding.iter().any(|own| own.class.is_some())).count();
        let twos = self.turns + (2 * moving).min(self.variables());
        doubled(
            1_usize.checked_shl(u32::try_from(twos).unwrap_or(u32::MAX)).filter(|_| twos < 60).unwrap_or(usize::MAX),
        )
    }

    /// Returns motions as series of all variables up to an order, one for every first-order motion of a basis.
    pub(super) fn motions(&self, last: usize) -> Vec<Vec<Vec<Rational>>> {
        let solver = Solver::new(self);
        solver.motions.iter().filter_map(|motion| solver.series(motion, last).ok()).collect()
    }

    /// Decides what the assemblies near this one are.
    pub(super) fn local(&self) -> Found {
        let solver = Solver::new(self);
        let (rank, variables) = (solver.pivots.len(), self.variables());
        let found = |what: Local, lines: usize| Found { rank, what, lines };
        if rank == variables || rank == 2 * self.loops() || !self.is_closed() {
            return found(Local::Regular, 0);
        }
        let dimension = variables - rank;
        let bound = self.bound(dimension - 1);
        if dimension == 1 {
            let last = bound.saturating_add(1).min(MOST);
            return found(
                match solver.follow(&solver.motions[0], last) {
                    Some(Stop::Fails(order, _)) => Local::Isolated { order },
                    Some(Stop::TooLong(order)) => Local::Undecided { order },
                    None if last > bound => Local::Moves { order: last, bound },
                    None => Local::Undecided { order: last },
                },
                1,
            );
        }
        let Some(forms) = solver.second_order() else { return found(Local::Undecided { order: 2 }, 0) };
        let signatures: Vec<[usize; 2]> = forms.iter().map(|form| signature(form.clone())).collect();
        if signatures.iter().any(|signs| signs.contains(&dimension)) {
            return found(Local::Definite, 0);
        }
        if let [[plus, minus]] = signatures[..]
            && plus + minus == dimension
        {
            return found(Local::Crossing, 0);
        }
        if signatures.iter().any(|[plus, minus]| plus + minus > 0) {
            return found(Local::Undecided { order: 2 }, 0);
        }
        // An equation that does not vanish on the manifold of the others has a lowest form of a degree of at most the bound; it
        // vanishes on no more lines of a plane than that.
        let last = bound.saturating_add(1);
        let lines = (1..dimension).try_fold(1_usize, |lines, _| lines.checked_mul(last)).unwrap_or(usize::MAX);
        let effort = last.saturating_mul(last).saturating_mul(lines).saturating_mul(variables);
        if last > MOST || effort > EFFORT {
            return found(Local::Undecided { order: 2 }, 0);
        }
        for line in 0..lines {
            let mut number = line;
            let mut motion = solver.motions[0].clone();
            for other in &solver.motions[1..] {
                let factor = Rational::from(number % last);
                number /= last;
                for (x, y) in motion.iter_mut().zip(other) {
                    *x += Rational::from(&factor * y);
                }
            }
            if let Some(Stop::Fails(order, _) | Stop::TooLong(order)) = solver.follow(&motion, last) {
                return found(Local::Undecided { order }, line + 1);
            }
        }
        found(Local::Moves { order: last, bound }, lines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(rows: &[&[i32]]) -> Vec<Vec<Rational>> {
        rows.iter().map(|row| row.iter().map(|x| Rational::from(*x)).collect()).collect()
    }

    #[test]
    fn signatures_of_forms() {
        assert_eq!(signature(form(&[&[0, 1], &[1, 0]])), [1, 1]);
        assert_eq!(signature(form(&[&[2, 1], &[1, 2]])), [2, 0]);
        assert_eq!(signature(form(&[&[1, 1], &[1, 1]])), [1, 0]);
        assert_eq!(signature(form(&[&[0, 0], &[0, 0]])), [0, 0]);
        assert_eq!(signature(form(&[&[-1, 2, 0], &[2, -1, 0], &[0, 0, 5]])), [2, 1]);
    }

    #[test]
    fn binomials() {
        assert_eq!(binomial(4, 2), 6);
        assert_eq!(binomial(0, 0), 1);
        assert_eq!(binomial(300, 150), usize::MAX);
    }
}
