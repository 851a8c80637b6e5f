/* Part of cstk/fcl.hpp: FCL's names that are not covered. Using one fails to compile, and the message says what to use instead. */
#ifndef CSTK_FCL_NOT_COVERED_HPP
#define CSTK_FCL_NOT_COVERED_HPP

#include <cstk/fcl/types.hpp>

namespace cstk_fcl {

namespace detail {

/* False, but only known to be so where the class is used. */
template <typename> constexpr bool is_covered = false;

} // namespace detail

template <typename S> class SplineMotion {
    static_assert(detail::is_covered<S>, "cstk_fcl has no SplineMotion: prove splines of a robot's coordinates with "
                                         "cstk_motion_spline (cstk::Query::motion_spline)");
};

template <typename S> class TBVMotionBoundVisitor {
    static_assert(detail::is_covered<S>, "cstk_fcl has no motion bounds of its own: continuousCollide proves motions");
};

template <typename S, typename HashTable = void> class SpatialHashingCollisionManager {
    static_assert(detail::is_covered<S>, "cstk_fcl has one broad phase: use DynamicAABBTreeCollisionManager, which needs no cell "
                                         "size and no bounds of the scene");
};

template <typename S> class BroadPhaseContinuousCollisionManager {
    static_assert(detail::is_covered<S>, "cstk_fcl has no manager of moving objects: give the robot and the obstacles to "
                                         "cstk_motion (cstk::Query::motion), which proves a motion among all of them at once");
};

template <typename S> class Variance3 {
    static_assert(detail::is_covered<S>, "cstk_fcl has no Variance3: use Eigen::SelfAdjointEigenSolver");
};

} // namespace cstk_fcl

#endif
