/* Poses, Euler angles and their rates. */
#include <math.h>

#include "check.h"
#include "fixture.h"
#include "robots.h"

static void pose_functions(void) {
    const double placement[6] = {1, 2, 3, 2.4, -0.7, 1.1};
    const double point[3] = {-0.5, 0.25, 2.0};
    double pose[12];
    double inverse[12];
    double product[12];
    double quaternion[7];
    double there[3];
    CHECK_OK(cstk_pose_from_euler(placement, pose));
    CHECK_OK(cstk_pose_inverse(pose, inverse));
    CHECK_OK(cstk_pose_compose(pose, inverse, product));
    CHECK(near(product, identity_pose, 12, 1e-15));
    CHECK_OK(cstk_pose_transform_point(pose, point, there));
    for (int i = 0; i < 3; ++i) {
        const double *row = pose + 4 * i;
        CHECK(fabs(there[i] -
                   (row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3])) < 1e-15);
    }
    CHECK_OK(cstk_pose_transform_point(inverse, there, there));
    CHECK(near(there, point, 3, 1e-15));
    CHECK_OK(cstk_pose_to_quaternion(pose, quaternion));
    CHECK(quaternion[6] >= 0.0 && fabs(length_of(quaternion + 3, 4) - 1.0) < 1e-15);
    CHECK_OK(cstk_pose_from_quaternion(quaternion, product));
    CHECK(near(product, pose, 12, 1e-15));
    CHECK_OK(cstk_pose_inverse(inverse, inverse));
    CHECK(near(inverse, pose, 12, 1e-15));
}

static void euler_rates(void) {
    const double angles[3] = {0.4, -0.7, 1.1};
    const double step = 1e-5;
    double matrix[9];
    double inverse[9];
    for (int32_t frame = CSTK_ANGULAR_WORLD; frame <= CSTK_ANGULAR_BODY; ++frame) {
        CHECK_OK(cstk_euler_rates(angles, frame, matrix));
        CHECK_OK(cstk_euler_rates_inverse(angles, frame, inverse));
        for (int k = 0; k < 3; ++k) {
            double ahead[6] = {0, 0, 0, angles[0], angles[1], angles[2]};
            double behind[6] = {0, 0, 0, angles[0], angles[1], angles[2]};
            double a[12];
            double b[12];
            double turn[12];
            ahead[3 + k] += step;
            behind[3 + k] -= step;
            CHECK_OK(cstk_pose_from_euler(ahead, a));
            CHECK_OK(cstk_pose_from_euler(behind, b));
            CHECK_OK(cstk_pose_inverse(b, b));
            CHECK_OK(frame == CSTK_ANGULAR_WORLD ? cstk_pose_compose(a, b, turn)
                                                 : cstk_pose_compose(b, a, turn));
            const double measured[3] = {turn[9] - turn[6], turn[2] - turn[8], turn[4] - turn[1]};
            for (int row = 0; row < 3; ++row) {
                double product = 0;
                for (int i = 0; i < 3; ++i) {
                    product += matrix[3 * row + i] * inverse[3 * i + k];
                }
                CHECK(fabs(measured[row] / (4 * step) - matrix[3 * row + k]) < 1e-9);
                CHECK(fabs(product - (row == k)) < 1e-15);
            }
        }
    }
}

/* The Euler Jacobian of a link that Euler angles move is the identity. */
static void euler_jacobian(void) {
    const double q[6] = {0.1, 0.2, 0.3, 0.4, -0.7, 1.1};
    const double origin[3] = {0, 0, 0};
    const cstk_link_def def = link_of(CSTK_JOINT_FREE_EULER);
    cstk_robot *robot = make_robot(&def);
    double basic[36];
    double matrix[36];
    CHECK_OK(cstk_robot_jacobian(robot, q, 6, 0, origin, basic));
    memcpy(matrix, basic, sizeof matrix);
    CHECK_OK(cstk_jacobian_to_euler(q + 3, matrix, 6));
    for (int i = 0; i < 36; ++i) {
        CHECK(fabs(matrix[i] - (i % 7 == 0)) < 1e-15);
    }
    CHECK_OK(cstk_jacobian_from_euler(q + 3, matrix, 6));
    CHECK(near(matrix, basic, 36, 1e-15));
    CHECK_OK(cstk_robot_release(robot));
}

int main(void) {
    pose_functions();
    euler_rates();
    euler_jacobian();
    return check_result();
}
