// BVHModel: how it is filled and ended, copies, which triangles answers name, several contacts, costs, and the calls around them.
#include "library.hpp"

#include <set>

namespace {

// A model in each of the ways it can be filled.
void fillings() {
    Model model;
    expect(model.addVertex(Vector(0, 0, 0)) != fcl::BVH_OK, "vertices are refused before beginModel()");
#ifndef WITH_FCL
    // After which FCL 0.7 reads beyond its memory.
    expect(model.beginModel() == fcl::BVH_OK, "beginModel");
    expect(model.endModel() == fcl::BVH_ERR_BUILD_EMPTY_MODEL, "an empty model is refused");
#endif
    model.beginModel(2, 6);
    expect(model.addTriangle(Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0)) == fcl::BVH_OK, "addTriangle");
    expect(model.addSubModel({Vector(0, 0, 5), Vector(1, 0, 5), Vector(0, 1, 5)}, {fcl::Triangle(0, 1, 2)}) == fcl::BVH_OK,
           "addSubModel");
    expect(model.endModel() == fcl::BVH_OK, "endModel");
    model.computeLocalAABB();
    expect(model.num_tris == 2 && model.num_vertices == 6, "counts of triangles and vertices");
    expect(model.tri_indices[1][0] == 3 && model.vertices[3][2] == 5, "indices of a part count from its first vertex");
    expect(model.getObjectType() == fcl::OT_BVH && model.getNodeType() == fcl::BV_OBBRSS, "types");
    expect(model.getModelType() == fcl::BVH_MODEL_TRIANGLES, "kind of model");
    answer("models/aabb", model.aabb_local.max_[2] - model.aabb_local.min_[2], 1e-12);
    const Model copy(model);
    const fcl::Sphered ball(1);
    fcl::DistanceRequestd request(true);
    for (const Model *asked : {static_cast<const Model *>(&model), &copy}) {
        fcl::DistanceResultd result;
        fcl::distance<double>(asked, at(0, 0, 0), &ball, at(0.25, 0.25, 8), request, result);
        expect_near(result.min_distance, 2, 1e-5, "distance of a model from a ball above it");
        expect(result.b1 == 1 && result.b2 == fcl::DistanceResultd::NONE, "the second triangle is nearest");
        expect_near(result.nearest_points[0][2], 5, 1e-4, "point on the model");
#ifndef WITH_FCL
        // FCL 0.7 gives it in the ball's frame.
        expect_near(result.nearest_points[1][2], 7, 1e-9, "point on the ball");
#endif
    }
}

// Nearest triangles and points of two models, against the triangles named.
void nearest_triangles() {
    const auto a = model_of(models::torus(1.2, 0.4, 16, 10)), b = model_of(models::l_prism());
    models::Random random(11);
    for (int i = 0; i < 60; ++i) {
        const Transform ta = random_transform(random, 1), tb = random_transform(random, 4);
        fcl::DistanceRequestd request(true);
        fcl::DistanceResultd result;
        const double distance = fcl::distance<double>(a.get(), ta, b.get(), tb, request, result);
        if (distance <= 0) {
            continue;
        }
        const double between = (result.nearest_points[0] - result.nearest_points[1]).norm();
        expect_near(between, distance, 1e-6, "nearest points of models are as far apart as the distance");
        expect(result.b1 >= 0 && result.b1 < a->num_tris && result.b2 >= 0 && result.b2 < b->num_tris, "triangles exist");
        // The point lies in the plane of the triangle that is named.
        const fcl::Triangle &t = a->tri_indices[result.b1];
        const Vector p = ta * a->vertices[t[0]], q = ta * a->vertices[t[1]], r = ta * a->vertices[t[2]];
        const double off = (q - p).cross(r - p).normalized().dot(result.nearest_points[0] - p);
        expect_near(off, 0, 1e-6, "the nearest point is on the triangle named");
    }
}

// Which triangles meet: the sets of pairs are the same.
void meeting_triangles() {
    const auto a = model_of(models::torus(1.2, 0.4, 16, 10)), b = model_of(models::l_prism());
    models::Random random(12);
    for (int i = 0; i < 30; ++i) {
        const Transform ta = random_transform(random, 0.5), tb = random_transform(random, 1.5);
        fcl::CollisionRequestd request(100000, true);
        fcl::CollisionResultd result;
        fcl::collide<double>(a.get(), ta, b.get(), tb, request, result);
        std::set<std::pair<std::intptr_t, std::intptr_t>> pairs;
        double sum = 0;
        for (std::size_t k = 0; k < result.numContacts(); ++k) {
            pairs.insert({result.getContact(k).b1, result.getContact(k).b2});
        }
        for (const auto &pair : pairs) {
            sum += static_cast<double>(1 + pair.first) * static_cast<double>(7919 + pair.second);
        }
        const std::string label = "models/meeting/" + std::to_string(i);
        answer(label + "/count", static_cast<double>(pairs.size()), 0);
        answer(label + "/which", sum, 0);
        fcl::CollisionRequestd few(3, true);
        fcl::CollisionResultd some;
        expect(fcl::collide<double>(a.get(), ta, b.get(), tb, few, some) == std::min<std::size_t>(3, pairs.size()),
               "no more contacts than asked for");
    }
}

void costs() {
    auto model = model_of(models::box("box", 2, 2, 2));
    model->cost_density = 2;
    const fcl::Boxd box(2, 2, 2);
    fcl::CollisionRequestd request(10, true, 5, true);
    fcl::CollisionResultd result;
    fcl::collide<double>(model.get(), at(0, 0, 0), &box, at(1.5, 0, 0), request, result);
    std::vector<fcl::CostSourced> sources;
    result.getCostSources(sources);
    expect(!sources.empty() && sources.size() <= 5, "costs are as many as asked for at most");
    expect(!sources.empty() && sources[0].cost_density == 2, "densities are multiplied");
    result.clear();
    expect(!result.isCollision() && result.numCostSources() == 0, "clear()");
    fcl::collide<double>(&box, at(0, 0, 0), &box, at(1.5, 0, 0), request, result);
    result.getCostSources(sources);
    answer("models/box_costs", sources[0].total_cost, 1e-9);
    // What is free meets nothing.
    model->cost_density = 0;
    result.clear();
    fcl::collide<double>(model.get(), at(0, 0, 0), &box, at(1.5, 0, 0), fcl::CollisionRequestd(), result);
    expect(!result.isCollision(), "a free model meets nothing");
}

void boxes_of_shapes() {
    Model model;
    fcl::generateBVHModel(model, fcl::Boxd(1, 2, 3), at(0, 0, 1));
    expect(model.num_tris == 12, "a box has twelve triangles");
    answer("models/box_low", model.aabb_local.min_[2], 1e-12);
    fcl::AABBd box(Vector(0, 0, 0), Vector(1, 2, 3));
    const fcl::AABBd other(Vector(2, 0, 0), Vector(3, 1, 1));
    answer("aabb/distance", box.distance(other), 1e-12);
    answer("aabb/overlap", box.overlap(other), 0);
    box += Vector(2.5, 0.5, 0.5);
    answer("aabb/grown", box.overlap(other), 0);
    answer("aabb/volume", box.volume(), 1e-12);
    answer("aabb/size", box.size(), 1e-12);
    answer("aabb/center", box.center().sum(), 1e-12);
}

} // namespace

int main() {
    fillings();
    nearest_triangles();
    meeting_triangles();
    costs();
    boxes_of_shapes();
    return failures() == 0 ? 0 : 1;
}
