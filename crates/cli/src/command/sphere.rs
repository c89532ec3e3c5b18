//! `looproot solve`, `looproot derive` and `looproot sweep` for linkages on the sphere.

use super::arguments::{DeriveOptions, SolveOptions, SweepOptions};
use super::certificates::Certificates;
use super::discriminant::{self, Asked};
use super::exit::{Exit, Fault};
use super::linkage::{code, refuse_beside_plane, written};
use super::output::{Output, pool};
use super::space_instant::on_sphere;
use super::sweep::{judged, range};
use super::symbols;
use looproot::internal::catalogue::SphereFile;
use looproot::internal::derivation::{
    SphereTrace, derive_on_sphere, derive_on_sphere_with_symbols, sphere_with_symbols, trace_on_sphere, transfer,
};
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::linkage::sphere::solve;
use looproot::internal::report::certificate::certificate_of_sphere_sweep;
use looproot::internal::report::linkage::headline;
use looproot::internal::report::ratio::Ratio;
use looproot::internal::report::sphere as report;
use looproot::internal::report::sphere_sweep as sweeps;
use looproot::internal::report::{axodes, ring_derivation as ring};
use looproot::internal::sweep::{SphereCase, sweep_sphere};
use looproot::internal::view::drawable;
use std::borrow::Cow;
use std::io::Write;

/// Returns the file, with the case of `--input JOINT=VALUE` instead of its own if that is given.
pub fn posed<'f>(input: Option<&str>, file: &'f SphereFile) -> Result<Cow<'f, SphereFile>, Error> {
    match input {
        Some(text) if text.contains('=') => {
            Ok(Cow::Owned(SphereFile { cases: vec![file.case_with(text)?], ..file.clone() }))
        }
        _ => Ok(Cow::Borrowed(file)),
    }
}

/// Returns the requested cases: all, or the one of `--input`.
pub fn wanted(input: Option<&str>, file: &SphereFile) -> Result<std::ops::Range<usize>, Error> {
    let Some(asked) = input else { return Ok(0..file.cases.len()) };
    if asked.contains('=') {
        return Ok(0..1);
    }
    match asked.trim().parse::<usize>() {
        Ok(number) if (1..=file.cases.len()).contains(&number) => Ok(number - 1..number),
        _ => {
            let count = file.cases.len();
            let message = format!(
                "found --input {asked}, expected JOINT=VALUE or the number of an input of the file, 1 to {count}"
            );
            Err(Error::Invalid(message))
        }
    }
}

/// Finds every assembly of every case, or of the requested one.
pub fn run(options: &SolveOptions, file: &SphereFile, output: Output) -> Result<Exit, Fault> {
    refuse_beside_plane(options)?;
    let mut output = output;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    let file = &*posed(options.asked.input.as_deref(), file)?;
    for index in wanted(options.asked.input.as_deref(), file)? {
        let case = &file.cases[index];
        let line = case.given.first().map_or(case.line, |given| given.line);
        let answer = solve(&file.linkage, &case.given, file.exact && case.exact)
            .map_err(|error| error.at(&options.mechanism, line))?;
        exit = exit.max(code(&answer.verdict));
        if options.json || options.jsonl {
            let result = report::result(file, case, index + 1, &answer, options.complex);
            if options.jsonl && !options.scene {
                writeln!(output.writer, "{result}")?;
            } else {
                results.push(result);
            }
        } else if options.quiet {
            writeln!(output.writer, "{}", headline(&answer.verdict))?;
        } else {
            let gap = if index > 0 && options.asked.input.is_none() { "\n" } else { "" };
            write!(output.writer, "{gap}{}", report::text(file, case, index + 1, &answer, options.complex))?;
        }
    }
    if options.json || options.scene {
        written(options, report::json(file, &results), &mut output)?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Derives the transfer function of the joint that is given, or the curve of a point.
pub fn derive(options: &DeriveOptions, mechanism: &str, file: &SphereFile) -> Result<Exit, Fault> {
    super::linkage_derive::refuse(options)?;
    if options.symbolic.is_some() && options.trace.is_some() {
        let message = "found --symbolic with --trace of a linkage on the sphere, whose curves have no symbols yet";
        return Err(Error::Unsupported(message.to_owned()).into());
    }
    let file = &*posed(options.asked.input.as_deref(), file)?;
    let index = wanted(options.asked.input.as_deref(), file)?.start;
    let case = &file.cases[index];
    let in_place = |error: Error| error.at(mechanism, case.line);
    if let Some(names) = &options.discriminant {
        let asked = Asked {
            subject: SphereCase::new(&file.linkage, &case.given, [file.exact, case.exact]),
            title: &file.heading.title,
            reading: &file.reading,
            place: &in_place,
            document: &|value| format!("{}\n", report::completed(file, index + 1, value)),
        };
        return discriminant::run(options, mechanism, &asked, names);
    }
    let names = options.symbolic.as_deref().map(symbols::names).unwrap_or_default();
    // Given joints, and sides as crank.A.B; the transfer function has names of its own for these, without dots.
    let is_interpolated = |name: &String| {
        let is_named = |joint: usize| file.linkage.joints[joint].name == *name;
        name.contains('.') || case.given.iter().any(|one| one.joint.is_some_and(is_named))
    };
    if names.iter().any(is_interpolated) {
        let derived = symbols::watched(options, |watch| derive_on_sphere_with_symbols(file, index, &names, watch));
        let found = derived.map_err(in_place)?;
        return super::derive::with_symbols(options, mechanism, &ring::Named::on_sphere(file, index + 1), &found);
    }
    let (written, exit) = if let Some(asked) = &options.trace {
        let (body, point, place) = file.point(asked)?;
        let derived =
            symbols::watched(options, |watch| trace_on_sphere(&file.linkage, &case.given, body, &place, watch));
        let found = derived.map_err(in_place)?;
        let written = if options.json {
            let name = (file.linkage.bodies[body].name.as_str(), point);
            format!("{}\n", report::trace_json(file, index + 1, name, &found))
        } else if options.quiet {
            report::trace_verdict(asked, &found) + "\n"
        } else {
            report::trace_text(file, index + 1, asked, &found)
        };
        // Comparison at values drawn at random is no proof.
        (written, matches!(found, SphereTrace::Sections(_)).then_some(Exit::NotProved))
    } else {
        relation(options, file, index, &names).map_err(in_place)?
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit.unwrap_or(if file.exact { Exit::Complete } else { Exit::NotProved }))
}

/// Writes the transfer function of the joint that is given, with numbers or with symbols, and the closure polynomial of the case with the exit
/// code that this has.
fn relation(
    options: &DeriveOptions,
    file: &SphereFile,
    index: usize,
    names: &[String],
) -> Result<(String, Option<Exit>), Error> {
    let case = &file.cases[index];
    let given = case.given.iter().find_map(|given| given.joint);
    let ground = file.linkage.joints.iter().position(|joint| joint.of.contains(&file.linkage.ground));
    let input =
        given.or(ground).ok_or_else(|| Error::Invalid("found no joint at the ground, expected one".to_owned()))?;
    if options.symbolic.is_some() {
        let found = sphere_with_symbols(&file.linkage, input, names)?;
        let written = if options.json {
            format!("{}\n", report::symbolic_json(file, index + 1, &found))
        } else if options.quiet {
            report::symbolic_verdict(&found) + "\n"
        } else {
            report::symbolic_text(file, &found)
        };
        return Ok((written, None));
    }
    let transferred = transfer(&file.linkage, input);
    let named = ring::Named::on_sphere(file, index + 1);
    // Without a given joint there is no closure polynomial, but a curve of assemblies.
    let derived = if case.given.is_empty() { None } else { derive_on_sphere(&file.linkage, &case.given).ok() };
    let Some(derived) = derived else {
        if options.format.is_some() {
            let message = "--format of a linkage on the sphere without a given joint, which has no closure polynomial";
            return Err(Error::Unsupported(message.to_owned()));
        }
        let found = transferred?;
        let written = if options.json {
            format!("{}\n", report::transfer_json(file, index + 1, &found))
        } else if options.quiet {
            report::transfer_verdict(file, &found) + "\n"
        } else {
            report::transfer_text(file, &found)
        };
        return Ok((written, None));
    };
    let found = transferred.ok();
    let verdict = |own: String| match &found {
        Some(found) => format!("{own}; {}", report::transfer_verdict(file, found)),
        None => own,
    };
    let written = if let Some(format) = options.format {
        ring::system(&named, &derived, format)?
    } else if options.json {
        let mut document = ring::json(&named, &derived);
        if let Some(found) = &found {
            document["transfer"] = report::transfer_json(file, index + 1, found)["transfer"].take();
            document["verdict"] = verdict(ring::verdict(&named, &derived)).into();
        }
        format!("{document}\n")
    } else if options.quiet {
        verdict(ring::verdict(&named, &derived)) + "\n"
    } else {
        // Its first line is the title, which stands above.
        let relation = found.map_or_else(String::new, |found| report::transfer_text(file, &found));
        ring::text(&named, &derived) + relation.find('\n').map_or("", |end| &relation[end..])
    };
    Ok((written, Some(super::derive::exit_of_ring(&derived, file.exact && case.exact))))
}

/// Sweeps a joint through its range and prints the branches.
pub fn sweep(
    options: &SweepOptions,
    file: &SphereFile,
    open: impl FnOnce() -> Result<Output, Fault>,
) -> Result<Exit, Fault> {
    if options.svg && options.trace.is_some() {
        let message = "found --svg of a curve on the sphere, expected --svg without --trace, or --csv";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    if options.centrodes.is_some() {
        return Err(
            Error::Invalid("found --centrodes for a linkage on the sphere, expected --axodes".to_owned()).into()
        );
    }
    let rolling = options.axodes.as_ref().map(|name| on_sphere(file, name)).transpose()?;
    let traced = match &options.trace {
        Some(asked) => {
            let (body, _, place) = file.point(asked)?;
            Some((body, asked.clone(), place))
        }
        None => None,
    };
    let case = &file.cases[0];
    let joints = &file.linkage.joints;
    let named = |option: &str, name: &str| {
        joints.iter().position(|joint| joint.name == *name).ok_or_else(|| {
            let known: Vec<&str> = joints.iter().take(12).map(|joint| joint.name.as_str()).collect();
            Error::Invalid(format!("found {option} {name}, expected one of {}", known.join(", ")))
        })
    };
    let follower = options.ratio.as_ref().map(|name| named("--ratio", name)).transpose()?;
    let joint = match &options.joint {
        Some(name) => named("--joint", name)?,
        None => case
            .given
            .iter()
            .find_map(|given| given.joint)
            .ok_or_else(|| Error::Invalid("found no joint given in the file, expected --joint".to_owned()))?,
    };
    let range = range(options, Variable::Rotation, &file.reading)?;
    let pool = pool(options.threads)?;
    let found = pool.install(|| sweep_sphere(&file.linkage, (&case.given, file.exact && case.exact), joint, range));
    let found = found.map_err(|error| error.at(&options.mechanism, case.line))?;
    Certificates::write_one(options.certificate.as_ref(), || certificate_of_sphere_sweep(file, &found))?;
    let mut output = open()?;
    let (out, traced) = (&mut output.writer, traced.as_ref());
    let ratio = follower.map(|follower| Ratio::of_sphere(file, &found, follower));
    if options.json {
        let mut document = sweeps::json(file, traced, &found);
        if let Some(body) = rolling {
            axodes::of_sphere(&mut document, file, &found, body);
        }
        if let Some(ratio) = &ratio {
            ratio.insert(&mut document);
        }
        if options.scene {
            drawable(&mut document)?;
        }
        writeln!(out, "{document}")?;
    } else if options.svg {
        write!(out, "{}", sweeps::svg(file, &found))?;
    } else if options.csv {
        let text = sweeps::csv(file, traced, &found);
        write!(out, "{}", ratio.map_or(text.clone(), |ratio| ratio.csv(&text)))?;
    } else if options.quiet {
        writeln!(out, "{}", sweeps::verdict(&found))?;
    } else {
        let more = ratio.map_or(String::new(), |ratio| ratio.text(&joints[joint].name, false));
        write!(out, "{}{more}", sweeps::text(file, &found))?;
    }
    out.flush()?;
    Ok(judged(&found.verdict))
}
