#include "path.hpp"

#include "obstacles.hpp"

namespace sandros {

namespace {

/// Shortcuts that are tried on a path.
const std::uint64_t SHORTCUTS = 300;

/// The path without the corners whose neighbours are joined by a straight motion that is proved
/// free. Each shortcut puts its two ends on the path: most of them are of no more use in the end.
Path without_corners(Path path, const cstk::CObject &obstacles, cstk::Query &query) {
    cstk_motion_options options = cstk::motion_options();
    options.any_contact = 1;
    for (std::size_t before = 0; before != path.size();) {
        before = path.size();
        for (std::size_t i = 1; i + 1 < path.size();) {
            if (query.motion(obstacles, path[i - 1], path[i + 1], options).outcome ==
                CSTK_MOTION_FREE) {
                path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
            } else {
                ++i;
            }
        }
    }
    return path;
}

} // namespace

std::vector<double> flat(const Path &path) {
    std::vector<double> points;
    for (const Configuration &q : path) {
        points.insert(points.end(), q.begin(), q.end());
    }
    return points;
}

bool is_free(const Problem &problem, const Path &path) {
    cstk::Query query;
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
    cstk::Query query;
    const cstk::CObject obstacles = obstacles_of(problem);
    const cstk_shortcut_result found = query.path_shortcut(obstacles, flat(path), path.size(),
                                                           cstk::shortcut_options(SHORTCUTS));
    return without_corners(cstk::configurations_of(found.path), obstacles, query);
}

} // namespace sandros
