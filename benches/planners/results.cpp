#include "results.hpp"

#include <algorithm>

namespace {

/// Of an empty list 0.
double percentile(std::vector<double> values, std::size_t percent) {
    if (values.empty()) {
        return 0;
    }
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, values.size() * percent / 100)];
}

/// The numbers that `of` takes from the runs with a path, or from all.
template <class Of> std::vector<double> numbers(const std::vector<Result> &runs, bool with_path, Of of) {
    std::vector<double> found;
    for (const Result &run : runs) {
        if (!with_path || run.answer == Answer::path) {
            found.push_back(of(run));
        }
    }
    return found;
}

} // namespace

void Results::add(const Results &others) {
    runs_.insert(runs_.end(), others.runs_.begin(), others.runs_.end());
}

double Results::milliseconds(std::size_t percent) const {
    return percentile(numbers(runs_, false, [](const Result &run) { return run.milliseconds; }), percent);
}

std::string Results::solved() const {
    const auto has = [](Answer answer) { return [answer](const Result &run) { return run.answer == answer; }; };
    if (std::all_of(runs_.begin(), runs_.end(), has(Answer::none))) {
        return "\"none\"";
    }
    return std::to_string(std::count_if(runs_.begin(), runs_.end(), has(Answer::path)));
}

void Results::print_head() {
    std::printf("| scene | planner | edges | runs | solved | median ms | 95 %% ms | times faster | checks | invalid | motions | length |\n"
                "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
}

void Results::print(const std::string &scene, const Variant &variant, const Results &reference) const {
    double checks = 0;
    for (const Result &run : runs_) {
        checks += static_cast<double>(run.checks) / static_cast<double>(runs_.size());
    }
    const auto invalid = std::count_if(runs_.begin(), runs_.end(), [](const Result &run) { return run.invalid; });
    const auto motions = numbers(runs_, true, [](const Result &run) { return static_cast<double>(run.motions); });
    const auto lengths = numbers(runs_, true, [](const Result &run) { return run.length; });
    std::printf("| %s | %s | %s | %zu | %s | %.2f | %.2f | %.2f | %.0f | ", scene.c_str(), variant.planner.c_str(),
                variant.library.c_str(), runs_.size(), solved().c_str(), milliseconds(50), milliseconds(95),
                reference.milliseconds(50) / milliseconds(50), checks);
    if (motions.empty()) {
        std::printf("- | - | - |\n");
    } else {
        std::printf("%td | %.0f | %.2f |\n", invalid, percentile(motions, 50), percentile(lengths, 50));
    }
    std::fflush(stdout);
}
