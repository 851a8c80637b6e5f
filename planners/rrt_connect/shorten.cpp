#include "shorten.hpp"

#include <utility>

namespace rrt_connect {

namespace {

/// splitmix64 (Steele, Lea and Flood, 2014), from 0 to 1.
double uniform(std::uint64_t &state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

struct Place {
    /// On the edge from point `edge` to the next.
    std::size_t edge;
    Configuration q;
};

/// The place on a path after this part of its length.
Place place_at(const cstk::Space &space, const std::vector<Configuration> &path, double away) {
    for (std::size_t i = 0; i + 2 < path.size(); ++i) {
        const double edge = space.distance(path[i], path[i + 1]);
        if (away < edge) {
            return {i, space.interpolate(path[i], path[i + 1], away / edge)};
        }
        away -= edge;
    }
    const std::size_t last = path.size() - 2;
    const double edge = space.distance(path[last], path[last + 1]);
    return {last, space.interpolate(path[last], path[last + 1], edge > away ? away / edge : 1)};
}

} // namespace

double length(const cstk::Space &space, const std::vector<Configuration> &path) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        sum += space.distance(path[i], path[i + 1]);
    }
    return sum;
}

void shorten(std::vector<Configuration> &path, const cstk::Space &space, EdgeProver &edges, std::size_t tries,
             std::uint64_t seed) {
    for (std::size_t i = 0; i < tries && path.size() > 2; ++i) {
        const double whole = length(space, path);
        double a = whole * uniform(seed), b = whole * uniform(seed);
        if (a > b) {
            std::swap(a, b);
        }
        const Place from = place_at(space, path, a), to = place_at(space, path, b);
        if (from.edge == to.edge || !edges.is_free(from.q, to.q)) {
            continue;
        }
        // Parts of edges are as free as the edges are.
        std::vector<Configuration> cut(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(from.edge) + 1);
        cut.push_back(from.q);
        cut.push_back(to.q);
        cut.insert(cut.end(), path.begin() + static_cast<std::ptrdiff_t>(to.edge) + 1, path.end());
        path = std::move(cut);
    }
}

} // namespace rrt_connect
