/* cstk.hpp: a thin C++17 layer over cstk.h: handles that release themselves, statuses as exceptions.
 *
 * Lists are cut at max_count (4096 where it is not given); look at `truncated`.
 *
 * Every class holds one reference; copying shares the object (another reference), as in C. Functions throw cstk::Error
 * where the C call returns a status other than CSTK_OK. What a call does, its units, frames and thread safety are said
 * in cstk.h at the function of the same name. Answers are the C structures; lists belong to the Query until its next
 * call.
 */
#ifndef CSTK_HPP
#define CSTK_HPP

#if __cplusplus < 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG < 201703L)
#error "cstk.hpp needs C++17: compile with -std=c++17 or later"
#endif

#include <cstk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cstk {

/// A failed call: its status, and the library's message that names the culprit.
class Error : public std::runtime_error {
public:
    explicit Error(cstk_status status)
        : std::runtime_error(std::string(cstk_status_name(status)) + ": " +
                             cstk_last_error_message()),
          status_(status) {}

    cstk_status status() const noexcept { return status_; }

private:
    cstk_status status_;
};

/// Throws unless the status is CSTK_OK.
inline void check(cstk_status status) {
    if (status != CSTK_OK) {
        throw Error(status);
    }
}

/// A view of contiguous items: from std::vector, std::array, a C array, or a pointer and a count.
template <typename T> class Span {
public:
    Span() = default;
    Span(const T *data, std::size_t size) : data_(data), size_(size) {}
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 9
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winit-list-lifetime"
#endif
    /// A list in braces lives until the end of the call it is written in.
    Span(std::initializer_list<T> items) : data_(items.begin()), size_(items.size()) {}
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 9
#pragma GCC diagnostic pop
#endif
    template <std::size_t N> Span(const T (&items)[N]) : data_(items), size_(N) {}
    template <typename Container,
              typename = std::enable_if_t<std::is_convertible_v<
                  decltype(std::declval<const Container &>().data()), const T *>>>
    Span(const Container &items) : data_(items.data()), size_(items.size()) {}

    const T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

private:
    const T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// 12 doubles, row-major [R | t], from child to parent frame.
using Pose = std::array<double, 12>;

inline Pose identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; }

inline Pose translation(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}; }

/// The report's placement: x, y, z, yaw, pitch, roll.
inline Pose pose_from_euler(const std::array<double, 6> &xyz_ypr) {
    Pose pose;
    check(cstk_pose_from_euler(xyz_ypr.data(), pose.data()));
    return pose;
}

/// x, y, z, and the unit quaternion x, y, z, w.
inline Pose pose_from_quaternion(const std::array<double, 7> &xyz_quaternion) {
    Pose pose;
    check(cstk_pose_from_quaternion(xyz_quaternion.data(), pose.data()));
    return pose;
}

inline std::array<double, 6> pose_to_euler(const Pose &pose) {
    std::array<double, 6> xyz_ypr;
    check(cstk_pose_to_euler(pose.data(), xyz_ypr.data()));
    return xyz_ypr;
}

inline Pose compose(const Pose &a, const Pose &b) {
    Pose out;
    check(cstk_pose_compose(a.data(), b.data(), out.data()));
    return out;
}

inline Pose pose_inverse(const Pose &pose) {
    Pose out;
    check(cstk_pose_inverse(pose.data(), out.data()));
    return out;
}

inline std::array<double, 3> transform_point(const Pose &pose, const std::array<double, 3> &point) {
    std::array<double, 3> out;
    check(cstk_pose_transform_point(pose.data(), point.data(), out.data()));
    return out;
}

/// x, y, z, and the unit quaternion x, y, z, w.
inline std::array<double, 7> pose_to_quaternion(const Pose &pose) {
    std::array<double, 7> xyz_quaternion;
    check(cstk_pose_to_quaternion(pose.data(), xyz_quaternion.data()));
    return xyz_quaternion;
}

/// 9 doubles, row-major.
using Matrix3 = std::array<double, 9>;

inline Matrix3 euler_to_rotation(const std::array<double, 3> &yaw_pitch_roll) {
    Matrix3 rotation;
    check(cstk_euler_to_rotation(yaw_pitch_roll.data(), rotation.data()));
    return rotation;
}

inline std::array<double, 3> euler_from_rotation(const Matrix3 &rotation) {
    std::array<double, 3> yaw_pitch_roll;
    check(cstk_euler_from_rotation(rotation.data(), yaw_pitch_roll.data()));
    return yaw_pitch_roll;
}

inline Matrix3 euler_rates(const std::array<double, 3> &yaw_pitch_roll,
                           cstk_angular_frame frame = CSTK_ANGULAR_WORLD) {
    Matrix3 matrix;
    check(cstk_euler_rates(yaw_pitch_roll.data(), frame, matrix.data()));
    return matrix;
}

inline Matrix3 euler_rates_inverse(const std::array<double, 3> &yaw_pitch_roll,
                                   cstk_angular_frame frame = CSTK_ANGULAR_WORLD) {
    Matrix3 matrix;
    check(cstk_euler_rates_inverse(yaw_pitch_roll.data(), frame, matrix.data()));
    return matrix;
}

namespace detail {

/// The columns of a Jacobian of 6 rows.
inline std::size_t columns(const std::vector<double> &jacobian) {
    if (jacobian.size() % 6 != 0) {
        throw std::invalid_argument("cstk: a Jacobian has 6 rows");
    }
    return jacobian.size() / 6;
}

/// The length of both configurations.
inline std::size_t same_size(Span<double> q0, Span<double> q1) {
    if (q0.size() != q1.size()) {
        throw std::invalid_argument("cstk: two configurations have the same length");
    }
    return q0.size();
}

/// The length of each of `count` configurations, one after the other.
inline std::size_t parts_of(Span<double> points, std::size_t count) {
    if (count == 0 || points.size() % count != 0) {
        throw std::invalid_argument("cstk: there is at least one point, and all are of one size");
    }
    return points.size() / count;
}

} // namespace detail

/// From a basic Jacobian, 6 rows, to that of x, y, z, yaw, pitch, roll.
inline std::vector<double> jacobian_to_euler(const std::array<double, 3> &yaw_pitch_roll,
                                             std::vector<double> jacobian) {
    check(cstk_jacobian_to_euler(yaw_pitch_roll.data(), jacobian.data(),
                                 detail::columns(jacobian)));
    return jacobian;
}

inline std::vector<double> jacobian_from_euler(const std::array<double, 3> &yaw_pitch_roll,
                                               std::vector<double> jacobian) {
    check(cstk_jacobian_from_euler(yaw_pitch_roll.data(), jacobian.data(),
                                   detail::columns(jacobian)));
    return jacobian;
}

/// An options structure with its defaults; set its fields as in C.
inline cstk_hierarchy_options hierarchy_options() {
    cstk_hierarchy_options options;
    check(cstk_hierarchy_options_default(&options, sizeof options));
    return options;
}

inline cstk_induced_options induced_options(double contact_epsilon = 0, double margin = 0) {
    cstk_induced_options options;
    check(cstk_induced_options_default(&options, sizeof options));
    options.contact_epsilon = contact_epsilon;
    options.margin = margin;
    return options;
}

inline cstk_link_pair_options link_pair_options() {
    cstk_link_pair_options options;
    check(cstk_link_pair_options_default(&options, sizeof options));
    return options;
}

inline cstk_pure_options pure_options(double contact_epsilon = 0, double scale = 0) {
    cstk_pure_options options;
    check(cstk_pure_options_default(&options, sizeof options));
    options.contact_epsilon = contact_epsilon;
    options.scale = scale;
    return options;
}

/// Options of batches; no threads stands for as many as the machine runs at once.
inline cstk_batch_options batch_options(std::uint32_t threads = 0, bool stop_at_hit = false) {
    cstk_batch_options options;
    check(cstk_batch_options_default(&options, sizeof options));
    options.threads = threads;
    options.stop_at_hit = stop_at_hit;
    return options;
}

/// Options of maps.
inline cstk_map_options map_options(cstk_map_kind kind = CSTK_MAP_CLASSES, std::uint32_t threads = 0) {
    cstk_map_options options;
    check(cstk_map_options_default(&options, sizeof options));
    options.kind = kind;
    options.threads = threads;
    return options;
}

/// An interval of a coordinate, cut into cells; the map is of `count` of them from `first` on, by default of all.
inline cstk_map_axis map_axis(std::uint32_t coordinate, double low, double high, std::size_t cells, std::size_t first = 0,
                              std::size_t count = 0) {
    return {coordinate, 0, low, high, cells, first, count};
}

/// The default options of cstk_environment_pairs and its companions.
inline cstk_object_pair_options object_pair_options(bool with_distances = false) {
    cstk_object_pair_options options;
    check(cstk_object_pair_options_default(&options, sizeof options));
    options.with_distances = with_distances ? 1 : 0;
    return options;
}

/// The default options of cstk_pair_depth and cstk_signed_distances.
inline cstk_depth_options depth_options(double tolerance = 0, std::uint64_t max_steps = 0) {
    cstk_depth_options options;
    check(cstk_depth_options_default(&options, sizeof options));
    options.tolerance = tolerance;
    options.max_steps = max_steps;
    return options;
}

/// The default options of cstk_region_classify.
inline cstk_region_options region_options() {
    cstk_region_options options;
    check(cstk_region_options_default(&options, sizeof options));
    return options;
}

/// The default options of cstk_region_grow.
inline cstk_growth_options growth_options() {
    cstk_growth_options options;
    check(cstk_growth_options_default(&options, sizeof options));
    return options;
}

/// A box that is proved free, and what stops the lower and the upper side of each velocity's coordinate.
struct GrownRegion {
    std::vector<double> low;
    std::vector<double> high;
    std::vector<cstk_region_side> sides;
};

/// The default options of a motion.
inline cstk_motion_options motion_options(double threshold = 0) {
    cstk_motion_options options;
    check(cstk_motion_options_default(&options, sizeof options));
    options.threshold = threshold;
    return options;
}

/// The options of a clearance, whose bounds are to be within the tolerance.
inline cstk_clearance_options clearance_options(double tolerance) {
    cstk_clearance_options options;
    check(cstk_clearance_options_default(&options, sizeof options));
    options.tolerance = tolerance;
    return options;
}

inline cstk_slide_options slide_options(double max_shell) {
    cstk_slide_options options;
    check(cstk_slide_options_default(&options, sizeof options));
    options.max_shell = max_shell;
    return options;
}

/// For steps of this length, as Space::distance() measures.
inline cstk_slide_to_options slide_to_options(double step) {
    cstk_slide_to_options options;
    check(cstk_slide_to_options_default(&options, sizeof options));
    options.step = step;
    return options;
}

inline cstk_shortcut_options shortcut_options(std::uint64_t attempts = 100, std::uint64_t seed = 0) {
    cstk_shortcut_options options;
    check(cstk_shortcut_options_default(&options, sizeof options));
    options.attempts = attempts;
    options.seed = seed;
    return options;
}

inline cstk_urdf_options urdf_options() {
    cstk_urdf_options options;
    check(cstk_urdf_options_default(&options, sizeof options));
    return options;
}

inline cstk_srdf_options srdf_options() {
    cstk_srdf_options options;
    check(cstk_srdf_options_default(&options, sizeof options));
    return options;
}

inline cstk_scene_options scene_options() {
    cstk_scene_options options;
    check(cstk_scene_options_default(&options, sizeof options));
    return options;
}

/// A joint by functions of yours. They must not throw.
inline cstk_custom_joint custom_joint() {
    cstk_custom_joint joint;
    check(cstk_custom_joint_default(&joint, sizeof joint));
    return joint;
}

/// A set by C functions of yours. They must not throw.
inline cstk_predicate predicate() {
    cstk_predicate predicate;
    check(cstk_predicate_default(&predicate, sizeof predicate));
    return predicate;
}

/// Hears the progress of a long call. Return false to end the call with CSTK_ERROR_CANCELLED. Exceptions pass through to the caller.
using Progress = std::function<bool(double fraction)>;

namespace detail {

/* No exception may pass through C: it is kept, and thrown again after the call. */
struct Report {
    Progress progress;
    std::exception_ptr thrown;

    cstk_progress_fn function() const { return progress ? &Report::call : nullptr; }

    /* The status of the call that reported. */
    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(double fraction, void *user) noexcept {
        Report &report = *static_cast<Report *>(user);
        try {
            return report.progress(fraction) ? 0 : 1;
        } catch (...) {
            report.thrown = std::current_exception();
            return 1;
        }
    }
};

/* The same of a function that gives a motion. */
template <typename F> struct Motion {
    F &function;
    std::exception_ptr thrown;

    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(double t, double *q, double *rates, double *accelerations, std::size_t,
                             void *user) noexcept {
        Motion &motion = *static_cast<Motion *>(user);
        try {
            motion.function(t, q, rates, accelerations);
            return 0;
        } catch (...) {
            motion.thrown = std::current_exception();
            return 1;
        }
    }
};

/* A filter of pairs of objects: a function of the two ids and the two data that returns bool. */
template <typename F> struct ObjectFilter {
    F &function;
    std::exception_ptr thrown;

    void check(cstk_status status) const {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        cstk::check(status);
    }

    static std::int32_t call(std::uint64_t r, std::uint64_t s, void *r_data, void *s_data, bool *out,
                             void *user) noexcept {
        ObjectFilter &filter = *static_cast<ObjectFilter *>(user);
        try {
            *out = filter.function(r, s, r_data, s_data);
            return 0;
        } catch (...) {
            filter.thrown = std::current_exception();
            return 1;
        }
    }
};

} // namespace detail

/// One reference to an object of the library; empty when default-constructed or moved from.
template <typename T, cstk_status (*Retain)(T *), cstk_status (*Release)(T *)> class Handle {
public:
    Handle() = default;
    /// Takes over the reference that a _create or _build call gave.
    explicit Handle(T *owned) noexcept : object_(owned) {}
    Handle(const Handle &other) : object_(other.object_) {
        if (object_ != nullptr) {
            check(Retain(object_));
        }
    }
    Handle(Handle &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Handle &operator=(Handle other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() { Release(object_); }

    T *get() const noexcept { return object_; }
    explicit operator bool() const noexcept { return object_ != nullptr; }

private:
    T *object_ = nullptr;
};

/// Polygons for looking at; the view's pointers live as long as the mesh.
class Mesh : public Handle<cstk_mesh, cstk_mesh_retain, cstk_mesh_release> {
public:
    using Handle::Handle;

    cstk_mesh_view view() const {
        cstk_mesh_view out;
        check(cstk_mesh_get_view(get(), &out));
        return out;
    }
};

/// A rigid union of convex primitives.
class Body : public Handle<cstk_body, cstk_body_retain, cstk_body_release> {
public:
    using Handle::Handle;

    /// A body that save() wrote.
    static Body load(const std::string &file) {
        cstk_body *out = nullptr;
        check(cstk_body_load(file.c_str(), &out));
        return Body(out);
    }

    void save(const std::string &file) const { check(cstk_body_save(get(), file.c_str())); }

    /// A point, a direction, or a factor for each axis.
    using Vector = std::array<double, 3>;

    /// Bodies of one primitive; BodyBuilder's methods say what each is.
    static Body polygon(Span<double> xyz, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    static Body polyhedron(Span<double> xyz, std::uint64_t tag = 0);
    static Body sphere(double radius, const Vector &center = {0, 0, 0}, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    static Body capsule(const Vector &a, const Vector &b, double radius, std::uint32_t dimension = 3, std::uint64_t tag = 0);
    static Body box(const Vector &half_extents, const Pose &pose = identity(), std::uint64_t tag = 0);
    static Body cylinder(double radius, double half_length, const Pose &pose = identity(), std::uint64_t tag = 0);
    static Body cone(double radius, double height, const Pose &pose = identity(), std::uint64_t tag = 0);
    static Body ellipsoid(const Vector &semi_axes, const Pose &pose = identity(), std::uint64_t tag = 0);

    /// Data that witnesses hand back; once for each body.
    void set_data(void *data, cstk_destroy_fn destroy = nullptr) const {
        check(cstk_body_set_data(get(), data, destroy));
    }

    void *data() const {
        void *data = nullptr;
        check(cstk_body_get_data(get(), &data));
        return data;
    }

    cstk_hierarchy_statistics hierarchy_statistics() const {
        cstk_hierarchy_statistics out;
        check(cstk_body_get_hierarchy_statistics(get(), &out));
        return out;
    }

    cstk_level_statistics level_statistics(std::uint32_t level) const {
        cstk_level_statistics out;
        check(cstk_body_get_level_statistics(get(), level, &out));
        return out;
    }

    /// The nodes of a level and the leaves above it.
    std::vector<std::uint32_t> level_nodes(std::uint32_t level) const {
        std::size_t count = 0;
        check(cstk_body_get_level_nodes(get(), level, 0, nullptr, &count));
        std::vector<std::uint32_t> nodes(count);
        check(cstk_body_get_level_nodes(get(), level, count, nodes.data(), &count));
        return nodes;
    }

    /// At most `max_count` nodes that cover the body.
    std::vector<std::uint32_t> cover_nodes(std::size_t max_count) const {
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

    cstk_hierarchy_node node(std::uint32_t node) const {
        cstk_hierarchy_node out;
        check(cstk_body_get_node(get(), node, &out));
        return out;
    }

    /// The corners of a node's wrapper, three doubles each.
    std::vector<double> node_corners(std::uint32_t node) const {
        std::size_t count = 0;
        check(cstk_body_get_node_corners(get(), node, 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_node_corners(get(), node, count, xyz.data(), &count));
        return xyz;
    }

    Mesh mesh_of_nodes(Span<std::uint32_t> nodes) const {
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
    cstk_primitive primitive(std::uint32_t index) const {
        cstk_primitive out;
        check(cstk_body_get_primitive(get(), index, &out));
        return out;
    }

    /// The vertices of a feature, three doubles each.
    std::vector<double> feature_vertices(std::uint32_t primitive, cstk_feature_kind kind,
                                         std::uint32_t feature) const {
        std::size_t count = 0;
        check(cstk_body_get_feature_vertices(get(), primitive, kind, feature, 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_feature_vertices(get(), primitive, kind, feature, count, xyz.data(), &count));
        return xyz;
    }

    /// A body that was added to the builder of this one.
    cstk_body_part part(std::uint32_t number) const {
        cstk_body_part out;
        check(cstk_body_get_part(get(), number, &out));
        return out;
    }

    /// The vertices of all primitives, three doubles each.
    std::vector<double> vertices() const {
        std::size_t count = 0;
        check(cstk_body_get_vertices(get(), 0, nullptr, &count));
        std::vector<double> xyz(3 * count);
        check(cstk_body_get_vertices(get(), count, xyz.data(), &count));
        return xyz;
    }

    /// A body with other vertices, in the order of vertices(), and the same topology.
    Body refit(Span<double> xyz) const {
        if (xyz.size() % 3 != 0) {
            throw std::invalid_argument("cstk: a point has three coordinates");
        }
        cstk_body *out = nullptr;
        check(cstk_body_refit(get(), xyz.data(), xyz.size() / 3, &out));
        return Body(out);
    }
};

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
        if (weights.size() != 0 && 3 * weights.size() != xyz.size()) {
            throw std::invalid_argument("cstk: each control point has a weight, or none has");
        }
        const double *factors = weights.size() != 0 ? weights.data() : nullptr;
        check(cstk_body_builder_add_bezier_patch(get(), degree_u, degree_v, xyz.data(), factors,
                                                 points(xyz), tolerance, tag));
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

    Body build() const {
        cstk_body *out = nullptr;
        check(cstk_body_build(get(), nullptr, nullptr, nullptr, &out));
        return Body(out);
    }

    Body build(const cstk_hierarchy_options &options, Progress progress = {}) const {
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

/// A link to be added: the defaults of cstk_link_def.
struct Link {
    std::string name;
    Body body;
    std::int32_t parent = -1;
    cstk_joint_kind joint = CSTK_JOINT_FIXED;
    Pose at = identity();
    std::array<double, 3> axis = {0, 0, 1};
    std::int32_t coordinate = -1;
    std::string joint_name;
    double multiplier = 1;
    double offset = 0;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    /// For CSTK_JOINT_CUSTOM; copied by add_link.
    const cstk_custom_joint *custom = nullptr;
};

class Robot : public Handle<cstk_robot, cstk_robot_retain, cstk_robot_release> {
public:
    using Handle::Handle;

    std::size_t nq() const {
        std::size_t nq = 0;
        check(cstk_robot_get_size(get(), &nq, nullptr, nullptr));
        return nq;
    }

    std::size_t nv() const {
        std::size_t nv = 0;
        check(cstk_robot_get_size(get(), nullptr, &nv, nullptr));
        return nv;
    }

    std::size_t link_count() const {
        std::size_t count = 0;
        check(cstk_robot_get_size(get(), nullptr, nullptr, &count));
        return count;
    }

    /// The link's body; throws if it has none.
    Body body(std::uint32_t link) const {
        cstk_body *out = nullptr;
        check(cstk_robot_get_body(get(), link, &out));
        return Body(out);
    }

    std::uint32_t find_link(const std::string &name) const {
        std::uint32_t link = 0;
        check(cstk_robot_find_link(get(), name.c_str(), &link));
        return link;
    }

    /// The link that the joint moves.
    std::uint32_t find_joint(const std::string &name) const {
        std::uint32_t link = 0;
        check(cstk_robot_find_joint(get(), name.c_str(), &link));
        return link;
    }

    cstk_link_info link_info(std::uint32_t link) const {
        cstk_link_info out;
        check(cstk_robot_get_link_info(get(), link, &out));
        return out;
    }

    std::string link_name(std::uint32_t link) const { return name(cstk_robot_get_link_name, link); }

    /// The name of the joint that moves the link.
    std::string joint_name(std::uint32_t link) const { return name(cstk_robot_get_joint_name, link); }

    /// What SRDF files say of the robot. Names and arrays of groups, states and end effectors live as long as the robot.
    cstk_semantics semantics() const {
        cstk_semantics out;
        check(cstk_robot_get_semantics(get(), &out));
        return out;
    }

    std::uint32_t find_group(const std::string &name) const {
        std::uint32_t group = 0;
        check(cstk_robot_find_group(get(), name.c_str(), &group));
        return group;
    }

    /// An empty group stands for none.
    std::uint32_t find_state(const std::string &group, const std::string &name) const {
        std::uint32_t state = 0;
        const char *of = group.empty() ? nullptr : group.c_str();
        check(cstk_robot_find_state(get(), of, name.c_str(), &state));
        return state;
    }

    std::uint32_t find_end_effector(const std::string &name) const {
        std::uint32_t end_effector = 0;
        check(cstk_robot_find_end_effector(get(), name.c_str(), &end_effector));
        return end_effector;
    }

    cstk_joint_group group(std::uint32_t index) const {
        cstk_joint_group out;
        check(cstk_robot_get_group(get(), index, &out));
        return out;
    }

    cstk_named_state state(std::uint32_t index) const {
        cstk_named_state out;
        check(cstk_robot_get_state(get(), index, &out));
        return out;
    }

    cstk_end_effector end_effector(std::uint32_t index) const {
        cstk_end_effector out;
        check(cstk_robot_get_end_effector(get(), index, &out));
        return out;
    }

    cstk_virtual_joint virtual_joint(std::uint32_t index) const {
        cstk_virtual_joint out;
        check(cstk_robot_get_virtual_joint(get(), index, &out));
        return out;
    }

    /// q with the values of a named state.
    std::vector<double> apply_state(std::uint32_t state, Span<double> q) const {
        std::vector<double> out(q.data(), q.data() + q.size());
        check(cstk_robot_apply_state(get(), state, out.data(), out.size()));
        return out;
    }

    /// The robot of which only the joints that move these links are left, the others frozen at q.
    Robot frozen(Span<std::uint32_t> joints, Span<double> q) const {
        cstk_robot *out = nullptr;
        check(cstk_robot_create_frozen(get(), joints.data(), joints.size(), q.data(), q.size(), &out));
        Robot made(out);
        made.whole_nq_ = nq();
        return made;
    }

    /// Of a robot that frozen() made: the configuration of the robot that it was made from.
    std::vector<double> to_whole(Span<double> q) const {
        std::vector<double> out(whole_nq_);
        check(cstk_robot_to_whole(get(), q.data(), q.size(), out.data(), out.size()));
        return out;
    }

    /// The other way.
    std::vector<double> from_whole(Span<double> whole) const {
        std::vector<double> out(nq());
        check(cstk_robot_from_whole(get(), whole.data(), whole.size(), out.data(), out.size()));
        return out;
    }

    Pose link_pose(Span<double> q, std::uint32_t link) const {
        Pose pose;
        check(cstk_robot_link_pose(get(), q.data(), q.size(), link, pose.data()));
        return pose;
    }

    /// 6 rows of nv doubles.
    std::vector<double> jacobian(Span<double> q, std::uint32_t link,
                                 const std::array<double, 3> &point) const {
        std::vector<double> out(6 * nv());
        check(cstk_robot_jacobian(get(), q.data(), q.size(), link, point.data(), out.data()));
        return out;
    }

private:
    using NameOf = cstk_status (*)(const cstk_robot *, std::uint32_t, char *, std::size_t,
                                   std::size_t *);

    std::string name(NameOf name_of, std::uint32_t link) const {
        std::size_t length = 0;
        check(name_of(get(), link, nullptr, 0, &length));
        /* With room for the terminator, which strings have too. */
        std::string out(length + 1, '\0');
        check(name_of(get(), link, out.data(), out.size(), nullptr));
        out.resize(length);
        return out;
    }

    /* Of the robot that frozen() was called of. */
    std::size_t whole_nq_ = 0;
};

class RobotBuilder
    : public Handle<cstk_robot_builder, cstk_robot_builder_retain, cstk_robot_builder_release> {
public:
    explicit RobotBuilder(std::uint32_t dimension = 3) : Handle(create(dimension)) {}

    std::uint32_t add_link(const Link &link) {
        cstk_link_def def;
        check(cstk_link_def_default(&def, sizeof def));
        def.name = link.name.empty() ? nullptr : link.name.c_str();
        def.body = link.body.get();
        def.parent = link.parent;
        def.joint = link.joint;
        for (std::size_t i = 0; i < 12; ++i) {
            def.at[i] = link.at[i];
        }
        for (std::size_t i = 0; i < 3; ++i) {
            def.axis[i] = link.axis[i];
        }
        def.coordinate = link.coordinate;
        def.joint_name = link.joint_name.empty() ? nullptr : link.joint_name.c_str();
        def.multiplier = link.multiplier;
        def.offset = link.offset;
        def.lower = link.lower;
        def.upper = link.upper;
        def.custom = link.custom;
        std::uint32_t number = 0;
        check(cstk_robot_builder_add_link(get(), &def, &number));
        return number;
    }

    /// Adds the robot of a URDF file; returns its root link. urdf_report() tells what was read and built.
    std::uint32_t load_urdf(const std::string &file,
                            const cstk_urdf_options &options = urdf_options()) {
        std::uint32_t root = 0;
        check(cstk_robot_builder_load_urdf(get(), file.c_str(), &options, nullptr, nullptr, &root));
        return root;
    }

    /// Adds the robot of a URDF text, a robot_description say; mesh names are relative to `folder`.
    std::uint32_t load_urdf_text(const std::string &urdf, const std::string &folder = {},
                                 const cstk_urdf_options &options = urdf_options()) {
        std::uint32_t root = 0;
        const char *at = folder.empty() ? nullptr : folder.c_str();
        check(cstk_robot_builder_load_urdf_text(get(), urdf.c_str(), at, &options, nullptr, nullptr,
                                                &root));
        return root;
    }

    /// What became of the URDF file or text added last.
    cstk_urdf_report urdf_report() const {
        cstk_urdf_report report;
        check(cstk_robot_builder_get_urdf_report(get(), &report));
        return report;
    }

    /// Adds what an SRDF file says of the links that are there.
    void load_srdf(const std::string &file, const cstk_srdf_options &options = srdf_options()) {
        check(cstk_robot_builder_load_srdf(get(), file.c_str(), &options));
    }

    void load_srdf_text(const std::string &srdf, const cstk_srdf_options &options = srdf_options()) {
        check(cstk_robot_builder_load_srdf_text(get(), srdf.c_str(), &options));
    }

    /// What became of the SRDF file or text added last.
    cstk_srdf_report srdf_report() const {
        cstk_srdf_report report;
        check(cstk_robot_builder_get_srdf_report(get(), &report));
        return report;
    }

    /// Rules a pair of links out for self-collision.
    void disable_pair(const std::string &r_link, const std::string &s_link) {
        check(cstk_robot_builder_disable_pair(get(), r_link.c_str(), s_link.c_str()));
    }

    Robot build() const {
        cstk_robot *out = nullptr;
        check(cstk_robot_build(get(), &out));
        return Robot(out);
    }

private:
    static cstk_robot_builder *create(std::uint32_t dimension) {
        cstk_robot_builder *out = nullptr;
        check(cstk_robot_builder_create(dimension, &out));
        return out;
    }
};

inline cstk_range circle() { return {CSTK_RANGE_CIRCLE, 0, 0, 0}; }

inline cstk_range interval(double lower, double upper) {
    return {CSTK_RANGE_INTERVAL, 0, lower, upper};
}

/// What the joint says.
inline cstk_range default_range() { return {CSTK_RANGE_DEFAULT, 0, 0, 0}; }

class Space : public Handle<cstk_space, cstk_space_retain, cstk_space_release> {
public:
    /// Holds no space yet.
    Space() = default;
    /// `world_box` is empty for everywhere, or low x, y, z, high x, y, z.
    explicit Space(const std::vector<Robot> &robots, Span<cstk_range> ranges = {},
                   Span<double> world_box = {})
        : Handle(create(robots, ranges, world_box)) {}
    explicit Space(const Robot &robot) : Space(std::vector<Robot>{robot}) {}

    std::size_t nq() const {
        std::size_t nq = 0;
        check(cstk_space_get_size(get(), &nq, nullptr, nullptr));
        return nq;
    }

    std::size_t nv() const {
        std::size_t nv = 0;
        check(cstk_space_get_size(get(), nullptr, &nv, nullptr));
        return nv;
    }

    std::size_t link_count() const {
        std::size_t count = 0;
        check(cstk_space_get_size(get(), nullptr, nullptr, &count));
        return count;
    }

    /// The name of a link, numbered through the space.
    std::string link_name(std::uint32_t link) const {
        std::size_t length = 0;
        check(cstk_space_get_link_name(get(), link, nullptr, 0, &length));
        std::string out(length + 1, '\0');
        check(cstk_space_get_link_name(get(), link, out.data(), out.size(), nullptr));
        out.resize(length);
        return out;
    }

    /// The pairs of links that SRDF files leave to be tested, for CObject::induced_links().
    std::vector<std::array<std::uint32_t, 2>> enabled_pairs() const {
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

    bool contains(Span<double> q) const {
        bool out = false;
        check(cstk_space_contains(get(), q.data(), q.size(), &out));
        return out;
    }

    /// `coordinate` receives the first that is out of its range, or CSTK_NONE.
    bool within_limits(Span<double> q, std::uint32_t *coordinate = nullptr) const {
        bool out = false;
        check(cstk_space_within_limits(get(), q.data(), q.size(), &out, coordinate));
        return out;
    }

    /// `link` receives the first that is outside the world box, or CSTK_NONE.
    bool within_world(Span<double> q, std::uint32_t *link = nullptr) const {
        bool out = false;
        check(cstk_space_within_world(get(), q.data(), q.size(), &out, link));
        return out;
    }

    cstk_range range(std::size_t coordinate) const {
        cstk_range out;
        check(cstk_space_get_range(get(), coordinate, &out));
        return out;
    }

    /// Where the numbers of the `robot`-th robot begin.
    cstk_space_offset offset(std::size_t robot) const {
        cstk_space_offset out;
        check(cstk_space_get_offset(get(), robot, &out));
        return out;
    }

    /// One pose for every link, as Query's _at functions take them.
    std::vector<Pose> link_poses(Span<double> q) const {
        std::vector<Pose> out(link_count());
        check(cstk_space_link_poses(get(), q.data(), q.size(), out.data()->data()));
        return out;
    }

    /// 6 rows of nv doubles.
    std::vector<double> jacobian(Span<double> q, std::uint32_t link,
                                 const std::array<double, 3> &point) const {
        std::vector<double> out(6 * nv());
        check(cstk_space_jacobian(get(), q.data(), q.size(), link, point.data(), out.data()));
        return out;
    }

    std::vector<double> neutral() const {
        std::vector<double> out(nq());
        check(cstk_space_get_neutral(get(), out.data()));
        return out;
    }

    /// Where velocity `v` leads to from `q` in a unit of time.
    std::vector<double> step(Span<double> q, Span<double> v) const {
        std::vector<double> out(nq());
        check(cstk_space_step(get(), q.data(), q.size(), v.data(), v.size(), out.data()));
        return out;
    }

    /// The velocity that leads from `q0` to `q1` in a unit of time.
    std::vector<double> difference(Span<double> q0, Span<double> q1) const {
        std::vector<double> out(nv());
        check(cstk_space_difference(get(), q0.data(), q1.data(), detail::same_size(q0, q1),
                                    out.data()));
        return out;
    }

    std::vector<double> interpolate(Span<double> q0, Span<double> q1, double t) const {
        std::vector<double> out(nq());
        check(cstk_space_interpolate(get(), q0.data(), q1.data(), detail::same_size(q0, q1), t,
                                     out.data()));
        return out;
    }

    /// No weights: 1 each.
    double distance(Span<double> q0, Span<double> q1, Span<double> weights = {}) const {
        if (weights.size() != 0 && weights.size() != nv()) {
            throw std::invalid_argument("cstk: there is one weight for each velocity");
        }
        double out = 0;
        check(cstk_space_distance(get(), q0.data(), q1.data(), detail::same_size(q0, q1),
                                  weights.data(), &out));
        return out;
    }

    /// From `q` to each of the configurations in `others`, one after the other.
    std::vector<double> distances(Span<double> q, Span<double> others,
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
    std::vector<double> sample(std::uint64_t &state) const {
        std::vector<double> out(nq());
        check(cstk_space_sample(get(), &state, out.data()));
        return out;
    }

    std::vector<double> clamp(Span<double> q) const {
        std::vector<double> out(nq());
        check(cstk_space_clamp(get(), q.data(), q.size(), out.data()));
        return out;
    }

    std::vector<double> wrap(Span<double> q) const {
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

class Environment
    : public Handle<cstk_environment, cstk_environment_retain, cstk_environment_release> {
public:
    Environment() : Handle(create()) {}

    /// Adds an s-object; returns its id.
    std::uint64_t add(const Body &body, const Pose &pose) {
        return apply_one(change(CSTK_CHANGE_ADD, 0, body.get(), pose));
    }

    void move(std::uint64_t id, const Pose &pose) {
        apply_one(change(CSTK_CHANGE_MOVE, id, nullptr, pose));
    }

    void remove(std::uint64_t id) {
        apply_one(change(CSTK_CHANGE_DELETE, id, nullptr, identity()));
    }

    /// Fixes an s-object to a link of a space, `pose` in the link's frame; move() lets it go. The links in `touching` may meet
    /// it: the fingers, say.
    void attach(std::uint64_t id, const Space &space, std::uint32_t link, const Pose &pose,
                Span<std::uint32_t> touching = {}) {
        cstk_environment_change attached = change(CSTK_CHANGE_ATTACH, id, nullptr, pose);
        attached.space = space.get();
        attached.link = link;
        attached.touch_links = touching.data();
        attached.touch_count = static_cast<std::uint32_t>(touching.size());
        apply_one(attached);
    }

    /// Adds the objects of a MoveIt `.scene` file; returns their ids. Their data are their names.
    std::vector<std::uint64_t> load_scene(const std::string &file,
                                          const cstk_scene_options &options = scene_options()) {
        return load(cstk_environment_load_scene, file, options);
    }

    std::vector<std::uint64_t> load_scene_text(const std::string &scene,
                                               const cstk_scene_options &options = scene_options()) {
        return load(cstk_environment_load_scene_text, scene, options);
    }

    /// Applies all changes as one; returns the ids they are about.
    std::vector<std::uint64_t> apply(Span<cstk_environment_change> changes) {
        std::vector<std::uint64_t> ids(changes.size());
        check(cstk_environment_apply(get(), changes.data(), changes.size(), ids.data(), nullptr));
        return ids;
    }

    /// One change, for apply().
    static cstk_environment_change change(cstk_change_kind kind, std::uint64_t id,
                                          const cstk_body *body, const Pose &pose) {
        cstk_environment_change change;
        check(cstk_environment_change_default(&change, sizeof change));
        change.kind = kind;
        change.id = id;
        change.body = body;
        for (std::size_t i = 0; i < 12; ++i) {
            change.pose[i] = pose[i];
        }
        return change;
    }

    Environment snapshot() const {
        cstk_environment *out = nullptr;
        check(cstk_environment_snapshot(get(), &out));
        return Environment(out);
    }

    std::size_t object_count() const {
        std::size_t count = 0;
        check(cstk_environment_get_state(get(), &count, nullptr));
        return count;
    }

    std::uint64_t version() const {
        std::uint64_t version = 0;
        check(cstk_environment_get_state(get(), nullptr, &version));
        return version;
    }

    /// The ids of all objects, in the order in which they came.
    std::vector<std::uint64_t> objects() const {
        std::vector<std::uint64_t> ids(object_count());
        std::size_t count = 0;
        check(cstk_environment_get_objects(get(), ids.size(), ids.data(), &count));
        /* Others may have gone meanwhile. */
        ids.resize(count < ids.size() ? count : ids.size());
        return ids;
    }

    cstk_object_info object(std::uint64_t id) const {
        cstk_object_info out;
        check(cstk_environment_get_object_info(get(), id, &out));
        return out;
    }

    Pose object_pose(std::uint64_t id) const {
        Pose pose;
        check(cstk_environment_get_object_pose(get(), id, pose.data()));
        return pose;
    }

private:
    using Loader = cstk_status (*)(cstk_environment *, const char *, const cstk_scene_options *,
                                   std::size_t, std::uint64_t *, std::size_t *);

    std::vector<std::uint64_t> load(Loader loader, const std::string &scene,
                                    const cstk_scene_options &options) {
        /* As many as a scene may have. */
        std::vector<std::uint64_t> ids(std::size_t{1} << 17);
        std::size_t count = 0;
        check(loader(get(), scene.c_str(), &options, ids.size(), ids.data(), &count));
        ids.resize(count);
        return ids;
    }

    explicit Environment(cstk_environment *owned) : Handle(owned) {}

    std::uint64_t apply_one(const cstk_environment_change &change) {
        std::uint64_t id = 0;
        check(cstk_environment_apply(get(), &change, 1, &id, nullptr));
        return id;
    }

    static cstk_environment *create() {
        cstk_environment *out = nullptr;
        check(cstk_environment_create(&out));
        return out;
    }
};

/// Which cells of a grid are occupied; it changes while it is placed in an environment.
class Octree : public Handle<cstk_octree, cstk_octree_retain, cstk_octree_release> {
public:
    using Progress = cstk::Progress;

    /// Without occupied cells; `resolution` is the edge of a cell.
    explicit Octree(double resolution) : Handle(create(resolution)) {}

    /// From an OctoMap file (.bt or .ot).
    static Octree load(const std::string &file, double min_occupancy = 0.5) {
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
    bool get_cell(const Body::Vector &point) const {
        bool occupied = false;
        check(cstk_octree_get(get(), point.data(), 1, &occupied));
        return occupied;
    }

    /// Makes the cells occupied that are occupied in another octree.
    void insert(const Octree &other) { check(cstk_octree_insert(get(), other.get())); }

    double resolution() const {
        double out = 0;
        check(cstk_octree_get_state(get(), &out, nullptr, nullptr));
        return out;
    }

    std::uint64_t cell_count() const {
        std::uint64_t out = 0;
        check(cstk_octree_get_state(get(), nullptr, &out, nullptr));
        return out;
    }

    /// How many s-objects it is in its environment.
    std::size_t object_count() const {
        std::size_t out = 0;
        check(cstk_octree_get_state(get(), nullptr, nullptr, &out));
        return out;
    }

    /// The occupied cells as cubes, as large as can be: lowest corner and edge, four doubles each.
    std::vector<double> cubes() const {
        std::size_t count = 0;
        check(cstk_octree_get_cubes(get(), 0, nullptr, &count));
        std::vector<double> cubes(4 * count);
        check(cstk_octree_get_cubes(get(), count, cubes.data(), &count));
        return cubes;
    }

    /// A body of the occupied cells, which does not change any more.
    Body build_body(const cstk_hierarchy_options &options = hierarchy_options(), Progress progress = {}) const {
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

/// A set by functions of yours; see cstk_predicate. Threads may call them at once. What they throw
/// ends the query with CSTK_ERROR_CALLBACK_FAILED.
struct Predicate {
    using Configuration = Span<double>;

    std::function<cstk_class(Configuration q)> classify;
    /// These two may be empty.
    std::function<double(Configuration q)> distance;
    /// Returns one entry for each velocity.
    std::function<std::vector<double>(Configuration q)> gradient;
    bool distance_is_bound = false;
    bool knows_depth = false;
};

class CObject : public Handle<cstk_cobject, cstk_cobject_retain, cstk_cobject_release> {
public:
    using Handle::Handle;

    /// No links: all that have a body. No ids: all objects of the environment.
    static CObject induced(const Space &space, const Environment &environment,
                           const cstk_induced_options &options = induced_options(),
                           Span<std::uint32_t> links = {}, Span<std::uint64_t> ids = {}) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_induced(space.get(), links.data(), links.size(), environment.get(),
                                   ids.data(), ids.size(), &options, &out));
        return CObject(out);
    }

    static CObject induced_links(const Space &space,
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

    static CObject union_of(const std::vector<CObject> &parts) {
        return combined(cstk_cobject_union, parts);
    }

    static CObject intersection_of(const std::vector<CObject> &parts) {
        return combined(cstk_cobject_intersection, parts);
    }

    static CObject difference(const CObject &of, const CObject &without) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_difference(of.get(), without.get(), &out));
        return CObject(out);
    }

    CObject complement() const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_complement(get(), &out));
        return CObject(out);
    }

    /// Where a coordinate is beyond its range.
    static CObject beyond_limits(const Space &space, const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_beyond_limits(space.get(), &options, &out));
        return CObject(out);
    }

    /// Where a link's origin is outside the world box.
    static CObject beyond_world(const Space &space, const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_beyond_world(space.get(), &options, &out));
        return CObject(out);
    }

    static CObject box(const Space &space, Span<double> low, Span<double> high,
                       const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_box(space.get(), low.data(), high.data(), detail::same_size(low, high),
                               &options, &out));
        return CObject(out);
    }

    /// Where normal . q <= offset.
    static CObject halfspace(const Space &space, Span<double> normal, double offset,
                             const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_halfspace(space.get(), normal.data(), normal.size(), offset, &options,
                                     &out));
        return CObject(out);
    }

    /// Where a link's body reaches normal . x <= offset of the world; no links for all.
    static CObject below_floor(const Space &space, const std::array<double, 3> &normal, double offset,
                         Span<std::uint32_t> links = {},
                         const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_below_floor(space.get(), links.data(), links.size(), normal.data(), offset,
                                 &options, &out));
        return CObject(out);
    }

    static CObject ball(const Space &space, Span<double> center, double radius,
                        const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_ball(space.get(), center.data(), center.size(), radius, &options, &out));
        return CObject(out);
    }

    static CObject predicate(const Space &space, const cstk_predicate &predicate,
                             const cstk_pure_options &options = pure_options()) {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_predicate(space.get(), &predicate, &options, &out));
        return CObject(out);
    }

    static CObject predicate(const Space &space, Predicate functions,
                             const cstk_pure_options &options = pure_options()) {
        auto kept = std::make_unique<Predicate>(std::move(functions));
        cstk_predicate given = cstk::predicate();
        given.classify = kept->classify ? &Calls::classify : nullptr;
        given.distance = kept->distance ? &Calls::distance : nullptr;
        given.gradient = kept->gradient ? &Calls::gradient : nullptr;
        given.distance_is_bound = kept->distance_is_bound;
        given.knows_depth = kept->knows_depth;
        given.user = kept.get();
        given.destroy = &Calls::destroy;
        CObject made = predicate(space, given, options);
        /* The library's now. */
        static_cast<void>(kept.release());
        return made;
    }

    /// The same set, carrying data that answers hand back where it is a leaf.
    CObject with_data(void *data, cstk_destroy_fn destroy = nullptr) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_data(get(), data, destroy, &out));
        return CObject(out);
    }

    /// The same induced or pure set with a shell of its own for slides.
    CObject with_shell(double shell) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_shell(get(), shell, &out));
        return CObject(out);
    }

    /// The same set with what the caller knows of it: its class, outside or inside, in the interior of boxes, balls and polytopes.
    CObject with_known(const CObject &within, cstk_class known) const {
        cstk_cobject *out = nullptr;
        check(cstk_cobject_with_known(get(), within.get(), known, &out));
        return CObject(out);
    }

    void *data() const {
        void *data = nullptr;
        check(cstk_cobject_get_data(get(), &data, nullptr));
        return data;
    }

    /// By which witnesses and explanations name it as a leaf.
    std::uint64_t number() const {
        std::uint64_t number = 0;
        check(cstk_cobject_get_data(get(), nullptr, &number));
        return number;
    }

    void show(Span<double> q, const std::string &file) const {
        check(cstk_show(get(), q.data(), q.size(), file.c_str()));
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

    /* The functions of a Predicate as C calls them. No exception may pass through C. */
    struct Calls {
        template <typename Action> static std::int32_t guarded(Action action) noexcept {
            try {
                return action() ? 0 : 1;
            } catch (...) {
                return 1;
            }
        }

        static const Predicate &functions(void *user) { return *static_cast<Predicate *>(user); }

        static std::int32_t classify(const double *q, std::size_t nq, std::int32_t *out,
                                     void *user) noexcept {
            return guarded([&] {
                *out = functions(user).classify({q, nq});
                return true;
            });
        }

        static std::int32_t distance(const double *q, std::size_t nq, double *out,
                                     void *user) noexcept {
            return guarded([&] {
                *out = functions(user).distance({q, nq});
                return true;
            });
        }

        static std::int32_t gradient(const double *q, std::size_t nq, double *row, std::size_t nv,
                                     void *user) noexcept {
            return guarded([&] {
                const std::vector<double> found = functions(user).gradient({q, nq});
                for (std::size_t i = 0; i < nv && found.size() == nv; ++i) {
                    row[i] = found[i];
                }
                return found.size() == nv;
            });
        }

        static void destroy(void *user) { delete static_cast<Predicate *>(user); }
    };
};

/// The step nearest to `step` that respects the contacts of a list with gradients; none where too little is left of it.
inline std::optional<std::vector<double>> slide_step(const cstk_witness_list &list,
                                                     Span<double> step, double desired_distance,
                                                     bool normalize = false) {
    std::vector<double> out(step.size());
    bool found = false;
    check(cstk_slide_step(&list, step.data(), step.size(), desired_distance, normalize, out.data(),
                          &found));
    return found ? std::optional(std::move(out)) : std::nullopt;
}

/// The shortest step out to the desired distance; none where no contact is nearer, or none can be helped.
inline std::optional<std::vector<double>> spring_step(const cstk_witness_list &list,
                                                      double desired_distance) {
    std::vector<double> out(list.nv);
    bool found = false;
    check(cstk_spring_step(&list, list.nv, desired_distance, out.data(), &found));
    return found ? std::optional(std::move(out)) : std::nullopt;
}

/// A proof that a motion is free. Empty where Query::motion_certificate found the motion not free.
class Certificate
    : public Handle<cstk_certificate, cstk_certificate_retain, cstk_certificate_release> {
public:
    using Handle::Handle;

    /// A certificate that save() wrote. It proves nothing before verify().
    static Certificate load(const std::string &file) {
        cstk_certificate *out = nullptr;
        check(cstk_certificate_load(file.c_str(), &out));
        return Certificate(out);
    }

    void save(const std::string &file) const { check(cstk_certificate_save(get(), file.c_str())); }

    /// Throws CSTK_ERROR_NOT_PROVED, naming the entry, unless this proves the motion from q0 to q1 free.
    void verify(const CObject &cobject, Span<double> q0, Span<double> q1, double threshold = 0) const {
        const std::size_t nq = detail::same_size(q0, q1);
        check(cstk_certificate_verify(get(), cobject.get(), q0.data(), q1.data(), nq, threshold));
    }

    cstk_certificate_summary summary() const {
        cstk_certificate_summary out;
        check(cstk_certificate_get_summary(get(), &out));
        return out;
    }

    /// The first and the last configuration of the motion.
    std::pair<std::vector<double>, std::vector<double>> ends() const {
        const std::size_t nq = summary().nq;
        std::pair<std::vector<double>, std::vector<double>> out{std::vector<double>(nq),
                                                                std::vector<double>(nq)};
        check(cstk_certificate_get_ends(get(), nq, out.first.data(), out.second.data()));
        return out;
    }

    cstk_certificate_entry entry(std::size_t index) const {
        cstk_certificate_entry out;
        check(cstk_certificate_get_entry(get(), index, &out));
        return out;
    }

    /// The primitives of one side of an entry, 0 or 1.
    std::vector<std::uint32_t> primitives(std::size_t index, std::uint32_t side) const {
        std::size_t count = 0;
        check(cstk_certificate_get_primitives(get(), index, side, 0, nullptr, &count));
        std::vector<std::uint32_t> out(count);
        check(cstk_certificate_get_primitives(get(), index, side, count, out.data(), &count));
        return out;
    }
};

/// A query context; one per thread. Copies share the context.
class Query : public Handle<cstk_query, cstk_query_retain, cstk_query_release> {
public:
    Query() : Handle(create()) {}

    cstk_class classify(const CObject &cobject, Span<double> q) const {
        cstk_class out = CSTK_CLASS_OUTSIDE;
        check(cstk_classify(get(), cobject.get(), q.data(), q.size(), &out));
        return out;
    }

    bool within(const CObject &cobject, Span<double> q, double threshold) const {
        bool out = false;
        check(cstk_within(get(), cobject.get(), q.data(), q.size(), threshold, &out));
        return out;
    }

    cstk_distance_result
    distance(const CObject &cobject, Span<double> q,
             double max_distance = std::numeric_limits<double>::infinity()) const {
        cstk_distance_result out;
        check(cstk_distance(get(), cobject.get(), q.data(), q.size(), max_distance, &out));
        return out;
    }

    cstk_witness_list witnesses(const CObject &cobject, Span<double> q, double epsilon,
                                std::size_t max_count = 4096) const {
        cstk_witness_list out;
        check(cstk_witnesses(get(), cobject.get(), q.data(), q.size(), epsilon, max_count, &out));
        return out;
    }

    cstk_witness_list gradients(const CObject &cobject, Span<double> q, double epsilon,
                                std::size_t max_count = 4096) const {
        cstk_witness_list out;
        check(cstk_gradients(get(), cobject.get(), q.data(), q.size(), epsilon, max_count, &out));
        return out;
    }

    cstk_pseudo_normal_result pseudo_normal(const CObject &cobject, Span<double> q,
                                            double max_shell, std::size_t max_count = 4096,
                                            bool normalize = false) const {
        cstk_pseudo_normal_result out;
        check(cstk_pseudo_normal(get(), cobject.get(), q.data(), q.size(), max_shell, max_count,
                                 normalize, &out));
        return out;
    }

    /// The version of an environment that the last query saw.
    std::uint64_t version(const Environment &environment) const {
        std::uint64_t out = 0;
        check(cstk_query_get_version(get(), environment.get(), &out));
        return out;
    }

    /// Which contacts come with the witnesses of lists from now on.
    void set_contacts(cstk_contacts_listed listed) const {
        check(cstk_query_set_contacts(get(), listed));
    }

    /// Limits the work of each query from now on; 0 for no limit. A query that needs more fails with CSTK_ERROR_LIMIT.
    void set_limit(std::uint64_t node_and_primitive_pairs) const {
        check(cstk_query_set_limit(get(), node_and_primitive_pairs));
    }

    /// Which pairs of links to test for self-collision, for CObject::induced_links().
    std::vector<std::array<std::uint32_t, 2>>
    find_link_pairs(const Space &space,
               const cstk_link_pair_options &options = link_pair_options()) const {
        cstk_link_pair_list list;
        check(cstk_find_link_pairs(get(), space.get(), &options, nullptr, nullptr, &list));
        std::vector<std::array<std::uint32_t, 2>> pairs(list.tested_count);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            pairs[i] = {list.tested[2 * i], list.tested[2 * i + 1]};
        }
        return pairs;
    }

    /// The class, and which leaves and pairs made it.
    cstk_explanation explain(const CObject &cobject, Span<double> q,
                             std::size_t max_count = 4096) const {
        cstk_explanation out;
        check(cstk_explain(get(), cobject.get(), q.data(), q.size(), max_count, &out));
        return out;
    }

    /// The same queries at given link poses: 12 doubles for every link of the space.
    cstk_class classify_at_link_poses(const CObject &cobject, Span<Pose> links) const {
        cstk_class out = CSTK_CLASS_OUTSIDE;
        check(cstk_classify_at_link_poses(get(), cobject.get(), flat(links), links.size(), &out));
        return out;
    }

    bool within_at_link_poses(const CObject &cobject, Span<Pose> links, double threshold) const {
        bool out = false;
        check(cstk_within_at_link_poses(get(), cobject.get(), flat(links), links.size(), threshold, &out));
        return out;
    }

    cstk_distance_result
    distance_at_link_poses(const CObject &cobject, Span<Pose> links,
                double max_distance = std::numeric_limits<double>::infinity()) const {
        cstk_distance_result out;
        check(cstk_distance_at_link_poses(get(), cobject.get(), flat(links), links.size(), max_distance, &out));
        return out;
    }

    cstk_witness_list witnesses_at_link_poses(const CObject &cobject, Span<Pose> links, double epsilon,
                                   std::size_t max_count = 4096) const {
        cstk_witness_list out;
        check(cstk_witnesses_at_link_poses(get(), cobject.get(), flat(links), links.size(), epsilon, max_count,
                                &out));
        return out;
    }

    /// Proves the motion from q0 to q1 free, or finds its first contact; `reached`, if given, receives the configuration there.
    cstk_motion_result motion(const CObject &cobject, Span<double> q0, Span<double> q1,
                              const cstk_motion_options &options = motion_options(),
                              std::vector<double> *reached = nullptr) const {
        cstk_motion_result out;
        const std::size_t nq = detail::same_size(q0, q1);
        /* Planners ask for many motions and for few contacts: nothing is allocated for what is not wanted. */
        std::vector<double> found(reached != nullptr ? nq : 0);
        check(cstk_motion(get(), cobject.get(), q0.data(), q1.data(), nq, &options,
                          reached != nullptr ? found.data() : nullptr, &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same with a certificate, which is empty where the motion is not free; `result`, if given, receives how it ends.
    Certificate motion_certificate(const CObject &cobject, Span<double> q0, Span<double> q1,
                                   const cstk_motion_options &options = motion_options(),
                                   cstk_motion_result *result = nullptr,
                                   std::vector<double> *reached = nullptr) const {
        cstk_certificate *certificate = nullptr;
        cstk_motion_result out;
        std::vector<double> found(detail::same_size(q0, q1));
        check(cstk_motion_certificate(get(), cobject.get(), q0.data(), q1.data(), q0.size(), &options,
                                      found.data(), &out, &certificate));
        Certificate made(certificate);
        if (result != nullptr) {
            *result = out;
        }
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return made;
    }

    /// The same for a path: `points` holds `count` configurations, one after the other.
    cstk_path_result motion_path(const CObject &cobject, Span<double> points, std::size_t count,
                                 const cstk_motion_options &options = motion_options(),
                                 Progress progress = {},
                                 std::vector<double> *reached = nullptr) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_path_result out;
        std::vector<double> found(detail::parts_of(points, count));
        report.check(cstk_motion_path(get(), cobject.get(), points.data(), count, found.size(),
                                      &options, report.function(), &report, found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same on a Bezier curve: `points` holds `count` control points, one configuration after the other.
    cstk_motion_result motion_curve(const CObject &cobject, Span<double> points, std::size_t count,
                                    const cstk_motion_options &options = motion_options(),
                                    std::vector<double> *reached = nullptr) const {
        cstk_motion_result out;
        std::vector<double> found(detail::parts_of(points, count));
        check(cstk_motion_curve(get(), cobject.get(), points.data(), count, found.size(), &options,
                                found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same on a B-spline with `count` control points and count + degree + 1 knots.
    cstk_motion_result motion_spline(const CObject &cobject, std::size_t degree, Span<double> knots,
                                     Span<double> points, std::size_t count,
                                     const cstk_motion_options &options = motion_options(),
                                     std::vector<double> *reached = nullptr) const {
        cstk_motion_result out;
        std::vector<double> found(detail::parts_of(points, count));
        check(cstk_motion_spline(get(), cobject.get(), degree, knots.data(), knots.size(),
                                 points.data(), count, found.size(), &options, found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same on a motion that `function` gives: function(t, q, rates, accelerations) writes the configuration at time t and the
    /// derivatives of its coordinates, each list as long as max_rates. The proof holds if the bounds do.
    template <typename F>
    cstk_motion_result motion_function(const CObject &cobject, F &&function,
                                       Span<double> max_rates, Span<double> max_accelerations,
                                       const cstk_motion_options &options = motion_options(),
                                       std::vector<double> *reached = nullptr) const {
        cstk_motion_result out;
        const std::size_t nq = detail::same_size(max_rates, max_accelerations);
        std::vector<double> found(nq);
        detail::Motion<F> motion{function, nullptr};
        motion.check(cstk_motion_function(get(), cobject.get(), &detail::Motion<F>::call, &motion,
                                          max_rates.data(), max_accelerations.data(), nq, &options,
                                          found.data(), &out));
        if (reached != nullptr) {
            *reached = std::move(found);
        }
        return out;
    }

    /// The same of two bodies, each on a screw from its start to its end; `reached`, if given, receives both poses at the contact.
    cstk_motion_result pair_motion(const Body &a, const Pose &start_a, const Pose &end_a,
                                   const Body &b, const Pose &start_b, const Pose &end_b,
                                   const cstk_motion_options &options = motion_options(),
                                   std::pair<Pose, Pose> *reached = nullptr) const {
        cstk_motion_result out;
        double poses[24];
        check(cstk_pair_motion(get(), a.get(), start_a.data(), end_a.data(), b.get(), start_b.data(),
                               end_b.data(), &options, poses, &out));
        if (reached != nullptr) {
            std::copy(poses, poses + 12, reached->first.begin());
            std::copy(poses + 12, poses + 24, reached->second.begin());
        }
        return out;
    }

    /// The least distance along the motion from q0 to q1; `nearest`, if given, receives the configuration there.
    cstk_clearance_result motion_clearance(const CObject &cobject, Span<double> q0, Span<double> q1,
                                           const cstk_clearance_options &options,
                                           std::vector<double> *nearest = nullptr) const {
        cstk_clearance_result out;
        std::vector<double> found(detail::same_size(q0, q1));
        check(cstk_motion_clearance(get(), cobject.get(), q0.data(), q1.data(), q0.size(), &options,
                                    found.data(), &out));
        if (nearest != nullptr) {
            *nearest = std::move(found);
        }
        return out;
    }

    /// Proves that no configuration between low and high is inside, or that all are; `inside` and `outside`, if given, receive one of
    /// each where the result says that they are known.
    cstk_region_result region_classify(const CObject &cobject, Span<double> low, Span<double> high,
                                       const cstk_region_options &options = region_options(),
                                       std::vector<double> *inside = nullptr,
                                       std::vector<double> *outside = nullptr) const {
        cstk_region_result out;
        std::vector<double> in(detail::same_size(low, high)), beside(low.size());
        check(cstk_region_classify(get(), cobject.get(), low.data(), high.data(), low.size(), &options,
                                   in.data(), beside.data(), &out));
        if (inside != nullptr && out.has_inside) {
            *inside = std::move(in);
        }
        if (outside != nullptr && out.has_outside) {
            *outside = std::move(beside);
        }
        return out;
    }

    /// Grows a box around q that is proved free. `weights` has one entry for each of the space's `nv` velocities.
    GrownRegion region_grow(const CObject &cobject, Span<double> q, Span<double> weights,
                            const cstk_growth_options &options = growth_options()) const {
        GrownRegion grown;
        grown.low.resize(q.size());
        grown.high.resize(q.size());
        grown.sides.resize(2 * weights.size());
        check(cstk_region_grow(get(), cobject.get(), q.data(), q.size(), weights.data(), weights.size(),
                               &options, grown.low.data(), grown.high.data(), grown.sides.data(),
                               grown.sides.size()));
        return grown;
    }

    /// The least distance along a path: `points` holds `count` configurations, one after the other; `nearest`, if given, receives the
    /// configuration at the nearest place.
    cstk_path_clearance_result path_clearance(const CObject &cobject, Span<double> points,
                                              std::size_t count,
                                              const cstk_clearance_options &options,
                                              Progress progress = {},
                                              std::vector<double> *nearest = nullptr) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_path_clearance_result out;
        std::vector<double> found(detail::parts_of(points, count));
        report.check(cstk_path_clearance(get(), cobject.get(), points.data(), count, found.size(),
                                         &options, report.function(), &report, found.data(), &out));
        if (nearest != nullptr) {
            *nearest = std::move(found);
        }
        return out;
    }

    /// Makes a path shorter by motions that are proved free. The path of the answer belongs to this query until its next call.
    cstk_shortcut_result path_shortcut(const CObject &cobject, Span<double> points,
                                       std::size_t count,
                                       const cstk_shortcut_options &options = shortcut_options(),
                                       Progress progress = {}) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_shortcut_result out;
        report.check(cstk_path_shortcut(get(), cobject.get(), points.data(), count,
                                        detail::parts_of(points, count), &options, report.function(),
                                        &report, &out));
        return out;
    }

    /// Leads the robot from q to the box of configurations between `goal_low` and `goal_high`, straight or sliding, until it arrives or
    /// is stopped. Without weights each is 1. The path of the answer belongs to this query until its next call.
    cstk_slide_to_result slide_to(const CObject &cobject, Span<double> q, Span<double> goal_low,
                                  Span<double> goal_high, const cstk_slide_options &slide,
                                  const cstk_slide_to_options &options, Span<double> weights = {},
                                  Progress progress = {}) const {
        detail::Report report{std::move(progress), nullptr};
        cstk_slide_to_result out;
        detail::same_size(q, goal_low);
        report.check(cstk_slide_to(get(), cobject.get(), q.data(), goal_low.data(), goal_high.data(),
                                   detail::same_size(q, goal_high), weights.data(), weights.size(),
                                   &slide, &options, report.function(), &report, &out));
        return out;
    }

    /// The same to one configuration.
    cstk_slide_to_result slide_to(const CObject &cobject, Span<double> q, Span<double> goal,
                                  const cstk_slide_options &slide,
                                  const cstk_slide_to_options &options) const {
        return slide_to(cobject, q, goal, goal, slide, options);
    }

    /// Moves q by one sliding step; says how it ended.
    cstk_slide_result slide(const CObject &cobject, std::vector<double> &q, Span<double> step,
                            const cstk_slide_options &options) const {
        cstk_slide_result out;
        check(cstk_slide(get(), cobject.get(), q.data(), q.size(), step.data(), step.size(), &options,
                         q.data(), &out));
        return out;
    }

    /// The pairs of objects at most `distance` apart, in order of ids: of an environment with another, or, where `other` is null,
    /// within it.
    cstk_object_pair_list
    environment_pairs(const Environment &environment, const Environment *other, double distance,
                      std::size_t max_count = 4096,
                      const cstk_object_pair_options &options = object_pair_options()) const {
        cstk_object_pair_list out;
        check(cstk_environment_pairs(get(), environment.get(), other ? other->get() : nullptr, distance,
                                     max_count, &options, &out));
        return out;
    }

    /// The same of the pairs for which `filter`, a function of the two ids and the two data, returns true. What it throws passes
    /// through.
    template <typename F>
    cstk_object_pair_list filtered_pairs(const Environment &environment, const Environment *other,
                                         double distance, F &&filter,
                                         std::size_t max_count = 4096,
                                         bool with_distances = false) const {
        cstk_object_pair_list out;
        detail::ObjectFilter<F> call{filter, nullptr};
        cstk_object_pair_options options = object_pair_options(with_distances);
        options.filter = &detail::ObjectFilter<F>::call;
        options.user = &call;
        call.check(cstk_environment_pairs(get(), environment.get(), other ? other->get() : nullptr,
                                          distance, max_count, &options, &out));
        return out;
    }

    /// Whether any two objects are at most `threshold` apart.
    bool environment_within(const Environment &environment, const Environment *other, double threshold,
                            const cstk_object_pair_options &options = object_pair_options()) const {
        bool out = false;
        check(cstk_environment_within(get(), environment.get(), other ? other->get() : nullptr,
                                      threshold, &options, &out));
        return out;
    }

    /// The distance of the nearest two objects.
    cstk_distance_result
    environment_distance(const Environment &environment, const Environment *other,
                         double max_distance = std::numeric_limits<double>::infinity(),
                         const cstk_object_pair_options &options = object_pair_options()) const {
        cstk_distance_result out;
        check(cstk_environment_distance(get(), environment.get(), other ? other->get() : nullptr,
                                        max_distance, &options, &out));
        return out;
    }

    /// All pairs of primitives of two objects at most `epsilon` apart, nearest first, and their contacts.
    cstk_witness_list
    environment_witnesses(const Environment &environment, const Environment *other, double epsilon,
                          std::size_t max_count = 4096,
                          const cstk_object_pair_options &options = object_pair_options()) const {
        cstk_witness_list out;
        check(cstk_environment_witnesses(get(), environment.get(), other ? other->get() : nullptr,
                                         epsilon, max_count, &options, &out));
        return out;
    }

    cstk_distance_result
    pair_distance(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                  double max_distance = std::numeric_limits<double>::infinity()) const {
        cstk_distance_result out;
        check(cstk_pair_distance(get(), a.get(), pose_a.data(), b.get(), pose_b.data(), max_distance,
                                 &out));
        return out;
    }

    bool pair_within(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                     double threshold) const {
        bool out = false;
        check(cstk_pair_within(get(), a.get(), pose_a.data(), b.get(), pose_b.data(), threshold,
                               &out));
        return out;
    }

    cstk_witness_list pair_witnesses(const Body &a, const Pose &pose_a, const Body &b,
                                     const Pose &pose_b, double epsilon,
                                     std::size_t max_count = 4096) const {
        cstk_witness_list out;
        check(cstk_pair_witnesses(get(), a.get(), pose_a.data(), b.get(), pose_b.data(), epsilon,
                                  max_count, &out));
        return out;
    }

    cstk_penetration_list pair_penetration(const Body &a, const Pose &pose_a, const Body &b,
                                           const Pose &pose_b,
                                           std::size_t max_count = 4096) const {
        cstk_penetration_list out;
        check(cstk_pair_penetration(get(), a.get(), pose_a.data(), b.get(), pose_b.data(),
                                    max_count, &out));
        return out;
    }

    /// Bounds of the depth of a in b, and a translation of a that parts them.
    cstk_depth_result pair_depth(const Body &a, const Pose &pose_a, const Body &b, const Pose &pose_b,
                                 const cstk_depth_options &options = depth_options()) const {
        cstk_depth_result out;
        check(cstk_pair_depth(get(), a.get(), pose_a.data(), b.get(), pose_b.data(), &options, &out));
        return out;
    }

    /// The signed distances of all pairs of bodies at most `max_distance` apart, with their derivatives.
    cstk_signed_distance_list
    signed_distances(const CObject &cobject, Span<double> q, double max_distance,
                     std::size_t max_count = 4096,
                     const cstk_depth_options &options = depth_options()) const {
        cstk_signed_distance_list out;
        check(cstk_signed_distances(get(), cobject.get(), q.data(), q.size(), max_distance, max_count,
                                    &options, &out));
        return out;
    }

    cstk_query_statistics statistics(bool reset = false) const {
        cstk_query_statistics out;
        check(cstk_query_get_statistics(get(), reset, &out));
        return out;
    }

private:
    static const double *flat(Span<Pose> links) {
        return links.size() == 0 ? nullptr : links.data()->data();
    }

    static cstk_query *create() {
        cstk_query *out = nullptr;
        check(cstk_query_create(&out));
        return out;
    }
};

/// What is free on a grid over some coordinates.
class Map : public Handle<cstk_map, cstk_map_retain, cstk_map_release> {
public:
    using Handle::Handle;

    /// The coordinates without an axis are those of q.
    static Map build(const CObject &cobject, Span<double> q, Span<cstk_map_axis> axes,
                     const cstk_map_options &options = map_options(), Progress progress = {}) {
        detail::Report report{std::move(progress), nullptr};
        cstk_map *out = nullptr;
        report.check(cstk_map_build(cobject.get(), q.data(), q.size(), axes.data(), axes.size(),
                                    &options, report.function(), &report, &out));
        return Map(out);
    }

    /// Its arrays are valid as long as the map.
    cstk_map_view view() const {
        cstk_map_view out;
        check(cstk_map_get_view(get(), &out));
        return out;
    }

    /// Writes an array of NumPy's (.npy).
    void save(const std::string &file) const { check(cstk_map_save(get(), file.c_str())); }

    /// Writes a picture (.png) of a map with two axes, the boundary (.glb) of one with three.
    void show(const std::string &file) const { check(cstk_map_show(get(), file.c_str())); }
};

/// The answers of a batch, one for each item. Those of items with another status than CSTK_OK mean nothing.
template <typename T> struct BatchAnswers {
    std::vector<T> values;
    std::vector<cstk_status> statuses;
    cstk_batch_result done = {};
    /// Why the first item that failed did, or empty.
    std::string first_failure;
};

/// Distances with the gradients of their contacts: one row after the other in `gradients`.
struct BatchDistances : BatchAnswers<cstk_distance_result> {
    std::vector<double> gradients;
};

/// Motions with the configurations at their times[1], one after the other in `reached`.
struct BatchMotions : BatchAnswers<cstk_motion_result> {
    std::vector<double> reached;
};

/// Many questions in one call, on several threads; `q` and `points` hold `count` configurations, one after the other; of none, the answers
/// are empty. Copies share what the threads remember.
class Batch : public Handle<cstk_batch, cstk_batch_retain, cstk_batch_release> {
public:
    Batch() : Handle(create()) {}

    BatchAnswers<cstk_class> classify(const CObject &cobject, Span<double> q, std::size_t count,
                                      const cstk_batch_options &options = batch_options(),
                                      Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchAnswers<cstk_class>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_classify_batch(get(), cobject.get(), q.data(), count, nq, &options,
                                       report.function(), &report, out.values.data(),
                                       out.statuses.data(), &out.done);
        });
    }

    /// 1 for each configuration that is within the threshold, or 0.
    BatchAnswers<std::uint8_t> within(const CObject &cobject, Span<double> q, std::size_t count,
                                      double threshold,
                                      const cstk_batch_options &options = batch_options(),
                                      Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchAnswers<std::uint8_t>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_within_batch(get(), cobject.get(), q.data(), count, nq, threshold, &options,
                                     report.function(), &report, bools(out.values),
                                     out.statuses.data(), &out.done);
        });
    }

    /// Gradients are computed where `nv`, the number of the space's velocities, is given.
    BatchDistances distance(const CObject &cobject, Span<double> q, std::size_t count,
                            double max_distance = std::numeric_limits<double>::infinity(),
                            std::size_t nv = 0, const cstk_batch_options &options = batch_options(),
                            Progress progress = {}) const {
        if (count == 0 && q.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q, count);
        return run<BatchDistances>(count, std::move(progress), [&](auto &out, auto &report) {
            out.gradients.resize(count * nv);
            double *const rows = nv == 0 ? nullptr : out.gradients.data();
            return cstk_distance_batch(get(), cobject.get(), q.data(), count, nq, max_distance,
                                       &options, report.function(), &report, nullptr,
                                       out.values.data(), rows, nv, out.statuses.data(), &out.done);
        });
    }

    /// Number i goes from the i-th configuration of q0 to the i-th of q1.
    BatchMotions motion(const CObject &cobject, Span<double> q0, Span<double> q1, std::size_t count,
                        const cstk_motion_options &motions = motion_options(),
                        const cstk_batch_options &options = batch_options(),
                        Progress progress = {}) const {
        detail::same_size(q0, q1);
        if (count == 0 && q0.size() == 0) {
            return {};
        }
        const std::size_t nq = detail::parts_of(q0, count);
        return run<BatchMotions>(count, std::move(progress), [&](auto &out, auto &report) {
            out.reached.resize(count * nq);
            return cstk_motion_batch(get(), cobject.get(), q0.data(), q1.data(), count, nq, &motions,
                                     &options, report.function(), &report, out.reached.data(),
                                     out.values.data(), out.statuses.data(), &out.done);
        });
    }

    /// 1 for each pair of poses at which the bodies are within the threshold, or 0.
    BatchAnswers<std::uint8_t> pair_within(const Body &a, Span<Pose> poses_a, const Body &b,
                                           Span<Pose> poses_b, double threshold,
                                           const cstk_batch_options &options = batch_options(),
                                           Progress progress = {}) const {
        const std::size_t count = pairs(poses_a, poses_b);
        return run<BatchAnswers<std::uint8_t>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_pair_within_batch(get(), a.get(), flat(poses_a), b.get(), flat(poses_b), count,
                                          threshold, &options, report.function(), &report,
                                          bools(out.values), out.statuses.data(), &out.done);
        });
    }

    BatchAnswers<cstk_distance_result>
    pair_distance(const Body &a, Span<Pose> poses_a, const Body &b, Span<Pose> poses_b,
                  double max_distance = std::numeric_limits<double>::infinity(),
                  const cstk_batch_options &options = batch_options(), Progress progress = {}) const {
        const std::size_t count = pairs(poses_a, poses_b);
        return run<BatchAnswers<cstk_distance_result>>(count, std::move(progress), [&](auto &out, auto &report) {
            return cstk_pair_distance_batch(get(), a.get(), flat(poses_a), b.get(), flat(poses_b), count,
                                            max_distance, &options, report.function(), &report, nullptr,
                                            out.values.data(), out.statuses.data(), &out.done);
        });
    }

    /// The work of all threads.
    cstk_query_statistics statistics(bool reset = false) const {
        cstk_query_statistics out;
        check(cstk_batch_get_statistics(get(), reset, &out));
        return out;
    }

private:
    template <typename Answers, typename Call>
    static Answers run(std::size_t count, Progress progress, Call call) {
        detail::Report report{std::move(progress), nullptr};
        Answers out;
        out.values.resize(count);
        out.statuses.resize(count);
        report.check(call(out, report));
        if (out.done.failed > 0) {
            out.first_failure = cstk_last_error_message();
        }
        return out;
    }

    static bool *bools(std::vector<std::uint8_t> &values) {
        static_assert(sizeof(bool) == 1, "a bool is a byte");
        return reinterpret_cast<bool *>(values.data());
    }

    static std::size_t pairs(Span<Pose> a, Span<Pose> b) {
        if (a.size() != b.size()) {
            throw std::invalid_argument("cstk: there are as many poses of one body as of the other");
        }
        return a.size();
    }

    static const double *flat(Span<Pose> poses) {
        return poses.size() == 0 ? nullptr : poses.data()->data();
    }

    static cstk_batch *create() {
        cstk_batch *out = nullptr;
        check(cstk_batch_create(&out));
        return out;
    }
};

} // namespace cstk

#endif
