//! The lines of a linear system of complexes: transversals of four lines, directrices of a congruence.

use crate::algebra::echelon::Echelon;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::displacement::answer::{Answer, Counted, Mode, Rounding, list, pairs};
use crate::verdict::Code;
use looproot_calculus::line::complex::{Complex, containing};
use looproot_calculus::line::pencil::{klein_form, member, quadratic};
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::unit::Root;
use num_complex::Complex as Number;
use rug::Rational;
use serde_json::{Map, Value};
use std::cmp::Ordering;

/// The lines that meet four lines.
pub fn transversals(lines: &[Line<Rational>; 4]) -> Answer {
    let basis = containing(lines);
    match basis.as_slice() {
        [one, two] => of_pencil(one, two, "transversals"),
        _ => of_system(&basis),
    }
}

/// The directrices of the congruence of two complexes: the special complexes of their pencil.
pub fn congruence(complexes: &[Complex<Rational>; 2]) -> Answer {
    let [one, two] = complexes;
    let rows = [one, two].map(|c| c.a.iter().chain(&c.b).cloned().collect::<Vec<_>>());
    if Echelon::of(rows.to_vec(), 6).rank() < 2 {
        return Answer::family(3, None, "the two complexes are one, which has lines of dimension 3");
    }
    of_pencil(one, two, "directrices")
}

/// The lines of a pencil, by its quadratic equation.
fn of_pencil(one: &Complex<Rational>, two: &Complex<Rational>, what: &str) -> Answer {
    let [a, b, c] = quadratic(one, two);
    if a == 0 && b == 0 && c == 0 {
        return Answer::family(
            1,
            sample(one),
            format!("every member of the pencil is a line: the {what} are a flat pencil"),
        );
    }
    let discriminant = Rational::from(b.square_ref()) - Rational::from(&a * &c);
    let roots = discriminant.cmp0();
    // A member with direction 0 is a line at infinity.
    let mut modes = Vec::new();
    let mut at_infinity = 0;
    if roots == Ordering::Less {
        modes = complex_modes(one, two, [&a, &b, &c]);
    } else {
        let multiplicity = if roots == Ordering::Equal { 2 } else { 1 };
        for sign in [1, -1].into_iter().take(if multiplicity == 2 { 1 } else { 2 }) {
            match real_mode(one, two, [&a, &b, &c], &discriminant, sign) {
                Some(mode) => modes.push(Mode { multiplicity, ..mode }),
                None => at_infinity += multiplicity,
            }
        }
    }
    let (complex, what_roots) = match roots {
        Ordering::Less => (2, "no real root"),
        Ordering::Equal => (2 - at_infinity, "a double root"),
        Ordering::Greater => (2 - at_infinity, "two real roots"),
    };
    let far = if at_infinity > 0 { format!("; {at_infinity} of them at infinity") } else { String::new() };
    let reason =
        format!("the {what} are the lines of a pencil of complexes, whose quadratic equation has {what_roots}{far}");
    Answer::complete(modes, Counted { complex, code: Code::GeneralBoundMet, at_infinity, reason })
}

/// The line of a root of `a s^2 + 2 b s t + c t^2`; `None` at infinity.
fn real_mode(
    one: &Complex<Rational>,
    two: &Complex<Rational>,
    [a, b, c]: [&Rational; 3],
    discriminant: &Rational,
    sign: i32,
) -> Option<Mode> {
    let image = |complex: &Complex<Rational>| {
        let vector = |v: &[Rational; 3]| v.each_ref().map(Enclosure::of);
        Complex { a: vector(&complex.a), b: vector(&complex.b) }
    };
    // For a rational root, zeros of the direction are decided exactly.
    if let Some(root) = Root::sqrt(discriminant) {
        let (s, t) = ratio(a, b, c, &Rational::from(&root * sign));
        let line = member(one, two, &s, &t);
        if line.direction.iter().all(|x| *x == 0) {
            return None;
        }
        let enclosed = |v: &[Rational; 3]| v.each_ref().map(Enclosure::of);
        return mode(&Line { direction: enclosed(&line.direction), moment: enclosed(&line.moment) });
    }
    let root = Root::sqrt(&Enclosure::of(discriminant))?;
    let root = if sign > 0 { root } else { root.neg() };
    let (a, b, c) = (Enclosure::of(a), Enclosure::of(b), Enclosure::of(c));
    let (s, t) = ratio(&a, &b, &c, &root);
    // A direction that is 0 at an irrational root is 0 at both, and the basis would be parallel there.
    mode(&member(&image(one), &image(two), &s, &t))
}

/// The root `s : t` with this root of the discriminant.
fn ratio<R: Ring>(a: &R, b: &R, c: &R, root: &R) -> (R, R) {
    if a.is_zero() {
        // t = 0, and 2 b s + c t = 0.
        let two_b = b.add(b);
        // The sign of the root distinguishes the two: it is b or -b.
        return if root == b { (c.neg(), two_b) } else { (R::one(), R::zero()) };
    }
    (root.sub(b), a.clone())
}

/// A real line, with a direction of length 1.
fn mode(line: &Line<Enclosure>) -> Option<Mode> {
    let line = line.unit()?;
    let mut rounding = Rounding::default();
    let mut values = Map::new();
    let mut direction = rounding.vector(&line.direction);
    let mut moment = rounding.vector(&line.moment);
    let point = rounding.vector(&line.point()?);
    // The first entry that is not 0 is positive.
    if direction.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) {
        direction = direction.map(|x| -x);
        moment = moment.map(|x| -x);
    }
    values.insert("direction".into(), list(&direction));
    values.insert("moment".into(), list(&moment));
    values.insert("point".into(), list(&point));
    let residual = looproot_calculus::motion::dot(&direction, &moment).abs();
    Some(Mode { real: true, multiplicity: 1, residual, radius: Some(rounding.radius), values })
}

fn complex_modes(one: &Complex<Rational>, two: &Complex<Rational>, form: [&Rational; 3]) -> Vec<Mode> {
    let image = |q: &Rational| Number { re: nearest_f64(q), im: 0.0 };
    let over = |complex: &Complex<Rational>| Complex {
        a: complex.a.each_ref().map(image),
        b: complex.b.each_ref().map(image),
    };
    let [a, b, c] = form.map(image);
    let root = (b * b - a * c).sqrt();
    let mode = |root: Number<f64>| {
        let line = member(&over(one), &over(two), &(root - b), &a).unit()?;
        let mut values = Map::new();
        values.insert("direction".into(), pairs(&line.direction));
        values.insert("moment".into(), pairs(&line.moment));
        values.insert("point".into(), pairs(&line.point()?));
        Some(Mode { real: false, multiplicity: 1, residual: 0.0, radius: None, values })
    };
    [root, -root].into_iter().filter_map(mode).collect()
}

/// Lines of a larger system: a conic of them, a regulus, in a net, and more in larger ones.
fn of_system(basis: &[Complex<Rational>]) -> Answer {
    let form = klein_form(basis);
    let size = basis.len();
    let all_lines = form.iter().flatten().all(|entry| *entry == 0);
    let dimension = if all_lines { size - 1 } else { size - 2 };
    if is_definite(&form) {
        let reason =
            format!("the given lines have rank {}: their transversals form a complex set without real point", 6 - size);
        let mut answer =
            Answer::complete(Vec::new(), Counted { complex: 0, code: Code::NoSolution, at_infinity: 0, reason });
        // The complex set is named and not listed.
        answer.verdict.complex_complete = false;
        return answer;
    }
    let sample = basis.iter().zip(0..).find(|(_, k)| form[*k][*k] == 0).and_then(|(complex, _)| sample(complex));
    Answer::family(
        dimension,
        sample,
        format!("the given lines have rank {}: their transversals form a regulus or more", 6 - size),
    )
}

/// Whether a symmetric form has one sign, by the signs of its leading minors after exact elimination.
fn is_definite(form: &[Vec<Rational>]) -> bool {
    let mut rows: Vec<Vec<Rational>> = form.to_vec();
    let sign = rows.first().map_or(Ordering::Equal, |row| row[0].cmp0());
    for k in 0..rows.len() {
        if rows[k][k].cmp0() != sign || sign == Ordering::Equal {
            return false;
        }
        for i in k + 1..rows.len() {
            let factor = Rational::from(&rows[i][k] / &rows[k][k]);
            for j in k..rows.len() {
                let part = Rational::from(&factor * &rows[k][j]);
                rows[i][j] -= part;
            }
        }
    }
    true
}

/// A member that is a line, as a sample.
fn sample(complex: &Complex<Rational>) -> Option<Value> {
    let vector = |v: &[Rational; 3]| v.each_ref().map(Enclosure::of);
    mode(&Line { direction: vector(&complex.a), moment: vector(&complex.b) }).map(|mode| Value::Object(mode.values))
}
