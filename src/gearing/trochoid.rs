//! Trochoids: the path of a point of a circle that rolls on or in another one, its polynomial, and its second generation.
//!
//! As a complex number the point is `a e^{i n t} + b e^{i m t}` with whole numbers n and m: the sum of two arms that turn at
//! constant rates. The arms in the other order are those of the second mechanism. The polynomial is the resultant of this
//! equation and its conjugate in `u = e^{i t}`. \[Wittenburg2016, 15.5\]

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::resultant::resultant;
use crate::algebra::ring::Ring;
use crate::algebra::text::{Format, Names};
use crate::catalogue::gearing::Rolling;
use crate::displacement::Answer;
use crate::displacement::answer::Named;
use rug::Rational;
use serde_json::{Value, json};

/// Largest degree of a curve whose polynomial is written out: pages of terms beyond it.
const LARGEST: u32 = 24;

/// The two arms and the rate of the second one for unit rate of the first.
struct Arms {
    lengths: [Rational; 2],
    ratio: Rational,
}

impl Arms {
    fn of(rolling: &Rolling) -> Self {
        let [fixed, own, arm] = [&rolling.fixed, &rolling.rolling, &rolling.arm];
        // At the start the point lies on the line of centres, at the contact where the arm is the radius.
        let (first, second) = if rolling.internal {
            (Rational::from(fixed - own), arm.clone())
        } else {
            (Rational::from(fixed + own), Rational::from(-arm))
        };
        let ratio = Rational::from(&first / own);
        let ratio = if rolling.internal { -ratio } else { ratio };
        Self { lengths: [first, second], ratio }
    }

    /// The circles that make the same curve with the arms in the other order.
    fn exchanged(&self) -> Rolling {
        let [first, second] = self.lengths.each_ref().map(|length| length.clone().abs());
        // The rate of the other arm for unit rate of this one.
        let ratio = Rational::from(self.ratio.recip_ref());
        let rolling = Rational::from(&second / &ratio).abs();
        let internal = ratio < 1;
        let fixed = match (ratio < 0, internal) {
            (true, _) => Rational::from(&second + &rolling),
            (false, true) => Rational::from(&rolling - &second),
            (false, false) => Rational::from(&second - &rolling),
        };
        Rolling { fixed, rolling, arm: first, internal }
    }

    /// The polynomial of the curve in z and its conjugate w.
    fn isotropic(&self, [n, m]: [i64; 2]) -> Polynomial<Int> {
        let term = |c: &Rational, unknown: Option<usize>, power: i64| {
            let mut exponents = vec![0, 0, u32::try_from(power).unwrap_or(0)];
            if let Some(unknown) = unknown {
                exponents[unknown] = 1;
            }
            (exponents, c.clone())
        };
        let [a, b] = self.lengths.each_ref().map(|length| Rational::from(-length));
        let one = Rational::from(1);
        // z u^s = a u^(s + n) + b u^(s + m), and the conjugate with -n and -m.
        let equation = |unknown: usize, [n, m]: [i64; 2]| {
            let s = 0.max(-n).max(-m);
            let terms = [term(&one, Some(unknown), s), term(&a, None, s + n), term(&b, None, s + m)];
            Polynomial::from_terms(terms).primitive().0
        };
        resultant(&equation(0, [n, m]), &equation(1, [-n, -m]), 2).square_free_part()
    }
}

/// Returns the polynomial with `x + i y` for z and `x - i y` for w. It is its own conjugate, so that real parts are enough.
fn real(isotropic: &Polynomial<Int>) -> Polynomial<Int> {
    let [x, y] = [0, 1].map(Polynomial::<Int>::variable);
    let one = || (Polynomial::<Int>::one(), Polynomial::<Int>::zero());
    let times = |(a, b): &(Polynomial<Int>, Polynomial<Int>), turned: bool| {
        let (c, d) = (a.mul(&x), b.mul(&y));
        let (e, f) = (a.mul(&y), b.mul(&x));
        if turned { (c.add(&d), f.sub(&e)) } else { (c.sub(&d), e.add(&f)) }
    };
    let mut sum = Polynomial::<Int>::zero();
    for (exponents, c) in isotropic.terms() {
        let mut power = one();
        for (place, turned) in [(0, false), (1, true)] {
            for _ in 0..exponents.get(place).copied().unwrap_or(0) {
                power = times(&power, turned);
            }
        }
        sum = sum.add(&power.0.scale(c));
    }
    sum.primitive_part()
}

fn written(polynomial: &Polynomial<Int>, names: [&str; 2]) -> String {
    let exact = polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero);
    Names::given(names).map_or_else(|_| String::new(), |names| Format::Text.polynomial(&exact, &names))
}

/// Arms, rates, lobes, polynomial and second generation.
pub fn answer(rolling: &Rolling) -> Answer {
    let arms = Arms::of(rolling);
    let parts = [arms.ratio.denom().to_i64(), arms.ratio.numer().to_i64()];
    let [Some(n), Some(m)] = parts else { return Answer::none("the ratio of the circles has too many digits") };
    let mut named = Named::default();
    let mut own = Named::default();
    own.number("crank", &arms.lengths[0]);
    own.number("arm", &arms.lengths[1]);
    own.number("ratio", &arms.ratio);
    named.under("arms", own);
    named.put("turns", json!(n));
    named.put("lobes", json!((n - m).abs()));
    // The point stands still where both arms have one speed and opposite directions.
    let speeds = [arms.lengths[0].clone().abs(), Rational::from(&arms.lengths[1] * &arms.ratio).abs()];
    named.put("cusps", json!(if speeds[0] == speeds[1] { (n - m).abs() } else { 0 }));
    let degree = u32::try_from(n.abs().max(m.abs())).ok().and_then(|n| n.checked_mul(2));
    if degree.is_some_and(|degree| degree <= LARGEST) {
        let isotropic = arms.isotropic([n, m]);
        let found = real(&isotropic);
        named.put("degree", json!(found.total_degree()));
        named.put("polynomial", json!(written(&found, ["x", "y"])));
        named.put("complex_polynomial", json!(written(&isotropic, ["z", "w"])));
    } else {
        named.put("polynomial", Value::Null);
    }
    let other = arms.exchanged();
    let mut second = Named::default();
    second.number("fixed", &other.fixed);
    second.number("rolling", &other.rolling);
    second.number("arm", &other.arm);
    second.put("mesh", json!(if other.internal { "internal" } else { "external" }));
    named.under("second_generation", second);
    named.answer("the point is the sum of two arms at constant rates; their order does not matter, which gives a second pair of circles")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rolling([fixed, rolling, arm]: [i32; 3], internal: bool) -> Rolling {
        let [fixed, rolling, arm] = [fixed, rolling, arm].map(Rational::from);
        Rolling { fixed, rolling, arm, internal }
    }

    #[test]
    fn the_second_generation_has_the_same_curve_and_its_own_second_is_the_first() {
        for (radii, internal) in
            [([3, 1, 1], true), ([2, 1, 3], false), ([5, 2, 1], true), ([1, 1, 1], false), ([1, 2, 3], true)]
        {
            let own = rolling(radii, internal);
            let arms = Arms::of(&own);
            let other = arms.exchanged();
            let back = Arms::of(&other).exchanged();
            assert_eq!(
                (&back.fixed, &back.rolling, &back.arm, back.internal),
                (&own.fixed, &own.rolling, &own.arm, own.internal)
            );
            let polynomial = |arms: &Arms| {
                let [n, m] = [arms.ratio.denom(), arms.ratio.numer()].map(|n| n.to_i64().unwrap());
                real(&arms.isotropic([n, m]))
            };
            // The start of the second one may be another point of the curve: a turn, which the arms of both rates undo.
            let (one, two) = (polynomial(&arms), polynomial(&Arms::of(&other)));
            assert_eq!(one.total_degree(), two.total_degree());
        }
    }

    #[test]
    fn points_of_the_curve_are_zeros() {
        for (radii, internal) in [([3, 1, 2], true), ([2, 1, 3], false), ([5, 2, 1], true)] {
            let arms = Arms::of(&rolling(radii, internal));
            let [n, m] = [arms.ratio.denom(), arms.ratio.numer()].map(|n| n.to_i64().unwrap());
            let polynomial = real(&arms.isotropic([n, m]));
            let [a, b] = arms.lengths.each_ref().map(Rational::to_f64);
            for k in 0..9 {
                let t = 0.7 * f64::from(k);
                let (s, r) = (n as f64 * t, m as f64 * t);
                let (x, y) = (a * s.cos() + b * r.cos(), a * s.sin() + b * r.sin());
                let (sum, size) = polynomial.terms().fold((0.0, 0.0), |(sum, size): (f64, f64), (e, c)| {
                    let term = c.to_integer().to_f64()
                        * x.powi(e[0].cast_signed())
                        * y.powi(e.get(1).copied().unwrap_or(0).cast_signed());
                    (sum + term, size + term.abs())
                });
                assert!(sum.abs() <= 1e-11 * size, "{radii:?}: {sum} of {size}");
            }
        }
    }
}
