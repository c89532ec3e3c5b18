//! The freedom of a loop: Gruebler's count, and the rank of the screws of its joints in general position.

use super::chain::{Chain, Geometry, JointKind};
use super::closed_loop::{Numbers, Variable};
use super::motion::{Motion, Vector};
use super::screw_system::{Screw, ScrewSystem};
use crate::algebra::drawn::Drawn;
use crate::algebra::number::Number;
use crate::algebra::ring::{Field, Ring};
use std::fmt;

/// The field of the rank, in which a wrong one has a probability below `1e-16`.
type Mod = Drawn;

/// The freedoms of a chain read as a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// The number of joint variables.
    pub variables: usize,
    /// The rank of the joint screws at joint values in general position, closed or not: what the loop has to close against.
    /// `None` for an unlucky prime.
    pub rank: Option<usize>,
    /// Whether two S joints let the link between them spin.
    pub spins: bool,
}

impl Freedom {
    /// The freedoms of a chain.
    ///
    /// # Example
    /// Of Bennett's loop: mobility -2 by Gruebler's count (4 - 6), screw rank 4 in general position.
    #[must_use]
    pub fn of(chain: &Chain) -> Self {
        let kinds = chain.joint_kinds();
        let spins = kinds.iter().filter(|kind| **kind == JointKind::Spherical).count() > 1;
        Self { variables: chain.freedoms(), rank: rank(chain), spins }
    }

    /// Joint variables less equations, `n - 6`.
    #[must_use]
    pub fn gruebler(&self) -> i64 {
        i64::try_from(self.variables).unwrap_or(i64::MAX) - 6
    }
}

impl fmt::Display for Freedom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mobility {} by Gruebler's count ({} - 6)", self.gruebler(), self.variables)?;
        if let Some(rank) = self.rank {
            write!(f, ", screw rank {rank} in general position")?;
        }
        if self.spins {
            f.write_str(" (the spin of a link between two S joints about the line of their centres counts)")?;
        }
        Ok(())
    }
}

/// The pitch that each joint variable has, none but those of H joints.
fn pitches(chain: &Chain) -> Vec<Option<&Number>> {
    let of_joints: Vec<Option<&Number>> = match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            joints.iter().map(|joint| joint.pitch.as_ref()).collect()
        }
        Geometry::Screws { joints, .. } => joints.iter().map(|joint| joint.pitch.as_ref()).collect(),
    };
    let kinds = chain.joint_kinds();
    kinds.iter().zip(of_joints).flat_map(|(kind, pitch)| std::iter::repeat_n(pitch, kind.freedoms())).collect()
}

/// The rank at pseudo-random joint values, modulo a prime.
fn rank(chain: &Chain) -> Option<usize> {
    let pitches = pitches(chain);
    let mut screws: Vec<Screw<Mod>> = Vec::new();
    let mut frame: Motion<Mod> = Motion::identity();
    let cycle = chain.cycle::<Mod>(&Numbers).unwrap_or_default();
    for (number, ((variable, behind), pitch)) in (1..).zip(cycle.into_iter().zip(pitches)) {
        let axis: Vector<Mod> = std::array::from_fn(|i| frame.rotation[i][2]);
        // Any numbers without a relation between them.
        let value = Mod::new(1_000_003 * (number + 2) * (number + 2) * (number + 2) + 77_711 * number);
        let moved = match variable {
            Variable::Rotation => {
                let mut screw = Screw::rotation(&frame.translation, &axis);
                // An angle and its tangent are independent: so are the rotation of an H joint and its translation.
                let along = Mod::new(500_009 * (number + 3) * (number + 5));
                let mut slide = Motion::identity();
                if let Some(pitch) = pitch {
                    let pitch = Mod::from_rational(pitch.rational())?;
                    screw.moment = std::array::from_fn(|i| screw.moment[i].add(&pitch.mul(&axis[i])));
                    slide = Motion::translation_z(pitch.mul(&along));
                }
                screws.push(screw);
                let square = value.mul(&value);
                let scale = Mod::one().add(&square).inverse()?;
                Motion::rotation_z(Mod::one().sub(&square).mul(&scale), value.add(&value).mul(&scale))
                    .then_after(&slide)
            }
            Variable::Translation => {
                screws.push(Screw::translation(&axis));
                Motion::translation_z(value)
            }
        };
        frame = frame.then_after(&moved).then_after(&behind);
    }
    Some(ScrewSystem::of(&screws).order())
}
