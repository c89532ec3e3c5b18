//! The data of a cut that are computed once for all poses.

use crate::algebra::double_double::DoubleDouble;
use crate::certify::closure_zeros::EnclosedRows;
use crate::closure::half_angle::HalfAngleForm;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::Cut;
use crate::elimination::pencil::before_second_link;
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
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
    /// Prepares a cut, whose form is carried over `second` where that constant is free of the pose.
    pub fn new(cut: Cut, form: HalfAngleForm<f64>, second: Option<&Motion<f64>>) -> Self {
        let rows = second.map(|second| before_second_link(&form, second));
        Self { cut, form, rows, enclosed: OnceLock::new() }
    }

    /// Returns the exact rows, enclosed, where they do not depend on the pose. `exact` gives the loop, scaled; its
    /// closing transformation is the identity.
    pub fn enclosed(&self, exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>) -> Option<&EnclosedRows> {
        self.rows.as_ref()?;
        self.enclosed.get_or_init(|| EnclosedRows::of(self.cut, &exact()?).map(Box::new)).as_deref()
    }
}
