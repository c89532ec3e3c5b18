/* Whatever a caller does wrong gives a status. Run with the address sanitizer: .ci/c does. */
#include "looproot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define EXPECT(wanted, call)                                                                      \
    do {                                                                                          \
        lr_status found_ = (call);                                                                \
        if (found_ != (wanted)) {                                                                 \
            printf("%d: %s gave %d (%s), expected %d\n", __LINE__, #call, (int)found_, lr_message(), (int)(wanted)); \
            failures++;                                                                           \
        }                                                                                         \
    } while (0)

#define HOLDS(condition)                                             \
    do {                                                             \
        if (!(condition)) {                                          \
            printf("%d: %s does not hold\n", __LINE__, #condition);  \
            failures++;                                              \
        }                                                            \
    } while (0)

static const double NOWHERE[16] = {1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* Buffers stand on the heap, each of just its size, so that the sanitizer sees one byte too much. */
static double *numbers(size_t count) {
    return (double *)malloc(count * sizeof(double) + (count == 0));
}

static void arms(void) {
    lr_arm *arm = (lr_arm *)1;
    EXPECT(LR_STATUS_INVALID, lr_arm_robot(NULL, &arm));
    HOLDS(arm == NULL);
    EXPECT(LR_STATUS_INVALID, lr_arm_robot("puma560", NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_robot("no_such_robot", &arm));
    HOLDS(arm == NULL && strlen(lr_message()) > 0);
    EXPECT(LR_STATUS_INVALID, lr_arm_robot("\xff\xfe", &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_file("no/such/file.toml", NULL, NULL, &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(NULL, 6, 0, NULL, NULL, &arm));
    double *table = numbers(24);
    for (int k = 0; k < 24; k++) table[k] = 0.1 * k;
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 0, 0, NULL, NULL, &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, (size_t)-1, 0, NULL, NULL, &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 2, NULL, NULL, &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 0, "RRR", NULL, &arm));
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 0, "RRRRRX", NULL, &arm));
    table[7] = NAN;
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 0, NULL, NULL, &arm));
    table[7] = INFINITY;
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 0, NULL, NULL, &arm));
    table[7] = 0.7;
    double *limits = numbers(12);
    for (int k = 0; k < 12; k++) limits[k] = k % 2 ? -1 : 1;
    EXPECT(LR_STATUS_INVALID, lr_arm_from_dh(table, 6, 0, NULL, limits, &arm));
    HOLDS(arm == NULL);
    lr_arm_free(NULL);
    lr_workspace_free(NULL);

    EXPECT(LR_STATUS_OK, lr_arm_robot("puma560", &arm));
    HOLDS(lr_arm_joints(arm) == 6 && lr_arm_joints(NULL) == 0);
    char *name = (char *)malloc(3);
    EXPECT(LR_STATUS_OK, lr_arm_joint_name(arm, 0, name, 3));
    HOLDS(strcmp(name, "q1") == 0);
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_joint_name(arm, 0, name, 2));
    HOLDS(strcmp(name, "q") == 0);
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_joint_name(arm, 0, name, 0));
    EXPECT(LR_STATUS_INVALID, lr_arm_joint_name(arm, 6, name, 3));
    EXPECT(LR_STATUS_INVALID, lr_arm_joint_name(arm, 0, NULL, 3));
    EXPECT(LR_STATUS_INVALID, lr_arm_joint_name(NULL, 0, name, 3));
    EXPECT(LR_STATUS_OK, lr_arm_limits(arm, limits, 12));
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_limits(arm, limits, 11));
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_limits(arm, NULL, 0));
    EXPECT(LR_STATUS_INVALID, lr_arm_limits(arm, NULL, 12));
    EXPECT(LR_STATUS_INVALID, lr_arm_limits(arm, limits, (size_t)-1));
    EXPECT(LR_STATUS_INVALID, lr_arm_limits(NULL, limits, 12));

    double *q = numbers(6), *pose = numbers(16), *jacobian = numbers(36);
    for (int k = 0; k < 6; k++) q[k] = 0.2 + 0.3 * k;
    EXPECT(LR_STATUS_OK, lr_arm_forward(arm, q, 6, pose));
    EXPECT(LR_STATUS_INVALID, lr_arm_forward(arm, q, 5, pose));
    EXPECT(LR_STATUS_INVALID, lr_arm_forward(arm, NULL, 6, pose));
    EXPECT(LR_STATUS_INVALID, lr_arm_forward(arm, q, 6, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_forward(arm, q, (size_t)-1, pose));
    EXPECT(LR_STATUS_INVALID, lr_arm_forward(NULL, q, 6, pose));
    EXPECT(LR_STATUS_OK, lr_arm_jacobian(arm, q, 6, jacobian));
    EXPECT(LR_STATUS_INVALID, lr_arm_jacobian(arm, q, 3, jacobian));
    EXPECT(LR_STATUS_INVALID, lr_arm_jacobian(arm, q, 6, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_jacobian(arm, NULL, 6, jacobian));
    EXPECT(LR_STATUS_INVALID, lr_arm_jacobian(NULL, q, 6, jacobian));
    for (int k = 0; k < 6; k++) {
        static const double UNUSABLE[] = {NAN, INFINITY, -INFINITY};
        double kept = q[k];
        for (int n = 0; n < 3; n++) {
            q[k] = UNUSABLE[n];
            EXPECT(LR_STATUS_INVALID, lr_arm_forward(arm, q, 6, pose));
            EXPECT(LR_STATUS_INVALID, lr_arm_jacobian(arm, q, 6, jacobian));
        }
        q[k] = kept;
    }

    lr_workspace *workspace = NULL;
    EXPECT(LR_STATUS_INVALID, lr_workspace_new(NULL));
    EXPECT(LR_STATUS_OK, lr_workspace_new(&workspace));
    size_t count = 77;
    lr_verdict verdict;
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_ik(arm, workspace, pose, NULL, 0, &count, NULL, &verdict));
    HOLDS(count == 8 && verdict.answer == LR_ANSWER_COMPLETE && verdict.proof == LR_PROOF_PROVED);
    double *rows = numbers(6 * count);
    lr_mode *modes = (lr_mode *)malloc(count * sizeof(lr_mode));
    EXPECT(LR_STATUS_OK, lr_arm_ik(arm, workspace, pose, rows, count, &count, modes, &verdict));
    int found = 0;
    for (size_t k = 0; k < count; k++) {
        double worst = 0;
        for (int j = 0; j < 6; j++) worst = fmax(worst, fabs(rows[6 * k + j] - q[j]));
        found += worst < 1e-9;
        HOLDS(modes[k].certified == 1 && modes[k].near == 0 && modes[k].radius < 1e-9);
    }
    HOLDS(found == 1);
    double *few = numbers(6 * 3);
    lr_mode *three = (lr_mode *)malloc(3 * sizeof(lr_mode));
    EXPECT(LR_STATUS_TRUNCATED, lr_arm_ik(arm, workspace, pose, few, 3, &count, three, NULL));
    HOLDS(count == 8 && memcmp(few, rows, 18 * sizeof(double)) == 0);
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, NULL, 3, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, rows, (size_t)-1, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, rows, (size_t)-1 / 6, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, NULL, 8, &count, modes, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, rows, 8, NULL, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, NULL, pose, rows, 8, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(NULL, workspace, pose, rows, 8, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, NULL, rows, 8, &count, NULL, NULL));
    EXPECT(LR_STATUS_UNREACHABLE, lr_arm_ik(arm, workspace, NOWHERE, rows, 8, &count, NULL, &verdict));
    HOLDS(count == 0 && verdict.answer == LR_ANSWER_UNREACHABLE);
    for (int k = 0; k < 16; k++) {
        double kept = pose[k];
        pose[k] = NAN;
        EXPECT(LR_STATUS_INVALID, lr_arm_ik(arm, workspace, pose, rows, 8, &count, NULL, NULL));
        pose[k] = 1e300;
        lr_status status = lr_arm_ik(arm, workspace, pose, rows, 8, &count, NULL, NULL);
        HOLDS(status == LR_STATUS_INVALID || status == LR_STATUS_UNREACHABLE || status == LR_STATUS_NOT_PROVED);
        pose[k] = kept;
    }
    /* The workspace is as good as before. */
    EXPECT(LR_STATUS_OK, lr_arm_ik(arm, workspace, pose, rows, 8, &count, modes, &verdict));
    lr_workspace_free(workspace);
    lr_arm_free(arm);
    free(table), free(limits), free(name), free(q), free(pose), free(jacobian), free(rows), free(modes), free(few), free(three);
}

static void platforms(void) {
    lr_platform *platform = NULL;
    double *base = numbers(18), *plate = numbers(18);
    for (int k = 0; k < 6; k++) {
        base[3 * k] = cos(k + 0.1 * k * k), base[3 * k + 1] = sin(k + 0.1 * k * k), base[3 * k + 2] = 0.1 * (k % 3);
        plate[3 * k] = 0.5 * cos(0.9 * k), plate[3 * k + 1] = 0.5 * sin(0.9 * k), plate[3 * k + 2] = 0.07 * (k % 2);
    }
    EXPECT(LR_STATUS_INVALID, lr_platform_from_points(NULL, plate, &platform));
    EXPECT(LR_STATUS_INVALID, lr_platform_from_points(base, NULL, &platform));
    EXPECT(LR_STATUS_INVALID, lr_platform_from_points(base, plate, NULL));
    base[4] = NAN;
    EXPECT(LR_STATUS_INVALID, lr_platform_from_points(base, plate, &platform));
    base[4] = 0.3;
    EXPECT(LR_STATUS_OK, lr_platform_from_points(base, plate, &platform));
    double pose[16] = {1, 0, 0, 0.1, 0, 1, 0, 0.05, 0, 0, 1, 0.9, 0, 0, 0, 1};
    double *legs = numbers(6), *poses = numbers(16 * 40);
    EXPECT(LR_STATUS_OK, lr_platform_legs(platform, pose, legs));
    EXPECT(LR_STATUS_INVALID, lr_platform_legs(platform, NULL, legs));
    EXPECT(LR_STATUS_INVALID, lr_platform_legs(platform, pose, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_legs(NULL, pose, legs));
    for (int k = 0; k < 16; k++) {
        double kept = pose[k];
        pose[k] = NAN;
        EXPECT(LR_STATUS_INVALID, lr_platform_legs(platform, pose, legs));
        pose[k] = kept;
    }
    EXPECT(LR_STATUS_OK, lr_platform_legs(platform, pose, legs));
    size_t count = 0;
    lr_verdict verdict;
    EXPECT(LR_STATUS_OK, lr_platform_poses(platform, legs, poses, 40, &count, NULL, &verdict));
    HOLDS(verdict.complex == 40 && count >= 1);
    int found = 0;
    for (size_t n = 0; n < count; n++) {
        double worst = 0;
        for (int k = 0; k < 16; k++) worst = fmax(worst, fabs(poses[16 * n + k] - pose[k]));
        found += worst < 1e-9;
    }
    HOLDS(found == 1);
    double *one = numbers(16);
    if (count > 1) EXPECT(LR_STATUS_TRUNCATED, lr_platform_poses(platform, legs, one, 1, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, legs, poses, 40, NULL, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, legs, NULL, 40, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, legs, poses, (size_t)-1, &count, NULL, NULL));
    EXPECT(LR_STATUS_TRUNCATED, lr_platform_poses(platform, legs, NULL, 0, &count, NULL, NULL));
    legs[2] = -1;
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, legs, poses, 40, &count, NULL, NULL));
    legs[2] = NAN;
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, legs, poses, 40, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(platform, NULL, poses, 40, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_poses(NULL, legs, poses, 40, &count, NULL, NULL));
    lr_platform_free(platform);
    EXPECT(LR_STATUS_INVALID, lr_platform_load(NULL, &platform));
    EXPECT(LR_STATUS_INVALID, lr_platform_load("dietmaier_40real", NULL));
    EXPECT(LR_STATUS_INVALID, lr_platform_load("puma560", &platform));
    lr_platform_free(NULL);
    HOLDS(platform == NULL);
    free(base), free(plate), free(legs), free(poses), free(one);
}

static void loops(void) {
    lr_loop *loop = NULL;
    EXPECT(LR_STATUS_INVALID, lr_loop_load(NULL, &loop));
    EXPECT(LR_STATUS_INVALID, lr_loop_load("crcrr_2_angle", NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_load("puma560", &loop));
    lr_loop_free(NULL);
    EXPECT(LR_STATUS_OK, lr_loop_load("crcrr_2_angle", &loop));
    size_t joints = lr_loop_joints(loop), count = 0;
    HOLDS(joints == 7 && lr_loop_joints(NULL) == 0);
    double *q = numbers(joints * 16);
    lr_status status = lr_loop_solve(loop, 0.7, q, 16, &count, NULL, NULL);
    HOLDS(status == LR_STATUS_OK || status == LR_STATUS_UNREACHABLE);
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(loop, NAN, q, 16, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(loop, INFINITY, q, 16, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(loop, 0.7, NULL, 16, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(loop, 0.7, q, 16, NULL, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(loop, 0.7, q, (size_t)-1, &count, NULL, NULL));
    EXPECT(LR_STATUS_INVALID, lr_loop_solve(NULL, 0.7, q, 16, &count, NULL, NULL));
    status = lr_loop_solve(loop, 0.7, NULL, 0, &count, NULL, NULL);
    HOLDS(status == (count > 0 ? LR_STATUS_TRUNCATED : LR_STATUS_UNREACHABLE));
    lr_loop_free(loop);
    free(q);
}

int main(void) {
    HOLDS(strlen(lr_version()) >= 5 && lr_message() != NULL);
    arms();
    platforms();
    loops();
    printf("%s\n", failures == 0 ? "1 passed, 0 failed" : "0 passed, 1 failed");
    return failures != 0;
}
