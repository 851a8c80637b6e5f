// The links of an arm and the objects of a scene in FCL's managers, with one kind of volumes.
#pragma once

#include "asked.hpp"
#include "fcl_near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <unordered_set>
#include <vector>

namespace fcl {
template class DynamicAABBTreeCollisionManager<double>;
}

// How links are asked against objects.
struct Way {
    // The links in a manager of their own, not one by one.
    bool together;
    // The pair that decided the last query first.
    bool last_first;
};

// How a manager is told that objects were moved.
enum class Update { listed, all };

template <class BV> class Managed {
  public:
    // Boxes are meshes, or FCL's own shape.
    Managed(const Arm &arm, const Scene &scene, bool box_shapes) {
        for (const Shape &link : arm.links) {
            links_.push_back(
                std::make_unique<Placed>(model_of<BV>(link.mesh), link.mesh, links_.size()));
        }
        std::vector<Geometry> shapes;
        for (const Shape &shape : scene.shapes) {
            const bool as_shape = box_shapes && shape.mesh.name == box_name;
            shapes.push_back(as_shape ? box_of(shape.mesh) : model_of<BV>(shape.mesh));
        }
        for (const Item &item : scene.items) {
            const models::Mesh &mesh = scene.shapes[item.shape].mesh;
            objects_.push_back(std::make_unique<Placed>(shapes[item.shape], mesh, objects_.size()));
            objects_.back()->place(transform(item.pose));
        }
        object_manager_.registerObjects(pointers(objects_));
        object_manager_.setup();
        link_manager_.registerObjects(pointers(links_));
        link_manager_.setup();
    }

    // Forgets the pair that decided the last query.
    void forget() { last_link_ = last_object_ = nullptr; }

    bool meets(const std::vector<Transform> &at, Way way) {
        found_ = false;
        if (way.last_first && last_link_) {
            last_link_->place(at[last_link_->number]);
            if (collide(last_object_, last_link_, this)) {
                return true;
            }
        }
        if (way.together) {
            place_all(at, 0);
            object_manager_.collide(&link_manager_, this, collide);
        }
        for (std::size_t i = 0; !way.together && !found_ && i < links_.size(); ++i) {
            links_[i]->place(at[i]);
            object_manager_.collide(links_[i].get(), this, collide);
        }
        return found_;
    }

    double distance(const std::vector<Transform> &at, Way way) {
        nearest_ = std::numeric_limits<double>::max();
        double bound = nearest_;
        if (way.last_first && last_link_) {
            last_link_->place(at[last_link_->number]);
            if (measure(last_object_, last_link_, this, bound)) {
                return 0;
            }
        }
        if (way.together) {
            place_all(at, 0);
            object_manager_.distance(&link_manager_, this, measure);
        }
        for (std::size_t i = 0; !way.together && nearest_ > 0 && i < links_.size(); ++i) {
            links_[i]->place(at[i]);
            object_manager_.distance(links_[i].get(), this, measure);
        }
        return std::max(nearest_, 0.0);
    }

    // All pairs of triangles within epsilon, with points.
    void list_pairs(const std::vector<Transform> &at, double epsilon, bool together) {
        epsilon_ = epsilon;
        pairs_.clear();
        ends_.clear();
        for_near_boxes(at, together, add_pairs);
    }

    // Their faces.
    std::uint64_t listed_pairs() const {
        std::unordered_set<std::uint64_t> marks;
        std::size_t pair = 0;
        for (const End &end : ends_) {
            for (; pair < end.pairs; ++pair) {
                const std::size_t first =
                    end.object->mesh.face_of[static_cast<std::size_t>(pairs_[pair].first)];
                const std::size_t second =
                    end.link->mesh.face_of[static_cast<std::size_t>(pairs_[pair].second)];
                marks.insert(mark(end.link->number, end.object->number, second, first));
            }
        }
        std::uint64_t sum = 0;
        for (const std::uint64_t one : marks) {
            sum += one;
        }
        return sum;
    }

    // The sum of marks of link and object within epsilon. Each pair whose boxes are is asked for
    // its contacts and, if it has none, for its distance; or the other way round.
    std::uint64_t list_nearest(const std::vector<Transform> &at, double epsilon, bool together,
                               bool contacts_first) {
        epsilon_ = epsilon;
        contacts_first_ = contacts_first;
        marks_ = 0;
        points_.clear();
        for_near_boxes(at, together, add_nearest);
        return marks_;
    }

    void move(const std::vector<std::size_t> &moved, const std::vector<Transform> &to,
              Update update) {
        changed_.clear();
        for (std::size_t i = 0; i < moved.size(); ++i) {
            objects_[moved[i]]->place(to[i]);
            changed_.push_back(objects_[moved[i]].get());
        }
        if (update == Update::all) {
            object_manager_.update();
        } else if (changed_.size() == 1) {
            object_manager_.update(changed_[0]);
        } else {
            object_manager_.update(changed_);
        }
    }

  private:
    using Object = fcl::CollisionObject<double>;
    using Set = std::vector<std::unique_ptr<Placed>>;
    // Pairs of triangles up to this number are of these two.
    struct End {
        const Placed *object, *link;
        std::size_t pairs;
    };

    static std::vector<Object *> pointers(const Set &set) {
        std::vector<Object *> made;
        for (const auto &one : set) {
            made.push_back(one.get());
        }
        return made;
    }

    void place_all(const std::vector<Transform> &at, double grown_by) {
        for (std::size_t i = 0; i < links_.size(); ++i) {
            links_[i]->place(at[i]);
            links_[i]->grow(grown_by);
        }
        link_manager_.update();
    }

    void for_near_boxes(const std::vector<Transform> &at, bool together,
                        fcl::CollisionCallBack<double> visit) {
        if (together) {
            place_all(at, epsilon_);
            object_manager_.collide(&link_manager_, this, visit);
        }
        for (std::size_t i = 0; !together && i < links_.size(); ++i) {
            links_[i]->place(at[i]);
            links_[i]->grow(epsilon_);
            object_manager_.collide(links_[i].get(), this, visit);
        }
    }

    void remember(Object *object, Object *link) {
        last_object_ = static_cast<Placed *>(object);
        last_link_ = static_cast<Placed *>(link);
    }

    static bool collide(Object *object, Object *link, void *data) {
        auto &self = *static_cast<Managed *>(data);
        fcl::CollisionResult<double> result;
        fcl::collide(object, link, self.first_contact_, result);
        if (result.isCollision()) {
            self.found_ = true;
            self.remember(object, link);
        }
        return self.found_;
    }

    static bool measure(Object *object, Object *link, void *data, double &bound) {
        auto &self = *static_cast<Managed *>(data);
        fcl::DistanceResult<double> result(self.nearest_);
        fcl::distance(object, link, self.distance_alone_, result);
        if (result.min_distance < self.nearest_) {
            self.nearest_ = result.min_distance;
            self.remember(object, link);
        }
        bound = self.nearest_;
        return self.nearest_ <= 0;
    }

    static bool add_pairs(Object *object, Object *link, void *data) {
        auto &self = *static_cast<Managed *>(data);
        if constexpr (std::is_same_v<BV, fcl::RSS<double>>) {
            const auto &one = static_cast<Placed &>(*object), &other = static_cast<Placed &>(*link);
            const NearPairs add(one, other, self.epsilon_, self.pairs_);
            self.ends_.push_back({&one, &other, self.pairs_.size()});
        }
        return false;
    }

    static bool add_nearest(Object *object, Object *link, void *data) {
        auto &self = *static_cast<Managed *>(data);
        bool near = self.contacts_first_ && self.add_contacts(object, link);
        if (!near) {
            const double beyond = std::numeric_limits<double>::infinity();
            fcl::DistanceResult<double> result(std::nextafter(self.epsilon_, beyond));
            fcl::distance(object, link, self.points_too_, result);
            near = result.min_distance <= self.epsilon_;
            if (near && result.min_distance > 0) {
                self.points_.push_back(result.nearest_points[0]);
                self.points_.push_back(result.nearest_points[1]);
            } else if (near && !self.contacts_first_) {
                self.add_contacts(object, link);
            }
        }
        if (near) {
            self.marks_ +=
                mark(static_cast<Placed *>(link)->number, static_cast<Placed *>(object)->number);
        }
        return false;
    }

    bool add_contacts(Object *object, Object *link) {
        fcl::CollisionResult<double> result;
        fcl::collide(object, link, all_contacts_, result);
        for (std::size_t i = 0; i < result.numContacts(); ++i) {
            points_.push_back(result.getContact(i).pos);
        }
        return result.isCollision();
    }

    Set links_, objects_;
    fcl::DynamicAABBTreeCollisionManager<double> object_manager_, link_manager_;
    const fcl::CollisionRequest<double> first_contact_{1, false}, all_contacts_{1 << 24, true};
    const fcl::DistanceRequest<double> distance_alone_{false}, points_too_{true};
    Placed *last_link_ = nullptr, *last_object_ = nullptr;
    bool found_ = false, contacts_first_ = false;
    double nearest_ = 0, epsilon_ = 0;
    std::uint64_t marks_ = 0;
    std::vector<Vector> points_;
    std::vector<NearPair> pairs_;
    std::vector<End> ends_;
    std::vector<Object *> changed_;
};
