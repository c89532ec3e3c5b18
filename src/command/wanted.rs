//! Which case a verb is about.

use super::arguments::CaseOptions;
use looproot::algebra::number::{Angle, Number, Quantity, Reading};
use looproot::catalogue::entry::{Case, Design, Entry, Input, InputValue, Kind};
use looproot::error::Error;
use looproot::kinematics::chain::{Chain, JointKind, Placement};
use looproot::kinematics::closed_loop::{Layout, Variable, angle_motion, distance_motion};
use looproot::kinematics::freedom::Freedom;
use looproot::kinematics::platform::Platform;
use looproot::report::model::case_noun;
use std::ops::Range;

/// The cases asked for. A case given on the command line takes the place of those of the file; its numbers follow the units
/// of the file.
pub fn wanted(options: &CaseOptions, mechanism: &str, entry: &mut Entry) -> Result<Range<usize>, Error> {
    refuse(options, entry.kind())?;
    let reading = &entry.reading;
    let (own, number) = match &entry.design {
        Design::Arm(chain) => (options.joints.as_ref().map(|joints| reached(chain, joints, reading)), options.pose),
        Design::Loop(chain) => match options.input.as_ref().map(|input| (input, input.split_once('='))) {
            Some((_, Some((joint, value)))) => (Some(given(chain, joint, value, reading)), None),
            Some((input, None)) => (None, Some(number_of(input)?)),
            None => (None, None),
        },
        Design::Platform(platform) => match (&options.legs, &options.at) {
            (Some(legs), _) => (Some(of_lengths(legs, reading)), None),
            (None, Some(pose)) => (Some(placed(platform, pose, reading)), None),
            (None, None) => (None, options.pose),
        },
    };
    if let Some(case) = own {
        entry.cases = vec![case?];
    }
    let count = entry.cases.len();
    match number {
        None if count == 0 => {
            // Tables and robot descriptions are arms without poses; other files have a case.
            let hint = "expected a [[pose]], or --joints with joint values that reach one";
            Err(Error::Invalid(format!("{mechanism}: found nothing to solve, {hint}")))
        }
        None => Ok(0..count),
        Some(number) if (1..=count).contains(&number) => Ok(number - 1..number),
        Some(number) => Err(Error::Invalid(format!("found {} {number}, expected 1 to {count}", case_noun(entry)))),
    }
}

/// The same complaint with its place in the file, and with the mobility of the loop where the message does not name it.
pub fn in_place(error: Error, mechanism: &str, entry: &Entry) -> Error {
    let error = match (error, &entry.design) {
        (Error::Unsupported(message), Design::Loop(chain)) => {
            Error::UnsupportedMobility(format!("{message}; the loop has {}", Freedom::of(chain)))
        }
        (error, _) => error,
    };
    if error.unsupported().is_none() {
        return error;
    }
    error.at(mechanism, entry.cases.first().map_or(1, |case| case.line.max(1)))
}

/// Refuses what is no option for this kind of mechanism.
fn refuse(options: &CaseOptions, kind: Kind) -> Result<(), Error> {
    let given = [
        ("--pose", options.pose.is_some()),
        ("--input", options.input.is_some()),
        ("--joints", options.joints.is_some()),
        ("--legs", options.legs.is_some()),
        ("--at", options.at.is_some()),
    ];
    let (what, fitting): (&str, &[&str]) = match kind {
        Kind::Arm => ("an arm", &["--pose", "--joints"]),
        Kind::Loop => ("a loop", &["--input"]),
        Kind::Platform => ("a platform", &["--pose", "--legs", "--at"]),
    };
    match given.iter().find(|(name, is_given)| *is_given && !fitting.contains(name)) {
        Some((name, _)) => Err(Error::Invalid(format!("found {name} for {what}, expected {}", fitting.join(" or ")))),
        None => Ok(()),
    }
}

fn number_of(input: &str) -> Result<usize, Error> {
    let message = || Error::Invalid(format!("found --input {input}, expected a number from 1 or JOINT=VALUE"));
    input.trim().parse().map_err(|_| message())
}

/// A case that locks a joint at a value of the command line.
fn given(chain: &Chain, joint: &str, value: &str, reading: &Reading) -> Result<Case, Error> {
    let joint: usize = joint.trim().trim_start_matches('q').parse().map_err(|_| {
        Error::Invalid(format!("found --input {joint}={value}, expected the number of a joint before `=`"))
    })?;
    let kinds = chain.joint_kinds();
    let is_length = match joint.checked_sub(1).and_then(|index| kinds.get(index)) {
        Some(JointKind::Revolute | JointKind::Cylindrical | JointKind::Helical) => false,
        Some(JointKind::Prismatic) => true,
        kind @ (None | Some(JointKind::Universal | JointKind::Spherical)) => {
            let count = kinds.len();
            let expected =
                if kind.is_some() { "a joint R, P or C".to_owned() } else { format!("one from 1 to {count}") };
            return Err(Error::Invalid(format!(
                "found joint {joint} in --input, expected {expected}: the loop has {}",
                Freedom::of(chain)
            )));
        }
    };
    let value = if is_length {
        InputValue::Distance(Number::parse(value, Quantity::Length, reading)?)
    } else {
        InputValue::Angle(Angle::parse(value, reading)?)
    };
    Ok(Case::given(Input { joint, value }, 1))
}

/// A case that asks for the pose which these joint values reach.
fn reached(chain: &Chain, joints: &str, reading: &Reading) -> Result<Case, Error> {
    let variables = Layout::of(chain, None)?.variables;
    let texts: Vec<&str> = joints.split(',').map(str::trim).collect();
    if texts.len() != variables.len() {
        let (found, expected) = (texts.len(), variables.len());
        return Err(Error::Invalid(format!(
            "found {found} values in --joints, expected {expected}, separated by commas"
        )));
    }
    let mut motions = Vec::new();
    for (text, variable) in texts.into_iter().zip(variables) {
        let motion = match variable {
            Variable::Rotation => angle_motion(&Angle::parse(text, reading)?),
            Variable::Translation => distance_motion(&Number::parse(text, Quantity::Length, reading)?),
        };
        motions.extend(motion);
    }
    let pose = chain.forward(&motions).map(Placement::from_motion_exact);
    let pose = pose.ok_or_else(|| Error::Invalid("the joints of --joints reach no pose".to_owned()))?;
    Ok(Case::at(pose, 1))
}

/// So many numbers, separated by commas.
fn numbers<const N: usize>(
    text: &str,
    quantity: Quantity,
    option: &str,
    reading: &Reading,
) -> Result<[Number; N], Error> {
    let numbers: Vec<Number> =
        text.split(',').map(|part| Number::parse(part.trim(), quantity, reading)).collect::<Result<_, _>>()?;
    numbers.try_into().map_err(|numbers: Vec<_>| {
        let found = numbers.len();
        Error::Invalid(format!("found {found} values in {option}, expected {N}, separated by commas"))
    })
}

/// A case with legs of these lengths.
fn of_lengths(text: &str, reading: &Reading) -> Result<Case, Error> {
    let lengths: [Number; 6] = numbers(text, Quantity::Length, "--legs", reading)?;
    if let Some(leg) = lengths.iter().position(|length| *length.rational() < 0) {
        let (number, length) = (leg + 1, lengths[leg].to_f64());
        return Err(Error::Invalid(format!("found the negative length {length} of leg {number}, expected 0 or more")));
    }
    Ok(Case::legs(lengths.map(|length| length.squared()), 1))
}

/// A case with the legs that this pose of the plate asks for.
fn placed(platform: &Platform<Number>, text: &str, reading: &Reading) -> Result<Case, Error> {
    let Some((position, quaternion)) = text.split_once(';') else {
        return Err(Error::Invalid(format!("found --at \"{text}\", expected \"x, y, z; w, x, y, z\"")));
    };
    let position: [Number; 3] = numbers(position, Quantity::Length, "the position of --at", reading)?;
    let quaternion: [Number; 4] = numbers(quaternion, Quantity::Ratio, "the quaternion of --at", reading)?;
    let (pose, warning) = Placement::from_quaternion_position(&quaternion, &position)?;
    let mut case = Case::legs_at(platform, pose, 1);
    case.warnings.extend(warning);
    Ok(case)
}
