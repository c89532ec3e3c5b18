//! The common perpendicular of two lines, and the quadric of three.

use crate::algebra::echelon::Echelon;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::nearest_f64;
use crate::displacement::answer::{Answer, Counted, Mode, Rounding, list, number};
use crate::kinematics::motion::{cross, dot};
use crate::verdict::Code;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::line::regulus::quadric;
use rug::Rational;
use serde_json::{Map, Value, json};

/// The line that cuts two lines at right angles.
pub fn perpendicular(first: &Line<Rational>, second: &Line<Rational>) -> Answer {
    let normal = cross(&first.direction, &second.direction);
    if normal.iter().all(|c| *c == 0) {
        return Answer::family(1, None, "the lines are parallel: all perpendiculars of their plane are common");
    }
    let modes = first.perpendicular(second).and_then(|line| mode(first, second, &line)).into_iter().collect();
    let reason = "two lines that are not parallel have one common perpendicular".to_owned();
    Answer::complete(modes, Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason })
}

fn mode(first: &Line<Rational>, second: &Line<Rational>, line: &Line<Rational>) -> Option<Mode> {
    let enclosed = |v: &[Rational; 3]| v.each_ref().map(Enclosure::of);
    let unit = Line { direction: enclosed(&line.direction), moment: enclosed(&line.moment) }.unit()?;
    let mut rounding = Rounding::default();
    let mut values = Map::new();
    values.insert("direction".into(), list(&rounding.vector(&unit.direction)));
    values.insert("moment".into(), list(&rounding.vector(&unit.moment)));
    values.insert("point".into(), list(&rounding.vector(&enclosed(&line.point()?))));
    let feet = [first.foot(second)?, second.foot(first)?];
    let shown: Vec<Value> = feet.iter().map(|foot| list(&rounding.vector(&enclosed(foot)))).collect();
    values.insert("feet".into(), json!(shown));
    let between: [Rational; 3] = std::array::from_fn(|i| Rational::from(&feet[1][i] - &feet[0][i]));
    values.insert("distance".into(), number(nearest_f64(&dot(&between, &between)).sqrt()));
    let (d, e) = (&first.direction, &second.direction);
    let sine = nearest_f64(&dot(&cross(d, e), &cross(d, e))).sqrt();
    values.insert("angle".into(), number(sine.atan2(nearest_f64(&dot(d, e)))));
    Some(Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(rounding.radius), values })
}

/// The quadric that three skew lines span.
pub fn answer(lines: &[Line<Rational>; 3]) -> Answer {
    let skew = (0..3).all(|k| lines[k].product(&lines[(k + 1) % 3]) != 0);
    if !skew {
        let rows = lines.iter().map(|line| line.coordinates().to_vec()).collect();
        let rank = Echelon::of(rows, 6).rank();
        let reason = format!(
            "two of the lines meet or are parallel (rank {rank}): the lines that meet all three form flat pencils"
        );
        return Answer::family(1, None, reason);
    }
    let form = quadric(lines);
    // The largest entry becomes 1, the first of these positive.
    let Some(scale) = form.iter().flatten().max_by(|a, b| a.cmp_abs(b)) else {
        return Answer::none("there is no quadric");
    };
    let rows: Vec<Value> =
        form.iter().map(|row| list(&row.each_ref().map(|entry| nearest_f64(&Rational::from(entry / scale))))).collect();
    let top: Vec<Vec<Rational>> = form[..3].iter().map(|row| row[..3].to_vec()).collect();
    let is_paraboloid = Echelon::of(top, 3).rank() < 3;
    let mut values = Map::new();
    values.insert("quadric".into(), json!(rows));
    values.insert(
        "surface".into(),
        json!(if is_paraboloid { "hyperbolic paraboloid" } else { "hyperboloid of one sheet" }),
    );
    let centre = centre(&form).map_or(Value::Null, |centre| list(&centre.each_ref().map(nearest_f64)));
    values.insert("centre".into(), centre);
    let mode = Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(f64::EPSILON), values };
    let reason = "three skew lines span one regulus, and its quadric is unique".to_owned();
    Answer::complete(vec![mode], Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason })
}

/// The centre of a quadric; `None` of a paraboloid.
fn centre(form: &[[Rational; 4]; 4]) -> Option<[Rational; 3]> {
    let rows = (0..3).map(|i| {
        let mut row = form[i][..3].to_vec();
        row.push(Rational::from(-&form[i][3]));
        row
    });
    let solved = Echelon::among(rows.collect(), 4, 3);
    if solved.rank() < 3 {
        return None;
    }
    let mut found: [Rational; 3] = std::array::from_fn(|_| Rational::new());
    for (row, pivot) in solved.rows().iter().zip(solved.pivots()) {
        found[*pivot].clone_from(&row[3]);
    }
    Some(found)
}
