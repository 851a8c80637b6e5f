/* Part of cstk/fcl.hpp: collide and distance of two geometries at transforms, and of two objects. */
#ifndef CSTK_FCL_QUERIES_HPP
#define CSTK_FCL_QUERIES_HPP

#include <cstk/fcl/collision_object.hpp>
#include <cstk/fcl/primitive_pairs.hpp>
#include <cstk/fcl/requests.hpp>

namespace cstk_fcl {

namespace detail {

/// The box around a primitive in the world, or around the whole geometry.
template <typename S> AABB<S> world_box(const CollisionGeometry<S> *geometry, const Transform3<S> &tf, std::intptr_t primitive) {
    const Eigen::Isometry3d at = checked(tf);
    AABB<S> box;
    const std::size_t first = primitive == NONE ? 0 : static_cast<std::size_t>(primitive);
    const std::size_t end = primitive == NONE ? geometry->primitive_count() : first + 1;
    for (std::size_t i = first; i < end; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                const Eigen::Vector3d along = at.linear().row(axis).transpose() * sign;
                box += Vector3<S>((at * geometry->support_point(along, i)).template cast<S>());
            }
        }
    }
    return box;
}

/// The box in which two primitives meet, with the product of both densities.
template <typename S>
void add_cost(const Placed<S> &pair, std::intptr_t b1, std::intptr_t b2, std::size_t max_count, CollisionResult<S> &result) {
    AABB<S> common;
    if (!pair.has_flat() && world_box(pair.o1, pair.tf1, b1).overlap(world_box(pair.o2, pair.tf2, b2), common)) {
        result.addCostSource(CostSource<S>(common, pair.o1->cost_density * pair.o2->cost_density), max_count);
    }
}

template <typename S> Contact<S> contact_of(const Placed<S> &pair, const PrimitivePair &found, bool whole) {
    Contact<S> contact(pair.o1, pair.o2, found.b1, found.b2);
    if (whole) {
        contact.normal = found.normal.template cast<S>();
        contact.penetration_depth = static_cast<S>(-found.gap);
        contact.pos = ((found.p1 + found.p2) / 2).template cast<S>();
        contact.nearest_points[0] = found.p1.template cast<S>();
        contact.nearest_points[1] = found.p2.template cast<S>();
    }
    return contact;
}

/// The distance that is not looked beyond, as the library takes it.
template <typename S> double as_limit(S distance) {
    return distance >= std::numeric_limits<S>::max() ? std::numeric_limits<double>::infinity() : static_cast<double>(distance);
}

template <typename S> void set_lower_bound(const Placed<S> &pair, const CollisionRequest<S> &request, CollisionResult<S> &result) {
    const double margin = static_cast<double>(request.security_margin);
    if (pair.has_empty()) {
        result.distance_lower_bound = request.distance_upper_bound;
        return;
    }
    if (pair.has_flat()) {
        const double gap = flat_pairs(pair.o1, checked(pair.tf1), pair.o2, checked(pair.tf2), 0, true)[0].gap;
        result.distance_lower_bound = rounded_down<S>(std::max(gap - margin, 0.0));
        return;
    }
    const double limit = as_limit(request.distance_upper_bound);
    const cstk_distance_result found = query().pair_distance(pair.o1->body(), pose(pair.tf1), pair.o2->body(),
                                                             pose(pair.tf2), std::max(limit, 0.0));
    result.distance_lower_bound = rounded_down<S>(std::max(found.lower - margin, 0.0));
}

} // namespace detail

/// Whether two geometries meet, and where: as many contacts as the request asks for are in the result then, one for each pair of
/// primitives, deepest first. Returns how many the result holds, with those it held before.
template <typename S>
std::size_t collide(const CollisionGeometry<S> *o1, const Transform3<S> &tf1, const CollisionGeometry<S> *o2,
                    const Transform3<S> &tf2, const CollisionRequest<S> &request, CollisionResult<S> &result) {
    const detail::Placed<S> pair{o1, tf1, o2, tf2};
    const double margin = static_cast<double>(request.security_margin);
    if (!(margin >= 0)) {
        throw std::invalid_argument("cstk_fcl: security_margin is negative, or no number: ask for contacts and compare their depths");
    }
    if (request.num_max_contacts == 0 || request.isSatisfied(result) || o1->isFree() || o2->isFree()) {
        return result.numContacts();
    }
    if (request.enable_distance_lower_bound) {
        detail::set_lower_bound(pair, request, result);
    }
    if (pair.has_empty()) {
        return result.numContacts();
    }
    const bool occupied = o1->isOccupied() && o2->isOccupied();
    const std::size_t room = request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
    if (!request.enable_contact && !request.enable_cost && room <= 1) {
        if (occupied && room == 1 && detail::within(pair, margin)) {
            result.addContact(Contact<S>(o1, o2, Contact<S>::NONE, Contact<S>::NONE));
        }
        return result.numContacts();
    }
    const std::size_t wanted = request.enable_cost ? std::max(room, request.num_max_cost_sources) : room;
    const std::vector<detail::PrimitivePair> found = detail::near_pairs(pair, margin, wanted);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (occupied && i < room) {
            result.addContact(detail::contact_of(pair, found[i], request.enable_contact));
        }
        if (request.enable_cost) {
            detail::add_cost(pair, found[i].b1, found[i].b2, request.num_max_cost_sources, result);
        }
    }
    return result.numContacts();
}

template <typename S>
std::size_t collide(const CollisionObject<S> *o1, const CollisionObject<S> *o2, const CollisionRequest<S> &request,
                    CollisionResult<S> &result) {
    return collide(o1->collisionGeometry().get(), o1->getTransform(), o2->collisionGeometry().get(), o2->getTransform(), request,
                   result);
}

/// The distance of two geometries, with the nearest points; below 0 where they meet (see DistanceRequest). The result keeps the
/// least of what it was given: returns that.
template <typename S>
S distance(const CollisionGeometry<S> *o1, const Transform3<S> &tf1, const CollisionGeometry<S> *o2, const Transform3<S> &tf2,
           const DistanceRequest<S> &request, DistanceResult<S> &result) {
    const detail::Placed<S> pair{o1, tf1, o2, tf2};
    detail::PrimitivePair nearest;
    if (pair.has_empty()) {
        return result.min_distance;
    }
    if (pair.has_flat()) {
        nearest = detail::flat_pairs(o1, detail::checked(tf1), o2, detail::checked(tf2), 0, true)[0];
    } else {
        const double limit = std::max(detail::as_limit(result.min_distance), 0.0);
        const cstk_distance_result found =
            detail::query().pair_distance(o1->body(), detail::pose(tf1), o2->body(), detail::pose(tf2), limit);
        if (found.kind != CSTK_DISTANCE_EXACT) {
            return result.min_distance;
        }
        nearest = {pair.name1(found.witness.r_tag), pair.name2(found.witness.s_tag), found.distance, Eigen::Vector3d::Zero(),
                   detail::point_of(found.r_point), detail::point_of(found.s_point)};
    }
    if (nearest.gap <= 0 && !request.enable_signed_distance) {
        nearest.gap = -1;
    } else if (nearest.gap <= 0 && !pair.has_flat()) {
        nearest = detail::near_pairs(pair, 0, 1)[0];
        if (nearest.normal.isZero()) {
            /* A piece inside a solid: the way out is not known. */
            nearest.gap = -1;
        }
    }
    result.update(static_cast<S>(nearest.gap), o1, o2, nearest.b1, nearest.b2, Vector3<S>(nearest.p1.template cast<S>()),
                  Vector3<S>(nearest.p2.template cast<S>()));
    return result.min_distance;
}

template <typename S>
S distance(const CollisionObject<S> *o1, const CollisionObject<S> *o2, const DistanceRequest<S> &request,
           DistanceResult<S> &result) {
    return distance(o1->collisionGeometry().get(), o1->getTransform(), o2->collisionGeometry().get(), o2->getTransform(), request,
                    result);
}

} // namespace cstk_fcl

#endif
