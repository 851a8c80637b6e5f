// What stands around the robots, in metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

struct Box {
    std::array<double, 3> center, half_extents;
};

/// A surface of triangles, in the world's frame.
struct Surface {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;
};

struct Obstacles {
    std::vector<Box> boxes;
    std::vector<Surface> surfaces;
};

/// A table in front of the robot, two posts, a shelf above, and a wall behind.
Obstacles boxes_around();

/// These, and a bumpy ball of 2,048 triangles over the table.
Obstacles boxes_and_ball();

/// A box that none of the robots comes near.
Obstacles box_out_of_reach();
