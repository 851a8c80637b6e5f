// Slides of many steps, each step timed.
#pragma once

#include "robots.hpp"

#include <cstdint>
#include <vector>

/// Times of steps in microseconds, and how they ended.
struct Steps {
    std::vector<double> times;
    std::size_t moved = 0, blocked = 0;
    /// The lengths of the steps' ways, and of the steps asked for.
    double gone = 0, asked = 0;

    void add(double microseconds, cstk_slide_outcome outcome, double way);
    /// The time that a share of the steps stays below.
    double quantile(double share) const;
};

struct Walks {
    /// Steps from where no obstacle is within the shell, and the others.
    Steps free, sliding;
};

/// How far the robot looks, in metres.
struct Shells {
    double obstacles, links;
};

/// Slides from random configurations that are free, along random directions.
Walks walk(const Cell &cell, const Shells &shells, std::size_t walks, std::uint64_t seed);
