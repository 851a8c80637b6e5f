/* Part of cstk.hpp: statuses as exceptions. */
#ifndef CSTK_ERROR_HPP
#define CSTK_ERROR_HPP

#include <cstk.h>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace cstk {

/// A failed call: its status, and the library's message that names the culprit.
class Error : public std::runtime_error {
public:
    explicit Error(cstk_status status)
        : std::runtime_error(std::string(cstk_status_name(status)) + ": " +
                             cstk_last_error_message()),
          status_(status) {}

    cstk_status status() const noexcept { return status_; }

private:
    cstk_status status_;
};

namespace detail {

/* What a function of a Predicate threw last on this thread: no exception may pass through C, so
 * that it is thrown again after the call. */
inline std::exception_ptr &thrown_by_function() {
    static thread_local std::exception_ptr thrown;
    return thrown;
}

} // namespace detail

/// Throws unless the status is CSTK_OK: an Error, or what a function of yours threw.
inline void check(cstk_status status) {
    if (status == CSTK_OK) {
        return;
    }
    if (status == CSTK_ERROR_CALLBACK_FAILED) {
        if (const std::exception_ptr thrown =
                std::exchange(detail::thrown_by_function(), nullptr)) {
            std::rethrow_exception(thrown);
        }
    }
    throw Error(status);
}

} // namespace cstk

#endif
