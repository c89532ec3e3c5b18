//! `looproot conditions`

use super::arguments::ConditionsOptions;
use super::certificates::Certificates;
use super::exit::{Exit, Fault};
use super::output::Output;
use super::seed::plant;
use looproot::internal::catalogue::ansatz::Ansatz;
use looproot::internal::catalogue::load_ansatz;
use looproot::internal::conditions::decide::{Decision, decide};
use looproot::internal::conditions::four_bar::{FourBar, derive};
use looproot::internal::conditions::number_field::decide_over_field;
use looproot::internal::error::{Error, Result};
use looproot::internal::report::conditions::{json, markdown, proof, system, text, verdict};
use looproot::internal::report::document::complete_ansatz;
use looproot::internal::report::json::tenths;
use looproot::internal::report::number::duration;
use looproot_algebra::drawn::seed_used;
use std::time::Instant;

/// Derives the conditions on the parameters for a loop to move.
pub fn run(options: &ConditionsOptions) -> std::result::Result<Exit, Fault> {
    plant(options.seed);
    if options.certificate.is_some() && !options.mechanism.eq_ignore_ascii_case("4R") {
        let message = format!(
            "found --certificate with {}, expected 4R: others have no certificate of conditions yet",
            options.mechanism
        );
        return Err(Error::Unsupported(message).into());
    }
    let ansatz = read(options)?;
    match ansatz.joints.len() {
        4 => {}
        5 | 6 => return super::conditions_search::run(options, &ansatz),
        count => {
            return Err(Error::Unsupported(format!("conditions of a loop of {count} joints: only of 4 to 6")).into());
        }
    }
    let start = Instant::now();
    let theorem = derive();
    let derived = start.elapsed().as_secs_f64() * 1e6;
    if let Some(path) = &options.certificate {
        let mut certificates = Certificates::new(path);
        certificates.add_conditions(&theorem)?;
        certificates.close()?;
    }
    // Irrational numbers are kept exactly if one field holds them all.
    let chain = ansatz.chain.as_ref().filter(|_| ansatz.rounded);
    let decision = match chain.and_then(|chain| decide_over_field(&theorem, chain)) {
        Some(decision) => decision,
        None => decide(&theorem, &ansatz)?,
    };
    let decided = start.elapsed().as_secs_f64() * 1e6 - derived;
    let written = if options.json {
        let mut document = json(&theorem, &ansatz, &decision);
        complete_ansatz(&mut document, &ansatz, seed_used());
        document["timings_us"] = serde_json::json!({ "derive": tenths(derived), "decide": tenths(decided) });
        format!("{document}\n")
    } else if let Some(format) = options.format {
        system(&decision, options.family.as_deref(), format)?
    } else if options.explain {
        markdown(&theorem, &ansatz, &decision)?
    } else if options.quiet {
        verdict(&theorem, &ansatz, &decision) + "\n"
    } else {
        let times = format!("derived and proved in {}, applied in {}", duration(derived), duration(decided));
        format!("{}\n{times}\n", text(&theorem, &ansatz, &decision))
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(exit(&theorem, &ansatz, &decision))
}

/// Reads `4R`, `5R`, `6R`, or a file.
fn read(options: &ConditionsOptions) -> Result<Ansatz> {
    match options.mechanism.to_ascii_uppercase().as_str() {
        "4R" => Ok(Ansatz::general(4)),
        "5R" => Ok(Ansatz::general(5)),
        "6R" => Ok(Ansatz::general(6)),
        _ => load_ansatz(&options.mechanism, &options.read.options()),
    }
}

/// Returns the exit code; a proof that nothing moves counts like one that there is no real solution.
fn exit(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> Exit {
    if !proof(theorem, ansatz, decision).is_proved() {
        return Exit::NotProved;
    }
    if ansatz.empty().is_some() {
        return Exit::Unreachable;
    }
    if decision.families.is_empty() { Exit::Unreachable } else { Exit::Complete }
}
