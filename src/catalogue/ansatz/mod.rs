//! Loops with symbols for parameters, and relations between these: the input of `conditions`.

mod expression;
mod member;
mod read;
mod real;
mod replacement;
mod resolve;
mod screws;

pub use member::{Link, Members};
pub use replacement::Replaced;

use super::entry::Source;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use rug::Rational;

pub(super) use read::ansatz;

/// The symbols of an ansatz as variables of polynomials: cosine, sine and half-angle tangent of every angle, every length.
#[derive(Clone, Debug)]
pub struct Symbols {
    /// The names of the angles.
    pub angles: Vec<String>,
    /// The names of the lengths.
    pub lengths: Vec<String>,
    names: Names,
}

impl Symbols {
    /// Creates these symbols.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an invalid name, for a name with two meanings, and for too many names.
    pub fn new(angles: Vec<String>, lengths: Vec<String>) -> Result<Self> {
        if let Some(both) = angles.iter().find(|angle| lengths.contains(angle)) {
            return Err(Error::Invalid(format!(
                "found the symbol `{both}` among the angles and among the lengths, expected it to mean one of them"
            )));
        }
        // The names are checked by themselves first, so that an error cites the name in the file.
        Names::given(angles.iter().chain(&lengths))?;
        let functions = angles.iter().flat_map(|angle| expression::FUNCTIONS.map(|name| format!("{name}_{angle}")));
        let names = Names::given(functions.chain(lengths.iter().cloned()))?;
        Ok(Self { angles, lengths, names })
    }

    /// Returns the names of all variables: `cos_alpha`, `sin_alpha`, `tan_half_alpha` of every angle, then the lengths.
    #[must_use]
    pub const fn names(&self) -> &Names {
        &self.names
    }

    /// Returns the variable that is the cosine of an angle.
    #[must_use]
    pub const fn cos(angle: usize) -> usize {
        3 * angle
    }

    /// Returns the variable that is the sine of an angle.
    #[must_use]
    pub const fn sin(angle: usize) -> usize {
        3 * angle + 1
    }

    /// Returns the variable that is the tangent of half an angle.
    #[must_use]
    pub const fn tan_half(angle: usize) -> usize {
        3 * angle + 2
    }

    /// Returns the variable of a length.
    #[must_use]
    pub fn length(&self, length: usize) -> usize {
        3 * self.angles.len() + length
    }
}

/// An angle as a sum of multiples of the angles of an ansatz and a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Twist {
    /// The coefficient of each angle.
    pub multiples: Vec<i32>,
    /// Cosine and sine of the constant.
    pub constant: (Rational, Rational),
}

/// A joint of an ansatz with the link behind it, `Rz(theta) Tz(d) Rx(alpha) Tx(a)`, theta free.
#[derive(Clone, Debug)]
pub struct SymbolicJoint {
    /// The length of the link, in the variables of [`Symbols`].
    pub a: Polynomial<Rational>,
    /// Its twist.
    pub alpha: Twist,
    /// The offset of the joint.
    pub d: Polynomial<Rational>,
}

/// A relation between the symbols, with its position in the file.
#[derive(Clone, Debug)]
pub struct Relation {
    /// Its text.
    pub text: String,
    /// Line of the file, from 1; 0 where there is no file.
    pub line: usize,
    /// Its meaning.
    pub meaning: Meaning,
}

/// The meaning of a relation.
#[derive(Clone, Debug)]
pub enum Meaning {
    /// This angle is a multiple of a full turn.
    Angle(Twist),
    /// This polynomial vanishes.
    Polynomial(Polynomial<Rational>),
}

/// A symbol that a relation determines, not linearly, from the symbols before it.
#[derive(Clone, Debug, PartialEq)]
enum Solved {
    /// An angle in whose cosine and sine, or half-angle tangent, the polynomial is linear.
    Angle(usize, Polynomial<Rational>),
    /// A length in which the polynomial is linear.
    Length(usize, Polynomial<Rational>),
}

/// A closed chain of revolute joints with symbols for parameters.
#[derive(Clone, Debug)]
pub struct Ansatz {
    /// The name of its file, or the name requested.
    pub name: String,
    /// A title for readers.
    pub title: String,
    /// The publication it is taken from.
    pub source: Option<Source>,
    /// Remarks.
    pub notes: Option<String>,
    /// The symbols.
    pub symbols: Symbols,
    /// The joints round the loop.
    pub joints: Vec<SymbolicJoint>,
    /// Relations between the symbols.
    pub relations: Vec<Relation>,
    /// The lengths, by number, for which conditions are sought.
    pub unknown: Vec<usize>,
    /// The angles, by number, for which conditions are sought.
    pub unknown_angles: Vec<usize>,
    /// The terms that a condition may have, each a product of powers of the variables.
    pub fit: Vec<Polynomial<Rational>>,
    /// Whether a number of the file had to be replaced by a rational nearby.
    pub rounded: bool,
    /// The loop itself, if it has numbers only.
    pub chain: Option<Chain>,
    /// Every angle in terms of the free ones.
    angles: Vec<Twist>,
    /// The angles to which no relation gives a value.
    free_angles: Vec<usize>,
    /// The lengths determined by relations from the others.
    given_lengths: Vec<usize>,
    /// The symbols determined by the other relations, in order: angles first.
    solved: Vec<Solved>,
    /// The reason why no real numbers satisfy the relations, if that is proved.
    empty: Option<String>,
}

impl Ansatz {
    /// Returns the loop of n revolute joints whose twists, lengths and offsets are all symbols: `alpha1`, `a1`, `d1` and so on.
    ///
    /// # Panics
    /// Never: the names are distinct.
    #[must_use]
    pub fn general(joints: usize) -> Self {
        let named = |letter: &str| (1..=joints).map(|k| format!("{letter}{k}")).collect::<Vec<_>>();
        let mut lengths = named("a");
        lengths.extend(named("d"));
        let symbols = Symbols::new(named("alpha"), lengths).expect("the names are distinct");
        let joint = |k: usize| SymbolicJoint {
            a: Polynomial::variable(symbols.length(k)),
            alpha: Twist::symbol(k, joints),
            d: Polynomial::variable(symbols.length(joints + k)),
        };
        Self {
            name: format!("{joints}R"),
            title: format!("General {joints}R loop"),
            source: None,
            notes: None,
            joints: (0..joints).map(joint).collect(),
            angles: (0..joints).map(|k| Twist::symbol(k, joints)).collect(),
            free_angles: (0..joints).collect(),
            symbols,
            relations: Vec::new(),
            unknown: Vec::new(),
            unknown_angles: Vec::new(),
            fit: Vec::new(),
            rounded: false,
            chain: None,
            given_lengths: Vec::new(),
            solved: Vec::new(),
            empty: None,
        }
    }

    /// Returns the angles, by number, to which no relation gives a value.
    #[must_use]
    pub fn free_angles(&self) -> &[usize] {
        &self.free_angles
    }

    /// Returns the lengths, by number, to which no relation gives a value, including those sought.
    #[must_use]
    pub fn free_lengths(&self) -> Vec<usize> {
        let is_solved = |k: usize| self.solved.iter().any(|solved| matches!(solved, Solved::Length(j, _) if *j == k));
        (0..self.symbols.lengths.len()).filter(|k| !self.given_lengths.contains(k) && !is_solved(*k)).collect()
    }

    /// Returns whether nonlinear relations determine some symbols: then a field need not have a member for given values of
    /// the others.
    #[must_use]
    pub fn has_solved_symbols(&self) -> bool {
        !self.solved.is_empty()
    }

    /// Returns the twist of the link behind a joint in terms of the free angles.
    #[must_use]
    pub fn twist(&self, joint: usize) -> Twist {
        self.joints[joint].alpha.in_terms_of(&self.angles)
    }

    /// Returns the names of the symbols for which conditions are sought, lengths first.
    #[must_use]
    pub fn unknown_names(&self) -> Vec<&str> {
        let lengths = self.unknown.iter().map(|&k| self.symbols.lengths[k].as_str());
        lengths.chain(self.unknown_angles.iter().map(|&k| self.symbols.angles[k].as_str())).collect()
    }

    /// Returns every angle in terms of the free ones.
    #[must_use]
    pub fn angles(&self) -> &[Twist] {
        &self.angles
    }

    /// Returns the reason why no real mechanism satisfies the relations; `None` if that is not proved.
    #[must_use]
    pub fn empty(&self) -> Option<&str> {
        self.empty.as_deref()
    }
}

impl Twist {
    /// Returns one of the angles of an ansatz.
    #[must_use]
    pub fn symbol(angle: usize, angles: usize) -> Self {
        let multiples = (0..angles).map(|k| i32::from(k == angle)).collect();
        Self { multiples, constant: (Rational::from(1), Rational::new()) }
    }

    /// Returns whether it contains no angle.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.multiples.iter().all(|&k| k == 0)
    }

    /// Returns a sum of multiples of angles.
    #[must_use]
    pub fn sum<'a>(terms: impl IntoIterator<Item = (i32, &'a Self)>, angles: usize) -> Self {
        let mut sum = Self { multiples: vec![0; angles], constant: (Rational::from(1), Rational::new()) };
        for (factor, angle) in terms {
            for (total, k) in sum.multiples.iter_mut().zip(&angle.multiples) {
                *total += factor * k;
            }
            sum.constant = turned(&sum.constant, &angle.constant, factor);
        }
        sum
    }

    /// Substitutes others for the angles of the ansatz.
    fn in_terms_of(&self, angles: &[Self]) -> Self {
        let constant = Self { multiples: vec![0; angles.len()], constant: self.constant.clone() };
        let terms = self.multiples.iter().copied().zip(angles);
        Self::sum(std::iter::once((1, &constant)).chain(terms), angles.len())
    }

    /// Returns cosine and sine from those of the angles; `None` for an unlucky prime.
    #[must_use]
    pub fn cos_sin<R: Ring>(&self, angles: &[(R, R)]) -> Option<(R, R)> {
        let constant = (R::from_rational(&self.constant.0)?, R::from_rational(&self.constant.1)?);
        let terms = self.multiples.iter().zip(angles);
        Some(terms.fold(constant, |sum, (&factor, angle)| turned(&sum, angle, factor)))
    }
}

/// Returns cosine and sine of `x + factor y`.
fn turned<R: Ring>(x: &(R, R), y: &(R, R), factor: i32) -> (R, R) {
    let y = if factor < 0 { (y.0.clone(), y.1.neg()) } else { y.clone() };
    (0..factor.unsigned_abs())
        .fold(x.clone(), |(cos, sin), _| (cos.mul(&y.0).sub(&sin.mul(&y.1)), sin.mul(&y.0).add(&cos.mul(&y.1))))
}
