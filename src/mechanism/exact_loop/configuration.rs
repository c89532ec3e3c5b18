//! Joint values of exact solutions, in discs that are proved to hold them.

use super::equations::{Step, System, lifted};
use super::outcome::{Point, Points};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::Equation;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use rug::{Float, Rational, float::Constant};

/// Bits from which a value is good enough: more than an f64 has.
const WANTED: u32 = 70;
/// Bits in which values are tried first; they are doubled each time.
const FIRST: u32 = 160;
/// The last of them. Solutions that need more differ by less than anything that a mechanism has.
const LAST: u32 = 20_480;

/// The data shared by a part of the solutions.
pub(crate) struct Configurations<'a> {
    system: &'a System,
    steps: &'a [Step],
    /// For a loop with a spherical joint, the constant between it and the first step.
    before: Option<&'a Motion<Rational>>,
    points: &'a Points,
    /// The two numbers of every unknown, each as a quotient of polynomials in the roots of the points.
    values: Option<Vec<[Quotient; 2]>>,
}

/// A numerator and a denominator, which is 0 at no point.
type Quotient = [Univariate<Rational>; 2];

/// The joint values of a solution.
#[derive(Clone, Debug)]
pub(crate) struct Configuration {
    /// An angle or a distance for each step.
    pub values: Vec<Disc>,
    /// The angles of the spherical joint about z, x and z.
    pub spherical: Option<[Disc; 3]>,
}

/// The result of a computation with a given number of digits.
enum Digits {
    /// The joint values.
    Enough(Box<Configuration>),
    /// Nothing: more of them are needed.
    TooFew,
    /// Nothing, however many they are.
    Never,
}

impl Digits {
    fn enough(configuration: Configuration) -> Self {
        Self::Enough(Box::new(configuration))
    }
}

/// The position of the first and the third axis of a spherical joint to each other.
enum Lock {
    /// Apart.
    Apart,
    /// They are one line: the middle angle is 0 or pi.
    Aligned,
    /// Complex numbers in which no middle angle belongs to the rotation.
    Isotropic,
}

impl<'a> Configurations<'a> {
    /// The configurations of a loop.
    pub fn new(
        system: &'a System,
        steps: &'a [Step],
        before: Option<&'a Motion<Rational>>,
        points: &'a Points,
    ) -> Self {
        let pair = |[one, two]: &[Equation; 2]| Some([points.quotient(one)?, points.quotient(two)?]);
        let values = system.unknowns.iter().map(pair).collect();
        Self { system, steps, before, points, values }
    }

    /// The joint values at a point; `None` where they have no angles, or need more digits than anything.
    pub fn at(&self, point: &Point) -> Option<Configuration> {
        let values = self.values.as_ref()?;
        let mut lock = None;
        let mut bits = FIRST;
        while bits <= LAST {
            let root = point.root(bits)?;
            let value = |[above, below]: &Quotient| {
                Some(root.evaluate(above.coefficients()).mul(&root.evaluate(below.coefficients()).inverse()?))
            };
            let pairs: Option<Vec<[Disc; 2]>> =
                values.iter().map(|[one, two]| Some([value(one)?, value(two)?])).collect();
            match pairs.map(|pairs| self.in_digits(point, &pairs, bits, &mut lock)) {
                Some(Digits::Enough(found)) if found.is_good() => return Some(*found),
                Some(Digits::Never) => return None,
                Some(Digits::Enough(_) | Digits::TooFew) | None => bits *= 2,
            }
        }
        None
    }

    /// Returns the values computed with `bits` bits.
    fn in_digits(&self, point: &Point, pairs: &[[Disc; 2]], bits: u32, lock: &mut Option<Lock>) -> Digits {
        let value = |(step, [one, other]): (&Step, &[Disc; 2])| match step.variable {
            Variable::Rotation => Disc::angle(one, other),
            Variable::Translation => Some(one.clone()),
        };
        let Some(values) = self.steps.iter().zip(pairs).map(value).collect() else { return Digits::TooFew };
        let Some(before) = self.before else { return Digits::enough(Configuration { values, spherical: None }) };
        let Some(rotation) = self.rest(before, pairs, bits) else { return Digits::TooFew };
        let square = across(&rotation);
        if lock.is_none() && !square.is_not_zero() {
            *lock = self.lock(point, before);
            if lock.is_none() {
                return Digits::Never;
            }
        }
        let spherical = match lock {
            None | Some(Lock::Apart) => apart(&rotation, &square),
            Some(Lock::Aligned) => aligned(&rotation, bits),
            Some(Lock::Isotropic) => return Digits::Never,
        };
        spherical.map_or(Digits::TooFew, |angles| Digits::enough(Configuration { values, spherical: Some(angles) }))
    }

    /// The rotation of all that follows the spherical joint: that of the joint is its inverse.
    fn rest(&self, before: &Motion<Rational>, pairs: &[[Disc; 2]], bits: u32) -> Option<[[Disc; 3]; 3]> {
        let image = |motion: &Motion<Rational>| motion.map(|x| Some(Disc::of(x, bits)));
        let mut rest = image(before)?;
        for (step, [one, other]) in self.steps.iter().zip(pairs) {
            let motion = match step.variable {
                Variable::Rotation => Motion::rotation_z(one.clone(), other.clone()),
                Variable::Translation => Motion::translation_z(one.clone()),
            };
            rest = rest.then_after(&motion).then_after(&image(&step.behind)?);
        }
        Some(rest.rotation)
    }

    /// Returns the position of the axes of the spherical joint to each other at a point, exactly.
    fn lock(&self, point: &Point, before: &Motion<Rational>) -> Option<Lock> {
        let whole = lifted(before)?.then_after(&self.system.stretch(self.steps, 0, self.steps.len())?);
        let [x, y, _] = &whole.rotation[2];
        let (x, y) = (self.points.value(point, x)?, self.points.value(point, y)?);
        if !self.points.is_zero(point, &x.mul(&x).add(&y.mul(&y)))? {
            return Some(Lock::Apart);
        }
        let is_aligned = self.points.is_zero(point, &x)? && self.points.is_zero(point, &y)?;
        Some(if is_aligned { Lock::Aligned } else { Lock::Isotropic })
    }
}

/// The square of the sine of the middle angle of the spherical joint that a rotation is the inverse of.
fn across(rotation: &[[Disc; 3]; 3]) -> Disc {
    let [x, y, _] = &rotation[2];
    x.mul(x).add(&y.mul(y))
}

/// The angles of the inverse of a rotation, about z, x and z, the middle one between 0 and pi.
fn apart(r: &[[Disc; 3]; 3], square: &Disc) -> Option<[Disc; 3]> {
    let sine = square.sqrt()?;
    let over = sine.inverse()?;
    let first = Disc::angle(&r[2][1].neg().mul(&over), &r[2][0].mul(&over))?;
    let second = Disc::angle(&r[2][2], &sine)?;
    let third = Disc::angle(&r[1][2].mul(&over), &r[0][2].mul(&over))?;
    // The principal root has a positive real part; where the angle itself has a negative one, its negative is as good.
    if second.re >= 0 {
        return Some([first, second, third]);
    }
    let half = half_turn(second.re.prec());
    Some([first.add(&half), second.neg(), third.add(&half)])
}

/// The angles where the middle one is 0 or pi: the third one is 0.
fn aligned(r: &[[Disc; 3]; 3], bits: u32) -> Option<[Disc; 3]> {
    let first = Disc::angle(&r[0][0], &r[0][1])?;
    let zero = Disc::point(Float::new(bits), Float::new(bits));
    if !r[2][2].is_not_zero() {
        return None;
    }
    let second = if r[2][2].re > 0 { zero.clone() } else { half_turn(bits) };
    Some([first, second, zero])
}

/// The angle pi.
fn half_turn(bits: u32) -> Disc {
    let pi = Float::with_val(bits, Constant::Pi);
    Disc::new(pi, Float::new(bits), &(Float::with_val(64, 4) >> bits))
}

impl Configuration {
    /// All joint values.
    fn all(&self) -> impl Iterator<Item = &Disc> {
        self.values.iter().chain(self.spherical.iter().flatten())
    }

    /// Whether all values are known to more digits than an f64 has.
    pub fn is_good(&self) -> bool {
        self.all()
            .all(|ball| Float::with_val(64, ball.radius() << WANTED) <= ball.at_most().max(&Float::with_val(64, 1)))
    }
}
