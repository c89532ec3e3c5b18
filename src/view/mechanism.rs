//! The stage of a mechanism as `show --json` prints it: saved results are drawn without their file.

use crate::algebra::number::{Angle, Number};
use crate::catalogue::entry::Design;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use crate::kinematics::platform::Platform;
use crate::scene::{Point, Stage};
use serde_json::Value;

/// The stage of a document's mechanism; `None` where it is of another form, or not drawn.
pub(super) fn stage(document: &Value) -> Option<Stage> {
    let mechanism = &document["mechanism"];
    let links = document["base_link"].as_str().zip(document["tip_link"].as_str());
    let links = links.map(|(base, tip)| [base.to_owned(), tip.to_owned()]);
    match mechanism["kind"].as_str()? {
        "framework" => framework(mechanism),
        "platform" => Stage::of_design(&Design::Platform(Box::new(platform(mechanism)?)), None),
        "arm" => Stage::of_design(&Design::Arm(chain(mechanism)?), links.as_ref()),
        "loop" => Stage::of_design(&Design::Loop(chain(mechanism)?), None),
        _ => None,
    }
}

/// A number that is finite; JSON can write larger ones.
fn real(value: &Value) -> Option<f64> {
    value.as_f64().filter(|x| x.is_finite())
}

fn number(value: &Value) -> Option<Number> {
    real(value).map(Number::from_f64)
}

fn angle(value: &Value) -> Option<Angle> {
    real(value).map(Angle::from_radians)
}

fn three<T>(value: &Value, part: impl Fn(&Value) -> Option<T>) -> Option<[T; 3]> {
    let list: Option<Vec<T>> = value.as_array()?.iter().map(part).collect();
    list?.try_into().ok()
}

fn placement(value: &Value) -> Option<Placement> {
    if value.is_null() {
        return Some(Placement::identity());
    }
    let row = |row: &Value| -> Option<[Number; 4]> {
        row.as_array()?.iter().map(number).collect::<Option<Vec<Number>>>()?.try_into().ok()
    };
    let rows: Option<Vec<[Number; 4]>> = value.as_array()?.iter().map(row).collect();
    let rows: [[Number; 4]; 4] = rows?.try_into().ok()?;
    Placement::from_matrix(&rows).ok().map(|(placement, _)| placement)
}

fn chain(mechanism: &Value) -> Option<Chain> {
    let joints = mechanism["joints"].as_array()?;
    let kind = |joint: &Value| JointKind::from_letter(joint["type"].as_str()?);
    let table = || -> Option<Vec<Joint>> {
        let row = |joint: &Value| {
            Some(Joint {
                kind: kind(joint)?,
                a: number(&joint["a"])?,
                alpha: angle(&joint["alpha"])?,
                d: number(&joint["d"])?,
                theta0: angle(&joint["theta0"])?,
                pitch: number(&joint["pitch"]),
            })
        };
        joints.iter().map(row).collect()
    };
    let geometry = match mechanism["convention"].as_str()? {
        "dh" => Geometry::Dh(table()?),
        "modified-dh" => Geometry::ModifiedDh(table()?),
        "screws" => {
            let row = |joint: &Value| {
                Some(ScrewJoint {
                    kind: kind(joint)?,
                    axis: three(&joint["axis"], number)?,
                    point: three(&joint["point"], number)?,
                    pitch: number(&joint["pitch"]),
                })
            };
            let joints: Option<Vec<ScrewJoint>> = joints.iter().map(row).collect();
            let joints = joints?;
            // A direction without length has no frame.
            let has_axis = |joint: &ScrewJoint| joint.axis.iter().any(|x| x.to_f64() != 0.0);
            if !joints.iter().all(has_axis) {
                return None;
            }
            Geometry::Screws { joints, home: Box::new(placement(&mechanism["home"])?) }
        }
        _ => return None,
    };
    Some(Chain { geometry, base: placement(&mechanism["base"])?, tool: placement(&mechanism["tool"])? })
}

fn platform(mechanism: &Value) -> Option<Platform<Number>> {
    let points = |key: &str| -> Option<[[Number; 3]; 6]> {
        let list: Option<Vec<[Number; 3]>> = mechanism[key].as_array()?.iter().map(|p| three(p, number)).collect();
        list?.try_into().ok()
    };
    Some(Platform { base: points("base")?, plate: points("plate")? })
}

/// Vertices, bars, and what holds the bodies together.
fn framework(mechanism: &Value) -> Option<Stage> {
    let names: Option<Vec<String>> =
        mechanism["names"].as_array()?.iter().map(|name| name.as_str().map(str::to_owned)).collect();
    let vertices: Option<Vec<Point>> = mechanism["vertices"].as_array()?.iter().map(|v| three(v, real)).collect();
    let index = |value: &Value| usize::try_from(value.as_u64()?).ok();
    let ends = |bar: &Value| Some([index(&bar["ends"][0])?, index(&bar["ends"][1])?]);
    let mut bars: Vec<[usize; 2]> = mechanism["bars"].as_array()?.iter().map(ends).collect::<Option<_>>()?;
    for body in mechanism["bodies"].as_array().into_iter().flatten() {
        let members: Vec<usize> = body.as_array()?.iter().map(index).collect::<Option<_>>()?;
        bars.extend(members.iter().enumerate().flat_map(|(k, a)| members[..k].iter().map(move |b| [*b, *a])));
    }
    Some(Stage::of_framework(&names?, &vertices?, &bars))
}
