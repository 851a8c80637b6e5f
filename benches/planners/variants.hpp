// A planner with what tells it whether edges are free.
#pragma once

#include "problem.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

enum class Answer {
    path,
    /// The planner says that there is none at its resolution.
    none,
    /// None was found in time.
    gave_up,
};

struct Run {
    Answer answer = Answer::gave_up;
    /// Empty where none was found.
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
    /// False where every run is the same.
    bool has_seeds = true;
};

/// The planners that take any problem. The last is the reference for times.
std::vector<Variant> variants();

/// Of this thread's processor time, which other programs do not lengthen.
double processor_milliseconds(const std::function<void()> &work);
