//! Velocities and accelerations beside the modes they belong to.

use super::json::number;
use super::table::Columns;
use super::text::{View, variables};
use crate::catalogue::entry::{Case, Entry};
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{Derivatives, Solution};
use serde_json::Value;
use std::fmt::Write;

/// Adds `velocity` and `acceleration` to the modes of a result of [`super::json::result`]; null at singular and complex
/// modes. `derivatives` holds one item for every mode of the solution.
pub fn insert(result: &mut Value, solution: &Solution, derivatives: &[Option<Derivatives>], view: &View) {
    let shown = solution.modes.iter().zip(derivatives).filter(|(mode, _)| view.shows(mode));
    let Some(modes) = result["modes"].as_array_mut() else { return };
    for (object, (_, derivatives)) in modes.iter_mut().zip(shown) {
        let list = |values: &[f64]| values.iter().map(|x| number(*x)).collect::<Value>();
        object["velocity"] = derivatives.as_ref().map_or(Value::Null, |d| list(&d.velocity));
        object["acceleration"] = derivatives.as_ref().map_or(Value::Null, |d| list(&d.acceleration));
    }
}

/// Two tables of the real modes: velocities, accelerations; and which modes have none.
#[must_use]
pub fn text(
    entry: &Entry,
    case: &Case,
    solution: &Solution,
    derivatives: &[Option<Derivatives>],
    view: &View,
) -> String {
    let (Some(chain), Some(input)) = (entry.chain(), case.input.first()) else { return String::new() };
    let of = input.value.variable();
    let unit = |variable: Variable| if variable == Variable::Rotation { "rad" } else { "m" };
    let names = variables(chain);
    let place = |(name, variable): &&(String, Variable)| *variable == of && name[1..] == input.joint.to_string();
    let input_name = names.iter().find(place).map_or(format!("q{}", input.joint), |(name, _)| name.clone());
    let shown = solution.modes.iter().zip(derivatives).filter(|(mode, _)| view.shows(mode));
    let modes: Vec<&Option<Derivatives>> = shown.filter(|(mode, _)| mode.real).map(|(_, d)| d).collect();
    if modes.is_empty() {
        return String::new();
    }
    let mut text = String::new();
    let per = unit(of);
    for (order, title, power) in
        [(1, "velocities, unit rate", ""), (2, "accelerations, unit rate and no acceleration", "^2")]
    {
        let _ = writeln!(text, "\n{title} of {input_name}");
        let column = |(name, variable): &(String, Variable)| format!("{name} [{}/{per}{power}]", unit(*variable));
        let header: Vec<String> = std::iter::once("#".to_owned()).chain(names.iter().map(column)).collect();
        let mut table = Columns::new(&header, &[]);
        for (index, derivatives) in modes.iter().enumerate() {
            let Some(derivatives) = derivatives else { continue };
            let values = if order == 1 { &derivatives.velocity } else { &derivatives.acceleration };
            let values = values.iter().map(|x| shown_rate(*x));
            table.row(std::iter::once((index + 1).to_string()).chain(values));
        }
        text.push_str(&table.text());
    }
    let singular = modes.iter().enumerate().filter(|(_, d)| d.is_none());
    let numbers: Vec<String> = singular.map(|(index, _)| (index + 1).to_string()).collect();
    if !numbers.is_empty() {
        let _ = writeln!(text, "singular, without derivatives by {input_name}: mode {}", numbers.join(", "));
    }
    if modes.iter().copied().flatten().any(|d| d.velocity.iter().any(|x| x.is_nan())) {
        text.push_str(
            "-: the angles of an S joint have no rates where its second angle is 0 or 180 deg and moves on\n",
        );
    }
    text
}

/// Six decimals, or an exponent where these say little; a dash for none.
fn shown_rate(x: f64) -> String {
    if x.is_nan() {
        "-".to_owned()
    } else if x.abs() >= 1e6 {
        format!("{x:.6e}")
    } else {
        format!("{:.6}", x + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_short() {
        assert_eq!(shown_rate(-0.0), "0.000000");
        assert_eq!(shown_rate(1.0 / 3.0), "0.333333");
        assert_eq!(shown_rate(-2.5e7), "-2.500000e7");
        assert_eq!(shown_rate(f64::NAN), "-");
    }
}
