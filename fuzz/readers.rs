//! Every reader of the library, fed with bytes: none may panic, whatever stands there. The fuzz targets and a test call these.

use looproot::internal::catalogue::poses::PoseRows;
use looproot::internal::catalogue::{Format, Options, any_from_text, builtin};
use looproot::internal::certificate::check_all;
use looproot_algebra::number::Reading;
use looproot_algebra::text::{Expression, Names};

fn any(bytes: &[u8], format: Format) {
    let text = String::from_utf8_lossy(bytes);
    let _ = any_from_text(&text, "fuzzed", format, &Options::default());
}

/// A mechanism file of any kind.
pub fn mechanism_toml(bytes: &[u8]) {
    any(bytes, Format::Toml);
}

/// The same in JSON.
pub fn mechanism_json(bytes: &[u8]) {
    any(bytes, Format::Json);
}

/// A table of links.
pub fn dh_table(bytes: &[u8]) {
    any(bytes, Format::Csv);
}

/// A robot description.
pub fn robot_description(bytes: &[u8]) {
    any(bytes, Format::Urdf);
}

/// The rows of `solve --poses`, for an arm of six joints.
pub fn pose_rows(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let Ok(entry) = builtin("puma560", &Options::default()) else { return };
    let mut lines = text.lines().zip(1..);
    let Some((first, line)) = lines.next() else { return };
    let Ok((rows, is_row)) = PoseRows::of(first, line, "fuzzed", &entry.design, &Reading::default()) else { return };
    if is_row {
        let _ = rows.case(first, line);
    }
    for (row, line) in lines {
        let _ = rows.case(row, line);
    }
}

/// Certificates, one a line.
pub fn certificate(bytes: &[u8]) {
    let _ = check_all(&String::from_utf8_lossy(bytes), None, |_, _| ());
}

/// A polynomial, as `poly` reads it.
pub fn polynomial(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let _ = Expression::parse_all(&text, &mut Names::collected());
}
