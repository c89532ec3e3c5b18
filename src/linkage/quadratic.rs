//! Groups of one cycle: a quadratic equation, or a linear one.

use super::equations::Equations;
use super::isotropic::{Isotropic, Value};
use super::polynomial::turned;
use super::state::{Number, number};
use super::tower::Surd;
use crate::algebra::ring::Ring;
use rug::Rational;

/// A solution of a group: the rotations of its classes, the first of which is 1, and the displacements of its slides.
#[derive(Clone, Debug)]
pub struct Root {
    /// One for every class.
    pub turns: Vec<Number>,
    /// One for every slide, in parts of the length of its direction.
    pub shifts: Vec<Number>,
    /// The multiplicity.
    pub multiplicity: usize,
}

/// The solutions of a group in one branch.
#[derive(Clone, Debug)]
pub enum Solved {
    /// All of them.
    Roots(Vec<Root>),
    /// A curve of solutions, on which all these lie.
    Curve(Vec<Root>),
    /// The question that is left undecided.
    Undecided(String),
}

/// The tower of square roots of a branch.
#[derive(Clone, Debug)]
pub struct Top {
    /// A number whose tower holds all others.
    pub number: Surd,
    /// Towers are not built of more generators than this: beyond, discs are all that is known.
    pub highest: usize,
}

/// A number that is the same in both halves.
fn scalar(value: &Value) -> Number {
    Isotropic { z: value.clone(), w: value.clone() }
}

/// A rotation from its first half, which is not zero.
fn rotation(z: Value) -> Option<Number> {
    let w = z.inverse()?;
    Some(Isotropic { z, w })
}

/// Rotations at which a curve is looked at: the first of them may be a special one, at which what stands on it does not close.
fn samples() -> [Number; 3] {
    [0, 2, 5].map(|k| number(&turned(k).z))
}

fn undecided(what: &str) -> Solved {
    Solved::Undecided(format!("{what} is neither proved zero nor proved not to be"))
}

/// The roots of `a x^2 + b x + c` that are neither zero nor infinite, with their multiplicities; `Err` where a
/// coefficient or the discriminant is not decided, `None` where all coefficients are zero.
fn roots(a: &Value, b: &Value, c: &Value, tower: &Top) -> Result<Option<Vec<(Value, usize)>>, &'static str> {
    let none_a = a.vanishes().ok_or("the leading coefficient of a dyad")?;
    let none_c = c.vanishes().ok_or("the last coefficient of a dyad")?;
    if none_a || none_c {
        let none_b = b.vanishes().ok_or("the middle coefficient of a dyad")?;
        return Ok(match (none_a, none_c, none_b) {
            (true, true, true) => None,
            (true, true, false) | (true, false, true) | (false, true, true) => Some(Vec::new()),
            (true, false, false) => b.inverse().map(|inverse| vec![(c.mul(&inverse).neg(), 1)]),
            _ => a.inverse().map(|inverse| vec![(b.mul(&inverse).neg(), 1)]),
        });
    }
    let four = Value::from_rational(&Rational::from(4)).unwrap_or_else(Value::zero);
    let discriminant = b.mul(b).sub(&four.mul(a).mul(c));
    let two_a = a.add(a).inverse().ok_or("the leading coefficient of a dyad")?;
    match discriminant.vanishes() {
        None => Err("the discriminant of a dyad"),
        Some(true) => Ok(Some(vec![(b.neg().mul(&two_a), 2)])),
        Some(false) => {
            let root = discriminant.disc.sqrt().ok_or("the discriminant of a dyad")?;
            let exact = discriminant.exact.as_ref().map(|exact| exact.lifted(&tower.number));
            let exact = exact.filter(|exact| exact.height() <= tower.highest).map(|exact| exact.square_root(&root));
            let exact = exact.filter(|exact| exact.height() <= tower.highest);
            // The disc of the exact root may be the one of the other sign: it is the datum then.
            let disc = exact.as_ref().map_or(root, Surd::disc);
            let root = Value { disc, exact };
            Ok(Some(vec![(root.sub(b).mul(&two_a), 1), (root.neg().sub(b).mul(&two_a), 1)]))
        }
    }
}

/// Solves a group of one cycle. `tower` holds all numbers.
#[must_use]
pub fn one_cycle(equations: &Equations<Number>, tower: &Top) -> Solved {
    let c = &equations.cycles[0];
    match (equations.classes, equations.slides.as_slice()) {
        (3, []) => three_turns(c, tower),
        (2, [slide]) => {
            let u = &slide.coefficients[0];
            if slide.class == 0 {
                turn_and_slide(&c[0], &c[1], u, tower)
            } else {
                slide_on_turn(&c[0], &c[1], u, tower)
            }
        }
        (1, [one, two]) => two_slides(&c[0], &one.coefficients[0], &two.coefficients[0]),
        _ => Solved::Undecided("this group of one cycle has no known form".to_owned()),
    }
}

/// `c0 + c1 x + c2 y = 0` with rotations x and y.
fn three_turns(c: &[Number], tower: &Top) -> Solved {
    let length = |n: &Number| n.z.mul(&n.w);
    // The rotation that is eliminated has a coefficient that is not zero.
    let zeros: Vec<Option<bool>> = c.iter().map(|n| length(n).vanishes()).collect();
    if zeros.contains(&None) {
        return undecided("a distance between two joints of a dyad");
    }
    let is_zero = |k: usize| zeros[k] == Some(true);
    if is_zero(0) || is_zero(1) || is_zero(2) {
        return coincident(c, [is_zero(0), is_zero(1), is_zero(2)]);
    }
    // (c0 + c2 y)(c0' + c2'/y) = c1 c1'
    let middle = length(&c[0]).add(&length(&c[2])).sub(&length(&c[1]));
    let found = match roots(&c[2].z.mul(&c[0].w), &middle, &c[0].z.mul(&c[2].w), tower) {
        Err(what) => return undecided(what),
        Ok(None) => return Solved::Undecided("a dyad whose quadratic equation vanishes".to_owned()),
        Ok(Some(found)) => found,
    };
    let Some(inverse) = c[1].z.inverse() else { return undecided("a distance between two joints of a dyad") };
    let mut list = Vec::new();
    for (y, multiplicity) in found {
        let x = c[0].z.add(&c[2].z.mul(&y)).mul(&inverse).neg();
        let (Some(x), Some(y)) = (rotation(x), rotation(y)) else {
            return undecided("a rotation of a dyad");
        };
        list.push(Root { turns: vec![Number::one(), x, y], shifts: Vec::new(), multiplicity });
    }
    Solved::Roots(list)
}

/// A dyad of which some joints coincide.
fn coincident(c: &[Number], zero: [bool; 3]) -> Solved {
    // On complex branches one half of a number may be zero alone; such assemblies are not decided here.
    if c.iter().zip(zero).any(|(n, zero)| zero && !n.is_zero()) {
        return undecided("half of a complex distance");
    }
    let square = |n: &Number| n.z.mul(&n.w);
    // The rotations, and whether each turns along the curve.
    let curve = |x: Number, y: Number, turns: [bool; 2]| {
        let turned = |n: &Number, by: &Number, turns: bool| if turns { n.mul(by) } else { n.clone() };
        let one = |by: Number| {
            let turns = vec![Number::one(), turned(&x, &by, turns[0]), turned(&y, &by, turns[1])];
            Root { turns, shifts: Vec::new(), multiplicity: 1 }
        };
        Solved::Curve(samples().map(one).to_vec())
    };
    let same = |a: usize, b: usize| square(&c[a]).sub(&square(&c[b])).vanishes();
    let quotient = |a: usize, b: usize| c[b].z.inverse().map(|inverse| c[a].z.mul(&inverse).neg()).and_then(rotation);
    match zero {
        [true, true, true] => curve(Number::one(), Number::one(), [true, false]),
        [true, false, false] => match same(1, 2) {
            None => undecided("the difference of two lengths of a dyad"),
            Some(false) => Solved::Roots(Vec::new()),
            Some(true) => match quotient(2, 1) {
                Some(x) => curve(x, Number::one(), [true, true]),
                None => undecided("a length of a dyad"),
            },
        },
        [false, true, false] | [false, false, true] => {
            let other = if zero[1] { 2 } else { 1 };
            match same(0, other) {
                None => undecided("the difference of two lengths of a dyad"),
                Some(false) => Solved::Roots(Vec::new()),
                Some(true) => match quotient(0, other) {
                    Some(turn) if other == 2 => curve(Number::one(), turn, [true, false]),
                    Some(turn) => curve(turn, Number::one(), [false, true]),
                    None => undecided("a length of a dyad"),
                },
            }
        }
        // One distance alone is never bridged.
        _ => Solved::Roots(Vec::new()),
    }
}

/// `c0 + c1 x + u s = 0`: the slide is fixed in the first class.
fn turn_and_slide(c0: &Number, c1: &Number, u: &Number, tower: &Top) -> Solved {
    let middle = u.w.mul(&c0.z).sub(&u.z.mul(&c0.w));
    let (a, c) = (u.w.mul(&c1.z), u.z.mul(&c1.w).neg());
    let Some(inverse) = u.z.inverse() else { return undecided("the direction of a slide") };
    let shift = |x: &Number| scalar(&c0.z.add(&c1.z.mul(&x.z)).mul(&inverse).neg());
    with_slide(roots(&a, &middle, &c, tower), c0, &middle, shift, &inverse)
}

/// `c0 + c1 x + u x s = 0`: the slide is fixed in the class that turns.
fn slide_on_turn(c0: &Number, c1: &Number, u: &Number, tower: &Top) -> Solved {
    let middle = u.z.mul(&c1.w).sub(&u.w.mul(&c1.z));
    let (a, c) = (u.z.mul(&c0.w), u.w.mul(&c0.z).neg());
    let Some(inverse) = u.z.inverse() else { return undecided("the direction of a slide") };
    let shift = |x: &Number| scalar(&c0.z.mul(&x.w).add(&c1.z).mul(&inverse).neg());
    with_slide(roots(&a, &middle, &c, tower), c1, &middle, shift, &inverse)
}

/// The solutions with one rotation and one slide. Where the rotation is free, the slide is given by the number `fixed`.
fn with_slide(
    found: Result<Option<Vec<(Value, usize)>>, &'static str>,
    fixed: &Number,
    _middle: &Value,
    shift: impl Fn(&Number) -> Number,
    inverse: &Value,
) -> Solved {
    match found {
        Err(what) => undecided(what),
        Ok(None) => {
            let shifts = vec![scalar(&fixed.z.mul(inverse).neg())];
            let one = |by: Number| Root { turns: vec![Number::one(), by], shifts: shifts.clone(), multiplicity: 1 };
            Solved::Curve(samples().map(one).to_vec())
        }
        Ok(Some(found)) => {
            let mut list = Vec::new();
            for (x, multiplicity) in found {
                let Some(x) = rotation(x) else { return undecided("a rotation of a dyad") };
                let shifts = vec![shift(&x)];
                list.push(Root { turns: vec![Number::one(), x], shifts, multiplicity });
            }
            Solved::Roots(list)
        }
    }
}

/// `c0 + u s + v t = 0`: two slides and no rotation.
fn two_slides(c0: &Number, u: &Number, v: &Number) -> Solved {
    let determinant = u.z.mul(&v.w).sub(&u.w.mul(&v.z));
    let off = [c0.z.mul(&v.w).sub(&c0.w.mul(&v.z)), u.z.mul(&c0.w).sub(&u.w.mul(&c0.z))];
    match determinant.vanishes() {
        None => undecided("the angle between two slides"),
        Some(true) => match off[0].vanishes() {
            None => undecided("the distance of two parallel slides"),
            Some(false) => Solved::Roots(Vec::new()),
            Some(true) => {
                let Some(inverse) = u.z.inverse() else { return undecided("the direction of a slide") };
                let shifts = vec![scalar(&c0.z.mul(&inverse).neg()), Number::zero()];
                Solved::Curve(vec![Root { turns: vec![Number::one()], shifts, multiplicity: 1 }])
            }
        },
        Some(false) => {
            let Some(inverse) = determinant.inverse() else { return undecided("the angle between two slides") };
            let shifts = off.iter().map(|x| scalar(&x.mul(&inverse).neg())).collect();
            Solved::Roots(vec![Root { turns: vec![Number::one()], shifts, multiplicity: 1 }])
        }
    }
}
