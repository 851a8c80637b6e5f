// Whether a robot collides and how far it is from doing so, at configurations: the Panda and the
// UR5 of example-robot-data with their collision meshes, the Panda and the ANYmal of boxes,
// cylinders and spheres, against themselves and obstacles, and the same by Pinocchio with Coal, in
// turn:
//
//     robots FOLDER [--csv FILE] [--quick] [--seed N]
//
// the folder being that of scripts/fetch_pinocchio.sh. --quick takes fewer poses and passes. Ends
// with 1 where answers differ.
#include "ours.hpp"
#include "peer.hpp"
#include "table.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// Radians, and metres of the Panda's fingers; the length of a step in C-space.
const double step_length = 0.01;
// So many coherent poses are of one way, before the next begins elsewhere.
const std::size_t stretch = 50;
// By so many poses it is found out which links always meet.
const std::size_t sampled = 500;

struct Robot {
    const char *name, *urdf;
};

const Robot robots[] = {{"Panda", "panda_description/urdf/panda.urdf"},
                        {"UR5", "ur_description/urdf/ur5_robot.urdf"},
                        {"Panda of shapes", "panda_description/urdf/panda_collision.urdf"},
                        {"ANYmal", "anymal_b_simple_description/robots/anymal.urdf"}};

struct Options {
    std::string folder, csv;
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
        } else if (name == "--seed") {
            options.seed = std::stoull(value());
        } else if (name == "--quick") {
            options.quick = true;
        } else if (options.folder.empty() && name.rfind("--", 0) != 0) {
            options.folder = name;
        } else {
            throw std::runtime_error("unknown option " + name);
        }
    }
    return options;
}

using Configurations = std::vector<std::vector<double>>;

Configurations random_poses(const cstk::Space &space, std::size_t count, std::uint64_t &random) {
    Configurations made;
    while (made.size() < count) {
        made.push_back(space.sample(random));
    }
    return made;
}

// Stretches of small steps, each from one random configuration towards another.
Configurations coherent_poses(const cstk::Space &space, std::size_t count, std::uint64_t &random) {
    Configurations made;
    while (made.size() < count) {
        const std::vector<double> from = space.sample(random), to = space.sample(random);
        double length = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            length += (to[i] - from[i]) * (to[i] - from[i]);
        }
        length = std::sqrt(length);
        for (std::size_t k = 0; k < stretch && made.size() < count; ++k) {
            const double share = std::min(static_cast<double>(k) * step_length / length, 1.0);
            std::vector<double> q = from;
            for (std::size_t i = 0; i < q.size(); ++i) {
                q[i] += share * (to[i] - from[i]);
            }
            made.push_back(q);
        }
    }
    return made;
}

struct PoseSet {
    const char *name;
    Configurations at;
};

struct Case {
    const char *name;
    cstk::CObject cobject;
    Tested tested;
    std::vector<Query> queries = {Query::collide, Query::distance};
};

std::vector<Case> cases_of(const Ours &ours, const Peer &peer, const std::vector<LinkPair> &pairs) {
    const std::vector<std::string> moving = peer.moving_links();
    const Obstacles boxes = boxes_around(), ball = boxes_and_ball();
    const cstk::CObject itself = ours.itself(pairs), to_boxes = ours.among(boxes, moving),
                        to_ball = ours.among(ball, moving);
    return {{"itself", itself, {pairs, {}}},
            {"boxes", to_boxes, {{}, boxes}},
            {"boxes and ball", to_ball, {{}, ball}},
            {"itself and boxes", cstk::CObject::union_of({itself, to_boxes}), {pairs, boxes}},
            {"itself and boxes and ball",
             cstk::CObject::union_of({itself, to_ball}),
             {pairs, ball}}};
}

// Those with itself whose pairs of links are proved before: only whether anything meets is answered sooner.
std::vector<Case> proved_cases_of(const Ours &ours, const Peer &peer, const std::vector<LinkPair> &pairs) {
    const Obstacles boxes = boxes_around(), ball = boxes_and_ball();
    const std::vector<std::string> moving = peer.moving_links();
    const auto start = std::chrono::steady_clock::now();
    cstk_clear_pair_summary summary;
    const cstk::CObject itself = cstk::Query().prove_clear_pairs(ours.itself(pairs), cstk::clear_pair_options(), &summary);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr, "%zu of %zu pairs proved in %.0f %% of their cells, %.1f s\n", summary.proved_count,
                 summary.pair_count, 100 * summary.proved_share, seconds.count());
    const std::vector<Query> collide = {Query::collide};
    return {{"itself", itself, {pairs, {}}, collide},
            {"itself and boxes", cstk::CObject::union_of({itself, ours.among(boxes, moving)}), {pairs, boxes}, collide},
            {"itself and boxes and ball",
             cstk::CObject::union_of({itself, ours.among(ball, moving)}),
             {pairs, ball},
             collide}};
}

void show(const Robot &robot, const Options &options, std::size_t count, bool with_proofs, Table &table) {
    const Ours ours(options.folder, robot.urdf);
    const Peer peer(options.folder, robot.urdf);
    std::uint64_t random = options.seed;
    const std::vector<LinkPair> pairs =
        peer.link_pairs(ours.poses(random_poses(ours.space(), sampled, random)));
    std::fprintf(stderr, "%s: %zu pairs of links\n", robot.name, pairs.size());
    const PoseSet sets[] = {{"random", random_poses(ours.space(), count, random)},
                            {"coherent", coherent_poses(ours.space(), count, random)}};
    for (const Case &one : (with_proofs ? proved_cases_of : cases_of)(ours, peer, pairs)) {
        for (const PoseSet &set : sets) {
            for (const Query query : one.queries) {
                table.row({robot.name, one.name, set.name, query},
                          Ours::ways(one.cobject, query, set.at),
                          peer.ways(one.tested, query, ours.poses(set.at)));
            }
        }
    }
}

// What every answer takes: the links' places alone, and whether anything meets where one box is far away.
void show_least_work(const Options &options, std::size_t count, std::size_t passes) {
    std::printf("\nWhat every answer takes, µs:\n\n"
                "| robot | poses | link poses, cstk | and a box out of reach, cstk | link poses, Pinocchio |\n"
                "| --- | --- | --- | --- | --- |\n");
    for (const Robot &robot : robots) {
        const Ours ours(options.folder, robot.urdf);
        const Peer peer(options.folder, robot.urdf);
        std::uint64_t random = options.seed;
        const PoseSet sets[] = {{"random", random_poses(ours.space(), count, random)},
                                {"coherent", coherent_poses(ours.space(), count, random)}};
        const cstk::CObject apart = ours.among(box_out_of_reach(), peer.moving_links());
        for (const PoseSet &set : sets) {
            const std::vector<double> times =
                medians({ours.kinematics(set.at), Ours::ways(apart, Query::collide, set.at).back(),
                         peer.kinematics(ours.poses(set.at))},
                        passes, count);
            std::printf("| %s | %s | %.2f | %.2f | %.2f |\n", robot.name, set.name, times[0] / 1000, times[1] / 1000,
                        times[2] / 1000);
            std::fflush(stdout);
        }
    }
}

int run(const Options &options) {
    if (!std::filesystem::exists(std::filesystem::path(options.folder) / "cmeel.prefix")) {
        std::fprintf(stderr, "SKIPPED: no robots in \"%s\"; see scripts/fetch_pinocchio.sh\n",
                     options.folder.c_str());
        return 77;
    }
    const std::size_t count = options.quick ? 100 : 500;
    const std::size_t passes = options.quick ? 3 : 7;
    Table table(passes, count);
    for (const Robot &robot : robots) {
        show(robot, options, count, false, table);
    }
    table.finish();
    std::printf("\nWith pairs of links that cstk_prove_clear_pairs has proved before:\n\n");
    Table proved(passes, count);
    for (const Robot &robot : robots) {
        show(robot, options, count, true, proved);
    }
    proved.finish();
    show_least_work(options, count, passes);
    if (!options.csv.empty()) {
        std::ofstream file(options.csv);
        if (!(file << table.csv())) {
            throw std::runtime_error("cannot write " + options.csv);
        }
        std::printf("\nwritten: %s\n", options.csv.c_str());
    }
    return table.differing() + proved.differing() == 0 ? 0 : 1;
}

} // namespace

int main(int count, char **arguments) {
    try {
        return run(read(count, arguments));
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "robots: %s\n", failure.what());
        return 2;
    }
}
