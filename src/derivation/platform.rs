//! Platforms: the legs and the Study condition, and the polynomial of a quotient of coordinates of the rotation.

use super::polynomial::{ClosurePolynomial, Meaning};
use super::{Derivation, Equation};
use crate::algebra::number::Number;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::catalogue::entry::Case;
use crate::closure::study::{Leg, scalar};
use crate::elimination::platform_degree::{PlatformDegree, platform_degree};
use crate::elimination::platform_polynomial::{Coordinate, multiple_platform_polynomial, platform_polynomial};
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use crate::mechanism::platform_over;
use rug::Rational;

/// Variables 0 to 3 are x, 4 to 7 are y.
const NAMES: [&str; 9] = ["x0", "x1", "x2", "x3", "y0", "y1", "y2", "y3", "k"];
/// The variable of the polynomial.
const QUOTIENT: usize = 8;

/// The derivation of one set of legs.
pub(super) fn derive(geometry: &Platform<Number>, case: &Case) -> Result<Derivation> {
    let missing = || Error::Invalid("a case of a platform without legs".to_owned());
    let squares = case.legs_squared.as_ref().ok_or_else(missing)?;
    let squares = squares.each_ref().map(|square| square.rational().clone());
    let platform: Platform<Rational> = platform_over(geometry).ok_or_else(missing)?;
    let degree = platform_degree(&platform, &squares);
    let isolated = !matches!(degree, Some(PlatformDegree::Infinite | PlatformDegree::Finite { poses: 0, .. }));
    let simple = || platform_polynomial(&platform, &squares);
    let found = if isolated { simple().or_else(|| multiple_platform_polynomial(&platform, &squares)) } else { None };
    let mut steps = vec![
        "A pose is x, the quaternion of the rotation, and y = p x with the position p: with a, b the points of a leg of length \
         L, w = y + x b - a x is the leg times x, w.w = L^2 x.x for each of six legs, and x.y = 0 (Study)."
            .to_owned(),
        "Linear in u = (x.x) (p.p, p, R^T p), the legs are K u = c(x) with a constant 6 x 7 matrix K and quadratic forms c; a \
         graded border basis of the ideal, modulo primes, has blocks of 27 x 31 at most and a quotient algebra of dimension 40 \
         at most."
            .to_owned(),
    ];
    let (mut polynomial, mut without, mut definition) = (None, None, None);
    if let Some(found) = found {
        steps.push(format!(
            "Multiplication by k = {} in the quotient algebra, without the components with x.x = 0, is a matrix of size {}; its \
             characteristic polynomial from {} primes is the closure polynomial. One more prime agrees in all coefficients: no \
             proof, but a probability of error below 2^-40.",
            words(&found.coordinate),
            found.coefficients.len() - 1,
            found.primes
        ));
        let analysed = ClosurePolynomial::of(QUOTIENT, found.coefficients, Meaning::Plain)?;
        if analysed.as_ref().is_some_and(|polynomial| polynomial.distinct() < polynomial.degree()) {
            steps.push(
                "Multiple roots are poses that coincide, or different ones of the same rotation: k tells those not apart."
                    .to_owned(),
            );
        }
        definition = Some(super::equation::primitive(&quotient(&found.coordinate)));
        polynomial = analysed;
    } else {
        without = Some(match degree {
            Some(PlatformDegree::Infinite) => "the poses are not isolated: a self-motion, real or complex".to_owned(),
            Some(PlatformDegree::Finite { poses: 0, .. }) => "no pose, real or complex".to_owned(),
            Some(PlatformDegree::Finite { poses, .. }) => {
                format!("{poses} poses with multiplicity, but no coordinate in which they have a polynomial")
            }
            None => "the number of poses is not known".to_owned(),
        });
    }
    Ok(Derivation {
        names: Names::given(NAMES)?,
        equations: equations(&platform, &squares),
        steps,
        polynomial,
        without,
        per_root: 1,
        definition,
        warnings: Vec::new(),
    })
}

fn equations(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Vec<Equation> {
    let x: [Polynomial<Rational>; 4] = std::array::from_fn(Polynomial::variable);
    let y: [Polynomial<Rational>; 4] = std::array::from_fn(|k| Polynomial::variable(4 + k));
    let times = |unknown: &Polynomial<Rational>, constant: &Rational| unknown.scale(constant);
    let both = |name: String, polynomial: &Polynomial<Rational>| {
        let listed = Equation::listed(name, polynomial);
        Equation { algebraic: Some(listed.polynomial.clone()), ..listed }
    };
    let legs = (0..6).map(|i| {
        let leg = Leg::new(&platform.base[i], &platform.plate[i], squares[i].clone());
        both(format!("leg {} w.w - L^2 x.x", i + 1), &leg.quadric(&x, &y, times))
    });
    legs.chain([both("Study x.y".to_owned(), &scalar(&x, &y))]).collect()
}

/// `k z_0 - weights.(z_1, z_2, z_3)` with `z = turn^-1 x`, times a number.
fn quotient(coordinate: &Coordinate) -> Polynomial<Rational> {
    let [w, i, j, k] = coordinate.turn.map(Polynomial::<Rational>::from_integer);
    let [x0, x1, x2, x3]: [Polynomial<Rational>; 4] = std::array::from_fn(Polynomial::variable);
    let turn = Quaternion { scalar: w, vector: [i, j, k] };
    let z = turn.conjugate().mul(&Quaternion { scalar: x0, vector: [x1, x2, x3] });
    let weighted = z.vector.iter().zip(coordinate.weights);
    let weighted = weighted.fold(Polynomial::zero(), |sum, (z, w)| sum.add(&z.mul(&Polynomial::from_integer(w))));
    Polynomial::variable(QUOTIENT).mul(&z.scalar).sub(&weighted)
}

/// The quotient in words: `(x1 - 2 x2 + 3 x3)/x0`.
fn words(coordinate: &Coordinate) -> String {
    let plain = coordinate.turn == [1, 0, 0, 0];
    let letter = if plain { 'x' } else { 'z' };
    let mut sum = String::new();
    for (index, weight) in (1..).zip(coordinate.weights).filter(|(_, weight)| *weight != 0) {
        let sign = match (sum.is_empty(), weight < 0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let size = if weight.abs() == 1 { String::new() } else { format!("{} ", weight.abs()) };
        sum.push_str(&format!("{sign}{size}{letter}{index}"));
    }
    let [w, i, j, k] = coordinate.turn;
    let behind = if plain { String::new() } else { format!(" with x = ({w}, {i}, {j}, {k}) z") };
    if sum.contains(' ') { format!("({sum})/{letter}0{behind}") } else { format!("{sum}/{letter}0{behind}") }
}
