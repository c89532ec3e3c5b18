//! The numbers of a dyad, each in a disc that is proved to hold it.

use super::cells::Place;
use super::equations::{Line, Skew, Wanted, vector};
use super::moments::with_moments;
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::catalogue::{DyadKind, Space};
use crate::kinematics::motion::{Vector, cross, dot};
use num_complex::Complex;
use rug::Float;

/// Bits of a number that is only shown: more than an f64 has.
const SHOWN: u32 = 64;

/// Numbers of a dyad by their name in the output, such as `fixed` or `fixed.direction`.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name.
    pub name: &'static str,
    /// The numbers: lengths in metres, angles in radians, components of directions.
    pub values: Vec<Complex<f64>>,
    /// Whether it is one number and no list.
    pub is_scalar: bool,
}

/// The numbers of a dyad, and how far they may be off.
#[derive(Clone, Debug, PartialEq)]
pub struct Dyad {
    /// The numbers.
    pub parts: Vec<Part>,
    /// No number is farther from the exact one, in each of its real and imaginary parts; infinite where that is not known.
    pub radius: f64,
}

impl Dyad {
    /// The numbers of this name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[Complex<f64>]> {
        self.parts.iter().find(|part| part.name == name).map(|part| part.values.as_slice())
    }

    /// The real parts of the numbers of this name, none for an unknown name.
    #[must_use]
    pub fn real(&self, name: &str) -> Vec<f64> {
        self.get(name).unwrap_or_default().iter().map(|z| z.re).collect()
    }
}

/// A dyad in the making.
pub(super) struct Making {
    parts: Vec<Part>,
    radius: f64,
    is_real: bool,
}

impl Making {
    pub fn new(is_real: bool) -> Self {
        Self { parts: Vec::new(), radius: 0.0, is_real }
    }

    fn value(&mut self, disc: &Disc) -> Complex<f64> {
        // A number that may be 0 is shown as 0.
        let shown = |x: &Float| if *x.as_abs() <= *disc.radius() { 0.0 } else { x.to_f64() };
        let (re, im) = (shown(&disc.re), if self.is_real { 0.0 } else { shown(&disc.im) });
        let off = |exact: &Float, shown: f64| Float::with_val(SHOWN, exact - shown).abs().to_f64();
        let radius = disc.radius().to_f64() + off(&disc.re, re).max(if self.is_real { 0.0 } else { off(&disc.im, im) });
        // The sum of two rounded numbers is at most two roundings too small.
        self.radius = self.radius.max(radius * (1.0 + 4.0 * f64::EPSILON));
        Complex::new(re + 0.0, im + 0.0)
    }

    pub fn list(&mut self, name: &'static str, discs: &[Disc]) {
        let values = discs.iter().map(|disc| self.value(disc)).collect();
        self.parts.push(Part { name, values, is_scalar: false });
    }

    fn scalar(&mut self, name: &'static str, disc: &Disc) {
        let values = vec![self.value(disc)];
        self.parts.push(Part { name, values, is_scalar: true });
    }

    /// A number of which the square is known. A square that may be 0 is that of a number no larger than its root.
    fn root(&mut self, name: &'static str, square: &Disc) {
        let root = square.sqrt().unwrap_or_else(|| {
            let most = Float::with_val(SHOWN, square.at_most()).sqrt();
            Disc::point(Float::new(SHOWN), Float::new(SHOWN)).widened(&most).widened(&(most.clone() >> 40_u32))
        });
        self.scalar(name, &root);
    }

    pub fn done(self) -> Dyad {
        Dyad { parts: self.parts, radius: self.radius }
    }
}

/// The dyad of a solution; `None` where these discs are too large to make it.
pub(super) fn dyad(wanted: &Wanted, place: &Place<Disc>, is_real: bool) -> Option<Dyad> {
    let width = wanted.width();
    let mut making = Making::new(is_real);
    match (wanted.kind, wanted.space) {
        (DyadKind::RR, Space::Sphere) => {
            let (fixed, moving) = (unit(&vector(&place.directions[0]))?, unit(&vector(&place.directions[1]))?);
            making.list("fixed", &fixed);
            making.list("moving", &moving);
            making.scalar("angle", &angle(&fixed, &wanted.start_direction(&moving))?);
        }
        (DyadKind::RR, Space::Space) => {
            let axes = Skew::of(place);
            let (g, w) = (unit(&axes.fixed)?, unit(&axes.moving)?);
            let foot = axes.fixed_foot(&wanted.first());
            let fixed = Line { moment: cross(&foot, &g), direction: g };
            let moving = Line { moment: cross(&axes.foot, &w), direction: w };
            two_lines(&mut making, wanted, &fixed, &moving)?;
            making.list("fixed.foot", &foot);
            making.list("moving.foot", &axes.foot);
        }
        (DyadKind::RR | DyadKind::SS, _) => {
            let (fixed, moving) = place.numbers.split_at(width);
            making.list("fixed", fixed);
            making.list("moving", moving);
            let start = wanted.start(&vector(moving));
            let link: Vector<Disc> = std::array::from_fn(|k| vector(fixed)[k].sub(&start[k]));
            making.root("length", &dot(&link, &link));
        }
        (DyadKind::PR | DyadKind::PPS, _) => {
            let normal = unit(&vector(&place.directions[0]))?;
            let distance = dot(&normal, &wanted.start(&vector(&place.numbers)));
            flat(&mut making, ["fixed.normal", "fixed.distance"], (&normal, &distance), width);
            making.list("moving", &place.numbers);
        }
        (DyadKind::RP, _) => {
            let normal = unit(&vector(&place.directions[0]))?;
            // The distance of the line from the origin of the body: `m . R^T (a - t)` of the first position.
            let motion = wanted.first::<Disc>();
            let fixed = vector(&place.numbers);
            let from: Vector<Disc> = std::array::from_fn(|k| fixed[k].sub(&motion.translation[k]));
            let distance = dot(&wanted.start_direction(&normal), &from);
            making.list("fixed", &place.numbers);
            flat(&mut making, ["moving.normal", "moving.distance"], (&normal, &distance), width);
        }
        (DyadKind::CC, _) => {
            let known = if place.numbers.is_empty() { with_moments(wanted, place)? } else { place.clone() };
            let fixed = line(&known.directions[0], &known.numbers[..3])?;
            let moving = line(&known.directions[1], &known.numbers[3..])?;
            two_lines(&mut making, wanted, &fixed, &moving)?;
        }
    }
    Some(making.done())
}

/// Lists two lines, and the angle and the distance between them in the first position.
fn two_lines(making: &mut Making, wanted: &Wanted, fixed: &Line<Disc>, moving: &Line<Disc>) -> Option<()> {
    for (line, names) in [(fixed, ["fixed.direction", "fixed.moment"]), (moving, ["moving.direction", "moving.moment"])]
    {
        making.list(names[0], &line.direction);
        making.list(names[1], &line.moment);
    }
    let start = moving.moved(&wanted.first());
    let angle = angle(&fixed.direction, &start.direction)?;
    let normal = cross(&fixed.direction, &start.direction);
    making.scalar("angle", &angle);
    // The dual part of cos(angle + e distance) is the reciprocal product: -distance sin(angle).
    let sine = dot(&normal, &normal).sqrt()?;
    making.scalar("distance", &fixed.reciprocal(&start).neg().mul(&sine.inverse()?));
    Some(())
}

/// The dyads of a function generator: crank and rocker, with the coupler between them. The frame goes from (0, 0) to (1, 0).
pub(super) fn four_bar(wanted: &Wanted, place: &Place<Disc>, is_real: bool) -> Option<Dyad> {
    let (crank, rocker) = place.numbers.split_at(2);
    let mut making = Making::new(is_real);
    let one = Disc::one();
    making.scalar("frame", &one);
    let start = wanted.start(&vector(rocker));
    let coupler: Vector<Disc> = std::array::from_fn(|k| start[k].sub(&vector(crank)[k]));
    for (names, arm) in [(["crank", "crank_angle0"], crank), (["rocker", "rocker_angle0"], rocker)] {
        let square = arm[0].mul(&arm[0]).add(&arm[1].mul(&arm[1]));
        making.root(names[0], &square);
        if is_real {
            let inverse = square.sqrt()?.inverse()?;
            making.scalar(names[1], &Disc::angle(&arm[0].mul(&inverse), &arm[1].mul(&inverse))?);
        }
    }
    making.root("coupler", &dot(&coupler, &coupler));
    making.list("crank_point", crank);
    making.list("rocker_point", rocker);
    Some(making.done())
}

fn flat(making: &mut Making, names: [&'static str; 2], (normal, distance): (&Vector<Disc>, &Disc), width: usize) {
    making.list(names[0], &normal[..width]);
    making.scalar(names[1], distance);
}

/// The vector of length 1 whose last component that is surely not 0 has a positive real part.
fn unit(v: &Vector<Disc>) -> Option<Vector<Disc>> {
    let length = dot(v, v).sqrt()?;
    let last = v.iter().rev().find(|x| x.is_not_zero())?;
    let length = if last.mul(&length.inverse()?).re < 0 { length.neg() } else { length };
    let inverse = length.inverse()?;
    Some(v.each_ref().map(|x| x.mul(&inverse)))
}

fn line(direction: &[Disc], moment: &[Disc]) -> Option<Line<Disc>> {
    let (given, unit) = (vector(direction), unit(&vector(direction))?);
    // Direction and moment are to one scale: that of the component that is surely not 0.
    let k = (0..3).find(|k| given[*k].is_not_zero())?;
    let factor = unit[k].mul(&given[k].inverse()?);
    Some(Line { direction: unit, moment: vector(moment).each_ref().map(|x| x.mul(&factor)) })
}

/// The angle between two vectors of length 1, from 0 to pi where they are real.
fn angle(one: &Vector<Disc>, other: &Vector<Disc>) -> Option<Disc> {
    let normal = cross(one, other);
    let square = dot(&normal, &normal);
    let sine = square.sqrt().unwrap_or_else(|| {
        let most = Float::with_val(SHOWN, square.at_most()).sqrt();
        Disc::point(Float::new(SHOWN), Float::new(SHOWN)).widened(&most).widened(&(most.clone() >> 40_u32))
    });
    Disc::angle(&dot(one, other), &sine)
}
