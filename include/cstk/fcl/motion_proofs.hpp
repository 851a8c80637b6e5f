/* Part of cstk/fcl.hpp: which call of libcstk proves a motion of two geometries. */
#ifndef CSTK_FCL_MOTION_PROOFS_HPP
#define CSTK_FCL_MOTION_PROOFS_HPP

#include <cstk/fcl/motions.hpp>
#include <cstk/fcl/primitive_pairs.hpp>

namespace cstk_fcl {
namespace detail {

/// A motion, or a half of one.
template <typename S> struct Course {
    Transform3<S> start, end;
    MotionKind kind;

    bool rests() const { return start.matrix() == end.matrix(); }
    bool turns() const { return start.linear() != end.linear(); }

    /// About half a turn: which of the two ways round is meant, rounding decides.
    bool is_half_turn() const {
        constexpr double NEARLY = 3.1;
        const Matrix3<S> whole = end.linear() * start.linear().transpose();
        return kind != MotionKind::TRANSLATION && std::abs(AngleAxis<S>(whole).angle()) > NEARLY;
    }
};

template <typename S> struct Moving {
    const CollisionGeometry<S> *geometry;
    Course<S> course;

    bool is_flat() const { return is_unbounded(geometry->getNodeType()); }
};

/// A body on its way.
template <typename S> struct MovingBody {
    const cstk::Body &body;
    const Course<S> &course;
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

/// Two bodies, each with its origin going straight.
template <typename S>
cstk_motion_result prove_straight(const MovingBody<S> &a, const MovingBody<S> &b, const cstk_motion_options &options) {
    const cstk::Space space({robot_of(a.body, true), robot_of(b.body, true)});
    const std::uint32_t last = static_cast<std::uint32_t>(space.link_count()) - 1;
    const std::vector<std::array<std::uint32_t, 2>> pairs = {{last / 2, last}};
    const cstk::CObject meeting = cstk::CObject::induced_links(space, pairs);
    std::vector<double> start, end;
    for (const MovingBody<S> *moving : {&a, &b}) {
        append_configuration(moving->course.start, start);
        append_configuration(moving->course.end, end);
    }
    return query().motion(meeting, start, end, options);
}

/// Two bodies.
template <typename S>
cstk_motion_result prove_bodies(const MovingBody<S> &a, const MovingBody<S> &b, const cstk_motion_options &options) {
    const bool screws = a.course.kind == MotionKind::SCREW || b.course.kind == MotionKind::SCREW;
    const bool turning = a.course.turns() || b.course.turns();
    if (!screws && turning) {
        return prove_straight(a, b, options);
    }
    for (const MovingBody<S> *moving : {&a, &b}) {
        if (moving->course.kind == MotionKind::LINEAR && moving->course.turns()) {
            throw std::invalid_argument("cstk_fcl: one geometry is on a ScrewMotion, the other on an InterpMotion that turns: use "
                                        "one of the two for both");
        }
    }
    return query().pair_motion(a.body, pose(a.course.start), pose(a.course.end), b.body, pose(b.course.start), pose(b.course.end),
                               options);
}

/// A square of the plane that holds all of it that a geometry can reach: no motion here leads farther from its start than its end is.
template <typename S> cstk::Body square_of(const WorldFlat &plane, const Moving<S> &moving) {
    const Eigen::Isometry3d start = checked(moving.course.start), end = checked(moving.course.end);
    Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < moving.geometry->primitive_count(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                const Eigen::Vector3d point = moving.geometry->support_point(sign * Eigen::Vector3d::Unit(axis), i);
                farthest[axis] = std::max(farthest[axis], std::abs(point[axis]));
            }
        }
    }
    const Eigen::Vector3d middle = start.translation() - plane.n * (plane.n.dot(start.translation()) - plane.d);
    const double reach = 1.1 * (farthest.norm() + (end.translation() - start.translation()).norm());
    /* A small square far away would be rounded to none. */
    const double size = std::max(reach, 1e-3 * middle.norm());
    const double half = size > 0 ? size : 1;
    const Eigen::Vector3d along = half * plane.n.unitOrthogonal(), across = plane.n.cross(along);
    std::vector<double> corners;
    for (const Eigen::Vector3d &corner : {Eigen::Vector3d(middle + along + across), Eigen::Vector3d(middle - along + across),
                                          Eigen::Vector3d(middle - along - across), Eigen::Vector3d(middle + along - across)}) {
        corners.insert(corners.end(), corner.data(), corner.data() + 3);
    }
    return cstk::Body::polygon(corners);
}

/// A bounded geometry that moves, and a plane or half-space at rest. For one convex primitive a plane is where two half-spaces meet that
/// face each other; several may be on both sides of it, without any that meets it.
template <typename S>
cstk_motion_result prove_beside_flat(const Moving<S> &moving, const Moving<S> &flat, const cstk_motion_options &options) {
    const WorldFlat world(flat.geometry, checked(flat.course.start));
    const cstk::Body &body = moving.geometry->body();
    if (!world.half && moving.geometry->primitive_count() > 1) {
        const Course<S> rests = {Transform3<S>::Identity(), Transform3<S>::Identity(), MotionKind::TRANSLATION};
        const cstk::Body square = square_of(world, moving);
        return prove_bodies<S>({body, moving.course}, {square, rests}, options);
    }
    const bool straight = moving.course.kind != MotionKind::SCREW;
    const cstk::Space space(robot_of(body, straight));
    cstk::CObject meeting = cstk::CObject::below_floor(space, {world.n[0], world.n[1], world.n[2]}, world.d);
    if (!world.half) {
        const cstk::CObject above = cstk::CObject::below_floor(space, {-world.n[0], -world.n[1], -world.n[2]}, -world.d);
        meeting = cstk::CObject::intersection_of({meeting, above});
    }
    std::vector<double> start, end;
    append_configuration(moving.course.start, start);
    append_configuration(moving.course.end, end);
    return query().motion(meeting, start, end, options);
}

template <typename S>
cstk_motion_result prove_once(const Moving<S> &a, const Moving<S> &b, const cstk_motion_options &options) {
    if (a.is_flat() || b.is_flat()) {
        const Moving<S> &flat = a.is_flat() ? a : b;
        const Moving<S> &moving = a.is_flat() ? b : a;
        if (!flat.course.rests() || moving.is_flat()) {
            throw std::invalid_argument("cstk_fcl: a plane or half-space must rest while the other geometry, which is bounded, "
                                        "moves: move that one relative to it, or make it a large Box");
        }
        return prove_beside_flat(moving, flat, options);
    }
    return prove_bodies<S>({a.geometry->body(), a.course}, {b.geometry->body(), b.course}, options);
}

/// A geometry on a motion.
template <typename S> struct OnMotion {
    const CollisionGeometry<S> *geometry;
    const MotionBase<S> *motion;

    Moving<S> whole() const { return {geometry, {motion->start(), motion->end(), motion->kind()}}; }
    Transform3<S> middle() const { return whole().course.rests() ? motion->start() : motion->at(static_cast<S>(0.5)); }
    Moving<S> first_half(const Transform3<S> &middle) const { return {geometry, {motion->start(), middle, motion->kind()}}; }
    Moving<S> second_half(const Transform3<S> &middle) const { return {geometry, {middle, motion->end(), motion->kind()}}; }
};

/// Proves that two geometries do not meet on their motions, or finds when they first do. Half turns are proved in two halves, so that they
/// go the way round that the motions say.
template <typename S>
cstk_motion_result prove(const OnMotion<S> &a, const OnMotion<S> &b, cstk_motion_options options) {
    if (!a.whole().course.is_half_turn() && !b.whole().course.is_half_turn()) {
        return prove_once(a.whole(), b.whole(), options);
    }
    const Transform3<S> middle_a = a.middle(), middle_b = b.middle();
    options.tolerance = std::min(2 * options.tolerance, 1.0);
    cstk_motion_result found = prove_once(a.first_half(middle_a), b.first_half(middle_b), options);
    const bool in_second = found.outcome == CSTK_MOTION_FREE;
    if (in_second) {
        found = prove_once(a.second_half(middle_a), b.second_half(middle_b), options);
    }
    for (double &time : found.times) {
        time = 0.5 * (time + (in_second ? 1 : 0));
    }
    return found;
}

} // namespace detail
} // namespace cstk_fcl

#endif
