/* looproot: every way to assemble an arm, a closed linkage or a platform, with a verdict on whether the list is complete.
 *
 * Angles are radians, lengths metres. A pose is a homogeneous 4 by 4 matrix, row by row: 16 numbers.
 * Every function that can fail returns a status. NULL, NaN and buffers that are too small give a status and never a crash;
 * lr_message() says in words what was found and what was expected. No exception and no panic leaves the library.
 *
 * An arm, a loop or a platform may be used by several threads at once, a workspace by one at a time.
 *
 * Written by cbindgen from c/src: LOOPROOT_BLESS=1 cargo test -p looproot-c-header. */


#ifndef LOOPROOT_H
#define LOOPROOT_H

#include <stddef.h>
#include <stdint.h>

// The status that a function returns. The first five are the exit codes of the command line.
typedef enum lr_status {
  // Answered and proved.
  LR_STATUS_OK = 0,
  // A bad argument: NULL, a number that is not finite, a matrix that is no pose, a file that cannot be read.
  LR_STATUS_INVALID = 1,
  // Answered, but not proved complete, or the solutions form curves.
  LR_STATUS_NOT_PROVED = 2,
  // No real solution, and that is proved.
  LR_STATUS_UNREACHABLE = 3,
  // A mechanism beyond what is implemented.
  LR_STATUS_UNSUPPORTED = 4,
  // The buffer is too small: it is full, and the count is the number of all solutions.
  LR_STATUS_TRUNCATED = 5,
  // A fault of the library: please report it.
  LR_STATUS_PANIC = 6,
} lr_status;

// The verdict in one word.
typedef enum lr_answer {
  // Every solution is listed.
  LR_ANSWER_COMPLETE = 0,
  // Something may be missing.
  LR_ANSWER_INCOMPLETE = 1,
  // No solution is real.
  LR_ANSWER_UNREACHABLE = 2,
  // The solutions form a curve or more.
  LR_ANSWER_SELF_MOTION = 3,
  // Beyond what is implemented.
  LR_ANSWER_UNSUPPORTED = 4,
} lr_answer;

// The kind of proof of an answer.
typedef enum lr_proof {
  // Nothing but measurement.
  LR_PROOF_NONE = 0,
  // A theorem whose assumptions were checked.
  LR_PROOF_PROVED = 1,
  // A count modulo primes that were drawn.
  LR_PROOF_PROBABLE = 2,
  // A theorem about the rounded numbers only.
  LR_PROOF_ROUNDED_DATA = 3,
} lr_proof;

// An arm.
typedef struct lr_arm lr_arm;

// A closed loop with one joint given.
typedef struct lr_loop lr_loop;

// A platform on six legs.
typedef struct lr_platform lr_platform;

// The memory in which one thread solves; it is kept from one pose to the next.
typedef struct lr_workspace lr_workspace;

// One solution.
typedef struct lr_mode {
  // An error bound of every joint value, radians and metres; infinite where it is not certified.
  double radius;
  // The condition number of the Jacobian.
  double condition;
  // 1 where it is proved that exactly one solution lies within the radius, else 0.
  uint8_t certified;
  // 1 where it reaches the pose within the tolerance of 1e-9 only, else 0.
  uint8_t near;
  // 1 within the joint limits, 0 beyond them, -1 where there are none.
  int8_t within_limits;
} lr_mode;

// The verdict on a list.
typedef struct lr_verdict {
  // The outcome.
  enum lr_answer answer;
  // Its proof.
  enum lr_proof proof;
  // Isolated real solutions, with multiplicity.
  size_t real;
  // Isolated complex solutions that were found, with multiplicity, the real ones among them.
  size_t complex;
  // The dimension of the self-motion, 0 if there is none.
  size_t self_motion;
} lr_verdict;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, such as "0.1.0".
const char *lr_version(void);

// Returns the message of the last call on this thread: the value found and the value expected, or why a list is complete. It is
// valid until the next call on this thread, and never NULL.
const char *lr_message(void);

// An arm of the library by its name, such as "puma560".
//
// Promised by the caller:
// name is NULL or a text that a zero byte ends; out is NULL or a place for a pointer.
enum lr_status lr_arm_robot(const char *name, struct lr_arm **out);

// An arm of a file: TOML, JSON, a DH table as CSV, URDF. Of a URDF the chain from base_link to tip_link; NULL takes the only
// one there is.
//
// Promised by the caller:
// Texts are NULL or end with a zero byte; out is NULL or a place for a pointer.
enum lr_status lr_arm_from_file(const char *path,
                                const char *base_link,
                                const char *tip_link,
                                struct lr_arm **out);

// An arm by its table of joints rows a, alpha, d, theta0, with modified 0 for Rz(q + theta0) Tz(d) Tx(a) Rx(alpha) and 1
// for Craig's convention. kinds has a letter R or P for every joint, or is NULL: then all are R. limits has two numbers for
// every joint, or is NULL.
//
// Promised by the caller:
// table is NULL or has 4 times joints numbers, limits NULL or 2 times as many; kinds is NULL or ends with a zero byte;
// out is NULL or a place for a pointer.
enum lr_status lr_arm_from_dh(const double *table,
                              size_t joints,
                              int32_t modified,
                              const char *kinds,
                              const double *limits,
                              struct lr_arm **out);

// Frees an arm; NULL does nothing.
//
// Promised by the caller:
// arm comes from this library and is not used afterwards.
void lr_arm_free(struct lr_arm *arm);

// The number of joint values of an arm; 0 of NULL.
//
// Promised by the caller:
// arm is NULL or an arm.
size_t lr_arm_joints(const struct lr_arm *arm);

// The name of joint index, from 0, as the file calls it. With a buffer that is too small the status is LR_STATUS_TRUNCATED.
//
// Promised by the caller:
// arm is NULL or an arm; buffer is NULL or has room for size bytes.
enum lr_status lr_arm_joint_name(const struct lr_arm *arm,
                                 size_t index,
                                 char *buffer,
                                 size_t size);

// The limits of the joints, two numbers for each. An arm without limits gives minus and plus infinity.
//
// Promised by the caller:
// arm is NULL or an arm; limits is NULL or has room for count numbers.
enum lr_status lr_arm_limits(const struct lr_arm *arm,
                             double *limits,
                             size_t count);

// The pose of the tool at count joint values.
//
// Promised by the caller:
// arm is NULL or an arm; q is NULL or has count numbers; pose is NULL or has room for 16.
enum lr_status lr_arm_forward(const struct lr_arm *arm,
                              const double *q,
                              size_t count,
                              double *pose);

// The Jacobian at count joint values: six rows of count numbers, the velocity of the origin of the tool and its angular
// velocity, in the frame of the base.
//
// Promised by the caller:
// arm is NULL or an arm; q is NULL or has count numbers; jacobian is NULL or has room for 6 times as many.
enum lr_status lr_arm_jacobian(const struct lr_arm *arm,
                               const double *q,
                               size_t count,
                               double *jacobian);

// A workspace for one thread.
//
// Promised by the caller:
// out is NULL or a place for a pointer.
enum lr_status lr_workspace_new(struct lr_workspace **out);

// Frees a workspace; NULL does nothing.
//
// Promised by the caller:
// workspace comes from this library and is not used afterwards.
void lr_workspace_free(struct lr_workspace *workspace);

// Every joint position that reaches a pose. q has room for capacity rows of as many numbers as the arm has joints, modes
// for as many entries; count becomes the number of solutions. modes and verdict may be NULL; so may q with a capacity
// of 0.
//
// Promised by the caller:
// arm and workspace are NULL or come from this library; pose is NULL or has 16 numbers; buffers are NULL or have the
// room that is said; no other thread uses the workspace meanwhile.
enum lr_status lr_arm_ik(const struct lr_arm *arm,
                         struct lr_workspace *workspace,
                         const double *pose,
                         double *q,
                         size_t capacity,
                         size_t *count,
                         struct lr_mode *modes,
                         struct lr_verdict *verdict);

// A loop of a file or of the library.
//
// Promised by the caller:
// name is NULL or a text that a zero byte ends; out is NULL or a place for a pointer.
enum lr_status lr_loop_load(const char *name, struct lr_loop **out);

// Frees a loop; NULL does nothing.
//
// Promised by the caller:
// closed comes from this library and is not used afterwards.
void lr_loop_free(struct lr_loop *closed);

// The number of joint values of a loop, the given one among them; 0 of NULL.
//
// Promised by the caller:
// closed is NULL or a loop.
size_t lr_loop_joints(const struct lr_loop *closed);

// Every assembly mode at this value of the input. Buffers are those of lr_arm_ik.
//
// Promised by the caller:
// closed is NULL or a loop; buffers are NULL or have the room that is said.
enum lr_status lr_loop_solve(const struct lr_loop *closed,
                             double input,
                             double *q,
                             size_t capacity,
                             size_t *count,
                             struct lr_mode *modes,
                             struct lr_verdict *verdict);

// A platform by the points of its base and of its plate: six points of three numbers each.
//
// Promised by the caller:
// base and plate are NULL or have 18 numbers; out is NULL or a place for a pointer.
enum lr_status lr_platform_from_points(const double *base,
                                       const double *plate,
                                       struct lr_platform **out);

// A platform of a file or of the library.
//
// Promised by the caller:
// name is NULL or a text that a zero byte ends; out is NULL or a place for a pointer.
enum lr_status lr_platform_load(const char *name, struct lr_platform **out);

// Frees a platform; NULL does nothing.
//
// Promised by the caller:
// platform comes from this library and is not used afterwards.
void lr_platform_free(struct lr_platform *platform);

// Every pose of the plate on six legs of these lengths, each as 16 numbers: poses has room for capacity of them. The other
// buffers are those of lr_arm_ik.
//
// Promised by the caller:
// platform is NULL or a platform; legs is NULL or has 6 numbers; buffers are NULL or have the room that is said.
enum lr_status lr_platform_poses(const struct lr_platform *platform,
                                 const double *legs,
                                 double *poses,
                                 size_t capacity,
                                 size_t *count,
                                 struct lr_mode *modes,
                                 struct lr_verdict *verdict);

// The lengths of the six legs at a pose of the plate.
//
// Promised by the caller:
// platform is NULL or a platform; pose is NULL or has 16 numbers; legs is NULL or has room for 6.
enum lr_status lr_platform_legs(const struct lr_platform *platform,
                                const double *pose,
                                double *legs);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* LOOPROOT_H */
