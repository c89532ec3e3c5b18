//! `looproot derive` for linkages.

use super::arguments::DeriveOptions;
use super::discriminant::{self, Asked};
use super::exit::{Exit, Fault};
use super::linkage::{posed, wanted};
use super::output::Output;
use super::symbols;
use looproot::internal::catalogue::LinkageFile;
use looproot::internal::derivation::{
    LinkageDerivation, Watch, derive_linkage, derive_linkage_with_input, derive_linkage_with_symbols, trace,
    trace_mass, trace_with_symbols,
};
use looproot::internal::error::Error;
use looproot::internal::kinematics::linkage::{Accuracy, Gaussian, Given, Linkage};
use looproot::internal::linkage::cognates::{COUPLER, cognates};
use looproot::internal::report::{linkage_derivation as report, linkage_symbolic as symbolic};
use looproot::internal::sweep::LinkageCase;
use rug::Rational;

/// Derives the closure polynomials of the requested case, else of the first one, or the curve of a point.
pub fn run(options: &DeriveOptions, mechanism: &str, file: &LinkageFile) -> Result<Exit, Fault> {
    refuse(options)?;
    let file = &*posed(options.asked.input.as_deref(), file)?;
    let index = wanted(options.asked.input.as_deref(), file)?.start;
    let case = &file.cases[index];
    let line = case.given.first().map_or(case.line, Given::line);
    let in_place = |error: Error| error.at(mechanism, line);
    if let Some(names) = &options.discriminant {
        let asked = Asked {
            subject: LinkageCase::new(&file.linkage, file.exact, &case.given, case.accuracy),
            title: &file.heading.title,
            reading: &file.reading,
            place: &in_place,
            document: &|value| format!("{}\n", report::completed(file, index + 1, value)),
        };
        return discriminant::run(options, mechanism, &asked, names);
    }
    let (written, exit) = if let (true, Some(asked)) = (options.cognates, &options.trace) {
        let (body, _, place) = file.point(asked)?;
        let found = cognates(&file.linkage, body, &place).map_err(in_place)?;
        let curve = trace(&file.linkage, &case.given, body, &place, &Watch::none()).map_err(in_place)?;
        let equal = found.iter().map(|own| {
            let traced = own.bodies[COUPLER]
                .point("P")
                .ok_or_else(|| Error::Invalid("found no point of a cognate".to_owned()))?;
            Ok(trace(own, &[], COUPLER, traced, &Watch::none())?.polynomial == curve.polynomial)
        });
        let equal: Vec<bool> = equal.collect::<Result<_, Error>>()?;
        let written = if options.json {
            format!("{}\n", report::cognates_json(file, index + 1, (asked, &curve), &found, &equal))
        } else {
            report::cognates_text(file, (asked, &curve), &found, &equal)
        };
        (written, if file.exact && equal.iter().all(|is_equal| *is_equal) { Exit::Complete } else { Exit::NotProved })
    } else if let (Some(asked), Some(list)) = (&options.trace, &options.symbolic) {
        curve_with_symbols(options, (file, index), asked, list, &in_place)?
    } else if let Some(asked) = &options.trace {
        let (name, point, derived) = if asked == "mass" {
            let masses = masses(file)?;
            let derived = symbols::watched(options, |watch| trace_mass(&file.linkage, &case.given, &masses, watch));
            ("mass", "centre", derived)
        } else {
            let (body, point, place) = file.point(asked)?;
            let derived = symbols::watched(options, |watch| trace(&file.linkage, &case.given, body, &place, watch));
            (file.linkage.bodies[body].name.as_str(), point, derived)
        };
        let curve = derived.map_err(in_place)?;
        let written = if options.json {
            format!("{}\n", report::curve_json(file, index + 1, name, point, &curve))
        } else if options.quiet {
            report::curve_verdict(asked, &curve) + "\n"
        } else {
            report::curve_text(file, asked, &curve)
        };
        // Comparison at values drawn at random is no proof.
        (written, if curve.compared.is_none() && file.exact { Exit::Complete } else { Exit::NotProved })
    } else if let Some(list) = &options.symbolic {
        let names = symbols::names(list);
        let derived =
            symbols::watched(options, |watch| derive_linkage_with_symbols(&file.linkage, &case.given, &names, watch));
        let found = derived.map_err(in_place)?;
        let written = if options.json {
            format!("{}\n", symbolic::json(file, index + 1, &found))
        } else if options.quiet {
            symbolic::verdict(file, &found) + "\n"
        } else {
            symbolic::text(file, &found)
        };
        // Comparison at values drawn at random is no proof.
        let is_proved = found.compared.is_none() && file.exact;
        (written, if is_proved { Exit::Complete } else { Exit::NotProved })
    } else {
        let derivation = derived(options, &file.linkage, &case.given).map_err(in_place)?;
        let written = if let Some(format) = options.format {
            report::system(file, index + 1, &derivation, format)?
        } else if options.json {
            format!("{}\n", report::json(file, index + 1, &derivation))
        } else if options.quiet {
            report::verdict(file, &derivation) + "\n"
        } else {
            report::text(file, case, index + 1, &derivation)
        };
        let best = derivation.polynomials.first();
        let is_exact = file.accuracy(case) == Accuracy::Exact;
        let exit = match best {
            Some(best) if best.is_proved() && is_exact => {
                let is_reached = best.at_pi > 0 || !best.coefficients.real_roots().is_empty();
                if is_reached { Exit::Complete } else { Exit::Unreachable }
            }
            _ => Exit::NotProved,
        };
        (written, exit)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit)
}

/// Derives the closure polynomials, and of gears the relation of input and output where it is written.
fn derived(options: &DeriveOptions, linkage: &Linkage, given: &[Given]) -> Result<LinkageDerivation, Error> {
    if options.quiet || linkage.joints.iter().all(|joint| !joint.is_gear()) {
        return derive_linkage(linkage, given);
    }
    symbols::watched(options, |watch| derive_linkage_with_input(linkage, given, watch))
}

/// Derives the curve of a point with symbols.
fn curve_with_symbols(
    options: &DeriveOptions,
    (file, index): (&LinkageFile, usize),
    asked: &str,
    list: &str,
    in_place: &dyn Fn(Error) -> Error,
) -> Result<(String, Exit), Fault> {
    let (body, name, _) = file.point(asked)?;
    let point = file.linkage.bodies[body].points.iter().position(|(own, _)| own == name);
    let point = point.ok_or_else(|| Error::Invalid(format!("found no point {asked}, expected one of the file")))?;
    let (given, names) = (&file.cases[index].given, symbols::names(list));
    let derived =
        symbols::watched(options, |watch| trace_with_symbols(&file.linkage, given, (body, point), &names, watch));
    let found = derived.map_err(in_place)?;
    let written = if options.json {
        format!("{}\n", symbolic::curve_json(file, index + 1, (&file.linkage.bodies[body].name, name), &found))
    } else if options.quiet {
        symbolic::curve_verdict(asked, &found) + "\n"
    } else {
        symbolic::curve_text(file, asked, &found)
    };
    let is_proved = found.compared.is_none() && file.exact;
    Ok((written, if is_proved { Exit::Complete } else { Exit::NotProved }))
}

/// Returns the bodies with a mass, their centres and masses.
fn masses(file: &LinkageFile) -> Result<Vec<(usize, Gaussian, Rational)>, Error> {
    let mut list = Vec::new();
    for (body, mass) in file.masses.bodies.iter().enumerate() {
        let Some(mass) = mass else { continue };
        let (weight, centre) = mass.exact.clone().ok_or_else(|| {
            let name = &file.linkage.bodies[body].name;
            Error::Unsupported(format!("the curve of a centre of mass with numbers of {name} that are not rational"))
        })?;
        list.push((body, centre, weight));
    }
    Ok(list)
}

/// Refuses the options that linkages do not have.
pub fn refuse(options: &DeriveOptions) -> Result<(), Error> {
    let is_other = options.trace.is_some() || options.symbolic.is_some() || options.cognates;
    let found = [
        (options.format.is_some() && is_other, "--format with --trace, --symbolic or --cognates"),
        (options.explain.is_some(), "--explain"),
        (options.transference, "--transference"),
        (options.by.is_some(), "--by"),
    ];
    match found.iter().find(|(is_there, _)| *is_there) {
        Some((_, option)) => Err(Error::Unsupported(format!("found {option} for a linkage, which has none yet"))),
        None => Ok(()),
    }
}
