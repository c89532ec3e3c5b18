//! The search for one set of leg lengths: eigenvalue after eigenvalue, until all are resolved.

use super::candidate::candidates;
use super::coincident::has_point_leg;
use super::mode::{PlatformAssembly, PlatformMode};
use super::prepared::{Chart, Frame, LegNumbers, norm};
use super::self_motion::self_motion;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::assembly::Roots;
use crate::certify::Certificate;
use crate::certify::pose::{Curvature, are_apart, is_complex, is_pose, pose_certificate};
use crate::closure::study::{Four, Leg};
use crate::elimination::border::{BorderBasis, DIMENSION, Setting};
use crate::solve::pose::{
    Eight, PolishedPose, complex, equations, normalised, patch, polish, polish_extended, refine, wide,
};
use crate::solve::scalar::{Extended, Number, Scalar, narrowed};
use crate::solve::spectrum::Spectrum;
use num_complex::Complex;

/// |Im| / (1 + |lambda|) below which an eigenvalue may belong to a real pose: double ones split by 1e-8 and more.
const NEAR_REAL: f64 = 1e-4;
/// The same bound with a leg of length zero: every set of such legs gives one multiple eigenvalue, which splits much farther.
const POINT_LEG: f64 = 0.2;
/// Imaginary parts below this are rounding errors at a real pose.
pub const REAL_PART: f64 = 1e-7;
/// |N| (with x of hermitian norm 1) below which an eigenvalue that leads to no regular pose is counted as one without a
/// pose.
const NULL: f64 = 1e-6;
/// The same bound for multiple eigenvalues, which are less accurate.
const NEARLY_NULL: f64 = 1e-2;
/// |N| below which a pose counts only if it is proved: points of families with `N = 0` look like it.
const DOUBTFUL: f64 = 1e-4;
/// Eigenvalues nearer to each other than this may be one multiple eigenvalue.
const CLUSTER: f64 = 1e-3;
/// Maximum number of real rotations without a pose that are kept.
const STRAYS: usize = 8;
/// Error bound assumed for solutions that are not proved.
const SINGULAR: f64 = 1e-4;
/// Rotations whose quaternions have `|x.conj(x')|^2` below `1 - SAME` are different without further tests.
const SAME: f64 = 1e-6;

/// A solution found.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Study's parameters in the frame of polishing; of a conjugate pair only one solution is stored.
    pub study: Eight<Complex<f64>>,
    /// Whether it is real.
    pub real: bool,
    /// The certificate, if there is one.
    pub certificate: Option<Certificate>,
    residual: f64,
    condition: f64,
    /// Number of eigenvalues of the last border basis that lead to it.
    pub eigenvalues: usize,
    /// Index of the last of these eigenvalues.
    last: usize,
    /// The number of solutions that coincide here, if it is proved.
    exact: Option<usize>,
}

impl Found {
    /// Returns the number of solutions that coincide here: 1 if the solution is proved to be simple.
    fn multiplicity(&self) -> usize {
        match (self.exact, self.certificate) {
            (Some(exact), _) => exact,
            (None, Some(_)) => 1,
            (None, None) => self.eigenvalues,
        }
    }

    /// Returns a multiple solution that is known exactly.
    pub fn exact(study: Eight<Complex<f64>>, real: bool, radius: f64, multiplicity: usize) -> Self {
        Self {
            study,
            real,
            certificate: Some(Certificate { radius, isolation: radius, proved: radius }),
            residual: 0.0,
            condition: f64::INFINITY,
            eigenvalues: multiplicity,
            last: usize::MAX,
            exact: Some(multiplicity),
        }
    }
}

/// The origin of a set of eigenvalues.
pub struct Source<'a> {
    /// The rotation and scaling of the platform.
    pub chart: &'a Chart,
    /// The setting from which its border basis was computed.
    pub setting: &'a Setting<f64>,
    /// The border basis.
    pub basis: &'a BorderBasis<f64>,
}

/// The search for the poses at one set of leg lengths.
pub struct Search<'a> {
    /// The legs, on which solutions are polished.
    pub legs: &'a [Leg<f64>; 6],
    /// The legs in double-double arithmetic.
    pub wide: &'a [Leg<DoubleDouble>; 6],
    /// Bounds on the second derivatives of their equations.
    pub curvature: &'a Curvature,
    /// The roots that are requested.
    pub roots: Roots,
    /// The number of poses, if it is known.
    pub expected: Option<usize>,
    /// The most poses that the geometry allows, if a theorem bounds them.
    pub most: Option<usize>,
    /// The solutions found, without conjugates.
    pub found: &'a mut Vec<Found>,
    /// Number of eigenvalues that belong to no pose.
    pub null: usize,
    /// Number of eigenvalues that led to nothing.
    pub lost: usize,
    /// Whether any border basis was followed.
    pub followed: bool,
    /// Whether the eigenvalue followed now is one of two conjugate ones.
    pub followed_pair: bool,
    /// Points with hardly any N that the eigenvalues followed now lead to.
    doubtful: Vec<Doubtful>,
    /// Real rotations that led to no regular pose and may belong to a self-motion.
    pub stray: [Option<Eight<f64>>; STRAYS],
}

/// A point at which N may be 0, so that it is no pose, or a pose very far away.
#[derive(Clone, Copy, Debug)]
struct Doubtful {
    start: Eight<Complex<f64>>,
    /// The eigenvalue that leads to it.
    eigenvalue: usize,
}

/// The result of following one eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Pose,
    Null,
    Nothing,
}

impl<'a> Search<'a> {
    /// Starts a search with an empty list.
    pub fn new(numbers: &'a LegNumbers, roots: Roots, expected: Option<usize>, found: &'a mut Vec<Found>) -> Self {
        found.clear();
        Self::going_on(numbers, roots, expected, found)
    }

    /// Continues a search with the solutions already found.
    pub fn going_on(numbers: &'a LegNumbers, roots: Roots, expected: Option<usize>, found: &'a mut Vec<Found>) -> Self {
        Self {
            legs: &numbers.legs,
            wide: &numbers.wide,
            curvature: &numbers.curvature,
            roots,
            expected,
            most: None,
            found,
            null: 0,
            lost: 0,
            followed: false,
            followed_pair: false,
            doubtful: Vec::new(),
            stray: [None; STRAYS],
        }
    }

    /// Returns the dimension of the largest self-motion through the poses that are not isolated, and a point near it.
    pub fn self_motion(&self) -> Option<(usize, Eight<f64>)> {
        let singular = self.found.iter().filter(|f| f.real && f.certificate.is_none());
        let singular = singular.map(|f| f.study.map(|z| z.re));
        let points = singular.chain(self.stray.iter().copied().flatten());
        points
            .map(|v| (self_motion(self.legs, &v), v))
            .filter(|(dimension, _)| *dimension > 0)
            .max_by_key(|found| found.0)
    }

    /// Returns the number of resolved solutions that are poses, conjugates included.
    pub fn poses(&self) -> usize {
        self.found.iter().map(|f| f.multiplicity() * if f.real { 1 } else { 2 }).sum()
    }

    /// Returns the number of missing poses, or else of unresolved eigenvalues of the last border basis.
    pub fn unresolved(&self) -> usize {
        match self.roots {
            Roots::Real => self.lost,
            Roots::All => match self.expected {
                Some(expected) => expected.saturating_sub(self.poses()),
                None => DIMENSION.saturating_sub(self.poses() + self.null),
            },
        }
    }

    /// Returns whether a border basis was followed and none of its eigenvalues is unresolved.
    pub fn is_done(&self) -> bool {
        self.followed && self.unresolved() == 0
    }

    /// Returns whether fewer poses were found than the known number.
    pub fn lacks_known_poses(&self) -> bool {
        self.roots == Roots::All && self.expected.is_some_and(|expected| self.poses() < expected)
    }

    /// Returns whether all poses were found, if their number is known.
    pub fn has_all_known_poses(&self) -> bool {
        self.roots == Roots::All && self.expected.is_some_and(|expected| self.poses() >= expected)
    }

    /// Follows all eigenvalues of a border basis.
    pub fn all_eigenvalues(&mut self, source: &Source, spectrum: &mut Spectrum<DIMENSION>) {
        (self.null, self.lost, self.followed) = (0, 0, true);
        let point_leg = has_point_leg(self.legs);
        for found in self.found.iter_mut() {
            found.eigenvalues = 0;
        }
        self.doubtful.clear();
        let weight = |value: Complex<f64>| if value.im > 0.0 { 2 } else { 1 };
        let mut outcomes = [Outcome::Pose; DIMENSION];
        for k in 0..DIMENSION {
            let value = spectrum.values[k];
            let near_real = value.im.abs() <= NEAR_REAL * (1.0 + value.norm());
            let may_be_real = near_real || (point_leg && value.im <= POINT_LEG * (1.0 + value.norm()));
            if value.im < 0.0 || (self.roots == Roots::Real && !may_be_real) {
                continue;
            }
            self.followed_pair = value.im > 0.0;
            let mut outcome = Outcome::Nothing;
            if value.im == 0.0 {
                outcome = self.real_eigenvalue(k, source, spectrum);
            }
            if outcome == Outcome::Nothing && (value.im != 0.0 && near_real || self.roots == Roots::All) {
                outcome = self.complex_eigenvalue(k, near_real, source, spectrum);
            }
            if outcome != Outcome::Pose && point_leg && value.im <= POINT_LEG * (1.0 + value.norm()) {
                outcome = self.coincident_ends(k, source, spectrum).unwrap_or(outcome);
            }
            outcomes[k] = outcome;
        }
        if !self.has_most_poses() {
            for Doubtful { start, eigenvalue } in std::mem::take(&mut self.doubtful) {
                if self.far_away(self.wide, &start.map(wide)) {
                    outcomes[eigenvalue] = Outcome::Pose;
                }
            }
        }
        // Where a theorem allows no further pose, the other eigenvalues have none.
        let has_most = self.has_most_poses();
        for (outcome, value) in outcomes.into_iter().zip(spectrum.values) {
            match outcome {
                Outcome::Pose => {}
                Outcome::Nothing if !has_most => self.lost += weight(value),
                Outcome::Null | Outcome::Nothing => self.null += weight(value),
            }
        }
    }

    /// Returns whether as many certified poses were found as a theorem allows.
    fn has_most_poses(&self) -> bool {
        let certified =
            self.found.iter().filter(|found| found.certificate.is_some()).map(|found| if found.real { 1 } else { 2 });
        self.roots == Roots::All && self.most.is_some_and(|most| certified.sum::<usize>() >= most)
    }

    /// Follows eigenvalue k to a real pose at which the ends of legs of length zero coincide.
    fn coincident_ends(&mut self, k: usize, source: &Source, spectrum: &mut Spectrum<DIMENSION>) -> Option<Outcome> {
        let z = rotation::<Complex<f64>>(spectrum.values[k], k, source.basis, spectrum)?;
        let candidates = candidates(source.setting, &z);
        let starts = candidates.study[..candidates.count].iter();
        let found = starts.filter(|(x, y)| self.coincide(&source.chart.outward(x, y), k)).count();
        (found > 0).then_some(Outcome::Pose)
    }

    fn real_eigenvalue(&mut self, k: usize, source: &Source, spectrum: &mut Spectrum<DIMENSION>) -> Outcome {
        let value = spectrum.values[k].re;
        let Some(z) = rotation::<f64>(value, k, source.basis, spectrum) else { return Outcome::Nothing };
        let mut outcome = Outcome::Nothing;
        let candidates = candidates(source.setting, &z);
        for (x, y) in &candidates.study[..candidates.count] {
            let start = source.chart.outward(x, y);
            if let Some(polished) = polish(self.legs, &start) {
                self.admit(&polished, k);
                outcome = Outcome::Pose;
            } else if let Some(free) = self.stray.iter_mut().find(|s| s.is_none()) {
                *free = Some(start);
            }
        }
        outcome
    }

    fn complex_eigenvalue(
        &mut self,
        k: usize,
        near_real: bool,
        source: &Source,
        spectrum: &mut Spectrum<DIMENSION>,
    ) -> Outcome {
        let value = spectrum.values[k];
        let Some(z) = rotation::<Complex<f64>>(value, k, source.basis, spectrum) else { return Outcome::Nothing };
        let candidates = candidates(source.setting, &z);
        let size: f64 = z.iter().map(Complex::norm_sqr).sum();
        let raw = z.iter().map(|z| z * z).sum::<Complex<f64>>().norm() / size;
        let multiple =
            (0..DIMENSION).any(|j| j != k && (spectrum.values[j] - value).norm() < CLUSTER * (1.0 + value.norm()));
        let null = raw < if multiple { NEARLY_NULL } else { NULL };
        let mut outcome = if null { Outcome::Null } else { Outcome::Nothing };
        for (x, y) in &candidates.study[..candidates.count] {
            let start = source.chart.outward(x, y);
            if near_real {
                // Both ends of a pair that meets on the real axis.
                for real in real_parts(&start) {
                    if let Some(polished) = polish(self.legs, &real) {
                        self.admit(&polished, k);
                        outcome = Outcome::Pose;
                    }
                }
                if self.roots == Roots::Real {
                    continue;
                }
            }
            let polished = polish(self.legs, &start).filter(|p| !near_null(p));
            let Some(polished) = polished else {
                if raw < NEARLY_NULL && !multiple {
                    self.doubtful.push(Doubtful { start, eigenvalue: k });
                }
                continue;
            };
            outcome = Outcome::Pose;
            let snapped = real_parts(&polished.study)[2];
            let imaginary = polished.study.iter().zip(&snapped).map(|(z, r)| z.norm() - r.abs()).fold(0.0, f64::max);
            if imaginary < REAL_PART
                && let Some(real) = polish(self.legs, &snapped)
                && !are_apart(&complex(&real.study), REAL_PART, &polished.study, REAL_PART)
            {
                self.admit(&real, k);
                continue;
            }
            self.admit(&polished, k);
        }
        outcome
    }

    /// Finds and proves solutions near points known in more digits, and proves those found without a certificate.
    pub fn proved_near<R: Extended>(&mut self, legs: &[Leg<R>; 6], starts: &[Eight<Complex<R>>]) {
        for start in starts {
            self.far_away(legs, start);
        }
        if self.lacks_known_poses() || self.expected.is_none() {
            return;
        }
        // All poses are proved, so the others are none.
        let proved: usize =
            self.found.iter().filter(|f| f.certificate.is_some()).map(|f| if f.real { 1 } else { 2 }).sum();
        if self.expected == Some(proved) {
            self.found.retain(|found| found.certificate.is_some());
        }
    }

    /// Takes in a pose so far away that it needs more digits. Returns whether there is one that is proved.
    pub fn far_away<R: Extended>(&mut self, legs: &[Leg<R>; 6], start: &Eight<Complex<R>>) -> bool {
        let found = self.proved(legs, start, false).or_else(|| {
            // A ball about a real point holds one solution only if that is real.
            let best = largest(start).conjugate();
            let real = start.map(|z| Complex::<R>::from_real(z.mul(&best).re));
            self.proved(legs, &real, true)
        });
        let Some(found) = found else { return false };
        let radius = found.certificate.map_or(SINGULAR, |certificate| certificate.radius);
        match self.known(&found.study, found.real, radius) {
            Some(at) if self.found[at].certificate.is_none() && (found.real || !self.found[at].real) => {
                self.found[at] = found;
            }
            Some(_) => {}
            None => self.found.push(found),
        }
        true
    }

    /// Returns the pose near a point in more digits, if there is one and it is proved to be real or complex as requested.
    fn proved<R: Extended>(&self, legs: &[Leg<R>; 6], start: &Eight<Complex<R>>, real: bool) -> Option<Found> {
        let (point, there, inverse) = polish_extended(legs, start)?;
        let proof = pose_certificate(self.legs, self.curvature, &point, &there, &inverse)?;
        let study = point.map(narrowed);
        let certificate = rounded(proof, &study);
        let as_it_should_be = real || is_complex(&study, certificate.radius);
        if !is_pose(&point, proof.radius) || !as_it_should_be {
            return None;
        }
        let inverse = inverse.map(|row| row.map(narrowed));
        let here = equations(self.legs, &study, &patch(&study));
        Some(Found {
            study,
            real,
            certificate: Some(certificate),
            residual: here.residual(),
            condition: here.condition(&inverse),
            eigenvalues: 1,
            last: usize::MAX,
            exact: None,
        })
    }

    /// Returns the index of a solution known to within `least`, or of its conjugate.
    fn known(&self, study: &Eight<Complex<f64>>, real: bool, least: f64) -> Option<usize> {
        // Points of two balls differ by the sum of their radii, in each of eight coordinates.
        let same_rotation = |w: &Eight<Complex<f64>>, conjugate: bool, room: f64| {
            let product: Complex<f64> = (0..4).map(|k| study[k] * if conjugate { w[k] } else { w[k].conj() }).sum();
            product.norm_sqr() > 1.0 - SAME - 64.0 * room * room
        };
        // Regular solutions are polished to rounding, so more distant points are different ones. Singular solutions are less
        // accurate; solutions known more accurately are distinguished by their certificates.
        self.found.iter().position(|found| {
            let room = found.certificate.map_or(SINGULAR, |c| c.radius.max(least.min(REAL_PART)));
            let same = |w: &Eight<Complex<f64>>| !are_apart(study, room.max(least), w, room);
            let reach = room + least;
            (same_rotation(&found.study, false, reach) && same(&found.study))
                || (!real && same_rotation(&found.study, true, reach) && same(&found.study.map(|z| z.conj())))
        })
    }

    /// Adds a polished solution to the list unless it is there.
    pub fn admit<S: Scalar>(&mut self, polished: &PolishedPose<S>, eigenvalue: usize) {
        let mut study = complex(&polished.study);
        if let Some(at) = self.known(&study, S::REAL, REAL_PART) {
            self.count(at, eigenvalue);
            return;
        }
        let (legs, curvature) = (self.legs, self.curvature);
        let proof = pose_certificate(legs, curvature, &polished.study, &polished.equations, &polished.inverse);
        let mut certificate = proof.filter(|c| holds(c, &study, S::REAL));
        if certificate.is_none() {
            // Once more in double-double arithmetic.
            let inverse = polished.inverse.map(|row| row.map(Scalar::to_complex));
            certificate = refine(self.wide, &study, &inverse).and_then(|(point, there)| {
                let inverse = inverse.map(|row| row.map(wide));
                let proof = pose_certificate(legs, curvature, &point, &there, &inverse)?;
                study = point.map(narrowed);
                holds(&proof, &study, S::REAL).then(|| rounded(proof, &study))
            });
        }
        if certificate.is_none() && norm(&study).norm() < DOUBTFUL {
            return;
        }
        // The proved solutions must be different: a wide ball may contain another.
        certificate = certificate.filter(|c| c.radius <= REAL_PART || self.known(&study, S::REAL, c.radius).is_none());
        let residual = if study == complex(&polished.study) {
            polished.equations.residual()
        } else {
            equations(legs, &study, &patch(&study)).residual()
        };
        self.found.push(Found {
            study,
            real: S::REAL,
            certificate,
            residual,
            condition: polished.equations.condition(&polished.inverse),
            eigenvalues: 0,
            last: usize::MAX,
            exact: None,
        });
        self.count(self.found.len() - 1, eigenvalue);
    }

    /// Counts an eigenvalue for a solution, once; of a conjugate pair only one is followed.
    fn count(&mut self, at: usize, eigenvalue: usize) {
        let found = &mut self.found[at];
        if found.eigenvalues == 0 || found.last != eigenvalue {
            found.eigenvalues += if found.real && self.followed_pair { 2 } else { 1 };
            found.last = eigenvalue;
        }
    }
}

/// Adds a pose that is proved, unless it is in the list.
pub fn take_in(list: &mut Vec<Found>, pose: Found) {
    let radius = |found: &Found| found.certificate.map_or(SINGULAR, |c| c.radius);
    let is_apart = |other: &Found| {
        let apart = |w: &Eight<Complex<f64>>| are_apart(&pose.study, radius(&pose), w, radius(other));
        apart(&other.study) && apart(&other.study.map(|z| z.conj()))
    };
    if list.iter().all(is_apart) {
        list.push(pose);
    }
}

/// Writes the list, real poses first.
pub fn tell(found: &[Found], frame: &Frame, assembly: &mut PlatformAssembly) {
    for real in [true, false] {
        for found in found.iter().filter(|f| f.real == real) {
            assembly.modes.push(mode(found, frame, false));
            if !real {
                assembly.modes.push(mode(found, frame, true));
            }
        }
    }
}

/// A generous bound on the rounding error of coordinates of a point of hermitian norm 1 in f64.
pub const ROUNDED: f64 = 1e-15;

/// Returns whether a polished solution may belong to a family with `N = 0`.
pub fn near_null(polished: &PolishedPose<Complex<f64>>) -> bool {
    norm(&polished.study).norm() < DOUBTFUL && polished.step > NULL * DOUBTFUL
}

/// Returns the largest coordinate of the rotation.
fn largest<S: Number>(v: &Eight<S>) -> S {
    v[1..4].iter().fold(v[0], |best, z| if z.square_size() > best.square_size() { *z } else { best })
}

/// Enlarges the certificate of a point that was rounded to f64 afterwards.
fn rounded(proof: Certificate, study: &Eight<Complex<f64>>) -> Certificate {
    let reach = study.iter().map(|z| z.norm()).fold(1.0, f64::max);
    Certificate { radius: proof.radius + ROUNDED * reach, ..proof }
}

/// Returns whether the proved solution is a pose, and real or not as it seems. The point may have been rounded to f64
/// since: every coordinate relative to itself, those of x relative to 1.
fn holds(certificate: &Certificate, study: &Eight<Complex<f64>>, real: bool) -> bool {
    let radius = certificate.radius + ROUNDED;
    is_pose(study, radius) && (real || is_complex(study, rounded(*certificate, study).radius))
}

/// Returns the rotation z of eigenvalue k, of any length, from quotients at the largest entry of the eigenvector.
fn rotation<S: Scalar>(
    value: S,
    k: usize,
    basis: &BorderBasis<f64>,
    spectrum: &mut Spectrum<DIMENSION>,
) -> Option<Four<S>> {
    let mut vector: [S; DIMENSION] = spectrum.vector(k);
    let best = (1..DIMENSION).fold(0, |best, b| if vector[b].size() > vector[best].size() { b } else { best });
    for (x, scale) in vector.iter_mut().zip(&spectrum.balance) {
        *x = x.times(*scale);
    }
    let at = vector[best];
    let times = |i: usize| {
        let row = &basis.products[i][best];
        row.iter().zip(&vector).fold(S::zero(), |sum, (c, x)| sum.add(&x.times(*c))).over(at)
    };
    let z = [S::one(), value, times(1), times(2)];
    let size = z.iter().map(|x| x.size()).fold(0.0, f64::max);
    size.is_finite().then(|| z.map(|x| x.times(1.0 / size)))
}

/// Returns three real points near a nearly real one: to both sides of it, and its real part.
pub fn real_parts(v: &Eight<Complex<f64>>) -> [Eight<f64>; 3] {
    let best = (1..4).fold(0, |best, k| if v[k].norm_sqr() > v[best].norm_sqr() { k } else { best });
    let phase = v[best].conj() / v[best].norm();
    let turned = v.map(|z| z * phase);
    [turned.map(|z| z.re + z.im), turned.map(|z| z.re - z.im), turned.map(|z| z.re)]
}

fn mode(found: &Found, frame: &Frame, conjugate: bool) -> PlatformMode {
    let mut study = found.study;
    if conjugate {
        study = study.map(|z| z.conj());
    }
    let study = normalised(&study).unwrap_or(study);
    let best = (1..4).fold(0, |best, k| if study[k].norm_sqr() > 1.01 * study[best].norm_sqr() { k } else { best });
    let mut phase = study[best].conj() / study[best].norm();
    if found.real {
        let first = (0..4).find(|&k| (study[k] * phase).re.abs() > 1e-15).unwrap_or(0);
        phase = Complex::from((study[first] * phase).re.signum()) * phase;
    }
    let turned = study.map(|z| z * phase);
    let clean = |z: Complex<f64>| if found.real { Complex::from(z.re) } else { z };
    let quaternion = std::array::from_fn(|k| clean(turned[k]));
    PlatformMode {
        quaternion,
        study: turned.map(clean),
        position: frame.position(&turned).map(clean),
        real: found.real,
        multiplicity: found.multiplicity(),
        residual: found.residual,
        condition: found.condition,
        certificate: found.certificate,
        norm: norm(&turned).norm(),
        mirror: None,
    }
}
