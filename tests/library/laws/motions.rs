//! Laws of motions: matrices and dual quaternions are two images of one group.

use crate::strategies::rational;
use looproot::internal::kinematics::{dual_quaternion::DualQuaternion, motion::Motion};
use looproot_algebra::{
    modp::{ModP, PRIME_62},
    ring::{Field, Ring},
};
use proptest::prelude::*;
use rug::Rational;

/// A dual quaternion, and the same motion from matrices by another road.
fn both<F: Field>([sine, cosine, x, y]: &[F; 4]) -> Option<(DualQuaternion<F>, Motion<F>)> {
    let cos_sin = |c: &F, s: &F| {
        let (cc, ss) = (c.mul(c), s.mul(s));
        let inverse = cc.add(&ss).inverse()?;
        let cs = c.mul(s);
        Some((cc.sub(&ss).mul(&inverse), cs.add(&cs).mul(&inverse)))
    };
    let t = [x.clone(), y.clone(), sine.clone()];
    let (cos_z, sin_z) = cos_sin(cosine, sine)?;
    let (cos_x, sin_x) = cos_sin(x, y)?;
    let quaternion = DualQuaternion::rotation_z(cosine.clone(), sine.clone())
        .mul(&DualQuaternion::translation(&t))
        .mul(&DualQuaternion::rotation_x(x.clone(), y.clone()));
    let motion = Motion::rotation_z(cos_z, sin_z)
        .then_after(&Motion::translation(t))
        .then_after(&Motion::rotation_x(cos_x, sin_x));
    Some((quaternion, motion))
}

fn agree<F: Field>(first: &[F; 4], second: &[F; 4], point: &[F; 3]) -> Result<(), TestCaseError> {
    let (Some((q, motion)), Some((r, other))) = (both(first), both(second)) else { return Ok(()) };
    let (product, composed) = (q.mul(&r), motion.then_after(&other));
    prop_assert_eq!(product.to_motion(), Some(composed.clone()));
    prop_assert_eq!(q.conjugate().to_motion(), Some(motion.inverse()));
    prop_assert!(product.study_residual().is_zero());
    let (study_x, study_y) = product.study();
    prop_assert_eq!(&DualQuaternion::from_study(&study_x, &study_y), &product);
    let (image, norm) = product.scaled_image(point);
    prop_assert_eq!(image, composed.apply(point).map(|c| c.mul(&norm)));
    let identity = composed.then_after(&composed.inverse());
    prop_assert_eq!(identity, Motion::identity());
    Ok(())
}

fn four() -> impl Strategy<Value = [Rational; 4]> {
    [rational(), rational(), rational(), rational()]
}

proptest! {
    #[test]
    fn compose_like_dual_quaternions(a in four(), b in four(), p in four()) {
        let point = [p[0].clone(), p[1].clone(), p[2].clone()];
        agree(&a, &b, &point)?;
        let image = |q: &Rational| ModP::<PRIME_62>::from_rational(q).unwrap();
        agree(&a.each_ref().map(image), &b.each_ref().map(image), &point.each_ref().map(image))?;
    }
}

#[test]
fn of_zero_norm_are_no_motions() {
    let zero = Rational::new();
    assert_eq!(DualQuaternion::rotation_z(zero.clone(), zero).to_motion(), None);
}
