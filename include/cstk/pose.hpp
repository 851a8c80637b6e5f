/* Part of cstk.hpp: rigid poses. */
#ifndef CSTK_POSE_HPP
#define CSTK_POSE_HPP

#include <cstk.h>
#include <cstk/error.hpp>

#include <array>

namespace cstk {

/// 12 doubles, row-major [R | t], from child to parent frame.
using Pose = std::array<double, 12>;

[[nodiscard]] inline Pose identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; }

[[nodiscard]] inline Pose translation(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}; }

/// The report's placement: x, y, z, yaw, pitch, roll.
[[nodiscard]] inline Pose pose_from_euler(const std::array<double, 6> &xyz_ypr) {
    Pose pose;
    check(cstk_pose_from_euler(xyz_ypr.data(), pose.data()));
    return pose;
}

/// As URDF and ROS have it: x, y, z, roll, pitch, yaw, about fixed axes.
[[nodiscard]] inline Pose pose_from_rpy(const std::array<double, 6> &xyz_rpy) {
    Pose pose;
    check(cstk_pose_from_rpy(xyz_rpy.data(), pose.data()));
    return pose;
}

/// x, y, z, and the unit quaternion x, y, z, w.
[[nodiscard]] inline Pose pose_from_quaternion(const std::array<double, 7> &xyz_quaternion) {
    Pose pose;
    check(cstk_pose_from_quaternion(xyz_quaternion.data(), pose.data()));
    return pose;
}

[[nodiscard]] inline std::array<double, 6> pose_to_euler(const Pose &pose) {
    std::array<double, 6> xyz_ypr;
    check(cstk_pose_to_euler(pose.data(), xyz_ypr.data()));
    return xyz_ypr;
}

[[nodiscard]] inline Pose compose(const Pose &a, const Pose &b) {
    Pose out;
    check(cstk_pose_compose(a.data(), b.data(), out.data()));
    return out;
}

[[nodiscard]] inline Pose pose_inverse(const Pose &pose) {
    Pose out;
    check(cstk_pose_inverse(pose.data(), out.data()));
    return out;
}

[[nodiscard]] inline std::array<double, 3> transform_point(const Pose &pose, const std::array<double, 3> &point) {
    std::array<double, 3> out;
    check(cstk_pose_transform_point(pose.data(), point.data(), out.data()));
    return out;
}

/// x, y, z, and the unit quaternion x, y, z, w.
[[nodiscard]] inline std::array<double, 7> pose_to_quaternion(const Pose &pose) {
    std::array<double, 7> xyz_quaternion;
    check(cstk_pose_to_quaternion(pose.data(), xyz_quaternion.data()));
    return xyz_quaternion;
}

} // namespace cstk

#endif
