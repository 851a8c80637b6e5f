#include "obstacles.hpp"

#include <algorithm>

namespace sandros {

namespace {

/// By link of the space: how many of the first axes place it; 0 for links that nothing moves.
std::vector<std::size_t> axes_that_place(const Problem &problem) {
    std::vector<std::size_t> place_of_coordinate(problem.space.nq());
    for (std::size_t i = 0; i < problem.axes.size(); ++i) {
        place_of_coordinate[problem.axes[i].coordinate] = i + 1;
    }
    std::vector<std::size_t> placed;
    for (std::size_t r = 0; r < problem.robots.size(); ++r) {
        const cstk::Robot &robot = problem.robots[r];
        const cstk_space_offset offset = problem.space.offset(r);
        for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
            const cstk_link_info info = robot.link_info(link);
            std::size_t axes = 0;
            if (info.parent >= 0) {
                axes = placed[offset.link + static_cast<std::size_t>(info.parent)];
            }
            for (std::uint32_t k = 0; k < info.nq; ++k) {
                axes = std::max(axes, place_of_coordinate[offset.coordinate + info.coordinate + k]);
            }
            placed.push_back(axes);
        }
    }
    return placed;
}

/// By link of the space.
std::vector<bool> links_with_bodies(const Problem &problem) {
    std::vector<bool> found;
    for (const cstk::Robot &robot : problem.robots) {
        for (std::uint32_t link = 0; link < robot.link_count(); ++link) {
            found.push_back(robot.link_info(link).has_body);
        }
    }
    return found;
}

/// The links that a number of the first axes place, against the obstacles and each other.
cstk::CObject obstacles_of_axes(const Problem &problem, std::size_t axes, const std::vector<std::size_t> &placed) {
    const std::vector<bool> has_body = links_with_bodies(problem);
    std::vector<std::uint32_t> links;
    for (std::uint32_t link = 0; link < placed.size(); ++link) {
        if (placed[link] > 0 && placed[link] <= axes && has_body[link]) {
            links.push_back(link);
        }
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto &pair : problem.link_pairs) {
        if (placed[pair[0]] <= axes && placed[pair[1]] <= axes) {
            pairs.push_back(pair);
        }
    }
    const cstk::CObject among_links = cstk::CObject::induced_links(problem.space, pairs);
    std::vector<cstk::CObject> parts = {among_links.with_shell(problem.slide.link_shell)};
    if (!links.empty()) {
        parts.push_back(
            cstk::CObject::induced(problem.space, problem.environment, cstk::induced_options(), links));
    }
    return cstk::CObject::union_of(parts);
}

} // namespace

std::vector<cstk::CObject> obstacles_of_first_axes(const Problem &problem) {
    const std::vector<std::size_t> placed = axes_that_place(problem);
    std::vector<cstk::CObject> sets;
    for (std::size_t axes = 0; axes <= problem.axes.size(); ++axes) {
        sets.push_back(obstacles_of_axes(problem, axes, placed));
    }
    return sets;
}

cstk::CObject obstacles_of(const Problem &problem) {
    return obstacles_of_axes(problem, problem.axes.size(), axes_that_place(problem));
}

} // namespace sandros
