//! An upper bound on the number of solutions of a loop by an eliminant in one unknown: theorem 4 of docs/certificate.md, after
//! \[RaghavanRoth1993\].

use super::all_roots::all_roots;
use super::chain::ChainClosure;
use super::fault::{Fault, refused};
use super::isolation::Longer;
use super::lines::{COLUMNS, Kinds, Rows, Square, at, matrix};
use super::mode::Ball;
use super::record::{count, decimal, fields};
use crate::algebra::determinant::modular;
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Value, json};

/// Degree of its minors: 2 for each row.
const DEGREE: usize = 2 * COLUMNS;
/// Maximum number of bits of a number of a link: those of a pose by four integers of 60 bits have some 250.
const LONGEST: u32 = 512;
/// A value of the hidden unknown at which a nonzero minor is unlikely to vanish.
const SOMEWHERE: (i32, i32) = (17, 5);

/// The choice of the hidden unknown. Any choice that gives a bound is a proof.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Choice {
    /// The unknown from which the loop is read, from 0.
    pub first: usize,
    /// The hidden unknown among the first three, from 0.
    pub hidden: usize,
    /// The half-angle tangent of the angle from which a hidden angle is counted.
    pub shift: Rational,
}

impl Choice {
    /// Reads the value of `aid`.
    pub(super) fn read(aid: &Value) -> Result<Self, Fault> {
        let [first, hidden, shift] = fields(aid, ["first", "hidden", "shift"], &[])?;
        Ok(Self { first: count(first)?, hidden: count(hidden)?, shift: decimal(shift)? })
    }

    /// Returns the value of `aid` for a certificate; the shift is a decimal of few digits.
    pub(super) fn json(&self) -> Value {
        json!({ "first": self.first, "hidden": self.hidden, "shift": self.shift.to_f64().to_string() })
    }
}

/// Returns the number of solutions that the eliminant of a choice allows; the balls provide starts for its roots.
///
/// # Errors
/// [`Fault::Refused`] if it gives no bound.
pub(super) fn solutions_by_eliminant(closure: &ChainClosure, choice: &Choice, balls: &[Ball]) -> Result<usize, Fault> {
    let Some(links) = closure.exact.as_ref().filter(|_| closure.spherical.is_empty()) else {
        return refused("proof: eliminant: only loops of rotations and translations with rational constants have one");
    };
    solutions_of_loop(links, &closure.variables.map(Some), choice, &starts(closure, choice, balls))
}

/// As [`solutions_by_eliminant`], of the loop without the rotations that were added to it.
pub(super) fn own_solutions_by_eliminant(
    closure: &ChainClosure,
    choice: &Choice,
    balls: &[Ball],
) -> Result<usize, Fault> {
    let Some(own) = closure.own_links.as_ref().filter(|_| closure.spherical.is_empty()) else {
        return refused(
            "proof: own-eliminant: only loops of rotations and translations with rational constants have one",
        );
    };
    let links = std::array::from_fn(|k| own.get(k).cloned().unwrap_or_else(Motion::identity));
    let kinds = std::array::from_fn(|k| Some(closure.variables[k]).filter(|_| k < closure.own));
    solutions_of_loop(&links, &kinds, choice, &starts(closure, choice, balls))
}

/// Returns starts for the search of the roots: the hidden unknown at the modes.
fn starts(closure: &ChainClosure, choice: &Choice, balls: &[Ball]) -> Vec<Complex<f64>> {
    let unknown = (choice.first + choice.hidden) % 6;
    let is_angle = closure.variables[unknown] == Variable::Rotation;
    balls.iter().filter_map(|ball| start(ball.centre.get(unknown)?, is_angle, &choice.shift)).collect()
}

/// Returns the number of solutions that the eliminant of a choice allows to a loop with these links behind its unknowns.
/// The search for its roots begins at the starts.
fn solutions_of_loop(
    links: &[Motion<Rational>; 6],
    kinds: &Kinds,
    choice: &Choice,
    starts: &[Complex<f64>],
) -> Result<usize, Fault> {
    let no = |why: &str| refused(format!("proof: eliminant: {why}"));
    let (rows, minor, is_angle) = prepared(links, kinds, choice)?;
    if is_angle && minor.degree() != Some(DEGREE) {
        return no("an angle of pi is a root");
    }
    let minor = if is_angle { minor.remove_factor(&Univariate::circle()).1 } else { minor };
    let Some(roots) = all_roots(&minor.square_free_part(), starts) else { return no("its roots are not told apart") };
    let Some(rows) = enclosed(&rows) else { return no("the numbers are too long") };
    let mut most = 0;
    for root in &roots {
        match solutions_at(&rows, root) {
            Some(few) => most += few,
            None => return no("too many solutions may have one value"),
        }
    }
    Ok(most)
}

/// Returns the matrix of a choice, a nonzero minor of it, and whether the hidden unknown is an angle.
fn prepared(
    links: &[Motion<Rational>; 6],
    kinds: &Kinds,
    choice: &Choice,
) -> Result<(Rows<Rational>, Univariate<Rational>, bool), Fault> {
    let no = |why: &str| refused(format!("proof: eliminant: {why}"));
    if choice.first > 5 || choice.hidden > 2 {
        return no("no such unknown");
    }
    if links.iter().any(is_long) || bits(&choice.shift) > LONGEST {
        return no("the numbers are too long");
    }
    let around = |k: usize| (choice.first + k) % 6;
    let kinds: Kinds = std::array::from_fn(|k| kinds[around(k)]);
    let mut links: [Motion<Rational>; 6] = std::array::from_fn(|k| links[around(k)].clone());
    if kinds[3] == Some(Variable::Translation) || kinds[..3].contains(&None) {
        return no("the fourth unknown is no rotation, or one of the first three is held");
    }
    let is_angle = kinds[choice.hidden] == Some(Variable::Rotation);
    if is_angle {
        // The angle is counted from another origin, so that it is pi at no solution.
        let square = Rational::from(choice.shift.square_ref());
        let below = Rational::from(&square + 1);
        let (cos, sin) = ((Rational::from(1) - square) / &below, Rational::from(&choice.shift * 2) / below);
        links[choice.hidden] = Motion::rotation_z(cos, sin).then_after(&links[choice.hidden]);
    }
    let Some(rows) = matrix(&links, &kinds, choice.hidden) else {
        return no("the other unknowns do not follow from three of them");
    };
    let minor = minor(&rows)?;
    Ok((rows, minor, is_angle))
}

/// Returns a nonzero minor for the unknown `first + hidden` of a loop that is read from the unknown `first`.
pub(super) fn minor_of(
    links: &[Motion<Rational>; 6],
    variables: &[Variable; 6],
    first: usize,
    hidden: usize,
) -> Result<Univariate<Rational>, Fault> {
    let choice = Choice { first, hidden, shift: Rational::new() };
    prepared(links, &variables.map(Some), &choice).map(|(_, minor, _)| minor)
}

fn bits(x: &Rational) -> u32 {
    x.numer().significant_bits().max(x.denom().significant_bits())
}

/// Returns whether numbers of a link are too long for the computation.
pub(super) fn is_long(link: &Motion<Rational>) -> bool {
    link.rotation.iter().flatten().chain(&link.translation).any(|x| bits(x) > LONGEST)
}

/// Returns the start for a root: the hidden unknown at a mode, as half-angle tangent if it is an angle.
fn start((re, im): &(Rational, Rational), is_angle: bool, shift: &Rational) -> Option<Complex<f64>> {
    let value = Complex::new(re.to_f64(), im.to_f64());
    let start = if is_angle { (0.5 * value - shift.to_f64().atan()).tan() } else { value };
    start.is_finite().then_some(start)
}

/// Returns the matrix in balls.
fn enclosed(rows: &Rows<Rational>) -> Option<Rows<Longer>> {
    let entry = |[a, b, c]: &Square<Rational>| {
        Some([Longer::from_rational(a)?, Longer::from_rational(b)?, Longer::from_rational(c)?])
    };
    rows.iter().map(|row| row.iter().map(entry).collect()).collect()
}

/// Returns a nonzero minor of twelve rows.
fn minor(rows: &Rows<Rational>) -> Result<Univariate<Rational>, Fault> {
    let here = Echelon::of(at(rows, &Rational::from(SOMEWHERE)), COLUMNS);
    if here.rank() < COLUMNS {
        return refused("proof: eliminant: it is 0");
    }
    let chosen = here.independent_rows();
    let power = |k: usize| -> Vec<Vec<Rational>> {
        chosen.iter().map(|row| rows[*row].iter().map(|entry| entry[k].clone()).collect()).collect()
    };
    Ok(modular(&[power(0), power(1), power(2)]))
}

/// Returns the number of solutions that a root allows: the corank, or none if the only kernel vector is no `u^i v^j`;
/// `None` if the corank is above 2.
fn solutions_at(rows: &Rows<Longer>, root: &Longer) -> Option<usize> {
    let mut entries = at(rows, root);
    let (mut left, mut columns): (Vec<usize>, Vec<usize>) = ((0..rows.len()).collect(), (0..COLUMNS).collect());
    let mut steps = Vec::new();
    while !columns.is_empty() {
        let places = left.iter().flat_map(|i| columns.iter().map(move |j| (*i, *j)));
        let sized = places.map(|(i, j)| (entries[i][j].lower(), i, j));
        let Some((size, i, j)) = sized.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if size <= 0 {
            break;
        }
        left.retain(|row| *row != i);
        columns.retain(|column| *column != j);
        steps.push((i, j));
        let inverse = entries[i][j].inverse()?;
        let pivot = entries[i].clone();
        for row in &left {
            let factor = entries[*row][j].mul(&inverse);
            for column in &columns {
                entries[*row][*column] = entries[*row][*column].sub(&factor.mul(&pivot[*column]));
            }
        }
    }
    let [free] = columns.as_slice() else { return (columns.len() <= 2).then_some(columns.len()) };
    let mut vector: Vec<Option<Longer>> = vec![None; COLUMNS];
    vector[*free] = Some(Longer::one());
    for (i, j) in steps.into_iter().rev() {
        let known = vector.iter().enumerate().filter_map(|(k, x)| Some((k, x.as_ref()?)));
        let sum = known.fold(Longer::zero(), |sum, (k, x)| sum.add(&entries[i][k].mul(x)));
        vector[j] = Some(sum.neg().over(&entries[i][j])?);
    }
    let vector: Vec<Longer> = vector.into_iter().collect::<Option<_>>()?;
    Some(usize::from(may_be_powers(&vector)))
}

/// Returns whether a vector may be `u^i v^j`: products of two entries whose exponents have the same sum are equal.
fn may_be_powers(vector: &[Longer]) -> bool {
    let exponents = |k: usize| (k / 3, k % 3);
    let pairs: Vec<(usize, usize)> = (0..COLUMNS).flat_map(|a| (a..COLUMNS).map(move |b| (a, b))).collect();
    let sum = |(a, b): (usize, usize)| {
        let ((i, j), (k, l)) = (exponents(a), exponents(b));
        (i + k, j + l)
    };
    let product = |(a, b): (usize, usize)| vector[a].mul(&vector[b]);
    pairs.iter().enumerate().all(|(at, one)| {
        let same = pairs[..at].iter().find(|other| sum(**other) == sum(*one));
        same.is_none_or(|other| product(*one).sub(&product(*other)).contains_zero())
    })
}
