//! A wrist in place of a spherical joint: three neighbouring axes through one point, the middle one square to both others.
//!
//! Every rotation is one of a wrist, by two triples of angles, and the sine of the middle angle tells these apart unless it is 0. So the
//! configurations of the loop are a covering of two sheets of those of the loop with a spherical joint, provided that this sine is 0 at
//! none: docs/sweep.md.

use crate::algebra::ring::Ring;
use crate::exact::{Linkage, Positions, positions};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::motion::Motion;
use crate::sweep::bridge::{Bridge, Fate};
use crate::sweep::sample::Sample;
use crate::verdict::Code;
use rug::Rational;

/// A sine of the middle angle is no smaller than this in f64: far more than the error of any certified mode.
const FLAT: f64 = 1e-6;

/// The three rotations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrist {
    /// Index of the first one among the joint variables.
    pub first: usize,
    /// Index of the middle one.
    middle: usize,
}

/// The modes of a sample on one sheet, and the index of each among all.
struct Sheet {
    sample: Sample,
    modes: Vec<usize>,
}

impl Wrist {
    /// The wrist of a loop of six unknowns, which is at no configuration stretched or folded; `None` where that is not proved.
    pub fn of(chain: &Chain, layout: &Layout) -> Option<Self> {
        if layout.spherical.is_some() || layout.locked.is_none() || layout.variables.len() != 7 {
            return None;
        }
        let linkage = Linkage::of(chain).ok()?;
        let open = chain.open_loop::<Rational>(layout).ok()?;
        let indices = layout.joint_variables();
        // No number at the middle of the wrist is on its way: the frames of all three axes have one origin.
        let is_square =
            |link: &Motion<Rational>| link.translation.iter().all(Ring::is_zero) && link.rotation[2][2].is_zero();
        (0..4).find_map(|first| {
            let turn = (first..first + 3).all(|k| open.variables[k] == Variable::Rotation);
            let is_wrist = turn && open.constants[first..first + 2].iter().all(is_square);
            let [one, middle, last] = [0, 1, 2].map(|k| indices[first + k]);
            let (one, middle, last) = (one?, middle?, last?);
            (is_wrist && is_never_flat(&linkage, [middle, last])).then_some(Self { first: one, middle })
        })
    }

    /// Returns the bridge between two samples, made of those of both sheets.
    pub fn bridge(
        self,
        [low, high]: [&Sample; 2],
        one: impl Fn([&Sample; 2]) -> Result<Bridge, Code>,
    ) -> Result<Bridge, Code> {
        let (froms, tos) = (self.sheets(low)?, self.sheets(high)?);
        let blank = |sample: &Sample| vec![Fate::Lost; sample.modes.len()];
        let mut whole = Bridge { forwards: blank(low), backwards: blank(high), folds: Vec::new() };
        for (from, to) in froms.iter().zip(&tos) {
            let part = one([&from.sample, &to.sample])?;
            let before = whole.folds.len();
            let later = |folds: Vec<usize>| folds.into_iter().map(|fold| before + fold).collect();
            let fate = |fate: Fate, own: &Sheet, other: &Sheet| match fate {
                Fate::On(mode, folds) => Fate::On(other.modes[mode], later(folds)),
                Fate::Back(mode, folds) => Fate::Back(own.modes[mode], later(folds)),
                Fate::Infinite(input, folds) => Fate::Infinite(input, later(folds)),
                Fate::Still => Fate::Still,
                Fate::Lost => Fate::Lost,
            };
            for (k, one) in part.forwards.into_iter().enumerate() {
                whole.forwards[from.modes[k]] = fate(one, from, to);
            }
            for (k, one) in part.backwards.into_iter().enumerate() {
                whole.backwards[to.modes[k]] = fate(one, to, from);
            }
            whole.folds.extend(part.folds);
        }
        Ok(whole)
    }

    /// The modes of a sample by the sign of the sine of the middle angle.
    fn sheets(self, sample: &Sample) -> Result<[Sheet; 2], Code> {
        let sine = |mode: usize| sample.modes[mode][self.middle].sin();
        if (0..sample.modes.len()).any(|mode| !(sine(mode).abs() > FLAT)) {
            return Err(Code::BranchesNotMatched);
        }
        Ok([false, true].map(|is_positive| {
            let modes: Vec<usize> = (0..sample.modes.len()).filter(|mode| (sine(*mode) > 0.0) == is_positive).collect();
            let mut own = sample.clone();
            own.modes = modes.iter().map(|mode| sample.modes[*mode].clone()).collect();
            own.points = modes.iter().map(|mode| sample.points[*mode]).collect();
            Sheet { sample: own, modes }
        }))
    }
}

/// Whether the loop closes nowhere with the middle axis of a wrist at 0 or half a turn. There the first and the last axis are one, so
/// that the last one may be held as well.
fn is_never_flat(linkage: &Linkage<Rational>, [middle, last]: [usize; 2]) -> bool {
    let pair = |[c, s]: [i32; 2]| [Rational::from(c), Rational::from(s)];
    [[1, 0], [0, 1]].into_iter().all(|flat| {
        let held = linkage.locked(&[(middle, pair(flat)), (last, pair([1, 0]))]);
        matches!(positions(&held), Positions::Finite { found, .. } if found.is_empty())
    })
}
