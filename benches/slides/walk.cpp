#include "walk.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace {

const std::size_t steps_a_walk = 40;

// The length of a step in C-space: radians for the UR5, and the Panda's fingers hardly count.
const double step_length = 0.05;

std::vector<double> free_start(const Cell &cell, cstk::Query &query,
                               const cstk::CObject &all, std::uint64_t &random) {
    for (;;) {
        std::vector<double> q = cell.space.sample(random);
        if (query.classify(all, q) == CSTK_CLASS_OUTSIDE) {
            return q;
        }
    }
}

double length(const std::vector<double> &v) {
    double square = 0;
    for (double x : v) {
        square += x * x;
    }
    return std::sqrt(square);
}

std::vector<double> direction(const Cell &cell, std::uint64_t &random) {
    const std::vector<double> from = cell.space.neutral(), to = cell.space.sample(random);
    std::vector<double> step = cell.space.difference(from, to);
    const double factor = step_length / length(step);
    for (double &x : step) {
        x *= factor;
    }
    return step;
}

} // namespace

void Steps::add(double microseconds, cstk_slide_outcome outcome, double way) {
    times.push_back(microseconds);
    gone += way;
    asked += step_length;
    moved += outcome == CSTK_SLIDE_MOVED;
    blocked += outcome == CSTK_SLIDE_BLOCKED;
}

double Steps::quantile(double share) const {
    if (times.empty()) {
        return NAN;
    }
    std::vector<double> sorted = times;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

Walks walk(const Cell &cell, const Shells &shells, std::size_t walks, std::uint64_t seed) {
    using Clock = std::chrono::steady_clock;
    cstk::Query query;
    const cstk::CObject all =
        cstk::CObject::union_of({cell.obstacles, cell.itself.with_shell(shells.links)});
    const cstk_slide_options options = cstk::slide_options(shells.obstacles);
    Walks made;
    for (std::size_t i = 0; i < walks; ++i) {
        std::vector<double> q = free_start(cell, query, all, seed);
        const std::vector<double> step = direction(cell, seed);
        for (std::size_t k = 0; k < steps_a_walk; ++k) {
            const bool is_near = query.within(cell.obstacles, q, shells.obstacles);
            const std::vector<double> before = q;
            const Clock::time_point start = Clock::now();
            const cstk_slide_result result = query.slide(all, q, step, options);
            const std::chrono::duration<double, std::micro> time = Clock::now() - start;
            const double way = length(cell.space.difference(before, q));
            (is_near ? made.sliding : made.free).add(time.count(), result.outcome, way);
            if (result.outcome != CSTK_SLIDE_MOVED) {
                break;
            }
        }
    }
    return made;
}
