// Triangle meshes to build hierarchies over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

struct Mesh {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A closed surface of bumps, of about so many triangles, all alike in size.
Mesh bumpy_sphere(std::size_t triangles);

/// Spheres of a thousand triangles and of many sizes on a floor of two, so that large and small ones lie side by side.
Mesh balls_on_a_floor(std::size_t triangles, std::uint64_t seed);

/// Triangles of all directions anywhere in a cube, none of which share a vertex.
Mesh soup(std::size_t triangles, std::uint64_t seed);
