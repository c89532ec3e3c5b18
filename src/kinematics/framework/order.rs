//! The order to which a framework moves: its realisations as power series about an exact one.

use super::Framework;
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Field;
use crate::kinematics::motion::{Vector, dot};

/// The order to which a first-order motion can be continued.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The lengths cannot be kept in this order: the realisation is isolated, a solution of this multiplicity at least.
    Stops(usize),
    /// All lengths are kept through this order.
    Reaches(usize),
}

/// Continues the only first-order motion of a framework; `None` if it has none or several.
///
/// Six coordinates are held and one is the parameter tau. The bars of a regular minor of the rigidity matrix determine its
/// coordinates as power series in tau, and the remaining bars are checked order by order.
pub fn order<F: Field>(framework: &Framework<F>, most: usize) -> Option<Order> {
    let columns = framework.coordinates();
    let matrix = framework.rigidity_matrix();
    let echelon = Echelon::of(matrix.clone(), columns);
    let free = echelon.free_columns();
    let rigid = framework.rigid_motions();
    let restricted = |skip: usize| -> usize {
        let kept: Vec<usize> = free.iter().copied().filter(|&column| column != skip).collect();
        let rows = rigid.iter().map(|motion| kept.iter().map(|&column| motion[column].clone()).collect()).collect();
        Echelon::of(rows, kept.len()).rank()
    };
    if free.len() != 7 {
        return None;
    }
    // The held coordinates must forbid exactly the rigid motions.
    let parameter = free.iter().copied().find(|&column| restricted(column) == 6)?;
    let (rows, pivots) = (echelon.independent_rows(), echelon.pivots());
    let inverse =
        inverse(&rows.iter().map(|&row| pivots.iter().map(|&c| matrix[row][c].clone()).collect()).collect::<Vec<_>>())?;
    let half = F::from_integer(2).inverse()?;
    let differences: Vec<Vec<F>> = framework.bars.iter().map(|bar| framework.difference(*bar)).collect();
    // Coefficients of the ends' differences, by bar and order.
    let mut series: Vec<Vec<Vector<F>>> = framework.bars.iter().map(|bar| vec![framework.between(*bar)]).collect();
    for order in 1..=most {
        let mut state = vec![F::zero(); columns];
        if order == 1 {
            state[parameter] = F::one();
        }
        let known = |bar: usize, state: &[F]| -> F {
            let mut sum = dot(&series[bar][0], &combined(&differences[bar], state)).mul(&F::from_integer(2));
            for j in 1..order {
                sum = sum.add(&dot(&series[bar][j], &series[bar][order - j]));
            }
            sum
        };
        let right: Vec<F> = rows.iter().map(|&row| known(row, &state).mul(&half).neg()).collect();
        for (line, &column) in inverse.iter().zip(pivots) {
            state[column] = line.iter().zip(&right).fold(F::zero(), |sum, (a, b)| sum.add(&a.mul(b)));
        }
        for bar in 0..framework.bars.len() {
            if !rows.contains(&bar) && !known(bar, &state).is_zero() {
                return Some(Order::Stops(order));
            }
        }
        for (bar, series) in series.iter_mut().enumerate() {
            series.push(combined(&differences[bar], &state));
        }
    }
    Some(Order::Reaches(most))
}

fn combined<F: Field>(weights: &[F], state: &[F]) -> Vector<F> {
    std::array::from_fn(|axis| {
        weights
            .iter()
            .enumerate()
            .filter(|(_, w)| !w.is_zero())
            .fold(F::zero(), |sum, (k, w)| sum.add(&w.mul(&state[3 * k + axis])))
    })
}

/// The inverse of a regular square matrix.
fn inverse<F: Field>(matrix: &[Vec<F>]) -> Option<Vec<Vec<F>>> {
    let size = matrix.len();
    let unit = |i: usize, j: usize| if i == j { F::one() } else { F::zero() };
    let rows: Vec<Vec<F>> = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| row.iter().cloned().chain((0..size).map(|j| unit(i, j))).collect())
        .collect();
    let echelon = Echelon::of(rows, 2 * size);
    let mut inverse = vec![Vec::new(); size];
    for (row, &pivot) in echelon.rows().iter().zip(echelon.pivots()) {
        *inverse.get_mut(pivot)? = row[size..].to_vec();
    }
    inverse.iter().all(|row| row.len() == size).then_some(inverse)
}
