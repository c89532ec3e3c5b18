//! `looproot instant` for loops, arms and linkages on the sphere and in space.

use super::arguments::InstantOptions;
use super::exit::{Exit, Fault, unexpected};
use super::instant::{among, point_of};
use super::loads::{Named, loads};
use super::output::Output;
use super::wanted::{in_place, wanted};
use super::{linkage, space, sphere};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Design, Entry, Kind};
use looproot::internal::catalogue::{SpaceFile, SphereFile};
use looproot::internal::error::Error;
use looproot::internal::linkage::space::solve_real as solve_in_space;
use looproot::internal::linkage::sphere::solve;
use looproot::internal::mechanism::{Derivatives, InputCurve, Mechanism};
use looproot::internal::report::document::complete;
use looproot::internal::report::linkage::headline;
use looproot::internal::report::space_instant::{
    Asked, Pair, of_chain as chain_result, of_space as space_result, of_sphere as sphere_result, text,
};
use looproot::internal::report::{space as spaces, sphere as spheres, text as texts};
use rug::Rational;
use serde_json::json;
use std::io::Write;

/// Finds every mode of the requested cases of a loop or an arm, and the motion of a body there.
pub fn of_chain(options: &InstantOptions, mut entry: Entry) -> Result<Exit, Fault> {
    let (Design::Arm(chain) | Design::Loop(chain)) = &entry.design else {
        return Err(unexpected(&options.mechanism, entry.kind().into(), "a linkage, a loop or an arm"));
    };
    refuse(options)?;
    let bodies = chain.joint_kinds().len();
    let name = options.body.as_deref().unwrap_or_default();
    let pair =
        Pair { body: link(name, bodies)?, against: options.against.as_ref().map_or(Ok(0), |name| link(name, bodies))? };
    let pair = apart(options, name, pair)?;
    let variables = chain.variables().len();
    let rate = match (entry.kind(), &options.rate) {
        (Kind::Arm, Some(rate)) => Some(rates(rate, variables)?),
        (Kind::Arm, None) => {
            let message = format!("found no --rate, expected the rates of the {variables} joint variables of the arm");
            return Err(Error::Invalid(message).into());
        }
        (_, Some(_)) => {
            return Err(Error::Invalid("found --rate for a loop, whose input runs at unit rate".to_owned()).into());
        }
        _ => None,
    };
    let cases = wanted(&options.asked, &options.mechanism, &mut entry)?;
    let place = |error: Error| in_place(error, &options.mechanism, &entry);
    let mechanism = Mechanism::prepare(&entry).map_err(place)?;
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mut output = Output::open(&options.output, &options.mechanism)?;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    for index in cases {
        let case = &entry.cases[index];
        let solution = mechanism.solve(case, Roots::Real, &mut workspace, &mut assembly).map_err(place)?;
        exit = exit.max(Exit::of(&solution));
        let motions: Vec<Option<Derivatives>> = if let Some(rate) = &rate {
            let own = Derivatives { velocity: rate.clone(), acceleration: vec![0.0; rate.len()] };
            vec![Some(own); solution.modes.len()]
        } else {
            let curve = InputCurve::of(&entry, case).map_err(place)?;
            solution.modes.iter().map(|mode| curve.derivatives(mode)).collect()
        };
        let found = chain_result(&entry, (index + 1, case), &solution, &motions, pair);
        if options.json {
            results.push(found);
        } else {
            let verdict = texts::verdict(entry.kind(), &solution);
            write!(output.writer, "{}", text(&entry.title, &verdict, &found))?;
        }
    }
    if options.json {
        let kind = if entry.kind() == Kind::Arm { "arm" } else { "loop" };
        let mut document = json!({ "title": entry.title, "kind": kind, "results": results });
        complete(&mut document, &entry);
        writeln!(output.writer, "{document:#}")?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Finds every assembly of the requested cases of a linkage on the sphere, and the motion of a body there.
pub fn of_sphere(options: &InstantOptions, file: &SphereFile) -> Result<Exit, Fault> {
    if options.rate.is_some() {
        return Err(Error::Invalid("found --rate for a linkage, whose input runs at unit rate".to_owned()).into());
    }
    let bodies: Vec<Named<'_, 3>> =
        file.linkage.bodies.iter().map(|body| (body.name.as_str(), places(&body.points))).collect();
    let loads = options.loads.as_ref().map(|text| loads(text, &bodies)).transpose()?;
    let requested = Asked { body: body(options, file.linkage.ground, &bodies)?, loads: loads.as_deref() };
    let asked = options.asked.input.as_deref();
    let file = &*sphere::posed(asked, file)?;
    let mut output = Output::open(&options.output, &options.mechanism)?;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    for index in sphere::wanted(asked, file)? {
        let case = &file.cases[index];
        let line = case.given.first().map_or(case.line, |given| given.line);
        if case.given.first().is_none_or(|given| given.joint.is_none()) {
            let message = "found no input of the linkage, expected an [[input]] with a joint, which runs at unit rate";
            return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, line).into());
        }
        let answer = solve(&file.linkage, &case.given, file.exact && case.exact)
            .map_err(|error| error.at(&options.mechanism, line))?;
        exit = exit.max(linkage::code(&answer.verdict));
        let found = sphere_result(file, (index + 1, case), &answer, requested);
        if options.json {
            results.push(found);
        } else {
            write!(output.writer, "{}", text(&file.heading.title, &headline(&answer.verdict), &found))?;
        }
    }
    if options.json {
        writeln!(output.writer, "{:#}", spheres::json(file, &results))?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Finds every assembly of the requested cases of a linkage in space, and the motion of a body there.
pub fn of_space(options: &InstantOptions, file: &SpaceFile) -> Result<Exit, Fault> {
    if options.rate.is_some() {
        return Err(Error::Invalid("found --rate for a linkage, whose input runs at unit rate".to_owned()).into());
    }
    let bodies: Vec<Named<'_, 3>> =
        file.linkage.bodies.iter().map(|body| (body.name.as_str(), places(&body.points))).collect();
    let loads = options.loads.as_ref().map(|text| loads(text, &bodies)).transpose()?;
    let requested = Asked { body: body(options, file.linkage.ground, &bodies)?, loads: loads.as_deref() };
    let asked = options.asked.input.as_deref();
    let file = &*space::posed(asked, file)?;
    let mut output = Output::open(&options.output, &options.mechanism)?;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    for index in space::wanted(asked, file)? {
        let case = &file.cases[index];
        let line = case.given.first().map_or(case.line, |given| given.line);
        if case.given.first().is_none_or(|given| given.joint.is_none()) {
            let message = "found no input of the linkage, expected an [[input]] with a joint, which runs at unit rate";
            return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, line).into());
        }
        let answer = solve_in_space(&file.linkage, &case.given, file.exact && case.exact)
            .map_err(|error| error.at(&options.mechanism, line))?;
        exit = exit.max(linkage::code(&answer.verdict));
        let found = space_result(file, (index + 1, case), &answer, requested);
        if options.json {
            results.push(found);
        } else {
            write!(output.writer, "{}", text(&file.heading.title, &headline(&answer.verdict), &found))?;
        }
    }
    if options.json {
        writeln!(output.writer, "{:#}", spaces::json(file, &results))?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Points of a body in coordinates of its own.
fn places(points: &[(String, [Rational; 3])]) -> Vec<(&str, [f64; 3])> {
    points.iter().map(|(name, at)| (name.as_str(), at.each_ref().map(Rational::to_f64))).collect()
}

/// Returns the requested body of a linkage, and the requested one of its points.
fn body<'a>(
    options: &'a InstantOptions,
    ground: usize,
    bodies: &[Named<'_, 3>],
) -> Result<Option<(Pair, Option<&'a str>)>, Error> {
    let Some(name) = &options.body else { return Ok(None) };
    let named = |name: &str| among(bodies.iter().map(|(own, _)| *own), name);
    let against = options.against.as_ref().map_or(Ok(ground), |name| named(name))?;
    let pair = apart(options, name, Pair { body: named(name)?, against })?;
    let (own, points) = &bodies[pair.body];
    let points = points.iter().map(|(name, _)| *name);
    let point = options.point.as_ref().map(|asked| point_of(own, points, asked)).transpose()?;
    Ok(Some((pair, point)))
}

/// Returns the index of a body of a linkage on the sphere by its name.
pub fn on_sphere(file: &SphereFile, name: &str) -> Result<usize, Error> {
    among(file.linkage.bodies.iter().map(|body| body.name.as_str()), name)
}

/// Refuses what only bodies of linkages have.
fn refuse(options: &InstantOptions) -> Result<(), Error> {
    if options.loads.is_some() {
        return Err(Error::Invalid("found --loads, expected it for a linkage".to_owned()));
    }
    match &options.point {
        Some(point) => {
            let point: String = point.chars().take(40).collect();
            let message = format!("found --point {point}, expected it for a linkage");
            Err(Error::Invalid(message))
        }
        None => Ok(()),
    }
}

/// Returns the pair, exchanged for the inverse motion; a body has no motion against itself.
fn apart(options: &InstantOptions, name: &str, pair: Pair) -> Result<Pair, Error> {
    if pair.body == pair.against {
        let message = format!("found --body {name} against itself, expected two bodies");
        return Err(Error::Invalid(message));
    }
    Ok(if options.inverse { Pair { body: pair.against, against: pair.body } } else { pair })
}

/// Returns the number of a body of a chain: that of the joint before it, 0 for the base.
pub fn link(name: &str, bodies: usize) -> Result<usize, Error> {
    let number = match name.trim() {
        "base" => Some(0),
        "tool" => Some(bodies),
        other => other.trim_start_matches("link").trim().parse().ok().filter(|number| *number <= bodies),
    };
    number.ok_or_else(|| {
        let name: String = name.chars().take(40).collect();
        let message = format!(
            "found the unknown body `{name}`, expected base, or the number of the joint before it, 1 to {bodies}"
        );
        Error::Invalid(message)
    })
}

/// Reads the rates of all joint variables.
fn rates(text: &str, variables: usize) -> Result<Vec<f64>, Error> {
    let found: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    found.filter(|list| list.len() == variables).ok_or_else(|| {
        let text: String = text.chars().take(40).collect();
        Error::Invalid(format!("found --rate \"{text}\", expected {variables} numbers, one for every joint variable"))
    })
}
