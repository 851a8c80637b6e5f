// The surface of a body in triangles, as peers take it.
#pragma once

#include <cstk.hpp>

#include <cstdint>
#include <vector>

struct Surface {
    // Three numbers each.
    std::vector<double> vertices;
    // Three indices each.
    std::vector<std::uint32_t> triangles;
};

/// Of a body of polygons and polyhedra; throws at another primitive.
Surface surface_of(const cstk::Body &body);

/// How far a body reaches from the origin of its frame.
double radius_of(const cstk::Body &body);
