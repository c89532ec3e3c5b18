//! The branches and limit positions of a four-bar while its input makes a full turn: theorem 14 of docs/certificate.md.

use super::data::primitive;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused, unreadable};
use super::record::{count, decimal, fields, list, text};
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::motion::dot;
use rug::{Float, Rational, float::Constant};
use serde_json::{Map, Value, json};

/// The kind of the item.
const KIND: &str = "discriminant";
/// Degree of the discriminant.
const DEGREE: usize = 4;
/// The inverse of the maximum radius of a limit position.
const LEAST_INVERSE: u32 = 1000;
/// The radius of a limit position that is written, which leaves the error of its centre in f64 some room.
const RADIUS: &str = "1e-12";
/// Maximum length of the text of a number of the data.
const LONGEST: usize = 800;
/// Bits in which pi is compared with rational numbers.
const PI_BITS: u32 = 512;

/// A four-bar: A turns about the z axis, and is at `(crank, 0)` where the input is 0.
pub(super) struct FourBar {
    pub crank: [Rational; 2],
    pub axis: [Rational; 3],
    /// A point of the axis: the centre of a circle, or any one.
    pub place: [Rational; 3],
    pub output: Output,
}

/// The output, with the squares of its lengths.
pub(super) enum Output {
    /// B, at a constant distance from A, circles about the axis.
    Circle { coupler: Rational, radius: Rational },
    /// B, at a constant distance from A, slides along the axis.
    Slide { coupler: Rational },
    /// A lies in a plane that turns about the axis at a constant distance.
    Plane { offset: Rational },
}

/// The claim of a certificate.
pub(super) struct Claim {
    branches: usize,
    circuits: usize,
    /// The centres and radii of the inputs of all limit positions.
    limits: Vec<[Rational; 2]>,
}

impl Claim {
    pub(super) fn read(branches: &Value, circuits: &Value, limits: &Value) -> Result<Self, Fault> {
        let limit = |limit: &Value| {
            let [centre, radius] = fields(limit, ["centre", "radius"], &[])?;
            Ok([decimal(centre)?, decimal(radius)?])
        };
        let limits = list(limits)?.iter().map(limit).collect::<Result<_, _>>()?;
        Ok(Self { branches: count(branches)?, circuits: count(circuits)?, limits })
    }
}

fn numbers<const N: usize>(value: &Value) -> Result<[Rational; N], Fault> {
    let read = list(value)?.iter().map(number).collect::<Result<Vec<_>, _>>()?;
    read.try_into().or_else(|_| unreadable(format!("data: found other than {N} numbers of a point")))
}

fn number(value: &Value) -> Result<Rational, Fault> {
    let found = text(value)?;
    let read = if found.len() > LONGEST { None } else { found.parse().ok() };
    read.map_or_else(|| unreadable("data: found no rational number of a four-bar"), Ok)
}

impl FourBar {
    fn read(data: &Map<String, Value>) -> Result<Self, Fault> {
        let whole = Value::Object(data.clone());
        let [crank, output] = fields(&whole, ["crank", "output"], &["coupler_squared"])?;
        let coupler = data.get("coupler_squared").map(number).transpose()?;
        let (axis, place, output) = match coupler {
            Some(coupler) if output.get("point").is_some() => {
                let [axis, point] = fields(output, ["axis", "point"], &[])?;
                (axis, point, Output::Slide { coupler })
            }
            Some(coupler) => {
                let [axis, centre, radius] = fields(output, ["axis", "centre", "radius_squared"], &[])?;
                (axis, centre, Output::Circle { coupler, radius: number(radius)? })
            }
            None => {
                let [axis, point, offset] = fields(output, ["axis", "point", "offset_squared"], &[])?;
                (axis, point, Output::Plane { offset: number(offset)? })
            }
        };
        let own = Self { crank: numbers(crank)?, axis: numbers(axis)?, place: numbers(place)?, output };
        if own.written() != Some(whole) {
            return refused("data: the four-bar is not written in the one form that docs/certificate.md gives it");
        }
        Ok(own)
    }

    /// Turns the input the other way, by a mirror.
    pub(super) fn mirror(&mut self) {
        for y in [&mut self.crank[1], &mut self.place[1], &mut self.axis[1]] {
            *y = Rational::from(-&*y);
        }
    }

    /// Returns the data in the one form of certificates: the axis by whole numbers without a common factor, the first one positive that
    /// is not 0, and of a line the point nearest to the origin; `None` if the axis is 0, or a square negative. Mirrored at the plane
    /// z = 0 all of it is as good.
    pub(super) fn written(&self) -> Option<Value> {
        if self.axis.iter().all(|x| *x == 0) {
            return None;
        }
        let mut axis = primitive(&self.axis).map(Rational::from);
        let mut place = self.place.clone();
        if !matches!(self.output, Output::Circle { .. }) {
            let along = dot(&axis, &place) / dot(&axis, &axis);
            place = std::array::from_fn(|k| &self.place[k] - Rational::from(&axis[k] * &along));
        }
        let is_negative = |v: &[Rational; 3]| v.iter().find(|x| **x != 0).map(|x| *x < 0);
        if place[2] < 0 || place[2] == 0 && (axis[2] < 0) != is_negative(&axis)? {
            (axis[2], place[2]) = (Rational::from(-&axis[2]), Rational::from(-&place[2]));
        }
        if is_negative(&axis)? {
            axis = axis.map(|x| -x);
        }
        let texts = |vector: &[Rational]| vector.iter().map(Rational::to_string).collect::<Vec<_>>();
        let (crank, axis, place) = (texts(&self.crank), texts(&axis), texts(&place));
        let square = |x: &Rational| (*x >= 0).then(|| x.to_string());
        Some(match &self.output {
            Output::Circle { coupler, radius } => json!({
                "crank": crank,
                "coupler_squared": square(coupler)?,
                "output": { "axis": axis, "centre": place, "radius_squared": square(radius)? },
            }),
            Output::Slide { coupler } => {
                json!({ "crank": crank, "coupler_squared": square(coupler)?, "output": { "axis": axis, "point": place } })
            }
            Output::Plane { offset } => {
                json!({ "crank": crank, "output": { "axis": axis, "point": place, "offset_squared": square(offset)? } })
            }
        })
    }

    /// Returns the polynomial D in the half-angle tangent of the input.
    fn discriminant(&self) -> Univariate<Rational> {
        let [x, y] = &self.crank;
        let (a, n, c) = ([x.clone(), y.clone(), Rational::new()], &self.axis, &self.place);
        // 1, cosine and sine times 1 + x^2.
        let trigonometric = |one: Rational, cos: &Rational, sin: Rational| {
            Univariate::new(vec![Rational::from(&one + cos), sin * 2, one - cos])
        };
        let crossed = |v: &[Rational; 3]| Rational::from(x * &v[1]) - Rational::from(y * &v[0]);
        // For V = A - c the square of V and its product with n.
        let side = trigonometric(dot(&a, &a) + dot(c, c), &(dot(&a, c) * -2), crossed(c) * -2);
        let along = trigonometric(-dot(n, c), &dot(&a, n), crossed(n));
        let circle = Univariate::circle();
        let across = side.mul(&circle).sub(&along.mul(&along).scale(&dot(n, n).recip()));
        match &self.output {
            Output::Circle { coupler, radius } => {
                let rest = side.add(&circle.scale(&Rational::from(radius - coupler)));
                across.scale(&Rational::from(radius * 4)).sub(&rest.mul(&rest))
            }
            Output::Slide { coupler } => circle.mul(&circle).scale(coupler).sub(&across),
            Output::Plane { offset } => across.sub(&circle.mul(&circle).scale(offset)),
        }
    }
}

fn item(discriminant: &Univariate<Rational>) -> Value {
    let texts: Vec<String> = discriminant.coefficients().iter().map(Rational::to_string).collect();
    json!({ "kind": KIND, "polynomial": texts })
}

/// Returns the number of branches and that of their circuits. Without limit positions two branches close in themselves, or there are none.
fn branches(discriminant: &Univariate<Rational>, limits: usize) -> (usize, usize) {
    let is_closed = discriminant.coefficients().last().is_some_and(|c| *c > 0);
    match limits {
        0 if is_closed => (2, 2),
        limits => (limits, limits / 2),
    }
}

fn status(branches: usize) -> &'static str {
    if branches == 0 { "unreachable" } else { "complete" }
}

/// Returns the claim about a four-bar and its proof.
///
/// # Errors
/// A clause that says why theorem 14 does not apply.
pub fn proof_of_sweep(data: &Value) -> Result<(Value, Value), String> {
    let Value::Object(table) = data else { return Err("there are no data".to_owned()) };
    let discriminant = FourBar::read(table).map_err(|fault| fault.to_string())?.discriminant();
    if discriminant.degree() != Some(DEGREE) {
        return Err("the discriminant has a root at half a turn of the input, or is 0".to_owned());
    }
    let mut roots = discriminant.real_roots();
    if roots.iter().any(|root| root.multiplicity() > 1) {
        return Err("the discriminant has a multiple real root: branches meet there".to_owned());
    }
    let centres = roots.iter_mut().map(|root| 2.0 * root.to_f64().atan());
    let limits: Vec<Value> =
        centres.map(|centre| json!({ "centre": format!("{centre:.14}"), "radius": RADIUS })).collect();
    let (branches, circuits) = branches(&discriminant, limits.len());
    let claim = json!({
        "verb": "sweep", "status": status(branches), "proof": "proved",
        "branches": branches, "circuits": circuits, "limits": limits,
    });
    Ok((claim, item(&discriminant)))
}

/// Checks a certificate of a sweep, and returns the numbers of branches, of circuits and of limit positions.
pub(super) fn check_sweep(
    data: &Map<String, Value>,
    stated: &str,
    claim: &Claim,
    modes: usize,
    proof: &[Value],
) -> Result<[usize; 3], Fault> {
    let discriminant = FourBar::read(data)?.discriminant();
    if modes > 0 {
        return refused("modes: none are asked for here");
    }
    if discriminant.degree() != Some(DEGREE) {
        return refused("proof: discriminant: it has a root at half a turn of the input, or is 0");
    }
    // Without limit positions nothing else would tell these data from others.
    if *proof != [item(&discriminant)] {
        return refused("proof: the branches of a four-bar are shown by one item, the discriminant of the data");
    }
    let roots = discriminant.real_roots();
    if roots.iter().any(|root| root.multiplicity() > 1) {
        return refused("proof: discriminant: a real root is a multiple one");
    }
    check_limits(&discriminant, roots.len(), &claim.limits)?;
    let (branches, circuits) = branches(&discriminant, roots.len());
    if (claim.branches, claim.circuits, stated) != (branches, circuits, status(branches)) {
        return refused(format!("claim: {branches} branches on {circuits} circuits are proved"));
    }
    Ok([branches, circuits, roots.len()])
}

/// Checks that so many intervals hold a root each: they are apart, and the discriminant has different signs at their ends.
fn check_limits(discriminant: &Univariate<Rational>, roots: usize, limits: &[[Rational; 2]]) -> Result<(), Fault> {
    if limits.len() != roots {
        let found = limits.len();
        return refused(format!("claim: {found} limit positions, where the discriminant has {roots} real roots"));
    }
    // Pi, less than that by more than its error.
    let pi = Float::with_val(PI_BITS, Constant::Pi).to_rational().unwrap_or_default()
        - Rational::from_f64(1e-140).unwrap_or_default();
    let mut end = Rational::from(-&pi);
    for (at, [centre, radius]) in (1..).zip(limits) {
        if *radius <= 0 || *radius > Rational::from((1, LEAST_INVERSE)) {
            return refused(format!("limit {at}: the radius is not above 0 and at most 1/{LEAST_INVERSE}"));
        }
        let (low, high) = (Rational::from(centre - radius), Rational::from(centre + radius));
        if low <= end || high >= pi {
            return refused(format!("limit {at}: the limits are not apart, in ascending order, between -pi and pi"));
        }
        match (is_positive(discriminant, &low), is_positive(discriminant, &high)) {
            (Some(before), Some(behind)) if before != behind => end = high,
            _ => {
                return refused(format!("limit {at}: no root of the discriminant is proved within the radius"));
            }
        }
    }
    Ok(())
}

/// Returns the sign of the discriminant at an angle, if it is sure. Times a positive number it is a form in cosine and sine of the half.
fn is_positive(discriminant: &Univariate<Rational>, angle: &Rational) -> Option<bool> {
    let half = (Rational::from(angle / 2_u32), Rational::new());
    let (cos, sin) = Ball::<384>::cos_sin_about(&half, 0.0);
    let (mut value, mut power) = (Ball::zero(), Ball::one());
    for c in discriminant.coefficients().iter().rev() {
        value = value.mul(&sin).add(&power.mul(&Ball::from_rational(c)?));
        power = power.mul(&cos);
    }
    // Not by a bound in f64, which small mechanisms underflow.
    (!value.contains_zero()).then(|| value.is_right())
}
