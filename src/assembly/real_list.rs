//! The real solutions of one pose by the zeros of a determinant on a circle, proved to be all.

use super::mode::{Mode, are_apart};
use super::search::Search;
use crate::algebra::double_double::DoubleDouble;
use crate::certify::circle_zeros::Zeros;
use crate::elimination::brackets::{self, Columns};
use crate::elimination::cut::{Cut, Hidden};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::solve::back_substitution::CutView;
use crate::solve::kernel::{SHARED, kernel};

impl Search<'_> {
    /// Lists the real solutions of the zeros of one cut and hidden angle after the other, until as many are certified as there are
    /// zeros. Returns whether that is so. `exact` gives the loop, scaled, closed by the identity; `off` bounds what the closing
    /// transformation is off, and `blur` is that of [`zeros`](crate::certify::closure_zeros::EnclosedEquations::zeros).
    pub(super) fn by_zeros(
        &mut self,
        order: &[(usize, Hidden)],
        [off, blur]: [f64; 2],
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
    ) -> bool {
        let all = self.prepared;
        order.iter().any(|&(k, hidden)| {
            let prepared = &all[k];
            let Some(rows) = prepared.enclosed(exact) else { return false };
            let equations = rows.equations(self.closed, off);
            let cut = prepared.cut.of(self.closed);
            let view = CutView::new(&cut, &prepared.form, hidden);
            let zeros = equations.zeros(hidden, blur);
            zeros.is_some_and(|zeros| self.of_zeros(prepared.cut, &view, &equations.columns(hidden), &zeros))
        })
    }

    /// Lists the solutions of the zeros in one hidden angle, and returns whether they are all.
    fn of_zeros(&mut self, cut: Cut, view: &CutView<'_, f64>, columns: &Columns<f64>, zeros: &Zeros) -> bool {
        for angle in zeros.angles() {
            let (sin, cos) = angle.sin_cos();
            let kernel = kernel(&brackets::matrix(&brackets::at(columns, &cos, &sin)), SHARED);
            for candidate in view.candidates((cos, sin), &kernel).as_slice() {
                self.admit(&self.in_loop_order(cut, candidate));
            }
        }
        self.has_all(zeros.angles().len())
    }

    /// Returns whether so many real solutions are listed, and each is certified and apart from all others.
    fn has_all(&self, number: usize) -> bool {
        self.assembly.modes.len() == number
            && distinct_real(&self.closed.variables, &self.assembly.modes) == Some(number)
    }
}

/// Returns the number of real modes in a list; `None` where one of them is not certified, or not apart from all others.
#[must_use]
pub fn distinct_real(variables: &[Variable; 6], modes: &[Mode]) -> Option<usize> {
    let real = || modes.iter().filter(|mode| mode.real);
    let is_simple = |(k, mode): (usize, &Mode)| {
        let is_certified = mode.multiplicity == 1 && mode.certificate.is_some();
        is_certified && real().take(k).all(|other| are_apart(variables, other, mode))
    };
    real().enumerate().all(is_simple).then(|| real().count())
}

#[cfg(test)]
mod tests {
    use super::{ClosedLoop, DoubleDouble};
    use crate::assembly::Margin;
    use crate::assembly::{Assembly, Gap, Roots, Solver, Workspace, distance};
    use crate::kinematics::closed_loop::{OpenLoop, Variable};
    use crate::kinematics::motion::Motion;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::PI;

    const UNKNOWNS: [Variable; 6] = [Variable::Rotation; 6];

    /// Returns an arm whose DH values are off by up to `off`: one with parallel axes, one with a wrist, a badly scaled one, or a general one.
    fn arm(kind: usize, off: f64, random: &mut ChaCha8Rng) -> Solver {
        let q = PI / 2.0;
        let rows = match kind {
            0 => [
                (0.0, q, 0.09),
                (-0.43, 0.0, 0.0),
                (-0.39, 0.0, 0.0),
                (0.0, q, 0.11),
                (0.0, -q, 0.095),
                (0.0, 0.0, 0.08),
            ],
            1 => [(0.0, -q, 0.0), (0.43, 0.0, 0.15), (0.02, -q, 0.0), (0.0, q, 0.43), (0.0, -q, 0.0), (0.0, 0.0, 0.1)],
            2 => std::array::from_fn(|_| {
                let mut value = |size: f64| random.random_range(-size..size);
                (value(0.5), value(3.0), value(0.5))
            }),
            _ => std::array::from_fn(|_| {
                let mut value = |size: f64| random.random_range(-size..size);
                let [a, d] = [(); 2].map(|()| value(0.5) * 10_f64.powf(value(1.5)));
                (a, value(3.0), d)
            }),
        };
        let links = rows.map(|(a, alpha, d): (f64, f64, f64)| {
            let mut near = |x: f64| x + random.random_range(-1.0..1.0) * off;
            let (a, alpha, d) = (near(a), near(alpha), near(d));
            Motion { translation: [a, 0.0, d], ..Motion::rotation_x(alpha.cos(), alpha.sin()) }
        });
        Solver::prepare(&OpenLoop {
            variables: UNKNOWNS,
            constants: std::array::from_fn(|k| links[k].clone()),
            before_gap: links[5].clone(),
            after_gap: Motion::identity(),
        })
    }

    /// Returns the closing transformation at random joint values.
    fn gap(solver: &Solver, random: &mut ChaCha8Rng) -> Gap {
        let (closed, scale) = solver.closed(&solver.gap(&Motion::identity()));
        let mut reached = Motion::<f64>::identity();
        for constant in &closed.constants {
            let (sin, cos) = random.random_range(-PI..PI).sin_cos();
            reached = reached.then_after(&Motion::rotation_z(cos, sin)).then_after(constant);
        }
        let back = reached.inverse();
        solver.gap(&Motion { translation: back.translation.map(|x| x * scale), ..back })
    }

    /// Returns the loop as it is stored, as exact data.
    fn stored(solver: &Solver) -> ClosedLoop<DoubleDouble> {
        let (closed, unit) = solver.closed(&solver.gap(&Motion::identity()));
        let motion = |motion: &Motion<f64>| Motion {
            rotation: motion.rotation.map(|row| row.map(DoubleDouble::from)),
            translation: motion.translation.map(|x| DoubleDouble::from(x * unit)),
        };
        ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(motion) }
    }

    #[test]
    fn the_real_list_is_that_of_all_solutions() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let (mut workspace, mut real, mut all) = (Workspace::default(), Assembly::default(), Assembly::default());
        let (mut proved, mut count) = (0, 0);
        for number in 0..60 {
            let solver = arm(2, 0.0, &mut random);
            for _ in 0..5 {
                let gap = gap(&solver, &mut random);
                let is_proved =
                    solver.solve_real(&gap, &|| Some(stored(&solver)), Margin::Blur(0.0), &mut workspace, &mut real);
                solver.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut workspace, &mut all);
                if !is_proved || all.total() != 16 {
                    count += usize::from(all.total() == 16);
                    continue;
                }
                (proved, count) = (proved + 1, count + 1);
                assert_eq!(real.modes.len(), all.real(), "arm {number}");
                for mode in &real.modes {
                    let is_known =
                        |other: &crate::assembly::Mode| distance(&UNKNOWNS, &mode.unknowns, &other.unknowns) < 1e-7;
                    assert!(all.modes.iter().any(is_known), "arm {number}");
                }
            }
        }
        assert!(count > 280 && 100 * proved > 97 * count, "{proved} of {count} are proved");
    }

    /// The lists made side by side and one by one are the same wherever both are proved.
    #[test]
    fn quick_lists_are_the_same() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let (mut workspace, mut quick, mut close) = (Workspace::default(), Assembly::default(), Assembly::default());
        for (kind, off, least) in
            [(2, 0.0, 97), (3, 0.0, 90), (0, 0.0, 0), (1, 0.0, 0), (0, 1e-4, 90), (1, 1e-7, 90), (0, 1e-10, 0)]
        {
            let (mut both, mut count) = (0, 0);
            for _ in 0..40 {
                let solver = arm(kind, off, &mut random);
                for _ in 0..5 {
                    let gap = gap(&solver, &mut random);
                    let exact = || Some(stored(&solver));
                    count += 1;
                    if !solver.solve_real_quickly(&gap, &exact, Margin::Blur(0.0), &mut workspace, &mut quick) {
                        continue;
                    }
                    both += 1;
                    if !solver.solve_real_closely(&gap, &exact, Margin::Blur(0.0), &mut workspace, &mut close) {
                        continue;
                    }
                    assert_eq!(quick.modes.len(), close.modes.len(), "kind {kind}, {off}");
                    // Solutions that share an angle come in any order.
                    let radius = |mode: &crate::assembly::Mode| mode.certificate.unwrap().radius;
                    for one in &quick.modes {
                        let is_it = |other: &crate::assembly::Mode| {
                            distance(&UNKNOWNS, &one.unknowns, &other.unknowns) <= radius(one) + radius(other)
                        };
                        assert!(close.modes.iter().any(is_it), "kind {kind}, {off}: {one:?}");
                    }
                }
            }
            assert!(100 * both >= least * count, "kind {kind}, {off}: {both} of {count}");
        }
    }

    #[test]
    fn arms_as_built_are_proved_in_f64() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let (mut workspace, mut real) = (Workspace::default(), Assembly::default());
        for off in [1e-4, 1e-6, 1e-8] {
            for kind in [0, 1] {
                let mut proved = 0;
                for _ in 0..50 {
                    let solver = arm(kind, off, &mut random);
                    let gap = gap(&solver, &mut random);
                    let is_proved = solver.solve_real(
                        &gap,
                        &|| Some(stored(&solver)),
                        Margin::Blur(0.0),
                        &mut workspace,
                        &mut real,
                    );
                    proved += usize::from(is_proved);
                    // Solutions are in general one of 2, 4, 6 and 8, and one reaches the pose.
                    assert!(!is_proved || matches!(real.modes.len(), 2 | 4 | 6 | 8), "{} solutions", real.modes.len());
                }
                assert!(proved >= 40, "kind {kind}, {off}: {proved} of 50 are proved");
            }
        }
    }
}
