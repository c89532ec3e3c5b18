//! Products of polynomials that are dense in their last variables, digit by digit in f64.
//!
//! The coefficients are cut into digits of w bits, rounded to nearest, so that none exceeds `2^(w-1)` in absolute value. Terms with
//! neighbouring exponents of the last variable are runs. Each run of one factor lies in vectors, also shifted by one, two and
//! three places, so that up to four neighbouring terms of the other factor are multiplied by it at a time; what digits p
//! and q give is added up in plane `p + q`.
//!
//! # Why the coefficients are right
//! A cell of a plane is a sum of at most D products for each pair of terms, D being the number of digits, and a term
//! meets at most one term of the other factor in it. With `D min(n_a, n_b) 2^(2w-2) <= 2^53` every sum on the way is an
//! integer that f64 holds exactly, with a fused multiply-add or without. With one digit, the sum of the absolute values
//! of all products is at most `2^53` already.

use super::blocks::Grid;
use super::heap::Heap;
use super::kronecker::Numbers;
use crate::monomial::Packing;
use pulp::{Arch, Simd, WithSimd};
use rug::{Integer, integer::Order};

/// The numbers of this size and below are exact in f64.
const EXACT_BITS: u32 = 53;
/// The most digits: from some 180 bits on, products of big integers are cheaper.
const MOST_DIGITS: usize = 8;
/// The most digits whose sums stay in registers.
const IN_REGISTERS: usize = 3;
/// The most sums for a box: as many as stay in the second-level cache.
const MOST_SUMS: usize = 1 << 15;
/// The most rows of boxes that are worth counting.
const MOST_ROWS: u64 = 1 << 40;
/// The most terms for which room is made at once.
const MOST_ROOM: usize = 1 << 16;
/// The most neighbouring terms of the left factor that are multiplied at a time.
const GROUP: usize = 4;
/// The lanes of the widest machine: what the last vector of a box may reach beyond it.
const MOST_LANES: usize = 8;
/// The nanoseconds for a vector of four lanes and one digit, by groups of one, two and four terms; the part of that where two or
/// three digits stay in registers; the nanoseconds for a cell, for a digit that is laid out, and for all the rest:
/// measured on a processor of 3 GHz.
const VECTOR: [f64; 3] = [1.1, 1.3, 1.8];
const SEVERAL: f64 = 0.55;
const CELL: f64 = 0.3;
const LAYOUT: f64 = 2.0;
const REST: f64 = 1.5e3;
/// The nanoseconds below which laying factors out costs more than it can save.
const SHORT: f64 = 8e3;

/// Coefficients of the product.
pub(super) enum Sums<'s> {
    Words(&'s [i64]),
    Wide(i128),
    Large(Integer),
}

/// How coefficients are cut into digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Digits {
    count: usize,
    /// The bits of a digit; those of a word where it is the only one.
    width: u32,
    /// Whether all sums are known to fit an i128.
    short: bool,
}

impl Digits {
    /// Returns the fewest digits for which all sums are exact; `None` if they are too many.
    fn new(a: &Numbers, b: &Numbers, bound: Option<u128>, terms: usize) -> Option<Self> {
        if bound.is_some_and(|bound| bound <= 1 << EXACT_BITS) {
            return Some(Self { count: 1, width: u64::BITS, short: true });
        }
        let short = bound.is_some_and(|bound| bound < 1 << 127);
        let bits = a.bits().max(b.bits()) + 1;
        (2..=MOST_DIGITS).find_map(|count| {
            let products = (count * terms).next_power_of_two().trailing_zeros();
            let width = EXACT_BITS.checked_sub(products)? / 2 + 1;
            (count * width as usize >= bits).then_some(Self { count, width, short })
        })
    }

    /// Returns the pairs of digits that are multiplied, in units of the cost of one.
    fn pairs(self) -> f64 {
        let share = if matches!(self.count, 2..=3) { SEVERAL } else { 1.0 };
        share * (self.count * self.count) as f64
    }

    /// Passes the digits of a number, lowest first.
    fn cut(self, words: &[u64], negative: bool, mut put: impl FnMut(usize, f64)) {
        let (width, half) = (self.width as usize, 1_i64 << (self.width - 1));
        let mut carry = 0;
        for digit in 0..self.count {
            let (first, shift) = (digit * width / 64, digit * width % 64);
            let word = |i: usize| words.get(i).copied().unwrap_or(0);
            let bits = word(first) >> shift | (word(first + 1) << 1) << (63 - shift);
            let mut value = (bits & (u64::MAX >> (64 - width))).cast_signed() + carry;
            carry = i64::from(value >= half && digit + 1 < self.count);
            value -= carry << width;
            put(digit, (if negative { -value } else { value }) as f64);
        }
    }
}

/// Neighbouring terms of one factor.
#[derive(Clone, Copy)]
struct Run {
    /// The cell of the lowest one.
    cell: usize,
    /// The number of the highest one among all terms, from which on they follow one another.
    term: usize,
    length: usize,
}

/// The runs of one factor in blocks, whose terms agree in the leading variables.
struct Runs {
    /// The number of each block, decreasing, and where its runs end.
    blocks: Vec<(u64, usize)>,
    list: Vec<Run>,
    /// The digits of each term, the lowest first.
    digits: Vec<f64>,
}

impl Runs {
    /// Returns the runs of a block.
    fn block(&self, block: usize) -> &[Run] {
        let start = if block == 0 { 0 } else { self.blocks[block - 1].1 };
        &self.list[start..self.blocks[block].1]
    }
}

/// The right factor in vectors.
struct Vectors {
    /// By block, where the vectors begin that meet groups of one term, those that also meet two, and those that meet four; and
    /// where they end.
    ends: Vec<[usize; 4]>,
    /// The cell of each vector.
    cells: Vec<usize>,
    /// For each vector the lanes of each digit, shifted by 0, 1, 2 and 3 places.
    lanes: Vec<f64>,
}

/// A block of vectors.
#[derive(Clone, Copy)]
struct Block<'v> {
    cells: &'v [usize],
    lanes: &'v [f64],
    /// How many of them meet groups of one, of two and of four terms.
    counts: [usize; 3],
}

impl Block<'_> {
    /// Returns the cells of the vectors that meet groups of so many terms.
    #[inline(always)]
    fn cells(&self, terms: usize) -> &[usize] {
        &self.cells[..self.counts[terms.ilog2() as usize]]
    }
}

impl Vectors {
    /// Returns a block.
    fn block(&self, block: usize) -> Block<'_> {
        let [start, one, two, four] = self.ends[block];
        let size = self.lanes.len() / self.cells.len();
        Block {
            cells: &self.cells[start..four],
            lanes: &self.lanes[start * size..four * size],
            counts: [one - start, two - start, four - start],
        }
    }

    /// Lays a factor out in vectors of so many lanes.
    fn new(runs: &Runs, count: usize, lanes: usize) -> Self {
        let mut vectors = Self { ends: Vec::with_capacity(runs.blocks.len()), cells: Vec::new(), lanes: Vec::new() };
        for block in 0..runs.blocks.len() {
            let mut ends = [vectors.cells.len(); 4];
            for (class, before, terms) in [(0, 0, 1), (1, 1, 2), (2, 2, GROUP)] {
                for run in runs.block(block) {
                    let first = if class == 0 { 0 } else { (run.length + before - 1).div_ceil(lanes) };
                    for vector in first..(run.length + terms - 1).div_ceil(lanes) {
                        vectors.push(runs, run, (vector, lanes, count));
                    }
                }
                ends[class + 1] = vectors.cells.len();
            }
            vectors.ends.push(ends);
        }
        vectors
    }

    fn push(&mut self, runs: &Runs, run: &Run, (vector, lanes, count): (usize, usize, usize)) {
        self.cells.push(run.cell + vector * lanes);
        for shift in 0..GROUP {
            for digit in 0..count {
                self.lanes.extend((vector * lanes..(vector + 1) * lanes).map(|place| {
                    let inside = place.checked_sub(shift).filter(|place| *place < run.length);
                    // The terms of a run come from the highest one down.
                    inside.map_or(0.0, |place| runs.digits[(run.term + run.length - 1 - place) * count + digit])
                }));
            }
        }
    }
}

/// The arrangement of two factors.
pub(super) struct Planes<'d> {
    packing: Packing,
    degrees: &'d [u32],
    leading: usize,
    /// The distance of exponents of each variable, in the numbers of blocks or in cells.
    strides: Vec<u64>,
    cells: usize,
    digits: Digits,
    left: Runs,
    right: Runs,
}

impl<'d> Planes<'d> {
    /// Returns the arrangement for two factors, not zero, whose product has at most these degrees, and whose coefficients and sums
    /// of them are at most `bound`; `None` if no box or no digits are small enough, or where another way, which takes
    /// `limit` nanoseconds, is surely faster.
    pub(super) fn new(
        packing: Packing,
        degrees: &'d [u32],
        (bound, limit): (Option<u128>, f64),
        (left, a): (&[u64], &Numbers),
        (right, b): (&[u64], &Numbers),
    ) -> Option<Self> {
        let (own, others) = (left.len() / packing.words(), right.len() / packing.words());
        let digits = Digits::new(a, b, bound, own.min(others))?;
        // With all groups and vectors full.
        let least = own as f64 * others as f64 / (GROUP * 4) as f64 * VECTOR[2] * digits.pairs();
        if limit < SHORT || least > limit {
            return None;
        }
        let most = MOST_SUMS / (2 * digits.count - 1);
        let (mut leading, mut cells) = (degrees.len(), 1);
        let mut strides = vec![0; degrees.len()];
        while leading > 0 {
            let wider = cells * (degrees[leading - 1] as usize + 1);
            if wider > most {
                break;
            }
            leading -= 1;
            strides[leading] = cells as u64;
            cells = wider;
        }
        if leading == degrees.len() {
            return None;
        }
        let mut rows = 1_u64;
        for variable in (0..leading).rev() {
            strides[variable] = rows;
            rows = rows.checked_mul(u64::from(degrees[variable]) + 1).filter(|rows| *rows <= MOST_ROWS)?;
        }
        let empty = || Runs { blocks: Vec::new(), list: Vec::new(), digits: Vec::new() };
        let mut planes = Self { packing, degrees, leading, strides, cells, digits, left: empty(), right: empty() };
        (planes.left, planes.right) = (planes.runs(left, a), planes.runs(right, b));
        Some(planes)
    }

    /// Returns the runs of a factor.
    fn runs(&self, monomials: &[u64], numbers: &Numbers) -> Runs {
        let (words, last) = (self.packing.words(), self.degrees.len() - 1);
        let places: Vec<((usize, u32), u64)> =
            self.strides.iter().enumerate().map(|(v, &stride)| (self.packing.place(v), stride)).collect();
        let at = |monomial: &[u64], places: &[((usize, u32), u64)]| -> u64 {
            let term = |&((word, shift), stride): &((usize, u32), u64)| {
                u64::from(self.packing.field(monomial[word], shift)) * stride
            };
            places.iter().map(term).sum()
        };
        let mut runs = Runs { blocks: Vec::new(), list: Vec::new(), digits: Vec::new() };
        let mut previous = None;
        let (outer, inner) = places.split_at(self.leading);
        for (term, monomial) in monomials.chunks_exact(words).enumerate() {
            let block = at(monomial, outer);
            let cell = usize::try_from(at(monomial, inner)).unwrap_or(usize::MAX);
            let exponent = self.packing.exponent(monomial, last);
            let same_block = runs.blocks.last().is_some_and(|(known, _)| *known == block);
            match runs.list.last_mut() {
                // Terms decrease: a run goes on with the exponent below, unless that belongs to other variables.
                Some(run) if same_block && previous == Some((cell + 1, exponent + 1)) => {
                    (run.cell, run.length) = (cell, run.length + 1);
                }
                _ => runs.list.push(Run { cell, term, length: 1 }),
            }
            if !same_block {
                runs.blocks.push((block, 0));
            }
            if let Some(block) = runs.blocks.last_mut() {
                block.1 = runs.list.len();
            }
            previous = Some((cell, exponent));
        }
        runs.digits = self.digits_of(numbers);
        runs
    }

    /// Returns the digits of all coefficients.
    fn digits_of(&self, numbers: &Numbers) -> Vec<f64> {
        let count = self.digits.count;
        match numbers {
            Numbers::Words(words) if count == 1 => words.iter().map(|n| *n as f64).collect(),
            Numbers::Words(words) => {
                let mut digits = vec![0.0; count * words.len()];
                for (place, n) in digits.chunks_exact_mut(count).zip(*words) {
                    self.digits.cut(&[n.unsigned_abs()], *n < 0, |digit, value| place[digit] = value);
                }
                digits
            }
            Numbers::Large(large) => {
                let (mut digits, mut buffer) = (vec![0.0; count * large.len()], Vec::new());
                for (place, n) in digits.chunks_exact_mut(count).zip(*large) {
                    buffer.resize(n.significant_digits::<u64>(), 0);
                    n.write_digits(&mut buffer, Order::Lsf);
                    self.digits.cut(&buffer, n.is_negative(), |digit, value| place[digit] = value);
                }
                digits
            }
        }
    }

    /// Returns the nanoseconds that the product is expected to take.
    pub(super) fn cost(&self) -> f64 {
        // The groups of one, two and four terms of the left factor.
        let mut groups = [0.0; 3];
        for run in &self.left.list {
            groups[2] += (run.length / 4) as f64;
            match run.length % 4 {
                0 => {}
                rest => groups[rest.ilog2() as usize + usize::from(rest == 3)] += 1.0,
            }
        }
        let vectors = |terms: usize| -> f64 {
            self.right.list.iter().map(|run| (run.length + terms - 1).div_ceil(4) as f64).sum()
        };
        let counts = [1, 2, GROUP].map(vectors);
        let digits = self.digits.count as f64;
        let kernel: f64 = (0..3).map(|group| groups[group] * counts[group] * VECTOR[group]).sum();
        let span = |runs: &Runs| runs.blocks.first().map_or(0, |first| first.0) + 1;
        let boxes = (self.left.blocks.len() as f64 * self.right.blocks.len() as f64)
            .min((span(&self.left) + span(&self.right)) as f64);
        let layout = counts[2] * 16.0 * digits * LAYOUT;
        self.digits.pairs() * kernel + CELL * (2.0 * digits - 1.0) * boxes * self.cells as f64 + layout + REST
    }

    /// Returns a number of terms for which room is made at once: dense products have no more, and seldom fewer.
    pub(super) fn room(&self) -> usize {
        let pairs = self.left.digits.len().saturating_mul(self.right.digits.len());
        self.degrees
            .iter()
            .fold(1, |cells: usize, &degree| cells.saturating_mul(degree as usize + 1))
            .min(pairs)
            .min(MOST_ROOM)
    }

    /// Returns the monomials of the product, decreasing; its coefficients are passed one by one to `take`.
    pub(super) fn product(&self, take: &mut dyn FnMut(Sums)) -> Vec<u64> {
        self.product_on(Arch::new(), take)
    }

    fn product_on(&self, arch: Arch, take: &mut dyn FnMut(Sums)) -> Vec<u64> {
        arch.dispatch(Product { planes: self, take })
    }

    /// Returns the words of the monomial of a block.
    fn outer(&self, block: u64) -> Vec<u64> {
        let (mut monomial, mut rest) = (vec![0; self.packing.words()], block);
        for variable in (0..self.leading).rev() {
            let radix = u64::from(self.degrees[variable]) + 1;
            let (word, shift) = self.packing.place(variable);
            monomial[word] |= (rest % radix) << shift;
            rest /= radix;
        }
        monomial
    }
}

/// A product to be computed.
struct Product<'p, 'd, 't> {
    planes: &'p Planes<'d>,
    take: &'t mut dyn FnMut(Sums),
}

impl WithSimd for Product<'_, '_, '_> {
    type Output = Vec<u64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<u64> {
        let Self { planes, take } = self;
        let (left, right) = (&planes.left, &planes.right);
        let grid = Grid::new(planes.packing, planes.degrees, planes.cells);
        let vectors = Vectors::new(right, planes.digits.count, S::F64_LANES);
        let mut sums = Cells::new(planes);
        let mut monomials = Vec::with_capacity(planes.room() * planes.packing.words());
        let mut heap = Heap::new(left.blocks.len());
        let mut columns = vec![0; left.blocks.len()];
        heap.insert(left.blocks[0].0 + right.blocks[0].0, 0);
        let mut rows = Vec::new();
        while let Some(block) = heap.pop(&mut rows) {
            for row in rows.drain(..) {
                let column = columns[row];
                multiply(simd, &mut sums, (left, row), vectors.block(column));
                columns[row] += 1;
                if columns[row] == 1 && row + 1 < left.blocks.len() {
                    heap.insert(left.blocks[row + 1].0 + right.blocks[0].0, row + 1);
                }
                if let Some((next, _)) = right.blocks.get(columns[row]) {
                    heap.insert(left.blocks[row].0 + next, row);
                }
            }
            let outer = planes.outer(block);
            sums.empty(take, &mut |cells| {
                if let [outer] = outer[..] {
                    monomials.extend(cells.iter().map(|&cell| outer | grid.monomial(cell)[0]));
                    return;
                }
                for &cell in cells {
                    monomials.extend(outer.iter().zip(grid.monomial(cell)).map(|(outer, inner)| outer | inner));
                }
            });
        }
        monomials
    }
}

/// Adds the product of two blocks to the planes.
#[inline(always)]
fn multiply<S: Simd>(simd: S, sums: &mut Cells, (left, i): (&Runs, usize), right: Block) {
    match sums.digits.count {
        1 => by_groups(
            left,
            i,
            #[inline(always)]
            |cell, terms: Group<1>| add_all(simd, sums, cell, terms, right),
        ),
        2 => by_groups(
            left,
            i,
            #[inline(always)]
            |cell, terms: Group<2>| add_all(simd, sums, cell, terms, right),
        ),
        3 => by_groups(
            left,
            i,
            #[inline(always)]
            |cell, terms: Group<3>| add_all(simd, sums, cell, terms, right),
        ),
        _ => add_in_turn(simd, sums, (left, i), right),
    }
}

/// The digits of one, two or four neighbouring terms, from the lowest term on.
#[derive(Clone, Copy)]
enum Group<const D: usize> {
    One([[f64; D]; 1]),
    Two([[f64; D]; 2]),
    Four([[f64; D]; GROUP]),
}

/// Passes the terms of a block in groups, with the cell of the lowest one.
#[inline(always)]
fn by_groups<const D: usize>(left: &Runs, block: usize, mut add: impl FnMut(usize, Group<D>)) {
    for run in left.block(block) {
        let mut done = 0;
        while done < run.length {
            // The term this far above the lowest one of the group; those beyond the highest are zero.
            let term = |k: usize| -> [f64; D] {
                let below = run.length.checked_sub(done + k + 1);
                let digits = below.map(|below| &left.digits[(run.term + below) * D..][..D]);
                digits.and_then(|digits| digits.try_into().ok()).unwrap_or([0.0; D])
            };
            let cell = run.cell + done;
            match run.length - done {
                1 => add(cell, Group::One([term(0)])),
                2 => add(cell, Group::Two([term(0), term(1)])),
                _ => add(cell, Group::Four([term(0), term(1), term(2), term(3)])),
            }
            done += GROUP;
        }
    }
}

/// Adds the products of a group with a block, all digits of a vector at once.
#[inline(always)]
fn add_all<S: Simd, const D: usize>(simd: S, sums: &mut Cells, cell: usize, terms: Group<D>, right: Block) {
    match terms {
        Group::One(terms) => add_vectors(simd, sums, cell, terms, right),
        Group::Two(terms) => add_vectors(simd, sums, cell, terms, right),
        Group::Four(terms) => add_vectors(simd, sums, cell, terms, right),
    }
}

#[inline(always)]
fn add_vectors<S: Simd, const N: usize, const D: usize>(
    simd: S,
    sums: &mut Cells,
    cell: usize,
    terms: [[f64; D]; N],
    right: Block,
) {
    // Loops over constants are unrolled, `map` of arrays is a call.
    let mut splats = [[simd.splat_f64s(0.0); D]; N];
    for k in 0..N {
        for p in 0..D {
            splats[k][p] = simd.splat_f64s(terms[k][p]);
        }
    }
    let (stride, size) = (sums.stride, GROUP * D * S::F64_LANES);
    for (&own, lanes) in right.cells(N).iter().zip(right.lanes.chunks_exact(size)) {
        let lanes = S::as_simd_f64s(lanes).0;
        let mut totals = [simd.splat_f64s(0.0); 2 * IN_REGISTERS - 1];
        for plane in 0..2 * D - 1 {
            let place = &sums.sums[plane * stride + cell + own..][..S::F64_LANES];
            if let [sum] = S::as_simd_f64s(place).0 {
                totals[plane] = *sum;
            }
        }
        for k in 0..N {
            for p in 0..D {
                for q in 0..D {
                    totals[p + q] = simd.mul_add_e_f64s(splats[k][p], lanes[k * D + q], totals[p + q]);
                }
            }
        }
        for plane in 0..2 * D - 1 {
            let place = &mut sums.sums[plane * stride + cell + own..][..S::F64_LANES];
            if let [place] = S::as_mut_simd_f64s(place).0 {
                *place = totals[plane];
            }
        }
    }
}

/// Adds the product of two blocks, one pair of digits after the other: more do not fit the registers.
#[inline(always)]
fn add_in_turn<S: Simd>(simd: S, sums: &mut Cells, (left, block): (&Runs, usize), right: Block) {
    let count = sums.digits.count;
    for run in left.block(block) {
        for done in (0..run.length).step_by(GROUP) {
            for p in 0..count {
                // A digit of the term this far above the lowest one of the group; those beyond the highest are zero.
                let digit = |k: usize| {
                    let below = run.length.checked_sub(done + k + 1);
                    below.map_or(0.0, |below| left.digits[(run.term + below) * count + p])
                };
                let terms = [digit(0), digit(1), digit(2), digit(3)];
                for q in 0..count {
                    let sums = &mut sums.sums[(p + q) * sums.stride + run.cell + done..];
                    match run.length - done {
                        1 => add_digits(simd, sums, [terms[0]], q, (right, count)),
                        2 => add_digits(simd, sums, [terms[0], terms[1]], q, (right, count)),
                        _ => add_digits(simd, sums, terms, q, (right, count)),
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn add_digits<S: Simd, const N: usize>(
    simd: S,
    sums: &mut [f64],
    terms: [f64; N],
    q: usize,
    (right, count): (Block, usize),
) {
    let mut splats = [simd.splat_f64s(0.0); N];
    for k in 0..N {
        splats[k] = simd.splat_f64s(terms[k]);
    }
    for (&own, lanes) in right.cells(N).iter().zip(right.lanes.chunks_exact(GROUP * count * S::F64_LANES)) {
        let (place, lanes) = (&mut sums[own..][..S::F64_LANES], S::as_simd_f64s(lanes).0);
        if let [place] = S::as_mut_simd_f64s(place).0 {
            for k in 0..N {
                *place = simd.mul_add_e_f64s(splats[k], lanes[k * count + q], *place);
            }
        }
    }
}

/// Returns a sum as a machine word.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the sums are integers of at most 53 bits")]
fn to_word(sum: f64) -> i64 {
    sum as i64
}

/// The sums of products that fall into the cells of a box, by planes.
struct Cells {
    sums: Vec<f64>,
    /// The distance of planes.
    stride: usize,
    digits: Digits,
    /// Room for a long number.
    words: Vec<u64>,
}

impl Cells {
    fn new(planes: &Planes) -> Self {
        let stride = planes.cells + GROUP + MOST_LANES;
        let sums = vec![0.0; stride * (2 * planes.digits.count - 1)];
        Self { sums, stride, digits: planes.digits, words: Vec::new() }
    }

    /// Passes the sums that are not zero and their cells, the highest first, and makes them zero.
    fn empty(&mut self, take: &mut dyn FnMut(Sums), place: &mut dyn FnMut(&[usize])) {
        const CHUNK: usize = 8;
        let mut end = self.stride;
        while end > 0 {
            let start = end.saturating_sub(CHUNK);
            let is_zero = |plane: &[f64]| match <&[f64; CHUNK]>::try_from(&plane[start..end]) {
                // All bits but the signs together, which is done in lanes.
                Ok(chunk) => chunk.iter().fold(0, |or, n| or | n.to_bits()) << 1 == 0,
                Err(_) => plane[start..end].iter().all(|n| *n == 0.0),
            };
            if self.sums.chunks_exact(self.stride).all(is_zero) {
                end = start;
                continue;
            }
            let (mut cells, mut words, mut count) = ([0; CHUNK], [0; CHUNK], 0);
            for cell in (start..end).rev() {
                cells[count] = cell;
                if self.digits.count == 1 {
                    words[count] = to_word(self.sums[cell]);
                    count += usize::from(words[count] != 0);
                } else if let Some(sum) = self.sum(cell) {
                    take(sum);
                    count += 1;
                }
            }
            if self.digits.count == 1 {
                take(Sums::Words(&words[..count]));
            }
            place(&cells[..count]);
            for plane in self.sums.chunks_exact_mut(self.stride) {
                plane[start..end].fill(0.0);
            }
            end = start;
        }
    }

    /// Returns the number in a cell, unless it is zero.
    #[expect(clippy::cast_possible_truncation, reason = "words are taken off the end of a buffer")]
    fn sum(&mut self, cell: usize) -> Option<Sums<'static>> {
        let planes = self.sums[cell..].iter().step_by(self.stride).map(|sum| to_word(*sum));
        let width = self.digits.width;
        if self.digits.short {
            // What is lost above the highest bit of the planes is lost of the whole sum, which has no bits there.
            let n = planes.rev().fold(0_i128, |sum, plane| (sum << width).wrapping_add(plane.into()));
            return (n != 0).then_some(Sums::Wide(n));
        }
        // Two's complement: digits from the lowest on, what they leave is carried on.
        self.words.clear();
        let (mut carry, mut buffer, mut filled) = (0_i64, 0_u128, 0);
        let mask = (1_i64 << width) - 1;
        for plane in planes {
            let sum = plane + carry;
            buffer |= u128::from((sum & mask).cast_unsigned()) << filled;
            carry = sum >> width;
            filled += width;
            if filled >= 64 {
                self.words.push(buffer as u64);
                buffer >>= 64;
                filled -= 64;
            }
        }
        buffer |= (i128::from(carry) << filled).cast_unsigned();
        self.words.extend([buffer as u64, (buffer >> 64) as u64]);
        let negative = carry < 0;
        if negative {
            let mut borrow = true;
            for word in &mut self.words {
                (*word, borrow) = (!*word).overflowing_add(u64::from(borrow));
            }
        }
        let n = Integer::from_digits(&self.words, Order::Lsf);
        (n != 0).then(|| Sums::Large(if negative { -n } else { n }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use crate::polynomial::Polynomial;
    use crate::polynomial::product::{bound, to_large, to_words};
    use crate::ring::Ring;
    use proptest::prelude::*;
    use std::borrow::Cow;

    type Poly = Polynomial<Int>;

    /// Returns the product by planes on this machine and by plain arithmetic, if it can be had, and its digits.
    fn by_planes(f: &Poly, g: &Poly) -> Option<(Poly, Poly, usize)> {
        let degrees: Vec<u32> = (0..f.variables().max(g.variables())).map(|v| f.degree(v) + g.degree(v)).collect();
        let packing = Packing::new(degrees.len(), degrees.iter().copied().max().unwrap_or(0));
        let (left, right) = (f.packed_as(packing), g.packed_as(packing));
        let words = to_words(f.coefficients()).zip(to_words(g.coefficients()));
        let (a, b) = (to_large(f.coefficients()).unwrap(), to_large(g.coefficients()).unwrap());
        let limit = words.as_ref().map(|(a, b)| bound(a, b));
        let (a, b) = match &words {
            Some((a, b)) => (Numbers::Words(a), Numbers::Words(b)),
            None => (Numbers::Large(&a), Numbers::Large(&b)),
        };
        let planes = Planes::new(packing, &degrees, (limit, f64::INFINITY), (&left, &a), (&right, &b))?;
        let product = |arch: Arch| {
            let mut coefficients = Vec::new();
            let monomials = planes.product_on(arch, &mut |sums| match sums {
                Sums::Words(words) => coefficients.extend(words.iter().map(|n| Int::from(*n))),
                Sums::Wide(n) => coefficients.push(Int::from(n)),
                Sums::Large(n) => coefficients.push(Int::from(n)),
            });
            Poly { packing, monomials, coefficients }
        };
        Some((product(Arch::new()), product(Arch::Scalar), planes.digits.count))
    }

    /// Returns the product term by term.
    fn term_by_term(f: &Poly, g: &Poly) -> Poly {
        g.terms().fold(Poly::zero(), |sum, (exponents, c)| sum.add(&f.mul(&Poly::from_terms([(exponents, c.clone())]))))
    }

    fn polynomials(variables: usize, degree: u32, bits: u32) -> impl Strategy<Value = Poly> {
        let words = any::<[u64; 3]>();
        let number = (words, any::<bool>(), 0..bits).prop_map(move |(words, negative, shift)| {
            let n = Integer::from_digits(&words, Order::Lsf) >> (192 - bits) >> shift;
            Int::from(if negative { -n } else { n })
        });
        let term = (prop::collection::vec(0..=degree, variables), number);
        prop::collection::vec(term, 1..90).prop_map(Poly::from_terms)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn products_are_those_of_single_terms(
            f in (1..4_usize, 1..9_u32, 1..160_u32).prop_flat_map(|(v, d, b)| polynomials(v, d, b)),
            g in (1..4_usize, 1..9_u32, 1..160_u32).prop_flat_map(|(v, d, b)| polynomials(v, d, b)),
        ) {
            if !f.is_zero() && !g.is_zero() && f.variables().max(g.variables()) > 0 {
                let (fast, plain, _) = by_planes(&f, &g).unwrap();
                let expected = term_by_term(&f, &g);
                prop_assert_eq!(&fast, &expected);
                prop_assert_eq!(&plain, &expected);
            }
        }
    }

    /// The largest numbers of every length and all signs, so that each sum is as large as it can be.
    #[test]
    fn the_largest_digits_add_up_exactly() {
        let mut seen = Vec::new();
        for bits in (1_u32..8).map(|k| 22 * k).chain([1, 24, 40, 62, 63, 64, 120]) {
            for signs in [0, 1, 2] {
                let number = |k: u32| {
                    let n = (Integer::from(1) << bits) - 1_u32;
                    Int::from(if signs == 2 || signs == 1 && k % 2 == 1 { -n } else { n })
                };
                let row = |y: u32| (0..24).map(move |x| (vec![y, x], number(x + y)));
                let f = Poly::from_terms((0..4).flat_map(row));
                for (a, b) in [(&f, &f), (&f, &f.neg())] {
                    let (fast, plain, digits) = by_planes(a, b).unwrap();
                    let expected = term_by_term(a, b);
                    assert_eq!((&fast, &plain), (&expected, &expected), "{bits} {signs}");
                    seen.push(digits);
                }
            }
        }
        assert!((1..=MOST_DIGITS).all(|digits| seen.contains(&digits)), "{seen:?}");
    }

    #[test]
    fn boxes_of_many_variables_and_degrees_that_fit_none() {
        // More words than one to a monomial, and rows of blocks.
        let x = |v: usize| Poly::variable(v);
        let powers = (0..9).map(|k| x(8).pow(k)).fold(Poly::one(), |sum, power| sum.add(&power));
        let f = (0..14).fold(powers, |sum, v| sum.add(&x(v).pow(4)).add(&x(v)));
        assert!(f.product_size(&f).largest_exponent > 15 && Packing::new(14, 16).words() > 1);
        let (fast, plain, _) = by_planes(&f, &f).unwrap();
        assert_eq!((&fast, &plain), (&term_by_term(&f, &f), &term_by_term(&f, &f)));
        let long = x(1).pow(1 << 17).add(&x(0)).add(&Poly::one());
        assert!(by_planes(&long, &long).is_none());
        assert!(
            Digits::new(&Numbers::Large(&[Cow::Owned(Integer::from(1) << 500_u32)]), &Numbers::Words(&[1]), None, 1)
                .is_none()
        );
    }
}
