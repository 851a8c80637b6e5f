// Shorter paths.
#pragma once

#include "edge_prover.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrt_connect {

/// The length of a path, as Space::distance measures.
double length(const cstk::Space &space, const std::vector<Configuration> &path);

/// Cuts corners by motions that `edges` proves free: `tries` times between two places of the path, drawn at random. The path stays
/// free, its ends stay where they are.
void shorten(std::vector<Configuration> &path, const cstk::Space &space, EdgeProver &edges, std::size_t tries,
             std::uint64_t seed);

} // namespace rrt_connect
