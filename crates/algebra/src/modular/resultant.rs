//! Resultants of polynomials with numeric coefficients.

use super::bound::Norms;
use super::cost::cost;
use super::lattice::Lattice;
use super::problem::{Form, Problem, most_points};
use super::substitution::Plan;
use super::terms::{Terms, descending};
use pulp::Arch;
use rug::Integer;

/// The degree beyond which a matrix of that size is not to be written down.
const HIGHEST_DEGREE: usize = 1 << 10;

/// Returns the resultant of two polynomials with respect to one of their variables: the determinant of the Sylvester matrix.
///
/// It is exact and proved, from as many values modulo as many primes as bounds on its degree and coefficients require. With
/// degrees m of f and n of g it has the sign for which `Res(f, g) = a^n prod g(x_i)`, the `x_i` being the roots of f and
/// a its leading coefficient, so `Res(f, c) = c^m`. It is zero if f or g is. `None` if that takes too much memory: for
/// degrees above 1024, or for more than a few million values.
///
/// # Shape
/// Both polynomials, and the resultant, have the given number of variables; the resultant has exponent 0 in the one
/// eliminated. No two terms of a polynomial have the same exponents.
///
/// # Panics
/// If the shape is wrong.
///
/// # Source
/// Diaz-Toca, Gonzalez-Vega 2004, Various new expressions for subresultants and their applications (the hybrid Bezout
/// matrix, whose determinant is the resultant also where leading coefficients vanish).
///
/// # Example
/// ```
/// use looproot_algebra::modular::{Terms, resultant};
///
/// // x^2 + y^2 - 25 and x y - 12, without x: y^4 - 25 y^2 + 144
/// let circle = Terms { exponents: vec![2, 0, 0, 2, 0, 0], coefficients: [1, 1, -25].map(Into::into).to_vec() };
/// let hyperbola = Terms { exponents: vec![1, 1, 0, 0], coefficients: [1, -12].map(Into::into).to_vec() };
/// let quartic = resultant(&circle, &hyperbola, 2, 0).expect("that needs few values");
/// assert_eq!(quartic.exponents, [0, 0, 0, 2, 0, 4]);
/// assert_eq!(quartic.coefficients, [144, -25, 1]);
/// ```
#[must_use]
pub fn resultant(f: &Terms, g: &Terms, variables: usize, variable: usize) -> Option<Terms> {
    resultant_on(Arch::new(), f, g, variables, variable)
}

/// As `resultant`, on a chosen instruction set.
pub(super) fn resultant_on(arch: Arch, f: &Terms, g: &Terms, variables: usize, variable: usize) -> Option<Terms> {
    assert!(variable < variables, "the variable is one of them");
    let Some(pair) = Pair::new(f, g, variables, variable) else { return Some(Terms::default()) };
    let bounds = pair.bounds()?;
    let lattice = Lattice::new(&bounds.degrees, bounds.total, most_points(bounds.bits, bounds.degrees.len()))?;

    // If the bound is 0, the resultant is the same at 0.
    let parameters = &bounds.parameters;
    let kept = |e: &[u32]| (0..variables).all(|k| e[k] == 0 || k == variable || parameters.contains(&k));
    let terms = descending(pair.terms().filter(|(_, e, _)| kept(e)), parameters);
    let problem = Problem {
        form: Form::Resultant(pair.m, pair.n),
        plan: Plan::new(&terms.slots, &terms.exponents, parameters.len()),
        coefficients: terms.coefficients,
        lattice,
        bits: bounds.bits,
    };
    let mut coefficients = problem.solve(arch);
    if pair.negative {
        for c in &mut coefficients {
            *c = -std::mem::take(c);
        }
    }
    Some(problem.lattice.terms(coefficients, variables, parameters))
}

/// Returns what [`resultant`] is predicted to cost, in nanoseconds, and how many terms the resultant may have at most;
/// `None` if that takes too much memory.
pub(crate) fn resultant_cost(f: &Terms, g: &Terms, variables: usize, variable: usize) -> Option<(f64, f64)> {
    /// The steps at a point for each entry of the matrix that is made of the coefficients.
    const FILL: f64 = 3.0;
    let pair = Pair::new(f, g, variables, variable)?;
    let Bounds { degrees, total, bits, .. } = pair.bounds()?;
    let steps = FILL * (pair.m * pair.n) as f64;
    let terms = f.coefficients.len() + g.coefficients.len();
    cost(pair.m, steps, &degrees, total, bits, terms)
}

/// Two polynomials, that of the higher degree first.
struct Pair<'a> {
    f: &'a Terms,
    g: &'a Terms,
    /// Their degrees.
    m: usize,
    n: usize,
    /// Whether the exchange of the two turns the sign of the resultant.
    negative: bool,
    variables: usize,
    variable: usize,
}

/// What is known of a resultant beforehand.
struct Bounds {
    /// The parameters that may occur in it, and its degrees in these.
    parameters: Vec<usize>,
    degrees: Vec<usize>,
    /// Its total degree.
    total: usize,
    /// The binary logarithm of its coefficients.
    bits: f64,
}

impl<'a> Pair<'a> {
    /// Returns the two polynomials in order; `None` if one is zero.
    fn new(f: &'a Terms, g: &'a Terms, variables: usize, variable: usize) -> Option<Self> {
        let degree = |p: &Terms| p.iter(variables).map(|(e, _)| e[variable] as usize).max();
        let (m, n) = (degree(f)?, degree(g)?);
        let pair = Self { f, g, m, n, negative: false, variables, variable };
        let exchanged = |pair| Self { f: g, g: f, m: n, n: m, negative: m % 2 == 1 && n % 2 == 1, ..pair };
        Some(if m < n { exchanged(pair) } else { pair })
    }

    /// Returns the terms by coefficient: of f from the constant one on, then of g.
    fn terms(&self) -> impl Iterator<Item = (usize, &'a [u32], &'a Integer)> + Clone {
        let (m, variable) = (self.m, self.variable);
        let of_f = self.f.iter(self.variables).map(move |(e, c)| (e[variable] as usize, e, c));
        of_f.chain(self.g.iter(self.variables).map(move |(e, c)| (m + 1 + e[variable] as usize, e, c)))
    }

    /// Returns the bounds; `None` if the degree is too high.
    fn bounds(&self) -> Option<Bounds> {
        let Self { m, n, .. } = *self;
        if m > HIGHEST_DEGREE {
            return None;
        }
        let norms = Norms::new(m + n + 2, self.terms().map(|(slot, _, c)| (slot, c)));
        let bits = n as f64 * norms.bits(0..=m) + m as f64 * norms.bits(m + 1..=m + n + 1);
        let bound = |size: &dyn Fn(&[u32]) -> i64| {
            let mut highest = vec![i64::MIN; m + n + 2];
            for (slot, e, _) in self.terms() {
                highest[slot] = highest[slot].max(size(e));
            }
            degree_bound(&highest, m)
        };
        let others = (0..self.variables).filter(|&k| k != self.variable);
        let (parameters, degrees): (Vec<usize>, Vec<usize>) =
            others.map(|k| (k, bound(&|e| i64::from(e[k])))).filter(|&(_, degree)| degree > 0).unzip();
        let others = |e: &[u32]| e.iter().map(|&x| i64::from(x)).sum::<i64>() - i64::from(e[self.variable]);
        Some(Bounds { parameters, degrees, total: bound(&others), bits })
    }
}

/// Returns a bound on the degree of the resultant in some parameters, from the highest degrees of the coefficients of f, then g.
///
/// With weight w for the variable, no term of f is above some degree F, and none of g above some G; then every term of
/// the Sylvester determinant is at most of degree `n F + m G - w m n`.
fn degree_bound(highest: &[i64], m: usize) -> usize {
    let (f, g) = highest.split_at(m + 1);
    let reach = highest.iter().copied().max().unwrap_or(0).min(64);
    let [m, n] = [f, g].map(|h| i64::try_from(h.len()).map_or(i64::MAX, |count| count - 1));
    let weighted = |h: &[i64], w: i64| {
        let terms = (0..).zip(h).filter(|&(_, &h)| h >= 0);
        terms.map(|(k, h)| h + w * k).max().unwrap_or(0)
    };
    let bound = |w: i64| n * weighted(f, w) + m * weighted(g, w) - w * m * n;
    (-reach..=reach).map(bound).min().and_then(|bound| usize::try_from(bound).ok()).unwrap_or(0)
}
