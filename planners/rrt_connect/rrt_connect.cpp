#include "rrt_connect.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rrt_connect {

namespace {

/// The tree grows from its nearest node towards q, by one edge of at most `range`. Returns the node it came to; none where it meets
/// something, or where the edge is lost in rounding.
std::optional<std::size_t> extend(Tree &tree, const Nearest &nearest, const Configuration &q, const cstk::Space &space,
                                  EdgeProver &edges, double range) {
    const Configuration &from = tree.at(nearest.node);
    if (from == q) {
        return nearest.node;
    }
    const Configuration end =
        nearest.distance > range ? space.interpolate(from, q, range / nearest.distance) : q;
    if (end == from || !edges.is_free(from, end)) {
        return {};
    }
    return tree.add(end, nearest.node);
}

/// The tree grows towards q until it is there or something is met. Returns the node at q.
std::optional<std::size_t> connect(Tree &tree, const Configuration &q, const cstk::Space &space, EdgeProver &edges,
                                   double range) {
    Nearest last = tree.nearest(q);
    while (const auto grown = extend(tree, last, q, space, edges, range)) {
        if (tree.at(*grown) == q) {
            return grown;
        }
        last = {*grown, space.distance(tree.at(*grown), q)};
    }
    return {};
}

/// Both trees have a node at the same configuration.
std::vector<Configuration> joined(const Tree &from_start, std::size_t start_side, const Tree &from_goal,
                                  std::size_t goal_side) {
    std::vector<Configuration> path = from_start.path_to(start_side);
    const std::vector<Configuration> rest = from_goal.path_to(goal_side);
    path.insert(path.end(), rest.rbegin() + 1, rest.rend());
    return path;
}

} // namespace

Plan plan(cstk::Query &query, const cstk::Space &space, const cstk::CObject &contact, const Configuration &start,
          const Configuration &goal, const Options &options) {
    if (!(options.range > 0)) {
        throw std::invalid_argument("the range must be larger than 0");
    }
    EdgeProver edges(query, contact);
    if (!edges.is_free(start) || !edges.is_free(goal)) {
        return {};
    }
    Tree from_start(space, start), from_goal(space, goal);
    Tree *growing = &from_start, *waiting = &from_goal;
    std::uint64_t random = options.seed;
    for (std::size_t i = 0; i < options.max_samples; ++i) {
        // The smaller tree grows: it is the one in the narrower place.
        if (growing->size() > waiting->size()) {
            std::swap(growing, waiting);
        }
        // The goal is the first sample, so that a straight way is found at once.
        const Configuration sample = i == 0 ? goal : space.sample(random);
        const Nearest nearest = growing->nearest(sample);
        if (growing->is_blocked(nearest.node) && nearest.distance > options.domain * options.range) {
            continue;
        }
        const auto grown = extend(*growing, nearest, sample, space, edges, options.range);
        if (!grown) {
            growing->block(nearest.node);
            continue;
        }
        const auto met = connect(*waiting, growing->at(*grown), space, edges, options.range);
        if (met) {
            const bool is_start = growing == &from_start;
            return {joined(from_start, is_start ? *grown : *met, from_goal, is_start ? *met : *grown), edges.checks()};
        }
    }
    return {{}, edges.checks()};
}

} // namespace rrt_connect
