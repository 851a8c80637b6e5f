// A planner with what tells it whether edges are free.
#pragma once

#include "problem.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

struct Run {
    /// Empty where none was found in time.
    std::vector<problems::Configuration> path;
    double milliseconds = 0;
    /// So many motions were asked.
    std::size_t checks = 0;
};

struct Task {
    const problems::Problem &problem;
    std::uint64_t seed;
    /// See FclCell.
    std::string fcl_way;
};

struct Variant {
    std::string planner, library;
    std::function<Run(const Task &)> solve;
};

std::vector<Variant> variants();
