/* Part of cstk/fcl.hpp: what is asked of collide and distance, and what they answer. */
#ifndef CSTK_FCL_REQUESTS_HPP
#define CSTK_FCL_REQUESTS_HPP

#include <cstk/fcl/geometry.hpp>

#include <set>

namespace cstk_fcl {

/// Where two sets meet, or are within the security margin.
template <typename S> struct Contact {
    const CollisionGeometry<S> *o1 = nullptr;
    const CollisionGeometry<S> *o2 = nullptr;
    /// Triangle or point of a model, NONE of a shape. In the order of the arguments, also for a shape and a model.
    std::intptr_t b1 = NONE;
    std::intptr_t b2 = NONE;
    /// Of length 1, in the world, from o1 to o2: moving o2 along it by penetration_depth separates the two primitives. Zero
    /// where it is not known (without enable_contact, or for a piece inside a solid).
    Vector3<S> normal = Vector3<S>::Zero();
    /// The middle of the nearest points, in the world.
    Vector3<S> pos = Vector3<S>::Zero();
    /// Of the two primitives; negative, minus the distance, within a security margin. With cylinders, cones and ellipsoids
    /// never less than the true depth, and at most 1e-6 of their size more.
    S penetration_depth = 0;
    /// Of Coal: a point of each primitive, which the translation brings together.
    Vector3<S> nearest_points[2] = {Vector3<S>::Zero(), Vector3<S>::Zero()};

    static constexpr int NONE = detail::NONE;

    Contact() = default;
    Contact(const CollisionGeometry<S> *o1_, const CollisionGeometry<S> *o2_, std::intptr_t b1_, std::intptr_t b2_)
        : o1(o1_), o2(o2_), b1(b1_), b2(b2_) {}
    Contact(const CollisionGeometry<S> *o1_, const CollisionGeometry<S> *o2_, std::intptr_t b1_, std::intptr_t b2_,
            const Vector3<S> &pos_, const Vector3<S> &normal_, S depth_)
        : o1(o1_), o2(o2_), b1(b1_), b2(b2_), normal(normal_), pos(pos_), penetration_depth(depth_),
          nearest_points{pos_, pos_} {}

    bool operator<(const Contact &other) const { return b1 == other.b1 ? b2 < other.b2 : b1 < other.b1; }
};

using Contactf = Contact<float>;
using Contactd = Contact<double>;

/// A box in which two primitives meet, with a cost.
template <typename S> struct CostSource {
    Vector3<S> aabb_min = Vector3<S>::Zero();
    Vector3<S> aabb_max = Vector3<S>::Zero();
    S cost_density = 0;
    S total_cost = 0;

    CostSource() = default;
    CostSource(const Vector3<S> &low, const Vector3<S> &high, S density)
        : aabb_min(low), aabb_max(high), cost_density(density), total_cost(density * (high - low).prod()) {}
    CostSource(const AABB<S> &box, S density) : CostSource(box.min_, box.max_, density) {}

    /// Dearest first.
    bool operator<(const CostSource &other) const {
        if (total_cost != other.total_cost) {
            return total_cost > other.total_cost;
        }
        if (cost_density != other.cost_density) {
            return cost_density > other.cost_density;
        }
        for (int i = 0; i < 3; ++i) {
            if (aabb_min[i] != other.aabb_min[i]) {
                return aabb_min[i] < other.aabb_min[i];
            }
        }
        return false;
    }
};

using CostSourcef = CostSource<float>;
using CostSourced = CostSource<double>;

template <typename S> struct CollisionResult;

template <typename S> struct CollisionRequest {
    std::size_t num_max_contacts;
    /// Without it, and for one contact, only whether the two meet is found out, which is several times faster.
    bool enable_contact;
    std::size_t num_max_cost_sources;
    bool enable_cost;
    bool use_approximate_cost;
    /// Ignored, as the three below: searches begin where the last one of the pair ended, and tolerances are the library's.
    GJKSolverType gjk_solver_type;
    bool enable_cached_gjk_guess = false;
    Vector3<S> cached_gjk_guess = Vector3<S>::UnitX();
    S gjk_tolerance;
    /// Of Coal: what is at most this far apart collides. A length, at least 0.
    S security_margin = 0;
    /// Of Coal: distance_lower_bound of the result is worked out, but not beyond distance_upper_bound.
    bool enable_distance_lower_bound = false;
    S distance_upper_bound = std::numeric_limits<S>::max();

    CollisionRequest(std::size_t num_max_contacts_ = 1, bool enable_contact_ = false,
                     std::size_t num_max_cost_sources_ = 1, bool enable_cost_ = false,
                     bool use_approximate_cost_ = true, GJKSolverType gjk_solver_type_ = GST_LIBCCD,
                     S gjk_tolerance_ = static_cast<S>(1e-6))
        : num_max_contacts(num_max_contacts_), enable_contact(enable_contact_), num_max_cost_sources(num_max_cost_sources_),
          enable_cost(enable_cost_), use_approximate_cost(use_approximate_cost_), gjk_solver_type(gjk_solver_type_),
          gjk_tolerance(gjk_tolerance_) {}

    bool isSatisfied(const CollisionResult<S> &result) const {
        return !enable_cost && result.isCollision() && num_max_contacts <= result.numContacts();
    }
};

using CollisionRequestf = CollisionRequest<float>;
using CollisionRequestd = CollisionRequest<double>;

/// Contacts and costs are added to what a result holds: clear() it between pairs that have nothing to do with each other.
template <typename S> struct CollisionResult {
    Vector3<S> cached_gjk_guess = Vector3<S>::UnitX();
    /// Of Coal: the two are no nearer than this, beyond the security margin. Set with enable_distance_lower_bound, for the last
    /// pair.
    S distance_lower_bound = 0;

    void addContact(const Contact<S> &contact) { contacts_.push_back(contact); }

    void addCostSource(const CostSource<S> &source, std::size_t num_max_cost_sources) {
        cost_sources_.insert(source);
        while (cost_sources_.size() > num_max_cost_sources) {
            cost_sources_.erase(std::prev(cost_sources_.end()));
        }
    }

    bool isCollision() const { return !contacts_.empty(); }
    std::size_t numContacts() const { return contacts_.size(); }
    std::size_t numCostSources() const { return cost_sources_.size(); }

    /// The last contact for a number too large, as in FCL; std::out_of_range if there is none.
    const Contact<S> &getContact(std::size_t i) const {
        return contacts_.at(std::min(i, std::max<std::size_t>(contacts_.size(), 1) - 1));
    }
    void getContacts(std::vector<Contact<S>> &contacts) const { contacts = contacts_; }
    void getCostSources(std::vector<CostSource<S>> &sources) const { sources.assign(cost_sources_.begin(), cost_sources_.end()); }

    void clear() { *this = CollisionResult(); }

private:
    std::vector<Contact<S>> contacts_;
    std::set<CostSource<S>> cost_sources_;
};

using CollisionResultf = CollisionResult<float>;
using CollisionResultd = CollisionResult<double>;

template <typename S> struct DistanceResult;

template <typename S> struct DistanceRequest {
    bool enable_nearest_points;
    /// Minus the penetration depth for sets that meet: of the two where both are convex, else of the primitive pair that meets most
    /// deeply. Without it -1.
    bool enable_signed_distance;
    /// Ignored, as the two below: distances are exact to 1e-12 of the pair's size.
    S rel_err;
    S abs_err;
    S distance_tolerance;
    GJKSolverType gjk_solver_type;

    explicit DistanceRequest(bool enable_nearest_points_ = false, bool enable_signed_distance_ = false, S rel_err_ = 0,
                             S abs_err_ = 0, S distance_tolerance_ = static_cast<S>(1e-6),
                             GJKSolverType gjk_solver_type_ = GST_LIBCCD)
        : enable_nearest_points(enable_nearest_points_), enable_signed_distance(enable_signed_distance_), rel_err(rel_err_),
          abs_err(abs_err_), distance_tolerance(distance_tolerance_), gjk_solver_type(gjk_solver_type_) {}

    bool isSatisfied(const DistanceResult<S> &result) const { return result.min_distance <= 0; }
};

using DistanceRequestf = DistanceRequest<float>;
using DistanceRequestd = DistanceRequest<double>;

/// The least of the distances asked with it. A smaller min_distance set beforehand is a threshold: what is farther leaves it as
/// it is.
template <typename S> struct DistanceResult {
    S min_distance;
    /// Always set where min_distance is, in the world, first of o1. Where the two meet: one common point, or with signed
    /// distances those that the shortest translation brings together.
    Vector3<S> nearest_points[2] = {Vector3<S>::Zero(), Vector3<S>::Zero()};
    const CollisionGeometry<S> *o1 = nullptr;
    const CollisionGeometry<S> *o2 = nullptr;
    /// Triangle or point of a model, NONE of a shape.
    std::intptr_t b1 = NONE;
    std::intptr_t b2 = NONE;

    static constexpr int NONE = detail::NONE;

    DistanceResult(S min_distance_ = std::numeric_limits<S>::max()) : min_distance(min_distance_) {}

    void update(S distance, const CollisionGeometry<S> *o1_, const CollisionGeometry<S> *o2_, std::intptr_t b1_,
                std::intptr_t b2_) {
        if (min_distance > distance) {
            min_distance = distance;
            o1 = o1_;
            o2 = o2_;
            b1 = b1_;
            b2 = b2_;
        }
    }

    void update(S distance, const CollisionGeometry<S> *o1_, const CollisionGeometry<S> *o2_, std::intptr_t b1_,
                std::intptr_t b2_, const Vector3<S> &p1, const Vector3<S> &p2) {
        if (min_distance > distance) {
            update(distance, o1_, o2_, b1_, b2_);
            nearest_points[0] = p1;
            nearest_points[1] = p2;
        }
    }

    void update(const DistanceResult &other) {
        if (min_distance > other.min_distance) {
            *this = other;
        }
    }

    void clear() { *this = DistanceResult(); }
};

using DistanceResultf = DistanceResult<float>;
using DistanceResultd = DistanceResult<double>;

} // namespace cstk_fcl

#endif
