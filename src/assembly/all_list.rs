//! All sixteen solutions of one pose of a general arm, side by side in vector registers.
//!
//! The determinant of a cut is a trigonometric polynomial of degree 8 in the hidden angle, with sixteen zeros. Those on the circle are
//! told apart as in [`lane_list`](super::lane_list), with a guess in place of a bound of errors, and the others are sought all at once. Nothing
//! rests on any of this: every solution is [polished and certified](super::lane_finish), and sixteen that are apart are all.

use super::lane_finish::{Finish, Found};
use super::mode::{Mode, are_all_apart};
use super::prepared::PreparedCut;
use super::side_by_side::MOST;
use crate::certify::circle_lanes::{Isolated, Waiting, directions, fourier, isolated};
use crate::certify::circle_zeros::SAMPLES;
use crate::elimination::cut::Hidden;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::disk_roots::{DEGREE, OnCircle, inside};
use crate::solve::lane_brackets::{Brackets, LaneEntries, LaneForms, forms};
use crate::solve::lane_substitution::LaneView;
use crate::solve::lanes::{ComplexLanes, Lanes, WIDTH};
use crate::solve::newton::Six;
use num_complex::Complex;
use pulp::{Arch, Simd, WithSimd};

/// A guess at the error of a value of the determinant, in parts of the largest one. No proof rests on it.
const NOISE: f64 = 1e-14;
/// The leading coefficient in parts of the largest value below which some zeros are at infinity: of general arms it is 1e-4 as a rule.
const LEADING: f64 = 1e-9;
/// Closure errors above this are none of rounding: Newton's steps, all with the inverse of the first place, have not arrived.
const ARRIVED: f64 = 4e-15;
/// Values count no less than this part of the largest one in their mean: no product of them is 0.
const LEAST: f64 = 1e-12;

/// Solutions that f64 does not prove: of 200 poses of general arms 144 had none of them, 31 one pair, 20 two and 4 three.
const FEW: usize = 2;
/// Where more pairs are left, zeros are extraneous as a rule, and to look at each of them in longer numbers would take longer than the pencils.
const MOST_LEFT: usize = 5;

/// The cut and hidden angle of a loop of six rotations in which solutions are looked for.
pub(super) struct AllList {
    arch: Arch,
    view: LaneView,
    forms: LaneForms,
}

/// Solutions that are not certified yet.
pub(super) struct Left {
    starts: [(Six<Complex<f64>>, bool); MOST],
    count: usize,
}

impl Left {
    /// Returns places near them, and whether they are real.
    pub fn starts(&self) -> &[(Six<Complex<f64>>, bool)] {
        &self.starts[..self.count]
    }
}

/// The determinant of a pose.
struct Determinant {
    entries: LaneEntries,
    values: [f64; SAMPLES],
    largest: f64,
}

/// The size of the leading coefficient at a pose in parts of the largest value.
struct Leading<'a> {
    list: &'a AllList,
    closed: &'a ClosedLoop<f64>,
}

/// The search for the solutions of a pose.
struct Task<'a> {
    list: &'a AllList,
    closed: &'a ClosedLoop<f64>,
    finish: Finish<'a>,
    waiting: &'a mut Waiting,
    modes: &'a mut Vec<Mode>,
}

impl AllList {
    /// Prepares a loop, given closed at some places without any property; `None` where no way finds all solutions there, as of special geometries:
    /// they may have fewer, or several with one hidden angle.
    pub fn new(prepared: &[PreparedCut], places: &[ClosedLoop<f64>]) -> Option<Self> {
        let arch = Arch::new();
        let first = places.first().filter(|closed| closed.variables == [Variable::Rotation; 6])?;
        let (mut waiting, mut modes) = (Waiting::default(), Vec::with_capacity(MOST));
        let mut works = |list: &Self| {
            places.iter().any(|closed| {
                modes.clear();
                let left = list.solve(closed, Finish::new(closed, 0.0), &mut waiting, &mut modes);
                left.is_some_and(|left| left.count <= FEW && are_all_apart(&closed.variables, &modes))
            })
        };
        for prepared in prepared {
            let Some(rows) = prepared.rows.as_ref().filter(|_| prepared.cut.constant_index(5) == 5) else { continue };
            let view = LaneView::new(prepared.cut, Hidden::First, &prepared.form.last_monomials, first);
            let forms = LaneForms::new(&forms(rows, &prepared.cut.constant(first, 0).inverse()));
            let mut list = Self { arch, view, forms };
            let leading = arch.dispatch(Leading { list: &list, closed: first });
            list.view.hidden = Hidden::Second;
            if arch.dispatch(Leading { list: &list, closed: first }) < leading {
                list.view.hidden = Hidden::First;
            }
            for _ in 0..2 {
                if works(&list) {
                    return Some(list);
                }
                list.view.hidden = if list.view.hidden == Hidden::First { Hidden::Second } else { Hidden::First };
            }
        }
        None
    }

    /// Lists solutions of a pose with their proofs, and returns those that are left to prove, sixteen in all; `None` where their zeros are not
    /// found, or too many of them are left.
    pub fn solve(
        &self,
        closed: &ClosedLoop<f64>,
        finish: Finish<'_>,
        waiting: &mut Waiting,
        modes: &mut Vec<Mode>,
    ) -> Option<Left> {
        self.arch.dispatch(Task { list: self, closed, finish, waiting, modes })
    }

    /// Returns the determinant at a pose.
    #[inline(always)]
    fn determinant<S: Simd>(&self, simd: S, start: &Motion<f64>) -> Determinant {
        let entries = LaneEntries::of(simd, &self.forms.at_pose(simd, start), self.view.hidden);
        let (cos, sin) = directions();
        let values = entries.determinants(simd, cos, sin);
        let mut largest = 0.0_f64;
        for x in &values {
            largest = largest.max(x.abs());
        }
        Determinant { entries, values, largest }
    }
}

impl Determinant {
    /// Tells the zeros on the circle apart.
    #[inline(always)]
    fn isolated<S: Simd>(&self, simd: S, waiting: &mut Waiting) -> Option<Isolated> {
        isolated(simd, &self.values, [NOISE * self.largest, self.largest], waiting)
    }

    /// Returns the mean of the values by their logarithms.
    #[inline(always)]
    fn mean(&self) -> f64 {
        let mut product = 1.0;
        for x in &self.values {
            product *= (x.abs() / self.largest).max(LEAST);
        }
        self.largest * product.powf(1.0 / SAMPLES as f64)
    }
}

/// Returns the coefficients of the powers of `e^(i q)` that are not negative.
#[inline(always)]
fn powers(fourier: &[f64; SAMPLES]) -> [[f64; 2]; DEGREE + 1] {
    let mut powers = [[0.0; 2]; DEGREE + 1];
    powers[0] = [fourier[0], 0.0];
    for k in 1..=DEGREE {
        powers[k] = [0.5 * fourier[k], -0.5 * fourier[DEGREE + k]];
    }
    powers
}

impl WithSimd for Leading<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [start, _] = self.list.view.ends(self.closed);
        let determinant = self.list.determinant(simd, &start);
        let [re, im] = powers(&fourier(simd, &determinant.values))[DEGREE];
        (re.abs() + im.abs()) / determinant.largest
    }
}

impl WithSimd for Task<'_> {
    type Output = Option<Left>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Option<Left> {
        let (list, one) = (self.list, Lanes::splat(simd, 1.0));
        let ends = list.view.ends(self.closed);
        let determinant = list.determinant(simd, &ends[0]);
        let fourier = fourier(simd, &determinant.values);
        let powers = powers(&fourier);
        let [re, im] = powers[DEGREE];
        if !(re.abs() + im.abs() > LEADING * determinant.largest) {
            return None;
        }
        let real = determinant.isolated(simd, self.waiting)?;
        let mut left = Left { starts: [([Complex::new(0.0, 0.0); 6], false); MOST], count: 0 };
        let (mut cos, mut sin) = ([0.0; 2 * WIDTH], [0.0; 2 * WIDTH]);
        for chunk in 0..real.count.div_ceil(S::F64_LANES) {
            let hidden = real.near(simd, &fourier, chunk);
            hidden[0].store(&mut cos, chunk);
            hidden[1].store(&mut sin, chunk);
        }
        let on = OnCircle { cos: &cos[..real.count], sin: &sin[..real.count] };
        let complex = inside(simd, &powers, on, determinant.mean())?;
        for chunk in 0..real.count.div_ceil(S::F64_LANES) {
            let hidden = [Lanes::load(simd, &cos, chunk), Lanes::load(simd, &sin, chunk)];
            let brackets = Brackets::of(&determinant.entries.at(hidden));
            let found = self.finish.proved(list.view.unknowns(hidden, &brackets, &ends, one), one);
            self.list_lanes(&found, real.count - chunk * S::F64_LANES, S::F64_LANES, &mut left);
        }
        for chunk in 0..complex.count.div_ceil(S::F64_LANES) {
            let w =
                ComplexLanes { re: Lanes::load(simd, &complex.re, chunk), im: Lanes::load(simd, &complex.im, chunk) };
            let brackets = Brackets::of(&determinant.entries.times_exponential(w));
            let hidden = ComplexLanes::of_exponential(w);
            let found = self.finish.proved(list.view.unknowns(hidden, &brackets, &ends, one), one);
            self.list_lanes(&found, complex.count - chunk * S::F64_LANES, S::F64_LANES, &mut left);
        }
        (left.count <= MOST_LEFT).then_some(left)
    }
}

impl Task<'_> {
    /// Lists what is certified of the first lanes, with conjugates, and takes note of the rest.
    #[inline(always)]
    fn list_lanes(&mut self, found: &Found, count: usize, width: usize, left: &mut Left) {
        for lane in 0..count.min(width) {
            let Some(mode) = found.mode(lane).filter(|mode| mode.residual < ARRIVED) else {
                if let Some(start) = left.starts.get_mut(left.count) {
                    *start = (found.unknowns(lane), found.is_real());
                    left.count += 1;
                }
                continue;
            };
            if !mode.real {
                self.modes.push(mode.conjugate());
            }
            self.modes.push(mode);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::assembly::side_by_side::tests::prepared;
    use crate::assembly::{Assembly, Roots, Workspace, distance};
    use crate::kinematics::closed_loop::Variable;
    use crate::kinematics::motion::Motion;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::PI;

    const UNKNOWNS: [Variable; 6] = [Variable::Rotation; 6];

    /// Returns an arm: a general one, a badly scaled one, or one with two neighbouring axes that are parallel.
    fn arm(kind: usize, random: &mut ChaCha8Rng) -> [Motion<f64>; 6] {
        std::array::from_fn(|k| {
            let mut value = |size: f64| random.random_range(-size..size);
            let (mut a, mut twist, d) = (value(1.0), value(PI), value(1.0));
            match kind {
                1 => a *= 10_f64.powf(value(1.5)),
                2 if k == 1 => twist = 0.0,
                _ => {}
            }
            Motion { translation: [a, 0.0, d], ..Motion::rotation_x(twist.cos(), twist.sin()) }
        })
    }

    #[test]
    fn lists_are_those_of_the_pencils() {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let mut workspace = Workspace::default();
        let (mut quick, mut slow) = (Assembly::default(), Assembly::default());
        let (mut side_by_side, mut compared, mut close) = (0, 0, 0);
        for number in 0..300 {
            let links = arm(number % 3, &mut random);
            let (lanes, pencils) = (prepared(&links), prepared(&links).by_pencils_alone());
            let mut reached = Motion::<f64>::identity();
            for link in &links {
                let (sin, cos) = random.random_range(-PI..PI).sin_cos();
                reached = reached.then_after(&Motion::rotation_z(cos, sin)).then_after(link);
            }
            let gap = lanes.gap(&reached.inverse());
            lanes.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut workspace, &mut quick);
            pencils.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut workspace, &mut slow);
            side_by_side += usize::from(quick.tries == 0);
            if quick.tries > 0 {
                continue;
            }
            assert!(quick.all_resolved && quick.real_resolved && quick.total() == 16, "arm {number}");
            assert!(quick.modes.iter().all(|mode| mode.certificate.is_some()), "arm {number}");
            // Pencils may leave solutions unproved or out.
            if slow.modes.len() < 16 || slow.modes.iter().any(|mode| mode.certificate.is_none()) {
                continue;
            }
            compared += 1;
            assert_eq!(quick.real(), slow.real(), "arm {number}");
            for mode in &quick.modes {
                let is_it = |other: &&crate::assembly::Mode| {
                    let radius = |mode: &crate::assembly::Mode| mode.certificate.map_or(f64::NAN, |proof| proof.radius);
                    distance(&UNKNOWNS, &mode.unknowns, &other.unknowns) <= radius(mode) + radius(other)
                };
                let same: Vec<_> = slow.modes.iter().filter(is_it).collect();
                assert_eq!(same.len(), 1, "arm {number}: {mode:?}");
                assert_eq!(same[0].real, mode.real);
                if distance(&UNKNOWNS, &mode.unknowns, &same[0].unknowns) < 1e-9 {
                    close += 1;
                }
            }
        }
        // One badly scaled arm in ten has solutions so far away that the pencils are asked.
        assert!(side_by_side > 250 && compared > 250, "{side_by_side} side by side, {compared} compared");
        assert!(close * 1000 > 16 * compared * 995, "{close} of {} within 1e-9", 16 * compared);
    }

    #[test]
    fn arms_of_closed_forms_and_dependent_joints_have_no_such_list() {
        let mut random = ChaCha8Rng::seed_from_u64(12);
        let general = arm(0, &mut random);
        assert!(prepared(&general).all_list().is_some());
        // Three axes that meet.
        let mut wrist = general.clone();
        for link in &mut wrist[3..5] {
            link.translation = [0.0; 3];
        }
        assert!(prepared(&wrist).all_list().is_none());
        // Two joints about one axis.
        let mut dependent = general;
        dependent[2] = Motion { translation: [0.0, 0.0, 0.3], ..Motion::identity() };
        assert!(prepared(&dependent).all_list().is_none());
    }
}
