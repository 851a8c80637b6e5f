#include "robots.h"

#include <math.h>

#include "check.h"
#include "fixture.h"

bool near(const double *a, const double *b, size_t count, double tolerance) {
    for (size_t i = 0; i < count; ++i) {
        if (!(fabs(a[i] - b[i]) <= tolerance)) {
            return false;
        }
    }
    return true;
}

double length_of(const double *v, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += v[i] * v[i];
    }
    return sqrt(sum);
}

void turned(double angle, double x, double y, double z, double pose[12]) {
    translation(x, y, z, pose);
    pose[0] = pose[5] = cos(angle);
    pose[4] = sin(angle);
    pose[1] = -pose[4];
}

static int32_t screw_pose(const double *q, size_t n, double *pose, void *user) {
    CHECK(n == 1);
    turned(q[0], 0.0, 0.0, *(const double *)user * q[0], pose);
    return CSTK_OK;
}

static int32_t screw_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q;
    CHECK(n == 1);
    memset(jacobian, 0, 6 * sizeof *jacobian);
    jacobian[2] = *(const double *)user;
    jacobian[5] = 1.0;
    return CSTK_OK;
}

cstk_custom_joint screw(double *pitch) {
    cstk_custom_joint joint;
    CHECK_OK(cstk_custom_joint_default(&joint, sizeof joint));
    CHECK(joint.coordinates == 1 && joint.destroy == NULL && joint.linear_speed < 0.0);
    joint.pose = screw_pose;
    joint.jacobian = screw_jacobian;
    joint.user = pitch;
    joint.linear_speed = fabs(*pitch);
    joint.angular_speed = 1.0;
    return joint;
}

static int32_t plane_pose(const double *q, size_t n, double *pose, void *user) {
    (void)user;
    CHECK(n == 3);
    turned(q[2], q[0], q[1], 0.0, pose);
    return CSTK_OK;
}

static int32_t plane_jacobian(const double *q, size_t n, double *jacobian, void *user) {
    (void)q, (void)user;
    CHECK(n == 3);
    memset(jacobian, 0, 18 * sizeof *jacobian);
    jacobian[0] = jacobian[4] = jacobian[17] = 1.0;
    return CSTK_OK;
}

cstk_custom_joint plane(void) {
    cstk_custom_joint joint;
    CHECK_OK(cstk_custom_joint_default(&joint, sizeof joint));
    joint.coordinates = 3;
    joint.pose = plane_pose;
    joint.jacobian = plane_jacobian;
    joint.linear_speed = 1.0;
    joint.angular_speed = 1.0;
    return joint;
}

cstk_robot *make_robot(const cstk_link_def *def) {
    cstk_robot_builder *builder = NULL;
    cstk_robot *robot = NULL;
    CHECK_OK(cstk_robot_builder_create(3, &builder));
    CHECK_OK(cstk_robot_builder_add_link(builder, def, NULL));
    CHECK_OK(cstk_robot_build(builder, &robot));
    CHECK_OK(cstk_robot_builder_release(builder));
    return robot;
}

cstk_space *space_of(const cstk_robot *robot, const cstk_range *ranges, size_t count) {
    cstk_space *space = NULL;
    CHECK_OK(cstk_space_create(&robot, 1, ranges, count, NULL, &space));
    return space;
}

cstk_link_def link_of(int32_t joint) {
    cstk_link_def def;
    CHECK_OK(cstk_link_def_default(&def, sizeof def));
    def.joint = joint;
    return def;
}
