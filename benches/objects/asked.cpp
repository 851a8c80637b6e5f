#include "asked.hpp"

#include <algorithm>
#include <chrono>

namespace {

// Seconds that a run takes at least.
const double least = 0.01;

} // namespace

std::vector<double> Runner::answers() {
    std::vector<double> found;
    asked_.begin();
    for (std::size_t query = 0; query < queries_; ++query) {
        asked_.ask(query);
        found.push_back(asked_.answer());
    }
    return found;
}

void Runner::run() {
    double seconds = 0;
    std::size_t passes = 0;
    while (seconds < least) {
        seconds += pass();
        ++passes;
    }
    times_.push_back(seconds / static_cast<double>(passes * queries_));
}

double Runner::pass() {
    asked_.begin();
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t query = 0; query < queries_; ++query) {
        asked_.ask(query);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double Runner::microseconds() const {
    std::vector<double> sorted = times_;
    std::sort(sorted.begin(), sorted.end());
    return 1e6 * sorted[sorted.size() / 2];
}
