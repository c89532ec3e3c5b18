//! Products and determinants of few terms with short coefficients: what they cost is mostly bookkeeping, so here is little of it.
//!
//! Every term has a key; the keys of a product are the sums of those of its factors, and decrease as its monomials do. It is the monomial
//! itself or, where the monomials that the degrees allow are not many more than the products, its place among them.
//!
//! # Why the coefficients are right
//! A bound on the sums of absolute values shows beforehand that all sums fit a machine word. At places they are added up in
//! f64 if it is at most `2^53`: then every product and every sum on the way is an integer that f64 holds exactly.

#![expect(clippy::cast_possible_truncation, reason = "keys are places in lists, and sums fit a word")]

use super::Polynomial;
use super::blocks::Accumulator;
use super::kronecker::balanced;
use super::limbs;
use super::product::bound;
use super::transform::Transform;
use crate::int::Int;
use crate::monomial::Packing;
use crate::ring::Ring;
use crate::wrapping::{Wide, Wrapping, wrapped};
use pulp::Arch;
use std::cmp::Reverse;

/// A key and a coefficient.
type Term<C = i64> = (u64, C);

/// The monomials of a factor, and its coefficients.
type Factor<'a> = (&'a [u64], &'a [&'a Int]);

/// The most products of terms that are looked at here at all, those that are sorted, and those that are looked up in a table.
pub(super) const MOST: usize = 1 << 17;
const SORTED: usize = 64;
const TABLED: usize = 4096;
/// The most products of coefficients whose sums fit two words: others add digits, or whole numbers.
const WIDE: usize = 1 << 14;
/// The most products of a term and a stretch of [`LONG`] places in a product: beyond it other ways are faster.
const STRETCHES: usize = 1 << 13;
/// The places of a row that are kept in registers at a time; and the fewest terms of a row for which that pays, on the average.
const LONG: usize = 16;
const FEW: usize = 8;
/// The most products of terms that are added up one by one.
const SINGLE: usize = 1 << 14;
/// The most places between two terms that are filled with zeros so that they lie in one stretch.
const GAP: u64 = 12;
/// The most places, and the most for each product.
const PLACES: usize = 1 << 14;
const PLACES_PER_PRODUCT: usize = 6;
/// The rows of the largest matrix, and the most products of terms in its determinant.
const LARGEST_MATRIX: usize = 4;
const MATRIX_PRODUCTS: usize = 1 << 17;
/// Sums below this fit a word, and up to this f64.
const HALF: u128 = 1 << 63;
const EXACT: u128 = 1 << f64::MANTISSA_DIGITS;

/// A factor whose terms lie at places: stretches of them, each by its first place and its length, and the coefficients of all.
#[derive(Default)]
struct Laid {
    stretches: Vec<(usize, usize)>,
    values: Vec<f64>,
}

impl Laid {
    /// Lays terms out that come by decreasing keys.
    fn new(terms: &[Term]) -> Self {
        let mut laid = Self { stretches: Vec::new(), values: Vec::with_capacity(2 * terms.len()) };
        let mut end = u64::MAX;
        for (key, c) in terms.iter().rev() {
            match laid.stretches.last_mut() {
                Some((_, length)) if *key - end <= GAP => {
                    let zeros = (*key - end) as usize;
                    laid.values.resize(laid.values.len() + zeros, 0.0);
                    *length += zeros + 1;
                }
                _ => laid.stretches.push((*key as usize, 1)),
            }
            laid.values.push(*c as f64);
            end = key + 1;
        }
        laid
    }

    /// Adds the product with a term.
    #[inline(always)]
    fn add(&self, (key, c): Term, sums: &mut [f64]) {
        let (mut from, c) = (0, c as f64);
        for &(start, length) in &self.stretches {
            let sums = &mut sums[key as usize + start..][..length];
            for (sum, d) in sums.iter_mut().zip(&self.values[from..from + length]) {
                *sum += c * d;
            }
            from += length;
        }
    }
}

/// Terms in rows: for each row its number and where its terms end, and for each term its place in the row.
type Rows = (Vec<(usize, usize)>, Vec<(usize, f64)>);

/// Returns terms in rows of so many places.
fn rows(terms: &[Term], width: usize) -> Rows {
    let (mut rows, mut placed): (Vec<(usize, usize)>, _) = (Vec::new(), Vec::with_capacity(terms.len()));
    let mut start = usize::MAX;
    for (term, (key, c)) in terms.iter().enumerate() {
        let key = *key as usize;
        if key < start {
            rows.push((key / width, term));
            start = key / width * width;
        }
        if let Some(row) = rows.last_mut() {
            row.1 = term + 1;
        }
        placed.push((key - start, *c as f64));
    }
    (rows, placed)
}

/// Returns the product of two factors at places; `None` if other ways are faster.
fn at_places(places: &Places, left: &[Term], right: &[Term]) -> Option<Vec<Term>> {
    let width = places.variables.last().map_or(1, |(.., degree)| *degree as usize + 1);
    let (left_rows, right_rows) = (rows(left, width), rows(right, width));
    if right.len() < FEW * right_rows.0.len() {
        if left.len() * right.len() > SINGLE {
            return None;
        }
        let mut sums = vec![0.0; places.count];
        let right: Vec<(usize, f64)> = right.iter().map(|(key, d)| (*key as usize, *d as f64)).collect();
        for (key, c) in left {
            let (sums, c) = (&mut sums[*key as usize..], *c as f64);
            for (other, d) in &right {
                sums[*other] += c * d;
            }
        }
        return Some(taken(&sums, width, width));
    }
    if left.len() * right_rows.0.len() * width.div_ceil(LONG) > STRETCHES {
        return None;
    }
    let (stride, count) = (width.next_multiple_of(LONG), places.count / width);
    let sums = Arch::new().dispatch(
        #[inline(always)]
        || sums_by_rows(stride, count, &left_rows, &right_rows),
    );
    Some(taken(&sums, width, stride))
}

/// Returns the sums other than zero, by decreasing places: those of rows of some width at some distance.
fn taken(sums: &[f64], width: usize, stride: usize) -> Vec<Term> {
    let mut terms = Vec::with_capacity(sums.len() / 2 + 1);
    for (row, sums) in sums.chunks_exact(stride).enumerate().rev() {
        for (place, sum) in sums[..width].iter().enumerate().rev() {
            if *sum != 0.0 {
                terms.push(((row * width + place) as u64, *sum as i64));
            }
        }
    }
    terms
}

/// Multiplies each row of one factor with each of the other, so many places of their product at a time.
#[inline(always)]
fn sums_by_rows(stride: usize, count: usize, (left, left_terms): &Rows, (right, right_terms): &Rows) -> Vec<f64> {
    // Each row of the right factor between zeros: its number, where its place 0 is, and its highest place.
    let (mut laid, mut values, mut from) = (Vec::with_capacity(right.len()), Vec::new(), 0);
    values.reserve(right.len() * (stride + LONG) + LONG);
    for &(row, end) in right {
        let (first, highest) = (values.len() + LONG, right_terms[from].0);
        values.resize(first + highest + 1, 0.0);
        for (place, c) in &right_terms[from..end] {
            values[first + place] = *c;
        }
        laid.push((row, first, highest));
        from = end;
    }
    values.resize(values.len() + LONG, 0.0);
    let mut sums = vec![0.0; count * stride];
    let mut from = 0;
    for &(left_row, end) in left {
        let terms = &left_terms[from..end];
        from = end;
        for &(right_row, first, highest) in &laid {
            let row = &mut sums[(left_row + right_row) * stride..][..stride];
            for (start, sums) in (0..).step_by(LONG).zip(row.chunks_exact_mut(LONG)) {
                let mut own = [0.0; LONG];
                for &(place, c) in terms {
                    if place < start + LONG && start <= place + highest {
                        let others = &values[first + start - place..][..LONG];
                        for (sum, d) in own.iter_mut().zip(others) {
                            *sum += c * d;
                        }
                    }
                }
                for (sum, own) in sums.iter_mut().zip(own) {
                    *sum += own;
                }
            }
        }
    }
    sums
}

/// Where products of terms are added up by their keys.
enum Sums<C> {
    List(Vec<Term<C>>),
    /// By a hash of the key, all keys being one more than they are; the bits that a hash leaves out.
    Table(Vec<Term<C>>, u32),
    /// At their keys, which are places.
    Places(Vec<C>),
}

impl<C: Wrapping> Sums<C> {
    /// Returns empty sums for so many products.
    fn of(products: usize) -> Self {
        if products <= SORTED {
            return Self::List(Vec::with_capacity(products));
        }
        let bits = (2 * products).next_power_of_two().trailing_zeros();
        Self::Table(vec![(0, C::ZERO); 1 << bits], u64::BITS - bits)
    }

    /// Adds the product of a term with others.
    #[inline]
    fn add(&mut self, (key, c): Term<C>, terms: &[Term<C>]) {
        // The golden ratio, as Knuth proposes.
        const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
        match self {
            Self::List(list) => list.extend(terms.iter().map(|(other, d)| (key + other, product_of(c, *d)))),
            Self::Table(table, left_out) => {
                let mask = table.len() - 1;
                for (other, d) in terms {
                    let key = key + other + 1;
                    let mut place = (key.wrapping_mul(GOLDEN) >> *left_out) as usize;
                    while table[place].0 != key && table[place].0 != 0 {
                        place = (place + 1) & mask;
                    }
                    table[place].0 = key;
                    table[place].1.add_product(c, *d);
                }
            }
            Self::Places(sums) => {
                let sums = &mut sums[key as usize..];
                for (other, d) in terms {
                    sums[*other as usize].add_product(c, *d);
                }
            }
        }
    }

    /// Returns the sums other than zero by decreasing keys, and is empty again.
    fn take(&mut self) -> Vec<Term<C>> {
        match self {
            Self::List(list) => {
                sort(list);
                let mut sums: Vec<Term<C>> = Vec::with_capacity(list.len());
                for (key, c) in list.drain(..) {
                    match sums.last_mut() {
                        Some(last) if last.0 == key => last.1.add_product(c, C::from_wide(1)),
                        _ => sums.push((key, c)),
                    }
                }
                sums.retain(|(_, c)| !c.is_zero());
                sums
            }
            Self::Table(table, _) => {
                let found = table.iter().filter(|(_, c)| !c.is_zero());
                let mut sums: Vec<Term<C>> = found.map(|(key, c)| (key - 1, *c)).collect();
                sort(&mut sums);
                table.fill((0, C::ZERO));
                sums
            }
            Self::Places(sums) => {
                let found = sums.iter().enumerate().rev().filter(|(_, c)| !c.is_zero());
                let terms = found.map(|(key, c)| (key as u64, *c)).collect();
                sums.fill(C::ZERO);
                terms
            }
        }
    }
}

#[inline(always)]
fn product_of<C: Wrapping>(a: C, b: C) -> C {
    let mut product = C::ZERO;
    product.add_product(a, b);
    product
}

/// Sorts terms by decreasing keys.
fn sort<C>(terms: &mut [Term<C>]) {
    terms.sort_unstable_by_key(|term| Reverse(term.0));
}

/// The places of all monomials within some degrees.
struct Places {
    /// For each variable the lowest bit of its field, its stride and its degree.
    variables: Vec<(u32, u64, u64)>,
    count: usize,
}

impl Places {
    /// Returns the places unless they are too many for so many products.
    fn new(packing: Packing, degrees: &[u32], products: usize) -> Option<Self> {
        let most = PLACES.min(products.saturating_mul(PLACES_PER_PRODUCT));
        let (mut variables, mut count) = (Vec::with_capacity(degrees.len()), 1_usize);
        for (variable, &degree) in degrees.iter().enumerate().rev().filter(|(_, degree)| **degree > 0) {
            variables.push((packing.place(variable).1, count as u64, u64::from(degree)));
            count = count.checked_mul(degree as usize + 1).filter(|count| *count <= most)?;
        }
        variables.reverse();
        Some(Self { variables, count })
    }

    /// Returns the terms of a polynomial with their places.
    fn terms(&self, packing: Packing, monomials: &[u64], coefficients: impl Iterator<Item = i64>) -> Vec<Term> {
        monomials.iter().map(|monomial| self.key(packing, *monomial)).zip(coefficients).collect()
    }

    #[inline(always)]
    fn key(&self, packing: Packing, monomial: u64) -> u64 {
        self.variables.iter().map(|&(shift, stride, _)| u64::from(packing.field(monomial, shift)) * stride).sum()
    }

    /// Returns the monomials of places.
    fn monomials<C>(&self, terms: &[Term<C>]) -> Vec<u64> {
        let Some(((shift, _, degree), outer)) = self.variables.split_last() else { return vec![0; terms.len()] };
        let (mut row, mut row_monomial) = (u64::MAX, 0);
        let monomial = |(key, _): &Term<C>| {
            let key = *key;
            // Neighbours differ in the last variable only, mostly.
            let start = row.wrapping_mul(degree + 1);
            if key < start || key > start + degree {
                row = key / (degree + 1);
                let mut rest = row * (degree + 1);
                row_monomial = 0;
                for (shift, stride, _) in outer {
                    row_monomial |= (rest / stride) << shift;
                    rest %= stride;
                }
            }
            row_monomial | (key - row * (degree + 1)) << shift
        };
        terms.iter().map(monomial).collect()
    }
}

/// Returns the product of two polynomials, not zero, with monomials of one word that have room for it: monomials and coefficients; `None` where
/// other ways are faster or a word too short.
pub(super) fn product(
    packing: Packing,
    degrees: &dyn Fn() -> Vec<u32>,
    (left, a): (&[u64], &[i64]),
    (right, b): (&[u64], &[i64]),
) -> Option<(Vec<u64>, Vec<i64>)> {
    let products = left.len() * right.len();
    let bound = bound(a, b);
    if bound >= HALF {
        return None;
    }
    let coefficients = |terms: Vec<Term>| terms.into_iter().map(|term| term.1).collect();
    if products > SORTED
        && bound <= EXACT
        && let Some(places) = Places::new(packing, &degrees(), products)
    {
        let left = places.terms(packing, left, a.iter().copied());
        let right = places.terms(packing, right, b.iter().copied());
        let terms = at_places(&places, &left, &right)?;
        return Some((places.monomials(&terms), coefficients(terms)));
    }
    if products > TABLED {
        return None;
    }
    let mut sums: Sums<i64> = Sums::of(products);
    let terms: Vec<Term> = right.iter().copied().zip(b.iter().copied()).collect();
    left.iter().zip(a).for_each(|(key, c)| sums.add((*key, *c), &terms));
    let terms = sums.take();
    Some((terms.iter().map(|term| term.0).collect(), coefficients(terms)))
}

/// Returns the product as [`product`] does, for integers of any size, all sums being below `2^bits` in absolute value.
pub(super) fn wide_product(
    packing: Packing,
    degrees: &dyn Fn() -> Vec<u32>,
    left: Factor<'_>,
    right: Factor<'_>,
    bits: u32,
) -> Option<(Vec<u64>, Vec<Int>)> {
    // One bit is for the sign.
    let product = match bits {
        ..128 => return wrapped_product(packing, degrees, left, right),
        128..256 => limbs_product::<2, 4>(packing, degrees, left, right),
        256..384 => limbs_product::<3, 6>(packing, degrees, left, right),
        384..512 => limbs_product::<4, 8>(packing, degrees, left, right),
        512..768 => limbs_product::<6, 12>(packing, degrees, left, right),
        _ => None,
    };
    product.or_else(|| long_product(packing, degrees, left, right, bits))
}

/// Returns the product by adding up long integers at the places of their monomials; `None` if these are too many, or if one product of longer
/// integers takes less.
fn long_product(
    packing: Packing,
    degrees: &dyn Fn() -> Vec<u32>,
    (left, a): Factor<'_>,
    (right, b): Factor<'_>,
    bits: u32,
) -> Option<(Vec<u64>, Vec<Int>)> {
    // The nanoseconds for a product of two numbers, and for each product of two of their limbs: measured on a processor of 3 GHz.
    const NUMBER: f64 = 20.0;
    const LIMBS: f64 = 0.8;
    let products = left.len() * right.len();
    let places = Places::new(packing, &degrees(), products)?;
    let limbs = f64::from(bits) / f64::from(u64::BITS);
    // The limbs of a number are half of those of a product; those of a factor are half of those of the whole product.
    let cost = products as f64 * (NUMBER + LIMBS * (limbs / 2.0).powi(2));
    let transform = Transform::new(bits as usize + 2, places.count).map_or(f64::INFINITY, |transform| transform.cost());
    if transform.min(balanced(places.count as f64 / 2.0 * limbs)) < cost {
        return None;
    }
    let place = |monomial: &u64| places.key(packing, *monomial) as usize;
    let right: Vec<usize> = right.iter().map(place).collect();
    let mut sums = vec![Int::zero(); places.count];
    for (monomial, c) in left.iter().zip(a) {
        let sums = &mut sums[place(monomial)..];
        for (other, d) in right.iter().zip(b) {
            sums[*other].add_product(c, d);
        }
    }
    let found = sums.into_iter().enumerate().rev().filter(|(_, c)| !c.is_zero());
    let terms: Vec<Term<Int>> = found.map(|(key, c)| (key as u64, c)).collect();
    Some((places.monomials(&terms), terms.into_iter().map(|term| term.1).collect()))
}

/// Returns the product with sums of two words.
fn wrapped_product(
    packing: Packing,
    degrees: &dyn Fn() -> Vec<u32>,
    (left, a): Factor<'_>,
    (right, b): Factor<'_>,
) -> Option<(Vec<u64>, Vec<Int>)> {
    let products = left.len() * right.len();
    if products > WIDE {
        return None;
    }
    let places = Places::new(packing, &degrees(), products);
    let key = |monomial: &u64| places.as_ref().map_or(*monomial, |places| places.key(packing, *monomial));
    let terms = |monomials: &[u64], integers: &[&Int]| -> Option<Vec<Term<i128>>> {
        monomials.iter().zip(integers).map(|(monomial, c)| Some((key(monomial), c.to_wide()?))).collect()
    };
    let (left, right) = (terms(left, a)?, terms(right, b)?);
    let mut sums = match &places {
        Some(places) => Sums::Places(vec![0; places.count]),
        None if products <= TABLED => Sums::of(products),
        None => return None,
    };
    for term in &left {
        sums.add(*term, &right);
    }
    let terms = sums.take();
    let monomials = places.map_or_else(|| terms.iter().map(|term| term.0).collect(), |places| places.monomials(&terms));
    Some((monomials, terms.into_iter().map(|term| Int::from(term.1)).collect()))
}

/// Returns the product with sums of S limbs, twice as many as the F limbs of a factor; `None` if one has more.
fn limbs_product<const F: usize, const S: usize>(
    packing: Packing,
    degrees: &dyn Fn() -> Vec<u32>,
    (left, a): Factor<'_>,
    (right, b): Factor<'_>,
) -> Option<(Vec<u64>, Vec<Int>)> {
    // The nanoseconds for a product and its place, and for each product of two limbs: measured on a processor of 3 GHz.
    const PRODUCT: f64 = 5.0;
    const PAIR: f64 = 0.9;
    let products = left.len() * right.len();
    let factors = |integers: &[&Int]| integers.iter().map(|c| limbs::Factor::<F>::new(c)).collect::<Option<Vec<_>>>();
    let (a, b) = (factors(a)?, factors(b)?);
    let places = Places::new(packing, &degrees(), products);
    if let Some(places) = &places
        && balanced((places.count * F) as f64) < products as f64 * (PRODUCT + PAIR * (F * F) as f64)
    {
        return None;
    }
    let Some(places) = places else {
        return (products <= TABLED).then(|| scattered_product::<F, S>((left, &a), (right, &b)));
    };
    let mut sums = vec![limbs::Sum::<S>::zero(); places.count];
    let right: Vec<u64> = right.iter().map(|monomial| places.key(packing, *monomial)).collect();
    for (monomial, c) in left.iter().zip(&a) {
        let own = places.key(packing, *monomial);
        for (other, d) in right.iter().zip(&b) {
            sums[(own + other) as usize].add(c, d);
        }
    }
    let found = sums.iter().enumerate().rev().filter(|(_, sum)| !sum.is_zero());
    let terms: Vec<Term<Int>> = found.map(|(place, sum)| (place as u64, sum.to_int())).collect();
    Some((places.monomials(&terms), terms.into_iter().map(|term| term.1).collect()))
}

/// Returns the product of terms that hardly ever meet: all products of monomials are sorted, and sums made one after the other.
fn scattered_product<const F: usize, const S: usize>(
    (left, a): (&[u64], &[limbs::Factor<F>]),
    (right, b): (&[u64], &[limbs::Factor<F>]),
) -> (Vec<u64>, Vec<Int>) {
    // Monomial and places in one integer sort faster than a triple.
    const PLACE: u32 = 32;
    let mut pairs: Vec<u128> = Vec::with_capacity(left.len() * right.len());
    for (i, own) in left.iter().enumerate() {
        for (j, other) in right.iter().enumerate() {
            pairs.push(u128::from(own + other) << 64 | u128::from((i as u64) << PLACE | j as u64));
        }
    }
    pairs.sort_unstable();
    let (mut monomials, mut integers) = (Vec::with_capacity(pairs.len()), Vec::with_capacity(pairs.len()));
    for same in pairs.chunk_by(|one, other| one >> 64 == other >> 64).rev() {
        let mut sum = limbs::Sum::<S>::zero();
        for pair in same {
            sum.add(&a[(*pair as u64 >> PLACE) as usize], &b[*pair as u32 as usize]);
        }
        if !sum.is_zero() {
            monomials.push((same[0] >> 64) as u64);
            integers.push(sum.to_int());
        }
    }
    (monomials, integers)
}

/// Returns the determinant of a square matrix by its minors; `None` if it has too many rows or terms for this, or a word is too short.
pub(super) fn determinant(rows: &[Vec<Polynomial<Int>>]) -> Option<Polynomial<Int>> {
    let size = rows.len();
    if !(2..=LARGEST_MATRIX).contains(&size) {
        return None;
    }
    let entries = || rows.iter().flatten();
    let packing = entries().map(|entry| entry.packing).max_by_key(Packing::variables)?;
    let fits =
        |entry: &Polynomial<Int>| packing.agrees(&entry.packing) || entry.monomials.iter().all(|&word| word == 0);
    if packing.words() != 1 || !entries().all(fits) {
        return None;
    }
    // Whether the products of monomials fit a word, and how long the sums of all products of coefficients may be.
    let (mut outline, mut bits, mut count) = (0, 0, 0);
    let mut bound = 1_u128;
    for row in rows {
        let (mut own, mut sum) = (0, 0_u128);
        for entry in row {
            own = entry.monomials.iter().fold(own, |or, word| or | word);
            for c in &entry.coefficients {
                sum = sum.saturating_add(c.to_wide()?.unsigned_abs());
            }
            count += entry.len();
        }
        // Minors without a row that is zero have sums, too.
        (outline, bound) = (outline + own, bound.saturating_mul(sum.max(1)));
        bits += u128::BITS - sum.leading_zeros();
        if outline & packing.guards() != 0 {
            return None;
        }
    }
    // The products of the last step, most of all, were no two terms of a minor alike, and those of all steps.
    let average = count.div_ceil(size * size);
    let (mut products, mut all) = (1_usize, 0_usize);
    for left in (1..=size).rev() {
        products = products.saturating_mul(left * average);
        all = all.saturating_add(products);
    }
    if products > SORTED && bound <= EXACT {
        let places = Places::new(packing, &self::degrees(rows, packing), all >> size);
        if let Some(places) = places.filter(|places| products.min(size * average * places.count) <= MATRIX_PRODUCTS) {
            let terms = Arch::new().dispatch(
                #[inline(always)]
                || minors_at_places(rows, packing, &places),
            );
            return Some(polynomial(packing, places.monomials(&terms), terms));
        }
    }
    if products > TABLED {
        return None;
    }
    // One bit is for the sign.
    match bits {
        _ if bound < HALF => minors_by_sums::<i64>(rows, packing),
        ..128 => minors_by_sums::<i128>(rows, packing),
        128..192 => minors_by_sums::<Wide<3>>(rows, packing),
        192..256 => minors_by_sums::<Wide<4>>(rows, packing),
        _ => None,
    }
}

/// Returns the determinant from minors whose terms are added up by their keys.
fn minors_by_sums<C: Wrapping>(rows: &[Vec<Polynomial<Int>>], packing: Packing) -> Option<Polynomial<Int>> {
    let size = rows.len();
    let (mut few, mut minors) = (Sums::<C>::of(0), vec![Vec::new(); 1 << size]);
    for set in sets(size) {
        if set.is_power_of_two() {
            let entry = &rows[size - 1][set.trailing_zeros() as usize];
            minors[set] = entry.monomials.iter().copied().zip(entry.coefficients.iter().map(element)).collect();
            continue;
        }
        let mut products = 0;
        expand(rows, set, |entry, _, rest| products += entry.len() * minors[rest].len());
        let mut many = (products > SORTED).then(|| Sums::of(products));
        let sums = many.as_mut().unwrap_or(&mut few);
        expand(rows, set, |entry, sign, rest| {
            for (key, c) in entry.monomials.iter().zip(&entry.coefficients) {
                let c = element::<C>(c);
                sums.add((*key, if sign < 0 { c.negative() } else { c }), &minors[rest]);
            }
        });
        minors[set] = sums.take();
    }
    let terms = minors.pop()?;
    Some(polynomial(packing, terms.iter().map(|term| term.0).collect(), terms))
}

/// Returns an integer, which is known to be of few words.
#[inline(always)]
fn element<C: Wrapping>(c: &Int) -> C {
    wrapped(c).unwrap_or(C::ZERO)
}

fn polynomial<C: Wrapping>(packing: Packing, monomials: Vec<u64>, terms: Vec<Term<C>>) -> Polynomial<Int> {
    Polynomial { packing, monomials, coefficients: terms.into_iter().map(|term| term.1.to_ring()).collect() }
}

/// Returns the sets of columns other than the empty one, those of fewer columns first.
fn sets(size: usize) -> impl Iterator<Item = usize> {
    (1..=size).flat_map(move |count| (1..1_usize << size).filter(move |set| set.count_ones() as usize == count))
}

/// Passes what the minor of the lowest rows in these columns is the sum of: entries with signs, and the columns of the minors they are
/// multiplied by.
#[inline(always)]
fn expand(rows: &[Vec<Polynomial<Int>>], set: usize, mut take: impl FnMut(&Polynomial<Int>, i64, usize)) {
    let row = &rows[rows.len() - set.count_ones() as usize];
    let mut sign = 1;
    for (column, entry) in row.iter().enumerate().filter(|(column, _)| set >> column & 1 == 1) {
        take(entry, sign, set & !(1 << column));
        sign = -sign;
    }
}

/// Returns the terms of the determinant with their places.
#[inline(always)]
fn minors_at_places(rows: &[Vec<Polynomial<Int>>], packing: Packing, places: &Places) -> Vec<Term> {
    let mut minors: Vec<Laid> = Vec::new();
    minors.resize_with(1 << rows.len(), Laid::default);
    minors[0] = Laid::new(&[(0, 1)]);
    let mut sums = vec![0.0; places.count];
    for set in sets(rows.len()) {
        sums.fill(0.0);
        expand(rows, set, |entry, sign, rest| {
            for (monomial, c) in entry.monomials.iter().zip(&entry.coefficients) {
                minors[rest].add((places.key(packing, *monomial), sign * c.to_i64().unwrap_or(0)), &mut sums);
            }
        });
        minors[set] = Laid::new(&taken(&sums, sums.len(), sums.len()));
    }
    taken(&sums, sums.len(), sums.len())
}

/// Returns bounds of the degrees of a determinant: of each row the highest ones, added up.
fn degrees(rows: &[Vec<Polynomial<Int>>], packing: Packing) -> Vec<u32> {
    let highest =
        |row: &Vec<Polynomial<Int>>, variable| row.iter().map(|entry| entry.degree(variable)).max().unwrap_or(0);
    (0..packing.variables()).map(|variable| rows.iter().map(|row| highest(row, variable)).sum()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::determinant::bareiss;
    use proptest::prelude::*;
    use rug::Integer;

    type Poly = Polynomial<Int>;

    fn polynomials(variables: usize, degree: u32, terms: usize, largest: i64) -> impl Strategy<Value = Poly> {
        let term = (prop::collection::vec(0..=degree, variables), -largest..=largest);
        prop::collection::vec(term, 0..=terms)
            .prop_map(|terms| Poly::from_terms(terms.into_iter().map(|(e, c)| (e, Int::from(c)))))
    }

    /// Returns the bits of a bound of the sums.
    fn bound_of(f: &Poly, g: &Poly) -> u32 {
        let sum = |f: &Poly| f.coefficients().iter().map(|c| c.to_integer().abs()).sum::<Integer>().significant_bits();
        sum(f) + sum(g)
    }

    /// Returns the product by distribution.
    fn distributed(f: &Poly, g: &Poly) -> Poly {
        let row = |(exponents, c): (Vec<u32>, &Int)| {
            g.terms()
                .map(|(others, d)| {
                    let sum = |v: usize| exponents.get(v).unwrap_or(&0) + others.get(v).unwrap_or(&0);
                    ((0..exponents.len().max(others.len())).map(sum).collect::<Vec<u32>>(), c.mul(d))
                })
                .collect::<Vec<_>>()
        };
        Poly::from_terms(f.terms().flat_map(row))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn short_products_are_those_by_distribution(
            (f, g) in (1..6_usize, 0..7_u32, 1..40_usize, prop::sample::select(vec![1, 9, 1 << 28, i64::MAX]))
                .prop_flat_map(|(v, d, n, c)| (polynomials(v, d, n, c), polynomials(v.max(2) - 1, d + 1, n, c)))
        ) {
            let expected = distributed(&f, &g);
            prop_assert_eq!(&f.mul(&g), &expected);
            // With coefficients of several words.
            for shift in [0, 40, 100, 200, 280, 400] {
                let factor = Int::from(Integer::from(1) << shift);
                let (f, g) = (f.scale(&factor), g.scale(&factor));
                let packing = Packing::new(f.variables().max(g.variables()), 2 * f.largest_exponent().max(g.largest_exponent()));
                prop_assume!(packing.words() == 1 && !f.is_zero() && !g.is_zero());
                let (left, right) = (f.packed_as(packing), g.packed_as(packing));
                let degrees = || (0..packing.variables()).map(|v| f.degree(v) + g.degree(v)).collect();
                for bits in [2 * shift + 64 + 12, 2 * shift + 128] {
                    let (a, b): (Vec<&Int>, Vec<&Int>) = (f.coefficients().iter().collect(), g.coefficients().iter().collect());
                    let product = wide_product(packing, &degrees, (&left, &a), (&right, &b), bits);
                    if let Some((monomials, coefficients)) = product && (bits > 2 * shift + 100 || bound_of(&f, &g) < bits) {
                        let product = Poly { packing, monomials, coefficients };
                        prop_assert_eq!(product, expected.scale(&factor).scale(&factor));
                    }
                }
            }
        }

        #[test]
        fn determinants_by_short_minors_are_those_without_fractions(
            rows in (2..5_usize, 1..5_usize, 1..4_u32, 0..6_usize, prop::sample::select(vec![1, 9, 1 << 14, i64::MAX]))
                .prop_flat_map(|(size, v, d, n, c)| {
                    prop::collection::vec(prop::collection::vec(polynomials(v, d, n, c), size), size)
                })
        ) {
            if let Some(found) = determinant(&rows) {
                prop_assert_eq!(found, bareiss(&rows));
            }
        }
    }

    #[test]
    fn determinants_of_symbols_are_found_here() {
        for size in 2..=3 {
            let symbol = |i: usize| Poly::variable(8).mul(&Poly::variable(i % 9));
            let rows: Vec<Vec<Poly>> = (0..size).map(|i| (0..size).map(|j| symbol(3 * i + j)).collect()).collect();
            assert_eq!(determinant(&rows), Some(bareiss(&rows)));
        }
    }
}
