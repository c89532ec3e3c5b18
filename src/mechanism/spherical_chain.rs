//! Overconstrained loops with a spherical joint: its centre, reached from both sides by at most two other joint variables.
//!
//! With a spherical joint B the loop is `B G3 Va Ga Vb Gb = I`, and the centre of the spherical joint is carried back to where it was:
//! `Va Ga Vb p = p0`, three equations in at most two unknowns. Two of them are free of Va: for a rotation the height along
//! its axis and the distance from a point of it, for a translation the place across its axis. Their common roots are
//! exact; Va, by the third equation, and the rotation of the spherical joint follow.

use super::single_loop::closing_transformation;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::univariate::Univariate;
use crate::assembly::spherical_angles;
use crate::catalogue::entry::Case;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Numbers, Variable};
use crate::kinematics::link_form::transposed;
use crate::kinematics::motion::{Motion, Vector};
use crate::solve::scalar::Scalar;
use num_complex::Complex;
use rug::Rational;

/// A value of a joint variable.
type Value = Complex<f64>;

/// Less than this, over the sizes of all that comes in, may be rounding of the data.
const CLEAR: f64 = 1e-9;

/// All positions of the centre of a spherical joint.
pub(super) enum Positions {
    /// Isolated ones.
    Isolated {
        /// The joint variables in joint order, and how many coincide there.
        found: Vec<(Vec<Value>, usize)>,
        /// Whether there are none, and still none for data nearby.
        clear: bool,
    },
    /// The other joints move on while the centre is where it has to be.
    Moving,
}

/// An unknown beside the spherical joint: its index among the joint variables, what it does, and the constant behind it.
type Step = (usize, Variable, Motion<Rational>);

/// Finds every position of a loop with one spherical joint and at most two more unknowns.
///
/// # Errors
/// [`Error::Unsupported`] for other loops, [`Error::Invalid`] for a case without input that has one.
pub(super) fn positions(chain: &Chain, layout: &Layout, case: &Case) -> Result<Positions> {
    let (before, steps) = behind_spherical(chain, layout, case)?;
    // The centre as the spherical joint's own frame has it, seen from behind the constant that follows the spherical joint.
    let target = before.inverse().translation;
    let none: Vector<Rational> = std::array::from_fn(|_| Rational::new());
    let total = layout.variables.len();
    let lifted = |x: &Rational| Complex::from(x.to_f64());
    let mut found = Vec::new();
    let unit = chain.unit().to_f64();
    let clear;
    match steps.as_slice() {
        [] => {
            clear = target.iter().any(|x| x.to_f64().abs() > CLEAR * unit);
            if target == none {
                found.push((Vec::new(), 1));
            }
        }
        [(_, variable, constant)] => {
            let rows = unmoved(*variable, &constant.translation, &target);
            clear = rows.iter().any(|x| x.to_f64().abs() > CLEAR * unit.max(unit * unit));
            if rows.iter().all(Ring::is_zero) {
                let place = constant.translation.each_ref().map(lifted);
                let Some(value) = moved(*variable, &place, &target.each_ref().map(lifted)) else {
                    return Ok(Positions::Moving);
                };
                found.push((vec![value], 1));
            }
        }
        [(_, first, constant), (_, second, last)] => {
            let [one, two] = rows(*first, *second, constant, &last.translation, &target);
            clear = are_apart(&one, &two);
            let common = one.gcd(&two);
            if one.is_zero() && two.is_zero() {
                return Ok(Positions::Moving);
            }
            // The half-angle tangent i belongs to no angle; degrees that are missing in both are at the angle pi.
            let is_rotation = *second == Variable::Rotation;
            let common = if is_rotation { common.remove_factor(&Univariate::circle()).1 } else { common };
            let mut roots = roots(&common, is_rotation);
            let longest = one.degree().max(two.degree()).unwrap_or(0);
            if is_rotation && longest < 2 {
                roots.push(((Complex::from(-1.0), Complex::ZERO), 2 - longest));
            }
            for (pair, multiplicity) in roots {
                let place = carried(*second, pair, constant, &last.translation);
                let Some(value) = moved(*first, &place, &target.each_ref().map(lifted)) else {
                    return Ok(Positions::Moving);
                };
                let other = if is_rotation { Value::angle_of(pair.0, pair.1) } else { pair.0 };
                found.push((vec![value, other], multiplicity));
            }
        }
        _ => return Err(Error::Unsupported(format!("{} unknowns beside an S joint", steps.len()))),
    }
    let whole = |(values, multiplicity): (Vec<Value>, usize)| {
        let mut q = vec![Complex::ZERO; total];
        let mut motion = before.map(|x| Some(Complex::from(x.to_f64())));
        for ((index, variable, constant), value) in steps.iter().zip(&values) {
            q[*index] = *value;
            let step = match variable {
                Variable::Rotation => {
                    let (cos, sin) = value.cos_sin_of();
                    Motion::rotation_z(cos, sin)
                }
                Variable::Translation => Motion::translation_z(*value),
            };
            let constant = constant.map(|x| Some(Complex::from(x.to_f64())));
            motion = motion.zip(constant).map(|(motion, constant)| motion.then_after(&step).then_after(&constant));
        }
        let (Some(motion), Some(spherical)) = (motion, layout.spherical) else { return (q, multiplicity) };
        // The rotation of the spherical joint is the inverse of the rest.
        let (angles, _) = spherical_angles(&transposed(&motion.rotation));
        q[spherical..spherical + 3].copy_from_slice(&angles);
        (q, multiplicity)
    };
    let found: Vec<_> = found.into_iter().map(whole).collect();
    Ok(Positions::Isolated { clear: clear && found.is_empty(), found })
}

/// Returns whether two polynomials of degree 2 or less have no common root, even if their coefficients are slightly perturbed: by
/// their resultant for degree 2, so that roots at infinity count.
fn are_apart(one: &Univariate<Rational>, two: &Univariate<Rational>) -> bool {
    let parts = |polynomial: &Univariate<Rational>| {
        let list: [f64; 3] = std::array::from_fn(|k| polynomial.coefficients().get(k).map_or(0.0, Rational::to_f64));
        let size = list.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        list.map(|x| x / size)
    };
    let (p, q) = (parts(one), parts(two));
    let minor = |i: usize, j: usize| p[i] * q[j] - p[j] * q[i];
    let resultant = minor(2, 0) * minor(2, 0) - minor(2, 1) * minor(1, 0);
    resultant.abs() > CLEAR
}

/// Returns the constant between the spherical joint and the first unknown, and the unknowns with the constants behind them, up to
/// the spherical joint.
fn behind_spherical(chain: &Chain, layout: &Layout, case: &Case) -> Result<(Motion<Rational>, Vec<Step>)> {
    let unsupported = || Error::Unsupported("the loop has no S joint".to_owned());
    let spherical = layout.spherical.ok_or_else(unsupported)?;
    let mut cycle: Vec<_> =
        chain.cycle::<Rational>(&Numbers).ok_or_else(unsupported)?.into_iter().enumerate().collect();
    cycle.rotate_left(spherical + 2);
    let mut cycle = cycle.into_iter();
    let mut before = cycle.next().map(|(_, (_, constant))| constant).ok_or_else(unsupported)?;
    let mut steps: Vec<Step> = Vec::new();
    for (index, (variable, constant)) in cycle {
        // The other two turns of the spherical joint come last.
        if index == spherical {
            break;
        }
        if layout.locked == Some(index) {
            let constant = closing_transformation::<Rational>(case)?.then_after(&constant);
            let last = steps.last_mut().map_or(&mut before, |(_, _, constant)| constant);
            *last = last.then_after(&constant);
        } else {
            steps.push((index, variable, constant));
        }
    }
    Ok((before, steps))
}

/// The two equations that are free of a variable which carries a point to another: zero where they hold.
fn unmoved<R: Ring>(variable: Variable, from: &Vector<R>, to: &Vector<R>) -> [R; 2] {
    let apart = |k: usize| from[k].sub(&to[k]);
    match variable {
        Variable::Translation => [apart(0), apart(1)],
        Variable::Rotation => {
            let square = |v: &Vector<R>| v.iter().fold(R::zero(), |sum, x| sum.add(&x.mul(x)));
            [apart(2), square(from).sub(&square(to))]
        }
    }
}

/// The value of a variable that carries a point to another; `None` for a point on the axis, which a rotation leaves there.
fn moved(variable: Variable, from: &Vector<Value>, to: &Vector<Value>) -> Option<Value> {
    if variable == Variable::Translation {
        return Some(to[2] - from[2]);
    }
    let size: f64 = from.iter().map(Value::norm_sqr).sum();
    let square = from[0] * from[0] + from[1] * from[1];
    let cos = (from[0] * to[0] + from[1] * to[1]) / square;
    let sin = (from[0] * to[1] - from[1] * to[0]) / square;
    (square.norm() > 1e-24 * (1.0 + size)).then(|| Value::angle_of(cos, sin))
}

/// Both equations in the half-angle tangent of the second unknown, or in its distance.
fn rows(
    first: Variable,
    second: Variable,
    constant: &Motion<Rational>,
    point: &Vector<Rational>,
    target: &Vector<Rational>,
) -> [Univariate<Rational>; 2] {
    let numbers = |list: [i32; 3]| Univariate::new(list.map(Rational::from).to_vec());
    let scaled = |p: &Univariate<Rational>, c: &Rational| p.scale(c);
    // Homogeneous: coordinates over a common denominator.
    let (one, cos, sin) = match second {
        Variable::Rotation => (numbers([1, 0, 1]), numbers([1, 0, -1]), numbers([0, 2, 0])),
        Variable::Translation => (numbers([1, 0, 0]), numbers([1, 0, 0]), numbers([0, 0, 0])),
    };
    let [x, y, z] = point;
    let turned = [scaled(&cos, x).sub(&scaled(&sin, y)), scaled(&sin, x).add(&scaled(&cos, y)), scaled(&one, z)];
    let turned = match second {
        Variable::Rotation => turned,
        Variable::Translation => {
            let [x, y, z] = turned;
            [x, y, z.add(&numbers([0, 1, 0]))]
        }
    };
    let place: Vector<Univariate<Rational>> = std::array::from_fn(|i| {
        let row = (0..3).fold(Univariate::zero(), |sum, k| sum.add(&scaled(&turned[k], &constant.rotation[i][k])));
        row.add(&scaled(&one, &constant.translation[i]))
    });
    let target: Vector<Univariate<Rational>> = target.each_ref().map(|c| scaled(&one, c));
    let [left, right] = unmoved(first, &place, &target);
    // The squares have the denominator twice, which divides their difference once.
    let right = if first == Variable::Rotation && second == Variable::Rotation { right.div_exact(&one) } else { right };
    [left, right]
}

/// The roots of a polynomial of degree 2 or less, as cosine and sine of the angle with that half-angle tangent or as a
/// distance, and how many coincide.
fn roots(polynomial: &Univariate<Rational>, is_rotation: bool) -> Vec<((Value, Value), usize)> {
    let pair = |root: Value| {
        let square = root * root;
        if is_rotation { ((1.0 - square) / (1.0 + square), 2.0 * root / (1.0 + square)) } else { (root, Complex::ZERO) }
    };
    let c = polynomial.coefficients();
    match c {
        [constant, factor] => vec![(pair(Complex::from(-Rational::from(constant / factor).to_f64())), 1)],
        [constant, middle, factor] => {
            let half: Rational = Rational::from(middle / factor) / 2;
            let discriminant = Rational::from(&half * &half) - Rational::from(constant / factor);
            let centre = Complex::from(-half.to_f64());
            if discriminant.is_zero() {
                return vec![(pair(centre), 2)];
            }
            let reach = Complex::from(discriminant.to_f64()).sqrt();
            vec![(pair(centre - reach), 1), (pair(centre + reach), 1)]
        }
        _ => Vec::new(),
    }
}

/// The point behind the second unknown, seen from behind the first.
fn carried(
    second: Variable,
    (one, two): (Value, Value),
    constant: &Motion<Rational>,
    point: &Vector<Rational>,
) -> Vector<Value> {
    let lifted = |x: &Rational| Complex::from(x.to_f64());
    let [x, y, z] = point.each_ref().map(lifted);
    let turned = match second {
        Variable::Rotation => [one * x - two * y, two * x + one * y, z],
        Variable::Translation => [x, y, z + one],
    };
    std::array::from_fn(|i| {
        (0..3).map(|k| lifted(&constant.rotation[i][k]) * turned[k]).sum::<Value>() + lifted(&constant.translation[i])
    })
}
