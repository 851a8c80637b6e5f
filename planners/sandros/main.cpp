// Plans problems by name, all it has without one:
//
//   sandros [--puma FOLDER] [--halvings N] [--csv] [--out FOLDER] [PROBLEM ...]
//
// --puma names the folder with the meshes of the Puma 560, without which that problem is not known
// (scripts/fetch_puma560.sh).
// --halvings says how fine the planner may go. --csv prints a table. --out names a folder for
// pictures (NAME.glb moves, NAME_0.glb to NAME_3.glb hold still) and paths (NAME.csv, a
// configuration a line).
#include "path.hpp"
#include "pictures/picture.hpp"
#include "planner.hpp"
#include "problems/problems.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace {

using namespace sandros;

/// Pictures along a path.
const int MOMENTS = 4;

struct Arguments {
    PlanOptions options;
    std::string puma, out;
    bool csv = false;
    std::vector<std::string> problems;
};

Arguments read_arguments(int count, char **given) {
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const std::string word = given[i];
        const auto value = [&] {
            if (++i == count) {
                throw std::invalid_argument(word + " needs a value");
            }
            return std::string(given[i]);
        };
        if (word == "--puma") {
            arguments.puma = value();
        } else if (word == "--halvings") {
            arguments.options.halvings = static_cast<unsigned>(std::stoul(value()));
        } else if (word == "--out") {
            arguments.out = value();
        } else if (word == "--csv") {
            arguments.csv = true;
        } else if (word.rfind("--", 0) == 0) {
            throw std::invalid_argument("unknown option " + word);
        } else {
            arguments.problems.push_back(word);
        }
    }
    return arguments;
}

std::vector<Problem> chosen_problems(const Arguments &arguments) {
    std::vector<Problem> known = problems::generated();
    if (!arguments.puma.empty()) {
        known.insert(known.begin(), problems::puma560(arguments.puma));
    }
    if (arguments.problems.empty()) {
        return known;
    }
    std::vector<Problem> chosen;
    for (const std::string &name : arguments.problems) {
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const Problem &p) { return p.name == name; });
        if (found == known.end()) {
            throw std::invalid_argument("no problem is called " + name);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

void write_path(const Path &path, const std::string &file) {
    std::ofstream out(file);
    out.precision(17);
    for (const Configuration &q : path) {
        for (std::size_t i = 0; i < q.size(); ++i) {
            out << (i > 0 ? "," : "") << q[i];
        }
        out << "\n";
    }
    out.close();
    if (!out) {
        throw std::runtime_error(file + " cannot be written");
    }
}

void report(const Problem &problem, const Plan &made, double milliseconds) {
    std::printf("%s: %s, %.0f ms\n", problem.name.c_str(), name_of(made.outcome), milliseconds);
    std::printf("  %zu subgoals, %zu refined; %zu attempts: %zu motions, %zu slides\n",
                made.work.subgoals, made.work.refinements, made.work.attempts,
                made.work.local.motions, made.work.local.slides);
    if (made.outcome == Outcome::FOUND) {
        std::printf("  %zu motions, length %.2f\n", made.path.size() - 1,
                    length(problem, made.path));
    }
}

void draw(const Problem &problem, const Path &path, const std::string &stem) {
    if (path.empty()) {
        pictures::draw_moment(problem, {problem.start}, 0, stem + "_0.glb");
        return;
    }
    for (int i = 0; i < MOMENTS; ++i) {
        pictures::draw_moment(problem, path, i / (MOMENTS - 1.0),
                              stem + "_" + std::to_string(i) + ".glb");
    }
    pictures::draw_motion(problem, path, stem + ".glb");
    write_path(path, stem + ".csv");
}

/// False if the path is not what the planner promises.
bool run(const Problem &problem, const Arguments &arguments) {
    const auto begin = std::chrono::steady_clock::now();
    Plan made = plan(problem, arguments.options);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    const bool valid = made.outcome != Outcome::FOUND || is_free(problem, made.path);
    if (arguments.csv) {
        std::printf("%s,sandros,cstk,%.3f,%zu,%d\n", problem.name.c_str(), took.count(),
                    made.work.checks(), valid ? 0 : 1);
    } else {
        report(problem, made, took.count());
    }
    if (!arguments.out.empty()) {
        const std::string stem = arguments.out + "/" + problem.name;
        draw(problem, made.path, stem);
    }
    return valid;
}

} // namespace

int main(int count, char **given) {
    try {
        const Arguments arguments = read_arguments(count, given);
        if (arguments.csv) {
            std::printf("problem,planner,library,milliseconds,checks,invalid\n");
        }
        bool valid = true;
        for (const Problem &problem : chosen_problems(arguments)) {
            valid = run(problem, arguments) && valid;
        }
        return valid ? 0 : 1;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "sandros: %s\n", error.what());
        return 2;
    }
}
