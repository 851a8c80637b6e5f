// A problem and its path, as files to look at.
#ifndef SANDROS_PICTURE_HPP
#define SANDROS_PICTURE_HPP

#include "../problem.hpp"

namespace sandros::pictures {

/// A body's faces as triangles, three corners each; what is round has none.
std::vector<std::array<double, 3>> triangles_of(const cstk::Body &body);

/// The robot moves along the path: an animated .glb file.
void draw_motion(const Problem &problem, const Path &path, const std::string &file);

/// The robot at a part of its path, from 0 to 1, with dots where its last links pass: a .glb file
/// that holds still. The path has at least one configuration.
void draw_moment(const Problem &problem, const Path &path, double part, const std::string &file);

} // namespace sandros::pictures

#endif
