//! Loops of five and six revolutes that are made of Bennett loops, with the identity that closes them.
//!
//! A Bennett loop with twists alpha, beta, alpha, beta and lengths proportional to their sines moves with `tan(theta1/2) = x`,
//! `tan(theta2/2) = -K/x`, `tan(theta3/2) = -x`, `tan(theta4/2) = K/x`, `K = (t_alpha + t_beta)/(t_alpha - t_beta)`. Loops with a common link, which
//! is taken away, and a common joint, at which two links are made one, are Goldberg's loops \[Goldberg1943\]; Myard's is one of them
//! \[Myard1931\]. Loops with a common axis, on which both have the same angle, make Waldron's loop of six \[Waldron1968\].

use super::closure_identity::{Member, closes};
use super::examples::{half_tangent, value_at};
use super::null_space::primitive;
use super::step::{factored, product, ratio_text};
use super::twist_family::Ratio;
use super::verification::germ;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::catalogue::ansatz::Link;
use crate::mobility::Local;
use rug::Rational;

type Poly = Polynomial<Int>;

/// The variables of a motion: x, the half-angle tangents of alpha, beta, gamma and delta, and two scales.
const X: usize = 0;
const ALPHA: usize = 1;
const BETA: usize = 2;
const GAMMA: usize = 3;
const DELTA: usize = 4;
const SCALE: usize = 5;
const OTHER_SCALE: usize = 6;
const NAMES: [&str; 7] = ["x", "t_alpha", "t_beta", "t_gamma", "t_delta", "b", "c"];

/// A family of loops that is proved to move for all of its parameters.
#[derive(Clone, Debug)]
pub struct Composed {
    /// Its name.
    pub name: &'static str,
    /// How it is made, and where it is from.
    pub made: &'static str,
    /// The conditions on the half-angle tangents `t1, t2, ...` of the twists, the lengths `a1, ...` and the offsets `d1, ...`: each is zero.
    pub conditions: Vec<Poly>,
    /// Joints and links as functions of x and of the parameters.
    members: Vec<Member>,
    /// A member over the rationals.
    pub example: Vec<Link<Rational>>,
}

impl Composed {
    /// Returns the families of five or six joints whose identities hold: the product of all joints and links is a number, all conditions
    /// vanish for all members, and the order test finds that the example moves.
    #[must_use]
    pub fn all(joints: usize) -> Vec<Self> {
        let families = match joints {
            5 => vec![goldberg(), myard()],
            6 => vec![goldberg_of_three(), waldron()],
            _ => Vec::new(),
        };
        families.into_iter().filter(Self::holds).collect()
    }

    fn new(name: &'static str, made: &'static str, members: Vec<Member>, conditions: Vec<Poly>) -> Self {
        let example = example(&members);
        Self { name, made, conditions, members, example }
    }

    fn holds(&self) -> bool {
        closes(&self.members) && self.conditions.iter().all(|one| self.vanishes(one)) && self.moves()
    }

    /// Returns whether a polynomial in the parameters of the loop vanishes for all members.
    fn vanishes(&self, condition: &Poly) -> bool {
        // Every tangent is a ratio: with its denominator for a further factor the polynomial is homogeneous in both.
        let count = self.members.len();
        let ratios: Vec<Ratio> = self.parameters();
        let mut sum = Poly::zero();
        let degrees: Vec<u32> = (0..3 * count).map(|k| condition.degree(k)).collect();
        for (exponents, c) in condition.terms() {
            let mut term = Poly::constant(c.clone());
            for (k, (numerator, denominator)) in ratios.iter().enumerate() {
                let power = exponents.get(k).copied().unwrap_or(0);
                term = term.mul(&numerator.pow(power)).mul(&denominator.pow(degrees[k] - power));
            }
            sum = sum.add(&term);
        }
        sum.is_zero()
    }

    /// Returns tangents of twists, lengths and offsets as ratios, in the order of the variables of the conditions.
    fn parameters(&self) -> Vec<Ratio> {
        let one = Poly::one;
        let twists = self.members.iter().map(|member| member.alpha.clone());
        let lengths = self.members.iter().map(|member| (member.a.clone(), one()));
        let offsets = self.members.iter().map(|member| (member.d.clone(), one()));
        twists.chain(lengths).chain(offsets).collect()
    }

    /// Returns whether the example moves through one of its positions.
    fn moves(&self) -> bool {
        let turns: Option<Vec<(Rational, Rational)>> = self.members.iter().map(|member| turn(&member.theta)).collect();
        turns.is_some_and(|turns| germ(&self.example, &turns).local == Local::Curve)
    }

    /// Returns whether a loop belongs to the family, its links counted from any joint.
    #[must_use]
    pub fn contains(&self, links: &[Link<Rational>]) -> bool {
        let count = links.len();
        let Some(tangents) = links.iter().map(half_tangent).collect::<Option<Vec<_>>>() else { return false };
        let is_zero = |condition: &Poly, first: usize| {
            let turned = |k: usize| (first + k) % count;
            let values = (0..count).map(|k| tangents[turned(k)].clone());
            let values = values.chain((0..count).map(|k| links[turned(k)].a.clone()));
            let values: Vec<Rational> = values.chain((0..count).map(|k| links[turned(k)].d.clone())).collect();
            value_at(condition, &values) == 0
        };
        count == self.members.len()
            && (0..count).any(|first| self.conditions.iter().all(|condition| is_zero(condition, first)))
    }

    /// Returns the conditions as text, each with its factors.
    #[must_use]
    pub fn texts(&self) -> Vec<String> {
        let names = self.names();
        self.conditions.iter().map(|one| product(&factored(one, &[]), &names)).collect()
    }

    /// Returns the names of the variables of the conditions.
    ///
    /// # Panics
    /// Never: the names are distinct.
    #[must_use]
    pub fn names(&self) -> Names {
        let count = self.members.len();
        let all = ["t", "a", "d"].into_iter().flat_map(|letter| (1..=count).map(move |k| format!("{letter}{k}")));
        Names::given(all).expect("the names are distinct")
    }

    /// Returns the half-angle tangents of the joint angles as text, functions of x.
    ///
    /// # Panics
    /// Never: the names are distinct.
    #[must_use]
    pub fn motion(&self) -> Vec<String> {
        let names = Names::given(NAMES).expect("the names are distinct");
        self.members.iter().map(|member| ratio_text(&member.theta, &names)).collect()
    }
}

/// The numbers of an example: x = 2/3, tangents 1/2, 1/3, 1/5 and 3/4, scales 1 and 2. No two tangents are equal or each other's inverse.
fn sample() -> [Rational; 7] {
    [(2, 3), (1, 2), (1, 3), (1, 5), (3, 4), (1, 1), (2, 1)].map(Rational::from)
}

fn example(members: &[Member]) -> Vec<Link<Rational>> {
    let numbers = sample();
    let link = |member: &Member| {
        let t = value_at(&member.alpha.0, &numbers) / value_at(&member.alpha.1, &numbers);
        let square = Rational::from(t.square_ref());
        let below = Rational::from(1 + &square);
        Link {
            cos: (1 - square) / &below,
            sin: t * 2 / below,
            a: value_at(&member.a, &numbers),
            d: value_at(&member.d, &numbers),
        }
    };
    members.iter().map(link).collect()
}

/// Returns cosine and sine of a joint angle of the example.
fn turn(theta: &Ratio) -> Option<(Rational, Rational)> {
    let numbers = sample();
    let below = value_at(&theta.1, &numbers);
    if below == 0 {
        return None;
    }
    let t = value_at(&theta.0, &numbers) / below;
    let square = Rational::from(t.square_ref());
    let below = Rational::from(1 + &square);
    Some(((1 - square) / &below, t * 2 / below))
}

fn variable(k: usize) -> Poly {
    Poly::variable(k)
}

fn ratio(numerator: Poly) -> Ratio {
    (numerator, Poly::one())
}

fn times((a, b): &Ratio, (c, d): &Ratio) -> Ratio {
    (a.mul(c), b.mul(d))
}

fn over((a, b): &Ratio, (c, d): &Ratio) -> Ratio {
    (a.mul(d), b.mul(c))
}

fn minus((a, b): &Ratio) -> Ratio {
    (a.neg(), b.clone())
}

/// Returns the tangent of the sum of two angles.
fn sum((a, b): &Ratio, (c, d): &Ratio) -> Ratio {
    (a.mul(d).add(&b.mul(c)), b.mul(d).sub(&a.mul(c)))
}

/// Returns `(t_i + t_j)/(t_j - t_i)`.
fn constant(i: usize, j: usize) -> Ratio {
    (variable(i).add(&variable(j)), variable(j).sub(&variable(i)))
}

/// Returns the sine of a twist among some, times half the product of all `1 + t^2`.
fn sine(k: usize, among: &[usize]) -> Poly {
    let square = |k: usize| Poly::one().add(&variable(k).mul(&variable(k)));
    among.iter().filter(|other| **other != k).fold(variable(k), |product, other| product.mul(&square(*other)))
}

fn member(theta: Ratio, alpha: Ratio, a: Poly) -> Member {
    let [theta, alpha] = [theta, alpha].map(|(numerator, denominator)| {
        let reduced = primitive(&[numerator, denominator]);
        (reduced[0].clone(), reduced[1].clone())
    });
    Member { theta, d: Poly::zero(), alpha, a }
}

/// Returns the variable of conditions that is the tangent of half a twist.
fn tangent(link: usize) -> Poly {
    variable(link - 1)
}

/// Returns what vanishes if the tangent of a link is that of the sum of the twists of others.
fn is_sum(k: usize, of: &[usize]) -> Poly {
    let all = of.iter().map(|k| ratio(tangent(*k)));
    let total = all.reduce(|total, one| sum(&total, &one)).unwrap_or_else(|| ratio(Poly::zero()));
    tangent(k).mul(&total.1).sub(&total.0)
}

/// Variables of conditions on loops of n joints.
struct Own(usize);

impl Own {
    fn a(&self, k: usize) -> Poly {
        variable(self.0 + k - 1)
    }

    fn offsets(&self) -> impl Iterator<Item = Poly> {
        let count = self.0;
        (0..count).map(move |k| variable(2 * count + k))
    }

    /// Returns what vanishes if the lengths of two links are as the sines of their twists.
    fn proportional(&self, i: usize, j: usize) -> Poly {
        let weight = |k: usize| Poly::one().add(&tangent(k).mul(&tangent(k)));
        let side = |i: usize, j: usize| self.a(i).mul(&tangent(j)).mul(&weight(i));
        side(i, j).sub(&side(j, i))
    }

    fn equal(&self, i: usize, j: usize) -> [Poly; 2] {
        [tangent(i).sub(&tangent(j)), self.a(i).sub(&self.a(j))]
    }
}

/// Goldberg's loop of five.
fn goldberg() -> Composed {
    let x = ratio(variable(X));
    let (kb, kc) = (constant(ALPHA, BETA), constant(ALPHA, GAMMA));
    let k = times(&kb, &kc);
    let [alpha, beta, gamma] = [ALPHA, BETA, GAMMA].map(|k| ratio(variable(k)));
    let among = [ALPHA, BETA, GAMMA];
    let [a, b, c] = among.map(|k| sine(k, &among).mul(&variable(SCALE)));
    let members = vec![
        member(x.clone(), sum(&beta, &gamma), b.add(&c)),
        member(over(&k, &x), alpha.clone(), a.clone()),
        member(over(&x, &kb), gamma, c),
        member(merged(&x, &k), beta, b),
        member(over(&kb, &x), alpha, a),
    ];
    let own = Own(5);
    let mut conditions = own.equal(5, 2).to_vec();
    conditions.extend([
        is_sum(1, &[3, 4]),
        own.a(1).sub(&own.a(3)).sub(&own.a(4)),
        own.proportional(3, 2),
        own.proportional(4, 2),
    ]);
    conditions.extend(own.offsets());
    let made = "two Bennett loops with a common link, which is taken away, and a common joint, at which two links become one (Goldberg 1943); a \
                negative twist gives the subtractive one";
    Composed::new("Goldberg", made, members, conditions)
}

/// Returns `x (1 - k)/(x^2 + k)`, the tangent where the angles of two loops at a joint are added.
fn merged(x: &Ratio, k: &Ratio) -> Ratio {
    let square = times(x, x);
    let top = (k.1.sub(&k.0), k.1.clone());
    let below = (square.0.mul(&k.1).add(&k.0.mul(&square.1)), square.1.mul(&k.1));
    over(&times(x, &top), &below)
}

/// Myard's loop: Goldberg's with right angles alpha, and gamma = beta - pi, so that link 1 has no length.
fn myard() -> Composed {
    let (x, one) = (ratio(variable(X)), ratio(Poly::one()));
    let (beta, b) = (ratio(variable(BETA)), variable(BETA));
    let gamma = minus(&over(&one, &beta));
    let kb = (Poly::one().add(&b), b.sub(&Poly::one()));
    let k = minus(&one);
    let scale = variable(SCALE);
    // The sine of beta is 2 b/(1 + b^2).
    let (short, long) = (b.add(&b).mul(&scale), Poly::one().add(&b.mul(&b)).mul(&scale));
    let members = vec![
        member(x.clone(), sum(&beta, &gamma), Poly::zero()),
        member(over(&k, &x), one.clone(), long.clone()),
        member(over(&x, &kb), gamma, short.neg()),
        member(merged(&x, &k), beta, short),
        member(over(&kb, &x), one.clone(), long),
    ];
    let own = Own(5);
    let mut conditions = own.equal(5, 2).to_vec();
    conditions.extend([
        tangent(2).sub(&Poly::one()),
        tangent(3).mul(&tangent(4)).add(&Poly::one()),
        is_sum(1, &[3, 4]),
        own.a(1),
        own.a(3).add(&own.a(4)),
        own.proportional(4, 2),
    ]);
    conditions.extend(own.offsets());
    let made = "a Goldberg loop of two Bennett loops that are mirror images, with right angles at the common link and at its opposites (Myard 1931)";
    Composed::new("Myard", made, members, conditions)
}

/// Goldberg's loop of six: three Bennett loops in a row.
fn goldberg_of_three() -> Composed {
    let x = ratio(variable(X));
    let [kb, kc, kd] = [BETA, GAMMA, DELTA].map(|other| constant(ALPHA, other));
    let k = times(&kb, &kc);
    let [alpha, beta, gamma, delta] = [ALPHA, BETA, GAMMA, DELTA].map(|k| ratio(variable(k)));
    let among = [ALPHA, BETA, GAMMA, DELTA];
    let [a, b, c, d] = among.map(|k| sine(k, &among).mul(&variable(SCALE)));
    // The third loop is joined to a Goldberg loop at its link 2, as the second one is to the first.
    let joined = merged(&over(&x, &kb), &times(&kd, &kc));
    let members = vec![
        member(x.clone(), sum(&sum(&beta, &gamma), &delta), b.add(&c).add(&d)),
        member(minus(&over(&times(&kd, &k), &x)), alpha.clone(), a.clone()),
        member(minus(&over(&x, &k)), delta, d),
        member(minus(&joined), gamma, c),
        member(merged(&x, &k), beta, b),
        member(over(&kb, &x), alpha, a),
    ];
    let own = Own(6);
    let mut conditions = own.equal(6, 2).to_vec();
    conditions.extend([
        is_sum(1, &[3, 4, 5]),
        own.a(1).sub(&own.a(3)).sub(&own.a(4)).sub(&own.a(5)),
        own.proportional(3, 2),
        own.proportional(4, 2),
        own.proportional(5, 2),
    ]);
    conditions.extend(own.offsets());
    let made = "three Bennett loops in a row, joined two by two as in Goldberg's loop of five (Goldberg 1943)";
    Composed::new("Goldberg, three loops", made, members, conditions)
}

/// Waldron's loop of two Bennett loops.
fn waldron() -> Composed {
    let x = ratio(variable(X));
    let [first, second] = [constant(BETA, ALPHA), constant(DELTA, GAMMA)];
    let [alpha, beta, gamma, delta] = [ALPHA, BETA, GAMMA, DELTA].map(|k| ratio(variable(k)));
    let [a, b] = [ALPHA, BETA].map(|k| sine(k, &[ALPHA, BETA]).mul(&variable(SCALE)));
    let [c, d] = [GAMMA, DELTA].map(|k| sine(k, &[GAMMA, DELTA]).mul(&variable(OTHER_SCALE)));
    let members = vec![
        member(minus(&over(&first, &x)), beta.clone(), b.clone()),
        member(minus(&x), alpha.clone(), a.clone()),
        member(over(&first, &x), sum(&beta, &gamma), b.add(&c)),
        member(over(&second, &x), delta.clone(), d.clone()),
        member(x.clone(), gamma, c),
        member(minus(&over(&second, &x)), sum(&delta, &alpha), d.add(&a)),
    ];
    let own = Own(6);
    let mut conditions = vec![
        is_sum(3, &[1, 5]),
        is_sum(6, &[2, 4]),
        own.a(3).sub(&own.a(1)).sub(&own.a(5)),
        own.a(6).sub(&own.a(2)).sub(&own.a(4)),
        own.proportional(1, 2),
        own.proportional(4, 5),
    ];
    conditions.extend(own.offsets());
    let made = "two Bennett loops with a common axis, on which they have the same angle; its joint is taken away (Waldron 1968, his loops without \
                offset along the axis)";
    Composed::new("Waldron, two Bennett loops", made, members, conditions)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_families_close_and_their_examples_move() {
        let names = |joints| Composed::all(joints).iter().map(|one| one.name).collect::<Vec<_>>();
        assert_eq!(names(5), ["Goldberg", "Myard"]);
        assert_eq!(names(6), ["Goldberg, three loops", "Waldron, two Bennett loops"]);
        assert!(names(4).is_empty());
    }

    #[test]
    fn a_loop_beside_a_family_is_no_member_and_does_not_move() {
        for joints in [5, 6] {
            for family in Composed::all(joints) {
                assert!(family.contains(&family.example), "{}", family.name);
                let mut beside = family.clone();
                // One length off by a millionth.
                beside.example[1].a += Rational::from((1, 1_000_000));
                assert!(!family.contains(&beside.example) && !beside.moves(), "{}", family.name);
            }
        }
    }

    #[test]
    fn a_wrong_sign_is_refused() {
        for family in Composed::all(5).into_iter().chain(Composed::all(6)) {
            let mut wrong = family.clone();
            wrong.members[0].theta = minus(&wrong.members[0].theta);
            assert!(!closes(&wrong.members), "{}", family.name);
        }
    }
}
