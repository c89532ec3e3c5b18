//! The data of a cut that are computed once for all poses.

use crate::algebra::double_double::DoubleDouble;
use crate::certify::closure_zeros::EnclosedRows;
use crate::closure::half_angle::HalfAngleForm;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::ClosedLoop;
use std::sync::OnceLock;

/// A cut whose elimination does not depend on the pose.
pub(super) struct PreparedCut {
    pub cut: Cut,
    pub form: HalfAngleForm<f64>,
    /// `form.rows` carried over constant 2, where that is free of the pose too.
    pub rows: Option<[MarkedLine<f64>; 8]>,
    enclosed: OnceLock<Option<Box<EnclosedRows>>>,
}

impl PreparedCut {
    /// Prepares a cut.
    pub fn new(cut: Cut, form: HalfAngleForm<f64>, rows: Option<[MarkedLine<f64>; 8]>) -> Self {
        Self { cut, form, rows, enclosed: OnceLock::new() }
    }

    /// Returns the exact rows, enclosed, where they do not depend on the pose. `exact` gives the loop, scaled; its
    /// closing transformation is the identity.
    pub fn enclosed(&self, exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>) -> Option<&EnclosedRows> {
        self.rows.as_ref()?;
        self.enclosed.get_or_init(|| EnclosedRows::of(self.cut, &exact()?).map(Box::new)).as_deref()
    }
}
