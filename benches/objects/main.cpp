// Queries of a C-object over 100, 1,000 and 10,000 s-objects, against FCL's
// DynamicAABBTreeCollisionManager on the same scenes and poses, in turn:
//
//     objects [--csv FILE] [--quick] [--seed N] [--only TEXT]
//
// --quick leaves out the largest size and measures less often; --only asks for the rows whose scene
// and name hold a text, such as "far classify". Ends with 1 where answers differ.
#include "fcl.hpp"
#include "ours.hpp"
#include "table.hpp"

#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// Witnesses are asked for within this.
const double epsilon = 0.005;
// FCL's distances are that good.
const double distances_allowed = 1e-6;

struct Options {
    std::string csv, only;
    bool quick = false;
    std::uint64_t seed = 1;
};

Options read(int count, char **arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string name = arguments[i];
        const auto value = [&] {
            if (++i == count) {
                throw std::runtime_error(name + " needs a value");
            }
            return std::string(arguments[i]);
        };
        if (name == "--csv") {
            options.csv = value();
        } else if (name == "--only") {
            options.only = value();
        } else if (name == "--seed") {
            options.seed = std::stoull(value());
        } else if (name == "--quick") {
            options.quick = true;
        } else {
            throw std::runtime_error("unknown option " + name);
        }
    }
    return options;
}

// A scene as both libraries hold it.
struct Size {
    Size(const Workplace &place, Scene made)
        : scene(std::move(made)), ours(place.arm().space, scene), fcl(place.arm(), scene) {}

    Scene scene;
    Ours ours;
    Fcl fcl;
};
using Sizes = std::vector<std::unique_ptr<Size>>;

template <class Ask> std::vector<Question> at_each(Sizes &sizes, Ask ask) {
    std::vector<Question> questions;
    for (const auto &size : sizes) {
        questions.push_back(ask(*size));
        questions.back().objects = size->scene.items.size();
    }
    return questions;
}

void ask_queries(const std::string &motion, const std::vector<Station> &at, Sizes &sizes,
                 Table &table) {
    const std::size_t count = at.size();
    table.row("classify " + motion, count, 0, at_each(sizes, [&](Size &s) {
                  return Question{0, s.ours.classify(at), s.fcl.classify(at)};
              }));
    table.row("distance " + motion, count, distances_allowed, at_each(sizes, [&](Size &s) {
                  return Question{0, s.ours.distance(at), s.fcl.distance(at)};
              }));
    table.row("witnesses " + motion, count, 0, at_each(sizes, [&](Size &s) {
                  return Question{0, s.ours.witnesses(at, epsilon), s.fcl.witnesses(at, epsilon)};
              }));
    table.row(
        "witnesses " + motion + " (FCL gives less)", count, 0, at_each(sizes, [&](Size &s) {
            return Question{0, s.ours.near_objects(at, epsilon), s.fcl.near_objects(at, epsilon)};
        }));
}

void ask_changes(const Workplace &place, std::size_t moved, std::size_t count, Sizes &sizes,
                 Table &table) {
    struct Moves {
        std::vector<Step> steps;
        Step home;
    };
    std::vector<std::unique_ptr<Moves>> all;
    const auto &at = place.coherent();
    const std::string name = std::to_string(moved) + " moved + classify";
    table.row(name, count, 0, at_each(sizes, [&](Size &s) {
                  all.push_back(std::make_unique<Moves>());
                  Moves &moves = *all.back();
                  moves.steps = place.steps(s.scene, moved, count);
                  moves.home = back_home(s.scene, moves.steps);
                  return Question{0, s.ours.after_moves(at, moves.steps, moves.home),
                                  s.fcl.after_moves(at, moves.steps, moves.home)};
              }));
}

void show(const char *title, const char *name, Sizes sizes, const Workplace &place, Table &table) {
    table.start(name, title);
    ask_queries("random", place.random(), sizes, table);
    ask_queries("coherent", place.coherent(), sizes, table);
    ask_changes(place, 1, 100, sizes, table);
    ask_changes(place, 100, 30, sizes, table);
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    const std::string key = "model name";
    for (std::string line; std::getline(file, line);) {
        if (line.compare(0, key.size(), key) == 0) {
            return line.substr(line.find(':') + 2);
        }
    }
    return "unknown";
}

int run(const Options &options) {
    const Workplace place(options.seed);
    std::vector<std::size_t> counts = {near_count, 1000};
    if (!options.quick) {
        counts.push_back(10000);
    }
    const auto sizes = [&](Scene (Workplace::*scene)(std::size_t) const) {
        Sizes made;
        for (const std::size_t count : counts) {
            made.push_back(std::make_unique<Size>(place, (place.*scene)(count)));
        }
        return made;
    };
    Table table(options.quick ? 3 : 9, options.only);
    std::printf("processor: %s\n", processor().c_str());
    show("100 objects near, the others far away", "far", sizes(&Workplace::far), place, table);
    show("All scattered at one density", "dense", sizes(&Workplace::dense), place, table);
    show("Crowded: ever more and smaller objects about the arm", "crowded",
         sizes(&Workplace::crowded), place, table);
    std::printf("\n%zu answers of FCL's compared, %zu differ\n", table.compared(),
                table.differing());
    if (!options.csv.empty()) {
        std::ofstream file(options.csv);
        if (!(file << table.csv())) {
            throw std::runtime_error("cannot write " + options.csv);
        }
        std::printf("\nwritten: %s\n", options.csv.c_str());
    }
    return table.differing() == 0 ? 0 : 1;
}

} // namespace

int main(int count, char **arguments) {
    try {
        return run(read(count, arguments));
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "objects: %s\n", failure.what());
        return 2;
    }
}
