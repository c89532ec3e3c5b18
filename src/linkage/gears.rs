//! Groups with pairs of gears.
//!
//! The angle of the second gear is `ratio = p/q` times that of the first, both against the carrier, and a phase. With rotations
//! `a`, `b`, `c` of the first, the second and the carrier this is `b^q c^(p-q) = phase^q a^p`, an equation between monomials: as p
//! and q are coprime, its solutions are exactly the positions that the gears reach when they turn from the phase. Monomials in few
//! unknown rotations fulfil the equations of all gears. Together with the cycles of the group these are a system over the rationals in
//! the cosines x and sines y of the unknown rotations, `x^2 + y^2 = 1`, and in the slides: its Gröbner basis counts the assemblies.

use super::equations::{Closure, Equations};
use super::exact_group::{Decided, solutions};
use super::groups::Group;
use super::isotropic::{Isotropic, Value};
use super::points::EFFORT;
use super::quadratic::Root;
use super::real_motion::moving;
use super::real_system::{Form, RealSystem, constant, cycle, is_real};
use super::state::{Half, Number, State, number};
use super::turn_system::TurnSystem;
use crate::algebra::groebner::{Basis, Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use rug::Rational;

/// Largest sum of the numbers of teeth in lowest terms: monomials of a basis have degrees up to 127.
pub const MOST_TEETH: i32 = 40;

/// Exponents and numbers of factors beyond which products of rotations are not formed: far above those of any ratios that are solved.
const LARGE: i32 = 1 << 12;
/// Largest sum of exponents of a product of rotations: with a slide the degree of an equation is at most 127.
const MOST_DEGREE: i32 = 60;

/// A pair of gears between classes: `sum of exponents[k] times the angle of class k` is the angle of `factor`.
#[derive(Clone, Debug)]
struct Mesh<R> {
    exponents: Vec<i32>,
    factor: Isotropic<R>,
}

/// Returns the numerator and the denominator of a ratio of gears.
///
/// # Errors
/// For numbers above those that are solved.
pub fn teeth(ratio: &Rational) -> Result<(i32, i32)> {
    let both = ratio.numer().to_i32().zip(ratio.denom().to_i32());
    both.filter(|(p, q)| p.saturating_abs().saturating_add(*q) <= MOST_TEETH).ok_or_else(|| {
        Error::Unsupported(format!(
            "gears of the ratio {ratio}: numerator and denominator with a sum above {MOST_TEETH} are not solved yet"
        ))
    })
}

fn power<R: Half>(base: &Isotropic<R>, exponent: i32) -> Isotropic<R> {
    let mut square = if exponent < 0 { base.mirrored() } else { base.clone() };
    let (mut product, mut rest) = (Isotropic::one(), exponent.unsigned_abs());
    while rest > 0 {
        if rest % 2 == 1 {
            product = product.mul(&square);
        }
        rest /= 2;
        if rest > 0 {
            square = square.mul(&square);
        }
    }
    product
}

/// The pair of gears as an equation between the rotations of the classes.
fn mesh<R: Half>(linkage: &Linkage, closure: &Closure<R>, state: &State<R>, gear: usize) -> Option<Mesh<R>> {
    let joint = &linkage.joints[gear];
    let Pair::Gear { carrier, ratio, phase } = &joint.pair else { return None };
    let (p, q) = teeth(ratio).ok()?;
    let mut exponents = vec![0; closure.equations.classes];
    let mut factor = power(&number(phase), q);
    for (body, exponent) in [(joint.of[1], q), (*carrier, p - q), (joint.of[0], -p)] {
        let (class, turn) = closure.class_of(state, body)?;
        exponents[class] += exponent;
        factor = factor.mul(&power(&turn, -exponent));
    }
    // The first class is at rest.
    exponents[0] = 0;
    Some(Mesh { exponents, factor })
}

/// A rotation as a number times powers of unknown rotations.
#[derive(Clone)]
pub(super) struct Power<R = Value> {
    factor: Isotropic<R>,
    /// Number of factors of meshes that are multiplied in `factor`.
    factors: i32,
    /// The exponents of the unknown rotations.
    pub exponents: Vec<i32>,
}

impl<R: Half> Power<R> {
    fn one(unknowns: usize) -> Self {
        Self { factor: Isotropic::one(), factors: 0, exponents: vec![0; unknowns] }
    }

    /// This times a power of another one; `None` where exponents or factors become too many.
    fn times(mut self, other: &Self, exponent: i32) -> Option<Self> {
        let sum = |own: i32, x: i32| own.checked_add(x.checked_mul(exponent)?).filter(|x| x.abs() < LARGE);
        if exponent != 0 {
            for (own, x) in self.exponents.iter_mut().zip(&other.exponents) {
                *own = sum(*own, *x)?;
            }
            let more = other.factors.checked_mul(exponent.checked_abs()?)?;
            self.factors = self.factors.checked_add(more).filter(|count| *count < LARGE)?;
            self.factor = self.factor.mul(&power(&other.factor, exponent));
        }
        Some(self)
    }

    fn degree(&self) -> i32 {
        self.exponents.iter().map(|x| x.abs()).sum()
    }
}

impl Power {
    /// The factor; `None` where it is not rational, or of a complex assembly.
    pub fn number(&self) -> Option<Gaussian> {
        let half = |value: &Value| value.exact.as_ref()?.to_gaussian();
        let factor = half(&self.factor.z)?;
        // Of a complex assembly the second half is another number.
        (half(&self.factor.w)? == Isotropic::of(&factor).w).then_some(factor)
    }
}

/// The rotations of a group by as few unknown ones as pairs of gears leave.
///
/// The exponents of the meshes are an integer matrix. Changes of its columns that have integer inverses are changes of the unknown
/// rotations which lose none and add none. They make the matrix triangular, and where a row ends in 1 its mesh gives a rotation.
pub(super) struct Torus<R = Value> {
    /// The rotation of every class.
    pub turns: Vec<Power<R>>,
    /// What remains of the meshes, each of which is 1: where they determine the unknown rotations, the k-th ends in a power of the k-th.
    pub rest: Vec<Power<R>>,
    /// The number of unknown rotations.
    pub unknowns: usize,
}

impl<R: Half> Torus<R> {
    /// `None` where exponents become too large.
    fn of(meshes: &[Mesh<R>], classes: usize) -> Option<Self> {
        let size = classes - 1;
        let rows: Vec<Vec<i32>> = meshes.iter().map(|mesh| mesh.exponents[1..].to_vec()).collect();
        // The columns of the meshes above those of the rotations of the classes.
        let unit = |k: usize| (0..size).map(move |j| i32::from(j == k));
        let mut columns: Vec<Vec<i32>> =
            (0..size).map(|k| rows.iter().map(|row| row[k]).chain(unit(k)).collect()).collect();
        let subtract = |columns: &mut [Vec<i32>], from: usize, by: usize, times: i32| -> Option<()> {
            for place in 0..rows.len() + size {
                let product = columns[by][place].checked_mul(times)?;
                let left = columns[from][place].checked_sub(product)?;
                columns[from][place] = Some(left).filter(|x| x.abs() < LARGE)?;
            }
            Some(())
        };
        // The column in which each row ends, if it is not one of an earlier row.
        let (mut ends, mut next) = (Vec::new(), 0);
        for row in 0..rows.len() {
            while let Some(least) =
                (next..size).filter(|k| columns[*k][row] != 0).min_by_key(|k| columns[*k][row].abs())
            {
                columns.swap(next, least);
                for other in next + 1..size {
                    let times = columns[other][row] / columns[next][row];
                    subtract(&mut columns, other, next, times)?;
                }
                if (next + 1..size).all(|k| columns[k][row] == 0) {
                    break;
                }
            }
            let is_end = next < size && columns[next][row] != 0;
            ends.push(is_end.then_some(next));
            next += usize::from(is_end);
        }
        shorten(&mut columns, next, rows.len(), subtract)?;
        let solved = |column: usize| {
            let row = ends.iter().position(|end| *end == Some(column))?;
            (columns[column][row].abs() == 1).then_some(row)
        };
        let open: Vec<usize> = (0..size).filter(|column| solved(*column).is_none()).collect();
        let mut parts: Vec<Power<R>> = Vec::new();
        for column in 0..size {
            let mut own = Power::one(open.len());
            if let Some(row) = solved(column) {
                (own.factor, own.factors) = (meshes[row].factor.clone(), 1);
                own = parts.iter().zip(&columns).try_fold(own, |own, (part, column)| own.times(part, -column[row]))?;
                own = Power::one(open.len()).times(&own, columns[column][row])?;
            } else if let Some(place) = open.iter().position(|own| *own == column) {
                own.exponents[place] = 1;
            }
            parts.push(own);
        }
        let product =
            |at: usize| parts.iter().zip(&columns).try_fold(Power::one(open.len()), |own, (p, c)| own.times(p, c[at]));
        let turns = (0..size).map(|class| product(rows.len() + class)).collect::<Option<Vec<_>>>()?;
        let is_left = |row: &usize| ends[*row].is_none_or(|column| solved(column).is_none());
        let mut left: Vec<usize> = (0..rows.len()).filter(is_left).collect();
        left.sort_by_key(|row| ends[*row].unwrap_or(size));
        let rest = left.into_iter().map(|row| {
            let own = product(row)?;
            Some(Power { factor: own.factor.mul(&meshes[row].factor.mirrored()), ..own })
        });
        let torus = Self {
            turns: std::iter::once(Power::one(open.len())).chain(turns).collect(),
            rest: rest.collect::<Option<_>>()?,
            unknowns: open.len(),
        };
        (torus.degree() <= MOST_DEGREE).then_some(torus)
    }

    /// The rotations of all classes as unknown ones, and the meshes as they are.
    fn plain(meshes: &[Mesh<R>], classes: usize) -> Self {
        let size = classes - 1;
        let own = |class: usize| {
            let mut turn = Power::one(size);
            if let Some(place) = class.checked_sub(1) {
                turn.exponents[place] = 1;
            }
            turn
        };
        let rest = |mesh: &Mesh<R>| Power {
            factor: mesh.factor.mirrored(),
            factors: 1,
            exponents: mesh.exponents[1..].to_vec(),
        };
        Self { turns: (0..classes).map(own).collect(), rest: meshes.iter().map(rest).collect(), unknowns: size }
    }

    /// Largest degree of a rotation, or of what remains of a mesh.
    fn degree(&self) -> i32 {
        self.turns.iter().chain(&self.rest).map(Power::degree).max().unwrap_or(0)
    }
}

impl Torus {
    /// The rotations of all classes where meshes alone determine them; `None` where they do not, or where a power is not kept from 0 by its
    /// disc.
    fn roots(&self) -> Option<Vec<Root>> {
        let mut found: Vec<Vec<Number>> = vec![Vec::new()];
        if self.rest.len() != self.unknowns {
            return None;
        }
        for (k, rest) in self.rest.iter().enumerate() {
            let end = rest.exponents[k];
            if end == 0 || rest.exponents[k + 1..].iter().any(|x| *x != 0) {
                return None;
            }
            let mut next = Vec::new();
            for known in found {
                let value = at(rest, &known);
                let value = if end > 0 { value.mirrored() } else { value };
                for z in value.z.disc.roots(end.unsigned_abs())? {
                    let turn = Isotropic { w: Value::within(z.inverse()?), z: Value::within(z) };
                    next.push(known.iter().cloned().chain([turn]).collect());
                }
            }
            found = next;
        }
        let root = |values: Vec<Number>| Root {
            turns: self.turns.iter().map(|turn| at(turn, &values)).collect(),
            shifts: Vec::new(),
            multiplicity: 1,
        };
        Some(found.into_iter().map(root).collect())
    }

    /// The polynomials that vanish at the assemblies; `None` for numbers that are not rational, and for more unknowns than a basis may have.
    fn system(&self, cycles: &Equations<Isotropic<Gaussian>>) -> Option<RealSystem> {
        TurnSystem::of(self, cycles)?.real()
    }
}

/// A product of powers at values of the first unknown ones.
fn at(product: &Power, values: &[Number]) -> Number {
    let terms = product.exponents.iter().zip(values);
    terms.fold(product.factor.clone(), |sum, (x, value)| sum.mul(&power(value, *x)))
}

/// Takes multiples of the columns from `first` on, which no mesh has, from others where that makes them shorter.
fn shorten(
    columns: &mut [Vec<i32>],
    first: usize,
    from: usize,
    subtract: impl Fn(&mut [Vec<i32>], usize, usize, i32) -> Option<()>,
) -> Option<()> {
    let dot =
        |a: &[i32], b: &[i32]| a.iter().zip(b).skip(from).map(|(x, y)| i64::from(*x) * i64::from(*y)).sum::<i64>();
    loop {
        let mut is_shorter = false;
        let size = columns.len();
        for (one, by) in (0..size).flat_map(|one| (first..size).map(move |by| (one, by))) {
            let (product, square) = (dot(&columns[one], &columns[by]), dot(&columns[by], &columns[by]));
            // Rounded to the nearest, halves to zero.
            let times = (2 * product.abs() + square - 1) / (2 * square) * product.signum();
            if one != by && times != 0 {
                subtract(columns, one, by, i32::try_from(times).ok()?)?;
                is_shorter = true;
            }
        }
        if !is_shorter {
            return Some(());
        }
    }
}

fn meshes<R: Half>(linkage: &Linkage, closure: &Closure<R>, group: &Group, state: &State<R>) -> Option<Vec<Mesh<R>>> {
    group.gears.iter().map(|gear| mesh(linkage, closure, state, *gear)).collect()
}

/// The rotations of all classes of a train of gears in which each wheel turns as what drives it says, without a root; `None` of others.
#[must_use]
pub fn driven<R: Half>(
    linkage: &Linkage,
    closure: &Closure<R>,
    group: &Group,
    state: &State<R>,
) -> Option<Vec<Isotropic<R>>> {
    let torus = Torus::of(&meshes(linkage, closure, group, state)?, closure.equations.classes)?;
    if torus.unknowns > 0 || !torus.rest.is_empty() {
        return None;
    }
    is_train(&closure.equations).then(|| torus.turns.into_iter().map(|turn| turn.factor).collect())
}

/// Returns the few unknown rotations where their powers are not higher than those of the meshes, which makes them an advantage.
fn lower<'t>(few: Option<&'t Torus>, plain: &'t Torus) -> &'t Torus {
    few.filter(|few| few.degree() <= plain.degree()).unwrap_or(plain)
}

/// The equations of a part with gears over the rationals. Their solutions are its assemblies, one for one, and those of real assemblies
/// are real.
#[derive(Clone, Debug)]
pub struct GearedEquations {
    /// Number of unknowns.
    pub unknowns: usize,
    /// The polynomials that vanish.
    pub list: Vec<Equation>,
    /// The rotation of every class, and the displacements along slides.
    turns: Vec<Form>,
    shifts: Vec<Equation>,
}

impl GearedEquations {
    /// Returns the equations of a group in a branch; `None` for numbers that are not rational, and for more unknowns than a basis may have.
    #[must_use]
    pub fn of(linkage: &Linkage, closure: &Closure, group: &Group, state: &State) -> Option<Self> {
        let equations = &closure.equations;
        let meshes = meshes(linkage, closure, group, state)?;
        let (few, plain) = (Torus::of(&meshes, equations.classes), Torus::plain(&meshes, equations.classes));
        let torus = lower(few.as_ref(), &plain);
        let system = torus.system(&equations.exact().filter(is_real)?)?;
        Some(Self { unknowns: system.unknowns, list: system.equations, turns: system.turns, shifts: system.shifts })
    }

    /// Returns the two coordinates of a point: the last of cycles that [`Closure::traced`] gives, turned back by the class of the body in
    /// whose coordinates they are.
    #[must_use]
    pub fn place(&self, traced: &Equations<Isotropic<Gaussian>>, base: usize) -> Option<[Equation; 2]> {
        let sum = cycle(traced, traced.loops().checked_sub(1)?, &self.turns, &self.shifts);
        let turn = &self.turns[base];
        let place = sum.mul(&Form { re: turn.re.clone(), im: turn.im.neg() });
        Some([place.re, place.im])
    }

    /// Returns cosine and sine of the angle of a body against another one. Both are given by their class and their rotation against it.
    #[must_use]
    pub fn angle(&self, body: (usize, &Gaussian), against: (usize, &Gaussian)) -> [Equation; 2] {
        let [one, other] = [body, against].map(|(class, own)| self.turns[class].mul(&constant(own)));
        let turn = one.mul(&Form { re: other.re, im: other.im.neg() });
        [turn.re, turn.im]
    }
}

/// What is known of a group with gears.
pub(super) enum Geared {
    /// The assemblies of a train of wheels.
    Wheels(Vec<Root>),
    /// What a basis says.
    Decided(Decided),
    /// Nothing, and why.
    Undecided(String),
}

/// Solves a group with gears.
pub(super) fn geared(linkage: &Linkage, closure: &Closure, group: &Group, state: &State) -> Geared {
    let equations = &closure.equations;
    if let Some(turns) = driven(linkage, closure, group, state) {
        return Geared::Wheels(vec![Root { turns, shifts: Vec::new(), multiplicity: 1 }]);
    }
    let Some(meshes) = meshes(linkage, closure, group, state) else {
        return Geared::Undecided("gears whose bodies are not of one group".to_owned());
    };
    let (few, plain) = (Torus::of(&meshes, equations.classes), Torus::plain(&meshes, equations.classes));
    let cycles = equations.exact().filter(is_real);
    let Some(system) = cycles.as_ref().and_then(|cycles| lower(few.as_ref(), &plain).system(cycles)) else {
        let undecided = || {
            Geared::Undecided(if cycles.is_none() {
                "a group with gears stands on an assembly whose numbers are not rational".to_owned()
            } else {
                format!("a group with gears has numbers that are not rational, or more than {MOST_VARIABLES} unknowns")
            })
        };
        let roots = few.as_ref().filter(|_| is_train(equations)).and_then(Torus::roots);
        return roots.map_or_else(undecided, Geared::Wheels);
    };
    let Some(basis) = Basis::of(system.unknowns, &system.equations, EFFORT) else {
        return Geared::Undecided("the Gröbner basis of a group with gears takes more work than is allowed".to_owned());
    };
    Geared::Decided(match basis.dimension() {
        None => Decided::Finite(Vec::new()),
        Some(0) => match solutions(&system, &basis) {
            Some(list) => Decided::Finite(list),
            None => return Geared::Undecided("the assemblies of a group with gears were not told apart".to_owned()),
        },
        Some(dimension) => Decided::Moving(Box::new(moving(&system, dimension))),
    })
}

/// Whether a group consists of wheels that turn about joints of the rest and of one another.
#[must_use]
pub fn is_train<N>(equations: &Equations<N>) -> bool {
    equations.loops() == 0 && equations.slides.is_empty()
}
