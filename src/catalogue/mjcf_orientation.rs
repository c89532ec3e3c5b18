//! Orientations and axes of models for `MuJoCo` (MJCF), and the settings by which they are read.

use super::mjcf::Part;
use super::node::{Node, Value};
use super::robot_chain::{Origin, Turn, along, nowhere, numbers};
use super::scope::Scope;
use super::snap;
use super::urdf::line;
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::Result;
use crate::kinematics::chain::JointKind;
use nalgebra::{Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};
use roxmltree::Node as Element;
use rug::Rational;
use std::f64::consts::PI;

/// Ratios of the entries of a quaternion that are so near to whole ones are these: it is that of a half or a quarter turn.
const SAME: f64 = 1e-12;
/// Directions shorter than this have no direction.
const SHORTEST: f64 = 1e-14;

/// How the angles of a model are read.
pub(super) struct Orientations {
    pub(super) is_degrees: bool,
    pub(super) autolimits: bool,
    /// The axes of `euler` in order, and whether each turns with the ones before it.
    sequence: [(usize, bool); 3],
    /// The path of the file, and how plain angles are read.
    angles: Angles,
}

/// The reader of angles in the unit of the model.
struct Angles {
    path: String,
    reading: Reading,
    is_rounded: std::cell::Cell<bool>,
}

impl Orientations {
    /// Reads the settings of a model.
    pub(super) fn of(scope: &Scope<'_>, model: Element<'_, '_>) -> Result<Self> {
        let (mut is_degrees, mut autolimits) = (true, true);
        let mut sequence = [(0, true), (1, true), (2, true)];
        for compiler in model.children().filter(|own| own.has_tag_name("compiler")) {
            let word = |name: &str, words: [&str; 2]| match compiler.attribute(name) {
                None => Ok(None),
                Some(found) if words.contains(&found) => Ok(Some(found == words[0])),
                Some(found) => {
                    let message = format!("found \"{found}\" as `{name}`, expected {} or {}", words[0], words[1]);
                    Err(scope.fail(line(compiler), message))
                }
            };
            is_degrees = word("angle", ["degree", "radian"])?.unwrap_or(is_degrees);
            autolimits = word("autolimits", ["true", "false"])?.unwrap_or(autolimits);
            if word("coordinate", ["local", "global"])? == Some(false) {
                return Err(scope.fail(line(compiler), "found global coordinates, expected local ones"));
            }
            if let Some(found) = compiler.attribute("eulerseq") {
                let message = || format!("found \"{found}\" as `eulerseq`, expected three of x, y, z, X, Y and Z");
                sequence = axes(found).ok_or_else(|| scope.fail(line(compiler), message()))?;
            }
        }
        let reading = Reading { degrees: is_degrees, ..scope.reading.clone() };
        let angles = Angles { path: scope.path.to_owned(), reading, is_rounded: false.into() };
        Ok(Self { is_degrees, autolimits, sequence, angles })
    }

    /// Tells the reader of the file whether an angle had to be rounded.
    pub(super) fn note(&self, scope: &Scope<'_>) {
        scope.note(!self.angles.is_rounded.get());
    }

    /// Returns the rotations of a part.
    pub(super) fn turns(&self, scope: &Scope<'_>, part: &Part<'_, '_, '_>) -> Result<Vec<Turn>> {
        let kinds = ["quat", "euler", "axisangle", "xyaxes", "zaxis"];
        let mut given = kinds.iter().filter_map(|kind| Some((*kind, part.element.attribute(*kind)?)));
        let own = given.next();
        if let (Some((first, _)), Some((second, _))) = (own, given.next()) {
            let message = format!("found `{first}` and `{second}`, expected one orientation");
            return Err(scope.fail(line(part.element), message));
        }
        let inherited = || kinds.iter().find_map(|kind| part.attribute(kind).map(|found| (*kind, found)));
        let found = own.map(|(kind, text)| (kind, (text, line(part.element)))).or_else(inherited);
        let Some((kind, (text, at))) = found else { return Ok(Vec::new()) };
        match kind {
            "quat" => Self::quaternion(scope, text, at, part.place()),
            "euler" => self.euler(scope, text, at, part.place()),
            "axisangle" => self.axis_angle(scope, text, at, part.place()),
            "xyaxes" => {
                let [a, b, c, d, e, f] = floats::<6>(scope, text, at, kind)?;
                let x = Vector3::new(a, b, c).try_normalize(SHORTEST);
                let y = x.and_then(|x| {
                    let y = Vector3::new(d, e, f);
                    (y - x * x.dot(&y)).try_normalize(SHORTEST)
                });
                let (Some(x), Some(y)) = (x, y) else {
                    return Err(scope.fail(at, "found two axes that are parallel or zero, expected two directions"));
                };
                let matrix = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
                Ok(vec![meant(&UnitQuaternion::from_rotation_matrix(&matrix))])
            }
            _ => {
                let [x, y, z] = floats::<3>(scope, text, at, kind)?;
                let Some(axis) = Vector3::new(x, y, z).try_normalize(SHORTEST) else {
                    return Err(scope.fail(at, "found the axis 0 0 0, expected a direction"));
                };
                // The shortest rotation that takes z there; opposite to z it is a half turn about x.
                let turn = UnitQuaternion::rotation_between(&Vector3::z(), &axis);
                Ok(vec![meant(&turn.unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI)))])
            }
        }
    }

    fn quaternion(scope: &Scope<'_>, text: &str, at: usize, place: &str) -> Result<Vec<Turn>> {
        let nodes = numbers::<4>(scope, text, at, "quat")?;
        let mut exact: [Number; 4] = std::array::from_fn(|_| Number::zero());
        for (number, node) in exact.iter_mut().zip(&nodes) {
            *number = scope.number(node, Quantity::Ratio, "quat")?;
        }
        let values = exact.each_ref().map(Number::to_f64);
        if values.iter().all(|x| x.abs() < SHORTEST) {
            return Err(scope.fail(at, "found the quaternion 0 0 0 0, expected a rotation"));
        }
        if let Some(whole) = whole(values) {
            return Ok(vec![Turn::Quaternion(whole)]);
        }
        // A quaternion that was printed from a multiple of half a degree is that angle.
        let [w, imaginary @ ..] = values;
        let mut others = (0..3).filter(|k| imaginary[*k] != 0.0);
        if let (Some(axis), None) = (others.next(), others.next()) {
            let angle = format!("{:?}", 2.0 * imaginary[axis].atan2(w));
            if snap::multiple(&angle).is_some_and(|(_, nearness)| nearness == snap::Nearness::Same) {
                let node = Node { line: at, value: Value::Text(angle) };
                return Ok(vec![Turn::About(axis, scope.printed_angle(&node, "quat", place)?)]);
            }
        }
        Ok(vec![Turn::Quaternion(exact)])
    }

    fn euler(&self, scope: &Scope<'_>, text: &str, at: usize, place: &str) -> Result<Vec<Turn>> {
        let mut turns = Vec::new();
        for (node, (axis, turns_along)) in numbers::<3>(scope, text, at, "euler")?.iter().zip(self.sequence) {
            let turn = Turn::About(axis, self.angles.read(scope, node, "euler", place)?);
            let place = if turns_along { turns.len() } else { 0 };
            turns.insert(place, turn);
        }
        Ok(turns)
    }

    fn axis_angle(&self, scope: &Scope<'_>, text: &str, at: usize, place: &str) -> Result<Vec<Turn>> {
        let [x, y, z, angle] = numbers::<4>(scope, text, at, "axisangle")?;
        let axis = [x, y, z].map(|node| float(scope, &node, "axisangle"));
        let [x, y, z] = axis;
        self.about(scope, [x?, y?, z?], angle, "axisangle", place)
    }

    /// Returns the rotation about a direction.
    fn about(&self, scope: &Scope<'_>, axis: [f64; 3], angle: Node, what: &str, place: &str) -> Result<Vec<Turn>> {
        let at = angle.line;
        if let Some((k, is_back)) = coordinate_axis(axis) {
            let angle = if is_back { negated(angle) } else { angle };
            return Ok(vec![Turn::About(k, self.angles.read(scope, &angle, what, place)?)]);
        }
        let Some(axis) = Vector3::from(axis).try_normalize(SHORTEST) else {
            return Err(scope.fail(at, "found the axis 0 0 0, expected a direction"));
        };
        let radians = self.angles.read(scope, &angle, what, place)?.radians();
        Ok(vec![meant(&UnitQuaternion::from_axis_angle(&Unit::new_unchecked(axis), radians))])
    }

    /// Returns the way that a joint is back at value 0 from its place in the model.
    pub(super) fn reference(
        &self,
        scope: &Scope<'_>,
        joint: &Part<'_, '_, '_>,
        kind: Option<JointKind>,
    ) -> Result<Origin> {
        let mut origin = Origin { position: nowhere(), turns: Vec::new() };
        let Some((text, at)) = joint.attribute("ref") else { return Ok(origin) };
        let [node] = numbers::<1>(scope, text, at, "ref")?;
        let back = negated(node);
        let axis = joint_axis(scope, joint)?.each_ref().map(Number::to_f64);
        if kind == Some(JointKind::Revolute) {
            origin.turns = self.about(scope, axis, back, "ref", joint.place())?;
        } else if let Some((k, is_back)) = coordinate_axis(axis) {
            origin.position[k] = scope.length(&if is_back { negated(back) } else { back }, "ref")?;
        } else {
            let (way, direction) = (float(scope, &back, "ref")?, Vector3::from(axis).normalize());
            for (length, part) in origin.position.iter_mut().zip(direction.iter()) {
                let node = Node { line: at, value: Value::Text(format!("{:?}", way * part)) };
                *length = scope.length(&node, "ref")?;
            }
        }
        Ok(origin)
    }
}

impl Angles {
    /// Reads an angle in the unit of the model.
    fn read(&self, scope: &Scope<'_>, node: &Node, what: &str, place: &str) -> Result<Angle> {
        if !self.reading.degrees {
            return scope.printed_angle(node, what, place);
        }
        let own = Scope::new(&self.path, self.reading.clone());
        let angle = own.angle(node, what)?;
        self.is_rounded.set(self.is_rounded.get() || own.is_rounded());
        Ok(angle)
    }
}

/// Returns the axis of a joint, by default z.
pub(super) fn joint_axis(scope: &Scope<'_>, joint: &Part<'_, '_, '_>) -> Result<[Number; 3]> {
    let Some((text, at)) = joint.attribute("axis") else { return Ok(along(2)) };
    let mut axis = along(2);
    for (image, node) in axis.iter_mut().zip(numbers::<3>(scope, text, at, "axis")?) {
        *image = scope.number(&node, Quantity::Ratio, "axis")?;
    }
    if axis.iter().all(|x| x.rational().is_zero()) {
        return Err(scope.fail(at, "found the axis 0 0 0, expected a direction"));
    }
    Ok(axis)
}

/// Returns the negative of a plain number.
pub(super) fn negated(node: Node) -> Node {
    let Value::Text(text) = &node.value else { return node };
    let text = text.strip_prefix('-').map_or_else(|| format!("-{}", text.trim_start_matches('+')), str::to_owned);
    Node { value: Value::Text(text), ..node }
}

/// Returns the coordinate axis that a direction is along, and whether it is opposite to it.
fn coordinate_axis(axis: [f64; 3]) -> Option<(usize, bool)> {
    let mut others = (0..3).filter(|k| axis[*k] != 0.0);
    let (first, second) = (others.next()?, others.next());
    second.is_none().then_some((first, axis[first] < 0.0))
}

/// Returns the axes of a sequence of rotations; upper-case ones stand still.
fn axes(sequence: &str) -> Option<[(usize, bool); 3]> {
    let axis = |letter: char| {
        let place = "xyz".find(letter.to_ascii_lowercase())?;
        Some((place, letter.is_ascii_lowercase()))
    };
    sequence.chars().map(axis).collect::<Option<Vec<_>>>()?.try_into().ok()
}

/// Returns the rotation that a computed quaternion means: the one of its doubles, or that of half and quarter turns beside it.
fn meant(quaternion: &UnitQuaternion<f64>) -> Turn {
    let values = [quaternion.w, quaternion.i, quaternion.j, quaternion.k];
    let exact = |x: f64| Number::exact(Rational::from_f64(x).unwrap_or_default());
    Turn::Quaternion(whole(values).unwrap_or_else(|| values.map(exact)))
}

/// Returns the quaternion of zeros and ones with both signs beside this one, if there is one.
fn whole(values: [f64; 4]) -> Option<[Number; 4]> {
    let largest = values.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let ratios = values.map(|x| x / largest);
    let is_whole = ratios.iter().all(|x| (x - x.round()).abs() < SAME);
    is_whole.then(|| ratios.map(|x| Number::exact(Rational::from_f64(x.round()).unwrap_or_default())))
}

fn float(scope: &Scope<'_>, node: &Node, what: &str) -> Result<f64> {
    scope.number(node, Quantity::Ratio, what).map(|number| number.to_f64())
}

fn floats<const N: usize>(scope: &Scope<'_>, text: &str, at: usize, what: &str) -> Result<[f64; N]> {
    let mut values = [0.0; N];
    for (value, node) in values.iter_mut().zip(numbers::<N>(scope, text, at, what)?) {
        *value = float(scope, &node, what)?;
    }
    Ok(values)
}
