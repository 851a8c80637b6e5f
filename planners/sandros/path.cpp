#include "path.hpp"

#include "obstacles.hpp"

namespace sandros {

namespace {

/// Splits long motions, so that shortcuts may begin within them.
Path with_middles(const Problem &problem, const Path &path, double longest) {
    Path out = {path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double way = problem.space.distance(path[i - 1], path[i]);
        const auto parts = static_cast<std::size_t>(way / longest) + 1;
        for (std::size_t k = 1; k < parts; ++k) {
            out.push_back(problem.space.interpolate(
                path[i - 1], path[i], static_cast<double>(k) / static_cast<double>(parts)));
        }
        out.push_back(path[i]);
    }
    return out;
}

/// From each configuration straight to the farthest along the path that halving the way to the end
/// finds.
Path without_detours(const cstk::Query &query, const cstk::CObject &obstacles, const Path &path) {
    cstk_motion_options options = cstk::motion_options();
    options.any_contact = 1;
    Path out = {path.front()};
    for (std::size_t at = 0; at + 1 < path.size();) {
        std::size_t next = path.size() - 1;
        while (next > at + 1 &&
               query.motion(obstacles, path[at], path[next], options).outcome != CSTK_MOTION_FREE) {
            next = at + (next - at) / 2;
        }
        out.push_back(path[next]);
        at = next;
    }
    return out;
}

} // namespace

bool is_free(const Problem &problem, const Path &path) {
    std::vector<double> points;
    for (const Configuration &q : path) {
        points.insert(points.end(), q.begin(), q.end());
    }
    const cstk::Query query;
    const cstk_path_result found = query.motion_path(obstacles_of(problem), points, path.size());
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
    const cstk::CObject obstacles = obstacles_of(problem);
    Path shorter = path;
    for (double before = length(problem, path) + 1; length(problem, shorter) < 0.99 * before;) {
        before = length(problem, shorter);
        const Path dense = with_middles(problem, shorter, 4 * problem.slide.step);
        shorter = without_detours(query, obstacles, dense);
    }
    /* What was split was not looked at again. */
    return is_free(problem, shorter) ? shorter : path;
}

} // namespace sandros
