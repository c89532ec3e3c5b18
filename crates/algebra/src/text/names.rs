//! The names of variables, which polynomials themselves know by number only.

use super::fault::shortened;
use crate::error::Error;
use crate::monomial::Packing;
use std::collections::HashMap;

/// The largest number of names.
const MOST_NAMES: usize = 1000;
/// Up to this many names a look through all of them is faster than a table.
const FEW: usize = 12;
/// Up to this many, those of up to eight bytes are looked for word by word.
const MANY: usize = 64;
/// Names that resemble an unknown one at least this much are suggested.
const RESEMBLANCE: f64 = 0.6;

/// An ordered list of names: the first one is variable 0. It is either given, and then complete, or collected in the
/// order in which names appear in the texts that are read with it.
///
/// # Example
/// ```
/// use looproot_algebra::text::{Expression, Names};
///
/// let mut names = Names::collected();
/// Expression::parse("y^2 - x*y", &mut names).unwrap();
/// assert_eq!(names.list(), ["y", "x"]);
/// let fault = Expression::parse("x + z", &mut Names::given(["x", "y"]).unwrap()).unwrap_err();
/// assert_eq!(fault.place.column, 5);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Names {
    list: Vec<String>,
    /// Their bytes in one word, 0 for those of more than eight bytes.
    words: Vec<u64>,
    /// The index of each name, once there are more than a few.
    table: HashMap<String, usize>,
    complete: bool,
}

impl Names {
    /// No names yet; those that appear are collected.
    #[must_use]
    pub fn collected() -> Self {
        Self::default()
    }

    /// Takes these names and no others.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an invalid name, for a name that appears twice, and for too many names.
    pub fn given<S: AsRef<str>>(list: impl IntoIterator<Item = S>) -> Result<Self, Error> {
        let mut names = Self::default();
        for name in list {
            let name = name.as_ref();
            if !is_name(name) {
                let rule = "expected a letter or an underscore, then letters, digits, underscores, primes";
                return Err(Error::Invalid(format!("found the variable `{}`, {rule}", shortened(name))));
            }
            if names.index(name).is_some() {
                return Err(Error::Invalid(format!(
                    "found the variable `{}` twice, expected it once",
                    shortened(name)
                )));
            }
            names.push(name).map_err(Error::Invalid)?;
        }
        names.complete = true;
        Ok(names)
    }

    /// Returns the names, in order.
    #[must_use]
    pub fn list(&self) -> &[String] {
        &self.list
    }

    /// Returns the number of the variable with this name.
    #[must_use]
    pub fn index(&self, name: &str) -> Option<usize> {
        if !self.table.is_empty() {
            return self.table.get(name).copied();
        }
        match word(name) {
            0 => self.list.iter().position(|known| known == name),
            word => self.position(word),
        }
    }

    /// Returns the number of the variable whose name has these bytes, up to eight, the last one lowest; `None` among many names.
    #[inline]
    pub(super) fn position(&self, word: u64) -> Option<usize> {
        if self.words.len() <= MANY { self.words.iter().position(|&known| known == word) } else { None }
    }

    /// Returns the packing of monomials with room for all variables, if these are known.
    pub(super) fn packing(&self) -> Option<Packing> {
        self.complete.then(|| Packing::new(self.list.len(), 0))
    }

    /// Like [`Self::index`]; the error names those that resemble it.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an unknown name.
    pub fn known(&self, name: &str) -> Result<usize, Error> {
        self.index(name).ok_or_else(|| Error::Invalid(self.unknown(name)))
    }

    /// Returns the number of the variable with this name, which is added if names are collected.
    pub(super) fn look_up(&mut self, name: &str) -> Result<usize, String> {
        match self.index(name) {
            Some(index) => Ok(index),
            None if self.complete => Err(self.unknown(name)),
            None => self.push(name),
        }
    }

    fn push(&mut self, name: &str) -> Result<usize, String> {
        let index = self.list.len();
        if index == MOST_NAMES {
            return Err(format!("found `{}`, one variable more than the {MOST_NAMES} possible", shortened(name)));
        }
        self.list.push(name.to_owned());
        self.words.push(word(name));
        if self.list.len() == FEW {
            self.table = self.list.iter().cloned().zip(0..).collect();
        } else if self.list.len() > FEW {
            self.table.insert(name.to_owned(), index);
        }
        Ok(index)
    }

    fn unknown(&self, name: &str) -> String {
        let resemblance = |known: &String| strsim::normalized_damerau_levenshtein(known, name);
        let near =
            self.list.iter().filter(|known| resemblance(known) >= RESEMBLANCE || known.eq_ignore_ascii_case(name));
        let near: Vec<String> = near.take(3).map(|known| format!("`{known}`")).collect();
        let expected = match (near.is_empty(), self.list.is_empty()) {
            (false, _) => format!("did you mean {}?", near.join(" or ")),
            (true, true) => "expected no variable".to_owned(),
            (true, false) => format!("expected one of {}", shortened(&self.list.join(", "))),
        };
        format!("found the unknown variable `{}`; {expected}", shortened(name))
    }
}

/// Returns the bytes of a name in one word, the last one lowest; 0 for more than eight.
fn word(name: &str) -> u64 {
    if name.len() > 8 { 0 } else { name.bytes().fold(0, |word, byte| word << 8 | u64::from(byte)) }
}

/// Returns whether a text is a letter or underscore, then letters, digits, underscores, and primes at the end.
fn is_name(text: &str) -> bool {
    let body = text.trim_end_matches('\'');
    body.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && body.bytes().all(|c| c.is_ascii_alphanumeric() || c == b'_')
}
