// Shorter paths.
#pragma once

#include "tree.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrt_connect {

/// The length of a path, as Space::distance measures.
double length(const cstk::Space &space, const std::vector<Configuration> &path);

/// The path with corners cut by motions that are proved free: `tries` times between two places on it, drawn at random. Its ends stay
/// where they are. An empty path stays empty.
std::vector<Configuration> shortened(cstk::Query &query, const cstk::CObject &contact,
                                     const std::vector<Configuration> &path, std::size_t tries, std::uint64_t seed);

} // namespace rrt_connect
