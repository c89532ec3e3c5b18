//! Linkages that are solved dyad by dyad, with their input as an unknown.
//!
//! Variable 0 is the input: its rotation, or its displacement. Every dyad of two assemblies has one unknown rotation y
//! more, and its closure equation is `a y + b + c/y = 0`, in which c is the conjugate of a and b is real for real assemblies. With
//! `J = Im(a y)` the two assemblies of a dyad have opposite signs of J, and `b^2 - 4 a c = -4 J^2`.

use super::answer::LinkageMode;
use super::assembly::groups_of;
use super::equations::Closure;
use super::gears::driven;
use super::isotropic::Isotropic;
use super::laurent::Laurent;
use super::state::{State, place_of, shifted, turned};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use num_complex::Complex;
use rug::Rational;

/// A number of such a linkage.
type Function = Isotropic<Laurent>;

/// The accuracy, relative to the sum of all terms, that values of J must exceed: those of angles in f64 are correct to a thousandth
/// of that.
const CLEAR: f64 = 1e-11;
/// The largest radius of a mode whose signs are asked.
const NARROW: f64 = 1e-13;

/// A body with its rotation against that of its class.
#[derive(Clone, Debug)]
struct Marked {
    body: usize,
    turn: Laurent,
}

/// A dyad of two assemblies.
#[derive(Clone, Debug)]
pub struct Dyad {
    /// The number of its unknown.
    pub variable: usize,
    /// The coefficients a, b and c.
    pub equation: [Laurent; 3],
    /// `b^2 - 4 a c`: negative where two real assemblies exist.
    pub discriminant: Laurent,
    /// The unknown is the rotation of the class of the second against that of the first.
    of: [Marked; 2],
}

/// A linkage of dyads with a running input.
#[derive(Clone, Debug)]
pub struct Dyads {
    /// Whether the input is an angle.
    pub is_turn: bool,
    /// The dyads of two assemblies, in the order in which they are solved.
    pub list: Vec<Dyad>,
}

impl Dyads {
    /// Returns the dyads of a linkage; `None` where a group is none, or where a length in it depends on other unknowns.
    #[must_use]
    pub fn of(linkage: &Linkage, held: &[Given], joint: usize) -> Option<Self> {
        let is_turn = match &linkage.joints[joint].pair {
            Pair::Revolute => true,
            Pair::Prismatic { .. } => false,
            Pair::Gear { .. } => return None,
        };
        let zero = Rational::new();
        let own = if is_turn {
            let turn = Gaussian { re: Rational::from(1), im: zero };
            Given::Turn { joint, turn, within: None, line: 1 }
        } else {
            Given::Shift { joint, shift: zero, square: None, line: 1 }
        };
        let given: Vec<Given> = held.iter().cloned().chain([own]).collect();
        let groups = groups_of(linkage, &given).ok()?;
        let mut state: State<Laurent> = State::new(linkage.bodies.len(), 0);
        for one in held {
            let [a, b] = one.bodies(linkage);
            state.glue(a, b, &place_of(linkage, one)?);
        }
        let place = if is_turn {
            turned(linkage, joint, unknown(0))
        } else {
            let shift = Laurent::power(0, 1);
            shifted(linkage, joint, &Isotropic { z: shift.clone(), w: shift })?
        };
        let [a, b] = linkage.joints[joint].of;
        state.glue(a, b, &place);
        let mut list: Vec<Dyad> = Vec::new();
        for group in &groups.list {
            let closure = Closure::new(linkage, group, &state)?;
            if !group.gears.is_empty() {
                let turns = driven(linkage, &closure, group, &state)?;
                state = closure.assembled(&state, &turns, &[]);
                continue;
            }
            let solved = Solved::of(&closure, list.len() + 1)?;
            if let Some((equation, rest, turning)) = solved.equation {
                let marked = |class: usize| {
                    let mut bodies = 0..linkage.bodies.len();
                    bodies.find_map(|body| {
                        let (own, turn) = closure.class_of(&state, body)?;
                        (own == class).then_some(Marked { body, turn: turn.z })
                    })
                };
                let four = Complex { re: Rational::from(4), im: Rational::new() };
                let [a, b, c] = &equation;
                let discriminant = b.mul(b).sub(&a.mul(c).scale(&four));
                let of = [marked(rest)?, marked(turning)?];
                list.push(Dyad { variable: list.len() + 1, equation, discriminant, of });
            }
            state = closure.assembled(&state, &solved.turns, &solved.shifts);
        }
        Some(Self { is_turn, list })
    }

    /// Returns the sign of J of every dyad in a real assembly at an input, its angle or its displacement in parts of the direction;
    /// `None` where one is too close to 0.
    #[must_use]
    pub fn signs(&self, mode: &LinkageMode, input: f64) -> Option<Vec<bool>> {
        if !(mode.radius < NARROW) {
            return None;
        }
        let first = if self.is_turn { Complex::from_polar(1.0, input) } else { Complex::new(input, 0.0) };
        let mut unknowns = vec![first];
        let mut signs = Vec::new();
        // Rotations whose terms cancel are less accurate, and so is what follows from them.
        let mut loss = 1.0;
        for dyad in &self.list {
            let turn = |marked: &Marked| {
                let body = Complex::from_polar(1.0, mode.bodies[marked.body].0.re);
                let (turn, size) = marked.turn.value(&unknowns);
                (body * turn.conj(), size)
            };
            let [(rest, one), (turning, two)] = [turn(&dyad.of[0]), turn(&dyad.of[1])];
            loss *= one.max(1.0) * two.max(1.0);
            unknowns.push(turning * rest.conj());
            let (value, size) = dyad.equation[0].mul(&Laurent::power(dyad.variable, 1)).value(&unknowns);
            if !(value.im.abs() > CLEAR * size * loss) {
                return None;
            }
            signs.push(value.im > 0.0);
        }
        Some(signs)
    }
}

/// The rotation that is an unknown.
fn unknown(variable: usize) -> Function {
    Isotropic { z: Laurent::power(variable, 1), w: Laurent::power(variable, -1) }
}

/// The inverse of a number both of whose halves are single terms.
fn inverse(number: &Function) -> Option<Function> {
    Some(Isotropic { z: number.z.inverse()?, w: number.w.inverse()? })
}

/// A group solved by its unknown.
struct Solved {
    /// Coefficients of the equation, the class at rest and the one that the unknown turns; none for linear groups.
    equation: Option<([Laurent; 3], usize, usize)>,
    turns: Vec<Function>,
    shifts: Vec<Function>,
}

impl Solved {
    fn of(closure: &Closure<Laurent>, variable: usize) -> Option<Self> {
        let equations = &closure.equations;
        let [c] = equations.cycles.as_slice() else { return None };
        if !equations.angles.iter().all(Ring::is_zero) {
            return None;
        }
        let y = unknown(variable);
        match (equations.classes, equations.slides.as_slice()) {
            (3, []) => {
                // The one length that may depend on other unknowns is at rest.
                let rest = (0..3).find(|k| inverse(&c[*k]).is_none()).unwrap_or(0);
                let [other, turning] = [(rest + 1) % 3, (rest + 2) % 3];
                let [c0, c1, c2] = [&c[rest], &c[other], &c[turning]];
                let x = c0.add(&c2.mul(&y)).mul(&inverse(c1)?).neg();
                let length = |n: &Function| n.z.mul(&n.w);
                let middle = length(c0).add(&length(c2)).sub(&length(c1));
                let equation = [c2.z.mul(&c0.w), middle, c0.z.mul(&c2.w)];
                let mut turns = vec![Function::one(); 3];
                turns[other] = x;
                turns[turning] = y;
                Some(Self { equation: Some((equation, rest, turning)), turns, shifts: Vec::new() })
            }
            (2, [slide]) => {
                let u = &slide.coefficients[0];
                let by = inverse(u)?;
                let (c0, c1) = (&c[0], &c[1]);
                // c0 + c1 y + u s = 0, or c0 + c1 y + u y s = 0 where the slide is fixed in the class that turns.
                let (a, b, c, shift) = if slide.class == 0 {
                    let b = u.w.mul(&c0.z).sub(&u.z.mul(&c0.w));
                    (u.w.mul(&c1.z), b, u.z.mul(&c1.w).neg(), c0.add(&c1.mul(&y)))
                } else {
                    let b = u.z.mul(&c1.w).sub(&u.w.mul(&c1.z));
                    (u.z.mul(&c0.w), b, u.w.mul(&c0.z).neg(), c0.mul(&y.mirrored()).add(c1))
                };
                // Times i: b is real then, and c the conjugate of a.
                let i = Complex { re: Rational::new(), im: Rational::from(1) };
                let equation = [a, b, c].map(|part| part.scale(&i));
                let shift = shift.mul(&by).neg();
                Some(Self { equation: Some((equation, 0, 1)), turns: vec![Function::one(), y], shifts: vec![shift] })
            }
            (1, [one, two]) => {
                let (u, v) = (&one.coefficients[0], &two.coefficients[0]);
                let by = u.z.mul(&v.w).sub(&u.w.mul(&v.z)).inverse()?;
                let off = [c[0].z.mul(&v.w).sub(&c[0].w.mul(&v.z)), u.z.mul(&c[0].w).sub(&u.w.mul(&c[0].z))];
                let shifts = off.map(|x| x.mul(&by).neg()).map(|x| Isotropic { z: x.clone(), w: x });
                Some(Self { equation: None, turns: vec![Function::one()], shifts: shifts.to_vec() })
            }
            _ => None,
        }
    }
}
