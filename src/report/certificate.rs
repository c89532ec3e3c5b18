//! The certificate of an answer: docs/certificate.md.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::assembly::{Assembly, Roots, Solver, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::catalogue::{LinkageCase, LinkageFile, SphereFile};
use crate::certificate::{
    Ball, ChainClosure, Closed, FAMILIES, FORMAT, Fault, LinkageClosure, Listed, Near, VERSION, balls,
    balls_of_linkage, check, claim_of_families, closed, data_of, data_of_linkage, data_of_loop,
    data_of_turning_linkage, data_of_turning_loop, data_of_turning_sphere, proof_by_distance, proof_of, proof_of_all,
    proof_of_doubles, proof_of_kernel, proof_of_motion, proof_of_own, proof_of_points, proof_of_polynomial,
    proof_of_real_list, proof_of_rest, proof_of_self_motion, proof_of_sweep, proved_modes,
};
use crate::conditions::four_bar::{self, FourBar};
use crate::derivation::Derivation;
use crate::derivation::transference::Variables;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use crate::linkage::answer::LinkageAnswer;
use crate::mechanism::{FullMode, Mechanism, Solution};
use crate::mobility::Mobility;
use crate::report::sweep::Swept;
use crate::sweep::{AssemblySweep, LinkageSweep, SphereSweep, Sweep};
use crate::verdict::Status;
use num_complex::Complex;
use rug::{Integer, Rational, ops::Pow};
use serde_json::{Value, json};

/// The program that wrote a certificate.
const PROGRAM: &str = concat!("looproot ", env!("CARGO_PKG_VERSION"));
/// The reason where no solution is counted and none can be shown.
const NOTHING_SHOWN: &str = "no complex solution is known well enough to show what the data are";
/// Factor by which the radius of a solution that is not counted is smaller than it may be: where nothing is in reach, lengths may differ by
/// many powers of ten, and another checker then bounds derivatives by that much more.
const NARROWER: u32 = 1000;
/// Largest number of decimals that a centre or a radius has.
const DECIMALS: u32 = 30;

/// Returns the certificate of one case, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate(entry: &Entry, number: usize, case: &Case, solution: &Solution) -> Result<Value, String> {
    let verdict = &solution.verdict;
    if verdict.status == Status::SelfMotion {
        return certificate_of_self_motion(entry, number, case, solution);
    }
    if !verdict.proof.is_proved() || !matches!(verdict.status, Status::Complete | Status::Unreachable) {
        return Err("the answer is not proved".to_owned());
    }
    let data = data_of(entry, case)?;
    let closed = closed(entry, case).map_err(|fault| words(&fault))?;
    let short =
        if let Closed::Chain(closure) = &closed { Some(closure).filter(|closure| closure.is_short()) } else { None };
    if solution.arm.is_some() && short.is_none() {
        return Err("answers to arms of more than six joints, to tasks and with joints held are not covered".to_owned());
    }
    let info = info_of(entry, number);
    if let Some(closure) = short {
        let (claim, balls, proof) = of_short_loop(closure, &closed, solution)?;
        return accepted(&info, &data, &claim, &balls, &proof);
    }
    if let Closed::Chain(closure) = &closed
        && solution.modes.iter().any(|mode| !mode.near && mode.multiplicity == 2)
        && let Some((claim, modes, proof)) = with_doubles(closure, &closed, solution)
    {
        return accepted_modes(&info, &data, &claim, &modes, &proof);
    }
    let (claim, balls, proof) = counted(&closed, solution).or_else(|reason| {
        let none = || not_real(entry, case, &closed, solution);
        let distance = if verdict.status == Status::Unreachable { proof_by_distance(&closed) } else { None };
        let claim = json!({ "verb": "solve", "status": "unreachable", "proof": "proved", "real": 0 });
        match distance {
            Some(proof) => Ok((claim, vec![none().ok_or(NOTHING_SHOWN)?], proof)),
            None => real_list(&closed, solution, &none).ok_or(reason),
        }
    })?;
    accepted(&info, &data, &claim, &balls, &[proof])
}

/// Returns the certificate that the solutions of one case form a curve. Of other solutions it says nothing.
fn certificate_of_self_motion(entry: &Entry, number: usize, case: &Case, solution: &Solution) -> Result<Value, String> {
    let data = data_of(entry, case)?;
    let Closed::Chain(closure) = closed(entry, case).map_err(|fault| words(&fault))? else {
        return Err("self-motions of platforms are not covered".to_owned());
    };
    // What is asked of an arm may be less than its pose.
    let exact = solution.families.iter().filter(|family| family.dimension == 1 && family.distance == 0.0);
    let samples: Vec<Vec<f64>> = exact.map(|family| closure.unknowns(&family.sample)).collect();
    let proof = proof_of_self_motion(&closure, &samples, &found)
        .ok_or("no curve of solutions is proved by theorem 6 of docs/certificate.md")?;
    let claim = json!({ "verb": "solve", "status": "self-motion", "proof": "proved", "self_motion": 1 });
    accepted(&info_of(entry, number), &data, &claim, &[], &[proof])
}

/// Returns the certificate of one case of a linkage, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_linkage(
    file: &LinkageFile,
    number: usize,
    case: &LinkageCase,
    answer: &LinkageAnswer,
) -> Result<Value, String> {
    let verdict = &answer.verdict;
    if !verdict.proof.is_proved() || !matches!(verdict.status, Status::Complete | Status::Unreachable) {
        return Err("the answer is not proved, or has a self-motion".to_owned());
    }
    if !verdict.complex_complete {
        return Err("not all complex assemblies are listed".to_owned());
    }
    if answer.modes.len() != verdict.complex {
        return Err("multiple assemblies are not covered".to_owned());
    }
    if answer.modes.is_empty() {
        return Err("there is no assembly, which would show what the data are".to_owned());
    }
    let data = data_of_linkage(file, case)?;
    let closure = LinkageClosure::of(&file.linkage, &case.given).map_err(|fault| words(&fault))?;
    let near: Option<Vec<Near>> = answer
        .modes
        .iter()
        .map(|mode| Some((closure.unknowns(&|body| mode.bodies[body].0, &|joint| mode.joints[joint])?, mode.real)))
        .collect();
    let balls = near.and_then(|near| balls_of_linkage(&closure, &near));
    let balls = balls.ok_or("an assembly is too ill conditioned for a ball of its own")?;
    let proof = proof_of_kernel(&closure, &balls).ok_or("no matrix that is tried has a kernel as small as the list")?;
    let claim = solved(balls.len(), balls.iter().filter(|ball| ball.real).count());
    let info = json!({ "program": PROGRAM, "name": file.heading.name, "title": file.heading.title, "case": number });
    accepted(&info, &data, &claim, &balls, &[proof])
}

/// Returns what no checker reads.
fn info_of(entry: &Entry, number: usize) -> Value {
    json!({ "program": PROGRAM, "name": entry.name, "title": entry.title, "case": number })
}

/// Returns the claim of an answer that counts all its solutions, a ball around each, and the item that bounds their number.
fn counted(closed: &Closed, solution: &Solution) -> Result<(Value, Vec<Ball>, Value), String> {
    let verdict = &solution.verdict;
    if !verdict.complex_complete {
        return Err(format!("proofs with the code {} are not covered", verdict.code.word()));
    }
    let modes: Vec<&FullMode> = solution.modes.iter().filter(|mode| !mode.near).collect();
    if modes.len() != verdict.complex {
        return Err("multiple solutions are not covered".to_owned());
    }
    let near: Vec<(Vec<Complex<f64>>, bool)> = modes.iter().map(|mode| (unknowns(closed, mode), mode.real)).collect();
    let balls = balls(closed, &near).ok_or("a solution is too ill conditioned for a ball of its own")?;
    let proof = proof_of(closed, &balls)
        .ok_or("no bound of docs/certificate.md is met: the code is ".to_owned() + verdict.code.word())?;
    let (complex, real) = (balls.len(), balls.iter().filter(|ball| ball.real).count());
    Ok((solved(complex, real), balls, proof))
}

/// Returns the claim, the modes and the proof of an answer with double solutions; `None` where theorem 15 does not cover it.
fn with_doubles(
    closure: &ChainClosure,
    closed: &Closed,
    solution: &Solution,
) -> Option<(Value, Vec<Value>, Vec<Value>)> {
    let listed = || solution.modes.iter().filter(|mode| !mode.near);
    let of = |multiplicity: usize| -> Vec<Near> {
        let own = listed().filter(|mode| mode.multiplicity == multiplicity);
        own.map(|mode| (closure.unknowns(&mode.q), mode.real)).collect()
    };
    let (simple, double) = (of(1), of(2));
    let is_all = simple.len() + double.len() == listed().count();
    let counted = simple.len() + 2 * double.len();
    if !is_all || !solution.verdict.complex_complete || counted != solution.verdict.complex {
        return None;
    }
    let simple = balls(closed, &simple)?;
    let (double, item) = proof_of_doubles(closure, &double)?;
    let all: Vec<Ball> = simple.iter().chain(&double).cloned().collect();
    let bound = proof_of_all(closed, &all, double.len())?;
    let modes = simple.iter().map(|ball| mode(ball, 1)).chain(double.iter().map(|ball| mode(ball, 2))).collect();
    let real = |balls: &[Ball]| balls.iter().filter(|ball| ball.real).count();
    Some((solved(counted, real(&simple) + 2 * real(&double)), modes, vec![bound, item]))
}

/// Returns the claim of an answer to a loop of fewer than six unknowns, balls around all solutions of the longer loop, and the proof.
fn of_short_loop(
    closure: &ChainClosure,
    closed: &Closed,
    solution: &Solution,
) -> Result<(Value, Vec<Ball>, Vec<Value>), String> {
    let near = found(closure);
    let all =
        balls(closed, &near).ok_or("a solution of the longer loop is too ill conditioned for a ball of its own")?;
    let (own, points) = proof_of_points(closure, &near, &all)
        .ok_or("the solutions are no points with coordinates of few digits over one polynomial")?;
    // One solution of the longer loop alone shows that the data are these: those of the loop may be solutions of others, too, as the home
    // position of an arm by screws is, wherever the axes are.
    let is_of_longer = |ball: &&Ball| !own.iter().any(|own| own.centre == ball.centre);
    let shown = || -> Vec<Ball> { own.iter().chain(all.iter().find(is_of_longer)).cloned().collect() };
    let by_own = || proof_of_own(closure, &own).map(|bound| (shown(), bound)).filter(|(shown, _)| !shown.is_empty());
    let (balls, bound) = by_own()
        .or_else(|| proof_of(closed, &all).map(|bound| (all, bound)))
        .ok_or("no bound of docs/certificate.md is met by the loop, or by the longer one")?;
    // What is asked of an arm may be less than its pose: then other configurations are listed.
    let modes: Vec<Vec<Complex<f64>>> =
        solution.modes.iter().filter(|mode| !mode.near).map(|mode| closure.unknowns(&mode.q)).collect();
    let is_listed = |ball: &Ball| modes.iter().any(|mode| closure.is_around(ball, mode));
    let is_found = |mode: &Vec<Complex<f64>>| own.iter().any(|ball| closure.is_around(ball, mode));
    if !own.iter().filter(|ball| ball.real).all(is_listed) || !modes.iter().all(is_found) {
        return Err("the modes are others than the solutions of the pose".to_owned());
    }
    let (complex, real) = (own.len(), own.iter().filter(|ball| ball.real).count());
    Ok((solved(complex, real), balls, std::iter::once(bound).chain(points).collect()))
}

/// Returns the claim that counts all solutions.
fn solved(complex: usize, real: usize) -> Value {
    json!({
        "verb": "solve",
        "status": if real == 0 { "unreachable" } else { "complete" },
        "proof": "proved",
        "complex": complex,
        "real": real,
    })
}

/// Returns the claim of an answer about real solutions alone, a ball around each, and the item that bounds their number; `None` if
/// there is none.
fn real_list(
    closed: &Closed,
    solution: &Solution,
    none: &dyn Fn() -> Option<Ball>,
) -> Option<(Value, Vec<Ball>, Value)> {
    let near: Vec<(Vec<Complex<f64>>, bool)> = solution
        .modes
        .iter()
        .filter(|mode| mode.real && !mode.near)
        .map(|mode| (unknowns(closed, mode), true))
        .collect();
    let balls = balls(closed, &near)?;
    let proof = proof_of_real_list(closed, balls.len())?;
    let status = if balls.is_empty() { "unreachable" } else { "complete" };
    let claim = json!({ "verb": "solve", "status": status, "proof": "proved", "real": balls.len() });
    Some((claim, if balls.is_empty() { vec![none()?] } else { balls }, proof))
}

/// Returns a ball around one solution that is not real. Where no solution is counted it shows that the data are these.
fn not_real(entry: &Entry, case: &Case, closed: &Closed, solution: &Solution) -> Option<Ball> {
    let of_solution = |solution: &Solution| -> Vec<Near> {
        let simple = solution.modes.iter().filter(|mode| !mode.near && !mode.real);
        simple.map(|mode| (unknowns(closed, mode), false)).collect()
    };
    // An answer about real solutions alone may list no others.
    let searched = || match closed {
        Closed::Chain(closure) => found(closure),
        Closed::Platform(_) => {
            let mechanism = Mechanism::prepare(entry).ok();
            let solved = mechanism.and_then(|mechanism| {
                mechanism.solve(case, Roots::All, &mut Workspace::default(), &mut Assembly::default()).ok()
            });
            solved.map_or_else(Vec::new, |solution| of_solution(&solution))
        }
    };
    let near = of_solution(solution).into_iter().chain(std::iter::once_with(searched).flatten());
    let ball = near.filter(|(_, real)| !real).find_map(|one| balls(closed, &[one]))?.pop()?;
    let narrow = [Ball { radius: Rational::from(&ball.radius / NARROWER), ..ball.clone() }];
    Some(if proved_modes(closed, &narrow).is_ok() { narrow[0].clone() } else { ball })
}

/// Returns the certificate of a closure polynomial: its roots are the half-angle tangents of one joint at all solutions. The checker of
/// [`crate::certificate`] accepts it.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_polynomial(
    entry: &Entry,
    number: usize,
    case: &Case,
    derivation: &Derivation,
) -> Result<Value, String> {
    let (Design::Arm(chain) | Design::Loop(chain)) = &entry.design else {
        return Err("polynomials of platforms are not covered".to_owned());
    };
    let (Some(polynomial), Some((variable, Variable::Rotation))) = (&derivation.polynomial, derivation.unknown(chain))
    else {
        return Err("only polynomials in the tangent of half an angle are covered".to_owned());
    };
    let data = data_of(entry, case)?;
    let closed = closed(entry, case).map_err(|fault| words(&fault))?;
    let mechanism = Mechanism::prepare(entry).map_err(|error| error.to_string())?;
    let solution = mechanism.solve(case, Roots::All, &mut Workspace::default(), &mut Assembly::default());
    let (mut claim, balls, proof) = counted(&closed, &solution.map_err(|error| error.to_string())?)?;
    let no = || "the polynomial is no factor of an eliminant whose other roots belong to no solution".to_owned();
    let Closed::Chain(closure) = &closed else { return Err(no()) };
    if closure.is_short() {
        return Err("polynomials of loops of fewer than six unknowns are not covered".to_owned());
    }
    let unknown = closure.unknown(variable).ok_or_else(no)?;
    let coefficients = polynomial.coefficients.coefficients();
    let membership = proof_of_polynomial(closure, &balls, unknown, coefficients).ok_or_else(no)?;
    let texts: Vec<String> = coefficients.iter().map(Integer::to_string).collect();
    claim["verb"] = json!("derive");
    claim["unknown"] = json!(unknown + 1);
    claim["degree"] = json!(coefficients.len() - 1);
    claim["polynomial"] = json!(texts);
    let info = info_of(entry, number);
    accepted(&info, &data, &claim, &balls, &[proof, membership])
}

/// Returns solutions of a loop that are not proved.
fn found(closure: &ChainClosure) -> Vec<Near> {
    let mut assembly = Assembly::default();
    let solver = Solver::prepare(&closure.rounded());
    solver.solve(&Motion::identity(), Roots::All, &mut Workspace::default(), &mut assembly);
    let simple = assembly.modes.iter().filter(|mode| mode.multiplicity == 1);
    simple.map(|mode| (mode.unknowns.to_vec(), mode.real)).collect()
}

/// Returns the certificate of the decision whether a loop moves, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_motion(entry: &Entry, answer: &Mobility) -> Result<Value, String> {
    let dimension = match answer.mobility {
        Some(dimension @ 0..=1) if answer.proof.is_proved() => dimension,
        Some(_) if answer.proof.is_proved() => {
            return Err("motions of more than one dimension are not covered".to_owned());
        }
        _ => return Err("the answer is not proved".to_owned()),
    };
    let data = data_of_loop(entry)?;
    let configurations: Vec<Vec<f64>> = answer.configurations.iter().map(|own| own.q.clone()).collect();
    let found =
        if dimension > 0 { proof_of_motion(entry, &configurations, &found) } else { proof_of_rest(entry, &found) };
    let (proof, balls) = found
        .ok_or_else(|| format!("no theorem of docs/certificate.md applies: the code is {}", answer.code.word()))?;
    let info = json!({ "program": PROGRAM, "name": entry.name, "title": entry.title });
    let claim = json!({
        "verb": "mobility",
        "status": if dimension == 0 { "immobile" } else { "mobile" },
        "proof": "proved",
        "mobility": dimension,
    });
    accepted(&info, &data, &claim, &balls, &[proof])
}

/// Returns the certificate of all branches of a loop over a full turn of its input, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_sweep(entry: &Entry, swept: Swept, found: &Sweep) -> Result<Value, String> {
    let circuits = found.branches.iter().map(|branch| branch.circuit).max().unwrap_or(0);
    let counts = [found.branches.len(), circuits, found.limits.len()];
    let is_turn = found.is_full_turn && swept.variable == Variable::Rotation;
    let data = || data_of_turning_loop(entry, swept.joint);
    let info = json!({ "program": PROGRAM, "name": entry.name, "title": entry.title });
    of_turn(&info, (found.verdict.proof.is_proved(), is_turn), &data, counts)
}

/// Returns the certificate of all branches of a linkage over a full turn of its input, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_linkage_sweep(file: &LinkageFile, found: &LinkageSweep) -> Result<Value, String> {
    let data = || data_of_turning_linkage(file, found.joint);
    let info = json!({ "program": PROGRAM, "name": file.heading.name, "title": file.heading.title });
    of_turn(&info, (found.verdict.proof.is_proved(), found.is_full_turn), &data, counts(found))
}

/// Returns the certificate of all branches of a linkage on the sphere over a full turn of its input, which the checker of
/// [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_sphere_sweep(file: &SphereFile, found: &SphereSweep) -> Result<Value, String> {
    let data = || data_of_turning_sphere(file, found.joint);
    let info = json!({ "program": PROGRAM, "name": file.heading.name, "title": file.heading.title });
    of_turn(&info, (found.verdict.proof.is_proved(), found.is_full_turn), &data, counts(found))
}

/// Returns the numbers of branches, circuits and limit positions.
fn counts<M>(found: &AssemblySweep<M>) -> [usize; 3] {
    let circuits = found.branches.iter().map(|branch| branch.circuit).max().unwrap_or(0);
    [found.branches.len(), circuits, found.limits.len()]
}

/// Returns the certificate of a sweep with so many branches, circuits and limit positions.
fn of_turn(
    info: &Value,
    (is_proved, is_turn): (bool, bool),
    data: &dyn Fn() -> Result<Value, String>,
    counts: [usize; 3],
) -> Result<Value, String> {
    if !is_proved {
        return Err("the answer is not proved".to_owned());
    }
    if !is_turn {
        return Err("only full turns of the input are covered".to_owned());
    }
    let data = data()?;
    let (claim, proof) = proof_of_sweep(&data)?;
    let limits = claim["limits"].as_array().map_or(0, Vec::len);
    if [&claim["branches"], &claim["circuits"], &json!(limits)] != counts.map(Value::from).each_ref() {
        return Err("the sweep has other branches than its discriminant".to_owned());
    }
    accepted(info, &data, &claim, &[], &[proof])
}

/// Returns the certificate of all families of loops of four rotations that move, which the checker of [`crate::certificate`] accepts.
///
/// # Errors
/// A clause that says why there is none.
pub fn certificate_of_conditions(theorem: &FourBar) -> Result<Value, String> {
    let x = |k: usize| Polynomial::variable(Variables::X + k);
    let mut families: Vec<Listed> = theorem
        .bennett
        .iter()
        .map(|bennett| {
            let mut conditions = four_bar::conditions(bennett);
            // The twist of link 3 comes before that of link 4.
            if conditions[0].degree(Variables::twist(2)) == 0 {
                conditions.swap(0, 1);
            }
            let follows = |k: usize| {
                let (above, below) = &bennett.angles[k];
                below.mul(&x(k)).sub(above)
            };
            Listed { class: "bennett", conditions, motion: vec![follows(1), follows(2), follows(3)] }
        })
        .collect();
    families.push(Listed {
        class: "spherical",
        conditions: (0..4)
            .map(Variables::length)
            .chain((0..4).map(Variables::offset))
            .map(Polynomial::variable)
            .collect(),
        // The program numbers joint 4 behind joint 1 where there are no others.
        motion: vec![theorem.pair.f.substitute(Variables::Y, &x(3))],
    });
    let info = json!({ "program": PROGRAM, "name": "4R", "title": "General 4R loop" });
    let claim = claim_of_families(&families);
    accepted(&info, &json!({ "joints": 4 }), &claim, &[], &[json!({ "kind": FAMILIES })])
}

/// Returns the certificate of these parts, once the checker has accepted it.
fn accepted(info: &Value, data: &Value, claim: &Value, balls: &[Ball], proof: &[Value]) -> Result<Value, String> {
    let modes: Vec<Value> = balls.iter().map(|ball| mode(ball, 1)).collect();
    accepted_modes(info, data, claim, &modes, proof)
}

/// As [`accepted`], of modes that may be double.
fn accepted_modes(
    info: &Value,
    data: &Value,
    claim: &Value,
    modes: &[Value],
    proof: &[Value],
) -> Result<Value, String> {
    let certificate = json!({
        "format": FORMAT,
        "version": VERSION,
        "info": info,
        "data": data,
        "claim": claim,
        "modes": modes,
        "proof": proof,
    });
    check(&certificate, None).map_err(|fault| words(&fault))?;
    Ok(certificate)
}

fn words(fault: &Fault) -> String {
    fault.to_string()
}

/// The unknowns of the closure equations.
fn unknowns(closed: &Closed, mode: &FullMode) -> Vec<Complex<f64>> {
    match closed {
        Closed::Chain(closure) => closure.unknowns(&mode.q),
        Closed::Platform(_) => {
            // A quaternion of norm 1: the complex one of the answer has the hermitian norm 1.
            let square: Complex<f64> = mode.q.iter().take(4).map(|x| x * x).sum();
            let norm = square.sqrt();
            mode.q.iter().enumerate().map(|(k, x)| if k < 4 { x / norm } else { *x }).collect()
        }
    }
}

fn mode(ball: &Ball, multiplicity: usize) -> Value {
    let part = |(re, im): &(Rational, Rational)| {
        if ball.real { json!(decimal(re)) } else { json!([decimal(re), decimal(im)]) }
    };
    let centre: Vec<Value> = ball.centre.iter().map(part).collect();
    json!({ "centre": centre, "radius": decimal(&ball.radius), "real": ball.real, "multiplicity": multiplicity })
}

/// A number of at most thirty decimals as such.
fn decimal(x: &Rational) -> String {
    let scaled = Rational::from(x * Integer::from(10).pow(DECIMALS)).round();
    let digits = scaled.numer().clone().abs().to_string();
    let padded = format!("{digits:0>width$}", width = DECIMALS as usize + 1);
    let (head, tail) = padded.split_at(padded.len() - DECIMALS as usize);
    let tail = tail.trim_end_matches('0');
    let sign = if *scaled.numer() < 0 { "-" } else { "" };
    if tail.is_empty() { format!("{sign}{head}") } else { format!("{sign}{head}.{tail}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_the_numbers() {
        for (p, q, text) in [(1, 8, "0.125"), (-5, 2, "-2.5"), (0, 1, "0"), (40, 1, "40"), (1, 100, "0.01")] {
            assert_eq!(decimal(&Rational::from((p, q))), text);
        }
    }
}
