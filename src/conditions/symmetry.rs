//! Loops that move because of a symmetry: patterns of lengths that move for all lengths, for patterns of twists.
//!
//! A symmetry of a loop permutes its joints and links and may change signs. The spherical configurations that have it form
//! a slice; on the slice the closure of translations is a linear condition on the lengths that have it, too. If it has
//! fewer equations than the slice has dimensions, every real closed position lies on a curve of positions.

use super::finite_field::{Turn, all_turns, random_unit, turn};
use super::spherical::Directions;
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::ModP;
use crate::algebra::ring::Ring;
use crate::catalogue::ansatz::Link;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, cross};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

/// A permutation of joints and links of order two that keeps or reverses their order round the loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Involution {
    /// Its name.
    pub name: &'static str,
    /// The image of each joint.
    pub joints: Vec<usize>,
    /// The image of each link; link k lies between joints k and k + 1.
    pub links: Vec<usize>,
}

/// Returns the involutions of a loop up to renumbering of its joints.
#[must_use]
pub fn involutions(joints: usize) -> Vec<Involution> {
    let n = joints;
    let map = |f: &dyn Fn(usize) -> usize| (0..n).map(|k| f(k) % n).collect();
    let mut found = vec![Involution {
        name: if n.is_multiple_of(2) { "mirror through two joints" } else { "mirror through a joint and a link" },
        joints: map(&|k| n - k),
        links: map(&|k| 2 * n - k - 1),
    }];
    if n.is_multiple_of(2) {
        let half_turn = map(&|k| k + n / 2);
        found.insert(0, Involution { name: "half-turn", joints: half_turn.clone(), links: half_turn });
        let (joints, links) = (map(&|k| 2 * n - k - 1), map(&|k| 2 * n - k - 2));
        found.push(Involution { name: "mirror through two links", joints, links });
    }
    found
}

/// The quantities that a symmetry negates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Signs {
    /// The angle of rotation.
    pub angle: bool,
    /// The twist.
    pub twist: bool,
    /// The length of a link.
    pub length: bool,
    /// The offset.
    pub offset: bool,
}

impl Signs {
    /// Returns all sign patterns.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..16_u8).map(|bits| Self {
            angle: bits & 8 != 0,
            twist: bits & 4 != 0,
            length: bits & 2 != 0,
            offset: bits & 1 != 0,
        })
    }
}

/// The result for the lengths of a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slice {
    /// Too few positions were found to decide.
    Few,
    /// There are at least as many conditions as dimensions.
    Isolated,
    /// Mobile for all lengths of the pattern.
    Mobile,
    /// Mobile, but axes coincide in pairs: the loop is folded back on itself.
    Folded,
}

/// A slice of the spherical configurations and the results for it.
#[derive(Clone, Debug)]
pub struct SymmetricSlice {
    /// The permutation.
    pub involution: Involution,
    /// The signs.
    pub signs: Signs,
    /// The result.
    pub slice: Slice,
    /// The dimension of the slice.
    pub dimension: usize,
    /// The number of independent conditions for the closure of translations.
    pub conditions: usize,
    /// The dimension of the space of lengths of the pattern.
    pub lengths: usize,
    /// The number of positions found.
    pub positions: usize,
}

/// Maximum number of draws from a slice.
const DRAWS: u64 = 40_000;
/// Number of positions that suffice to decide.
const ENOUGH: usize = 64;
/// Number of positions below which nothing is decided.
const FEW: usize = 6;

/// Returns all slices of a loop of n joints with random twists of each pattern, over the field of P elements.
///
/// # Panics
/// Unless there are four to six joints.
#[must_use]
pub fn slices<const P: u64>(joints: usize, seed: u64) -> Vec<SymmetricSlice> {
    use rayon::prelude::*;
    assert!((4..=6).contains(&joints), "four to six joints");
    let all: Vec<(Involution, Signs)> = involutions(joints)
        .into_iter()
        .flat_map(|involution| Signs::all().map(move |signs| (involution.clone(), signs)))
        .collect();
    let study = |(number, (involution, signs)): (usize, (Involution, Signs))| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_add(number as u64));
        Pattern::random::<P>(involution, signs, &mut rng).study(&mut rng)
    };
    all.into_par_iter().enumerate().map(study).collect()
}

/// A random draw of rotations with their closing product.
struct Pattern<const P: u64> {
    involution: Involution,
    signs: Signs,
    links: Vec<Link<ModP<P>>>,
    /// The first joint of every orbit that moves.
    orbits: Vec<usize>,
}

impl<const P: u64> Pattern<P> {
    fn sign(negative: bool) -> ModP<P> {
        if negative { ModP::one().neg() } else { ModP::one() }
    }
}

impl Pattern<3> {
    /// Returns a loop with random twists of the pattern.
    fn random<const P: u64>(involution: Involution, signs: Signs, rng: &mut ChaCha8Rng) -> Pattern<P> {
        let n = involution.links.len();
        let mut tangents = vec![ModP::<P>::zero(); n];
        for k in 0..n {
            let image = involution.links[k];
            if k == image && signs.twist {
                continue;
            }
            if k <= image {
                tangents[k] = random_unit::<P>(rng);
                tangents[image] = tangents[k].mul(&Pattern::sign(k != image && signs.twist));
            }
        }
        let links = tangents.into_iter().map(|t| {
            let (cos, sin) = turn(t);
            Link { cos, sin, a: ModP::zero(), d: ModP::zero() }
        });
        let moves = |&k: &usize| k < involution.joints[k] || (k == involution.joints[k] && !signs.angle);
        Pattern { links: links.collect(), orbits: (0..n).filter(moves).collect(), signs, involution }
    }
}

impl<const P: u64> Pattern<P> {
    /// Returns a basis of the lengths of the pattern, all a first, then all d.
    fn lengths(&self) -> Vec<Vec<ModP<P>>> {
        let n = self.links.len();
        let parts = [(0, &self.involution.links, self.signs.length), (n, &self.involution.joints, self.signs.offset)];
        let mut basis = Vec::new();
        for (start, map, negative) in parts {
            for k in 0..n {
                if k < map[k] || (k == map[k] && !negative) {
                    let mut vector = vec![ModP::zero(); 2 * n];
                    vector[start + k] = ModP::one();
                    if k != map[k] {
                        vector[start + map[k]] = Self::sign(negative);
                    }
                    basis.push(vector);
                }
            }
        }
        basis
    }

    fn study(self, rng: &mut ChaCha8Rng) -> SymmetricSlice {
        let basis = self.lengths();
        let positions = self.positions(rng);
        // Components may have different dimensions, and positions may be special; a result counts if a quarter of positions has it.
        let mut met: BTreeMap<(usize, usize, bool), usize> = BTreeMap::new();
        for turns in &positions {
            *met.entry(self.at(turns, &basis)).or_default() += 1;
        }
        let common = met.into_iter().filter(|(_, count)| 4 * count >= positions.len()).map(|(key, _)| key);
        let best = common.max_by_key(|&(dimension, conditions, _)| (dimension + 3 - conditions, dimension));
        let (dimension, conditions, folded) = best.unwrap_or_default();
        let slice = if positions.len() < FEW {
            Slice::Few
        } else if dimension <= conditions || basis.is_empty() {
            Slice::Isolated
        } else if folded {
            Slice::Folded
        } else {
            Slice::Mobile
        };
        SymmetricSlice {
            slice,
            dimension,
            conditions,
            lengths: basis.len(),
            positions: positions.len(),
            involution: self.involution,
            signs: self.signs,
        }
    }

    /// Returns the dimension of the slice at a position, the number of conditions there, and whether the axes coincide in pairs.
    fn at(&self, turns: &[Turn<ModP<P>>], basis: &[Vec<ModP<P>>]) -> (usize, usize, bool) {
        let directions = Directions::of(&self.links, turns);
        let rows: Vec<Vec<ModP<P>>> = basis.iter().map(|lengths| directions.translation(lengths).to_vec()).collect();
        let velocity = |&k: &usize| -> Vec<ModP<P>> {
            let image = self.involution.joints[k];
            let sign = Self::sign(self.signs.angle);
            let own = &directions.axes[k];
            (0..3)
                .map(|i| if image == k { own[i] } else { own[i].add(&sign.mul(&directions.axes[image][i])) })
                .collect()
        };
        let velocities: Vec<Vec<ModP<P>>> = self.orbits.iter().map(velocity).collect();
        let rank = |rows: &[Vec<ModP<P>>]| Echelon::of(rows.to_vec(), 3).rank();
        let parallel = |k: usize| {
            let image: &Vector<ModP<P>> = &directions.axes[self.involution.joints[k]];
            cross(&directions.axes[k], image).iter().all(Ring::is_zero)
        };
        (self.orbits.len() - rank(&velocities), rank(&rows), (0..self.links.len()).all(parallel))
    }

    /// Returns positions of the slice: all if they can be enumerated, else those among random rotations.
    fn positions(&self, rng: &mut ChaCha8Rng) -> Vec<Vec<Turn<ModP<P>>>> {
        let all = all_turns::<P>();
        let zero = ModP::zero();
        let half_turns = all.iter().map(half_turn).collect::<Vec<_>>();
        let links = self.links.iter().map(|link| {
            let (c, s) = half_turn(&(link.cos, link.sin));
            Quaternion { scalar: c, vector: [s, zero, zero] }
        });
        let links: Vec<Quaternion<ModP<P>>> = links.collect();
        let choices = (P + 1).checked_pow(u32::try_from(self.orbits.len()).unwrap_or(u32::MAX)).unwrap_or(u64::MAX);
        let mut numbers = vec![0_usize; self.links.len()];
        let mut found = Vec::new();
        for draw in 0..choices.min(DRAWS) {
            let mut digits = if choices <= DRAWS { draw } else { rng.random_range(0..choices) };
            for &k in &self.orbits {
                let number = digits % (P + 1);
                digits /= P + 1;
                // Tangents 0 and infinity are their own negatives.
                let negative = if number == 0 || number == P { number } else { P - number };
                let image = if self.signs.angle { negative } else { number };
                let index = |number: u64| usize::try_from(number).unwrap_or(0);
                (numbers[k], numbers[self.involution.joints[k]]) = (index(number), index(image));
            }
            let product = numbers.iter().zip(&links).fold(Quaternion::identity(), |product, (&number, link)| {
                let (c, s) = half_turns[number];
                product.mul(&Quaternion { scalar: c, vector: [zero, zero, s] }).mul(link)
            });
            if product.vector.iter().all(Ring::is_zero) {
                found.push(numbers.iter().map(|&number| all[number]).collect());
                if found.len() == ENOUGH && choices > DRAWS {
                    break;
                }
            }
        }
        found
    }
}

/// Returns cosine and sine of half the angle, up to a factor.
fn half_turn<const P: u64>((cos, sin): &Turn<ModP<P>>) -> Turn<ModP<P>> {
    let cos = cos.add(&ModP::one());
    if cos.is_zero() { (ModP::zero(), ModP::one()) } else { (cos, *sin) }
}
