/* Part of cstk.hpp: queries at a configuration and at link poses. */
#ifndef CSTK_AT_CONFIGURATION_HPP
#define CSTK_AT_CONFIGURATION_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/progress.hpp>
#include <cstk/space.hpp>
#include <cstk/span.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cstk {

[[nodiscard]] inline cstk_link_pair_options link_pair_options() {
    cstk_link_pair_options options;
    check(cstk_link_pair_options_default(&options, sizeof options));
    return options;
}

[[nodiscard]] inline cstk_clear_pair_options clear_pair_options() {
    cstk_clear_pair_options options;
    check(cstk_clear_pair_options_default(&options, sizeof options));
    return options;
}

/// The links that may come near each other.
struct LinkPairs {
    /// All pairs, with what was found of each.
    std::vector<cstk_link_pair> pairs;
    /// Those to test, for CObject::induced_links().
    std::vector<std::array<std::uint32_t, 2>> tested;
};

namespace detail {

/// What Query answers at one configuration.
template <typename Query> class ConfigurationQueries {
public:
    [[nodiscard]] cstk_class classify(const CObject &cobject, Span<double> q) {
        cstk_class out = CSTK_CLASS_OUTSIDE;
        check(cstk_classify(query_of(*this), cobject.get(), q.data(), q.size(), &out));
        return out;
    }

    [[nodiscard]] bool within(const CObject &cobject, Span<double> q, double threshold) {
        bool out = false;
        check(cstk_within(query_of(*this), cobject.get(), q.data(), q.size(), threshold, &out));
        return out;
    }

    [[nodiscard]] cstk_distance_result
    distance(const CObject &cobject, Span<double> q,
             double max_distance = std::numeric_limits<double>::infinity()) {
        cstk_distance_result out;
        check(cstk_distance(query_of(*this), cobject.get(), q.data(), q.size(), max_distance, &out));
        return out;
    }

    /// The distance, and its derivative with respect to each velocity, for which `gradient` has room: zeros where the answer has no
    /// contact.
    [[nodiscard]] cstk_distance_result
    distance_with_gradient(const CObject &cobject, Span<double> q, std::vector<double> &gradient,
                           double max_distance = std::numeric_limits<double>::infinity()) {
        cstk_distance_result out;
        check(cstk_distance_with_gradient(query_of(*this), cobject.get(), q.data(), q.size(), max_distance, &out,
                                          gradient.data(), gradient.size()));
        return out;
    }

    [[nodiscard]] cstk_witness_list witnesses(const CObject &cobject, Span<double> q, double epsilon,
                                std::size_t max_count = 4096) {
        cstk_witness_list out;
        check(cstk_witnesses(query_of(*this), cobject.get(), q.data(), q.size(), epsilon, max_count, &out));
        return out;
    }

    [[nodiscard]] cstk_witness_list gradients(const CObject &cobject, Span<double> q, double epsilon,
                                std::size_t max_count = 4096) {
        cstk_witness_list out;
        check(cstk_gradients(query_of(*this), cobject.get(), q.data(), q.size(), epsilon, max_count, &out));
        return out;
    }

    [[nodiscard]] cstk_pseudo_normal_result pseudo_normal(const CObject &cobject, Span<double> q,
                                            double max_shell, std::size_t max_count = 4096,
                                            bool normalize = false) {
        cstk_pseudo_normal_result out;
        check(cstk_pseudo_normal(query_of(*this), cobject.get(), q.data(), q.size(), max_shell, max_count,
                                 normalize, &out));
        return out;
    }

    /// Which pairs of links to test for self-collision, and why the others need not be.
    [[nodiscard]] LinkPairs find_link_pairs(const Space &space, const cstk_link_pair_options &options = link_pair_options(),
                                            Progress progress = {}) {
        Report report{std::move(progress), nullptr};
        cstk_link_pair_list list;
        report.check(cstk_find_link_pairs(query_of(*this), space.get(), &options, report.function(), &report, &list));
        LinkPairs found{{list.pairs, list.pairs + list.count}, {}};
        found.tested.resize(list.tested_count);
        for (std::size_t i = 0; i < found.tested.size(); ++i) {
            found.tested[i] = {list.tested[2 * i], list.tested[2 * i + 1]};
        }
        return found;
    }

    /// A copy of a set of link pairs that knows by proof where its links are apart.
    [[nodiscard]] CObject prove_clear_pairs(const CObject &cobject,
                              const cstk_clear_pair_options &options = clear_pair_options(),
                              cstk_clear_pair_summary *summary = nullptr, Progress progress = {}) {
        Report report{std::move(progress), nullptr};
        cstk_cobject *out = nullptr;
        report.check(cstk_prove_clear_pairs(query_of(*this), cobject.get(), &options, report.function(), &report,
                                            summary, &out));
        return CObject(out);
    }

    /// The class, and which leaves and pairs made it.
    [[nodiscard]] cstk_explanation explain(const CObject &cobject, Span<double> q,
                             std::size_t max_count = 4096) {
        cstk_explanation out;
        check(cstk_explain(query_of(*this), cobject.get(), q.data(), q.size(), max_count, &out));
        return out;
    }

    /// The same queries at given link poses: 12 doubles for every link of the space.
    [[nodiscard]] cstk_class classify_at_link_poses(const CObject &cobject, Span<Pose> links) {
        cstk_class out = CSTK_CLASS_OUTSIDE;
        check(cstk_classify_at_link_poses(query_of(*this), cobject.get(), flat(links), links.size(), &out));
        return out;
    }

    [[nodiscard]] bool within_at_link_poses(const CObject &cobject, Span<Pose> links, double threshold) {
        bool out = false;
        check(cstk_within_at_link_poses(query_of(*this), cobject.get(), flat(links), links.size(), threshold, &out));
        return out;
    }

    [[nodiscard]] cstk_distance_result
    distance_at_link_poses(const CObject &cobject, Span<Pose> links,
                double max_distance = std::numeric_limits<double>::infinity()) {
        cstk_distance_result out;
        check(cstk_distance_at_link_poses(query_of(*this), cobject.get(), flat(links), links.size(), max_distance, &out));
        return out;
    }

    [[nodiscard]] cstk_witness_list witnesses_at_link_poses(const CObject &cobject, Span<Pose> links, double epsilon,
                                   std::size_t max_count = 4096) {
        cstk_witness_list out;
        check(cstk_witnesses_at_link_poses(query_of(*this), cobject.get(), flat(links), links.size(), epsilon, max_count,
                                &out));
        return out;
    }

    [[nodiscard]] cstk_explanation explain_at_link_poses(const CObject &cobject, Span<Pose> links,
                                                         std::size_t max_count = 4096) {
        cstk_explanation out;
        check(cstk_explain_at_link_poses(query_of(*this), cobject.get(), flat(links), links.size(), max_count, &out));
        return out;
    }

private:
    static const double *flat(Span<Pose> links) {
        return links.size() == 0 ? nullptr : links.data()->data();
    }
};

} // namespace detail

} // namespace cstk

#endif
