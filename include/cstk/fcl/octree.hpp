/* Part of cstk/fcl.hpp: octrees, of OctoMap's trees and of cstk::Octree. No header of OctoMap is needed here. */
#ifndef CSTK_FCL_OCTREE_HPP
#define CSTK_FCL_OCTREE_HPP

#include <cstk/fcl/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

/* Programs that ask whether their FCL has octrees keep them. */
#ifndef FCL_HAVE_OCTOMAP
#define FCL_HAVE_OCTOMAP 1
#endif

namespace cstk_fcl {

namespace detail {

/// A leaf of a tree, in the tree's frame: a cube, and the logarithm of the odds that it is occupied.
struct Leaf {
    std::array<double, 3> center;
    double size;
    float log_odds;

    bool has_place_of(const Leaf &other) const { return center == other.center && size == other.size; }
    bool operator==(const Leaf &other) const { return has_place_of(other) && log_odds == other.log_odds; }
};

inline float log_odds_of(double probability) { return static_cast<float>(std::log(probability / (1 - probability))); }
inline double probability_of(double log_odds) { return 1 - 1 / (1 + std::exp(log_odds)); }

/// The leaves of a tree that is walked as OctoMap's are.
template <typename Tree> std::vector<Leaf> leaves_of(const Tree &tree) {
    std::vector<Leaf> leaves;
    const auto end = tree.end_leafs();
    for (auto it = tree.begin_leafs(); it != end; ++it) {
        leaves.push_back({{it.getX(), it.getY(), it.getZ()}, it.getSize(), (*it).getLogOdds()});
    }
    return leaves;
}

/// The largest cubes of occupied cells, which are certain.
inline std::vector<Leaf> leaves_of(const cstk::Octree &octree) {
    std::vector<Leaf> leaves;
    const std::vector<double> cubes = octree.cubes();
    for (std::size_t i = 0; i < cubes.size(); i += 4) {
        const double half = cubes[i + 3] / 2;
        leaves.push_back({{cubes[i] + half, cubes[i + 1] + half, cubes[i + 2] + half}, cubes[i + 3],
                          std::numeric_limits<float>::infinity()});
    }
    return leaves;
}

} // namespace detail

/// The occupied leaves of an octree, each a solid box. Occupied are those that are as likely so as the threshold; what is free,
/// uncertain or unknown is empty. Answers (b1, b2) name a leaf by its place in toBoxes().
///
/// The tree is read when a query first needs it, and by computeLocalAABB(), which each new CollisionObject calls. After the tree
/// has changed, call that one, and computeAABB() of its objects. The body is built at the first query, and again only where
/// occupied leaves have changed.
template <typename S_> class OcTree : public CollisionGeometry<S_> {
public:
    using S = S_;

    /// Without cells.
    OcTree(S resolution) : OcTree(cstk::Octree(static_cast<double>(resolution))) {}

    /// Of an octomap::OcTree, const or not, or of a tree of another kind that has begin_leafs(), end_leafs(), getResolution(),
    /// getOccupancyThres() and getOccupancyThresLog() as those have, nodes with getLogOdds(), and iterators with getX(), getY(),
    /// getZ() and getSize().
    template <typename Tree> OcTree(const std::shared_ptr<Tree> &tree) : source_(source_of(tree)) {}

    /// Not of FCL: of the library's own octree, which also reads OctoMap's files: OcTree<double>(cstk::Octree::load("room.bt")).
    OcTree(const cstk::Octree &octree) {
        source_.read = [octree] { return detail::leaves_of(octree); };
        source_.resolution = octree.resolution();
    }

    /// The copy is of the same tree.
    OcTree(const OcTree &other) : CollisionGeometry<S>(other), source_(other.source_) {}
    OcTree &operator=(const OcTree &other) {
        CollisionGeometry<S>::operator=(other);
        source_ = other.source_;
        forget();
        return *this;
    }

    OBJECT_TYPE getObjectType() const override { return OT_OCTREE; }
    NODE_TYPE getNodeType() const override { return GEOM_OCTREE; }

    /// Reads the tree. The box is around all leaves, occupied or not, so that thresholds do not change it; FCL's is getRootBV().
    /// Threads may call it at once, as those that make objects of one octree do, while the tree does not change.
    void computeLocalAABB() override {
        const std::vector<detail::Leaf> leaves = source_.read();
        read_again(occupied_of(leaves));
        AABB<S> box = leaves.empty() ? AABB<S>(Vector3<S>(Vector3<S>::Zero())) : AABB<S>();
        for (const detail::Leaf &leaf : leaves) {
            const Eigen::Vector3d center = detail::point_of(leaf.center.data());
            const Eigen::Vector3d half = Eigen::Vector3d::Constant(leaf.size / 2);
            box += AABB<S>(Vector3<S>((center - half).template cast<S>()), Vector3<S>((center + half).template cast<S>()));
        }
        const std::lock_guard<std::mutex> lock(reading_);
        if (!this->aabb_local.equal(box)) {
            this->aabb_local = box;
            this->aabb_center = box.center();
            this->aabb_radius = (box.max_ - this->aabb_center).norm();
        }
    }

    /// The cube of the whole grid, with 16 levels.
    AABB<S> getRootBV() const {
        const S half = static_cast<S>(source_.resolution * (1 << 15));
        return AABB<S>(Vector3<S>::Constant(-half), Vector3<S>::Constant(half));
    }

    /// The occupied leaves, in the order of the tree: center, size, how likely each is occupied, and the tree's own threshold.
    std::vector<std::array<S, 6>> toBoxes() const {
        std::vector<std::array<S, 6>> boxes;
        for (const detail::Leaf &leaf : occupied().leaves) {
            boxes.push_back({static_cast<S>(leaf.center[0]), static_cast<S>(leaf.center[1]), static_cast<S>(leaf.center[2]),
                             static_cast<S>(leaf.size), static_cast<S>(detail::probability_of(leaf.log_odds)),
                             static_cast<S>(source_.tree_threshold)});
        }
        return boxes;
    }

    /* Thresholds are probabilities. A leaf at the threshold is occupied. */
    S getOccupancyThres() const { return static_cast<S>(detail::probability_of(source_.occupied_log_odds)); }
    S getFreeThres() const { return static_cast<S>(detail::probability_of(source_.free_log_odds)); }
    S getDefaultOccupancy() const { return source_.default_occupancy; }
    void setOccupancyThres(S d) {
        source_.occupied_log_odds = detail::log_odds_of(static_cast<double>(d));
        forget();
    }
    /// Only isNodeFree() and isNodeUncertain() ask for it.
    void setFreeThres(S d) { source_.free_log_odds = detail::log_odds_of(static_cast<double>(d)); }
    void setCellDefaultOccupancy(S d) { source_.default_occupancy = d; }

    /* Of nodes of the tree. */
    template <typename Node> bool isNodeOccupied(const Node *node) const { return is_occupied(node->getLogOdds()); }
    template <typename Node> bool isNodeFree(const Node *node) const { return node->getLogOdds() <= source_.free_log_odds; }
    template <typename Node> bool isNodeUncertain(const Node *node) const { return !isNodeOccupied(node) && !isNodeFree(node); }

    void getRoot() const = delete; // ask the tree itself for its nodes
    template <typename Node> void getNodeChild(Node *node, unsigned int childIdx) const = delete; // ask the tree itself for its nodes
    template <typename Node> bool nodeChildExists(const Node *node, unsigned int childIdx) const = delete; // ask the tree itself for its nodes
    template <typename Node> bool nodeHasChildren(const Node *node) const = delete; // ask the tree itself for its nodes
    template <typename... Out> void getNodeByQueryCellId(std::intptr_t id, const Vector3<S> &point, Out... out) const = delete; // tree->search(x, y, z) finds that of toBoxes()[b1]

    const cstk::Body &body() const override {
        const OccupiedLeaves &now = occupied();
        if (now.leaves.empty()) {
            throw std::invalid_argument("cstk_fcl: an OcTree without occupied leaves has no body");
        }
        return now.body->of({}, [&now](cstk::BodyBuilder &builder) {
            std::uint64_t tag = 0;
            for (const detail::Leaf &leaf : now.leaves) {
                cstk::Pose pose = cstk::identity();
                detail::RowMajorPose(pose.data()).col(3) = detail::point_of(leaf.center.data());
                const double half = leaf.size / 2;
                builder.add_box(pose, {half, half, half}, tag++);
            }
        });
    }

    bool is_empty() const override { return occupied().leaves.empty(); }
    std::size_t primitive_count() const override { return occupied().leaves.size(); }

    Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t primitive) const override {
        const detail::Leaf &leaf = occupied().leaves[primitive];
        const double half = leaf.size / 2;
        return {leaf.center[0] + std::copysign(half, direction[0]), leaf.center[1] + std::copysign(half, direction[1]),
                leaf.center[2] + std::copysign(half, direction[2])};
    }

private:
    /// The tree, and what is asked of it: as OctoMap's defaults.
    struct Source {
        std::function<std::vector<detail::Leaf>()> read;
        double resolution = 0;
        double tree_threshold = 0.5;
        S default_occupancy = static_cast<S>(0.5);
        float occupied_log_odds = 0;
        float free_log_odds = 0;
    };

    struct OccupiedLeaves {
        std::vector<detail::Leaf> leaves;
        std::shared_ptr<detail::ShapeBody<0>> body = std::make_shared<detail::ShapeBody<0>>();
    };

    template <typename Tree> static Source source_of(const std::shared_ptr<Tree> &tree) {
        if (!tree) {
            throw std::invalid_argument("cstk_fcl: an OcTree is made of no tree");
        }
        Source source;
        source.read = [tree] { return detail::leaves_of(*tree); };
        source.resolution = tree->getResolution();
        source.tree_threshold = tree->getOccupancyThres();
        source.default_occupancy = static_cast<S>(source.tree_threshold);
        source.occupied_log_odds = tree->getOccupancyThresLog();
        return source;
    }

    /// Odds that are not a number count as occupied.
    bool is_occupied(float log_odds) const { return !(log_odds < source_.occupied_log_odds); }

    std::unique_ptr<OccupiedLeaves> occupied_of(const std::vector<detail::Leaf> &leaves) const {
        auto out = std::make_unique<OccupiedLeaves>();
        for (const detail::Leaf &leaf : leaves) {
            if (is_occupied(leaf.log_odds)) {
                out->leaves.push_back(leaf);
            }
        }
        return out;
    }

    const OccupiedLeaves &occupied() const {
        const OccupiedLeaves *known = ready_.load(std::memory_order_acquire);
        if (known != nullptr) {
            return *known;
        }
        const std::lock_guard<std::mutex> lock(reading_);
        if (!occupied_) {
            publish(occupied_of(source_.read()));
        }
        return *occupied_;
    }

    /// Takes what was read now. What has not changed stays, since other threads may use it.
    void read_again(std::unique_ptr<OccupiedLeaves> now) const {
        const std::lock_guard<std::mutex> lock(reading_);
        if (occupied_ && now->leaves == occupied_->leaves) {
            return;
        }
        const auto has_place_of = [](const detail::Leaf &a, const detail::Leaf &b) { return a.has_place_of(b); };
        if (occupied_ && std::equal(now->leaves.begin(), now->leaves.end(), occupied_->leaves.begin(), occupied_->leaves.end(),
                                    has_place_of)) {
            now->body = occupied_->body;
        }
        publish(std::move(now));
    }

    void publish(std::unique_ptr<const OccupiedLeaves> occupied) const {
        ready_.store(occupied.get(), std::memory_order_release);
        occupied_ = std::move(occupied);
    }

    void forget() {
        const std::lock_guard<std::mutex> lock(reading_);
        publish(nullptr);
    }

    Source source_;
    mutable std::mutex reading_;
    mutable std::unique_ptr<const OccupiedLeaves> occupied_;
    mutable std::atomic<const OccupiedLeaves *> ready_{nullptr};
};

using OcTreef = OcTree<float>;
using OcTreed = OcTree<double>;

} // namespace cstk_fcl

#endif
