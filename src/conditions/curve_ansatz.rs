//! Mobile 5R loops of given twists: curves of spherical configurations on which two joints are Moebius-related, and the
//! lengths that close on them.
//!
//! The spherical image of a 5R loop has two degrees of freedom. With `tan(theta_i/2) tan(theta_j/2) = K`, or with a
//! constant ratio, one is left, and the other three joints follow from a quadratic equation whose discriminant D is a
//! function of one tangent. The curve splits in two if D is a square; on each part the lengths that close everywhere
//! are the solutions of linear equations.

use super::finite_field::{Turn, half_tangent_turn, square_root, turn};
use super::spherical::{Directions, Triad, triad};
use crate::algebra::echelon::Echelon;
use crate::algebra::lift;
use crate::algebra::modp::ModP;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::catalogue::ansatz::Link;
use crate::kinematics::motion::{Vector, cross};
use rayon::prelude::*;
use rug::Rational;

/// The relation between the half-angle tangents of two joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// `x_i x_j = K`
    Product,
    /// `x_j = K x_i`
    Quotient,
}

/// Two joints, counted from 0, and the relation between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Tie {
    /// The joint whose tangent is the parameter.
    pub first: usize,
    /// The joint whose tangent depends on it.
    pub second: usize,
    /// The relation.
    pub relation: Relation,
}

impl Tie {
    /// Returns all ties of a loop of five joints.
    fn all() -> impl Iterator<Item = Self> {
        let pairs = (0..5).flat_map(|first| (first + 1..5).map(move |second| (first, second)));
        pairs.flat_map(|(first, second)| {
            [Relation::Product, Relation::Quotient].map(|relation| Self { first, second, relation })
        })
    }

    /// Returns the tangent of the second joint.
    fn follow<F: Field>(self, x: &F, constant: &F) -> Option<F> {
        match self.relation {
            Relation::Product => Some(constant.mul(&x.inverse()?)),
            Relation::Quotient => Some(constant.mul(x)),
        }
    }

    /// Returns the joints that follow from the quadratic equation.
    fn others(self) -> [usize; 3] {
        let mut rest = (0..5).filter(|&k| k != self.first && k != self.second);
        std::array::from_fn(|_| rest.next().expect("five joints without two"))
    }

    pub(super) fn triad<F: Field>(self, links: &[Link<F>], x: &F, constant: &F) -> Option<(Vec<Turn<F>>, Triad<F>)> {
        let mut turns = vec![(F::one(), F::zero()); 5];
        turns[self.first] = half_tangent_turn(x)?;
        turns[self.second] = half_tangent_turn(&self.follow(x, constant)?)?;
        let triad = triad(links, &turns, self.others());
        Some((turns, triad))
    }

    /// Returns `(1 + x^2)(x^2 + K^2)` or `(1 + x^2)(1 + K^2 x^2)`, whose product with the square root of D is a polynomial of
    /// degree 4.
    pub(super) fn denominator<F: Field>(self, x: &F, constant: &F) -> F {
        let (square, k) = (x.mul(x), constant.mul(constant));
        let second = match self.relation {
            Relation::Product => square.add(&k),
            Relation::Quotient => F::one().add(&k.mul(&square)),
        };
        F::one().add(&square).mul(&second)
    }
}

/// A curve of spherical configurations and the lengths that close on all of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<F> {
    /// The tied joints.
    pub tie: Tie,
    /// The constant K of the tie.
    pub constant: F,
    /// A basis of the lengths that close on it, all a first, then all d; canonical, so that equal spaces have equal bases.
    pub lengths: Vec<Vec<F>>,
    /// The joints that move.
    pub moving: Vec<bool>,
    /// Joints whose axes coincide on the whole curve, for every choice of these lengths.
    pub coincident: Vec<(usize, usize)>,
    /// Some of its points: the rotation of each joint.
    pub points: Vec<Vec<Turn<F>>>,
}

impl<F> Curve<F> {
    /// Returns whether all joints move and no two axes coincide.
    #[must_use]
    pub fn is_proper(&self) -> bool {
        self.coincident.is_empty() && self.moving.iter().all(|&moves| moves)
    }
}

/// Number of points examined on a curve; seven of them determine the lengths in general.
const POINTS: usize = 16;

/// Returns the curves of one tie with constant K on which some lengths close; none if the two parts of the curve are not
/// separated over the field.
///
/// `root` gives square roots of numbers of the field.
pub fn curves<F: Field + Domain>(
    links: &[Link<F>],
    tie: Tie,
    constant: &F,
    tangents: &[F],
    root: impl Fn(&F) -> Option<F>,
) -> Vec<Curve<F>> {
    let Some(square_root) = separated(links, tie, constant, tangents, root) else { return Vec::new() };
    let branches = if square_root.is_zero() { vec![square_root] } else { vec![square_root.neg(), square_root] };
    branches.iter().filter_map(|branch| on_branch(links, tie, constant, tangents, branch)).collect()
}

/// Returns the square root of D times the denominator, as a polynomial.
pub(super) fn separated<F: Field + Domain>(
    links: &[Link<F>],
    tie: Tie,
    constant: &F,
    tangents: &[F],
    root: impl Fn(&F) -> Option<F>,
) -> Option<Univariate<F>> {
    let value = |x: &F| {
        let (_, triad) = tie.triad(links, x, constant)?;
        let denominator = tie.denominator(x, constant);
        Some((x.clone(), triad.discriminant().mul(&denominator).mul(&denominator)))
    };
    let points: Vec<(F, F)> = tangents.iter().filter_map(value).take(11).collect();
    let numerator = Univariate::interpolate(&points);
    if numerator.is_zero() {
        return Some(numerator);
    }
    // Degree 8 follows from nine of eleven points; two of them are a check.
    let degree = numerator.degree().filter(|degree| points.len() == 11 && *degree <= 8)?;
    let mut product = Univariate::constant(F::one());
    for (factor, multiplicity) in numerator.square_free_decomposition() {
        if multiplicity % 2 == 1 {
            return None;
        }
        for _ in 0..multiplicity / 2 {
            product = product.mul(&factor);
        }
    }
    let leading = |p: &Univariate<F>| p.coefficients().last().cloned();
    let top = leading(&product)?;
    let factor = leading(&numerator)?.mul(&top.mul(&top).inverse()?);
    (product.degree() == Some(degree / 2)).then(|| root(&factor)).flatten().map(|factor| product.scale(&factor))
}

fn on_branch<F: Field>(
    links: &[Link<F>],
    tie: Tie,
    constant: &F,
    tangents: &[F],
    branch: &Univariate<F>,
) -> Option<Curve<F>> {
    let point = |x: &F| {
        let (mut turns, triad) = tie.triad(links, x, constant)?;
        let root = branch.eval(x).mul(&tie.denominator(x, constant).inverse()?);
        for (joint, turn) in tie.others().into_iter().zip(triad.turns(&root)?) {
            turns[joint] = turn;
        }
        let directions = Directions::of(links, &turns);
        directions.closes().then_some((turns, directions))
    };
    let points: Vec<_> = tangents.iter().filter_map(point).take(POINTS).collect();
    if points.len() < POINTS / 2 {
        return None;
    }
    let rows: Vec<Vec<F>> = points.iter().flat_map(|(_, directions)| directions.equations()).collect();
    let lengths = canonical(Echelon::of(rows, 10).null_space());
    if lengths.is_empty() {
        return None;
    }
    let moves = |joint: usize| points.iter().any(|(turns, _)| turns[joint] != points[0].0[joint]);
    let pairs = (0..5).flat_map(|i| (i + 1..5).map(move |j| (i, j)));
    let coincide = |&(i, j): &(usize, usize)| {
        points.iter().all(|(_, directions)| lengths.iter().all(|lengths| same_axis(directions, lengths, i, j)))
    };
    Some(Curve {
        tie,
        constant: constant.clone(),
        moving: (0..5).map(moves).collect(),
        coincident: pairs.filter(coincide).collect(),
        points: points.iter().map(|(turns, _)| turns.clone()).collect(),
        lengths,
    })
}

/// Returns whether the axes i and j > i are one line.
fn same_axis<F: Ring>(directions: &Directions<F>, lengths: &[F], i: usize, j: usize) -> bool {
    let axis = &directions.axes[i];
    let parallel = |v: &Vector<F>| cross(axis, v).iter().all(Ring::is_zero);
    if !parallel(&directions.axes[j]) {
        return false;
    }
    let n = directions.axes.len();
    let mut between = vec![F::zero(); 2 * n];
    for k in i..j {
        (between[k], between[n + k]) = (lengths[k].clone(), lengths[n + k].clone());
    }
    parallel(&directions.translation(&between))
}

/// Returns the reduced echelon basis of the space that vectors span.
pub(super) fn canonical<F: Field>(mut vectors: Vec<Vec<F>>) -> Vec<Vec<F>> {
    let columns = vectors.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..vectors.len()).find(|&i| !vectors[i][column].is_zero()) else { continue };
        vectors.swap(rank, pivot);
        let Some(inverse) = vectors[rank][column].inverse() else { continue };
        let row: Vec<F> = vectors[rank].iter().map(|x| x.mul(&inverse)).collect();
        for (i, other) in vectors.iter_mut().enumerate() {
            let factor = other[column].clone();
            if i != rank && !factor.is_zero() {
                for (x, y) in other.iter_mut().zip(&row) {
                    *x = x.sub(&factor.mul(y));
                }
            }
        }
        vectors[rank] = row;
        rank += 1;
    }
    vectors.truncate(rank);
    vectors
}

/// Returns the curves of all ties and all constants K of the field of P elements other than 0.
///
/// # Panics
/// Unless there are five joints.
#[must_use]
pub fn search<const P: u64>(links: &[Link<ModP<P>>]) -> Vec<Curve<ModP<P>>> {
    assert_eq!(links.len(), 5, "five joints");
    let tangents: Vec<ModP<P>> = (1..P).map(ModP::new).collect();
    let candidates: Vec<(Tie, u64)> = Tie::all().flat_map(|tie| (1..P).map(move |k| (tie, k))).collect();
    let search = |&(tie, k): &(Tie, u64)| {
        let constant = ModP::new(k);
        if character_is_constant(links, tie, constant) {
            curves(links, tie, &constant, &tangents, |x| square_root(*x))
        } else {
            Vec::new()
        }
    };
    candidates.par_iter().flat_map_iter(search).collect()
}

/// Returns whether D is a square at all tangents at which it is not zero: almost never unless it is the square of a function.
fn character_is_constant<const P: u64>(links: &[Link<ModP<P>>], tie: Tie, constant: ModP<P>) -> bool {
    (1..P).all(|x| {
        let triad = tie.triad(links, &ModP::new(x), &constant);
        triad.is_none_or(|(_, triad)| square_root(triad.discriminant()).is_some())
    })
}

/// The primes for the search for rational constants.
const LIFTED_FROM: [u64; 3] = [479, 491, 499];

/// Returns the curves over the rationals, with rational constants K of height up to some thousands.
///
/// K is found modulo three primes and lifted, and the result is checked exactly, so every returned curve is one.
/// Twists are given by half-angle tangents.
///
/// # Panics
/// Unless there are five joints.
#[must_use]
pub fn rational_curves(twists: &[Rational]) -> Vec<Curve<Rational>> {
    assert_eq!(twists.len(), 5, "five joints");
    let mod_primes = || Some([residues::<479>(twists)?, residues::<491>(twists)?, residues::<499>(twists)?]);
    let (Some(found), Some(links)) = (mod_primes(), spherical_links(twists)) else { return Vec::new() };
    let tangents: Vec<Rational> = (1..2 * POINTS).map(|x| Rational::from((x, 3))).collect();
    let mut lifted = Vec::new();
    for tie in Tie::all() {
        let [first, second, third] =
            found.each_ref().map(|list| list.iter().filter(|(at, _)| *at == tie).map(|(_, k)| *k));
        for a in first {
            for b in second.clone() {
                for c in third.clone() {
                    let [p, q, r] = LIFTED_FROM;
                    let Some(constant) = lift::rational(&[(a, p), (b, q), (c, r)]) else { continue };
                    lifted.extend(curves(&links, tie, &constant, &tangents, rational_square_root));
                }
            }
        }
    }
    lifted
}

/// Returns the loop of these twists without lengths.
pub fn spherical_links<F: Field>(twists: &[F]) -> Option<Vec<Link<F>>> {
    let link = |t: &F| half_tangent_turn(t).map(|(cos, sin)| Link { cos, sin, a: F::zero(), d: F::zero() });
    twists.iter().map(link).collect()
}

/// Returns the ties and constants found modulo a prime; `None` for an unlucky one.
fn residues<const P: u64>(twists: &[Rational]) -> Option<Vec<(Tie, u64)>> {
    let images: Option<Vec<ModP<P>>> = twists.iter().map(ModP::from_rational).collect();
    let links = images?.into_iter().map(|t| {
        let (cos, sin) = turn(t);
        Link { cos, sin, a: ModP::zero(), d: ModP::zero() }
    });
    let found = search(&links.collect::<Vec<_>>());
    let mut list: Vec<(Tie, u64)> = found.iter().map(|curve| (curve.tie, curve.constant.value())).collect();
    list.sort_unstable();
    list.dedup();
    Some(list)
}

/// Returns a rational square root.
#[must_use]
pub fn rational_square_root(x: &Rational) -> Option<Rational> {
    let is_square = x.numer().is_perfect_square() && x.denom().is_perfect_square();
    is_square.then(|| Rational::from((x.numer().clone().sqrt(), x.denom().clone().sqrt())))
}
