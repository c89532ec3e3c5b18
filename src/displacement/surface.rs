//! The frame of a point that moves on a surface: its first axis along the path, its third along the normal.

use super::answer::{Answer, Named};
use crate::algebra::dual::Dual;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::catalogue::displacement::OnSurface;
use crate::kinematics::motion::{Vector, cross, dot};
use rug::Rational;

/// A number that moves: value, rate and half the second rate.
type Moving = Series<Rational, 3>;

/// Position, tangents of the parameter lines, and direction of the path.
struct Path {
    position: Vector<Moving>,
    normal: Vector<Moving>,
}

fn path(motion: &OnSurface) -> Option<Path> {
    let [at, rate, second] = &motion.path;
    let run = |k: usize| Moving { coefficients: [at[k].clone(), rate[k].clone(), Rational::from(&second[k] / 2)] };
    // One parameter carries a dual part, whose coefficient is the derivative by it.
    let along = |which: usize| -> Option<[Dual<Moving>; 3]> {
        let part = |k: usize| if k == which { Moving::one() } else { Moving::zero() };
        let values = [0, 1].map(|k| Dual { value: run(k), epsilon: part(k) });
        let [x, y, z] = &motion.coordinates;
        Some([x.evaluate(&values)?, y.evaluate(&values)?, z.evaluate(&values)?])
    };
    let (u, v) = (along(0)?, along(1)?);
    let tangent = |of: &[Dual<Moving>; 3]| -> Vector<Moving> { of.each_ref().map(|own| own.epsilon.clone()) };
    let normal = cross(&tangent(&u), &tangent(&v));
    Some(Path { position: u.map(|own| own.value), normal })
}

fn coefficient(v: &Vector<Moving>, k: usize, factor: i32) -> Vector<Rational> {
    v.each_ref().map(|own| Rational::from(&own.coefficients[k] * factor))
}

/// Returns the curvatures of the path on the surface, and the angular velocity of the frame.
pub fn answer(motion: &OnSurface) -> Answer {
    let Some(path) = path(motion) else { return Answer::none("the coordinates have no values at these parameters") };
    let (position, velocity) = (coefficient(&path.position, 0, 1), coefficient(&path.position, 1, 1));
    let acceleration = coefficient(&path.position, 2, 2);
    let (normal, turning) = (coefficient(&path.normal, 0, 1), coefficient(&path.normal, 1, 1));
    let (square, speed) = (dot(&normal, &normal), dot(&velocity, &velocity));
    if square == 0 || speed == 0 {
        return Answer::none("the surface has no normal there, or the point rests");
    }
    let both = Rational::from(&square * &speed);
    let (bend, turn) = (dot(&acceleration, &normal), dot(&normal, &cross(&velocity, &acceleration)));
    let torsion = dot(&velocity, &cross(&normal, &turning)) / &both;
    // tau t' - kappa_n (n x t) s' + kappa_g n s'
    let side = cross(&normal, &velocity);
    let omega: Vector<Rational> = std::array::from_fn(|k| {
        let bending = Rational::from(&bend * &side[k]) / &both;
        let spin = Rational::from(&turn * &normal[k]) / &both;
        Rational::from(&torsion * &velocity[k]) - bending + spin
    });
    let mut named = Named::default();
    named.vector("position", &position);
    named.vector("velocity", &velocity);
    named.unit("tangent", &velocity);
    named.unit("normal", &normal);
    named.length("speed", &velocity);
    let root = |q: &Rational| Enclosure::of(q).sqrt();
    // kappa_n = r''.N/(|N| r'.r'), kappa_g = det(N, r', r'')/(|N| |r'|^3)
    let normal_curvature = root(&square).and_then(|length| Enclosure::of(&bend).over(&length.scaled(&speed)));
    let geodesic = root(&both).and_then(|length| Enclosure::of(&turn).over(&length.scaled(&speed)));
    for (name, found) in [("normal_curvature", normal_curvature), ("geodesic_curvature", geodesic)] {
        named.enclosed(name, &found.unwrap_or_else(Enclosure::zero));
    }
    named.number("geodesic_torsion", &torsion);
    named.vector("angular_velocity", &omega);
    named.answer("normal, tangent and their rates determine how the frame of Darboux turns")
}
