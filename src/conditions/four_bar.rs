//! Mobility of a loop of four revolute joints: all conditions, derived and proved step by step.
//!
//! The loop closes where f = 0, a curve in the angles of joints 1 and 4, and g = 0, linear in lengths and offsets
//! ([`crate::derivation::transference`]). It moves if g vanishes on a component of the curve. The proof finds the twists
//! at which the curve is reducible, its components there, and the null space of the linear conditions on each.

use super::closure_identity::{Member, closes};
use super::component::{Coefficients, Component};
use super::null_space::{null_space, primitive};
use super::step::{Formula, Step, plain, tangents};
use super::twist_family::{Ratio, Shape, Signs, TwistFamily, families, sine, with_tangents};
use crate::algebra::factors::remove_factors;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::sort;
use crate::derivation::transference::{SpatialPair, Variables, general_pair, half_angle_pair};

type Poly = Polynomial<Int>;

/// The lengths and offsets in g, in the order of the columns of all linear systems.
pub const LENGTHS: [usize; 6] = [4, 5, 6, 7, 8, 11];

/// The factors of each coefficient of f: twice the product of two sines of half sums of the twists.
const SPLITS: [(&str, [Signs; 2]); 4] = [
    ("A", [[1, 1, 1, -1], [1, -1, 1, -1]]),
    ("B", [[-1, 1, 1, 1], [-1, -1, 1, 1]]),
    ("C", [[1, 1, -1, 1], [1, -1, -1, 1]]),
    ("E", [[1, 1, 1, 1], [1, -1, 1, 1]]),
];

/// A Bennett loop of four joints, for a given orientation of its axes.
#[derive(Clone, Debug)]
pub struct Bennett {
    /// The twists.
    pub twists: TwistFamily,
    /// The half-angle tangent of joint 4 as a function of x, that of joint 1.
    pub fourth: Ratio,
    /// The lengths `a1, a2, a3, a4`, up to a common factor.
    pub lengths: [Poly; 4],
    /// The half-angle tangents of all joints as functions of x, that of joint 1.
    pub angles: [Ratio; 4],
}

/// The conditions derived and proved.
#[derive(Clone, Debug)]
pub struct FourBar {
    /// The closure equations.
    pub pair: SpatialPair<Poly>,
    /// The steps of the proof, each with its computation and whether it came out as stated.
    pub steps: Vec<Step>,
    /// Bennett's loops: every choice of signs, the first two those of equal opposite twists.
    pub bennett: Vec<Bennett>,
}

impl FourBar {
    /// Returns whether every step came out as stated.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        self.steps.iter().all(|step| step.holds)
    }
}

fn t(k: usize) -> Poly {
    Poly::variable(Variables::twist(k))
}

/// Returns `1 + t_k^2`.
fn circle(k: usize) -> Poly {
    t(k).mul(&t(k)).add(&Poly::one())
}

/// Returns the factors that are not zero if no sine of a twist is: `t_k` and `1 + t_k^2`.
fn harmless() -> Vec<Poly> {
    (0..4).map(t).chain((0..4).map(circle)).collect()
}

/// Removes the factors `t_k` and `1 + t_k^2` from a polynomial.
fn bare(p: &Poly) -> Poly {
    remove_factors(p, &harmless()).rest.primitive_part()
}

/// Returns whether a polynomial has no zero if no sine of a twist is zero: only a number remains of it.
fn is_harmless(p: &Poly) -> bool {
    !p.is_zero() && bare(p) == Poly::one()
}

/// Derives all conditions.
#[must_use]
pub fn derive() -> FourBar {
    let pair = half_angle_pair(&general_pair());
    let mut steps = Vec::new();
    let coefficients = closure(&pair, &mut steps);
    if let Some(coefficients) = &coefficients {
        splits(coefficients, &mut steps);
        reducibility(coefficients, &mut steps);
        irreducible(&pair, coefficients, &mut steps);
    }
    let twists = twist_families(&mut steps);
    let bennett = reducible(&pair, twists, &mut steps);
    let bennett = sufficiency(&pair, bennett, &mut steps);
    super::degenerate::folds(&mut steps);
    super::degenerate::zero_twists(&pair, &mut steps);
    FourBar { pair, steps, bennett }
}

/// Derives the closure equations and the form of f.
fn closure(pair: &SpatialPair<Poly>, steps: &mut Vec<Step>) -> Option<Coefficients> {
    let coefficients = Coefficients::of(&pair.f);
    // Even monomials carry lengths of links, odd ones offsets.
    let parity = LENGTHS.iter().all(|&length| {
        let odd = length >= Variables::offset(0);
        let part = pair.g.derivative(length);
        part.terms().all(|(e, _)| {
            let degree = |v: usize| e.get(v).copied().unwrap_or(0);
            (degree(Variables::X) + degree(Variables::Y)) % 2 == u32::from(odd)
        })
    });
    let linear = LENGTHS.iter().fold(Poly::zero(), |sum, &v| sum.add(&Poly::variable(v).mul(&pair.g.derivative(v))));
    steps.push(Step {
        title: "Closure equations".to_owned(),
        text: format!(
            "The spherical closure equation z2.z3 = cos(alpha2) over dual numbers gives f ({} terms), in the angles only, and g \
             ({} terms), linear in a1, ..., a4, d1, d4, with t_k = tan(alpha_k/2), x = tan(theta1/2), y = tan(theta4/2), both times \
             1 + t^2 of every angle. f = A x^2 y^2 + B x^2 + C y^2 + M x y + E; in g the a_k stand in the even monomials, the d_k \
             in the odd ones. The loop moves exactly where g vanishes on a component of the curve f = 0 (in the product of two \
             projective lines).",
            pair.f.len(),
            pair.g.len()
        ),
        formulas: coefficients.iter().flat_map(|c| {
            ["A", "B", "C", "M", "E"].into_iter().zip(c.list()).map(|(name, p)| Formula::new(name, p, &harmless()))
        }).collect(),
        holds: coefficients.is_some() && parity && linear == pair.g,
    });
    coefficients
}

/// Proves that every coefficient is a product of two sines.
fn splits(coefficients: &Coefficients, steps: &mut Vec<Step>) {
    let named = [("A", &coefficients.a), ("B", &coefficients.b), ("C", &coefficients.c), ("E", &coefficients.e)];
    let mut formulas = Vec::new();
    let mut holds = true;
    for ((name, coefficient), (split, factors)) in named.into_iter().zip(SPLITS) {
        let product = sine(factors[0]).mul(&sine(factors[1]));
        holds &= name == split && product.scale(&Int::from_integer(-2)) == *coefficient;
        let sign = |signs: Signs| signs.map(|s| if s > 0 { "+" } else { "-" }).concat();
        formulas.push(Formula::text(name, format!("-2 s({}) s({})", sign(factors[0]), sign(factors[1]))));
    }
    // M = 4 sin(alpha1) sin(alpha3), in tangents.
    let m = t(0).mul(&t(2)).mul(&circle(1)).mul(&circle(3)).scale(&Int::from_integer(16));
    holds &= coefficients.m == m;
    formulas.push(Formula::new("M", &coefficients.m, &harmless()));
    steps.push(Step {
        title: "Splitting".to_owned(),
        text: "With s(e) = sin((e1 alpha1 + e2 alpha2 + e3 alpha3 + e4 alpha4)/2), whose numerator is the imaginary part of prod (1 + i \
               e_k t_k), every coefficient is a product of two of them (multiplied out and compared); M is not zero where no sine \
               of a twist is."
            .to_owned(),
        formulas,
        holds,
    });
}

/// Applies the discriminant argument.
fn reducibility(c: &Coefficients, steps: &mut Vec<Step>) {
    // disc_y/4 in X = x^2, with M = 2D: quadratic alpha X^2 + beta X + gamma, here times 4.
    let four = Int::from_integer(4);
    let alpha = c.a.mul(&c.b).scale(&four).neg();
    let gamma = c.c.mul(&c.e).scale(&four).neg();
    let beta = c.m.mul(&c.m).sub(&c.a.mul(&c.e).add(&c.b.mul(&c.c)).scale(&four));
    let discriminant = beta.mul(&beta).sub(&alpha.mul(&gamma).scale(&four));
    let holds = is_harmless(&discriminant);
    steps.push(Step {
        title: "When the curve is reducible".to_owned(),
        text: "Let no sine of a twist be zero. As a quadratic in y, f = (A x^2 + C) y^2 + M x y + (B x^2 + E) has over the complex \
               numbers either a factor in x alone, which divides M x: x = 0 (C = E = 0) or x = inf (A = B = 0); or its discriminant \
               alpha x^4 + beta x^2 + gamma (alpha = -4 A B, gamma = -4 C E) is the square of a polynomial p x^2 + q x + r, so that p \
               q = q r = 0: with q = 0 the discriminant of the discriminant, beta^2 - 4 alpha gamma, vanishes; with p = r = 0, A B = 0 \
               and C E = 0. But beta^2 - 4 alpha gamma is a product of powers of the sines. So f is reducible exactly if (A B = 0 and C E \
               = 0) or C = E = 0 or A = B = 0."
            .to_owned(),
        formulas: vec![Formula::new("beta^2 - 4 alpha gamma", &discriminant, &harmless())],
        holds,
    });
}

/// Returns the coefficient of a power of x times one of y.
fn monomial(p: &Poly, i: usize, j: usize) -> Poly {
    let part = p.coefficients_in(Variables::X).get(i).cloned().unwrap_or_else(Poly::zero);
    part.coefficients_in(Variables::Y).get(j).cloned().unwrap_or_else(Poly::zero)
}

/// Treats irreducible f, of which g is then a multiple.
fn irreducible(pair: &SpatialPair<Poly>, c: &Coefficients, steps: &mut Vec<Step>) {
    let parts: Vec<Poly> = LENGTHS.iter().map(|&length| pair.g.derivative(length)).collect();
    let even = [(2, 2), (2, 0), (0, 2), (1, 1), (0, 0)];
    let rows: Vec<Vec<Poly>> = even
        .iter()
        .zip(c.list())
        .map(|(&(i, j), own)| parts[..4].iter().map(|part| monomial(part, i, j)).chain([own.clone()]).collect())
        .collect();
    let determinant = Poly::determinant(&rows);
    let odd = [(2, 1), (1, 2), (1, 0), (0, 1)];
    let rows: Vec<[Poly; 2]> = odd.iter().map(|&(i, j)| [4, 5].map(|k| monomial(&parts[k], i, j))).collect();
    let minors: Vec<Poly> = (0..4)
        .flat_map(|i| (i + 1..4).map(move |j| (i, j)))
        .map(|(i, j)| bare(&rows[i][0].mul(&rows[j][1]).sub(&rows[j][0].mul(&rows[i][1]))))
        .collect();
    // Two minors leave finitely many common zeros t1 and t3; at each of them some other one does not vanish.
    let square = |k: usize| t(k).mul(&t(k)).sub(&Poly::one());
    let only = |p: &Poly| minors.contains(p);
    let at = |p: &Poly, i: i32, j: i32| {
        let value = |n: i32| Poly::constant(Int::from_integer(n));
        p.substitute_all(&[(Variables::twist(0), value(i)), (Variables::twist(2), value(j))])
    };
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let none = signs.iter().all(|&(i, j)| minors.iter().any(|minor| is_harmless(&at(minor, i, j))));
    let offsets = only(&square(0)) && only(&square(2)) && none;
    steps.push(Step {
        title: "Irreducible curve".to_owned(),
        text: format!(
            "Let f be irreducible and no sine zero. Then g = lambda f. Odd monomials: 4 equations in d1, d4; without powers of t_k \
             and 1 + t_k^2 two of their minors are t1^2 - 1 and t3^2 - 1, and where both vanish another one does not: d1 = d4 = 0. Even \
             monomials: 5 equations in a1, ..., a4, lambda, whose determinant ({} terms) is a product of powers of the sines: all a_k = \
             0. The same from joint 3 on: d2 = d3 = 0. All axes meet in one point: only the spherical loop moves.",
            determinant.len()
        ),
        formulas: vec![Formula::new("determinant", &determinant, &harmless())],
        holds: is_harmless(&determinant) && offsets,
    });
}

/// Returns the twists at which f is reducible.
fn twist_families(steps: &mut Vec<Step>) -> Vec<TwistFamily> {
    let [a, b, c, e] = SPLITS.map(|(_, factors)| factors);
    let pairs = |left: &[Signs], right: &[Signs]| -> Vec<(Signs, Signs)> {
        left.iter().flat_map(|&e| right.iter().map(move |&other| (e, other))).collect()
    };
    let product = pairs(&[a, b].concat(), &[c, e].concat());
    let contents: Vec<_> = pairs(&c, &e).into_iter().chain(pairs(&a, &b)).collect();
    let all: Vec<TwistFamily> =
        product.iter().chain(&contents).filter_map(|&(e, other)| families(e, other)).flatten().collect();
    let count = |shape: Shape| all.iter().filter(|family| family.shape == shape).count();
    let (isograms, deltoids, turned) = (count(Shape::Isogram), count(Shape::Deltoid), count(Shape::TurnedDeltoid));
    let excluded = product.len() + contents.len() - all.len() / 2;
    let names: Vec<String> = all.iter().map(|family| format!("{:?}", family.relations)).collect();
    let distinct = (0..names.len()).all(|i| !names[..i].contains(&names[i]));
    steps.push(Step {
        title: "Twists at which it is".to_owned(),
        text: format!(
            "Two factors s(e), s(e') vanish where half of e.alpha + e'.alpha and half of e.alpha - e'.alpha are both even or both odd \
             multiples of pi. Of {} pairs of factors {excluded} make one twist a multiple of pi; the other {} pairs, with even and with \
             odd multiples, give {} families: {isograms} isograms (links 1, 3 and 2, 4), {deltoids} deltoids (links 1, 2 and 3, 4), \
             {turned} deltoids (links 1, 4 and 2, 3); t_j = +-t_i or t_j = +-1/t_i for both pairs.",
            product.len() + contents.len(),
            all.len() / 2,
            all.len()
        ),
        formulas: Vec::new(),
        holds: distinct && [isograms, deltoids, turned] == [8, 8, 8],
    });
    all
}

/// Treats the components of all families, and the linear conditions on them.
fn reducible(pair: &SpatialPair<Poly>, mut twists: Vec<TwistFamily>, steps: &mut Vec<Step>) -> Vec<Bennett> {
    let mut bennett: Vec<Bennett> = Vec::new();
    let (mut isogram, mut deltoid, mut folds) = (true, true, true);
    let (mut moving, mut still) = (0, 0);
    let (mut exceptional, mut excluded) = (Vec::new(), Vec::new());
    // Equal opposite twists come first, the family that is usually meant.
    let usual = [t(0).sub(&t(2)), t(1).sub(&t(3))];
    sort::by_key(&mut twists, |family| !usual.iter().all(|relation| family.relations.contains(relation)));
    for family in &twists {
        let f = with_tangents(&pair.f, &family.tangents);
        let g = with_tangents(&pair.g, &family.tangents);
        let components = Coefficients::of(&f).and_then(|c| c.components()).unwrap_or_default();
        isogram &= !components.is_empty();
        for component in components {
            let rows = component.equations(&g, &LENGTHS);
            let basis = null_space(&rows, LENGTHS.len());
            match (component, family.shape) {
                (Component::Fold { .. }, _) => {
                    still += 1;
                    folds &= basis.len() == 3;
                }
                (Component::Graph { solved, numerator, denominator }, Shape::Isogram) => {
                    moving += 1;
                    let [vector] = basis.as_slice() else {
                        isogram = false;
                        continue;
                    };
                    isogram &= vector[4].is_zero() && vector[5].is_zero() && solved == Variables::Y;
                    let (rest, never) = rank_drops(&rows, vector, family);
                    isogram &= never;
                    exceptional.extend(rest.iter().map(|factor| plain(factor, &tangents())));
                    let lengths = std::array::from_fn(|k| vector[k].clone());
                    let nought = || (Poly::zero(), Poly::one());
                    bennett.push(Bennett {
                        twists: family.clone(),
                        fourth: (numerator, denominator),
                        lengths,
                        angles: std::array::from_fn(|_| nought()),
                    });
                }
                (Component::Graph { .. }, _) => {
                    moving += 1;
                    deltoid &= basis.is_empty();
                    let (zeros, decided) = deltoid_exceptions(&rows, family);
                    deltoid &= decided;
                    excluded.extend(zeros.iter().map(|factor| format!("{} = 0", plain(factor, &tangents()))));
                }
            }
        }
    }
    let shown: Vec<Formula> = bennett
        .iter()
        .take(2)
        .flat_map(|b| {
            let lengths = b.lengths.iter().zip(["a1", "a2", "a3", "a4"]);
            let names = lengths.map(|(p, name)| Formula::new(name, p, &harmless()));
            let own = [Formula::ratio("y", &b.fourth)];
            own.into_iter().chain(names)
        })
        .collect();
    exceptional.sort_unstable();
    exceptional.dedup();
    steps.push(Step {
        title: "Isograms".to_owned(),
        text: format!(
            "On each of the two components of an isogram, y = K/x or y = K x, g = 0 is 5 linear equations in (a1, a2, a3, a4, d1, d4) \
             with a null space of dimension 1 over the rational functions in the two free tangents: Bennett's lengths, d1 = d4 = 0; the \
             same from joint 3 on, d2 = d3 = 0. The maximal minors are the null vector, which is never zero, times one polynomial, whose \
             factors besides t_k and 1 + t_k^2 are, over all families, {}: where one of them vanishes K is 0 or infinite, and the \
             component falls apart into folds. Everywhere else the rank is 5. (Below the first two: opposite twists equal.)",
            exceptional.join(", ")
        ),
        formulas: shown,
        holds: isogram && bennett.len() == 16,
    });
    excluded.sort_unstable();
    excluded.dedup();
    steps.push(Step {
        title: "Deltoids".to_owned(),
        text: format!(
            "On the component of a deltoid on which both joints move, g = 0 is 7 equations with null space 0. Their 6 x 6 minors vanish \
             together, where no sine does, at most where {}: twists at which the deltoid is an isogram as well, and is found there. So no other \
             lengths. ({moving} components on which joints 1 and 4 move in all 24 families, {still} folds.)",
            if excluded.is_empty() { "nothing".to_owned() } else { excluded.join(" or ") }
        ),
        formulas: Vec::new(),
        holds: deltoid && folds,
    });
    bennett
}

/// Returns the factor by which the maximal minors differ from the null vector, without `t_k` and `1 + t_k^2`, and
/// whether its rest vanishes only where K is 0 or infinite.
fn rank_drops(rows: &[Vec<Poly>], vector: &[Poly], family: &TwistFamily) -> (Vec<Poly>, bool) {
    // The columns without the first nonzero entry of the null vector: their minor is that entry times the common factor.
    let Some(skipped) = vector.iter().position(|entry| !entry.is_zero()) else { return (Vec::new(), false) };
    let columns: Vec<usize> = (0..vector.len()).filter(|&k| k != skipped).collect();
    if rows.len() != columns.len() {
        return (Vec::new(), false);
    }
    let square: Vec<Vec<Poly>> = rows.iter().map(|row| columns.iter().map(|&k| row[k].clone()).collect()).collect();
    let Some(common) = Poly::determinant(&square).checked_div_exact(&vector[skipped]) else {
        return (Vec::new(), false);
    };
    let [i, j] = family.free.map(t);
    let known = [i.sub(&j), i.add(&j), i.mul(&j).sub(&Poly::one()), i.mul(&j).add(&Poly::one())];
    let removal = remove_factors(&bare(&common), &known);
    // The entries of the null vector never all vanish: one of them is harmless.
    let never = vector.iter().any(is_harmless) && removal.rest.primitive_part() == Poly::one();
    (removal.factors.into_iter().filter(|(_, power)| *power > 0).map(|(factor, _)| factor).collect(), never)
}

/// Finds lengths for the moving component of a deltoid: the common zeros of maximal minors. Returns the factors
/// that minors have besides harmless ones, and whether all common zeros are among theirs.
///
/// Rows hold lengths or offsets, never both, so a maximal minor is the determinant of the rows of lengths times a 2 x 2
/// minor of those of offsets.
fn deltoid_exceptions(rows: &[Vec<Poly>], family: &TwistFamily) -> (Vec<Poly>, bool) {
    let [i, j] = family.free.map(t);
    let one = Poly::one();
    let known = [i.sub(&j), i.add(&j), i.mul(&j).sub(&one), i.mul(&j).add(&one)];
    let squares = [i.mul(&i).sub(&one), j.mul(&j).sub(&one)];
    let has_lengths = |row: &&Vec<Poly>| row[..4].iter().any(|entry| !entry.is_zero());
    let (lengths, offsets): (Vec<&Vec<Poly>>, Vec<&Vec<Poly>>) = rows.iter().partition(has_lengths);
    let apart = lengths.iter().all(|row| row[4..].iter().all(Poly::is_zero));
    if lengths.len() != 4 || !apart {
        return (Vec::new(), false);
    }
    // The common factors of rows are kept apart.
    let reduced: Vec<Vec<Poly>> = lengths.iter().map(|row| primitive(&row[..4])).collect();
    let contents = lengths.iter().map(|row| row[..4].iter().fold(Poly::zero(), |common, entry| common.gcd(entry)));
    let determinant = Poly::determinant(&reduced);
    let split = |p: &Poly| {
        let removal = remove_factors(&bare(p), &known);
        let factors: Vec<Poly> =
            removal.factors.into_iter().filter(|(_, power)| *power > 0).map(|(factor, _)| factor).collect();
        (factors, removal.rest.primitive_part())
    };
    let (mut factors, mut decided) = (Vec::new(), !determinant.is_zero());
    for part in contents.chain([determinant]) {
        let (found, rest) = split(&part);
        factors.extend(found);
        decided &= rest == one;
    }
    let minors = (0..offsets.len()).flat_map(|k| (k + 1..offsets.len()).map(move |l| (k, l)));
    let minors = minors.map(|(k, l)| {
        let (p, q) = (offsets[k], offsets[l]);
        p[4].mul(&q[5]).sub(&p[5].mul(&q[4]))
    });
    let minors: Vec<(Vec<Poly>, Poly)> = minors.filter(|minor| !minor.is_zero()).map(|minor| split(&minor)).collect();
    // The rest of one minor vanishes at most where a tangent is 1 or -1; there another one does not vanish.
    let chosen = minors.iter().find(|(_, rest)| *rest == one || squares.contains(rest));
    let Some((found, rest)) = chosen else { return (factors, false) };
    factors.extend(found.iter().cloned());
    let at = |p: &Poly, link: usize, value: i32| {
        p.substitute(Variables::twist(link), &Poly::constant(Int::from_integer(value)))
    };
    let excluded = match squares.iter().position(|square| square == rest) {
        None => true,
        Some(n) => {
            minors.iter().any(|(_, rest)| [1, -1].iter().all(|&value| is_harmless(&at(rest, family.free[n], value))))
        }
    };
    (factors, decided && excluded)
}

/// Proves that every Bennett loop closes for all x: the angles of joints 2 and 3, and the identity.
fn sufficiency(pair: &SpatialPair<Poly>, found: Vec<Bennett>, steps: &mut Vec<Step>) -> Vec<Bennett> {
    let total = found.len();
    let complete: Vec<Bennett> = found.into_iter().filter_map(|bennett| completed(pair, bennett)).collect();
    let refused = complete.iter().all(|bennett| {
        let mut wrong = members(bennett);
        wrong[1].theta.0 = wrong[1].theta.0.neg();
        !closes(&wrong)
    });
    let holds = complete.len() == total && refused && complete.iter().all(|bennett| closes(&members(bennett)));
    steps.push(Step {
        title: "Sufficiency".to_owned(),
        text: format!(
            "For each of the {total} Bennett families the same components, taken for the joints 2, 1 and 3, 2, give the other angles: \
             tan(theta2/2) and tan(theta3/2) as functions of x. The product of the joints 1 + tan(theta_k/2) k and the links (1 + t_k i)(2 + \
             eps a_k i) round the loop, dual quaternions over the polynomial ring in x, the two tangents and a factor b of the lengths, \
             has seven components that are the zero polynomial, and a scalar that is not: the loop closes for all x. With the sign \
             of tan(theta2/2) changed it does not."
        ),
        formulas: complete
            .iter()
            .take(2)
            .flat_map(|bennett| {
                let names = ["tan(theta1/2)", "tan(theta2/2)", "tan(theta3/2)", "tan(theta4/2)"];
                names.into_iter().zip(&bennett.angles).map(|(name, angle)| Formula::ratio(name, angle))
            })
            .collect(),
        holds,
    });
    complete
}

/// Returns the loop with all of its angles as functions of x, and `b` times the lengths.
#[must_use]
pub fn members(bennett: &Bennett) -> [Member; 4] {
    let scale = Poly::variable(Variables::length(0));
    std::array::from_fn(|k| Member {
        theta: bennett.angles[k].clone(),
        d: Poly::zero(),
        alpha: bennett.twists.tangents[k].clone(),
        a: bennett.lengths[k].mul(&scale),
    })
}

/// Finds the angles of joints 2 and 3 from the same closure equations, written for the joints (2, 1) and (3, 2).
fn completed(pair: &SpatialPair<Poly>, mut bennett: Bennett) -> Option<Bennett> {
    let x = Poly::variable(Variables::X);
    let mut angles: Vec<Ratio> = vec![(x, Poly::one())];
    for joint in 1..3 {
        let before = component_between(pair, &bennett, joint)?;
        angles.push(solved_for_first(&before, &angles[joint - 1])?);
    }
    angles.push(bennett.fourth.clone());
    bennett.angles = angles.try_into().ok()?;
    Some(bennett)
}

/// Returns the component of the closure equations in the angles of a joint and its predecessor on which g vanishes at the
/// lengths.
fn component_between(pair: &SpatialPair<Poly>, bennett: &Bennett, joint: usize) -> Option<Component> {
    let tangents = std::array::from_fn(|k| bennett.twists.tangents[(joint + k) % 4].clone());
    let f = with_tangents(&pair.f, &tangents);
    let mut g = with_tangents(&pair.g, &tangents);
    for k in 0..4 {
        // Lengths of the links are numbered from this joint on; none of the replacements contains a length.
        g = g.substitute(Variables::length(k), &bennett.lengths[(joint + k) % 4]);
    }
    let g = g.substitute(Variables::offset(0), &Poly::zero()).substitute(Variables::offset(3), &Poly::zero());
    let components = Coefficients::of(&f)?.components()?;
    components.into_iter().find(|c| c.moves() && c.restricted(&g).iter().all(Poly::is_zero))
}

/// Returns the angle of the first of two joints from that of the other: `y = K/x` or `y = K x` solved for x.
fn solved_for_first(component: &Component, other: &Ratio) -> Option<Ratio> {
    let Component::Graph { numerator, denominator, .. } = component else { return None };
    let split = |p: &Poly| -> [Poly; 2] {
        let parts = p.coefficients_in(Variables::X);
        std::array::from_fn(|k| parts.get(k).cloned().unwrap_or_else(Poly::zero))
    };
    // y (d0 + d1 x) = n0 + n1 x, so x = (n0 - y d0)/(y d1 - n1)
    let ([n0, n1], [d0, d1]) = (split(numerator), split(denominator));
    let (y, unit) = other;
    let top = n0.mul(unit).sub(&y.mul(&d0));
    let bottom = y.mul(&d1).sub(&n1.mul(unit));
    let ratio = primitive(&[bottom, top]);
    Some((ratio[1].clone(), ratio[0].clone()))
}

/// Returns the conditions under which a loop is of a Bennett family: twists, lengths, offsets; each vanishes.
#[must_use]
pub fn conditions(bennett: &Bennett) -> Vec<Poly> {
    let mut conditions = bennett.twists.relations.to_vec();
    let a = |k: usize| Poly::variable(Variables::length(k));
    let proportion = |i: usize, j: usize| {
        let parts = primitive(&[bennett.lengths[j].clone(), bennett.lengths[i].clone()]);
        a(i).mul(&parts[0]).sub(&a(j).mul(&parts[1]))
    };
    conditions.extend([proportion(0, 2), proportion(1, 3), proportion(0, 1)]);
    conditions.extend((0..4).map(|k| Poly::variable(Variables::offset(k))));
    conditions
}
