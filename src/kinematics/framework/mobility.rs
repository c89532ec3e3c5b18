//! The mobility of a framework: what can be proved, and what is computed in f64 only.

use super::Framework;
use super::cycle::stands_still;
use super::flex::{Flex, flex, settled};
use super::octahedron::{Diagonal, Octahedron};
use super::order::{Order, order};
use super::parts::parts;
use super::planes::on_planes;
use super::slice::{Slice, moving_slice};
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use rug::Rational;

/// Solutions of a generic octahedron with one face fixed, hence the greatest multiplicity of an isolated realisation.
const OCTAHEDRON: usize = 16;
/// Real and complex poses of a Stewart platform of general geometry, hence the greatest multiplicity for two bodies with six
/// rods.
const PLATFORM: usize = 40;
/// Largest order tried where no bound is known.
const ORDERS: usize = 16;
/// Frameworks with more coordinates of free vertices are not expanded in power series over the rationals.
const SERIES_COORDINATES: usize = 36;

/// The verdict on the motions of a framework.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No motion near the given realisation.
    Rigid,
    /// A motion near the given realisation.
    Mobile,
    /// First-order motions, but no motion: infinitesimally mobile only.
    Shaky(usize),
}

/// The proof of a verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Proof {
    /// The rigidity matrix has full rank, over the rationals.
    Rank,
    /// A linear slice with fewer conditions than dimensions.
    Slice(Slice),
    /// The closure of the ring about a diagonal of an octahedron, an identity in the square of the length of that diagonal.
    Octahedron([usize; 2]),
    /// A framework on two perpendicular planes with bars from one to the other, which moves in at least this many dimensions.
    Planes(usize),
    /// No diagonal of an octahedron can change.
    NoDiagonal,
    /// Octahedra that move about one edge, and bars: the edge first, then the vertices of each part.
    Parts(Vec<Vec<usize>>),
    /// Two octahedra and a bar about a pair of vertices whose distances cannot change.
    Cycle,
    /// The lengths cannot be kept in this order.
    Order(usize),
    /// All lengths are kept through this order, which is greater than the multiplicity of any isolated realisation; the second
    /// number bounds that multiplicity.
    Series(usize, usize),
    /// No proof: computed in f64 only, with lengths kept through this order where the order is known.
    None(Option<usize>),
}

/// The mobility of a framework.
#[derive(Clone, Debug)]
pub struct Mobility {
    /// The verdict.
    pub verdict: Verdict,
    /// The proof of the verdict.
    pub proof: Proof,
    /// Number of free vertices, of bars, and `3 v - 6 - bars`, Maxwell's count.
    pub count: (usize, usize, isize),
    /// Rank of the rigidity matrix.
    pub rank: usize,
    /// First-order motions that keep all lengths, without those of the whole.
    pub infinitesimal: usize,
    /// The motion followed in f64, if there is one.
    pub flex: Option<Flex>,
}

impl Mobility {
    /// Returns the least and greatest dimension of the motions that the verdict leaves.
    #[must_use]
    pub fn freedom(&self) -> (usize, usize) {
        match (&self.verdict, &self.proof) {
            (Verdict::Rigid | Verdict::Shaky(_), _) => (0, 0),
            (Verdict::Mobile, Proof::Slice(slice)) => (slice.mobility(), self.infinitesimal),
            (Verdict::Mobile, Proof::Planes(least)) => (*least, self.infinitesimal),
            (Verdict::Mobile, _) => (1, self.infinitesimal.max(1)),
        }
    }

    /// Whether the verdict is proved.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        !matches!(self.proof, Proof::None(_))
    }
}

/// The mobility of a framework at an exact realisation.
///
/// # Shape
/// `steps`: number of steps for which the motion is followed.
#[must_use]
pub fn mobility(framework: &Framework<Rational>, steps: usize) -> Option<Mobility> {
    let float = framework.map(|q| Some(nearest_f64(q)))?;
    let exact = framework.squares();
    let (rank, rigid) = full_rank(framework).unwrap_or_else(|| framework.ranks());
    let infinitesimal = framework.coordinates() - rank - rigid;
    let squares: Vec<f64> = exact.iter().map(nearest_f64).collect();
    let mut found = begin(&float, rank, infinitesimal);
    if infinitesimal == 0 {
        return Some(found);
    }
    found.flex = flex(&float, &squares, steps);
    let octahedron = Octahedron::of(&float, &exact);
    (found.verdict, found.proof) = if let Some(slice) = moving_slice(framework) {
        (Verdict::Mobile, Proof::Slice(slice))
    } else if let Some(least) = on_planes(framework) {
        (Verdict::Mobile, Proof::Planes(least))
    } else if let Some(proved) = octahedron.as_ref().and_then(|o| of_octahedron(o, &float)) {
        proved
    } else if let Some(parts) = parts(&float, &exact, Some(framework)) {
        (Verdict::Mobile, Proof::Parts(parts))
    } else {
        of_series(framework, octahedron.is_some(), found.flex.as_ref())
    };
    if let (Proof::NoDiagonal, Some(Order::Stops(m))) = (&found.proof, order(framework, ORDERS)) {
        found.verdict = Verdict::Shaky(m);
    }
    Some(found)
}

/// The mobility of a framework with given lengths near an approximate realisation; `None` where Newton's method finds no
/// realisation with these lengths.
///
/// # Shape
/// A square for every bar. `is_exact` says whether they are exact; otherwise nothing is proved.
#[must_use]
pub fn mobility_with_lengths(
    start: &Framework<f64>,
    exact: &[Rational],
    is_exact: bool,
    steps: usize,
) -> Option<Mobility> {
    let squares: Vec<f64> = exact.iter().map(nearest_f64).collect();
    let Some(here) = settled(start, &squares) else {
        return if is_exact { by_lengths(start, exact) } else { None };
    };
    let (rank, rigid) = here.ranks();
    let infinitesimal = here.coordinates() - rank - rigid;
    let mut found = begin(&here, rank, infinitesimal);
    found.proof = Proof::None(None);
    if infinitesimal > 0 {
        found.flex = flex(&here, &squares, steps);
        found.verdict = seen(found.flex.as_ref());
    }
    if !is_exact {
        return Some(found);
    }
    let proved = match Octahedron::of(&here, exact) {
        Some(octahedron) => of_octahedron(&octahedron, &here),
        None => match parts(&here, exact, None) {
            Some(parts) => Some((Verdict::Mobile, Proof::Parts(parts))),
            None => stands_still(&here, exact).then_some((Verdict::Rigid, Proof::Cycle)),
        },
    };
    if let Some((verdict, proof)) = proved {
        (found.verdict, found.proof) = (verdict, proof);
    }
    Some(found)
}

/// Returns the verdict that the lengths of an octahedron alone prove: no realisation moves, if there is any.
fn by_lengths(start: &Framework<f64>, squares: &[Rational]) -> Option<Mobility> {
    let octahedron = Octahedron::of(start, squares)?;
    if (0..3).any(|axis| octahedron.closure(axis).is_zero()) {
        return None;
    }
    let (rank, rigid) = start.ranks();
    let infinitesimal = start.coordinates().saturating_sub(rank + rigid);
    Some(Mobility { proof: Proof::NoDiagonal, ..begin(start, rank, infinitesimal) })
}

fn begin(framework: &Framework<f64>, rank: usize, infinitesimal: usize) -> Mobility {
    let (vertices, bars) = (framework.free.len(), framework.bars.len());
    let maxwell = (3 * vertices).cast_signed() - 6 - bars.cast_signed();
    let (verdict, proof) = (Verdict::Rigid, Proof::Rank);
    Mobility { verdict, proof, count: (vertices, bars, maxwell), rank, infinitesimal, flex: None }
}

/// Returns the ranks of a framework without first-order motions: full modulo a prime, hence full over the rationals.
fn full_rank(framework: &Framework<Rational>) -> Option<(usize, usize)> {
    let image = framework.map(ModP::<PRIME_61>::from_rational)?;
    let (rank, rigid) = image.ranks();
    (rigid == 6 && rank + rigid == framework.coordinates()).then_some((rank, rigid))
}

/// Returns the verdict that the rings about the diagonals of an octahedron prove.
fn of_octahedron(octahedron: &Octahedron, realisation: &Framework<f64>) -> Option<(Verdict, Proof)> {
    let pair = |axis: usize| [octahedron.vertices[axis], octahedron.vertices[axis + 3]];
    let diagonals: Vec<Diagonal> = (0..3).map(|axis| octahedron.diagonal(axis, realisation)).collect();
    if let Some(axis) = diagonals.iter().position(|diagonal| *diagonal == Diagonal::Moves) {
        return Some((Verdict::Mobile, Proof::Octahedron(pair(axis))));
    }
    diagonals.iter().all(|diagonal| *diagonal == Diagonal::Fixed).then_some((Verdict::Rigid, Proof::NoDiagonal))
}

/// Returns the verdict of the power series, with the motion in f64 where they leave it open.
fn of_series(framework: &Framework<Rational>, is_octahedron: bool, flex: Option<&Flex>) -> (Verdict, Proof) {
    let bound = if is_octahedron { Some(OCTAHEDRON) } else { is_platform(framework).then_some(PLATFORM) };
    if framework.coordinates() > SERIES_COORDINATES {
        return (seen(flex), Proof::None(None));
    }
    match (order(framework, bound.map_or(ORDERS, |bound| bound + 1)), bound) {
        (Some(Order::Stops(m)), _) => (Verdict::Shaky(m), Proof::Order(m)),
        (Some(Order::Reaches(n)), Some(bound)) => (Verdict::Mobile, Proof::Series(n, bound)),
        (Some(Order::Reaches(n)), None) => (seen(flex), Proof::None(Some(n))),
        (None, _) => (seen(flex), Proof::None(None)),
    }
}

fn seen(flex: Option<&Flex>) -> Verdict {
    match flex {
        Some(flex) if flex.positions.len() > 1 && flex.change > 1e-3 => Verdict::Mobile,
        _ => Verdict::Rigid,
    }
}

/// Whether the framework is two bodies joined by six rods, each body held by just as many bars as it needs.
fn is_platform(framework: &Framework<Rational>) -> bool {
    let inside = framework.bars.len() - framework.given_bars;
    framework.bodies == 2 && framework.given_bars == 6 && inside + 6 + 6 == framework.coordinates()
}
