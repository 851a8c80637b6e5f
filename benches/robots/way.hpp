// One way to answer a query.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

enum class Query { collide, distance };

/// Answers the query at the pose of a number, kinematics included: 1 or 0 for whether anything
/// meets, or the distance in metres, 0 where anything meets.
struct Way {
    std::string name;
    std::function<double(std::size_t)> ask;
};

/// Names of two links.
using LinkPair = std::pair<std::string, std::string>;

/// Values of the robot's joints: the names once, and radians or metres for each pose.
struct Poses {
    std::vector<std::string> joints;
    std::vector<std::vector<double>> values;
};
