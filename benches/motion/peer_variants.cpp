#include "peer_variants.hpp"

#include "peer.hpp"
#include "sampling.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

namespace {

PeerScene peer_scene_of(const Scene &scene) {
    PeerScene made;
    for (std::uint32_t link = 0; link < scene.robot.link_count(); ++link) {
        const bool has_body = scene.robot.link_info(link).has_body;
        made.links.push_back(has_body ? surface_of(scene.robot.body(link)) : Surface());
    }
    for (const Obstacle &obstacle : scene.obstacles) {
        made.obstacles.push_back(
            {surface_of(obstacle.body), obstacle.pose, obstacle.half_extents});
    }
    made.moving = scene.moving;
    made.pairs = scene.pairs;
    return made;
}

// The kinematics are this library's.
Variant sampling(const std::string &library, const Scene &scene, const Step &step,
                 const std::shared_ptr<Peer> &peer) {
    const auto q = std::make_shared<Numbers>();
    const auto poses = std::make_shared<std::vector<cstk::Pose>>(scene.space.link_count());
    const auto ask = [=, &scene](const Segment &segment) {
        return sampled(scene.space, segment, step, *q, [&](const Numbers &at) {
            cstk::check(cstk_space_link_poses(scene.space.get(), at.data(), at.size(),
                                              poses->data()->data()));
            return peer->meets(*poses);
        });
    };
    return {library, step.name, ask};
}

double seconds(const Variant &variant, const std::vector<Segment> &segments) {
    using Clock = std::chrono::steady_clock;
    double least = INFINITY;
    for (int pass = 0; pass < 2; ++pass) {
        const auto start = Clock::now();
        for (const Segment &segment : segments) {
            variant.ask(segment);
        }
        const std::chrono::duration<double> time = Clock::now() - start;
        least = std::min(least, time.count());
    }
    return least;
}

void add_fastest(const std::string &library, std::vector<PeerWay> ways, const Scene &scene,
                 const std::vector<Segment> &trial, std::vector<Variant> &to) {
    const PeerWay *fastest = nullptr;
    double least = INFINITY;
    std::shared_ptr<Peer> kept;
    for (PeerWay &way : ways) {
        const std::shared_ptr<Peer> peer(std::move(way.peer));
        const double time = seconds(sampling(library, scene, steps[0], peer), trial);
        if (!fastest || time < least) {
            fastest = &way;
            least = time;
            kept = peer;
        }
    }
    if (!fastest) {
        return;
    }
    std::fprintf(stderr, "%s: %s asks by %s\n", scene.name.c_str(), library.c_str(),
                 fastest->name.c_str());
    for (const Step &step : steps) {
        to.push_back(sampling(library, scene, step, kept));
    }
}

bool moves_freely(const Scene &scene) {
    return scene.robot.link_count() == 1 && scene.robot.link_info(0).joint == CSTK_JOINT_FREE;
}

Variant continuous(const Scene &scene, const PeerScene &peer_scene) {
    const auto peer = std::make_shared<const FclContinuous>(peer_scene);
    const auto ask = [peer, &scene](const Segment &segment) {
        const std::optional<double> contact =
            peer->first_contact(scene.space.link_poses(segment.ends.q0)[0],
                                scene.space.link_poses(segment.ends.q1)[0]);
        return Verdict{contact.has_value(), 0, contact};
    };
    return {"fcl", "continuous", ask};
}

} // namespace

std::vector<Variant> peer_variants(const Scene &scene, const std::vector<Segment> &trial) {
    std::vector<Variant> made;
    const PeerScene peer_scene = peer_scene_of(scene);
    add_fastest("fcl", fcl_ways(peer_scene), scene, trial, made);
    if (moves_freely(scene)) {
        made.push_back(continuous(scene, peer_scene));
    }
    add_fastest("coal", coal_ways(peer_scene), scene, trial, made);
    return made;
}
