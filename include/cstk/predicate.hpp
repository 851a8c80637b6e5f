/* Part of cstk.hpp: sets by functions of yours. */
#ifndef CSTK_PREDICATE_HPP
#define CSTK_PREDICATE_HPP

#include <cstk.h>
#include <cstk/error.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

namespace cstk {

/// A set by C functions of yours. They must not throw.
[[nodiscard]] inline cstk_predicate predicate() {
    cstk_predicate predicate;
    check(cstk_predicate_default(&predicate, sizeof predicate));
    return predicate;
}

/// A set by functions of yours; see cstk_predicate. Threads may call them at once. What they throw
/// ends the query, and is thrown by it; where another thread called them, as those of a batch do,
/// the query throws an Error of CSTK_ERROR_CALLBACK_FAILED.
struct Predicate {
    using Configuration = Span<double>;

    std::function<cstk_class(Configuration q)> classify;
    /// These two may be empty.
    std::function<double(Configuration q)> distance;
    /// Returns one entry for each velocity.
    std::function<std::vector<double>(Configuration q)> gradient;
    bool distance_is_bound = false;
    bool knows_depth = false;
};

namespace detail {

/* The functions of a Predicate as C calls them. No exception may pass through C. */
struct PredicateCalls {
    template <typename Action> static std::int32_t guarded(Action action) noexcept {
        try {
            return action() ? 0 : 1;
        } catch (...) {
            thrown_by_function() = std::current_exception();
            return 1;
        }
    }

    static const Predicate &functions(void *user) { return *static_cast<Predicate *>(user); }

    static std::int32_t classify(const double *q, std::size_t nq, std::int32_t *out,
                                 void *user) noexcept {
        return guarded([&] {
            *out = functions(user).classify({q, nq});
            return true;
        });
    }

    static std::int32_t distance(const double *q, std::size_t nq, double *out,
                                 void *user) noexcept {
        return guarded([&] {
            *out = functions(user).distance({q, nq});
            return true;
        });
    }

    static std::int32_t gradient(const double *q, std::size_t nq, double *row, std::size_t nv,
                                 void *user) noexcept {
        return guarded([&] {
            const std::vector<double> found = functions(user).gradient({q, nq});
            for (std::size_t i = 0; i < nv && found.size() == nv; ++i) {
                row[i] = found[i];
            }
            return found.size() == nv;
        });
    }

    static void destroy(void *user) { delete static_cast<Predicate *>(user); }
};

} // namespace detail

} // namespace cstk

#endif
