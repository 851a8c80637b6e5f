#include "tree.hpp"

#include <algorithm>
#include <limits>

namespace rrt_connect {

namespace {

/// Nodes in a leaf: one call asks for the distances of all.
const std::size_t leaf_size = 32;

} // namespace

Tree::Tree(const cstk::Space &space, const Configuration &root) : space_(space), parts_{{{}, {}, leaf_size}} {
    add(root, none);
}

std::size_t Tree::add(const Configuration &q, std::size_t parent) {
    std::size_t at = 0;
    while (!parts_[at].is_leaf()) {
        const Part &part = parts_[at];
        at = space_.distance(part.vantage, q) <= part.radius ? part.inside : part.outside;
    }
    const std::size_t added = nodes_.size();
    nodes_.push_back({q, parent});
    Part &leaf = parts_[at];
    leaf.nodes.push_back(added);
    leaf.points.insert(leaf.points.end(), q.begin(), q.end());
    if (leaf.nodes.size() >= leaf.limit) {
        split(at);
    }
    return added;
}

/// By the median of the distances from one of the nodes.
void Tree::split(std::size_t leaf) {
    Part parted = parts_[leaf];
    parted.vantage = nodes_[parted.nodes.front()].q;
    const std::vector<double> distances = space_.distances(parted.vantage, parted.points);
    std::vector<double> in_order = distances;
    const auto middle = in_order.begin() + static_cast<std::ptrdiff_t>(in_order.size() / 2);
    std::nth_element(in_order.begin(), middle, in_order.end());
    parted.radius = *middle;
    Part inside = {{}, {}, leaf_size}, outside = inside;
    for (std::size_t i = 0; i < parted.nodes.size(); ++i) {
        Part &side = distances[i] <= parted.radius ? inside : outside;
        const Configuration &q = nodes_[parted.nodes[i]].q;
        side.nodes.push_back(parted.nodes[i]);
        side.points.insert(side.points.end(), q.begin(), q.end());
    }
    if (outside.nodes.empty()) {
        // More than half of them are equally far: the leaf waits for other nodes.
        parts_[leaf].limit *= 2;
        return;
    }
    parted.nodes = {};
    parted.points = {};
    parted.inside = parts_.size();
    parted.outside = parted.inside + 1;
    parts_[leaf] = std::move(parted);
    parts_.push_back(std::move(inside));
    parts_.push_back(std::move(outside));
}

Nearest Tree::nearest(const Configuration &q) const {
    Nearest best = {0, std::numeric_limits<double>::infinity()};
    search(0, q, best);
    return best;
}

void Tree::search(std::size_t at, const Configuration &q, Nearest &best) const {
    const Part &part = parts_[at];
    if (part.is_leaf()) {
        const std::vector<double> distances = space_.distances(q, part.points);
        const auto least = std::min_element(distances.begin(), distances.end());
        if (least != distances.end() && *least < best.distance) {
            best = {part.nodes[static_cast<std::size_t>(least - distances.begin())], *least};
        }
        return;
    }
    // The nearer side first; by the triangle inequality nothing on a side is nearer than the way to it.
    const double distance = space_.distance(q, part.vantage);
    const bool starts_inside = distance <= part.radius;
    search(starts_inside ? part.inside : part.outside, q, best);
    if (std::abs(distance - part.radius) <= best.distance) {
        search(starts_inside ? part.outside : part.inside, q, best);
    }
}

std::vector<Configuration> Tree::path_to(std::size_t node) const {
    std::vector<Configuration> path;
    for (; node != none; node = nodes_[node].parent) {
        path.push_back(nodes_[node].q);
    }
    std::reverse(path.begin(), path.end());
    return path;
}

} // namespace rrt_connect
