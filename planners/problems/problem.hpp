// What a planner is given: a robot among obstacles, and two configurations to lead between.
#pragma once

#include <cstk.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace problems {

using Configuration = std::vector<double>;
using LinkPair = std::array<std::uint32_t, 2>;

struct Cylinder {
    double radius, half_length;
};

/// A body of the workcell. Where it is one shape about the origin of its frame, other libraries may take it as theirs.
struct Obstacle {
    cstk::Body body;
    cstk::Pose pose;
    std::optional<std::array<double, 3>> half_extents = {};
    std::optional<Cylinder> cylinder = {};
};

Obstacle box(const cstk::Pose &pose, const std::array<double, 3> &half_extents);
Obstacle cylinder(const cstk::Pose &pose, double radius, double half_length);

/// The links that have a body and that a joint moves.
std::vector<std::uint32_t> moving_links(const cstk::Robot &robot);

/// Robots among obstacles. Links have the numbers of the space. Those of `moving` are tested against the obstacles, the pairs against
/// each other.
struct Workcell {
    Workcell(std::vector<cstk::Robot> robots, const cstk::Space &space, std::vector<Obstacle> obstacles,
             std::vector<std::uint32_t> moving, std::vector<LinkPair> pairs);
    /// Of one robot all links that move.
    Workcell(const cstk::Robot &robot, const cstk::Space &space, std::vector<Obstacle> obstacles,
             std::vector<LinkPair> pairs);

    std::vector<cstk::Robot> robots;
    cstk::Space space;
    std::vector<Obstacle> obstacles;
    std::vector<std::uint32_t> moving;
    std::vector<LinkPair> pairs;
    cstk::Environment environment;
    /// Where a robot meets an obstacle, itself or another.
    cstk::CObject contact;
};

struct Problem {
    std::string scene, name;
    std::shared_ptr<const Workcell> workcell;
    Configuration start, goal;
    /// For the longest edge of a tree, as Space::distance measures.
    double range;
};

} // namespace problems
