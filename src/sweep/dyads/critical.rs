//! The inputs at which a dyad of some assembly may be stretched or folded.

use super::form::Form;
use crate::algebra::number::nearest_f64;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::assembly::wrapped;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Angles are counted from those with one of these half tangents, so that nothing critical is half a turn from there. Any numbers
/// serve that are unlikely to be special; a set of them is shifted by one from unknown to unknown.
const OFFSETS: [(i32, i32); 5] = [(3, 7), (-5, 13), (17, 11), (-8, 3), (2, 9)];
/// Inputs nearer than this are one angle, rounded differently.
const SAME: f64 = 1e-12;

/// How an input or an unknown is counted.
#[derive(Clone, Debug)]
pub(super) enum Count {
    /// The tangent of half the angle, counted from another angle, over the length of an axis; that of this other angle, the square
    /// of the length, and what the tangent of an input over the length is.
    Angle { from: Rational, square: Rational, read: Reading },
    /// The displacement in parts of this length.
    Displacement(Rational),
}

/// The tangent of half an angle in radians over the length of an axis whose square is given; `None` for half a turn.
pub(super) type Reading = fn(f64, &Rational) -> Option<Rational>;

/// The polynomials of dyads, counted somehow.
pub(super) trait Counted {
    /// What the samples of the sweep take an input for.
    const READING: Reading;

    /// For the input, then for every dyad the square of the length of the axis about which its unknown turns; none for a displacement.
    fn squares(&self) -> Vec<Option<Rational>>;

    /// The length of the direction of the input, 1 of angles.
    fn length(&self) -> Rational;

    /// For every dyad its discriminant and its equation.
    fn forms(&self, counts: &[Count]) -> Option<Vec<[Form; 2]>>;
}

impl Count {
    /// The input that is counted so: an angle in (-pi, pi], or metres.
    fn value(&self, x: f64) -> f64 {
        match self {
            Self::Angle { from, square, .. } => {
                let length = nearest_f64(square).sqrt();
                wrapped(2.0 * (length * nearest_f64(from)).atan() + 2.0 * (length * x).atan())
            }
            Self::Displacement(length) => x * length.to_f64(),
        }
    }

    /// How an input is counted; `None` half a turn from where angles are counted.
    fn place(&self, input: f64) -> Option<Rational> {
        match self {
            Self::Angle { from, square, read } => {
                let weighted = Rational::from(from * square);
                let Some(x) = read(input, square) else { return Some(weighted.recip()) };
                let below = Rational::from(&weighted * &x) + 1;
                (below != 0).then(|| (x - from) / below)
            }
            Self::Displacement(length) => Some(Rational::from_f64(input)? / length),
        }
    }
}

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
    /// How the input is counted.
    input: Count,
    pub list: Vec<Critical>,
    /// For every dyad those on which its discriminant depends.
    pub needed: Vec<Vec<usize>>,
}

impl Criticals {
    /// Returns the critical inputs; `None` where one of the polynomials vanishes identically or is too large.
    pub fn of<D: Counted>(dyads: &D) -> Option<Self> {
        (0..OFFSETS.len()).find_map(|shift| Self::counted(dyads, shift))
    }

    fn counted<D: Counted>(dyads: &D, shift: usize) -> Option<Self> {
        let count = |(k, square): (usize, Option<Rational>)| match square {
            Some(square) => {
                let from = Rational::from(OFFSETS[(shift + k) % OFFSETS.len()]);
                Count::Angle { from, square, read: D::READING }
            }
            None => Count::Displacement(dyads.length()),
        };
        let counts: Vec<Count> = dyads.squares().into_iter().enumerate().map(count).collect();
        let is_turn = matches!(counts.first(), Some(Count::Angle { .. }));
        let mut equations: Vec<Form> = Vec::new();
        let mut polynomials: Vec<Univariate<Integer>> = Vec::new();
        let mut needed: Vec<Vec<usize>> = Vec::new();
        for [discriminant, equation] in dyads.forms(&counts)? {
            let mut form = discriminant;
            let mut own = Vec::new();
            for below in (0..equations.len()).rev() {
                let variable = below + 1;
                if form.degrees[variable] > 0 {
                    form = form.eliminate(&equations[below], variable, &counts)?;
                    own.push(below);
                }
            }
            if is_turn && !form.is_full(0) {
                return None;
            }
            polynomials.push(form.in_input()?);
            needed.push(own);
            equations.push(equation);
        }
        let all = polynomials.iter().fold(Univariate::one(), |product: Univariate<Integer>, one| product.mul(one));
        let roots = |polynomial: &Univariate<Integer>| {
            if polynomial.degree() > Some(0) { polynomial.real_roots() } else { Vec::new() }
        };
        let of_dyads: Vec<Vec<RealRoot>> = polynomials.iter().map(roots).collect();
        let input = counts.first()?.clone();
        let critical = |mut root: RealRoot| {
            // No other root of the product is between the bounds.
            let (low, high) = root.bounds();
            let is_here = |one: &&RealRoot| one.compare(&low).is_ge() && one.compare(&high).is_le();
            let found = of_dyads.iter().enumerate().filter_map(|(k, roots)| Some((k, roots.iter().find(is_here)?)));
            let found: Vec<(usize, usize)> = found.map(|(k, root)| (k, root.multiplicity())).collect();
            let value = input.value(root.to_f64());
            Critical { root, value, dyad: if let [one] = found.as_slice() { Some(*one) } else { None } }
        };
        let list = roots(&all).into_iter().map(critical).collect();
        Some(Self { input, list, needed })
    }

    /// Whether the input is an angle.
    pub fn is_turn(&self) -> bool {
        matches!(self.input, Count::Angle { .. })
    }

    /// Returns the critical inputs between two inputs that are less than half a turn apart; `None` where one of these is critical.
    pub fn between(&self, from: f64, to: f64) -> Option<Vec<usize>> {
        let (a, b) = if from < to { (from, to) } else { (to, from) };
        let (low, high) = (self.input.place(a)?, self.input.place(b)?);
        // Nearly one angle: which of two rounded inputs comes first is not known. Their half tangents are close together, or they lie
        // on both sides of infinity.
        let is_same = self.is_turn() && b - a < SAME;
        let is_close = Rational::from(&high - &low).abs() <= 1;
        let (low, high) = if is_same && (high < low) == is_close { (high, low) } else { (low, high) };
        let is_round = self.is_turn() && high < low;
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
