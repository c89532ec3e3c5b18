//! `looproot poly det`

use super::arguments::DetOptions;
use super::input::{self, Source};
use super::tell;
use crate::command::exit::{Exit, Fault};
use looproot::internal::error::Error;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::{Domain, Ring};
use looproot_algebra::text::{Expression, Fraction};

/// Computes the determinant of a matrix of polynomials.
pub fn run(options: &DetOptions) -> Result<Exit, Fault> {
    let source = Source::of(&options.matrix)?;
    let mut names = input::names(&options.read)?;
    let rows = Expression::parse_matrix(&source.text, &mut names).map_err(|fault| source.fault(fault))?;
    if let Some(row) = rows.iter().find(|row| row.len() != rows.len()) {
        let found = format!("found {} rows and one of {} entries, expected as many", rows.len(), row.len());
        return Err(Error::Invalid(found).into());
    }
    let expand = |entry: &Expression| entry.expand().map_err(|fault| source.fault(fault));
    let rows: Result<Vec<Vec<Fraction>>, Error> = rows.iter().map(|row| row.iter().map(expand).collect()).collect();
    let rows = rows?;
    for row in &rows {
        input::check_degrees(row)?;
    }
    let result = of_fractions(rows);
    tell::results(&[result], &names, &options.write, &input::files(&[&options.matrix]))?;
    Ok(Exit::Complete)
}

/// Returns the determinant, with the denominators of each row cleared first.
pub fn of_fractions(rows: Vec<Vec<Fraction>>) -> Fraction {
    let mut denominators = Vec::new();
    let cleared: Vec<Vec<Polynomial<Int>>> = rows
        .into_iter()
        .map(|row| {
            let lcm = row.iter().fold(Int::one(), |lcm, entry| {
                if entry.denominator == lcm {
                    lcm
                } else {
                    lcm.mul(&entry.denominator.div_exact(&lcm.gcd(&entry.denominator)))
                }
            });
            let entry = |entry: Fraction| {
                let Fraction { numerator, denominator } = entry;
                if denominator == lcm { numerator } else { numerator.scale(&lcm.div_exact(&denominator)) }
            };
            let cleared = row.into_iter().map(entry).collect();
            denominators.push(lcm);
            cleared
        })
        .collect();
    let denominator = denominators.iter().fold(Int::one(), |product, d| product.mul(d));
    Fraction { numerator: Polynomial::determinant(&cleared), denominator }.reduced()
}
