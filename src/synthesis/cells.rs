//! Unknown directions and points: a direction is a point of a projective space, which is taken apart into affine cells.

use crate::algebra::ring::Ring;

/// The shape of the unknowns: vectors up to scale, and numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// Sizes of the vectors up to scale.
    pub directions: Vec<usize>,
    /// The number of other unknowns.
    pub numbers: usize,
}

/// Coefficients of the linear forms that are 1 in the main cells. A form that is 0 for a solution is no use: then the next one
/// is tried. They are small, so that the numbers of the equations stay small, and no two are proportional.
const FORMS: [[i32; 2]; 6] = [[2, 3], [-3, 5], [7, -4], [-5, -11], [13, 17], [29, -23]];

/// The number of choices of linear forms.
pub(super) const CHOICES: usize = FORMS.len();

/// One affine cell of a projective space: with `x0 + c1 x1 + c2 x2 = y0` and `yk = xk`, the vectors whose first `number` of the
/// y are 0 and whose next one is 1.
#[derive(Clone, Debug)]
struct Cell {
    size: usize,
    number: usize,
    form: [i32; 2],
}

impl Cell {
    fn unknowns(&self) -> usize {
        self.size - 1 - self.number
    }

    fn vector<R: Ring>(&self, unknowns: &[R]) -> Vec<R> {
        let mut x: Vec<R> = vec![R::zero(); self.number];
        x.push(R::one());
        x.extend(unknowns.iter().cloned());
        for (k, c) in self.form.iter().enumerate().take(self.size - 1) {
            x[0] = x[0].sub(&x[k + 1].mul(&R::from_integer(*c)));
        }
        x
    }
}

/// One cell for each direction, and the numbers.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    cells: Vec<Cell>,
    numbers: usize,
}

/// The unknowns, in terms of the coordinates of a chart.
#[derive(Clone, Debug)]
pub(super) struct Place<R> {
    /// The vectors up to scale.
    pub directions: Vec<Vec<R>>,
    /// The other unknowns.
    pub numbers: Vec<R>,
}

impl Chart {
    /// All charts by one choice of linear forms, the main one first: each solution lies in exactly one.
    pub fn all(shape: &Shape, choice: usize) -> Vec<Self> {
        let mut charts = vec![Self { cells: Vec::new(), numbers: shape.numbers }];
        for (k, size) in shape.directions.iter().enumerate() {
            // Directions of one problem need different forms: else symmetric data may vanish on all of them.
            let form = FORMS[(choice + k) % CHOICES];
            let with = |chart: &Self, number: usize| {
                let mut cells = chart.cells.clone();
                cells.push(Cell { size: *size, number, form });
                Self { cells, numbers: chart.numbers }
            };
            charts = (0..*size).flat_map(|number| charts.iter().map(move |chart| with(chart, number))).collect();
        }
        charts
    }

    /// The number of coordinates.
    pub fn unknowns(&self) -> usize {
        self.cells.iter().map(Cell::unknowns).sum::<usize>() + self.numbers
    }

    /// The unknowns of these coordinates.
    pub fn place<R: Ring>(&self, coordinates: &[R]) -> Place<R> {
        let (mut rest, mut directions) = (coordinates, Vec::new());
        for cell in &self.cells {
            let (own, others) = rest.split_at(cell.unknowns().min(rest.len()));
            directions.push(cell.vector(own));
            rest = others;
        }
        Place { directions, numbers: rest.to_vec() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn each_direction_lies_in_one_cell() {
        let shape = Shape { directions: vec![3, 2], numbers: 1 };
        let charts = Chart::all(&shape, 1);
        assert_eq!(charts.iter().map(Chart::unknowns).collect::<Vec<_>>(), [4, 3, 2, 3, 2, 1]);
        let numbers: Vec<Rational> = (5..9).map(Rational::from).collect();
        let place = charts[0].place(&numbers);
        // The forms -3, 5 and 7: 1 = x0 - 3 x1 + 5 x2 and 1 = x0 + 7 x1.
        let [x, y] = place.directions.as_slice() else { panic!("two directions") };
        let values = |c: &[i32], v: &[Rational]| c.iter().zip(v).map(|(c, x)| Rational::from(x * c)).sum::<Rational>();
        assert_eq!((values(&[1, -3, 5], x), values(&[1, 7], y)), (Rational::from(1), Rational::from(1)));
        assert_eq!(place.numbers, [8]);
    }
}
