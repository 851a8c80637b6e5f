/* Part of cstk.hpp: query contexts, which answer all queries. */
#ifndef CSTK_QUERY_HPP
#define CSTK_QUERY_HPP

#include <cstk.h>
#include <cstk/at_configuration.hpp>
#include <cstk/depth.hpp>
#include <cstk/detail.hpp>
#include <cstk/environment.hpp>
#include <cstk/error.hpp>
#include <cstk/motion.hpp>
#include <cstk/object_pairs.hpp>
#include <cstk/pair.hpp>
#include <cstk/path.hpp>
#include <cstk/region.hpp>
#include <cstk/slide.hpp>

#include <cstdint>

namespace cstk {

/// A query context; one per thread. A call changes it: the lists of the call before are gone. It can be moved, and is not copied: a
/// copy would be the same context.
class Query : public Handle<cstk_query, cstk_query_retain, cstk_query_release>,
              public detail::ConfigurationQueries<Query>,
              public detail::PairQueries<Query>,
              public detail::ObjectPairQueries<Query>,
              public detail::DepthQueries<Query>,
              public detail::MotionQueries<Query>,
              public detail::PathQueries<Query>,
              public detail::RegionQueries<Query>,
              public detail::SlideQueries<Query> {
public:
    Query() : Handle(create()) {}
    Query(Query &&) noexcept = default;
    Query &operator=(Query &&) noexcept = default;

    /// The version of an environment that the last query saw.
    [[nodiscard]] std::uint64_t version(const Environment &environment) const {
        std::uint64_t out = 0;
        check(cstk_query_get_version(get(), environment.get(), &out));
        return out;
    }

    /// Which contacts come with the witnesses of lists from now on.
    void set_contacts(cstk_contacts_listed listed) {
        check(cstk_query_set_contacts(get(), listed));
    }

    /// Limits the work of each query from now on; 0 for no limit. A query that needs more fails with CSTK_ERROR_LIMIT.
    void set_limit(std::uint64_t node_and_primitive_pairs) {
        check(cstk_query_set_limit(get(), node_and_primitive_pairs));
    }

    /// Refines curved surfaces until later answers are known to `gap`; infinity for never.
    void set_refinement(double gap) { check(cstk_query_set_refinement(get(), gap)); }

    cstk_query_statistics statistics(bool reset = false) {
        cstk_query_statistics out;
        check(cstk_query_get_statistics(get(), reset, &out));
        return out;
    }

private:
    static cstk_query *create() {
        cstk_query *out = nullptr;
        check(cstk_query_create(&out));
        return out;
    }
};

} // namespace cstk

#endif
