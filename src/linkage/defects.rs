//! Four-bars of two dyads of a synthesis in the plane: whether one circuit, and one turn of the crank, takes the coupler through all
//! positions in their order. \[Wittenburg2016, 17.14.4\]

use crate::catalogue::{DyadKind, Space, SynthesisFile, Task};
use crate::kinematics::motion::Motion;
use crate::synthesis::{Answer, Dyad};
use rug::Rational;

/// Lengths and sines closer to 0 than this, relative to the links, decide nothing: far more than the radius of certified dyads.
const CLOSE: f64 = 1e-9;

/// A four-bar whose crank and rocker are two dyads.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Indices of the dyads of crank and rocker among the modes.
    pub dyads: [usize; 2],
    /// The class by Grashof's condition; change-point where the sums are equal to rounding.
    pub class: &'static str,
    /// Whether all positions lie on one circuit; `None` where a position is too close to a limit to say.
    pub one_circuit: Option<bool>,
    /// Whether the crank, if it turns fully, passes the positions in their order in one turn; `None` if it does not turn fully.
    pub in_order: Option<bool>,
}

impl FourBar {
    /// Returns whether nothing is against it: a circuit defect, or a wrong order of a crank that turns.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.one_circuit == Some(true) && self.in_order != Some(false)
    }
}

type Point = [f64; 2];

fn minus(a: &Point, b: &Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn across(u: &Point, v: &Point) -> f64 {
    u[0] * v[1] - u[1] * v[0]
}

fn length(u: &Point) -> f64 {
    u[0].hypot(u[1])
}

/// Returns the four-bars of every two real dyads, with either as the crank; none of other tasks than positions of RR dyads in the
/// plane.
#[must_use]
pub fn four_bars(file: &SynthesisFile, answer: &Answer) -> Vec<FourBar> {
    let Task::Motion(DyadKind::RR, positions) = &file.task else { return Vec::new() };
    if file.space != Space::Plane {
        return Vec::new();
    }
    let real: Vec<(usize, &Dyad)> =
        answer.modes.iter().enumerate().filter(|(_, mode)| mode.is_real && mode.is_certified()).map(|(k, mode)| (k, &mode.dyad)).collect();
    let mut list = Vec::new();
    for (crank, first) in &real {
        for (rocker, second) in real.iter().filter(|(rocker, _)| rocker != crank) {
            if let (Some(first), Some(second)) = (Arm::of(first, positions), Arm::of(second, positions)) {
                list.extend(four_bar([*crank, *rocker], &first, &second));
            }
        }
    }
    list
}

/// A dyad at all positions.
struct Arm {
    fixed: Point,
    moving: Vec<Point>,
}

impl Arm {
    fn of(dyad: &Dyad, positions: &[Motion<Rational>]) -> Option<Self> {
        let pair = |name: &str| <Point>::try_from(dyad.real(name)).ok();
        let (fixed, own) = (pair("fixed")?, pair("moving")?);
        let at = |motion: &Motion<Rational>| {
            let [row_x, row_y] = [0, 1].map(|k| [0, 1].map(|j| motion.rotation[k][j].to_f64()));
            let [x, y] = [0, 1].map(|k| motion.translation[k].to_f64());
            [row_x[0] * own[0] + row_x[1] * own[1] + x, row_y[0] * own[0] + row_y[1] * own[1] + y]
        };
        Some(Self { fixed, moving: positions.iter().map(at).collect() })
    }

    /// The angles of the arm at the positions.
    fn angles(&self) -> Vec<f64> {
        let angle = |point: &Point| {
            let [x, y] = minus(point, &self.fixed);
            y.atan2(x)
        };
        self.moving.iter().map(angle).collect()
    }
}

/// The four-bar of a crank and a rocker; `None` where a link has no length.
fn four_bar(dyads: [usize; 2], crank: &Arm, rocker: &Arm) -> Option<FourBar> {
    let (b, c) = (crank.moving.first()?, rocker.moving.first()?);
    // Ground, crank, coupler, rocker.
    let ends = [(&rocker.fixed, &crank.fixed), (b, &crank.fixed), (c, b), (c, &rocker.fixed)];
    let lengths = ends.map(|(p, q)| length(&minus(p, q)));
    let total: f64 = lengths.iter().sum();
    if lengths.iter().any(|own| !(*own > CLOSE * total)) {
        return None;
    }
    let mut order = [0, 1, 2, 3];
    order.sort_by(|i, j| lengths[*i].total_cmp(&lengths[*j]));
    let difference = lengths[order[0]] + lengths[order[3]] - lengths[order[1]] - lengths[order[2]];
    let (class, turns) = if difference.abs() <= CLOSE * total {
        ("change-point", false)
    } else if difference > 0.0 {
        ("triple-rocker", false)
    } else {
        match order[0] {
            0 => ("double-crank", true),
            1 => ("crank-rocker", true),
            2 => ("double-rocker", false),
            _ => ("rocker-crank", false),
        }
    };
    let one_circuit = match class {
        "change-point" => None,
        "triple-rocker" => Some(true),
        _ => {
            // At the joints that do not touch the shortest link the sine keeps its sign on a circuit, and the circuits differ in it.
            let sine = |(b, c): (&Point, &Point)| {
                let (a, d) = (&crank.fixed, &rocker.fixed);
                let (joint, one, two) = match order[0] {
                    0 => (b, a, c),
                    1 => (c, b, d),
                    _ => (a, b, d),
                };
                let (u, v) = (minus(one, joint), minus(two, joint));
                across(&u, &v) / (length(&u) * length(&v))
            };
            let sines: Vec<f64> = crank.moving.iter().zip(&rocker.moving).map(sine).collect();
            let is_clear = sines.iter().all(|sine| sine.abs() > CLOSE);
            is_clear.then(|| sines.iter().all(|sine| *sine > 0.0) || sines.iter().all(|sine| *sine < 0.0))
        }
    };
    Some(FourBar { dyads, class, one_circuit, in_order: turns.then(|| in_order(&crank.angles())) })
}

/// Whether these angles follow one another within one turn one way.
fn in_order(angles: &[f64]) -> bool {
    let turn = std::f64::consts::TAU;
    let way = |sign: f64| {
        let next = angles.iter().skip(1).chain(angles.first());
        let steps = angles.iter().zip(next).map(|(from, to)| (sign * (to - from)).rem_euclid(turn));
        (steps.sum::<f64>() - turn).abs() < CLOSE
    };
    way(1.0) || way(-1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_in_one_turn_are_in_order() {
        assert!(in_order(&[0.1, 1.0, 3.0, -2.0, -0.5]));
        assert!(in_order(&[-2.0, 3.0, 2.0, 0.5]));
        assert!(!in_order(&[0.0, 2.0, 1.0, 3.0]));
    }

    #[test]
    fn positions_of_a_crank_rocker_lie_on_its_circuit() {
        // Frame 4, crank 1, coupler 4, rocker 3, at four crank angles, with the upper or the lower assembly.
        let at = |angle: f64, side: f64| {
            let (b, d) = ([angle.cos(), angle.sin()], [4.0, 0.0]);
            let apart = minus(&d, &b);
            let square = apart[0] * apart[0] + apart[1] * apart[1];
            let along = (square + 16.0 - 9.0) / (2.0 * square);
            let height = side * (16.0 / square - along * along).sqrt();
            let c = [b[0] + along * apart[0] - height * apart[1], b[1] + along * apart[1] + height * apart[0]];
            (b, c)
        };
        let of = |sides: [f64; 4]| {
            let angles = [0.3, 1.9, 3.4, 5.2];
            let (moving, other): (Vec<Point>, Vec<Point>) = angles.iter().zip(sides).map(|(a, s)| at(*a, s)).unzip();
            let (crank, rocker) = (Arm { fixed: [0.0, 0.0], moving }, Arm { fixed: [4.0, 0.0], moving: other });
            four_bar([0, 1], &crank, &rocker).unwrap()
        };
        let sound = of([1.0; 4]);
        assert_eq!((sound.class, sound.one_circuit, sound.in_order), ("crank-rocker", Some(true), Some(true)));
        assert!(!of([1.0, 1.0, -1.0, 1.0]).is_sound());
    }
}
