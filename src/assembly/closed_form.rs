//! Arms with a spherical wrist or three parallel axes: all solutions by closed forms, if as many are certified as the geometry
//! allows.

use super::lane_finish::Finish;
use super::mode::{Mode, are_all_apart};
use super::search::Search;
use super::side_by_side::{Done, Pairs, SideBySide};
use crate::algebra::double_double::DoubleDouble;
use crate::certify::{refined_exactly, refined_real_of};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::solve::scalar::Scalar;
use pulp::Arch;
use std::cell::LazyCell;

/// A loop of exact constants, rounded once.
type Exact = ClosedLoop<DoubleDouble>;
/// The same, made where it is first asked for.
type Lazy<'a> = LazyCell<Option<Exact>, &'a dyn Fn() -> Option<Exact>>;
/// No constants but those that are stored.
pub(super) const STORED: &dyn Fn() -> Option<Exact> = &|| None;

impl Search<'_> {
    /// Lists the candidates of the closed form, if there is one. Returns whether as many are proved as the loop can have;
    /// otherwise it lists nothing and the pencils decide. `exact` gives the loop with constants rounded once from exact ones, scaled.
    pub(super) fn by_closed_form(&mut self, most: &dyn Fn(usize) -> usize, exact: &dyn Fn() -> Option<Exact>) -> bool {
        let Some(decoupled) = self.decoupled else { return false };
        let candidates = decoupled.candidates(self.closed);
        if candidates.count() < most(candidates.count()) {
            return false;
        }
        let (real, complex) = (candidates.real(), candidates.complex());
        let finish = Finish::new(self.closed, self.gap_rounding);
        let done = Arch::new().dispatch(SideBySide { finish, real, complex, modes: &mut self.assembly.modes });
        // What is not proved side by side is looked at alone.
        let exact = LazyCell::new(exact);
        let all = self.alone(real, &done[0], &exact) && self.alone(complex, &done[1], &exact);
        let variables = &self.closed.variables;
        if all && are_all_apart(variables, &self.assembly.modes) && self.is_full(self.proved(), most) {
            self.assembly.all_resolved = true;
            return true;
        }
        self.assembly.clear();
        false
    }

    /// Lists the candidates that are not done, by longer numbers. Returns whether all are proved.
    pub(super) fn alone<S: Scalar>(&mut self, starts: &[Pairs<S>], done: &Done, exact: &Lazy<'_>) -> bool {
        starts.iter().zip(done).all(|(pairs, done)| {
            if *done {
                return true;
            }
            let start = pairs.map(|(cos, sin)| S::angle_of(cos, sin).to_complex());
            let real = start.map(|z| z.re);
            let refined = if S::REAL { refined_real_of(self.closed, &real, self.gap_rounding) } else { None };
            // Near singular positions the rounding of the pose to f64 moves a solution beyond its neighbour.
            let exact = || refined_exactly(exact.as_ref()?, &start);
            let refined = refined.or_else(exact).and_then(|refined| self.refined_mode(refined));
            let mode = refined.or_else(|| self.proved_mode(&start));
            mode.filter(|mode| mode.real == S::REAL).map(|mode| self.list(mode)).is_some()
        })
    }

    /// Lists a proved solution, and its conjugate.
    fn list(&mut self, mode: Mode) {
        if !mode.real {
            self.assembly.modes.push(mode.conjugate());
        }
        self.assembly.modes.push(mode);
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
                assert_eq!(fast.tries == 0, solver.is_decoupled(), "{kinds}, pose {pose}");
                assert!(slow.tries > 0, "{kinds}, pose {pose}");
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
