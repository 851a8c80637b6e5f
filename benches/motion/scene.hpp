// A robot among obstacles, and how motions for it are drawn.
#pragma once

#include "fcl_models.hpp"
#include "problem.hpp"

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
using problems::LinkPair;
using problems::Obstacle;

/// From q0 to q1 as cstk_space_interpolate moves.
struct Ends {
    Numbers q0, q1;
};

/// Of a workcell `contact` is what motions are to keep clear of.
class Scene : public problems::Workcell {
  public:
    /// Draws a motion of a length, free or not; none where the draw is to be thrown away.
    using Draw = std::function<std::optional<Ends>(const Scene &, double length, Random &)>;

    Scene(std::string name, const cstk::Robot &robot, std::vector<Obstacle> obstacles,
          std::vector<LinkPair> pairs, std::size_t tries, Draw draw);

    std::optional<Ends> draw(double length, Random &random) const {
        return draw_(*this, length, random);
    }

    const std::string name;
    const cstk::Robot robot;
    /// So many motions are drawn at most for a row of each kind.
    const std::size_t tries;

  private:
    Draw draw_;
};

/// The motion of a length from a configuration along a velocity.
Ends along(const cstk::Space &space, const Numbers &from, Numbers direction, double length);
