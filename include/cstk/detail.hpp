/* Part of cstk.hpp: what its headers share: handles, checks of lengths, the context of the parts of Query. */
#ifndef CSTK_DETAIL_HPP
#define CSTK_DETAIL_HPP

#include <cstk.h>
#include <cstk/error.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// One reference to an object of the library; empty when default-constructed or moved from.
template <typename T, cstk_status (*Retain)(T *), cstk_status (*Release)(T *)> class Handle {
public:
    Handle() = default;
    /// Takes over the reference that a _create or _build call gave.
    explicit Handle(T *owned) noexcept : object_(owned) {}
    Handle(const Handle &other) : object_(other.object_) {
        if (object_ != nullptr) {
            check(Retain(object_));
        }
    }
    Handle(Handle &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Handle &operator=(Handle other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() { Release(object_); }

    T *get() const noexcept { return object_; }
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    T *object_ = nullptr;
};

namespace detail {

/// The object of a handle, where C would take NULL for something else.
template <typename T, cstk_status (*Retain)(T *), cstk_status (*Release)(T *)>
T *given(const Handle<T, Retain, Release> &handle) {
    if (!handle) {
        throw std::invalid_argument("cstk: a handle is empty: default-constructed, or moved from");
    }
    return handle.get();
}

/// The columns of a Jacobian of 6 rows.
inline std::size_t columns(const std::vector<double> &jacobian) {
    if (jacobian.size() % 6 != 0) {
        throw std::invalid_argument("cstk: a Jacobian has 6 rows");
    }
    return jacobian.size() / 6;
}

/// The length of both configurations.
inline std::size_t same_size(Span<double> q0, Span<double> q1) {
    if (q0.size() != q1.size()) {
        throw std::invalid_argument("cstk: two configurations have the same length");
    }
    return q0.size();
}

/// The length of each of `count` configurations, one after the other.
inline std::size_t parts_of(Span<double> points, std::size_t count) {
    if (count == 0 || points.size() % count != 0) {
        throw std::invalid_argument("cstk: there is at least one point, and all are of one size");
    }
    return points.size() / count;
}

/// The text that a call writes to a buffer, given the buffer, its size and where to put the text's length.
template <typename Call> std::string text_of(Call call) {
    std::size_t length = 0;
    check(call(static_cast<char *>(nullptr), std::size_t{0}, &length));
    /* With room for the terminator, which strings have too. */
    std::string out(length + 1, '\0');
    check(call(out.data(), out.size(), static_cast<std::size_t *>(nullptr)));
    out.resize(length);
    return out;
}

/// Configurations one after the other.
inline std::vector<double> flattened(const std::vector<std::vector<double>> &points) {
    std::vector<double> all;
    for (const std::vector<double> &point : points) {
        if (point.size() != points.front().size()) {
            throw std::invalid_argument("cstk: the points of a path are of one size");
        }
        all.insert(all.end(), point.begin(), point.end());
    }
    return all;
}

/* The context of the query of which `part` is one part. */
template <template <typename> class Part, typename Query> cstk_query *query_of(Part<Query> &part) {
    return static_cast<Query &>(part).get();
}

} // namespace detail

} // namespace cstk

#endif
