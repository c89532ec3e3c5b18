//! Which combinations of values close a loop: the first three unknowns from one side, the others from the other side.

use super::missing::{Rest, rest};
use super::values::{Pair, Value};
use crate::algebra::ball::Ball;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;

/// Combinations on one side of a loop that are looked at: 16 values of each of three unknowns.
const MOST: usize = 16 * 16 * 16;

/// A combination: which of its values each unknown has.
pub type Tuple = [usize; 6];

/// A motion in balls, and discs in f64 around its entries.
struct Side<const BITS: u32> {
    choice: [usize; 3],
    motion: Motion<Ball<BITS>>,
    discs: [[f64; 3]; 12],
}

/// A combination of values that may close a loop, with the unknowns that it leaves.
#[derive(Clone, Debug)]
pub struct Closing<const BITS: u32> {
    /// Which value each unknown has; 0 for those without values.
    pub tuple: Tuple,
    /// The unknowns without values, in loop order.
    pub rest: Vec<Pair<BITS>>,
}

/// All combinations of values for which balls do not prove that the loop does not close; `None` where there are too many
/// combinations, and where one of them may belong to several solutions. `values[j]` are those of unknown j, a rotation; up to
/// three unknowns have none, all of them rotations or all of them translations.
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

/// Combinations of five unknowns, by what both sides of the loop see of the sixth one and it does not change: the axis of a rotation,
/// the frame's directions of a translation.
fn with_one_left<const BITS: u32>(
    kind: Variable,
    constants: &[Motion<Ball<BITS>>],
    values: &[Option<Vec<&Value<BITS>>>; 6],
) -> Option<Vec<Closing<BITS>>> {
    let missing = values.iter().position(Option::is_none)?;
    // The loop is read from behind the missing unknown, which is the last one then.
    let place = |k: usize| (missing + 1 + k) % 6;
    let lists: Vec<&[&Value<BITS>]> = (0..5).map(|k| values[place(k)].as_deref()).collect::<Option<_>>()?;
    let near = sides([0, 1, 2].map(|k| &constants[place(k)]), [lists[0], lists[1], lists[2]])?;
    let mut found = Vec::new();
    let last = &constants[missing];
    // near far V G = I with the missing V, which keeps what is compared: of a rotation far z = near^-1 G^-1 z.
    let kept = |motion: &Motion<Ball<BITS>>| kept_discs(kind, motion);
    let seen: Vec<_> = near.iter().map(|side| kept(&last.then_after(&side.motion).inverse())).collect();
    for (i, fourth) in lists[3].iter().enumerate() {
        for (j, fifth) in lists[4].iter().enumerate() {
            let far = step(&fourth.pair, &constants[place(3)]).then_after(&step(&fifth.pair, &constants[place(4)]));
            let own = kept(&far);
            for (side, _) in near.iter().zip(&seen).filter(|(_, other)| may_meet(&own, other)) {
                let whole = last.then_after(&side.motion).then_after(&far);
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

/// Discs in f64 around what an unknown does not change of a motion before it: direction and origin of the z axis, or two of the
/// directions.
fn kept_discs<const BITS: u32>(kind: Variable, motion: &Motion<Ball<BITS>>) -> [[f64; 3]; 6] {
    let [a, b, c] = [0, 1, 2].map(|i| disc(&motion.rotation[i][2]));
    let [x, y, z] = match kind {
        Variable::Rotation => motion.translation.each_ref().map(disc),
        Variable::Translation => [0, 1, 2].map(|i| disc(&motion.rotation[i][0])),
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
        sides([&constants[first], &constants[first + 1], &constants[first + 2]], steps)
    });
    let (near, mut far) = (near?, far?);
    for side in &mut far {
        side.motion = side.motion.inverse();
        side.discs = discs(&side.motion);
    }
    let mut found = Vec::new();
    for a in &near {
        for b in far.iter().filter(|b| may_meet(&a.discs, &b.discs) && overlap(&a.motion, &b.motion)) {
            found.push([a.choice[0], a.choice[1], a.choice[2], b.choice[0], b.choice[1], b.choice[2]]);
        }
    }
    Some(found)
}

/// Combinations of the unknowns with values, and what they leave of the others.
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
    placed.sort_by_key(|(place, _)| *place);
    placed.into_iter().map(|(_, pair)| pair).collect()
}

fn step<const BITS: u32>((cos, sin): &Pair<BITS>, constant: &Motion<Ball<BITS>>) -> Motion<Ball<BITS>> {
    Motion::rotation_z(cos.clone(), sin.clone()).then_after(constant)
}

/// `V1 G1 V2 G2 V3 G3` for all combinations of values of three unknowns.
fn sides<const BITS: u32>(
    constants: [&Motion<Ball<BITS>>; 3],
    values: [&[&Value<BITS>]; 3],
) -> Option<Vec<Side<BITS>>> {
    if values.iter().map(|list| list.len()).product::<usize>() > MOST {
        return None;
    }
    let steps: Vec<Vec<Motion<Ball<BITS>>>> =
        values.iter().zip(constants).map(|(list, g)| list.iter().map(|value| step(&value.pair, g)).collect()).collect();
    let mut all = Vec::new();
    for (i, first) in steps[0].iter().enumerate() {
        for (j, second) in steps[1].iter().enumerate() {
            let two = first.then_after(second);
            for (k, third) in steps[2].iter().enumerate() {
                let motion = two.then_after(third);
                all.push(Side { choice: [i, j, k], discs: discs(&motion), motion });
            }
        }
    }
    Some(all)
}

fn entries<const BITS: u32>(motion: &Motion<Ball<BITS>>) -> impl Iterator<Item = &Ball<BITS>> {
    motion.translation.iter().chain(motion.rotation.iter().flatten())
}

/// Discs in f64 that hold the balls of all entries.
fn discs<const BITS: u32>(motion: &Motion<Ball<BITS>>) -> [[f64; 3]; 12] {
    let mut discs = [[0.0; 3]; 12];
    for (own, ball) in discs.iter_mut().zip(entries(motion)) {
        *own = disc(ball);
    }
    discs
}

/// A disc in f64 that holds a ball.
fn disc<const BITS: u32>(ball: &Ball<BITS>) -> [f64; 3] {
    let (re, im) = (ball.re().to_f64(), ball.im().to_f64());
    // Rounding to f64 moves the midpoint, and the radius, by half a unit in the last place.
    let radius = ball.radius().to_f64() * (1.0 + 1e-15) + (re.abs() + im.abs()) * f64::EPSILON + f64::MIN_POSITIVE;
    [re, im, radius]
}

/// Whether f64 leaves it open that two motions, or two axes, are the same one; what overflowed is left open.
fn may_meet<const N: usize>(one: &[[f64; 3]; N], other: &[[f64; 3]; N]) -> bool {
    one.iter().zip(other).all(|([x, y, r], [u, v, s])| {
        let reach = (r + s) * (1.0 + 1e-15);
        !((x - u).abs() > reach || (y - v).abs() > reach)
    })
}

fn overlap<const BITS: u32>(one: &Motion<Ball<BITS>>, other: &Motion<Ball<BITS>>) -> bool {
    entries(one).zip(entries(other)).all(|(a, b)| a.overlaps(b))
}
