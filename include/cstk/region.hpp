/* Part of cstk.hpp: boxes of configurations proved free. */
#ifndef CSTK_REGION_HPP
#define CSTK_REGION_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/span.hpp>

#include <utility>
#include <vector>

namespace cstk {

/// The default options of cstk_region_classify.
[[nodiscard]] inline cstk_region_options region_options() {
    cstk_region_options options;
    check(cstk_region_options_default(&options, sizeof options));
    return options;
}

/// The default options of cstk_region_grow.
[[nodiscard]] inline cstk_growth_options growth_options() {
    cstk_growth_options options;
    check(cstk_growth_options_default(&options, sizeof options));
    return options;
}

/// A box that is proved free, and what stops the lower and the upper side of each velocity's coordinate.
struct GrownRegion {
    std::vector<double> low;
    std::vector<double> high;
    std::vector<cstk_region_side> sides;
};

namespace detail {

/// What Query answers of boxes of configurations.
template <typename Query> class RegionQueries {
public:
    /// Proves that no configuration between low and high is inside, or that all are; `inside` and `outside`, if given, receive one of
    /// each where the result says that they are known.
    [[nodiscard]] cstk_region_result region_classify(const CObject &cobject, Span<double> low, Span<double> high,
                                       const cstk_region_options &options = region_options(),
                                       std::vector<double> *inside = nullptr,
                                       std::vector<double> *outside = nullptr) {
        cstk_region_result out;
        std::vector<double> in(detail::same_size(low, high)), beside(low.size());
        check(cstk_region_classify(query_of(*this), cobject.get(), low.data(), high.data(), low.size(), &options,
                                   in.data(), beside.data(), &out));
        if (inside != nullptr && out.has_inside) {
            *inside = std::move(in);
        }
        if (outside != nullptr && out.has_outside) {
            *outside = std::move(beside);
        }
        return out;
    }

    /// Grows a box around q that is proved free. `weights` has one entry for each of the space's `nv` velocities.
    [[nodiscard]] GrownRegion region_grow(const CObject &cobject, Span<double> q, Span<double> weights,
                            const cstk_growth_options &options = growth_options()) {
        GrownRegion grown;
        grown.low.resize(q.size());
        grown.high.resize(q.size());
        grown.sides.resize(2 * weights.size());
        check(cstk_region_grow(query_of(*this), cobject.get(), q.data(), q.size(), weights.data(), weights.size(),
                               &options, grown.low.data(), grown.high.data(), grown.sides.data(),
                               grown.sides.size()));
        return grown;
    }
};

} // namespace detail

} // namespace cstk

#endif
