//! The curve that a loop of seven variables runs through: its Taylor coefficients and its points.
//!
//! The closure over truncated power series gives, order by order, one linear system with one and the same matrix: the
//! seven twists, bordered by one row that says along what the curve is measured (the implicit function theorem).

use super::dense::{inverse, times};
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::algebra::sort;
use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
use crate::kinematics::motion::{Motion, cross, unit_near};
use looproot_calculus::finite::finite;
use nalgebra::SMatrix;

/// Seven joint variables: the six unknowns in loop order, then the input. Lengths over the scale of the loop.
pub type Point = [f64; 7];

/// Position of the input among the variables of a [`Point`].
pub const INPUT: usize = 6;

/// The border that measures a curve by its input.
pub const ALONG_INPUT: Point = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// A loop with its input left variable: `V1 G1 ... V6 G6 V7 G7 = I`.
#[derive(Clone, Debug)]
pub struct Curve {
    variables: [Variable; 7],
    /// Marks the virtual ones: 0 all along the curve of an overconstrained loop, which has more equations than joints.
    idle: [bool; 7],
    constants: [Motion<f64>; 7],
    scale: f64,
    /// The closure of a point, in parts of its reach, up to which it counts as one of the curve.
    closes_within: f64,
}

/// The closure of the points of a curve that meets its loop exactly: rounding.
pub const CLOSES_WITHIN: f64 = 1e-11;
/// The border that takes the place of the one idle column: any vector in general position does. Along the curve the closure
/// has no part in it.
const COBORDER: [f64; 6] = [0.41, -0.37, 0.53, 0.29, -0.47, 0.33];

/// The closure of the loop at a point.
#[derive(Clone, Copy, Debug)]
pub struct Closing {
    /// The skew-symmetric part of the rotation of the product round the loop as a vector, and its translation.
    pub residual: [f64; 6],
    /// The largest entry by which the product is not the identity.
    pub defect: f64,
}

/// The closure at a point.
struct Here {
    /// The skew-symmetric part of the rotation of the product round the loop as a vector, and its translation.
    residual: [f64; 6],
    /// The largest entry by which the product is not the identity.
    defect: f64,
    /// Column j is the twist of variable j.
    jacobian: [[f64; 7]; 6],
}

/// The skew-symmetric part of the rotation as a vector, and the translation.
fn skew_part<R: Ring>(motion: &Motion<R>) -> [[R; 2]; 3] {
    let r = &motion.rotation;
    let pair = |i: usize, j: usize| [r[i][j].clone(), r[j][i].clone()];
    [pair(2, 1), pair(0, 2), pair(1, 0)]
}

/// The matrix bordered below by one row.
fn bordered(jacobian: &[[f64; 7]; 6], border: &Point) -> [[f64; 7]; 7] {
    std::array::from_fn(|i| if i < 6 { jacobian[i] } else { *border })
}

/// The point to which Newton's method leads, and the length of its first step; `step` is the step from a point, and the largest entry of
/// the inverse matrix that made it. `None` where that does not converge quickly. Near a singular position steps stop shrinking
/// where the rounding of the closure, enlarged by the inverse matrix, hides the rest: that is as far as double precision goes.
pub(super) fn onto(start: &Point, step: impl Fn(&Point) -> Option<(Point, f64)>) -> Option<(Point, f64)> {
    const MOST_STEPS: usize = 8;
    /// Rounding never excuses steps longer than this.
    const COARSEST: f64 = 1e-8;
    let (mut at, mut first, mut last) = (*start, None, f64::INFINITY);
    for _ in 0..MOST_STEPS {
        let (step, enlarged) = step(&at)?;
        let size = step.iter().map(|x| x.abs()).fold(0.0, f64::max);
        let longest = at.iter().map(|x| x.abs()).fold(1.0, f64::max);
        let floor = (4.0 * f64::EPSILON * enlarged).clamp(1e-13, COARSEST) * longest;
        if !size.is_finite() || size > last.max(10.0 * floor) {
            return None;
        }
        at = std::array::from_fn(|k| at[k] - step[k]);
        (first, last) = (first.or(Some(size)), size);
        if size < floor {
            break;
        }
    }
    Some((at, first?))
}

impl Curve {
    /// Returns the curve of a loop whose input has this kind; `idle` marks the unknowns that stay at 0.
    #[must_use]
    pub fn new(open: &OpenLoop<f64>, idle: [bool; 6], input: Variable) -> Self {
        let mut constants: [Motion<f64>; 7] = std::array::from_fn(|j| match j {
            0..5 => open.constants[j].clone(),
            5 => open.before_gap.clone(),
            _ => open.after_gap.clone(),
        });
        let square = |m: &Motion<f64>| m.translation.iter().map(|x| x * x).sum::<f64>();
        let mean = (constants.iter().map(square).sum::<f64>() / 7.0).sqrt();
        let scale = unit_near(mean);
        for constant in &mut constants {
            *constant = constant.over(scale);
        }
        let variables = std::array::from_fn(|j| if j < 6 { open.variables[j] } else { input });
        let idle = std::array::from_fn(|j| j < 6 && idle[j]);
        Self { variables, idle, constants, scale, closes_within: CLOSES_WITHIN }
    }

    /// The self-motion of a loop of six unknowns, which need not close better than within `closes_within`: the seventh
    /// variable stays at 0.
    #[must_use]
    pub fn of_self_motion(closed: &ClosedLoop<f64>, closes_within: f64) -> Self {
        let still = |j: usize| closed.constants.get(j).cloned().unwrap_or_else(Motion::identity);
        Self {
            variables: std::array::from_fn(|j| closed.variables.get(j).copied().unwrap_or(Variable::Rotation)),
            idle: std::array::from_fn(|j| j == INPUT),
            constants: std::array::from_fn(still),
            scale: 1.0,
            closes_within,
        }
    }

    /// The curve along which variables that are not `unlocked` stay where they are, and which need not close better than
    /// within `closes_within`.
    #[must_use]
    pub fn unlocked(&self, unlocked: &[bool; 7], closes_within: f64) -> Self {
        let idle = std::array::from_fn(|j| self.idle[j] || !unlocked[j]);
        Self { idle, closes_within, ..self.clone() }
    }

    /// Returns the marks of the variables that stay at 0.
    #[must_use]
    pub fn idle(&self) -> &[bool; 7] {
        &self.idle
    }

    /// Returns the marks of the variables that are rotations.
    #[must_use]
    pub fn turns(&self) -> [bool; 7] {
        self.variables.map(|variable| variable == Variable::Rotation)
    }

    /// Returns the closure of the loop at a point, and the twists of all variables.
    #[must_use]
    pub fn closure(&self, at: &Point) -> (Closing, [[f64; 7]; 6]) {
        let Here { residual, defect, jacobian } = self.here(at);
        (Closing { residual, defect }, jacobian)
    }

    /// Returns the kind of each variable.
    #[must_use]
    pub fn variables(&self) -> &[Variable; 7] {
        &self.variables
    }

    /// The unit of a variable inside the curve: 1 for angles, the scale of the loop for lengths.
    #[must_use]
    pub fn unit(&self, index: usize) -> f64 {
        if self.variables[index] == Variable::Rotation { 1.0 } else { self.scale }
    }

    /// The product round the loop over series.
    fn product<const N: usize>(&self, values: &[Series<f64, N>; 7]) -> Motion<Series<f64, N>> {
        let mut frame = Motion::identity();
        for (j, value) in values.iter().enumerate() {
            let motion = match self.variables[j] {
                Variable::Rotation => {
                    let (sin, cos) = value.coefficients[0].sin_cos();
                    let (cos, sin) = value.cos_sin_beyond(cos, sin).expect("every small number has an inverse in f64");
                    Motion::rotation_z(cos, sin)
                }
                Variable::Translation => Motion::translation_z(*value),
            };
            let constant = self.constants[j].map(|x| Some(Series::constant(*x))).expect("every number has an image");
            frame = frame.then_after(&motion).then_after(&constant);
        }
        frame
    }

    /// The residual of one order of a product round the loop.
    fn residual<const N: usize>(product: &Motion<Series<f64, N>>, order: usize) -> [f64; 6] {
        let skew = skew_part(product);
        std::array::from_fn(|i| match i.checked_sub(3) {
            None => (skew[i][0].coefficients[order] - skew[i][1].coefficients[order]) / 2.0,
            Some(k) => product.translation[k].coefficients[order],
        })
    }

    /// The inverse of a bordered Jacobian, by least squares where some variables are idle: they would make some positions
    /// singular that are not.
    fn inverted(&self, bordered: &[[f64; 7]; 7]) -> Option<[[f64; 7]; 7]> {
        /// Singular values below this part of the largest are none.
        const RANK: f64 = 1e-13;
        let moving = self.idle.iter().filter(|idle| !**idle).count();
        if moving == 7 {
            return inverse(bordered);
        }
        if moving == 6 {
            let entry = |i: usize, j: usize| match (self.idle[j], COBORDER.get(i)) {
                (true, border) => border.copied().unwrap_or(0.0),
                (false, _) => bordered[i][j],
            };
            let mut found = inverse(&std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))?;
            for (row, idle) in found.iter_mut().zip(self.idle) {
                *row = if idle { [0.0; 7] } else { *row };
            }
            return Some(found);
        }
        let matrix = SMatrix::<f64, 7, 7>::from_fn(|i, j| if self.idle[j] { 0.0 } else { bordered[i][j] });
        let svd = finite(matrix).svd(true, true);
        let least = RANK * svd.singular_values.max();
        if svd.rank(least) < moving {
            return None;
        }
        let inverse = svd.pseudo_inverse(least).ok()?;
        Some(std::array::from_fn(|i| std::array::from_fn(|j| if self.idle[i] { 0.0 } else { inverse[(i, j)] })))
    }

    fn here(&self, at: &Point) -> Here {
        let mut frame = Motion::identity();
        let mut jacobian = [[0.0; 7]; 6];
        for j in 0..7 {
            let z: [f64; 3] = std::array::from_fn(|i| frame.rotation[i][2]);
            let moment = cross(&frame.translation, &z);
            let motion = match self.variables[j] {
                Variable::Rotation => {
                    for i in 0..3 {
                        (jacobian[i][j], jacobian[3 + i][j]) = (z[i], moment[i]);
                    }
                    let (sin, cos) = at[j].sin_cos();
                    Motion::rotation_z(cos, sin)
                }
                Variable::Translation => {
                    for i in 0..3 {
                        jacobian[3 + i][j] = z[i];
                    }
                    Motion::translation_z(at[j])
                }
            };
            frame = frame.then_after(&motion).then_after(&self.constants[j]);
        }
        let skew = skew_part(&frame);
        let residual = std::array::from_fn(|i| match i.checked_sub(3) {
            None => (skew[i][0] - skew[i][1]) / 2.0,
            Some(k) => frame.translation[k],
        });
        let off = |i: usize, j: usize| (frame.rotation[i][j] - if i == j { 1.0 } else { 0.0 }).abs();
        let turned = (0..9).map(|k| off(k / 3, k % 3));
        let defect = turned.chain(frame.translation.map(f64::abs)).fold(0.0, f64::max);
        Here { residual, defect, jacobian }
    }

    /// The Taylor coefficients of the curve at a point of it, by a parameter of which `border . q` is a linear function of
    /// slope 1: coefficient k of every variable. `None` where `border` is no coordinate of the curve, as the input is
    /// none at a limit position.
    #[must_use]
    pub fn taylor<const N: usize>(&self, at: &Point, border: &Point) -> Option<[[f64; 7]; N]> {
        let inverted = self.inverted(&bordered(&self.here(at).jacobian, border))?;
        let mut values: [Series<f64, N>; 7] = at.map(Series::constant);
        for order in 1..N {
            // While this order is 0, the residual contains the contributions of the lower ones.
            let residual = Self::residual(&self.product(&values), order);
            let right = std::array::from_fn(|i| if i < 6 { -residual[i] } else { f64::from(u8::from(order == 1)) });
            let solved = times(&inverted, &right);
            if solved.iter().any(|x| !x.is_finite()) {
                return None;
            }
            for (value, x) in values.iter_mut().zip(solved) {
                value.coefficients[order] = x;
            }
        }
        Some(std::array::from_fn(|k| values.map(|value| value.coefficients[k])))
    }

    /// The direction of the curve at a point of it, of length 1, on the side of `towards`. `None` where several curves
    /// meet.
    #[must_use]
    pub fn tangent(&self, at: &Point, towards: &Point) -> Option<Point> {
        /// Columns left over by elimination below this part of the largest are none.
        const RANK: f64 = 1e-10;
        let mut a = self.here(at).jacobian;
        // Idle variables last, and left out.
        let mut columns = [0, 1, 2, 3, 4, 5, 6];
        sort::by_key(&mut columns, |&j| self.idle[j]);
        for line in &mut a {
            *line = columns.map(|j| line[j]);
        }
        let free = self.idle.iter().filter(|idle| !**idle).count() - 1;
        let mut first = 0.0;
        // Complete pivoting: what is left over is the free column.
        for k in 0..free {
            let (mut row, mut column) = (k, k);
            for i in k..6 {
                for j in k..=free {
                    if a[i][j].abs() > a[row][column].abs() {
                        (row, column) = (i, j);
                    }
                }
            }
            let pivot = a[row][column];
            if k == 0 {
                first = pivot.abs();
            }
            if !(pivot.abs() > RANK * first) {
                return None;
            }
            a.swap(k, row);
            for line in &mut a {
                line.swap(k, column);
            }
            columns.swap(k, column);
            let pivot_row = a[k];
            for line in a.iter_mut().skip(k + 1) {
                let factor = line[k] / pivot;
                for j in k..7 {
                    line[j] -= factor * pivot_row[j];
                }
            }
        }
        let mut solved = [0.0; 7];
        solved[free] = 1.0;
        for k in (0..free).rev() {
            let sum: f64 = (k + 1..=free).map(|j| a[k][j] * solved[j]).sum();
            solved[k] = -sum / a[k][k];
        }
        let length = solved.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut tangent = [0.0; 7];
        for (k, column) in columns.into_iter().enumerate() {
            tangent[column] = solved[k] / length;
        }
        let side: f64 = tangent.iter().zip(towards).map(|(x, y)| x * y).sum();
        Some(if side < 0.0 { tangent.map(|x| -x) } else { tangent })
    }

    /// Returns whether no curve leads away from a point at which the loop closes: the twists of its variables are independent by
    /// a margin far beyond rounding, which is possible where some unknowns are virtual.
    #[must_use]
    pub fn is_rigid(&self, at: &Point) -> bool {
        /// Least singular value, in parts of the largest, of independent twists.
        const CLEAR: f64 = 1e-6;
        let moving = self.idle.iter().filter(|idle| !**idle).count();
        if moving == 7 {
            return false;
        }
        let jacobian = self.here(at).jacobian;
        let matrix = SMatrix::<f64, 6, 7>::from_fn(|i, j| if self.idle[j] { 0.0 } else { jacobian[i][j] });
        let mut values: Vec<f64> = finite(matrix).singular_values().iter().copied().collect();
        sort::by(&mut values, |a, b| b.total_cmp(a));
        values[moving - 1] > CLEAR * values[0]
    }

    /// The point of the curve with the same `border . q` as `start`, by Newton's method, and the length of the first step.
    /// `None` where that does not converge quickly.
    #[must_use]
    pub fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)> {
        let (at, first) = onto(start, |at| {
            let here = self.here(at);
            let right = std::array::from_fn(|i| if i < 6 { here.residual[i] } else { 0.0 });
            let inverted = self.inverted(&bordered(&here.jacobian, border))?;
            let enlarged = inverted.iter().flatten().map(|x| x.abs()).fold(0.0, f64::max);
            Some((times(&inverted, &right), enlarged))
        })?;
        let closed = self.here(&at).residual.iter().map(|x| x.abs()).fold(0.0, f64::max);
        let reach = at.iter().map(|x| x.abs()).fold(1.0, f64::max);
        (closed < self.closes_within * reach).then_some((at, first))
    }
}
