//! The closure equations of loops and arms of special dimensions, written down here and counted by Singular and msolve:
//! no line of the program is asked but for its answer.

use super::{file, program};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::{Format as Language, Options, load_text};
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::{Format, Names};
use rand::{Rng, SeedableRng, seq::IndexedRandom};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::fmt::Write;
use std::fs;
use std::process::Command;

type P = Polynomial<Rational>;
type Matrix = [[P; 4]; 4];

/// A revolute joint: length, tangent of half the twist, offset.
#[derive(Clone, Copy)]
struct Link {
    a: i32,
    tangent: (i32, i32),
    d: i32,
}

/// A loop at an input, or an arm at a pose that joint values reach.
struct Case {
    title: String,
    links: Vec<Link>,
    /// Joint and half tangent, or none of an arm.
    input: Option<(usize, (i32, i32))>,
    /// The half tangents by which the pose of an arm is planted.
    planted: Vec<(i32, i32)>,
}

fn number(x: Rational) -> P {
    P::constant(x)
}

fn rational((n, d): (i32, i32)) -> Rational {
    Rational::from((n, d))
}

/// Cosine and sine of an angle with this half tangent.
fn unit(tangent: Rational) -> [Rational; 2] {
    let square = Rational::from(&tangent * &tangent);
    let over = Rational::from(&square + 1).recip();
    [(Rational::from(1) - square) * &over, tangent * 2 * over]
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| (0..4).fold(P::zero(), |sum, k| sum.add(&a[i][k].mul(&b[k][j])));
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn identity() -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { P::one() } else { P::zero() }))
}

/// `Rz Tz Rx Tx` with these cosine and sine of the joint, or its inverse.
fn joint(link: &Link, [c, s]: &[P; 2], is_inverse: bool) -> Matrix {
    let [ca, sa] = unit(rational(link.tangent)).map(number);
    let (a, d, zero, one) = (number(link.a.into()), number(link.d.into()), P::zero(), P::one());
    if is_inverse {
        return [
            [c.clone(), s.clone(), zero.clone(), a.neg()],
            [s.mul(&ca).neg(), c.mul(&ca), sa.clone(), d.mul(&sa).neg()],
            [s.mul(&sa), c.mul(&sa).neg(), ca.clone(), d.mul(&ca).neg()],
            [zero.clone(), zero.clone(), zero, one],
        ];
    }
    [
        [c.clone(), s.mul(&ca).neg(), s.mul(&sa), a.mul(c)],
        [s.clone(), c.mul(&ca), c.mul(&sa).neg(), a.mul(s)],
        [zero.clone(), sa, ca, d],
        [zero.clone(), zero.clone(), zero, one],
    ]
}

impl Case {
    /// The pose of an arm: the product at the planted values; of a loop the identity.
    fn pose(&self) -> Matrix {
        let planted = self.links.iter().zip(&self.planted);
        planted.fold(identity(), |product, (link, tangent)| {
            times(&product, &joint(link, &unit(rational(*tangent)).map(number), false))
        })
    }

    /// The equations, and how many variables they have.
    fn equations(&self) -> (Vec<P>, usize) {
        let (mut count, mut equations) = (0, Vec::new());
        let mut pairs: Vec<[P; 2]> = Vec::new();
        for k in 0..self.links.len() {
            match self.input {
                Some((given, tangent)) if given == k + 1 => pairs.push(unit(rational(tangent)).map(number)),
                _ => {
                    let [c, s] = [count, count + 1].map(P::variable);
                    equations.push(c.mul(&c).add(&s.mul(&s)).sub(&P::one()));
                    pairs.push([c, s]);
                    count += 2;
                }
            }
        }
        let (middle, all) = (self.links.len() / 2, self.links.len());
        let left = (0..middle).fold(identity(), |m, k| times(&m, &joint(&self.links[k], &pairs[k], false)));
        let right = (middle..all).rev().fold(self.pose(), |m, k| times(&m, &joint(&self.links[k], &pairs[k], true)));
        for i in 0..3 {
            equations.extend((0..4).map(|j| left[i][j].sub(&right[i][j])));
        }
        equations.retain(|f| !f.is_zero());
        (equations, count)
    }

    fn text(&self) -> String {
        let kind = if self.input.is_some() { "loop" } else { "arm" };
        let mut text = format!("[mechanism]\nkind = \"{kind}\"\nconvention = \"dh\"\njoints = [\n");
        for Link { a, tangent: (n, d), d: offset } in &self.links {
            let _ = writeln!(text, "{{ type = \"R\", a = {a}, tan_half_alpha = \"{n}/{d}\", d = {offset} }},");
        }
        text += "]\n";
        if let Some((joint, (n, d))) = self.input {
            let _ = writeln!(text, "[[input]]\njoint = {joint}\ntan_half = \"{n}/{d}\"");
        } else {
            let entry = |x: &P| x.to_constant().unwrap();
            let row = |row: &[P; 4]| row.iter().map(|x| format!("\"{}\"", entry(x))).collect::<Vec<_>>().join(", ");
            let rows: Vec<String> = self.pose().iter().map(|r| format!("[{}]", row(r))).collect();
            let _ = writeln!(text, "[[pose]]\nmatrix = [{}]", rows.join(", "));
        }
        text
    }

    fn solve(&self) -> Solution {
        let entry = load_text(&self.text(), "own.toml", Language::Toml, &Options::default()).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let mechanism = Mechanism::prepare(&entry).unwrap();
        mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
    }
}

/// Planar and spherical four-bars, folding ones too, Bennett's and Bricard's loops, at ordinary inputs and where they fold.
fn loops(random: &mut ChaCha8Rng) -> Vec<Case> {
    let planar = |a| Link { a, tangent: (0, 1), d: 0 };
    let concurrent = |tangent| Link { a: 0, tangent, d: 0 };
    let bennett = [((4, 1), (1, 2)), ((3, 1), (1, 3))].map(|((a, _), tangent)| Link { a, tangent, d: 0 });
    let right = |k: usize, a| Link { a, tangent: (if k.is_multiple_of(2) { 1 } else { -1 }, 1), d: 0 };
    let bricard: Vec<Link> = [3, 5, 4, 3, 5, 4].into_iter().enumerate().map(|(k, a)| right(k, a)).collect();
    let kinds: Vec<(&str, Vec<Link>)> = vec![
        ("parallelogram", [2, 3, 2, 3].map(planar).to_vec()),
        ("kite", [2, 2, 3, 3].map(planar).to_vec()),
        ("folding", [2, 5, 4, 3].map(planar).to_vec()),
        ("planar", [2, 5, 4, 4].map(planar).to_vec()),
        ("spherical", [(1, 3), (1, 2), (1, 3), (1, 2)].map(concurrent).to_vec()),
        ("spherical, folding", [(1, 2), (1, 3), (1, 5), (2, 3)].map(concurrent).to_vec()),
        ("Bennett", [bennett[0], bennett[1], bennett[0], bennett[1]].to_vec()),
        ("Bricard", bricard),
    ];
    let mut cases = Vec::new();
    for (title, links) in kinds {
        for _ in 0..4 {
            let joint = random.random_range(1..=links.len());
            let tangent = *[(0, 1), (1, 1), (1, 2), (-2, 3), (3, 5), (5, 1)].choose(random).unwrap();
            let title = format!("{title}, joint {joint} at {tangent:?}");
            cases.push(Case { title, links: links.clone(), input: Some((joint, tangent)), planted: Vec::new() });
        }
    }
    cases
}

/// Arms of zeros, right angles and small numbers, at a pose reached by joint values of the same kind.
fn arms(random: &mut ChaCha8Rng) -> Vec<Case> {
    const TANGENTS: [(i32, i32); 6] = [(0, 1), (1, 1), (-1, 1), (1, 2), (-2, 3), (1, 3)];
    let case = |number: i32| {
        let mut link = |last: bool| Link {
            a: if last { 0 } else { *[0, 0, 1, 1, -1, 2].choose(random).unwrap() },
            tangent: if last { (0, 1) } else { *TANGENTS.choose(random).unwrap() },
            d: if last { 0 } else { *[0, 0, 1, 1, -2].choose(random).unwrap() },
        };
        let links: Vec<Link> = (0..6).map(|k| link(k == 5)).collect();
        let planted = (0..6).map(|_| *TANGENTS.choose(random).unwrap()).collect();
        Case { title: format!("arm {number}"), links, input: None, planted }
    };
    (0..24).map(case).collect()
}

/// A program that is stopped after a minute: one of the cases may be too much for it.
fn limited(command: &Command) -> Command {
    let mut limited = Command::new("timeout");
    limited.arg("60").arg(command.get_program());
    limited
}

/// The dimension of the set of solutions, -1 for none, and their number with multiplicity, modulo a large prime.
fn singular(equations: &str, names: &[String]) -> Option<(i32, usize)> {
    let mut command = limited(&program("Singular", "LOOPROOT_SINGULAR"));
    let script = format!(
        "ring r = 2147483647, ({}), dp;\nideal i = {equations};\nideal g = std(i);\ndim(g);\nvdim(g);\nquit;\n",
        names.join(", ")
    );
    let answer = super::talk(
        {
            command.arg("-q");
            command
        },
        &script,
    );
    let mut numbers = answer.lines().filter_map(|line| line.trim().parse::<i32>().ok());
    let (dimension, count) = (numbers.next()?, numbers.next()?);
    Some((dimension, usize::try_from(count).unwrap_or(0)))
}

/// The number of real solutions, by isolation over the rationals.
fn msolve(equations: &str, names: &[String]) -> Option<usize> {
    let text = format!("{}\n0\n{}\n", names.join(","), equations.replace(", ", ",\n"));
    let (input, output) = (file("closure.ms", &text), file("closure.ms.out", ""));
    let mut command = limited(&program("msolve", "LOOPROOT_MSOLVE"));
    let is_done = command.arg("-f").arg(input).arg("-o").arg(&output).status().unwrap().success();
    let answer = fs::read_to_string(output).unwrap();
    if answer.trim() == "[-1]:" {
        return Some(0);
    }
    let list = answer.trim().strip_prefix("[0, [1,").filter(|_| is_done)?;
    // Every point is a list within the list.
    let (mut depth, mut points) = (0, 0);
    for c in list.chars() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        points += usize::from(c == '[' && depth == 2);
    }
    Some(points)
}

/// Returns whether an answer agrees with the results of the other programs; `None` where one of them found nothing in time.
fn agrees(case: &Case) -> Option<bool> {
    let (equations, count) = case.equations();
    let names: Vec<String> = (0..count).map(|k| format!("x{k}")).collect();
    let variables = Names::given(&names).unwrap();
    let texts: Vec<String> = equations.iter().map(|f| Format::Text.polynomial(f, &variables)).collect();
    let equations = texts.join(", ");
    let (dimension, complex) = singular(&equations, &names)?;
    let solution = case.solve();
    let verdict = &solution.verdict;
    let is_proved = verdict.proof == Proof::Proved;
    eprintln!("{}: dimension {dimension}, {complex}; {} {}", case.title, verdict.status.word(), verdict.reason);
    if dimension > 0 {
        let is_finite = matches!(verdict.status, Status::Complete | Status::Unreachable);
        return Some(!(is_proved && is_finite));
    }
    assert!(verdict.self_motion == 0 || !is_proved, "{}", case.title);
    if !is_proved {
        return Some(true);
    }
    let real = msolve(&equations, &names)?;
    let found = solution.modes.iter().filter(|mode| mode.real).count();
    Some(found == real && (!verdict.complex_complete || verdict.complex == complex))
}

#[test]
#[ignore = "needs Singular and msolve"]
fn closure_equations_have_the_solutions_that_are_listed() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let cases: Vec<Case> = loops(&mut random).into_iter().chain(arms(&mut random)).collect();
    let answers: Vec<Option<bool>> = cases.iter().map(agrees).collect();
    for (case, answer) in cases.iter().zip(&answers) {
        assert_ne!(*answer, Some(false), "{}\n{}", case.title, case.text());
    }
    let compared = answers.iter().flatten().count();
    eprintln!("{compared} of {} cases compared", cases.len());
    assert!(2 * compared > cases.len(), "{compared} of {}", cases.len());
}
