/* Part of cstk.hpp: lists as the calls take them. */
#ifndef CSTK_SPAN_HPP
#define CSTK_SPAN_HPP

#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace cstk {

namespace detail {

/* Whether items lie one after the other: of all containers, but of Eigen's only vectors without a stride and matrices that own their
 * numbers. Others may skip some: a row of a matrix kept by columns, a block. */
template <typename Container, typename = void> struct IsContiguous : std::true_type {};
template <typename Container>
struct IsContiguous<Container, std::void_t<decltype(Container::InnerStrideAtCompileTime), typename Container::PlainObject>>
    : std::bool_constant<static_cast<int>(Container::InnerStrideAtCompileTime) == 1 &&
                         (Container::IsVectorAtCompileTime || std::is_same_v<Container, typename Container::PlainObject>)> {};

} // namespace detail

/// A view of contiguous items: from std::vector, std::array, a C array, a vector of Eigen's, or a pointer and a count.
template <typename T> class Span {
public:
    Span() = default;
    Span(const T *data, std::size_t size) : data_(data), size_(size) {}
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 9
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winit-list-lifetime"
#endif
    /// A list in braces lives until the end of the call it is written in.
    Span(std::initializer_list<T> items) : data_(items.begin()), size_(items.size()) {}
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 9
#pragma GCC diagnostic pop
#endif
    template <std::size_t N> Span(const T (&items)[N]) : data_(items), size_(N) {}
    template <typename Container,
              typename = std::enable_if_t<std::is_convertible_v<
                  decltype(std::declval<const Container &>().data()), const T *>>>
    Span(const Container &items) : data_(items.data()), size_(static_cast<std::size_t>(items.size())) {
        static_assert(detail::IsContiguous<Container>::value,
                      "cstk: these items do not lie one after the other, as those of a matrix's row do not: copy them, or keep the "
                      "matrix by rows (Eigen::RowMajor)");
    }

    const T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    const T &operator[](std::size_t index) const { return data_[index]; }
    const T *begin() const noexcept { return data_; }
    const T *end() const noexcept { return data_ + size_; }

private:
    const T *data_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace cstk

#endif
