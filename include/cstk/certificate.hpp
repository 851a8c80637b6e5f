/* Part of cstk.hpp: certificates of free motions. */
#ifndef CSTK_CERTIFICATE_HPP
#define CSTK_CERTIFICATE_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// A proof that a motion is free. Empty where Query::motion_certificate found the motion not free.
class Certificate
    : public Handle<cstk_certificate, cstk_certificate_retain, cstk_certificate_release> {
public:
    using Handle::Handle;

    /// A certificate that save() wrote. It proves nothing before verify().
    [[nodiscard]] static Certificate load(const std::string &file) {
        cstk_certificate *out = nullptr;
        check(cstk_certificate_load(file.c_str(), &out));
        return Certificate(out);
    }

    void save(const std::string &file) const { check(cstk_certificate_save(get(), file.c_str())); }

    /// Throws CSTK_ERROR_NOT_PROVED, naming the entry, unless this proves the motion from q0 to q1 free.
    void verify(const CObject &cobject, Span<double> q0, Span<double> q1, double threshold = 0) const {
        const std::size_t nq = detail::same_size(q0, q1);
        check(cstk_certificate_verify(get(), cobject.get(), q0.data(), q1.data(), nq, threshold));
    }

    [[nodiscard]] cstk_certificate_summary summary() const {
        cstk_certificate_summary out;
        check(cstk_certificate_get_summary(get(), &out));
        return out;
    }

    /// The first and the last configuration of the motion.
    [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> ends() const {
        const std::size_t nq = summary().nq;
        std::pair<std::vector<double>, std::vector<double>> out{std::vector<double>(nq),
                                                                std::vector<double>(nq)};
        check(cstk_certificate_get_ends(get(), nq, out.first.data(), out.second.data()));
        return out;
    }

    [[nodiscard]] cstk_certificate_entry entry(std::size_t index) const {
        cstk_certificate_entry out;
        check(cstk_certificate_get_entry(get(), index, &out));
        return out;
    }

    /// The primitives of one side of an entry, 0 or 1.
    [[nodiscard]] std::vector<std::uint32_t> primitives(std::size_t index, std::uint32_t side) const {
        std::size_t count = 0;
        check(cstk_certificate_get_primitives(get(), index, side, 0, nullptr, &count));
        std::vector<std::uint32_t> out(count);
        check(cstk_certificate_get_primitives(get(), index, side, count, out.data(), &count));
        return out;
    }
};

} // namespace cstk

#endif
