/* Part of cstk/fcl.hpp: which call of libcstk proves a motion of two geometries. */
#ifndef CSTK_FCL_MOTION_PROOFS_HPP
#define CSTK_FCL_MOTION_PROOFS_HPP

#include <cstk/fcl/motions.hpp>
#include <cstk/fcl/primitive_pairs.hpp>

namespace cstk_fcl {
namespace detail {

template <typename S> struct Moving {
    const CollisionGeometry<S> *geometry;
    const MotionBase<S> *motion;

    bool rests() const { return motion->start().matrix() == motion->end().matrix(); }
    bool is_flat() const { return is_unbounded(geometry->getNodeType()); }
    bool turns() const { return motion->start().linear() != motion->end().linear(); }
};

/// A robot of one body: on a free joint, which goes on screws, or on three slides and a ball joint, whose origin goes straight.
inline cstk::Robot robot_of(const cstk::Body &body, bool straight) {
    cstk::RobotBuilder builder;
    cstk::Link link;
    link.body = body;
    if (!straight) {
        link.joint = CSTK_JOINT_FREE;
        builder.add_link(link);
        return builder.build();
    }
    cstk::Link slide;
    slide.joint = CSTK_JOINT_PRISMATIC;
    for (int axis = 0; axis < 3; ++axis) {
        slide.axis = {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
        slide.parent = axis - 1;
        builder.add_link(slide);
    }
    link.joint = CSTK_JOINT_SPHERICAL;
    link.parent = 2;
    builder.add_link(link);
    return builder.build();
}

/// The configuration of either robot at a transform: x, y, z, and a quaternion x, y, z, w.
template <typename S> void append_configuration(const Transform3<S> &tf, std::vector<double> &q) {
    const std::array<double, 7> numbers = cstk::pose_to_quaternion(pose(tf));
    q.insert(q.end(), numbers.begin(), numbers.end());
}

/// Two bounded geometries, each with its origin going straight.
template <typename S>
cstk_motion_result prove_straight(const Moving<S> &a, const Moving<S> &b, const cstk_motion_options &options) {
    const cstk::Space space({robot_of(a.geometry->body(), true), robot_of(b.geometry->body(), true)});
    const std::uint32_t last = static_cast<std::uint32_t>(space.link_count()) - 1;
    const std::vector<std::array<std::uint32_t, 2>> pairs = {{last / 2, last}};
    const cstk::CObject meeting = cstk::CObject::induced_links(space, pairs);
    std::vector<double> start, end;
    for (const Moving<S> *moving : {&a, &b}) {
        append_configuration(moving->motion->start(), start);
        append_configuration(moving->motion->end(), end);
    }
    return query().motion(meeting, start, end, options);
}

/// A bounded geometry that moves, and a plane or half-space at rest. A plane is where two half-spaces meet that face each other.
template <typename S>
cstk_motion_result prove_beside_flat(const Moving<S> &moving, const Moving<S> &flat, const cstk_motion_options &options) {
    const bool straight = moving.motion->kind() != MotionKind::SCREW;
    const cstk::Space space(robot_of(moving.geometry->body(), straight));
    const WorldFlat world(flat.geometry, in_double(flat.motion->start()));
    cstk::CObject meeting = cstk::CObject::below_floor(space, {world.n[0], world.n[1], world.n[2]}, world.d);
    if (!world.half) {
        const cstk::CObject above = cstk::CObject::below_floor(space, {-world.n[0], -world.n[1], -world.n[2]}, -world.d);
        meeting = cstk::CObject::intersection_of({meeting, above});
    }
    std::vector<double> start, end;
    append_configuration(moving.motion->start(), start);
    append_configuration(moving.motion->end(), end);
    return query().motion(meeting, start, end, options);
}

/// Proves that two geometries do not meet on their motions, or finds when they first do.
template <typename S>
cstk_motion_result prove(const Moving<S> &a, const Moving<S> &b, const cstk_motion_options &options) {
    if (a.is_flat() || b.is_flat()) {
        const Moving<S> &flat = a.is_flat() ? a : b;
        const Moving<S> &moving = a.is_flat() ? b : a;
        if (!flat.rests() || moving.is_flat()) {
            throw std::invalid_argument("cstk_fcl: a plane or half-space must rest while the other geometry, which is bounded, "
                                        "moves: move that one relative to it, or make it a large Box");
        }
        return prove_beside_flat(moving, flat, options);
    }
    const bool screws = a.motion->kind() == MotionKind::SCREW || b.motion->kind() == MotionKind::SCREW;
    const bool turning = a.turns() || b.turns();
    if (!screws && turning) {
        return prove_straight(a, b, options);
    }
    for (const Moving<S> *moving : {&a, &b}) {
        if (moving->motion->kind() == MotionKind::LINEAR && moving->turns()) {
            throw std::invalid_argument("cstk_fcl: one geometry is on a ScrewMotion, the other on an InterpMotion that turns: use "
                                        "one of the two for both");
        }
    }
    return query().pair_motion(a.geometry->body(), pose(a.motion->start()), pose(a.motion->end()), b.geometry->body(),
                               pose(b.motion->start()), pose(b.motion->end()), options);
}

} // namespace detail
} // namespace cstk_fcl

#endif
