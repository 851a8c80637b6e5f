// Coal's answers about two shapes: its functions and its objects that keep what a pair needs, with
// each kind of its GJK and each first guess. Distances without a sign, so that no depth is computed
// where shapes meet; contacts off where only a yes or no is asked for.
#include "coal_bodies.h"

#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/octree.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include "shape_pair.h"

#include <limits>
#include <optional>
#include <string>

namespace {

using coal::GJKInitialGuess;
using coal::GJKVariant;

struct Way {
    peers::Volume volume;
    bool asks_distance;
    bool keeps_pair;
    GJKVariant gjk;
    GJKInitialGuess guess;
    std::string name;
};

struct Coal {
    using Geometry = std::shared_ptr<coal::CollisionGeometry>;
    using Sphere = coal::Sphere;
    using Capsule = coal::Capsule;
    using Box = coal::Box;
    using Cylinder = coal::Cylinder;
    using Cone = coal::Cone;
    using Ellipsoid = coal::Ellipsoid;
    using OcTree = coal::OcTree;
    using OBB = coal::OBB;
    using RSS = coal::RSS;
    using OBBRSS = coal::OBBRSS;
    using kIOS = coal::kIOS;

    template <class BV> static Geometry mesh(const peer_mesh &surface) {
        return peers::model<BV>(&surface, 1);
    }

    static Geometry hull(const peer_mesh &surface) {
        peers::Soup<coal::Vec3s, coal::Triangle> soup(&surface, 1);
        const auto points = static_cast<unsigned>(soup.vertices.size());
        const auto faces = static_cast<unsigned>(soup.triangles.size());
        return std::make_shared<coal::Convex<coal::Triangle>>(
            std::make_shared<std::vector<coal::Vec3s>>(std::move(soup.vertices)), points,
            std::make_shared<std::vector<coal::Triangle>>(std::move(soup.triangles)), faces);
    }
};

class Asked {
  public:
    using Pose = coal::Transform3s;
    static Pose pose(const double *numbers) { return peers::pose(numbers); }

    Asked(const peer_shape &first, const peer_shape &second, peers::Question question,
          const Way &way)
        : question_(question), way_(way), first_(peers::geometry<Coal>(first, way.volume)),
          second_(peers::geometry<Coal>(second, way.volume)) {
        if (way.asks_distance) {
            measurer_.emplace(first_.get(), second_.get());
        } else {
            collider_.emplace(first_.get(), second_.get());
        }
        const bool lists = question.mode == PEER_CONTACTS;
        collision_request_.num_max_contacts = lists ? question.most_contacts : 1;
        collision_request_.enable_contact = lists;
        // GJK may end as soon as more than the margin lies between.
        collision_request_.distance_upper_bound = 0;
        collision_request_.break_distance = 0;
        distance_request_.enable_signed_distance = false;
        forget();
    }

    void forget() {
        for (coal::QueryRequest *request :
             {static_cast<coal::QueryRequest *>(&collision_request_),
              static_cast<coal::QueryRequest *>(&distance_request_)}) {
            request->gjk_variant = way_.gjk;
            request->gjk_initial_guess = way_.guess;
            request->cached_gjk_guess = coal::Vec3s(1, 0, 0);
            request->cached_support_func_guess.setZero();
        }
    }

    double answer(const Pose &at, const Pose &other_at, double threshold) {
        return way_.asks_distance ? by_distance(at, other_at, threshold)
                                  : by_collision(at, other_at, threshold);
    }

  private:
    double by_distance(const Pose &at, const Pose &other_at, double threshold) {
        const double bound = question_.mode == PEER_WITHIN
                                 ? std::nextafter(threshold, std::numeric_limits<double>::max())
                                 : std::numeric_limits<double>::max();
        coal::DistanceResult result(bound);
        if (way_.keeps_pair) {
            (*measurer_)(at, other_at, distance_request_, result);
        } else {
            coal::distance(first_.get(), at, second_.get(), other_at, distance_request_, result);
        }
        distance_request_.updateGuess(result);
        return peers::answer_of_distance(question_.mode, result.min_distance, threshold);
    }

    double by_collision(const Pose &at, const Pose &other_at, double threshold) {
        collision_request_.security_margin = question_.mode == PEER_WITHIN ? threshold : 0;
        // Its vector of contacts stays allocated.
        collision_result_.clear();
        if (way_.keeps_pair) {
            (*collider_)(at, other_at, collision_request_, collision_result_);
        } else {
            coal::collide(first_.get(), at, second_.get(), other_at, collision_request_,
                          collision_result_);
        }
        collision_request_.updateGuess(collision_result_);
        return static_cast<double>(collision_result_.numContacts());
    }

    peers::Question question_;
    Way way_;
    Coal::Geometry first_, second_;
    std::optional<coal::ComputeCollision> collider_;
    std::optional<coal::ComputeDistance> measurer_;
    coal::CollisionRequest collision_request_;
    coal::CollisionResult collision_result_;
    coal::DistanceRequest distance_request_;
};

const std::vector<Way> &ways() {
    static const std::vector<Way> list = [] {
        std::vector<Way> made;
        const std::pair<GJKVariant, const char *> gjks[] = {
            {GJKVariant::DefaultGJK, "GJK"},
            {GJKVariant::PolyakAcceleration, "Polyak"},
            {GJKVariant::NesterovAcceleration, "Nesterov"}};
        const std::pair<GJKInitialGuess, const char *> guesses[] = {
            {GJKInitialGuess::DefaultGuess, ""},
            {GJKInitialGuess::CachedGuess, " cached"},
            {GJKInitialGuess::BoundingVolumeGuess, " volumes' guess"}};
        for (const auto &[volume, volume_name] : peers::volumes) {
            for (const bool asks_distance : {false, true}) {
                for (const bool keeps_pair : {false, true}) {
                    for (const auto &[gjk, gjk_name] : gjks) {
                        for (const auto &[guess, guess_name] : guesses) {
                            made.push_back(
                                {volume, asks_distance, keeps_pair, gjk, guess,
                                 std::string(volume_name) + gjk_name + guess_name +
                                     (asks_distance ? " distance" : " collide") +
                                     (keeps_pair ? " kept" : "")});
                        }
                    }
                }
            }
        }
        return made;
    }();
    return list;
}

// With meshes and voxels Coal keeps no more for a pair than its function looks up, and guesses from
// volumes are for single shapes; with voxels, which take long, boxes are nearly all that is tested.
bool repeats_another(const Way &way, bool has_cloud) {
    const bool is_plain =
        way.gjk == GJKVariant::DefaultGJK && way.guess == GJKInitialGuess::DefaultGuess;
    return !way.keeps_pair || way.guess == GJKInitialGuess::BoundingVolumeGuess ||
           (has_cloud && !is_plain);
}

// What its volumes can do: no distances of boxes; with a margin RSS and kIOS miss pairs; two meshes
// take several times as long to collide by RSS as by the others.
bool volume_serves(const Way &way, int mode, bool are_meshes) {
    const bool is_rounded = way.volume == peers::rss || way.volume == peers::kios;
    if (way.asks_distance) {
        return way.volume != peers::obb;
    }
    return !(mode == PEER_WITHIN && is_rounded) && !(are_meshes && way.volume == peers::rss);
}

peers::AnyPair *build(const peer_shape &first, const peer_shape &second, peers::Question question,
                      const Way &way) {
    const bool has_cloud = peers::has_kind(first, second, PEER_CLOUD);
    const bool is_simple = way.volume == peers::none && !has_cloud;
    const bool are_meshes = first.kind == PEER_MESH && second.kind == PEER_MESH;
    if ((!is_simple && repeats_another(way, has_cloud)) || !volume_serves(way, question.mode, are_meshes) ||
        !peers::fits(first, second, question.mode, way.volume != peers::none, way.asks_distance)) {
        return nullptr;
    }
    return new peers::PosedPair<Asked>(first, second, question, way);
}

} // namespace

PEER_SHAPE_INTERFACE(coal, ways, build)
