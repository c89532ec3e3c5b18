//! Combinations of values that close a loop: the first three unknowns from one side, the others from the other side.

use super::missing::{Rest, rest};
use super::rough::Rough;
use super::values::{Pair, Value};
use crate::algebra::ball::Ball;
use crate::algebra::sort;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use std::cell::OnceCell;

/// Largest number of combinations on one side of a loop: 16 values of each of three unknowns.
const MOST: usize = 16 * 16 * 16;
/// Number of motions of a side from which the coordinate that separates them best is chosen.
const SAMPLE: usize = 256;

/// A combination: the index of the value of each unknown.
pub type Tuple = [usize; 6];

/// A motion of one side of a loop, roughly.
struct Side {
    choice: [usize; 3],
    motion: Motion<Rough>,
}

/// The motions `V1 G1 V2 G2 V3 G3` for all combinations of values of three unknowns.
struct Sides<const BITS: u32> {
    steps: [Vec<Motion<Ball<BITS>>>; 3],
    all: Vec<Side>,
}

/// A combination of values that may close a loop, with the unknowns that it leaves.
#[derive(Clone, Debug)]
pub struct Closing<const BITS: u32> {
    /// The index of the value of each unknown; 0 for those without values.
    pub tuple: Tuple,
    /// The unknowns without values, in loop order.
    pub rest: Vec<Pair<BITS>>,
}

/// Returns all combinations of values for which balls do not prove that the loop stays open; `None` where there are too many
/// combinations, and where one of them may belong to several solutions. `values[j]` lists the values of unknown j, a rotation; up
/// to three unknowns have none, all of them rotations or all of them translations.
#[must_use]
pub fn closing_tuples<const BITS: u32>(
    variables: [Variable; 6],
    constants: &[Motion<Ball<BITS>>],
    values: &[Option<Vec<&Value<BITS>>>; 6],
) -> Option<Vec<Closing<BITS>>> {
    let missing: Vec<Variable> = (0..6).filter(|&j| values[j].is_none()).map(|j| variables[j]).collect();
    let kind = missing.first().copied().unwrap_or(Variable::Rotation);
    if missing.iter().any(|own| *own != kind) {
        return None;
    }
    match values {
        [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] => {
            let found = from_both_sides(constants, [a, b, c, d, e, f])?;
            Some(found.into_iter().map(|tuple| Closing { tuple, rest: Vec::new() }).collect())
        }
        _ if missing.len() == 1 => with_one_left(kind, constants, values),
        _ => with_rest(kind, constants, values),
    }
}

/// Returns combinations of five unknowns by an invariant of the sixth one that both sides of the loop determine: the axis of a
/// rotation, the frame's directions of a translation.
fn with_one_left<const BITS: u32>(
    kind: Variable,
    constants: &[Motion<Ball<BITS>>],
    values: &[Option<Vec<&Value<BITS>>>; 6],
) -> Option<Vec<Closing<BITS>>> {
    let missing = values.iter().position(Option::is_none)?;
    // The loop is read from behind the missing unknown, which is the last one then.
    let place = |k: usize| (missing + 1 + k) % 6;
    let lists: Vec<&[&Value<BITS>]> = (0..5).map(|k| values[place(k)].as_deref()).collect::<Option<_>>()?;
    let near = Sides::of([0, 1, 2].map(|k| &constants[place(k)]), [lists[0], lists[1], lists[2]])?;
    let mut found = Vec::new();
    let last = &constants[missing];
    let rough_last = rough(last);
    // near far V G = I with the missing V, which keeps the compared invariant: for a rotation far z = near^-1 G^-1 z.
    let seen: Vec<_> = near.all.iter().map(|side| kept(kind, &rough_last.then_after(&side.motion).inverse())).collect();
    for (i, fourth) in lists[3].iter().enumerate() {
        for (j, fifth) in lists[4].iter().enumerate() {
            let far = step(&fourth.pair, &constants[place(3)]).then_after(&step(&fifth.pair, &constants[place(4)]));
            let own = kept(kind, &rough(&far));
            for (side, _) in near.all.iter().zip(&seen).filter(|(_, other)| may_meet(&own, other)) {
                let whole = last.then_after(&near.motion(side.choice)).then_after(&far);
                let rest = match rest(kind, &[whole]) {
                    Rest::Open => continue,
                    Rest::Undetermined => return None,
                    Rest::Unique(rest) => rest,
                };
                let mut tuple = [0; 6];
                for (k, own) in [side.choice[0], side.choice[1], side.choice[2], i, j].into_iter().enumerate() {
                    tuple[place(k)] = own;
                }
                found.push(Closing { tuple, rest });
            }
        }
    }
    Some(found)
}

/// Returns the invariant of a motion under an unknown behind it: direction and origin of the z axis, or two of the directions.
fn kept(kind: Variable, motion: &Motion<Rough>) -> [Rough; 6] {
    let [a, b, c] = [0, 1, 2].map(|i| motion.rotation[i][2]);
    let [x, y, z] = match kind {
        Variable::Rotation => motion.translation,
        Variable::Translation => [0, 1, 2].map(|i| motion.rotation[i][0]),
    };
    [a, b, c, x, y, z]
}

/// Combinations of all six unknowns.
fn from_both_sides<const BITS: u32>(
    constants: &[Motion<Ball<BITS>>],
    values: [&Vec<&Value<BITS>>; 6],
) -> Option<Vec<Tuple>> {
    let [near, far] = [0, 3].map(|first| {
        let steps = [0, 1, 2].map(|k| values[first + k].as_slice());
        Sides::of([&constants[first], &constants[first + 1], &constants[first + 2]], steps)
    });
    let (near, far) = (near?, far?);
    let one: Vec<[Rough; 12]> = near.all.iter().map(|side| entries(&side.motion)).collect();
    let two: Vec<[Rough; 12]> = far.all.iter().map(|side| entries(&side.motion.inverse())).collect();
    // For crowded values many motions are requested again and again.
    let cells = |count: usize| -> Vec<OnceCell<Motion<Ball<BITS>>>> { vec![OnceCell::new(); count] };
    let (left, right) = (cells(one.len()), cells(two.len()));
    let before = |i: usize| left[i].get_or_init(|| near.motion(near.all[i].choice));
    let behind = |j: usize| right[j].get_or_init(|| far.motion(far.all[j].choice).inverse());
    let mut found = Vec::new();
    let mut close = |i: usize, j: usize| {
        if overlap(before(i), behind(j)) {
            let (a, b) = (near.all[i].choice, far.all[j].choice);
            found.push([a[0], a[1], a[2], b[0], b[1], b[2]]);
        }
    };
    let mut pairs = Vec::new();
    let most = one.len() + two.len();
    let are_few = meeting(&one, &two, |i, j| {
        pairs.push((i, j));
        pairs.len() <= most
    });
    if are_few {
        for (i, j) in pairs {
            close(i, j);
        }
    } else {
        // Discs around the balls are narrower.
        let one: Vec<[Rough; 12]> = (0..one.len()).map(|i| entries(&rough(before(i)))).collect();
        let two: Vec<[Rough; 12]> = (0..two.len()).map(|j| entries(&rough(behind(j)))).collect();
        meeting(&one, &two, |i, j| {
            close(i, j);
            true
        });
    }
    Some(found)
}

/// Visits the pairs of one list and another that may be equal, in the order of the first list, while `visit` returns true.
/// Returns whether it reached the end.
fn meeting(one: &[[Rough; 12]], two: &[[Rough; 12]], mut visit: impl FnMut(usize, usize) -> bool) -> bool {
    // In the order of the coordinate that separates most of them, those that may meet are neighbours.
    let tells = |k: &usize| distinct(two, *k);
    let Some(number) = (0..24).max_by_key(tells) else { return true };
    let own = |entries: &[Rough; 12]| part(entries, number);
    let mut radii: Vec<f64> = two.iter().map(|entries| own(entries).1).collect();
    radii.sort_by(f64::total_cmp);
    // The few with larger radii, and what overflowed, are compared with all.
    let Some(&widest) = radii.get(radii.len().saturating_sub(1 + radii.len() / 20)) else { return true };
    let is_narrow = |j: &usize| own(&two[*j]).0.is_finite() && own(&two[*j]).1 <= widest;
    let (mut narrow, wide): (Vec<usize>, Vec<usize>) = (0..two.len()).partition(is_narrow);
    sort::by(&mut narrow, |&i, &j| own(&two[i]).0.total_cmp(&own(&two[j]).0));
    for (i, entries) in one.iter().enumerate() {
        let (x, radius) = own(entries);
        let reach = (radius + widest) * (1.0 + 1e-14) + x.abs() * 4.0 * f64::EPSILON;
        // NaN counts as possibly equal.
        let first = narrow.partition_point(|&j| own(&two[j]).0 < x - reach);
        let near = narrow[first..].iter().take_while(|&&j| !(own(&two[j]).0 > x + reach));
        let mut open = near.chain(&wide).filter(|&&j| may_meet(entries, &two[j]));
        if !open.all(|&j| visit(i, j)) {
            return false;
        }
    }
    true
}

/// Real or imaginary part of an entry, and its radius.
fn part(entries: &[Rough; 12], number: usize) -> (f64, f64) {
    let Rough { re, im, radius } = entries[number / 2];
    (if number.is_multiple_of(2) { re } else { im }, radius)
}

/// Returns the number of motions in a sample that a coordinate separates.
fn distinct(all: &[[Rough; 12]], number: usize) -> usize {
    let mut values: Vec<(f64, f64)> = all.iter().step_by(1 + all.len() / SAMPLE).map(|own| part(own, number)).collect();
    sort::by(&mut values, |a, b| a.0.total_cmp(&b.0));
    values.windows(2).filter(|pair| pair[1].0 - pair[0].0 > pair[0].1 + pair[1].1).count()
}

/// Returns combinations of the unknowns with values, with the remaining unknowns that follow.
fn with_rest<const BITS: u32>(
    kind: Variable,
    constants: &[Motion<Ball<BITS>>],
    values: &[Option<Vec<&Value<BITS>>>; 6],
) -> Option<Vec<Closing<BITS>>> {
    let counts = values.each_ref().map(|list| list.as_ref().map_or(1, Vec::len));
    let total: usize = counts.iter().product();
    if total > MOST {
        return None;
    }
    // The loop is read from an unknown without values on.
    let start = values.iter().position(Option::is_none)?;
    let mut found = Vec::new();
    for number in 0..total {
        let mut left = number;
        let tuple: Tuple = counts.map(|count| {
            let own = left % count;
            left /= count;
            own
        });
        let mut between: Vec<Motion<Ball<BITS>>> = Vec::new();
        for k in 0..6 {
            let j = (start + k) % 6;
            match (&values[j], between.last_mut()) {
                (Some(list), Some(motion)) => *motion = motion.then_after(&step(&list[tuple[j]].pair, &constants[j])),
                _ => between.push(constants[j].clone()),
            }
        }
        match rest(kind, &between) {
            Rest::Open => {}
            Rest::Undetermined => return None,
            Rest::Unique(rest) => found.push(Closing { tuple, rest: in_loop_order(start, values, rest) }),
        }
    }
    Some(found)
}

/// The unknowns without values as the loop has them, read from `start` on before.
fn in_loop_order<const BITS: u32>(
    start: usize,
    values: &[Option<Vec<&Value<BITS>>>; 6],
    rest: Vec<Pair<BITS>>,
) -> Vec<Pair<BITS>> {
    let open = (0..6).map(|k| (start + k) % 6).filter(|&j| values[j].is_none());
    let mut placed: Vec<(usize, Pair<BITS>)> = open.zip(rest).collect();
    sort::by_key(&mut placed, |(place, _)| *place);
    placed.into_iter().map(|(_, pair)| pair).collect()
}

fn step<const BITS: u32>((cos, sin): &Pair<BITS>, constant: &Motion<Ball<BITS>>) -> Motion<Ball<BITS>> {
    Motion::rotation_z(cos.clone(), sin.clone()).then_after(constant)
}

impl<const BITS: u32> Sides<BITS> {
    /// `None` where there are too many.
    fn of(constants: [&Motion<Ball<BITS>>; 3], values: [&[&Value<BITS>]; 3]) -> Option<Self> {
        if values.iter().map(|list| list.len()).product::<usize>() > MOST {
            return None;
        }
        let own = |k: usize| values[k].iter().map(|value| step(&value.pair, constants[k])).collect();
        let steps: [Vec<Motion<Ball<BITS>>>; 3] = [own(0), own(1), own(2)];
        let roughly = steps.each_ref().map(|list| list.iter().map(rough).collect::<Vec<_>>());
        let mut all = Vec::new();
        for (i, first) in roughly[0].iter().enumerate() {
            for (j, second) in roughly[1].iter().enumerate() {
                let two = first.then_after(second);
                let thirds = roughly[2].iter().enumerate();
                all.extend(thirds.map(|(k, third)| Side { choice: [i, j, k], motion: two.then_after(third) }));
            }
        }
        Some(Self { steps, all })
    }

    /// One of the motions in balls.
    fn motion(&self, [i, j, k]: [usize; 3]) -> Motion<Ball<BITS>> {
        self.steps[0][i].then_after(&self.steps[1][j]).then_after(&self.steps[2][k])
    }
}

/// A motion in discs that hold its balls.
fn rough<const BITS: u32>(motion: &Motion<Ball<BITS>>) -> Motion<Rough> {
    Motion {
        rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(Rough::of)),
        translation: motion.translation.each_ref().map(Rough::of),
    }
}

/// The entries of a motion, those of the translation first.
fn entries(motion: &Motion<Rough>) -> [Rough; 12] {
    let [[a, b, c], [d, e, f], [g, h, i]] = motion.rotation;
    let [x, y, z] = motion.translation;
    [x, y, z, a, b, c, d, e, f, g, h, i]
}

/// Returns whether f64 allows two motions, or two axes, to be equal.
fn may_meet<const N: usize>(one: &[Rough; N], other: &[Rough; N]) -> bool {
    one.iter().zip(other).all(|(a, b)| a.may_meet(b))
}

fn overlap<const BITS: u32>(one: &Motion<Ball<BITS>>, other: &Motion<Ball<BITS>>) -> bool {
    let rotations = one.rotation.iter().flatten().zip(other.rotation.iter().flatten());
    one.translation.iter().zip(&other.translation).chain(rotations).all(|(a, b)| a.overlaps(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorted_discs_meet_as_those_compared_one_by_one() {
        // Numbers on a coarse grid, so that many meet; some wide, some that overflowed.
        let entry = |i: usize, k: usize| {
            let value = |by: usize| ((i * 7919 + k * 104_729 + by) % 5) as f64 / 8.0;
            let radius = if (i + k).is_multiple_of(37) { 0.3 } else { 1e-12 };
            let re = if i.is_multiple_of(53) && k == 3 { f64::NAN } else { value(0) + (i % 3) as f64 };
            Rough { re, im: value(17), radius }
        };
        let list = |from: usize| (from..from + 300).map(|i| std::array::from_fn(|k| entry(i, k))).collect::<Vec<_>>();
        let (one, two): (Vec<[Rough; 12]>, Vec<[Rough; 12]>) = (list(0), list(100));
        let mut found = Vec::new();
        let mut add = |i, j| {
            found.push((i, j));
            true
        };
        assert!(meeting(&one, &two, &mut add));
        found.sort_unstable();
        let all = (0..one.len()).flat_map(|i| (0..two.len()).map(move |j| (i, j)));
        let expected: Vec<(usize, usize)> = all.filter(|&(i, j)| may_meet(&one[i], &two[j])).collect();
        assert_eq!(found, expected);
        assert!(expected.len() > 300 && expected.len() < 90_000, "{}", expected.len());
        assert!(meeting(&one, &[], |_, _| false) && !meeting(&one, &two, |_, _| false));
    }
}
