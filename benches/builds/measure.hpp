// Time and memory of one build.
#pragma once

#include "built.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <malloc.h>

/// Bytes that are allocated and not freed.
inline double bytes_in_use() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

/// `build` makes a body of the mesh and returns its owner.
template <class Build>
Built measured(const char *library, const char *way, const Mesh &mesh, int times,
               const Build &build) {
    Built built{library, way, std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < times; ++i) {
        const double before = bytes_in_use();
        const auto start = std::chrono::steady_clock::now();
        const auto body = build();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        built.seconds = std::min(built.seconds, took.count());
        built.bytes = (bytes_in_use() - before) / mesh.triangles.size();
    }
    return built;
}
