// RRT-Connect over this library, and OMPL's RRTConnect over this library and over FCL, on the same problems with the same seeds:
//
//     planners [--panda FOLDER] [--puma FOLDER] [--csv FILE] [--quick] [--seed N] [--only TEXT] [--samples N]
//
// The folders are those of scripts/fetch_motion_bench_maker.sh and scripts/fetch_puma560.sh; a scene without one is left out and
// named. --quick takes fewer problems and runs, --only the scenes whose names hold a text. Each path is judged by FCL at so many places
// of each segment, 10^4, or 10^3 with --quick: that takes most of the time. A planner that finds no path ends after 20 seconds.
#include "built_in.hpp"
#include "dense.hpp"
#include "fcl_cell.hpp"
#include "motion_bench_maker.hpp"
#include "variants.hpp"

#include <ompl/util/Console.h>

#include <algorithm>
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

struct Result {
    bool solved, invalid;
    double milliseconds;
    std::size_t checks;
};

/// The results of all runs of a variant.
struct Results {
    std::vector<Result> runs;

    double milliseconds(std::size_t percent) const {
        std::vector<double> times;
        for (const Result &run : runs) {
            times.push_back(run.milliseconds);
        }
        std::sort(times.begin(), times.end());
        return times[std::min(times.size() - 1, times.size() * percent / 100)];
    }

    double mean_checks() const {
        double sum = 0;
        for (const Result &run : runs) {
            sum += static_cast<double>(run.checks);
        }
        return sum / static_cast<double>(runs.size());
    }

    long count(bool Result::*member) const {
        return std::count_if(runs.begin(), runs.end(), [&](const Result &run) { return run.*member; });
    }
};

using ByVariant = std::vector<Results>;

void print(const std::string &scene, const ByVariant &results) {
    const std::vector<Variant> names = variants();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Results &of = results[i];
        std::printf("| %s | %s | %s | %zu | %ld | %.2f | %.2f | %.2f | %.0f | %ld |\n", scene.c_str(), names[i].planner.c_str(),
                    names[i].library.c_str(), of.runs.size(), of.count(&Result::solved), of.milliseconds(50),
                    of.milliseconds(95), results.back().milliseconds(50) / of.milliseconds(50), of.mean_checks(),
                    of.count(&Result::invalid));
    }
    std::fflush(stdout);
}

class Bench {
  public:
    explicit Bench(const Arguments &arguments) : arguments_(arguments), variants_(variants()), csv_(arguments.csv) {
        csv_ << "problem,planner,library,milliseconds,checks,invalid\n";
    }

    /// Each problem with so many seeds, by all variants in turn.
    ByVariant measure(const std::vector<Problem> &scene, std::size_t runs) {
        const std::string way = FclCell::fastest_way(*scene.front().workcell);
        ByVariant results(variants_.size());
        // Each problem has seeds of its own.
        std::uint64_t seed = arguments_.seed;
        for (const Problem &problem : scene) {
            const FclCell judge(*problem.workcell, FclCell::exact_way());
            for (std::size_t k = 0; k < runs; ++k, ++seed) {
                for (std::size_t i = 0; i < variants_.size(); ++i) {
                    const Run run = variants_[i].solve({problem, seed, way});
                    results[i].runs.push_back(judged(problem, variants_[i], run, judge));
                }
            }
        }
        print(scene.front().scene, results);
        return results;
    }

  private:
    Result judged(const Problem &problem, const Variant &variant, const Run &run, const FclCell &judge) {
        const auto is_free = [&](const problems::Configuration &q) { return !judge.meets(q); };
        const bool invalid = !everywhere(problem.workcell->space, run.path, arguments_.sample_count(), is_free);
        csv_ << problem.scene << ' ' << problem.name << ',' << variant.planner << ',' << variant.library << ','
             << run.milliseconds << ',' << run.checks << ',' << (run.path.empty() ? "" : invalid ? "1" : "0") << '\n';
        return {!run.path.empty(), invalid, run.milliseconds, run.checks};
    }

    const Arguments &arguments_;
    std::vector<Variant> variants_;
    std::ofstream csv_;
};

void measure_all(const Arguments &arguments) {
    Bench bench(arguments);
    std::printf("| scene | planner | edges | runs | solved | median ms | 95 %% ms | times faster | checks | invalid |\n"
                "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (const Problem &problem : problems::built_in(arguments.puma)) {
        if (arguments.takes(problem.scene)) {
            bench.measure({problem}, arguments.run_count());
        }
    }
    if (!arguments.panda.empty()) {
        const problems::Panda panda(arguments.panda);
        ByVariant all(variants().size());
        for (const std::string &scene : panda.scenes()) {
            if (!arguments.takes(scene)) {
                continue;
            }
            const ByVariant results = bench.measure(panda.problems(scene, arguments.problem_count()), 1);
            for (std::size_t i = 0; i < all.size(); ++i) {
                all[i].runs.insert(all[i].runs.end(), results[i].runs.begin(), results[i].runs.end());
            }
        }
        if (arguments.only.empty()) {
            print("all of the Panda", all);
        }
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
