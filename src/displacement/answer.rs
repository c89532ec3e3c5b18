//! The answer to a question about displacements or lines: modes with named values, and the verdict.

use crate::algebra::enclosure::Enclosure;
use crate::verdict::{Code, Proof, Status, Verdict};
use looproot_calculus::displacement::screw::Screw;
use looproot_calculus::motion::{Motion, Vector};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix};
use looproot_calculus::rotation::vectors::unit;
use looproot_calculus::unit::{direction, length};
use num_complex::Complex;
use rug::{Float, Rational};
use serde_json::{Map, Value, json};

/// A solution.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Whether it is real.
    pub real: bool,
    /// Its multiplicity.
    pub multiplicity: usize,
    /// Error with which its numbers satisfy the conditions, in f64.
    pub residual: f64,
    /// Bound on the distance of its numbers from the solution; `None` without a proof.
    pub radius: Option<f64>,
    /// Its numbers by name, in the order of reports.
    pub values: Map<String, Value>,
}

/// The answer to one problem.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// Real solutions first.
    pub modes: Vec<Mode>,
    /// Values that belong to the problem as a whole, by name.
    pub keys: Map<String, Value>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Returns a finite number without the sign of zero.
#[must_use]
pub fn number(x: f64) -> Value {
    if x.is_finite() { json!(x + 0.0) } else { Value::Null }
}

/// Returns a list of numbers.
#[must_use]
pub fn list(numbers: &[f64]) -> Value {
    numbers.iter().map(|x| number(*x)).collect()
}

/// Complex numbers as pairs.
#[must_use]
pub fn pairs(numbers: &[Complex<f64>]) -> Value {
    numbers.iter().map(|z| json!([number(z.re), number(z.im)])).collect()
}

/// The rounding of enclosures, with the largest distance that occurred.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rounding {
    /// Bound on the distance of every number from its enclosure.
    pub radius: f64,
}

impl Rounding {
    /// Returns the nearest f64, and records its distance.
    pub fn number(&mut self, enclosure: &Enclosure) -> f64 {
        if enclosure.holds_zero() {
            self.radius = self.radius.max(power_of_two(enclosure.off().max(enclosure.size())));
            return 0.0;
        }
        let rounded = enclosure.middle().to_f64();
        let apart = Float::with_val(64, enclosure.middle() - rounded).abs().to_f64();
        // Twice the distance covers the rounding of the subtraction.
        self.radius = self.radius.max(2.0 * apart + power_of_two(enclosure.off()));
        rounded
    }

    /// Returns the nearest vector in f64, and records its distance.
    pub fn vector<const N: usize>(&mut self, vector: &[Enclosure; N]) -> [f64; N] {
        vector.each_ref().map(|c| self.number(c))
    }

    /// Returns the nearest matrix in f64, and records its distance.
    pub fn matrix<const N: usize, const M: usize>(&mut self, matrix: &[[Enclosure; N]; M]) -> [[f64; N]; M] {
        matrix.each_ref().map(|row| self.vector(row))
    }
}

/// Returns `2^k`, 0 for exact numbers.
fn power_of_two(k: i32) -> f64 {
    if k == i32::MIN { 0.0 } else { 2.0_f64.powi(k.max(-1000)) }
}

/// Quaternion and matrix of a rotation.
pub fn insert_rotation(values: &mut Map<String, Value>, matrix: &Matrix<f64>) {
    let q = unit(&from_matrix(matrix));
    let parts = q.map(|q| list(&[q.scalar, q.vector[0], q.vector[1], q.vector[2]]));
    values.insert("quaternion".into(), parts.unwrap_or(Value::Null));
    values.insert("matrix".into(), matrix.iter().map(|row| list(row)).collect());
}

/// Quaternion and 4 x 4 matrix of a motion.
pub fn insert_motion(values: &mut Map<String, Value>, motion: &Motion<f64>) {
    insert_rotation(values, &motion.rotation);
    values.insert("matrix".into(), homogeneous(motion));
}

/// Returns the 4 x 4 matrix of a motion.
#[must_use]
pub fn homogeneous(motion: &Motion<f64>) -> Value {
    let row = |i: usize| {
        let [a, b, c] = motion.rotation[i];
        list(&[a, b, c, motion.translation[i]])
    };
    json!([row(0), row(1), row(2), [0, 0, 0, 1]])
}

/// Returns the screw of a motion with the keys of LINKAGES: direction, point, moment, angle, translation, pitch.
#[must_use]
pub fn screw(motion: &Motion<f64>) -> Value {
    let Some(found) = Screw::of(motion) else { return Value::Null };
    let vector = |v: &Option<[f64; 3]>| v.map_or(Value::Null, |v| list(&v));
    let angle = found.angle().unwrap_or(0.0);
    json!({
        "direction": vector(&found.direction),
        "point": vector(&found.point),
        "moment": vector(&found.axis().map(|axis| axis.moment)),
        "angle": number(angle),
        "translation": number(found.translation),
        "pitch": found.pitch().map_or(Value::Null, number),
    })
}

/// The unique solution of linear equations: numbers with names, each rounded once.
#[derive(Clone, Debug, Default)]
pub struct Named {
    rounding: Rounding,
    values: Map<String, Value>,
}

impl Named {
    /// Adds a number.
    pub fn number(&mut self, name: &str, found: &Rational) {
        let rounded = self.rounding.number(&Enclosure::of(found));
        self.put(name, number(rounded));
    }

    /// Adds a vector.
    pub fn vector(&mut self, name: &str, found: &Vector<Rational>) {
        let rounded = self.rounded(found);
        self.put(name, list(&rounded));
    }

    /// Adds the unit vector along a vector; null for the zero vector.
    pub fn unit(&mut self, name: &str, along: &Vector<Rational>) {
        let unit = direction(&along.each_ref().map(Enclosure::of));
        let rounded = unit.map(|unit| list(&self.rounding.vector(&unit)));
        self.put(name, rounded.unwrap_or(Value::Null));
    }

    /// Adds the length of a vector.
    pub fn length(&mut self, name: &str, of: &Vector<Rational>) {
        let found = length(&of.each_ref().map(Enclosure::of)).map(|found| number(self.rounding.number(&found)));
        self.put(name, found.unwrap_or(Value::Null));
    }

    /// Rounds a vector to f64 and records the rounding error.
    pub fn rounded(&mut self, vector: &Vector<Rational>) -> [f64; 3] {
        self.rounding.vector(&vector.each_ref().map(Enclosure::of))
    }

    /// Adds a number that is enclosed.
    pub fn enclosed(&mut self, name: &str, found: &Enclosure) {
        let rounded = self.rounding.number(found);
        self.put(name, number(rounded));
    }

    /// Adds numbers that are enclosed.
    pub fn enclosures<const N: usize>(&mut self, name: &str, found: &[Enclosure; N]) {
        let rounded = self.rounding.vector(found);
        self.put(name, list(&rounded));
    }

    /// Adds the numbers of another answer under one name.
    pub fn under(&mut self, name: &str, own: Self) {
        self.rounding.radius = self.rounding.radius.max(own.rounding.radius);
        self.put(name, own.into_value());
    }

    /// Adds any other value.
    pub fn put(&mut self, name: &str, value: Value) {
        self.values.insert(name.to_owned(), value);
    }

    /// Returns the numbers as one value.
    #[must_use]
    pub fn into_value(self) -> Value {
        Value::Object(self.values)
    }

    /// Returns the answer that has this solution and no other.
    #[must_use]
    pub fn answer(self, reason: impl Into<String>) -> Answer {
        let Self { rounding, values } = self;
        let mode = Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(rounding.radius), values };
        let counted = Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.into() };
        Answer::complete(vec![mode], counted)
    }
}

/// The number of solutions and its proof.
pub struct Counted {
    /// Isolated complex solutions, with multiplicity.
    pub complex: usize,
    /// The code of the proof on which the verdict rests.
    pub code: Code,
    /// Number of solutions of the general problem that are at infinity here.
    pub at_infinity: usize,
    /// The reason in words.
    pub reason: String,
}

impl Answer {
    /// Returns the answer for solutions that are all known and whose number is proved.
    #[must_use]
    pub fn complete(modes: Vec<Mode>, counted: Counted) -> Self {
        // Each real solution counts once, whatever its multiplicity.
        let real = modes.iter().filter(|mode| mode.real).count();
        let certified = modes.iter().filter(|mode| mode.real && mode.radius.is_some()).count();
        let status = if real == 0 { Status::Unreachable } else { Status::Complete };
        let Counted { complex, code, at_infinity, reason } = counted;
        let code = if complex == 0 { Code::NoSolution } else { code };
        let verdict = Verdict {
            status,
            proof: Proof::Proved,
            code,
            complex_complete: true,
            complex,
            real,
            at_infinity,
            self_motion: 0,
            certified,
            reason,
        };
        Self { verdict, modes, keys: Map::new(), warnings: Vec::new() }
    }

    /// Returns the answer for solutions that form a set of some dimension, with a sample of it.
    #[must_use]
    pub fn family(dimension: usize, sample: Option<Value>, reason: impl Into<String>) -> Self {
        let verdict = Verdict {
            status: Status::SelfMotion,
            proof: Proof::Proved,
            code: Code::SelfMotion,
            complex_complete: false,
            complex: 0,
            real: 0,
            at_infinity: 0,
            self_motion: dimension,
            certified: 0,
            reason: reason.into(),
        };
        let mut keys = Map::new();
        if let Some(sample) = sample {
            keys.insert("sample".into(), sample);
        }
        Self { verdict, modes: Vec::new(), keys, warnings: Vec::new() }
    }

    /// Returns the answer if nothing satisfies the conditions exactly, with a nearest solution instead.
    #[must_use]
    pub fn nearest(mode: Option<Mode>, reason: impl Into<String>) -> Self {
        let verdict = Verdict {
            status: Status::Incomplete,
            proof: Proof::None,
            code: Code::NotDecided,
            complex_complete: false,
            complex: 0,
            real: 0,
            at_infinity: 0,
            self_motion: 0,
            certified: 0,
            reason: reason.into(),
        };
        Self { verdict, modes: mode.into_iter().collect(), keys: Map::new(), warnings: Vec::new() }
    }

    /// Returns the answer if there is no solution, not even a complex one.
    #[must_use]
    pub fn none(reason: impl Into<String>) -> Self {
        Self::complete(
            Vec::new(),
            Counted { complex: 0, code: Code::NoSolution, at_infinity: 0, reason: reason.into() },
        )
    }

    /// Marks the answer of numbers of which some had to be rounded: the proof holds for the rounded ones.
    #[must_use]
    pub fn of_rounded(mut self, is_rounded: bool) -> Self {
        self.verdict.proof = self.verdict.proof.of_rounded(is_rounded);
        self
    }
}
