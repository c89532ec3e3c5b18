//! The robots of the library at random poses, as designed and as built.

use super::sample::matrix;
use crate::algebra::number::{Angle, Number};
use crate::catalogue::entry::{Case, Design, Entry, Kind};
use crate::catalogue::{Options, builtin, robot_names};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Joint, Placement};
use crate::kinematics::motion::Motion;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::f64::consts::PI;

/// Robots that are also timed as built.
const BUILT: [&str; 3] = ["iiwa14", "puma560", "ur5e"];
/// Errors of every number of a robot as built, metres and radians.
const OFF: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// A robot as built is timed at one in this many poses.
const FEWER: u64 = 4;

/// A robot, or one as built, with poses that it reaches.
pub(super) struct Posed {
    /// Its name.
    pub name: String,
    /// The robot with its poses.
    pub entry: Entry,
}

/// Returns all robots of six joints with `count` poses each, and some of them as built.
pub(super) fn posed(count: u64, seed: u64) -> Result<Vec<Posed>> {
    let mut all = Vec::new();
    for name in robot_names() {
        let mut entry = builtin(&name, &Options::default())?;
        let is_six = entry.chain().is_some_and(|chain| chain.freedoms() == 6 && chain.variables().len() == 6);
        if entry.kind() != Kind::Arm || !is_six {
            continue;
        }
        entry.limits.clear();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(all.len() as u64);
        let built = BUILT.contains(&name.as_str()).then(|| entry.clone());
        all.push(Posed { entry: with_poses(entry, count, &mut random)?, name: name.clone() });
        for off in OFF {
            let Some(entry) = built.as_ref().and_then(|entry| disturbed(entry, off, &mut random)) else { continue };
            let entry = with_poses(entry, count.div_ceil(FEWER), &mut random)?;
            all.push(Posed { name: format!("{name} off by {off:e}"), entry });
        }
    }
    Ok(all)
}

fn with_poses(mut entry: Entry, count: u64, random: &mut ChaCha8Rng) -> Result<Entry> {
    entry.cases.clear();
    for _ in 0..count {
        let chain = entry.chain().ok_or_else(|| Error::Invalid("found no joints, expected an arm".to_owned()))?;
        let turns = (0..chain.freedoms()).map(|_| {
            let (sin, cos) = random.random_range(-PI..PI).sin_cos();
            Motion::rotation_z(cos, sin)
        });
        let turns: Vec<Motion<f64>> = turns.collect();
        if let Some(pose) = chain.forward::<f64>(&turns) {
            entry.cases.push(Case::at(Placement::from_matrix(&matrix(&pose))?.0, 0));
        }
    }
    Ok(entry)
}

/// Returns a robot whose every length and angle is off by up to `off`; `None` if it is not given by a table of these.
fn disturbed(entry: &Entry, off: f64, random: &mut ChaCha8Rng) -> Option<Entry> {
    let mut joint = |joint: &Joint| {
        let mut moved = |x: f64| x + random.random_range(-off..off);
        Joint {
            a: Number::from_f64(moved(joint.a.to_f64())),
            alpha: Angle::from_radians(moved(joint.alpha.radians())),
            d: Number::from_f64(moved(joint.d.to_f64())),
            theta0: Angle::from_radians(moved(joint.theta0.radians())),
            ..joint.clone()
        }
    };
    let chain = entry.chain()?;
    let geometry = match &chain.geometry {
        Geometry::Dh(joints) => Geometry::Dh(joints.iter().map(&mut joint).collect()),
        Geometry::ModifiedDh(joints) => Geometry::ModifiedDh(joints.iter().map(&mut joint).collect()),
        Geometry::Screws { .. } => return None,
    };
    let chain = Chain { geometry, ..chain.clone() };
    Some(Entry { design: Design::Arm(chain), rounded: true, ..entry.clone() })
}
