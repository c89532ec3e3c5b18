//! Mobility of a family by a multiplier: a direction along which the translations close by themselves.
//!
//! In a spherical configuration of a 6R loop with axes `z_i`, let `w = sum_ij omega_ij z_i x z_j` with numbers omega. If
//! `w . t = 0` for the closing translation `t = sum_k a_k x_k + d_k z_k` of all members of the family, then only two of the three
//! equations t = 0 remain wherever w is not 0, for the three degrees of freedom of the spherical loop. So every real
//! closed position of screw rank 5 in which w is not 0 and the axes span the space lies on a curve of positions.
//! With `x_k = z_k x z_(k+1) / sin(alpha_k)` all products are polynomials in the cosines between axes and the triple
//! products of axes, so that the identity is expanded for all parameters at once (docs/conditions_search.md).

use super::curve_ansatz::canonical;
use super::finite_field::{half_tangent_turn, square_root};
use super::spherical::{Directions, closed_by};
use crate::algebra::echelon::Echelon;
use crate::algebra::lift;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::catalogue::ansatz::{Ansatz, Symbols};
use crate::kinematics::motion::{cross, dot};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// A multiplier with the identity that proves mobility.
#[derive(Clone, Debug, PartialEq)]
pub struct Multiplier {
    /// The terms `omega_ij z_i x z_j` of w: axes i < j, counted from 0, and the number.
    pub terms: Vec<(usize, usize, Rational)>,
    /// The number of terms of `w . t`, times the sines of all twists, before division by the relation.
    pub size: usize,
}

type Symbol = Polynomial<Rational>;
type Image = ModP<PRIME_61>;

/// Returns the pairs of axes.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)))
}

/// Returns a multiplier for the members of an ansatz that satisfy a relation, or for all of them if there is none. It is sought
/// modulo a prime and proved by expansion. `None` if there is no multiplier, or if the relation is not linear in any length.
///
/// # Panics
/// Unless there are six joints.
#[must_use]
pub fn multiplier(ansatz: &Ansatz, relation: Option<&Polynomial<Rational>>, seed: u64) -> Option<Multiplier> {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    // Symbols determined by relations of the file would have to be replaced first.
    let (angles, lengths) = (&ansatz.symbols.angles, &ansatz.symbols.lengths);
    if ansatz.free_angles().len() < angles.len() || ansatz.free_lengths().len() < lengths.len() {
        return None;
    }
    let candidates = candidates(ansatz, relation, seed)?;
    candidates.into_iter().find_map(|omega| {
        let rational: Vec<Rational> =
            omega.iter().map(|x| lift::rational(&[(x.value(), PRIME_61)])).collect::<Option<_>>()?;
        let size = expanded(ansatz, relation, &rational)?;
        let terms = pairs().zip(rational).filter(|(_, x)| !x.is_zero()).map(|((i, j), x)| (i, j, x)).collect();
        Some(Multiplier { terms, size })
    })
}

/// Returns the multipliers that annihilate the translations of random members in random spherical configurations, and are
/// not zero in all of these.
fn candidates(ansatz: &Ansatz, relation: Option<&Polynomial<Rational>>, seed: u64) -> Option<Vec<Vec<Image>>> {
    // The relation is solved for a length in which it is linear, if possible an unknown one.
    let is_linear = |k: &usize| relation.is_none_or(|relation| relation.degree(ansatz.symbols.length(*k)) == 1);
    let free = ansatz.free_lengths();
    let place = ansatz.unknown.iter().copied().chain(free.iter().copied()).find(is_linear)?;
    let members = ansatz.over::<Image>()?;
    let relation = match relation {
        Some(relation) => Some(relation.map(ModP::from_rational)?),
        None => None,
    };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (mut rows, mut products): (Vec<Vec<Image>>, Vec<Vec<[Image; 3]>>) = (Vec::new(), Vec::new());
    for _ in 0..400 {
        if rows.len() == 40 {
            break;
        }
        let mut random = || Image::new(rng.random_range(1..PRIME_61));
        let tangents: Vec<Image> = ansatz.free_angles().iter().map(|_| random()).collect();
        let mut lengths: Vec<Image> = free.iter().map(|_| random()).collect();
        let three = [random(), random(), random()];
        if let Some(relation) = &relation {
            let mut at = |value: Image| {
                lengths[place] = value;
                members.values(&tangents, &lengths)
            };
            let (Some(zero), Some(one)) = (at(Image::zero()), at(Image::one())) else { continue };
            let constant = relation.evaluate(&zero);
            let slope = relation.evaluate(&one).sub(&constant);
            let Some(root) = slope.inverse().map(|inverse| constant.neg().mul(&inverse)) else { continue };
            lengths[place] = root;
        }
        let values = members.values(&tangents, &lengths);
        let Some(links) = values.and_then(|values| members.links(&values)) else { continue };
        let mut turns = vec![(Image::one(), Image::zero()); 6];
        for (joint, t) in three.iter().enumerate() {
            if let Some(turn) = half_tangent_turn(t) {
                turns[joint] = turn;
            }
        }
        let Some(turns) = closed_by(&links, &turns, [3, 4, 5], |x| square_root(*x)).pop() else { continue };
        let directions = Directions::of(&links, &turns);
        let own: Vec<Image> = links.iter().map(|link| link.a).chain(links.iter().map(|link| link.d)).collect();
        let translation = directions.translation(&own);
        products.push(pairs().map(|(i, j)| cross(&directions.axes[i], &directions.axes[j])).collect());
        rows.push(products[rows.len()].iter().map(|product| dot(product, &translation)).collect());
    }
    let vanishes = |omega: &[Image]| {
        let component = |product: &Vec<[Image; 3]>, i: usize| {
            product.iter().zip(omega).fold(Image::zero(), |sum, (vector, x)| sum.add(&vector[i].mul(x)))
        };
        products.iter().all(|product| (0..3).all(|i| component(product, i).is_zero()))
    };
    let mut space = canonical(Echelon::of(rows, 15).null_space());
    space.retain(|omega| !vanishes(omega));
    (products.len() == 40).then_some(space)
}

/// Cosines between axes and triple products of axes as further variables of the polynomials.
struct Axes {
    /// The number of variables of the ansatz.
    first: usize,
    /// Cosine and sine of each twist.
    twists: Vec<(Symbol, Symbol)>,
}

impl Axes {
    /// Returns `z_i . z_j`.
    fn cosine(&self, i: usize, j: usize) -> Symbol {
        let (i, j) = (i.min(j), i.max(j));
        match (i, j) {
            _ if i == j => Symbol::one(),
            (0, 5) => self.twists[5].0.clone(),
            _ if j == i + 1 => self.twists[i].0.clone(),
            _ => Symbol::variable(self.first + 6 * i + j),
        }
    }

    /// Returns `(z_i x z_j) . z_k`.
    fn triple(&self, i: usize, j: usize, k: usize) -> Symbol {
        let mut axes = [i, j, k];
        axes.sort_unstable();
        if axes[0] == axes[1] || axes[1] == axes[2] {
            return Symbol::zero();
        }
        let variable = Symbol::variable(self.first + 36 + 36 * axes[0] + 6 * axes[1] + axes[2]);
        let inversions = usize::from(i > j) + usize::from(i > k) + usize::from(j > k);
        if inversions % 2 == 1 { variable.neg() } else { variable }
    }

    /// Returns `(z_i x z_j) . (z_k x z_l)`.
    fn quadruple(&self, i: usize, j: usize, k: usize, l: usize) -> Symbol {
        self.cosine(i, k).mul(&self.cosine(j, l)).sub(&self.cosine(i, l).mul(&self.cosine(j, k)))
    }
}

/// Returns the number of terms of `w . t` times the sines of the twists, if it is a multiple of the relation (or zero
/// without one); `None` if it is not.
fn expanded(ansatz: &Ansatz, relation: Option<&Polynomial<Rational>>, omega: &[Rational]) -> Option<usize> {
    let angles: Vec<(Symbol, Symbol)> = (0..ansatz.symbols.angles.len())
        .map(|k| (Symbol::variable(Symbols::cos(k)), Symbol::variable(Symbols::sin(k))))
        .collect();
    let twists = ansatz.joints.iter().map(|joint| joint.alpha.cos_sin(&angles)).collect::<Option<_>>()?;
    let axes = Axes { first: ansatz.symbols.names().list().len(), twists };
    let mut translation = Symbol::zero();
    let product_of_sines = |without: Option<usize>| {
        let sines = axes.twists.iter().enumerate().filter(|(k, _)| Some(*k) != without).map(|(_, (_, sin))| sin);
        sines.fold(Symbol::one(), |product, sin| product.mul(sin))
    };
    let all = product_of_sines(None);
    for ((i, j), factor) in pairs().zip(omega).filter(|(_, factor)| !factor.is_zero()) {
        for (k, joint) in ansatz.joints.iter().enumerate() {
            let along = joint.a.mul(&product_of_sines(Some(k))).mul(&axes.quadruple(i, j, k, (k + 1) % 6));
            let offset = joint.d.mul(&all).mul(&axes.triple(i, j, k));
            translation = translation.add(&along.add(&offset).scale(factor));
        }
    }
    match relation {
        None => translation.is_zero().then_some(0),
        Some(relation) => {
            translation.checked_div_exact(relation)?;
            (!translation.is_zero()).then_some(translation.len())
        }
    }
}
