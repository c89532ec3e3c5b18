//! Strict reading of nodes: every value has its expected shape, every key is known.

use super::node::{Field, Node, Value};
use super::options::Chains;
use super::snap::{self, Nearness, Snapped};
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::{Error, Result};
use crate::kinematics::chain::Placement;
use rug::Rational;
use std::cell::{Cell, RefCell};

/// The state of the reader of one file.
pub(super) struct Scope<'a> {
    pub(super) path: &'a str,
    pub(super) reading: Reading,
    /// The chains that are accepted.
    pub(super) chains: Chains,
    /// Whether claims about solutions are read.
    pub(super) claims: bool,
    /// Whether some value had to be rounded to a rational.
    rounded: Cell<bool>,
    /// Warnings about the placements read since they were last taken.
    warnings: RefCell<Vec<String>>,
    /// Whether truncated multiples of pi are replaced by the exact angles.
    pub(super) snap: bool,
    /// Angles near multiples of half a degree.
    snapped: RefCell<Vec<Snapped>>,
}

/// The fields of a table whose keys are all known.
pub(super) struct Table<'a> {
    what: String,
    line: usize,
    fields: &'a [Field],
}

impl<'a> Scope<'a> {
    pub(super) fn new(path: &'a str, reading: Reading) -> Self {
        Self {
            path,
            reading,
            chains: Chains::Solved,
            claims: true,
            rounded: Cell::new(false),
            warnings: RefCell::default(),
            snap: false,
            snapped: RefCell::default(),
        }
    }

    pub(super) fn fail(&self, line: usize, message: impl Into<String>) -> Error {
        Error::Invalid(message.into()).at(self.path, line)
    }

    fn unexpected(&self, node: &Node, what: &str, expected: &str) -> Error {
        self.fail(node.line, format!("found {} as `{what}`, expected {expected}", node.describe()))
    }

    pub(super) fn is_rounded(&self) -> bool {
        self.rounded.get()
    }

    /// Returns the warnings since the last call, each once.
    pub(super) fn take_warnings(&self) -> Vec<String> {
        self.warnings.take()
    }

    /// Reads a table with no keys but the allowed ones.
    pub(super) fn table<'n>(&self, node: &'n Node, what: &str, allowed: &[&str]) -> Result<Table<'n>> {
        let Value::Table(fields) = &node.value else {
            return Err(self.unexpected(node, what, "a table"));
        };
        for field in fields {
            if !allowed.contains(&field.key.as_str()) {
                let near = nearest(&field.key, allowed.iter().copied());
                let hint = near.first().map_or_else(
                    || format!("expected one of {}", allowed.join(", ")),
                    |key| format!("did you mean `{key}`?"),
                );
                let key: String = field.key.chars().take(40).collect();
                return Err(self.fail(field.line, format!("found the unknown key `{key}` in {what}; {hint}")));
            }
        }
        Ok(Table { what: what.to_owned(), line: node.line, fields })
    }

    pub(super) fn list<'n>(&self, node: &'n Node, what: &str) -> Result<&'n [Node]> {
        match &node.value {
            Value::List(items) => Ok(items),
            _ => Err(self.unexpected(node, what, "a list")),
        }
    }

    /// Reads a list of exactly `N` items.
    pub(super) fn exactly<'n, const N: usize>(&self, node: &'n Node, what: &str) -> Result<&'n [Node; N]> {
        let items = self.list(node, what)?;
        items.try_into().map_err(|_| self.unexpected(node, what, &format!("a list of {N}")))
    }

    pub(super) fn text<'n>(&self, node: &'n Node, what: &str) -> Result<&'n str> {
        match &node.value {
            Value::Text(text) => Ok(text),
            _ => Err(self.unexpected(node, what, "a string")),
        }
    }

    /// Reads one of the given words.
    pub(super) fn word<'n>(&self, node: &'n Node, what: &str, words: &[&str]) -> Result<&'n str> {
        let text = self.text(node, what)?;
        if words.contains(&text) {
            return Ok(text);
        }
        let found: String = text.chars().take(40).collect();
        Err(self.fail(node.line, format!("found \"{found}\" as `{what}`, expected one of {}", words.join(", "))))
    }

    fn written<'n>(&self, node: &'n Node, what: &str, expected: &str) -> Result<&'n str> {
        match &node.value {
            Value::Number(text) | Value::Text(text) => Ok(text),
            _ => Err(self.unexpected(node, what, expected)),
        }
    }

    fn placed<T, E: Into<Error>>(&self, result: std::result::Result<T, E>, node: &Node, what: &str) -> Result<T> {
        result.map_err(|fault| Error::Invalid(format!("{} for `{what}`", fault.into())).at(self.path, node.line))
    }

    /// Reads a count: a whole number from 0 to 10000.
    pub(super) fn count(&self, node: &Node, what: &str) -> Result<usize> {
        let expected = "a whole number from 0 to 10000";
        match &node.value {
            Value::Number(text) => {
                text.parse().ok().filter(|count| *count <= 10_000).ok_or_else(|| self.unexpected(node, what, expected))
            }
            _ => Err(self.unexpected(node, what, expected)),
        }
    }

    pub(super) fn number(&self, node: &Node, quantity: Quantity, what: &str) -> Result<Number> {
        let text = self.written(node, what, "a number")?;
        let number = self.placed(Number::parse(text, quantity, &self.reading), node, what)?;
        self.note(number.is_exact());
        Ok(number)
    }

    pub(super) fn length(&self, node: &Node, what: &str) -> Result<Number> {
        self.number(node, Quantity::Length, what)
    }

    /// Reads a length whose square is wanted, such as `sqrt(5)`: it counts as rounded only if its square is irrational, too.
    pub(super) fn rooted(&self, node: &Node, what: &str) -> Result<Number> {
        let own = Scope::new(self.path, self.reading.clone());
        let number = own.length(node, what)?;
        self.note(number.squared().is_exact());
        Ok(number)
    }

    pub(super) fn angle(&self, node: &Node, what: &str) -> Result<Angle> {
        let text = self.written(node, what, "an angle")?;
        let angle = self.placed(Angle::parse(text, &self.reading), node, what)?;
        self.note(angle.is_exact());
        Ok(angle)
    }

    /// Reads the radians of an angle that is compared only: it does not make the mechanism a rounded one.
    pub(super) fn radians(&self, node: &Node, what: &str) -> Result<f64> {
        let text = self.written(node, what, "an angle")?;
        self.placed(Angle::parse_radians(text, &self.reading), node, what)
    }

    /// Reads an angle in radians that a program may have printed, as the multiple of half a degree that it represents.
    pub(super) fn printed_angle(&self, node: &Node, what: &str, place: &str) -> Result<Angle> {
        let text = self.written(node, what, "an angle")?.trim();
        let Some((halves, nearness)) = snap::multiple(text).filter(|_| !self.reading.degrees) else {
            return self.angle(node, what);
        };
        let (written, place, taken) = (text.to_owned(), place.to_owned(), self.snap || nearness == Nearness::Same);
        let snapped = Snapped { written, halves, place, taken };
        let meant = if taken { Some(Angle::parse(&snapped.meant(), &self.reading)?) } else { None };
        self.snapped.borrow_mut().push(snapped);
        let Some(angle) = meant else { return self.angle(node, what) };
        self.note(angle.is_exact());
        Ok(angle)
    }

    /// Returns the angles since the last call that represent multiples of half a degree.
    pub(super) fn take_snapped(&self) -> Vec<Snapped> {
        self.snapped.take()
    }

    pub(super) fn half_tangent(&self, node: &Node, what: &str) -> Result<Angle> {
        let text = self.written(node, what, "a number or \"inf\"")?;
        let angle = self.placed(Angle::parse_half_tangent(text, &self.reading), node, what)?;
        self.note(angle.is_exact());
        Ok(angle)
    }

    pub(super) fn vector(&self, node: &Node, quantity: Quantity, what: &str) -> Result<[Number; 3]> {
        let [x, y, z] = self.exactly::<3>(node, what)?;
        Ok([self.number(x, quantity, what)?, self.number(y, quantity, what)?, self.number(z, quantity, what)?])
    }

    /// Reads a rigid motion: a 4x4 matrix.
    pub(super) fn matrix(&self, node: &Node, what: &str) -> Result<Placement> {
        let rows = self.exactly::<4>(node, what)?;
        let mut numbers: [[Number; 4]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| Number::zero()));
        for (row, image) in rows.iter().zip(&mut numbers) {
            for (k, entry) in self.exactly::<4>(row, what)?.iter().enumerate() {
                let quantity = if k == 3 { Quantity::Length } else { Quantity::Ratio };
                image[k] = self.number(entry, quantity, what)?;
            }
        }
        // The corner is 1 without a unit, whatever the unit of length.
        numbers[3][3] = self.number(&self.exactly::<4>(&rows[3], what)?[3], Quantity::Ratio, what)?;
        self.placement(Placement::from_matrix(&numbers), node, what)
    }

    /// Reads a rigid motion: a quaternion and a position.
    pub(super) fn quaternion_position(&self, quaternion: &Node, position: &Node) -> Result<Placement> {
        let mut components: [Number; 4] = std::array::from_fn(|_| Number::zero());
        for (component, item) in components.iter_mut().zip(self.exactly::<4>(quaternion, "quaternion")?) {
            *component = self.number(item, Quantity::Ratio, "quaternion")?;
        }
        let position = self.vector(position, Quantity::Length, "position")?;
        self.placement(Placement::from_quaternion_position(&components, &position), quaternion, "quaternion")
    }

    /// Reads a rotation: a 3x3 matrix.
    pub(super) fn rotation_matrix(&self, node: &Node, what: &str) -> Result<[[Rational; 3]; 3]> {
        let mut numbers: [[Number; 4]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| Number::zero()));
        for (row, image) in self.exactly::<3>(node, what)?.iter().zip(&mut numbers) {
            for (entry, number) in self.exactly::<3>(row, what)?.iter().zip(image) {
                *number = self.number(entry, Quantity::Ratio, what)?;
            }
        }
        numbers[3][3] = Number::exact(Rational::from(1));
        Ok(self.placement(Placement::from_matrix(&numbers), node, what)?.exact.motion().rotation)
    }

    /// Reads a rotation: a quaternion.
    pub(super) fn rotation_quaternion(&self, node: &Node) -> Result<[[Rational; 3]; 3]> {
        let mut components: [Number; 4] = std::array::from_fn(|_| Number::zero());
        for (component, item) in components.iter_mut().zip(self.exactly::<4>(node, "quaternion")?) {
            *component = self.number(item, Quantity::Ratio, "quaternion")?;
        }
        let zero = std::array::from_fn(|_| Number::zero());
        let placed = Placement::from_quaternion_position(&components, &zero);
        Ok(self.placement(placed, node, "quaternion")?.exact.motion().rotation)
    }

    /// Takes the rotation nearest to a matrix or a quaternion as the datum, which does not count as rounding.
    fn placement(&self, found: Result<(Placement, Option<String>)>, node: &Node, what: &str) -> Result<Placement> {
        let (placement, warning) = self.placed(found, node, what)?;
        if let Some(warning) = warning {
            self.warnings.borrow_mut().push(format!("line {}, `{what}`: {warning}", node.line));
        }
        Ok(placement)
    }

    pub(super) fn note(&self, exact: bool) {
        if !exact {
            self.rounded.set(true);
        }
    }

    /// Returns the value of a required key.
    pub(super) fn need<'n>(&self, table: &Table<'n>, key: &str) -> Result<&'n Node> {
        table.get(key).ok_or_else(|| self.fail(table.line, format!("found no `{key}` in {}, expected one", table.what)))
    }
}

impl<'a> Table<'a> {
    /// Returns the value of a key, if it is there.
    pub(super) fn get(&self, key: &str) -> Option<&'a Node> {
        self.fields.iter().find(|field| field.key == key).map(|field| &field.node)
    }

    /// Returns the line at which the table begins.
    pub(super) fn line(&self) -> usize {
        self.line
    }
}

/// Returns the candidates that resemble a word, best first, at most three.
pub(super) fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<String> {
    let word: String = word.chars().take(60).collect();
    let mut scored: Vec<(usize, &str)> = candidates
        .map(|candidate| (strsim::damerau_levenshtein(&word, candidate), candidate))
        .filter(|(distance, candidate)| {
            let longest = candidate.len().max(word.len());
            longest > 1 && *distance <= (longest / 3).max(1)
        })
        .collect();
    scored.sort_unstable();
    scored.into_iter().take(3).map(|(_, candidate)| candidate.to_owned()).collect()
}
