#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace {

// Of the peer's ways, so many are measured in the end.
const std::size_t kept = 2;

void progress(const std::string &text) {
    std::fprintf(stderr, "\r%-78s\r%s", "", text.c_str());
    std::fflush(stderr);
}

std::string formatted(const char *format, ...) {
    char text[256];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

bool is_faster(const Runner &one, const Runner &other) {
    return one.microseconds() < other.microseconds();
}

} // namespace

struct Table::Measured {
    std::size_t objects;
    Runner ours;
    std::vector<Runner> peers;

    const Runner &peer() const { return *std::min_element(peers.begin(), peers.end(), is_faster); }
};

void Table::start(const std::string &scene, const std::string &title) {
    scene_ = scene;
    title_ = title;
}

void Table::row(const std::string &name, std::size_t queries, double allowed,
                const std::function<std::vector<Question>()> &questions) {
    if ((scene_ + " " + name).find(only_) == std::string::npos) {
        return;
    }
    std::vector<Question> asked = questions();
    std::vector<Measured> sizes;
    for (Question &question : asked) {
        sizes.push_back({question.objects, Runner(std::move(question.ours), queries), {}});
        for (Asked &peer : question.peers) {
            sizes.back().peers.emplace_back(std::move(peer), queries);
        }
        compare(sizes.back(), queries, allowed, name);
    }
    for (int run = 0; run < repeats_; ++run) {
        progress(scene_ + ": " + name + formatted(", run %d of %d", run + 1, repeats_));
        for (Measured &size : sizes) {
            size.ours.run();
            for (Runner &peer : size.peers) {
                peer.run();
            }
        }
    }
    progress("");
    print(name, sizes);
}

// Also runs every way of the peer's once, and keeps the fastest.
void Table::compare(Measured &size, std::size_t queries, double allowed, const std::string &name) {
    const std::vector<double> expected = size.ours.answers();
    for (Runner &peer : size.peers) {
        progress(scene_ + ": " + name + formatted(", %zu objects, ", size.objects) +
                 peer.variant());
        const std::vector<double> answers = peer.answers();
        std::size_t differing = 0;
        double worst = 0;
        for (std::size_t i = 0; i < queries; ++i) {
            const double off = std::fabs(answers[i] - expected[i]);
            differing += !(off <= allowed * expected[i]);
            worst = std::max(worst, off);
        }
        if (differing > 0) {
            std::fprintf(stderr, "\n%s, %zu objects: %s differs in %zu answers, by up to %g\n",
                         name.c_str(), size.objects, peer.variant().c_str(), differing, worst);
        }
        compared_ += queries;
        differing_ += differing;
        peer.run();
    }
    std::sort(size.peers.begin(), size.peers.end(), is_faster);
    if (size.peers.size() > kept) {
        size.peers.erase(size.peers.begin() + kept, size.peers.end());
    }
}

void Table::print(const std::string &name, const std::vector<Measured> &sizes) {
    if (!title_.empty()) {
        std::printf("\n### %s\n\n"
                    "| query | n | cstk, µs | FCL, µs | FCL / cstk | cstk against the least n | FCL "
                    "against the least n |\n"
                    "| --- | --- | --- | --- | --- | --- | --- |\n",
                    title_.c_str());
        title_.clear();
    }
    const double first = sizes[0].ours.microseconds();
    for (const Measured &size : sizes) {
        const double ours = size.ours.microseconds();
        const std::string place = scene_ + formatted(",%zu,", size.objects) + name;
        csv_ += place + formatted(",cstk,default,%.4f\n", ours);
        std::printf("| %s | %zu | %.2f | ", name.c_str(), size.objects, ours);
        if (size.peers.empty()) {
            std::printf("- | - | %.2f | - |\n", ours / first);
            continue;
        }
        const double peer = size.peer().microseconds();
        std::printf("%.2f (%s) | %#.3g | %.2f | %.2f |\n", peer, size.peer().variant().c_str(), peer / ours, ours / first,
                    peer / sizes[0].peer().microseconds());
        csv_ += place + ",FCL," + size.peer().variant() + formatted(",%.4f\n", peer);
    }
    std::fflush(stdout);
}
