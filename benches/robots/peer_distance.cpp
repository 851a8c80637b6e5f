#include "peer_scene.hpp"

#include <pinocchio/collision/broadphase.hpp>
#include <pinocchio/collision/distance.hpp>

#include <coal/BVH/BVH_model.h>
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/shape/geometric_shapes.h>
#include <coal/shape/geometric_shapes_utility.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace pin = pinocchio;

namespace {

const std::size_t none = static_cast<std::size_t>(-1);

// A shape's bounding volume in its own frame; none of shapes that are measured as fast as their volumes.
std::optional<coal::RSS> volume_around(const coal::CollisionGeometry &shape) {
    if (const auto *mesh = dynamic_cast<const coal::BVHModel<coal::OBBRSS> *>(&shape)) {
        return mesh->getBV(0).bv.rss;
    }
    if (const auto *mesh = dynamic_cast<const coal::BVHModel<coal::RSS> *>(&shape)) {
        return mesh->getBV(0).bv;
    }
    if (const auto *box = dynamic_cast<const coal::Box *>(&shape)) {
        coal::RSS volume;
        coal::computeBV(*box, coal::Transform3s(), volume);
        return volume;
    }
    return std::nullopt;
}

// Passes the least distance so far to Coal, which then leaves out what is farther.
class Bounded {
  public:
    explicit Bounded(ScenePtr scene) : scene_(std::move(scene)) {
        for (const auto &object : scene_->geometry.geometryObjects) {
            volumes_.push_back(volume_around(*object.geometry));
        }
    }

    void start() { result_.clear(); }
    double best() const { return std::max(result_.min_distance, 0.0); }
    bool meets() const { return result_.min_distance <= 0; }

    // Of a pair with a mesh whose volumes are farther nothing else is looked at.
    void look(std::size_t number) {
        const pin::CollisionPair &pair = scene_->geometry.collisionPairs[number];
        const pin::SE3 &a = scene_->placed.oMg[pair.first], &b = scene_->placed.oMg[pair.second];
        const auto &volume_a = volumes_[pair.first], &volume_b = volumes_[pair.second];
        if (volume_a && volume_b && (is_mesh(pair.first) || is_mesh(pair.second))) {
            const pin::SE3 between = a.actInv(b);
            if (coal::distance(between.rotation(), between.translation(), *volume_a, *volume_b) >=
                best()) {
                return;
            }
        }
        // Of two shapes Coal overwrites what the result holds, be it nearer or not.
        const bool keeps_bound = is_mesh(pair.first) || is_mesh(pair.second);
        coal::DistanceResult &result = keeps_bound ? result_ : of_shapes_;
        of_shapes_.clear();
        const double before = result_.min_distance;
        scene_->placed.distance_functors[number](pin::toCoalTransform3s(a),
                                                 pin::toCoalTransform3s(b),
                                                 scene_->placed.distanceRequests[number], result);
        if (result.min_distance < before) {
            result_.min_distance = result.min_distance;
            last = number;
        }
    }

    // The pair that was nearest last.
    std::size_t last = none;

  private:
    bool is_mesh(std::size_t shape) const {
        return scene_->geometry.geometryObjects[shape].geometry->getObjectType() == coal::OT_BVH;
    }

    ScenePtr scene_;
    std::vector<std::optional<coal::RSS>> volumes_;
    coal::DistanceResult result_, of_shapes_;
};

enum class Order { as_given, nearest_first };

// Looks at the pairs in turn, the one that was nearest last first, but for those whose boxes in the
// world are farther.
class Sorted {
  public:
    Sorted(const ScenePtr &scene, Order order) : scene_(scene), order_(order), bounded_(scene) {}

    double ask(std::size_t pose) {
        scene_->place(pose);
        place_boxes(*scene_, boxes_);
        const auto &pairs = scene_->geometry.collisionPairs;
        gaps_.clear();
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            gaps_.emplace_back(PlacedBox::gap(boxes_[pairs[i].first], boxes_[pairs[i].second]), i);
        }
        if (order_ == Order::nearest_first) {
            std::sort(gaps_.begin(), gaps_.end());
        }
        bounded_.start();
        const std::size_t first = bounded_.last;
        if (first != none) {
            bounded_.look(first);
        }
        for (const auto &[gap, number] : gaps_) {
            if (bounded_.meets()) {
                break;
            }
            if (number != first && gap < bounded_.best()) {
                bounded_.look(number);
            }
        }
        return bounded_.best();
    }

  private:
    ScenePtr scene_;
    Order order_;
    Bounded bounded_;
    std::vector<PlacedBox> boxes_;
    std::vector<std::pair<double, std::size_t>> gaps_;
};

// Coal's tree over the shapes' boxes finds the pairs.
class Managed : private coal::DistanceCallBackBase {
  public:
    explicit Managed(const ScenePtr &scene)
        : scene_(scene), manager_(&scene->model, &scene->geometry, &scene->placed),
          bounded_(scene) {}

    double ask(std::size_t pose) {
        scene_->place(pose);
        manager_.update(false);
        bounded_.start();
        if (bounded_.last != none) {
            bounded_.look(bounded_.last);
        }
        if (!bounded_.meets()) {
            manager_.getManager().distance(this);
        }
        return bounded_.best();
    }

  private:
    bool distance(coal::CollisionObject *a, coal::CollisionObject *b, double &least) override {
        const int pair = scene_->geometry.collisionPairMapping(number_of(a), number_of(b));
        if (pair >= 0) {
            bounded_.look(static_cast<std::size_t>(pair));
        }
        least = std::min(least, bounded_.best());
        return bounded_.meets();
    }

    static Eigen::Index number_of(const coal::CollisionObject *object) {
        const auto *shape = static_cast<const pin::CollisionObject *>(object);
        return static_cast<Eigen::Index>(shape->geometryObjectIndex);
    }

    ScenePtr scene_;
    pin::BroadPhaseManagerTpl<coal::DynamicAABBTreeCollisionManager> manager_;
    Bounded bounded_;
};

template <class Asked> Way way(const std::string &name, std::shared_ptr<Asked> asked) {
    return {name, [asked](std::size_t pose) { return asked->ask(pose); }};
}

} // namespace

void add_distance_ways(const std::string &volumes, const MakeScene &make, std::vector<Way> &ways) {
    for (const Guess guess : {Guess::fresh, Guess::cached}) {
        const std::string name = volumes + (guess == Guess::cached ? ", cached guess" : "");
        const ScenePtr scene = make(guess);
        ways.push_back({"computeDistances, " + name, [scene](std::size_t pose) {
                            scene->place(pose);
                            const std::size_t least =
                                pin::computeDistances(scene->geometry, scene->placed);
                            return std::max(scene->placed.distanceResults[least].min_distance, 0.0);
                        }});
        ways.push_back(way("bounded, " + name,
                           std::make_shared<Sorted>(make(guess), Order::as_given)));
        ways.push_back(way("bounded, nearest first, " + name,
                           std::make_shared<Sorted>(make(guess), Order::nearest_first)));
        ways.push_back(way("bounded, tree of boxes, " + name,
                           std::make_shared<Managed>(make(guess))));
    }
}
