//! The unknowns of a loop as variables of polynomials.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::algebra::trigonometric::{Pair, half_tangents};
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use rug::Rational;

/// Cosine, sine and half-angle tangent of every unknown rotation, every unknown translation, in loop order.
#[derive(Clone, Debug)]
pub(super) struct Symbols {
    kinds: Vec<Variable>,
    labels: Vec<String>,
}

impl Symbols {
    /// Names the unknowns by the numbers of their joints: `c3`, `s3` and `t3`, or `d3`.
    pub fn of(chain: &Chain, layout: &Layout, kinds: [Variable; 6]) -> Self {
        let total = layout.variables.len();
        let joints = joint_labels(chain);
        let first = layout.locked.map_or(0, |locked| locked + 1);
        let labels = (0..6).map(|k| joints.get((first + k) % total.max(1)).cloned().unwrap_or_default());
        Self { kinds: kinds.to_vec(), labels: labels.collect() }
    }

    /// Creates a single unknown, given by its index among the joint variables.
    pub fn single(chain: &Chain, index: usize, kind: Variable) -> Self {
        Self { kinds: vec![kind], labels: vec![joint_labels(chain).get(index).cloned().unwrap_or_default()] }
    }

    /// Returns the number of the joint of an unknown, for a U or S joint with that of the rotation.
    pub fn label(&self, unknown: usize) -> &str {
        &self.labels[unknown % self.labels.len()]
    }

    /// Creates rotations only, one for each label.
    pub fn rotations(labels: Vec<String>) -> Self {
        Self { kinds: vec![Variable::Rotation; labels.len()], labels }
    }

    /// Creates any list of variables.
    pub fn variables(labels: Vec<String>, kinds: impl Iterator<Item = Variable>) -> Self {
        Self { kinds: kinds.collect(), labels }
    }

    /// Returns the number of unknowns; each has three variables.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// Returns the names of all variables.
    pub fn names(&self) -> Result<Names> {
        Ok(Names::given(self.list())?)
    }

    /// Returns the names of cosine, sine and half-angle tangent of each unknown rotation. A translation has neither cosine nor
    /// sine; it gets names there that its own joint's rotation does not have.
    pub fn list(&self) -> Vec<String> {
        let of_one = |(kind, label): (&Variable, &String)| match kind {
            Variable::Rotation => ["c", "s", "t"].map(|letter| format!("{letter}{label}")),
            Variable::Translation => [format!("c{label}_0"), format!("s{label}_0"), format!("d{label}")],
        };
        self.kinds.iter().zip(&self.labels).flat_map(of_one).collect()
    }

    /// Returns the variable of the half-angle tangent or of the distance.
    pub fn variable(unknown: usize) -> usize {
        3 * (unknown % 6) + 2
    }

    /// Returns the name of that variable.
    pub fn name(&self, unknown: usize) -> String {
        name(self.label(unknown), self.kinds[unknown % self.kinds.len()])
    }

    /// Returns the half-angle tangent or the distance of an unknown, or of its negative.
    pub fn tangent(unknown: usize, negated: bool) -> Polynomial<Rational> {
        let variable = Polynomial::variable(Self::variable(unknown));
        if negated { variable.neg() } else { variable }
    }

    /// Returns `(1, cos, sin)` or `(1, d, d^2)` of an unknown, or of its negative.
    pub fn monomials(&self, unknown: usize, negated: bool) -> [Polynomial<Rational>; 3] {
        let k = unknown % 6;
        let signed = |p: Polynomial<Rational>| if negated { p.neg() } else { p };
        match self.kinds[k] {
            Variable::Rotation => [Ring::one(), Polynomial::variable(3 * k), signed(Polynomial::variable(3 * k + 1))],
            Variable::Translation => {
                let d = Polynomial::variable(3 * k + 2);
                [Ring::one(), signed(d.clone()), d.mul(&d)]
            }
        }
    }
}

/// Substitutes half-angle tangents for cosines and sines in a polynomial, and multiplies by the powers of `1 + t^2` that
/// this requires.
pub(super) fn half_angles(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    let used = |k: &usize| polynomial.degree(3 * k) > 0 || polynomial.degree(3 * k + 1) > 0;
    let pairs: Vec<(Pair, usize)> =
        (0..6).filter(used).map(|k| (Pair { cos: 3 * k, sin: 3 * k + 1 }, 3 * k + 2)).collect();
    half_tangents(polynomial, &pairs).polynomial
}

/// Returns the name of the half-angle tangent or of the distance of a joint.
pub(super) fn name(label: &str, kind: Variable) -> String {
    let letter = if kind == Variable::Rotation { 't' } else { 'd' };
    format!("{letter}{label}")
}

/// Returns the name of the half-angle tangent or of the distance of a joint variable, given by its index.
pub(crate) fn variable_name(chain: &Chain, index: usize) -> Option<String> {
    joint_variables(chain).get(index).map(|(label, kind)| name(label, *kind))
}

/// Returns for each joint variable the number of its joint, for a U or S joint with that of the rotation, and its kind.
pub(super) fn joint_variables(chain: &Chain) -> Vec<(String, Variable)> {
    chain.variables().into_iter().map(|variable| (variable.number(), variable.variable)).collect()
}

/// Returns for each joint variable the number of its joint; the rotations of a U or S joint are distinguished.
pub(super) fn joint_labels(chain: &Chain) -> Vec<String> {
    joint_variables(chain).into_iter().map(|(label, _)| label).collect()
}

/// Returns `sum coefficient * monomial`.
pub(super) fn combination<'a>(
    terms: impl IntoIterator<Item = (&'a Rational, &'a Polynomial<Rational>)>,
) -> Polynomial<Rational> {
    terms.into_iter().fold(
        Polynomial::zero(),
        |sum, (c, monomial)| {
            if c.is_zero() { sum } else { sum.add(&monomial.scale(c)) }
        },
    )
}

/// Returns `sum form[i][j] rows[i] columns[j]`.
pub(super) fn bilinear_form(
    form: &[[Rational; 3]; 3],
    rows: &[Polynomial<Rational>; 3],
    columns: &[Polynomial<Rational>; 3],
) -> Polynomial<Rational> {
    (0..3).fold(Polynomial::zero(), |sum, i| sum.add(&rows[i].mul(&combination(form[i].iter().zip(columns)))))
}
