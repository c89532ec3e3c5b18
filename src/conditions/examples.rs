//! Loops of the library that belong to a family of conditions.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::ansatz::Link;
use crate::catalogue::{Options, builtin_names, load_ansatz};
use rug::Rational;

/// The folder of loops of which the library claims, and its tests check, how they move.
const FOLDER: &str = "overconstrained/";

/// A loop of the library, its links counted from one of its joints, with axes or common normals directed the other way.
#[derive(Clone, Debug)]
pub struct Example {
    /// Its name in the library.
    pub name: String,
    /// What was done to its directions; empty if nothing was.
    pub turned: String,
    /// The links.
    pub links: Vec<Link<Rational>>,
}

impl Example {
    /// Returns its name and what was done to its directions.
    #[must_use]
    pub fn text(&self) -> String {
        if self.turned.is_empty() { self.name.clone() } else { format!("{}, {}", self.name, self.turned) }
    }

    /// Returns the number of a parameter: `t2`, the tangent of half a twist, `a2` or `d2`; `None` for another name and for a twist of pi.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<Rational> {
        let mut letters = name.chars();
        let letter = letters.next()?;
        let link = self.links.get(letters.as_str().parse::<usize>().ok()?.checked_sub(1)?)?;
        match letter {
            't' => half_tangent(link),
            'a' => Some(link.a.clone()),
            'd' => Some(link.d.clone()),
            _ => None,
        }
    }
}

/// Returns the tangent of half the twist of a link; `None` for pi.
#[must_use]
pub fn half_tangent(link: &Link<Rational>) -> Option<Rational> {
    let below = Rational::from(1 + &link.cos);
    (below != 0).then(|| Rational::from(&link.sin / &below))
}

/// Returns the first of some loops that belongs to a family, as text: one whose directions are not reversed, if there is any.
#[must_use]
pub fn first(all: &[Example], contains: &dyn Fn(&Example) -> bool) -> Option<String> {
    all.iter().filter(|one| contains(one)).min_by_key(|one| one.turned.len()).map(Example::text)
}

/// Returns the value of a polynomial with integer coefficients.
#[must_use]
pub fn value_at(polynomial: &Polynomial<Int>, values: &[Rational]) -> Rational {
    let mut sum = Rational::new();
    for (exponents, c) in polynomial.terms() {
        let mut term = Rational::from(c.to_integer());
        for (value, power) in values.iter().zip(&exponents) {
            for _ in 0..*power {
                term *= value;
            }
        }
        sum += term;
    }
    sum
}

/// Returns the loops of so many revolute joints in every numbering, as they are and with directions of axes and common normals reversed.
#[must_use]
pub fn examples(joints: usize) -> Vec<Example> {
    let options = Options::default();
    let names = builtin_names().into_iter().filter(|name| name.starts_with(FOLDER));
    let mut list = Vec::new();
    for name in names {
        let Ok(ansatz) = load_ansatz(&name, &options) else { continue };
        let Some(links) = ansatz.over::<Rational>().and_then(|members| members.member(&[], &[])) else { continue };
        if links.len() != joints {
            continue;
        }
        for first in 0..joints {
            let counted: Vec<Link<Rational>> = (0..joints).map(|k| links[(first + k) % joints].clone()).collect();
            for axes in [0, SECOND_HALF[joints % 8]] {
                for normals in normals_of(joints) {
                    let links = reversed(&counted, axes, normals);
                    list.push(Example { name: name.clone(), turned: turned(joints, axes, normals), links });
                }
            }
        }
    }
    list
}

/// For every number of joints the bits of the second half of them.
const SECOND_HALF: [usize; 8] = [0, 0, 0b10, 0b110, 0b1100, 0b1_1100, 0b11_1000, 0b111_1000];

/// Returns the sets of links, as bits, whose common normals are reversed: all sets up to five joints, of six the second half, as its symmetries
/// need no other.
fn normals_of(joints: usize) -> Vec<usize> {
    if joints <= 5 { (0..1 << joints).collect() } else { vec![0, SECOND_HALF[joints % 8]] }
}

fn turned(joints: usize, axes: usize, normals: usize) -> String {
    let of = |what: &str, set: usize| {
        let numbers: Vec<String> = (0..joints).filter(|k| set >> k & 1 == 1).map(|k| (k + 1).to_string()).collect();
        (!numbers.is_empty()).then(|| format!("{what} {}", numbers.join(", ")))
    };
    let parts: Vec<String> = [of("axes", axes), of("common normals", normals)].into_iter().flatten().collect();
    if parts.is_empty() { String::new() } else { format!("{} reversed", parts.join(" and ")) }
}

/// Returns the same loop with some axes or common normals reversed. An axis that points the other way changes the twists before and behind it by
/// pi and the sign of its offset, a common normal the signs of twist and length.
fn reversed(links: &[Link<Rational>], axes: usize, normals: usize) -> Vec<Link<Rational>> {
    let is_reversed = |k: usize| axes >> (k % links.len()) & 1 == 1;
    let one = |(k, link): (usize, &Link<Rational>)| {
        let mut link = link.clone();
        if is_reversed(k) {
            link.d = -link.d;
        }
        if is_reversed(k) != is_reversed(k + 1) {
            (link.cos, link.sin) = (-link.cos, -link.sin);
        }
        if normals >> k & 1 == 1 {
            (link.sin, link.a) = (-link.sin, -link.a);
        }
        link
    };
    links.iter().enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conditions::composed::Composed;

    #[test]
    fn goldberg_and_myard_are_found() {
        let all = examples(5);
        for (family, name) in Composed::all(5).iter().zip(["overconstrained/goldberg_a", "overconstrained/myard_a"]) {
            assert!(all.iter().any(|one| one.name == name && family.contains(&one.links)), "{name}");
        }
    }
}
