// Coal 3. Its traversals take volumes and triangles through functions of its library, so only the nodes are built here.
#include "coal_bodies.h"

#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/internal/intersect.h>
#include <coal/internal/traversal_node_bvhs.h>
#include <coal/internal/traversal_node_setup.h>
#include <coal/internal/traversal_recurse.h>

#include "scene.h"

namespace {

using peers::Layout;
using peers::Method;
using peers::Variant;
using peers::Winner;

using Vector = coal::Vec3s;

// The size of the queue of volumes, as for FCL.
const unsigned queue_size = 8;

enum Volume { obb, rss, obbrss, kios };

// A traversal which starts from a bound of the caller's and ends at any distance down to stop_at.
template <class BV>
struct BoundedNode final : coal::MeshDistanceTraversalNode<BV, 0> {
    double stop_at = 0;
    void preprocess() override {}
    void postprocess() override {}
    bool canStop(double lower) const override {
        return lower >= this->result->min_distance || this->result->min_distance <= stop_at;
    }
};

// Coal's traversal for collisions, with its distance of triangles at the leaves instead of its GJK.
template <class BV>
struct OverlapNode final : coal::MeshCollisionTraversalNode<BV, 0> {
    using Base = coal::MeshCollisionTraversalNode<BV, 0>;
    using Base::Base;
    void leafCollides(unsigned first, unsigned second, double &squared_bound) const override {
        int one = this->model1->getBV(first).primitiveId();
        int other = this->model2->getBV(second).primitiveId();
        const coal::Triangle &from = this->tri_indices1[one], &to = this->tri_indices2[other];
        const Vector *points = this->vertices1, *others = this->vertices2;
        Vector point, opposite;
        double squared = coal::TriangleDistance::sqrTriDistance(
            points[from[0]], points[from[1]], points[from[2]], others[to[0]], others[to[1]], others[to[2]],
            this->RT._R(), this->RT._T(), point, opposite);
        double gap = std::sqrt(squared) - this->request.security_margin;
        squared_bound = gap > 0 ? gap * gap : 0;
        if (gap <= 0) this->result->addContact(coal::Contact(this->model1, this->model2, one, other));
    }
};

template <class BV>
struct CoalPeer {
    using Pose = coal::Transform3s;
    using Model = coal::BVHModel<BV>;
    using ModelPointer = std::shared_ptr<Model>;
    static constexpr bool measures = !std::is_same_v<BV, coal::OBB>;

    static bool tests(Method method, bool) { return method == Method::plain || method == Method::overlap; }

    static Pose pose(const double *numbers) { return peers::pose(numbers); }

    static ModelPointer model(const peer_mesh *meshes, std::size_t count) { return peers::model<BV>(meshes, count); }

    class Pair {
    public:
        Pair(const ModelPointer &link, const ModelPointer &body, Method method)
            : link(link.get()), body(body.get()), method(method), collider(link.get(), body.get()),
              collision_request(coal::NO_REQUEST, 1), distance_request(false, false) {
            if constexpr (measures) measurer = std::make_shared<coal::ComputeDistance>(link.get(), body.get());
            collision_request.break_distance = 0;
            collision_request.distance_upper_bound = 0;
        }

        double distance(const Pose &pose, double bound, double stop_at, int &link_triangle, int &body_triangle) {
            if constexpr (!measures) {
                throw std::logic_error("no distances with these volumes");
            } else {
                coal::DistanceResult result(bound);
                if (method == Method::plain) {
                    (*measurer)(pose, still, distance_request, result);
                } else {
                    BoundedNode<BV> node;
                    coal::initialize(static_cast<coal::MeshDistanceTraversalNode<BV, 0> &>(node), *link, pose, *body,
                                     still, distance_request, result);
                    node.stop_at = stop_at;
                    if (method == Method::queue)
                        coal::distanceQueueRecurse(&node, 0, 0, nullptr, queue_size);
                    else
                        coal::distanceRecurse(&node, 0, 0, nullptr);
                }
                link_triangle = result.b1;
                body_triangle = result.b2;
                return result.min_distance;
            }
        }

        bool meets(const Pose &pose, double threshold, int &link_triangle, int &body_triangle) {
            collision_request.security_margin = threshold;
            coal::CollisionResult result;
            if (method == Method::plain) {
                collider(pose, still, collision_request, result);
            } else {
                OverlapNode<BV> node(collision_request);
                coal::initialize(static_cast<coal::MeshCollisionTraversalNode<BV, 0> &>(node), *link, pose, *body,
                                 still, result);
                double squared_bound = 0;
                coal::collisionRecurse(&node, 0, 0, nullptr, squared_bound);
            }
            if (!result.isCollision()) return false;
            link_triangle = result.getContact(0).b1;
            body_triangle = result.getContact(0).b2;
            return true;
        }

        double triangle_distance(const Pose &pose, const Winner &winner) const {
            const coal::Triangle &one = (*link->tri_indices)[winner.link_triangle];
            const coal::Triangle &other = (*body->tri_indices)[winner.obstacle_triangle];
            const auto &from = *link->vertices, &to = *body->vertices;
            Vector point, opposite;
            return std::sqrt(coal::TriangleDistance::sqrTriDistance(to[other[0]], to[other[1]], to[other[2]],
                                                                    from[one[0]], from[one[1]], from[one[2]], pose,
                                                                    point, opposite));
        }

        bool triangles_meet(const Pose &pose, const Winner &winner) const {
            return triangle_distance(pose, winner) <= 0;
        }

    private:
        const Model *link, *body;
        Method method;
        coal::ComputeCollision collider;
        std::shared_ptr<coal::ComputeDistance> measurer;
        coal::CollisionRequest collision_request;
        coal::DistanceRequest distance_request;
        Pose still;
    };

    class Manager {
    public:
        Manager(const std::vector<ModelPointer> &links, const std::vector<ModelPointer> &bodies) {
            for (auto &link : links) moving.push_back(std::make_unique<coal::CollisionObject>(link));
            for (std::size_t body = 0; body < bodies.size(); ++body) {
                fixed.push_back(std::make_unique<coal::CollisionObject>(bodies[body]));
                fixed.back()->setUserData(reinterpret_cast<void *>(body + 1));
                tree.registerObject(fixed.back().get());
            }
            tree.setup();
        }

        // Visits bodies nearer than the bound, which the visit may lower, until a visit returns true.
        template <class Visit>
        void distance(std::size_t link, const Pose &pose, double &bound, Visit visit) {
            struct Callback final : coal::DistanceCallBackBase {
                Callback(Visit &visit, double &bound) : visit(visit), bound(bound) {}
                bool distance(coal::CollisionObject *one, coal::CollisionObject *other, double &nearest) override {
                    bool done = visit(index(one, other));
                    nearest = bound;
                    return done;
                }
                Visit &visit;
                double &bound;
            } callback(visit, bound);
            tree.distance(place(link, pose), &callback);
        }

        template <class Visit>
        void collide(std::size_t link, const Pose &pose, Visit visit) {
            struct Callback final : coal::CollisionCallBackBase {
                explicit Callback(Visit &visit) : visit(visit) {}
                bool collide(coal::CollisionObject *one, coal::CollisionObject *other) override {
                    return visit(index(one, other));
                }
                Visit &visit;
            } callback(visit);
            tree.collide(place(link, pose), &callback);
        }

    private:
        static std::size_t index(const coal::CollisionObject *one, const coal::CollisionObject *other) {
            const void *mark = one->getUserData() ? one->getUserData() : other->getUserData();
            return reinterpret_cast<std::size_t>(mark) - 1;
        }

        coal::CollisionObject *place(std::size_t link, const Pose &pose) {
            coal::CollisionObject *object = moving[link].get();
            object->setTransform(pose);
            object->computeAABB();
            return object;
        }

        std::vector<std::unique_ptr<coal::CollisionObject>> moving, fixed;
        coal::DynamicAABBTreeCollisionManager tree;
    };
};

const std::vector<Variant> &variants() {
    static const std::vector<Variant> list = [] {
        std::vector<Variant> list;
        const std::pair<Volume, const char *> volumes[] = {
            {rss, "RSS"}, {obbrss, "OBBRSS"}, {kios, "kIOS"}, {obb, "OBB"}};
        const std::pair<Layout, const char *> layouts[] = {
            {Layout::merged, " merged"}, {Layout::bodies, " bodies"}, {Layout::manager, " manager"}};
        for (auto &[volume, volume_name] : volumes)
            for (auto &[layout, layout_name] : layouts) {
                std::string start = std::string(volume_name) + layout_name;
                bool measures = volume != obb;
                // Coal's own entry is several times slower at collisions with RSS. With a margin it misses some pairs there
                // and with kIOS, whose overlap misses them.
                // With any volumes it takes gaps below its GJK's 1e-6 for collisions.
                bool collides = volume != rss, margins = volume == obb || volume == obbrss;
                list.push_back({volume, layout, Method::plain, {measures, margins, collides}, start + " plain"});
                if (measures) {
                    list.push_back({volume, layout, Method::seeded, {true, true, true}, start + " seeded"});
                    if (layout == Layout::merged)
                        list.push_back({volume, layout, Method::queue, {true, true, true}, start + " queue"});
                }
                list.push_back({volume, layout, Method::overlap, {false, volume != kios, true}, start + " overlap"});
            }
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
        case obb: return make(CoalPeer<coal::OBB>());
        case rss: return make(CoalPeer<coal::RSS>());
        case obbrss: return make(CoalPeer<coal::OBBRSS>());
        default: return make(CoalPeer<coal::kIOS>());
    }
}

}  // namespace

PEER_INTERFACE(coal, variants, build)
