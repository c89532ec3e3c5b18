//! From the sphere into space: against the loops that are solved another way, and against derivatives.

use looproot::internal::catalogue::{Options, load};
use looproot::internal::derivation::transference::{
    NAMED, SpatialFourBar, Transfer, Variables, general_pair, half_angle_pair, spherical_four_bar,
};
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::{Expression, Names};
use rug::Rational;

fn value(p: &Polynomial<Rational>, values: &[f64]) -> f64 {
    p.map(|c| Some(c.to_f64())).unwrap().evaluate(values)
}

fn angle(phi: f64) -> (f64, f64) {
    (phi.cos(), phi.sin())
}

/// The loop of the design data: a = (4, 1, 1, 3/2), tan(alpha/2) = (-2/5, -1/4, -1/2, 1/2), d4 = -2, tan(theta4/2) = 2/3.
fn rccc(first: f64, first_offset: f64) -> [f64; 2] {
    let twists = [-2.0 / 5.0, -0.25, -0.5, 0.5].map(|t: f64| angle(2.0 * t.atan()));
    let fourth = angle(2.0 * (2.0_f64 / 3.0).atan());
    let loop_of_four = SpatialFourBar {
        twists,
        lengths: [4.0, 1.0, 1.0, 1.5],
        first: angle(first),
        first_offset,
        fourth,
        fourth_offset: -2.0,
    };
    let pair = loop_of_four.pair();
    [pair.f, pair.g]
}

#[test]
fn known_solutions_of_rccc() {
    for (theta, d) in [(0.560_904_057_243, -0.393_348_134_362), (1.819_675_842_122, -2.570_013_934_603)] {
        let [f, g] = rccc(theta, d);
        assert!(f.abs() < 1e-11 && g.abs() < 1e-11, "{f} {g}");
        // The offset by the formula: g is linear in it.
        let (at0, at1) = (rccc(theta, 0.0)[1], rccc(theta, 1.0)[1]);
        assert!((-at0 / (at1 - at0) - d).abs() < 1e-11);
        assert!(rccc(theta, d + 0.1)[1].abs() > 1e-3 && rccc(theta + 0.1, d)[0].abs() > 1e-3);
    }
}

#[test]
fn the_loops_of_the_library_satisfy_both_equations() {
    let mut tested = 0;
    for name in ["cccr_1_angle", "cccr_2_angle", "cccr_4_angle"] {
        let entry = load(name, &Options::default()).unwrap();
        let transfer = Transfer::of(&entry.title, entry.chain().unwrap()).unwrap();
        for claim in &entry.cases[0].expected.solutions {
            // Joints 1 to 3 are C, joint 4 is R.
            let q = &claim.q;
            let (first, fourth) = (angle(q[0]), angle(q[6]));
            let values = [first.0, first.1, q[1], fourth.0, fourth.1, 0.0];
            assert!(value(&transfer.f, &values).abs() < 1e-10, "{name}");
            assert!(value(&transfer.g, &values).abs() < 1e-9, "{name}");
            let (offset, numerator, denominator) = &transfer.offsets[0];
            assert_eq!(offset, "d1");
            assert!((value(numerator, &values) / value(denominator, &values) - q[1]).abs() < 1e-9);
            tested += 1;
        }
    }
    assert!(tested >= 4);
}

#[test]
fn the_second_equation_is_the_sum_of_the_derivatives() {
    let pair = general_pair();
    let names = Names::given(Variables::TRIGONOMETRIC).unwrap();
    let f = pair.f.polynomial();
    // d/dphi of a polynomial in cos and sin.
    let slope = |k: usize| {
        let angle = Variables::angle(k);
        let (cos, sin) = (Polynomial::<Int>::variable(angle.cos), Polynomial::variable(angle.sin));
        f.derivative(angle.sin).mul(&cos).sub(&f.derivative(angle.cos).mul(&sin))
    };
    let distances = [4, 5, 6, 7, 8, 11].map(Polynomial::<Int>::variable);
    let sum = (0..6).fold(Polynomial::zero(), |sum, k| sum.add(&slope(k).mul(&distances[k])));
    assert_eq!(sum, *pair.g.polynomial());
    let text = "s_theta1*s_theta4*s_alpha1*s_alpha3 - c_theta1*s_alpha1*(c_theta4*s_alpha3*c_alpha4 + c_alpha3*s_alpha4) \
                + c_alpha1*(c_alpha3*c_alpha4 - c_theta4*s_alpha3*s_alpha4) - c_alpha2";
    let mut known = names.clone();
    assert_eq!(Expression::parse(text, &mut known).unwrap().expand().unwrap().numerator, *f);
    let half = half_angle_pair(&pair);
    assert_eq!((half.f.len(), half.g.len()), (84, 408));
    assert!(half.g.degrees().iter().all(|&degree| degree <= 2));
}

#[test]
fn hookes_joint_and_the_joint_of_skew_axes() {
    let transfer = Transfer::named("hooke").unwrap().unwrap();
    let mut names = transfer.names.clone();
    let text = "s_theta1*s_theta4 - c_theta1*c_theta4*c_alpha4";
    assert_eq!(Expression::parse(text, &mut names).unwrap().expand().unwrap().to_rational(), transfer.f);
    // g with a4 alone: the derivative by alpha4.
    let others = [4, 5, 6, 8, 11].map(|variable| (variable, Polynomial::zero()));
    let text = "a4*c_theta1*c_theta4*s_alpha4";
    let g = transfer.g.substitute_all(&others);
    assert_eq!(Expression::parse(text, &mut names).unwrap().expand().unwrap().to_rational(), g);
    let (beta, theta) = (0.4_f64, 1.1_f64);
    let right = angle(std::f64::consts::FRAC_PI_2);
    let fourth = (beta.cos() / theta.tan()).atan();
    let f = |fourth: f64| spherical_four_bar(&[right, right, right, angle(beta)], &angle(theta), &angle(fourth));
    assert!(f(fourth).abs() < 1e-14 && f(fourth + std::f64::consts::PI).abs() < 1e-14 && f(fourth + 0.1).abs() > 1e-3);
}

#[test]
fn named_loops() {
    for name in NAMED {
        let transfer = Transfer::named(name).unwrap().unwrap();
        assert!(!transfer.f.is_zero() && !transfer.g.is_zero());
        assert_eq!(transfer.offsets.len(), usize::from(matches!(name, "rccc" | "hooke")), "{name}");
    }
    assert!(Transfer::named("rrrr").unwrap().is_none());
    let other = load("general_7r", &Options::default()).unwrap();
    assert!(Transfer::of("7R", other.chain().unwrap()).is_err());
}
