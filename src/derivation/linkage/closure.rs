//! The closure polynomial of every group of a linkage, and the relation of its output to its input.

use super::geared::derive_geared;
use super::without_circles;
use crate::algebra::int::Int;
use crate::algebra::modular::determinant;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::derivation::equation::primitive;
use crate::error::Result;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, LinkageJoint, Pair};
use crate::linkage::assembly::{Asked, Assemblies, assemblies, glued};
use crate::linkage::equations::{Closure, Equations};
use crate::linkage::general::{residue, torus_degree};
use crate::linkage::groups::{Group, MOST_CLUSTERS, Merged};
use crate::linkage::isotropic::Isotropic;
use crate::linkage::parts::{foundations, group_of};
use crate::linkage::pencil::{Parameter, Pencil};
use crate::linkage::polynomial::closure_polynomial;
use crate::linkage::real_form::RealForm;
use crate::linkage::state::{State, place_of};
use rug::{Integer, Rational};
use std::sync::atomic::AtomicBool;

/// Maximum number of rows for which the determinants of all bodies of a group are computed; beyond it only that of the best one.
const SMALL: usize = 20;
/// Number of rows of a matrix beyond which there is no polynomial.
const LARGE: usize = 70;

/// The exact equations of a group.
type Exact = Equations<Isotropic<Gaussian>>;

/// The polynomial of one body of a group.
#[derive(Clone, Debug)]
pub struct GroupPolynomial {
    /// The number of the group, in the order in which the groups are solved.
    pub group: usize,
    /// The body whose half-angle tangent is the variable.
    pub body: usize,
    /// The body relative to which its angle is measured.
    pub against: usize,
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Univariate<Integer>,
    /// Number of roots at the angle pi.
    pub at_pi: usize,
    /// The number of assemblies of this group and those it depends on, with multiplicity; `None` if it is not known.
    pub assemblies: Option<usize>,
    /// Number of rows of the matrix: the pencil of the cycles, or for gears the multiplication in the coordinate ring.
    pub rows: usize,
}

impl GroupPolynomial {
    /// Returns the number of roots with multiplicity.
    #[must_use]
    pub fn roots(&self) -> usize {
        self.coefficients.degree().unwrap_or(0) + self.at_pi
    }

    /// Returns whether every root belongs to an assembly and every assembly to a root, which follows from the numbers of both.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        self.assemblies == Some(self.roots())
    }
}

/// The relation of the angle of a body to the input.
#[derive(Clone, Debug)]
pub struct InputOutput {
    /// The joint whose value is the first variable: a half-angle tangent or metres.
    pub input: usize,
    /// Whether the input is an angle.
    pub is_turn: bool,
    /// The body whose half-angle tangent is the second variable.
    pub body: usize,
    /// The body relative to which its angle is measured.
    pub against: usize,
    /// The other given joints, which are held.
    pub held: Vec<usize>,
    /// Number of joints on whose cycles it rests.
    pub joints: usize,
    /// The polynomial in both.
    pub polynomial: Polynomial<Int>,
    /// Number of other inputs, drawn at random, at which it equals the closure polynomial, where it is interpolated; `None` where it is a
    /// determinant.
    pub compared: Option<usize>,
    /// Whether it equals the closure polynomial at the value of the input.
    pub agrees: bool,
}

/// The derivation of a case.
#[derive(Clone, Debug)]
pub struct LinkageDerivation {
    /// The polynomials, those of the last group first, the best of every group before the others.
    pub polynomials: Vec<GroupPolynomial>,
    /// The relation of the output and the first given joint, where the others are held.
    pub input_output: Option<InputOutput>,
    /// What relates the body of each polynomial and that joint.
    pub(super) relations: Vec<Option<Relation>>,
    /// The numbers of assemblies of the groups, in the order in which the groups are solved.
    pub groups: Vec<(Vec<Vec<usize>>, usize)>,
    /// The closure equations of the best polynomial, two for every cycle and then two for every pair of gears, in `variables`.
    pub equations: Vec<Polynomial<Rational>>,
    /// The pairs of gears, by their joints.
    pub gears: Vec<usize>,
    /// The meaning of the variables of the equations.
    pub variables: Vec<Symbol>,
    /// Whether no displacement that is unknown can become infinite: the best polynomial depends on all groups, and each displacement is the
    /// only one in some cycle, so that no link of the cycle lets it exceed the sum of their lengths.
    pub is_bounded: bool,
    /// The reasons why some polynomials are missing.
    pub warnings: Vec<String>,
}

impl LinkageDerivation {
    /// Returns the relation of the first given joint and the body of another one of the polynomials.
    #[must_use]
    pub fn relation_to(&self, linkage: &Linkage, given: &[Given], polynomial: usize) -> Option<InputOutput> {
        relate(linkage, given.first()?, self.relations.get(polynomial)?.as_ref()?, self.polynomials.get(polynomial)?)
    }
}

/// A variable of the closure equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// The cosine of the angle of a body.
    Cosine(usize),
    /// The sine of the angle of a body.
    Sine(usize),
    /// The displacement of a joint, relative to the length of its direction.
    Shift(usize),
}

/// The equations of a part of a linkage.
pub(super) struct Part {
    pub group: Group,
    pub closure: Closure,
    pub state: State,
    exact: Exact,
}

impl Part {
    pub fn new(linkage: &Linkage, given: &[Given], joints: Vec<usize>) -> Option<Self> {
        let mut merged = glued(linkage, given).ok()?.0;
        let state = glued_state(linkage, given)?;
        let group = group_of(linkage, joints, &mut merged);
        let closure = Closure::new(linkage, &group, &state)?;
        let exact = closure.equations.exact()?;
        Some(Self { group, closure, state, exact })
    }

    /// Returns class and rotation of a body relative to it, exactly.
    pub fn class_of(&self, body: usize) -> Option<(usize, Isotropic<Gaussian>)> {
        let (class, turn) = self.closure.class_of(&self.state, body)?;
        let half = |value: &crate::linkage::isotropic::Value| value.exact.as_ref()?.to_gaussian();
        Some((class, Isotropic { z: half(&turn.z)?, w: half(&turn.w)? }))
    }

    /// Returns the equations in which a class is rotated so that its rotation is that of `body` relative to `base`, or the
    /// inverse one if `is_inverse`, with the class at rest and the class that rotates.
    fn measured(&self, base: usize, body: usize, is_inverse: bool, exact: &mut Exact) -> Option<(usize, usize)> {
        let ((rest, own), (hidden, turned)) = (self.class_of(base)?, self.class_of(body)?);
        if rest == hidden {
            return None;
        }
        // With the class of the base at rest, theta_body / theta_base = theta_class turned / own.
        let (rest, hidden, factor) = if is_inverse {
            (hidden, rest, turned.mul(&own.mirrored()))
        } else {
            (rest, hidden, own.mul(&turned.mirrored()))
        };
        for cycle in &mut exact.cycles {
            cycle[hidden] = cycle[hidden].mul(&factor);
        }
        Some((rest, hidden))
    }

    /// Returns the closure equations in cosines and sines of the angles relative to `base`.
    pub fn equations(&self, base: usize) -> Option<(Vec<Symbol>, Vec<Polynomial<Rational>>)> {
        let (rest, own) = self.class_of(base)?;
        let exact = &self.exact;
        // The first body of every class represents it.
        let firsts: Vec<(usize, Isotropic<Gaussian>)> = (0..exact.classes)
            .map(|class| {
                let bodies = (0..self.state.bodies.len()).filter_map(|body| Some((body, self.class_of(body)?)));
                let mut bodies = bodies.filter(|(_, (of, _))| *of == class);
                bodies.next().map(|(body, (_, turn))| (body, own.mul(&turn.mirrored())))
            })
            .collect::<Option<_>>()?;
        let mut symbols = Vec::new();
        let mut turns = Vec::new();
        for (class, (body, _)) in firsts.iter().enumerate() {
            turns.push(if class == rest {
                [Polynomial::one(), Polynomial::zero()]
            } else {
                symbols.extend([Symbol::Cosine(*body), Symbol::Sine(*body)]);
                [symbols.len() - 2, symbols.len() - 1].map(Polynomial::variable)
            });
        }
        let shifts: Vec<Polynomial<Rational>> = exact
            .slides
            .iter()
            .map(|slide| {
                symbols.push(Symbol::Shift(slide.joint));
                Polynomial::variable(symbols.len() - 1)
            })
            .collect();
        let mut equations = Vec::new();
        for (k, cycle) in exact.cycles.iter().enumerate() {
            let mut sum = [Polynomial::zero(), Polynomial::zero()];
            let mut add = |class: usize, factor: &Isotropic<Gaussian>, by: &Polynomial<Rational>| {
                let factor = if class == rest { factor.z.clone() } else { factor.mul(&firsts[class].1).z };
                let [cos, sin] = &turns[class];
                // (re + i im)(c + i s)
                let parts = [(&factor.re, &factor.im, true), (&factor.im, &factor.re, false)];
                for (total, (one, two, is_minus)) in sum.iter_mut().zip(parts) {
                    let second = sin.scale(two);
                    let second = if is_minus { second.neg() } else { second };
                    *total = total.add(&cos.scale(one).add(&second).mul(by));
                }
            };
            for (class, factor) in cycle.iter().enumerate() {
                add(class, factor, &Polynomial::one());
            }
            for (slide, shift) in exact.slides.iter().zip(&shifts) {
                add(slide.class, &slide.coefficients[k], shift);
            }
            equations.extend(sum.iter().map(primitive));
        }
        Some((symbols, equations))
    }

    /// Returns whether every displacement is the only one of some cycle.
    fn is_bounded(&self) -> bool {
        let moves = |slide: usize, cycle: usize| !Ring::is_zero(&self.exact.slides[slide].coefficients[cycle].z);
        let slides = self.exact.slides.len();
        (0..slides).all(|slide| {
            (0..self.exact.cycles.len())
                .any(|cycle| moves(slide, cycle) && (0..slides).all(|other| other == slide || !moves(other, cycle)))
        })
    }

    /// Returns whether the class of another body must be at rest, because all slides are fixed in it.
    fn rests(&self, base: usize, body: usize) -> Option<bool> {
        let slides: Vec<usize> = self.exact.slides.iter().map(|slide| slide.class).collect();
        let is_all = |body: usize| self.class_of(body).map(|(class, _)| slides.iter().all(|own| *own == class));
        match (is_all(base)?, is_all(body)?) {
            (true, _) => Some(false),
            (false, true) => Some(true),
            (false, false) => None,
        }
    }
}

/// Returns the state in which bodies are joined as the inputs require.
pub(super) fn glued_state(linkage: &Linkage, given: &[Given]) -> Option<State> {
    let mut state = State::new(linkage.bodies.len(), 1);
    for one in given {
        let [a, b] = one.bodies(linkage);
        state.glue(a, b, &place_of(linkage, one)?);
    }
    Some(state)
}

/// Returns the polynomial with the variable negated.
fn mirrored(polynomial: &Univariate<Integer>) -> Univariate<Integer> {
    let signs = polynomial.coefficients().iter().enumerate();
    Univariate::new(signs.map(|(k, c)| if k % 2 == 1 { Integer::from(-c) } else { c.clone() }).collect())
}

/// Returns the polynomial with positive last coefficient.
fn positive(polynomial: Univariate<Integer>) -> Univariate<Integer> {
    let is_negative = polynomial.coefficients().last().is_some_and(|c| *c < 0);
    if is_negative { polynomial.scale(&Integer::from(-1)) } else { polynomial }
}

/// Derives the closure polynomials of all groups, and the polynomial of input and output.
///
/// # Errors
/// As [`crate::linkage::assembly::groups_of`], and for linkages with gears whose equations have no small Gröbner basis.
pub fn derive_linkage(linkage: &Linkage, given: &[Given]) -> Result<LinkageDerivation> {
    if linkage.joints.iter().any(LinkageJoint::is_gear) {
        return derive_geared(linkage, given);
    }
    let merged = glued(linkage, given)?.0;
    let solved = |complex| assemblies(linkage, given, Asked { complex, stop: &AtomicBool::new(false), near: None });
    let mut found = solved(false)?;
    let (mut polynomials, mut warnings) = of_groups(linkage, given, &found, &merged);
    // The complex assemblies of a large group are needed for the count of its polynomial alone.
    if found.only_real && !polynomials.is_empty() {
        found = solved(true)?;
        (polynomials, warnings) = of_groups(linkage, given, &found, &merged);
    }
    let relations: Vec<Option<Relation>> =
        polynomials.iter().map(|own| Relation::of(linkage, given, &found, &merged, own)).collect();
    let input_output = polynomials.first().zip(relations.first().and_then(Option::as_ref));
    let input_output = input_output.and_then(|(best, relation)| relate(linkage, &given[0], relation, best));
    let groups = found.groups.iter().map(|group| (group.bodies.clone(), group.count)).collect();
    let part = polynomials.first().and_then(|best| {
        let needed = foundations(linkage, &found.groups, best.group, linkage.ground, &merged);
        let is_whole = needed.len() == found.groups.len();
        Part::new(linkage, given, joints_of(&found, &needed)).map(|part| (best, part, is_whole))
    });
    let is_bounded = part.as_ref().is_some_and(|(_, part, is_whole)| *is_whole && part.is_bounded());
    let equations = part.and_then(|(best, part, _)| part.equations(best.against));
    let (variables, equations) = equations.unwrap_or_default();
    Ok(LinkageDerivation {
        polynomials,
        input_output,
        relations,
        groups,
        equations,
        gears: Vec::new(),
        variables,
        is_bounded,
        warnings,
    })
}

/// Returns the polynomials of all groups, the last group first, and what is to be said of groups without one.
fn of_groups(
    linkage: &Linkage,
    given: &[Given],
    found: &Assemblies,
    merged: &Merged,
) -> (Vec<GroupPolynomial>, Vec<String>) {
    let is_known = found.doubt.is_none() && found.curves.is_empty() && !found.only_real;
    let (mut polynomials, mut warnings) = (Vec::new(), Vec::new());
    for number in (0..found.groups.len()).rev() {
        let needed = foundations(linkage, &found.groups, number, linkage.ground, merged);
        let known = is_known.then(|| needed.iter().map(|k| found.groups[*k].count).product());
        let own = of_group(linkage, given, found, &needed, known);
        if own.is_empty() {
            warnings.push(format!("group {} has no polynomial of its own: {}", number + 1, WITHOUT));
        }
        polynomials.extend(own);
    }
    (polynomials, warnings)
}

const WITHOUT: &str =
    "its data are not rational, its slides are fixed in bodies that turn, or its matrix is singular or too large";

/// Returns the joints of some groups.
fn joints_of(found: &Assemblies, needed: &[usize]) -> Vec<usize> {
    needed.iter().flat_map(|k| found.groups[*k].joints.iter().copied()).collect()
}

/// Returns the polynomials of the bodies of the last of these groups, the best first.
fn of_group(
    linkage: &Linkage,
    given: &[Given],
    found: &Assemblies,
    needed: &[usize],
    known: Option<usize>,
) -> Vec<GroupPolynomial> {
    let Some(number) = needed.last().copied() else { return Vec::new() };
    let group = &found.groups[number];
    if group.bodies.len() > MOST_CLUSTERS {
        return Vec::new();
    }
    let Some(part) = Part::new(linkage, given, joints_of(found, needed)) else { return Vec::new() };
    let is_end = |body: &usize| group.joints.iter().any(|joint| linkage.joints[*joint].of.contains(body));
    let Some(cluster) = group.bodies.iter().find(|bodies| bodies.contains(&linkage.ground)).or(group.bodies.first())
    else {
        return Vec::new();
    };
    let against =
        if cluster.contains(&linkage.ground) { Some(linkage.ground) } else { cluster.iter().copied().find(is_end) };
    let Some(against) = against else { return Vec::new() };
    // Bodies with the rows of their matrix and its roots modulo a prime.
    let mut ranked: Vec<(usize, usize, usize, bool)> = Vec::new();
    for bodies in group.bodies.iter().filter(|bodies| *bodies != cluster) {
        let Some(body) = bodies.iter().copied().find(is_end) else { continue };
        let Some(is_inverse) = part.rests(against, body) else { continue };
        let mut exact = part.exact.clone();
        let Some((rest, hidden)) = part.measured(against, body, is_inverse, &mut exact) else { continue };
        let residues = exact.map(|n| Some(Isotropic { z: residue(&n.z)?, w: residue(&n.w)? }));
        let pencil = residues.and_then(|residues| Pencil::new(&residues, rest, &[Parameter::Turn(hidden)]));
        if let Some(pencil) = pencil.filter(|pencil| !pencil.sets.is_empty() && pencil.sets.len() <= LARGE)
            && let Some(degree) = torus_degree(&pencil)
        {
            ranked.push((degree, pencil.sets.len(), body, is_inverse));
        }
    }
    // Bodies that are joined to the one at rest are outputs rather than couplers.
    let is_output = |body: usize| {
        let ends = |joint: &usize| linkage.joints[*joint].of;
        group.joints.iter().any(|joint| ends(joint).contains(&body) && ends(joint).contains(&against))
    };
    sort::by_key(&mut ranked, |(degree, rows, body, _)| (*degree, *rows, !is_output(*body)));
    let mut list: Vec<GroupPolynomial> = Vec::new();
    for (_, rows, body, is_inverse) in ranked {
        if rows > SMALL && !list.is_empty() {
            continue;
        }
        let mut exact = part.exact.clone();
        let Some((rest, hidden)) = part.measured(against, body, is_inverse, &mut exact) else { continue };
        let pencil = Pencil::new(&exact, rest, &[Parameter::Turn(hidden)]);
        if let Some(closure) = pencil.as_ref().and_then(closure_polynomial) {
            let polynomial = if is_inverse { mirrored(&closure.polynomial) } else { closure.polynomial };
            list.push(GroupPolynomial {
                group: number,
                body,
                against,
                coefficients: positive(polynomial),
                at_pi: closure.at_pi,
                assemblies: known,
                rows,
            });
        }
    }
    list
}

/// The joints whose cycles relate the angle of a body to the motion of an input.
#[derive(Clone, Debug)]
pub(super) struct Relation {
    /// The joint whose value is the input.
    pub input: usize,
    /// Whether it turns.
    pub is_turn: bool,
    /// The joints, the input among them.
    pub joints: Vec<usize>,
    /// The other given values.
    pub held: Vec<Given>,
    /// The body whose half-angle tangent is the output, and that against which its angle is measured.
    pub body: usize,
    pub against: usize,
}

impl Relation {
    /// Returns that of the best polynomial to the first given joint, the others are held.
    pub fn of(
        linkage: &Linkage,
        given: &[Given],
        found: &Assemblies,
        merged: &crate::linkage::groups::Merged,
        best: &GroupPolynomial,
    ) -> Option<Self> {
        let (one, held) = given.split_first()?;
        let (Given::Turn { joint, .. } | Given::Shift { joint, .. }) = one else { return None };
        let mut joints = joints_of(found, &foundations(linkage, &found.groups, best.group, linkage.ground, merged));
        joints.push(*joint);
        let is_turn = matches!(one, Given::Turn { .. });
        let held = held.to_vec();
        Some(Self { input: *joint, is_turn, joints, held, body: best.body, against: best.against })
    }

    /// Returns the joints that are held; a body that is held has none.
    pub fn held_joints(&self) -> Vec<usize> {
        self.held.iter().filter_map(Given::joint).collect()
    }

    /// Returns the polynomial in input, a half-angle tangent or a part of the direction of the joint, and output.
    pub fn polynomial(&self, linkage: &Linkage) -> Option<Polynomial<Int>> {
        let part = Part::new(linkage, &self.held, self.joints.clone())?;
        let of = linkage.joints[self.input].of;
        let mut exact = part.exact.clone();
        let (rest, hidden) = part.measured(self.against, self.body, false, &mut exact)?;
        let (parameter, is_inverse) = if self.is_turn {
            let is_inverse = part.class_of(of[1])?.0 == rest;
            let (from, to) = if is_inverse { (of[1], of[0]) } else { (of[0], of[1]) };
            if part.class_of(from)?.0 != rest {
                return None;
            }
            let (_, class) = part.measured(from, to, false, &mut exact)?;
            (Parameter::Turn(class), is_inverse)
        } else {
            (Parameter::Shift(part.exact.slides.iter().position(|slide| slide.joint == self.input)?), false)
        };
        if parameter == Parameter::Turn(hidden) {
            return None;
        }
        let pencil = Pencil::new(&exact, rest, &[parameter, Parameter::Turn(hidden)])?;
        if pencil.sets.is_empty() || pencil.sets.len() > SMALL {
            return None;
        }
        let terms = determinant(&RealForm::new(&pencil)?.matrix, 2)?;
        let tangents: &[usize] = if self.is_turn { &[0, 1] } else { &[1] };
        let mut polynomial = without_circles(&terms, 2, tangents)?;
        if is_inverse {
            polynomial = polynomial.substitute(0, &Polynomial::variable(0).neg()).primitive_part();
        }
        // Factors of the input alone are inputs at which the matrix is singular for all outputs.
        let content = polynomial.content_in(1);
        if let Some(rest) = polynomial.checked_div_exact(&content).filter(|_| content.to_constant().is_none()) {
            polynomial = rest;
        }
        Some(polynomial)
    }

    /// Returns the same polynomial with the input in metres, if it is a displacement.
    pub fn in_metres(&self, polynomial: Polynomial<Int>, linkage: &Linkage) -> Option<Polynomial<Int>> {
        let Pair::Prismatic { length, .. } = &linkage.joints[self.input].pair else { return Some(polynomial) };
        let shift = Polynomial::variable(0).scale(&Rational::from(length.recip_ref()));
        let rational = polynomial.map(|c| Some(Rational::from(c.to_integer())))?;
        Some(rational.substitute(0, &shift).primitive().0)
    }
}

/// Returns the polynomial of the first given joint and the body of the best polynomial.
fn relate(linkage: &Linkage, one: &Given, relation: &Relation, best: &GroupPolynomial) -> Option<InputOutput> {
    let polynomial = relation.polynomial(linkage)?;
    let at_input = InputNumber::of(one).and_then(|number| number.put(&polynomial)?.to_univariate(1));
    let agrees = at_input.is_some_and(|own| is_multiple(&own, &best.coefficients));
    let polynomial = relation.in_metres(polynomial, linkage)?;
    let Relation { input, is_turn, body, against, .. } = *relation;
    let joints = relation.joints.len();
    let held = relation.held_joints();
    Some(InputOutput { input, is_turn, body, against, held, joints, polynomial, compared: None, agrees })
}

/// The value of an input as a relation has it.
pub(super) enum InputNumber {
    /// A half-angle tangent, or a displacement.
    Finite(Rational),
    /// The half-angle tangent of pi.
    Infinite,
}

impl InputNumber {
    /// Returns the number of a given value: a displacement in parts of the direction of its joint.
    pub fn of(given: &Given) -> Option<Self> {
        match given {
            Given::Turn { turn, .. } => {
                let below = Rational::from(1 + &turn.re);
                Some(if below == 0 { Self::Infinite } else { Self::Finite(Rational::from(&turn.im / &below)) })
            }
            Given::Shift { shift, .. } => Some(Self::Finite(shift.clone())),
            Given::Place { .. } => None,
        }
    }

    /// Returns the number of a given value: a half-angle tangent, or a displacement in metres.
    pub fn in_metres(linkage: &Linkage, given: &Given) -> Option<Self> {
        let pair = given.joint().map(|joint| &linkage.joints[joint].pair);
        Some(match (Self::of(given)?, pair) {
            (Self::Finite(shift), Some(Pair::Prismatic { length, .. })) => Self::Finite(shift * length),
            (number, _) => number,
        })
    }

    /// Returns a polynomial with this number for its first variable, which it does not contain any more.
    pub fn put(&self, polynomial: &Polynomial<Int>) -> Option<Polynomial<Rational>> {
        let rational = polynomial.map(|c| Some(Rational::from(c.to_integer())))?;
        match self {
            Self::Finite(value) => Some(rational.substitute(0, &Polynomial::constant(value.clone()))),
            Self::Infinite => {
                let degree = rational.degree(0);
                let leading =
                    rational.terms().filter(|(exponents, _)| exponents.first().copied().unwrap_or(0) == degree);
                Some(Polynomial::from_terms(leading.map(|(exponents, c)| {
                    let rest = exponents.iter().enumerate().map(|(k, e)| if k == 0 { 0 } else { *e });
                    (rest.collect(), c.clone())
                })))
            }
        }
    }
}

/// Returns whether two polynomials agree up to a factor.
pub(super) fn is_multiple(one: &Univariate<Rational>, two: &Univariate<Integer>) -> bool {
    let (a, b) = (one.coefficients(), two.coefficients());
    let (Some(last), Some(other)) = (a.last(), b.last()) else { return false };
    a.len() == b.len() && a.iter().zip(b).all(|(x, y)| Rational::from(x * other) == Rational::from(last * y))
}
