//! Answers as arrays and dictionaries.

use looproot::internal::mechanism::Solution;
use looproot::internal::verdict::{Proof, Verdict};
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The columns of all modes: joint values, certified, radius, condition, within limits (-1: without limits), near, and the error
/// of the pose.
pub type Modes<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<i8>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray2<f64>>,
);

/// Returns a matrix with this many columns from its concatenated rows.
pub fn rows(values: Vec<f64>, columns: usize) -> PyResult<Array2<f64>> {
    let count = values.len() / columns.max(1);
    Array2::from_shape_vec((count, columns), values).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// Matrices of one shape, one behind the other.
pub fn stack(values: Vec<f64>, shape: (usize, usize, usize)) -> PyResult<Array3<f64>> {
    Array3::from_shape_vec(shape, values).map_err(|fault| PyValueError::new_err(fault.to_string()))
}

/// The modes of an answer.
pub fn modes<'py>(python: Python<'py>, solution: &Solution, freedoms: usize) -> PyResult<Modes<'py>> {
    let modes = &solution.modes;
    let q: Vec<f64> = modes.iter().flat_map(|mode| mode.q.iter().map(|z| z.re)).collect();
    let certified: Vec<bool> = modes.iter().map(|mode| mode.certified).collect();
    let radius: Vec<f64> = modes.iter().map(|mode| mode.radius).collect();
    let condition: Vec<f64> = modes.iter().map(|mode| mode.condition).collect();
    let within: Vec<i8> = modes.iter().map(|mode| mode.within_limits.map_or(-1, i8::from)).collect();
    let near: Vec<bool> = modes.iter().map(|mode| mode.near).collect();
    let error =
        |mode: &looproot::internal::mechanism::FullMode| mode.error.map_or([0.0; 2], |e| [e.position, e.orientation]);
    let error: Vec<f64> = modes.iter().flat_map(error).collect();
    Ok((
        rows(q, freedoms)?.into_pyarray(python),
        certified.into_pyarray(python),
        radius.into_pyarray(python),
        condition.into_pyarray(python),
        within.into_pyarray(python),
        near.into_pyarray(python),
        rows(error, 2)?.into_pyarray(python),
    ))
}

/// A verdict with the keys of the JSON output.
pub fn verdict<'py>(python: Python<'py>, verdict: &Verdict, near: usize) -> PyResult<Bound<'py, PyDict>> {
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
    object.set_item("near", near)?;
    if let Proof::Probable { error, seed } = verdict.proof {
        object.set_item("probability_of_error", error)?;
        object.set_item("seed", seed)?;
    }
    Ok(object)
}

/// The families of an answer: dimension, moving variables from 0, distance, sample and samples.
pub fn families<'py>(python: Python<'py>, solution: &Solution) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let one = |family: &looproot::internal::mechanism::Family| {
        let object = PyDict::new(python);
        object.set_item("dimension", family.dimension)?;
        object.set_item("moving", &family.moving)?;
        object.set_item("distance", family.distance)?;
        object.set_item("sample", &family.sample)?;
        object.set_item("samples", &family.samples)?;
        Ok(object)
    };
    solution.families.iter().map(one).collect()
}
