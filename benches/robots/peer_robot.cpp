#include "peer.hpp"
#include "peer_scene.hpp"

#include <pinocchio/collision/collision.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <coal/BVH/BVH_model.h>
#include <coal/mesh_loader/loader.h>
#include <coal/shape/geometric_shapes.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pin = pinocchio;

namespace {

using Configurations = std::vector<Eigen::VectorXd>;

struct Volumes {
    const char *name;
    coal::NODE_TYPE kind;
};

const Volumes volumes[] = {
    {"OBBRSS", coal::BV_OBBRSS}, {"RSS", coal::BV_RSS}, {"OBB", coal::BV_OBB}};

template <class Volume> pin::GeometryObject::CollisionGeometryPtr mesh(const Surface &surface) {
    std::vector<coal::Vec3s> points;
    for (std::size_t i = 0; i < surface.vertices.size(); i += 3) {
        points.emplace_back(surface.vertices[i], surface.vertices[i + 1], surface.vertices[i + 2]);
    }
    std::vector<coal::Triangle> triangles;
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
        const auto &at = surface.triangles;
        triangles.emplace_back(at[i], at[i + 1], at[i + 2]);
    }
    auto model = std::make_shared<coal::BVHModel<Volume>>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    model->computeLocalAABB();
    return model;
}

pin::GeometryObject::CollisionGeometryPtr mesh(const Surface &surface, coal::NODE_TYPE kind) {
    switch (kind) {
    case coal::BV_RSS:
        return mesh<coal::RSS>(surface);
    case coal::BV_OBB:
        return mesh<coal::OBB>(surface);
    default:
        return mesh<coal::OBBRSS>(surface);
    }
}

Configurations configurations(const pin::Model &model, const Poses &poses) {
    Configurations made;
    for (const std::vector<double> &values : poses.values) {
        Eigen::VectorXd q = pin::neutral(model);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const pin::JointIndex joint = model.getJointId(poses.joints[i]);
            const Eigen::Index first = model.idx_qs[joint];
            // A joint without limits is a point of the circle.
            if (model.nqs[joint] == 2) {
                q[first] = std::cos(values[i]);
                q[first + 1] = std::sin(values[i]);
            } else {
                q[first] = values[i];
            }
        }
        made.push_back(q);
    }
    return made;
}

} // namespace

struct Peer::Robots {
    const std::string &link(const pin::GeometryObject &shape) const {
        return model.frames[shape.parentFrame].name;
    }
    pin::GeometryModel scene(coal::NODE_TYPE kind, const Tested &tested) const;
    void add_pairs(pin::GeometryModel &geometry, const std::vector<LinkPair> &pairs) const;

    pin::Model model;
    /// Shapes of links only.
    std::map<coal::NODE_TYPE, pin::GeometryModel> shapes;
};

void Peer::Robots::add_pairs(pin::GeometryModel &geometry,
                             const std::vector<LinkPair> &pairs) const {
    const std::set<LinkPair> wanted(pairs.begin(), pairs.end());
    const auto &objects = geometry.geometryObjects;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        for (std::size_t k = i + 1; k < objects.size(); ++k) {
            const std::string &a = link(objects[i]), &b = link(objects[k]);
            if (wanted.count({a, b}) || wanted.count({b, a})) {
                geometry.addCollisionPair(pin::CollisionPair(i, k));
            }
        }
    }
}

pin::GeometryModel Peer::Robots::scene(coal::NODE_TYPE kind, const Tested &tested) const {
    pin::GeometryModel geometry = shapes.at(kind);
    add_pairs(geometry, tested.pairs);
    const std::size_t of_links = geometry.ngeoms;
    const auto add = [&](const pin::GeometryObject::CollisionGeometryPtr &shape,
                         const pin::SE3 &at) {
        const std::string name = "obstacle " + std::to_string(geometry.ngeoms);
        const std::size_t number =
            geometry.addGeometryObject(pin::GeometryObject(name, 0, 0, at, shape));
        for (std::size_t i = 0; i < of_links; ++i) {
            if (geometry.geometryObjects[i].parentJoint != 0) {
                geometry.addCollisionPair(pin::CollisionPair(i, number));
            }
        }
    };
    for (const Box &box : tested.obstacles.boxes) {
        const auto &c = box.center, &h = box.half_extents;
        auto shape = std::make_shared<coal::Box>(2 * h[0], 2 * h[1], 2 * h[2]);
        shape->computeLocalAABB();
        add(shape, pin::SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(c[0], c[1], c[2])));
    }
    for (const Surface &surface : tested.obstacles.surfaces) {
        add(mesh(surface, kind), pin::SE3::Identity());
    }
    return geometry;
}

Peer::Peer(const std::string &folder, const std::string &urdf) : robots_(new Robots) {
    const std::string packages = folder + "/cmeel.prefix/share";
    const std::string file = packages + "/example-robot-data/robots/" + urdf;
    pin::urdf::buildModel(file, robots_->model);
    for (const Volumes &used : volumes) {
        pin::GeometryModel &shapes = robots_->shapes[used.kind];
        pin::urdf::buildGeom(robots_->model, file, pin::COLLISION, shapes,
                             std::vector<std::string>{packages},
                             std::make_shared<coal::MeshLoader>(used.kind));
        for (auto &object : shapes.geometryObjects) {
            object.geometry->computeLocalAABB();
        }
    }
}

Peer::~Peer() = default;

std::vector<std::string> Peer::moving_links() const {
    std::set<std::string> found;
    for (const auto &shape : robots_->shapes.at(coal::BV_OBBRSS).geometryObjects) {
        if (shape.parentJoint != 0) {
            found.insert(robots_->link(shape));
        }
    }
    return {found.begin(), found.end()};
}

std::vector<LinkPair> Peer::link_pairs(const Poses &poses) const {
    const pin::Model &model = robots_->model;
    pin::GeometryModel geometry = robots_->shapes.at(coal::BV_OBBRSS);
    const auto &objects = geometry.geometryObjects;
    std::vector<LinkPair> apart;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        for (std::size_t k = i + 1; k < objects.size(); ++k) {
            const pin::JointIndex a = objects[i].parentJoint, b = objects[k].parentJoint;
            if (a != b && model.parents[a] != b && model.parents[b] != a) {
                apart.emplace_back(robots_->link(objects[i]), robots_->link(objects[k]));
            }
        }
    }
    robots_->add_pairs(geometry, apart);
    PeerScene scene(model, geometry);
    scene.poses = std::make_shared<const Configurations>(configurations(model, poses));
    scene.set(Guess::fresh);
    std::map<LinkPair, std::size_t> meetings;
    for (std::size_t i = 0; i < scene.poses->size(); ++i) {
        scene.place(i);
        std::set<LinkPair> meet;
        for (std::size_t k = 0; k < scene.geometry.collisionPairs.size(); ++k) {
            const pin::CollisionPair &pair = scene.geometry.collisionPairs[k];
            const LinkPair links(robots_->link(objects[pair.first]),
                                 robots_->link(objects[pair.second]));
            meetings[links];
            if (pin::computeCollision(scene.geometry, scene.placed, k)) {
                meet.insert(links);
            }
        }
        for (const LinkPair &links : meet) {
            ++meetings[links];
        }
    }
    std::vector<LinkPair> kept;
    for (const auto &[links, count] : meetings) {
        if (static_cast<double>(count) < 0.95 * static_cast<double>(scene.poses->size())) {
            kept.push_back(links);
        }
    }
    return kept;
}

std::vector<Way> Peer::ways(const Tested &tested, Query query, const Poses &poses) const {
    const auto at = std::make_shared<const Configurations>(configurations(robots_->model, poses));
    std::vector<Way> ways;
    for (const Volumes &used : volumes) {
        // Coal measures no distances with OBB.
        if (query == Query::distance && used.kind == coal::BV_OBB) {
            continue;
        }
        const pin::GeometryModel geometry = robots_->scene(used.kind, tested);
        const MakeScene make = [&](Guess guess) {
            auto scene = std::make_shared<PeerScene>(robots_->model, geometry);
            scene->poses = at;
            scene->set(guess);
            return scene;
        };
        (query == Query::collide ? add_collide_ways : add_distance_ways)(used.name, make, ways);
    }
    return ways;
}

Way Peer::kinematics(const Poses &poses) const {
    const auto scene = std::make_shared<PeerScene>(robots_->model, robots_->scene(coal::BV_OBB, {}));
    scene->poses = std::make_shared<const Configurations>(configurations(robots_->model, poses));
    return {"link poses", [scene](std::size_t i) {
                scene->place(i);
                return 0.0;
            }};
}

PeerScene::PeerScene(const pin::Model &model, const pin::GeometryModel &geometry)
    : model(model), data(model), geometry(geometry), placed(this->geometry) {}

void PeerScene::set(Guess guess) {
    const bool is_cached = guess == Guess::cached;
    const auto kind =
        is_cached ? coal::GJKInitialGuess::CachedGuess : coal::GJKInitialGuess::DefaultGuess;
    for (coal::CollisionRequest &request : placed.collisionRequests) {
        request.enable_contact = false;
        request.num_max_contacts = 1;
        request.break_distance = 0;
        request.gjk_initial_guess = kind;
        request.enable_cached_gjk_guess = is_cached;
    }
    for (coal::DistanceRequest &request : placed.distanceRequests) {
        request.enable_signed_distance = false;
        request.gjk_initial_guess = kind;
        request.enable_cached_gjk_guess = is_cached;
    }
}

void place_boxes(const PeerScene &scene, std::vector<PlacedBox> &boxes) {
    boxes.clear();
    for (std::size_t i = 0; i < scene.geometry.ngeoms; ++i) {
        boxes.emplace_back(scene.placed.oMg[i],
                           scene.geometry.geometryObjects[i].geometry->aabb_local);
    }
}
