// What the planner promises, on problems of its own: paths are proved and have few motions, plans
// are the same each time, a closed trap has no way out, and a finer resolution finds what a coarser
// one found:
//
//   plans [PUMA_MESHES]
#include "../path.hpp"
#include "../planner.hpp"
#include "../problems/problems.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace {

using namespace sandros;

/// What one expects of these problems: a corner or two at each narrow place.
const std::size_t MAX_MOTIONS = 12;

int failures = 0;

void expect(bool holds, const std::string &what) {
    if (!holds) {
        std::printf("FAILED: %s\n", what.c_str());
        ++failures;
    }
}

Problem with_cells(Problem problem, std::size_t multiply, std::size_t divide) {
    for (Axis &axis : problem.axes) {
        axis.cells = std::max<std::size_t>(1, axis.cells * multiply / divide);
    }
    return problem;
}

PlanOptions halved(unsigned halvings) {
    PlanOptions options;
    options.halvings = halvings;
    return options;
}

void paths_are_proved_and_the_same_each_time(const Problem &problem) {
    const Plan made = plan(problem), again = plan(problem);
    expect(made.outcome == Outcome::FOUND, problem.name + " is solved");
    expect(made.path == again.path && made.work.checks() == again.work.checks(),
           problem.name + ": the same problem has the same plan");
    if (made.outcome == Outcome::FOUND) {
        expect(made.path.front() == problem.start && made.path.back() == problem.goal,
               problem.name + ": the path leads from start to goal");
        expect(is_free(problem, made.path), problem.name + ": every motion is proved free");
        expect(made.path.size() - 1 <= MAX_MOTIONS,
               problem.name + ": the path has " + std::to_string(made.path.size() - 1) + " motions");
    }
}

/// Both where coarser resolutions are searched first, as the planner does, and where the finer grid
/// is searched alone.
void halving_loses_no_solution(const Problem &problem) {
    const Problem coarse = with_cells(problem, 1, 2);
    bool found = false, found_alone = false;
    for (unsigned halvings = 0; halvings <= 2; ++halvings) {
        const std::string name = problem.name + " halved " + std::to_string(halvings) + " times";
        const bool now = plan(coarse, halved(halvings)).outcome == Outcome::FOUND;
        const Problem fine = with_cells(coarse, std::size_t{1} << halvings, 1);
        const bool alone = plan(fine).outcome == Outcome::FOUND;
        std::printf("%s: %s, alone %s\n", name.c_str(), now ? "found" : "none",
                    alone ? "found" : "none");
        expect(now || !found, name + " finds what was found before");
        expect(alone || !found_alone, name + " alone finds what was found before");
        found = found || now;
        found_alone = found_alone || alone;
    }
    expect(found, problem.name + " is solved at some resolution");
}

void a_closed_trap_has_no_way_out() {
    for (const std::size_t divide : {4, 2, 1}) {
        const Plan made = plan(with_cells(problems::bug_trap(false), 1, divide));
        expect(made.outcome == Outcome::NO_PATH_AT_THIS_RESOLUTION && made.path.empty(),
               "the closed trap, cells " + std::to_string(divide) +
                   " times as large: " + name_of(made.outcome));
    }
}

void bad_ends_are_refused() {
    Problem inside = problems::bug_trap(true), beyond = inside;
    inside.start = {-1.1, 0, 0};
    beyond.goal[0] = 2.5;
    for (const Problem &problem : {inside, beyond}) {
        expect(plan(problem).outcome == Outcome::BAD_START_OR_GOAL, "a bad end is refused");
    }
    PlanOptions few;
    few.max_subgoals = 50;
    expect(plan(problems::bug_trap(false), few).outcome == Outcome::GAVE_UP,
           "the search ends at max_subgoals");
}

/// A cart with a bar that turns by half a turn, which is as far either way, past a disc on one side.
void half_turns_are_proved() {
    const double pi = std::acos(-1.0);
    cstk::RobotBuilder builder(2);
    cstk::Link cart, bar;
    cart.joint = CSTK_JOINT_PRISMATIC;
    cart.axis = {1, 0, 0};
    cart.lower = -1;
    cart.upper = 1.3;
    cart.body = cstk::Body::capsule({0, 0, 0}, {0.2, 0, 0}, 0.05, 2);
    builder.add_link(cart);
    bar.parent = 0;
    bar.joint = CSTK_JOINT_REVOLUTE;
    bar.at[3] = 0.2;
    bar.body = cstk::Body::capsule({0, 0, 0}, {0.8, 0, 0}, 0.1, 2);
    builder.add_link(bar);
    Problem problem;
    problem.name = "half turn";
    problem.robots = {builder.build()};
    problem.space = cstk::Space(problem.robots);
    problem.add_obstacle(cstk::Body::sphere(0.05, {0.26, -0.53, 0}, 2));
    problem.slide = {0.3, 0.9, 0.9};
    std::size_t found = 0, asked = 0;
    for (double from = -0.9; from < 1.3; from += 0.2) {
        for (double to = -0.9; to < 1.3; to += 0.2) {
            for (const std::size_t cells : {2, 3, 7}) {
                problem.start = {from, 0};
                problem.goal = {to, pi};
                problem.axes = {{0, cells}, {1, cells}};
                const Plan made = plan(problem, halved(2));
                expect(made.outcome != Outcome::NOT_PROVED, "half turns are not proved");
                found += made.outcome == Outcome::FOUND;
                expect(made.outcome != Outcome::FOUND || is_free(problem, made.path),
                       "a half turn meets the disc");
                ++asked;
            }
        }
    }
    std::printf("half turns: %zu of %zu found\n", found, asked);
    expect(2 * found > asked, "half of the half turns are found");
}

void axes_are_one_for_each_coordinate() {
    for (const std::size_t coordinate : {std::size_t{1}, std::size_t{3}, std::size_t{1} << 40}) {
        Problem problem = problems::bug_trap(true);
        problem.axes[0].coordinate = coordinate;
        bool is_refused = false;
        try {
            plan(problem);
        } catch (const std::invalid_argument &) {
            is_refused = true;
        }
        expect(is_refused, "axes that are not one for each coordinate are refused");
    }
}

} // namespace

int main(int count, char **arguments) {
    std::vector<Problem> known = problems::generated();
    if (count > 1 && std::ifstream(std::string(arguments[1]) + "/link6.stl")) {
        known.push_back(problems::puma560(arguments[1]));
    } else {
        std::printf("SKIPPED: the Puma 560, whose meshes are not there\n");
    }
    for (const Problem &problem : known) {
        if (problem.name == "bug_trap") {
            continue;
        }
        paths_are_proved_and_the_same_each_time(problem);
        halving_loses_no_solution(problem);
    }
    a_closed_trap_has_no_way_out();
    bad_ends_are_refused();
    half_turns_are_proved();
    axes_are_one_for_each_coordinate();
    std::printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
