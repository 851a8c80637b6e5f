// FCL 0.7.
#include "fcl_bodies.h"
#include "scene.h"

namespace {

using peers::Layout;
using peers::Method;
using peers::Variant;
using peers::Winner;

using Transform = fcl::Transform3<double>;
using Vector = fcl::Vector3<double>;

// The size of the queue of volumes; of 8, 64 and 1024 the fastest in FCL.
const int queue_size = 8;

enum Volume { obb, rss, obbrss, kios };

template <class BV>
struct Nodes;
template <>
struct Nodes<fcl::OBB<double>> {
    using Distance = void;
    using Collision = fcl::detail::MeshCollisionTraversalNodeOBB<double>;
};
template <>
struct Nodes<fcl::RSS<double>> {
    using Distance = fcl::detail::MeshDistanceTraversalNodeRSS<double>;
    using Collision = fcl::detail::MeshCollisionTraversalNodeRSS<double>;
};
template <>
struct Nodes<fcl::OBBRSS<double>> {
    using Distance = fcl::detail::MeshDistanceTraversalNodeOBBRSS<double>;
    using Collision = fcl::detail::MeshCollisionTraversalNodeOBBRSS<double>;
};
template <>
struct Nodes<fcl::kIOS<double>> {
    using Distance = fcl::detail::MeshDistanceTraversalNodekIOS<double>;
    using Collision = fcl::detail::MeshCollisionTraversalNodekIOS<double>;
};

// A traversal which starts from a bound of the caller's and ends at any distance down to stop_at.
template <class Base>
struct BoundedNode final : Base {
    double stop_at = 0;
    void preprocess() override {}
    void postprocess() override {}
    bool canStop(double lower) const override {
        return lower >= this->result->min_distance || this->result->min_distance <= stop_at;
    }
};

template <class BV>
struct FclPeer {
    using Pose = Transform;
    using Model = fcl::BVHModel<BV>;
    using ModelPointer = std::shared_ptr<Model>;

    static bool tests(Method method, bool collide) { return collide && method != Method::queue; }

    static Pose pose(const double *numbers) { return peers::pose(numbers); }

    static ModelPointer model(const peer_mesh *meshes, std::size_t count) { return peers::model<BV>(meshes, count); }

    class Pair {
    public:
        Pair(const ModelPointer &link, const ModelPointer &body, Method method)
            : link(link.get()), body(body.get()), method(method) {}

        double distance(const Pose &pose, double bound, double stop_at, int &link_triangle, int &body_triangle) {
            using Node = typename Nodes<BV>::Distance;
            if constexpr (std::is_void_v<Node>) {
                throw std::logic_error("no distances with these volumes");
            } else {
                fcl::DistanceResult<double> result(bound);
                fcl::DistanceRequest<double> request;
                if (method == Method::plain) {
                    fcl::distance(link, pose, body, still, request, result);
                } else {
                    BoundedNode<Node> node;
                    fcl::detail::initialize(static_cast<Node &>(node), *link, pose, *body, still, request, result);
                    node.stop_at = stop_at;
                    fcl::detail::distance(static_cast<fcl::detail::DistanceTraversalNodeBase<double> *>(&node),
                                          static_cast<fcl::detail::BVHFrontList *>(nullptr),
                                          method == Method::queue ? queue_size : 2);
                }
                link_triangle = static_cast<int>(result.b1);
                body_triangle = static_cast<int>(result.b2);
                return result.min_distance;
            }
        }

        bool meets(const Pose &pose, double, int &link_triangle, int &body_triangle) {
            fcl::CollisionRequest<double> request(1, false);
            fcl::CollisionResult<double> result;
            if (method == Method::plain) {
                fcl::collide(link, pose, body, still, request, result);
            } else {
                using Node = typename Nodes<BV>::Collision;
                Node node;
                fcl::detail::initialize(node, *link, pose, *body, still, request, result);
                fcl::detail::collide(static_cast<fcl::detail::CollisionTraversalNodeBase<double> *>(&node),
                                     static_cast<fcl::detail::BVHFrontList *>(nullptr));
            }
            if (!result.isCollision()) return false;
            link_triangle = static_cast<int>(result.getContact(0).b1);
            body_triangle = static_cast<int>(result.getContact(0).b2);
            return true;
        }

        double triangle_distance(const Pose &pose, const Winner &winner) const {
            const fcl::Triangle &one = link->tri_indices[winner.link_triangle];
            const fcl::Triangle &other = body->tri_indices[winner.obstacle_triangle];
            const Vector *from = link->vertices, *to = body->vertices;
            Vector point, opposite;
            return fcl::detail::TriangleDistance<double>::triDistance(
                from[one[0]], from[one[1]], from[one[2]], to[other[0]], to[other[1]], to[other[2]],
                Transform(pose.inverse(Eigen::Isometry)), point, opposite);
        }

        bool triangles_meet(const Pose &pose, const Winner &winner) const {
            const fcl::Triangle &one = link->tri_indices[winner.link_triangle];
            const fcl::Triangle &other = body->tri_indices[winner.obstacle_triangle];
            const Vector *from = link->vertices, *to = body->vertices;
            return fcl::detail::Intersect<double>::intersect_Triangle(
                from[one[0]], from[one[1]], from[one[2]], to[other[0]], to[other[1]], to[other[2]],
                Transform(pose.inverse(Eigen::Isometry)));
        }

    private:
        const Model *link, *body;
        Method method;
        Transform still = Transform::Identity();
    };

    class Manager {
    public:
        Manager(const std::vector<ModelPointer> &links, const std::vector<ModelPointer> &bodies) {
            for (auto &link : links) moving.push_back(std::make_unique<Object>(link));
            for (std::size_t body = 0; body < bodies.size(); ++body) {
                fixed.push_back(std::make_unique<Object>(bodies[body]));
                fixed.back()->setUserData(reinterpret_cast<void *>(body + 1));
                tree.registerObject(fixed.back().get());
            }
            tree.setup();
        }

        // Visits bodies nearer than the bound, which the visit may lower, until a visit returns true.
        template <class Visit>
        void distance(std::size_t link, const Pose &pose, double &bound, Visit visit) {
            std::pair<Visit *, double *> context(&visit, &bound);
            tree.distance(place(link, pose), &context,
                          [](Object *one, Object *other, void *data, double &nearest) {
                              auto &context = *static_cast<std::pair<Visit *, double *> *>(data);
                              bool done = (*context.first)(index(one, other));
                              nearest = *context.second;
                              return done;
                          });
        }

        template <class Visit>
        void collide(std::size_t link, const Pose &pose, Visit visit) {
            tree.collide(place(link, pose), &visit, [](Object *one, Object *other, void *data) {
                return (*static_cast<Visit *>(data))(index(one, other));
            });
        }

    private:
        using Object = fcl::CollisionObject<double>;

        static std::size_t index(const Object *one, const Object *other) {
            const void *mark = one->getUserData() ? one->getUserData() : other->getUserData();
            return reinterpret_cast<std::size_t>(mark) - 1;
        }

        Object *place(std::size_t link, const Pose &pose) {
            Object *object = moving[link].get();
            object->setTransform(pose);
            object->computeAABB();
            return object;
        }

        std::vector<std::unique_ptr<Object>> moving, fixed;
        fcl::DynamicAABBTreeCollisionManager<double> tree;
    };
};

const std::vector<Variant> &variants() {
    static const std::vector<Variant> list = [] {
        std::vector<Variant> list;
        const std::pair<Volume, const char *> volumes[] = {{rss, "RSS"}, {obbrss, "OBBRSS"}, {kios, "kIOS"}};
        for (auto &[volume, name] : volumes) {
            std::string start = name;
            // FCL's own entry moves a copy of the mesh to collide it with these.
            bool collides = volume != rss;
            list.push_back({volume, Layout::merged, Method::plain, {true, true, collides}, start + " merged plain"});
            list.push_back({volume, Layout::merged, Method::seeded, {true, true, true}, start + " merged seeded"});
            list.push_back({volume, Layout::merged, Method::queue, {true, true, false}, start + " merged queue"});
            list.push_back({volume, Layout::bodies, Method::plain, {true, true, collides}, start + " bodies plain"});
            list.push_back({volume, Layout::bodies, Method::seeded, {true, true, true}, start + " bodies seeded"});
            list.push_back({volume, Layout::manager, Method::plain, {true, true, collides}, start + " manager plain"});
            list.push_back({volume, Layout::manager, Method::seeded, {true, true, true}, start + " manager seeded"});
        }
        // Volumes relative to their parents, which would be faster still, FCL 0.7 cannot make: its makeParentRelative does
        // not compile, and collide2 misses collisions without it.
        list.push_back({obb, Layout::merged, Method::plain, {false, false, true}, "OBB merged plain"});
        list.push_back({obb, Layout::merged, Method::seeded, {false, false, true}, "OBB merged seeded"});
        list.push_back({obb, Layout::bodies, Method::plain, {false, false, true}, "OBB bodies plain"});
        list.push_back({obb, Layout::bodies, Method::seeded, {false, false, true}, "OBB bodies seeded"});
        list.push_back({obb, Layout::manager, Method::plain, {false, false, true}, "OBB manager plain"});
        list.push_back({obb, Layout::manager, Method::seeded, {false, false, true}, "OBB manager seeded"});
        return list;
    }();
    return list;
}

peers::AnyScene *build(const peer_mesh *moving, std::size_t moving_count, const peer_mesh *obstacles,
                       std::size_t obstacle_count, const Variant &variant) {
    auto make = [&](auto peer) -> peers::AnyScene * {
        return new peers::Scene<decltype(peer)>(moving, moving_count, obstacles, obstacle_count, variant);
    };
    switch (variant.volume) {
        case obb: return make(FclPeer<fcl::OBB<double>>());
        case rss: return make(FclPeer<fcl::RSS<double>>());
        case obbrss: return make(FclPeer<fcl::OBBRSS<double>>());
        default: return make(FclPeer<fcl::kIOS<double>>());
    }
}

}  // namespace

PEER_INTERFACE(fcl, variants, build)
