// The robots among boxes, and the configurations that they are asked at.
#pragma once

#include "problem.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// A robot with boxes around it, against them and itself.
struct Cell {
    std::string robot;
    std::size_t objects;
    std::shared_ptr<const problems::Workcell> workcell;
};

/// Both robots among 20 and among 500 boxes; a robot whose folder is empty is left out.
std::vector<Cell> cells(const std::string &puma, const std::string &panda, std::uint64_t seed);

/// Anywhere within the limits.
std::vector<double> random_configurations(const cstk::Space &space, std::size_t count, std::uint64_t seed);

/// Stretches of 50 short steps, each from one random configuration towards another.
std::vector<double> coherent_configurations(const cstk::Space &space, std::size_t count, std::uint64_t seed);
