/* Part of cstk.hpp: octrees of occupied cells. */
#ifndef CSTK_OCTREE_HPP
#define CSTK_OCTREE_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/environment.hpp>
#include <cstk/error.hpp>
#include <cstk/hierarchy.hpp>
#include <cstk/pose.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cstk {

/// Which cells of a grid are occupied; it changes while it is placed in an environment.
class Octree : public Handle<cstk_octree, cstk_octree_retain, cstk_octree_release> {
public:
    using Progress = cstk::Progress;

    /// Without occupied cells; `resolution` is the edge of a cell.
    explicit Octree(double resolution) : Handle(create(resolution)) {}

    /// From an OctoMap file (.bt or .ot).
    [[nodiscard]] static Octree load(const std::string &file, double min_occupancy = 0.5) {
        cstk_octree *out = nullptr;
        check(cstk_octree_load(file.c_str(), min_occupancy, &out));
        return Octree(out);
    }

    /// Makes the cells around points, three doubles each, occupied or empty; returns how many changed.
    std::size_t set(Span<double> xyz, bool occupied = true) {
        std::size_t changed = 0;
        check(cstk_octree_set(get(), xyz.data(), points(xyz), occupied, &changed));
        return changed;
    }

    /// Whether the cell around a point is occupied.
    [[nodiscard]] bool get_cell(const Body::Vector &point) const {
        bool occupied = false;
        check(cstk_octree_get(get(), point.data(), 1, &occupied));
        return occupied;
    }

    /// Makes the cells occupied that are occupied in another octree.
    void insert(const Octree &other) { check(cstk_octree_insert(get(), other.get())); }

    [[nodiscard]] double resolution() const {
        double out = 0;
        check(cstk_octree_get_state(get(), &out, nullptr, nullptr));
        return out;
    }

    [[nodiscard]] std::uint64_t cell_count() const {
        std::uint64_t out = 0;
        check(cstk_octree_get_state(get(), nullptr, &out, nullptr));
        return out;
    }

    /// How many s-objects it is in its environment.
    [[nodiscard]] std::size_t object_count() const {
        std::size_t out = 0;
        check(cstk_octree_get_state(get(), nullptr, nullptr, &out));
        return out;
    }

    /// The occupied cells as cubes, as large as can be: lowest corner and edge, four doubles each.
    [[nodiscard]] std::vector<double> cubes() const {
        std::size_t count = 0;
        check(cstk_octree_get_cubes(get(), 0, nullptr, &count));
        std::vector<double> cubes(4 * count);
        check(cstk_octree_get_cubes(get(), count, cubes.data(), &count));
        return cubes;
    }

    /// A body of the occupied cells, which does not change any more.
    [[nodiscard]] Body build_body(const cstk_hierarchy_options &options = hierarchy_options(), Progress progress = {}) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_body *out = nullptr;
        report.check(cstk_octree_build_body(get(), &options, report.function(), &report, &out));
        return Body(out);
    }

    /// From now on changes change the environment too. `data` is the user data of its objects.
    void place(Environment &environment, const Pose &pose = identity(), void *data = nullptr,
               cstk_destroy_fn destroy = nullptr) {
        check(cstk_octree_place(get(), environment.get(), pose.data(), data, destroy));
    }

    void move(const Pose &pose) { check(cstk_octree_move(get(), pose.data())); }

    /// Takes it out of its environment.
    void remove() { check(cstk_octree_remove(get())); }

private:
    explicit Octree(cstk_octree *owned) : Handle(owned) {}

    static cstk_octree *create(double resolution) {
        cstk_octree *out = nullptr;
        check(cstk_octree_create(resolution, &out));
        return out;
    }

    static std::size_t points(Span<double> xyz) {
        if (xyz.size() % 3 != 0) {
            throw std::invalid_argument("cstk: a point has three coordinates");
        }
        return xyz.size() / 3;
    }
};

} // namespace cstk

#endif
