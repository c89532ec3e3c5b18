//! The closure equations of an arm or a loop, derived from its data.
//!
//! `V_1(x_1) L_1 ... V_6(x_6) L_6 = 1`, rotations about and translations along z. The six equations state that the rotation
//! of the product is symmetric and its translation 0.

use super::enclosing::Enclosing;
use super::fault::{Fault, refused, unreadable};
use super::isolation::{Closure, Point};
use super::mode::Ball;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, HalfTangent};
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::catalogue::entry::{Case, InputValue};
use crate::kinematics::chain::{Chain, JointKind};
use crate::kinematics::closed_loop::{OpenLoop, angle_motion, distance_motion};
use crate::kinematics::joint::{JointVariable, Variable};
use crate::kinematics::motion::{Motion, dot};
use rug::{Float, Rational, float::Constant};

/// A closed loop of six unknowns. A loop of fewer is one with rotations added behind its last link, which stand at 0 where it closes.
pub struct ChainClosure {
    /// The kind of each unknown.
    pub(super) variables: [Variable; 6],
    /// The constant motion behind each unknown.
    pub(super) links: [Motion<Enclosure>; 6],
    /// The same motions as rationals, if all numbers are rational.
    pub(super) exact: Option<[Motion<Rational>; 6]>,
    /// Number of the unknowns that are not added.
    pub(super) own: usize,
    /// The motions behind the unknowns without those that are added, if all numbers are rational.
    pub(super) own_links: Option<Vec<Motion<Rational>>>,
    /// Index of the given joint variable, if there is one.
    pub(super) given: Option<usize>,
    /// Index of the first of the three angles of every spherical joint.
    pub(super) spherical: Vec<usize>,
}

/// A loop of any number of unknowns.
pub(super) struct Around<R> {
    variables: Vec<Variable>,
    /// The constant motion behind each unknown.
    pub links: Vec<Motion<R>>,
    /// The part of the last link that stands in front of the first unknown.
    before: Motion<R>,
    given: Option<usize>,
}

impl<R: Ring> Around<R> {
    /// Reads the loop of a case over a ring, of none without an input.
    pub fn of(chain: &Chain, case: Option<&Case>) -> Result<Self, Fault> {
        let own = || Fault::Unreadable("found numbers that are not known well enough".to_owned());
        let (mut variables, mut motions) = chain.unknowns_and_constants::<R>().ok_or_else(own)?;
        let named = JointVariable::of(&chain.joint_kinds());
        if variables.len() != named.len() || named.iter().any(|v| v.kind.row().has_pitch) {
            return refused("closure: a helical joint has no certificate");
        }
        if let (Some(pose), Some(last)) = (case.and_then(|case| case.pose.as_ref()), motions.last_mut()) {
            *last = last.then_after(&pose.inverse_image::<R>().ok_or_else(own)?);
        }
        let input = case.map(|case| case.input.as_slice()).unwrap_or_default();
        if input.len() > 1 {
            return refused("closure: several inputs");
        }
        let mut given = None;
        if let Some(input) = input.first() {
            let is_given =
                |v: &JointVariable| v.joint == input.joint && v.variable == input.value.variable() && v.turn == 0;
            let Some(at) = named.iter().position(is_given) else {
                return unreadable(format!("joint {} has no such variable", input.joint));
            };
            let held = match &input.value {
                InputValue::Angle(angle) => angle_motion::<R>(angle),
                InputValue::Distance(distance) => distance_motion(distance),
            };
            given = Some(at);
            variables.remove(at);
            let behind = motions.remove(at + 1);
            motions[at] = motions[at].then_after(&held.ok_or_else(own)?).then_after(&behind);
        }
        let before = motions.remove(0);
        let Some(last) = motions.last_mut() else { return unreadable("found no joint that moves") };
        *last = last.then_after(&before);
        Ok(Self { variables, links: motions, before, given })
    }

    /// Adds rotations about axes that nothing distinguishes, which are given in the frame of the ground.
    fn lengthened(mut self) -> Result<([Variable; 6], [Motion<R>; 6]), Fault> {
        let count = self.links.len();
        let about = |p: u32, q: u32| {
            let (cos, sin) = exact_cos_sin(&Angle::from_half_tangent(HalfTangent::Finite(Rational::from((p, q)))));
            Some((R::from_rational(&cos)?, R::from_rational(&sin)?))
        };
        let frame = |k: u32| {
            let (cos, sin) = about(2 + k, 7)?;
            let mut frame = Motion::rotation_x(cos, sin);
            let place = [Rational::from((k + 1, 3)), Rational::from((1, k + 2)), Rational::new()];
            let [x, y, z] = place.each_ref().map(R::from_rational);
            frame.translation = [x?, y?, z?];
            let (cos, sin) = about(3, 5 + 2 * k)?;
            let mut about_y = Motion::identity();
            about_y.rotation[0] = [cos.clone(), R::zero(), sin.clone()];
            about_y.rotation[2] = [sin.neg(), R::zero(), cos];
            Some(self.before.inverse().then_after(&frame).then_after(&about_y))
        };
        for k in 0..u32::try_from(6_usize.saturating_sub(count)).unwrap_or(0) {
            let (Some(frame), Some(last)) = (frame(k), self.links.last_mut()) else { continue };
            *last = last.then_after(&frame);
            self.links.push(frame.inverse());
            self.variables.push(Variable::Rotation);
        }
        match (<[_; 6]>::try_from(self.variables), <[_; 6]>::try_from(self.links)) {
            (Ok(variables), Ok(links)) => Ok((variables, links)),
            _ => refused(format!("closure: {count} unknowns, where loops of at most six are covered")),
        }
    }
}

impl ChainClosure {
    /// Returns the loop of a case, or that without an input; `is_exact` means that all its numbers are rational.
    pub(super) fn of(chain: &Chain, case: Option<&Case>, is_exact: bool) -> Result<Self, Fault> {
        let around = Around::<Enclosure>::of(chain, case)?;
        let (own, given) = (around.links.len(), around.given);
        let (variables, links) = around.lengthened()?;
        let named = JointVariable::of(&chain.joint_kinds());
        let unknown = named.iter().enumerate().filter(|(at, _)| Some(*at) != given);
        let is_first = |(_, v): &(usize, &JointVariable)| v.kind == JointKind::Spherical && v.turn == 1;
        let spherical = unknown.enumerate().filter(|(_, v)| is_first(v)).map(|(k, _)| k).collect();
        let exact = is_exact.then(|| Around::<Rational>::of(chain, case)).transpose()?;
        let own_links = exact.as_ref().map(|around| around.links.clone());
        let exact = exact.map(|around| Ok(around.lengthened()?.1)).transpose()?;
        Ok(Self { variables, links, exact, own, own_links, given, spherical })
    }

    /// Returns the loop with one of its own unknowns held at a rational motion; `None` if its numbers are not rational, or it has a
    /// spherical joint.
    pub(super) fn holding(&self, unknown: usize, held: &Motion<Rational>) -> Option<Self> {
        let mut own_links = self.own_links.clone().filter(|_| self.spherical.is_empty())?;
        let mut variables = self.variables[..self.own].to_vec();
        variables.remove(unknown);
        let behind = own_links.remove(unknown);
        // The motion in front of the first unknown is the last one of the loop.
        let last = own_links.len().checked_sub(1)?;
        let before = unknown.checked_sub(1).unwrap_or(last);
        own_links[before] = own_links[before].then_after(held).then_after(&behind);
        let around = Around { variables, links: own_links.clone(), before: Motion::identity(), given: None };
        let (variables, exact) = around.lengthened().ok()?;
        let links: Vec<_> = exact.iter().map(|link| link.map(Enclosure::from_rational)).collect::<Option<_>>()?;
        let links = links.try_into().ok()?;
        let own = own_links.len();
        Some(Self {
            variables,
            links,
            exact: Some(exact),
            own,
            own_links: Some(own_links),
            given: None,
            spherical: Vec::new(),
        })
    }

    /// Returns the loop in f64.
    #[must_use]
    pub fn rounded(&self) -> OpenLoop<f64> {
        let near = |x: &Enclosure| Some(x.middle().to_f64());
        let links = self.links.each_ref().map(|link| link.map(near).unwrap_or_else(Motion::identity));
        let [first @ .., last] = links;
        OpenLoop { variables: self.variables, constants: first, before_gap: last, after_gap: Motion::identity() }
    }

    /// Returns the index of a joint variable among the unknowns; `None` for a given one.
    #[must_use]
    pub fn unknown(&self, variable: usize) -> Option<usize> {
        match self.given {
            Some(given) if given == variable => None,
            Some(given) if given < variable => variable.checked_sub(1),
            _ => Some(variable),
        }
    }

    pub(super) fn links<S: Enclosing>(&self) -> [Motion<S>; 6] {
        self.links.each_ref().map(|link| Motion {
            rotation: link.rotation.each_ref().map(|row| row.each_ref().map(S::of)),
            translation: link.translation.each_ref().map(S::of),
        })
    }
}

/// Returns the motions of all unknowns with the links behind them.
fn motions<S: Enclosing>(point: &Point<S>, links: &[Motion<S>; 6]) -> [Motion<S>; 6] {
    std::array::from_fn(|k| moved(&links[k], point, k))
}

/// Returns a link behind the motion of an unknown.
fn moved<S: Enclosing>(link: &Motion<S>, point: &Point<S>, k: usize) -> Motion<S> {
    let mut motion = link.clone();
    match &point.turns[k] {
        None => motion.translation[2] = motion.translation[2].add(&point.x[k]),
        Some((cos, sin)) => {
            let turn = |x: &S, y: &S| [cos.mul(x).sub(&sin.mul(y)), sin.mul(x).add(&cos.mul(y))];
            for j in 0..3 {
                [motion.rotation[0][j], motion.rotation[1][j]] = turn(&link.rotation[0][j], &link.rotation[1][j]);
            }
            [motion.translation[0], motion.translation[1]] = turn(&link.translation[0], &link.translation[1]);
        }
    }
    motion
}

/// Returns the skew part of the rotation, and the translation.
pub(super) fn six<S: Ring>(rotation: &[[S; 3]; 3], translation: &[S; 3]) -> [S; 6] {
    let [x, y, z] = translation.clone();
    let skew = |i: usize, j: usize| rotation[i][j].sub(&rotation[j][i]);
    [skew(2, 1), skew(0, 2), skew(1, 0), x, y, z]
}

impl Closure<6> for ChainClosure {
    type Constants<S: Enclosing> = [Motion<S>; 6];

    fn constants<S: Enclosing>(&self) -> [Motion<S>; 6] {
        self.links()
    }

    fn angles(&self) -> [bool; 6] {
        self.variables.map(|variable| variable == Variable::Rotation)
    }

    fn values<S: Enclosing>(&self, links: &[Motion<S>; 6], point: &Point<S>) -> [S; 6] {
        let [first, rest @ ..] = motions(point, links);
        let product = rest.iter().fold(first, |product, motion| product.then_after(motion));
        six(&product.rotation, &product.translation)
    }

    /// Tests the trace of the product as well: a symmetric rotation is the identity, of trace 3, or a half-turn, of trace -1.
    fn slope<S: Enclosing>(&self, links: &[Motion<S>; 6], point: &Point<S>) -> ([[S; 6]; 6], bool) {
        let motions = motions(point, links);
        let mut behind = vec![Motion::identity()];
        for motion in motions[1..].iter().rev() {
            let next = motion.then_after(&behind[behind.len() - 1]);
            behind.push(next);
        }
        let mut before = Motion::<S>::identity();
        let columns: [[S; 6]; 6] = std::array::from_fn(|k| {
            let column = match &point.turns[k] {
                None => {
                    let along = std::array::from_fn(|i| before.rotation[i][2].clone());
                    six(&std::array::from_fn(|_| std::array::from_fn(|_| S::zero())), &along)
                }
                Some((cos, sin)) => {
                    // The derivative of the rotation takes (x, y, z) to (-s x - c y, c x - s y, 0).
                    let rest = links[k].then_after(&behind[5 - k]);
                    let turn =
                        |x: &S, y: &S| [sin.mul(x).add(&cos.mul(y)).neg(), cos.mul(x).sub(&sin.mul(y)), S::zero()];
                    let column = |j: usize| turn(&rest.rotation[0][j], &rest.rotation[1][j]);
                    let columns: [[S; 3]; 3] = std::array::from_fn(column);
                    let place = turn(&rest.translation[0], &rest.translation[1]);
                    let rotation: [[S; 3]; 3] =
                        std::array::from_fn(|i| std::array::from_fn(|j| dot(&before.rotation[i], &columns[j])));
                    six(&rotation, &before.rotate(&place))
                }
            };
            before = before.then_after(&motions[k]);
            column
        });
        let trace = before.rotation[0][0].add(&before.rotation[1][1]).add(&before.rotation[2][2]);
        let is_solution = trace.add(&S::one()).at_least() > 0.0;
        (std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i].clone())), is_solution)
    }

    /// Compares angles modulo 2 pi; a spherical joint has two triples of angles for every rotation.
    fn are_apart(&self, one: &Ball, other: &Ball) -> bool {
        let mut forms = vec![[0; 6]];
        for &at in &self.spherical {
            for mut form in forms.clone() {
                (form[at], form[at + 1], form[at + 2]) = (1, 2, 1);
                forms.push(form);
            }
        }
        let radius = Rational::from(&one.radius + &other.radius);
        forms.iter().all(|form| (0..6).any(|k| self.are_far(k, form[k], one, other, &radius)))
    }
}

impl ChainClosure {
    /// Whether all added unknowns may be 0 in a ball, so that it may hold a solution of the loop itself.
    pub(super) fn may_be_own(&self, ball: &Ball) -> bool {
        let zero = Ball { centre: vec![(Rational::new(), Rational::new()); 6], ..ball.clone() };
        !(self.own..6).any(|k| self.are_far(k, 0, ball, &zero, &ball.radius))
    }
}

/// Bits in which pi is compared with rational numbers.
const PI_BITS: u32 = 512;
/// Angles that differ by more than this in f64 differ by more than any radius below [`SMALL`].
const CLEAR: f64 = 1e-4;
/// See [`CLEAR`].
const SMALL: f64 = 1e-5;
/// Maximum number of full turns by which centres may differ.
const MOST_TURNS: i32 = 3;

impl ChainClosure {
    /// Returns whether unknown k differs by more than a radius; `form` 1 adds pi to the other one, 2 changes its sign.
    fn are_far(&self, k: usize, form: u8, one: &Ball, other: &Ball, radius: &Rational) -> bool {
        let ((x, y), (u, v)) = (&one.centre[k], &other.centre[k]);
        let difference = if form == 2 {
            (Rational::from(x + u), Rational::from(y + v))
        } else {
            (Rational::from(x - u), Rational::from(y - v))
        };
        let halves = (self.variables[k] != Variable::Translation).then(|| i32::from(form == 1));
        are_far(difference, halves, radius)
    }
}

/// Returns whether a difference is larger than a radius; that of angles, which have a number of half-turns that are subtracted, modulo 2 pi.
pub(super) fn are_far((re, im): (Rational, Rational), halves: Option<i32>, radius: &Rational) -> bool {
    if im.abs() > *radius {
        return true;
    }
    let Some(halves) = halves else { return re.abs() > *radius };
    if Rational::from(re.abs_ref()) > 6 * MOST_TURNS - 4 {
        return false;
    }
    // Most angles differ by much more than a radius, and than all roundings of f64 here, which are below 1e-14.
    let (near, is_small) = (re.to_f64(), *radius < SMALL);
    let is_clear = |turn: i32| (near - std::f64::consts::PI * f64::from(2 * turn + halves)).abs() > CLEAR;
    if is_small && (-MOST_TURNS..=MOST_TURNS).all(is_clear) {
        return true;
    }
    let pi = Float::with_val(PI_BITS, Constant::Pi).to_rational().unwrap_or_default();
    // pi is off by less than 1e-150, and so are its small multiples.
    let more = radius + Rational::from_f64(1e-140).unwrap_or_default();
    (-MOST_TURNS..=MOST_TURNS).all(|turn| {
        let off = &re - Rational::from(&pi * (2 * turn + halves));
        off.abs() > more
    })
}
