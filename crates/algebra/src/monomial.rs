//! Monomials packed into machine words: products are sums of words, and their order is the order of the words.

/// The largest exponent of a variable.
pub const LARGEST_EXPONENT: u32 = (1 << 30) - 1;

/// The packing of exponents: one field of equal width for each variable, the first variable in the highest field of the
/// first word, so that comparing words compares lexicographically. The highest bit of each field stays 0: sums of
/// monomials do not overflow, and it shows whether differences are monomials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packing {
    variables: usize,
    /// Width of a field, at most 32.
    bits: u32,
    /// Fields in a word. Divisions by it are left out where all fields are in the first one, as they mostly are.
    per_word: u32,
}

impl Packing {
    /// Room for exponents up to `largest` in each of the variables.
    ///
    /// # Panics
    /// When `largest` is above [`LARGEST_EXPONENT`].
    #[must_use]
    pub fn new(variables: usize, largest: u32) -> Self {
        assert!(largest <= LARGEST_EXPONENT, "an exponent of {largest}, above {LARGEST_EXPONENT}");
        // One bit for the guard. With few variables the fields fill a word, which spares repacking later.
        let needed = u32::BITS - largest.leading_zeros() + 1;
        let roomy = 64 / u32::try_from(variables.max(2)).unwrap_or(u32::MAX);
        let bits = needed.max(2).max(roomy.min(16)).min(32);
        Self { variables, bits, per_word: 64 / bits }
    }

    /// Returns the number of variables.
    #[must_use]
    pub const fn variables(&self) -> usize {
        self.variables
    }

    /// Returns the largest exponent that fits.
    #[must_use]
    pub const fn largest(&self) -> u32 {
        (1 << (self.bits - 1)) - 1
    }

    /// Fields in a word.
    const fn per_word(&self) -> usize {
        self.per_word as usize
    }

    /// Words of a monomial, at least one.
    #[must_use]
    pub const fn words(&self) -> usize {
        if self.variables <= self.per_word() { 1 } else { self.variables.div_ceil(self.per_word()) }
    }

    /// Returns the word of a variable's field, and the place of its lowest bit there.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a word has at most 32 fields")]
    pub const fn place(&self, variable: usize) -> (usize, u32) {
        let per_word = self.per_word();
        if variable < per_word {
            return (0, 64 - self.bits * (variable as u32 + 1));
        }
        (variable / per_word, 64 - self.bits * ((variable % per_word) as u32 + 1))
    }

    /// Returns the exponent in a field of a word.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "a field has at most 32 bits")]
    pub(super) const fn field(&self, word: u64, shift: u32) -> u32 {
        ((word >> shift) & ((1 << self.bits) - 1)) as u32
    }

    /// Returns a word with the guard bits of all fields.
    #[must_use]
    pub const fn guards(&self) -> u64 {
        let (mut mask, mut field) = (0, 0);
        while field < self.per_word() {
            mask |= 1 << (63 - self.bits as usize * field);
            field += 1;
        }
        mask
    }

    /// Returns the exponent of a variable; 0 for variables beyond the packed ones.
    #[must_use]
    #[inline(always)]
    pub const fn exponent(&self, monomial: &[u64], variable: usize) -> u32 {
        if variable >= self.variables {
            return 0;
        }
        let (word, shift) = self.place(variable);
        self.field(monomial[word], shift)
    }

    /// Appends the packed monomial.
    ///
    /// # Panics
    /// When there are more exponents than variables, or one does not fit.
    pub fn push(&self, exponents: &[u32], packed: &mut Vec<u64>) {
        assert!(exponents.len() <= self.variables, "more exponents than variables");
        let start = packed.len();
        packed.resize(start + self.words(), 0);
        for (variable, &exponent) in exponents.iter().enumerate() {
            assert!(exponent <= self.largest(), "the exponent fits its field");
            let (word, shift) = self.place(variable);
            packed[start + word] |= u64::from(exponent) << shift;
        }
    }

    /// Returns whether a monomial has the same words in both packings, one of which may have more variables.
    pub(super) const fn agrees(&self, other: &Self) -> bool {
        self.bits == other.bits && self.words() == other.words()
    }

    /// Monomials of another packing in this one, which has at least its variables and room for their exponents.
    pub(super) fn repack(&self, source: &Self, monomials: &[u64]) -> Vec<u64> {
        let (from, to) = (source.words(), self.words());
        let mut packed = vec![0; monomials.len() / from * to];
        for variable in 0..source.variables {
            let ((word, shift), (source_word, source_shift)) = (self.place(variable), source.place(variable));
            let mask = (1 << source.bits) - 1;
            for (target, monomial) in packed.chunks_exact_mut(to).zip(monomials.chunks_exact(from)) {
                target[word] |= ((monomial[source_word] >> source_shift) & mask) << shift;
            }
        }
        packed
    }

    /// Returns whether products of these monomials and those surely stay below the guard bits.
    pub(super) fn holds_products(&self, a: &[u64], b: &[u64]) -> bool {
        let (words, guards) = (self.words(), self.guards());
        // The bitwise or of monomials is an upper bound in each field.
        let outline = |monomials: &[u64], word: usize| monomials[word..].iter().step_by(words).fold(0, |or, m| or | m);
        (0..words).all(|word| (outline(a, word) + outline(b, word)) & guards == 0)
    }

    /// Returns the mask of one word that keeps the fields of the first `count` variables.
    #[expect(clippy::cast_possible_truncation, reason = "a word has at most 32 fields")]
    pub(super) fn leading(&self, word: usize, count: usize) -> u64 {
        let fields = count.saturating_sub(word * self.per_word()).min(self.per_word());
        let kept = fields as u32 * self.bits;
        if kept == 0 { 0 } else { u64::MAX << (64 - kept) }
    }

    /// Returns the exponents of a monomial, one for each variable.
    #[must_use]
    pub fn unpack(&self, monomial: &[u64]) -> Vec<u32> {
        (0..self.variables).map(|variable| self.exponent(monomial, variable)).collect()
    }
}
