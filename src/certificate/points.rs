//! Bounds by the points of a platform, whatever its legs are: theorem 3 (c) to (e) of docs/certificate.md.

use super::isolation::Longer;
use super::platform::PlatformClosure;
use crate::algebra::echelon::Echelon;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::kinematics::motion::{cross, dot};
use rug::{Float, Rational};

type Vector = [Rational; 3];
type Points = [Vector; 6];
/// The numbers v.a of all points of the base, and w.b of the plate.
type Heights = [Vec<Longer>; 2];

/// Maximum number of poses of any platform.
const MOST: usize = 40;
/// The number of poses that three points in common, or three pairs of points, leave.
const OF_COINCIDENCES: usize = 16;
/// The number of poses where base and plate are affine images of points of a plane, where they are of points in space, and where they
/// are similar in space.
const OF_IMAGES: [usize; 3] = [16, 32, 24];
/// Solutions normal to two directions: two isotropic vectors are normal to each.
const SIGNS: [[i32; 2]; 4] = [[1, 1], [1, -1], [-1, 1], [-1, -1]];

/// Returns the least bound; `None` if it is that of all platforms.
pub(super) fn of_points(closure: &PlatformClosure) -> Option<usize> {
    let [base, plate] = closure.exact.as_ref()?;
    let mut least = MOST - at_infinity(base, plate);
    if [base, plate].into_iter().any(|points| three_meet(points) || in_pairs(points)) {
        least = least.min(OF_COINCIDENCES);
    }
    let both = |k: usize| base[k].iter().chain(&plate[k]).cloned().collect();
    least = least.min(match dimension(6, &both) {
        0..=2 => OF_IMAGES[0],
        3 => OF_IMAGES[1],
        _ => MOST,
    });
    if dimension(3, &|k| base[k].to_vec()) == 3 && are_similar(base, plate) {
        least = least.min(OF_IMAGES[2]);
    }
    (least < MOST).then_some(least)
}

/// Returns the dimension of the affine space that six points of so many coordinates span.
fn dimension(size: usize, point: &dyn Fn(usize) -> Vec<Rational>) -> usize {
    let row = |k: usize| std::iter::once(Rational::from(1)).chain(point(k)).collect();
    Echelon::of((0..6).map(row).collect(), size + 1).rank() - 1
}

fn three_meet(points: &Points) -> bool {
    (0..6).any(|i| points.iter().filter(|point| **point == points[i]).count() >= 3)
}

fn in_pairs(points: &Points) -> bool {
    let mut corners: Vec<&Vector> = Vec::new();
    for point in points {
        if points.iter().filter(|other| *other == point).count() != 2 {
            return false;
        }
        if !corners.contains(&point) {
            corners.push(point);
        }
    }
    let [a, b, c] = corners.as_slice() else { return false };
    cross(&difference(b, a), &difference(c, a)).iter().any(|x| *x != 0)
}

fn difference(u: &Vector, v: &Vector) -> Vector {
    std::array::from_fn(|k| Rational::from(&u[k] - &v[k]))
}

fn is_null(v: &Vector) -> bool {
    v.iter().all(|x| *x == 0)
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (0..i).map(move |j| (i, j)))
}

/// Returns whether the squared distances of the points of one body are those of the other, times a number that is not 0.
fn are_similar(base: &Points, plate: &Points) -> bool {
    let square = |points: &Points, (i, j): (usize, usize)| {
        let d = difference(&points[i], &points[j]);
        dot(&d, &d)
    };
    let both: Vec<(Rational, Rational)> = pairs().map(|pair| (square(base, pair), square(plate, pair))).collect();
    let Some((x, y)) = both.iter().find(|(x, y)| *x != 0 && *y != 0) else { return false };
    both.iter().all(|(u, v)| Rational::from(x * v) == Rational::from(u * y))
}

/// Returns the number of isolated solutions `(v.a - nu) (w.b - mu) = sigma` with isotropic v and w normal to two directions.
fn at_infinity(base: &Points, plate: &Points) -> usize {
    let (of_base, of_plate) = (directions(base), directions(plate));
    of_base.iter().flat_map(|d| of_plate.iter().map(move |e| normal_to(d, e, base, plate))).sum()
}

/// Returns the directions of the lines through two points, each once.
fn directions(points: &Points) -> Vec<Vector> {
    let mut found: Vec<Vector> = Vec::new();
    for (i, j) in pairs() {
        let d = difference(&points[i], &points[j]);
        if !is_null(&d) && found.iter().all(|e| !is_null(&cross(&d, e))) {
            found.push(d);
        }
    }
    found
}

/// Returns the number of solutions normal to these directions: those with `sigma = 0` count twice.
fn normal_to(d: &Vector, e: &Vector, base: &Points, plate: &Points) -> usize {
    let (lines, others) = (lines_along(d, base), lines_along(e, plate));
    let bodies = |signs: [i32; 2]| Some([heights(&normal(d, signs[0])?, base), heights(&normal(e, signs[1])?, plate)]);
    let along: Vec<[Rational; 2]> = (0..6).map(|k| [dot(d, &base[k]), dot(e, &plate[k])]).collect();
    let count = |of: &dyn Fn(&Heights) -> Option<[Longer; 2]>, times: usize| {
        let proved = |signs: &[i32; 2]| {
            let bodies = bodies(*signs)?;
            is_isolated(&along, &bodies, &of(&bodies)?)
        };
        if SIGNS.iter().all(|signs| proved(signs) == Some(true)) { SIGNS.len() * times } else { 0 }
    };
    if lines == others && lines.len() == 3 {
        let classes: Vec<usize> = lines.iter().map(|line| line[0]).collect();
        return count(&|bodies| by_classes(&classes, bodies), 1);
    }
    let covers = |i: &[usize], j: &[usize]| (0..6).all(|leg| i.contains(&leg) || j.contains(&leg));
    let chosen = lines.iter().flat_map(|i| others.iter().map(move |j| (i, j))).filter(|(i, j)| covers(i, j));
    chosen.map(|(i, j)| count(&|[a, b]| Some([a[i[0]].clone(), b[j[0]].clone()]), 2)).sum()
}

/// Returns the legs by the lines of this direction on which their points lie.
fn lines_along(d: &Vector, points: &Points) -> Vec<Vec<usize>> {
    let mut lines: Vec<Vec<usize>> = Vec::new();
    for k in 0..6 {
        let is_on = |line: &&mut Vec<usize>| is_null(&cross(d, &difference(&points[k], &points[line[0]])));
        match lines.iter_mut().find(is_on) {
            Some(line) => line.push(k),
            None => lines.push(vec![k]),
        }
    }
    lines
}

/// Returns an isotropic vector normal to a direction, one of two.
fn normal(d: &Vector, sign: i32) -> Option<[Longer; 3]> {
    let one: Vector = if d[0] == 0 && d[1] == 0 {
        [Rational::new(), d[2].clone(), Rational::from(-&d[1])]
    } else {
        [d[1].clone(), Rational::from(-&d[0]), Rational::new()]
    };
    let length = Longer::from(&Enclosure::of(&dot(d, d)).sqrt()?);
    let turned = Longer::point(&Float::new(32), &Float::with_val(32, sign)).over(&length)?;
    let other = cross(d, &one);
    let part = |k: usize| Some(Longer::from_rational(&one[k])?.add(&turned.mul(&Longer::from_rational(&other[k])?)));
    Some([part(0)?, part(1)?, part(2)?])
}

fn heights(v: &[Longer; 3], points: &Points) -> Vec<Longer> {
    let known = |point: &Vector| point.each_ref().map(|x| Longer::from_rational(x).unwrap_or_else(Longer::zero));
    points.iter().map(|point| dot(v, &known(point))).collect()
}

/// Returns nu and mu of three legs: `a b - mu a - nu b + (nu mu - sigma) = 0`.
fn by_classes(classes: &[usize], [a, b]: &Heights) -> Option<[Longer; 2]> {
    let row = |&k: &usize| vec![a[k].clone(), b[k].clone(), Longer::one(), a[k].mul(&b[k])];
    let solved = Echelon::among(classes.iter().map(row).collect(), 4, 3);
    let value = |column: usize| {
        let at = solved.pivots().iter().position(|pivot| *pivot == column)?;
        Some(solved.rows()[at][3].clone())
    };
    if solved.rank() == 3 { Some([value(1)?, value(0)?]) } else { None }
}

/// Returns whether the derivatives of the six equations by v, w, nu, mu and sigma have the rank 5: the direction of the base is tangent
/// to the isotropic directions at v, that of the plate at w.
fn is_isolated(along: &[[Rational; 2]], [a, b]: &Heights, [nu, mu]: &[Longer; 2]) -> Option<bool> {
    let row = |k: usize| {
        let (of_a, of_b) = (a[k].sub(nu), b[k].sub(mu));
        let along = along[k].each_ref().map(Longer::from_rational);
        let [by_v, by_w] = [along[0].as_ref()?.mul(&of_b), along[1].as_ref()?.mul(&of_a)];
        Some(vec![by_v, by_w, of_b, of_a, Longer::one()])
    };
    let rows = (0..6).map(row).collect::<Option<_>>()?;
    Some(Echelon::of(rows, 5).rank() == 5)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: [[i32; 3]; 6]) -> Points {
        list.map(|p| p.map(Rational::from))
    }

    #[test]
    fn points_meet_in_pairs_or_in_threes() {
        let (a, b, c, d) = ([0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]);
        assert!(in_pairs(&points([a, b, c, a, b, c])) && !in_pairs(&points([a, b, d, a, b, d])));
        assert!(three_meet(&points([a, b, c, a, d, a])) && !three_meet(&points([a, b, c, a, d, b])));
    }

    #[test]
    fn hexagons_with_alternating_sides_have_twelve_solutions_at_infinity() {
        let base = points([[6, 1, 0], [1, 6, 0], [0, 6, 1], [0, 1, 6], [1, 0, 6], [6, 0, 1]]);
        let plate = points([[2, 3, 0], [0, 3, 2], [0, 2, 3], [2, 0, 3], [3, 0, 2], [3, 2, 0]]);
        assert_eq!(at_infinity(&base, &plate), 12);
        let mut other = plate;
        other[0][0] = Rational::from((21, 10));
        assert!(at_infinity(&base, &other) < 12);
    }
}
