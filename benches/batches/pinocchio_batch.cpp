#include "peers.hpp"

#include "surface.hpp"

#include <pinocchio/collision/parallel/broadphase.hpp>
#include <pinocchio/collision/parallel/geometry.hpp>
#include <pinocchio/multibody.hpp>

#include <coal/BVH/BVH_model.h>
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/shape/geometric_shapes.h>

#include <chrono>
#include <memory>
#include <stdexcept>

namespace pin = pinocchio;

namespace {

pin::SE3 placement(const double *rows) {
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift;
    for (int i = 0; i < 3; ++i) {
        turn.row(i) << rows[4 * i], rows[4 * i + 1], rows[4 * i + 2];
        shift[i] = rows[4 * i + 3];
    }
    return {turn, shift};
}

pin::GeometryObject::CollisionGeometryPtr mesh(const Surface &surface) {
    std::vector<coal::Vec3s> points;
    for (std::size_t i = 0; i < surface.vertices.size(); i += 3) {
        points.emplace_back(surface.vertices[i], surface.vertices[i + 1], surface.vertices[i + 2]);
    }
    std::vector<coal::Triangle> triangles;
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
        triangles.emplace_back(surface.triangles[i], surface.triangles[i + 1], surface.triangles[i + 2]);
    }
    auto model = std::make_shared<coal::BVHModel<coal::OBBRSS>>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    model->computeLocalAABB();
    return model;
}

/// What a joint's coordinate is made of.
struct JointValue {
    std::uint32_t coordinate;
    double multiplier, offset;
};

struct PinocchioCell {
    explicit PinocchioCell(const problems::Workcell &workcell) {
        add_links(workcell.robots.front());
        const std::size_t links = geometry.ngeoms;
        for (const problems::Obstacle &obstacle : workcell.obstacles) {
            add_obstacle(obstacle);
        }
        const std::vector<std::uint32_t> &moving = workcell.moving;
        for (const std::uint32_t link : moving) {
            for (std::size_t i = links; i < geometry.ngeoms; ++i) {
                geometry.addCollisionPair(pin::CollisionPair(shapes[link], i));
            }
        }
        for (const problems::LinkPair &pair : workcell.pairs) {
            geometry.addCollisionPair(pin::CollisionPair(shapes[pair[0]], shapes[pair[1]]));
        }
    }

    void add_links(const cstk::Robot &robot) {
        std::vector<pin::JointIndex> joints;
        // Where each link is in the frame of its joint.
        std::vector<pin::SE3> places;
        for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
            const cstk_link_info info = robot.link_info(link);
            const bool is_root = info.parent < 0;
            const auto parent = static_cast<std::size_t>(info.parent);
            pin::JointIndex joint = is_root ? 0 : joints[parent];
            pin::SE3 place = is_root ? placement(info.at) : places[parent] * placement(info.at);
            const Eigen::Vector3d axis(info.axis[0], info.axis[1], info.axis[2]);
            const std::string name = "joint " + std::to_string(link);
            if (info.joint == CSTK_JOINT_REVOLUTE) {
                joint = model.addJoint(joint, pin::JointModelRevoluteUnaligned(axis), place, name);
            } else if (info.joint == CSTK_JOINT_PRISMATIC) {
                joint = model.addJoint(joint, pin::JointModelPrismaticUnaligned(axis), place, name);
            } else if (info.joint != CSTK_JOINT_FIXED) {
                throw std::runtime_error("a joint that the benchmark's robots do not have");
            }
            if (info.joint != CSTK_JOINT_FIXED) {
                place = pin::SE3::Identity();
                values.push_back({info.coordinate, info.multiplier, info.offset});
            }
            joints.push_back(joint);
            places.push_back(place);
            shapes.push_back(0);
            if (info.has_body) {
                const pin::GeometryObject shape("link " + std::to_string(link), joint, place, mesh(surface_of(robot.body(link))));
                shapes.back() = geometry.addGeometryObject(shape);
            }
        }
    }

    void add_obstacle(const problems::Obstacle &obstacle) {
        const std::array<double, 3> half = obstacle.half_extents.value();
        const auto shape = std::make_shared<coal::Box>(2 * half[0], 2 * half[1], 2 * half[2]);
        shape->computeLocalAABB();
        const std::string name = "obstacle " + std::to_string(geometry.ngeoms);
        geometry.addGeometryObject(pin::GeometryObject(name, 0, placement(obstacle.pose.data()), shape));
    }

    /// Configurations as columns.
    Eigen::MatrixXd configurations(const std::vector<double> &q, std::size_t count) const {
        const std::size_t nq = q.size() / count;
        Eigen::MatrixXd columns(static_cast<Eigen::Index>(values.size()), static_cast<Eigen::Index>(count));
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < values.size(); ++k) {
                const JointValue &value = values[k];
                columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
                    value.multiplier * q[i * nq + value.coordinate] + value.offset;
            }
        }
        return columns;
    }

    pin::Model model;
    pin::GeometryModel geometry;
    std::vector<JointValue> values;
    /// The shape of each link.
    std::vector<std::size_t> shapes;
};

using Tree = pin::BroadPhaseManagerTpl<coal::DynamicAABBTreeCollisionManager>;
using TreePool = pin::BroadPhaseManagerPoolBase<Tree, double, 0, pin::JointCollectionDefaultTpl>;

template <class Pool> PeerBatch batch(const std::shared_ptr<const PinocchioCell> &cell, const std::string &way, std::size_t threads) {
    const auto pool = std::make_shared<Pool>(cell->model, cell->geometry, threads);
    return {"Pinocchio with Coal (" + way + ") on " + std::to_string(threads), [=](const std::vector<double> &q, std::size_t count) {
                Eigen::Matrix<bool, Eigen::Dynamic, 1> meet(static_cast<Eigen::Index>(count));
                pin::computeCollisionsInParallel(threads, *pool, cell->configurations(q, count), meet, true);
                return PeerAnswers(meet.data(), meet.data() + count);
            }};
}

double seconds(const PeerBatch &peer, const std::vector<double> &q, std::size_t count) {
    const auto start = std::chrono::steady_clock::now();
    peer.ask(q, count);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

std::vector<PeerBatch> pinocchio_batches(const problems::Workcell &workcell) {
    const auto cell = std::make_shared<const PinocchioCell>(workcell);
    const std::size_t trials = 40;
    std::vector<double> q;
    std::uint64_t random = 1;
    for (std::size_t i = 0; i < trials; ++i) {
        const std::vector<double> at = workcell.space.sample(random);
        q.insert(q.end(), at.begin(), at.end());
    }
    const PeerBatch pairs = batch<pin::GeometryPool>(cell, "pairs", 1), tree = batch<TreePool>(cell, "tree", 1);
    if (seconds(pairs, q, trials) < seconds(tree, q, trials)) {
        return {pairs, batch<pin::GeometryPool>(cell, "pairs", 2)};
    }
    return {tree, batch<TreePool>(cell, "tree", 2)};
}
