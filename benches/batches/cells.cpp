#include "cells.hpp"

#include "built_in.hpp"
#include "motion_bench_maker.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace {

const std::size_t object_counts[] = {20, 500};
// In metres: the boxes lie between two distances from the robot's base, and together have the same volume whatever their number.
const double nearest = 0.45, farthest = 1.3, volume = 0.06;
// Radians, and metres of fingers: the length of a step, and how many lead one way.
const double step_length = 0.01;
const std::size_t stretch = 50;

std::vector<problems::Obstacle> boxes(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const double half = std::cbrt(volume / static_cast<double>(count)) / 2;
    std::vector<problems::Obstacle> made;
    while (made.size() < count) {
        const double x = farthest * anywhere(random), y = farthest * anywhere(random), z = 0.6 + farthest * anywhere(random);
        const double distance = std::sqrt(x * x + y * y + (z - 0.6) * (z - 0.6));
        if (std::hypot(x, y) > nearest && distance < farthest) {
            const double turn = 3 * anywhere(random);
            made.push_back(problems::box(cstk::pose_from_euler({x, y, z, turn, turn / 2, 0}), {half, 1.3 * half, 0.8 * half}));
        }
    }
    return made;
}

} // namespace

std::vector<Cell> cells(const std::string &puma, const std::string &panda, std::uint64_t seed) {
    std::vector<Cell> made;
    const auto add = [&](const std::string &name, const cstk::Robot &robot, const cstk::Space &space,
                         const std::vector<problems::LinkPair> &pairs) {
        for (const std::size_t count : object_counts) {
            made.push_back({name, count, std::make_shared<const problems::Workcell>(robot, space, boxes(count, seed), pairs)});
        }
    };
    if (!puma.empty()) {
        const cstk::Robot robot = problems::puma_560(puma);
        const cstk::Space space(robot);
        add("Puma 560", robot, space, cstk::Query().find_link_pairs(space).tested);
    }
    if (!panda.empty()) {
        const problems::Panda source(panda);
        const auto workcell = source.problems(source.scenes().front(), 1).front().workcell;
        add("Panda", workcell->robots.front(), workcell->space, workcell->pairs);
    }
    return made;
}

std::vector<double> random_configurations(const cstk::Space &space, std::size_t count, std::uint64_t seed) {
    std::vector<double> made;
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<double> q = space.sample(seed);
        made.insert(made.end(), q.begin(), q.end());
    }
    return made;
}

std::vector<double> coherent_configurations(const cstk::Space &space, std::size_t count, std::uint64_t seed) {
    std::vector<double> made;
    std::vector<double> from, to;
    double length = 1;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % stretch == 0) {
            from = space.sample(seed);
            to = space.sample(seed);
            length = space.distance(from, to);
        }
        const double share = std::min(static_cast<double>(i % stretch) * step_length / length, 1.0);
        const std::vector<double> q = space.interpolate(from, to, share);
        made.insert(made.end(), q.begin(), q.end());
    }
    return made;
}
