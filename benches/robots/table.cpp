#include "table.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

namespace {

// Of Pinocchio's ways, so many are measured in the end; they are chosen by so many poses.
const std::size_t kept = 2, tried_poses = 50;

// Distances may be off by as much, in metres.
const double allowed = 1e-6;

using Clock = std::chrono::steady_clock;

const char *name_of(Query query) { return query == Query::collide ? "collide" : "distance"; }

std::string title(const Row &row) {
    return row.robot + ", " + row.with + ", " + row.poses + ", " + name_of(row.query);
}

bool agree(Query query, double a, double b) {
    return query == Query::collide ? a == b : std::fabs(a - b) <= allowed;
}

// Nanoseconds a pose.
double pass(const Way &way, std::size_t poses) {
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 0; i < poses; ++i) {
        way.ask(i);
    }
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    return time.count() / static_cast<double>(poses);
}

double median(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

struct Fastest {
    const Way *way = nullptr;
    double time = INFINITY;
};

Fastest fastest_of(const std::vector<Way> &ways, const double *times) {
    Fastest found;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (times[i] < found.time) {
            found = {&ways[i], times[i]};
        }
    }
    return found;
}

} // namespace

std::vector<double> medians(const std::vector<Way> &ways, std::size_t passes, std::size_t poses) {
    std::vector<std::vector<double>> times(ways.size());
    for (std::size_t run = 0; run < passes; ++run) {
        for (std::size_t i = 0; i < ways.size(); ++i) {
            times[i].push_back(pass(ways[i], poses));
        }
    }
    std::vector<double> found;
    for (std::vector<double> &of_way : times) {
        found.push_back(median(std::move(of_way)));
    }
    return found;
}

std::vector<double> Table::answers(const Way &way) const {
    std::vector<double> found;
    for (std::size_t i = 0; i < poses_; ++i) {
        found.push_back(way.ask(i));
    }
    return found;
}

// Prints the first poses at which they differ.
std::size_t Table::compare(const Row &row, const std::vector<double> &ours, const Way &peer,
                           const std::vector<double> &theirs) {
    const std::size_t shown = 3;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < poses_; ++i) {
        if (!agree(row.query, ours[i], theirs[i]) && ++differing <= shown) {
            std::fprintf(stderr, "DIFFERS: %s, pose %zu: cstk %.12g, Pinocchio %.12g (%s)\n",
                         title(row).c_str(), i, ours[i], theirs[i], peer.name.c_str());
        }
    }
    if (differing > shown) {
        std::fprintf(stderr, "DIFFERS: %s: at %zu poses in all (%s)\n", title(row).c_str(),
                     differing, peer.name.c_str());
    }
    compared_ += poses_;
    differing_ += differing;
    return differing;
}

// A way that fails, or answers otherwise than the plainest does, is left out and named.
std::vector<Way> Table::fastest(const Row &row, std::vector<Way> peers,
                                const std::vector<double> &expected) const {
    const std::size_t tried = std::min(poses_, tried_poses);
    // Whether a way's first answers are those expected; names it otherwise.
    const auto is_right = [&](const Way &peer, const std::vector<double> &found) {
        std::size_t off = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            off += !agree(row.query, found[i], expected[i]);
        }
        if (off > 0) {
            std::fprintf(stderr, "left out: %s: %s, %zu of %zu answers are not those of %s\n",
                         title(row).c_str(), peer.name.c_str(), off, found.size(),
                         peers[0].name.c_str());
        }
        return off == 0;
    };
    std::vector<std::pair<double, Way>> timed;
    for (Way &peer : peers) {
        try {
            std::vector<double> found(tried);
            const Clock::time_point start = Clock::now();
            for (std::size_t i = 0; i < tried; ++i) {
                found[i] = peer.ask(i);
            }
            const std::chrono::duration<double> time = Clock::now() - start;
            if (is_right(peer, found)) {
                timed.emplace_back(time.count(), peer);
            }
        } catch (const std::exception &failure) {
            std::fprintf(stderr, "left out: %s: %s fails: %s\n", title(row).c_str(),
                         peer.name.c_str(), failure.what());
        }
    }
    std::sort(timed.begin(), timed.end(),
              [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<Way> found;
    for (const auto &[seconds, peer] : timed) {
        if (found.size() < kept && is_right(peer, answers(peer))) {
            found.push_back(peer);
        }
    }
    return found;
}

void Table::row(const Row &row, const std::vector<Way> &ours, std::vector<Way> peers) {
    const std::vector<double> expected = answers(ours[0]), plain = answers(peers[0]);
    for (std::size_t i = 1; i < ours.size(); ++i) {
        compare(row, answers(ours[i]), peers[0], plain);
    }
    compare(row, expected, peers[0], plain);
    peers = fastest(row, std::move(peers), plain);
    for (const Way &peer : peers) {
        compare(row, expected, peer, answers(peer));
    }
    std::vector<Way> all = ours;
    all.insert(all.end(), peers.begin(), peers.end());
    const std::vector<double> times = medians(all, passes_, poses_);
    const Fastest our = fastest_of(ours, times.data());
    const Fastest peer = fastest_of(peers, times.data() + ours.size());
    const double ratio = peer.time / our.time;
    const auto meeting = std::count_if(expected.begin(), expected.end(), [&](double answer) {
        return row.query == Query::collide ? answer == 1 : answer == 0;
    });
    if (ratios_.empty()) {
        std::printf("| robot | with | poses | meeting | query | cstk, µs | Pinocchio, µs | "
                    "Pinocchio / cstk |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    }
    std::printf("| %s | %s | %s | %.0f %% | %s | %.2f (%s) | %.2f (%s) | %#.3g |\n",
                row.robot.c_str(), row.with.c_str(), row.poses.c_str(),
                100 * static_cast<double>(meeting) / static_cast<double>(poses_),
                name_of(row.query), our.time / 1000, our.way->name.c_str(), peer.time / 1000,
                peer.way->name.c_str(), ratio);
    std::fflush(stdout);
    if (std::all_of(ratios_.begin(), ratios_.end(), [&](double other) { return ratio < other; })) {
        slowest_ = title(row);
    }
    ratios_.push_back(ratio);
    const std::string start = row.robot + " with " + row.with + "," + row.poses + "," +
                              name_of(row.query) + ",";
    csv_ += start + "cstk," + std::to_string(our.time) + "\n";
    csv_ += start + "Pinocchio," + std::to_string(peer.time) + "\n";
}

void Table::finish() const {
    double logarithms = 0;
    for (const double ratio : ratios_) {
        logarithms += std::log(ratio);
    }
    std::printf("\nPinocchio / cstk: geometric mean %.2f, least %.2f (%s)\n",
                std::exp(logarithms / static_cast<double>(ratios_.size())),
                *std::min_element(ratios_.begin(), ratios_.end()), slowest_.c_str());
    std::printf("%zu answers of Pinocchio's compared, %zu differ\n", compared_, differing_);
}
