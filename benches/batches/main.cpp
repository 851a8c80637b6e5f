// Throughput of batches on 1 and 2 threads beside single calls: the Puma 560 and the Panda, against themselves and 20 or 500 boxes,
// at random and at coherent configurations:
//
//     batches [--puma FOLDER] [--panda FOLDER] [--quick] [--seed N] [--only TEXT]
//
// The folders are those of scripts/fetch_puma560.sh and scripts/fetch_motion_bench_maker.sh; a robot without one is left out and
// named. --quick takes fewer configurations, --only the rows whose robot, question or configurations hold a text. All ways are asked
// in turn, and the least time of each counts. Ends with 1 where an answer differs in a bit.
//
// A second table has the classes beside FCL and Pinocchio with Coal. What differs there is counted: they have tolerances of their own.
#include "cells.hpp"
#include "peers.hpp"
#include "questions.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>

namespace {

struct Arguments {
    std::string puma, panda, only;
    bool quick = false;
    std::uint64_t seed = 1;
};

Arguments read(int count, char **given) {
    Arguments arguments;
    const std::map<std::string, std::string *> texts = {
        {"--puma", &arguments.puma}, {"--panda", &arguments.panda}, {"--only", &arguments.only}};
    for (int i = 1; i < count; ++i) {
        const std::string name = given[i];
        if (name == "--quick") {
            arguments.quick = true;
        } else if (i + 1 == count) {
            throw std::runtime_error(name + " is unknown or needs a value");
        } else if (texts.count(name) != 0) {
            *texts.at(name) = given[++i];
        } else if (name == "--seed") {
            arguments.seed = std::stoull(given[++i]);
        } else {
            throw std::runtime_error("unknown option " + name);
        }
    }
    return arguments;
}

/// A way to answer, its least time and its answers.
struct Way {
    std::function<Answers()> ask;
    double seconds = 1e300;
    Answers answers = {};

    void run() {
        const auto start = std::chrono::steady_clock::now();
        answers = ask();
        seconds = std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
};

bool same(const Answers &a, const Answers &b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// One row; whether all ways agree.
bool show(const Cell &cell, const std::string &where, const Question &question, const std::vector<double> &q, std::size_t count,
          std::size_t passes) {
    cstk::Query query;
    const cstk::Batch one, two;
    Way ways[] = {{[&] { return question.one_by_one(query, q, count); }},
                  {[&] { return question.batch(one, 1, q, count); }},
                  {[&] { return question.batch(two, 2, q, count); }}};
    for (std::size_t pass = 0; pass < passes; ++pass) {
        for (Way &way : ways) {
            way.run();
        }
    }
    const double items = static_cast<double>(ways[0].answers.size());
    const bool agree = same(ways[0].answers, ways[1].answers) && same(ways[0].answers, ways[2].answers);
    std::printf("| %s | %zu | %s | %s | %.0f | %.0f | %.0f | %.0f | %.2f | %.2f | %s |\n", cell.robot.c_str(), cell.objects, where.c_str(),
                question.name.c_str(), items, items / ways[0].seconds, items / ways[1].seconds, items / ways[2].seconds,
                ways[0].seconds / ways[1].seconds, ways[0].seconds / ways[2].seconds, agree ? "yes" : "NO");
    std::fflush(stdout);
    return agree;
}

/// A row for each peer, asked in turn with batches on as many threads.
void show_peers(const Cell &cell, const std::string &where, const std::vector<PeerBatch> &peers, const Question &classes,
                const std::vector<double> &q, std::size_t count, std::size_t passes) {
    for (std::size_t i = 0; i < peers.size(); ++i) {
        const auto threads = static_cast<std::uint32_t>(1 + i % 2);
        const cstk::Batch batch;
        PeerAnswers theirs;
        Way ways[] = {{[&] { return classes.batch(batch, threads, q, count); }},
                      {[&] {
                          theirs = peers[i].ask(q, count);
                          return Answers();
                      }}};
        for (std::size_t pass = 0; pass < passes; ++pass) {
            for (Way &way : ways) {
                way.run();
            }
        }
        std::size_t differ = 0;
        for (std::size_t k = 0; k < count; ++k) {
            differ += (ways[0].answers[k] == CSTK_CLASS_INSIDE) != (theirs[k] != 0) ? 1 : 0;
        }
        const double items = static_cast<double>(count);
        std::printf("| %s | %zu | %s | %s | %zu | %.0f | %.0f | %.2f | %zu |\n", cell.robot.c_str(), cell.objects, where.c_str(),
                    peers[i].name.c_str(), count, items / ways[1].seconds, items / ways[0].seconds,
                    ways[1].seconds / ways[0].seconds, differ);
        std::fflush(stdout);
    }
}

void run_peers(const Arguments &arguments) {
    const std::size_t most = arguments.quick ? 1000 : 20000;
    std::printf("\n| robot | boxes | configurations | peer, on so many threads | items | peer, 1/s | batch, 1/s | ratio | differ |\n"
                "|---|---|---|---|---|---|---|---|---|\n");
    for (const Cell &cell : cells(arguments.puma, arguments.panda, arguments.seed)) {
        const cstk::Space &space = cell.workcell->space;
        const std::string row = cell.robot + ' ' + std::to_string(cell.objects) + " peers";
        if (row.find(arguments.only) == std::string::npos) {
            continue;
        }
        std::vector<PeerBatch> peers = fcl_loops(*cell.workcell);
        for (PeerBatch &peer : pinocchio_batches(*cell.workcell)) {
            peers.push_back(std::move(peer));
        }
        const Question classes = questions(*cell.workcell).front();
        const std::size_t passes = arguments.quick ? 3 : 5;
        show_peers(cell, "random", peers, classes, random_configurations(space, most, arguments.seed), most, passes);
        show_peers(cell, "coherent", peers, classes, coherent_configurations(space, most, arguments.seed), most, passes);
    }
}

int run(const Arguments &arguments) {
    for (const auto &[name, folder] : {std::pair("Puma 560", arguments.puma), std::pair("Panda", arguments.panda)}) {
        if (folder.empty()) {
            std::fprintf(stderr, "SKIPPED: the %s, whose files are not there\n", name);
        }
    }
    const std::size_t most = arguments.quick ? 4000 : 100000;
    std::printf("| robot | boxes | configurations | question | items | one by one, 1/s | batch on 1 thread, 1/s | on 2 threads, 1/s | "
                "ratio 1 | ratio 2 | equal |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    bool agree = true;
    for (const Cell &cell : cells(arguments.puma, arguments.panda, arguments.seed)) {
        const cstk::Space &space = cell.workcell->space;
        const std::pair<std::string, std::vector<double>> sets[] = {
            {"random", random_configurations(space, most, arguments.seed)},
            {"coherent", coherent_configurations(space, most, arguments.seed)}};
        for (const auto &[where, q] : sets) {
            for (const Question &question : questions(*cell.workcell)) {
                const std::string row = cell.robot + ' ' + std::to_string(cell.objects) + ' ' + where + ' ' + question.name;
                if (row.find(arguments.only) != std::string::npos) {
                    agree = show(cell, where, question, q, most / question.share, arguments.quick ? 3 : 5) && agree;
                }
            }
        }
    }
    run_peers(arguments);
    return agree ? 0 : 1;
}

} // namespace

int main(int count, char **arguments) {
    try {
        return run(read(count, arguments));
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "batches: %s\n", failure.what());
        return 2;
    }
}
