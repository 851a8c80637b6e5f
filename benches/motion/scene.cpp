#include "scene.hpp"

#include <cmath>
#include <utility>

Scene::Scene(std::string name, const cstk::Robot &robot, std::vector<Obstacle> obstacles,
             std::vector<LinkPair> pairs, std::size_t tries, Draw draw)
    : Workcell(robot, cstk::Space(robot), std::move(obstacles), std::move(pairs)), name(std::move(name)),
      robot(robot), tries(tries), draw_(std::move(draw)) {}

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
