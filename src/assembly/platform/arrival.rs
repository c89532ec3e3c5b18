//! Takes in solutions one by one that come by other ways than eigenvalues.

use super::search::{REAL_PART, Search, near_null, real_parts};
use super::self_motion::{Numeric, project};
use crate::assembly::Roots;
use crate::certify::pose::are_apart;
use crate::solve::dense::inverse;
use crate::solve::pose::{Eight, PolishedPose, complex, equations, patch, polish, wide};
use crate::solve::scalar::Scalar;
use num_complex::Complex;

/// |Im| below which a solution may be real.
const NEAR_REAL: f64 = 1e-3;

impl Search<'_> {
    /// Restarts the counts for another route to the solutions, of which `null` are known not to be poses.
    pub fn begin(&mut self, null: usize) {
        (self.null, self.lost, self.followed, self.followed_pair) = (null, 0, true, false);
        for found in self.found.iter_mut() {
            found.eigenvalues = 0;
        }
    }

    /// Takes in the solution near a point, numbered `index`. Returns whether there is one.
    pub fn arrive(&mut self, start: &Eight<Complex<f64>>, index: usize) -> bool {
        let snapped = real_parts(start);
        let reach = start.iter().map(|z| z.norm()).fold(1.0, f64::max);
        let imaginary = |v: &Eight<Complex<f64>>, r: &Eight<f64>| {
            v.iter().zip(r).map(|(z, r)| z.norm() - r.abs()).fold(0.0, f64::max)
        };
        let near_real = imaginary(start, &snapped[2]) < NEAR_REAL * reach;
        if self.roots == Roots::Real && !near_real {
            return true;
        }
        let polished = polish(self.legs, start).filter(|p| !near_null(p));
        if polished.is_none() && !near_real && self.far_away(self.wide, &start.map(wide)) {
            return true;
        }
        if let Some(polished) = &polished {
            let real = real_parts(&polished.study)[2];
            if imaginary(&polished.study, &real) >= REAL_PART {
                if self.roots == Roots::All {
                    self.admit(polished, index);
                }
                return true;
            }
            if let Some(real) = polish(self.legs, &real)
                && !are_apart(&complex(&real.study), REAL_PART, &polished.study, REAL_PART)
            {
                self.admit(&real, index);
                return true;
            }
        }
        let mut arrived = false;
        for real in snapped.iter().filter(|_| near_real) {
            if let Some(polished) = polish(self.legs, real) {
                self.admit(&polished, index);
                arrived = true;
            }
        }
        if !arrived {
            self.lost += 1;
            if near_real {
                self.keep_stray(&snapped[2]);
            }
        }
        arrived
    }

    /// Takes in the singular solution at which the path numbered `index` ends. It is stored unpolished, for Newton's method
    /// would lead away from it.
    pub fn arrive_singular(&mut self, end: &Eight<Complex<f64>>, index: usize) {
        let snapped = real_parts(end)[2];
        let reach = end.iter().map(|z| z.norm()).fold(1.0, f64::max);
        let imaginary = end.iter().zip(&snapped).map(|(z, r)| z.norm() - r.abs()).fold(0.0, f64::max);
        let arrived = if imaginary < NEAR_REAL * reach {
            self.keep_stray(&snapped);
            self.admit_singular(&snapped, index)
        } else {
            self.roots == Roots::Real || self.admit_singular(end, index)
        };
        self.lost += usize::from(!arrived);
    }

    fn admit_singular<S: Numeric>(&mut self, end: &Eight<S>, index: usize) -> bool {
        let Some(study) = project(self.legs, end) else { return false };
        let equations = equations(self.legs, &study, &patch(&study));
        let nothing = [[<S as Scalar>::from_f64(f64::INFINITY); 8]; 8];
        let inverse = inverse(&equations.jacobian).unwrap_or(nothing);
        self.admit(&PolishedPose { study, equations, inverse, step: 0.0 }, index);
        true
    }

    /// Stores a real rotation that led to no regular pose.
    pub fn keep_stray(&mut self, start: &Eight<f64>) {
        if let Some(free) = self.stray.iter_mut().find(|s| s.is_none()) {
            *free = Some(*start);
        }
    }

    /// Ends a route on which conjugate solutions arrived one by one; each of them stands for both.
    pub fn end(&mut self) {
        for found in self.found.iter_mut().filter(|found| !found.real) {
            found.eigenvalues = found.eigenvalues.div_ceil(2);
        }
    }
}
