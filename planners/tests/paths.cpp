// RRT-Connect's paths, judged by 10^4 samples of each segment, of this library and, where it is there, of FCL:
//
//     paths [--puma FOLDER] [--panda FOLDER]
#include "built_in.hpp"
#include "check.hpp"
#include "dense.hpp"
#include "motion_bench_maker.hpp"
#include "rrt_connect.hpp"
#include "shorten.hpp"

#ifdef WITH_FCL
#include "fcl_cell.hpp"
#endif

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using problems::Problem;

const std::size_t samples = 10000, cuts = 30;

void judge(const Problem &problem, const std::vector<problems::Configuration> &path, const std::string &what) {
    const problems::Workcell &cell = *problem.workcell;
    expect(path.size() >= 2, what + " is found");
    expect(path.front() == problem.start && path.back() == problem.goal, what + " leads from the start to the goal");
    cstk::Query query;
    expect(everywhere(cell.space, path, samples,
                      [&](const problems::Configuration &q) {
                          return query.classify(cell.contact, q) != CSTK_CLASS_INSIDE && cell.space.within_limits(q);
                      }),
           what + " is free and within the limits");
#ifdef WITH_FCL
    const FclCell fcl(cell, FclCell::exact_way());
    expect(everywhere(cell.space, path, samples, [&](const problems::Configuration &q) { return !fcl.meets(q); }),
           what + " is free, says FCL");
#endif
}

void solve(const Problem &problem, std::uint64_t seed) {
    const problems::Workcell &cell = *problem.workcell;
    const std::string what = "the path of " + problem.scene + " " + problem.name + " with seed " + std::to_string(seed);
    cstk::Query query;
    rrt_connect::Options options;
    options.range = problem.range;
    options.seed = seed;
    const std::vector<problems::Configuration> found =
        rrt_connect::plan(query, cell.space, cell.contact, problem.start, problem.goal, options).path;
    expect(found.size() >= 2, what + " is found");
    const double before = rrt_connect::length(cell.space, found);
    const std::vector<problems::Configuration> path =
        rrt_connect::shortened(query, cell.contact, found, cuts, seed);
    judge(problem, path, what);
    expect(rrt_connect::length(cell.space, path) <= before * (1 + 1e-12), what + " grows no longer by shortening");
}

void what_cannot_be_reached_gets_no_path() {
    const Problem problem = problems::windows();
    const problems::Workcell &cell = *problem.workcell;
    cstk::Query query;
    rrt_connect::Options options;
    options.max_samples = 100;
    problems::Configuration in_the_wall = problem.goal;
    in_the_wall[0] = 1;
    expect(rrt_connect::plan(query, cell.space, cell.contact, problem.start, in_the_wall, options).path.empty(),
           "a goal in contact gets no path");
    // Without windows.
    std::vector<problems::Obstacle> obstacles = cell.obstacles;
    obstacles.push_back(problems::box(cstk::translation(0.5, 0, 0), {0.02, 1.5, 1.5}));
    const problems::Workcell closed(cell.robots.front(), cell.space, obstacles, {});
    expect(rrt_connect::plan(query, closed.space, closed.contact, problem.start, problem.goal, options).path.empty(),
           "a goal behind a closed wall gets no path");
}

void ranges_and_ends_of_all_kinds_end() {
    const Problem problem = problems::windows();
    const problems::Workcell &cell = *problem.workcell;
    cstk::Query query;
    rrt_connect::Options options;
    const auto path = [&](const problems::Configuration &goal) {
        return rrt_connect::plan(query, cell.space, cell.contact, problem.start, goal, options).path;
    };
    for (const double range : {0.0, -1.0, std::nan("")}) {
        options.range = range;
        bool is_refused = false;
        try {
            path(problem.goal);
        } catch (const std::invalid_argument &) {
            is_refused = true;
        }
        expect(is_refused, "a range of " + std::to_string(range) + " is refused");
    }
    // Steps so short that the configuration does not change.
    options.range = 1e-300;
    options.max_samples = 10;
    path(problem.goal);
    options.range = 10;
    using Path = std::vector<problems::Configuration>;
    expect(path(problem.start) == Path{problem.start}, "a goal that is the start is reached at once");
    problems::Configuration near_by = problem.start;
    near_by[1] += 1e-3;
    expect(path(near_by) == Path{problem.start, near_by}, "a straight way is one motion");
}

void the_nearest_node_is_that_of_a_search_through_all(const cstk::Space &space, const std::string &what) {
    std::uint64_t random = 5;
    rrt_connect::Tree tree(space, space.sample(random));
    for (std::size_t i = 1; i < 500; ++i) {
        tree.add(space.sample(random), i - 1);
        const rrt_connect::Configuration q = space.sample(random);
        std::size_t nearest = 0;
        for (std::size_t node = 1; node < tree.size(); ++node) {
            if (space.distance(tree.at(node), q) < space.distance(tree.at(nearest), q)) {
                nearest = node;
            }
        }
        expect(tree.nearest(q).node == nearest, "the nearest node in the space of " + what);
    }
}

std::string value(int count, char **arguments, const std::string &name) {
    for (int i = 1; i + 1 < count; i += 2) {
        if (arguments[i] == name) {
            return arguments[i + 1];
        }
    }
    return {};
}

} // namespace

int main(int count, char **arguments) {
    try {
        const std::string puma = value(count, arguments, "--puma"), panda = value(count, arguments, "--panda");
        for (const Problem &problem : problems::built_in(puma)) {
            the_nearest_node_is_that_of_a_search_through_all(problem.workcell->space, problem.scene);
            solve(problem, 1);
        }
        what_cannot_be_reached_gets_no_path();
        ranges_and_ends_of_all_kinds_end();
        if (!panda.empty()) {
            const problems::Panda robot(panda);
            for (const char *scene : {"bookshelf_thin", "cage", "table_under_pick"}) {
                solve(robot.problems(scene, 1).front(), 1);
            }
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "FAILED: %s\n", error.what());
        return 1;
    }
}
