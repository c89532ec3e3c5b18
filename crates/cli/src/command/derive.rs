//! `looproot derive`

use super::arguments::{CaseOptions, DeriveOptions};
use super::bless;
use super::certificates::{Certificates, not_covered};
use super::discriminant::{self, Asked};
use super::exit::{Exit, Fault, unexpected};
use super::output::Output;
use super::seed::plant;
use super::symbols;
use super::wanted::{in_place, wanted};
use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::catalogue::{Any, Chains, Options, SpaceFile, load_solvable};
use looproot::internal::derivation::{
    Derivation, RingDerivation, RingSymbolic, Way, derive_by, derive_in_space, derive_in_space_with_symbols,
    derive_with_symbols, surface, trace_in_space,
};
use looproot::internal::error::Error;
use looproot::internal::linkage::space;
use looproot::internal::report::derivation::{json, paper, system, text, verdict};
use looproot::internal::report::document::complete;
use looproot::internal::report::json::kind;
use looproot::internal::report::{self, ring_curve, ring_derivation as ring, surface as surfaces, symbolic, ways};
use looproot::internal::sweep::{EntryCase, SpaceCase, derive_any};
use looproot_algebra::number::{Number, Quantity};
use rug::Rational;
use serde_json::{Value, json};

/// Derives closure equations and closure polynomial of the requested case, else of the first one.
pub fn run(options: &DeriveOptions) -> Result<Exit, Fault> {
    if options.bless {
        return bless::run(&options.mechanisms, options.quiet);
    }
    if options.atlas {
        return bless::table(&options.mechanisms);
    }
    let [mechanism] = options.mechanisms.as_slice() else {
        let message = format!("found {} mechanisms, expected one, or --bless", options.mechanisms.len());
        return Err(Error::Invalid(message).into());
    };
    if options.transference {
        return super::transference::run(options, mechanism);
    }
    plant(options.seed);
    // Points of an arm move without a pose.
    let chains = if options.trace.is_some() { Chains::Swept } else { options.asked.chains() };
    let read = Options { chains, ..options.read.options() };
    let entry = match load_solvable(mechanism, &read)? {
        Any::Entry(entry) if !options.cognates => *entry,
        Any::Linkage(file) => {
            not_covered(options.certificate.as_ref(), "closure polynomials of linkages");
            return super::linkage_derive::run(options, mechanism, &file);
        }
        _ if options.cognates => {
            let message = "found --cognates, expected it for a four-bar in the plane";
            return Err(Error::Invalid(message.to_owned()).into());
        }
        Any::Sphere(file) => {
            not_covered(options.certificate.as_ref(), "closure polynomials of linkages");
            return super::sphere::derive(options, mechanism, &file);
        }
        Any::Space(file) => {
            if let Some(entry) = platform_of(options, mechanism, &file)? {
                // The case of the linkage was chosen before.
                let asked = CaseOptions { input: None, ..options.asked.clone() };
                return of_entry(options, &asked, mechanism, entry);
            }
            not_covered(options.certificate.as_ref(), "closure polynomials of linkages");
            return in_space(options, mechanism, &file);
        }
        other => return Err(unexpected(mechanism, other.kind(), "an arm, a loop, a platform or a linkage")),
    };
    if let Some(asked) = &options.trace {
        if options.symbolic.is_some() {
            let message = "found --symbolic with --trace of an arm, expected it for a point of a linkage in the plane";
            return Err(Error::Unsupported(message.to_owned()).into());
        }
        return traced(options, mechanism, &entry, asked);
    }
    of_entry(options, &options.asked, mechanism, entry)
}

/// Returns the platform that the case of a linkage in space is; `None` of other linkages, and where the curve of a point is asked for.
fn platform_of(options: &DeriveOptions, mechanism: &str, file: &SpaceFile) -> Result<Option<Entry>, Error> {
    if options.trace.is_some() {
        return Ok(None);
    }
    let file = &*super::space::posed(options.asked.input.as_deref(), file)?;
    let index = super::space::wanted(options.asked.input.as_deref(), file)?.start;
    let case = &file.cases[index];
    space::platform_of(file, case).map_err(|error| error.at(mechanism, case.line))
}

/// Derives the closure polynomial of an arm, a loop or a platform, or prints its cells.
fn of_entry(options: &DeriveOptions, asked: &CaseOptions, mechanism: &str, mut entry: Entry) -> Result<Exit, Fault> {
    let whole = entry.clone();
    let index = wanted(asked, mechanism, &mut entry)?.start;
    let case = &entry.cases[index];
    if let Some(names) = &options.discriminant {
        let asked = Asked {
            subject: EntryCase::new(&entry, case),
            title: &entry.title,
            reading: &entry.reading,
            place: &|error| in_place(error, mechanism, &entry),
            document: &|mut value| {
                value["title"] = json!(entry.title);
                value["kind"] = json!(kind(entry.kind()));
                value["case"] = json!(index + 1);
                document(value, &whole)
            },
        };
        return discriminant::run(options, mechanism, &asked, names);
    }
    if let Some(way) = options.by {
        return by(options, mechanism, &whole, (&entry, index), way);
    }
    let (written, exit) = if let Some(list) = &options.symbolic {
        let names = symbols::names(list);
        let derived = symbols::watched(options, |watch| derive_with_symbols(&entry, case, &names, watch));
        let derivation = derived.map_err(|error| in_place(error, mechanism, &entry))?;
        let written = if options.json {
            document(symbolic::json(&entry, index + 1, &derivation), &whole)
        } else if let Some(format) = options.format {
            symbolic::system(&entry, index + 1, &derivation, format)?
        } else if let Some(style) = options.explain {
            symbolic::paper(&entry, index + 1, &derivation, &derivation.substituted(&entry, case)?, style)
        } else if options.quiet {
            symbolic::verdict(&derivation) + "\n"
        } else {
            symbolic::text(&derivation)
        };
        (written, if derivation.proved { Exit::Complete } else { Exit::NotProved })
    } else {
        let derivation = derive_any(&entry, case).map_err(|error| in_place(error, mechanism, &entry))?;
        certify(options, (&entry, index), &derivation)?;
        let written = if options.json {
            document(json(&entry, index + 1, &derivation), &whole)
        } else if let Some(format) = options.format {
            system(&entry, index + 1, &derivation, format)?
        } else if let Some(style) = options.explain {
            paper(&entry, index + 1, &derivation, &derivation.substituted(&entry, case)?, style)
        } else if options.quiet {
            verdict(&derivation) + "\n"
        } else {
            text(&derivation)
        };
        let unknowns = 6 + case.input.len();
        let is_overconstrained = matches!(&entry.design, Design::Loop(chain) if chain.freedoms() < unknowns);
        let exit = match exit(&derivation) {
            // Isolated configurations need not be roots.
            Exit::Unreachable if is_overconstrained => Exit::NotProved,
            exit => exit,
        };
        (written, exit)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit)
}

/// Writes the certificate that is asked for.
fn certify(options: &DeriveOptions, (entry, index): (&Entry, usize), derivation: &Derivation) -> Result<(), Fault> {
    if let Some(path) = &options.certificate {
        let mut certificates = Certificates::new(path);
        certificates.add_polynomial(entry, index + 1, &entry.cases[index], derivation)?;
        certificates.close()?;
    }
    Ok(())
}

/// Derives the closure polynomials of a linkage in space, or prints its cells.
fn in_space(options: &DeriveOptions, mechanism: &str, file: &SpaceFile) -> Result<Exit, Fault> {
    let file = &*super::space::posed(options.asked.input.as_deref(), file)?;
    let index = super::space::wanted(options.asked.input.as_deref(), file)?.start;
    let place = |error: Error| error.at(mechanism, file.cases[index].line);
    if let Some(names) = &options.discriminant {
        let asked = Asked {
            subject: SpaceCase::new(file, index),
            title: &file.heading.title,
            reading: &file.reading,
            place: &place,
            document: &|value| format!("{}\n", report::space::completed(file, index + 1, value)),
        };
        return discriminant::run(options, mechanism, &asked, names);
    }
    super::linkage_derive::refuse(options)?;
    let named = ring::Named::in_space(file, index + 1);
    if let Some(asked) = &options.trace {
        if options.symbolic.is_some() {
            let message = "found --symbolic with --trace of a linkage in space, whose curves have no symbols yet";
            return Err(Error::Unsupported(message.to_owned()).into());
        }
        let (body, point, at) = file.point(asked)?;
        let given = &file.cases[index].given;
        let derived = symbols::watched(options, |watch| trace_in_space(&file.linkage, given, body, &at, watch));
        let curve = derived.map_err(place)?;
        let written = if options.json {
            format!("{}\n", ring_curve::json(&named, (&file.linkage.bodies[body].name, point), &curve))
        } else if options.quiet {
            ring_curve::verdict(asked, &curve) + "\n"
        } else {
            ring_curve::text(&named, asked, &curve)
        };
        Output::write(&options.output, mechanism, &written)?;
        return Ok(Exit::NotProved);
    }
    if let Some(list) = &options.symbolic {
        let names = symbols::names(list);
        let derived = symbols::watched(options, |watch| derive_in_space_with_symbols(file, index, &names, watch));
        let found = derived.map_err(place)?;
        return with_symbols(options, mechanism, &named, &found);
    }
    let case = &file.cases[index];
    let derivation = derive_in_space(&file.linkage, &case.given).map_err(place)?;
    let written = if let Some(format) = options.format {
        ring::system(&named, &derivation, format)?
    } else if options.json {
        format!("{}\n", ring::json(&named, &derivation))
    } else if options.quiet {
        ring::verdict(&named, &derivation) + "\n"
    } else {
        ring::text(&named, &derivation)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit_of_ring(&derivation, file.exact && case.exact))
}

/// Writes a closure polynomial with symbols of a linkage in space or on the sphere: compared at values drawn at random, it has no proof.
pub fn with_symbols(
    options: &DeriveOptions,
    mechanism: &str,
    named: &ring::Named<'_>,
    found: &RingSymbolic,
) -> Result<Exit, Fault> {
    let written = if options.json {
        format!("{}\n", ring::symbolic_json(named, found))
    } else if options.quiet {
        ring::symbolic_verdict(named, found) + "\n"
    } else {
        ring::symbolic_text(named, found)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(Exit::NotProved)
}

/// Returns the exit code of a linkage in space or on the sphere whose numbers are exact or not: a group without a real root has no real
/// assembly.
pub fn exit_of_ring(derivation: &RingDerivation, is_exact: bool) -> Exit {
    let groups = &derivation.polynomials;
    let is_proved = derivation.warnings.is_empty() && groups.iter().all(|one| one.distinct.is_some());
    if !(is_proved && is_exact) {
        Exit::NotProved
    } else if groups.iter().all(|one| one.real_roots() > 0) {
        Exit::Complete
    } else {
        Exit::Unreachable
    }
}

/// Derives the closure polynomial by one elimination.
fn by(
    options: &DeriveOptions,
    mechanism: &str,
    whole: &Entry,
    (entry, index): (&Entry, usize),
    way: Way,
) -> Result<Exit, Fault> {
    let case = &entry.cases[index];
    let found = derive_by(entry, case, way).map_err(|error| in_place(error, mechanism, entry))?;
    let written = if options.json {
        document(ways::json(entry, index + 1, &found), whole)
    } else if let Some(format) = options.format {
        system(entry, index + 1, &found.derivation, format)?
    } else if let Some(style) = options.explain {
        ways::paper(entry, index + 1, &found, &found.derivation.substituted(entry, case)?, style)
    } else if options.quiet {
        ways::verdict(&found) + "\n"
    } else {
        ways::text(&found)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit(&found.derivation))
}

/// Derives the surface of a point of the tool of an arm of two variables.
fn traced(options: &DeriveOptions, mechanism: &str, entry: &Entry, asked: &str) -> Result<Exit, Fault> {
    let Design::Arm(chain) = &entry.design else {
        let expected = "a linkage, or an arm of two joint variables, whose points have curves or surfaces";
        return Err(unexpected(mechanism, entry.kind().into(), expected));
    };
    let point = if asked.trim() == "tool" {
        std::array::from_fn(|_| Rational::new())
    } else {
        let numbers = asked.split(',').map(|part| Number::parse(part.trim(), Quantity::Length, &entry.reading));
        let numbers =
            numbers.map(|number| number.map(|number| number.rational().clone()).ok()).collect::<Option<Vec<_>>>();
        let point = numbers.and_then(|numbers| <[Rational; 3]>::try_from(numbers).ok());
        point.ok_or_else(|| {
            Error::Invalid(format!(
                "found --trace \"{asked}\" for an arm, expected `tool` or the point \"x, y, z\" in its frame"
            ))
        })?
    };
    let found = surface(chain, &point).map_err(|error| in_place(error, mechanism, entry))?;
    let written = if options.json {
        document(surfaces::json(entry, asked, &found), entry)
    } else if options.quiet {
        surfaces::verdict(asked, &found) + "\n"
    } else {
        surfaces::text(entry, asked, &found)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(if entry.rounded { Exit::NotProved } else { Exit::Complete })
}

/// Returns a document with the keys common to all documents.
pub fn document(mut value: Value, entry: &Entry) -> String {
    complete(&mut value, entry);
    format!("{value}\n")
}

/// Returns the exit code: without a polynomial nothing is proved; without a real root nothing is reached.
fn exit(derivation: &Derivation) -> Exit {
    match &derivation.polynomial {
        None => Exit::NotProved,
        Some(_) if !derivation.proved => Exit::NotProved,
        Some(polynomial) if polynomial.roots.is_empty() && polynomial.at_pi == 0 => Exit::Unreachable,
        Some(_) => Exit::Complete,
    }
}
