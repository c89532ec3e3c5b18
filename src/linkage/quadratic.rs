//! Groups of one cycle: a quadratic equation, or a linear one.

use super::equations::Equations;
use super::isotropic::{Isotropic, Value};
use super::krawczyk::conjugate;
use super::polynomial::turned;
use super::state::{Half, number};
use super::straight::{open_angles, slides_alone};
use super::tower::Surd;
use crate::algebra::ring::Ring;
use rug::Rational;

/// A solution of a group: the rotations of its classes, the first of which is 1, and the displacements of its slides.
#[derive(Clone, Debug)]
pub struct Root<R = Value> {
    /// One for every class.
    pub turns: Vec<Isotropic<R>>,
    /// One for every slide, in parts of the length of its direction.
    pub shifts: Vec<Isotropic<R>>,
    /// The multiplicity.
    pub multiplicity: usize,
}

/// The solutions of a group in one branch.
#[derive(Clone, Debug)]
pub enum Solved<R = Value> {
    /// All of them.
    Roots(Vec<Root<R>>),
    /// Solutions that are not isolated.
    Moving(Moving<R>),
    /// The question that is left undecided.
    Undecided(String),
}

/// Solutions of a group that move from one to another.
#[derive(Clone, Debug)]
pub struct Moving<R = Value> {
    /// Some of them.
    pub samples: Vec<Root<R>>,
    /// For every freedom what it moves: 1 for every class and then every slide that moves, 0 for those at rest.
    pub ways: Vec<Vec<f64>>,
}

/// The tower of square roots of a branch.
#[derive(Clone, Debug)]
pub struct Top {
    /// A number whose tower holds all others.
    pub number: Surd,
    /// Towers are not built of more generators than this: beyond, discs are all that is known.
    pub highest: usize,
}

/// Half a number of which may be known whether it is zero.
pub trait Decidable: Half {
    /// Returns whether it is zero; `None` where that is undecided.
    fn vanishes(&self) -> Option<bool>;
    /// Returns the inverse; `None` where it may be zero.
    fn inverse(&self) -> Option<Self>;
    /// Returns a square root of a number that is not zero; `None` where it may be zero. `tower` holds all numbers of the branch.
    fn square_root(&self, tower: &Top) -> Option<Self>;
    /// Returns the conjugate.
    #[must_use]
    fn conjugate(&self) -> Self;
    /// Returns the number itself, where it is known.
    fn exact(&self) -> Option<&Surd> {
        None
    }
}

impl Decidable for Value {
    fn vanishes(&self) -> Option<bool> {
        self.vanishes()
    }
    fn inverse(&self) -> Option<Self> {
        self.inverse()
    }
    fn square_root(&self, tower: &Top) -> Option<Self> {
        let root = self.disc.sqrt()?;
        let exact = self.exact.as_ref().map(|exact| exact.lifted(&tower.number));
        let exact = exact.filter(|exact| exact.height() <= tower.highest).map(|exact| exact.square_root(&root));
        let exact = exact.filter(|exact| exact.height() <= tower.highest);
        // The disc of the exact root may be the one of the other sign: it is the datum then.
        let disc = exact.as_ref().map_or(root, Surd::disc);
        Some(Self { disc, exact })
    }
    fn conjugate(&self) -> Self {
        Self::within(conjugate(&self.disc))
    }
    fn exact(&self) -> Option<&Surd> {
        self.exact.as_ref()
    }
}

impl Top {
    /// Takes in the towers of the numbers of a root.
    pub fn hold<R: Decidable>(&mut self, root: &Root<R>) {
        // The number whose tower is the highest holds all others.
        for exact in root.turns.iter().chain(&root.shifts).filter_map(|number| number.z.exact()) {
            self.number = self.number.lifted(exact);
        }
    }
}

/// A number that is the same in both halves.
pub(super) fn scalar<R: Decidable>(value: &R) -> Isotropic<R> {
    Isotropic { z: value.clone(), w: value.clone() }
}

/// A rotation from its first half, which is not zero.
fn rotation<R: Decidable>(z: R) -> Option<Isotropic<R>> {
    let w = z.inverse()?;
    Some(Isotropic { z, w })
}

/// Rotations at which a curve is looked at: the first of them may be a special one, at which what stands on it does not close.
fn samples<R: Decidable>() -> [Isotropic<R>; 3] {
    [0, 2, 5].map(|k| number(&turned(k).z))
}

pub(super) fn undecided<R>(what: &str) -> Solved<R> {
    Solved::Undecided(format!("{what} is neither proved zero nor proved not to be"))
}

/// The roots of `a x^2 + b x + c` that are neither zero nor infinite, with their multiplicities; `Err` where a
/// coefficient or the discriminant is not decided, `None` where all coefficients are zero.
fn roots<R: Decidable>(a: &R, b: &R, c: &R, tower: &Top) -> Result<Option<Vec<(R, usize)>>, &'static str> {
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
    let four = R::from_integer(4);
    let discriminant = b.mul(b).sub(&four.mul(a).mul(c));
    let two_a = a.add(a).inverse().ok_or("the leading coefficient of a dyad")?;
    match discriminant.vanishes() {
        None => Err("the discriminant of a dyad"),
        Some(true) => Ok(Some(vec![(b.neg().mul(&two_a), 2)])),
        Some(false) => {
            let root = discriminant.square_root(tower).ok_or("the discriminant of a dyad")?;
            Ok(Some(vec![(root.sub(b).mul(&two_a), 1), (root.neg().sub(b).mul(&two_a), 1)]))
        }
    }
}

/// Solves a group of one cycle. `tower` holds all numbers.
#[must_use]
pub fn one_cycle<R: Decidable>(equations: &Equations<Isotropic<R>>, tower: &Top) -> Solved<R> {
    if let Some(open) = open_angles(equations) {
        return open;
    }
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
        (1, _) => slides_alone(equations),
        _ => Solved::Undecided("this group of one cycle has no known form".to_owned()),
    }
}

/// `c0 + c1 x + c2 y = 0` with rotations x and y.
fn three_turns<R: Decidable>(c: &[Isotropic<R>], tower: &Top) -> Solved<R> {
    let length = |n: &Isotropic<R>| n.z.mul(&n.w);
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
        list.push(Root { turns: vec![Isotropic::one(), x, y], shifts: Vec::new(), multiplicity });
    }
    Solved::Roots(list)
}

/// A dyad of which some joints coincide.
fn coincident<R: Decidable>(c: &[Isotropic<R>], zero: [bool; 3]) -> Solved<R> {
    // On complex branches one half of a number may be zero alone; such assemblies are not decided here.
    if c.iter().zip(zero).any(|(n, zero)| zero && !n.is_zero()) {
        return undecided("half of a complex distance");
    }
    let square = |n: &Isotropic<R>| n.z.mul(&n.w);
    // The rotations, and whether each turns along the curve.
    let curve = |x: Isotropic<R>, y: Isotropic<R>, turns: [bool; 2]| {
        let turned = |n: &Isotropic<R>, by: &Isotropic<R>, turns: bool| if turns { n.mul(by) } else { n.clone() };
        let one = |by: Isotropic<R>| {
            let turns = vec![Isotropic::one(), turned(&x, &by, turns[0]), turned(&y, &by, turns[1])];
            Root { turns, shifts: Vec::new(), multiplicity: 1 }
        };
        let turning: Vec<usize> = (0..2).filter(|k| turns[*k]).map(|k| k + 1).collect();
        let flag = |class: usize, moving: &[usize]| f64::from(u8::from(moving.contains(&class)));
        let way = |moving: &[usize]| (0..3).map(|class| flag(class, moving)).collect();
        // Where all three joints coincide, both links turn by themselves.
        let ways = if zero == [true; 3] { vec![way(&[1]), way(&[2])] } else { vec![way(&turning)] };
        Solved::Moving(Moving { samples: samples().map(one).to_vec(), ways })
    };
    let same = |a: usize, b: usize| square(&c[a]).sub(&square(&c[b])).vanishes();
    let quotient = |a: usize, b: usize| c[b].z.inverse().map(|inverse| c[a].z.mul(&inverse).neg()).and_then(rotation);
    match zero {
        [true, true, true] => curve(Isotropic::one(), Isotropic::one(), [true, false]),
        [true, false, false] => match same(1, 2) {
            None => undecided("the difference of two lengths of a dyad"),
            Some(false) => Solved::Roots(Vec::new()),
            Some(true) => match quotient(2, 1) {
                Some(x) => curve(x, Isotropic::one(), [true, true]),
                None => undecided("a length of a dyad"),
            },
        },
        [false, true, false] | [false, false, true] => {
            let other = if zero[1] { 2 } else { 1 };
            match same(0, other) {
                None => undecided("the difference of two lengths of a dyad"),
                Some(false) => Solved::Roots(Vec::new()),
                Some(true) => match quotient(0, other) {
                    Some(turn) if other == 2 => curve(Isotropic::one(), turn, [true, false]),
                    Some(turn) => curve(turn, Isotropic::one(), [false, true]),
                    None => undecided("a length of a dyad"),
                },
            }
        }
        // One distance alone is never bridged.
        _ => Solved::Roots(Vec::new()),
    }
}

/// `c0 + c1 x + u s = 0`: the slide is fixed in the first class.
fn turn_and_slide<R: Decidable>(c0: &Isotropic<R>, c1: &Isotropic<R>, u: &Isotropic<R>, tower: &Top) -> Solved<R> {
    let middle = u.w.mul(&c0.z).sub(&u.z.mul(&c0.w));
    let (a, c) = (u.w.mul(&c1.z), u.z.mul(&c1.w).neg());
    let Some(inverse) = u.z.inverse() else { return undecided("the direction of a slide") };
    let shift = |x: &Isotropic<R>| scalar(&c0.z.add(&c1.z.mul(&x.z)).mul(&inverse).neg());
    with_slide(roots(&a, &middle, &c, tower), c0, shift, &inverse)
}

/// `c0 + c1 x + u x s = 0`: the slide is fixed in the class that turns.
fn slide_on_turn<R: Decidable>(c0: &Isotropic<R>, c1: &Isotropic<R>, u: &Isotropic<R>, tower: &Top) -> Solved<R> {
    let middle = u.z.mul(&c1.w).sub(&u.w.mul(&c1.z));
    let (a, c) = (u.z.mul(&c0.w), u.w.mul(&c0.z).neg());
    let Some(inverse) = u.z.inverse() else { return undecided("the direction of a slide") };
    let shift = |x: &Isotropic<R>| scalar(&c0.z.mul(&x.w).add(&c1.z).mul(&inverse).neg());
    with_slide(roots(&a, &middle, &c, tower), c1, shift, &inverse)
}

/// The solutions with one rotation and one slide. Where the rotation is free, the slide is given by the number `fixed`.
fn with_slide<R: Decidable>(
    found: Result<Option<Vec<(R, usize)>>, &'static str>,
    fixed: &Isotropic<R>,
    shift: impl Fn(&Isotropic<R>) -> Isotropic<R>,
    inverse: &R,
) -> Solved<R> {
    match found {
        Err(what) => undecided(what),
        Ok(None) => {
            let shifts = vec![scalar(&fixed.z.mul(inverse).neg())];
            let one =
                |by: Isotropic<R>| Root { turns: vec![Isotropic::one(), by], shifts: shifts.clone(), multiplicity: 1 };
            // The link turns alone, about a pin that the slide holds at the other one.
            Solved::Moving(Moving { samples: samples().map(one).to_vec(), ways: vec![vec![0.0, 1.0, 0.0]] })
        }
        Ok(Some(found)) => {
            let mut list = Vec::new();
            for (x, multiplicity) in found {
                let Some(x) = rotation(x) else { return undecided("a rotation of a dyad") };
                let shifts = vec![shift(&x)];
                list.push(Root { turns: vec![Isotropic::one(), x], shifts, multiplicity });
            }
            Solved::Roots(list)
        }
    }
}

/// Returns whether each root of a group with real data is real: its mirror image is a root, too. `None` where this is undecided. `squares` are
/// those of the lengths of bars, by class.
#[must_use]
pub fn realness<R: Decidable>(roots: &[Root<R>], squares: &[Rational]) -> Vec<Option<bool>> {
    let all = |root: &Root<R>| root.turns.iter().chain(&root.shifts).cloned().collect::<Vec<Isotropic<R>>>();
    let apart = |one: &[Isotropic<R>], two: &[Isotropic<R>]| {
        one.iter().zip(two).any(|(a, b)| a.z.sub(&b.z).vanishes() == Some(false))
    };
    let roots: Vec<Vec<Isotropic<R>>> = roots.iter().map(all).collect();
    // The mirror image of a number is the one of the conjugate assembly.
    let mirrored = |number: &Isotropic<R>| Isotropic { z: number.w.conjugate(), w: number.z.conjugate() };
    let one = |k: usize| {
        let mut image: Vec<Isotropic<R>> = roots[k].iter().map(mirrored).collect();
        for (turn, square) in image.iter_mut().zip(squares).filter(|(_, square)| **square != 1) {
            let [over, by] = [Rational::from(square.recip_ref()), square.clone()]
                .map(|q| R::from_rational(&q).unwrap_or_else(R::one));
            *turn = Isotropic { z: turn.z.mul(&over), w: turn.w.mul(&by) };
        }
        if apart(&image, &roots[k]) {
            return Some(false);
        }
        (0..roots.len()).filter(|j| *j != k).all(|j| apart(&image, &roots[j])).then_some(true)
    };
    (0..roots.len()).map(one).collect()
}
