// A robot among obstacles, and how motions for it are drawn.
#pragma once

#include "fcl_models.hpp"

#include <cstk.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

using Numbers = std::vector<double>;
using Random = models::Random;
using LinkPair = std::array<std::uint32_t, 2>;

/// From q0 to q1 as cstk_space_interpolate moves.
struct Ends {
    Numbers q0, q1;
};

struct Obstacle {
    cstk::Body body;
    cstk::Pose pose;
    /// Of a box about the origin of its frame: peers may take it as their shape.
    std::optional<std::array<double, 3>> half_extents;
};

Obstacle box_obstacle(const cstk::Pose &pose, const std::array<double, 3> &half_extents);

class Scene {
  public:
    /// Draws a motion of a length, free or not; none where the draw is to be thrown away.
    using Draw = std::function<std::optional<Ends>(const Scene &, double length, Random &)>;

    /// Against the obstacles are all links with a body that a joint moves; against each other the pairs.
    Scene(std::string name, const cstk::Robot &robot, std::vector<Obstacle> obstacles,
          std::vector<LinkPair> pairs, std::size_t tries, Draw draw);

    std::optional<Ends> draw(double length, Random &random) const {
        return draw_(*this, length, random);
    }

    const std::string name;
    const cstk::Robot robot;
    const cstk::Space space;
    const cstk::Environment environment;
    const std::vector<Obstacle> obstacles;
    const std::vector<LinkPair> pairs;
    const std::vector<std::uint32_t> moving;
    const cstk::CObject cobject;
    /// So many motions are drawn at most for a row of each kind.
    const std::size_t tries;

  private:
    Draw draw_;
};

/// The motion of a length from a configuration along a velocity.
Ends along(const cstk::Space &space, const Numbers &from, Numbers direction, double length);
