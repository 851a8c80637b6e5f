#include "bodies.hpp"

#include <algorithm>
#include <cmath>

const char *const box_name = "box";

namespace {

using models::Mesh;
using models::Point;

cstk::Body body_of(const Mesh &mesh) {
    std::vector<double> vertices;
    for (const Point &p : mesh.vertices) {
        vertices.insert(vertices.end(), p.begin(), p.end());
    }
    std::vector<std::uint32_t> sizes, indices;
    for (const models::Face &face : mesh.faces) {
        sizes.push_back(static_cast<std::uint32_t>(face.size()));
        indices.insert(indices.end(), face.begin(), face.end());
    }
    return cstk::BodyBuilder().add_mesh(vertices, sizes, indices).build();
}

double largest_radius(const Mesh &mesh) {
    double largest = 0;
    for (const Point &p : mesh.vertices) {
        largest = std::max(largest, std::hypot(p[0], p[1], p[2]));
    }
    return largest;
}

// A bumpy tube with round ends, along x from 0 to `length`; 352 triangles.
Mesh limb(double length, double radius) {
    Mesh mesh = models::sphere("limb", radius, 12, 16, 0.1);
    for (Point &p : mesh.vertices) {
        p = {p[2] < 0 ? p[2] : p[2] + length, p[0], p[1]};
    }
    return mesh;
}

cstk::Link joint(int number, cstk::Pose at, std::array<double, 3> axis, const Shape &shape) {
    cstk::Link link;
    link.body = shape.body;
    link.parent = number - 1;
    link.joint = CSTK_JOINT_REVOLUTE;
    link.at = at;
    link.axis = axis;
    return link;
}

cstk::Space space_of(const std::vector<Shape> &links) {
    const std::array<double, 3> x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    const cstk::Pose here = cstk::identity();
    cstk::RobotBuilder builder;
    builder.add_link(joint(0, here, z, links[0]));
    builder.add_link(joint(1, here, y, links[1]));
    builder.add_link(joint(2, cstk::translation(0.42, 0, 0), y, links[2]));
    builder.add_link(joint(3, cstk::translation(0.38, 0, 0), x, links[3]));
    builder.add_link(joint(4, here, y, links[4]));
    builder.add_link(joint(5, cstk::translation(0.08, 0, 0), x, links[5]));
    return cstk::Space(builder.build());
}

std::vector<Shape> arm_links() {
    std::vector<Shape> links;
    const double sizes[6][2] = {{0.05, 0.11}, {0.42, 0.075}, {0.38, 0.055},
                                {0.01, 0.05}, {0.06, 0.04},  {0.1, 0.03}};
    for (const auto &[length, radius] : sizes) {
        links.emplace_back(limb(length, radius));
    }
    return links;
}

Mesh small_box(models::Random &random) {
    const auto side = [&] { return random.uniform(0.5, 1); };
    const double x = side(), y = side(), z = side();
    return models::box(box_name, x, y, z);
}

// 198 to 476 triangles.
Mesh bumpy(models::Random &random) {
    const int rings = 10 + static_cast<int>(random.below(6));
    Mesh mesh =
        models::sphere("bumpy", 1, rings, rings + 1 + static_cast<int>(random.below(2)), 0.18);
    const Point stretch = {random.uniform(0.6, 1), random.uniform(0.6, 1), random.uniform(0.6, 1)};
    for (Point &p : mesh.vertices) {
        p = {stretch[0] * p[0], stretch[1] * p[1], stretch[2] * p[2]};
    }
    return mesh;
}

} // namespace

Shape::Shape(Mesh made) : mesh(std::move(made)), body(body_of(mesh)) {}

Arm::Arm() : links(arm_links()), space(space_of(links)) {}

std::vector<Shape> small_bodies(std::size_t count, double radius, models::Random &random) {
    std::vector<Shape> made;
    for (std::size_t i = 0; i < count; ++i) {
        Mesh mesh = i % 2 == 0 ? small_box(random) : bumpy(random);
        const double scale = radius * random.uniform(0.6, 1) / largest_radius(mesh);
        for (Point &p : mesh.vertices) {
            p = {scale * p[0], scale * p[1], scale * p[2]};
        }
        made.emplace_back(std::move(mesh));
    }
    return made;
}
