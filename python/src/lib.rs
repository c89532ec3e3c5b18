//! The functions that Python calls. They take arrays and return arrays, or the documents of the command line as JSON; users see
//! the package above them.

mod answers;
mod arm;
mod closed;
mod faults;
mod linkage;

use looproot::internal::face;
use pyo3::prelude::*;

/// The private module of the package `looproot`.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let python = module.py();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("UnsupportedError", python.get_type::<faults::UnsupportedError>())?;
    module.add("InternalError", python.get_type::<faults::InternalError>())?;
    module.add_class::<arm::Arm>()?;
    module.add_class::<closed::Loop>()?;
    module.add_class::<closed::Platform>()?;
    module.add_class::<linkage::Linkage>()?;
    module.add_function(wrap_pyfunction!(robots, module)?)?;
    module.add_function(wrap_pyfunction!(mobility, module)?)?;
    module.add_function(wrap_pyfunction!(conditions, module)?)?;
    module.add_function(wrap_pyfunction!(verify, module)?)?;
    module.add_function(wrap_pyfunction!(page, module)?)?;
    module.add_function(wrap_pyfunction!(kind, module)?)?;
    Ok(())
}

/// The names of the library.
#[pyfunction]
fn robots() -> Vec<String> {
    looproot::internal::catalogue::all_names()
}

/// Arm, loop, platform or linkage: what a file or a name is.
#[pyfunction]
fn kind(name: &str, tip_link: Option<&str>, base_link: Option<&str>) -> PyResult<&'static str> {
    faults::guarded(|| {
        if face::Linkage::from_file(name).is_ok() {
            return Ok("linkage");
        }
        let model = face::Model::load(name, tip_link, base_link)?;
        Ok(looproot::internal::report::json::kind(model.entry.kind()))
    })
}

/// The document of `mobility`.
#[pyfunction]
fn mobility(python: Python<'_>, name: &str) -> PyResult<String> {
    python.detach(|| faults::guarded(|| face::mobility(name).map(|document| document.to_string())))
}

/// The document of `conditions`.
#[pyfunction]
fn conditions(python: Python<'_>, name: &str) -> PyResult<String> {
    python.detach(|| faults::guarded(|| face::conditions(name).map(|document| document.to_string())))
}

/// Checks certificates and returns a result for each line.
#[pyfunction]
fn verify(python: Python<'_>, certificates: &str, file: Option<&str>) -> PyResult<String> {
    python.detach(|| faults::guarded(|| face::verify(certificates, file).map(|found| found.to_string())))
}

/// The page of a document, or its figures.
#[pyfunction]
fn page(python: Python<'_>, document: &str, svg: bool) -> PyResult<String> {
    python.detach(|| {
        faults::guarded(|| {
            let fault = |fault: serde_json::Error| {
                looproot::internal::error::Error::Invalid(format!("found text that is no document: {fault}"))
            };
            let mut document = serde_json::from_str(document).map_err(fault)?;
            looproot::internal::view::drawable(&mut document)?;
            Ok(if svg {
                looproot::internal::view::figures(&document)
            } else {
                looproot::internal::view::page(&document, None)
            })
        })
    })
}
