//! Involutes of circles, and pairs of involute gears with parallel axes, spur and helical, external and internal.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::Angle;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::catalogue::gearing::Pair;
use crate::displacement::Answer;
use crate::displacement::answer::Named;
use rug::{Float, Rational};

/// Half the width of an angle that solves an equation, as a power of two: below the last bit of an f64.
const WIDTH: i32 = -60;

/// Cosine and sine of an angle itself.
pub(super) fn cos_sin(angle: &Angle) -> (Enclosure, Enclosure) {
    angle.enclosed().cloned().unwrap_or_else(|| {
        let (cos, sin) = exact_cos_sin(angle);
        (Enclosure::of(&cos), Enclosure::of(&sin))
    })
}

pub(super) fn whole(n: u32) -> Enclosure {
    Enclosure::of(&Rational::from(n))
}

/// The point of the involute of a circle where the tangent has rolled off by an angle, its tangent, radius of curvature and arc.
pub fn curve(radius: &Rational, roll: &Angle) -> Answer {
    let (cos, sin) = cos_sin(roll);
    let radians = angle_of(roll, &cos, &sin);
    let Some(t) = radians else { return Answer::none("the roll angle is not known well enough") };
    let r = Enclosure::of(radius);
    let mut named = Named::default();
    let point = [cos.add(&t.mul(&sin)).mul(&r), sin.sub(&t.mul(&cos)).mul(&r)];
    named.enclosures("point", &point);
    named.enclosures("tangent", &[cos.clone(), sin.clone()]);
    named.enclosures("centre", &[cos.mul(&r), sin.mul(&r)]);
    named.enclosed("curvature_radius", &t.mul(&r));
    named.enclosed("arc", &t.mul(&t).mul(&r).scaled(&Rational::from((1, 2))));
    named.answer(
        "the centre of curvature of an involute is the point of the circle from which the tangent has rolled off",
    )
}

/// The angle in radians, whole turns included.
fn angle_of(angle: &Angle, cos: &Enclosure, sin: &Enclosure) -> Option<Enclosure> {
    let within = sin.atan2(cos)?;
    let turns = ((angle.radians() - within.middle().to_f64()) / std::f64::consts::TAU).round();
    let turns = Rational::from_f64(turns)?;
    Some(within.add(&Enclosure::pi().scaled(&Rational::from(2)).scaled(&turns)))
}

/// tan a - a
fn involute(a: &Enclosure) -> Option<Enclosure> {
    let (cos, sin) = a.cos_sin_of();
    Some(sin.over(&cos)?.sub(a))
}

/// The angle between 0 and a right one whose involute function has a value; `None` for values below 0.
fn inverse(value: &Enclosure) -> Option<Enclosure> {
    if value.holds_zero() || value.middle().is_sign_negative() {
        return value.is_zero().then(Enclosure::zero);
    }
    // By halving; the function rises.
    let (mut low, mut high) = (Float::new(192), Float::with_val(192, 1.57));
    for _ in 0..120 {
        let middle = Float::with_val(192, &low + &high) / 2_u32;
        let off = involute(&Enclosure::of_float(&middle))?.sub(value);
        if off.middle().is_sign_negative() { low = middle } else { high = middle }
    }
    let found = Float::with_val(192, &low + &high) / 2_u32;
    // The root lies between these two if their values are proved to differ in sign.
    let width = Float::with_val(192, 1) >> WIDTH.unsigned_abs();
    let below = involute(&Enclosure::of_float(&Float::with_val(192, &found - &width)))?.sub(value);
    let above = involute(&Enclosure::of_float(&Float::with_val(192, &found + &width)))?.sub(value);
    let is_between = !below.holds_zero()
        && below.middle().is_sign_negative()
        && !above.holds_zero()
        && !above.middle().is_sign_negative();
    is_between.then(|| Enclosure::of_float(&found).widened(WIDTH))
}

/// The measures of a pair of gears.
struct Measures {
    /// The transverse pressure angle at the reference circles, and that at which they run, by cosine and sine.
    reference: (Enclosure, Enclosure),
    working_angle: Enclosure,
    working: (Enclosure, Enclosure),
    module: Enclosure,
    radii: [Enclosure; 2],
    base: [Enclosure; 2],
    tips: [Enclosure; 2],
    distance: Enclosure,
    pitch: Enclosure,
    contact: Enclosure,
}

fn measures(pair: &Pair) -> Option<Measures> {
    let (cos_n, sin_n) = cos_sin(&pair.pressure_angle);
    let (cos_b, _) = cos_sin(&pair.helix);
    let tan_n = sin_n.over(&cos_n)?;
    let tan = tan_n.over(&cos_b)?;
    let cos = Enclosure::one().over(&Enclosure::one().add(&tan.mul(&tan)).sqrt()?)?;
    let sin = tan.mul(&cos);
    let normal = Enclosure::of(&pair.module);
    let module = normal.over(&cos_b)?;
    let [z1, z2] = pair.teeth.map(whole);
    let (sum, shifts) = if pair.internal {
        (z2.sub(&z1), Rational::from(&pair.shift[1] - &pair.shift[0]))
    } else {
        (z2.add(&z1), Rational::from(&pair.shift[1] + &pair.shift[0]))
    };
    let angle = sin.atan2(&cos)?;
    let added = tan_n.scaled(&Rational::from(&shifts * 2)).over(&sum)?;
    let working_angle = if shifts == 0 { angle } else { inverse(&tan.sub(&angle).add(&added))? };
    let working = if shifts == 0 { (cos.clone(), sin.clone()) } else { working_angle.cos_sin_of() };
    let half = Rational::from((1, 2));
    let radii = [z1, z2].map(|z| module.mul(&z).scaled(&half));
    let base = radii.each_ref().map(|r| r.mul(&cos));
    let distance = module.mul(&sum).scaled(&half).mul(&cos).over(&working.0)?;
    let tip = |k: usize, inside: bool| {
        let addendum = normal.scaled(&(if inside { 1 - pair.shift[k].clone() } else { 1 + pair.shift[k].clone() }));
        if inside { radii[k].sub(&addendum) } else { radii[k].add(&addendum) }
    };
    let tips = [tip(0, false), tip(1, pair.internal)];
    // The parts of the line of action from the base circles to the tips.
    let part = |k: usize| tips[k].mul(&tips[k]).sub(&base[k].mul(&base[k])).sqrt();
    let pitch = Enclosure::pi().mul(&module).mul(&cos);
    let across = distance.mul(&working.1);
    let length =
        if pair.internal { part(0)?.sub(&part(1)?).add(&across) } else { part(0)?.add(&part(1)?).sub(&across) };
    let contact = length.over(&pitch)?;
    Some(Measures {
        reference: (cos, sin),
        working_angle,
        working,
        module,
        radii,
        base,
        tips,
        distance,
        pitch,
        contact,
    })
}

/// The measures of a pair of involute gears.
pub fn pair(pair: &Pair) -> Answer {
    let Some(found) = measures(pair) else {
        return Answer::none(
            "no working pressure angle belongs to these profile shifts, or a tip lies inside of its base circle",
        );
    };
    let mut named = Named::default();
    named.enclosed("transverse_module", &found.module);
    let reference = found.reference.1.atan2(&found.reference.0).unwrap_or_else(Enclosure::zero);
    named.enclosed("transverse_pressure_angle", &reference);
    named.enclosed("working_pressure_angle", &found.working_angle);
    named.enclosed("centre_distance", &found.distance);
    named.enclosures("reference_radii", &found.radii);
    named.enclosures("base_radii", &found.base);
    named.enclosures("tip_radii", &found.tips);
    let rolling = found.base.each_ref().map(|base| base.over(&found.working.0).unwrap_or_else(Enclosure::zero));
    named.enclosures("rolling_radii", &rolling);
    named.enclosed("base_pitch", &found.pitch);
    named.enclosed("contact_ratio", &found.contact);
    if let Some(width) = &pair.width {
        let (_, sin) = cos_sin(&pair.helix);
        let overlap = Enclosure::of(width).mul(&sin).over(&Enclosure::pi().scaled(&pair.module));
        if let Some(overlap) = overlap {
            named.enclosed("overlap_ratio", &overlap);
            named.enclosed("total_contact_ratio", &found.contact.add(&overlap));
        }
    }
    // Below this shift the rack that cuts the gear takes away a part of the involute.
    let (cos_b, _) = cos_sin(&pair.helix);
    let square = found.reference.1.mul(&found.reference.1);
    let least = pair.teeth.map(|z| {
        let cut = whole(z).mul(&square).scaled(&Rational::from((1, 2))).over(&cos_b).unwrap_or_else(Enclosure::zero);
        Enclosure::one().sub(&cut)
    });
    named.enclosures("least_shift", &least);
    named.answer("the common normal of two involutes touches both base circles and passes through one point of the line of centres")
}
