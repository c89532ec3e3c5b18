//! Certificates of solutions with long translations; all lengths are divided by the longest of them.

use crate::certify::{Certificate, certificate};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::solve::dense::inverse;
use crate::solve::newton::{Six, closure, reach};
use crate::solve::scalar::Scalar;

/// As [`certificate`], with the inverse of the Jacobian at the exact point and lengths over a power of two not below the
/// longest translation. Then distant frames are bounded as well as near ones, and only the angles have second derivatives.
/// The radius is that of the loop as it is. The last constant may be off by a matrix of row-sum norm `off`.
pub(super) fn certificate_in_reach<S: Scalar>(
    closed: &ClosedLoop<f64>,
    unknowns: &Six<S>,
    off: f64,
) -> Option<Certificate> {
    let unit = reach(&closed.variables, &unknowns.map(Scalar::to_complex)).log2().ceil().exp2();
    if !unit.is_finite() {
        return None;
    }
    let mut shrunk = closed.clone();
    for constant in &mut shrunk.constants {
        *constant = constant.over(unit);
    }
    let unknowns: Six<S> = std::array::from_fn(|j| match closed.variables[j] {
        Variable::Rotation => unknowns[j],
        Variable::Translation => unknowns[j].times(1.0 / unit),
    });
    let mut here = closure(&shrunk, &unknowns);
    here.constant_is_off(5, off);
    let proof = certificate(&here, &inverse(&here.jacobian)?)?;
    let radius = proof.radius * unit;
    (radius <= proof.isolation).then_some(Certificate { radius, proved: proof.proved * unit, ..proof })
}
