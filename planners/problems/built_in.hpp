// Problems that need no files, and the Puma 560, whose links are files.
#pragma once

#include "problem.hpp"

#include <string>
#include <vector>

namespace problems {

/// A rectangular opening in a plane across x: its half sides are along y and z.
struct Window {
    std::array<double, 3> middle;
    std::array<double, 2> half_sides;
};

/// Four boards around a window: a square about the x-axis with an opening.
std::vector<Obstacle> wall_around(const Window &window, double half_side, double half_thickness);

/// A rigid L passes through two walls, each with a window that it fits through only turned: 3 lengths and a rotation.
Problem windows();

/// An arm of 4 links in the plane, its joints without limits, reaches through a slot, and then through another behind it.
Problem chambers();

/// A Puma 560 in its workcell reaches from the table to below a drum. `folder` is what scripts/fetch_puma560.sh prints.
Problem puma_cell(const std::string &folder);

/// The arm alone: links, joints and limits.
cstk::Robot puma_560(const std::string &folder);

/// windows(), chambers() and, where the folder is not empty, puma_cell().
std::vector<Problem> built_in(const std::string &puma_folder);

} // namespace problems
