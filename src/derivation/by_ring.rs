//! Closure polynomials of linkages in space and on the sphere, in the coordinate rings of their groups.
//!
//! The equations of a group and of those on which it stands have the assemblies for solutions, one for one, and real assemblies have real
//! unknowns ([`crate::linkage::space`], [`crate::linkage::sphere`]). A function that has different values at different assemblies has as
//! many real values as there are real assemblies: a complex assembly with a real value would share it with its conjugate.

use super::coordinate_ring::{CoordinateRing, Function, Solutions};
use super::equation::primitive;
use crate::algebra::groebner::Equation;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::space::{SpaceGiven, SpaceLinkage, SpacePair};
use crate::kinematics::sphere::{SphereGiven, SphereJoint, SphereLinkage};
use crate::linkage::space::{self, Symbol, bodies, clusters, groups};
use crate::linkage::sphere;
use looproot_calculus::rotation::matrix::{Matrix, apply};
use looproot_calculus::unit::Root;
use rug::{Integer, Rational};

/// Products of words that a basis may take, as for the list of assemblies: some seconds.
pub(super) const EFFORT: u64 = 2_000_000_000;
/// Functions that are tried until one tells all assemblies apart.
const TRIED: usize = 12;
/// Highest degree of a cosine in the unknowns: its products with monomials of the ring are reduced one by one.
const HIGHEST: usize = 10;

/// The variable of a closure polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The tangent of half the angle of a joint, over the length of its axis if `over`, which is then irrational.
    HalfTangent {
        /// The joint.
        joint: usize,
        /// See above.
        over: bool,
    },
    /// The displacement of a joint, over the length of its axis if `over`.
    Distance {
        /// The joint.
        joint: usize,
        /// See above.
        over: bool,
    },
    /// A coordinate of the origin of a body.
    Position {
        /// The body.
        body: usize,
        /// The body in whose coordinates it is: the ground, or the first one of a group without it.
        against: usize,
        /// 0, 1 or 2.
        axis: usize,
    },
    /// An entry of the rotation matrix of a body.
    Rotation {
        /// The body.
        body: usize,
        /// As above.
        against: usize,
        /// Its row and column, from 0.
        at: [usize; 2],
    },
    /// A coordinate of the axis of a joint on the sphere, in those of the body that rests in the equations.
    Axis {
        /// The joint.
        joint: usize,
        /// 0, 1 or 2.
        axis: usize,
        /// The body.
        rest: usize,
    },
}

/// The closure polynomial of a group.
#[derive(Clone, Debug)]
pub struct RingPolynomial {
    /// The number of the group, in the order in which the groups are solved.
    pub group: usize,
    /// The variable.
    pub unknown: Unknown,
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Univariate<Integer>,
    /// The number of roots at the angle pi.
    pub at_pi: usize,
    /// The number of assemblies of the group and those on which it stands, with multiplicity.
    pub assemblies: usize,
    /// The number of assemblies for every root: they are told apart by other unknowns.
    pub shared: usize,
    /// The number of distinct assemblies; `None` where it is not known.
    pub distinct: Option<usize>,
    /// The number of unknowns of its equations.
    pub unknowns: usize,
}

impl RingPolynomial {
    /// Returns the number of distinct roots, the angle pi counted.
    #[must_use]
    pub fn values(&self) -> usize {
        self.coefficients.square_free_part().degree().unwrap_or(0) + usize::from(self.at_pi > 0)
    }

    /// Returns whether no two assemblies have the same root.
    #[must_use]
    pub fn separates(&self) -> bool {
        self.distinct == Some(self.values())
    }

    /// Returns the number of roots with multiplicity.
    #[must_use]
    pub fn roots(&self) -> usize {
        self.coefficients.degree().unwrap_or(0) + self.at_pi
    }

    /// Takes the root of the highest order that the polynomial has.
    fn reduced(mut self) -> Self {
        let order = order_of(&self.coefficients, self.at_pi);
        if let Some(root) = root_of(&self.coefficients, order) {
            (self.coefficients, self.at_pi, self.shared) = (root, self.at_pi / order, order);
        }
        self
    }

    /// Returns the number of distinct real roots, the angle pi counted.
    #[must_use]
    pub fn real_roots(&self) -> usize {
        self.coefficients.distinct_real_roots() + usize::from(self.at_pi > 0)
    }
}

/// The derivation of a case.
#[derive(Clone, Debug)]
pub struct RingDerivation {
    /// The polynomials, that of the last group first.
    pub polynomials: Vec<RingPolynomial>,
    /// The closure equations of the first one.
    pub equations: Vec<Polynomial<Rational>>,
    /// What the variables of the equations stand for.
    pub symbols: Vec<Symbol>,
    /// The unknown of the first polynomial in terms of these variables: a numerator and a denominator.
    pub unknown: [Polynomial<Rational>; 2],
    /// The reasons why some polynomials are missing.
    pub warnings: Vec<String>,
}

/// The equations of a group with the functions that may be its unknown.
pub(super) struct Part {
    pub unknowns: usize,
    pub equations: Vec<Equation>,
    pub symbols: Vec<Symbol>,
    pub functions: Vec<(Unknown, Function)>,
}

impl Part {
    /// Returns the polynomial of the first function that tells all assemblies apart, or of one with the most values.
    pub fn polynomial(&self, group: usize) -> std::result::Result<RingPolynomial, String> {
        let too_much = || "its Gröbner basis takes more work than is allowed, or has too many solutions".to_owned();
        let ring = match CoordinateRing::of(self.unknowns, &self.equations, EFFORT).ok_or_else(too_much)? {
            Solutions::Finite(ring) => ring,
            Solutions::None => return Err("its equations contradict one another".to_owned()),
            Solutions::Set(dimension) => {
                return Err(format!("its assemblies form a set of dimension {dimension}, complex ones counted"));
            }
        };
        let mut best: Option<RingPolynomial> = None;
        let mut distinct = None;
        for (unknown, function) in self.functions.iter().take(TRIED) {
            let Some((coefficients, at_pi)) = ring.values(function) else { continue };
            let assemblies = ring.dimension();
            let mut found = RingPolynomial {
                group,
                unknown: *unknown,
                coefficients,
                at_pi,
                assemblies,
                shared: 1,
                distinct: Some(assemblies),
                unknowns: self.unknowns,
            };
            if found.values() < assemblies {
                distinct = distinct.or_else(|| ring.distinct());
                found.distinct = distinct;
            }
            if found.separates() {
                return Ok(found);
            }
            if best.as_ref().is_none_or(|best| best.values() < found.values()) {
                best = Some(found);
            }
        }
        let best = best.map(RingPolynomial::reduced);
        best.ok_or_else(|| "no joint and no place of it is an unknown with rational equations".to_owned())
    }
}

/// Returns the highest order of a power that a polynomial is up to a factor, with so many roots at infinity.
pub(super) fn order_of(polynomial: &Univariate<Integer>, at_infinity: usize) -> usize {
    polynomial.square_free_decomposition().iter().fold(at_infinity, |order, (_, k)| gcd(order, *k))
}

/// Returns the polynomial of which another one is the power of this order, up to a factor; `None` if there is none.
pub(super) fn root_of(polynomial: &Univariate<Integer>, order: usize) -> Option<Univariate<Integer>> {
    let parts = polynomial.square_free_decomposition();
    if order == 0 || parts.iter().any(|(_, k)| k % order > 0) {
        return None;
    }
    let factors = parts.iter().flat_map(|(part, k)| vec![part; k / order]);
    Some(factors.fold(Univariate::one(), |all, part| all.mul(part)).primitive_part())
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn number(q: &Rational) -> Equation {
    Equation::from_rational(q).unwrap_or_else(Equation::zero)
}

fn constant(v: &Vector<Rational>) -> Vector<Equation> {
    v.each_ref().map(number)
}

/// Returns the tangent of half the angle of a joint from its cosine and the sine over the length of the axis, times that length where it
/// is rational, and whether it is not.
fn half_tangent(joint: &SphereJoint, cos: Equation, sin: &Equation) -> (Function, bool) {
    let square = dot(&joint.at[0], &joint.at[0]);
    let (sin, square, over) = match Rational::sqrt(&square) {
        Some(length) => (sin.mul(&number(&length)), Rational::from(1), false),
        None => (sin.clone(), square, true),
    };
    (Function::HalfTangent { cos, sin, square }, over)
}

/// Returns the same from the rotations of both bodies; `None` where the references have irrational lengths, or for a high degree.
fn half_tangent_between(joint: &SphereJoint, rotations: [&Matrix<Equation>; 2]) -> Option<(Function, bool)> {
    let [e, f] = [0, 1].map(|side| joint.reference(side));
    let size = Rational::sqrt(&(dot(&e, &e) * dot(&f, &f)))?;
    let axis = &joint.at[0];
    let turned = [(0, &e), (1, &f), (0, axis)].map(|(side, v)| apply(rotations[side], &constant(v)));
    let degree = |v: &Vector<Equation>| v.iter().map(Equation::degree).max().unwrap_or(0);
    if turned.iter().map(degree).sum::<usize>() > HIGHEST {
        return None;
    }
    let [e, f, u] = &turned;
    let cos = dot(e, f).mul(&number(&Rational::from(size.recip_ref())));
    let sin = dot(u, &cross(e, f)).mul(&number(&(size * dot(axis, axis)).recip()));
    Some(half_tangent(joint, cos, &sin))
}

/// Returns the variables of the equations that stand for something.
fn variable(symbols: &[Symbol], wanted: Symbol) -> Option<Equation> {
    symbols.iter().position(|symbol| *symbol == wanted).map(Equation::variable)
}

/// Returns the equations of the bodies that a group of a linkage in space holds, and its possible unknowns: angles and displacements by
/// which bodies were placed, other angles, and places.
pub(super) fn part_in_space(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    group: &[Vec<usize>],
    held: &[usize],
) -> Result<Part> {
    let mut order = held.to_vec();
    sort::by_key(&mut order, |body| *body != linkage.ground);
    let system = space::System::of(linkage, given, &order)?;
    let home = |body: usize| group.iter().position(|cluster| cluster.contains(&body));
    let own = linkage.joints.iter().enumerate().filter(|(_, joint)| {
        let [a, b] = joint.of.map(home);
        a.is_some() && b.is_some() && a != b
    });
    let own: Vec<_> = own.collect();
    let mut functions = Vec::new();
    let mut others = Vec::new();
    for (joint, one) in &own {
        let joint = *joint;
        match &one.pair {
            SpacePair::Revolute(axis) => {
                let known =
                    [Symbol::Cosine(joint), Symbol::Sine(joint)].map(|wanted| variable(&system.symbols, wanted));
                if let [Some(cos), Some(sin)] = known {
                    let (function, over) = half_tangent(&axis.sphere, cos, &sin);
                    functions.push((Unknown::HalfTangent { joint, over }, function));
                } else if let [Some(a), Some(b)] = one.of.map(|body| system.place(body))
                    && let Some((function, over)) = half_tangent_between(&axis.sphere, [&a.rotation, &b.rotation])
                {
                    others.push((Unknown::HalfTangent { joint, over }, function));
                }
            }
            SpacePair::Prismatic(axis) => {
                let Some(way) = variable(&system.symbols, Symbol::Shift(joint)) else { continue };
                let length = Rational::sqrt(&dot(&axis.sphere.at[0], &axis.sphere.at[0]));
                let over = length.is_none();
                let function = way.mul(&length.map_or_else(Equation::one, |length| number(&length)));
                functions.push((Unknown::Distance { joint, over }, Function::Plain(function)));
            }
            _ => {}
        }
    }
    functions.extend(others);
    let against = order[0];
    for body in group.iter().filter(|cluster| !cluster.contains(&against)).filter_map(|cluster| cluster.first()) {
        let Some(place) = system.place(*body) else { continue };
        let coordinates = place.translation.into_iter().enumerate().filter(|(_, c)| c.degree() > 0);
        functions.extend(
            coordinates.map(|(axis, c)| (Unknown::Position { body: *body, against, axis }, Function::Plain(c))),
        );
        let entries = place.rotation.into_iter().enumerate();
        let entries = entries.flat_map(|(i, row)| row.into_iter().enumerate().map(move |(j, c)| ([i, j], c)));
        let entries = entries.filter(|(_, c)| (1..=HIGHEST).contains(&c.degree()));
        functions.extend(entries.map(|(at, c)| (Unknown::Rotation { body: *body, against, at }, Function::Plain(c))));
    }
    Ok(Part { unknowns: system.unknowns, equations: system.equations, symbols: system.symbols, functions })
}

/// Returns the equations of a linkage on the sphere, and the angles of its joints, those at the ground first.
pub(super) fn part_on_sphere(linkage: &SphereLinkage, given: &[SphereGiven]) -> Result<Part> {
    let system = sphere::System::least(linkage, given)?;
    let mut symbols = vec![Symbol::Axis(0, 0); system.unknowns];
    for (joint, axis) in system.axes.iter().enumerate() {
        for (k, c) in axis.iter().enumerate() {
            let own = (0..system.unknowns).find(|unknown| *c == Equation::variable(*unknown));
            if let Some(unknown) = own {
                symbols[unknown] = Symbol::Axis(joint, k);
            }
        }
    }
    let rotations = sphere::rotations(&system, &system.axes);
    let rotation = |body: usize| rotations.iter().find(|(own, _)| *own == body).map(|(_, rotation)| rotation);
    let mut joints: Vec<usize> =
        (0..linkage.joints.len()).filter(|joint| given.iter().all(|one| one.joint != Some(*joint))).collect();
    sort::by_key(&mut joints, |joint| !linkage.joints[*joint].of.contains(&linkage.ground));
    let function = |joint: usize| {
        let own = &linkage.joints[joint];
        let [Some(a), Some(b)] = own.of.map(rotation) else { return None };
        let (function, over) = half_tangent_between(own, [a, b])?;
        Some((Unknown::HalfTangent { joint, over }, function))
    };
    let mut functions: Vec<(Unknown, Function)> = joints.into_iter().filter_map(function).collect();
    let rest = system.clusters.first().and_then(|cluster| cluster.bodies.first()).map_or(0, |(body, _)| *body);
    let axis = |(unknown, symbol): (usize, &Symbol)| {
        let Symbol::Axis(joint, axis) = *symbol else { return None };
        Some((Unknown::Axis { joint, axis, rest }, Function::Plain(Equation::variable(unknown))))
    };
    functions.extend(symbols.iter().enumerate().filter_map(axis));
    Ok(Part { unknowns: system.unknowns, equations: system.equations, symbols, functions })
}

/// Returns the polynomials of these parts, the last first.
fn derivation(parts: Vec<Result<Part>>) -> Result<RingDerivation> {
    let mut found = RingDerivation {
        polynomials: Vec::new(),
        equations: Vec::new(),
        symbols: Vec::new(),
        unknown: [Polynomial::zero(), Polynomial::one()],
        warnings: Vec::new(),
    };
    for (number, part) in parts.into_iter().enumerate().rev() {
        let derived = part.map_err(|error| error.to_string()).and_then(|part| Ok((part.polynomial(number)?, part)));
        match derived {
            Ok((polynomial, part)) => {
                if found.polynomials.is_empty() {
                    let variables: Vec<Polynomial<Rational>> = (0..part.unknowns).map(Polynomial::variable).collect();
                    let written = |equation: &Equation| primitive(&equation.evaluate(&variables));
                    found.equations = part.equations.iter().map(written).collect();
                    let own = part.functions.iter().find(|(unknown, _)| *unknown == polynomial.unknown);
                    if let Some((_, function)) = own {
                        let fraction = match function {
                            Function::Plain(value) => [value.clone(), Equation::one()],
                            Function::HalfTangent { cos, sin, .. } => [sin.clone(), cos.add(&Equation::one())],
                        };
                        found.unknown = fraction.map(|part| part.evaluate(&variables));
                    }
                    found.symbols = part.symbols;
                }
                found.polynomials.push(polynomial);
            }
            Err(reason) => found.warnings.push(format!("group {} has no closure polynomial: {reason}", number + 1)),
        }
    }
    match found.warnings.first() {
        Some(reason) if found.polynomials.is_empty() => Err(Error::Unsupported(reason.clone())),
        _ => Ok(found),
    }
}

/// Derives the closure polynomials of the groups of a linkage in space.
///
/// # Errors
/// As [`space::solve`], and where no group has a polynomial.
pub fn derive_in_space(linkage: &SpaceLinkage, given: &[SpaceGiven]) -> Result<RingDerivation> {
    if linkage.joints.iter().all(|joint| matches!(joint.pair, SpacePair::UniversalLeg(_))) {
        let message = format!(
            "closure polynomials of plates on UPU legs are not derived: on three general legs a plate has 84 poses, and the Gröbner basis over \
             the rationals of a ring of this dimension takes more than the {EFFORT} products of words that are allowed; solve counts the \
             poses modulo a prime and proves them one by one"
        );
        return Err(Error::Unsupported(message));
    }
    if space::is_platform(linkage, given) {
        let message =
            "a plate on six legs of given lengths is a platform, whose closure polynomial has other equations";
        return Err(Error::Unsupported(message.to_owned()));
    }
    let list = clusters(linkage, given, &bodies(linkage))?;
    let parts = groups(linkage, given, &list);
    if let [(group, held)] = parts.as_slice() {
        // What is wrong with the one group is wrong with the inputs.
        return derivation(vec![Ok(part_in_space(linkage, given, &group.bodies, held)?)]);
    }
    derivation(parts.iter().map(|(group, held)| part_in_space(linkage, given, &group.bodies, held)).collect())
}

/// Derives the closure polynomial of a linkage on the sphere.
///
/// # Errors
/// As [`sphere::solve`], and where there is no polynomial.
pub fn derive_on_sphere(linkage: &SphereLinkage, given: &[SphereGiven]) -> Result<RingDerivation> {
    derivation(vec![Ok(part_on_sphere(linkage, given)?)])
}
