/* Part of cstk/fcl.hpp: what all geometries have. */
#ifndef CSTK_FCL_GEOMETRY_HPP
#define CSTK_FCL_GEOMETRY_HPP

#include <cstk/fcl/aabb.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>

namespace cstk_fcl {

/// A set of points in a frame of its own: a shape, or a model of triangles or points.
template <typename S> class CollisionGeometry {
public:
    CollisionGeometry() = default;
    virtual ~CollisionGeometry() = default;

    virtual OBJECT_TYPE getObjectType() const { return OT_UNKNOWN; }
    virtual NODE_TYPE getNodeType() const { return BV_UNKNOWN; }

    /// Writes aabb_local, aabb_center and aabb_radius.
    virtual void computeLocalAABB() = 0;

    void *getUserData() const { return user_data; }
    void setUserData(void *data) { user_data = data; }

    bool isOccupied() const { return cost_density >= threshold_occupied; }
    bool isFree() const { return cost_density <= threshold_free; }
    bool isUncertain() const { return !isOccupied() && !isFree(); }

    Vector3<S> aabb_center = Vector3<S>::Zero();
    S aabb_radius = 0;
    AABB<S> aabb_local;
    void *user_data = nullptr;
    S cost_density = 1;
    S threshold_occupied = 1;
    S threshold_free = 0;

    Vector3<S> computeCOM() const = delete; // libcstk measures distances; masses are the dynamics library's
    Matrix3<S> computeMomentofInertia() const = delete; // libcstk measures distances; masses are the dynamics library's
    S computeVolume() const = delete; // libcstk measures distances; masses are the dynamics library's
    Matrix3<S> computeMomentofInertiaRelatedToCOM() const = delete; // masses are the dynamics library's

    /// Not of FCL: the geometry as the library holds it, to be used with cstk.hpp too. Planes and half-spaces have none.
    virtual const cstk::Body &body() const {
        throw std::invalid_argument("cstk_fcl: planes and half-spaces have no body: they are unbounded");
    }

    /// Not of FCL: whether it has no points, as an octree without occupied leaves. Such a geometry meets nothing, and is near nothing.
    virtual bool is_empty() const { return false; }

    /// Not of FCL: how many convex primitives there are, and the farthest point of one along a direction (of any length but 0).
    virtual std::size_t primitive_count() const { return 1; }
    virtual Eigen::Vector3d support_point(const Eigen::Vector3d &direction, std::size_t primitive) const = 0;

    /// Not of FCL: whether cstk_pair_penetration takes it, which knows no cylinders, cones and ellipsoids.
    virtual bool is_polyhedral() const { return true; }

protected:
    CollisionGeometry(const CollisionGeometry &) = default;
    CollisionGeometry &operator=(const CollisionGeometry &) = default;

    /// The box around support points, for computeLocalAABB.
    void set_local_box() {
        for (std::size_t i = 0; i < primitive_count(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
                const S low = static_cast<S>(support_point(-along, i)[axis]);
                const S high = static_cast<S>(support_point(along, i)[axis]);
                aabb_local.min_[axis] = i == 0 ? low : std::min(aabb_local.min_[axis], low);
                aabb_local.max_[axis] = i == 0 ? high : std::max(aabb_local.max_[axis], high);
            }
        }
        aabb_center = aabb_local.center();
        aabb_radius = (aabb_local.max_ - aabb_center).norm();
    }
};

using CollisionGeometryf = CollisionGeometry<float>;
using CollisionGeometryd = CollisionGeometry<double>;

template <typename S_> class ShapeBase : public CollisionGeometry<S_> {
public:
    using S = S_;

    OBJECT_TYPE getObjectType() const override { return OT_GEOM; }
};

using ShapeBasef = ShapeBase<float>;
using ShapeBased = ShapeBase<double>;

namespace detail {

/// The body of a shape with N sizes, built at the first query. FCL's sizes are public members: when they have changed, which is for
/// one thread alone to do, it is built anew.
template <std::size_t N> class ShapeBody {
public:
    using Sizes = std::array<double, N>;

    ShapeBody() = default;
    ShapeBody(const ShapeBody &) {}
    ShapeBody &operator=(const ShapeBody &) { return *this; }

    /// `add` adds the primitive to a builder.
    template <typename Add> const cstk::Body &of(const Sizes &sizes, const Add &add) const {
        const Built *built = ready_.load(std::memory_order_acquire);
        if (built != nullptr && built->sizes == sizes) {
            return built->body;
        }
        const std::lock_guard<std::mutex> lock(building_);
        if (!built_ || built_->sizes != sizes) {
            cstk::BodyBuilder builder;
            add(builder);
            auto made = std::make_unique<Built>(Built{sizes, builder.build()});
            ready_.store(made.get(), std::memory_order_release);
            built_ = std::move(made);
        }
        return built_->body;
    }

private:
    struct Built {
        Sizes sizes;
        cstk::Body body;
    };

    mutable std::mutex building_;
    mutable std::unique_ptr<const Built> built_;
    mutable std::atomic<const Built *> ready_{nullptr};
};

/// Where a point of length `radius` along the direction is.
inline Eigen::Vector3d on_ball(const Eigen::Vector3d &direction, double radius) {
    return direction * (radius / direction.norm());
}

/// The same in the plane z = 0; any point of the circle for a direction along z.
inline Eigen::Vector3d on_circle(const Eigen::Vector3d &direction, double radius) {
    const double length = std::hypot(direction.x(), direction.y());
    if (length == 0) {
        return {radius, 0, 0};
    }
    return {direction.x() * radius / length, direction.y() * radius / length, 0};
}

inline bool is_unbounded(NODE_TYPE type) { return type == GEOM_PLANE || type == GEOM_HALFSPACE; }

} // namespace detail

} // namespace cstk_fcl

#endif
