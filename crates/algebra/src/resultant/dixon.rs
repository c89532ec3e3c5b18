//! Eliminates two variables from three polynomials at once, by Dixon's form of Cayley's construction.

use super::linear::reduce;
use crate::int::Int;
use crate::minors::determinant;
use crate::modp::{ModP, PRIME_61};
use crate::polynomial::Polynomial;
use crate::ring::{Field, Ring};
use std::collections::{BTreeMap, BTreeSet};

/// The exponents of a monomial in the two eliminated variables.
pub type Monomial = [u32; 2];

/// The Dixon matrix of three polynomials in x and y: the coefficients of
///
/// `det [f(x, y); f(u, y); f(u, v)] / ((x - u)(y - v))`,
///
/// a polynomial of degrees m - 1 and 2n - 1 in x and y, and 2m - 1 and n - 1 in u and v, if the three are of degrees m in
/// x and n in y. At a common root the vector of the columns' monomials is in the null space of the matrix, and the vector
/// of the rows' monomials in that of its transpose.
///
/// # Shape
/// Rows belong to monomials in u and v, columns to monomials in x and y, only to those that occur, in increasing order;
/// for general polynomials of degrees m and n, `2mn` of each, and the determinant is the resultant.
///
/// # Source
/// Dixon 1909, The eliminant of three quantics in two independent variables, Proceedings of the London Mathematical
/// Society 7.
#[derive(Clone, Debug)]
pub struct Dixon<R> {
    /// The monomials of the rows.
    pub rows: Vec<Monomial>,
    /// The monomials of the columns.
    pub columns: Vec<Monomial>,
    /// The matrix, by rows.
    pub entries: Vec<Vec<R>>,
}

/// A square part of the Dixon matrix whose determinant is not zero, of the largest size that there is.
#[derive(Clone, Debug)]
pub struct MaximalMinor<R> {
    /// The square matrix.
    pub entries: Vec<Vec<R>>,
    /// A monomial whose column, or whose row, depends on no others. Then the determinant vanishes at all values of
    /// the parameters with a common root at which this monomial does not vanish; for `[0, 0]`, with any common root. Then every
    /// irreducible factor of the resultant divides the determinant. Other factors are extraneous: often leading
    /// coefficients, or factors that the determinants of other minors lack. Without a witness nothing is known.
    pub witness: Option<Monomial>,
}

/// The result of eliminating two variables from three polynomials.
#[derive(Clone, Debug)]
pub struct DixonEliminant {
    /// The Dixon matrix, which gives the common root back, see [`Dixon::common_root_at`].
    pub matrix: Dixon<Polynomial<Int>>,
    /// A nonzero multiple of the resultant under the condition of [`MaximalMinor::witness`]; for three general
    /// polynomials of given degrees in x and in y, the resultant itself. Zero if the matrix is.
    pub determinant: Polynomial<Int>,
    /// See [`MaximalMinor::witness`].
    pub witness: Option<Monomial>,
}

/// Eliminates two variables from three polynomials, by the determinant of a maximal minor of the Dixon matrix.
///
/// The minor is chosen by the ranks at random values of the parameters modulo a prime. That its determinant is not zero
/// is certain; that there is no larger one has a probability of error of the order of the degree over `2^61`.
///
/// # Panics
/// When the two variables are the same.
///
/// # Source
/// Kapur, Saxena, Yang 1994, Algebraic and geometric reasoning using Dixon resultants, ISSAC.
#[must_use]
pub fn eliminate(f: [&Polynomial<Int>; 3], variables: [usize; 2]) -> DixonEliminant {
    let matrix = Dixon::new(&f.map(|f| collect(f, variables)));
    let parameters = f.iter().map(|f| f.variables()).max().unwrap_or(0);
    // The constants of a 64-bit linear congruential generator; any values will do that have nothing to do with f.
    let step = |x: &u64| Some(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407));
    let values: Vec<_> = std::iter::successors(step(&1), step).take(parameters).map(ModP::<PRIME_61>::new).collect();
    let at_values = |c: &Polynomial<Int>| {
        let image = |c: &Int| ModP::<PRIME_61>::from_rational(&c.to_integer().into());
        c.map(image).map(|c| c.evaluate(&values))
    };
    let minor = matrix.maximal_minor(at_values).filter(|minor| !minor.entries.is_empty());
    let determinant = minor.as_ref().map_or_else(Polynomial::zero, |minor| determinant(&minor.entries));
    DixonEliminant { matrix, determinant, witness: minor.and_then(|minor| minor.witness) }
}

/// Returns a polynomial as one in two of its variables with coefficients that are polynomials in the others.
///
/// # Panics
/// When the two variables are the same.
#[must_use]
pub fn collect<R: Ring>(f: &Polynomial<R>, [x, y]: [usize; 2]) -> Polynomial<Polynomial<R>> {
    assert_ne!(x, y, "two variables are eliminated");
    let mut parts: BTreeMap<Monomial, Vec<(Vec<u32>, R)>> = BTreeMap::new();
    for (mut exponents, c) in f.terms() {
        let monomial = [x, y].map(|variable| exponents.get_mut(variable).map_or(0, std::mem::take));
        parts.entry(monomial).or_default().push((exponents, c.clone()));
    }
    Polynomial::from_terms(parts.into_iter().map(|(monomial, part)| (monomial.to_vec(), Polynomial::from_terms(part))))
}

/// Three different monomials, by their numbers, increasing: the columns of a determinant of coefficients.
type Triple = [usize; 3];

/// Returns the order of three numbers, and whether the permutation that sorts them is odd.
fn sorted([mut i, mut j, mut k]: Triple) -> (Triple, bool) {
    let mut odd = false;
    let mut order = |a: &mut usize, b: &mut usize| {
        if a > b {
            std::mem::swap(a, b);
            odd = !odd;
        }
    };
    order(&mut i, &mut j);
    order(&mut j, &mut k);
    order(&mut i, &mut j);
    ([i, j, k], odd)
}

impl<R: Ring> Dixon<R> {
    /// Returns the Dixon matrix of three polynomials in the variables 0 and 1, parameters being in the coefficients, see
    /// [`collect`].
    ///
    /// # Panics
    /// When there are other variables.
    #[must_use]
    pub fn new(f: &[Polynomial<R>; 3]) -> Self {
        let table = f.each_ref().map(|f| {
            let term = |(exponents, c): (Vec<u32>, &R)| {
                assert!(exponents.iter().skip(2).all(|&e| e == 0), "a polynomial in the variables 0 and 1");
                let exponent = |variable: usize| exponents.get(variable).copied().unwrap_or(0);
                ([exponent(0), exponent(1)], c.clone())
            };
            f.terms().map(term).collect::<BTreeMap<Monomial, R>>()
        });
        let support: Vec<Monomial> =
            table.iter().flat_map(|f| f.keys().copied()).collect::<BTreeSet<_>>().into_iter().collect();
        let coefficients: Vec<[Option<R>; 3]> =
            support.iter().map(|monomial| table.each_ref().map(|f| f.get(monomial).cloned())).collect();
        let mut brackets = Brackets::new(&coefficients);
        let mut entries: BTreeMap<(Monomial, Monomial), R> = BTreeMap::new();
        for (place, combination) in combinations(&support) {
            for (triple, multiplicity) in combination {
                let Some(bracket) = brackets.get(triple).filter(|_| multiplicity != 0) else { continue };
                let entry = entries.entry(place).or_insert_with(R::zero);
                *entry = match multiplicity {
                    1 => entry.add(bracket),
                    -1 => entry.sub(bracket),
                    _ => entry.add(&bracket.mul(&R::from_integer(multiplicity))),
                };
            }
        }
        entries.retain(|_, c| !c.is_zero());
        let distinct = |monomials: &mut dyn Iterator<Item = Monomial>| -> Vec<Monomial> {
            monomials.collect::<BTreeSet<_>>().into_iter().collect()
        };
        let rows = distinct(&mut entries.keys().map(|(row, _)| *row));
        let columns = distinct(&mut entries.keys().map(|(_, column)| *column));
        let mut entry = |row, column| entries.remove(&(row, column)).unwrap_or_else(R::zero);
        let entries = rows.iter().map(|&row| columns.iter().map(|&column| entry(row, column)).collect()).collect();
        Self { rows, columns, entries }
    }

    fn at<F: Field>(&self, image: impl Fn(&R) -> Option<F>) -> Option<Vec<Vec<F>>> {
        self.entries.iter().map(|row| row.iter().map(&image).collect()).collect()
    }

    /// Returns the rows and columns of a maximal minor that does not vanish at the values `image` of the parameters in a
    /// field, preferably random ones modulo a large prime; `None` if a coefficient has no image.
    pub fn maximal_minor<F: Field>(&self, image: impl Fn(&R) -> Option<F>) -> Option<MaximalMinor<R>> {
        let matrix = self.at(image)?;
        let reduced = reduce(&matrix, self.columns.len(), 0.0);
        let transposed = reduce(&transpose(&matrix, self.columns.len()), self.rows.len(), 0.0);
        // A column that no other ones depend on has no part in any relation among them.
        let independent = |monomials: &[Monomial], relations: Vec<Vec<F>>| {
            (0..monomials.len()).find(|&j| relations.iter().all(|v| v[j].is_zero())).map(|j| monomials[j])
        };
        let candidates =
            [independent(&self.columns, reduced.null_space()), independent(&self.rows, transposed.null_space())];
        let (mut rows, mut columns): (Vec<usize>, Vec<usize>) = reduced.pivots.iter().copied().unzip();
        rows.sort_unstable();
        columns.sort_unstable();
        let row = |&i: &usize| columns.iter().map(|&j| self.entries[i][j].clone()).collect();
        Some(MaximalMinor { entries: rows.iter().map(row).collect(), witness: candidates.into_iter().flatten().min() })
    }

    /// Returns the common root `x = p/q`, `y = r/s` as `[[p, q], [r, s]]` at the values `image` of the parameters, at which the
    /// three polynomials must have one common root.
    ///
    /// A zero q or s is a root at infinity. `None` if the rank of the matrix is not by one less than its size there
    /// (several common roots, none, or a matrix whose determinant vanishes identically), or a coefficient has no image.
    /// Pivots not above `tolerance` times the largest entry count as zero: 0 in exact fields.
    pub fn common_root_at<F: Field>(&self, image: impl Fn(&R) -> Option<F>, tolerance: f64) -> Option<[[F; 2]; 2]> {
        let matrix = self.at(image)?;
        let tolerance = tolerance * matrix.iter().flatten().map(F::pivot_size).fold(0.0, f64::max);
        let single = |matrix: &[Vec<F>], columns: usize| {
            let mut null_space = reduce(matrix, columns, tolerance).null_space();
            null_space.pop().filter(|_| null_space.is_empty())
        };
        let vectors = [
            (&self.columns, single(&matrix, self.columns.len())?),
            (&self.rows, single(&transpose(&matrix, self.columns.len()), self.rows.len())?),
        ];
        let ratio = |variable: usize| {
            let mut best: Option<(f64, [F; 2])> = None;
            for (monomials, vector) in &vectors {
                let largest = vector.iter().map(F::pivot_size).fold(0.0, f64::max);
                for (monomial, low) in monomials.iter().zip(vector) {
                    let mut next = *monomial;
                    next[variable] += 1;
                    let Ok(high) = monomials.binary_search(&next) else { continue };
                    let size = low.pivot_size().max(vector[high].pivot_size()) / largest;
                    if size > 0.0 && best.as_ref().is_none_or(|(found, _)| size > *found) {
                        best = Some((size, [vector[high].clone(), low.clone()]));
                    }
                }
            }
            best.map(|(_, ratio)| ratio)
        };
        Some([ratio(0)?, ratio(1)?])
    }
}

/// Returns the entries of the Dixon matrix as integer combinations of the determinants of three columns of coefficients: by
/// divided differences, first in y and then in x, the rows of the determinant become
/// `sum_k x^k u^(a-1-k) y^b`, `u^a sum_k y^k v^(b-1-k)`, `u^a v^b` for the monomial `x^a y^b`.
fn combinations(support: &[Monomial]) -> BTreeMap<(Monomial, Monomial), BTreeMap<Triple, i32>> {
    let mut entries: BTreeMap<(Monomial, Monomial), BTreeMap<Triple, i32>> = BTreeMap::new();
    for (i, [a, b]) in support.iter().enumerate() {
        for (j, [c, d]) in support.iter().enumerate().filter(|(j, _)| *j != i) {
            for (k, [e, f]) in support.iter().enumerate().filter(|(k, _)| *k != i && *k != j) {
                let (triple, odd) = sorted([i, j, k]);
                for p in 0..*a {
                    for q in 0..*d {
                        let place = ([a - 1 - p + c + e, d - 1 - q + f], [p, b + q]);
                        *entries.entry(place).or_default().entry(triple).or_insert(0) += if odd { -1 } else { 1 };
                    }
                }
            }
        }
    }
    entries
}

/// The determinants of three columns of coefficients, each computed on first use.
struct Brackets<'a, R> {
    coefficients: &'a [[Option<R>; 3]],
    known: BTreeMap<Triple, Option<R>>,
    minors: BTreeMap<[usize; 2], [Option<R>; 3]>,
}

impl<'a, R: Ring> Brackets<'a, R> {
    fn new(coefficients: &'a [[Option<R>; 3]]) -> Self {
        Self { coefficients, known: BTreeMap::new(), minors: BTreeMap::new() }
    }

    /// Returns the determinant; `None` for zero.
    fn get(&mut self, triple: Triple) -> Option<&R> {
        let Self { coefficients, known, minors } = self;
        let expand = || {
            let [i, j, k] = triple;
            let minors = minors.entry([i, j]).or_insert_with(|| cross(&coefficients[i], &coefficients[j]));
            let products = coefficients[k]
                .iter()
                .zip(minors.iter())
                .filter_map(|(c, minor)| Some(c.as_ref()?.mul(minor.as_ref()?)));
            products.reduce(|sum, product| sum.add(&product)).filter(|sum| !sum.is_zero())
        };
        known.entry(triple).or_insert_with(expand).as_ref()
    }
}

/// Returns the vector product of two columns of coefficients.
fn cross<R: Ring>(a: &[Option<R>; 3], b: &[Option<R>; 3]) -> [Option<R>; 3] {
    let product = |i: usize, j: usize| Some(a[i].as_ref()?.mul(b[j].as_ref()?));
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| match (product(i, j), product(j, i)) {
        (Some(x), Some(y)) => Some(x.sub(&y)),
        (Some(x), None) => Some(x),
        (None, y) => y.map(|y| y.neg()),
    })
}

fn transpose<F: Clone>(matrix: &[Vec<F>], columns: usize) -> Vec<Vec<F>> {
    (0..columns).map(|j| matrix.iter().map(|row| row[j].clone()).collect()).collect()
}
