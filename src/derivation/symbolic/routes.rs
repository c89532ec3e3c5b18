//! The eliminations that are finite work with symbols.

use super::Numeric;
use super::parts::Parts;
use super::table::{Symbol, Table, Transferred};
use crate::algebra::dual::Dual;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::trigonometric::{Pair, half_tangents};
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::derivation::chain::{Eliminated, Exact};
use crate::derivation::equation::primitive;
use crate::derivation::symbolic::Quotient;
use crate::derivation::symbols::Symbols;
use crate::derivation::triangle::of_row;
use crate::elimination::cut::Hidden;
use crate::elimination::octic::closure_polynomial;
use crate::elimination::opposite_axes::OppositeAxes;
use crate::elimination::point_reach::Reach;
use crate::elimination::separated::{Plan, Separated, powers, quartic};
use crate::elimination::spherical_four_bar::{Equations, Form, four_bar};
use crate::elimination::spherical_pair;
use crate::elimination::spherical_triangle::{triangle, triangle_without};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry};
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Numbers, Parameters, Variable};
use crate::kinematics::link_form::LinkForm;
use crate::kinematics::motion::Motion;
use crate::mechanism::locked_variable;
use rug::Rational;

/// A polynomial over the names of sub-expressions, which it may give.
type OverNames = Box<dyn FnOnce(&mut Parts) -> Polynomial<Rational>>;

/// What a route hands over.
pub(super) struct Outcome {
    /// Name and polynomial over unknowns and symbols.
    pub equations: Vec<(String, Polynomial<Rational>)>,
    pub steps: Vec<String>,
    /// The variable left, the polynomial, and how its coefficients are named if not one by one.
    pub polynomial: Option<(usize, Polynomial<Rational>, Option<OverNames>)>,
    pub translations: Vec<Quotient>,
    /// Results with symbols, and what they should become at the numbers of the file.
    pub compare: Vec<(Polynomial<Rational>, Polynomial<Rational>)>,
    pub compared: String,
}

/// An element of the ring as a polynomial.
fn expanded(symbol: &Symbol) -> Polynomial<Rational> {
    symbol.polynomial().clone()
}

/// The polynomial in one unknown that coefficients in a ring of polynomials are.
fn in_variable(variable: usize, polynomial: &Univariate<Polynomial<Rational>>) -> Polynomial<Rational> {
    Polynomial::from_coefficients_in(variable, polynomial.coefficients())
}

fn symbolic_loop(chain: &Chain, case: &Case, table: &Table<'_>) -> Result<ClosedLoop<Symbol>> {
    let layout = Layout::of(chain, locked_variable(chain, case)?)?;
    let open = chain.open_loop_over(&layout, table)?;
    Ok(open.ok_or_else(no_image)?.close(&table.filling()?))
}

fn no_image() -> Error {
    Error::Unsupported("the geometry has no image in the ring of symbols".to_owned())
}

/// Any loop but that of four revolutes.
pub(super) fn route(
    chain: &Chain,
    case: &Case,
    table: &Table<'_>,
    symbols: &Symbols,
    numeric: &Numeric,
) -> Result<Outcome> {
    let (exact, eliminated) = match numeric {
        Numeric::Coupled(eliminated) => {
            let layout = Layout::of(chain, locked_variable(chain, case)?)?;
            let coupled = chain.open_coupled(&layout, table)?.close(&table.filling()?);
            return one_row(symbols, 0, coupled.variable, &spherical_pair::equation(&coupled), eliminated);
        }
        Numeric::Single(exact, eliminated) => (exact, eliminated),
    };
    let closed = symbolic_loop(chain, case, table)?;
    if let Some(ball) = exact.ball {
        let equations = Reach::of(&closed, ball).equations;
        let plan = Reach::of(&exact.closed, ball).equations.plan(0.0);
        return two_rows(symbols, [5, 3].map(|k| (ball + k) % 6), &equations, &plan, eliminated);
    }
    if let (Some(form), Some(numbers)) = (LinkForm::<_, 4, 2>::of(&closed), LinkForm::<_, 4, 2>::of(&exact.closed)) {
        let axes = OppositeAxes::of(&numbers, 0.0).ok_or_else(no_image)?;
        let unknowns = [1, 3].map(|k| form.rotations[(axes.first + k) % 4]);
        return two_rows(symbols, unknowns, &axes.equations(&form), &axes.equations(&numbers).plan(0.0), eliminated);
    }
    let (form, numbers): (LinkForm<_, 3, 3>, LinkForm<_, 3, 3>) =
        LinkForm::of(&closed).zip(LinkForm::of(&exact.closed)).ok_or_else(no_image)?;
    let dropped = triangle(&numbers).dropped;
    let unknown = form.rotations[(dropped + 2) % 3];
    let row = triangle_without(&form, dropped).equation;
    let mut outcome = one_row(symbols, unknown, Variable::Rotation, &row, eliminated)?;
    if let Some(transferred) = transferred(chain, case, table, exact)? {
        three_translations(&mut outcome, symbols, &transferred, dropped);
    }
    Ok(outcome)
}

/// One equation in one unknown.
fn one_row(
    symbols: &Symbols,
    unknown: usize,
    kind: Variable,
    row: &[Symbol; 3],
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let row = row.each_ref().map(expanded);
    let equation = sum(&row, &symbols.monomials(unknown, false));
    let variable = Symbols::variable(unknown);
    let polynomial = in_variable(variable, &of_row(kind, &row));
    let over_names: OverNames =
        Box::new(move |parts| in_variable(variable, &of_row(kind, &row.each_ref().map(|c| parts.name(c)))));
    finish(variable, &[equation], &polynomial, over_names, eliminated)
}

fn sum(row: &[Polynomial<Rational>; 3], monomials: &[Polynomial<Rational>; 3]) -> Polynomial<Rational> {
    row.iter().zip(monomials).fold(Polynomial::zero(), |sum, (c, monomial)| sum.add(&c.mul(monomial)))
}

/// The closure polynomial of two equations with separated sides, without division.
fn closure<R: Ring>(equations: &Separated<R>, hidden: usize) -> Univariate<R> {
    let powers = powers(equations.kinds[hidden], &[1, 1, 0].map(R::from_integer));
    Univariate::new(quartic(&equations.conic(hidden, &equations.solved(1 - hidden)), &powers).to_vec())
}

/// Two equations with an unknown on either side.
fn two_rows(
    symbols: &Symbols,
    unknowns: [usize; 2],
    equations: &Separated<Symbol>,
    plan: &Plan<Rational>,
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let Plan::Together { hidden, .. } = *plan else {
        let message = "symbols for a loop whose two equations fall apart into one in each unknown, for the numbers of the \
                       file";
        return Err(Error::Unsupported(message.to_owned()));
    };
    // All constants on the first side, so that each has one name.
    let rows = equations.rows.each_ref().map(|row| {
        let [mut left, mut right] = row.each_ref().map(|side| side.each_ref().map(expanded));
        left[0] = left[0].sub(&right[0]);
        right[0] = Polynomial::zero();
        [left, right]
    });
    let listed = rows.iter().map(|row| {
        let [left, right] = [0, 1].map(|side| sum(&row[side], &symbols.monomials(unknowns[side], false)));
        left.sub(&right)
    });
    let variable = Symbols::variable(unknowns[hidden]);
    let polynomial = Univariate::new(closure(equations, hidden).coefficients().iter().map(expanded).collect());
    let (kinds, listed) = (equations.kinds, listed.collect::<Vec<_>>());
    let over_names: OverNames = Box::new(move |parts| {
        let rows = rows.each_ref().map(|row| row.each_ref().map(|side| side.each_ref().map(|c| parts.name(c))));
        in_variable(variable, &closure(&Separated { kinds, rows }, hidden))
    });
    finish(variable, &listed, &in_variable(variable, &polynomial), over_names, eliminated)
}

/// The primitive multiple with positive leading coefficient, and the factor.
fn canonical(polynomial: &Polynomial<Rational>) -> (Polynomial<Rational>, Rational) {
    let primitive = primitive(polynomial);
    let factor = match (primitive.coefficients().first(), polynomial.coefficients().first()) {
        (Some(own), Some(given)) => Rational::from(own / given),
        _ => Rational::from(1),
    };
    (primitive, factor)
}

/// With the names and steps of the derivation from numbers, and its polynomial to compare with.
fn finish(
    variable: usize,
    equations: &[Polynomial<Rational>],
    polynomial: &Polynomial<Rational>,
    over_names: OverNames,
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let number = match &eliminated.polynomial {
        Some((_, polynomial, _)) => Polynomial::from_univariate(variable, polynomial),
        None => Polynomial::zero(),
    };
    if polynomial.is_zero() {
        let message =
            "the closure polynomial vanishes whatever the symbols are: a self-motion, or no isolated solution";
        return Err(Error::Unsupported(message.to_owned()));
    }
    let (polynomial, factor) = canonical(polynomial);
    let over_names: OverNames = Box::new(move |parts| over_names(parts).scale(&factor));
    let names = eliminated.equations.iter().map(|equation| equation.name.clone());
    let equations = equations.iter().map(|equation| canonical(equation).0);
    Ok(Outcome {
        equations: names.zip(equations).collect(),
        steps: eliminated.steps.clone(),
        compare: vec![(polynomial.clone(), number)],
        polynomial: Some((variable, polynomial, Some(over_names))),
        translations: Vec::new(),
        compared: "the closure polynomial derived from the numbers".to_owned(),
    })
}

/// The loop over dual numbers, if each of its three translations runs along the axis of its own rotation.
fn transferred(
    chain: &Chain,
    case: &Case,
    table: &Table<'_>,
    exact: &Exact,
) -> Result<Option<LinkForm<Dual<Symbol>, 3, 3>>> {
    let numbers: LinkForm<Rational, 3, 3> = LinkForm::of(&exact.closed).ok_or_else(no_image)?;
    let along = [0, 0, 1].map(Rational::from);
    let cylinders = numbers.slides.iter().zip(0..).all(|(slide, k)| slide.link == k && slide.direction == along);
    let (Geometry::Dh(joints) | Geometry::ModifiedDh(joints)) = &chain.geometry else { return Ok(None) };
    let filling = table.filling()?;
    let still = filling.translation.iter().all(Ring::is_zero);
    if !cylinders || !still || case.pose.is_some() {
        return Ok(None);
    }
    let layout = Layout::of(chain, locked_variable(chain, case)?)?;
    let open = chain.open_loop_over(&layout, &Transferred { joints, parameters: table })?.ok_or_else(no_image)?;
    let filling: Motion<Dual<Symbol>> = filling.map(|x| Some(Dual::constant(x.clone()))).ok_or_else(no_image)?;
    Ok(LinkForm::of(&open.close(&filling)))
}

/// The three translations by the principle of transference: the dual part of the equation in the dual angle
/// `theta + eps d` is linear in d.
fn three_translations(outcome: &mut Outcome, symbols: &Symbols, form: &LinkForm<Dual<Symbol>, 3, 3>, dropped: usize) {
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
        let numerator = sum(&[e0, e1, e2], &monomials).neg();
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

/// The spherical four-bar of four rotations and its dual part, in the angles of the last and the first one.
fn forms<R: Ring>(chain: &Chain, parameters: &impl Parameters<Dual<R>>) -> Option<[Form<R>; 2]> {
    let cycle = chain.cycle(parameters)?;
    let [first, second, third, fourth] = cycle.as_slice() else { return None };
    let form = four_bar([third, fourth, first, second].map(|(_, link)| &link.rotation));
    let part = |part: fn(&Dual<R>) -> R| form.each_ref().map(|row| row.each_ref().map(part));
    Some([part(|x| x.value.clone()), part(|x| x.epsilon.clone())])
}

fn eliminant<R: Ring>([f, g]: &[Form<R>; 2]) -> Univariate<R> {
    let equations = Equations { f: f.clone(), g: g.clone() };
    closure_polynomial(&equations, Hidden::First, &[1, 1, 0].map(R::from_integer))
}

/// The pair of equations of a loop of four revolutes.
pub(super) fn pair(chain: &Chain, table: &Table<'_>, symbols: &Symbols) -> Result<Outcome> {
    let (Geometry::Dh(joints) | Geometry::ModifiedDh(joints)) = &chain.geometry else { return Err(no_image()) };
    let with_symbols = forms(chain, &Transferred { joints, parameters: table }).ok_or_else(no_image)?;
    let numbers: [Form<Rational>; 2] =
        forms(chain, &Transferred { joints, parameters: &Numbers }).ok_or_else(no_image)?;
    let [a, b] = [3, 0].map(|unknown| symbols.monomials(unknown, false));
    let angles = [3, 0].map(|k| (Pair { cos: 3 * k, sin: 3 * k + 1 }, 3 * k + 2));
    let bilinear = |form: &[[Polynomial<Rational>; 3]; 3]| {
        (0..3).fold(Polynomial::zero(), |total, i| total.add(&a[i].mul(&sum(&form[i], &b))))
    };
    let equations = with_symbols.each_ref().map(|form| {
        half_tangents(&bilinear(&form.each_ref().map(|row| row.each_ref().map(expanded))), &angles).polynomial
    });
    let plain = numbers.each_ref().map(|form| {
        let form = form.each_ref().map(|row| row.each_ref().map(|c| Polynomial::constant(c.clone())));
        half_tangents(&bilinear(&form), &angles)
    });
    // The powers of 1 + t^2 are those of the symbols, so that both can be compared.
    let mut compare = Vec::new();
    for (symbolic, number) in equations.iter().zip(&plain) {
        if !symbolic.is_zero() && number.powers == [1, 1] {
            compare.push((symbolic.clone(), number.polynomial.clone()));
        }
    }
    if equations[0].is_zero() {
        let message = "four parallel axes: a planar loop has no spherical four-bar";
        return Err(Error::Unsupported(message.to_owned()));
    }
    let label = |k: usize| symbols.label(k);
    let names = [
        format!("spherical four-bar {}-{} n.n'", label(1), label(2)),
        format!("dual part {}-{} n.(r x n')", label(1), label(2)),
    ];
    let mut steps = vec![
        format!(
            "The rotations close by themselves: the axes of joints {} and {} keep the angle of the link between them, f = 0 in \
             the angles of joints {} and {}.",
            label(1),
            label(2),
            label(3),
            label(0)
        ),
        "With alpha + eps a for alpha and eps d for the constant d, eps^2 = 0, the dual part g of f says that the same two \
         axes keep their moment (transference); it vanishes identically without lengths."
            .to_owned(),
        format!(
            "With f = (C, A, B).(1, cos, sin) of joint {} and g likewise, the vector product N of both leaves N1^2 + N2^2 - \
             N3^2 = 0 in {}: where its coefficients vanish, the loop may move.",
            label(0),
            symbols.name(3)
        ),
    ];
    let variable = Symbols::variable(3);
    let polynomial = (!equations[1].is_zero()).then(|| {
        let polynomial = eliminant(&with_symbols);
        let list = polynomial.coefficients().iter().map(expanded).collect();
        let polynomial = in_variable(variable, &Univariate::new(list));
        compare.push((polynomial.clone(), Polynomial::from_univariate(variable, &eliminant(&numbers))));
        primitive(&polynomial)
    });
    if polynomial.is_none() {
        steps.pop();
    }
    let equations = names.into_iter().zip(equations.iter().map(primitive)).filter(|(_, equation)| !equation.is_zero());
    Ok(Outcome {
        equations: equations.collect(),
        steps,
        polynomial: polynomial.map(|polynomial| (variable, polynomial, None)),
        translations: Vec::new(),
        compare,
        compared: "the same equations over the rationals".to_owned(),
    })
}
