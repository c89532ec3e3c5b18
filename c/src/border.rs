//! The functions that C calls. C hands over pointers, so that this file, alone of the crate, contains unsafe code: it turns pointers
//! into references, slices and boxes once they are known not to be NULL. The obligations of the C side stand at every function.
#![allow(unsafe_code)]

use crate::answer::{LrMode, LrVerdict, Place, joint_values, plate, write};
use crate::fault::{Fault, LrStatus, guarded, said};
use looproot::internal::face::{Arm, Convention, DhRow, Loop, Matrix, Model, Platform, Workspace};
use looproot::internal::kinematics::chain::JointKind;
use std::ffi::{CStr, c_char};

/// An arm.
pub struct LrArm(Arm);

/// A closed loop with one joint given.
pub struct LrLoop(Loop);

/// A platform on six legs.
pub struct LrPlatform(Platform);

/// The memory in which one thread solves; it is kept from one pose to the next.
pub struct LrWorkspace(Workspace);

unsafe fn borrowed<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Fault> {
    // SAFETY: the caller of the library promises that it is NULL or points to such a value.
    unsafe { pointer.as_ref() }.ok_or(Fault::Null(name))
}

unsafe fn changed<'a, T>(pointer: *mut T, name: &'static str) -> Result<&'a mut T, Fault> {
    // SAFETY: as above, and nothing else uses the value meanwhile.
    unsafe { pointer.as_mut() }.ok_or(Fault::Null(name))
}

unsafe fn numbers<'a>(pointer: *const f64, count: usize, name: &'static str) -> Result<&'a [f64], Fault> {
    // A count beyond this cannot be that of numbers in memory.
    if count > isize::MAX as usize / size_of::<f64>() {
        return Err(Fault::invalid(format!("found {count} as the count of {name}, expected a smaller one")));
    }
    if pointer.is_null() {
        return Err(Fault::Null(name));
    }
    // SAFETY: the caller of the library promises that this many numbers are there.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// A buffer that may be empty, and is then not looked at.
unsafe fn buffer<'a, T>(pointer: *mut T, count: usize, name: &'static str) -> Result<&'a mut [T], Fault> {
    if count == 0 {
        return Ok(&mut []);
    }
    if count > isize::MAX as usize / size_of::<T>() {
        return Err(Fault::invalid(format!("found {count} as the size of {name}, expected a smaller one")));
    }
    if pointer.is_null() {
        return Err(Fault::Null(name));
    }
    // SAFETY: the caller of the library promises a buffer of that size that nothing else uses.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

unsafe fn matrix(pointer: *const f64) -> Result<Matrix, Fault> {
    // SAFETY: the caller of the library promises 16 numbers.
    let flat = unsafe { numbers(pointer, 16, "pose") }?;
    Ok(std::array::from_fn(|i| std::array::from_fn(|j| flat[4 * i + j])))
}

unsafe fn optional<'a>(pointer: *const c_char, name: &str) -> Result<Option<&'a str>, Fault> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller of the library promises a text that a zero byte ends.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    text.map(Some).map_err(|_| Fault::invalid(format!("found bytes that are no UTF-8 as {name}, expected UTF-8")))
}

unsafe fn text<'a>(pointer: *const c_char, name: &'static str) -> Result<&'a str, Fault> {
    // SAFETY: as there.
    unsafe { optional(pointer, name) }?.ok_or(Fault::Null(name))
}

/// Makes a value of the library and hands it over.
unsafe fn made<T>(out: *mut *mut T, make: impl FnOnce() -> Result<T, Fault>) -> LrStatus {
    guarded(|| {
        // SAFETY: the caller of the library promises a place for a pointer.
        let place = unsafe { changed(out, "out") }?;
        *place = std::ptr::null_mut();
        *place = Box::into_raw(Box::new(make()?));
        Ok(LrStatus::Ok)
    })
}

unsafe fn freed<T>(pointer: *mut T) {
    if !pointer.is_null() {
        // SAFETY: the caller of the library promises that it comes from here and is not used again.
        let value = unsafe { Box::from_raw(pointer) };
        guarded(|| {
            drop(value);
            Ok(LrStatus::Ok)
        });
    }
}

/// The version of the library, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn lr_version() -> *const c_char {
    const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(text) => text,
        Err(_) => c"",
    };
    VERSION.as_ptr()
}

/// Returns the message of the last call on this thread: the value found and the value expected, or why a list is complete. It is
/// valid until the next call on this thread, and never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn lr_message() -> *const c_char {
    said()
}

/// An arm of the library by its name, such as "puma560".
///
/// # Safety
/// `name` is NULL or a text that a zero byte ends; `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_robot(name: *const c_char, out: *mut *mut LrArm) -> LrStatus {
    // SAFETY: as promised above.
    unsafe { made(out, || Ok(LrArm(Arm::robot(text(name, "name")?)?))) }
}

/// An arm of a file: TOML, JSON, a DH table as CSV, URDF. Of a URDF the chain from `base_link` to `tip_link`; NULL takes the only
/// one there is.
///
/// # Safety
/// Texts are NULL or end with a zero byte; `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_from_file(
    path: *const c_char,
    base_link: *const c_char,
    tip_link: *const c_char,
    out: *mut *mut LrArm,
) -> LrStatus {
    let make = || {
        // SAFETY: as promised above.
        let (path, base, tip) =
            unsafe { (text(path, "path")?, optional(base_link, "base_link")?, optional(tip_link, "tip_link")?) };
        Ok(LrArm(Arm::from_urdf(path, tip, base)?))
    };
    // SAFETY: as promised above.
    unsafe { made(out, make) }
}

/// An arm by its table of `joints` rows `a, alpha, d, theta0`, with `modified` 0 for `Rz(q + theta0) Tz(d) Tx(a) Rx(alpha)` and 1
/// for Craig's convention. `kinds` has a letter R or P for every joint, or is NULL: then all are R. `limits` has two numbers for
/// every joint, or is NULL.
///
/// # Safety
/// `table` is NULL or has 4 times `joints` numbers, `limits` NULL or 2 times as many; `kinds` is NULL or ends with a zero byte;
/// `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_from_dh(
    table: *const f64,
    joints: usize,
    modified: i32,
    kinds: *const c_char,
    limits: *const f64,
    out: *mut *mut LrArm,
) -> LrStatus {
    let make = || {
        if !(1..=MOST_JOINTS).contains(&joints) {
            return Err(Fault::invalid(format!("found {joints} joints, expected 1 to {MOST_JOINTS}")));
        }
        // SAFETY: as promised above.
        let (table, kinds) = unsafe { (numbers(table, 4 * joints, "table")?, optional(kinds, "kinds")?) };
        let limits = if limits.is_null() {
            Vec::new()
        } else {
            // SAFETY: as promised above.
            let flat = unsafe { numbers(limits, 2 * joints, "limits") }?;
            flat.chunks_exact(2).map(|row| [row[0], row[1]]).collect()
        };
        let rows: Vec<DhRow> = table
            .chunks_exact(4)
            .zip(kinds_of(kinds, joints)?)
            .map(|(row, kind)| DhRow { kind, a: row[0], alpha: row[1], d: row[2], theta0: row[3] })
            .collect();
        let convention = match modified {
            0 => Convention::Dh,
            1 => Convention::ModifiedDh,
            other => return Err(Fault::invalid(format!("found {other} as modified, expected 0 or 1"))),
        };
        Ok(LrArm(Arm::from_dh(&rows, convention, limits)?))
    };
    // SAFETY: as promised above.
    unsafe { made(out, make) }
}

/// More joints than any arm that is solved.
const MOST_JOINTS: usize = 64;

fn kinds_of(letters: Option<&str>, joints: usize) -> Result<Vec<JointKind>, Fault> {
    let Some(letters) = letters else { return Ok(vec![JointKind::Revolute; joints]) };
    let kind = |letter: char| match letter {
        'R' => Ok(JointKind::Revolute),
        'P' => Ok(JointKind::Prismatic),
        other => Err(Fault::invalid(format!("found {other} in kinds, expected R or P"))),
    };
    let kinds: Vec<JointKind> = letters.chars().map(kind).collect::<Result<_, _>>()?;
    if kinds.len() == joints {
        Ok(kinds)
    } else {
        Err(Fault::invalid(format!("found {} letters in kinds, expected {joints}", kinds.len())))
    }
}

/// Frees an arm; NULL does nothing.
///
/// # Safety
/// `arm` comes from this library and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_free(arm: *mut LrArm) {
    // SAFETY: as promised above.
    unsafe { freed(arm) }
}

/// The number of joint values of an arm; 0 of NULL.
///
/// # Safety
/// `arm` is NULL or an arm.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_joints(arm: *const LrArm) -> usize {
    // SAFETY: as promised above.
    unsafe { arm.as_ref() }.map_or(0, |arm| arm.0.freedoms())
}

/// The name of joint `index`, from 0, as the file calls it. With a buffer that is too small the status is LR_STATUS_TRUNCATED.
///
/// # Safety
/// `arm` is NULL or an arm; `buffer` is NULL or has room for `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_joint_name(
    arm: *const LrArm,
    index: usize,
    buffer: *mut c_char,
    size: usize,
) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (arm, bytes) = unsafe { (borrowed(arm, "arm")?, self::buffer(buffer.cast::<u8>(), size, "buffer")?) };
        let names = arm.0.names();
        let Some(name) = names.get(index) else {
            return Err(Fault::invalid(format!("found {index} as index, expected less than {}", names.len())));
        };
        let Some(room) = size.checked_sub(1) else { return Ok(LrStatus::Truncated) };
        let mut kept = room.min(name.len());
        while !name.is_char_boundary(kept) {
            kept -= 1;
        }
        bytes[..kept].copy_from_slice(&name.as_bytes()[..kept]);
        bytes[kept] = 0;
        Ok(if kept < name.len() { LrStatus::Truncated } else { LrStatus::Ok })
    })
}

/// The limits of the joints, two numbers for each. An arm without limits gives minus and plus infinity.
///
/// # Safety
/// `arm` is NULL or an arm; `limits` is NULL or has room for `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_limits(arm: *const LrArm, limits: *mut f64, count: usize) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (arm, limits) = unsafe { (borrowed(arm, "arm")?, buffer(limits, count, "limits")?) };
        let expected = 2 * arm.0.freedoms();
        if limits.len() < expected {
            return Ok(LrStatus::Truncated);
        }
        let own = &arm.0.model.entry.limits;
        for (joint, pair) in limits[..expected].chunks_exact_mut(2).enumerate() {
            pair.copy_from_slice(own.get(joint).unwrap_or(&[f64::NEG_INFINITY, f64::INFINITY]));
        }
        Ok(LrStatus::Ok)
    })
}

/// The pose of the tool at `count` joint values.
///
/// # Safety
/// `arm` is NULL or an arm; `q` is NULL or has `count` numbers; `pose` is NULL or has room for 16.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_forward(arm: *const LrArm, q: *const f64, count: usize, pose: *mut f64) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (arm, q, pose) = unsafe { (borrowed(arm, "arm")?, numbers(q, count, "q")?, buffer(pose, 16, "pose")?) };
        pose.copy_from_slice(arm.0.fk(q)?.as_flattened());
        Ok(LrStatus::Ok)
    })
}

/// The Jacobian at `count` joint values: six rows of `count` numbers, the velocity of the origin of the tool and its angular
/// velocity, in the frame of the base.
///
/// # Safety
/// `arm` is NULL or an arm; `q` is NULL or has `count` numbers; `jacobian` is NULL or has room for 6 times as many.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_jacobian(
    arm: *const LrArm,
    q: *const f64,
    count: usize,
    jacobian: *mut f64,
) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (arm, q) = unsafe { (borrowed(arm, "arm")?, numbers(q, count, "q")?) };
        let rows = arm.0.jacobian(q)?;
        // SAFETY: as promised above; the arm has `count` joints.
        let to = unsafe { buffer(jacobian, 6 * count, "jacobian") }?;
        for (to, value) in to.iter_mut().zip(rows.iter().flatten()) {
            *to = *value;
        }
        Ok(LrStatus::Ok)
    })
}

/// A workspace for one thread.
///
/// # Safety
/// `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_workspace_new(out: *mut *mut LrWorkspace) -> LrStatus {
    // SAFETY: as promised above.
    unsafe { made(out, || Ok(LrWorkspace(Workspace::default()))) }
}

/// Frees a workspace; NULL does nothing.
///
/// # Safety
/// `workspace` comes from this library and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_workspace_free(workspace: *mut LrWorkspace) {
    // SAFETY: as promised above.
    unsafe { freed(workspace) }
}

/// Every joint position that reaches a pose. `q` has room for `capacity` rows of as many numbers as the arm has joints, `modes`
/// for as many entries; `count` becomes the number of solutions. `modes` and `verdict` may be NULL; so may `q` with a capacity
/// of 0.
///
/// # Safety
/// `arm` and `workspace` are NULL or come from this library; `pose` is NULL or has 16 numbers; buffers are NULL or have the
/// room that is said; no other thread uses the workspace meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_arm_ik(
    arm: *const LrArm,
    workspace: *mut LrWorkspace,
    pose: *const f64,
    q: *mut f64,
    capacity: usize,
    count: *mut usize,
    modes: *mut LrMode,
    verdict: *mut LrVerdict,
) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (arm, workspace, pose) =
            unsafe { (borrowed(arm, "arm")?, changed(workspace, "workspace")?, matrix(pose)?) };
        // SAFETY: as promised above.
        let place = unsafe { place(q, capacity, arm.0.freedoms(), count, modes, verdict) }?;
        let solution = arm.0.ik_with(&pose, &mut workspace.0)?;
        Ok(write(&solution, place, joint_values))
    })
}

unsafe fn place<'a>(
    rows: *mut f64,
    capacity: usize,
    width: usize,
    count: *mut usize,
    modes: *mut LrMode,
    verdict: *mut LrVerdict,
) -> Result<Place<'a>, Fault> {
    let Some(size) = capacity.checked_mul(width) else {
        return Err(Fault::invalid(format!("found {capacity} as capacity, expected a smaller one")));
    };
    // SAFETY: what the caller promises of its buffers.
    unsafe {
        Ok(Place {
            rows: buffer(rows, size, "the buffer of solutions")?,
            capacity,
            count: changed(count, "count")?,
            modes: if modes.is_null() { None } else { Some(buffer(modes, capacity, "modes")?) },
            verdict: verdict.as_mut(),
        })
    }
}

/// A loop of a file or of the library.
///
/// # Safety
/// `name` is NULL or a text that a zero byte ends; `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_loop_load(name: *const c_char, out: *mut *mut LrLoop) -> LrStatus {
    // SAFETY: as promised above.
    unsafe { made(out, || Ok(LrLoop(Loop::new(Model::load(text(name, "name")?, None, None)?)?))) }
}

/// Frees a loop; NULL does nothing.
///
/// # Safety
/// `closed` comes from this library and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_loop_free(closed: *mut LrLoop) {
    // SAFETY: as promised above.
    unsafe { freed(closed) }
}

/// The number of joint values of a loop, the given one among them; 0 of NULL.
///
/// # Safety
/// `closed` is NULL or a loop.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_loop_joints(closed: *const LrLoop) -> usize {
    // SAFETY: as promised above.
    unsafe { closed.as_ref() }.map_or(0, |closed| closed.0.freedoms())
}

/// Every assembly mode at this value of the input. Buffers are those of lr_arm_ik.
///
/// # Safety
/// `closed` is NULL or a loop; buffers are NULL or have the room that is said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_loop_solve(
    closed: *const LrLoop,
    input: f64,
    q: *mut f64,
    capacity: usize,
    count: *mut usize,
    modes: *mut LrMode,
    verdict: *mut LrVerdict,
) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let closed = unsafe { borrowed(closed, "loop") }?;
        // SAFETY: as promised above.
        let place = unsafe { place(q, capacity, closed.0.freedoms(), count, modes, verdict) }?;
        let solution = closed.0.solve(input)?;
        Ok(write(&solution, place, joint_values))
    })
}

/// A platform by the points of its base and of its plate: six points of three numbers each.
///
/// # Safety
/// `base` and `plate` are NULL or have 18 numbers; `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_platform_from_points(
    base: *const f64,
    plate: *const f64,
    out: *mut *mut LrPlatform,
) -> LrStatus {
    let make = || {
        // SAFETY: as promised above.
        let (base, plate) = unsafe { (numbers(base, 18, "base")?, numbers(plate, 18, "plate")?) };
        let points =
            |flat: &[f64]| -> [[f64; 3]; 6] { std::array::from_fn(|k| std::array::from_fn(|i| flat[3 * k + i])) };
        Ok(LrPlatform(Platform::from_points(&points(base), &points(plate))?))
    };
    // SAFETY: as promised above.
    unsafe { made(out, make) }
}

/// A platform of a file or of the library.
///
/// # Safety
/// `name` is NULL or a text that a zero byte ends; `out` is NULL or a place for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_platform_load(name: *const c_char, out: *mut *mut LrPlatform) -> LrStatus {
    // SAFETY: as promised above.
    unsafe { made(out, || Ok(LrPlatform(Platform::new(Model::load(text(name, "name")?, None, None)?)?))) }
}

/// Frees a platform; NULL does nothing.
///
/// # Safety
/// `platform` comes from this library and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_platform_free(platform: *mut LrPlatform) {
    // SAFETY: as promised above.
    unsafe { freed(platform) }
}

/// Every pose of the plate on six legs of these lengths, each as 16 numbers: `poses` has room for `capacity` of them. The other
/// buffers are those of lr_arm_ik.
///
/// # Safety
/// `platform` is NULL or a platform; `legs` is NULL or has 6 numbers; buffers are NULL or have the room that is said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_platform_poses(
    platform: *const LrPlatform,
    legs: *const f64,
    poses: *mut f64,
    capacity: usize,
    count: *mut usize,
    modes: *mut LrMode,
    verdict: *mut LrVerdict,
) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (platform, legs) = unsafe { (borrowed(platform, "platform")?, numbers(legs, 6, "legs")?) };
        // SAFETY: as promised above.
        let place = unsafe { place(poses, capacity, 16, count, modes, verdict) }?;
        let lengths: [f64; 6] = std::array::from_fn(|k| legs[k]);
        let solution = platform.0.solve(&lengths)?;
        Ok(write(&solution, place, plate))
    })
}

/// The lengths of the six legs at a pose of the plate.
///
/// # Safety
/// `platform` is NULL or a platform; `pose` is NULL or has 16 numbers; `legs` is NULL or has room for 6.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_platform_legs(platform: *const LrPlatform, pose: *const f64, legs: *mut f64) -> LrStatus {
    guarded(|| {
        // SAFETY: as promised above.
        let (platform, pose, legs) =
            unsafe { (borrowed(platform, "platform")?, matrix(pose)?, buffer(legs, 6, "legs")?) };
        legs.copy_from_slice(&platform.0.legs(&pose)?);
        Ok(LrStatus::Ok)
    })
}
