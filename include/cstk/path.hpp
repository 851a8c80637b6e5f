/* Part of cstk.hpp: paths proved free, their clearances, and shorter ones. */
#ifndef CSTK_PATH_HPP
#define CSTK_PATH_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/motion.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cstk {

[[nodiscard]] inline cstk_shortcut_options shortcut_options(std::uint64_t attempts = 100, std::uint64_t seed = 0) {
    cstk_shortcut_options options;
    check(cstk_shortcut_options_default(&options, sizeof options));
    options.attempts = attempts;
    options.seed = seed;
    return options;
}

namespace detail {

/// What Query answers of paths.
template <typename Query> class PathQueries {
public:
    /// Proves a path free, or finds its first contact: `points` holds `count` configurations, one after the other; `reached`, if given,
    /// receives the configuration at the contact.
    [[nodiscard]] cstk_path_result motion_path(const CObject &cobject, Span<double> points, std::size_t count,
                                 const cstk_motion_options &options = motion_options(),
                                 Progress progress = {},
                                 std::vector<double> *reached = nullptr) {
        detail::Report report{std::move(progress), nullptr};
        cstk_path_result out;
        std::vector<double> found(detail::parts_of(points, count));
        report.check(cstk_motion_path(query_of(*this), cobject.get(), points.data(), count, found.size(),
                                      &options, report.function(), &report, found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same of configurations that are vectors of their own.
    [[nodiscard]] cstk_path_result motion_path(const CObject &cobject, const std::vector<std::vector<double>> &points,
                                               const cstk_motion_options &options = motion_options(),
                                               Progress progress = {}, std::vector<double> *reached = nullptr) {
        return motion_path(cobject, detail::flattened(points), points.size(), options, std::move(progress), reached);
    }

    /// The least distance along a path: `points` holds `count` configurations, one after the other; `nearest`, if given, receives the
    /// configuration at the nearest place.
    [[nodiscard]] cstk_path_clearance_result path_clearance(const CObject &cobject, Span<double> points,
                                              std::size_t count,
                                              const cstk_clearance_options &options,
                                              Progress progress = {},
                                              std::vector<double> *nearest = nullptr) {
        detail::Report report{std::move(progress), nullptr};
        cstk_path_clearance_result out;
        std::vector<double> found(detail::parts_of(points, count));
        report.check(cstk_path_clearance(query_of(*this), cobject.get(), points.data(), count, found.size(),
                                         &options, report.function(), &report, found.data(), &out));
        if (nearest != nullptr) {
            *nearest = std::move(found);
        }
        return out;
    }

    /// The same of configurations that are vectors of their own.
    [[nodiscard]] cstk_path_clearance_result path_clearance(const CObject &cobject,
                                                            const std::vector<std::vector<double>> &points,
                                                            const cstk_clearance_options &options,
                                                            Progress progress = {},
                                                            std::vector<double> *nearest = nullptr) {
        return path_clearance(cobject, detail::flattened(points), points.size(), options, std::move(progress), nearest);
    }

    /// Makes a path shorter by motions that are proved free. The path of the answer belongs to this query until its next call.
    [[nodiscard]] cstk_shortcut_result path_shortcut(const CObject &cobject, Span<double> points,
                                       std::size_t count,
                                       const cstk_shortcut_options &options = shortcut_options(),
                                       Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        cstk_shortcut_result out;
        report.check(cstk_path_shortcut(query_of(*this), cobject.get(), points.data(), count,
                                        detail::parts_of(points, count), &options, report.function(),
                                        &report, &out));
        return out;
    }

    /// The same of configurations that are vectors of their own; cstk/lists.hpp gives the shorter path as such.
    [[nodiscard]] cstk_shortcut_result path_shortcut(const CObject &cobject,
                                                     const std::vector<std::vector<double>> &points,
                                                     const cstk_shortcut_options &options = shortcut_options(),
                                                     Progress progress = {}) {
        return path_shortcut(cobject, detail::flattened(points), points.size(), options, std::move(progress));
    }
};

} // namespace detail

} // namespace cstk

#endif
