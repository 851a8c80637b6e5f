/* Part of cstk.hpp: the depth of bodies that meet, and signed distances. */
#ifndef CSTK_DEPTH_HPP
#define CSTK_DEPTH_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>

namespace cstk {

/// The default options of cstk_pair_depth and cstk_signed_distances.
[[nodiscard]] inline cstk_depth_options depth_options(double tolerance = 0, std::uint64_t max_steps = 0) {
    cstk_depth_options options;
    check(cstk_depth_options_default(&options, sizeof options));
    options.tolerance = tolerance;
    options.max_steps = max_steps;
    return options;
}

namespace detail {

/// What Query answers of depths.
template <typename Query> class DepthQueries {
public:
    /// Bounds of the depth of a in b, and a translation of a that parts them.
    [[nodiscard]] cstk_depth_result pair_depth(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                                 const cstk_depth_options &options = depth_options()) {
        cstk_depth_result out;
        check(cstk_pair_depth(query_of(*this), a.get(), pose_a.data(), b.get(), pose_b.data(), &options, &out));
        return out;
    }

    /// The signed distances of all pairs of bodies at most `max_distance` apart, with their derivatives.
    [[nodiscard]] cstk_signed_distance_list
    signed_distances(const CObject &cobject, Span<double> q, double max_distance,
                     std::size_t max_count = 4096,
                     const cstk_depth_options &options = depth_options()) {
        cstk_signed_distance_list out;
        check(cstk_signed_distances(query_of(*this), cobject.get(), q.data(), q.size(), max_distance, max_count,
                                    &options, &out));
        return out;
    }
};

} // namespace detail

} // namespace cstk

#endif
