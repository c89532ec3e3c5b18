//! The `[mechanism]` table: joints, base, tool and limits.

use super::entry::{Case, Design, Kind, Labels};
use super::node::{Node, Value};
use super::options::Chains;
use super::platform;
use super::scope::{Scope, Table};
use crate::algebra::number::{Angle, Number, Quantity};
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::joint::{DhConstant, Variable};
use crate::kinematics::platform_limits::PlatformLimits;
use rug::Rational;

/// The mechanism of a file.
pub(super) struct Mechanism {
    pub(super) design: Design,
    pub(super) limits: Vec<[f64; 2]>,
    pub(super) platform_limits: PlatformLimits,
    /// The legs of a platform, if given beside its points.
    pub(super) case: Option<Case>,
    /// The names of its joints in the file.
    pub(super) labels: Labels,
}

/// Reads the `[mechanism]` table.
pub(super) fn mechanism(scope: &Scope<'_>, node: &Node) -> Result<Mechanism> {
    let anything = [&["convention", "joints", "bonds", "tool", "home"], &platform::KEYS[..]].concat();
    let table = scope.table(node, "[mechanism]", &anything)?;
    let kind = match scope.word(scope.need(&table, "kind")?, "kind", &["arm", "loop", "platform"])? {
        "arm" => Kind::Arm,
        "loop" => Kind::Loop,
        _ => {
            let (platform, platform_limits, case) = platform::platform(scope, node)?;
            let (design, labels) = (Design::Platform(Box::new(platform)), Labels::default());
            return Ok(Mechanism { design, limits: Vec::new(), platform_limits, case, labels });
        }
    };
    let table = match kind {
        Kind::Arm => scope.table(
            node,
            "the [mechanism] of an arm",
            &["kind", "convention", "joints", "base", "tool", "home", "limits"],
        )?,
        _ => scope.table(
            node,
            "the [mechanism] of a loop",
            &["kind", "convention", "joints", "bonds", "home", "limits"],
        )?,
    };
    let convention = table.get("convention").ok_or_else(|| {
        let expected = match kind {
            Kind::Arm => "expected one of dh, modified-dh, screws (there is no default)",
            _ => "expected one of dh, modified-dh, screws, bonds (there is no default)",
        };
        scope.fail(table.line(), format!("found no `convention` in the [mechanism], {expected}"))
    })?;
    let known = ["dh", "modified-dh", "screws", "bonds"];
    let convention = scope.word(convention, "convention", &known[..if kind == Kind::Arm { 3 } else { 4 }])?;
    let (key, other) = if convention == "bonds" { ("bonds", "joints") } else { ("joints", "bonds") };
    if let Some(other) = table.get(other) {
        let message = format!(
            "found `{}` with convention \"{convention}\", expected `{key}`",
            if key == "joints" { "bonds" } else { "joints" }
        );
        return Err(scope.fail(other.line, message));
    }
    let joints = scope.need(&table, key)?;
    let nodes = scope.list(joints, key)?;
    if nodes.len() > 64 {
        return Err(scope.fail(joints.line, format!("found {} joints, expected at most 64", nodes.len())));
    }
    let geometry = if convention == "screws" {
        screws(scope, &table, kind, nodes)?
    } else {
        if let Some(home) = table.get("home") {
            return Err(
                scope.fail(home.line, "found `home` beside DH joints, expected it only with convention \"screws\"")
            );
        }
        let read = if convention == "bonds" { bond } else { joint };
        let joints = nodes.iter().map(|node| read(scope, node)).collect::<Result<_>>()?;
        if convention == "modified-dh" { Geometry::ModifiedDh(joints) } else { Geometry::Dh(joints) }
    };
    let placed = |key: &str| table.get(key).map_or(Ok(Placement::identity()), |node| scope.matrix(node, key));
    let chain = Chain { geometry, base: placed("base")?, tool: placed("tool")? };
    let expected = match kind {
        Kind::Arm => (6, "expected 1 to 24 for an arm"),
        _ => (7, "expected at most 7 for a loop: one given as input, six to find"),
    };
    check_count(scope, &chain, joints.line, expected)?;
    let limits = table.get("limits").map_or(Ok(Vec::new()), |node| limits(scope, node, &chain))?;
    let design = if kind == Kind::Arm { Design::Arm(chain) } else { Design::Loop(chain) };
    let joints =
        if nodes.iter().any(|node| label(node).is_some()) { nodes.iter().map(label).collect() } else { vec![] };
    Ok(Mechanism {
        design,
        limits,
        platform_limits: PlatformLimits::default(),
        case: None,
        labels: Labels { joints, ..Labels::default() },
    })
}

/// Returns the name of a joint, if it has one.
fn label(node: &Node) -> Option<String> {
    let Value::Table(fields) = &node.value else { return None };
    let name = fields.iter().find(|field| field.key == "name")?;
    if let Value::Text(name) = &name.node.value { Some(name.clone()) } else { None }
}

/// Maximum number of joint variables of an arm: all but six or seven are locked before it is solved.
const MOST_OF_ARM: usize = 24;

/// Refuses a chain whose number of joint variables does not fit its kind.
pub(super) fn check_count(scope: &Scope<'_>, chain: &Chain, line: usize, expected: (usize, &str)) -> Result<()> {
    check_kinds(scope, &chain.joint_kinds(), || Freedom::of(chain), line, expected)
}

/// Applies the same check to joint kinds alone.
pub(super) fn check_kinds(
    scope: &Scope<'_>,
    kinds: &[JointKind],
    freedom: impl Fn() -> Freedom,
    line: usize,
    expected: (usize, &str),
) -> Result<()> {
    let count: usize = kinds.iter().map(|kind| kind.freedoms()).sum();
    let spherical_joints = kinds.iter().filter(|kind| **kind == JointKind::Spherical).count();
    // The spin of a link between two spherical joints is an idle degree of freedom.
    let is_overconstrained_loop = expected.0 == 7 && (2..7).contains(&count);
    let is_arm = expected.0 == 6 && (1..=MOST_OF_ARM).contains(&count);
    let is_any = is_arm || scope.chains == Chains::Any && (count > expected.0 || expected.0 == 6 && count > 0);
    if is_any
        || count == expected.0
        || is_overconstrained_loop
        || (expected.0 == 7 && count == 8 && spherical_joints == 2)
    {
        return Ok(());
    }
    let joints = kinds.len();
    let off = count.abs_diff(expected.0);
    let freedoms = if off == 1 { "one freedom".to_owned() } else { format!("{off} freedoms") };
    let what = match (expected.0, count > expected.0) {
        (7, true) => {
            // Two spherical joints have an idle spin, so eight variables are right then.
            let off = off - usize::from(spherical_joints == 2);
            let freedoms = if off == 1 { "one freedom".to_owned() } else { format!("{off} freedoms") };
            let constants = if off == 1 { "one variable" } else { "as many variables" };
            format!("{}: {freedoms} too many for one input; make {constants} constant", freedom())
        }
        (7, false) => {
            format!("{}: no loop of them can close in more than one way; a loop has two joints at least", freedom())
        }
        (_, true) => format!("a pose leaves {freedoms} undetermined"),
        (_, false) => "no joint moves it".to_owned(),
    };
    Err(scope
        .fail(line, format!("found {joints} joints with {count} variables ({}), {}; {what}", counts(), expected.1)))
}

/// How many variables each type of joint counts.
fn counts() -> String {
    let most = JointKind::ALL.into_iter().map(JointKind::freedoms).max().unwrap_or(0);
    let one = |n: usize| {
        let count = if n == 1 { "count " } else { "" };
        format!("{} {count}{n}", JointKind::letters(|kind| kind.freedoms() == n, "and"))
    };
    (1..=most).map(one).collect::<Vec<_>>().join(", ")
}

/// Reads the kind of a joint, one of these.
pub(super) fn joint_kind(scope: &Scope<'_>, node: &Node, known: &[JointKind]) -> Result<JointKind> {
    let letters: Vec<&str> = known.iter().map(|kind| kind.letter()).collect();
    let letter = scope.word(node, "type", &letters)?;
    let kind = known.iter().copied().find(|kind| kind.letter() == letter);
    kind.ok_or_else(|| scope.fail(node.line, format!("found the joint type {letter}, expected another one")))
}

/// Reads the kind of a joint, on which its other keys depend.
fn kind_of(scope: &Scope<'_>, node: &Node, known: &[&str]) -> Result<JointKind> {
    let table = scope.table(node, "a joint", known)?;
    joint_kind(scope, scope.need(&table, "type")?, &JointKind::ALL)
}

const DH_KEYS: [&str; 12] = [
    "type",
    "a",
    "alpha",
    "tan_half_alpha",
    "d",
    "theta0",
    "tan_half_theta0",
    "d0",
    "theta",
    "tan_half_theta",
    "pitch",
    "name",
];

/// Reads a joint of a DH list.
fn joint(scope: &Scope<'_>, node: &Node) -> Result<Joint> {
    let kind = kind_of(scope, node, &DH_KEYS)?;
    let link = ["type", "name", "a", "alpha", "tan_half_alpha"];
    let (key_of_d, keys_of_theta) = (kind.row().d.key_of_d(), kind.row().theta.keys_of_theta());
    let own = key_of_d.into_iter().chain(keys_of_theta.into_iter().flatten()).chain(key_of_pitch(kind));
    let table = scope.table(node, kind.row().called, &link.into_iter().chain(own).collect::<Vec<_>>())?;
    let a = scope.length(scope.need(&table, "a")?, "a")?;
    let alpha = angle(scope, &table, "alpha", "tan_half_alpha", true)?;
    let d = match key_of_d {
        Some(key) if kind.row().d == DhConstant::Stated => scope.length(scope.need(&table, key)?, key)?,
        Some(key) => table.get(key).map_or(Ok(Number::zero()), |node| scope.length(node, key))?,
        None => Number::zero(),
    };
    let theta0 = match keys_of_theta {
        Some([key, half]) => angle(scope, &table, key, half, kind.row().theta == DhConstant::Stated)?,
        None => Angle::zero(),
    };
    Ok(Joint { kind, a, alpha, d, theta0, pitch: pitch(scope, &table, kind)? })
}

/// Reads a bond of a ring: an R joint about itself. Neighbouring bonds meet at an atom, so that their axes have no distance; the twist is
/// the supplement of the angle between them at the atom, and the joint's angle is the torsion of the bond.
fn bond(scope: &Scope<'_>, node: &Node) -> Result<Joint> {
    let table = scope.table(node, "a bond", &["length", "angle", "tan_half_angle", "name"])?;
    let length_node = scope.need(&table, "length")?;
    let d = scope.length(length_node, "length")?;
    if !(d.to_f64() > 0.0) {
        return Err(scope.fail(length_node.line, "found a bond whose length is not positive, expected one above 0"));
    }
    let at_atom = angle(scope, &table, "angle", "tan_half_angle", true)?;
    let (_, sine) = at_atom.cos_sin_f64();
    if !(sine >= 0.0 && at_atom.radians().abs() <= 3.2) {
        return Err(scope.fail(
            node.line,
            format!(
                "found the angle {:.1} deg between two bonds, expected one from 0 to 180 deg",
                at_atom.radians().to_degrees()
            ),
        ));
    }
    let (a, alpha, theta0) = (Number::zero(), at_atom.supplement(), Angle::zero());
    Ok(Joint { kind: JointKind::Revolute, a, alpha, d, theta0, pitch: None })
}

fn key_of_pitch(kind: JointKind) -> Option<&'static str> {
    kind.row().has_pitch.then_some("pitch")
}

fn pitch(scope: &Scope<'_>, table: &Table<'_>, kind: JointKind) -> Result<Option<Number>> {
    key_of_pitch(kind).map(|key| scope.length(scope.need(table, key)?, key)).transpose()
}

/// Reads an angle given directly or by its half-angle tangent, but not both.
fn angle(scope: &Scope<'_>, table: &Table<'_>, key: &str, half: &str, obligatory: bool) -> Result<Angle> {
    match (table.get(key), table.get(half)) {
        (Some(_), Some(node)) => {
            Err(scope.fail(node.line, format!("found both `{key}` and `{half}`, expected one of them")))
        }
        (Some(node), None) => scope.angle(node, key),
        (None, Some(node)) => scope.half_tangent(node, half),
        (None, None) if obligatory => {
            Err(scope
                .fail(table.line(), format!("found neither `{key}` nor `{half}` in a joint, expected one of them")))
        }
        (None, None) => Ok(Angle::zero()),
    }
}

fn screws(scope: &Scope<'_>, table: &Table<'_>, kind: Kind, nodes: &[Node]) -> Result<Geometry> {
    let joints = nodes.iter().map(|node| screw_joint(scope, node)).collect::<Result<_>>()?;
    let home = match (table.get("home"), kind) {
        (Some(node), _) => scope.matrix(node, "home")?,
        (None, Kind::Loop) => Placement::identity(),
        (None, _) => scope.matrix(scope.need(table, "home")?, "home")?,
    };
    Ok(Geometry::Screws { joints, home: Box::new(home) })
}

/// Reads a joint of a list of screw axes.
fn screw_joint(scope: &Scope<'_>, node: &Node) -> Result<ScrewJoint> {
    let kind = kind_of(scope, node, &["type", "name", "axis", "point", "pitch"])?;
    if let Some(instead) = kind.row().among_screws {
        return Err(scope.fail(node.line, format!("found {} among screw axes, expected {instead}", kind.row().called)));
    }
    let allowed: Vec<&str> = ["type", "name", "axis", "point"].into_iter().chain(key_of_pitch(kind)).collect();
    let table = scope.table(node, "a screw joint", &allowed)?;
    let axis_node = scope.need(&table, "axis")?;
    let axis = scope.vector(axis_node, Quantity::Ratio, "axis")?;
    if axis.iter().all(|component| component.rational().is_zero()) {
        return Err(scope.fail(axis_node.line, "found the axis [0, 0, 0], expected a direction"));
    }
    // A direction of irrational length has no rational unit vector and is replaced by a nearby one.
    let square: Rational = axis.iter().map(|component| Rational::from(component.rational().square_ref())).sum();
    scope.note(square.numer().is_perfect_square() && square.denom().is_perfect_square());
    let point = if table.get("point").is_none() && kind.only_translates() {
        std::array::from_fn(|_| Number::zero())
    } else {
        scope.vector(scope.need(&table, "point")?, Quantity::Length, "point")?
    };
    Ok(ScrewJoint { kind, axis, point, pitch: pitch(scope, &table, kind)? })
}

fn limits(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Vec<[f64; 2]>> {
    let variables = chain.variables();
    let nodes = scope.list(node, "limits")?;
    if nodes.len() != variables.len() {
        let (found, expected) = (nodes.len(), variables.len());
        return Err(scope
            .fail(node.line, format!("found {found} pairs of limits, expected {expected}, one per joint variable")));
    }
    let mut limits = Vec::with_capacity(nodes.len());
    // Limits are compared in f64: they do not make the mechanism a rounded one.
    let own = Scope::new(scope.path, scope.reading.clone());
    for (pair, variable) in nodes.iter().zip(variables) {
        let [low, high] = scope.exactly::<2>(pair, "limits")?;
        let read = |node| variable_value(&own, node, variable.variable, "limits");
        let (low, high) = (read(low)?, read(high)?);
        if low > high {
            return Err(
                scope.fail(pair.line, format!("found the limits [{low}, {high}], expected the lower one first"))
            );
        }
        limits.push([low, high]);
    }
    Ok(limits)
}

/// Reads the value of a joint variable, radians or metres.
pub(super) fn variable_value(scope: &Scope<'_>, node: &Node, variable: Variable, what: &str) -> Result<f64> {
    Ok(match variable {
        Variable::Rotation => scope.radians(node, what)?,
        Variable::Translation => scope.length(node, what)?.to_f64(),
    })
}
