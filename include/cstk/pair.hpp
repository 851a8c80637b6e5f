/* Part of cstk.hpp: queries of two bodies. */
#ifndef CSTK_PAIR_HPP
#define CSTK_PAIR_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>

#include <cstddef>
#include <limits>

namespace cstk {

namespace detail {

/// What Query answers of two bodies at two poses.
template <typename Query> class PairQueries {
public:
    [[nodiscard]] cstk_distance_result
    pair_distance(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                  double max_distance = std::numeric_limits<double>::infinity()) {
        cstk_distance_result out;
        check(cstk_pair_distance(query_of(*this), a.get(), pose_a.data(), b.get(), pose_b.data(), max_distance,
                                 &out));
        return out;
    }

    [[nodiscard]] bool pair_within(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                     double threshold) {
        bool out = false;
        check(cstk_pair_within(query_of(*this), a.get(), pose_a.data(), b.get(), pose_b.data(), threshold,
                               &out));
        return out;
    }

    [[nodiscard]] cstk_witness_list pair_witnesses(const Body &a, const Pose &pose_a, const Body &b,
                                     const Pose &pose_b, double epsilon,
                                     std::size_t max_count = 4096) {
        cstk_witness_list out;
        check(cstk_pair_witnesses(query_of(*this), a.get(), pose_a.data(), b.get(), pose_b.data(), epsilon,
                                  max_count, &out));
        return out;
    }

    [[nodiscard]] cstk_penetration_list pair_penetration(const Body &a, const Pose &pose_a, const Body &b,
                                           const Pose &pose_b,
                                           std::size_t max_count = 4096) {
        cstk_penetration_list out;
        check(cstk_pair_penetration(query_of(*this), a.get(), pose_a.data(), b.get(), pose_b.data(),
                                    max_count, &out));
        return out;
    }
};

} // namespace detail

} // namespace cstk

#endif
