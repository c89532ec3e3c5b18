//! Isolation of the real roots of a square-free integer polynomial by Descartes' rule on dyadic cells.
//!
//! Cells are halved until the sign changes of the Bernstein coefficients say none or one. Bits are taken as they are
//! needed: 256 for all, more for a cell where they do not suffice. A cluster of m roots keeps m sign changes while its
//! cell shrinks; a Newton step for an m-fold root then guesses a far smaller cell, which is taken if it has all m.

use super::bernstein::{Expansion, Source, length};
use super::cell::{Cell, sign, sign_at};
use super::fixed::{Fixed, Wide};
use rug::Integer;
use std::mem;

/// The precision at which the search beyond 256 bits starts, and the longest leap, in bits.
const FIRST_PRECISION: i64 = 256;
const LONGEST_LEAP: u32 = 1 << 20;

/// Where one root is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Exactly at `numerator 2^exponent`.
    At(Integer, i64),
    /// Alone inside a cell, the polynomial having this sign in the cell left of the root.
    Within(Cell, i8),
}

impl Place {
    /// The place of the root of `p(-x)` that belongs to this root of `p(x)`.
    fn mirrored(self) -> Self {
        match self {
            Self::At(numerator, exponent) => Self::At(-numerator, exponent),
            Self::Within(cell, sign) => Self::Within(cell.mirrored(), -sign),
        }
    }
}

/// The places of all real roots of a square-free polynomial that does not vanish at 0, from left to right.
pub(super) fn isolate(coefficients: Vec<Integer>) -> Vec<Place> {
    let source = Source::new(coefficients);
    let negative = positive_roots(&source.mirrored());
    let mut places: Vec<Place> = negative.into_iter().rev().map(Place::mirrored).collect();
    places.extend(positive_roots(&source));
    places
}

/// The places of the positive roots.
fn positive_roots(source: &Source) -> Vec<Place> {
    let mut search = Search { source, places: Vec::new() };
    if let Some(k) = bound(source).and_then(|k| skip_empty(source, k)) {
        if source.fits_wide() {
            search.run_wide(k);
        } else {
            search.run_long(Cell::new(Integer::new(), k));
        }
    }
    search.places
}

/// A power of two above all positive roots (`2 max |c_i/c_n|^(1/(n-i))` over the c_i of the other sign, Kioustelidis
/// 1986, "Bounds for positive roots of polynomials"); `None` when there are none.
fn bound(source: &Source) -> Option<i64> {
    let n = source.degree();
    let leading = &source.coefficients[n];
    let other = source.coefficients[..n].iter().enumerate().filter(|(_, c)| sign(c) == -sign(leading));
    let powers = other.map(|(i, c)| {
        let steps = i64::try_from(n - i).expect("degrees are small");
        // |c_i/c_n| < 2^(length - length + 1)
        (length(c) - length(leading) + 1).div_euclid(steps) + 2
    });
    powers.max()
}

/// The index of a term that at `2^k` is larger than all others together.
fn dominant(source: &Source, k: i64) -> Option<usize> {
    let margin = length(&Integer::from(source.degree() + 1)) + 1;
    let (mut best, mut second) = ((i64::MIN, 0), i64::MIN);
    for (i, (power, length)) in (0_i64..).zip(&source.lengths).enumerate() {
        let Some(length) = length else { continue };
        let reach = length + k * power;
        if reach > best.0 {
            (best, second) = ((reach, i), best.0);
        } else {
            second = second.max(reach);
        }
    }
    (second == i64::MIN || best.0 - second > margin).then_some(best.1)
}

/// The least power of two, from `2^k` down, below which roots may be; `None` when no root is in `(0, 2^k)`.
///
/// A term that dominates at two places dominates between them, because all terms are straight lines in logarithms.
fn skip_empty(source: &Source, k: i64) -> Option<i64> {
    let Some(index) = dominant(source, k) else { return Some(k) };
    if source.lengths[..index].iter().all(Option::is_none) {
        return None;
    }
    // Dominated at 2^k, so the free stretch ends where a lower term comes near: step down in growing steps.
    let mut low = k;
    let mut step = 1;
    while dominant(source, low - step) == Some(index) {
        low -= step;
        step *= 2;
    }
    while step > 1 {
        step /= 2;
        if dominant(source, low - step) == Some(index) {
            low -= step;
        }
    }
    Some(low)
}

/// A cell right of 0 to be searched, and the polynomial there.
struct Node<T> {
    cell: Cell,
    expansion: Expansion<T>,
    /// The signs at both ends, certain.
    signs: (i8, i8),
    /// The bits of the next leap towards a cluster, and the sign changes of the cell that this one was cut from.
    leap: u32,
    inherited: i32,
}

/// What is still to be done, from left to right.
enum Task<T> {
    Search(Node<T>),
    Report(Place),
}

/// What Descartes' rule says of a node.
enum Verdict {
    Empty,
    /// One root, the polynomial having this sign left of it.
    One(i8),
    /// More sign changes; `None` when their number is not certain.
    Several(Option<i32>),
}

impl<T: Fixed> Node<T> {
    fn new(source: &Source, cell: Cell, expansion: Expansion<T>) -> Self {
        let b = &expansion.coefficients;
        let first = certain_sign(source, &b[0], expansion.error, &cell.numerator, cell.exponent);
        let last = certain_sign(source, &b[b.len() - 1], expansion.error, &cell.end(), cell.exponent);
        Self { cell, expansion, signs: (first, last), leap: 2, inherited: 0 }
    }

    fn verdict(&self) -> Verdict {
        let (first, last) = self.signs;
        match self.expansion.sign_changes(first, last) {
            (_, 0) => Verdict::Empty,
            (1, 1) if first != 0 => Verdict::One(first),
            (1, 1) if last != 0 => Verdict::One(-last),
            (1, 1) => Verdict::One(self.expansion.first_sign()),
            (least, most) => Verdict::Several((least == most).then_some(least)),
        }
    }

    /// The two halves, and the root exactly between them if there is one, as tasks, the last to be done first.
    fn halves(mut self, source: &Source, changes: Option<i32>) -> impl Iterator<Item = Task<T>> {
        let left = self.expansion.halve();
        let right = self.cell.part(&Integer::from(1), 1);
        let cell = mem::replace(&mut self.cell, right);
        let (numerator, exponent) = (&self.cell.numerator, self.cell.exponent);
        let middle = certain_sign(source, &self.expansion.coefficients[0], self.expansion.error, numerator, exponent);
        let root = (middle == 0).then(|| Task::Report(Place::At(numerator.clone(), exponent)));
        let inherited = changes.unwrap_or(0);
        let signs = (mem::replace(&mut self.signs.0, middle), middle);
        let left = Self { cell: cell.part(&Integer::new(), 1), expansion: left, signs, leap: self.leap, inherited };
        let right = Self { inherited, ..self };
        [Some(Task::Search(right)), root, Some(Task::Search(left))].into_iter().flatten()
    }
}

/// The certain sign at `numerator 2^exponent`, from an approximate value where that is enough.
fn certain_sign<T: Fixed>(source: &Source, value: &T, error: u64, numerator: &Integer, exponent: i64) -> i8 {
    match value.sign_beyond(error) {
        0 => sign_at(&source.coefficients, numerator, exponent),
        sign => sign,
    }
}

struct Search<'a> {
    source: &'a Source,
    places: Vec<Place>,
}

impl Search<'_> {
    fn wide(&self, k: i64) -> Task<Wide> {
        Task::Search(Node::new(self.source, Cell::new(Integer::new(), k), self.source.expand_wide(k)))
    }

    /// Searches `(0, 2^k)` in 256 bits.
    fn run_wide(&mut self, k: i64) {
        let mut stack = vec![self.wide(k)];
        while let Some(task) = stack.pop() {
            let node = match task {
                Task::Search(node) => node,
                Task::Report(place) => {
                    self.places.push(place);
                    continue;
                }
            };
            let changes = match node.verdict() {
                Verdict::Empty => continue,
                Verdict::One(sign) => {
                    self.places.push(Place::Within(node.cell, sign));
                    continue;
                }
                Verdict::Several(changes) => changes,
            };
            let k = node.cell.exponent;
            let precise = node.expansion.is_precise();
            if node.cell.numerator == 0 {
                match skip_empty(self.source, k) {
                    None => {}
                    Some(lower) if lower < k => stack.push(self.wide(lower)),
                    Some(_) if precise => stack.extend(node.halves(self.source, changes)),
                    // Averages have lost bits that a fresh expansion has.
                    Some(_) if !node.expansion.is_fresh() => stack.push(self.wide(k)),
                    Some(_) => self.run_long(node.cell),
                }
            } else if precise {
                stack.extend(node.halves(self.source, changes));
            } else {
                self.run_long(node.cell);
            }
        }
    }

    /// The node of a cell, in as many bits as it needs, but at least some.
    fn long(&self, cell: Cell, bits: &mut i64) -> Node<Integer> {
        let mut expansion = self.source.expand(&cell, *bits);
        while !expansion.is_precise() {
            *bits *= 2;
            expansion = self.source.expand(&cell, *bits);
        }
        Node::new(self.source, cell, expansion)
    }

    /// Searches a cell in big integers.
    fn run_long(&mut self, cell: Cell) {
        let mut bits = FIRST_PRECISION;
        let mut stack = vec![Task::Search(self.long(cell, &mut bits))];
        while let Some(task) = stack.pop() {
            let mut node = match task {
                Task::Search(node) => node,
                Task::Report(place) => {
                    self.places.push(place);
                    continue;
                }
            };
            let changes = match node.verdict() {
                Verdict::Empty => continue,
                Verdict::One(sign) => {
                    self.places.push(Place::Within(node.cell, sign));
                    continue;
                }
                Verdict::Several(changes) => changes,
            };
            let k = node.cell.exponent;
            if node.cell.numerator == 0 {
                match skip_empty(self.source, k) {
                    None => continue,
                    Some(lower) if lower < k => {
                        stack.push(Task::Search(self.long(Cell::new(Integer::new(), lower), &mut bits)));
                        continue;
                    }
                    Some(_) => {}
                }
            }
            if !node.expansion.is_precise() {
                let fresh = self.long(node.cell, &mut bits);
                stack.push(Task::Search(Node { leap: node.leap, inherited: node.inherited, ..fresh }));
                continue;
            }
            if let Some(m) = changes.filter(|&m| m == node.inherited) {
                if let Some(next) = self.leap(&node, m, &mut bits) {
                    stack.push(Task::Search(next));
                    continue;
                }
                node.leap = (node.leap / 2).max(2);
            }
            stack.extend(node.halves(self.source, changes));
        }
    }

    /// The far smaller cell to which Newton's steps for an m-fold root lead from either end, if it has all m changes.
    ///
    /// # Source
    /// Sagraloff and Mehlhorn 2016, "Computing real roots of real polynomials": quadratic steps towards clusters.
    fn leap(&self, node: &Node<Integer>, m: i32, bits: &mut i64) -> Option<Node<Integer>> {
        let b = &node.expansion.coefficients;
        let n = b.len() - 1;
        let last = (Integer::from(1) << node.leap) - 1_u32;
        // m p/p' at an end, in units of the small cells; p' is n times the difference of neighbours.
        let step = |end: &Integer, inner: &Integer| {
            let slope = Integer::from(end - inner) * n;
            (slope != 0).then(|| (Integer::from(end * m) << node.leap) / slope)
        };
        let from_left = step(&b[0], &b[1]);
        let from_right = step(&b[n], &b[n - 1]).map(|step| Integer::from(&last - step));
        let mut tried = None;
        for guess in [from_left, from_right].into_iter().flatten() {
            let index = guess.clamp(&Integer::new(), &last);
            if tried.as_ref() == Some(&index) {
                continue;
            }
            let cell = node.cell.part(&index, node.leap);
            let next = self.long(cell, bits);
            if matches!(next.verdict(), Verdict::Several(Some(changes)) if changes == m) {
                let leap = (2 * node.leap).min(LONGEST_LEAP);
                return Some(Node { leap, inherited: m, ..next });
            }
            tried = Some(index);
        }
        None
    }
}
