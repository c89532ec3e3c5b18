//! The multiplicity of a pose.

use crate::algebra::local_multiplicity::{Quadric, multiplicity};
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::Leg;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::Vector;
use crate::kinematics::platform::Platform;

type Form = Vec<Vec<Algebraic>>;

/// The symmetric matrix of the leg quadric `w.w - L^2 x.x`, w = y + M x.
fn quadric(leg: &Leg<Algebraic>) -> Form {
    let square = |j: usize, k: usize| {
        let product = (0..4).fold(Algebraic::zero(), |sum, i| sum.add(&leg.matrix[i][j].mul(&leg.matrix[i][k])));
        if j == k { product.sub(&leg.square) } else { product }
    };
    let entry = |j: usize, k: usize| match (j < 4, k < 4) {
        (true, true) => square(j, k),
        (true, false) => leg.matrix[k - 4][j].clone(),
        (false, true) => leg.matrix[j - 4][k].clone(),
        (false, false) if j == k => Algebraic::one(),
        (false, false) => Algebraic::zero(),
    };
    (0..8).map(|j| (0..8).map(|k| entry(j, k)).collect()).collect()
}

/// The symmetric matrix of the Study condition, doubled.
fn study() -> Form {
    let entry = |j: usize, k: usize| if j.abs_diff(k) == 4 { Algebraic::one() } else { Algebraic::zero() };
    (0..8).map(|j| (0..8).map(|k| entry(j, k)).collect()).collect()
}

/// Returns the multiplicity of a pose; `None` where the point is no pose, the multiplicity exceeds `most`, or the field splits.
pub fn multiplicity_at(
    platform: &Platform<Algebraic>,
    squares: &[Algebraic; 6],
    x: &Quaternion<Algebraic>,
    position: &Vector<Algebraic>,
    most: usize,
) -> Option<usize> {
    let y = Quaternion { scalar: Algebraic::zero(), vector: position.clone() }.mul(x);
    let [x1, x2, x3] = x.vector.clone();
    let [y1, y2, y3] = y.vector;
    let point = [x.scalar.clone(), x1, x2, x3, y.scalar, y1, y2, y3];
    // One coordinate of the rotation is 1 in the neighbourhood.
    let chart = (0..4).find(|&k| !point[k].is_zero())?;
    let inverse = point[chart].inverse()?;
    let point = point.map(|c| c.mul(&inverse));
    let legs = (0..6).map(|i| quadric(&Leg::new(&platform.base[i], &platform.plate[i], squares[i].clone())));
    let equations: Option<Vec<Quadric<Algebraic>>> =
        legs.chain([study()]).map(|form| about(&form, &point, chart)).collect();
    multiplicity(&equations?, most)
}

/// A quadratic form about a point at which it vanishes, one coordinate held; `None` where it does not vanish.
fn about(form: &Form, point: &[Algebraic; 8], chart: usize) -> Option<Quadric<Algebraic>> {
    let slope: Vec<Algebraic> = form
        .iter()
        .map(|row| row.iter().zip(point).fold(Algebraic::zero(), |sum, (c, v)| sum.add(&c.mul(v))))
        .collect();
    let value = slope.iter().zip(point).fold(Algebraic::zero(), |sum, (c, v)| sum.add(&c.mul(v)));
    if !value.is_zero() {
        return None;
    }
    let kept = || (0..8).filter(move |&k| k != chart);
    Some(Quadric {
        linear: kept().map(|k| slope[k].add(&slope[k])).collect(),
        form: kept().map(|j| kept().map(|k| form[j][k].clone()).collect()).collect(),
    })
}
