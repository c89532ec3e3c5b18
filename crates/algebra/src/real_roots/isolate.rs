//! Isolation of the real roots of a square-free integer polynomial by Descartes' rule on dyadic cells.
//!
//! Cells are halved until the Bernstein coefficients have at most one sign change. When averaging has used up their bits,
//! they are recomputed from the polynomial, in as many bits as needed. A cluster of m roots keeps m sign changes while its
//! cell shrinks; a Newton step for an m-fold root then predicts a far smaller cell, which is accepted if it has all m
//! (Sagraloff and Mehlhorn 2016, "Computing real roots of real polynomials").

use super::bernstein::{Expansion, Source};
use super::cell::Cell;
use super::evaluate::{length, shifted, sign, value_at};
use super::sample::Sampler;
use rug::Integer;

/// The precision in which big integers are tried first.
const FIRST_PRECISION: i64 = 256;
/// The bits of the first leap towards a cluster, which is also how many halvings go before, and those of the longest.
const FIRST_LEAP: u32 = 8;
const LONGEST_LEAP: u32 = 1 << 20;
/// The bits of a guess that f64 arithmetic nearly always gets right.
pub(super) const GUESS_BITS: u32 = 48;
/// The most doublings of a first cell that are left for the end.
const MOST_DOUBLINGS: i64 = 64;
/// The bits that a Newton step is computed with beyond those of the leap.
const LEAP_GUARD: i64 = 64;

/// The probable position of a root in its cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    /// From 0 at the left end to 1 at the right.
    pub(super) y: f64,
    /// Number of its bits that are reliable.
    pub(super) bits: u32,
}

/// The place of one root.
#[derive(Clone, Debug)]
pub(super) enum Place {
    /// Exactly at `numerator 2^exponent`.
    At(Integer, i64),
    /// Alone inside a cell, the polynomial having this sign in the cell left of the root.
    Within(Cell, i8, Option<Guess>),
}

impl Place {
    /// Returns the left end of the interval, as a numerator and the exponent of its power of two.
    pub(super) fn start(&self) -> (&Integer, i64) {
        match self {
            Self::At(numerator, exponent) => (numerator, *exponent),
            Self::Within(cell, ..) => (&cell.numerator, cell.exponent),
        }
    }

    /// Returns the place of the root of `p(-x)` that belongs to this root of `p(x)`.
    pub(super) fn mirrored(self) -> Self {
        match self {
            Self::At(numerator, exponent) => Self::At(-numerator, exponent),
            Self::Within(cell, sign, guess) => {
                Self::Within(cell.mirrored(), -sign, guess.map(|Guess { y, bits }| Guess { y: 1.0 - y, bits }))
            }
        }
    }
}

/// Returns the places of all real roots of a square-free polynomial that does not vanish at 0, from left to right.
pub(super) fn isolate(coefficients: Vec<Integer>) -> Vec<Place> {
    // A polynomial in x^2 has each root with both signs.
    let even = coefficients.iter().skip(1).step_by(2).all(|c| *c == 0);
    let source = Source::new(coefficients);
    let positive = positive_roots(&source);
    let negative = if even { positive.clone() } else { positive_roots(&source.mirrored()) };
    let mut places: Vec<Place> = negative.into_iter().rev().map(Place::mirrored).collect();
    places.extend(positive);
    places
}

/// Returns the places of the positive roots.
fn positive_roots(source: &Source) -> Vec<Place> {
    let most = sign_changes(&source.coefficients);
    let mut search =
        Search { source, places: Vec::new(), most, bits: FIRST_PRECISION, value_bits: FIRST_PRECISION, slope: None };
    if let Some(k) = bound(source).and_then(|k| skip_empty(source, k)) {
        let first = largest_of_real(source).filter(|first| (k - MOST_DOUBLINGS..k).contains(first)).unwrap_or(k);
        search.run(first, k);
    }
    search.places
}

/// Returns the number of sign changes in a sequence, zeros left out.
fn sign_changes<'a>(coefficients: impl IntoIterator<Item = &'a Integer>) -> usize {
    let (mut changes, mut before) = (0, 0);
    for sign in coefficients.into_iter().map(sign).filter(|sign| *sign != 0) {
        changes += usize::from(before == -sign);
        before = sign;
    }
    changes
}

/// Returns a power of two near the largest absolute value of a root, if all roots may be real; a guess that nothing rests on.
///
/// All roots are real only if the sign changes of `p(x)` and `p(-x)` are as many as the degree, and Newton's inequalities
/// hold: `c_i^2 i (n-i) > c_(i-1) c_(i+1) (i+1) (n-i+1)`. The square of the largest root is at least the sum of all fourth
/// powers over that of all squares.
fn largest_of_real(source: &Source) -> Option<i64> {
    let (c, n) = (&source.coefficients, source.degree());
    if n < 4 || c.contains(&Integer::new()) {
        return None;
    }
    let alternate = c.iter().enumerate().map(|(i, c)| if i % 2 == 1 { Integer::from(-c) } else { c.clone() });
    let alternate: Vec<Integer> = alternate.collect();
    let newton = |i: usize| {
        Integer::from(c[i].square_ref()) * (i * (n - i))
            > Integer::from(&c[i - 1] * &c[i + 1]) * ((i + 1) * (n - i + 1))
    };
    if sign_changes(c) + sign_changes(&alternate) != n || !(1..n).all(newton) {
        return None;
    }
    // Newton's identities, all sums multiplied by powers of the leading coefficient.
    let leading = &c[n];
    let [e1, e2, e3, e4] = [1, 2, 3, 4].map(|i| {
        let power = (1..i).fold(Integer::from(1), |power, _| power * leading);
        let term = Integer::from(&c[n - i] * &power);
        if i % 2 == 1 { -term } else { term }
    });
    let p1 = e1.clone();
    let p2 = Integer::from(&e1 * &p1) - Integer::from(&e2 * 2);
    let p3 = Integer::from(&e1 * &p2) - Integer::from(&e2 * &p1) + Integer::from(&e3 * 3);
    let p4 = Integer::from(&e1 * &p3) - Integer::from(&e2 * &p2) + Integer::from(&e3 * &p1) - Integer::from(&e4 * 4);
    let twice = length(&p4) - length(&p2) - 2 * length(leading) + 2;
    Some((twice + 1).div_euclid(2))
}

/// Returns a power of two above all positive roots (`2 max |c_i/c_n|^(1/(n-i))` over the c_i of the other sign, Kioustelidis
/// 1986, "Bounds for positive roots of polynomials"); `None` if there are none.
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

/// Returns the index of a term that at `2^k` is larger than all others together.
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

/// Returns the least power of two, from `2^k` down, below which roots may be; `None` when no root is in `(0, 2^k)`.
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
struct Node {
    cell: Cell,
    expansion: Expansion,
    /// The signs at both ends, certain.
    signs: (i8, i8),
    cluster: Cluster,
}

/// The number of steps for which a number of sign changes has stayed the same.
#[derive(Clone, Copy)]
struct Cluster {
    changes: i32,
    /// The halvings since.
    halvings: u32,
    /// The bits of the next leap.
    leap: u32,
}

/// Before anything is known.
const NO_CLUSTER: Cluster = Cluster { changes: 0, halvings: 0, leap: FIRST_LEAP };

/// A remaining task, in order from left to right.
enum Task {
    Search(Node),
    Report(Place),
    /// `[2^k, 2^(k+1))`, of which nothing is known yet.
    Open(i64),
}

/// The result of Descartes' rule for a node.
enum Verdict {
    Empty,
    /// One root, the polynomial having this sign left of it.
    One(i8),
    /// More sign changes; `None` when their number is not certain.
    Several(Option<i32>),
}

impl Node {
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
}

/// The search for the positive roots of one polynomial.
struct Search<'a> {
    source: &'a Source,
    places: Vec<Place>,
    /// The number of sign changes of the coefficients: by Descartes' rule there are no more positive roots.
    most: usize,
    /// The precisions in which expansions, and values, are tried first.
    bits: i64,
    value_bits: i64,
    /// The coefficients of the derivative, once they are needed.
    slope: Option<Vec<Integer>>,
}

impl Search<'_> {
    /// Returns the certain sign at `numerator 2^exponent`, where an approximate value tells it or, if that tells 0, a better one.
    fn sign(&mut self, approximate: i8, numerator: &Integer, exponent: i64) -> i8 {
        match approximate {
            0 => {
                let value = value_at(&self.source.coefficients, numerator, exponent, 1, &mut self.value_bits);
                sign(&value.mantissa)
            }
            sign => sign,
        }
    }

    fn node(&mut self, cell: Cell, cluster: Cluster) -> Node {
        let expansion = self.source.expand(&cell, &mut self.bits);
        let first = self.sign(expansion.sign(0), &cell.numerator, cell.exponent);
        let last = self.sign(expansion.sign(expansion.degree()), &cell.end(), cell.exponent);
        Node { cell, expansion, signs: (first, last), cluster }
    }

    /// Returns the node `(0, 2^k)`.
    fn start(&mut self, k: i64) -> Node {
        self.node(Cell::new(Integer::new(), k), NO_CLUSTER)
    }

    /// Searches `(0, 2^k)`, first up to `2^first`; it ends as soon as there can be no further root.
    fn run(&mut self, first: i64, k: i64) {
        let mut stack: Vec<Task> = (first..k).rev().map(Task::Open).collect();
        stack.push(Task::Search(self.start(first)));
        while let Some(task) = stack.pop() {
            if self.places.len() == self.most {
                return;
            }
            let node = match task {
                Task::Search(node) => node,
                Task::Open(k) => {
                    let node = self.node(Cell::new(Integer::from(1), k), NO_CLUSTER);
                    if node.signs.0 == 0 {
                        self.places.push(Place::At(Integer::from(1), k));
                    }
                    node
                }
                Task::Report(place) => {
                    self.places.push(place);
                    continue;
                }
            };
            match node.verdict() {
                Verdict::Empty => {}
                Verdict::One(sign) => {
                    let guess = node.expansion.guess_root(sign).map(|y| Guess { y, bits: GUESS_BITS });
                    self.places.push(Place::Within(node.cell, sign, guess));
                }
                Verdict::Several(changes) => {
                    if !changes.is_some_and(|changes| self.sample(&node, changes)) {
                        self.split(node, changes, &mut stack);
                    }
                }
            }
        }
    }

    /// Reports all roots of a node, and returns true, if signs on a grid tell as many apart as there are sign changes.
    fn sample(&mut self, node: &Node, changes: i32) -> bool {
        let Some((sampler, bits)) = Sampler::new(&node.expansion, changes) else { return false };
        let mut signs = vec![node.signs.0];
        signs.extend(sampler.signs(bits));
        signs.push(node.signs.1);
        let count = |signs: &[i8]| {
            let between = signs.windows(2).filter(|pair| pair[0] * pair[1] < 0).count();
            (between, signs[1..signs.len() - 1].iter().filter(|sign| **sign == 0).count())
        };
        let wanted = usize::try_from(changes).unwrap_or(0);
        let (between, uncertain) = count(&signs);
        // A point that is not certain may be a root, or tell two; where many are not, f64 has too few bits.
        if between + 2 * uncertain < wanted || uncertain > wanted {
            return false;
        }
        let start = Integer::from(&node.cell.numerator << bits);
        let exponent = node.cell.exponent - i64::from(bits);
        for i in 1..signs.len() - 1 {
            if signs[i] == 0 {
                signs[i] = self.sign(0, &Integer::from(&start + i), exponent);
            }
        }
        let (between, zeros) = count(&signs);
        if between + zeros != wanted {
            return false;
        }
        let between: Vec<u32> =
            (0_u32..).zip(signs.windows(2)).filter(|(_, pair)| pair[0] * pair[1] < 0).map(|(i, _)| i).collect();
        let (guesses, guess_bits) = sampler.guesses(&between, bits);
        let mut guesses = guesses.into_iter();
        for i in 0..signs.len() - 1 {
            if i > 0 && signs[i] == 0 {
                self.places.push(Place::At(Integer::from(&start + i), exponent));
            }
            if signs[i] * signs[i + 1] < 0 {
                let guess = guesses.next().filter(|y| y.is_finite()).map(|y| Guess { y, bits: guess_bits });
                self.places.push(Place::Within(Cell::new(Integer::from(&start + i), exponent), signs[i], guess));
            }
        }
        true
    }

    /// Puts off the parts of a node that may hold roots, the leftmost to be done first.
    fn split(&mut self, mut node: Node, changes: Option<i32>, stack: &mut Vec<Task>) {
        let k = node.cell.exponent;
        if node.cell.numerator == 0 {
            match skip_empty(self.source, k) {
                None => return,
                Some(lower) if lower < k => return stack.push(Task::Search(self.start(lower))),
                Some(_) => {}
            }
        }
        if !node.expansion.is_precise() {
            let fresh = self.node(node.cell, node.cluster);
            return stack.push(Task::Search(fresh));
        }
        let changes = changes.unwrap_or(0);
        let cluster = &mut node.cluster;
        if changes == cluster.changes && changes > 0 {
            cluster.halvings += 1;
        } else {
            *cluster = Cluster { changes, halvings: 0, leap: FIRST_LEAP };
        }
        if node.cluster.halvings >= FIRST_LEAP {
            if let Some(next) = self.leap(&node) {
                return stack.push(Task::Search(next));
            }
            node.cluster = Cluster { changes, halvings: 0, leap: (node.cluster.leap / 2).max(FIRST_LEAP) };
        }
        let left = node.expansion.halve();
        let (left_cell, right_cell) = (node.cell.part(&Integer::new(), 1), node.cell.part(&Integer::from(1), 1));
        let (numerator, exponent) = (&right_cell.numerator, right_cell.exponent);
        let middle = self.sign(node.expansion.sign(0), numerator, exponent);
        let root = (middle == 0).then(|| Task::Report(Place::At(numerator.clone(), exponent)));
        let (first, last) = node.signs;
        stack.push(Task::Search(Node { cell: right_cell, signs: (middle, last), ..node }));
        stack.extend(root);
        let signs = (first, middle);
        stack.push(Task::Search(Node { cell: left_cell, expansion: left, signs, cluster: node.cluster }));
    }

    /// Returns the far smaller cell to which Newton's step for an m-fold root leads from either end, if it has all m changes.
    fn leap(&mut self, node: &Node) -> Option<Node> {
        let Cluster { changes, leap, .. } = node.cluster;
        let last = (Integer::from(1) << leap) - 1_u32;
        let coefficients = &self.source.coefficients;
        let slope = self.slope.get_or_insert_with(|| {
            (1_u32..).zip(&coefficients[1..]).map(|(i, c)| Integer::from(c * i)).collect::<Vec<Integer>>()
        });
        let (bits, exponent, wanted) = (&mut self.value_bits, node.cell.exponent, i64::from(leap) + LEAP_GUARD);
        // m p/p' at an end, in units of the small cells.
        let mut step = |numerator: &Integer| {
            let value = value_at(coefficients, numerator, exponent, wanted, bits);
            let slope = value_at(slope, numerator, exponent, wanted, bits);
            let shift = i64::from(leap) + value.unit - slope.unit - exponent;
            (slope.mantissa != 0).then(|| shifted(&(value.mantissa * changes), shift) / slope.mantissa)
        };
        let from_left = step(&node.cell.numerator).map(|step| -step);
        let from_right = step(&node.cell.end()).map(|step| &last - step);
        let mut tried = None;
        for guess in [from_left, from_right].into_iter().flatten() {
            let index = guess.clamp(&Integer::new(), &last);
            if tried.as_ref() == Some(&index) {
                continue;
            }
            let cluster = Cluster { changes, halvings: FIRST_LEAP, leap: (2 * leap).min(LONGEST_LEAP) };
            let next = self.node(node.cell.part(&index, leap), cluster);
            if matches!(next.verdict(), Verdict::Several(Some(m)) if m == changes) {
                return Some(next);
            }
            tried = Some(index);
        }
        None
    }
}
