//! One output of a loop: its closure polynomial, and the critical inputs, between which its real roots neither meet nor
//! go to infinity.

use super::plane_curve::{Integral, PlaneCurve, S, T, in_one, integral};
use super::relation::{Content, InOutput, Relation};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::real_roots::{RealRoot, roots_of_factors};
use crate::algebra::resultant::resultant;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use crate::verdict::Code;
use rug::{Integer, Rational};
use std::cmp::Ordering;
use std::sync::Arc;

/// The event at a critical input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::internal::sweep) enum Event {
    /// A root of the discriminant, with its multiplicity: roots of the closure polynomial meet.
    Meeting(usize),
    /// An output or another translation goes to infinity, or may do so.
    Infinity,
    /// The closure polynomial vanishes for all outputs: the loop may move while its input stands still.
    Locked,
}

/// An input at which something may happen to a branch.
#[derive(Clone, Debug)]
pub(in crate::internal::sweep) struct Critical {
    pub root: RealRoot,
    /// The polynomial without multiple roots of which it is a root.
    pub minimal: Arc<Univariate<Integer>>,
    pub event: Event,
    /// The root in f64.
    pub value: f64,
}

/// The polynomials of an output as one half tangent of the input has them.
#[derive(Clone, Debug)]
pub(in crate::internal::sweep) struct Chart {
    /// The closure polynomial.
    pub curve: PlaneCurve,
    /// All vanish where the translations are dependent.
    pub parallel: Vec<PlaneCurve>,
    /// Polynomials that do not all vanish where dependent translations leave the loop open.
    pub gap: Vec<PlaneCurve>,
    /// For each of `parallel` the inputs at which it has a root in common with the closure polynomial.
    pub dependent: Vec<Univariate<Integer>>,
    /// The common roots of all of those.
    pub together: Univariate<Integer>,
    /// The roots that the discriminant has in common with these.
    pub common: Univariate<Integer>,
    /// The inputs at which the translations are dependent whatever the output.
    pub pole: Univariate<Integer>,
}

/// An output of a loop.
#[derive(Clone, Debug)]
pub(in crate::internal::sweep) struct Output {
    /// Index among the joint variables.
    pub joint: usize,
    pub kind: Variable,
    /// By the half tangent of the input, and by that of the input less half a turn.
    pub charts: [Chart; 2],
    /// The square-free factors of the discriminant by the output, as a form where that is an angle, each with its multiplicity; in the half
    /// tangent of the input.
    pub factors: Vec<(Univariate<Integer>, usize)>,
    pub criticals: Vec<Critical>,
    /// Inputs at which every output is one of a configuration: the loop moves while its input stands still.
    pub standing: Vec<f64>,
}

/// The real roots of a polynomial, none of a constant.
fn real_roots(polynomial: &Univariate<Integer>) -> Vec<RealRoot> {
    if polynomial.degree() > Some(0) { polynomial.real_roots() } else { Vec::new() }
}

/// The polynomial in the input of a polynomial without output.
fn of_input(polynomial: &Polynomial<Int>) -> Univariate<Integer> {
    in_one(polynomial, S)
}

/// Combinations of up to three polynomials that all vanish exactly where these do, none of which vanishes only because
/// a coordinate does.
fn combined(list: &[InOutput]) -> Vec<InOutput> {
    let count = i32::try_from(list.len()).unwrap_or(0);
    let combination = |node: i32| {
        let start = (Univariate::zero(), 1);
        let add = |(sum, power): (InOutput, i32), one: &InOutput| {
            let weight = Ring::from_integer(power);
            (sum.add(&one.scale(&weight)), power * node)
        };
        list.iter().fold(start, add).0
    };
    (1..=count).map(combination).collect()
}

/// The part in the input alone that all of them have in common, and the polynomials without it.
fn without_common_content(list: &[Integral]) -> Option<(Univariate<Integer>, Vec<Polynomial<Int>>)> {
    let contents = list.iter().map(|p| p.polynomial.content_in(T));
    let Some(content) = contents.reduce(|gcd, content| gcd.gcd(&content)) else {
        return Some((Univariate::one(), Vec::new()));
    };
    let rest: Option<Vec<_>> = list.iter().map(|p| p.polynomial.checked_div_exact(&content)).collect();
    Some((of_input(&content), rest?))
}

impl Output {
    /// Returns the common divisor of all equations of a relation, without multiple factors and without factors in the input
    /// alone.
    pub(super) fn divisor(relation: &Relation, turns: bool) -> Option<Polynomial<Int>> {
        let equations: Vec<&Integral> = relation.equations.iter().filter(|f| !f.polynomial.is_zero()).collect();
        let (first, others) = equations.split_first()?;
        if turns && !equations.iter().any(|f| f.is_finite()) {
            return None;
        }
        let whole = others.iter().fold(first.polynomial.clone(), |gcd, f| gcd.gcd(&f.polynomial));
        let divisor = whole.checked_div_exact(&whole.content_in(T))?.square_free_part();
        (divisor.degree(T) > 0).then_some(divisor)
    }

    /// The output of a relation. `turns` says whether the input is an angle, which must not be critical at half a turn
    /// from where it is counted: `Ok(None)` where it is.
    pub(super) fn of(relation: &Relation, turns: bool) -> Result<Option<Self>, Code> {
        let equations: Vec<&Integral> = relation.equations.iter().filter(|f| !f.polynomial.is_zero()).collect();
        let (first, others) = equations.split_first().ok_or(Code::NoExactRoute)?;
        let whole = others.iter().fold(first.polynomial.clone(), |gcd, f| gcd.gcd(&f.polynomial));
        if turns && !equations.iter().any(|f| f.is_finite()) {
            return Ok(None);
        }
        let content = whole.content_in(T);
        let mut f = whole.checked_div_exact(&content).ok_or(Code::NoExactRoute)?;
        let is_half_turn = relation.kind == Variable::Rotation && equations.iter().all(|f| f.is_half_turn);
        if f.degree(T) == 0 && !is_half_turn {
            return Err(Code::NoExactRoute);
        }
        let mut discriminant = discriminant(&f);
        if discriminant.is_zero() {
            f = f.square_free_part();
            discriminant = self::discriminant(&f);
        }
        let mut curve = PlaneCurve::of(&f);
        if is_half_turn {
            curve = curve.with_half_turn();
            // Others pass half a turn where their leading coefficient vanishes.
            let leading = f.coefficients_in(T).last().map_or_else(Univariate::one, of_input);
            discriminant = discriminant.mul(&leading).mul(&leading);
        }
        let full = (2 * curve.degree() - 2) * curve.input_degree();
        if turns && discriminant.degree() != Some(full) {
            return Ok(None);
        }
        let parallel: Vec<Integral> = combined(&relation.parallel).iter().map(integral).collect();
        if turns && !parallel.is_empty() && !parallel.iter().any(Integral::is_finite) {
            return Ok(None);
        }
        let (pole, parallel) = without_common_content(&parallel).ok_or(Code::NoExactRoute)?;
        let dependent: Vec<Univariate<Integer>> = parallel.iter().map(|p| of_input(&resultant(&f, p, T))).collect();
        if dependent.iter().any(Ring::is_zero) {
            return Err(Code::NoExactRoute);
        }
        let is_finite = |(p, r): (&Polynomial<Int>, &Univariate<Integer>)| {
            let p = PlaneCurve::of(p);
            r.degree() == Some(curve.degree() * p.input_degree() + p.degree() * curve.input_degree())
        };
        if turns && !dependent.is_empty() && !parallel.iter().zip(&dependent).any(is_finite) {
            return Ok(None);
        }
        let meeting = dependent.iter().skip(1).fold(dependent.first().cloned(), |gcd, r| gcd.map(|gcd| gcd.gcd(r)));
        let common = meeting.as_ref().map_or_else(Univariate::one, |meeting| meeting.gcd(&discriminant));
        let leading = f.coefficients_in(T).last().map(of_input).filter(|_| relation.kind == Variable::Translation);
        let together = meeting.unwrap_or_else(Univariate::one);
        let infinite = [together.clone(), pole.clone()].into_iter().chain(leading);
        let content = of_input(&content);
        let one = Univariate::one;
        let (standing, locked) = match relation.content {
            Content::Standing => (content, one()),
            Content::Nothing => (one(), one()),
            Content::Open => (one(), content),
        };
        let factors = discriminant.square_free_decomposition();
        let criticals = criticals(&factors, infinite, &locked);
        let gap = relation.gap.iter().map(|p| PlaneCurve::of(&integral(p).polynomial)).collect();
        let parallel = parallel.iter().map(PlaneCurve::of).collect();
        let chart = Chart { curve, parallel, gap, dependent, together, common, pole };
        let charts = [chart.clone(), chart.half_turned()];
        let standing = real_roots(&standing).iter_mut().map(RealRoot::to_f64).collect();
        Ok(Some(Self { joint: relation.output, kind: relation.kind, charts, factors, criticals, standing }))
    }

    /// The critical inputs between two inputs of a chart, `None` where one of these is critical itself.
    pub fn between(&self, chart: usize, [low, high]: [&Rational; 2]) -> Option<Vec<&Critical>> {
        let mut inside = Vec::new();
        for critical in &self.criticals {
            let place = |x: &Rational| compare(&critical.root, chart, x);
            match [place(low), place(high)] {
                [Ordering::Equal, _] | [_, Ordering::Equal] => return None,
                [Ordering::Greater, Ordering::Less] => inside.push(critical),
                _ => {}
            }
        }
        Some(inside)
    }
}

/// Compares a root with a number of a chart.
fn compare(root: &RealRoot, chart: usize, x: &Rational) -> Ordering {
    if chart == 0 {
        return root.compare(x);
    }
    // The root r is -1/r there: monotone on either side of 0.
    let sign = root.compare(&Rational::new());
    if sign.is_eq() {
        // Half a turn from where the chart counts: beyond all its numbers.
        return Ordering::Greater;
    }
    match x.cmp0() {
        Ordering::Equal => sign.reverse(),
        // -1/r is positive for a negative root.
        side if side == sign => sign.reverse(),
        _ => root.compare(&-x.clone().recip()),
    }
}

impl Chart {
    /// As the half tangent of the input less half a turn has it.
    fn half_turned(&self) -> Self {
        let all = |list: &[PlaneCurve]| list.iter().map(PlaneCurve::half_turned).collect();
        let input = |p: &Univariate<Integer>| PlaneCurve::of_input(p).half_turned().coefficient(0);
        Self {
            curve: self.curve.half_turned(),
            parallel: all(&self.parallel),
            gap: all(&self.gap),
            dependent: self.dependent.iter().map(input).collect(),
            together: input(&self.together),
            common: input(&self.common),
            pole: input(&self.pole),
        }
    }
}

/// The discriminant by the output, up to a number: the resultant with the derivative, without the leading coefficient.
fn discriminant(f: &Polynomial<Int>) -> Univariate<Integer> {
    if f.degree(T) < 2 {
        return Univariate::one();
    }
    let all = resultant(f, &f.derivative(T), T);
    let leading = f.coefficients_in(T).pop().unwrap_or_else(Polynomial::one);
    all.checked_div_exact(&leading).map_or_else(Univariate::zero, |quotient| of_input(&quotient))
}

/// The real roots of all of them, those of the discriminant, of which the square-free factors are given, once.
fn criticals(
    discriminant: &[(Univariate<Integer>, usize)],
    infinite: impl Iterator<Item = Univariate<Integer>>,
    content: &Univariate<Integer>,
) -> Vec<Critical> {
    let mut criticals = Vec::new();
    let mut add = |factors: &[(Univariate<Integer>, usize)], event: &dyn Fn(usize) -> Event| {
        let minimal = factors.iter().fold(Univariate::one(), |product, (factor, _)| product.mul(factor));
        let minimal = Arc::new(minimal);
        criticals.extend(roots_of_factors(factors).into_iter().map(|mut root| {
            let (event, value) = (event(root.multiplicity()), root.to_f64());
            Critical { root, minimal: Arc::clone(&minimal), event, value }
        }));
    };
    add(discriminant, &Event::Meeting);
    let mut known = discriminant.iter().fold(Univariate::one(), |product, (factor, _)| product.mul(factor));
    for polynomial in infinite {
        if polynomial.degree() > Some(0) {
            let square_free = polynomial.square_free_part();
            let rest = square_free.quotient(&square_free.gcd(&known)).unwrap_or(square_free);
            add(&rest.square_free_decomposition(), &|_| Event::Infinity);
            known = known.mul(&rest);
        }
    }
    add(&content.square_free_decomposition(), &|_| Event::Locked);
    // Two that are the same in f64 are told apart by their intervals.
    let before = |a: &Critical, b: &Critical| {
        a.value.total_cmp(&b.value).then_with(|| a.root.bounds().0.cmp(&b.root.bounds().0))
    };
    sort::by(&mut criticals, before);
    criticals
}
