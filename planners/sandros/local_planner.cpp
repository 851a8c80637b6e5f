#include "local_planner.hpp"

#include "path.hpp"

namespace sandros {

namespace {

/// Slides in one attempt; with it its work is bounded.
const std::uint64_t MAX_SLIDES = 80;

} // namespace

LocalPlanner::LocalPlanner(const Problem &problem, const cstk::CObject &obstacles,
                           cstk::Query &query)
    : obstacles_(obstacles), query_(query), slide_options_(cstk::slide_options(problem.slide.shell)),
      options_(cstk::slide_to_options(problem.slide.step)), any_contact_(cstk::motion_options()) {
    options_.max_steps = MAX_SLIDES;
    any_contact_.any_contact = 1;
}

bool LocalPlanner::straight(const Configuration &from, const Configuration &to) {
    ++work_.motions;
    return query_.motion(obstacles_, from, to, any_contact_).outcome == CSTK_MOTION_FREE;
}

std::optional<Path> LocalPlanner::reach(const Configuration &from, const Configuration &low,
                                        const Configuration &high) {
    const cstk_slide_to_result led =
        query_.slide_to(obstacles_, from, low, high, slide_options_, options_);
    work_.motions += led.motions;
    work_.slides += led.steps;
    if (led.outcome != CSTK_SLIDE_TO_ARRIVED) {
        return std::nullopt;
    }
    Path path = cstk::configurations_of(led.path);
    /* The path begins with `from`; with one point `from` is in the box already. */
    if (path.size() > 1) {
        path.erase(path.begin());
    }
    return path;
}

std::optional<Path> LocalPlanner::reach(const Configuration &from, const Grid &grid,
                                        const Cells &cells) {
    return reach(from, grid.inner_low(cells), grid.inner_high(cells));
}

std::optional<Path> LocalPlanner::reach(const Configuration &from, const Configuration &to) {
    return reach(from, to, to);
}

} // namespace sandros
