//! The relation of input and output in cosines and sines: of a four-bar Freudenstein's equation.
//!
//! A polynomial of degree 2 in the tangent t of half an angle, divided by `1 + t^2`, is linear in cosine c and sine s:
//! `1/(1 + t^2) = (1 + c)/2`, `t/(1 + t^2) = s/2`, `t^2/(1 + t^2) = (1 - c)/2`.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use rug::Rational;

/// Returns a relation of input (variable 0) and output (variable 1), half-angle tangents, or an input that is a distance if not
/// `is_turn`, in the variables `c, s` of the input or the distance, `c, s` of the output, then the other variables of the relation.
/// `None` if a degree is not 2.
#[must_use]
pub fn in_cosines(relation: &Polynomial<Int>, is_turn: bool) -> Option<Polynomial<Int>> {
    if relation.degree(1) != 2 || is_turn && relation.degree(0) != 2 {
        return None;
    }
    let output = if is_turn { 2 } else { 1 };
    // Twice the monomial of this power.
    let linear = |power: u32, cosine: usize| -> Polynomial<Int> {
        let (one, c) = (Polynomial::<Int>::one(), Polynomial::variable(cosine));
        match power {
            0 => one.add(&c),
            1 => Polynomial::variable(cosine + 1),
            _ => one.sub(&c),
        }
    };
    let mut sum = Polynomial::<Int>::zero();
    for (exponents, c) in relation.terms() {
        let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
        let input = if is_turn { linear(power(0), 0) } else { Polynomial::from_terms([(vec![power(0)], Int::one())]) };
        let mut rest = vec![0; output + 2];
        rest.extend(exponents.iter().skip(2));
        let rest = Polynomial::from_terms([(rest, c.clone())]);
        sum = sum.add(&rest.mul(&input).mul(&linear(power(1), output)));
    }
    Some(sum.primitive_part())
}

/// Returns the same polynomial over the integers, without a common factor of its numbers.
pub(super) fn integers(polynomial: &Polynomial<Rational>) -> Polynomial<Int> {
    polynomial.primitive().0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::text::{Format, Names};

    #[test]
    fn a_four_bar_has_freudensteins_equation() {
        // Ground 4, crank 1, coupler 8, rocker 3: 16 + 1 + 9 - 64 + 2 4 3 c2 - 2 4 1 c0 - 2 1 3 (c0 c2 + s0 s2) = 0.
        let [t, u] = [0, 1].map(Polynomial::<Int>::variable);
        let number = |n: i64| Polynomial::constant(Int::from(n));
        let squares = t.mul(&t).mul(&u).mul(&u);
        let relation =
            number(15).mul(&squares).add(&number(6).mul(&t).mul(&u)).add(&number(16).mul(&u).mul(&u)).add(&number(7));
        let found = in_cosines(&relation, true).unwrap();
        let names = Names::given(["c0", "s0", "c2", "s2"]).unwrap();
        let rational = found.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
        assert_eq!(Format::Text.polynomial(&rational, &names), "3*c0*c2 + 4*c0 + 3*s0*s2 - 12*c2 + 19");
    }

    #[test]
    fn other_degrees_have_none() {
        let t = Polynomial::<Int>::variable(0);
        assert!(in_cosines(&t, true).is_none());
    }
}
