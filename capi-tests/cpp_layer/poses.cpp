#include "check.hpp"
#include "subjects.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

void poses() {
    const std::array<double, 6> placement = {1, 2, 3, 0.1, 0.2, 0.3};
    const std::array<double, 6> again = cstk::pose_to_euler(cstk::pose_from_euler(placement));
    for (int i = 0; i < 6; ++i) {
        REQUIRE(std::fabs(placement[i] - again[i]) < 1e-14);
    }
    const cstk::Pose quarter = cstk::pose_from_rpy({1, 2, 3, 0, 0, std::acos(0.0)});
    REQUIRE(std::fabs(quarter[1] + 1) < 1e-15 && std::fabs(quarter[4] - 1) < 1e-15 && quarter[11] == 3);
    REQUIRE(cstk::pose_from_quaternion({1, 2, 3, 0, 0, 0, 1}) == cstk::translation(1, 2, 3));
    REQUIRE(cstk::compose(cstk::translation(1, 2, 3), cstk::translation(1, 0, 0)) ==
            cstk::translation(2, 2, 3));
    REQUIRE(cstk::pose_inverse(cstk::translation(1, 2, 3)) == cstk::translation(-1, -2, -3));
    const std::array<double, 3> point = {3, 2, 1};
    REQUIRE((cstk::transform_point(cstk::translation(1, 2, 3), point) ==
             std::array<double, 3>{4, 4, 4}));
    REQUIRE((cstk::pose_to_quaternion(cstk::translation(1, 2, 3)) ==
             std::array<double, 7>{1, 2, 3, 0, 0, 0, 1}));
    cstk::Pose sheared = cstk::identity();
    sheared[1] = 0.5;
    REQUIRE(status_of([&] { return cstk::pose_inverse(sheared); }) == CSTK_ERROR_NOT_A_ROTATION);
    REQUIRE(status_of([&] { return cstk::pose_to_quaternion(sheared); }) == CSTK_ERROR_NOT_A_ROTATION);
    REQUIRE(status_of([&] { return cstk::transform_point(sheared, point); }) == CSTK_ERROR_NOT_A_ROTATION);
}

void euler_angles() {
    const std::array<double, 3> angles = {0.1, 0.2, 0.3};
    const std::array<double, 3> again = cstk::euler_from_rotation(cstk::euler_to_rotation(angles));
    const cstk::Matrix3 body = cstk::euler_rates(angles, CSTK_ANGULAR_BODY);
    const cstk::Matrix3 inverse = cstk::euler_rates_inverse(angles, CSTK_ANGULAR_BODY);
    REQUIRE(cstk::euler_rates(angles) == cstk::euler_rates(angles, CSTK_ANGULAR_WORLD));
    REQUIRE(cstk::euler_rates(angles) != body && cstk::euler_rates_inverse(angles) != inverse);
    for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(std::fabs(angles[i] - again[i]) < 1e-15);
        double product = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            product += body[3 * i + k] * inverse[3 * k + i];
        }
        REQUIRE(std::fabs(product - 1) < 1e-15);
    }
    const std::vector<double> basic = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    const std::vector<double> back =
        cstk::jacobian_from_euler(angles, cstk::jacobian_to_euler(angles, basic));
    for (std::size_t i = 0; i < 12; ++i) {
        REQUIRE(std::fabs(basic[i] - back[i]) < 1e-13);
    }
    const std::array<double, 3> singular = {0, std::acos(0.0), 0};
    REQUIRE(status_of([&] { return cstk::euler_rates_inverse(singular); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(status_of([&] { return cstk::jacobian_to_euler(singular, basic); }) == CSTK_ERROR_DEGENERATE);
    REQUIRE(is_invalid([&] { return cstk::jacobian_to_euler(angles, {1, 2, 3}); }));
}
