//! The canonical form of every single loop: six unknown rotations or translations and six constant motions.
//!
//! `V1(x1) G1 V2(x2) G2 ... V6(x6) G6 = I` with each `V` a rotation about or a translation along its own z axis. An arm at a pose
//! and a loop with one joint given, with joints of type R, P, C and S, are all reduced to it, so that one code path serves all.
//! \[LeeLiang1988\]

use super::axis_frame::axis_frame;
use super::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use super::freedom::Freedom;
use super::idle::Idle;
pub use super::joint::Variable;
use super::motion::{Motion, unit_near};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number};
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::error::Error;
use rug::Rational;

/// A loop of six unknowns, `prod V_j G_j = I`.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop<R> {
    /// The kind of each unknown.
    pub variables: [Variable; 6],
    /// The constant motion behind each unknown.
    pub constants: [Motion<R>; 6],
}

/// The geometry of a mechanism without pose or input: six unknowns, the five constants between them, and the two constants beside
/// the closing transformation, which a pose or input supplies.
#[derive(Clone, Debug)]
pub struct OpenLoop<R> {
    /// The kind of each unknown, in loop order: the closing transformation stands behind the last one.
    pub variables: [Variable; 6],
    /// The constants behind unknowns 1 to 5.
    pub constants: [Motion<R>; 5],
    /// The constant between the last unknown and the closing transformation.
    pub before_gap: Motion<R>,
    /// The constant between the closing transformation and the first unknown.
    pub after_gap: Motion<R>,
}

/// The order of a mechanism's variables, and the variable that a loop's input locks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The kind of each joint variable, in joint order; a C joint has its angle, then its distance.
    pub variables: Vec<Variable>,
    /// Index of the locked variable, for loops.
    pub locked: Option<usize>,
    /// Index of the first of the three variables of a spherical joint, if there is one.
    pub spherical: Option<usize>,
    /// Index of the first variable of a second spherical joint: the link between the two spins freely, an eighth variable.
    pub second_spherical: Option<usize>,
    /// The virtual joints that complete six unknowns, in the order of the joint variables behind which they stand.
    pub idle: Vec<Idle>,
}

/// A loop of two spherical joints and one unknown V, `X L Y K V H = I` with rotations X and Y: the link L between the spherical joints spins
/// freely about the line of their centres.
#[derive(Clone, Debug, PartialEq)]
pub struct SsDyad<R> {
    /// The kind of V.
    pub variable: Variable,
    /// L, the link between the spherical joints.
    pub link: Motion<R>,
    /// K, from the second spherical joint to V.
    pub before: Motion<R>,
    /// H, from V to the first spherical joint.
    pub behind: Motion<R>,
    /// Indices of the first variables of the two spherical joints, and of V, in joint order.
    pub indices: [usize; 3],
}

/// A loop of two spherical joints and one unknown before its locked variable is given.
#[derive(Clone, Debug)]
pub struct OpenSsDyad<R> {
    pub(super) variable: Variable,
    /// The link, and the constants before and behind the unknown.
    pub(super) stretches: [Stretch<R>; 3],
    pub(super) indices: [usize; 3],
}

/// A constant motion, or two with the locked variable between them.
#[derive(Clone, Debug)]
pub(super) struct Stretch<R> {
    pub(super) before: Motion<R>,
    pub(super) after: Option<Motion<R>>,
}

impl<R: Ring> Stretch<R> {
    fn empty() -> Self {
        Self { before: Motion::identity(), after: None }
    }

    fn extend(&mut self, motion: &Motion<R>) {
        let last = self.after.as_mut().unwrap_or(&mut self.before);
        *last = last.then_after(motion);
    }

    fn open(&mut self) {
        self.after = Some(Motion::identity());
    }

    fn close(&self, closing: &Motion<R>) -> Motion<R> {
        match &self.after {
            None => self.before.clone(),
            Some(after) => self.before.then_after(closing).then_after(after),
        }
    }
}

impl<R: Ring> OpenSsDyad<R> {
    /// Returns the loop whose locked variable has this motion.
    #[must_use]
    pub fn close(&self, closing: &Motion<R>) -> SsDyad<R> {
        let [link, before, behind] = self.stretches.each_ref().map(|stretch| stretch.close(closing));
        SsDyad { variable: self.variable, link, before, behind, indices: self.indices }
    }
}

/// A constant of a DH joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// Link length a.
    Length,
    /// Link twist alpha.
    Twist,
    /// d, the offset along the axis.
    Offset,
    /// theta, the constant angle about the axis.
    Angle,
}

/// The values of the constants of DH joints, counted from 0, in a ring.
pub trait Parameters<R: Ring> {
    /// Cosine and sine of an angle; `None` for an unlucky prime.
    fn angle(&self, joint: usize, parameter: Parameter, value: &Angle) -> Option<(R, R)>;
    /// A length; `None` for an unlucky prime.
    fn length(&self, joint: usize, parameter: Parameter, value: &Number) -> Option<R>;
    /// The frame of a joint given by its axis; `None` for an unlucky prime.
    fn frame(&self, joint: &ScrewJoint) -> Option<Motion<R>> {
        axis_frame(joint)
    }
    /// A constant motion; `None` for an unlucky prime.
    fn placement(&self, placement: &Placement) -> Option<Motion<R>> {
        placement.image()
    }
}

/// The constants are the numbers of the file.
#[derive(Clone, Copy, Debug)]
pub struct Numbers;

impl<R: Ring> Parameters<R> for Numbers {
    fn angle(&self, _joint: usize, _parameter: Parameter, value: &Angle) -> Option<(R, R)> {
        R::cos_sin(value)
    }
    fn length(&self, _joint: usize, _parameter: Parameter, value: &Number) -> Option<R> {
        R::from_number(value)
    }
}

/// One motion of a chain on the way from base to tool.
enum Step<R> {
    Constant(Motion<R>),
    Unknown(Variable),
}

impl<R: Ring> ClosedLoop<R> {
    /// Returns the loop with all lengths times a factor.
    #[must_use]
    pub fn in_unit(&self, factor: &R) -> Self {
        let scaled = |motion: &Motion<R>| Motion {
            translation: motion.translation.each_ref().map(|x| x.mul(factor)),
            ..motion.clone()
        };
        Self { variables: self.variables, constants: self.constants.each_ref().map(scaled) }
    }
}

impl OpenLoop<f64> {
    /// Returns the loop with all lengths over a unit.
    #[must_use]
    pub fn over(&self, unit: f64) -> Self {
        Self {
            variables: self.variables,
            constants: self.constants.each_ref().map(|motion| motion.over(unit)),
            before_gap: self.before_gap.over(unit),
            after_gap: self.after_gap.over(unit),
        }
    }
}

impl<R: Ring> OpenLoop<R> {
    /// Returns the loop with this closing transformation: `V6 G6` with `G6 = before_gap * closing * after_gap`.
    #[must_use]
    pub fn close(&self, closing: &Motion<R>) -> ClosedLoop<R> {
        let last = self.before_gap.then_after(closing).then_after(&self.after_gap);
        let constants = std::array::from_fn(|j| if j < 5 { self.constants[j].clone() } else { last.clone() });
        ClosedLoop { variables: self.variables, constants }
    }
}

impl Layout {
    /// The variables of a chain in joint order.
    ///
    /// # Errors
    /// For H joints, and for a third S joint: a message that names the joint.
    pub fn of(chain: &Chain, locked: Option<usize>) -> Result<Self, Error> {
        let (mut variables, mut spherical, mut second_spherical) = (Vec::new(), None, None);
        for (joint, kind) in (1..).zip(chain.joint_kinds()) {
            if kind.row().has_pitch {
                return Err(Error::UnsupportedMobility(format!(
                    "joint {joint}: {kind:?} joints are read but not solved yet ({}); solved are {}",
                    Freedom::of(chain),
                    JointKind::letters(|kind| !kind.row().has_pitch, "and")
                )));
            }
            if kind == JointKind::Spherical {
                let free = [&mut spherical, &mut second_spherical].into_iter().find(|place| place.is_none());
                *free.ok_or_else(|| {
                    Error::UnsupportedMobility(format!(
                        "joint {joint}: a third S joint ({}); solved are loops with one, or with two and one more unknown",
                        Freedom::of(chain)
                    ))
                })? = Some(variables.len());
            }
            variables.extend(kind.variables());
        }
        Ok(Self { variables, locked, spherical, second_spherical, idle: Vec::new() })
    }

    /// Returns the number of unknowns missing from six; 0 where there are six or more.
    #[must_use]
    pub fn missing(&self) -> usize {
        6_usize.saturating_sub(self.variables.len() - usize::from(self.locked.is_some()))
    }

    /// Returns the layout completed to six unknowns by virtual joints, of which the first `rotations` are rotations.
    #[must_use]
    pub fn with_idle(&self, rotations: usize, choice: u32) -> Self {
        let total = self.variables.len();
        // Far from the input, translations all in one place, where their directions cannot become dependent.
        let first = self.locked.map_or(0, |locked| (locked + total / 2) % total);
        let kind = |k| if k < rotations { Variable::Rotation } else { Variable::Translation };
        let missing = u32::try_from(self.missing()).unwrap_or(0);
        let mut idle: Vec<Idle> = (0..missing)
            .zip(0..)
            .map(|(number, k)| Idle {
                behind: self.outside_spherical((first + k.min(rotations)) % total),
                variable: kind(k),
                choice: choice * missing + number,
            })
            .collect();
        sort::by_key(&mut idle, |idle| idle.behind);
        Self { idle, ..self.clone() }
    }

    /// Returns the last variable of the spherical joint for a place inside it, so that a spherical joint stays one joint.
    fn outside_spherical(&self, at: usize) -> usize {
        self.spherical
            .filter(|spherical| (*spherical..spherical + 2).contains(&at))
            .map_or(at, |spherical| spherical + 2)
    }

    /// Returns the kind and the joint variable of each of the six unknowns, in loop order; `None` for virtual joints.
    fn order(&self) -> [(Variable, Option<usize>); 6] {
        if self.idle.is_empty() {
            // Every answer asks this of most arms and loops: no list is made.
            let start = self.locked.map_or(0, |locked| locked + 1);
            return std::array::from_fn(|k| (start + k) % self.variables.len())
                .map(|at| (self.variables[at], Some(at)));
        }
        let behind = |k: usize| self.idle.iter().filter(move |idle| idle.behind == k).map(|idle| (idle.variable, None));
        let joint = |k: usize| std::iter::once((self.variables[k], Some(k)));
        let order: Vec<_> = (0..self.variables.len()).flat_map(|k| joint(k).chain(behind(k))).collect();
        // The loop begins behind the locked variable and runs round to the one before it.
        let start = order.iter().position(|(_, k)| k.is_some() && *k == self.locked).map_or(0, |at| at + 1);
        std::array::from_fn(|k| order[(start + k) % order.len()])
    }

    /// Returns the joint variable of each of the six unknowns, in loop order; `None` for virtual joints.
    #[must_use]
    pub fn joint_variables(&self) -> [Option<usize>; 6] {
        self.order().map(|(_, joint)| joint)
    }

    /// Returns the kind of each of the six unknowns, in loop order.
    #[must_use]
    pub fn loop_kinds(&self) -> [Variable; 6] {
        self.order().map(|(kind, _)| kind)
    }

    /// Returns the index of the unknown that is the first of the three rotations of a spherical joint, if there is one.
    #[must_use]
    pub fn spherical_unknown(&self) -> Option<usize> {
        let total = self.variables.len();
        self.spherical.map(|spherical| self.locked.map_or(spherical, |locked| (spherical + total - locked - 1) % total))
    }

    /// Index of the variable that locking `joint` (from 1) by an angle or a distance locks.
    #[must_use]
    pub fn variable_of(chain: &Chain, joint: usize, wanted: Variable) -> Option<usize> {
        chain.variables().iter().position(|own| own.joint == joint && own.variable == wanted)
    }

    /// The joint variables in joint order from the six unknowns in loop order and the locked value.
    #[must_use]
    pub fn assemble<T: Copy>(&self, unknowns: &[T; 6], locked_value: T) -> Vec<T> {
        let mut q = vec![locked_value; self.variables.len()];
        for (value, index) in unknowns.iter().zip(self.joint_variables()) {
            if let Some(index) = index {
                q[index] = *value;
            }
        }
        q
    }

    /// The inverse of `assemble`: the six unknowns in loop order. Accepts the joint variables with or without the
    /// locked one; `None` for any other length.
    #[must_use]
    pub fn unknowns(&self, q: &[f64]) -> Option<[f64; 6]> {
        let total = self.variables.len();
        let without = match self.locked {
            Some(locked) if q.len() + 1 == total => Some(locked),
            _ if q.len() == total => None,
            _ => return None,
        };
        let value = |index: usize| q[if without.is_some_and(|locked| index > locked) { index - 1 } else { index }];
        Some(self.joint_variables().map(|index| index.map_or(0.0, value)))
    }
}

impl Chain {
    /// Returns the open loop of this chain: the closing transformation of an arm is the inverse of the pose, that of a loop the
    /// locked variable.
    ///
    /// # Errors
    /// For joints that cannot be solved, and where the unknowns are not six.
    ///
    /// # Panics
    /// When a constant of the chain has no image in the ring (a prime that divides a denominator): callers that work
    /// modulo a prime use [`Chain::try_open_loop`].
    pub fn open_loop<R: Ring>(&self, layout: &Layout) -> Result<OpenLoop<R>, Error> {
        self.try_open_loop(layout)?
            .ok_or_else(|| Error::Unsupported("the geometry has no image in this ring (unlucky prime)".into()))
    }

    /// As [`Chain::open_loop`], with `None` for an unlucky prime.
    ///
    /// # Errors
    /// As [`Chain::open_loop`].
    ///
    /// Constants in floating-point numbers are enclosed first and rounded once; `None` also where they are not known to that many
    /// digits.
    pub fn try_open_loop<R: Ring>(&self, layout: &Layout) -> Result<Option<OpenLoop<R>>, Error> {
        match R::DIGITS {
            None => self.open_loop_over(layout, &Numbers),
            Some(digits) => {
                let enclosed: Option<OpenLoop<Enclosure>> = self.open_loop_over(layout, &Numbers)?;
                Ok(enclosed.and_then(|open| open.rounded(digits)))
            }
        }
    }

    /// As [`Chain::try_open_loop`], with these constants of the joints.
    ///
    /// # Errors
    /// As [`Chain::open_loop`].
    pub fn open_loop_over<R: Ring>(
        &self,
        layout: &Layout,
        parameters: &impl Parameters<R>,
    ) -> Result<Option<OpenLoop<R>>, Error> {
        // `constants[k]` stands before unknown k.
        let Some((mut unknowns, mut constants)) = self.separated(parameters) else { return Ok(None) };
        if self.fill_up(layout, &mut unknowns, &mut constants).is_none() {
            return Ok(None);
        }
        // Virtual joints before the locked one move it.
        let before = |locked: usize| layout.idle.iter().filter(|idle| idle.behind < locked).count();
        let locked = layout.locked.map(|locked| locked + before(locked));
        let total = unknowns.len();
        let expected = if locked.is_some() { 7 } else { 6 };
        if total != expected {
            return Err(Error::UnsupportedMobility(format!(
                "{total} joint variables, {expected} expected: {}; overconstrained loops are solved and swept, and their \
                 mobility is decided, but there is no single closure polynomial",
                Freedom::of(self)
            )));
        }
        // The closing transformation of an arm stands behind its last constant, that of a loop at its locked variable.
        let open = match locked {
            None => OpenLoop {
                variables: std::array::from_fn(|k| unknowns[k]),
                constants: std::array::from_fn(|k| constants[k + 1].clone()),
                before_gap: constants[6].clone(),
                after_gap: constants[0].clone(),
            },
            Some(locked) => {
                let ends = constants[7].then_after(&constants[0]);
                // The constant before unknown k, cyclically.
                let before = |k: usize| if k.is_multiple_of(7) { ends.clone() } else { constants[k % 7].clone() };
                OpenLoop {
                    variables: std::array::from_fn(|k| unknowns[(locked + 1 + k) % 7]),
                    constants: std::array::from_fn(|k| before(locked + 2 + k)),
                    before_gap: before(locked),
                    after_gap: before(locked + 1),
                }
            }
        };
        Ok(Some(open))
    }

    /// Returns the kind of each joint variable, in joint order, and the constant motions between them: motion k stands before
    /// variable k, and the last one behind them all. `None` for an unlucky prime.
    #[must_use]
    pub fn unknowns_and_constants<R: Ring>(&self) -> Option<(Vec<Variable>, Vec<Motion<R>>)> {
        self.separated(&Numbers)
    }

    /// As [`Chain::unknowns_and_constants`], with these constants of the joints.
    #[must_use]
    pub fn unknowns_and_constants_over<R: Ring>(
        &self,
        parameters: &impl Parameters<R>,
    ) -> Option<(Vec<Variable>, Vec<Motion<R>>)> {
        self.separated(parameters)
    }

    fn separated<R: Ring>(&self, parameters: &impl Parameters<R>) -> Option<(Vec<Variable>, Vec<Motion<R>>)> {
        let mut unknowns = Vec::new();
        let mut constants = vec![Motion::identity()];
        for step in self.steps(parameters)? {
            match step {
                Step::Constant(motion) => {
                    let last = constants.len() - 1;
                    constants[last] = constants[last].then_after(&motion);
                }
                Step::Unknown(variable) => {
                    unknowns.push(variable);
                    constants.push(Motion::identity());
                }
            }
        }
        Some((unknowns, constants))
    }

    /// Puts the virtual joints of a layout among the unknowns of a chain; `None` for an unlucky prime.
    fn fill_up<R: Ring>(
        &self,
        layout: &Layout,
        unknowns: &mut Vec<Variable>,
        constants: &mut Vec<Motion<R>>,
    ) -> Option<()> {
        if layout.idle.is_empty() {
            return Some(());
        }
        let unit = self.unit();
        for idle in layout.idle.iter().rev() {
            let frame = idle.frame(&unit).map(R::from_rational)?;
            let at = idle.behind + 1;
            let behind = std::mem::replace(&mut constants[at], frame.inverse());
            constants[at] = constants[at].then_after(&behind);
            constants.insert(at, frame);
            unknowns.insert(at, idle.variable);
        }
        Some(())
    }

    /// The power of two nearest to the mean length of the links, 1 without lengths.
    #[must_use]
    pub fn unit(&self) -> Rational {
        let square = |lengths: &[&Number]| lengths.iter().map(|x| x.to_f64().powi(2)).sum::<f64>();
        let squares: Vec<f64> = match &self.geometry {
            Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
                joints.iter().map(|j| square(&[&j.a, &j.d])).collect()
            }
            Geometry::Screws { joints, .. } => joints.iter().map(|j| square(&j.point.each_ref())).collect(),
        };
        let mean = (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt();
        Rational::from_f64(unit_near(mean)).unwrap_or_else(|| Rational::from(1))
    }

    /// Returns the loop of a chain with two spherical joints, whose locked variable has this motion.
    ///
    /// # Errors
    /// Unless there is exactly one more unknown; and for an unlucky prime.
    pub fn ss_dyad_loop<R: Ring>(&self, layout: &Layout, closing: &Motion<R>) -> Result<SsDyad<R>, Error> {
        Ok(self.open_ss_dyad(layout, &Numbers)?.close(closing))
    }

    /// The loop of a chain with two spherical joints before its locked variable is given, with these constants of the joints.
    ///
    /// # Errors
    /// As [`Chain::ss_dyad_loop`].
    pub fn open_ss_dyad<R: Ring>(
        &self,
        layout: &Layout,
        parameters: &impl Parameters<R>,
    ) -> Result<OpenSsDyad<R>, Error> {
        let unlucky = || Error::Unsupported("the geometry has no image in this ring (unlucky prime)".into());
        let steps = self.steps(parameters).ok_or_else(unlucky)?;
        let spherical_joints = [layout.spherical, layout.second_spherical];
        // Index of the first variable and the constant behind each spherical joint and unknown; the constant before the first of
        // them comes last.
        let mut items: Vec<(usize, Stretch<R>)> = Vec::new();
        let mut start = Stretch::empty();
        let mut index = 0;
        for step in steps {
            // Inside a spherical joint there are only its own quarter turns, which cancel but for the unknowns.
            let last = items.last_mut().map_or(&mut start, |(_, stretch)| stretch);
            match step {
                Step::Constant(motion) => last.extend(&motion),
                Step::Unknown(_) => {
                    index += 1;
                    let inside = spherical_joints
                        .into_iter()
                        .flatten()
                        .any(|spherical| index - 1 > spherical && index - 1 < spherical + 3);
                    if layout.locked == Some(index - 1) {
                        last.open();
                    } else if !inside {
                        items.push((index - 1, Stretch::empty()));
                    }
                }
            }
        }
        if let Some((_, last)) = items.last_mut() {
            last.extend(&start.before);
            if let Some(after) = start.after {
                last.after = Some(after);
            }
        }
        let is_spherical = |at: usize| spherical_joints.contains(&Some(at));
        let found = items.iter().position(|(at, _)| !is_spherical(*at)).filter(|_| items.len() == 3);
        let Some(position) = found else {
            let found = match items.len() {
                2 => {
                    "nothing is left to find but the spin of the link between the S joints, whose distance is right at some \
                      inputs or at none"
                }
                _ => "the distance of the S joints is one equation, for one unknown",
            };
            return Err(Error::UnsupportedMobility(format!(
                "{} joint variables with two S joints, {}: {found}; solved are loops with two S joints and one more joint variable \
                 that is not given, as RSSR with an input, or RSS without",
                layout.variables.len(),
                Freedom::of(self)
            )));
        };
        items.rotate_left((position + 1) % 3);
        let [(x, link), (y, before), (v, behind)]: [(usize, Stretch<R>); 3] =
            items.try_into().map_err(|_| Error::Unsupported("two spherical joints and one unknown".into()))?;
        Ok(OpenSsDyad { variable: layout.variables[v], stretches: [link, before, behind], indices: [x, y, v] })
    }

    /// Returns the unknowns of a chain read as a loop, each with the constant behind it; the constant before the first one comes
    /// last. `None` for an unlucky prime, and without unknowns.
    pub fn cycle<R: Ring>(&self, parameters: &impl Parameters<R>) -> Option<Vec<(Variable, Motion<R>)>> {
        let mut start = Motion::identity();
        let mut cycle: Vec<(Variable, Motion<R>)> = Vec::new();
        for step in self.steps(parameters)? {
            match step {
                Step::Unknown(variable) => cycle.push((variable, Motion::identity())),
                Step::Constant(motion) => {
                    let last = cycle.last_mut().map_or(&mut start, |(_, constant)| constant);
                    *last = last.then_after(&motion);
                }
            }
        }
        let (_, last) = cycle.last_mut()?;
        *last = last.then_after(&start);
        Some(cycle)
    }

    /// Everything from base to tool in order; `None` for an unlucky prime.
    fn steps<R: Ring>(&self, parameters: &impl Parameters<R>) -> Option<Vec<Step<R>>> {
        let mut steps = vec![Step::Constant(parameters.placement(&self.base)?)];
        match &self.geometry {
            Geometry::Dh(joints) => {
                for (at, joint) in joints.iter().enumerate() {
                    joint_steps(at, joint, parameters, &mut steps)?;
                    steps.push(Step::Constant(link(at, joint, parameters)?));
                }
            }
            Geometry::ModifiedDh(joints) => {
                for (at, joint) in joints.iter().enumerate() {
                    steps.push(Step::Constant(link(at, joint, parameters)?));
                    joint_steps(at, joint, parameters, &mut steps)?;
                }
            }
            Geometry::Screws { joints, home } => {
                for joint in joints {
                    let frame = parameters.frame(joint)?;
                    let back = frame.inverse();
                    steps.push(Step::Constant(frame));
                    screw_steps(joint.kind, &mut steps);
                    steps.push(Step::Constant(back));
                }
                steps.push(Step::Constant(parameters.placement(home)?));
            }
        }
        steps.push(Step::Constant(parameters.placement(&self.tool)?));
        Some(steps)
    }

    /// Pose of the tool at these joint values, given as one motion per joint variable in joint order.
    /// `None` for an unlucky prime, or when there are fewer motions than variables.
    #[must_use]
    pub fn forward<R: Ring>(&self, joint_motions: &[Motion<R>]) -> Option<Motion<R>> {
        self.forward_over(&Numbers, joint_motions)
    }

    /// As [`Chain::forward`], with these constants of the joints.
    #[must_use]
    pub fn forward_over<R: Ring>(
        &self,
        parameters: &impl Parameters<R>,
        joint_motions: &[Motion<R>],
    ) -> Option<Motion<R>> {
        let mut motions = joint_motions.iter();
        let mut pose = Motion::identity();
        for step in self.steps(parameters)? {
            match step {
                Step::Constant(motion) => pose = pose.then_after(&motion),
                Step::Unknown(_) => pose = pose.then_after(motions.next()?),
            }
        }
        Some(pose)
    }
}

/// The unknowns of one joint and its own constants (offsets).
fn joint_steps<R: Ring>(
    at: usize,
    joint: &Joint,
    parameters: &impl Parameters<R>,
    steps: &mut Vec<Step<R>>,
) -> Option<()> {
    screw_steps(joint.kind, steps);
    let (cos, sin) = parameters.angle(at, Parameter::Angle, &joint.theta0)?;
    let mut offset = Motion::rotation_z(cos, sin);
    offset.translation[2] = parameters.length(at, Parameter::Offset, &joint.d)?;
    steps.push(Step::Constant(offset));
    Some(())
}

/// The link of a DH joint.
fn link<R: Ring>(at: usize, joint: &Joint, parameters: &impl Parameters<R>) -> Option<Motion<R>> {
    let length = parameters.length(at, Parameter::Length, &joint.a)?;
    Some(Motion::link(length, parameters.angle(at, Parameter::Twist, &joint.alpha)?))
}

/// The unknowns of a joint.
fn screw_steps<R: Ring>(kind: JointKind, steps: &mut Vec<Step<R>>) {
    for (variable, axis) in kind.variables().iter().zip(kind.row().axes) {
        let carried = axis.row().1.map(|rotation| Motion {
            rotation: rotation.map(|row| row.map(R::from_integer)),
            translation: std::array::from_fn(|_| R::zero()),
        });
        let back = carried.as_ref().map(Motion::inverse);
        steps.extend(carried.map(Step::Constant));
        steps.push(Step::Unknown(*variable));
        steps.extend(back.map(Step::Constant));
    }
}

/// The motion of one joint variable: `Rz(angle)` or `Tz(distance)`.
#[must_use]
pub fn angle_motion<R: Ring>(angle: &Angle) -> Option<Motion<R>> {
    let (cos, sin) = R::cos_sin(angle)?;
    Some(Motion::rotation_z(cos, sin))
}

/// `Tz(distance)` over any ring.
#[must_use]
pub fn distance_motion<R: Ring>(distance: &Number) -> Option<Motion<R>> {
    Some(Motion::translation_z(R::from_number(distance)?))
}
