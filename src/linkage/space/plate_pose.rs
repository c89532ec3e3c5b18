//! Poses of a plate, each proved to be one by Krawczyk's theorem in Study's parameters.

use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::closure::study::{Four, scalar};
use crate::closure::universal_leg::joined;
use crate::kinematics::motion::Motion;
use crate::linkage::isotropic::middle;
use crate::synthesis::krawczyk::{BITS, Square, centre};
use looproot_calculus::quaternion::DualQuaternion;
use nalgebra::DMatrix;
use num_complex::Complex;
use rug::{Float, Rational};

/// A pose that is proved to be one.
#[derive(Clone, Debug)]
pub(super) struct PlatePose {
    /// Its motion against the ground.
    pub place: Motion<Disc>,
    /// Whether it is real.
    pub is_real: bool,
}

impl PlatePose {
    /// Whether no place of one box is in the other.
    pub fn is_apart_from(&self, other: &Self) -> bool {
        let numbers = |pose: &Self| -> Vec<Disc> {
            pose.place.rotation.iter().flatten().chain(&pose.place.translation).cloned().collect()
        };
        numbers(self).iter().zip(&numbers(other)).any(|(a, b)| a.sub(b).is_not_zero())
    }
}

/// Steps of Newton's method with one inverse: each gains as many digits as the inverse has.
const MOST_STEPS: usize = 24;
/// Steps below this end the iteration: boxes have a radius of 2^-160, which is 7e-49, over the size of the unknowns.
const SETTLED: f64 = 1e-60;

/// Six forms of degree 2 in Study's parameters that vanish at the poses.
pub(super) trait PoseForms {
    /// Returns their values.
    fn values(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<Disc>;

    /// Returns the derivatives of each by x and y.
    fn slopes(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<[Disc; 8]>;
}

/// Returns the product with a constant of a form.
pub(super) fn times(z: &Disc, c: &Disc) -> Disc {
    z.mul(c)
}

/// The equations of a plate at Study's parameters, of which one is held at 1.
struct Fixed<'a> {
    forms: &'a dyn PoseForms,
    chart: usize,
}

/// The parameters of eight discs.
fn halves(unknowns: &[Disc]) -> [Four<Disc>; 2] {
    [0, 4].map(|from| std::array::from_fn(|k| unknowns[from + k].clone()))
}

impl Square for Fixed<'_> {
    fn values(&self, unknowns: &[Disc]) -> Vec<Disc> {
        let [x, y] = halves(unknowns);
        let mut values = self.forms.values(&x, &y);
        values.extend([scalar(&x, &y), unknowns[self.chart].sub(&Disc::one())]);
        values
    }

    fn slopes(&self, unknowns: &[Disc]) -> Vec<Vec<Disc>> {
        let [x, y] = halves(unknowns);
        let unit = std::array::from_fn(|k| if k == self.chart { Disc::one() } else { Disc::zero() });
        let mut rows = self.forms.slopes(&x, &y);
        rows.extend([joined(&y, &x), unit]);
        (0..8).map(|k| rows.iter().map(|row| row[k].clone()).collect()).collect()
    }

    /// An inverse in f64 serves: it is a factor in a proof, and each step with it gains some ten digits.
    fn inverse(&self, unknowns: &[Disc]) -> Option<Vec<Vec<Disc>>> {
        let columns = self.slopes(unknowns);
        let slopes = DMatrix::from_fn(8, 8, |i, k| middle(&columns[k][i]));
        let inverse = slopes.try_inverse()?;
        let row = |i: usize| (0..8).map(|k| in_disc(&inverse[(i, k)])).collect();
        (0..8).map(row).collect()
    }

    fn refined(&self, mut unknowns: Vec<Disc>) -> Option<Vec<Disc>> {
        let inverse = self.inverse(&unknowns)?;
        for _ in 0..MOST_STEPS {
            let values = self.values(&unknowns);
            let product =
                |row: &Vec<Disc>| row.iter().zip(&values).fold(Disc::zero(), |sum, (a, b)| sum.add(&a.mul(b)));
            let steps: Vec<Disc> = inverse.iter().map(product).collect();
            unknowns = unknowns.iter().zip(&steps).map(|(z, step)| centre(&z.sub(step))).collect();
            if steps.iter().all(|step| step.at_most() < SETTLED) {
                break;
            }
        }
        Some(unknowns)
    }
}

/// A number in f64 as a disc without radius; `None` where it is not finite.
fn in_disc(z: &Complex<f64>) -> Option<Disc> {
    let is_finite = z.re.is_finite() && z.im.is_finite();
    is_finite.then(|| Disc::point(Float::with_val(BITS, z.re), Float::with_val(BITS, z.im)))
}

/// Returns the pose near parameters, of which those of the translation are in parts of a size; `None` where it is not proved to be one, or
/// not whether it is real.
pub(super) fn proved(forms: &dyn PoseForms, near: &[Complex<f64>; 8], size: f64) -> Option<PlatePose> {
    let scaled: [Complex<f64>; 8] = std::array::from_fn(|k| near[k] * if k < 4 { 1.0 } else { size });
    let chart = (0..8).max_by(|j, k| scaled[*j].norm_sqr().total_cmp(&scaled[*k].norm_sqr()))?;
    let inverse = scaled[chart].inv();
    let disc = |z: &Complex<f64>| in_disc(&(z * inverse));
    let system = Fixed { forms, chart };
    let unknowns = system.refined(scaled.iter().map(disc).collect::<Option<_>>()?)?;
    let (boxes, is_real) = system.certified(unknowns)?;
    let [x, y] = halves(&boxes);
    let half = Disc::of(&Rational::from((1, 2)), BITS);
    let (motion, norm) = DualQuaternion::from_study(&x, &y.map(|z| z.mul(&half))).scaled_motion();
    let inverse = norm.inverse()?;
    Some(PlatePose { place: motion.map(|z| Some(z.mul(&inverse)))?, is_real })
}
