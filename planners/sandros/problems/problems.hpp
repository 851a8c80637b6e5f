// The problems that the program knows by name.
#ifndef SANDROS_PROBLEMS_HPP
#define SANDROS_PROBLEMS_HPP

#include "../problem.hpp"

namespace sandros::problems {

/// A Puma 560 takes its hand from under a shelf, round a post, down between two crates. `meshes` is
/// the folder with link0.stl to link6.stl (scripts/fetch_puma560.sh).
Problem puma560(const std::string &meshes);

/// A rigid L hooks itself through a window smaller than it is, then goes through a low and wide
/// one.
Problem windows();

/// Two arms over a table reach past each other, and change sides.
Problem two_arms();

/// Two carts in a corridor change places: one must wait in the bay.
Problem two_carts();

/// A stick in a bug trap, with its mouth open or closed: of the closed one there is no way out.
Problem bug_trap(bool open);

/// All but puma560, which needs meshes.
std::vector<Problem> generated();

} // namespace sandros::problems

#endif
