// What a library's build of a mesh takes.
#pragma once

#include "meshes.hpp"

#include <string>
#include <vector>

struct Built {
    /// Of the library, and which of its ways.
    std::string library, way;
    /// From the arrays of the mesh to a body that can be asked; the least of several builds.
    double seconds;
    /// Memory that the body keeps, all told, of each triangle.
    double bytes;
};

/// Ours on one thread and on all.
std::vector<Built> cstk_builds(const Mesh &mesh, int times);

/// FCL's volumes one after another.
std::vector<Built> fcl_builds(const Mesh &mesh, int times);

/// Coal's; none where it is not to be had.
std::vector<Built> coal_builds(const Mesh &mesh, int times);
