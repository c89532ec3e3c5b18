//! Linkages. Their answers are documents.

use crate::faults::guarded;
use looproot::internal::face;
use looproot::internal::kinematics::joint::Variable;
use looproot::internal::sweep::Range;
use pyo3::prelude::*;

/// A linkage in the plane or on the sphere.
#[pyclass(frozen, module = "looproot._core")]
pub struct Linkage(face::Linkage);

#[pymethods]
impl Linkage {
    #[new]
    fn new(name: &str) -> PyResult<Self> {
        guarded(|| face::Linkage::from_file(name)).map(Self)
    }

    #[getter]
    fn title(&self) -> String {
        self.0.title().to_owned()
    }

    /// The joints that have a value, each with whether it is an angle.
    #[getter]
    fn joints(&self) -> Vec<(String, bool)> {
        self.0.joints().into_iter().map(|(name, kind)| (name, kind == Variable::Rotation)).collect()
    }

    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.0.bodies()
    }

    fn solve(&self, python: Python<'_>, given: Vec<(String, f64)>, complex: bool) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.solve(&given, complex)?.to_string())))
    }

    /// The certificate of the answer with these values of joints.
    fn certificate(&self, python: Python<'_>, given: Vec<(String, f64)>) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.certificate(&given)?.to_string())))
    }

    fn sweep(
        &self,
        python: Python<'_>,
        joint: &str,
        range: (f64, f64, usize),
        trace: Option<&str>,
    ) -> PyResult<String> {
        let (from, to, steps) = range;
        python.detach(|| guarded(|| Ok(self.0.sweep(joint, Range { from, to, steps }, trace)?.to_string())))
    }

    fn derive(&self, python: Python<'_>, given: Vec<(String, f64)>) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.derive(&given)?.to_string())))
    }

    fn trace(&self, python: Python<'_>, point: &str) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.trace(point)?.to_string())))
    }

    fn mobility(&self, python: Python<'_>) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.mobility()?.to_string())))
    }
}
