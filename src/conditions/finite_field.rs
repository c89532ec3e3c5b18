//! The prime fields of the searches, with operations beyond those of a field.
//!
//! Their primes are 3 modulo 4. Then -1 is no square, so a plane vector has length 0 only if it is 0, and the
//! half-angle tangents in the field and infinity are all its rotations.

use crate::algebra::modp::ModP;
use crate::algebra::ring::Ring;
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// Cosine and sine of an angle.
pub type Turn<F> = (F, F);

/// Returns a random nonzero element of the field.
pub fn random_unit<const P: u64>(rng: &mut ChaCha8Rng) -> ModP<P> {
    ModP::new(rng.random_range(1..P))
}

/// Returns a square root; `None` if there is none.
///
/// `x^((p+1)/4)`, as p is 3 modulo 4.
#[must_use]
pub fn square_root<const P: u64>(x: ModP<P>) -> Option<ModP<P>> {
    const { assert!(P % 4 == 3, "the prime is 3 modulo 4") };
    let (mut root, mut power, mut exponent) = (ModP::one(), x, P.div_ceil(4));
    while exponent > 0 {
        if exponent & 1 == 1 {
            root = root.mul(&power);
        }
        power = power.mul(&power);
        exponent >>= 1;
    }
    (root.mul(&root) == x).then_some(root)
}

/// Returns cosine and sine from the half-angle tangent.
///
/// # Panics
/// Never in the fields of the searches, where `1 + t^2` does not vanish.
#[must_use]
pub fn turn<const P: u64>(t: ModP<P>) -> Turn<ModP<P>> {
    const { assert!(P % 4 == 3, "the prime is 3 modulo 4") };
    half_tangent_turn(&t).expect("-1 is no square")
}

/// Returns cosine and sine from the half-angle tangent; `None` if its square is -1.
pub fn half_tangent_turn<F: crate::algebra::ring::Field>(t: &F) -> Option<Turn<F>> {
    let square = t.mul(t);
    let inverse = F::one().add(&square).inverse()?;
    Some((F::one().sub(&square).mul(&inverse), t.add(t).mul(&inverse)))
}

/// Returns all rotations about an axis: number j < P has half-angle tangent j, number P is the rotation by pi.
#[must_use]
pub fn all_turns<const P: u64>() -> Vec<Turn<ModP<P>>> {
    let finite = (0..P).map(|j| turn(ModP::new(j)));
    finite.chain([(ModP::one().neg(), ModP::zero())]).collect()
}

/// Returns the number of a rotation in [`all_turns`].
#[must_use]
pub fn turn_number<const P: u64>((cos, sin): &Turn<ModP<P>>) -> u16 {
    use crate::algebra::ring::Field;
    let number = cos.add(&ModP::one()).inverse().map_or(P, |inverse| sin.mul(&inverse).value());
    u16::try_from(number).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rotations_of_a_field_are_as_many_as_it_has_elements_and_one() {
        let turns = all_turns::<23>();
        for (j, (cos, sin)) in turns.iter().enumerate() {
            assert_eq!(cos.mul(cos).add(&sin.mul(sin)), ModP::one());
            assert_eq!(usize::from(turn_number(&(*cos, *sin))), j);
        }
        let on_the_circle =
            (0..23_u64).flat_map(|x| (0..23_u64).map(move |y| (x * x + y * y) % 23)).filter(|&n| n == 1);
        assert_eq!(on_the_circle.count(), turns.len());
    }

    #[test]
    fn half_of_the_units_are_squares() {
        let roots = (1..43).filter(|&x| square_root::<43>(ModP::new(x)).is_some()).count();
        assert_eq!(roots, 21);
        assert_eq!(square_root::<43>(ModP::new(16)).map(|x| x.mul(&x).value()), Some(16));
    }
}
