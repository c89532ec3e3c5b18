//! Replaces names that have another meaning in a language.

use super::format::Format;
use super::names::Names;

/// The names of the variables as a language takes them.
pub(super) struct Renamed {
    list: Vec<String>,
    changes: Vec<(String, String)>,
}

impl Renamed {
    pub(super) fn new(format: Format, names: &Names) -> Self {
        let mut list: Vec<String> = names.list().to_vec();
        let mut changes = Vec::new();
        for (index, old) in names.list().iter().enumerate() {
            if is_free(format, old) {
                continue;
            }
            let stem = spelt(format, old);
            let mut candidates = std::iter::once(stem.clone()).chain((1..).map(|n| format!("{stem}v{n}")));
            // Nobody else may have it, neither as the old name nor as a new one.
            let is_new = |new: &String| !list.contains(new) && is_free(format, new);
            if let Some(new) = candidates.find(is_new) {
                changes.push((old.clone(), new.clone()));
                list[index] = new;
            }
        }
        Self { list, changes }
    }

    pub(super) fn list(&self) -> &[String] {
        &self.list
    }

    /// Old and new names of the variables renamed.
    pub(super) fn changes(&self) -> &[(String, String)] {
        &self.changes
    }
}

/// Returns the name in the letters that the language has.
fn spelt(format: Format, name: &str) -> String {
    let name = name.replace('\'', "p");
    let name = match format {
        Format::Mathematica | Format::Macaulay2 => name.replace('_', ""),
        _ => name.trim_start_matches('_').to_owned(),
    };
    // phc reads names that begin like its imaginary units and powers of ten as such.
    if format == Format::Phcpack && name.starts_with(['i', 'I', 'e', 'E']) {
        return format!("v{name}");
    }
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("v{name}") }
}

/// Returns whether the language accepts the name and has no other meaning for it.
fn is_free(format: Format, name: &str) -> bool {
    let is = |words: &str| words.split(' ').any(|word| word == name);
    let spelling = spelt(format, name) == name;
    match format {
        Format::Text | Format::Json | Format::Latex => true,
        Format::Sympy => spelling && !is(SYMPY) && !is(PYTHON),
        Format::Maple => spelling && !is(MAPLE),
        // Its own words are capitalised.
        Format::Mathematica => {
            spelling && !(is_word(name) && name.starts_with(|c: char| c.is_ascii_uppercase())) && !is(MATHEMATICA)
        }
        // These have words of their own by the thousand, all without digits; single letters are free.
        Format::Singular => spelling && !is_word(name) && !is_numbered(name, "f"),
        Format::Macaulay2 => spelling && !is_word(name),
        Format::Msolve | Format::Phcpack => spelling,
        Format::Julia => spelling && !is(JULIA),
    }
}

/// Returns whether the name consists of several letters only.
fn is_word(name: &str) -> bool {
    name.len() > 1 && name.bytes().all(|c| c.is_ascii_alphabetic())
}

/// Returns whether the name is a letter with a number, as files name their polynomials.
fn is_numbered(name: &str, letter: &str) -> bool {
    name.strip_prefix(letter).is_some_and(|number| !number.is_empty() && number.bytes().all(|c| c.is_ascii_digit()))
}

const SYMPY: &str = "\
    C E EulerGamma GoldenRatio I N O Poly Q Rational S beta equations gamma nan oo pi symbols variables zeta zoo \
    Catalan";
const PYTHON: &str = "\
    False None True and as assert async await break class continue def del elif else except finally for from \
    global if import in is lambda nonlocal not or pass raise return try while with yield";
const MAPLE: &str = "\
    Catalan D Digits FAIL GAMMA I O Order Pi Zeta abs and assuming break by catch cos description diff do done \
    elif else end equations error eval exp expand export factor false fi finally for from gamma global if implies \
    in infinity int intersect local ln log minus mod module next not od option or proc quit return save sin solve \
    then true undefined variables while";
const MATHEMATICA: &str = "\
    C D E I K N O equations variables";
const JULIA: &str = "\
    F HomotopyContinuation Inf NaN System abstract baremodule begin break catch const continue cos do else elseif \
    end exp export false finally for function global if im import in isa let local log macro module nothing pi \
    quote return sin solve struct true try using while";
