// What the generated problems are built of.
#ifndef SANDROS_SHAPES_HPP
#define SANDROS_SHAPES_HPP

#include "../problem.hpp"

namespace sandros::problems {

using Vector = std::array<double, 3>;

inline const double pi = 3.14159265358979323846;

/// A solid box along the axes, by its middle and its side lengths.
struct Box {
    Vector middle, sides;
};

cstk::Body body_of(const std::vector<Box> &boxes);

cstk::Body ball(double radius);

/// A coordinate's way along or about an axis; between equal limits about a circle.
struct Joint {
    cstk_joint_kind kind;
    Vector axis;
    double lower, upper;
};

/// A link behind a joint that sits at a point of its parent's frame; -1 is the world. Returns the
/// link's number.
std::uint32_t add_link(cstk::RobotBuilder &builder, const std::string &name, std::int32_t parent,
                       const Joint &joint, const Vector &at, const cstk::Body &body = {});

} // namespace sandros::problems

#endif
