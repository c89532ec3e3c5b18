//! Four-bars of a synthesis in the plane, of two dyads or with a given coupler curve: whether one circuit, and one round of it, takes the
//! coupler through all positions or points in their order. \[Wittenburg2016, 17.14.4\]

use crate::algebra::sort;
use crate::catalogue::{DyadKind, Space, SynthesisFile, Task};
use crate::kinematics::motion::Motion;
use crate::synthesis::path::{NAMES, moving, pivots};
use crate::synthesis::{Answer, Dyad};
use rug::Rational;

/// Lengths and sines closer to 0 than this, relative to the links, decide nothing: far more than the radius of certified dyads.
const CLOSE: f64 = 1e-9;

/// What a four-bar is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Indices of the dyads of crank and rocker among the modes.
    Dyads([usize; 2]),
    /// A four-bar of a path, one of its three cognates, with the crank at its pivot A or D.
    Cognate {
        /// Its index among the modes.
        mode: usize,
        /// 0 for the four-bar itself, 1 and 2 for its cognates.
        cognate: usize,
        /// The pivot of the crank.
        crank: &'static str,
    },
}

/// A four-bar that takes its coupler through the positions.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// What it is made of.
    pub source: Source,
    /// The class by Grashof's condition; change-point where the sums are equal to rounding.
    pub class: &'static str,
    /// Whether all positions lie on one circuit; `None` where a position is too close to a limit to say.
    pub one_circuit: Option<bool>,
    /// Whether one round of their circuit passes the positions in their order; `None` where they are not known to lie on one, or
    /// one of them is too close to a limit to say.
    pub in_order: Option<bool>,
    /// Whether the crank takes the coupler from the first position to the last, in their order, without a limit on the way; `None`
    /// where `in_order` is.
    pub without_limit: Option<bool>,
}

impl FourBar {
    /// Returns whether it has neither a circuit defect nor an order defect.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.one_circuit == Some(true) && self.in_order == Some(true)
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

/// Returns the four-bars of every two real dyads, and those of a path with their cognates, each with either link as the crank; none of
/// other tasks than paths and positions of RR dyads in the plane.
#[must_use]
pub fn four_bars(file: &SynthesisFile, answer: &Answer) -> Vec<FourBar> {
    let positions = match &file.task {
        Task::Motion(DyadKind::RR, positions) => positions,
        Task::Path(points) => return of_path(points, answer),
        _ => return Vec::new(),
    };
    if file.space != Space::Plane {
        return Vec::new();
    }
    let real: Vec<(usize, &Dyad)> = answer
        .modes
        .iter()
        .enumerate()
        .filter(|(_, mode)| mode.is_real && mode.is_certified())
        .map(|(k, mode)| (k, &mode.dyad))
        .collect();
    let mut list = Vec::new();
    for (crank, first) in &real {
        for (rocker, second) in real.iter().filter(|(rocker, _)| rocker != crank) {
            if let (Some(first), Some(second)) = (Arm::of(first, positions), Arm::of(second, positions)) {
                list.extend(four_bar(Source::Dyads([*crank, *rocker]), &first, &second));
            }
        }
    }
    list
}

/// The four-bars of a path.
fn of_path(points: &[[Rational; 2]], answer: &Answer) -> Vec<FourBar> {
    let points: Vec<Point> = points.iter().map(|point| point.each_ref().map(Rational::to_f64)).collect();
    let mut list = Vec::new();
    for (mode, own) in answer.modes.iter().enumerate().filter(|(_, mode)| mode.is_real && mode.is_certified()) {
        for (cognate, names) in NAMES.into_iter().enumerate() {
            let Some(pivots) = pivots(&own.dyad, names) else { continue };
            let Some(places) = moving(&pivots, &points) else { continue };
            let arm = |fixed: Point, k: usize| Arm { fixed, moving: places.iter().map(|place| place[k]).collect() };
            let (one, other) = (arm(pivots[0], 0), arm(pivots[3], 1));
            let source = |crank| Source::Cognate { mode, cognate, crank };
            list.extend(four_bar(source("A"), &one, &other));
            list.extend(four_bar(source("D"), &other, &one));
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
fn four_bar(source: Source, crank: &Arm, rocker: &Arm) -> Option<FourBar> {
    let (b, c) = (crank.moving.first()?, rocker.moving.first()?);
    // Ground, crank, coupler, rocker.
    let ends = [(&rocker.fixed, &crank.fixed), (b, &crank.fixed), (c, b), (c, &rocker.fixed)];
    let lengths = ends.map(|(p, q)| length(&minus(p, q)));
    let total: f64 = lengths.iter().sum();
    if lengths.iter().any(|own| !(*own > CLOSE * total)) {
        return None;
    }
    let mut order = [0, 1, 2, 3];
    sort::by(&mut order, |i, j| lengths[*i].total_cmp(&lengths[*j]));
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
    let passed = if one_circuit == Some(true) {
        if turns { Some([in_order(&crank.angles()), true]) } else { swung(crank, rocker, &lengths) }
    } else {
        None
    };
    let in_order = passed.map(|[in_order, _]| in_order);
    Some(FourBar { source, class, one_circuit, in_order, without_limit: passed.map(|[order, free]| order && free) })
}

/// Of a crank that does not turn fully: whether one round of the circuit passes the positions in their order, and whether the crank
/// takes them one after the other without a limit. Lengths are those of frame, crank, coupler and rocker.
///
/// Coupler and rocker lie in a line at the two limits of the crank, which part the circuit in two: on either part the sine of their
/// angle keeps its sign and the angle of the crank tells the positions apart. One round takes the crank forth on the one and back on
/// the other.
fn swung(crank: &Arm, rocker: &Arm, lengths: &[f64; 4]) -> Option<[bool; 2]> {
    let [frame, arm, coupler, other] = lengths;
    let turn = std::f64::consts::TAU;
    let [x, y] = minus(&rocker.fixed, &crank.fixed);
    // A crank that cannot point away from the rocker's pivot swings between angles of (-pi, pi) against the frame, another one between
    // angles of (0, 2 pi).
    let start = if arm + frame > coupler + other { -turn / 2.0 } else { 0.0 };
    let mut places = Vec::new();
    for ((angle, b), c) in crank.angles().iter().zip(&crank.moving).zip(&rocker.moving) {
        let (u, v) = (minus(b, c), minus(&rocker.fixed, c));
        let sine = across(&u, &v) / (length(&u) * length(&v));
        let swing = (angle - y.atan2(x) - start).rem_euclid(turn);
        (sine.abs() > CLOSE).then(|| places.push((sine > 0.0, swing)))?;
    }
    let round: Vec<f64> =
        places.iter().map(|(is_forth, swing)| if *is_forth { swing / 2.0 } else { turn - swing / 2.0 }).collect();
    let one_part = places.iter().all(|(is_forth, _)| *is_forth) || places.iter().all(|(is_forth, _)| !*is_forth);
    let one_way = places.is_sorted_by(|a, b| a.1 <= b.1) || places.is_sorted_by(|a, b| a.1 >= b.1);
    Some([in_order(&round), one_part && one_way])
}

/// Returns whether these angles follow one another within one turn one way.
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
            four_bar(Source::Dyads([0, 1]), &crank, &rocker).unwrap()
        };
        let sound = of([1.0; 4]);
        assert_eq!((sound.class, sound.one_circuit, sound.in_order), ("crank-rocker", Some(true), Some(true)));
        assert!(!of([1.0, 1.0, -1.0, 1.0]).is_sound());
    }

    /// The rounds of two four-bars whose cranks swing, walked along the circuit by steps of another joint, and the same positions in
    /// another order.
    #[test]
    fn a_circuit_is_walked_in_its_order() {
        // Frame, crank, coupler, rocker: the coupler is the shortest link, then there is no short one, with either limit of the crank.
        for [frame, crank, coupler, rocker] in
            [[4.0, 3.0, 1.0, 3.5], [4.0, 3.0, 2.0, 2.5], [2.0, 3.0, 4.0, 2.5], [4.0, 2.5, 2.0, 3.0]]
        {
            // Newton's method keeps the coupler's length while the walk goes on at right angles to its gradient.
            let points =
                |[a, d]: [f64; 2]| ([crank * a.cos(), crank * a.sin()], [frame + rocker * d.cos(), rocker * d.sin()]);
            let open = |at: [f64; 2]| {
                let (b, c) = points(at);
                let [x, y] = minus(&c, &b);
                let slope = [
                    2.0 * crank * (x * at[0].sin() - y * at[0].cos()),
                    2.0 * rocker * (y * at[1].cos() - x * at[1].sin()),
                ];
                (x * x + y * y - coupler * coupler, slope)
            };
            let settled = |mut at: [f64; 2]| {
                for _ in 0..40 {
                    let (value, slope) = open(at);
                    let square = slope[0] * slope[0] + slope[1] * slope[1];
                    at = [at[0] - value * slope[0] / square, at[1] - value * slope[1] / square];
                }
                at
            };
            let mut at = settled([0.9, 1.2]);
            let first = at;
            let mut walk = Vec::new();
            loop {
                walk.push(at);
                let (_, slope) = open(at);
                let size = slope[0].hypot(slope[1]);
                at = settled([at[0] - 0.01 * slope[1] / size, at[1] + 0.01 * slope[0] / size]);
                let back = [0, 1].map(|k| (at[k] - first[k]).sin().abs());
                if walk.len() > 20 && back[0].hypot(back[1]) < 0.008 && (at[0] - first[0]).cos() > 0.0 {
                    break;
                }
                assert!(walk.len() < 4000, "the circuit is closed");
            }
            let of = |shares: [usize; 5]| {
                let (moving, other): (Vec<Point>, Vec<Point>) =
                    shares.map(|k| points(walk[walk.len() * k / 10 + 3])).into_iter().unzip();
                let (one, two) = (Arm { fixed: [0.0, 0.0], moving }, Arm { fixed: [frame, 0.0], moving: other });
                four_bar(Source::Dyads([0, 1]), &one, &two).unwrap()
            };
            let forth = of([0, 2, 4, 6, 8]);
            assert_eq!(
                (forth.one_circuit, forth.in_order, forth.without_limit),
                (Some(true), Some(true), Some(false)),
                "{}",
                forth.class
            );
            assert!(of([8, 6, 4, 2, 0]).is_sound() && of([4, 6, 8, 0, 2]).is_sound());
            assert!(!of([0, 4, 2, 6, 8]).is_sound() && !of([0, 2, 4, 8, 6]).is_sound());
            // Positions between two limits of the crank, where its angle goes one way.
            let limit = |k: usize| (walk[k][0] - walk[k - 1][0]) * (walk[(k + 1) % walk.len()][0] - walk[k][0]) < 0.0;
            let limits: Vec<usize> = (1..walk.len() - 1).filter(|k| limit(*k)).collect();
            let [from, to, ..] = limits[..] else { panic!("two limits: {limits:?}") };
            let (moving, other) = [1, 3, 5, 8].map(|k| points(walk[from + (to - from) * k / 10])).into_iter().unzip();
            let (one, two) = (Arm { fixed: [0.0, 0.0], moving }, Arm { fixed: [frame, 0.0], moving: other });
            assert_eq!(four_bar(Source::Dyads([0, 1]), &one, &two).unwrap().without_limit, Some(true));
        }
    }
}
