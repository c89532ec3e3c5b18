//! The families along which four-bars are followed: points that move, and a pencil of conditions.

use super::curve::{UNKNOWNS, slopes};
use crate::solve::paths::{Family, Here, Point};
use num_complex::Complex;

/// A point of the plane and its conjugate, which is a number of its own.
pub type Place = [Complex<f64>; 2];
/// The points beside the first one, seen from it.
pub const PLACES: usize = 8;
/// The places of a problem.
pub type Places = [Place; PLACES];
/// A four-bar.
pub type FourBar = Point<UNKNOWNS>;

/// Points that move from `start`, at 1, to `target`, at 0.
pub struct Moving<'a> {
    pub start: &'a Places,
    pub target: &'a Places,
}

impl Family<UNKNOWNS> for Moving<'_> {
    fn at(&self, parameter: Complex<f64>, v: &FourBar, patch: &FourBar) -> Here<UNKNOWNS> {
        let mut here = Here::zero();
        for (j, (start, target)) in self.start.iter().zip(self.target).enumerate() {
            let way = [start[0] - target[0], start[1] - target[1]];
            let curve = slopes(v, &(target[0] + parameter * way[0]), &(target[1] + parameter * way[1]));
            here.values[j] = curve.value;
            here.jacobian[j] = curve.gradient;
            here.drift[j] = curve.drift[0] * way[0] + curve.drift[1] * way[1];
        }
        here.jacobian[PLACES] = *patch;
        here
    }
}

/// All conditions but the last stay; to that one the form at another place is added, times the parameter.
pub struct Pencil<'a> {
    pub places: &'a Places,
    pub other: Place,
}

impl Family<UNKNOWNS> for Pencil<'_> {
    fn at(&self, parameter: Complex<f64>, v: &FourBar, patch: &FourBar) -> Here<UNKNOWNS> {
        let mut here = Here::zero();
        for (j, [d, e]) in self.places.iter().enumerate() {
            let curve = slopes(v, d, e);
            here.values[j] = curve.value;
            here.jacobian[j] = curve.gradient;
        }
        let other = slopes(v, &self.other[0], &self.other[1]);
        let last = PLACES - 1;
        here.values[last] += parameter * other.value;
        here.drift[last] = other.value;
        for (entry, more) in here.jacobian[last].iter_mut().zip(&other.gradient) {
            *entry += parameter * more;
        }
        here.jacobian[PLACES] = *patch;
        here
    }
}
