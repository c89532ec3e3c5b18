//! Groups of several cycles with rational data: the closure polynomial gives all rotations of one class, the kernel of the
//! pencil the others, and every solution is proved by itself.

use super::equations::Equations;
use super::isotropic::Isotropic;
use super::krawczyk::{Proved, prove};
use super::pencil::{Parameter, Pencil};
use super::polynomial::{ClosurePolynomial, closure_polynomial, turned};
use super::quadratic::Root;
use super::state::Number;
use crate::algebra::determinant::determinant;
use crate::algebra::modp::ModP;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::exact::{Isolated, isolated_roots};
use crate::kinematics::linkage::Gaussian;
use crate::solve::hessenberg::Hessenberg;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;

/// Rotations of the hidden class tried to keep the half turn from being a root.
const TURNS: u32 = 8;
/// Pairs of classes at rest and hidden whose determinants are compared: all of a group of nine bodies.
const PAIRS: usize = 40;
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
}

impl Found {
    fn nothing(doubt: &str) -> Self {
        Self { solutions: Vec::new(), most: None, size: 0, doubt: Some(doubt.to_owned()) }
    }
}

/// A choice of classes with its matrix and polynomial.
struct Choice {
    rest: usize,
    hidden: usize,
    pencil: Pencil<Gaussian>,
    found: ClosurePolynomial,
    turn: Isotropic<Gaussian>,
}

/// Solves a group.
#[must_use]
pub fn general(equations: &Equations<Number>) -> Found {
    let Some(exact) = equations.exact() else {
        return Found::nothing("a group of several loops stands on an assembly whose numbers are not rational");
    };
    let approximate = exact.map(|n| Some(n.map(|z| Complex::new(z.re.to_f64(), z.im.to_f64()))));
    let Some(approximate) = approximate else { return Found::nothing("no approximation of the data") };
    let mut found =
        Found::nothing("the matrix of the group is singular for every choice of a hidden body, or has no square form");
    // Roots of one choice that lead nowhere may be no roots of another, or lead on from there.
    for (rest, hidden) in ranked(&exact).into_iter().take(TRIES) {
        let Some(choice) = choice(&exact, rest, hidden) else { continue };
        extend(&mut found, equations, &approximate, &choice);
        if found.most == Some(found.solutions.len()) {
            found.doubt = None;
            break;
        }
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
    let mut led = 0;
    for t in roots {
        let i = Complex::new(0.0, 1.0);
        let x = (1.0 + i * t) / (1.0 - i * t) * Complex::new(choice.turn.z.re.to_f64(), choice.turn.z.im.to_f64());
        let proved =
            start(choice, approximate, x).and_then(|(turns, shifts)| prove(equations, choice.rest, &turns, &shifts));
        if let Some(proved) = proved {
            led += 1;
            if found.solutions.iter().all(|known| differ(known, &proved, choice.rest)) {
                found.solutions.push(proved);
            }
        }
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

/// The pencils modulo a prime for all classes at rest and hidden, the smallest first.
fn pencils(exact: &Equations<Isotropic<Gaussian>>) -> Vec<(usize, usize, Pencil<Residue>)> {
    let residues = exact.map(|n| Some(Isotropic { z: residue(&n.z)?, w: residue(&n.w)? }));
    let Some(residues) = residues else { return Vec::new() };
    let mut rest: Vec<usize> = (0..exact.classes).collect();
    if let Some(slide) = exact.slides.first() {
        rest.retain(|class| *class == slide.class);
    }
    let pairs =
        rest.iter().flat_map(|rest| (0..exact.classes).map(move |hidden| (*rest, hidden))).filter(|(a, b)| a != b);
    // Without slides it makes no difference which class rests and which is hidden.
    let pairs = pairs.filter(|(a, b)| a < b || !exact.slides.is_empty());
    let mut pencils: Vec<(usize, usize, Pencil<Residue>)> = pairs
        .filter_map(|(rest, hidden)| Some((rest, hidden, Pencil::new(&residues, rest, &[Parameter::Turn(hidden)])?)))
        .collect();
    pencils.retain(|(_, _, pencil)| !pencil.sets.is_empty());
    pencils.sort_by_key(|(_, _, pencil)| pencil.sets.len());
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
    ranked.sort_by_key(|(degree, ..)| *degree);
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
        let [by, inverse] = &row.by[0];
        let (rest, first) =
            if inverse.is_zero() { (&mut constant, &mut slope) } else { (&mut slope, &mut constant) };
        if !inverse.is_zero() && !by.is_zero() {
            return None;
        }
        first[k][k] = by.add(inverse);
        rest[k][k] = row.constant;
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
    Some(shifted.coefficients().iter().rev().fold(Univariate::zero(), |sum, c| {
        sum.mul(&step).add(&Univariate::constant(*c))
    }))
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
fn choice(exact: &Equations<Isotropic<Gaussian>>, rest: usize, hidden: usize) -> Option<Choice> {
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

/// Returns approximations of all roots; `None` where no precision separates them.
fn hidden_rotations(square_free: &Univariate<rug::Integer>) -> Option<Vec<Complex<f64>>> {
    fn middles<const BITS: u32>(roots: &[Isolated<BITS>]) -> Vec<Complex<f64>> {
        roots.iter().map(|root| Complex::new(root.ball.re().to_f64(), root.ball.im().to_f64())).collect()
    }
    let short = isolated_roots::<512>(square_free).map(|roots| middles(&roots));
    short.or_else(|| isolated_roots::<1024>(square_free).map(|roots| middles(&roots)))
}

/// Approximate rotations of all classes and slides.
type Start = (Vec<Complex<f64>>, Vec<Complex<f64>>);

/// The rotations of all classes and the slides from the kernel of the matrix at a value of the hidden rotation.
fn start(choice: &Choice, equations: &Equations<Isotropic<Complex<f64>>>, x: Complex<f64>) -> Option<Start> {
    let size = choice.pencil.sets.len();
    let narrow = |z: &Gaussian| Complex::new(z.re.to_f64(), z.im.to_f64());
    let mut matrix = DMatrix::from_element(size, size, Complex::new(0.0, 0.0));
    for (k, row) in choice.pencil.rows.iter().enumerate() {
        matrix[(k, k)] = narrow(&row.constant) + narrow(&row.by[0][0]) * x + narrow(&row.by[0][1]) / x;
        for (column, factor) in &row.others {
            matrix[(k, *column)] = narrow(factor);
        }
        let largest = (0..size).map(|j| matrix[(k, j)].norm()).fold(f64::MIN_POSITIVE, f64::max);
        for j in 0..size {
            matrix[(k, j)] /= largest;
        }
    }
    let kernel = kernel(matrix)?;
    let mut turns = vec![Complex::new(1.0, 0.0); equations.classes];
    turns[choice.hidden] = x;
    for (j, class) in choice.pencil.classes.iter().enumerate() {
        let pairs = (0..size).filter(|k| choice.pencil.sets[*k] >> j & 1 == 1);
        let pairs = pairs
            .filter_map(|k| Some((k, choice.pencil.sets.binary_search(&(choice.pencil.sets[k] ^ (1 << j))).ok()?)));
        // theta_j = v_(S - j) / v_S from the largest pair.
        let weight = |pair: &(usize, usize)| kernel[pair.0].norm().min(kernel[pair.1].norm());
        let (with, without) = pairs.max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
        turns[*class] = kernel[without] / kernel[with];
    }
    if turns.iter().any(|turn| !turn.norm().is_normal()) {
        return None;
    }
    // The slides from the first halves, by least squares.
    let slides = equations.slides.len();
    if slides == 0 {
        return Some((turns, Vec::new()));
    }
    let loops = equations.loops();
    let a = DMatrix::from_fn(loops, slides, |k, q| {
        equations.slides[q].coefficients[k].z * turns[equations.slides[q].class]
    });
    let b = DVector::from_fn(loops, |k, _| {
        -(0..equations.classes).map(|j| equations.cycles[k][j].z * turns[j]).sum::<Complex<f64>>()
    });
    let solved = a.svd(true, true).solve(&b, 1e-12).ok()?;
    Some((turns, solved.iter().copied().collect()))
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
