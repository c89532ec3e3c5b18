//! The curve of one equation between one unknown and the input, such as the curve of two spherical joints.
//!
//! `sum c_ij m_i(v) m_j(x) = 0` over the monomials (1, cos, sin) of an angle or (1, d, d^2) of a distance. It answers the same
//! questions as the curve of a whole loop, in the plane of v and x.

use super::curve::{INPUT, Point, onto};
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::kinematics::closed_loop::Variable;

/// The place of the unknown among the variables of a [`Point`]; those between it and the input are 0.
pub const UNKNOWN: usize = 0;

/// The curve of one equation between an unknown and the input.
#[derive(Clone, Debug)]
pub struct PlaneCurve {
    /// The kinds of the unknown and the input; the places between them are empty.
    variables: [Variable; 7],
    /// Row i belongs to monomial i of the unknown, column j to monomial j of the input; the largest is 1.
    coefficients: [[f64; 3]; 3],
    scale: f64,
}

/// The equation and its derivatives by the unknown and by the input.
struct Here {
    value: f64,
    slopes: [f64; 2],
}

fn monomials<const N: usize>(variable: Variable, value: &Series<f64, N>) -> [Series<f64, N>; 3] {
    match variable {
        Variable::Rotation => {
            let (sin, cos) = value.coefficients[0].sin_cos();
            let (cos, sin) = value.cos_sin_beyond(cos, sin).expect("every small number has an inverse in f64");
            [Series::one(), cos, sin]
        }
        Variable::Translation => [Series::one(), *value, value.mul(value)],
    }
}

/// The solution of two linear equations, and the largest entry of their inverse matrix; `None` for dependent ones.
fn solved([[a, b], [c, d]]: [[f64; 2]; 2], right: [f64; 2]) -> Option<([f64; 2], f64)> {
    /// Determinants below this part of the product of the rows are 0.
    const DEPENDENT: f64 = 1e-14;
    let determinant = a * d - b * c;
    let size = a.hypot(b) * c.hypot(d);
    if !(determinant.abs() > DEPENDENT * size) {
        return None;
    }
    let largest = [a, b, c, d].iter().map(|x| (x / determinant).abs()).fold(0.0, f64::max);
    let [p, q] = right;
    Some(([(d * p - b * q) / determinant, (a * q - c * p) / determinant], largest))
}

impl PlaneCurve {
    /// The curve with these coefficients; `scale` is the length that counts as 1.
    #[must_use]
    pub fn new(unknown: Variable, input: Variable, coefficients: &[[f64; 3]; 3], scale: f64) -> Self {
        let power = |variable: Variable, k: usize| match (variable, k) {
            (Variable::Rotation, _) | (_, 0) => 1.0,
            (Variable::Translation, 1) => scale,
            (Variable::Translation, _) => scale * scale,
        };
        let scaled: [[f64; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| coefficients[i][j] * power(unknown, i) * power(input, j)));
        let largest = scaled.iter().flatten().map(|x| x.abs()).fold(0.0, f64::max);
        let over = if largest > 0.0 { largest } else { 1.0 };
        let variables = std::array::from_fn(|k| match k {
            UNKNOWN => unknown,
            INPUT => input,
            _ => Variable::Rotation,
        });
        Self { variables, coefficients: scaled.map(|row| row.map(|x| x / over)), scale }
    }

    /// Returns the kinds of the unknown and the input, at their places.
    #[must_use]
    pub fn variables(&self) -> &[Variable; 7] {
        &self.variables
    }

    /// The unit of a variable inside the curve: 1 for angles, the scale for lengths.
    #[must_use]
    pub fn unit(&self, index: usize) -> f64 {
        if self.variables[index] == Variable::Rotation { 1.0 } else { self.scale }
    }

    /// The left side of the equation over series.
    fn value<const N: usize>(&self, unknown: &Series<f64, N>, input: &Series<f64, N>) -> Series<f64, N> {
        let [rows, columns] = [monomials(self.variables[UNKNOWN], unknown), monomials(self.variables[INPUT], input)];
        let mut sum = Series::zero();
        for (row, coefficients) in rows.iter().zip(&self.coefficients) {
            let mut inner = Series::zero();
            for (column, c) in columns.iter().zip(coefficients) {
                inner.add_product(column, &Series::constant(*c));
            }
            sum.add_product(row, &inner);
        }
        sum
    }

    fn here(&self, at: &Point) -> Here {
        let plain = |k: usize| Series { coefficients: [at[k], 0.0] };
        let moving = |k: usize| Series { coefficients: [at[k], 1.0] };
        let [value, by_unknown] = self.value(&moving(UNKNOWN), &plain(INPUT)).coefficients;
        let [_, by_input] = self.value(&plain(UNKNOWN), &moving(INPUT)).coefficients;
        Here { value, slopes: [by_unknown, by_input] }
    }

    /// As [`Curve::taylor`](super::curve::Curve::taylor).
    #[must_use]
    pub fn taylor<const N: usize>(&self, at: &Point, border: &Point) -> Option<[Point; N]> {
        let matrix = [self.here(at).slopes, [border[UNKNOWN], border[INPUT]]];
        let (mut unknown, mut input) = (Series::<f64, N>::constant(at[UNKNOWN]), Series::constant(at[INPUT]));
        for order in 1..N {
            // While this order is 0, the value contains the contributions of the lower ones.
            let value = self.value(&unknown, &input).coefficients[order];
            let ([v, x], _) = solved(matrix, [-value, f64::from(u8::from(order == 1))])?;
            (unknown.coefficients[order], input.coefficients[order]) = (v, x);
        }
        Some(std::array::from_fn(|k| point(unknown.coefficients[k], input.coefficients[k])))
    }

    /// As [`Curve::tangent`](super::curve::Curve::tangent).
    #[must_use]
    pub fn tangent(&self, at: &Point, towards: &Point) -> Option<Point> {
        /// Slopes below this, of an equation with coefficients of size 1, are 0.
        const RANK: f64 = 1e-10;
        let [by_unknown, by_input] = self.here(at).slopes;
        let length = by_unknown.hypot(by_input);
        let (v, x) = (by_input / length, -by_unknown / length);
        let side = v * towards[UNKNOWN] + x * towards[INPUT];
        (length > RANK).then(|| if side < 0.0 { point(-v, -x) } else { point(v, x) })
    }

    /// As [`Curve::corrected`](super::curve::Curve::corrected).
    #[must_use]
    pub fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)> {
        let (at, first) = onto(start, |at| {
            let Here { value, slopes } = self.here(at);
            let ([v, x], enlarged) = solved([slopes, [border[UNKNOWN], border[INPUT]]], [value, 0.0])?;
            Some((point(v, x), enlarged))
        })?;
        let reach = at.iter().map(|x| x.abs()).fold(1.0, f64::max);
        (self.here(&at).value.abs() < 1e-11 * reach * reach).then_some((at, first))
    }
}

fn point(unknown: f64, input: f64) -> Point {
    let mut point = [0.0; 7];
    (point[UNKNOWN], point[INPUT]) = (unknown, input);
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::curve::ALONG_INPUT;

    /// `cos v = 2 cos x`: at `cos x = 1/4` the unknown is 60 degrees, and at `cos x = 1/2` the input turns back.
    fn curve() -> PlaneCurve {
        let (one, nought) = (Variable::Rotation, 0.0);
        PlaneCurve::new(one, one, &[[nought, -2.0, nought], [1.0, nought, nought], [nought; 3]], 1.0)
    }

    #[test]
    fn taylor_coefficients_are_those_of_the_implicit_function() {
        let x: f64 = 0.25_f64.acos();
        let v = 0.5_f64.acos();
        let [_, first, second] = curve().taylor::<3>(&point(v, x), &ALONG_INPUT).unwrap();
        // sin v v' = 2 sin x, cos v v'^2 + sin v v'' = 2 cos x.
        let slope = 2.0 * x.sin() / v.sin();
        let bend = (2.0 * x.cos() - v.cos() * slope * slope) / v.sin();
        assert!((first[UNKNOWN] - slope).abs() < 1e-14 && (first[INPUT] - 1.0).abs() < 1e-15);
        assert!((2.0 * second[UNKNOWN] - bend).abs() < 1e-13, "{second:?}");
    }

    #[test]
    fn a_limit_position_has_a_tangent_and_no_slope() {
        let limit = point(0.0, 0.5_f64.acos());
        assert!(curve().taylor::<2>(&limit, &ALONG_INPUT).is_none());
        let tangent = curve().tangent(&limit, &point(1.0, 0.0)).unwrap();
        assert!((tangent[UNKNOWN] - 1.0).abs() < 1e-15 && tangent[INPUT].abs() < 1e-15);
        let start = point(0.3, 0.25_f64.acos() + 0.1);
        let (found, _) = curve().corrected(&start, &point(1.0, 0.0)).unwrap();
        assert!((found[UNKNOWN] - 0.3).abs() < 1e-15 && (0.3_f64.cos() - 2.0 * found[INPUT].cos()).abs() < 1e-14);
    }
}
