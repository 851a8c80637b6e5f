// Queries of a C-object over 100, 1,000 and 10,000 s-objects, against FCL's
// DynamicAABBTreeCollisionManager on the same scenes and poses, in turn:
//
//     objects [--csv FILE] [--quick] [--seed N] [--only TEXT]
//
// --quick leaves out the largest size and measures less often; --only asks for the rows whose scene
// and name hold a text, such as "far classify". Ends with 1 where answers differ.
#include "against.hpp"
#include "depths.hpp"
#include "fcl.hpp"
#include "octrees.hpp"
#include "ours.hpp"
#include "table.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
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
// Made when the first row asks for them.
class Sizes {
  public:
    using All = std::vector<std::unique_ptr<Size>>;

    explicit Sizes(std::function<All()> make) : make_(std::move(make)) {}

    const All &all() {
        if (all_.empty()) {
            all_ = make_();
        }
        return all_;
    }

  private:
    std::function<All()> make_;
    All all_;
};

template <class Ask> auto at_each(Sizes &sizes, Ask ask) {
    return [&sizes, ask] {
        std::vector<Question> questions;
        for (const auto &size : sizes.all()) {
            questions.push_back(ask(*size));
            questions.back().objects = size->scene.items.size();
        }
        return questions;
    };
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

// How many of a scene's objects move at once.
struct Moved {
    std::size_t part(std::size_t all) const { return all_of_them ? all : std::min(count, all); }
    std::string name() const { return all_of_them ? "all" : std::to_string(count); }

    std::size_t count;
    bool all_of_them;
};

void ask_changes(const Workplace &place, Moved moved, Jump jump, Timed timed, std::size_t count,
                 Sizes &sizes, Table &table) {
    struct Moves {
        std::vector<Step> steps;
        Step home;
    };
    const std::string what = moved.name() + (jump == Jump::far ? " jump" : " moved");
    const std::string name = timed == Timed::both     ? what + " + classify"
                             : timed == Timed::change ? what
                             : timed == Timed::first_class
                                 ? "first classify after " + what
                                 : "next classify after " + what;
    std::vector<std::unique_ptr<Moves>> all;
    const auto &at = place.coherent();
    table.row(name, count, 0, at_each(sizes, [&](Size &s) {
                  all.push_back(std::make_unique<Moves>());
                  Moves &moves = *all.back();
                  const std::size_t part = moved.part(s.scene.items.size());
                  moves.steps = place.steps(s.scene, part, count, jump);
                  moves.home = back_home(s.scene, moves.steps);
                  return Question{0, s.ours.after_moves(at, moves.steps, moves.home, timed),
                                  s.fcl.after_moves(at, moves.steps, moves.home, timed)};
              }));
}

void show(const char *title, const char *name, Sizes sizes, const Workplace &place, Table &table) {
    table.start(name, title);
    ask_queries("random", place.random(), sizes, table);
    ask_queries("coherent", place.coherent(), sizes, table);
    ask_changes(place, {1, false}, Jump::little, Timed::both, 100, sizes, table);
    ask_changes(place, {100, false}, Jump::little, Timed::both, 30, sizes, table);
}

// Changes alone, and the classes after them.
void show_changes(const char *title, const char *name, Sizes sizes, const Workplace &place,
                  Table &table) {
    table.start(name, title);
    for (const Jump jump : {Jump::little, Jump::far}) {
        for (const Timed timed : {Timed::change, Timed::first_class, Timed::next_class}) {
            ask_changes(place, {1, false}, jump, timed, 100, sizes, table);
            ask_changes(place, {100, false}, jump, timed, 30, sizes, table);
            ask_changes(place, {1000, false}, jump, timed, 30, sizes, table);
            ask_changes(place, {0, true}, jump, timed, 20, sizes, table);
        }
    }
}

// Objects against objects, among themselves and in two sets.
void show_pairs(const Options &options, Table &table) {
    const std::size_t queries = 30;
    std::vector<std::size_t> counts = {200, 1000};
    if (!options.quick) {
        counts.push_back(10000);
    }
    table.start("pairs", "Boxes against boxes, all moved before each query");
    for (const bool two_sets : {false, true}) {
        for (const bool with_moves : {false, true}) {
            const std::string where = two_sets ? "of two sets" : "of one set";
            const std::string what = where + (with_moves ? " + moves" : "");
            std::vector<std::unique_ptr<Against>> all;
            table.row("meeting pairs " + what, queries, 0, [&] {
                std::vector<Question> asked;
                for (const std::size_t count : counts) {
                    all.push_back(std::make_unique<Against>(meeting_boxes(count, queries, options.seed), two_sets));
                    asked.push_back(all.back()->meeting(with_moves));
                }
                return asked;
            });
            table.row("nearest pair " + what, queries, distances_allowed, [&] {
                std::vector<Question> asked;
                for (const std::size_t count : counts) {
                    all.push_back(std::make_unique<Against>(boxes_apart(count, queries, options.seed), two_sets));
                    asked.push_back(all.back()->nearest(with_moves));
                }
                return asked;
            });
        }
    }
}

void show_octrees(const Options &options, Table &table) {
    const std::size_t queries = 60;
    std::vector<std::size_t> counts = {1000, 10000};
    if (!options.quick) {
        counts.push_back(100000);
    }
    table.start("octrees", "Octrees: 64 cells change at a time, a body moves about the cells; n is the number of cells");
    const auto row = [&](const std::string &name, double allowed, const std::function<Question(OctreeScene &)> &ask) {
        std::vector<std::unique_ptr<OctreeScene>> all;
        table.row(name, queries, allowed, [&] {
            std::vector<Question> asked;
            for (const std::size_t count : counts) {
                all.push_back(std::make_unique<OctreeScene>(count, queries, options.seed));
                asked.push_back(ask(*all.back()));
            }
            return asked;
        });
    };
    row("cells change", 0, [](OctreeScene &scene) { return scene.change(false); });
    row("cells change, then body meets", 0, [](OctreeScene &scene) { return scene.change(true); });
    row("body meets", 0, [](OctreeScene &scene) { return scene.meets(); });
    row("body's distance", distances_allowed, [](OctreeScene &scene) { return scene.nearest(); });
}

void show_depths(const Options &options, Table &table) {
    const std::size_t queries = 100;
    table.start("depths", "Depths: of two hulls (n: their corners), of two unions (n: the boxes of each)");
    table.row("depth of hulls", queries, 0, [&] {
        return std::vector<Question>{depth_of_hulls(queries, options.seed)};
    });
    table.row("depth of unions", queries, 0, [&] {
        std::vector<Question> asked;
        for (const std::size_t parts : {1, 2, 4, 8}) {
            asked.push_back(depth_of_unions(parts, queries, options.seed));
        }
        return asked;
    });
    table.start("curved", "Distances of two bent sheets, Bezier patches of degree 3; n is the number of triangles of one");
    for (const double gap : {1e-2, 1e-3, 1e-4}) {
        for (const bool refined : {true, false}) {
            const std::string name = (refined ? "refined to " : "built to ") + std::to_string(gap).substr(0, 6);
            table.row(name, queries, 0, [&] {
                return std::vector<Question>{distance_of_sheets(gap, refined, queries, options.seed)};
            });
        }
    }
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
        return Sizes([&place, &counts, scene] {
            Sizes::All made;
            for (const std::size_t count : counts) {
                made.push_back(std::make_unique<Size>(place, (place.*scene)(count)));
            }
            return made;
        });
    };
    Table table(options.quick ? 3 : 9, options.only);
    std::printf("processor: %s\n", processor().c_str());
    show("100 objects near, the others far away", "far", sizes(&Workplace::far), place, table);
    show("All scattered at one density", "dense", sizes(&Workplace::dense), place, table);
    show("Crowded: ever more and smaller objects about the arm", "crowded",
         sizes(&Workplace::crowded), place, table);
    show_changes("Objects that move, all scattered at one density", "moves",
                 sizes(&Workplace::dense), place, table);
    show_pairs(options, table);
    show_octrees(options, table);
    show_depths(options, table);
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
