/* Part of cstk.hpp: many questions in one call. */
#ifndef CSTK_BATCH_HPP
#define CSTK_BATCH_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/motion.hpp>
#include <cstk/pose.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// Options of batches; no threads stands for as many as the machine runs at once.
[[nodiscard]] inline cstk_batch_options batch_options(std::uint32_t threads = 0, bool stop_at_hit = false) {
    cstk_batch_options options;
    check(cstk_batch_options_default(&options, sizeof options));
    options.threads = threads;
    options.stop_at_hit = stop_at_hit;
    return options;
}

/// The answers of a batch, one for each item. Those of items with another status than CSTK_OK mean nothing.
template <typename T> struct BatchAnswers {
    std::vector<T> values;
    std::vector<cstk_status> statuses;
    cstk_batch_result done = {};
    /// Why the first item that failed did, or empty.
    std::string first_failure;
};

/// Distances with the gradients of their contacts: one row after the other in `gradients`.
struct BatchDistances : BatchAnswers<cstk_distance_result> {
    std::vector<double> gradients;
};

/// Motions with the configurations at their times[1], one after the other in `reached`.
struct BatchMotions : BatchAnswers<cstk_motion_result> {
    std::vector<double> reached;
};

/// Many questions in one call, on several threads; `q` and `points` hold `count` configurations, one after the other; of none, the answers
/// are empty. Copies share what the threads remember.
class Batch : public Handle<cstk_batch, cstk_batch_retain, cstk_batch_release> {
public:
    Batch() : Handle(create()) {}

    [[nodiscard]] BatchAnswers<cstk_class> classify(const CObject &cobject, Span<double> q, std::size_t count,
                                      const cstk_batch_options &options = batch_options(),
                                      Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchAnswers<cstk_class>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_classify_batch(get(), cobject.get(), q.data(), count, nq, &options,
                                       report.function(), &report, out.values.data(),
                                       out.statuses.data(), &out.done);
        });
    }

    /// 1 for each configuration that is within the threshold, or 0.
    [[nodiscard]] BatchAnswers<std::uint8_t> within(const CObject &cobject, Span<double> q, std::size_t count,
                                      double threshold,
                                      const cstk_batch_options &options = batch_options(),
                                      Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchAnswers<std::uint8_t>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_within_batch(get(), cobject.get(), q.data(), count, nq, threshold, &options,
                                     report.function(), &report, bools(out.values),
                                     out.statuses.data(), &out.done);
        });
    }

    /// Gradients are computed where `nv`, the number of the space's velocities, is given.
    [[nodiscard]] BatchDistances distance(const CObject &cobject, Span<double> q, std::size_t count,
                            double max_distance = std::numeric_limits<double>::infinity(),
                            std::size_t nv = 0, const cstk_batch_options &options = batch_options(),
                            Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchDistances>(count, std::move(progress), [&](auto &out, auto &report) {
            out.gradients.resize(count * nv);
            double *const rows = nv == 0 ? nullptr : out.gradients.data();
            return cstk_distance_batch(get(), cobject.get(), q.data(), count, nq, max_distance,
                                       &options, report.function(), &report, nullptr,
                                       out.values.data(), rows, nv, out.statuses.data(), &out.done);
        });
    }

    /// Number i goes from the i-th configuration of q0 to the i-th of q1.
    [[nodiscard]] BatchMotions motion(const CObject &cobject, Span<double> q0, Span<double> q1, std::size_t count,
                        const cstk_motion_options &motions = motion_options(),
                        const cstk_batch_options &options = batch_options(),
                        Progress progress = {}) const {
        detail::same_size(q0, q1);
        if (count == 0 && q0.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q0, count);
        return run<BatchMotions>(count, std::move(progress), [&](auto &out, auto &report) {
            out.reached.resize(count * nq);
            return cstk_motion_batch(get(), cobject.get(), q0.data(), q1.data(), count, nq, &motions,
                                     &options, report.function(), &report, out.reached.data(),
                                     out.values.data(), out.statuses.data(), &out.done);
        });
    }

    /// 1 for each pair of poses at which the bodies are within the threshold, or 0.
    [[nodiscard]] BatchAnswers<std::uint8_t> pair_within(const Body &a, Span<Pose> poses_a, const Body &b,
                                           Span<Pose> poses_b, double threshold,
                                           const cstk_batch_options &options = batch_options(),
                                           Progress progress = {}) const {
        const std::size_t count = pairs(poses_a, poses_b);
        return run<BatchAnswers<std::uint8_t>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_pair_within_batch(get(), a.get(), flat(poses_a), b.get(), flat(poses_b), count,
                                          threshold, &options, report.function(), &report,
                                          bools(out.values), out.statuses.data(), &out.done);
        });
    }

    [[nodiscard]] BatchAnswers<cstk_distance_result>
    pair_distance(const Body &a, Span<Pose> poses_a, const Body &b, Span<Pose> poses_b,
                  double max_distance = std::numeric_limits<double>::infinity(),
                  const cstk_batch_options &options = batch_options(), Progress progress = {}) const {
        const std::size_t count = pairs(poses_a, poses_b);
        return run<BatchAnswers<cstk_distance_result>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_pair_distance_batch(get(), a.get(), flat(poses_a), b.get(), flat(poses_b), count,
                                            max_distance, &options, report.function(), &report, nullptr,
                                            out.values.data(), out.statuses.data(), &out.done);
        });
    }

    /// The work of all threads.
    cstk_query_statistics statistics(bool reset = false) const {
        cstk_query_statistics out;
        check(cstk_batch_get_statistics(get(), reset, &out));
        return out;
    }

private:
    template <typename Answers, typename Call>
    static Answers run(std::size_t count, Progress progress, Call call) {
        detail::Report report{std::move(progress), nullptr};
        Answers out;
        out.values.resize(count);
        out.statuses.resize(count);
        report.check(call(out, report));
        if (out.done.failed > 0) {
            out.first_failure = cstk_last_error_message();
        }
        return out;
    }

    static bool *bools(std::vector<std::uint8_t> &values) {
        static_assert(sizeof(bool) == 1, "a bool is a byte");
        return reinterpret_cast<bool *>(values.data());
    }

    static std::size_t pairs(Span<Pose> a, Span<Pose> b) {
        if (a.size() != b.size()) {
            throw std::invalid_argument("cstk: there are as many poses of one body as of the other");
        }
        return a.size();
    }

    static const double *flat(Span<Pose> poses) {
        return poses.size() == 0 ? nullptr : poses.data()->data();
    }

    static cstk_batch *create() {
        cstk_batch *out = nullptr;
        check(cstk_batch_create(&out));
        return out;
    }
};

} // namespace cstk

#endif
