//! Solutions for a human: the verdict first, then the modes, then why, then what to beware of.

use super::model::case_noun;
use super::number::{at_most, counted, duration, magnitude, short, three_digits};
use super::table::{Columns, paragraph};
use crate::catalogue::entry::{Case, Entry, InputValue, Kind};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::platform_limits::listed;
use crate::mechanism::{Family, FullMode, Joints, PoseError, Solution};
use crate::verdict::{Code, Proof, Status};
use num_complex::Complex;
use std::fmt::Write;

/// The parts of a solution to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct View {
    /// Complex modes too.
    pub complex: bool,
    /// Leave out real modes outside the joint limits.
    pub drop_outside_limits: bool,
    /// Nothing but the verdict.
    pub quiet: bool,
    /// Colour the verdict.
    pub colour: bool,
}

impl View {
    /// Whether a mode is shown.
    #[must_use]
    pub fn shows(&self, mode: &FullMode) -> bool {
        (mode.real || self.complex) && !(self.drop_outside_limits && mode.within_limits == Some(false))
    }

    /// The text in a colour of the terminal: 31 red, 32 green, 33 yellow.
    #[must_use]
    pub fn painted(&self, text: &str, colour: u8) -> String {
        if self.colour { format!("\x1b[{colour}m{text}\x1b[0m") } else { text.to_owned() }
    }
}

/// The verdict in one line.
#[must_use]
pub fn verdict(kind: Kind, solution: &Solution) -> String {
    let verdict = &solution.verdict;
    let found = verdict.complex;
    match verdict.status {
        Status::Complete => {
            let at_infinity = match verdict.at_infinity {
                0 => String::new(),
                n => format!(", {n} more at infinity"),
            };
            let near = near(solution);
            let roots = format!("{found} of {found} roots ({} real{at_infinity}{near})", verdict.real);
            format!("complete ({}): {roots}, {}", proof(verdict.proof), quality(solution))
        }
        Status::Unreachable => {
            let what = match kind {
                Kind::Arm => "this pose cannot be reached",
                Kind::Loop => "the loop cannot be assembled at this input",
                Kind::Platform => "no pose has legs of these lengths",
            };
            let found = match (found, kind) {
                // An arm of seven joints has no number of complex ones.
                (0, Kind::Arm) if verdict.code == Code::OutOfReach && solution.arm.is_some() => "all roots".to_owned(),
                // A pose out of reach is known to be one without any root.
                (0, Kind::Arm | Kind::Loop) if verdict.code == Code::OutOfReach => "at most 16 roots".to_owned(),
                (0, _) => "0 roots".to_owned(),
                _ => format!("{found} roots, {}", certified(solution)),
            };
            format!("unreachable ({}): 0 real of {found}: {what}, {}", proof(verdict.proof), measured(solution))
        }
        Status::SelfMotion => {
            let beside = match found {
                0 => "no isolated root listed".to_owned(),
                n => format!("{} beside it ({} real{})", counted(n, "isolated root"), verdict.real, near(solution)),
            };
            let proof = proof(verdict.proof);
            format!("self-motion of dimension {} ({proof}), {beside}, {}", verdict.self_motion, measured(solution))
        }
        Status::Incomplete => {
            format!(
                "incomplete, not proved: {}",
                verdict.reason.strip_prefix("not proved: ").unwrap_or(&verdict.reason)
            )
        }
        Status::Unsupported => format!("unsupported: {}", verdict.reason),
    }
}

/// The proof of a verdict in words.
fn proof(proof: Proof) -> &'static str {
    match proof {
        Proof::None => "not proved",
        other => other.word(),
    }
}

/// `, 2 near it`
fn near(solution: &Solution) -> String {
    match solution.near() {
        0 => String::new(),
        several => format!(", {several} near"),
    }
}

/// `all certified, residual <= 3e-16, 0.05 ms`
fn quality(solution: &Solution) -> String {
    format!("{}, {}", certified(solution), measured(solution))
}

/// Describes how much of the list is proved.
fn certified(solution: &Solution) -> String {
    let proved = solution.verdict.certified;
    let multiple: Vec<usize> = solution.modes.iter().map(|m| m.multiplicity).filter(|k| *k > 1).collect();
    match solution.modes.iter().filter(|mode| !mode.near).count() {
        0 => "none to certify".to_owned(),
        all if proved == all => "all certified".to_owned(),
        all if proved + multiple.len() == all => {
            let counted: usize = multiple.iter().sum();
            format!("{proved} certified, {} multiple (counted {counted})", multiple.len())
        }
        all => format!("{proved} of {all} certified"),
    }
}

fn measured(solution: &Solution) -> String {
    let time = duration(solution.solve_us);
    if solution.modes.is_empty() {
        return time;
    }
    let residual = solution.modes.iter().map(|m| m.residual).fold(0.0, f64::max);
    format!("residual <= {}, {time}", at_most(residual))
}

/// Everything about one case, its verdict first; `case` is its number in the file, from 1.
#[must_use]
pub fn solution(entry: &Entry, number: usize, case: &Case, solution: &Solution, view: &View) -> String {
    let colour = match solution.verdict.status {
        Status::Complete => 32,
        Status::Incomplete | Status::SelfMotion => 33,
        Status::Unreachable | Status::Unsupported => 31,
    };
    let mut text = view.painted(&verdict(entry.kind(), solution), colour) + "\n";
    if view.quiet {
        return text;
    }
    if solution.verdict.status == Status::Incomplete {
        let _ = match solution.verdict.complex {
            0 => writeln!(text, "no root found, {}", measured(solution)),
            n => writeln!(text, "{} found ({} real), {}", counted(n, "root"), solution.verdict.real, quality(solution)),
        };
    }
    let _ = writeln!(text, "{}", heading(entry, number, case));
    if !solution.families.is_empty() {
        text.push('\n');
        text.push_str(&families(entry, &solution.families).text());
    }
    let shown: Vec<&FullMode> = solution.modes.iter().filter(|mode| view.shows(mode)).collect();
    if !shown.is_empty() {
        text.push('\n');
        text.push_str(&modes(entry, &shown).text());
    }
    let remarks = remarks(entry, solution, view);
    if !remarks.is_empty() {
        text.push('\n');
        text.push_str(&remarks);
    }
    text
}

/// The title, and which of several cases this is.
pub(super) fn heading(entry: &Entry, number: usize, case: &Case) -> String {
    let mut text = entry.title.clone();
    if entry.cases.len() > 1 {
        let _ = write!(text, ", {} {number} of {}", case_noun(entry), entry.cases.len());
    } else if entry.cases.is_empty() {
        let _ = write!(text, ", {} {number}", case_noun(entry));
    }
    for input in &case.input {
        let value = match &input.value {
            InputValue::Angle(angle) => format!("{} deg", short(angle.radians().to_degrees(), 6)),
            InputValue::Distance(distance) => format!("{} m", short(distance.to_f64(), 9)),
        };
        let _ = write!(text, ", q{} = {value}", input.joint);
    }
    if let Some(squares) = &case.legs_squared {
        let lengths = squares.each_ref().map(|square| short(square.to_f64().sqrt(), 9));
        let _ = write!(text, "\nlegs {} m", lengths.join(", "));
    }
    text
}

/// Why the list is complete, and what to beware of.
fn remarks(entry: &Entry, solution: &Solution, view: &View) -> String {
    let mut text = String::new();
    if solution.verdict.status != Status::Incomplete && solution.verdict.status != Status::Unsupported {
        paragraph(&mut text, &format!("why: {}", solution.verdict.reason));
    }
    if let Some((q, miss)) = &solution.nearest {
        paragraph(&mut text, &nearest(entry, q, miss));
    }
    if let Some(platform) = &solution.platform {
        paragraph(&mut text, &format!("route: {}", platform.route));
    }
    if let Some(limits) = limits(entry) {
        paragraph(&mut text, &limits);
        let real = solution.modes.iter().filter(|m| m.within_limits.is_some()).count();
        let outside = solution.modes.iter().filter(|m| m.within_limits == Some(false)).count();
        let fate = if view.drop_outside_limits && outside > 0 { ", the others are not listed" } else { "" };
        if real > 0 {
            let _ = writeln!(text, "within them: {} of {}{fate}", real - outside, counted(real, "real solution"));
        }
        let inside = inside(entry, &solution.families);
        if !inside.is_empty() {
            let within = inside.iter().filter(|is_inside| **is_inside).count();
            let _ = writeln!(text, "within them: {within} of {}", counted(solution.families.len(), "family"));
        }
    }
    let hidden = solution.modes.iter().filter(|m| !m.real).count();
    if hidden > 0 && !view.complex {
        let _ = writeln!(text, "not listed: {} (--complex)", counted(hidden, "complex root"));
    }
    // Nearly double roots: real for one rounding of the pose and complex for the next.
    let imaginary = |mode: &FullMode| mode.q.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
    let complex = solution.modes.iter().filter(|mode| !mode.real);
    let nearly: Vec<f64> = complex.map(imaginary).filter(|size| *size < 1e-5).collect();
    if !nearly.is_empty() {
        let size = at_most(nearly.iter().copied().fold(0.0, f64::max));
        let unit = if solution.platform.is_some() { "" } else { " rad" };
        let roots = counted(nearly.len(), "complex root");
        let _ = writeln!(text, "nearly real: {roots}, imaginary parts <= {size}{unit}");
    }
    let errors: Vec<PoseError> = solution.modes.iter().filter(|mode| mode.near).filter_map(|mode| mode.error).collect();
    if !errors.is_empty() {
        let largest = |part: fn(&PoseError) -> f64| at_most(errors.iter().map(part).fold(0.0, f64::max));
        let (position, orientation) = (largest(|error| error.position), largest(|error| error.orientation));
        let modes = counted(errors.len(), "mode");
        let miss = if errors.len() == 1 { "misses" } else { "miss" };
        let _ = writeln!(text, "near: {modes} {miss} the pose by up to {position} m and {orientation} rad");
    }
    for warning in &solution.warnings {
        paragraph(&mut text, &format!("warning: {warning}"));
    }
    for remark in reading(entry) {
        paragraph(&mut text, &format!("note: {remark}"));
    }
    let proved = matches!(solution.verdict.status, Status::Complete | Status::Unreachable);
    // Fewer roots than there are in general are complete by exact work on the geometry only.
    let exact = solution.verdict.code != Code::GeneralBoundMet;
    if entry.rounded && proved && exact {
        text.push_str("note: irrational numbers of the file were rounded for exact work (--digits)\n");
    }
    text
}

/// Returns the decisions of the file's reader.
#[must_use]
pub fn reading(entry: &Entry) -> Vec<String> {
    let angles = |taken: bool| {
        let of_kind = entry.labels.snapped.iter().filter(move |snapped| snapped.taken == taken);
        let mut angles: Vec<String> = of_kind.map(|own| format!("{} for {}", own.written, own.meant())).collect();
        angles.sort_unstable();
        angles.dedup();
        angles.join(", ")
    };
    let (taken, noticed) = (angles(true), angles(false));
    let taken = (!taken.is_empty()).then(|| format!("printed angles that stand for exact ones: {taken}"));
    let noticed = (!noticed.is_empty())
        .then(|| format!("truncated angles, read as they stand: {noticed}; --snap takes them as the angles meant"));
    entry.labels.remarks.iter().cloned().chain(taken).chain(noticed).collect()
}

/// The limits of an arm, a loop or a platform, if it has any.
fn limits(entry: &Entry) -> Option<String> {
    if !entry.platform_limits.is_empty() {
        return Some(super::model::platform_limits(&entry.platform_limits));
    }
    if entry.limits.is_empty() {
        return None;
    }
    let variables = labelled(entry);
    let pairs = entry.limits.iter().zip(&variables).map(|([low, high], (name, variable))| match variable {
        Variable::Rotation => {
            format!("{name} {}..{} deg", short(low.to_degrees(), 2), short(high.to_degrees(), 2))
        }
        Variable::Translation => format!("{name} {}..{} m", short(*low, 4), short(*high, 4)),
    });
    Some(format!("joint limits: {}", pairs.collect::<Vec<_>>().join(", ")))
}

/// The label of every joint variable, as the file calls its joint, and what it measures.
#[must_use]
pub fn labelled(entry: &Entry) -> Vec<(String, Variable)> {
    let variables = entry.chain().map(Chain::variables).unwrap_or_default();
    super::document::labels(entry).into_iter().zip(variables.iter().map(|own| own.variable)).collect()
}

/// Returns the line on the configuration that comes nearest to a pose that nothing reaches.
fn nearest(entry: &Entry, q: &[f64], miss: &PoseError) -> String {
    let value = |(value, (name, variable)): (&f64, (String, Variable))| match variable {
        Variable::Rotation => format!("{name} {} deg", short(value.to_degrees(), 4)),
        Variable::Translation => format!("{name} {} m", short(*value, 6)),
    };
    let values: Vec<String> = q.iter().zip(labelled(entry)).map(value).collect();
    let (position, orientation) = (three_digits(miss.position), three_digits(miss.orientation.to_degrees()));
    format!("nearest found: {}; it misses the pose by {position} m and {orientation} deg", values.join(", "))
}

/// The name of every joint variable and what it measures: `q1`, ..., of a C joint `q3` and `d3`, of a U joint `q3z` and `q3x`.
#[must_use]
pub fn variables(chain: &Chain) -> Vec<(String, Variable)> {
    chain.variables().into_iter().map(|variable| (variable.name(), variable.variable)).collect()
}

/// The quantity in a column of the table of modes.
#[derive(Clone, Copy)]
enum Measure {
    Angle,
    Length,
    Ratio,
}

/// The columns of what a mode is made of.
fn columns(entry: &Entry) -> Vec<(String, Measure)> {
    if entry.chain().is_none() {
        let quaternion = ["qw", "qx", "qy", "qz"].map(|name| (name.to_owned(), Measure::Ratio));
        let position = ["x [m]", "y [m]", "z [m]"].map(|name| (name.to_owned(), Measure::Length));
        return quaternion.into_iter().chain(position).collect();
    }
    let column = |(name, variable): (String, Variable)| match variable {
        Variable::Rotation => (format!("{name} [deg]"), Measure::Angle),
        Variable::Translation => (format!("{name} [m]"), Measure::Length),
    };
    labelled(entry).into_iter().map(column).collect()
}

/// The families, one a row: what moves, and a configuration of it.
fn families(entry: &Entry, families: &[Family]) -> Columns {
    let columns = columns(entry);
    let is_near = families.iter().any(|family| family.distance > 0.0);
    let mut header = vec!["family".to_owned(), "moving".to_owned()];
    header.extend(columns.iter().map(|(name, _)| name.clone()));
    header.push("samples".to_owned());
    if is_near {
        header.push("distance".to_owned());
    }
    let inside = inside(entry, families);
    if !inside.is_empty() {
        header.push("in limits".to_owned());
    }
    let mut table = Columns::new(&header, &["family", "moving", "in limits"]);
    let names: Vec<String> =
        entry.chain().map(variables).unwrap_or_default().into_iter().map(|(name, _)| name).collect();
    for (index, family) in families.iter().enumerate() {
        let moving: Vec<&str> = family.moving.iter().filter_map(|at| names.get(*at)).map(String::as_str).collect();
        let kind = match family.dimension {
            1 => "curve".to_owned(),
            dimension => format!("dimension {dimension}"),
        };
        let mut row = vec![kind, moving.join(" ")];
        let values = family.sample.iter().zip(&columns);
        row.extend(values.map(|(value, (_, measure))| shown(&Complex::from(*value), *measure, true)));
        row.push(family.samples.len().max(1).to_string());
        if is_near {
            row.push(if family.distance > 0.0 { at_most(family.distance) } else { "0".to_owned() });
        }
        row.extend(inside.get(index).map(|is_inside| if *is_inside { "yes" } else { "no" }.to_owned()));
        table.row(row);
    }
    table
}

/// Whether every family has a configuration within the joint limits; empty without limits, and for platforms.
fn inside(entry: &Entry, families: &[Family]) -> Vec<bool> {
    if entry.chain().is_none() || entry.limits.is_empty() {
        return Vec::new();
    }
    let variables: Vec<Variable> = labelled(entry).into_iter().map(|(_, variable)| variable).collect();
    let joints = Joints { variables: &variables, limits: &entry.limits };
    families.iter().map(|family| joints.is_inside(&family.sample)).collect()
}

/// The modes, one a row; columns that would say nothing are left out.
fn modes(entry: &Entry, modes: &[&FullMode]) -> Columns {
    let columns = columns(entry);
    let multiple = modes.iter().any(|mode| mode.multiplicity != 1);
    let limited = modes.iter().any(|mode| mode.within_limits.is_some());
    let mirror = |mode: &FullMode| mode.platform.as_ref().and_then(|platform| platform.mirror);
    let mirrored = modes.iter().any(|mode| mirror(mode).is_some());
    let outside = |mode: &FullMode| mode.platform.as_ref().map_or_else(String::new, |own| listed(&own.outside));
    let named = modes.iter().any(|mode| !outside(mode).is_empty());
    let mut header = vec!["#".to_owned()];
    header.extend(columns.iter().map(|(name, _)| name.clone()));
    if multiple {
        header.push("multiplicity".to_owned());
    }
    header.extend(["residual", "condition", "certified"].map(str::to_owned));
    if limited {
        header.push("in limits".to_owned());
    }
    if mirrored {
        header.push("mirror of".to_owned());
    }
    if named {
        header.push("outside".to_owned());
    }
    let mut table = Columns::new(&header, &["certified", "in limits", "outside"]);
    for (index, mode) in modes.iter().enumerate() {
        let mut row = vec![(index + 1).to_string()];
        row.extend(mode.q.iter().zip(&columns).map(|(value, (_, measure))| shown(value, *measure, mode.real)));
        if multiple {
            row.push(if mode.multiplicity == 0 { "?".to_owned() } else { mode.multiplicity.to_string() });
        }
        row.extend([at_most(mode.residual), magnitude(mode.condition)]);
        row.push(
            if mode.near {
                "near"
            } else if mode.certified {
                "yes"
            } else {
                "no"
            }
            .to_owned(),
        );
        if limited {
            row.push(mode.within_limits.map_or("", |within| if within { "yes" } else { "no" }).to_owned());
        }
        if mirrored {
            row.push(mirror(mode).map_or(String::new(), |number| number.to_string()));
        }
        if named {
            row.push(outside(mode));
        }
        table.row(row);
    }
    table
}

/// Degrees or metres; a complex value as `re+imi`.
fn shown(value: &Complex<f64>, measure: Measure, real: bool) -> String {
    let (scale, decimals) = match measure {
        Measure::Angle => (1_f64.to_degrees(), 4),
        Measure::Length | Measure::Ratio => (1.0, 6),
    };
    let (re, im) = (value.re * scale, value.im * scale);
    let plain = |x: f64| {
        let text = format!("{x:.decimals$}");
        if text.trim_start_matches('-').bytes().all(|b| b == b'0' || b == b'.') {
            text.trim_start_matches('-').to_owned()
        } else {
            text
        }
    };
    if real || im == 0.0 {
        return plain(re);
    }
    // An imaginary part that is not zero must not look like it.
    let size = plain(im.abs());
    let size = if size.parse() == Ok(0.0) { format!("{:.0e}", im.abs()) } else { size };
    format!("{}{}{size}i", plain(re), if im < 0.0 { "-" } else { "+" })
}
