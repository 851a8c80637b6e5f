#include "tree.hpp"

#include <algorithm>
#include <limits>

namespace rrt_connect {

Tree::Tree(const cstk::Space &space, const Configuration &root) : space_(space), nodes_{{root, none}} {}

std::size_t Tree::add(const Configuration &q, std::size_t parent) {
    const std::size_t added = nodes_.size();
    for (std::size_t at = 0;;) {
        Node &node = nodes_[at];
        const double distance = space_.distance(node.q, q);
        if (node.inside == none) {
            node.radius = distance;
        }
        std::size_t &next = distance <= node.radius ? node.inside : node.outside;
        if (next == none) {
            next = added;
            break;
        }
        at = next;
    }
    nodes_.push_back({q, parent});
    return added;
}

std::size_t Tree::nearest(const Configuration &q) const {
    Nearest best = {0, std::numeric_limits<double>::infinity()};
    search(0, q, best);
    return best.node;
}

void Tree::search(std::size_t at, const Configuration &q, Nearest &best) const {
    if (at == none) {
        return;
    }
    const Node &node = nodes_[at];
    const double distance = space_.distance(node.q, q);
    if (distance < best.distance) {
        best = {at, distance};
    }
    // The nearer side first; by the triangle inequality nothing on a side is nearer than the way to it.
    const bool starts_inside = distance <= node.radius;
    search(starts_inside ? node.inside : node.outside, q, best);
    if (std::abs(distance - node.radius) <= best.distance) {
        search(starts_inside ? node.outside : node.inside, q, best);
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
