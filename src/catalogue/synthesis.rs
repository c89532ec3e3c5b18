//! Synthesis: positions of a body, or pairs of angles, that a linkage has to reach.

use super::entry::Expected;
use super::heading::{Heading, heading};
use super::node::{Node, Value};
use super::scope::{Scope, Table};
use crate::algebra::number::{Angle, Quantity};
use crate::algebra::ring::exact_cos_sin;
use crate::error::{Error, Result};
use crate::kinematics::motion::Motion;
use crate::kinematics::placement::rotation_of;
use rug::Rational;

/// Maximum number of points of a path: a four-bar has nine numbers.
const MOST_POINTS: usize = 9;
/// Maximum number of positions, more than any dyad can reach.
const MOST_POSITIONS: usize = 20;
/// Number of correct digits of a claimed solution that gives none.
const DIGITS: u32 = 6;
/// The keys of a claimed dyad.
const CLAIMED: [&str; 15] = [
    "fixed",
    "moving",
    "length",
    "angle",
    "distance",
    "crank",
    "rocker",
    "coupler",
    "crank_angle0",
    "rocker_angle0",
    "A",
    "B",
    "C",
    "D",
    "third_pivot",
];

/// The space in which a linkage is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// The plane.
    Plane,
    /// The sphere: axes through one point.
    Sphere,
    /// Space.
    Space,
}

impl Space {
    /// Returns the word used in files.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Plane => "plane",
            Self::Sphere => "sphere",
            Self::Space => "space",
        }
    }
}

/// Two joints that hold the moving body, the one at the ground first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DyadKind {
    /// Two revolute joints: a point stays on a circle, on the sphere an axis on a cone, in space two skew axes.
    RR,
    /// A slide at the ground: a point of the body stays on a line.
    PR,
    /// A slide at the body: a line of the body stays on a point.
    RP,
    /// Two cylindrical joints.
    CC,
    /// Two spherical joints: a point stays on a sphere.
    SS,
    /// A planar pair at the ground: a point stays on a plane.
    PPS,
}

impl DyadKind {
    /// Returns the word used in files.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::RR => "RR",
            Self::PR => "PR",
            Self::RP => "RP",
            Self::CC => "CC",
            Self::SS => "SS",
            Self::PPS => "PPS",
        }
    }
}

/// The task of the linkage.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// The body has to take these positions, each a motion from the body to the ground. In the plane they are rotations about
    /// z and translations along x and y, on the sphere rotations.
    Motion(DyadKind, Vec<Motion<Rational>>),
    /// Crank and rocker of a planar four-bar have to take these pairs of angles.
    Function(Vec<AnglePair>),
    /// The coupler curve of a planar four-bar has to run through these points, which are different.
    Path(Vec<[Rational; 2]>),
}

/// A pair of angles of crank and rocker.
#[derive(Clone, Debug, PartialEq)]
pub struct AnglePair {
    /// The angle of the crank and that of the rocker, each as cosine and sine.
    pub angles: [(Rational, Rational); 2],
    /// The rate of the rocker for unit rate of the crank there, if given.
    pub ratio: Option<Rational>,
}

/// A dyad or a linkage that the file claims to be a solution.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimedDyad {
    /// Line of the claim, from 1.
    pub line: usize,
    /// Its numbers, under the names of the output: `fixed`, `fixed.direction`, and so on.
    pub values: Vec<(String, Vec<f64>)>,
    /// Correct digits after the point.
    pub digits: u32,
}

/// A synthesis file as read.
#[derive(Clone, Debug)]
pub struct SynthesisFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// Plane, sphere or space.
    pub space: Space,
    /// The task of the linkage.
    pub task: Task,
    /// Whether every number of the file is exact.
    pub exact: bool,
    /// Claimed numbers of solutions.
    pub expected: Expected,
    /// Claimed solutions.
    pub claims: Vec<ClaimedDyad>,
    /// Line of the claims, from 1.
    pub line: usize,
}

/// Reads a synthesis file.
pub(super) fn synthesis(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<SynthesisFile> {
    let heading = heading_of(scope, root, name)?;
    let keys = ["title", "source", "notes", "units", "mechanism", "position", "pair", "point", "expected", "solution"];
    let table = scope.table(root, "the file", &keys)?;
    let node = scope.need(&table, "mechanism")?;
    let mechanism = scope.table(node, "the [mechanism] of a synthesis", &["kind", "space", "task", "dyad"])?;
    let space = match scope.word(scope.need(&mechanism, "space")?, "space", &["plane", "sphere", "space"])? {
        "plane" => Space::Plane,
        "sphere" => Space::Sphere,
        _ => Space::Space,
    };
    let task_node = scope.need(&mechanism, "task")?;
    let task = match scope.word(task_node, "task", &["motion", "function", "path"])? {
        "motion" => motion(scope, &table, &mechanism, space)?,
        "function" => function(scope, &table, &mechanism, (space, task_node.line))?,
        _ => path(scope, &table, &mechanism, (space, task_node.line))?,
    };
    let exact = !scope.is_rounded();
    let (mut expected, mut line) = (Expected::default(), node.line);
    if let Some(node) = table.get("expected") {
        let claims = scope.table(node, "the [expected] of a synthesis", &["complex", "real", "dimension"])?;
        let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
        (expected.complex, expected.real, expected.dimension) =
            (count("complex")?, count("real")?, count("dimension")?);
        line = node.line;
    }
    let claims = match table.get("solution") {
        Some(node) => scope.list(node, "solution")?.iter().map(|item| claim(scope, item)).collect::<Result<_>>()?,
        None => Vec::new(),
    };
    Ok(SynthesisFile { heading, space, task, exact, expected, claims, line })
}

/// Reads the head, which knows fewer keys than this file has.
fn heading_of(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Heading> {
    let Value::Table(fields) = &root.value else { return heading(scope, root, name) };
    let own = ["title", "source", "notes", "units"];
    let fields = fields.iter().filter(|field| own.contains(&field.key.as_str())).cloned().collect();
    heading(scope, &Node { value: Value::Table(fields), ..root.clone() }, name)
}

/// Refuses lists in the file that its task does not take.
fn only(scope: &Scope<'_>, table: &Table<'_>, wanted: &str, task: &str) -> Result<()> {
    for key in ["position", "pair", "point"] {
        if let (true, Some(node)) = (key != wanted, table.get(key)) {
            let message = format!("found [[{key}]] in a synthesis of the task {task}, expected [[{wanted}]]");
            return Err(scope.fail(node.line, message));
        }
    }
    Ok(())
}

/// Returns the items of `[[position]]`, `[[pair]]` or `[[point]]`, at least two and at most this many.
fn items<'n>(scope: &Scope<'_>, table: &Table<'n>, key: &str, most: usize) -> Result<&'n [Node]> {
    let node = scope.need(table, key)?;
    let items = scope.list(node, key)?;
    if !(2..=most).contains(&items.len()) {
        let message = format!("found {} of [[{key}]], expected 2 to {most}", items.len());
        return Err(scope.fail(node.line, message));
    }
    Ok(items)
}

fn motion(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>, space: Space) -> Result<Task> {
    only(scope, table, "position", "motion")?;
    let words: &[&str] = match space {
        Space::Plane => &["RR", "PR", "RP"],
        Space::Sphere => &["RR"],
        Space::Space => &["RR", "CC", "SS", "PPS"],
    };
    let node = scope.need(mechanism, "dyad")?;
    let dyad = match scope.word(node, "dyad", words)? {
        "RR" => DyadKind::RR,
        "PR" => DyadKind::PR,
        "RP" => DyadKind::RP,
        "CC" => DyadKind::CC,
        "SS" => DyadKind::SS,
        _ => DyadKind::PPS,
    };
    let positions = items(scope, table, "position", MOST_POSITIONS)?.iter().map(|item| match space {
        Space::Plane => in_plane(scope, item),
        Space::Sphere => on_sphere(scope, item),
        Space::Space => in_space(scope, item),
    });
    Ok(Task::Motion(dyad, positions.collect::<Result<_>>()?))
}

fn function(
    scope: &Scope<'_>,
    table: &Table<'_>,
    mechanism: &Table<'_>,
    (space, line): (Space, usize),
) -> Result<Task> {
    only(scope, table, "pair", "function")?;
    if space != Space::Plane {
        let message =
            format!("found the task function in the space {}, which is solved in the plane only", space.word());
        return Err(Error::Unsupported(message).at(scope.path, line));
    }
    if let Some(node) = mechanism.get("dyad") {
        let message =
            "found `dyad` beside the task function, expected none: its linkage is a four-bar of four R joints";
        return Err(scope.fail(node.line, message));
    }
    let pair = |item: &Node| {
        let table = scope.table(item, "a [[pair]]", &["input", "output", "ratio"])?;
        let angle = |key: &str| Ok::<_, Error>(exact_cos_sin(&angle_of(scope, scope.need(&table, key)?, key)?));
        let ratio = table.get("ratio").map(|node| scope.number(node, Quantity::Ratio, "ratio")).transpose()?;
        let ratio = ratio.map(|ratio| ratio.rational().clone());
        Ok(AnglePair { angles: [angle("input")?, angle("output")?], ratio })
    };
    Ok(Task::Function(items(scope, table, "pair", MOST_POSITIONS)?.iter().map(pair).collect::<Result<_>>()?))
}

fn path(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>, (space, line): (Space, usize)) -> Result<Task> {
    only(scope, table, "point", "path")?;
    if space != Space::Plane {
        let message = format!("found the task path in the space {}, which is solved in the plane only", space.word());
        return Err(Error::Unsupported(message).at(scope.path, line));
    }
    if let Some(node) = mechanism.get("dyad") {
        let message = "found `dyad` beside the task path, expected none: its linkage is a four-bar of four R joints";
        return Err(scope.fail(node.line, message));
    }
    let mut points: Vec<[Rational; 2]> = Vec::new();
    for item in items(scope, table, "point", MOST_POINTS)? {
        let own = scope.table(item, "a [[point]]", &["at"])?;
        let mut point = [Rational::new(), Rational::new()];
        for (part, node) in point.iter_mut().zip(scope.exactly::<2>(scope.need(&own, "at")?, "at")?) {
            part.clone_from(scope.length(node, "at")?.rational());
        }
        if let Some(k) = points.iter().position(|other| *other == point) {
            let message =
                format!("found points {} and {} at the same place, expected different points", k + 1, points.len() + 1);
            return Err(scope.fail(item.line, message));
        }
        points.push(point);
    }
    Ok(Task::Path(points))
}

/// Reads an angle: a value, or a table with `angle` or `tan_half`.
fn angle_of(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Angle> {
    if !matches!(node.value, Value::Table(_)) {
        return scope.angle(node, what);
    }
    let table = scope.table(node, what, &["angle", "tan_half"])?;
    match (table.get("angle"), table.get("tan_half")) {
        (Some(node), None) => scope.angle(node, "angle"),
        (None, Some(node)) => scope.half_tangent(node, "tan_half"),
        (found, _) => Err(one_of(scope, node.line, found.is_some(), "`angle` and `tan_half`", what)),
    }
}

fn one_of(scope: &Scope<'_>, line: usize, both: bool, names: &str, what: &str) -> Error {
    let found = if both { "both" } else { "neither" };
    scope.fail(line, format!("found {found} of {names} in {what}, expected one of them"))
}

fn in_plane(scope: &Scope<'_>, item: &Node) -> Result<Motion<Rational>> {
    let table = scope.table(item, "a [[position]] in the plane", &["angle", "tan_half", "position"])?;
    let angle = match (table.get("angle"), table.get("tan_half")) {
        (Some(node), None) => scope.angle(node, "angle")?,
        (None, Some(node)) => scope.half_tangent(node, "tan_half")?,
        (found, _) => {
            return Err(one_of(scope, item.line, found.is_some(), "`angle` and `tan_half`", "a [[position]]"));
        }
    };
    let (cos, sin) = exact_cos_sin(&angle);
    let mut motion = Motion::rotation_z(cos, sin);
    let node = scope.need(&table, "position")?;
    for (part, node) in motion.translation.iter_mut().zip(scope.exactly::<2>(node, "position")?) {
        part.clone_from(scope.length(node, "position")?.rational());
    }
    Ok(motion)
}

fn on_sphere(scope: &Scope<'_>, item: &Node) -> Result<Motion<Rational>> {
    let table = scope.table(item, "a [[position]] on the sphere", &["quaternion"])?;
    quaternion(scope, scope.need(&table, "quaternion")?)
}

fn in_space(scope: &Scope<'_>, item: &Node) -> Result<Motion<Rational>> {
    let table = scope.table(item, "a [[position]] in space", &["matrix", "quaternion", "position"])?;
    if let Some(node) = table.get("matrix") {
        if let Some(other) = table.get("quaternion").or_else(|| table.get("position")) {
            return Err(
                scope.fail(other.line, "found `matrix` beside `quaternion` or `position`, expected one of them")
            );
        }
        return Ok(scope.matrix(node, "matrix")?.exact.motion());
    }
    let mut motion = quaternion(scope, scope.need(&table, "quaternion")?)?;
    let position = scope.vector(scope.need(&table, "position")?, Quantity::Length, "position")?;
    for (part, number) in motion.translation.iter_mut().zip(&position) {
        part.clone_from(number.rational());
    }
    Ok(motion)
}

/// Reads the rotation of a quaternion of any length.
fn quaternion(scope: &Scope<'_>, node: &Node) -> Result<Motion<Rational>> {
    let mut parts: [Rational; 4] = std::array::from_fn(|_| Rational::new());
    for (part, item) in parts.iter_mut().zip(scope.exactly::<4>(node, "quaternion")?) {
        part.clone_from(scope.number(item, Quantity::Ratio, "quaternion")?.rational());
    }
    if parts.iter().all(|part| *part == 0) {
        return Err(scope.fail(node.line, "found a quaternion of four zeros, expected a rotation"));
    }
    let [w, x, y, z] = &parts;
    let translation = std::array::from_fn(|_| Rational::new());
    Ok(Motion { rotation: rotation_of([w, x, y, z]), translation })
}

/// Reads a claimed dyad: its numbers by their names.
fn claim(scope: &Scope<'_>, item: &Node) -> Result<ClaimedDyad> {
    let keys = [&CLAIMED[..], &["digits"]].concat();
    let table = scope.table(item, "a [[solution]] of a synthesis", &keys)?;
    let digits = table.get("digits").map(|node| scope.count(node, "digits")).transpose()?;
    let mut values = Vec::new();
    for key in CLAIMED {
        let Some(node) = table.get(key) else { continue };
        match &node.value {
            Value::Table(fields) => {
                for field in fields {
                    let name = format!("{key}.{}", field.key);
                    values.push((name.clone(), numbers(scope, &field.node, &name)?));
                }
            }
            _ => values.push((key.to_owned(), numbers(scope, node, key)?)),
        }
    }
    if values.is_empty() {
        let message = format!("found a [[solution]] without numbers, expected one of {}", CLAIMED.join(", "));
        return Err(scope.fail(item.line, message));
    }
    let digits = digits.map_or(DIGITS, |digits| u32::try_from(digits).unwrap_or(DIGITS));
    Ok(ClaimedDyad { line: item.line, values, digits })
}

fn numbers(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Vec<f64>> {
    let one = |node: &Node| Ok(scope.number(node, Quantity::Ratio, what)?.to_f64());
    match &node.value {
        Value::List(items) => items.iter().map(one).collect(),
        _ => Ok(vec![one(node)?]),
    }
}
