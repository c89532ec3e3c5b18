//! The number of solutions of a loop in any geometry: the dimension of the ring of polynomials on its solution set.
//!
//! Unknown 6 of a cut is a rotation about z and turns no line along z, so the first five unknowns solve the 14 equations
//! of lines with a marked point, `T(V4 G4 V5 G5) z = T((G6 V1 G1 V2 G2 V3 G3)^-1) z`, and fix the sixth one. Modulo these
//! equations (and `cos^2 + sin^2 = 1`, by which no power of a sine above the first occurs) all polynomials in the five
//! unknowns form a ring. If every monomial is a combination of finitely many of them, their number bounds the number of
//! solutions, with multiplicity. It counts no root at infinity, at a half tangent of i, or of a polynomial that uses only part of
//! the equations: once all consequences of the equations are known, it is the number of solutions. \[CoxLittleOShea2015\]
//!
//! The relations between monomials up to some degree are found by linear algebra: relations times an unknown are
//! relations, as long as they stay below that degree. When the monomials that are left over all have a smaller degree,
//! an unknown times one of them is again a combination of them, and the solutions are the eigenvectors of such products.
//!
//! The products that lead to new relations are found once, modulo a prime; the same ones are then formed in other numbers.

mod contradiction;

use super::cut::Cut;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use crate::closure::woernle_lee::{MarkedLine, SIZE, act, left_columns, right_columns, split, split_inverse};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use std::collections::{BTreeMap, HashMap};

/// Powers of the five unknowns, a byte each: twice the power of the cosine and the power of the sine (0 or 1), or twice
/// the power of a distance.
type Monomial = u64;
/// Coefficients by monomials.
type Sparse<F> = BTreeMap<Monomial, F>;

/// Degrees up to which relations are looked for; the first one that suffices is used.
const DEGREES: [u32; 2] = [3, 4];

/// The number m in the half-angle tangent of a matrix: large, so that it is not minus the inverse of a tangent by chance.
const MIXED: i32 = 1_234_577;

fn digit(monomial: Monomial, unknown: usize) -> u64 {
    (monomial >> (8 * unknown)) & 255
}

fn degree(monomial: Monomial) -> u32 {
    (0..5).map(|k| digit(monomial, k)).map(|d| u32::try_from(d / 2 + d % 2).unwrap_or(u32::MAX)).sum()
}

/// `(1, cos, sin)` or `(1, d, d^2)` of an unknown.
fn factors(variable: Variable, unknown: usize) -> [Monomial; 3] {
    let last = if variable == Variable::Rotation { 1 } else { 4 };
    [0, 2, last].map(|power| power << (8 * unknown))
}

/// A polynomial times the cosine or the sine of an unknown, or a distance.
fn times<F: Field>(polynomial: &[(Monomial, F)], unknown: usize, is_sine: bool) -> Sparse<F> {
    let mut product = Sparse::new();
    let mut add = |monomial: Monomial, c: F| {
        let entry = product.entry(monomial).or_insert_with(F::zero);
        *entry = entry.add(&c);
    };
    let (cos, sin) = (2 << (8 * unknown), 1 << (8 * unknown));
    for (monomial, c) in polynomial {
        match (is_sine, digit(*monomial, unknown) % 2) {
            (false, _) => add(monomial + cos, c.clone()),
            (true, 0) => add(monomial + sin, c.clone()),
            // sin^2 = 1 - cos^2
            (true, _) => {
                add(monomial - sin, c.clone());
                add(monomial - sin + 2 * cos, c.neg());
            }
        }
    }
    product
}

/// The equations of a loop whose last unknown is a rotation.
fn equations<F: Field>(closed: &ClosedLoop<F>) -> Vec<Sparse<F>> {
    let kinds = closed.variables;
    let at = |unknown: usize| factors(kinds[unknown], unknown);
    let left: Vec<(Monomial, MarkedLine<F>)> =
        left_columns(closed).into_iter().enumerate().map(|(k, line)| (at(4)[k / 3] + at(3)[k % 3], line)).collect();
    let back = [1, 2].map(|k| closed.constants[k].inverse());
    let mut right = Vec::new();
    for (first, lines) in at(0).into_iter().zip(right_columns(closed)) {
        for (second, line) in at(1).into_iter().zip(lines) {
            right.push((first + second, act(&back[0], &line)));
        }
    }
    // Unknown 3 on either side: the same equations, but other combinations of low degree.
    let near = right.iter().flat_map(|(m, line)| {
        let parts = split_inverse(kinds[2], line).map(|part| act(&back[1], &part));
        at(2).map(|third| third + m).into_iter().zip(parts).collect::<Vec<_>>()
    });
    let far = left.iter().flat_map(|(m, line)| {
        let parts = split(kinds[2], &act(&closed.constants[2], line));
        at(2).map(|third| third + m).into_iter().zip(parts).collect::<Vec<_>>()
    });
    let difference = |plus: &[(Monomial, MarkedLine<F>)], minus: &[(Monomial, MarkedLine<F>)], i: usize| {
        let mut sum = Sparse::new();
        for (monomial, line) in plus {
            let entry = sum.entry(*monomial).or_insert_with(F::zero);
            *entry = entry.add(&line[i]);
        }
        for (monomial, line) in minus {
            let entry = sum.entry(*monomial).or_insert_with(F::zero);
            *entry = entry.sub(&line[i]);
        }
        sum
    };
    let (near, far): (Vec<_>, Vec<_>) = (near.collect(), far.collect());
    (1..SIZE).flat_map(|i| [difference(&left, &near, i), difference(&far, &right, i)]).collect()
}

/// A polynomial with some unknowns, of a loop with these, at zero.
fn at_zero<F: Field>(polynomial: Sparse<F>, kinds: &[Variable], is_zero: [bool; 5]) -> Sparse<F> {
    let mut rest = Sparse::new();
    'terms: for (mut monomial, c) in polynomial {
        for unknown in (0..5).filter(|k| is_zero[*k]) {
            let power = digit(monomial, unknown);
            let vanishes = if kinds[unknown] == Variable::Rotation { power % 2 == 1 } else { power > 0 };
            if vanishes {
                continue 'terms;
            }
            monomial -= power << (8 * unknown);
        }
        let entry = rest.entry(monomial).or_insert_with(F::zero);
        *entry = entry.add(&c);
    }
    rest
}

/// The monomials in unknowns that are not zero up to a degree, highest first.
fn monomials(kinds: &[Variable; 5], is_zero: [bool; 5], most: u32) -> Vec<Monomial> {
    let mut all: Vec<Monomial> = vec![0];
    for (unknown, kind) in kinds.iter().enumerate().filter(|(k, _)| !is_zero[*k]) {
        let powers: Vec<Monomial> =
            (0..=u64::from(2 * most)).filter(|d| *kind == Variable::Rotation || d % 2 == 0).collect();
        let longer = |m: &Monomial| powers.iter().map(|d| m + (d << (8 * unknown))).collect::<Vec<_>>();
        all = all.iter().flat_map(longer).filter(|m| degree(*m) <= most).collect();
    }
    sort::by_key(&mut all, |m| (std::cmp::Reverse(degree(*m)), *m));
    all
}

/// Where a relation comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// An equation of the loop.
    Equation(usize),
    /// The relation of a leading column, times the cosine or the sine of an unknown, or its distance.
    Product { column: usize, unknown: usize, is_sine: bool },
}

/// Relations between the monomials up to a degree, in echelon form.
struct Relations<F> {
    kinds: [Variable; 5],
    /// Unknowns that are zero.
    is_zero: [bool; 5],
    most: u32,
    columns: Vec<Monomial>,
    places: HashMap<Monomial, usize>,
    /// By the column of the leading coefficient, which is 1: the coefficients from there on.
    rows: Vec<Option<Vec<F>>>,
}

impl<F: Field> Relations<F> {
    fn new(kinds: [Variable; 5], is_zero: [bool; 5], most: u32) -> Self {
        let columns = monomials(&kinds, is_zero, most);
        let places = columns.iter().enumerate().map(|(k, m)| (*m, k)).collect();
        let rows = columns.iter().map(|_| None).collect();
        Self { kinds, is_zero, most, columns, places, rows }
    }

    /// Reduces a relation by those already known, up to column `known` where everything before that column is known to cancel.
    /// `None` for zero, and for a relation of too high a degree.
    fn reduced(&self, relation: &Sparse<F>, known: Option<usize>) -> Option<(usize, Vec<F>)> {
        let mut row = vec![F::zero(); self.columns.len()];
        for (monomial, c) in relation.iter().filter(|(_, c)| !c.is_zero()) {
            row[*self.places.get(monomial)?] = c.clone();
        }
        for column in 0..row.len() {
            if known == Some(column) {
                return Some((column, row));
            }
            if row[column].is_zero() {
                continue;
            }
            match (&self.rows[column], known) {
                (Some(pivot), _) => {
                    let factor = row[column].neg();
                    for (x, p) in row[column..].iter_mut().zip(pivot).filter(|(_, p)| !p.is_zero()) {
                        x.add_product(&factor, p);
                    }
                }
                (None, None) => return Some((column, row)),
                // Rounding of zero; or not zero, but divisible by the prime of the plan.
                (None, Some(_)) if F::PIVOT_ZERO > 0.0 => {}
                (None, Some(_)) => return None,
            }
        }
        None
    }

    /// Takes in a reduced relation; `false` where its leading coefficient has no inverse.
    fn take(&mut self, column: usize, row: &[F]) -> bool {
        let Some(inverse) = row[column].inverse() else { return false };
        let mut row: Vec<F> = row[column..].iter().map(|x| x.mul(&inverse)).collect();
        row[0] = F::one();
        self.rows[column] = Some(row);
        true
    }

    /// A relation times the cosine or the sine of an unknown, or its distance.
    fn product(&self, column: usize, unknown: usize, is_sine: bool) -> Option<Sparse<F>> {
        let row = self.rows[column].as_ref()?.iter().zip(&self.columns[column..]);
        let terms: Vec<(Monomial, F)> = row.filter(|(c, _)| !c.is_zero()).map(|(c, m)| (*m, c.clone())).collect();
        Some(times(&terms, unknown, is_sine))
    }

    /// The relation of a source.
    fn relation(&self, equations: &[Sparse<F>], source: Source) -> Option<Sparse<F>> {
        match source {
            Source::Equation(k) => equations.get(k).cloned(),
            Source::Product { column, unknown, is_sine } => self.product(column, unknown, is_sine),
        }
    }

    /// Returns the monomials that lead no relation, if all are of lower degree.
    fn standard(&self) -> Option<Vec<usize>> {
        let left: Vec<usize> = (0..self.columns.len()).filter(|&k| self.rows[k].is_none()).collect();
        left.iter().all(|&k| degree(self.columns[k]) < self.most).then_some(left)
    }

    /// Returns the factors that may multiply a relation: each unknown, and whether its sine.
    fn factors(&self) -> impl Iterator<Item = (usize, bool)> {
        let both = |unknown: usize, kind: Variable| {
            let sines: &[bool] = if kind == Variable::Rotation { &[false, true] } else { &[false] };
            sines.iter().map(move |is_sine| (unknown, *is_sine))
        };
        let unknowns = self.kinds.into_iter().enumerate().filter(|(unknown, _)| !self.is_zero[*unknown]);
        unknowns.flat_map(move |(unknown, kind)| both(unknown, kind))
    }
}

/// A plan of the products by which the relations of a loop follow from its equations.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Unknowns that are zero.
    is_zero: [bool; 6],
    most: u32,
    /// The relations that lead to new ones, each with its leading column at that step.
    steps: Vec<(Source, usize)>,
    count: usize,
}

impl Plan {
    /// Returns the plan of a loop over an exact field; `None` where solutions form families, or where only relations of a higher
    /// degree would show that they do not.
    #[must_use]
    pub fn of<F: Field>(closed: &ClosedLoop<F>) -> Option<Self> {
        Self::at_zero(closed, [false; 6])
    }

    /// As [`Plan::of`] for the solutions at which the marked unknowns are zero; there may be none.
    #[must_use]
    pub fn at_zero<F: Field>(closed: &ClosedLoop<F>, is_zero: [bool; 6]) -> Option<Self> {
        let setting = Setting::of(closed, is_zero)?;
        DEGREES.iter().find_map(|&most| Self::up_to(most, &setting, is_zero))
    }

    fn up_to<F: Field>(most: u32, setting: &Setting<F>, is_zero: [bool; 6]) -> Option<Self> {
        let equations = &setting.equations;
        let mut relations = setting.relations(most);
        let mut steps = Vec::new();
        // Relations not multiplied yet.
        let mut fresh = Vec::new();
        let mut offer = |relations: &mut Relations<F>, fresh: &mut Vec<usize>, source: Source| {
            let reduced = relations.relation(equations, source).and_then(|relation| relations.reduced(&relation, None));
            if let Some((column, row)) = reduced
                && relations.take(column, &row)
            {
                fresh.push(column);
                steps.push((source, column));
            }
        };
        for k in 0..equations.len() {
            offer(&mut relations, &mut fresh, Source::Equation(k));
        }
        // Low degrees first.
        while let Some(best) = (0..fresh.len()).max_by_key(|&k| fresh[k]) {
            let column = fresh.swap_remove(best);
            if degree(relations.columns[column]) < most {
                for (unknown, is_sine) in relations.factors().collect::<Vec<_>>() {
                    offer(&mut relations, &mut fresh, Source::Product { column, unknown, is_sine });
                }
            }
        }
        let count = relations.standard()?.len();
        Some(Self { is_zero, most, steps, count })
    }

    /// Returns an upper bound on the number of solutions, with multiplicity: the number itself, unless only relations of a higher
    /// degree would show it.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the ring of the same loop in another field; `None` where a pivot vanishes that should not.
    #[must_use]
    pub fn ring<F: Field>(&self, closed: &ClosedLoop<F>) -> Option<CoordinateRing<F>> {
        self.ring_within(closed, |_| true)
    }

    /// As [`Plan::ring`], as long as every relation, reduced, is taken by `may_go_on`; `None` from then on.
    #[must_use]
    pub fn ring_within<F: Field>(
        &self,
        closed: &ClosedLoop<F>,
        mut may_go_on: impl FnMut(&[F]) -> bool,
    ) -> Option<CoordinateRing<F>> {
        let setting = Setting::of(closed, self.is_zero)?;
        let mut relations = setting.relations(self.most);
        for (source, column) in &self.steps {
            let relation = relations.relation(&setting.equations, *source)?;
            let (column, row) = relations.reduced(&relation, Some(*column))?;
            if !may_go_on(&row) || !relations.take(column, &row) {
                return None;
            }
        }
        let standard = relations.standard()?;
        let n = standard.len();
        let mut normal: Vec<Vec<F>> = vec![Vec::new(); relations.columns.len()];
        for column in (0..normal.len()).rev() {
            let mut sum = vec![F::zero(); n];
            match &relations.rows[column] {
                None => sum[standard.binary_search(&column).ok()?] = F::one(),
                Some(row) => {
                    for (c, other) in row.iter().zip(&normal[column..]).skip(1).filter(|(c, _)| !c.is_zero()) {
                        let c = c.neg();
                        sum.iter_mut().zip(other).for_each(|(x, y)| x.add_product(&c, y));
                    }
                }
            }
            normal[column] = sum;
        }
        let Setting { rotation, closed, .. } = setting;
        Some(CoordinateRing { rotation, closed, relations, standard, normal })
    }
}

/// A loop in the form in which its ring is computed.
struct Setting<F> {
    /// The number of unknowns moved from the head to the tail.
    rotation: usize,
    closed: ClosedLoop<F>,
    /// Marks those of the first five unknowns that are zero.
    is_zero: [bool; 5],
    equations: Vec<Sparse<F>>,
}

impl<F: Field> Setting<F> {
    fn of(closed: &ClosedLoop<F>, is_zero: [bool; 6]) -> Option<Self> {
        let (rotation, closed) = turned(closed, is_zero)?;
        let is_zero: [bool; 5] = std::array::from_fn(|k| is_zero[(rotation + k) % 6]);
        let all = equations(&closed).into_iter();
        let equations = all.map(|equation| at_zero(equation, &closed.variables, is_zero)).collect();
        Some(Self { rotation, closed, is_zero, equations })
    }

    fn relations(&self, most: u32) -> Relations<F> {
        Relations::new(std::array::from_fn(|k| self.closed.variables[k]), self.is_zero, most)
    }
}

/// Returns the loop with a rotation that is not zero as its last unknown, and the number of unknowns moved from the head to the
/// tail for that.
fn turned<F: Ring>(closed: &ClosedLoop<F>, is_zero: [bool; 6]) -> Option<(usize, ClosedLoop<F>)> {
    let last = (0..6).rev().find(|&k| closed.variables[k] == Variable::Rotation && !is_zero[k])?;
    let rotation = (last + 1) % 6;
    Some((rotation, Cut { rotation, reversed: false }.of(closed)))
}

/// Multiplies a row of coordinates by a product whose row k belongs to basis element k.
fn applied<F: Field>(vector: &[F], product: &[Vec<F>]) -> Vec<F> {
    let mut sum = vec![F::zero(); vector.len()];
    for (c, row) in vector.iter().zip(product).filter(|(c, _)| !c.is_zero()) {
        sum.iter_mut().zip(row).for_each(|(x, y)| x.add_product(c, y));
    }
    sum
}

/// One product after another.
fn multiplied<F: Field>(first: &[Vec<F>], second: &[Vec<F>]) -> Vec<Vec<F>> {
    first.iter().map(|row| applied(row, second)).collect()
}

fn sum_of<F: Field>(one: &[F], other: &[F]) -> Vec<F> {
    one.iter().zip(other).map(|(x, y)| x.add(y)).collect()
}

/// The ring of polynomials on the solutions of a loop: all of them by a basis of monomials.
pub struct CoordinateRing<F> {
    rotation: usize,
    closed: ClosedLoop<F>,
    relations: Relations<F>,
    /// The basis, by columns of the relations.
    standard: Vec<usize>,
    /// All monomials in terms of the basis.
    normal: Vec<Vec<F>>,
}

impl<F: Field> CoordinateRing<F> {
    /// A polynomial in terms of the basis.
    fn normal(&self, polynomial: &Sparse<F>) -> Vec<F> {
        let mut sum = vec![F::zero(); self.standard.len()];
        for (monomial, c) in polynomial {
            let normal = &self.normal[self.relations.places[monomial]];
            sum.iter_mut().zip(normal).for_each(|(x, y)| x.add_product(c, y));
        }
        sum
    }

    /// Returns the product with a combination of cosines, sines and distances of the unknowns, with these weights in turn; row k
    /// belongs to basis element k. The values of the basis at a solution are an eigenvector, and the value of the combination is
    /// its eigenvalue.
    #[must_use]
    pub fn multiplication(&self, weights: &[F; 10]) -> Vec<Vec<F>> {
        let row = |&column: &usize| {
            let element = [(self.relations.columns[column], F::one())];
            let mut sum = vec![F::zero(); self.standard.len()];
            for ((unknown, is_sine), weight) in self.relations.factors().zip(weights) {
                let product = self.normal(&times(&element, unknown, is_sine));
                sum.iter_mut().zip(&product).for_each(|(x, y)| x.add_product(weight, y));
            }
            sum
        };
        self.standard.iter().map(row).collect()
    }

    /// Returns matrices A and B with `det(A + t B) = 0` where t is the half-angle tangent of an unknown at a solution, or the
    /// distance itself. Each solution counts with its multiplicity; solutions at the angle pi are at infinity.
    ///
    /// `place` is its place among the first five unknowns of [`Self::view`].
    #[must_use]
    pub fn tangent_pencil(&self, place: usize) -> [Vec<Vec<F>>; 2] {
        let n = self.standard.len();
        // Cosine and sine, or the distance, as matrices.
        let weight = |k: usize| if self.relations.kinds[k] == Variable::Rotation { 2 } else { 1 };
        let first: usize = (0..place).map(weight).sum();
        let matrix = |at: usize| self.multiplication(&std::array::from_fn(|k| F::from_integer(i32::from(k == at))));
        let sum = |unit: i32, terms: &[(&[Vec<F>], i32)]| -> Vec<Vec<F>> {
            let entry = |i: usize, j: usize| {
                let start = F::from_integer(if i == j { unit } else { 0 });
                let add = |sum: F, (m, c): &(&[Vec<F>], i32)| sum.add(&m[i][j].mul(&F::from_integer(*c)));
                terms.iter().fold(start, add)
            };
            (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
        };
        match self.relations.kinds[place] {
            // t = sin/(1 + cos) = (1 - cos)/sin = (sin + m (1 - cos))/(1 + cos + m sin), 0/0 at one angle only.
            Variable::Rotation => {
                let (cos, sin) = (matrix(first), matrix(first + 1));
                [sum(-MIXED, &[(&sin, -1), (&cos, MIXED)]), sum(1, &[(&cos, 1), (&sin, MIXED)])]
            }
            Variable::Translation => [sum(0, &[(&matrix(first), -1)]), sum(1, &[])],
        }
    }

    /// Returns whether the dimension of this ring equals the number of solutions in this field, with multiplicity, and does not
    /// only bound it: the products with the unknowns commute, the closure equations hold for them, and 1 generates the ring.
    ///
    /// Such matrices make the vectors a module over all polynomials that 1 generates and in which the equations vanish: a
    /// quotient of the ring of the solutions, which has no larger dimension than the basis that spans it.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        if self.relations.is_zero.contains(&true) {
            return false;
        }
        let factors: Vec<(usize, bool)> = self.relations.factors().collect();
        let weights = |k: usize| std::array::from_fn(|j| F::from_integer(i32::from(j == k)));
        let products: Vec<Vec<Vec<F>>> = (0..factors.len()).map(|k| self.multiplication(&weights(k))).collect();
        let commute = (0..products.len())
            .all(|k| (0..k).all(|j| multiplied(&products[j], &products[k]) == multiplied(&products[k], &products[j])));
        let product = |unknown: usize, is_sine: bool| {
            let place = factors.iter().position(|factor| *factor == (unknown, is_sine));
            place.map(|place| &products[place])
        };
        let unit = |k: usize| (0..self.standard.len()).map(|j| F::from_integer(i32::from(j == k))).collect::<Vec<F>>();
        let on_circle = (0..5).filter(|&k| self.relations.kinds[k] == Variable::Rotation).all(|k| {
            let squares = [false, true].map(|is_sine| product(k, is_sine).map(|m| multiplied(m, m)));
            let [Some(cos), Some(sin)] = squares else { return false };
            (0..self.standard.len()).all(|i| sum_of(&cos[i], &sin[i]) == unit(i))
        });
        let (one, _) = self.unknowns();
        let value = |monomial: Monomial| {
            let mut vector = one.clone();
            for unknown in 0..5 {
                let power = digit(monomial, unknown);
                for _ in 0..power / 2 {
                    vector = applied(&vector, product(unknown, false)?);
                }
                if power % 2 == 1 {
                    vector = applied(&vector, product(unknown, true)?);
                }
            }
            Some(vector)
        };
        let vanishes = |equation: &Sparse<F>| {
            let mut sum = vec![F::zero(); self.standard.len()];
            for (monomial, c) in equation {
                let Some(vector) = value(*monomial) else { return false };
                sum.iter_mut().zip(&vector).for_each(|(x, y)| x.add_product(c, y));
            }
            sum.iter().all(F::is_zero)
        };
        let generates = |(k, column): (usize, &usize)| value(self.relations.columns[*column]) == Some(unit(k));
        commute
            && on_circle
            && equations(&self.closed).iter().all(vanishes)
            && self.standard.iter().enumerate().all(generates)
    }

    /// Returns the index of the original unknown that is first here, and the loop as the ring reads it.
    #[must_use]
    pub fn view(&self) -> (usize, &ClosedLoop<F>) {
        (self.rotation, &self.closed)
    }

    /// Returns the monomial 1 in terms of the basis, then cosine and sine, or the distance and 0, of the first five unknowns.
    #[must_use]
    pub fn unknowns(&self) -> (Vec<F>, [[Vec<F>; 2]; 5]) {
        let one = [(0, F::one())];
        let at = |unknown: usize, is_sine: bool| self.normal(&times(&one, unknown, is_sine));
        let nought = || vec![F::zero(); self.standard.len()];
        let pair = |unknown: usize| match self.relations.kinds[unknown] {
            Variable::Rotation if self.relations.is_zero[unknown] => {
                [self.normal(&one.iter().cloned().collect()), nought()]
            }
            Variable::Translation if self.relations.is_zero[unknown] => [nought(), nought()],
            Variable::Rotation => [at(unknown, false), at(unknown, true)],
            Variable::Translation => [at(unknown, false), nought()],
        };
        (self.normal(&one.iter().cloned().collect()), std::array::from_fn(pair))
    }
}
