// OcTree of a tree of the test's own: distances, contacts and depths of cells by closed forms; thresholds, trees that change or are
// empty, managers, motions, and the library's own octree.
#include "library.hpp"

#include <limits>
#include <set>

namespace {

struct Cell {
    double center[3], size;
    float log_odds;
    float getLogOdds() const { return log_odds; }
};

// Walked as OctoMap's trees are, and no more than that.
class Tree {
  public:
    class Iterator {
      public:
        explicit Iterator(const Cell *cell) : cell_(cell) {}
        bool operator!=(const Iterator &other) const { return cell_ != other.cell_; }
        void operator++() { ++cell_; }
        const Cell &operator*() const { return *cell_; }
        double getX() const { return cell_->center[0]; }
        double getY() const { return cell_->center[1]; }
        double getZ() const { return cell_->center[2]; }
        double getSize() const { return cell_->size; }

      private:
        const Cell *cell_;
    };

    Iterator begin_leafs() const { return Iterator(cells.data()); }
    Iterator end_leafs() const { return Iterator(cells.data() + cells.size()); }
    double getResolution() const { return 0.1; }
    double getOccupancyThres() const { return 0.5; }
    float getOccupancyThresLog() const { return 0; }

    std::vector<Cell> cells;
};

// Cells of two sizes, no two in one place, half of them occupied.
std::shared_ptr<Tree> random_tree(std::uint64_t seed, int count, int reach) {
    models::Random random(seed);
    const auto tree = std::make_shared<Tree>();
    std::set<std::array<int, 3>> taken;
    const auto coordinate = [&] { return static_cast<int>(random.below(static_cast<std::size_t>(2 * reach))) - reach; };
    while (static_cast<int>(tree->cells.size()) < count) {
        const std::array<int, 3> at = {coordinate(), coordinate(), coordinate()};
        if (taken.insert(at).second) {
            // Of a cube of two steps, the lowest cell or all of it.
            const double size = random.below(3) == 0 ? 0.2 : 0.1;
            const auto center = [&](int axis) { return at[static_cast<std::size_t>(axis)] * 0.2 + size / 2; };
            tree->cells.push_back({{center(0), center(1), center(2)}, size, static_cast<float>(random.uniform(-2, 2))});
        }
    }
    return tree;
}

std::vector<Cell> occupied(const Tree &tree, double log_odds = 0) {
    std::vector<Cell> out;
    for (const Cell &cell : tree.cells) {
        if (cell.log_odds >= static_cast<float>(log_odds)) {
            out.push_back(cell);
        }
    }
    return out;
}

// How far a point is from a cell: 0 inside.
double from_cell(const Vector &point, const Cell &cell) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = std::fabs(point[axis] - cell.center[axis]) - cell.size / 2;
        square += std::pow(std::max(beyond, 0.0), 2);
    }
    return std::sqrt(square);
}

// The distance of two cells, the second shifted.
double between_cells(const Cell &a, const Cell &b, const Vector &shift) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = std::fabs(b.center[axis] + shift[axis] - a.center[axis]) - (a.size + b.size) / 2;
        square += std::pow(std::max(beyond, 0.0), 2);
    }
    return std::sqrt(square);
}

// Which cells a ball meets, how far it is from the nearest, in both orders of the arguments.
void balls() {
    const auto tree = random_tree(71, 4000, 10);
    const fcl::OcTreed octree(tree);
    const std::vector<Cell> cells = occupied(*tree);
    expect(octree.toBoxes().size() == cells.size() && cells.size() > 1500, "the occupied leaves");
    models::Random random(72);
    for (int i = 0; i < 200; ++i) {
        const fcl::Sphered ball(random.uniform(0.01, 0.3));
        const Vector center(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
        const Transform to = random_transform(random, 3), tb = to * at(center[0], center[1], center[2]);
        double nearest = std::numeric_limits<double>::infinity();
        std::set<std::intptr_t> met, found;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const double gap = from_cell(center, cells[c]) - ball.radius;
            nearest = std::min(nearest, gap);
            if (gap <= 0) {
                met.insert(static_cast<std::intptr_t>(c));
            }
        }
        fcl::DistanceResultd there, back;
        fcl::distance<double>(&octree, to, &ball, tb, fcl::DistanceRequestd(true), there);
        fcl::distance<double>(&ball, tb, &octree, to, fcl::DistanceRequestd(true), back);
        expect_near(there.min_distance, nearest > 0 ? nearest : -1, 1e-9, "distance of an octree from a ball");
        expect_near(back.min_distance, there.min_distance, 1e-9, "and of the ball from the octree");
        if (nearest > 0) {
            const Cell &named = cells[static_cast<std::size_t>(there.b1)];
            expect_near(from_cell(center, named) - ball.radius, nearest, 1e-9, "the nearest cell");
            expect_near(from_cell(to.inverse() * there.nearest_points[0], named), 0, 1e-9, "its nearest point is in it");
            expect(back.b2 == there.b1 && there.b2 == fcl::DistanceResultd::NONE, "cells are named, balls are not");
        }
        fcl::CollisionRequestd request(100000, true);
        fcl::CollisionResultd result;
        fcl::collide<double>(&octree, to, &ball, tb, request, result);
        for (std::size_t k = 0; k < result.numContacts(); ++k) {
            const fcl::Contactd &contact = result.getContact(k);
            found.insert(contact.b1);
            const double outside = from_cell(center, cells[static_cast<std::size_t>(contact.b1)]);
            expect(contact.o1 == &octree && contact.o2 == &ball, "contacts name the geometries in their order");
            if (outside > 0) {
                expect_near(contact.penetration_depth, ball.radius - outside, 1e-9, "depth of a ball in a cell");
            }
        }
        expect(found == met, "the cells that a ball meets");
        fcl::CollisionResultd decided;
        const bool meet = fcl::collide<double>(&ball, tb, &octree, to, fcl::CollisionRequestd(), decided) > 0;
        expect(meet == !met.empty(), "whether they meet");
    }
}

// Two octrees whose axes are parallel.
void two_octrees() {
    const auto first = random_tree(73, 900, 6), second = random_tree(74, 700, 5);
    const fcl::OcTreed a(first), b(second);
    const std::vector<Cell> in_a = occupied(*first), in_b = occupied(*second);
    models::Random random(75);
    for (int i = 0; i < 40; ++i) {
        const double reach = i % 2 == 0 ? 1 : 5;
        const Vector shift(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
        const Transform ta = random_transform(random, 4), tb = ta * at(shift[0], shift[1], shift[2]);
        double nearest = std::numeric_limits<double>::infinity();
        std::size_t met = 0;
        for (const Cell &p : in_a) {
            for (const Cell &q : in_b) {
                const double gap = between_cells(p, q, shift);
                nearest = std::min(nearest, gap);
                met += gap == 0 ? 1 : 0;
            }
        }
        fcl::DistanceResultd distance;
        fcl::distance<double>(&a, ta, &b, tb, fcl::DistanceRequestd(), distance);
        expect_near(distance.min_distance, met == 0 ? nearest : -1, 1e-9, "distance of two octrees");
        fcl::CollisionResultd all;
        fcl::collide<double>(&a, ta, &b, tb, fcl::CollisionRequestd(1000000, true), all);
        expect_near(static_cast<double>(all.numContacts()), static_cast<double>(met), 0, "pairs of cells that meet");
    }
}

// The deepest corner below a half-space.
void half_spaces() {
    const auto tree = random_tree(76, 500, 5);
    const fcl::OcTreed octree(tree);
    models::Random random(77);
    for (int i = 0; i < 100; ++i) {
        const Transform to = random_transform(random, 1);
        const fcl::Halfspaced half(Vector(random.uniform(-1, 1), random.uniform(-1, 1), 1.5), random.uniform(-2, 0));
        const Vector n = to.linear().transpose() * half.n;
        double lowest = std::numeric_limits<double>::infinity();
        for (const Cell &cell : occupied(*tree)) {
            const double height = n.dot(Vector(cell.center[0], cell.center[1], cell.center[2])) - cell.size / 2 * n.lpNorm<1>();
            lowest = std::min(lowest, height + half.n.dot(to.translation()) - half.d);
        }
        fcl::CollisionResultd result;
        const bool meets = fcl::collide<double>(&octree, to, &half, at(0, 0, 0), fcl::CollisionRequestd(1, true), result) > 0;
        expect(meets == (lowest <= 0), "whether an octree is below a half-space");
        expect_near(meets ? result.getContact(0).penetration_depth : 0, std::max(-lowest, 0.0), 1e-9, "and how deeply");
    }
}

// What is occupied follows the threshold; odds that are not a number are occupied.
void thresholds() {
    const auto tree = random_tree(78, 600, 5);
    fcl::OcTreed octree(tree);
    expect_near(octree.getOccupancyThres(), 0.5, 1e-6, "the tree's threshold");
    for (const double threshold : {0.3, 0.5, 0.7, 0.85}) {
        octree.setOccupancyThres(threshold);
        const std::vector<Cell> cells = occupied(*tree, std::log(threshold / (1 - threshold)));
        expect_near(octree.getOccupancyThres(), threshold, 1e-6, "a threshold");
        expect(octree.toBoxes().size() == cells.size(), "leaves above a threshold");
        const fcl::Sphered ball(0.01);
        fcl::DistanceResultd result;
        fcl::distance<double>(&octree, at(0, 0, 0), &ball, at(3, 0.2, 0.1), fcl::DistanceRequestd(), result);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Cell &cell : cells) {
            nearest = std::min(nearest, from_cell(Vector(3, 0.2, 0.1), cell) - 0.01);
        }
        expect_near(result.min_distance, nearest, 1e-9, "distance above a threshold");
    }
    const Cell likely = {{0, 0, 0}, 0.1, 1}, unlikely = {{0, 0, 0}, 0.1, -1};
    octree.setOccupancyThres(0.6);
    octree.setFreeThres(0.4);
    expect(octree.isNodeOccupied(&likely) && !octree.isNodeFree(&likely) && !octree.isNodeUncertain(&likely), "an occupied node");
    expect(!octree.isNodeOccupied(&unlikely) && octree.isNodeFree(&unlikely), "a free node");
    const Cell doubtful = {{0, 0, 0}, 0.1, std::numeric_limits<float>::quiet_NaN()};
    expect(octree.isNodeOccupied(&doubtful), "doubt counts as occupied");
}

// Nothing occupied: it meets nothing, and is near nothing.
void empty_ones() {
    const auto bare = std::make_shared<Tree>(), freed = std::make_shared<Tree>();
    freed->cells.push_back({{0, 0, 0}, 1, -1});
    const fcl::OcTreed of_resolution(0.1), of_bare(bare), of_freed(freed);
    const fcl::Sphered ball(2);
    const fcl::Halfspaced half(0, 0, 1, 5);
    for (const fcl::OcTreed *octree : {&of_resolution, &of_bare, &of_freed}) {
        for (const fcl::CollisionGeometryd *other : {static_cast<const fcl::CollisionGeometryd *>(&ball),
                                                     static_cast<const fcl::CollisionGeometryd *>(&half),
                                                     static_cast<const fcl::CollisionGeometryd *>(&of_freed)}) {
            fcl::CollisionResultd result;
            fcl::DistanceResultd distance;
            expect(fcl::collide<double>(octree, at(0, 0, 0), other, at(0, 0, 0), fcl::CollisionRequestd(9, true), result) == 0,
                   "an empty octree meets nothing");
            fcl::distance<double>(other, at(0, 0, 0), octree, at(0, 0, 0), fcl::DistanceRequestd(), distance);
            expect(distance.min_distance == std::numeric_limits<double>::max() && distance.o1 == nullptr, "and is near nothing");
        }
        fcl::ContinuousCollisionResultd motion;
        fcl::continuousCollide<double>(octree, at(-9, 0, 0), at(9, 0, 0), &ball, at(0, 0, 0), at(0, 0, 0),
                                       fcl::ContinuousCollisionRequestd(), motion);
        expect(!motion.is_collide && motion.time_of_contact == 1, "and passes through everything");
    }
    fcl::CollisionObjectd object(std::make_shared<fcl::OcTreed>(bare), at(1, 2, 3));
    expect(object.getAABB().min_.allFinite() && object.getAABB().max_.allFinite(), "its box is finite");
    bool refused = false;
    try {
        fcl::OcTreed none(std::shared_ptr<const Tree>{});
    } catch (const std::invalid_argument &) {
        refused = true;
    }
    expect(refused, "no tree is refused");
}

double distance_of(const fcl::OcTreed &octree, double x) {
    const fcl::Sphered ball(0.1);
    fcl::DistanceResultd result;
    fcl::distance<double>(&octree, at(0, 0, 0), &ball, at(x, 0, 0), fcl::DistanceRequestd(), result);
    return result.min_distance;
}

// A tree that changes is read again by computeLocalAABB(), and by new objects.
void changes() {
    const auto tree = std::make_shared<Tree>();
    tree->cells.push_back({{0, 0, 0}, 0.2, 1});
    const auto octree = std::make_shared<fcl::OcTreed>(tree);
    expect_near(distance_of(*octree, 5), 4.8, 1e-12, "one cell");
    const fcl::OcTreed copy(*octree);
    tree->cells.push_back({{1, 0, 0}, 0.2, 1});
    octree->computeLocalAABB();
    expect_near(distance_of(*octree, 5), 3.8, 1e-12, "a cell more");
    expect_near(octree->aabb_local.max_[0], 1.1, 1e-12, "its box");
    expect_near(octree->aabb_radius, std::hypot(0.6, std::hypot(0.1, 0.1)), 1e-12, "the box's radius");
    tree->cells[1].log_odds = -1;
    const fcl::CollisionObjectd object(octree);
    expect_near(distance_of(*octree, 5), 4.8, 1e-12, "a cell freed");
    expect_near(distance_of(copy, 5), 4.8, 1e-12, "a copy is of the same tree");
    const cstk::Body before = octree->body();
    tree->cells[0].log_odds = 2;
    octree->computeLocalAABB();
    expect(octree->body().get() == before.get(), "the body of cells that stay is kept");
    expect_near(octree->toBoxes()[0][4], 1 / (1 + std::exp(-2.0)), 1e-6, "and how likely they are is read");
    expect(octree->getObjectType() == fcl::OT_OCTREE && octree->getNodeType() == fcl::GEOM_OCTREE, "types");
    expect_near(octree->getRootBV().max_[1], 3276.8, 1e-9, "the grid");
}

// An octree among other objects, in managers with the callbacks that FCL brings.
void managers() {
    const auto tree = random_tree(79, 800, 6);
    const std::vector<Cell> cells = occupied(*tree);
    fcl::CollisionObjectd map(std::make_shared<fcl::OcTreed>(tree), at(0.5, 0, 0));
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> balls;
    fcl::DynamicAABBTreeCollisionManagerd manager;
    const auto ball = std::make_shared<fcl::Sphered>(0.1);
    models::Random random(80);
    std::size_t met = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 200; ++i) {
        const Transform tf = random_transform(random, 1.4);
        balls.push_back(std::make_unique<fcl::CollisionObjectd>(ball, tf));
        manager.registerObject(balls.back().get());
        double gap = std::numeric_limits<double>::infinity();
        for (const Cell &cell : cells) {
            gap = std::min(gap, from_cell(tf.translation() - Vector(0.5, 0, 0), cell) - 0.1);
        }
        met += gap <= 0 ? 1 : 0;
        nearest = std::min(nearest, gap);
    }
    manager.setup();
    struct Count {
        std::size_t met = 0;
    } count;
    manager.collide(&map, &count, [](fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data) {
        fcl::CollisionResultd result;
        static_cast<Count *>(data)->met += fcl::collide(a, b, fcl::CollisionRequestd(), result);
        return false;
    });
    expect_near(static_cast<double>(count.met), static_cast<double>(met), 0, "the objects that an octree meets");
    expect(met > 20 && met < 180, "some are met");
    fcl::DefaultDistanceData<double> data;
    manager.distance(&map, &data, fcl::DefaultDistanceFunction<double>);
    expect(data.result.min_distance <= 0 && nearest <= 0, "the distance of an octree from a manager's objects");
}

// The library's own octree: eight cells that fill a cube are one box, and its changes are seen.
void own_octree() {
    cstk::Octree cells(0.1);
    std::vector<double> points;
    for (int i = 0; i < 8; ++i) {
        points.insert(points.end(), {0.05 + 0.1 * (i & 1), 0.05 + 0.1 * (i >> 1 & 1), 0.05 + 0.1 * (i >> 2)});
    }
    cells.set(points);
    fcl::OcTreed octree(cells);
    expect(octree.toBoxes().size() == 1 && octree.toBoxes()[0][3] == 0.2 && octree.toBoxes()[0][4] == 1, "one cube");
    const fcl::Capsuled capsule(0.1, 1);
    const auto distance = [&] {
        fcl::DistanceResultd result;
        fcl::distance<double>(&octree, at(0, 0, 0), &capsule, at(1, 0.1, 0.1), fcl::DistanceRequestd(), result);
        return result.min_distance;
    };
    expect_near(distance(), 0.7, 1e-12, "distance of a cube");
    const double more[3] = {0.45, 0.15, 0.15};
    cells.set(more);
    octree.computeLocalAABB();
    expect_near(distance(), 0.4, 1e-12, "distance of a cell that came");
    // A ball towards the cell, whose side is at .5: they meet when its center is at .75.
    const fcl::Sphered ball(0.25);
    fcl::ContinuousCollisionResultd motion;
    fcl::continuousCollide<double>(&octree, at(0, 0, 0), at(0, 0, 0), &ball, at(2.8, 0.15, 0.15), at(0.8, 0.15, 0.15),
                                   fcl::ContinuousCollisionRequestd(), motion);
    expect(!motion.is_collide, "a motion that ends before a cell");
    fcl::continuousCollide<double>(&octree, at(0, 0, 0), at(0, 0, 0), &ball, at(1.75, 0.15, 0.15), at(-0.25, 0.15, 0.15),
                                   fcl::ContinuousCollisionRequestd(), motion);
    expect(motion.is_collide, "a motion through a cell");
    expect_near(motion.time_of_contact, 0.5, 1e-3, "and when it meets it");
    const fcl::OcTreef single(cells);
    fcl::DistanceResultf in_single;
    const fcl::Spheref small(0.25F);
    fcl::Transform3f tf = fcl::Transform3f::Identity();
    tf.translation() << 1.75F, 0.15F, 0.15F;
    fcl::distance<float>(&single, fcl::Transform3f::Identity(), &small, tf, fcl::DistanceRequestf(), in_single);
    expect_near(in_single.min_distance, 1, 1e-6, "in single precision");
}

} // namespace

int main() {
    balls();
    two_octrees();
    half_spaces();
    thresholds();
    empty_ones();
    changes();
    managers();
    own_octree();
    return failures() == 0 ? 0 : 1;
}
