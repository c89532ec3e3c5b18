//! Interpolation of vectors that are known up to a factor at every point, as the values of a primitive polynomial at values of a
//! parameter.
//!
//! Let the vector `F(y)` have entries of degree `D`, and let `v_j = F(y_j) / s_j` be known at `N = D + 1 + k` points, with
//! unknown factors `s_j`. Divided differences of order `N - 1` of `y^e F` vanish for `e < k`, so that
//! `sum_j w_j y_j^e v_j s_j = 0` with `w_j = 1 / prod_(i != j) (y_j - y_i)`. These are linear equations for the factors, as many
//! for every `e` as the vector has entries.

use super::echelon::Echelon;
use super::ring::Field;
use super::univariate::Univariate;

/// The number of redundant equations that must hold as well; modulo a prime they do so by chance with a probability below
/// `2^-400`.
pub const SPARE: usize = 8;

/// The degree of vectors known up to a factor, and the equations that determine the factors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The degree D of the entries.
    pub degree: usize,
    /// Exponents e and entries of the vectors whose equations determine the factors.
    equations: Vec<(usize, usize)>,
}

impl Shape {
    /// Returns the least number of points that determines vectors of `entries` entries of this degree; vectors of one entry are all
    /// equal up to a factor.
    ///
    /// # Panics
    /// If there is only one entry.
    #[must_use]
    pub fn points(degree: usize, entries: usize) -> usize {
        // k powers with `k entries >= N + SPARE`, N = degree + 1 + k.
        degree + 1 + (degree + 1 + SPARE).div_ceil(entries - 1)
    }

    /// Returns the shape of the vectors at these points; `None` if the points are too few for it.
    ///
    /// # Panics
    /// If the vectors are of different lengths, or have only one entry.
    #[must_use]
    pub fn of<F: Field>(points: &[F], vectors: &[Vec<F>]) -> Option<Self> {
        let entries = vectors.first()?.len();
        let most = (0..points.len()).rev().find(|&degree| Self::points(degree, entries) <= points.len())?;
        let moments = moments(points)?;
        let echelon = |degree: usize| {
            let powers = points.len() - 1 - degree;
            let equations: Vec<(usize, usize)> = (0..powers).flat_map(|e| (0..entries).map(move |m| (e, m))).collect();
            let rows = equations.iter().map(|&(e, m)| equation(&moments, vectors, e, m)).collect();
            (Echelon::of(rows, points.len()), equations)
        };
        let (found, _) = echelon(most);
        // A factor of degree more fits as well: one more free factor for every degree too many. Where the vectors span few dimensions
        // more factors are free, and the degree is above this.
        let free = points.len() - found.rank();
        let least = most.saturating_sub(free.checked_sub(1)?);
        let mut shapes = (least..=most).map(|degree| (degree, echelon(degree)));
        let (degree, (found, equations)) = shapes.find(|(_, (found, _))| found.rank() < points.len())?;
        let independent = found.independent_rows().iter().map(|&row| equations[row]).collect();
        // For every power there are as many equations as the vectors have dimensions: of r + 1 vectors in r dimensions any are
        // related by one equation. Vectors in one dimension show by themselves that they are all one.
        let span = Echelon::of(vectors.to_vec(), entries).rank();
        if span > 1 && (points.len() - 1 - degree) * span < points.len() + SPARE {
            return None;
        }
        (found.rank() + 1 == points.len()).then_some(Self { degree, equations: independent })
    }

    /// Returns the entries as polynomials, up to a common factor; `None` if the vectors are not of this shape.
    ///
    /// # Panics
    /// If the vectors are of different lengths.
    #[must_use]
    pub fn interpolate<F: Field>(&self, points: &[F], vectors: &[Vec<F>]) -> Option<Vec<Univariate<F>>> {
        let moments = moments(points)?;
        let rows = self.equations.iter().map(|&(e, m)| equation(&moments, vectors, e, m)).collect();
        let echelon = Echelon::of(rows, points.len());
        let null_space = echelon.null_space();
        let [factors] = null_space.as_slice() else { return None };
        if factors.iter().any(F::is_zero) {
            return None;
        }
        let (first, rest) = (self.degree + 1, self.degree + 1..points.len());
        let entries = vectors.first()?.len();
        let polynomial = |m: usize| {
            let value = |j: usize| (points[j].clone(), vectors[j][m].mul(&factors[j]));
            let polynomial = Univariate::interpolate(&(0..first).map(value).collect::<Vec<_>>());
            let holds = rest.clone().all(|j| value(j).1.sub(&polynomial.eval(&points[j])).is_zero());
            holds.then_some(polynomial)
        };
        (0..entries).map(polynomial).collect()
    }
}

/// Returns the points with `w_j y_j^e` for e = 0, 1, ... as computed on demand; here `w_j` and `y_j`.
fn moments<F: Field>(points: &[F]) -> Option<Vec<(F, F)>> {
    let weight = |j: usize| {
        let others = points.iter().enumerate().filter(|(i, _)| *i != j);
        others.fold(F::one(), |product, (_, y)| product.mul(&points[j].sub(y))).inverse()
    };
    (0..points.len()).map(|j| Some((weight(j)?, points[j].clone()))).collect()
}

/// Returns `w_j y_j^e v_j[m]` for every point j.
fn equation<F: Field>(moments: &[(F, F)], vectors: &[Vec<F>], e: usize, m: usize) -> Vec<F> {
    let power = |y: &F| (0..e).fold(F::one(), |power, _| power.mul(y));
    moments.iter().zip(vectors).map(|((w, y), v)| w.mul(&power(y)).mul(&v[m])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    fn rationals(numbers: &[i64]) -> Vec<Rational> {
        numbers.iter().map(|&n| Rational::from(n)).collect()
    }

    /// Returns `(1 + y^2, 3 y, y^2 - 4, 7)` up to a factor that differs from point to point.
    fn sample(count: i64) -> (Vec<Rational>, Vec<Vec<Rational>>) {
        let points: Vec<i64> = (2..2 + count).collect();
        let vector = |y: &i64| {
            let factor = Rational::from((y * y + 5, 3 * y - 1));
            rationals(&[1 + y * y, 3 * y, y * y - 4, 7]).into_iter().map(|x| x * &factor).collect()
        };
        (rationals(&points), points.iter().map(vector).collect())
    }

    #[test]
    fn vectors_up_to_a_factor_are_interpolated() {
        let (points, vectors) = sample(9);
        let shape = Shape::of(&points, &vectors).unwrap();
        assert_eq!(shape.degree, 2);
        let entries = shape.interpolate(&points, &vectors).unwrap();
        let scale = Rational::from(7) / entries[3].eval(&Rational::new());
        let scaled: Vec<_> = entries.iter().map(|p| p.scale(&scale).coefficients().to_vec()).collect();
        assert_eq!(scaled, [rationals(&[1, 0, 1]), rationals(&[0, 3]), rationals(&[-4, 0, 1]), rationals(&[7])]);
    }

    #[test]
    fn vectors_of_two_dimensions_need_more_points() {
        // (1 + y^4, y^4, 2, 3 y^4 - 1) up to a factor: six points would do for four dimensions.
        let vectors = |points: &[i64]| -> Vec<Vec<Rational>> {
            let vector = |y: &i64| {
                let (fourth, factor) = (y.pow(4), Rational::from((1, y * y + 3 * y)));
                rationals(&[1 + fourth, fourth, 2, 3 * fourth - 1]).into_iter().map(|x| x * &factor).collect()
            };
            points.iter().map(vector).collect()
        };
        let points: Vec<i64> = (2..9).collect();
        assert_eq!(Shape::of(&rationals(&points), &vectors(&points)), None);
        let points: Vec<i64> = (2..20).collect();
        let shape = Shape::of(&rationals(&points), &vectors(&points)).unwrap();
        assert_eq!(shape.degree, 4);
        let entries = shape.interpolate(&rationals(&points), &vectors(&points)).unwrap();
        assert_eq!(entries[0].degree(), Some(4));
    }

    #[test]
    fn even_entries_need_more_points() {
        // Combinations of 1, y^2 and y^4: the vectors at any four points are related by one equation.
        let vectors = |points: &[i64]| -> Vec<Vec<Rational>> {
            let vector = |y: &i64| {
                let (square, factor) = (y * y, Rational::from((1, y * y + 3 * y)));
                let entry =
                    |k: i64| Rational::from(k + 1 + (k * k - 5) * square + (7 - 2 * k) * square * square) * &factor;
                (0..12).map(entry).collect()
            };
            points.iter().map(vector).collect()
        };
        let points: Vec<i64> = (2..6).collect();
        assert_eq!(Shape::of(&rationals(&points), &vectors(&points)), None);
        let points: Vec<i64> = (2..14).collect();
        assert_eq!(Shape::of(&rationals(&points), &vectors(&points)).unwrap().degree, 4);
    }

    #[test]
    fn equal_vectors_have_degree_zero() {
        let points = rationals(&[2, 3, 4, 5, 6, 7, 8, 9]);
        let vectors: Vec<Vec<Rational>> =
            [1, -3, 4, 2, 7, -1, 5, 3].iter().map(|k| rationals(&[*k, 2 * k, -5 * k])).collect();
        assert_eq!(Shape::of(&points, &vectors).unwrap().degree, 0);
    }

    #[test]
    fn too_few_points_and_another_shape_are_noticed() {
        let (points, vectors) = sample(5);
        assert_eq!(Shape::of(&points, &vectors), None);
        let (points, mut vectors) = sample(9);
        let shape = Shape::of(&points, &vectors).unwrap();
        vectors[4][1] += 1;
        assert_eq!(shape.interpolate(&points, &vectors), None);
    }
}
