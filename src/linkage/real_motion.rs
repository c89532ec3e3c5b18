//! Groups whose assemblies are infinitely many: a real assembly that moves, and the proof that there is one.
//!
//! A set of dimension 1 is cut at rational values of a rotation or a displacement. If more cuts than it can have isolated members, or
//! connected parts, have real members, real ones form a curve: the theorem is in `docs/exact.md`. Sets of a higher dimension are first
//! cut until their dimension is 1.

use super::exact_group::{EFFORT, solutions};
use super::quadratic::Root;
use super::real_system::RealSystem;
use crate::algebra::groebner::{Basis, Equation};
use crate::algebra::ring::Ring;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::{Rational, ops::Pow};

/// Starts of the search for a real assembly: half of them lead to one where there is a curve of any extent.
const STARTS: usize = 40;
/// Steps of the search from one start; it converges in ten or does not.
const STEPS: usize = 60;
/// Largest equation of an assembly that the search accepts.
const CLOSED: f64 = 1e-9;
/// Singular values below this share of the largest stand for 0.
const SINGULAR: f64 = 1e-7;
/// Rates of rotations below this share of the largest stand for 0.
const STILL: f64 = 1e-6;
/// Half tangents of cuts are multiples of one over this number: cuts that are near each other meet the same piece of a curve.
const FINE: i32 = 1 << 12;
/// Cuts that are tried for every one that is needed.
const SPARE: usize = 2;
/// Most cuts that are needed: structures of five links were seen to need 17 or 55, of seven links 65, and some room is left.
const MOST_CUTS: usize = 80;

/// Infinitely many assemblies of a group.
pub(super) struct Moving {
    /// The dimension of their set, complex ones included.
    pub dimension: usize,
    /// A real one near which others lie, with the rates of the classes and of the slides along which they do.
    pub sample: Option<(Root, Vec<Vec<f64>>)>,
    /// Another real one near the first, of a curve that is cut at once.
    pub beside: Option<Root>,
    /// Whether a curve of real assemblies is proved.
    pub is_proved: bool,
    /// All regular assemblies, which are isolated, and whether each is real; `None` where they were not looked for.
    pub regular: Option<Vec<(Root, bool)>>,
}

/// Describes infinitely many assemblies of this dimension.
pub(super) fn moving(system: &RealSystem, dimension: usize) -> Moving {
    let dimensions = dimension + system.spinning.len();
    let mut found = Moving { dimension: dimensions, sample: None, beside: None, is_proved: false, regular: None };
    let Some(mut point) = real_point(system) else { return found };
    let rates: Vec<Vec<f64>> = point.rates(system);
    let mut cut = system.clone();
    let mut left = dimension;
    while left > 1 {
        let next = movers(&cut, &point).into_iter().find_map(|moved| {
            let next = moved.cut(&cut, moved.nearest_step(&cut, &point));
            let basis = <Basis>::of(next.unknowns, &next.equations, EFFORT)?;
            let nearby = (basis.dimension() == Some(left - 1)).then(|| improved(&next, point.values.clone()))??;
            Some((next, nearby))
        });
        let Some(next) = next else { return found };
        ((cut, point), left) = (next, left - 1);
    }
    let first = movers(&cut, &point).into_iter().find_map(|moved| {
        let step = moved.nearest_step(&cut, &point);
        [0, 1, -1]
            .into_iter()
            .find_map(|by| Some((moved, step + by, real_member(&moved.cut(&cut, step + by), &point.place(&cut))?)))
    });
    let Some((moved, first, (member, _))) = first else { return found };
    let near = place(&member);
    let [parts, components] = [parts(&cut), components(&cut)];
    let (mut real, mut simple) = (0, 0);
    let mut rates = (dimension > 1).then_some(rates);
    for step in 0..SPARE * parts.min(components).min(MOST_CUTS) {
        // 0, 1, -1, 2, -2, ...: both ways from the first.
        let half = i32::try_from(step.div_ceil(2)).unwrap_or(0);
        let offset = if step % 2 == 1 { half } else { -half };
        let Some((next, is_simple)) = real_member(&moved.cut(&cut, first + offset), &near) else { continue };
        if step > 0 && rates.is_none() {
            rates = Some(vec![difference(&member, &next)]);
            found.beside = Some(next);
        }
        real += 1;
        simple += usize::from(is_simple);
        found.is_proved = real > parts || simple > components;
        if found.is_proved || (parts.min(components) > MOST_CUTS && rates.is_some()) {
            break;
        }
    }
    if rates.is_none() && system.spinning.is_empty() {
        // One real member alone may be an isolated one of complex ones that move.
        return found;
    }
    let mut rates = rates.unwrap_or_default();
    let unit = |class: &usize| {
        (0..system.turns.len() + system.shifts.len()).map(|k| f64::from(u8::from(k == *class))).collect()
    };
    rates.extend(system.spinning.iter().map(unit));
    found.sample = Some((member, rates));
    found
}

/// The most connected parts that the real solutions of the equations can have. \[Milnor1964\]
fn parts(system: &RealSystem) -> usize {
    let degree = system.equations.iter().map(Equation::degree).max().unwrap_or(0).max(1);
    let power = u32::try_from(system.unknowns.saturating_sub(1)).unwrap_or(u32::MAX);
    degree.saturating_mul((2 * degree - 1).saturating_pow(power))
}

/// The most irreducible components that the complex solutions of the equations can have. \[Fulton1998\]
fn components(system: &RealSystem) -> usize {
    // An equation that is 0 bounds nothing.
    let degrees = system.equations.iter().map(|equation| equation.degree().max(1));
    degrees.fold(1, usize::saturating_mul)
}

/// The rotations of a member in f64.
fn middles(root: &Root) -> Vec<Complex<f64>> {
    root.turns.iter().map(|turn| turn.z.middle()).collect()
}

/// How far two members are from each other in f64: by their rotations, and by displacements where nothing turns.
fn apart(one: &[Complex<f64>], other: &[Complex<f64>]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// What tells members of a set from each other in f64: the directions of rotations, or displacements where nothing turns.
fn place(root: &Root) -> Vec<Complex<f64>> {
    if root.turns.is_empty() {
        return root.shifts.iter().map(|shift| shift.z.middle()).collect();
    }
    directions(middles(root))
}

/// Rotations with norm 1: those of bars may have others.
fn directions(turns: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    turns.into_iter().map(|turn| turn / turn.norm()).collect()
}

/// The changes of the rotations and displacements from one member to another one beside it, in parts of the largest.
fn difference(one: &Root, other: &Root) -> Vec<f64> {
    let turns = middles(one).into_iter().zip(middles(other)).map(|(from, to)| (to * from.conj()).arg());
    let shifts = one.shifts.iter().zip(&other.shifts).map(|(from, to)| (to.z.middle() - from.z.middle()).re);
    let all: Vec<f64> = turns.chain(shifts).collect();
    let largest = all.iter().fold(f64::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    all.into_iter().map(|x| x / largest).collect()
}

/// A point of the set in f64, with the directions in which it goes on to first order.
struct Point {
    values: Vec<f64>,
    ways: Vec<Vec<f64>>,
}

impl Point {
    /// The rotations of the classes, or the displacements where nothing turns.
    fn place(&self, system: &RealSystem) -> Vec<Complex<f64>> {
        let still = vec![0.0; self.values.len()];
        let value = |part: &Equation| along(part, &self.values, &still)[0];
        if system.turns.is_empty() {
            return system.shifts.iter().map(|shift| Complex::new(value(shift), 0.0)).collect();
        }
        let turns = system.turns.iter().map(|turn| Complex::new(value(&turn.re), value(&turn.im)));
        directions(turns.collect())
    }

    /// The rates of the classes, then of the slides, along every way.
    fn rates(&self, system: &RealSystem) -> Vec<Vec<f64>> {
        let rate = |way: &Vec<f64>| {
            let turns = system.turns.iter().map(|turn| {
                let ([x, dx], [y, dy]) = (along(&turn.re, &self.values, way), along(&turn.im, &self.values, way));
                x * dy - y * dx
            });
            turns.chain(system.shifts.iter().map(|shift| along(shift, &self.values, way)[1])).collect()
        };
        self.ways.iter().map(rate).collect()
    }
}

/// The value and the derivative along a direction.
fn along(equation: &Equation, at: &[f64], way: &[f64]) -> [f64; 2] {
    // A step along i of this size gives derivatives without cancellation.
    let step = 1e-100;
    let values: Vec<Complex<f64>> = at.iter().zip(way).map(|(x, d)| Complex::new(*x, step * d)).collect();
    let value = equation.evaluate(&values);
    [value.re, value.im / step]
}

/// Searches for a real point at which the equations are dependent to first order.
fn real_point(system: &RealSystem) -> Option<Point> {
    // Any fixed seed: what is found is measured, and nothing is proved by it.
    let mut random = ChaCha8Rng::seed_from_u64(1);
    (0..STARTS).find_map(|_| improved(system, (0..system.unknowns).map(|_| random.random_range(-1.0..1.0)).collect()))
}

/// Newton's method, by least squares.
fn improved(system: &RealSystem, mut x: Vec<f64>) -> Option<Point> {
    // With fewer rows than columns a decomposition would not hold the whole null space.
    let size = system.equations.len().max(x.len());
    let at = |x: &[f64]| {
        let mut gap = DVector::zeros(size);
        let mut matrix = DMatrix::zeros(size, x.len());
        for k in 0..x.len() {
            let way: Vec<f64> = (0..x.len()).map(|j| f64::from(u8::from(j == k))).collect();
            for (i, equation) in system.equations.iter().enumerate() {
                let [value, slope] = along(equation, x, &way);
                (gap[i], matrix[(i, k)]) = (value, slope);
            }
        }
        (gap, matrix)
    };
    for _ in 0..STEPS {
        let (gap, matrix) = at(&x);
        let step = finite(matrix).svd(true, true).solve(&gap, 1e-12).ok()?;
        x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step);
        if x.iter().any(|x| !x.is_finite()) {
            return None;
        }
    }
    let (gap, matrix) = at(&x);
    let svd = finite(matrix).svd(false, true);
    let largest = svd.singular_values.max();
    let v = svd.v_t.as_ref()?;
    let free = (0..svd.singular_values.len()).filter(|k| svd.singular_values[*k] <= SINGULAR * largest);
    let ways: Vec<Vec<f64>> = free.map(|k| v.row(k).iter().copied().collect()).collect();
    (gap.amax() <= CLOSED && !ways.is_empty()).then_some(Point { values: x, ways })
}

/// What moves along a curve.
#[derive(Clone, Copy)]
enum Moved {
    /// A class.
    Class(usize),
    /// A slide.
    Slide(usize),
}

/// The classes that turn, fastest first, then the slides that move.
fn movers(system: &RealSystem, point: &Point) -> Vec<Moved> {
    let rates = point.rates(system);
    let classes = system.turns.len();
    let speed = |k: usize| rates.iter().map(|rate| rate[k].abs()).fold(0.0, f64::max);
    let sorted = |range: std::ops::Range<usize>| {
        let mut list: Vec<usize> = range.filter(|k| speed(*k) > STILL).collect();
        list.sort_by(|a, b| speed(*b).total_cmp(&speed(*a)));
        list
    };
    let slides = sorted(classes..classes + system.shifts.len()).into_iter().map(|k| Moved::Slide(k - classes));
    // A bar that stands by the square of its length has no rational rotations to be held at.
    let turning = sorted(0..classes).into_iter().filter(|class| system.squares[*class] == 1);
    turning.map(Moved::Class).chain(slides).collect()
}

impl Moved {
    /// The half tangent of the class, or the displacement along the slide, at a point, in steps.
    fn nearest_step(self, system: &RealSystem, point: &Point) -> i32 {
        let still = vec![0.0; point.values.len()];
        let value = |part: &Equation| along(part, &point.values, &still)[0];
        let size = match self {
            Self::Class(class) => (value(&system.turns[class].im).atan2(value(&system.turns[class].re)) / 2.0).tan(),
            Self::Slide(slide) => value(&system.shifts[slide]),
        };
        // Where it is larger, near the half turn, the curve is met elsewhere.
        #[expect(clippy::cast_possible_truncation, reason = "at most 1e4 times 2^12")]
        let step = (size.clamp(-1e4, 1e4) * f64::from(FINE)).round() as i32;
        step
    }

    /// The system with what moves at a place, in steps.
    fn cut(self, system: &RealSystem, step: i32) -> RealSystem {
        let mut cut = system.clone();
        let mut fix = |part: &Equation, value: &Rational| {
            let value = Equation::from_rational(value).unwrap_or_else(Equation::zero);
            cut.equations.push(part.sub(&value));
        };
        let t = Rational::from((step, FINE));
        match self {
            Self::Slide(slide) => fix(&system.shifts[slide], &t),
            Self::Class(class) => {
                let square = Rational::from((&t).pow(2));
                let length = Rational::from(&square + 1);
                fix(&system.turns[class].re, &(Rational::from(1 - &square) / &length));
                fix(&system.turns[class].im, &(t * 2 / length));
            }
        }
        cut
    }
}

/// The real member of a finite set that is nearest to a place, and whether a real one is of multiplicity 1; `None` where the set is
/// not finite or has none.
fn real_member(system: &RealSystem, near: &[Complex<f64>]) -> Option<(Root, bool)> {
    let basis = <Basis>::of(system.unknowns, &system.equations, EFFORT)?;
    if basis.dimension() != Some(0) {
        return None;
    }
    let far = |root: &Root| apart(&place(root), near);
    let real: Vec<Root> =
        solutions(system, &basis)?.into_iter().filter(|(_, real)| *real).map(|(root, _)| root).collect();
    let is_simple = real.iter().any(|root| root.multiplicity == 1);
    Some((real.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)))?, is_simple))
}
