#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace {

// Passes over the motions, and how many motions are measured however long they take.
const std::size_t passes = 5, min_segments = 3;
// A pass is preceded by an untimed one of so many seconds at most.
const double warm_up_budget = 0.02;
// Of a motion.
const double time_allowed = 0.01;

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Number> double mean_of(const std::vector<Number> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// One variant, as it is measured.
class Runner {
  public:
    Runner(const Variant &variant, const std::vector<Segment> &segments, double budget)
        : variant_(variant), segments_(segments), budget_(budget) {}

    void pass(Kind kind, Row &row) {
        if (pass_ > 0 && spent_ + spent_ / static_cast<double>(pass_) > budget_) {
            return;
        }
        const std::size_t count = pass_ == 0 ? segments_.size() : times_.size();
        warm_up(count);
        for (std::size_t i = 0; i < count; ++i) {
            if (pass_ == 0 && i >= min_segments && spent_ > budget_) {
                break;
            }
            using Clock = std::chrono::steady_clock;
            const auto start = Clock::now();
            const Verdict verdict = variant_.ask(segments_[i]);
            const std::chrono::duration<double> time = Clock::now() - start;
            const std::size_t work = variant_.work ? variant_.work() : verdict.checks;
            spent_ += time.count();
            if (pass_ == 0) {
                times_.emplace_back();
                row.checks.push_back(work);
                judge(kind, i, verdict, row);
            }
            times_[i].push_back(1e6 * time.count());
        }
        ++pass_;
    }

    void finish(Row &row) const {
        for (const std::vector<double> &times : times_) {
            row.microseconds.push_back(median_of(times));
        }
    }

  private:
    /// Asks without a clock, as a caller finds the caches who asks one motion after the other in one way: the other ways have left
    /// theirs.
    void warm_up(std::size_t count) const {
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        for (std::size_t i = 0; i < count; ++i) {
            variant_.ask(segments_[i]);
            const std::chrono::duration<double> time = Clock::now() - start;
            if (time.count() > warm_up_budget) {
                return;
            }
        }
    }

    void judge(Kind kind, std::size_t number, const Verdict &verdict, Row &row) const {
        if (verdict.is_hit != (kind == Kind::hit)) {
            ++row.differing;
            row.which.push_back(number);
        } else if (verdict.is_hit && verdict.contact) {
            const double off = std::fabs(*verdict.contact - segments_[number].contact);
            row.off_in_time += off > time_allowed;
        }
    }

    const Variant &variant_;
    const std::vector<Segment> &segments_;
    double budget_, spent_ = 0;
    std::size_t pass_ = 0;
    std::vector<std::vector<double>> times_;
};

} // namespace

double Row::median() const { return median_of(microseconds); }

double Row::mean() const { return mean_of(microseconds); }

double Row::mean_checks() const { return mean_of(checks); }

std::vector<Row> measure(const std::string &scene, double length, Kind kind,
                         const std::vector<Variant> &variants,
                         const std::vector<Segment> &segments, double budget) {
    std::vector<Row> rows;
    std::vector<Runner> runners;
    for (const Variant &variant : variants) {
        rows.push_back({scene, length, kind, variant.library, variant.name, {}});
        runners.emplace_back(variant, segments, budget);
    }
    for (std::size_t pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < runners.size(); ++i) {
            runners[i].pass(kind, rows[i]);
        }
    }
    for (std::size_t i = 0; i < runners.size(); ++i) {
        runners[i].finish(rows[i]);
    }
    return rows;
}
