//! Twists of four links at which the curve of the spherical four-bar is reducible.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::derivation::transference::Variables;

type Poly = Polynomial<Int>;

/// Signs of the four twists in half of their sum.
pub type Signs = [i32; 4];

/// Returns the numerator of `sin((e1 alpha1 + ... + e4 alpha4)/2)`, the imaginary part of `prod (1 + i e_k t_k)`.
#[must_use]
pub fn sine(signs: Signs) -> Poly {
    let (mut real, mut imaginary) = (Poly::one(), Poly::zero());
    for (k, &sign) in signs.iter().enumerate() {
        let t = Poly::variable(Variables::twist(k)).scale(&Int::from_integer(sign));
        (real, imaginary) = (real.sub(&imaginary.mul(&t)), imaginary.add(&real.mul(&t)));
    }
    imaginary
}

/// The two pairs of related links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Opposite links: (1, 3) and (2, 4).
    Isogram,
    /// Neighbours: (1, 2) and (3, 4).
    Deltoid,
    /// The other neighbours: (1, 4) and (2, 3).
    TurnedDeltoid,
}

/// A half-angle tangent as a ratio of polynomials.
pub type Ratio = (Poly, Poly);

/// Twists with two relations: `t_j = +-t_i` or `t_j = +-1/t_i` for two pairs of links.
#[derive(Clone, Debug)]
pub struct TwistFamily {
    /// The pairs of links.
    pub shape: Shape,
    /// The half-angle tangents of all twists, in terms of those of the first link of each pair.
    pub tangents: [Ratio; 4],
    /// The links whose twists are free.
    pub free: [usize; 2],
    /// The relations as polynomials.
    pub relations: [Poly; 2],
}

/// Returns the families with vanishing factors `e` and `e'`: half their sum and half their difference are multiples of pi,
/// both even or both odd. `None` if one of these is a single twist, which is then a multiple of pi itself.
#[must_use]
pub fn families(e: Signs, other: Signs) -> Option<[TwistFamily; 2]> {
    let halves: [Signs; 2] =
        [std::array::from_fn(|k| i32::midpoint(e[k], other[k])), std::array::from_fn(|k| (e[k] - other[k]) / 2)];
    let support = |half: &Signs| (0..4).filter(|&k| half[k] != 0).collect::<Vec<_>>();
    let pairs = halves.map(|half| (support(&half), half));
    if pairs.iter().any(|(support, _)| support.len() != 2) {
        return None;
    }
    Some([false, true].map(|odd| {
        let mut tangents: [Ratio; 4] = std::array::from_fn(|k| (Poly::variable(Variables::twist(k)), Poly::one()));
        let mut relations = [Poly::zero(), Poly::zero()];
        let mut free = [0, 0];
        for (n, (support, half)) in pairs.iter().enumerate() {
            let (i, j) = (support[0], support[1]);
            let sign = Int::from_integer(half[i] * half[j]);
            let t = Poly::variable(Variables::twist(i));
            // alpha_j = -+alpha_i, or pi -+ alpha_i.
            tangents[j] = if odd { (Poly::constant(sign), t) } else { (t.scale(&sign.neg()), Poly::one()) };
            relations[n] = Poly::variable(Variables::twist(j)).mul(&tangents[j].1).sub(&tangents[j].0).primitive_part();
            free[n] = i;
        }
        free.sort_unstable();
        let partner = pairs.iter().find(|(support, _)| support[0] == 0).map_or(0, |(support, _)| support[1]);
        let shape = match partner {
            1 => Shape::Deltoid,
            2 => Shape::Isogram,
            _ => Shape::TurnedDeltoid,
        };
        TwistFamily { shape, tangents, free, relations }
    }))
}

/// Substitutes half-angle tangents of the twists in a polynomial of degree 2 or less in each, and multiplies by the
/// squares of the denominators.
#[must_use]
pub fn with_tangents(p: &Poly, tangents: &[Ratio; 4]) -> Poly {
    // All are replaced at once: a tangent that is replaced may be that of another link.
    fn insert(p: &Poly, link: usize, tangents: &[Ratio; 4]) -> Poly {
        if link == 4 {
            return p.clone();
        }
        let (n, d) = &tangents[link];
        let powers = [d.mul(d), n.mul(d), n.mul(n)];
        let parts = p.coefficients_in(Variables::twist(link));
        parts.iter().zip(&powers).fold(Poly::zero(), |sum, (part, power)| {
            if part.is_zero() { sum } else { sum.add(&insert(part, link + 1, tangents).mul(power)) }
        })
    }
    insert(p, 0, tangents)
}
