//! `looproot poly job`: the jobs by which algebra systems are compared, one JSON file each.
//!
//! The time starts with the texts of the job as given by JSON, so that it includes reading numbers and expressions and
//! clearing denominators.

use super::arguments::JobOptions;
use super::determinant;
use super::input::{Source, check_degrees};
use super::resultant;
use super::timing::{measure, peak_memory};
use crate::command::exit::{Exit, Fault};
use crate::command::output::print;
use looproot::internal::error::Error;
use looproot_algebra::determinant::of_polynomials;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::{Domain, Ring};
use looproot_algebra::text::{Fraction, Names, read_fraction, read_polynomial};
use looproot_algebra::univariate::Univariate;
use rug::Rational;
use serde_json::Value;

type Outcome<T> = Result<T, Error>;

/// Times a job and prints `T` (seconds with reading), `READ` (seconds of that for reading), `TERMS`, `VAL` (the value at
/// the primes 2, 3, 5, ... for the variables in order) and `RSS` (kB).
pub fn run(options: &JobOptions) -> Result<Exit, Fault> {
    let source = Source::of(&format!("@{}", options.file.trim_start_matches('@')))?;
    let path = &options.file;
    let document: Value = serde_json::from_str(&source.text).map_err(|fault| Error::File {
        path: path.clone(),
        line: fault.line(),
        message: format!("found what is no JSON: {fault}"),
    })?;
    let job = Job::of(&document).map_err(|fault| match fault {
        Error::Invalid(message) => Error::Io { path: path.clone(), message },
        other => other,
    })?;
    let (reading, _) = measure(options.seconds, || job.read())?;
    let (seconds, answer) = measure(options.seconds, || job.read().and_then(|input| job.solve(input)))?;
    let (terms, value) = (answer.terms(), answer.value(job.variables()));
    let mut text = format!("T {seconds:.9}\nREAD {reading:.9}\nTERMS {terms}\nVAL {value}\n");
    if let Some(kilobytes) = peak_memory() {
        text.push_str(&format!("RSS {kilobytes}\n"));
    }
    print(&text)?;
    Ok(Exit::Complete)
}

/// A job whose texts are not read yet.
enum Job<'j> {
    /// The determinant of a matrix of coefficient lists in one variable.
    PolyDet(Vec<Vec<Vec<&'j str>>>),
    /// The determinant of a matrix of expressions.
    Det(Vec<&'j str>, Vec<Vec<&'j str>>),
    /// Eliminates a variable from two expressions.
    Resultant(Vec<&'j str>, [&'j str; 2], &'j str),
    /// An expression, divided by another one a number of times.
    Expand(Vec<&'j str>, &'j str, Option<&'j str>, u64),
    /// The product of two expressions.
    Product(Vec<&'j str>, [&'j str; 2]),
    /// The greatest common divisor of two expressions.
    Gcd(Vec<&'j str>, [&'j str; 2]),
    /// The real roots of a coefficient list.
    RootsOfList(Vec<&'j str>),
    /// The real roots of an expression.
    Roots(Vec<&'j str>, &'j str),
}

/// The data of a job as read.
enum Input {
    /// The number of rows, the coefficients of the entries row by row, lowest degree first, and a denominator of the determinant.
    Coefficients(usize, Vec<Vec<Int>>, Int),
    Matrix(Vec<Vec<Fraction>>),
    Polynomials(Vec<Fraction>),
    /// Times a denominator.
    Univariate(Univariate<Int>),
}

enum Answer {
    Polynomial(Fraction),
    Count(usize),
}

impl<'j> Job<'j> {
    fn of(document: &'j Value) -> Outcome<Self> {
        let text = |key: &str| string(&document[key], key);
        let variables = || list(&document["vars"], "vars", string);
        match text("kind")? {
            "polydet" => {
                let row = |row: &'j Value, key: &str| list(row, key, |entry, key| list(entry, key, string));
                Ok(Self::PolyDet(square(list(&document["M"], "M", row)?)?))
            }
            "mpolydet" => {
                let rows = list(&document["M"], "M", |row, key| list(row, key, string))?;
                Ok(Self::Det(variables()?, square(rows)?))
            }
            "res" => Ok(Self::Resultant(variables()?, [text("f")?, text("g")?], text("elim")?)),
            "expand" => {
                let divisor = document["div"].as_str().filter(|text| !text.is_empty());
                let times = divisor.map_or(0, |_| document["times"].as_u64().unwrap_or(1));
                Ok(Self::Expand(variables()?, text("expr")?, divisor, times))
            }
            "mul" => Ok(Self::Product(variables()?, [text("f")?, text("g")?])),
            "gcd" => Ok(Self::Gcd(variables()?, [text("f")?, text("g")?])),
            "roots" if document["poly"].is_string() => Ok(Self::Roots(variables()?, text("poly")?)),
            "roots" => Ok(Self::RootsOfList(list(&document["coefficients"], "coefficients", string)?)),
            kind => Err(Error::Unsupported(format!(
                "jobs of kind `{kind}`, other than polydet, mpolydet, res, expand, mul, gcd and roots"
            ))),
        }
    }

    fn variables(&self) -> usize {
        match self {
            Self::PolyDet(_) | Self::RootsOfList(_) => 1,
            Self::Det(vars, _)
            | Self::Resultant(vars, ..)
            | Self::Expand(vars, ..)
            | Self::Product(vars, _)
            | Self::Gcd(vars, _)
            | Self::Roots(vars, _) => vars.len(),
        }
    }

    /// Reads the texts as numbers and polynomials.
    fn read(&self) -> Outcome<Input> {
        let polynomials = |variables: &[&str], texts: &[&str]| {
            let mut names = Names::given(variables)?;
            texts.iter().map(|text| expand(text, &mut names)).collect::<Outcome<_>>().map(Input::Polynomials)
        };
        match self {
            Self::PolyDet(rows) => {
                let (mut entries, mut denominator) = (Vec::with_capacity(rows.len() * rows.len()), Int::one());
                for row in rows {
                    let own = cleared(row, &mut entries)?;
                    denominator = denominator.mul(&own);
                }
                Ok(Input::Coefficients(rows.len(), entries, denominator))
            }
            Self::Det(variables, rows) => {
                let mut names = Names::given(variables)?;
                let row = |row: &Vec<&str>| row.iter().map(|text| expand(text, &mut names)).collect();
                Ok(Input::Matrix(rows.iter().map(row).collect::<Outcome<_>>()?))
            }
            Self::Resultant(variables, texts, _) | Self::Product(variables, texts) | Self::Gcd(variables, texts) => {
                polynomials(variables, texts)
            }
            Self::Expand(variables, text, None, _) => polynomials(variables, &[text]),
            Self::Expand(variables, text, Some(divisor), _) => polynomials(variables, &[text, divisor]),
            Self::RootsOfList(numbers) => {
                let mut rows = Vec::with_capacity(1);
                cleared(std::slice::from_ref(numbers), &mut rows)?;
                Ok(Input::Univariate(Univariate::new(rows.pop().unwrap_or_default())))
            }
            Self::Roots(variables, text) => {
                let polynomial = expand(text, &mut Names::given(variables)?)?;
                check_degrees(std::slice::from_ref(&polynomial))?;
                let polynomial = polynomial.numerator.to_univariate(0);
                let several = || Error::Invalid("found several variables, expected roots in the first one".to_owned());
                Ok(Input::Univariate(polynomial.ok_or_else(several)?))
            }
        }
    }

    fn solve(&self, input: Input) -> Outcome<Answer> {
        Ok(match (self, input) {
            (_, Input::Coefficients(size, entries, denominator)) => {
                let determinant = Univariate::new(of_polynomials(size, entries));
                let numerator = Polynomial::from_univariate(0, &determinant);
                Answer::Polynomial(Fraction { numerator, denominator }.reduced())
            }
            (_, Input::Matrix(rows)) => {
                rows.iter().try_for_each(|row| check_degrees(row))?;
                Answer::Polynomial(determinant::of_fractions(rows))
            }
            (_, Input::Univariate(polynomial)) => {
                if polynomial.is_zero() {
                    return Err(Error::Invalid("found zero, of which every number is a root".to_owned()));
                }
                Answer::Count(polynomial.real_roots().len())
            }
            (Self::Resultant(variables, _, eliminated), Input::Polynomials(polynomials)) => {
                check_degrees(&polynomials)?;
                let variable = Names::given(variables)?.known(eliminated)?;
                Answer::Polynomial(resultant::of_fractions(&polynomials[0], &polynomials[1], variable))
            }
            (Self::Expand(.., times), Input::Polynomials(polynomials)) => {
                let mut rest = polynomials[0].clone();
                for _ in 0..*times {
                    rest = divide(&rest, &polynomials[1])?;
                }
                Answer::Polynomial(rest)
            }
            (Self::Gcd(..), Input::Polynomials(polynomials)) => {
                check_degrees(&polynomials)?;
                Answer::Polynomial(common_divisor(&polynomials[0], &polynomials[1]))
            }
            (_, Input::Polynomials(polynomials)) => Answer::Polynomial(polynomials[0].times(&polynomials[1])),
        })
    }
}

impl Answer {
    fn terms(&self) -> usize {
        match self {
            Self::Polynomial(result) => result.numerator.len(),
            Self::Count(count) => *count,
        }
    }

    /// Returns the value at the first primes for the variables.
    fn value(&self, variables: usize) -> Rational {
        let primes = (2_i64..).filter(|n| (2..*n).all(|d| n % d != 0));
        match self {
            Self::Polynomial(result) => {
                let primes: Vec<Int> = primes.take(variables).map(Int::from).collect();
                let value = result.numerator.evaluate(&primes).to_integer();
                Rational::from((value, result.denominator.to_integer()))
            }
            Self::Count(count) => Rational::from(*count),
        }
    }
}

/// Returns the exact quotient; the denominator of the divisor becomes a factor.
fn divide(dividend: &Fraction, divisor: &Fraction) -> Outcome<Fraction> {
    let fault = || Error::Invalid("found a division with a remainder, expected an exact one".to_owned());
    let numerator = dividend.numerator.checked_div_exact(&divisor.numerator).ok_or_else(fault)?;
    let numerator = if divisor.denominator == Int::one() { numerator } else { numerator.scale(&divisor.denominator) };
    Ok(Fraction { numerator, denominator: dividend.denominator.clone() }.reduced())
}

/// The greatest common divisor, numbers included: `gcd(f/a, g/b) = gcd(f, g) / lcm(a, b)`, each in lowest terms.
fn common_divisor(f: &Fraction, g: &Fraction) -> Fraction {
    let (a, b) = (&f.denominator, &g.denominator);
    let denominator = a.mul(&b.div_exact(&a.gcd(b)));
    Fraction { numerator: f.numerator.gcd(&g.numerator), denominator }.reduced()
}

/// Reads a row of coefficient lists, appends them times the least common multiple of their denominators, and returns that.
fn cleared(row: &[Vec<&str>], entries: &mut Vec<Vec<Int>>) -> Outcome<Int> {
    let (start, mut denominators) = (entries.len(), Vec::new());
    for entry in row {
        let mut numbers = Vec::with_capacity(entry.len());
        for text in entry {
            let (numerator, denominator) = read_fraction(text)?;
            if denominator != Int::one() {
                denominators.push((entries.len(), numbers.len(), denominator));
            }
            numbers.push(numerator);
        }
        entries.push(numbers);
    }
    let multiple = |common: Int, (.., own): &(usize, usize, Int)| common.mul(&own.div_exact(&common.gcd(own)));
    let common = denominators.iter().fold(Int::one(), multiple);
    if common != Int::one() {
        entries[start..].iter_mut().flatten().for_each(|number| *number = number.mul(&common));
        for (entry, place, own) in &denominators {
            entries[*entry][*place] = entries[*entry][*place].div_exact(own);
        }
    }
    Ok(common)
}

fn expand(text: &str, names: &mut Names) -> Outcome<Fraction> {
    read_polynomial(text, names).map_err(|fault| fault.in_text(text).into())
}

fn string<'j>(value: &'j Value, key: &str) -> Outcome<&'j str> {
    value.as_str().ok_or_else(|| Error::Invalid(format!("`{key}`: found {value}, expected a string")))
}

fn list<'j, T>(value: &'j Value, key: &str, item: impl Fn(&'j Value, &str) -> Outcome<T>) -> Outcome<Vec<T>> {
    let items = value.as_array().ok_or_else(|| Error::Invalid(format!("`{key}`: found {value}, expected a list")))?;
    items.iter().map(|value| item(value, key)).collect()
}

fn square<T>(rows: Vec<Vec<T>>) -> Outcome<Vec<Vec<T>>> {
    if rows.iter().any(|row| row.len() != rows.len()) {
        return Err(Error::Invalid("`M`: found rows of other lengths than their number, expected a square".to_owned()));
    }
    Ok(rows)
}
