//! Loops and platforms. Their answers are documents, which hold everything and are small.

use crate::arm::matrix;
use crate::faults::guarded;
use looproot::internal::face::{self, Model};
use looproot::internal::kinematics::joint::Variable;
use looproot::internal::sweep::Range;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Interval at which a sweep looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// A closed loop.
#[pyclass(frozen, module = "looproot._core")]
pub struct Loop(face::Loop);

#[pymethods]
impl Loop {
    #[new]
    fn new(name: &str) -> PyResult<Self> {
        guarded(|| face::Loop::new(Model::load(name, None, None)?)).map(Self)
    }

    #[getter]
    fn name(&self) -> String {
        self.0.model.entry.name.clone()
    }

    #[getter]
    fn title(&self) -> String {
        self.0.model.entry.title.clone()
    }

    #[getter]
    fn names(&self) -> Vec<String> {
        looproot::internal::report::document::labels(&self.0.model.entry)
    }

    /// The number of the input joint, from 1, and whether it is an angle.
    #[getter]
    fn input(&self) -> (usize, bool) {
        let (joint, variable) = self.0.input();
        (joint, variable == Variable::Rotation)
    }

    fn solve(&self, python: Python<'_>, input: f64, complex: bool) -> PyResult<String> {
        python.detach(|| {
            guarded(|| {
                let case = self.0.case(input)?;
                let solution = self.0.model.solve(&case, complex)?;
                Ok(self.0.model.document(&[(case, solution)], complex).to_string())
            })
        })
    }

    /// Ctrl-C ends it with what is done.
    fn sweep(&self, python: Python<'_>, start: f64, end: f64, steps: usize) -> PyResult<String> {
        let stop = AtomicBool::new(false);
        let (joint, variable) = self.0.input();
        let range = Range { from: start, to: end, steps };
        python.detach(|| {
            std::thread::scope(|scope| {
                let work = scope.spawn(|| {
                    guarded(|| {
                        let running = || !stop.load(Ordering::Relaxed);
                        Ok(self.0.model.sweep(joint, variable, range, running)?.to_string())
                    })
                });
                while !work.is_finished() {
                    std::thread::park_timeout(LOOK);
                    if Python::attach(|py| py.check_signals()).is_err() {
                        stop.store(true, Ordering::Relaxed);
                    }
                }
                work.join().unwrap_or_else(|panic| {
                    Err(crate::faults::InternalError::new_err(crate::faults::panic_text(panic.as_ref())))
                })
            })
        })
    }

    fn certificate(&self, python: Python<'_>, input: f64) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.model.certificate(&self.0.case(input)?)?.to_string())))
    }

    fn derive(&self, python: Python<'_>, input: f64) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.model.derive(&self.0.case(input)?)?.to_string())))
    }

    fn mobility(&self, python: Python<'_>) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.model.mobility()?.to_string())))
    }
}

/// A Stewart platform.
#[pyclass(frozen, module = "looproot._core")]
pub struct Platform(face::Platform);

fn points(given: &PyReadonlyArray2<'_, f64>) -> [[f64; 3]; 6] {
    let view = given.as_array();
    std::array::from_fn(|i| std::array::from_fn(|j| view[[i, j]]))
}

#[pymethods]
impl Platform {
    #[staticmethod]
    fn load(name: &str) -> PyResult<Self> {
        guarded(|| face::Platform::new(Model::load(name, None, None)?)).map(Self)
    }

    #[staticmethod]
    fn from_points(base: PyReadonlyArray2<'_, f64>, plate: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let (base, plate) = (points(&base), points(&plate));
        guarded(|| face::Platform::from_points(&base, &plate)).map(Self)
    }

    #[getter]
    fn name(&self) -> String {
        self.0.model.entry.name.clone()
    }

    #[getter]
    fn title(&self) -> String {
        self.0.model.entry.title.clone()
    }

    fn solve(&self, python: Python<'_>, legs: [f64; 6], complex: bool) -> PyResult<String> {
        python.detach(|| {
            guarded(|| {
                let case = self.0.case(&legs)?;
                let solution = self.0.model.solve(&case, complex)?;
                Ok(self.0.model.document(&[(case, solution)], complex).to_string())
            })
        })
    }

    fn legs(&self, pose: PyReadonlyArray2<'_, f64>) -> PyResult<[f64; 6]> {
        let pose = matrix(&pose);
        guarded(|| self.0.legs(&pose))
    }

    fn certificate(&self, python: Python<'_>, legs: [f64; 6]) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.model.certificate(&self.0.case(&legs)?)?.to_string())))
    }

    fn derive(&self, python: Python<'_>, legs: [f64; 6]) -> PyResult<String> {
        python.detach(|| guarded(|| Ok(self.0.model.derive(&self.0.case(&legs)?)?.to_string())))
    }
}
