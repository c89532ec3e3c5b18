//! Kind `gearing`: gear trains, wheels, and pairs of involute gears.

use super::calculus::{found, parts};
use super::node::{Node, Value};
use super::scope::{Scope, Table};
use crate::algebra::number::{Angle, Quantity};
use crate::error::{Error, Result};
use rug::Rational;

/// Maximum number of teeth accepted.
const MOST_TEETH: usize = 100_000;

/// A question about gears and wheels.
#[derive(Clone, Debug)]
pub enum Gearing {
    /// Shafts whose rates are related linearly.
    Train(Train),
    /// Wheels with rollers on a vehicle in the plane.
    Wheels {
        /// The wheels.
        wheels: Vec<Wheel>,
        /// Velocity of the origin of the vehicle along its axes, and its angular velocity, if given.
        twist: Option<[Rational; 3]>,
    },
    /// A pair of involute gears.
    Pair(Box<Pair>),
    /// A pair of helical gears on skew axes.
    Crossed(Box<Crossed>),
    /// The involute of a circle at a roll angle.
    Involute(Rational, Box<Angle>),
    /// The path of a point of a rolling circle.
    Trochoid(Box<Rolling>),
}

/// A circle that rolls on another one, or in it.
#[derive(Clone, Debug)]
pub struct Rolling {
    /// The radius of the circle at rest.
    pub fixed: Rational,
    /// The radius of the other one.
    pub rolling: Rational,
    /// The distance of the point from its centre.
    pub arm: Rational,
    /// Whether one circle lies in the other.
    pub internal: bool,
}

/// Shafts and relations between their rates.
#[derive(Clone, Debug, Default)]
pub struct Train {
    /// The names of the shafts.
    pub shafts: Vec<String>,
    /// The relations: sums of rates times these factors, by shaft, are 0.
    pub relations: Vec<Vec<Rational>>,
    /// The given rates.
    pub given: Vec<(usize, Rational)>,
}

/// A wheel with free rollers at its rim.
#[derive(Clone, Debug)]
pub struct Wheel {
    /// Its point of contact with the floor, in coordinates of the vehicle.
    pub at: [Rational; 2],
    /// The direction in which it rolls when it turns and its rollers do not.
    pub drive: [Rational; 2],
    /// The direction of the axis of the roller at the floor.
    pub roller: [Rational; 2],
    /// Its radius.
    pub radius: Rational,
}

/// A pair of involute gears with parallel axes.
#[derive(Clone, Debug)]
pub struct Pair {
    /// The normal module.
    pub module: Rational,
    /// The normal pressure angle.
    pub pressure_angle: Angle,
    /// The helix angle; 0 for spur gears.
    pub helix: Angle,
    /// The numbers of teeth.
    pub teeth: [u32; 2],
    /// The profile shifts, in modules.
    pub shift: [Rational; 2],
    /// The face width.
    pub width: Option<Rational>,
    /// Whether the second gear has internal teeth.
    pub internal: bool,
}

/// A pair of involute gears with skew axes.
#[derive(Clone, Debug)]
pub struct Crossed {
    /// The normal module.
    pub module: Rational,
    /// The normal pressure angle.
    pub pressure_angle: Angle,
    /// The helix angles, of one sign where both gears have the same hand; the axes make their sum.
    pub helix: [Angle; 2],
    /// The numbers of teeth.
    pub teeth: [u32; 2],
}

impl Gearing {
    /// Returns the value of `find`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Train(_) => "train",
            Self::Wheels { .. } => "wheels",
            Self::Pair(_) => "pair",
            Self::Crossed(_) => "crossed",
            Self::Involute(..) => "involute",
            Self::Trochoid(_) => "trochoid",
        }
    }
}

const PAIR: [&str; 7] = ["module", "pressure_angle", "helix", "teeth", "shift", "width", "mesh"];

/// Reads the question of a file of kind `gearing`.
pub(super) fn gearing(scope: &Scope<'_>, table: &Table<'_>) -> Result<Gearing> {
    let words = ["train", "wheels", "pair", "crossed", "involute", "trochoid"];
    let keys = [&PAIR[..], &["twist", "radius", "roll", "fixed", "rolling", "arm"]].concat();
    let (find, mechanism, _) = found(scope, table, &words, &keys)?;
    let own: &[&str] = match find {
        "train" => &[],
        "wheels" => &["twist"],
        "pair" => &PAIR,
        "crossed" => &["module", "pressure_angle", "helix", "teeth"],
        "trochoid" => &["fixed", "rolling", "arm", "mesh"],
        _ => &["radius", "roll"],
    };
    if let Some(node) = keys.iter().filter(|key| !own.contains(key)).find_map(|key| mechanism.get(key)) {
        return Err(scope.fail(node.line, format!("found a key that `find = \"{find}\"` does not have")));
    }
    match find {
        "train" => train(scope, table),
        "wheels" => wheels(scope, table, &mechanism),
        "pair" => pair(scope, &mechanism),
        "crossed" => crossed(scope, &mechanism),
        "trochoid" => trochoid(scope, &mechanism),
        _ => {
            // Angles are used as their enclosures, so reading them rounds nothing.
            let free = Scope::new(scope.path, scope.reading.clone());
            let radius = positive(scope, scope.need(&mechanism, "radius")?, "radius")?;
            let roll = free.angle(scope.need(&mechanism, "roll")?, "roll")?;
            Ok(Gearing::Involute(radius, Box::new(roll)))
        }
    }
}

fn positive(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Rational> {
    let length = scope.length(node, what)?.rational().clone();
    if length <= 0 {
        return Err(scope.fail(node.line, format!("found {} as `{what}`, expected a positive length", length.to_f64())));
    }
    Ok(length)
}

fn is_internal(scope: &Scope<'_>, mechanism: &Table<'_>) -> Result<bool> {
    let word = mechanism.get("mesh").map(|node| scope.word(node, "mesh", &["external", "internal"])).transpose()?;
    Ok(word == Some("internal"))
}

fn trochoid(scope: &Scope<'_>, mechanism: &Table<'_>) -> Result<Gearing> {
    let length = |key: &str| positive(scope, scope.need(mechanism, key)?, key);
    let rolling = Rolling {
        fixed: length("fixed")?,
        rolling: length("rolling")?,
        arm: length("arm")?,
        internal: is_internal(scope, mechanism)?,
    };
    if rolling.internal && rolling.fixed == rolling.rolling {
        return Err(scope.fail(
            mechanism.line(),
            "found a circle in one of its own radius, which does not roll, expected two radii",
        ));
    }
    Ok(Gearing::Trochoid(Box::new(rolling)))
}

fn ratio(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Rational> {
    Ok(scope.number(node, Quantity::Ratio, what)?.rational().clone())
}

fn train(scope: &Scope<'_>, table: &Table<'_>) -> Result<Gearing> {
    let mut train = Train::default();
    for (own, node) in parts(scope, table, "shaft", &["name", "rate"], &["gear", "relation"])? {
        let name = scope.text(scope.need(&own, "name")?, "name")?.to_owned();
        if train.shafts.contains(&name) {
            return Err(scope.fail(node.line, format!("found the shaft {name} twice, expected different names")));
        }
        if let Some(rate) = own.get("rate") {
            train.given.push((train.shafts.len(), ratio(scope, rate, "rate")?));
        }
        train.shafts.push(name);
    }
    let count = train.shafts.len();
    let index = |name: &str, line: usize| {
        train.shafts.iter().position(|own| own == name).ok_or_else(|| {
            let name: String = name.chars().take(40).collect();
            scope.fail(line, format!("found the unknown shaft `{name}`, expected one of {}", train.shafts.join(", ")))
        })
    };
    let mut relations = Vec::new();
    if table.get("gear").is_some() {
        for (own, node) in parts(scope, table, "gear", &["of", "carrier", "ratio"], &["shaft", "relation"])? {
            let [a, b] = scope.exactly::<2>(scope.need(&own, "of")?, "of")?;
            let [a, b] = [index(scope.text(a, "of")?, a.line)?, index(scope.text(b, "of")?, b.line)?];
            let node_of_ratio = scope.need(&own, "ratio")?;
            let factor = ratio(scope, node_of_ratio, "ratio")?;
            if a == b || factor == 0 {
                return Err(scope.fail(
                    node.line,
                    "found a gear of one shaft or of ratio 0, expected two shafts and another ratio",
                ));
            }
            // (b - carrier) = ratio (a - carrier)
            let mut relation = vec![Rational::new(); count];
            relation[b] += 1;
            relation[a] -= &factor;
            if let Some(carrier) = own.get("carrier") {
                relation[index(scope.text(carrier, "carrier")?, carrier.line)?] += factor - 1;
            }
            relations.push(relation);
        }
    }
    if table.get("relation").is_some() {
        for (own, node) in parts(scope, table, "relation", &["terms"], &["shaft", "gear"])? {
            let terms = scope.need(&own, "terms")?;
            let Value::Table(fields) = &terms.value else {
                return Err(scope.fail(node.line, "found `terms` that is no table, expected factors by shaft"));
            };
            let mut relation = vec![Rational::new(); count];
            for field in fields {
                relation[index(&field.key, field.line)?] += ratio(scope, &field.node, &field.key)?;
            }
            relations.push(relation);
        }
    }
    train.relations = relations;
    Ok(Gearing::Train(train))
}

fn wheels(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>) -> Result<Gearing> {
    let pair = |own: &Table<'_>, key: &str, quantity: Quantity| -> Result<[Rational; 2]> {
        let [x, y] = scope.exactly::<2>(scope.need(own, key)?, key)?;
        let number = |node: &Node| Ok::<_, Error>(scope.number(node, quantity, key)?.rational().clone());
        Ok([number(x)?, number(y)?])
    };
    let mut list = Vec::new();
    for (own, node) in parts(scope, table, "wheel", &["at", "drive", "roller", "radius"], &[])? {
        let wheel = Wheel {
            at: pair(&own, "at", Quantity::Length)?,
            drive: pair(&own, "drive", Quantity::Ratio)?,
            roller: pair(&own, "roller", Quantity::Ratio)?,
            radius: positive(scope, scope.need(&own, "radius")?, "radius")?,
        };
        let along =
            Rational::from(&wheel.drive[0] * &wheel.roller[0]) + Rational::from(&wheel.drive[1] * &wheel.roller[1]);
        if along == 0 {
            let message =
                "found a roller across the drive of its wheel, expected one that is not: such a wheel drives nothing";
            return Err(scope.fail(node.line, message));
        }
        list.push(wheel);
    }
    let twist = match mechanism.get("twist") {
        None => None,
        Some(node) => {
            let [x, y, turn] = scope.exactly::<3>(node, "twist")?;
            let length = |node: &Node| Ok::<_, Error>(scope.length(node, "twist")?.rational().clone());
            Some([length(x)?, length(y)?, ratio(scope, turn, "twist")?])
        }
    };
    Ok(Gearing::Wheels { wheels: list, twist })
}

/// Reads the numbers of teeth of two gears, and where they stand.
fn teeth<'n>(scope: &Scope<'_>, mechanism: &Table<'n>) -> Result<(&'n Node, [u32; 2])> {
    let node = scope.need(mechanism, "teeth")?;
    let [a, b] = scope.exactly::<2>(node, "teeth")?;
    let teeth = |node: &Node| match scope.count(node, "teeth")? {
        count @ 3..=MOST_TEETH => Ok(u32::try_from(count).unwrap_or(u32::MAX)),
        other => Err(scope.fail(node.line, format!("found {other} teeth, expected 3 to {MOST_TEETH}"))),
    };
    Ok((node, [teeth(a)?, teeth(b)?]))
}

fn crossed(scope: &Scope<'_>, mechanism: &Table<'_>) -> Result<Gearing> {
    // Angles are used as their enclosures, so reading them rounds nothing.
    let free = Scope::new(scope.path, scope.reading.clone());
    let within = |node: &Node, key: &str, [least, most]: [f64; 2]| {
        let angle = free.angle(node, key)?;
        let degrees = angle.radians().to_degrees();
        if !(degrees >= least && degrees <= most) {
            let message = format!("found {degrees} deg as `{key}`, expected {least} deg to {most} deg");
            return Err(scope.fail(node.line, message));
        }
        Ok(angle)
    };
    let [a, b] = scope.exactly::<2>(scope.need(mechanism, "helix")?, "helix")?;
    let helix = |node: &Node| within(node, "helix", [-80.0, 80.0]);
    Ok(Gearing::Crossed(Box::new(Crossed {
        module: positive(scope, scope.need(mechanism, "module")?, "module")?,
        pressure_angle: within(scope.need(mechanism, "pressure_angle")?, "pressure_angle", [1.0, 60.0])?,
        helix: [helix(a)?, helix(b)?],
        teeth: teeth(scope, mechanism)?.1,
    })))
}

fn pair(scope: &Scope<'_>, mechanism: &Table<'_>) -> Result<Gearing> {
    // Angles are used as their enclosures, so reading them rounds nothing.
    let free = Scope::new(scope.path, scope.reading.clone());
    let angle = |key: &str, otherwise: Option<Angle>| -> Result<Angle> {
        match (mechanism.get(key), otherwise) {
            (Some(node), _) => {
                let angle = free.angle(node, key)?;
                let degrees = angle.radians().to_degrees();
                let least = if key == "helix" { 0.0 } else { f64::MIN_POSITIVE };
                if !(least..60.0).contains(&degrees.abs()) || degrees < 0.0 {
                    return Err(
                        scope.fail(node.line, format!("found {degrees} deg as `{key}`, expected less than 60 deg"))
                    );
                }
                Ok(angle)
            }
            (None, Some(angle)) => Ok(angle),
            (None, None) => Err(scope.fail(mechanism.line(), format!("found no `{key}`, expected one"))),
        }
    };
    let (node, teeth) = teeth(scope, mechanism)?;
    let internal = is_internal(scope, mechanism)?;
    if internal && teeth[1] <= teeth[0] {
        let message = format!("found {} teeth inside around {}, expected more inside than around", teeth[1], teeth[0]);
        return Err(scope.fail(node.line, message));
    }
    let shift = match mechanism.get("shift") {
        None => [Rational::new(), Rational::new()],
        Some(node) => {
            let [a, b] = scope.exactly::<2>(node, "shift")?;
            [ratio(scope, a, "shift")?, ratio(scope, b, "shift")?]
        }
    };
    let width = mechanism.get("width").map(|node| positive(scope, node, "width")).transpose()?;
    Ok(Gearing::Pair(Box::new(Pair {
        module: positive(scope, scope.need(mechanism, "module")?, "module")?,
        pressure_angle: angle("pressure_angle", None)?,
        helix: angle("helix", Some(Angle::zero()))?,
        teeth,
        shift,
        width,
        internal,
    })))
}
