//! Four rotations: a spherical four-bar and one condition on the translations.

use super::Equation;
use super::chain::{Eliminated, Exact, Mod};
use super::equation::primitive;
use super::polynomial::{Meaning, Removed};
use super::symbols::{Symbols, bilinear_form};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::elimination::cut::Hidden;
use crate::elimination::octic::{closure_polynomial, false_roots};
use crate::elimination::separated::offset;
use crate::elimination::spherical_four_bar::FourBar;
use crate::kinematics::link_form::LinkForm;
use rug::Rational;

/// Returns the quality of a polynomial: the number of roots that may be solutions, then whether some coincide. Less is better.
pub(super) fn quality<F: Field + Domain>(polynomial: &Univariate<F>) -> Option<(usize, bool)> {
    polynomial.degree()?;
    let rest = polynomial.remove_factor(&Univariate::circle()).1;
    let multiple = rest.gcd(&rest.derivative()).degree() > Some(0);
    Some((rest.degree().unwrap_or(0), multiple))
}

/// Returns the base link and the angle to keep: the first choice that leaves the fewest roots, distinct if possible.
pub(super) fn choice(form: &LinkForm<Mod, 4, 2>) -> Option<(usize, Hidden)> {
    choice_of(form, |_, _| true)
}

/// Returns the best choice among those that `serves` accepts.
fn choice_of(form: &LinkForm<Mod, 4, 2>, serves: impl Fn(usize, Hidden) -> bool) -> Option<(usize, Hidden)> {
    let mut best = None;
    for base in 0..4 {
        let Some(bar) = FourBar::new(form, base) else { continue };
        let equations = bar.equations();
        for hidden in [Hidden::First, Hidden::Second].into_iter().filter(|hidden| serves(base, *hidden)) {
            let Some(quality) = quality(&closure_polynomial(&equations, hidden, &offset())) else { continue };
            if best.is_none_or(|(least, _, _)| quality < least) {
                best = Some((quality, base, hidden));
            }
        }
    }
    best.map(|(_, base, hidden)| (base, hidden))
}

/// Returns the two equations and their polynomial in a certain unknown; `None` if no link has its angle at one end and leaves one.
pub(super) fn eliminate_keeping(exact: &Exact, unknown: usize) -> Option<Eliminated> {
    let modular: LinkForm<Mod, 4, 2> = LinkForm::of(exact.modular.as_ref()?)?;
    let keeps =
        |base: usize, hidden: Hidden| modular.rotations[(base + usize::from(hidden == Hidden::Second)) % 4] == unknown;
    eliminate_by(exact, Some(choice_of(&modular, keeps)?))
}

/// Returns the two equations and their polynomial.
pub(super) fn eliminate(exact: &Exact) -> Option<Eliminated> {
    eliminate_by(exact, exact.modular.as_ref().and_then(|modular| choice(&LinkForm::of(modular)?)))
}

fn eliminate_by(exact: &Exact, chosen: Option<(usize, Hidden)>) -> Option<Eliminated> {
    let form: LinkForm<Rational, 4, 2> = LinkForm::of(&exact.closed)?;
    let degenerate = chosen.is_none();
    let any = || (0..4).find(|&base| FourBar::new(&form, base).is_some()).map(|base| (base, Hidden::First));
    let (base, hidden) = chosen.or_else(any)?;
    let bar = FourBar::new(&form, base)?;
    let equations = bar.equations();
    let unknown = |k: usize| form.rotations[(base + k) % 4];
    let symbols = &exact.symbols;
    let label = |k: usize| symbols.label(unknown(k));
    let monomials = [0, 1].map(|k| symbols.monomials(unknown(k), false));
    let listed = [
        (format!("spherical four-bar {}-{} n.n'", label(2), label(3)), &equations.f),
        (format!("coplanarity of translations {}-{} [u, v, s]", label(0), label(1)), &equations.g),
    ];
    let listed =
        listed.into_iter().map(|(name, form)| Equation::used(name, &bilinear_form(form, &monomials[0], &monomials[1])));
    let kept = unknown(usize::from(hidden == Hidden::Second));
    let gone = unknown(usize::from(hidden == Hidden::First));
    let steps = vec![
        format!(
            "The rotations {}, {}, {}, {} close by themselves: the axes of joints {} and {} keep the angle of the link between \
             them, f = 0, bilinear in cosine and sine of joints {} and {}.",
            label(0), label(1), label(2), label(3), label(2), label(3), label(0), label(1)
        ),
        "The translations can close the loop if their directions u, v and the sum s of the links are coplanar: g = [u, v, s] \
         = 0, reduced modulo f to be bilinear in the same angles."
            .to_owned(),
        format!(
            "With f = (C, A, B).(1, cos, sin) of joint {} and g likewise, the vector product N of both leaves N1^2 + N2^2 - \
             N3^2 = 0, a polynomial of degree 8 or less in {}.",
            symbols.label(gone), symbols.name(kept)
        ),
        "Every solution is a root. Roots at which u and v are parallel without closing the loop, and those at which the other \
         half-angle tangent would be i, are no solutions and are divided out. The other rotations and the two translations \
         follow rationally."
            .to_owned(),
    ];
    let mut eliminated =
        Eliminated { equations: listed.collect(), steps, polynomial: None, removed: Vec::new(), per_root: 1 };
    if !(degenerate && exact.modular.is_some()) {
        let origin = [1, 1, 0].map(Rational::from);
        // Integers multiply without greatest common divisors.
        let mut equations = equations;
        for form in [&mut equations.f, &mut equations.g] {
            Rational::normalise(form.as_flattened_mut());
        }
        let polynomial = closure_polynomial(&equations, hidden, &origin);
        if !polynomial.is_zero() {
            let rest = polynomial.remove_factor(&Univariate::circle()).1;
            let lost = false_roots(&bar, &equations, hidden, &origin, &rest);
            let all = lost.imaginary.mul(&lost.parallel);
            let degree = 8 - all.degree().unwrap_or(0) - lost.parallel_at_pi;
            eliminated.polynomial = Some((kept, polynomial.div_exact(&all), Meaning::HalfTangent { degree }));
            let imaginary = format!("joint {} would have the half-angle tangent i or -i there", symbols.label(gone));
            let parallel = "the translations are parallel there and do not close the loop";
            eliminated.removed = removed(kept, &lost.imaginary, 0, &imaginary);
            eliminated.removed.extend(removed(kept, &lost.parallel, lost.parallel_at_pi, parallel));
        }
    }
    Some(eliminated)
}

/// Returns a factor of false roots, split into square-free ones, and the false roots at infinity.
pub(super) fn removed(kept: usize, factor: &Univariate<Rational>, at_pi: usize, reason: &str) -> Vec<Removed> {
    let square_free = |(factor, multiplicity): (Univariate<Rational>, usize)| {
        let factor = Polynomial::from_univariate(Symbols::variable(kept), &factor);
        Removed { factor: Some(primitive(&factor)), multiplicity, reason: reason.to_owned() }
    };
    let mut removed: Vec<Removed> = factor.square_free_decomposition().into_iter().map(square_free).collect();
    if at_pi > 0 {
        removed.push(Removed { factor: None, multiplicity: at_pi, reason: reason.to_owned() });
    }
    removed
}
