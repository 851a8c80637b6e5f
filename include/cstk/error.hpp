/* Part of cstk.hpp: statuses as exceptions. */
#ifndef CSTK_ERROR_HPP
#define CSTK_ERROR_HPP

#include <cstk.h>

#include <stdexcept>
#include <string>

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

/// Throws unless the status is CSTK_OK.
inline void check(cstk_status status) {
    if (status != CSTK_OK) {
        throw Error(status);
    }
}

} // namespace cstk

#endif
