//! The cycles of a linkage as polynomials over the rationals.
//!
//! The unknowns are the cosine x and the sine y of every class but the first, which is at rest, with `x^2 + y^2 = 1`, and then the
//! slides.

use super::equations::Equations;
use super::isotropic::Isotropic;
use crate::algebra::echelon::Echelon;
use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use num_complex::Complex;
use rug::Rational;

/// A complex number whose parts are polynomials.
pub(super) type Form = Complex<Equation>;

/// Returns the number of unknowns.
pub(super) fn unknowns<N>(equations: &Equations<N>) -> usize {
    2 * equations.classes.saturating_sub(1) + equations.slides.len()
}

/// Returns a number as one whose parts are polynomials.
pub(super) fn constant(z: &Gaussian) -> Form {
    let part = |q: &Rational| Equation::from_rational(q).unwrap_or_else(Equation::zero);
    Form { re: part(&z.re), im: part(&z.im) }
}

/// Returns a power of the rotation of a class: `T_n(x) + i y U_(n-1)(x)`, in which y appears at most once. Class 0 is at rest.
pub(super) fn turned(class: usize, exponent: i32) -> Form {
    if class == 0 {
        return Form::one();
    }
    let (x, y) = (Equation::variable(2 * class - 2), Equation::variable(2 * class - 1));
    let two_x = x.add(&x);
    // T and U of degrees n - 1 and n - 2, n and n - 1.
    let (mut below, mut here) = ((Equation::one(), Equation::zero()), (x, Equation::one()));
    if exponent == 0 {
        here = below.clone();
    }
    for _ in 1..exponent.unsigned_abs() {
        let next = (two_x.mul(&here.0).sub(&below.0), two_x.mul(&here.1).sub(&below.1));
        below = std::mem::replace(&mut here, next);
    }
    let im = here.1.mul(&y);
    Form { re: here.0, im: if exponent < 0 { im.neg() } else { im } }
}

/// Returns the displacement along a slide.
pub(super) fn way(classes: usize, slide: usize) -> Form {
    Form { re: Equation::variable(2 * (classes - 1) + slide), im: Equation::zero() }
}

/// Returns the sums of the cycles, which vanish where they close.
pub(super) fn cycle_forms(equations: &Equations<Isotropic<Gaussian>>) -> Vec<Form> {
    let sum = |(k, cycle): (usize, &Vec<Isotropic<Gaussian>>)| {
        let links = cycle.iter().enumerate().map(|(class, c)| constant(&c.z).mul(&turned(class, 1)));
        let slides = equations.slides.iter().enumerate().map(|(q, slide)| {
            constant(&slide.coefficients[k].z).mul(&turned(slide.class, 1)).mul(&way(equations.classes, q))
        });
        links.chain(slides).fold(Form::zero(), |sum, term| sum.add(&term))
    };
    equations.cycles.iter().enumerate().map(sum).collect()
}

/// Returns `x^2 + y^2 - 1` for every class but the first.
pub(super) fn circles(classes: usize) -> impl Iterator<Item = Equation> {
    (1..classes).map(|class| {
        let Form { re, im } = turned(class, 1);
        re.mul(&re).add(&im.mul(&im)).sub(&Equation::one())
    })
}

/// The cycles of a group as a system over the rationals. Cycles whose slides all stand in the class at rest are linear in cosines, sines
/// and displacements; they are solved, and what they leave free are the unknowns of the system.
#[derive(Clone, Debug)]
pub(super) struct RealSystem {
    /// Number of unknowns.
    pub unknowns: usize,
    /// The rotation of every class: cosine and sine are polynomials in the unknowns.
    pub turns: Vec<Form>,
    /// The displacement along every slide, in parts of the length of its direction.
    pub shifts: Vec<Equation>,
    /// The polynomials that vanish at the assemblies, and at no other values.
    pub equations: Vec<Equation>,
    /// The squares of the rotations of the classes: those of the lengths of bars that stand by these, and 1 of all others.
    pub squares: Vec<Rational>,
    /// Classes that are in no cycle: bodies whose joints coincide. They turn freely, and stand here as they are in the file.
    pub spinning: Vec<usize>,
}

impl RealSystem {
    /// Returns the system of a group of real data; `None` for data of a complex branch, and for more unknowns than a basis may have.
    pub fn of(equations: &Equations<Isotropic<Gaussian>>) -> Option<Self> {
        let equations = &equations.clone().with_lengths();
        if !is_real(equations) {
            return None;
        }
        let is_idle = |class: usize| equations.cycles.iter().all(|cycle| cycle[class].is_zero());
        let held = || (0..equations.classes).find(|class| !is_idle(*class)).unwrap_or(0);
        let rest = equations.slides.first().map_or_else(held, |slide| slide.class);
        // Held, a bar would have the length 1 in place of the root of its square.
        if equations.squares[rest] != 1 {
            return None;
        }
        let is_spinning = |class: &usize| {
            let slides = equations.slides.iter().any(|slide| slide.class == *class);
            *class != rest && !slides && is_idle(*class)
        };
        let spinning: Vec<usize> = (0..equations.classes).filter(is_spinning).collect();
        let still: Vec<usize> = spinning.iter().copied().chain([rest]).collect();
        let columns = Columns::of(equations, &still);
        let is_linear = |k: usize| columns.bent.iter().all(|q| equations.slides[*q].coefficients[k].is_zero());
        let rows = (0..equations.loops()).filter(|k| is_linear(*k)).flat_map(|k| columns.rows(equations, rest, k));
        let solved = Echelon::of(rows.collect(), columns.linear + 1);
        let free: Vec<usize> = solved.free_columns().into_iter().filter(|column| *column < columns.linear).collect();
        let unknowns = free.len() + columns.bent.len();
        if unknowns > MOST_VARIABLES {
            return None;
        }
        let values = solved_columns(&solved, columns.linear, &free);
        let turn = |class: usize| match columns.turns[class] {
            None => Form::one(),
            Some(column) => Form { re: values[column].clone(), im: values[column + 1].clone() },
        };
        let shift = |q: usize| {
            if let Some(column) = columns.straight.iter().position(|own| *own == q) {
                return values[column].clone();
            }
            let place = columns.bent.iter().position(|own| *own == q).unwrap_or(0);
            Equation::variable(free.len() + place)
        };
        let mut system = Self {
            unknowns,
            turns: (0..equations.classes).map(turn).collect(),
            shifts: (0..equations.slides.len()).map(shift).collect(),
            equations: Vec::new(),
            squares: equations.squares.clone(),
            spinning,
        };
        let is_open = equations.angles.iter().any(|gap| !gap.is_zero());
        if is_open || solved.pivots().contains(&columns.linear) {
            // The linear equations contradict one another, or a cycle of slides does not close in its angles.
            system.equations.push(Equation::one());
        }
        let bent = (0..equations.loops()).filter(|k| !is_linear(*k));
        for sum in bent.map(|k| cycle(equations, k, &system.turns, &system.shifts)).collect::<Vec<Form>>() {
            system.equations.extend([sum.re, sum.im]);
        }
        for class in (0..equations.classes).filter(|class| !still.contains(class)) {
            let Form { re, im } = &system.turns[class];
            let square = Equation::from_rational(&equations.squares[class]).unwrap_or_else(Equation::one);
            system.equations.push(re.mul(re).add(&im.mul(im)).sub(&square));
        }
        system.equations.retain(|equation| !equation.is_zero());
        Some(system)
    }
}

/// Returns the sum of a cycle, with the rotations of the classes and the displacements along the slides.
pub(super) fn cycle(equations: &Equations<Isotropic<Gaussian>>, k: usize, turns: &[Form], shifts: &[Equation]) -> Form {
    let links = equations.cycles[k].iter().zip(turns).map(|(c, turn)| constant(&c.z).mul(turn));
    let slides = equations.slides.iter().zip(shifts).map(|(slide, shift)| {
        let way = Form { re: shift.clone(), im: Equation::zero() };
        constant(&slide.coefficients[k].z).mul(&turns[slide.class]).mul(&way)
    });
    links.chain(slides).fold(Form::zero(), |sum, term| sum.add(&term))
}

/// Whether the second half of every number is the conjugate of the first.
pub(super) fn is_real(equations: &Equations<Isotropic<Gaussian>>) -> bool {
    let slides = equations.slides.iter().flat_map(|slide| &slide.coefficients);
    equations.cycles.iter().flatten().chain(slides).all(|number| *number == Isotropic::of(&number.z))
}

/// The columns of the linear equations: the slides of the class at rest, then cosine and sine of every other class, then the constant.
struct Columns {
    /// Slides of the class at rest.
    straight: Vec<usize>,
    /// Slides of classes that turn.
    bent: Vec<usize>,
    /// The column of the cosine of every class; none for classes that stand still.
    turns: Vec<Option<usize>>,
    /// Number of columns without that of the constant.
    linear: usize,
}

impl Columns {
    fn of<N>(equations: &Equations<N>, still: &[usize]) -> Self {
        let (straight, bent): (Vec<usize>, Vec<usize>) =
            (0..equations.slides.len()).partition(|q| still.contains(&equations.slides[*q].class));
        let mut linear = straight.len();
        let mut turns = vec![None; equations.classes];
        for class in (0..equations.classes).filter(|class| !still.contains(class)) {
            turns[class] = Some(linear);
            linear += 2;
        }
        Self { straight, bent, turns, linear }
    }

    /// Real and imaginary part of a cycle without slides of turning classes.
    fn rows(&self, equations: &Equations<Isotropic<Gaussian>>, rest: usize, k: usize) -> [Vec<Rational>; 2] {
        let mut rows = [vec![Rational::new(); self.linear + 1], vec![Rational::new(); self.linear + 1]];
        for (column, q) in self.straight.iter().enumerate() {
            let u = &equations.slides[*q].coefficients[k].z;
            rows[0][column] += &u.re;
            rows[1][column] += &u.im;
        }
        for (number, column) in equations.cycles[k].iter().zip(&self.turns) {
            let c = &number.z;
            if let Some(column) = *column {
                // (re + i im)(x + i y)
                rows[0][column] += &c.re;
                rows[0][column + 1] -= &c.im;
                rows[1][column] += &c.im;
                rows[1][column + 1] += &c.re;
            }
        }
        let fixed = &equations.cycles[k][rest].z;
        rows[0][self.linear] += &fixed.re;
        rows[1][self.linear] += &fixed.im;
        rows
    }
}

/// Every column of solved linear equations in those that are left free, which become the first variables.
fn solved_columns(solved: &Echelon<Rational>, linear: usize, free: &[usize]) -> Vec<Equation> {
    let rational = |q: &Rational| Equation::from_rational(q).unwrap_or_else(Equation::zero);
    let value = |column: usize| {
        if let Some(variable) = free.iter().position(|own| *own == column) {
            return Equation::variable(variable);
        }
        let Some(row) = solved.pivots().iter().position(|pivot| *pivot == column) else { return Equation::zero() };
        let row = &solved.rows()[row];
        let terms =
            free.iter().enumerate().map(|(variable, own)| Equation::variable(variable).mul(&rational(&row[*own])));
        terms.fold(rational(&row[linear]), |sum, term| sum.add(&term)).neg()
    };
    (0..linear).map(value).collect()
}
