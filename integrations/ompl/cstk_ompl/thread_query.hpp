// A query context for each thread.
#pragma once

#include <cstk.hpp>

namespace cstk_ompl {

/// OMPL's parallel planners ask from several threads; a query context serves one of them.
inline cstk::Query &thread_query() {
    static thread_local cstk::Query query;
    return query;
}

} // namespace cstk_ompl
