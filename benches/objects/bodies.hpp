// The bodies of the scenes, made in code: an arm like a Puma, and small bodies to scatter about it.
#pragma once

#include "fcl_models.hpp"

#include <cstk.hpp>

#include <cstdint>
#include <vector>

// A surface in polygons and in triangles, as libcstk holds it and as it was made.
struct Shape {
    explicit Shape(models::Mesh mesh);

    models::Mesh mesh;
    cstk::Body body;
};

// A mesh that is a box about the origin has this name.
extern const char *const box_name;

// An arm of six turning joints, whose shoulder is the world's origin: its links and their space.
struct Arm {
    Arm();

    std::vector<Shape> links;
    cstk::Space space;
};

// No point of the arm is farther from its shoulder.
constexpr double arm_reach = 1.06;

// As many boxes of 12 triangles as bumpy bodies of some hundreds, in turn; none larger than
// `radius` about the origin.
std::vector<Shape> small_bodies(std::size_t count, double radius, models::Random &random);
