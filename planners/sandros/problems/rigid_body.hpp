// Rigid bodies as chains of joints, so that subgoals can fix one coordinate after the other.
#ifndef SANDROS_RIGID_BODY_HPP
#define SANDROS_RIGID_BODY_HPP

#include "shapes.hpp"

namespace sandros::problems {

/// Where the origin of a body may be.
struct Room {
    Vector low, high;
};

/// x, y, z, then yaw, pitch and roll. `core` is the radius of a ball about the origin that is
/// within the body: where it meets an obstacle the body does, however it is turned.
cstk::Robot free_body(const std::string &name, const cstk::Body &body, double core,
                      const Room &room);

/// x, y, then the angle about z.
cstk::Robot body_on_plane(const std::string &name, const cstk::Body &body, double core,
                          const Room &room);

} // namespace sandros::problems

#endif
