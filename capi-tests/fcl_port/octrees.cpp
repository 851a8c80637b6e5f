// OcTree of OctoMap's trees: boxes, thresholds, decisions, distances and which cells meet, against every geometry and an octree.
#include "library.hpp"

#include <octomap/octomap.h>

#ifndef WITH_FCL
#include <unistd.h>
#endif

namespace {

using Tree = std::shared_ptr<octomap::OcTree>;

// A shell that was seen once or more often, free cells, and a block that is full, whose leaves are larger.
Tree mapped(std::uint64_t seed, int seen, double radius) {
    models::Random random(seed);
    auto tree = std::make_shared<octomap::OcTree>(0.1);
    const auto update = [&](double x, double y, double z, bool occupied) {
        tree->updateNode(octomap::point3d(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)), occupied);
    };
    for (int i = 0; i < seen; ++i) {
        const models::Point d = random.direction();
        const double r = radius * random.uniform(0.9, 1.1);
        const std::size_t times = 1 + random.below(3);
        for (std::size_t k = 0; k < times; ++k) {
            update(r * d[0], r * d[1], r * d[2], true);
        }
        update(0.7 * r * d[0], 0.7 * r * d[1], 0.7 * r * d[2], random.below(4) == 0);
    }
    for (int i = 0; i < 512; ++i) {
        for (int k = 0; k < 8; ++k) {
            update(0.05 + 0.1 * (i & 7), 0.05 + 0.1 * (i >> 3 & 7), 0.05 + 0.1 * (i >> 6), true);
        }
    }
    return tree;
}

void boxes() {
    const Tree tree = mapped(91, 800, 1.2);
    fcl::OcTreed octree(tree);
    double largest = 0;
    for (const double threshold : {0.0, 0.6, 0.75, 0.9}) {
        if (threshold > 0) {
            octree.setOccupancyThres(threshold);
        }
        const std::string label = "boxes/" + std::to_string(threshold);
        answer(label + "/threshold", octree.getOccupancyThres(), 1e-12);
        double sums[6] = {};
        const auto all = octree.toBoxes();
        for (const auto &box : all) {
            for (std::size_t k = 0; k < 6; ++k) {
                sums[k] += box[k] * (k < 3 ? box[(k + 1) % 3] + 2 : 1);
            }
            largest = std::max(largest, box[3]);
        }
        answer(label + "/count", static_cast<double>(all.size()), 0);
        for (int k = 0; k < 6; ++k) {
            answer(label + "/" + std::to_string(k), sums[k], 1e-9);
        }
    }
    expect_near(largest, 0.8, 1e-12, "a leaf of eight cells along an edge");
    octree.setFreeThres(0.3);
    answer("boxes/free", octree.getFreeThres(), 1e-12);
    answer("boxes/default", octree.getDefaultOccupancy(), 1e-12);
    answer("boxes/grid", octree.getRootBV().max_[0], 1e-9);
    const octomap::OcTreeNode *node = tree->search(0.05, 0.05, 0.05);
    expect(node != nullptr && octree.isNodeOccupied(node) && !octree.isNodeFree(node), "a node of the block");
    expect(octree.getObjectType() == fcl::OT_OCTREE && octree.getNodeType() == fcl::GEOM_OCTREE, "types");
}

struct Named {
    std::string name;
    Geometry geometry;
    // Distances of FCL end within its solver's tolerance of 1e-6, those of round shapes sometimes farther off.
    bool polyhedral;
};

std::vector<Named> others() {
    return {{"box", std::make_shared<fcl::Boxd>(0.3, 0.5, 0.8), true},
            {"sphere", std::make_shared<fcl::Sphered>(0.3), false},
            {"capsule", std::make_shared<fcl::Capsuled>(0.15, 0.6), false},
            {"cylinder", std::make_shared<fcl::Cylinderd>(0.2, 0.6), false},
            {"cone", std::make_shared<fcl::Coned>(0.3, 0.6), false},
            {"ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.15, 0.25, 0.4), false},
            {"convex", convex_of(models::cylinder("prism", 0.25, 0.5, 7)), true},
            {"model", model_of(models::torus(0.4, 0.12, 12, 8)), true},
            {"octree", std::make_shared<fcl::OcTreed>(mapped(92, 150, 0.6)), true}};
}

// How many pairs of cells and primitives meet, up to a number; with contacts wanted, FCL would list several of a pair.
std::size_t contacts(const fcl::CollisionGeometryd *a, const Transform &ta, const fcl::CollisionGeometryd *b, const Transform &tb,
                     std::size_t max_count) {
    fcl::CollisionResultd result;
    return fcl::collide<double>(a, ta, b, tb, fcl::CollisionRequestd(max_count), result);
}

// In FCL's program, the cells that meet a shape by the shape and each box; in the other, those that contacts name.
double which_cells(const fcl::OcTreed &octree, const Transform &to, const Named &other, const Transform &tb) {
    double sum = 0;
#ifdef WITH_FCL
    const auto all = octree.toBoxes();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const fcl::Boxd box(all[i][3], all[i][3], all[i][3]);
        const Transform place = to * at(all[i][0], all[i][1], all[i][2]);
        sum += contacts(&box, place, other.geometry.get(), tb, 1) > 0 ? static_cast<double>(i + 1) : 0;
    }
#else
    fcl::CollisionResultd result;
    fcl::collide<double>(&octree, to, other.geometry.get(), tb, fcl::CollisionRequestd(100000, true), result);
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
        sum += static_cast<double>(result.getContact(i).b1 + 1);
    }
#endif
    return sum;
}

void pairs() {
    const fcl::OcTreed octree(mapped(93, 800, 1.2));
    for (const Named &other : others()) {
        models::Random random(other.name.size() * 131 + 7);
        int meeting = 0;
        for (int i = 0; i < 24; ++i) {
            const Transform to = random_transform(random, 0.5), tb = random_transform(random, i % 2 == 0 ? 1.5 : 2.5);
            const std::string label = "octree/" + other.name + "/" + std::to_string(i);
            fcl::DistanceResultd there, back;
            fcl::distance<double>(&octree, to, other.geometry.get(), tb, fcl::DistanceRequestd(), there);
            fcl::distance<double>(other.geometry.get(), tb, &octree, to, fcl::DistanceRequestd(), back);
            const bool meet = contacts(&octree, to, other.geometry.get(), tb, 1) > 0;
            expect(meet == (contacts(other.geometry.get(), tb, &octree, to, 1) > 0), label + ": in both orders");
            meeting += meet ? 1 : 0;
            const double gap = there.min_distance > 0 ? there.min_distance : 1;
            decision(label + "/meet", meet, gap, 1e-5);
            answer(label + "/distance", std::max(there.min_distance, 0.0), other.polyhedral ? 1e-5 : 1e-3);
            answer(label + "/distance_back", std::max(back.min_distance, 0.0), other.polyhedral ? 1e-5 : 1e-3);
            if (other.geometry->getObjectType() == fcl::OT_GEOM) {
                answer(label + "/cells", which_cells(octree, to, other, tb), 0);
            } else {
                answer(label + "/count", static_cast<double>(contacts(&octree, to, other.geometry.get(), tb, 100000)), 0);
            }
        }
        expect(meeting > 3 && meeting < 22, other.name + ": some meet the octree, some do not");
    }
}

// A tree that a threshold empties of its uncertain cells.
void thresholds() {
    const Tree tree = mapped(94, 800, 1.2);
    const fcl::Boxd box(0.2, 0.2, 0.2);
    for (const double threshold : {0.6, 0.8, 0.9}) {
        fcl::OcTreed octree(tree);
        octree.setOccupancyThres(threshold);
        models::Random random(95);
        for (int i = 0; i < 40; ++i) {
            const Transform tb = random_transform(random, 1.2);
            const std::string label = "threshold/" + std::to_string(threshold) + "/" + std::to_string(i);
            fcl::DistanceResultd result;
            fcl::distance<double>(&octree, at(0, 0, 0), &box, tb, fcl::DistanceRequestd(), result);
            const double gap = result.min_distance > 0 ? result.min_distance : 1;
            decision(label, contacts(&octree, at(0, 0, 0), &box, tb, 1) > 0, gap, 1e-5);
            answer(label + "/distance", std::max(result.min_distance, 0.0), 1e-5);
        }
    }
}

// An octree as an object among others.
void managers() {
    fcl::CollisionObjectd map(std::make_shared<fcl::OcTreed>(mapped(96, 800, 1.2)), at(0.3, 0.2, 0.1));
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    fcl::DynamicAABBTreeCollisionManagerd inner, outer;
    for (fcl::DynamicAABBTreeCollisionManagerd *manager : {&inner, &outer}) {
        manager->octree_as_geometry_collide = true;
        manager->octree_as_geometry_distance = true;
    }
    models::Random random(97);
    for (int i = 0; i < 60; ++i) {
        const auto box = std::make_shared<fcl::Boxd>(0.1, random.uniform(0.05, 0.2), 0.2);
        Transform tf = random_transform(random, 1.4);
        objects.push_back(std::make_unique<fcl::CollisionObjectd>(box, tf));
        inner.registerObject(objects.back().get());
        tf.translation()[0] += 5;
        objects.push_back(std::make_unique<fcl::CollisionObjectd>(box, tf));
        outer.registerObject(objects.back().get());
    }
    inner.setup();
    outer.setup();
    std::size_t met = 0;
    const auto count = [](fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data) {
        fcl::CollisionResultd result;
        *static_cast<std::size_t *>(data) += fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0 ? 1 : 0;
        return false;
    };
    inner.collide(&map, &met, count);
    answer("managers/met", static_cast<double>(met), 0);
    fcl::DefaultDistanceData<double> data;
    outer.distance(&map, &data, fcl::DefaultDistanceFunction<double>);
    answer("managers/nearest", data.result.min_distance, 1e-5);
    expect(met > 3 && data.result.min_distance > 1, "some meet, the others are far");
}

#ifndef WITH_FCL
// OctoMap's file, read by the library, has the tree's cells.
void files() {
    const Tree tree = mapped(98, 500, 1.2);
    const std::string file = "octrees_" + std::to_string(getpid()) + ".bt";
    expect(tree->writeBinaryConst(file), "a file is written");
    const fcl::OcTreed of_tree(tree), of_file(cstk::Octree::load(file));
    std::remove(file.c_str());
    double volumes[2] = {};
    for (const auto &box : of_tree.toBoxes()) {
        volumes[0] += std::pow(box[3], 3);
    }
    for (const auto &box : of_file.toBoxes()) {
        volumes[1] += std::pow(box[3], 3);
    }
    expect_near(volumes[1], volumes[0], 1e-9, "the volume of a file's cells");
    models::Random random(99);
    const fcl::Sphered ball(0.1);
    for (int i = 0; i < 50; ++i) {
        const Transform tb = random_transform(random, 1.6);
        fcl::DistanceResultd here, there;
        fcl::distance<double>(&of_tree, at(0, 0, 0), &ball, tb, fcl::DistanceRequestd(), here);
        fcl::distance<double>(&of_file, at(0, 0, 0), &ball, tb, fcl::DistanceRequestd(), there);
        expect_near(there.min_distance, here.min_distance, 1e-9, "distance of a file's cells");
    }
}
#endif

} // namespace

int main() {
    boxes();
    pairs();
    thresholds();
    managers();
#ifndef WITH_FCL
    files();
#endif
    return failures() == 0 ? 0 : 1;
}
