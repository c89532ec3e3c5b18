//! Comparison of exact closure polynomials with the solutions found in floating point.

use crate::assembly::wrapped;
use crate::derivation::Derivation;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{FullMode, Solution};
use crate::verdict::Status;
use num_complex::Complex;
use std::collections::BTreeMap;

/// Values of the unknown nearer to each other than this count as equal.
const NEAR: f64 = 1e-6;

/// The result of one comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Agreement {
    /// The roots are simple, one for each solution, and the numbers of all and of real ones agree.
    Solutions,
    /// Several solutions share a root, or coincide. The numbers agree with multiplicity where it is known, and there are as
    /// many distinct roots, and real ones, as the solutions have distinct values.
    Values,
    /// There is no polynomial, or no finite number of solutions, for this reason.
    NotComparable(String),
    /// The difference found.
    Differs(String),
}

/// Compares the derivation of a loop with the answer of the solver to the same case.
#[must_use]
pub fn compare(derivation: &Derivation, chain: &Chain, solution: &Solution) -> Agreement {
    let verdict = &solution.verdict;
    if verdict.status == Status::SelfMotion {
        return Agreement::NotComparable("a self-motion".to_owned());
    }
    let (Some(polynomial), Some(unknown)) = (&derivation.polynomial, derivation.unknown(chain)) else {
        let isolated = matches!(verdict.status, Status::Complete | Status::Unreachable);
        if isolated && verdict.complex > 0 {
            return Agreement::Differs(format!("{} solutions, no polynomial", verdict.complex));
        }
        return Agreement::NotComparable("no polynomial, and no solution found".to_owned());
    };
    if !derivation.finite && verdict.status == Status::Incomplete {
        return Agreement::NotComparable("solutions that are not isolated, and a list not called complete".to_owned());
    }
    let degree = polynomial.degree() + polynomial.at_pi;
    if derivation.per_root == 1 && degree != verdict.complex {
        return Agreement::Differs(format!("degree {degree}, {} solutions", verdict.complex));
    }
    let at_pi = usize::from(polynomial.at_pi > 0);
    let (roots, real) = (polynomial.distinct() + at_pi, polynomial.roots.len() + at_pi);
    if derivation.per_root == 1 && roots == degree {
        if real != verdict.real {
            return Agreement::Differs(format!("{real} real roots, {} real solutions", verdict.real));
        }
        return Agreement::Solutions;
    }
    let values = distinct(unknown, &solution.modes);
    let real_values = values.iter().filter(|value| value.im.abs() < NEAR).count();
    if (values.len(), real_values) != (roots, real) {
        return Agreement::Differs(format!(
            "{roots} distinct roots, {real} of them real; the solutions have {} values, {real_values} of them real",
            values.len()
        ));
    }
    Agreement::Values
}

/// Number of comparisons by result.
#[derive(Clone, Debug, Default)]
pub struct Agreements {
    /// [`Agreement::Solutions`]
    pub solutions: usize,
    /// [`Agreement::Values`]
    pub values: usize,
    /// [`Agreement::NotComparable`], by the reason.
    pub not_comparable: BTreeMap<String, usize>,
    /// [`Agreement::Differs`]: the number of the sample, and the difference.
    pub differ: Vec<(u64, String)>,
    /// Polynomials for which it is proved only modulo a prime that every root belongs to a solution.
    pub unproved: usize,
    /// Seconds for all derivations.
    pub time: f64,
    /// Seconds for the longest one.
    pub longest: f64,
}

impl Agreements {
    /// Returns the tally of one comparison.
    pub(super) fn of(index: u64, agreement: Agreement, proved: bool, time: f64) -> Self {
        let mut one = Self { unproved: usize::from(!proved), time, longest: time, ..Self::default() };
        match agreement {
            Agreement::Solutions => one.solutions = 1,
            Agreement::Values => one.values = 1,
            Agreement::NotComparable(reason) => {
                one.not_comparable.insert(reason, 1);
            }
            Agreement::Differs(how) => one.differ.push((index, how)),
        }
        one
    }

    pub(super) fn and(mut self, mut other: Self) -> Self {
        self.solutions += other.solutions;
        self.values += other.values;
        for (reason, count) in other.not_comparable {
            *self.not_comparable.entry(reason).or_default() += count;
        }
        self.differ.append(&mut other.differ);
        self.unproved += other.unproved;
        self.time += other.time;
        self.longest = self.longest.max(other.longest);
        self
    }

    /// Returns the number of comparisons.
    #[must_use]
    pub fn count(&self) -> usize {
        self.solutions + self.values + self.not_comparable.values().sum::<usize>() + self.differ.len()
    }
}

/// Returns the distinct values of an unknown.
fn distinct((index, kind): (usize, Variable), modes: &[FullMode]) -> Vec<Complex<f64>> {
    let apart = |a: Complex<f64>, b: Complex<f64>| match kind {
        Variable::Rotation => wrapped(a.re - b.re).hypot(a.im - b.im),
        Variable::Translation => (a - b).norm(),
    };
    let mut values: Vec<Complex<f64>> = Vec::new();
    for value in modes.iter().map(|mode| mode.q[index]) {
        if values.iter().all(|other| apart(*other, value) >= NEAR) {
            values.push(value);
        }
    }
    values
}
