#include "fcl_types.hpp"
#include "peer_pairs.hpp"

namespace {

template <class BV> struct Fcl {
    using Object = fcl::CollisionObject<double>;
    using Manager = fcl::DynamicAABBTreeCollisionManager<double>;
    using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;

    static Geometry mesh(const Surface &surface) { return fcl_mesh<BV>(surface); }

    static Geometry box(const std::array<double, 3> &half) {
        return std::make_shared<fcl::Box<double>>(2 * half[0], 2 * half[1], 2 * half[2]);
    }

    static Geometry cylinder(double radius, double length) {
        return std::make_shared<fcl::Cylinder<double>>(radius, length);
    }

    static void place(Object &object, const cstk::Pose &pose) {
        object.setTransform(fcl_pose(pose));
        object.computeAABB();
    }

    static bool overlap(const Object &a, const Object &b) {
        return a.getAABB().overlap(b.getAABB());
    }

    static bool collide(const Object *a, const Object *b) {
        static const fcl::CollisionRequest<double> first_contact(1, false);
        fcl::CollisionResult<double> result;
        fcl::collide(a, b, first_contact, result);
        return result.isCollision();
    }

    // Whether `meets` says so of any object of the manager near this one.
    template <class Meets> static bool visit(Manager &manager, Object *object, Meets meets) {
        struct Data {
            Object *object;
            Meets &meets;
            bool found;
        } data = {object, meets, false};
        manager.collide(object, &data, [](Object *a, Object *b, void *given) {
            Data &self = *static_cast<Data *>(given);
            self.found = self.meets(a == self.object ? b : a);
            return self.found;
        });
        return data.found;
    }
};

} // namespace

std::vector<PeerWay> fcl_ways(const PeerScene &scene, const std::string &only) {
    std::vector<PeerWay> ways;
    add_ways<Fcl<fcl::OBBRSS<double>>>(scene, "OBBRSS", ways, only);
    add_ways<Fcl<fcl::OBB<double>>>(scene, "OBB", ways, only);
    return ways;
}
