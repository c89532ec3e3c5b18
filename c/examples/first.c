/* Every way in which a Puma 560 reaches one pose. */
#include "looproot.h"
#include <stdio.h>

int main(void) {
    lr_arm *arm;
    lr_workspace *workspace;
    if (lr_arm_robot("puma560", &arm) != LR_STATUS_OK || lr_workspace_new(&workspace) != LR_STATUS_OK) {
        fprintf(stderr, "%s\n", lr_message());
        return 1;
    }
    const double start[6] = {0.1, -1.0, 0.5, 0.3, 0.7, -0.4};
    double pose[16], q[16 * 6]; /* an arm of six joints has at most 16 solutions, unless they form curves */
    size_t count;
    lr_arm_forward(arm, start, 6, pose);
    lr_status status = lr_arm_ik(arm, workspace, pose, q, 16, &count, NULL, NULL);
    printf("%zu solutions, %s: %s\n", count, status == LR_STATUS_OK ? "proved" : "not proved", lr_message());
    for (size_t k = 0; k < count; k++) printf("q1 = %.5f, q2 = %.5f, ...\n", q[6 * k], q[6 * k + 1]);
    lr_workspace_free(workspace);
    lr_arm_free(arm);
    return status != LR_STATUS_OK;
}
