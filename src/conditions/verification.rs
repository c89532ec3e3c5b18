//! Tests of a relation that a sweep found: a member with an exact position that is proved mobile, and closed positions that
//! all satisfy the relation.

use super::curve_ansatz::rational_square_root;
use super::finite_field::{Turn, half_tangent_turn, square_root};
use super::spherical::{Directions, closed_by, triad};
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::{ModP, PRIME_61, PRIME_62};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::ansatz::{Ansatz, Link, Members};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::mobility::{Germ, Linkage, Local, Positions, positions};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// Returns the set of positions near one position of a loop, as power series.
#[must_use]
pub fn germ<F: Field>(links: &[Link<F>], turns: &[Turn<F>]) -> Germ<F> {
    let values: Vec<[F; 2]> = turns.iter().map(|(cos, sin)| half(cos, sin)).collect();
    Germ::of(&linkage(links).at(&values))
}

/// Returns cosine and sine of half an angle, up to a factor.
fn half<F: Field>(cos: &F, sin: &F) -> [F; 2] {
    let cos = cos.add(&F::one());
    if cos.is_zero() { [F::zero(), F::one()] } else { [cos, sin.clone()] }
}

/// Returns the loop of revolute joints with these links.
fn linkage<F: Field>(links: &[Link<F>]) -> Linkage<F> {
    let link = |link: &Link<F>| {
        let [c, s] = half(&link.cos, &link.sin);
        let translation = DualQuaternion::translation(&[link.a.clone(), F::zero(), link.d.clone()]);
        translation.mul(&DualQuaternion::rotation_x(c, s))
    };
    Linkage::about_z(vec![Variable::Rotation; links.len()], links.iter().map(link).collect())
}

/// Counts of closed positions of random members of an ansatz, tested for a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Closed {
    /// Number of closed positions found.
    pub positions: usize,
    /// Number of those whose members satisfy the relations.
    pub satisfied: usize,
}

/// Tests random closed positions over the field of `2^61 - 1` elements: do their members satisfy the relations?
///
/// The six closure equations of a 6R loop define a set of positions and members of an ansatz of N parameters, every component
/// of which has dimension at least N. If all its members satisfy a relation, they are of dimension at most N - 1, and every
/// closed position belongs to positions of dimension at least 1, so mobility follows from closure. A position is drawn with
/// three rotations and all twists at random, and lengths at random among those that close there.
///
/// The relation is a polynomial of a degree below 200 at points of a variety parametrised by the draws. If it did not
/// vanish on the variety, one draw would show it except with a probability below `2^-50`. That bound holds for linear relations;
/// if others determine symbols, nothing is drawn.
///
/// # Panics
/// Unless there are six joints.
#[must_use]
pub fn closed_positions(
    ansatz: &Ansatz,
    relations: &[Polynomial<Rational>],
    draws: usize,
    seed: u64,
) -> Option<Closed> {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    if ansatz.has_solved_symbols() {
        return None;
    }
    let members = ansatz.over::<ModP<PRIME_61>>()?;
    let images: Vec<Polynomial<ModP<PRIME_61>>> =
        relations.iter().map(|relation| relation.map(ModP::from_rational)).collect::<Option<_>>()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut closed = Closed { positions: 0, satisfied: 0 };
    for _ in 0..8 * draws {
        if closed.positions == draws {
            break;
        }
        let mut random = || ModP::<PRIME_61>::new(rng.random_range(1..PRIME_61));
        let tangents: Vec<_> = ansatz.free_angles().iter().map(|_| random()).collect();
        let three = [random(), random(), random()];
        let weights: Vec<_> = ansatz.free_lengths().iter().map(|_| random()).collect();
        let Some(ClosingMember { values, .. }) =
            closing_member(&members, ansatz, &[], (&tangents, &three, &weights), |x| square_root(*x))
        else {
            continue;
        };
        closed.positions += 1;
        closed.satisfied += usize::from(images.iter().all(|relation| relation.evaluate(&values).is_zero()));
    }
    Some(closed)
}

/// The joints whose rotations are chosen; the others follow.
const CHOSEN: [usize; 3] = [0, 1, 3];
const FOLLOWING: [usize; 3] = [2, 4, 5];

/// A member with a closed position.
struct ClosingMember<F> {
    /// The values of its symbols.
    values: Vec<F>,
    turns: Vec<Turn<F>>,
    /// Whether such members are general among those that satisfy the relations, if each has a curve of such positions.
    is_general: bool,
}

/// Returns a member of given twists that closes in a position with given half-angle tangents of three joints: the values of
/// its symbols, and its rotations. Its free lengths combine, with the given weights, those that close and satisfy the linear
/// relations. `None` if there is none over the field.
fn closing_member<F: Field>(
    members: &Members<'_, F>,
    ansatz: &Ansatz,
    relations: &[Polynomial<F>],
    (tangents, chosen, weights): (&[F], &[F; 3], &[F]),
    root: impl Fn(&F) -> Option<F>,
) -> Option<ClosingMember<F>> {
    let count = ansatz.free_lengths().len();
    let at = |lengths: &[F]| members.values(tangents, lengths);
    let mut turns = vec![(F::one(), F::zero()); 6];
    for (joint, t) in CHOSEN.into_iter().zip(chosen) {
        turns[joint] = half_tangent_turn(t)?;
    }
    let zero = vec![F::zero(); count];
    let origin = members.links(&at(&zero)?)?;
    let turns = closed_by(&origin, &turns, FOLLOWING, root).pop()?;
    let directions = Directions::of(&origin, &turns);
    let translation = |lengths: &[F]| {
        let links = members.links(&at(lengths)?)?;
        let own: Vec<F> =
            links.iter().map(|link| link.a.clone()).chain(links.iter().map(|link| link.d.clone())).collect();
        Some(directions.translation(&own))
    };
    let linear: Vec<&Polynomial<F>> = relations.iter().filter(|relation| is_linear(ansatz, relation)).collect();
    let equations = |lengths: &[F]| {
        let values = at(lengths)?;
        let relations = linear.iter().map(|relation| relation.evaluate(&values));
        Some(translation(lengths)?.into_iter().chain(relations).collect::<Vec<F>>())
    };
    // The equations are affine in the lengths: one column for every length, the last for the constant.
    let constant = equations(&zero)?;
    let mut columns = Vec::new();
    for k in 0..count {
        let mut unit = zero.clone();
        unit[k] = F::one();
        columns.push(equations(&unit)?.iter().zip(&constant).map(|(x, c)| x.sub(c)).collect::<Vec<F>>());
    }
    columns.push(constant);
    let row = |i: usize| columns.iter().map(|column| column[i].clone()).collect::<Vec<F>>();
    let rows: Vec<Vec<F>> = (0..3 + linear.len()).map(row).collect();
    // Three rotations and the closing lengths, without the curve through each, have as many parameters as the members.
    let own = |row: &Vec<F>| row[..count].to_vec();
    let closing = Echelon::of(rows.iter().map(own).collect(), count).rank();
    let related = Echelon::of(rows[3..].iter().map(own).collect(), count).rank() + relations.len() - linear.len();
    let is_general = closing <= related + 2;
    let mut lengths = vec![F::zero(); count + 1];
    for (vector, weight) in Echelon::of(rows, count + 1).null_space().iter().zip(weights) {
        for (total, x) in lengths.iter_mut().zip(vector) {
            total.add_product(weight, x);
        }
    }
    let scale = lengths.pop()?;
    if lengths.iter().all(F::is_zero) {
        return None;
    }
    if columns[count].iter().any(|c| !c.is_zero()) {
        let inverse = scale.inverse()?;
        for length in &mut lengths {
            *length = length.mul(&inverse);
        }
    }
    let values = at(&lengths)?;
    Some(ClosingMember { values, turns, is_general })
}

/// Returns whether a polynomial is linear in the lengths.
fn is_linear<F: Field>(ansatz: &Ansatz, polynomial: &Polynomial<F>) -> bool {
    let first = ansatz.symbols.length(0);
    polynomial.terms().all(|(exponents, _)| exponents.iter().skip(first).sum::<u32>() <= 1)
}

/// Random members with a closed position over prime fields, and the number of them that the order test finds mobile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModularMembers {
    /// Number of members with a position of screw rank 5.
    pub members: usize,
    /// Number of those with a curve of positions there.
    pub mobile: usize,
}

impl ModularMembers {
    /// Returns whether all of them move.
    #[must_use]
    pub const fn all_move(&self) -> bool {
        self.members > 0 && self.members == self.mobile
    }
}

/// Applies the order test to random members that satisfy the relations, over the fields of `2^61 - 1` and `2^62 - 57` elements.
///
/// The coefficients of orders up to 16 of the reduced closure equations are algebraic functions of the draws, of a degree
/// below `2^21` (docs/conditions_search.md). If general members did not move, one of these functions would not vanish, and a
/// random draw over the field of p elements would be a zero of it with a probability below `2^21 / p < 2^-39`. Draws are as
/// in [`closed_positions`]; relations that are not linear in the lengths are left to chance. Draws whose members are not
/// general, by a count of dimensions, do not count. The degrees are those of linear relations; if others determine symbols, no
/// member is drawn.
///
/// # Panics
/// Unless there are six joints.
#[must_use]
pub fn modular_members(ansatz: &Ansatz, relations: &[Polynomial<Rational>], draws: usize, seed: u64) -> ModularMembers {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    if ansatz.has_solved_symbols() {
        return ModularMembers { members: 0, mobile: 0 };
    }
    let one = modular::<PRIME_61>(ansatz, relations, draws, seed);
    let other = modular::<PRIME_62>(ansatz, relations, draws, seed);
    // An unlucky prime, or the lack of members, is no evidence.
    let found = [one, other].map(Option::unwrap_or_default);
    if found.iter().any(|&[members, _]| members == 0) {
        return ModularMembers { members: 0, mobile: 0 };
    }
    ModularMembers { members: found[0][0] + found[1][0], mobile: found[0][1] + found[1][1] }
}

/// Counts members of screw rank 5 in the draws, and those of them that move.
fn modular<const P: u64>(
    ansatz: &Ansatz,
    relations: &[Polynomial<Rational>],
    draws: usize,
    seed: u64,
) -> Option<[usize; 2]> {
    let members = ansatz.over::<ModP<P>>()?;
    let images: Vec<Polynomial<ModP<P>>> =
        relations.iter().map(|relation| relation.map(ModP::from_rational)).collect::<Option<_>>()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut found = [0, 0];
    for _ in 0..8 * draws {
        if found[0] == draws {
            break;
        }
        let mut random = || ModP::<P>::new(rng.random_range(1..P));
        let tangents: Vec<_> = ansatz.free_angles().iter().map(|_| random()).collect();
        let three = [random(), random(), random()];
        let weights: Vec<_> = ansatz.free_lengths().iter().map(|_| random()).collect();
        let draw = (&*tangents, &three, &*weights);
        let found_one = closing_member(&members, ansatz, &images, draw, |x| square_root(*x));
        let Some(ClosingMember { values, turns, is_general: true }) = found_one else { continue };
        if images.iter().any(|relation| !relation.evaluate(&values).is_zero()) {
            continue;
        }
        let Some(links) = members.links(&values) else { continue };
        let germ = germ(&links, &turns);
        if germ.rank == 5 {
            found = [found[0] + 1, found[1] + usize::from(germ.local == Local::Curve)];
        }
    }
    Some(found)
}

/// A member over the rationals with an exact position.
#[derive(Clone, Debug)]
pub struct RationalMember {
    /// The loop.
    pub links: Vec<Link<Rational>>,
    /// The rotations of its joints.
    pub turns: Vec<Turn<Rational>>,
    /// The set of positions near that one.
    pub germ: Germ<Rational>,
}

/// Half-angle tangents of the exact search. They are small, so that a discriminant is sometimes a square, and no two belong
/// to equal or opposite angles, even modulo pi.
const TANGENTS: [(i32, i32); 10] = [(1, 2), (1, 3), (2, 3), (1, 4), (3, 4), (1, 5), (2, 5), (3, 5), (4, 5), (1, 7)];

/// Number of these tangents from which the rotations are taken.
const ROTATIONS: usize = 3;

/// Number of positions of screw rank 6 after which no position of lower rank is expected.
const RIGID: usize = 60;

/// Returns a member of an ansatz of a 6R loop that satisfies the relations, with an exact position, both over the
/// rationals: the first of screw rank 5, or else one of rank 6; `None` if the search finds none in `draws` draws.
///
/// Twists and three rotations are drawn. If the discriminant of the other three is the square of a rational number, the
/// position is exact, and lengths that close in it are the solutions of linear equations.
///
/// # Panics
/// Unless there are six joints.
#[must_use]
pub fn rational_member(
    ansatz: &Ansatz,
    relations: &[Polynomial<Rational>],
    draws: usize,
    seed: u64,
) -> Option<RationalMember> {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    if ansatz.has_solved_symbols() {
        return None;
    }
    let members = ansatz.over::<Rational>()?;
    let modular = ansatz.over::<ModP<PRIME_61>>()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut order = ChaCha8Rng::seed_from_u64(seed.wrapping_add(1));
    let free = ansatz.free_lengths().len();
    let mut rigid = Vec::new();
    for _ in 0..draws {
        let mut random = |place: usize| {
            let tangent = Rational::from(TANGENTS[place]);
            let tangent = if rng.random() { tangent } else { tangent.recip() };
            if rng.random() { tangent } else { -tangent }
        };
        // The twists are different, so that the member is not special.
        let places = rand::seq::index::sample(&mut order, TANGENTS.len(), TANGENTS.len()).into_vec();
        let tangents: Vec<_> = (0..ansatz.free_angles().len()).map(|k| random(places[k % TANGENTS.len()])).collect();
        let chosen = [0, 1, 2].map(|k| random(places[TANGENTS.len() - 1 - k] % ROTATIONS));
        if !may_be_square(&modular, free, &tangents, &chosen) {
            continue;
        }
        let weights: Vec<_> = (0..free).map(|_| Rational::from(rng.random_range(1..9))).collect();
        let found = closing_member(&members, ansatz, relations, (&tangents, &chosen, &weights), rational_square_root);
        let Some(ClosingMember { values, turns, .. }) = found else { continue };
        if relations.iter().any(|relation| !relation.evaluate(&values).is_zero()) {
            continue;
        }
        let Some(links) = members.links(&values) else { continue };
        let germ = germ(&links, &turns);
        match germ.rank {
            5 => return Some(RationalMember { links, turns, germ }),
            6 => rigid.push(RationalMember { links, turns, germ }),
            _ => {}
        }
        if rigid.len() == RIGID {
            break;
        }
    }
    rigid.pop()
}

/// Number of rational members examined with a joint held.
const HELD: usize = 24;
/// Number of draws in the search for such members.
const DRAWN: usize = 20_000;

/// Returns a member of an ansatz without further conditions with an exact position of screw rank 5 that lies on a curve.
/// Random members are held at rational values of their first joint, and their positions found exactly. `None` if no position
/// found is rational.
///
/// # Panics
/// Unless there are six joints.
#[must_use]
pub fn held_member(ansatz: &Ansatz, seed: u64) -> Option<RationalMember> {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    let members = ansatz.with_roots::<Rational>(rational_square_root)?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut looked_at = 0;
    for _ in 0..DRAWN {
        if looked_at == HELD {
            break;
        }
        let places = rand::seq::index::sample(&mut rng, TANGENTS.len(), TANGENTS.len()).into_vec();
        let tangents: Vec<Rational> =
            (0..ansatz.free_angles().len()).map(|k| Rational::from(TANGENTS[places[k % TANGENTS.len()]])).collect();
        let lengths: Vec<Rational> =
            ansatz.free_lengths().iter().map(|_| Rational::from(rng.random_range(1..9))).collect();
        // Required square roots are seldom rational.
        let Some(links) = members.member(&tangents, &lengths) else { continue };
        looked_at += 1;
        for tangent in &TANGENTS[..ROTATIONS] {
            let held = [Rational::from(1), Rational::from(*tangent)];
            let Positions::Finite { found, .. } = positions(&linkage(&links).locked(&[(0, held.clone())])) else {
                continue;
            };
            for position in found.iter().filter(|position| position.polynomial.is_none()) {
                let rest = position.values.iter().map(|[c, s]| Some([c.rational()?, s.rational()?]));
                let Some(values) = std::iter::once(Some(held.clone())).chain(rest).collect::<Option<Vec<_>>>() else {
                    continue;
                };
                let turns: Vec<Turn<Rational>> = values.iter().map(|[c, s]| whole(c, s)).collect();
                let germ = germ(&links, &turns);
                if germ.rank == 5 && germ.local == Local::Curve {
                    return Some(RationalMember { links, turns, germ });
                }
            }
        }
    }
    None
}

/// Returns cosine and sine of an angle from those of its half, up to a factor.
fn whole(c: &Rational, s: &Rational) -> Turn<Rational> {
    let (cc, ss) = (Rational::from(c.square_ref()), Rational::from(s.square_ref()));
    let norm = Rational::from(&cc + &ss);
    ((cc - ss) / &norm, Rational::from(c * s) * 2 / norm)
}

/// Returns whether the discriminant is a square modulo a prime, which is necessary. This rejects half of the others without
/// large numbers.
fn may_be_square(
    members: &Members<'_, ModP<PRIME_61>>,
    free: usize,
    tangents: &[Rational],
    chosen: &[Rational; 3],
) -> bool {
    let image = |list: &[Rational]| list.iter().map(ModP::from_rational).collect::<Option<Vec<_>>>();
    let discriminant = || {
        let links = members.links(&members.values(&image(tangents)?, &vec![ModP::zero(); free])?)?;
        let mut turns = vec![(ModP::one(), ModP::zero()); 6];
        for (joint, t) in CHOSEN.into_iter().zip(image(chosen)?) {
            turns[joint] = half_tangent_turn(&t)?;
        }
        Some(triad(&links, &turns, FOLLOWING).discriminant())
    };
    discriminant().is_some_and(|d| square_root(d).is_some())
}
