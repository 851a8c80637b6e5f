#include "rigid_body.hpp"

namespace sandros::problems {

namespace {

const Joint circle_about_z = {CSTK_JOINT_REVOLUTE, {0, 0, 1}, 0, 0};

/// The joints that shift a body, the last with its core. Returns the last link.
std::int32_t add_shifts(cstk::RobotBuilder &builder, const std::string &name, int axes, double core,
                        const Room &room) {
    std::int32_t last = -1;
    for (int i = 0; i < axes; ++i) {
        Joint shift = {CSTK_JOINT_PRISMATIC, {0, 0, 0}, room.low[i], room.high[i]};
        shift.axis[i] = 1;
        const bool is_last = i + 1 == axes;
        last =
            static_cast<std::int32_t>(add_link(builder, is_last ? name + " core" : "", last, shift,
                                               {0, 0, 0}, is_last ? ball(core) : cstk::Body()));
    }
    return last;
}

} // namespace

cstk::Robot free_body(const std::string &name, const cstk::Body &body, double core,
                      const Room &room) {
    cstk::RobotBuilder builder;
    std::int32_t last = add_shifts(builder, name, 3, core, room);
    const Joint pitch = {CSTK_JOINT_REVOLUTE, {0, 1, 0}, -pi / 2, pi / 2};
    const Joint roll = {CSTK_JOINT_REVOLUTE, {1, 0, 0}, 0, 0};
    for (const Joint &turn : {circle_about_z, pitch}) {
        last = static_cast<std::int32_t>(add_link(builder, "", last, turn, {0, 0, 0}));
    }
    add_link(builder, name, last, roll, {0, 0, 0}, body);
    return builder.build();
}

cstk::Robot body_on_plane(const std::string &name, const cstk::Body &body, double core,
                          const Room &room) {
    cstk::RobotBuilder builder;
    const std::int32_t last = add_shifts(builder, name, 2, core, room);
    add_link(builder, name, last, circle_about_z, {0, 0, 0}, body);
    return builder.build();
}

} // namespace sandros::problems
