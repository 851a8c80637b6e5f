// What the planner is asked: a robot among obstacles, from where to where.
#ifndef SANDROS_PROBLEM_HPP
#define SANDROS_PROBLEM_HPP

#include <cstk.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sandros {

/// One number for each coordinate of the space.
using Configuration = std::vector<double>;

/// Straight motions from each configuration to the next.
using Path = std::vector<Configuration>;

/// A coordinate of the space, and into how many cells its range is cut at the coarsest resolution.
struct Axis {
    std::size_t coordinate;
    std::size_t cells;
};

/// How the local planner slides. Steps are lengths in C-space, shells lengths in the world: a shell
/// of two or three times as far as a step moves the robot works well.
struct SlideLengths {
    double step;
    double shell;
    /// Of links among each other. Those of one arm are always near each other: with a shorter shell
    /// fewer contacts are looked at.
    double link_shell;
};

/// A body that stands still.
struct Obstacle {
    cstk::Body body;
    cstk::Pose pose;
};

/// Every coordinate is a number of its own: CSTK_JOINT_FREE and _SPHERICAL, which have quaternions,
/// are refused. A rigid body is a chain of prismatic and revolute joints (problems/rigid_body.hpp).
struct Problem {
    std::string name;
    std::vector<cstk::Robot> robots;
    cstk::Space space;
    std::vector<Obstacle> obstacles;
    /// The obstacles, as the library asks for them.
    cstk::Environment environment;
    /// Which links must not meet one another.
    std::vector<std::array<std::uint32_t, 2>> link_pairs;
    Configuration start, goal;
    /// Every coordinate once, in the order in which subgoals fix them: what moves most of the robot
    /// comes first.
    std::vector<Axis> axes;
    SlideLengths slide;

    void add_obstacle(const cstk::Body &body, const cstk::Pose &pose = cstk::identity()) {
        obstacles.push_back({body, pose});
        environment.add(body, pose);
    }
};

} // namespace sandros

#endif
