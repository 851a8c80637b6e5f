/* Part of cstk.hpp: bodies and their hierarchies. */
#ifndef CSTK_BODY_HPP
#define CSTK_BODY_HPP

#include <cstk.h>
#include <cstk/detail.hpp>
#include <cstk/error.hpp>
#include <cstk/mesh.hpp>
#include <cstk/pose.hpp>
#include <cstk/span.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cstk {

/// A rigid union of convex primitives.
class Body : public Handle<cstk_body, cstk_body_retain, cstk_body_release> {
public:
    using Handle::Handle;

    /// A body that save() wrote.
    [[nodiscard]] static Body load(const std::string &file) {
        cstk_body *out = nullptr;
        check(cstk_body_load(file.c_str(), &out));
        return Body(out);
    }

    void save(const std::string &file) const { check(cstk_body_save(get(), file.c_str())); }

    /// A point, a direction, or a factor for each axis.
    using Vector = std::array<double, 3>;

    /// Bodies of one primitive; BodyBuilder's methods say what each is. Defined in body_builder.hpp.
    [[nodiscard]] static Body polygon(Span<double> xyz, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    [[nodiscard]] static Body polyhedron(Span<double> xyz, std::uint64_t tag = 0);
    [[nodiscard]] static Body sphere(double radius, const Vector &center = {0, 0, 0}, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    [[nodiscard]] static Body capsule(const Vector &a, const Vector &b, double radius, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    [[nodiscard]] static Body box(const Vector &half_extents, const Pose &pose = identity(), std::uint64_t tag = 0);
    [[nodiscard]] static Body cylinder(double radius, double half_length, const Pose &pose = identity(), std::uint64_t tag = 0);
    [[nodiscard]] static Body cone(double radius, double height, const Pose &pose = identity(), std::uint64_t tag = 0);
    [[nodiscard]] static Body from_mesh_file(const std::string &file, const Vector &scale = {1, 1, 1}, const Pose &pose = identity());
    [[nodiscard]] static Body ellipsoid(const Vector &semi_axes, const Pose &pose = identity(), std::uint64_t tag = 0);

    /// Data that witnesses hand back; once for each body.
    void set_data(void *data, cstk_destroy_fn destroy = nullptr) const {
        check(cstk_body_set_data(get(), data, destroy));
    }

    [[nodiscard]] void *data() const {
        void *data = nullptr;
        check(cstk_body_get_data(get(), &data));
        return data;
    }

    [[nodiscard]] cstk_hierarchy_statistics hierarchy_statistics() const {
        cstk_hierarchy_statistics out;
        check(cstk_body_get_hierarchy_statistics(get(), &out));
        return out;
    }

    [[nodiscard]] cstk_level_statistics level_statistics(std::uint32_t level) const {
        cstk_level_statistics out;
        check(cstk_body_get_level_statistics(get(), level, &out));
        return out;
    }

    /// The nodes of a level and the leaves above it.
    [[nodiscard]] std::vector<std::uint32_t> level_nodes(std::uint32_t level) const {
        std::size_t count = 0;
        check(cstk_body_get_level_nodes(get(), level, 0, nullptr, &count));
        std::vector<std::uint32_t> nodes(count);
        check(cstk_body_get_level_nodes(get(), level, count, nodes.data(), &count));
        return nodes;
    }

    /// At most `max_count` nodes that cover the body.
    [[nodiscard]] std::vector<std::uint32_t> cover_nodes(std::size_t max_count) const {
        cstk_body_statistics statistics = this->statistics();
        if (max_count > statistics.node_count) {
            max_count = static_cast<std::size_t>(statistics.node_count);
        }
        std::vector<std::uint32_t> nodes(max_count);
        std::size_t count = 0;
        check(cstk_body_get_cover_nodes(get(), max_count, nodes.data(), &count));
        nodes.resize(count);
        return nodes;
    }

    [[nodiscard]] cstk_hierarchy_node node(std::uint32_t node) const {
        cstk_hierarchy_node out;
        check(cstk_body_get_node(get(), node, &out));
        return out;
    }

    /// The corners of a node's wrapper, three doubles each.
    [[nodiscard]] std::vector<double> node_corners(std::uint32_t node) const {
        std::size_t count = 0;
        check(cstk_body_get_node_corners(get(), node, 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_node_corners(get(), node, count, xyz.data(), &count));
        return xyz;
    }

    [[nodiscard]] Mesh mesh_of_nodes(Span<std::uint32_t> nodes) const {
        cstk_mesh *out = nullptr;
        check(cstk_mesh_create_from_nodes(get(), nodes.data(), nodes.size(), &out));
        return Mesh(out);
    }

    /// A picture of nodes; the file's name ends in .glb.
    void show_nodes(Span<std::uint32_t> nodes, const std::string &file) const {
        check(cstk_body_show_nodes(get(), nodes.data(), nodes.size(), file.c_str()));
    }

    cstk_body_statistics statistics() const {
        cstk_body_statistics out;
        check(cstk_body_get_statistics(get(), &out));
        return out;
    }

    /// What a primitive is, and how many features it has.
    [[nodiscard]] cstk_primitive primitive(std::uint32_t index) const {
        cstk_primitive out;
        check(cstk_body_get_primitive(get(), index, &out));
        return out;
    }

    /// The vertices of a feature, three doubles each.
    [[nodiscard]] std::vector<double> feature_vertices(std::uint32_t primitive, cstk_feature_kind kind,
                                         std::uint32_t feature) const {
        std::size_t count = 0;
        check(cstk_body_get_feature_vertices(get(), primitive, kind, feature, 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_feature_vertices(get(), primitive, kind, feature, count, xyz.data(), &count));
        return xyz;
    }

    /// A body that was added to the builder of this one.
    [[nodiscard]] cstk_body_part part(std::uint32_t number) const {
        cstk_body_part out;
        check(cstk_body_get_part(get(), number, &out));
        return out;
    }

    /// The vertices of all primitives, three doubles each.
    [[nodiscard]] std::vector<double> vertices() const {
        std::size_t count = 0;
        check(cstk_body_get_vertices(get(), 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_vertices(get(), count, xyz.data(), &count));
        return xyz;
    }

    /// A body with other vertices, in the order of vertices(), and the same topology.
    [[nodiscard]] Body refit(Span<double> xyz) const {
        if (xyz.size() % 3 != 0) {
            throw std::invalid_argument("cstk: a point has three coordinates");
        }
        cstk_body *out = nullptr;
        check(cstk_body_refit(get(), xyz.data(), xyz.size() / 3, &out));
        return Body(out);
    }
};

} // namespace cstk

#endif
