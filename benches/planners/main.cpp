// SANDROS and RRT-Connect over this library, and OMPL's RRTConnect over this library and over FCL, on the same problems with the same
// seeds:
//
//     planners [--panda FOLDER] [--puma FOLDER] [--csv FILE] [--quick] [--seed N] [--only TEXT] [--samples N]
//
// The folders are those of scripts/fetch_motion_bench_maker.sh and scripts/fetch_puma560.sh; a scene without one is left out and
// named. --quick takes fewer problems and runs, --only the scenes whose names hold a text: --only sandros those of SANDROS. Each path
// is judged by FCL at so many places of each segment, 10^4, or 10^3 with --quick: that takes most of the time. An OMPL planner that
// finds no path ends after 20 seconds.
#include "built_in.hpp"
#include "dense.hpp"
#include "fcl_cell.hpp"
#include "motion_bench_maker.hpp"
#include "results.hpp"
#include "sandros_problems.hpp"
#include "shorten.hpp"

#include <ompl/util/Console.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using problems::Problem;

struct Arguments {
    std::string panda, puma, csv, only;
    bool quick = false;
    std::uint64_t seed = 1;
    /// Of each segment; 0 for the default.
    std::size_t samples = 0;

    /// Of each scene of MotionBenchMaker, and runs of each other problem.
    std::size_t problem_count() const { return quick ? 10 : 100; }
    std::size_t run_count() const { return quick ? 10 : 50; }

    std::size_t sample_count() const { return samples > 0 ? samples : quick ? 1000 : 10000; }

    bool takes(const std::string &scene) const { return scene.find(only) != std::string::npos; }
};

Arguments read(int count, char **given) {
    Arguments arguments;
    const std::map<std::string, std::string *> texts = {
        {"--panda", &arguments.panda}, {"--puma", &arguments.puma}, {"--csv", &arguments.csv}, {"--only", &arguments.only}};
    for (int i = 1; i < count; ++i) {
        const std::string name = given[i];
        if (name == "--quick") {
            arguments.quick = true;
            continue;
        }
        if (i + 1 == count) {
            throw std::runtime_error(name + " is unknown or needs a value");
        }
        const std::string value = given[++i];
        if (texts.count(name) != 0) {
            *texts.at(name) = value;
        } else if (name == "--seed") {
            arguments.seed = std::stoull(value);
        } else if (name == "--samples") {
            arguments.samples = std::stoul(value);
        } else {
            throw std::runtime_error("unknown option " + name);
        }
    }
    return arguments;
}

class Bench {
  public:
    explicit Bench(const Arguments &arguments) : arguments_(arguments), csv_(arguments.csv) {
        csv_ << "problem,planner,library,milliseconds,checks,invalid\n";
    }

    /// Each problem with so many seeds, by one variant after the other, as a planner runs that has the processor's caches for itself.
    std::vector<Results> measure(const std::vector<Problem> &scene, std::size_t runs, const std::vector<Variant> &variants) {
        const std::string way = FclCell::fastest_way(*scene.front().workcell);
        std::vector<Results> results;
        for (const Variant &variant : variants) {
            results.push_back(measured(scene, runs, variant, way));
        }
        print(scene.front().scene, variants, results);
        return results;
    }

    static void print(const std::string &scene, const std::vector<Variant> &variants, const std::vector<Results> &results) {
        for (std::size_t i = 0; i < variants.size(); ++i) {
            results[i].print(scene, variants[i], results.back());
        }
    }

  private:
    /// Of a tenth of the seeds, where the variant takes none. Paths are judged when all are planned.
    Results measured(const std::vector<Problem> &scene, std::size_t runs, const Variant &variant, const std::string &way) {
        std::vector<std::vector<Run>> planned;
        // Each problem has seeds of its own.
        std::uint64_t seed = arguments_.seed;
        for (const Problem &problem : scene) {
            planned.emplace_back();
            for (std::size_t k = 0; k < runs; ++k, ++seed) {
                if (variant.has_seeds || k % 10 == 0) {
                    planned.back().push_back(variant.solve({problem, seed, way}));
                }
            }
        }
        Results results;
        for (std::size_t i = 0; i < scene.size(); ++i) {
            const FclCell judge(*scene[i].workcell, FclCell::exact_way());
            for (const Run &run : planned[i]) {
                results.add(judged(scene[i], variant, run, judge));
            }
        }
        return results;
    }

    Result judged(const Problem &problem, const Variant &variant, const Run &run, const FclCell &judge) {
        const cstk::Space &space = problem.workcell->space;
        const auto is_free = [&](const problems::Configuration &q) { return !judge.meets(q); };
        const bool invalid = !everywhere(space, run.path, arguments_.sample_count(), is_free);
        csv_ << problem.scene << ' ' << problem.name << ',' << variant.planner << ',' << variant.library << ','
             << run.milliseconds << ',' << run.checks << ',' << (run.path.empty() ? "" : invalid ? "1" : "0") << '\n';
        const std::size_t motions = run.path.empty() ? 0 : run.path.size() - 1;
        return {run.milliseconds, run.checks, run.answer, invalid, motions, rrt_connect::length(space, run.path)};
    }

    const Arguments &arguments_;
    std::ofstream csv_;
};

void measure_sandros(const Arguments &arguments, Bench &bench) {
    for (const SandrosProblem &each : sandros_problems(arguments.puma)) {
        if (arguments.takes(each.problem.scene)) {
            std::vector<Variant> all = variants();
            all.insert(all.begin(), each.sandros);
            // Where there is no path most planners search until their time is over.
            bench.measure({each.problem}, each.has_path ? arguments.run_count() : 1, all);
        }
    }
}

void measure_panda(const Arguments &arguments, Bench &bench) {
    const problems::Panda panda(arguments.panda);
    std::vector<Results> all(variants().size());
    for (const std::string &scene : panda.scenes()) {
        if (!arguments.takes(scene)) {
            continue;
        }
        const std::vector<Results> results = bench.measure(panda.problems(scene, arguments.problem_count()), 1, variants());
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].add(results[i]);
        }
    }
    if (arguments.only.empty()) {
        Bench::print("all of the Panda", variants(), all);
    }
}

void measure_all(const Arguments &arguments) {
    Bench bench(arguments);
    Results::print_head();
    measure_sandros(arguments, bench);
    for (const Problem &problem : problems::built_in(arguments.puma)) {
        if (arguments.takes(problem.scene)) {
            bench.measure({problem}, arguments.run_count(), variants());
        }
    }
    if (!arguments.panda.empty()) {
        measure_panda(arguments, bench);
    }
}

} // namespace

int main(int count, char **given) {
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
        const Arguments arguments = read(count, given);
        measure_all(arguments);
        for (const auto &[name, folder] : {std::pair("MotionBenchMaker's Panda", arguments.panda),
                                           std::pair("the Puma 560", arguments.puma)}) {
            if (folder.empty()) {
                std::printf("SKIPPED: %s, which could not be fetched\n", name);
            }
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "planners: %s\n", error.what());
        return 1;
    }
}
