// Every posture in which an arm reaches a pose, and whether that is all of them.
#include "looproot.h"

#include <cstdio>
#include <memory>
#include <vector>

int main() {
    lr_arm *made = nullptr;
    if (lr_arm_robot("puma560", &made) != LR_STATUS_OK) {
        std::fprintf(stderr, "%s\n", lr_message());
        return 1;
    }
    std::unique_ptr<lr_arm, decltype(&lr_arm_free)> arm(made, lr_arm_free);
    lr_workspace *space = nullptr;
    lr_workspace_new(&space);
    std::unique_ptr<lr_workspace, decltype(&lr_workspace_free)> workspace(space, lr_workspace_free);

    const std::size_t joints = lr_arm_joints(arm.get());
    const std::vector<double> start = {0.1, -1.0, 0.5, 0.3, 0.7, -0.4};
    double pose[16];
    lr_arm_forward(arm.get(), start.data(), joints, pose);

    // An arm of six joints has at most 16 solutions at a pose, unless they form curves.
    const std::size_t room = 16;
    std::vector<double> q(room * joints);
    std::size_t count = 0;
    lr_verdict verdict;
    const lr_status status = lr_arm_ik(arm.get(), workspace.get(), pose, q.data(), room, &count, nullptr, &verdict);
    std::printf("%zu postures, %s: %s\n", count, status == LR_STATUS_OK ? "proved" : "not proved", lr_message());
    for (std::size_t k = 0; k < count && k < room; k++) {
        for (std::size_t j = 0; j < joints; j++) std::printf("%10.5f", q[k * joints + j]);
        std::printf("\n");
    }
    return status == LR_STATUS_OK ? 0 : 1;
}
