// What the peers share where they are asked about two shapes: how the queries of a pass are gone
// through, and which variants there are. The shapes and the answers are the peer's.
#pragma once

#include "shape_geometry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <vector>

namespace peers {

// What is asked of a pair.
struct Question {
    int mode;
    std::size_t most_contacts;
};

class AnyPair {
  public:
    virtual ~AnyPair() = default;
    virtual double run(const double *poses, const double *thresholds, std::size_t query_count,
                       double *answers) = 0;
};

// A pair that `Asked` answers for: it has a type Pose and its maker, forget() what earlier queries
// left, and answer() at two poses.
template <class Asked> class PosedPair final : public AnyPair {
  public:
    template <class... Arguments>
    explicit PosedPair(Arguments &&...arguments) : asked_(std::forward<Arguments>(arguments)...) {}

    double run(const double *numbers, const double *thresholds, std::size_t query_count,
               double *answers) override {
        std::vector<typename Asked::Pose> poses;
        poses.reserve(2 * query_count);
        for (std::size_t at = 0; at < 2 * query_count; ++at) {
            poses.push_back(Asked::pose(numbers + 12 * at));
        }
        asked_.forget();
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t query = 0; query < query_count; ++query) {
            answers[query] =
                asked_.answer(poses[2 * query], poses[2 * query + 1], thresholds[query]);
        }
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

  private:
    Asked asked_;
};

// The functions of peers.h, which know more ways to ask about two meshes than are public.
struct SceneFunctions {
    const char *(*variant_name)(int);
    int (*variant_serves)(int, int);
    void *(*scene)(const peer_mesh *, std::size_t, const peer_mesh *, std::size_t, int);
    void (*scene_free)(void *);
    double (*run)(void *, int, double, const double *, std::size_t, double *);
};

// The pose of the first in the frame of the second.
inline void relative_pose(const double *first, const double *second, double *out) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                const double shift = column == 3 ? second[4 * k + 3] : 0;
                sum += second[4 * k + row] * (first[4 * k + column] - shift);
            }
            out[4 * row + column] = sum;
        }
    }
}

// Two meshes, the second standing still.
class MeshPair final : public AnyPair {
  public:
    MeshPair(const SceneFunctions &functions, void *scene, int mode)
        : functions_(functions), scene_(scene), mode_(mode) {}
    ~MeshPair() override { functions_.scene_free(scene_); }
    MeshPair(const MeshPair &) = delete;
    MeshPair &operator=(const MeshPair &) = delete;

    double run(const double *poses, const double *thresholds, std::size_t query_count,
               double *answers) override {
        std::vector<double> relative(12 * query_count);
        for (std::size_t query = 0; query < query_count; ++query) {
            relative_pose(poses + 24 * query, poses + 24 * query + 12, &relative[12 * query]);
        }
        if (mode_ != PEER_WITHIN) {
            return functions_.run(scene_, mode_, 0, relative.data(), query_count, answers);
        }
        // A run has one threshold: each query is a run of its own.
        double seconds = 0;
        for (std::size_t query = 0; query < query_count; ++query) {
            const double one = functions_.run(scene_, mode_, thresholds[query],
                                              &relative[12 * query], 1, answers + query);
            if (one < 0) {
                return -1;
            }
            seconds += one;
        }
        return seconds;
    }

  private:
    SceneFunctions functions_;
    void *scene_;
    int mode_;
};

// Null where the variant of peers.h does not serve. With one body there is only one layout.
inline AnyPair *mesh_pair(const SceneFunctions &functions, const peer_shape &first,
                          const peer_shape &second, int mode, int variant) {
    const char *name = functions.variant_name(variant);
    if (!name || !std::strstr(name, " merged ") || !functions.variant_serves(variant, mode)) {
        return nullptr;
    }
    void *scene = functions.scene(&first.surface, 1, &second.surface, 1, variant);
    return scene ? new MeshPair(functions, scene, mode) : nullptr;
}

inline bool has_kind(const peer_shape &first, const peer_shape &second, int kind) {
    return first.kind == kind || second.kind == kind;
}

// Whether a traversal of volumes, or none, fits the shapes, and a call for distances or for
// collisions the mode.
inline bool fits(const peer_shape &first, const peer_shape &second, int mode, bool has_volume,
                 bool asks_distance) {
    const bool mode_fits = mode == PEER_WITHIN || (mode == PEER_DISTANCE) == asks_distance;
    return mode_fits && has_kind(first, second, PEER_MESH) == has_volume;
}

// As answers are given: distances not below 0.
inline double answer_of_distance(int mode, double distance, double threshold) {
    return mode == PEER_WITHIN ? distance <= threshold : std::max(distance, 0.0);
}

template <class Work, class Result> Result guarded(Result failed, Work work) {
    try {
        return work();
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "peer: %s\n", failure.what());
        return failed;
    }
}

// The functions of the interface, from a list of the peer's own variants, a function that builds
// pairs for them, and the functions of peers.h, whose variants come after them.
#define PEER_SHAPE_INTERFACE(prefix, variants, build)                                              \
    static const peers::SceneFunctions prefix##_scene_functions = {                                \
        prefix##_variant_name, prefix##_variant_serves, prefix##_scene, prefix##_scene_free,       \
        prefix##_run};                                                                             \
    extern "C" {                                                                                   \
    const char *prefix##_pair_variant(int variant) {                                               \
        const int own = static_cast<int>(variants().size());                                       \
        return variant < own ? variants()[variant].name.c_str()                                    \
                             : prefix##_variant_name(variant - own);                               \
    }                                                                                              \
    void *prefix##_pair(const peer_shape *first, const peer_shape *second, int mode,               \
                        std::size_t most_contacts, int variant) {                                  \
        const int own = static_cast<int>(variants().size());                                       \
        const bool meshes = first->kind == PEER_MESH && second->kind == PEER_MESH;                 \
        const bool by_scene = meshes && mode != PEER_CONTACTS;                                     \
        if (by_scene != (variant >= own)) {                                                        \
            return nullptr;                                                                        \
        }                                                                                          \
        return peers::guarded(static_cast<peers::AnyPair *>(nullptr), [&]() -> peers::AnyPair * {  \
            return by_scene ? peers::mesh_pair(prefix##_scene_functions, *first, *second, mode,    \
                                               variant - own)                                      \
                            : build(*first, *second, {mode, most_contacts}, variants()[variant]);  \
        });                                                                                        \
    }                                                                                              \
    void prefix##_pair_free(void *pair) { delete static_cast<peers::AnyPair *>(pair); }            \
    double prefix##_pair_run(void *pair, const double *poses, const double *thresholds,            \
                             std::size_t query_count, double *answers) {                           \
        return peers::guarded(-1.0, [&] {                                                          \
            return static_cast<peers::AnyPair *>(pair)->run(poses, thresholds, query_count,        \
                                                            answers);                              \
        });                                                                                        \
    }                                                                                              \
    }

} // namespace peers
