//! All configurations of a loop of revolute joints over a small prime field, by meeting in the middle.
//!
//! An isolated configuration is one of at most 16 (as many as a general 6R loop has); a curve of configurations has
//! about as many as the field has elements. Counting them is a test of mobility without degenerate cuts.

use super::finite_field::{Turn, all_turns, turn_number};
use crate::algebra::modp::ModP;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::ansatz::Link;
use crate::kinematics::motion::{Motion, dot};

/// Maximum number of isolated configurations of a loop of up to six revolute joints.
pub const MOST_ISOLATED: usize = 16;

/// The configurations of a loop over the field of P elements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configurations {
    /// The rotation of each joint by its number in [`all_turns`].
    pub turns: Vec<Vec<u16>>,
    /// Whether the list is complete; otherwise the count was stopped.
    pub complete: bool,
}

impl Configurations {
    /// Returns whether there are too many for all of them to be isolated.
    #[must_use]
    pub fn are_a_family(&self) -> bool {
        self.turns.len() > MOST_ISOLATED
    }

    /// Returns the number of different rotations of each joint.
    #[must_use]
    pub fn values(&self) -> Vec<usize> {
        let joints = self.turns.first().map_or(0, Vec::len);
        let distinct = |joint: usize| {
            let mut values: Vec<u16> = self.turns.iter().map(|turns| turns[joint]).collect();
            values.sort_unstable();
            values.dedup();
            values.len()
        };
        (0..joints).map(distinct).collect()
    }

    /// Returns the joints that move in a family of configurations. On a curve at most 16 configurations share the rotation of a
    /// moving joint, while a locked one has a few values only.
    #[must_use]
    pub fn moving(&self) -> Vec<bool> {
        let least = 2.max(self.turns.len() / MOST_ISOLATED);
        self.values().iter().map(|&values| self.are_a_family() && values > least).collect()
    }

    /// Returns whether there is a family of configurations in which every joint moves.
    #[must_use]
    pub fn all_move(&self) -> bool {
        self.are_a_family() && self.moving().iter().all(|&moves| moves)
    }
}

/// Returns the link motion `Tz(d) Rx(alpha) Tx(a)`.
#[must_use]
pub fn link_motion<R: Ring>(link: &Link<R>) -> Motion<R> {
    let mut motion = Motion::rotation_x(link.cos.clone(), link.sin.clone());
    motion.translation = [link.a.clone(), R::zero(), link.d.clone()];
    motion
}

/// Returns the configurations of a loop of four to six revolute joints, at most `limit` of them.
///
/// The loop is cut at the first and the fourth joint (the third of four). The invariants of the motion between these two
/// axes under rotations about them are `R_33`, `t_3`, `(R^T t)_3` and `t.t`. They are computed for every rotation of the joints
/// on one side and looked up for every rotation of those on the other: `2 (P + 1)^2` entries.
///
/// # Panics
/// Unless there are four to six joints.
#[must_use]
pub fn configurations<const P: u64>(links: &[Link<ModP<P>>], limit: usize) -> Configurations {
    assert!((4..=6).contains(&links.len()), "four to six joints");
    let middle = if links.len() == 4 { 2 } else { 3 };
    let motions: Vec<Motion<ModP<P>>> = links.iter().map(link_motion).collect();
    let near = Side { first: &motions[0], others: &motions[1..middle], reversed: false };
    let far = Side { first: &motions[middle], others: &motions[middle + 1..], reversed: true };
    let all = all_turns::<P>();
    let index = Index::of(near.keys(&all));
    let mut found = Configurations { turns: Vec::new(), complete: true };
    for (there, key) in far.keys(&all).into_iter().enumerate() {
        for here in index.entries(key) {
            let (one, other) = (near.motion(here, &all), far.motion(there, &all).inverse());
            for (first, cut) in cuts(&one, &other, &all) {
                if found.turns.len() == limit {
                    found.complete = false;
                    return found;
                }
                let mut turns = vec![first];
                turns.extend(near.turns::<P>(here));
                turns.push(cut);
                turns.extend(far.turns::<P>(there));
                found.turns.push(turns);
            }
        }
    }
    found
}

/// Returns the rotations `u`, `v` with `Rz(u) one Rz(v) = other`.
fn cuts<const P: u64>(
    one: &Motion<ModP<P>>,
    other: &Motion<ModP<P>>,
    all: &[Turn<ModP<P>>],
) -> impl Iterator<Item = (u16, u16)> {
    let column = |m: &Motion<ModP<P>>| [m.rotation[0][2], m.rotation[1][2]];
    let fits = move |(cos, sin): &Turn<ModP<P>>| {
        let carries = |from: [ModP<P>; 2], to: [ModP<P>; 2]| {
            cos.mul(&from[0]).sub(&sin.mul(&from[1])) == to[0] && sin.mul(&from[0]).add(&cos.mul(&from[1])) == to[1]
        };
        let (t, s) = (&one.translation, &other.translation);
        carries([t[0], t[1]], [s[0], s[1]]) && carries(column(one), column(other))
    };
    let closing = |(cos, sin): &Turn<ModP<P>>| {
        let turned = Motion::rotation_z(*cos, *sin).then_after(one).inverse().then_after(other);
        (turn_number(&(*cos, *sin)), turn_number(&(turned.rotation[0][0], turned.rotation[1][0])))
    };
    all.iter().filter(move |turn| fits(turn)).map(closing).collect::<Vec<_>>().into_iter()
}

/// The part of the loop between the two joints at which it is cut.
struct Side<'a, const P: u64> {
    first: &'a Motion<ModP<P>>,
    /// The links behind its one or two joints.
    others: &'a [Motion<ModP<P>>],
    /// Whether the inverse motion is used.
    reversed: bool,
}

impl<const P: u64> Side<'_, P> {
    /// Returns the rotations with this number.
    fn turns<const Q: u64>(&self, number: usize) -> Vec<u16> {
        let base = usize::try_from(Q + 1).unwrap_or(usize::MAX);
        let digits = if self.others.len() == 1 { vec![number] } else { vec![number / base, number % base] };
        digits.into_iter().map(|digit| u16::try_from(digit).unwrap_or(u16::MAX)).collect()
    }

    fn motion(&self, number: usize, all: &[Turn<ModP<P>>]) -> Motion<ModP<P>> {
        let turns: Vec<_> = self.turns::<P>(number).iter().map(|&j| all[usize::from(j)]).collect();
        self.at(&turns)
    }

    fn at(&self, turns: &[Turn<ModP<P>>]) -> Motion<ModP<P>> {
        turns.iter().zip(self.others).fold(self.first.clone(), |motion, ((cos, sin), link)| {
            motion.then_after(&Motion::rotation_z(*cos, *sin)).then_after(link)
        })
    }

    /// Returns the invariants of rotations about the axes of the cut, which are linear in cosine and sine of each joint.
    fn invariants(&self, turns: &[Turn<ModP<P>>]) -> [ModP<P>; 4] {
        let m = self.at(turns);
        let t = &m.translation;
        let along = dot(&[m.rotation[0][2], m.rotation[1][2], m.rotation[2][2]], t);
        let (first, second) = if self.reversed { (along.neg(), t[2].neg()) } else { (t[2], along) };
        [m.rotation[2][2], first, second, dot(t, t)]
    }

    /// Returns the invariants for all rotations, each packed into a number.
    fn keys(&self, all: &[Turn<ModP<P>>]) -> Vec<u64> {
        // f = f_0 + f_c cos + f_s sin from its values at 0, pi and pi/2.
        let nodes = [(1, 0), (-1, 0), (0, 1)].map(|(c, s)| (ModP::from_integer(c), ModP::from_integer(s)));
        let half = ModP::<P>::from_integer(2).inverse().expect("the prime is odd");
        let fit = |[at_zero, at_pi, at_right]: [ModP<P>; 3]| {
            let mean = at_zero.add(&at_pi).mul(&half);
            [mean, at_zero.sub(&mean), at_right.sub(&mean)]
        };
        #[expect(clippy::cast_possible_truncation, reason = "residues of a small prime")]
        let small = |x: ModP<P>| x.value() as u32;
        let circle: Vec<[u32; 2]> = all.iter().map(|(c, s)| [small(*c), small(*s)]).collect();
        let mut keys = Vec::with_capacity(if self.others.len() == 1 { all.len() } else { all.len() * all.len() });
        let mut row = |values: [[ModP<P>; 4]; 3]| {
            let forms: [[u32; 3]; 4] = std::array::from_fn(|i| fit(values.map(|at| at[i])).map(small));
            keys.extend(circle.iter().map(|[c, s]| pack::<P>(forms.map(|[f, fc, fs]| f + fc * c + fs * s))));
        };
        if self.others.len() == 1 {
            row(nodes.map(|turn| self.invariants(&[turn])));
            return keys;
        }
        // The forms in the first joint at each node of the second.
        let columns = nodes.map(|second| {
            let values = nodes.map(|first| self.invariants(&[first, second]));
            std::array::from_fn::<_, 4, _>(|i| fit(values.map(|at| at[i])))
        });
        for (c, s) in all {
            let at = |[f, fc, fs]: [ModP<P>; 3]| f.add(&fc.mul(c)).add(&fs.mul(s));
            row(columns.map(|forms| forms.map(at)));
        }
        keys
    }
}

/// Packs four sums of products of residues into one number.
#[inline(always)]
fn pack<const P: u64>(values: [u32; 4]) -> u64 {
    #[expect(clippy::cast_possible_truncation, reason = "a small prime")]
    let reduced = values.map(|v| u64::from(v % P as u32));
    ((reduced[0] * P + reduced[1]) * P + reduced[2]) * P + reduced[3]
}

/// A hash table of entries by their keys.
struct Index {
    keys: Vec<u64>,
    /// The last entry of each bucket, and for every entry the one before it in its bucket; [`NONE`] for no entry.
    buckets: Vec<u32>,
    previous: Vec<u32>,
    shift: u32,
}

/// Marks the absence of an entry.
const NONE: u32 = u32::MAX;

impl Index {
    fn of(keys: Vec<u64>) -> Self {
        let bits = (2 * keys.len()).next_power_of_two().trailing_zeros().max(1);
        let mut index = Self {
            buckets: vec![NONE; 1 << bits],
            previous: Vec::with_capacity(keys.len()),
            keys: Vec::new(),
            shift: 64 - bits,
        };
        for (&key, entry) in keys.iter().zip(0..) {
            let bucket = index.bucket(key);
            index.previous.push(std::mem::replace(&mut index.buckets[bucket], entry));
        }
        index.keys = keys;
        index
    }

    /// Fibonacci hashing.
    #[expect(clippy::cast_possible_truncation, reason = "shifted to the bits of the buckets")]
    fn bucket(&self, key: u64) -> usize {
        (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> self.shift) as usize
    }

    fn entries(&self, key: u64) -> impl Iterator<Item = usize> {
        let mut entry = self.buckets[self.bucket(key)];
        std::iter::from_fn(move || {
            while entry != NONE {
                let at = entry as usize;
                entry = self.previous[at];
                if self.keys[at] == key {
                    return Some(at);
                }
            }
            None
        })
    }
}
