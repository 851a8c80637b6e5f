// L: moves the robot towards a subgoal, straight where it can, sliding along contacts where it
// must.
#ifndef SANDROS_LOCAL_PLANNER_HPP
#define SANDROS_LOCAL_PLANNER_HPP

#include "grid.hpp"

#include <optional>

namespace sandros {

/// What the local planner asked of the library.
struct LocalWork {
    std::size_t motions = 0, slides = 0;
};

/// It looks ahead by one step and remembers nothing: the global planner knows what to do where it
/// gives up. Every motion that it returns is proved free.
class LocalPlanner {
  public:
    LocalPlanner(const Problem &problem, const cstk::CObject &obstacles, cstk::Query &query);

    /// The configurations after `from`, the last of them in the set; none if it was not reached.
    std::optional<Path> reach(const Configuration &from, const Grid &grid, const Cells &cells);

    /// The configurations after `from`, the last of them `to`; none if it was not reached.
    std::optional<Path> reach(const Configuration &from, const Configuration &to);

    /// The straight motion is free.
    bool straight(const Configuration &from, const Configuration &to);

    const LocalWork &work() const { return work_; }

  private:
    /// The same to the box between `low` and `high`.
    std::optional<Path> reach(const Configuration &from, const Configuration &low,
                              const Configuration &high);

    const cstk::CObject obstacles_;
    cstk::Query &query_;
    const cstk_slide_options slide_options_;
    cstk_slide_to_options options_;
    cstk_motion_options any_contact_;
    LocalWork work_;
};

} // namespace sandros

#endif
