//! Closure polynomials of linkages in space and on the sphere with numbers of the file as symbols, interpolated from those at values.

use super::by_ring::{
    Part, Unknown, derive_in_space, derive_on_sphere, order_of, part_in_space, part_on_sphere, root_of,
};
use super::coordinate_ring::{CoordinateRing, Solutions};
use super::equation::primitive;
use super::interpolation::{COMPARED, Family, Source, Values, Watch};
use super::sphere::Side;
use crate::algebra::int::Int;
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::InputValue;
use crate::catalogue::{SpaceFile, SphereFile, sphere::turned};
use crate::error::{Error, Result};
use crate::kinematics::motion::Vector;
use crate::kinematics::space::{Known, SpacePair};
use crate::kinematics::sphere::{SphereGiven, SphereLinkage};
use crate::linkage::space::{bodies, clusters, groups};
use rug::{Integer, Rational};

/// Maximum number of symbols: each multiplies the number of bases by four or more.
const MOST_SYMBOLS: usize = 3;
/// Products of words that a basis at one value may take, about a second: some dozens of them are needed.
const EFFORT: u64 = 300_000_000;

/// A closure polynomial with symbols.
#[derive(Clone, Debug)]
pub struct RingSymbolic {
    /// What variable 0 is.
    pub unknown: Unknown,
    /// The names of the symbols, the variables from 1, as they were asked for: `crank.B.x`, `rod.length`, or a given joint.
    pub symbols: Vec<String>,
    /// For every symbol that is the tangent of half a side of a body: the square of the number over which it is, 1 or the sine of the side
    /// in the file where that is irrational.
    pub sides: Vec<Option<Rational>>,
    /// The polynomial.
    pub polynomial: Polynomial<Int>,
    /// Number of other values, drawn at random, at which it equals the polynomial that is derived from numbers.
    pub compared: usize,
}

impl RingSymbolic {
    /// Returns the coefficients of the powers of the unknown, polynomials in the symbols.
    #[must_use]
    pub fn coefficients(&self) -> Vec<Polynomial<Int>> {
        self.polynomial.coefficients_in(0)
    }
}

/// A number of a linkage in space that is a symbol.
#[derive(Clone, Copy)]
enum Parameter {
    /// A coordinate of a point of a body: body, point, axis.
    Coordinate(usize, usize, usize),
    /// The length of a rod or of the rods of a parallelogram.
    Length(usize),
    /// The given value of a joint.
    Input(usize),
}

/// The closure polynomials at values of the symbols.
struct Rings<'a> {
    part: &'a (dyn Fn(&[Rational]) -> Option<Part> + Sync),
    unknown: Unknown,
    degree: usize,
    /// The number of assemblies at every root.
    shared: usize,
}

impl Rings<'_> {
    fn at(&self, values: &[Rational]) -> Option<(usize, Vec<Integer>)> {
        let part = (self.part)(values)?;
        let (_, function) = part.functions.iter().find(|(unknown, _)| *unknown == self.unknown)?;
        let Solutions::Finite(ring) = CoordinateRing::of(part.unknowns, &part.equations, EFFORT)? else { return None };
        let (mut polynomial, _) = ring.values(function)?;
        if self.shared > 1 {
            polynomial = root_of(&polynomial, self.shared)?;
        }
        Some((ring.dimension() / self.shared, polynomial.coefficients().to_vec()))
    }
}

impl Source for Rings<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let (degree, mut list) = self.at(values)?;
        list.resize(self.degree + 1, Integer::new());
        (degree == self.degree).then_some(list)
    }
}

fn interpolated(
    part: &(dyn Fn(&[Rational]) -> Option<Part> + Sync),
    unknown: Option<Unknown>,
    symbols: &[String],
    watch: &Watch<'_>,
) -> Result<RingSymbolic> {
    let unknown = unknown.ok_or_else(|| Error::Unsupported("a linkage without closure polynomial".to_owned()))?;
    let none = || {
        let message = "with these symbols the equations have no solutions, infinitely many, or take too much work";
        Error::Unsupported(message.to_owned())
    };
    let mut source = Rings { part, unknown, degree: 0, shared: 1 };
    let (whole, first) = source.at(&Values::Small.start(symbols.len())).ok_or_else(none)?;
    source.shared = order_of(&Univariate::new(first.clone()), (whole + 1).saturating_sub(first.len())).max(1);
    let degree = whole / source.shared;
    source.degree = degree;
    let family = Family::new(&source, watch, Values::Small, symbols.to_vec(), degree + 1);
    let exponent = |power: usize| u32::try_from(power).unwrap_or(u32::MAX);
    let interpolated = family.interpolated()?;
    let terms = interpolated
        .terms()
        .map(|(power, others, c)| (std::iter::once(exponent(power)).chain(others).collect::<Vec<u32>>(), c.clone()));
    let found = primitive(&Polynomial::from_terms(terms));
    family.compare(&found, 1, |coefficients| {
        let terms = coefficients.iter().enumerate();
        Polynomial::from_terms(terms.map(|(power, c)| (vec![exponent(power)], Rational::from(c))))
    })?;
    let polynomial = found.primitive().0;
    let (symbols, sides) = (symbols.to_vec(), vec![None; symbols.len()]);
    Ok(RingSymbolic { unknown, symbols, sides, polynomial, compared: COMPARED })
}

/// Checks the names of symbols.
fn checked(names: &[String], known: &str) -> Result<()> {
    if let Some(twice) = names.iter().enumerate().find(|(k, name)| names[..*k].contains(name)) {
        return Err(Error::Invalid(format!("found the symbol {} twice, expected each name once", twice.1)));
    }
    if names.is_empty() || names.len() > MOST_SYMBOLS {
        let message = format!("found {} symbols, expected one to {MOST_SYMBOLS}: {known}", names.len());
        return Err(Error::Unsupported(message));
    }
    Ok(())
}

fn unknown_symbol(name: &str, known: &str) -> Error {
    let name: String = name.chars().take(40).collect();
    Error::Invalid(format!("found the symbol {name}, expected {known}"))
}

const IN_SPACE: &str =
    "--symbolic=NAMES of coordinates of points as crank.B.x, of lengths as rod.length, and of given joints";

/// Most names that a message lists.
const LISTED: usize = 24;

/// Whether a joint has a length that may be a symbol.
fn has_length(pair: &SpacePair) -> bool {
    matches!(pair, SpacePair::Rod(_) | SpacePair::Parallelogram(..))
}

/// The names of given joints, lengths and coordinates.
fn names_in_space(file: &SpaceFile, case: usize) -> impl Iterator<Item = String> {
    let joints = &file.linkage.joints;
    let given = file.cases[case].given.iter().filter_map(|one| one.joint).map(|joint| joints[joint].name.clone());
    let lengths = joints.iter().filter(|joint| has_length(&joint.pair)).map(|joint| format!("{}.length", joint.name));
    let coordinates = file.linkage.bodies.iter().flat_map(|body| {
        let own = |point: &str, axis| format!("{}.{point}.{axis}", body.name);
        body.points.iter().flat_map(move |(point, _)| ["x", "y", "z"].map(|axis| own(point, axis)))
    });
    given.chain(lengths).chain(coordinates)
}

fn parameter(file: &SpaceFile, case: usize, name: &str) -> Result<Parameter> {
    let linkage = &file.linkage;
    let joint = |name: &str| linkage.joints.iter().position(|joint| joint.name == name);
    let none = || {
        let known: Vec<String> = names_in_space(file, case).take(LISTED).collect();
        unknown_symbol(name, &format!("some of {}", known.join(", ")))
    };
    match name.split('.').collect::<Vec<&str>>()[..] {
        [own] => {
            let joint = joint(own).ok_or_else(none)?;
            let is_given = file.cases[case].given.iter().any(|one| one.joint == Some(joint));
            if is_given { Ok(Parameter::Input(joint)) } else { Err(none()) }
        }
        [own, "length"] => {
            let joint = joint(own).ok_or_else(none)?;
            if has_length(&linkage.joints[joint].pair) { Ok(Parameter::Length(joint)) } else { Err(none()) }
        }
        [own, point, axis] => {
            let body = linkage.bodies.iter().position(|body| body.name == own).ok_or_else(none)?;
            let points = &linkage.bodies[body].points;
            let point = points.iter().position(|(name, _)| name == point).ok_or_else(none)?;
            let axis = ["x", "y", "z"].iter().position(|own| *own == axis).ok_or_else(none)?;
            if points.iter().enumerate().any(|(k, (_, at))| k != point && *at == points[point].1) {
                let message = format!("{name}, as another point of the body is at the same place");
                return Err(Error::Unsupported(message));
            }
            Ok(Parameter::Coordinate(body, point, axis))
        }
        _ => Err(none()),
    }
}

/// Replaces a coordinate of a point, in the joints that stand there and in what is given of them.
fn put(file: &mut SpaceFile, (body, point, axis): (usize, usize, usize), value: &Rational) {
    let place = &mut file.linkage.bodies[body].points[point].1;
    let before = place.clone();
    place[axis].clone_from(value);
    let after = place.clone();
    let change: Vector<Rational> = std::array::from_fn(|k| Rational::from(&after[k] - &before[k]));
    for (number, joint) in file.linkage.joints.iter_mut().enumerate() {
        for side in 0..2 {
            if joint.of[side] != body || joint.at[side] != before {
                continue;
            }
            joint.at[side].clone_from(&after);
            for one in file.cases[0].given.iter_mut().filter(|one| one.joint == Some(number)) {
                let Known::Motion(known) = &mut one.known else { continue };
                // The point of the second body lies where that of the first one is, moved along the axis.
                let moved = if side == 0 { change.clone() } else { known.rotate(&change).map(|c| -c) };
                known.translation.iter_mut().zip(&moved).for_each(|(c, change)| *c += change);
            }
        }
    }
}

/// Returns the file with values in place of the symbols; `None` where one is no exact value of its joint.
fn with_values(file: &SpaceFile, case: usize, parameters: &[Parameter], values: &[Rational]) -> Option<SpaceFile> {
    let mut own = SpaceFile { cases: vec![file.cases[case].clone()], ..file.clone() };
    // Whether the values are exact says the case in which nothing else was rounded.
    own.cases[0].exact = true;
    let mut inputs = Vec::new();
    for (parameter, value) in parameters.iter().zip(values) {
        match parameter {
            Parameter::Coordinate(body, point, axis) => put(&mut own, (*body, *point, *axis), value),
            Parameter::Length(joint) => match &mut own.linkage.joints[*joint].pair {
                SpacePair::Rod(square) | SpacePair::Parallelogram(_, square) => *square = Rational::from(value * value),
                _ => return None,
            },
            Parameter::Input(joint) => {
                let joint = &file.linkage.joints[*joint];
                let input = if joint.is_distance()? {
                    InputValue::Distance(Number::exact(value.clone()))
                } else {
                    InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(value.clone())))
                };
                inputs.push((joint.name.clone(), input));
            }
        }
    }
    let changed = own.case_at(&inputs).ok().filter(|case| case.exact)?;
    own.cases[0] = changed;
    Some(own)
}

/// Derives the closure polynomial of the last group of a linkage in space with coordinates of points, lengths, and given values (half-angle
/// tangents, metres) as symbols. It is compared at values drawn at random, and has no proof.
///
/// # Errors
/// As [`derive_in_space`]; for unknown symbols and more than three; where the values do not determine the polynomial, and where it is
/// ended.
pub fn derive_in_space_with_symbols(
    file: &SpaceFile,
    case: usize,
    names: &[String],
    watch: &Watch<'_>,
) -> Result<RingSymbolic> {
    checked(names, IN_SPACE)?;
    let parameters = names.iter().map(|name| parameter(file, case, name)).collect::<Result<Vec<_>>>()?;
    let base = derive_in_space(&file.linkage, &file.cases[case].given)?;
    let unknown = base.polynomials.first().map(|best| best.unknown);
    let part = |values: &[Rational]| {
        let own = with_values(file, case, &parameters, values)?;
        let (linkage, given) = (&own.linkage, &own.cases[0].given);
        let list = clusters(linkage, given, &bodies(linkage)).ok()?;
        let (group, held) = groups(linkage, given, &list).pop()?;
        part_in_space(linkage, given, &group.bodies, &held).ok()
    };
    interpolated(&part, unknown, names, watch)
}

/// A number of a linkage on the sphere that is a symbol.
enum SphereParameter {
    /// The given angle of a joint, by its place in the list.
    Input(usize),
    /// A side of a body.
    Side(Box<Side>),
}

const ON_SPHERE: &str = "--symbolic=NAMES of given joints, and of sides of bodies as crank.A.B from the point A to the point B; or of sides as \
                         --symbolic alone names them";

fn sphere_parameter(linkage: &SphereLinkage, given: &[SphereGiven], name: &str) -> Result<SphereParameter> {
    let none = || unknown_symbol(name, ON_SPHERE);
    match name.split('.').collect::<Vec<&str>>()[..] {
        [own] => {
            let is_named = |joint: usize| linkage.joints[joint].name == *own;
            let place = given.iter().position(|one| one.joint.is_some_and(is_named));
            place.map(SphereParameter::Input).ok_or_else(none)
        }
        [own, from, to] => {
            let body = linkage.bodies.iter().position(|body| body.name == own).ok_or_else(none)?;
            if ["x", "y", "z"].contains(&to) && linkage.bodies[body].point(to).is_none() {
                let message = format!(
                    "the symbol {name}: a coordinate of a direction on the sphere changes its length, which is that in the other body; \
                     sides of bodies are symbols, as {own}.A.B from the point A to the point B"
                );
                return Err(Error::Unsupported(message));
            }
            Side::of(linkage, body, [from, to]).ok_or_else(none)?.map(|side| SphereParameter::Side(Box::new(side)))
        }
        _ => Err(none()),
    }
}

/// Derives the closure polynomial of a linkage on the sphere with half-angle tangents of given joints and of sides of bodies as symbols,
/// compared at values drawn at random.
///
/// # Errors
/// As [`derive_on_sphere`] and [`derive_in_space_with_symbols`]; for sides of which the length is 0 or a half turn, or has no rational
/// half-angle tangent over its sine.
pub fn derive_on_sphere_with_symbols(
    file: &SphereFile,
    case: usize,
    names: &[String],
    watch: &Watch<'_>,
) -> Result<RingSymbolic> {
    let (linkage, given) = (&file.linkage, &file.cases[case].given);
    checked(names, ON_SPHERE)?;
    let parameters =
        names.iter().map(|name| sphere_parameter(linkage, given, name)).collect::<Result<Vec<SphereParameter>>>()?;
    let sides = || {
        parameters.iter().zip(names).filter_map(|(parameter, name)| match parameter {
            SphereParameter::Side(side) => Some((side, name)),
            SphereParameter::Input(_) => None,
        })
    };
    for (side, name) in sides() {
        if let Some((_, other)) = sides().find(|(other, own)| *own != name && side.moves(other)) {
            let message = format!("the symbols {name} and {other}, of which the first moves a point of the second");
            return Err(Error::Unsupported(message));
        }
    }
    let base = derive_on_sphere(linkage, given)?;
    let unknown = base.polynomials.first().map(|best| best.unknown);
    let part = |values: &[Rational]| {
        let (mut linkage, mut given) = (linkage.clone(), given.clone());
        for (parameter, value) in parameters.iter().zip(values) {
            match parameter {
                SphereParameter::Input(place) => {
                    let joint = &linkage.joints[given[*place].joint?];
                    let angle = Angle::from_half_tangent(HalfTangent::Finite(value.clone()));
                    let (rotation, exact) = turned(joint, &angle);
                    given[*place].rotation = Some(rotation).filter(|_| exact)?;
                }
                SphereParameter::Side(side) => side.put(&mut linkage, &mut given, value)?,
            }
        }
        part_on_sphere(&linkage, &given).ok()
    };
    let mut found = interpolated(&part, unknown, names, watch)?;
    for (own, parameter) in found.sides.iter_mut().zip(&parameters) {
        if let SphereParameter::Side(side) = parameter {
            *own = Some(side.over());
        }
    }
    Ok(found)
}
