/* Part of cstk.hpp: answers in words, for messages and logs. */
#ifndef CSTK_DESCRIBE_HPP
#define CSTK_DESCRIBE_HPP

#include <cstk.h>
#include <cstk/environment.hpp>
#include <cstk/space.hpp>

#include <cstdint>
#include <string>

namespace cstk {

[[nodiscard]] inline const char *to_string(cstk_class point_class) noexcept {
    switch (point_class) {
    case CSTK_CLASS_OUTSIDE:
        return "outside";
    case CSTK_CLASS_CONTACT:
        return "contact";
    case CSTK_CLASS_INSIDE:
        return "inside";
    }
    return "no class";
}

[[nodiscard]] inline const char *to_string(cstk_motion_outcome outcome) noexcept {
    switch (outcome) {
    case CSTK_MOTION_FREE:
        return "free";
    case CSTK_MOTION_HIT:
        return "hit";
    case CSTK_MOTION_NEAR:
        return "near";
    case CSTK_MOTION_UNDECIDED:
        return "undecided";
    }
    return "no outcome";
}

namespace detail {

inline std::string object_in_words(const Environment &environment, std::uint64_t id) {
    std::string name;
    try {
        name = environment.object_name(id);
    } catch (const Error &) {
        /* It is gone, or in another environment. */
    }
    return name.empty() ? "object " + std::to_string(id) : name;
}

} // namespace detail

/// The two that a witness is about, by their names: "wrist x table", "gripper (mug) x shelf", "elbow x base"; of a pure set "coordinate 2",
/// "wrist" or "a pure set". `environment` is the one that the witness's set is of.
[[nodiscard]] inline std::string describe(const Space &space, const Environment &environment, const cstk_witness &witness) {
    if (witness.r_link == CSTK_NONE) {
        return witness.coordinate == CSTK_NONE ? "a pure set" : "coordinate " + std::to_string(witness.coordinate);
    }
    std::string r = space.link_name(witness.r_link);
    if (witness.r_object != 0) {
        r += " (" + detail::object_in_words(environment, witness.r_object) + ")";
    }
    if (witness.s_object != 0) {
        return r + " x " + detail::object_in_words(environment, witness.s_object);
    }
    if (witness.s_link != CSTK_NONE) {
        return r + " x " + space.link_name(witness.s_link);
    }
    return r;
}

} // namespace cstk

#endif
