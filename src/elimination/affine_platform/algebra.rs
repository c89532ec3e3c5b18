//! The quotient algebra of the rotations of a platform.

use super::curve::{Curve, Element, lengths};
use super::{AffinePlatform, Kind};
use crate::closure::study::Form;
use crate::elimination::border::Arithmetic;
use crate::elimination::platform_degree::{Products, echelon, row_times};
use rug::Rational;

/// Monomials of degree 2, to multiply the last form with.
const QUADRATIC: [(usize, usize); 8] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1), (3, 0)];
/// Every basis has these monomials of degree 1: z_0, z_1, z_2, z_3, times a power of z_0.
const FIRST: [(usize, usize); 4] = [(0, 0), (1, 0), (2, 0), (0, 1)];

/// Monomials of a degree that the last form is solved for: all those without z_0, and of those with one or two z_0 as many as the
/// products of the form with linear forms allow.
fn solved_for(degree: usize) -> [(usize, usize); 8] {
    let [zero, one, two] = [degree, degree - 1, degree - 2];
    [(0, zero), (1, one), (2, one), (3, two), (0, one), (1, two), (2, two), (0, two)]
}

/// The monomials of a degree: part and power of z_3.
fn monomials(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    lengths(degree).into_iter().enumerate().flat_map(|(part, length)| (0..length).map(move |power| (part, power)))
}

/// A map of forms.
type Map<'a, E> = &'a dyn Fn(&Element<E>) -> Element<E>;

/// Forms over a field of coefficients.
pub struct Images<'a, A: Arithmetic, F> {
    /// The field.
    pub field: &'a A,
    /// Maps rational numbers to the field; `None` where a number has no image.
    pub image: F,
}

impl<A: Arithmetic, F: Fn(&Rational) -> Option<A::Element>> Images<'_, A, F> {
    fn form(&self, form: &Form<Rational>) -> Option<Form<A::Element>> {
        let mut image = [[self.field.zero(); 4]; 4];
        for j in 0..4 {
            for k in j..4 {
                image[j][k] = (self.image)(&form[j][k])?;
                image[k][j] = image[j][k];
            }
        }
        Some(image)
    }

    fn vector(&self, v: &[Rational; 4]) -> Option<[A::Element; 4]> {
        let [a, b, c, d] = v.each_ref().map(&self.image);
        Some([a?, b?, c?, d?])
    }

    /// The last form, beside two quadrics, as a form on their curve.
    fn last(&self, platform: &AffinePlatform, curve: &Curve<A>) -> Option<Element<A::Element>> {
        let field = self.field;
        let one = field.one();
        let quadric = |form: &Form<Rational>| Some(curve.quadric(&self.form(form)?));
        let quadrics = |forms: &[Form<Rational>]| forms.iter().map(quadric).collect::<Option<Vec<_>>>();
        // sum of products of the members of two lists
        let dot = |p: &[Element<A::Element>], q: &[Element<A::Element>]| {
            let products: Vec<_> = p.iter().zip(q).map(|(p, q)| curve.product(p, q)).collect();
            curve.combined(&products.iter().map(|product| (one, product)).collect::<Vec<_>>())
        };
        let moments = || quadrics(&platform.moments);
        let along = |axis: &[[Rational; 4]; 3]| {
            let axis: Option<Vec<_>> = axis.iter().map(|form| Some(Curve::<A>::linear(&self.vector(form)?))).collect();
            Some(dot(&axis?, &moments()?))
        };
        match &platform.kind {
            Kind::Plane { third, .. } => quadric(third),
            Kind::Congruent { axis, .. } => along(axis),
            Kind::Similar { ratio, length, axis, apart } => {
                let (along, moments) = (along(axis)?, moments()?);
                let (norm, apart, square) = (quadric(&platform.norm)?, quadric(apart)?, quadric(&platform.square)?);
                let less = Rational::from(ratio - 1).square();
                let [four, less, middle] =
                    [Rational::from(4) * ratio, less.clone(), less * length].each_ref().map(|x| (self.image)(x));
                let (four, less, middle) = (four?, less?, middle?);
                let [first, second, third] = [
                    curve.product(&along, &along),
                    curve.product(&norm, &dot(&moments, &moments)),
                    curve.product(&square, &curve.product(&norm, &apart)),
                ];
                Some(curve.combined(&[(four, &first), (middle, &second), (field.neg(less), &third)]))
            }
            Kind::General { cofactors, determinant } => {
                let moments = moments()?;
                let rows = cofactors.iter().map(|row| Some(dot(&quadrics(row)?, &moments)));
                let rows: Vec<_> = rows.collect::<Option<_>>()?;
                let (norm, square, determinant) =
                    (quadric(&platform.norm)?, quadric(&platform.square)?, quadric(determinant)?);
                let right = curve.product(&curve.product(&square, &norm), &curve.product(&determinant, &determinant));
                Some(curve.combined(&[(one, &dot(&rows, &rows)), (field.neg(one), &right)]))
            }
        }
    }

    /// Multiplication by `z_i / z_0`, i = 1..3, on the functions on all rotations: row k is the product with basis element k, and
    /// the first four of these are 1 and the three quotients. `None` where z_0 vanishes at a rotation, or a number that is not 0
    /// has no inverse.
    pub fn products(
        &self,
        inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
        platform: &AffinePlatform,
    ) -> Option<Products<A::Element>> {
        let field = self.field;
        let [p, q] = platform.quadrics.each_ref().map(|form| self.form(form));
        let (p, q) = (p?, q?);
        let curve = Curve::new(field, inverse, [&p, &q])?;
        let last = self.last(platform, &curve)?;
        let degree = last.degree + 2;
        let high = solved_for(degree);
        let low: Vec<_> = FIRST
            .into_iter()
            .chain(monomials(degree).filter(|monomial| !FIRST.contains(monomial) && !high.contains(monomial)))
            .collect();
        let columns: Vec<_> = high.iter().chain(&low).copied().collect();
        let flat = |element: &Element<A::Element>| -> Vec<A::Element> {
            columns.iter().map(|&(part, power)| element.parts[part][power]).collect()
        };
        let mut rows: Vec<Vec<A::Element>> =
            QUADRATIC.iter().map(|&monomial| flat(&curve.product(&last, &curve.monomial(monomial, 2)))).collect();
        let pivots = echelon(field, inverse, &mut rows)?;
        if !pivots.iter().copied().eq(0..high.len()) {
            return None;
        }
        let normal = |element: &Element<A::Element>| {
            let flat = flat(element);
            let (above, below) = flat.split_at(high.len());
            let mut normal = below.to_vec();
            for (&c, row) in above.iter().zip(&rows) {
                field.add_multiple(&mut normal, field.neg(c), &row[high.len()..]);
            }
            normal
        };
        // One z_0 less in every basis element.
        let below: Vec<_> = low.iter().map(|&monomial| curve.monomial(monomial, degree - 1)).collect();
        let matrix = |times: Map<A::Element>| below.iter().map(|element| normal(&times(element))).collect();
        Some([matrix(&|f| curve.times_first(f)), matrix(&|f| curve.times_second(f)), matrix(&|f| curve.times_third(f))])
    }

    /// Returns whether every rotation belongs to isolated poses: the norm, and the form that vanishes at rotations with several
    /// positions, vanish at none of them.
    pub fn are_all_poses(
        &self,
        inverse: impl Fn(A::Element) -> Option<A::Element> + Copy,
        platform: &AffinePlatform,
        products: &Products<A::Element>,
    ) -> Option<bool> {
        let field = self.field;
        let value = |form: &Form<Rational>| Some(value(field, &self.form(form)?, products));
        let is_unit = |mut matrix: Vec<Vec<A::Element>>| {
            let size = matrix.len();
            Some(echelon(field, inverse, &mut matrix)?.len() == size)
        };
        let apart = match &platform.kind {
            Kind::Plane { normal, .. } => {
                let mut sum: Option<Vec<Vec<A::Element>>> = None;
                for form in normal {
                    let value = value(form)?;
                    let square: Vec<_> = value.iter().map(|row| row_times(field, row, &value)).collect();
                    sum = Some(match sum {
                        None => square,
                        Some(sum) => added(field, sum, &square),
                    });
                }
                sum?
            }
            Kind::Congruent { apart, .. } | Kind::Similar { apart, .. } => value(apart)?,
            Kind::General { determinant, .. } => value(determinant)?,
        };
        Some(is_unit(value(&platform.norm)?)? && is_unit(apart)?)
    }
}

fn added<A: Arithmetic>(field: &A, mut sum: Vec<Vec<A::Element>>, other: &[Vec<A::Element>]) -> Vec<Vec<A::Element>> {
    for (row, other) in sum.iter_mut().zip(other) {
        field.add_multiple(row, field.one(), other);
    }
    sum
}

/// Multiplication by a quadric over `z_0^2`.
fn value<A: Arithmetic>(field: &A, form: &Form<A::Element>, products: &Products<A::Element>) -> Vec<Vec<A::Element>> {
    let size = products[0].len();
    let identity = |factor: A::Element| -> Vec<Vec<A::Element>> {
        (0..size).map(|i| (0..size).map(|j| if i == j { factor } else { field.zero() }).collect()).collect()
    };
    // Horner's rule: z_j times the linear form of row j.
    let linear = |j: usize| {
        let mut sum = identity(form[j][0]);
        for (k, matrix) in products.iter().enumerate() {
            for (row, other) in sum.iter_mut().zip(matrix) {
                field.add_multiple(row, form[j][k + 1], other);
            }
        }
        sum
    };
    let mut sum = linear(0);
    for (j, matrix) in products.iter().enumerate() {
        let linear = linear(j + 1);
        let product: Vec<_> = linear.iter().map(|row| row_times(field, row, matrix)).collect();
        sum = added(field, sum, &product);
    }
    sum
}
