// An arm of eight links in a scene of 200 objects, checked state by state as MoveIt does: managers of the links and of the scene,
// callbacks with a matrix of allowed pairs that stop at the first contact, contacts and distances on request.
//   scene [STATES]
#include "library.hpp"

#include <set>

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::DynamicAABBTreeCollisionManagerd;

// What MoveIt keeps behind an object's user data: its number; links come before the scene's objects.
constexpr int LINKS = 8;

int number_of(const Object *object) { return *static_cast<const int *>(object->getUserData()); }

struct Check {
    std::set<std::pair<int, int>> allowed;
    bool collision = false;
    double nearest = std::numeric_limits<double>::infinity();
};

bool stop_at_contact(Object *a, Object *b, void *data) {
    Check &check = *static_cast<Check *>(data);
    if (check.allowed.count(std::minmax(number_of(a), number_of(b))) != 0) {
        return false;
    }
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    check.collision = fcl::collide(a, b, request, result) > 0;
    return check.collision;
}

bool keep_nearest(Object *a, Object *b, void *data, double &least) {
    Check &check = *static_cast<Check *>(data);
    if (check.allowed.count(std::minmax(number_of(a), number_of(b))) != 0) {
        return false;
    }
    fcl::DistanceResultd result;
    result.min_distance = std::min(check.nearest, std::numeric_limits<double>::max());
    fcl::distance(a, b, fcl::DistanceRequestd(true), result);
    check.nearest = std::min(check.nearest, static_cast<double>(result.min_distance));
    least = std::max(check.nearest, 0.0);
    return check.nearest <= 0;
}

struct Scene {
    std::vector<std::unique_ptr<Object>> objects;
    std::vector<int> numbers;
    Manager links, world;

    Scene() : numbers(LINKS + 200) {
        models::Random random(51);
        const auto link_mesh = model_of(models::cylinder("link", 0.12, 0.7, 24));
        for (int i = 0; i < static_cast<int>(numbers.size()); ++i) {
            Geometry geometry = link_mesh;
            if (i >= LINKS) {
                const Vector side(random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), random.uniform(0.1, 0.4));
                geometry = std::make_shared<fcl::Boxd>(side);
                if (i % 4 == 0) {
                    geometry = model_of(models::torus(0.2, 0.06, 20, 10));
                } else if (i % 4 == 1) {
                    geometry = std::make_shared<fcl::Sphered>(random.uniform(0.05, 0.2));
                }
            }
            // Around the arm, but not at its base.
            Transform place = random_transform(random, 3);
            while (place.translation().norm() < 1) {
                place = random_transform(random, 3);
            }
            numbers[static_cast<std::size_t>(i)] = i;
            objects.push_back(std::make_unique<Object>(geometry, place));
            objects.back()->setUserData(&numbers[static_cast<std::size_t>(i)]);
            (i < LINKS ? links : world).registerObject(objects.back().get());
        }
        links.setup();
        world.setup();
    }

    // Puts the links where the joints' angles have them, each turned about an axis across the one before.
    void pose(const std::vector<double> &angles) {
        Transform frame = Transform::Identity();
        for (int i = 0; i < LINKS; ++i) {
            frame.rotate(fcl::AngleAxisd(angles[static_cast<std::size_t>(i)], i % 2 == 0 ? Vector::UnitX() : Vector::UnitY()));
            Transform middle = frame;
            middle.translate(Vector(0, 0, 0.36));
            Object &link = *objects[static_cast<std::size_t>(i)];
            link.setTransform(middle);
            link.computeAABB();
            frame.translate(Vector(0, 0, 0.72));
        }
        links.update();
    }
};

} // namespace

int main(int argc, char **argv) {
    const int states = argc > 1 ? std::atoi(argv[1]) : 1000;
    Scene scene;
    models::Random random(52);
    Check check;
    for (int i = 0; i + 1 < LINKS; ++i) {
        check.allowed.insert({i, i + 1});
    }
    double checking = 0, measuring = 0;
    for (int i = 0; i < states; ++i) {
        std::vector<double> angles;
        for (int k = 0; k < LINKS; ++k) {
            angles.push_back(random.uniform(-1, 1));
        }
        Check found = check, near = check;
        const Clock clock;
        scene.pose(angles);
        scene.links.collide(&found, stop_at_contact);
        const bool self = found.collision;
        if (!found.collision) {
            scene.world.collide(&scene.links, &found, stop_at_contact);
        }
        checking += clock.seconds();
        const Clock second;
        scene.links.distance(&near, keep_nearest);
        scene.world.distance(&scene.links, &near, keep_nearest);
        measuring += second.seconds();
        const std::string label = "scene/" + std::to_string(i);
        const double gap = near.nearest > 0 ? near.nearest : 1;
        decision(label + "/self", self, gap, 1e-6);
        decision(label + "/collision", found.collision, gap, 1e-6);
        answer(label + "/distance", std::max(near.nearest, 0.0), 1e-4);
    }
    duration("scene/collision", checking);
    duration("scene/distance", measuring);
    return failures() == 0 ? 0 : 1;
}
