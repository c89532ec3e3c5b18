//! One real number field for all cosines and square roots of a file.
//!
//! The field is `Q(2 cos(2 pi/n), sqrt(r_1), ..., sqrt(r_k))`, where no root lies in the field of the cosine and the roots
//! before it. It is known by one element, `2 cos(2 pi/n) + m_1 sqrt(r_1) + ...`, whose conjugates are all different, so that
//! the arithmetic of [`NumberField`] serves. The polynomial is irreducible: no element but 0 lacks an inverse.

use super::enclosure::Enclosure;
use super::number_field::{Algebraic, NumberField};
use super::ring::{Field, Ring};
use super::surd::{Closed, Surd};
use super::univariate::Univariate;
use rug::float::Constant;
use rug::{Float, Integer, Rational};
use std::collections::BTreeSet;

/// Fields of a larger degree are not set up: arithmetic in them is slow, and files of whole degrees need no larger one.
pub const MOST: usize = 48;
/// Cosines of turns with a larger common denominator lie in larger fields: phi(n) / 2 > 48 for all n above 420.
const LARGEST_ORDER: u32 = 420;
/// Bits in which the conjugates of the element are told apart.
const BITS: u32 = 512;
/// Multipliers tried for the element.
const MULTIPLIERS: i32 = 20;

/// A real number field with the cosines and square roots that generate it.
#[derive(Clone, Debug)]
pub struct RealField {
    /// Every turn is a multiple of the part `1/order` of a full one.
    order: u32,
    /// The square roots beside the cosines, by their radicands, and their values.
    roots: Vec<(Integer, Algebraic)>,
    /// `2 cos(2 pi k/order)` for k from 0 to a half turn.
    cosines: Vec<Algebraic>,
    /// That element less `2 cos(2 pi/order)`, as multiples of the square roots: multipliers and radicands.
    summands: Vec<(Integer, Integer)>,
    /// The polynomial of the element that generates the field.
    polynomial: Univariate<Rational>,
    /// All conjugates of that element; the first one is its own value.
    conjugates: Vec<Float>,
}

impl RealField {
    /// The smallest such field that holds these numbers; `None` if its degree is above [`MOST`].
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::number::{Number, Quantity, Reading};
    /// use looproot_algebra::real_field::RealField;
    /// use looproot_algebra::ring::Ring;
    ///
    /// let read = |text: &str| Number::parse(text, Quantity::Ratio, &Reading::default()).unwrap().closed().unwrap();
    /// let (a, b, c) = (read("sqrt(7)/2"), read("4*cos(40 deg) - 1"), read("sqrt(7)*cos(40 deg)"));
    /// let field = RealField::containing([&a, &b, &c]).unwrap();
    /// assert_eq!(field.degree(), 6);
    /// let [a, b, c] = [&a, &b, &c].map(|x| field.element(x).unwrap());
    /// // (sqrt(7)/2) (4 cos - 1) = 2 sqrt(7) cos - sqrt(7)/2
    /// assert!(a.mul(&b).sub(&c.add(&c)).add(&a).is_zero());
    /// ```
    #[must_use]
    pub fn containing<'a>(numbers: impl IntoIterator<Item = &'a Closed>) -> Option<Self> {
        let (mut order, mut radicands) = (Integer::from(1), BTreeSet::new());
        for number in numbers {
            for (turn, radicand, _) in number.numerator.terms().chain(number.denominator.terms()) {
                order.lcm_mut(turn.denom());
                radicands.insert(radicand.clone());
            }
        }
        let order = order.to_u32().filter(|order| *order <= LARGEST_ORDER)?;
        let mut adjoined: Vec<Integer> = Vec::new();
        for radicand in radicands {
            if relation(order, &adjoined, &radicand).is_none() {
                adjoined.push(radicand);
            }
            if degree_of_cosine(order) << adjoined.len() > MOST {
                return None;
            }
        }
        Self::of(order, &adjoined)
    }

    /// The field of these generators, which are independent.
    fn of(order: u32, adjoined: &[Integer]) -> Option<Self> {
        let mut conjugates = conjugate_cosines(order);
        let mut polynomial = cosine_polynomial(order);
        // The polynomials in front of each root, as A + sqrt(r) B, and the multipliers.
        let mut steps: Vec<([Univariate<Rational>; 2], Rational)> = Vec::new();
        for radicand in adjoined {
            let root = Float::with_val(BITS, radicand).sqrt();
            let extended = |multiplier: i32| -> Vec<Float> {
                let shift = Float::with_val(BITS, &root * multiplier);
                conjugates
                    .iter()
                    .flat_map(|x| [Float::with_val(BITS, x + &shift), Float::with_val(BITS, x - &shift)])
                    .collect()
            };
            let multiplier = (1..=MULTIPLIERS).find(|m| least_distance(&extended(*m)) > 1e-20)?;
            conjugates = extended(multiplier);
            let square = Rational::from(radicand) * Integer::from(multiplier * multiplier);
            let [a, b] = shifted(&polynomial, &square);
            polynomial = a.mul(&a).sub(&b.mul(&b).scale(&square));
            steps.push(([a, b], Rational::from(multiplier)));
        }
        let field = (polynomial.degree() > Some(1)).then(|| NumberField::new(&polynomial));
        let mut element = match &field {
            Some(field) => field.root(),
            None => Algebraic::from_rational(&-polynomial.coefficients().first()?.clone())?,
        };
        let mut roots = Vec::new();
        for (([a, b], multiplier), radicand) in steps.iter().zip(adjoined).rev() {
            // The element less m sqrt(r) is a root of the polynomial before: A + m sqrt(r) B = 0.
            let [a, b] = [a, b].map(|p| evaluated(p, &element));
            let shift = a.mul(&b.inverse()?).neg();
            element = element.sub(&shift);
            roots.push((
                radicand.clone(),
                shift.mul(&Algebraic::from_rational(&Rational::from(multiplier.recip_ref()))?),
            ));
        }
        roots.reverse();
        let summand =
            |((_, multiplier), radicand): (&(_, Rational), &Integer)| (multiplier.numer().clone(), radicand.clone());
        let summands = steps.iter().zip(adjoined).map(summand).collect();
        let mut cosines = vec![Algebraic::from_integer(2), element.clone()];
        for k in 2..=order as usize / 2 {
            let next = cosines[k - 1].mul(&element).sub(&cosines[k - 2]);
            cosines.push(next);
        }
        Some(Self { order, roots, cosines, summands, polynomial, conjugates })
    }

    /// The degree over the rationals.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.polynomial.degree().unwrap_or(1)
    }

    /// Every turn in the field is a multiple of this part of a full one.
    #[must_use]
    pub fn order(&self) -> u32 {
        self.order
    }

    /// The polynomial of the element that generates the field, irreducible.
    #[must_use]
    pub fn polynomial(&self) -> &Univariate<Rational> {
        &self.polynomial
    }

    /// The multipliers and radicands in the element that generates the field, `2 cos(2 pi/order) + m_1 sqrt(r_1) + ...`.
    #[must_use]
    pub fn summands(&self) -> &[(Integer, Integer)] {
        &self.summands
    }

    /// The value of the element that generates the field, enclosed.
    #[must_use]
    pub fn enclosed(&self) -> Option<Enclosure> {
        let turn = Enclosure::pi().scaled(&Rational::from((2, self.order)));
        let start = turn.cos_sin_of().0.scaled(&Rational::from(2));
        self.summands.iter().try_fold(start, |sum, (multiplier, radicand)| {
            let root = Enclosure::of(&Rational::from(radicand)).sqrt()?;
            Some(sum.add(&root.scaled(&Rational::from(multiplier))))
        })
    }

    /// The multiples of the part `1/order` of a turn whose cosines are the conjugates of that of the part itself, 1 first.
    pub fn units(&self) -> impl Iterator<Item = u32> {
        units(self.order.max(2))
    }

    /// The conjugates of that element, its own value first, in many bits: all real and different.
    #[must_use]
    pub fn conjugates(&self) -> &[Float] {
        &self.conjugates
    }

    /// An element of the field in closed form, unless that is too long.
    #[must_use]
    pub fn closed(&self, number: &Algebraic) -> Option<Closed> {
        let mut generator = Closed::from(Surd::cosine(&Rational::from((1, self.order)))).mul(&Closed::from_small(2))?;
        for (multiplier, radicand) in &self.summands {
            let root = Closed::from(Surd::square_root(&Rational::from(radicand))?);
            generator = generator.add(&root.mul(&Closed::rational(Rational::from(multiplier)))?)?;
        }
        let horner = |value: Closed, c: &Rational| value.mul(&generator)?.add(&Closed::rational(c.clone()));
        number.coefficients().iter().rev().try_fold(Closed::from_small(0), horner)
    }

    /// A number as an element of the field; `None` if it lies in another one, or is a quotient by 0.
    #[must_use]
    pub fn element(&self, number: &Closed) -> Option<Algebraic> {
        let numerator = self.sum(&number.numerator)?;
        if number.denominator == Surd::rational(Rational::from(1)) {
            return Some(numerator);
        }
        Some(numerator.mul(&self.sum(&number.denominator)?.inverse()?))
    }

    fn sum(&self, sum: &Surd) -> Option<Algebraic> {
        let mut total = Algebraic::zero();
        for (turn, radicand, factor) in sum.terms() {
            let k = Rational::from(turn * self.order);
            let cosine = k.is_integer().then(|| self.cosine(k.numer()))??;
            let term =
                cosine.mul(&self.square_root(radicand)?).mul(&Algebraic::from_rational(&Rational::from(factor / 2))?);
            total = total.add(&term);
        }
        Some(total)
    }

    /// `2 cos(2 pi k/order)`.
    fn cosine(&self, k: &Integer) -> Option<Algebraic> {
        let k = k.mod_u(self.order) as usize;
        self.cosines.get(k.min(self.order as usize - k)).cloned()
    }

    fn square_root(&self, radicand: &Integer) -> Option<Algebraic> {
        if *radicand == 1 {
            return Some(Algebraic::one());
        }
        let known: Vec<Integer> = self.roots.iter().map(|(r, _)| r.clone()).collect();
        let (chosen, discriminant) = relation(self.order, &known, radicand)?;
        // sqrt(radicand) times the chosen roots is a rational multiple of the square root of the discriminant.
        let mut root = if discriminant == 1 { Algebraic::one() } else { self.gauss_sum(discriminant)? };
        let mut product = Rational::from(radicand) / discriminant;
        for k in chosen {
            let (r, value) = &self.roots[k];
            product *= r;
            root = root.mul(value).mul(&Algebraic::from_rational(&Rational::from((1, r)))?);
        }
        let factor = super::half_tangent::square_root(&product)?;
        Some(root.mul(&Algebraic::from_rational(&factor)?))
    }

    /// The square root of a positive fundamental discriminant f that divides the order: the sum of `(f/a) cos(2 pi a/f)`.
    fn gauss_sum(&self, f: u32) -> Option<Algebraic> {
        let mut sum = Algebraic::zero();
        for a in 1..f {
            let cosine = self.cosine(&Integer::from(a * (self.order / f)))?;
            match Integer::from(f).kronecker(&Integer::from(a)) {
                1 => sum = sum.add(&cosine),
                -1 => sum = sum.sub(&cosine),
                _ => {}
            }
        }
        Some(sum.mul(&Algebraic::from_rational(&Rational::from((1, 2)))?))
    }
}

/// Which of the known radicands make with this one the product of a square and a positive discriminant of a quadratic field that
/// divides the order (or 1); `None` if its root lies outside their field.
fn relation(order: u32, known: &[Integer], radicand: &Integer) -> Option<(Vec<usize>, u32)> {
    (0..1_usize << known.len()).find_map(|mask| {
        let chosen: Vec<usize> = (0..known.len()).filter(|k| mask >> k & 1 == 1).collect();
        let product = chosen.iter().fold(radicand.clone(), |product, k| product * &known[*k]);
        discriminant(order, product).map(|found| (chosen, found))
    })
}

/// The discriminant of the field of the square root of a positive integer, if it divides the order; 1 for a square.
fn discriminant(order: u32, mut n: Integer) -> Option<u32> {
    // Primes that do not divide the order have to occur in squares.
    let mut part = 1_u32;
    for p in 2..=order {
        if order.is_multiple_of(p) && (2..p).all(|q| !p.is_multiple_of(q)) {
            let prime = Integer::from(p);
            let power = n.remove_factor_mut(&prime);
            if power % 2 == 1 {
                part *= p;
            }
        }
    }
    if !n.is_perfect_square() {
        return None;
    }
    let discriminant = if part % 4 == 1 { part } else { 4 * part };
    order.is_multiple_of(discriminant).then_some(discriminant)
}

/// The degree of `cos(2 pi/order)`.
fn degree_of_cosine(order: u32) -> usize {
    units(order).count().max(1)
}

/// The residues that stand for the conjugates of `cos(2 pi/order)`, 1 first.
fn units(order: u32) -> impl Iterator<Item = u32> {
    (1..=order / 2).filter(move |k| Integer::from(*k).gcd_u(order) == 1)
}

fn conjugate_cosines(order: u32) -> Vec<Float> {
    let turn = Float::with_val(BITS, Constant::Pi) * 2_u32 / order;
    let cosine = |k: u32| Float::with_val(BITS, &turn * k).cos() * 2_u32;
    if order <= 2 { vec![cosine(1)] } else { units(order).map(cosine).collect() }
}

/// The least distance of two of these numbers, infinite for one alone.
fn least_distance(numbers: &[Float]) -> Float {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(Float::total_cmp);
    let distances = sorted.windows(2).map(|pair| Float::with_val(BITS, &pair[1] - &pair[0]));
    distances.min_by(Float::total_cmp).unwrap_or_else(|| Float::with_val(BITS, f64::INFINITY))
}

/// The minimal polynomial of `2 cos(2 pi/n)`.
fn cosine_polynomial(n: u32) -> Univariate<Rational> {
    let linear = |root: i32| Univariate::new(vec![Rational::from(-root), Rational::from(1)]);
    match n {
        1 => return linear(2),
        2 => return linear(-2),
        _ => {}
    }
    // The cyclotomic polynomial: z^n - 1 without those of the proper divisors.
    let power = |d: u32| {
        let mut coefficients = vec![Rational::new(); d as usize + 1];
        (coefficients[0], coefficients[d as usize]) = (Rational::from(-1), Rational::from(1));
        Univariate::new(coefficients)
    };
    let mut cyclotomic: Vec<(u32, Univariate<Rational>)> = Vec::new();
    for d in (1..=n).filter(|d| n.is_multiple_of(*d)) {
        let known = cyclotomic.iter().filter(|(e, _)| d.is_multiple_of(*e));
        let own = known.fold(power(d), |rest, (_, factor)| rest.div_rem(factor).0);
        cyclotomic.push((d, own));
    }
    let own = cyclotomic.pop().map_or_else(Univariate::one, |(_, own)| own);
    // It reads the same both ways: z^-m of it is a sum of z^k + z^-k, polynomials in z + 1/z.
    let middle = own.degree().unwrap_or(0) / 2;
    let mut sums = vec![Univariate::constant(Rational::from(2)), Univariate::x()];
    for k in 2..=middle {
        let next = sums[k - 1].mul(&Univariate::x()).sub(&sums[k - 2]);
        sums.push(next);
    }
    let coefficients = own.coefficients();
    let start = Univariate::constant(coefficients[middle].clone());
    (1..=middle).fold(start, |sum, k| sum.add(&sums[k].scale(&coefficients[middle + k])))
}

/// A and B of `f(x - y) = A(x) + y B(x)`, where y is a square root of `square`.
fn shifted(f: &Univariate<Rational>, square: &Rational) -> [Univariate<Rational>; 2] {
    let mut parts = [Univariate::zero(), Univariate::zero()];
    // The derivatives over factorials, times the powers of -y.
    let (mut derivative, mut factor) = (f.clone(), Rational::from(1));
    for j in 0..=f.degree().unwrap_or(0) {
        parts[j % 2] = parts[j % 2].add(&derivative.scale(&factor));
        derivative = derivative.derivative();
        factor /= Integer::from(j + 1);
        factor = if j % 2 == 0 { -factor } else { -factor * square };
    }
    parts
}

fn evaluated(p: &Univariate<Rational>, x: &Algebraic) -> Algebraic {
    let image = |c: &Rational| Algebraic::from_rational(c);
    p.map(image).map_or_else(Algebraic::zero, |p| p.eval(x))
}
