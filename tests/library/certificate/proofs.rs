//! Bounds on rounding errors, and what the certificates claim.

use super::big::{Big, big, closure as exact_closure, distance, rigid, small, solution};
use crate::arms::{
    closed_at, general, motion, open, pose, puma_like, random, rounded, small as small_rational, spherical_wrist,
};
use looproot::internal::assembly::{Assembly, Mode, Roots, Solver, Workspace};
use looproot::internal::benchmark::sample::{Set, sample};
use looproot::internal::certify::{
    Refined, certificate, curvature, derivative_error, product_error, refined_certificate,
};
use looproot::internal::kinematics::chain::{Chain, Placement};
use looproot::internal::kinematics::closed_loop::{ClosedLoop, Variable};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::solve::dense::inverse;
use looproot::internal::solve::newton::{Closure, Six, closure, closure_at};
use looproot::internal::solve::scalar::{Number, Scalar};
use looproot_algebra::double_double::DoubleDouble;
use looproot_algebra::ring::Ring;
use num_complex::Complex;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

const ROTATIONS: [Variable; 6] = [Variable::Rotation; 6];

/// An arm at a pose: the loop as stored, the loop as given, and its modes.
struct Job {
    name: String,
    stored: ClosedLoop<f64>,
    given: ClosedLoop<Big>,
    modes: Vec<Mode>,
}

fn job(name: String, chain: &Chain, exact_pose: &Motion<Rational>) -> Job {
    let closing = rounded(&exact_pose.inverse());
    let open_loop = open::<f64>(chain);
    let mut assembly = Assembly::default();
    Solver::prepare(&open_loop).solve(&closing, Roots::All, &mut Workspace::default(), &mut assembly);
    let given = open::<Big>(chain).close(&exact_pose.inverse().map(Big::from_rational).unwrap());
    Job { name, stored: open_loop.close(&closing), given, modes: assembly.modes }
}

fn jobs() -> Vec<Job> {
    let mut random = random(50);
    let mut jobs = Vec::new();
    for k in 0..6 {
        let values: [Rational; 6] = std::array::from_fn(|_| small_rational(&mut random));
        let chain = match k {
            0 => puma_like(),
            1 => spherical_wrist(),
            _ => general(&mut random),
        };
        assert_eq!(closed_at::<Rational>(&chain, &values).variables, ROTATIONS);
        jobs.push(job(format!("rational arm {k}"), &chain, &pose(&chain, &values)));
    }
    for (set, count) in [(Set::General, 10), (Set::Structured, 6), (Set::NearSingular, 10), (Set::Calibrated, 5)] {
        for index in 0..count {
            let drawn = sample(set, 77, index).unwrap();
            let placement = drawn.entry.cases[0].pose.as_ref().unwrap();
            jobs.push(job(format!("{set:?} {index}"), &drawn.chain, &placement.exact));
        }
    }
    jobs
}

/// Unknowns moved by up to `size` in every coordinate.
fn moved<S: Scalar>(unknowns: &Six<Complex<f64>>, size: f64, random: &mut ChaCha8Rng) -> Six<S> {
    unknowns.map(|x| {
        let mut part = || size * random.random_range(-1.0..1.0);
        S::from_complex(x + Complex::new(part(), part()))
    })
}

/// The largest errors of residual and Jacobian (summed over a row), as parts of their bounds.
fn errors<S: Number>(
    here: &Closure<S>,
    given: &ClosedLoop<Big>,
    at: &Six<Complex<f64>>,
    as_big: impl Fn(S) -> Complex<Big>,
) -> [f64; 2] {
    let (residual, jacobian) = exact_closure(given, &at.map(big));
    let difference = |x: S, y: &Complex<Big>| small(&as_big(x).sub(y)).norm();
    let (mut of_residual, mut of_jacobian) = (0.0_f64, 0.0_f64);
    for i in 0..6 {
        of_residual = of_residual.max(difference(here.residual[i], &residual[i]));
        of_jacobian = of_jacobian.max((0..6).map(|j| difference(here.jacobian[i][j], &jacobian[i][j])).sum());
    }
    [of_residual / product_error(here), of_jacobian / derivative_error(here)]
}

fn big_of_quad(x: Complex<DoubleDouble>) -> Complex<Big> {
    let part = |x: DoubleDouble| {
        let high = x.to_f64();
        Big::from(high).add(&Big::from(x.sub(&DoubleDouble::from(high)).to_f64()))
    };
    Complex { re: part(x.re), im: part(x.im) }
}

/// Unknowns of which cosine and sine are known to twice the precision.
fn quad_pairs(at: &Six<Complex<f64>>) -> [(Complex<DoubleDouble>, Complex<DoubleDouble>); 6] {
    let part = |x: &Big| {
        let high = x.0.to_f64();
        DoubleDouble::from(high).add(&DoubleDouble::from(x.sub(&Big::from(high)).0.to_f64()))
    };
    at.map(|x| {
        let (cos, sin) = super::big::cos_sin(&big(x));
        (Complex { re: part(&cos.re), im: part(&cos.im) }, Complex { re: part(&sin.re), im: part(&sin.im) })
    })
}

#[test]
fn the_bounds_on_rounding_errors_are_bounds() {
    let mut random = random(51);
    let mut largest = [[0.0_f64; 2]; 3];
    for job in jobs() {
        let note = |kind: usize, parts: [f64; 2], largest: &mut [[f64; 2]; 3]| {
            assert!(parts[0] < 1.0 && parts[1] < 1.0, "{}: {parts:?} of the bounds, kind {kind}", job.name);
            for k in 0..2 {
                largest[kind][k] = largest[kind][k].max(parts[k]);
            }
        };
        for mode in &job.modes {
            for size in [0.0, 1e-9, 1e-5] {
                if mode.real {
                    let q: Six<f64> = moved(&mode.unknowns, size, &mut random);
                    let here = closure(&job.stored, &q);
                    note(0, errors(&here, &job.given, &q.map(Complex::from), |x| big(x.into())), &mut largest);
                }
                let q: Six<Complex<f64>> = moved(&mode.unknowns, size, &mut random);
                let here = closure(&job.stored, &q);
                note(1, errors(&here, &job.given, &q, big), &mut largest);
                // The bound in twice the precision is for constants known to it.
                let quad = rigid(&job.stored);
                let lift = |x: &Big| {
                    let high = x.0.to_f64();
                    Some(DoubleDouble::from(high).add(&DoubleDouble::from(x.sub(&Big::from(high)).0.to_f64())))
                };
                let constants = quad.constants.each_ref().map(|m| m.map(lift).unwrap());
                let here = closure_at(&ClosedLoop { variables: quad.variables, constants }, &quad_pairs(&q));
                note(2, errors(&here, &quad, &q, big_of_quad), &mut largest);
            }
        }
    }
    println!("largest parts of the bounds (residual, Jacobian): f64, complex, double-double: {largest:?}");
}

#[test]
fn the_bound_on_the_curvature_is_a_bound() {
    let mut random = random(53);
    let mut largest = 0.0_f64;
    for job in jobs() {
        for mode in &job.modes {
            let here = closure(&job.stored, &mode.unknowns);
            let (_, jacobian) = exact_closure(&job.given, &mode.unknowns.map(big));
            for size in [1e-6, 1e-3, 0.1] {
                let there: Six<Complex<f64>> = moved(&mode.unknowns, size, &mut random);
                let shift = (0..6).map(|k| (there[k] - mode.unknowns[k]).norm()).fold(0.0, f64::max);
                let (_, changed) = exact_closure(&job.given, &there.map(big));
                let row = |i: usize| (0..6).map(|j| small(&changed[i][j].sub(&jacobian[i][j])).norm()).sum::<f64>();
                let change = (0..6).map(row).fold(0.0, f64::max);
                let part = change / (shift * curvature(&here, shift));
                assert!(part <= 1.0, "{}: {part} of the bound at {shift:e}", job.name);
                largest = largest.max(part);
            }
        }
    }
    println!("the derivative changes by at most {largest:.2} of the bound");
    assert!(largest > 0.01, "a bound far too large, {largest:e}");
}

#[test]
fn every_proved_ball_holds_a_solution_and_no_two_balls_meet() {
    let (mut proved, mut worst) = (0, 0.0_f64);
    for job in jobs() {
        let truth = rigid(&job.stored);
        let certified: Vec<&Mode> = job.modes.iter().filter(|m| m.certificate.is_some()).collect();
        assert!(job.name.starts_with("Near") || !certified.is_empty(), "{}", job.name);
        for (k, mode) in certified.iter().enumerate() {
            let radius = mode.certificate.unwrap().radius;
            let exact = solution(&truth, &mode.unknowns).unwrap();
            let away = distance(&ROTATIONS, &exact, &mode.unknowns);
            assert!(away <= radius, "{}: {away:e} from the middle of a ball of {radius:e}", job.name);
            // The solution of the mechanism as given, before its constants were rounded, lies there as well.
            let given = distance(&ROTATIONS, &solution(&job.given, &mode.unknowns).unwrap(), &mode.unknowns);
            assert!(given <= radius, "{}: {given:e} from the middle of a ball of {radius:e}, as given", job.name);
            if mode.real {
                assert!(exact.iter().all(|x| small(x).im.abs() < 1e-45), "{}: a complex solution", job.name);
            }
            for other in &certified[..k] {
                let apart = looproot::internal::assembly::distance(&ROTATIONS, &mode.unknowns, &other.unknowns);
                assert!(apart > radius + other.certificate.unwrap().radius, "{}: {apart:e}", job.name);
            }
            proved += 1;
            worst = worst.max(away / radius);
        }
    }
    println!("{proved} balls, a solution at most {worst:.1e} of the radius from the middle");
    assert!(proved > 300, "{proved}");
}

#[test]
fn a_base_far_away_is_covered_by_the_radius() {
    let mut random = random(54);
    for base in [10, 1000, 100_000, 1_000_000] {
        let mut chain = general(&mut random);
        let mut away = motion(&mut random);
        away.translation = away.translation.map(|x| x * base);
        chain.base = Placement::from_motion_exact(away);
        let values: [Rational; 6] = std::array::from_fn(|_| small_rational(&mut random));
        let job = job(format!("base {base} away"), &chain, &pose(&chain, &values));
        for mode in &job.modes {
            let Some(claim) = mode.certificate else { continue };
            let error = distance(&ROTATIONS, &solution(&job.given, &mode.unknowns).unwrap(), &mode.unknowns);
            assert!(error <= claim.radius, "{}: {error:e}, radius {:e}", job.name, claim.radius);
        }
    }
}

#[test]
fn a_real_mode_has_no_imaginary_parts() {
    for job in jobs() {
        for mode in job.modes.iter().filter(|m| m.real) {
            assert!(mode.unknowns.iter().all(|x| x.im == 0.0), "{}: {mode:?}", job.name);
        }
    }
}

/// Checks a certificate against all solutions: exactly one in the ball, and no other one within the isolation.
fn judge<S: Scalar>(job: &Job, at: &Six<S>, solutions: &[Six<Complex<Big>>]) -> bool {
    let here = closure(&job.stored, at);
    let Some(claim) = inverse(&here.jacobian).and_then(|a| certificate(&here, &a)) else { return false };
    let middle = at.map(Scalar::to_complex);
    let within = |r: f64| solutions.iter().filter(|s| distance(&ROTATIONS, s, &middle) <= r).count();
    assert_eq!(within(claim.radius), 1, "{}: in the ball {claim:?} around {middle:?}", job.name);
    assert_eq!(within(claim.isolation), 1, "{}: within the isolation {claim:?} around {middle:?}", job.name);
    true
}

#[test]
fn what_is_no_solution_is_not_proved_to_be_one() {
    let mut random = random(52);
    let (mut accepted, mut refused, mut between) = (0, 0, 0);
    for job in jobs() {
        // Solutions of the loop as given: the proof in f64 covers its rounding.
        let solutions: Vec<_> = job.modes.iter().filter_map(|m| solution(&job.given, &m.unknowns)).collect();
        if solutions.len() != job.modes.len() || job.modes.iter().any(|m| m.certificate.is_none()) {
            continue;
        }
        for mode in &job.modes {
            for exponent in 3..10 {
                let size = 10.0_f64.powi(-exponent);
                let took = if mode.real {
                    judge::<f64>(&job, &moved(&mode.unknowns, size, &mut random), &solutions)
                } else {
                    judge::<Complex<f64>>(&job, &moved(&mode.unknowns, size, &mut random), &solutions)
                };
                *if took { &mut accepted } else { &mut refused } += 1;
            }
        }
        // Between two neighbours the closure is nearly met and its derivative nearly singular.
        for (k, one) in job.modes.iter().enumerate() {
            for two in &job.modes[..k] {
                if looproot::internal::assembly::distance(&ROTATIONS, &one.unknowns, &two.unknowns) < 0.3 {
                    for step in 1..60 {
                        let part = f64::from(step) / 60.0;
                        let at = std::array::from_fn(|k| one.unknowns[k] * (1.0 - part) + two.unknowns[k] * part);
                        *if judge::<Complex<f64>>(&job, &at, &solutions) { &mut accepted } else { &mut refused } += 1;
                        between += 1;
                    }
                }
            }
        }
        // Anywhere at all.
        for _ in 0..20 {
            let anywhere: Six<f64> = std::array::from_fn(|_| random.random_range(-3.0..3.0));
            judge::<f64>(&job, &anywhere, &solutions);
            let away = anywhere.map(|x| Complex::new(x, random.random_range(-1.0..1.0)));
            if let Some(Refined { unknowns: refined, certificate: claim, .. }) = refined_certificate(&job.stored, &away)
            {
                let within = |r: f64| solutions.iter().filter(|s| distance(&ROTATIONS, s, &refined) <= r).count();
                assert_eq!(within(claim.isolation), 1, "{}", job.name);
            }
        }
    }
    println!("{accepted} points near solutions proved to be so, {refused} not; {between} lay between two");
    assert!(accepted > 500 && refused > 500 && between > 100, "{accepted} {refused} {between}");
}

#[test]
fn the_refined_proof_holds_the_solution_of_the_rigid_loop() {
    let mut worst = 0.0_f64;
    let mut proved = 0;
    for job in jobs() {
        let truth = rigid(&job.stored);
        for mode in &job.modes {
            let proof = refined_certificate(&job.stored, &mode.unknowns);
            let Some(Refined { unknowns: refined, certificate: claim, .. }) = proof else { continue };
            let exact = solution(&truth, &refined).unwrap();
            let away = distance(&ROTATIONS, &exact, &refined);
            assert!(away <= claim.radius, "{}: {away:e} of {:e}", job.name, claim.radius);
            worst = worst.max(away / claim.radius);
            proved += 1;
            if mode.real {
                // The least imaginary part there is makes the proof one in complex numbers.
                let aside = mode.unknowns.map(|z| Complex::new(z.re, f64::MIN_POSITIVE));
                let Some(other) = refined_certificate(&job.stored, &aside) else { continue };
                let apart = distance(&ROTATIONS, &other.unknowns.map(big), &refined);
                assert!(other.real && apart <= claim.radius + other.certificate.radius, "{}: {apart:e}", job.name);
            }
        }
    }
    println!("{proved} refined proofs, worst {worst:.2} of the radius");
    assert!(proved > 300, "{proved}");
}
