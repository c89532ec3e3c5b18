//! Rotation matrices with three prescribed elements.

use super::answer::{Answer, Counted, Mode, Rounding, insert_rotation, pairs};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::nearest_f64;
use crate::verdict::Code;
use looproot_calculus::rotation::elements::{Elements, Pattern};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix};
use looproot_calculus::rotation::vectors::unit;
use looproot_calculus::unit::Root;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Map, Value};

/// By Bezout, three quadrics of P^3 that meet in points meet in eight.
const QUADRICS: usize = 8;

/// Returns all matrices with these elements.
pub fn answer(places: [(usize, usize); 3], values: &[Rational; 3]) -> Answer {
    let Some(elements) = Elements::of(places, values.clone()) else {
        return Answer::none("two of the places are one");
    };
    let squares = elements.squares();
    if elements.pattern == Pattern::Line {
        return of_a_line(places, values);
    }
    if elements.divisor() == 0 {
        return without_divisor(&elements, places, values);
    }
    let is_real = squares.iter().all(|square| *square >= 0);
    let mut modes = Vec::new();
    for signs in signs(&squares, elements.pattern == Pattern::Scattered) {
        // A root that is 0 has one sign only.
        let zeros = squares.iter().filter(|square| **square == 0).count();
        let multiplicity = 1 << zeros;
        let found = if is_real {
            real(&elements, &squares, &signs, places, values)
        } else {
            complex(&elements, &squares, &signs)
        };
        modes.extend(found.map(|mode| Mode { multiplicity, ..mode }));
    }
    let (finite, what) = if elements.pattern == Pattern::Scattered {
        (QUADRICS, "the squares of the four parameters of the quaternion are linear in the elements")
    } else {
        (QUADRICS / 2, "two square roots determine the matrix")
    };
    if finite < QUADRICS {
        modes.extend(null_quaternions(places));
    }
    let null = QUADRICS - finite;
    let null = if null > 0 {
        format!("; {null} of the {QUADRICS} quaternions have norm 0 and are no rotations")
    } else {
        String::new()
    };
    let reason =
        format!("{QUADRICS} common points of three quadrics in the quaternion, with multiplicity: {what}{null}");
    Answer::complete(modes, Counted { complex: QUADRICS, code: Code::GeneralBoundMet, at_infinity: 0, reason })
}

/// Returns all choices of signs for roots; one for a root that is 0, and up to a common sign for the parameters of a quaternion.
fn signs(squares: &[Rational], up_to_sign: bool) -> Vec<Vec<bool>> {
    let mut choices: Vec<Vec<bool>> = vec![Vec::new()];
    let mut is_free = !up_to_sign;
    for square in squares {
        let is_zero = *square == 0;
        let both = is_free && !is_zero;
        choices = choices
            .into_iter()
            .flat_map(|choice| {
                let with = |sign: bool| [choice.clone(), vec![sign]].concat();
                if both { vec![with(true), with(false)] } else { vec![with(true)] }
            })
            .collect();
        // The first root that is not 0 fixes the common sign.
        is_free |= !is_zero;
    }
    choices
}

fn real(
    elements: &Elements<Rational>,
    squares: &[Rational],
    signs: &[bool],
    places: [(usize, usize); 3],
    values: &[Rational; 3],
) -> Option<Mode> {
    let elements = elements.map(|v| Some(Enclosure::of(v)))?;
    let roots: Vec<Enclosure> =
        squares.iter().zip(signs).map(|(square, sign)| root(square, *sign)).collect::<Option<_>>()?;
    let mut rounding = Rounding::default();
    let matrix = rounding.matrix(&elements.matrix(&roots)?);
    let mut named = Map::new();
    insert_rotation(&mut named, &matrix);
    let residual = residual(&matrix, places, values);
    Some(Mode { real: true, multiplicity: 1, residual, radius: Some(rounding.radius), values: named })
}

/// Returns the root of a nonnegative rational, with a sign.
fn root(square: &Rational, is_positive: bool) -> Option<Enclosure> {
    use crate::algebra::ring::Ring;
    let root = Root::sqrt(&Enclosure::of(square))?;
    Some(if is_positive { root } else { root.neg() })
}

/// Returns the distance of a matrix from the prescribed elements.
fn residual(matrix: &Matrix<f64>, places: [(usize, usize); 3], values: &[Rational; 3]) -> f64 {
    let off = |((i, j), value): (&(usize, usize), &Rational)| (matrix[*i][*j] - nearest_f64(value)).abs();
    places.iter().zip(values).map(off).fold(0.0, f64::max)
}

fn complex(elements: &Elements<Rational>, squares: &[Rational], signs: &[bool]) -> Option<Mode> {
    let image = |q: &Rational| Complex { re: nearest_f64(q), im: 0.0 };
    let elements = elements.map(|v| Some(image(v)))?;
    let roots: Vec<Complex<f64>> = squares
        .iter()
        .zip(signs)
        .map(|(square, sign)| if *sign { image(square).sqrt() } else { -image(square).sqrt() })
        .collect();
    let matrix = elements.matrix(&roots)?;
    let q = unit(&from_matrix(&matrix))?;
    let mut values = Map::new();
    values.insert("quaternion".into(), pairs(&[q.scalar, q.vector[0], q.vector[1], q.vector[2]]));
    values.insert("matrix".into(), matrix.iter().map(|row| pairs(row)).collect());
    Some(Mode { real: false, multiplicity: 1, residual: 0.0, radius: None, values })
}

/// Returns the quaternions of norm 0 whose matrix of products has zeros at these places; they satisfy the quadrics and are no
/// rotations.
///
/// Such a matrix is `f g^T` with isotropic f and g, of which at most one entry each is 0. For two places in a row and one
/// beside, the common row or column index decides which.
fn null_quaternions(places: [(usize, usize); 3]) -> Vec<Mode> {
    let count = |of: fn(&(usize, usize)) -> usize, index: usize| places.iter().filter(|p| of(p) == index).count();
    let rows: [usize; 3] = [0, 1, 2].map(|i| count(|p| p.0, i));
    let columns: [usize; 3] = [0, 1, 2].map(|j| count(|p| p.1, j));
    let mut modes = Vec::new();
    for row in 0..3 {
        for column in 0..3 {
            let covers = places.iter().all(|(i, j)| *i == row || *j == column);
            if !covers || rows[row] == 0 || columns[column] == 0 {
                continue;
            }
            for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let isotropic = |zero: usize, sign: f64| {
                    let mut v = [Complex { re: 0.0, im: 0.0 }; 3];
                    v[(zero + 1) % 3] = Complex { re: 1.0, im: 0.0 };
                    v[(zero + 2) % 3] = Complex { re: 0.0, im: sign };
                    v
                };
                let (f, g) = (isotropic(row, s), isotropic(column, t));
                let product: Matrix<Complex<f64>> = std::array::from_fn(|i| std::array::from_fn(|j| f[i] * g[j]));
                let mut values = Map::new();
                values.insert("quaternion".into(), null_quaternion(&product));
                values.insert("matrix".into(), Value::Null);
                modes.push(Mode { real: false, multiplicity: 1, residual: 0.0, radius: None, values });
            }
        }
    }
    modes
}

/// Returns the quaternion of norm 0 with a matrix of products of rank 1.
fn null_quaternion(m: &Matrix<Complex<f64>>) -> Value {
    let trace = m[0][0] + m[1][1] + m[2][2];
    // w^2 = trace/4 with norm 0, and x^2 = (2 m00 - trace)/4.
    let squares = [trace, m[0][0] * 2.0 - trace, m[1][1] * 2.0 - trace, m[2][2] * 2.0 - trace];
    let skew = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let sum = |i: usize, j: usize| m[i][j] + m[j][i];
    let columns = [
        [squares[0], skew[0], skew[1], skew[2]],
        [skew[0], squares[1], sum(0, 1), sum(0, 2)],
        [skew[1], sum(0, 1), squares[2], sum(1, 2)],
        [skew[2], sum(0, 2), sum(1, 2), squares[3]],
    ];
    let size = |column: &[Complex<f64>; 4]| column.iter().map(Complex::norm_sqr).sum::<f64>();
    let mut longest = columns[0];
    for column in columns {
        if size(&column) > size(&longest) {
            longest = column;
        }
    }
    let scale = 1.0 / size(&longest).sqrt();
    pairs(&longest.map(|z| z * scale))
}

/// Solves for three elements of one row or column: a circle of rotations about that row, or nothing.
fn of_a_line(places: [(usize, usize); 3], values: &[Rational; 3]) -> Answer {
    let square: Rational = values.iter().map(|v| Rational::from(v.square_ref())).sum();
    let what = if places[0].0 == places[1].0 { "row" } else { "column" };
    if square != 1 {
        let found = nearest_f64(&square);
        return Answer::none(format!("the three elements are a {what}, whose squares add up to {found} and not to 1"));
    }
    let mut line = [0.0; 3];
    for (place, value) in places.iter().zip(values) {
        line[if what == "row" { place.1 } else { place.0 }] = nearest_f64(value);
    }
    Answer::family(
        1,
        with_line(places[0], what == "row", &line),
        format!("a {what} is given: the rotations about it are free"),
    )
}

/// Returns a rotation matrix with a row or a column given, as a sample.
fn with_line(place: (usize, usize), is_row: bool, line: &[f64; 3]) -> Option<Value> {
    use looproot_calculus::motion::cross;
    let least = (0..3).min_by(|i, j| line[*i].abs().total_cmp(&line[*j].abs()))?;
    let unit: [f64; 3] = std::array::from_fn(|i| f64::from(u8::from(i == least)));
    let next = looproot_calculus::unit::direction(&cross(line, &unit))?;
    let last = cross(line, &next);
    let index = if is_row { place.0 } else { place.1 };
    let mut rows = [[0.0; 3]; 3];
    rows[index] = *line;
    rows[(index + 1) % 3] = next;
    rows[(index + 2) % 3] = last;
    let matrix = if is_row { rows } else { looproot_calculus::rotation::matrix::transpose(&rows) };
    let mut values = Map::new();
    insert_rotation(&mut values, &matrix);
    Some(Value::Object(values))
}

/// Solves the case in which the roots do not determine the matrix. An element +-1 with zeros beside it leaves a circle, two
/// zeros beside each other with a third zero leave two, and otherwise there is no real rotation.
fn without_divisor(elements: &Elements<Rational>, places: [(usize, usize); 3], values: &[Rational; 3]) -> Answer {
    let [_, b, c] = &elements.values;
    let is_corner = elements.pattern == Pattern::Corner;
    if (*b == 0 || !is_corner) && *c == 0 {
        let sample = if is_corner {
            let place = places.iter().zip(values).find(|(_, value)| Rational::from(value.square_ref()) == 1);
            place.and_then(|(place, value)| {
                let mut line = [0.0; 3];
                line[place.1] = nearest_f64(value);
                with_line(*place, true, &line)
            })
        } else {
            let (row, column) = zero_lines(places);
            let mut line = [0.0; 3];
            line[column] = 1.0;
            with_line((row, column), true, &line)
        };
        let reason = "the elements make another one 1: the rotations about that axis are free";
        return Answer::family(1, sample, reason);
    }
    let reason = "a row or column with these elements has no length 1 in the real numbers; \
                  the 8 common points of the three quadrics are complex";
    let counted = Counted { complex: QUADRICS, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.into() };
    let mut answer = Answer::complete(Vec::new(), counted);
    // The complex solutions are counted but not listed.
    answer.verdict.complex_complete = false;
    answer
}

/// Returns row and column of the element that is 1, for three zeros, two in a line and one beside both.
fn zero_lines(places: [(usize, usize); 3]) -> (usize, usize) {
    let pair =
        |of: fn(&(usize, usize)) -> usize| (0..3).find(|index| places.iter().filter(|p| of(p) == *index).count() == 2);
    match (pair(|p| p.0), pair(|p| p.1)) {
        (Some(row), _) => {
            let used: Vec<usize> = places.iter().filter(|p| p.0 == row).map(|p| p.1).collect();
            (row, (0..3).find(|column| !used.contains(column)).unwrap_or(0))
        }
        (None, Some(column)) => {
            let used: Vec<usize> = places.iter().filter(|p| p.1 == column).map(|p| p.0).collect();
            ((0..3).find(|row| !used.contains(row)).unwrap_or(0), column)
        }
        (None, None) => (0, 0),
    }
}
