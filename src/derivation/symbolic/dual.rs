//! Eliminations by the principle of transference: the equations of the spherical loop over dual numbers.

use super::Quotient;
use super::parts::Parts;
use super::routes::{Outcome, OverNames, canonical, expanded, in_variable, no_image, sum, vanishing};
use super::table::{Symbol, Table};
use crate::algebra::dual::Dual;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::trigonometric::{HalfAngles, Pair, half_tangents};
use crate::algebra::univariate::Univariate;
use crate::derivation::chain::Exact;
use crate::derivation::equation::primitive;
use crate::derivation::symbols::Symbols;
use crate::elimination::cut::Hidden;
use crate::elimination::octic::closure_polynomial;
use crate::elimination::spherical_four_bar::{Equations, Form, FourBar, four_bar};
use crate::elimination::spherical_triangle::triangle_without;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Numbers, Parameters};
use crate::kinematics::link_form::{LinkForm, Slide};
use crate::kinematics::motion::{Motion, Vector, cross};
use rug::Rational;

/// Returns the rotation with a motion's translation in its dual part, `R + eps [t] R`, which acts on lines as R on directions.
fn dual_rotation<R: Ring>(motion: &Motion<R>) -> [[Dual<R>; 3]; 3] {
    let column = |j: usize| -> Vector<R> { std::array::from_fn(|i| motion.rotation[i][j].clone()) };
    let moments: [Vector<R>; 3] = std::array::from_fn(|j| cross(&motion.translation, &column(j)));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| Dual { value: motion.rotation[i][j].clone(), epsilon: moments[j][i].clone() })
    })
}

/// Returns a loop over dual numbers, with its translations in its dual rotations.
pub(in crate::internal::derivation) fn dualised<R: Ring, const RHO: usize, const TAU: usize>(
    form: &LinkForm<R, RHO, TAU>,
) -> LinkForm<Dual<R>, RHO, TAU> {
    let link = |motion: &Motion<R>| Motion { rotation: dual_rotation(motion), ..Motion::identity() };
    let slide = |slide: &Slide<R>| {
        let direction = slide.direction.each_ref().map(|x| Dual::constant(x.clone()));
        Slide { unknown: slide.unknown, link: slide.link, direction }
    };
    LinkForm {
        rotations: form.rotations,
        links: form.links.each_ref().map(link),
        slides: form.slides.each_ref().map(slide),
    }
}

/// Returns the axes of the rotations before and behind the link of a translation, in its frame.
fn beside<R: Ring, const RHO: usize, const TAU: usize>(
    form: &LinkForm<R, RHO, TAU>,
    slide: &Slide<R>,
) -> [Vector<R>; 2] {
    let next = std::array::from_fn(|i| form.links[slide.link].rotation[i][2].clone());
    [[R::zero(), R::zero(), R::one()], next]
}

/// Returns the rotation along whose axis each translation runs; `None` if one runs along none.
pub(in crate::internal::derivation) fn axes<R: Ring, const RHO: usize, const TAU: usize>(
    form: &LinkForm<R, RHO, TAU>,
) -> Option<[usize; TAU]> {
    let axis = |slide: &Slide<R>| {
        let [own, next] = beside(form, slide);
        let along = |axis: &Vector<R>| cross(&slide.direction, axis).iter().all(Ring::is_zero);
        if along(&own) { Some(slide.link) } else { along(&next).then_some((slide.link + 1) % RHO) }
    };
    let found = form.slides.each_ref().map(axis);
    found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
}

/// Returns whether a translation runs against the axis along which it runs, as behind a twist of pi.
fn runs_back<R: Ring>(form: &LinkForm<R, 3, 3>, slide: &Slide<R>, axis: usize) -> bool {
    let axis = &beside(form, slide)[usize::from(slide.link != axis)];
    slide.direction.iter().zip(axis).all(|(x, y)| x.add(y).is_zero())
}

/// Returns, for a loop whose two translations run along the axes of one link, the link opposite to it.
pub(in crate::internal::derivation) fn opposite_link<R: Ring>(form: &LinkForm<R, 4, 2>) -> Option<usize> {
    let [one, two] = axes(form)?;
    match (two + 4 - one) % 4 {
        1 => Some((one + 2) % 4),
        3 => Some((two + 2) % 4),
        _ => None,
    }
}

/// Returns the spherical four-bar and its dual part, bilinear in the angles at both ends of a link.
pub(in crate::internal::derivation) fn pair_at<R: Ring>(links: &[Motion<R>; 4], base: usize) -> Equations<R> {
    let dual: [_; 4] = std::array::from_fn(|k| dual_rotation(&links[(base + 3 + k) % 4]));
    let form = four_bar(dual.each_ref());
    let part = |part: fn(&Dual<R>) -> R| form.each_ref().map(|row| row.each_ref().map(part));
    Equations { f: part(|x| x.value.clone()), g: part(|x| x.epsilon.clone()) }
}

fn eliminant<R: Ring>(equations: &Equations<R>) -> Univariate<R> {
    closure_polynomial(equations, Hidden::First, &[1, 1, 0].map(R::from_integer))
}

/// Two equations in the angles of two joints.
struct DualPair<'s> {
    symbols: &'s Symbols,
    /// The unknown that is kept, and the one that is eliminated.
    unknowns: [usize; 2],
    equations: [HalfAngles<Rational>; 2],
}

impl<'s> DualPair<'s> {
    fn of(symbols: &'s Symbols, unknowns: [usize; 2], equations: &Equations<Symbol>) -> Self {
        let forms = [&equations.f, &equations.g].map(|form| form.each_ref().map(|row| row.each_ref().map(expanded)));
        Self { symbols, unknowns, equations: forms.map(|form| half_angles(unknowns, &form)) }
    }

    /// Returns the equations in half-angle tangents, without those that vanish.
    fn listed(&self, axes: [&str; 2]) -> Vec<(String, Polynomial<Rational>)> {
        let names = [
            format!("spherical four-bar {}-{} n.n'", axes[0], axes[1]),
            format!("dual part {}-{} n.(r x n')", axes[0], axes[1]),
        ];
        let equations = self.equations.iter().map(|equation| primitive(&equation.polynomial));
        names.into_iter().zip(equations).filter(|(_, equation)| !equation.is_zero()).collect()
    }

    /// Describes the elimination of the second unknown.
    fn resultant_in_words(&self) -> String {
        let name = self.symbols.name(self.unknowns[1]);
        format!(
            "With f = p2 t^2 + p1 t + p0 and g = q2 t^2 + q1 t + q0 in t = {name} their resultant is the square of (p2 q0 - p0 q2) less (p2 \
             q1 - p1 q2) (p1 q0 - p0 q1)"
        )
    }

    /// Returns the polynomial, and its form over the names of the coefficients of both equations.
    fn polynomial(&self, equations: &Equations<Symbol>) -> (Polynomial<Rational>, Option<OverNames>) {
        let kept = Symbols::variable(self.unknowns[0]);
        let list = eliminant(equations).coefficients().iter().map(expanded).collect();
        let (polynomial, factor) = canonical(&in_variable(kept, &Univariate::new(list)));
        if self.equations.iter().any(|equation| equation.powers != [1, 1]) {
            return (polynomial, None);
        }
        let (gone, unknowns) = (Symbols::variable(self.unknowns[1]), 3 * self.symbols.len());
        let forms = self.equations.each_ref().map(|equation| canonical(&equation.polynomial));
        let over_names: OverNames = Box::new(move |parts: &mut Parts| {
            let [f, g] = forms.each_ref().map(|(form, _)| parts.compact(form, unknowns));
            // The resultant of both is four times N1^2 + N2^2 - N3^2.
            let both = Rational::from(&forms[0].1 * &forms[1].1);
            resultant(&f, &g, gone).scale(&(factor / (Rational::from(&both * &both) * 4)))
        });
        (polynomial, Some(over_names))
    }
}

/// Returns the resultant of two polynomials of degree 2 in a variable: `(p2 q0 - p0 q2)^2 - (p2 q1 - p1 q2) (p1 q0 - p0 q1)`.
fn resultant(p: &Polynomial<Rational>, q: &Polynomial<Rational>, variable: usize) -> Polynomial<Rational> {
    let parts = |p: &Polynomial<Rational>| -> [Polynomial<Rational>; 3] {
        let list = p.coefficients_in(variable);
        std::array::from_fn(|k| list.get(k).cloned().unwrap_or_else(Polynomial::zero))
    };
    let (p, q) = (parts(p), parts(q));
    let minor = |i: usize, j: usize| p[i].mul(&q[j]).sub(&p[j].mul(&q[i]));
    minor(2, 0).mul(&minor(2, 0)).sub(&minor(2, 1).mul(&minor(1, 0)))
}

/// Returns a bilinear form in half-angle tangents.
fn half_angles(unknowns: [usize; 2], form: &Form<Polynomial<Rational>>) -> HalfAngles<Rational> {
    let [a, b] = unknowns.map(|k| [Polynomial::one(), Polynomial::variable(3 * k), Polynomial::variable(3 * k + 1)]);
    let angles = unknowns.map(|k| (Pair { cos: 3 * k, sin: 3 * k + 1 }, 3 * k + 2));
    half_tangents(&(0..3).fold(Polynomial::zero(), |total, i| total.add(&a[i].mul(&sum(&form[i], &b)))), &angles)
}

/// The common first step of eliminations from f and its dual part.
const TRANSFERENCE: &str = "With alpha + eps a for alpha and theta + eps d for theta, eps^2 = 0, the dual part g of f says that the same \
                            two axes keep their moment (transference)";

/// Derives loops with two translations along the axes of one link, written for the link opposite.
pub(super) fn neighbours(
    exact: &Exact,
    form: &LinkForm<Symbol, 4, 2>,
    base: usize,
    symbols: &Symbols,
) -> Result<Outcome> {
    let numbers: LinkForm<Rational, 4, 2> = LinkForm::of(&exact.closed).ok_or_else(no_image)?;
    let unknown = |k: usize| form.rotations[(base + k) % 4];
    let label = |k: usize| symbols.label(unknown(k));
    let unknowns = [unknown(0), unknown(1)];
    let equations = pair_at(&form.links, base);
    let pair = DualPair::of(symbols, unknowns, &equations);
    let (polynomial, over_names) = pair.polynomial(&equations);
    if polynomial.is_zero() {
        return Err(vanishing());
    }
    // For numbers the second equation comes from the coplanarity of the translations, modulo f.
    let bar = FourBar::new(&numbers, base).ok_or_else(vanishing)?;
    let kept = Symbols::variable(unknowns[0]);
    let number = Polynomial::from_univariate(kept, &eliminant(&bar.equations()));
    let steps = vec![
        format!(
            "The translations run along the axes of joints {2} and {3}. The link between them keeps their angle, f = 0, in the angles of \
             joints {0} and {1} only.",
            label(0),
            label(1),
            label(2),
            label(3)
        ),
        format!("{TRANSFERENCE}, free of both translations and of both rotations about the two axes: g = 0."),
        format!("{}, a polynomial of degree 8 in {}.", pair.resultant_in_words(), symbols.name(unknowns[0])),
        format!(
            "The common root of both is {}; the rotations of joints {} and {} and the two translations follow rationally.",
            symbols.name(unknowns[1]),
            label(2),
            label(3)
        ),
    ];
    Ok(Outcome {
        equations: pair.listed([label(2), label(3)]),
        steps,
        compare: vec![(polynomial.clone(), number)],
        removed: Polynomial::one(),
        polynomial: Some((kept, polynomial, over_names)),
        translations: Vec::new(),
        compared: "at the numbers of the file equal to the closure polynomial derived from the numbers, with coplanar translations for g".to_owned(),
    })
}

/// Returns the links of a loop of four revolutes.
fn four_links<R: Ring>(chain: &Chain, parameters: &impl Parameters<R>) -> Result<[Motion<R>; 4]> {
    let cycle = chain.cycle(parameters).ok_or_else(no_image)?;
    let links: Vec<Motion<R>> = cycle.into_iter().map(|(_, link)| link).collect();
    links.try_into().map_err(|_| no_image())
}

/// Derives the pair of equations of a loop of four revolutes, in the angle of the input, counted from 0, and the next one.
pub(super) fn four_revolutes(chain: &Chain, table: &Table<'_>, symbols: &Symbols, input: usize) -> Result<Outcome> {
    let (links, numbers) = (four_links(chain, table)?, four_links::<Rational>(chain, &Numbers)?);
    let (equations, plain) = (pair_at(&links, input), pair_at(&numbers, input));
    let unknowns = [input, (input + 1) % 4];
    let [kept, gone] = unknowns.map(Symbols::variable);
    let pair = DualPair::of(symbols, unknowns, &equations);
    if pair.equations[0].polynomial.is_zero() {
        let message = "four parallel axes: a planar loop has no spherical four-bar";
        return Err(Error::Unsupported(message.to_owned()));
    }
    let label = |k: usize| symbols.label((input + k) % 4);
    let mut steps = vec![format!(
        "The rotations close by themselves: the axes of joints {} and {} keep the angle of the link between them, f = 0 in the angles of \
         joints {} and {}, of degree 2 in the half-angle tangent of either.",
        label(2),
        label(3),
        label(0),
        label(1)
    )];
    // The powers of 1 + t^2 match those of the symbols, so that both can be compared.
    let mut compare = Vec::new();
    for (symbolic, number) in pair.equations.iter().zip([&plain.f, &plain.g]) {
        let number = half_angles(unknowns, &number.each_ref().map(|row| row.each_ref().map(constant)));
        if !symbolic.polynomial.is_zero() && number.powers == symbolic.powers {
            compare.push((symbolic.polynomial.clone(), number.polynomial));
        }
    }
    let equations_listed = pair.listed([label(2), label(3)]);
    let polynomial = if pair.equations[1].polynomial.is_zero() {
        steps.push(format!(
            "{TRANSFERENCE}; without lengths and offsets it vanishes identically: the loop is spherical, and f alone closes it, a \
             quadratic equation in {} for every {}.",
            symbols.name(unknowns[1]),
            symbols.name(unknowns[0])
        ));
        (gone, primitive(&pair.equations[0].polynomial), None)
    } else {
        steps.push(format!("{TRANSFERENCE}: g = 0."));
        steps.push(format!(
            "{}: where its coefficients in {} vanish, the loop may move.",
            pair.resultant_in_words(),
            symbols.name(unknowns[0])
        ));
        let (polynomial, over_names) = pair.polynomial(&equations);
        compare.push((polynomial.clone(), Polynomial::from_univariate(kept, &eliminant(&plain))));
        (kept, polynomial, over_names)
    };
    Ok(Outcome {
        equations: equations_listed,
        steps,
        polynomial: Some(polynomial),
        translations: Vec::new(),
        compare,
        removed: Polynomial::one(),
        compared: "at the numbers of the file equal to the same equations over the rationals".to_owned(),
    })
}

fn constant(number: &Rational) -> Polynomial<Rational> {
    Polynomial::constant(number.clone())
}

/// Derives loops with three translations by the principle of transference: the dual part of the equation in the dual angle
/// `theta + eps d` is linear in d.
pub(super) fn three_translations(
    outcome: &mut Outcome,
    symbols: &Symbols,
    form: &LinkForm<Dual<Symbol>, 3, 3>,
    dropped: usize,
) {
    let mut used = Vec::new();
    for dropped in [dropped, dropped + 1, dropped + 2].map(|k| k % 3) {
        let row = triangle_without(form, dropped).equation;
        let at = (dropped + 2) % 3;
        let unknown = form.rotations[at];
        let [one, cos, sin] = symbols.monomials(unknown, false);
        let [e0, e1, e2] = row.each_ref().map(|x| expanded(&x.epsilon));
        let [v0, v1, v2] = row.each_ref().map(|x| expanded(&x.value));
        let denominator = v2.mul(&cos).sub(&v1.mul(&sin));
        if denominator.is_zero() {
            continue;
        }
        let monomials = [one, cos, sin];
        if !used.is_empty() {
            let label = |k: usize| symbols.label(form.rotations[(dropped + k) % 3]);
            let name = format!("spherical triangle {}-{} n.n'", label(1), label(3));
            outcome.equations.push((name, primitive(&sum(&[v0, v1, v2], &monomials))));
        }
        used.push(symbols.label(unknown).to_owned());
        let numerator = sum(&[e0, e1, e2], &monomials);
        let numerator = if runs_back(form, &form.slides[at], at) { numerator } else { numerator.neg() };
        let variable = Symbols::variable(form.slides[at].unknown);
        outcome.translations.push(Quotient { variable, numerator, denominator });
    }
    outcome.steps.push(format!(
        "With alpha + eps a for alpha and theta + eps d for theta, eps^2 = 0, the equation of the triangle holds for the \
         loop itself (transference): its dual part is linear in the translation along the axis whose angle it has, here of \
         joints {}.",
        used.join(", ")
    ));
}
