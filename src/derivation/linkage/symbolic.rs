//! The relation of input and output of a linkage with coordinates of its points as symbols.

use super::closure::{InputNumber, LinkageDerivation, Relation, derive_linkage};
use super::cosines::integers;
use super::four_bar::four_bar;
use super::inputs::relation_with_symbols;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::derivation::equation::primitive;
use crate::derivation::interpolation::{COMPARED, Family, Source, Values, Watch};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Given, Linkage};
use rug::{Integer, Rational};

/// Maximum number of symbols: each multiplies the number of derivations by four or more.
const MOST_SYMBOLS: usize = 6;
/// Maximum number of symbols of linkages with gears and legs of given lengths, whose relations are interpolated in the input, too.
const MOST_BY_VALUES: usize = 2;

/// A coordinate of a point in its body.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// The body.
    pub body: usize,
    /// The number of the point in the body.
    pub point: usize,
    /// 0 for x, 1 for y.
    pub axis: usize,
    /// The coordinate in the file, in metres.
    pub value: Rational,
    /// The joints at this point, and which of their two bodies has it.
    ends: Vec<(usize, usize)>,
}

impl Coordinate {
    fn text(&self, linkage: &Linkage, between: char) -> String {
        let body = &linkage.bodies[self.body];
        let axis = ['x', 'y'][self.axis];
        format!("{}{between}{}{between}{axis}", body.name, body.points[self.point].0)
    }

    /// Returns its name in a request: `crank.B.x`.
    #[must_use]
    pub fn name(&self, linkage: &Linkage) -> String {
        self.text(linkage, '.')
    }

    /// Returns the name of its variable: `crank_B_x`.
    #[must_use]
    pub fn variable(&self, linkage: &Linkage) -> String {
        self.text(linkage, '_')
    }

    /// Returns the coordinates of all points at which some joints are, without those of bodies that have another point at the same place.
    #[must_use]
    pub fn all(linkage: &Linkage, joints: &[usize]) -> Vec<Self> {
        Self::with_point(linkage, joints, None)
    }

    /// As [`Self::all`], with those of another point: its body, and its number there.
    #[must_use]
    pub fn with_point(linkage: &Linkage, joints: &[usize], other: Option<(usize, usize)>) -> Vec<Self> {
        let mut list = Vec::new();
        for (body, own) in linkage.bodies.iter().enumerate() {
            for (point, (name, place)) in own.points.iter().enumerate() {
                let ends = joints.iter().flat_map(|joint| [(*joint, 0), (*joint, 1)]);
                let is_here = |(joint, side): &(usize, usize)| {
                    let joint = &linkage.joints[*joint];
                    joint.of[*side] == body && joint.at[*side] == *place
                };
                let ends: Vec<(usize, usize)> = ends.filter(is_here).collect();
                if ends.is_empty() && other != Some((body, point)) {
                    continue;
                }
                // The coordinates of two points at one place are no separate symbols.
                if own.points.iter().any(|(other, at)| other != name && at == place) {
                    continue;
                }
                for (axis, value) in [&place.re, &place.im].into_iter().enumerate() {
                    list.push(Self { body, point, axis, value: value.clone(), ends: ends.clone() });
                }
            }
        }
        list
    }

    /// Replaces it by another number, metres.
    pub fn put(&self, linkage: &mut Linkage, value: &Rational) {
        let place = &mut linkage.bodies[self.body].points[self.point].1;
        let own = if self.axis == 0 { &mut place.re } else { &mut place.im };
        own.clone_from(value);
        let place = place.clone();
        for (joint, side) in &self.ends {
            linkage.joints[*joint].at[*side].clone_from(&place);
        }
    }
}

/// The relation of input and output with symbols.
#[derive(Clone, Debug)]
pub struct LinkageSymbolic {
    /// The joint whose value is variable 0: a half-angle tangent or metres.
    pub input: usize,
    /// The other given joints, which are held.
    pub held: Vec<usize>,
    /// Whether the input is an angle.
    pub is_turn: bool,
    /// The body whose half-angle tangent is variable 1.
    pub body: usize,
    /// The body relative to which its angle is measured.
    pub against: usize,
    /// The joints on whose cycles the relation rests.
    pub joints: Vec<usize>,
    /// The symbols: the variables from 2.
    pub symbols: Vec<Coordinate>,
    /// The coordinates that keep the numbers of the file, zeros apart.
    pub numbers: Vec<Coordinate>,
    /// The polynomial.
    pub polynomial: Polynomial<Int>,
    /// Number of other values, drawn at random, at which it equals the relation that is derived from numbers; `None` of a four-bar, of which
    /// it is derived with the symbols themselves.
    pub compared: Option<usize>,
    /// Whether at the numbers of the file the relation derived from these divides it.
    pub agrees: bool,
}

impl LinkageSymbolic {
    /// Returns the polynomial with the given value of its input: the first symbol is variable 0, the output variable 1.
    #[must_use]
    pub fn at_input(&self, linkage: &Linkage, given: &Given) -> Option<Polynomial<Int>> {
        let rest = InputNumber::in_metres(linkage, given)?.put(&self.polynomial)?;
        let own = Polynomial::from_terms(rest.terms().map(|(exponents, c)| {
            let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
            (vec![power(2), power(1)], c.clone())
        }));
        (!own.is_zero()).then(|| integers(&own))
    }
}

/// The relations at values of the symbols.
struct Relations<'l> {
    linkage: &'l Linkage,
    relation: &'l Relation,
    symbols: &'l [Coordinate],
    /// The degrees in input and output.
    degrees: [usize; 2],
}

impl Relations<'_> {
    fn at(&self, values: &[Rational]) -> Option<Polynomial<Int>> {
        let mut linkage = self.linkage.clone();
        for (symbol, value) in self.symbols.iter().zip(values) {
            symbol.put(&mut linkage, value);
        }
        self.relation.polynomial(&linkage)
    }
}

impl Source for Relations<'_> {
    /// Returns the coefficients of all products of powers of input and output, the output varies fastest.
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let [input, output] = self.degrees;
        let mut list = vec![Integer::new(); (input + 1) * (output + 1)];
        for (exponents, c) in self.at(values)?.terms() {
            let power = |k: usize| exponents.get(k).map_or(0, |e| *e as usize);
            if power(0) > input || power(1) > output {
                return None;
            }
            list[power(0) * (output + 1) + power(1)] = c.to_integer();
        }
        Some(list)
    }
}

/// Returns the symbols that are wanted, or all coordinates other than zero, and the other coordinates.
pub(super) fn chosen(
    linkage: &Linkage,
    all: Vec<Coordinate>,
    wanted: &[String],
    most: usize,
) -> Result<(Vec<Coordinate>, Vec<Coordinate>)> {
    if let Some(twice) = wanted.iter().enumerate().find(|(k, name)| wanted[..*k].contains(name)) {
        return Err(Error::Invalid(format!("found the symbol {} twice, expected each name once", twice.1)));
    }
    let known = |all: &[Coordinate]| {
        let names: Vec<String> = all.iter().take(24).map(|one| one.name(linkage)).collect();
        names.join(", ")
    };
    if let Some(unknown) = wanted.iter().find(|name| all.iter().all(|one| one.name(linkage) != **name)) {
        return Err(Error::Invalid(format!("found the symbol {unknown}, expected some of {}", known(&all))));
    }
    let is_symbol = |one: &Coordinate| {
        if wanted.is_empty() { one.value != 0 } else { wanted.contains(&one.name(linkage)) }
    };
    let (symbols, numbers): (Vec<Coordinate>, Vec<Coordinate>) = all.into_iter().partition(is_symbol);
    if symbols.is_empty() || symbols.len() > most {
        let message = format!("found {} symbols, expected one to {most}, some of {}", symbols.len(), known(&symbols));
        return Err(Error::Unsupported(message));
    }
    Ok((symbols, numbers.into_iter().filter(|one| one.value != 0).collect()))
}

/// Returns the relation by interpolation.
fn interpolated(
    linkage: &Linkage,
    relation: &Relation,
    symbols: &[Coordinate],
    watch: &Watch<'_>,
) -> Result<Polynomial<Int>> {
    let mut source = Relations { linkage, relation, symbols, degrees: [0, 0] };
    let first = source.at(&Values::Scattered.start(symbols.len())).ok_or_else(none)?;
    source.degrees = [0, 1].map(|k| first.degree(k) as usize);
    let [input, output] = source.degrees;
    let names = symbols.iter().map(|one| one.name(linkage)).collect();
    let family = Family::new(&source, watch, Values::Scattered, names, (input + 1) * (output + 1));
    let interpolated = family.interpolated()?;
    let exponent = |power: usize| u32::try_from(power).unwrap_or(u32::MAX);
    let powers = |place: usize| [place / (output + 1), place % (output + 1)].map(exponent);
    let terms = interpolated.terms().map(|(place, others, c)| {
        let [first, second] = powers(place);
        ([first, second].into_iter().chain(others).collect::<Vec<u32>>(), c.clone())
    });
    let found = primitive(&Polynomial::from_terms(terms));
    family.compare(&found, 2, |coefficients| {
        let terms = coefficients.iter().enumerate().filter(|(_, c)| !c.is_zero());
        Polynomial::from_terms(terms.map(|(place, c)| (powers(place).to_vec(), Rational::from(c))))
    })?;
    relation.in_metres(integers(&found), linkage).ok_or_else(none)
}

fn none() -> Error {
    let message = "with symbols the relation of an input and an output is derived, and there is none: expected a given joint and a \
                   closure polynomial";
    Error::Unsupported(message.to_owned())
}

/// Derives the relation of a given joint, the first one unless another one is named among those `wanted`, and the output, the other given joints held,
/// with coordinates of points as symbols: those `wanted`, named as `crank.B.x`, else all of the joints concerned that are not zero.
///
/// # Errors
/// As [`derive_linkage`]; [`Error::Unsupported`] without a given joint, for more than six symbols (two with gears), if there would be more than 100,000
/// terms, and where it is ended; [`Error::Invalid`] for an unknown symbol.
pub fn derive_linkage_with_symbols(
    linkage: &Linkage,
    given: &[Given],
    wanted: &[String],
    watch: &Watch<'_>,
) -> Result<LinkageSymbolic> {
    let is_given =
        |name: &&String| given.iter().filter_map(Given::joint).any(|joint| linkage.joints[joint].name == **name);
    let (inputs, coordinates): (Vec<&String>, Vec<&String>) = wanted.iter().partition(is_given);
    let place = match inputs[..] {
        [] => 0,
        [input] => {
            let is_it = |one: &Given| one.joint().is_some_and(|joint| linkage.joints[joint].name == *input);
            given.iter().position(is_it).unwrap_or(0)
        }
        [one, other, ..] => {
            let message =
                format!("found the given joints {one} and {other}, expected one of them, and coordinates of points");
            return Err(Error::Invalid(message));
        }
    };
    // The first one is the input, and the others are held.
    let mut given = given.to_vec();
    if let Some(first) = given.get_mut(..=place) {
        first.rotate_right(1);
    }
    let base = derive_linkage(linkage, &given)?;
    let coordinates = Wanted { names: coordinates.into_iter().cloned().collect(), all: inputs.is_empty() };
    with_symbols(linkage, &given, base, &coordinates, watch)
}

/// The symbols that are asked for beside an input.
struct Wanted {
    names: Vec<String>,
    /// Whether no name stands for all of them.
    all: bool,
}

impl Wanted {
    /// Returns the symbols and the other coordinates.
    fn chosen(&self, linkage: &Linkage, joints: &[usize], most: usize) -> Result<(Vec<Coordinate>, Vec<Coordinate>)> {
        let all = Coordinate::all(linkage, joints);
        if self.names.is_empty() && !self.all {
            return Ok((Vec::new(), all.into_iter().filter(|one| one.value != 0).collect()));
        }
        chosen(linkage, all, &self.names, most)
    }
}

/// Derives the relation of the first given joint.
fn with_symbols(
    linkage: &Linkage,
    given: &[Given],
    mut base: LinkageDerivation,
    wanted: &Wanted,
    watch: &Watch<'_>,
) -> Result<LinkageSymbolic> {
    let relation = if base.relations.is_empty() { None } else { base.relations.swap_remove(0) };
    // Gears and legs of given lengths are in no relation of two rotations.
    let Some((relation, own)) = relation.filter(|_| base.gears.is_empty()).zip(base.input_output.take()) else {
        return by_values(linkage, given, &base, wanted, watch);
    };
    let (symbols, numbers) = wanted.chosen(linkage, &relation.joints, MOST_SYMBOLS)?;
    let agrees = |polynomial: &Polynomial<Int>| {
        let of_file = symbols.iter().enumerate().map(|(k, one)| (2 + k, Polynomial::constant(one.value.clone())));
        let rational = polynomial.map(|c| Some(Rational::from(c.to_integer())))?;
        let at_file = rational.substitute_all(&of_file.collect::<Vec<_>>());
        (!at_file.is_zero()).then(|| integers(&at_file).checked_div_exact(&own.polynomial).is_some())
    };
    let direct = four_bar(linkage, &relation, &symbols).filter(|found| agrees(found) == Some(true));
    let (polynomial, compared) = match direct {
        Some(found) => (found, None),
        None => (interpolated(linkage, &relation, &symbols, watch)?, Some(COMPARED)),
    };
    let agrees = agrees(&polynomial).ok_or_else(none)?;
    Ok(LinkageSymbolic {
        input: relation.input,
        held: relation.held_joints(),
        is_turn: relation.is_turn,
        body: relation.body,
        against: relation.against,
        joints: relation.joints.clone(),
        symbols,
        numbers,
        polynomial,
        compared,
        agrees,
    })
}

/// Derives the relation by closure polynomials at numbers, interpolated in the input and the symbols.
fn by_values(
    linkage: &Linkage,
    given: &[Given],
    base: &LinkageDerivation,
    wanted: &Wanted,
    watch: &Watch<'_>,
) -> Result<LinkageSymbolic> {
    let (one, best) = given.first().zip(base.polynomials.first()).ok_or_else(none)?;
    let input = one.joint().ok_or_else(none)?;
    // A pair of gears is no point of its bodies.
    let joints: Vec<usize> = (0..linkage.joints.len()).filter(|joint| !linkage.joints[*joint].is_gear()).collect();
    let (symbols, numbers) = wanted.chosen(linkage, &joints, MOST_BY_VALUES)?;
    let (polynomial, agrees) = relation_with_symbols(linkage, given, base, &symbols, watch)?.ok_or_else(none)?;
    Ok(LinkageSymbolic {
        input,
        held: given[1..].iter().filter_map(Given::joint).collect(),
        is_turn: matches!(one, Given::Turn { .. }),
        body: best.body,
        against: best.against,
        joints,
        symbols,
        numbers,
        polynomial,
        compared: Some(COMPARED),
        agrees,
    })
}
