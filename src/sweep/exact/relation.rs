//! The closure polynomial between the input and one output, without division, for each kind of loop that has one of
//! degree 8 at most.

use super::moved::{Moved, Running};
use super::plane_curve::{Integral, integral};
use crate::algebra::circle_fraction::CircleFraction;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::cut::Hidden;
use crate::elimination::kind::Elimination;
use crate::elimination::octic::{closure_polynomial, root_conditions};
use crate::elimination::separated::{Separated, powers, quartic};
use crate::elimination::spherical_four_bar::FourBar;
use crate::elimination::spherical_pair;
use crate::elimination::spherical_triangle::{conditions, triangle_without};
use crate::elimination::two_sided::TwoSided;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop, Variable};
use crate::kinematics::link_form::LinkForm;
use crate::kinematics::motion::Motion;
use rug::Rational;

/// A polynomial in the output, its coefficients functions of the input.
pub(super) type InOutput = Univariate<CircleFraction>;

/// The equations between an output and the input.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    /// Index of the output among the joint variables.
    pub output: usize,
    /// Whether it is an angle, of which the polynomials have the half tangent, or a distance.
    pub kind: Variable,
    /// All of them vanish together exactly where the loop closes: their greatest common divisor is the closure polynomial.
    pub equations: Vec<Integral>,
    /// All of them vanish where the directions of the translations are dependent, or another joint is left free; none for
    /// loops without such places.
    pub parallel: Vec<InOutput>,
    /// Where those vanish and these do not all vanish, the loop does not close: translations go to infinity.
    pub gap: Vec<InOutput>,
    /// The meaning of a factor in the input alone.
    pub content: Content,
}

/// The meaning of an input at which all equations vanish, whatever the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// The loop moves while its input stands still.
    Standing,
    /// Nothing of branches: apart from such inputs each zero is a configuration.
    Nothing,
    /// The loop may move while its input stands still, and zeros may be lost.
    Open,
}

impl Relation {
    /// A relation whose translations are never dependent.
    pub(super) fn of(output: usize, kind: Variable, equations: Vec<Integral>) -> Self {
        Self { output, kind, equations, parallel: Vec::new(), gap: Vec::new(), content: Content::Open }
    }

    /// Returns the relation of one equation.
    fn plain(output: usize, kind: Variable, equation: &InOutput) -> Self {
        Self::of(output, kind, vec![integral(equation)])
    }
}

/// Half tangents are counted from 0.
fn origin() -> [CircleFraction; 3] {
    [1, 1, 0].map(CircleFraction::from_integer)
}

/// `row . (1, cos, sin)` or `row . (1, d, d^2)` as a polynomial in the half tangent or the distance.
pub(super) fn of_row(kind: Variable, row: &[CircleFraction; 3]) -> InOutput {
    let powers = powers(kind, &origin());
    let coefficient = |k: usize| (0..3).fold(CircleFraction::zero(), |sum, i| sum.add(&row[i].mul(&powers[i][k])));
    Univariate::new((0..3).map(coefficient).collect())
}

/// Returns the relations of a loop between its running variable, an angle counted from `offset`, and each output for which the
/// others can be eliminated; the list is empty for loops without a route.
pub(super) fn relations(chain: &Chain, layout: &Layout, moved: Moved<'_>, offset: &Rational) -> Vec<Relation> {
    let running = moved.at(offset);
    let Some(closing) = running.closing() else { return Vec::new() };
    if layout.second_spherical.is_some() {
        return ss_dyad(chain, layout, &running, &closing).into_iter().collect();
    }
    let filled = layout.with_idle(layout.missing(), 0);
    let Ok(Some(open)) = chain.open_loop_over::<CircleFraction>(&filled, &running) else { return Vec::new() };
    let closed = OpenLoop::close(&open, &closing);
    let indices = filled.joint_variables();
    if layout.missing() > 0 {
        // With numbers for its input an overconstrained loop closes at single values only.
        if !moved.is_input() {
            return Vec::new();
        }
        let is_plain = layout.spherical.is_none();
        let found = if is_plain { super::four_joints::relations(&closed, indices) } else { Vec::new() };
        return if found.is_empty() { super::by_cut::relations(chain, layout, offset) } else { found };
    }
    let Some(indices) = indices.into_iter().collect::<Option<Vec<usize>>>() else { return Vec::new() };
    let spherical = layout.spherical_unknown();
    let special = TwoSided::of(&closed, spherical, 0.0).map_or(Vec::new(), |way| two_sided(&closed, way, &indices));
    match Elimination::of(closed.variables, spherical) {
        _ if !special.is_empty() => special,
        Elimination::Centre(_) => special,
        Elimination::Triangle => triangles(&closed, &indices),
        Elimination::FourBar => four_rotations(&closed, &indices),
        Elimination::Cut | Elimination::Planar => Vec::new(),
    }
}

/// The relations of an overconstrained loop with every output, the joints beside the input first.
pub(super) fn of_every_output(chain: &Chain, layout: &Layout, moved: Moved<'_>, offset: &Rational) -> Vec<Relation> {
    let mut found = relations(chain, layout, moved, offset);
    for other in super::by_cut::of_every_output(chain, layout, offset) {
        if found.iter().all(|known| known.output != other.output) {
            found.push(other);
        }
    }
    found
}

/// Two spherical joints: their centres keep their distance.
fn ss_dyad(
    chain: &Chain,
    layout: &Layout,
    running: &Running<'_>,
    closing: &Motion<CircleFraction>,
) -> Option<Relation> {
    let ss_dyad = chain.open_ss_dyad::<CircleFraction>(layout, running).ok()?.close(closing);
    let equation = of_row(ss_dyad.variable, &spherical_pair::equation(&ss_dyad));
    Some(Relation::plain(ss_dyad.indices[2], ss_dyad.variable, &equation))
}

/// Two equations with an unknown on either side, either one kept.
fn two_sided(closed: &ClosedLoop<CircleFraction>, way: TwoSided, indices: &[usize]) -> Vec<Relation> {
    let Some(equations) = way.equations(closed) else { return Vec::new() };
    let outputs = way.unknowns(closed.variables).map(|unknown| indices[unknown]);
    let one = |hidden: usize| {
        let relation = separated(&equations, hidden, outputs[hidden])?;
        let parallel = way.undetermined(closed, hidden).iter().map(|form| of_row(relation.kind, form)).collect();
        Some(Relation { parallel, ..relation })
    };
    (0..2).filter_map(one).collect()
}

/// Two equations with separated sides, the unknown of one of them kept.
fn separated(equations: &Separated<CircleFraction>, hidden: usize, output: usize) -> Option<Relation> {
    let other = equations.solved(1 - hidden);
    if other[0][0].is_zero() {
        return None;
    }
    let kind = equations.kinds[hidden];
    let polynomial = quartic(&equations.conic(hidden, &other), &powers(kind, &origin()));
    Some(Relation::plain(output, kind, &Univariate::new(polynomial.to_vec())))
}

/// Three rotations, which close by themselves, and three translations.
fn triangles(closed: &ClosedLoop<CircleFraction>, indices: &[usize]) -> Vec<Relation> {
    let Some(form): Option<LinkForm<_, 3, 3>> = LinkForm::of(closed) else { return Vec::new() };
    let one = |dropped: usize| {
        let triangle = triangle_without(&form, dropped);
        let found = conditions(&form, &triangle, &origin())?;
        let output = indices[form.rotations[(dropped + 2) % 3]];
        Some(Relation {
            parallel: vec![found.determinant.0],
            gap: found.bridged.into_iter().map(|(gap, _)| gap).collect(),
            ..Relation::plain(output, Variable::Rotation, &found.roots)
        })
    };
    (0..3).filter_map(one).collect()
}

/// Four rotations and two translations.
fn four_rotations(closed: &ClosedLoop<CircleFraction>, indices: &[usize]) -> Vec<Relation> {
    let Some(form): Option<LinkForm<_, 4, 2>> = LinkForm::of(closed) else { return Vec::new() };
    let choices = (0..4).flat_map(|base| [Hidden::First, Hidden::Second].map(|hidden| (base, hidden)));
    choices.filter_map(|(base, hidden)| four_bar(&form, base, hidden, indices)).collect()
}

/// A spherical four-bar seen from one link, one of the two angles at it kept.
fn four_bar(form: &LinkForm<CircleFraction, 4, 2>, base: usize, hidden: Hidden, indices: &[usize]) -> Option<Relation> {
    let bar = FourBar::new(form, base)?;
    let equations = bar.equations();
    let found = root_conditions(&bar, &equations, hidden, &origin());
    let output = indices[form.rotations[(base + usize::from(hidden == Hidden::Second)) % 4]];
    Some(Relation {
        parallel: found.parallel.to_vec(),
        gap: found.gap.to_vec(),
        ..Relation::plain(output, Variable::Rotation, &closure_polynomial(&equations, hidden, &origin()))
    })
}
