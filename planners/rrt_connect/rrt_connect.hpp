// RRT-Connect (Kuffner and LaValle, 2000) over libcstk: a tree from the start and one from the goal, grown towards each other by
// motions that are proved free.
#pragma once

#include "edge_prover.hpp"
#include "tree.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rrt_connect {

struct Options {
    /// The longest edge, and how far apart its samples are at most, as Space::distance measures: radians and lengths together.
    double range = 1;
    double spacing = 0.25;
    /// Without a path after so many samples the search is given up.
    std::size_t max_samples = 100000;
    std::uint64_t seed = 1;
};

struct Plan {
    /// From start to goal by straight motions of the space, each proved free; empty where none was found.
    std::vector<Configuration> path;
    /// So many motions were asked.
    std::size_t checks = 0;
};

/// Looks for a path from start to goal outside of `contact`. There is none where one of the two is inside. Every coordinate of the
/// space needs a bounded range, to be sampled from.
Plan plan(const cstk::Query &query, const cstk::Space &space, const cstk::CObject &contact, const Configuration &start,
          const Configuration &goal, const Options &options = {});

} // namespace rrt_connect
