/* cstk/fcl.hpp: the calls of FCL 0.7 (the Flexible Collision Library), answered by libcstk. Header-only C++17 over cstk.hpp;
 * of FCL nothing is needed. A program changes two lines:
 *
 *     #include <cstk/fcl.hpp>          // was <fcl/fcl.h> or any header below it
 *     namespace fcl = cstk_fcl;
 *
 * Covered are geometries (BVHModel of triangles or points, all shapes, OcTree), CollisionObject, collide, distance,
 * continuousCollide, the broad-phase managers with their callbacks, and of Coal (HPP-FCL) security_margin, distance_upper_bound,
 * ComputeCollision and ComputeDistance. What is left out fails to compile, with a hint (not_covered.hpp). docs/migration.md lists
 * where answers differ from FCL's, and why.
 *
 * Lengths are in your unit, transforms are Eigen's, from the geometry's frame to the world. What FCL would print as a warning or
 * not notice (a transform that is no rotation, numbers that are not finite) throws cstk::Error, std::invalid_argument where this
 * header itself refuses it.
 *
 * Threads may query the same geometries, objects and managers at once, each with a query context of its own, as long as none
 * changes them. Answers are the same whatever was asked before, and on whichever thread.
 */
#ifndef CSTK_FCL_HPP
#define CSTK_FCL_HPP

#include <cstk/fcl/continuous_collision.hpp>
#include <cstk/fcl/functors.hpp>
#include <cstk/fcl/managers.hpp>
#include <cstk/fcl/model_of_shape.hpp>
#include <cstk/fcl/not_covered.hpp>
#include <cstk/fcl/octree.hpp>

#endif
