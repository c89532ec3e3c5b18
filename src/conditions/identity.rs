//! Mobility of a family for all parameters, proved by expanded identities.

use super::symmetry::{Signs, Slice, SymmetricSlice};
use crate::algebra::dual::Dual;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion::Motion;

type Symbol = Polynomial<Int>;

/// Returns whether `G^2 - 2 Sc(G) G + G G* = 0` for the dual quaternion G with eight symbols as coordinates.
///
/// Hence for a motion G, whose norm `G G*` is real, `G^2` is the identity if and only if its dual scalar part
/// vanishes, or G itself is the identity: two equations.
#[must_use]
pub fn square_identity() -> bool {
    let symbol = |k: usize| Symbol::variable(k);
    let g = DualQuaternion::from_study(&std::array::from_fn(symbol), &std::array::from_fn(|k| symbol(4 + k)));
    let twice = g.scalar.add(&g.scalar);
    let square = g.mul(&g);
    let scalar = square.scalar.sub(&twice.mul(&g.scalar)).add(&g.norm());
    let vector = (0..3).map(|i| square.vector[i].sub(&twice.mul(&g.vector[i])));
    vector.chain([scalar]).all(|part: Dual<Symbol>| part.is_zero())
}

/// A change of signs of the three coordinates.
type Flip = [bool; 3];

/// Returns the action of a flip S on the four elementary motions: `S Rz(theta) S = Rz(+-theta)` and so on.
const fn conjugation([x, y, z]: Flip) -> Signs {
    Signs { angle: x != y, twist: y != z, length: x, offset: z }
}

/// Returns whether a flip acts on the elementary motions as [`conjugation`] states, with symbols for cosines, sines and distances.
#[must_use]
fn acts(flip: Flip) -> bool {
    let symbol = |k: usize| Symbol::variable(k);
    let sign = |negative: bool, x: Symbol| if negative { x.neg() } else { x };
    let signs = conjugation(flip);
    let flipped = |motion: &Motion<Symbol>| Motion {
        rotation: std::array::from_fn(|i| {
            std::array::from_fn(|j| sign(flip[i] != flip[j], motion.rotation[i][j].clone()))
        }),
        translation: std::array::from_fn(|i| sign(flip[i], motion.translation[i].clone())),
    };
    let along_x = |a: Symbol| Motion::translation([a, Symbol::zero(), Symbol::zero()]);
    flipped(&Motion::rotation_z(symbol(0), symbol(1))) == Motion::rotation_z(symbol(0), sign(signs.angle, symbol(1)))
        && flipped(&Motion::rotation_x(symbol(0), symbol(1)))
            == Motion::rotation_x(symbol(0), sign(signs.twist, symbol(1)))
        && flipped(&along_x(symbol(2))) == along_x(sign(signs.length, symbol(2)))
        && flipped(&Motion::translation_z(symbol(2))) == Motion::translation_z(sign(signs.offset, symbol(2)))
}

/// Returns why a slice moves for all lengths and all twists of its pattern; `None` if no identity is known.
#[must_use]
pub fn proof(slice: &SymmetricSlice) -> Option<String> {
    if !matches!(slice.slice, Slice::Mobile | Slice::Folded) {
        return None;
    }
    let flips = (0..8_u8).map(|bits| [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0]);
    let negated = |flip: &Flip| flip.iter().filter(|&&negative| negative).count();
    if slice.involution.name == "half-turn" {
        let flip = flips.into_iter().find(|&flip| conjugation(flip) == slice.signs)?;
        // A rotation has no or two negative signs.
        let holds = negated(&flip).is_multiple_of(2) && acts(flip) && square_identity();
        return holds.then(|| {
            "the loop closes as (G S)^2 = 1, where G is half of it and S a half-turn about a coordinate axis or none; \
             by the identity H^2 - 2 Sc(H) H + H H* = 0, expanded here, this is Sc(G S) = 0: two equations, the primal \
             and the dual one, for three angles"
                .to_owned()
        });
    }
    // Reversing a motion negates all four quantities.
    let reversed = |flip: Flip| {
        let signs = conjugation(flip);
        Signs { angle: !signs.angle, twist: !signs.twist, length: !signs.length, offset: !signs.offset }
    };
    let flip = flips.into_iter().find(|&flip| reversed(flip) == slice.signs)?;
    match negated(&flip) {
        0 => Some("half of the loop is the other half reversed: it closes for all angles, folded back on itself".to_owned()),
        1 if acts(flip) && slice.involution.name == "mirror through two joints" => Some(
            "the loop closes as G S G^-1 S = 1, where G is half of it and S the reflection in a coordinate plane: G maps \
             that plane to itself, three equations for four angles"
                .to_owned(),
        ),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_of_a_dual_quaternion_satisfies_its_quadratic_equation() {
        assert!(square_identity());
    }

    #[test]
    fn changes_of_coordinate_signs_change_signs_of_the_parameters() {
        let flips = (0..8_u8).map(|bits| [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0]);
        let mut patterns: Vec<Signs> = flips.clone().map(conjugation).collect();
        assert!(flips.into_iter().all(acts));
        patterns.sort();
        patterns.dedup();
        assert_eq!(patterns.len(), 8);
    }
}
