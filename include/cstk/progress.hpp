/* Part of cstk.hpp: progress of long calls. */
#ifndef CSTK_PROGRESS_HPP
#define CSTK_PROGRESS_HPP

#include <cstk.h>
#include <cstk/error.hpp>

#include <cstdint>
#include <exception>
#include <functional>

namespace cstk {

/// Hears the progress of a long call. Return false to end the call with CSTK_ERROR_CANCELLED. Exceptions pass through to the caller.
using Progress = std::function<bool(double fraction)>;

namespace detail {

/* No exception may pass through C: it is kept, and thrown again after the call. */
struct Report {
    Progress progress;
    std::exception_ptr thrown;

    cstk_progress_fn function() const { return progress ? &Report::call : nullptr; }

    /* The status of the call that reported. */
    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(double fraction, void *user) noexcept {
        Report &report = *static_cast<Report *>(user);
        try {
            return report.progress(fraction) ? 0 : 1;
        } catch (...) {
            report.thrown = std::current_exception();
            return 1;
        }
    }
};

} // namespace detail

} // namespace cstk

#endif
