//! Tables of poses, one per row, read row by row.

use super::entry::{Case, Design};
use super::job;
use super::node;
use super::scope::Scope;
use super::turn::turn;
use crate::algebra::number::{Number, Quantity, Reading};
use crate::error::{Error, Result};
use crate::kinematics::chain::Placement;
use crate::kinematics::decimal::{Decimal, Plain};
use crate::kinematics::tolerance::Tolerance;
use rug::Rational;

/// The admissible headers.
const EXPECTED: &str = "expected the header `x,y,z,qw,qx,qy,qz`, `x,y,z,roll,pitch,yaw` or `m00,m01,...,m23`, with units as in `x_mm` or \
                        `roll_deg`";
const QUATERNION: [&str; 7] = ["x", "y", "z", "qw", "qx", "qy", "qz"];
const ANGLES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
const MATRIX: [&str; 12] = ["m00", "m01", "m02", "m03", "m10", "m11", "m12", "m13", "m20", "m21", "m22", "m23"];
/// Upper bound on the tolerance of a pose: one typed with fewer digits is not meant to be that inaccurate.
const COARSEST: f64 = 1e-3;
/// Tolerance of the angle in units of the last digit of a quaternion, whose angle is half as large.
const OF_QUATERNION: f64 = 2.0;

/// The form of a pose in the rows of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Quaternion,
    Angles,
    Matrix,
    /// Each row is a JSON object as under `[[pose]]`.
    Objects,
}

impl Form {
    /// Returns whether the value in this place is a length.
    fn is_length(self, place: usize) -> bool {
        if self == Self::Matrix { place % 4 == 3 } else { place < 3 }
    }
}

/// The reader of the rows of a table.
pub struct PoseRows<'a> {
    path: &'a str,
    design: &'a Design,
    reading: Reading,
    form: Form,
    /// The index of every column among the names of the form, and the unit of its numbers.
    columns: Vec<(usize, String)>,
    /// The power of ten of the unit of each length column, in metres, if all have one.
    powers: Option<Vec<i32>>,
    /// Whether the numbers were doubles before they were decimals: their digits do not say how well they are known.
    are_doubles: bool,
    /// Of rows that are objects, the readers of their numbers: of a matrix and of a quaternion.
    plain: Option<Box<[Self; 2]>>,
}

impl<'a> PoseRows<'a> {
    /// Creates the reader of a table from its first nonempty line. The second value tells whether that line is a row itself, not
    /// a header.
    ///
    /// # Errors
    /// For an invalid header.
    pub fn of(first: &str, line: usize, path: &'a str, design: &'a Design, reading: &Reading) -> Result<(Self, bool)> {
        let reading = reading.clone();
        let first = first.trim_start_matches('\u{feff}').trim();
        if first.starts_with('{') {
            let of = |names: &[&str]| Self::of(&names.join(","), line, path, design, &reading).map(|(own, _)| own);
            let plain = Some(Box::new([of(&MATRIX)?, of(&QUATERNION)?]));
            let (columns, powers) = (Vec::new(), None);
            let own = Self { path, design, reading, form: Form::Objects, columns, powers, are_doubles: false, plain };
            return Ok((own, true));
        }
        let names: Vec<&str> = first.split(',').map(|name| name.trim().trim_matches('"')).collect();
        for (form, own) in
            [(Form::Quaternion, &QUATERNION[..]), (Form::Angles, &ANGLES[..]), (Form::Matrix, &MATRIX[..])]
        {
            let columns: Option<Vec<(usize, String)>> = names.iter().map(|name| column(name, own)).collect();
            let Some(columns) = columns.filter(|columns| columns.len() == own.len()) else { continue };
            if (0..own.len()).all(|k| columns.iter().any(|(place, _)| *place == k)) {
                let powers = columns.iter().map(|(place, unit)| power(form, *place, unit, &reading)).collect();
                let own = Self { path, design, reading, form, columns, powers, are_doubles: false, plain: None };
                return Ok((own, false));
            }
        }
        let found: String = first.chars().take(60).collect();
        Err(Error::Invalid(format!("found the header `{found}`, {EXPECTED}")).at(path, line))
    }

    /// Returns the same reader for rows whose numbers are doubles.
    #[must_use]
    pub fn of_doubles(self) -> Self {
        Self { are_doubles: true, ..self }
    }

    /// Returns the pose of a row.
    ///
    /// # Errors
    /// [`Error::File`] with the line if it is no pose.
    pub fn case(&self, text: &str, line: usize) -> Result<Case> {
        if self.form == Form::Objects {
            return self.object(text, line);
        }
        let cells: Vec<&str> = text.split(',').map(|cell| cell.trim().trim_matches('"')).collect();
        if cells.len() != self.columns.len() {
            let (found, expected) = (cells.len(), self.columns.len());
            let message = format!("found {found} values, expected {expected}");
            return Err(Error::Invalid(message).at(self.path, line));
        }
        if let Some(case) = self.of_decimals(&cells, line) {
            return Ok(case);
        }
        let mut values = vec![String::new(); cells.len()];
        for ((place, unit), cell) in self.columns.iter().zip(&cells) {
            values[*place] = if unit.is_empty() { (*cell).to_owned() } else { format!("{cell} {unit}") };
        }
        let (placement, warning) = self.placement(&values).map_err(|fault| fault.at(self.path, line))?;
        let mut case = of_design(self.design, placement, line);
        case.warnings.extend(warning);
        if !self.are_doubles {
            self.typed(&values).of(&mut case);
        }
        Ok(case)
    }

    /// Returns the pose of a row of doubles, in the order of the header, lengths in metres.
    ///
    /// # Errors
    /// As [`PoseRows::case`].
    pub fn case_of_doubles(&self, row: &[f64], line: usize) -> Result<Case> {
        let mut values = [Plain::Double(0.0); 12];
        let own = row.iter().map(|x| Plain::of_double(*x));
        let is_plain = values.iter_mut().zip(own).all(|(value, own)| own.map(|own| *value = own).is_some());
        if let Some((placement, warning)) = is_plain.then(|| self.of_plain(&values)).flatten() {
            let mut case = of_design(self.design, placement, line);
            case.warnings.extend(warning);
            return Ok(case);
        }
        // The shortest decimals that are these doubles.
        let cells: Vec<String> = row.iter().map(|x| format!("{x:e}")).collect();
        self.case(&cells.join(","), line)
    }

    /// The pose of plain numbers in the order of the form, and its warning. `None` where exact numbers have to tell.
    fn of_plain(&self, values: &[Plain; 12]) -> Option<(Placement, Option<String>)> {
        match self.form {
            Form::Quaternion => {
                let [x, y, z, quaternion @ ..] = values.first_chunk::<7>()?;
                Placement::of_rounded_quaternion(quaternion, &[*x, *y, *z])
            }
            Form::Matrix => {
                let row = |i: usize| [values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]];
                Some((Placement::of_rounded_matrix(&[row(0), row(1), row(2)])?, None))
            }
            Form::Angles | Form::Objects => None,
        }
    }

    /// Reads a pose in plain decimals, which need no exact numbers. `None` where these have to tell, or to say what is wrong.
    fn of_decimals(&self, cells: &[&str], line: usize) -> Option<Case> {
        let mut values = [Decimal::default(); 12];
        for (((place, _), power), cell) in self.columns.iter().zip(self.powers.as_ref()?).zip(cells) {
            values[*place] = Decimal::read(cell)?.shifted(*power);
        }
        let (placement, warning) = self.of_plain(&values.map(Plain::Typed))?;
        let least = |lengths: bool| {
            let own = (0..cells.len()).filter(|k| self.form.is_length(*k) == lengths);
            own.map(|k| values[k].last_digit()).fold(COARSEST, f64::min)
        };
        let texts = |lengths: bool| {
            let own =
                self.columns.iter().zip(cells).filter(move |((place, _), _)| self.form.is_length(*place) == lengths);
            own.map(|(_, cell)| *cell)
        };
        let mut case = of_design(self.design, placement, line);
        case.warnings.extend(warning);
        if !self.are_doubles {
            let units = [least(true), least(false)];
            let rounding = [rounding(units[0], texts(true)), rounding(units[1], texts(false))];
            Typed::new(units, rounding, self.form == Form::Quaternion).of(&mut case);
        }
        Some(case)
    }

    /// Reads an object that holds nothing but a pose in plain decimals, without a tree of its values.
    fn plain_object(&self, text: &str, line: usize) -> Option<Case> {
        let [matrix, quaternion] = self.plain.as_deref()?;
        if let Some(cells) = matrix_cells(text) {
            return matrix.of_decimals(&cells, line);
        }
        quaternion.of_decimals(&quaternion_cells(text)?, line)
    }

    fn object(&self, text: &str, line: usize) -> Result<Case> {
        if let Some(case) = self.plain_object(text, line) {
            return Ok(case);
        }
        // The reader counts lines from the beginning of the row.
        let there = |fault: Error| match fault {
            Error::File { path, message, line: own } => Error::File { path, message, line: line + own - 1 },
            other => other,
        };
        let scope = Scope::new(self.path, self.reading.clone());
        let node = node::from_json(text, self.path).map_err(there)?;
        let case = job::pose(&scope, &node, self.design).map_err(there)?;
        Ok(Case { line, ..case })
    }

    fn placement(&self, values: &[String]) -> Result<(Placement, Option<String>)> {
        let length = |k: usize| Number::parse(&values[k], Quantity::Length, &self.reading);
        let ratio = |k: usize| Number::parse(&values[k], Quantity::Ratio, &self.reading);
        let position = || -> Result<[Number; 3]> { Ok([length(0)?, length(1)?, length(2)?]) };
        match self.form {
            Form::Quaternion => {
                let quaternion = [ratio(3)?, ratio(4)?, ratio(5)?, ratio(6)?];
                Placement::from_quaternion_position(&quaternion, &position()?)
            }
            Form::Angles => {
                let angle = |k: usize| turn(&values[k], &self.reading);
                Ok((Placement::from_angles(&[angle(3)?, angle(4)?, angle(5)?], &position()?)?, None))
            }
            Form::Matrix | Form::Objects => {
                let mut rows: [[Number; 4]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| Number::zero()));
                for (k, entry) in rows.iter_mut().flatten().take(12).enumerate() {
                    *entry = if k % 4 == 3 { length(k)? } else { ratio(k)? };
                }
                rows[3][3] = Number::exact(1.into());
                Placement::from_matrix(&rows)
            }
        }
    }

    /// Returns how exactly these values are typed.
    fn typed(&self, values: &[String]) -> Typed {
        let texts = |lengths: bool| -> Vec<&str> {
            let own = values.iter().enumerate().filter(|(k, _)| self.form.is_length(*k) == lengths);
            own.map(|(_, value)| value.as_str()).collect()
        };
        let of_angles = if self.form == Form::Angles { Of::Angles } else { Of::Rotation };
        typed(&texts(true), &texts(false), of_angles, &self.reading, self.form == Form::Quaternion)
    }
}

/// The characters between the tokens of an object.
const BLANKS: [char; 4] = [' ', '\t', '\r', '\n'];

/// Returns the text behind these tokens; `None` where others stand there.
fn behind<'t>(mut text: &'t str, tokens: &[&str]) -> Option<&'t str> {
    for token in tokens {
        text = text.trim_start_matches(BLANKS).strip_prefix(token)?;
    }
    Some(text)
}

/// Returns the numbers of a list of `N`, and the text behind it. Numbers of JSON have no zeros before other digits.
fn numbers<const N: usize>(text: &str) -> Option<([&str; N], &str)> {
    let (inner, rest) = behind(text, &["["])?.split_once(']')?;
    let mut own = [""; N];
    let mut cells = inner.split(',');
    for cell in &mut own {
        *cell = cells.next()?.trim_matches(BLANKS);
        let digits = cell.trim_start_matches('-').as_bytes();
        if digits.first() == Some(&b'0') && digits.get(1).is_some_and(u8::is_ascii_digit) {
            return None;
        }
    }
    cells.next().is_none().then_some((own, rest))
}

/// Returns the first three rows of `{"matrix": [...]}`, the last one of which is 0, 0, 0, 1.
fn matrix_cells(text: &str) -> Option<[&str; 12]> {
    let mut text = behind(text, &["{", "\"matrix\"", ":", "["])?;
    let mut cells = [""; 12];
    for row in cells.chunks_exact_mut(4) {
        let (own, rest) = numbers::<4>(text)?;
        row.copy_from_slice(&own);
        text = behind(rest, &[","])?;
    }
    let (last, rest) = numbers::<4>(text)?;
    let is_last =
        last.iter().zip(["0", "0", "0", "1"]).all(|(cell, own)| cell.strip_suffix(".0").unwrap_or(cell) == own);
    (is_last && behind(rest, &["]", "}"])?.trim_matches(BLANKS).is_empty()).then_some(cells)
}

/// Returns the numbers of `{"position": [...], "quaternion": [...]}`, in either order, as in [`QUATERNION`].
fn quaternion_cells(text: &str) -> Option<[&str; 7]> {
    let text = behind(text, &["{"])?;
    let position = |text| numbers::<3>(behind(text, &["\"position\"", ":"])?);
    let quaternion = |text| numbers::<4>(behind(text, &["\"quaternion\"", ":"])?);
    let ([x, y, z], [w, i, j, k], rest) = if let Some((first, rest)) = position(text) {
        let (second, rest) = quaternion(behind(rest, &[","])?)?;
        (first, second, rest)
    } else {
        let (first, rest) = quaternion(text)?;
        let (second, rest) = position(behind(rest, &[","])?)?;
        (second, first, rest)
    };
    behind(rest, &["}"])?.trim_matches(BLANKS).is_empty().then_some([x, y, z, w, i, j, k])
}

/// The kind of the numbers of an orientation.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// Entries of a matrix or a quaternion.
    Rotation,
    /// Angles with or without unit.
    Angles,
}

/// How exactly a pose is typed.
pub(super) struct Typed {
    /// One unit of the last digit of its lengths and of its orientation.
    pub unit: Tolerance,
    /// The same where they are rounded, 0 where they are not.
    pub rounding: Tolerance,
}

impl Typed {
    /// Takes the units and the roundings of the lengths and of the orientation.
    fn new(units: [f64; 2], rounding: [f64; 2], is_quaternion: bool) -> Self {
        let factor = if is_quaternion { OF_QUATERNION } else { 1.0 };
        let tolerance = |[length, angle]: [f64; 2]| Tolerance { length, angle: angle * factor };
        Self { unit: tolerance(units), rounding: tolerance(rounding) }
    }

    fn of(self, case: &mut Case) {
        (case.typed, case.rounding) = (Some(self.unit), Some(self.rounding));
    }
}

/// Returns how exactly a pose of these lengths and this orientation is typed.
pub(super) fn typed(lengths: &[&str], orientation: &[&str], of: Of, reading: &Reading, is_quaternion: bool) -> Typed {
    let length = |text: &&str| {
        let (digits, unit) = split(text);
        let one = Number::parse(&format!("1 {unit}"), Quantity::Length, reading);
        let scale = if unit.is_empty() { reading.length.to_f64() } else { one.map_or(1.0, |one| one.to_f64()) };
        last_digit(digits) * scale
    };
    let angle = |text: &&str| {
        let (digits, unit) = split(text);
        let in_degrees = unit == "deg" || unit.is_empty() && reading.degrees;
        last_digit(digits) * if of == Of::Angles && in_degrees { 1_f64.to_radians() } else { 1.0 }
    };
    let units =
        [lengths.iter().map(length).fold(COARSEST, f64::min), orientation.iter().map(angle).fold(COARSEST, f64::min)];
    let of_texts = |unit: f64, texts: &[&str]| rounding(unit, texts.iter().map(|text| split(text).0));
    Typed::new(units, [of_texts(units[0], lengths), of_texts(units[1], orientation)], is_quaternion)
}

/// Returns the unit of the last digit of numbers of which one at least is rounded, else 0. What is less than a tolerance is not asked.
fn rounding<'a>(unit: f64, mut texts: impl Iterator<Item = &'a str>) -> f64 {
    if unit <= Tolerance::default().length || texts.any(is_rounded) { unit } else { 0.0 }
}

/// Whether a number is a decimal with digits behind the point. Whole numbers and expressions are meant as they stand; `1.0` is what
/// programs print for a whole number.
fn is_rounded(text: &str) -> bool {
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E'));
    is_plain && text.contains(['.', 'e', 'E']) && !text.ends_with(".0")
}

/// Splits a number and its unit.
fn split(text: &str) -> (&str, &str) {
    let text = text.trim();
    let at = text.find(' ').unwrap_or(text.len());
    (&text[..at], text[at..].trim())
}

/// Returns one unit of the last digit of a decimal; [`COARSEST`] for an expression.
fn last_digit(text: &str) -> f64 {
    super::snap::printed(text).map_or(COARSEST, |(_, unit)| unit)
}

/// Returns the case of a pose.
fn of_design(design: &Design, pose: Placement, line: usize) -> Case {
    match design {
        Design::Platform(platform) => Case::legs_at(platform, pose, line),
        Design::Arm(_) | Design::Loop(_) => Case::at(pose, line),
    }
}

/// Returns the index of a column among these names, and its unit.
fn column(name: &str, names: &[&str]) -> Option<(usize, String)> {
    let (plain, unit) = name.split_once('_').unwrap_or((name, ""));
    let place = names.iter().position(|own| *own == plain)?;
    let is_length = matches!(plain, "x" | "y" | "z" | "m03" | "m13" | "m23");
    let is_angle = matches!(plain, "roll" | "pitch" | "yaw");
    let known = match unit {
        "" => true,
        "m" | "cm" | "mm" => is_length,
        "deg" | "rad" => is_angle,
        _ => false,
    };
    known.then(|| (place, unit.to_owned()))
}

/// Returns the power of ten of the unit of the number in a place; 0 if it is no length.
fn power(form: Form, place: usize, unit: &str, reading: &Reading) -> Option<i32> {
    if !form.is_length(place) {
        return Some(0);
    }
    match unit {
        "m" => Some(0),
        "cm" => Some(-2),
        "mm" => Some(-3),
        _ => [(1, 0), (100, -2), (1000, -3)]
            .into_iter()
            .find_map(|(parts, power)| (reading.length == Rational::from((1, parts))).then_some(power)),
    }
}

/// Reads a pose of the command line, given by this option: `x, y, z; w, x, y, z` or `x, y, z; roll, pitch, yaw`.
///
/// # Errors
/// For anything else.
pub fn typed_pose(text: &str, option: &str, design: &Design, reading: &Reading) -> Result<Case> {
    let fail = |found: &str| {
        Error::Invalid(format!("found {found}, expected \"x, y, z; w, x, y, z\" or \"x, y, z; roll, pitch, yaw\""))
    };
    let Some((position, orientation)) = text.split_once(';') else { return Err(fail(&format!("{option} \"{text}\""))) };
    let values: Vec<String> = position.split(',').chain(orientation.split(',')).map(|v| v.trim().to_owned()).collect();
    let form = match (position.split(',').count(), orientation.split(',').count()) {
        (3, 4) => Form::Quaternion,
        (3, 3) => Form::Angles,
        (lengths, others) => return Err(fail(&format!("{lengths} and {others} values in {option}"))),
    };
    let rows = PoseRows {
        path: "--at",
        design,
        reading: reading.clone(),
        form,
        columns: Vec::new(),
        powers: None,
        are_doubles: false,
        plain: None,
    };
    let (placement, warning) = rows.placement(&values).map_err(|fault| fault.of_option(option))?;
    let mut case = of_design(design, placement, 1);
    case.warnings.extend(warning);
    rows.typed(&values).of(&mut case);
    Ok(case)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{Any, Options, builtin_any};

    #[test]
    fn whole_numbers_and_expressions_are_not_rounded() {
        let Any::Entry(entry) = builtin_any("arm/puma560", &Options::default()).unwrap() else { panic!() };
        let header = "m00,m01,m02,m03_mm,m10,m11,m12,m13_mm,m20,m21,m22,m23_mm";
        let reader = PoseRows::of(header, 1, "rows", &entry.design, &Reading::default()).unwrap().0;
        for (row, length, angle) in [
            ("1,0,0,300,0,1,0,250,0,0,1,100", 0.0, 0.0),
            ("1.0,0.0,0.0,300.0,0.0,1.0,0.0,250,0,0,1,100", 0.0, 0.0),
            ("1,0,0,300.25,0,1,0,250,0,0,1,100", 1e-5, 0.0),
            ("0.6,-0.8,0,300,0.8,0.6,0,1/3,0,0,1,100", 0.0, 1e-3),
            ("1.0000,0,0,300,0,1,0,250,0,0,1,1e2", 1e-3, 1e-4),
        ] {
            let rounding = reader.case(row, 2).unwrap().rounding.unwrap();
            let is_near = |one: f64, other: f64| (one - other).abs() <= 1e-12 * other;
            assert!(is_near(rounding.length, length) && is_near(rounding.angle, angle), "{row}: {rounding:?}");
        }
    }

    #[test]
    fn objects_are_the_poses_of_tables() {
        let Any::Entry(entry) = builtin_any("arm/puma560", &Options::default()).unwrap() else { panic!() };
        let reading = Reading::default();
        let reader = |first: &str| PoseRows::of(first, 1, "rows", &entry.design, &reading).unwrap().0;
        let objects = reader("{");
        let rounded = "0.955336489125606,-0.29552020666134,0,0.3,0.29552020666134,0.955336489125606,0,-0.25,0,0,1,1e-1";
        let matrix = "{ \"matrix\": [[0.955336489125606, -0.29552020666134, 0, 0.3], \
                      [0.29552020666134,0.955336489125606,0,-0.25],[0,0,1,1e-1],[0,0,0,1.0]] }\r\n";
        let turned = "0.1,-0.2,0.3,0.707107,0,0.707107,0";
        let quaternion = "{\"position\":[0.1,-0.2,0.3],\"quaternion\":[0.707107,0,0.707107,0]}";
        let swapped = "{\"quaternion\":[0.707107,0,0.707107,0], \"position\":[0.1,-0.2,0.3]}";
        for (names, row, text) in
            [(&MATRIX[..], rounded, matrix), (&QUATERNION[..], turned, quaternion), (&QUATERNION[..], turned, swapped)]
        {
            let expected = reader(&names.join(",")).case(row, 1).unwrap();
            assert!(objects.plain_object(text, 1).is_some(), "{text}");
            assert_eq!(objects.case(text, 1).unwrap(), expected, "{text}");
        }
        // What is more than numbers, or no JSON, is left to the other reader.
        let expression = quaternion.replace("-0.2", "\"-1/5\"");
        assert!(objects.plain_object(&expression, 1).is_none() && objects.case(&expression, 1).is_ok());
        for (from, to) in [("0.3]", "0.3,]"), ("-0.2", "-00.2"), ("-0.2", "0 2"), ("}", ",\"more\":1}"), ("]}", "]}]")]
        {
            let bad = quaternion.replace(from, to);
            assert!(objects.plain_object(&bad, 1).is_none() && objects.case(&bad, 1).is_err(), "{bad}");
        }
        let other = matrix.replace("[0,0,0,1.0]", "[0,0,1,1]");
        assert!(objects.plain_object(&other, 1).is_none() && objects.case(&other, 1).is_err());
    }
}
