/* Part of cstk.hpp: maps of C-space. */
#ifndef CSTK_MAP_HPP
#define CSTK_MAP_HPP

#include <cstk.h>
#include <cstk/cobject.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace cstk {

/// Options of maps.
[[nodiscard]] inline cstk_map_options map_options(cstk_map_kind kind = CSTK_MAP_CLASSES, std::uint32_t threads = 0) {
    cstk_map_options options;
    check(cstk_map_options_default(&options, sizeof options));
    options.kind = kind;
    options.threads = threads;
    return options;
}

/// An interval of a coordinate, cut into cells; the map is of `count` of them from `first` on, by default of all.
[[nodiscard]] inline cstk_map_axis map_axis(std::uint32_t coordinate, double low, double high, std::size_t cells, std::size_t first = 0,
                              std::size_t count = 0) {
    return {coordinate, 0, low, high, cells, first, count};
}

/// What is free on a grid over some coordinates.
class Map : public Handle<cstk_map, cstk_map_retain, cstk_map_release> {
public:
    using Handle::Handle;

    /// The coordinates without an axis are those of q.
    [[nodiscard]] static Map build(const CObject &cobject, Span<double> q, Span<cstk_map_axis> axes,
                     const cstk_map_options &options = map_options(), Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        cstk_map *out = nullptr;
        report.check(cstk_map_build(cobject.get(), q.data(), q.size(), axes.data(), axes.size(),
                                    &options, report.function(), &report, &out));
        return Map(out);
    }

    /// Its arrays are valid as long as the map.
    [[nodiscard]] cstk_map_view view() const {
        cstk_map_view out;
        check(cstk_map_get_view(get(), &out));
        return out;
    }

    /// Writes an array of NumPy's (.npy).
    void save(const std::string &file) const { check(cstk_map_save(get(), file.c_str())); }

    /// Writes a picture (.png) of a map with two axes, the boundary (.glb) of one with three.
    void show(const std::string &file) const { check(cstk_map_show(get(), file.c_str())); }
};

} // namespace cstk

#endif
