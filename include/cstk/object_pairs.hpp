/* Part of cstk.hpp: queries of the objects of environments. */
#ifndef CSTK_OBJECT_PAIRS_HPP
#define CSTK_OBJECT_PAIRS_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/environment.hpp>
#include <cstk/error.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>

namespace cstk {

/// The default options of cstk_environment_pairs and its companions.
[[nodiscard]] inline cstk_object_pair_options object_pair_options(bool with_distances = false) {
    cstk_object_pair_options options;
    check(cstk_object_pair_options_default(&options, sizeof options));
    options.with_distances = with_distances ? 1 : 0;
    return options;
}

namespace detail {

/* A filter of pairs of objects: a function of the two ids and the two data that returns bool. What it throws is kept, and thrown again
   after the call: no exception may pass through C. */
template <typename F> struct ObjectFilter {
    F &function;
    std::exception_ptr thrown;

    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(std::uint64_t r, std::uint64_t s, void *r_data, void *s_data, bool *out,
                             void *user) noexcept {
        ObjectFilter &filter = *static_cast<ObjectFilter *>(user);
        try {
            *out = filter.function(r, s, r_data, s_data);
            return 0;
        } catch (...) {
            filter.thrown = std::current_exception();
            return 1;
        }
    }
};

/// What Query answers of the objects of one environment, or of two.
template <typename Query> class ObjectPairQueries {
public:
    /// The pairs of objects at most `distance` apart, in order of ids: of an environment with another, or, where `other` is null,
    /// within it.
    [[nodiscard]] cstk_object_pair_list
    environment_pairs(const Environment &environment, const Environment *other, double distance,
                      std::size_t max_count = 4096,
                      const cstk_object_pair_options &options = object_pair_options()) {
        cstk_object_pair_list out;
        check(cstk_environment_pairs(query_of(*this), environment.get(), other ? detail::given(*other) : nullptr, distance,
                                     max_count, &options, &out));
        return out;
    }

    /// The same of the pairs for which `filter`, a function of the two ids and the two data, returns true. What it throws passes
    /// through.
    template <typename F>
    [[nodiscard]] cstk_object_pair_list filtered_pairs(const Environment &environment, const Environment *other,
                                         double distance, F &&filter,
                                         std::size_t max_count = 4096,
                                         bool with_distances = false) {
        cstk_object_pair_list out;
        detail::ObjectFilter<F> call{filter, nullptr};
        cstk_object_pair_options options = object_pair_options(with_distances);
        options.filter = &detail::ObjectFilter<F>::call;
        options.user = &call;
        call.check(cstk_environment_pairs(query_of(*this), environment.get(), other ? detail::given(*other) : nullptr,
                                          distance, max_count, &options, &out));
        return out;
    }

    /// Whether any two objects are at most `threshold` apart.
    [[nodiscard]] bool environment_within(const Environment &environment, const Environment *other, double threshold,
                            const cstk_object_pair_options &options = object_pair_options()) {
        bool out = false;
        check(cstk_environment_within(query_of(*this), environment.get(), other ? detail::given(*other) : nullptr,
                                      threshold, &options, &out));
        return out;
    }

    /// The distance of the nearest two objects.
    [[nodiscard]] cstk_distance_result
    environment_distance(const Environment &environment, const Environment *other,
                         double max_distance = std::numeric_limits<double>::infinity(),
                         const cstk_object_pair_options &options = object_pair_options()) {
        cstk_distance_result out;
        check(cstk_environment_distance(query_of(*this), environment.get(), other ? detail::given(*other) : nullptr,
                                        max_distance, &options, &out));
        return out;
    }

    /// All pairs of primitives of two objects at most `epsilon` apart, nearest first, and their contacts.
    [[nodiscard]] cstk_witness_list
    environment_witnesses(const Environment &environment, const Environment *other, double epsilon,
                          std::size_t max_count = 4096,
                          const cstk_object_pair_options &options = object_pair_options()) {
        cstk_witness_list out;
        check(cstk_environment_witnesses(query_of(*this), environment.get(), other ? detail::given(*other) : nullptr,
                                         epsilon, max_count, &options, &out));
        return out;
    }
};

} // namespace detail

} // namespace cstk

#endif
