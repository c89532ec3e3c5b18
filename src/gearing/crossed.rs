//! Involute gears on skew axes: helical gears that touch in one point.
//!
//! The flanks are involute helicoids. Their common normal at the point of contact keeps its line, which touches both base cylinders:
//! it has the same power on both shafts at one ratio of their rates, whatever their distance and angle. Places are given from the
//! pitch point: x runs from the first axis to the second, z along the teeth there. \[Wittenburg2016, 16.2\]

use super::involute::{cos_sin, whole};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::catalogue::gearing::Crossed;
use crate::displacement::Answer;
use crate::displacement::answer::Named;
use rug::Rational;

/// One of the two gears.
struct Gear {
    /// Cosine and sine of the helix angle.
    helix: (Enclosure, Enclosure),
    reference: Enclosure,
    base: Enclosure,
    tip: Enclosure,
    /// Cosine and sine of the helix angle on the base cylinder.
    base_helix: (Enclosure, Enclosure),
    /// The way of the point of contact along the line of action from the pitch point to the tip.
    way: Enclosure,
    /// The radius of curvature of the flank at the pitch point, across its straight generator.
    curvature: Enclosure,
    /// Sine and cosine of the angle of the generator at the pitch point from the teeth, before its length is made 1.
    generator: (Enclosure, Enclosure),
}

fn gear(crossed: &Crossed, k: usize) -> Option<Gear> {
    let (cos_n, sin_n) = cos_sin(&crossed.pressure_angle);
    let (cos, sin) = cos_sin(&crossed.helix[k]);
    let module = Enclosure::of(&crossed.module);
    let reference = module.mul(&whole(crossed.teeth[k])).scaled(&Rational::from((1, 2))).over(&cos)?;
    let tan = sin_n.over(&cos_n)?.over(&cos)?;
    let base = reference.over(&Enclosure::one().add(&tan.mul(&tan)).sqrt()?)?;
    let tip = reference.add(&module);
    let base_sine = sin.mul(&cos_n);
    let base_cosine = Enclosure::one().sub(&base_sine.mul(&base_sine)).sqrt()?;
    let roll = base.mul(&tan);
    let way = tip.mul(&tip).sub(&base.mul(&base)).sqrt()?.sub(&roll).over(&base_cosine)?;
    let curvature = roll.over(&base_cosine)?;
    let generator = (sin_n.mul(&sin), cos.clone());
    Some(Gear {
        helix: (cos, sin),
        reference,
        base,
        tip,
        base_helix: (base_cosine, base_sine),
        way,
        curvature,
        generator,
    })
}

/// The sine and the cosine of the sum of two angles, each given by sine and cosine up to a positive factor.
fn sum((s, c): &(Enclosure, Enclosure), (t, d): &(Enclosure, Enclosure)) -> (Enclosure, Enclosure) {
    (s.mul(d).add(&c.mul(t)), c.mul(d).sub(&s.mul(t)))
}

/// The measures of a pair of helical gears on skew axes.
pub fn answer(crossed: &Crossed) -> Answer {
    measures(crossed).unwrap_or_else(|| Answer::none("numbers of these gears are not known well enough"))
}

fn measures(crossed: &Crossed) -> Option<Answer> {
    let gears = [gear(crossed, 0)?, gear(crossed, 1)?];
    let (cos_n, sin_n) = cos_sin(&crossed.pressure_angle);
    let pair = |of: fn(&Gear) -> Enclosure| gears.each_ref().map(of);
    let swapped = |gear: &Gear| (gear.helix.1.clone(), gear.helix.0.clone());
    let (sine, cosine) = sum(&swapped(&gears[0]), &swapped(&gears[1]));
    let mut named = Named::default();
    named.enclosed("shaft_angle", &sine.atan2(&cosine)?);
    named.enclosed("centre_distance", &gears[0].reference.add(&gears[1].reference));
    named.number("ratio", &Rational::from((crossed.teeth[0], crossed.teeth[1])));
    named.enclosures("reference_radii", &pair(|gear| gear.reference.clone()));
    named.enclosures("base_radii", &pair(|gear| gear.base.clone()));
    named.enclosures("tip_radii", &pair(|gear| gear.tip.clone()));
    let [one, two] = gears.each_ref().map(|gear| gear.base_helix.1.atan2(&gear.base_helix.0));
    named.enclosures("base_helix_angles", &[one?, two?]);
    named.enclosures("line_of_action", &[sin_n, cos_n.clone(), Enclosure::zero()]);
    let pitch = Enclosure::pi().scaled(&crossed.module).mul(&cos_n);
    named.enclosed("base_pitch", &pitch);
    named.enclosed("contact_ratio", &gears[0].way.add(&gears[1].way).over(&pitch)?);
    named.enclosures("flank_curvature_radii", &pair(|gear| gear.curvature.clone()));
    let (sine, cosine) = sum(&gears[0].generator, &gears[1].generator);
    named.enclosed("generators_angle", &sine.atan2(&cosine)?);
    // The points of the flanks at the pitch point part along the teeth, for a unit rate of the first gear.
    let slide = |gear: &Gear| gear.helix.1.over(&gear.helix.0);
    let sliding = slide(&gears[0])?.add(&slide(&gears[1])?);
    let rolling = Enclosure::of(&crossed.module).mul(&whole(crossed.teeth[0])).scaled(&Rational::from((1, 2)));
    named.enclosed("sliding", &sliding.mul(&rolling));
    Some(
        named.answer("one line touches both base cylinders and is the normal of both flanks in every point of contact"),
    )
}
