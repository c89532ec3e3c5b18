//! Estimates the size of a closure polynomial with symbols, for loops whose polynomial is too large.

use super::table::{Table, Value};
use crate::algebra::number::{Angle, Number};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::{Case, InputValue};
use crate::derivation::chain::{Exact, Mod};
use crate::derivation::{cuts, four_bar};
use crate::elimination::degree::{closure_polynomial, half_tangent_pair};
use crate::elimination::kind::Elimination;
use crate::elimination::octic;
use crate::elimination::separated::offset;
use crate::elimination::spherical_four_bar::FourBar;
use crate::error::Error;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Parameter, Parameters};
use crate::kinematics::link_form::LinkForm;
use crate::kinematics::motion::Motion;
use crate::mechanism::locked_variable;

/// Number of samples. The sum of numerator and denominator degrees found in a parameter is a little below it.
const SAMPLES: usize = 112;

/// Values of the symbolic parameters; all others are the numbers of the file.
struct Point<'t, 'c> {
    table: &'t Table<'c>,
    /// Half-angle tangents and lengths, in the order of the symbols.
    values: Vec<Mod>,
}

impl Point<'_, '_> {
    fn at(&self, place: Option<(usize, Parameter)>) -> Option<&Mod> {
        self.table.symbols.iter().zip(&self.values).find(|(symbol, _)| symbol.place == place).map(|(_, value)| value)
    }

    fn closing(&self, case: &Case) -> Option<Motion<Mod>> {
        let Some(input) = case.input.first() else {
            let Some(pose) = &case.pose else { return Some(Motion::identity()) };
            return pose.exact.inverse().map(Mod::from_rational);
        };
        Some(match (&input.value, self.at(None)) {
            (InputValue::Angle(angle), value) => {
                let (cos, sin) = value.map_or_else(|| Mod::cos_sin(angle), half_tangent_pair)?;
                Motion::rotation_z(cos, sin)
            }
            (InputValue::Distance(_), Some(value)) => Motion::translation_z(*value),
            (InputValue::Distance(distance), None) => Motion::translation_z(Mod::from_number(distance)?),
        })
    }
}

impl Parameters<Mod> for Point<'_, '_> {
    fn angle(&self, joint: usize, parameter: Parameter, value: &Angle) -> Option<(Mod, Mod)> {
        self.at(Some((joint, parameter))).map_or_else(|| Mod::cos_sin(value), half_tangent_pair)
    }
    fn length(&self, joint: usize, parameter: Parameter, value: &Number) -> Option<Mod> {
        self.at(Some((joint, parameter))).map_or_else(|| Mod::from_number(value), |value| Some(*value))
    }
}

/// Returns the error that states the size of the closure polynomial.
pub(super) fn too_large(chain: &Chain, case: &Case, exact: &Exact) -> Error {
    let what = match exact.elimination().degree(exact.closed.variables) {
        Some(degree) => format!("the closure polynomial of this loop, of degree {degree} in general,"),
        None => "the closure polynomial of this loop".to_owned(),
    };
    let size = Table::of(chain, case, &[], 0, true).map(|table| size(chain, case, exact, &table));
    let size = match size {
        Ok(Some(size)) => size,
        Ok(None) => "its size could not be measured".to_owned(),
        Err(error) => return error,
    };
    Error::Unsupported(format!(
        "{what} is too large for symbols in all its parameters: {size}; name up to three of them (--symbolic=a1); all parameters are kept in loops \
         with three unknown rotations, both translations along two of four axes, one or two spherical joints, or four revolutes alone"
    ))
}

/// Returns the degrees and a bound of the number of terms, as text.
fn size(chain: &Chain, case: &Case, exact: &Exact, table: &Table<'_>) -> Option<String> {
    let layout = Layout::of(chain, locked_variable(chain, case).ok()?).ok()?;
    let choice = Choice::of(exact)?;
    let polynomial = |values: Vec<Mod>| {
        let point = Point { table, values };
        let closed = chain.open_loop_over(&layout, &point).ok()??.close(&point.closing(case)?);
        choice.polynomial(&closed)
    };
    let is_length = |k: usize| matches!(table.symbols[k].value, Value::Length(_));
    let count = table.symbols.len();
    let (lengths, angles): (Vec<usize>, Vec<usize>) = (0..count).partition(|&k| is_length(k));
    // Values in general position, and a line through them along some of the parameters.
    let start = |k: usize| Mod::new(1_000_003 * (k as u64 + 3).pow(5) + 77_711);
    let slope = |k: usize| Mod::new(7_654_321 * (k as u64 + 5).pow(4) + 1_234_577);
    let along = |moving: &[usize]| {
        let at = |x: Mod| -> Vec<Mod> {
            (0..count).map(|k| if moving.contains(&k) { start(k).add(&slope(k).mul(&x)) } else { start(k) }).collect()
        };
        degree(|x| polynomial(at(x)))
    };
    let of_lengths = if lengths.is_empty() { 0 } else { along(&lengths)? };
    let of_angles = angles.iter().map(|&k| along(&[k])).collect::<Option<Vec<usize>>>()?;
    let own = polynomial((0..count).map(start).collect())?.degree()?;
    // Homogeneous in the lengths, and of these degrees in the half-angle tangents and in the unknown.
    let mut size = (own as f64 + 1.0).log10();
    for k in 1..lengths.len() {
        size += ((of_lengths + k) as f64 / k as f64).log10();
    }
    size += of_angles.iter().map(|degree| (*degree as f64 + 1.0).log10()).sum::<f64>();
    let (least, most) = (of_angles.iter().min()?, of_angles.iter().max()?);
    let range = if least == most { most.to_string() } else { format!("{least} to {most}") };
    Some(format!(
        "with {count} symbols it is of degree {own} in the unknown, {of_lengths} in {} lengths together and {range} in the \
         half-angle tangent of each of {} angles (measured modulo 2^61 - 1), which leaves room for 10^{:.0} terms",
        lengths.len(),
        angles.len(),
        size.floor()
    ))
}

/// The route to the polynomial that the numbers of the file require.
enum Choice {
    Cut(crate::elimination::cut::Cut, crate::elimination::cut::Hidden),
    Link(usize, crate::elimination::cut::Hidden),
}

impl Choice {
    fn of(exact: &Exact) -> Option<Self> {
        let modular = exact.modular.as_ref()?;
        match exact.elimination() {
            Elimination::Cut => cuts::choice(modular).map(|(cut, hidden)| Self::Cut(cut, hidden)),
            Elimination::FourBar => {
                four_bar::choice(&LinkForm::of(modular)?).map(|(base, hidden)| Self::Link(base, hidden))
            }
            Elimination::Centre(_) | Elimination::Triangle | Elimination::Planar => None,
        }
    }

    fn polynomial(&self, closed: &crate::kinematics::closed_loop::ClosedLoop<Mod>) -> Option<Univariate<Mod>> {
        match *self {
            Self::Cut(cut, hidden) => closure_polynomial(closed, cut, hidden).map(|found| found.cofactor),
            Self::Link(base, hidden) => {
                let form = LinkForm::of(closed)?;
                let equations = FourBar::new(&form, base)?.equations();
                Some(octic::closure_polynomial(&equations, hidden, &offset()))
            }
        }
    }
}

/// Returns the degree of a polynomial's coefficients in a parameter, once they have no common factor: from its values by
/// rational reconstruction of a quotient of two of them.
fn degree(polynomial: impl Fn(Mod) -> Option<Univariate<Mod>>) -> Option<usize> {
    let mut points = Vec::new();
    for n in (0..).take(SAMPLES) {
        let x = Mod::new(3 * n + 11);
        let coefficients = polynomial(x)?.normalise();
        let weighted =
            coefficients.coefficients().iter().zip(1..).map(|(c, w)| c.mul(&Mod::from_integer(w * w + 7 * w)));
        points.push((x, weighted.fold(Mod::zero(), |sum, term| sum.add(&term))));
    }
    let mut product = Univariate::constant(Mod::one());
    for (x, _) in &points {
        product = product.mul(&Univariate::new(vec![x.neg(), Mod::one()]));
    }
    // Euclid's algorithm finds, of all quotients with these values, the one of least degree.
    let (mut upper, mut lower) =
        ((product, Univariate::zero()), (Univariate::interpolate(&points), Univariate::constant(Mod::one())));
    let size = |(numerator, denominator): &(Univariate<Mod>, Univariate<Mod>)| {
        (numerator.degree().unwrap_or(0), denominator.degree().unwrap_or(0))
    };
    let mut best = size(&lower);
    while !lower.0.is_zero() {
        let found = size(&lower);
        if found.0 + found.1 < best.0 + best.1 {
            best = found;
        }
        let quotient = upper.0.div_rem(&lower.0).0;
        let next = (upper.0.sub(&quotient.mul(&lower.0)), upper.1.sub(&quotient.mul(&lower.1)));
        (upper, lower) = (lower, next);
    }
    (best.0 + best.1 + 8 < SAMPLES).then_some(best.0.max(best.1))
}
