//! Wheels with rollers: how fast they turn for a motion of their vehicle, and which motions they can have.

use crate::algebra::echelon::Echelon;
use crate::algebra::number::nearest_f64;
use crate::catalogue::gearing::Wheel;
use crate::displacement::Answer;
use crate::displacement::answer::{Named, list};
use rug::Rational;
use serde_json::{Value, json};

/// The rates of a wheel for unit velocities along x and y and unit angular velocity of the vehicle: the point at the floor does not
/// slip along the axis of its roller.
fn rates(wheel: &Wheel) -> [Rational; 3] {
    let ([x, y], [a, b]) = (&wheel.at, &wheel.roller);
    let [c, d] = &wheel.drive;
    let size = Rational::from(c.square_ref()) + Rational::from(d.square_ref());
    // The drive is a direction: its length is a square root, and one factor of it is that of the rate.
    let length = looproot_calculus::unit::Root::sqrt(&size)
        .unwrap_or_else(|| Rational::from_f64(nearest_f64(&size).sqrt()).unwrap_or_else(|| Rational::from(1)));
    let along = (Rational::from(a * c) + Rational::from(b * d)) / length * &wheel.radius;
    let turning = Rational::from(b * x) - Rational::from(a * y);
    [Rational::from(a / &along), Rational::from(b / &along), turning / along]
}

/// Matrix, rank, conditions between the rates, and the rates of a given motion.
pub fn answer(wheels: &[Wheel], twist: Option<&[Rational; 3]>) -> Answer {
    let matrix: Vec<Vec<Rational>> = wheels.iter().map(|wheel| rates(wheel).to_vec()).collect();
    let solved = Echelon::of(matrix.clone(), 3);
    let transposed: Vec<Vec<Rational>> = (0..3).map(|k| matrix.iter().map(|row| row[k].clone()).collect()).collect();
    let conditions = Echelon::of(transposed, wheels.len()).null_space();
    let float = |rows: &[Vec<Rational>]| -> Value {
        rows.iter().map(|row| list(&row.iter().map(nearest_f64).collect::<Vec<f64>>())).collect()
    };
    let mut named = Named::default();
    named.put("matrix", float(&matrix));
    named.put("rank", json!(solved.rank()));
    named.put("conditions", float(&conditions));
    if let Some(twist) = twist {
        let rate = |row: &Vec<Rational>| {
            let sum = row.iter().zip(twist).fold(Rational::new(), |sum, (a, b)| sum + Rational::from(a * b));
            nearest_f64(&sum)
        };
        named.put("rates", list(&matrix.iter().map(rate).collect::<Vec<f64>>()));
    }
    let reason = if solved.rank() == 3 {
        "the rates of the wheels determine the motion of the vehicle; those that satisfy the conditions are possible without slip"
    } else {
        "the rates of the wheels do not determine the motion of the vehicle"
    };
    named.answer(reason)
}
