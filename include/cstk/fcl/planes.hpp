/* Part of cstk/fcl.hpp: planes and half-spaces. */
#ifndef CSTK_FCL_PLANES_HPP
#define CSTK_FCL_PLANES_HPP

#include <cstk/fcl/geometry.hpp>

namespace cstk_fcl {

namespace detail {

/// What planes and half-spaces share: n . x = d with n of length 1.
template <typename S_> class Flat : public ShapeBase<S_> {
public:
    using S = S_;

    Vector3<S> n = Vector3<S>::UnitX();
    S d = 0;

    Flat() = default;
    Flat(const Vector3<S> &normal, S offset) : n(normal), d(offset) {
        const S length = n.norm();
        if (length == 0) {
            /* As FCL does. */
            n = Vector3<S>::UnitX();
            d = 0;
        } else {
            n /= length;
            d /= length;
        }
    }

    S signedDistance(const Vector3<S> &p) const { return n.dot(p) - d; }

    /// It has no support points.
    Eigen::Vector3d support_point(const Eigen::Vector3d &, std::size_t) const override {
        throw std::invalid_argument("cstk_fcl: planes and half-spaces have no support points: they are unbounded");
    }

protected:
    /// Unbounded, but across an axis that the normal follows.
    void set_unbounded_box(bool half) {
        const S largest = std::numeric_limits<S>::max();
        this->aabb_local = AABB<S>(Vector3<S>::Constant(-largest), Vector3<S>::Constant(largest));
        for (int axis = 0; axis < 3; ++axis) {
            if (n[axis] == 1 || n[axis] == -1) {
                (n[axis] > 0 ? this->aabb_local.max_ : this->aabb_local.min_)[axis] = n[axis] * d;
                if (!half) {
                    (n[axis] > 0 ? this->aabb_local.min_ : this->aabb_local.max_)[axis] = n[axis] * d;
                }
            }
        }
        this->aabb_center = Vector3<S>::Zero();
        this->aabb_radius = largest;
    }
};

} // namespace detail

/// The points with n . x = d. As in FCL it is a sheet: what is wholly on one side does not meet it.
template <typename S> class Plane : public detail::Flat<S> {
public:
    Plane() = default;
    Plane(const Vector3<S> &n_, S d_) : detail::Flat<S>(n_, d_) {}
    Plane(S a, S b, S c, S d_) : detail::Flat<S>(Vector3<S>(a, b, c), d_) {}

    S distance(const Vector3<S> &p) const { return std::abs(this->signedDistance(p)); }
    void computeLocalAABB() override { this->set_unbounded_box(false); }
    NODE_TYPE getNodeType() const override { return GEOM_PLANE; }
};

using Planef = Plane<float>;
using Planed = Plane<double>;

/// The points with n . x <= d.
template <typename S> class Halfspace : public detail::Flat<S> {
public:
    Halfspace() = default;
    Halfspace(const Vector3<S> &n_, S d_) : detail::Flat<S>(n_, d_) {}
    Halfspace(S a, S b, S c, S d_) : detail::Flat<S>(Vector3<S>(a, b, c), d_) {}

    /// From the boundary, as in FCL.
    S distance(const Vector3<S> &p) const { return std::abs(this->signedDistance(p)); }
    void computeLocalAABB() override { this->set_unbounded_box(true); }
    NODE_TYPE getNodeType() const override { return GEOM_HALFSPACE; }
};

using Halfspacef = Halfspace<float>;
using Halfspaced = Halfspace<double>;

/// The plane or half-space at a transform, in the world.
template <typename S> Plane<S> transform(const Plane<S> &plane, const Transform3<S> &tf) {
    const Vector3<S> n = tf.linear() * plane.n;
    return Plane<S>(n, plane.d + n.dot(tf.translation()));
}

template <typename S> Halfspace<S> transform(const Halfspace<S> &halfspace, const Transform3<S> &tf) {
    const Vector3<S> n = tf.linear() * halfspace.n;
    return Halfspace<S>(n, halfspace.d + n.dot(tf.translation()));
}

} // namespace cstk_fcl

#endif
