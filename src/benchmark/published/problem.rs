//! Problems as lines of JSON: numbers that any solver can read, and all their real solutions.

use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use serde_json::{Value, json};

/// The `format` in the first line of a file of problems.
pub const PROBLEMS: &str = "looproot-problems";
/// Version of both formats.
pub const VERSION: u64 = 1;

/// A joint variable: rotation about or translation along a line, given at joint variables 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Rotation or translation.
    pub variable: Variable,
    /// Its direction, of length 1.
    pub direction: [f64; 3],
    /// A point of it, metres.
    pub point: [f64; 3],
}

/// The mechanism and the pose or legs to solve for.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A product of motions about axes, times `home`, that must equal `pose`. A closed loop has the identity as pose.
    Chain {
        /// The joint variables in order.
        axes: Vec<Axis>,
        /// The pose of the tool when all joint variables are 0.
        home: Motion<f64>,
        /// The pose to reach.
        pose: Motion<f64>,
        /// The first of the three angles of every spherical joint, counted from 0.
        spherical: Vec<usize>,
    },
    /// Six legs between points.
    Platform {
        /// Points of the base, metres.
        base: [[f64; 3]; 6],
        /// Points of the moving platform in its own frame, metres.
        plate: [[f64; 3]; 6],
        /// Lengths of the legs, metres.
        legs: [f64; 6],
    },
}

/// A real solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Joint variables, radians and metres; for a platform the quaternion, w first, and the position.
    pub q: Vec<f64>,
    /// The number of solutions that coincide.
    pub multiplicity: usize,
    /// Row-sum condition number of the Jacobian, lengths over the scale of the mechanism; infinite for a multiple solution.
    pub condition: f64,
}

/// A problem with its truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Its name in the file.
    pub id: String,
    /// The set to which it belongs.
    pub class: String,
    /// The mechanism and the pose or legs to solve for.
    pub body: Body,
    /// All real solutions, with a proof of completeness.
    pub truth: Vec<Truth>,
    /// The number of solutions, complex ones and multiplicities counted.
    pub complex: usize,
    /// The dimension of the self-motion that the solutions form; 0 where they are isolated. Then no truth is listed.
    pub self_motion: usize,
}

/// A file of problems.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems {
    /// The hash of its lines.
    pub hash: String,
    /// In the order of the file.
    pub problems: Vec<Problem>,
}

/// Returns the hash of the lines of problems, as 16 hexadecimal digits: 64-bit FNV-1a over their bytes, each followed by a
/// line break.
#[must_use]
pub fn hash<'a>(lines: impl IntoIterator<Item = &'a str>) -> String {
    let bytes = lines.into_iter().flat_map(|line| line.bytes().chain(std::iter::once(b'\n')));
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.fold(0xcbf2_9ce4_8422_2325, step))
}

/// Returns the first line of a file of problems.
#[must_use]
pub fn header(sets: &str, seed: u64, lines: &[String]) -> Value {
    json!({
        "format": PROBLEMS, "version": VERSION, "program": concat!("looproot ", env!("CARGO_PKG_VERSION")), "sets": sets,
        "seed": seed, "count": lines.len(), "hash": hash(lines.iter().map(String::as_str)),
    })
}

impl Problems {
    /// Reads a file of problems.
    ///
    /// # Errors
    /// Names the line that does not conform to docs/benchmark.md, or reports a hash that differs from that of the lines.
    pub fn read(text: &str) -> Result<Self> {
        let mut lines = text.lines();
        let head = object(1, lines.next().unwrap_or_default())?;
        check_format(&head, PROBLEMS)?;
        let lines: Vec<&str> = lines.filter(|line| !line.trim().is_empty()).collect();
        let (own, stated) = (hash(lines.iter().copied()), head["hash"].as_str().unwrap_or_default());
        if own != stated {
            return Err(Error::Invalid(format!("line 1: found the hash `{stated}`, expected {own} for these lines")));
        }
        let read = |(at, line): (usize, &&str)| Problem::read(&object(at + 2, line)?, at + 2);
        Ok(Self { hash: own, problems: lines.iter().enumerate().map(read).collect::<Result<_>>()? })
    }
}

pub(super) fn object(line: usize, text: &str) -> Result<Value> {
    let value: Value = serde_json::from_str(text).map_err(|error| Error::Invalid(format!("line {line}: {error}")))?;
    if value.is_object() { Ok(value) } else { Err(wrong(line, "a line", "one JSON object")) }
}

/// Checks that a first line names a format and its version.
pub(super) fn check_format(head: &Value, format: &str) -> Result<()> {
    if head["format"] != format || head["version"] != VERSION {
        let (found, version) = (&head["format"], &head["version"]);
        let expected = format!("found the format {found}, version {version}, expected {format}, version {VERSION}");
        return Err(Error::Invalid(format!("line 1: {expected}")));
    }
    Ok(())
}

pub(super) fn wrong(line: usize, what: &str, expected: &str) -> Error {
    Error::Invalid(format!("line {line}: found {what} that is not {expected}"))
}

/// Reads the finite numbers of a list.
pub(super) fn numbers(line: usize, value: &Value, what: &str) -> Result<Vec<f64>> {
    let finite = |value: &Value| value.as_f64().filter(|x| x.is_finite());
    let list: Option<Vec<f64>> = value.as_array().and_then(|list| list.iter().map(finite).collect());
    list.ok_or_else(|| wrong(line, &format!("`{what}`"), "a list of numbers"))
}

fn several<const N: usize>(line: usize, value: &Value, what: &str) -> Result<[f64; N]> {
    let list = numbers(line, value, what)?;
    list.try_into().map_err(|_| wrong(line, &format!("`{what}`"), &format!("{N} numbers")))
}

fn rows<const N: usize, const M: usize>(line: usize, value: &Value, what: &str) -> Result<[[f64; N]; M]> {
    let list =
        value.as_array().into_iter().flatten().map(|row| several(line, row, what)).collect::<Result<Vec<_>>>()?;
    list.try_into().map_err(|_| wrong(line, &format!("`{what}`"), &format!("{M} rows")))
}

fn word(line: usize, value: &Value, what: &str) -> Result<String> {
    value.as_str().map(str::to_owned).ok_or_else(|| wrong(line, &format!("`{what}`"), "a text"))
}

fn motion(line: usize, value: &Value, what: &str) -> Result<Motion<f64>> {
    let rows: [[f64; 4]; 4] = rows(line, value, what)?;
    Ok(Motion {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j])),
        translation: std::array::from_fn(|i| rows[i][3]),
    })
}

fn matrix(motion: &Motion<f64>) -> Value {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (row, x) in motion.rotation.iter().zip(motion.translation) {
        rows.push(row.iter().copied().chain([x]).collect());
    }
    rows.push(vec![0.0, 0.0, 0.0, 1.0]);
    json!(rows)
}

impl Axis {
    fn read(value: &Value, line: usize) -> Result<Self> {
        let variable = match value["type"].as_str() {
            Some("R") => Variable::Rotation,
            Some("P") => Variable::Translation,
            _ => return Err(wrong(line, "the `type` of an axis", "R or P")),
        };
        let direction = several(line, &value["direction"], "direction")?;
        Ok(Self { variable, direction, point: several(line, &value["point"], "point")? })
    }
}

impl Body {
    fn read(value: &Value, line: usize) -> Result<Self> {
        match value["kind"].as_str() {
            Some("chain") => {
                let axes = value["axes"].as_array().into_iter().flatten();
                let axes: Vec<Axis> = axes.map(|axis| Axis::read(axis, line)).collect::<Result<_>>()?;
                let first = |index: &Value| {
                    let index = index.as_u64().and_then(|index| usize::try_from(index).ok());
                    index.filter(|index| *index < axes.len().saturating_sub(2))
                };
                let spherical: Option<Vec<usize>> =
                    value["spherical"].as_array().into_iter().flatten().map(first).collect();
                let spherical = spherical.ok_or_else(|| wrong(line, "`spherical`", "a list of numbers of axes"))?;
                let (home, pose) = (motion(line, &value["home"], "home")?, motion(line, &value["pose"], "pose")?);
                Ok(Self::Chain { axes, home, pose, spherical })
            }
            Some("platform") => Ok(Self::Platform {
                base: rows(line, &value["base"], "base")?,
                plate: rows(line, &value["plate"], "plate")?,
                legs: several(line, &value["legs"], "legs")?,
            }),
            _ => Err(wrong(line, "the `kind`", "chain or platform")),
        }
    }

    /// Returns the number of unknowns of a solution.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Chain { axes, .. } => axes.len(),
            Self::Platform { .. } => 7,
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Chain { axes, home, pose, spherical } => {
                let axis = |axis: &Axis| {
                    let kind = if axis.variable == Variable::Rotation { "R" } else { "P" };
                    json!({ "type": kind, "direction": axis.direction, "point": axis.point })
                };
                json!({
                    "kind": "chain", "axes": axes.iter().map(axis).collect::<Vec<_>>(), "spherical": spherical,
                    "home": matrix(home), "pose": matrix(pose),
                })
            }
            Self::Platform { base, plate, legs } => {
                json!({ "kind": "platform", "base": base, "plate": plate, "legs": legs })
            }
        }
    }
}

impl Problem {
    fn read(value: &Value, line: usize) -> Result<Self> {
        let body = Body::read(value, line)?;
        let one = |own: &Value| {
            let q = numbers(line, &own["q"], "q")?;
            let multiplicity = own["multiplicity"].as_u64().and_then(|m| usize::try_from(m).ok());
            let multiplicity = multiplicity.filter(|m| *m > 0 && q.len() == body.unknowns());
            let multiplicity = multiplicity.ok_or_else(|| wrong(line, "a true solution", "one of the problem"))?;
            // JSON has no infinity; null stands for it.
            let condition = own["condition"].as_f64().unwrap_or(f64::INFINITY);
            Ok(Truth { q, multiplicity, condition })
        };
        let truth = value["solutions"].as_array().into_iter().flatten().map(one).collect::<Result<_>>()?;
        let complex = value["complex"].as_u64().and_then(|n| usize::try_from(n).ok());
        let complex = complex.ok_or_else(|| wrong(line, "`complex`", "a whole number"))?;
        let (id, class) = (word(line, &value["id"], "id")?, word(line, &value["class"], "class")?);
        let self_motion = match &value["self_motion"] {
            Value::Null => Some(0),
            other => other.as_u64().and_then(|dimension| usize::try_from(dimension).ok()),
        };
        let self_motion = self_motion.ok_or_else(|| wrong(line, "`self_motion`", "a whole number"))?;
        Ok(Self { id, class, body, truth, complex, self_motion })
    }

    /// Returns a line of a file of problems.
    #[must_use]
    pub fn json(&self) -> Value {
        let truth = |own: &Truth| {
            let condition = own.condition.is_finite().then_some(own.condition);
            json!({ "q": own.q, "multiplicity": own.multiplicity, "condition": condition })
        };
        let mut value = json!({ "id": self.id, "class": self.class });
        if let (Value::Object(own), Value::Object(body)) = (&mut value, self.body.json()) {
            own.extend(body);
            own.insert("complex".to_owned(), json!(self.complex));
            own.insert("solutions".to_owned(), self.truth.iter().map(truth).collect());
            if self.self_motion > 0 {
                own.insert("self_motion".to_owned(), json!(self.self_motion));
            }
        }
        value
    }
}
