//! The graded quotient ring of a platform's equations, degree by degree, modulo a prime: for special geometries, where
//! solutions with `N = 0` form curves and the border basis of the general platform does not exist.
//!
//! In homogeneous unknowns `z_0..z_3` (degree 1) and `tau_a` (degree 2) the ring has in each degree a basis of standard
//! monomials; the candidates of the next degree are the products of unknowns with them. Two ways of writing one monomial as a
//! product differ by a relation.

use super::border::{Arithmetic, Setting};
use crate::algebra::modp::Modulus;
use crate::algebra::sort;
use crate::closure::study::{Form, left, right};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Exponents of `z_0..z_3` and of up to four `tau`, a byte each.
type Monomial = u64;
/// Coefficients by monomials.
type Sparse<E> = BTreeMap<Monomial, E>;

/// One unknown.
fn unknown(index: usize) -> Monomial {
    1 << (8 * index)
}

/// Whether a monomial contains an unknown.
fn contains(monomial: Monomial, index: usize) -> bool {
    (monomial >> (8 * index)) & 255 != 0
}

/// The degree of an unknown.
fn weight(index: usize) -> usize {
    if index < 4 { 1 } else { 2 }
}

/// One degree of the ring.
struct Degree<E> {
    /// The standard monomials, and their places.
    standard: Vec<Monomial>,
    places: HashMap<Monomial, usize>,
    /// Normal forms of the candidates.
    normal: HashMap<Monomial, Vec<E>>,
}

/// The ring up to some degree.
pub struct GradedQuotient<'a, A: Arithmetic> {
    field: &'a A,
    unknowns: usize,
    generators: Vec<(usize, Sparse<A::Element>)>,
    degrees: Vec<Degree<A::Element>>,
}

impl GradedQuotient<'_, Modulus> {
    /// Adds a general quadric to the equations, before the ring goes on to degree 2: one dimension less.
    pub fn cut(&mut self, number: usize) {
        let monomials: Vec<Monomial> = (0..4)
            .flat_map(|i| (i..4).map(move |j| unknown(i) + unknown(j)))
            .chain((4..self.unknowns).map(unknown))
            .collect();
        // Powers of numbers that have nothing to do with the equations.
        let base = self.field.enter(1_000_003 + 7_919 * number as u64);
        let mut c = base;
        let mut quadric = Sparse::new();
        for monomial in monomials {
            c = Modulus::mul(self.field, Modulus::mul(self.field, c, c), base);
            quadric.insert(monomial, c);
        }
        self.generators.push((2, quadric));
    }
}

impl<'a, A: Arithmetic> GradedQuotient<'a, A> {
    /// The ring of a platform, in degree 0.
    #[must_use]
    pub fn new(field: &'a A, setting: &Setting<A::Element>) -> Self {
        let one = field.one();
        let mut first = Degree { standard: vec![0], places: HashMap::new(), normal: HashMap::new() };
        first.places.insert(0, 0);
        first.normal.insert(0, vec![one]);
        let unknowns = 4 + setting.count;
        Self { field, unknowns, generators: generators(field, setting), degrees: vec![first] }
    }

    /// Dimension of the ring in a degree known already.
    #[must_use]
    pub fn dimension(&self, degree: usize) -> usize {
        self.degrees[degree].standard.len()
    }

    /// Goes on to the next degree; `None` where `inverse` does not exist for a number that is not 0.
    pub fn advance(&mut self, inverse: impl Fn(A::Element) -> Option<A::Element>) -> Option<()> {
        let zero = self.field.zero();
        let degree = self.degrees.len();
        let below = |index: usize| degree.checked_sub(weight(index)).map(|d| (d, &self.degrees[d]));
        let mut candidates = BTreeSet::new();
        for index in 0..self.unknowns {
            if let Some((_, lower)) = below(index) {
                candidates.extend(lower.standard.iter().map(|m| m + unknown(index)));
            }
        }
        // Large monomials first: z_0 to a high power stays in the basis.
        let order = |m: &Monomial| m.swap_bytes();
        let mut columns: Vec<Monomial> = candidates.into_iter().collect();
        sort::by_key(&mut columns, order);
        let places: HashMap<Monomial, usize> = columns.iter().enumerate().map(|(k, m)| (*m, k)).collect();
        let mut rows = Vec::new();
        // Every product of an unknown with a candidate of lower degree that is not standard.
        let mut seen: HashMap<Monomial, Vec<A::Element>> = HashMap::new();
        for index in 0..self.unknowns {
            let Some((_, lower)) = below(index) else { continue };
            for (monomial, normal) in &lower.normal {
                if lower.places.contains_key(monomial) {
                    continue;
                }
                let product = monomial + unknown(index);
                let mut row = vec![zero; columns.len()];
                for (standard, c) in lower.standard.iter().zip(normal) {
                    row[places[&(standard + unknown(index))]] = *c;
                }
                if let Some(&place) = places.get(&product) {
                    row[place] = self.field.sub(row[place], self.field.one());
                    rows.push(row);
                } else if let Some(other) = seen.get(&product) {
                    for (x, y) in row.iter_mut().zip(other) {
                        *x = self.field.sub(*x, *y);
                    }
                    rows.push(row);
                } else {
                    seen.insert(product, row);
                }
            }
        }
        for (_, generator) in self.generators.iter().filter(|(d, _)| *d == degree) {
            let mut row = vec![zero; columns.len()];
            for (monomial, c) in generator {
                self.expand(degree, *monomial, *c, &places, &mut row);
            }
            rows.push(row);
        }
        let next = solved(self.field, inverse, rows, &columns)?;
        self.degrees.push(next);
        Some(())
    }

    /// Adds a multiple of a monomial of a known degree, as a combination of the candidates of that degree.
    fn expand(
        &self,
        degree: usize,
        monomial: Monomial,
        factor: A::Element,
        places: &HashMap<Monomial, usize>,
        row: &mut [A::Element],
    ) {
        let Some(index) = (0..self.unknowns).find(|&k| contains(monomial, k)) else { return };
        let lower = degree - weight(index);
        let normal = self.normal(lower, monomial - unknown(index));
        for (standard, c) in self.degrees[lower].standard.iter().zip(&normal) {
            let place = places[&(standard + unknown(index))];
            row[place] = self.field.add(row[place], self.field.mul(factor, *c));
        }
    }

    /// Returns the normal form of any monomial of a degree already known.
    fn normal(&self, degree: usize, monomial: Monomial) -> Vec<A::Element> {
        if let Some(normal) = self.degrees[degree].normal.get(&monomial) {
            return normal.clone();
        }
        let mut sum = vec![self.field.zero(); self.dimension(degree)];
        if let Some(index) = (0..self.unknowns).find(|&k| contains(monomial, k)) {
            let lower = degree - weight(index);
            let below = self.normal(lower, monomial - unknown(index));
            for (standard, c) in self.degrees[lower].standard.iter().zip(&below) {
                self.field.add_multiple(&mut sum, *c, &self.degrees[degree].normal[&(standard + unknown(index))]);
            }
        }
        sum
    }

    /// `z_index v` for v of a degree.
    #[must_use]
    pub fn times(&self, degree: usize, index: usize, v: &[A::Element]) -> Vec<A::Element> {
        let (lower, upper) = (&self.degrees[degree], &self.degrees[degree + weight(index)]);
        let mut product = vec![self.field.zero(); upper.standard.len()];
        let zero = self.field.zero();
        for (standard, c) in lower.standard.iter().zip(v).filter(|(_, c)| **c != zero) {
            self.field.add_multiple(&mut product, *c, &upper.normal[&(standard + unknown(index))]);
        }
        product
    }

    /// Multiplication by N from a degree on: row k is the product with basis element k.
    #[must_use]
    pub fn norm(&self, degree: usize) -> Vec<Vec<A::Element>> {
        let row = |k: usize| {
            let mut unit = vec![self.field.zero(); self.dimension(degree)];
            unit[k] = self.field.one();
            let mut sum = vec![self.field.zero(); self.dimension(degree + 2)];
            for index in 0..4 {
                let product = self.times(degree + 1, index, &self.times(degree, index, &unit));
                for (s, p) in sum.iter_mut().zip(&product) {
                    *s = self.field.add(*s, *p);
                }
            }
            sum
        };
        (0..self.dimension(degree)).map(row).collect()
    }
}

/// Solves relations for the candidates that come first.
fn solved<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    mut rows: Vec<Vec<A::Element>>,
    columns: &[Monomial],
) -> Option<Degree<A::Element>> {
    let zero = field.zero();
    let width = columns.len();
    let mut pivots = Vec::new();
    let mut rank = 0;
    for column in 0..width {
        let Some(best) = (rank..rows.len()).find(|&i| rows[i][column] != zero) else { continue };
        rows.swap(best, rank);
        let inverse = inverse(rows[rank][column])?;
        for x in &mut rows[rank][column..] {
            *x = field.mul(*x, inverse);
        }
        let (head, tail) = rows.split_at_mut(rank + 1);
        for row in tail {
            if row[column] != zero {
                let factor = field.neg(row[column]);
                field.add_multiple(&mut row[column..], factor, &head[rank][column..]);
            }
        }
        pivots.push(column);
        rank += 1;
    }
    for k in (1..rank).rev() {
        let (head, tail) = rows.split_at_mut(k);
        for row in head {
            if row[pivots[k]] != zero {
                let factor = field.neg(row[pivots[k]]);
                field.add_multiple(&mut row[pivots[k]..], factor, &tail[0][pivots[k]..]);
            }
        }
    }
    let is_pivot: BTreeSet<usize> = pivots.iter().copied().collect();
    let free: Vec<usize> = (0..width).filter(|k| !is_pivot.contains(k)).collect();
    let mut degree = Degree { standard: Vec::new(), places: HashMap::new(), normal: HashMap::new() };
    for (t, &k) in free.iter().enumerate() {
        degree.standard.push(columns[k]);
        degree.places.insert(columns[k], t);
        let mut unit = vec![zero; free.len()];
        unit[t] = field.one();
        degree.normal.insert(columns[k], unit);
    }
    for (row, &k) in rows.iter().zip(&pivots) {
        degree.normal.insert(columns[k], free.iter().map(|&f| field.neg(row[f])).collect());
    }
    Some(degree)
}

/// The equations of a platform: the conditions left by a kernel of K, four cubics, two quartics.
fn generators<A: Arithmetic>(field: &A, setting: &Setting<A::Element>) -> Vec<(usize, Sparse<A::Element>)> {
    let add = |target: &mut Sparse<A::Element>, monomial: Monomial, c: A::Element| {
        let entry = target.entry(monomial).or_insert(field.zero());
        *entry = field.add(*entry, c);
    };
    let product = |a: &Sparse<A::Element>, b: &Sparse<A::Element>| {
        let mut sum = Sparse::new();
        for (m, x) in a {
            for (n, y) in b {
                add(&mut sum, m + n, field.mul(*x, *y));
            }
        }
        sum
    };
    let quadratic = |form: &Form<A::Element>| {
        let mut sum = Sparse::new();
        for (i, row) in form.iter().enumerate() {
            for (j, c) in row.iter().enumerate() {
                add(&mut sum, unknown(i) + unknown(j), *c);
            }
        }
        sum
    };
    let u: Vec<Sparse<A::Element>> = (0..7)
        .map(|k| {
            let mut sum = quadratic(&setting.forms[k]);
            for a in 0..setting.count {
                add(&mut sum, unknown(4 + a), setting.null[a][k]);
            }
            sum
        })
        .collect();
    let mut all: Vec<(usize, Sparse<A::Element>)> =
        setting.dropped[..setting.count - 1].iter().map(|form| (2, quadratic(form))).collect();
    let unit = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    for i in 0..4 {
        let mut cubic = Sparse::new();
        for k in 0..3 {
            let (right, left) = (right::<f64>(&unit(k)), left::<f64>(&unit(k)));
            for j in 0..4 {
                for (sign, part) in [(right[i][j], &u[4 + k]), (-left[i][j], &u[1 + k])] {
                    for (m, c) in part {
                        if sign > 0.0 {
                            add(&mut cubic, m + unknown(j), *c);
                        } else if sign < 0.0 {
                            add(&mut cubic, m + unknown(j), field.neg(*c));
                        }
                    }
                }
            }
        }
        all.push((3, cubic));
    }
    let identity: Form<A::Element> =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { field.one() } else { field.zero() }));
    let far = product(&quadratic(&identity), &u[0]);
    for part in [1..4, 4..7] {
        let mut quartic: Sparse<A::Element> = far.iter().map(|(m, c)| (*m, field.neg(*c))).collect();
        for k in part {
            for (m, c) in product(&u[k], &u[k]) {
                add(&mut quartic, m, c);
            }
        }
        all.push((4, quartic));
    }
    all
}
