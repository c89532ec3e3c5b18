//! A mechanism that was read, and the documents that the command line prints of it.

use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::ansatz::Ansatz;
use crate::catalogue::entry::{Case, Design, Entry, Labels};
use crate::catalogue::{Any, Chains, Options, load, load_ansatz, load_any};
use crate::certificate::{Holds, check_all};
use crate::conditions::decide::decide;
use crate::conditions::number_field::decide_over_field;
use crate::conditions::{four_bar, search};
use crate::derivation::derive;
use crate::error::{Error, Result};
use crate::kinematics::joint::Variable;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::mechanism::{Mechanism, Solution};
use crate::report::sweep::Swept;
use crate::report::text::View;
use crate::report::{
    conditions as conditions_report, conditions_search, derivation, document, framework, json, linkage_mobility, scene,
};
use crate::scene::Stage;
use crate::sweep::{Range, sweep};
use serde_json::{Value, json};
use std::sync::OnceLock;

/// A mechanism, prepared when it is first solved. Threads share it.
pub struct Model {
    /// The file as it was read.
    pub entry: Entry,
    mechanism: OnceLock<Result<Mechanism>>,
}

impl Model {
    /// A mechanism that was read.
    #[must_use]
    pub fn new(entry: Entry) -> Self {
        Self { entry, mechanism: OnceLock::new() }
    }

    /// A mechanism without a file; it has no case.
    #[must_use]
    pub(super) fn bare(name: &str, design: Design, limits: Vec<[f64; 2]>, rounded: bool) -> Self {
        Self::new(Entry {
            name: name.to_owned(),
            title: name.to_owned(),
            source: None,
            notes: None,
            design,
            limits,
            platform_limits: PlatformLimits::default(),
            cases: Vec::new(),
            rounded,
            reading: crate::algebra::number::Reading::default(),
            labels: Labels::default(),
        })
    }

    /// Reads a file, or an entry of the library.
    ///
    /// # Errors
    /// As [`load`].
    pub fn load(name: &str, tip_link: Option<&str>, base_link: Option<&str>) -> Result<Self> {
        let (tip_link, base_link) = (tip_link.map(str::to_owned), base_link.map(str::to_owned));
        let options = Options { tip_link, base_link, chains: Chains::Swept, ..Options::default() };
        load(name, &options).map(Self::new)
    }

    /// Returns the prepared mechanism, which the first call prepares.
    ///
    /// # Errors
    /// As [`Mechanism::prepare`].
    pub fn mechanism(&self) -> Result<&Mechanism> {
        self.mechanism.get_or_init(|| Mechanism::prepare(&self.entry)).as_ref().map_err(Clone::clone)
    }

    /// The answer to one case.
    ///
    /// # Errors
    /// As [`Mechanism::solve`].
    pub fn solve(&self, case: &Case, complex: bool) -> Result<Solution> {
        let mut workspace = Workspace::default();
        workspace.only_real_list = !complex;
        let mechanism = self.mechanism()?;
        mechanism.solve(case, Roots::All, &mut workspace, &mut Assembly::default())
    }

    /// Returns the document of `solve --json --scene` for these answers.
    #[must_use]
    pub fn document(&self, answers: &[(Case, Solution)], complex: bool) -> Value {
        let view = View { complex, ..View::default() };
        let labels = document::labels(&self.entry);
        let stage = Stage::of(&self.entry);
        let mechanism = self.mechanism().ok().filter(|_| answers.len() == 1);
        let results = answers.iter().zip(1..).map(|((case, solution), number)| {
            let alone = mechanism.map(|mechanism| mechanism.alone(case, solution.clone()));
            let mut result = json::result(number, case, alone.as_ref().unwrap_or(solution), &labels, &view);
            if let Some(stage) = &stage {
                scene::pose_result(&mut result, stage);
            }
            result
        });
        let mut document = json!({ "title": self.entry.title, "kind": json::kind(self.entry.kind()) });
        document["results"] = results.collect();
        if let Some(stage) = &stage {
            document["scene"] = scene::json(&stage.scene);
        }
        document::complete(&mut document, &self.entry);
        document
    }

    /// Returns the document of `derive --json` for one case.
    ///
    /// # Errors
    /// As [`derive()`].
    pub fn derive(&self, case: &Case) -> Result<Value> {
        let derivation = derive(&self.entry, case)?;
        let mut document = derivation::json(&self.entry, 1, &derivation);
        document::complete(&mut document, &self.entry);
        Ok(document)
    }

    /// Returns the document of `sweep --json --scene`. `running` is called now and then and stops the sweep by returning false.
    ///
    /// # Errors
    /// As [`sweep`].
    pub fn sweep(
        &self,
        joint: usize,
        variable: Variable,
        range: Range,
        running: impl Fn() -> bool + Sync,
    ) -> Result<Value> {
        let found = sweep(&self.entry, joint, variable, range, running, || ())?;
        let mut document = crate::report::sweep::json(&self.entry, Swept { joint, variable }, &found);
        document::complete(&mut document, &self.entry);
        if let Some(stage) = Stage::of(&self.entry) {
            document["scene"] = scene::json(&stage.scene);
            scene::pose_sweep(&mut document, &stage);
        }
        Ok(document)
    }

    /// The certificate of the answer to one case: docs/certificate.md.
    ///
    /// # Errors
    /// As [`Mechanism::solve`], and [`Error::Unsupported`] with the reason for an answer of which there is no certificate.
    pub fn certificate(&self, case: &Case) -> Result<Value> {
        let of = |complex| {
            Ok::<_, Error>(crate::report::certificate::certificate(&self.entry, 1, case, &self.solve(case, complex)?))
        };
        let found = match of(true)? {
            // Real solutions may be proved to be all where complex ones are not.
            Err(reason) => of(false)?.map_err(|_| reason),
            found => found,
        };
        found.map_err(|reason| Error::Unsupported(format!("there is no certificate: {reason}")))
    }

    /// Returns the document of `mobility --json`.
    ///
    /// # Errors
    /// As [`crate::mobility::mobility`].
    pub fn mobility(&self) -> Result<Value> {
        let answer = crate::mobility::mobility(&self.entry)?;
        let mut document = crate::report::mobility::json(&self.entry, &answer);
        document::complete(&mut document, &self.entry);
        Ok(document)
    }
}

/// Returns the document of `mobility --json` for a file or an entry of the library, frameworks and linkages included.
///
/// # Errors
/// For a file or name that cannot be read, and for a file without a mechanism.
pub fn mobility(name: &str) -> Result<Value> {
    /// Number of steps, as on the command line, for which a motion is followed.
    const STEPS: usize = 60;
    match load_any(name, &Options { chains: Chains::Any, ..Options::default() })? {
        Any::Entry(entry) => Model::new(*entry).mobility(),
        Any::Framework(file) => Ok(framework::json(&file, &file.mobility(STEPS)?)),
        other => match linkage_mobility::ask(&other, name) {
            Some(asked) => Ok(linkage_mobility::json(&asked?)),
            None => {
                Err(Error::Invalid(other.kind().unexpected("a loop, an arm, a platform, a linkage or a framework")))
            }
        },
    }
}

/// Checks certificates, one a line, and compares their data with a file where one is named: a list of objects with `holds`,
/// `complex`, `real`, `self_motion`, `mobility` and `fault`.
///
/// # Errors
/// For text that is no certificate, and for a file that cannot be read.
pub fn verify(certificates: &str, file: Option<&str>) -> Result<Value> {
    let options = Options { chains: Chains::Any, ..Options::default() };
    let entry = file.map(|file| load_any(file, &options)).transpose()?;
    let mut found = Vec::new();
    let read = check_all(certificates, entry.as_ref(), |_, outcome| {
        let mut answer = json!({
            "holds": outcome.is_ok(),
            "complex": null,
            "real": null,
            "self_motion": null,
            "mobility": null,
            "fault": null,
        });
        match outcome {
            Ok(Holds::Solutions { complex, real } | Holds::Polynomial { complex, real }) => {
                answer["complex"] = json!(complex);
                answer["real"] = json!(real);
            }
            Ok(Holds::Real(real)) => answer["real"] = json!(real),
            Ok(Holds::OutOfReach) => answer["real"] = json!(0),
            Ok(Holds::SelfMotion) => answer["self_motion"] = json!(1),
            Ok(Holds::Families(_) | Holds::Branches { .. }) => {}
            Ok(Holds::Mobility(dimension)) => answer["mobility"] = json!(dimension),
            Err(fault) => answer["fault"] = json!(fault.to_string()),
        }
        found.push(answer);
    });
    read.map_err(|fault| Error::Invalid(fault.to_string()))?;
    Ok(Value::Array(found))
}

/// Returns the document of `conditions --json` for `4R`, `5R`, `6R`, a file or an entry of the library.
///
/// # Errors
/// For a file or name that cannot be read, and for loops whose conditions are out of reach.
pub fn conditions(name: &str) -> Result<Value> {
    /// The seed of the command line: the same question has the same answer.
    const SEED: u64 = 1;
    let ansatz = match name.to_ascii_uppercase().as_str() {
        "4R" => Ansatz::general(4),
        "5R" => Ansatz::general(5),
        "6R" => Ansatz::general(6),
        _ => load_ansatz(name, &Options::default())?,
    };
    if ansatz.joints.len() != 4 {
        let found = search::search(&ansatz, SEED)?;
        return Ok(conditions_search::json(&ansatz, &found));
    }
    let theorem = four_bar::derive();
    let chain = ansatz.chain.as_ref().filter(|_| ansatz.rounded);
    let decision = match chain.and_then(|chain| decide_over_field(&theorem, chain)) {
        Some(decision) => decision,
        None => decide(&theorem, &ansatz)?,
    };
    Ok(conditions_report::json(&theorem, &ansatz, &decision))
}
