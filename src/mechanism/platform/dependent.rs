//! Platforms with legs that depend on others, whatever their lengths are: no pose is isolated among the complex ones.

use crate::algebra::echelon::Echelon;
use crate::algebra::number::nearest_f64;
use crate::assembly::Roots;
use crate::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use crate::kinematics::motion::{Motion, Vector, dot};
use crate::kinematics::platform::Platform;
use crate::verdict::{Bound, Code, Proof};
use rug::Rational;

/// The functions of a pose of which every leg's equation is a combination: `p.p`, three of `R^T p`, three of p, and nine of R.
const FUNCTIONS: usize = 16;
/// A sum of rounded numbers below this part of the sum of their sizes may be 0: they have 15 digits at least.
const ROUNDED: f64 = 1e-13;
/// Lengths of further legs that are tried: 16 divide the range in which a pose can be finely enough for a closed curve that takes a
/// tenth of it.
const TRIED: usize = 16;
/// Places of the ends of a further leg beside those of the one that it replaces, in tenths of the size: no two coordinates agree, so that the ends
/// lie on no line or plane of the others by chance.
const BESIDE: [[[i32; 3]; 2]; 5] = [
    [[3, -7, 11], [-5, 2, 9]],
    [[-8, 4, 7], [6, 9, -4]],
    [[5, 8, -6], [7, -3, 4]],
    [[-4, -9, 5], [3, 8, 7]],
    [[9, 5, 3], [-7, 6, -8]],
];

/// The legs of a platform that follow from the others.
pub struct DependentLegs {
    /// Their numbers.
    redundant: Vec<usize>,
    /// The combinations of the legs' equations that are constant, one for each redundant leg, which no other has.
    combinations: Vec<Vec<Rational>>,
    /// The platform with general legs in their place.
    regular: Platform<Rational>,
    solver: PlatformSolver,
}

/// What the legs of a set have to do with one another.
pub enum Consistency {
    /// No pose has such legs, not even a complex one.
    Contradiction,
    /// Every pose lies on a family of this dimension at least.
    Families(usize),
}

impl DependentLegs {
    /// Returns the legs that depend on others; `None` where none does.
    pub fn of(platform: &Platform<Rational>) -> Option<Self> {
        let columns: Vec<Vec<Rational>> =
            (0..6).map(|leg| functions(&platform.base[leg], &platform.plate[leg])).collect();
        let rows = (0..FUNCTIONS).map(|k| columns.iter().map(|column| column[k].clone()).collect()).collect();
        let echelon = Echelon::of(rows, 6);
        let redundant = echelon.free_columns();
        if redundant.is_empty() || redundant.len() > BESIDE.len() {
            return None;
        }
        let mut regular = platform.clone();
        for (leg, [base, plate]) in redundant.iter().zip(BESIDE) {
            let size = [&platform.base, &platform.plate].map(extent);
            let size = if size[0] > size[1] { &size[0] } else { &size[1] };
            let moved = |point: &Vector<Rational>, by: [i32; 3]| {
                std::array::from_fn(|k| size * Rational::from((by[k], 10)) + &point[k])
            };
            regular.base[*leg] = moved(&platform.base[*leg], base);
            regular.plate[*leg] = moved(&platform.plate[*leg], plate);
        }
        let solver = PlatformSolver::prepare_exact(&regular);
        Some(Self { combinations: echelon.null_space(), redundant, regular, solver })
    }

    /// Returns what the lengths of the legs have to do with one another. Of rounded numbers a relation counts as met where it is so to
    /// rounding.
    pub fn consistency(&self, platform: &Platform<Rational>, squares: &[Rational; 6], is_rounded: bool) -> Consistency {
        let constant = |leg: usize| {
            let (a, b) = (&platform.base[leg], &platform.plate[leg]);
            dot(a, a) + dot(b, b) - &squares[leg]
        };
        let constants: [Rational; 6] = std::array::from_fn(constant);
        let is_met = |row: &Vec<Rational>| {
            let terms: Vec<Rational> = row.iter().zip(&constants).map(|(x, y)| Rational::from(x * y)).collect();
            let sum: Rational = terms.iter().sum();
            let size: Rational = terms.iter().map(|term| term.clone().abs()).sum();
            sum == 0 || (is_rounded && nearest_f64(&sum).abs() <= ROUNDED * nearest_f64(&size))
        };
        if self.combinations.iter().all(is_met) {
            Consistency::Families(self.redundant.len())
        } else {
            Consistency::Contradiction
        }
    }

    /// Returns a real pose, proved to be one where the other legs are independent, as quaternion and position: the family through it has as many
    /// dimensions as there are redundant legs. `known` are poses nearby which are tried first.
    pub fn regular_pose(
        &self,
        squares: &[Rational; 6],
        known: &[Motion<f64>],
        memory: &mut PlatformWorkspace,
    ) -> Option<[f64; 7]> {
        let mut assembly = PlatformAssembly::default();
        let near = known.iter().filter_map(|pose| self.with_lengths_of(squares, pose));
        let spread = (0..TRIED).filter_map(|k| self.with_share(squares, k));
        near.chain(spread).find_map(|squares| {
            self.solver.solve_up_to(&squares, Roots::Real, None, memory, &mut assembly);
            let proved =
                assembly.modes.iter().find(|mode| mode.real && mode.certificate.is_some() && mode.multiplicity == 1)?;
            Some(std::array::from_fn(|k| if k < 4 { proved.quaternion[k].re } else { proved.position[k - 4].re }))
        })
    }

    /// The squares with those of the further legs at a pose.
    fn with_lengths_of(&self, squares: &[Rational; 6], pose: &Motion<f64>) -> Option<[Rational; 6]> {
        let there = self.solver.platform().legs_squared(pose);
        let mut squares = squares.clone();
        for leg in &self.redundant {
            squares[*leg] = Rational::from_f64(there[*leg])?;
        }
        Some(squares)
    }

    /// The squares with lengths of the further legs within the range that the others leave: `k` numbers the places in it.
    fn with_share(&self, squares: &[Rational; 6], k: usize) -> Option<[Rational; 6]> {
        let mut all = squares.clone();
        for (place, leg) in self.redundant.iter().enumerate() {
            let kept = (0..6).filter(|other| !self.redundant.contains(other));
            let (mut least, mut most) = (0.0_f64, f64::INFINITY);
            for other in kept {
                let way =
                    [&self.regular.base, &self.regular.plate].map(|points| distance(&points[*leg], &points[other]));
                let (length, way) = (nearest_f64(&squares[other]).sqrt(), way[0] + way[1]);
                (least, most) = (least.max(length - way), most.min(length + way));
            }
            // Several legs are not at the same share of their ranges.
            let share = ((k * (2 * place + 1)) % TRIED) as f64 + 0.5;
            let length = least + (most - least) * share / TRIED as f64;
            all[*leg] = Rational::from_f64(length * length)?;
        }
        Some(all)
    }
}

/// The coefficients of a leg's equation, but the constant one.
fn functions(base: &Vector<Rational>, plate: &Vector<Rational>) -> Vec<Rational> {
    let products = base.iter().flat_map(|a| plate.iter().map(move |b| Rational::from(a * b)));
    [Rational::from(1)].into_iter().chain(plate.iter().cloned()).chain(base.iter().cloned()).chain(products).collect()
}

/// The largest difference of a coordinate of two points, or 1 where all are one point.
fn extent(points: &[Vector<Rational>; 6]) -> Rational {
    let spread = |k: usize| {
        let own = || points.iter().map(|point| &point[k]);
        own().max().zip(own().min()).map_or_else(Rational::new, |(most, least)| Rational::from(most - least))
    };
    let most = (0..3).map(spread).max().unwrap_or_default();
    if most == 0 { Rational::from(1) } else { most }
}

fn distance(p: &Vector<Rational>, q: &Vector<Rational>) -> f64 {
    nearest_f64(&(0..3).map(|k| Rational::from(&p[k] - &q[k]).square()).sum()).sqrt()
}

/// Returns the bound where the lengths of dependent legs contradict one another.
pub fn contradiction() -> Bound {
    let because = "0 poses that there can be: the equation of one leg is a combination of the others' but for its length, which is another".to_owned();
    Bound { count: 0, proof: Proof::Proved, code: Code::NoSolution, because }
}
