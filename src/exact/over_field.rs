//! Loops over a real number field: their eliminants by places modulo primes and in balls.
//!
//! Modulo a prime over which the field splits into places of degree 1 everything is computed in residues, place by place. A
//! number
//! that is not 0 at a place is not 0. Three facts are equations, and hold in the field if they hold at all places over enough
//! primes
//! ([`super::height`]): that the determinant has a lower degree, that a power of `1 + x^2` divides it, and that powers of
//! further factors do. Those factors are reconstructed from their residues; no proof rests on the reconstruction. The values of
//! the roots come from balls.

use super::eliminant::{Coefficients, DEGREE, Eliminant, WIDE, Way, in_unknown, pencil_of};
use super::ground::Ground;
use super::height::Height;
use crate::algebra::ball::Ball;
use crate::algebra::determinant::by_interpolation;
use crate::algebra::drawn;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::lift;
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::real_field::RealField;
use crate::algebra::residue_field::{Places, Residue};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rug::{Integer, Rational};
use std::cell::RefCell;

/// Largest number of determinants computed for one eliminant, at the places of all primes together: about a second.
const MOST_DETERMINANTS: usize = 8_000;
/// Numbers of primes after which a reconstruction of the factors is attempted.
const ATTEMPTS: [usize; 10] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];

type Polynomial = Univariate<Residue>;

/// A loop over a real number field.
pub struct OverField {
    field: RealField,
    closed: ClosedLoop<Algebraic>,
    /// The loop in balls, for the values of the numbers themselves.
    balls: ClosedLoop<Ball<WIDE>>,
    primes: RefCell<Primes>,
    first: Places,
    modular: ClosedLoop<Residue>,
}

/// The primes drawn so far.
struct Primes {
    random: ChaCha8Rng,
    drawn: Vec<Prime>,
}

/// A prime with the loop at all places over it.
struct Prime {
    places: Places,
    loops: Vec<ClosedLoop<Residue>>,
}

/// The shape of a determinant at a place.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Shape {
    degree: usize,
    /// The number of distinct roots other than those of `1 + x^2`.
    distinct: usize,
    /// The power of `1 + x^2`.
    circle: usize,
    /// Degrees of the factors of order 2 and above, with the order.
    multiple: Vec<(usize, usize)>,
}

impl Shape {
    /// Returns whether the shape claims nothing that would have to be proved.
    fn is_general(&self) -> bool {
        self.degree == DEGREE && self.circle == 0 && self.multiple.is_empty()
    }
}

impl Prime {
    fn draw(field: &RealField, closed: &ClosedLoop<Algebraic>, random: &mut ChaCha8Rng) -> Option<Self> {
        let places = Places::draw(field, random)?;
        let mut reduced = Vec::new();
        for motion in &closed.constants {
            reduced.push(motion.map(Residue::reduced)?);
        }
        let loops = places.generators().iter().map(|x| {
            let constants: Vec<Motion<Residue>> =
                reduced.iter().map(|motion| motion.map(|p| Some(p.eval(x)))).collect::<Option<_>>()?;
            Some(ClosedLoop { variables: closed.variables, constants: constants.try_into().ok()? })
        });
        let loops = loops.collect::<Option<_>>()?;
        Some(Self { places, loops })
    }

    /// The determinants of a way at all places; `None` where the cut is degenerate at one.
    fn determinants(&self, way: &Way) -> Option<Vec<Polynomial>> {
        self.places.enter();
        self.loops.iter().map(|closed| determinant(closed, way)).collect()
    }

    /// The polynomials in the element that generates the field with these values at the places, lists of numbers for each place; the
    /// lists end to end.
    fn interpolated(&self, lists: &[Vec<Residue>]) -> Vec<u64> {
        let length = lists.first().map_or(0, Vec::len);
        let degree = lists.len();
        let points = self.places.generators();
        let of_entry = |entry: usize| {
            let values: Vec<(Residue, Residue)> = points.iter().zip(lists).map(|(x, list)| (*x, list[entry])).collect();
            let mut coefficients = Univariate::interpolate(&values).coefficients().to_vec();
            coefficients.resize(degree, Residue::zero());
            coefficients
        };
        (0..length).flat_map(of_entry).map(Residue::value).collect()
    }

    /// Returns the coefficients of the factors of order 2 and above, by powers of the element that generates the field; `None`
    /// where the determinant has another shape at some place.
    fn multiple(&self, way: &Way, wanted: &Shape) -> Option<Vec<u64>> {
        let determinants = self.determinants(way)?;
        let list = |determinant: &Polynomial| -> Option<Vec<Residue>> {
            (shape(determinant)? == *wanted).then_some(())?;
            let (_, factors) = factors(determinant)?;
            let multiple = factors.into_iter().filter(|(_, order)| *order > 1);
            Some(multiple.flat_map(|(factor, _)| below_leading(&factor)).collect())
        };
        let lists: Vec<Vec<Residue>> = determinants.iter().map(list).collect::<Option<_>>()?;
        Some(self.interpolated(&lists))
    }
}

/// The determinant of a way at a place, in the tangent of half the unknown.
fn determinant(closed: &ClosedLoop<Residue>, way: &Way) -> Option<Polynomial> {
    let determinant = by_interpolation(&pencil_of(closed, way)?.coefficients);
    Some(Univariate::new(in_unknown(way, determinant.coefficients())))
}

/// The power of `1 + x^2` in a determinant, and the square-free factors of the rest, monic, with their orders.
fn factors(determinant: &Polynomial) -> Option<(usize, Vec<(Polynomial, usize)>)> {
    determinant.degree()?;
    let (power, rest) = determinant.remove_factor(&Polynomial::circle());
    Some((power, rest.square_free_decomposition()))
}

fn shape(determinant: &Polynomial) -> Option<Shape> {
    let (circle, factors) = factors(determinant)?;
    let degrees: Vec<(usize, usize)> = factors.iter().map(|(f, order)| (f.degree().unwrap_or(0), *order)).collect();
    Some(Shape {
        degree: determinant.degree()?,
        distinct: degrees.iter().map(|(degree, _)| degree).sum(),
        circle,
        multiple: degrees.into_iter().filter(|(_, order)| *order > 1).collect(),
    })
}

/// The proved part of a determinant.
struct Known {
    degree: usize,
    circle: usize,
    /// Monic factors that divide with these orders.
    multiple: Vec<(Vec<Algebraic>, usize)>,
}

impl OverField {
    /// A loop over a field, of which the constants are enclosed; `None` where no prime serves.
    #[must_use]
    pub fn of(field: RealField, closed: ClosedLoop<Algebraic>, enclosed: &ClosedLoop<Enclosure>) -> Option<Self> {
        let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
        let prime = Prime::draw(&field, &closed, &mut random)?;
        let (first, modular) = (prime.places.clone(), prime.loops.first()?.clone());
        let constants: Option<Vec<_>> =
            enclosed.constants.iter().map(|motion| motion.map(|x| Some(Ball::from(x)))).collect();
        let balls = ClosedLoop { variables: closed.variables, constants: constants?.try_into().ok()? };
        let primes = RefCell::new(Primes { random, drawn: vec![prime] });
        Some(Self { field, closed, balls, primes, first, modular })
    }

    /// Draws primes until there are `count`.
    fn draw(&self, count: usize) -> Option<()> {
        let mut primes = self.primes.borrow_mut();
        while primes.drawn.len() < count {
            let Primes { random, drawn } = &mut *primes;
            let next = Prime::draw(&self.field, &self.closed, random)?;
            // The same prime twice proves nothing more.
            if drawn.iter().all(|prime| prime.places.prime() != next.places.prime()) {
                drawn.push(next);
            }
        }
        Some(())
    }

    /// Returns the proved degree and factors of the determinant of a way.
    fn known(&self, way: &Way) -> Option<Known> {
        self.first.enter();
        let first = shape(&determinant(&self.modular, way)?)?;
        let general = |degree| Known { degree, circle: 0, multiple: Vec::new() };
        if first.is_general() {
            return Some(general(DEGREE));
        }
        // The best place decides; at others more vanishes by chance.
        let all = self.primes.borrow().drawn.first()?.determinants(way)?;
        let shape = all
            .iter()
            .filter_map(shape)
            .max_by(|a, b| (a.degree, a.distinct).cmp(&(b.degree, b.distinct)).then(b.circle.cmp(&a.circle)))?;
        if shape.is_general() {
            return Some(general(DEGREE));
        }
        let multiple = if shape.multiple.is_empty() { Vec::new() } else { self.multiple(way, &shape)? };
        let known = Known { degree: shape.degree, circle: shape.circle, multiple };
        self.is_proved(way, &known).then_some(known)
    }

    /// Reconstructs the factors of order 2 and above from their residues.
    fn multiple(&self, way: &Way, shape: &Shape) -> Option<Vec<(Vec<Algebraic>, usize)>> {
        let mut lists: Vec<(u64, Vec<u64>)> = Vec::new();
        let mut found: Option<Vec<Rational>> = None;
        for number in 0..*ATTEMPTS.last()? {
            if (number + 1) * self.field.degree() > MOST_DETERMINANTS {
                return None;
            }
            self.draw(number + 1)?;
            let primes = self.primes.borrow();
            let Some(residues) = primes.drawn[number].multiple(way, shape) else { continue };
            let prime = primes.drawn[number].places.prime();
            if let Some(found) = &found
                && is_reduction(found, prime, &residues)
            {
                return self.split(found, shape);
            }
            lists.push((prime, residues));
            if ATTEMPTS.contains(&lists.len()) {
                found = lift::vector(&lists);
            }
        }
        None
    }

    /// Factors from their coefficients end to end.
    fn split(&self, coefficients: &[Rational], shape: &Shape) -> Option<Vec<(Vec<Algebraic>, usize)>> {
        let field = (self.field.degree() > 1).then(|| NumberField::new(self.field.polynomial()));
        let element = |list: &[Rational]| {
            let Some(field) = &field else { return Algebraic::from_rational(&list[0]) };
            let root = field.root();
            list.iter()
                .rev()
                .try_fold(Algebraic::zero(), |sum, c| Some(sum.mul(&root).add(&Algebraic::from_rational(c)?)))
        };
        let mut elements = coefficients.chunks(self.field.degree()).map(element);
        let factor = |(degree, order): &(usize, usize)| {
            let mut own: Vec<Algebraic> = (0..*degree).map(|_| elements.next()?).collect::<Option<_>>()?;
            own.push(Algebraic::one());
            Some((own, *order))
        };
        shape.multiple.iter().map(factor).collect()
    }

    /// Whether the determinant has no higher degree and these factors: an equation between integers of the field, up to a known
    /// denominator, that holds at all places over enough primes.
    fn is_proved(&self, way: &Way, known: &Known) -> bool {
        self.primes_needed(way, known).is_some_and(|count| {
            self.draw(count).is_some() && {
                let primes = self.primes.borrow();
                primes.drawn.iter().take(count).all(|prime| holds(prime, way, known).unwrap_or(false))
            }
        })
    }

    /// Returns the number of primes that prove it; `None` if they are too many.
    fn primes_needed(&self, way: &Way, known: &Known) -> Option<usize> {
        let height = Height::of(&self.closed, &self.field);
        let mut bits = height.bits(way.cut)?;
        // A step of the division multiplies the largest coefficient by at most 1 plus the sum of the divisor's coefficients.
        let mut growth = 1.0 + known.circle as f64;
        for (factor, order) in &known.multiple {
            let (size, denominator) = height.of_polynomial(factor);
            growth += (size + denominator) * *order as f64;
        }
        let steps = (known.degree + 1).saturating_sub(known.divisor_degree());
        bits += growth * steps as f64;
        // Every prime exceeds 2^58.
        let count = (bits / 58.0).ceil();
        let is_moderate = count * self.field.degree() as f64 <= MOST_DETERMINANTS as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
        is_moderate.then_some(count as usize)
    }

    /// The coefficients of the determinant of a way in balls.
    fn in_balls(&self, way: &Way) -> Option<Coefficients> {
        let [a0, a1, a2] = pencil_of(&self.balls, way)?.coefficients;
        let value = |k: i32| {
            // Evaluation points away from the roots of special data: fractions that nobody chooses.
            let x = Ball::<WIDE>::from_rational(&Rational::from((104_729 * k + 31_337, 1 << 16)))?;
            let entry = |i: usize, j: usize| a2[i][j].mul(&x).add(&a1[i][j]).mul(&x).add(&a0[i][j]);
            let rows: Vec<Vec<Ball<WIDE>>> = (0..8).map(|i| (0..8).map(|j| entry(i, j)).collect()).collect();
            Some((x, ball_determinant(rows)?))
        };
        let points: Option<Vec<_>> = (-8..=8).map(value).collect();
        let mut coefficients = Univariate::interpolate(&points?).coefficients().to_vec();
        coefficients.resize(DEGREE + 1, Ball::zero());
        Some(in_unknown(way, &coefficients))
    }
}

impl Known {
    fn divisor_degree(&self) -> usize {
        2 * self.circle + self.multiple.iter().map(|(factor, order)| (factor.len() - 1) * order).sum::<usize>()
    }

    fn at_pi(&self) -> usize {
        DEGREE - self.degree
    }
}

fn below_leading(factor: &Polynomial) -> Vec<Residue> {
    let coefficients = factor.coefficients();
    coefficients[..coefficients.len().saturating_sub(1)].to_vec()
}

/// Returns whether rationals have these residues.
fn is_reduction(found: &[Rational], prime: u64, residues: &[u64]) -> bool {
    let value = |q: &Rational| Residue::from_rational(q).map(Residue::value);
    prime > 0 && found.iter().zip(residues).all(|(q, residue)| value(q) == Some(*residue))
}

/// Returns whether the equation holds at all places over a prime; `None` where the prime decides nothing.
fn holds(prime: &Prime, way: &Way, known: &Known) -> Option<bool> {
    let determinants = prime.determinants(way)?;
    let mut multiple = Vec::new();
    for (factor, order) in &known.multiple {
        multiple.push((factor.iter().map(Residue::reduced).collect::<Option<Vec<_>>>()?, *order));
    }
    let divides = |(determinant, x): (&Polynomial, &Residue)| {
        let mut divisor =
            (0..known.circle).fold(Univariate::one(), |product: Polynomial, _| product.mul(&Polynomial::circle()));
        for (factor, order) in &multiple {
            let own = Univariate::new(factor.iter().map(|c| c.eval(x)).collect());
            divisor = (0..*order).fold(divisor, |product, _| product.mul(&own));
        }
        determinant.degree().unwrap_or(0) <= known.degree && determinant.div_rem(&divisor).1.is_zero()
    };
    Some(determinants.iter().zip(prime.places.generators()).all(divides))
}

/// The determinant of a matrix of balls; `None` where it may be singular.
fn ball_determinant<const BITS: u32>(mut rows: Vec<Vec<Ball<BITS>>>) -> Option<Ball<BITS>> {
    let mut determinant = Ball::one();
    for k in 0..rows.len() {
        let pivot = (k..rows.len()).max_by(|&a, &b| rows[a][k].lower().total_cmp(&rows[b][k].lower()))?;
        let inverse = Field::inverse(&rows[pivot][k])?;
        determinant = determinant.mul(&rows[pivot][k]);
        if pivot != k {
            rows.swap(pivot, k);
            determinant = determinant.neg();
        }
        let above = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let factor = row[k].mul(&inverse);
            for (x, p) in row.iter_mut().zip(&above).skip(k + 1) {
                *x = x.sub(&factor.mul(p));
            }
        }
    }
    Some(determinant)
}

/// An element as a ball.
fn value(x: &Algebraic, element: &Ball<WIDE>) -> Option<Ball<WIDE>> {
    let (numerator, denominator) = x.parts();
    let image = |c: &Integer| Ball::from_rational(&Rational::from(c));
    let sum =
        numerator.iter().rev().try_fold(Ball::zero(), |sum: Ball<WIDE>, c| Some(sum.mul(element).add(&image(c)?)))?;
    sum.over(&image(denominator)?)
}

/// The quotient by a monic divisor that is known to divide.
fn quotient(dividend: &[Ball<WIDE>], divisor: &[Ball<WIDE>]) -> Coefficients {
    let mut rest = dividend.to_vec();
    let mut quotient = Vec::new();
    while rest.len() >= divisor.len() {
        let Some(top) = rest.pop() else { break };
        let shift = rest.len() + 1 - divisor.len();
        for (x, c) in rest[shift..].iter_mut().zip(divisor) {
            *x = x.sub(&top.mul(c));
        }
        quotient.push(top);
    }
    quotient.reverse();
    quotient
}

impl Ground for OverField {
    type Residue = Residue;

    fn variables(&self) -> [Variable; 6] {
        self.closed.variables
    }

    fn modular(&self) -> &ClosedLoop<Residue> {
        self.first.enter();
        &self.modular
    }

    fn constants<const BITS: u32>(&self) -> Option<Vec<Motion<Ball<BITS>>>> {
        self.balls.constants.iter().map(|motion| motion.map(|x| Some(Ball::of_precision(x)))).collect()
    }

    fn count(&self, way: &Way) -> Option<usize> {
        self.first.enter();
        let shape = shape(&determinant(&self.modular, way)?)?;
        let known = Known { degree: DEGREE, circle: shape.circle, multiple: Vec::new() };
        let is_proved = shape.circle == 0 || self.is_proved(way, &known);
        is_proved.then_some(DEGREE - 2 * shape.circle)
    }

    fn eliminant(&self, way: &Way) -> Option<Eliminant> {
        let known = self.known(way)?;
        let element = Ball::from(&self.field.enclosed()?);
        let mut rest = self.in_balls(way)?;
        rest.truncate(known.degree + 1);
        let one = || Ball::<WIDE>::one();
        for _ in 0..known.circle {
            rest = quotient(&rest, &[one(), Ball::zero(), one()]);
        }
        let mut factors = Vec::new();
        for (factor, order) in &known.multiple {
            let own: Vec<Ball<WIDE>> = factor.iter().map(|x| value(x, &element)).collect::<Option<_>>()?;
            for _ in 0..*order {
                rest = quotient(&rest, &own);
            }
            factors.push((own, *order));
        }
        factors.push((rest, 1));
        Some(Eliminant { unknown: way.unknown, factors, at_pi: known.at_pi() })
    }

    fn eliminant_by_ring(&self, _unknown: usize) -> Option<Eliminant> {
        None
    }
}
