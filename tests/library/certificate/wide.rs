//! Complex numbers of 700 bits, motions of a chain in them, and Newton's method: written apart from the library, as its judge.

use rug::float::Constant;
use rug::{Assign, Float};

pub const BITS: u32 = 700;

/// A complex number.
#[derive(Clone, Debug)]
pub struct Wide {
    pub re: Float,
    pub im: Float,
}

pub fn float(x: f64) -> Float {
    Float::with_val(BITS, x)
}

pub fn real(x: &Float) -> Wide {
    Wide { re: Float::with_val(BITS, x), im: float(0.0) }
}

impl Wide {
    pub fn of(re: f64, im: f64) -> Self {
        Self { re: float(re), im: float(im) }
    }
    pub fn plus(&self, other: &Self) -> Self {
        Self { re: Float::with_val(BITS, &self.re + &other.re), im: Float::with_val(BITS, &self.im + &other.im) }
    }
    pub fn minus(&self, other: &Self) -> Self {
        Self { re: Float::with_val(BITS, &self.re - &other.re), im: Float::with_val(BITS, &self.im - &other.im) }
    }
    pub fn times(&self, other: &Self) -> Self {
        let mut re = Float::new(BITS);
        re.assign(&self.re * &other.re - &self.im * &other.im);
        let mut im = Float::new(BITS);
        im.assign(&self.re * &other.im + &self.im * &other.re);
        Self { re, im }
    }
    pub fn over(&self, other: &Self) -> Self {
        let mut square = Float::new(BITS);
        square.assign(&other.re * &other.re + &other.im * &other.im);
        let back =
            Self { re: Float::with_val(BITS, &other.re / &square), im: -Float::with_val(BITS, &other.im / &square) };
        self.times(&back)
    }
    pub fn size(&self) -> Float {
        Float::with_val(BITS, self.re.hypot_ref(&self.im))
    }
    /// Cosine and sine.
    pub fn cos_sin(&self) -> (Self, Self) {
        let (sin, cos) = self.re.clone().sin_cos(Float::new(BITS));
        let (sinh, cosh) = self.im.clone().sinh_cosh(Float::new(BITS));
        let product = |a: &Float, b: &Float| Float::with_val(BITS, a * b);
        (
            Self { re: product(&cos, &cosh), im: -product(&sin, &sinh) },
            Self { re: product(&sin, &cosh), im: product(&cos, &sinh) },
        )
    }
}

/// Rows of a 4 x 4 matrix; the last one is 0 0 0 1.
pub type Matrix = [[Wide; 4]; 3];

pub fn identity() -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| Wide::of(f64::from(u8::from(i == j)), 0.0)))
}

pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let start = if j == 3 { a[i][3].clone() } else { Wide::of(0.0, 0.0) };
            (0..3).fold(start, |sum, k| sum.plus(&a[i][k].times(&b[k][j])))
        })
    })
}

/// The inverse of a rigid motion.
pub fn inverse(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match j {
            3 => (0..3).fold(Wide::of(0.0, 0.0), |sum, k| sum.minus(&m[k][i].times(&m[k][3]))),
            _ => m[j][i].clone(),
        })
    })
}

/// The rotation about a coordinate axis.
pub fn about(axis: usize, (cos, sin): (Wide, Wide)) -> Matrix {
    let mut m = identity();
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    m[a][b] = Wide::of(0.0, 0.0).minus(&sin);
    (m[a][a], m[b][b], m[b][a]) = (cos.clone(), cos, sin);
    m
}

/// The translation along a coordinate axis.
pub fn along(axis: usize, distance: &Wide) -> Matrix {
    let mut m = identity();
    m[axis][3] = distance.clone();
    m
}

/// One step from base to tool.
pub enum Step {
    Constant(Box<Matrix>),
    /// A rotation about the z axis.
    Angle,
    /// A translation along it.
    Distance,
}

impl Step {
    /// A step that no joint changes.
    pub fn constant(motion: Matrix) -> Self {
        Self::Constant(Box::new(motion))
    }
}

/// The closure of a chain and the twists of its variables in the frame of the base.
fn closure(steps: &[Step], values: &[Wide]) -> (Matrix, Vec<[Wide; 6]>) {
    let (mut frame, mut twists, mut values) = (identity(), Vec::new(), values.iter());
    let nothing = || Wide::of(0.0, 0.0);
    for step in steps {
        let z = [0, 1, 2].map(|i| frame[i][2].clone());
        let motion = match step {
            Step::Constant(motion) => Matrix::clone(motion),
            Step::Angle => {
                let p = |i: usize| &frame[i][3];
                let cross = |i: usize, j: usize| p(i).times(&z[j]).minus(&p(j).times(&z[i]));
                let [x, y, w] = z.clone();
                twists.push([x, y, w, cross(1, 2), cross(2, 0), cross(0, 1)]);
                about(2, values.next().unwrap().cos_sin())
            }
            Step::Distance => {
                let [x, y, w] = z;
                twists.push([nothing(), nothing(), nothing(), x, y, w]);
                along(2, values.next().unwrap())
            }
        };
        frame = product(&frame, &motion);
    }
    (frame, twists)
}

/// The solution of a square system, by elimination with pivots.
fn solved(mut rows: Vec<Vec<Wide>>) -> Option<Vec<Wide>> {
    let n = rows.len();
    for k in 0..n {
        let best = (k..n).max_by(|&a, &b| rows[a][k].size().total_cmp(&rows[b][k].size()))?;
        rows.swap(k, best);
        if rows[k][k].size() == 0 {
            return None;
        }
        let pivot = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k].over(&pivot[k]);
            for (x, y) in row.iter_mut().zip(&pivot).skip(k) {
                *x = x.minus(&factor.times(y));
            }
        }
    }
    Some((0..n).map(|k| rows[k][n].over(&rows[k][k])).collect())
}

/// The values to which Newton's method leads, of all variables but the one that is given; `None` where it leads nowhere.
pub fn solution(steps: &[Step], start: &[Wide], given: Option<usize>) -> Option<Vec<Wide>> {
    let mut values = start.to_vec();
    let unknowns: Vec<usize> = (0..values.len()).filter(|k| Some(*k) != given).collect();
    for _ in 0..60 {
        let (e, twists) = closure(steps, &values);
        let half = |i: usize, j: usize| e[i][j].minus(&e[j][i]).times(&Wide::of(0.5, 0.0));
        let residual = [half(2, 1), half(0, 2), half(1, 0), e[0][3].clone(), e[1][3].clone(), e[2][3].clone()];
        let row = |i: usize| {
            let mut row: Vec<Wide> = unknowns.iter().map(|k| twists[*k][i].clone()).collect();
            row.push(residual[i].clone());
            row
        };
        let step = solved((0..6).map(row).collect())?;
        let mut largest = 0.0_f64;
        for (k, d) in unknowns.iter().zip(&step) {
            largest = largest.max(Float::with_val(BITS, d.size() / values[*k].size().max(&float(1.0))).to_f64());
            values[*k] = values[*k].minus(d);
        }
        if !(largest < 10.0) {
            return None;
        }
        if largest < 1e-100 {
            // A half turn has no skew part either.
            let trace = e[0][0].plus(&e[1][1]).plus(&e[2][2]);
            return (trace.minus(&Wide::of(3.0, 0.0)).size() < 1e-50).then_some(values);
        }
    }
    None
}

/// The distance of two values, angles modulo whole turns.
pub fn distance(one: &Wide, two: &Wide, is_angle: bool) -> f64 {
    let mut difference = one.minus(two);
    if is_angle {
        let turn = Float::with_val(BITS, Constant::Pi) * 2_u32;
        let turns = Float::with_val(BITS, &difference.re / &turn).round();
        difference.re -= turns * turn;
    }
    difference.size().to_f64()
}
