// FCL's answers about two shapes: its functions with either of its solvers and, for collisions,
// with the last query's guess. Distances without a sign, so that no depth is computed where shapes
// meet; contacts off where only a yes or no is asked for.
#include "fcl_bodies.h"
#include "shape_pair.h"

#include <limits>
#include <string>

namespace {

struct Way {
    peers::Volume volume;
    bool asks_distance;
    fcl::GJKSolverType solver;
    bool keeps_guess;
    std::string name;
};

struct Fcl {
    using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;
    using Sphere = fcl::Sphere<double>;
    using Capsule = fcl::Capsule<double>;
    using Box = fcl::Box<double>;
    using Cylinder = fcl::Cylinder<double>;
    using Cone = fcl::Cone<double>;
    using Ellipsoid = fcl::Ellipsoid<double>;
    using OcTree = fcl::OcTree<double>;
    using OBB = fcl::OBB<double>;
    using RSS = fcl::RSS<double>;
    using OBBRSS = fcl::OBBRSS<double>;
    using kIOS = fcl::kIOS<double>;

    template <class BV> static Geometry mesh(const peer_mesh &surface) {
        return peers::model<BV>(&surface, 1);
    }

    static Geometry hull(const peer_mesh &surface) {
        peers::Soup<fcl::Vector3<double>, fcl::Triangle> soup(&surface, 1);
        auto faces = std::make_shared<std::vector<int>>();
        for (const fcl::Triangle &triangle : soup.triangles) {
            faces->push_back(3);
            for (int corner = 0; corner < 3; ++corner) {
                faces->push_back(static_cast<int>(triangle[corner]));
            }
        }
        return std::make_shared<fcl::Convex<double>>(
            std::make_shared<const std::vector<fcl::Vector3<double>>>(std::move(soup.vertices)),
            static_cast<int>(soup.triangles.size()), faces);
    }
};

class Asked {
  public:
    using Pose = fcl::Transform3<double>;
    static Pose pose(const double *numbers) { return peers::pose(numbers); }

    Asked(const peer_shape &first, const peer_shape &second, peers::Question question,
          const Way &way)
        : question_(question), way_(way), first_(peers::geometry<Fcl>(first, way.volume)),
          second_(peers::geometry<Fcl>(second, way.volume)) {
        const bool lists = question.mode == PEER_CONTACTS;
        collision_request_.num_max_contacts = lists ? question.most_contacts : 1;
        collision_request_.enable_contact = lists;
        collision_request_.gjk_solver_type = way.solver;
        distance_request_.gjk_solver_type = way.solver;
        forget();
    }

    void forget() {
        collision_request_.enable_cached_gjk_guess = way_.keeps_guess;
        collision_request_.cached_gjk_guess = fcl::Vector3<double>(1, 0, 0);
    }

    double answer(const Pose &at, const Pose &other_at, double threshold) {
        return way_.asks_distance ? by_distance(at, other_at, threshold) : by_collision(at, other_at);
    }

  private:
    double by_distance(const Pose &at, const Pose &other_at, double threshold) {
        const double most = std::numeric_limits<double>::max();
        // A traversal passes over what is farther than the least distance so far.
        const bool is_bounded = question_.mode == PEER_WITHIN;
        fcl::DistanceResult<double> result(is_bounded ? std::nextafter(threshold, most) : most);
        fcl::distance(first_.get(), at, second_.get(), other_at, distance_request_, result);
        return peers::answer_of_distance(question_.mode, result.min_distance, threshold);
    }

    double by_collision(const Pose &at, const Pose &other_at) {
        // Its vector of contacts stays allocated.
        collision_result_.clear();
        fcl::collide(first_.get(), at, second_.get(), other_at, collision_request_,
                     collision_result_);
        if (way_.keeps_guess) {
            collision_request_.cached_gjk_guess = collision_result_.cached_gjk_guess;
        }
        return static_cast<double>(collision_result_.numContacts());
    }

    peers::Question question_;
    Way way_;
    Fcl::Geometry first_, second_;
    fcl::CollisionRequest<double> collision_request_;
    fcl::CollisionResult<double> collision_result_;
    fcl::DistanceRequest<double> distance_request_;
};

const std::vector<Way> &ways() {
    static const std::vector<Way> list = [] {
        std::vector<Way> made;
        const std::pair<fcl::GJKSolverType, const char *> solvers[] = {
            {fcl::GST_LIBCCD, "libccd"}, {fcl::GST_INDEP, "indep"}};
        for (const auto &[volume, volume_name] : peers::volumes) {
            for (const auto &[solver, solver_name] : solvers) {
                const std::string name = std::string(volume_name) + solver_name;
                made.push_back({volume, true, solver, false, name + " distance"});
                made.push_back({volume, false, solver, false, name + " collide"});
                made.push_back({volume, false, solver, true, name + " cached collide"});
            }
        }
        return made;
    }();
    return list;
}

// What its volumes can do: no distances of boxes; for a collision by RSS one of two meshes is moved
// and its volumes fitted anew.
bool volume_serves(const Way &way, bool are_meshes) {
    if (way.asks_distance) {
        return way.volume != peers::obb;
    }
    return !(are_meshes && way.volume == peers::rss);
}

peers::AnyPair *build(const peer_shape &first, const peer_shape &second, peers::Question question,
                      const Way &way) {
    const bool are_meshes = first.kind == PEER_MESH && second.kind == PEER_MESH;
    // It has no collisions with a margin.
    const bool lacks_margin = question.mode == PEER_WITHIN && !way.asks_distance;
    if (lacks_margin || !volume_serves(way, are_meshes) ||
        !peers::fits(first, second, question.mode, way.volume != peers::none, way.asks_distance)) {
        return nullptr;
    }
    return new peers::PosedPair<Asked>(first, second, question, way);
}

} // namespace

PEER_SHAPE_INTERFACE(fcl, ways, build)
