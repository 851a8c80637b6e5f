/* Part of cstk.hpp: how bounding volume hierarchies are built. */
#ifndef CSTK_HIERARCHY_HPP
#define CSTK_HIERARCHY_HPP

#include <cstk.h>
#include <cstk/error.hpp>

namespace cstk {

/// An options structure with its defaults; set its fields as in C.
[[nodiscard]] inline cstk_hierarchy_options hierarchy_options() {
    cstk_hierarchy_options options;
    check(cstk_hierarchy_options_default(&options, sizeof options));
    return options;
}

} // namespace cstk

#endif
