//! Platforms: the legs and the Study condition, and the polynomial of a quotient of coordinates of the rotation, or of a
//! coordinate of a point in which two legs meet.

use super::polynomial::{ClosurePolynomial, Eliminant, Meaning};
use super::pose::lift;
use super::{Derivation, Equation};
use crate::algebra::number::Number;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::catalogue::entry::Case;
use crate::closure::study::{Leg, scalar};
use crate::elimination::platform_basis::{PoseBasis, pose_basis};
use crate::elimination::platform_degree::{PlatformDegree, platform_degree};
use crate::elimination::platform_polynomial::{
    Coordinate, PlatformPolynomial, multiple_platform_polynomial, platform_polynomial,
};
use crate::elimination::triangle_platform::{Pairs, Triangle, TrianglePolynomial, triangle_polynomial};
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use crate::mechanism::platform_over;
use rug::{Integer, Rational};

/// Names of the variables: 0 to 3 are x, 4 to 7 are y, and the last ones are coordinates of a triangle's corners on circles.
const NAMES: [&str; 15] = ["x0", "x1", "x2", "x3", "y0", "y1", "y2", "y3", "k", "a1", "b1", "a2", "b2", "a3", "b3"];
/// The variable of the polynomial.
const QUOTIENT: usize = 8;
/// The first of the coordinates on circles.
const ON_CIRCLE: usize = 9;

/// The variable of the polynomial.
enum Found {
    /// A quotient of coordinates of the rotation.
    Quotient(PlatformPolynomial),
    /// A coordinate of a point in which two legs meet.
    Corner(TrianglePolynomial),
}

impl Found {
    fn of(platform: &Platform<Rational>, squares: &[Rational; 6], poses: Option<usize>) -> Option<Self> {
        let triangle = poses.and_then(|poses| triangle_polynomial(platform, squares, poses)).map(Self::Corner);
        triangle
            .or_else(|| platform_polynomial(platform, squares).map(Self::Quotient))
            .or_else(|| multiple_platform_polynomial(platform, squares).map(Self::Quotient))
    }

    fn coefficients(&self) -> &[Integer] {
        match self {
            Self::Quotient(found) => &found.coefficients,
            Self::Corner(found) => &found.coefficients,
        }
    }

    fn per_root(&self) -> usize {
        match self {
            Self::Quotient(_) => 1,
            Self::Corner(found) => found.per_root,
        }
    }

    fn step(&self) -> String {
        match self {
            Self::Quotient(found) => format!(
                "Multiplication by k = {} in the quotient algebra, without the components with x.x = 0, is a matrix of size {}; \
                 its characteristic polynomial, of which {} primes know the residues, is the closure polynomial: {}.",
                words(&found.coordinate),
                found.coefficients.len() - 1,
                found.primes,
                if found.proved {
                    "proved, since the product of the primes exceeds all that a bound of its coefficients known beforehand \
                     leaves open"
                } else {
                    "not proved, but one prime at least is more than its coefficients need, and agrees; the probability of \
                     error is below 2^-40"
                }
            ),
            Self::Corner(found) => {
                let [one, two, three] = found.pairs.legs.map(|[i, j]| format!("{} and {}", i + 1, j + 1));
                let (body, other) = if found.pairs.at_base { ("base", "plate") } else { ("plate", "base") };
                let [g, h, l] = &found.direction;
                let mirrored = if found.per_root == 2 {
                    format!(
                        "; it is even in the distance of P from the plane of the {other}, so that two poses, mirror images, \
                         belong to a root"
                    )
                } else {
                    String::new()
                };
                format!(
                    "Legs {one}, {two}, {three} meet in points of the {body}, each of which moves on a circle about the line \
                     through the other ends, P = c + a u + b v; the three sides of the triangle are bilinear in \
                     (1, a, b) of two corners. Two resultants, by the second and the third corner, leave a form of \
                     degree 8 on the circle of the first one, P; its resultant with the circle is the closure polynomial in \
                     k = ({g}, {h}, {l}).P, in the frame of the {other}{mirrored}."
                )
            }
        }
    }

    fn is_proved(&self) -> bool {
        match self {
            Self::Quotient(found) => found.proved,
            Self::Corner(_) => true,
        }
    }

    /// Returns the variable at a pose, as a fraction.
    fn fraction<R: Ring>(&self, platform: &Platform<Rational>, x: &Quaternion<R>, y: &Quaternion<R>) -> [R; 2] {
        match self {
            Self::Quotient(found) => found.coordinate.fraction(x),
            Self::Corner(found) => {
                let points = if found.pairs.at_base { &platform.base } else { &platform.plate };
                let point = points[found.pairs.legs[0][0]].each_ref();
                let point = point.map(|c| R::from_rational(c).unwrap_or_else(R::zero));
                [found.scaled_coordinate(x, y, &point), x.norm()]
            }
        }
    }
}

/// Returns `k below - above` for the variable as a fraction.
fn definition(found: &Found, platform: &Platform<Rational>) -> Polynomial<Rational> {
    let [x0, x1, x2, x3, y0, y1, y2, y3]: [Polynomial<Rational>; 8] = std::array::from_fn(Polynomial::variable);
    let (x, y) = (Quaternion { scalar: x0, vector: [x1, x2, x3] }, Quaternion { scalar: y0, vector: [y1, y2, y3] });
    let [above, below] = found.fraction(platform, &x, &y);
    Polynomial::variable(QUOTIENT).mul(&below).sub(&above)
}

/// Derives the closure polynomial of one set of legs.
pub(super) fn derive(geometry: &Platform<Number>, case: &Case) -> Result<Derivation> {
    let missing = || Error::Invalid("a case of a platform without legs".to_owned());
    let squares = case.legs_squared.as_ref().ok_or_else(missing)?;
    let squares = squares.each_ref().map(|square| square.rational().clone());
    let platform: Platform<Rational> = platform_over(geometry).ok_or_else(missing)?;
    let degree = platform_degree(&platform, &squares);
    let isolated = !matches!(degree, Some(PlatformDegree::Infinite { .. } | PlatformDegree::Finite { poses: 0, .. }));
    let poses = match degree {
        Some(PlatformDegree::Finite { poses, .. }) => Some(poses),
        Some(PlatformDegree::Infinite { .. }) | None => None,
    };
    let found = if isolated { Found::of(&platform, &squares, poses) } else { None };
    let mut steps = vec![
        "A pose is x, the quaternion of the rotation, and y = p x with the position p: with a, b the points of a leg of length \
         L, w = y + x b - a x is the leg times x, w.w = L^2 x.x for each of six legs, and x.y = 0 (Study)."
            .to_owned(),
    ];
    if !matches!(found, Some(Found::Corner(_))) {
        steps.push(
            "Linear in u = (x.x) (p.p, p, R^T p), the legs are K u = c(x) with a constant 6 x 7 matrix K and quadratic forms c; \
             a graded border basis of the ideal, modulo primes, has blocks of 27 x 31 at most and a quotient algebra of \
             dimension 40 at most."
                .to_owned(),
        );
    }
    let mut equations = equations(&platform, &squares);
    if let Some(Found::Corner(found)) = &found {
        equations.extend(triangle_equations(&platform, &squares, &found.pairs));
    }
    let (mut polynomial, mut without, mut defined, mut warnings) = (None, None, None, Vec::new());
    if let Some(found) = &found {
        steps.push(found.step());
        let eliminant = Eliminant::of(QUOTIENT, found.coefficients().to_vec(), Meaning::Plain, Vec::new());
        polynomial = eliminant.map(|eliminant| ClosurePolynomial::of(QUOTIENT, eliminant)).transpose()?;
        if let Some(polynomial) = &mut polynomial {
            if polynomial.distinct() < polynomial.degree() {
                steps.push(
                    "Multiple roots are poses that coincide, or different ones of the same rotation: k tells those not apart."
                        .to_owned(),
                );
            }
            let known = match found {
                Found::Quotient(known) => Some(known),
                Found::Corner(_) => None,
            };
            warnings = lift(&platform, &squares, known, polynomial, |x, y| found.fraction::<Rational>(&platform, x, y));
            steps.push(
                "The poses at the real roots are those of the numeric solution at which k is the root, refined with exact \
                 residuals."
                    .to_owned(),
            );
        }
        defined = Some(super::equation::primitive(&definition(found, &platform)));
    } else {
        without = Some(match degree {
            Some(PlatformDegree::Infinite { dimension }) => not_in_rings(&platform, &squares, dimension),
            Some(PlatformDegree::Finite { poses: 0, .. }) => {
                "no pose, real or complex, as counted modulo a prime; `looproot solve` proves it where it can"
                    .to_owned()
            }
            Some(PlatformDegree::Finite { poses, .. }) => format!(
                "{poses} poses with multiplicity, as counted modulo a prime, but no coordinate in which they have a polynomial"
            ),
            None => "the number of poses is not known".to_owned(),
        });
    }
    Ok(Derivation {
        names: Names::given(NAMES)?,
        equations,
        steps,
        polynomial,
        without,
        proved: found.as_ref().is_some_and(Found::is_proved),
        per_root: found.as_ref().map_or(1, Found::per_root),
        finite: true,
        definition: defined,
        warnings,
    })
}

/// Says what is known of poses of which the rings made for platforms see no finite number.
fn not_in_rings(platform: &Platform<Rational>, squares: &[Rational; 6], dimension: usize) -> String {
    match pose_basis(platform, squares) {
        Some(PoseBasis::AtMost(points)) => {
            format!(
                "{} poses with multiplicity at most, but no coordinate in which they have a polynomial",
                points.count
            )
        }
        Some(PoseBasis::InfiniteModuloPrime) => format!(
            "the poses are not isolated modulo a prime drawn at random: a self-motion of dimension {dimension}, real or complex"
        ),
        None => "it is not decided whether there are finitely many poses".to_owned(),
    }
}

/// Returns the equations of one set of legs alone, with the names of their variables.
pub(super) fn equations_of(geometry: &Platform<Number>, case: &Case) -> Result<(Names, Vec<Equation>)> {
    let missing = || Error::Invalid("a case of a platform without legs".to_owned());
    let squares = case.legs_squared.as_ref().ok_or_else(missing)?;
    let squares = squares.each_ref().map(|square| square.rational().clone());
    let platform: Platform<Rational> = platform_over(geometry).ok_or_else(missing)?;
    Ok((Names::given(NAMES)?, equations(&platform, &squares)))
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

/// Returns the circles of the corners and the sides of the triangle, in the coordinates of each corner on its circle.
fn triangle_equations(platform: &Platform<Rational>, squares: &[Rational; 6], pairs: &Pairs) -> Vec<Equation> {
    let Some(triangle) = Triangle::new(platform, squares, pairs) else { return Vec::new() };
    let corner = |n: usize| -> [Polynomial<Rational>; 3] {
        [Polynomial::one(), Polynomial::variable(ON_CIRCLE + 2 * n), Polynomial::variable(ON_CIRCLE + 2 * n + 1)]
    };
    let circles = (0..3).map(|n| {
        let [_, a, b] = corner(n);
        let circle = &triangle.circles[n];
        let form = a.mul(&a).scale(&circle.squares[0]).add(&b.mul(&b).scale(&circle.squares[1]));
        let [i, j] = pairs.legs[n].map(|leg| leg + 1);
        let name = format!("circle of corner {}, legs {i} and {j}", n + 1);
        Equation::listed(name, &form.sub(&Polynomial::constant(circle.radius_square.clone())))
    });
    let sides = [(0, 1), (1, 2), (2, 0)].into_iter().map(|(i, j)| {
        let form = triangle.side(i, j);
        let (one, two) = (corner(i), corner(j));
        let terms = (0..9).map(|k| one[k / 3].mul(&two[k % 3]).scale(&form[k / 3][k % 3]));
        let sum = terms.fold(Polynomial::zero(), |sum, term| sum.add(&term));
        Equation::listed(format!("side of corners {} and {}", i + 1, j + 1), &sum)
    });
    circles.chain(sides).collect()
}

/// Returns the quotient as text: `(x1 - 2 x2 + 3 x3)/x0`.
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
