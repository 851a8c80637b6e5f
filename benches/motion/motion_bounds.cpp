#include "motion_bounds.hpp"

#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace {

const int parts = 64;

double length_of(const double *vector) { return std::hypot(vector[0], vector[1], vector[2]); }

using Corners = std::vector<std::array<double, 3>>;

Corners corners_of(const cstk::Body &body) {
    const cstk_body_statistics statistics = body.statistics();
    Corners made;
    for (std::size_t i = 0; i < 8; ++i) {
        std::array<double, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = (i >> k & 1) ? statistics.high[k] : statistics.low[k];
        }
        made.push_back(corner);
    }
    return made;
}

} // namespace

LeverArms::LeverArms(const cstk::Robot &robot) {
    for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
        const cstk_link_info info = robot.link_info(link);
        const double arm[3] = {info.at[3], info.at[7], info.at[11]};
        joints_.push_back({info.parent, info.joint, info.coordinate, info.velocity,
                           info.multiplier, info.offset, length_of(arm),
                           info.has_body ? radius_of(robot.body(link)) : 0});
    }
}

// Parents have lower numbers; -1 is the world.
std::int32_t LeverArms::common_ancestor(std::int32_t a, std::int32_t b) const {
    while (a != b) {
        std::int32_t &later = a > b ? a : b;
        later = joints_[static_cast<std::size_t>(later)].parent;
    }
    return a;
}

double LeverArms::up_to(std::int32_t link, std::int32_t end, const Numbers &q0,
                        const Numbers &v) const {
    double bound = 0;
    double extent = joints_[static_cast<std::size_t>(link)].radius;
    while (link != end) {
        const Joint &joint = joints_[static_cast<std::size_t>(link)];
        const double *rate = v.data() + joint.velocity;
        switch (joint.kind) {
        case CSTK_JOINT_FIXED:
            break;
        case CSTK_JOINT_REVOLUTE:
            bound += std::fabs(joint.multiplier * rate[0]) * extent;
            break;
        case CSTK_JOINT_PRISMATIC: {
            const double from = joint.multiplier * q0[joint.coordinate] + joint.offset,
                         change = joint.multiplier * rate[0];
            bound += std::fabs(change);
            extent += std::max(std::fabs(from), std::fabs(from + change));
            break;
        }
        case CSTK_JOINT_FREE:
            bound += length_of(rate) + length_of(rate + 3) * extent;
            break;
        default:
            throw std::runtime_error("a joint whose lever arms are not known");
        }
        extent += joint.arm;
        link = joint.parent;
    }
    return bound;
}

double LeverArms::bound(std::uint32_t link, std::optional<std::uint32_t> other, const Numbers &q0,
                        const Numbers &v) const {
    const auto one = static_cast<std::int32_t>(link);
    if (!other) {
        return up_to(one, -1, q0, v);
    }
    const auto two = static_cast<std::int32_t>(*other);
    const std::int32_t end = common_ancestor(one, two);
    return up_to(one, end, q0, v) + up_to(two, end, q0, v);
}

double highest_speed(const Scene &scene, const Ends &ends) {
    std::vector<Corners> corners;
    for (const std::uint32_t link : scene.moving) {
        corners.push_back(corners_of(scene.robot.body(link)));
    }
    double fastest = 0;
    std::vector<Corners> last;
    for (int i = 0; i <= parts; ++i) {
        const Numbers q =
            scene.space.interpolate(ends.q0, ends.q1, static_cast<double>(i) / parts);
        const std::vector<cstk::Pose> poses = scene.space.link_poses(q);
        std::vector<Corners> placed = corners;
        for (std::size_t k = 0; k < placed.size(); ++k) {
            for (std::size_t corner = 0; corner < 8; ++corner) {
                auto &point = placed[k][corner];
                point = cstk::transform_point(poses[scene.moving[k]], point);
                if (i > 0) {
                    const auto &before = last[k][corner];
                    fastest = std::max(fastest, std::hypot(point[0] - before[0],
                                                           point[1] - before[1],
                                                           point[2] - before[2]));
                }
            }
        }
        last = std::move(placed);
    }
    return parts * fastest;
}
