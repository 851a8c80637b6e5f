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
        if (asked_.prepare) {
            asked_.prepare(query);
        }
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
    using Clock = std::chrono::steady_clock;
    asked_.begin();
    Clock::duration spent{};
    auto start = Clock::now();
    for (std::size_t query = 0; query < queries_; ++query) {
        if (asked_.prepare) {
            asked_.prepare(query);
            start = Clock::now();
        }
        asked_.ask(query);
        if (asked_.prepare) {
            spent += Clock::now() - start;
        }
    }
    if (!asked_.prepare) {
        spent = Clock::now() - start;
    }
    return std::chrono::duration<double>(spent).count();
}

double Runner::microseconds() const {
    std::vector<double> sorted = times_;
    std::sort(sorted.begin(), sorted.end());
    return 1e6 * sorted[sorted.size() / 2];
}

Asked timed_after(std::string library, std::string variant, std::function<void()> begin,
                  std::function<void(std::size_t)> change,
                  std::function<void(std::size_t)> classify, std::function<double()> answer,
                  Timed timed) {
    Asked made{std::move(library), std::move(variant), std::move(begin), {}, std::move(answer), {}};
    switch (timed) {
    case Timed::both:
        made.ask = [=](std::size_t query) {
            change(query);
            classify(query);
        };
        break;
    case Timed::change:
        made.ask = change;
        made.answer = [] { return 0.0; };
        break;
    case Timed::first_class:
        made.prepare = change;
        made.ask = classify;
        break;
    case Timed::next_class:
        made.prepare = [=](std::size_t query) {
            change(query);
            classify(query > 0 ? query - 1 : 0);
        };
        made.ask = classify;
        break;
    }
    return made;
}
