//! Four rotations and two translations: a spherical four-bar and one scalar, degree 8.
//!
//! The rotations of the loop close by themselves: the axes of the link opposite to link a keep their angle, `f = 0`,
//! bilinear in (1, cos, sin) of the rotations a and a + 1. The translations close if their directions u, v and the sum
//! of the links are coplanar, `g = sum_k [u, v, s_k] = 0`. Reduced modulo f, g is bilinear in the same two angles: a
//! vector w of the opposite link is `al z+ + be z- + ga z+ x z-` with its two axes z+ (of rotation a + 2) and z- (of
//! rotation a - 1), which the other three links reach, and
//!
//! `(u x v).(z+ x z-) = (u x z-).(z+ x v) + cos(alpha_opposite) (u.v) - (u.z-)(v.z+)`  (mod f),
//!
//! every factor of which has one angle only. Eliminating one angle from f and g leaves a polynomial of degree 8 in the half-angle
//! tangent of the other one, without an extraneous factor.

use crate::algebra::ring::{Field, Ring};
use crate::kinematics::link_form::{LinkForm, product, turned};
use crate::kinematics::motion::{Vector, cross, dot};

/// Coefficients over `(1, cos a, sin a) x (1, cos b, sin b)`, b = a + 1.
pub type Form<R> = [[R; 3]; 3];

/// A vector over (1, cos, sin) of one angle.
type Turning<R> = [Vector<R>; 3];

/// The link in which a vector is fixed, counted from link a - 1: 0, 1 and 2 are reached from link a, 3 is opposite.
type Place = usize;

/// A loop with four rotations seen from link a.
pub struct FourBar<'a, R> {
    form: &'a LinkForm<R, 4, 2>,
    /// Link a.
    pub base: usize,
    /// The axis of rotation a + 2, in link a + 1.
    plus: Vector<R>,
    /// The axis of rotation a - 1, in link a - 1.
    minus: Vector<R>,
    /// The axis of rotation a - 1 in the opposite link.
    opposite: Vector<R>,
    /// One over the squared sine of the twist of that link.
    inverse: R,
}

/// The two closure equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations<R> {
    /// The spherical four-bar.
    pub f: Form<R>,
    /// The translations.
    pub g: Form<R>,
}

fn zero_form<R: Ring>() -> Form<R> {
    std::array::from_fn(|_| std::array::from_fn(|_| R::zero()))
}

fn combine<R: Ring>(terms: &[(&R, Form<R>)]) -> Form<R> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| terms.iter().fold(R::zero(), |sum, (factor, form)| sum.add(&factor.mul(&form[i][j]))))
    })
}

fn negative<R: Ring>(form: &Form<R>) -> Form<R> {
    form.each_ref().map(|row| row.each_ref().map(R::neg))
}

fn constant<R: Ring>(value: R) -> Form<R> {
    let mut form = zero_form();
    form[0][0] = value;
    form
}

/// The products of the values of one angle with those of the other.
fn outer<R: Ring>(a: &[R; 3], b: &[R; 3]) -> Form<R> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i].mul(&b[j])))
}

/// Returns a vector that does not turn.
fn still<R: Ring>(x: &Vector<R>) -> Turning<R> {
    let zero = || std::array::from_fn(|_| R::zero());
    [x.clone(), zero(), zero()]
}

/// `Rz(-q) r^T x` over (1, cos q, sin q).
fn behind<R: Ring>(r: &[[R; 3]; 3], x: &Vector<R>) -> Turning<R> {
    let y: Vector<R> = std::array::from_fn(|j| (0..3).fold(R::zero(), |sum, i| sum.add(&r[i][j].mul(&x[i]))));
    let [y1, y2, y3] = y;
    let nought = R::zero;
    [[nought(), nought(), y3], [y1.clone(), y2.clone(), nought()], [y2, y1.neg(), nought()]]
}

/// `r Rz(q) x` over (1, cos q, sin q).
fn ahead<R: Ring>(r: &[[R; 3]; 3], x: &Vector<R>) -> Turning<R> {
    let column = |j: usize| -> Vector<R> { std::array::from_fn(|i| r[i][j].clone()) };
    let scale = |v: Vector<R>, k: &R| v.map(|y| y.mul(k));
    let plus = |v: Vector<R>, w: Vector<R>| -> Vector<R> { std::array::from_fn(|i| v[i].add(&w[i])) };
    [
        scale(column(2), &x[2]),
        plus(scale(column(0), &x[0]), scale(column(1), &x[1])),
        plus(scale(column(1), &x[0]), scale(column(0), &x[1].neg())),
    ]
}

/// The spherical four-bar f from the rotations of links a - 1, a, a + 1 and a + 2. Over dual numbers its dual part is
/// the moment of the same two axes. \[Wittenburg2016\]
#[must_use]
pub fn four_bar<R: Ring>([before, base, after, opposite]: [&[[R; 3]; 3]; 4]) -> Form<R> {
    let minus = [R::zero(), R::zero(), R::one()];
    let plus: Vector<R> = std::array::from_fn(|i| after[i][2].clone());
    let (minus, plus) = (behind(before, &minus), ahead(base, &plus));
    let mut f: Form<R> = std::array::from_fn(|k| std::array::from_fn(|l| dot(&minus[k], &plus[l])));
    f[0][0] = f[0][0].sub(&opposite[2][2]);
    f
}

impl<'a, F: Field> FourBar<'a, F> {
    /// The loop seen from link a; `None` where the axes of the opposite link are parallel.
    #[must_use]
    pub fn new(form: &'a LinkForm<F, 4, 2>, base: usize) -> Option<Self> {
        let axis = |link: usize| -> Vector<F> { std::array::from_fn(|i| form.links[link % 4].rotation[i][2].clone()) };
        let inverse = form.twist(base + 2).0.inverse()?;
        let minus = [F::zero(), F::zero(), F::one()];
        Some(Self { form, base, plus: axis(base + 1), minus, opposite: axis(base + 2), inverse })
    }

    fn link(&self, place: Place) -> &[[F; 3]; 3] {
        &self.form.links[(self.base + place + 3) % 4].rotation
    }

    /// A vector of link a - 1 or a in link a, over (1, cos a, sin a).
    fn behind(&self, place: Place, x: &Vector<F>) -> Turning<F> {
        if place == 1 { still(x) } else { behind(self.link(0), x) }
    }

    /// A vector of link a or a + 1 in link a, over (1, cos b, sin b).
    fn ahead(&self, place: Place, x: &Vector<F>) -> Turning<F> {
        if place == 1 { still(x) } else { ahead(self.link(1), x) }
    }

    /// The scalar product of two vectors of links a - 1, a and a + 1.
    fn near_dot(&self, (i, x): (Place, &Vector<F>), (j, y): (Place, &Vector<F>)) -> Form<F> {
        if i == j {
            return constant(dot(x, y));
        }
        if i > j {
            return self.near_dot((j, y), (i, x));
        }
        let (a, b) = (self.behind(i, x), self.ahead(j, y));
        std::array::from_fn(|k| std::array::from_fn(|l| dot(&a[k], &b[l])))
    }

    /// A vector of the opposite link as `al z+ + be z- + ga z+ x z-`.
    fn resolved(&self, w: &Vector<F>) -> [F; 3] {
        let m = &self.opposite;
        let be = w[0].mul(&m[0]).add(&w[1].mul(&m[1])).mul(&self.inverse);
        let ga = m[0].mul(&w[1]).sub(&m[1].mul(&w[0])).mul(&self.inverse);
        [w[2].sub(&be.mul(&m[2])), be, ga]
    }

    /// The scalar product of two vectors of any links, modulo f.
    fn dot(&self, (i, x): (Place, &Vector<F>), (j, y): (Place, &Vector<F>)) -> Form<F> {
        match (i, j) {
            (3, 3) => constant(dot(x, y)),
            (3, _) => self.dot((j, y), (i, x)),
            (_, 3) => {
                let [al, be, ga] = self.resolved(y);
                let (plus, minus) = (&self.plus, &self.minus);
                let normal = match i {
                    2 => self.near_dot((2, &cross(x, plus)), (0, minus)),
                    0 => self.near_dot((0, &cross(minus, x)), (2, plus)),
                    _ => {
                        let turning = self.behind(0, minus).map(|z| cross(&z, x));
                        let ahead = self.ahead(2, plus);
                        std::array::from_fn(|k| std::array::from_fn(|l| dot(&turning[k], &ahead[l])))
                    }
                };
                combine(&[
                    (&al, self.near_dot((i, x), (2, plus))),
                    (&be, self.near_dot((i, x), (0, minus))),
                    (&ga, normal),
                ])
            }
            _ => self.near_dot((i, x), (j, y)),
        }
    }

    /// The triple product of three vectors of any links, modulo f.
    fn triple(&self, [x, y, z]: [(Place, &Vector<F>); 3]) -> Form<F> {
        // Two vectors of one link, brought to the front cyclically, are crossed there.
        for [x, y, z] in [[x, y, z], [y, z, x], [z, x, y]] {
            if x.0 == y.0 {
                return self.dot((x.0, &cross(x.1, y.1)), z);
            }
        }
        for [x, y, z] in [[x, y, z], [y, z, x], [z, x, y]] {
            if z.0 == 3 {
                let in_order = x.0 < y.0;
                let (u, v) = if in_order { (x, y) } else { (y, x) };
                let value = self.with_opposite(u, v, z.1);
                return if in_order { value } else { negative(&value) };
            }
            // Links a - 1, a, a + 1 in this cyclic order.
            if (x.0, y.0, z.0) == (0, 1, 2) {
                return self.three_near(x.1, y.1, z.1);
            }
        }
        negative(&self.triple([y, x, z]))
    }

    /// `[x, y, z]` of links a - 1, a, a + 1.
    fn three_near(&self, x: &Vector<F>, y: &Vector<F>, z: &Vector<F>) -> Form<F> {
        let turning = self.behind(0, x).map(|x| cross(&x, y));
        let ahead = self.ahead(2, z);
        std::array::from_fn(|k| std::array::from_fn(|l| dot(&turning[k], &ahead[l])))
    }

    /// `[u, v, w]` with w of the opposite link and u before v among the others.
    fn with_opposite(&self, u: (Place, &Vector<F>), v: (Place, &Vector<F>), w: &Vector<F>) -> Form<F> {
        let (plus, minus) = (&self.plus, &self.minus);
        let [al, be, ga] = self.resolved(w);
        let with_plus =
            if v.0 == 2 { self.near_dot(u, (2, &cross(v.1, plus))) } else { self.three_near(u.1, v.1, plus) };
        let with_minus =
            if u.0 == 0 { self.near_dot((0, &cross(minus, u.1)), v) } else { self.three_near(minus, u.1, v.1) };
        // Each factor of the product that stands for (u x v).(z+ x z-) turns with one angle only.
        let left =
            if u.0 == 0 { self.behind(0, &cross(u.1, minus)) } else { self.behind(0, minus).map(|z| cross(u.1, &z)) };
        let right =
            if v.0 == 2 { self.ahead(2, &cross(plus, v.1)) } else { self.ahead(2, plus).map(|z| cross(&z, v.1)) };
        let crossed: Form<F> = std::array::from_fn(|k| std::array::from_fn(|l| dot(&left[k], &right[l])));
        let (u_minus, v_plus) = (self.near_dot(u, (0, minus)), self.near_dot(v, (2, plus)));
        let split = outer(&std::array::from_fn(|k| u_minus[k][0].clone()), &v_plus[0]);
        let cosine = self.opposite[2].clone();
        let normal = combine(&[(&F::one(), crossed), (&cosine, self.near_dot(u, v)), (&F::one().neg(), split)]);
        combine(&[(&al, with_plus), (&be, with_minus), (&ga, normal)])
    }

    fn place(&self, link: usize) -> Place {
        (link + 5 - self.base) % 4
    }

    /// `[u, v, x]` of the directions of the two translations and a vector of a link.
    #[must_use]
    pub fn coplanarity(&self, link: usize, x: &Vector<F>) -> Form<F> {
        let [u, v] = self.form.slides.each_ref().map(|slide| (self.place(slide.link), &slide.direction));
        self.triple([u, v, (self.place(link), x)])
    }

    /// `sum_k [u, x, s_k]` of the direction of the first translation and a vector of a link.
    #[must_use]
    pub fn gap(&self, link: usize, x: &Vector<F>) -> Form<F> {
        let first = &self.form.slides[0];
        let (u, x) = ((self.place(first.link), &first.direction), (self.place(link), x));
        (0..4).fold(zero_form(), |sum, k| {
            let term = self.triple([u, x, (self.place(k), &self.form.links[k].translation)]);
            combine(&[(&F::one(), sum), (&F::one(), term)])
        })
    }

    /// The closure equations.
    #[must_use]
    pub fn equations(&self) -> Equations<F> {
        let f = four_bar(std::array::from_fn(|place| self.link(place)));
        let mut g = zero_form();
        for link in 0..4 {
            let term = self.coplanarity(link, &self.form.links[link].translation);
            g = combine(&[(&F::one(), g), (&F::one(), term)]);
        }
        Equations { f, g }
    }

    /// All four rotations at cosines and sines of rotations a and a + 1.
    #[must_use]
    pub fn rotations(&self, a: &(F, F), b: &(F, F)) -> [(F, F); 4] {
        let base = self.base;
        let link = |k: usize| &self.form.links[(base + k) % 4].rotation;
        // Rz(q) m = r: both are the axis of rotation a - 1, in the link that a + 2 turns and in the frame before it.
        let behind = self.behind(0, &self.minus);
        let minus: Vector<F> =
            std::array::from_fn(|i| behind[0][i].add(&behind[1][i].mul(&a.0)).add(&behind[2][i].mul(&a.1)));
        let ahead = product(&turned(link(0), b), link(1));
        let r: Vector<F> =
            std::array::from_fn(|j| (0..3).fold(F::zero(), |sum, i| sum.add(&ahead[i][j].mul(&minus[i]))));
        let m = &self.opposite;
        let cos = m[0].mul(&r[0]).add(&m[1].mul(&r[1])).mul(&self.inverse);
        let sin = m[0].mul(&r[1]).sub(&m[1].mul(&r[0])).mul(&self.inverse);
        let c = (cos, sin);
        let d = self.form.last_rotation(base, &[a.clone(), b.clone(), c.clone()]);
        let mut all: [(F, F); 4] = std::array::from_fn(|_| (F::zero(), F::zero()));
        for (k, pair) in [a.clone(), b.clone(), c, d].into_iter().enumerate() {
            all[(base + k) % 4] = pair;
        }
        all
    }
}
