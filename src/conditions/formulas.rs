//! Lengths and motion of a mobile 5R loop for all twists of an ansatz: formulas fitted to random twists, and an identity that
//! proves them.

use super::branch::{Branch, Image, spherical_loop};
use super::closure_identity::{Member, closes};
use super::curve_ansatz::{Curve, canonical, curves};
use super::finite_field::{Turn, square_root};
use super::twist_family::Ratio;
use crate::algebra::echelon::Echelon;
use crate::algebra::int::Int;
use crate::algebra::lift;
use crate::algebra::modp::PRIME_61;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::sort;
use crate::algebra::text::Names;
use crate::catalogue::ansatz::{Ansatz, Twist};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};

/// A loop that moves for all twists.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// Conditions on the lengths, in cosines and sines of the free angles and the lengths `a1` to `a5`, `d1` to `d5` of the
    /// loop; together they determine all lengths up to a common factor.
    pub conditions: Vec<Polynomial<Rational>>,
    /// The names of the variables of the conditions.
    pub names: Names,
    /// The half-angle tangent of every joint, as a function of that of one joint (the last variable) and those of the free
    /// angles.
    pub motion: Vec<Ratio>,
    /// The names of the variables of the motion.
    pub motion_names: Names,
    /// Whether the product of all joints and links with these joint angles and lengths was expanded and is a number.
    pub proved: bool,
    /// Number of twists at which the loop was examined.
    pub samples: usize,
}

/// A loop at random twists.
struct Sample {
    /// Half-angle tangents of the free angles.
    tangents: Vec<Image>,
    /// The lengths, all a, then all d.
    lengths: Vec<Image>,
    /// For every joint, numerator and denominator of its half-angle tangent as polynomials in that of the tied one.
    motion: Vec<Vec<Image>>,
}

/// Number of lines of twists, and of points on each of them.
const LINES: usize = 12;
const PLACES: usize = 14;
/// Excess of rows over columns, so that a formula is no accident.
const SURPLUS: usize = 8;
/// Maximum degree of a half-angle tangent as a function of another.
const MOTION: usize = 4;

/// Extends the loop of a curve at some tangents of the free angles to all of them; `None` if it has no formulas of low degree.
#[must_use]
pub fn formulas(ansatz: &Ansatz, tangents: &[Rational], curve: &Curve<Rational>, seed: u64) -> Option<Formulas> {
    let angles = tangents.len();
    if angles == 0 || curve.lengths.len() != 1 {
        return None;
    }
    let base: Vec<Image> = tangents.iter().map(Image::from_rational).collect::<Option<_>>()?;
    let branch = Branch::new(ansatz, curve.tie, &base, Image::from_rational(&curve.constant)?)?;
    let line = |number: usize| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_add(number as u64));
        let mut random = || Image::new(rng.random_range(1..PRIME_61));
        let direction: Vec<Image> = (0..angles).map(|_| random()).collect();
        let (numerator, denominator) = branch.along(&direction)?;
        let place = |parameter: &Image| {
            let constant = numerator.eval(parameter).mul(&denominator.eval(parameter).inverse()?);
            sample(ansatz, curve, branch.at(&direction, parameter), &constant)
        };
        let places: Vec<Image> = (0..PLACES).map(|_| random()).collect();
        Some(places.iter().filter_map(place).collect::<Vec<_>>())
    };
    // One line comes first: a constant that is no rational function there is none along the others.
    let mut samples = line(0)?;
    samples.par_extend((1..LINES).into_par_iter().filter_map(line).flatten_iter());
    let shape = |sample: &Sample| -> (Vec<bool>, Vec<usize>) {
        (sample.lengths.iter().map(Ring::is_zero).collect(), sample.motion.iter().map(Vec::len).collect())
    };
    let expected = shape(samples.first()?);
    samples.retain(|sample| shape(sample) == expected);
    let names = names(ansatz)?;
    let conditions = conditions(ansatz, &samples)?;
    let fit = |value: &dyn Fn(&Sample) -> Image| rational_fit(&samples, angles, value);
    let lengths: Vec<Ratio> = (0..10).map(|k| fit(&|sample| sample.lengths[k])).collect::<Option<_>>()?;
    let motion: Vec<Ratio> = (0..5)
        .map(|joint| {
            let count = expected.1[joint];
            let coefficients: Vec<Ratio> =
                (0..count).map(|k| fit(&|sample| sample.motion[joint][k])).collect::<Option<_>>()?;
            Some(in_tangent(&common(&coefficients).0, angles))
        })
        .collect::<Option<_>>()?;
    let (lengths, _) = common(&lengths);
    let member = |joint: usize| {
        let alpha = half_tangent(&ansatz.twist(joint), ansatz.free_angles());
        Member { theta: motion[joint].clone(), d: lengths[5 + joint].clone(), alpha, a: lengths[joint].clone() }
    };
    let proved = closes(&(0..5).map(member).collect::<Vec<_>>());
    let tangent = |k: &usize| format!("tan_half_{}", ansatz.symbols.angles[*k]);
    let motion_names = Names::given(ansatz.free_angles().iter().map(tangent).chain(["x".to_owned()])).ok()?;
    Some(Formulas { conditions, names, motion, motion_names, proved, samples: samples.len() })
}

/// Returns the names: cosine and sine of the free angles, then the lengths of the loop.
fn names(ansatz: &Ansatz) -> Option<Names> {
    let angle = |k: &usize| ["cos", "sin"].map(|function| format!("{function}_{}", ansatz.symbols.angles[*k]));
    let functions = ansatz.free_angles().iter().flat_map(angle);
    let lengths = ["a", "d"].into_iter().flat_map(|letter| (1..=5).map(move |k| format!("{letter}{k}")));
    Names::given(functions.chain(lengths)).ok()
}

/// Returns the loop on the same branch at other twists.
fn sample(ansatz: &Ansatz, curve: &Curve<Rational>, tangents: Vec<Image>, constant: &Image) -> Option<Sample> {
    let links = spherical_loop(ansatz, &tangents)?;
    let places: Vec<Image> = (2..34).map(Image::new).collect();
    let mut found = curves(&links, curve.tie, constant, &places, |x| square_root(*x));
    found.retain(|other| other.lengths.len() == 1 && other.is_proper());
    // Two loops on one branch are not distinguished here; another tie does that.
    let [found] = found.as_slice() else { return None };
    let half = |turn: &Turn<Image>| turn.0.add(&Image::one()).inverse().map(|inverse| turn.1.mul(&inverse));
    let xs: Vec<Option<Image>> = found.points.iter().map(|turns| half(&turns[curve.tie.first])).collect();
    let joint = |joint: usize| {
        let points = found.points.iter().zip(&xs);
        let points: Vec<(Image, Image)> = points.filter_map(|(turns, x)| Some(((*x)?, half(&turns[joint])?))).collect();
        motion(&points)
    };
    let motion = (0..5).map(joint).collect::<Option<_>>()?;
    Some(Sample { tangents, lengths: found.lengths[0].clone(), motion })
}

/// Returns numerator and denominator of the rational function of least degree through points: their coefficients, lowest
/// first, normalised so that the first of the numerator, or else the next one, is 1.
fn motion(points: &[(Image, Image)]) -> Option<Vec<Image>> {
    (0..=MOTION).find_map(|degree| {
        let columns = 2 * (degree + 1);
        if points.len() < columns + 2 {
            return None;
        }
        let row = |(x, y): &(Image, Image)| {
            let mut powers = vec![Image::one()];
            for k in 0..degree {
                powers.push(powers[k].mul(x));
            }
            powers.iter().copied().chain(powers.iter().map(|power| power.mul(y).neg())).collect::<Vec<_>>()
        };
        let space = canonical(Echelon::of(points.iter().map(row).collect(), columns).null_space());
        space.into_iter().next()
    })
}

/// Returns the products of powers up to a degree in each of some variables, those of high degree first.
fn monomials(variables: usize, degree: u32) -> Vec<Vec<u32>> {
    let mut list = vec![Vec::new()];
    for _ in 0..variables {
        let longer = |start: &Vec<u32>| (0..=degree).map(|e| [start.as_slice(), &[e]].concat()).collect::<Vec<_>>();
        list = list.iter().flat_map(longer).collect();
    }
    sort::by_key(&mut list, |exponents| std::cmp::Reverse(exponents.iter().sum::<u32>()));
    list
}

/// Returns a rational function of the tangents with given values and small coefficients; `None` if there is none of low
/// degree.
fn rational_fit(samples: &[Sample], angles: usize, value: &dyn Fn(&Sample) -> Image) -> Option<Ratio> {
    for degree in 0.. {
        let list = monomials(angles, degree);
        let columns = 2 * list.len();
        if columns + SURPLUS > samples.len() {
            return None;
        }
        // Numerator and denominator of one degree are neighbours, so that the last vector is one of lowest degree.
        let row = |sample: &Sample| {
            let v = value(sample);
            let powers = |exponents: &Vec<u32>| {
                exponents
                    .iter()
                    .zip(&sample.tangents)
                    .fold(Image::one(), |product, (&e, t)| (0..e).fold(product, |product, _| product.mul(t)))
            };
            list.iter().flat_map(|exponents| [powers(exponents), powers(exponents).mul(&v).neg()]).collect::<Vec<_>>()
        };
        let space = canonical(Echelon::of(samples.iter().map(row).collect(), columns).null_space());
        let Some(vector) = space.last() else { continue };
        let integers = integers(vector)?;
        let part = |offset: usize| {
            let terms =
                list.iter().enumerate().map(|(k, exponents)| (exponents.clone(), integers[2 * k + offset].clone()));
            Polynomial::from_terms(terms)
        };
        let (numerator, denominator): (Polynomial<Int>, Polynomial<Int>) = (part(0), part(1));
        if denominator.is_zero() {
            return None;
        }
        if numerator.is_zero() {
            return Some((numerator, Polynomial::one()));
        }
        let common = numerator.gcd(&denominator);
        return Some((numerator.div_exact(&common), denominator.div_exact(&common)));
    }
    None
}

/// Returns integers in the ratios of residues, if they are small.
fn integers(vector: &[Image]) -> Option<Vec<Int>> {
    let rationals: Vec<Rational> =
        vector.iter().map(|x| lift::rational(&[(x.value(), PRIME_61)])).collect::<Option<_>>()?;
    let denominator = rationals.iter().fold(Integer::from(1), |lcm, c| lcm.lcm(c.denom()));
    let whole = |c: &Rational| Int::from(Rational::from(c * &denominator).into_numer_denom().0);
    Some(rationals.iter().map(whole).collect())
}

/// Returns the numerators over a common denominator, and this.
fn common(ratios: &[Ratio]) -> (Vec<Polynomial<Int>>, Polynomial<Int>) {
    let denominator = ratios.iter().fold(Polynomial::<Int>::one(), |lcm, (_, denominator)| {
        let gcd = lcm.gcd(denominator);
        lcm.mul(&denominator.div_exact(&gcd))
    });
    let scaled = |(n, d): &Ratio| n.mul(&denominator.div_exact(d));
    (ratios.iter().map(scaled).collect(), denominator.clone())
}

/// Returns numerator and denominator from their coefficients in the last variable.
fn in_tangent(coefficients: &[Polynomial<Int>], angles: usize) -> Ratio {
    let (numerator, denominator) = coefficients.split_at(coefficients.len() / 2);
    let [n, d] = [numerator, denominator].map(|part| Polynomial::from_coefficients_in(angles, part));
    let common = n.gcd(&d);
    if n.is_zero() { (n, Polynomial::one()) } else { (n.div_exact(&common), d.div_exact(&common)) }
}

/// Returns the tangent of half a twist in terms of those of the free angles.
fn half_tangent(twist: &Twist, free: &[usize]) -> Ratio {
    let (cos, sin) = &twist.constant;
    // Cosine and sine of half the constant, up to a factor.
    let constant =
        if *cos == -1 { [Rational::new(), Rational::from(1)] } else { [Rational::from(cos + 1), sin.clone()] };
    let scale = constant.iter().fold(Integer::from(1), |lcm, c| lcm.lcm(c.denom()));
    let [mut real, mut imaginary] =
        constant.map(|c| Polynomial::constant(Int::from((c * &scale).into_numer_denom().0)));
    for (variable, &angle) in free.iter().enumerate() {
        let multiple = twist.multiples[angle];
        let t = Polynomial::variable(variable).scale(&Int::from_integer(multiple.signum()));
        for _ in 0..multiple.unsigned_abs() {
            (real, imaginary) = (real.sub(&imaginary.mul(&t)), imaginary.add(&real.mul(&t)));
        }
    }
    let common = real.gcd(&imaginary);
    if imaginary.is_zero() {
        return (imaginary, Polynomial::one());
    }
    (imaginary.div_exact(&common), real.div_exact(&common))
}

/// Returns relations with fewest terms that determine all nonzero lengths from one of them.
fn conditions(ansatz: &Ansatz, samples: &[Sample]) -> Option<Vec<Polynomial<Rational>>> {
    let angles = ansatz.free_angles().len();
    let variable = |k: usize| Polynomial::<Rational>::variable(2 * angles + k);
    let first = samples.first()?;
    let (zero, others): (Vec<usize>, Vec<usize>) = (0..10).partition(|&k| first.lengths[k].is_zero());
    let from = |&start: &usize| {
        let (mut known, mut found) = (vec![start], Vec::new());
        while known.len() < others.len() {
            let next = others.iter().filter(|k| !known.contains(k));
            let relations = next.filter_map(|&k| Some((k, relation(samples, angles, k, &known)?)));
            let (k, relation) = relations.min_by_key(|(_, relation)| (relation.len(), relation.total_degree()))?;
            known.push(k);
            found.push(relation);
        }
        Some(found)
    };
    let size = |list: &Vec<Polynomial<Rational>>| list.iter().map(Polynomial::len).sum::<usize>();
    let best = others.iter().filter_map(from).min_by_key(size)?;
    Some(zero.into_iter().map(variable).chain(best).collect())
}

/// Returns the simplest relation between a length and some others, linear in these, with functions of the angles as coefficients.
fn relation(samples: &[Sample], angles: usize, length: usize, known: &[usize]) -> Option<Polynomial<Rational>> {
    let variable = |k: usize| Polynomial::<Rational>::variable(2 * angles + k);
    let mut functions = vec![Polynomial::one()];
    functions.extend((0..2 * angles).map(Polynomial::variable));
    let products: Vec<_> = (0..functions.len())
        .flat_map(|i| (0..=i).map(|j| functions[i].mul(&functions[j])).collect::<Vec<_>>())
        .collect();
    let one = &functions[..1];
    let single = known.iter().map(|&k| vec![length, k]);
    let pairs = (0..known.len()).flat_map(|i| (i + 1..known.len()).map(move |j| (i, j)));
    let double: Vec<Vec<usize>> = pairs.map(|(i, j)| vec![length, known[i], known[j]]).collect();
    let tries = single
        .clone()
        .map(|list| (list, one))
        .chain(double.iter().map(|list| (list.clone(), one)))
        .chain(single.clone().map(|list| (list, functions.as_slice())))
        .chain(double.iter().map(|list| (list.clone(), functions.as_slice())))
        .chain(single.map(|list| (list, products.as_slice())));
    for (list, functions) in tries {
        let mut terms: Vec<_> = list.iter().flat_map(|&k| functions.iter().map(move |f| f.mul(&variable(k)))).collect();
        sort::by_key(&mut terms, |term| std::cmp::Reverse(term.total_degree()));
        if terms.len() + SURPLUS > samples.len() {
            continue;
        }
        let images: Vec<Polynomial<Image>> = terms.iter().filter_map(|term| term.map(Image::from_rational)).collect();
        let row = |sample: &Sample| {
            let mut values: Vec<Image> = Vec::new();
            for t in &sample.tangents {
                let (cos, sin) = super::finite_field::turn::<PRIME_61>(*t);
                values.extend([cos, sin]);
            }
            values.extend(&sample.lengths);
            images.iter().map(|image| image.evaluate(&values)).collect::<Vec<_>>()
        };
        let space = canonical(Echelon::of(samples.iter().map(row).collect(), terms.len()).null_space());
        let sum = |vector: &Vec<Image>| {
            let coefficients = integers(vector)?;
            let scaled = |(term, c): (&Polynomial<Rational>, &Int)| term.scale(&Rational::from(c.to_integer()));
            let sum = terms.iter().zip(&coefficients).map(scaled).fold(Polynomial::zero(), |sum, term| sum.add(&term));
            // A relation between the others does not contain this length.
            (sum.degree(2 * angles + length) > 0).then_some(sum)
        };
        if let Some(found) = space.iter().filter_map(sum).min_by_key(Polynomial::len) {
            return Some(found);
        }
    }
    None
}
