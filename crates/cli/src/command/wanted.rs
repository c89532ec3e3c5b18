//! The case to which a verb applies.

use super::arguments::CaseOptions;
use looproot::internal::catalogue::entry::{Case, Design, Entry, Input, InputValue, Kind};
use looproot::internal::catalogue::poses::typed_pose;
use looproot::internal::error::Error;
use looproot::internal::kinematics::chain::{Chain, JointKind};
use looproot::internal::kinematics::closed_loop::{Layout, Variable};
use looproot::internal::kinematics::freedom::Freedom;
use looproot::internal::kinematics::tolerance::Tolerance;
use looproot::internal::report::document;
use looproot::internal::report::model::case_noun;
use looproot::internal::report::number::counted;
use looproot::internal::report::text::reading;
use looproot_algebra::number::{Angle, Number, Quantity, Reading};
use std::ops::Range;

/// Returns the requested cases. A case given on the command line replaces those of the file; its numbers have the units
/// of the file.
pub fn wanted(options: &CaseOptions, mechanism: &str, entry: &mut Entry) -> Result<Range<usize>, Error> {
    refuse(options, entry.kind())?;
    let reading = &entry.reading;
    let (own, number) = match &entry.design {
        Design::Arm(chain) => {
            let joints = options
                .joints
                .as_ref()
                .map(|joints| reached(chain, joints, reading).map_err(|fault| fault.of_option("--joints")));
            let at = options.at.as_ref().map(|pose| typed_pose(pose, "--at", &entry.design, reading));
            (joints.or(at), options.pose)
        }
        Design::Loop(chain) => match options.input.as_ref().map(|input| (input, input.split_once('='))) {
            Some((_, Some((joint, value)))) => {
                (Some(given(chain, joint, value, reading).map_err(|fault| fault.of_option("--input"))), None)
            }
            Some((input, None)) => (None, Some(number_of(input)?)),
            None => (None, None),
        },
        Design::Platform(_) => match (&options.legs, &options.at) {
            (Some(legs), _) => (Some(of_lengths(legs, reading).map_err(|fault| fault.of_option("--legs"))), None),
            (None, Some(pose)) => (Some(typed_pose(pose, "--at", &entry.design, reading)), None),
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
            Err(Error::Invalid(nothing_to_solve(mechanism, entry)))
        }
        None => Ok(0..count),
        Some(number) if (1..=count).contains(&number) => Ok(number - 1..number),
        Some(number) => Err(Error::Invalid(format!("found {} {number}, expected 1 to {count}", case_noun(entry)))),
    }
}

/// Returns a message that says what to type if a mechanism has no pose.
fn nothing_to_solve(mechanism: &str, entry: &Entry) -> String {
    let labels = document::labels(entry);
    let zeros = vec!["0"; labels.len()].join(",");
    let mut text = format!("{mechanism}: found nothing to solve, expected a pose; type next one of");
    let [length, angle] = entry.reading.units();
    text += &format!(
        "\n  looproot solve {mechanism} --at \"X,Y,Z; QW,QX,QY,QZ\"   the pose of the tool, {length}, quaternion"
    );
    text += &format!(
        "\n  looproot solve {mechanism} --joints \"{zeros}\"   the pose of these joints, {angle}: {}",
        labels.join(", ")
    );
    text += &format!("\n  looproot solve {mechanism} --poses poses.csv   many, with the header x,y,z,qw,qx,qy,qz");
    for remark in reading(entry) {
        text += &format!("\nnote: {remark}");
    }
    text
}

/// Adds to an error its place in the file, and the mobility of the loop if the message does not state it.
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

/// Refuses options that do not apply to this kind of mechanism.
fn refuse(options: &CaseOptions, kind: Kind) -> Result<(), Error> {
    let given = [
        ("--pose", options.pose.is_some()),
        ("--input", options.input.is_some()),
        ("--joints", options.joints.is_some()),
        ("--legs", options.legs.is_some()),
        ("--at", options.at.is_some()),
    ];
    let (what, fitting): (&str, &[&str]) = match kind {
        Kind::Arm => ("an arm", &["--pose", "--joints", "--at"]),
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

/// Returns a case that locks a joint at a value of the command line.
fn given(chain: &Chain, joint: &str, value: &str, reading: &Reading) -> Result<Case, Error> {
    let joint: usize = joint.trim().trim_start_matches('q').parse().map_err(|_| {
        Error::Invalid(format!("found --input {joint}={value}, expected the number of a joint before `=`"))
    })?;
    let kinds = chain.joint_kinds();
    let kind = joint.checked_sub(1).and_then(|index| kinds.get(index));
    let Some(kind) = kind.filter(|kind| kind.has_one_axis()) else {
        let plain = || format!("a joint {}", JointKind::letters(JointKind::is_plain, "or"));
        let expected = kind.map_or_else(|| format!("one from 1 to {}", kinds.len()), |_| plain());
        return Err(Error::Invalid(format!(
            "found joint {joint} in --input, expected {expected}: the loop has {}",
            Freedom::of(chain)
        )));
    };
    let is_length = kind.only_translates();
    let value = if is_length {
        InputValue::Distance(Number::parse(value, Quantity::Length, reading)?)
    } else {
        InputValue::Angle(Angle::parse(value, reading)?)
    };
    Ok(Case::given(Input { joint, value }, 1))
}

/// Returns a case with the pose that these joint values reach.
fn reached(chain: &Chain, joints: &str, reading: &Reading) -> Result<Case, Error> {
    let variables = Layout::of(chain, None)?.variables;
    let texts: Vec<&str> = joints.split(',').map(str::trim).collect();
    if texts.len() != variables.len() {
        let (found, expected) = (texts.len(), variables.len());
        return Err(Error::Invalid(format!(
            "found {} in --joints, expected {expected}, separated by commas",
            counted(found, "value")
        )));
    }
    let mut values = Vec::new();
    for (text, variable) in texts.into_iter().zip(variables) {
        values.push(match variable {
            Variable::Rotation => InputValue::Angle(Angle::parse(text, reading)?),
            Variable::Translation => InputValue::Distance(Number::parse(text, Quantity::Length, reading)?),
        });
    }
    Case::reached(chain, &values, 1).ok_or_else(|| Error::Invalid("the joints of --joints reach no pose".to_owned()))
}

/// Reads the value of `--tolerance`.
pub fn tolerance(text: Option<&str>, entry: &Entry) -> Result<Option<Tolerance>, Error> {
    let Some(text) = text else { return Ok(None) };
    if entry.kind() != Kind::Arm {
        let message = "found --tolerance for a mechanism without a pose of its tool, expected an arm";
        return Err(Error::Invalid(message.to_owned()));
    }
    Tolerance::parse(text, &entry.reading).map(Some).map_err(|fault| fault.of_option("--tolerance"))
}

/// Reads N numbers, separated by commas.
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
        Error::Invalid(format!("found {} in {option}, expected {N}, separated by commas", counted(found, "value")))
    })
}

/// Returns a case with legs of these lengths.
fn of_lengths(text: &str, reading: &Reading) -> Result<Case, Error> {
    let lengths: [Number; 6] = numbers(text, Quantity::Length, "--legs", reading)?;
    if let Some(leg) = lengths.iter().position(|length| *length.rational() < 0) {
        let (number, length) = (leg + 1, lengths[leg].to_f64());
        return Err(Error::Invalid(format!("found the negative length {length} of leg {number}, expected 0 or more")));
    }
    Ok(Case::legs(lengths.map(|length| length.squared()), 1))
}
