#include "sandros_problems.hpp"

#include "sandros/planner.hpp"
#include "sandros/problems/problems.hpp"

#include <map>
#include <memory>
#include <set>

namespace {

/// For the longest edge of a tree: of 0.3, 0.6, 1.5 and OMPL's own choice what OMPL's RRTConnect solved the problem with soonest.
double range_for(const std::string &problem) {
    const std::map<std::string, double> shorter = {{"windows", 0.3}, {"bug_trap", 0.6}, {"bug_trap_open", 0.6}};
    const auto found = shorter.find(problem);
    return found == shorter.end() ? 1.5 : found->second;
}

/// The moving links of all robots, by their numbers in the space.
std::vector<std::uint32_t> moving_links(const sandros::Problem &problem) {
    std::vector<std::uint32_t> found;
    for (std::size_t r = 0; r < problem.robots.size(); ++r) {
        for (const std::uint32_t link : problems::moving_links(problem.robots[r])) {
            found.push_back(problem.space.offset(r).link + link);
        }
    }
    return found;
}

/// The balls about the origins of rigid bodies. They are within the bodies: without them SANDROS drops positions later, and no answer
/// changes.
std::set<std::uint32_t> cores(const sandros::Problem &problem) {
    std::set<std::uint32_t> found;
    for (std::size_t r = 0; r < problem.robots.size(); ++r) {
        for (const std::uint32_t link : problems::moving_links(problem.robots[r])) {
            if (problem.robots[r].body(link).primitive(0).kind == CSTK_PRIMITIVE_SPHERE) {
                found.insert(problem.space.offset(r).link + link);
            }
        }
    }
    return found;
}

problems::Problem for_all(const sandros::Problem &problem) {
    const std::set<std::uint32_t> left_out = cores(problem);
    std::vector<problems::Obstacle> obstacles;
    for (const sandros::Obstacle &obstacle : problem.obstacles) {
        obstacles.push_back({obstacle.body, obstacle.pose});
    }
    std::vector<std::uint32_t> moving;
    for (const std::uint32_t link : moving_links(problem)) {
        if (left_out.count(link) == 0) {
            moving.push_back(link);
        }
    }
    std::vector<problems::LinkPair> pairs;
    for (const problems::LinkPair &pair : problem.link_pairs) {
        if (left_out.count(pair[0]) + left_out.count(pair[1]) == 0) {
            pairs.push_back(pair);
        }
    }
    auto workcell = std::make_shared<const problems::Workcell>(problem.robots, problem.space, obstacles, moving, pairs);
    return {"sandros " + problem.name, "1", workcell, problem.start, problem.goal, range_for(problem.name)};
}

Run by_sandros(const sandros::Problem &problem) {
    sandros::Plan plan;
    const double time = processor_milliseconds([&] { plan = sandros::plan(problem); });
    Answer answer = Answer::gave_up;
    if (plan.outcome == sandros::Outcome::FOUND) {
        answer = Answer::path;
    } else if (plan.outcome == sandros::Outcome::NO_PATH_AT_THIS_RESOLUTION) {
        answer = Answer::none;
    }
    return {answer, plan.path, time, plan.work.checks()};
}

} // namespace

std::vector<SandrosProblem> sandros_problems(const std::string &puma_folder) {
    std::vector<sandros::Problem> known = sandros::problems::generated();
    if (!puma_folder.empty()) {
        known.insert(known.begin(), sandros::problems::puma560(puma_folder));
    }
    std::vector<SandrosProblem> found;
    for (const sandros::Problem &problem : known) {
        const Variant variant = {"SANDROS", "cstk proved", [problem](const Task &) { return by_sandros(problem); }, false};
        found.push_back({for_all(problem), variant, problem.name != "bug_trap"});
    }
    return found;
}
