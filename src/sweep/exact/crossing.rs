//! The fate of every mode between two neighbouring inputs, proved from the closure polynomial.

use super::node::Node;
use super::output::{Chart, Critical, Event, Output};
use super::plane_curve::{PlaneCurve, Rectangle, sign_changes};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::assembly::wrapped;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::bridge::{Bridge, Fate};
use crate::sweep::track::Fold;
use crate::verdict::Code;
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// A mode and a root of the closure polynomial agree if they are no farther apart, in radians or lengths over 1 plus
/// their size: samples are solved to more digits than that, also 1e-5 beside a limit position.
const SAME: f64 = 1e-6;
/// Any other mode is this many times as far from the root.
const CLEAR: f64 = 4.0;
/// The number of widest gaps between outputs that are tried for one that no output passes.
const GAPS: usize = 4;
/// Rectangles about a branch are tried with these multiples of what it rises.
const HEIGHTS: [i32; 3] = [1, 3, 10];

/// The modes at two neighbouring inputs, in the order of the sweep.
pub(in crate::internal::sweep) trait Ends {
    /// The inputs: radians, or lengths.
    fn inputs(&self) -> [f64; 2];

    /// An output of every mode of an end: radians, or lengths.
    fn outputs(&self, end: usize, output: usize) -> Vec<f64>;

    /// The limit position in which two modes of an end meet, whose closure polynomial has a simple turning point there; its place is
    /// none where it is not known.
    ///
    /// # Errors
    /// The reason where the two modes do not meet in one.
    fn limit(&self, end: usize, modes: [usize; 2]) -> Result<Option<Fold>, Code>;
}

/// Two neighbouring inputs in a chart.
pub(super) struct Piece {
    pub chart: usize,
    /// In the half tangent of the chart, or the distance, in the order of the sweep.
    pub ends: [Rational; 2],
}

/// A real root of the closure polynomial at an end, and its mode.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// The half tangent or the distance; none at the angle pi.
    pub t: Option<Rational>,
    /// The angle or the distance.
    value: f64,
    pub mode: usize,
}

/// A branch that passes a critical input, and where it was proved to stay.
struct Passage<'a> {
    sheets: [&'a Sheet; 2],
    rectangle: Rectangle,
    /// Whether the rectangle is in `1/t`.
    is_inverted: bool,
}

impl Passage<'_> {
    /// Whether none of the polynomials that vanish where translations are dependent vanishes near it.
    fn excludes_infinity(&self, chart: &Chart) -> bool {
        let nonzero = |p: &PlaneCurve| is_some_nonzero(std::slice::from_ref(p), &self.rectangle, self.is_inverted);
        chart.parallel.iter().all(nonzero)
    }
}

/// The difference of two outputs, angles modulo full turns.
fn apart(kind: Variable, a: f64, b: f64) -> f64 {
    if kind == Variable::Rotation { wrapped(a - b).abs() } else { (a - b).abs() }
}

/// The real roots at an input, each with the one mode that has it.
fn sheets(output: &Output, curve: &PlaneCurve, s: &Rational, values: &[f64]) -> Result<Vec<Sheet>, Code> {
    let polynomial = curve.at(s);
    let degree = polynomial.degree().ok_or(Code::BranchesNotMatched)?;
    let mut found: Vec<(Option<Rational>, f64)> = Vec::new();
    if degree > 0 {
        for mut root in polynomial.real_roots() {
            let t = root.to_f64();
            let value = if output.kind == Variable::Rotation { 2.0 * t.atan() } else { t };
            found.push((Rational::from_f64(t), value));
        }
    }
    match (curve.degree() - degree, output.kind) {
        (0, _) => {}
        (1, Variable::Rotation) => found.push((None, PI)),
        _ => return Err(Code::BranchesNotMatched),
    }
    if found.len() != values.len() {
        return Err(Code::BranchesNotMatched);
    }
    let sheet = |(t, value): (Option<Rational>, f64)| {
        let distance = |mode: &usize| apart(output.kind, values[*mode], value);
        let mode = (0..values.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let second = (0..values.len())
            .filter(|other| *other != mode)
            .map(|other| distance(&other))
            .fold(f64::INFINITY, f64::min);
        if !(second > CLEAR * distance(&mode)) {
            return None;
        }
        let size = if output.kind == Variable::Rotation { 1.0 } else { 1.0 + value.abs() };
        (distance(&mode) <= SAME * size).then_some(Sheet { t, value, mode })
    };
    let sheets: Option<Vec<Sheet>> = found.into_iter().map(sheet).collect();
    let sheets = sheets.ok_or(Code::BranchesNotMatched)?;
    let is_met = |mode: usize| sheets.iter().any(|sheet| sheet.mode == mode);
    if (0..values.len()).all(is_met) { Ok(sheets) } else { Err(Code::BranchesNotMatched) }
}

fn sorted([a, b]: [&Rational; 2]) -> [&Rational; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The bridge between two ends by one output, or why it is not proved.
pub(super) fn bridge(output: &Output, piece: &Piece, modes: &impl Ends) -> Result<Bridge, Code> {
    let chart = &output.charts[piece.chart];
    let [a, b] = &piece.ends;
    let interval = sorted([a, b]);
    let inside = output.between(piece.chart, interval).ok_or(Code::SingularNotDecided)?;
    let from = sheets(output, &chart.curve, a, &modes.outputs(0, output.joint))?;
    let to = sheets(output, &chart.curve, b, &modes.outputs(1, output.joint))?;
    match inside.as_slice() {
        [] => in_order(output, chart, interval, [from, to]),
        [critical] => across(output, chart, [a, b], critical, modes, [&from, &to]),
        _ => Err(Code::SingularNotDecided),
    }
}

/// Without a critical input the roots keep their order as seen from an output that none of them passes.
fn in_order(output: &Output, chart: &Chart, interval: [&Rational; 2], ends: [Vec<Sheet>; 2]) -> Result<Bridge, Code> {
    let [mut from, mut to] = ends;
    if from.len() != to.len() {
        return Err(Code::BranchesNotMatched);
    }
    let origin = match output.kind {
        Variable::Rotation => free_angle(chart, interval, &from, &to).ok_or(Code::BranchesNotMatched)?,
        Variable::Translation => 0.0,
    };
    let key = |sheet: &Sheet| match output.kind {
        Variable::Rotation => (sheet.value - origin).rem_euclid(TAU),
        Variable::Translation => sheet.value,
    };
    for list in [&mut from, &mut to] {
        sort::by(list, |x, y| key(x).total_cmp(&key(y)));
    }
    let mut bridge = blank(from.len(), to.len());
    for (x, y) in from.iter().zip(&to) {
        bridge.forwards[x.mode] = Fate::On(y.mode, Vec::new());
        bridge.backwards[y.mode] = Fate::On(x.mode, Vec::new());
    }
    Ok(bridge)
}

fn blank(from: usize, to: usize) -> Bridge {
    Bridge { forwards: vec![Fate::Lost; from], backwards: vec![Fate::Lost; to], folds: Vec::new() }
}

/// An angle that the output has nowhere in an interval.
fn free_angle(chart: &Chart, [low, high]: [&Rational; 2], from: &[Sheet], to: &[Sheet]) -> Option<f64> {
    let mut angles: Vec<f64> = from.iter().chain(to).map(|sheet| sheet.value).collect();
    if angles.is_empty() {
        return Some(0.0);
    }
    angles.sort_by(f64::total_cmp);
    let last = angles[0] + TAU;
    let next = angles.iter().skip(1).copied().chain([last]);
    let mut gaps: Vec<(f64, f64)> = angles.iter().zip(next).map(|(x, y)| (y - x, f64::midpoint(*x, y))).collect();
    sort::by(&mut gaps, |x, y| y.0.total_cmp(&x.0));
    gaps.iter().take(GAPS).find_map(|(_, angle)| {
        let tangent = (wrapped(*angle) / 2.0).tan();
        let t = Rational::from_f64(tangent)?;
        let across = chart.curve.across(&t);
        let at_end = [low, high].into_iter().any(|s| across.sign_at(s).is_eq());
        let is_free = !at_end && sign_changes(&across, [low, high]) == 0;
        is_free.then(|| 2.0 * tangent.atan())
    })
}

/// One critical input between two places: every branch must be proved to pass it, but for two that meet.
fn across(
    output: &Output,
    chart: &Chart,
    places: [&Rational; 2],
    critical: &Critical,
    modes: &impl Ends,
    [from, to]: [&[Sheet]; 2],
) -> Result<Bridge, Code> {
    let interval = sorted(places);
    if critical.event == Event::Locked {
        return Err(Code::InputLocked);
    }
    let passages = passages(output, chart, interval, from, to);
    let left = |side: usize, list: &[Sheet]| -> Vec<Sheet> {
        let is_left = |sheet: &&Sheet| passages.iter().all(|passage| passage.sheets[side].mode != sheet.mode);
        list.iter().filter(is_left).cloned().collect()
    };
    let (ends, begins) = (left(0, from), left(1, to));
    // Roots of the closure polynomial that meet, real or not, would have to be distinguished from those at infinity.
    let is_simple = critical.event == Event::Infinity && ends.is_empty() && begins.is_empty();
    let are_excluded = passages.iter().all(|passage| passage.excludes_infinity(chart));
    let passing = passages.len() * usize::from(are_excluded);
    let mut bridge = blank(from.len(), to.len());
    let [low, high] = modes.inputs();
    let input = f64::midpoint(low, high);
    for (index, passage) in passages.iter().enumerate() {
        let [x, y] = passage.sheets.map(|sheet| sheet.mode);
        let is_infinite = goes_to_infinity(output, chart, interval, &passages, index, is_simple)?;
        let fate = |mode| if is_infinite { Fate::Infinite(input, Vec::new()) } else { Fate::On(mode, Vec::new()) };
        (bridge.forwards[x], bridge.backwards[y]) = (fate(y), fate(x));
    }
    match (ends.as_slice(), begins.as_slice(), critical.event) {
        ([], [], _) => Ok(bridge),
        ([one, two], [], Event::Meeting(1)) => {
            let fates = meeting(chart, interval, (modes, 0), [one, two], passing)?;
            Ok(bridge.settle(true, [one.mode, two.mode], &fates))
        }
        ([], [one, two], Event::Meeting(1)) => {
            let fates = meeting(chart, interval, (modes, 1), [one, two], passing)?;
            Ok(bridge.settle(false, [one.mode, two.mode], &fates))
        }
        // All other roots are real and simple: they have no part in the discriminant.
        ([one, two], [three, four], Event::Meeting(order))
            if passages.len() + 2 == chart.curve.degree() && order % 2 == 0 =>
        {
            let node = Node { chart, kind: output.kind, interval, ends: places, sheets: [[one, two], [three, four]] };
            for [x, y] in node.pairs(order).ok_or(Code::SingularNotDecided)? {
                (bridge.forwards[x], bridge.backwards[y]) = (Fate::On(y, Vec::new()), Fate::On(x, Vec::new()));
            }
            Ok(bridge)
        }
        _ => Err(Code::SingularNotDecided),
    }
}

/// The fate of two modes that meet.
enum Meeting {
    /// They are one limit position, whose place may be known.
    Limit(Option<Fold>),
    /// Their translations go to infinity near this input.
    Infinite(f64),
}

impl Bridge {
    /// Sets the fates of two modes of one side.
    fn settle(mut self, is_low: bool, [one, two]: [usize; 2], meeting: &Meeting) -> Self {
        let (fates, folds) = match meeting {
            Meeting::Limit(fold) => {
                let folds = Vec::from_iter(*fold);
                let back = |mode| Fate::Back(mode, (0..folds.len()).collect());
                ([back(two), back(one)], folds)
            }
            Meeting::Infinite(input) => {
                ([Fate::Infinite(*input, Vec::new()), Fate::Infinite(*input, Vec::new())], Vec::new())
            }
        };
        let side = if is_low { &mut self.forwards } else { &mut self.backwards };
        let [first, second] = fates;
        (side[one], side[two]) = (first, second);
        self.folds = folds;
        self
    }
}

/// The branches that are proved to pass an interval without meeting another one.
fn passages<'a>(
    output: &Output,
    chart: &Chart,
    interval: [&Rational; 2],
    from: &'a [Sheet],
    to: &'a [Sheet],
) -> Vec<Passage<'a>> {
    let inverted = chart.curve.inverted();
    let mut passages: Vec<Passage<'a>> = Vec::new();
    for x in from {
        let free = |y: &&'a Sheet| passages.iter().all(|passage| passage.sheets[1].mode != y.mode);
        let mut candidates: Vec<&Sheet> = to.iter().filter(free).collect();
        candidates
            .sort_by(|a, b| apart(output.kind, a.value, x.value).total_cmp(&apart(output.kind, b.value, x.value)));
        let found = candidates.into_iter().take(2).find_map(|y| {
            let (curve, is_inverted) =
                if is_small(x) && is_small(y) { (&chart.curve, false) } else { (&inverted, true) };
            let rectangle = rectangle_of_graph(curve, interval, [x, y].map(|sheet| place(sheet, is_inverted)))?;
            Some(Passage { sheets: [x, y], rectangle, is_inverted })
        });
        passages.extend(found);
    }
    passages
}

/// Whether t is no larger than 1.
pub(super) fn is_small(sheet: &Sheet) -> bool {
    sheet.t.as_ref().is_some_and(|t| Rational::from(t.abs_ref()) <= 1)
}

/// t or 1/t.
pub(super) fn place(sheet: &Sheet, is_inverted: bool) -> Option<Rational> {
    match &sheet.t {
        None => is_inverted.then(Rational::new),
        Some(t) if is_inverted => (!t.is_zero()).then(|| t.clone().recip()),
        Some(t) => Some(t.clone()),
    }
}

/// A rectangle over an interval in which the zeros are one graph that passes both places.
fn rectangle_of_graph(
    curve: &PlaneCurve,
    interval: [&Rational; 2],
    places: [Option<Rational>; 2],
) -> Option<Rectangle> {
    let [Some(x), Some(y)] = places else { return None };
    HEIGHTS.into_iter().find_map(|height| {
        let rectangle = Rectangle::over(interval, [&x, &y], height);
        curve.is_graph_in(&rectangle).then_some(rectangle)
    })
}

/// Whether some of the polynomials has no zero in a rectangle.
pub(super) fn is_some_nonzero(list: &[PlaneCurve], rectangle: &Rectangle, is_inverted: bool) -> bool {
    let nonzero =
        |p: &PlaneCurve| if is_inverted { p.inverted().is_nonzero_in(rectangle) } else { p.is_nonzero_in(rectangle) };
    list.iter().any(nonzero)
}

/// Whether a branch that passes in its output goes to infinity on the way.
fn goes_to_infinity(
    output: &Output,
    chart: &Chart,
    interval: [&Rational; 2],
    passages: &[Passage<'_>],
    index: usize,
    is_simple: bool,
) -> Result<bool, Code> {
    let passage = &passages[index];
    if output.kind == Variable::Translation && passage.is_inverted {
        let signs = passage.sheets.map(|sheet| sheet.value.signum());
        return Ok(signs[0] != signs[1]);
    }
    if sign_changes(&chart.pole, interval) > 0 {
        // A simple root: there the translations of every branch are dependent.
        let is_pole = sign_changes(&chart.pole, interval) == 1 && is_simple;
        let is_open = is_some_nonzero(&chart.gap, &passage.rectangle, passage.is_inverted);
        return if is_pole && is_open { Ok(true) } else { Err(Code::SingularNotDecided) };
    }
    if chart.parallel.is_empty() || is_some_nonzero(&chart.parallel, &passage.rectangle, passage.is_inverted) {
        return Ok(false);
    }
    // Each of the polynomials has one simple root in common with the closure polynomial over this interval, so a real
    // one, and it is on no other branch.
    let is_single = chart.dependent.iter().chain([&chart.together]).all(|r| sign_changes(r, interval) == 1);
    let is_alone = passages.iter().enumerate().all(|(k, other)| k == index || other.excludes_infinity(chart));
    let is_open = is_some_nonzero(&chart.gap, &passage.rectangle, passage.is_inverted);
    if is_single && is_alone && is_simple && is_open { Ok(true) } else { Err(Code::SingularNotDecided) }
}

/// Returns the fate of two modes of an end that meet on the way to the other end.
fn meeting(
    chart: &Chart,
    interval: [&Rational; 2],
    (modes, end): (&impl Ends, usize),
    [one, two]: [&Sheet; 2],
    passing: usize,
) -> Result<Meeting, Code> {
    if sign_changes(&chart.pole, interval) > 0 {
        return Err(Code::SingularNotDecided);
    }
    if !chart.parallel.is_empty() {
        let is_inverted = !(is_small(one) && is_small(two));
        let places = [one, two].map(|sheet| place(sheet, is_inverted));
        let [Some(x), Some(y)] = places else { return Err(Code::SingularNotDecided) };
        let rectangle = Rectangle::over(interval, [&x, &y], 1);
        if !is_closed_in(chart, &rectangle, is_inverted) {
            return Err(Code::SingularNotDecided);
        }
        if !is_some_nonzero(&chart.parallel, &rectangle, is_inverted) {
            // All other roots are real and pass elsewhere: the root in common can only be the double one.
            let is_dependent = passing + 2 == chart.curve.degree() && has_root(&chart.common, interval);
            let is_open = is_some_nonzero(&chart.gap, &rectangle, is_inverted);
            let [low, high] = modes.inputs();
            let infinite = Meeting::Infinite(f64::midpoint(low, high));
            return if is_dependent && is_open { Ok(infinite) } else { Err(Code::SingularNotDecided) };
        }
    }
    modes.limit(end, [one.mode, two.mode]).map(Meeting::Limit)
}

/// Whether no branch leaves a rectangle through its upper or its lower side.
pub(super) fn is_closed_in(chart: &Chart, rectangle: &Rectangle, is_inverted: bool) -> bool {
    let [s, t] = &rectangle.centre;
    let [across, along] = &rectangle.reach;
    let side = |t: Rational| Rectangle { centre: [s.clone(), t], reach: [across.clone(), Rational::new()] };
    let sides = [side(Rational::from(t + along)), side(Rational::from(t - along))];
    let curve = std::slice::from_ref(&chart.curve);
    sides.iter().all(|side| is_some_nonzero(curve, side, is_inverted))
}

/// Whether a polynomial is sure to have a root in an open interval.
fn has_root(polynomial: &Univariate<rug::Integer>, interval: [&Rational; 2]) -> bool {
    polynomial.degree() > Some(0) && sign_changes(polynomial, interval) % 2 == 1
}
