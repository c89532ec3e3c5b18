//! The exact multiplicity of a solution of quadratic equations.
//!
//! The functionals on polynomials that vanish on the ideal of the equations, and on a power of the maximal ideal of the
//! point, form a space whose dimension is the multiplicity of the point, if it is isolated. The space is closed under
//! `(h_i F)(f) = F(h_i f)`, with h the coordinates about the point. It is computed step by step from the evaluation at the
//! point alone, each functional given by its value at 1 and by the h_i F. Equations of degree 2 depend on no more of a
//! functional than that. \[Mourrain1997\]

use super::ring::Field;

/// A quadratic equation about a point that fulfils it: `linear.h + h^T form h`, the form symmetric.
#[derive(Clone, Debug)]
pub struct Quadric<F> {
    /// The coefficients of the coordinates.
    pub linear: Vec<F>,
    /// The quadratic form.
    pub form: Vec<Vec<F>>,
}

/// Returns the exact multiplicity of the point at which the equations are given; `None` if it exceeds `most` (as it does if
/// the point is not isolated), or if an inverse is missing.
///
/// # Example
/// ```
/// use looproot_algebra::local_multiplicity::{Quadric, multiplicity};
/// use rug::Rational;
///
/// let number = |n: i32| Rational::from(n);
/// // x^2 - y = 0 and y = 0 touch: multiplicity 2.
/// let parabola = Quadric {
///     linear: vec![number(0), number(-1)],
///     form: vec![vec![number(1), number(0)], vec![number(0), number(0)]],
/// };
/// let line = Quadric { linear: vec![number(0), number(1)], form: vec![vec![number(0); 2]; 2] };
/// assert_eq!(multiplicity(&[parabola.clone(), line], 10), Some(2));
/// // The parabola alone has no isolated point.
/// assert_eq!(multiplicity(&[parabola], 10), None);
/// ```
#[must_use]
pub fn multiplicity<F: Field>(equations: &[Quadric<F>], most: usize) -> Option<usize> {
    let unknowns = equations.first()?.linear.len();
    let mut space = Functionals { unknowns, shifts: vec![vec![vec![F::zero()]]; unknowns] };
    loop {
        let before = space.dimension();
        space.extend(equations)?;
        if space.dimension() == before {
            return Some(before);
        }
        if space.dimension() > most {
            return None;
        }
    }
}

/// Functionals, the first one the evaluation at the point, the others of value 0 at 1.
struct Functionals<F> {
    unknowns: usize,
    /// Row k of matrix i: `h_i F_k` in terms of the functionals.
    shifts: Vec<Vec<Vec<F>>>,
}

impl<F: Field> Functionals<F> {
    fn dimension(&self) -> usize {
        self.shifts.first().map_or(1, Vec::len)
    }

    /// Adds the functionals whose `h_i F` are all among the known ones.
    fn extend(&mut self, equations: &[Quadric<F>]) -> Option<()> {
        let (n, d) = (self.unknowns, self.dimension());
        let mut known = Echelon::new(n * d);
        for k in 1..d {
            let row = (0..n).flat_map(|i| self.shifts[i][k].iter().cloned()).collect();
            known.insert(row)?;
        }
        let mut conditions = Echelon::new(n * d);
        for equation in equations {
            conditions.insert(self.vanishing(equation))?;
        }
        for i in 1..n {
            for j in 0..i {
                for row in self.commuting(i, j) {
                    conditions.insert(row)?;
                }
            }
        }
        let mut fresh = Vec::new();
        for solution in conditions.kernel() {
            if known.insert(solution.clone())? {
                fresh.push(solution);
            }
        }
        for matrix in &mut self.shifts {
            for row in matrix.iter_mut() {
                row.extend((0..fresh.len()).map(|_| F::zero()));
            }
        }
        for solution in &fresh {
            for (i, matrix) in self.shifts.iter_mut().enumerate() {
                let mut row = solution[i * d..(i + 1) * d].to_vec();
                row.extend((0..fresh.len()).map(|_| F::zero()));
                matrix.push(row);
            }
        }
        Some(())
    }

    /// Returns the equation `F(equation) = 0` in the coefficients of the `h_i F`.
    fn vanishing(&self, equation: &Quadric<F>) -> Vec<F> {
        let (n, d) = (self.unknowns, self.dimension());
        let mut row = vec![F::zero(); n * d];
        for i in 0..n {
            row[i * d] = row[i * d].add(&equation.linear[i]);
            for k in 0..d {
                for j in 0..n {
                    row[i * d + k].add_product(&equation.form[i][j], &self.shifts[j][k][0]);
                }
            }
        }
        row
    }

    /// Returns the equations `h_j (h_i F) = h_i (h_j F)`.
    fn commuting(&self, i: usize, j: usize) -> Vec<Vec<F>> {
        let (n, d) = (self.unknowns, self.dimension());
        let condition = |l: usize| {
            let mut row = vec![F::zero(); n * d];
            for k in 0..d {
                row[i * d + k] = self.shifts[j][k][l].clone();
                row[j * d + k] = self.shifts[i][k][l].neg();
            }
            row
        };
        (0..d).map(condition).collect()
    }
}

/// Rows in echelon form, taken in one by one.
struct Echelon<F> {
    width: usize,
    rows: Vec<(usize, Vec<F>)>,
}

impl<F: Field> Echelon<F> {
    fn new(width: usize) -> Self {
        Self { width, rows: Vec::new() }
    }

    /// Adds a row. Returns whether it was independent; `None` if an inverse is missing.
    fn insert(&mut self, mut row: Vec<F>) -> Option<bool> {
        for (column, pivot_row) in &self.rows {
            subtract(&mut row, *column, pivot_row);
        }
        let Some(column) = row.iter().position(|x| !x.is_zero()) else { return Some(false) };
        let inverse = row[column].inverse()?;
        for x in &mut row[column..] {
            if !x.is_zero() {
                *x = x.mul(&inverse);
            }
        }
        for (_, other) in &mut self.rows {
            subtract(other, column, &row);
        }
        self.rows.push((column, row));
        Some(true)
    }

    /// Returns a basis of the vectors that all rows annihilate.
    fn kernel(&self) -> Vec<Vec<F>> {
        let is_pivot = |column: usize| self.rows.iter().any(|(pivot, _)| *pivot == column);
        let vector = |free: usize| {
            let mut vector = vec![F::zero(); self.width];
            vector[free] = F::one();
            for (column, row) in &self.rows {
                vector[*column] = row[free].neg();
            }
            vector
        };
        (0..self.width).filter(|&column| !is_pivot(column)).map(vector).collect()
    }
}

/// Clears a column of a row.
fn subtract<F: Field>(row: &mut [F], column: usize, pivot_row: &[F]) {
    if row[column].is_zero() {
        return;
    }
    let factor = row[column].neg();
    for (x, y) in row.iter_mut().zip(pivot_row) {
        if !y.is_zero() {
            x.add_product(&factor, y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    fn quadric(linear: &[i32], form: &[&[i32]]) -> Quadric<Rational> {
        let numbers = |row: &[i32]| row.iter().map(|&n| Rational::from(n)).collect::<Vec<_>>();
        Quadric { linear: numbers(linear), form: form.iter().map(|row| numbers(row)).collect() }
    }

    #[test]
    fn three_squares_count_eight() {
        let square = |k: usize| {
            let mut form = [[0; 3]; 3];
            form[k][k] = 1;
            quadric(&[0; 3], &[&form[0], &form[1], &form[2]])
        };
        assert_eq!(multiplicity(&[square(0), square(1), square(2)], 40), Some(8));
        assert_eq!(multiplicity(&[square(0), square(1), square(2)], 7), None);
    }

    #[test]
    fn a_long_contact_of_curves_counts_by_its_order() {
        // y = x^2, z = x y, and x z = 0: x^4 = 0.
        let one = quadric(&[0, -1, 0], &[&[1, 0, 0], &[0, 0, 0], &[0, 0, 0]]);
        let two = quadric(&[0, 0, -2], &[&[0, 1, 0], &[1, 0, 0], &[0, 0, 0]]);
        let three = quadric(&[0, 0, 0], &[&[0, 0, 1], &[0, 0, 0], &[1, 0, 0]]);
        assert_eq!(multiplicity(&[one, two, three], 40), Some(4));
    }

    #[test]
    fn a_regular_point_counts_once() {
        assert_eq!(multiplicity(&[quadric(&[1], &[&[5]])], 3), Some(1));
    }
}
