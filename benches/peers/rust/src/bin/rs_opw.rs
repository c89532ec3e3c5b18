//! rs-opw-kinematics: answers the arms with an ortho-parallel base and a spherical wrist.
//!
//! ```sh
//! looproot bench accuracy --set robots --count 20 --export problems.jsonl
//! cargo run --release --manifest-path benches/peers/rust/Cargo.toml --bin rs_opw -- problems.jsonl rs_opw.jsonl
//! looproot bench score rs_opw.jsonl
//! ```

use answers::{Arm, NEAR};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use std::error::Error;

/// A frame by its axes and its origin.
fn frame(axes: [Vector3<f64>; 3], origin: Vector3<f64>) -> Isometry3<f64> {
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&axes));
    Isometry3::from_parts(Translation3::from(origin), UnitQuaternion::from_rotation_matrix(&rotation))
}

/// Returns the solver and the pose that it is to reach; `None` for another geometry. The base frame has its z axis in axis 1 and
/// its y axis along axis 2 when all joint variables are 0, the frame of the tool stands in the centre of the wrist: c1 = c4 = 0.
fn solver(arm: &Arm) -> Option<(OPWKinematics, Pose)> {
    let [first, second, third, fourth, fifth, sixth] = arm.directions;
    let right = |u: &Vector3<f64>, v: &Vector3<f64>| u.dot(v).abs() < NEAR;
    let fits = arm.are_parallel(1, 2)
        && [(&first, &second), (&third, &fourth), (&fourth, &fifth), (&fifth, &sixth)].iter().all(|(u, v)| right(u, v));
    let wrist = arm.wrist().filter(|_| fits)?;
    let across = second.cross(&first);
    let origin = arm.points[0] + first * (arm.points[1] - arm.points[0]).dot(&first);
    let base = frame([across, second, first], origin);
    let shown = |point: Vector3<f64>| base.inverse_transform_vector(&(point - origin));
    let turned = |direction: Vector3<f64>| base.inverse_transform_vector(&direction);
    let (shoulder, elbow, centre) = (shown(arm.points[1]), shown(arm.points[2]), shown(wrist));
    let (x, z) = (elbow.x - shoulder.x, elbow.z - shoulder.z);
    let forearm = turned(fourth);
    let (to, from_upper) = (centre - elbow, x.atan2(z));
    let side = Vector3::new(forearm.z, 0.0, -forearm.x);
    // The angles of the solver when the joint variables are 0, from axis to axis.
    let (fifth_turned, sixth_turned) = (turned(fifth), turned(sixth));
    let third_angle = forearm.x.atan2(forearm.z) - from_upper;
    let fourth_angle = (-fifth_turned.dot(&side)).atan2(fifth_turned.y);
    let front = side * fourth_angle.cos() + Vector3::y() * fourth_angle.sin();
    let fifth_angle = sixth_turned.dot(&front).atan2(sixth_turned.dot(&forearm));
    let same_way = second.dot(&third) > 0.0;
    let parameters = Parameters {
        a1: shoulder.x,
        a2: to.dot(&side),
        b: centre.y,
        c1: 0.0,
        c2: x.hypot(z),
        c3: to.dot(&forearm),
        c4: 0.0,
        offsets: [0.0, -from_upper, -third_angle, -fourth_angle, -fifth_angle, 0.0],
        sign_corrections: [1, 1, if same_way { 1 } else { -1 }, 1, 1, 1],
        dof: 6,
    };
    let hand = frame([fifth.cross(&sixth), fifth, sixth], wrist);
    let wanted = base.inverse() * arm.pose * arm.home.inverse() * hand;
    let (q, p) = (wanted.rotation, wanted.translation.vector);
    let pose = Pose::from_parts(DVec3::new(p.x, p.y, p.z), DQuat::from_xyzw(q.i, q.j, q.k, q.w));
    Some((OPWKinematics::new(parameters), pose))
}

fn main() -> Result<(), Box<dyn Error>> {
    answers::answer("rs-opw-kinematics 3.0.0", |arm| {
        let (solver, pose) = solver(arm)?;
        Some(move || solver.inverse(&pose))
    })
}
