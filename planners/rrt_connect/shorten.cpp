#include "shorten.hpp"

namespace rrt_connect {

double length(const cstk::Space &space, const std::vector<Configuration> &path) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        sum += space.distance(path[i], path[i + 1]);
    }
    return sum;
}

std::vector<Configuration> shortened(cstk::Query &query, const cstk::CObject &contact,
                                     const std::vector<Configuration> &path, std::size_t tries, std::uint64_t seed) {
    if (path.empty()) {
        return {};
    }
    std::vector<double> points;
    for (const Configuration &q : path) {
        points.insert(points.end(), q.begin(), q.end());
    }
    return cstk::configurations_of(
        query.path_shortcut(contact, points, path.size(), cstk::shortcut_options(tries, seed)).path);
}

} // namespace rrt_connect
