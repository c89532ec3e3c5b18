//! The components of the curve `A x^2 y^2 + B x^2 + C y^2 + M x y + E = 0` on the product of two projective lines, and a
//! polynomial restricted to one.

use super::null_space::{primitive, square_root};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::derivation::transference::Variables;

type Poly = Polynomial<Int>;

const X: usize = Variables::X;
const Y: usize = Variables::Y;

/// The coefficients of a spherical four-bar in half-angle tangents.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficients {
    /// The coefficient of `x^2 y^2`.
    pub a: Poly,
    /// The coefficient of `x^2`.
    pub b: Poly,
    /// The coefficient of `y^2`.
    pub c: Poly,
    /// The coefficient of `x y`.
    pub m: Poly,
    /// The constant term.
    pub e: Poly,
}

/// A part of the curve that is irreducible over the complex numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Component {
    /// One of the joints is locked, its half-angle tangent 0 or infinite.
    Fold {
        /// The variable of the locked joint.
        variable: usize,
        /// Whether it is infinite.
        infinite: bool,
    },
    /// One variable is a function of the other: `solved = numerator / denominator`.
    Graph {
        /// The variable that is a function of the other one.
        solved: usize,
        /// A polynomial in the other variable.
        numerator: Poly,
        /// A polynomial in the other variable.
        denominator: Poly,
    },
}

impl Coefficients {
    /// Returns the coefficients of f; `None` if it has other terms.
    #[must_use]
    pub fn of(f: &Poly) -> Option<Self> {
        let at = |k: usize, l: usize| {
            let part = f.coefficients_in(X).get(k).cloned().unwrap_or_else(Poly::zero);
            part.coefficients_in(Y).get(l).cloned().unwrap_or_else(Poly::zero)
        };
        let found = Self { a: at(2, 2), b: at(2, 0), c: at(0, 2), m: at(1, 1), e: at(0, 0) };
        (found.polynomial() == *f).then_some(found)
    }

    /// Returns `A x^2 y^2 + B x^2 + C y^2 + M x y + E`.
    #[must_use]
    pub fn polynomial(&self) -> Poly {
        let (x, y) = (Poly::variable(X), Poly::variable(Y));
        let (xx, yy) = (x.mul(&x), y.mul(&y));
        let terms =
            [(&self.a, xx.mul(&yy)), (&self.b, xx), (&self.c, yy), (&self.m, x.mul(&y)), (&self.e, Poly::one())];
        terms.iter().fold(Poly::zero(), |sum, (c, monomial)| sum.add(&c.mul(monomial)))
    }

    /// Returns the components, including those at infinity, if M is not zero; `None` if the curve is irreducible or does not
    /// split over the field of the coefficients. Their product is compared with the polynomial.
    #[must_use]
    pub fn components(&self) -> Option<Vec<Component>> {
        if self.m.is_zero() {
            return None;
        }
        let zero = [&self.a, &self.b, &self.c, &self.e].map(Poly::is_zero);
        let found = match zero {
            [_, true, true, _] => self.isogram(&self.a, &self.e, false)?,
            [true, _, _, true] => self.isogram(&self.c, &self.b, true)?,
            // M x y + B x^2 + E, M x y + A x^2 y^2 + C y^2 and so on: one variable of degree 1.
            [true, false, true, false] => self.deltoid(Y, true, [&self.b, &self.e]),
            [false, true, false, true] => self.deltoid(Y, false, [&self.a, &self.c]),
            [true, true, false, false] => self.deltoid(X, true, [&self.c, &self.e]),
            [false, false, true, true] => self.deltoid(X, false, [&self.a, &self.b]),
            _ => return None,
        };
        self.is_product(&found).then_some(found)
    }

    /// Returns `high w^2 + M w + low` with `w = x y`, or `w = y/x` if turned.
    fn isogram(&self, high: &Poly, low: &Poly, turned: bool) -> Option<Vec<Component>> {
        let fold = |variable: usize, infinite: bool| Component::Fold { variable, infinite };
        // w = 0 and w = inf are two folds each.
        let nought = [fold(Y, false), fold(X, turned)];
        let infinite = [fold(Y, true), fold(X, !turned)];
        let moving = |numerator: &Poly, denominator: &Poly| {
            // The denominator comes first to get the positive leading coefficient.
            let ratio = primitive(&[denominator.clone(), numerator.clone()]);
            let x = Poly::variable(X);
            let [numerator, denominator] =
                if turned { [ratio[1].mul(&x), ratio[0].clone()] } else { [ratio[1].clone(), ratio[0].mul(&x)] };
            Component::Graph { solved: Y, numerator, denominator }
        };
        Some(match (high.is_zero(), low.is_zero()) {
            (true, true) => nought.into_iter().chain(infinite).collect(),
            (true, false) => infinite.into_iter().chain([moving(&low.neg(), &self.m)]).collect(),
            (false, true) => nought.into_iter().chain([moving(&self.m.neg(), high)]).collect(),
            (false, false) => {
                let four = Int::from_integer(4);
                let root = square_root(&self.m.mul(&self.m).sub(&high.mul(low).scale(&four)))?;
                let twice = high.add(high);
                vec![moving(&root.sub(&self.m), &twice), moving(&root.add(&self.m).neg(), &twice)]
            }
        })
    }

    /// Returns a fold, and the rest of degree 1 in `solved`: its two coefficients with the square of the other variable and without.
    fn deltoid(&self, solved: usize, infinite: bool, [square, constant]: [&Poly; 2]) -> Vec<Component> {
        let other = Poly::variable(X + Y - solved);
        let quadratic = square.mul(&other).mul(&other).add(constant);
        let linear = self.m.mul(&other);
        let (numerator, denominator) = if infinite { (quadratic.neg(), linear) } else { (linear.neg(), quadratic) };
        vec![Component::Fold { variable: solved, infinite }, Component::Graph { solved, numerator, denominator }]
    }

    /// Returns whether the product of the components is the polynomial, up to a factor without x and y.
    fn is_product(&self, components: &[Component]) -> bool {
        let product = components.iter().map(Component::polynomial).fold(Poly::one(), |product, p| product.mul(&p));
        let Some(other) = Self::of(&product) else { return false };
        let (own, other) = (self.list(), other.list());
        own.iter()
            .zip(&other)
            .all(|(p, q)| own.iter().zip(&other).all(|(r, s)| p.mul(s) == q.mul(r)) && p.is_zero() == q.is_zero())
    }

    /// Returns all five coefficients.
    #[must_use]
    pub const fn list(&self) -> [&Poly; 5] {
        [&self.a, &self.b, &self.c, &self.m, &self.e]
    }
}

impl Component {
    /// Returns the polynomial that vanishes on the component; 1 if that lies at infinity.
    #[must_use]
    pub fn polynomial(&self) -> Poly {
        match self {
            Self::Fold { infinite: true, .. } => Poly::one(),
            Self::Fold { variable, .. } => Poly::variable(*variable),
            Self::Graph { solved, numerator, denominator } => denominator.mul(&Poly::variable(*solved)).sub(numerator),
        }
    }

    /// Returns whether both joints move.
    #[must_use]
    pub const fn moves(&self) -> bool {
        matches!(self, Self::Graph { .. })
    }

    /// Returns the conditions under which a polynomial, of degree 2 or less in x and in y, vanishes on the component.
    #[must_use]
    pub fn restricted(&self, g: &Poly) -> Vec<Poly> {
        let (variable, restricted) = match self {
            Self::Fold { variable, infinite } => {
                let parts = g.coefficients_in(*variable);
                let part = parts.get(if *infinite { 2 } else { 0 });
                (X + Y - variable, part.cloned().unwrap_or_else(Poly::zero))
            }
            Self::Graph { solved, numerator, denominator } => {
                let powers = [denominator.mul(denominator), numerator.mul(denominator), numerator.mul(numerator)];
                let parts = g.coefficients_in(*solved);
                let products = parts.iter().zip(&powers).map(|(part, power)| part.mul(power));
                let sum = products.fold(Poly::zero(), |sum, product| sum.add(&product));
                (X + Y - solved, sum)
            }
        };
        restricted.coefficients_in(variable)
    }

    /// Returns the linear conditions on lengths under which g vanishes on the component, one row each.
    #[must_use]
    pub fn equations(&self, g: &Poly, lengths: &[usize]) -> Vec<Vec<Poly>> {
        let columns: Vec<Vec<Poly>> = lengths.iter().map(|&length| self.restricted(&g.derivative(length))).collect();
        let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
        let entry = |column: &Vec<Poly>, k: usize| column.get(k).cloned().unwrap_or_else(Poly::zero);
        let rows = (0..rows).map(|k| columns.iter().map(|column| entry(column, k)).collect::<Vec<_>>());
        rows.filter(|row| row.iter().any(|c| !c.is_zero())).collect()
    }
}
