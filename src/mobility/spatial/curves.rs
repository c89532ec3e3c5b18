//! Curves of single loops, and when they are the same.

use super::loops::{Solver, System};
use rug::Rational;

/// Series are not followed beyond this order.
const HIGHEST: usize = 100;

/// What is known of the curves of all loops.
pub(super) enum Agreement {
    /// All variables that loops share have the same series to an order beyond the bound. The joints of these variables.
    Proved { order: usize, bound: usize, joints: Vec<usize> },
    /// They differ.
    Fails,
    /// Some loop does not move along one curve by itself, or no bound is known.
    Unknown,
}

/// A loop that moves along one curve by itself, with the series of its variables in a given one of them.
struct Curve {
    used: Vec<usize>,
    values: Vec<Vec<Rational>>,
}

/// Returns the curve of a loop through the configuration by one of its variables, where the loop is regular and that variable
/// moves.
fn curve(system: &System, parameter: usize, order: usize) -> Option<Curve> {
    let used = system.used();
    let mut columns: Vec<usize> = used.iter().copied().filter(|k| *k != parameter).collect();
    if columns.len() == used.len() {
        return None;
    }
    columns.push(parameter);
    let solver = Solver::of(system, &columns);
    let is_regular = solver.rank() == system.conditions && used.len() == solver.rank() + 1;
    let (free, motion) = solver.free.first().filter(|_| is_regular)?;
    let values = (*free == parameter).then(|| solver.follow(motion, order).ok())??;
    Some(Curve { used, values })
}

/// Decides whether the loops move along one curve together.
pub(super) fn agree(system: &System, most: &dyn Fn(&System) -> Option<usize>) -> Agreement {
    let loops: Vec<System> = (0..system.loops.len()).map(|k| system.only(k)).collect();
    let Some(counts) = loops.iter().map(most).collect::<Option<Vec<usize>>>() else { return Agreement::Unknown };
    let most = counts.iter().copied().max().unwrap_or(0);
    let (bound, order) = (2 * most * most, 2 * most * most + 1);
    if order > HIGHEST {
        return Agreement::Unknown;
    }
    let used: Vec<Vec<usize>> = loops.iter().map(System::used).collect();
    let of = |k: usize| used.iter().filter(|used| used.contains(&k)).count();
    let everywhere = |k: &usize| system.variables[*k].is_single && of(*k) == loops.len();
    for parameter in (0..system.variables.len()).filter(everywhere) {
        let curves: Option<Vec<Curve>> = loops.iter().map(|own| curve(own, parameter, order)).collect();
        let Some(curves) = curves else { continue };
        let shared: Vec<usize> = (0..system.variables.len()).filter(|k| of(*k) > 1).collect();
        // Of a joint of several variables in several loops each has to be counted by itself; such joints are left out.
        if shared.iter().any(|k| !system.variables[*k].is_single) {
            return Agreement::Unknown;
        }
        let is_same = shared.iter().all(|k| {
            let mut found = curves.iter().filter(|curve| curve.used.contains(k)).map(|curve| &curve.values[*k]);
            let first = found.next();
            found.all(|other| Some(other) == first)
        });
        if !is_same {
            return Agreement::Fails;
        }
        let joints = shared.into_iter().map(|k| system.variables[k].joint).collect();
        return Agreement::Proved { order, bound, joints };
    }
    Agreement::Unknown
}

/// Returns the pairs of shafts whose half-angle tangents from the configuration are equal or opposite along the curve of a loop that
/// holds both, with whether they are opposite.
pub(super) fn shafts(
    system: &System,
    most: &dyn Fn(&System) -> Option<usize>,
    is_shaft: &dyn Fn(usize) -> bool,
) -> Vec<([usize; 2], bool)> {
    let mut found: Vec<([usize; 2], bool)> = Vec::new();
    for k in 0..system.loops.len() {
        let own = system.only(k);
        let Some(most) = most(&own) else { continue };
        let mut list = own.used();
        list.retain(|variable| is_shaft(own.variables[*variable].joint));
        let [a, b] = list[..] else { continue };
        let joints = [a, b].map(|variable| own.variables[variable].joint);
        if found.iter().any(|(other, _)| *other == joints) {
            continue;
        }
        // The angles are equal where u = f v, f being the ratio of the lengths of the axes as they are written. A curve of rational
        // series is never that of an irrational f.
        let Some(factor) = ratio(&own.variables[b].square, &own.variables[a].square) else { continue };
        // A curve of degree `most` in either variable meets another line u = f v or u = -f v in twice as many points at most.
        let Some(curve) = curve(&own, a, 2 * most + 1) else { continue };
        let (first, second) = (&curve.values[a], &curve.values[b]);
        let pairs = || first.iter().zip(second).map(|(x, y)| (x, Rational::from(y * &factor)));
        let is_same = pairs().all(|(x, y)| *x == y);
        let is_opposite = pairs().all(|(x, y)| *x == -y);
        if is_same || is_opposite {
            found.push((joints, is_opposite));
        }
    }
    found
}

/// Returns the square root of the ratio of two squares; `None` where it is irrational.
fn ratio(square: &Rational, other: &Rational) -> Option<Rational> {
    if *other == 0 {
        return None;
    }
    let (numerator, denominator) = Rational::from(square / other).into_numer_denom();
    let is_square = numerator.is_perfect_square() && denominator.is_perfect_square();
    is_square.then(|| Rational::from((numerator.sqrt(), denominator.sqrt())))
}
