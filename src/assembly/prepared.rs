//! The data of a cut that are computed once for all poses.

use crate::closure::half_angle::HalfAngleForm;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::Cut;

/// A cut whose elimination does not depend on the pose.
pub(super) struct PreparedCut {
    pub cut: Cut,
    pub form: HalfAngleForm<f64>,
    /// `form.rows` carried over constant 2, where that is free of the pose too.
    pub rows: Option<[MarkedLine<f64>; 8]>,
}
