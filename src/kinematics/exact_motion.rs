//! A rigid motion over the rationals that is computed when it is first needed.

use super::decimal::Plain;
use super::motion::Motion;
use super::placement::rotation_of;
use crate::algebra::number::Number;
use rug::Rational;
use std::fmt::{self, Debug, Formatter};
use std::ops::Deref;
use std::sync::OnceLock;

/// A rigid motion over the rationals.
#[derive(Clone)]
pub struct ExactMotion {
    known: OnceLock<Motion<Rational>>,
    datum: Option<Box<Datum>>,
}

/// The data from which a motion is computed.
#[derive(Clone, Debug)]
pub(super) enum Datum {
    /// A matrix, and the quaternion of the rotation that represents it: whole numbers over 2^60.
    Matrix([[Plain; 4]; 3], [i64; 4]),
    /// A quaternion of any length near 1, and a position.
    Quaternion([Plain; 4], [Plain; 3]),
    /// A quaternion of whole numbers over 2^60, and a position.
    Binary([i64; 4], [f64; 3]),
}

/// Bits behind the point of the quaternion that represents a matrix.
pub(super) const QUATERNION_BITS: u32 = 60;

impl ExactMotion {
    /// Returns the motion of a datum.
    pub(super) fn of(datum: Datum) -> Self {
        Self { known: OnceLock::new(), datum: Some(Box::new(datum)) }
    }

    /// The motion itself.
    #[must_use]
    pub fn motion(&self) -> Motion<Rational> {
        (**self).clone()
    }

    /// Returns the rows of the matrix that it represents, if there is one.
    pub(super) fn rows(&self) -> Option<Box<[[Number; 4]; 3]>> {
        match self.datum.as_deref()? {
            Datum::Matrix(rows, _) => Some(Box::new(rows.map(|row| row.map(Plain::number)))),
            Datum::Quaternion(..) | Datum::Binary(..) => None,
        }
    }
}

impl Datum {
    /// The motion over the rationals.
    fn image(&self) -> Motion<Rational> {
        match self {
            Self::Matrix(rows, quaternion) => {
                let [w, x, y, z] = quaternion.map(|part| Rational::from(part) >> QUATERNION_BITS);
                let translation = rows.map(|row| row[3].rational());
                Motion { rotation: rotation_of([&w, &x, &y, &z]), translation }
            }
            Self::Quaternion(quaternion, position) => {
                let [w, x, y, z] = quaternion.map(Plain::rational);
                Motion { rotation: rotation_of([&w, &x, &y, &z]), translation: position.map(Plain::rational) }
            }
            Self::Binary(quaternion, position) => {
                let [w, x, y, z] = quaternion.map(|part| Rational::from(part) >> QUATERNION_BITS);
                let translation = position.map(|x| Rational::from_f64(x).unwrap_or_default());
                Motion { rotation: rotation_of([&w, &x, &y, &z]), translation }
            }
        }
    }
}

impl From<Motion<Rational>> for ExactMotion {
    fn from(motion: Motion<Rational>) -> Self {
        Self { known: OnceLock::from(motion), datum: None }
    }
}

impl Deref for ExactMotion {
    type Target = Motion<Rational>;

    fn deref(&self) -> &Motion<Rational> {
        self.known.get_or_init(|| self.datum.as_ref().map_or_else(Motion::identity, |datum| datum.image()))
    }
}

impl PartialEq for ExactMotion {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Debug for ExactMotion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}
