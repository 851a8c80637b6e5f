// G: the SANDROS planner (Chen and Hwang, IEEE Transactions on Robotics and Automation 14(3),
// 1998).
#ifndef SANDROS_PLANNER_HPP
#define SANDROS_PLANNER_HPP

#include "local_planner.hpp"
#include "subgoal_graph.hpp"

namespace sandros {

struct PlanOptions {
    /// How often the cells of the coarsest resolution are halved before the planner gives up.
    /// Coarser resolutions are searched first, so that what one of them finds no finer one loses.
    unsigned halvings = 0;
    /// Subgoals in one search: a bound of memory and time.
    std::size_t max_subgoals = 200000;
};

enum class Outcome {
    FOUND,
    /// No sequence of neighbouring subgoals is left: the local planner could not follow those that
    /// the grid has.
    NO_PATH_AT_THIS_RESOLUTION,
    /// max_subgoals ended the search.
    GAVE_UP,
    /// The start or the goal is inside an obstacle, or out of its range.
    BAD_START_OR_GOAL,
    /// A path was found that comes so near to contact that not all of its motions could be proved.
    NOT_PROVED,
};

const char *name_of(Outcome outcome);

/// What was done, over all resolutions.
struct PlanWork {
    LocalWork local;
    GraphWork graph;
    std::size_t subgoals = 0, attempts = 0, refinements = 0;
    /// Halvings of the resolution that was searched last.
    unsigned halvings = 0;

    /// Questions asked of the library.
    std::size_t checks() const {
        return local.motions + local.slides + graph.regions + graph.distances;
    }
};

struct Plan {
    Outcome outcome;
    /// From start to goal if it was found; every motion is proved free.
    Path path;
    PlanWork work;
};

/// The same problem has the same plan.
Plan plan(const Problem &problem, const PlanOptions &options = {});

} // namespace sandros

#endif
