// The robots of example-robot-data with their collision meshes, among obstacles.
#pragma once

#include <cstk.hpp>

#include <string>

/// A robot, the pairs of its links to test, and the obstacles around it.
struct Cell {
    Cell(const std::string &robots, const std::string &urdf);

    cstk::Space space;
    cstk::Environment environment;
    /// Links against links.
    cstk::CObject itself;
    /// Links against obstacles.
    cstk::CObject obstacles;
    /// Pairs of links that `itself` holds.
    std::size_t pairs;
};
