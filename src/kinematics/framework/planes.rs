//! Frameworks on two perpendicular planes, every bar from one plane to the other.
//!
//! Let x be the coordinate along the line in which the planes meet, y that across it in the first plane and z in the second. A bar
//! from (x, y, 0) to (x', 0, z') has the squared length `(x - x')^2 + y^2 + z'^2`. Put `f(x) = a x + b` in place of x and
//! `g(x') = x'/a + c` in place of x': the product f g exceeds x x' by terms in x alone and in x' alone. These, the changes of
//! the squares of x and x', and a constant e are taken up by y^2 and z'^2. Where no y and no z' is 0, their square roots are
//! analytic near (a, b, c, e) = (1, 0, 0, 0): a family of realisations with the same lengths. If its four derivatives span with
//! the rigid motions r dimensions more than these alone, the framework moves in at least r dimensions: proved, with real
//! motions.

use super::Framework;
use crate::algebra::echelon::Echelon;
use crate::kinematics::motion::{Vector, cross, dot};
use rug::Rational;

/// The least dimension of the motions of a framework on two perpendicular planes; `None` for other frameworks, and where nothing
/// moves in this way.
pub fn on_planes(framework: &Framework<Rational>) -> Option<usize> {
    if framework.bodies > 0 || framework.free.len() != framework.vertices.len() {
        return None;
    }
    let is_first = colours(framework)?;
    let part = |first: bool| -> Vec<usize> { (0..is_first.len()).filter(|v| is_first[*v] == first).collect() };
    let (first, second) = (part(true), part(false));
    let (m, n) = (normal(framework, &first)?, normal(framework, &second)?);
    if dot(&m, &n) != 0 {
        return None;
    }
    let line = cross(&m, &n);
    // A point of both planes: m and n are perpendicular.
    let point = |v: usize| &framework.vertices[v];
    let along = |normal: &Vector<Rational>, v: usize| dot(point(v), normal) / dot(normal, normal);
    let (s, t) = (along(&m, *first.first()?), along(&n, *second.first()?));
    let origin: Vector<Rational> = std::array::from_fn(|k| Rational::from(&s * &m[k]) + Rational::from(&t * &n[k]));
    let unit = dot(&line, &line);
    let mut derivatives = vec![vec![Rational::new(); framework.coordinates()]; 4];
    for (v, &of_first) in is_first.iter().enumerate() {
        let across = if of_first { &n } else { &m };
        let here: Vector<Rational> = std::array::from_fn(|k| Rational::from(&point(v)[k] - &origin[k]));
        // The height times the square of the vector that it is measured by.
        let height = dot(&here, across);
        if height == 0 {
            return None;
        }
        let x = dot(&here, &line) / &unit;
        let (sign, one) = (Rational::from(if of_first { 1 } else { -1 }), Rational::from(1));
        let pull = Rational::from(&sign * &unit) * &x / &height;
        let rates = [
            (Rational::from(&sign * &x), -Rational::from(&pull * &x)),
            (if of_first { one.clone() } else { Rational::new() }, -pull.clone()),
            (if of_first { Rational::new() } else { one }, pull),
            (Rational::new(), -sign / &height),
        ];
        let place = framework.free.iter().position(|free| *free == v)?;
        for (row, (shift, rise)) in derivatives.iter_mut().zip(rates) {
            for k in 0..3 {
                row[3 * place + k] = Rational::from(&shift * &line[k]) + Rational::from(&rise * &across[k]);
            }
        }
    }
    let rigid = framework.rigid_motions();
    let rank = |rows: Vec<Vec<Rational>>| Echelon::of(rows, framework.coordinates()).rank();
    let own = rank(rigid.clone());
    let dimension = rank(rigid.into_iter().chain(derivatives).collect()) - own;
    (dimension > 0).then_some(dimension)
}

/// Marks the vertices in the part of the first one, where every bar joins the one part with the other; `None` if there are no
/// such parts, or the bars are not connected.
fn colours(framework: &Framework<Rational>) -> Option<Vec<bool>> {
    let mut colours = vec![None; framework.vertices.len()];
    *colours.first_mut()? = Some(true);
    // Each round reaches at least one vertex more.
    for _ in 0..framework.vertices.len() {
        for &[a, b] in &framework.bars {
            match (colours[a], colours[b]) {
                (Some(a), Some(b)) if a == b => return None,
                (Some(known), None) => colours[b] = Some(!known),
                (None, Some(known)) => colours[a] = Some(!known),
                _ => {}
            }
        }
    }
    colours.into_iter().collect()
}

/// The normal of the plane of some vertices; `None` unless they lie in one plane and not in a line.
fn normal(framework: &Framework<Rational>, part: &[usize]) -> Option<Vector<Rational>> {
    let (first, others) = part.split_first()?;
    let from = |v: &usize| -> Vec<Rational> {
        (0..3).map(|k| Rational::from(&framework.vertices[*v][k] - &framework.vertices[*first][k])).collect()
    };
    match Echelon::of(others.iter().map(from).collect(), 3).null_space().as_slice() {
        [normal] => normal.clone().try_into().ok(),
        _ => None,
    }
}
