#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace {

const std::size_t tries = 12000;

struct Bounds {
    std::array<double, 3> low, high;
};

Bounds bounds_of(const std::vector<Obstacle> &obstacles) {
    const double beyond = std::numeric_limits<double>::infinity();
    Bounds bounds{{beyond, beyond, beyond}, {-beyond, -beyond, -beyond}};
    for (const Obstacle &obstacle : obstacles) {
        const cstk_body_statistics statistics = obstacle.body.statistics();
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.low[k] = std::min(bounds.low[k], statistics.low[k]);
            bounds.high[k] = std::max(bounds.high[k], statistics.high[k]);
        }
    }
    return bounds;
}

// Evenly among all turns.
std::array<double, 4> random_turn(Random &random) {
    const double u = random.uniform(0, 1), v = random.uniform(0, 2 * models::pi),
                 w = random.uniform(0, 2 * models::pi);
    return {std::sqrt(1 - u) * std::sin(v), std::sqrt(1 - u) * std::cos(v),
            std::sqrt(u) * std::sin(w), std::sqrt(u) * std::cos(w)};
}

// From anywhere in the box of the obstacles, grown by `margin`.
Scene::Draw free_flight(const Bounds &bounds, double margin) {
    return [=](const Scene &scene, double length, Random &random) -> std::optional<Ends> {
        Numbers q(7), v(6);
        for (std::size_t k = 0; k < 3; ++k) {
            q[k] = random.uniform(bounds.low[k] - margin, bounds.high[k] + margin);
        }
        const std::array<double, 4> turn = random_turn(random);
        std::copy(turn.begin(), turn.end(), q.begin() + 3);
        const models::Point shift = random.direction(), axis = random.direction();
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = 0.5 * length * shift[k];
            v[3 + k] = 0.5 * length * axis[k];
        }
        return Ends{q, scene.space.step(q, v)};
    };
}

} // namespace

void add_rigid_scenes(const std::string &folder, Scenes &scenes) {
    for (const char *name : {"FL", "FP", "bumpy"}) {
        const std::string start = folder + "/" + name;
        cstk::Link link;
        link.body = cstk::BodyBuilder().add_mesh_file(start + "_moving.obj").build();
        link.joint = CSTK_JOINT_FREE;
        cstk::RobotBuilder robot;
        robot.add_link(link);
        std::vector<Obstacle> obstacles;
        for (int i = 0;; ++i) {
            const std::string file = start + "_obstacle_" + std::to_string(i) + ".obj";
            if (!std::filesystem::exists(file)) {
                break;
            }
            const cstk::Body body = cstk::BodyBuilder().add_mesh_file(file).build();
            obstacles.push_back({body, cstk::identity(), {}});
        }
        const Bounds bounds = bounds_of(obstacles);
        scenes.push_back(std::make_unique<Scene>(name, robot.build(), obstacles,
                                                 std::vector<LinkPair>(), tries,
                                                 free_flight(bounds, 0.5)));
    }
}
