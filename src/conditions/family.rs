//! The family that fitted relations define within an ansatz: some determine symbols, and one remains as the condition.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::trigonometric::{Pair, reduce};
use crate::catalogue::ansatz::{Ansatz, Meaning, Symbols, Twist};
use rug::Rational;

/// The members of an ansatz that satisfy relations.
#[derive(Clone, Debug)]
pub struct Family {
    /// The ansatz with all relations but the condition.
    pub ansatz: Ansatz,
    /// The relation that remains.
    pub condition: Option<Polynomial<Rational>>,
    /// The joint meaning of the relations between angles alone.
    pub angle: Option<String>,
}

/// Returns the family of an ansatz that satisfies relations, the simplest first; `None` if more than one of them is neither
/// linear in lengths nor an equation between two angles.
#[must_use]
pub fn family(ansatz: &Ansatz, relations: &[Polynomial<Rational>]) -> Option<Family> {
    let lengths = 3 * ansatz.symbols.angles.len();
    let has_length = |relation: &&Polynomial<Rational>| (lengths..relation.variables()).any(|k| relation.degree(k) > 0);
    let (mut others, of_angles): (Vec<_>, Vec<_>) = relations.iter().partition(has_length);
    let (mut meanings, mut angle) = (Vec::new(), None);
    if let Some((meaning, text)) = angle_equation(ansatz, &of_angles) {
        meanings.push(meaning);
        angle = Some(text);
    } else {
        others.extend(of_angles);
    }
    let condition = others.pop().cloned();
    for other in others {
        let is_linear = other.terms().all(|(exponents, _)| exponents.iter().skip(lengths).sum::<u32>() == 1);
        if !is_linear {
            return None;
        }
        meanings.push(Meaning::Polynomial(other.clone()));
    }
    let ansatz =
        if meanings.is_empty() { ansatz.clone() } else { ansatz.satisfying(meanings, Vec::new(), Vec::new())? };
    Some(Family { ansatz, condition, angle })
}

/// Returns the equation `alpha = +-beta + c`, c a multiple of a right angle, or `alpha = c`, for an unknown angle alpha, for
/// which the polynomials vanish; `None` if there is none.
fn angle_equation(ansatz: &Ansatz, relations: &[&Polynomial<Rational>]) -> Option<(Meaning, String)> {
    if relations.is_empty() {
        return None;
    }
    let count = ansatz.symbols.angles.len();
    let pairs: Vec<Pair> = (0..count).map(|k| Pair { cos: Symbols::cos(k), sin: Symbols::sin(k) }).collect();
    let symbols: Vec<_> =
        pairs.iter().map(|pair| (Polynomial::variable(pair.cos), Polynomial::variable(pair.sin))).collect();
    let constants = [(1, 0, "0"), (-1, 0, "pi"), (0, 1, "pi/2"), (0, -1, "-pi/2")];
    for &unknown in &ansatz.unknown_angles {
        let others = ansatz.free_angles().iter().copied().filter(|&k| k != unknown);
        let angles = others.flat_map(|k| [(Some(k), 1), (Some(k), -1)]).chain([(None, 1)]);
        for (other, sign) in angles {
            for (cos, sin, name) in constants {
                let mut value =
                    Twist { multiples: vec![0; count], constant: (Rational::from(cos), Rational::from(sin)) };
                if let Some(k) = other {
                    value.multiples[k] = sign;
                }
                let Some((c, s)) = value.cos_sin(&symbols) else { continue };
                let replacement = [(Symbols::cos(unknown), c), (Symbols::sin(unknown), s)];
                let vanishes = |relation: &&Polynomial<Rational>| {
                    relation.degree(Symbols::tan_half(unknown)) == 0
                        && reduce(&relation.substitute_all(&replacement), &pairs).is_zero()
                };
                if !relations.iter().all(vanishes) {
                    continue;
                }
                let names = &ansatz.symbols.angles;
                let text = match (other, sign, name) {
                    (None, ..) => format!("{} = {name}", names[unknown]),
                    (Some(k), 1, "0") => format!("{} = {}", names[unknown], names[k]),
                    (Some(k), _, "0") => format!("{} = -{}", names[unknown], names[k]),
                    (Some(k), 1, _) => format!("{} = {} + {name}", names[unknown], names[k]),
                    (Some(k), ..) => format!("{} = {name} - {}", names[unknown], names[k]),
                };
                let own = Twist::symbol(unknown, count);
                return Some((Meaning::Angle(Twist::sum([(1, &own), (-1, &value)], count)), text));
            }
        }
    }
    None
}
