//! The data of a case as a certificate holds them: a mechanism file of one case, every number in canonical form.

use super::fault::{Fault, refused};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number};
use crate::algebra::ring::Ring;
use crate::catalogue::entry::{Case, Design, Entry, InputValue, Kind};
use crate::catalogue::{Chains, Format, Options, load_text};
use crate::kinematics::chain::{Chain, Geometry, Joint, Placement, ScrewJoint};
use crate::kinematics::joint::DhConstant;
use crate::kinematics::motion::dot;
use rug::{Integer, Rational};
use serde_json::{Map, Value, json};

/// Returns the data of a case.
///
/// # Errors
/// Names a number that has no exact form for a certificate.
pub fn data_of(entry: &Entry, case: &Case) -> Result<Value, String> {
    match &entry.design {
        Design::Arm(chain) => {
            let Some(pose) = &case.pose else { return Err("there is no pose".to_owned()) };
            if !case.input.is_empty() {
                return Err("joints that are held have no certificate".to_owned());
            }
            let mechanism = mechanism(chain, entry.kind())?;
            Ok(json!({ "mechanism": mechanism, "pose": [{ "matrix": matrix(pose, "pose")? }] }))
        }
        Design::Loop(chain) => {
            let mechanism = mechanism(chain, entry.kind())?;
            let inputs = case.input.iter().map(|input| {
                Ok(match &input.value {
                    InputValue::Angle(value) => json!({ "joint": input.joint, "angle": angle(value, "input")? }),
                    InputValue::Distance(value) => json!({ "joint": input.joint, "distance": number(value, "input")? }),
                })
            });
            let inputs: Vec<Value> = inputs.collect::<Result<_, String>>()?;
            Ok(if inputs.is_empty() {
                json!({ "mechanism": mechanism })
            } else {
                json!({ "mechanism": mechanism, "input": inputs })
            })
        }
        Design::Platform(platform) => {
            let Some(squares) = &case.legs_squared else { return Err("there are no legs".to_owned()) };
            let numbers =
                |numbers: &[Number], what| numbers.iter().map(|x| number(x, what)).collect::<Result<Vec<_>, _>>();
            let points = |points: &[[Number; 3]; 6], what| {
                points.iter().map(|point| numbers(point, what)).collect::<Result<Vec<_>, _>>()
            };
            Ok(json!({ "mechanism": {
                "kind": "platform",
                "base": points(&platform.base, "base")?,
                "plate": points(&platform.plate, "plate")?,
                "legs_squared": numbers(squares, "legs")?,
            } }))
        }
    }
}

/// Returns the data of a loop for a certificate of mobility, which does not depend on an input.
///
/// # Errors
/// As [`data_of`], and for other mechanisms.
pub fn data_of_loop(entry: &Entry) -> Result<Value, String> {
    match &entry.design {
        Design::Loop(chain) => Ok(json!({ "mechanism": mechanism(chain, entry.kind())? })),
        Design::Arm(_) | Design::Platform(_) => Err("only of loops it is certified whether they move".to_owned()),
    }
}

/// Returns the mechanism described by the data, with as many unknowns as a reader accepts.
pub(super) fn entry_of(data: &Map<String, Value>, chains: Chains) -> Result<Entry, Fault> {
    // The data must not contain anything that does not affect the verdict; the reader knows more keys.
    let known = ["mechanism", "pose", "input"];
    if let Some(key) = data.keys().find(|key| !known.contains(&key.as_str())) {
        return refused(format!("data: the key `{}` decides nothing", super::fault::shortened(key)));
    }
    let text = Value::Object(data.clone()).to_string();
    let entry = load_text(&text, "data", Format::Json, &Options { chains, ..Options::default() });
    entry.map_err(|error| Fault::Unreadable(error.to_string()))
}

fn mechanism(chain: &Chain, kind: Kind) -> Result<Value, String> {
    let is_arm = kind == Kind::Arm;
    let mut table = Map::new();
    table.insert("kind".to_owned(), json!(if is_arm { "arm" } else { "loop" }));
    let (convention, joints) = match &chain.geometry {
        Geometry::Dh(joints) => ("dh", joints.iter().map(joint).collect::<Result<Vec<_>, _>>()?),
        Geometry::ModifiedDh(joints) => ("modified-dh", joints.iter().map(joint).collect::<Result<Vec<_>, _>>()?),
        Geometry::Screws { joints, .. } => ("screws", joints.iter().map(screw).collect::<Result<Vec<_>, _>>()?),
    };
    table.insert("convention".to_owned(), json!(convention));
    table.insert("joints".to_owned(), json!(joints));
    if let Geometry::Screws { home, .. } = &chain.geometry {
        table.insert("home".to_owned(), matrix(home, "home")?);
    }
    let nowhere = Placement::identity();
    for (key, placed) in [("base", &chain.base), ("tool", &chain.tool)] {
        if *placed != nowhere {
            table.insert(key.to_owned(), matrix(placed, key)?);
        }
    }
    Ok(Value::Object(table))
}

fn joint(joint: &Joint) -> Result<Value, String> {
    let mut table = Map::new();
    let mut put = |key: &str, text: String| table.insert(key.to_owned(), json!(text));
    put("type", joint.kind.letter().to_owned());
    put("a", number(&joint.a, "a")?);
    put("alpha", angle(&joint.alpha, "alpha")?);
    if joint.kind.row().has_pitch {
        return Err("helical joints have no certificate".to_owned());
    }
    let (d, theta) = (joint.kind.row().d, joint.kind.row().theta);
    // The order of the keys is part of the text of a certificate: an offset d0 comes last, a constant d before the angle.
    let mut keys = [d.key_of_d(), theta.keys_of_theta().map(|[key, _]| key)];
    if d == DhConstant::Offset {
        keys.reverse();
    }
    for key in keys.into_iter().flatten() {
        put(key, if key.starts_with('d') { number(&joint.d, key)? } else { angle(&joint.theta0, key)? });
    }
    Ok(Value::Object(table))
}

/// Returns the canonical form of a screw: whole numbers without a common factor as direction, and the point of the axis
/// nearest to the origin.
fn screw(joint: &ScrewJoint) -> Result<Value, String> {
    let is_exact = joint.axis.iter().chain(&joint.point).all(Number::is_exact);
    if !is_exact {
        return Err("axes by irrational numbers have no certificate".to_owned());
    }
    let letter = joint.kind.letter();
    let axis = primitive(&joint.axis.each_ref().map(|x| x.rational().clone()));
    let text = |x: &Rational| number(&Number::exact(x.clone()), "point");
    let words = axis.iter().map(Integer::to_string).collect::<Vec<_>>();
    if !joint.kind.is_plain() {
        return Err(format!("{letter} joints given by screws have no certificate"));
    }
    if joint.kind.only_translates() {
        return Ok(json!({ "type": letter, "axis": words }));
    }
    let along: Rational = axis.iter().zip(&joint.point).map(|(u, p)| Rational::from(u * p.rational())).sum();
    let square: Integer = axis.iter().map(|u| Integer::from(u.square_ref())).sum();
    let along = along / square;
    let foot = axis.iter().zip(&joint.point).map(|(u, p)| text(&(p.rational() - Rational::from(u * &along))));
    Ok(json!({ "type": letter, "axis": words, "point": foot.collect::<Result<Vec<_>, _>>()? }))
}

/// Returns the whole numbers without a common factor in the ratio of these rational numbers.
pub(super) fn primitive(direction: &[Rational; 3]) -> [Integer; 3] {
    let below = direction.iter().fold(Integer::from(1), |all, x| all.lcm(x.denom()));
    let whole = direction.each_ref().map(|x| Rational::from(x * &below).numer().clone());
    let common = whole.iter().fold(Integer::new(), Integer::gcd);
    whole.map(|x| if common > 1 { x.div_exact(&common) } else { x })
}

/// Returns the rows of a motion, its rotation orthonormal: a rounded one is written as the rational rotation that stands for it.
fn matrix(placed: &Placement, what: &str) -> Result<Value, String> {
    let given = placed.given.as_deref().filter(|given| !given.is_rotation);
    let rows = placed.rows();
    let is_exact = rows.as_ref().is_none_or(|rows| rows.iter().all(|row| row.iter().take(3).all(Number::is_exact)));
    if let Some(given) = given.filter(|_| !is_exact) {
        let column = |j: usize| given.motion.rotation.each_ref().map(|row| row[j].clone());
        let is_unit = |i: usize, j: usize| {
            dot(&column(i), &column(j)).sub(&Enclosure::from_integer(i32::from(i == j))).holds_zero()
        };
        if !(0..9).all(|k| is_unit(k / 3, k % 3)) {
            return Err(format!("the rotation of the {what} is one of irrational numbers that are rounded"));
        }
    }
    if placed.given.is_some() && rows.is_none() {
        return Err(format!("the {what} is made of irrational numbers"));
    }
    let own = |i: usize, j: usize| {
        let known = rows.as_ref().map(|rows| &rows[i][j]).filter(|_| j == 3 || !is_exact);
        let exact = if j < 3 { &placed.exact.rotation[i][j] } else { &placed.exact.translation[i] };
        known.map_or_else(|| number(&Number::exact(exact.clone()), what), |known| number(known, what))
    };
    let row = |i: usize| (0..4).map(|j| own(i, j)).collect::<Result<Vec<_>, _>>();
    Ok(json!([row(0)?, row(1)?, row(2)?, ["0", "0", "0", "1"]]))
}

fn number(number: &Number, what: &str) -> Result<String, String> {
    let text = number.text().ok_or_else(|| format!("a number of {what} is known by its rounded value only"))?;
    Ok(without_units(&text))
}

fn angle(angle: &Angle, what: &str) -> Result<String, String> {
    let text = angle.text().ok_or_else(|| format!("an angle of {what} is known by its rounded value only"))?;
    Ok(without_units(&text))
}

/// Returns an expression in radians, without units of angles. A unit binds less tightly than a sum.
fn without_units(text: &str) -> String {
    // Where the sums that are open begin.
    let (mut starts, mut plain, mut rest) = (vec![0], String::new(), text);
    while let Some(first) = rest.chars().next() {
        let is_word = first.is_ascii_alphabetic();
        let end = if is_word { rest.find(|c: char| !c.is_ascii_alphanumeric()) } else { Some(first.len_utf8()) };
        let (piece, behind) = rest.split_at(end.unwrap_or(rest.len()));
        rest = behind;
        match piece {
            "rad" => {}
            "deg" => {
                plain.insert(starts.last().copied().unwrap_or(0), '(');
                plain.push_str(")*pi/180");
            }
            _ => plain.push_str(piece),
        }
        match piece {
            "(" => starts.push(plain.len()),
            ")" => drop(starts.pop()),
            "," => {
                starts.pop();
                starts.push(plain.len());
            }
            _ => {}
        }
    }
    plain.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::without_units;

    #[test]
    fn units_of_angles_are_written_out() {
        for (text, plain) in [
            ("30 deg", "(30 )*pi/180"),
            ("(180 - (99)) deg", "((180 - (99)) )*pi/180"),
            ("cos(1 + 30deg)*sqrt(2)", "cos((1 + 30)*pi/180)*sqrt(2)"),
            ("atan2(1e-3, sin(2 rad))", "atan2(1e-3, sin(2 ))"),
            ("2*atan(1/3)", "2*atan(1/3)"),
        ] {
            assert_eq!(without_units(text), plain);
        }
    }
}
