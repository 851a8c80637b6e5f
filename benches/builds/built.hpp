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

/// A body made of what is built already, beside its build from arrays.
struct Again {
    /// Of the build, its arrays checked and grouped, and of making it again; the least of several.
    double build, again;
    /// Memory that both keep, of each triangle.
    double bytes, bytes_again;
    /// The largest difference of distances to a small ball at 200 places.
    double difference;
};

/// So many copies of a mesh as parts of one body.
Again built_of_parts(const Mesh &mesh, int count, int times);

/// A body refitted to vertices that have moved.
Again refitted(const Mesh &mesh, int times);

/// FCL's volumes one after another.
std::vector<Built> fcl_builds(const Mesh &mesh, int times);

/// Coal's; none where it is not to be had.
std::vector<Built> coal_builds(const Mesh &mesh, int times);
