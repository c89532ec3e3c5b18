//! Candidates of one pose, real and complex, polished and proved side by side in vector registers.

use super::lane_finish::Finish;
use super::mode::Mode;
use crate::solve::lane_closure::Angular;
use crate::solve::lanes::{ComplexLanes, Lanes, WIDTH};
use num_complex::Complex;
use pulp::{Simd, WithSimd};

/// Most candidates of one kind.
pub(super) const MOST: usize = 16;
/// Cosines and sines of six angles in the order of the loop.
pub(super) type Pairs<S> = [(S, S); 6];
/// Which candidates are proved.
pub(super) type Done = [bool; MOST];

/// Candidates that are polished and proved side by side, complex ones with their conjugates. The result says which of them are proved: of
/// the real ones, then of the complex ones.
pub(super) struct SideBySide<'a> {
    /// The loop at a pose.
    pub finish: Finish<'a>,
    /// At most [`MOST`] real candidates.
    pub real: &'a [Pairs<f64>],
    /// At most [`MOST`] complex ones.
    pub complex: &'a [Pairs<Complex<f64>>],
    /// The list that is added to.
    pub modes: &'a mut Vec<Mode>,
}

/// The numbers of a pair: real and imaginary part of the cosine, then of the sine.
trait Parts {
    fn parts(&self) -> [f64; 4];
}

impl Parts for (f64, f64) {
    fn parts(&self) -> [f64; 4] {
        [self.0, 0.0, self.1, 0.0]
    }
}

impl Parts for (Complex<f64>, Complex<f64>) {
    fn parts(&self) -> [f64; 4] {
        [self.0.re, self.0.im, self.1.re, self.1.im]
    }
}

impl SideBySide<'_> {
    /// Polishes and proves candidates, register by register.
    #[inline(always)]
    fn list<S: Simd, N: Angular<S>, P: Parts>(&mut self, one: Lanes<S>, starts: &[[P; 6]]) -> Done {
        let mut done = [false; MOST];
        for (chunk, starts) in starts[..starts.len().min(MOST)].chunks(S::F64_LANES).enumerate() {
            // Lanes that are not used do what the first one does.
            let mut rows = [[[0.0; WIDTH]; 4]; 6];
            for lane in 0..S::F64_LANES {
                for (row, pair) in rows.iter_mut().zip(&starts[if lane < starts.len() { lane } else { 0 }]) {
                    for (row, x) in row.iter_mut().zip(pair.parts()) {
                        row[lane] = x;
                    }
                }
            }
            let mut pairs = [[N::of(one); 2]; 6];
            for (pair, row) in pairs.iter_mut().zip(&rows) {
                let [a, b, c, d] = row;
                let cos = N::from_parts(one.loaded(a), one.loaded(b));
                *pair = N::normalised([cos, N::from_parts(one.loaded(c), one.loaded(d))]);
            }
            let found = self.finish.proved(pairs, one);
            for lane in 0..starts.len() {
                let Some(mode) = found.mode(lane) else { continue };
                done[chunk * S::F64_LANES + lane] = true;
                if !mode.real {
                    self.modes.push(mode.conjugate());
                }
                self.modes.push(mode);
            }
        }
        done
    }
}

impl WithSimd for SideBySide<'_> {
    type Output = [Done; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> [Done; 2] {
        let one = Lanes::splat(simd, 1.0);
        [self.list::<S, Lanes<S>, _>(one, self.real), self.list::<S, ComplexLanes<S>, _>(one, self.complex)]
    }
}

#[cfg(test)]
pub(super) mod tests {
    use crate::algebra::double_double::DoubleDouble;
    use crate::assembly::{Assembly, Crowded, Roots, Rounded, Solver, Workspace, distance};
    use crate::certify::refined_certificate;
    use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
    use crate::kinematics::motion::Motion;
    use crate::solve::scalar::Extended;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use std::f64::consts::PI;

    const UNKNOWNS: [Variable; 6] = [Variable::Rotation; 6];

    pub fn prepared(links: &[Motion<f64>; 6]) -> Solver {
        Solver::prepare(&OpenLoop {
            variables: UNKNOWNS,
            constants: std::array::from_fn(|k| links[k].clone()),
            before_gap: links[5].clone(),
            after_gap: Motion::identity(),
        })
    }

    /// Every ball holds the solution that double-double numbers prove nearby, and complex balls no real one.
    #[test]
    fn balls_hold_the_solutions_of_longer_numbers() {
        let mut random = ChaCha8Rng::seed_from_u64(21);
        let (mut workspace, mut all) = (Workspace::default(), Assembly::default());
        let (mut checked, mut complex) = (0, 0);
        for _ in 0..60 {
            let links: [Motion<f64>; 6] = std::array::from_fn(|_| {
                let mut value = |size: f64| random.random_range(-size..size);
                let (a, alpha, d) = (value(0.5), value(3.0), value(0.5));
                Motion { translation: [a, 0.0, d], ..Motion::rotation_x(f64::cos(alpha), f64::sin(alpha)) }
            });
            let solver = prepared(&links);
            let mut reached = Motion::<f64>::identity();
            for link in &links {
                let (sin, cos) = random.random_range(-PI..PI).sin_cos();
                reached = reached.then_after(&Motion::rotation_z(cos, sin)).then_after(link);
            }
            let gap = solver.gap(&reached.inverse());
            solver.solve_up_to(&gap, Roots::All, &|_| usize::MAX, &mut workspace, &mut all);
            let (closed, _) = solver.closed(&gap);
            for mode in &all.modes {
                let (Some(proof), Some(longer)) = (mode.certificate, refined_certificate(&closed, &mode.unknowns))
                else {
                    continue;
                };
                let apart = distance(&UNKNOWNS, &mode.unknowns, &longer.unknowns);
                assert!(apart <= proof.radius + longer.certificate.radius, "{apart}: {mode:?}");
                assert_eq!(mode.real, longer.real, "{mode:?}");
                (checked, complex) = (checked + 1, complex + usize::from(!mode.real));
            }
        }
        assert!(checked > 900 && complex > 500, "{checked} solutions, {complex} of them complex");
    }

    /// Cosine and sine of a twist.
    const NONE: (f64, f64) = (1.0, 0.0);
    const QUARTER: (f64, f64) = (0.0, 1.0);
    const BACK: (f64, f64) = (0.0, -1.0);

    /// Near singular positions of the wrist, down to 1e-15 from them, all solutions are told apart for the exact pose.
    #[test]
    fn poses_near_a_singular_wrist_have_all_solutions() {
        let wrist = [
            (0.0, QUARTER, 0.0),
            (0.4318, NONE, 0.0),
            (0.0203, BACK, 0.15005),
            (0.0, QUARTER, 0.4318),
            (0.0, BACK, 0.0),
            (0.0, NONE, 0.1),
        ];
        let parallel = [
            (0.0, QUARTER, 0.1625),
            (-0.425, NONE, 0.0),
            (-0.3922, NONE, 0.0),
            (0.0, QUARTER, 0.1333),
            (0.0, BACK, 0.0997),
            (0.0, NONE, 0.0996),
        ];
        for rows in [wrist, parallel] {
            near_singular(
                &rows.map(|(a, (cos, sin), d)| Motion { translation: [a, 0.0, d], ..Motion::rotation_x(cos, sin) }),
            );
        }
    }

    /// The loop closed at these joint values, and its closing transformation.
    fn closed_at<R: Extended>(links: &[Motion<f64>; 6], q: &[f64; 6]) -> (ClosedLoop<R>, Motion<R>) {
        let long = |motion: &Motion<f64>| Motion {
            rotation: motion.rotation.map(|row| row.map(R::from)),
            translation: motion.translation.map(R::from),
        };
        let mut reached = Motion::<R>::identity();
        for (angle, link) in q.iter().zip(links) {
            let (sin, cos) = angle.sin_cos();
            let (cos, sin) = (R::from(cos), R::from(sin));
            let norm = cos.mul(&cos).add(&sin.mul(&sin)).root();
            reached = reached.then_after(&Motion::rotation_z(cos.over(norm), sin.over(norm))).then_after(&long(link));
        }
        let closing = reached.inverse();
        let mut constants = links.each_ref().map(long);
        constants[5] = constants[5].then_after(&closing);
        (ClosedLoop { variables: UNKNOWNS, constants }, closing)
    }

    fn near_singular(links: &[Motion<f64>; 6]) {
        let solver = prepared(links);
        let mut random = ChaCha8Rng::seed_from_u64(22);
        let (mut workspace, mut all) = (Workspace::default(), Assembly::default());
        for number in 0..60 {
            let near = 10_f64.powf(-1.0 - 14.0 * f64::from(number) / 60.0);
            let mut q: [f64; 6] = std::array::from_fn(|_| random.random_range(-PI..PI));
            q[4] = near;
            let (double, closing) = closed_at::<DoubleDouble>(links, &q);
            let (crowded, _) = closed_at::<Crowded>(links, &q);
            let entry = |x: &DoubleDouble| x.to_f64();
            let gap = solver.gap(&Motion {
                rotation: closing.rotation.each_ref().map(|row| row.each_ref().map(entry)),
                translation: closing.translation.each_ref().map(entry),
            });
            let exact = Rounded { double: &|| Some(double.clone()), crowded: &|| Some(crowded.clone()) };
            let is_found = solver.solve_in_closed_form(&gap, &|_| 8, exact, &mut workspace, &mut all);
            assert!(is_found && all.modes.len() == 8, "{near}: {q:?}");
            let start = q.map(num_complex::Complex::from);
            // The pose is that of these joint values up to a few roundings of each.
            let is_it = |mode: &crate::assembly::Mode| {
                let radius = mode.certificate.map_or(f64::NAN, |proof| proof.radius);
                distance(&UNKNOWNS, &mode.unknowns, &start) <= radius + 4.0 * f64::EPSILON
            };
            assert_eq!(all.modes.iter().filter(|mode| is_it(mode)).count(), 1, "{near}: {q:?}");
        }
    }
}
