// Motions as cstk_motion proves them, judged by samples of FCL:
//
//     fcl_motions [--puma FOLDER] [--panda FOLDER] [--motions N] [--samples N] [--from NAME]
//
// So many random motions in each workcell, from configurations that are free. What is proved free, whole or before a first contact,
// meets nothing at any sample. A campaign: --motions 300 --samples 10000; --from goes on with a workcell and those after it.
#include "built_in.hpp"
#include "check.hpp"
#include "fcl_cell.hpp"
#include "motion_bench_maker.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using problems::Configuration;
using problems::Problem;

const double lengths[] = {0.05, 0.3, 1, 3};

struct Counts {
    std::size_t free = 0, hits = 0, others = 0;
};

/// A free configuration and one so far from it, as Space::distance measures, or nearer.
std::pair<Configuration, Configuration> random_motion(const problems::Workcell &cell, cstk::Query &query, double length,
                                                      std::uint64_t &random) {
    Configuration from;
    do {
        from = cell.space.sample(random);
    } while (query.classify(cell.contact, from) == CSTK_CLASS_INSIDE);
    const Configuration towards = cell.space.sample(random);
    const double part = std::min(1.0, length / cell.space.distance(from, towards));
    return {from, cell.space.interpolate(from, towards, part)};
}

void judge(const Problem &problem, std::size_t motions, std::size_t samples) {
    const problems::Workcell &cell = *problem.workcell;
    const FclCell fcl(cell, FclCell::exact_way());
    cstk::Query query;
    std::uint64_t random = 7;
    Counts counts;
    for (std::size_t i = 0; i < motions; ++i) {
        const auto [from, to] = random_motion(cell, query, lengths[i % 4], random);
        const cstk_motion_result found = query.motion(cell.contact, from, to);
        const bool is_free = found.outcome == CSTK_MOTION_FREE;
        ++(is_free ? counts.free : found.outcome == CSTK_MOTION_HIT ? counts.hits : counts.others);
        const double proved = is_free ? 1 : found.times[0];
        // All before the first of a hit's times is free, not the time itself.
        for (std::size_t k = 0; k < samples + (is_free ? 1 : 0); ++k) {
            const double t = proved * static_cast<double>(k) / static_cast<double>(samples);
            expect(!fcl.meets(cell.space.interpolate(from, to, t)),
                   "motion " + std::to_string(i) + " of " + problem.scene + " is free at " + std::to_string(t) + ", says FCL");
        }
        if (found.outcome == CSTK_MOTION_HIT) {
            // Both may differ by rounding at the moment of contact, where a graze is soon over; FCL sees what meets a cylinder when it
            // is a millionth deep.
            const auto meets = [&](double after) {
                return fcl.meets(cell.space.interpolate(from, to, std::min(1.0, found.times[1] + after)));
            };
            expect(meets(0) || meets(1e-6) || meets(1e-4),
                   "motion " + std::to_string(i) + " of " + problem.scene + " meets something, says FCL");
        }
    }
    expect(counts.others == 0, "motions of " + problem.scene + " are free or not");
    expect(counts.free > 0 && counts.hits > 0, "motions of " + problem.scene + " are of both kinds");
    std::printf("%-18s %zu free, %zu hits, %zu samples of each by FCL: none contradicts\n", problem.scene.c_str(), counts.free,
                counts.hits, samples);
    std::fflush(stdout);
}

} // namespace

int main(int count, char **arguments) {
    try {
        std::map<std::string, std::string> given = {{"--puma", ""}, {"--panda", ""}, {"--motions", "40"},
                                                    {"--samples", "200"}, {"--from", ""}};
        for (int i = 1; i + 1 < count; i += 2) {
            given[arguments[i]] = arguments[i + 1];
        }
        std::vector<Problem> all = problems::built_in(given["--puma"]);
        if (!given["--panda"].empty()) {
            const problems::Panda panda(given["--panda"]);
            for (const std::string &scene : panda.scenes()) {
                all.push_back(panda.problems(scene, 1).front());
            }
        }
        bool has_begun = given["--from"].empty();
        for (const Problem &problem : all) {
            has_begun = has_begun || problem.scene == given["--from"];
            if (!has_begun) {
                continue;
            }
            judge(problem, std::stoul(given["--motions"]), std::stoul(given["--samples"]));
        }
        if (!has_begun) {
            throw std::runtime_error("no workcell is called " + given["--from"]);
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "FAILED: %s\n", error.what());
        return 1;
    }
}
