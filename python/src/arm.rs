//! Arms.

use crate::answers::{Answer, rows, stack};
use crate::faults::{guarded, panic_text};
use looproot::internal::error::Error;
use looproot::internal::face::{self, Convention, DhRow, Matrix, ScrewRow, Workspace};
use looproot::internal::kinematics::chain::JointKind;
use looproot::internal::mechanism::Solution;
use numpy::ndarray::ArrayView1;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    /// The memory in which poses are solved one by one. It is taken for every pose: what panics leaves a fresh one.
    static WORKSPACE: Cell<Option<Box<Workspace>>> = const { Cell::new(None) };
}

/// Poses solved between two looks for Ctrl-C: some milliseconds of work.
const CHUNK: usize = 256;

/// Many answers: q, offsets, certified, near, within limits, words of status, words of proof, errors by index, self-motions.
type Answers<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<i8>>,
    Vec<&'static str>,
    Vec<&'static str>,
    Bound<'py, PyDict>,
    Bound<'py, PyArray1<i64>>,
);

/// An arm.
#[pyclass(frozen, module = "looproot._core")]
pub struct Arm(face::Arm);

fn kinds(letters: &str) -> PyResult<Vec<JointKind>> {
    let kind = |(index, letter): (usize, char)| {
        JointKind::from_letter(&letter.to_string())
            .filter(|kind| matches!(kind, JointKind::Revolute | JointKind::Prismatic))
            .ok_or_else(|| PyValueError::new_err(format!("found {letter} at [{index}] of joints, expected R or P")))
    };
    letters.chars().enumerate().map(kind).collect()
}

fn limits(given: Option<PyReadonlyArray2<'_, f64>>) -> Vec<[f64; 2]> {
    given.map(|rows| rows.as_array().rows().into_iter().map(|row| [row[0], row[1]]).collect()).unwrap_or_default()
}

fn three(row: ArrayView1<'_, f64>) -> [f64; 3] {
    [row[0], row[1], row[2]]
}

/// A matrix that the package above has made 4 by 4.
pub fn matrix(given: &PyReadonlyArray2<'_, f64>) -> Matrix {
    let view = given.as_array();
    std::array::from_fn(|i| std::array::from_fn(|j| view[[i, j]]))
}

fn values(given: &PyReadonlyArray2<'_, f64>) -> Vec<Vec<f64>> {
    given.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
}

/// Adds the index of its row to an error.
fn at(error: Error, index: usize, count: usize) -> Error {
    match error {
        Error::Invalid(text) if count > 1 => Error::Invalid(format!("[{index}]: {text}")),
        other => other,
    }
}

#[pymethods]
impl Arm {
    #[staticmethod]
    fn robot(name: &str) -> PyResult<Self> {
        guarded(|| face::Arm::robot(name)).map(Self)
    }

    #[staticmethod]
    fn load(path: &str, tip_link: Option<&str>, base_link: Option<&str>) -> PyResult<Self> {
        guarded(|| face::Arm::from_urdf(path, tip_link, base_link)).map(Self)
    }

    #[staticmethod]
    fn from_dh(
        table: PyReadonlyArray2<'_, f64>,
        joints: &str,
        modified: bool,
        bounds: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let table = table.as_array();
        let row = |(row, kind): (ArrayView1<'_, f64>, JointKind)| DhRow {
            kind,
            a: row[0],
            alpha: row[1],
            d: row[2],
            theta0: row[3],
        };
        let rows: Vec<DhRow> = table.rows().into_iter().zip(kinds(joints)?).map(row).collect();
        let convention = if modified { Convention::ModifiedDh } else { Convention::Dh };
        guarded(|| face::Arm::from_dh(&rows, convention, limits(bounds))).map(Self)
    }

    #[staticmethod]
    fn from_screws(
        axes: PyReadonlyArray2<'_, f64>,
        points: PyReadonlyArray2<'_, f64>,
        home: PyReadonlyArray2<'_, f64>,
        joints: &str,
        bounds: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let (axes, points) = (axes.as_array(), points.as_array());
        let rows: Vec<ScrewRow> = axes
            .rows()
            .into_iter()
            .zip(points.rows())
            .zip(kinds(joints)?)
            .map(|((axis, point), kind)| ScrewRow { kind, axis: three(axis), point: three(point) })
            .collect();
        guarded(|| face::Arm::from_screws(&rows, &matrix(&home), limits(bounds))).map(Self)
    }

    #[getter]
    fn names(&self) -> Vec<String> {
        self.0.names()
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
    fn links(&self) -> Option<[String; 2]> {
        self.0.model.entry.labels.links.clone()
    }

    #[getter]
    fn limits<'py>(&self, python: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(rows(self.0.model.entry.limits.as_flattened().to_vec(), 2)?.into_pyarray(python))
    }

    /// The poses that the file of the arm asks for.
    fn poses<'py>(&self, python: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let poses: Vec<Matrix> = self.0.model.entry.cases.iter().filter_map(face::Arm::matrix).collect();
        let flat: Vec<f64> = poses.iter().flatten().flatten().copied().collect();
        Ok(stack(flat, (poses.len(), 4, 4))?.into_pyarray(python))
    }

    fn fk<'py>(&self, python: Python<'py>, q: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let list = values(&q);
        let count = list.len();
        let poses = python.detach(|| {
            guarded(|| {
                let one = |(index, q): (usize, &Vec<f64>)| self.0.fk(q).map_err(|error| at(error, index, count));
                list.iter().enumerate().map(one).collect::<Result<Vec<Matrix>, Error>>()
            })
        })?;
        let flat: Vec<f64> = poses.iter().flatten().flatten().copied().collect();
        Ok(stack(flat, (count, 4, 4))?.into_pyarray(python))
    }

    fn jacobian<'py>(&self, python: Python<'py>, q: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let list = values(&q);
        let count = list.len();
        let found = guarded(|| {
            let one = |(index, q): (usize, &Vec<f64>)| self.0.jacobian(q).map_err(|error| at(error, index, count));
            list.iter().enumerate().map(one).collect::<Result<Vec<[Vec<f64>; 6]>, Error>>()
        })?;
        let flat: Vec<f64> = found.iter().flatten().flatten().copied().collect();
        Ok(stack(flat, (count, 6, self.0.freedoms()))?.into_pyarray(python))
    }

    fn body_poses<'py>(&self, python: Python<'py>, q: Vec<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let poses = guarded(|| self.0.body_poses(&q))?;
        Ok(rows(poses.as_flattened().to_vec(), 7)?.into_pyarray(python))
    }

    fn ik(&self, python: Python<'_>, pose: PyReadonlyArray2<'_, f64>) -> PyResult<Answer> {
        let pose = matrix(&pose);
        let solution = python.detach(|| {
            guarded(|| {
                let mut workspace = WORKSPACE.take().unwrap_or_default();
                let solution = self.0.ik_with(&pose, &mut workspace);
                WORKSPACE.set(Some(workspace));
                solution
            })
        })?;
        Ok(Answer { solution, freedoms: self.0.freedoms(), limited: !self.0.model.entry.limits.is_empty() })
    }

    /// Solves chunk by chunk; Ctrl-C ends it with what is done.
    fn ik_batch<'py>(&self, python: Python<'py>, poses: PyReadonlyArray3<'_, f64>) -> PyResult<Answers<'py>> {
        let view = poses.as_array();
        let list: Vec<Matrix> =
            view.outer_iter().map(|pose| std::array::from_fn(|i| std::array::from_fn(|j| pose[[i, j]]))).collect();
        let mut answers: Vec<Result<Solution, String>> = Vec::with_capacity(list.len());
        for chunk in list.chunks(CHUNK) {
            let solved = python.detach(|| self.chunk(chunk));
            answers.extend(solved);
            if python.check_signals().is_err() {
                break;
            }
        }
        answers.resize_with(list.len(), || Err("interrupted".to_owned()));
        self.gathered(python, &answers)
    }

    /// The document of `solve` at these poses.
    fn document(&self, python: Python<'_>, poses: PyReadonlyArray3<'_, f64>, complex: bool) -> PyResult<String> {
        let view = poses.as_array();
        let list: Vec<Matrix> =
            view.outer_iter().map(|pose| std::array::from_fn(|i| std::array::from_fn(|j| pose[[i, j]]))).collect();
        python.detach(|| {
            guarded(|| {
                let one = |(index, pose): (usize, &Matrix)| {
                    let case = self.0.case(pose).map_err(|error| at(error, index, list.len()))?;
                    let solution = self.0.model.solve(&case, complex)?;
                    Ok((case, solution))
                };
                let answers: Result<Vec<_>, Error> = list.iter().enumerate().map(one).collect();
                Ok(self.0.model.document(&answers?, complex).to_string())
            })
        })
    }

    /// The certificate of the answer to a pose.
    fn certificate(&self, python: Python<'_>, pose: PyReadonlyArray2<'_, f64>) -> PyResult<String> {
        let pose = matrix(&pose);
        python.detach(|| guarded(|| Ok(self.0.model.certificate(&self.0.case(&pose)?)?.to_string())))
    }

    /// The document of `derive` at a pose.
    fn derive(&self, python: Python<'_>, pose: PyReadonlyArray2<'_, f64>) -> PyResult<String> {
        let pose = matrix(&pose);
        python.detach(|| guarded(|| Ok(self.0.model.derive(&self.0.case(&pose)?)?.to_string())))
    }
}

impl Arm {
    /// A panic at one pose leaves the others of the chunk to be solved one by one.
    fn chunk(&self, chunk: &[Matrix]) -> Vec<Result<Solution, String>> {
        let text = |error: Error| error.to_string();
        if let Ok(found) = catch_unwind(AssertUnwindSafe(|| self.0.ik_batch(chunk))) {
            return found.into_iter().map(|answer| answer.map_err(text)).collect();
        }
        let one = |pose: &Matrix| match catch_unwind(AssertUnwindSafe(|| self.0.ik(pose))) {
            Ok(answer) => answer.map_err(text),
            Err(panic) => Err(panic_text(panic.as_ref())),
        };
        chunk.iter().map(one).collect()
    }

    fn gathered<'py>(&self, python: Python<'py>, answers: &[Result<Solution, String>]) -> PyResult<Answers<'py>> {
        let (mut q, mut offsets) = (Vec::new(), vec![0_i64]);
        let (mut certified, mut near, mut within) = (Vec::new(), Vec::new(), Vec::new());
        let (mut status, mut proof, mut dimensions) = (Vec::new(), Vec::new(), Vec::new());
        let errors = PyDict::new(python);
        let mut count = 0_i64;
        for (index, answer) in answers.iter().enumerate() {
            match answer {
                Ok(solution) => {
                    for mode in &solution.modes {
                        q.extend(mode.q.iter().map(|z| z.re));
                        certified.push(mode.certified);
                        near.push(mode.near);
                        within.push(mode.within_limits.map_or(-1, i8::from));
                        count += 1;
                    }
                    status.push(solution.verdict.status.word());
                    proof.push(solution.verdict.proof.word());
                    dimensions.push(i64::try_from(solution.verdict.self_motion).unwrap_or(0));
                }
                Err(text) => {
                    errors.set_item(index, text)?;
                    status.push("error");
                    proof.push("none");
                    dimensions.push(0);
                }
            }
            offsets.push(count);
        }
        Ok((
            rows(q, self.0.freedoms())?.into_pyarray(python),
            offsets.into_pyarray(python),
            certified.into_pyarray(python),
            near.into_pyarray(python),
            within.into_pyarray(python),
            status,
            proof,
            errors,
            dimensions.into_pyarray(python),
        ))
    }
}
