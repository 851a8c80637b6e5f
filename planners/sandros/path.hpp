// What is done with a path once it is found.
#ifndef SANDROS_PATH_HPP
#define SANDROS_PATH_HPP

#include "problem.hpp"

namespace sandros {

/// Every motion of the path is proved free.
bool is_free(const Problem &problem, const Path &path);

/// The sum of the distances between neighbours.
double length(const Problem &problem, const Path &path);

/// The path with shortcuts, straight motions that are proved free; the path itself where that
/// cannot be proved of the whole.
Path shortened(const Problem &problem, const Path &path);

} // namespace sandros

#endif
