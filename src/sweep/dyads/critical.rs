//! The inputs at which a dyad of some assembly may be stretched or folded.

use super::form::{Form, rotation};
use crate::algebra::number::Angle;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::algebra::univariate::Univariate;
use crate::assembly::wrapped;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::dyads::Dyads;
use crate::linkage::laurent::{Laurent, conjugate};
use num_complex::Complex;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Angles are counted from those with one of these half tangents, so that nothing critical is half a turn from there. Any numbers
/// serve that are unlikely to be special; a set of them is shifted by one from unknown to unknown.
const OFFSETS: [(i32, i32); 5] = [(3, 7), (-5, 13), (17, 11), (-8, 3), (2, 9)];
/// Inputs nearer than this are one angle, rounded differently.
const SAME: f64 = 1e-12;

/// A critical input.
#[derive(Clone, Debug)]
pub(super) struct Critical {
    root: RealRoot,
    /// The input: an angle in (-pi, pi], or metres.
    pub value: f64,
    /// The dyad whose polynomial vanishes, and the multiplicity of the root; none where those of several dyads vanish.
    pub dyad: Option<(usize, usize)>,
}

/// All critical inputs of a linkage of dyads.
#[derive(Clone, Debug)]
pub(super) struct Criticals {
    /// The rotation from which input angles are counted; none for displacements.
    from: Option<Gaussian>,
    /// The length of the direction of a displacement.
    length: Rational,
    pub list: Vec<Critical>,
    /// For every dyad those on which its discriminant depends.
    pub needed: Vec<Vec<usize>>,
}

impl Criticals {
    /// Returns the critical inputs; `None` where one of the polynomials vanishes identically or is too large.
    pub fn of(dyads: &Dyads, length: &Rational) -> Option<Self> {
        (0..OFFSETS.len()).find_map(|shift| Self::counted(dyads, length, shift))
    }

    fn counted(dyads: &Dyads, length: &Rational, shift: usize) -> Option<Self> {
        let angle = |k: usize| Some(rotation(OFFSETS[(shift + k) % OFFSETS.len()]));
        let unknowns = (1..=dyads.list.len()).map(angle);
        let from: Vec<Option<Gaussian>> =
            [if dyads.is_turn { angle(0) } else { None }].into_iter().chain(unknowns).collect();
        let mut equations: Vec<Form> = Vec::new();
        let mut polynomials: Vec<Univariate<Integer>> = Vec::new();
        let mut needed: Vec<Vec<usize>> = Vec::new();
        for dyad in &dyads.list {
            let mut form = Form::of(&dyad.discriminant, &from)?;
            let mut own = Vec::new();
            for below in (0..equations.len()).rev() {
                let variable = below + 1;
                if form.degrees[variable] > 0 {
                    form = form.eliminate(&equations[below], variable, &from)?;
                    own.push(below);
                }
            }
            if dyads.is_turn && !form.is_full(0) {
                return None;
            }
            polynomials.push(form.in_input()?);
            needed.push(own);
            let [a, b, c] = &dyad.equation;
            let y = |exponent| Laurent::power(dyad.variable, exponent);
            let whole = a.mul(&y(1)).add(b).add(&c.mul(&y(-1)));
            equations.push(Form::of(&whole, &from)?);
        }
        let all = polynomials.iter().fold(Univariate::one(), |product: Univariate<Integer>, one| product.mul(one));
        let roots = |polynomial: &Univariate<Integer>| {
            if polynomial.degree() > Some(0) { polynomial.real_roots() } else { Vec::new() }
        };
        let of_dyads: Vec<Vec<RealRoot>> = polynomials.iter().map(roots).collect();
        let zero = from[0].as_ref().map_or(0.0, |h| h.im.to_f64().atan2(h.re.to_f64()));
        let critical = |mut root: RealRoot| {
            // No other root of the product is between the bounds.
            let (low, high) = root.bounds();
            let is_here = |one: &&RealRoot| one.compare(&low).is_ge() && one.compare(&high).is_le();
            let found = of_dyads.iter().enumerate().filter_map(|(k, roots)| Some((k, roots.iter().find(is_here)?)));
            let found: Vec<(usize, usize)> = found.map(|(k, root)| (k, root.multiplicity())).collect();
            let x = root.to_f64();
            let value = if dyads.is_turn { wrapped(zero + 2.0 * x.atan()) } else { x * length.to_f64() };
            Critical { root, value, dyad: if let [one] = found.as_slice() { Some(*one) } else { None } }
        };
        let list = roots(&all).into_iter().map(critical).collect();
        Some(Self { from: from[0].clone(), length: length.clone(), list, needed })
    }

    /// The half tangent or displacement of an input; `None` half a turn from where angles are counted.
    fn place(&self, input: f64) -> Option<Rational> {
        let Some(from) = &self.from else { return Some(Rational::from_f64(input)? / &self.length) };
        let (re, im) = exact_cos_sin(&Angle::from_radians(input));
        let turn = Ring::mul(&Complex { re, im }, &conjugate(from));
        let below = turn.re + 1;
        (below != 0).then(|| turn.im / below)
    }

    /// Returns the critical inputs between two inputs that are less than half a turn apart; `None` where one of these is critical.
    pub fn between(&self, from: f64, to: f64) -> Option<Vec<usize>> {
        let (a, b) = if from < to { (from, to) } else { (to, from) };
        let (low, high) = (self.place(a)?, self.place(b)?);
        let is_same = b - a < SAME;
        let (low, high) = if is_same && high < low { (high, low) } else { (low, high) };
        let is_round = self.from.is_some() && high < low;
        let mut inside = Vec::new();
        for (index, critical) in self.list.iter().enumerate() {
            let [first, second] = [&low, &high].map(|x| critical.root.compare(x));
            let is_inside = match (first, second) {
                (Ordering::Equal, _) | (_, Ordering::Equal) => return None,
                (Ordering::Greater, Ordering::Less) => true,
                (Ordering::Greater, _) | (_, Ordering::Less) => is_round,
                (Ordering::Less, Ordering::Greater) => false,
            };
            if is_inside {
                inside.push(index);
            }
        }
        Some(inside)
    }
}
