//! Five or six rotations: fourteen equations of a cut, four of them without three unknowns, one pencil of size 8.

use super::Equation;
use super::chain::{Eliminated, Exact, Mod};
use super::four_bar::quality;
use super::polynomial::Meaning;
use super::symbols::{Symbols, bilinear_form};
use crate::algebra::determinant::{by_interpolation, modular};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::closure::half_angle::half_angle_form;
use crate::closure::woernle_lee::{
    FIXED, MarkedLine, TURNING_X, TURNING_Y, act, left_columns, right_columns, split_inverse,
};
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::degree::closure_polynomial;
use crate::elimination::pencil::{Bilinear, before_second_link, bilinear, pencil};
use crate::elimination::rearranged::{Rearranged, rearranged};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use rug::Rational;

/// The invariants of two lines with a marked point each: n, n' their directions, r from one point to the other.
const INVARIANTS: [&str; 6] = ["n.n'", "n.r", "n'.r", "r.r", "n.(r x n')", "(r.r) n.n' - 2 (n.r)(n'.r)"];
/// The vectors whose coordinates perpendicular to the first axis rotate with it.
const TURNING: [&str; 4] = ["n'", "r", "r x n'", "(r.r) n' - 2 (n'.r) r"];

/// Returns the first cut that leaves the fewest roots, distinct if possible. In special loops some cuts leave roots that belong
/// to no solution, and look like the general case.
pub(super) fn choice(closed: &ClosedLoop<Mod>) -> Option<(Cut, Hidden)> {
    best(closed).map(|(_, cut, hidden)| (cut, hidden))
}

fn best(closed: &ClosedLoop<Mod>) -> Option<((usize, bool), Cut, Hidden)> {
    let regular = |(cut, hidden, _)| Some((quality(&closure_polynomial(closed, cut, hidden)?.cofactor)?, cut, hidden));
    Cut::hidings().filter_map(regular).min_by_key(|(quality, _, _)| *quality)
}

/// A cut of a loop, or of the same loop with its translation elsewhere along parallel axes.
struct Reading<'e> {
    symbols: &'e Symbols,
    cut: Cut,
    /// The loop in the order of the cut.
    view: ClosedLoop<Rational>,
    /// The index in the loop of each unknown of the cut.
    order: [usize; 6],
    /// Whether the translation has the opposite sign to that in the loop.
    flipped: bool,
}

impl<'e> Reading<'e> {
    fn own(exact: &'e Exact, cut: Cut) -> Self {
        let (symbols, view) = (&exact.symbols, cut.of(&exact.closed));
        Self { symbols, cut, view, order: [0, 1, 2, 3, 4, 5], flipped: false }
    }

    fn moved(exact: &'e Exact, moved: &Rearranged<Rational>, cut: Cut) -> Self {
        let (symbols, view) = (&exact.symbols, cut.of(&moved.closed));
        Self { symbols, cut, view, order: moved.order, flipped: moved.flipped }
    }

    fn unknown(&self, j: usize) -> usize {
        self.order[self.cut.unknown_index(j)]
    }

    fn is_negated(&self, j: usize) -> bool {
        self.cut.reversed != (self.flipped && self.view.variables[j] == Variable::Translation)
    }

    fn label(&self, j: usize) -> &str {
        self.symbols.label(self.unknown(j))
    }

    fn name(&self, j: usize) -> String {
        self.symbols.name(self.unknown(j))
    }

    fn monomials(&self, j: usize) -> [Polynomial<Rational>; 3] {
        self.symbols.monomials(self.unknown(j), self.is_negated(j))
    }
}

/// Returns the best cut; if all fail, that of the loop with its translation elsewhere.
fn reading(exact: &Exact) -> Option<(Reading<'_>, Hidden)> {
    let Some(modular) = &exact.modular else {
        let regular = |cut: &Cut| cut.fits(exact.closed.variables) && half_angle_form(&cut.of(&exact.closed)).is_some();
        return Cut::ALL.into_iter().find(regular).map(|cut| (Reading::own(exact, cut), Hidden::First));
    };
    if let Some((cut, hidden)) = choice(modular) {
        return Some((Reading::own(exact, cut), hidden));
    }
    let all = rearranged(modular, 0.0);
    let found = all.iter().filter_map(|moved| Some((moved.order, best(&moved.closed)?)));
    let (order, (_, cut, hidden)) = found.min_by_key(|(_, (quality, _, _))| *quality)?;
    let exactly = rearranged(&exact.closed, 0.0);
    let moved = exactly.iter().find(|moved| moved.order == order)?;
    Some((Reading::moved(exact, moved, cut), hidden))
}

/// As `eliminate`, with the best cut that keeps a certain unknown; `None` if all of these lose equations.
pub(super) fn eliminate_keeping(exact: &Exact, unknown: usize) -> Option<Eliminated> {
    let modular = exact.modular.as_ref()?;
    let all = Cut::hidings().filter(|(_, _, kept)| *kept == unknown);
    let good = all.filter_map(|(cut, hidden, _)| {
        Some((quality(&closure_polynomial(modular, cut, hidden)?.cofactor)?, cut, hidden))
    });
    let (_, cut, hidden) = good.min_by_key(|(quality, _, _)| *quality)?;
    Some(eliminated(&Reading::own(exact, cut), hidden))
}

/// Returns the equations of the best cut and the determinant of its pencil.
pub(super) fn eliminate(exact: &Exact) -> Eliminated {
    let Some((reading, hidden)) = reading(exact) else {
        let cut = Cut::ALL.into_iter().find(|cut| cut.fits(exact.closed.variables));
        let equations = cut.map(|cut| listed(&Reading::own(exact, cut))).unwrap_or_default();
        return without_polynomial(equations, vec!["Every cut of the loop loses equations.".to_owned()]);
    };
    eliminated(&reading, hidden)
}

fn without_polynomial(equations: Vec<Equation>, steps: Vec<String>) -> Eliminated {
    Eliminated { equations, steps, polynomial: None, removed: Vec::new(), per_root: 1 }
}

/// Returns the equations of a cut and the determinant of its pencil.
fn eliminated(reading: &Reading<'_>, hidden: Hidden) -> Eliminated {
    let mut equations = listed(reading);
    let Some(form) = half_angle_form(&reading.view) else { return without_polynomial(equations, Vec::new()) };
    let rows = bilinear(&before_second_link(&form, &reading.view.constants[1]), &reading.view);
    equations.extend(reduced(reading, &rows));
    let kept = reading.unknown(usize::from(hidden == Hidden::Second));
    let determinant = determinant(reading.cut, hidden, &rows);
    let polynomial = (!determinant.is_zero()).then_some((kept, determinant, Meaning::HalfTangent { degree: 16 }));
    Eliminated { polynomial, ..without_polynomial(equations, steps(reading, hidden)) }
}

/// Returns the determinant of the pencil, in the half-angle tangent of the joint itself.
fn determinant(cut: Cut, hidden: Hidden, rows: &Bilinear<Rational>) -> Univariate<Rational> {
    let determinant = modular(&pencil(rows, hidden).coefficients);
    if cut.reversed { mirrored(&determinant) } else { determinant }
}

/// Returns the polynomials of an unknown by all cuts, modulo the prime: every solution is a root of each.
pub(super) fn eliminants(closed: &ClosedLoop<Mod>, unknown: usize) -> impl Iterator<Item = Univariate<Mod>> {
    Cut::hidings().filter(move |(_, _, kept)| *kept == unknown).filter_map(|(cut, hidden, _)| {
        if !cut.fits(closed.variables) {
            return None;
        }
        let view = cut.of(closed);
        let rows = bilinear(&before_second_link(&half_angle_form(&view)?, &view.constants[1]), &view);
        let determinant = by_interpolation(&pencil(&rows, hidden).coefficients);
        let polynomial = if cut.reversed { mirrored(&determinant) } else { determinant };
        (!polynomial.is_zero()).then_some(polynomial)
    })
}

/// Returns `p(-x)`.
fn mirrored<R: Ring>(polynomial: &Univariate<R>) -> Univariate<R> {
    let signed = |(k, c): (usize, &R)| if k % 2 == 1 { c.neg() } else { c.clone() };
    Univariate::new(polynomial.coefficients().iter().enumerate().map(signed).collect())
}

/// Returns the fourteen equations of a cut.
fn listed(reading: &Reading<'_>) -> Vec<Equation> {
    let view = &reading.view;
    let monomials: [[Polynomial<Rational>; 3]; 5] = std::array::from_fn(|j| reading.monomials(j));
    let label = |j: usize| reading.label(j);
    // All are written in the frame of unknown 3: the left sides in unknowns 4 and 5, the right ones in 1, 2 and 3.
    let left: [MarkedLine<Rational>; 9] = left_columns(view).map(|column| act(&view.constants[2], &column));
    let back = view.constants[1].inverse();
    let right = right_columns(view).map(|row| row.map(|column| split_inverse(view.variables[2], &act(&back, &column))));
    let coordinate = |i: usize| {
        let parts: [[Rational; 3]; 3] =
            std::array::from_fn(|five| std::array::from_fn(|four| left[3 * five + four][i].clone()));
        let left = bilinear_form(&parts, &monomials[4], &monomials[3]);
        (0..3).fold(left, |sum, three| {
            let parts: [[Rational; 3]; 3] =
                std::array::from_fn(|one| std::array::from_fn(|two| right[one][two][three][i].clone()));
            sum.sub(&bilinear_form(&parts, &monomials[0], &monomials[1]).mul(&monomials[2][three]))
        })
    };
    let pair = format!("{}-{}", label(2), label(5));
    let fixed = FIXED[1..].iter().zip(INVARIANTS);
    let fixed = fixed.map(|(&i, name)| Equation::listed(format!("Woernle-Lee {pair} {name}"), &coordinate(i)));
    let turning = TURNING_X.into_iter().zip(TURNING_Y).zip(TURNING).flat_map(|((x, y), name)| {
        [(x, "x"), (y, "y")]
            .map(|(i, axis)| Equation::listed(format!("half-angle pair {pair} {axis}.({name})"), &coordinate(i)))
    });
    fixed.chain(turning).collect()
}

/// Returns the four equations without unknowns 4 to 6, linear in the half-angle tangent of unknown 3.
fn reduced(reading: &Reading<'_>, rows: &Bilinear<Rational>) -> Vec<Equation> {
    let monomials = [0, 1].map(|j| reading.monomials(j));
    let tangent = Symbols::tangent(reading.unknown(2), reading.is_negated(2));
    let label = |j: usize| reading.label(j);
    let one = |k: usize| {
        let form = |e: usize| bilinear_form(&rows[e], &monomials[0], &monomials[1]);
        let polynomial = form(k).add(&form(4 + k).mul(&tangent));
        let name = format!("without {}, {}, {}: equation {}", label(3), label(4), label(5), k + 1);
        Equation::used(name, &polynomial)
    };
    (0..4).map(one).collect()
}

fn steps(reading: &Reading<'_>, hidden: Hidden) -> Vec<String> {
    let (label, name) = (|j: usize| reading.label(j), |j: usize| reading.name(j));
    let (kept, other) = if hidden == Hidden::First { (0, 1) } else { (1, 0) };
    let elsewhere = (reading.order != [0, 1, 2, 3, 4, 5]).then(|| {
        let order: Vec<String> = (0..6).map(|j| reading.name(j)).collect();
        let how = if reading.flipped { ", counted the other way" } else { "" };
        format!(
            "The translation runs along axes that are parallel: rotations about these and the translation{how} may change \
             places. Every cut of the loop as it is loses equations; it is read in the order {}.",
            order.join(", ")
        )
    });
    let steps = [
        format!(
            "The loop is cut at the axes of joints {} and {}, of directions n, n', with r from a point of the first to one of \
             the second: seen from the first axis, each side of the loop gives the same line with a marked point. Six \
             invariants of it are free of joints {} and {} (Woernle-Lee), eight coordinates turn with joint {} (half-angle \
             pairs): 14 equations in five unknowns.",
            label(2),
            label(5),
            label(2),
            label(5),
            label(2)
        ),
        format!(
            "They are linear in the 8 products of (1, cos, sin) of joints {} and {}: a 15 x 9 matrix of rank 9 leaves 6 \
             equations in joints {}, {} and {}.",
            label(3),
            label(4),
            label(0),
            label(1),
            label(2)
        ),
        format!(
            "Of these, as complex numbers, 4 combinations (the left kernel of a 12 x 8 matrix) are linear in {} without the \
             factor 1 + {}^2: degrees 2, 2 and 1 in {}, {} and {}.",
            name(2),
            name(2),
            name(0),
            name(1),
            name(2)
        ),
        format!(
            "Times 1 and {other}, they are 8 linear equations in the products of (1, {other}, {other}^2, {other}^3) and (1, \
             {}): an 8 x 8 matrix of degree 2 in {}.",
            name(2),
            name(kept),
            other = name(other)
        ),
        format!(
            "Its determinant, of degree 16 or less in {}, is the closure polynomial: every solution is a root.",
            name(kept)
        ),
        format!("At a root the kernel gives {} and {}, then linear equations the other joints.", name(other), name(2)),
    ];
    elsewhere.into_iter().chain(steps).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::catalogue::{Options, load};
    use crate::mechanism::closed_loop;

    #[test]
    fn all_cuts_that_keep_the_same_joint_give_the_same_polynomial() {
        let entry = load("general_7r", &Options::default()).unwrap();
        let (_, closed) = closed_loop::<Rational>(entry.chain().unwrap(), &entry.cases[0]).unwrap().unwrap();
        let mut found: [Option<Vec<rug::Integer>>; 6] = std::array::from_fn(|_| None);
        let mut agreed = 0;
        for cut in Cut::ALL {
            let view = cut.of(&closed);
            let form = half_angle_form(&view).unwrap();
            let rows = bilinear(&before_second_link(&form, &view.constants[1]), &view);
            for (hidden, j) in [(Hidden::First, 0), (Hidden::Second, 1)] {
                let polynomial = determinant(cut, hidden, &rows).primitive_integers();
                assert_eq!(polynomial.len(), 17);
                match &found[cut.unknown_index(j)] {
                    Some(before) => {
                        assert_eq!(*before, polynomial, "{cut:?} {hidden:?}");
                        agreed += 1;
                    }
                    None => found[cut.unknown_index(j)] = Some(polynomial),
                }
            }
        }
        assert_eq!(agreed, 18);
    }
}
