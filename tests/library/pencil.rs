//! The pencil derived exactly and in f64 by the same code: its determinant is the closure polynomial of degree 16, and
//! the eigenvalues of the f64 pencil are that polynomial's roots.
#![allow(clippy::unwrap_used)]

use crate::arms;

use arms::{closed_at, general, open, pose, random, ratio, rounded, small};
use looproot::internal::assembly::{Assembly, Roots, Solver, Workspace};
use looproot::internal::closure::half_angle::half_angle_form;
use looproot::internal::elimination::cut::{Cut, Hidden};
use looproot::internal::elimination::degree::{closure_polynomial, degree, general_closing, half_tangent_pair};
use looproot::internal::elimination::pencil::{Pencil, before_second_link, bilinear, offset, pencil};
use looproot::internal::kinematics::chain::Chain;
use looproot::internal::kinematics::closed_loop::ClosedLoop;
use looproot::internal::solve::dense;
use looproot::internal::solve::eigen::{EigenWorkspace, Method};
use looproot_algebra::determinant::{by_interpolation, modular};
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::ring::{Field, Ring};
use looproot_algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Float, Rational};

type Poly = Univariate<Rational>;
type Mod = ModP<PRIME_61>;

/// Half tangent of the offset of the hidden angle.
fn turn() -> Rational {
    ratio(2, 9)
}

/// Every step from a closed loop to its pencil, over any field.
fn derive<F: Field>(closed: &ClosedLoop<F>, cut: Cut, hidden: Hidden) -> Option<Pencil<F>> {
    let view = cut.of(closed);
    let form = half_angle_form(&view)?;
    let rows = before_second_link(&form, &view.constants[1]);
    let (cos, sin) = half_tangent_pair(&F::from_rational(&turn())?)?;
    Some(pencil(&offset(&bilinear(&rows, &view), hidden, &cos, &sin), hidden))
}

/// The half tangent of the hidden angle of a cut, before and after the offset.
fn planted_root(values: &[Rational; 6], cut: Cut, hidden: Hidden) -> Rational {
    let index = cut.unknown_index(usize::from(hidden != Hidden::First));
    let x = if cut.reversed { -values[index].clone() } else { values[index].clone() };
    // tan(q/2 - offset/2)
    (&x - turn()) / (1 + x * turn())
}

fn circle() -> Poly {
    Poly::new(vec![ratio(1, 1), ratio(0, 1), ratio(1, 1)])
}

/// A general arm and its planted half tangents.
fn arm(seed: u64) -> (Chain, [Rational; 6]) {
    let mut random = random(seed);
    (general(&mut random), std::array::from_fn(|_| small(&mut random)))
}

/// All 24 ways to derive a pencil.
fn ways() -> impl Iterator<Item = (Cut, Hidden)> {
    Cut::ALL.into_iter().flat_map(|cut| [Hidden::First, Hidden::Second].map(|hidden| (cut, hidden)))
}

/// `|p / p'|` at a point, and p and p' there, all exact but the last rounding.
fn newton_step(p: &Poly, slope: &Poly, x: Complex<f64>) -> (f64, Complex<f64>) {
    let exact = |x: f64| Rational::from_f64(x).unwrap();
    let x = Complex { re: exact(x.re), im: exact(x.im) };
    let lift = |p: &Poly| p.map(Complex::<Rational>::from_rational).unwrap();
    let step = lift(p).eval(&x).mul(&lift(slope).eval(&x).inverse().unwrap());
    let part = |x: &Rational| Float::with_val(53, x).to_f64();
    let step = Complex::new(part(&step.re), part(&step.im));
    (step.norm(), step)
}

/// `|p(x)| / sum |c_k| |x|^k` in 300 bits.
fn backward_error(p: &Poly, x: Complex<f64>) -> f64 {
    const BITS: u32 = 300;
    let float = |x: f64| Float::with_val(BITS, x);
    let (re, im, size) = (float(x.re), float(x.im), float(x.re).hypot(&float(x.im)));
    let (mut value, mut majorant) = ((float(0.0), float(0.0)), float(0.0));
    for c in p.coefficients().iter().rev() {
        let c = Float::with_val(BITS, c);
        let real = Float::with_val(BITS, &value.0 * &re) - Float::with_val(BITS, &value.1 * &im) + &c;
        let imaginary = Float::with_val(BITS, &value.0 * &im) + Float::with_val(BITS, &value.1 * &re);
        majorant = majorant * &size + c.abs();
        value = (real, imaginary);
    }
    (value.0.hypot(&value.1) / majorant).to_f64()
}

#[test]
fn the_exact_determinant_is_of_degree_16_and_has_the_planted_root() {
    for seed in 0..4 {
        let (chain, values) = arm(seed);
        let closed: ClosedLoop<Rational> = closed_at(&chain, &values);
        for (cut, hidden) in ways() {
            let p = modular(&derive(&closed, cut, hidden).unwrap().coefficients);
            assert_eq!(p.degree(), Some(16), "arm {seed}, {cut:?}, {hidden:?}");
            assert_eq!(p.remove_factor(&circle()).0, 0, "arm {seed}, {cut:?}, {hidden:?}");
            assert_eq!(p.gcd(&p.derivative()).degree(), Some(0), "arm {seed}, {cut:?}, {hidden:?}");
            let root = planted_root(&values, cut, hidden);
            assert!(p.eval(&root).is_zero(), "arm {seed}, {cut:?}, {hidden:?}");
            // It vanishes at no other place: the test above does not hold for the zero polynomial only.
            assert!(!p.eval(&(root + 1)).is_zero(), "arm {seed}, {cut:?}, {hidden:?}");
        }
    }
}

#[test]
fn modulo_a_prime_the_same_code_gives_the_same_polynomial() {
    let (chain, values) = arm(0);
    let exact: ClosedLoop<Rational> = closed_at(&chain, &values);
    let image: ClosedLoop<Mod> = closed_at(&chain, &values);
    for (cut, hidden) in ways() {
        let p = modular(&derive(&exact, cut, hidden).unwrap().coefficients);
        let modulo = by_interpolation(&derive(&image, cut, hidden).unwrap().coefficients);
        assert_eq!(p.map(Mod::from_rational).unwrap().normalise(), modulo.normalise(), "{cut:?}, {hidden:?}");
    }
}

/// The eigenvalues of the companion matrix of a f64 pencil.
fn eigenvalues(pencil: &Pencil<f64>, method: Method) -> [Complex<f64>; 16] {
    let [a0, a1, a2] = &pencil.coefficients;
    let mut factors = *a2;
    let (quality, order) = dense::factor(&mut factors);
    assert!(quality > 1e-6, "the offset leaves roots far from infinity");
    let divided = |a| dense::solve(&factors, &order, a);
    EigenWorkspace::default().companion(method, &divided(a0), &divided(a1)).unwrap()
}

#[test]
fn the_eigenvalues_in_f64_are_the_roots_of_the_exact_polynomial() {
    for seed in 0..6 {
        let (chain, values) = arm(seed);
        let exact: ClosedLoop<Rational> = closed_at(&chain, &values);
        let inexact = ClosedLoop { variables: exact.variables, constants: exact.constants.each_ref().map(rounded) };
        let mut assembly = Assembly::default();
        let closing = rounded(&pose::<Rational>(&chain, &values).inverse());
        Solver::prepare(&open(&chain)).solve(&closing, Roots::All, &mut Workspace::default(), &mut assembly);
        assert!(assembly.modes.len() == 16 && assembly.modes.iter().all(|m| m.multiplicity == 1), "arm {seed}");
        // The reference and our own routine under the same test.
        for ((cut, hidden), method) in ways().flat_map(|way| [(way, Method::Faer), (way, Method::Francis)]) {
            let place = format!("arm {seed}, {cut:?}, {hidden:?}, {method:?}");
            let p = modular(&derive(&exact, cut, hidden).unwrap().coefficients);
            let slope = p.derivative();
            // A disc of radius 16 |p/p'| holds a root: sixteen disjoint discs hold one each.
            let discs: Vec<(Complex<f64>, f64)> = eigenvalues(&derive(&inexact, cut, hidden).unwrap(), method)
                .into_iter()
                .map(|x| {
                    let (size, step) = newton_step(&p, &slope, x);
                    assert!(size < 1e-7 * (1.0 + x.norm()), "{place}: {x} is {size:e} from a root");
                    assert!(backward_error(&p, x - step) < 1e-15, "{place}: {:e}", backward_error(&p, x - step));
                    (x, 16.1 * size)
                })
                .collect();
            for (k, (x, radius)) in discs.iter().enumerate() {
                for (y, other) in &discs[..k] {
                    assert!((x - y).norm() > radius + other, "{place}: {x} and {y}");
                }
            }
            // A disc about a real number is its own mirror image, and so is the one root in it.
            let real = discs.iter().filter(|(x, _)| x.im == 0.0).count();
            let proved_complex = discs.iter().filter(|(x, radius)| x.im.abs() > *radius).count();
            assert_eq!(real + proved_complex, 16, "{place}");
            assert_eq!(real, p.distinct_real_roots(), "{place}");
            assert_eq!(real, assembly.real(), "{place}");
            // The modes and the roots belong to one another.
            let index = cut.unknown_index(usize::from(hidden != Hidden::First));
            let mut met = [false; 16];
            for mode in &assembly.modes {
                let q = mode.unknowns[index] * if cut.reversed { -1.0 } else { 1.0 };
                let x = (q * 0.5 - f64::atan(2.0 / 9.0)).tan();
                let nearest = (0..16).min_by(|&a, &b| (discs[a].0 - x).norm().total_cmp(&(discs[b].0 - x).norm()));
                let nearest = nearest.unwrap();
                assert!((discs[nearest].0 - x).norm() < 1e-6 * (1.0 + x.norm_sqr()), "{place}: {x}");
                assert!(!std::mem::replace(&mut met[nearest], true), "{place}: two modes at {x}");
            }
        }
    }
}

#[test]
fn at_an_exactly_singular_pose_the_planted_root_is_double() {
    for seed in 0..3 {
        let (chain, values) = arms::singular(&mut random(seed));
        let closed: ClosedLoop<Rational> = closed_at(&chain, &values);
        for (cut, hidden) in ways() {
            let p = modular(&derive(&closed, cut, hidden).unwrap().coefficients);
            let root = planted_root(&values, cut, hidden);
            let linear = Poly::new(vec![-root, ratio(1, 1)]).normalise();
            let factors = p.square_free_decomposition();
            assert_eq!(factors.len(), 2, "arm {seed}, {cut:?}, {hidden:?}");
            assert_eq!((factors[0].0.degree(), factors[0].1), (Some(14), 1), "arm {seed}, {cut:?}, {hidden:?}");
            assert_eq!(factors[1], (linear, 2), "arm {seed}, {cut:?}, {hidden:?}");
        }
    }
}

#[test]
fn special_arms_have_the_known_degrees() {
    for (name, chain, solutions) in [
        ("Puma-like", arms::puma_like(), 8),
        ("three parallel axes", arms::three_parallel(), 8),
        ("spherical wrist", arms::spherical_wrist(), 8),
        ("general", arm(0).0, 16),
    ] {
        let at = |choice| open::<Mod>(&chain).close(&general_closing(None, choice).unwrap());
        let found = degree(&at(0), Some(&at(1)), 0).unwrap();
        assert_eq!((found.solutions, found.left_out), (solutions, 16 - solutions), "{name}");
    }
}

#[test]
fn what_an_exact_puma_lacks_of_16_is_the_factor_of_infinite_angles() {
    let chain = arms::puma_like();
    let values = [[1, 2], [-2, 3], [3, 4], [1, 3], [-3, 2], [2, 5]].map(|[n, d]| ratio(n, d));
    let exact: ClosedLoop<Rational> = closed_at(&chain, &values);
    let image: ClosedLoop<Mod> = closed_at(&chain, &values);
    let mut powers = Vec::new();
    for (cut, hidden) in ways() {
        let modulo = closure_polynomial(&image, cut, hidden);
        // Wrist or parallel axes make some cuts lose equations: both rings must see it.
        let Some(pencil) = derive(&exact, cut, hidden) else {
            assert!(modulo.is_none(), "{cut:?}, {hidden:?}");
            continue;
        };
        let p = modular(&pencil.coefficients);
        let (power, cofactor) = p.remove_factor(&circle());
        assert_eq!(p.degree(), Some(16), "{cut:?}, {hidden:?}");
        assert_eq!(modulo.map(|m| m.spurious), Some(power), "{cut:?}, {hidden:?}");
        assert!(cofactor.eval(&planted_root(&values, cut, hidden)).is_zero(), "{cut:?}, {hidden:?}");
        if power == 4 {
            // Eight solutions, and eight values of the hidden angle.
            assert_eq!(cofactor.distinct_real_roots() % 2, 0, "{cut:?}, {hidden:?}");
            assert_eq!(cofactor.square_free_part().degree(), Some(8), "{cut:?}, {hidden:?}");
        }
        powers.push(power);
    }
    powers.sort_unstable();
    assert_eq!(powers, [[0; 8], [4; 8]].concat());
}
