//! Exact results for one set of legs: the number of poses, and the poses.

use super::roots::are_all_matched;
use crate::algebra::drawn;
use crate::algebra::univariate::Univariate;
use crate::assembly::platform::{PlatformAssembly, PlatformMode, PlatformSolver, PlatformWorkspace, Route};
use crate::certify::pose::are_apart;
use crate::elimination::multiple_pose::multiple_poses;
use crate::elimination::platform_basis::{PoseBasis, PosePoints, pose_basis};
use crate::elimination::platform_degree::{PlatformDegree, platform_degree};
use crate::elimination::platform_polynomial::{
    PlatformPolynomial, Quotient, are_simple, multiple_platform_polynomial, platform_polynomial,
};
use crate::kinematics::platform::Platform;
use crate::verdict::{Bound, Code, MOST_POSES, PlatformKnowledge, Proof};
use rug::Rational;

/// One set of legs, exact.
pub struct ExactSide<'a> {
    /// The points.
    pub platform: &'a Platform<Rational>,
    /// The squared lengths of the legs.
    pub squares: &'a [Rational; 6],
    /// A bound on the number of poses that holds for all legs of this geometry, and why.
    pub incidence: Option<(usize, &'static str)>,
    /// Whether complex poses are looked for beside the real ones.
    pub complex: bool,
}

/// The memory of one solver.
pub struct Search<'a> {
    /// The solver.
    pub solver: &'a PlatformSolver,
    /// Its memory, which holds what was found.
    pub memory: &'a mut PlatformWorkspace,
    /// The list.
    pub assembly: &'a mut PlatformAssembly,
}

impl Search<'_> {
    /// Poses that are proved, and proved to be different, with multiplicity: wide balls of poses that nearly coincide may hold one of them
    /// both.
    fn proved(&self) -> usize {
        let mut counted: Vec<(&PlatformMode, f64)> = Vec::new();
        for mode in &self.assembly.modes {
            let Some(certificate) = mode.certificate else { continue };
            let apart = |(other, radius): &(&PlatformMode, f64)| {
                are_apart(&mode.study, certificate.radius, &other.study, *radius)
            };
            if counted.iter().all(apart) {
                counted.push((mode, certificate.radius));
            }
        }
        counted.iter().map(|(mode, _)| mode.multiplicity).sum()
    }

    /// Counts the certified modes of multiplicity 1.
    fn simple(&self) -> usize {
        let modes = &self.assembly.modes;
        modes.iter().filter(|mode| mode.certificate.is_some() && mode.multiplicity == 1).count()
    }

    fn keep_proved(&mut self) {
        self.solver.keep_proved(self.memory, self.assembly);
    }
}

/// Words of 64 bits in which poses are looked for that f64 does not reach.
const LIMBS: usize = 6;
/// Limbs of a second attempt: a border basis may lose eight times the digits by which the data differ from those of a special
/// platform, and 15 digits are ordinary.
const MORE_LIMBS: usize = 15;

/// Returns the number of simple roots of a polynomial.
fn simple_roots(polynomial: &PlatformPolynomial) -> usize {
    let factors = Univariate::new(polynomial.coefficients.clone()).square_free_decomposition();
    factors.iter().filter(|(_, multiplicity)| *multiplicity == 1).filter_map(|(factor, _)| factor.degree()).sum()
}

impl ExactSide<'_> {
    /// Finds what is missing of a list, as far as that is known, and says what is known of the number of poses. A polynomial
    /// that is known already is not computed again.
    pub fn settle(&self, search: &mut Search, known: Option<&PlatformPolynomial>) -> PlatformKnowledge {
        if let Some((most, why)) = self.incidence
            && search.proved() == most
        {
            return Self::met(search, most, why);
        }
        // Without a border basis of its own, f64 finds the poses of a platform along paths, and loses some where the data are special.
        let is_by_paths = matches!(search.assembly.route, Route::Homotopy { .. });
        if let Some((most, why)) = self.incidence.filter(|_| is_by_paths) {
            self.solve_in_high_precision::<LIMBS>(search, most);
            if search.proved() < most {
                self.solve_in_high_precision::<MORE_LIMBS>(search, most);
            }
            if search.proved() == most {
                return Self::met(search, most, why);
            }
        }
        let degree = platform_degree(self.platform, self.squares);
        let Some(PlatformDegree::Finite { poses, null, curves }) = degree else {
            return self.beyond_rings(search, degree);
        };
        if poses == 0
            && let Some(PoseBasis::AtMost(points)) = pose_basis(self.platform, self.squares)
            && points.count == 0
        {
            return self.by_basis(search, &points);
        }
        // Poses are isolated: none lies on a curve of them.
        search.assembly.self_motion = 0;
        let (mut is_repeated, mut is_longer) = (false, false);
        let most = self.incidence.map_or(MOST_POSES, |(most, _)| most);
        if poses == most && !curves && known.is_none() {
            // Poses that f64 does not reach are computed from the exact data.
            self.solve_in_high_precision::<LIMBS>(search, poses);
            is_repeated = true;
            // Platforms near special ones have simple poses that take more digits.
            if search.proved() < poses && are_simple(self.platform, self.squares) {
                self.solve_in_high_precision::<MORE_LIMBS>(search, poses);
                is_longer = true;
            }
            if search.proved() == poses {
                search.keep_proved();
                let bound = self.incidence.map(|(most, why)| at_most(most, why));
                let count = Some(bound.unwrap_or_else(|| counted(poses, null, curves)));
                return PlatformKnowledge { count, ..PlatformKnowledge::default() };
            }
        }
        let found = if known.is_some() { None } else { polynomial(self.platform, self.squares) };
        let polynomial = known.or(found.as_ref());
        let count = polynomial
            .map_or_else(|| counted(poses, null, curves), |polynomial| by_polynomial(polynomial, poses, null, curves));
        let proof = count.proof;
        let total = count.count;
        let mut knowledge = PlatformKnowledge { count: Some(count), ..PlatformKnowledge::default() };
        let reals = |search: &Search| {
            let matched = |polynomial: &PlatformPolynomial| are_all_matched(polynomial, &search.assembly.modes);
            polynomial.is_some_and(matched).then_some(proof)
        };
        let is_done =
            |search: &Search, reals: Option<Proof>| search.proved() == total || (!self.complex && reals.is_some());
        knowledge.reals = reals(search);
        // The algebra of rotations was solved in multiprecision before.
        let is_affine = polynomial.is_some_and(|polynomial| polynomial.quotient == Quotient::Affine);
        if !is_repeated && !is_affine && !is_done(search, knowledge.reals) {
            self.solve_in_high_precision::<LIMBS>(search, total);
            knowledge.reals = reals(search);
        }
        if !is_done(search, knowledge.reals)
            && let Some(polynomial) = polynomial
        {
            self.add_multiple(search, polynomial);
            knowledge.reals = reals(search);
        }
        // Simple poses beside multiple ones may take more digits, too.
        let is_general = polynomial.is_some_and(|polynomial| polynomial.quotient == Quotient::General);
        if is_general
            && !is_longer
            && !is_done(search, knowledge.reals)
            && polynomial.is_some_and(|polynomial| search.simple() < simple_roots(polynomial))
        {
            self.solve_in_high_precision::<MORE_LIMBS>(search, total);
            knowledge.reals = reals(search);
        }
        if !is_general && !is_done(search, knowledge.reals) {
            search.solver.solve_further(self.squares, total, search.memory, search.assembly);
            search.assembly.self_motion = 0;
            knowledge.reals = reals(search);
        }
        if is_done(search, knowledge.reals) || search.assembly.total() > total {
            search.keep_proved();
        }
        // As many poses as the geometry allows need no count.
        if let Some((most, why)) = self.incidence
            && search.proved() == most
        {
            knowledge.count = Some(at_most(most, why));
        } else if poses < MOST_POSES
            && (!proof.is_proved() || !is_done(search, knowledge.reals))
            && let Some(PoseBasis::AtMost(points)) = pose_basis(self.platform, self.squares)
        {
            knowledge.count = self.by_basis(search, &points).count;
        }
        knowledge
    }

    /// What is known where the rings made for platforms see no finite number of poses.
    fn beyond_rings(&self, search: &mut Search, degree: Option<PlatformDegree>) -> PlatformKnowledge {
        let basis = pose_basis(self.platform, self.squares);
        if let Some(PoseBasis::AtMost(points)) = &basis {
            return self.by_basis(search, points);
        }
        let infinite = match degree {
            Some(PlatformDegree::Infinite { dimension }) => Some(dimension),
            _ => None,
        };
        if infinite.is_some() && search.assembly.route == Route::Affine {
            search.solver.find_self_motion(self.squares, search.memory, search.assembly);
        }
        // Points of a curve are none to be listed.
        if infinite.is_some() {
            search.keep_proved();
        }
        let infinite_modulo_prime = matches!(basis, Some(PoseBasis::InfiniteModuloPrime));
        PlatformKnowledge { infinite, infinite_modulo_prime, ..PlatformKnowledge::default() }
    }

    /// Looks for the poses that a basis over the rationals leaves room for; these are finitely many.
    fn by_basis(&self, search: &mut Search, points: &PosePoints) -> PlatformKnowledge {
        search.assembly.self_motion = 0;
        search.assembly.motion.clear();
        let total = points.count;
        if search.proved() < total
            && let Some(table) = points.table()
        {
            let before = search.proved();
            let Search { solver, memory, assembly } = search;
            solver.solve_by_table::<LIMBS>(&table, self.squares, total, memory, assembly);
            // Where nothing is gained, multiple poses are missing, which more digits do not make simple.
            if (before + 1..total).contains(&search.proved()) {
                let Search { solver, memory, assembly } = search;
                solver.solve_by_table::<MORE_LIMBS>(&table, self.squares, total, memory, assembly);
            }
        }
        if search.proved() == total || search.assembly.total() > total {
            search.keep_proved();
        }
        PlatformKnowledge { count: Some(by_points(total)), ..PlatformKnowledge::default() }
    }

    /// What is known where as many poses are proved as the geometry allows: there is no other one, not even on a curve.
    fn met(search: &mut Search, most: usize, why: &str) -> PlatformKnowledge {
        search.assembly.self_motion = 0;
        search.keep_proved();
        PlatformKnowledge { count: Some(at_most(most, why)), ..PlatformKnowledge::default() }
    }

    fn solve_in_high_precision<const LIMBS: usize>(&self, search: &mut Search, expected: usize) {
        search.solver.solve_in_high_precision::<LIMBS>(
            self.platform,
            self.squares,
            expected,
            search.memory,
            search.assembly,
        );
    }

    /// Puts multiple poses that are known exactly into the list.
    fn add_multiple(&self, search: &mut Search, polynomial: &PlatformPolynomial) {
        let simple = search.proved();
        let poses = multiple_poses(self.platform, self.squares, polynomial);
        if !poses.is_empty() && search.solver.add_exact(&poses, search.memory, search.assembly) {
            search.assembly.by_high_precision = search.assembly.by_high_precision.min(simple);
        }
    }
}

/// Returns the polynomial of a set of legs, in a variable that distinguishes all poses if there is one.
fn polynomial(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Option<PlatformPolynomial> {
    platform_polynomial(platform, squares).or_else(|| multiple_platform_polynomial(platform, squares))
}

/// Describes the solutions that are no poses.
fn beside(null: usize, curves: bool) -> String {
    match (null, curves) {
        (_, true) => ", beside curves of solutions with N = 0, which are no poses".to_owned(),
        (0, false) => String::new(),
        (null, false) => format!(", beside {null} solutions with N = 0, which are no poses"),
    }
}

/// Returns the bound that a theorem on the geometry gives.
fn at_most(most: usize, why: &str) -> Bound {
    let because = format!("at most {most} that such a platform can have: {why}");
    Bound { count: most, proof: Proof::Proved, code: Code::GeometryBoundMet, because }
}

/// The bound that a basis over the rationals gives.
fn by_points(most: usize) -> Bound {
    let (code, because) = match most {
        0 => (
            Code::NoSolution,
            "0 poses that there can be: over the rationals 1 is a combination of the equations".to_owned(),
        ),
        _ => (
            Code::ExactRootsMatched,
            format!("at most {most} poses that there can be, by a Gröbner basis of the equations over the rationals"),
        ),
    };
    Bound { count: most, proof: Proof::Proved, code, because }
}

/// The number of poses as it is known from one prime.
fn counted(poses: usize, null: usize, curves: bool) -> Bound {
    let because = format!("{poses} poses, counted modulo a prime drawn at random{}", beside(null, curves));
    if poses == MOST_POSES {
        return Bound { count: poses, proof: Proof::Proved, code: Code::GeneralBoundMet, because };
    }
    let proof = Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() };
    Bound { count: poses, proof, code: Code::CountMet, because }
}

/// The number of poses as the degree of their polynomial.
fn by_polynomial(polynomial: &PlatformPolynomial, poses: usize, null: usize, curves: bool) -> Bound {
    let degree = polynomial.coefficients.len() - 1;
    if !polynomial.proved {
        return counted(degree.max(poses), null, curves);
    }
    let because = format!("{degree} that there are, the degree of their exact polynomial{}", beside(null, curves));
    Bound { count: degree, proof: Proof::Proved, code: Code::ExactRootsMatched, because }
}
