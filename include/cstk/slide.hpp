/* Part of cstk.hpp: sliding along contacts. */
#ifndef CSTK_SLIDE_HPP
#define CSTK_SLIDE_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace cstk {

[[nodiscard]] inline cstk_slide_options slide_options(double max_shell) {
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    return options;
}

/// For steps of this length, as Space::distance() measures.
[[nodiscard]] inline cstk_slide_to_options slide_to_options(double step) {
    cstk_slide_to_options options;
    check(cstk_slide_to_options_default(&options, sizeof options));
    options.step = step;
    return options;
}

/// The step nearest to `step` that respects the contacts of a list with gradients; none where too little is left of it.
[[nodiscard]] inline std::optional<std::vector<double>> slide_step(const cstk_witness_list &list,
                                                     Span<double> step, double desired_distance,
                                                     bool normalize = false) {
    std::vector<double> out(step.size());
    bool found = false;
    check(cstk_slide_step(&list, step.data(), step.size(), desired_distance, normalize, out.data(),
                          &found));
    return found ? std::optional(std::move(out)) : std::nullopt;
}

/// The shortest step out to the desired distance; none where no contact is nearer, or none can be helped.
[[nodiscard]] inline std::optional<std::vector<double>> spring_step(const cstk_witness_list &list,
                                                      double desired_distance) {
    std::vector<double> out(list.nv);
    bool found = false;
    check(cstk_spring_step(&list, list.nv, desired_distance, out.data(), &found));
    return found ? std::optional(std::move(out)) : std::nullopt;
}

namespace detail {

/// How Query leads a robot along contacts.
template <typename Query> class SlideQueries {
public:
    /// Leads the robot from q to the box of configurations between `goal_low` and `goal_high`, straight or sliding, until it arrives or
    /// is stopped. Without weights each is 1. The path of the answer belongs to this query until its next call.
    [[nodiscard]] cstk_slide_to_result slide_to(const CObject &cobject, Span<double> q, Span<double> goal_low,
                                  Span<double> goal_high, const cstk_slide_options &slide,
                                  const cstk_slide_to_options &options, Span<double> weights = {},
                                  Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        cstk_slide_to_result out;
        detail::same_size(q, goal_low);
        report.check(cstk_slide_to(query_of(*this), cobject.get(), q.data(), goal_low.data(), goal_high.data(),
                                   detail::same_size(q, goal_high), weights.data(), weights.size(),
                                   &slide, &options, report.function(), &report, &out));
        return out;
    }

    /// The same to one configuration.
    [[nodiscard]] cstk_slide_to_result slide_to(const CObject &cobject, Span<double> q, Span<double> goal,
                                  const cstk_slide_options &slide,
                                  const cstk_slide_to_options &options) {
        return slide_to(cobject, q, goal, goal, slide, options);
    }

    /// Moves q by one sliding step; says how it ended.
    cstk_slide_result slide(const CObject &cobject, std::vector<double> &q, Span<double> step,
                            const cstk_slide_options &options) {
        cstk_slide_result out;
        check(cstk_slide(query_of(*this), cobject.get(), q.data(), q.size(), step.data(), step.size(), &options,
                         q.data(), &out));
        return out;
    }
};

} // namespace detail

} // namespace cstk

#endif
