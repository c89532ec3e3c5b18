//! The cognates of a four-bar: two other four-bars that guide a point of their couplers along the same curve.
//!
//! With the crank b, the side c of the coupler, the rocker r and the traced point at p from the crank, all as complex numbers,
//! `a + b + c = d + r`. Multiplied by `p/c` this is the loop of the first cognate, which stands on a and `a + (d - a) p/c`, and
//! multiplied by `1 - p/c` that of the second one. \[Wittenburg2016, 17.8.1\]

use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Body, Gaussian, Linkage, LinkageJoint, Pair};
use rug::Rational;

/// The body of a cognate that has the traced point P.
pub const COUPLER: usize = 2;

/// Returns the cognates of a four-bar of revolute joints for a point of its coupler: frame, crank, coupler, rocker. The crank of both
/// turns as the coupler of the four-bar does.
///
/// # Errors
/// [`Error::Invalid`] for linkages that are no such four-bar, bodies that are no coupler, and points that stand in a joint of the
/// coupler, whose curve is a circle.
pub fn cognates(linkage: &Linkage, body: usize, point: &Gaussian) -> Result<[Linkage; 2]> {
    let wrong = |what: &str| {
        Error::Invalid(format!("found {what}, expected a point of the coupler of a four-bar of four revolute joints"))
    };
    let is_revolute = linkage.joints.iter().all(|joint| joint.pair == Pair::Revolute);
    if linkage.bodies.len() != 4 || linkage.joints.len() != 4 || !is_revolute {
        return Err(wrong("another linkage"));
    }
    // The two ways from the ground to the coupler: pivot in the ground, arm, joint in the coupler.
    let side = |joint: &LinkageJoint, of: usize| joint.of.iter().position(|own| *own == of);
    let arms: Vec<[Gaussian; 3]> = linkage
        .joints
        .iter()
        .filter_map(|pivot| {
            let ground = side(pivot, linkage.ground)?;
            let arm = pivot.of[1 - ground];
            let joint =
                linkage.joints.iter().find(|joint| side(joint, arm).is_some() && side(joint, body).is_some())?;
            let (near, far) = (side(joint, arm)?, side(joint, body)?);
            let link = joint.at[near].sub(&pivot.at[1 - ground]);
            (arm != body).then(|| [pivot.at[ground].clone(), link, joint.at[far].clone()])
        })
        .collect();
    let [[a, b, at_b], [d, r, at_c]] = arms.as_slice() else { return Err(wrong("another body")) };
    let (c, p) = (at_c.sub(at_b), point.sub(at_b));
    let share = over(&p, &c).ok_or_else(|| wrong("a coupler whose joints coincide"))?;
    let rest = Gaussian::one().sub(&share);
    if is_zero(&share) || is_zero(&rest) {
        return Err(wrong("a point in a joint of the coupler, whose curve is a circle"));
    }
    let third = a.add(&share.mul(&d.sub(a)));
    Ok([
        four_bar([a, &third], &p, [&share.mul(b), b], &share.mul(r)),
        four_bar([d, &third], &p.sub(&c), [&rest.mul(r), r], &rest.mul(b)),
    ])
}

fn is_zero(z: &Gaussian) -> bool {
    z.re == 0 && z.im == 0
}

fn over(z: &Gaussian, by: &Gaussian) -> Option<Gaussian> {
    let square = Rational::from(&by.re * &by.re) + Rational::from(&by.im * &by.im);
    let conjugate = Gaussian { re: by.re.clone(), im: Rational::from(-&by.im) };
    let product = z.mul(&conjugate);
    (square != 0).then(|| Gaussian { re: product.re / &square, im: product.im / &square })
}

/// A four-bar on two pivots: crank, coupler with the traced point, rocker.
fn four_bar([a, d]: [&Gaussian; 2], crank: &Gaussian, [coupler, traced]: [&Gaussian; 2], rocker: &Gaussian) -> Linkage {
    let origin = Gaussian::zero();
    let body = |name: &str, points: &[(&str, &Gaussian)]| Body {
        name: name.to_owned(),
        points: points.iter().map(|(name, at)| ((*name).to_owned(), (*at).clone())).collect(),
        line: 1,
    };
    let joint = |name: &str, of: [usize; 2], at: [&Gaussian; 2]| LinkageJoint {
        name: name.to_owned(),
        pair: Pair::Revolute,
        of,
        at: at.map(Clone::clone),
        line: 1,
    };
    Linkage {
        ground: 0,
        bodies: vec![
            body("frame", &[("A", a), ("D", d)]),
            body("crank", &[("A", &origin), ("B", crank)]),
            body("coupler", &[("B", &origin), ("C", coupler), ("P", traced)]),
            body("rocker", &[("D", &origin), ("C", rocker)]),
        ],
        bars: Vec::new(),
        joints: vec![
            joint("A", [0, 1], [a, &origin]),
            joint("B", [1, COUPLER], [crank, &origin]),
            joint("C", [COUPLER, 3], [coupler, rocker]),
            joint("D", [3, 0], [&origin, d]),
        ],
    }
}
