//! The number of configurations that a chain that does not move can have, by exact arithmetic alone.

use super::stillness::conditions;
use crate::algebra::determinant::{by_interpolation, determinant};
use crate::algebra::drawn::Drawn;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::exact::linkage::{JointValue, Linkage};
use crate::exact::positions::{Conjugates, Positions, positions};
use crate::kinematics::closed_loop::Variable;
use rug::Rational;

/// The field of the counts.
type Mod = Drawn;
/// The conditions have this degree at most in the variable held.
const DEGREE: usize = 4;

/// The number of configurations of a chain of up to five joint variables, complex ones included; `None` where no cut separates
/// them.
///
/// # Panics
/// When there are more than five joint variables, or none.
///
/// # Source
/// docs/mobility.md, theorem 3.
#[must_use]
pub fn count(linkage: &Linkage<Rational>) -> Option<usize> {
    match positions(linkage) {
        Positions::Finite { found, .. } => Some(found.iter().map(Conjugates::count).sum()),
        Positions::Unknown => None,
    }
}

/// Returns an upper bound on the number of configurations, complex ones included, of a chain of six joint variables: the least
/// number of values that the conditions of the cuts leave a rotation k. It tries rotations until the bound is down to `enough`.
///
/// The conditions of the cuts that hide variable h, with k held, are polynomials in both tangents, and every configuration is a
/// common zero of all of them. Their resultants by h are polynomials in the tangent of k, for every other variable h. The common
/// divisor of all has at least as many zeros as there are configurations, those with the angle pi at infinity. It is computed
/// modulo a prime, where its degree can only be greater.
///
/// # Panics
/// Unless there are six joint variables.
///
/// # Source
/// docs/mobility.md, theorem 6.
#[must_use]
pub fn at_most(linkage: &Linkage<Rational>, enough: usize) -> Option<usize> {
    assert_eq!(linkage.variables.len(), 6, "six joint variables");
    let image = linkage.map::<Mod>()?;
    let mut least = None;
    for k in (0..6).filter(|k| linkage.variables[*k] == Variable::Rotation) {
        let mut values = Values::default();
        for hidden in (1..6).map(|step| (k + step) % 6) {
            values.note(&image, k, hidden);
            let count = values.count(image.axes[k].square());
            least = match (least, count) {
                (Some(a), Some(b)) => Some(usize::min(a, b)),
                (a, b) => a.or(b),
            };
            if least.is_some_and(|least| least <= enough) {
                return least;
            }
        }
    }
    least
}

/// The values of one rotation that the conditions leave.
#[derive(Default)]
struct Values {
    /// The common divisor of all resultants, and the least multiplicity of its zero at infinity.
    common: Option<(Univariate<Mod>, usize)>,
}

impl Values {
    /// Takes the resultants by one more hidden variable into account.
    fn note(&mut self, image: &Linkage<Mod>, k: usize, hidden: usize) {
        // At each value of k: the forms in the hidden variable, of the degrees that they have in general.
        let at = |value: &Mod| -> Vec<(Univariate<Mod>, usize)> {
            let held: [(usize, JointValue<Mod>); 1] = [(k, [Mod::one(), *value])];
            let place = if hidden > k { hidden - 1 } else { hidden };
            conditions(&image.locked(&held), place, |m| by_interpolation(m)).collect()
        };
        let values: Vec<Mod> = (0..=8 * DEGREE as u64).map(|shift| Mod::new(1_000_003 + 7919 * shift)).collect();
        let forms: Vec<Vec<(Univariate<Mod>, usize)>> = values.iter().map(at).collect();
        let count = forms.first().map_or(0, Vec::len);
        for (i, j) in (0..count).flat_map(|j| (0..j).map(move |i| (i, j))) {
            let resultants = values.iter().zip(&forms).map(|(x, forms)| (*x, resultant(&forms[i], &forms[j])));
            let polynomial = Univariate::interpolate(&resultants.collect::<Vec<_>>());
            let Some(degree) = polynomial.degree() else { continue };
            let at_infinity = (DEGREE * (forms[0][i].1 + forms[0][j].1)).saturating_sub(degree);
            self.common = Some(match self.common.take() {
                None => (polynomial, at_infinity),
                Some((divisor, least)) => (divisor.gcd(&polynomial), least.min(at_infinity)),
            });
        }
    }

    /// Returns the number of remaining values, without those that belong to no angle: tangent i over the length of the axis.
    fn count(&self, square: Mod) -> Option<usize> {
        let (divisor, at_infinity) = self.common.as_ref()?;
        let circle = Univariate::new(vec![Mod::one(), Mod::zero(), square]);
        let (_, proper) = divisor.remove_factor(&circle);
        proper.degree().map(|degree| degree + at_infinity)
    }
}

/// The resultant of two forms.
fn resultant((p, m): &(Univariate<Mod>, usize), (q, n): &(Univariate<Mod>, usize)) -> Mod {
    let size = m + n;
    let row = |f: &Univariate<Mod>, shift: usize| -> Vec<Mod> {
        let mut row = vec![Mod::zero(); size];
        for (entry, c) in row[shift..].iter_mut().zip(f.coefficients()) {
            *entry = *c;
        }
        row
    };
    let rows: Vec<Vec<Mod>> = (0..*n).map(|s| row(p, s)).chain((0..*m).map(|s| row(q, s))).collect();
    determinant(&rows)
}
