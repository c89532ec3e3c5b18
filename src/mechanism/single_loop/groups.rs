//! Self-motions of joints whose motions form a group, proved where the data are rational.
//!
//! Rotations about one line form a group, and so do those about parallel lines with the displacements of the planes across them. While all
//! other joints stand still, joints with such axes at one configuration have such axes at all, and what they make together stays in the
//! group, of 1 or 3 dimensions: with n of them, the solutions through that configuration have n - 1 or n - 3 dimensions at least.

use super::Question;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::assembly::{Assembly, Mode, Roots, Workspace};
use crate::kinematics::closed_loop::{OpenLoop, Variable};
use crate::kinematics::data_field::{ClosedForm, JointMotion};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::mechanism::data::Data;
use crate::solve::scalar::Extended;
use crate::solve::self_motion::SelfMotion;
use crate::verdict::{Code, Proof, Status, Verdict};
use rug::Rational;

/// A cosine or sine this near to a whole number is taken for it; the exact closure decides.
const WHOLE: f64 = 1e-9;

/// A point of an axis, and its direction.
type Line = [Vector<Rational>; 2];

/// What the axes of joints have in common.
#[derive(Clone, Copy, PartialEq)]
enum Common {
    Line,
    Direction,
}

impl Question<'_> {
    /// The verdict at a singular pose of an arm with a closed form of which each candidate is certified or lies on a self-motion, one of
    /// them of a group of motions, which is proved. `None` where that is not so; the list is undefined then.
    pub(super) fn by_groups(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> Option<Verdict> {
        let pose = self.case.pose.as_ref()?;
        let solver = &self.prepared.solver;
        let is_open = self.only_lists || !solver.is_decoupled() || solver.structural_rank() < 6;
        let is_rounded = pose.given.is_some() && pose.closed.is_none();
        if is_open || is_rounded || !matches!(self.prepared.data(&self.of.chain), Data::Rational) {
            return None;
        }
        let enclosed = || self.prepared.enclosed(&self.of.chain, self.case).ok().flatten();
        let exact = || enclosed()?.rounded(DoubleDouble::BITS);
        if !solver.solve_beside_families(self.gap, self.most(0), &exact, workspace, assembly) {
            return None;
        }
        let (joints, common) = assembly.families.iter().find_map(|family| self.group(family))?;
        let names: Vec<String> = joints.iter().map(usize::to_string).collect();
        // The list is that of what is asked for.
        let is_listed = |mode: &&Mode| mode.real || self.roots == Roots::All;
        let number = assembly.modes.iter().filter(is_listed).count();
        let are = match common {
            Common::Line => "are one line",
            Common::Direction => "are parallel",
        };
        let reason = format!(
            "solutions form a self-motion: where all other joints stand as the exact pose allows, the axes of the joints {} {are}, so \
             that the solutions, real or complex, have dimension {} at least; the isolated ones are listed, not proved complete",
            names.join(", "),
            dimension(joints.len(), common),
        );
        Some(Verdict {
            status: Status::SelfMotion,
            proof: Proof::Proved,
            code: Code::SelfMotion,
            complex_complete: false,
            complex: assembly.total(),
            real: assembly.real(),
            at_infinity: 0,
            self_motion: assembly.self_motion,
            certified: number,
            reason,
        })
    }

    /// Returns the numbers of the joints that move in a self-motion, and what their axes have in common, where that proves it.
    fn group(&self, family: &SelfMotion) -> Option<(Vec<usize>, Common)> {
        let variables = self.prepared.layout.loop_kinds();
        let moving: Vec<usize> = (0..6).filter(|&k| family.moving[k]).collect();
        if moving.iter().any(|&k| variables[k] != Variable::Rotation) {
            return None;
        }
        let common = self.common_as_given(&moving).or_else(|| self.common_where_closed(&moving, family))?;
        if dimension(moving.len(), common) != family.dimension {
            return None;
        }
        let joints = self.prepared.layout.joint_variables();
        let numbers: Option<Vec<usize>> = moving.iter().map(|&k| joints[k].map(|joint| joint + 1)).collect();
        Some((numbers?, common))
    }

    /// What axes have in common at the joint values that the pose was given by.
    fn common_as_given(&self, moving: &[usize]) -> Option<Common> {
        let Some(ClosedForm::Joints(motions)) = &self.case.pose.as_ref()?.closed else { return None };
        let open: OpenLoop<Rational> = self.of.chain.try_open_loop(&self.prepared.layout).ok().flatten()?;
        let joints = self.prepared.layout.joint_variables();
        let (first, last) = (*moving.first()?, *moving.last()?);
        let mut frame = Motion::<Rational>::identity();
        let mut lines = Vec::new();
        for k in first..=last {
            if moving.contains(&k) {
                lines.push(line(&frame));
            } else {
                let motion = match motions.get(joints[k]?)? {
                    JointMotion::Turn((cos, sin)) => Motion::rotation_z(cos.as_rational()?, sin.as_rational()?),
                    JointMotion::Shift(distance) => Motion::translation_z(distance.as_rational()?),
                };
                frame = frame.then_after(&motion);
            }
            if k < last {
                frame = frame.then_after(&open.constants[k]);
            }
        }
        common(&lines)
    }

    /// What axes have in common where all other joints are rotations at quarter turns, as they are up to rounding on a self-motion, if what is
    /// left for them to make is in their group.
    fn common_where_closed(&self, moving: &[usize], family: &SelfMotion) -> Option<Common> {
        let is_turn = |k: usize| self.prepared.layout.loop_kinds()[k] == Variable::Rotation;
        if self.case.pose.as_ref()?.closed.is_some() || !(0..6).all(is_turn) {
            return None;
        }
        let (closed, sample) = (self.exact()?, family.points.first()?);
        let mut frame = Motion::<Rational>::identity();
        let mut lines = Vec::new();
        for k in 0..6 {
            if moving.contains(&k) {
                lines.push(line(&frame));
            } else {
                let (sin, cos) = sample[k].sin_cos();
                frame = frame.then_after(&Motion::rotation_z(whole(cos)?, whole(sin)?));
            }
            frame = frame.then_after(&closed.constants[k]);
        }
        let common = common(&lines)?;
        let [point, axis] = &lines[0];
        let moved = difference(&frame.apply(point), point);
        let is_in_group = match common {
            Common::Line => is_zero(&moved),
            Common::Direction => dot(axis, &moved).is_zero(),
        };
        (is_in_group && frame.rotate(axis) == *axis).then_some(common)
    }
}

/// The dimension that the solutions have at least where so many joints move.
fn dimension(joints: usize, common: Common) -> usize {
    joints - if common == Common::Line { 1 } else { 3 }
}

/// What lines have in common, if that are joints enough to move. Where neighbours are apart, three of four parallel axes make every
/// motion of their planes but special ones, real or complex, and the fourth one turns freely.
fn common(lines: &[Line]) -> Option<Common> {
    let [[point, axis], ..] = lines else { return None };
    let is_along = |other: &Line| is_zero(&cross(axis, &other[1]));
    let is_on = |other: &Line, point: &Vector<Rational>| is_zero(&cross(axis, &difference(&other[0], point)));
    if !lines.iter().all(is_along) {
        return None;
    }
    if lines.iter().all(|other| is_on(other, point)) {
        return (lines.len() > 1).then_some(Common::Line);
    }
    let are_apart = lines.windows(2).all(|pair| !is_on(&pair[1], &pair[0][0]));
    (lines.len() == 4 && are_apart).then_some(Common::Direction)
}

/// The z axis of a frame.
fn line(frame: &Motion<Rational>) -> Line {
    [frame.translation.clone(), std::array::from_fn(|i| frame.rotation[i][2].clone())]
}

fn difference(a: &Vector<Rational>, b: &Vector<Rational>) -> Vector<Rational> {
    std::array::from_fn(|i| a[i].sub(&b[i]))
}

fn is_zero(v: &Vector<Rational>) -> bool {
    v.iter().all(Ring::is_zero)
}

fn whole(x: f64) -> Option<Rational> {
    let rounded = x.round();
    if (x - rounded).abs() < WHOLE { Rational::from_f64(rounded) } else { None }
}
