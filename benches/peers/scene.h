// What the peers share: which variants there are, and how the pairs of a scene are gone through. The pairs themselves and
// the trees over bodies are the peer's.
#pragma once

#include "peers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace peers {

enum class Layout {
    merged,   // all obstacles in one mesh
    bodies,   // every obstacle on its own, nearest boxes first
    manager,  // every obstacle in the peer's own tree of boxes
};

enum class Method {
    plain,    // the peer's public entry
    seeded,   // the peer's traversal, started from the triangles which won the query before
    queue,    // the same, nearest volumes first
    overlap,  // boolean: the traversal for collisions, started from those triangles
};

struct Variant {
    int volume;
    Layout layout;
    Method method;
    bool serves[3];
    std::string name;
};

// The triangles which decided the last query.
struct Winner {
    std::size_t link = 0, obstacle = 0;
    int link_triangle = -1, obstacle_triangle = -1;
};

struct Box {
    double center[3], half[3];

    static Box of(const peer_mesh *meshes, std::size_t count) {
        double low[3], high[3];
        std::fill(low, low + 3, std::numeric_limits<double>::infinity());
        std::fill(high, high + 3, -std::numeric_limits<double>::infinity());
        for (std::size_t mesh = 0; mesh < count; ++mesh)
            for (std::size_t at = 0; at < 3 * meshes[mesh].vertex_count; ++at) {
                low[at % 3] = std::min(low[at % 3], meshes[mesh].vertices[at]);
                high[at % 3] = std::max(high[at % 3], meshes[mesh].vertices[at]);
            }
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            box.center[axis] = 0.5 * (low[axis] + high[axis]);
            box.half[axis] = 0.5 * (high[axis] - low[axis]);
        }
        return box;
    }

    Box moved(const double *pose) const {
        Box box;
        for (int row = 0; row < 3; ++row) {
            const double *entry = pose + 4 * row;
            box.center[row] = entry[0] * center[0] + entry[1] * center[1] + entry[2] * center[2] + entry[3];
            box.half[row] = std::fabs(entry[0]) * half[0] + std::fabs(entry[1]) * half[1] + std::fabs(entry[2]) * half[2];
        }
        return box;
    }

    double distance(const Box &other) const {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            double gap = std::fabs(center[axis] - other.center[axis]) - half[axis] - other.half[axis];
            if (gap > 0) sum += gap * gap;
        }
        // A little less, since boxes are rounded too.
        return std::sqrt(sum) * (1 - 1e-12) - 1e-14;
    }
};

class AnyScene {
public:
    virtual ~AnyScene() = default;
    virtual double run(int mode, double threshold, const double *poses, std::size_t query_count, double *answers) = 0;
};

template <class Peer>
class Scene final : public AnyScene {
public:
    Scene(const peer_mesh *moving, std::size_t moving_count, const peer_mesh *obstacles, std::size_t obstacle_count,
          const Variant &variant)
        : variant(variant) {
        for (std::size_t link = 0; link < moving_count; ++link) {
            links.push_back(Peer::model(moving + link, 1));
            link_boxes.push_back(Box::of(moving + link, 1));
        }
        std::size_t per_body = variant.layout == Layout::merged ? obstacle_count : 1;
        for (std::size_t first = 0; first < obstacle_count; first += per_body) {
            bodies.push_back(Peer::model(obstacles + first, per_body));
            body_boxes.push_back(Box::of(obstacles + first, per_body));
        }
        for (auto &link : links)
            for (auto &body : bodies) pairs.emplace_back(link, body, variant.method);
        if (variant.layout == Layout::manager) manager = std::make_unique<typename Peer::Manager>(links, bodies);
    }

    double run(int mode, double threshold, const double *numbers, std::size_t query_count, double *answers) override {
        if (mode < 0 || mode > 2 || !variant.serves[mode]) return -1;
        winner = Winner();
        std::vector<typename Peer::Pose> poses;
        poses.reserve(query_count * links.size());
        for (std::size_t at = 0; at < query_count * links.size(); ++at) poses.push_back(Peer::pose(numbers + 12 * at));
        auto start = std::chrono::steady_clock::now();
        for (std::size_t query = 0; query < query_count; ++query) {
            query_poses = poses.data() + query * links.size();
            query_numbers = numbers + 12 * query * links.size();
            if (mode == PEER_DISTANCE)
                answers[query] = distance();
            else
                answers[query] = meets(mode == PEER_COLLIDE, threshold);
        }
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

private:
    struct Candidate {
        double bound;
        std::size_t link, body;
    };

    bool remembers() const { return variant.method != Method::plain && winner.link_triangle >= 0; }

    typename Peer::Pair &pair(std::size_t link, std::size_t body) { return pairs[link * bodies.size() + body]; }

    void remember(std::size_t link, std::size_t body, int link_triangle, int obstacle_triangle) {
        winner.link = link;
        winner.obstacle = body;
        winner.link_triangle = link_triangle;
        winner.obstacle_triangle = obstacle_triangle;
    }

    // Pairs whose boxes are nearer than the bound, nearest first.
    void collect(double bound) {
        candidates.clear();
        for (std::size_t link = 0; link < links.size(); ++link) {
            Box box = link_boxes[link].moved(query_numbers + 12 * link);
            for (std::size_t body = 0; body < bodies.size(); ++body) {
                double lower = box.distance(body_boxes[body]);
                if (lower <= bound) candidates.push_back({lower, link, body});
            }
        }
        if (candidates.size() > 1)
            std::sort(candidates.begin(), candidates.end(),
                      [](const Candidate &one, const Candidate &other) { return one.bound < other.bound; });
    }

    double distance() {
        double best = std::numeric_limits<double>::max();
        if (remembers())
            best = pair(winner.link, winner.obstacle).triangle_distance(query_poses[winner.link], winner);
        nearest(best, 0);
        return std::max(best, 0.0);
    }

    // Lowers best to the least distance below it; any distance down to stop_at ends the search.
    void nearest(double &best, double stop_at) {
        auto visit = [&](std::size_t link, std::size_t body) {
            int link_triangle = -1, obstacle_triangle = -1;
            double found =
                pair(link, body).distance(query_poses[link], best, stop_at, link_triangle, obstacle_triangle);
            if (found < best) {
                best = found;
                remember(link, body, link_triangle, obstacle_triangle);
            }
            return best <= stop_at;
        };
        if (manager) {
            for (std::size_t link = 0; link < links.size() && best > stop_at; ++link)
                manager->distance(link, query_poses[link], best, [&](std::size_t body) { return visit(link, body); });
            return;
        }
        if (pairs.size() == 1) {
            if (best > stop_at) visit(0, 0);
            return;
        }
        collect(best);
        for (auto &candidate : candidates)
            if (best <= stop_at || candidate.bound > best || visit(candidate.link, candidate.body)) break;
    }

    bool meets(bool collide, double threshold) {
        if (collide) threshold = 0;
        if (remembers()) {
            auto &last = pair(winner.link, winner.obstacle);
            const auto &pose = query_poses[winner.link];
            if (collide ? last.triangles_meet(pose, winner) : last.triangle_distance(pose, winner) <= threshold)
                return true;
        }
        // Methods without a test of their own ask for the least distance.
        if (!Peer::tests(variant.method, collide)) {
            double best = std::nextafter(threshold, std::numeric_limits<double>::max());
            nearest(best, threshold);
            return best <= threshold;
        }
        bool met = false;
        auto visit = [&](std::size_t link, std::size_t body) {
            int link_triangle = -1, obstacle_triangle = -1;
            met = pair(link, body).meets(query_poses[link], threshold, link_triangle, obstacle_triangle);
            if (met) remember(link, body, link_triangle, obstacle_triangle);
            return met;
        };
        if (manager) {
            for (std::size_t link = 0; link < links.size() && !met; ++link)
                if (threshold <= 0) {
                    manager->collide(link, query_poses[link], [&](std::size_t body) { return visit(link, body); });
                } else {
                    double bound = std::nextafter(threshold, std::numeric_limits<double>::max());
                    manager->distance(link, query_poses[link], bound,
                                      [&](std::size_t body) { return visit(link, body); });
                }
            return met;
        }
        if (pairs.size() == 1) return visit(0, 0);
        collect(threshold);
        for (auto &candidate : candidates)
            if (visit(candidate.link, candidate.body)) break;
        return met;
    }

    Variant variant;
    std::vector<typename Peer::ModelPointer> links, bodies;
    std::vector<Box> link_boxes, body_boxes;
    std::vector<typename Peer::Pair> pairs;
    std::unique_ptr<typename Peer::Manager> manager;
    Winner winner;
    std::vector<Candidate> candidates;
    const typename Peer::Pose *query_poses = nullptr;
    const double *query_numbers = nullptr;
};

inline int variant_count(const std::vector<Variant> &variants, int mode) {
    int count = 0;
    for (std::size_t at = 0; at < variants.size(); ++at)
        if (mode >= 0 && mode < 3 && variants[at].serves[mode]) count = static_cast<int>(at) + 1;
    return count;
}

inline const Variant *variant_at(const std::vector<Variant> &variants, int variant) {
    return variant >= 0 && variant < static_cast<int>(variants.size()) ? &variants[variant] : nullptr;
}

// Exceptions stay on this side of the interface.
inline double run(void *scene, int mode, double threshold, const double *poses, std::size_t query_count,
                  double *answers) {
    try {
        return static_cast<AnyScene *>(scene)->run(mode, threshold, poses, query_count, answers);
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "peer: %s\n", failure.what());
        return -1;
    }
}

// The functions of the interface, from a list of variants and a function which builds scenes.
#define PEER_INTERFACE(prefix, variants, build)                                                                        \
    extern "C" {                                                                                                       \
    int prefix##_variant_count(int mode) { return peers::variant_count(variants(), mode); }                            \
    int prefix##_variant_serves(int variant, int mode) {                                                               \
        auto found = peers::variant_at(variants(), variant);                                                           \
        return found && mode >= 0 && mode < 3 && found->serves[mode];                                                  \
    }                                                                                                                  \
    const char *prefix##_variant_name(int variant) {                                                                   \
        auto found = peers::variant_at(variants(), variant);                                                           \
        return found ? found->name.c_str() : nullptr;                                                                  \
    }                                                                                                                  \
    void *prefix##_scene(const peer_mesh *moving, size_t moving_count, const peer_mesh *obstacles,                     \
                       size_t obstacle_count, int variant) {                                                           \
        auto found = peers::variant_at(variants(), variant);                                                           \
        if (!found || moving_count == 0 || obstacle_count == 0) return nullptr;                                        \
        try {                                                                                                          \
            return build(moving, moving_count, obstacles, obstacle_count, *found);                                     \
        } catch (const std::exception &failure) {                                                                      \
            std::fprintf(stderr, "peer: %s\n", failure.what());                                                        \
            return nullptr;                                                                                            \
        }                                                                                                              \
    }                                                                                                                  \
    void prefix##_scene_free(void *scene) { delete static_cast<peers::AnyScene *>(scene); }                            \
    double prefix##_run(void *scene, int mode, double threshold, const double *poses, size_t query_count,              \
                      double *answers) {                                                                               \
        return peers::run(scene, mode, threshold, poses, query_count, answers);                                        \
    }                                                                                                                  \
    }

}  // namespace peers
