// A path as a picture.
#pragma once

#include "problem.hpp"

#include <string>
#include <vector>

/// Writes a .glb file of the workcell with the robot at the start and, as it moves, at so many places of the path in equal steps.
void draw_path(const problems::Workcell &workcell, const std::vector<problems::Configuration> &path, std::size_t places,
               const std::string &file);
