//! Loops of seven joint variables and more, which in general move: a real configuration is found, proved and seen to be
//! regular.

use super::answer::{Configuration, Held, JointVariable, Mobility};
use super::branches::{Curve, floating};
use super::decision::{Subject, solve};
use super::order::Local;
use super::search::{Outcome, Search, search};
use crate::algebra::number::{Angle, HalfTangent, Number, nearest_f64};
use crate::assembly::{Assembly, Roots, Solver, Workspace};
use crate::catalogue::entry::{Case, Input, InputValue};
use crate::certify::refined_certificate;
use crate::exact::linkage::{Axis, JointValue, Linkage};
use crate::kinematics::chain::JointKind;
use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::span::too_long;
use crate::mechanism::FullMode;
use crate::solve::newton::approach;
use crate::verdict::{Code, Proof, Status};
use looproot_calculus::finite::finite;
use nalgebra::DVector;
use num_complex::Complex;
use rug::{Float, Rational};
use std::f64::consts::PI;

/// Tangents of half the angles at which a joint is held.
const TANGENTS: [(i32, i32); 6] = [(1, 2), (-1, 3), (4, 3), (-7, 3), (-5, 7), (8, 3)];
/// Places from which a configuration is approached.
const STARTS: u32 = 120;
/// Newton's steps from each of them.
const STEPS: usize = 40;
/// Places at which complex configurations are looked for where no real ones are found.
const COMPLEX: usize = 8;
/// Longest step, in half angles and in lengths over the mean link.
const STEP: f64 = 0.6;
/// Bits in which lengths of axes are computed.
const BITS: u32 = 256;
/// Closure residuals below this are taken for a configuration, which is then proved or not.
const CLOSED: f64 = 1e-11;
/// Screws are independent if what one adds to the others is more than this part of the largest.
const INDEPENDENT: f64 = 1e-4;
/// Factor by which a joint variable is preferred for holding if it is not in a spherical joint.
const SPHERICAL: f64 = 8.0;
/// Decimal digits of values at which joints are held.
const DIGITS: u32 = 3;

impl Subject<'_> {
    /// Decides the mobility of a loop of seven variables or more.
    pub(super) fn free(&self) -> Mobility {
        if let Outcome::Mobile(found) = search_group(&self.linkage, &self.spherical_joints()) {
            return self.rounded(self.mobile(found));
        }
        if let Some(reason) = self.too_wide() {
            return self.answer(Some(0), (Proof::Proved, Code::LinkTooLong), reason);
        }
        let mut assembler = Assembler::of(self);
        // Certificates of `solve` hold for all numbers that the file may mean.
        if let Some(found) = self.by_input() {
            return self.certified(found);
        }
        if let Some(found) = assembler.assembled() {
            return self.rounded(self.certified(found));
        }
        if let Some(answer) = self.between_spherical_joints() {
            return answer;
        }
        let none = format!(
            "no regular real configuration was found: approached from {STARTS} places, the closure equations are off by {:.1e} \
             at least",
            assembler.nearest()
        );
        let n = self.variables.len();
        if let Some((held, complex)) = assembler.complex() {
            let found = Search { held, configurations: Vec::new(), complex };
            let held = self.held(&found);
            let reason = format!(
                "{none}; complex ones there are: {complex} with {held} held, some of them certified and regular, so that {n} - 6 \
                 variables move over the complex numbers (theorem 1)"
            );
            return Mobility {
                held: found.held,
                complex,
                ..self.answer(None, (Proof::None, Code::ComplexMotion), reason)
            };
        }
        let rank = Freedom::of(self.chain).rank;
        let general = match rank.filter(|rank| *rank < 6) {
            Some(rank) => format!(
                "; the screw rank in general position is {rank}: in general such a loop cannot be closed, and where it can {n} - \
                 {rank} freedoms remain at least"
            ),
            None => String::new(),
        };
        self.answer(None, (Proof::None, Code::NotDecided), none + &general)
    }

    /// Loops of two neighbouring spherical joints and one more variable, whose real configurations are all multiple: the equation for the
    /// distance of the centres leaves that variable finitely many values, and only the link between the centres spins.
    fn between_spherical_joints(&self) -> Option<Mobility> {
        let spherical_joints = self.spherical_joints();
        let [first, second] = *spherical_joints.as_slice() else { return None };
        if self.variables.len() != 7 {
            return None;
        }
        let link = if second == first + 3 { first + 2 } else { second + 2 };
        // Centres that coincide let that link turn in all three directions.
        if self.linkage.links[link].to_motion()?.translation.iter().all(|x| *x == 0) {
            return None;
        }
        let solution = solve(self.entry, Case::free(0), false).ok()?;
        let verdict = &solution.verdict;
        let is_decided = verdict.status == Status::Complete && verdict.proof.is_proved() && verdict.complex_complete;
        if !is_decided || verdict.real == 0 {
            return None;
        }
        let real = solution.modes.iter().filter(|mode| mode.real);
        let place =
            |mode: &FullMode| self.placed(mode.q.iter().map(|z| z.re).collect(), Local::Manifold { dimension: 1 });
        let configurations: Vec<Configuration> = real.map(place).collect();
        let reason = format!(
            "the equation for the distance of the centres of both S joints leaves the other joint finitely many values: {}; only the spin \
             of the link between the S joints is left",
            verdict.reason
        );
        let rests_on = (Proof::Proved, Code::ExactRootsMatched);
        Some(Mobility { configurations, complex: verdict.complex, ..self.answer(Some(1), rests_on, reason) })
    }

    /// Certified regular configurations of a loop with more variables than equations.
    fn certified(&self, found: Search) -> Mobility {
        let n = self.variables.len();
        let reason = format!(
            "{n} joint variables, six independent equations at a certified regular configuration, with {} held: by the implicit \
             function theorem {n} - 6 variables move (theorem 1){}",
            self.held(&found),
            self.idle()
        );
        Mobility {
            held: found.held,
            configurations: found.configurations,
            complex: found.complex,
            ..self.answer(Some(n - 6), (Proof::Proved, Code::RegularConfiguration), reason)
        }
    }

    /// The spins of what stands between two spherical joints.
    fn idle(&self) -> String {
        let kinds = self.chain.joint_kinds();
        let spherical_joints: Vec<usize> =
            (1..).zip(&kinds).filter(|(_, kind)| **kind == JointKind::Spherical).map(|(joint, _)| joint).collect();
        match spherical_joints.as_slice() {
            [] | [_] => String::new(),
            [one, two] => format!(
                "; one of these freedoms is idle: the spin of what stands between the S joints {one} and {two} about the line of \
                 their centres"
            ),
            _ => {
                let pairs = (0..spherical_joints.len()).map(|k| {
                    format!("{} and {}", spherical_joints[k], spherical_joints[(k + 1) % spherical_joints.len()])
                });
                format!(
                    "; {} of these freedoms are idle: the spins of what stands between the S joints {} about the lines of their \
                     centres",
                    spherical_joints.len(),
                    pairs.collect::<Vec<_>>().join(", ")
                )
            }
        }
    }

    /// Why a loop without translations cannot close: one link is longer than all others together.
    pub(super) fn too_wide(&self) -> Option<String> {
        if self.linkage.variables.contains(&Variable::Translation) {
            return None;
        }
        let mut motions = Vec::new();
        for link in &self.linkage.links {
            motions.push(link.to_motion()?);
        }
        too_long(motions.iter().map(|motion| &motion.translation))
    }

    /// Certified configurations with one joint held, as `solve` finds them.
    fn by_input(&self) -> Option<Search> {
        for (k, JointVariable { joint, variable }) in self.variables.iter().copied().enumerate() {
            if self.chain.joint_kinds()[joint - 1] == JointKind::Spherical {
                continue;
            }
            for tangent in TANGENTS.map(Rational::from) {
                let (value, held) = match variable {
                    Variable::Rotation => {
                        let angle = Angle::from_half_tangent(HalfTangent::Finite(tangent));
                        let radians = angle.radians();
                        (InputValue::Angle(angle), radians)
                    }
                    Variable::Translation => {
                        let distance = Number::exact(tangent * 2 * self.linkage.unit());
                        let length = distance.to_f64();
                        (InputValue::Distance(distance), length)
                    }
                };
                // A joint that a single input cannot hold is held in another way.
                let solution = solve(self.entry, Case::given(Input { joint, value }, 0), false).ok()?;
                let certified: Vec<&FullMode> =
                    solution.modes.iter().filter(|m| m.real && m.certified && m.multiplicity < 2).collect();
                if !certified.is_empty() {
                    let configurations: Vec<Configuration> = certified.into_iter().map(|m| self.measured(m)).collect();
                    return Some(Search { held: vec![(k, held)], configurations, complex: solution.verdict.complex });
                }
            }
        }
        None
    }

    /// Returns the indices at which the joint variables of spherical joints begin.
    pub(super) fn spherical_joints(&self) -> Vec<usize> {
        let kinds = self.chain.joint_kinds();
        let is_spherical = |k: usize| kinds[self.variables[k].joint - 1] == JointKind::Spherical;
        let is_first = |k: usize| k == 0 || self.variables[k - 1].joint != self.variables[k].joint;
        (0..self.variables.len()).filter(|k| is_spherical(*k) && is_first(*k)).collect()
    }
}

/// The motion of loops of many variables whose links move in a group, which no six equations bind.
fn search_group(linkage: &Linkage<Rational>, spherical_joints: &[usize]) -> Outcome {
    let is_group = |outcome: &Outcome| {
        let manifold = |c: &Configuration| matches!(c.local, Local::Manifold { .. }) && c.rank < 6;
        matches!(outcome, Outcome::Mobile(found) if found.configurations.iter().any(manifold))
    };
    Some(search(linkage, spherical_joints)).filter(is_group).unwrap_or(Outcome::Nothing)
}

/// Closes a loop in floating point and holds joints until six unknowns are left.
struct Assembler<'a> {
    subject: &'a Subject<'a>,
    floating: Linkage<f64>,
    unit: f64,
    /// The ends of the starts that were tried, with the residuals of the equations there.
    ends: Vec<(DVector<f64>, f64)>,
}

impl<'a> Assembler<'a> {
    fn of(subject: &'a Subject<'a>) -> Self {
        let (floating, unit) = (floating(&subject.linkage), subject.linkage.unit().to_f64());
        Self { subject, floating, unit, ends: Vec::new() }
    }

    fn curve(&self) -> Curve<'_> {
        Curve { linkage: &self.floating, unit: self.unit }
    }

    /// The smallest residual met.
    fn nearest(&self) -> f64 {
        self.ends.iter().map(|(_, residual)| *residual).fold(f64::INFINITY, f64::min)
    }

    /// Returns the end of Newton's method from one start, as half angles and half distances over the unit, and the residual of
    /// the equations.
    fn approached(&self, start: u32) -> (DVector<f64>, f64) {
        // Digits of a fixed generator: the same every time.
        let mut state = u64::from(start).wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x2545_F491_4F6C_DD1D);
        let mut draw = || {
            for shift in [13, 7, 17] {
                state ^= if shift == 7 { state >> shift } else { state << shift };
            }
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let variables = &self.floating.variables;
        let mut at = DVector::from_fn(variables.len(), |_, _| PI * draw());
        let curve = self.curve();
        let mut best = (at.clone(), f64::INFINITY);
        for _ in 0..STEPS {
            let (matrix, right) = curve.equations(&at);
            let residual = right.amax();
            if !residual.is_finite() || !matrix.iter().all(|x| x.is_finite()) {
                break;
            }
            if residual < best.1 {
                best = (at.clone(), residual);
            }
            if residual < CLOSED / 100.0 {
                break;
            }
            let svd = finite(matrix).svd(true, true);
            let least = 1e-10 * svd.singular_values.amax();
            let Ok(step) = svd.solve(&right, least) else { break };
            let length = step.norm();
            at -= step * (STEP / length.max(STEP));
        }
        best
    }

    /// Certified configurations with some joints held at simple values, from the first start that leads to one.
    fn assembled(&mut self) -> Option<Search> {
        (0..STARTS).find_map(|start| {
            let (at, residual) = self.approached(start);
            let held = (residual < CLOSED).then(|| self.to_hold(&at)).flatten();
            let found = held.and_then(|held| self.proved(&at, &held));
            self.ends.push((at, residual));
            found
        })
    }

    /// Values at which some joints are held, and the number of configurations there, one of which is certified and complex.
    fn complex(&self) -> Option<(Held, usize)> {
        self.ends.iter().take(COMPLEX).find_map(|(at, _)| {
            let (held, _, assembly) = self.with_held(at, &self.to_hold(at)?)?;
            assembly.modes.iter().any(|mode| mode.certificate.is_some()).then(|| (held, assembly.total()))
        })
    }

    /// The joint variables without which six remain whose screws are independent.
    fn to_hold(&self, at: &DVector<f64>) -> Option<Vec<usize>> {
        let (matrix, _) = self.curve().equations(at);
        let n = self.floating.variables.len();
        let mut columns: Vec<DVector<f64>> = (0..n).map(|k| DVector::from_fn(6, |i, _| matrix[(i, k)])).collect();
        let largest = columns.iter().map(DVector::norm).fold(0.0, f64::max);
        let spherical_joints = self.subject.spherical_joints();
        let weight = |k: usize| {
            if spherical_joints.iter().any(|spherical| (*spherical..spherical + 3).contains(&k)) {
                SPHERICAL
            } else {
                1.0
            }
        };
        let mut kept: Vec<usize> = Vec::new();
        for _ in 0..6 {
            let size = |k: &usize| columns[*k].norm() * weight(*k);
            let best = (0..n).filter(|k| !kept.contains(k)).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            let length = columns[best].norm();
            if !(length > INDEPENDENT * largest) {
                return None;
            }
            let unit = &columns[best] / length;
            for column in &mut columns {
                let along = unit.dot(column);
                *column -= &unit * along;
            }
            kept.push(best);
        }
        Some((0..n).filter(|k| !kept.contains(k)).collect())
    }

    /// The values at which these joints are held near where they stand, the loop that is left, and all its configurations.
    fn with_held(&self, at: &DVector<f64>, held: &[usize]) -> Option<(Held, ClosedLoop<f64>, Assembly)> {
        let linkage = &self.subject.linkage;
        let tangent = |k: usize| {
            let half = match linkage.variables[k] {
                Variable::Rotation => at[k].tan(),
                Variable::Translation => at[k] * self.unit,
            };
            let value = half / linkage.axes[k].length(53).to_f64();
            if value == 0.0 { Rational::new() } else { Number::near(&Float::with_val(53, value), DIGITS) }
        };
        let pairs: Vec<(usize, JointValue<Rational>)> =
            held.iter().map(|k| (*k, [Rational::from(1), tangent(*k)])).collect();
        let value = |(k, [_, tangent]): &(usize, JointValue<Rational>)| {
            let t = linkage.axes[*k].length(BITS) * tangent;
            (*k, 2.0 * if linkage.variables[*k] == Variable::Rotation { t.atan().to_f64() } else { t.to_f64() })
        };
        let closed = closed_loop(&linkage.locked(&pairs))?;
        let [first, second, third, fourth, fifth, last] = closed.constants.clone();
        let open = OpenLoop {
            variables: closed.variables,
            constants: [first, second, third, fourth, fifth],
            before_gap: last.clone(),
            after_gap: Motion::identity(),
        };
        let is_free = |spherical: &usize| !held.iter().any(|k| (*spherical..spherical + 3).contains(k));
        let spherical = self.subject.spherical_joints().into_iter().find(is_free);
        let spherical = spherical.map(|spherical| spherical - held.iter().filter(|k| **k < spherical).count());
        let solver = spherical
            .map_or_else(|| Solver::prepare(&open), |spherical| Solver::with_spherical_joint(&open, spherical));
        let mut assembly = Assembly::default();
        if !solver.is_out_of_reach() {
            let gap = solver.exact_gap(&last);
            solver.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut Workspace::default(), &mut assembly);
        }
        Some((pairs.iter().map(value).collect(), closed, assembly))
    }

    /// All configurations with these joints held near where they stand, if some real one is certified.
    fn proved(&self, at: &DVector<f64>, held: &[usize]) -> Option<Search> {
        let (values, closed, assembly) = self.with_held(at, held)?;
        let certified = assembly.modes.iter().filter(|mode| mode.real && mode.certificate.is_some());
        let mut found: Vec<[Complex<f64>; 6]> = certified.map(|mode| mode.unknowns).collect();
        if found.is_empty() {
            found.extend(self.refined(at, held, &closed));
        }
        let n = self.floating.variables.len();
        let all = |unknowns: &[Complex<f64>; 6]| -> Vec<f64> {
            let mut unknowns = unknowns.iter();
            let value = |k: usize| match values.iter().find(|(at, _)| *at == k) {
                Some((_, value)) => *value,
                None => unknowns.next().map_or(0.0, |z| z.re),
            };
            (0..n).map(value).collect()
        };
        let local = Local::Manifold { dimension: n - 6 };
        let configurations: Vec<Configuration> =
            found.iter().map(|unknowns| self.subject.placed(all(unknowns), local.clone())).collect();
        let complex = assembly.total().max(configurations.len());
        (!configurations.is_empty()).then_some(Search { held: values, configurations, complex })
    }

    /// The configuration near this place, certified by itself.
    fn refined(&self, at: &DVector<f64>, held: &[usize], closed: &ClosedLoop<f64>) -> Option<[Complex<f64>; 6]> {
        let kept = (0..at.len()).filter(|k| !held.contains(k));
        let scale = |k: usize| if self.floating.variables[k] == Variable::Rotation { 2.0 } else { 2.0 * self.unit };
        let start: Vec<f64> = kept.map(|k| at[k] * scale(k)).collect();
        let unknowns = approach(closed, &start.try_into().ok()?);
        let refined = refined_certificate(closed, &unknowns.map(Complex::from))?;
        refined.real.then_some(refined.unknowns)
    }
}

/// The loop of six joint variables in floating point, every axis along z in its frame; `None` for another number of them.
fn closed_loop(linkage: &Linkage<Rational>) -> Option<ClosedLoop<f64>> {
    let frames: Vec<Motion<f64>> = linkage.axes.iter().map(frame).collect();
    let constant = |k: usize| -> Option<Motion<f64>> {
        let link = linkage.links[k].to_motion()?.map(|x| Some(nearest_f64(x)))?;
        Some(frames[k].inverse().then_after(&link).then_after(&frames[(k + 1) % frames.len()]))
    };
    let constants: Vec<Motion<f64>> = (0..linkage.links.len()).map(constant).collect::<Option<_>>()?;
    Some(ClosedLoop { variables: linkage.variables.clone().try_into().ok()?, constants: constants.try_into().ok()? })
}

/// A frame with its z axis along an axis.
fn frame(axis: &Axis<Rational>) -> Motion<f64> {
    let Axis::Along(e) = axis else { return Motion::identity() };
    let length = axis.length(BITS);
    let [x, y, z]: Vector<f64> = e.each_ref().map(|c| (Float::with_val(BITS, c) / &length).to_f64());
    if z < 0.0 {
        // By way of the half turn about x, which keeps clear of the opposite direction.
        let half_turn = Motion::rotation_x(-1.0, 0.0);
        return half_turn.then_after(&shortest([x, -y, -z]));
    }
    shortest([x, y, z])
}

/// The shortest rotation of the z axis into a unit vector above the plane of x and y.
fn shortest([x, y, z]: Vector<f64>) -> Motion<f64> {
    let w = 1.0 + z;
    let rotation = [[1.0 - x * x / w, -x * y / w, x], [-x * y / w, 1.0 - y * y / w, y], [-x, -y, z]];
    Motion { rotation, ..Motion::identity() }
}
