//! Arms with a spherical wrist or three parallel axes: all solutions by closed forms, if as many are certified as the geometry
//! allows.

use super::lane_finish::Finish;
use super::mode::{Mode, are_all_apart};
use super::search::Search;
use super::side_by_side::{Done, Pairs, SideBySide};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::long_float::LongNumber;
use crate::certify::{from_pairs, refined_exactly, refined_real_of};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::solve::decoupled::{Decoupled, FormNumber};
use crate::solve::newton::Six;
use crate::solve::scalar::Scalar;
use num_complex::Complex;
use pulp::Arch;
use std::cell::LazyCell;

/// Numbers of 192 bits. A pose of doubles may be 1e-16 from a singular one: then a certificate compares squares of 1e16 with a
/// rounding, and 1e-32 of double-double numbers is not small enough. In a browser numbers of 384 bits, which the page holds anyway, take
/// their place, so that it is smaller.
pub type Crowded = LongNumber<{ if cfg!(target_arch = "wasm32") { 6 } else { 3 } }>;
/// A loop of exact constants, rounded once.
pub(super) type Exact = ClosedLoop<DoubleDouble>;
/// The same, made where it is first asked for.
pub(super) type Lazy<'a> = LazyCell<Option<Exact>, &'a dyn Fn() -> Option<Exact>>;
/// No constants but those that are stored.
pub(super) const STORED: &dyn Fn() -> Option<Exact> = &|| None;

/// A loop closed at a pose, rounded once from exact data to numbers of more digits, where they are asked for.
#[derive(Clone, Copy)]
pub struct Rounded<'a> {
    /// To double-double numbers.
    pub double: &'a dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
    /// To numbers of 192 bits.
    pub crowded: &'a dyn Fn() -> Option<ClosedLoop<Crowded>>,
}

impl Rounded<'_> {
    /// Nothing is known but stored constants.
    pub(super) const STORED: Rounded<'static> = Rounded { double: STORED, crowded: &|| None };
}

impl Search<'_> {
    /// Lists the candidates of the closed form, if there is one. Returns whether as many are proved as the loop can have;
    /// otherwise it lists nothing and the pencils decide. `exact` gives the loop, scaled.
    pub(super) fn by_closed_form(&mut self, most: &dyn Fn(usize) -> usize, exact: Rounded<'_>) -> bool {
        let Some(decoupled) = self.decoupled else { return false };
        let is_proved =
            self.candidates(decoupled, most, exact.double) || self.crowded_candidates(decoupled, most, exact);
        if is_proved {
            self.assembly.all_resolved = true;
        } else {
            self.assembly.clear();
        }
        is_proved
    }

    /// Lists the candidates found in f64. Returns whether they are proved and all.
    fn candidates(
        &mut self,
        decoupled: Decoupled,
        most: &dyn Fn(usize) -> usize,
        exact: &dyn Fn() -> Option<Exact>,
    ) -> bool {
        let candidates = decoupled.candidates(self.closed);
        if candidates.count() < most(candidates.count()) {
            return false;
        }
        let (real, complex) = (candidates.real(), candidates.complex());
        let done = self.side_by_side(real, complex);
        // What is not proved side by side is looked at alone.
        let exact = LazyCell::new(exact);
        self.alone(real, &done[0], &exact) && self.alone(complex, &done[1], &exact) && self.has_proved_all(most)
    }

    /// Lists the candidates found in numbers of more digits: next to a singular position, those of f64 are rounding errors. Returns
    /// whether they are proved and all.
    fn crowded_candidates(&mut self, decoupled: Decoupled, most: &dyn Fn(usize) -> usize, exact: Rounded<'_>) -> bool {
        self.assembly.clear();
        let Some(closed) = (exact.crowded)() else { return false };
        let candidates = decoupled.candidates(&closed);
        if candidates.count() < most(candidates.count()) {
            return false;
        }
        let (real, complex) = (candidates.real(), candidates.complex());
        let rounded = candidates.rounded();
        let done = self.side_by_side(rounded.real(), rounded.complex());
        self.alone_in(&closed, real, &done[0]) && self.alone_in(&closed, complex, &done[1]) && self.has_proved_all(most)
    }

    /// Lists the candidates that are proved side by side, and returns which.
    fn side_by_side(&mut self, real: &[Pairs<f64>], complex: &[Pairs<Complex<f64>>]) -> [Done; 2] {
        let finish = Finish::new(self.closed, self.gap_rounding);
        Arch::new().dispatch(SideBySide { finish, real, complex, modes: &mut self.assembly.modes })
    }

    fn has_proved_all(&self, most: &dyn Fn(usize) -> usize) -> bool {
        are_all_apart(&self.closed.variables, &self.assembly.modes) && self.is_full(self.proved(), most)
    }

    /// Lists the candidates that are not done, for the loop of exact constants. Returns whether all are proved.
    fn alone_in<S: FormNumber<Real = Crowded, Complex = Complex<Crowded>>>(
        &mut self,
        closed: &ClosedLoop<Crowded>,
        starts: &[Pairs<S>],
        done: &Done,
    ) -> bool {
        starts.iter().zip(done).all(|(pairs, done)| {
            let prove = || from_pairs(closed, &pairs.map(|(cos, sin)| (cos.lifted(), sin.lifted())));
            *done || prove().map(|refined| self.refined_mode(refined)).is_some_and(|mode| self.list(mode, S::REAL))
        })
    }

    /// Lists the candidates that are not done, by longer numbers. Returns whether all are proved.
    pub(super) fn alone<S: Scalar>(&mut self, starts: &[Pairs<S>], done: &Done, exact: &Lazy<'_>) -> bool {
        starts.iter().zip(done).all(|(pairs, done)| {
            let start = || pairs.map(|(cos, sin)| S::angle_of(cos, sin).to_complex());
            *done || self.one_alone(&start(), S::REAL, exact)
        })
    }

    /// Lists the solution near a place, a real one or not, by longer numbers. Returns whether it is proved.
    pub(super) fn one_alone(&mut self, start: &Six<Complex<f64>>, is_real: bool, exact: &Lazy<'_>) -> bool {
        let real = || refined_real_of(self.closed, &start.map(|z| z.re), self.gap_rounding);
        // Near singular positions the rounding of the pose to f64 moves a solution beyond its neighbour.
        let exact = || refined_exactly(exact.as_ref()?, start);
        let refined = (if is_real { real() } else { None }).or_else(exact).map(|refined| self.refined_mode(refined));
        refined.or_else(|| self.proved_mode(start)).is_some_and(|mode| self.list(mode, is_real))
    }

    /// Lists a proved solution, and its conjugate. Returns whether it is of the kind that it was taken for.
    fn list(&mut self, mode: Mode, is_real: bool) -> bool {
        if mode.real != is_real {
            return false;
        }
        if !mode.real {
            self.assembly.modes.push(mode.conjugate());
        }
        self.assembly.modes.push(mode);
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::assembly::{Assembly, Roots, Solver, Workspace, distance};
    use crate::kinematics::closed_loop::{OpenLoop, Variable};
    use crate::kinematics::motion::Motion;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::PI;

    /// Returns a general link, one between axes that cross in the origin behind it, or one between parallel axes.
    fn link(kind: char, random: &mut ChaCha8Rng) -> Motion<f64> {
        let mut length = || random.random_range(-1.0..1.0);
        let translation = match kind {
            'x' => [0.0; 3],
            _ => [length(), length(), length()],
        };
        let angle = random.random_range(0.3..2.8);
        let turn = match kind {
            'p' => Motion::rotation_z(f64::cos(angle), f64::sin(angle)),
            // Antiparallel axes.
            'a' => Motion::rotation_z(f64::cos(angle), f64::sin(angle)).then_after(&Motion::rotation_x(-1.0, 0.0)),
            _ => Motion::rotation_z(0.6, 0.8).then_after(&Motion::rotation_x(f64::cos(angle), f64::sin(angle))),
        };
        Motion { translation, ..turn }
    }

    #[test]
    fn closed_forms_find_what_pencils_find() {
        let variables = [Variable::Rotation; 6];
        // A wrist or three parallel axes at every place; some arms have more axes that cross or are parallel.
        let links = ["xxggg", "gxxgg", "ggxxg", "gggxx", "ppggg", "gppgg", "ggppg", "gggpp", "gaagg", "gpggg"];
        let links = links.iter().chain(&["xpgxx", "gpgxx", "xgpxx", "xgxxg", "xppxg", "gppxx", "gppxg"]);
        for (number, kinds) in links.enumerate() {
            let mut random = ChaCha8Rng::seed_from_u64(number as u64);
            let mut next = kinds.chars().map(|kind| link(kind, &mut random));
            let constants: [Motion<f64>; 5] = std::array::from_fn(|_| next.next().unwrap());
            let (before_gap, after_gap) = (Motion::identity(), Motion::identity());
            let solver = Solver::prepare(&OpenLoop { variables, constants: constants.clone(), before_gap, after_gap });
            assert_eq!(solver.is_decoupled(), *kinds != "gpggg", "{kinds}");
            for pose in 0..5 {
                let mut reached = Motion::<f64>::identity();
                for k in 0..6 {
                    let (sin, cos) = random.random_range(-PI..PI).sin_cos();
                    reached = reached.then_after(&Motion::rotation_z(cos, sin));
                    reached = constants.get(k).map_or(reached.clone(), |constant| reached.then_after(constant));
                }
                let gap = solver.gap(&reached.inverse());
                let (mut workspace, mut fast, mut slow) =
                    (Workspace::default(), Assembly::default(), Assembly::default());
                let most = if solver.is_decoupled() { 8 } else { 16 };
                solver.solve_up_to(&gap, Roots::All, &|_| most, &mut workspace, &mut fast);
                // No bound is known, so the pencils decide.
                solver.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut workspace, &mut slow);
                assert!(fast.tries == 0 || !solver.is_decoupled(), "{kinds}, pose {pose}");
                assert!(slow.tries > 0 || !solver.is_decoupled(), "{kinds}, pose {pose}");
                assert_eq!((fast.total(), fast.real()), (slow.total(), slow.real()), "{kinds}, pose {pose}");
                for mode in &fast.modes {
                    let known = |other: &crate::assembly::Mode| {
                        distance(&variables, &mode.unknowns, &other.unknowns) < 1e-8 && mode.real == other.real
                    };
                    assert!(mode.certificate.is_some() && slow.modes.iter().any(known), "{kinds}, pose {pose}");
                }
            }
        }
    }
}
