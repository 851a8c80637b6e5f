// CollisionObject and the managers as MoveIt and Tesseract use them: user data, copies, subclasses, updates, callbacks that stop.
#include "library.hpp"

#include <set>

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::DynamicAABBTreeCollisionManagerd;

// An object with a name of its own.
class NamedObject : public Object {
  public:
    NamedObject(const Geometry &geometry, const Transform &tf, int number) : Object(geometry, tf), number_(number) {
        setUserData(this);
    }
    int number() const { return number_; }

  private:
    int number_;
};

int number_of(const Object *object) { return static_cast<const NamedObject *>(object->getUserData())->number(); }

std::vector<std::unique_ptr<NamedObject>> scene(std::uint64_t seed, int count, double reach, int first) {
    models::Random random(seed);
    std::vector<std::unique_ptr<NamedObject>> objects;
    for (int i = 0; i < count; ++i) {
        Geometry geometry = std::make_shared<fcl::Sphered>(random.uniform(0.2, 0.6));
        if (i % 3 == 1) {
            geometry = std::make_shared<fcl::Boxd>(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
        } else if (i % 3 == 2) {
            geometry = std::make_shared<fcl::Capsuled>(random.uniform(0.1, 0.3), random.uniform(0.3, 1));
        }
        objects.push_back(std::make_unique<NamedObject>(geometry, random_transform(random, reach), first + i));
    }
    return objects;
}

std::vector<Object *> addresses(const std::vector<std::unique_ptr<NamedObject>> &objects) {
    std::vector<Object *> out;
    for (const auto &object : objects) {
        out.push_back(object.get());
    }
    return out;
}

struct Found {
    std::set<std::pair<int, int>> pairs;
    int calls = 0;
    int stop_after = -1;
};

bool collect(Object *a, Object *b, void *data) {
    Found &found = *static_cast<Found *>(data);
    ++found.calls;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (fcl::collide(a, b, request, result) > 0) {
        found.pairs.insert(std::minmax(number_of(a), number_of(b)));
    }
    return found.calls == found.stop_after;
}

struct Nearest {
    fcl::DistanceResultd result;
};

bool keep_nearest(Object *a, Object *b, void *data, double &dist) {
    Nearest &nearest = *static_cast<Nearest *>(data);
    fcl::distance(a, b, fcl::DistanceRequestd(true), nearest.result);
    dist = nearest.result.min_distance;
    return dist <= 0;
}

void answer_pairs(const std::string &label, const Found &found) {
    double sum = 0;
    for (const auto &pair : found.pairs) {
        sum += (1 + pair.first) * (7919.0 + pair.second);
    }
    answer(label + "/count", static_cast<double>(found.pairs.size()), 0);
    answer(label + "/which", sum, 0);
}

// Every way to ask of two managers; all pairs by brute force are the truth.
void answer_all(const std::string &label, const Manager &a, const Manager &b, Object *one) {
    std::vector<Object *> in_a, in_b;
    a.getObjects(in_a);
    b.getObjects(in_b);
    Found self, self_truth, between, between_truth, single, single_truth;
    a.collide(&self, collect);
    for (std::size_t i = 0; i < in_a.size(); ++i) {
        collect(in_a[i], one, &single_truth);
        for (std::size_t j = i + 1; j < in_a.size(); ++j) {
            collect(in_a[i], in_a[j], &self_truth);
        }
        for (Object *other : in_b) {
            collect(in_a[i], other, &between_truth);
        }
    }
    a.collide(const_cast<Manager *>(&b), &between, collect);
    a.collide(one, &single, collect);
    expect(self.pairs == self_truth.pairs, label + ": all pairs within a manager");
    expect(between.pairs == between_truth.pairs, label + ": all pairs of two managers");
    expect(single.pairs == single_truth.pairs, label + ": all pairs of one object and a manager");
    answer_pairs(label + "/self", self);
    answer_pairs(label + "/between", between);
    answer_pairs(label + "/one", single);
}

void answer_distances(const std::string &label, const Manager &a, const Manager &b, Object *one) {
    Nearest self, between, single;
    a.distance(&self, keep_nearest);
    a.distance(const_cast<Manager *>(&b), &between, keep_nearest);
    a.distance(one, &single, keep_nearest);
    answer(label + "/self", std::max(0.0, self.result.min_distance), 1e-5);
    answer(label + "/between", std::max(0.0, between.result.min_distance), 1e-5);
    answer(label + "/one", std::max(0.0, single.result.min_distance), 1e-5);
}

void crowds() {
    const auto first = scene(1, 80, 2.5, 0), second = scene(2, 50, 2.5, 1000), single = scene(3, 1, 0.5, 2000);
    Manager a, b;
    expect(a.empty() && a.size() == 0, "a new manager is empty");
    a.registerObjects(addresses(first));
    for (Object *object : addresses(second)) {
        b.registerObject(object);
    }
    a.setup();
    b.setup();
    expect(a.size() == 80 && b.size() == 50, "sizes");
    answer_all("crowd", a, b, single[0].get());

    models::Random random(4);
    for (const auto &object : first) {
        object->setTransform(random_transform(random, 2.5));
        object->computeAABB();
    }
    a.update();
    answer_all("moved", a, b, single[0].get());
    std::vector<Object *> few;
    for (int i = 0; i < 50; i += 4) {
        second[static_cast<std::size_t>(i)]->setTranslation(Vector(random.uniform(-2, 2), 0, 0));
        second[static_cast<std::size_t>(i)]->computeAABB();
        few.push_back(second[static_cast<std::size_t>(i)].get());
    }
    b.update(few);
    second[1]->setIdentityTransform();
    second[1]->computeAABB();
    b.update(second[1].get());
    answer_all("some_moved", a, b, single[0].get());
    for (std::size_t i = 0; i < 80; i += 2) {
        a.unregisterObject(first[i].get());
    }
    a.setup();
    expect(a.size() == 40, "size after objects went");
    answer_all("some_gone", a, b, single[0].get());

    Found one_call;
    one_call.stop_after = 1;
    a.collide(&b, &one_call, collect);
    expect(one_call.calls == 1, "a callback that returns true ends the search");
    a.clear();
    expect(a.empty(), "clear() empties a manager");
    Found none;
    a.collide(&none, collect);
    a.collide(&b, &none, collect);
    expect(none.calls == 0, "an empty manager has no pairs");
}

void sparse() {
    const auto first = scene(5, 30, 30, 0), second = scene(6, 30, 30, 1000), single = scene(7, 1, 30, 2000);
    Manager a, b;
    a.registerObjects(addresses(first));
    b.registerObjects(addresses(second));
    a.setup();
    b.setup();
    answer_distances("sparse", a, b, single[0].get());
    fcl::DefaultDistanceData<double> nearest;
    nearest.request.enable_nearest_points = true;
    a.distance(&b, &nearest, fcl::DefaultDistanceFunction<double>);
    answer("sparse/default", nearest.result.min_distance, 1e-5);
    const double between = (nearest.result.nearest_points[0] - nearest.result.nearest_points[1]).norm();
    expect_near(between, nearest.result.min_distance, 1e-4, "nearest points of managers");
    fcl::DefaultCollisionData<double> any;
    a.collide(&b, &any, fcl::DefaultCollisionFunction<double>);
    expect(!any.result.isCollision(), "nothing meets in a sparse scene");
}

void objects() {
    const auto box = std::make_shared<fcl::Boxd>(1, 2, 3);
    Object object(box, at(1, 2, 3));
    int data = 0;
    object.setUserData(&data);
    Object copy(object);
    expect(copy.getUserData() == &data && copy.collisionGeometry() == object.collisionGeometry(), "copies share geometry and data");
    copy.setTranslation(Vector(5, 5, 5));
    expect(object.getTranslation() == Vector(1, 2, 3), "and have transforms of their own");
    answer("object/low", object.getAABB().min_.sum(), 1e-9);
    copy.setQuatRotation(fcl::Quaterniond(fcl::AngleAxisd(0.5, Vector::UnitZ())));
    copy.computeAABB();
    expect_near(copy.getQuatRotation().angularDistance(fcl::Quaterniond::Identity()), 0.5, 1e-12, "rotation as a quaternion");
    expect(copy.getAABB().contain(copy.getTransform() * Vector(0.5, 1, 1.5)), "the box holds a corner");
    expect(!object.isIdentityTransform() && object.isOccupied() && !object.isFree(), "states");
    expect(object.getNodeType() == fcl::GEOM_BOX && object.getObjectType() == fcl::OT_GEOM, "types");
    fcl::DistanceResultd result;
    fcl::distance(&object, &copy, fcl::DistanceRequestd(true), result);
    answer("object/distance", result.min_distance, 1e-5);
    expect(result.o1 == box.get() && result.o2 == box.get(), "results name geometries");
}

} // namespace

int main() {
    objects();
    crowds();
    sparse();
    return failures() == 0 ? 0 : 1;
}
