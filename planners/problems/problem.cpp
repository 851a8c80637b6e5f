#include "problem.hpp"

#include <utility>

namespace problems {

namespace {

bool moves(const cstk::Robot &robot, std::uint32_t link) {
    for (auto at = static_cast<std::int32_t>(link); at >= 0;) {
        const cstk_link_info info = robot.link_info(static_cast<std::uint32_t>(at));
        if (info.joint != CSTK_JOINT_FIXED) {
            return true;
        }
        at = info.parent;
    }
    return false;
}

cstk::Environment environment_of(const std::vector<Obstacle> &obstacles) {
    cstk::Environment made;
    for (const Obstacle &obstacle : obstacles) {
        made.add(obstacle.body, obstacle.pose);
    }
    return made;
}

cstk::CObject contact_of(const cstk::Space &space, const cstk::Environment &environment,
                         const std::vector<std::uint32_t> &moving, const std::vector<LinkPair> &pairs) {
    const cstk::CObject obstacles = cstk::CObject::induced(space, environment, cstk::induced_options(), moving);
    if (pairs.empty()) {
        return obstacles;
    }
    return cstk::CObject::union_of({obstacles, cstk::CObject::induced_links(space, pairs)});
}

} // namespace

std::vector<std::uint32_t> moving_links(const cstk::Robot &robot) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
        if (robot.link_info(link).has_body && moves(robot, link)) {
            found.push_back(link);
        }
    }
    return found;
}

Obstacle box(const cstk::Pose &pose, const std::array<double, 3> &half_extents) {
    return {cstk::BodyBuilder().add_box(cstk::identity(), half_extents).build(), pose, half_extents, {}};
}

Obstacle cylinder(const cstk::Pose &pose, double radius, double half_length) {
    return {cstk::BodyBuilder().add_cylinder(cstk::identity(), radius, half_length).build(), pose, {},
            Cylinder{radius, half_length}};
}

Workcell::Workcell(const cstk::Robot &robot, const cstk::Space &space, std::vector<Obstacle> obstacles,
                   std::vector<LinkPair> pairs)
    : Workcell(std::vector<cstk::Robot>{robot}, space, std::move(obstacles), moving_links(robot), std::move(pairs)) {}

Workcell::Workcell(std::vector<cstk::Robot> robots, const cstk::Space &space, std::vector<Obstacle> obstacles,
                   std::vector<std::uint32_t> moving, std::vector<LinkPair> pairs)
    : robots(std::move(robots)), space(space), obstacles(std::move(obstacles)), moving(std::move(moving)), pairs(std::move(pairs)),
      environment(environment_of(this->obstacles)),
      contact(contact_of(space, environment, this->moving, this->pairs)) {}

} // namespace problems
