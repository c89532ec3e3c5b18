//! Platforms whose base and plate are affine images of the same six points: similar, affine, mirrored and congruent plates, and
//! plane ones of the same kind. Solutions with `N = x.x = 0` form curves there, and the border basis of general platforms does
//! not exist.
//!
//! With `a_i = E u_i` and `b_i = M u_i` the legs are `s + 2 u_i.v = c_i(x)/N`, with `s = p.p` and `v = (R M - E)^T p`. Points of
//! space leave two quadrics in the quaternion x when s and v are eliminated, and `p.p = s` is a form of degree 8 in x on the
//! curve in which these meet: 32 rotations. Where the plate is similar to the base, it is one of degree 6, and where it is
//! congruent, v is perpendicular to the axis of R, a cubic, and p is one of two. Points of a plane leave three quadrics,
//! and two positions. docs/platforms.md has the proofs.

mod algebra;
mod curve;
mod form;
mod relation;

use super::border::Arithmetic;
use super::platform_degree::Products;
use crate::closure::study::{Form, linear_legs, right};
use crate::kinematics::motion::{Vector, cross};
use crate::kinematics::platform::Platform;
use algebra::Images;
use form::{
    Matrix, cofactors, combination, determinant, difference, norm_form, of_columns, rotation_form, times_transposed,
    transposed,
};
pub use relation::AffineRelation;
use rug::Rational;

/// The relation between rotation and position.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one for every platform")]
enum Kind {
    /// Points of a plane: three quadrics. The normal is N times the normal of both rows of `R M - E`, transposed.
    Plane { third: Form<Rational>, normal: [Form<Rational>; 3] },
    /// The plate is congruent to the base: the axis of the rotation R Q, with `M = Q`, and its square.
    Congruent { axis: [[Rational; 4]; 3], apart: Form<Rational> },
    /// The plate is similar to the base, `M = ratio Q`: `(ratio - 1)^2 w^2 + (ratio + 1)^2 axis^2` is not 0 where R determines p.
    /// The squared length of the quaternion of R Q is `length` times the squared length of the quaternion of R.
    Similar { ratio: Rational, length: Rational, axis: [[Rational; 4]; 3], apart: Form<Rational> },
    /// The cofactors of `N (R M - E)` over N, and its determinant over N^2.
    General { cofactors: [[Form<Rational>; 3]; 3], determinant: Form<Rational> },
}

/// A platform of this kind, with its legs.
#[derive(Clone, Debug)]
pub struct AffinePlatform {
    /// The points u_i.
    pub relation: AffineRelation,
    /// The form N s.
    pub square: Form<Rational>,
    /// The forms N v, one per coordinate of the points u_i; where the base spans space, its points serve as the u_i.
    pub moments: Vec<Form<Rational>>,
    norm: Form<Rational>,
    quadrics: [Form<Rational>; 2],
    kind: Kind,
}

/// The largest number of isolated poses of such a platform, with the reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AffineBound {
    /// The number, with multiplicity.
    pub poses: usize,
    /// The reason.
    pub because: &'static str,
}

/// The ratio k and the rotation Q of a matrix `k Q`.
fn similarity(m: &Matrix) -> Option<(Rational, Matrix)> {
    let square = times_transposed(&transposed(m), &transposed(m));
    let scale = &square[0][0];
    let is_similar = (0..9).all(|e| square[e / 3][e % 3] == if e % 4 == 0 { scale.clone() } else { Rational::new() });
    if *scale == 0 || !is_similar {
        return None;
    }
    let ratio = determinant(m, &cofactors(m)) / scale;
    let rotation = m.each_ref().map(|row| row.each_ref().map(|x| Rational::from(x / &ratio)));
    Some((ratio, rotation))
}

/// A quaternion q of a rotation Q, of any length: `q q^T` is a multiple of `1 + sum_ij Q_ij (N R)_ij`.
fn quaternion(rotation: &Matrix) -> Option<[Rational; 4]> {
    let form = combination([
        (Rational::from(1), &rotation_form(rotation)),
        (Rational::from(1), &norm_form(&Rational::from(1))),
    ]);
    form.into_iter().enumerate().find(|(k, row)| row[*k] != 0).map(|(_, row)| row)
}

/// The quaternion `x q` as four linear forms in x.
fn times_quaternion(q: &[Rational; 4]) -> [[Rational; 4]; 4] {
    let [w, x, y, z] = q.clone();
    let mut matrix = right(&[x, y, z]);
    for (k, row) in matrix.iter_mut().enumerate() {
        row[k] += &w;
    }
    matrix
}

/// The form `sum_k c_k (l_k.x)^2`.
fn sum_of_squares(terms: &[(Rational, &[Rational; 4])]) -> Form<Rational> {
    std::array::from_fn(|i| std::array::from_fn(|j| terms.iter().map(|(c, l)| Rational::from(&l[i] * &l[j]) * c).sum()))
}

/// The matrix whose product with N R has `x_i = (N R y)_i` as entry.
fn image_form(i: usize, y: &Vector<Rational>) -> Form<Rational> {
    let mut matrix: Matrix = std::array::from_fn(|_| std::array::from_fn(|_| Rational::new()));
    matrix[i] = y.clone();
    rotation_form(&matrix)
}

impl AffineRelation {
    /// Returns E and M with the points of the base for u_i where these span space, and unchanged otherwise.
    fn matrices(&self) -> (Matrix, Matrix, bool) {
        let [e, m] = [&self.columns[0], &self.columns[1]].map(|columns| of_columns(columns));
        let c = cofactors(&e);
        let d = determinant(&e, &c);
        if d == 0 {
            return (e, m, false);
        }
        // M E^-1
        let inverse = transposed(&c).map(|row| row.map(|x| x / &d));
        let product = times_transposed(&m, &transposed(&inverse));
        let one = |i: usize, j: usize| Rational::from(i32::from(i == j));
        (std::array::from_fn(|i| std::array::from_fn(|j| one(i, j))), product, true)
    }

    /// The largest number of isolated poses, whatever the legs are.
    #[must_use]
    pub fn bound(&self) -> AffineBound {
        if self.dimension() == 2 {
            return AffineBound { poses: 16, because: "base and plate are affine images of six points of a plane" };
        }
        let (_, m, spans) = self.matrices();
        if spans && similarity(&m).is_some() {
            return AffineBound { poses: 24, because: "base and plate are similar" };
        }
        AffineBound { poses: 32, because: "base and plate are affine images of the same six points" }
    }
}

impl AffinePlatform {
    /// Returns the platform with legs of these squared lengths; `None` where its points have no such relation.
    #[must_use]
    pub fn new(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Option<Self> {
        let relation = AffineRelation::of(platform)?;
        let centred = relation.centred(platform);
        let legs = linear_legs(&centred);
        let one = || Rational::from(1);
        let forms: [Form<Rational>; 6] =
            std::array::from_fn(|i| combination([(one(), &legs.forms[i]), (one(), &norm_form(&squares[i]))]));
        let square = forms[0].clone();
        let half = || Rational::from((1, 2));
        let mut moments: Vec<Form<Rational>> =
            relation.units.iter().map(|&i| combination([(half(), &forms[i]), (-half(), &square)])).collect();
        let rest = (1..6).filter(|i| !relation.units.contains(i)).map(|i| {
            let known = relation.points[i].iter().zip(&moments).map(|(u, w)| (Rational::from(u * -2), w));
            combination(known.chain([(one(), &forms[i]), (-one(), &square)]))
        });
        let quadrics: Vec<Form<Rational>> = rest.collect();
        let kind = if relation.dimension() == 2 {
            Kind::Plane { third: quadrics.get(2)?.clone(), normal: normal(&relation.columns) }
        } else {
            let (e, m, spans) = relation.matrices();
            if spans {
                // v changes with the points u_i, by the inverse transposed.
                let c = cofactors(&of_columns(&relation.columns[0]));
                let d = determinant(&of_columns(&relation.columns[0]), &c);
                let part = |k: usize| combination((0..3).map(|j| (Rational::from(&c[k][j] / &d), &moments[j])));
                moments = (0..3).map(part).collect();
            }
            space(&e, &m, spans)?
        };
        let quadrics = [quadrics[0].clone(), quadrics[1].clone()];
        Some(Self { relation, square, moments, norm: norm_form(&one()), quadrics, kind })
    }

    /// Returns the number of rotations, with multiplicity, and the number of positions that belong to each.
    #[must_use]
    pub fn counts(&self) -> (usize, usize) {
        match self.kind {
            Kind::Plane { .. } => (8, 2),
            Kind::Congruent { .. } => (12, 2),
            Kind::Similar { .. } => (24, 1),
            Kind::General { .. } => (32, 1),
        }
    }

    /// Returns the columns of E and M that form the moments.
    #[must_use]
    pub fn columns(&self) -> [Vec<Vector<Rational>>; 2] {
        if self.relation.dimension() == 2 {
            return self.relation.columns.clone();
        }
        let (e, m, _) = self.relation.matrices();
        [e, m].map(|matrix| transposed(&matrix).to_vec())
    }

    /// Multiplication by `z_i / z_0`, i = 1..3, on the functions on all rotations z: row k is the product with basis element k, and
    /// the first four of these are 1 and the three quotients. `None` where z_0 vanishes at a rotation, or a number that is not 0
    /// has no inverse or no image.
    #[must_use]
    pub fn products<A: Arithmetic>(
        &self,
        field: &A,
        inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
        image: impl Fn(&Rational) -> Option<A::Element>,
    ) -> Option<Products<A::Element>> {
        Images { field, image }.products(inverse, self)
    }

    /// As [`Self::products`], but `None` unless every rotation belongs to as many isolated poses as [`AffinePlatform::counts`]
    /// says.
    #[must_use]
    pub fn products_of_poses<A: Arithmetic>(
        &self,
        field: &A,
        inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
        image: impl Fn(&Rational) -> Option<A::Element>,
    ) -> Option<Products<A::Element>> {
        let images = Images { field, image };
        let products = images.products(inverse, self)?;
        images.are_all_poses(inverse, self, &products)?.then_some(products)
    }
}

/// N times the product of both columns of `R M - E`, over N^2.
fn normal([e, m]: &[Vec<Vector<Rational>>; 2]) -> [Form<Rational>; 3] {
    let turned = cross(&m[0], &m[1]);
    let still = cross(&e[0], &e[1]);
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        // (R m_0 x e_1 + e_0 x R m_1)_i
        let terms = [
            (e[1][k].clone(), image_form(j, &m[0])),
            (-e[1][j].clone(), image_form(k, &m[0])),
            (e[0][j].clone(), image_form(k, &m[1])),
            (-e[0][k].clone(), image_form(j, &m[1])),
        ];
        let mixed = combination(terms.iter().map(|(c, form)| (c.clone(), form)));
        let ends =
            combination([(Rational::from(1), &image_form(i, &turned)), (still[i].clone(), &norm_form(&1.into()))]);
        difference(&ends, &mixed)
    })
}

/// Returns the relation of rotation and position where the points span space.
fn space(e: &Matrix, m: &Matrix, spans: bool) -> Option<Kind> {
    if spans && let Some((ratio, rotation)) = similarity(m) {
        let q = quaternion(&rotation)?;
        let length = q.iter().map(|c| Rational::from(c * c)).sum();
        let [w, x, y, z] = times_quaternion(&q);
        let axis = [x, y, z];
        let [less, more] = [-1, 1].map(|sign| Rational::from(&ratio + sign).square());
        let square = |factor: &Rational| axis.each_ref().map(|l| (factor.clone(), l));
        if ratio == 1 {
            let apart = sum_of_squares(&square(&ratio));
            return Some(Kind::Congruent { axis, apart });
        }
        let [a, b, c] = square(&more);
        let apart = sum_of_squares(&[(less, &w), a, b, c]);
        return Some(Kind::Similar { ratio, length, axis, apart });
    }
    let (ce, cm) = (cofactors(e), cofactors(m));
    let column = |matrix: &Matrix, j: usize| -> Vector<Rational> { std::array::from_fn(|i| matrix[i][j].clone()) };
    let one = || Rational::from(1);
    let cofactor = |i: usize, j: usize| {
        let at = |k: usize, l: usize| image_form((i + k) % 3, &column(m, (j + l) % 3));
        let e = |k: usize, l: usize| e[(i + k) % 3][(j + l) % 3].clone();
        let terms = [(e(2, 2), at(1, 1)), (e(1, 1), at(2, 2)), (-e(2, 1), at(1, 2)), (-e(1, 2), at(2, 1))];
        let mixed = combination(terms.iter().map(|(c, form)| (c.clone(), form)));
        let ends = combination([(one(), &image_form(i, &column(&cm, j))), (one(), &norm_form(&ce[i][j]))]);
        difference(&ends, &mixed)
    };
    let constant = determinant(m, &cm) - determinant(e, &ce);
    let determinant = combination([
        (one(), &norm_form(&constant)),
        (-one(), &rotation_form(&times_transposed(e, &cm))),
        (one(), &rotation_form(&times_transposed(&ce, m))),
    ]);
    Some(Kind::General { cofactors: std::array::from_fn(|i| std::array::from_fn(|j| cofactor(i, j))), determinant })
}

#[cfg(test)]
mod tests;
