/* Part of cstk/fcl.hpp: Coal's functors for a pair of geometries that is asked about often. */
#ifndef CSTK_FCL_FUNCTORS_HPP
#define CSTK_FCL_FUNCTORS_HPP

#include <cstk/fcl/queries.hpp>

namespace cstk_fcl {

/// collide() of two geometries that outlive the functor. In Coal it keeps a guess for the next search; here the thread's query
/// context does, for every pair, so that it is as fast as collide().
template <typename S> class ComputeCollision {
public:
    ComputeCollision(const CollisionGeometry<S> *o1, const CollisionGeometry<S> *o2) : o1_(o1), o2_(o2) {}

    std::size_t operator()(const Transform3<S> &tf1, const Transform3<S> &tf2, const CollisionRequest<S> &request,
                           CollisionResult<S> &result) const {
        return collide(o1_, tf1, o2_, tf2, request, result);
    }

private:
    const CollisionGeometry<S> *o1_;
    const CollisionGeometry<S> *o2_;
};

/// distance() of two geometries that outlive the functor.
template <typename S> class ComputeDistance {
public:
    ComputeDistance(const CollisionGeometry<S> *o1, const CollisionGeometry<S> *o2) : o1_(o1), o2_(o2) {}

    S operator()(const Transform3<S> &tf1, const Transform3<S> &tf2, const DistanceRequest<S> &request,
                 DistanceResult<S> &result) const {
        return distance(o1_, tf1, o2_, tf2, request, result);
    }

private:
    const CollisionGeometry<S> *o1_;
    const CollisionGeometry<S> *o2_;
};

/* The geometries may be of any kind, and the scalar is theirs. */
template <typename A, typename B> ComputeCollision(const A *, const B *) -> ComputeCollision<typename A::S>;
template <typename A, typename B> ComputeDistance(const A *, const B *) -> ComputeDistance<typename A::S>;
template <typename S>
ComputeCollision(const CollisionGeometry<S> *, const CollisionGeometry<S> *) -> ComputeCollision<S>;
template <typename S> ComputeDistance(const CollisionGeometry<S> *, const CollisionGeometry<S> *) -> ComputeDistance<S>;

} // namespace cstk_fcl

#endif
