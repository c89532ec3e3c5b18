//! Motions with parameters proved by an identity: the product of all joints and links round the loop is a number.

use super::twist_family::Ratio;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::kinematics::dual_quaternion::DualQuaternion;

type Poly = Polynomial<Int>;

/// A joint with the link behind it, every angle by its half-angle tangent.
#[derive(Clone, Debug)]
pub struct Member {
    /// The joint angle.
    pub theta: Ratio,
    /// The offset.
    pub d: Poly,
    /// The twist.
    pub alpha: Ratio,
    /// The length of the link.
    pub a: Poly,
}

/// Returns the seven components of the product besides the scalar, which vanish if the loop closes, and the scalar.
#[must_use]
pub fn product(members: &[Member]) -> ([Poly; 7], Poly) {
    let nought = Poly::zero;
    let factor = |member: &Member| {
        DualQuaternion::rotation_z(member.theta.1.clone(), member.theta.0.clone())
            .mul(&DualQuaternion::translation(&[nought(), nought(), member.d.clone()]))
            .mul(&DualQuaternion::rotation_x(member.alpha.1.clone(), member.alpha.0.clone()))
            .mul(&DualQuaternion::translation(&[member.a.clone(), nought(), nought()]))
    };
    let product = members.iter().fold(DualQuaternion::identity(), |product, member| product.mul(&factor(member)));
    let ([scalar, x1, x2, x3], [y0, y1, y2, y3]) = product.study();
    ([x1, x2, x3, y0, y1, y2, y3], scalar)
}

/// Returns whether the loop closes for all values of the variables: the product is a nonzero number.
#[must_use]
pub fn closes(members: &[Member]) -> bool {
    let (rest, scalar) = product(members);
    !scalar.is_zero() && rest.iter().all(Poly::is_zero)
}
