/* Part of cstk/fcl.hpp: planes and half-spaces against everything, by support points. */
#ifndef CSTK_FCL_FLAT_PAIRS_HPP
#define CSTK_FCL_FLAT_PAIRS_HPP

#include <cstk/fcl/planes.hpp>

#include <algorithm>
#include <cmath>

namespace cstk_fcl {
namespace detail {

/// Two primitives: how far apart they are, or minus how deeply they overlap, and where.
struct PrimitivePair {
    std::intptr_t b1 = NONE;
    std::intptr_t b2 = NONE;
    /// Negative: minus the depth.
    double gap = 0;
    /// From the first to the second; zero where it is not known.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d p1 = Eigen::Vector3d::Zero();
    Eigen::Vector3d p2 = Eigen::Vector3d::Zero();

    /// The same pair seen from the other side.
    PrimitivePair swapped() const { return {b2, b1, gap, -normal, p2, p1}; }
};

/// A plane or half-space in the world, in double precision.
struct WorldFlat {
    Eigen::Vector3d n;
    double d;
    bool half;

    template <typename S> WorldFlat(const CollisionGeometry<S> *geometry, const Eigen::Isometry3d &tf) {
        const Flat<S> *flat = static_cast<const Flat<S> *>(geometry);
        /* Both are public members. */
        const Eigen::Vector3d normal = flat->n.template cast<double>();
        const double length = normal.norm(), offset = static_cast<double>(flat->d) / length;
        if (!std::isfinite(length) || !std::isfinite(offset)) {
            throw std::invalid_argument("cstk_fcl: a plane or half-space has a normal of length 0, or a normal or offset that is not "
                                        "finite");
        }
        n = tf.linear() * normal / length;
        d = offset + n.dot(tf.translation());
        half = geometry->getNodeType() == GEOM_HALFSPACE;
    }
};

/// A primitive of a bounded geometry and a flat. A plane is met where the primitive has points on both sides or on it; the
/// depth is then that of the shorter way out. Exact to rounding.
template <typename S>
PrimitivePair flat_pair(const CollisionGeometry<S> *geometry, const Eigen::Isometry3d &tf, std::size_t primitive,
                        const WorldFlat &flat) {
    const Eigen::Vector3d along = tf.linear().transpose() * flat.n;
    const Eigen::Vector3d lowest = tf * geometry->support_point(-along, primitive);
    const double below = flat.n.dot(lowest) - flat.d;
    PrimitivePair pair;
    pair.b1 = geometry->getObjectType() == OT_GEOM ? NONE : static_cast<std::intptr_t>(primitive);
    pair.gap = below;
    pair.normal = -flat.n;
    pair.p1 = lowest;
    if (!flat.half) {
        const Eigen::Vector3d highest = tf * geometry->support_point(along, primitive);
        const double above = flat.d - flat.n.dot(highest);
        if (above > below) {
            pair.gap = above;
            pair.normal = flat.n;
            pair.p1 = highest;
        }
    }
    /* What rounding may have moved apart touches. */
    const double rounding = 32 * std::numeric_limits<double>::epsilon() *
                            (std::abs(flat.d) + pair.p1.norm() + tf.translation().norm());
    pair.gap = std::abs(pair.gap) <= rounding ? 0 : pair.gap;
    pair.p2 = pair.p1 + pair.gap * pair.normal;
    return pair;
}

/// Two flats. Those that are not parallel meet, however far away; normals this close to parallel are taken as parallel.
inline PrimitivePair two_flats(const WorldFlat &a, const WorldFlat &b) {
    constexpr double PARALLEL = 1e-12;
    PrimitivePair pair;
    pair.p1 = pair.p2 = a.n * a.d;
    const double side = a.n.dot(b.n) > 0 ? 1 : -1;
    if (a.n.cross(b.n).norm() > PARALLEL) {
        /* Where both boundaries meet. */
        const Eigen::Vector3d line = a.n.cross(b.n);
        pair.p1 = pair.p2 = (a.d * b.n.cross(line) + b.d * line.cross(a.n)) / line.squaredNorm();
        pair.gap = -std::numeric_limits<double>::infinity();
        return pair;
    }
    /* Along a.n, half-spaces reach from minus infinity or to infinity, planes are points. */
    const double b_at = side * b.d;
    const bool facing = a.half && b.half && side < 0;
    pair.p2 = a.n * b_at;
    if (!a.half && !b.half) {
        pair.gap = std::abs(b_at - a.d);
        pair.normal = b_at >= a.d ? a.n : Eigen::Vector3d(-a.n);
    } else if (facing || (a.half && !b.half)) {
        pair.gap = b_at - a.d;
        pair.normal = a.n;
    } else if (!a.half) {
        pair.gap = side > 0 ? a.d - b_at : b_at - a.d;
        pair.normal = side > 0 ? Eigen::Vector3d(-a.n) : a.n;
    } else {
        pair.gap = -std::numeric_limits<double>::infinity();
    }
    return pair;
}

/// All primitives of a bounded geometry with a flat, each handed to `offer`. Its body is built first, which checks it as any other pair does.
template <typename S, typename Offer>
void offer_beside(const CollisionGeometry<S> *bounded, const Eigen::Isometry3d &tf, const WorldFlat &flat, const Offer &offer) {
    bounded->body();
    for (std::size_t i = 0; i < bounded->primitive_count(); ++i) {
        offer(flat_pair(bounded, tf, i, flat));
    }
}

/// All pairs of primitives of which at least one is a flat, at most `margin` apart, or the nearest alone. Neither is empty.
template <typename S>
std::vector<PrimitivePair> flat_pairs(const CollisionGeometry<S> *o1, const Eigen::Isometry3d &tf1, const CollisionGeometry<S> *o2,
                                      const Eigen::Isometry3d &tf2, double margin, bool nearest) {
    const bool flat1 = is_unbounded(o1->getNodeType()), flat2 = is_unbounded(o2->getNodeType());
    std::vector<PrimitivePair> found;
    const auto offer = [&](const PrimitivePair &pair) {
        if (!nearest && pair.gap <= margin) {
            found.push_back(pair);
        } else if (nearest && (found.empty() || pair.gap < found[0].gap)) {
            found.assign(1, pair);
        }
    };
    if (flat1 && flat2) {
        offer(two_flats(WorldFlat(o1, tf1), WorldFlat(o2, tf2)));
    } else if (flat2) {
        offer_beside(o1, tf1, WorldFlat(o2, tf2), offer);
    } else {
        offer_beside(o2, tf2, WorldFlat(o1, tf1), [&](const PrimitivePair &pair) { offer(pair.swapped()); });
    }
    return found;
}

} // namespace detail
} // namespace cstk_fcl

#endif
