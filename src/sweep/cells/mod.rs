//! The numbers of real assembly modes in the cells of one parameter: see docs/discriminant.md.
//!
//! Let F(s, t) be the closure polynomial in a parameter s, the input or any other, and one unknown t. The real zeros of its
//! discriminant cut the line, or the circle, of the parameter into cells. In each the real roots t never meet, so that their
//! number is constant, and so is the number of real modes.

mod map;
mod multiple;
mod source;
mod spatial;
mod subject;

pub use map::{CellMap, Column, Wanted as MapWanted, cell_map};
pub use spatial::{SpaceCase, SphereCase};
pub use subject::{EntryCase, LinkageCase, Parameter, Subject};

use super::exact::{Critical, Event, Output, PlaneCurve};
use crate::algebra::approximation::simplest_between;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::univariate::Univariate;
use crate::assembly::wrapped;
use crate::derivation::Watch;
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::verdict::{Code, Proof};
use rayon::prelude::*;
use rug::{Integer, Rational};
use source::Source;
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// The event at a zero of the discriminant, or at another value that bounds a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Label {
    /// The number of real modes changes: modes meet and become complex.
    Limit,
    /// Real modes meet and pass each other.
    Node,
    /// Complex modes meet in a real one, which exists at this value alone.
    Isolated,
    /// Complex modes meet in complex ones.
    Complex,
    /// The number does not change; whether the modes that meet are real is not decided.
    Unchanged,
    /// A distance goes to infinity, or may do so.
    Infinity,
    /// The closure polynomial vanishes for all values of its unknown: the mechanism may move by itself.
    SelfMotion,
}

impl Label {
    /// The word of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Limit => "limit",
            Self::Node => "node",
            Self::Isolated => "isolated",
            Self::Complex => "complex",
            Self::Unchanged => "unchanged",
            Self::Infinity => "infinity",
            Self::SelfMotion => "self-motion",
        }
    }
}

/// A value of the parameter between two cells.
#[derive(Clone, Debug)]
pub struct Zero {
    /// The parameter: radians in (-pi, pi], or a length.
    pub value: f64,
    /// The exact half tangent or length, where it is known to be rational.
    pub exact: Option<Rational>,
    /// The multiplicity as a zero of the discriminant; 0 where it is none.
    pub order: usize,
    /// The event there.
    pub label: Label,
    /// The numbers of real modes before and behind it.
    pub modes: [usize; 2],
    /// The number of distinct real roots of the closure polynomial at it, where it was counted.
    pub at: Option<usize>,
}

/// An open interval of the parameter in which the number of real modes is constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The lower end: `None` for minus infinity, and where there is one cell only.
    pub from: Option<f64>,
    /// The upper end: `None` for infinity, and where there is one cell only. An angle may be a turn further.
    pub to: Option<f64>,
    /// A point of it: the half tangent of an angle, or a length.
    pub sample: Rational,
    /// The angle in radians, or the length, of that point.
    pub value: f64,
    /// The number of real roots of the closure polynomial, and so of real modes, everywhere in it.
    pub modes: usize,
    /// The number of real modes that the solver lists at the point, where its list is complete.
    pub solved: Option<usize>,
}

/// The proof of the cells.
#[derive(Clone, Debug, PartialEq)]
pub struct CellsVerdict {
    /// In one word.
    pub proof: Proof,
    /// As a code.
    pub code: Code,
    /// In words.
    pub reason: String,
}

/// The cells of one parameter.
#[derive(Clone, Debug)]
pub struct Cells {
    /// The parameter as requested.
    pub parameter: String,
    /// The name of its variable: a length, or the half tangent of an angle.
    pub variable: String,
    /// Whether it is an angle.
    pub kind: Variable,
    /// Its value in the file: radians, or a length.
    pub given: Option<f64>,
    /// The name of the unknown.
    pub unknown: String,
    /// Whether that is the half tangent of an angle, or a distance.
    pub unknown_kind: Variable,
    /// The closure polynomial over the parameter, variable 0, and the unknown, variable 1: integers without common factor.
    pub polynomial: Polynomial<Int>,
    /// The discriminant by the unknown: its square-free factors and how often each of them is one.
    pub discriminant: Vec<(Univariate<Integer>, usize)>,
    /// The values between the cells, in their order.
    pub zeros: Vec<Zero>,
    /// The cells; the first one lies before the first zero, of an angle behind the last one.
    pub cells: Vec<Cell>,
    /// The proof of them.
    pub verdict: CellsVerdict,
}

/// The cells of one parameter of a mechanism: what a derivation may have for a symbol. `watch` sees the values from which the closure
/// polynomial is interpolated.
///
/// # Errors
/// [`Error::Invalid`] for an unknown parameter; [`Error::Unsupported`] where no closure polynomial in it is known.
pub fn cells(subject: &impl Subject, parameter: &str, watch: &Watch<'_>) -> Result<Cells> {
    let parameter = subject.parameter(parameter)?;
    subject.source(&parameter, watch)?.cells(subject, &parameter)
}

/// A bound of a cell, before its label is known.
struct Bound {
    root: RealRoot,
    event: Event,
    minimal: Arc<Univariate<Integer>>,
    value: f64,
}

impl Bound {
    /// Whether two bounds are one number.
    fn is_same(&self, other: &Self) -> bool {
        if Arc::ptr_eq(&self.minimal, &other.minimal) {
            // These are different roots of one polynomial.
            return false;
        }
        let common = self.minimal.gcd(&other.minimal);
        if common.degree().is_none_or(|degree| degree == 0) {
            return false;
        }
        common.real_roots().iter().any(|root| {
            let inside = |bound: &Self| {
                let (low, high) = bound.root.bounds();
                root.compare(&low).is_ge() && root.compare(&high).is_le()
            };
            inside(self) && inside(other)
        })
    }
}

impl Source {
    fn cells(&self, subject: &impl Subject, setting: &Parameter) -> Result<Cells> {
        let output = self.exact.output(0).ok_or_else(|| Error::Unsupported("there is no closure polynomial".into()))?;
        let bounds = self.bounds(output, setting.kind);
        let mut cells = self.empty_cells(output, &bounds, setting.kind)?;
        let solve = |cell: &Cell| subject.with(setting, &cell.sample).real_modes();
        let solved: Vec<Option<usize>> = cells.par_iter().map(solve).collect();
        for (cell, solved) in cells.iter_mut().zip(solved) {
            cell.solved = solved;
        }
        let zeros = (0..bounds.len()).map(|k| {
            let behind = if k + 1 < cells.len() { k + 1 } else { 0 };
            self.zero(output, &bounds[k], [cells[k].modes, cells[behind].modes])
        });
        let zeros: Vec<Zero> = zeros.collect();
        let back = -self.exact.from.clone();
        let factors = output.factors.iter();
        let counted = |f: &Univariate<Integer>| PlaneCurve::of_input(f).counted_from(&back).coefficient(0);
        let given = setting.value.as_ref().map(|value| natural(value, setting.kind));
        Ok(Cells {
            parameter: setting.name.clone(),
            variable: setting.variable.clone(),
            kind: setting.kind,
            given,
            unknown: self.unknown.clone(),
            unknown_kind: output.kind,
            polynomial: output.charts[0].curve.counted_from(&back).polynomial(),
            discriminant: factors
                .filter(|(f, _)| f.degree() > Some(0))
                .map(|(f, k)| (counted(f).primitive_part(), *k))
                .collect(),
            verdict: self.verdict(subject.is_rounded(setting), &cells),
            zeros,
            cells,
        })
    }

    /// All values between cells, in their order.
    fn bounds(&self, output: &Output, kind: Variable) -> Vec<Bound> {
        let bound = |critical: &Critical| {
            let value = match kind {
                Variable::Rotation => wrapped(2.0 * (critical.value.atan() + self.exact.from.to_f64().atan())),
                Variable::Translation => critical.value,
            };
            Bound { root: critical.root.clone(), event: critical.event, minimal: Arc::clone(&critical.minimal), value }
        };
        let mut bounds: Vec<Bound> = Vec::new();
        for next in output.criticals.iter().map(bound) {
            match bounds.last_mut() {
                // A value at which the mechanism may move may be a zero of the discriminant as well.
                Some(last) if last.is_same(&next) => {
                    if next.event == Event::Locked {
                        last.event = next.event;
                    }
                }
                _ => bounds.push(next),
            }
        }
        bounds
    }

    /// The cells between them, of an angle in the order of half tangents counted from `from`.
    fn empty_cells(&self, output: &Output, bounds: &[Bound], kind: Variable) -> Result<Vec<Cell>> {
        let count = bounds.len();
        let cell = |k: usize| {
            let place = |inside: &Rational| {
                let is_above = k == 0 || bounds[k - 1].root.compare(inside).is_lt();
                let is_below = k == count || bounds[k].root.compare(inside).is_gt();
                is_above && is_below
            };
            let ends = [k.checked_sub(1).map(|k| &bounds[k]), bounds.get(k)];
            let (sample, inside) = self.sample(ends, kind, &place).ok_or_else(|| {
                Error::Unsupported("two values between cells are too close to each other to be told apart".into())
            })?;
            let modes = roots_at(output, &inside);
            let [from, to] = ends.map(|end| end.map(|bound| bound.value));
            let value = natural(&sample, kind);
            Ok(Cell { from, to, sample, value, modes, solved: None })
        };
        let mut cells: Vec<Cell> = (0..=count).map(cell).collect::<Result<_>>()?;
        if kind == Variable::Rotation && count > 0 {
            // Half a turn from where angles are counted nothing happens: the first and the last one are one cell.
            if let Some(last) = cells.pop() {
                cells[0].from = last.from;
            }
        }
        Ok(cells)
    }

    /// A simple number between two values, and the same as it is counted in the closure polynomial.
    fn sample(
        &self,
        [low, high]: [Option<&Bound>; 2],
        kind: Variable,
        is_inside: &dyn Fn(&Rational) -> bool,
    ) -> Option<(Rational, Rational)> {
        let from = &self.exact.from;
        let counted = |s: &Rational| -> Option<Rational> {
            let under: Rational = Rational::from(s * from) + 1;
            (!under.is_zero()).then(|| Rational::from(s - from) / under)
        };
        let simple = || -> Option<(Rational, Rational)> {
            let [a, b] = match (kind, low, high) {
                (Variable::Rotation, _, _) => {
                    // The half of the cell in its middle.
                    let origin = 2.0 * from.to_f64().atan();
                    let own =
                        |bound: Option<&Bound>, end: f64| bound.map_or(end, |bound| wrapped(bound.value - origin));
                    let (a, b) = (own(low, -PI), own(high, PI));
                    let [a, b] = [0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b].map(|x| wrapped(origin + x));
                    if a > b {
                        return None;
                    }
                    [(a / 2.0).tan(), (b / 2.0).tan()]
                }
                (_, Some(low), Some(high)) => {
                    [0.75 * low.value + 0.25 * high.value, 0.25 * low.value + 0.75 * high.value]
                }
                (_, Some(low), None) => [low.value + 0.5 + low.value.abs(), low.value + 1.5 + 2.0 * low.value.abs()],
                (_, None, Some(high)) => {
                    [high.value - 1.5 - 2.0 * high.value.abs(), high.value - 0.5 - high.value.abs()]
                }
                (_, None, None) => [0.5, 2.0],
            };
            let s = simplest_between(Rational::from_f64(a)?, Rational::from_f64(b)?);
            Some((s.clone(), counted(&s)?))
        };
        if let Some((s, inside)) = simple().filter(|(_, inside)| is_inside(inside)) {
            return Some((s, inside));
        }
        // Between the intervals that hold the values, which are made narrow enough.
        let [mut low, mut high] = [low, high].map(|bound| bound.map(|bound| bound.root.clone()));
        let back = |x: &Rational| -> Option<Rational> {
            let under: Rational = 1 - Rational::from(x * from);
            (!under.is_zero()).then(|| Rational::from(x + from) / under)
        };
        for (step, bits) in [64_u32, 256, 1024, 4096].into_iter().enumerate() {
            let width = Rational::from((Integer::from(1), Integer::from(1) << bits));
            [&mut low, &mut high].into_iter().flatten().for_each(|root| root.refine(&width));
            let ends = [low.as_ref().map(|root| root.bounds().1), high.as_ref().map(|root| root.bounds().0)];
            let inside = match ends {
                [Some(a), Some(b)] if a < b => {
                    let quarter = Rational::from(&b - &a) / 4;
                    let inside = simplest_between(a + &quarter, Rational::from(&b - &quarter));
                    // One of all numbers stands for half a turn, which has no half tangent: another one above it.
                    if back(&inside).is_some() {
                        inside
                    } else {
                        let high = b - quarter / 2;
                        simplest_between(Rational::from(&inside + &high) / 2, high)
                    }
                }
                [Some(a), None] => a.ceil() + (1 + step),
                [None, Some(b)] => b.floor() - (1 + step),
                [None, None] => Rational::from((1, 3)),
                _ => continue,
            };
            if let Some(s) = back(&inside).filter(|_| is_inside(&inside)) {
                return Some((s, inside));
            }
        }
        None
    }

    fn zero(&self, output: &Output, bound: &Bound, modes: [usize; 2]) -> Zero {
        let mut root = bound.root.clone();
        let exact = self.exact_value(&mut root);
        let order = if let Event::Meeting(order) = bound.event { order } else { 0 };
        let mut at = None;
        let label = match bound.event {
            Event::Infinity => Label::Infinity,
            Event::Locked => Label::SelfMotion,
            Event::Meeting(_) if modes[0] != modes[1] => Label::Limit,
            Event::Meeting(_) => {
                let mut place = multiple::Place::of(&root, &bound.minimal);
                at = place.distinct_real_roots(&output.charts[0].curve);
                match at.map(|at| at.cmp(&modes[0])) {
                    None => Label::Unchanged,
                    Some(Ordering::Less) => Label::Node,
                    Some(Ordering::Greater) => Label::Isolated,
                    Some(Ordering::Equal) => Label::Complex,
                }
            }
        };
        Zero { value: bound.value, exact, order, label, modes, at }
    }

    /// The half tangent, or the length, where it is rational.
    fn exact_value(&self, root: &mut RealRoot) -> Option<Rational> {
        let x = root.rational()?;
        let from = &self.exact.from;
        let under: Rational = 1 - Rational::from(&x * from);
        (!under.is_zero()).then(|| (x + from) / under)
    }

    fn verdict(&self, is_rounded: bool, cells: &[Cell]) -> CellsVerdict {
        let is_other = |cell: &&Cell| cell.solved.is_some_and(|solved| solved != cell.modes);
        let verdict = |proof: Proof, code, reason: &str| CellsVerdict { proof, code, reason: reason.to_owned() };
        if cells.iter().any(|cell| is_other(&cell)) {
            let reason = "not proved: at some sample point the solver lists another number of real modes than the closure polynomial \
                          has real roots";
            return verdict(Proof::None, Code::CellsNotMatched, reason);
        }
        if self.proof == Proof::None {
            let reason = "not proved: the roots of the closure polynomial and the assemblies of the file are not as many, or a displacement \
                          may be infinite";
            return verdict(Proof::None, Code::CellsNotMatched, reason);
        }
        if self.is_probable && cells.iter().any(|cell| cell.solved.is_none()) {
            let reason = "not proved: at some sample point the list of the solver is not complete";
            return verdict(Proof::None, Code::CellsNotMatched, reason);
        }
        if self.is_probable {
            let reason = "the closure polynomial is interpolated; at every sample point it has as many real roots as there are real \
                          modes";
            let proof = if is_rounded { Proof::RoundedData } else { self.proof };
            return verdict(proof, Code::ProbablePolynomial, reason);
        }
        let reason = "between neighbouring zeros of the exact discriminant the real roots of the closure polynomial, one for each \
                      real mode, never meet";
        verdict(self.proof.of_rounded(is_rounded), Code::CellsProved, reason)
    }
}

/// The number of real roots at a value, half a turn among them.
fn roots_at(output: &Output, s: &Rational) -> usize {
    let curve = &output.charts[0].curve;
    let polynomial = curve.at(s);
    let Some(degree) = polynomial.degree() else { return 0 };
    let infinite = if output.kind == Variable::Rotation { curve.degree() - degree } else { 0 };
    let finite = if degree > 0 { polynomial.real_roots().len() } else { 0 };
    finite + infinite.min(1)
}

/// Radians, or a length.
fn natural(value: &Rational, kind: Variable) -> f64 {
    match kind {
        Variable::Rotation => 2.0 * value.to_f64().atan(),
        Variable::Translation => value.to_f64(),
    }
}

impl Cells {
    /// The number of real modes at a value, radians or a length; `None` at a value between cells, as far as f64 tells.
    #[must_use]
    pub fn modes_at(&self, value: f64) -> Option<usize> {
        /// Distance from a zero below which a value counts as the zero.
        const CLOSE: f64 = 1e-9;
        let apart = |x: f64| if self.kind == Variable::Rotation { wrapped(x - value).abs() } else { (x - value).abs() };
        if self.zeros.iter().any(|zero| apart(zero.value) < CLOSE * (1.0 + zero.value.abs())) {
            return None;
        }
        let is_inside = |cell: &&Cell| match (self.kind, cell.from, cell.to) {
            (Variable::Rotation, Some(from), Some(to)) => {
                let width = (to - from).rem_euclid(TAU);
                // One zero only: its cell is the rest of the turn.
                let width = if width == 0.0 { TAU } else { width };
                (value - from).rem_euclid(TAU) < width
            }
            (_, from, to) => from.is_none_or(|from| from < value) && to.is_none_or(|to| value < to),
        };
        self.cells.iter().find(is_inside).map(|cell| cell.modes)
    }
}
