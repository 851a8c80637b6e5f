// A tree of configurations, joined by free motions, that finds the nearest of them.
#pragma once

#include <cstk.hpp>

#include <cstddef>
#include <vector>

namespace rrt_connect {

using Configuration = std::vector<double>;

/// A node by its number, and how far it is.
struct Nearest {
    std::size_t node;
    double distance;
};

/// Nodes are numbered as they come; 0 is the root. Beside the motions that join them there is a vantage point tree (Yianilos, 1993)
/// with some nodes in each leaf, which asks no more of a space than its metric: Space::distances, which is one but for free joints
/// (see cstk_space_distance).
class Tree {
  public:
    Tree(const cstk::Space &space, const Configuration &root);

    /// Adds a node that a motion joins to its parent; returns its number.
    std::size_t add(const Configuration &q, std::size_t parent);

    /// The node nearest to q.
    Nearest nearest(const Configuration &q) const;

    const Configuration &at(std::size_t node) const { return nodes_[node].q; }

    /// Marks a node from which a motion was not free.
    void block(std::size_t node) { nodes_[node].is_blocked = true; }
    bool is_blocked(std::size_t node) const { return nodes_[node].is_blocked; }

    std::size_t size() const { return nodes_.size(); }

    /// From the root to the node.
    std::vector<Configuration> path_to(std::size_t node) const;

  private:
    static const std::size_t none = static_cast<std::size_t>(-1);

    struct Node {
        Configuration q;
        std::size_t parent;
        bool is_blocked = false;
    };

    /// Of the vantage point tree: a leaf with nodes, or what is at most `radius` away from the vantage point and all else.
    struct Part {
        bool is_leaf() const { return inside == none; }

        std::vector<std::size_t> nodes;
        /// Their configurations, one after the other.
        std::vector<double> points;
        /// Where so many nodes are in it, a leaf is parted.
        std::size_t limit;

        Configuration vantage = {};
        double radius = 0;
        std::size_t inside = none, outside = none;
    };

    void split(std::size_t leaf);
    void search(std::size_t part, const Configuration &q, Nearest &best) const;

    cstk::Space space_;
    std::vector<Node> nodes_;
    std::vector<Part> parts_;
};

} // namespace rrt_connect
