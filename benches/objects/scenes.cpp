#include "scenes.hpp"

#include "ours.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace {

using models::Point;
using models::Random;

const std::size_t stations = 200;
const std::size_t shape_count = 16;
constexpr double object_radius = 0.1;
// Of the ball that the near objects stand in: the arm does not reach an object outside.
constexpr double near_radius = 1.2;
static_assert(near_radius - object_radius > arm_reach, "what is added is out of reach");
// None stands in the shoulder's way.
const double least_away = 0.35;
const double far_from = 5, far_to = 25;
// What is added among the others stays clear of the free arm by this.
const double gap = 1e-3;

// At a distance from the origin, turned at random.
cstk::Pose placed(double away, Random &random) {
    std::array<double, 7> pose = {};
    const Point d = random.direction();
    const Point axis = random.direction();
    const double half = random.uniform(0, models::pi);
    for (std::size_t k = 0; k < 3; ++k) {
        pose[k] = away * d[k];
        pose[3 + k] = std::sin(half) * axis[k];
    }
    pose[6] = std::cos(half);
    return cstk::pose_from_quaternion(pose);
}

// Evenly in the shell between two spheres.
cstk::Pose between(double low, double high, Random &random) {
    const double cube = random.uniform(low * low * low, high * high * high);
    return placed(std::cbrt(cube), random);
}

} // namespace

Workplace::Workplace(std::uint64_t seed) : seed_(seed) {
    Random random(seed);
    near_.shapes = small_bodies(shape_count, object_radius, random);
    for (std::size_t i = 0; i < near_count; ++i) {
        near_.items.push_back({i % shape_count, between(least_away, near_radius, random)});
    }
    find_random(random);
    find_coherent(random);
}

Station Workplace::station(const std::array<double, 6> &q, Ours &ours) const {
    LinkPoses links = arm_.space.link_poses(q);
    const bool meets = ours.within(links, 0);
    return {q, std::move(links), meets};
}

// Meeting objects and free of them in turn.
void Workplace::find_random(Random &random) {
    Ours ours(arm_.space, near_);
    while (random_.size() < stations) {
        std::array<double, 6> q;
        for (double &angle : q) {
            angle = random.uniform(-2.5, 2.5);
        }
        Station next = station(q, ours);
        if (next.meets == (random_.size() % 2 == 0)) {
            random_.push_back(std::move(next));
        }
    }
}

// The first of many ways that meets objects on 45 to 55 hundredths of it.
void Workplace::find_coherent(Random &random) {
    Ours ours(arm_.space, near_);
    for (int tries = 0; tries < 10000; ++tries) {
        std::vector<Station> way = round_trip(ours, random);
        const auto meets = [](const Station &station) { return station.meets; };
        const auto count = static_cast<std::size_t>(std::count_if(way.begin(), way.end(), meets));
        if (20 * count >= 9 * stations && 20 * count <= 11 * stations) {
            coherent_ = std::move(way);
            return;
        }
    }
    throw std::runtime_error("no way that is half free: try another seed");
}

std::vector<Station> Workplace::round_trip(Ours &ours, Random &random) const {
    double middle[6], swing[6], phase[6];
    for (int joint = 0; joint < 6; ++joint) {
        middle[joint] = random.uniform(-2, 2);
        swing[joint] = random.uniform(0.4, 1.2);
        phase[joint] = random.uniform(0, 2 * models::pi);
    }
    std::vector<Station> way;
    for (std::size_t k = 0; k < stations; ++k) {
        std::array<double, 6> q;
        for (std::size_t joint = 0; joint < 6; ++joint) {
            const double angle = 2 * models::pi * static_cast<double>(k) / stations + phase[joint];
            q[joint] = middle[joint] + swing[joint] * std::sin(angle);
        }
        way.push_back(station(q, ours));
    }
    return way;
}

Scene Workplace::far(std::size_t count) const {
    Random random(seed_ + 1);
    Scene scene = near_;
    while (scene.items.size() < count) {
        const std::size_t shape = scene.items.size() % shape_count;
        scene.items.push_back({shape, between(far_from, far_to, random)});
    }
    return scene;
}

Scene Workplace::dense(std::size_t count) const {
    Random random(seed_ + 2);
    Scene scene = near_;
    const auto radius = [](std::size_t objects) {
        return near_radius * std::cbrt(static_cast<double>(objects) / near_count);
    };
    while (scene.items.size() < count) {
        const std::size_t number = scene.items.size();
        const auto pose = between(radius(number), radius(number + 1), random);
        scene.items.push_back({number % shape_count, pose});
    }
    return scene;
}

Scene Workplace::crowded(std::size_t count) const {
    Random random(seed_ + 3);
    Scene scene = near_;
    // As much of the ball is filled, whatever the number.
    const double scale = std::cbrt(static_cast<double>(near_count) / static_cast<double>(count));
    const auto smaller = small_bodies(shape_count, scale * object_radius, random);
    scene.shapes.insert(scene.shapes.end(), smaller.begin(), smaller.end());
    // The arm where it is free, as obstacles.
    Scene ways{arm_.links, {}};
    for (const auto *all : {&random_, &coherent_}) {
        for (const Station &station : *all) {
            for (std::size_t link = 0; !station.meets && link < arm_.links.size(); ++link) {
                ways.items.push_back({link, station.links[link]});
            }
        }
    }
    std::vector<std::unique_ptr<Ours>> tests;
    for (const Shape &shape : smaller) {
        tests.push_back(std::make_unique<Ours>(single_body(shape), ways));
    }
    while (scene.items.size() < count) {
        const std::size_t shape = scene.items.size() % shape_count;
        const cstk::Pose pose = between(0, near_radius, random);
        if (!tests[shape]->within({pose}, gap)) {
            scene.items.push_back({shape_count + shape, pose});
        }
    }
    return scene;
}

std::vector<Step> Workplace::steps(const Scene &scene, std::size_t count, std::size_t steps,
                                   Jump jump) const {
    Random random(seed_ + 4);
    std::vector<std::size_t> order(scene.items.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<Step> made;
    for (std::size_t step = 0; step < steps; ++step) {
        Step next;
        for (std::size_t i = 0; i < count; ++i) {
            std::swap(order[i], order[i + random.below(order.size() - i)]);
            const bool is_far = jump == Jump::far;
            const std::size_t to = is_far ? random.below(scene.items.size()) : order[i];
            const cstk::Pose &home = scene.items[to].pose;
            cstk::Pose pose = placed(random.uniform(0, 0.05), random);
            for (const std::size_t k : {3, 7, 11}) {
                pose[k] += home[k];
            }
            next.moved.push_back(order[i]);
            next.to.push_back(pose);
        }
        made.push_back(std::move(next));
    }
    return made;
}

Step back_home(const Scene &scene, const std::vector<Step> &steps) {
    std::set<std::size_t> moved;
    for (const Step &step : steps) {
        moved.insert(step.moved.begin(), step.moved.end());
    }
    Step home;
    for (const std::size_t object : moved) {
        home.moved.push_back(object);
        home.to.push_back(scene.items[object].pose);
    }
    return home;
}
