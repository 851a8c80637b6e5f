/* Part of cstk/fcl.hpp: the tree of boxes over a manager's objects. */
#ifndef CSTK_FCL_OBJECT_TREE_HPP
#define CSTK_FCL_OBJECT_TREE_HPP

#include <cstk/fcl/collision_object.hpp>

#include <algorithm>
#include <queue>
#include <unordered_map>

namespace cstk_fcl {
namespace detail {

/// A binary tree of axis-aligned boxes, one object a leaf. Objects come and go one by one; build() makes it anew, at medians.
/// Searches change nothing.
template <typename S> class ObjectTree {
public:
    using Object = CollisionObject<S>;

    static constexpr int NO_NODE = -1;

    struct Node {
        AABB<S> box;
        int parent = NO_NODE;
        int children[2] = {NO_NODE, NO_NODE};
        Object *object = nullptr;

        bool is_leaf() const { return object != nullptr; }
    };

    std::size_t size() const { return leaf_of_.size(); }
    int root() const { return root_; }
    const Node &node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
    bool contains(Object *object) const { return leaf_of_.count(object) != 0; }

    void clear() { *this = ObjectTree(); }

    /// All objects, in the order of the leaves.
    std::vector<Object *> objects() const {
        std::vector<Object *> out;
        for (const Node &node : nodes_) {
            if (node.is_leaf()) {
                out.push_back(node.object);
            }
        }
        return out;
    }

    /// Adds an object. One that is there already is moved.
    void insert(Object *object) {
        if (contains(object)) {
            move(object);
            return;
        }
        place(make_leaf(object));
    }

    void remove(Object *object) {
        const auto found = leaf_of_.find(object);
        if (found == leaf_of_.end()) {
            return;
        }
        const int leaf = found->second;
        leaf_of_.erase(found);
        detach(leaf);
        free_.push_back(leaf);
        at(leaf) = Node();
    }

    /// Takes over the object's box as it is now.
    void move(Object *object) {
        const auto found = leaf_of_.find(object);
        if (found == leaf_of_.end() || node(found->second).box.equal(object->getAABB())) {
            return;
        }
        detach(found->second);
        at(found->second).box = object->getAABB();
        place(found->second);
    }

    /// The tree over these objects alone.
    void build(const std::vector<Object *> &objects) {
        clear();
        nodes_.reserve(2 * objects.size());
        std::vector<int> leaves;
        for (Object *object : objects) {
            if (!contains(object)) {
                leaves.push_back(make_leaf(object));
            }
        }
        root_ = halved(leaves, 0, leaves.size());
        built_size_ = total_size();
    }

    /// Takes over all boxes as they are now; builds anew where the tree has become much larger than when it was built.
    void refresh() {
        for (Node &node : nodes_) {
            if (node.is_leaf()) {
                node.box = node.object->getAABB();
            }
        }
        refit(root_);
        if (total_size() > MAX_GROWTH * built_size_) {
            build(objects());
        }
    }

private:
    /// A tree this deep is built anew: one of a million objects has 20 levels.
    static constexpr int MAX_DEPTH = 64;
    /// At refresh(). Twice the boxes' size costs searches about twice the time.
    static constexpr double MAX_GROWTH = 1.5;

    Node &at(int index) { return nodes_[static_cast<std::size_t>(index)]; }

    int make_node() {
        if (!free_.empty()) {
            const int index = free_.back();
            free_.pop_back();
            return index;
        }
        nodes_.emplace_back();
        return static_cast<int>(nodes_.size()) - 1;
    }

    int make_leaf(Object *object) {
        const int leaf = make_node();
        at(leaf).box = object->getAABB();
        at(leaf).object = object;
        leaf_of_[object] = leaf;
        return leaf;
    }

    /* Half the sum of the sides: flat boxes count too, and unbounded ones do not overflow. */
    static S measure(const AABB<S> &box) { return (box.max_ / 8 - box.min_ / 8).sum(); }

    S growth(int index, const AABB<S> &box) const { return measure(node(index).box + box) - measure(node(index).box); }

    /// Puts a leaf beside the node whose box grows least.
    void place(int leaf) {
        int depth = 0;
        int sibling = root_;
        while (sibling != NO_NODE && !node(sibling).is_leaf()) {
            const int *children = node(sibling).children;
            const AABB<S> &box = node(leaf).box;
            sibling = growth(children[0], box) <= growth(children[1], box) ? children[0] : children[1];
            ++depth;
        }
        join(sibling, leaf);
        if (depth > MAX_DEPTH) {
            build(objects());
        }
    }

    /// Puts a leaf beside a node, or at the root of an empty tree.
    void join(int sibling, int leaf) {
        if (sibling == NO_NODE) {
            root_ = leaf;
            at(leaf).parent = NO_NODE;
            return;
        }
        const int parent = make_node();
        const int above = node(sibling).parent;
        at(parent) = Node();
        at(parent).parent = above;
        at(parent).children[0] = sibling;
        at(parent).children[1] = leaf;
        at(sibling).parent = at(leaf).parent = parent;
        replace(above, sibling, parent);
        widen(parent);
    }

    /// Takes a leaf out, with the node above it.
    void detach(int leaf) {
        const int parent = node(leaf).parent;
        if (parent == NO_NODE) {
            root_ = NO_NODE;
            return;
        }
        const int sibling = node(parent).children[node(parent).children[0] == leaf ? 1 : 0];
        const int above = node(parent).parent;
        at(sibling).parent = above;
        replace(above, parent, sibling);
        free_.push_back(parent);
        at(parent) = Node();
        at(leaf).parent = NO_NODE;
        widen(above);
    }

    void replace(int above, int old_child, int new_child) {
        if (above == NO_NODE) {
            root_ = new_child;
        } else {
            at(above).children[node(above).children[0] == old_child ? 0 : 1] = new_child;
        }
    }

    /// Boxes from a node up to the root.
    void widen(int index) {
        for (; index != NO_NODE; index = node(index).parent) {
            at(index).box = node(node(index).children[0]).box + node(node(index).children[1]).box;
        }
    }

    /// Boxes from the leaves up.
    void refit(int index) {
        if (index != NO_NODE && !node(index).is_leaf()) {
            refit(node(index).children[0]);
            refit(node(index).children[1]);
            at(index).box = node(node(index).children[0]).box + node(node(index).children[1]).box;
        }
    }

    double total_size() const {
        double sum = 0;
        for (const Node &node : nodes_) {
            sum += node.is_leaf() || node.children[0] == NO_NODE ? 0 : static_cast<double>(measure(node.box));
        }
        return sum;
    }

    /// The tree over leaves [first, end), halved at the median along the axis on which their middles spread most.
    int halved(std::vector<int> &leaves, std::size_t first, std::size_t end) {
        if (first == end) {
            return NO_NODE;
        }
        if (end - first == 1) {
            return leaves[first];
        }
        AABB<S> middles;
        for (std::size_t i = first; i < end; ++i) {
            middles += middle(leaves[i]);
        }
        int axis = 0;
        (middles.max_ / 2 - middles.min_ / 2).maxCoeff(&axis);
        const std::size_t half = first + (end - first) / 2;
        const auto begin = leaves.begin();
        using Offset = typename std::vector<int>::difference_type;
        std::nth_element(begin + static_cast<Offset>(first), begin + static_cast<Offset>(half), begin + static_cast<Offset>(end),
                         [&](int a, int b) { return middle(a)[axis] < middle(b)[axis]; });
        const int index = make_node();
        const int low = halved(leaves, first, half), high = halved(leaves, half, end);
        at(index).children[0] = low;
        at(index).children[1] = high;
        at(low).parent = at(high).parent = index;
        at(index).box = node(low).box + node(high).box;
        return index;
    }

    Vector3<S> middle(int index) const { return node(index).box.min_ / 2 + node(index).box.max_ / 2; }

    std::vector<Node> nodes_;
    std::vector<int> free_;
    int root_ = NO_NODE;
    std::unordered_map<Object *, int> leaf_of_;
    double built_size_ = 0;
};

} // namespace detail
} // namespace cstk_fcl

#endif
