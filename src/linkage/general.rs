//! Groups of several cycles with rational data: the closure polynomial gives all rotations of one class, the kernel of the
//! pencil the others, and every solution is proved by itself.

use super::equations::Equations;
use super::isotropic::{BITS, Isotropic, disc_of, middle};
use super::krawczyk::{Proved, prove};
use super::pencil::{Parameter, Pencil};
use super::polynomial::{ClosurePolynomial, closure_polynomial, turned};
use super::quadratic::Root;
use super::state::Number;
use crate::algebra::determinant::determinant;
use crate::algebra::disc::Disc;
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::ModP;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::exact::{Isolated, isolated_roots};
use crate::kinematics::linkage::Gaussian;
use crate::solve::hessenberg::Hessenberg;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;
use rug::{Float, Rational};

/// Rotations of the hidden class tried to keep the half turn from being a root.
const TURNS: u32 = 8;
/// Pairs of classes at rest and hidden whose determinants are compared: all of a group of nine bodies.
const PAIRS: usize = 40;
/// Roots of a choice from which 512 bits lead on where f64 does not: a tenth of a second for each of 70 rows.
const MOST_PRECISE: usize = 12;
/// Number of choices whose polynomials are computed until every root of one of them is a solution.
const TRIES: usize = 3;

/// The solutions found for a group of several cycles.
#[derive(Clone, Debug)]
pub struct Found {
    /// The solutions that were proved.
    pub solutions: Vec<Proved>,
    /// Upper bound on the number of solutions, with multiplicity; `None` where it is not known.
    pub most: Option<usize>,
    /// Rows of the matrix.
    pub size: usize,
    /// Why the list may not be complete.
    pub doubt: Option<String>,
    /// The choices that were made.
    pub choices: Vec<Choice>,
    /// The classes at rest and hidden of a choice whose roots all led to solutions of their own; for numbers that are not rational, of the
    /// rational ones near them.
    pub met: Option<(usize, usize)>,
}

impl Found {
    fn nothing(doubt: &str) -> Self {
        Self {
            solutions: Vec::new(),
            most: None,
            size: 0,
            doubt: Some(doubt.to_owned()),
            choices: Vec::new(),
            met: None,
        }
    }
}

/// A choice of classes with its matrix and polynomial.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The class at rest.
    pub rest: usize,
    /// The class whose rotation is hidden.
    pub hidden: usize,
    pub(super) pencil: Pencil<Gaussian>,
    /// The closure polynomial in the half tangent of the hidden class, less a turn.
    pub found: ClosurePolynomial,
    turn: Isotropic<Gaussian>,
}

impl Choice {
    /// The hidden rotation at a rational root of the closure polynomial.
    #[must_use]
    pub fn rotation(&self, t: &Rational) -> Gaussian {
        let square = Rational::from(t * t);
        let length = Rational::from(&square + 1);
        let own = Gaussian { re: (1 - square) / &length, im: Rational::from(t * 2_u32) / &length };
        own.mul(&self.turn.z)
    }

    /// The hidden rotation at a root of the closure polynomial.
    fn hidden_at(&self, t: &Disc) -> Option<Disc> {
        let turned = t.mul(&Disc::point(Float::new(BITS), Float::with_val(BITS, 1)));
        let one = Disc::of(&Rational::from(1), BITS);
        Some(one.add(&turned).mul(&one.sub(&turned).inverse()?).mul(&disc_of(&self.turn.z)))
    }

    /// The classes whose rotations a vector of the kernel does not tell: those that are not the difference of two sets.
    fn untold(&self) -> Vec<usize> {
        let is_untold = |(j, _): &(usize, &usize)| self.pencil.pairs(*j).is_empty();
        self.pencil.classes.iter().enumerate().filter(is_untold).map(|(_, class)| *class).collect()
    }

    /// Whether a vector of the kernel tells all rotations, or all that there is to tell.
    pub(super) fn tells(&self, equations: &Equations<Isotropic<Gaussian>>) -> bool {
        self.untold().is_empty() || self.tells_all(equations)
    }

    /// Whether a vector of the kernel tells all rotations and displacements: what it does not tell itself follows from the cycles, as
    /// the coefficients there are independent.
    #[must_use]
    pub fn tells_all(&self, equations: &Equations<Isotropic<Gaussian>>) -> bool {
        let untold = self.untold();
        let turns = untold.iter().map(|class| equations.cycles.iter().map(|cycle| cycle[*class].z.clone()).collect());
        let slides = equations.slides.iter().map(|slide| slide.coefficients.iter().map(|n| n.z.clone()).collect());
        let rows: Vec<Vec<Gaussian>> = turns.chain(slides).collect();
        let count = rows.len();
        Echelon::of(rows, equations.loops()).rank() == count
    }
}

/// Solves a group.
#[must_use]
pub fn general(equations: &Equations<Number>) -> Found {
    with_choices(equations, TRIES)
}

/// Solves a group by at most so many choices of a hidden class.
pub(super) fn with_choices(equations: &Equations<Number>, most: usize) -> Found {
    let known = equations.exact();
    let is_rounded = known.is_none();
    let Some(exact) = known.or_else(|| equations.rounded()) else {
        return Found::nothing("no approximation of the data");
    };
    let approximate = exact.map(|n| Some(n.map(|z| Complex::new(z.re.to_f64(), z.im.to_f64()))));
    let Some(approximate) = approximate else { return Found::nothing("no approximation of the data") };
    let mut found =
        Found::nothing("the matrix of the group is singular for every choice of a hidden body, or has no square form");
    // Roots of one choice that lead nowhere may be no roots of another, or lead on from there.
    // Where a vector leaves rotations open, two assemblies may have the same one.
    let choices = ranked(&exact).into_iter().filter_map(|(rest, hidden)| choice(&exact, rest, hidden));
    for choice in choices.filter(|choice| choice.tells(&exact)).take(most) {
        let (rest, hidden) = (choice.rest, choice.hidden);
        extend(&mut found, equations, &approximate, &choice);
        if found.most == Some(found.solutions.len()) {
            found.doubt = None;
            found.met = Some((rest, hidden));
            break;
        }
        found.choices.push(choice);
    }
    if is_rounded {
        // The solutions were proved for the numbers themselves; all else is said of those near them.
        (found.most, found.choices) = (None, Vec::new());
        found.doubt = Some(
            "a group of several loops stands on an assembly whose numbers are not rational: solutions were looked for near those \
             of rational numbers, and others may exist"
                .to_owned(),
        );
    }
    found
}

/// Adds the solutions to which the roots of a choice lead, and the bound that is their number.
fn extend(
    found: &mut Found,
    equations: &Equations<Number>,
    approximate: &Equations<Isotropic<Complex<f64>>>,
    choice: &Choice,
) {
    if found.size == 0 {
        found.size = choice.found.size;
    }
    let degree = choice.found.polynomial.degree().unwrap_or(0);
    let square_free = choice.found.polynomial.square_free_part();
    let Some(roots) = hidden_rotations(&square_free) else {
        if found.most.is_none() {
            found.doubt = Some("the roots of the closure polynomial were not told apart".to_owned());
        }
        return;
    };
    let rational = choice.found.polynomial.map(|c| Some(Rational::from(c))).unwrap_or_else(Univariate::zero);
    let repeated = rational.gcd(&rational.derivative());
    let (mut led, mut precise) = (0, 0);
    for t in roots {
        let x = choice.hidden_at(&t);
        let Some(x) = x else { continue };
        let proved = |kernel: Option<DVector<Complex<f64>>>| {
            let (turns, shifts) = start(choice, approximate, middle(&x), &kernel?)?;
            prove(equations, choice.rest, &turns, &shifts)
        };
        let is_new =
            |proved: &Proved, found: &Found| found.solutions.iter().all(|known| differ(known, proved, choice.rest));
        let first = proved(approximate_kernel(choice, middle(&x)));
        led += usize::from(first.is_some());
        let mut fresh = first.filter(|one| is_new(one, found));
        // Beside a double root f64 has too few digits, and may lead twice to the same assembly.
        let is_simple = || t.evaluate(repeated.coefficients()).is_not_zero();
        if fresh.is_none() && precise < MOST_PRECISE && is_simple() {
            precise += 1;
            fresh = proved(precise_kernel(choice, &x)).filter(|one| is_new(one, found));
        }
        found.solutions.extend(fresh);
    }
    let distinct = square_free.degree().unwrap_or(0);
    let multiple = degree - distinct;
    if found.most.is_none_or(|most| degree <= most) {
        found.most = Some(degree);
        found.doubt = Some(if multiple > 0 && led == distinct {
            format!("{multiple} roots of the closure polynomial are repetitions of others")
        } else {
            let lost = degree.saturating_sub(found.solutions.len());
            format!("{lost} roots of the closure polynomial belong to no solution that was proved")
        });
    }
}

/// Whether two solutions are proved to be different: by rotations against the class `rest`, and by slides.
pub(super) fn differ(one: &Proved, two: &Proved, rest: usize) -> bool {
    let apart = |a: &Number, b: &Number| a.z.disc.sub(&b.z.disc).is_not_zero();
    let (one, two) = (&one.root, &two.root);
    let against = |root: &Root| -> Vec<Number> {
        let back = root.turns[rest].mirrored();
        root.turns.iter().map(|turn| turn.mul(&back)).collect()
    };
    against(one).iter().zip(&against(two)).any(|(a, b)| apart(a, b))
        || one.shifts.iter().zip(&two.shifts).any(|(a, b)| apart(a, b))
}

/// Returns the least number of rows of a pencil of a group of several cycles; `None` where there is no pencil.
#[must_use]
pub(super) fn least_rows(exact: &Equations<Isotropic<Gaussian>>) -> Option<usize> {
    pencils(exact).first().map(|(_, _, pencil)| pencil.sets.len())
}

/// Cycles up to which slides may turn in a pencil: with more, its sets are not listed in a second.
const FEW_CYCLES_OF_SLIDES: usize = 4;

/// The pencils modulo a prime for all classes at rest and hidden, the smallest first.
fn pencils(exact: &Equations<Isotropic<Gaussian>>) -> Vec<(usize, usize, Pencil<Residue>)> {
    let first = exact.slides.first().map(|slide| slide.class);
    // One class with slides rests.
    if exact.loops() > FEW_CYCLES_OF_SLIDES && exact.slides.iter().any(|slide| Some(slide.class) != first) {
        return Vec::new();
    }
    let residues = exact.map(|n| Some(Isotropic { z: residue(&n.z)?, w: residue(&n.w)? }));
    let Some(residues) = residues else { return Vec::new() };
    let classes = 0..exact.classes;
    let pairs = classes.clone().flat_map(|rest| classes.clone().map(move |hidden| (rest, hidden)));
    let pairs = pairs.filter(|(a, b)| a != b);
    // Without slides it makes no difference which class rests and which is hidden.
    let pairs = pairs.filter(|(a, b)| a < b || !exact.slides.is_empty());
    let mut pencils: Vec<(usize, usize, Pencil<Residue>)> = pairs
        .filter_map(|(rest, hidden)| Some((rest, hidden, Pencil::new(&residues, rest, &[Parameter::Turn(hidden)])?)))
        .collect();
    pencils.retain(|(_, _, pencil)| !pencil.sets.is_empty());
    sort::by_key(&mut pencils, |(_, _, pencil)| pencil.sets.len());
    pencils
}

/// Classes at rest and hidden, those whose determinant has the fewest roots modulo a prime first.
fn ranked(exact: &Equations<Isotropic<Gaussian>>) -> Vec<(usize, usize)> {
    let mut ranked: Vec<(usize, usize, usize)> = Vec::new();
    for (rest, hidden, pencil) in &pencils(exact) {
        if ranked.len() >= PAIRS {
            break;
        }
        if let Some(degree) = torus_degree(pencil) {
            ranked.push((degree, *rest, *hidden));
        }
    }
    sort::by_key(&mut ranked, |(degree, ..)| *degree);
    ranked.into_iter().map(|(_, rest, hidden)| (rest, hidden)).collect()
}

/// A prime congruent to 1 modulo 4, and a root of -1 modulo it.
const PRIME: u64 = 2_305_843_009_213_693_921;
const ROOT_OF_MINUS_ONE: u64 = 583_529_827_753_931_384;

/// A number modulo a prime that has a square root of -1.
pub type Residue = ModP<PRIME>;

/// The image of an exact complex number modulo the prime.
#[must_use]
pub fn residue(z: &Gaussian) -> Option<Residue> {
    Some(Residue::from_rational(&z.re)?.add(&Residue::new(ROOT_OF_MINUS_ONE).mul(&Residue::from_rational(&z.im)?)))
}

/// Returns the number of roots, neither zero nor infinite, of the determinant of a pencil with one rotation as parameter, modulo
/// the prime; `None` where it vanishes.
#[must_use]
pub fn torus_degree(pencil: &Pencil<Residue>) -> Option<usize> {
    let polynomial = linear_determinant(pencil).or_else(|| interpolated_determinant(pencil))?;
    let lowest = polynomial.coefficients().iter().position(|c| !c.is_zero())?;
    Some(polynomial.degree()? - lowest)
}

/// Values of x at which a matrix that is singular for none or few of them is tried.
const SHIFTS: u64 = 4;

/// The determinant up to a factor where no row depends on both x and 1/x: those with 1/x are multiplied by x, and with
/// M(x) = M(s) + (x - s) M' it is a multiple of the characteristic polynomial of M(s)^-1 M', reversed.
fn linear_determinant(pencil: &Pencil<Residue>) -> Option<Univariate<Residue>> {
    let size = pencil.sets.len();
    let mut constant = vec![vec![Residue::zero(); size]; size];
    let mut slope = constant.clone();
    for (k, row) in pencil.rows.iter().enumerate() {
        let has = |half: usize| row.entries.iter().any(|entry| !entry.by[0][half].is_zero());
        let (rest, first) = if has(1) { (&mut slope, &mut constant) } else { (&mut constant, &mut slope) };
        if has(0) && has(1) {
            return None;
        }
        for entry in &row.entries {
            first[k][entry.column] = entry.by[0][0].add(&entry.by[0][1]);
            rest[k][entry.column] = entry.constant;
        }
        for (column, factor) in &row.others {
            rest[k][*column] = *factor;
        }
    }
    let (start, quotient) = (2..2 + SHIFTS).find_map(|k| {
        let start = Residue::new(k);
        let at = |i: usize, j: usize| constant[i][j].add(&start.mul(&slope[i][j]));
        let matrix = (0..size).map(|i| (0..size).map(|j| at(i, j)).collect()).collect();
        Some((start, quotient(matrix, slope.clone())?))
    })?;
    // det(1 + y N) has the coefficients of det(z - N) from the other end, with changing signs.
    let characteristic = Hessenberg::of(quotient).characteristic();
    let reversed = characteristic.coefficients().iter().rev().enumerate();
    let coefficients = reversed.map(|(k, c)| if k % 2 == 1 { c.neg() } else { *c }).collect();
    let step = Univariate::new(vec![start.neg(), Residue::one()]);
    let shifted: Univariate<Residue> = Univariate::new(coefficients);
    Some(
        shifted
            .coefficients()
            .iter()
            .rev()
            .fold(Univariate::zero(), |sum, c| sum.mul(&step).add(&Univariate::constant(*c))),
    )
}

/// `A^-1 B`; `None` where A is singular.
fn quotient(mut a: Vec<Vec<Residue>>, mut b: Vec<Vec<Residue>>) -> Option<Vec<Vec<Residue>>> {
    let size = a.len();
    for k in 0..size {
        let row = (k..size).find(|i| !a[*i][k].is_zero())?;
        a.swap(row, k);
        b.swap(row, k);
        let inverse = a[k][k].inverse()?;
        for x in a[k].iter_mut().chain(b[k].iter_mut()) {
            *x = x.mul(&inverse);
        }
        let (pivot, right) = (a[k].clone(), b[k].clone());
        for i in (0..size).filter(|i| *i != k) {
            let factor = a[i][k];
            if factor.is_zero() {
                continue;
            }
            for (x, y) in a[i].iter_mut().zip(&pivot).skip(k).chain(b[i].iter_mut().zip(&right)) {
                *x = x.sub(&factor.mul(y));
            }
        }
    }
    Some(b)
}

/// The determinant times a power of x from its values.
fn interpolated_determinant(pencil: &Pencil<Residue>) -> Option<Univariate<Residue>> {
    let size = pencil.sets.len();
    let points = (1..=2 * size as u64 + 1).map(|k| {
        let x = Residue::new(k);
        let inverse = x.inverse()?;
        let power = (0..size).fold(Residue::one(), |power, _| power.mul(&x));
        Some((x, determinant(&pencil.at(&[[x, inverse]])).mul(&power)))
    });
    Some(Univariate::interpolate(&points.collect::<Option<Vec<_>>>()?))
}

/// The polynomial of a choice, its hidden class turned until the half turn is no root.
pub(super) fn choice(exact: &Equations<Isotropic<Gaussian>>, rest: usize, hidden: usize) -> Option<Choice> {
    let pencil = Pencil::new(exact, rest, &[Parameter::Turn(hidden)])?;
    for k in 0..TURNS {
        let turn = turned(k);
        let found = if k == 0 {
            closure_polynomial(&pencil)?
        } else {
            let mut rotated = exact.clone();
            for cycle in &mut rotated.cycles {
                cycle[hidden] = cycle[hidden].mul(&turn);
            }
            closure_polynomial(&Pencil::new(&rotated, rest, &[Parameter::Turn(hidden)])?)?
        };
        if found.at_pi == 0 {
            // The kernel is that of the matrix in the rotation of the class itself.
            return Some(Choice { rest, hidden, pencil, found, turn });
        }
    }
    None
}

/// Returns discs of all roots; `None` where no precision separates them.
fn hidden_rotations(square_free: &Univariate<rug::Integer>) -> Option<Vec<Disc>> {
    fn middles<const BITS: u32>(roots: &[Isolated<BITS>]) -> Vec<Disc> {
        let disc =
            |root: &Isolated<BITS>| Disc::new(root.ball.re().clone(), root.ball.im().clone(), root.ball.radius());
        roots.iter().map(disc).collect()
    }
    let short = isolated_roots::<512>(square_free).map(|roots| middles(&roots));
    short.or_else(|| isolated_roots::<1024>(square_free).map(|roots| middles(&roots)))
}

/// Approximate rotations of all classes and slides.
type Start = (Vec<Complex<f64>>, Vec<Complex<f64>>);

/// A vector that the matrix at a value of the hidden rotation nearly takes to zero, in f64.
fn approximate_kernel(choice: &Choice, x: Complex<f64>) -> Option<DVector<Complex<f64>>> {
    let size = choice.pencil.sets.len();
    let narrow = |z: &Gaussian| Complex::new(z.re.to_f64(), z.im.to_f64());
    let mut matrix = DMatrix::from_element(size, size, Complex::new(0.0, 0.0));
    for (k, row) in choice.pencil.rows.iter().enumerate() {
        for entry in &row.entries {
            let [by, inverse] = entry.by[0].each_ref().map(narrow);
            matrix[(k, entry.column)] = narrow(&entry.constant) + by * x + inverse / x;
        }
        for (column, factor) in &row.others {
            matrix[(k, *column)] = narrow(factor);
        }
        let largest = (0..size).map(|j| matrix[(k, j)].norm()).fold(f64::MIN_POSITIVE, f64::max);
        for j in 0..size {
            matrix[(k, j)] /= largest;
        }
    }
    kernel(matrix)
}

/// As [`approximate_kernel`], by elimination with all digits of the hidden rotation.
fn precise_kernel(choice: &Choice, x: &Disc) -> Option<DVector<Complex<f64>>> {
    let size = choice.pencil.sets.len();
    let back = x.inverse()?;
    let mut matrix = vec![vec![Disc::zero(); size]; size];
    for (k, row) in choice.pencil.rows.iter().enumerate() {
        for entry in &row.entries {
            let [by, inverse] = entry.by[0].each_ref().map(disc_of);
            matrix[k][entry.column] = disc_of(&entry.constant).add(&by.mul(x)).add(&inverse.mul(&back));
        }
        for (column, factor) in &row.others {
            matrix[k][*column] = disc_of(factor);
        }
    }
    let mut columns: Vec<usize> = (0..size).collect();
    for step in 0..size.checked_sub(1)? {
        let entries = (step..size).flat_map(|i| (step..size).map(move |j| (i, j)));
        let weight = |(i, j): &(usize, usize)| middle(&matrix[*i][*j]).norm();
        let (row, column) = entries.max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
        matrix.swap(step, row);
        for row in &mut matrix {
            row.swap(step, column);
        }
        columns.swap(step, column);
        let inverse = matrix[step][step].inverse()?;
        let pivot: Vec<Disc> = matrix[step].iter().map(|entry| entry.mul(&inverse)).collect();
        for row in matrix.iter_mut().skip(step + 1).filter(|row| !row[step].is_zero()) {
            let factor = row[step].neg();
            for (entry, above) in row.iter_mut().zip(&pivot).skip(step).filter(|(_, above)| !above.is_zero()) {
                *entry = entry.add(&factor.mul(above));
            }
        }
        matrix[step] = pivot;
    }
    // The last row is zero but for rounding.
    let mut solved = vec![Disc::one(); size];
    for k in (0..size - 1).rev() {
        solved[k] = (k + 1..size).fold(Disc::zero(), |sum, j| sum.sub(&matrix[k][j].mul(&solved[j])));
    }
    let mut vector = DVector::from_element(size, Complex::new(0.0, 0.0));
    for (place, value) in columns.into_iter().zip(&solved) {
        vector[place] = middle(value);
    }
    vector.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(vector)
}

/// The rotations of all classes and the slides from the kernel of the matrix at a value of the hidden rotation.
fn start(
    choice: &Choice,
    equations: &Equations<Isotropic<Complex<f64>>>,
    x: Complex<f64>,
    kernel: &DVector<Complex<f64>>,
) -> Option<Start> {
    let mut turns = vec![Complex::new(1.0, 0.0); equations.classes];
    turns[choice.hidden] = x;
    let untold = choice.untold();
    for (j, class) in choice.pencil.classes.iter().enumerate().filter(|(_, class)| !untold.contains(class)) {
        // theta_j = v_(S - j) / v_S from the largest pair.
        let weight = |pair: &[usize; 2]| kernel[pair[0]].norm().min(kernel[pair[1]].norm());
        let [with, without] = choice.pencil.pairs(j).into_iter().max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
        turns[*class] = kernel[without] / kernel[with];
    }
    let slides = equations.slides.len();
    if slides + untold.len() > 0 {
        // The other rotations and the slides from the first halves, by least squares; slides alone from both.
        let loops = equations.loops();
        let rows = if untold.is_empty() { 2 * loops } else { loops };
        let part = |n: &Isotropic<Complex<f64>>, turn: Complex<f64>, k: usize| {
            if k < loops { n.z * turn } else { n.w / turn }
        };
        let a = DMatrix::from_fn(rows, untold.len() + slides, |k, column| match column.checked_sub(untold.len()) {
            None => equations.cycles[k][untold[column]].z,
            Some(q) => {
                let slide = &equations.slides[q];
                part(&slide.coefficients[k % loops], turns[slide.class], k)
            }
        });
        let told = (0..equations.classes).filter(|class| !untold.contains(class)).collect::<Vec<usize>>();
        let b = DVector::from_fn(rows, |k, _| {
            -told.iter().map(|j| part(&equations.cycles[k % loops][*j], turns[*j], k)).sum::<Complex<f64>>()
        });
        let solved: Vec<Complex<f64>> = finite(a).svd(true, true).solve(&b, 1e-12).ok()?.iter().copied().collect();
        untold.iter().zip(&solved).for_each(|(class, turn)| turns[*class] = *turn);
        return is_torus(&turns).then(|| (turns, solved[untold.len()..].to_vec()));
    }
    is_torus(&turns).then_some((turns, Vec::new()))
}

/// Whether no rotation is zero or infinite.
fn is_torus(turns: &[Complex<f64>]) -> bool {
    turns.iter().all(|turn| turn.norm().is_normal())
}

/// A vector that a nearly singular matrix nearly takes to zero, by inverse iteration.
fn kernel(matrix: DMatrix<Complex<f64>>) -> Option<DVector<Complex<f64>>> {
    let size = matrix.nrows();
    // A matrix that is singular to the last bit is moved by less than its own rounding.
    let moved = matrix + DMatrix::from_diagonal_element(size, size, Complex::new(1e-17, 1e-17));
    let lu = moved.lu();
    let mut vector = DVector::from_fn(size, |k, _| Complex::from_polar(1.0, 1.0 + 2.4 * k as f64));
    for _ in 0..3 {
        vector = lu.solve(&vector)?;
        let norm = vector.norm();
        if !norm.is_normal() {
            return None;
        }
        vector /= Complex::new(norm, 0.0);
    }
    Some(vector)
}
