//! The coupler curve of a four-bar on the sphere: a polynomial in the coordinates of the point, whose zeros on the sphere are the
//! curve.
//!
//! The end B of the crank satisfies three linear equations, whose coefficients are polynomials in the point P. The crank keeps
//! its angle to the ground, and the coupler the one between B and P. The other end of the coupler, a combination of B, P and
//! B x P, keeps the angle of the rocker. Cramer's rule gives B, and its length is the equation of the curve.

use super::{FourBar, axis};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, Solutions};
use crate::algebra::int::Int;
use crate::algebra::number::nearest_f64;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::sort;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::sphere::{Direction, SphereLinkage};
use crate::linkage::isotropic::middle;
use crate::mechanism::exact_loop::roots::roots;
use num_complex::Complex;
use rug::Rational;

/// Maximum number of word products for a basis of special points: about a second.
const EFFORT: u64 = 300_000_000;
/// Precision in bits of the listed special points.
const BITS: u32 = 320;

/// A special point of the curve.
#[derive(Clone, Debug)]
pub struct SpecialPoint {
    /// Its coordinates.
    pub at: [Complex<f64>; 3],
    /// Whether it is real.
    pub real: bool,
    /// Its multiplicity.
    pub multiplicity: usize,
}

/// The curve of a point of the coupler.
#[derive(Clone, Debug)]
pub struct SphereCurve {
    /// The four-bar.
    pub four_bar: FourBar,
    /// The polynomial in x, y and z of the ground whose zeros on the sphere are the curve.
    pub polynomial: Polynomial<Int>,
    /// The square of the radius of the sphere, which is the squared length of the point.
    pub square: Rational,
    /// A quadric on which all double points of the curve lie.
    pub locus: Polynomial<Int>,
    /// The double points; `None` if their equations are too much work or have a curve of solutions.
    pub double_points: Option<Vec<SpecialPoint>>,
    /// The cusps, under the same conditions.
    pub cusps: Option<Vec<SpecialPoint>>,
    /// Normals of planes through the centre in which the curve is its own mirror image. The plane of the joints of the ground and
    /// the one between them are tried.
    pub mirrors: Vec<Direction>,
    /// The curve in the plane, projected from (0, 0, -1) times the radius on the plane through the centre, in u and v in units of
    /// the radius; `None` if the radius is irrational.
    pub stereographic: Option<Polynomial<Int>>,
}

impl SphereCurve {
    /// Returns the degree of the curve in space: the number of intersections with a general plane.
    #[must_use]
    pub fn degree(&self) -> u64 {
        2 * self.polynomial.total_degree().unwrap_or(0)
    }
}

/// The numbers of a four-bar: a, d are the joints of the ground, b, c, p those of the coupler and the point.
struct Numbers {
    a: Direction,
    d: Direction,
    b: Direction,
    p: Direction,
    /// a.B and d.C, which crank and rocker keep constant.
    kept: [Rational; 2],
    /// C as a combination of B, P and B x P.
    alpha: Rational,
    beta: Rational,
    gamma: Rational,
}

/// The equations of B for a point P: rows and right sides.
struct Linear<R> {
    rows: [Vector<R>; 3],
    right: [R; 3],
}

fn number<R: Ring>(q: &Rational) -> R {
    R::from_rational(q).unwrap_or_else(R::zero)
}

fn vector<R: Ring>(v: &Direction) -> Vector<R> {
    v.each_ref().map(number)
}

fn times<R: Ring>(v: &Vector<R>, q: &Rational) -> Vector<R> {
    let q: R = number(q);
    v.each_ref().map(|c| c.mul(&q))
}

fn sum<R: Ring>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|k| a[k].add(&b[k]))
}

impl Numbers {
    fn of(linkage: &SphereLinkage, four: &FourBar, point: &Direction) -> Result<Self> {
        let [ground, crank, coupler, rocker] = four.bodies;
        let [first, second, third, fourth] = four.joints;
        let (b, c) = (axis(linkage, second, coupler), axis(linkage, third, coupler));
        let normal = cross(b, point);
        let square = dot(&normal, &normal);
        if square == 0 {
            return Err(Error::Invalid(
                "found a point on the axis of crank and coupler, whose curve is a circle; expected another".to_owned(),
            ));
        }
        let part = |v: &Direction| Rational::from(&dot(c, v) / &square);
        let kept = [
            dot(axis(linkage, first, crank), axis(linkage, second, crank)),
            dot(axis(linkage, fourth, rocker), axis(linkage, third, rocker)),
        ];
        Ok(Self {
            a: axis(linkage, first, ground).clone(),
            d: axis(linkage, fourth, ground).clone(),
            b: b.clone(),
            p: point.clone(),
            kept,
            alpha: part(&cross(point, &normal)),
            beta: part(&cross(&normal, b)),
            gamma: part(&normal),
        })
    }

    /// Returns the equation `(alpha d + gamma P x d) . B = kept - beta d.P` and the two simple rows.
    fn linear<R: Ring>(&self, p: &Vector<R>) -> Linear<R> {
        let (a, d): (Vector<R>, Vector<R>) = (vector(&self.a), vector(&self.d));
        let row = sum(&times(&d, &self.alpha), &times(&cross(p, &d), &self.gamma));
        let beta: R = number(&self.beta);
        let right = [
            number(&self.kept[0]),
            number(&dot(&self.b, &self.p)),
            number::<R>(&self.kept[1]).sub(&beta.mul(&dot(&d, p))),
        ];
        Linear { rows: [a, p.clone(), row], right }
    }

    /// Returns C for B and P.
    fn other_end<R: Ring>(&self, b: &Vector<R>, p: &Vector<R>) -> Vector<R> {
        sum(&sum(&times(b, &self.alpha), &times(p, &self.beta)), &times(&cross(b, p), &self.gamma))
    }
}

impl<R: Ring> Linear<R> {
    /// Returns numerators and denominator of Cramer's rule.
    fn cramer(&self) -> (Vector<R>, R) {
        let [u, v, w] = &self.rows;
        let scaled = |x: &Vector<R>, q: &R| -> Vector<R> { x.each_ref().map(|c| c.mul(q)) };
        let [f, g, h] = &self.right;
        let parts = [scaled(&cross(v, w), f), scaled(&cross(w, u), g), scaled(&cross(u, v), h)];
        (sum(&sum(&parts[0], &parts[1]), &parts[2]), dot(u, &cross(v, w)))
    }
}

/// Returns the curve of a point of a coupler.
///
/// # Errors
/// For a body that is no coupler of a four-bar, a point on the axis of the crank's end, and a curve that is the whole sphere.
pub fn sphere_trace(linkage: &SphereLinkage, body: usize, point: &Direction) -> Result<SphereCurve> {
    let four_bar = FourBar::around(linkage, body)?;
    let numbers = Numbers::of(linkage, &four_bar, point)?;
    let p: Vector<Polynomial<Rational>> = std::array::from_fn(Polynomial::variable);
    let (numerators, denominator) = numbers.linear(&p).cramer();
    let length: Polynomial<Rational> = number(&dot(&numbers.b, &numbers.b));
    let whole = dot(&numerators, &numerators).sub(&length.mul(&denominator).mul(&denominator));
    let square = dot(point, point);
    let reduced = on_sphere(&whole.primitive().0, &square);
    if reduced.is_zero() {
        return Err(Error::Unsupported("a curve of a point that fills the sphere".to_owned()));
    }
    let polynomial = reduced.square_free_part();
    let locus = on_sphere(&denominator.primitive().0, &square);
    let normal =
        [cross(&numbers.a, &numbers.d), std::array::from_fn(|k| Rational::from(&numbers.a[k] - &numbers.d[k]))];
    let lengths = [dot(&numbers.a, &numbers.a), dot(&numbers.d, &numbers.d)];
    let mirrors = normal.into_iter().enumerate().filter(|(k, n)| {
        (*k == 0 || lengths[0] == lengths[1]) && n.iter().any(|c| *c != 0) && is_mirror(&polynomial, n, &square)
    });
    Ok(SphereCurve {
        four_bar,
        mirrors: mirrors.map(|(_, n)| n).collect(),
        stereographic: stereographic(&polynomial, &square),
        double_points: double_points(&numbers, &square),
        cusps: cusps(&numbers, &square),
        polynomial,
        square,
        locus,
    })
}

fn sphere(square: &Rational) -> Polynomial<Rational> {
    let p: Vector<Polynomial<Rational>> = std::array::from_fn(Polynomial::variable);
    dot(&p, &p).sub(&number(square))
}

/// Returns the terms of the highest degree.
fn highest(polynomial: &Polynomial<Int>) -> Polynomial<Int> {
    let degree = polynomial.total_degree().unwrap_or(0);
    let size = |exponents: &[u32]| exponents.iter().map(|e| u64::from(*e)).sum::<u64>();
    Polynomial::from_terms(polynomial.terms().filter(|(e, _)| size(e) == degree).map(|(e, c)| (e, c.clone())))
}

/// Returns the polynomial of least degree with the same zeros on the sphere, by reducing highest terms x^2 + y^2 + z^2.
fn on_sphere(polynomial: &Polynomial<Int>, square: &Rational) -> Polynomial<Int> {
    let mut polynomial = polynomial.clone();
    let p: Vector<Polynomial<Int>> = std::array::from_fn(Polynomial::variable);
    let form = dot(&p, &p);
    while !polynomial.is_zero() && polynomial.total_degree() > Some(1) {
        let top = highest(&polynomial);
        let Some(quotient) = top.checked_div_exact(&form) else { break };
        // n (P - T) + m Q with T = Q (x^2 + y^2 + z^2), which is Q m/n on the sphere.
        let [n, m] = [square.denom(), square.numer()].map(|n| Polynomial::constant(Int::from(n.clone())));
        polynomial = n.mul(&polynomial.sub(&top)).add(&m.mul(&quotient));
        if !polynomial.is_zero() {
            polynomial = polynomial.primitive_part();
        }
    }
    polynomial
}

/// Returns whether the curve is its mirror image in the plane with this normal through the centre.
fn is_mirror(polynomial: &Polynomial<Int>, normal: &Direction, square: &Rational) -> bool {
    let Some(exact) = polynomial.map(|c| Some(Rational::from(c.to_integer()))) else { return false };
    let p: Vector<Polynomial<Rational>> = std::array::from_fn(Polynomial::variable);
    let twice = Rational::from(2) / dot(normal, normal);
    let along = dot(&vector(normal), &p);
    let image: Vec<(usize, Polynomial<Rational>)> =
        (0..3).map(|k| (k, p[k].sub(&along.mul(&number(&Rational::from(&twice * &normal[k])))))).collect();
    let mirrored = exact.substitute_all(&image);
    // They are equal up to a factor and a multiple of the sphere's equation, which then divides the difference.
    let same = |sign: i32| {
        let other = mirrored.mul(&number(&Rational::from(sign)));
        let difference = exact.sub(&other);
        difference.is_zero() || difference.primitive().0.checked_div_exact(&sphere(square).primitive().0).is_some()
    };
    same(1) || same(-1)
}

/// Returns the curve projected from the south pole on the plane z = 0, in units of the radius.
fn stereographic(polynomial: &Polynomial<Int>, square: &Rational) -> Option<Polynomial<Int>> {
    let root = looproot_calculus::unit::Root::sqrt(square)?;
    let degree = u32::try_from(polynomial.total_degree()?).ok()?;
    let [u, v] = [0, 1].map(Polynomial::<Rational>::variable);
    let squares = u.mul(&u).add(&v.mul(&v));
    let one = Polynomial::<Rational>::one();
    let bottom = one.add(&squares);
    let radius: Polynomial<Rational> = number(&root);
    let coordinates = [u.add(&u).mul(&radius), v.add(&v).mul(&radius), one.sub(&squares).mul(&radius)];
    let mut image = Polynomial::<Rational>::zero();
    for (exponents, c) in polynomial.terms() {
        let mut term: Polynomial<Rational> = number(&Rational::from(c.to_integer()));
        let mut rest = degree;
        for (coordinate, e) in coordinates.iter().zip(&exponents) {
            term = term.mul(&coordinate.pow(*e));
            rest -= e;
        }
        image = image.add(&term.mul(&bottom.pow(rest)));
    }
    (!image.is_zero()).then(|| image.primitive().0)
}

/// Returns the points at which the three equations of B are dependent, so that B has two positions.
fn double_points(numbers: &Numbers, square: &Rational) -> Option<Vec<SpecialPoint>> {
    let p: Vector<Equation> = std::array::from_fn(Equation::variable);
    let (numerators, denominator) = numbers.linear(&p).cramer();
    let [x, y, z] = numerators;
    special(3, &[x, y, z, denominator, dot(&p, &p).sub(&number(square))])
}

/// Returns the points of the curve that are the pole of the coupler: in the planes of crank and of rocker.
fn cusps(numbers: &Numbers, square: &Rational) -> Option<Vec<SpecialPoint>> {
    let p: Vector<Equation> = std::array::from_fn(Equation::variable);
    let b: Vector<Equation> = std::array::from_fn(|k| Equation::variable(3 + k));
    let linear = numbers.linear(&p);
    let mut equations: Vec<Equation> =
        linear.rows.iter().zip(&linear.right).map(|(row, right)| dot(row, &b).sub(right)).collect();
    equations.push(dot(&p, &p).sub(&number(square)));
    equations.push(dot(&b, &b).sub(&number(&dot(&numbers.b, &numbers.b))));
    equations.push(dot(&p, &cross(&vector(&numbers.a), &b)));
    equations.push(dot(&p, &cross(&vector(&numbers.d), &numbers.other_end(&b, &p))));
    special(6, &equations)
}

/// Returns all points of a finite set of solutions, by their first three coordinates.
fn special(unknowns: usize, equations: &[Equation]) -> Option<Vec<SpecialPoint>> {
    let basis = Basis::of(unknowns, equations, EFFORT)?;
    match basis.dimension() {
        None => return Some(Vec::new()),
        Some(0) => {}
        Some(_) => return None,
    }
    let solutions = Solutions::of(FiniteRing::of(&basis)?, unknowns)?;
    let quotients = (0..3).map(|k| solutions.quotient(&Equation::variable(k))).collect::<Option<Vec<_>>>()?;
    let mut list = Vec::new();
    for part in &solutions.parts {
        for root in roots(&part.polynomial)? {
            let ball = root.ball(BITS)?;
            let mut at = [Complex::new(0.0, 0.0); 3];
            for (own, [numerator, denominator]) in at.iter_mut().zip(&quotients) {
                let value: Disc = ball.evaluate(denominator.coefficients()).inverse()?;
                *own = middle(&ball.evaluate(numerator.coefficients()).mul(&value));
            }
            list.push(SpecialPoint { at, real: root.is_real(), multiplicity: part.multiplicity });
        }
    }
    sort::by(&mut list, |a, b| {
        let key = |point: &SpecialPoint| point.at.map(|z| z.re);
        let order = key(a).into_iter().zip(key(b)).map(|(x, y)| x.total_cmp(&y)).find(|order| order.is_ne());
        b.real.cmp(&a.real).then(order.unwrap_or(std::cmp::Ordering::Equal))
    });
    Some(list)
}

/// Returns the spherical distances of a four-bar in degrees: crank, coupler, rocker, ground.
#[must_use]
pub fn sides(linkage: &SphereLinkage, four: &FourBar) -> [f64; 4] {
    let angle = |body: usize, one: usize, two: usize| {
        let (u, v) = (axis(linkage, one, body), axis(linkage, two, body));
        let (cosine, normal) = (nearest_f64(&dot(u, v)), cross(u, v));
        nearest_f64(&dot(&normal, &normal)).sqrt().atan2(cosine).to_degrees()
    };
    let ([ground, crank, coupler, rocker], [a, b, c, d]) = (four.bodies, four.joints);
    [angle(crank, a, b), angle(coupler, b, c), angle(rocker, c, d), angle(ground, a, d)]
}
