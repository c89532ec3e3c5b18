// The logic of the plugin without ROS: order by distance, turns and limits, consistency, callback, threads, wrong requests.
#include "kinematics.hpp"

#include <cstdio>
#include <random>

namespace {

int failures = 0;

#define HOLDS(condition)                                               \
    do {                                                               \
        if (!(condition)) {                                            \
            std::printf("%d: %s does not hold\n", __LINE__, #condition); \
            failures++;                                                \
        }                                                              \
    } while (0)

using looproot::Answer;
using looproot::Joint;
using looproot::Kinematics;
using looproot::Outcome;
using looproot::Pose;
using looproot::Request;

constexpr double PI = 3.14159265358979323846;

/// The quaternion x, y, z, w of a rotation.
Pose pose_of(const std::array<double, 16> &m) {
    const double trace = m[0] + m[5] + m[10];
    std::array<double, 4> q;
    if (trace > 0) {
        const double s = 2 * std::sqrt(1 + trace);
        q = {(m[9] - m[6]) / s, (m[2] - m[8]) / s, (m[4] - m[1]) / s, s / 4};
    } else if (m[0] > m[5] && m[0] > m[10]) {
        const double s = 2 * std::sqrt(1 + m[0] - m[5] - m[10]);
        q = {s / 4, (m[1] + m[4]) / s, (m[2] + m[8]) / s, (m[9] - m[6]) / s};
    } else if (m[5] > m[10]) {
        const double s = 2 * std::sqrt(1 + m[5] - m[0] - m[10]);
        q = {(m[1] + m[4]) / s, s / 4, (m[6] + m[9]) / s, (m[2] - m[8]) / s};
    } else {
        const double s = 2 * std::sqrt(1 + m[10] - m[0] - m[5]);
        q = {(m[2] + m[8]) / s, (m[6] + m[9]) / s, s / 4, (m[4] - m[1]) / s};
    }
    return {{m[3], m[7], m[11]}, q};
}

Kinematics robot(const char *name, double bound) {
    lr_arm *arm = nullptr;
    HOLDS(lr_arm_robot(name, &arm) == LR_STATUS_OK);
    std::vector<Joint> joints;
    for (std::size_t k = 0; k < lr_arm_joints(arm); k++) joints.push_back({"joint" + std::to_string(k), true, -bound, bound});
    return Kinematics(arm, joints);
}

void finds_the_seed_again(const char *name) {
    const Kinematics arm = robot(name, 2 * PI);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-PI, PI);
    for (int round = 0; round < 20; round++) {
        std::vector<double> q(arm.joints().size());
        for (double &x : q) x = angle(random);
        std::array<double, 16> target;
        HOLDS(arm.forward(q, target));
        std::vector<std::vector<double>> all;
        const Answer list = arm.all(pose_of(target), q, all);
        HOLDS(list.outcome == Outcome::Success && !all.empty());
        for (std::size_t k = 1; k < all.size(); k++) HOLDS(looproot::distance(all[k - 1], q) <= looproot::distance(all[k], q));
        for (const std::vector<double> &one : all) {
            std::array<double, 16> reached;
            HOLDS(arm.forward(one, reached));
            for (int k = 0; k < 16; k++) HOLDS(std::abs(reached[k] - target[k]) < 1e-8);
        }
        Request request;
        request.seed = q;
        const Answer nearest = arm.search(pose_of(target), request);
        HOLDS(nearest.outcome == Outcome::Success && looproot::distance(nearest.q, q) < 1e-6);

        // A seed a turn away is met a turn away, where the limits have room for it.
        for (double &x : request.seed) x = x > 0 ? x - 2 * PI : x + 2 * PI;
        const Answer turned = arm.search(pose_of(target), request);
        HOLDS(turned.outcome == Outcome::Success && looproot::distance(turned.q, request.seed) < 1e-6);

        // The callback leaves the first one: the second one is taken.
        request.seed = q;
        int calls = 0;
        request.callback = [&](const std::vector<double> &) { return ++calls == 2; };
        const Answer second = arm.search(pose_of(target), request);
        HOLDS(all.size() < 2 ? second.outcome == Outcome::NoneAccepted : second.q == all[1]);

        // Around another place there is none within the consistency limits.
        request.callback = nullptr;
        request.consistency.assign(q.size(), 1e-3);
        HOLDS(arm.search(pose_of(target), request).outcome == Outcome::Success);
        request.seed[1] += 0.5;
        request.consistency.assign(q.size(), 1e-6);
        const Answer none = arm.search(pose_of(target), request);
        HOLDS(none.outcome == Outcome::NoneAccepted && none.q.empty());
    }
}

void keeps_to_limits() {
    const std::vector<Joint> joints = {{"a", true, -1, 7}, {"b", false, 0, 2}};
    std::vector<double> q = {-0.5, 1};
    HOLDS(looproot::represented(q, {6, 0}, joints) && std::abs(q[0] - (2 * PI - 0.5)) < 1e-12 && q[1] == 1);
    q = {-0.5, 1};
    HOLDS(looproot::represented(q, {-3, 0}, joints) && q[0] == -0.5);
    q = {1.5, 1};
    HOLDS(looproot::represented(q, {60, 0}, joints) && q[0] == 1.5);
    // A prismatic joint has no turns.
    q = {0, 2 + 2 * PI};
    HOLDS(!looproot::represented(q, {0, 0}, joints));
    q = {-2, 1};
    HOLDS(looproot::represented(q, {0, 0}, joints) && std::abs(q[0] - (2 * PI - 2)) < 1e-12);
    const std::vector<Joint> narrow = {{"a", true, -1, 1}};
    q = {2};
    HOLDS(!looproot::represented(q, {0}, narrow));
}

void says_what_is_wrong() {
    const Kinematics arm = robot("puma560", PI);
    const Pose far = {{9, 0, 0}, {0, 0, 0, 1}};
    Request request;
    request.seed.assign(6, 0.1);
    const Answer unreachable = arm.search(far, request);
    HOLDS(unreachable.outcome == Outcome::NoSolution && unreachable.proved);
    Pose bad = far;
    bad.orientation = {0, 0, 0, 0};
    HOLDS(arm.search(bad, request).outcome == Outcome::Failure);
    bad.orientation = {NAN, 0, 0, 1};
    HOLDS(arm.search(bad, request).outcome == Outcome::Failure);
    bad = far;
    bad.position[1] = NAN;
    const Answer failure = arm.search(bad, request);
    HOLDS(failure.outcome == Outcome::Failure && !failure.message.empty());
    request.seed.pop_back();
    HOLDS(arm.search(far, request).outcome == Outcome::Failure);
    request.seed.assign(6, NAN);
    HOLDS(arm.search(far, request).outcome == Outcome::Failure);
    const Kinematics nothing(nullptr, {});
    HOLDS(!nothing.valid() && nothing.search(far, request).outcome == Outcome::Failure);
}

void threads_share_an_arm() {
    const Kinematics arm = robot("ur5", 2 * PI);
    const std::vector<double> q = {0.1, -1, 1.2, 0.3, 0.7, -0.4};
    std::array<double, 16> target;
    HOLDS(arm.forward(q, target));
    std::array<std::size_t, 4> found{};
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < found.size(); k++) {
        threads.emplace_back([&, k] {
            for (int round = 0; round < 5; round++) {
                std::vector<std::vector<double>> all;
                arm.all(pose_of(target), q, all);
                found[k] += all.size();
            }
        });
    }
    for (std::thread &thread : threads) thread.join();
    for (std::size_t count : found) HOLDS(count == 40);
}

}  // namespace

int main() {
    keeps_to_limits();
    says_what_is_wrong();
    for (const char *name : {"puma560", "ur5", "general_16real"}) finds_the_seed_again(name);
    threads_share_an_arm();
    std::printf("%s\n", failures == 0 ? "1 passed, 0 failed" : "0 passed, 1 failed");
    return failures != 0;
}
