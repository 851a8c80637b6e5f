// The C-objects of a problem: of the whole robot, and of its first links.
#ifndef SANDROS_OBSTACLES_HPP
#define SANDROS_OBSTACLES_HPP

#include "problem.hpp"

namespace sandros {

/// Where the robot meets an obstacle, or a link that it must not meet.
cstk::CObject obstacles_of(const Problem &problem);

/// The same for only those links that the first axes place, whatever the others do; one C-object
/// for each number of axes, from 0 to all. What is inside one of them is inside all that follow.
/// This is what lets a subgoal be dropped before its later joints are looked at.
std::vector<cstk::CObject> obstacles_of_first_axes(const Problem &problem);

} // namespace sandros

#endif
