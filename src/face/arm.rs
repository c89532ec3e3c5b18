//! Arms: every joint position that reaches a pose.

use super::forward::Forward;
use super::model::Model;
use super::pose::{Matrix, matrix, placement};
use super::workspace::Workspace;
use crate::algebra::number::{Angle, Number, Reading};
use crate::assembly::Roots;
use crate::catalogue::entry::{Case, Design, Kind};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use crate::mechanism::Solution;
use crate::report::document;
use crate::scene::{Pose, Stage};
use rayon::prelude::*;
use serde_json::Value;

/// The convention by which rows of four numbers describe links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// `Rz(q + theta0) Tz(d) Tx(a) Rx(alpha)`
    Dh,
    /// `Rx(alpha) Tx(a) Rz(q + theta0) Tz(d)` (Craig)
    ModifiedDh,
}

/// One joint with its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DhRow {
    /// R or P.
    pub kind: JointKind,
    /// Link length.
    pub a: f64,
    /// Link twist.
    pub alpha: f64,
    /// Offset along the joint axis.
    pub d: f64,
    /// Angle about the joint axis at joint value 0.
    pub theta0: f64,
}

/// One joint by its axis in the home position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewRow {
    /// R or P.
    pub kind: JointKind,
    /// The direction of the axis, of any length.
    pub axis: [f64; 3],
    /// A point of the axis.
    pub point: [f64; 3],
}

/// A robot arm, prepared when it is first solved. Threads share it.
pub struct Arm {
    /// The mechanism.
    #[doc(hidden)]
    pub model: Model,
    forward: Forward,
    stage: Option<Stage>,
}

/// An angle in radians; the double nearest to a multiple of half a degree is that multiple, so that right angles are exact.
pub(super) fn angle(radians: f64) -> Angle {
    let halves = (radians.to_degrees() * 2.0).round();
    let nearest = (halves / 2.0).to_radians();
    // The last bit of a product may differ.
    if (nearest - radians).abs() <= f64::EPSILON * radians.abs() && halves.abs() < 1e6 {
        let text = format!("{} deg", halves / 2.0);
        if let Ok(angle) = Angle::parse(&text, &Reading::default()) {
            return angle;
        }
    }
    Angle::from_radians(radians)
}

impl Arm {
    /// An arm of a file or of the library.
    ///
    /// # Errors
    /// For an entry that is no arm, and for arms that are not solved.
    #[doc(hidden)]
    pub fn new(mut model: Model) -> Result<Self> {
        let is_bare = model.entry.cases.is_empty();
        if is_bare {
            // A prepared arm needs one pose as its case.
            model.entry.cases.push(Case::at(Placement::identity(), 1));
        }
        let chain = match (&model.entry.design, model.entry.kind()) {
            (Design::Arm(chain), _) => chain,
            (_, Kind::Arm) => return Err(Error::Invalid("found an arm without joints, expected some".to_owned())),
            (_, other) => return Err(Error::Invalid(format!("found {other:?}, expected an arm"))),
        };
        let forward = Forward::of(chain)?;
        model.mechanism()?;
        if is_bare {
            model.entry.cases.clear();
        }
        let stage = Stage::of(&model.entry);
        Ok(Self { model, forward, stage })
    }

    /// An arm of the library.
    ///
    /// # Errors
    /// [`Error::UnknownEntry`] for a name that the library does not have.
    pub fn robot(name: &str) -> Result<Self> {
        let is_known = crate::catalogue::all_names().iter().any(|known| known == name)
            || crate::catalogue::robot_names().iter().any(|known| known == name)
            || !crate::catalogue::namesakes(name).is_empty();
        if !is_known {
            return Err(Error::UnknownEntry { name: name.to_owned(), near: Vec::new() });
        }
        Self::new(Model::load(name, None, None)?)
    }

    /// An arm of a file: TOML, JSON, a DH table as CSV, URDF.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub fn from_file(path: &str) -> Result<Self> {
        Self::new(Model::load(path, None, None)?)
    }

    /// Reads the chain between two links of a robot description; without names it must have only one.
    ///
    /// # Errors
    /// For a description that cannot be read.
    pub fn from_urdf(path: &str, tip_link: Option<&str>, base_link: Option<&str>) -> Result<Self> {
        Self::new(Model::load(path, tip_link, base_link)?)
    }

    /// Returns the arm of a DH table. `limits` are the limits of the joints, or empty.
    ///
    /// # Errors
    /// For numbers that are not finite, and for arms that are not solved.
    pub fn from_dh(rows: &[DhRow], convention: Convention, limits: Vec<[f64; 2]>) -> Result<Self> {
        for (index, row) in rows.iter().enumerate() {
            let named = [("a", row.a), ("alpha", row.alpha), ("d", row.d), ("theta0", row.theta0)];
            if let Some((name, value)) = named.into_iter().find(|(_, value)| !value.is_finite()) {
                let message = format!("found {name} = {value} in row {index}, expected a finite number");
                return Err(Error::Invalid(message));
            }
        }
        let joint = |row: &DhRow| Joint {
            kind: row.kind,
            a: Number::from_f64(row.a),
            alpha: angle(row.alpha),
            d: Number::from_f64(row.d),
            theta0: angle(row.theta0),
            pitch: None,
        };
        let joints: Vec<Joint> = rows.iter().map(joint).collect();
        let rounded = joints.iter().any(|joint| !joint.alpha.is_exact() || !joint.theta0.is_exact());
        let geometry = match convention {
            Convention::Dh => Geometry::Dh(joints),
            Convention::ModifiedDh => Geometry::ModifiedDh(joints),
        };
        Self::of(geometry, limits, rounded)
    }

    /// Returns the arm of joint axes and the pose of the flange with all joint values zero.
    ///
    /// # Errors
    /// For numbers that are not finite, axes of length 0, a home that is no pose, and arms that are not solved.
    pub fn from_screws(rows: &[ScrewRow], home: &Matrix, limits: Vec<[f64; 2]>) -> Result<Self> {
        for (index, row) in rows.iter().enumerate() {
            if !row.axis.iter().chain(&row.point).all(|x| x.is_finite()) || row.axis == [0.0; 3] {
                let (axis, point) = (row.axis, row.point);
                let message = format!(
                    "found the axis {axis:?} through {point:?} in row {index}, expected finite numbers and a direction"
                );
                return Err(Error::Invalid(message));
            }
        }
        let numbers = |v: &[f64; 3]| v.map(Number::from_f64);
        let joint = |row: &ScrewRow| ScrewJoint {
            kind: row.kind,
            axis: numbers(&row.axis),
            point: numbers(&row.point),
            pitch: None,
        };
        let (home, _) = placement(home)?;
        let geometry = Geometry::Screws { joints: rows.iter().map(joint).collect(), home: Box::new(home) };
        Self::of(geometry, limits, false)
    }

    fn of(geometry: Geometry, limits: Vec<[f64; 2]>, rounded: bool) -> Result<Self> {
        let chain = Chain { geometry, base: Placement::identity(), tool: Placement::identity() };
        if !limits.is_empty() && limits.len() != chain.freedoms() {
            let (found, expected) = (limits.len(), chain.freedoms());
            return Err(Error::Invalid(format!("found limits of {found} joints, expected {expected}, or none")));
        }
        if let Some(at) = limits.iter().position(|[low, high]| !(low <= high)) {
            return Err(Error::Invalid(format!(
                "found the limits {:?} of joint {}, expected the lower one first",
                limits[at],
                at + 1
            )));
        }
        Self::new(Model::bare("arm", Design::Arm(chain), limits, rounded))
    }

    /// Returns the names of the joints in the file, in the order of every `q`.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        document::labels(&self.model.entry)
    }

    /// The number of joint variables.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.forward.freedoms()
    }

    /// The pose of the tool at these joint values.
    ///
    /// # Errors
    /// For another number of values, and for values that are not finite.
    pub fn fk(&self, q: &[f64]) -> Result<Matrix> {
        self.forward.pose(q)
    }

    /// Returns the poses of all bodies from the ground to the tool, as unit quaternions and positions; the list is empty where
    /// the joints are not drawn.
    ///
    /// # Errors
    /// As [`Arm::fk`].
    pub fn body_poses(&self, q: &[f64]) -> Result<Vec<Pose>> {
        self.forward.pose(q)?;
        Ok(self.stage.as_ref().and_then(|stage| stage.poses(q)).unwrap_or_default())
    }

    /// Six rows by the joint variables: the velocity of the origin of the tool, then its angular velocity, in the frame of
    /// the base.
    ///
    /// # Errors
    /// As [`Arm::fk`].
    pub fn jacobian(&self, q: &[f64]) -> Result<[Vec<f64>; 6]> {
        self.forward.jacobian(q)
    }

    /// The case of a pose.
    ///
    /// # Errors
    /// For a matrix that is no pose.
    #[doc(hidden)]
    pub fn case(&self, pose: &Matrix) -> Result<Case> {
        let (placement, noted) = placement(pose)?;
        let mut case = Case::at(placement, 1);
        case.warnings.extend(noted);
        Ok(case)
    }

    /// Returns every inverse-kinematics solution of a pose, the real ones only, with the verdict on their list. The first call
    /// prepares the geometry, which is kept.
    ///
    /// # Errors
    /// For a matrix that is no pose. A pose out of reach is an answer.
    pub fn ik(&self, pose: &Matrix) -> Result<Solution> {
        self.ik_with(pose, &mut Workspace::default())
    }

    /// Solves as [`Arm::ik`] does, in memory that is kept from pose to pose: a thread that solves many poses has one workspace.
    ///
    /// # Errors
    /// As [`Arm::ik`].
    pub fn ik_with(&self, pose: &Matrix, workspace: &mut Workspace) -> Result<Solution> {
        let case = self.case(pose)?;
        workspace.solver.only_real_list = true;
        workspace.solver.real_first = true;
        let mechanism = self.model.mechanism()?;
        let mut solution = mechanism.solve(&case, Roots::All, &mut workspace.solver, &mut workspace.assembly)?;
        solution.modes.retain(|mode| mode.real);
        Ok(solution)
    }

    /// Returns the document of `looproot derive --json` for a pose: the closure equations and the exact closure polynomial
    /// (`equations/derivation.schema.json`).
    ///
    /// # Errors
    /// For a matrix that is no pose, and for arms whose closure polynomial is beyond `derive`.
    pub fn derive(&self, pose: &Matrix) -> Result<Value> {
        self.model.derive(&self.case(pose)?)
    }

    /// Returns the certificate of the answer to a pose, which [`crate::verify`] and `verify/verify.py` check.
    ///
    /// # Errors
    /// For a matrix that is no pose, and [`Error::Unsupported`] with the reason for an answer of which there is no certificate.
    pub fn certificate(&self, pose: &Matrix) -> Result<Value> {
        self.model.certificate(&self.case(pose)?)
    }

    /// Solves many poses as [`Arm::ik`] does, on all threads; a bad pose does not stop the others.
    #[must_use]
    pub fn ik_batch(&self, poses: &[Matrix]) -> Vec<Result<Solution>> {
        poses.par_iter().map_init(Workspace::default, |workspace, pose| self.ik_with(pose, workspace)).collect()
    }

    /// The pose of a case as a matrix.
    #[doc(hidden)]
    #[must_use]
    pub fn matrix(case: &Case) -> Option<Matrix> {
        case.pose.as_ref().map(|pose| matrix(&pose.float))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angles_are_exact() {
        for degrees in [90.0_f64, -90.0, 0.0, 180.0, 45.0, 12.5] {
            assert_eq!(angle(degrees.to_radians()).radians(), degrees.to_radians());
        }
        assert!(angle(std::f64::consts::FRAC_PI_2).is_exact());
        assert_eq!(angle(1.2345).radians(), 1.2345);
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_pose() {
        let arm = Arm::robot("puma560").expect("an arm of the library");
        let q = [0.3, -0.7, 0.4, 1.1, 0.5, -0.2];
        let (jacobian, pose) = (arm.jacobian(&q).expect("six values"), arm.fk(&q).expect("six values"));
        for joint in 0..6 {
            let mut moved = q;
            moved[joint] += 1e-7;
            let other = arm.fk(&moved).expect("six values");
            for row in 0..3 {
                assert!(((other[row][3] - pose[row][3]) / 1e-7 - jacobian[row][joint]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_pose_from_joint_values_is_reached_by_them() {
        let arm = Arm::robot("general_16real").expect("an arm of the library");
        let q = [0.3, -0.7, 0.4, 1.1, 0.5, -0.2];
        let found = arm.ik_batch(&[arm.fk(&q).expect("six values"), [[f64::NAN; 4]; 4]]);
        assert!(found[1].is_err());
        let found = found[0].as_ref().expect("a pose");
        let near = |mode: &crate::mechanism::FullMode| mode.q.iter().zip(&q).all(|(a, b)| (a.re - b).abs() < 1e-9);
        assert_eq!(found.modes.iter().filter(|mode| near(mode)).count(), 1);
    }
}
