#include "peer_scene.hpp"

#include <pinocchio/collision/broadphase.hpp>
#include <pinocchio/collision/collision.hpp>
#include <pinocchio/collision/tree-broadphase-manager.hpp>

#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>

namespace pin = pinocchio;

namespace {

using Tree = coal::DynamicAABBTreeCollisionManager;

double number_of(bool meets) { return meets ? 1 : 0; }

template <class Manager> Way managed(const std::string &name, const ScenePtr &scene) {
    const auto manager =
        std::make_shared<Manager>(&scene->model, &scene->geometry, &scene->placed);
    return {name, [=](std::size_t pose) {
                scene->place(pose);
                manager->update(false);
                return number_of(pin::computeCollisions(*manager, true));
            }};
}

// The pairs in turn, but those whose boxes in the world are apart; the pair that met last comes
// first.
class Boxed {
  public:
    explicit Boxed(ScenePtr scene) : scene_(std::move(scene)) {}

    bool ask(std::size_t pose) {
        scene_->place(pose);
        place_boxes(*scene_, boxes_);
        if (last_ < scene_->geometry.collisionPairs.size() && meet(last_)) {
            return true;
        }
        for (std::size_t i = 0; i < scene_->geometry.collisionPairs.size(); ++i) {
            if (i != last_ && meet(i)) {
                last_ = i;
                return true;
            }
        }
        return false;
    }

  private:
    bool meet(std::size_t number) {
        const pin::CollisionPair &pair = scene_->geometry.collisionPairs[number];
        return PlacedBox::gap(boxes_[pair.first], boxes_[pair.second]) <= 0 &&
               pin::computeCollision(scene_->geometry, scene_->placed, number);
    }

    ScenePtr scene_;
    std::vector<PlacedBox> boxes_;
    std::size_t last_ = static_cast<std::size_t>(-1);
};

} // namespace

void add_collide_ways(const std::string &volumes, const MakeScene &make, std::vector<Way> &ways) {
    for (const Guess guess : {Guess::fresh, Guess::cached}) {
        const std::string name = volumes + (guess == Guess::cached ? ", cached guess" : "");
        const ScenePtr scene = make(guess);
        ways.push_back({"computeCollisions, " + name, [scene](std::size_t pose) {
                            scene->place(pose);
                            return number_of(
                                pin::computeCollisions(scene->geometry, scene->placed, true));
                        }});
        const auto boxed = std::make_shared<Boxed>(make(guess));
        ways.push_back({"boxes and last pair first, " + name,
                        [boxed](std::size_t pose) { return number_of(boxed->ask(pose)); }});
    }
    ways.push_back(managed<pin::BroadPhaseManagerTpl<Tree>>("BroadPhaseManager, " + volumes,
                                                            make(Guess::fresh)));
    ways.push_back(managed<pin::TreeBroadPhaseManagerTpl<Tree>>(
        "TreeBroadPhaseManager, " + volumes, make(Guess::fresh)));
}
