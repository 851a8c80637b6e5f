/* Part of cstk.hpp: what is in the lists of answers, to be walked by `for` loops. The views last as long as the lists: until the next call
 * with the query that they come from. */
#ifndef CSTK_LISTS_HPP
#define CSTK_LISTS_HPP

#include <cstk.h>
#include <cstk/span.hpp>

#include <cstddef>
#include <vector>

namespace cstk {

/// All witnesses, nearest first.
[[nodiscard]] inline Span<cstk_witness> witnesses_of(const cstk_witness_list &list) noexcept {
    return {list.witnesses, list.witness_count};
}

/// The contacts of all witnesses.
[[nodiscard]] inline Span<cstk_contact> contacts_of(const cstk_witness_list &list) noexcept {
    return {list.contacts, list.contact_count};
}

/// The contacts of one witness of the list; none where its primitives overlap.
[[nodiscard]] inline Span<cstk_contact> contacts_of(const cstk_witness_list &list, const cstk_witness &witness) noexcept {
    if (witness.contact_count == 0) {
        return {};
    }
    return {list.contacts + witness.first_contact, witness.contact_count};
}

/// The derivative of a contact's distance with respect to each velocity; `contact` is one of the list's own. Empty without gradients.
[[nodiscard]] inline Span<double> gradient_of(const cstk_witness_list &list, const cstk_contact &contact) noexcept {
    if (list.gradients == nullptr) {
        return {};
    }
    return {list.gradients + static_cast<std::size_t>(&contact - list.contacts) * list.nv, list.nv};
}

/// The class of each leaf.
[[nodiscard]] inline Span<cstk_verdict> leaves_of(const cstk_explanation &explanation) noexcept {
    return {explanation.leaves, explanation.leaf_count};
}

/// The deepest first.
[[nodiscard]] inline Span<cstk_penetration> penetrations_of(const cstk_penetration_list &list) noexcept {
    return {list.penetrations, list.count};
}

/// In order of ids.
[[nodiscard]] inline Span<cstk_object_pair> pairs_of(const cstk_object_pair_list &list) noexcept {
    return {list.pairs, list.count};
}

/// The least distance first.
[[nodiscard]] inline Span<cstk_signed_distance> pairs_of(const cstk_signed_distance_list &list) noexcept {
    return {list.pairs, list.count};
}

/// The derivative of a pair's distance with respect to each velocity; `pair` is one of the list's own, and its gradient_kind says what it is.
[[nodiscard]] inline Span<double> gradient_of(const cstk_signed_distance_list &list, const cstk_signed_distance &pair) noexcept {
    return {list.gradients + static_cast<std::size_t>(&pair - list.pairs) * list.nv, list.nv};
}

/// The configurations of a path.
[[nodiscard]] inline std::vector<std::vector<double>> configurations_of(const cstk_path &path) {
    std::vector<std::vector<double>> points;
    points.reserve(path.count);
    for (std::size_t i = 0; i < path.count; ++i) {
        const double *q = path.points + i * path.nq;
        points.emplace_back(q, q + path.nq);
    }
    return points;
}

} // namespace cstk

#endif
