// Links against obstacles and each other, by a library whose types and calls a structure names.
#pragma once

#include "peer.hpp"

#include <memory>
#include <utility>
#include <vector>

enum class BroadPhase {
    /// The pairs in turn, but for those whose boxes in the world are apart.
    pairs,
    /// The library's tree over the obstacles' boxes; pairs of links in turn.
    tree,
};

/// The pair that met last comes first. `Library` has Object, Manager, Geometry, mesh(), box(), cylinder(), place(), overlap(),
/// collide() and visit().
template <class Library> class PeerPairs final : public Peer {
  public:
    PeerPairs(const PeerScene &scene, BroadPhase broad_phase, bool box_shapes)
        : broad_phase_(broad_phase), links_(scene.links.size()) {
        for (std::size_t i = 0; i < scene.links.size(); ++i) {
            if (!scene.links[i].triangles.empty()) {
                links_[i] = std::make_unique<Object>(Library::mesh(scene.links[i]));
            }
        }
        for (const PeerScene::Obstacle &obstacle : scene.obstacles) {
            obstacles_.push_back(std::make_unique<Object>(geometry(obstacle, box_shapes)));
            Library::place(*obstacles_.back(), obstacle.pose);
            manager_.registerObject(obstacles_.back().get());
        }
        manager_.setup();
        for (const std::uint32_t link : scene.moving) {
            moving_.push_back(links_[link].get());
            for (const auto &obstacle : obstacles_) {
                if (broad_phase == BroadPhase::pairs) {
                    pairs_.emplace_back(links_[link].get(), obstacle.get());
                }
            }
        }
        for (const auto &[a, b] : scene.pairs) {
            pairs_.emplace_back(links_[a].get(), links_[b].get());
        }
    }

    bool meets(const std::vector<cstk::Pose> &poses) override {
        for (std::size_t i = 0; i < links_.size(); ++i) {
            if (links_[i]) {
                Library::place(*links_[i], poses[i]);
            }
        }
        if (last_.first && meet(last_.first, last_.second)) {
            return true;
        }
        if (broad_phase_ == BroadPhase::tree) {
            for (Object *link : moving_) {
                const auto meets = [&](Object *obstacle) { return meet(link, obstacle); };
                if (Library::visit(manager_, link, meets)) {
                    return true;
                }
            }
        }
        for (const auto &[a, b] : pairs_) {
            if (meet(a, b)) {
                return true;
            }
        }
        return false;
    }

  private:
    using Object = typename Library::Object;

    static typename Library::Geometry geometry(const PeerScene::Obstacle &obstacle, bool box_shapes) {
        if (obstacle.cylinder) {
            return Library::cylinder(obstacle.cylinder->radius, 2 * obstacle.cylinder->half_length);
        }
        return box_shapes && obstacle.half_extents ? Library::box(*obstacle.half_extents)
                                                   : Library::mesh(obstacle.surface);
    }

    bool meet(Object *a, Object *b) {
        const bool found = Library::overlap(*a, *b) && Library::collide(a, b);
        if (found) {
            last_ = {a, b};
        }
        return found;
    }

    BroadPhase broad_phase_;
    std::vector<std::unique_ptr<Object>> links_, obstacles_;
    typename Library::Manager manager_;
    std::vector<Object *> moving_;
    std::vector<std::pair<Object *, Object *>> pairs_;
    std::pair<Object *, Object *> last_ = {};
};

/// All ways with one kind of bounding volume, or the one of a name.
template <class Library>
void add_ways(const PeerScene &scene, const std::string &volumes, std::vector<PeerWay> &ways,
              const std::string &only = {}) {
    bool has_boxes = false;
    for (const PeerScene::Obstacle &obstacle : scene.obstacles) {
        has_boxes |= obstacle.half_extents.has_value();
    }
    for (const BroadPhase broad_phase : {BroadPhase::pairs, BroadPhase::tree}) {
        for (const bool box_shapes : {false, true}) {
            if (box_shapes && !has_boxes) {
                continue;
            }
            const std::string name = volumes +
                                     (broad_phase == BroadPhase::tree ? ", tree" : ", pairs") +
                                     (box_shapes ? ", box shapes" : "");
            if (only.empty() || name == only) {
                ways.push_back(
                    {name, std::make_unique<PeerPairs<Library>>(scene, broad_phase, box_shapes)});
            }
        }
    }
}
