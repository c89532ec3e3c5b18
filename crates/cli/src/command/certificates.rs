//! The file of `--certificate`.

use looproot::internal::catalogue::entry::{Case, Entry};
use looproot::internal::catalogue::{LinkageCase, LinkageFile};
use looproot::internal::conditions::four_bar::FourBar;
use looproot::internal::derivation::Derivation;
use looproot::internal::error::Error;
use looproot::internal::linkage::answer::LinkageAnswer;
use looproot::internal::mechanism::Solution;
use looproot::internal::mobility::Mobility;
use looproot::internal::report::certificate::{
    certificate, certificate_of_conditions, certificate_of_linkage, certificate_of_motion, certificate_of_polynomial,
};
use looproot::internal::report::model::case_noun;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writer of certificates, one per line as they are found. The file is created with the first one.
pub struct Certificates {
    path: PathBuf,
    file: Option<BufWriter<File>>,
}

impl Certificates {
    pub fn new(path: &Path) -> Self {
        // What an earlier run wrote there is about another answer. That it cannot be removed is said where the file is written. Devices and
        // links to them stay.
        if std::fs::symlink_metadata(path).is_ok_and(|data| data.is_file()) {
            let _ = std::fs::remove_file(path);
        }
        Self { path: path.to_owned(), file: None }
    }

    /// Writes the certificate of an answer, or reports on stderr why there is none.
    pub fn add(&mut self, entry: &Entry, number: usize, case: &Case, solution: &Solution) -> Result<(), Error> {
        match certificate(entry, number, case, solution) {
            Ok(value) => self.write(&format!("{value}\n")),
            Err(reason) => {
                let noun = case_noun(entry);
                let _ = writeln!(std::io::stderr(), "note: no certificate of {noun} {number}: {reason}");
                Ok(())
            }
        }
    }

    /// Writes the certificate of an answer about a linkage, or reports on stderr why there is none.
    pub fn add_linkage(
        &mut self,
        file: &LinkageFile,
        number: usize,
        case: &LinkageCase,
        answer: &LinkageAnswer,
    ) -> Result<(), Error> {
        self.add_one(certificate_of_linkage(file, number, case, answer))
    }

    /// Writes the certificate of a closure polynomial, or reports on stderr why there is none.
    pub fn add_polynomial(
        &mut self,
        entry: &Entry,
        number: usize,
        case: &Case,
        derivation: &Derivation,
    ) -> Result<(), Error> {
        self.add_one(certificate_of_polynomial(entry, number, case, derivation))
    }

    /// Writes the certificate of the families of loops of four rotations, or reports on stderr why there is none.
    pub fn add_conditions(&mut self, theorem: &FourBar) -> Result<(), Error> {
        self.add_one(certificate_of_conditions(theorem))
    }

    /// Writes the certificate of the mobility of a loop, or reports on stderr why there is none.
    pub fn add_motion(&mut self, entry: &Entry, answer: &Mobility) -> Result<(), Error> {
        self.add_one(certificate_of_motion(entry, answer))
    }

    /// Writes the certificate that is found to a file of its own, or reports on stderr why there is none.
    pub fn write_one(
        path: Option<&PathBuf>,
        found: impl FnOnce() -> Result<serde_json::Value, String>,
    ) -> Result<(), Error> {
        let Some(path) = path else { return Ok(()) };
        let mut own = Self::new(path);
        own.add_one(found())?;
        own.close()
    }

    fn add_one(&mut self, certificate: Result<serde_json::Value, String>) -> Result<(), Error> {
        match certificate {
            Ok(value) => self.write(&format!("{value}\n")),
            Err(reason) => {
                report_none(&reason);
                Ok(())
            }
        }
    }

    fn write(&mut self, line: &str) -> Result<(), Error> {
        let fail = |error: std::io::Error| failed(&self.path, &error);
        if self.file.is_none() {
            self.file = Some(BufWriter::new(File::create(&self.path).map_err(fail)?));
        }
        let file = self.file.as_mut();
        file.map_or(Ok(()), |file| file.write_all(line.as_bytes())).map_err(|error| failed(&self.path, &error))
    }

    /// Flushes the file.
    pub fn close(&mut self) -> Result<(), Error> {
        let file = self.file.as_mut();
        file.map_or(Ok(()), Write::flush).map_err(|error| failed(&self.path, &error))
    }
}

/// Reports on stderr that a certificate that is asked for, in the file `path`, is not covered.
pub fn not_covered(path: Option<&PathBuf>, what: &str) {
    if path.is_some() {
        report_none(&format!("{what} are not covered"));
    }
}

fn report_none(reason: &str) {
    let _ = writeln!(std::io::stderr(), "note: no certificate: {reason}");
}

fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::Io { path: path.display().to_string(), message: error.to_string() }
}
