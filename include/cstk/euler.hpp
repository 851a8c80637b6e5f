/* Part of cstk.hpp: yaw, pitch, roll and their rates. */
#ifndef CSTK_EULER_HPP
#define CSTK_EULER_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>

#include <array>
#include <vector>

namespace cstk {

/// 9 doubles, row-major.
using Matrix3 = std::array<double, 9>;

[[nodiscard]] inline Matrix3 euler_to_rotation(const std::array<double, 3> &yaw_pitch_roll) {
    Matrix3 rotation;
    check(cstk_euler_to_rotation(yaw_pitch_roll.data(), rotation.data()));
    return rotation;
}

[[nodiscard]] inline std::array<double, 3> euler_from_rotation(const Matrix3 &rotation) {
    std::array<double, 3> yaw_pitch_roll;
    check(cstk_euler_from_rotation(rotation.data(), yaw_pitch_roll.data()));
    return yaw_pitch_roll;
}

[[nodiscard]] inline Matrix3 euler_rates(const std::array<double, 3> &yaw_pitch_roll,
                           cstk_angular_frame frame = CSTK_ANGULAR_WORLD) {
    Matrix3 matrix;
    check(cstk_euler_rates(yaw_pitch_roll.data(), frame, matrix.data()));
    return matrix;
}

[[nodiscard]] inline Matrix3 euler_rates_inverse(const std::array<double, 3> &yaw_pitch_roll,
                                   cstk_angular_frame frame = CSTK_ANGULAR_WORLD) {
    Matrix3 matrix;
    check(cstk_euler_rates_inverse(yaw_pitch_roll.data(), frame, matrix.data()));
    return matrix;
}

/// From a basic Jacobian, 6 rows, to that of x, y, z, yaw, pitch, roll.
[[nodiscard]] inline std::vector<double> jacobian_to_euler(const std::array<double, 3> &yaw_pitch_roll,
                                             std::vector<double> jacobian) {
    check(cstk_jacobian_to_euler(yaw_pitch_roll.data(), jacobian.data(),
                                 detail::columns(jacobian)));
    return jacobian;
}

[[nodiscard]] inline std::vector<double> jacobian_from_euler(const std::array<double, 3> &yaw_pitch_roll,
                                               std::vector<double> jacobian) {
    check(cstk_jacobian_from_euler(yaw_pitch_roll.data(), jacobian.data(),
                                   detail::columns(jacobian)));
    return jacobian;
}

} // namespace cstk

#endif
