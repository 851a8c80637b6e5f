// What is done with a path once it is found.
#ifndef SANDROS_PATH_HPP
#define SANDROS_PATH_HPP

#include "problem.hpp"

namespace sandros {

/// One configuration after the other, as the library takes them.
std::vector<double> flat(const Path &path);

/// Every motion of the path is proved free.
bool is_free(const Problem &problem, const Path &path);

/// The sum of the distances between neighbours.
double length(const Problem &problem, const Path &path);

/// A shorter path with fewer motions: shortcuts, and corners left out, by straight motions that are
/// proved free. What is not replaced is as free as it was.
Path shortened(const Problem &problem, const Path &path);

} // namespace sandros

#endif
