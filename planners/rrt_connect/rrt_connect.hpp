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
    /// The longest edge, as Space::distance measures: radians and lengths together.
    double range = 1;
    /// A node from which a motion was not free is asked for samples at most so many ranges away alone (Yershova, Jaillet, Simeon and
    /// LaValle, 2005): farther ones lead into the same obstacle.
    double domain = 2.5;
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
Plan plan(cstk::Query &query, const cstk::Space &space, const cstk::CObject &contact, const Configuration &start,
          const Configuration &goal, const Options &options = {});

} // namespace rrt_connect
