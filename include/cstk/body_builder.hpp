/* Part of cstk.hpp: builders of bodies, and bodies of one primitive. */
#ifndef CSTK_BODY_BUILDER_HPP
#define CSTK_BODY_BUILDER_HPP

#include <cstk.h>
#include <cstk/body.hpp>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/pose.hpp>
#include <cstk/progress.hpp>
#include <cstk/span.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace cstk {

class BodyBuilder
    : public Handle<cstk_body_builder, cstk_body_builder_retain, cstk_body_builder_release> {
public:
    using Progress = cstk::Progress;

    explicit BodyBuilder(std::uint32_t dimension = 3) : Handle(create(dimension)) {}

    BodyBuilder &add_polygon(Span<double> xyz, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_polygon(get(), xyz.data(), points(xyz), tag));
        return *this;
    }

    BodyBuilder &add_polyhedron(Span<double> xyz, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_polyhedron(get(), xyz.data(), points(xyz), tag));
        return *this;
    }

    using Vector = Body::Vector;

    /// Triangles: three indices each; scaled, then moved.
    BodyBuilder &add_triangles(Span<double> vertices, Span<std::uint32_t> indices,
                               const Pose &pose = identity(), const Vector &scale = {1, 1, 1}) {
        check(cstk_body_builder_add_mesh(get(), vertices.data(), points(vertices), nullptr,
                                         indices.size() / 3, indices.data(), indices.size(),
                                         pose.data(), scale.data()));
        return *this;
    }

    BodyBuilder &add_mesh(Span<double> vertices, Span<std::uint32_t> face_sizes,
                          Span<std::uint32_t> indices, const Pose &pose = identity(),
                          const Vector &scale = {1, 1, 1}) {
        /* NULL would stand for triangles. */
        static const std::uint32_t none = 0;
        const std::uint32_t *sizes = face_sizes.data() != nullptr ? face_sizes.data() : &none;
        check(cstk_body_builder_add_mesh(get(), vertices.data(), points(vertices), sizes,
                                         face_sizes.size(), indices.data(), indices.size(),
                                         pose.data(), scale.data()));
        return *this;
    }

    BodyBuilder &add_mesh_file(const std::string &file, const Pose &pose = identity(),
                               const Vector &scale = {1, 1, 1}) {
        check(cstk_body_builder_add_mesh_file(get(), file.c_str(), pose.data(), scale.data()));
        return *this;
    }

    /// Balls around the points of a .pcd or .ply file; returns how many points were not measured and so left out.
    std::uint64_t add_cloud_file(const std::string &file, double radius = 0, const Pose &pose = identity(),
                                 const Vector &scale = {1, 1, 1}) {
        std::uint64_t left_out = 0;
        check(cstk_body_builder_add_cloud_file(get(), file.c_str(), pose.data(), scale.data(), radius, &left_out));
        return left_out;
    }

    /// A built body as a part, with its hierarchy.
    BodyBuilder &add_body(const Body &body, const Pose &pose = identity(), std::uint64_t tag = 0) {
        check(cstk_body_builder_add_body(get(), body.get(), pose.data(), tag));
        return *this;
    }

    /// The polygons and mesh faces are the closed boundary of a solid; build() checks it.
    BodyBuilder &set_solid(bool solid = true) {
        check(cstk_body_builder_set_solid(get(), solid));
        return *this;
    }

    /// A Bezier patch as triangles within a tolerance of it: control points row by row, with weights if it is rational. The body states
    /// how far they are from it.
    BodyBuilder &add_bezier_patch(std::uint32_t degree_u, std::uint32_t degree_v, Span<double> xyz,
                                  double tolerance, Span<double> weights = {}, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_bezier_patch(get(), degree_u, degree_v, xyz.data(),
                                                 factors(weights, xyz), points(xyz), tolerance, tag));
        return *this;
    }

    /// A NURBS surface as triangles within a tolerance of it: control points row by row, those of one row with the same index in u. Knots
    /// need not be clamped.
    BodyBuilder &add_nurbs_surface(std::uint32_t degree_u, std::uint32_t degree_v,
                                   Span<double> knots_u, Span<double> knots_v, Span<double> xyz,
                                   double tolerance, Span<double> weights = {},
                                   std::uint64_t tag = 0) {
        check(cstk_body_builder_add_nurbs_surface(
            get(), degree_u, degree_v, knots_u.data(), knots_u.size(), knots_v.data(), knots_v.size(),
            xyz.data(), points(xyz), factors(weights, xyz), tolerance, tag));
        return *this;
    }

    /// The body stands for something no farther from it than this, such as a curved surface: answers hold for that.
    BodyBuilder &set_deviation(double deviation) {
        check(cstk_body_builder_set_deviation(get(), deviation));
        return *this;
    }

    BodyBuilder &add_sphere(const Vector &center, double radius, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_sphere(get(), center.data(), radius, tag));
        return *this;
    }

    BodyBuilder &add_capsule(const Vector &a, const Vector &b, double radius,
                             std::uint64_t tag = 0) {
        check(cstk_body_builder_add_capsule(get(), a.data(), b.data(), radius, tag));
        return *this;
    }

    BodyBuilder &add_box(const Pose &pose, const Vector &half_extents, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_box(get(), pose.data(), half_extents.data(), tag));
        return *this;
    }

    BodyBuilder &add_cylinder(const Pose &pose, double radius, double half_length,
                              std::uint64_t tag = 0) {
        check(cstk_body_builder_add_cylinder(get(), pose.data(), radius, half_length, tag));
        return *this;
    }

    BodyBuilder &add_cone(const Pose &pose, double radius, double height, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_cone(get(), pose.data(), radius, height, tag));
        return *this;
    }

    BodyBuilder &add_ellipsoid(const Pose &pose, const Vector &semi_axes, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_ellipsoid(get(), pose.data(), semi_axes.data(), tag));
        return *this;
    }

    BodyBuilder &add_rounded_polygon(Span<double> xyz, double radius, std::uint64_t tag = 0) {
        check(cstk_body_builder_add_rounded_polygon(get(), xyz.data(), points(xyz), radius, tag));
        return *this;
    }

    BodyBuilder &add_rounded_polyhedron(Span<double> xyz, double radius, std::uint64_t tag = 0) {
        check(
            cstk_body_builder_add_rounded_polyhedron(get(), xyz.data(), points(xyz), radius, tag));
        return *this;
    }

    BodyBuilder &add_points(Span<double> xyz, double radius = 0) {
        check(cstk_body_builder_add_points(get(), xyz.data(), points(xyz), radius));
        return *this;
    }

    /// `heights[j * nx + i]`; without a base a surface.
    BodyBuilder &add_height_field(std::size_t nx, std::size_t ny, Span<double> heights,
                                  const std::array<double, 2> &cell,
                                  std::optional<double> base = {}) {
        if (nx == 0 || heights.size() / nx != ny || heights.size() % nx != 0) {
            throw std::invalid_argument("cstk: a height for every node is needed");
        }
        check(cstk_body_builder_add_height_field(
            get(), nx, ny, heights.data(), cell[0], cell[1],
            base.value_or(std::numeric_limits<double>::quiet_NaN())));
        return *this;
    }

    /// The farthest point along a unit vector. Called by any thread, several at once; an exception
    /// counts as failure.
    using Support = std::function<Vector(const Vector &direction)>;

    BodyBuilder &add_support(Support support, std::uint64_t tag = 0) {
        auto kept = std::make_unique<Support>(std::move(support));
        check(cstk_body_builder_add_support(get(), &ask_support, kept.get(), &drop_support, tag));
        kept.release();
        return *this;
    }

    [[nodiscard]] Body build() const {
        cstk_body *out = nullptr;
        check(cstk_body_build(get(), nullptr, nullptr, nullptr, &out));
        return Body(out);
    }

    [[nodiscard]] Body build(const cstk_hierarchy_options &options, Progress progress = {}) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_body *out = nullptr;
        report.check(cstk_body_build(get(), &options, report.function(), &report, &out));
        return Body(out);
    }

private:
    static std::int32_t ask_support(const double *direction, double *point, void *user) noexcept {
        try {
            const Vector given{direction[0], direction[1], direction[2]};
            const Vector found = (*static_cast<const Support *>(user))(given);
            std::copy(found.begin(), found.end(), point);
            return 0;
        } catch (...) {
            return 1;
        }
    }

    static void drop_support(void *user) noexcept { delete static_cast<Support *>(user); }

    static std::size_t points(Span<double> xyz) {
        if (xyz.size() % 3 != 0) {
            throw std::invalid_argument("cstk: coordinates must come in threes");
        }
        return xyz.size() / 3;
    }

    /// One for each point, or none.
    static const double *factors(Span<double> weights, Span<double> xyz) {
        if (weights.size() == 0) {
            return nullptr;
        }
        if (3 * weights.size() != xyz.size()) {
            throw std::invalid_argument("cstk: each control point has a weight, or none has");
        }
        return weights.data();
    }

    static cstk_body_builder *create(std::uint32_t dimension) {
        cstk_body_builder *out = nullptr;
        check(cstk_body_builder_create(dimension, &out));
        return out;
    }
};

inline Body Body::polygon(Span<double> xyz, std::uint32_t dimension, std::uint64_t tag) {
    return BodyBuilder(dimension).add_polygon(xyz, tag).build();
}

inline Body Body::polyhedron(Span<double> xyz, std::uint64_t tag) { return BodyBuilder().add_polyhedron(xyz, tag).build(); }

inline Body Body::sphere(double radius, const Vector &center, std::uint32_t dimension, std::uint64_t tag) {
    return BodyBuilder(dimension).add_sphere(center, radius, tag).build();
}

inline Body Body::capsule(const Vector &a, const Vector &b, double radius, std::uint32_t dimension, std::uint64_t tag) {
    return BodyBuilder(dimension).add_capsule(a, b, radius, tag).build();
}

inline Body Body::box(const Vector &half_extents, const Pose &pose, std::uint64_t tag) {
    return BodyBuilder().add_box(pose, half_extents, tag).build();
}

inline Body Body::cylinder(double radius, double half_length, const Pose &pose, std::uint64_t tag) {
    return BodyBuilder().add_cylinder(pose, radius, half_length, tag).build();
}

inline Body Body::cone(double radius, double height, const Pose &pose, std::uint64_t tag) {
    return BodyBuilder().add_cone(pose, radius, height, tag).build();
}

inline Body Body::ellipsoid(const Vector &semi_axes, const Pose &pose, std::uint64_t tag) {
    return BodyBuilder().add_ellipsoid(pose, semi_axes, tag).build();
}

inline Body Body::from_mesh_file(const std::string &file, const Vector &scale, const Pose &pose) {
    return BodyBuilder().add_mesh_file(file, pose, scale).build();
}

} // namespace cstk

#endif
