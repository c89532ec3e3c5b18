//! Answers as arrays and dictionaries.

use looproot::internal::mechanism::{Family, FullMode, Solution};
use looproot::internal::verdict::Proof;
use numpy::ndarray::{Array2, Array3};
use numpy::{Element, IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The answer to one question. Its arrays are made when they are asked for: most callers read one or two of them.
#[pyclass(frozen, module = "looproot._core")]
pub struct Answer {
    pub solution: Solution,
    /// The joint variables.
    pub freedoms: usize,
    /// Whether the joints have limits.
    pub limited: bool,
}

#[pymethods]
impl Answer {
    /// The number of modes.
    fn __len__(&self) -> usize {
        self.solution.modes.len()
    }

    #[getter]
    fn q<'py>(&self, python: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values: Vec<f64> = self.solution.modes.iter().flat_map(|mode| mode.q.iter().map(|z| z.re)).collect();
        Ok(rows(values, self.freedoms)?.into_pyarray(python))
    }

    #[getter]
    fn certified<'py>(&self, python: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(python, |mode| mode.certified)
    }

    #[getter]
    fn radius<'py>(&self, python: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(python, |mode| mode.radius)
    }

    #[getter]
    fn condition<'py>(&self, python: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(python, |mode| mode.condition)
    }

    /// `None` where there are no limits.
    #[getter]
    fn within_limits<'py>(&self, python: Python<'py>) -> Option<Bound<'py, PyArray1<bool>>> {
        self.limited.then(|| self.column(python, |mode| mode.within_limits == Some(true)))
    }

    #[getter]
    fn near<'py>(&self, python: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(python, |mode| mode.near)
    }

    /// The keys of the verdict in the JSON output.
    #[getter]
    fn verdict<'py>(&self, python: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let verdict = &self.solution.verdict;
        let object = PyDict::new(python);
        object.set_item("status", verdict.status.word())?;
        object.set_item("proof", verdict.proof.word())?;
        object.set_item("code", verdict.code.word())?;
        object.set_item("reason", &verdict.reason)?;
        object.set_item("real", verdict.real)?;
        object.set_item("complex", verdict.complex)?;
        object.set_item("complex_complete", verdict.complex_complete)?;
        object.set_item("self_motion", verdict.self_motion)?;
        object.set_item("certified", verdict.certified)?;
        object.set_item("near", self.solution.near())?;
        if let Proof::Probable { error, seed } = verdict.proof {
            object.set_item("probability_of_error", error)?;
            object.set_item("seed", seed)?;
        }
        Ok(object)
    }

    /// Of every family its dimension, moving variables from 0, distance, sample and samples.
    #[getter]
    fn families<'py>(&self, python: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let one = |family: &Family| {
            let object = PyDict::new(python);
            object.set_item("dimension", family.dimension)?;
            object.set_item("moving", &family.moving)?;
            object.set_item("distance", family.distance)?;
            object.set_item("sample", &family.sample)?;
            object.set_item("samples", &family.samples)?;
            Ok(object)
        };
        self.solution.families.iter().map(one).collect()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.solution.warnings.clone()
    }
}

impl Answer {
    fn column<'py, T: Element>(&self, python: Python<'py>, of: impl Fn(&FullMode) -> T) -> Bound<'py, PyArray1<T>> {
        self.solution.modes.iter().map(of).collect::<Vec<T>>().into_pyarray(python)
    }
}

/// Returns a matrix with this many columns from its concatenated rows.
pub fn rows(values: Vec<f64>, columns: usize) -> PyResult<Array2<f64>> {
    let count = values.len() / columns.max(1);
    Array2::from_shape_vec((count, columns), values).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// Matrices of one shape, one behind the other.
pub fn stack(values: Vec<f64>, shape: (usize, usize, usize)) -> PyResult<Array3<f64>> {
    Array3::from_shape_vec(shape, values).map_err(|fault| PyValueError::new_err(fault.to_string()))
}
