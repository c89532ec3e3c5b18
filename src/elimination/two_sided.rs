//! The eliminations that lead to two equations with one unknown on either side, and back: one list, which everyone asks.

use super::opposite_axes::OppositeAxes;
use super::point_reach::Reach;
use super::separated::{Plan, Separated};
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::link_form::LinkForm;

/// Such an elimination of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwoSided {
    /// The centre of the spherical joint whose first rotation is this unknown is reached from both sides.
    Centre(usize),
    /// The two translations of a loop of four rotations run along opposite axes.
    OppositeAxes(OppositeAxes),
}

/// What a derivation says about the two equations.
pub struct Words {
    /// The names of the equations.
    pub names: [String; 2],
    /// Where they come from.
    pub before: String,
    /// How the other unknowns follow.
    pub after: String,
}

/// Cosine and sine of every unknown, or its distance and 0; `None` for the rotations of a spherical joint, which the others determine.
pub type Known<F> = [Option<(F, F)>; 6];

/// The unknown that is rotation n of a loop, counted round it.
fn rotation(variables: [Variable; 6], n: usize) -> usize {
    (0..6).filter(|k| variables[*k] == Variable::Rotation).cycle().nth(n).unwrap_or(0)
}

impl TwoSided {
    /// The first one that fits a loop, `spherical` the first rotation of a spherical joint in it; numbers no larger than
    /// `tolerance` (0 in exact fields) are zero.
    #[must_use]
    pub fn of<F: Field>(closed: &ClosedLoop<F>, spherical: Option<usize>, tolerance: f64) -> Option<Self> {
        let opposite = || OppositeAxes::of(&LinkForm::of(closed)?, tolerance).map(Self::OppositeAxes);
        spherical.map(Self::Centre).or_else(opposite)
    }

    /// Returns whether no other elimination is left where this one's equations fall apart into one in each unknown.
    #[must_use]
    pub fn is_last(self) -> bool {
        match self {
            Self::Centre(_) => true,
            Self::OppositeAxes(_) => false,
        }
    }

    /// Returns the two equations; `None` for a loop that it does not fit.
    #[must_use]
    pub fn equations<R: Ring>(self, closed: &ClosedLoop<R>) -> Option<Separated<R>> {
        match self {
            Self::Centre(spherical) => Some(Reach::of(closed, spherical).equations),
            Self::OppositeAxes(axes) => Some(axes.equations(&LinkForm::of(closed)?)),
        }
    }

    /// As [`Self::equations`]; `None` too where they fall apart and another elimination is left.
    #[must_use]
    pub fn serves<F: Field>(self, closed: &ClosedLoop<F>) -> Option<Separated<F>> {
        let is_apart = |equations: &Separated<F>| matches!(equations.plan(0.0), Plan::Apart { .. });
        self.equations(closed).filter(|equations| self.is_last() || !is_apart(equations))
    }

    /// Returns the unknown on either side.
    #[must_use]
    pub fn unknowns(self, variables: [Variable; 6]) -> [usize; 2] {
        match self {
            Self::Centre(spherical) => [5, 3].map(|k| (spherical + k) % 6),
            Self::OppositeAxes(axes) => [1, 3].map(|k| rotation(variables, axes.first + k)),
        }
    }

    /// Returns all unknowns from the monomials of those two.
    #[must_use]
    pub fn known<F: Field>(self, closed: &ClosedLoop<F>, monomials: [&[F; 3]; 2]) -> Option<Known<F>> {
        let mut known: Known<F> = [const { None }; 6];
        let pair = |variable: Variable, m: &[F; 3]| match variable {
            Variable::Rotation => (m[1].clone(), m[2].clone()),
            Variable::Translation => (m[1].clone(), F::zero()),
        };
        match self {
            Self::Centre(spherical) => {
                let reach = Reach::of(closed, spherical);
                let [first, _, third] = reach.variables;
                let others = [pair(first, monomials[1]), reach.middle(monomials)?, pair(third, monomials[0])];
                for (k, other) in others.into_iter().enumerate() {
                    known[(spherical + 3 + k) % 6] = Some(other);
                }
            }
            Self::OppositeAxes(axes) => {
                let form: LinkForm<F, 4, 2> = LinkForm::of(closed)?;
                let [j, k] = monomials.map(|m| pair(Variable::Rotation, m));
                let rotations = axes.rotations(&form, &j, &k)?;
                known = form.unknowns_at(&rotations)?.map(Some);
            }
        }
        Some(known)
    }

    /// Returns the forms over the monomials of the unknown on a side that all vanish where it leaves other unknowns undetermined.
    #[must_use]
    pub fn undetermined<R: Ring>(self, closed: &ClosedLoop<R>, side: usize) -> Vec<[R; 3]> {
        match self {
            Self::Centre(spherical) => {
                let Reach { variables, sides, .. } = Reach::of(closed, spherical);
                // On the axis of the middle joint the centre leaves it free.
                let across = if variables[1] == Variable::Rotation { &[0, 1][..] } else { &[] };
                across.iter().map(|i| sides[side].each_ref().map(|moving| moving[*i].clone())).collect()
            }
            Self::OppositeAxes(axes) => {
                LinkForm::of(closed).map_or(Vec::new(), |form| axes.across(&form, side).to_vec())
            }
        }
    }

    /// Returns what a derivation says of a loop with these unknowns, by the labels of its joints.
    #[must_use]
    pub fn words<'l>(self, variables: [Variable; 6], label: impl Fn(usize) -> &'l str) -> Words {
        let [near, far] = self.unknowns(variables);
        match self {
            Self::Centre(spherical) => {
                let second = (spherical + 4) % 6;
                let centre = label(spherical).split('_').next().unwrap_or_default();
                let (names, how) = match variables[second] {
                    Variable::Rotation => {
                        (["n.r", "r.r"], "have the same height along the axis and the same distance from a point of it")
                    }
                    Variable::Translation => (["x.r", "y.r"], "lie over the same point of a plane across the axis"),
                };
                let second = label(second);
                Words {
                    names: names.map(|name| format!("centre of spherical joint {centre}, axis {second}, {name}")),
                    before: format!(
                        "The centre of spherical joint {centre}, carried by joint {} on one side and by joint {} on the other, is \
                         brought together by joint {second}: seen from there both places {how}.",
                        label(near),
                        label(far),
                    ),
                    after: format!("Joint {second} and the rotation of the spherical joint follow rationally."),
                }
            }
            Self::OppositeAxes(axes) => {
                let [one, two] = [0, 2].map(|k| label(rotation(variables, axes.first + k)));
                Words {
                    names: ["n.n'", "n.(r x n')"].map(|name| format!("dual cosine {one}-{two} {name}")),
                    before: format!(
                        "The translations run along the axes of joints {one} and {two}: angle and moment of these two lines are free \
                         of them and of both rotations about them."
                    ),
                    after: "The rotations about both axes and the two translations follow rationally.".to_owned(),
                }
            }
        }
    }
}
