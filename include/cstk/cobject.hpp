/* Part of cstk.hpp: C-objects: induced sets, pure sets, and what is made of them. */
#ifndef CSTK_COBJECT_HPP
#define CSTK_COBJECT_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/environment.hpp>
#include <cstk/error.hpp>
#include <cstk/predicate.hpp>
#include <cstk/space.hpp>
#include <cstk/span.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// `margin` keeps the robot that far from obstacles; set contact_epsilon, allowed pairs and leave_out_unmoved by their names.
[[nodiscard]] inline cstk_induced_options induced_options(double margin = 0) {
    cstk_induced_options options;
    check(cstk_induced_options_default(&options, sizeof options));
    options.margin = margin;
    return options;
}

/// Set contact_epsilon and scale by their names.
[[nodiscard]] inline cstk_pure_options pure_options() {
    cstk_pure_options options;
    check(cstk_pure_options_default(&options, sizeof options));
    return options;
}

class CObject : public Handle<cstk_cobject, cstk_cobject_retain, cstk_cobject_release> {
public:
    using Handle::Handle;

    /// No links: all of the space, with what is attached to them, be it to a frame without a body. Of given links no other is tested, nor
    /// what is attached to others. No ids: all objects of the environment. Where the robot stands on one of them, set leave_out_unmoved.
    [[nodiscard]] static CObject induced(const Space &space, const Environment &environment,
                           const cstk_induced_options &options = induced_options(),
                           Span<std::uint32_t> links = {}, Span<std::uint64_t> ids = {}) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_induced(space.get(), links.data(), links.size(), environment.get(),
                                   ids.data(), ids.size(), &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject induced_links(const Space &space,
                                 const std::vector<std::array<std::uint32_t, 2>> &pairs,
                                 const cstk_induced_options &options = induced_options()) {
        std::vector<std::uint32_t> flat;
        for (const auto &pair : pairs) {
            flat.insert(flat.end(), pair.begin(), pair.end());
        }
        cstk_cobject *out = nullptr;
        check(cstk_cobject_induced_links(space.get(), flat.data(), pairs.size(), &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject union_of(const std::vector<CObject> &parts) {
        return combined(cstk_cobject_union, parts);
    }

    [[nodiscard]] static CObject intersection_of(const std::vector<CObject> &parts) {
        return combined(cstk_cobject_intersection, parts);
    }

    [[nodiscard]] static CObject difference(const CObject &of, const CObject &without) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_difference(of.get(), without.get(), &out));
        return CObject(out);
    }

    [[nodiscard]] CObject complement() const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_complement(get(), &out));
        return CObject(out);
    }

    /// Where a coordinate is beyond its range.
    [[nodiscard]] static CObject beyond_limits(const Space &space, const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_beyond_limits(space.get(), &options, &out));
        return CObject(out);
    }

    /// Where a link's origin is outside the world box.
    [[nodiscard]] static CObject beyond_world(const Space &space, const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_beyond_world(space.get(), &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject box(const Space &space, Span<double> low, Span<double> high,
                       const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_box(space.get(), low.data(), high.data(), detail::same_size(low, high),
                               &options, &out));
        return CObject(out);
    }

    /// Where normal . q <= offset.
    [[nodiscard]] static CObject halfspace(const Space &space, Span<double> normal, double offset,
                             const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_halfspace(space.get(), normal.data(), normal.size(), offset, &options,
                                     &out));
        return CObject(out);
    }

    /// Where a link's body reaches normal . x <= offset of the world; no links for all.
    [[nodiscard]] static CObject below_floor(const Space &space, const std::array<double, 3> &normal, double offset,
                         Span<std::uint32_t> links = {},
                         const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_below_floor(space.get(), links.data(), links.size(), normal.data(), offset,
                                 &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject ball(const Space &space, Span<double> center, double radius,
                        const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_ball(space.get(), center.data(), center.size(), radius, &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject predicate(const Space &space, const cstk_predicate &predicate,
                             const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_predicate(space.get(), &predicate, &options, &out));
        return CObject(out);
    }

    [[nodiscard]] static CObject predicate(const Space &space, Predicate functions,
                             const cstk_pure_options &options = pure_options()) {
        auto kept = std::make_unique<Predicate>(std::move(functions));
        cstk_predicate given = cstk::predicate();
        given.classify = kept->classify ? &detail::PredicateCalls::classify : nullptr;
        given.distance = kept->distance ? &detail::PredicateCalls::distance : nullptr;
        given.gradient = kept->gradient ? &detail::PredicateCalls::gradient : nullptr;
        given.distance_is_bound = kept->distance_is_bound;
        given.knows_depth = kept->knows_depth;
        given.user = kept.get();
        given.destroy = &detail::PredicateCalls::destroy;
        CObject made = predicate(space, given, options);
        /* The library's now. */
        static_cast<void>(kept.release());
        return made;
    }

    /// The same set, carrying data that answers hand back where it is a leaf.
    [[nodiscard]] CObject with_data(void *data, cstk_destroy_fn destroy = nullptr) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_data(get(), data, destroy, &out));
        return CObject(out);
    }

    /// The same induced or pure set with a shell of its own for slides.
    [[nodiscard]] CObject with_shell(double shell) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_shell(get(), shell, &out));
        return CObject(out);
    }

    /// The same set with what the caller knows of it: its class, outside or inside, in the interior of boxes, balls and polytopes.
    [[nodiscard]] CObject with_known(const CObject &within, cstk_class known) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_known(get(), within.get(), known, &out));
        return CObject(out);
    }

    /// The space that the set is in.
    [[nodiscard]] Space space() const {
        cstk_space *out = nullptr;
        check(cstk_cobject_get_space(get(), &out));
        return Space(out);
    }

    [[nodiscard]] void *data() const {
        void *data = nullptr;
        check(cstk_cobject_get_data(get(), &data, nullptr));
        return data;
    }

    /// By which witnesses and explanations name it as a leaf.
    [[nodiscard]] std::uint64_t number() const {
        std::uint64_t number = 0;
        check(cstk_cobject_get_data(get(), nullptr, &number));
        return number;
    }

    void show(Span<double> q, const std::string &file) const {
        check(cstk_show(get(), q.data(), q.size(), file.c_str()));
    }

    /// The same of configurations that are vectors of their own.
    void show_path(const std::vector<std::vector<double>> &points, double seconds, const std::string &file) const {
        show_path(detail::flattened(points), points.size(), seconds, file);
    }

    /// The robots move along a path within so many seconds: `points` holds `count` configurations, one after the other.
    void show_path(Span<double> points, std::size_t count, double seconds,
                   const std::string &file) const {
        check(cstk_show_path(get(), points.data(), count, detail::parts_of(points, count), seconds,
                             file.c_str()));
    }

private:
    using Combine = cstk_status (*)(const cstk_cobject *const *, std::size_t, cstk_cobject **);

    static CObject combined(Combine combine, const std::vector<CObject> &parts) {
        std::vector<const cstk_cobject *> handles;
        for (const CObject &part : parts) {
            handles.push_back(part.get());
        }
        cstk_cobject *out = nullptr;
        check(combine(handles.data(), handles.size(), &out));
        return CObject(out);
    }
};

} // namespace cstk

#endif
