//! Loops with two spherical joints, exactly: one equation of degree 2 for the distance of their centres.

use super::answer::{Answer, in_order, nearest};
use super::roots::Root;
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::assembly::ss_dyad::farthest_axis;
use crate::elimination::spherical_pair::equation;
use crate::kinematics::closed_loop::{SsDyad, Variable};
use crate::kinematics::link_form::{product, transposed};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::mechanism::FullMode;
use crate::verdict::{Code, Proof, Status, Verdict};
use num_complex::Complex;
use rug::{Float, Rational, float::Constant};

type Rotation = [[Disc; 3]; 3];

/// Bits of the arithmetic in which joint angles are found.
const BITS: u32 = 640;
/// Two axes count as one where their sine is below `2^-SAME`. Numbers of fewer than a hundred digits cannot differ by less; where
/// they do, the error of the output is at most the square root of this.
const SAME: u32 = 320;

/// A loop with two spherical joints with the data of the question.
pub(crate) struct SsDyadQuestion<'a> {
    /// The loop over the rationals.
    pub ss_dyad: &'a SsDyad<Rational>,
    /// The value of the given joint variable, in the places of all joint variables.
    pub given: Vec<Complex<f64>>,
    /// A length of the size of the links.
    pub unit: f64,
    /// Whether numbers had to be rounded.
    pub is_rounded: bool,
}

/// Discriminants of rounded data below this, relative to the squares that they are the difference of, may be 0.
const CLEAR: f64 = 1e-12;

/// The set of places that the unknown of the loop can have.
enum Places {
    /// Anywhere.
    All,
    /// At these roots, so often each: cosine and sine, or the distance and 0.
    Some(Vec<([Value; 2], usize)>),
}

/// A number of a quadratic field.
type Value = Root;

impl SsDyadQuestion<'_> {
    /// The answer.
    pub fn answer(&self) -> Answer {
        let row = equation(self.ss_dyad);
        let link = &self.ss_dyad.link.translation;
        let is_point = link.iter().all(|x| *x == 0);
        let may_touch = self.is_rounded && may_touch(self.ss_dyad.variable, &row);
        let roots = match places(self.ss_dyad.variable, &row) {
            Places::Some(_) if may_touch => vec![(touching(self.ss_dyad.variable, &row), 2)],
            Places::All => return (self.verdict(Status::SelfMotion, Code::SelfMotion, &[], MOVING), Vec::new()),
            Places::Some(roots) => roots,
        };
        if is_point && roots.iter().any(|([one, other], _)| !(one.is_real() && other.is_real())) {
            // A vector of length 0 that is not 0 itself: no rotation carries the link there.
            let mut verdict = self.verdict(Status::Unreachable, Code::NoSolution, &[], APART);
            verdict.complex_complete = false;
            return (verdict, Vec::new());
        }
        let mode = |(pair, multiplicity): &([Value; 2], usize)| self.mode(pair, *multiplicity, is_point);
        let mut modes: Vec<FullMode> = roots.iter().filter_map(mode).collect();
        sort::by(&mut modes, in_order);
        let real = roots.iter().any(|([one, other], _)| one.is_real() && other.is_real());
        let count: usize = roots.iter().map(|(_, multiplicity)| multiplicity).sum();
        let (status, code, because) = match (count, real) {
            (0, _) => (Status::Unreachable, Code::NoSolution, NONE),
            (_, false) => (Status::Unreachable, Code::ExactRootsMatched, COMPLEX),
            (_, true) if roots.len() == 1 && count == 2 => (Status::Complete, Code::ExactRootsMatched, DOUBLE),
            _ => (Status::Complete, Code::ExactRootsMatched, REAL),
        };
        let mut verdict = self.verdict(status, code, &modes, because);
        verdict.complex = count;
        verdict.real = if real { count } else { 0 };
        verdict.complex_complete = modes.len() == roots.len();
        if may_touch {
            (verdict.status, verdict.proof, verdict.code) = (Status::Incomplete, Proof::None, Code::RealOrComplex);
            verdict.complex_complete = false;
            verdict.reason = TOUCHING.to_owned();
        }
        (verdict, modes)
    }

    fn verdict(&self, status: Status, code: Code, modes: &[FullMode], because: &str) -> Verdict {
        Verdict {
            status,
            proof: Proof::Proved.of_rounded(self.is_rounded),
            code,
            complex_complete: status != Status::SelfMotion,
            complex: 0,
            real: 0,
            at_infinity: 0,
            self_motion: usize::from(status == Status::SelfMotion),
            certified: modes.iter().filter(|mode| mode.certified).count(),
            reason: because.to_owned(),
        }
    }

    /// A position as a user reads it.
    fn mode(&self, pair: &[Value; 2], multiplicity: usize, is_point: bool) -> Option<FullMode> {
        let [one, other] = [pair[0].ball(BITS)?, pair[1].ball(BITS)?];
        let real = pair.iter().all(Root::is_real);
        let value = match self.ss_dyad.variable {
            Variable::Rotation => Disc::angle(&one, &other)?,
            Variable::Translation => one.clone(),
        };
        let joints = self.spherical(&[one, other], is_point)?;
        let [first, second, unknown] = self.ss_dyad.indices;
        let (mut q, mut radius) = (self.given.clone(), 0.0_f64);
        let mut place = |index: usize, ball: &Disc, variable: Variable| {
            let (value, error) = nearest(ball, variable, real);
            q[index] = value;
            radius = radius.max(if variable == Variable::Rotation { error } else { error / self.unit.min(1.0) });
        };
        place(unknown, &value, self.ss_dyad.variable);
        for (at, angles) in [first, second].into_iter().zip(&joints) {
            angles.iter().enumerate().for_each(|(k, angle)| place(at + k, angle, Variable::Rotation));
        }
        let certified = !self.is_rounded && radius.is_finite();
        Some(FullMode {
            q,
            real,
            multiplicity,
            // The numbers are the nearest to exact ones.
            residual: f64::EPSILON,
            condition: if multiplicity == 1 { self.condition(pair) } else { f64::INFINITY },
            certified,
            radius: if certified { radius } else { f64::INFINITY },
            within_limits: None,
            near: false,
            error: None,
            platform: None,
        })
    }

    /// Returns the reciprocal of the derivative of the squared distance of the centres with respect to the unknown, over the
    /// unit.
    fn condition(&self, pair: &[Value; 2]) -> f64 {
        let [_, first, second] = equation(self.ss_dyad).map(|x| x.to_f64());
        let value = |root: &Root| root.ball(64).map_or(Complex::ZERO, |b| Complex::new(b.re.to_f64(), b.im.to_f64()));
        let [one, other] = pair.each_ref().map(value);
        let slope = match self.ss_dyad.variable {
            Variable::Rotation => (second * one - first * other).norm() / self.unit,
            Variable::Translation => (first + 2.0 * second * one).norm(),
        };
        let [p, l] = [&self.ss_dyad.behind.translation, &self.ss_dyad.link.translation];
        let length = |v: &Vector<Rational>| v.iter().map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt();
        (2.0 * (length(p) + length(l) + self.unit) / slope).max(1.0)
    }

    /// The angles of both spherical joints, the second one a universal joint.
    fn spherical(&self, [one, other]: &[Disc; 2], is_point: bool) -> Option<[[Disc; 3]; 2]> {
        let image = |motion: &Motion<Rational>| motion.map(|x| Some(Disc::of(x, BITS)));
        let motion = match self.ss_dyad.variable {
            Variable::Rotation => Motion::rotation_z(one.clone(), other.clone()),
            Variable::Translation => Motion::translation_z(one.clone()),
        };
        // X L Y K V H = 1
        let rest = image(&self.ss_dyad.before)?.then_after(&motion).then_after(&image(&self.ss_dyad.behind)?);
        let (across, link) = (rest.inverse(), image(&self.ss_dyad.link)?);
        if is_point {
            // Both centres are one: the second joint stands at 0.
            let first = product(&across.rotation, &transposed(&link.rotation));
            return Some([angles(&first)?, std::array::from_fn(|_| zero())]);
        }
        let length = dot(&link.translation, &link.translation).sqrt()?;
        let over = length.inverse()?;
        let [along, line] = [&link.translation, &across.translation].map(|v| v.each_ref().map(|x| x.mul(&over)));
        let helper = farthest_axis(&along.each_ref().map(|x| x.re.to_f64()));
        let x = unit(&cross(&helper.map(|x| Disc::point(Float::with_val(64, x), Float::new(64))), &along))?;
        let own = columns(&x, &cross(&along, &x), &along);
        let column = |k: usize| -> Vector<Disc> { std::array::from_fn(|i| across.rotation[i][k].clone()) };
        let side = cross(&line, &column(2));
        let side = if is_nothing(&dot(&side, &side)) { cross(&line, &column(0).map(|x| x.neg())) } else { side };
        let x = unit(&side)?;
        let there = columns(&x, &cross(&line, &x), &line);
        let first = product(&there, &transposed(&own));
        let second = product(&transposed(&product(&first, &link.rotation)), &across.rotation);
        Some([angles(&first)?, angles(&second)?])
    }
}

/// Why there is a self-motion.
const MOVING: &str = "solutions form a self-motion of dimension 1, beside the spin of that link: the distance of the centres of both \
     S joints is right wherever the joint between them stands, exactly";
/// Why there is no solution at all.
const NONE: &str = "no solution: the distance of the centres of both S joints is the same at all values of the joint between them, and \
     not right, exactly";
/// Why no solution is real.
const COMPLEX: &str = "2 of 2 solutions, both complex: the quadratic equation for the distance of the centres of both S joints has a \
     negative discriminant, exactly";
/// Why two centres that have to coincide do not.
const APART: &str = "no real solution: the centres of both S joints have to coincide, and do so nowhere, exactly";
/// Why there is one solution.
const DOUBLE: &str = "2 of 2 solutions, which coincide: the quadratic equation for the distance of the centres of both S joints has \
     discriminant 0, exactly";
/// Why nothing is known of rounded data.
const TOUCHING: &str = "not proved: the quadratic equation for the distance of the centres of both S joints has a discriminant that \
     rounded data may make positive, 0 or negative; the double root is shown";
/// Why there are two.
const REAL: &str =
    "all solutions: the real roots of the quadratic equation for the distance of the centres of both S joints, exactly";

fn zero() -> Disc {
    Disc::point(Float::new(BITS), Float::new(BITS))
}

/// Returns whether the square of a sine is 0 or negligible.
fn is_nothing(square: &Disc) -> bool {
    square.at_most() < Float::with_val(64, 1) >> (2 * SAME)
}

fn unit(v: &Vector<Disc>) -> Option<Vector<Disc>> {
    let over = dot(v, v).sqrt()?.inverse()?;
    Some(v.each_ref().map(|x| x.mul(&over)))
}

fn columns(x: &Vector<Disc>, y: &Vector<Disc>, z: &Vector<Disc>) -> Rotation {
    std::array::from_fn(|i| [x[i].clone(), y[i].clone(), z[i].clone()])
}

/// The angles of a rotation about z, x and z; `None` for a complex one that has none.
fn angles(r: &Rotation) -> Option<[Disc; 3]> {
    let square = r[0][2].mul(&r[0][2]).add(&r[1][2].mul(&r[1][2]));
    if is_nothing(&square) {
        let slack = Float::with_val(64, 1) >> (SAME - 8);
        let second =
            if r[2][2].re > 0 { zero() } else { Disc::point(Float::with_val(BITS, Constant::Pi), Float::new(BITS)) };
        let first = Disc::angle(&r[0][0], &r[1][0])?;
        return Some([first.widened(&slack), second.widened(&slack), zero()]);
    }
    let sine = square.sqrt()?;
    let over = sine.inverse()?;
    let first = Disc::angle(&r[1][2].neg().mul(&over), &r[0][2].mul(&over))?;
    let third = Disc::angle(&r[2][1].mul(&over), &r[2][0].mul(&over))?;
    let second = Disc::angle(&r[2][2], &sine)?;
    if second.re >= 0 {
        return Some([first, second, third]);
    }
    let half = Disc::point(Float::with_val(BITS, Constant::Pi), Float::new(BITS));
    let half = half.widened(&(Float::with_val(64, 4) >> BITS));
    Some([first.add(&half), second.neg(), third.add(&half)])
}

/// The zeros of `row . m` for m = (1, cos, sin) or (1, d, d^2).
fn places(variable: Variable, [constant, first, second]: &[Rational; 3]) -> Places {
    let is_free = *first == 0 && *second == 0;
    if is_free && *constant == 0 {
        return Places::All;
    }
    let line =
        |coefficients: &[Rational; 3]| super::roots::roots_with_multiplicity(&Univariate::new(coefficients.to_vec()));
    Places::Some(match variable {
        _ if is_free => Vec::new(),
        Variable::Translation => {
            let zero = Root::Rational(Rational::new());
            line(&[constant.clone(), first.clone(), second.clone()])
                .into_iter()
                .map(|(root, m)| ([root, zero.clone()], m))
                .collect()
        }
        Variable::Rotation => on_circle(constant, first, second),
    })
}

/// Whether the discriminant of an equation of rounded data may be 0.
fn may_touch(variable: Variable, [constant, first, second]: &[Rational; 3]) -> bool {
    let square = Rational::from(first * first);
    let (own, full) = match variable {
        Variable::Rotation => (Rational::from(constant * constant), square + Rational::from(second * second)),
        Variable::Translation => (Rational::from(constant * second) * 4, square),
    };
    let off = Rational::from(&own - &full).to_f64().abs();
    full > 0 && off <= CLEAR * (own.to_f64().abs() + full.to_f64())
}

/// The double root of an equation whose discriminant is 0.
fn touching(variable: Variable, [constant, first, second]: &[Rational; 3]) -> [Root; 2] {
    let pair = match variable {
        Variable::Translation => [-Rational::from(first / second) / 2, Rational::new()],
        Variable::Rotation => foot(constant, first, second),
    };
    pair.map(Root::Rational)
}

/// The point of the line `constant + first x + second y = 0` that is nearest to the origin.
fn foot(constant: &Rational, first: &Rational, second: &Rational) -> [Rational; 2] {
    let square = Rational::from(first * first) + Rational::from(second * second);
    [first, second].map(|c| -Rational::from(constant * c) / &square)
}

/// The points of the circle on the line `constant + first x + second y = 0`.
fn on_circle(constant: &Rational, first: &Rational, second: &Rational) -> Vec<([Root; 2], usize)> {
    let square = Rational::from(first * first) + Rational::from(second * second);
    // The foot of the perpendicular, and how far along the line the circle is, squared and over the square.
    let foot = foot(constant, first, second);
    let along = (square.clone() - constant.clone() * constant) / Rational::from(&square * &square);
    if along == 0 {
        return vec![(foot.map(Root::Rational), 2)];
    }
    let root = |middle: &Rational, factor: &Rational, sign: i32| {
        let factor = Rational::from(factor * sign);
        super::roots::surd(middle, &factor, &along)
    };
    let minus = -second.clone();
    [1, -1].map(|sign| ([root(&foot[0], &minus, sign), root(&foot[1], first, sign)], 1)).into()
}
