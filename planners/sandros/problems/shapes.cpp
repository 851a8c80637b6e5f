#include "shapes.hpp"

namespace sandros::problems {

cstk::Body body_of(const std::vector<Box> &boxes) {
    cstk::BodyBuilder builder;
    for (const auto &[middle, sides] : boxes) {
        builder.add_box(cstk::translation(middle[0], middle[1], middle[2]),
                        {sides[0] / 2, sides[1] / 2, sides[2] / 2});
    }
    return builder.build();
}

cstk::Body ball(double radius) { return cstk::BodyBuilder().add_sphere({0, 0, 0}, radius).build(); }

std::uint32_t add_link(cstk::RobotBuilder &builder, const std::string &name, std::int32_t parent,
                       const Joint &joint, const Vector &at, const cstk::Body &body) {
    cstk::Link link;
    link.name = name;
    link.body = body;
    link.parent = parent;
    link.joint = joint.kind;
    link.axis = joint.axis;
    link.at = cstk::translation(at[0], at[1], at[2]);
    if (joint.lower < joint.upper) {
        link.lower = joint.lower;
        link.upper = joint.upper;
    }
    return builder.add_link(link);
}

} // namespace sandros::problems
