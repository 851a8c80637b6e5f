/* Part of cstk/fcl.hpp: geometries at transforms. */
#ifndef CSTK_FCL_COLLISION_OBJECT_HPP
#define CSTK_FCL_COLLISION_OBJECT_HPP

#include <cstk/fcl/geometry.hpp>

#include <cmath>

namespace cstk_fcl {

/// A geometry at a transform. Copies share the geometry. Classes may derive from it.
template <typename S> class CollisionObject {
public:
    CollisionObject(const std::shared_ptr<CollisionGeometry<S>> &geometry)
        : CollisionObject(geometry, Transform3<S>::Identity()) {}

    CollisionObject(const std::shared_ptr<CollisionGeometry<S>> &geometry, const Transform3<S> &tf)
        : cgeom(geometry), cgeom_const(geometry), t(tf) {
        if (cgeom) {
            cgeom->computeLocalAABB();
            computeAABB();
        }
    }

    CollisionObject(const std::shared_ptr<CollisionGeometry<S>> &geometry, const Matrix3<S> &R, const Vector3<S> &T)
        : CollisionObject(geometry, from(R, T)) {}

    CollisionObject(const CollisionObject &) = default;
    CollisionObject &operator=(const CollisionObject &) = default;
    virtual ~CollisionObject() = default;

    OBJECT_TYPE getObjectType() const { return cgeom->getObjectType(); }
    NODE_TYPE getNodeType() const { return cgeom->getNodeType(); }

    /// The box in the world, as computeAABB() left it: call that after the transform has changed, as with FCL.
    const AABB<S> &getAABB() const { return aabb; }

    /// The smallest box around the geometry's own box as it is turned, and a few roundings more. (FCL takes the box around a ball
    /// where there is a rotation, which is larger.)
    void computeAABB() {
        const AABB<S> &local = cgeom->aabb_local;
        if (!t.matrix().allFinite() || !local.min_.allFinite() || !local.max_.allFinite()) {
            /* So that no manager hides the object from the query, which refuses it. */
            aabb = everywhere();
            return;
        }
        if (detail::is_unbounded(getNodeType())) {
            aabb = t.linear().isIdentity(0) ? translate(local, t.translation()) : everywhere();
            return;
        }
        const Vector3<S> half = (local.max_ - local.min_) / 2;
        const Vector3<S> center = t * local.center();
        const Vector3<S> reach = t.linear().cwiseAbs() * half;
        const S size = center.cwiseAbs().maxCoeff() + local.center().cwiseAbs().sum() + half.sum();
        const S slack = 16 * std::numeric_limits<S>::epsilon() * size;
        aabb.min_ = center - reach - Vector3<S>::Constant(slack);
        aabb.max_ = center + reach + Vector3<S>::Constant(slack);
    }

    void *getUserData() const { return user_data; }
    void setUserData(void *data) { user_data = data; }

    const Vector3<S> getTranslation() const { return t.translation(); }
    const Matrix3<S> getRotation() const { return t.linear(); }
    const Quaternion<S> getQuatRotation() const { return Quaternion<S>(t.linear()); }
    const Transform3<S> &getTransform() const { return t; }

    void setRotation(const Matrix3<S> &R) { t.linear() = R; }
    void setTranslation(const Vector3<S> &T) { t.translation() = T; }
    void setQuatRotation(const Quaternion<S> &q) { t.linear() = q.toRotationMatrix(); }
    void setTransform(const Matrix3<S> &R, const Vector3<S> &T) { t = from(R, T); }
    void setTransform(const Quaternion<S> &q, const Vector3<S> &T) { t = from(q.toRotationMatrix(), T); }
    void setTransform(const Transform3<S> &tf) { t = tf; }

    bool isIdentityTransform() const { return t.matrix().isIdentity(); }
    void setIdentityTransform() { t.setIdentity(); }

    const CollisionGeometry<S> *getCollisionGeometry() const { return cgeom.get(); }
    const std::shared_ptr<const CollisionGeometry<S>> &collisionGeometry() const { return cgeom_const; }

    S getCostDensity() const { return cgeom->cost_density; }
    void setCostDensity(S density) { cgeom->cost_density = density; }
    bool isOccupied() const { return cgeom->isOccupied(); }
    bool isFree() const { return cgeom->isFree(); }
    bool isUncertain() const { return cgeom->isUncertain(); }

protected:
    std::shared_ptr<CollisionGeometry<S>> cgeom;
    std::shared_ptr<const CollisionGeometry<S>> cgeom_const;
    Transform3<S> t;
    mutable AABB<S> aabb;
    void *user_data = nullptr;

private:
    static Transform3<S> from(const Matrix3<S> &R, const Vector3<S> &T) {
        Transform3<S> tf = Transform3<S>::Identity();
        tf.linear() = R;
        tf.translation() = T;
        return tf;
    }

    static AABB<S> everywhere() {
        const S largest = std::numeric_limits<S>::max();
        return AABB<S>(Vector3<S>::Constant(-largest), Vector3<S>::Constant(largest));
    }

public:
    EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

using CollisionObjectf = CollisionObject<float>;
using CollisionObjectd = CollisionObject<double>;

} // namespace cstk_fcl

#endif
