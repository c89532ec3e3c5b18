//! Laws of polynomials in cosines and sines: the normal form is canonical, half-angle tangents evaluate alike.

use crate::strategies::rational;
use looproot_algebra::{
    int::Int,
    polynomial::Polynomial,
    resultant::eliminate,
    ring::{Domain, Ring},
    trigonometric::{Pair, Trigonometric, eliminate_angle, half_tangents, reduce},
};
use proptest::prelude::*;
use rug::Rational;

type Poly = Polynomial<Rational>;

/// Two angles, and a parameter as the variable 4.
const PAIRS: [Pair; 2] = [Pair { cos: 0, sin: 1 }, Pair { cos: 3, sin: 2 }];

fn polynomial(degree: u32) -> impl Strategy<Value = Poly> {
    let term = (prop::collection::vec(0..=degree, 5), (-9_i32..10).prop_map(Rational::from));
    prop::collection::vec(term, 0..7).prop_map(Polynomial::from_terms)
}

/// Cosine and sine from the half-angle tangent.
fn on_the_circle(t: &Rational) -> [Rational; 2] {
    let square = Rational::from(t * t);
    let denominator = Rational::from(1 + &square);
    [(1 - square) / &denominator, Rational::from(t * 2) / denominator]
}

fn values(t: &Rational, u: &Rational, parameter: &Rational) -> Vec<Rational> {
    let ([c, s], [d, e]) = (on_the_circle(t), on_the_circle(u));
    vec![c, s, e, d, parameter.clone()]
}

fn circles() -> [Poly; 2] {
    PAIRS.map(|pair| Poly::variable(pair.cos).pow(2).add(&Poly::variable(pair.sin).pow(2)).sub(&Poly::one()))
}

proptest! {
    #[test]
    fn reduction_changes_no_value(f in polynomial(5), t in rational(), u in rational(), p in rational()) {
        let reduced = reduce(&f, &PAIRS);
        prop_assert!(PAIRS.iter().all(|pair| reduced.degree(pair.sin) <= 1));
        let values = values(&t, &u, &p);
        prop_assert_eq!(reduced.evaluate(&values), f.evaluate(&values));
        prop_assert_eq!(&reduce(&reduced, &PAIRS), &reduced);
    }

    #[test]
    fn equal_functions_have_equal_normal_forms(f in polynomial(3), a in polynomial(2), b in polynomial(2)) {
        let [circle, other] = circles();
        let same = f.add(&a.mul(&circle)).add(&b.mul(&other));
        prop_assert_eq!(reduce(&same, &PAIRS), reduce(&f, &PAIRS));
        // Different ones differ at the points of a grid, which has more points than a polynomial has zeros.
        let (f, a) = (reduce(&f, &PAIRS), reduce(&a, &PAIRS));
        let point = |i: i32| values(&i.into(), &(7 * i * i + 1).into(), &(i * i * i).into());
        let differs = (0..12).any(|i| f.evaluate(&point(i)) != a.evaluate(&point(i)));
        prop_assert_eq!(differs, f != a);
    }

    #[test]
    fn ring_operations_reduce(f in polynomial(3), g in polynomial(3)) {
        let trig = |f: &Poly| Trigonometric::new(f, &PAIRS);
        let (a, b) = (trig(&f), trig(&g));
        prop_assert_eq!(a.mul(&b).polynomial().clone(), reduce(&f.mul(&g), &PAIRS));
        prop_assert_eq!(a.add(&b).polynomial().clone(), reduce(&f.add(&g), &PAIRS));
        prop_assert_eq!(a.sub(&b), trig(&f.sub(&g)));
        // Angles that only one of the two knows are known to the result.
        let first = Trigonometric::new(&f, &PAIRS[..1]);
        prop_assert_eq!(first.mul(&b), trig(&f.mul(&g)));
        prop_assert_eq!(&Trigonometric::new(&f, &[]), &a);
    }

    #[test]
    fn half_angle_tangents_evaluate_alike_with_least_powers(
        f in polynomial(4), t in rational(), u in rational(), p in rational(),
    ) {
        // One tangent in place of its sine, the other one as a new variable.
        let form = half_tangents(&f, &[(PAIRS[0], 1), (PAIRS[1], 5)]);
        let scale = [&t, &u].iter().zip(&form.powers).fold(Rational::from(1), |product, (t, &power)| {
            (0..power).fold(product, |product, _| product * (Rational::from(*t * *t) + 1))
        });
        let zero = Rational::new();
        let at = [zero.clone(), t.clone(), zero.clone(), zero, p.clone(), u.clone()];
        prop_assert_eq!(form.polynomial.evaluate(&at), f.evaluate(&values(&t, &u, &p)) * scale);
        for (variable, &power) in [1, 5].into_iter().zip(&form.powers) {
            let denominator = Poly::variable(variable).pow(2).add(&Poly::one());
            prop_assert!(form.polynomial.is_zero() || form.polynomial.checked_div_exact(&denominator).is_none());
            prop_assert!(form.polynomial.degree(variable) <= 2 * power);
        }
    }

    #[test]
    fn an_eliminated_angle_comes_back(
        f in prop::collection::vec(polynomial(1), 2), g in prop::collection::vec(polynomial(1), 2),
        t in rational(), u in rational(), p in rational(),
    ) {
        let others = &PAIRS[1..];
        let free = |f: &Poly| f.substitute(0, &Poly::zero()).substitute(1, &Poly::zero());
        let (c, s) = (Poly::variable(0), Poly::variable(1));
        let at = values(&t, &u, &p);
        let linear = |parts: &[Poly]| {
            let f = free(&parts[0]).mul(&c).add(&free(&parts[1]).mul(&s));
            f.sub(&Poly::constant(f.evaluate(&at)))
        };
        let (f, g) = (linear(&f), linear(&g));
        let eliminated = eliminate_angle(&f, &g, PAIRS[0], others).unwrap();
        prop_assert!(eliminated.equation.evaluate(&at).is_zero());
        prop_assert!(eliminated.equation.degree(PAIRS[1].sin) <= 1);
        if let Some(cos_sin) = eliminated.cos_sin_at(|c| Some(c.clone()), &at) {
            prop_assert_eq!(cos_sin, (at[0].clone(), at[1].clone()));
        }
        // The resultant of the half-angle forms has no other factor than 4.
        let [f, g] = [f, g].map(|f| half_tangents(&f, &[(PAIRS[0], 5)]).polynomial);
        if f.degree(5) == 2 && g.degree(5) == 2 {
            let resultant = reduce(&eliminate(&f, &g, 5).resultant, others);
            let four_times = eliminated.equation.scale(&Rational::from(4));
            prop_assert!(resultant == four_times || resultant == four_times.neg());
        }
    }
}

#[test]
fn an_equation_not_linear_in_the_angle_is_refused() {
    let (c, s) = (Poly::variable(0), Poly::variable(1));
    assert!(eliminate_angle(&c.mul(&s), &s, PAIRS[0], &[]).is_none());
    // In normal form this one is linear.
    assert!(eliminate_angle(&c.mul(&c).add(&s.mul(&s)).add(&c), &s, PAIRS[0], &[]).is_some());
}

#[test]
fn addition_theorems_hold() {
    let [a, b] = PAIRS.map(|pair| (Trigonometric::<Int>::cos(pair), Trigonometric::sin(pair)));
    let cos = a.0.mul(&b.0).sub(&a.1.mul(&b.1));
    let sin = a.1.mul(&b.0).add(&a.0.mul(&b.1));
    assert_eq!(cos.mul(&cos).add(&sin.mul(&sin)), Ring::one());
    assert_eq!(cos.pairs(), PAIRS);
    assert_eq!(Trigonometric::<Int>::from_integer(3).pairs(), []);
}

#[test]
#[should_panic(expected = "a variable belongs to one angle")]
fn a_variable_in_two_angles_is_a_mistake() {
    let _ = reduce(&Poly::one(), &[Pair { cos: 0, sin: 1 }, Pair { cos: 1, sin: 2 }]);
}

#[test]
#[should_panic(expected = "the half-angle tangent is a new variable")]
fn a_tangent_that_occurs_already_is_a_mistake() {
    let f = Poly::variable(0).mul(&Poly::variable(2));
    let _ = half_tangents(&f, &[(Pair { cos: 0, sin: 1 }, 2)]);
}
