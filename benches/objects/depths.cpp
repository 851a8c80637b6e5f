#include "depths.hpp"

#include "fcl_placed.hpp"

#include <cstk.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace {

using models::Point;
using models::Random;

cstk::Pose random_pose(double spread, Random &random) {
    const Point axis = random.direction();
    const double half = random.uniform(0, models::pi / 2);
    const auto at = [&] { return random.uniform(-spread, spread); };
    return cstk::pose_from_quaternion({at(), at(), at(), std::sin(half) * axis[0], std::sin(half) * axis[1],
                                       std::sin(half) * axis[2], std::cos(half)});
}

std::vector<cstk::Pose> random_poses(std::size_t count, double spread, Random &random) {
    std::vector<cstk::Pose> poses;
    while (poses.size() < count) {
        poses.push_back(random_pose(spread, random));
    }
    return poses;
}

// Two bodies, the second at other poses.
struct Pair {
    cstk::Body a, b;
    std::vector<cstk::Pose> poses;
    cstk::Query query;
};

Asked depth_of(const std::shared_ptr<Pair> &pair) {
    const auto found = std::make_shared<cstk_depth_result>();
    return {"cstk", "", [pair] { pair->query = cstk::Query(); },
            [pair, found](std::size_t i) { *found = pair->query.pair_depth(pair->a, cstk::identity(), pair->b, pair->poses[i]); },
            [] { return 0.0; }, {}};
}

// FCL's deepest contact of two shapes.
Asked penetration_of(Geometry a, Geometry b, const std::vector<cstk::Pose> &poses) {
    const auto placed = std::make_shared<std::vector<Transform>>(transforms(poses));
    const auto found = std::make_shared<double>();
    return {"FCL", "libccd", [] {},
            [=](std::size_t i) {
                const fcl::CollisionRequest<double> request(8, true);
                fcl::CollisionResult<double> result;
                fcl::collide<double>(a.get(), Transform::Identity(), b.get(), (*placed)[i], request, result);
                *found = 0;
                for (std::size_t k = 0; k < result.numContacts(); ++k) {
                    *found = std::max(*found, result.getContact(k).penetration_depth);
                }
            },
            [] { return 0.0; }, {}};
}

} // namespace

Question depth_of_unions(std::size_t parts, std::size_t queries, std::uint64_t seed) {
    Random random(seed);
    Geometry boxes[2];
    const auto made = [&](Geometry &box) {
        const cstk::BodyBuilder builder;
        for (std::size_t i = 0; i < parts; ++i) {
            const auto side = [&] { return random.uniform(0.2, 0.6); };
            const double half[3] = {side(), side(), side()};
            const cstk::Pose pose = parts == 1 ? cstk::identity() : random_pose(0.6, random);
            cstk::check(cstk_body_builder_add_box(builder.get(), pose.data(), half, i));
            box = std::make_shared<fcl::Box<double>>(2 * half[0], 2 * half[1], 2 * half[2]);
        }
        return builder.build();
    };
    const cstk::Body a = made(boxes[0]), b = made(boxes[1]);
    const auto pair = std::make_shared<Pair>(Pair{a, b, random_poses(queries, 0.5, random), {}});
    Question question{parts, depth_of(pair), {}};
    if (parts == 1) {
        question.peers.push_back(penetration_of(boxes[0], boxes[1], pair->poses));
    }
    return question;
}

Question depth_of_hulls(std::size_t queries, std::uint64_t seed) {
    Random random(seed);
    Geometry hulls[2];
    std::size_t points = 0;
    const auto made = [&](Geometry &hull) {
        // The points of an ellipsoid's grid, all of which are corners.
        models::Mesh mesh = models::sphere("hull", 0.5, 7, 8, 0);
        const Point stretch = {random.uniform(0.6, 1), random.uniform(0.6, 1), random.uniform(0.6, 1)};
        std::vector<double> xyz;
        const auto corners = std::make_shared<std::vector<Vector>>();
        for (const Point &p : mesh.vertices) {
            corners->emplace_back(stretch[0] * p[0], stretch[1] * p[1], stretch[2] * p[2]);
            xyz.insert(xyz.end(), corners->back().data(), corners->back().data() + 3);
        }
        const auto faces = std::make_shared<std::vector<int>>();
        for (const models::Triangle &t : mesh.triangles) {
            faces->push_back(3);
            faces->insert(faces->end(), t.begin(), t.end());
        }
        hull = std::make_shared<fcl::Convex<double>>(corners, static_cast<int>(mesh.triangles.size()), faces);
        points = corners->size();
        return cstk::BodyBuilder().add_polyhedron(xyz).build();
    };
    const cstk::Body a = made(hulls[0]), b = made(hulls[1]);
    const auto pair = std::make_shared<Pair>(Pair{a, b, random_poses(queries, 0.3, random), {}});
    Question question{points, depth_of(pair), {}};
    question.peers.push_back(penetration_of(hulls[0], hulls[1], pair->poses));
    return question;
}

Question distance_of_sheets(double gap, bool refined, std::size_t queries, std::uint64_t seed) {
    Random random(seed);
    // Of both bodies together.
    const double tolerance = (refined ? 1e-2 : gap) / 4;
    const auto sheet = [&] {
        std::vector<double> control;
        for (int i = 0; i < 16; ++i) {
            control.insert(control.end(), {(i & 3) / 3.0 - 0.5, (i >> 2) / 3.0 - 0.5, random.uniform(-0.4, 0.4)});
        }
        return cstk::BodyBuilder().add_bezier_patch(3, 3, control, tolerance).build();
    };
    const cstk::Body a = sheet(), b = sheet();
    const auto pair = std::make_shared<Pair>(Pair{a, b, random_poses(queries, 0, random), {}});
    for (cstk::Pose &pose : pair->poses) {
        pose[11] = random.uniform(1, 2);
    }
    const auto found = std::make_shared<cstk_distance_result>();
    const auto begin = [pair, refined, gap] {
        pair->query = cstk::Query();
        if (refined) {
            pair->query.set_refinement(gap);
        }
    };
    const auto ask = [pair, found](std::size_t i) {
        *found = pair->query.pair_distance(pair->a, cstk::identity(), pair->b, pair->poses[i]);
    };
    return {a.statistics().primitive_count, {"cstk", "", begin, ask, [found] { return found->distance; }, {}}, {}};
}
