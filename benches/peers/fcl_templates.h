// FCL's hot templates, instantiated by the program that includes this: so that they get its flags instead of the
// distribution's.
#pragma once

#include <fcl/fcl.h>

namespace fcl {
template class RSS<double>;
template class OBB<double>;
template class OBBRSS<double>;
template class kIOS<double>;
template void clipToRange(double &, double, double);
template void segCoords(double &, double &, double, double, double, double, double);
template bool inVoronoi(double, double, double, double, double, double, double);
template double rectDistance(const Matrix3<double> &, Vector3<double> const &, const double[2], const double[2],
                             Vector3<double> *, Vector3<double> *);
template double rectDistance(const Transform3<double> &, const double[2], const double[2], Vector3<double> *,
                             Vector3<double> *);
template bool obbDisjoint(const Matrix3<double> &, const Vector3<double> &, const Vector3<double> &,
                          const Vector3<double> &);
template bool obbDisjoint(const Transform3<double> &, const Vector3<double> &, const Vector3<double> &);
namespace detail {
template class TriangleDistance<double>;
template class Intersect<double>;
template class MeshDistanceTraversalNodeRSS<double>;
template class MeshDistanceTraversalNodekIOS<double>;
template class MeshDistanceTraversalNodeOBBRSS<double>;
template class MeshCollisionTraversalNodeOBB<double>;
template class MeshCollisionTraversalNodeRSS<double>;
template class MeshCollisionTraversalNodekIOS<double>;
template class MeshCollisionTraversalNodeOBBRSS<double>;
template void collisionRecurse(CollisionTraversalNodeBase<double> *, int, int, BVHFrontList *);
template void distanceRecurse(DistanceTraversalNodeBase<double> *, int, int, BVHFrontList *);
template void distanceQueueRecurse(DistanceTraversalNodeBase<double> *, int, int, BVHFrontList *, int);
template void collide(CollisionTraversalNodeBase<double> *, BVHFrontList *);
template void distance(DistanceTraversalNodeBase<double> *, BVHFrontList *, int);
}  // namespace detail
}  // namespace fcl
