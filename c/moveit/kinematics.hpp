// The logic of a kinematics plugin for MoveIt 2, without ROS: all solutions once, then the one nearest to the seed that passes the
// joint limits, the consistency limits and a callback. Angles are radians, lengths metres; quaternions are x, y, z, w.
#pragma once

#include "looproot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace looproot {

/// A pose as geometry_msgs has it.
struct Pose {
    std::array<double, 3> position;
    /// x, y, z, w
    std::array<double, 4> orientation;
};

/// The outcome of a request; the words are those of moveit_msgs::msg::MoveItErrorCodes.
enum class Outcome {
    Success,
    /// No joint position reaches the pose. `Answer::proved` says whether that is known.
    NoSolution,
    /// There are solutions, but none within the limits that the callback takes.
    NoneAccepted,
    /// Something about the request is wrong: `Answer::message` says what.
    Failure,
};

/// The answer to a request.
struct Answer {
    Outcome outcome = Outcome::Failure;
    std::vector<double> q;
    /// Whether the list of solutions behind it is proved complete.
    bool proved = false;
    std::string message;
};

/// A joint of the group.
struct Joint {
    std::string name;
    bool revolute = true;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// What is asked of a solution beside the pose.
struct Request {
    /// As many values as joints: the solution nearest to it is wanted.
    std::vector<double> seed;
    /// How far each joint may be from the seed; empty for as far as it likes.
    std::vector<double> consistency;
    /// Takes a solution or leaves it: collisions and constraints.
    std::function<bool(const std::vector<double> &)> callback;
};

/// The largest move of a single joint. The sum of the moves would prefer one joint that flips by half a turn.
inline double distance(const std::vector<double> &a, const std::vector<double> &b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); k++) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

/// The homogeneous matrix of a pose; false where the quaternion is no rotation.
inline bool matrix(const Pose &pose, std::array<double, 16> &out) {
    auto [x, y, z, w] = pose.orientation;
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    // NaN fails as well.
    if (!(std::abs(norm - 1) < 1e-3)) return false;
    x /= norm, y /= norm, z /= norm, w /= norm;
    out = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), pose.position[0],
           2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), pose.position[1],
           2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), pose.position[2],
           0, 0, 0, 1};
    return true;
}

/// The representatives of a solution that is nearest to the seed within the limits; false where a joint has none.
/// A revolute joint may stand in another turn, a prismatic joint stays as it is.
inline bool represented(std::vector<double> &q, const std::vector<double> &seed, const std::vector<Joint> &joints) {
    constexpr double turn = 2 * 3.14159265358979323846;
    // A solution on a limit is within it.
    constexpr double slack = 1e-9;
    for (std::size_t k = 0; k < q.size(); k++) {
        const Joint &joint = joints[k];
        if (joint.revolute) {
            double best = q[k] + turn * std::round((seed[k] - q[k]) / turn);
            // The nearest turn may be beyond a limit: then the last one before it.
            if (best > joint.upper + slack) best -= turn * std::ceil((best - joint.upper - slack) / turn);
            if (best < joint.lower - slack) best += turn * std::ceil((joint.lower - slack - best) / turn);
            q[k] = best;
        }
        if (!(q[k] >= joint.lower - slack && q[k] <= joint.upper + slack)) return false;
        q[k] = std::min(std::max(q[k], joint.lower), joint.upper);
    }
    return true;
}

/// An arm with the joints of a group. Methods may be called from several threads.
class Kinematics {
  public:
    /// Takes the arm over. `joints` are those of the group, in the order of the chain; their limits are those of the robot model.
    Kinematics(lr_arm *arm, std::vector<Joint> joints) : arm_(arm, lr_arm_free), joints_(std::move(joints)) {
        if (!arm_ || lr_arm_joints(arm_.get()) != joints_.size()) joints_.clear();
    }

    /// Whether there is an arm with as many joints as were named.
    bool valid() const { return !joints_.empty(); }

    const std::vector<Joint> &joints() const { return joints_; }

    /// The pose of the tip link in the base link.
    bool forward(const std::vector<double> &q, std::array<double, 16> &pose) const {
        return lr_arm_forward(arm_.get(), q.data(), q.size(), pose.data()) == LR_STATUS_OK;
    }

    /// Every solution within the limits, the nearest to the seed first. No seed is all zeros.
    Answer all(const Pose &pose, std::vector<double> seed, std::vector<std::vector<double>> &found) const {
        found.clear();
        Answer answer;
        if (seed.empty()) seed.assign(joints_.size(), 0);
        std::array<double, 16> wanted;
        if (!checked(pose, seed, {}, wanted, answer)) return answer;
        std::vector<std::vector<double>> solutions;
        const lr_status status = solve(wanted, solutions, answer);
        if (answer.outcome == Outcome::Failure && !answer.message.empty()) return answer;
        for (std::vector<double> &q : solutions) {
            if (represented(q, seed, joints_)) found.push_back(q);
        }
        sort(found, seed);
        answer.proved = status == LR_STATUS_OK || status == LR_STATUS_UNREACHABLE;
        answer.outcome = solutions.empty() ? Outcome::NoSolution : found.empty() ? Outcome::NoneAccepted : Outcome::Success;
        if (!found.empty()) answer.q = found.front();
        return answer;
    }

    /// The solution nearest to the seed that passes the limits, the consistency limits and the callback.
    Answer search(const Pose &pose, const Request &request) const {
        std::vector<std::vector<double>> found;
        std::array<double, 16> wanted;
        Answer answer;
        if (!checked(pose, request.seed, request.consistency, wanted, answer)) return answer;
        answer = all(pose, request.seed, found);
        if (answer.outcome != Outcome::Success) return answer;
        answer.q.clear();
        answer.outcome = Outcome::NoneAccepted;
        for (const std::vector<double> &q : found) {
            if (!consistent(q, request)) continue;
            if (request.callback && !request.callback(q)) continue;
            answer.q = q;
            answer.outcome = Outcome::Success;
            return answer;
        }
        return answer;
    }

  private:
    bool checked(const Pose &pose, const std::vector<double> &seed, const std::vector<double> &consistency,
                 std::array<double, 16> &wanted, Answer &answer) const {
        const auto wrong = [&](const std::string &message) {
            answer.outcome = Outcome::Failure;
            answer.message = message;
            return false;
        };
        if (!valid()) return wrong("found no arm with the joints of the group, expected one");
        if (seed.size() != joints_.size()) {
            return wrong("found a seed of " + std::to_string(seed.size()) + " values, expected " + std::to_string(joints_.size()));
        }
        if (!std::all_of(seed.begin(), seed.end(), [](double x) { return std::isfinite(x); })) {
            return wrong("found a seed that is not finite, expected numbers");
        }
        if (!consistency.empty() && consistency.size() != joints_.size()) return wrong("found consistency limits of another number than joints");
        if (!matrix(pose, wanted)) return wrong("found a quaternion that is no rotation, expected x, y, z, w of length 1");
        return true;
    }

    lr_status solve(const std::array<double, 16> &pose, std::vector<std::vector<double>> &solutions, Answer &answer) const {
        lr_workspace *workspace = own();
        // As many as an arm of six joints has; a list that is longer is asked for again.
        std::size_t room = 16, count = 0;
        std::vector<double> rows;
        lr_status status = LR_STATUS_TRUNCATED;
        for (int round = 0; round < 2 && status == LR_STATUS_TRUNCATED; round++) {
            rows.resize(room * joints_.size());
            status = lr_arm_ik(arm_.get(), workspace, pose.data(), rows.data(), room, &count, nullptr, nullptr);
            room = std::max(room, count);
        }
        answer.message.clear();
        if (status == LR_STATUS_INVALID || status == LR_STATUS_UNSUPPORTED || status == LR_STATUS_PANIC) {
            answer.outcome = Outcome::Failure;
            answer.message = lr_message();
            return status;
        }
        for (std::size_t k = 0; k < count; k++) {
            solutions.emplace_back(rows.begin() + k * joints_.size(), rows.begin() + (k + 1) * joints_.size());
        }
        return status;
    }

    bool consistent(const std::vector<double> &q, const Request &request) const {
        for (std::size_t k = 0; k < request.consistency.size(); k++) {
            if (!(std::abs(q[k] - request.seed[k]) <= request.consistency[k])) return false;
        }
        return true;
    }

    static void sort(std::vector<std::vector<double>> &list, const std::vector<double> &seed) {
        std::stable_sort(list.begin(), list.end(), [&](const std::vector<double> &a, const std::vector<double> &b) {
            return distance(a, seed) < distance(b, seed);
        });
    }

    /// The workspace of this thread.
    lr_workspace *own() const {
        const std::lock_guard<std::mutex> guard(mutex_);
        auto &place = workspaces_[std::this_thread::get_id()];
        if (!place) {
            lr_workspace *made = nullptr;
            lr_workspace_new(&made);
            place = Workspace(made, lr_workspace_free);
        }
        return place.get();
    }

    using Workspace = std::unique_ptr<lr_workspace, void (*)(lr_workspace *)>;
    struct Empty : Workspace {
        Empty() : Workspace(nullptr, lr_workspace_free) {}
        using Workspace::operator=;
    };

    std::unique_ptr<lr_arm, void (*)(lr_arm *)> arm_;
    std::vector<Joint> joints_;
    mutable std::mutex mutex_;
    mutable std::unordered_map<std::thread::id, Empty> workspaces_;
};

}  // namespace looproot
