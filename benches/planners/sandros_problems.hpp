// The problems of planners/sandros for all planners, and SANDROS on them.
#pragma once

#include "variants.hpp"

#include <string>
#include <vector>

struct SandrosProblem {
    problems::Problem problem;
    Variant sandros;
    /// False for the closed bug trap.
    bool has_path;
};

/// Without a folder without the Puma 560.
std::vector<SandrosProblem> sandros_problems(const std::string &puma_folder);
