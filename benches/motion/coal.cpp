#include "peer_pairs.hpp"

#include <coal/BVH/BVH_model.h>
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/collision.h>
#include <coal/shape/geometric_shapes.h>

namespace {

template <class BV> struct Coal {
    using Object = coal::CollisionObject;
    using Manager = coal::DynamicAABBTreeCollisionManager;
    using Geometry = std::shared_ptr<coal::CollisionGeometry>;

    static Geometry mesh(const Surface &surface) {
        std::vector<coal::Vec3s> vertices;
        for (std::size_t i = 0; i < surface.vertices.size(); i += 3) {
            vertices.emplace_back(surface.vertices[i], surface.vertices[i + 1],
                                  surface.vertices[i + 2]);
        }
        std::vector<coal::Triangle> triangles;
        for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
            triangles.emplace_back(surface.triangles[i], surface.triangles[i + 1],
                                   surface.triangles[i + 2]);
        }
        auto made = std::make_shared<coal::BVHModel<BV>>();
        made->beginModel(static_cast<unsigned>(triangles.size()),
                         static_cast<unsigned>(vertices.size()));
        made->addSubModel(vertices, triangles);
        made->endModel();
        return made;
    }

    static Geometry box(const std::array<double, 3> &half) {
        return std::make_shared<coal::Box>(2 * half[0], 2 * half[1], 2 * half[2]);
    }

    static Geometry cylinder(double radius, double length) {
        return std::make_shared<coal::Cylinder>(radius, length);
    }

    static void place(Object &object, const cstk::Pose &pose) {
        coal::Matrix3s rotation;
        coal::Vec3s translation;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                rotation(row, column) = pose[static_cast<std::size_t>(4 * row + column)];
            }
            translation[row] = pose[static_cast<std::size_t>(4 * row + 3)];
        }
        object.setTransform(rotation, translation);
        object.computeAABB();
    }

    static bool overlap(const Object &a, const Object &b) {
        return a.getAABB().overlap(b.getAABB());
    }

    static bool collide(const Object *a, const Object *b) {
        static const coal::CollisionRequest first_contact = [] {
            coal::CollisionRequest request;
            request.enable_contact = false;
            request.num_max_contacts = 1;
            request.break_distance = 0;
            return request;
        }();
        coal::CollisionResult result;
        coal::collide(a, b, first_contact, result);
        return result.isCollision();
    }

    // Whether `meets` says so of any object of the manager near this one.
    template <class Meets> static bool visit(Manager &manager, Object *object, Meets meets) {
        struct Callback final : coal::CollisionCallBackBase {
            Callback(Object *object, Meets &meets) : object(object), meets(meets) {}
            bool collide(Object *a, Object *b) override {
                found = meets(a == object ? b : a);
                return found;
            }
            Object *object;
            Meets &meets;
            bool found = false;
        } callback(object, meets);
        manager.collide(object, &callback);
        return callback.found;
    }
};

} // namespace

std::vector<PeerWay> coal_ways(const PeerScene &scene) {
    std::vector<PeerWay> ways;
    add_ways<Coal<coal::OBBRSS>>(scene, "OBBRSS", ways);
    add_ways<Coal<coal::OBB>>(scene, "OBB", ways);
    return ways;
}
