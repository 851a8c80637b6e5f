// Vertices and triangles of meshes, in a library's own types.
#pragma once

#include "peers.h"

#include <cstdint>
#include <vector>

namespace peers {

template <class Vector, class Triangle>
struct Soup {
    // All meshes in one.
    Soup(const peer_mesh *meshes, std::size_t count) {
        for (std::size_t at = 0; at < count; ++at) {
            const peer_mesh &mesh = meshes[at];
            std::size_t first = vertices.size();
            for (std::size_t vertex = 0; vertex < mesh.vertex_count; ++vertex) {
                const double *numbers = mesh.vertices + 3 * vertex;
                vertices.emplace_back(numbers[0], numbers[1], numbers[2]);
            }
            for (std::size_t triangle = 0; triangle < mesh.triangle_count; ++triangle) {
                const std::uint32_t *corners = mesh.triangles + 3 * triangle;
                triangles.emplace_back(first + corners[0], first + corners[1], first + corners[2]);
            }
        }
    }

    std::vector<Vector> vertices;
    std::vector<Triangle> triangles;
};

}  // namespace peers
