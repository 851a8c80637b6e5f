/* Part of cstk/fcl.hpp: which primitives of two geometries meet, how deeply, and where. */
#ifndef CSTK_FCL_PRIMITIVE_PAIRS_HPP
#define CSTK_FCL_PRIMITIVE_PAIRS_HPP

#include <cstk/fcl/flat_pairs.hpp>
#include <cstk/fcl/penetration.hpp>

namespace cstk_fcl {
namespace detail {

/// Two geometries at transforms.
template <typename S> struct Placed {
    const CollisionGeometry<S> *o1;
    const Transform3<S> &tf1;
    const CollisionGeometry<S> *o2;
    const Transform3<S> &tf2;

    bool has_flat() const { return is_unbounded(o1->getNodeType()) || is_unbounded(o2->getNodeType()); }
    bool has_empty() const { return o1->is_empty() || o2->is_empty(); }
    bool is_polyhedral() const { return o1->is_polyhedral() && o2->is_polyhedral(); }

    /// What answers call a primitive of either.
    std::intptr_t name1(std::uint64_t tag) const { return name(o1, tag); }
    std::intptr_t name2(std::uint64_t tag) const { return name(o2, tag); }

private:
    static std::intptr_t name(const CollisionGeometry<S> *geometry, std::uint64_t tag) {
        return geometry->getObjectType() == OT_GEOM ? NONE : static_cast<std::intptr_t>(tag);
    }
};

/// Whether the two are at most `margin` apart. Doubt within rounding counts as meeting.
template <typename S> bool within(const Placed<S> &pair, double margin) {
    if (pair.has_flat()) {
        return !flat_pairs(pair.o1, checked(pair.tf1), pair.o2, checked(pair.tf2), margin, false).empty();
    }
    return query().pair_within(pair.o1->body(), pose(pair.tf1), pair.o2->body(), pose(pair.tf2), margin);
}

/// The depth of two primitives that meet, by support points, seen from the first transform's origin.
template <typename S>
PrimitivePair overlap(const Placed<S> &pair, std::uint64_t primitive1, std::uint64_t primitive2) {
    const Eigen::Isometry3d tf1 = checked(pair.tf1), tf2 = checked(pair.tf2);
    const Eigen::Vector3d between = tf2.translation() - tf1.translation();
    const auto support1 = [&](const Eigen::Vector3d &direction) -> Eigen::Vector3d {
        return tf1.linear() * pair.o1->support_point(tf1.linear().transpose() * direction, primitive1);
    };
    const auto support2 = [&](const Eigen::Vector3d &direction) -> Eigen::Vector3d {
        return tf2.linear() * pair.o2->support_point(tf2.linear().transpose() * direction, primitive2) + between;
    };
    const Depth found = penetration_depth(support1, support2);
    return {pair.name1(primitive1), pair.name2(primitive2), -found.depth, found.normal,
            tf1.translation() + found.point_a, tf1.translation() + found.point_b};
}

/// All pairs that meet, by cstk_pair_penetration: polyhedra, triangles, points and what is within a radius of them.
template <typename S> void add_penetrations(const Placed<S> &pair, std::size_t max_count, std::vector<PrimitivePair> &out) {
    const cstk_penetration_list list = query().pair_penetration(pair.o1->body(), pose(pair.tf1), pair.o2->body(),
                                                                pose(pair.tf2), max_count);
    for (std::size_t i = 0; i < list.count; ++i) {
        const cstk_penetration &found = list.penetrations[i];
        out.push_back({pair.name1(found.r_tag), pair.name2(found.s_tag), -found.depth, -point_of(found.direction),
                       point_of(found.r_point), point_of(found.s_point)});
    }
}

/// Pairs at most `margin` apart, by cstk_pair_witnesses. Those that overlap are taken for geometries without penetrations of the
/// library alone, and not for pieces inside a solid, whose way out is not known.
template <typename S>
void add_witnesses(const Placed<S> &pair, double margin, std::vector<PrimitivePair> &out) {
    constexpr std::size_t MAX_WITNESSES = 1 << 20;
    const bool listed = pair.is_polyhedral();
    const cstk_witness_list list = query().pair_witnesses(pair.o1->body(), pose(pair.tf1), pair.o2->body(),
                                                          pose(pair.tf2), margin, MAX_WITNESSES);
    for (std::size_t i = 0; i < list.witness_count; ++i) {
        const cstk_witness &witness = list.witnesses[i];
        const PrimitivePair named = {pair.name1(witness.r_tag), pair.name2(witness.s_tag)};
        if (witness.overlapping) {
            if (!listed && !witness.contained) {
                out.push_back(overlap(pair, witness.r_tag, witness.s_tag));
            }
        } else if (witness.contact_count > 0 && (witness.distance > 0 || !listed)) {
            const cstk_contact &contact = list.contacts[witness.first_contact];
            out.push_back(named);
            out.back().gap = contact.clearance;
            out.back().normal = -point_of(contact.normal);
            out.back().p1 = point_of(contact.r_point);
            out.back().p2 = point_of(contact.s_point);
        }
    }
}

/// Pairs of primitives at most `margin` apart, deepest first, at most `max_count`. Empty only if the two are proved to be
/// farther apart.
template <typename S> std::vector<PrimitivePair> near_pairs(const Placed<S> &pair, double margin, std::size_t max_count) {
    std::vector<PrimitivePair> found;
    if (pair.has_flat()) {
        found = flat_pairs(pair.o1, checked(pair.tf1), pair.o2, checked(pair.tf2), margin, false);
    } else if (within(pair, margin)) {
        if (pair.is_polyhedral()) {
            add_penetrations(pair, max_count, found);
        }
        if (!pair.is_polyhedral() || (margin > 0 && found.size() < max_count)) {
            add_witnesses(pair, margin, found);
        }
        if (found.empty()) {
            /* A piece inside a solid, or pairs within rounding of the margin. */
            const cstk_distance_result nearest = query().pair_distance(pair.o1->body(), pose(pair.tf1),
                                                                       pair.o2->body(), pose(pair.tf2));
            found.push_back({pair.name1(nearest.witness.r_tag), pair.name2(nearest.witness.s_tag), nearest.distance,
                             nearest.has_contact ? Eigen::Vector3d(-point_of(nearest.contact.normal)) : Eigen::Vector3d::Zero(),
                             point_of(nearest.r_point), point_of(nearest.s_point)});
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const PrimitivePair &a, const PrimitivePair &b) { return a.gap < b.gap; });
    if (found.size() > max_count) {
        found.resize(max_count);
    }
    return found;
}

} // namespace detail
} // namespace cstk_fcl

#endif
