#include "local_planner.hpp"

#include <algorithm>
#include <cmath>

namespace sandros {

namespace {

/// A slide that brings the robot nearer by less than this part of its step does not get on.
const double MIN_GAIN = 0.05;
/// How many slides in a row may not get on: corners take one or two.
const int MAX_IDLE_SLIDES = 3;
/// Slides in one walk; with it the work of an attempt is bounded.
const int MAX_SLIDES = 80;
/// After so many slides the straight way is tried again.
const int SLIDES_BETWEEN_MOTIONS = 8;
/// Of a motion: the first contact need not be known better to stop before it.
const double CONTACT_TOLERANCE = 0.01;

double length(const std::vector<double> &velocity) {
    double sum = 0;
    for (const double v : velocity) {
        sum += v * v;
    }
    return std::sqrt(sum);
}

} // namespace

/// Where the robot is, and how it came there.
struct LocalPlanner::Walk {
    Configuration q;
    Path path;

    void go(const Configuration &to) {
        q = to;
        path.push_back(to);
    }
};

LocalPlanner::LocalPlanner(const Problem &problem, const cstk::CObject &obstacles,
                           const cstk::Query &query)
    : space_(problem.space), obstacles_(obstacles), query_(query), step_(problem.slide.step),
      slide_options_(cstk::slide_options(problem.slide.shell)),
      first_contact_(cstk::motion_options()), any_contact_(cstk::motion_options()) {
    first_contact_.tolerance = CONTACT_TOLERANCE;
    any_contact_.any_contact = 1;
}

bool LocalPlanner::straight(const Configuration &from, const Configuration &to) {
    ++work_.motions;
    return query_.motion(obstacles_, from, to, any_contact_).outcome == CSTK_MOTION_FREE;
}

/// As far as the motion is proved free, less a step; true if that is all of it.
bool LocalPlanner::go_straight(Walk &walk, const Configuration &to) {
    ++work_.motions;
    const cstk_motion_result found = query_.motion(obstacles_, walk.q, to, first_contact_);
    if (found.outcome == CSTK_MOTION_FREE) {
        walk.go(to);
        return true;
    }
    const double part = found.times[0] - step_ / length(space_.difference(walk.q, to));
    if (part > 0) {
        walk.go(space_.interpolate(walk.q, to, part));
    }
    return false;
}

/// One step towards `to`, bent along contacts; false if there is none.
bool LocalPlanner::slide(Walk &walk, const Configuration &to) {
    ++work_.slides;
    std::vector<double> step = space_.difference(walk.q, to);
    const double shorter = std::min(1.0, step_ / length(step));
    for (double &v : step) {
        v *= shorter;
    }
    Configuration q = walk.q;
    if (query_.slide(obstacles_, q, step, slide_options_).outcome != CSTK_SLIDE_MOVED) {
        return false;
    }
    walk.go(q);
    return true;
}

/// `target` says where to go from a configuration: the nearest one that will do.
template <typename Target>
std::optional<Path> LocalPlanner::walk(const Configuration &from, Target target) {
    Walk walk = {from, {}};
    const auto way_left = [&] { return length(space_.difference(walk.q, target(walk.q))); };
    int idle = 0;
    for (int slides = 0; slides < MAX_SLIDES && idle <= MAX_IDLE_SLIDES; ++slides) {
        if (slides % SLIDES_BETWEEN_MOTIONS == 0 || way_left() <= step_) {
            if (go_straight(walk, target(walk.q))) {
                return walk.path;
            }
        }
        const double before = way_left();
        if (!slide(walk, target(walk.q))) {
            return std::nullopt;
        }
        idle = before - way_left() < MIN_GAIN * step_ ? idle + 1 : 0;
    }
    return std::nullopt;
}

std::optional<Path> LocalPlanner::reach(const Configuration &from, const Grid &grid,
                                        const Cells &cells) {
    return walk(from, [&](const Configuration &q) { return grid.nearest_within(cells, q); });
}

std::optional<Path> LocalPlanner::reach(const Configuration &from, const Configuration &to) {
    return walk(from, [&](const Configuration &) { return to; });
}

} // namespace sandros
