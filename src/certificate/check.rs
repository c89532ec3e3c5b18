//! The check of a certificate as a whole.

use super::algebraic::{self, exact_solutions};
use super::bound::{OF_OWN, bound};
use super::chain::ChainClosure;
use super::data::{data_of, data_of_loop, entry_of};
use super::distance;
use super::double_points::{self, double_solutions};
use super::families::check_families;
use super::fault::{Fault, refused, shortened, unreadable};
use super::four_bars;
use super::isolation::{Closed, proved_among, proved_modes};
use super::kernel;
use super::linkage::{LinkageClosure, data_of_linkage};
use super::mode::{Ball, Unproved};
use super::moving::{CURVE, follows_a_curve, mobility};
use super::platform::PlatformClosure;
use super::polynomial;
use super::real_zeros;
use super::record::{Claim, Record, count, fields};
use super::strict::Strict;
use super::sweep::check_sweep;
use crate::catalogue::entry::{Case, Design, Entry};
use crate::catalogue::{Any, Chains, Format, Options, any_from_text};
use serde_json::{Deserializer, Value};
use std::fmt;

/// Maximum size of the text of one certificate, bytes.
const LARGEST: usize = 4 << 20;

/// The statement that a certificate proves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// A complete list of solutions.
    Solutions {
        /// The number of all solutions.
        complex: usize,
        /// The number of real solutions.
        real: usize,
    },
    /// A complete list of solutions, and a polynomial whose roots are the half-angle tangents of one unknown at them.
    Polynomial {
        /// The number of all solutions, which is the degree.
        complex: usize,
        /// The number of real solutions.
        real: usize,
    },
    /// A complete list of real solutions; the complex ones are not counted.
    Real(usize),
    /// No real solution exists; the complex ones are not counted.
    OutOfReach,
    /// The solutions form a curve at some of them; the others are not counted.
    SelfMotion,
    /// A closed loop moves in this many dimensions; 0 means that it does not move.
    Mobility(usize),
    /// All loops of four rotations that move are of so many families, if no twist is a multiple of pi and joints 1 and 4 move.
    Families(usize),
    /// All branches of a four-bar while its input makes a full turn.
    Branches {
        /// Their number.
        branches: usize,
        /// The number of circuits that they belong to.
        circuits: usize,
        /// The number of limit positions.
        limits: usize,
    },
}

impl fmt::Display for Holds {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Solutions { complex, real } => {
                write!(f, "{complex} solutions, {real} of them real: complete, proved")
            }
            Self::Polynomial { complex, real } => {
                write!(f, "{complex} solutions, {real} of them real, at the roots of the polynomial: complete, proved")
            }
            Self::Real(real) => write!(f, "{real} real solutions: complete, proved"),
            Self::SelfMotion => write!(f, "a self-motion of dimension 1: proved"),
            Self::OutOfReach => write!(f, "no real solution: proved"),
            Self::Families(count) => {
                write!(
                    f,
                    "{count} families of loops of four oblique links of which joints 1 and 4 move: complete, proved"
                )
            }
            Self::Branches { branches, circuits, limits } => write!(
                f,
                "a full turn of the input, branches {branches}, circuits {circuits}, limit positions {limits}: complete, proved"
            ),
            Self::Mobility(0) => write!(f, "immobile, of dimension 0: proved"),
            Self::Mobility(dimension) => write!(f, "mobile, of dimension {dimension}: proved"),
        }
    }
}

/// Checks one certificate and, if a file is given, that its data are those of one case of the file.
///
/// # Errors
/// [`Fault`] names the first item that does not hold, or what cannot be read.
pub fn check(certificate: &Value, file: Option<&Any>) -> Result<Holds, Fault> {
    let record = Record::read(certificate)?;
    let verbs = ["solve", "mobility", "derive", "sweep", "conditions"];
    if !verbs.contains(&record.claim.verb.as_str()) || record.claim.proof != "proved" {
        return refused(format!("claim: only proved answers of {} are covered", verbs.join(", ")));
    }
    if let Some(claim) = &record.claim.families {
        if file.is_some() {
            return refused("file: the certificate is about all loops of four rotations, and about no file");
        }
        let found = check_families(&record.data, &record.claim.status, claim, record.modes.len(), &record.proof);
        return found.map(Holds::Families);
    }
    if record.claim.verb == "sweep" {
        return of_sweep(record, file);
    }
    let is_linkage = record.data.get("mechanism").and_then(|own| own.get("kind")) == Some(&Value::from("linkage"));
    if is_linkage && record.claim.verb == "solve" {
        return of_linkage(record, file);
    }
    let file = file.map(entry_in).transpose()?;
    if record.claim.verb == "mobility" {
        return of_motion(record, file).map(Holds::Mobility);
    }
    let entry = entry_of(&record.data, Chains::Solved)?;
    let [case] = entry.cases.as_slice() else {
        return unreadable(format!("data: found {} cases, expected one", entry.cases.len()));
    };
    let own = Value::Object(record.data);
    check_data(data_of(&entry, case), &own)?;
    let is_own = |file: &Entry| file.cases.iter().any(|case| data_of(file, case).is_ok_and(|data| data == own));
    if file.is_some_and(|file| !is_own(file)) {
        return refused(OTHER_FILE);
    }
    let closed = closed(&entry, case)?;
    if let Some(dimension) = record.claim.self_motion {
        return of_self_motion(&closed, &record.claim.verb, dimension, record.modes.len(), &record.proof);
    }
    let own = if let Closed::Chain(closure) = &closed { closure.own } else { 6 };
    check_items(&record.claim, &record.proof, own)?;
    let (proof, second) = (&record.proof[..1], record.proof.get(1));
    let kind = proof[0].get("kind").and_then(Value::as_str).unwrap_or_default();
    if own < 6 && [distance::KIND, real_zeros::KIND].contains(&kind) {
        return refused(format!("closure: {own} unknowns, where all solutions are asked for"));
    }
    if own == 6 && kind == OF_OWN {
        return refused("proof: own-eliminant: the loop has six unknowns");
    }
    if let (6, None, Some(item)) = (own, &record.claim.polynomial, second) {
        return with_double_solutions(&closed, &record.claim, &record.modes, &proof[0], item);
    }
    if record.claim.polynomial.is_some() && [distance::KIND, real_zeros::KIND].contains(&kind) {
        return refused("proof: the roots of a polynomial are proved by all solutions");
    }
    if kind == distance::KIND {
        distance::check_distance(&closed, &proof[0])?;
    }
    if let Some(at) = record.modes.iter().position(|mode| mode.multiplicity != 1) {
        return refused(format!("mode {}: a ball of an isolated simple solution counts once", at + 1));
    }
    let balls: Vec<Ball> = record.modes.into_iter().map(|mode| mode.ball).collect();
    proved_modes(&closed, &balls)?;
    if kind == distance::KIND {
        return out_of_reach(&record.claim, &balls);
    }
    if kind == real_zeros::KIND {
        return real_list(&closed, &proof[0], &record.claim, &balls);
    }
    let bound = bound(&closed, proof, &balls)?;
    // One more shows that the data are these where the solutions of the loop itself may be those of others as well.
    let is_more = kind == OF_OWN && bound > 0 && balls.len() == bound + 1;
    if !is_more && balls.len() != if kind == OF_OWN { shown(bound) } else { bound } {
        return refused(format!("proof: at most {bound} solutions, and {} modes are proved", balls.len()));
    }
    let balls = match &closed {
        Closed::Chain(closure) if own < 6 => {
            let own_bound = (kind == OF_OWN).then_some(bound);
            own_solutions(closure, balls, own_bound, second)?
        }
        _ => balls,
    };
    let (complex, real) = (balls.len(), balls.iter().filter(|ball| ball.real).count());
    if record.claim.complex != Some(complex) || record.claim.real != Some(real) {
        return refused(format!("claim: other numbers than {complex} solutions, {real} of them real, are proved"));
    }
    check_status(&record.claim, real)?;
    if let (Some(claim), Some(item)) = (&record.claim.polynomial, second) {
        let Closed::Chain(closure) = &closed else { return refused("proof: membership: only loops have an eliminant") };
        polynomial::check_polynomial(closure, &balls, claim, item)?;
        return Ok(Holds::Polynomial { complex, real });
    }
    Ok(Holds::Solutions { complex, real })
}

/// Checks that a proof has one item, and a second one where it is asked for: it says which solutions of a longer loop are those of a shorter one,
/// which are double, or that they are all roots of a polynomial.
fn check_items(claim: &Claim, proof: &[Value], own: usize) -> Result<(), Fault> {
    let second = |kind: &str| proof.get(1).is_some_and(|item| item.get("kind").and_then(Value::as_str) == Some(kind));
    let is_whole = match (&claim.polynomial, proof.len()) {
        (Some(_), 2) => own == 6 && second(polynomial::KIND),
        (None, 2) if own == 6 => second(double_points::KIND),
        (None, 2) => second(algebraic::KIND),
        (None, 1) => true,
        _ => false,
    };
    if !is_whole {
        let items = proof.len();
        return refused(format!(
            "proof: found {items} items, expected one, and a second one for polynomials, double solutions and loops of fewer than six unknowns"
        ));
    }
    Ok(())
}

/// Checks a certificate with double solutions: theorem 15.
fn with_double_solutions(
    closed: &Closed,
    claim: &Claim,
    modes: &[Unproved],
    item: &Value,
    double: &Value,
) -> Result<Holds, Fault> {
    let kind = item.get("kind").and_then(Value::as_str).unwrap_or_default();
    let Closed::Chain(closure) = closed else { return refused("proof: double: only loops are covered") };
    if [distance::KIND, real_zeros::KIND].contains(&kind) {
        return refused("proof: double: only bounds of loops of six unknowns are covered");
    }
    let points = double_solutions(closure, double)?;
    let is_double: Vec<bool> = modes.iter().map(|mode| mode.multiplicity == 2).collect();
    let balls: Vec<Ball> = modes.iter().map(|mode| mode.ball.clone()).collect();
    for (index, mode) in modes.iter().enumerate() {
        if mode.multiplicity != 1 && !(is_double[index] && points.is_one_in(closure, &mode.ball)) {
            return refused(format!(
                "mode {}: a simple solution counts once, and no double one is proved here",
                index + 1
            ));
        }
    }
    proved_among(&**closure, &balls, &|index| is_double[index])?;
    let doubles = is_double.iter().filter(|is_double| **is_double).count();
    if doubles != points.count() {
        return refused(format!("proof: double: {doubles} modes are double, and {} points", points.count()));
    }
    let bound = bound(closed, std::slice::from_ref(item), &balls)?;
    // Theorem 4 counts different solutions.
    let total = balls.len() + if kind == "eliminant" { 0 } else { doubles };
    if total != bound {
        return refused(format!("proof: at most {bound} solutions, and {total} are proved"));
    }
    let complex = modes.iter().map(|mode| mode.multiplicity).sum();
    let real = modes.iter().filter(|mode| mode.ball.real).map(|mode| mode.multiplicity).sum();
    if claim.complex != Some(complex) || claim.real != Some(real) {
        return refused(format!("claim: other numbers than {complex} solutions, {real} of them real, are proved"));
    }
    check_status(claim, real)?;
    Ok(Holds::Solutions { complex, real })
}

/// Returns how many modes are asked for where so many solutions are counted and others may exist: where none is counted one of the
/// others shows that the data are these.
fn shown(counted: usize) -> usize {
    counted.max(1)
}

/// Returns the balls of the solutions of a loop of fewer than six unknowns among those of the longer loop: theorem 11. An eliminant of
/// the loop bounds their number, or one of the longer loop that of all balls.
fn own_solutions(
    closure: &ChainClosure,
    balls: Vec<Ball>,
    own_bound: Option<usize>,
    item: Option<&Value>,
) -> Result<Vec<Ball>, Fault> {
    let points = item.map(|item| exact_solutions(closure, item)).transpose()?;
    let is_own = |ball: &Ball| match &points {
        Some(points) if own_bound.is_some() => points.is_one_in(closure, ball),
        _ => closure.may_be_own(ball),
    };
    let (modes, own) = (balls.len(), balls.into_iter().filter(is_own).collect::<Vec<_>>());
    let exact = points.map_or(0, |points| points.count());
    if own.len() != exact || own_bound.is_some_and(|bound| bound != exact) {
        let own = own.len();
        return refused(format!(
            "proof: points: they are {exact}, and {own} of the {modes} modes may be solutions of the loop"
        ));
    }
    Ok(own)
}

fn check_status(claim: &Claim, real: usize) -> Result<(), Fault> {
    if claim.status == if real == 0 { "unreachable" } else { "complete" } {
        return Ok(());
    }
    let status = shortened(&claim.status);
    refused(format!("claim: the status is `{status}`, where {real} real solutions are proved"))
}

/// Checks a certificate of the real solutions alone, of which the balls are proved: theorem 9.
fn real_list(closed: &Closed, item: &Value, claim: &Claim, balls: &[Ball]) -> Result<Holds, Fault> {
    let [_, value, aid] = fields(item, ["kind", "value", "aid"], &[])?;
    let (stated, choice) = (count(value)?, real_zeros::Choice::read(aid)?);
    let Closed::Chain(closure) = closed else {
        return refused("proof: real-zeros: only loops have such an eliminant");
    };
    let bound = real_zeros::real_solutions(closure, choice)?;
    if stated != bound {
        return refused(format!("proof: real-zeros: the value is {stated}, where the bound is {bound}"));
    }
    let real = balls.iter().filter(|ball| ball.real).count();
    if real != bound || balls.len() != shown(bound) {
        let modes = balls.len();
        return refused(format!(
            "proof: real-zeros: at most {bound} solutions, and {modes} modes are proved, {real} of them real"
        ));
    }
    if claim.real != Some(real) || claim.complex.is_some() {
        return refused(format!("claim: {real} real solutions are proved, and nothing of complex ones"));
    }
    check_status(claim, real)?;
    Ok(Holds::Real(real))
}

/// Checks a certificate of an answer without real solutions by distances, which are checked, and that counts no complex ones.
fn out_of_reach(claim: &Claim, balls: &[Ball]) -> Result<Holds, Fault> {
    if balls.len() != shown(0) || balls.iter().any(|ball| ball.real) {
        return refused("modes: one solution is asked for that is not real, and shows that the data are these");
    }
    if claim.status != "unreachable" || claim.real != Some(0) || claim.complex.is_some() {
        return refused("claim: no real solution is proved, and nothing of complex ones");
    }
    Ok(Holds::OutOfReach)
}

/// Checks a certificate of a self-motion: theorem 6.
fn of_self_motion(
    closed: &Closed,
    verb: &str,
    dimension: usize,
    modes: usize,
    proof: &[Value],
) -> Result<Holds, Fault> {
    let (Closed::Chain(closure), [item]) = (closed, proof) else {
        return refused("proof: one item shows that the solutions of an arm or a loop form a curve");
    };
    if verb != "solve" || dimension != 1 {
        return refused("claim: only self-motions of dimension 1 are proved");
    }
    if modes > 0 {
        return refused("modes: none are asked for here");
    }
    if item.get("kind").and_then(Value::as_str) != Some(CURVE) {
        return refused("proof: self-motions are proved by an item of the kind `curve`");
    }
    follows_a_curve(closure, item)?;
    Ok(Holds::SelfMotion)
}

/// The fault of a certificate that is about another file.
const OTHER_FILE: &str = "file: the data of the certificate are those of no case of the file";

/// Returns the arm, loop or platform of a file: no other file has data of these kinds.
fn entry_in(file: &Any) -> Result<&Entry, Fault> {
    if let Any::Entry(entry) = file { Ok(entry) } else { refused(OTHER_FILE) }
}

/// Checks a certificate of a linkage in the plane: theorem 13.
fn of_linkage(record: Record, file: Option<&Any>) -> Result<Holds, Fault> {
    let text = Value::Object(record.data.clone()).to_string();
    let read = any_from_text(&text, "data", Format::Json, &Options::default());
    let Any::Linkage(own) = read.map_err(|error| Fault::Unreadable(error.to_string()))? else {
        return refused("data: only linkages in the plane are covered");
    };
    let ([case], data) = (own.cases.as_slice(), Value::Object(record.data)) else {
        return unreadable("data: found several cases, expected one");
    };
    let closure = LinkageClosure::of(&own.linkage, &case.given)?;
    check_data(data_of_linkage(&own, case), &data)?;
    let is_own = |file: &Any| match file {
        Any::Linkage(file) => file.cases.iter().any(|case| data_of_linkage(file, case).is_ok_and(|one| one == data)),
        _ => false,
    };
    if file.is_some_and(|file| !is_own(file)) {
        return refused(OTHER_FILE);
    }
    if let Some(at) = record.modes.iter().position(|mode| mode.multiplicity != 1) {
        return refused(format!("mode {}: a ball of an isolated simple solution counts once", at + 1));
    }
    let balls: Vec<Ball> = record.modes.into_iter().map(|mode| mode.ball).collect();
    closure.proved(&balls)?;
    match record.proof.as_slice() {
        [item] if item.get("kind").and_then(Value::as_str) == Some(kernel::KIND) => {
            kernel::check_kernel(&closure, &balls, item)?;
        }
        _ => return refused("proof: linkages in the plane are covered by one item of theorem 13"),
    }
    let (complex, real) = (balls.len(), balls.iter().filter(|ball| ball.real).count());
    if record.claim.complex != Some(complex) || record.claim.real != Some(real) {
        return refused(format!("claim: other numbers than {complex} solutions, {real} of them real, are proved"));
    }
    check_status(&record.claim, real)?;
    Ok(Holds::Solutions { complex, real })
}

/// Checks a certificate of `sweep`: theorem 14.
fn of_sweep(record: Record, file: Option<&Any>) -> Result<Holds, Fault> {
    let Some(claim) = &record.claim.sweep else { return refused("claim: it is about no branches") };
    let status = &record.claim.status;
    let [branches, circuits, limits] = check_sweep(&record.data, status, claim, record.modes.len(), &record.proof)?;
    let data = Value::Object(record.data);
    if file.is_some_and(|file| !four_bars::is_about(file, &data)) {
        return refused(OTHER_FILE);
    }
    Ok(Holds::Branches { branches, circuits, limits })
}

/// Checks a certificate of `mobility`.
fn of_motion(record: Record, file: Option<&Entry>) -> Result<usize, Fault> {
    if record.data.contains_key("input") {
        return refused("data: a loop that is asked whether it moves has no input");
    }
    let entry = entry_of(&record.data, Chains::Any)?;
    let dimension = mobility(&entry, &record.data, &record.claim, record.modes, &record.proof);
    let own = Value::Object(record.data);
    check_data(data_of_loop(&entry), &own)?;
    if file.is_some_and(|file| data_of_loop(file) != Ok(own)) {
        return refused("file: the data of the certificate are not those of the file");
    }
    dimension
}

/// Checks that data are written in their canonical form.
fn check_data(canonical: Result<Value, String>, own: &Value) -> Result<(), Fault> {
    match canonical {
        Ok(canonical) if canonical == *own => Ok(()),
        Ok(_) => refused("data: the numbers are not written in the one form that docs/certificate.md gives them"),
        Err(reason) => refused(format!("data: {reason}")),
    }
}

/// Returns the closure equations of a case.
///
/// # Errors
/// [`Fault`] for kinds that are not covered.
pub fn closed(entry: &Entry, case: &Case) -> Result<Closed, Fault> {
    Ok(match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => {
            let is_exact = !entry.rounded
                && case.pose.as_ref().is_none_or(|pose| pose.given.is_none())
                && case.input.iter().all(|input| input.value.is_exact());
            Closed::Chain(Box::new(ChainClosure::of(chain, Some(case), is_exact)?))
        }
        Design::Platform(platform) => Closed::Platform(Box::new(PlatformClosure::of(platform, case)?)),
    })
}

/// Checks every certificate of a text, one after the other, and returns each outcome with its number from 1.
///
/// # Errors
/// [`Fault::Unreadable`] if the text consists of no certificates.
pub fn check_all(
    text: &str,
    file: Option<&Any>,
    mut each: impl FnMut(usize, Result<Holds, Fault>),
) -> Result<(), Fault> {
    let mut found = 0;
    // A long text has one certificate per line, so that only one is in memory.
    let parts: Vec<&str> = if text.len() > LARGEST { text.lines().collect() } else { vec![text] };
    for part in parts {
        if part.len() > LARGEST {
            return unreadable(format!("found more than {LARGEST} bytes in one certificate"));
        }
        for value in Deserializer::from_str(part).into_iter::<Strict>() {
            let Strict(value) = value.map_err(|error| Fault::Unreadable(format!("found no JSON: {error}")))?;
            found += 1;
            match check(&value, file) {
                Err(Fault::Unreadable(message)) => return unreadable(message),
                outcome => each(found, outcome),
            }
        }
    }
    if found == 0 { unreadable("found no certificate") } else { Ok(()) }
}
