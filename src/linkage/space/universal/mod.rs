//! A plate on three UPU legs of given lengths: all poses by paths from a general plate, and their number modulo a prime.
//!
//! Six quadratic forms in Study's parameters ([`UniversalLeg`]), Study's condition and N = 1 are a system in which every pose stands twice,
//! with both signs. Its Gröbner basis modulo the prime of the run counts them. That a residue is 0 proves nothing about the number, so that
//! the count is probable only; the poses found are proved, each by Krawczyk's theorem.

mod paths;
mod start;

use super::clusters::open_joints;
use super::equations::System;
use super::plate_pose::{PlatePose, PoseForms, proved, times};
use crate::algebra::disc::Disc;
use crate::algebra::drawn::Drawn;
use crate::algebra::groebner::{Basis, Equation};
use crate::algebra::ring::Ring;
use crate::closure::study::{Four, scalar};
use crate::closure::universal_leg::UniversalLeg;
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::space::{Known, SpaceGiven, SpaceLinkage, SpacePair};
use crate::linkage::points::EFFORT;
use crate::solve::paths::{Family, arc};
use crate::synthesis::krawczyk::BITS;
use num_complex::Complex;
use paths::{Legs, Moving, Pose, is_pose};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::Rational;
use start::{GENERAL, start};
use std::f64::consts::TAU;

/// Sets of paths that are followed until all poses are found: a path fails by accident at most.
const TRIES: usize = 5;
/// Maximum number of steps on a path.
const MOST_STEPS: usize = 1500;

/// A leg of a file.
#[derive(Clone, Debug)]
struct GivenLeg {
    points: [Vector<Rational>; 2],
    axes: [Vector<Rational>; 2],
    square: Rational,
}

/// A plate on three UPU legs.
#[derive(Clone, Debug)]
pub(super) struct Plate {
    legs: [GivenLeg; 3],
}

/// The number of poses, with multiplicity, modulo a prime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Count {
    Finite(usize),
    /// They form a set of this dimension.
    Dimension(usize),
}

impl Plate {
    /// Returns the plate that a linkage with these inputs is; `None` of other linkages.
    pub fn of(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System) -> Option<Self> {
        let clusters = &system.clusters;
        if clusters.len() != 2 || clusters[1].is_rod {
            return None;
        }
        let place = |body: usize| clusters.iter().flat_map(|cluster| &cluster.bodies).find(|(own, _)| *own == body);
        let leg = |(joint, of): (usize, [usize; 2])| {
            let own = &linkage.joints[joint];
            let SpacePair::UniversalLeg(axes) = &own.pair else { return None };
            let known = given.iter().find(|one| one.joint == Some(joint)).map(|one| &one.known);
            let Some(Known::Square(square)) = known else { return None };
            let sides = match of {
                [0, 1] => [0, 1],
                [1, 0] => [1, 0],
                _ => return None,
            };
            let motion = |side: usize| place(own.of[side]).map(|(_, motion)| motion);
            let ends = [motion(sides[0])?, motion(sides[1])?];
            Some(GivenLeg {
                points: [0, 1].map(|k| ends[k].apply(&own.at[sides[k]])),
                axes: [0, 1].map(|k| ends[k].rotate(&axes[sides[k]])),
                square: square.clone(),
            })
        };
        let legs: Option<Vec<GivenLeg>> = open_joints(linkage, given, clusters).into_iter().map(leg).collect();
        Some(Self { legs: legs?.try_into().ok()? })
    }

    /// Returns the number of poses modulo the prime of the run; `None` where that takes too much work.
    pub fn count(&self) -> Option<Count> {
        let number = |c: &Rational| Equation::from_rational(c).unwrap_or_else(Equation::zero);
        let [x, y] = [0, 4].map(|from| std::array::from_fn(|k| Equation::variable(from + k)));
        let mut equations = vec![scalar(&x, &x).sub(&Equation::one()), scalar(&x, &y)];
        for leg in &self.legs {
            equations.extend(leg.over(Rational::clone).values(&x, &y, |z, c| z.mul(&number(c))));
        }
        let basis = Basis::<Drawn>::of(8, &equations, EFFORT)?;
        match basis.dimension() {
            None => Some(Count::Finite(0)),
            // Every pose stands twice.
            Some(0) => Some(Count::Finite(basis.count(2 * GENERAL)? / 2)),
            Some(dimension) => Some(Count::Dimension(dimension)),
        }
    }

    /// Returns the poses that were found, at most this many.
    pub fn poses(&self, most: usize) -> Vec<PlatePose> {
        let size = self.size();
        let target = self.floating(size);
        let general = start();
        let moving = Moving { start: &general.legs, target: &target };
        // Any fixed seed: a pose is proved however it was found.
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        let mut list: Vec<PlatePose> = Vec::new();
        let exact = Exact(self.legs.each_ref().map(|leg| leg.over(|c| Disc::of(c, BITS))));
        for _ in 0..TRIES {
            let bend = Complex::from_polar(1.0, random.random_range(0.0..TAU));
            let carried = |v: &Pose| {
                let end = moving.follow(|s| arc(bend, s), v, 1.0, 0.0, MOST_STEPS).filter(is_pose)?;
                proved(&exact, &end, size)
            };
            let found: Vec<PlatePose> = general.poses.par_iter().filter_map(carried).collect();
            for pose in found {
                if list.iter().all(|own| own.is_apart_from(&pose)) {
                    list.push(pose);
                }
            }
            if list.len() >= most {
                break;
            }
        }
        list
    }

    /// The largest coordinate of a point or length of a leg.
    fn size(&self) -> f64 {
        let of = |leg: &GivenLeg| {
            let points = leg.points.iter().flatten().map(|c| c.to_f64().abs());
            points.fold(leg.square.to_f64().abs().sqrt(), f64::max)
        };
        self.legs.iter().map(of).fold(f64::MIN_POSITIVE, f64::max)
    }

    /// The legs in f64, in parts of a size, with axes of length 1.
    fn floating(&self, size: f64) -> Legs {
        let over = |v: &Vector<Rational>, by: f64| v.each_ref().map(|c| Complex::from(c.to_f64() / by));
        self.legs.each_ref().map(|leg| {
            let points = leg.points.each_ref().map(|point| over(point, size));
            let axes = leg.axes.each_ref().map(|axis| over(axis, dot(axis, axis).to_f64().sqrt()));
            let square = Complex::from(leg.square.to_f64() / (size * size));
            UniversalLeg::new([&points[0], &points[1]], square, [&axes[0], &axes[1]])
        })
    }
}

impl GivenLeg {
    /// The leg over another ring.
    fn over<C: Ring>(&self, image: impl Fn(&Rational) -> C) -> UniversalLeg<C> {
        let [points, axes] = [&self.points, &self.axes].map(|both| both.each_ref().map(|v| v.each_ref().map(&image)));
        UniversalLeg::new([&points[0], &points[1]], image(&self.square), [&axes[0], &axes[1]])
    }
}

/// The legs with the numbers of their forms as discs.
struct Exact([UniversalLeg<Disc>; 3]);

impl PoseForms for Exact {
    fn values(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<Disc> {
        self.0.iter().flat_map(|leg| leg.values(x, y, times)).collect()
    }

    fn slopes(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<[Disc; 8]> {
        self.0.iter().flat_map(|leg| leg.slopes(x, y, times)).collect()
    }
}
