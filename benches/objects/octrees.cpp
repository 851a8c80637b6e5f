#include "octrees.hpp"

#include "bodies.hpp"
#include "fcl_placed.hpp"

#include <cstk.hpp>

#include <fcl/geometry/octree/octree.h>
#include <octomap/octomap.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using models::Point;
using models::Random;

const double cell = 0.05;
const double body_radius = 0.2;

// What both libraries are told.
struct Map {
    Map(std::size_t count, std::size_t queries, std::uint64_t seed) {
        Random random(seed);
        const double radius = cell * std::sqrt(static_cast<double>(count) / (4 * models::pi));
        // More points than cells, so that the surface is closed.
        for (std::size_t i = 0; i < 8 * count; ++i) {
            const Point d = random.direction();
            points.insert(points.end(), {radius * d[0], radius * d[1], radius * d[2]});
        }
        for (std::size_t query = 0; query < queries; ++query) {
            const Point d = random.direction();
            const double at = radius + random.uniform(-2 * body_radius, 2 * body_radius);
            cstk::Pose pose = cstk::identity();
            pose[3] = at * d[0], pose[7] = at * d[1], pose[11] = at * d[2];
            poses.push_back(pose);
            // The same cells twice: occupied, then empty, so that a pass ends as it began.
            if (query % 2 == 0) {
                std::vector<double> patch;
                // Beyond the other cells.
                const double out = radius + 8 * cell;
                for (int i = 0; i < 64; ++i) {
                    const int x = i & 3, y = i >> 2 & 3, z = i >> 4;
                    patch.insert(patch.end(), {out * d[0] + cell * x, out * d[1] + cell * y, out * d[2] + cell * z});
                }
                patches.push_back(patch);
            }
        }
        shape = small_bodies(2, body_radius, random);
    }

    const Shape &body() const { return shape.back(); }

    std::vector<double> points;
    std::vector<cstk::Pose> poses;
    std::vector<std::vector<double>> patches;
    std::vector<Shape> shape;
};

} // namespace

struct OctreeScene::Ours {
    Ours(std::size_t cells, std::size_t queries, std::uint64_t seed) : map(cells, queries, seed), octree(cell) {
        octree.set(map.points);
        octree.place(first);
        id = second.add(map.body().body, map.poses[0]);
    }

    void change(std::size_t query) { octree.set(map.patches[query / 2], query % 2 == 0); }
    void move(std::size_t query) { second.move(id, map.poses[query]); }
    bool meets() { return query.environment_within(first, &second, 0); }

    Map map;
    cstk::Octree octree;
    cstk::Environment first, second;
    std::uint64_t id = 0;
    cstk::Query query;
};

struct OctreeScene::Fcl {
    explicit Fcl(const Map &given)
        : map(given), tree(std::make_shared<octomap::OcTree>(cell)), octree(std::make_shared<fcl::OcTree<double>>(tree)),
          body(model_of<fcl::OBBRSS<double>>(given.body().mesh)), poses(transforms(given.poses)) {
        set(map.points, true);
    }

    void set(const std::vector<double> &points, bool occupied) {
        const float value = occupied ? tree->getClampingThresMaxLog() : tree->getClampingThresMinLog();
        for (std::size_t i = 0; i < points.size(); i += 3) {
            tree->setNodeValue(points[i], points[i + 1], points[i + 2], value);
        }
    }

    void change(std::size_t query) { set(map.patches[query / 2], query % 2 == 0); }

    bool meets(std::size_t query) {
        fcl::CollisionResult<double> result;
        return fcl::collide<double>(body.get(), poses[query], octree.get(), Transform::Identity(), any_contact, result) > 0;
    }

    double nearest(std::size_t query) {
        fcl::DistanceResult<double> result;
        fcl::distance<double>(body.get(), poses[query], octree.get(), Transform::Identity(), distance_alone, result);
        return std::max(result.min_distance, 0.0);
    }

    const Map &map;
    std::shared_ptr<octomap::OcTree> tree;
    std::shared_ptr<fcl::OcTree<double>> octree;
    Geometry body;
    std::vector<Transform> poses;
    const fcl::CollisionRequest<double> any_contact{1, false};
    const fcl::DistanceRequest<double> distance_alone{false};
};

OctreeScene::OctreeScene(std::size_t cells, std::size_t queries, std::uint64_t seed)
    : ours_(std::make_unique<Ours>(cells, queries, seed)), fcl_(std::make_unique<Fcl>(ours_->map)) {
    cells_ = ours_->octree.cell_count();
}
OctreeScene::~OctreeScene() = default;

Question OctreeScene::change(bool with_question) {
    Ours &ours = *ours_;
    Fcl &fcl = *fcl_;
    const auto found = std::make_shared<std::array<bool, 2>>();
    Question question{cells_, {}, {}};
    question.ours = {"cstk", "", [&ours] { ours.query = cstk::Query(); }, {}, [found] { return double((*found)[0]); }, {}};
    Asked peer{"FCL", "OBBRSS", [] {}, {}, [found] { return double((*found)[1]); }, {}};
    if (with_question) {
        question.ours.prepare = [&ours](std::size_t query) { ours.move(query); };
        question.ours.ask = [&ours, found](std::size_t query) {
            ours.change(query);
            (*found)[0] = ours.meets();
        };
        peer.ask = [&fcl, found](std::size_t query) {
            fcl.change(query);
            (*found)[1] = fcl.meets(query);
        };
    } else {
        question.ours.ask = [&ours](std::size_t query) { ours.change(query); };
        peer.ask = [&fcl](std::size_t query) { fcl.change(query); };
    }
    question.peers.push_back(std::move(peer));
    return question;
}

Question OctreeScene::meets() {
    Ours &ours = *ours_;
    Fcl &fcl = *fcl_;
    const auto found = std::make_shared<std::array<bool, 2>>();
    Question question{cells_, {}, {}};
    question.ours = {"cstk", "", [&ours] { ours.query = cstk::Query(); }, [&ours, found](std::size_t) { (*found)[0] = ours.meets(); },
                     [found] { return double((*found)[0]); }, [&ours](std::size_t query) { ours.move(query); }};
    question.peers.push_back({"FCL", "OBBRSS", [] {}, [&fcl, found](std::size_t query) { (*found)[1] = fcl.meets(query); },
                              [found] { return double((*found)[1]); }, {}});
    return question;
}

Question OctreeScene::nearest() {
    Ours &ours = *ours_;
    Fcl &fcl = *fcl_;
    const auto found = std::make_shared<std::array<double, 2>>();
    Question question{cells_, {}, {}};
    question.ours = {"cstk", "", [&ours] { ours.query = cstk::Query(); },
                     [&ours, found](std::size_t) { (*found)[0] = ours.query.environment_distance(ours.first, &ours.second).distance; },
                     [found] { return (*found)[0]; }, [&ours](std::size_t query) { ours.move(query); }};
    question.peers.push_back({"FCL", "OBBRSS", [] {}, [&fcl, found](std::size_t query) { (*found)[1] = fcl.nearest(query); },
                              [found] { return (*found)[1]; }, {}});
    return question;
}
