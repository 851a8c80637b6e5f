#include "path.hpp"

#include "obstacles.hpp"

namespace sandros {

namespace {

/// Shortcuts that are tried on a path.
const std::uint64_t SHORTCUTS = 300;

} // namespace

std::vector<double> flat(const Path &path) {
    std::vector<double> points;
    for (const Configuration &q : path) {
        points.insert(points.end(), q.begin(), q.end());
    }
    return points;
}

Path path_of(const cstk_path &given) {
    Path path;
    for (std::size_t i = 0; i < given.count; ++i) {
        const double *q = given.points + i * given.nq;
        path.emplace_back(q, q + given.nq);
    }
    return path;
}

bool is_free(const Problem &problem, const Path &path) {
    const cstk::Query query;
    const cstk_path_result found =
        query.motion_path(obstacles_of(problem), flat(path), path.size());
    return found.motion.outcome == CSTK_MOTION_FREE;
}

double length(const Problem &problem, const Path &path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        sum += problem.space.distance(path[i - 1], path[i]);
    }
    return sum;
}

Path shortened(const Problem &problem, const Path &path) {
    const cstk::Query query;
    const cstk_shortcut_result found = query.path_shortcut(
        obstacles_of(problem), flat(path), path.size(), cstk::shortcut_options(SHORTCUTS));
    return path_of(found.path);
}

} // namespace sandros
