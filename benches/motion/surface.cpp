#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace {

// A convex face as a fan.
void add_face(const std::vector<double> &corners, Surface &surface) {
    const auto first = static_cast<std::uint32_t>(surface.vertices.size() / 3);
    const auto count = static_cast<std::uint32_t>(corners.size() / 3);
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 2; i < count; ++i) {
        surface.triangles.insert(surface.triangles.end(), {first, first + i - 1, first + i});
    }
}

} // namespace

Surface surface_of(const cstk::Body &body) {
    Surface made;
    const auto count = static_cast<std::uint32_t>(body.statistics().primitive_count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const cstk_primitive primitive = body.primitive(i);
        if (primitive.kind != CSTK_PRIMITIVE_POLYGON &&
            primitive.kind != CSTK_PRIMITIVE_POLYHEDRON) {
            throw std::runtime_error("a body with a primitive that has no flat faces");
        }
        for (std::uint32_t face = 0; face < primitive.face_count; ++face) {
            add_face(body.feature_vertices(i, CSTK_FEATURE_FACE, face), made);
        }
    }
    return made;
}

double radius_of(const cstk::Body &body) {
    const std::vector<double> vertices = surface_of(body).vertices;
    double largest = 0;
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        largest = std::max(largest, std::hypot(vertices[i], vertices[i + 1], vertices[i + 2]));
    }
    return largest;
}
