// Whole motions: the proof of cstk_motion beside sampling, conservative advancement and bisection, and beside the same samplings by FCL
// and Coal, on the same motions, in turn:
//
//     motion [--models FOLDER] [--puma FOLDER] [--robots FOLDER] [--csv FILE] [--quick] [--seed N] [--only TEXT]
//
// The folders are those of the example write_scenes, of scripts/fetch_puma560.sh and of scripts/fetch_pinocchio.sh; scenes whose folder
// is not given are left out, and named. --quick measures fewer motions; --only asks for the scenes whose names hold a text. Ends with 1
// where an answer of the proof is wrong.
#include "measure.hpp"
#include "ours.hpp"
#include "peer_variants.hpp"
#include "scenes.hpp"
#include "segments.hpp"
#include "table.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// Radians; of bodies that move freely metres and radians together.
const double lengths[] = {0.05, 0.3, 1, 3, 4};

struct Options {
    std::string models, puma, robots, csv, only;
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
        if (name == "--models") {
            options.models = value();
        } else if (name == "--puma") {
            options.puma = value();
        } else if (name == "--robots") {
            options.robots = value();
        } else if (name == "--csv") {
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

Scenes scenes_of(const Options &options) {
    Scenes made;
    const auto add = [&](const std::string &folder, const char *what,
                         void (*make)(const std::string &, Scenes &)) {
        if (folder.empty()) {
            std::fprintf(stderr, "LEFT OUT: %s\n", what);
        } else {
            make(folder, made);
        }
    };
    add(options.models, "bodies that move freely, whose models are not there", add_rigid_scenes);
    add(options.puma, "the Puma 560, whose meshes could not be fetched", add_puma_scene);
    add(options.robots, "the Panda and the UR10, which could not be fetched", add_urdf_scenes);
    add(options.puma, "the plate, for it needs the Puma 560", add_plate_scenes);
    return made;
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

// What is wrong with the proof's answers.
struct Faults {
    std::size_t checked = 0, near = 0;
    std::vector<std::string> texts;

    void add(const Segments &segments) {
        checked += segments.free.size() + segments.hit.size();
        near += segments.near;
        texts.insert(texts.end(), segments.faults.begin(), segments.faults.end());
    }

    // Answers on the measured calls that differ from those when the motions were drawn.
    void add(const std::vector<Row> &rows, const std::vector<Segment> &segments) {
        for (const Row &row : rows) {
            for (const std::size_t at : row.which) {
                if (row.variant.rfind("proof", 0) == 0) {
                    texts.push_back(row.scene + ", " + row.variant + ": another answer than " +
                                    name_of(row.kind) + "\n  " + text_of(segments[at].ends));
                }
            }
        }
    }

    void print() const {
        std::printf("\n%zu answers of the proof checked by samples, %zu faults; %zu motions left "
                    "out as near\n",
                    checked, texts.size(), near);
        for (const std::string &text : texts) {
            std::printf("FAULT: %s\n", text.c_str());
        }
    }
};

void show(const Scene &scene, const Options &options, Table &table, Faults &faults) {
    const DrawOptions drawn = options.quick ? DrawOptions{10, 1000} : DrawOptions{80, 4000};
    // Seconds that a variant may take for a row.
    const double budget = options.quick ? 0.03 : 0.4;
    Random random(options.seed);
    std::vector<Segments> all;
    std::vector<Segment> trial;
    for (const double length : lengths) {
        all.push_back(draw_segments(scene, length, drawn, random));
        faults.add(all.back());
        for (const Kind kind : {Kind::free, Kind::hit}) {
            const std::vector<Segment> &found = all.back().of(kind);
            // Three of each kind and length.
            trial.insert(trial.end(), found.begin(),
                         found.begin() + std::min<std::ptrdiff_t>(
                                             3, static_cast<std::ptrdiff_t>(found.size())));
        }
    }
    std::vector<Variant> variants = our_variants(scene);
    for (Variant &variant : peer_variants(scene, trial)) {
        variants.push_back(std::move(variant));
    }
    for (const Segments &segments : all) {
        for (const Kind kind : {Kind::free, Kind::hit}) {
            const std::vector<Segment> &found = segments.of(kind);
            if (!found.empty()) {
                const std::vector<Row> rows =
                    measure(scene.name, found[0].length, kind, variants, found, budget);
                faults.add(rows, found);
                table.add(rows, found);
            }
        }
    }
}

int run(const Options &options) {
    std::printf("processor: %s\n", processor().c_str());
    Table table;
    Faults faults;
    for (const auto &scene : scenes_of(options)) {
        if (scene->name.find(options.only) != std::string::npos) {
            show(*scene, options, table, faults);
        }
    }
    table.finish();
    faults.print();
    if (!options.csv.empty()) {
        std::ofstream file(options.csv);
        if (!(file << table.csv())) {
            throw std::runtime_error("cannot write " + options.csv);
        }
        std::printf("\nwritten: %s\n", options.csv.c_str());
    }
    return faults.texts.empty() ? 0 : 1;
}

} // namespace

int main(int count, char **arguments) {
    try {
        return run(read(count, arguments));
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "motion: %s\n", failure.what());
        return 2;
    }
}
