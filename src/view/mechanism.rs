//! The stage of a mechanism as `show --json` prints it: saved results are drawn without their file.

use crate::algebra::number::{Angle, Number};
use crate::catalogue::entry::Design;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use crate::kinematics::platform::Platform;
use crate::scene::linkage::{Figure, Hinge, Outline, planar_frame, spherical_frame};
use crate::scene::space::{Bond, SpaceFigure, SpaceHinge};
use crate::scene::{Point, Stage};
use serde_json::Value;

/// The stage of a document's mechanism; `None` where it is of another form, or not drawn.
pub(super) fn stage(document: &Value) -> Option<Stage> {
    let mechanism = &document["mechanism"];
    let links = document["base_link"].as_str().zip(document["tip_link"].as_str());
    let links = links.map(|(base, tip)| [base.to_owned(), tip.to_owned()]);
    match mechanism["kind"].as_str()? {
        "framework" => framework(mechanism),
        "linkage" if mechanism["space"] == "space" => Stage::of_space(&in_space(document)?),
        "linkage" => Stage::of_linkage(&linkage(document)?),
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

fn pair(value: &Value) -> Option<[f64; 2]> {
    value.as_array()?.iter().map(real).collect::<Option<Vec<f64>>>()?.try_into().ok()
}

/// The bodies and joints of a linkage, in the plane or on the sphere.
fn linkage(document: &Value) -> Option<Figure> {
    let mechanism = &document["mechanism"];
    let on_sphere = mechanism["space"] == "sphere";
    let fields = mechanism["bodies"].as_object()?;
    let direction = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let point = |value: &Value| -> Option<Point> {
        if on_sphere { three(value, real).map(direction) } else { pair(value).map(|[x, y]| [x, y, 0.0]) }
    };
    let body = |name: &str| fields.keys().position(|own| own == name);
    let outline = |(name, points): (&String, &Value)| {
        let points = points.as_object()?.values().map(point).collect::<Option<_>>()?;
        Some(Outline { name: name.clone(), points })
    };
    let mut bodies: Vec<Outline> = fields.iter().map(outline).collect::<Option<_>>()?;
    let mut joints = Vec::new();
    for (number, joint) in (1..).zip(mechanism["joints"].as_array()?) {
        // Gears have no value, and bodies do not hang on them.
        let Some(kind) = JointKind::from_letter(joint["type"].as_str()?) else { continue };
        let name = |side: usize| body(joint["of"][side].as_str()?);
        let of = [name(0)?, name(1)?];
        let frame = |side: usize| {
            let at = &joint["at"][side];
            if on_sphere {
                spherical_frame(&three(at, real)?, &three(&joint["zero"][side], real)?)
            } else {
                Some(planar_frame(
                    pair(at)?,
                    if joint["along"].is_null() { None } else { Some(pair(&joint["along"][side])?) },
                ))
            }
        };
        for side in 0..2 {
            bodies[of[side]].points.push(point(&joint["at"][side])?);
        }
        let frames = [frame(0)?, frame(1)?];
        joints.push(Hinge { name: joint["name"].as_str()?.to_owned(), number, kind, of, frames });
    }
    let trace = |name: &String| {
        let (of, at) = name.split_once('.')?;
        Some((name.clone(), body(of)?, point(&fields[of][at])?))
    };
    let traces = traced(document).iter().filter_map(trace).collect();
    Some(Figure { bodies, joints, ground: body(mechanism["ground"].as_str()?)?, on_sphere, traces })
}

/// The names of the points whose paths are drawn: of that which a sweep followed, or of those of the file.
fn traced(document: &Value) -> Vec<String> {
    if let Some(asked) = document["branches"][0]["rows"][0]["points"].as_object() {
        return asked.keys().cloned().collect();
    }
    let named = document["mechanism"]["traces"].as_array().map_or(&[][..], Vec::as_slice);
    named.iter().filter_map(|name| name.as_str().map(str::to_owned)).collect()
}

/// The bodies and joints of a linkage in space.
fn in_space(document: &Value) -> Option<SpaceFigure> {
    let mechanism = &document["mechanism"];
    let fields = mechanism["bodies"].as_object()?;
    let body = |name: &Value| fields.keys().position(|own| Some(own.as_str()) == name.as_str());
    let outline = |(name, points): (&String, &Value)| {
        let points = points.as_object()?.values().map(|point| three(point, real)).collect::<Option<_>>()?;
        Some(Outline { name: name.clone(), points })
    };
    let mut bodies: Vec<Outline> = fields.iter().map(outline).collect::<Option<_>>()?;
    let mut joints = Vec::new();
    for (number, joint) in (1..).zip(mechanism["joints"].as_array()?) {
        let both = |key: &str| Some([three(&joint[key][0], real)?, three(&joint[key][1], real)?]);
        let of = [body(&joint["of"][0])?, body(&joint["of"][1])?];
        let at = both("at")?;
        let bond = match joint["type"].as_str()? {
            "SS" | "SPS" | "UPU" => Bond::Rod,
            "parallelogram" => Bond::Parallelogram(both("axis")?),
            letter => {
                let axes = if joint["axis"].is_null() { both("axes") } else { both("axis") };
                // A spherical joint has no axis, and looks the same from everywhere.
                Bond::Joint(JointKind::from_letter(letter)?, axes.unwrap_or([[0.0, 0.0, 1.0]; 2]))
            }
        };
        for side in 0..2 {
            bodies[of[side]].points.push(at[side]);
        }
        joints.push(SpaceHinge { name: joint["name"].as_str()?.to_owned(), number, of, at, bond });
    }
    let trace = |name: &String| {
        let (of, at) = name.split_once('.')?;
        Some((name.clone(), body(&Value::from(of))?, three(&fields[of][at], real)?))
    };
    let traces = traced(document).iter().filter_map(trace).collect();
    Some(SpaceFigure { bodies, joints, ground: body(&mechanism["ground"])?, traces })
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
