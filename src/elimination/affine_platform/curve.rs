//! The forms on the curve of two quadrics in the projective space of the quaternion z: a free module over the forms in
//! `z_0, z_3`, with the basis 1, z_1, z_2, z_1 z_2.

use crate::closure::study::Form;
use crate::elimination::border::Arithmetic;

/// A form of some degree d: the coefficients of `z_0^(d-j) z_3^j` beside 1, one power fewer beside z_1 and z_2, and two powers
/// fewer beside z_1 z_2.
#[derive(Clone, Debug)]
pub struct Element<E> {
    pub parts: [Vec<E>; 4],
    pub degree: usize,
}

/// Returns the number of coefficients of each part of a form.
pub fn lengths(degree: usize) -> [usize; 4] {
    [degree + 1, degree, degree, degree.saturating_sub(1)]
}

/// A form in z_0 and z_3, and the element it multiplies.
type Term<'a, E> = (&'a Vec<E>, Element<E>);

/// The curve.
pub struct Curve<'a, A: Arithmetic> {
    field: &'a A,
    /// z_1^2, z_2^2, z_1^2 z_2 and z_1 z_2^2.
    squares: [Element<A::Element>; 2],
    mixed: [Element<A::Element>; 2],
}

impl<'a, A: Arithmetic> Curve<'a, A> {
    /// Returns the curve of two quadrics; `None` where they cannot be solved for z_1^2 and z_2^2, or `inverse` does not exist.
    pub fn new(
        field: &'a A,
        inverse: impl Fn(A::Element) -> Option<A::Element>,
        quadrics: [&Form<A::Element>; 2],
    ) -> Option<Self> {
        let [p, q] = quadrics;
        let mul = |a, b| field.mul(a, b);
        let determinant = field.sub(mul(p[1][1], q[2][2]), mul(p[2][2], q[1][1]));
        let scale = inverse(determinant)?;
        // -(c p + d q) without its squares.
        let solved = |c: A::Element, d: A::Element| {
            let (c, d) = (field.neg(mul(c, scale)), field.neg(mul(d, scale)));
            let mut element = Self::quadratic(field, |j, k| field.add(mul(c, p[j][k]), mul(d, q[j][k])));
            element.degree = 2;
            element
        };
        let squares = [solved(q[2][2], field.neg(p[2][2])), solved(field.neg(q[1][1]), p[1][1])];
        let zero = Self::nothing(field, 3);
        let mut curve = Self { field, squares, mixed: [zero.clone(), zero] };
        // z_1^2 z_2 = alpha z_1 z_2^2 + u and z_1 z_2^2 = beta z_1^2 z_2 + v, reduced by the lower terms already known.
        let [one, two] = curve.squares.each_ref();
        let (alpha, beta) = (one.parts[3][0], two.parts[3][0]);
        let u =
            curve.sum(&[(&one.parts[1], curve.unit(3)), (&one.parts[2], two.clone()), (&one.parts[0], curve.unit(2))]);
        let v =
            curve.sum(&[(&two.parts[1], one.clone()), (&two.parts[2], curve.unit(3)), (&two.parts[0], curve.unit(1))]);
        let scale = inverse(field.sub(field.one(), mul(alpha, beta)))?;
        let mix = |x: &Element<A::Element>, y: &Element<A::Element>, factor| {
            curve.sum(&[(&vec![scale], x.clone()), (&vec![mul(scale, factor)], y.clone())])
        };
        let mixed = [mix(&u, &v, alpha), mix(&v, &u, beta)];
        curve.mixed = mixed;
        Some(curve)
    }

    fn nothing(field: &A, degree: usize) -> Element<A::Element> {
        Element { parts: lengths(degree).map(|length| vec![field.zero(); length]), degree }
    }

    /// A quadric without its terms in z_1^2 and z_2^2, from the entries of its symmetric matrix.
    fn quadratic(field: &A, entry: impl Fn(usize, usize) -> A::Element) -> Element<A::Element> {
        let twice = |j, k| field.add(entry(j, k), entry(j, k));
        let parts = [
            vec![entry(0, 0), twice(0, 3), entry(3, 3)],
            vec![twice(0, 1), twice(1, 3)],
            vec![twice(0, 2), twice(2, 3)],
            vec![twice(1, 2)],
        ];
        Element { parts, degree: 2 }
    }

    /// 1, z_1, z_2 or z_1 z_2.
    fn unit(&self, part: usize) -> Element<A::Element> {
        let mut element = Self::nothing(self.field, [0, 1, 1, 2][part]);
        element.parts[part][0] = self.field.one();
        element
    }

    /// The form `z_0^(d-j) z_3^j` times 1, z_1, z_2 or z_1 z_2.
    pub fn monomial(&self, (part, power): (usize, usize), degree: usize) -> Element<A::Element> {
        let mut element = Self::nothing(self.field, degree);
        element.parts[part][power] = self.field.one();
        element
    }

    /// The sum of products of forms in z_0 and z_3 with others, all of one degree.
    fn sum(&self, terms: &[Term<A::Element>]) -> Element<A::Element> {
        let present = terms.iter().filter(|(factor, _)| !factor.is_empty());
        let degree = present.map(|(factor, element)| element.degree + factor.len() - 1).max().unwrap_or(0);
        let mut sum = Self::nothing(self.field, degree);
        for (factor, element) in terms {
            for (target, source) in sum.parts.iter_mut().zip(&element.parts) {
                for (j, &c) in factor.iter().enumerate().filter(|_| !source.is_empty()) {
                    self.field.add_multiple(&mut target[j..j + source.len()], c, source);
                }
            }
        }
        sum
    }

    /// A linear form.
    pub fn linear(form: &[A::Element; 4]) -> Element<A::Element> {
        let parts = [vec![form[0], form[3]], vec![form[1]], vec![form[2]], Vec::new()];
        Element { parts, degree: 1 }
    }

    /// A quadric.
    pub fn quadric(&self, form: &Form<A::Element>) -> Element<A::Element> {
        let rest = Self::quadratic(self.field, |j, k| form[j][k]);
        let [one, two] = self.squares.each_ref();
        let unit = vec![self.field.one()];
        self.sum(&[(&unit, rest), (&vec![form[1][1]], one.clone()), (&vec![form[2][2]], two.clone())])
    }

    /// The product with z_1.
    pub fn times_first(&self, f: &Element<A::Element>) -> Element<A::Element> {
        let [one, first, second, both] = &f.parts;
        let [square, mixed] = [&self.squares[0], &self.mixed[0]];
        self.sum(&[(one, self.unit(1)), (first, square.clone()), (second, self.unit(3)), (both, mixed.clone())])
    }

    /// The product with z_2.
    pub fn times_second(&self, f: &Element<A::Element>) -> Element<A::Element> {
        let [one, first, second, both] = &f.parts;
        let [square, mixed] = [&self.squares[1], &self.mixed[1]];
        self.sum(&[(one, self.unit(2)), (first, self.unit(3)), (second, square.clone()), (both, mixed.clone())])
    }

    /// The product with z_3.
    pub fn times_third(&self, f: &Element<A::Element>) -> Element<A::Element> {
        self.sum(&[(&vec![self.field.zero(), self.field.one()], f.clone())])
    }

    /// The product of two forms.
    pub fn product(&self, f: &Element<A::Element>, g: &Element<A::Element>) -> Element<A::Element> {
        let (first, second) = (self.times_first(f), self.times_second(f));
        let both = self.times_second(&first);
        let [a, b, c, d] = &g.parts;
        let terms = [(a, f.clone()), (b, first), (c, second), (d, both)];
        let mut product = self.sum(&terms);
        product.degree = f.degree + g.degree;
        product
    }

    /// The sum of forms of one degree with factors.
    pub fn combined(&self, terms: &[(A::Element, &Element<A::Element>)]) -> Element<A::Element> {
        let factors: Vec<Vec<A::Element>> = terms.iter().map(|(factor, _)| vec![*factor]).collect();
        let terms: Vec<_> = factors.iter().zip(terms).map(|(factor, (_, f))| (factor, (*f).clone())).collect();
        self.sum(&terms)
    }
}
