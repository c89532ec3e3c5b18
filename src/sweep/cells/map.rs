//! The numbers of real assembly modes over a plane of two parameters: cells of the second one, column by column.

use super::{Cells, Parameter, Subject, cells};
use crate::algebra::approximation::simplest_between;
use crate::derivation::Watch;
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use rayon::prelude::*;
use rug::Rational;
use std::f64::consts::PI;

/// A column: the first parameter has one exact value.
#[derive(Clone, Debug)]
pub struct Column {
    /// The first parameter: radians, or a length.
    pub value: f64,
    /// The exact value: the half tangent of an angle, or the length.
    pub exact: Rational,
    /// The cells of the second parameter; why there are none, where the closure polynomial is not known.
    pub cells: std::result::Result<Cells, String>,
}

/// The cells of two parameters.
#[derive(Clone, Debug)]
pub struct CellMap {
    /// Both parameters as requested.
    pub parameters: [String; 2],
    /// Whether each is an angle.
    pub kinds: [Variable; 2],
    /// Their values in the file: radians, or lengths.
    pub given: [Option<f64>; 2],
    /// The range of the first one.
    pub range: [f64; 2],
    /// The width of a column: the range over the requested number of columns.
    pub width: f64,
    /// The columns, in the order of their values.
    pub columns: Vec<Column>,
}

/// The request of a map.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'n> {
    /// Both parameters.
    pub parameters: [&'n str; 2],
    /// The range of the first one, radians or a length; a full turn, or from 0 to twice its value, where none is given.
    pub range: Option<[f64; 2]>,
    /// The number of columns.
    pub columns: usize,
}

/// The cells of the second parameter at values of the first one. `running` is asked for every column and stops the work; `tick` is
/// called when one is done.
///
/// # Errors
/// [`Error::Invalid`] for unknown parameters and an empty range; [`Error::Unsupported`] where no column has a closure polynomial.
pub fn cell_map(
    subject: &impl Subject,
    wanted: Wanted<'_>,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
) -> Result<CellMap> {
    let names = wanted.parameters.map(ToOwned::to_owned);
    let [one, two] = &names;
    if one == two {
        return Err(Error::Invalid(format!("found the parameter {one} twice, expected two parameters")));
    }
    let (first, second) = (subject.parameter(one)?, subject.parameter(two)?);
    let natural = |setting: &Parameter| setting.value.as_ref().map(|value| super::natural(value, setting.kind));
    let given = [natural(&first), natural(&second)];
    let range = wanted.range.unwrap_or_else(|| match (first.kind, given[0]) {
        (Variable::Rotation, _) => [-PI, PI],
        (Variable::Translation, Some(length)) if length != 0.0 => [0.0, 2.0 * length],
        (Variable::Translation, _) => [-1.0, 1.0],
    });
    let [from, to] = range;
    if !(to - from).is_normal() || wanted.columns == 0 {
        let message = format!("found a range from {from} to {to} in {} columns", wanted.columns);
        return Err(Error::Invalid(format!("{message}, expected two different ends and a column at least")));
    }
    let width = (to - from) / wanted.columns as f64;
    let column = |k: usize| -> Option<Result<Column>> {
        if !running() {
            return None;
        }
        let exact = simple(from + (k as f64 + 0.5) * width, width, first.kind)?;
        let found = match cells(&subject.with(&first, &exact), &second.name, &Watch::none()) {
            Ok(cells) => Ok(cells),
            Err(Error::Unsupported(message)) => Err(message),
            Err(error) => return Some(Err(error)),
        };
        tick();
        Some(Ok(Column { value: super::natural(&exact, first.kind), exact, cells: found }))
    };
    let columns: Vec<Column> = (0..wanted.columns).into_par_iter().filter_map(column).collect::<Result<_>>()?;
    let is_known = columns.iter().any(|column| column.cells.is_ok());
    match columns.iter().find_map(|column| column.cells.as_ref().err()) {
        Some(message) if !is_known => Err(Error::Unsupported(message.clone())),
        _ => Ok(CellMap { parameters: names, kinds: [first.kind, second.kind], given, range, width, columns }),
    }
}

/// A simple number near a value: within an eighth of the width of a column.
fn simple(value: f64, width: f64, kind: Variable) -> Option<Rational> {
    let reach = width.abs() / 8.0;
    let ends = [value - reach, value + reach].map(|x| match kind {
        Variable::Rotation => (x / 2.0).tan(),
        Variable::Translation => x,
    });
    let [low, high] = ends.map(Rational::from_f64);
    let (low, high) = (low?, high?);
    (low <= high).then(|| simplest_between(low, high))
}
