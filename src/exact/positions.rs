//! All positions of a chain of up to five joint variables, exactly: rational, or over algebraic numbers.
//!
//! One variable is hidden and the chain is cut into two sides of at most two further variables each. The dual quaternions
//! of a side are linear in the products of its half-angle pairs, so that a position is a pair of vectors (v, w) in the
//! kernel of a matrix of eight rows and at most eight columns, linear in the tangent t of the hidden half-angle. Its
//! determinant is a polynomial of degree at most 4 in t, and over each of its roots linear algebra gives the rest.

use super::cut::Cut;
use super::linkage::{JointValue, Linkage, is_unit};
use crate::algebra::conjugates::fewest_conjugates;
use crate::algebra::determinant;
use crate::algebra::echelon::Echelon;
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use rug::{Float, Rational};
use std::sync::Arc;

/// Bits to which roots are refined to distinguish conjugates.
const WIDTH: u32 = 512;

/// Positions that are conjugate: the same expressions in the roots of one polynomial.
#[derive(Clone, Debug)]
pub struct Conjugates {
    /// The polynomial of t; `None` for a rational position.
    pub polynomial: Option<Univariate<Rational>>,
    /// The field of t; `None` for a rational position.
    pub field: Option<Arc<NumberField>>,
    /// The real roots; empty for a rational position.
    pub roots: Vec<RealRoot>,
    /// The values of all joint variables.
    pub values: Vec<JointValue<Algebraic>>,
    /// The field of the links, if they are not rational: all roots belong to it and its conjugates.
    pub ground: Option<Ground>,
}

/// The field of the numbers of a chain within that of its positions.
#[derive(Clone, Debug)]
pub struct Ground {
    /// Its degree.
    pub degree: usize,
    /// The element that generates it, in terms of t.
    pub element: Algebraic,
    /// The conjugates of that element, the one of this chain first.
    pub conjugates: Arc<[Float]>,
}

impl Ground {
    /// Keeps the roots at which the element has its own value, and not that of a conjugate.
    fn own(&self, roots: Vec<RealRoot>) -> Vec<RealRoot> {
        let is_own = |root: &mut RealRoot| {
            root.refine(&Rational::from((1, rug::Integer::from(1) << WIDTH)));
            let (low, high) = root.bounds();
            let value = self.element.at(&Float::with_val(2 * WIDTH, (low + high) / 2));
            let distance = |x: &Float| Float::with_val(2 * WIDTH, x - &value).abs();
            let nearest = self.conjugates.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            nearest.is_some_and(|(k, _)| k == 0)
        };
        roots.into_iter().filter_map(|mut root| is_own(&mut root).then_some(root)).collect()
    }
}

/// The positions of a chain.
#[derive(Clone, Debug)]
pub enum Positions {
    /// All of them, and they are finitely many.
    Finite {
        /// The positions.
        found: Vec<Conjugates>,
        /// Whether the equations have no other solution: none at infinity, none of a dual quaternion without a motion.
        /// Limits of positions are solutions, too.
        is_proper: bool,
    },
    /// No cut of the chain separates them: they may form a curve.
    Unknown,
}

impl Conjugates {
    /// Positions over a field that contains that of the links.
    pub(crate) fn over_ground(
        polynomial: Univariate<Rational>,
        field: Arc<NumberField>,
        values: Vec<JointValue<Algebraic>>,
        ground: Ground,
    ) -> Self {
        let roots = ground.own(polynomial.real_roots());
        Self { polynomial: Some(polynomial), field: Some(field), roots, values, ground: Some(ground) }
    }

    /// The position with all joint variables at 0, if the chain closes there.
    pub(crate) fn home(linkage: &Linkage<Rational>) -> Option<Self> {
        let linkage: Linkage<Algebraic> = linkage.map()?;
        let values = vec![[Algebraic::one(), Algebraic::zero()]; linkage.variables.len()];
        let closes = linkage.at(&values).closes();
        closes.then_some(Self { polynomial: None, field: None, roots: Vec::new(), values, ground: None })
    }

    /// The number of positions.
    #[must_use]
    pub fn count(&self) -> usize {
        let degree = self.polynomial.as_ref().and_then(Univariate::degree).unwrap_or(1);
        degree / self.ground.as_ref().map_or(1, |ground| ground.degree)
    }

    /// Returns the number of real positions among them.
    #[must_use]
    pub fn real(&self) -> usize {
        if self.polynomial.is_none() { 1 } else { self.roots.len() }
    }

    /// Returns a lower bound on the number of them that are conjugate over the rationals and share all algebraic properties: the
    /// least degree of an irreducible factor, or a bound on it.
    #[must_use]
    pub fn fewest_conjugates(&self) -> usize {
        let Some(polynomial) = self.polynomial.as_ref().filter(|_| self.ground.is_none()) else { return 1 };
        fewest_conjugates(polynomial)
    }

    /// Returns the same positions restricted to the roots of a factor of the polynomial.
    fn over(&self, factor: &Univariate<Rational>) -> Self {
        let field = NumberField::new(factor);
        let image = |x: &Algebraic| x.over(&field);
        let values = self.values.iter().map(|[c, s]| [image(c), image(s)]).collect();
        let ground = self.ground.as_ref().map(|ground| Ground { element: image(&ground.element), ..ground.clone() });
        let roots = factor.real_roots();
        let roots = ground.as_ref().map_or_else(|| roots.clone(), |ground| ground.own(roots.clone()));
        Self { roots, polynomial: Some(factor.clone()), field: Some(field), values, ground }
    }

    /// Returns whether the joint screws are independent at each of these positions, so that the chain closes there once.
    pub(crate) fn are_regular(&self, linkage: &Linkage<Rational>) -> bool {
        let Some(linkage) = linkage.map::<Algebraic>() else { return false };
        self.each(|part| linkage.at(&part.values).is_regular()).iter().all(|(_, is_regular)| *is_regular)
    }

    /// Returns the results of `compute` at these positions: one for all of them where it never meets a number that is zero at
    /// only some of them, else one for every part.
    pub fn each<T>(&self, compute: impl Fn(&Self) -> T) -> Vec<(Self, T)> {
        let mut open = vec![self.clone()];
        let mut found = Vec::new();
        while let Some(part) = open.pop() {
            let result = compute(&part);
            let split = part.field.as_ref().and_then(|field| field.split().cloned());
            match (split, &part.polynomial) {
                (Some(factor), Some(polynomial)) => {
                    let cofactor = polynomial.div_rem(&factor).0;
                    open.extend([factor, cofactor].iter().map(|f| part.over(f)));
                }
                _ => found.push((part, result)),
            }
        }
        found
    }
}

/// All positions of a chain.
///
/// # Panics
/// When there are more than five joint variables, or none.
#[must_use]
pub fn positions(linkage: &Linkage<Rational>) -> Positions {
    let n = linkage.variables.len();
    assert!((1..=5).contains(&n), "one to five joint variables");
    Cut::<Rational>::all(n).find_map(|cut| Separation::of(linkage, cut).solve()).unwrap_or(Positions::Unknown)
}

/// Whether some cut of a chain shows that it has no positions, and no limits of positions of chains nearby.
///
/// # Panics
/// When there are more than five joint variables, or none.
#[must_use]
pub fn is_properly_open(linkage: &Linkage<Rational>) -> bool {
    let n = linkage.variables.len();
    assert!((1..=5).contains(&n), "one to five joint variables");
    Cut::<Rational>::all(n)
        .map(|cut| Separation::of(linkage, cut).solve())
        .any(|found| matches!(found, Some(Positions::Finite { found, is_proper: true }) if found.is_empty()))
}

/// A cut of a chain over the rationals.
struct Separation<'a> {
    linkage: &'a Linkage<Rational>,
    cut: Cut<Rational>,
}

impl<'a> Separation<'a> {
    fn of(linkage: &'a Linkage<Rational>, cut: (usize, usize)) -> Self {
        Self { linkage, cut: Cut::of(linkage, cut) }
    }

    /// All positions, if this cut finds them.
    fn solve(&self) -> Option<Positions> {
        let determinant = self.determinant();
        determinant.degree()?;
        let mut list = List::default();
        // The half-turn, where t is infinite.
        list.add(self.position(&[Algebraic::zero(), Algebraic::one()]), None)?;
        let hidden = self.cut.order[self.cut.hidden];
        let circle = Univariate::new(vec![Rational::from(1), Rational::new(), self.linkage.axes[hidden].square()]);
        let (spurious, mut polynomial) = match self.linkage.variables[hidden] {
            Variable::Rotation => determinant.square_free_part().remove_factor(&circle),
            Variable::Translation => (0, determinant.square_free_part()),
        };
        if spurious > 0 {
            // No half-angle has the tangent i, but limits may have it.
            let field = NumberField::new(&circle);
            let here = self.position(&[Algebraic::one(), field.root()]);
            list.is_improper |= !matches!(here, Here::Nothing) || field.split().is_some();
        }
        let mut open = Vec::new();
        if polynomial.degree() > Some(0) {
            for mut root in polynomial.real_roots() {
                if let Some(t) = root.rational() {
                    let linear = Univariate::new(vec![Rational::from(-&t), Rational::from(1)]);
                    polynomial = polynomial.div_rem(&linear).0;
                    list.add(self.position(&[Algebraic::one(), Algebraic::from_rational(&t)?]), None)?;
                }
            }
            open.push(polynomial);
        }
        while let Some(polynomial) = open.pop() {
            if polynomial.degree() < Some(1) {
                continue;
            }
            let field = NumberField::new(&polynomial);
            let position = self.position(&[Algebraic::one(), field.root()]);
            if let Some(factor) = field.split() {
                open.extend([polynomial.div_rem(factor).0, factor.clone()]);
            } else {
                list.add(position, Some((polynomial, field)))?;
            }
        }
        Some(Positions::Finite { found: list.found, is_proper: !list.is_improper })
    }

    /// A polynomial that vanishes wherever the columns are dependent; zero if the cut separates nothing.
    fn determinant(&self) -> Univariate<Rational> {
        let conditions = self.cut.conditions(|matrix| determinant::modular(matrix));
        conditions.into_iter().reduce(|a, b| a.gcd(&b)).unwrap_or_else(Univariate::zero)
    }

    /// Solves the cut at one value of the hidden variable.
    fn position(&self, t: &JointValue<Algebraic>) -> Here {
        position(self.linkage, &self.cut, Algebraic::from_rational, t)
    }
}

/// Solves a cut at one value of its hidden variable, in a field that holds the images of all numbers.
pub(crate) fn position<F: Field>(
    linkage: &Linkage<F>,
    cut: &Cut<F>,
    image: impl Fn(&F) -> Option<Algebraic>,
    t: &JointValue<Algebraic>,
) -> Here {
    let columns = cut.columns();
    let left = cut.degree();
    let entry = |i: usize, j: usize| -> Option<Algebraic> {
        let constant = image(&cut.matrix[0][i][j])?;
        if j >= left {
            return Some(constant);
        }
        let mut sum = constant.mul(&t[0]);
        sum.add_product(&image(&cut.matrix[1][i][j])?, &t[1]);
        Some(sum)
    };
    let rows: Option<Vec<Vec<Algebraic>>> = (0..8).map(|i| (0..columns).map(|j| entry(i, j)).collect()).collect();
    let Some(rows) = rows else { return Here::Undecided };
    let kernel = Echelon::of(rows, columns).null_space();
    let vector = match kernel.as_slice() {
        [] => return Here::Nothing,
        [vector] => vector,
        _ => return Here::Undecided,
    };
    let (v, w) = match (factors(&vector[..left]), factors(&vector[left..])) {
        (Side::Pairs(v), Side::Pairs(w)) => (v, w),
        (Side::General, _) | (_, Side::General) => return Here::Nothing,
        _ => return Here::Improper,
    };
    let mut values = vec![[Algebraic::one(), Algebraic::zero()]; cut.order.len()];
    let mut rest = v.into_iter().chain(w);
    for (place, k) in cut.order.iter().enumerate() {
        let value = if place == cut.hidden { Some(t.clone()) } else { rest.next() };
        let Some(value) = value else { return Here::Undecided };
        values[*k] = value;
    }
    // A translation by an infinite distance, or a rotation by an angle of tangent i, is no motion: it does not close the chain.
    match linkage.over(image) {
        Some(linkage) if linkage.at(&values).closes() => Here::Position(values),
        _ => Here::Improper,
    }
}

/// The solution of a cut at one value of its hidden variable.
pub(crate) enum Here {
    /// No solution.
    Nothing,
    /// A solution that is no position.
    Improper,
    /// A position.
    Position(Vec<JointValue<Algebraic>>),
    /// More solutions than one, perhaps.
    Undecided,
}

/// The solutions found by a cut so far.
#[derive(Default)]
struct List {
    found: Vec<Conjugates>,
    is_improper: bool,
}

impl List {
    /// Records the solution at a value of the hidden variable, rational or a root of a polynomial; `None` if it is undecided.
    fn add(&mut self, here: Here, over: Option<(Univariate<Rational>, Arc<NumberField>)>) -> Option<()> {
        match here {
            Here::Undecided => return None,
            Here::Nothing => {}
            Here::Improper => self.is_improper = true,
            Here::Position(values) => {
                let roots = over.as_ref().map(|(polynomial, _)| polynomial.real_roots()).unwrap_or_default();
                let (polynomial, field) = over.unzip();
                self.found.push(Conjugates { polynomial, field, roots, values, ground: None });
            }
        }
        Some(())
    }
}

/// The form of one side of a vector of the kernel.
enum Side {
    /// Zero.
    Zero,
    /// The tensor product of these pairs, the first one running fastest.
    Pairs(Vec<JointValue<Algebraic>>),
    /// No tensor product.
    General,
}

/// Splits a vector into the pairs of which it is the tensor product.
fn factors(vector: &[Algebraic]) -> Side {
    let Some(best) = vector.iter().position(is_unit) else { return Side::Zero };
    if let [a, b, c, d] = vector
        && is_unit(&a.mul(d).sub(&b.mul(c)))
    {
        return Side::General;
    }
    let size = vector.len().trailing_zeros();
    let pairs = (0..size).map(|bit| {
        let mask = 1 << bit;
        let (c, s) = (&vector[best & !mask], &vector[best | mask]);
        match c.inverse() {
            Some(inverse) => [Algebraic::one(), s.mul(&inverse)],
            None => [Algebraic::zero(), Algebraic::one()],
        }
    });
    Side::Pairs(pairs.collect())
}
