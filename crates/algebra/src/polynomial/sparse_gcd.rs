//! Greatest common divisors of sparse polynomials modulo primes, from values at a geometric progression.
//!
//! A grading, integer weights of the variables, makes polynomials in a new variable t of them: x becomes `t^w x`. It is
//! chosen so that one polynomial has a single term of the highest grade. So have its divisors, the greatest common one
//! among them, and none but monomials is lost where the x get values: images modulo a prime are divisors in t alone,
//! made monic, and each of their coefficients is a sum of as many powers as the divisor has terms of one grade.
//!
//! # Source
//! Hu, Monagan 2016, A fast parallel sparse polynomial GCD algorithm, ISSAC (geometric progressions, substitution of
//! Kronecker, logarithms in smooth fields). The grading in the place of a main variable is what keeps leading
//! coefficients and contents out of it.

use super::Polynomial;
use super::grading::Grading;
use super::recurrence::{Random, Recurrence, SmoothField, coefficients, invert_all, roots};
use crate::int::Int;
use crate::integer_polynomial::Lifted;
use crate::minors::cells;
use crate::modp::{Modulus, primes};
use crate::residue_polynomial::{Residues, common_divisor, make_monic, trim};
use crate::ring::{Domain, Ring};
use crate::sort;
use rug::Integer;

/// What the preparation costs, in products of residues.
const PREPARATION: f64 = 2e4;
/// What one root of a recurrence costs, in products of residues for each term of the recurrence.
const ROOT: f64 = 150.0;
/// The part of the possible terms from which on a polynomial is called dense.
const DENSE: f64 = 0.25;
/// Bits of a prime that must be left over before its residues are taken for the coefficients themselves.
const SPARE_BITS: u32 = 8;
/// Bits per unit of degree by which factors may have longer coefficients than products: `log2 e` (Gelfond's bound).
const GROWTH: f64 = std::f64::consts::LOG2_E;

/// The terms of a polynomial: exponents of the variables that occur, grades, coefficients.
pub(super) struct Terms<'a> {
    /// The exponents, as many per term as there are variables.
    pub(super) exponents: Vec<u32>,
    pub(super) coefficients: &'a [Int],
    /// The degrees in the variables.
    pub(super) degrees: Vec<u32>,
}

impl<'a> Terms<'a> {
    fn new(polynomial: &'a Polynomial<Int>, support: &[usize]) -> Self {
        let mut exponents = Vec::with_capacity(polynomial.len() * support.len());
        for term in 0..polynomial.len() {
            exponents.extend(support.iter().map(|&variable| polynomial.exponent(term, variable)));
        }
        let degrees = support.iter().map(|&variable| polynomial.degree(variable)).collect();
        Self { exponents, coefficients: polynomial.coefficients(), degrees }
    }

    pub(super) fn len(&self) -> usize {
        self.coefficients.len()
    }
}

impl Polynomial<Int> {
    /// Returns the greatest common divisor of two primitive polynomials in the same variables, not divisible by any; `None`
    /// where values on a grid are expected to be cheaper, or no grading or no room for exponents is found.
    ///
    /// It divides both, which division proves. With the highest grade of one polynomial in a single term, a further factor
    /// of the common divisor would raise the degree in t of the image of all divisors.
    pub(super) fn sparse_gcd(&self, other: &Self, support: &[usize]) -> Option<Self> {
        // In two variables the grid is small, and dense polynomials mostly have dense divisors.
        if support.len() == 2 && [self, other].iter().all(|f| f.fills(support, DENSE)) {
            return None;
        }
        self.sparse_gcd_within(other, support, grid_cost)
    }

    /// Returns whether at least this part of the monomials that the degrees allow occurs.
    fn fills(&self, support: &[usize], part: f64) -> bool {
        let degrees = support.iter().map(|&variable| f64::from(self.degree(variable)));
        self.len() as f64 >= part * cells(degrees, self.total_degree().unwrap_or(0) as f64)
    }

    /// As `sparse_gcd`, where another way has this cost.
    fn sparse_gcd_within(
        &self,
        other: &Self,
        support: &[usize],
        limit: impl Fn(&Terms, &Terms) -> f64,
    ) -> Option<Self> {
        let (a, b) = (Terms::new(self, support), Terms::new(other, support));
        let limit = limit(&a, &b);
        if limit < PREPARATION {
            return None;
        }
        let grading = Grading::choose(&a, &b)?;
        let (first, second, a, b) = if grading.exchanged { (other, self, b, a) } else { (self, other, a, b) };
        // Four terms of one grade need nine images.
        if limit < PREPARATION + 8.0 * grading.image_cost {
            return None;
        }
        let search = Search { a: &a, b: &b, grading: &grading, limit };
        let divides = |candidate: &Self| {
            first.checked_div_exact(candidate).is_some() && second.checked_div_exact(candidate).is_some()
        };
        // Values may be unlucky once; twice hardly.
        (0..2).find_map(|attempt| search.run(attempt, support, &divides))
    }
}

/// Returns what interpolation on a grid costs, in products of residues: a divisor in one variable for each point.
fn grid_cost(a: &Terms, b: &Terms) -> f64 {
    let mut degrees: Vec<(f64, f64)> =
        a.degrees.iter().zip(&b.degrees).map(|(&a, &b)| (f64::from(a), f64::from(b))).collect();
    sort::by(&mut degrees, |x, y| (y.0.max(y.1)).total_cmp(&x.0.max(x.1)));
    let Some(((main_a, main_b), others)) = degrees.split_first() else { return 0.0 };
    let points: f64 = others.iter().map(|(a, b)| a.min(*b) + 1.0).product();
    points * (main_a * main_b + 4.0 * (main_a + main_b)) + (a.len() + b.len()) as f64
}

/// Two polynomials, the first of which has one term of the highest grade.
struct Search<'a> {
    a: &'a Terms<'a>,
    b: &'a Terms<'a>,
    grading: &'a Grading,
    /// The cost beyond which another way is cheaper.
    limit: f64,
}

/// The terms of a divisor: how far each is below the highest grade, and how its exponents differ from those of the term
/// there; that term is the first one.
struct Support {
    drops: Vec<u32>,
    differences: Vec<i32>,
}

/// A prime, with values for the variables at all steps of a progression.
struct Points<'a> {
    modulus: &'a Modulus,
    /// The values at the start, and the factors from step to step, of each variable.
    starts: Vec<u64>,
    factors: Vec<u64>,
}

impl Search<'_> {
    fn variables(&self) -> usize {
        self.grading.weights.len()
    }

    /// Returns how far the exponents of terms of a common divisor differ at most, by variable.
    fn reach(&self) -> Vec<u32> {
        self.a.degrees.iter().zip(&self.b.degrees).map(|(&a, &b)| a.min(b)).collect()
    }

    fn run(
        &self,
        attempt: u64,
        support: &[usize],
        divides: &dyn Fn(&Polynomial<Int>) -> bool,
    ) -> Option<Polynomial<Int>> {
        let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ (attempt << 32));
        let top = self.grading.top_term(self.a);
        let content = self.grading.top_content(self.b);
        let leading = self.a.coefficients[top].gcd(&content).to_integer();
        let field = SmoothField::new(self.exponent_bits()?, &mut random)?;
        let points = self.points(&field.modulus, field.generator, &mut random);
        let (terms, residues) = match self.first_image(&field, &points, &mut random)? {
            Image::Constant => return Some(Polynomial::one()),
            Image::Terms(terms, residues) => (terms, residues),
        };
        let mut lifted = Lifted::new(terms.drops.len());
        let scaled = |residues: &[u64], modulus: &Modulus| -> Residues {
            let factor = modulus.reduce(&leading);
            residues.iter().map(|&r| modulus.mul(r, factor)).collect()
        };
        lifted.join(&scaled(&residues, &field.modulus), &field.modulus);
        let most = self.coefficient_bits(&leading);
        let mut changed = lifted.longest() + SPARE_BITS > field.modulus.prime().ilog2();
        let mut moduli = primes().filter(|modulus| modulus.prime() != field.modulus.prime());
        loop {
            if !changed {
                let candidate = terms.polynomial(lifted.coefficients(), support).primitive_part();
                if divides(&candidate) {
                    return Some(candidate);
                }
            }
            if f64::from(lifted.bits()) > most {
                return None;
            }
            let modulus = moduli.next()?;
            let generator = random.residue(&modulus);
            let points = self.points(&modulus, generator, &mut random);
            let residues = self.next_image(&points, &terms)?;
            changed = lifted.join(&scaled(&residues, &modulus), &modulus);
        }
    }

    /// Returns the bits of the exponents after Kronecker's substitution.
    fn exponent_bits(&self) -> Option<u32> {
        let radices = self.reach().into_iter().enumerate().filter(|&(v, _)| v != self.grading.pivot);
        let count = radices.map(|(_, reach)| 2 * u64::from(reach) + 1).try_fold(1_u64, u64::checked_mul)?;
        Some(u64::BITS - count.leading_zeros())
    }

    /// Returns the exponent of each variable in Kronecker's substitution; 0 for the one that the grade determines.
    fn strides(&self) -> Vec<u64> {
        let mut stride = 1;
        let strides = self.reach().into_iter().enumerate().map(|(variable, reach)| {
            if variable == self.grading.pivot {
                return 0;
            }
            let own = stride;
            stride *= 2 * u64::from(reach) + 1;
            own
        });
        strides.collect()
    }

    fn points<'m>(&self, modulus: &'m Modulus, generator: u64, random: &mut Random) -> Points<'m> {
        let one = modulus.enter(1);
        let start = |variable| if variable == self.grading.pivot { one } else { random.residue(modulus) };
        let starts = (0..self.variables()).map(start).collect();
        let factors = self.strides().into_iter().map(|stride| modulus.pow(generator, stride)).collect();
        Points { modulus, starts, factors }
    }

    /// Returns the binary logarithm of what the coefficients of the divisor, scaled by `leading`, cannot exceed, sign included.
    fn coefficient_bits(&self, leading: &Integer) -> f64 {
        let bits = |terms: &Terms| {
            let longest = terms.coefficients.iter().map(|c| c.to_integer().significant_bits()).max().unwrap_or(0);
            let degrees: f64 = terms.degrees.iter().map(|&d| f64::from(d)).sum();
            f64::from(longest) + GROWTH * degrees
        };
        bits(self.a).min(bits(self.b)) + f64::from(leading.significant_bits()) + 2.0
    }

    /// Returns the divisor modulo the first prime; `None` for unlucky values, or where it gets too dear.
    fn first_image(&self, field: &SmoothField, points: &Points, random: &mut Random) -> Option<Image> {
        let m = &field.modulus;
        let mut samplers = [self.a, self.b].map(|terms| Sampler::new(terms, self.grading, points));
        // The highest coefficient of the first must not vanish.
        let mut image = samplers[0].divisor_with(&samplers[1], m)?;
        let degree = image.len() - 1;
        if degree == 0 {
            return Some(Image::Constant);
        }
        let mut recurrences: Vec<Recurrence> = (0..degree).map(|_| Recurrence::new(m)).collect();
        let mut count = 0.0;
        loop {
            for (recurrence, &value) in recurrences.iter_mut().zip(&image) {
                recurrence.push(value, m);
            }
            count += 1.0;
            if recurrences.iter().all(Recurrence::is_confirmed) {
                break;
            }
            // A recurrence of n terms is seen in 2n + 1 values, and finding its roots takes some n^2.
            let roots = ROOT * degree as f64 * (count / 4.0) * (count / 4.0);
            if PREPARATION + count * self.grading.image_cost + roots > self.limit {
                return None;
            }
            for sampler in &mut samplers {
                sampler.advance(m);
            }
            image = samplers[0].divisor_with(&samplers[1], m)?;
            if image.len() != degree + 1 {
                return None;
            }
        }
        // With none of the lowest grade the degree of the image would be that of no divisor.
        if recurrences[0].terms() == 0 {
            return None;
        }
        let (mut support, mut residues) = (Support::top(self.variables()), vec![m.enter(1)]);
        for (k, recurrence) in recurrences.iter().enumerate().filter(|(_, recurrence)| recurrence.terms() > 0) {
            let found = roots(recurrence.characteristic()?, m, random)?;
            residues.extend(coefficients(&found, recurrence.values(), m)?);
            let drop = u32::try_from(degree - k).ok()?;
            for logarithm in field.logarithms(&found)? {
                support.drops.push(drop);
                self.push_differences(logarithm, drop, field.order(), &mut support.differences)?;
            }
        }
        points.divide_by_starts(&mut residues, &support.differences);
        Some(Image::Terms(support, residues))
    }

    /// Appends the differences of exponents that Kronecker's substitution and the grade tell; `None` if there are none.
    fn push_differences(&self, logarithm: u64, drop: u32, order: u64, differences: &mut Vec<i32>) -> Option<()> {
        let (reach, strides, pivot) = (self.reach(), self.strides(), self.grading.pivot);
        // With the reach added in each digit, none is negative.
        let offset = reach.iter().zip(&strides).fold(0, |sum, (&reach, stride)| sum + u64::from(reach) * stride);
        let mut rest = (logarithm + offset) % order;
        let (first, mut grade) = (differences.len(), -i64::from(drop));
        for (variable, &reach) in reach.iter().enumerate() {
            if variable == pivot {
                differences.push(0);
                continue;
            }
            let radix = 2 * u64::from(reach) + 1;
            let difference = i32::try_from(rest % radix).ok()? - i32::try_from(reach).ok()?;
            rest /= radix;
            grade -= i64::from(difference) * i64::from(self.grading.weights[variable]);
            differences.push(difference);
        }
        let weight = i64::from(self.grading.weights[pivot]);
        let own = i32::try_from(grade / weight).ok()?;
        differences[first + pivot] = own;
        (rest == 0 && grade % weight == 0 && own.unsigned_abs() <= reach[pivot]).then_some(())
    }

    /// Returns the coefficients modulo a further prime, for known terms.
    fn next_image(&self, points: &Points, support: &Support) -> Option<Residues> {
        let m = points.modulus;
        let mut samplers = [self.a, self.b].map(|terms| Sampler::new(terms, self.grading, points));
        let degree = support.drops.iter().copied().max().unwrap_or(0) as usize;
        let factors = support.powers(&points.factors, m);
        // The terms of each grade, the first term apart.
        let mut grades: Vec<Vec<usize>> = vec![Vec::new(); degree + 1];
        for (term, &drop) in support.drops.iter().enumerate().skip(1) {
            grades[degree - drop as usize].push(term);
        }
        let count = grades.iter().map(Vec::len).max().unwrap_or(0);
        let mut values = vec![Vec::with_capacity(count); degree];
        for step in 0..count {
            if step > 0 {
                for sampler in &mut samplers {
                    sampler.advance(m);
                }
            }
            let image = samplers[0].divisor_with(&samplers[1], m)?;
            if image.len() != degree + 1 {
                return None;
            }
            for (values, &value) in values.iter_mut().zip(&image) {
                values.push(value);
            }
        }
        let mut residues = vec![0; support.drops.len()];
        residues[0] = m.enter(1);
        for (terms, values) in grades.iter().zip(&values) {
            let roots: Vec<u64> = terms.iter().map(|&term| factors[term]).collect();
            for (&term, c) in terms.iter().zip(coefficients(&roots, values, m)?) {
                residues[term] = c;
            }
        }
        points.divide_by_starts(&mut residues, &support.differences);
        Some(residues)
    }
}

/// A divisor modulo the first prime.
enum Image {
    /// There is none but 1.
    Constant,
    Terms(Support, Residues),
}

impl Support {
    /// Returns the term of the highest grade alone.
    fn top(variables: usize) -> Self {
        Self { drops: vec![0], differences: vec![0; variables] }
    }

    /// Returns the product of powers of the factors that each term stands for.
    fn powers(&self, factors: &[u64], modulus: &Modulus) -> Vec<u64> {
        let mut inverses = factors.to_vec();
        invert_all(&mut inverses, modulus);
        let power = |differences: &[i32]| {
            differences.iter().enumerate().fold(modulus.enter(1), |product, (variable, &e)| {
                let base = if e < 0 { inverses[variable] } else { factors[variable] };
                modulus.mul(product, modulus.pow(base, e.unsigned_abs().into()))
            })
        };
        self.differences.chunks_exact(factors.len()).map(power).collect()
    }

    /// Returns the polynomial that has these terms and is not divisible by a variable.
    fn polynomial(&self, coefficients: &[Integer], support: &[usize]) -> Polynomial<Int> {
        let count = support.len();
        let lowest = |v: usize| self.differences[v..].iter().step_by(count).copied().min().unwrap_or(0);
        let lowest: Vec<i32> = (0..count).map(lowest).collect();
        let variables = support.iter().max().map_or(0, |last| last + 1);
        let mut exponents = vec![0; variables * coefficients.len()];
        let terms = exponents.chunks_exact_mut(variables).zip(self.differences.chunks_exact(count));
        for (exponents, differences) in terms {
            for ((&variable, &e), &lowest) in support.iter().zip(differences).zip(&lowest) {
                exponents[variable] = e.abs_diff(lowest);
            }
        }
        Polynomial::from_lists(variables, &exponents, coefficients.iter().cloned().map(Int::from).collect())
    }
}

impl Points<'_> {
    /// Returns the powers of the values of each variable up to its degree.
    fn tables(values: &[u64], degrees: &[u32], modulus: &Modulus) -> Vec<Vec<u64>> {
        let table = |(&value, &degree): (&u64, &u32)| {
            let mut powers = vec![modulus.enter(1)];
            for k in 0..degree as usize {
                powers.push(modulus.mul(powers[k], value));
            }
            powers
        };
        values.iter().zip(degrees).map(table).collect()
    }

    /// Coefficients at the start of the progression, turned into those of the polynomial.
    fn divide_by_starts(&self, residues: &mut [u64], differences: &[i32]) {
        let m = self.modulus;
        let mut inverses = self.starts.clone();
        invert_all(&mut inverses, m);
        for (r, differences) in residues.iter_mut().zip(differences.chunks_exact(self.starts.len())) {
            for (variable, &e) in differences.iter().enumerate().filter(|(_, e)| **e != 0) {
                let base = if e < 0 { self.starts[variable] } else { inverses[variable] };
                *r = m.mul(*r, m.pow(base, e.unsigned_abs().into()));
            }
        }
    }
}

/// The values of all terms of a polynomial at one step of the progression, by grade.
struct Sampler {
    values: Vec<u64>,
    factors: Vec<u64>,
    /// By grade from the lowest one on, where its terms end.
    ends: Vec<usize>,
}

impl Sampler {
    fn new(terms: &Terms, grading: &Grading, points: &Points) -> Self {
        let (m, variables) = (points.modulus, grading.weights.len());
        let (order, ends) = grading.sorted(terms);
        let starts = Points::tables(&points.starts, &terms.degrees, m);
        let factors = Points::tables(&points.factors, &terms.degrees, m);
        let residue = |c: &Int| match c.to_i64() {
            Some(n) if n < 0 => m.sub(0, m.enter(n.unsigned_abs())),
            Some(n) => m.enter(n.unsigned_abs()),
            None => m.reduce(&c.to_integer()),
        };
        let product = |term: u32, tables: &[Vec<u64>], start: u64| {
            let exponents = &terms.exponents[term as usize * variables..][..variables];
            let occurring = exponents.iter().zip(tables).filter(|(e, _)| **e > 0);
            occurring.fold(start, |product, (&e, powers)| m.mul(product, powers[e as usize]))
        };
        Self {
            values: order.iter().map(|&t| product(t, &starts, residue(&terms.coefficients[t as usize]))).collect(),
            factors: order.iter().map(|&t| product(t, &factors, m.enter(1))).collect(),
            ends,
        }
    }

    /// Returns the polynomial in t at this step.
    fn image(&self, modulus: &Modulus) -> Residues {
        let mut start = 0;
        let mut image = Residues::with_capacity(self.ends.len());
        for &end in &self.ends {
            image.push(self.values[start..end].iter().fold(0, |sum, &v| modulus.add(sum, v)));
            start = end;
        }
        image
    }

    /// Returns the monic divisor of this polynomial and another one; `None` if the leading coefficient of this one vanishes.
    fn divisor_with(&self, other: &Self, modulus: &Modulus) -> Option<Residues> {
        let (a, mut b) = (self.image(modulus), other.image(modulus));
        if a.last() == Some(&0) {
            return None;
        }
        trim(&mut b);
        let mut divisor = common_divisor(a, b, modulus);
        make_monic(&mut divisor, modulus);
        Some(divisor)
    }

    /// Goes on to the next step.
    fn advance(&mut self, modulus: &Modulus) {
        for (value, &factor) in self.values.iter_mut().zip(&self.factors) {
            *value = modulus.mul(*value, factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    /// By images at a progression, whatever they cost.
    fn sparse(f: &Poly, g: &Poly) -> Option<Poly> {
        let support: Vec<usize> = (0..f.variables()).filter(|&v| f.degree(v) > 0).collect();
        f.sparse_gcd_within(g, &support, |_, _| f64::INFINITY)
    }

    /// Returns the polynomial with these terms, made primitive and free of monomial factors; zero if they cancel.
    fn reduced(terms: Vec<(Vec<u32>, i64)>) -> Poly {
        let polynomial = Poly::from_terms(terms.into_iter().map(|(e, c)| (e, Int::from(c))));
        polynomial.div_exact(&polynomial.monomial_content()).primitive_part()
    }

    fn polynomials(variables: usize, degree: u32, terms: usize) -> impl Strategy<Value = Poly> {
        let term = (prop::collection::vec(0..=degree, variables), 1_i64..1 << 40);
        let signed = term.prop_map(|(e, c)| (e, if c % 3 == 0 { -c } else { c >> (c % 37) }));
        // Zero has divisors without end: `gcd` answers for it before it comes to a progression.
        let terms = prop::collection::vec(signed, 1..=terms);
        terms.prop_map(reduced).prop_filter("terms that cancel", |polynomial| !polynomial.is_zero())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        /// Images at a progression and on a grid, which share no more than the divisors in one variable.
        #[test]
        fn both_ways_to_a_divisor_agree(
            h in polynomials(4, 5, 12), f in polynomials(4, 4, 9), g in polynomials(4, 3, 9),
        ) {
            let every: Poly = (0..4).map(Poly::variable).fold(Poly::one(), |sum, x| sum.add(&x));
            let (a, b) = (h.mul(&f).mul(&every), h.mul(&g).mul(&every));
            let layout = crate::polynomial::image::Layout::new(&a, &b).unwrap();
            prop_assert_eq!(sparse(&a, &b), Some(a.modular_gcd(&b, &layout)));
        }
    }

    fn number(n: i64) -> Poly {
        Poly::constant(Int::from(n))
    }

    #[test]
    fn divisors_with_long_coefficients_take_several_primes() {
        let [x, y, z] = [0, 1, 2].map(Poly::variable);
        let long = Int::from(Integer::from(7) << 300_u32);
        let h = x.pow(9).scale(&long).sub(&y.pow(5).mul(&z)).add(&z.pow(7).scale(&Int::from(-12345)));
        let (f, g) = (x.mul(&y).sub(&z.scale(&long)), x.add(&y.pow(3)).add(&number(5)));
        assert_eq!(sparse(&f.mul(&h), &g.mul(&h)), Some(h));
    }

    #[test]
    fn polynomials_without_common_divisor_and_multiples() {
        let [x, y, z] = [0, 1, 2].map(Poly::variable);
        let (f, g) = (x.pow(3).mul(&y).add(&z), x.add(&y.pow(2)).sub(&z));
        assert_eq!(sparse(&f, &g), Some(Poly::one()));
        assert_eq!(sparse(&f.mul(&g), &g), Some(g.clone()));
        assert_eq!(sparse(&g, &f.mul(&g)), Some(g));
    }

    /// Every variable alone has several terms of its highest and of its lowest degree: weights must be combined.
    #[test]
    fn corners_are_found_by_several_weights() {
        let [x, y, z] = [0, 1, 2].map(Poly::variable);
        let cube = [&x, &y, &z].map(|v| v.pow(2).add(&number(3))).iter().fold(Poly::one(), |p, v| p.mul(v));
        let h = cube.add(&x.mul(&y).mul(&z)).add(&number(1));
        let (f, g) = (cube.sub(&x.mul(&y)), cube.add(&z.mul(&y)));
        assert_eq!(sparse(&f.mul(&h), &g.mul(&h)), Some(h));
    }

    /// A factor that every single weight would lose: it is of one grade in x, in y and in z alone.
    #[test]
    fn factors_in_fewer_variables_are_kept() {
        let [x, y, z] = [0, 1, 2].map(Poly::variable);
        let h = [&x, &y, &z].map(|v| v.pow(3).sub(v).add(&number(7))).iter().fold(Poly::one(), |p, v| p.mul(v));
        let (f, g) = (x.mul(&y).add(&z.pow(2)), x.sub(&y.mul(&z)));
        assert_eq!(sparse(&f.mul(&h), &g.mul(&h)), Some(h));
    }
}
