#include "check.hpp"
#include "models.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

static std::int32_t turn(const double *q, std::size_t, double *pose, void *calls) {
    ++*static_cast<int *>(calls);
    const double c = std::cos(q[0]), s = std::sin(q[0]);
    const cstk::Pose turned = {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0};
    std::copy(turned.begin(), turned.end(), pose);
    return CSTK_OK;
}

static std::int32_t turning(const double *, std::size_t, double *jacobian, void *) {
    std::fill_n(jacobian, 5, 0.0);
    jacobian[5] = 1;
    return CSTK_OK;
}

cstk::Robot make_robot(int &calls) {
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    link.joint_name = "rail";
    link.lower = -1;
    link.upper = 2;
    builder.add_link(link);
    link.joint_name = "";
    link.coordinate = 0;
    link.multiplier = -1;
    link.offset = 0.5;
    builder.add_link(link);
    cstk::Link drone;
    drone.name = "drone";
    drone.joint = CSTK_JOINT_FREE;
    builder.add_link(drone);
    cstk_custom_joint joint = cstk::custom_joint();
    joint.pose = turn;
    joint.jacobian = turning;
    joint.user = &calls;
    cstk::Link wrist;
    wrist.joint = CSTK_JOINT_CUSTOM;
    REQUIRE(status_of([&] { return builder.add_link(wrist); }) == CSTK_ERROR_NULL_ARGUMENT);
    wrist.custom = &joint;
    REQUIRE(builder.add_link(wrist) == 3);
    return builder.build();
}

cstk::Space make_space(const cstk::Body &body) {
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.joint = CSTK_JOINT_PRISMATIC;
    link.axis = {1, 0, 0};
    link.lower = -5;
    link.upper = 5;
    link.body = body;
    builder.add_link(link);
    link = cstk::Link();
    link.joint = CSTK_JOINT_REVOLUTE;
    link.parent = 0;
    builder.add_link(link);
    return cstk::Space({builder.build()}, {}, {-4, -4, -4, 4, 4, 4});
}

void count(void *calls) { *static_cast<int *>(calls) += 100; }
