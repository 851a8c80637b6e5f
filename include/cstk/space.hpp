/* Part of cstk.hpp: the C-space of robots. */
#ifndef CSTK_SPACE_HPP
#define CSTK_SPACE_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/robot.hpp>
#include <cstk/span.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cstk {

[[nodiscard]] inline cstk_range circle() { return {CSTK_RANGE_CIRCLE, 0, 0, 0}; }

[[nodiscard]] inline cstk_range interval(double lower, double upper) {
    return {CSTK_RANGE_INTERVAL, 0, lower, upper};
}

/// What the joint says.
[[nodiscard]] inline cstk_range default_range() { return {CSTK_RANGE_DEFAULT, 0, 0, 0}; }

class Space : public Handle<cstk_space, cstk_space_retain, cstk_space_release> {
public:
    /// Holds no space yet.
    Space() = default;
    /// Takes over the reference that a call of C gave.
    explicit Space(cstk_space *owned) noexcept : Handle(owned) {}
    /// `world_box` is empty for everywhere, or low x, y, z, high x, y, z.
    explicit Space(const std::vector<Robot> &robots, Span<cstk_range> ranges = {},
                   Span<double> world_box = {})
        : Handle(create(robots, ranges, world_box)) {}
    explicit Space(const Robot &robot) : Space(std::vector<Robot>{robot}) {}

    [[nodiscard]] std::size_t nq() const {
        std::size_t nq = 0;
        check(cstk_space_get_size(get(), &nq, nullptr, nullptr));
        return nq;
    }

    [[nodiscard]] std::size_t nv() const {
        std::size_t nv = 0;
        check(cstk_space_get_size(get(), nullptr, &nv, nullptr));
        return nv;
    }

    [[nodiscard]] std::size_t link_count() const {
        std::size_t count = 0;
        check(cstk_space_get_size(get(), nullptr, nullptr, &count));
        return count;
    }

    /// The name of a link, numbered through the space.
    [[nodiscard]] std::string link_name(std::uint32_t link) const {
        return detail::text_of([&](char *buffer, std::size_t capacity, std::size_t *length) {
            return cstk_space_get_link_name(get(), link, buffer, capacity, length);
        });
    }

    /// The link with this name; throws if there is none, or several robots have one.
    [[nodiscard]] std::uint32_t find_link(const std::string &name) const {
        std::uint32_t link = 0;
        check(cstk_space_find_link(get(), name.c_str(), &link));
        return link;
    }

    /// The pairs of links that SRDF files leave to be tested, for CObject::induced_links().
    [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> enabled_pairs() const {
        std::size_t count = 0;
        check(cstk_space_get_enabled_pairs(get(), 0, nullptr, &count));
        std::vector<std::uint32_t> flat(2 * count);
        check(cstk_space_get_enabled_pairs(get(), count, flat.data(), &count));
        std::vector<std::array<std::uint32_t, 2>> out(count);
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = {flat[2 * i], flat[2 * i + 1]};
        }
        return out;
    }

    [[nodiscard]] bool contains(Span<double> q) const {
        bool out = false;
        check(cstk_space_contains(get(), q.data(), q.size(), &out));
        return out;
    }

    /// `coordinate` receives the first that is out of its range, or CSTK_NONE.
    [[nodiscard]] bool within_limits(Span<double> q, std::uint32_t *coordinate = nullptr) const {
        bool out = false;
        check(cstk_space_within_limits(get(), q.data(), q.size(), &out, coordinate));
        return out;
    }

    /// `link` receives the first that is outside the world box, or CSTK_NONE.
    [[nodiscard]] bool within_world(Span<double> q, std::uint32_t *link = nullptr) const {
        bool out = false;
        check(cstk_space_within_world(get(), q.data(), q.size(), &out, link));
        return out;
    }

    [[nodiscard]] cstk_range range(std::size_t coordinate) const {
        cstk_range out;
        check(cstk_space_get_range(get(), coordinate, &out));
        return out;
    }

    /// Where the numbers of the `robot`-th robot begin.
    [[nodiscard]] cstk_space_offset offset(std::size_t robot) const {
        cstk_space_offset out;
        check(cstk_space_get_offset(get(), robot, &out));
        return out;
    }

    /// One pose for every link, as Query's _at_link_poses functions take them.
    [[nodiscard]] std::vector<Pose> link_poses(Span<double> q) const {
        std::vector<Pose> out(link_count());
        check(cstk_space_link_poses(get(), q.data(), q.size(), out.data()->data()));
        return out;
    }

    /// 6 rows of nv doubles.
    [[nodiscard]] std::vector<double> jacobian(Span<double> q, std::uint32_t link,
                                 const std::array<double, 3> &point) const {
        std::vector<double> out(6 * nv());
        check(cstk_space_jacobian(get(), q.data(), q.size(), link, point.data(), out.data()));
        return out;
    }

    [[nodiscard]] std::vector<double> neutral() const {
        std::vector<double> out(nq());
        check(cstk_space_get_neutral(get(), out.data()));
        return out;
    }

    /// Where velocity `v` leads to from `q` in a unit of time.
    [[nodiscard]] std::vector<double> step(Span<double> q, Span<double> v) const {
        std::vector<double> out(nq());
        check(cstk_space_step(get(), q.data(), q.size(), v.data(), v.size(), out.data()));
        return out;
    }

    /// The velocity that leads from `q0` to `q1` in a unit of time.
    [[nodiscard]] std::vector<double> difference(Span<double> q0, Span<double> q1) const {
        std::vector<double> out(nv());
        check(cstk_space_difference(get(), q0.data(), q1.data(), detail::same_size(q0, q1),
                                    out.data()));
        return out;
    }

    [[nodiscard]] std::vector<double> interpolate(Span<double> q0, Span<double> q1, double t) const {
        std::vector<double> out(nq());
        check(cstk_space_interpolate(get(), q0.data(), q1.data(), detail::same_size(q0, q1), t,
                                     out.data()));
        return out;
    }

    /// No weights: 1 each.
    [[nodiscard]] double distance(Span<double> q0, Span<double> q1, Span<double> weights = {}) const {
        if (weights.size() != 0 && weights.size() != nv()) {
            throw std::invalid_argument("cstk: there is one weight for each velocity");
        }
        double out = 0;
        check(cstk_space_distance(get(), q0.data(), q1.data(), detail::same_size(q0, q1),
                                  weights.data(), &out));
        return out;
    }

    /// From `q` to each of the configurations in `others`, one after the other.
    [[nodiscard]] std::vector<double> distances(Span<double> q, Span<double> others,
                                  Span<double> weights = {}) const {
        if (weights.size() != 0 && weights.size() != nv()) {
            throw std::invalid_argument("cstk: there is one weight for each velocity");
        }
        if (others.size() % std::max<std::size_t>(q.size(), 1) != 0) {
            throw std::invalid_argument("cstk: others are whole configurations");
        }
        std::vector<double> out(q.size() == 0 ? 0 : others.size() / q.size());
        check(cstk_space_distances(get(), q.data(), others.data(), out.size(), q.size(),
                                   weights.data(), out.data()));
        return out;
    }

    /// Advances the state of the stream of random numbers.
    [[nodiscard]] std::vector<double> sample(std::uint64_t &state) const {
        std::vector<double> out(nq());
        check(cstk_space_sample(get(), &state, out.data()));
        return out;
    }

    [[nodiscard]] std::vector<double> clamp(Span<double> q) const {
        std::vector<double> out(nq());
        check(cstk_space_clamp(get(), q.data(), q.size(), out.data()));
        return out;
    }

    [[nodiscard]] std::vector<double> wrap(Span<double> q) const {
        std::vector<double> out(nq());
        check(cstk_space_wrap(get(), q.data(), q.size(), out.data()));
        return out;
    }

private:
    static cstk_space *create(const std::vector<Robot> &robots, Span<cstk_range> ranges,
                              Span<double> world_box) {
        if (world_box.size() != 0 && world_box.size() != 6) {
            throw std::invalid_argument("cstk: a world box has 6 numbers");
        }
        std::vector<const cstk_robot *> handles;
        for (const Robot &robot : robots) {
            handles.push_back(robot.get());
        }
        cstk_space *out = nullptr;
        check(cstk_space_create(handles.data(), handles.size(), ranges.data(), ranges.size(),
                                world_box.data(), &out));
        return out;
    }
};

} // namespace cstk

#endif
