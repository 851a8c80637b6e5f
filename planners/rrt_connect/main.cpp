// Solves problems by RRT-Connect, prints a table, and draws the first path of each scene:
//
//     rrt_connect [--panda FOLDER] [--puma FOLDER] [--problems N] [--seed N] [--cuts N] [--csv FILE] [--pictures FOLDER]
//
// The folders are those of scripts/fetch_motion_bench_maker.sh and scripts/fetch_puma560.sh; without one its robot is left out. Times
// are those of planning; then so many cuts of corners are tried (100). The last row is of all problems together. The pictures are .glb
// files. Ends with 1 where a problem is not solved.
#include "built_in.hpp"
#include "motion_bench_maker.hpp"
#include "picture.hpp"
#include "rrt_connect.hpp"
#include "shorten.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using problems::Problem;

/// Of a path, in a picture.
const std::size_t places = 12;

struct Arguments {
    std::string panda, puma, csv, pictures;
    std::size_t problems = 10;
    std::size_t cuts = 100;
    std::uint64_t seed = 1;
};

Arguments read(int count, char **given) {
    Arguments arguments;
    const std::map<std::string, std::string *> texts = {{"--panda", &arguments.panda},
                                                        {"--puma", &arguments.puma},
                                                        {"--csv", &arguments.csv},
                                                        {"--pictures", &arguments.pictures}};
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string name = given[i], value = given[i + 1];
        if (texts.count(name) != 0) {
            *texts.at(name) = value;
        } else if (name == "--problems") {
            arguments.problems = std::stoul(value);
        } else if (name == "--cuts") {
            arguments.cuts = std::stoul(value);
        } else if (name == "--seed") {
            arguments.seed = std::stoull(value);
        } else {
            throw std::runtime_error("unknown option " + name);
        }
    }
    if (count % 2 == 0) {
        throw std::runtime_error(std::string(given[count - 1]) + " needs a value");
    }
    return arguments;
}

std::vector<std::vector<Problem>> scenes_of(const Arguments &arguments) {
    std::vector<std::vector<Problem>> scenes;
    for (Problem &problem : problems::built_in(arguments.puma)) {
        scenes.push_back({std::move(problem)});
    }
    if (!arguments.panda.empty()) {
        const problems::Panda panda(arguments.panda);
        for (const std::string &scene : panda.scenes()) {
            scenes.push_back(panda.problems(scene, arguments.problems));
        }
    }
    return scenes;
}

struct Solution {
    rrt_connect::Plan plan;
    double milliseconds, length;
    /// After corners were cut.
    std::vector<problems::Configuration> path;
    double shortened;
};

Solution solve(const Problem &problem, const Arguments &arguments, cstk::Query &query) {
    const problems::Workcell &cell = *problem.workcell;
    rrt_connect::Options options;
    options.range = problem.range;
    options.seed = arguments.seed;
    const auto start = std::chrono::steady_clock::now();
    const rrt_connect::Plan plan =
        rrt_connect::plan(query, cell.space, cell.contact, problem.start, problem.goal, options);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    const std::vector<problems::Configuration> path =
        rrt_connect::shortened(query, cell.contact, plan.path, arguments.cuts, arguments.seed);
    return {plan, time.count(), rrt_connect::length(cell.space, plan.path), path, rrt_connect::length(cell.space, path)};
}

std::vector<Solution> solve_scene(const std::vector<Problem> &scene, const Arguments &arguments, std::ostream &csv) {
    cstk::Query query;
    std::vector<Solution> solutions;
    for (const Problem &problem : scene) {
        const Solution found = solve(problem, arguments, query);
        csv << problem.scene << ' ' << problem.name << ',' << found.milliseconds << ',' << found.plan.checks << ','
            << found.plan.path.size() << ',' << found.length << ',' << found.shortened << '\n';
        if (!found.path.empty() && !arguments.pictures.empty() && &problem == &scene.front()) {
            draw_path(*problem.workcell, found.path, places, arguments.pictures + "/" + problem.scene + ".glb");
        }
        solutions.push_back(found);
    }
    return solutions;
}

/// Returns whether all are solved.
bool print_row(const std::string &name, const std::vector<Solution> &solutions) {
    std::vector<double> times;
    double checks = 0, length = 0, shortened = 0;
    std::size_t solved = 0;
    for (const Solution &found : solutions) {
        times.push_back(found.milliseconds);
        checks += static_cast<double>(found.plan.checks);
        length += found.length;
        shortened += found.shortened;
        solved += !found.path.empty();
    }
    std::sort(times.begin(), times.end());
    const auto count = static_cast<double>(solutions.size());
    std::printf("%-18s %3zu of %3zu %9.2f %9.2f %8.0f %8.1f %10.1f\n", name.c_str(), solved, solutions.size(),
                times[times.size() / 2], times[times.size() * 95 / 100], checks / count, length / count, shortened / count);
    return solved == solutions.size();
}

} // namespace

int main(int count, char **given) {
    try {
        const Arguments arguments = read(count, given);
        std::ofstream csv(arguments.csv);
        csv << "problem,milliseconds,checks,points,length,shortened\n";
        std::printf("scene                  solved median ms   95 %% ms   checks   length  shortened\n");
        std::vector<Solution> all;
        for (const std::vector<Problem> &scene : scenes_of(arguments)) {
            const std::vector<Solution> solutions = solve_scene(scene, arguments, csv);
            print_row(scene.front().scene, solutions);
            all.insert(all.end(), solutions.begin(), solutions.end());
        }
        return print_row("all", all) ? 0 : 1;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "rrt_connect: %s\n", error.what());
        return 1;
    }
}
