//! No other solutions of a linkage in the plane, by a matrix of its equations times monomials: theorem 13 of docs/certificate.md.

use super::enclosing::Enclosing;
use super::fault::{Fault, refused};
use super::isolation::Longer;
use super::linkage::{LinkageClosure, UNKNOWNS, eliminated, exponents, modulo};
use super::mode::Ball;
use super::record::{count, fields};
use crate::algebra::ring::Ring;
use rug::Float;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};

/// The kind of the item.
pub(super) const KIND: &str = "kernel";
/// 2^31 - 19, a prime that is 1 modulo 4 and 5 modulo 8: 2 is no square modulo it.
const PRIME: u32 = 2_147_483_629;
/// Maximum number of monomials that are accepted.
const MOST_COLUMNS: usize = 3000;
/// Maximum number of monomials that are tried: linkages of three loops need 583.
const MOST_TRIED: usize = 1600;
/// The bounds of exponents that are tried in turn: of the sum of positive ones, of that of negative ones, of each.
const BOUNDS: [(usize, usize, usize); 6] = [(1, 1, 1), (2, 2, 1), (3, 2, 1), (3, 3, 1), (2, 2, 2), (3, 3, 2)];

/// Exponents of all unknowns.
type Monomial = [i8; UNKNOWNS];
/// An equation modulo the prime.
type Equation = Vec<(Monomial, u64)>;

/// Largest bound of exponents, so that those of products fit in a byte. Proofs need 2 or 3.
const MOST_EXPONENT: usize = 60;

/// A choice of monomials.
#[derive(Clone, Copy)]
struct Choice {
    up: usize,
    down: usize,
    each: usize,
    slides: usize,
}

impl Choice {
    /// Adds the monomials that begin with these exponents; one more than are accepted is enough.
    fn extend(self, closure: &LinkageClosure, start: Monomial, at: usize, found: &mut Vec<Monomial>) {
        if found.len() > MOST_COLUMNS {
            return;
        }
        if at == closure.size() {
            found.push(start);
            return;
        }
        let small = |x: usize| i8::try_from(x).unwrap_or(i8::MAX);
        let is_turn = at + 1 < closure.classes;
        let (least, most) = if is_turn {
            (-small(self.down.min(self.each)), small(self.up.min(self.each)))
        } else {
            (0, small(self.slides))
        };
        for own in least..=most {
            let size = usize::from(own.unsigned_abs());
            let rest = match (is_turn, own > 0) {
                (false, _) => Self { slides: self.slides - size, ..self },
                (true, true) => Self { up: self.up - size, ..self },
                (true, false) => Self { down: self.down - size, ..self },
            };
            let mut next = start;
            next[at] = own;
            rest.extend(closure, next, at + 1, found);
        }
    }

    fn monomials(self, closure: &LinkageClosure) -> Vec<Monomial> {
        let mut found = Vec::new();
        self.extend(closure, [0; UNKNOWNS], 0, &mut found);
        found
    }
}

fn times(a: u64, b: u64) -> u64 {
    a * b % u64::from(PRIME)
}

fn power(mut base: u64, mut exponent: u32) -> u64 {
    let mut product = 1;
    while exponent > 0 {
        if exponent % 2 == 1 {
            product = times(product, base);
        }
        base = times(base, base);
        exponent /= 2;
    }
    product
}

/// Returns the combinations of the equations of the loops with fewest columns, and their mirror images; `None` where loops depend on each
/// other, or where a denominator is divisible by the prime.
fn shortest(closure: &LinkageClosure) -> Option<Vec<Equation>> {
    let loops = closure.loops.len();
    let columns = closure.classes + closure.slides.len();
    let root = power(2, (PRIME - 1) / 4);
    let mut found: HashMap<Vec<usize>, [Equation; 2]> = HashMap::new();
    for set in (0..1_u32 << columns).filter(|set| set.count_ones() as usize + 1 == loops) {
        let mut order: Vec<usize> = (0..columns).collect();
        order.sort_by_key(|column| (set >> column) & 1 == 0);
        let (rows, pivots) = eliminated(&closure.loops, &order);
        if pivots.len() < loops {
            return None;
        }
        // Where the columns that are gone depend on each other, others take their place.
        if pivots.iter().take(loops - 1).any(|place| *place + 1 >= loops) {
            continue;
        }
        let last = rows.last()?;
        let support: Vec<usize> = (0..columns).filter(|column| !last[*column].is_zero()).collect();
        let mut pair = [Vec::new(), Vec::new()];
        for &column in &support {
            let (re, im) = (modulo(&last[column].re, PRIME)?, times(root, modulo(&last[column].im, PRIME)?));
            let own = exponents(closure, column);
            let mirrored = std::array::from_fn(|k| if k + 1 < closure.classes { -own[k] } else { own[k] });
            let prime = u64::from(PRIME);
            pair[0].push((own, (re + im) % prime));
            pair[1].push((mirrored, (re + prime - im) % prime));
        }
        found.insert(support, pair);
    }
    let mut pairs: Vec<(Vec<usize>, [Equation; 2])> = found.into_iter().collect();
    pairs.sort_by(|a, b| a.0.cmp(&b.0));
    Some(pairs.into_iter().flat_map(|(_, pair)| pair).collect())
}

/// Returns the number of columns less the rank of all equations times monomials of which all monomials are among the chosen ones; no
/// more rows are taken where it is `enough`.
fn nullity(equations: &[Equation], chosen: &[Monomial], enough: usize) -> usize {
    let places: HashMap<&Monomial, usize> = chosen.iter().zip(0..).collect();
    let mut pivots: Vec<Option<Vec<u64>>> = vec![None; chosen.len()];
    let (prime, mut left) = (u64::from(PRIME), chosen.len());
    for equation in equations {
        let Some((first, _)) = equation.first() else { continue };
        for own in chosen {
            let moved = |term: &Monomial| -> Monomial { std::array::from_fn(|k| own[k] - first[k] + term[k]) };
            let mut row = vec![0; chosen.len()];
            let is_inside = equation.iter().all(|(term, value)| {
                let place = places.get(&moved(term));
                place.inspect(|place| row[**place] = *value).is_some()
            });
            if !is_inside {
                continue;
            }
            for column in 0..chosen.len() {
                if row[column] == 0 {
                    continue;
                }
                let Some(pivot) = &pivots[column] else {
                    let scale = power(row[column], PRIME - 2);
                    pivots[column] = Some(row.iter().map(|x| times(*x, scale)).collect());
                    left -= 1;
                    break;
                };
                let factor = prime - row[column];
                for (x, y) in row[column..].iter_mut().zip(&pivot[column..]).filter(|(_, y)| **y != 0) {
                    *x = (*x + factor * y) % prime;
                }
            }
            if left == enough {
                return left;
            }
        }
    }
    left
}

/// Returns the monomials that may be multiplied by every unknown.
fn inner(closure: &LinkageClosure, chosen: &[Monomial]) -> Vec<Monomial> {
    let places: HashSet<&Monomial> = chosen.iter().collect();
    let is_inner = |own: &&Monomial| {
        (0..closure.size()).all(|k| {
            let mut next = **own;
            next[k] += 1;
            places.contains(&next)
        })
    };
    chosen.iter().filter(is_inner).copied().collect()
}

/// Returns the values of the monomials in a ball.
fn values(closure: &LinkageClosure, ball: &Ball, monomials: &[Monomial]) -> Vec<Longer> {
    let radius = ball.radius.to_f64().next_up();
    let i = Longer::near(&Float::new(2), &Float::with_val(2, 1), 0.0);
    let unknowns: Vec<[Longer; 2]> = (0..closure.size())
        .map(|k| {
            if k + 1 < closure.classes {
                let (cos, sin) = Longer::cos_sin_about(&ball.centre[k], radius);
                let turned = i.mul(&sin);
                [cos.add(&turned), cos.sub(&turned)]
            } else {
                let x = Longer::about(&ball.centre[k], radius);
                [x.clone(), x]
            }
        })
        .collect();
    let value = |own: &Monomial| {
        unknowns.iter().zip(own).fold(Longer::one(), |product, ([x, inverse], exponent)| {
            let factor = if *exponent < 0 { inverse } else { x };
            (0..exponent.unsigned_abs()).fold(product, |product, _| product.mul(factor))
        })
    };
    monomials.iter().map(value).collect()
}

/// Returns whether these rows are independent, by pivots that are not 0.
fn are_independent(mut rows: Vec<Vec<Longer>>) -> bool {
    for at in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(at + 1);
        let Some(row) = done.last() else { return false };
        let size = |k: &usize| row[*k].at_least();
        let Some(pivot) = (0..row.len()).max_by(|a, b| size(a).total_cmp(&size(b))) else { return false };
        let (true, Some(inverse)) = (row[pivot].at_least() > 0.0, row[pivot].inverse()) else { return false };
        for other in rest {
            let factor = other[pivot].mul(&inverse);
            *other = other.iter().zip(row).map(|(x, y)| x.sub(&factor.mul(y))).collect();
            other[pivot] = Longer::zero();
        }
    }
    true
}

/// Checks that balls, each of which holds a solution, hold all of them.
pub(super) fn check_kernel(closure: &LinkageClosure, balls: &[Ball], item: &Value) -> Result<(), Fault> {
    let [_, value, aid] = fields(item, ["kind", "value", "aid"], &[])?;
    let [up, down, each, slides] = fields(aid, ["up", "down", "each", "slides"], &[])?;
    let choice = Choice { up: count(up)?, down: count(down)?, each: count(each)?, slides: count(slides)? };
    if [choice.up, choice.down, choice.each, choice.slides].iter().any(|bound| *bound > MOST_EXPONENT) {
        return refused(format!("proof: {KIND}: a bound above {MOST_EXPONENT}"));
    }
    let (stated, chosen) = (count(value)?, choice.monomials(closure));
    if chosen.len() > MOST_COLUMNS {
        return refused(format!("proof: {KIND}: more than {MOST_COLUMNS} monomials"));
    }
    let Some(equations) = shortest(closure) else {
        return refused(format!("proof: {KIND}: loops depend on each other"));
    };
    let most = nullity(&equations, &chosen, stated);
    if stated != most || stated != balls.len() || stated == 0 {
        let modes = balls.len();
        return refused(format!(
            "proof: {KIND}: it has dimension {most}, {stated} is stated, and {modes} modes are proved"
        ));
    }
    let inner = inner(closure, &chosen);
    if !are_independent(balls.iter().map(|ball| values(closure, ball, &inner)).collect()) {
        return refused(format!("proof: {KIND}: the vectors of the modes may be dependent"));
    }
    Ok(())
}

/// Returns a proof that there are no solutions outside the balls; `None` if no choice of monomials gives one.
#[must_use]
pub fn proof_of_kernel(closure: &LinkageClosure, balls: &[Ball]) -> Option<Value> {
    let equations = shortest(closure)?;
    let slides: &[usize] = if closure.slides.is_empty() { &[0] } else { &[1, 2] };
    let choices =
        slides.iter().flat_map(|slides| BOUNDS.map(|(up, down, each)| Choice { up, down, each, slides: *slides }));
    for choice in choices {
        let chosen = choice.monomials(closure);
        let inner = inner(closure, &chosen);
        if chosen.len() > MOST_TRIED || inner.len() < balls.len() {
            continue;
        }
        let rows = balls.iter().map(|ball| values(closure, ball, &inner)).collect();
        if are_independent(rows) && nullity(&equations, &chosen, balls.len()) == balls.len() {
            let Choice { up, down, each, slides } = choice;
            let aid = json!({ "up": up, "down": down, "each": each, "slides": slides });
            return Some(json!({ "kind": KIND, "value": balls.len(), "aid": aid }));
        }
    }
    None
}
