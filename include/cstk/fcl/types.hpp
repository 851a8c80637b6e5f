/* Part of cstk/fcl.hpp: FCL's names for Eigen's types, its enumerations, triangles. */
#ifndef CSTK_FCL_TYPES_HPP
#define CSTK_FCL_TYPES_HPP

#include <cstk.hpp>

#if defined(__has_include)
#if !__has_include(<Eigen/Geometry>)
#error "cstk/fcl.hpp needs Eigen 3, as FCL does: find_package(Eigen3), or -I/usr/include/eigen3"
#endif
#endif
#include <Eigen/Geometry>
#include <Eigen/StdVector>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

/* What <fcl/config.h> defines, word for word: programs choose between FCL 0.5 and later by it. */
#define FCL_VERSION "0.7.0"
#define FCL_MAJOR_VERSION 0
#define FCL_MINOR_VERSION 7
#define FCL_PATCH_VERSION 0

namespace cstk_fcl {

template <typename S> using Vector2 = Eigen::Matrix<S, 2, 1>;
template <typename S> using Vector3 = Eigen::Matrix<S, 3, 1>;
template <typename S> using VectorX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <typename S> using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <typename S> using Quaternion = Eigen::Quaternion<S>;
template <typename S> using Transform3 = Eigen::Transform<S, 3, Eigen::Isometry>;
template <typename S> using Translation3 = Eigen::Translation<S, 3>;
template <typename S> using AngleAxis = Eigen::AngleAxis<S>;

using Vector3f = Vector3<float>;
using Matrix3f = Matrix3<float>;
using Quaternionf = Quaternion<float>;
using Transform3f = Transform3<float>;
using Translation3f = Translation3<float>;
using AngleAxisf = AngleAxis<float>;
using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using Quaterniond = Quaternion<double>;
using Transform3d = Transform3<double>;
using Translation3d = Translation3<double>;
using AngleAxisd = AngleAxis<double>;

template <typename T> using aligned_vector = std::vector<T, Eigen::aligned_allocator<T>>;
template <typename Key, typename T, typename Compare = std::less<Key>>
using aligned_map = std::map<Key, T, Compare, Eigen::aligned_allocator<std::pair<const Key, T>>>;

template <typename T, typename... Args> std::shared_ptr<T> make_aligned_shared(Args &&...args) {
    return std::allocate_shared<T>(Eigen::aligned_allocator<T>(), std::forward<Args>(args)...);
}

enum OBJECT_TYPE { OT_UNKNOWN, OT_BVH, OT_GEOM, OT_OCTREE, OT_COUNT };

enum NODE_TYPE {
    BV_UNKNOWN,
    BV_AABB,
    BV_OBB,
    BV_RSS,
    BV_kIOS,
    BV_OBBRSS,
    BV_KDOP16,
    BV_KDOP18,
    BV_KDOP24,
    GEOM_BOX,
    GEOM_SPHERE,
    GEOM_ELLIPSOID,
    GEOM_CAPSULE,
    GEOM_CONE,
    GEOM_CYLINDER,
    GEOM_CONVEX,
    GEOM_PLANE,
    GEOM_HALFSPACE,
    GEOM_TRIANGLE,
    GEOM_OCTREE,
    NODE_COUNT
};

/// Accepted and ignored: there is one solver.
enum GJKSolverType { GST_LIBCCD, GST_INDEP };

/// Three indices of vertices.
class Triangle {
public:
    Triangle() = default;
    Triangle(std::size_t p1, std::size_t p2, std::size_t p3) : vids_{p1, p2, p3} {}

    void set(std::size_t p1, std::size_t p2, std::size_t p3) { *this = Triangle(p1, p2, p3); }

    std::size_t operator[](int i) const { return vids_[i]; }
    std::size_t &operator[](int i) { return vids_[i]; }

private:
    std::size_t vids_[3] = {0, 0, 0};
};

namespace detail {

/// What contacts and nearest points call a geometry that is one primitive.
constexpr int NONE = -1;

using RowMajorPose = Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>;

/// The transform as the library takes it. What is a rotation in single precision is rounded to one in double precision; what is none, or
/// not finite, stays as it is, and is refused by the library.
template <typename S> cstk::Pose pose(const Transform3<S> &transform) {
    /* More than thousands of products in single precision leave. */
    constexpr double SINGLE_ROUNDING = 1e-4;
    Eigen::Matrix3d rotation = transform.linear().template cast<double>();
    if (!std::is_same_v<S, double>) {
        const Eigen::Matrix3d near = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
        rotation = (near - rotation).cwiseAbs().maxCoeff() <= SINGLE_ROUNDING ? near : rotation;
    }
    cstk::Pose pose;
    RowMajorPose rows(pose.data());
    rows.leftCols<3>() = rotation;
    rows.col(3) = transform.translation().template cast<double>();
    return pose;
}

/// The same as the header's own computations take it, checked as the library checks it.
template <typename S> Eigen::Isometry3d checked(const Transform3<S> &transform) {
    cstk::Pose found = cstk::compose(cstk::identity(), pose(transform));
    Eigen::Isometry3d checked;
    checked.matrix().topRows<3>() = RowMajorPose(found.data());
    checked.makeAffine();
    return checked;
}

/// The number in the precision of the caller's that is no larger, or no smaller.
template <typename S> S rounded_down(double number) {
    const S rounded = static_cast<S>(number);
    return static_cast<double>(rounded) <= number ? rounded : std::nextafter(rounded, -std::numeric_limits<S>::infinity());
}

template <typename S> S rounded_up(double number) { return -rounded_down<S>(-number); }

inline Eigen::Vector3d point_of(const double *point) { return {point[0], point[1], point[2]}; }

/// This thread's query context. Of parallel features one contact is computed, which is all that FCL's answers hold.
inline cstk::Query &query() {
    thread_local cstk::Query query = [] {
        cstk::Query made;
        made.set_contacts(CSTK_CONTACTS_NEAREST);
        return made;
    }();
    return query;
}

} // namespace detail

} // namespace cstk_fcl

#endif
