//! The cases of `cases.txt`, and random platforms of every class.

use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::benchmark::platform::sample::{PlatformSet, sample};
use looproot::internal::catalogue::entry::{Case as CatalogueCase, Design, Entry};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot_algebra::number::{Number, nearest_f64};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// A platform with legs, and what is known of its poses.
pub struct Case {
    pub name: String,
    /// Numbers of complex and of real poses; none where they form a curve.
    pub counts: Option<(usize, usize)>,
    pub platform: Platform<Rational>,
    pub legs: [Rational; 6],
    /// Known real poses, rotations as quaternions of norm 1.
    pub poses: Vec<[f64; 7]>,
}

/// The cases of the file.
pub fn cases() -> Vec<Case> {
    let zero = || std::array::from_fn(|_| std::array::from_fn(|_| Rational::new()));
    let (mut all, mut points): (Vec<Case>, [usize; 2]) = (Vec::new(), [0, 0]);
    let lines = include_str!("cases.txt").lines().filter(|line| !line.starts_with('#'));
    for line in lines {
        let mut words = line.split_whitespace();
        let kind = words.next().unwrap();
        if kind == "case" {
            let name = words.next().unwrap().to_owned();
            let counts: Vec<usize> = words.filter_map(|w| w.parse().ok()).collect();
            let platform = Platform { base: zero(), plate: zero() };
            let legs = std::array::from_fn(|_| Rational::new());
            let counts = (counts.len() == 2).then(|| (counts[0], counts[1]));
            all.push(Case { name, counts, platform, legs, poses: Vec::new() });
            points = [0, 0];
            continue;
        }
        let case = all.last_mut().unwrap();
        let exact = |w: &str| -> Rational { w.parse().unwrap() };
        match kind {
            "a" | "b" => {
                let list = if kind == "a" { &mut case.platform.base } else { &mut case.platform.plate };
                let at = &mut points[usize::from(kind == "b")];
                for (x, word) in list[*at].iter_mut().zip(words) {
                    *x = exact(word);
                }
                *at += 1;
            }
            "l" => {
                for (x, word) in case.legs.iter_mut().zip(words) {
                    *x = exact(word);
                }
            }
            _ => {
                let read = |w: &str| w.parse().unwrap_or_else(|_| nearest_f64(&exact(w)));
                let mut pose: Vec<f64> = words.map(read).collect();
                let size = pose[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
                pose[..4].iter_mut().for_each(|x| *x /= size);
                case.poses.push(pose.try_into().unwrap());
            }
        }
    }
    all
}

/// A case by its name.
pub fn case(name: &str) -> Case {
    cases().into_iter().find(|case| case.name == name).unwrap()
}

/// Solved in f64.
pub fn solved(platform: &Platform<Rational>, legs: &[Rational; 6], roots: Roots) -> PlatformAssembly {
    let mut assembly = PlatformAssembly::default();
    let solver = PlatformSolver::prepare(&platform.map(|x| Some(nearest_f64(x))).unwrap());
    solver.solve(&legs.each_ref().map(nearest_f64), roots, &mut PlatformWorkspace::default(), &mut assembly);
    assembly
}

/// As the command line solves it.
pub fn answer(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Solution {
    let numbers = |p: &[[Rational; 3]; 6]| p.each_ref().map(|p| p.each_ref().map(|x| Number::exact(x.clone())));
    let design = Platform { base: numbers(&platform.base), plate: numbers(&platform.plate) };
    let case = CatalogueCase::legs(squares.each_ref().map(|s| Number::exact(s.clone())), 0);
    let entry = Entry {
        design: Design::Platform(Box::new(design)),
        cases: vec![case],
        ..sample(PlatformSet::General, 1, 0).unwrap().entry
    };
    let (mut workspace, mut assembly) = Default::default();
    Mechanism::prepare(&entry).unwrap().solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

/// The rotation 1 and a translation.
pub fn translation(translation: [Rational; 3]) -> Motion<Rational> {
    let identity = Quaternion { scalar: Rational::from(1), vector: [0; 3].map(Rational::from) };
    Motion { rotation: identity.scaled_rotation(), translation }
}

/// Returns the distance of the nearest real pose of a list from a given one.
pub fn nearest(assembly: &PlatformAssembly, pose: &[f64; 7]) -> f64 {
    let reach = pose[4..].iter().fold(1.0_f64, |reach, x| reach.max(x.abs()));
    let distance = |mode: &looproot::internal::assembly::platform::PlatformMode| {
        let turned = |sign: f64| (0..4).map(|k| (sign * mode.quaternion[k].re - pose[k]).abs()).fold(0.0, f64::max);
        let moved = (0..3).map(|k| (mode.position[k].re - pose[4 + k]).abs() / reach).fold(0.0, f64::max);
        turned(1.0).min(turned(-1.0)).max(moved)
    };
    assembly.modes.iter().filter(|mode| mode.real).map(distance).fold(f64::INFINITY, f64::min)
}

/// Small integers.
pub struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn number(&mut self) -> Rational {
        Rational::from(self.0.random_range(-20..=20))
    }

    /// Draws a number below `most`.
    pub fn choice(&mut self, most: u64) -> u64 {
        self.0.random_range(0..most)
    }

    pub fn point(&mut self) -> [Rational; 3] {
        std::array::from_fn(|_| self.number())
    }

    pub fn platform(&mut self) -> Platform<Rational> {
        Platform { base: std::array::from_fn(|_| self.point()), plate: std::array::from_fn(|_| self.point()) }
    }

    /// A rational rigid motion, and the quaternion of its rotation.
    pub fn pose(&mut self) -> (Quaternion<Rational>, Motion<Rational>) {
        let q = Quaternion { scalar: Rational::from(self.0.random_range(1..=9)), vector: self.point() };
        let norm = q.norm();
        let rotation = q.scaled_rotation().map(|row| row.map(|x| x / &norm));
        (q, Motion { rotation, translation: self.point() })
    }
}
