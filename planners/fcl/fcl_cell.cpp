#include "fcl_cell.hpp"

#include "peer.hpp"

#include <chrono>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

const std::size_t trials = 1000;

PeerScene scene_of(const problems::Workcell &workcell) {
    PeerScene scene;
    std::set<std::uint32_t> asked(workcell.moving.begin(), workcell.moving.end());
    for (const problems::LinkPair &pair : workcell.pairs) {
        asked.insert(pair.begin(), pair.end());
    }
    for (const cstk::Robot &robot : workcell.robots) {
        for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
            const bool is_asked = asked.count(static_cast<std::uint32_t>(scene.links.size())) != 0;
            scene.links.push_back(is_asked ? surface_of(robot.body(link)) : Surface());
        }
    }
    for (const problems::Obstacle &obstacle : workcell.obstacles) {
        if (obstacle.cylinder) {
            const PeerScene::Cylinder cylinder = {obstacle.cylinder->radius, obstacle.cylinder->half_length};
            scene.obstacles.push_back({{}, obstacle.pose, {}, cylinder});
        } else {
            scene.obstacles.push_back({surface_of(obstacle.body), obstacle.pose, obstacle.half_extents, {}});
        }
    }
    scene.moving = workcell.moving;
    scene.pairs = workcell.pairs;
    return scene;
}

} // namespace

FclCell::FclCell(const problems::Workcell &workcell, const std::string &way) : space_(workcell.space) {
    std::vector<PeerWay> ways = fcl_ways(scene_of(workcell), way);
    if (ways.empty()) {
        throw std::runtime_error("FCL has no way " + way);
    }
    peer_ = std::move(ways.front().peer);
}

FclCell::~FclCell() = default;

bool FclCell::meets(cstk::Span<double> q) const {
    return peer_->meets(space_.link_poses(q));
}

std::string FclCell::fastest_way(const problems::Workcell &workcell) {
    std::uint64_t random = 1;
    std::vector<std::vector<cstk::Pose>> placed;
    while (placed.size() < trials) {
        placed.push_back(workcell.space.link_poses(workcell.space.sample(random)));
    }
    std::string fastest;
    double least = std::numeric_limits<double>::infinity();
    for (const PeerWay &way : fcl_ways(scene_of(workcell))) {
        const auto start = std::chrono::steady_clock::now();
        for (const std::vector<cstk::Pose> &links : placed) {
            way.peer->meets(links);
        }
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        if (time.count() < least) {
            least = time.count();
            fastest = way.name;
        }
    }
    return fastest;
}
