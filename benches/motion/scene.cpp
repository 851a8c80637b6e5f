#include "scene.hpp"

#include <cmath>
#include <utility>

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

std::vector<std::uint32_t> moving_links(const cstk::Robot &robot) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
        if (robot.link_info(link).has_body && moves(robot, link)) {
            found.push_back(link);
        }
    }
    return found;
}

cstk::Environment environment_of(const std::vector<Obstacle> &obstacles) {
    cstk::Environment made;
    for (const Obstacle &obstacle : obstacles) {
        made.add(obstacle.body, obstacle.pose);
    }
    return made;
}

cstk::CObject cobject_of(const cstk::Space &space, const cstk::Environment &environment,
                         const std::vector<std::uint32_t> &moving,
                         const std::vector<LinkPair> &pairs) {
    const cstk::CObject obstacles =
        cstk::CObject::induced(space, environment, cstk::induced_options(), moving);
    if (pairs.empty()) {
        return obstacles;
    }
    return cstk::CObject::union_of({obstacles, cstk::CObject::induced_links(space, pairs)});
}

} // namespace

Obstacle box_obstacle(const cstk::Pose &pose, const std::array<double, 3> &half_extents) {
    return {cstk::BodyBuilder().add_box(cstk::identity(), half_extents).build(), pose,
            half_extents};
}

Scene::Scene(std::string name, const cstk::Robot &robot, std::vector<Obstacle> obstacles,
             std::vector<LinkPair> pairs, std::size_t tries, Draw draw)
    : name(std::move(name)), robot(robot), space(robot), environment(environment_of(obstacles)),
      obstacles(std::move(obstacles)), pairs(std::move(pairs)), moving(moving_links(robot)),
      cobject(cobject_of(space, environment, moving, this->pairs)), tries(tries),
      draw_(std::move(draw)) {}

Ends along(const cstk::Space &space, const Numbers &from, Numbers direction, double length) {
    double norm = 0;
    for (const double x : direction) {
        norm += x * x;
    }
    for (double &x : direction) {
        x *= length / std::sqrt(norm);
    }
    return {from, space.step(from, direction)};
}
