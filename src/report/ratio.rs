//! The velocity ratio of a joint to the input along the branches of a sweep.

use super::axodes::{given_of_plane, given_of_space, given_of_sphere, input_of_loop, rows};
use super::json::number;
use super::number::short;
use super::table::Columns;
use crate::algebra::ring::Ring;
use crate::catalogue::entry::Entry;
use crate::catalogue::{LinkageFile, SpaceFile, SphereFile};
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::linkage::answer::LinkageMode;
use crate::linkage::instant::derivatives;
use crate::linkage::rates::{Moving, freedoms, joint_value, moving, resting};
use crate::linkage::space::{SpaceMode, rates as rates_in_space};
use crate::linkage::sphere::{SphereMode, rates};
use crate::mechanism::InputCurve;
use crate::sweep::{AssemblyBranch, AssemblyRow, AssemblySweep, LinkageSweep, SpaceSweep, SphereSweep, Sweep};
use serde_json::{Value, json};

/// Ratios that differ by less than this share are one.
const CONSTANT: f64 = 1e-9;

/// A row of a branch.
#[derive(Clone, Copy, Debug)]
struct Row {
    input: f64,
    /// The ratio and its derivative by the input; `None` where the input does not determine rates.
    ratio: Option<[f64; 2]>,
}

/// The ratios of a joint.
#[derive(Clone, Debug)]
pub struct Ratio {
    name: String,
    branches: Vec<Vec<Row>>,
    /// The length of a step of the input.
    step: f64,
}

/// What is said of a branch: a ratio and the input there.
struct Found {
    least: [f64; 2],
    greatest: [f64; 2],
    stationary: Vec<[f64; 2]>,
}

impl Ratio {
    /// Returns the ratios of a joint of a linkage in the plane.
    #[must_use]
    pub fn of_plane(file: &LinkageFile, sweep: &LinkageSweep, joint: usize) -> Self {
        let (given, driven) = given_of_plane(file, sweep.joint);
        let ratio = |mode: &LinkageMode| {
            let mut runs = vec![Moving::zero(); freedoms(&given)];
            runs[driven].coefficients[1] = 1.0;
            let bodies = moving(&file.linkage, &given, &resting(mode), &runs)?;
            Some(derivatives(&joint_value(&file.linkage, &bodies, joint)?))
        };
        Self::of_assemblies(file.linkage.joints[joint].name.clone(), sweep, ratio)
    }

    /// Returns the ratios of a joint of a linkage on the sphere.
    #[must_use]
    pub fn of_sphere(file: &SphereFile, sweep: &SphereSweep, joint: usize) -> Self {
        let given = given_of_sphere(file, sweep.joint);
        let ratio = |mode: &SphereMode| Some(rates(&file.linkage, &given, mode)?.joints[joint]);
        Self::of_assemblies(file.linkage.joints[joint].name.clone(), sweep, ratio)
    }

    /// Returns the ratios of a joint of a linkage in space that has a value.
    #[must_use]
    pub fn of_space(file: &SpaceFile, sweep: &SpaceSweep, joint: usize) -> Self {
        let given = given_of_space(file, sweep.joint);
        let ratio = |mode: &SpaceMode| *rates_in_space(&file.linkage, &given, mode)?.joints.get(joint)?;
        Self::of_assemblies(file.linkage.joints[joint].name.clone(), sweep, ratio)
    }

    /// Returns the ratios at all assemblies of the branches of a sweep.
    fn of_assemblies<M>(name: String, sweep: &AssemblySweep<M>, ratio: impl Fn(&M) -> Option<[f64; 2]>) -> Self {
        let branch = |branch: &AssemblyBranch| {
            let row = |row: &AssemblyRow| {
                let sample = &sweep.samples[row.step];
                Row { input: sample.input, ratio: ratio(&sample.modes[row.mode]) }
            };
            branch.rows.iter().map(row).collect()
        };
        let step = (sweep.range.to - sweep.range.from) / sweep.range.steps as f64;
        Self { name, branches: sweep.branches.iter().map(branch).collect(), step }
    }

    /// Returns the ratios of a joint variable of a loop, by its place among them.
    ///
    /// # Errors
    /// As [`InputCurve::of`].
    pub fn of_loop(
        entry: &Entry,
        input: (usize, Variable),
        sweep: &Sweep,
        (index, name): (usize, &str),
    ) -> Result<Self> {
        let curve = InputCurve::of(entry, &input_of_loop(input))?;
        let ratio = |q: &[f64]| {
            let found = (q.len() == curve.variables().len()).then(|| curve.derivatives_at(&curve.point(q)))??;
            Some([*found.velocity.get(index)?, *found.acceleration.get(index)?])
        };
        let branch = |branch: &crate::sweep::Branch| {
            let row = |row: &crate::sweep::Row| {
                let sample = &sweep.samples[row.step];
                Row { input: sample.input, ratio: ratio(&sample.modes[row.mode]) }
            };
            branch.rows.iter().map(row).collect()
        };
        let step = (sweep.range.to - sweep.range.from) / sweep.range.steps as f64;
        let branches = sweep.branches.iter().map(branch).collect();
        Ok(Self { name: name.to_owned(), branches, step })
    }

    /// Least and greatest ratio of a branch, and where it is stationary between two rows.
    fn found(&self, branch: &[Row]) -> Option<Found> {
        let known: Vec<[f64; 3]> = branch.iter().filter_map(|row| row.ratio.map(|[r, s]| [row.input, r, s])).collect();
        let mut all: Vec<[f64; 2]> = known.iter().map(|[input, r, _]| [*r, *input]).collect();
        let extreme = |all: &[[f64; 2]]| {
            let least = all.iter().copied().min_by(|a, b| a[0].total_cmp(&b[0]))?;
            Some((least, all.iter().copied().max_by(|a, b| a[0].total_cmp(&b[0]))?))
        };
        let (least, greatest) = extreme(&all)?;
        if is_one([least, greatest]) {
            return Some(Found { least, greatest, stationary: Vec::new() });
        }
        // A row that is stationary itself is taken with the one behind it.
        let is_next = |a: f64, b: f64| (b - a).abs() <= 1.5 * self.step.abs();
        let between = known.windows(2).filter_map(|pair| match pair {
            [a, b] if is_next(a[0], b[0]) && a[2] * b[2] <= 0.0 && b[2] != 0.0 => Some(stationary(a, b)),
            _ => None,
        });
        let stationary: Vec<[f64; 2]> = between.collect();
        all.extend(&stationary);
        let (least, greatest) = extreme(&all)?;
        Some(Found { least, greatest, stationary })
    }

    /// Adds the ratio to every row of a document, and what is said of the branches.
    pub fn insert(&self, document: &mut Value) {
        let values =
            self.branches.iter().flatten().map(|row| row.ratio.map_or(Value::Null, |[ratio, _]| number(ratio)));
        for (row, value) in rows(document).into_iter().zip(values) {
            row["ratio"] = value;
        }
        let branches = self.branches.iter().map(|branch| {
            self.found(branch).map_or(Value::Null, |found| {
                let pair = |pair: &[f64; 2]| json!({ "ratio": number(pair[0]), "input": number(pair[1]) });
                json!({
                    "least": pair(&found.least),
                    "greatest": pair(&found.greatest),
                    "constant": is_one([found.least, found.greatest]),
                    "stationary": found.stationary.iter().map(pair).collect::<Value>(),
                })
            })
        });
        document["ratio"] = json!({ "joint": self.name, "branches": branches.collect::<Vec<_>>() });
    }

    /// Returns the rows of a CSV with one more column.
    #[must_use]
    pub fn csv(&self, text: &str) -> String {
        let name = self.name.replace([',', '"', '\n'], " ");
        let values =
            self.branches.iter().flatten().map(|row| row.ratio.map_or(String::new(), |[ratio, _]| ratio.to_string()));
        let cells = std::iter::once(format!("ratio of {name}")).chain(values);
        text.lines().zip(cells).fold(String::new(), |all, (line, cell)| all + line + "," + &cell + "\n")
    }

    /// Least and greatest ratio of every branch for a reader.
    #[must_use]
    pub fn text(&self, input: &str, is_length: bool) -> String {
        let shown = |x: f64| if is_length { short(x, 6) } else { short(x.to_degrees(), 4) };
        let at = if is_length { "at [m]" } else { "at [deg]" };
        let mut table = Columns::new(&["branch", "least", at, "greatest", at], &[]);
        for (k, branch) in self.branches.iter().enumerate() {
            let Some(found) = self.found(branch) else { continue };
            let [least, greatest] = [found.least, found.greatest];
            let (one, two) = if is_one([least, greatest]) {
                ("constant".to_owned(), "constant".to_owned())
            } else {
                (shown(least[1]), shown(greatest[1]))
            };
            table.row([(k + 1).to_string(), short(least[0], 9), one, short(greatest[0], 9), two]);
        }
        format!(
            "\nratio of {} to {input}, at the inputs of the sweep and where it is stationary between them\n{}",
            self.name,
            table.text()
        )
    }
}

/// Whether two ratios are one, but for rounding.
fn is_one([least, greatest]: [[f64; 2]; 2]) -> bool {
    greatest[0] - least[0] <= CONSTANT * greatest[0].abs().max(least[0].abs())
}

/// The stationary value between two rows (input, ratio, slope), of the cubic with these values and slopes.
fn stationary(&[x, r, s]: &[f64; 3], &[y, q, t]: &[f64; 3]) -> [f64; 2] {
    let h = y - x;
    let (m, n, d) = (s * h, t * h, q - r);
    let (second, third) = (3.0 * d - 2.0 * m - n, m + n - 2.0 * d);
    let slope = |u: f64| m + u * (2.0 * second + 3.0 * third * u);
    let (mut low, mut high) = (0.0, 1.0);
    let rises = slope(high) > 0.0;
    // The slopes at both ends have different signs: halving leaves less than a bit of the step.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (slope(middle) > 0.0) == rises { high = middle } else { low = middle }
    }
    let u = 0.5 * (low + high);
    [r + u * (m + u * (second + u * third)), x + u * h]
}
